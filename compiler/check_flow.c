/* check_flow.c - warns of what is legal but cannot be meant: nodes that never run, entities that
 * are discarded, declarations that nothing uses. */
#include "check.h"

#include <string.h>

/* Which nodes can run: those all of whose inputs something that can run leads to. */
typedef struct reach {
    checker *k;
    graph *graph;
    bool *reached;   /* by node index: it can run */
    bool *explained; /* it cannot, and it was said why */
    uint32_t *waits; /* inputs that nothing has reached yet */
    bool **fed;      /* by node and input */
    node **stack;
    uint32_t depth;
} reach;

/* ---- what can run -------------------------------------------------------------------------- */

/* A source is what has no input, or an impulse that no edge leads to. */
static uint32_t inputs_to_feed(const node *n)
{
    if (n->kind == NODE_INPUT ||
        (n->input_count == 1 && n->inputs[0].implicit && !n->inputs[0].edge_count))
        return 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < n->input_count; i++)
        count += !n->inputs[i].optional;
    return count;
}

static bool carries(const edge *e)
{
    return !e->from->blocked;
}

static bool is_fed(const port *p)
{
    for (uint32_t i = 0; i < p->edge_count; i++)
        if (carries(p->edges[i]))
            return true;
    return false;
}

/* Marks what `from` leads to in `marks`, and remembers each once. */
static void push(reach *r, bool *marks, node *n)
{
    if (marks[n->index])
        return;
    marks[n->index] = true;
    r->stack[r->depth++] = n;
}

static void feed(reach *r, const edge *e)
{
    node *to = e->to->node;
    bool *fed = &r->fed[to->index][e->to->index];
    if (*fed || to->kind == NODE_INPUT || e->to->optional)
        return;
    *fed = true;
    if (--r->waits[to->index] == 0)
        push(r, r->reached, to);
}

static void find_reached(reach *r)
{
    graph *g = r->graph;
    for (uint32_t i = 0; i < g->node_count; i++) {
        r->fed[i] = ARENA_ARRAY(r->k->arena, bool, g->nodes[i]->input_count);
        r->waits[i] = inputs_to_feed(g->nodes[i]);
    }
    for (uint32_t i = 0; i < g->node_count; i++)
        if (!r->waits[i])
            push(r, r->reached, g->nodes[i]);
    while (r->depth) {
        const node *n = r->stack[--r->depth];
        for (uint32_t o = 0; o < n->output_count; o++)
            for (uint32_t i = 0; i < n->outputs[o].edge_count; i++)
                if (carries(n->outputs[o].edges[i]))
                    feed(r, n->outputs[o].edges[i]);
    }
}

/* What hangs on a node that does not run does not run either, and needs no word of its own. */
static void explain_what_follows(reach *r, node *n)
{
    push(r, r->explained, n);
    while (r->depth) {
        const node *from = r->stack[--r->depth];
        for (uint32_t o = 0; o < from->output_count; o++)
            for (uint32_t i = 0; i < from->outputs[o].edge_count; i++) {
                node *to = from->outputs[o].edges[i]->to->node;
                if (!r->reached[to->index])
                    push(r, r->explained, to);
            }
    }
}

static const char *port_text(checker *k, const port *p)
{
    const node *n = p->node;
    return n->input_count == 1 || n->gate
               ? arena_format(k->arena, "'%s'", node_title(n))
               : arena_format(k->arena, "'%s.%s'", node_title(n), p->name);
}

/* Whether the port is a gate of an encapsulated graph that has a stand-in. */
static bool has_stand_in(const node *n, const port *p)
{
    const graph *inner = n->kind == NODE_GRAPH ? n->graph : NULL;
    for (uint32_t i = 0; inner && !p->implicit && i < inner->input_count; i++)
        if (strcmp(inner->inputs[i]->name, p->name) == 0)
            return inner->inputs[i]->gate->stand_in;
    return false;
}

static void report_unfed(reach *r, const node *n, const port *p)
{
    checker *k = r->k;
    const char *consequence = n->kind == NODE_OUTPUT ? "nothing leaves it"
                              : n->input_count == 1
                                  ? "it never runs"
                                  : arena_format(k->arena, "'%s' never runs", node_title(n));
    diagnostic *d = diagnose(k->d, DIAG_W0503, n->span, port_text(k, p), consequence);
    if (has_stand_in(n, p))
        d->help = "a gate's stand-in runs only when its graph runs on its own";
}

static void warn_of_unfed(reach *r)
{
    graph *g = r->graph;
    for (uint32_t i = 0; i < g->node_count; i++) {
        node *n = g->nodes[i];
        for (uint32_t k = 0; !r->reached[i] && k < n->input_count; k++)
            if (!is_fed(&n->inputs[k]) && !n->inputs[k].optional && !n->gathers) {
                report_unfed(r, n, &n->inputs[k]);
                explain_what_follows(r, n);
                break;
            }
    }
}

static void warn_of_cycles(reach *r)
{
    graph *g = r->graph;
    for (uint32_t i = 0; i < g->node_count; i++) {
        node *n = g->nodes[i];
        if (r->reached[i] || r->explained[i] || n->gathers)
            continue;
        diagnose(r->k->d, DIAG_W0506, n->span, node_title(n));
        explain_what_follows(r, n);
    }
}

static void warn_of_idle_nodes(checker *k, graph *g)
{
    reach r = {.k = k,
               .graph = g,
               .reached = ARENA_ARRAY(k->arena, bool, g->node_count),
               .explained = ARENA_ARRAY(k->arena, bool, g->node_count),
               .waits = ARENA_ARRAY(k->arena, uint32_t, g->node_count),
               .fed = ARENA_ARRAY(k->arena, bool *, g->node_count),
               .stack = ARENA_ARRAY(k->arena, node *, g->node_count)};
    find_reached(&r);
    warn_of_unfed(&r);
    warn_of_cycles(&r);
    warn_of_endless_cycles(k, g, r.reached);
}

/* ---- what is lost, what is not used -------------------------------------------------------- */

static void warn_of_leaf(checker *k, const graph *g, const port *p)
{
    const node *n = p->node;
    if (p->edge_count || p->block || p->gathered_by || n->gate || n->stand_in)
        return;
    const char *name = arena_format(k->arena, "%s.%s", node_title(n), p->name);
    diagnose(k->d, DIAG_W0502, n->span, name, g->name)->help =
        n->named ? arena_format(k->arena, "if it is meant, say so: block %s", name)
                 : "if it is meant, say so: give the node a name, and block the port";
}

static void warn_of_leaves(checker *k, const graph *g)
{
    for (uint32_t i = 0; g->encapsulated && i < g->node_count; i++)
        for (uint32_t o = 0; o < g->nodes[i]->output_count; o++)
            warn_of_leaf(k, g, &g->nodes[i]->outputs[o]);
}

static void warn_of_unused(checker *k, const graph *g)
{
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        const attribute *a = &g->attributes[i];
        if (!a->read && !a->written)
            diagnose(k->d, DIAG_W0504, a->tree->name.span, "attribute", a->name);
    }
    for (uint32_t i = 0; i < g->constant_count; i++) {
        const constant *c = &g->constants[i];
        if (!c->read)
            diagnose(k->d, DIAG_W0504, c->tree->name.span, "constant", c->name);
    }
}

void check_flow(checker *k, graph *g)
{
    warn_of_idle_nodes(k, g);
    warn_of_leaves(k, g);
    warn_of_unused(k, g);
}

/* check_port.c - what ports carry: type variables are solved along the edges, then every edge is
 * checked.
 *
 * A type variable of a node starts unknown and becomes the nearest common ancestor of all that
 * arrives at the ports that it types; what leaves the others has that type in turn, around cycles
 * too. Types only ever move up a tree of finite height, so this ends. A variable that nothing
 * reaches stands for its bound. */
#include "check.h"

#include <string.h>

typedef struct solver {
    checker *k;
    graph *graph;
    LIST(node *) waiting; /* nodes whose variables have changed */
    bool *is_waiting;     /* by node index */
} solver;

static bool is_variable(const type *t)
{
    return t->kind == TYPE_VARIABLE;
}

/* The type of a port as far as it is known; TYPE_VARIABLE while it is not. */
static const type *known_type(const port *p)
{
    return is_variable(&p->type) ? &p->node->variables[p->type.variable] : &p->type;
}

/* Ports of nodes that go with everything have types that do. */
static bool goes_with_everything(const port *p)
{
    return p->node->kind == NODE_ERROR || type_is_error(&p->type);
}

/* ---- solving ------------------------------------------------------------------------------- */

static void wake(solver *s, node *n)
{
    if (s->is_waiting[n->index])
        return;
    s->is_waiting[n->index] = true;
    LIST_ADD(s->k->arena, &s->waiting, n);
}

/* What arrives at a generic port widens its variable. */
static void flow(solver *s, const edge *e)
{
    if (!is_variable(&e->to->type) || goes_with_everything(e->from))
        return;
    const type *from = known_type(e->from);
    type *to = &e->to->node->variables[e->to->type.variable];
    if (is_variable(from))
        return;
    const entity_type *wider =
        is_variable(to) ? from->entity : entity_common(from->entity, to->entity);
    if (is_variable(to) || wider != to->entity) {
        *to = type_of_entity(wider);
        wake(s, e->to->node);
    }
}

static void solve(solver *s)
{
    for (uint32_t i = 0; i < s->graph->edge_count; i++)
        if (!s->graph->edges[i]->disabled)
            flow(s, s->graph->edges[i]);
    while (s->waiting.count) {
        node *n = s->waiting.at[--s->waiting.count];
        s->is_waiting[n->index] = false;
        for (uint32_t o = 0; o < n->output_count; o++)
            for (uint32_t i = 0; is_variable(&n->outputs[o].type) && i < n->outputs[o].edge_count;
                 i++)
                flow(s, n->outputs[o].edges[i]);
    }
}

/* ---- checking edges ------------------------------------------------------------------------ */

/* 'roof', or 'roof.slope' where the node has more ports in that direction. */
static const char *port_text(checker *k, const port *p)
{
    const node *n = p->node;
    uint32_t count = p->is_input ? n->input_count : n->output_count;
    return count == 1 ? arena_format(k->arena, "'%s'", node_title(n))
                      : arena_format(k->arena, "'%s.%s'", node_title(n), p->name);
}

/* The first two edges that bring different types to a node's variable. */
static bool find_conflict(const node *n, uint32_t variable, const edge *found[2])
{
    found[0] = NULL;
    for (uint32_t i = 0; i < n->input_count; i++)
        for (uint32_t k = 0; is_variable(&n->inputs[i].type) &&
                             n->inputs[i].type.variable == variable && k < n->inputs[i].edge_count;
             k++) {
            const edge *e = n->inputs[i].edges[k];
            if (goes_with_everything(e->from) || is_variable(known_type(e->from)))
                continue;
            if (!found[0])
                found[0] = e;
            else if (!type_equal(known_type(found[0]->from), known_type(e->from))) {
                found[1] = e;
                return true;
            }
        }
    return false;
}

static uint32_t line_of(span place)
{
    uint32_t line, column;
    source_place(place.source, place.from, &line, &column);
    return line;
}

/* Where two types met and became a third one that does not fit here, say so. */
static const char *explain_meeting(checker *k, const port *from)
{
    const edge *found[2];
    if (!is_variable(&from->type) || !find_conflict(from->node, from->type.variable, found))
        return NULL;
    return arena_format(
        k->arena, "'%s' takes %s from %s (line %u) and %s from %s (line %u): together they are %s",
        node_title(from->node), type_text(k->arena, known_type(found[0]->from)),
        port_text(k, found[0]->from), (unsigned)line_of(found[0]->from_span),
        type_text(k->arena, known_type(found[1]->from)), port_text(k, found[1]->from),
        (unsigned)line_of(found[1]->from_span), type_text(k->arena, known_type(from)));
}

static const char *suggest_converter(checker *k, const entity_type *from, const entity_type *to)
{
    const procedure *f = suggestions_wanted(k->c) ? library_converter(k->c, k->p, from, to) : NULL;
    return f ? arena_format(k->arena, "insert %s()", f->name) : NULL;
}

static void report_edge(checker *k, const port *from, const port *to, const type *wanted,
                        span from_span, span to_span)
{
    /* Before the message is made: looking for a converter reads interfaces, which may add messages.
     */
    const char *help = explain_meeting(k, from);
    if (!help)
        help = suggest_converter(k, known_type(from)->entity, wanted->entity);
    diagnostic *d = diagnose(k->d, DIAG_E0301, from_span, port_text(k, from),
                             type_text(k->arena, known_type(from)), port_text(k, to),
                             type_text(k->arena, wanted));
    d->second = (diagnostic_label){to_span, NULL};
    d->help = help;
}

/* What a port takes: of a generic one, its variable's bound. */
static type taken_type(const port *p)
{
    if (!is_variable(&p->type))
        return p->type;
    return type_of_entity(p->node->procedure->bounds[p->type.variable]);
}

static bool fits(const port *from, const type *wanted)
{
    const type *given = known_type(from);
    return goes_with_everything(from) || is_variable(given) || type_is_error(wanted) ||
           entity_derives(given->entity, wanted->entity);
}

static void check_edge(checker *k, const edge *e)
{
    type wanted = taken_type(e->to);
    if (!goes_with_everything(e->to) && !fits(e->from, &wanted))
        report_edge(k, e->from, e->to, &wanted, e->from_span, e->to_span);
}

static void check_gathered(checker *k, const port *p)
{
    const node *gate = p->gathered_by;
    if (gate && !fits(p, &gate->inputs[0].type))
        report_edge(k, p, &gate->inputs[0], &gate->inputs[0].type, p->node->span, gate->span);
}

/* ---- the types of ports -------------------------------------------------------------------- */

static void settle_port(port *p)
{
    if (!is_variable(&p->type))
        return;
    const node *n = p->node;
    const type *t = &n->variables[p->type.variable];
    p->type = is_variable(t) ? type_of_entity(n->procedure->bounds[p->type.variable]) : *t;
}

static void settle_node(node *n)
{
    for (uint32_t i = 0; i < n->input_count; i++)
        settle_port(&n->inputs[i]);
    for (uint32_t i = 0; i < n->output_count; i++)
        settle_port(&n->outputs[i]);
    for (uint32_t i = 0; n->procedure && n->variables && i < n->procedure->variable_count; i++)
        if (is_variable(&n->variables[i]))
            n->variables[i] = type_of_entity(n->procedure->bounds[i]);
}

void check_ports(checker *k, graph *g)
{
    solver s = {.k = k, .graph = g, .is_waiting = ARENA_ARRAY(k->arena, bool, g->node_count)};
    for (uint32_t i = 0; i < g->node_count; i++) {
        node *n = g->nodes[i];
        for (uint32_t v = 0; n->variables && v < n->procedure->variable_count; v++)
            n->variables[v] = (type){.kind = TYPE_VARIABLE, .variable = v};
    }
    solve(&s);
    for (uint32_t i = 0; i < g->edge_count; i++)
        check_edge(k, g->edges[i]);
    for (uint32_t i = 0; i < g->node_count; i++)
        for (uint32_t o = 0; o < g->nodes[i]->output_count; o++)
            check_gathered(k, &g->nodes[i]->outputs[o]);
    for (uint32_t i = 0; i < g->node_count; i++)
        settle_node(g->nodes[i]);
}

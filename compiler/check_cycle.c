/* check_cycle.c - warns of cycles that nothing leads out of.
 *
 * Nodes that reach each other are one component (found as Kosaraju and Sharir do, without
 * recursion). A cycle has no way out where no node of its component has an edge to another one, a
 * port that nobody listens to or that is blocked, or an input that something else feeds. */
#include "check.h"
#include "placement.h"

typedef struct components {
    const graph *graph;
    successors edges;
    uint32_t *of;       /* by node index: the component; from 1 */
    uint32_t *finished; /* node indices, in the order in which the search left them */
    uint32_t *stack, *cursor;
    uint32_t depth, finished_count, count;
} components;

static void finish_from(components *c, bool *seen, uint32_t root)
{
    seen[root] = true;
    c->stack[c->depth++] = root;
    while (c->depth) {
        uint32_t n = c->stack[c->depth - 1], at = c->edges.first[n] + c->cursor[n];
        if (at == c->edges.first[n + 1]) {
            c->finished[c->finished_count++] = n;
            c->depth--;
            continue;
        }
        c->cursor[n]++;
        uint32_t to = c->edges.edges[at]->to->node->index;
        if (!seen[to]) {
            seen[to] = true;
            c->stack[c->depth++] = to;
        }
    }
}

static void join(components *c, uint32_t n)
{
    if (c->of[n])
        return;
    c->of[n] = c->count;
    c->stack[c->depth++] = n;
}

/* The component of `root`: what leads to it and belongs to none yet. */
static void collect(components *c, uint32_t root)
{
    c->count++;
    join(c, root);
    while (c->depth) {
        const node *n = c->graph->nodes[c->stack[--c->depth]];
        for (uint32_t k = 0; k < n->input_count; k++)
            for (uint32_t i = 0; i < n->inputs[k].edge_count; i++)
                join(c, n->inputs[k].edges[i]->from->node->index);
    }
}

static components components_of(arena *a, const graph *g)
{
    components c = {.graph = g, .edges = successors_of(a, g, true)};
    bool *seen = ARENA_ARRAY(a, bool, g->node_count);
    c.of = ARENA_ARRAY(a, uint32_t, g->node_count);
    c.finished = ARENA_ARRAY(a, uint32_t, g->node_count);
    c.stack = ARENA_ARRAY(a, uint32_t, g->node_count);
    c.cursor = ARENA_ARRAY(a, uint32_t, g->node_count);
    for (uint32_t i = 0; i < g->node_count; i++)
        if (!seen[i])
            finish_from(&c, seen, i);
    for (uint32_t i = g->node_count; i-- > 0;)
        if (!c.of[c.finished[i]])
            collect(&c, c.finished[i]);
    return c;
}

/* Entities may leave at this node, or stop here. Of what a node takes and does not send on, only
 * its ports tell. */
static bool lets_go(const components *c, const node *n)
{
    if (n->kind != NODE_PROCEDURE || n->input_count > 1 || !n->output_count || n->broken)
        return true;
    for (uint32_t o = 0; o < n->output_count; o++) {
        const port *p = &n->outputs[o];
        if (!p->edge_count || p->blocked || p->blocked_if)
            return true;
        for (uint32_t i = 0; i < p->edge_count; i++)
            if (p->edges[i]->condition ||
                c->of[p->edges[i]->to->node->index] != c->of[n->index])
                return true;
    }
    return false;
}

void warn_of_endless_cycles(checker *k, const graph *g, const bool *reached)
{
    components c = components_of(k->arena, g);
    bool *told = ARENA_ARRAY(k->arena, bool, c.count + 1);
    for (uint32_t i = 0; i < g->node_count; i++)
        if (!reached[i] || lets_go(&c, g->nodes[i]))
            told[c.of[i]] = true;
    for (uint32_t i = 0; i < g->node_count; i++) {
        if (told[c.of[i]])
            continue;
        told[c.of[i]] = true;
        diagnose(k->d, DIAG_W0509, g->nodes[i]->span, node_title(g->nodes[i]))->help =
            "a port that leads out, of a condition say, lets entities leave it";
    }
}

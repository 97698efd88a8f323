/* cut.c - run --node: stops the main graph at one of its nodes.
 *
 * Needs check without errors, runs before order is read. Keeps the nodes that lead to the one
 * that is asked for, turns its output ports into leaves and blocks every other port that would
 * become one. */
#include <stdlib.h>
#include <string.h>

#include "tool.h"

static node *find_node(const graph *g, const char *name)
{
    for (uint32_t i = 0; i < g->node_count; i++)
        if (!strcmp(g->nodes[i]->name, name))
            return g->nodes[i];
    return NULL;
}

/* Marks what leads to `last`, by going over the edges until nothing is added. */
static void mark_ancestors(const graph *g, const node *last, bool *kept)
{
    kept[last->index] = true;
    for (uint32_t i = 0; i < g->node_count; i++)
        for (uint32_t k = 0; k < g->nodes[i]->output_count; k++)
            kept[i] |= g->nodes[i]->outputs[k].gathered_by == last;
    for (bool added = true; added;) {
        added = false;
        for (uint32_t i = g->edge_count; i-- > 0;) {
            const edge *e = g->edges[i];
            if (!e->disabled && kept[e->to->node->index] && !kept[e->from->node->index])
                kept[e->from->node->index] = added = true;
        }
    }
}

static bool stays(const edge *e, const node *last, const bool *kept)
{
    return e->from->node != last && kept[e->from->node->index] && kept[e->to->node->index];
}

static void cut_port(port *p, const node *last, const bool *kept)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->edge_count; i++)
        if (stays(p->edges[i], last, kept))
            p->edges[count++] = p->edges[i];
    p->edge_count = count;
    if (p->gathered_by == last)
        return;
    p->gathered_by = NULL;
    if (p->node == last)
        p->blocked = false, p->blocked_if = NULL;
    else if (!p->is_input && count == 0)
        p->blocked = true;
}

static void cut_graph(graph *g, const node *last, const bool *kept)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < g->edge_count; i++)
        if (stays(g->edges[i], last, kept))
            g->edges[count++] = g->edges[i];
    g->edge_count = count;
    count = 0;
    for (uint32_t i = 0; i < g->node_count; i++) {
        node *n = g->nodes[i];
        for (uint32_t k = 0; k < n->input_count; k++)
            cut_port(&n->inputs[k], last, kept);
        for (uint32_t k = 0; k < n->output_count; k++)
            cut_port(&n->outputs[k], last, kept);
        if (kept[n->index])
            g->nodes[count++] = n;
    }
    g->node_count = count;
}

static uint32_t keep_gates(node **gates, uint32_t count, const bool *kept)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++)
        if (kept[gates[i]->index])
            gates[left++] = gates[i];
    return left;
}

bool cut_at_node(program *p, const char *name)
{
    graph *g = p->main;
    node *last = find_node(g, name);
    if (!last)
        return false;
    bool *kept = ARENA_ARRAY(p->arena, bool, g->node_count);
    mark_ancestors(g, last, kept);
    cut_graph(g, last, kept);
    g->input_count = keep_gates(g->inputs, g->input_count, kept);
    g->output_count = keep_gates(g->outputs, g->output_count, kept);
    for (uint32_t i = 0; i < g->node_count; i++)
        g->nodes[i]->index = i;
    return true;
}

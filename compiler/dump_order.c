/* dump_order.c - the order of execution as text, for tests: each graph's nodes by rank, its
 * cyclic edges in the order of their lines, its regions. */
#include "closure.h"
#include "compiler.h"
#include "library.h"

#include <string.h>

static void dump_nodes(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->node_count; i++) {
        text_format(out, "  %u %s\n", i, g->order[i]->name);
    }
}

static void dump_cyclic_edges(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->edge_count; i++) {
        const edge *e = g->edges[i];
        if (e->cyclic) {
            text_format(out, "  cyclic %s.%s -> %s.%s\n", e->from->node->name, e->from->name,
                        e->to->node->name, e->to->name);
        }
    }
}

static void dump_regions(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->region_count; i++) {
        const region *r = &g->regions[i];
        text_format(out, "  %s %u..%u\n", r->cyclic ? "loop" : "straight", r->first, r->last);
    }
}

/* Of what runs in threads, or is kept: why it cannot be. */
static void dump_surrogates(const program *p, const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        if (n->kind != NODE_SURROGATE || !n->target)
            continue;
        const closure all = closure_of(p, n->target);
        if (!strcmp(n->procedure->name, "parallel"))
            text_format(out, "  %s %s\n", n->name, all.tied ? "one after another: " : "in threads");
        else if (!strcmp(n->procedure->name, "cache"))
            text_format(out, "  %s %s\n", n->name, all.tied ? "not kept: " : "kept");
        else
            continue;
        if (all.tied)
            text_format(out, "    %s\n", all.tied);
    }
}

void dump_order(const program *p, text *out)
{
    for (uint32_t i = 0; i < p->graph_count; i++) {
        const graph *g = p->graphs[i];
        text_format(out, "graph %s%s\n", g->name, g == p->main ? " main" : "");
        dump_nodes(g, out);
        dump_cyclic_edges(g, out);
        dump_regions(g, out);
        dump_surrogates(p, g, out);
    }
}

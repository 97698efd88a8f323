/* order.c - the order of execution: cyclic edges, ranks, regions.
 *
 * Needs check without errors; gives edge.cyclic, node.rank, graph.order and graph.regions; keeps
 * the rest. Nothing here recurses: graphs may be as deep as they are long. */
#include "compiler.h"
#include "placement.h"

/* ---- edges by node --------------------------------------------------------------------------- */

static bool counts(const edge *e, bool with_cyclic)
{
    return !e->disabled && (with_cyclic || !e->cyclic);
}

successors successors_of(arena *a, const graph *g, bool with_cyclic)
{
    successors s = {.count = g->node_count};
    uint32_t total = 0;
    for (uint32_t i = 0; i < g->node_count; i++) {
        for (uint32_t k = 0; k < g->nodes[i]->output_count; k++) {
            total += g->nodes[i]->outputs[k].edge_count;
        }
    }
    s.first = ARENA_ARRAY(a, uint32_t, g->node_count + 1);
    s.edges = ARENA_ARRAY(a, edge *, total);
    total = 0;
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        s.first[i] = total;
        for (uint32_t k = 0; k < n->output_count; k++) {
            for (uint32_t j = 0; j < n->outputs[k].edge_count; j++) {
                edge *e = n->outputs[k].edges[j];
                if (counts(e, with_cyclic)) {
                    s.edges[total++] = e;
                }
            }
        }
    }
    s.first[g->node_count] = total;
    return s;
}

/* ---- depth-first search ---------------------------------------------------------------------- */

enum { UNSEEN, ON_PATH, DONE };

typedef struct search {
    const successors *s;
    uint8_t *state;   /* of each node */
    uint32_t *cursor; /* edges of each node that were followed */
    uint32_t *path;   /* from the root to where the search is */
    uint32_t depth;
    uint32_t *finished; /* nodes as they were finished */
    uint32_t finished_count;
    bool backwards; /* follows a node's last edge first */
    bool mark;      /* marks edges that lead back to the path as cyclic */
} search;

static search search_new(arena *a, const successors *s)
{
    search d = {.s = s};
    d.state = ARENA_ARRAY(a, uint8_t, s->count);
    d.cursor = ARENA_ARRAY(a, uint32_t, s->count);
    d.path = ARENA_ARRAY(a, uint32_t, s->count);
    d.finished = ARENA_ARRAY(a, uint32_t, s->count);
    return d;
}

static void enter(search *d, uint32_t n)
{
    d->state[n] = ON_PATH;
    d->path[d->depth++] = n;
}

/* Follows one more edge of the node at the end of the path, or leaves the node. */
static void step(search *d)
{
    uint32_t n = d->path[d->depth - 1];
    uint32_t first = d->s->first[n], count = d->s->first[n + 1] - first;
    if (d->cursor[n] == count) {
        d->state[n] = DONE;
        d->finished[d->finished_count++] = n;
        d->depth--;
        return;
    }
    uint32_t k = d->cursor[n]++;
    edge *e = d->s->edges[first + (d->backwards ? count - 1 - k : k)];
    uint32_t to = e->to->node->index;
    if (d->state[to] == UNSEEN) {
        enter(d, to);
    } else if (d->state[to] == ON_PATH && d->mark) {
        e->cyclic = true;
    }
}

static void search_all(search *d)
{
    for (uint32_t i = 0; i < d->s->count; i++) {
        uint32_t root = d->backwards ? d->s->count - 1 - i : i;
        if (d->state[root] == UNSEEN) {
            enter(d, root);
        }
        while (d->depth > 0) {
            step(d);
        }
    }
}

/* From each node in order of appearance, along its ports in order: what leads back to where the
 * search came through is cyclic. */
static void find_cyclic_edges(arena *a, const graph *g)
{
    for (uint32_t i = 0; i < g->edge_count; i++) {
        g->edges[i]->cyclic = false;
    }
    successors all = successors_of(a, g, true);
    search d = search_new(a, &all);
    d.mark = true;
    search_all(&d);
}

/* The nodes such that no edge leads backwards; searched from behind, so that the first of a
 * node's ports, and the first nodes of the text, come first. */
static uint32_t *topological_order(arena *a, const successors *s)
{
    search d = search_new(a, s);
    d.backwards = true;
    search_all(&d);
    for (uint32_t i = 0, k = s->count; i + 1 < k; i++) {
        uint32_t swap = d.finished[--k];
        d.finished[k] = d.finished[i];
        d.finished[i] = swap;
    }
    return d.finished;
}

/* ---- regions --------------------------------------------------------------------------------- */

/* The furthest rank that a cyclic edge into each rank comes from; the rank itself where there is
 * none. `looped`: a cyclic edge enters there. */
static uint32_t *cycle_ends(arena *a, const graph *g, bool *looped)
{
    uint32_t *end = ARENA_ARRAY(a, uint32_t, g->node_count);
    for (uint32_t i = 0; i < g->node_count; i++) {
        end[i] = i;
    }
    for (uint32_t i = 0; i < g->edge_count; i++) {
        const edge *e = g->edges[i];
        if (e->cyclic) {
            uint32_t from = e->from->node->rank, to = e->to->node->rank;
            looped[to] = true;
            end[to] = from > end[to] ? from : end[to];
        }
    }
    return end;
}

/* Cuts the order into cyclic regions, each the span of cycles that overlap, and what lies
 * between them. */
static void find_regions(arena *a, graph *g)
{
    bool *looped = ARENA_ARRAY(a, bool, g->node_count);
    const uint32_t *end = cycle_ends(a, g, looped);
    LIST(region) regions = {0};
    for (uint32_t rank = 0; rank < g->node_count;) {
        region r = {.first = rank, .last = rank, .cyclic = looped[rank]};
        for (uint32_t next = rank; next <= r.last; next++) {
            r.last = end[next] > r.last ? end[next] : r.last;
            if (!r.cyclic && next + 1 < g->node_count && !looped[next + 1]) {
                r.last = next + 1;
            }
        }
        LIST_ADD(a, &regions, r);
        rank = r.last + 1;
    }
    g->regions = regions.at;
    g->region_count = regions.count;
}

void order(compilation *c, program *p)
{
    (void)c;
    for (uint32_t i = 0; i < p->graph_count; i++) {
        graph *g = p->graphs[i];
        find_cyclic_edges(p->arena, g);
        successors s = successors_of(p->arena, g, false);
        place_nodes(p->arena, g, &s, topological_order(p->arena, &s));
        find_regions(p->arena, g);
    }
}

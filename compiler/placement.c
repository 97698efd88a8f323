/* placement.c - places a graph's nodes in order; placement.h says by which rules. */
#include "placement.h"
#include "precedence.h"

/* Beyond this many pairs, a port's targets come before the next port's through a vertex of its
 * own between them: one void demand then voids more, but there are only as many as there are
 * edges. */
enum { MAX_PAIRS = 64 };

/* ---- rules 1 to 3: what must come before what ------------------------------------------------ */

/* Vertices 0 … nodes - 1 are nodes, those behind them stand between the targets of two ports. */
typedef struct demands {
    arena *arena;
    const graph *graph;
    const successors *s;
    precedence relation;
    uint32_t between; /* the next vertex to stand between ports */
} demands;

/* A stretch of a node's edges: those of one port. */
typedef struct port_edges {
    edge *const *at;
    uint32_t count;
} port_edges;

/* The edges of the port that edge `k` belongs to, from there on; `end` is behind the node's last
 * edge. */
static port_edges edges_of_port(const successors *s, uint32_t k, uint32_t end)
{
    port_edges p = {&s->edges[k], 0};
    while (k + p.count < end && p.at[p.count]->from == p.at[0]->from) {
        p.count++;
    }
    return p;
}

static uint32_t target(const edge *e)
{
    return e->to->node->index;
}

static bool few_pairs(port_edges a, port_edges b)
{
    return (uint64_t)a.count * b.count <= MAX_PAIRS;
}

static void demand_ports(demands *d, port_edges earlier, port_edges later)
{
    if (few_pairs(earlier, later)) {
        for (uint32_t i = 0; i < earlier.count; i++) {
            for (uint32_t k = 0; k < later.count; k++) {
                precedence_add(&d->relation, target(earlier.at[i]), target(later.at[k]));
            }
        }
        return;
    }
    uint32_t between = d->between++;
    for (uint32_t k = 0; k < later.count; k++) {
        precedence_add(&d->relation, between, target(later.at[k]));
    }
    for (uint32_t i = 0; i < earlier.count; i++) {
        precedence_add(&d->relation, target(earlier.at[i]), between);
    }
}

/* Calls `demand` for each two consecutive connected ports of every node; counts those with many
 * pairs. */
static uint32_t visit_ports(demands *d, void (*demand)(demands *d, port_edges a, port_edges b))
{
    uint32_t many = 0;
    for (uint32_t n = 0; n < d->s->count; n++) {
        port_edges earlier = {NULL, 0};
        for (uint32_t k = d->s->first[n], end = d->s->first[n + 1]; k < end; k += earlier.count) {
            port_edges later = edges_of_port(d->s, k, end);
            if (earlier.count && demand) {
                demand(d, earlier, later);
            }
            many += earlier.count && !few_pairs(earlier, later);
            earlier = later;
        }
    }
    return many;
}

static void demand_edges(demands *d)
{
    for (uint32_t n = 0; n < d->s->count; n++) {
        for (uint32_t k = d->s->first[n]; k < d->s->first[n + 1]; k++) {
            precedence_add(&d->relation, n, target(d->s->edges[k]));
        }
    }
}

static void demand_feeders(demands *d)
{
    for (uint32_t n = 0; n < d->s->count; n++) {
        const node *to = d->graph->nodes[n];
        for (uint32_t k = 0; k < to->input_count; k++) {
            const edge *last = NULL;
            for (uint32_t i = 0; i < to->inputs[k].edge_count; i++) {
                const edge *e = to->inputs[k].edges[i];
                if (e->disabled || e->cyclic) {
                    continue;
                }
                if (last) {
                    precedence_add(&d->relation, last->from->node->index, e->from->node->index);
                }
                last = e;
            }
        }
    }
}

static demands demands_new(arena *a, const graph *g, const successors *s,
                           const uint32_t *topological)
{
    demands d = {.arena = a, .graph = g, .s = s, .between = s->count};
    uint32_t count = s->count + visit_ports(&d, NULL);
    uint32_t *at = ARENA_ARRAY(a, uint32_t, count);
    for (uint32_t i = 0; i < count; i++) {
        at[i] = i < s->count ? topological[i] : i;
    }
    d.relation = precedence_new(a, at, count);
    demand_edges(&d);
    visit_ports(&d, demand_ports);
    demand_feeders(&d);
    return d;
}

/* ---- rules 4 and 5: what comes next ---------------------------------------------------------- */

/* What became possible through one port of a node, and has not been placed: a heap by order of
 * appearance. Groups form a stack, the innermost on top; when nothing in it may come next, it
 * becomes part of the one below. */
typedef struct group {
    LIST(uint32_t) heap;
    uint32_t below;  /* the group that it stands on; itself for the lowest */
    uint32_t merged; /* the group that it has become part of; itself while it stands */
} group;

typedef struct placement {
    arena *arena;
    const graph *graph;
    const successors *s;
    const precedence *relation;
    uint32_t *edges_left;   /* of each node: edges into it whose source has not been placed */
    uint32_t *demands_left; /* of each vertex: demands whose first end has not been placed */
    uint32_t *home;         /* of each node whose edges_left is 0: its group */
    LIST(group) groups;
    uint32_t top;
    uint32_t placed;
    LIST(uint32_t) released; /* vertices between ports whose demands are met */
} placement;

static uint32_t standing(placement *p, uint32_t g)
{
    while (p->groups.at[g].merged != g) {
        uint32_t next = p->groups.at[g].merged;
        p->groups.at[g].merged = p->groups.at[next].merged;
        g = next;
    }
    return g;
}

static uint32_t push_group(placement *p, uint32_t below)
{
    group g = {.below = below, .merged = p->groups.count};
    LIST_ADD(p->arena, &p->groups, g);
    return p->groups.count - 1;
}

static void heap_add(placement *p, group *g, uint32_t n)
{
    LIST_ADD(p->arena, &g->heap, n);
    uint32_t i = g->heap.count - 1;
    for (; i > 0 && g->heap.at[(i - 1) / 2] > n; i = (i - 1) / 2) {
        g->heap.at[i] = g->heap.at[(i - 1) / 2];
    }
    g->heap.at[i] = n;
}

static uint32_t heap_take(group *g)
{
    uint32_t first = g->heap.at[0], last = g->heap.at[--g->heap.count], i = 0;
    for (uint32_t child = 1; child < g->heap.count; child = 2 * i + 1) {
        if (child + 1 < g->heap.count && g->heap.at[child + 1] < g->heap.at[child]) {
            child++;
        }
        if (g->heap.at[child] > last) {
            break;
        }
        g->heap.at[i] = g->heap.at[child];
        i = child;
    }
    g->heap.at[i] = last;
    return first;
}

static void demand_met(placement *p, uint32_t vertex)
{
    if (--p->demands_left[vertex] > 0) {
        return;
    }
    if (vertex >= p->s->count) {
        LIST_ADD(p->arena, &p->released, vertex);
    } else {
        heap_add(p, &p->groups.at[standing(p, p->home[vertex])], vertex);
    }
}

static void meet_demands(placement *p, uint32_t vertex)
{
    const precedence *r = p->relation;
    LIST_ADD(p->arena, &p->released, vertex);
    while (p->released.count > 0) {
        uint32_t v = p->released.at[--p->released.count];
        for (uint32_t l = r->out[v]; l != PRECEDENCE_NONE; l = r->links.at[l].next_out) {
            demand_met(p, r->links.at[l].to);
        }
    }
}

static bool has_several_ports(const successors *s, uint32_t n)
{
    uint32_t first = s->first[n], end = s->first[n + 1];
    return end > first && s->edges[first]->from != s->edges[end - 1]->from;
}

/* Makes a group of its own for each connected port of the node, the first on top. */
static void push_ports(placement *p, uint32_t n)
{
    const port *last = NULL;
    for (uint32_t k = p->s->first[n + 1]; k-- > p->s->first[n];) {
        if (p->s->edges[k]->from != last) {
            p->top = push_group(p, p->top);
        }
        last = p->s->edges[k]->from;
    }
}

static void place(placement *p, uint32_t n)
{
    const successors *s = p->s;
    p->graph->nodes[n]->rank = p->placed;
    p->graph->order[p->placed++] = p->graph->nodes[n];
    bool several = has_several_ports(s, n);
    if (several) {
        push_ports(p, n);
    }
    uint32_t home = p->top;
    for (uint32_t k = s->first[n]; k < s->first[n + 1]; k++) {
        if (several && k > s->first[n] && s->edges[k]->from != s->edges[k - 1]->from) {
            home = p->groups.at[home].below;
        }
        uint32_t to = target(s->edges[k]);
        if (--p->edges_left[to] == 0) {
            p->home[to] = home;
        }
    }
    meet_demands(p, n);
}

static void count_what_is_left(placement *p)
{
    const precedence *r = p->relation;
    for (uint32_t k = 0; k < p->s->first[p->s->count]; k++) {
        p->edges_left[target(p->s->edges[k])]++;
    }
    for (uint32_t i = 0; i < r->links.count; i++) {
        p->demands_left[r->links.at[i].to]++;
    }
}

/* What nothing comes before is in the lowest group. Vertices between ports that nothing comes
 * before hold nobody up: their demands are met at once. */
static void begin(placement *p)
{
    count_what_is_left(p);
    p->top = push_group(p, 0);
    for (uint32_t n = 0; n < p->s->count; n++) {
        if (p->demands_left[n] == 0) {
            heap_add(p, &p->groups.at[0], n);
        }
    }
    for (uint32_t v = p->s->count; v < p->relation->count; v++) {
        if (p->demands_left[v] == 0) {
            meet_demands(p, v);
        }
    }
}

void place_nodes(arena *a, graph *g, const successors *s, uint32_t *topological)
{
    demands d = demands_new(a, g, s, topological);
    placement p = {.arena = a, .graph = g, .s = s, .relation = &d.relation};
    p.edges_left = ARENA_ARRAY(a, uint32_t, s->count);
    p.demands_left = ARENA_ARRAY(a, uint32_t, d.relation.count);
    p.home = ARENA_ARRAY(a, uint32_t, s->count);
    g->order = ARENA_ARRAY(a, node *, s->count);
    begin(&p);
    while (p.placed < s->count) {
        group *top = &p.groups.at[p.top];
        if (top->heap.count > 0) {
            place(&p, heap_take(top));
        } else {
            top->merged = top->below;
            p.top = top->below;
        }
    }
}

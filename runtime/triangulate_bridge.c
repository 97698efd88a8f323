/* triangulate_bridge.c - makes one ring of a polygon and its holes.
 *
 * Holes are taken from left to right. From a hole's leftmost node a ray goes left; the first edge
 * that it meets, and whatever stands between that edge and the ray, give a node that can be seen.
 * All comparisons are exact: the ray is taken to run just above the node's own y, so that no edge
 * is met at its end. After D. Eberly, Triangulation by Ear Clipping, 2002.
 */
#include <math.h>
#include <stdlib.h>

#include "runtime/triangulate.h"

/* ---- rows ------------------------------------------------------------------------------------ */

static uint32_t row_of(const row_index *rows, double y)
{
    double row = (y - rows->low) * rows->scale;

    if (!(row > 0))
        return 0;
    return row < rows->row_count ? (uint32_t)row : rows->row_count - 1;
}

static void row_span(const pcg_triangulator *t, uint32_t n, uint32_t *first, uint32_t *last)
{
    double a = t->nodes[n].at.y, b = t->nodes[t->nodes[n].after].at.y;

    *first = row_of(&t->rows, a < b ? a : b);
    *last = row_of(&t->rows, a < b ? b : a);
}

static bool rows_add(pcg_triangulator *t, uint32_t n)
{
    row_index *rows = &t->rows;
    uint32_t first, last;

    row_span(t, n, &first, &last);
    if (!triangulator_reserve((void **)&rows->entry, &rows->entry_capacity,
                              (size_t)rows->entry_count + (last - first) + 1, sizeof *rows->entry))
        return false;
    for (uint32_t row = first; row <= last; row++) {
        rows->entry[rows->entry_count] = (struct row_entry){n, rows->row[row]};
        rows->row[row] = rows->entry_count++;
    }
    return true;
}

static bool rows_add_ring(pcg_triangulator *t, uint32_t first)
{
    uint32_t n = first;

    do {
        if (!rows_add(t, n))
            return false;
        n = t->nodes[n].after;
    } while (n != first);
    return true;
}

/* As many rows as keep the number of entries at a few per edge. */
static bool rows_open(pcg_triangulator *t)
{
    row_index *rows = &t->rows;
    double low = t->nodes[0].at.y, high = low, sum = 0, count = 1;

    for (uint32_t i = 0; i < t->node_count; i++) {
        double y = t->nodes[i].at.y;

        low = y < low ? y : low;
        high = y > high ? y : high;
        sum += fabs(y - t->nodes[t->nodes[i].after].at.y);
    }
    if (sum > 0 && isfinite(sum))
        count = 3.0 * t->node_count * ((high - low) / sum);
    rows->row_count = count < 1 ? 1 : count < t->node_count ? (uint32_t)count : t->node_count;
    rows->low = low;
    rows->scale = high > low ? rows->row_count / (high - low) : 0;
    rows->entry_count = 0;
    if (!triangulator_reserve((void **)&rows->row, &rows->row_capacity, rows->row_count,
                              sizeof *rows->row))
        return false;
    for (uint32_t i = 0; i < rows->row_count; i++)
        rows->row[i] = NONE;
    return true;
}

/* ---- what can be seen ------------------------------------------------------------------------ */

/* Of two edges that go down through the ray and do not cross: whether `b` meets it nearer to its
 * origin, which is on the right. They are compared at the highest of their lower ends, or the
 * lowest of their upper ends. */
static bool is_nearer(const pcg_triangulator *t, uint32_t a, uint32_t b)
{
    const node *a_high = &t->nodes[a], *a_low = &t->nodes[a_high->after];
    const node *b_high = &t->nodes[b], *b_low = &t->nodes[b_high->after];
    double side;

    side = b_low->at.y >= a_low->at.y ? orientation(a_high->at, a_low->at, b_low->at)
                                      : -orientation(b_high->at, b_low->at, a_low->at);
    if (side == 0)
        side = b_high->at.y <= a_high->at.y ? orientation(a_high->at, a_low->at, b_high->at)
                                            : -orientation(b_high->at, b_low->at, a_high->at);
    return side > 0;
}

/* The edge (its first node) that a ray from `from` to the left meets first; NONE where there is
 * none. */
static uint32_t edge_on_the_left(const pcg_triangulator *t, pcg_vec2 from)
{
    uint32_t best = NONE;

    for (uint32_t e = t->rows.row[row_of(&t->rows, from.y)]; e != NONE; e = t->rows.entry[e].next) {
        uint32_t n = t->rows.entry[e].node;
        pcg_vec2 high = t->nodes[n].at, low = t->nodes[t->nodes[n].after].at;

        if (!(high.y > from.y && low.y <= from.y) || orientation(high, low, from) < 0)
            continue;
        if (best == NONE || is_nearer(t, best, n))
            best = n;
    }
    return best;
}

/* Whether a point near a node is inside the ring there. */
static bool is_in_cone(const pcg_triangulator *t, uint32_t n, pcg_vec2 p)
{
    const node *v = &t->nodes[n];
    pcg_vec2 a = t->nodes[v->before].at, c = t->nodes[v->after].at;
    bool left_of_in = orientation(a, v->at, p) >= 0, left_of_out = orientation(v->at, c, p) >= 0;

    return orientation(a, v->at, c) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

/* What is looked for: from where, and the triangle (from, high, low) on one side of the ray. */
typedef struct view {
    pcg_vec2 from;
    pcg_vec2 high, low; /* the edge that the ray met */
    bool upward;        /* which part of the triangle */
    uint32_t best;
} view;

static bool is_in_view(const view *w, pcg_vec2 p)
{
    if (w->upward ? p.y < w->from.y : p.y > w->from.y)
        return false;
    return orientation(w->high, w->low, p) >= 0 && orientation(w->from, w->high, p) >= 0 &&
           orientation(w->low, w->from, p) >= 0;
}

/* Whether `p` is seen nearer to the ray than `q` is, or in the same direction and nearer. */
static bool is_before(const view *w, pcg_vec2 p, pcg_vec2 q)
{
    double turn = orientation(w->from, q, p);

    if (turn != 0)
        return w->upward ? turn > 0 : turn < 0;
    return fabs(p.x - w->from.x) + fabs(p.y - w->from.y) <
           fabs(q.x - w->from.x) + fabs(q.y - w->from.y);
}

static void consider(const pcg_triangulator *t, view *w, uint32_t n)
{
    const node *v = &t->nodes[n];

    if ((v->at.x == w->from.x && v->at.y == w->from.y) || !is_in_view(w, v->at) ||
        !is_in_cone(t, n, w->from))
        return;
    if (w->best == NONE || is_before(w, v->at, t->nodes[w->best].at))
        w->best = n;
}

/* A node of the ring that the leftmost node of a hole sees; NONE where the hole is outside. */
static uint32_t node_in_sight(const pcg_triangulator *t, uint32_t hole)
{
    view w = {.from = t->nodes[hole].at, .best = NONE};
    uint32_t edge = edge_on_the_left(t, w.from), end, first, last;

    if (edge == NONE)
        return NONE;
    w.high = t->nodes[edge].at;
    w.low = t->nodes[t->nodes[edge].after].at;
    w.upward =
        w.high.x <= w.low.x; /* the end on the left: all that is in view is left of the hole */
    end = w.upward ? edge : t->nodes[edge].after;
    first = row_of(&t->rows, w.from.y);
    last = row_of(&t->rows, t->nodes[end].at.y);
    if (first > last) {
        uint32_t swap = first;

        first = last;
        last = swap;
    }
    for (uint32_t row = first; row <= last; row++)
        for (uint32_t e = t->rows.row[row]; e != NONE; e = t->rows.entry[e].next)
            consider(t, &w, t->rows.entry[e].node);
    return w.best != NONE ? w.best : end;
}

/* ---- joining --------------------------------------------------------------------------------- */

/* The hole's node is where `v` is: before -> h … -> v. */
static void splice_at_node(pcg_triangulator *t, uint32_t v, uint32_t h)
{
    node *nodes = t->nodes;
    uint32_t last = nodes[h].before;

    nodes[h].before = nodes[v].before;
    nodes[nodes[v].before].after = h;
    nodes[last].after = v;
    nodes[v].before = last;
}

/* The hole's node is on the edge that leaves `v`: v -> h … -> h2 -> after. */
static bool splice_in_edge(pcg_triangulator *t, uint32_t v, uint32_t h)
{
    uint32_t h2 = triangulator_twin(t, h), last = t->nodes[h].before, after = t->nodes[v].after;
    node *nodes = t->nodes;

    nodes[v].after = h;
    nodes[h].before = v;
    nodes[last].after = h2;
    nodes[h2].before = last;
    nodes[h2].after = after;
    nodes[after].before = h2;
    return rows_add(t, h2);
}

/* before -> v2 -> h … -> h2 -> v: both keep the edge that leaves them, so that rows stay true. */
static bool join(pcg_triangulator *t, uint32_t v, uint32_t h)
{
    uint32_t v2 = triangulator_twin(t, v), h2 = triangulator_twin(t, h);
    node *nodes = t->nodes;

    nodes[v2].before = nodes[v].before;
    nodes[nodes[v].before].after = v2;
    nodes[h2].before = nodes[h].before;
    nodes[nodes[h].before].after = h2;
    nodes[v2].after = h;
    nodes[h].before = v2;
    nodes[h2].after = v;
    nodes[v].before = h2;
    return rows_add(t, v2) && rows_add(t, h2);
}

static int compare_places(const node *a, const node *b)
{
    if (a->at.x != b->at.x)
        return a->at.x < b->at.x ? -1 : 1;
    if (a->at.y != b->at.y)
        return a->at.y < b->at.y ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

/* Heap sort, since the order depends on the nodes, which qsort could not see. */
static void sift(const node *nodes, uint32_t *heap, uint32_t at, uint32_t count)
{
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        uint32_t top = heap[at];

        if (child + 1 < count && compare_places(&nodes[heap[child]], &nodes[heap[child + 1]]) < 0)
            child++;
        if (compare_places(&nodes[top], &nodes[heap[child]]) >= 0)
            return;
        heap[at] = heap[child];
        heap[child] = top;
    }
}

static void sort_by_place(const node *nodes, uint32_t *list, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0;)
        sift(nodes, list, i, count);
    for (uint32_t end = count; end-- > 1;) {
        uint32_t last = list[end];

        list[end] = list[0];
        list[0] = last;
        sift(nodes, list, 0, end);
    }
}

static bool is_between(pcg_vec2 a, pcg_vec2 b, pcg_vec2 p)
{
    return orientation(a, b, p) == 0 && p.x >= fmin(a.x, b.x) && p.x <= fmax(a.x, b.x) &&
           p.y >= fmin(a.y, b.y) && p.y <= fmax(a.y, b.y);
}

/* How a hole can be joined to the ring: at which node, and how. */
typedef enum joint { OUTSIDE, AT_NODE, IN_EDGE, IN_SIGHT } joint;

/* The hole's node touches the ring: the ray would say nothing about it. */
static joint find_touching(const pcg_triangulator *t, uint32_t h, uint32_t *at)
{
    pcg_vec2 place = t->nodes[h].at, toward = t->nodes[t->nodes[h].after].at;
    joint found = OUTSIDE;

    for (uint32_t e = t->rows.row[row_of(&t->rows, place.y)]; e != NONE;
         e = t->rows.entry[e].next) {
        uint32_t n = t->rows.entry[e].node;
        const node *v = &t->nodes[n], *end = &t->nodes[v->after];

        if (same_place(v, &t->nodes[h])) {
            if (is_in_cone(t, n, toward)) {
                *at = n;
                return AT_NODE;
            }
        } else if (!same_place(end, &t->nodes[h]) && is_between(v->at, end->at, place) &&
                   orientation(v->at, end->at, toward) >= 0) {
            *at = n;
            found = IN_EDGE;
        }
    }
    return found;
}

static joint find_joint(const pcg_triangulator *t, uint32_t h, uint32_t *at)
{
    joint found = find_touching(t, h, at);

    if (found != OUTSIDE)
        return found;
    *at = node_in_sight(t, h);
    return *at != NONE ? IN_SIGHT : OUTSIDE;
}

static bool join_hole(pcg_triangulator *t, uint32_t h)
{
    uint32_t at;
    joint how = find_joint(t, h, &at);

    if (how == OUTSIDE)
        return true;
    if (!rows_add_ring(t, h))
        return false;
    if (how == AT_NODE)
        splice_at_node(t, at, h);
    return how == AT_NODE || (how == IN_EDGE ? splice_in_edge(t, at, h) : join(t, at, h));
}

bool triangulator_bridge(pcg_triangulator *t, uint32_t outline)
{
    if (!rows_open(t) || !rows_add_ring(t, outline))
        return false;
    sort_by_place(t->nodes, t->hole, t->hole_count);
    for (uint32_t i = 0; i < t->hole_count; i++)
        if (!join_hole(t, t->hole[i]))
            return false;
    return true;
}

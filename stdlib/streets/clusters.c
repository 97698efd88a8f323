/* clusters.c - up to where streets are in each other's way where they meet.
 *
 * From each node on, the pieces of a link are followed as long as they overlap with others of
 * the node. Of two that run side by side for long, the one of lower rank yields: the other's
 * stub does not go farther than some widths, and what still overlaps it is taken from the
 * crossing, not from the street. A link whose stubs leave nothing between them is all stub, and
 * makes its two nodes one cluster, where all is followed again.
 */
#include <math.h>
#include <string.h>

#include "layout.h"

/* In widths: how far a stub may go beside what it does not yield to, both taken together; how long
 * it must be clear to be taken for clear; what has to be left between two stubs. */
static const double longest_stub = 2, clear_stretch = 0.5, least_street = 0.25;

/* In metres: a shorter overlap is rounding; stubs, and what is left of a piece, are not shorter
 * than the step. */
static const double least_overlap = 1e-5, least_step = 0.01;

enum { ROUNDS_MAX = 1000 };

typedef struct clusterer {
    layout *l;
    int band;
    uint32_t *cluster; /* of each vertex, a forest */
    bool *changed;     /* of the vertices that stand for clusters: to be done again */
    bool *merged;      /* likewise: it has several nodes */
} clusterer;

static uint32_t root(uint32_t *cluster, uint32_t at)
{
    while (cluster[at] != at) {
        cluster[at] = cluster[cluster[at]];
        at = cluster[at];
    }
    return at;
}

uint32_t cluster_of(const layout *l, int band, uint32_t vertex)
{
    return root(l->cluster[band], vertex);
}

static double width_of(const clusterer *c, const street_link *k)
{
    const street_way *w = &c->l->way[k->way];

    return c->band == CORRIDOR ? w->width + w->left + w->right : w->width;
}

/* Whether the first of two links goes on where both cannot: the wider, then the longer one. */
static bool goes_first(const clusterer *c, const street_link *a, const street_link *b)
{
    double v = width_of(c, a), w = width_of(c, b), r = link_length(c->l, a),
           s = link_length(c->l, b);

    if (v < w || v > w)
        return v > w;
    if (r < s || r > s)
        return r > s;
    return a < b;
}

/* ---- stubs ----------------------------------------------------------------------------------- */

/* A link as it is followed from one of its ends. */
typedef struct walk {
    const street_link *k;
    uint32_t end;
    double length; /* of the stub so far */
} walk;

/* How far from the walk's end a share of a piece is. */
static double distance_of(const layout *l, const walk *w, uint32_t piece, double share)
{
    double arc = l->arc[piece] + (l->arc[piece + 1] - l->arc[piece]) * share;

    return w->end == 0 ? arc : link_length(l, w->k) - arc;
}

/* Lengthens the stub by one overlap; true when it did. */
static bool lengthen(const clusterer *c, walk *w, uint32_t use, uint32_t home)
{
    const layout *l = c->l;
    const overlap *o = &l->overlaps[c->band].at[use / 2];
    uint32_t own = use % 2, piece = o->piece[own];
    const street_link *other = &l->link[l->link_of[o->piece[1 - own]]];
    double a = distance_of(l, w, piece, o->low[own]), b = distance_of(l, w, piece, o->high[own]);
    double from = fmin(a, b), to = fmax(a, b), width = width_of(c, w->k);

    bool at_begin = root(c->cluster, other->node[0]) == home;
    bool at_end = root(c->cluster, other->node[1]) == home;

    /* A link is in its own way only where it is a loop. */
    if (!(other == w->k ? at_begin && at_end : at_begin || at_end) ||
        from > w->length + clear_stretch * width || to <= fmax(w->length, least_overlap))
        return false;
    if (other != w->k && goes_first(c, w->k, other)) {
        double longest = longest_stub * (width + width_of(c, other));

        if (to > longest)
            to = longest;
    }
    if (to <= fmax(w->length, least_overlap))
        return false;
    w->length = to;
    return true;
}

/* Where streets meet each has some stub, so that the crossing has its end as a side, whatever else
 * covers. What the widths of the two arms of a change of width differ by is levelled over that
 * length. */
static double least_stub(const clusterer *c, uint32_t node, const street_link *k)
{
    const layout *l = c->l;
    const arm *arms = &l->arm[l->arm_begin[node]];
    double least = 0.1;

    if (!c->merged[root(c->cluster, node)] && l->kind[node] != NODE_CROSSING &&
        l->kind[node] != NODE_CHANGE)
        return 0;
    if (l->kind[node] == NODE_CHANGE)
        least = fmax(
            least,
            fabs(width_of(c, &l->link[arms[0].link]) - width_of(c, &l->link[arms[1].link])) / 2);
    return fmin(least, link_length(l, k) / 4);
}

static double stub_length(const clusterer *c, const street_link *k, uint32_t end)
{
    const overlaps *o = &c->l->overlaps[c->band];
    uint32_t home = root(c->cluster, k->node[end]), last = link_last(k);
    walk w = {k, end, least_stub(c, k->node[end], k)};
    double clear = clear_stretch * width_of(c, k);

    for (uint32_t i = 0; i < last; i++) {
        uint32_t piece = k->first + (end == 0 ? i : last - 1 - i);
        bool longer = true;

        if (distance_of(c->l, &w, piece, end == 0 ? 0 : 1) > w.length + clear)
            break;
        while (longer) {
            longer = false;
            for (uint32_t u = o->begin[piece]; u < o->begin[piece + 1]; u++)
                longer = lengthen(c, &w, o->of[u], home) || longer;
        }
    }
    return w.length;
}

/* The station at a distance from a link's begin. It is at a point, or away from it. */
static double station_at(const layout *l, const street_link *k, double distance, bool onward)
{
    const double *arc = &l->arc[k->first];
    uint32_t low = 0, high = link_last(k);

    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;

        if (arc[middle] <= distance)
            low = middle;
        else
            high = middle;
    }
    if (distance - arc[low] < least_step)
        distance =
            onward && distance > arc[low] ? fmin(arc[low] + least_step, arc[high]) : arc[low];
    if (arc[high] - distance < least_step)
        distance =
            onward || !(distance < arc[high]) ? arc[high] : fmax(arc[high] - least_step, arc[low]);
    if (distance <= arc[low])
        return low;
    return distance < arc[high] ? low + (distance - arc[low]) / (arc[high] - arc[low]) : high;
}

/* ---- clusters -------------------------------------------------------------------------------- */

static void join(clusterer *c, uint32_t a, uint32_t b)
{
    a = root(c->cluster, a);
    b = root(c->cluster, b);
    c->cluster[a > b ? a : b] = a > b ? b : a;
    c->changed[a > b ? b : a] = c->merged[a > b ? b : a] = true;
}

/* Finds the stations of a link; true when it turned out to be all stub. */
static bool place_stubs(clusterer *c, street_link *k)
{
    double length = link_length(c->l, k);
    double from = stub_length(c, k, 0), to = length - stub_length(c, k, 1);

    if (c->band == CORRIDOR) { /* which is nowhere less than the roadway */
        from = fmax(from, arc_at(c->l, k, k->station[ROADWAY][0]));
        to = fmin(to, arc_at(c->l, k, k->station[ROADWAY][1]));
    }
    k->internal[c->band] =
        (c->band == CORRIDOR && k->internal[ROADWAY]) ||
        ((from > 0 || to < length) && to - from < fmin(least_street * width_of(c, k), length / 2));
    if (k->internal[c->band])
        return true;
    k->station[c->band][0] = station_at(c->l, k, from, true);
    k->station[c->band][1] = station_at(c->l, k, to, false);
    return false;
}

/* One round; *again says whether clusters grew. */
static int place_all(clusterer *c, bool *now, bool *again)
{
    layout *l = c->l;

    memcpy(now, c->changed, l->drawing->vertices * sizeof *now);
    memset(c->changed, 0, l->drawing->vertices * sizeof *now);
    *again = false;
    for (uint32_t i = 0; i < l->links; i++) {
        street_link *k = &l->link[i];
        int status;

        if (k->internal[c->band] ||
            (!now[root(c->cluster, k->node[0])] && !now[root(c->cluster, k->node[1])]))
            continue;
        status = pcg_tick(l->call);
        if (status != PCG_OK)
            return status;
        if (!place_stubs(c, k))
            continue;
        *again = true;
        join(c, k->node[0], k->node[1]);
    }
    return PCG_OK;
}

static int place_rounds(clusterer *c, bool *now)
{
    bool again = true;
    int status = PCG_OK;

    for (int round = 0; round < ROUNDS_MAX && again && status == PCG_OK; round++)
        status = place_all(c, now, &again);
    return status;
}

int layout_find_clusters(layout *l, int band)
{
    size_t vertices = l->drawing->vertices + (size_t)1;
    clusterer c = {.l = l, .band = band};
    bool *now = run_alloc(l->run, vertices * sizeof *now);
    int status = PCG_FAILED;

    c.changed = run_alloc(l->run, vertices * sizeof *c.changed);
    c.cluster = l->cluster[band] = run_alloc(l->run, vertices * sizeof *c.cluster);
    c.merged = run_alloc_zeroed(l->run, vertices * sizeof *c.merged);
    if (now != NULL && c.changed != NULL && c.merged != NULL && c.cluster != NULL) {
        for (uint32_t i = 0; i < vertices; i++) {
            c.cluster[i] = i;
            c.changed[i] = true;
        }
        status = place_rounds(&c, now);
    }
    run_free(l->run, now, vertices * sizeof *now);
    run_free(l->run, c.changed, vertices * sizeof *c.changed);
    run_free(l->run, c.merged, vertices * sizeof *c.merged);
    return status;
}

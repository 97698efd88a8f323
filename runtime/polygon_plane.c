/* polygon_plane.c - segments that meet at their ends only.
 *
 * Points are rounded to a grid on which all predicates are exact. Where segments cross, the
 * crossing is rounded to the grid and both are cut there; that bends them by a step at most, which
 * may make them cross others, so it is done again until nothing is left to cut. Each pass adds
 * points of a finite grid, so it ends; in practice after two or three.
 */
#include "runtime/polygon_plane.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "runtime/run.h"

enum { PASSES_MAX = 64 };

/* Half of the grid's width in steps. */
static const double half_width = 536870912.0;

/* ---- points ---------------------------------------------------------------------------------- */

static uint32_t point_slot(const plane *p, int64_t x, int64_t y)
{
    uint64_t hash = (uint64_t)x * 0x9E3779B97F4A7C15u ^ (uint64_t)y * 0xC2B2AE3D27D4EB4Fu;
    uint32_t at = (uint32_t)((hash ^ hash >> 31) * 0xD6E8FEB86659FD93u >> 32) & (p->slots - 1);

    while (p->slot[at] != 0 &&
           (p->point[p->slot[at] - 1].x != x || p->point[p->slot[at] - 1].y != y))
        at = (at + 1) & (p->slots - 1);
    return at;
}

static int grow_slots(plane *p)
{
    uint32_t *old = p->slot, old_slots = p->slots;
    uint32_t *slot =
        run_alloc_array(p->run, old_slots > 0 ? (size_t)old_slots * 2 : 64, sizeof *slot);

    if (slot == NULL)
        return PCG_FAILED;
    p->slot = slot;
    p->slots = old_slots > 0 ? old_slots * 2 : 64;
    run_free(p->run, old, old_slots * sizeof *old);
    for (uint32_t i = 0; i < p->points; i++)
        p->slot[point_slot(p, p->point[i].x, p->point[i].y)] = i + 1;
    return PCG_OK;
}

/* The point of the grid nearest to a place; UINT32_MAX: no memory. */
static uint32_t point_at(plane *p, pcg_vec2 at, bool made)
{
    int64_t x = llround((at.x - p->middle.x) / p->step),
            y = llround((at.y - p->middle.y) / p->step);
    uint32_t slot;

    if (2 * p->points >= p->slots && grow_slots(p) != PCG_OK)
        return UINT32_MAX;
    slot = point_slot(p, x, y);
    if (p->slot[slot] != 0) {
        p->changed = true;
        return p->slot[slot] - 1;
    }
    if (list_room(p->run, (void **)&p->point, &p->point_capacity, p->points, 1, sizeof *p->point) !=
        PCG_OK)
        return UINT32_MAX;
    p->point[p->points] = (grid_point){x, y, at, made};
    p->slot[slot] = ++p->points;
    return p->points - 1;
}

static int add_segment(plane *p, uint32_t a, uint32_t b, int winding)
{
    if (a == b)
        return PCG_OK;
    if (list_room(p->run, (void **)&p->segment, &p->segment_capacity, p->segments, 1,
                  sizeof *p->segment) != PCG_OK)
        return PCG_FAILED;
    p->segment[p->segments++] = a < b ? (segment){a, b, winding} : (segment){b, a, -winding};
    return PCG_OK;
}

static int compare_segments(const void *a, const void *b)
{
    const segment *s = a, *t = b;

    if (s->a != t->a)
        return s->a < t->a ? -1 : 1;
    return s->b != t->b ? (s->b < t->b ? -1 : 1) : 0;
}

/* Makes one of segments between the same points; those that loops pass as often there as back
 * go. */
static void merge_segments(plane *p)
{
    uint32_t kept = 0;

    if (p->segments > 1)
        qsort(p->segment, p->segments, sizeof *p->segment, compare_segments);
    for (uint32_t i = 0, j; i < p->segments; i = j) {
        segment s = p->segment[i];

        for (j = i + 1; j < p->segments && compare_segments(&s, &p->segment[j]) == 0; j++) {
            s.winding += p->segment[j].winding;
            p->changed = true;
        }
        if (s.winding != 0)
            p->segment[kept++] = s;
    }
    p->segments = kept;
}

/* ---- where segments meet --------------------------------------------------------------------- */

/* A segment has to be cut at a point. */
typedef struct cut {
    uint32_t segment, point;
    int64_t along; /* how far from the segment's first point, in a unit of the segment's own */
} cut;

/* Segments in order of one coordinate, so that only those that overlap in it are compared. */
typedef struct span_of {
    int64_t low, high;
    uint32_t segment;
} span_of;

typedef struct noder {
    plane *p;
    cut *cut;
    uint32_t cuts, cut_capacity;
    span_of *span;
    uint32_t span_capacity;
} noder;

static int add_cut(noder *n, uint32_t s, uint32_t point)
{
    const plane *p = n->p;
    const grid_point *a = &p->point[p->segment[s].a], *b = &p->point[p->segment[s].b],
                     *c = &p->point[point];

    if (point == p->segment[s].a || point == p->segment[s].b)
        return PCG_OK;
    if (list_room(p->run, (void **)&n->cut, &n->cut_capacity, n->cuts, 1, sizeof *n->cut) != PCG_OK)
        return PCG_FAILED;
    n->cut[n->cuts++] =
        (cut){s, point, (c->x - a->x) * (b->x - a->x) + (c->y - a->y) * (b->y - a->y)};
    return PCG_OK;
}

/* Whether a point that is on the line of a segment is between its ends. */
static bool is_between(const grid_point *a, const grid_point *b, const grid_point *c)
{
    int64_t along = (c->x - a->x) * (b->x - a->x) + (c->y - a->y) * (b->y - a->y);

    return along > 0 && along < (b->x - a->x) * (b->x - a->x) + (b->y - a->y) * (b->y - a->y);
}

/* Whether a point is no more than a step away from the line of a segment. Were it not for the step,
 * segments that nearly coincide would be cut anew in each pass: what bends them by less than that
 * makes them cross elsewhere. */
static bool is_near_line(const grid_point *a, const grid_point *b, int64_t turn)
{
    double x = (double)(b->x - a->x), y = (double)(b->y - a->y);

    return (double)turn * (double)turn <= x * x + y * y;
}

/* Cuts a segment at a point that lies on it; `turn` tells how far from its line it is. */
static int cut_at(noder *n, uint32_t s, uint32_t point, int64_t turn, bool *touch)
{
    const plane *p = n->p;
    const grid_point *a = &p->point[p->segment[s].a], *b = &p->point[p->segment[s].b];

    if (!is_near_line(a, b, turn) || !is_between(a, b, &p->point[point]))
        return PCG_OK;
    *touch = true;
    return add_cut(n, s, point);
}

static double turn_of(pcg_vec2 a, pcg_vec2 b, pcg_vec2 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* How far from c to d the segment between a and b is crossed; from the places that the points stand
 * for, which are more exact than the grid, unless those hardly cross. */
static double crossing_share(const grid_point *a, const grid_point *b, const grid_point *c,
                             const grid_point *d)
{
    double c_turn = turn_of(a->at, b->at, c->at), d_turn = turn_of(a->at, b->at, d->at);

    if (!(c_turn * d_turn < 0)) {
        c_turn = (double)grid_turn(a, b, c);
        d_turn = (double)grid_turn(a, b, d);
    }
    return c_turn / (c_turn - d_turn);
}

static int cut_crossing(noder *n, uint32_t s, uint32_t t)
{
    plane *p = n->p;
    const grid_point *a = &p->point[p->segment[t].a], *b = &p->point[p->segment[t].b];
    double share = crossing_share(&p->point[p->segment[s].a], &p->point[p->segment[s].b], a, b);
    pcg_vec2 at = {a->at.x + share * (b->at.x - a->at.x), a->at.y + share * (b->at.y - a->at.y)};
    uint32_t point = point_at(p, at, true);

    if (point == UINT32_MAX || add_cut(n, s, point) != PCG_OK)
        return PCG_FAILED;
    return add_cut(n, t, point);
}

static bool are_beside(const grid_point *a, const grid_point *b, int64_t c_turn, int64_t d_turn)
{
    return ((c_turn > 0 && d_turn > 0) || (c_turn < 0 && d_turn < 0)) &&
           !is_near_line(a, b, c_turn) && !is_near_line(a, b, d_turn);
}

static bool are_apart(int64_t a_turn, int64_t b_turn)
{
    return (a_turn > 0 && b_turn < 0) || (a_turn < 0 && b_turn > 0);
}

static int compare_pair(noder *n, uint32_t s, uint32_t t)
{
    const plane *p = n->p;
    uint32_t ends[4] = {p->segment[s].a, p->segment[s].b, p->segment[t].a, p->segment[t].b};
    const grid_point *a = &p->point[ends[0]], *b = &p->point[ends[1]], *c = &p->point[ends[2]],
                     *d = &p->point[ends[3]];
    int64_t c_turn = grid_turn(a, b, c), d_turn = grid_turn(a, b, d), a_turn, b_turn;
    bool touch = false;

    if (are_beside(a, b, c_turn, d_turn))
        return PCG_OK;
    a_turn = grid_turn(c, d, a);
    b_turn = grid_turn(c, d, b);
    if (are_beside(c, d, a_turn, b_turn))
        return PCG_OK;
    if (cut_at(n, s, ends[2], c_turn, &touch) != PCG_OK ||
        cut_at(n, s, ends[3], d_turn, &touch) != PCG_OK ||
        cut_at(n, t, ends[0], a_turn, &touch) != PCG_OK ||
        cut_at(n, t, ends[1], b_turn, &touch) != PCG_OK)
        return PCG_FAILED;
    if (touch || !are_apart(a_turn, b_turn) || !are_apart(c_turn, d_turn))
        return PCG_OK;
    return cut_crossing(n, s, t);
}

static int compare_spans(const void *a, const void *b)
{
    const span_of *s = a, *t = b;

    if (s->low != t->low)
        return s->low < t->low ? -1 : 1;
    return s->segment < t->segment ? -1 : s->segment > t->segment;
}

/* Whether segments are shorter along x than along y, on the whole. */
static bool is_short_along_x(const plane *p)
{
    double x = 0, y = 0;

    for (uint32_t i = 0; i < p->segments; i++) {
        const grid_point *a = &p->point[p->segment[i].a], *b = &p->point[p->segment[i].b];

        x += fabs((double)(b->x - a->x));
        y += fabs((double)(b->y - a->y));
    }
    return x < y;
}

static span_of span_along(const plane *p, uint32_t s, bool x)
{
    const grid_point *a = &p->point[p->segment[s].a], *b = &p->point[p->segment[s].b];
    int64_t from = x ? a->x : a->y, to = x ? b->x : b->y;

    return from < to ? (span_of){from, to, s} : (span_of){to, from, s};
}

static bool spans_meet(span_of a, span_of b)
{
    return a.low <= b.high && b.low <= a.high;
}

static int find_cuts(noder *n)
{
    const plane *p = n->p;
    bool x = is_short_along_x(p);

    n->cuts = 0;
    if (list_room(p->run, (void **)&n->span, &n->span_capacity, 0, p->segments, sizeof *n->span) !=
        PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < p->segments; i++)
        n->span[i] = span_along(p, i, x);
    if (p->segments > 1)
        qsort(n->span, p->segments, sizeof *n->span, compare_spans);
    for (uint32_t i = 0; i < p->segments; i++) {
        span_of across = span_along(p, n->span[i].segment, !x);

        /* As pcg_tick: dense curves meet in so many places that this can take long. */
        if ((--p->run->patience == 0 ||
             atomic_load_explicit(&p->run->attention, memory_order_relaxed)) &&
            run_look(p->run) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t j = i + 1; j < p->segments && n->span[j].low <= n->span[i].high; j++)
            if (spans_meet(across, span_along(p, n->span[j].segment, !x)) &&
                compare_pair(n, n->span[i].segment, n->span[j].segment) != PCG_OK)
                return PCG_FAILED;
    }
    return PCG_OK;
}

static int compare_cuts(const void *a, const void *b)
{
    const cut *s = a, *t = b;

    if (s->segment != t->segment)
        return s->segment < t->segment ? -1 : 1;
    if (s->along != t->along)
        return s->along < t->along ? -1 : 1;
    return s->point < t->point ? -1 : s->point > t->point;
}

/* Cuts the segments: their first parts take their places, the others are added. */
static int apply_cuts(noder *n)
{
    plane *p = n->p;

    qsort(n->cut, n->cuts, sizeof *n->cut, compare_cuts);
    for (uint32_t i = 0, j; i < n->cuts; i = j) {
        segment whole = p->segment[n->cut[i].segment];
        uint32_t from = whole.a;

        for (j = i; j < n->cuts && n->cut[j].segment == n->cut[i].segment; j++) {
            if (add_segment(p, from, n->cut[j].point, whole.winding) != PCG_OK)
                return PCG_FAILED;
            from = n->cut[j].point;
        }
        if (add_segment(p, from, whole.b, whole.winding) != PCG_OK)
            return PCG_FAILED;
        p->segment[n->cut[i].segment].winding = 0;
    }
    return PCG_OK;
}

/* Takes out what was cut, and merges the rest. */
static void drop_cut_segments(plane *p)
{
    uint32_t kept = 0;

    for (uint32_t i = 0; i < p->segments; i++)
        if (p->segment[i].winding != 0)
            p->segment[kept++] = p->segment[i];
    p->segments = kept;
    merge_segments(p);
}

static int cut_all(noder *n)
{
    for (int pass = 0; pass < PASSES_MAX; pass++) {
        if (find_cuts(n) != PCG_OK)
            return PCG_FAILED;
        if (n->cuts == 0)
            return PCG_OK;
        n->p->changed = true;
        if (apply_cuts(n) != PCG_OK)
            return PCG_FAILED;
        drop_cut_segments(n->p);
    }
    return PCG_OK;
}

/* ---- from loops ------------------------------------------------------------------------------ */

static void place_grid(plane *p, const polygons *loops)
{
    pcg_vec2 low = loops->point[0], high = low;
    double extent;

    for (uint32_t i = 1; i < loops->points; i++) {
        low.x = fmin(low.x, loops->point[i].x);
        low.y = fmin(low.y, loops->point[i].y);
        high.x = fmax(high.x, loops->point[i].x);
        high.y = fmax(high.y, loops->point[i].y);
    }
    extent = fmax(high.x - low.x, high.y - low.y);
    p->middle = (pcg_vec2){low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
    p->step = extent > 0 ? extent / (2 * half_width) : 1;
}

static int add_loop(plane *p, const polygons *loops, uint32_t loop)
{
    uint32_t from = loop_begin(loops, loop), to = loops->end[loop], first = UINT32_MAX,
             last = UINT32_MAX;

    for (uint32_t i = from; i < to; i++) {
        uint32_t point = point_at(p, loops->point[i], false);

        if (point == UINT32_MAX || (i > from && add_segment(p, last, point, 1) != PCG_OK))
            return PCG_FAILED;
        first = i == from ? point : first;
        last = point;
    }
    return to > from ? add_segment(p, last, first, 1) : PCG_OK;
}

static bool all_finite(const polygons *loops)
{
    for (uint32_t i = 0; i < loops->points; i++)
        if (!(fabs(loops->point[i].x) <= 1e100) || !(fabs(loops->point[i].y) <= 1e100))
            return false;
    return true;
}

int plane_open(pcg_run *r, const polygons *loops, plane *p)
{
    noder n = {.p = p};
    int status = PCG_OK;

    *p = (plane){.run = r};
    if (loops->points == 0 || !all_finite(loops))
        return PCG_OK;
    place_grid(p, loops);
    for (uint32_t l = 0; l < loops->loops && status == PCG_OK; l++)
        status = add_loop(p, loops, l);
    if (status == PCG_OK) {
        merge_segments(p);
        status = cut_all(&n);
    }
    run_free(r, n.cut, n.cut_capacity * sizeof *n.cut);
    run_free(r, n.span, n.span_capacity * sizeof *n.span);
    return status;
}

void plane_close(plane *p)
{
    run_free(p->run, p->point, p->point_capacity * sizeof *p->point);
    run_free(p->run, p->slot, p->slots * sizeof *p->slot);
    run_free(p->run, p->segment, p->segment_capacity * sizeof *p->segment);
}

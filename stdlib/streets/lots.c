/* lots.c - what streets enclose.
 *
 * The outlines of streets and crossings are laid side by side as directed sides, the covered
 * ground on the left. Where two areas touch, their sides run against each other and are both
 * taken out; what is left bounds the covered ground. Followed so that each loop turns right as
 * soon as it can, it falls apart into loops around the covered ground, which turn left, and
 * around what it encloses, which turn right. An enclosed one, turned round, is a lot; what
 * stands alone in it is taken off.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "pairs.h"

/* Smaller lots, in square metres, are what rounding leaves over. */
static const double least_lot = 0.01;

#define GONE UINT32_MAX

typedef struct side {
    uint32_t from, to; /* corners; from is GONE where the side is taken out */
    uint32_t loop;     /* + 1; 0: none yet */
} side;

typedef struct ring {
    uint32_t first, sides; /* in `order` */
    double area;           /* signed */
    uint32_t leftmost;     /* corner */
    uint32_t lot;          /* the ring that it stands in, or GONE; to be found */
    uint32_t near;         /* the ring that is next on its left, or GONE */
    bool known;
} ring;

typedef struct finder {
    const layout *l;
    int band;
    pcg_vec2 *corner;
    uint32_t corners, corner_capacity;
    uint32_t *slot; /* corners by place: numbers + 1 */
    uint32_t slots;
    side *side;
    uint32_t sides, side_capacity;
    uint32_t *begin, *leaving; /* the sides that leave each corner */
    uint32_t *order;           /* sides, loop by loop */
    uint32_t ordered;
    ring *ring;
    uint32_t rings, ring_capacity;
} finder;

/* ---- corners and sides ----------------------------------------------------------------------- */

static uint64_t bits_of(double a)
{
    uint64_t bits;

    a += 0.0; /* no -0 */
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static uint32_t slot_of(const finder *f, pcg_vec2 at)
{
    uint64_t hash = bits_of(at.x) * 0x9E3779B97F4A7C15u ^ bits_of(at.y) * 0xC2B2AE3D27D4EB4Fu;
    uint32_t slot = (uint32_t)((hash ^ hash >> 31) * 0xD6E8FEB86659FD93u >> 32) & (f->slots - 1);

    while (f->slot[slot] != 0 && (bits_of(f->corner[f->slot[slot] - 1].x) != bits_of(at.x) ||
                                  bits_of(f->corner[f->slot[slot] - 1].y) != bits_of(at.y)))
        slot = (slot + 1) & (f->slots - 1);
    return slot;
}

static int grow_slots(finder *f)
{
    uint32_t slots = f->slots > 0 ? 2 * f->slots : 1024;
    uint32_t *slot = run_alloc_array(f->l->run, slots, sizeof *slot);

    if (slot == NULL)
        return PCG_FAILED;
    run_free(f->l->run, f->slot, f->slots * sizeof *f->slot);
    f->slot = slot;
    f->slots = slots;
    for (uint32_t i = 0; i < f->corners; i++)
        f->slot[slot_of(f, f->corner[i])] = i + 1;
    return PCG_OK;
}

/* GONE: no memory. */
static uint32_t corner_at(finder *f, pcg_vec2 at)
{
    uint32_t slot;

    if (2 * f->corners >= f->slots && grow_slots(f) != PCG_OK)
        return GONE;
    slot = slot_of(f, at);
    if (f->slot[slot] != 0)
        return f->slot[slot] - 1;
    if (list_room(f->l->run, (void **)&f->corner, &f->corner_capacity, f->corners, 1,
                  sizeof *f->corner) != PCG_OK)
        return GONE;
    f->corner[f->corners] = at;
    f->slot[slot] = ++f->corners;
    return f->corners - 1;
}

static int add_loops(finder *f, const polygons *p)
{
    for (uint32_t l = 0; l < p->loops; l++)
        for (uint32_t i = loop_begin(p, l), j = p->end[l] - 1; i < p->end[l]; j = i++) {
            uint32_t from = corner_at(f, p->point[j]), to = corner_at(f, p->point[i]);

            if (from == GONE || to == GONE ||
                list_room(f->l->run, (void **)&f->side, &f->side_capacity, f->sides, 1,
                          sizeof *f->side) != PCG_OK)
                return PCG_FAILED;
            if (from != to)
                f->side[f->sides++] = (side){.from = from, .to = to};
        }
    return PCG_OK;
}

static bool is_on_ground(const layout *l, const street_link *k)
{
    return l->way[k->way].level == 0;
}

static int add_streets(finder *f)
{
    const layout *l = f->l;
    polygons outline = {0};
    int status = PCG_OK;

    for (uint32_t i = 0; i < l->links && status == PCG_OK; i++) {
        const street_link *k = &l->link[i];

        if (k->internal[f->band] || !is_on_ground(l, k))
            continue;
        polygons_clear(&outline);
        status = link_outline(l, f->band, k, k->station[f->band][0], k->station[f->band][1], false,
                              &outline);
        if (status == PCG_OK)
            status = add_loops(f, &outline);
    }
    polygons_free(l->run, &outline);
    return status;
}

/* Crossings at which nothing is on the ground are none of it. */
static int add_crossings(finder *f, const crossings *c)
{
    const layout *l = f->l;
    bool *grounded = run_alloc_zeroed(l->run, c->count + (size_t)1);
    int status = grounded != NULL ? PCG_OK : PCG_FAILED;

    for (uint32_t i = 0; i < 2 * l->links && status == PCG_OK; i++) {
        const street_link *k = &l->link[i / 2];
        uint32_t number = c->number[k->node[i % 2]];

        if (number != 0 && is_on_ground(l, k))
            grounded[number - 1] = true;
    }
    for (uint32_t i = 0; i < c->count && status == PCG_OK; i++)
        if (grounded[i])
            status = add_loops(f, &c->area[i]);
    run_free(l->run, grounded, c->count + (size_t)1);
    return status;
}

/* ---- following ------------------------------------------------------------------------------- */

/* The sides that leave each corner. */
static int list_leaving(finder *f)
{
    f->begin = run_alloc_array(f->l->run, f->corners + (size_t)2, sizeof *f->begin);
    f->leaving = run_alloc(f->l->run, (f->sides + (size_t)1) * sizeof *f->leaving);
    f->order = run_alloc(f->l->run, (f->sides + (size_t)1) * sizeof *f->order);
    if (f->begin == NULL || f->leaving == NULL || f->order == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < f->sides; i++)
        f->begin[f->side[i].from + 2]++;
    for (uint32_t i = 2; i < f->corners + 2; i++)
        f->begin[i] += f->begin[i - 1];
    for (uint32_t i = 0; i < f->sides; i++)
        f->leaving[f->begin[f->side[i].from + 1]++] = i;
    return PCG_OK;
}

/* Takes out sides that run against each other, in pairs. */
static void cancel(finder *f)
{
    for (uint32_t i = 0; i < f->sides; i++) {
        uint32_t from = f->side[i].from, to = f->side[i].to;

        for (uint32_t k = f->begin[to]; from != GONE && k < f->begin[to + 1]; k++) {
            side *back = &f->side[f->leaving[k]];

            if (back->from == GONE || back->to != from)
                continue;
            back->from = f->side[i].from = GONE;
            break;
        }
    }
}

/* Whether going from `back` counter-clockwise direction a comes before b. */
static bool comes_before(pcg_vec2 back, pcg_vec2 a, pcg_vec2 b)
{
    double turn_a = vec2_cross(back, a), turn_b = vec2_cross(back, b);
    bool far_a = turn_a < 0 || (turn_a <= 0 && vec2_dot(back, a) > 0);
    bool far_b = turn_b < 0 || (turn_b <= 0 && vec2_dot(back, b) > 0);

    return far_a != far_b ? far_b : vec2_cross(a, b) > 0;
}

static pcg_vec2 direction_of(const finder *f, uint32_t s)
{
    return vec2_subtract(f->corner[f->side[s].to], f->corner[f->side[s].from]);
}

/* The side that goes on where one ends, the rightmost that is free; GONE where there is none. */
static uint32_t follow(const finder *f, uint32_t s)
{
    uint32_t at = f->side[s].to, best = GONE;
    pcg_vec2 back = vec2_scale(direction_of(f, s), -1);

    for (uint32_t k = f->begin[at]; k < f->begin[at + 1]; k++) {
        uint32_t next = f->leaving[k];

        if (f->side[next].from == GONE || f->side[next].loop != 0)
            continue;
        if (best == GONE || comes_before(back, direction_of(f, next), direction_of(f, best)))
            best = next;
    }
    return best;
}

static bool is_left_of(pcg_vec2 a, pcg_vec2 b)
{
    return a.x < b.x || (a.x <= b.x && a.y < b.y);
}

static void measure(const finder *f, ring *r)
{
    pcg_vec2 about = f->corner[f->side[f->order[r->first]].from];

    r->leftmost = f->side[f->order[r->first]].from;
    for (uint32_t i = r->first; i < r->first + r->sides; i++) {
        const side *s = &f->side[f->order[i]];

        r->area += vec2_cross(vec2_subtract(f->corner[s->from], about),
                              vec2_subtract(f->corner[s->to], about)) /
                   2;
        if (is_left_of(f->corner[s->from], f->corner[r->leftmost]))
            r->leftmost = s->from;
    }
}

static int find_rings(finder *f)
{
    for (uint32_t i = 0; i < f->sides; i++) {
        ring r = {.first = f->ordered, .lot = GONE, .near = GONE};

        if (f->side[i].from == GONE || f->side[i].loop != 0)
            continue;
        for (uint32_t s = i; s != GONE; s = follow(f, s)) {
            f->side[s].loop = f->rings + 1;
            f->order[f->ordered++] = s;
        }
        r.sides = f->ordered - r.first;
        measure(f, &r);
        if (list_room(f->l->run, (void **)&f->ring, &f->ring_capacity, f->rings, 1,
                      sizeof *f->ring) != PCG_OK)
            return PCG_FAILED;
        f->ring[f->rings++] = r;
        if (pcg_tick(f->l->call) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* ---- what stands alone in a lot -------------------------------------------------------------- */

/* Rows of equal height, and the sides that are in each: to find what is on the left of a place. */
typedef struct rows {
    double low, height;
    uint32_t count;
    uint32_t *begin, *side;
    size_t entries;
} rows;

static uint32_t row_of(const rows *w, double y)
{
    double row = (y - w->low) / w->height;

    return row > 0 ? (row < w->count - 1 ? (uint32_t)row : w->count - 1) : 0;
}

static void row_range(const finder *f, const rows *w, uint32_t s, uint32_t *from, uint32_t *to)
{
    double a = f->corner[f->side[s].from].y, b = f->corner[f->side[s].to].y;

    *from = row_of(w, fmin(a, b));
    *to = row_of(w, fmax(a, b));
}

static void place_rows(const finder *f, rows *w)
{
    double low = INFINITY, high = -INFINITY, heights = 0;

    for (uint32_t i = 0; i < f->ordered; i++) {
        const side *s = &f->side[f->order[i]];

        low = fmin(low, f->corner[s->from].y);
        high = fmax(high, f->corner[s->from].y);
        heights += fabs(f->corner[s->from].y - f->corner[s->to].y);
    }
    w->low = low;
    /* As many rows as there are sides where those are low: each is in two of them on the whole. */
    w->height = fmax(heights / f->ordered, (high - low) / (f->ordered + 1.0));
    w->height = w->height > 0 ? w->height : 1;
    w->count = 1 + (uint32_t)fmin((high - low) / w->height, f->ordered);
}

static int fill_rows(const finder *f, rows *w)
{
    uint32_t from, to;

    place_rows(f, w);
    w->begin = run_alloc_array(f->l->run, w->count + (size_t)2, sizeof *w->begin);
    if (w->begin == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < f->ordered; i++) {
        row_range(f, w, f->order[i], &from, &to);
        w->entries += to - from + 1;
        for (uint32_t k = from; k <= to; k++)
            w->begin[k + 2]++;
    }
    for (uint32_t k = 2; k < w->count + 2; k++)
        w->begin[k] += w->begin[k - 1];
    w->side = run_alloc_array(f->l->run, w->entries, sizeof *w->side);
    if (w->side == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < f->ordered; i++) {
        row_range(f, w, f->order[i], &from, &to);
        for (uint32_t k = from; k <= to; k++)
            w->side[w->begin[k + 1]++] = f->order[i];
    }
    return PCG_OK;
}

/* The ring of the nearest side on the left of a ring's leftmost corner, GONE where there is none;
 * `down`: whether that side goes down, so that what is enclosed would be on its left. */
static uint32_t ring_on_left(const finder *f, const rows *w, uint32_t own)
{
    pcg_vec2 at = f->corner[f->ring[own].leftmost];
    uint32_t row = row_of(w, at.y), found = GONE;
    double nearest = -INFINITY;

    for (uint32_t k = w->begin[row]; k < w->begin[row + 1]; k++) {
        const side *s = &f->side[w->side[k]];
        pcg_vec2 a = f->corner[s->from], b = f->corner[s->to];
        double x;

        if (s->loop == own + 1 || (a.y > at.y) == (b.y > at.y))
            continue;
        x = a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x);
        if (x <= at.x && x > nearest) {
            nearest = x;
            found = s->loop - 1;
        }
    }
    return found;
}

/* The lot that a ring around covered ground stands in: what is on its left is that lot's ring, or
 * stands in the same. */
static uint32_t lot_around(finder *f, uint32_t own)
{
    uint32_t at = own, lot;

    while (f->ring[at].area > 0 && !f->ring[at].known && f->ring[at].near != GONE) {
        f->ring[at].known = true; /* also ends a walk in a circle */
        at = f->ring[at].near;
    }
    lot = f->ring[at].area > 0 ? f->ring[at].lot : at;
    for (at = own;
         f->ring[at].area > 0 && f->ring[at].lot == GONE && f->ring[at].near != GONE && lot != GONE;
         at = f->ring[at].near)
        f->ring[at].lot = lot;
    return lot;
}

static int nest(finder *f)
{
    rows w = {.count = 0};
    int status = fill_rows(f, &w);

    for (uint32_t i = 0; i < f->rings && status == PCG_OK; i++)
        if (f->ring[i].area > 0) {
            f->ring[i].near = ring_on_left(f, &w, i);
            status = pcg_tick(f->l->call);
        }
    for (uint32_t i = 0; i < f->rings && status == PCG_OK; i++)
        if (f->ring[i].area > 0)
            f->ring[i].lot = lot_around(f, i);
    run_free(f->l->run, w.begin, (w.count + (size_t)2) * sizeof *w.begin);
    run_free(f->l->run, w.side, w.entries * sizeof *w.side);
    return status;
}

/* ---- lots ------------------------------------------------------------------------------------ */

static int add_ring(const finder *f, uint32_t number, polygons *out)
{
    const ring *r = &f->ring[number];

    for (uint32_t i = r->sides; i-- > 0;)
        if (polygons_add(f->l->run, out, f->corner[f->side[f->order[r->first + i]].to]) != PCG_OK)
            return PCG_FAILED;
    return polygons_end_loop(f->l->run, out);
}

static int add_lot(const finder *f, const polygons *clean, polygons *lots)
{
    for (uint32_t face = 0; face < clean->faces; face++) {
        double area = 0;

        for (uint32_t i = clean->face[face]; i < face_end(clean, face); i++)
            area += polygons_loop_area(clean, i);
        if (area < least_lot)
            continue;
        if (polygons_begin_face(f->l->run, lots) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t i = clean->face[face]; i < face_end(clean, face); i++) {
            for (uint32_t k = loop_begin(clean, i); k < clean->end[i]; k++)
                if (polygons_add(f->l->run, lots, clean->point[k]) != PCG_OK)
                    return PCG_FAILED;
            if (polygons_end_loop(f->l->run, lots) != PCG_OK)
                return PCG_FAILED;
        }
    }
    return PCG_OK;
}

/* The rings of covered ground by the lot that they stand in. */
typedef struct stander {
    uint32_t lot, ring;
} stander;

static int compare_standers(const void *a, const void *b)
{
    const stander *s = a, *t = b;

    if (s->lot != t->lot)
        return s->lot < t->lot ? -1 : 1;
    return s->ring < t->ring ? -1 : s->ring > t->ring;
}

static int write_lots(const finder *f, const stander *standers, uint32_t count, polygons *lots)
{
    polygons loops = {0}, clean = {0};
    int status = PCG_OK;
    bool changed;

    for (uint32_t i = 0, at = 0; i < f->rings && status == PCG_OK; i++) {
        if (!(f->ring[i].area < 0))
            continue;
        polygons_clear(&loops);
        polygons_clear(&clean);
        status = add_ring(f, i, &loops);
        while (at < count && standers[at].lot < i)
            at++;
        for (; at < count && standers[at].lot == i && status == PCG_OK; at++)
            status = add_ring(f, standers[at].ring, &loops);
        if (status == PCG_OK)
            status = polygons_clean(f->l->run, &loops, 0, &clean, &changed);
        if (status == PCG_OK)
            status = add_lot(f, &clean, lots);
        if (status == PCG_OK)
            status = pcg_tick(f->l->call);
    }
    polygons_free(f->l->run, &loops);
    polygons_free(f->l->run, &clean);
    return status;
}

static int make_lots(finder *f, polygons *lots)
{
    size_t size = (f->rings + (size_t)1) * sizeof(stander);
    stander *standers = run_alloc(f->l->run, size);
    uint32_t count = 0;
    int status;

    if (standers == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < f->rings; i++)
        if (f->ring[i].area > 0 && f->ring[i].lot != GONE)
            standers[count++] = (stander){f->ring[i].lot, i};
    if (count > 1)
        qsort(standers, count, sizeof *standers, compare_standers);
    status = write_lots(f, standers, count, lots);
    run_free(f->l->run, standers, size);
    return status;
}

static void finder_close(finder *f)
{
    pcg_run *r = f->l->run;

    run_free(r, f->corner, f->corner_capacity * sizeof *f->corner);
    run_free(r, f->slot, f->slots * sizeof *f->slot);
    run_free(r, f->side, f->side_capacity * sizeof *f->side);
    run_free(r, f->begin, (f->corners + (size_t)2) * sizeof *f->begin);
    run_free(r, f->leaving, (f->sides + (size_t)1) * sizeof *f->leaving);
    run_free(r, f->order, (f->sides + (size_t)1) * sizeof *f->order);
    run_free(r, f->ring, f->ring_capacity * sizeof *f->ring);
}

int lots_find(const layout *l, int band, const crossings *c, polygons *lots)
{
    finder f = {.l = l, .band = band};
    int status = add_streets(&f);

    if (status == PCG_OK)
        status = add_crossings(&f, c);
    if (status == PCG_OK)
        status = list_leaving(&f);
    if (status == PCG_OK) {
        cancel(&f);
        status = find_rings(&f);
    }
    if (status == PCG_OK && f.ordered > 0)
        status = nest(&f);
    if (status == PCG_OK)
        status = make_lots(&f, lots);
    finder_close(&f);
    return status;
}

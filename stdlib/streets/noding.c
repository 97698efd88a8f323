/* noding.c - a drawing whose edges meet at their vertices only.
 *
 * Places that are nearer to each other than the tolerance are one: the first that comes stands for
 * those around it, so that no chain of near ones drifts. Edges of one level that come as near to
 * such a place are bent through it, and those that cross are cut at a new place. That moves edges
 * by the tolerance at most, by which they may meet others, so it is done again until nothing is
 * left to cut, in practice two or three times.
 */
#include "noding.h"

#include <math.h>
#include <stdlib.h>

#include "pairs.h"
#include "runtime/orientation.h"

enum { PASSES_MAX = 32 };

static const double least_tolerance = 1e-6;

typedef struct place {
    pcg_vec3 at;
    pcg_int level;
    uint32_t next; /* number + 1 of the next in its cell's list */
    bool is_end;   /* a way ends here */
} place;

typedef struct piece { /* of an edge */
    uint32_t a, b;     /* places */
    uint32_t way;
} piece;

/* A piece has to go through a place. */
typedef struct cut {
    uint32_t piece, place;
    double along;
} cut;

typedef struct noder {
    pcg_call *call;
    const street_drawing *from;
    double tolerance;
    place *place;
    uint32_t places, place_capacity;
    uint32_t *slot; /* cells of the tolerance's size, by hash: numbers of places + 1 */
    uint32_t slots;
    piece *piece;
    uint32_t pieces, piece_capacity;
    cut *cut;
    uint32_t cuts, cut_capacity;
} noder;

static pcg_vec2 plane_of(const noder *n, uint32_t p)
{
    return vec2_of(n->place[p].at);
}

static pcg_int level_of(const noder *n, const piece *p)
{
    return n->from->way[p->way].level;
}

/* ---- places ---------------------------------------------------------------------------------- */

static uint32_t cell_slot(const noder *n, int64_t x, int64_t y)
{
    uint64_t hash = (uint64_t)x * 0x9E3779B97F4A7C15u ^ (uint64_t)y * 0xC2B2AE3D27D4EB4Fu;

    return (uint32_t)((hash ^ hash >> 31) * 0xD6E8FEB86659FD93u >> 32) & (n->slots - 1);
}

static int64_t cell_of(const noder *n, double at)
{
    return (int64_t)floor(at / n->tolerance);
}

static void enter_place(noder *n, uint32_t p)
{
    pcg_vec3 at = n->place[p].at;
    uint32_t slot = cell_slot(n, cell_of(n, at.x), cell_of(n, at.y));

    n->place[p].next = n->slot[slot];
    n->slot[slot] = p + 1;
}

static int grow_slots(noder *n)
{
    uint32_t slots = n->slots > 0 ? 2 * n->slots : 256;
    uint32_t *slot = run_alloc_array(n->call->run, slots, sizeof *slot);

    if (slot == NULL)
        return PCG_FAILED;
    run_free(n->call->run, n->slot, n->slots * sizeof *n->slot);
    n->slot = slot;
    n->slots = slots;
    for (uint32_t i = 0; i < n->places; i++)
        enter_place(n, i);
    return PCG_OK;
}

static bool is_near(const noder *n, uint32_t p, pcg_vec3 at)
{
    double x = n->place[p].at.x - at.x, y = n->place[p].at.y - at.y;

    return x * x + y * y <= n->tolerance * n->tolerance;
}

/* The first place near a point that is on its level (or, `other`, on another one); UINT32_MAX where
 * there is none. */
static uint32_t find_place(const noder *n, pcg_vec3 at, pcg_int level, bool other)
{
    int64_t x = cell_of(n, at.x), y = cell_of(n, at.y);
    uint32_t found = UINT32_MAX;

    for (int k = 0; k < 9 && n->slots > 0; k++)
        for (uint32_t i = n->slot[cell_slot(n, x + k % 3 - 1, y + k / 3 - 1)]; i != 0;
             i = n->place[i - 1].next)
            if ((n->place[i - 1].level == level) != other && is_near(n, i - 1, at) && i - 1 < found)
                found = i - 1;
    return found;
}

/* The place that a point comes to; UINT32_MAX: no memory. */
static uint32_t place_at(noder *n, pcg_vec3 at, pcg_int level)
{
    uint32_t found = find_place(n, at, level, false);

    if (found != UINT32_MAX)
        return found;
    if ((n->places >= n->slots && grow_slots(n) != PCG_OK) ||
        list_room(n->call->run, (void **)&n->place, &n->place_capacity, n->places, 1,
                  sizeof *n->place) != PCG_OK)
        return UINT32_MAX;
    n->place[n->places] = (place){.at = at, .level = level};
    enter_place(n, n->places);
    return n->places++;
}

static int add_piece(noder *n, uint32_t a, uint32_t b, uint32_t way)
{
    if (a == b)
        return PCG_OK;
    if (list_room(n->call->run, (void **)&n->piece, &n->piece_capacity, n->pieces, 1,
                  sizeof *n->piece) != PCG_OK)
        return PCG_FAILED;
    n->piece[n->pieces++] = (piece){a, b, way};
    return PCG_OK;
}

static int add_edges(noder *n)
{
    const street_drawing *d = n->from;
    int status = PCG_OK;

    for (uint32_t i = 0; i < d->edges && status == PCG_OK; i++) {
        const street_edge *e = &d->edge[i];
        pcg_int level = d->way[e->way].level;
        uint32_t a = place_at(n, d->vertex[e->from], level);
        uint32_t b = place_at(n, d->vertex[e->to], level);

        if (a == UINT32_MAX || b == UINT32_MAX)
            return PCG_FAILED;
        status = add_piece(n, a, b, e->way);
        if (status == PCG_OK)
            status = pcg_tick(n->call);
    }
    return status;
}

/* ---- ends ------------------------------------------------------------------------------------ */

typedef struct end_use {
    uint32_t place, way;
} end_use;

static int compare_uses(const void *a, const void *b)
{
    const end_use *s = a, *t = b;

    if (s->place != t->place)
        return s->place < t->place ? -1 : 1;
    return s->way < t->way ? -1 : s->way > t->way;
}

/* A way ends where only one of its edges comes to. */
static int find_ends(noder *n)
{
    size_t uses = 2 * (size_t)n->pieces, size = (uses + 1) * sizeof(end_use);
    end_use *use = run_alloc(n->call->run, size);

    if (use == NULL)
        return PCG_FAILED;
    for (size_t i = 0; i < uses; i++) {
        const piece *p = &n->piece[i / 2];

        use[i] = (end_use){i % 2 == 0 ? p->a : p->b, p->way};
    }
    if (uses > 1)
        qsort(use, uses, sizeof *use, compare_uses);
    for (size_t i = 0; i < uses; i++)
        if ((i == 0 || compare_uses(&use[i - 1], &use[i]) != 0) &&
            (i + 1 == uses || compare_uses(&use[i], &use[i + 1]) != 0))
            n->place[use[i].place].is_end = true;
    run_free(n->call->run, use, size);
    return PCG_OK;
}

/* ---- where edges meet ------------------------------------------------------------------------ */

static int add_cut(noder *n, uint32_t p, uint32_t at, double along)
{
    if (n->piece[p].a == at || n->piece[p].b == at)
        return PCG_OK;
    if (list_room(n->call->run, (void **)&n->cut, &n->cut_capacity, n->cuts, 1, sizeof *n->cut) !=
        PCG_OK)
        return PCG_FAILED;
    n->cut[n->cuts++] = (cut){p, at, along};
    return PCG_OK;
}

/* Whether a piece comes near to a place that is none of its ends; *along is where. */
static bool passes(const noder *n, const piece *p, uint32_t spot, double *along)
{
    pcg_vec2 a = plane_of(n, p->a), b = plane_of(n, p->b), at = plane_of(n, spot);
    pcg_vec2 way = vec2_subtract(b, a), to = vec2_subtract(at, a);
    double square = vec2_dot(way, way), turn = vec2_cross(way, to);

    if (spot == p->a || spot == p->b || !(square > 0))
        return false;
    *along = vec2_dot(way, to) / square;
    return *along > 0 && *along < 1 && turn * turn <= n->tolerance * n->tolerance * square;
}

static int cut_at_place(noder *n, uint32_t p, uint32_t spot, bool *touch)
{
    double along;

    if (!passes(n, &n->piece[p], spot, &along))
        return PCG_OK;
    *touch = true;
    return add_cut(n, p, spot, along);
}

static bool are_apart(double a, double b)
{
    return (a > 0 && b < 0) || (a < 0 && b > 0);
}

static int cut_crossing(noder *n, uint32_t s, uint32_t t)
{
    const piece *p = &n->piece[s], *q = &n->piece[t];
    pcg_vec2 a = plane_of(n, p->a), b = plane_of(n, p->b), c = plane_of(n, q->a),
             d = plane_of(n, q->b);
    double a_side = orientation(c, d, a), b_side = orientation(c, d, b);
    double c_side = orientation(a, b, c), d_side = orientation(a, b, d);
    pcg_vec3 low = n->place[p->a].at, high = n->place[p->b].at;
    double share;
    uint32_t at;

    if (!are_apart(a_side, b_side) || !are_apart(c_side, d_side))
        return PCG_OK;
    share = a_side / (a_side - b_side);
    at = place_at(n, vec3_add(low, vec3_scale(vec3_subtract(high, low), share)), level_of(n, p));
    if (at == UINT32_MAX || add_cut(n, s, at, share) != PCG_OK)
        return PCG_FAILED;
    return add_cut(n, t, at, c_side / (c_side - d_side));
}

static int compare_pieces(void *context, uint32_t s, uint32_t t)
{
    noder *n = context;
    const piece p = n->piece[s], q = n->piece[t];
    bool touch = p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b;

    bool level = level_of(n, &p) == level_of(n, &q);

    if (((level || n->place[q.a].is_end) && cut_at_place(n, s, q.a, &touch) != PCG_OK) ||
        ((level || n->place[q.b].is_end) && cut_at_place(n, s, q.b, &touch) != PCG_OK) ||
        ((level || n->place[p.a].is_end) && cut_at_place(n, t, p.a, &touch) != PCG_OK) ||
        ((level || n->place[p.b].is_end) && cut_at_place(n, t, p.b, &touch) != PCG_OK))
        return PCG_FAILED;
    return touch || !level ? PCG_OK : cut_crossing(n, s, t);
}

static pair_box box_of(const noder *n, const piece *p)
{
    pcg_vec2 a = plane_of(n, p->a), b = plane_of(n, p->b);
    double around = n->tolerance;

    return (pair_box){{fmin(a.x, b.x) - around, fmin(a.y, b.y) - around},
                      {fmax(a.x, b.x) + around, fmax(a.y, b.y) + around}};
}

static int find_cuts(noder *n)
{
    size_t size = (n->pieces + (size_t)1) * sizeof(pair_box);
    pair_box *box = run_alloc(n->call->run, size);
    int status;

    if (box == NULL)
        return PCG_FAILED;
    n->cuts = 0;
    for (uint32_t i = 0; i < n->pieces; i++)
        box[i] = box_of(n, &n->piece[i]);
    status = pairs_find(n->call, box, n->pieces, compare_pieces, n);
    run_free(n->call->run, box, size);
    return status;
}

static int compare_cuts(const void *a, const void *b)
{
    const cut *s = a, *t = b;

    if (s->piece != t->piece)
        return s->piece < t->piece ? -1 : 1;
    if (s->along < t->along || s->along > t->along)
        return s->along < t->along ? -1 : 1;
    return s->place < t->place ? -1 : s->place > t->place;
}

/* The pieces again, in their order, cut. */
static int apply_cuts(noder *n)
{
    piece *whole = n->piece;
    uint32_t pieces = n->pieces, capacity = n->piece_capacity, at = 0;
    int status = PCG_OK;

    qsort(n->cut, n->cuts, sizeof *n->cut, compare_cuts);
    n->piece = NULL;
    n->pieces = n->piece_capacity = 0;
    for (uint32_t i = 0; i < pieces && status == PCG_OK; i++) {
        uint32_t from = whole[i].a;

        for (; at < n->cuts && n->cut[at].piece == i && status == PCG_OK; at++) {
            status = add_piece(n, from, n->cut[at].place, whole[i].way);
            from = n->cut[at].place;
        }
        if (status == PCG_OK)
            status = add_piece(n, from, whole[i].b, whole[i].way);
    }
    run_free(n->call->run, whole, capacity * sizeof *whole);
    return status;
}

/* ---- edges between the same places ----------------------------------------------------------- */

typedef struct twin {
    uint32_t low, high, piece;
    pcg_int level;
    double width;
} twin;

static int compare_twins(const void *a, const void *b)
{
    const twin *s = a, *t = b;

    if (s->low != t->low)
        return s->low < t->low ? -1 : 1;
    if (s->high != t->high)
        return s->high < t->high ? -1 : 1;
    if (s->level != t->level)
        return s->level < t->level ? -1 : 1;
    if (s->width > t->width || s->width < t->width)
        return s->width > t->width ? -1 : 1;
    return s->piece < t->piece ? -1 : s->piece > t->piece;
}

/* Leaves out all but the widest of those between the same places, and those without length. */
static int drop_twins(noder *n)
{
    size_t size = (n->pieces + (size_t)1) * sizeof(twin);
    twin *twins = run_alloc(n->call->run, size);
    uint32_t kept = 0;

    if (twins == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < n->pieces; i++) {
        const piece *p = &n->piece[i];

        twins[i] = (twin){p->a < p->b ? p->a : p->b, p->a < p->b ? p->b : p->a, i, level_of(n, p),
                          streets_width(n->from->way[p->way].width)};
    }
    if (n->pieces > 1)
        qsort(twins, n->pieces, sizeof *twins, compare_twins);
    for (uint32_t i = 0; i < n->pieces; i++)
        if (twins[i].low == twins[i].high ||
            (i > 0 && twins[i].low == twins[i - 1].low && twins[i].high == twins[i - 1].high &&
             twins[i].level == twins[i - 1].level))
            n->piece[twins[i].piece].way = UINT32_MAX;
    for (uint32_t i = 0; i < n->pieces; i++)
        if (n->piece[i].way != UINT32_MAX)
            n->piece[kept++] = n->piece[i];
    n->pieces = kept;
    run_free(n->call->run, twins, size);
    return PCG_OK;
}

static int cut_all(noder *n)
{
    int status = drop_twins(n);

    for (int pass = 0; pass < PASSES_MAX && status == PCG_OK; pass++) {
        status = find_cuts(n);
        if (status != PCG_OK || n->cuts == 0)
            return status;
        status = apply_cuts(n);
        if (status == PCG_OK)
            status = drop_twins(n);
    }
    return status;
}

/* ---- levels ---------------------------------------------------------------------------------- */

static uint32_t root(uint32_t *same, uint32_t at)
{
    while (same[at] != at) {
        same[at] = same[same[at]];
        at = same[at];
    }
    return at;
}

/* Where a way ends, what is there on other levels is the same place. */
static void join_ends(noder *n, uint32_t *same)
{
    for (uint32_t i = 0; i < n->places; i++)
        same[i] = i;
    for (uint32_t i = 0; i < n->places; i++) {
        const place *p = &n->place[i];
        uint32_t other = p->is_end ? find_place(n, p->at, p->level, true) : UINT32_MAX;

        if (other == UINT32_MAX)
            continue;
        uint32_t a = root(same, i), b = root(same, other);

        same[a > b ? a : b] = a > b ? b : a;
    }
    for (uint32_t i = 0; i < n->pieces; i++) {
        n->piece[i].a = root(same, n->piece[i].a);
        n->piece[i].b = root(same, n->piece[i].b);
    }
}

static int join_levels(noder *n)
{
    size_t size = (n->places + (size_t)1) * sizeof(uint32_t);
    uint32_t *same = run_alloc(n->call->run, size);

    if (same == NULL)
        return PCG_FAILED;
    join_ends(n, same);
    run_free(n->call->run, same, size);
    return drop_twins(n);
}

/* ---- the result ------------------------------------------------------------------------------ */

static int write_pieces(noder *n, street_drawing *to)
{
    pcg_run *r = n->call->run;

    for (uint32_t i = 0; i < n->places; i++)
        n->place[i].next = UINT32_MAX; /* from here on: its number in the result */
    for (uint32_t i = 0; i < n->pieces; i++) {
        place *ends[2] = {&n->place[n->piece[i].a], &n->place[n->piece[i].b]};

        for (int k = 0; k < 2; k++)
            if (ends[k]->next == UINT32_MAX) {
                ends[k]->next = drawing_add_vertex(r, to, ends[k]->at);
                if (ends[k]->next == UINT32_MAX)
                    return PCG_FAILED;
            }
        if (drawing_add_edge(r, to, ends[0]->next, ends[1]->next, n->piece[i].way) == UINT32_MAX)
            return PCG_FAILED;
    }
    for (uint32_t i = 0; i < n->from->ways; i++)
        if (drawing_add_way(r, to, &n->from->way[i]) == UINT32_MAX)
            return PCG_FAILED;
    return PCG_OK;
}

static street_drawing *write_drawing(noder *n, int *status)
{
    street_drawing *to = drawing_new(n->call->run, n->places, n->pieces, n->from->ways);

    *status = to != NULL ? write_pieces(n, to) : PCG_FAILED;
    if (*status == PCG_OK || to == NULL)
        return to;
    drawing_drop(n->call->run, to);
    return NULL;
}

street_drawing *drawing_node(pcg_call *call, const street_drawing *d, double tolerance, int *status)
{
    noder n = {.call = call, .from = d};
    street_drawing *to = NULL;

    n.tolerance = tolerance > least_tolerance ? tolerance : least_tolerance;
    *status = add_edges(&n);
    if (*status == PCG_OK)
        *status = find_ends(&n);
    if (*status == PCG_OK)
        *status = cut_all(&n);
    if (*status == PCG_OK)
        *status = join_levels(&n);
    if (*status == PCG_OK)
        to = write_drawing(&n, status);
    run_free(call->run, n.place, n.place_capacity * sizeof *n.place);
    run_free(call->run, n.slot, n.slots * sizeof *n.slot);
    run_free(call->run, n.piece, n.piece_capacity * sizeof *n.piece);
    run_free(call->run, n.cut, n.cut_capacity * sizeof *n.cut);
    return to;
}

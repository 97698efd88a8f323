/* polygon_clean.c - the faces that segments bound, how often loops wind around each, and their
 * outlines.
 *
 * Each segment is two half-edges, 2s from a to b and 2s + 1 back. Following them with the face on
 * the left gives cycles: a face has one around it and one for each piece of the drawing inside it.
 * Which face a piece is in is found by looking left from its leftmost point. Winding numbers are
 * then handed on across segments.
 */
#include <stdlib.h>

#include "runtime/polygon_plane.h"

#define OUTSIDE UINT32_MAX

/* A half-edge that leaves a point; sorted by point, then counter-clockwise from straight down
 * (which comes last). */
typedef struct spoke {
    uint32_t from, edge;
    int64_t x, y; /* its direction */
} spoke;

typedef struct drawing {
    const plane *p;
    uint32_t edges; /* half-edges */
    spoke *spoke;
    uint32_t *place; /* of each half-edge in `spoke` */
    uint32_t *first; /* of each point, its first spoke; one more at the end */
    uint32_t *cycle; /* of each half-edge */
    uint32_t cycles;
    uint32_t *same; /* of each cycle, towards another of the same face, or part of the result */
    int *winding;   /* of each cycle's face */
    bool *known;
    uint32_t *piece; /* of each point, towards another of the same piece */
    uint32_t *start; /* the leftmost point of each piece, from left to right */
    uint32_t pieces;
    uint32_t *todo; /* half-edges */
    int least;
} drawing;

/* ---- half-edges ------------------------------------------------------------------------------ */

static uint32_t origin(const plane *p, uint32_t edge)
{
    const segment *s = &p->segment[edge / 2];

    return edge % 2 == 0 ? s->a : s->b;
}

static int winding_along(const plane *p, uint32_t edge)
{
    int winding = p->segment[edge / 2].winding;

    return edge % 2 == 0 ? winding : -winding;
}

static bool is_rightward(const spoke *s)
{
    return s->x > 0 || (s->x == 0 && s->y > 0);
}

static int compare_spokes(const void *a, const void *b)
{
    const spoke *s = a, *t = b;
    int64_t turn;

    if (s->from != t->from)
        return s->from < t->from ? -1 : 1;
    if (is_rightward(s) != is_rightward(t))
        return is_rightward(s) ? -1 : 1;
    turn = s->x * t->y - s->y * t->x;
    return turn != 0 ? (turn > 0 ? -1 : 1) : (s->edge < t->edge ? -1 : s->edge > t->edge);
}

static void sort_spokes(drawing *d)
{
    const plane *p = d->p;

    for (uint32_t e = 0; e < d->edges; e++) {
        const grid_point *a = &p->point[origin(p, e)], *b = &p->point[origin(p, e ^ 1)];

        d->spoke[e] = (spoke){origin(p, e), e, b->x - a->x, b->y - a->y};
    }
    qsort(d->spoke, d->edges, sizeof *d->spoke, compare_spokes);
    for (uint32_t i = 0, point = 0; i <= d->edges; i++)
        for (; point <= p->points && (i == d->edges || point <= d->spoke[i].from); point++)
            d->first[point] = i;
    for (uint32_t i = 0; i < d->edges; i++)
        d->place[d->spoke[i].edge] = i;
}

/* The half-edge that comes next clockwise around the point that `edge` leaves. */
static uint32_t clockwise(const drawing *d, uint32_t edge)
{
    uint32_t point = origin(d->p, edge), at = d->place[edge];

    return d->spoke[at > d->first[point] ? at - 1 : d->first[point + 1] - 1].edge;
}

/* The half-edge that follows around the face on the left. */
static uint32_t follow(const drawing *d, uint32_t edge)
{
    return clockwise(d, edge ^ 1);
}

static void find_cycles(drawing *d)
{
    for (uint32_t e = 0; e < d->edges; e++)
        d->cycle[e] = OUTSIDE;
    for (uint32_t e = 0; e < d->edges; e++) {
        if (d->cycle[e] != OUTSIDE)
            continue;
        for (uint32_t at = e; d->cycle[at] == OUTSIDE; at = follow(d, at))
            d->cycle[at] = d->cycles;
        d->cycles++;
    }
}

/* ---- pieces ---------------------------------------------------------------------------------- */

static uint32_t root(uint32_t *parent, uint32_t at)
{
    while (parent[at] != at) {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    return at;
}

static void join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = root(parent, a);
    b = root(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

static bool is_left_of(const grid_point *a, const grid_point *b)
{
    return a->x != b->x ? a->x < b->x : a->y < b->y;
}

/* The leftmost points of all pieces, into d->start. */
static void find_pieces(drawing *d)
{
    const plane *p = d->p;
    uint32_t *leftmost = d->todo; /* of a piece, at its root: todo has room for all points */

    for (uint32_t i = 0; i < p->points; i++)
        d->piece[i] = leftmost[i] = i;
    for (uint32_t s = 0; s < p->segments; s++)
        join(d->piece, p->segment[s].a, p->segment[s].b);
    for (uint32_t i = 0; i < p->points; i++) {
        uint32_t r = root(d->piece, i);

        if (is_left_of(&p->point[i], &p->point[leftmost[r]]))
            leftmost[r] = i;
    }
    for (uint32_t i = 0; i < p->points; i++)
        if (root(d->piece, i) == i && d->first[i] < d->first[i + 1])
            d->start[d->pieces++] = leftmost[i];
}

/* Heap sort of the pieces' starts, from left to right. */
static void sift(const plane *p, uint32_t *heap, uint32_t at, uint32_t count)
{
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        uint32_t top = heap[at];

        if (child + 1 < count && is_left_of(&p->point[heap[child]], &p->point[heap[child + 1]]))
            child++;
        if (!is_left_of(&p->point[top], &p->point[heap[child]]))
            return;
        heap[at] = heap[child];
        heap[child] = top;
    }
}

static void sort_pieces(drawing *d)
{
    for (uint32_t i = d->pieces / 2; i-- > 0;)
        sift(d->p, d->start, i, d->pieces);
    for (uint32_t end = d->pieces; end-- > 1;) {
        uint32_t last = d->start[end];

        d->start[end] = d->start[0];
        d->start[0] = last;
        sift(d->p, d->start, 0, end);
    }
}

/* A segment as it goes up. */
typedef struct rising {
    const grid_point *low, *high;
    uint32_t down; /* the half-edge that goes down along it: its face is on the right of it */
} rising;

static rising rise(const plane *p, uint32_t s)
{
    const grid_point *a = &p->point[p->segment[s].a], *b = &p->point[p->segment[s].b];

    return a->y < b->y ? (rising){a, b, 2 * s + 1} : (rising){b, a, 2 * s};
}

/* Of two segments that meet a ray to the left, whether `b` does so nearer to its origin. */
static bool is_nearer(const rising *a, const rising *b)
{
    int64_t side = b->low->y >= a->low->y ? -grid_turn(a->low, a->high, b->low)
                                          : grid_turn(b->low, b->high, a->low);

    if (side == 0)
        side = b->high->y <= a->high->y ? -grid_turn(a->low, a->high, b->high)
                                        : grid_turn(b->low, b->high, a->high);
    return side > 0;
}

/* The cycle on the right of the first segment to the left of a piece, just above its start; OUTSIDE
 * where there is none. */
static uint32_t cycle_around(drawing *d, uint32_t start)
{
    const grid_point *from = &d->p->point[start];
    uint32_t own = root(d->piece, start);
    rising best = {.low = NULL};

    for (uint32_t s = 0; s < d->p->segments; s++) {
        rising r = rise(d->p, s);

        if (!(r.low->y <= from->y && r.high->y > from->y) || grid_turn(r.low, r.high, from) >= 0 ||
            root(d->piece, d->p->segment[s].a) == own)
            continue;
        if (best.low == NULL || is_nearer(&best, &r))
            best = r;
    }
    return best.low != NULL ? d->cycle[best.down] : OUTSIDE;
}

/* ---- winding numbers ------------------------------------------------------------------------- */

/* Hands winding numbers on across the segments of a piece, from a half-edge whose cycle's is
 * known. */
static void spread(drawing *d, uint32_t edge)
{
    uint32_t waiting = 0;

    d->todo[waiting++] = edge;
    while (waiting > 0) {
        uint32_t first = d->todo[--waiting], at = first;

        do {
            uint32_t across = d->cycle[at ^ 1];

            if (!d->known[across]) {
                d->known[across] = true;
                d->winding[across] = d->winding[d->cycle[at]] - winding_along(d->p, at);
                d->todo[waiting++] = at ^ 1;
            }
            at = follow(d, at);
        } while (at != first);
    }
}

static void find_windings(drawing *d)
{
    for (uint32_t i = 0; i < d->pieces; i++) {
        uint32_t start = d->start[i], around = cycle_around(d, start);
        /* The outside is on the left of the last spoke. */
        uint32_t outer = d->spoke[d->first[start + 1] - 1].edge;
        uint32_t cycle = d->cycle[outer];

        d->winding[cycle] = around != OUTSIDE ? d->winding[around] : 0;
        d->known[cycle] = true;
        if (around != OUTSIDE)
            join(d->same, cycle, around);
        spread(d, outer);
    }
}

static bool is_inside(const drawing *d, uint32_t edge)
{
    return d->winding[d->cycle[edge]] > d->least;
}

static bool is_border(const drawing *d, uint32_t edge)
{
    return is_inside(d, edge) && !is_inside(d, edge ^ 1);
}

/* Faces on both sides of a segment that the result does not show are one. */
static void join_faces(drawing *d)
{
    for (uint32_t e = 0; e < d->edges; e += 2)
        if (is_inside(d, e) && is_inside(d, e + 1))
            join(d->same, d->cycle[e], d->cycle[e + 1]);
}

/* ---- borders --------------------------------------------------------------------------------- */

/* A loop of the result, and the face that it bounds. */
typedef struct border_loop {
    uint32_t from, to; /* in `point` */
    uint32_t face;     /* a cycle that stands for it */
    int64_t order;     /* loops come in the order of their first half-edges */
    bool hole;
} border_loop;

typedef struct borders {
    drawing *d;
    uint32_t *point;
    uint32_t points, point_capacity;
    border_loop *loop;
    uint32_t loops, loop_capacity;
    uint32_t *path; /* points of the path that is being followed */
    uint32_t path_length;
    uint32_t *visit; /* of each point: where it is in the path, + 1; 0 when it is not */
    bool *done;      /* of each half-edge */
    bool simplified;
} borders;

static uint32_t next_border(const drawing *d, uint32_t edge)
{
    uint32_t next = follow(d, edge);

    while (!is_border(d, next))
        next = clockwise(d, next);
    return next;
}

/* Whether a point where segments crossed is of no more use: what is left of them goes straight on
 * there. */
static bool is_needless(const plane *p, uint32_t before, uint32_t at, uint32_t after)
{
    const grid_point *a = &p->point[before], *b = &p->point[at], *c = &p->point[after];
    double x = (double)(c->x - a->x), y = (double)(c->y - a->y), turn = (double)grid_turn(a, b, c);

    return b->made && turn * turn <= 4 * (x * x + y * y) &&
           (double)(b->x - a->x) * x + (double)(b->y - a->y) * y > 0 &&
           (double)(c->x - b->x) * x + (double)(c->y - b->y) * y > 0;
}

/* Twice the area between points of the path, in grid steps, about the first of them. */
static double path_area(const plane *p, const uint32_t *path, uint32_t count, double *length)
{
    double sum = 0;

    *length = 0;
    for (uint32_t i = 0, j = count - 1; i < count; j = i++) {
        const grid_point *o = &p->point[path[0]], *a = &p->point[path[j]], *b = &p->point[path[i]];

        sum += (double)grid_turn(o, a, b);
        *length += (double)(llabs(b->x - a->x) + llabs(b->y - a->y));
    }
    return sum;
}

/* The end of the path, from `from` on, is a loop. One that is thinner than the grid can show is
 * left out. */
static int end_loop(borders *b, uint32_t from, uint32_t edge)
{
    const plane *p = b->d->p;
    const uint32_t *path = b->path + from;
    uint32_t count = b->path_length - from, first = b->points;
    double length, area = path_area(p, path, count, &length);

    if (area <= 4 * length && area >= -4 * length) {
        b->simplified = true;
        return PCG_OK;
    }
    if (list_room(p->run, (void **)&b->point, &b->point_capacity, b->points, count,
                  sizeof *b->point) != PCG_OK ||
        list_room(p->run, (void **)&b->loop, &b->loop_capacity, b->loops, 1, sizeof *b->loop) !=
            PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++)
        if (!is_needless(p, path[i > 0 ? i - 1 : count - 1], path[i],
                         path[i + 1 < count ? i + 1 : 0]))
            b->point[b->points++] = path[i];
    b->loop[b->loops] =
        (border_loop){first, b->points, root(b->d->same, b->d->cycle[edge]), b->loops, area < 0};
    b->loops++;
    return PCG_OK;
}

/* Follows a border; where it comes back to a point that it has passed, what lies between is a loop
 * of its own. */
static int trace(borders *b, uint32_t start)
{
    uint32_t edge = start, point, from;

    b->path_length = 0;
    do {
        b->done[edge] = true;
        point = origin(b->d->p, edge);
        if (b->visit[point] != 0) {
            from = b->visit[point] - 1;
            if (end_loop(b, from, edge) != PCG_OK)
                return PCG_FAILED;
            while (b->path_length > from)
                b->visit[b->path[--b->path_length]] = 0;
        }
        b->path[b->path_length++] = point;
        b->visit[point] = b->path_length;
        edge = next_border(b->d, edge);
    } while (edge != start);
    if (end_loop(b, 0, start) != PCG_OK)
        return PCG_FAILED;
    while (b->path_length > 0)
        b->visit[b->path[--b->path_length]] = 0;
    return PCG_OK;
}

/* By face, the outline first, in order of appearance. */
static int compare_loops(const void *a, const void *b)
{
    const border_loop *s = a, *t = b;

    if (s->face != t->face)
        return s->face < t->face ? -1 : 1;
    if (s->hole != t->hole)
        return s->hole ? 1 : -1;
    return s->order < t->order ? -1 : s->order > t->order;
}

static int write_loops(const borders *b, polygons *out)
{
    const plane *p = b->d->p;

    if (b->loops > 1)
        qsort(b->loop, b->loops, sizeof *b->loop, compare_loops);
    for (uint32_t l = 0; l < b->loops; l++) {
        const border_loop *loop = &b->loop[l];
        bool orphan = loop->hole && (l == 0 || b->loop[l - 1].face != loop->face);

        if (loop->to - loop->from < 3 || orphan)
            continue;
        if (!loop->hole && polygons_begin_face(p->run, out) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t i = loop->from; i < loop->to; i++)
            if (polygons_add(p->run, out, p->point[b->point[i]].at) != PCG_OK)
                return PCG_FAILED;
        if (polygons_end_loop(p->run, out) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static int find_borders(borders *b, polygons *out)
{
    for (uint32_t e = 0; e < b->d->edges; e++)
        if (!b->done[e] && is_border(b->d, e) && trace(b, e) != PCG_OK)
            return PCG_FAILED;
    return write_loops(b, out);
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* Whether all that loops bound is shown, and nothing else. */
static bool shows_all(const drawing *d)
{
    for (uint32_t e = 0; e < d->edges; e++)
        if (d->winding[d->cycle[e]] != d->least && d->winding[d->cycle[e]] != d->least + 1)
            return false;
    return true;
}

static int draw(borders *b, polygons *out, bool *changed)
{
    drawing *d = b->d;

    sort_spokes(d);
    find_cycles(d);
    for (uint32_t i = 0; i < d->cycles; i++)
        d->same[i] = i;
    find_pieces(d);
    sort_pieces(d);
    find_windings(d);
    join_faces(d);
    if (find_borders(b, out) != PCG_OK)
        return PCG_FAILED;
    *changed = d->p->changed || b->simplified || !shows_all(d);
    return PCG_OK;
}

/* One block for everything that is as long as the points or half-edges are many. */
static size_t room_for(const plane *p)
{
    size_t edges = 2 * (size_t)p->segments + 1, points = (size_t)p->points + 2;

    return edges * (sizeof(spoke) + 4 * sizeof(uint32_t) + sizeof(int) + 2 * sizeof(bool)) +
           (edges + points) * sizeof(uint32_t) + points * 5 * sizeof(uint32_t);
}

static void share_room(char *room, const plane *p, drawing *d, borders *b)
{
    size_t edges = 2 * (size_t)p->segments + 1, points = (size_t)p->points + 2;
    uint32_t *word;

    d->spoke = (spoke *)room;
    word = (uint32_t *)(d->spoke + edges);
    d->place = word, word += edges;
    d->cycle = word, word += edges;
    d->same = word, word += edges;
    b->path = word, word += edges;
    d->todo = word, word += edges + points;
    d->winding = (int *)word, word += edges;
    d->first = word, word += points;
    d->piece = word, word += points;
    d->start = word, word += points;
    b->visit = word, word += points;
    d->known = (bool *)word;
    b->done = d->known + edges;
}

static int clean(const plane *p, int least, polygons *out, bool *changed)
{
    drawing d = {.p = p, .edges = 2 * p->segments, .least = least};
    borders b = {.d = &d};
    size_t size = room_for(p);
    char *room = run_alloc_zeroed(p->run, size);
    int status;

    if (room == NULL)
        return PCG_FAILED;
    share_room(room, p, &d, &b);
    status = draw(&b, out, changed);
    run_free(p->run, b.point, b.point_capacity * sizeof *b.point);
    run_free(p->run, b.loop, b.loop_capacity * sizeof *b.loop);
    run_free(p->run, room, size);
    return status;
}

int polygons_clean(pcg_run *r, const polygons *loops, int least, polygons *out, bool *changed)
{
    plane p;
    int status = plane_open(r, loops, &p);

    *changed = true;
    if (status == PCG_OK && p.segments > 0)
        status = clean(&p, least, out, changed);
    plane_close(&p);
    return status;
}

/* nearby.c - shapes as parts, and a tree of boxes over them.
 *
 * The tree halves the parts by the middles of their boxes along the longest extent, so that it is
 * balanced whatever the shapes are. A box comes before what it holds: its first half is the next
 * one.
 */
#include "nearby.h"

#include <math.h>

#include "runtime/list.h"
#include "runtime/mesh.h"
#include "runtime/run.h"

enum {
    LEAF_MAX = 4,
    DEPTH_MAX = 64 /* boxes on the way down; halving 2^32 parts takes 32 */
};

/* ---- shapes as parts ------------------------------------------------------------------------- */

int nearby_reader_open(pcg_run *r, nearby_reader *reader)
{
    *reader = (nearby_reader){.run = r, .triangulator = pcg_triangulator_new()};
    if (reader->triangulator != NULL)
        return PCG_OK;
    run_out_of_memory(r, sizeof(pcg_triangulator *));
    return PCG_FAILED;
}

void nearby_reader_close(nearby_reader *reader)
{
    pcg_triangulator_free(reader->triangulator);
    run_free(reader->run, reader->triangle, reader->triangle_capacity * sizeof *reader->triangle);
    run_free(reader->run, reader->used, reader->used_capacity * sizeof *reader->used);
}

static bool is_finite(pcg_vec3 p)
{
    return isfinite(p.x) && isfinite(p.y) && isfinite(p.z);
}

/* Adds a part of some of the shape's vertices. */
static int add_part(nearby_reader *reader, const pcg_shape *s, const uint32_t *vertex,
                    uint32_t corners, uint32_t owner, nearby_parts *to)
{
    nearby_part part = {.corners = corners, .owner = owner};

    for (uint32_t i = 0; i < 3; i++) {
        part.corner[i] =
            i < corners ? pcg_scope_point(&s->scope, shape_point(s, vertex[i])) : part.corner[0];
        if (!is_finite(part.corner[i]))
            return PCG_OK;
    }
    if (list_room(reader->run, (void **)&to->at, &to->capacity, to->count, 1, sizeof *to->at) !=
        PCG_OK)
        return PCG_FAILED;
    to->at[to->count++] = part;
    return PCG_OK;
}

static int read_face(nearby_reader *reader, const pcg_shape *s, uint32_t face, uint32_t owner,
                     nearby_parts *to)
{
    const pcg_mesh *m = s->mesh;
    uint32_t corners = face_last_corner(m, face) - face_first_corner(m, face);
    uint32_t loops = m->face_loop[face + 1] - m->face_loop[face], triangles;

    if (list_room(reader->run, (void **)&reader->triangle, &reader->triangle_capacity, 0,
                  3 * (corners + 2 * loops), sizeof *reader->triangle) != PCG_OK)
        return PCG_FAILED;
    triangles = pcg_triangulate(reader->triangulator, m, face, &s->scope.size, reader->triangle);
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t vertex[3];

        for (uint32_t k = 0; k < 3; k++)
            vertex[k] = m->corner_vertex[reader->triangle[3 * (size_t)i + k]];
        if (add_part(reader, s, vertex, 3, owner, to) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* The vertices that nothing uses. */
static int read_vertices(nearby_reader *reader, const pcg_shape *s, uint32_t owner,
                         nearby_parts *to)
{
    const pcg_mesh *m = s->mesh;

    if (m->forever)
        return PCG_OK;
    if (list_room(reader->run, (void **)&reader->used, &reader->used_capacity, 0, m->vertex_count,
                  sizeof *reader->used) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t v = 0; v < m->vertex_count; v++)
        reader->used[v] = false;
    for (uint32_t c = 0; c < m->corner_count; c++)
        reader->used[m->corner_vertex[c]] = true;
    for (size_t e = 0; e < 2 * (size_t)m->edge_count; e++)
        reader->used[m->edge_vertex[e]] = true;
    for (uint32_t v = 0; v < m->vertex_count; v++)
        if (!reader->used[v] && add_part(reader, s, &v, 1, owner, to) != PCG_OK)
            return PCG_FAILED;
    return PCG_OK;
}

int nearby_read(nearby_reader *reader, const pcg_shape *s, uint32_t owner, nearby_parts *parts)
{
    const pcg_mesh *m = s->mesh;

    for (uint32_t f = 0; f < m->face_count; f++)
        if (read_face(reader, s, f, owner, parts) != PCG_OK)
            return PCG_FAILED;
    for (uint32_t e = 0; e < m->edge_count; e++)
        if (add_part(reader, s, m->edge_vertex + 2 * (size_t)e, 2, owner, parts) != PCG_OK)
            return PCG_FAILED;
    return read_vertices(reader, s, owner, parts);
}

void nearby_parts_free(pcg_run *r, nearby_parts *parts)
{
    run_free(r, parts->at, parts->capacity * sizeof *parts->at);
    *parts = (nearby_parts){0};
}

/* ---- building -------------------------------------------------------------------------------- */

/* What is sorted while the tree is built. */
typedef struct sorted_part {
    pcg_vec3 middle;
    uint32_t part;
} sorted_part;

static void part_bounds(const nearby_part *p, pcg_vec3 *low, pcg_vec3 *high)
{
    *low = *high = p->corner[0];
    bounds_add(low, high, p->corner[1]);
    bounds_add(low, high, p->corner[2]);
}

static int longest_axis(pcg_vec3 low, pcg_vec3 high)
{
    pcg_vec3 d = vec3_subtract(high, low);

    if (d.x >= d.y && d.x >= d.z)
        return 0;
    return d.y >= d.z ? 1 : 2;
}

/* Moves the smaller half of the leaves from..to-1 along an axis before `middle`, in time that grows
 * with their number, whatever their order. */
static void halve(sorted_part *at, uint32_t from, uint32_t to, uint32_t middle, int axis)
{
    while (to - from > 1) {
        pcg_u64 chance = pcg_mix(from, to);
        double pivot = geometry_component(at[from + chance % (to - from)].middle, axis);
        uint32_t i = from, j = to - 1;

        for (;;) {
            while (geometry_component(at[i].middle, axis) < pivot)
                i++;
            while (geometry_component(at[j].middle, axis) > pivot)
                j--;
            if (i >= j)
                break;
            sorted_part kept = at[i];
            at[i++] = at[j];
            at[j--] = kept;
        }
        /* All before i are not above the pivot, all behind j not below it. */
        j = i > j ? i : j + 1;
        if (middle < j)
            to = j < to ? j : to - 1;
        else
            from = j > from ? j : from + 1;
    }
}

/* The box of the leaves from..to-1, with all that it holds. Room was made. */
static void build_box(nearby *n, const nearby_part *part, sorted_part *at, uint32_t from,
                      uint32_t to)
{
    uint32_t number = n->boxes++, middle = from + (to - from) / 2;
    nearby_box *box = &n->box[number];
    pcg_vec3 low, high, first = at[from].middle, last = first;

    part_bounds(&part[at[from].part], &box->low, &box->high);
    box->least = UINT32_MAX;
    for (uint32_t i = from; i < to; i++) {
        const nearby_part *p = &part[at[i].part];

        part_bounds(p, &low, &high);
        bounds_add(&box->low, &box->high, low);
        bounds_add(&box->low, &box->high, high);
        bounds_add(&first, &last, at[i].middle);
        box->least = p->owner < box->least ? p->owner : box->least;
    }
    if (to - from <= LEAF_MAX) {
        box->first = from;
        box->count = to - from;
        return;
    }
    box->count = 0;
    halve(at, from, to, middle, longest_axis(first, last));
    build_box(n, part, at, from, middle);
    box->first = n->boxes;
    build_box(n, part, at, middle, to);
}

/* Builds the tree over parts in any order, and puts them in its own. */
static int build(nearby *n)
{
    uint32_t count = n->parts.count;
    sorted_part *at = run_alloc_array(n->run, count, sizeof *at);
    nearby_parts sorted = {
        .at = run_alloc_array(n->run, count, sizeof *sorted.at), .count = count, .capacity = count};
    pcg_vec3 low, high;
    int status =
        at != NULL && sorted.at != NULL
            ? list_room(n->run, (void **)&n->box, &n->box_capacity, 0, count, sizeof *n->box)
            : PCG_FAILED;

    for (uint32_t i = 0; i < count && status == PCG_OK; i++) {
        part_bounds(&n->parts.at[i], &low, &high);
        at[i] = (sorted_part){vec3_scale(vec3_add(low, high), 0.5), i};
    }
    if (status == PCG_OK) {
        build_box(n, n->parts.at, at, 0, count);
        for (uint32_t i = 0; i < count; i++)
            sorted.at[i] = n->parts.at[at[i].part];
        nearby_parts_free(n->run, &n->parts);
        n->parts = sorted;
    } else if (sorted.at != NULL) {
        nearby_parts_free(n->run, &sorted);
    }
    run_free(n->run, at, count * sizeof *at);
    return status;
}

int nearby_open(pcg_call *call, nearby_reader *reader, const pcg_entities *shapes, nearby *n)
{
    int status = PCG_OK;

    *n = (nearby){.run = call->run};
    for (uint32_t i = 0; i < shapes->count && status == PCG_OK; i++) {
        status = nearby_read(reader, (const pcg_shape *)shapes->at[i], i, &n->parts);
        if (status == PCG_OK)
            status = pcg_tick(call);
    }
    return status == PCG_OK && n->parts.count > 0 ? build(n) : status;
}

void nearby_close(nearby *n)
{
    if (n->run == NULL)
        return;
    nearby_parts_free(n->run, &n->parts);
    run_free(n->run, n->box, n->box_capacity * sizeof *n->box);
}

/* ---- asking ---------------------------------------------------------------------------------- */

static bool is_taken(const nearby_filter *filter, uint32_t owner)
{
    return filter == NULL || filter->takes == NULL || filter->takes(filter->user, owner);
}

static double gap(double low, double high, double other_low, double other_high)
{
    double before = low - other_high, behind = other_low - high;
    double apart = before > behind ? before : behind; /* fmax is a call */

    return apart > 0 ? apart : 0;
}

/* The distance between two boxes, squared. */
static double box_square(const nearby_box *b, pcg_vec3 low, pcg_vec3 high)
{
    double x = gap(b->low.x, b->high.x, low.x, high.x);
    double y = gap(b->low.y, b->high.y, low.y, high.y);
    double z = gap(b->low.z, b->high.z, low.z, high.z);

    return x * x + y * y + z * z;
}

/* Boxes that are still to be looked into. */
typedef struct descent {
    struct {
        uint32_t box;
        double square;
    } at[DEPTH_MAX];
    uint32_t count;
} descent;

static void put_off(descent *d, uint32_t box, double square)
{
    d->at[d->count].box = box;
    d->at[d->count++].square = square;
}

/* Puts off both halves of a box, the farther one first. */
static void put_off_halves(descent *d, const nearby *n, uint32_t box, pcg_vec3 low, pcg_vec3 high)
{
    uint32_t left = box + 1, right = n->box[box].first;
    double to_left = box_square(&n->box[left], low, high);
    double to_right = box_square(&n->box[right], low, high);
    bool left_first = to_left <= to_right;

    put_off(d, left_first ? right : left, left_first ? to_right : to_left);
    put_off(d, left_first ? left : right, left_first ? to_left : to_right);
}

/* The search for what is nearest; hit.owner is UINT32_MAX while nothing is found. */
typedef struct search {
    const nearby_filter *filter;
    nearby_hit hit;
    double square; /* of the distance that is to be fallen below, or reached by a lower number */
} search;

static bool is_better(const search *s, double square, uint32_t owner)
{
    return square < s->square || (square == s->square && owner < s->hit.owner);
}

static void look_into(search *s, const nearby *n, const nearby_box *leaf, const nearby_part *of)
{
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
        const nearby_part *p = &n->parts.at[i];
        pcg_vec3 from, at;
        double square;

        if (!is_taken(s->filter, p->owner))
            continue;
        square = nearby_closest(of, p, &from, &at);
        if (is_better(s, square, p->owner)) {
            s->square = square;
            s->hit = (nearby_hit){p->owner, sqrt(square), from, at};
        }
    }
}

static void search_from(search *s, const nearby *n, const nearby_part *of)
{
    descent d = {.count = 0};
    pcg_vec3 low, high;

    part_bounds(of, &low, &high);
    put_off(&d, 0, box_square(&n->box[0], low, high));
    while (d.count > 0) {
        uint32_t box = d.at[--d.count].box;

        if (!is_better(s, d.at[d.count].square, n->box[box].least))
            continue;
        if (n->box[box].count > 0)
            look_into(s, n, &n->box[box], of);
        else
            put_off_halves(&d, n, box, low, high);
    }
}

bool nearby_nearest(const nearby *n, const nearby_parts *of, const nearby_filter *filter,
                    double within, nearby_hit *hit)
{
    search s = {.filter = filter, .hit.owner = UINT32_MAX, .square = within * within};

    if (!(within >= 0) || n->boxes == 0)
        return false;
    for (uint32_t i = 0; i < of->count; i++)
        search_from(&s, n, &of->at[i]);
    *hit = s.hit;
    return s.hit.owner != UINT32_MAX;
}

int nearby_around(const nearby *n, pcg_vec3 low, pcg_vec3 high, double reach, nearby_list *list)
{
    descent d = {.count = 0};

    list->count = 0;
    if (n->boxes > 0 && reach >= 0)
        put_off(&d, 0, 0);
    while (d.count > 0) {
        const nearby_box *b = &n->box[d.at[--d.count].box];
        uint32_t box = (uint32_t)(b - n->box);

        if (!(box_square(b, low, high) <= reach * reach))
            continue;
        if (b->count == 0) {
            put_off(&d, b->first, 0);
            put_off(&d, box + 1, 0);
            continue;
        }
        for (uint32_t i = b->first; i < b->first + b->count; i++) {
            nearby_box own = {.least = 0};

            part_bounds(&n->parts.at[i], &own.low, &own.high);
            if (!(box_square(&own, low, high) <= reach * reach))
                continue;
            if (list_room(n->run, (void **)&list->at, &list->capacity, list->count, 1,
                          sizeof *list->at) != PCG_OK)
                return PCG_FAILED;
            list->at[list->count++] = i;
        }
    }
    return PCG_OK;
}

void nearby_list_free(pcg_run *r, nearby_list *list)
{
    run_free(r, list->at, list->capacity * sizeof *list->at);
    *list = (nearby_list){0};
}

/* ---- lines of sight -------------------------------------------------------------------------- */

/* What is between two shares of a way. */
typedef struct sight {
    pcg_vec3 from, way, inverse; /* way by components; infinite where it does not move */
    double begin, end;
} sight;

/* Cuts begin … end down to where a coordinate is between two planes. A way along them that lies in
 * one of them is not cut. */
static void cut_between(double low, double high, double from, double inverse, double *begin,
                        double *end)
{
    double a = (low - from) * inverse, b = (high - from) * inverse;

    if (isinf(inverse)) {
        if (from < low || from > high)
            *end = -INFINITY;
        return;
    }
    *begin = fmax(*begin, fmin(a, b));
    *end = fmin(*end, fmax(a, b));
}

static bool sight_meets(const sight *s, const nearby_box *b)
{
    double begin = 0, end = 1;

    cut_between(b->low.x, b->high.x, s->from.x, s->inverse.x, &begin, &end);
    cut_between(b->low.y, b->high.y, s->from.y, s->inverse.y, &begin, &end);
    cut_between(b->low.z, b->high.z, s->from.z, s->inverse.z, &begin, &end);
    return begin <= end + 1e-9;
}

/* Whether the way goes through a triangle; its border is a hair wide, so that none slips between
 * two. */
static bool sight_hits(const sight *s, const nearby_part *t)
{
    pcg_vec3 b = vec3_subtract(t->corner[1], t->corner[0]),
             c = vec3_subtract(t->corner[2], t->corner[0]);
    pcg_vec3 across = vec3_cross(s->way, c), to = vec3_subtract(s->from, t->corner[0]), turned;
    double volume = vec3_dot(b, across), u, v, at, hair = 1e-9;

    if (t->corners < 3 || volume == 0)
        return false;
    u = vec3_dot(to, across) / volume;
    turned = vec3_cross(to, b);
    v = vec3_dot(s->way, turned) / volume;
    at = vec3_dot(c, turned) / volume;
    return u >= -hair && v >= -hair && u + v <= 1 + hair && at > s->begin && at < s->end;
}

static bool leaf_blocks(const sight *s, const nearby *n, const nearby_box *leaf,
                        const nearby_filter *filter)
{
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++)
        if (sight_hits(s, &n->parts.at[i]) && is_taken(filter, n->parts.at[i].owner))
            return true;
    return false;
}

bool nearby_blocks(const nearby *n, pcg_vec3 a, pcg_vec3 b, double margin,
                   const nearby_filter *filter)
{
    pcg_vec3 way = vec3_subtract(b, a);
    double share = margin / vec3_length(way);
    sight s = {.from = a,
               .way = way,
               .inverse = {1 / way.x, 1 / way.y, 1 / way.z},
               .begin = share,
               .end = 1 - share};
    descent d = {.count = 0};

    if (n->boxes > 0 && s.begin < s.end)
        put_off(&d, 0, 0);
    while (d.count > 0) {
        uint32_t box = d.at[--d.count].box;

        if (!sight_meets(&s, &n->box[box]))
            continue;
        if (n->box[box].count > 0) {
            if (leaf_blocks(&s, n, &n->box[box], filter))
                return true;
        } else {
            put_off(&d, n->box[box].first, 0);
            put_off(&d, box + 1, 0);
        }
    }
    return false;
}

/* mesh_slice.c - cuts faces by parallel planes.
 *
 * A face is seen in its own plane: v along the cutting axis, u across it. A cut takes the runs of
 * corners on one side and joins their ends along the plane, pairing neighbours: inside is between
 * the first and second end, the third and fourth, and so on. Ends in one place are told apart by
 * where their edges come from, so that corners on the plane, edges along it and holes that touch it
 * need no special case. Nearer to a plane than a billionth of the extent is on it.
 */
#include "runtime/mesh_slice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/base.h"
#include "runtime/list.h"
#include "runtime/mesh.h"

#define CHORD UINT32_MAX

typedef struct cut_corner {
    uint32_t vertex;   /* of the pieces */
    uint32_t from, to; /* the shape's edge that leaves it, in part; CHORD along a plane */
    double u, v;
    float uv[2], normal[3];
} cut_corner;

/* Part of a face: loops, outlines and holes in any order. */
typedef struct region {
    cut_corner *corner;
    uint32_t *end; /* where each loop ends */
    uint32_t count, capacity, loops, loop_capacity;
} region;

/* Where a run of corners leaves the kept side, or enters it. */
typedef struct run_end {
    double u, slope; /* along the plane, and how u changes on the way into the kept side */
    uint32_t run;
    bool leaves;
} run_end;

/* Corners first..last of the loop from..to-1, all on the kept side; what comes before and behind is
 * not. */
typedef struct corner_run {
    uint32_t first, last, from, to;
    cut_corner entry, leave; /* where the edges before and behind meet the plane */
    uint32_t next;           /* the run that follows along the plane */
    bool done;
} corner_run;

typedef struct slicer {
    pcg_call *call;
    const pcg_shape *shape;
    int axis;
    const double *plane;
    uint32_t planes;
    double near;  /* what is this near to a plane is on it */
    double least; /* twice the area that a piece must have */
    slices *out;
    region now, low, high;
    corner_run *run;
    run_end *end;
    uint32_t runs, run_capacity, end_capacity;
    uint32_t *crossing; /* a hash table of crossings: edge, plane, vertex + 1 */
    uint32_t crossings, crossing_slots;
    uint32_t *vertices; /* room for a loop */
    uint32_t vertex_capacity;
    pcg_vec3 across; /* direction of u for the face at hand */
    uint32_t face;
} slicer;

/* ---- regions --------------------------------------------------------------------------------- */

static int region_add(pcg_run *r, region *g, const cut_corner *c)
{
    if (list_room(r, (void **)&g->corner, &g->capacity, g->count, 1, sizeof *g->corner) != PCG_OK)
        return PCG_FAILED;
    g->corner[g->count++] = *c;
    return PCG_OK;
}

static uint32_t loop_first(const region *g, uint32_t loop)
{
    return loop > 0 ? g->end[loop - 1] : 0;
}

/* Ends the loop at hand: corners in one place in turn become one, and what has no three is taken
 * back. */
static int region_end_loop(pcg_run *r, region *g)
{
    uint32_t first = loop_first(g, g->loops), kept = first;

    for (uint32_t i = first; i < g->count; i++) {
        if (kept > first && g->corner[kept - 1].vertex == g->corner[i].vertex)
            g->corner[kept - 1] = g->corner[i];
        else
            g->corner[kept++] = g->corner[i];
    }
    while (kept > first + 1 && g->corner[kept - 1].vertex == g->corner[first].vertex)
        kept--;
    g->count = kept;
    if (kept - first < 3) {
        g->count = first;
        return PCG_OK;
    }
    if (list_room(r, (void **)&g->end, &g->loop_capacity, g->loops, 1, sizeof *g->end) != PCG_OK)
        return PCG_FAILED;
    g->end[g->loops++] = g->count;
    return PCG_OK;
}

static void region_free(pcg_run *r, region *g)
{
    run_free(r, g->corner, g->capacity * sizeof *g->corner);
    run_free(r, g->end, g->loop_capacity * sizeof *g->end);
}

/* ---- vertices on planes ---------------------------------------------------------------------- */

static uint32_t *crossing_slot(const slicer *w, uint32_t a, uint32_t b, uint32_t plane)
{
    uint64_t hash = ((uint64_t)a << 32 | b) * 0x9E3779B97F4A7C15u + plane * 0xC2B2AE3D27D4EB4Fu;
    uint32_t at =
        (uint32_t)((hash ^ hash >> 29) * 0xD6E8FEB86659FD93u >> 32) & (w->crossing_slots - 1);

    for (;; at = (at + 1) & (w->crossing_slots - 1)) {
        uint32_t *c = &w->crossing[4 * (size_t)at];

        if (c[3] == 0 || (c[0] == a && c[1] == b && c[2] == plane))
            return c;
    }
}

static int crossings_grow(slicer *w)
{
    uint32_t old_slots = w->crossing_slots, *old = w->crossing;

    w->crossing_slots = old_slots > 0 ? old_slots * 2 : 64;
    w->crossing = run_alloc_array(w->call->run, w->crossing_slots, 4 * sizeof *old);
    if (w->crossing == NULL) {
        w->crossing = old;
        w->crossing_slots = old_slots;
        return PCG_FAILED;
    }
    for (uint32_t i = 0; i < old_slots; i++) {
        const uint32_t *c = &old[4 * (size_t)i];

        if (c[3] != 0)
            memcpy(crossing_slot(w, c[0], c[1], c[2]), c, 4 * sizeof *c);
    }
    run_free(w->call->run, old, old_slots * 4 * sizeof *old);
    return PCG_OK;
}

static double *component(pcg_vec3 *p, int axis)
{
    return axis == 0 ? &p->x : axis == 1 ? &p->y : &p->z;
}

/* The vertex where an edge of the shape meets a plane; the same one from either side. UINT32_MAX:
 * no memory. */
static uint32_t crossing_vertex(slicer *w, uint32_t a, uint32_t b, uint32_t plane)
{
    pcg_vec3 p, q;
    uint32_t *slot;
    double t;

    if (2 * (w->crossings + 1) > w->crossing_slots && crossings_grow(w) != PCG_OK)
        return UINT32_MAX;
    slot = a < b ? crossing_slot(w, a, b, plane) : crossing_slot(w, b, a, plane);
    if (slot[3] != 0)
        return slot[3] - 1;
    p = w->out->pieces->position[a < b ? a : b];
    q = w->out->pieces->position[a < b ? b : a];
    t = (w->plane[plane] - *component(&p, w->axis)) /
        (*component(&q, w->axis) - *component(&p, w->axis));
    p = vec3_add(p, vec3_scale(vec3_subtract(q, p), t));
    *component(&p, w->axis) = w->plane[plane];
    slot[0] = a < b ? a : b;
    slot[1] = a < b ? b : a;
    slot[2] = plane;
    /* UINT32_MAX, when memory has run out, leaves the slot empty. */
    slot[3] = pcg_mesh_add_vertex(w->call->run, w->out->pieces, p) + 1;
    w->crossings++;
    return slot[3] - 1;
}

/* ---- one cut --------------------------------------------------------------------------------- */

/* A side of a plane: sign -1 keeps what is below, 1 what is above. Turning by half a turn makes one
 * the other. */
typedef struct half {
    uint32_t plane;
    double at, sign;
} half;

static bool is_kept(const slicer *w, const half *h, const cut_corner *c)
{
    return h->sign * (c->v - h->at) > w->near;
}

/* Where the edge between a kept corner and one that is not meets the plane. It leaves the corner
 * `leaving`. */
static int meet(slicer *w, const half *h, const cut_corner *kept, const cut_corner *other,
                const cut_corner *leaving, cut_corner *out)
{
    float t;

    if (fabs(other->v - h->at) <= w->near || leaving->from == CHORD) {
        *out = *other;
    } else {
        double share = (h->at - kept->v) / (other->v - kept->v);

        t = (float)share;
        out->vertex = crossing_vertex(w, leaving->from, leaving->to, h->plane);
        if (out->vertex == UINT32_MAX)
            return PCG_FAILED;
        out->u = kept->u + share * (other->u - kept->u);
        out->v = h->at;
        for (int i = 0; i < 2; i++)
            out->uv[i] = kept->uv[i] + t * (other->uv[i] - kept->uv[i]);
        for (int i = 0; i < 3; i++)
            out->normal[i] = kept->normal[i] + t * (other->normal[i] - kept->normal[i]);
    }
    out->from = leaving->from;
    out->to = leaving->to;
    return PCG_OK;
}

/* How far along the plane an edge moves on its way into the kept side. */
static double slope_into(const half *h, const cut_corner *on, const cut_corner *inside)
{
    return h->sign * (inside->u - on->u) / fabs(inside->v - h->at);
}

static int add_run(slicer *w, const half *h, const region *g, uint32_t first, uint32_t last,
                   uint32_t from, uint32_t to)
{
    corner_run *run;
    uint32_t before = first > from ? first - 1 : to - 1, behind = last + 1 < to ? last + 1 : from;

    if (list_room(w->call->run, (void **)&w->run, &w->run_capacity, w->runs, 1, sizeof *w->run) !=
            PCG_OK ||
        list_room(w->call->run, (void **)&w->end, &w->end_capacity, 2 * w->runs, 2,
                  sizeof *w->end) != PCG_OK)
        return PCG_FAILED;
    run = &w->run[w->runs];
    *run = (corner_run){.first = first, .last = last, .from = from, .to = to};
    if (meet(w, h, &g->corner[first], &g->corner[before], &g->corner[before], &run->entry) !=
            PCG_OK ||
        meet(w, h, &g->corner[last], &g->corner[behind], &g->corner[last], &run->leave) != PCG_OK)
        return PCG_FAILED;
    run->leave.from = CHORD;
    w->end[2 * (size_t)w->runs] = (run_end){
        h->sign * run->entry.u, slope_into(h, &run->entry, &g->corner[first]), w->runs, false};
    w->end[2 * (size_t)w->runs + 1] = (run_end){
        h->sign * run->leave.u, slope_into(h, &run->leave, &g->corner[last]), w->runs, true};
    w->runs++;
    return PCG_OK;
}

/* Finds the runs of a loop that has corners on both sides. */
static int find_runs(slicer *w, const half *h, const region *g, uint32_t from, uint32_t to)
{
    uint32_t start = from, i;

    while (is_kept(w, h, &g->corner[start]))
        start++; /* one is not kept */
    for (uint32_t n = 1; n <= to - from; n++) {
        uint32_t first = from + (start - from + n) % (to - from), last = first;

        if (!is_kept(w, h, &g->corner[first]))
            continue;
        for (i = last; is_kept(w, h, &g->corner[i]); i = i + 1 < to ? i + 1 : from, n++)
            last = i;
        if (add_run(w, h, g, first, last, from, to) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static int compare_ends(const void *a, const void *b)
{
    const run_end *p = a, *q = b;

    if (p->u != q->u)
        return p->u < q->u ? -1 : 1;
    if (p->slope != q->slope)
        return p->slope < q->slope ? -1 : 1;
    return p->run != q->run ? (p->run < q->run ? -1 : 1) : p->leaves - q->leaves;
}

/* Joins each run's end along the plane to the run that begins at the neighbouring place. With the
 * kept side above, u to the right: a run leaves on the left of the place where the next enters.
 * Where the ends do not pair so, the polygon crosses itself, and runs follow one another as in
 * their loop. */
static void pair_ends(slicer *w)
{
    bool paired = true;

    qsort(w->end, 2 * (size_t)w->runs, sizeof *w->end, compare_ends);
    for (uint32_t i = 0; i < w->runs && paired; i++)
        paired = w->end[2 * (size_t)i].leaves && !w->end[2 * (size_t)i + 1].leaves;
    for (uint32_t i = 0; i < w->runs && paired; i++)
        w->run[w->end[2 * (size_t)i].run].next = w->end[2 * (size_t)i + 1].run;
    for (uint32_t i = 0, first = 0; i < w->runs && !paired; i++) {
        bool last = i + 1 == w->runs || w->run[i + 1].from != w->run[i].from;

        w->run[i].next = last ? first : i + 1;
        first = last ? i + 1 : first;
    }
}

static int add_run_corners(slicer *w, const region *g, const corner_run *run, region *to)
{
    if (region_add(w->call->run, to, &run->entry) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = run->first;; i = i + 1 < run->to ? i + 1 : run->from) {
        if (region_add(w->call->run, to, &g->corner[i]) != PCG_OK)
            return PCG_FAILED;
        if (i == run->last)
            break;
    }
    return region_add(w->call->run, to, &run->leave);
}

static int join_runs(slicer *w, const region *g, region *to)
{
    for (uint32_t i = 0; i < w->runs; i++) {
        if (w->run[i].done)
            continue;
        for (uint32_t at = i; !w->run[at].done; at = w->run[at].next) {
            w->run[at].done = true;
            if (add_run_corners(w, g, &w->run[at], to) != PCG_OK)
                return PCG_FAILED;
        }
        if (region_end_loop(w->call->run, to) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static int keep_loop(slicer *w, const region *g, uint32_t from, uint32_t to, region *out)
{
    for (uint32_t i = from; i < to; i++)
        if (region_add(w->call->run, out, &g->corner[i]) != PCG_OK)
            return PCG_FAILED;
    return region_end_loop(w->call->run, out);
}

/* What of a region is on one side of a plane. */
static int cut_half(slicer *w, const region *g, const half *h, region *out)
{
    out->count = out->loops = w->runs = 0;
    for (uint32_t l = 0; l < g->loops; l++) {
        uint32_t from = loop_first(g, l), to = g->end[l], kept = 0;
        int status = PCG_OK;

        for (uint32_t i = from; i < to; i++)
            kept += is_kept(w, h, &g->corner[i]);
        if (kept == to - from)
            status = keep_loop(w, g, from, to, out);
        else if (kept > 0)
            status = find_runs(w, h, g, from, to);
        if (status != PCG_OK)
            return status;
    }
    if (w->runs == 0)
        return PCG_OK;
    pair_ends(w);
    return join_runs(w, g, out);
}

/* ---- pieces ---------------------------------------------------------------------------------- */

static double loop_area(const region *g, uint32_t loop)
{
    uint32_t from = loop_first(g, loop), to = g->end[loop];
    double sum = 0, u = g->corner[from].u, v = g->corner[from].v;

    for (uint32_t i = from, j = to - 1; i < to; j = i++)
        sum += (g->corner[j].u - u) * (g->corner[i].v - v) -
               (g->corner[j].v - v) * (g->corner[i].u - u);
    return sum;
}

static bool contains(const region *g, uint32_t loop, const cut_corner *p)
{
    uint32_t from = loop_first(g, loop), to = g->end[loop];
    bool inside = false;

    for (uint32_t i = from, j = to - 1; i < to; j = i++) {
        const cut_corner *a = &g->corner[j], *b = &g->corner[i];

        if ((a->v > p->v) != (b->v > p->v) &&
            p->u < a->u + (p->v - a->v) / (b->v - a->v) * (b->u - a->u))
            inside = !inside;
    }
    return inside;
}

static void copy_streams(const slicer *w, const region *g, uint32_t from, uint32_t count)
{
    pcg_mesh *m = w->out->pieces;
    size_t at = m->corner_count - count;

    for (uint32_t i = 0; i < count; i++, at++) {
        const cut_corner *c = &g->corner[from + i];

        if (m->corner_uv != NULL)
            memcpy(&m->corner_uv[2 * at], c->uv, sizeof c->uv);
        if (m->corner_normal != NULL)
            memcpy(&m->corner_normal[3 * at], c->normal, sizeof c->normal);
    }
}

static int add_piece_loop(slicer *w, const region *g, uint32_t loop, bool hole)
{
    uint32_t from = loop_first(g, loop), count = g->end[loop] - from, added;
    pcg_mesh *m = w->out->pieces;

    if (list_room(w->call->run, (void **)&w->vertices, &w->vertex_capacity, 0, count,
                  sizeof *w->vertices) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++)
        w->vertices[i] = g->corner[from + i].vertex;
    added = hole ? pcg_mesh_add_hole(w->call->run, m, w->vertices, count)
                 : pcg_mesh_add_face(w->call->run, m, w->vertices, count);
    if (added == UINT32_MAX)
        return PCG_FAILED;
    copy_streams(w, g, from, count);
    return PCG_OK;
}

static int note_piece(slicer *w, uint32_t slab)
{
    pcg_mesh *m = w->out->pieces;
    const pcg_mesh *from = w->shape->mesh;

    if (list_room(w->call->run, (void **)&w->out->slab, &w->out->slab_capacity, m->face_count - 1,
                  1, sizeof *w->out->slab) != PCG_OK)
        return PCG_FAILED;
    w->out->slab[m->face_count - 1] = slab;
    if (m->face_material != NULL)
        m->face_material[m->face_count - 1] = from->face_material[w->face];
    if (m->face_tag != NULL)
        m->face_tag[m->face_count - 1] = from->face_tag[w->face];
    return PCG_OK;
}

/* Whether a loop, which turns right, is a hole of another, which turns left; with one outline there
 * is no question. */
static bool is_hole_of(const region *g, uint32_t hole, uint32_t outline, uint32_t outlines)
{
    return outlines == 1 || contains(g, outline, &g->corner[loop_first(g, hole)]);
}

/* Adds a region's outlines as faces, each with its holes. */
static int add_pieces(slicer *w, const region *g, uint32_t slab)
{
    uint32_t outlines = 0;

    for (uint32_t l = 0; l < g->loops; l++)
        outlines += loop_area(g, l) > w->least;
    for (uint32_t l = 0; l < g->loops; l++) {
        if (!(loop_area(g, l) > w->least))
            continue;
        if (add_piece_loop(w, g, l, false) != PCG_OK || note_piece(w, slab) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t k = 0; k < g->loops; k++)
            if (loop_area(g, k) < -w->least && is_hole_of(g, k, l, outlines) &&
                add_piece_loop(w, g, k, true) != PCG_OK)
                return PCG_FAILED;
    }
    return PCG_OK;
}

/* ---- faces ----------------------------------------------------------------------------------- */

/* The loops of a face as they are. */
static int load_face(slicer *w)
{
    const pcg_mesh *m = w->shape->mesh;

    w->now.count = w->now.loops = 0;
    for (uint32_t l = m->face_loop[w->face]; l < m->face_loop[w->face + 1]; l++) {
        uint32_t first = m->loop_corner[l], end = m->loop_corner[l + 1];

        for (uint32_t i = first; i < end; i++) {
            uint32_t vertex = m->corner_vertex[i];
            pcg_vec3 p = w->out->pieces->position[vertex];
            cut_corner c = {vertex,
                            vertex,
                            m->corner_vertex[i + 1 < end ? i + 1 : first],
                            vec3_dot(p, w->across),
                            *component(&p, w->axis),
                            {0, 0},
                            {0, 0, 0}};

            if (m->corner_uv != NULL)
                memcpy(c.uv, &m->corner_uv[2 * (size_t)i], sizeof c.uv);
            if (m->corner_normal != NULL)
                memcpy(c.normal, &m->corner_normal[3 * (size_t)i], sizeof c.normal);
            if (region_add(w->call->run, &w->now, &c) != PCG_OK)
                return PCG_FAILED;
        }
        if (region_end_loop(w->call->run, &w->now) != PCG_OK)
            return PCG_FAILED;
        if (w->now.loops == 0)
            break; /* no outline, no face */
    }
    return PCG_OK;
}

/* How many planes are below, and not at, a place. */
static uint32_t planes_below(const slicer *w, double at)
{
    uint32_t low = 0, high = w->planes;

    while (low < high) {
        uint32_t middle = low + (high - low) / 2;

        if (w->plane[middle] < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The slabs that the loaded face reaches into; one in a plane belongs to that which it closes. */
static void find_slabs(const slicer *w, double along, uint32_t *first, uint32_t *last)
{
    double low = w->now.corner[0].v, high = low;

    for (uint32_t i = 1; i < w->now.count; i++) {
        low = fmin(low, w->now.corner[i].v);
        high = fmax(high, w->now.corner[i].v);
    }
    if (high - low <= w->near)
        *first = *last = planes_below(w, low + (along > 0 ? -w->near : w->near));
    else {
        *first = planes_below(w, low + w->near);
        *last = planes_below(w, high - w->near);
    }
}

static void swap_regions(region *a, region *b)
{
    region kept = *a;

    *a = *b;
    *b = kept;
}

/* Each loop as it is: for what is not cut. */
static int add_whole(slicer *w, uint32_t slab)
{
    for (uint32_t l = 0; l < w->now.loops; l++)
        if (add_piece_loop(w, &w->now, l, l > 0) != PCG_OK ||
            (l == 0 && note_piece(w, slab) != PCG_OK))
            return PCG_FAILED;
    return PCG_OK;
}

static int slice_face(slicer *w)
{
    pcg_vec3 normal = vec3_normal(pcg_shape_face_normal(w->shape, w->face)), axis = vec3(0, 0, 0);
    uint32_t first, last;

    *component(&axis, w->axis) = 1;
    w->across = vec3_normal(vec3_cross(axis, normal));
    if (load_face(w) != PCG_OK)
        return PCG_FAILED;
    if (w->now.loops == 0)
        return PCG_OK;
    find_slabs(w, vec3_dot(axis, normal), &first, &last);
    if (first >= last || vec3_dot(w->across, w->across) == 0)
        return add_whole(w, first);
    for (uint32_t k = first; k < last; k++) {
        if (cut_half(w, &w->now, &(half){k, w->plane[k], -1}, &w->low) != PCG_OK ||
            add_pieces(w, &w->low, k) != PCG_OK ||
            cut_half(w, &w->now, &(half){k, w->plane[k], 1}, &w->high) != PCG_OK)
            return PCG_FAILED;
        swap_regions(&w->now, &w->high);
        if (pcg_tick(w->call) != PCG_OK)
            return PCG_FAILED;
    }
    return add_pieces(w, &w->now, last);
}

static int slice_faces(slicer *w)
{
    const pcg_mesh *m = w->shape->mesh;
    pcg_run *r = w->call->run;
    pcg_mesh *to = w->out->pieces;

    for (uint32_t i = 0; i < m->vertex_count; i++)
        if (pcg_mesh_add_vertex(r, to, shape_point(w->shape, i)) == UINT32_MAX)
            return PCG_FAILED;
    if ((m->corner_uv != NULL && pcg_mesh_need_uvs(r, to) != PCG_OK) ||
        (m->corner_normal != NULL && pcg_mesh_need_normals(r, to) != PCG_OK) ||
        (m->face_material != NULL && pcg_mesh_need_materials(r, to) != PCG_OK) ||
        (m->face_tag != NULL && pcg_mesh_need_tags(r, to) != PCG_OK))
        return PCG_FAILED;
    for (w->face = 0; w->face < m->face_count; w->face++)
        if (slice_face(w) != PCG_OK)
            return PCG_FAILED;
    return PCG_OK;
}

int slices_open(pcg_call *c, const pcg_shape *s, int axis, const double *plane, uint32_t planes,
                slices *out)
{
    pcg_vec3 size = s->scope.size;
    double extent = fmax(size.x, fmax(size.y, size.z));
    slicer w = {.call = c,
                .shape = s,
                .axis = axis,
                .plane = plane,
                .planes = planes,
                .out = out,
                .near = 1e-9 * *component(&size, axis),
                .least = 1e-12 * extent * extent};
    int status;

    *out = (slices){.pieces = pcg_mesh_new(c->run, false)};
    status = out->pieces != NULL ? slice_faces(&w) : PCG_FAILED;
    region_free(c->run, &w.now);
    region_free(c->run, &w.low);
    region_free(c->run, &w.high);
    run_free(c->run, w.run, w.run_capacity * sizeof *w.run);
    run_free(c->run, w.end, w.end_capacity * sizeof *w.end);
    run_free(c->run, w.crossing, w.crossing_slots * 4 * sizeof *w.crossing);
    run_free(c->run, w.vertices, w.vertex_capacity * sizeof *w.vertices);
    return status;
}

void slices_close(pcg_run *r, slices *out)
{
    pcg_mesh_drop(r, out->pieces);
    run_free(r, out->slab, out->slab_capacity * sizeof *out->slab);
}

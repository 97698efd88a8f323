/* triangles.c - the faces of a shape as triangles, in the coordinates of the file.
 *
 * Coordinates go through double once and are rounded to float at the end, so that what meets in
 * the world meets in the file. Everything that a file must not hold is left out here:
 * coordinates that are not finite, faces without an area, triangles with two corners in one
 * place.
 */
#include "stdlib/io/io.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- room ------------------------------------------------------------------------------------ */

/* Old content is kept. Counts stay below 2^32: what would pass it finds no memory long before. */
static void *grow(io_job *j, void *old, uint32_t *capacity, uint64_t wanted, size_t size)
{
    uint64_t room = *capacity < 64 ? 64 : *capacity;
    while (room < wanted)
        room *= 2;
    if (room > UINT32_MAX)
        longjmp(j->out_of_memory, 1);
    void *result = arena_resize(&j->memory, old, *capacity * size, (size_t)room * size);
    *capacity = (uint32_t)room;
    return result;
}

void batch_reserve(io_job *j, io_batch *b, uint64_t vertices, uint64_t indices)
{
    if (b->vertex_count + vertices > b->vertex_capacity)
        b->vertices = grow(j, b->vertices, &b->vertex_capacity, b->vertex_count + vertices,
                           b->stride * sizeof(float));
    if (b->index_count + indices > b->index_capacity)
        b->indices = grow(j, b->indices, &b->index_capacity, b->index_count + indices,
                          sizeof(uint32_t));
}

void batch_bound(io_batch *b)
{
    for (int i = 0; !b->bounded && i < 3; i++) {
        b->low[i] = INFINITY;
        b->high[i] = -INFINITY;
    }
    for (; b->bounded < b->vertex_count; b->bounded++) {
        const float *at = b->vertices + (size_t)b->stride * b->bounded;
        for (int i = 0; i < 3; i++) {
            b->low[i] = at[i] < b->low[i] ? at[i] : b->low[i];
            b->high[i] = at[i] > b->high[i] ? at[i] : b->high[i];
        }
    }
}

static void reserve_scratch(io_tessellator *t, uint32_t vertices)
{
    arena *a = &t->job->memory;
    if (t->world && vertices <= t->vertex_capacity)
        return;
    uint32_t room = vertices < 256 ? 256 : vertices > UINT32_MAX / 2 ? vertices : vertices * 2;
    t->world = arena_alloc_array(a, 3 * sizeof(double), room);
    t->position = arena_alloc_array(a, 3 * sizeof(float), room);
    t->shared = arena_alloc_array(a, sizeof(uint32_t), room);
    t->bad = arena_alloc_array(a, sizeof(bool), room);
    t->vertex_capacity = room;
}

/* ---- a shape's vertices ---------------------------------------------------------------------- */

static void set_column(double rows[3][4], int column, pcg_vec3 v, bool y_up)
{
    rows[0][column] = v.x;
    rows[1][column] = y_up ? v.z : v.y;
    rows[2][column] = y_up ? -v.y : v.z;
}

/* A scope that holds what is not finite gives vertices that are not finite, and they are left
 * out. */
static void set_frame(io_tessellator *t)
{
    static const pcg_vec3 own[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const pcg_scope *s = &t->shape->scope;
    const double scale[3] = {t->mesh->unit ? s->size.x : 1, t->mesh->unit ? s->size.y : 1,
                             t->mesh->unit ? s->size.z : 1};
    double turn[3][4];
    for (int k = 0; k < 3; k++) {
        pcg_vec3 axis = t->local ? own[k] : s->axis[k];
        set_column(t->rows, k, vec3_scale(axis, scale[k]), t->y_up);
        set_column(turn, k, axis, t->y_up);
    }
    pcg_vec3 origin = t->local ? vec3(0, 0, 0) : vec3_subtract(s->origin, t->center);
    set_column(t->rows, 3, origin, t->y_up);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            t->turn[i][k] = turn[i][k];
}

void tessellate_frame(io_tessellator *t, const pcg_shape *s)
{
    t->shape = s;
    t->mesh = s->mesh;
    set_frame(t);
    reserve_scratch(t, s->mesh->vertex_count);
}

void tessellate_begin(io_tessellator *t, const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    tessellate_frame(t, s);
    t->any_bad = false;
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        const pcg_vec3 p = m->position[v];
        bool good = true;
        for (int i = 0; i < 3; i++) {
            double x = t->rows[i][0] * p.x + t->rows[i][1] * p.y + t->rows[i][2] * p.z +
                       t->rows[i][3];
            t->world[3 * (size_t)v + (size_t)i] = x;
            t->position[3 * (size_t)v + (size_t)i] = (float)x;
            good = good && fabs(x) <= (double)FLT_MAX;
        }
        t->bad[v] = !good;
        t->any_bad = t->any_bad || !good;
    }
    if (m->corner_normal)
        memset(t->shared, 0xff, m->vertex_count * sizeof *t->shared);
}

/* ---- faces ----------------------------------------------------------------------------------- */

/* A face while it is appended. Corners are those of the mesh, first … end-1. */
typedef struct face {
    const uint32_t *vertex; /* of corner `first` and those behind it */
    uint32_t first, count, loops;
    double normal[3];       /* of length 1 */
    bool halves;            /* has four corners; the triangles 0 1 2 and 0 2 3 are it */
} face;

/* Twice the area of a triangle, as a normal. */
static void cross(double out[3], const double *a, const double *b, const double *c)
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static const double *place(const io_tessellator *t, const face *f, uint32_t i)
{
    return t->world + 3 * (size_t)f->vertex[i];
}

static void add_loop_normal(const io_tessellator *t, const uint32_t *vertex, uint32_t count,
                            double sum[3])
{
    const double *apex = t->world + 3 * (size_t)vertex[0];
    for (uint32_t i = 2; i < count; i++) {
        double n[3];
        cross(n, apex, t->world + 3 * (size_t)vertex[i - 1], t->world + 3 * (size_t)vertex[i]);
        sum[0] += n[0];
        sum[1] += n[1];
        sum[2] += n[2];
    }
}

/* Four corners are most of all faces. Where both halves turn like the whole, they cover it. */
static void sum_quad(const io_tessellator *t, face *f, double sum[3])
{
    double a[3], b[3];
    cross(a, place(t, f, 0), place(t, f, 1), place(t, f, 2));
    cross(b, place(t, f, 0), place(t, f, 2), place(t, f, 3));
    for (int i = 0; i < 3; i++)
        sum[i] = a[i] + b[i];
    f->halves = dot(a, sum) > 0 && dot(b, sum) > 0;
}

/* To length 1; false where it has none. Squares of what is very large or small are out of range. */
static bool normalize(const double sum[3], double out[3])
{
    double scale = 1, square = dot(sum, sum);
    if (!(square > 1e-200 && square < 1e200)) {
        double largest = fmax(fmax(fabs(sum[0]), fabs(sum[1])), fabs(sum[2]));
        if (!(largest > 0 && largest <= DBL_MAX))
            return false;
        scale = 1 / largest;
        const double scaled[3] = {sum[0] * scale, sum[1] * scale, sum[2] * scale};
        square = dot(scaled, scaled);
        if (!(square < 1e200)) /* 1 / largest was none */
            return false;
    }
    scale /= sqrt(square);
    for (int i = 0; i < 3; i++)
        out[i] = sum[i] * scale;
    return true;
}

/* False where the face has no area. */
static bool find_normal(const io_tessellator *t, uint32_t number, face *f)
{
    const pcg_mesh *m = t->mesh;
    double sum[3] = {0, 0, 0};
    if (f->loops == 1 && f->count == 4) {
        sum_quad(t, f, sum);
        return normalize(sum, f->normal);
    }
    for (uint32_t l = m->face_loop[number]; l < m->face_loop[number + 1]; l++) {
        uint32_t from = m->loop_corner[l], count = m->loop_corner[l + 1] - from;
        if (count > 2)
            add_loop_normal(t, m->corner_vertex + from, count, sum);
    }
    return normalize(sum, f->normal);
}

static bool any_bad(const io_tessellator *t, const face *f)
{
    for (uint32_t i = 0; i < f->count; i++)
        if (t->bad[f->vertex[i]])
            return true;
    return false;
}

/* Three corners a triangle into t->corners, counted from the face's first. */
static uint32_t triangulate(io_tessellator *t, uint32_t number, const face *f)
{
    static const uint32_t fan[6] = {0, 1, 2, 0, 2, 3};
    uint64_t room = 3 * ((uint64_t)f->count + 2 * (uint64_t)(f->loops - 1)) + 6;
    if (room > t->corner_capacity)
        t->corners = grow(t->job, t->corners, &t->corner_capacity, room, sizeof(uint32_t));
    if (f->halves || (f->loops == 1 && f->count == 3)) {
        memcpy(t->corners, fan, sizeof fan);
        return f->count - 2;
    }
    const pcg_vec3 *scale = t->mesh->unit ? &t->shape->scope.size : NULL;
    uint32_t count =
        pcg_triangulate(io_triangulator(t->job), t->mesh, number, scale, t->corners);
    for (uint32_t i = 0; i < 3 * count; i++)
        t->corners[i] -= f->first;
    return count;
}

/* The corner's own normal turned to the file's axes; the face's where it has none that makes
 * sense. */
static void put_normal(const io_tessellator *t, const face *f, uint32_t corner, float *to)
{
    const float *n = t->mesh->corner_normal + 3 * (size_t)corner;
    const double own[3] = {(double)n[0], (double)n[1], (double)n[2]};
    const double turned[3] = {dot(t->turn[0], own), dot(t->turn[1], own), dot(t->turn[2], own)};
    double square = dot(turned, turned);
    bool usable = square > 1e-12 && square < 1e12;
    double length = usable ? sqrt(square) : 1;
    for (int i = 0; i < 3; i++)
        to[i] = (float)(usable ? turned[i] / length : f->normal[i]);
}

void tessellate_uv(const io_tessellator *t, uint32_t corner, float to[2])
{
    const float *uv = t->mesh->corner_uv ? t->mesh->corner_uv + 2 * (size_t)corner : NULL;
    to[0] = uv && isfinite(uv[0]) ? uv[0] : 0;
    to[1] = uv && isfinite(uv[1]) ? uv[1] : 0;
    if (t->flip_v)
        to[1] = 1 - to[1];
}

/* Appends a corner and returns its index in the batch. With corner normals, one that is the same
 * as its vertex was last time, in another face, is shared. */
static uint32_t put_corner(io_tessellator *t, const face *f, uint32_t i, io_batch *b)
{
    uint32_t vertex = f->vertex[i], before = t->shared[vertex];
    float *to = b->vertices + (size_t)b->stride * b->vertex_count;
    memcpy(to, t->position + 3 * (size_t)vertex, 3 * sizeof(float));
    put_normal(t, f, f->first + i, to + 3);
    if (b->stride == IO_TEXTURED)
        tessellate_uv(t, f->first + i, to + 6);
    if (before < b->vertex_count &&
        memcmp(b->vertices + (size_t)b->stride * before, to, b->stride * sizeof(float)) == 0)
        return before;
    t->shared[vertex] = b->vertex_count;
    return b->vertex_count++;
}

/* Appends all corners of a face that has one normal. */
static void put_flat_corners(io_tessellator *t, const face *f, io_batch *b)
{
    const float normal[3] = {(float)f->normal[0], (float)f->normal[1], (float)f->normal[2]};
    float *to = b->vertices + (size_t)b->stride * b->vertex_count;
    for (uint32_t i = 0; i < f->count; i++, to += b->stride) {
        const float *from = t->position + 3 * (size_t)f->vertex[i];
        to[0] = from[0];
        to[1] = from[1];
        to[2] = from[2];
        to[3] = normal[0];
        to[4] = normal[1];
        to[5] = normal[2];
        if (b->stride == IO_TEXTURED)
            tessellate_uv(t, f->first + i, to + 6);
    }
    b->vertex_count += f->count;
}

static bool same_place(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Whether corners a, b, c of the face are in three places. */
static bool is_triangle(const io_tessellator *t, const face *f, const uint32_t *corner)
{
    const float *a = t->position + 3 * (size_t)f->vertex[corner[0]];
    const float *b = t->position + 3 * (size_t)f->vertex[corner[1]];
    const float *c = t->position + 3 * (size_t)f->vertex[corner[2]];
    return !same_place(a, b) && !same_place(b, c) && !same_place(c, a);
}

/* Corners of faces with flat normals follow each other; others go where put_corner says. */
static void put_triangles(io_tessellator *t, const face *f, io_batch *b, uint32_t count)
{
    uint32_t first = b->vertex_count, *to = b->indices + b->index_count;
    if (!t->mesh->corner_normal) {
        put_flat_corners(t, f, b);
        for (uint32_t i = 0; i < 3 * count; i++)
            to[i] = first + t->corners[i];
    } else {
        for (uint32_t i = 0; i < 3 * count; i++)
            to[i] = put_corner(t, f, t->corners[i], b);
    }
    b->index_count += 3 * count;
}

/* False where nothing of the face goes into a file. */
static bool take_face(io_tessellator *t, uint32_t number, face *f)
{
    const pcg_mesh *m = t->mesh;
    uint32_t first_loop = m->face_loop[number], end_loop = m->face_loop[number + 1];
    if (first_loop == end_loop)
        return false;
    f->first = m->loop_corner[first_loop];
    f->loops = end_loop - first_loop;
    f->halves = false;
    f->count = m->loop_corner[end_loop] - f->first;
    f->vertex = m->corner_vertex + f->first;
    if (f->count < 3)
        return false;
    if (t->any_bad && any_bad(t, f)) {
        t->not_finite++;
        return false;
    }
    return find_normal(t, number, f);
}

/* Triangulates, and leaves out what has two corners in one place. */
static uint32_t cut(io_tessellator *t, uint32_t number, const face *f)
{
    uint32_t count = triangulate(t, number, f), kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (is_triangle(t, f, t->corners + 3 * (size_t)i))
            memmove(t->corners + 3 * (size_t)kept++, t->corners + 3 * (size_t)i,
                    3 * sizeof(uint32_t));
    return kept;
}

uint32_t tessellate_face(io_tessellator *t, uint32_t number, io_batch *b)
{
    face f;
    if (!take_face(t, number, &f))
        return 0;
    uint32_t count = cut(t, number, &f);
    if (!count)
        return 0;
    batch_reserve(t->job, b, (uint64_t)f.count + 3 * (uint64_t)count, 3 * (uint64_t)count);
    put_triangles(t, &f, b, count);
    return count;
}

uint32_t tessellate_cut(io_tessellator *t, uint32_t number, const uint32_t **corners,
                        double normal[3])
{
    face f;
    uint32_t count = take_face(t, number, &f) ? cut(t, number, &f) : 0;
    *corners = t->corners;
    if (count)
        memcpy(normal, f.normal, sizeof f.normal);
    return count;
}

bool tessellate_usable(io_tessellator *t, uint32_t number)
{
    face f;
    return take_face(t, number, &f);
}

uint32_t tessellate_face_corners(const pcg_mesh *m, uint32_t number)
{
    uint32_t corners = m->loop_corner[m->face_loop[number + 1]] -
                       m->loop_corner[m->face_loop[number]];
    uint32_t holes = m->face_loop[number + 1] - m->face_loop[number];
    return m->corner_normal ? 3 * (corners + 2 * holes) : corners;
}

/* ---- edges and points ------------------------------------------------------------------------ */

static void put_bare(io_tessellator *t, uint32_t vertex, io_batch *b)
{
    memcpy(b->vertices + (size_t)b->stride * b->vertex_count, t->position + 3 * (size_t)vertex,
           3 * sizeof(float));
    b->vertex_count++;
}

void tessellate_edge(io_tessellator *t, uint32_t edge, io_batch *b)
{
    const uint32_t *v = t->mesh->edge_vertex + 2 * (size_t)edge;
    if (t->bad[v[0]] || t->bad[v[1]]) {
        t->not_finite++;
        return;
    }
    if (same_place(t->position + 3 * (size_t)v[0], t->position + 3 * (size_t)v[1]))
        return;
    batch_reserve(t->job, b, 2, 2);
    b->indices[b->index_count++] = b->vertex_count;
    b->indices[b->index_count++] = b->vertex_count + 1;
    put_bare(t, v[0], b);
    put_bare(t, v[1], b);
}

uint32_t tessellate_loose(io_tessellator *t, const uint32_t **loose)
{
    const pcg_mesh *m = t->mesh;
    uint32_t count = 0;
    if (m->forever)
        return 0;
    memset(t->shared, 0, m->vertex_count * sizeof *t->shared);
    for (uint32_t c = 0; c < m->corner_count; c++)
        t->shared[m->corner_vertex[c]] = 1;
    for (uint32_t e = 0; e < 2 * m->edge_count; e++)
        t->shared[m->edge_vertex[e]] = 1;
    for (uint32_t v = 0; v < m->vertex_count; v++)
        if (!t->shared[v])
            t->shared[count++] = v; /* never behind v */
    *loose = t->shared;
    return count;
}

void tessellate_point(io_tessellator *t, uint32_t vertex, io_batch *b)
{
    if (t->bad[vertex]) {
        t->not_finite++;
        return;
    }
    batch_reserve(t->job, b, 1, 0);
    put_bare(t, vertex, b);
}

void tessellate_end(io_tessellator *t)
{
    if (t->not_finite == 1)
        result_warn(t->job->run,
                    "a face, edge or point was left out: its coordinates are not finite");
    else if (t->not_finite)
        result_warn(t->job->run,
                    "%llu faces, edges or points were left out: their coordinates are not finite",
                    (unsigned long long)t->not_finite);
    t->not_finite = 0;
}

/* ---- closedness ------------------------------------------------------------------------------ */

static uint64_t edge_hash(uint32_t a, uint32_t b)
{
    uint64_t h = ((uint64_t)a << 32 | b) + 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 27) * 0x94d049bb133111ebu;
    return h ^ h >> 31;
}

/* Each edge counts by its hash, positive one way and negative the other: a closed surface sums
 * to nothing, any other one almost surely does not. */
bool tessellate_closed(const pcg_mesh *m)
{
    uint64_t sum = 0;
    if (m->face_count < 2)
        return false;
    for (uint32_t l = 0; l < m->loop_count; l++) {
        uint32_t end = m->loop_corner[l + 1];
        for (uint32_t c = m->loop_corner[l]; c < end; c++) {
            uint32_t a = m->corner_vertex[c];
            uint32_t b = m->corner_vertex[c + 1 < end ? c + 1 : m->loop_corner[l]];
            sum += a < b ? edge_hash(a, b) : a > b ? 0 - edge_hash(b, a) : 0;
        }
    }
    return sum == 0;
}

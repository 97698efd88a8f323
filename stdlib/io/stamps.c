/* stamps.c - the triangles of meshes that many shapes share, worked out once a mesh.
 *
 * A city is a few meshes in a million places. What does not depend on the place (which corners make
 * triangles, what the faces' normals are in the scope's frame) is a stamp; to put one down is to
 * move its vertices and to turn its normals. */
#include "stdlib/io/io.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    KEPT_CORNERS = 1024,         /* stamps of larger meshes are not kept: they pay for themselves */
    STAMP_CORNERS = 65535        /* larger meshes have none */
};

/* Two places that are this far apart, in their largest coordinate, are two places in single
 * precision, too: each of three coordinates is off by half of 2^-23 at most, at either end. */
static const double NEAREST = 2.1e-7;
/* Sums of products of numbers below it are finite. */
static const double LARGEST = 1e100;

/* ---- looking at a mesh ----------------------------------------------------------------------- */

static void reserve(io_job *j, io_stamp *k, const pcg_mesh *m)
{
    if (k->capacity >= m->corner_count + 2 * m->loop_count)
        return;
    k->capacity = 2 * (m->corner_count + 2 * m->loop_count);
    k->vertex = ARENA_ARRAY(&j->memory, uint32_t, k->capacity);
    k->index = ARENA_ARRAY(&j->memory, uint32_t, 3 * (size_t)k->capacity);
    k->uv = ARENA_ARRAY(&j->memory, float, 2 * (size_t)k->capacity);
    k->face_end = ARENA_ARRAY(&j->memory, uint32_t, k->capacity);
    k->normal = ARENA_ARRAY(&j->memory, double, 3 * (size_t)k->capacity);
}

static double distance_squared(const double *a, const double *b)
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* The triangles of a face, counted from the stamp's first vertex. */
static void add_triangles(io_stamp *k, const io_tessellator *t, const uint32_t *vertex,
                          const uint32_t *corners, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++, corners += 3) {
        for (int c = 0; c < 3; c++) {
            const double *a = t->world + 3 * (size_t)vertex[corners[c]];
            const double *b = t->world + 3 * (size_t)vertex[corners[(c + 1) % 3]];
            k->shortest = fmin(k->shortest, distance_squared(a, b));
            k->index[k->indices++] = k->vertices + corners[c];
        }
    }
}

static void add_face(io_stamp *k, io_tessellator *t, uint32_t number)
{
    const pcg_mesh *m = t->mesh;
    const uint32_t *corners;
    uint32_t count = tessellate_cut(t, number, &corners, k->normal + 3 * (size_t)k->faces);
    if (!count)
        return;
    uint32_t first = m->loop_corner[m->face_loop[number]];
    uint32_t end = m->loop_corner[m->face_loop[number + 1]];
    add_triangles(k, t, m->corner_vertex + first, corners, count);
    for (uint32_t c = first; c < end; c++) {
        tessellate_uv(t, c, k->uv + 2 * (size_t)k->vertices);
        k->vertex[k->vertices++] = m->corner_vertex[c];
    }
    k->face_end[k->faces++] = k->vertices;
}

static bool moderate(const io_tessellator *t)
{
    double largest = 0;
    for (size_t i = 0; i < 3 * (size_t)t->mesh->vertex_count; i++)
        largest = fmax(largest, fabs(t->world[i]));
    return !t->any_bad && largest < LARGEST;
}

/* Its faces, in the frame of the scope. */
static void look_at(io_stamp *k, io_tessellator *t, const pcg_shape *s)
{
    const bool local = t->local, y_up = t->y_up;
    const uint32_t *loose;
    t->local = true;
    t->y_up = false;
    k->vertices = k->indices = k->faces = 0;
    k->shortest = DBL_MAX;
    reserve(t->job, k, s->mesh);
    tessellate_begin(t, s);
    k->usable = moderate(t) && !s->mesh->edge_count && !tessellate_loose(t, &loose);
    for (uint32_t f = 0; k->usable && f < s->mesh->face_count; f++)
        add_face(k, t, f);
    k->shortest = sqrt(k->shortest);
    k->closed = tessellate_closed(s->mesh);
    t->local = local;
    t->y_up = y_up;
}

/* ---- finding one ----------------------------------------------------------------------------- */

static bool is_of(const io_stamp *k, const pcg_shape *s)
{
    const pcg_vec3 *a = &k->size, *b = &s->scope.size;
    return k->mesh == s->mesh &&
           (!s->mesh->unit || (a->x == b->x && a->y == b->y && a->z == b->z));
}

static uint32_t slot_of(const pcg_shape *s)
{
    uint64_t bits[4] = {(uintptr_t)s->mesh, 0, 0, 0}, h = 0;
    if (s->mesh->unit)
        memcpy(bits + 1, &s->scope.size, sizeof s->scope.size);
    for (int i = 0; i < 4; i++) {
        h = (h ^ bits[i]) * 0x9e3779b97f4a7c15u;
        h ^= h >> 32;
    }
    return h % IO_STAMPS;
}

const io_stamp *stamp_find(io_stamps *all, io_tessellator *t, const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    if (m->corner_normal || m->face_material || !m->face_count || m->corner_count > STAMP_CORNERS)
        return NULL;
    bool kept = m->corner_count <= KEPT_CORNERS && (m->forever || m->references > 1);
    io_stamp **at = kept ? &all->kept[slot_of(s)] : &all->other;
    if (!*at)
        *at = ARENA_NEW(&t->job->memory, io_stamp);
    io_stamp *k = *at;
    if (!is_of(k, s)) {
        k->mesh = m;
        k->size = s->scope.size;
        look_at(k, t, s);
    }
    return k->usable ? k : NULL;
}

/* ---- putting it down ------------------------------------------------------------------------- */

/* The vertices of the mesh, to t->position; what they lie between, to the batch's bounds. The
 * largest coordinate of any, infinite where one is not finite. */
static double move_vertices(io_tessellator *t, io_batch *b)
{
    const pcg_vec3 *p = t->mesh->position;
    float *to = t->position, farthest = 0;
    for (int i = 0; i < 3; i++) {
        const double *row = t->rows[i];
        float low = b->low[i], high = b->high[i];
        if (!(fabs(row[0]) + fabs(row[1]) + fabs(row[2]) + fabs(row[3]) < LARGEST))
            return INFINITY;
        for (uint32_t v = 0; v < t->mesh->vertex_count; v++) {
            float x = (float)(row[0] * p[v].x + row[1] * p[v].y + row[2] * p[v].z + row[3]);
            to[3 * (size_t)v + (size_t)i] = x;
            low = x < low ? x : low;
            high = x > high ? x : high;
            farthest = fabsf(x) > farthest ? fabsf(x) : farthest;
        }
        b->low[i] = low;
        b->high[i] = high;
    }
    return (double)farthest;
}

static void turn_normal(const io_tessellator *t, const double *n, float *to)
{
    for (int i = 0; i < 3; i++)
        to[i] = (float)(t->turn[i][0] * n[0] + t->turn[i][1] * n[1] + t->turn[i][2] * n[2]);
}

static void put_vertices(const io_stamp *k, const io_tessellator *t, io_batch *b)
{
    float *to = b->vertices + (size_t)b->stride * b->vertex_count, normal[3];
    for (uint32_t f = 0, v = 0; f < k->faces; f++) {
        turn_normal(t, k->normal + 3 * (size_t)f, normal);
        for (; v < k->face_end[f]; v++, to += b->stride) {
            memcpy(to, t->position + 3 * (size_t)k->vertex[v], 3 * sizeof(float));
            memcpy(to + 3, normal, sizeof normal);
            if (b->stride == IO_TEXTURED)
                memcpy(to + 6, k->uv + 2 * (size_t)v, 2 * sizeof(float));
        }
    }
}

bool stamp_put(const io_stamp *k, io_tessellator *t, const pcg_shape *s, io_batch *b)
{
    batch_bound(b);
    const io_batch before = *b;
    tessellate_frame(t, s);
    if (!(move_vertices(t, b) * NEAREST < k->shortest)) {
        *b = before;
        return false;
    }
    batch_reserve(t->job, b, k->vertices, k->indices);
    put_vertices(k, t, b);
    uint32_t *to = b->indices + b->index_count;
    for (uint32_t i = 0; i < k->indices; i++)
        to[i] = b->vertex_count + k->index[i];
    b->vertex_count += k->vertices;
    b->index_count += k->indices;
    b->bounded = b->vertex_count;
    return true;
}

/* mesh.c - meshes as growing arrays. */
#include <string.h>

#include "runtime/base/base.h"
#include "runtime/memory.h"
#include "runtime/shape.h"

/* What a mesh without faces has in place of an array: its one entry is read, never written. */
static const uint32_t nothing = 0;

/* One of the arrays that grow together: `spare` entries more than the capacity; an optional one may
 * be absent. */
typedef struct stream {
    void **at;
    size_t size;
    uint32_t spare;
    bool optional;
} stream;

enum { STREAMS_MAX = 3 };

static int out_of_memory(pcg_run *r)
{
    run_alloc_array(r, SIZE_MAX, SIZE_MAX); /* fails, and makes the run know why */
    return PCG_FAILED;
}

static size_t stream_bytes(const stream *s, uint32_t capacity)
{
    return s->size * ((size_t)capacity + s->spare);
}

static bool stream_held(const stream *s, uint32_t capacity)
{
    return *s->at != NULL && capacity > 0;
}

static void stream_drop(pcg_run *r, stream *s, uint32_t capacity)
{
    if (stream_held(s, capacity))
        run_free(r, *s->at, stream_bytes(s, capacity));
}

/* Moves all streams to a new capacity, or none of them. */
static int streams_move(pcg_run *r, stream *s, size_t count, uint32_t from, uint32_t to)
{
    void *moved[STREAMS_MAX] = {NULL};

    for (size_t i = 0; i < count; i++) {
        if (s[i].optional && *s[i].at == NULL)
            continue;
        moved[i] = run_alloc(r, stream_bytes(&s[i], to));
        if (moved[i] == NULL) {
            while (i-- > 0)
                if (moved[i] != NULL)
                    run_free(r, moved[i], stream_bytes(&s[i], to));
            return PCG_FAILED;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (moved[i] == NULL)
            continue;
        if (from > 0 || (s[i].spare > 0 && *s[i].at != NULL))
            memcpy(moved[i], *s[i].at, stream_bytes(&s[i], from));
        stream_drop(r, &s[i], from);
        *s[i].at = moved[i];
    }
    return PCG_OK;
}

/* Makes room for `more` behind `count`. */
static int streams_grow(pcg_run *r, stream *s, size_t count, uint32_t *capacity, uint32_t used,
                        uint32_t more)
{
    uint64_t needed = (uint64_t)used + more, next = (uint64_t)*capacity * 2;

    if (needed <= *capacity)
        return PCG_OK;
    if (needed >= UINT32_MAX)
        return out_of_memory(r);
    if (next < needed)
        next = needed;
    if (next < 4)
        next = 4;
    if (next >= UINT32_MAX)
        next = UINT32_MAX - 1;
    if (streams_move(r, s, count, *capacity, (uint32_t)next) != PCG_OK)
        return PCG_FAILED;
    *capacity = (uint32_t)next;
    return PCG_OK;
}

#define VERTEX_STREAMS(m)                                                                          \
    {                                                                                              \
        {                                                                                          \
            (void **)&(m)->position, sizeof(pcg_vec3), 0, false                                    \
        }                                                                                          \
    }
#define EDGE_STREAMS(m)                                                                            \
    {                                                                                              \
        {                                                                                          \
            (void **)&(m)->edge_vertex, 2 * sizeof(uint32_t), 0, false                             \
        }                                                                                          \
    }
#define LOOP_STREAMS(m)                                                                            \
    {                                                                                              \
        {                                                                                          \
            (void **)&(m)->loop_corner, sizeof(uint32_t), 1, false                                 \
        }                                                                                          \
    }
#define FACE_STREAMS(m)                                                                            \
    {                                                                                              \
        {(void **)&(m)->face_loop, sizeof(uint32_t), 1, false},                                    \
            {(void **)&(m)->face_material, sizeof(pcg_material *), 0, true},                       \
            {(void **)&(m)->face_tag, sizeof(uint32_t), 0, true},                                  \
    }
#define CORNER_STREAMS(m)                                                                          \
    {                                                                                              \
        {(void **)&(m)->corner_vertex, sizeof(uint32_t), 0, false},                                \
            {(void **)&(m)->corner_normal, 3 * sizeof(float), 0, true},                            \
            {(void **)&(m)->corner_uv, 2 * sizeof(float), 0, true},                                \
    }

static int grow_vertices(pcg_run *r, pcg_mesh *m, uint32_t more)
{
    stream s[] = VERTEX_STREAMS(m);

    return streams_grow(r, s, COUNT_OF(s), &m->vertex_capacity, m->vertex_count, more);
}

static int grow_edges(pcg_run *r, pcg_mesh *m, uint32_t more)
{
    stream s[] = EDGE_STREAMS(m);

    return streams_grow(r, s, COUNT_OF(s), &m->edge_capacity, m->edge_count, more);
}

static int grow_loops(pcg_run *r, pcg_mesh *m, uint32_t more)
{
    stream s[] = LOOP_STREAMS(m);

    return streams_grow(r, s, COUNT_OF(s), &m->loop_capacity, m->loop_count, more);
}

static int grow_faces(pcg_run *r, pcg_mesh *m, uint32_t more)
{
    stream s[] = FACE_STREAMS(m);

    return streams_grow(r, s, COUNT_OF(s), &m->face_capacity, m->face_count, more);
}

static int grow_corners(pcg_run *r, pcg_mesh *m, uint32_t more)
{
    stream s[] = CORNER_STREAMS(m);

    return streams_grow(r, s, COUNT_OF(s), &m->corner_capacity, m->corner_count, more);
}

int pcg_mesh_reserve(pcg_run *r, pcg_mesh *m, uint32_t vertices, uint32_t faces, uint32_t loops,
                     uint32_t corners)
{
    if (grow_vertices(r, m, vertices) != PCG_OK || grow_faces(r, m, faces) != PCG_OK ||
        grow_loops(r, m, loops) != PCG_OK || grow_corners(r, m, corners) != PCG_OK)
        return PCG_FAILED;
    return PCG_OK;
}

/* ---- life ------------------------------------------------------------------------------------ */

pcg_mesh *pcg_mesh_new(pcg_run *r, bool unit)
{
    pcg_mesh *m = run_alloc_zeroed(r, sizeof *m);

    if (m == NULL)
        return NULL;
    m->references = 1;
    m->unit = unit;
    m->face_loop = (uint32_t *)&nothing;
    m->loop_corner = (uint32_t *)&nothing;
    return m;
}

pcg_mesh *pcg_mesh_hold(const pcg_mesh *m)
{
    pcg_mesh *held = (pcg_mesh *)m;

    if (!held->forever)
        held->references++;
    return held;
}

void pcg_mesh_drop(pcg_run *r, pcg_mesh *m)
{
    if (m == NULL || m->forever || --m->references > 0)
        return;

    stream vertices[] = VERTEX_STREAMS(m), edges[] = EDGE_STREAMS(m), loops[] = LOOP_STREAMS(m);
    stream faces[] = FACE_STREAMS(m), corners[] = CORNER_STREAMS(m);

    stream_drop(r, vertices, m->vertex_capacity);
    stream_drop(r, edges, m->edge_capacity);
    stream_drop(r, loops, m->loop_capacity);
    for (size_t i = 0; i < COUNT_OF(faces); i++)
        stream_drop(r, &faces[i], m->face_capacity);
    for (size_t i = 0; i < COUNT_OF(corners); i++)
        stream_drop(r, &corners[i], m->corner_capacity);
    run_free(r, m, sizeof *m);
}

static void copy_bytes(void *to, const void *from, size_t size)
{
    if (size > 0 && from != NULL)
        memcpy(to, from, size);
}

static int copy_arrays(pcg_run *r, pcg_mesh *to, const pcg_mesh *m)
{
    if (pcg_mesh_reserve(r, to, m->vertex_count, m->face_count, m->loop_count, m->corner_count) !=
            PCG_OK ||
        grow_edges(r, to, m->edge_count) != PCG_OK)
        return PCG_FAILED;
    to->vertex_count = m->vertex_count;
    to->face_count = m->face_count;
    to->loop_count = m->loop_count;
    to->corner_count = m->corner_count;
    to->edge_count = m->edge_count;
    if ((m->corner_normal != NULL && pcg_mesh_need_normals(r, to) != PCG_OK) ||
        (m->corner_uv != NULL && pcg_mesh_need_uvs(r, to) != PCG_OK) ||
        (m->face_material != NULL && pcg_mesh_need_materials(r, to) != PCG_OK) ||
        (m->face_tag != NULL && pcg_mesh_need_tags(r, to) != PCG_OK))
        return PCG_FAILED;
    copy_bytes(to->position, m->position, m->vertex_count * sizeof *m->position);
    if (m->face_count > 0)
        copy_bytes(to->face_loop, m->face_loop, ((size_t)m->face_count + 1) * sizeof *m->face_loop);
    if (m->loop_count > 0)
        copy_bytes(to->loop_corner, m->loop_corner,
                   ((size_t)m->loop_count + 1) * sizeof *m->loop_corner);
    copy_bytes(to->corner_vertex, m->corner_vertex, m->corner_count * sizeof *m->corner_vertex);
    copy_bytes(to->edge_vertex, m->edge_vertex, 2 * (size_t)m->edge_count * sizeof *m->edge_vertex);
    copy_bytes(to->corner_normal, m->corner_normal, 3 * (size_t)m->corner_count * sizeof(float));
    copy_bytes(to->corner_uv, m->corner_uv, 2 * (size_t)m->corner_count * sizeof(float));
    copy_bytes((void *)to->face_material, (const void *)m->face_material,
               m->face_count * sizeof *m->face_material);
    copy_bytes(to->face_tag, m->face_tag, m->face_count * sizeof *m->face_tag);
    return PCG_OK;
}

pcg_mesh *pcg_mesh_copy(pcg_run *r, const pcg_mesh *m)
{
    pcg_mesh *copy = pcg_mesh_new(r, m->unit);

    if (copy != NULL && copy_arrays(r, copy, m) != PCG_OK) {
        pcg_mesh_drop(r, copy);
        return NULL;
    }
    return copy;
}

/* ---- adding ---------------------------------------------------------------------------------- */

uint32_t pcg_mesh_add_vertex(pcg_run *r, pcg_mesh *m, pcg_vec3 p)
{
    if (m->vertex_count == m->vertex_capacity && grow_vertices(r, m, 1) != PCG_OK)
        return UINT32_MAX;
    m->position[m->vertex_count] = p;
    return m->vertex_count++;
}

uint32_t pcg_mesh_add_edge(pcg_run *r, pcg_mesh *m, uint32_t a, uint32_t b)
{
    if (grow_edges(r, m, 1) != PCG_OK)
        return UINT32_MAX;
    m->edge_vertex[2 * (size_t)m->edge_count] = a;
    m->edge_vertex[2 * (size_t)m->edge_count + 1] = b;
    return m->edge_count++;
}

static int add_loop(pcg_run *r, pcg_mesh *m, const uint32_t *vertices, uint32_t count)
{
    uint32_t first = m->corner_count;

    if (grow_loops(r, m, 1) != PCG_OK || grow_corners(r, m, count) != PCG_OK)
        return PCG_FAILED;
    if (count != 0)
        copy_bytes(m->corner_vertex + first, vertices, count * sizeof *vertices);
    if (m->corner_normal != NULL)
        memset(m->corner_normal + 3 * (size_t)first, 0, 3 * (size_t)count * sizeof(float));
    if (m->corner_uv != NULL)
        memset(m->corner_uv + 2 * (size_t)first, 0, 2 * (size_t)count * sizeof(float));
    m->corner_count += count;
    m->loop_corner[++m->loop_count] = m->corner_count;
    return PCG_OK;
}

uint32_t pcg_mesh_add_face(pcg_run *r, pcg_mesh *m, const uint32_t *vertices, uint32_t count)
{
    uint32_t face = m->face_count;

    if (grow_faces(r, m, 1) != PCG_OK || add_loop(r, m, vertices, count) != PCG_OK)
        return UINT32_MAX;
    if (m->face_material != NULL)
        m->face_material[face] = NULL;
    if (m->face_tag != NULL)
        m->face_tag[face] = 0;
    m->face_loop[++m->face_count] = m->loop_count;
    return face;
}

uint32_t pcg_mesh_add_hole(pcg_run *r, pcg_mesh *m, const uint32_t *vertices, uint32_t count)
{
    if (m->face_count == 0)
        return pcg_mesh_add_face(r, m, vertices, count);
    if (add_loop(r, m, vertices, count) != PCG_OK)
        return UINT32_MAX;
    m->face_loop[m->face_count] = m->loop_count;
    return m->loop_count - 1;
}

/* ---- streams --------------------------------------------------------------------------------- */

/* A stream is as long as the capacity of what it goes with, which is at least 1 while it is
 * there. */
static int need_stream(pcg_run *r, void **at, size_t size, uint32_t capacity)
{
    if (*at == NULL)
        *at = run_alloc_array(r, capacity, size);
    return *at != NULL ? PCG_OK : PCG_FAILED;
}

static int need_corner_stream(pcg_run *r, pcg_mesh *m, float **at, size_t width)
{
    if (m->corner_capacity == 0 && grow_corners(r, m, 1) != PCG_OK)
        return PCG_FAILED;
    return need_stream(r, (void **)at, width * sizeof(float), m->corner_capacity);
}

int pcg_mesh_need_normals(pcg_run *r, pcg_mesh *m)
{
    return need_corner_stream(r, m, &m->corner_normal, 3);
}

int pcg_mesh_need_uvs(pcg_run *r, pcg_mesh *m)
{
    return need_corner_stream(r, m, &m->corner_uv, 2);
}

int pcg_mesh_need_materials(pcg_run *r, pcg_mesh *m)
{
    if (m->face_capacity == 0 && grow_faces(r, m, 1) != PCG_OK)
        return PCG_FAILED;
    return need_stream(r, (void **)&m->face_material, sizeof *m->face_material, m->face_capacity);
}

int pcg_mesh_need_tags(pcg_run *r, pcg_mesh *m)
{
    if (m->face_capacity == 0 && grow_faces(r, m, 1) != PCG_OK)
        return PCG_FAILED;
    return need_stream(r, (void **)&m->face_tag, sizeof *m->face_tag, m->face_capacity);
}

uint32_t pcg_tag(const char *name)
{
    uint32_t hash = 2166136261u; /* Fowler, Noll and Vo's, 32 bits */

    for (; *name != '\0'; name++)
        hash = (hash ^ (unsigned char)*name) * 16777619u;
    return hash != 0 ? hash : 1;
}

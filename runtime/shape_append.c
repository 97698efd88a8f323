/* shape_append.c - several shapes in one. */
#include <string.h>

#include "runtime/memory.h"
#include "runtime/mesh.h"

/* From metres along the axes of one scope to metres along those of another. */
typedef struct motion {
    pcg_vec3 row[3];
    pcg_vec3 shift;
} motion;

static motion motion_between(const pcg_scope *from, const pcg_scope *to)
{
    motion m;

    rotation_between(from->axis, to->axis, m.row);
    m.shift = pcg_scope_local(to, from->origin);
    return m;
}

static int append_vertices(pcg_run *r, pcg_mesh *to, const pcg_shape *from, const motion *move)
{
    for (uint32_t i = 0; i < from->mesh->vertex_count; i++) {
        pcg_vec3 p = vec3_add(rotated(move->row, shape_point(from, i)), move->shift);

        if (pcg_mesh_add_vertex(r, to, p) == UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static int append_edges(pcg_run *r, pcg_mesh *to, const pcg_mesh *from, uint32_t first)
{
    for (uint32_t i = 0; i < from->edge_count; i++) {
        const uint32_t *pair = &from->edge_vertex[2 * (size_t)i];

        if (pcg_mesh_add_edge(r, to, pair[0] + first, pair[1] + first) == UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* The faces and corners of `from` behind those of `to`, streams left out; room was reserved. */
static void append_faces(pcg_mesh *to, const pcg_mesh *from, uint32_t first_vertex)
{
    for (uint32_t i = 0; i < from->face_count; i++)
        to->face_loop[to->face_count + 1 + i] = to->loop_count + from->face_loop[i + 1];
    for (uint32_t i = 0; i < from->loop_count; i++)
        to->loop_corner[to->loop_count + 1 + i] = to->corner_count + from->loop_corner[i + 1];
    for (uint32_t i = 0; i < from->corner_count; i++)
        to->corner_vertex[to->corner_count + i] = first_vertex + from->corner_vertex[i];
    if (to->corner_normal != NULL)
        memset(to->corner_normal + 3 * (size_t)to->corner_count, 0,
               3 * (size_t)from->corner_count * sizeof(float));
    if (to->corner_uv != NULL)
        memset(to->corner_uv + 2 * (size_t)to->corner_count, 0,
               2 * (size_t)from->corner_count * sizeof(float));
    if (to->face_material != NULL)
        memset((void *)(to->face_material + to->face_count), 0,
               from->face_count * sizeof *to->face_material);
    if (to->face_tag != NULL)
        memset(to->face_tag + to->face_count, 0, from->face_count * sizeof *to->face_tag);
    to->face_count += from->face_count;
    to->loop_count += from->loop_count;
    to->corner_count += from->corner_count;
}

/* Fills the streams of the corners and faces that were just appended. */
static int append_streams(pcg_run *r, pcg_mesh *to, const pcg_mesh *from, const motion *move)
{
    size_t corner = to->corner_count - from->corner_count, face = to->face_count - from->face_count;

    if (from->corner_normal != NULL) {
        if (pcg_mesh_need_normals(r, to) != PCG_OK)
            return PCG_FAILED;
        memcpy(to->corner_normal + 3 * corner, from->corner_normal,
               3 * (size_t)from->corner_count * sizeof(float));
        rotate_normals(to->corner_normal + 3 * corner, from->corner_count, move->row);
    }
    if (from->corner_uv != NULL) {
        if (pcg_mesh_need_uvs(r, to) != PCG_OK)
            return PCG_FAILED;
        memcpy(to->corner_uv + 2 * corner, from->corner_uv,
               2 * (size_t)from->corner_count * sizeof(float));
    }
    if (from->face_tag != NULL) {
        if (pcg_mesh_need_tags(r, to) != PCG_OK)
            return PCG_FAILED;
        memcpy(to->face_tag + face, from->face_tag, from->face_count * sizeof *from->face_tag);
    }
    return PCG_OK;
}

static bool needs_face_materials(const pcg_shape *to, const pcg_shape *from)
{
    const pcg_material *own = to->material != NULL ? to->material : &pcg_material_default;

    if (to->mesh->face_material != NULL)
        return true;
    for (uint32_t i = 0; i < from->mesh->face_count; i++) {
        if (pcg_shape_face_material(from, i) != own)
            return true;
        if (from->mesh->face_material == NULL)
            return false; /* all of its faces have the shape's */
    }
    return false;
}

static int append_materials(pcg_run *r, pcg_shape *to, const pcg_shape *from)
{
    uint32_t first = to->mesh->face_count - from->mesh->face_count;

    if (!needs_face_materials(to, from))
        return PCG_OK;
    if (pcg_mesh_need_materials(r, to->mesh) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < from->mesh->face_count; i++)
        to->mesh->face_material[first + i] = pcg_shape_face_material(from, i);
    return PCG_OK;
}

int pcg_shape_append(pcg_run *r, pcg_shape *to, const pcg_shape *from)
{
    const pcg_mesh *m = from->mesh;
    motion move = motion_between(&from->scope, &to->scope);
    pcg_mesh *own = pcg_shape_edit(r, to);
    uint32_t first_vertex;

    if (own == NULL)
        return PCG_FAILED;
    if (own->face_count == 0 && m->face_count > 0)
        to->material = from->material;
    first_vertex = own->vertex_count;
    if (pcg_mesh_reserve(r, own, m->vertex_count, m->face_count, m->loop_count, m->corner_count) !=
            PCG_OK ||
        append_vertices(r, own, from, &move) != PCG_OK ||
        append_edges(r, own, m, first_vertex) != PCG_OK)
        return PCG_FAILED;
    append_faces(own, m, first_vertex);
    if (append_streams(r, own, m, &move) != PCG_OK)
        return PCG_FAILED;
    return append_materials(r, to, from);
}

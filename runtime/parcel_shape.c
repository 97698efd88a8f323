/* parcel_shape.c - shapes and their meshes in parcels. A mesh that shapes share is there once. */
#include <string.h>

#include "parcel.h"

static const pcg_mesh *const canonical[] = {&pcg_mesh_empty, &pcg_mesh_square, &pcg_mesh_cube,
                                            &pcg_mesh_lid,   &pcg_mesh_cup,    &pcg_mesh_sides,
                                            &pcg_mesh_tray,  &pcg_mesh_reveal};

enum { CANONICAL = COUNT_OF(canonical), UNIT = 1, NORMALS = 2, UVS = 4, MATERIALS = 8, TAGS = 16 };

/* ---- packing -------------------------------------------------------------------------------- */

static pcg_u32 canonical_number(const pcg_mesh *m)
{
    pcg_u32 i = 0;
    while (i < CANONICAL && canonical[i] != m)
        i++;
    return i;
}

static pcg_u32 streams_of(const pcg_mesh *m)
{
    return (m->unit ? UNIT : 0u) | (m->corner_normal ? NORMALS : 0u) | (m->corner_uv ? UVS : 0u) |
           (m->face_material ? MATERIALS : 0u) | (m->face_tag ? TAGS : 0u);
}

static void pack_mesh(pcg_packer *p, const pcg_mesh *m)
{
    pcg_u32 streams = streams_of(m);
    pack_u32(p, streams);
    pack_u32(p, m->vertex_count);
    pack_u32(p, m->face_count);
    pack_u32(p, m->loop_count);
    pack_u32(p, m->corner_count);
    pack_u32(p, m->edge_count);
    pack_bytes(p, m->position, m->vertex_count * sizeof *m->position);
    pack_bytes(p, m->face_loop, ((size_t)m->face_count + 1) * sizeof *m->face_loop);
    pack_bytes(p, m->loop_corner, ((size_t)m->loop_count + 1) * sizeof *m->loop_corner);
    pack_bytes(p, m->corner_vertex, m->corner_count * sizeof *m->corner_vertex);
    pack_bytes(p, m->edge_vertex, 2 * (size_t)m->edge_count * sizeof *m->edge_vertex);
    if (streams & NORMALS)
        pack_bytes(p, m->corner_normal, 3 * (size_t)m->corner_count * sizeof *m->corner_normal);
    if (streams & UVS)
        pack_bytes(p, m->corner_uv, 2 * (size_t)m->corner_count * sizeof *m->corner_uv);
    if (streams & TAGS)
        pack_bytes(p, m->face_tag, m->face_count * sizeof *m->face_tag);
    for (pcg_u32 i = 0; streams & MATERIALS && i < m->face_count; i++)
        pack_material(p, m->face_material[i]);
}

int pcg_shape_pack(pcg_packer *p, const pcg_entity *e)
{
    const pcg_shape *s = (const pcg_shape *)e;
    pcg_u32 number = canonical_number(s->mesh);
    if (s->parts)
        p->cannot = "Shape whose parts were asked for";
    pack_bytes(p, &s->scope, sizeof s->scope);
    pack_material(p, s->material);
    pack_u32(p, number);
    if (number == CANONICAL && pack_object(p, s->mesh))
        pack_mesh(p, s->mesh);
    return pack_status(p);
}

/* ---- unpacking ------------------------------------------------------------------------------ */

/* Rising from 0 to `end`: the rows of one array in another. */
static bool rises(const uint32_t *at, uint32_t count, uint32_t end)
{
    for (uint32_t i = 0; i < count; i++)
        if (at[i + 1] < at[i])
            return false;
    return at[0] == 0 && at[count] == end;
}

static bool all_below(const uint32_t *at, size_t count, uint32_t end)
{
    for (size_t i = 0; i < count; i++)
        if (at[i] >= end)
            return false;
    return true;
}

/* A face has its outline, at least. */
static bool faces_have_outlines(const pcg_mesh *m)
{
    for (uint32_t i = 0; i < m->face_count; i++)
        if (m->face_loop[i + 1] == m->face_loop[i])
            return false;
    return true;
}

static bool is_sound(const pcg_mesh *m)
{
    return rises(m->face_loop, m->face_count, m->loop_count) &&
           rises(m->loop_corner, m->loop_count, m->corner_count) && faces_have_outlines(m) &&
           all_below(m->corner_vertex, m->corner_count, m->vertex_count) &&
           all_below(m->edge_vertex, 2 * (size_t)m->edge_count, m->vertex_count);
}

static bool need_streams(pcg_run *r, pcg_mesh *m, pcg_u32 streams)
{
    return (!(streams & NORMALS) || pcg_mesh_need_normals(r, m) == PCG_OK) &&
           (!(streams & UVS) || pcg_mesh_need_uvs(r, m) == PCG_OK) &&
           (!(streams & MATERIALS) || pcg_mesh_need_materials(r, m) == PCG_OK) &&
           (!(streams & TAGS) || pcg_mesh_need_tags(r, m) == PCG_OK);
}

static void unpack_numbers(pcg_unpacker *u, uint32_t *to, size_t count)
{
    unpack_bytes(u, to, count * sizeof *to);
}

static void unpack_edges(pcg_unpacker *u, pcg_mesh *m, pcg_u32 count)
{
    for (pcg_u32 i = 0; i < count && !u->failed; i++) {
        pcg_u32 from = unpack_u32(u), to = unpack_u32(u);
        u->failed |= pcg_mesh_add_edge(u->run, m, from, to) == UINT32_MAX;
    }
}

static void unpack_streams(pcg_unpacker *u, pcg_mesh *m, pcg_u32 streams)
{
    if (!need_streams(u->run, m, streams))
        u->failed = true;
    if (u->failed)
        return;
    if (streams & NORMALS)
        unpack_bytes(u, m->corner_normal, 3 * (size_t)m->corner_count * sizeof *m->corner_normal);
    if (streams & UVS)
        unpack_bytes(u, m->corner_uv, 2 * (size_t)m->corner_count * sizeof *m->corner_uv);
    if (streams & TAGS)
        unpack_numbers(u, m->face_tag, m->face_count);
    for (pcg_u32 i = 0; streams & MATERIALS && i < m->face_count; i++)
        m->face_material[i] = unpack_material(u);
}

/* Its counts are taken only as far as there are bytes for them. */
static void unpack_arrays(pcg_unpacker *u, pcg_mesh *m)
{
    pcg_u32 streams = unpack_u32(u), vertices = unpack_count(u, sizeof *m->position);
    pcg_u32 faces = unpack_count(u, sizeof *m->face_loop);
    pcg_u32 loops = unpack_count(u, sizeof *m->loop_corner);
    pcg_u32 corners = unpack_count(u, sizeof *m->corner_vertex);
    pcg_u32 edges = unpack_count(u, 2 * sizeof *m->edge_vertex), none[2];
    if (u->failed || pcg_mesh_reserve(u->run, m, vertices, faces, loops, corners) != PCG_OK) {
        u->failed = true;
        return;
    }
    m->unit = streams & UNIT;
    m->vertex_count = vertices;
    m->face_count = faces;
    m->loop_count = loops;
    m->corner_count = corners;
    unpack_bytes(u, m->position, vertices * sizeof *m->position);
    unpack_numbers(u, faces ? m->face_loop : none, (size_t)faces + 1);
    unpack_numbers(u, loops ? m->loop_corner : none, (size_t)loops + 1);
    unpack_numbers(u, m->corner_vertex, corners);
    unpack_edges(u, m, edges);
    u->failed |= !u->failed && !is_sound(m);
    unpack_streams(u, m, streams);
}

static pcg_mesh *unpack_mesh(pcg_unpacker *u)
{
    pcg_u32 number;
    void *known;
    if (!unpack_object(u, PARCEL_MESH, &number, &known))
        return known;
    pcg_mesh *m = pcg_mesh_new(u->run, false);
    if (m)
        unpack_arrays(u, m);
    unpack_made(u, number, m);
    return m;
}

int pcg_shape_unpack(pcg_unpacker *u, pcg_entity *e)
{
    pcg_shape *s = (pcg_shape *)e;
    unpack_bytes(u, &s->scope, sizeof s->scope);
    s->material = unpack_material(u);
    pcg_u32 number = unpack_u32(u);
    const pcg_mesh *m = number < CANONICAL ? canonical[number] : NULL;
    if (number == CANONICAL)
        m = unpack_mesh(u);
    if (u->failed || !m)
        return PCG_FAILED;
    s->mesh = pcg_mesh_hold(m);
    return PCG_OK;
}

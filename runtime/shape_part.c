/* shape_part.c - parts of shapes: a face as a shape of its own, some faces, several shapes in
 * one. */
#include <math.h>
#include <string.h>

#include "runtime/memory.h"
#include "runtime/mesh.h"
#include "runtime/topology.h"

/* Of the extent: what is nearer than this to being flat, or a rectangle, is taken to be one. */
static const double flatness = 1e-9;

/* ---- scopes on faces ------------------------------------------------------------------------- */

/* The direction `along` without what of it is along `normal`, of length 1; zero when nothing is
 * left. */
static pcg_vec3 on_plane(pcg_vec3 along, pcg_vec3 normal)
{
    pcg_vec3 d = vec3_subtract(along, vec3_scale(normal, vec3_dot(along, normal)));

    return vec3_dot(d, d) > 1e-12 ? vec3_normal(d) : vec3(0, 0, 0);
}

void shape_face_axes(const pcg_scope *parent, pcg_vec3 normal, pcg_vec3 axis[3])
{
    pcg_vec3 x;

    if (normal.x * normal.x + normal.y * normal.y > 1e-8)
        x = vec3_normal(vec3(-normal.y, normal.x, 0)); /* level, to the right seen from outside */
    else
        x = on_plane(parent->axis[0], normal);
    if (x.x == 0 && x.y == 0 && x.z == 0)
        x = on_plane(parent->axis[1], normal);
    axis[0] = x;
    axis[1] = vec3_cross(normal, x);
    axis[2] = normal;
}

/* The axes of a face's own scope, as directions along its parent's: rows of a rotation. */
static void face_rotation(const pcg_shape *s, uint32_t face, pcg_vec3 axis[3], pcg_vec3 row[3])
{
    pcg_vec3 n = vec3_normal(pcg_scope_direction(&s->scope, pcg_shape_face_normal(s, face)));

    if (n.x == 0 && n.y == 0 && n.z == 0)
        memcpy(axis, s->scope.axis, 3 * sizeof *axis);
    else
        shape_face_axes(&s->scope, n, axis);
    rotation_between(s->scope.axis, axis, row);
}

/* ---- one face -------------------------------------------------------------------------------- */

static bool near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance;
}

/* Whether the points are the corners of the box low … high in the plane, in turn and
 * counter-clockwise. */
static bool is_rectangle(const pcg_vec3 p[4], pcg_vec3 low, pcg_vec3 high)
{
    double tolerance = flatness * (high.x - low.x + high.y - low.y);
    uint32_t first = 4;

    if (!(high.x - low.x > tolerance && high.y - low.y > tolerance && high.z - low.z <= tolerance))
        return false;
    for (uint32_t i = 0; i < 4 && first == 4; i++)
        if (near(p[i].x, low.x, tolerance) && near(p[i].y, low.y, tolerance))
            first = i;
    if (first == 4)
        return false;
    const pcg_vec3 *b = &p[(first + 1) % 4], *c = &p[(first + 2) % 4], *d = &p[(first + 3) % 4];
    return near(b->x, high.x, tolerance) && near(b->y, low.y, tolerance) &&
           near(c->x, high.x, tolerance) && near(c->y, high.y, tolerance) &&
           near(d->x, low.x, tolerance) && near(d->y, high.y, tolerance);
}

static bool has_own_streams(const pcg_mesh *m, uint32_t face)
{
    return m->corner_normal != NULL || m->corner_uv != NULL ||
           (m->face_tag != NULL && m->face_tag[face] != 0);
}

/* Where a box along the axes of `to`, given relative to `anchor` (along the axes of `from`), begins
 * in the world. */
static pcg_vec3 box_origin(const pcg_scope *from, pcg_vec3 anchor, const pcg_scope *to,
                           pcg_vec3 low)
{
    return vec3_add(pcg_scope_point(from, anchor), pcg_scope_direction(to, low));
}

/* Makes `part` the unit square in a scope on the face, when the face is a rectangle along `row`. */
static bool face_as_square(pcg_run *r, const pcg_shape *s, uint32_t face, const pcg_vec3 row[3],
                           pcg_shape *part)
{
    const pcg_mesh *m = s->mesh;
    uint32_t first = face_first_corner(m, face);
    pcg_vec3 p[4], low, high, anchor;

    if (face_last_corner(m, face) - first != 4 ||
        m->face_loop[face + 1] - m->face_loop[face] != 1 || has_own_streams(m, face))
        return false;
    anchor = shape_corner(s, first);
    low = high = p[0] = vec3(0, 0, 0);
    for (uint32_t i = 1; i < 4; i++) {
        p[i] = rotated(row, vec3_subtract(shape_corner(s, first + i), anchor));
        bounds_add(&low, &high, p[i]);
    }
    if (!is_rectangle(p, low, high))
        return false;
    part->scope.origin = box_origin(&s->scope, anchor, &part->scope, low);
    part->scope.size = vec3(high.x - low.x, high.y - low.y, 0);
    pcg_shape_set_mesh(r, part, pcg_mesh_hold(&pcg_mesh_square));
    return true;
}

/* Corners from..to-1 of `from`, as they stand, into the streams of the last loop of `to`. */
static int copy_corner_streams(pcg_run *r, pcg_mesh *to, const pcg_mesh *from, uint32_t first,
                               uint32_t count, const pcg_vec3 row[3])
{
    uint32_t at = to->corner_count - count;

    if (from->corner_uv != NULL) {
        if (pcg_mesh_need_uvs(r, to) != PCG_OK)
            return PCG_FAILED;
        memcpy(to->corner_uv + 2 * (size_t)at, from->corner_uv + 2 * (size_t)first,
               2 * (size_t)count * sizeof(float));
    }
    if (from->corner_normal != NULL) {
        if (pcg_mesh_need_normals(r, to) != PCG_OK)
            return PCG_FAILED;
        memcpy(to->corner_normal + 3 * (size_t)at, from->corner_normal + 3 * (size_t)first,
               3 * (size_t)count * sizeof(float));
        if (row != NULL)
            rotate_normals(to->corner_normal + 3 * (size_t)at, count, row);
    }
    return PCG_OK;
}

static int copy_tag(pcg_run *r, pcg_mesh *to, const pcg_mesh *from, uint32_t face)
{
    if (from->face_tag == NULL || from->face_tag[face] == 0)
        return PCG_OK;
    if (pcg_mesh_need_tags(r, to) != PCG_OK)
        return PCG_FAILED;
    to->face_tag[to->face_count - 1] = from->face_tag[face];
    return PCG_OK;
}

/* Adds the loops of a face, their vertices being `first_vertex` and so on, corner by corner. */
static int copy_loops(pcg_run *r, pcg_mesh *to, const pcg_mesh *from, uint32_t face,
                      uint32_t first_vertex, const pcg_vec3 row[3])
{
    uint32_t *scratch, count, vertex = first_vertex, status = PCG_OK;
    uint32_t total = face_last_corner(from, face) - face_first_corner(from, face);

    if ((scratch = run_alloc(r, total * sizeof *scratch)) == NULL)
        return PCG_FAILED;
    for (uint32_t l = from->face_loop[face]; l < from->face_loop[face + 1] && status == PCG_OK;
         l++) {
        count = from->loop_corner[l + 1] - from->loop_corner[l];
        for (uint32_t i = 0; i < count; i++)
            scratch[i] = vertex++;
        uint32_t added = l == from->face_loop[face] ? pcg_mesh_add_face(r, to, scratch, count)
                                                    : pcg_mesh_add_hole(r, to, scratch, count);
        status = added == UINT32_MAX ||
                 copy_corner_streams(r, to, from, from->loop_corner[l], count, row) != PCG_OK;
    }
    run_free(r, scratch, total * sizeof *scratch);
    return status == PCG_OK ? copy_tag(r, to, from, face) : PCG_FAILED;
}

/* The positions of a face's corners relative to `anchor`, turned, into `to`; its thickness is taken
 * out. */
static int copy_points(pcg_run *r, const pcg_shape *s, uint32_t face, pcg_vec3 anchor,
                       const pcg_vec3 row[3], pcg_mesh *to)
{
    const pcg_mesh *m = s->mesh;
    pcg_vec3 low = vec3(0, 0, 0), high = low;

    for (uint32_t i = face_first_corner(m, face); i < face_last_corner(m, face); i++) {
        pcg_vec3 p = rotated(row, vec3_subtract(shape_corner(s, i), anchor));

        bounds_add(&low, &high, p);
        if (pcg_mesh_add_vertex(r, to, p) == UINT32_MAX)
            return PCG_FAILED;
    }
    if (high.z - low.z <= flatness * (high.x - low.x + high.y - low.y))
        for (uint32_t i = 0; i < to->vertex_count; i++)
            to->position[i].z = 0;
    return PCG_OK;
}

/* Makes `part` the face as it is, in metres. */
static int face_as_mesh(pcg_run *r, const pcg_shape *s, uint32_t face, const pcg_vec3 row[3],
                        pcg_shape *part)
{
    const pcg_mesh *m = s->mesh;
    uint32_t loops = m->face_loop[face + 1] - m->face_loop[face];
    uint32_t corners = face_last_corner(m, face) - face_first_corner(m, face);
    pcg_mesh *own = pcg_mesh_new(r, false);
    pcg_vec3 anchor;

    if (own == NULL)
        return PCG_FAILED;
    pcg_shape_set_mesh(r, part, own);
    if (corners == 0)
        return PCG_OK;
    anchor = shape_corner(s, face_first_corner(m, face));
    if (pcg_mesh_reserve(r, own, corners, 1, loops, corners) != PCG_OK ||
        copy_points(r, s, face, anchor, row, own) != PCG_OK ||
        copy_loops(r, own, m, face, 0, row) != PCG_OK)
        return PCG_FAILED;
    part->scope.origin = pcg_scope_point(&s->scope, anchor);
    return pcg_shape_fit(r, part);
}

int shape_become_face(pcg_run *r, const pcg_shape *s, uint32_t face, pcg_shape *part)
{
    pcg_vec3 row[3];

    face_rotation(s, face, part->scope.axis, row);
    if (s->mesh->face_material != NULL && s->mesh->face_material[face] != NULL)
        part->material = s->mesh->face_material[face];
    return face_as_square(r, s, face, row, part) ? PCG_OK : face_as_mesh(r, s, face, row, part);
}

pcg_shape *pcg_shape_face(pcg_call *c, const pcg_shape *s, uint32_t face)
{
    pcg_shape *part = pcg_shape_new(c, &s->entity);

    if (part != NULL && shape_become_face(c->run, s, face, part) != PCG_OK) {
        pcg_entity_drop(c->run, &part->entity);
        return NULL;
    }
    return part;
}

void shape_face_scope(const pcg_shape *s, uint32_t face, pcg_scope *scope)
{
    const pcg_mesh *m = s->mesh;
    uint32_t first = face_first_corner(m, face), end = face_last_corner(m, face);
    pcg_vec3 row[3], anchor, low = vec3(0, 0, 0), high = low;

    *scope = s->scope;
    face_rotation(s, face, scope->axis, row);
    scope->size = low;
    if (first == end)
        return;
    anchor = shape_corner(s, first);
    for (uint32_t c = first; c < end; c++)
        bounds_add(&low, &high, rotated(row, vec3_subtract(shape_corner(s, c), anchor)));
    scope->origin = box_origin(&s->scope, anchor, scope, low);
    scope->size = vec3_subtract(high, low);
}

/* ---- one edge or vertex ---------------------------------------------------------------------- */

void shape_edge_scope(const pcg_shape *s, uint32_t a, uint32_t b, pcg_scope *scope)
{
    pcg_vec3 along = vec3_subtract(pcg_shape_world(s, b), pcg_shape_world(s, a));

    *scope = s->scope;
    scope->origin = pcg_shape_world(s, a);
    scope->size = vec3(vec3_length(along), 0, 0);
    if (scope->size.x > 0)
        axes_along(vec3_normal(along), scope->axis);
}

int shape_become_edge(pcg_run *r, const pcg_shape *s, uint32_t a, uint32_t b, pcg_shape *part)
{
    pcg_mesh *m = pcg_mesh_new(r, false);

    if (m == NULL)
        return PCG_FAILED;
    shape_edge_scope(s, a, b, &part->scope);
    pcg_shape_set_mesh(r, part, m);
    if (pcg_mesh_add_vertex(r, m, vec3(0, 0, 0)) == UINT32_MAX ||
        (a != b && (pcg_mesh_add_vertex(r, m, part->scope.size) == UINT32_MAX ||
                    pcg_mesh_add_edge(r, m, 0, 1) == UINT32_MAX)))
        return PCG_FAILED;
    return PCG_OK;
}

/* ---- some faces ------------------------------------------------------------------------------ */

/* From vertices of one mesh to those of another, for as many as are used. */
typedef struct vertex_map {
    uint32_t *slot; /* pairs: old vertex + 1, new vertex */
    uint32_t mask;
} vertex_map;

static size_t map_bytes(const vertex_map *map)
{
    return ((size_t)map->mask + 1) * 2 * sizeof *map->slot;
}

static int map_open(pcg_run *r, vertex_map *map, uint32_t entries)
{
    uint64_t slots = 16;

    while (slots < (uint64_t)entries * 2)
        slots *= 2;
    map->mask = (uint32_t)(slots - 1);
    map->slot = run_alloc_zeroed(r, map_bytes(map));
    return map->slot != NULL ? PCG_OK : PCG_FAILED;
}

/* Where a vertex's pair is, or would be. */
static uint32_t *map_find(const vertex_map *map, uint32_t vertex)
{
    uint32_t at = (vertex * 2654435761u) & map->mask;

    while (map->slot[2 * (size_t)at] != 0 && map->slot[2 * (size_t)at] != vertex + 1)
        at = (at + 1) & map->mask;
    return &map->slot[2 * (size_t)at];
}

static uint32_t map_vertex(pcg_run *r, vertex_map *map, const pcg_shape *s, uint32_t vertex,
                           pcg_mesh *to)
{
    uint32_t *pair = map_find(map, vertex);

    if (pair[0] == 0) {
        pair[1] = pcg_mesh_add_vertex(r, to, shape_point(s, vertex));
        pair[0] = vertex + 1;
    }
    return pair[1];
}

/* Adds one face of `s` to `to`; the corners of its loops are known by copy_loops as first, first +
 * 1, … */
static int copy_face(pcg_run *r, const pcg_shape *s, uint32_t face, vertex_map *map, pcg_mesh *to)
{
    const pcg_mesh *m = s->mesh;
    uint32_t at = to->corner_count;

    if (copy_loops(r, to, m, face, 0, NULL) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = face_first_corner(m, face); i < face_last_corner(m, face); i++, at++) {
        to->corner_vertex[at] = map_vertex(r, map, s, m->corner_vertex[i], to);
        if (to->corner_vertex[at] == UINT32_MAX)
            return PCG_FAILED;
    }
    if (m->face_material != NULL && m->face_material[face] != NULL) {
        if (pcg_mesh_need_materials(r, to) != PCG_OK)
            return PCG_FAILED;
        to->face_material[to->face_count - 1] = m->face_material[face];
    }
    return PCG_OK;
}

static int copy_edges(pcg_run *r, const pcg_shape *s, vertex_map *map, pcg_mesh *to)
{
    for (uint32_t i = 0; i < s->mesh->edge_count; i++) {
        const uint32_t *pair = &s->mesh->edge_vertex[2 * (size_t)i];
        uint32_t a = map_vertex(r, map, s, pair[0], to), b = map_vertex(r, map, s, pair[1], to);

        if (a == UINT32_MAX || b == UINT32_MAX || pcg_mesh_add_edge(r, to, a, b) == UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* Some faces; `edges`: the loose edges, too. */
static int copy_faces(pcg_run *r, const pcg_shape *s, const uint32_t *faces, uint32_t count,
                      bool edges, pcg_mesh *to)
{
    const pcg_mesh *m = s->mesh;
    uint64_t corners = 0, ends = edges ? 2 * (uint64_t)m->edge_count : 0;
    vertex_map map;
    int status = PCG_OK;

    for (uint32_t i = 0; i < count; i++)
        corners += face_last_corner(m, faces[i]) - face_first_corner(m, faces[i]);
    ends += corners;
    if (map_open(r, &map, (uint32_t)(ends < m->vertex_count ? ends : m->vertex_count)) != PCG_OK)
        return PCG_FAILED;
    if (corners < UINT32_MAX)
        status = pcg_mesh_reserve(r, to, 0, count, count, (uint32_t)corners);
    for (uint32_t i = 0; i < count && status == PCG_OK; i++)
        status = copy_face(r, s, faces[i], &map, to);
    if (status == PCG_OK && edges)
        status = copy_edges(r, s, &map, to);
    run_free(r, map.slot, map_bytes(&map));
    return status;
}

/* A canonical mesh that holds just those faces of the cube, or NULL. */
static const pcg_mesh *part_of_cube(const pcg_shape *s, const uint32_t *faces, uint32_t count)
{
    if (s->mesh != &pcg_mesh_cube && s->mesh != &pcg_mesh_lid)
        return NULL;
    if ((count == 4 || count == 5) && faces[count - 1] == count - 1)
        return count == 4 ? &pcg_mesh_sides : &pcg_mesh_lid;
    return count == 5 && faces[3] == 3 ? &pcg_mesh_cup : NULL;
}

static bool holds_all(const pcg_mesh *m, uint32_t count)
{
    return count == m->face_count && m->edge_count == 0;
}

/* A mesh that is one rectangle along x and y, and nothing else is known of, becomes the unit
 * square. */
static void tidy(pcg_run *r, pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    pcg_vec3 p[4];

    if (m->face_count != 1 || m->loop_count != 1 || m->corner_count != 4 || m->edge_count != 0 ||
        has_own_streams(m, 0))
        return;
    for (uint32_t i = 0; i < 4; i++)
        p[i] = shape_corner(s, i);
    if (!is_rectangle(p, vec3(0, 0, 0), s->scope.size))
        return;
    if (m->face_material != NULL && m->face_material[0] != NULL)
        s->material = m->face_material[0];
    s->scope.size.z = 0;
    pcg_shape_set_mesh(r, s, pcg_mesh_hold(&pcg_mesh_square));
}

int shape_settle(pcg_run *r, pcg_shape *s)
{
    if (pcg_shape_fit(r, s) != PCG_OK)
        return PCG_FAILED;
    tidy(r, s);
    return PCG_OK;
}

pcg_shape *shape_extract(pcg_call *c, const pcg_shape *s, const uint32_t *faces, uint32_t count)
{
    pcg_shape *part = pcg_shape_new(c, &s->entity);
    pcg_mesh *own;

    if (part == NULL)
        return NULL;
    if ((own = pcg_mesh_new(c->run, false)) != NULL) {
        pcg_shape_set_mesh(c->run, part, own);
        if (copy_faces(c->run, s, faces, count, false, own) == PCG_OK &&
            shape_settle(c->run, part) == PCG_OK)
            return part;
    }
    pcg_entity_drop(c->run, &part->entity);
    return NULL;
}

int shape_keep_faces(pcg_run *r, pcg_shape *s, const uint32_t *faces, uint32_t count)
{
    pcg_mesh *own = pcg_mesh_new(r, false);

    if (own == NULL)
        return PCG_FAILED;
    if (copy_faces(r, s, faces, count, true, own) != PCG_OK) {
        pcg_mesh_drop(r, own);
        return PCG_FAILED;
    }
    pcg_shape_set_mesh(r, s, own);
    return PCG_OK;
}

pcg_shape *pcg_shape_faces(pcg_call *c, const pcg_shape *s, const uint32_t *faces, uint32_t count)
{
    const pcg_mesh *shared = holds_all(s->mesh, count) ? s->mesh : part_of_cube(s, faces, count);
    pcg_shape *part;

    if (shared == NULL)
        return shape_extract(c, s, faces, count);
    if ((part = pcg_shape_new(c, &s->entity)) != NULL)
        part->mesh = pcg_mesh_hold(shared);
    return part;
}

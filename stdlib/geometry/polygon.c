/*pcg
/// Makes a face from its corners, in turn; it may have holes.
///
/// Seen from the side that it is to face the corners go counter-clockwise. Each `hole` begins a
/// hole: the vertices behind it are its corners, in either direction. A corner that repeats the one
/// before is left out; an outline of less than three corners, or without area, makes nothing, with
/// a warning, and such a hole is left out.
procedure polygon() -> (out: Shape) [pure] {
    category "create"
    synonyms "face", "outline", "footprint", "freeform"
    augment vertex(x: length, y: length, z: length = 0m)   /// A corner.
    augment hole()                                         /// The vertices that follow bound a hole.
    example polygon { vertex(0m, 0m); vertex(4m, 0m); vertex(0m, 3m) } expect faces = 1, area = 6, vertices = 3
    example polygon { vertex(0m, 0m); vertex(9m, 0m); vertex(9m, 9m); vertex(0m, 9m); hole(); vertex(3m, 3m); vertex(6m, 3m); vertex(6m, 6m); vertex(3m, 6m) } expect holes = 1, area = 72
}
*/
#include <math.h>

#include "geometry.h"
#include "runtime/mesh.h"
#include "polygon.h"

typedef struct pcg_geometry_polygon_item item;

static pcg_vec3 corner_of(const item *i)
{
    return vec3(i->vertex.x, i->vertex.y, i->vertex.z);
}

static bool same_point(pcg_vec3 a, pcg_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Newell's normal of a loop of corners. */
static pcg_vec3 loop_normal(const item *items, uint32_t count)
{
    pcg_vec3 sum = vec3(0, 0, 0);
    if (count == 0)
        return sum;
    pcg_vec3 about = corner_of(items), before = vec3_subtract(corner_of(items + count - 1), about);
    for (uint32_t i = 0; i < count; i++) {
        pcg_vec3 here = vec3_subtract(corner_of(items + i), about);
        sum = vec3_add(sum, vec3_cross(before, here));
        before = here;
    }
    return sum;
}

/* Adds the corners of a loop to the mesh and their numbers to `vertices`; how many, or -1 when
 * memory has run out. */
static int64_t add_corners(pcg_run *r, pcg_mesh *m, const item *items, uint32_t count,
                           bool reversed, uint32_t *vertices)
{
    int64_t added = 0;
    pcg_vec3 last = vec3(NAN, NAN, NAN);
    for (uint32_t k = 0; k < count; k++) {
        pcg_vec3 p = corner_of(items + (reversed ? count - 1 - k : k));
        pcg_vec3 first = added ? m->position[vertices[0]] : last;
        if (same_point(p, last) || (k + 1 == count && same_point(p, first)))
            continue;
        vertices[added] = pcg_mesh_add_vertex(r, m, p);
        if (vertices[added++] == UINT32_MAX)
            return -1;
        last = p;
    }
    return added;
}

static bool all_finite(const item *items, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        pcg_vec3 p = corner_of(items + i);
        if (!geometry_is_length(p.x) || !geometry_is_length(p.y) || !geometry_is_length(p.z))
            return false;
    }
    return true;
}

/* Adds one loop, the outline or a hole. `sense`: the outline's normal, which a hole has to turn
 * against. */
static int add_loop(pcg_call *call, pcg_mesh *m, const item *items, uint32_t count,
                    const pcg_vec3 *sense)
{
    uint32_t *vertices = run_alloc_array(call->run, count ? count : 1, sizeof *vertices);
    if (!vertices)
        return PCG_FAILED;
    pcg_vec3 normal = loop_normal(items, count);
    bool reversed = sense && vec3_dot(normal, *sense) > 0;
    uint32_t first = m->vertex_count;
    int64_t added = add_corners(call->run, m, items, count, reversed, vertices);
    int status = added < 0 ? PCG_FAILED : PCG_OK;
    if (added >= 0 && (added < 3 || vec3_length(normal) == 0)) {
        m->vertex_count = first;
        status = pcg_warn(call, "%s without area is left out", sense ? "a hole" : "a polygon");
    } else if (added >= 0) {
        uint32_t index = sense ? pcg_mesh_add_hole(call->run, m, vertices, (uint32_t)added)
                               : pcg_mesh_add_face(call->run, m, vertices, (uint32_t)added);
        status = index == UINT32_MAX ? PCG_FAILED : PCG_OK;
    }
    run_free(call->run, vertices, (count ? count : 1) * sizeof *vertices);
    return status;
}

static uint32_t loop_end(const struct pcg_geometry_polygon *node, uint32_t from)
{
    while (from < node->item_count && node->items[from].kind == PCG_GEOMETRY_POLYGON_VERTEX)
        from++;
    return from;
}

static int add_holes(pcg_call *call, const struct pcg_geometry_polygon *node, pcg_mesh *m,
                     uint32_t from, pcg_vec3 normal)
{
    int status = PCG_OK;
    while (status == PCG_OK && m->face_count && from < node->item_count) {
        uint32_t end = loop_end(node, ++from);
        status = add_loop(call, m, node->items + from, end - from, &normal);
        from = end;
    }
    return status;
}

/* A face that is not level gets a scope on itself: x level, y up the face, z its normal. */
static int place_scope(pcg_run *r, pcg_shape *s, pcg_vec3 normal)
{
    pcg_vec3 axis[3];
    if (normal.x == 0 && normal.y == 0 && normal.z > 0)
        return pcg_shape_fit(r, s);
    shape_face_axes(&s->scope, vec3_normal(normal), axis);
    return pcg_shape_align(r, s, axis);
}

static int fill(pcg_call *call, const struct pcg_geometry_polygon *node, pcg_shape *s)
{
    pcg_mesh *m = pcg_mesh_new(call->run, false);
    if (!m)
        return PCG_FAILED;
    pcg_shape_set_mesh(call->run, s, m);
    uint32_t end = loop_end(node, 0);
    pcg_vec3 normal = loop_normal(node->items, end);
    int status = add_loop(call, m, node->items, end, NULL);
    if (status == PCG_OK)
        status = add_holes(call, node, m, end, normal);
    return status == PCG_OK && m->face_count ? place_scope(call->run, s, normal) : status;
}

int pcg_geometry_polygon(pcg_call *call, struct pcg_geometry_polygon *node)
{
    if (!all_finite(node->items, node->item_count))
        return pcg_warn(
            call, "the polygon is left out: a corner is too far away, or not a finite number");
    pcg_shape *s = pcg_shape_new(call, NULL);
    if (!s)
        return PCG_FAILED;
    int status = fill(call, node, s);
    if (status == PCG_OK && s->mesh->face_count)
        return geometry_emit(call, node->out, s);
    pcg_entity_drop(call->run, &s->entity);
    return status;
}

/*pcg
/// Moves the outline of every face inward or outward, and divides the face there.
///
/// Inward (a negative amount), `inside` is what is further from the outline than that, and `border`
/// the ring between; outward, `inside` is the face itself, and `border` the ring around it. Holes
/// count as outline. Corners are mitred. Where no edge vanishes and nothing runs into each other
/// the ring has one quad an edge, in the order of the outline; otherwise it is one face, with the
/// inside as its holes. Where the inside comes apart it has several faces; where nothing is left,
/// the whole face is border. An amount of 0 leaves the whole face inside. What has no face sends
/// nothing.
procedure offset(in: Shape) -> (inside: Shape, border: Shape) [pure] {
    category "model"
    synonyms "inset", "shrink", "grow", "frame", "ring", "setback", "margin", "buffer"
    param amount: length = -0.5m     /// How far; a negative one moves inward.
    example rectangle(width = 3m, height = 3m)
        -> offset(amount = -0.5m) expect inside.area = 4, border.area = 5, border.faces = 4
    example rectangle(width = 3m, height = 3m)
        -> offset(amount = 1m) expect inside.area = 9, border.area = 16
    example rectangle(width = 3m, height = 3m)
        -> offset(amount = -2m) expect border.area = 9, count = 1
    example polygon {
            vertex(0m, 0m); vertex(9m, 0m); vertex(9m, 3m)
            vertex(3m, 3m); vertex(3m, 9m); vertex(0m, 9m)
        }
        -> offset(amount = -1m) expect inside.area = 13, border.area = 32, border.faces = 6
}
*/
#include "offset.h"

#include <math.h>

#include "geometry.h"
#include "runtime/mesh.h"
#include "runtime/polygon_face.h"

/* What is made of a shape. */
typedef struct division {
    pcg_call *call;
    const struct pcg_geometry_offset *node;
    const pcg_shape *in;
    pcg_mesh *inside, *border; /* NULL where nobody listens */
    face_frame frame;          /* of the face at hand */
} division;

/* ---- the unit square ------------------------------------------------------------------------- */

/* Four quads between two rectangles in the plane of a scope, one a side, from the bottom on. */
static int add_ring(pcg_run *r, pcg_mesh *m, pcg_vec3 outer, double low, pcg_vec3 inner)
{
    const pcg_vec3 at[8] = {{0, 0, 0},
                            {outer.x, 0, 0},
                            {outer.x, outer.y, 0},
                            {0, outer.y, 0},
                            {low, low, 0},
                            {low + inner.x, low, 0},
                            {low + inner.x, low + inner.y, 0},
                            {low, low + inner.y, 0}};

    if (pcg_mesh_reserve(r, m, 8, 4, 4, 16) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < 8; i++)
        pcg_mesh_add_vertex(r, m, at[i]);
    for (uint32_t i = 0; i < 4; i++)
        geometry_add_quad(r, m, i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i);
    return PCG_OK;
}

/* The ring that was made last. Tiles of one size are many: they share it. */
typedef struct last_ring {
    pcg_mesh *mesh;
    pcg_vec3 outer, inner;
} last_ring;

static bool same_extent(pcg_vec3 a, pcg_vec3 b)
{
    return a.x == b.x && a.y == b.y;
}

/* A ring between two rectangles, the inner one in the middle; the caller's own reference. NULL: out
 * of memory. */
static pcg_mesh *ring_between(pcg_run *r, pcg_instance *instance, pcg_vec3 outer, pcg_vec3 inner)
{
    last_ring *last = instance->state;
    pcg_mesh *m;

    if (last == NULL && (last = instance->state = pcg_alloc(r, sizeof *last)) == NULL)
        return NULL;
    if (last->mesh != NULL && same_extent(last->outer, outer) && same_extent(last->inner, inner))
        return pcg_mesh_hold(last->mesh);
    if ((m = pcg_mesh_new(r, false)) == NULL)
        return NULL;
    if (add_ring(r, m, outer, (outer.x - inner.x) / 2, inner) != PCG_OK) {
        pcg_mesh_drop(r, m);
        return NULL;
    }
    pcg_mesh_drop(r, last->mesh);
    *last = (last_ring){pcg_mesh_hold(m), outer, inner};
    return m;
}

static int emit_ring(pcg_call *call, struct pcg_geometry_offset *node)
{
    double width = node->amount;
    pcg_vec3 size = node->in->scope.size, moved = vec3(size.x + 2 * width, size.y + 2 * width, 0);
    pcg_shape *ring = pcg_shape_new(call, &node->in->entity);
    pcg_mesh *m;

    if (ring == NULL)
        return PCG_FAILED;
    m = ring_between(call->run, &node->instance, width > 0 ? moved : size,
                     width > 0 ? size : moved);
    if (m == NULL) {
        pcg_entity_drop(call->run, &ring->entity);
        return PCG_FAILED;
    }
    pcg_shape_set_mesh(call->run, ring, m);
    if (width > 0) {
        ring->scope.origin = pcg_scope_point(&ring->scope, vec3(-width, -width, 0));
        ring->scope.size = moved;
    }
    return geometry_emit(call, node->border, ring);
}

/* A rectangle's inside is one again: only its scope is new. */
static int emit_inner_square(pcg_call *call, const struct pcg_geometry_offset *node)
{
    pcg_shape *s = pcg_shape_new(call, &node->in->entity);
    double width = -node->amount;

    if (s == NULL)
        return PCG_FAILED;
    s->mesh = pcg_mesh_hold(&pcg_mesh_square);
    s->scope.origin = pcg_scope_point(&s->scope, vec3(width, width, 0));
    s->scope.size = vec3(s->scope.size.x - 2 * width, s->scope.size.y - 2 * width, 0);
    return geometry_emit(call, node->inside, s);
}

/* Sends out the shape itself. */
static int emit_whole(pcg_call *call, const struct pcg_geometry_offset *node, const pcg_port *port)
{
    return pcg_emit(call, port, pcg_entity_hold(&node->in->entity));
}

static int offset_square(pcg_call *call, struct pcg_geometry_offset *node)
{
    double least = fmin(node->in->scope.size.x, node->in->scope.size.y);
    int status;

    if (node->amount < 0 && !(least + 2 * node->amount > 1e-9 * least))
        return emit_whole(call, node, node->border);
    status =
        node->amount < 0 ? emit_inner_square(call, node) : emit_whole(call, node, node->inside);
    if (status == PCG_OK && node->border->count > 0)
        status = emit_ring(call, node);
    return status;
}

/* ---- any mesh -------------------------------------------------------------------------------- */

/* The faces that were added to a mesh take over the material and tag of that which they come
 * from. */
static int inherit(const division *d, pcg_mesh *m, uint32_t first, uint32_t face)
{
    const pcg_mesh *from = d->in->mesh;

    if (from->face_material != NULL && from->face_material[face] != NULL) {
        if (pcg_mesh_need_materials(d->call->run, m) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t f = first; f < m->face_count; f++)
            m->face_material[f] = from->face_material[face];
    }
    if (from->face_tag != NULL && from->face_tag[face] != 0) {
        if (pcg_mesh_need_tags(d->call->run, m) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t f = first; f < m->face_count; f++)
            m->face_tag[f] = from->face_tag[face];
    }
    return PCG_OK;
}

/* One quad for each edge, between outlines that correspond corner by corner. */
static int add_quads(const division *d, const polygons *outer, const polygons *inner)
{
    pcg_run *r = d->call->run;
    uint32_t first = d->border->vertex_count, to_inner = outer->points;

    for (uint32_t i = 0; i < outer->points; i++)
        if (pcg_mesh_add_vertex(r, d->border, frame_point(&d->frame, outer->point[i])) ==
            UINT32_MAX)
            return PCG_FAILED;
    for (uint32_t i = 0; i < inner->points; i++)
        if (pcg_mesh_add_vertex(r, d->border, frame_point(&d->frame, inner->point[i])) ==
            UINT32_MAX)
            return PCG_FAILED;
    for (uint32_t l = 0; l < outer->loops; l++)
        for (uint32_t i = loop_begin(outer, l); i < outer->end[l]; i++) {
            uint32_t a = first + i,
                     b = first + (i + 1 < outer->end[l] ? i + 1 : loop_begin(outer, l));

            if (geometry_add_quad(r, d->border, a, b, b + to_inner, a + to_inner) != PCG_OK)
                return PCG_FAILED;
        }
    return PCG_OK;
}

/* What is in the outer outlines and not in the inner ones. */
static int add_difference(const division *d, const polygons *outer, const polygons *inner)
{
    polygons ring = {0};
    int status = polygons_subtract(d->call->run, outer, inner, &ring);

    if (status == PCG_OK)
        status = polygons_to_mesh(d->call->run, &ring, &d->frame, d->border);
    polygons_free(d->call->run, &ring);
    return status;
}

static int add_parts(const division *d, const polygons *face, const polygons *moved, bool plain)
{
    const polygons *inner = d->node->amount < 0 ? moved : face,
             *outer = d->node->amount < 0 ? face : moved;

    if (d->inside != NULL && polygons_to_mesh(d->call->run, inner, &d->frame, d->inside) != PCG_OK)
        return PCG_FAILED;
    if (d->border == NULL)
        return PCG_OK;
    return plain ? add_quads(d, outer, inner) : add_difference(d, outer, inner);
}

static int offset_face(division *d, uint32_t face)
{
    pcg_run *r = d->call->run;
    uint32_t inside = d->inside != NULL ? d->inside->face_count : 0;
    uint32_t border = d->border != NULL ? d->border->face_count : 0;
    polygons outline = {0}, moved = {0};
    bool plain;
    int status = polygons_of_face(r, d->in, face, &d->frame, &outline);

    if (status == PCG_OK && outline.loops > 0) {
        status = polygons_offset(r, &outline, -d->node->amount, &moved, &plain);
        if (status == PCG_OK)
            status = add_parts(d, &outline, &moved, plain);
    }
    if (status == PCG_OK && d->inside != NULL)
        status = inherit(d, d->inside, inside, face);
    if (status == PCG_OK && d->border != NULL)
        status = inherit(d, d->border, border, face);
    polygons_free(r, &outline);
    polygons_free(r, &moved);
    return status == PCG_OK ? pcg_tick(d->call) : status;
}

/* Sends a mesh out as a shape with the axes of the one that it is part of; takes the mesh over. */
static int emit_mesh(const division *d, const pcg_port *port, pcg_mesh *m)
{
    pcg_shape *s;

    if (m == NULL || m->face_count == 0) {
        pcg_mesh_drop(d->call->run, m);
        return PCG_OK;
    }
    if ((s = pcg_shape_new(d->call, &d->in->entity)) == NULL) {
        pcg_mesh_drop(d->call->run, m);
        return PCG_FAILED;
    }
    pcg_shape_set_mesh(d->call->run, s, m);
    if (shape_settle(d->call->run, s) == PCG_OK)
        return geometry_emit(d->call, port, s);
    pcg_entity_drop(d->call->run, &s->entity);
    return PCG_FAILED;
}

static int offset_faces(pcg_call *call, const struct pcg_geometry_offset *node)
{
    division d = {.call = call, .node = node, .in = node->in};
    int status = PCG_OK;

    if (node->inside->count > 0 && (d.inside = pcg_mesh_new(call->run, false)) == NULL)
        status = PCG_FAILED;
    if (node->border->count > 0 && (d.border = pcg_mesh_new(call->run, false)) == NULL)
        status = PCG_FAILED;
    for (uint32_t f = 0; f < node->in->mesh->face_count && status == PCG_OK; f++)
        status = offset_face(&d, f);
    if (status == PCG_OK) {
        pcg_mesh *inside = d.inside;

        d.inside = NULL;
        status = emit_mesh(&d, node->inside, inside);
    }
    if (status == PCG_OK)
        return emit_mesh(&d, node->border, d.border);
    pcg_mesh_drop(call->run, d.inside);
    pcg_mesh_drop(call->run, d.border);
    return status;
}

int pcg_geometry_offset(pcg_call *call, struct pcg_geometry_offset *node)
{
    bool finite = geometry_is_length(node->amount);
    int status =
        finite ? PCG_OK : pcg_warn(call, "the amount is %g m: the shape stays whole", node->amount);

    if (status == PCG_OK && node->in->mesh->face_count > 0) {
        if (!finite || node->amount == 0)
            status = emit_whole(call, node, node->inside);
        else if (node->in->mesh == &pcg_mesh_square)
            status = offset_square(call, node);
        else
            status = offset_faces(call, node);
    }
    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

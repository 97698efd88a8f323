/*pcg
/// Raises a roof of one slope over each face: it rises evenly from the eaves to the opposite side.
///
/// The slope is what covers the face, wider by the overhang on all sides (and narrower in holes);
/// the wall is what closes the gap below it, standing on the face's outline. It rises along the y
/// axis of the face's scope, away from the front; `direction` turns that. Works on any planar face,
/// concave and with holes. A face without area, or one that no roof can be built on, is left out
/// with a warning.
procedure shed_roof(in: Shape) -> (slope: Shape, wall: Shape) [pure] {
    category "roofs"
    synonyms "roof", "pitched", "lean-to", "skillion", "monopitch"
    param height: length = 2m range [0m, 1000m]        /// How far it rises over the face.
    /// Its slope; above 0 it counts instead of the height.
    param angle: angle = 0deg range [0deg, 89deg]
    /// How far it stands out over the outline, measured level.
    param overhang: length = 0m range [0m, 100m]
    /// Turns where it rises to, counter-clockwise from y.
    param direction: angle = 0deg
    example rectangle(width = 4m, height = 3m) -> shed_roof(height = 4m) expect slope.count = 1, slope.area = 20, wall.faces = 3, wall.area = 28
    example rectangle(width = 4m, height = 3m) -> shed_roof(angle = 45deg, direction = 90deg) expect wall.faces = 3, slope.area = 16.970562748477140
    example rectangle(width = 4m, height = 4m)
        -> shed_roof(height = 0m, overhang = 1m) expect area = 36, wall.count = 0
}
*/
#include <math.h>

#include "geometry.h"
#include "runtime/mesh.h"
#include "runtime/polygon.h"
#include "runtime/real.h"
#include "shed_roof.h"

/* Sides lower than this share of the footprint's size are none. */
static const double flatness = 1e-9;

typedef struct roof {
    pcg_call *call;
    const struct pcg_geometry_shed_roof *node;
    pcg_scope base;     /* on the face: x and y in it, z its normal */
    polygons footprint; /* in x and y of `base` */
    pcg_vec2 uphill;
    double low, extent; /* of the footprint along `uphill` */
    double rise;        /* metres up for a metre uphill */
} roof;

/* ---- the footprint --------------------------------------------------------------------------- */

/* A scope on the face, with its origin in the face's plane. False where the face has no area. */
static bool place_base(roof *k, uint32_t face)
{
    const pcg_shape *s = k->node->in;
    pcg_vec3 n = vec3_normal(pcg_scope_direction(&s->scope, pcg_shape_face_normal(s, face)));
    if (vec3_dot(n, n) == 0)
        return false;
    shape_face_axes(&s->scope, n, k->base.axis);
    k->base.origin = pcg_scope_point(&s->scope, shape_corner(s, face_first_corner(s->mesh, face)));
    return true;
}

static double along(const roof *k, pcg_vec2 p)
{
    return p.x * k->uphill.x + p.y * k->uphill.y;
}

static int read_footprint(roof *k, uint32_t face)
{
    const pcg_shape *s = k->node->in;
    const pcg_mesh *m = s->mesh;
    pcg_run *r = k->call->run;
    double high = -INFINITY;
    int status = polygons_begin_face(r, &k->footprint);
    k->low = INFINITY;
    for (uint32_t l = m->face_loop[face]; l < m->face_loop[face + 1] && status == PCG_OK; l++) {
        for (uint32_t c = m->loop_corner[l]; c < m->loop_corner[l + 1] && status == PCG_OK; c++) {
            pcg_vec3 p = pcg_scope_local(&k->base, pcg_scope_point(&s->scope, shape_corner(s, c)));
            pcg_vec2 at = {p.x, p.y};
            k->low = fmin(k->low, along(k, at));
            high = fmax(high, along(k, at));
            status = polygons_add(r, &k->footprint, at);
        }
        if (status == PCG_OK)
            status = polygons_end_loop(r, &k->footprint);
    }
    k->extent = high - k->low;
    return status;
}

/* A point of the roof, over one of the plan. */
static pcg_vec3 raised(const roof *k, pcg_vec2 p)
{
    return vec3(p.x, p.y, (along(k, p) - k->low) * k->rise);
}

/* ---- slope ----------------------------------------------------------------------------------- */

static int add_slope_loop(roof *k, pcg_mesh *m, const polygons *plan, uint32_t loop, bool outline)
{
    uint32_t first = loop_begin(plan, loop), count = plan->end[loop] - first;
    size_t room = count * sizeof(uint32_t);
    uint32_t *vertices = run_alloc(k->call->run, room);
    if (!vertices)
        return PCG_FAILED;
    int status = PCG_OK;
    for (uint32_t i = 0; i < count && status == PCG_OK; i++) {
        vertices[i] = pcg_mesh_add_vertex(k->call->run, m, raised(k, plan->point[first + i]));
        status = vertices[i] == UINT32_MAX ? PCG_FAILED : PCG_OK;
    }
    if (status == PCG_OK) {
        uint32_t added = outline ? pcg_mesh_add_face(k->call->run, m, vertices, count)
                                 : pcg_mesh_add_hole(k->call->run, m, vertices, count);
        status = added == UINT32_MAX ? PCG_FAILED : PCG_OK;
    }
    run_free(k->call->run, vertices, room);
    return status;
}

static int add_slope(roof *k, pcg_mesh *m, const polygons *plan)
{
    int status = PCG_OK;
    for (uint32_t f = 0; f < plan->faces; f++)
        for (uint32_t l = plan->face[f]; l < face_end(plan, f) && status == PCG_OK; l++)
            status = add_slope_loop(k, m, plan, l, l == plan->face[f]);
    return status;
}

/* The outline with its overhang, lifted onto the slope's plane. */
static int build_slope(roof *k, pcg_mesh *m)
{
    if (k->node->overhang <= 0)
        return add_slope(k, m, &k->footprint);
    polygons wide = {0};
    bool plain;
    int status = polygons_offset(k->call->run, &k->footprint, -k->node->overhang, &wide, &plain);
    if (status == PCG_OK)
        status = add_slope(k, m, &wide);
    polygons_free(k->call->run, &wide);
    return status;
}

/* ---- wall ------------------------------------------------------------------------------------ */

/* What stands over the edge from a to b: four corners, three where it begins or ends at the
 * eaves, or nothing. */
static int add_wall(roof *k, pcg_mesh *m, pcg_vec2 a, pcg_vec2 b)
{
    double least = flatness * (1 + k->extent);
    pcg_vec3 a_top = raised(k, a), b_top = raised(k, b);
    pcg_vec3 corner[4] = {vec3(a.x, a.y, 0), vec3(b.x, b.y, 0)};
    uint32_t count = 2, vertices[4];
    if (b_top.z > least)
        corner[count++] = b_top;
    if (a_top.z > least)
        corner[count++] = a_top;
    if (count == 2 || (a.x == b.x && a.y == b.y))
        return PCG_OK;
    for (uint32_t i = 0; i < count; i++) {
        vertices[i] = pcg_mesh_add_vertex(k->call->run, m, corner[i]);
        if (vertices[i] == UINT32_MAX)
            return PCG_FAILED;
    }
    return pcg_mesh_add_face(k->call->run, m, vertices, count) == UINT32_MAX ? PCG_FAILED : PCG_OK;
}

static int build_wall(roof *k, pcg_mesh *m)
{
    const polygons *p = &k->footprint;
    int status = PCG_OK;
    for (uint32_t l = 0; l < p->loops; l++)
        for (uint32_t i = loop_begin(p, l); i < p->end[l] && status == PCG_OK; i++)
            status =
                add_wall(k, m, p->point[i], p->point[i + 1 < p->end[l] ? i + 1 : loop_begin(p, l)]);
    return status;
}

/* ---- the kernel ------------------------------------------------------------------------------ */

/* Puts the scope on the shape: on a slope its own plane, else the face's axes. */
static int place_scope(roof *k, pcg_shape *s, bool on_slope)
{
    if (!on_slope)
        return pcg_shape_fit(k->call->run, s);
    pcg_vec3 n = vec3_normal(vec3(-k->uphill.x * k->rise, -k->uphill.y * k->rise, 1)), axis[3];
    shape_face_axes(&k->base, pcg_scope_direction(&k->base, n), axis);
    return pcg_shape_align(k->call->run, s, axis);
}

static int emit_part(roof *k, const pcg_port *port, int (*build)(roof *k, pcg_mesh *m),
                     bool on_slope)
{
    if (port->count == 0)
        return PCG_OK;
    pcg_run *r = k->call->run;
    pcg_shape *s = pcg_shape_new(k->call, &k->node->in->entity);
    pcg_mesh *m = s ? pcg_mesh_new(r, false) : NULL;
    if (m) {
        pcg_shape_set_mesh(r, s, m);
        s->scope = k->base;
    }
    int status = m ? build(k, m) : PCG_FAILED;
    if (status == PCG_OK && m->face_count) {
        status = place_scope(k, s, on_slope);
        if (status == PCG_OK)
            return pcg_emit(k->call, port, &s->entity);
    }
    if (s)
        pcg_entity_drop(r, &s->entity);
    return status;
}

static int roof_over(roof *k, uint32_t face)
{
    const struct pcg_geometry_shed_roof *node = k->node;
    if (!place_base(k, face))
        return pcg_warn(k->call, "no roof is built: the face has no area");
    int status = read_footprint(k, face);
    if (status != PCG_OK)
        return status;
    if (!(k->extent > 0))
        return pcg_warn(k->call, "no roof is built: the face has no extent to rise over");
    k->rise = node->angle > 0 ? real_tan(node->angle) : node->height / k->extent;
    status = emit_part(k, node->slope, build_slope, true);
    return status == PCG_OK ? emit_part(k, node->wall, build_wall, false) : status;
}

static bool makes_sense(const struct pcg_geometry_shed_roof *node)
{
    return geometry_is_length(node->height) && node->height >= 0 &&
           geometry_is_length(node->overhang) && node->angle >= 0 && node->angle < 90 &&
           isfinite(node->direction);
}

int pcg_geometry_shed_roof(pcg_call *call, struct pcg_geometry_shed_roof *node)
{
    pcg_run *r = call->run;
    int status = PCG_OK;
    if (!makes_sense(node))
        status = pcg_warn(call, "no roof is built: its height, slope or overhang is negative, too "
                                "large or not a number");
    for (uint32_t f = 0; makes_sense(node) && f < node->in->mesh->face_count && status == PCG_OK;
         f++) {
        roof k = {.call = call,
                  .node = node,
                  .uphill = {-real_sin(node->direction), real_cos(node->direction)}};
        status = roof_over(&k, f);
        polygons_free(r, &k.footprint);
        if (status == PCG_OK)
            status = pcg_tick(call);
    }
    pcg_entity_drop(r, &node->in->entity);
    return status;
}

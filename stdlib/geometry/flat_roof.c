/*pcg
/// Lays a flat roof on each face, with a parapet along its outline and around its holes.
///
/// The parapet stands on the face's edge, inside of it: it rises by its height over the face, is as
/// wide as its width, and goes down to the roof on the inside, which lies lower than the face by
/// `sink`. Up is where the face looks, so that a mass that is extruded can be covered as it is.
/// Where the face is narrower than two parapets they grow together; where nothing is left between
/// them, or the height and the sink are 0, there is no parapet, and the roof is the face. A face
/// without area is left out with a warning.
procedure flat_roof(in: Shape) -> (roof: Shape, parapet: Shape) [pure] {
    category "roofs"
    synonyms "terrace", "parapet", "attic", "coping", "gravel", "roof"
    param height: length = 0.9m range [0m, 1000m]   /// How far the parapet rises over the face.
    param width: length = 0.3m range [0m, 1000m]    /// How wide the parapet is; 0: there is none.
    param sink: length = 0m range [0m, 1000m]       /// How far the roof lies below the face, where there is a parapet.
    example rectangle(width = 6m, height = 4m)
        -> flat_roof(height = 1m, width = 0.5m) expect roof.area = 15, parapet.area = 45, parapet.faces = 12
    example polygon {
            vertex(0m, 0m); vertex(9m, 0m); vertex(9m, 9m); vertex(0m, 9m)
            hole(); vertex(3m, 3m); vertex(6m, 3m); vertex(6m, 6m); vertex(3m, 6m)
        }
        -> flat_roof(height = 1m, width = 1m, sink = 0.5m) expect roof.area = 24, roof.holes = 1, parapet.area = 168
    example rectangle(width = 0.5m, height = 0.2m)
        -> flat_roof() expect roof.area = 0.1, parapet.count = 0
}
*/
#include "flat_roof.h"

#include "geometry.h"
#include "runtime/mesh.h"
#include "runtime/polygon_face.h"

typedef struct roof {
    pcg_call *call;
    const struct pcg_geometry_flat_roof *node;
    uint32_t face;
    face_frame frame;         /* of the face, along the scope's axes */
    polygons outline, inside; /* of the parapet */
    bool plain;               /* they correspond corner by corner */
    bool walled;              /* there is a parapet */
} roof;

/* A point over, or below, the face. */
static pcg_vec3 raised(const roof *k, pcg_vec2 p, double by)
{
    return vec3_add(frame_point(&k->frame, p), vec3_scale(k->frame.z, by));
}

static bool is_same(pcg_vec2 a, pcg_vec2 b)
{
    return a.x == b.x && a.y == b.y;
}

/* ---- parts ----------------------------------------------------------------------------------- */

/* The quad between two heights below, or above, each edge of some loops; `turned`: it looks to
 * their left. */
static int add_sides(const roof *k, pcg_mesh *m, const polygons *p, double low, double high,
                     bool turned)
{
    pcg_run *r = k->call->run;

    for (uint32_t l = 0; l < p->loops; l++)
        for (uint32_t i = loop_begin(p, l); i < p->end[l]; i++) {
            pcg_vec2 a = p->point[i], b = p->point[i + 1 < p->end[l] ? i + 1 : loop_begin(p, l)];
            pcg_vec2 from = turned ? b : a, to = turned ? a : b;
            uint32_t first = m->vertex_count;

            if (is_same(a, b))
                continue;
            if (pcg_mesh_reserve(r, m, 4, 1, 1, 4) != PCG_OK)
                return PCG_FAILED;
            pcg_mesh_add_vertex(r, m, raised(k, from, low));
            pcg_mesh_add_vertex(r, m, raised(k, to, low));
            pcg_mesh_add_vertex(r, m, raised(k, to, high));
            pcg_mesh_add_vertex(r, m, raised(k, from, high));
            if (geometry_add_quad(r, m, first, first + 1, first + 2, first + 3) != PCG_OK)
                return PCG_FAILED;
        }
    return PCG_OK;
}

/* The top of the parapet, one quad an edge. */
static int add_quads(const roof *k, pcg_mesh *m)
{
    const polygons *outer = &k->outline, *inner = &k->inside;
    uint32_t first = m->vertex_count;

    for (uint32_t i = 0; i < outer->points; i++)
        if (pcg_mesh_add_vertex(k->call->run, m, raised(k, outer->point[i], k->node->height)) ==
            UINT32_MAX)
            return PCG_FAILED;
    for (uint32_t i = 0; i < inner->points; i++)
        if (pcg_mesh_add_vertex(k->call->run, m, raised(k, inner->point[i], k->node->height)) ==
            UINT32_MAX)
            return PCG_FAILED;
    for (uint32_t l = 0; l < outer->loops; l++)
        for (uint32_t i = loop_begin(outer, l); i < outer->end[l]; i++) {
            uint32_t next = i + 1 < outer->end[l] ? i + 1 : loop_begin(outer, l);
            uint32_t a = first + i, b = first + next;

            if (geometry_add_quad(k->call->run, m, a, b, b + outer->points, a + outer->points) !=
                PCG_OK)
                return PCG_FAILED;
        }
    return PCG_OK;
}

/* The top of the parapet as what the outline has and the inside has not. */
static int add_ring(const roof *k, pcg_mesh *m)
{
    pcg_run *r = k->call->run;
    face_frame top = k->frame;
    polygons ring = {0};
    int status = polygons_subtract(r, &k->outline, &k->inside, &ring);

    top.origin = raised(k, (pcg_vec2){0, 0}, k->node->height);
    if (status == PCG_OK)
        status = polygons_to_mesh(r, &ring, &top, m);
    polygons_free(r, &ring);
    return status;
}

static int build_parapet(const roof *k, pcg_mesh *m)
{
    double height = k->node->height, sink = k->node->sink;
    int status = PCG_OK;

    if (height > 0)
        status = add_sides(k, m, &k->outline, 0, height, false);
    if (status == PCG_OK && height + sink > 0)
        status = add_sides(k, m, &k->inside, -sink, height, true);
    if (status == PCG_OK)
        status = k->plain ? add_quads(k, m) : add_ring(k, m);
    return status;
}

static int build_roof(const roof *k, pcg_mesh *m)
{
    face_frame level = k->frame;

    level.origin = raised(k, (pcg_vec2){0, 0}, k->walled ? -k->node->sink : 0);
    return polygons_to_mesh(k->call->run, k->walled ? &k->inside : &k->outline, &level, m);
}

static int emit_part(const roof *k, const pcg_port *port, int (*build)(const roof *k, pcg_mesh *m))
{
    pcg_run *r = k->call->run;
    pcg_shape *s;
    pcg_mesh *m;
    int status;

    if (port->count == 0)
        return PCG_OK;
    if ((s = pcg_shape_new(k->call, &k->node->in->entity)) == NULL)
        return PCG_FAILED;
    if ((m = pcg_mesh_new(r, false)) == NULL) {
        pcg_entity_drop(r, &s->entity);
        return PCG_FAILED;
    }
    pcg_shape_set_mesh(r, s, m);
    s->material = pcg_shape_face_material(k->node->in, k->face);
    status = build(k, m);
    if (status == PCG_OK && m->face_count > 0 && (status = shape_settle(r, s)) == PCG_OK)
        return pcg_emit(k->call, port, &s->entity);
    pcg_entity_drop(r, &s->entity);
    return status;
}

/* ---- the kernel ------------------------------------------------------------------------------ */

/* The face, mended where it crosses itself. Status. */
static int read_outline(roof *k)
{
    pcg_run *r = k->call->run;
    polygons raw = {0};
    bool changed = false;
    int status = polygons_of_face(r, k->node->in, k->face, &k->frame, &raw);

    if (status == PCG_OK && raw.loops > 0)
        status = polygons_clean(r, &raw, 0, &k->outline, &changed);
    if (status == PCG_OK && !changed) {
        polygons kept = k->outline;

        k->outline = raw;
        raw = kept;
    }
    polygons_free(r, &raw);
    return status;
}

static int roof_over(roof *k)
{
    const struct pcg_geometry_flat_roof *node = k->node;
    int status = read_outline(k);

    if (status != PCG_OK)
        return status;
    if (k->outline.loops == 0)
        return pcg_warn(k->call, "no roof is built: the face has no area");
    if (node->width > 0 && (node->height > 0 || node->sink > 0))
        status = polygons_offset(k->call->run, &k->outline, node->width, &k->inside, &k->plain);
    k->walled = k->inside.loops > 0;
    if (status == PCG_OK)
        status = emit_part(k, node->roof, build_roof);
    if (status == PCG_OK && k->walled)
        status = emit_part(k, node->parapet, build_parapet);
    return status;
}

static bool makes_sense(const struct pcg_geometry_flat_roof *node)
{
    return node->height >= 0 && geometry_is_length(node->height) && node->width >= 0 &&
           geometry_is_length(node->width) && node->sink >= 0 && geometry_is_length(node->sink);
}

int pcg_geometry_flat_roof(pcg_call *call, struct pcg_geometry_flat_roof *node)
{
    uint32_t faces = makes_sense(node) ? node->in->mesh->face_count : 0;
    int status = PCG_OK;

    if (!makes_sense(node))
        status = pcg_warn(call, "no roof is built: its height, width or sink is negative, too "
                                "large or not a number");
    for (uint32_t f = 0; f < faces && status == PCG_OK; f++) {
        roof k = {.call = call, .node = node, .face = f};

        status = roof_over(&k);
        polygons_free(call->run, &k.outline);
        polygons_free(call->run, &k.inside);
        if (status == PCG_OK)
            status = pcg_tick(call);
    }
    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

/*pcg
/// Makes a polygon with equal sides on the ground: a triangle, a hexagon, nearly a circle.
///
/// It faces up, its middle is at the origin of the world, its first corner along x. Where it has
/// fewer than 3 sides, or no radius, none is made, with a warning.
procedure regular_polygon() -> (out: Shape) [pure] {
    category "create"
    synonyms "circle", "disc", "disk", "hexagon", "octagon", "triangle", "ngon"
    param sides: int = 6           /// How many, up to 100,000; 32 and more look round.
    param radius: length = 1m      /// From the middle to a corner.
    example regular_polygon(sides = 4, radius = 2m) expect faces = 1, vertices = 4, area = 8
    example regular_polygon(sides = 6, radius = 1m)
        -> extrude(amount = 1m) expect faces = 8, volume = 2.598076211353316
}
*/
#include "regular_polygon.h"
#include "geometry.h"
#include "runtime/real.h"

enum { REGULAR_POLYGON_MAX_SIDES = 100000 };

static int add_corners(pcg_run *r, pcg_mesh *m, uint32_t sides, double radius)
{
    for (uint32_t i = 0; i < sides; i++) {
        double turn = 360.0 * i / sides;

        if (pcg_mesh_add_vertex(r, m, vec3(radius * real_cos(turn), radius * real_sin(turn), 0)) ==
            UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* The face over all vertices of a mesh in turn. */
static int add_outline(pcg_run *r, pcg_mesh *m)
{
    uint32_t count = m->vertex_count, *vertices = run_alloc(r, count * sizeof *vertices), face;

    if (vertices == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++)
        vertices[i] = i;
    face = pcg_mesh_add_face(r, m, vertices, count);
    run_free(r, vertices, count * sizeof *vertices);
    return face != UINT32_MAX ? PCG_OK : PCG_FAILED;
}

int pcg_geometry_regular_polygon(pcg_call *call, struct pcg_geometry_regular_polygon *node)
{
    pcg_shape *s;
    pcg_mesh *m;

    if (node->sides < 3 || node->sides > REGULAR_POLYGON_MAX_SIDES ||
        !geometry_is_size(node->radius))
        return pcg_warn(call, "a polygon of %lld sides and radius %g m cannot be made", node->sides,
                        node->radius);
    if ((s = pcg_shape_new(call, NULL)) == NULL)
        return PCG_FAILED;
    if ((m = pcg_mesh_new(call->run, false)) != NULL) {
        pcg_shape_set_mesh(call->run, s, m);
        if (add_corners(call->run, m, (uint32_t)node->sides, node->radius) == PCG_OK &&
            add_outline(call->run, m) == PCG_OK && pcg_shape_fit(call->run, s) == PCG_OK)
            return geometry_emit(call, node->out, s);
    }
    pcg_entity_drop(call->run, &s->entity);
    return PCG_FAILED;
}

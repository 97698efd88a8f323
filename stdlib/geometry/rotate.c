/*pcg
/// Turns a shape, or a part of one, about its x axis, then its y axis, then its z axis.
///
/// In the frame of its scope the axes are the shape's own, in the world's they are the world's;
/// either way they go through the pivot. Angles count counter-clockwise, looking against the axis.
procedure rotate<T: Spatial>(in: T) -> (out: T) [pure] {
    category "place"
    synonyms "turn", "spin", "orient", "r"
    param x: angle = 0deg /// About x.
    param y: angle = 0deg /// About y.
    param z: angle = 0deg /// About z.
    param frame: Frame = scope      /// Whose axes it turns about.
    /// What stays in place: the scope's origin or its centre, or the world's origin.
    param about: Pivot = origin
    example rectangle(width = 2m, height = 3m) -> rotate(z = 90deg) expect faces = 1, area = 6
    example box(width = 1m, depth = 2m, height = 3m) -> rotate(x = 90deg, about = centre)
        -> condition(test = abs(centroid(in).z - 1.5) < 0.000001) expect yes.count = 1
}
*/
#include <math.h>

#include "runtime/real.h"
#include "stdlib/geometry/placing.h"
#include "rotate.h"

/* Rodrigues' formula: v turned about the unit axis. */
static pcg_vec3 turned(pcg_vec3 v, pcg_vec3 axis, double sine, double cosine)
{
    pcg_vec3 along = vec3_scale(axis, vec3_dot(axis, v) * (1 - cosine));
    return vec3_add(vec3_add(vec3_scale(v, cosine), vec3_scale(vec3_cross(axis, v), sine)), along);
}

static void turn_scope(pcg_scope *s, pcg_vec3 pivot, pcg_vec3 axis, double degrees)
{
    if (degrees == 0)
        return;
    double sine = real_sin(degrees), cosine = real_cos(degrees);
    for (int i = 0; i < 2; i++)
        s->axis[i] = vec3_normal(turned(s->axis[i], axis, sine, cosine));
    /* The axes stay orthonormal however often a shape is turned. */
    s->axis[2] = vec3_normal(vec3_cross(s->axis[0], s->axis[1]));
    s->axis[1] = vec3_cross(s->axis[2], s->axis[0]);
    s->origin = vec3_add(pivot, turned(vec3_subtract(s->origin, pivot), axis, sine, cosine));
}

static pcg_vec3 pivot_of(const pcg_scope *s, int about)
{
    if (about == PCG_PIVOT_WORLD)
        return vec3(0, 0, 0);
    return about == PCG_PIVOT_CENTRE ? pcg_scope_point(s, vec3_scale(s->size, 0.5)) : s->origin;
}

int pcg_geometry_rotate(pcg_call *call, struct pcg_geometry_rotate *node)
{
    static const pcg_vec3 world[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double degrees[3] = {node->x, node->y, node->z};
    pcg_scope *s;
    placing p;

    PCG_TRY(placing_open(call, node->in, &p));
    if (!isfinite(node->x) || !isfinite(node->y) || !isfinite(node->z)) {
        PCG_TRY(pcg_warn(call, "it is not turned: an angle is not a finite number"));
        return pcg_emit(call, node->out, node->in);
    }
    s = &p.scope;
    pcg_vec3 pivot = pivot_of(s, node->about);
    for (int i = 0; i < 3; i++)
        turn_scope(s, pivot, node->frame == PCG_FRAME_WORLD ? world[i] : s->axis[i], degrees[i]);
    PCG_TRY(placing_close(call, &p, vec3(1, 1, 1)));
    return pcg_emit(call, node->out, node->in);
}

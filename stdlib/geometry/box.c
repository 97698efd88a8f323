/*pcg
/// Makes a box that stands on the ground.
///
/// Its corner is at the origin; `centered` puts the middle of its base there. A size of 0 makes it
/// flat: a box without height is still six faces. Negative sizes count as 0, with a warning.
procedure box() -> (out: Shape) [pure] {
    category "create"
    synonyms "cube", "cuboid", "block", "solid"
    param width: length = 1m        /// Along x.
    param depth: length = 1m        /// Along y.
    param height: length = 1m       /// Along z, up.
    param centered: bool = false    /// The middle of its base is at the origin.
    example box(width = 2m, depth = 3m, height = 4m) expect count = 1, faces = 6, volume = 24, area = 52
    example box(centered = true) -> condition(test = centroid(in).x == 0.0) expect yes.count = 1
}
*/
#include <math.h>

#include "runtime/shape.h"
#include "box.h"

static double size_of(double given)
{
    return isfinite(given) && given > 0 ? given : 0;
}

int pcg_geometry_box(pcg_call *call, struct pcg_geometry_box *node)
{
    pcg_vec3 size = vec3(size_of(node->width), size_of(node->depth), size_of(node->height));
    if (size.x != node->width || size.y != node->depth || size.z != node->height) {
        int status =
            pcg_warn(call, "a size of the box is negative or not a finite number, and counts as 0");
        if (status != PCG_OK)
            return status;
    }
    pcg_shape *s = pcg_shape_new(call, NULL);
    if (!s)
        return PCG_FAILED;
    pcg_shape_set_mesh(call->run, s, pcg_mesh_hold(&pcg_mesh_cube));
    s->scope = (pcg_scope){.axis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .size = size};
    if (node->centered)
        s->scope.origin = vec3(-size.x / 2, -size.y / 2, 0);
    return pcg_emit(call, node->out, &s->entity);
}

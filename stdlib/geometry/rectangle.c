/*pcg
/// Makes a rectangle on the ground.
///
/// Its corner is at the origin of the world, its sides are along x and y, and it faces up. Where a
/// side is not above 0, none is made, with a warning.
procedure rectangle() -> (out: Shape) [pure] {
    category "create"
    synonyms "square", "quad", "plane", "tile", "face"
    param width: length = 1m   /// Along x.
    param height: length = 1m  /// Along y.
    example rectangle(width = 4m, height = 3m) expect faces = 1, vertices = 4, area = 12
    example rectangle() expect count = 1, area = 1
}
*/
#include "rectangle.h"
#include "geometry.h"

int pcg_geometry_rectangle(pcg_call *call, struct pcg_geometry_rectangle *node)
{
    pcg_shape *s;

    if (!geometry_is_size(node->width) || !geometry_is_size(node->height))
        return pcg_warn(call, "a rectangle of %g m by %g m cannot be made", node->width,
                        node->height);
    if ((s = pcg_shape_new(call, NULL)) == NULL)
        return PCG_FAILED;
    s->scope.size = vec3(node->width, node->height, 0);
    pcg_shape_set_mesh(call->run, s, pcg_mesh_hold(&pcg_mesh_square));
    return geometry_emit(call, node->out, s);
}

/*pcg
/// Moves a shape, or a part of one.
///
/// In the frame of its scope, x, y and z go along the shape's own axes: on a facade x is to the
/// right, y up and z out of the wall. `relative` measures in the shape's own size instead of
/// metres: x = 1 is one width. A part has the scope that `decompose` would give it: z leads away
/// from a face, x along an edge; a vertex has the axes of its shape.
procedure translate<T: Spatial>(in: T) -> (out: T) [pure] {
    category "place"
    synonyms "move", "shift", "position", "t"
    param x: length = 0m /// How far along x.
    param y: length = 0m /// Along y.
    param z: length = 0m /// Along z.
    param frame: Frame = scope      /// Whose axes x, y and z are along.
    param relative: bool = false    /// x, y and z count in sizes of the scope instead of metres.
    example rectangle(width = 2m, height = 3m)
        -> translate(x = 5m, z = 1m) expect faces = 1, area = 6
    example rectangle(width = 2m, height = 3m) -> translate(x = 1, relative = true)
        -> condition(test = centroid(in).x == 3.0) expect yes.count = 1
    example box() -> parts { faces } -> translate(z = 1m)
        -> condition(test = distance(in, vec3(0.5, 0.5, 0.5)) > 1m) expect yes.count = 6
}
*/
#include <math.h>

#include "stdlib/geometry/placing.h"
#include "translate.h"

int pcg_geometry_translate(pcg_call *call, struct pcg_geometry_translate *node)
{
    pcg_vec3 by = vec3(node->x, node->y, node->z);
    placing p;

    PCG_TRY(placing_open(call, node->in, &p));
    if (node->relative)
        by = vec3_multiply(by, p.scope.size);
    if (!isfinite(by.x) || !isfinite(by.y) || !isfinite(by.z)) {
        PCG_TRY(pcg_warn(call, "it is not moved: the distance is not a finite number"));
        return pcg_emit(call, node->out, node->in);
    }
    if (node->frame == PCG_FRAME_SCOPE)
        by = pcg_scope_direction(&p.scope, by);
    p.scope.origin = vec3_add(p.scope.origin, by);
    PCG_TRY(placing_close(call, &p, vec3(1, 1, 1)));
    return pcg_emit(call, node->out, node->in);
}

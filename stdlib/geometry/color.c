/*pcg
/// Gives a shape, or one face of it, a colour.
///
/// Its whole material becomes that colour; a texture stays and is tinted by it. Faces that had
/// materials of their own get it, too.
procedure color<T: Faced>(in: T) -> (out: T) [pure] {
    category "look"
    synonyms "colour", "paint", "tint"
    param color: color = #ffffff    /// With an alpha below 1 the shape is translucent.
    example box() -> s: sequence { change: step; look: step };
        s.change -> parts { faces } -> top: condition(normal(in).z == 1);
        top.yes -> color(color = #ff8800) -> gone: copy(count = 0);
        s.look -> decompose(into = materials) -> piece: condition(faces(in) == 1) expect piece.yes.count = 1, piece.no.count = 1
    example rectangle(width = 2m, height = 3m) -> color(color = #ff8800) expect faces = 1, area = 6
}
*/
#include "runtime/shape.h"
#include "stdlib/geometry/look.h"
#include "color.h"

static pcg_material recoloured(const pcg_material *from, const void *context)
{
    pcg_material m = *from;
    m.color = *(const pcg_color *)context;
    return m;
}

int pcg_geometry_color(pcg_call *call, struct pcg_geometry_color *node)
{
    if (look_change(call, node->in, recoloured, &node->color) != PCG_OK)
        return PCG_FAILED;
    return pcg_emit(call, node->out, node->in);
}

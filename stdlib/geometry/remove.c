/*pcg
/// Takes faces out of their shape.
///
/// Vertices go where nothing else hangs on them; loose edges stay. The shape has other faces then,
/// so that its parts, those that are out, belong to no shape any more. Faces that are taken out by
/// one node go together, before any node sees the shape again.
procedure remove(in: Face) [pure] {
    category "model"
    synonyms "delete", "erase", "open", "cut out", "discard"
    example box(width = 4m, depth = 3m, height = 2m) -> s: sequence { change: step; look: step };
        s.change -> parts { faces } -> top: condition(normal(in).z == 1);
        top.yes -> remove();
        s.look -> whole: condition(faces(in) == 5 && area(in) == 40m2) expect whole.yes.count = 1
}
*/
#include "remove.h"
#include "runtime/part.h"

int pcg_geometry_remove(pcg_call *call, struct pcg_geometry_remove *node)
{
    pcg_part *face = (pcg_part *)node->in;
    int status =
        part_shape(face) != NULL ? part_remove(call->run, face) : part_warn_lost(call, face);

    pcg_entity_drop(call->run, node->in);
    return status;
}

/*pcg
/// Finds where streets meet, and joins them there.
///
/// Vertices that are nearer to each other than the tolerance become one, edges that cross, or pass a
/// vertex that near, are cut there, and of edges between the same vertices the widest stays. So ends
/// that just miss a street are led to it, and streets that were given twice are there once. Streets
/// of different levels do not cross: a bridge is joined to the ground where it ends.
procedure blend_streets(in: StreetNetwork) -> (out: StreetNetwork) [pure, one_to_one] {
    category "join"
    synonyms "blend", "crossings", "intersections", "node", "noding", "snap", "planar", "junctions"
    param tolerance: length = 0.1m range [0m, 100m]   /// What is nearer than this is joined.
    example rectangle(width = 10m, height = 10m) -> copy(count = 2)
        -> streets_from_shapes(width = 2m) -> merge_streets() -> blend_streets()
        -> t: street_to_shape() expect t.streets.area = 80
}
*/
#include "noding.h"
#include "blend_streets.h"

int pcg_streets_blend_streets(pcg_call *call, struct pcg_streets_blend_streets *node)
{
    pcg_streets *s = (pcg_streets *)node->in;
    int status;
    street_drawing *d = drawing_node(call, s->drawing, node->tolerance, &status);

    if (d == NULL) {
        pcg_entity_drop(call->run, node->in);
        return status;
    }
    streets_set(call->run, s, d);
    return pcg_emit(call, node->out, node->in);
}

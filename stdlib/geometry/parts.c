/*pcg
/// Takes a shape apart by reference: into its faces, edges or vertices, which stay parts of it.
///
/// What is done to a part is done to the shape: its vertices can be moved one by one, and its faces
/// follow. `sequence` keeps the shape at hand meanwhile. Each part is one entity, however often it
/// is asked for, and keeps its attributes; the first time, it has those of the shape.
///
/// `translate`, `rotate` and `scale` move a part as `decompose` would lay it: a face along its own
/// axes, z away from it. Whatever else ends at a corner that moves goes along. Vertices in one
/// place are one vertex. When the shape gets other faces, edges and vertices, by `remove` for one,
/// the parts that are out belong to no shape any more. A copy of a part, which a divergence makes,
/// is the only part of a shape of its own.
procedure parts(in: Shape) [pure] {
    category "split"
    synonyms "decompose", "reference", "explode", "components", "sub-entities", "edit"
    attr index: int           /// Written: the number of the part among those of its kind, from 0.
    attr count: int           /// Written: how many of its kind there are.
    augment faces() -> Face         /// Each face.
    augment edges() -> Edge         /// Each edge, those of faces and loose ones, once.
    augment vertices() -> Vertex    /// Each place that a vertex is in, once.
    example box(width = 4m, depth = 3m, height = 2m) -> parts { vertices } expect count = 8
    example box() -> p: parts { faces; edges } expect p.faces.count = 6, p.edges.count = 12
    example box(width = 4m, depth = 3m, height = 2m) -> s: sequence { change: step; look: step };
        s.change -> parts { vertices } -> c: condition(centroid(in).z > 1);
        c.yes -> translate(z = 2m) -> gone: copy(count = 0);
        s.look -> whole: condition(height(in) == 4m) expect whole.yes.count = 1
}
*/
#include "parts.h"
#include "geometry.h"
#include "runtime/part.h"

static int emit_part(pcg_call *call, const struct pcg_geometry_parts *node, const pcg_port *port,
                     pcg_part *part, uint32_t count)
{
    if (part == NULL)
        return PCG_FAILED;
    pcg_set_int(call->run, &part->entity, &node->index, part->index);
    pcg_set_int(call->run, &part->entity, &node->count, count);
    return pcg_emit(call, port, &part->entity);
}

static int emit_parts(pcg_call *call, const struct pcg_geometry_parts *node, part_kind kind,
                      const pcg_port *port)
{
    uint32_t count;
    int status = parts_count(call->run, node->in, kind, &count);

    for (uint32_t i = 0; i < count && status == PCG_OK; i++) {
        status = emit_part(call, node, port, parts_at(call, node->in, kind, i), count);
        if (status == PCG_OK)
            status = pcg_tick(call);
    }
    return status;
}

int pcg_geometry_parts(pcg_call *call, struct pcg_geometry_parts *node)
{
    static const part_kind kind_of[] = {
        [PCG_GEOMETRY_PARTS_FACES] = PART_FACE,
        [PCG_GEOMETRY_PARTS_EDGES] = PART_EDGE,
        [PCG_GEOMETRY_PARTS_VERTICES] = PART_VERTEX,
    };
    int status = PCG_OK;

    for (uint32_t i = 0; i < node->item_count && status == PCG_OK; i++)
        status = emit_parts(call, node, kind_of[node->items[i].kind], node->items[i].port);
    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

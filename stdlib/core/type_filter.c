/*pcg
/// Sends entities different ways by what they are.
///
/// Each entity leaves through the first type that it is of; what is of none leaves through `rest`.
procedure type_filter<T: Entity>(in: T) -> (rest: T) [pure] {
    category "flow"
    synonyms "type", "kind", "is", "class", "filter"
    /// Shapes.
    augment shape() -> Shape
    /// Faces of shapes, by reference.
    augment face() -> Face
    /// Edges of shapes, by reference.
    augment edge() -> Edge
    /// Vertices of shapes, by reference.
    augment vertex() -> Vertex
    /// Impulses.
    augment impulse() -> Impulse
    /// Groups.
    augment group() -> Group
    example rectangle(width = 2m, height = 3m)
        -> t: type_filter { shape } expect t.shape.count = 1, t.rest.count = 0
}
*/
#include "type_filter.h"
#include "group_entity.h"

static const pcg_type *const filtered_type[] = {
    [PCG_CORE_TYPE_FILTER_SHAPE] = &pcg_type_shape,
    [PCG_CORE_TYPE_FILTER_FACE] = &pcg_type_face,
    [PCG_CORE_TYPE_FILTER_EDGE] = &pcg_type_edge,
    [PCG_CORE_TYPE_FILTER_VERTEX] = &pcg_type_vertex,
    [PCG_CORE_TYPE_FILTER_IMPULSE] = &pcg_type_impulse,
    [PCG_CORE_TYPE_FILTER_GROUP] = &core_type_group,
};

int pcg_core_type_filter(pcg_call *call, struct pcg_core_type_filter *node)
{
    const pcg_port *port = node->rest;
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        if (pcg_entity_is(node->in, filtered_type[node->items[i].kind])) {
            port = node->items[i].port;
            break;
        }
    }
    return pcg_emit(call, port, node->in);
}

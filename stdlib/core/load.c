/*pcg
/// Sends on what was stored by a key.
///
/// The entities leave in the order in which they were stored, and are the stored ones themselves, not copies. An entity
/// leaves through the first port whose type it is of, the others through `out`. The key is looked for in the
/// graph, then in the one around it, and so on: the nearest that has it counts. Where none has it, nothing leaves.
procedure load() -> (out: Entity) [stateful] {
    category "keep"
    synonyms "get", "pool", "recall", "global", "variable", "fetch"
    param key: string        /// What `store` kept them by.
    param take: bool = false /// They are kept no longer.
    /// Those that are shapes.
    augment shape() -> Shape
    /// Those that are faces of shapes, by reference.
    augment face() -> Face
    /// Those that are edges of shapes, by reference.
    augment edge() -> Edge
    /// Those that are vertices of shapes, by reference.
    augment vertex() -> Vertex
    /// Those that are impulses.
    augment impulse() -> Impulse
    /// Those that are groups.
    augment group() -> Group
    example rectangle(width = 2m, height = 3m) -> copy(count = 3) -> store(key = "lots");
        l: load(key = "lots") { shape } expect l.shape.area = 18, l.out.count = 0
}
*/
#include "load.h"
#include "group_entity.h"
#include "runtime/pool.h"

static const pcg_type *const load_type[] = {
    [PCG_CORE_LOAD_SHAPE] = &pcg_type_shape,
    [PCG_CORE_LOAD_FACE] = &pcg_type_face,
    [PCG_CORE_LOAD_EDGE] = &pcg_type_edge,
    [PCG_CORE_LOAD_VERTEX] = &pcg_type_vertex,
    [PCG_CORE_LOAD_IMPULSE] = &pcg_type_impulse,
    [PCG_CORE_LOAD_GROUP] = &core_type_group,
};

static const pcg_port *load_port(const struct pcg_core_load *node, const pcg_entity *e)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        if (pcg_entity_is(e, load_type[node->items[i].kind])) {
            return node->items[i].port;
        }
    }
    return node->out;
}

int pcg_core_load(pcg_call *call, struct pcg_core_load *node)
{
    pcg_frame *owner = 0;
    pool_list *list = pool_find(call->frame, POOL_STORED, node->key, &owner);
    for (pcg_u32 i = 0; list && i < list->count; i++) {
        PCG_TRY(pool_lend(call, owner, list->at[i]));
        PCG_TRY(pcg_emit(call, load_port(node, list->at[i]), pcg_entity_hold(list->at[i])));
        PCG_TRY(pcg_tick(call));
    }
    for (pcg_u32 i = 0; list && node->take && i < list->count; i++) {
        pcg_entity_drop(call->run, list->at[i]);
    }
    if (list && node->take) {
        list->count = 0;
    }
    return PCG_OK;
}

/*pcg
/// Sends on what a group holds.
///
/// The members leave in their order, as they are: changes that were made to them elsewhere are seen. A member leaves
/// through the first port whose type it is of, the others through `out`. Groups in a group leave as groups, unless
/// `deep` is set.
procedure ungroup(in: Group) -> (out: Entity) [pure] {
    category "organise"
    synonyms "group", "members", "explode", "contents", "split up", "flatten"
    param deep: bool = false /// Members of groups in the group leave, and no group.
    /// Members that are shapes.
    augment shape() -> Shape
    /// Members that are faces of shapes, by reference.
    augment face() -> Face
    /// Members that are edges of shapes, by reference.
    augment edge() -> Edge
    /// Members that are vertices of shapes, by reference.
    augment vertex() -> Vertex
    /// Members that are impulses.
    augment impulse() -> Impulse
    /// Members that are groups.
    augment group() -> Group
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 6)
        -> group()
        -> ungroup { shape } expect shape.area = 36, out.count = 0
    example rectangle(width = 2m, height = 3m)
        -> group() -> group()
        -> ungroup(deep = true) expect count = 1
}
*/
#include "ungroup.h"
#include "group_entity.h"

static const pcg_type *const ungroup_type[] = {
    [PCG_CORE_UNGROUP_SHAPE] = &pcg_type_shape,
    [PCG_CORE_UNGROUP_FACE] = &pcg_type_face,
    [PCG_CORE_UNGROUP_EDGE] = &pcg_type_edge,
    [PCG_CORE_UNGROUP_VERTEX] = &pcg_type_vertex,
    [PCG_CORE_UNGROUP_IMPULSE] = &pcg_type_impulse,
    [PCG_CORE_UNGROUP_GROUP] = &core_type_group,
};

static const pcg_port *ungroup_port(const struct pcg_core_ungroup *node, const pcg_entity *e)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        if (pcg_entity_is(e, ungroup_type[node->items[i].kind])) {
            return node->items[i].port;
        }
    }
    return node->out;
}

/* As deep as groups may be. */
static int ungroup_send(pcg_call *call, const struct pcg_core_ungroup *node, const core_group *g)
{
    for (pcg_u32 i = 0; i < g->count; i++) {
        pcg_entity *e = g->members[i];
        PCG_TRY(pcg_tick(call));
        if (node->deep && e->type == &core_type_group) {
            PCG_TRY(ungroup_send(call, node, (const core_group *)e));
        } else {
            PCG_TRY(pcg_emit(call, ungroup_port(node, e), pcg_entity_hold(e)));
        }
    }
    return PCG_OK;
}

int pcg_core_ungroup(pcg_call *call, struct pcg_core_ungroup *node)
{
    int status = ungroup_send(call, node, (const core_group *)node->in);
    pcg_entity_drop(call->run, node->in);
    return status;
}

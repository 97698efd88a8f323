/*pcg
/// Hands attributes of a group on to its members, or those of a shape to its parts.
///
/// The values are those that the container has now; members that are groups themselves get them too, but hand nothing
/// on. The parts of a shape have them when `parts` sends them on. What is neither a group nor a shape goes on as it is,
/// with a warning.
procedure to_parts<T: Entity>(in: T) -> (out: T) [pure, one_to_one] {
    category "attributes"
    synonyms "members", "inherit", "push down", "children", "container", "group", "faces", "vertices"
    param kind: PartKind = faces /// Of a shape: which of its parts.
    /// One attribute; they are handed on in order.
    augment value(
        of: attribute, /// The container's.
        to: attribute  /// The members', of the same type.
    )
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 4)
        -> group()
        -> set { assign(@n, 3) }
        -> to_parts { value(@n, @n) }
        -> ungroup() -> c: condition(@n == 3) expect c.yes.count = 4
    example box()
        -> set { assign(@n, 3) }
        -> to_parts(kind = vertices) { value(@n, @m) }
        -> parts { vertices } -> c: condition(@m == 3) expect c.yes.count = 8
}

/// Which parts of a shape are meant.
enum PartKind {
    faces       /// Its faces.
    edges       /// Its edges, those of faces and loose ones, once.
    vertices    /// Its vertices, those in one place once.
}
*/
#include "to_parts.h"
#include "aggregation.h"
#include "members.h"

static int parts_hand_on(pcg_call *call, const core_aggregate *a, pcg_entity *whole,
                         const core_members *m)
{
    pcg_cell value[4];
    PCG_TRY(core_aggregate_check(call, a));
    PCG_TRY(core_aggregate_compute(call, a, &whole, 1, value));
    for (pcg_u32 i = 0; i < m->count; i++) {
        pcg_set_cells(call->run, m->at[i], &a->to, value);
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

int pcg_core_to_parts(pcg_call *call, struct pcg_core_to_parts *node)
{
    core_members m;
    PCG_TRY(core_members_open(call, node->in, node->kind, &m));
    int status = PCG_OK;
    for (pcg_u32 i = 0; i < node->item_count && status == PCG_OK; i++) {
        const struct pcg_core_to_parts_item *item = &node->items[i];
        const core_aggregate a = {CORE_FIRST, item->name, item->value.of, item->value.to};
        status = parts_hand_on(call, &a, node->in, &m);
    }
    core_members_close(call->run, &m);
    return status == PCG_OK ? pcg_emit(call, node->out, node->in) : status;
}

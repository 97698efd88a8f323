/*pcg
/// Puts the entities of a list into groups.
///
/// Entities are in one group where they are equal in all attributes of `by`; without any, the whole list is
/// one. A group is an entity of its own, which holds the others by reference: they stay what they are, and `ungroup`
/// sends them on again, changed or not. It descends from its first member and has its attributes. Groups leave in the
/// order in which they begin, and hold their members in the order of the list. Sent into an encapsulated graph, a group
/// brings all of its members into one execution.
procedure group<T: Entity>(in: T[]) -> (out: Group) [pure] {
    category "organise"
    synonyms "collect", "container", "bundle", "set", "partition", "together"
    attr size: int  /// Written, to groups and members: how many are in the group.
    attr index: int /// Written, to groups and members: the number of the group, from 0.
    augment by(key: attribute) /// What is equal in this attribute, and in those of all others, is one group.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 6, index => @n)
        -> set { assign(@lot, @n % 2) }
        -> group(size => @size) { by(@lot) }
        -> c: condition(@size == 3) expect c.yes.count = 2
}
*/
#include "group.h"
#include "by.h"
#include "group_entity.h"
#include "runtime/memory.h"

static void group_number(pcg_call *call, const struct pcg_core_group *node, pcg_entity *e,
                         pcg_int size, pcg_int index)
{
    pcg_set_int(call->run, e, &node->size, size);
    pcg_set_int(call->run, e, &node->index, index);
}

/* Sends one group; *taken is how many of by->at are no longer the caller's. */
static int group_send(pcg_call *call, const struct pcg_core_group *node, const core_by *by,
                      pcg_u32 group, pcg_u32 *taken)
{
    pcg_u32 begin = core_by_begin(by, group), size = by->ends[group] - begin;
    for (pcg_u32 i = 0; i < size; i++) {
        group_number(call, node, by->at[begin + i], size, group);
        PCG_TRY(pcg_tick(call));
    }
    *taken = by->ends[group];
    core_group *g = core_group_new(call, by->at + begin, size);
    return g ? pcg_emit(call, node->out, &g->entity) : PCG_FAILED;
}

int pcg_core_group(pcg_call *call, struct pcg_core_group *node)
{
    const pcg_slot **keys = run_alloc_array(call->run, node->item_count, sizeof *keys);
    core_by by;
    if (!keys) {
        return PCG_FAILED;
    }
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        keys[i] = &node->items[i].by.key;
    }
    int status = core_by_open(call, &node->in, keys, node->item_count, &by);
    run_free(call->run, keys, node->item_count * sizeof *keys);
    if (status != PCG_OK) {
        return status;
    }
    pcg_u32 taken = 0;
    for (pcg_u32 i = 0; i < by.count && status == PCG_OK; i++) {
        status = group_send(call, node, &by, i, &taken);
    }
    for (pcg_u32 i = taken; i < by.entities; i++) {
        pcg_entity_drop(call->run, by.at[i]);
    }
    core_by_close(call->run, &by);
    return status;
}

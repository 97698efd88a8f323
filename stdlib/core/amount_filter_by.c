/*pcg
/// Picks a number of entities out of each group of a list.
///
/// Takes all that wait at once. Entities are in one group where they are equal in all attributes of `by`;
/// without any, the whole list is one. Positions are counted from 0 within a group. A negative `amount` picks
/// none; a negative `start` counts from the group's end, so that -1 begins at its last entity. Order is kept: groups
/// are not put together.
procedure amount_filter_by<T: Entity>(in: T[]) -> (picked: T, rest: T) [pure] {
    category "flow"
    synonyms "take", "first", "unique", "distinct", "group", "one of each", "limit"
    param amount: int = 1 /// How many are picked from each group, as far as there are so many.
    param start: int = 0  /// Position of the first one that is picked.
    augment by(key: attribute) /// What is equal in this attribute, and in those of all others, is one group.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 6, index => @n)
        -> set { assign(@lot, @n / 2) }
        -> f: amount_filter_by { by(@lot) } expect f.picked.count = 3, f.rest.count = 3
}
*/
#include "amount_filter_by.h"
#include "core.h"
#include "runtime/grouping.h"
#include "runtime/memory.h"

static int filter_is_picked(pcg_int position, pcg_int size, pcg_int start, pcg_int amount)
{
    pcg_int first = start < 0 ? start + size : start;
    first = first < 0 ? 0 : first;
    /* The difference cannot overflow: it is taken only where first <= position. */
    return position >= first && position - first < amount;
}

/* Sends all on; `seen` counts those of each group. */
static int filter_send(pcg_call *call, const struct pcg_core_amount_filter_by *node,
                       const grouping *groups, pcg_u32 *seen)
{
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        pcg_u32 group = groups->group[i];
        int picked =
            filter_is_picked(seen[group]++, groups->size[group], node->start, node->amount);
        PCG_TRY(pcg_emit(call, picked ? node->picked : node->rest, node->in.at[i]));
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

int pcg_core_amount_filter_by(pcg_call *call, struct pcg_core_amount_filter_by *node)
{
    const pcg_slot **keys = run_alloc_array(call->run, node->item_count, sizeof *keys);
    grouping groups;
    if (!keys) {
        return PCG_FAILED;
    }
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        keys[i] = &node->items[i].by.key;
    }
    int status = grouping_open(call, &node->in, keys, node->item_count, &groups);
    run_free(call->run, keys, node->item_count * sizeof *keys);
    if (status != PCG_OK) {
        return status;
    }
    pcg_u32 *seen = run_alloc_array(call->run, groups.count, sizeof *seen);
    status = seen ? filter_send(call, node, &groups, seen) : PCG_FAILED;
    run_free(call->run, seen, groups.count * sizeof *seen);
    grouping_close(call->run, &groups);
    return status;
}

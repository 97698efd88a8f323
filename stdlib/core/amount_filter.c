/*pcg
/// Picks a number of entities out of a list.
///
/// Takes all that wait at once. Positions are counted from 0. A negative `amount` picks none; a negative
/// `start` counts from the end, so that -1 begins at the last entity. Order is kept.
procedure amount_filter<T: Entity>(in: T[]) -> (picked: T, rest: T) [pure] {
    category "flow"
    synonyms "take", "skip", "first", "limit", "slice", "nth"
    param amount: int    /// How many are picked, as far as there are so many.
    param start: int = 0 /// Position of the first one that is picked.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 5)
        -> f: amount_filter(amount = 2, start = 1) expect f.picked.count = 2, f.rest.count = 3
}
*/
#include "amount_filter.h"

int pcg_core_amount_filter(pcg_call *call, struct pcg_core_amount_filter *node)
{
    pcg_int count = node->in.count;
    pcg_int start = node->start < 0 ? node->start + count : node->start;
    pcg_int amount = node->amount;
    if (start < 0) {
        start = 0;
    }
    for (pcg_int i = 0; i < count; i++) {
        /* The difference cannot overflow: it is taken only where start <= i. */
        int picked = i >= start && i - start < amount;
        int status = pcg_tick(call);
        if (status == PCG_OK) {
            status = pcg_emit(call, picked ? node->picked : node->rest, node->in.at[i]);
        }
        if (status != PCG_OK) {
            return status;
        }
    }
    return PCG_OK;
}

/*pcg
/// Writes random numbers into attributes.
///
/// The numbers depend on the run's seed, on this node and on the entity's line of descent: an entity keeps its
/// numbers whatever happens to others, and draws the same ones when it comes by again. With `again = true` the
/// node counts its rounds and every entity draws new numbers each time it passes, in a loop for one.
procedure random<T: Entity>(in: T) -> (out: T) [stateful, one_to_one] {
    category "attributes"
    synonyms "rand", "chance", "dice", "vary", "stochastic"
    param again: bool = false /// New numbers each time an entity passes.
    /// One attribute and the interval that its value is drawn from, evenly.
    augment value(
        to: attribute,   /// A number of any unit, a vector or a colour, each component of which is drawn on its own.
        low: any = 0,    /// The interval's one end, of the attribute's type.
        high: any = 1    /// Its other end, which is not reached itself, but by an int.
    )
    /// One attribute that is true or false by chance.
    augment flag(
        to: attribute,             /// A bool.
        probability: ratio = 50%   /// How probable it is to be true.
    )
    example rectangle(width = 2m, height = 3m)
        -> random { value(@height, 5.0, 15.0) }
        -> c: condition(@height >= 5 && @height < 15) expect c.yes.count = 1
}
*/
#include "random.h"
#include "core.h"
#include <math.h>
#include "runtime/value.h"

/* Whole numbers from low to high, both included, every one as probable as the others. */
static pcg_int random_whole(pcg_int low, pcg_int high, double drawn)
{
    if (high < low) {
        pcg_int swap = low;
        low = high;
        high = swap;
    }
    /* The difference, and what is added to it, fit into an unsigned number. */
    pcg_u64 distance = (pcg_u64)high - (pcg_u64)low;
    double share = drawn * ((double)distance + 1);
    pcg_u64 up = share >= 18446744073709551616.0 ? distance : (pcg_u64)share;
    return (pcg_int)((pcg_u64)low + (up > distance ? distance : up));
}

static double random_between(double low, double high, double drawn)
{
    return low <= high ? low + drawn * (high - low) : high + drawn * (low - high);
}

/* The number that is drawn for component k of item i: the first one is that of the item itself. */
static double random_draw(const pcg_call *call, pcg_u32 i, pcg_u32 k, pcg_u64 turn)
{
    return pcg_random(call, CORE_RANDOM_SITE + i, k ? pcg_mix(turn, k) : turn);
}

static int random_value(pcg_call *call, pcg_entity *e, const struct pcg_core_random_item *item,
                        pcg_u32 i, pcg_u64 turn)
{
    const pcg_slot *to = &item->value.to;
    const pcg_cell *low = item->value.low.cell, *high = item->value.high.cell;
    pcg_cell result[4];
    if (to->kind == PCG_INT) {
        result[0].i = random_whole(low[0].i, high[0].i, random_draw(call, i, 0, turn));
    } else if (value_has_floats(to->kind) && to->kind != PCG_QUATERNION) {
        for (pcg_u32 k = 0; k < value_width(to->kind); k++) {
            result[k].f = random_between(low[k].f, high[k].f, random_draw(call, i, k, turn));
        }
    } else {
        return pcg_fail(
            call, "'%s' writes to an attribute of type %s, which is no number, vector or colour",
            item->name, value_kind_name(to->kind));
    }
    pcg_set_cells(call->run, e, to, result);
    return PCG_OK;
}

static int random_flag(pcg_call *call, pcg_entity *e, const struct pcg_core_random_item *item,
                       pcg_u32 i, pcg_u64 turn)
{
    const pcg_slot *to = &item->flag.to;
    if (to->kind != PCG_BOOL) {
        return pcg_fail(call, "'%s' writes to an attribute of type %s, which is no bool",
                        item->name, value_kind_name(to->kind));
    }
    pcg_set_bool(call->run, e, to, random_draw(call, i, 0, turn) < item->flag.probability);
    return PCG_OK;
}

int pcg_core_random(pcg_call *call, struct pcg_core_random *node)
{
    pcg_u64 turn = node->again ? call->instance->rounds : 0;
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        const struct pcg_core_random_item *item = &node->items[i];
        PCG_TRY(item->kind == PCG_CORE_RANDOM_FLAG ? random_flag(call, node->in, item, i, turn)
                                                   : random_value(call, node->in, item, i, turn));
    }
    return pcg_emit(call, node->out, node->in);
}

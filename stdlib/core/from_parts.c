/*pcg
/// Writes what the members of a group, or the parts of a shape, have in an attribute to the whole: the first, the sum, the
/// average and the like.
///
/// Works on the members as `aggregate` does on a list; `first` and `last` take any type of attribute. A shape without such
/// parts is written their number only. What is neither a group nor a shape goes on as it is, with a warning.
procedure from_parts<T: Entity>(in: T) -> (out: T) [pure, one_to_one] {
    category "attributes"
    synonyms "members", "aggregate", "collect", "children", "container", "group", "faces", "vertices"
    param kind: PartKind = faces /// Of a shape: which of its parts.
    /// What the first member has.
    augment first(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    /// What the last member has.
    augment last(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    /// The smallest value.
    augment min(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    /// The largest value.
    augment max(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    /// The arithmetic mean.
    augment average(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    /// The sum; of bools, how many are true.
    augment sum(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    /// The value in the middle; between the two of an even number.
    augment median(
        of: attribute, /// The members'.
        to: attribute  /// The whole's.
    )
    augment count(to: attribute) /// How many members there are: where the number goes.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 4, index => @n)
        -> group()
        -> from_parts { last(@n, @newest); sum(@n, @total) }
        -> c: condition(@newest == 3 && @total == 6) expect c.yes.count = 1
    example box(width = 4m, depth = 3m, height = 2m) -> s: sequence { each: step; whole: step };
        s.each -> parts { faces } -> set { assign(@size, int(normal(in).z)) };
        s.whole -> from_parts { max(@size, @top); count(@n) }
        -> c: condition(@top == 1 && @n == 6) expect c.yes.count = 1
}
*/
#include "from_parts.h"
#include "aggregation.h"
#include "members.h"

static core_aggregate parts_of(const struct pcg_core_from_parts_item *item)
{
    switch (item->kind) {
    case PCG_CORE_FROM_PARTS_FIRST:
        return (core_aggregate){CORE_FIRST, item->name, item->first.of, item->first.to};
    case PCG_CORE_FROM_PARTS_LAST:
        return (core_aggregate){CORE_LAST, item->name, item->last.of, item->last.to};
    case PCG_CORE_FROM_PARTS_MIN:
        return (core_aggregate){CORE_MIN, item->name, item->min.of, item->min.to};
    case PCG_CORE_FROM_PARTS_MAX:
        return (core_aggregate){CORE_MAX, item->name, item->max.of, item->max.to};
    case PCG_CORE_FROM_PARTS_AVERAGE:
        return (core_aggregate){CORE_AVERAGE, item->name, item->average.of, item->average.to};
    case PCG_CORE_FROM_PARTS_SUM:
        return (core_aggregate){CORE_SUM, item->name, item->sum.of, item->sum.to};
    case PCG_CORE_FROM_PARTS_MEDIAN:
        return (core_aggregate){CORE_MEDIAN, item->name, item->median.of, item->median.to};
    default:
        return (core_aggregate){CORE_COUNT, item->name, item->count.to, item->count.to};
    }
}

static int parts_write(pcg_call *call, const core_aggregate *a, pcg_entity *whole,
                       const core_members *m)
{
    pcg_cell result[4];
    PCG_TRY(core_aggregate_check(call, a));
    if (m->count == 0 && a->how != CORE_COUNT) {
        return PCG_OK;
    }
    PCG_TRY(core_aggregate_compute(call, a, m->at, m->count, result));
    pcg_set_cells(call->run, whole, &a->to, result);
    return PCG_OK;
}

int pcg_core_from_parts(pcg_call *call, struct pcg_core_from_parts *node)
{
    core_members m;
    PCG_TRY(core_members_open(call, node->in, node->kind, &m));
    int status = PCG_OK;
    for (pcg_u32 i = 0; i < node->item_count && m.there && status == PCG_OK; i++) {
        const core_aggregate a = parts_of(&node->items[i]);
        status = parts_write(call, &a, node->in, &m);
    }
    core_members_close(call->run, &m);
    return status == PCG_OK ? pcg_emit(call, node->out, node->in) : status;
}

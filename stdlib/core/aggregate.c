/*pcg
/// Writes the sum, the average and the like of a list's attributes to all of its entities.
///
/// With `by`, entities that are equal in those attributes are a list of their own. All values are computed before the
/// first of them is written. Vectors and colours are worked on by component. What is no number is left out; where
/// nothing remains the result is no number. What is computed has the attribute's type, or is a plain number;
/// an int can be written to a float, and to an int an average is cut down and a median is the lower one of two.
procedure aggregate<T: Entity>(in: T[]) -> (out: T) [pure] {
    category "attributes"
    synonyms "total", "mean", "reduce", "statistics", "fold", "summary"
    augment by(key: attribute)    /// What is equal in this attribute, and in those of all others, is one list.
    /// The smallest value.
    augment min(
        of: attribute, /// What is read.
        to: attribute  /// Where the result goes.
    )
    /// The largest value.
    augment max(
        of: attribute, /// What is read.
        to: attribute  /// Where the result goes.
    )
    /// The arithmetic mean.
    augment average(
        of: attribute, /// What is read.
        to: attribute  /// Where the result goes.
    )
    /// The sum; of bools, how many are true.
    augment sum(
        of: attribute, /// What is read.
        to: attribute  /// Where the result goes.
    )
    /// The value in the middle; between the two of an even number.
    augment median(
        of: attribute, /// What is read.
        to: attribute  /// Where the result goes.
    )
    augment count(to: attribute)  /// How many entities there are: where the number goes.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 5, index => @n)
        -> aggregate { sum(@n, @total); max(@n, @most); count(@many) }
        -> c: condition(@total == 10 && @most == 4 && @many == 5) expect c.yes.count = 5
}
*/
#include "aggregate.h"
#include "aggregation.h"
#include "by.h"
#include "runtime/memory.h"

/* What the node computes, and the keys of its groups. */
typedef struct aggregate_plan {
    core_aggregate *wanted;
    const pcg_slot **keys;
    pcg_cell (*results)[4]; /* group by group, as many as are wanted in each */
    pcg_u32 wanted_count, key_count, room;
    size_t result_count;
} aggregate_plan;

static core_aggregate aggregate_of(const struct pcg_core_aggregate_item *item)
{
    switch (item->kind) {
    case PCG_CORE_AGGREGATE_MIN:
        return (core_aggregate){CORE_MIN, item->name, item->min.of, item->min.to};
    case PCG_CORE_AGGREGATE_MAX:
        return (core_aggregate){CORE_MAX, item->name, item->max.of, item->max.to};
    case PCG_CORE_AGGREGATE_AVERAGE:
        return (core_aggregate){CORE_AVERAGE, item->name, item->average.of, item->average.to};
    case PCG_CORE_AGGREGATE_SUM:
        return (core_aggregate){CORE_SUM, item->name, item->sum.of, item->sum.to};
    case PCG_CORE_AGGREGATE_MEDIAN:
        return (core_aggregate){CORE_MEDIAN, item->name, item->median.of, item->median.to};
    default:
        return (core_aggregate){CORE_COUNT, item->name, item->count.to, item->count.to};
    }
}

static int aggregate_plan_open(pcg_call *call, const struct pcg_core_aggregate *node,
                               aggregate_plan *p)
{
    *p = (aggregate_plan){.room = node->item_count};
    p->wanted = run_alloc_array(call->run, p->room, sizeof *p->wanted);
    p->keys = run_alloc_array(call->run, p->room, sizeof *p->keys);
    if (!p->wanted || !p->keys) {
        return PCG_FAILED;
    }
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        const struct pcg_core_aggregate_item *item = &node->items[i];
        if (item->kind == PCG_CORE_AGGREGATE_BY) {
            p->keys[p->key_count++] = &item->by.key;
        } else {
            p->wanted[p->wanted_count++] = aggregate_of(item);
            PCG_TRY(core_aggregate_check(call, &p->wanted[p->wanted_count - 1]));
        }
    }
    return PCG_OK;
}

static void aggregate_plan_close(pcg_run *r, aggregate_plan *p)
{
    run_free(r, p->wanted, p->room * sizeof *p->wanted);
    run_free(r, p->keys, p->room * sizeof *p->keys);
    run_free(r, p->results, p->result_count * sizeof *p->results);
}

static int aggregate_compute(pcg_call *call, aggregate_plan *p, const core_by *by)
{
    size_t results = (size_t)by->count * p->wanted_count;
    p->results = run_alloc_array(call->run, results, sizeof *p->results);
    if (!p->results) {
        return PCG_FAILED;
    }
    p->result_count = results;
    for (pcg_u32 group = 0; group < by->count; group++) {
        pcg_u32 begin = core_by_begin(by, group), size = by->ends[group] - begin;
        for (pcg_u32 i = 0; i < p->wanted_count; i++) {
            pcg_cell *result = p->results[(size_t)group * p->wanted_count + i];
            PCG_TRY(core_aggregate_compute(call, &p->wanted[i], by->at + begin, size, result));
        }
    }
    return PCG_OK;
}

static int aggregate_send(pcg_call *call, const struct pcg_core_aggregate *node,
                          const aggregate_plan *p, const core_by *by)
{
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        pcg_cell(*results)[4] = p->results + (size_t)by->group[i] * p->wanted_count;
        for (pcg_u32 k = 0; k < p->wanted_count; k++) {
            pcg_set_cells(call->run, node->in.at[i], &p->wanted[k].to, results[k]);
        }
        PCG_TRY(pcg_emit(call, node->out, node->in.at[i]));
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

int pcg_core_aggregate(pcg_call *call, struct pcg_core_aggregate *node)
{
    aggregate_plan p;
    core_by by;
    int status = aggregate_plan_open(call, node, &p);
    if (status == PCG_OK) {
        status = core_by_open(call, &node->in, p.keys, p.key_count, &by);
        if (status == PCG_OK) {
            status = aggregate_compute(call, &p, &by);
            if (status == PCG_OK) {
                status = aggregate_send(call, node, &p, &by);
            }
            core_by_close(call->run, &by);
        }
    }
    aggregate_plan_close(call->run, &p);
    return status;
}

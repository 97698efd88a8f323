/*pcg
/// Adds amounts up over the run, by keys, for a table beside the result.
///
/// Every entity that passes adds to the totals: `report { value("floor.area", area(in)); value("cost." + @use, @cost) }`.
/// The same key may be used in several nodes and graphs. A key's points say what belongs together: floor.area, floor.count.
/// `--json` prints sum, count, least and most for each key, `-o table.csv` writes them.
procedure report<T: Entity>(in: T) -> (out: T) [effect, one_to_one] {
    category "debug"
    synonyms "total", "statistics", "sum", "table", "csv", "count"
    /// One amount.
    augment value(
        key: string,     /// What it is added to.
        amount: any = 1  /// A number of any unit, or a bool, which counts as 1 or 0; evaluated for each entity.
    )
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 4)
        -> report { value("lot.area", area(in)); value("lot.count") } expect count = 4
}
*/
#include "report.h"
#include "runtime/run.h"
#include "runtime/value.h"

static int report_add(pcg_call *call, const struct pcg_core_report_item *item)
{
    const pcg_any *amount = &item->value.amount;
    if (!item->value.key[0]) {
        return pcg_fail(call, "'%s' adds to a key without a name", item->name);
    }
    if (value_is_float(amount->kind)) {
        return total_add(call->run, item->value.key, amount->cell[0].f);
    }
    if (amount->kind == PCG_INT || amount->kind == PCG_BOOL) {
        return total_add(call->run, item->value.key, (double)amount->cell[0].i);
    }
    return pcg_fail(call, "'%s' adds up numbers, not a value of type %s", item->name,
                    value_kind_name(amount->kind));
}

int pcg_core_report(pcg_call *call, struct pcg_core_report *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        PCG_TRY(report_add(call, &node->items[i]));
    }
    return pcg_emit(call, node->out, node->in);
}

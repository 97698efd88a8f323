/*pcg
/// Writes attributes of an entity by values that come from several.
///
/// Each `source` adds an input; a round takes one entity of each, and the expressions read them by the inputs' names:
/// `road@width`, `area(road)`. The entities at the sources are consumed. All values are evaluated before the
/// first of them is written.
procedure set_from<T: Entity>(in: T) -> (out: T) [pure] {
    category "attributes"
    synonyms "set", "assign", "several", "join", "lookup", "attribute"
    /// One attribute and what it becomes.
    augment assign(
        to: attribute, /// The attribute that is written, of the entity at `in`.
        value: any     /// Of the attribute's type; evaluated for each round.
    )
    /// One more entity that expressions can read.
    augment source() <- Entity
    example s: set_from { assign(@n, road@n + 1); road: source };
        rectangle(width = 2m, height = 3m) -> s.in;
        rectangle(width = 1m, height = 1m) -> set { assign(@n, 5) } -> s.road;
        s -> c: condition(@n == 6) expect c.yes.count = 1
}
*/
#include "set_from.h"

int pcg_core_set_from(pcg_call *call, struct pcg_core_set_from *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        const struct pcg_core_set_from_item *item = &node->items[i];
        if (item->kind == PCG_CORE_SET_FROM_ASSIGN) {
            pcg_set_cells(call->run, node->in, &item->assign.to, item->assign.value.cell);
        } else {
            pcg_entity_drop(call->run, item->input);
        }
    }
    return pcg_emit(call, node->out, node->in);
}

/*pcg
/// Writes attributes of the entities that pass.
///
/// The assignments are made in order, but all values are evaluated before the first of them is written:
/// `{ assign(@a, @b); assign(@b, @a) }` swaps.
procedure set<T: Entity>(in: T) -> (out: T) [pure, one_to_one] {
    category "attributes"
    synonyms "assign", "write", "attribute", "let", "store"
    /// One attribute and what it becomes.
    augment assign(
        to: attribute, /// The attribute that is written.
        value: any     /// Of the attribute's type; evaluated for each entity.
    )
    example rectangle(width = 2m, height = 3m)
        -> set { assign(@floor, 2); assign(@floor, @floor + 1) }
        -> c: condition(@floor == 1) expect c.yes.count = 1
}
*/
#include "set.h"

int pcg_core_set(pcg_call *call, struct pcg_core_set *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        const struct pcg_core_set_item *item = &node->items[i];
        pcg_set_cells(call->run, node->in, &item->assign.to, item->assign.value.cell);
    }
    return pcg_emit(call, node->out, node->in);
}

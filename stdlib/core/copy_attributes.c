/*pcg
/// Copies attributes from one entity to another.
///
/// The entity at `from` goes on through `source`. Without augmentations all attributes of the graph are copied;
/// what was not written at `from` is at its default afterwards. `combine` makes pairs where one entity serves many.
procedure copy_attributes<T: Entity, S: Entity>(in: T, from: S) -> (out: T, source: S) [pure] {
    category "attributes"
    synonyms "transfer", "inherit", "attribute", "assign"
    augment only(key: attribute) /// Copies this attribute; those that no item names stay as they are.
    example p: copy_attributes();
        rectangle(width = 2m, height = 3m) -> p.in;
        rectangle(width = 1m, height = 1m) -> set { assign(@n, 5) } -> p.from;
        p.out -> c: condition(@n == 5 && area(in) == 6m2) expect c.yes.count = 1
}
*/
#include "copy_attributes.h"
#include "runtime/run.h"

int pcg_core_copy_attributes(pcg_call *call, struct pcg_core_copy_attributes *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        const pcg_slot *key = &node->items[i].only.key;
        pcg_set_cells(call->run, node->in, key, pcg_get(node->from, key));
    }
    if (node->item_count == 0) {
        attributes_take(call->run, node->in, node->from, call->frame->base);
    }
    PCG_TRY(pcg_emit(call, node->out, node->in));
    return pcg_emit(call, node->source, node->from);
}

/*pcg
/// Exchanges attributes between two entities.
///
/// Both attributes of an exchange have the same type. Those of one entity are exchanged by
/// `set { assign(@x, @y); assign(@y, @x) }`.
procedure swap<A: Entity, B: Entity>(a: A, b: B) -> (first: A, second: B) [pure] {
    category "attributes"
    synonyms "exchange", "trade", "move", "attribute"
    /// One exchange; they are made in order.
    augment exchange(
        of_a: attribute, /// The attribute of the entity at `a`.
        of_b: attribute  /// The attribute of the entity at `b`.
    )
    example s: swap { exchange(@n, @n) };
        rectangle(width = 2m, height = 3m) -> set { assign(@n, 1) } -> s.a;
        rectangle(width = 1m, height = 1m) -> set { assign(@n, 2) } -> s.b;
        s.first -> c: condition(@n == 2 && area(in) == 6m2) expect c.yes.count = 1
}
*/
#include "swap.h"
#include <string.h>
#include "runtime/value.h"

static int swap_exchange(pcg_call *call, const struct pcg_core_swap *node,
                         const struct pcg_core_swap_item *item)
{
    const pcg_slot *of_a = &item->exchange.of_a, *of_b = &item->exchange.of_b;
    pcg_cell was_a[4], was_b[4];
    if (of_a->kind != of_b->kind || of_a->element != of_b->element) {
        return pcg_fail(call, "'%s' exchanges attributes of different types: %s and %s", item->name,
                        value_kind_name(of_a->kind), value_kind_name(of_b->kind));
    }
    size_t size = value_width(of_a->kind) * sizeof was_a[0];
    memcpy(was_a, pcg_get(node->a, of_a), size);
    memcpy(was_b, pcg_get(node->b, of_b), size);
    pcg_set_cells(call->run, node->a, of_a, was_b);
    pcg_set_cells(call->run, node->b, of_b, was_a);
    return PCG_OK;
}

int pcg_core_swap(pcg_call *call, struct pcg_core_swap *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        PCG_TRY(swap_exchange(call, node, &node->items[i]));
    }
    PCG_TRY(pcg_emit(call, node->first, node->a));
    return pcg_emit(call, node->second, node->b);
}

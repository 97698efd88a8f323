/*pcg
/// Sends one and the same entity through several ports, one after the other.
///
/// What is connected to the first step runs first. All of them see the entity itself, not copies: what one
/// changes, the next one finds changed.
procedure sequence<T: Entity>(in: T) [pure] {
    category "organise"
    synonyms "order", "then", "reference", "tee", "steps"
    /// One port; they are served in the order in which they are written.
    augment step() -> T
    example rectangle(width = 2m, height = 3m)
        -> s: sequence { first: step; second: step } expect s.first.count = 1, s.second.count = 1
}
*/
#include "sequence.h"

int pcg_core_sequence(pcg_call *call, struct pcg_core_sequence *node)
{
    int status = PCG_OK;
    for (pcg_u32 i = 0; i < node->item_count && status == PCG_OK; i++) {
        status = pcg_emit(call, node->items[i].port, pcg_entity_hold(node->in));
    }
    pcg_entity_drop(call->run, node->in);
    return status;
}

/*pcg
/// Sends on all pairs of entities from two lists.
///
/// The first entity of `a` goes with each of `b`, then the second one, and so on: what leaves through `first` and
/// `second` at the same position is a pair. No entity is copied: all are references, so that one that is changed in a
/// pair is found changed in the next. Without an edge from one of the ports only the other one is served.
procedure combine<A: Entity, B: Entity>(a: A[], b: B[]) -> (first: A, second: B) [pure] {
    category "organise"
    synonyms "pairs", "product", "cross", "each with each", "reference", "match"
    example c: combine();
        rectangle(width = 2m, height = 3m) -> copy(count = 3) -> c.a;
        rectangle(width = 1m, height = 1m) -> copy(count = 4) -> c.b expect c.first.count = 12, c.second.count = 12
}
*/
#include "combine.h"

int pcg_core_combine(pcg_call *call, struct pcg_core_combine *node)
{
    int status = PCG_OK;
    for (pcg_u32 i = 0; i < node->a.count; i++) {
        for (pcg_u32 k = 0; k < node->b.count && status == PCG_OK; k++) {
            status = pcg_emit(call, node->first, pcg_entity_hold(node->a.at[i]));
            if (status == PCG_OK) {
                status = pcg_emit(call, node->second, pcg_entity_hold(node->b.at[k]));
            }
            if (status == PCG_OK) {
                status = pcg_tick(call);
            }
        }
        pcg_entity_drop(call->run, node->a.at[i]);
    }
    for (pcg_u32 k = 0; k < node->b.count; k++) {
        pcg_entity_drop(call->run, node->b.at[k]);
    }
    return status;
}

/*pcg
/// Numbers the entities of a list, and tells each how many there are.
procedure count<T: Entity>(in: T[]) -> (out: T) [pure] {
    category "organise"
    synonyms "number", "index", "enumerate", "counter", "total"
    attr total: int /// Written: how many entities there are.
    attr index: int /// Written: the number of this one, from 0.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 3)
        -> count(total => @all, index => @n)
        -> c: condition(@n == 2 && @all == 3) expect c.yes.count = 1
}
*/
#include "count.h"

int pcg_core_count(pcg_call *call, struct pcg_core_count *node)
{
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        pcg_entity *e = node->in.at[i];
        pcg_set_int(call->run, e, &node->total, node->in.count);
        pcg_set_int(call->run, e, &node->index, i);
        int status = pcg_emit(call, node->out, e);
        if (status == PCG_OK) {
            status = pcg_tick(call);
        }
        if (status != PCG_OK) {
            return status;
        }
    }
    return PCG_OK;
}

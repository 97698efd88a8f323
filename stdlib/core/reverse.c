/*pcg
/// Turns a list around: what came last leaves first.
procedure reverse<T: Entity>(in: T[]) -> (out: T) [pure] {
    category "order"
    synonyms "flip", "invert", "backwards"
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 3, index => @n)
        -> reverse()
        -> count(index => @place)
        -> c: condition(@n + @place == 2) expect c.yes.count = 3
}
*/
#include "reverse.h"

int pcg_core_reverse(pcg_call *call, struct pcg_core_reverse *node)
{
    for (pcg_u32 i = node->in.count; i > 0; i--) {
        int status = pcg_emit(call, node->out, node->in.at[i - 1]);
        if (status == PCG_OK) {
            status = pcg_tick(call);
        }
        if (status != PCG_OK) {
            return status;
        }
    }
    return PCG_OK;
}

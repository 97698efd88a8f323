/*pcg
/// Puts a list into a random order.
///
/// Every order is as probable as any other. It depends on the seed, on this node and on the line of descent
/// of the first entity of the list.
procedure shuffle<T: Entity>(in: T[]) -> (out: T) [pure] {
    category "order"
    synonyms "random", "mix", "permute", "scramble"
    example rectangle(width = 2m, height = 3m) -> copy(count = 5) -> shuffle() expect count = 5
}
*/
#include "shuffle.h"
#include "core.h"

int pcg_core_shuffle(pcg_call *call, struct pcg_core_shuffle *node)
{
    pcg_entity **at = node->in.at;
    pcg_u32 count = node->in.count;
    for (pcg_u32 i = 0; i < count; i++) {
        /* What leaves next is drawn from those that are still there. */
        pcg_u32 left = count - i;
        pcg_u32 drawn = (pcg_u32)(pcg_random(call, CORE_RANDOM_SITE, i) * left);
        pcg_u32 next = i + (drawn < left ? drawn : left - 1);
        pcg_entity *e = at[next];
        at[next] = at[i];
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

/*pcg
/// Sends on pairs of entities from one list.
///
/// What leaves through `first` and `second` at the same position is a pair. No entity is copied: all are references, so
/// that one that is changed in a pair is found changed in the next. A list of one entity has no pairs.
procedure pair<T: Entity>(in: T[]) -> (first: T, second: T) [pure] {
    category "organise"
    synonyms "combine", "neighbours", "couple", "adjacent", "consecutive", "each with each"
    param of: Pairing = all /// Which entities are pairs.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 5)
        -> p: pair() expect p.first.count = 10, p.second.count = 10
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 5)
        -> p: pair(of = ring) expect p.first.count = 5
}

/// Which entities of a list are pairs.
enum Pairing {
    all        /// Each with each that comes behind it.
    neighbours /// Each with the next one.
    ring       /// Each with the next one, and the last with the first.
    twos       /// The first with the second, the third with the fourth; a last one alone is left out.
}
*/
#include "pair.h"

static int pair_send(pcg_call *call, const struct pcg_core_pair *node, pcg_u32 i, pcg_u32 k)
{
    PCG_TRY(pcg_emit(call, node->first, pcg_entity_hold(node->in.at[i])));
    PCG_TRY(pcg_emit(call, node->second, pcg_entity_hold(node->in.at[k])));
    return pcg_tick(call);
}

static int pair_all(pcg_call *call, const struct pcg_core_pair *node)
{
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        for (pcg_u32 k = i + 1; k < node->in.count; k++) {
            PCG_TRY(pair_send(call, node, i, k));
        }
    }
    return PCG_OK;
}

static int pair_next(pcg_call *call, const struct pcg_core_pair *node, pcg_u32 step)
{
    pcg_u32 count = node->in.count;
    for (pcg_u32 i = 0; i < count && count - i > 1; i += step) {
        PCG_TRY(pair_send(call, node, i, i + 1));
    }
    if (node->of == PCG_PAIRING_RING && count > 1) {
        PCG_TRY(pair_send(call, node, count - 1, 0));
    }
    return PCG_OK;
}

int pcg_core_pair(pcg_call *call, struct pcg_core_pair *node)
{
    int status = node->of == PCG_PAIRING_ALL
                     ? pair_all(call, node)
                     : pair_next(call, node, node->of == PCG_PAIRING_TWOS ? 2 : 1);
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        pcg_entity_drop(call->run, node->in.at[i]);
    }
    return status;
}

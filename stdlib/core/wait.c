/*pcg
/// Holds entities back until something else has come.
///
/// What arrives at `in` waits until anything arrives at `until`; then all that wait are sent on, and what came at
/// `until` is consumed. The signal may be any entity: the last part of a work, or what `receive` got. Where none
/// comes, a warning at the end of the run says how many still waited.
procedure wait<T: Entity>(in: T[], until: Entity[]) -> (out: T) [pure] {
    category "messages"
    synonyms "barrier", "hold", "delay", "gate", "signal", "synchronise"
    example w: wait();
        rectangle(width = 2m, height = 3m) -> copy(count = 3) -> w.in;
        impulse() -> w.until expect w.out.count = 3
}
*/
#include "wait.h"

int pcg_core_wait(pcg_call *call, struct pcg_core_wait *node)
{
    for (pcg_u32 i = 0; i < node->until.count; i++) {
        pcg_entity_drop(call->run, node->until.at[i]);
    }
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        PCG_TRY(pcg_emit(call, node->out, node->in.at[i]));
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

/*pcg
/// Sends a message to whoever receives it.
///
/// Each entity that passes is a message, by reference, and goes on as well. Every `receive` of that name gets it, in
/// whatever graph it stands, when it runs next: nodes that nothing else orders run in order of appearance, so it stands
/// below, or waits for an impulse.
procedure broadcast<T: Entity>(in: T) -> (out: T) [effect, one_to_one] {
    category "messages"
    synonyms "send", "message", "publish", "notify", "signal", "event"
    param message: string /// Its name.
    example rectangle(width = 2m, height = 3m) -> copy(count = 3) -> broadcast(message = "built");
        receive(message = "built") -> c: copy(count = 1) expect c.out.count = 3
}
*/
#include "broadcast.h"
#include "runtime/pool.h"

int pcg_core_broadcast(pcg_call *call, struct pcg_core_broadcast *node)
{
    PCG_TRY(pool_add(call, pool_outermost(call->frame), POOL_MESSAGES, node->message, node->in));
    return pcg_emit(call, node->out, node->in);
}

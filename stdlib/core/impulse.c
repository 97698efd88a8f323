/*pcg
/// Makes impulses: entities without content that set off source nodes.
///
/// A source node that an impulse reaches runs once for it, and what it makes inherits the impulse's
/// attributes: `impulse(count = 52, index => @card) -> rectangle(width = 6cm, height = 9cm)`.
procedure impulse() -> (out: Impulse) [pure] {
    category "flow"
    synonyms "trigger", "start", "source", "loop", "repeat", "for"
    param count: int = 1 /// How many; 0 or less makes none.
    attr index: int      /// Written: the number of the impulse, from 0.
    example impulse(count = 3) expect count = 3
    example impulse(count = 3) -> rectangle(width = 2m, height = 3m) expect count = 3, area = 18
    example impulse(count = 3, index => @n) -> rectangle() -> c: condition(@n == 2) expect c.yes.count = 1
}
*/
#include "impulse.h"

int pcg_core_impulse(pcg_call *call, struct pcg_core_impulse *node)
{
    pcg_int count = node->out->count > 0 ? node->count : 0;
    for (pcg_int i = 0; i < count; i++) {
        pcg_entity *e = pcg_entity_new(call, &pcg_type_impulse, 0);
        if (!e) {
            return PCG_FAILED;
        }
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

/*pcg
/// Counts the entities that pass.
///
/// The node counts its rounds over the whole run: in an encapsulated graph it goes on counting from one execution to
/// the next, apart for each node that encapsulates it. An entity that passes again gets a new number.
procedure counter<T: Entity>(in: T) -> (out: T) [stateful, one_to_one] {
    category "flow"
    synonyms "number", "id", "serial", "increment", "index", "unique"
    param start: int = 0 /// The number of the first one.
    param step: int = 1  /// How much is added for each one.
    attr value: int      /// Written: its number.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 4)
        -> counter(start = 10, step = 5, value => @n)
        -> c: condition(@n == 25) expect c.yes.count = 1
}
*/
#include "counter.h"

int pcg_core_counter(pcg_call *call, struct pcg_core_counter *node)
{
    pcg_int before = (pcg_int)(call->instance->rounds - 1);
    pcg_int value = PCG_INT_ADD(node->start, PCG_INT_MULTIPLY(node->step, before));
    pcg_set_int(call->run, node->in, &node->value, value);
    return pcg_emit(call, node->out, node->in);
}

/*pcg
/// Sends an entity on several times.
///
/// The entity itself is the first; the others are copies that descend from it. With `clone = false` all are
/// the entity itself, so that a change made to one is seen in all, and `index` is the last number written.
/// A count of 0 or less sends nothing on.
procedure copy<T: Entity>(in: T) -> (out: T) [pure] {
    category "organise"
    synonyms "repeat", "duplicate", "clone", "instance", "times"
    param count: int          /// How many leave, the entity itself included.
    param clone: bool = true  /// Copies; otherwise references to the one entity.
    attr index: int           /// Written: the number of the copy, from 0.
    example rectangle(width = 2m, height = 3m) -> copy(count = 4) expect count = 4, area = 24
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 4, index => @n)
        -> c: condition(@n == 3) expect c.yes.count = 1
    example rectangle(width = 2m, height = 3m) -> copy(count = 0) expect count = 0
}
*/
#include "copy.h"

/* The i-th entity to leave, or NULL when memory or the entity limit is passed. */
static pcg_entity *copy_of(pcg_call *call, const struct pcg_core_copy *node, pcg_int i)
{
    if (!node->clone || i == 0) {
        return pcg_entity_hold(node->in);
    }
    return pcg_entity_copy(call->run, node->in, (pcg_u64)i);
}

int pcg_core_copy(pcg_call *call, struct pcg_core_copy *node)
{
    pcg_int count = node->count;
    int status = PCG_OK;
    /* A count may be anything: where nobody listens no copy is worth making. But the entity itself
     * may be seen through another reference. */
    if (node->out->count == 0 && count > 0) {
        pcg_set_int(call->run, node->in, &node->index, node->clone ? 0 : count - 1);
        count = 0;
    }
    for (pcg_int i = 0; i < count && status == PCG_OK; i++) {
        pcg_entity *e = copy_of(call, node, i);
        if (!e) {
            return PCG_FAILED;
        }
        pcg_set_int(call->run, e, &node->index, i);
        status = pcg_emit(call, node->out, e);
        if (status == PCG_OK) {
            status = pcg_tick(call);
        }
    }
    pcg_entity_drop(call->run, node->in);
    return status;
}

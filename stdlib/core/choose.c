/*pcg
/// Sends each entity one of several ways, by chance.
///
/// A way's probability is its weight's share of the sum of all weights. A weight below 0 counts as 0; where none
/// is above it, the entity is reported and dropped. The choice depends on the seed, this node and the entity's line
/// of descent, so that an entity's way does not change because of others.
procedure choose<T: Entity>(in: T) [pure] {
    category "flow"
    synonyms "random", "stochastic", "probability", "chance", "percent"
    /// One way out.
    augment weight(
        share: float = 1 /// How probable it is, compared with the others; evaluated for each entity.
    ) -> T
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 10)
        -> choose { a: weight(3); b: weight(1) } expect count = 10
    example rectangle(width = 2m, height = 3m)
        -> c: choose { never: weight(0); always: weight(1) } expect c.always.count = 1
}
*/
#include "choose.h"
#include "core.h"
#include <math.h>

static double choose_weight(const struct pcg_core_choose_item *item)
{
    return item->weight.share > 0 && isfinite(item->weight.share) ? item->weight.share : 0;
}

int pcg_core_choose(pcg_call *call, struct pcg_core_choose *node)
{
    double sum = 0;
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        sum += choose_weight(&node->items[i]);
    }
    if (!(sum > 0) || !isfinite(sum)) {
        int status = pcg_warn(call, "no weight is above 0, or they are too large: the entity is dropped");
        pcg_entity_drop(call->run, node->in);
        return status;
    }
    double left = pcg_random(call, CORE_RANDOM_SITE, 0) * sum;
    const pcg_port *port = 0;
    for (pcg_u32 i = 0; i < node->item_count && left >= 0; i++) {
        double weight = choose_weight(&node->items[i]);
        if (weight > 0) { /* the last one with a weight takes what rounding leaves over */
            port = node->items[i].port;
            left -= weight;
        }
    }
    return pcg_emit(call, port, node->in);
}

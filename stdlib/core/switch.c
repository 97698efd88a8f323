/*pcg
/// Sends each entity through the first case that holds.
///
/// The cases are tried in the order in which they are written; what fits none leaves through `otherwise`.
procedure switch<T: Entity>(in: T) -> (otherwise: T) [pure] {
    category "flow"
    synonyms "case", "select", "branch", "if", "else", "conditions"
    /// One way out and when it is taken.
    augment case(
        test: bool /// Evaluated for each entity.
    ) -> T
    example rectangle(width = 2m, height = 3m)
        -> s: switch { small: case(area(in) < 5m2); large: case(true) } expect s.large.count = 1, s.otherwise.count = 0
}
*/
#include "switch.h"

int pcg_core_switch(pcg_call *call, struct pcg_core_switch *node)
{
    const pcg_port *port = node->otherwise;
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        if (node->items[i].case_.test) {
            port = node->items[i].port;
            break;
        }
    }
    return pcg_emit(call, port, node->in);
}

/*pcg
/// Sends each entity one of two ways.
///
/// The test is evaluated for every entity, before its round; it usually reads an attribute.
procedure condition<T: Entity>(in: T) -> (yes: T, no: T) [pure] {
    category "flow"
    synonyms "if", "branch", "filter", "test", "where"
    param test: bool /// Where it holds, the entity leaves through `yes`.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 5, index => @n)
        -> c: condition(@n < 2) expect c.yes.count = 2, c.no.count = 3
    example rectangle(width = 2m, height = 3m)
        -> c: condition(test = area(in) > 5m2) expect c.yes.area = 6
}
*/
#include "condition.h"

int pcg_core_condition(pcg_call *call, struct pcg_core_condition *node)
{
    return pcg_emit(call, node->test ? node->yes : node->no, node->in);
}

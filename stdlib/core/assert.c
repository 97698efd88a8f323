/*pcg
/// Ends the run where something does not hold.
///
/// The test is evaluated for every entity that passes. With `fatal = false` it is a warning, and the
/// entity passes all the same.
procedure assert<T: Entity>(in: T) -> (out: T) [effect, one_to_one] {
    category "debug"
    synonyms "check", "require", "ensure", "expect", "test", "verify"
    param test: bool           /// What must hold.
    param message: string = "" /// What is said where it does not.
    param fatal: bool = true   /// The run ends; else it goes on.
    example rectangle(width = 2m, height = 3m) -> assert(area(in) == 6m2) expect count = 1
}
*/
#include "assert.h"

int pcg_core_assert(pcg_call *call, struct pcg_core_assert *node)
{
    const char *message = node->message[0] ? node->message : "what is asserted does not hold";
    if (!node->test && node->fatal) {
        return pcg_fail(call, "%s", message);
    }
    if (!node->test) {
        PCG_TRY(pcg_warn(call, "%s", message));
    }
    return pcg_emit(call, node->out, node->in);
}

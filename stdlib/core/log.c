/*pcg
/// Prints a message for every entity that passes.
///
/// The message is a string, so any expression will do: `log(message = @floor)`,
/// `log(message = format("{} m2", area(in)))`. Without one, the entity's type is printed.
procedure log<T: Entity>(in: T) -> (out: T) [effect, one_to_one] {
    category "debug"
    synonyms "print", "trace", "message", "echo", "show"
    param message: string = "" /// What is printed.
    example rectangle(width = 2m, height = 3m) -> log(message = "a lot") expect count = 1
}
*/
#include "log.h"

int pcg_core_log(pcg_call *call, struct pcg_core_log *node)
{
    const char *message = node->message[0] ? node->message : node->in->type->name;
    pcg_note(call, "%s", message);
    return pcg_emit(call, node->out, node->in);
}

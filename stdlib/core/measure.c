/*pcg
/// Says how much has come: how many entities of which types, and how long it took if asked.
///
/// Takes all that wait at once and sends them on in their order. The time is not part of any result.
procedure measure<T: Entity>(in: T[]) -> (out: T) [effect] {
    category "debug"
    synonyms "count", "time", "profile", "statistics", "stopwatch", "how many"
    param label: string = ""  /// What the message begins with.
    param time: bool = false  /// Also how many milliseconds have passed since the run began.
    attr total: int           /// Written: how many entities there are.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 3)
        -> measure(label = "lots", total => @all)
        -> c: condition(@all == 3) expect c.yes.count = 3
}
*/
#include "measure.h"
#include "core.h"
#include "runtime/run.h"

enum { MEASURE_TYPES = 16 };

/* How many entities there are of each of the first types that appear, as "2 Shape, 1 Impulse". */
static void measure_types(const pcg_entities *in, core_buffer *b)
{
    const pcg_type *types[MEASURE_TYPES];
    pcg_u32 counts[MEASURE_TYPES] = {0}, found = 0;
    for (pcg_u32 i = 0; i < in->count; i++) {
        pcg_u32 k = 0;
        while (k < found && types[k] != in->at[i]->type) {
            k++;
        }
        if (k == found && found < MEASURE_TYPES) {
            types[found++] = in->at[i]->type;
        }
        if (k < found) {
            counts[k]++;
        }
    }
    for (pcg_u32 k = 0; k < found; k++) {
        core_add(b, k ? ", " : "");
        core_add_number(b, counts[k]);
        core_add(b, " ");
        core_add(b, types[k]->name);
    }
}

static void measure_tell(pcg_call *call, const struct pcg_core_measure *node)
{
    core_buffer b = {.run = call->run};
    core_add(&b, node->label);
    core_add(&b, node->label[0] ? ": " : "");
    measure_types(&node->in, &b);
    if (node->time) {
        core_add(&b, ", ");
        core_add_number(&b, (double)((run_clock() - call->run->started) / 1000000));
        core_add(&b, " ms after the beginning");
    }
    pcg_note(call, "%s", core_finish(&b));
}

int pcg_core_measure(pcg_call *call, struct pcg_core_measure *node)
{
    measure_tell(call, node);
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        pcg_set_int(call->run, node->in.at[i], &node->total, node->in.count);
        PCG_TRY(pcg_emit(call, node->out, node->in.at[i]));
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

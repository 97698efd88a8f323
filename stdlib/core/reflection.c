/* reflection.c - parameters of the graph that a node stands in, by name. */
#include "reflection.h"
#include <string.h>
#include "core.h"

const pcg_parameter_info *core_parameter(pcg_call *call, const char *name)
{
    const pcg_graph_info *about = call->frame->about;
    core_buffer b = {.run = call->run};
    for (pcg_u32 i = 0; i < about->parameter_count; i++) {
        if (strcmp(about->parameters[i].name, name) == 0) {
            return &about->parameters[i];
        }
        core_add(&b, i ? ", " : "its parameters: ");
        core_add(&b, about->parameters[i].name);
    }
    const char *all = core_finish(&b);
    pcg_fail(call, "graph '%s' has no parameter '%s' (%s)", about->name, name,
             all[0] ? all : "it has none");
    return 0;
}

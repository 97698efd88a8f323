/* reflection.h - parameters of the graph that a node stands in, by name. */
#ifndef PCG_CORE_REFLECTION_H
#define PCG_CORE_REFLECTION_H

#include "runtime/abi.h"
#include "runtime/value.h"

/* NULL where the graph has no such parameter: the run has failed then, with a message that lists
 * those that there are. */
const pcg_parameter_info *core_parameter(pcg_call *call, const char *name);

static inline pcg_cell *core_parameter_cells(const pcg_call *call, const pcg_parameter_info *p)
{
    return (pcg_cell *)(void *)((char *)call->frame + p->offset);
}

static inline value_type core_parameter_type(const pcg_parameter_info *p)
{
    return (value_type){.kind = p->kind, .element = p->element, .enumerators = p->enumerators};
}

#endif

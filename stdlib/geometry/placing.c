/* placing.c - moving what has a place: a shape by its scope alone, a part with its places. */
#include "placing.h"

int placing_open(pcg_call *call, pcg_entity *e, placing *p)
{
    pcg_part *part = (pcg_part *)e;

    *p = (placing){.entity = e};
    if (part_is(e) && part_shape(part) == NULL) {
        p->lost = true;
        return part_warn_lost(call, part);
    }
    if (part_is(e)) {
        part_scope(part, &p->scope);
    } else {
        parts_settle(call->run); /* its parts may have gone by this node in the same run of it */
        p->scope = ((pcg_shape *)e)->scope;
    }
    p->before = p->scope;
    return PCG_OK;
}

int placing_close(pcg_call *call, placing *p, pcg_vec3 by)
{
    if (p->lost)
        return PCG_OK;
    if (part_is(p->entity))
        return part_move(call->run, (pcg_part *)p->entity, &p->before, &p->scope, by);
    ((pcg_shape *)p->entity)->scope = p->scope;
    return PCG_OK;
}

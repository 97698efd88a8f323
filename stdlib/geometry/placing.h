/* placing.h - moving what has a place: a shape by its scope alone, a part with its places. */
#ifndef PCG_GEOMETRY_PLACING_H
#define PCG_GEOMETRY_PLACING_H

#include "runtime/part.h"

typedef struct placing {
    pcg_entity *entity;
    pcg_scope scope; /* to be changed */
    pcg_scope before;
    bool lost; /* a part of no shape: what is done to the scope has no effect */
} placing;

/* Begins with the scope of a shape, or the one that a part has by itself. A part of no shape is
 * warned of. Status. */
int placing_open(pcg_call *call, pcg_entity *e, placing *p);
/* Brings the entity to where the scope is now. Of a part, `by` are factors along the axes of the
 * scope; of a shape they are for the caller to heed. Status. */
int placing_close(pcg_call *call, placing *p, pcg_vec3 by);

#endif

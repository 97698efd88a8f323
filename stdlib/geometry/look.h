/* look.h - changing materials, for the procedures that do. */
#ifndef PCG_GEOMETRY_LOOK_H
#define PCG_GEOMETRY_LOOK_H

#include "runtime/shape.h"

/* What becomes of a material. The strings in the result need not be interned. */
typedef pcg_material look_function(const pcg_material *from, const void *context);

/* Puts the material of a shape, and those that its faces have of their own, through `f`; or that of
 * one face, which has one of its own from then on. A part of no shape is warned of. Status. */
int look_change(pcg_call *call, pcg_entity *e, look_function *f, const void *context);

/* How often an image is repeated along one metre of an extent of `size` metres: `given` is how
 * many metres one covers (absolute), or how often it is repeated over the extent. */
double look_density(double given, int absolute, double size);
/* Whether `given` can be used like that. */
bool look_is_size(double given, int absolute);

#endif

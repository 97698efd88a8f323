/* constraint.h - what a graph demands of its parameters' values: range, one of, matches, at
 * most. */
#ifndef PCG_CONSTRAINT_H
#define PCG_CONSTRAINT_H

#include "value.h"

/* True where the value at `at` meets the constraint; otherwise `why` (VALUE_WHY_BYTES) says what is
 * demanded: "must be from 3m to 60m, not 2m". */
bool constraint_holds(pcg_run *r, const pcg_constraint_info *c, const value_type *t,
                      const pcg_cell *at, char *why);

#endif

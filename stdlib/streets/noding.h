/* noding.h - a drawing whose edges meet at their vertices only. */
#ifndef PCG_STREETS_NODING_H
#define PCG_STREETS_NODING_H

#include "streets.h"

/* Joins vertices that are nearer than `tolerance` (at least a micrometre), cuts edges of one level
 * where they cross or come that near to a vertex, and leaves out edges without length and all but
 * the widest of several between the same vertices. Levels are joined only in vertices, where a way
 * of one of them ends. NULL: memory has run out, or the call was cancelled, *status says. The
 * caller has the one reference. */
street_drawing *drawing_node(pcg_call *call, const street_drawing *d, double tolerance,
                             int *status);

#endif

/* orientation.h - on which side of a line a point is: the one predicate that plane geometry here
 * stands on. */
#ifndef PCG_ORIENTATION_H
#define PCG_ORIENTATION_H

#include "runtime/abi.h"

/* Twice the signed area of the triangle a b c: positive when it is counter-clockwise. The sign is
 * exact, whatever the coordinates, short of overflow; the amount is rounded. Method: J. R.
 * Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997
 * (its first stage, then all exactly). */
double orientation(pcg_vec2 a, pcg_vec2 b, pcg_vec2 c);
double orientation_exactly(pcg_vec2 a, pcg_vec2 b, pcg_vec2 c);

#endif

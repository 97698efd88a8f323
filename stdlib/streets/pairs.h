/* pairs.h - which boxes of many overlap. */
#ifndef PCG_STREETS_PAIRS_H
#define PCG_STREETS_PAIRS_H

#include "streets.h"

typedef struct pair_box {
    pcg_vec2 low, high; /* finite, low <= high */
} pair_box;

/* Is told of two boxes that overlap or touch; `a` is not the larger one by more than a class of
 * sizes. Status. */
typedef int pair_function(void *context, uint32_t a, uint32_t b);

/* Tells `meet` of each pair of boxes that overlap, once, in an order that depends on the boxes
 * alone. A box lies in the cells of a grid that is about as coarse as it is large, so that it is in
 * four at most; it is compared with those in its own cells, and in the cells of coarser grids that
 * it reaches. Status. */
int pairs_find(pcg_call *call, const pair_box *box, uint32_t count, pair_function *meet,
               void *context);

#endif

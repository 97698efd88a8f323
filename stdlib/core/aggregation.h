/* aggregation.h - one value out of an attribute of many entities. */
#ifndef PCG_CORE_AGGREGATION_H
#define PCG_CORE_AGGREGATION_H

#include "runtime/abi.h"

typedef enum core_aggregation {
    CORE_MIN,
    CORE_MAX,
    CORE_AVERAGE,
    CORE_SUM,
    CORE_MEDIAN,
    CORE_COUNT,
    CORE_FIRST,
    CORE_LAST
} core_aggregation;

/* What is to be computed: out of `of`, in order to be written to `to`. CORE_COUNT reads nothing. */
typedef struct core_aggregate {
    core_aggregation how;
    const char *name; /* of the augmentation, for messages */
    pcg_slot of, to;
} core_aggregate;

/* Ends the run, with a message, where the attributes' types do not fit: all but first, last and
 * count work on numbers, vectors (by component) and colours; what they give is of the same type,
 * or a plain number. An int may be written to a float, an average and a median of ints are
 * floats unless they are written to an int, which cuts them down. Status. */
int core_aggregate_check(pcg_call *call, const core_aggregate *a);
/* Computes it for that many entities; at most 4 cells of `result` are filled, for a->to. What is
 * no number is left out; where nothing remains the result is no number, for ints 0. Status. */
int core_aggregate_compute(pcg_call *call, const core_aggregate *a, pcg_entity *const *at,
                           pcg_u32 count, pcg_cell *result);

#endif

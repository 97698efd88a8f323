/* by.h - lists taken apart by what is equal in their entities' attributes. */
#ifndef PCG_CORE_BY_H
#define PCG_CORE_BY_H

#include "runtime/abi.h"

/* The entities of a list, put together by groups; groups are in the order in which they begin,
 * and keep the order of the list within. */
typedef struct core_by {
    pcg_entity **at; /* borrowed as those of the list are */
    pcg_u32 *ends;   /* of each group, the end of its part of `at` */
    pcg_u32 *group;  /* of each entity of the list as it was */
    pcg_u32 count;   /* groups */
    pcg_u32 entities;
} core_by;

/* Groups by keys; without one the list is one group. Status; where it fails there is nothing to
 * close. */
int core_by_open(pcg_call *call, const pcg_entities *in, const pcg_slot *const *keys,
                 pcg_u32 key_count, core_by *by);
void core_by_close(pcg_run *r, core_by *by);

static inline pcg_u32 core_by_begin(const core_by *by, pcg_u32 group)
{
    return group ? by->ends[group - 1] : 0;
}

#endif

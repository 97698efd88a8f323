/* grouping.h - entities grouped by the values of their attributes: what every procedure with
 * `by` stands on. By hashing, in time that grows with the number of entities.
 */
#ifndef PCG_GROUPING_H
#define PCG_GROUPING_H

#include "abi.h"

/* Which group each entity of a list is in. Groups are numbered in the order in which their first
 * entities appear. */
typedef struct grouping {
    pcg_u32 *group; /* of each entity */
    pcg_u32 *first; /* of each group, the index of the entity that began it */
    pcg_u32 *size;  /* of each group, how many are in it */
    pcg_u32 count;  /* groups */
    pcg_u32 entities;
} grouping;

/* Groups what is equal in all `keys`; without a key all are one group. Values are equal as in
 * the language, lists element by element; but what is no number is one value, so that there is a
 * group of it. PCG_FAILED when memory has run out, or the status of a run that is to stop; then
 * there is nothing to close. */
int grouping_open(pcg_call *call, const pcg_entities *in, const pcg_slot *const *keys,
                  pcg_u32 key_count, grouping *g);
void grouping_close(pcg_run *r, grouping *g);

/* A hash of a value that is the same for equal ones, as grouping means it. */
pcg_u64 grouping_hash(pcg_u64 hash, int kind, int element, const pcg_cell *at);

#endif

/* list.h - growing arrays in memory of the run. */
#ifndef PCG_LIST_H
#define PCG_LIST_H

#include "runtime/memory.h"

/* Makes room for `more` items behind `count` in an array that starts as NULL with capacity 0;
 * run_free takes it back with capacity * size. Status. */
int list_grow(pcg_run *r, void **at, pcg_u32 *capacity, pcg_u32 count, pcg_u32 more, size_t size);

static inline int list_room(pcg_run *r, void **at, pcg_u32 *capacity, pcg_u32 count, pcg_u32 more,
                            size_t size)
{
    return more <= *capacity - count ? PCG_OK : list_grow(r, at, capacity, count, more, size);
}

#endif

/* list.c - growing arrays in memory of the run. */
#include "runtime/list.h"

int list_grow(pcg_run *r, void **at, pcg_u32 *capacity, pcg_u32 count, pcg_u32 more, size_t size)
{
    pcg_u64 needed = (pcg_u64)count + more, next = (pcg_u64)*capacity * 2;
    void *moved;

    next = next < needed ? needed : next;
    next = next < 16 ? 16 : next;
    if (next >= 0xffffffffu)
        next = SIZE_MAX / size; /* fails, and the run knows why */
    moved = run_resize(r, *at, *capacity * size, (size_t)next * size);
    if (moved == NULL)
        return PCG_FAILED;
    *at = moved;
    *capacity = (pcg_u32)next;
    return PCG_OK;
}

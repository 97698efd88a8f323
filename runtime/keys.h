/* keys.h - strings numbered in the order in which they were first met; in memory of the run. */
#ifndef PCG_KEYS_H
#define PCG_KEYS_H

#include "abi.h"

#define KEYS_NONE 0xFFFFFFFFu

typedef struct run_keys { /* starts zeroed */
    const char **at;      /* by number */
    pcg_u32 count, capacity;
    pcg_u32 *slots;     /* open addressing: number + 1; 0 is empty */
    pcg_u32 slot_count; /* 0, or a power of two */
} run_keys;

/* The number of a key, which is added where it is new: then it is the old count. KEYS_NONE when
 * memory has run out. */
pcg_u32 keys_number(pcg_run *r, run_keys *k, const char *key);
/* KEYS_NONE where it is not there. */
pcg_u32 keys_find(const run_keys *k, const char *key);
void keys_close(pcg_run *r, run_keys *k);

#endif

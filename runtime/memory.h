/* memory.h - memory of a run: size classes over big chunks.
 *
 * Entities, attributes, mesh arrays, queues and strings come from here; nothing per entity goes to
 * malloc. A block that is given back waits on its class's list for the next of its size, so what is
 * in use stays warm. Everything is counted against the run's memory limit and goes with the run:
 * giving a block back is a matter of reuse, not of leaks. A run's memory belongs to the run's
 * thread.
 *
 * Where memory or its limit has run out, the functions return NULL and the run knows why: the
 * caller undoes what it had begun and returns PCG_FAILED; it need not report anything.
 */
#ifndef PCG_MEMORY_H
#define PCG_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#include "abi.h"

enum {
    MEMORY_CLASSES = 16 + 4 * 10, /* 16 … 256 by 16, then four a doubling up to MEMORY_CLASS_MAX */
    MEMORY_CLASS_MAX = 256 << 10, /* larger blocks are the system's, one by one */
    MEMORY_CHUNK_MIN = 64 << 10,  /* chunks begin so small and double … */
    MEMORY_CHUNK_MAX = 8 << 20,   /* … up to this */
    MEMORY_HEAD_MAX = 64          /* bytes that a block or chunk may take besides */
};

/* What a run holds of it: the first member of struct pcg_run. */
typedef struct run_memory {
    void *free[MEMORY_CLASSES]; /* blocks given back, by class; linked by their first word */
    char *at, *end;                    /* what is left of the newest chunk */
    struct memory_chunk *chunks;
    struct memory_large *large;
    size_t used;                       /* bytes taken from the system */
    size_t limit;                      /* that may be taken */
    size_t next_chunk;
} run_memory;

/* A block of at least `size` bytes, 16-aligned, not cleared. `size` 0 counts as 1. */
void *run_alloc(pcg_run *r, size_t size);
/* The same, cleared. */
void *run_alloc_zeroed(pcg_run *r, size_t size);
/* A cleared array; an overflow of the product is memory that has run out. */
void *run_alloc_array(pcg_run *r, size_t count, size_t size);
/* Gives a block back; `size` is what was asked for (or its run_capacity). NULL is allowed. */
void run_free(pcg_run *r, void *block, size_t size);
/* Moves a block to a new size, keeping the first min(old, size) bytes; `block` NULL with `old` 0
 * allocates. When it fails the old block stays as it was. */
void *run_resize(pcg_run *r, void *block, size_t old, size_t size);
/* How many bytes a block of `size` really has: arrays that grow use them all, and may pass either
 * to run_free. */
size_t run_capacity(size_t size);

/* For pcg_run_new and pcg_run_free. */
void memory_open(run_memory *m, size_t limit);
void memory_close(run_memory *m);
/* As run_alloc, but reports nothing: for what is made before there is a run, or while it
 * reports. */
void *memory_take(run_memory *m, size_t size);

#endif

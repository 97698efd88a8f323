/* memory.c - memory of a run: size classes over big chunks. */
#include "memory.h"

#include <stdlib.h>
#include <string.h>

#include "run.h"

/* What waits on a free list is out of bounds for everybody but this file: a use of a block that was
 * given back is found by the sanitizer as it would be with malloc. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEMORY_POISONED 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define MEMORY_POISONED 1
#endif
#ifdef MEMORY_POISONED
#include <sanitizer/asan_interface.h>
#define HIDE(at, size) __asan_poison_memory_region((at), (size))
#define SHOW(at, size) __asan_unpoison_memory_region((at), (size))
#else
#define HIDE(at, size) ((void)0)
#define SHOW(at, size) ((void)0)
#endif

enum { GRAIN = 16, SMALL = 256, SMALL_CLASSES = SMALL / GRAIN };

/* Both headers keep what follows them 16-aligned. */
typedef struct memory_chunk {
    struct memory_chunk *next;
    size_t size;
} memory_chunk;

typedef struct memory_large {
    struct memory_large *previous, *next;
    size_t size; /* with this header */
    size_t unused;
} memory_large;

_Static_assert(sizeof(memory_chunk) % GRAIN == 0, "a chunk's first block is aligned");
_Static_assert(sizeof(memory_large) % GRAIN == 0, "a large block is aligned");

/* ---- size classes --------------------------------------------------------------------------- */

/* Sizes from 1 to MEMORY_CLASS_MAX. Above SMALL, the two bits behind the leading one tell the four
 * classes of a doubling apart. */
static size_t class_of(size_t size)
{
    size_t last = size - 1;
    if (size <= SMALL)
        return last / GRAIN;
    unsigned top = 63u - (unsigned)__builtin_clzll(last);
    return SMALL_CLASSES + (top - 8u) * 4u + ((last >> (top - 2u)) & 3u);
}

static size_t class_size(size_t class)
{
    if (class < SMALL_CLASSES)
        return (class + 1) * GRAIN;
    size_t quarter = (class - SMALL_CLASSES) % 4, shift = (class - SMALL_CLASSES) / 4 + 6;
    return (5 + quarter) << shift;
}

size_t run_capacity(size_t size)
{
    if (size == 0)
        size = 1;
    return size <= MEMORY_CLASS_MAX ? class_size(class_of(size)) : size;
}

static void push_free(run_memory *m, void *block, size_t class)
{
    *(void **)block = m->free[class];
    m->free[class] = block;
    HIDE(block, class_size(class));
}

/* ---- chunks --------------------------------------------------------------------------------- */

/* What is left of a chunk that is too short for the next block is not lost: it goes to the free
 * lists. */
static void chop_rest(run_memory *m)
{
    size_t left = (size_t)(m->end - m->at);
    while (left >= GRAIN) {
        size_t class = class_of(left < MEMORY_CLASS_MAX ? left : MEMORY_CLASS_MAX);
        if (class_size(class) > left)
            class--;
        SHOW(m->at, class_size(class));
        push_free(m, m->at, class);
        m->at += class_size(class);
        left = (size_t)(m->end - m->at);
    }
}

/* The size of the next chunk: as planned, or what is needed where that is more, but no more than
 * the limit leaves; 0 where that is too little. */
static size_t chunk_size(const run_memory *m, size_t need)
{
    size_t room = (m->limit - m->used) & ~(size_t)(GRAIN - 1);
    size_t least = need + sizeof(memory_chunk);
    size_t size = m->next_chunk > least ? m->next_chunk : least;
    if (size > room)
        size = room;
    return size >= least ? size : 0;
}

static int add_chunk(run_memory *m, size_t need)
{
    size_t size = chunk_size(m, need);
    memory_chunk *chunk = size ? malloc(size) : NULL;
    if (!chunk)
        return 0;
    chop_rest(m);
    chunk->next = m->chunks;
    chunk->size = size;
    m->chunks = chunk;
    m->used += size;
    m->at = (char *)(chunk + 1);
    m->end = (char *)chunk + size;
    HIDE(m->at, size - sizeof *chunk);
    if (m->next_chunk < MEMORY_CHUNK_MAX)
        m->next_chunk *= 2;
    return 1;
}

/* ---- large blocks --------------------------------------------------------------------------- */

static void link_large(run_memory *m, memory_large *l)
{
    l->previous = NULL;
    l->next = m->large;
    if (m->large)
        m->large->previous = l;
    m->large = l;
}

static void unlink_large(run_memory *m, memory_large *l)
{
    if (l->previous)
        l->previous->next = l->next;
    else
        m->large = l->next;
    if (l->next)
        l->next->previous = l->previous;
}

static void *take_large(run_memory *m, size_t size)
{
    if (size > SIZE_MAX / 2 || size + sizeof(memory_large) > m->limit - m->used)
        return NULL;
    memory_large *l = malloc(size + sizeof *l);
    if (!l)
        return NULL;
    l->size = size + sizeof *l;
    m->used += l->size;
    link_large(m, l);
    return l + 1;
}

static void free_large(run_memory *m, void *block)
{
    memory_large *l = (memory_large *)block - 1;
    m->used -= l->size;
    unlink_large(m, l);
    free(l);
}

/* The system can often make a large block longer without copying it. NULL: it stayed as it was. */
static void *resize_large(run_memory *m, void *block, size_t size)
{
    memory_large *l = (memory_large *)block - 1, *moved;
    size_t old = l->size, total = size + sizeof *l;
    if (size > SIZE_MAX / 2 || (total > old && total - old > m->limit - m->used))
        return NULL;
    unlink_large(m, l);
    moved = realloc(l, total);
    if (moved) {
        m->used = m->used - old + total;
        moved->size = total;
        l = moved;
    }
    link_large(m, l);
    return moved ? moved + 1 : NULL;
}

/* ---- blocks --------------------------------------------------------------------------------- */

void memory_open(run_memory *m, size_t limit)
{
    memset(m, 0, sizeof *m);
    m->limit = limit;
    m->next_chunk = MEMORY_CHUNK_MIN;
}

void memory_close(run_memory *m)
{
    while (m->large)
        free_large(m, m->large + 1);
    for (memory_chunk *chunk = m->chunks, *next; chunk; chunk = next) {
        next = chunk->next;
        SHOW(chunk, chunk->size);
        free(chunk);
    }
    memset(m, 0, sizeof *m);
}

void *memory_take(run_memory *m, size_t size)
{
    if (size == 0)
        size = 1;
    if (size > MEMORY_CLASS_MAX)
        return take_large(m, size);
    size_t class = class_of(size);
    size_t whole = class_size(class);
    void *block = m->free[class];
    if (block) {
        SHOW(block, whole);
        m->free[class] = *(void **)block;
        return block;
    }
    if ((size_t)(m->end - m->at) < whole && !add_chunk(m, whole))
        return NULL;
    block = m->at;
    m->at += whole;
    SHOW(block, whole);
    return block;
}

void *run_alloc(pcg_run *r, size_t size)
{
    void *block = memory_take(&r->memory, size);
    if (!block)
        run_out_of_memory(r, size);
    return block;
}

void *run_alloc_zeroed(pcg_run *r, size_t size)
{
    void *block = run_alloc(r, size);
    return block ? memset(block, 0, size) : NULL;
}

void *run_alloc_array(pcg_run *r, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size) {
        run_out_of_memory(r, SIZE_MAX);
        return NULL;
    }
    return run_alloc_zeroed(r, count * size);
}

void run_free(pcg_run *r, void *block, size_t size)
{
    if (!block)
        return;
    if (size > MEMORY_CLASS_MAX)
        free_large(&r->memory, block);
    else
        push_free(&r->memory, block, class_of(size ? size : 1));
}

void *run_resize(pcg_run *r, void *block, size_t old, size_t size)
{
    if (block && run_capacity(old) == run_capacity(size))
        return block;
    if (block && old > MEMORY_CLASS_MAX && size > MEMORY_CLASS_MAX) {
        void *moved = resize_large(&r->memory, block, size);
        if (!moved)
            run_out_of_memory(r, size);
        return moved;
    }
    void *moved = run_alloc(r, size);
    if (!moved || !block)
        return moved;
    memcpy(moved, block, old < size ? old : size);
    run_free(r, block, old);
    return moved;
}

/* pointers.c - numbers for pointers: which materials there are, in the order in which they were
 * met. */
#include "stdlib/io/io.h"

enum { FIRST_SLOTS = 64 };

static uint64_t hash(const void *p)
{
    uint64_t h = (uintptr_t)p * (uint64_t)0x9e3779b97f4a7c15u;
    return h ^ h >> 32;
}

/* The slot that holds the pointer, or the empty one where it belongs. A slot holds a number plus
 * 1. */
static uint32_t *find_slot(const io_pointers *t, const void *p)
{
    uint32_t mask = t->slot_count - 1;
    uint64_t at = hash(p);
    while (t->slots[at & mask] && t->at[t->slots[at & mask] - 1] != p)
        at++;
    return &t->slots[at & mask];
}

/* The table of slots is at most half full. */
static void grow(arena *a, io_pointers *t)
{
    uint32_t capacity = t->slot_count; /* of the list, too: half would do */
    t->slot_count = capacity ? capacity * 2 : FIRST_SLOTS;
    t->at = arena_resize(a, t->at, capacity * sizeof *t->at, t->slot_count * sizeof *t->at);
    t->slots = ARENA_ARRAY(a, uint32_t, t->slot_count);
    for (uint32_t i = 0; i < t->count; i++)
        *find_slot(t, t->at[i]) = i + 1;
}

uint32_t io_pointer_number(arena *a, io_pointers *t, const void *p)
{
    if (t->count && t->at[t->last] == p)
        return t->last;
    if (2 * (t->count + 1) > t->slot_count)
        grow(a, t);
    uint32_t *slot = find_slot(t, p);
    if (!*slot) {
        t->at[t->count++] = p;
        *slot = t->count;
    }
    return t->last = *slot - 1;
}

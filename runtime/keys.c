/* keys.c - strings numbered in the order in which they were first met. */
#include "keys.h"

#include <string.h>

#include "grouping.h"
#include "list.h"

enum { SLOTS_FIRST = 16 };

/* Where the key stands, or would. */
static pcg_u32 *slot_of(const run_keys *k, const char *key)
{
    const pcg_cell cell = {.s = key};
    pcg_u32 mask = k->slot_count - 1;
    pcg_u32 at = (pcg_u32)grouping_hash(0, PCG_STRING, 0, &cell) & mask;
    while (k->slots[at] && strcmp(k->at[k->slots[at] - 1], key) != 0)
        at = (at + 1) & mask;
    return &k->slots[at];
}

static int grow(pcg_run *r, run_keys *k)
{
    run_keys old = *k;
    pcg_u32 slot_count = old.slot_count ? old.slot_count * 2 : SLOTS_FIRST;
    pcg_u32 *slots = run_alloc_array(r, slot_count, sizeof *slots);
    if (!slots)
        return PCG_FAILED;
    k->slots = slots;
    k->slot_count = slot_count;
    for (pcg_u32 i = 0; i < k->count; i++)
        *slot_of(k, k->at[i]) = i + 1;
    run_free(r, old.slots, old.slot_count * sizeof *old.slots);
    return PCG_OK;
}

pcg_u32 keys_find(const run_keys *k, const char *key)
{
    pcg_u32 number = k->count ? *slot_of(k, key) : 0;
    return number ? number - 1 : KEYS_NONE;
}

pcg_u32 keys_number(pcg_run *r, run_keys *k, const char *key)
{
    pcg_u32 found = keys_find(k, key);
    if (found != KEYS_NONE)
        return found;
    if (k->count >= k->slot_count / 4 * 3 && grow(r, k) != PCG_OK)
        return KEYS_NONE;
    if (list_room(r, (void **)&k->at, &k->capacity, k->count, 1, sizeof *k->at) != PCG_OK)
        return KEYS_NONE;
    k->at[k->count] = pcg_string(r, key);
    *slot_of(k, k->at[k->count]) = k->count + 1;
    return k->count++;
}

void keys_close(pcg_run *r, run_keys *k)
{
    run_free(r, k->at, k->capacity * sizeof *k->at);
    run_free(r, k->slots, k->slot_count * sizeof *k->slots);
    *k = (run_keys){0};
}

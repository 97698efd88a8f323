/* table.c - from names to pointers. */
#include "base.h"

#include <string.h>

enum { FIRST_SLOTS = 16 };

/* FNV-1a, its high bits folded in since the slots are chosen by the low ones. */
static uint32_t hash(const char *key)
{
    uint64_t h = 14695981039346656037u;
    for (; *key; key++)
        h = (h ^ (unsigned char)*key) * 1099511628211u;
    return (uint32_t)(h ^ (h >> 32));
}

/* The slot that holds the key, or the empty one where it belongs. A slot holds an entry's number +
 * 1, 0 when empty; there is always an empty one. */
static uint32_t find(const table *t, const char *key)
{
    uint32_t mask = t->slot_count - 1;
    uint32_t i = hash(key) & mask;
    while (t->slots[i] && strcmp(t->entries.at[t->slots[i] - 1].key, key) != 0)
        i = (i + 1) & mask;
    return i;
}

static void grow(arena *a, table *t)
{
    uint32_t count = t->slot_count ? t->slot_count * 2 : FIRST_SLOTS;
    t->slots = ARENA_ARRAY(a, uint32_t, count);
    t->slot_count = count;
    for (uint32_t i = 0; i < t->entries.count; i++)
        t->slots[find(t, t->entries.at[i].key)] = i + 1;
}

void *table_get(const table *t, const char *key)
{
    if (!t->slot_count)
        return NULL;
    uint32_t slot = t->slots[find(t, key)];
    return slot ? t->entries.at[slot - 1].value : NULL;
}

void table_put(arena *a, table *t, const char *key, void *value)
{
    if (t->entries.count * 2 >= t->slot_count)
        grow(a, t);
    uint32_t i = find(t, key);
    if (t->slots[i]) {
        t->entries.at[t->slots[i] - 1].value = value;
        return;
    }
    table_entry entry = {key, value};
    LIST_ADD(a, &t->entries, entry);
    t->slots[i] = t->entries.count;
}

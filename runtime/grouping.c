/* grouping.c - entities grouped by the values of their attributes. */
#include <string.h>

#include "grouping.h"
#include "memory.h"
#include "value.h"

typedef struct grouper {
    const pcg_entities *in;
    const pcg_slot *const *keys;
    pcg_u32 key_count;
    struct grouper_slot {
        pcg_u64 hash;
        pcg_u32 group;
    } * slots;       /* group + 1; 0 is empty */
    size_t capacity; /* a power of two above the number of entities */
} grouper;

/* ---- values ---------------------------------------------------------------------------------- */

static pcg_u64 hash_text(pcg_u64 hash, const char *s)
{
    size_t length = strlen(s);
    pcg_u64 word;
    for (; length >= sizeof word; length -= sizeof word, s += sizeof word) {
        memcpy(&word, s, sizeof word);
        hash = pcg_mix(hash, word);
    }
    word = 0;
    memcpy(&word, s, length);
    return pcg_mix(hash, word ^ (pcg_u64)length << 56);
}

/* -0 equals 0, and whatever is no number is one value. */
static pcg_u64 hash_float(pcg_u64 hash, double value)
{
    pcg_u64 bits = 0;
    double plus = value + 0.0;
    if (plus == plus)
        memcpy(&bits, &plus, sizeof bits);
    else
        bits = ~bits;
    return pcg_mix(hash, bits);
}

pcg_u64 grouping_hash(pcg_u64 hash, int kind, int element, const pcg_cell *at)
{
    if (kind == PCG_STRING || kind == PCG_PATH)
        return hash_text(hash, at->s);
    if (kind == PCG_LIST) {
        const pcg_list *list = at->list;
        hash = pcg_mix(hash, list->count);
        for (pcg_u32 i = 0; i < list->count; i++)
            hash = grouping_hash(hash, element, PCG_INT, list->at + (size_t)i * list->width);
        return hash;
    }
    if (!value_has_floats(kind))
        return pcg_mix(hash, (pcg_u64)at->i);
    for (pcg_u32 i = 0; i < value_width(kind); i++)
        hash = hash_float(hash, at[i].f);
    return hash;
}

static pcg_u64 hash_keys(const grouper *m, const pcg_entity *e)
{
    pcg_u64 hash = 0;
    for (pcg_u32 i = 0; i < m->key_count; i++) {
        const pcg_slot *key = m->keys[i];
        hash = grouping_hash(hash, key->kind, key->element, pcg_get(e, key));
    }
    return hash;
}

static bool same_keys(const grouper *m, const pcg_entity *a, const pcg_entity *b)
{
    for (pcg_u32 i = 0; i < m->key_count; i++) {
        const pcg_slot *key = m->keys[i];
        const value_type t = {.kind = key->kind, .element = key->element};
        if (!value_equal(&t, pcg_get(a, key), pcg_get(b, key)))
            return false;
    }
    return true;
}

/* ---- groups ---------------------------------------------------------------------------------- */

static pcg_u32 group_of(grouper *m, grouping *g, pcg_u32 i)
{
    const pcg_entity *e = m->in->at[i];
    pcg_u64 hash = hash_keys(m, e);
    size_t at = hash & (m->capacity - 1);
    for (; m->slots[at].group; at = (at + 1) & (m->capacity - 1)) {
        pcg_u32 group = m->slots[at].group - 1;
        if (m->slots[at].hash == hash && same_keys(m, m->in->at[g->first[group]], e))
            return group;
    }
    g->first[g->count++] = i;
    m->slots[at].hash = hash;
    m->slots[at].group = g->count;
    return g->count - 1;
}

static int assign(pcg_call *call, grouper *m, grouping *g)
{
    for (pcg_u32 i = 0; i < m->in->count; i++) {
        g->group[i] = group_of(m, g, i);
        g->size[g->group[i]]++;
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

static size_t power_of_two_above(size_t n)
{
    size_t power = 8;
    while (power < n)
        power *= 2;
    return power;
}

int grouping_open(pcg_call *call, const pcg_entities *in, const pcg_slot *const *keys,
                  pcg_u32 key_count, grouping *g)
{
    pcg_run *r = call->run;
    grouper m = {in, keys, key_count, NULL, power_of_two_above(in->count + (size_t)in->count / 2)};
    *g = (grouping){.entities = in->count};
    m.slots = run_alloc_array(r, m.capacity, sizeof *m.slots);
    g->group = run_alloc_array(r, 3 * (size_t)in->count, sizeof *g->group);
    int status = PCG_FAILED;
    if (m.slots && g->group) {
        g->first = g->group + in->count;
        g->size = g->first + in->count;
        status = assign(call, &m, g);
    }
    run_free(r, m.slots, m.capacity * sizeof *m.slots);
    if (status != PCG_OK)
        grouping_close(r, g);
    return status;
}

void grouping_close(pcg_run *r, grouping *g)
{
    run_free(r, g->group, 3 * (size_t)g->entities * sizeof *g->group);
    *g = (grouping){0};
}

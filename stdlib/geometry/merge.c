/*pcg
/// Puts all shapes into one, as they stand in the world.
///
/// Nothing is welded or cut: the faces keep their vertices, materials and texture coordinates. With
/// `by` there is one shape for each different value of those attributes, in order of first
/// appearance. The result has the axes of the first shape's scope, and its attributes.
procedure merge(in: Shape[]) -> (out: Shape) [pure] {
    category "join"
    synonyms "join", "combine", "union", "collect", "unite", "group"
    augment by(key: attribute)   /// Shapes with different values of this attribute stay apart.
    example rectangle(width = 2m, height = 3m) -> copy(count = 4)
        -> merge() expect count = 1, faces = 4, area = 24
    example rectangle(width = 2m, height = 3m) -> copy(count = 4, index => @i)
        -> merge { by(@i) } expect count = 4, faces = 4
}
*/
#include "geometry.h"
#include "runtime/value.h"
#include "merge.h"

typedef struct groups {
    pcg_shape **merged;      /* one a group, in order of first appearance */
    const pcg_shape **first; /* the shape that began it: what keys are compared with */
    uint32_t count;
    uint32_t *slots;     /* open addressing: a group's number and 1; 0 is empty */
    uint32_t slot_count; /* a power of two */
} groups;

/* ---- keys ------------------------------------------------------------------------------------ */

static bool is_text(int kind)
{
    return kind == PCG_STRING || kind == PCG_PATH;
}

static pcg_u64 hash_text(pcg_u64 h, const char *s)
{
    for (; *s; s++)
        h = pcg_mix(h, (pcg_u8)*s);
    return h;
}

static pcg_u64 key_hash(const struct pcg_geometry_merge *node, const pcg_shape *s)
{
    pcg_u64 h = 0;
    for (uint32_t i = 0; i < node->item_count; i++) {
        const pcg_slot *key = &node->items[i].by.key;
        const pcg_cell *cells = pcg_get(&s->entity, key);
        if (is_text(key->kind))
            h = hash_text(h, cells->s);
        for (uint32_t k = 0; !is_text(key->kind) && k < value_width(key->kind); k++)
            h = pcg_mix(h, (pcg_u64)cells[k].i);
    }
    return h;
}

static bool same_key(const struct pcg_geometry_merge *node, const pcg_shape *a, const pcg_shape *b)
{
    for (uint32_t i = 0; i < node->item_count; i++)
        if (!geometry_same_value(&node->items[i].by.key, &a->entity, &b->entity))
            return false;
    return true;
}

/* ---- groups ---------------------------------------------------------------------------------- */

static uint32_t power_of_two_above(uint32_t n)
{
    uint32_t power = 8;
    while (power < n && power < 1u << 31)
        power *= 2;
    return power;
}

static int groups_open(pcg_run *r, groups *g, uint32_t shapes)
{
    g->slot_count = power_of_two_above(shapes < 1u << 30 ? 2 * shapes : shapes);
    g->slots = run_alloc_array(r, g->slot_count, sizeof *g->slots);
    g->merged = run_alloc_array(r, shapes, sizeof *g->merged);
    g->first = run_alloc_array(r, shapes, sizeof *g->first);
    return g->slots && g->merged && g->first ? PCG_OK : PCG_FAILED;
}

/* Gives up what was not emitted, too: those are the groups behind `emitted`. */
static void groups_close(pcg_run *r, groups *g, uint32_t shapes, uint32_t emitted)
{
    for (uint32_t i = emitted; i < g->count; i++)
        pcg_entity_drop(r, &g->merged[i]->entity);
    run_free(r, g->slots, g->slot_count * sizeof *g->slots);
    run_free(r, g->merged, shapes * sizeof *g->merged);
    run_free(r, g->first, shapes * sizeof *g->first);
}

/* The shape that `s` is to be merged into; NULL when memory has run out. */
static pcg_shape *group_of(pcg_call *call, const struct pcg_geometry_merge *node, groups *g,
                           const pcg_shape *s)
{
    uint32_t slot = (uint32_t)key_hash(node, s) & (g->slot_count - 1);
    for (; g->slots[slot]; slot = (slot + 1) & (g->slot_count - 1)) {
        uint32_t group = g->slots[slot] - 1;
        if (same_key(node, g->first[group], s))
            return g->merged[group];
    }
    pcg_shape *made = pcg_shape_new(call, &s->entity);
    if (!made)
        return NULL;
    g->merged[g->count] = made;
    g->first[g->count++] = s;
    g->slots[slot] = g->count;
    return made;
}

static int collect(pcg_call *call, const struct pcg_geometry_merge *node, groups *g)
{
    for (uint32_t i = 0; i < node->in.count; i++) {
        const pcg_shape *s = (const pcg_shape *)node->in.at[i];
        pcg_shape *into = group_of(call, node, g, s);
        if (!into || pcg_shape_append(call->run, into, s) != PCG_OK)
            return PCG_FAILED;
        int status = pcg_tick(call);
        if (status != PCG_OK)
            return status;
    }
    return PCG_OK;
}

static int emit_groups(pcg_call *call, const struct pcg_geometry_merge *node, groups *g,
                       uint32_t *emitted)
{
    while (*emitted < g->count) {
        pcg_shape *s = g->merged[*emitted];
        if (pcg_shape_fit(call->run, s) != PCG_OK)
            return PCG_FAILED;
        ++*emitted;
        int status = pcg_emit(call, node->out, &s->entity);
        if (status != PCG_OK)
            return status;
    }
    return PCG_OK;
}

int pcg_geometry_merge(pcg_call *call, struct pcg_geometry_merge *node)
{
    groups g = {0};
    uint32_t emitted = 0, shapes = node->in.count;
    int status = groups_open(call->run, &g, shapes);
    if (status == PCG_OK)
        status = collect(call, node, &g);
    if (status == PCG_OK)
        status = emit_groups(call, node, &g, &emitted);
    groups_close(call->run, &g, shapes, emitted);
    for (uint32_t i = 0; i < shapes; i++)
        pcg_entity_drop(call->run, node->in.at[i]);
    return status;
}

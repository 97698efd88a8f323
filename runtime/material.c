/* material.c - materials, each once a run. */
#include <string.h>

#include "runtime/run.h"
#include "runtime/shape.h"

const pcg_material pcg_material_default = {
    .name = "",
    .color = {0.8, 0.8, 0.8, 1},
    .texture = NULL,
    .metallic = 0,
    .roughness = 0.9,
    .two_sided = false,
};

/* Open addressing; a power of two of slots, at most half of them taken. */
struct run_materials {
    const pcg_material **slot;
    uint32_t count, capacity;
};

static bool same_text(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

static bool same_material(const pcg_material *a, const pcg_material *b)
{
    return a->color.r == b->color.r && a->color.g == b->color.g && a->color.b == b->color.b &&
           a->color.a == b->color.a && a->metallic == b->metallic && a->roughness == b->roughness &&
           a->two_sided == b->two_sided && same_text(a->name, b->name) &&
           same_text(a->texture, b->texture);
}

static pcg_u64 hash_number(pcg_u64 hash, double number)
{
    pcg_u64 bits;

    number += 0.0; /* -0 equals 0 */
    memcpy(&bits, &number, sizeof bits);
    return pcg_mix(hash, bits);
}

static pcg_u64 hash_material(const pcg_material *m)
{
    pcg_u64 hash = pcg_tag(m->name);

    hash = pcg_mix(hash, m->texture != NULL ? pcg_tag(m->texture) : 0);
    hash = hash_number(hash_number(hash, m->color.r), m->color.g);
    hash = hash_number(hash_number(hash, m->color.b), m->color.a);
    return hash_number(hash_number(hash, m->metallic), m->roughness);
}

/* Where a material is in the table, or would be. */
static const pcg_material **find(const struct run_materials *t, const pcg_material *m)
{
    uint32_t mask = t->capacity - 1, at = (uint32_t)hash_material(m) & mask;

    while (t->slot[at] != NULL && !same_material(t->slot[at], m))
        at = (at + 1) & mask;
    return &t->slot[at];
}

static int grow(pcg_run *r, struct run_materials *t)
{
    struct run_materials next = {.count = t->count,
                                 .capacity = t->capacity == 0 ? 32 : t->capacity * 2};

    next.slot = run_alloc_array(r, next.capacity, sizeof *next.slot);
    if (next.slot == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < t->capacity; i++)
        if (t->slot[i] != NULL)
            *find(&next, t->slot[i]) = t->slot[i];
    if (t->slot != NULL)
        run_free(r, (void *)t->slot, t->capacity * sizeof *t->slot);
    *t = next;
    return PCG_OK;
}

static const pcg_material *own_copy(pcg_run *r, const pcg_material *m)
{
    pcg_material *own = run_alloc(r, sizeof *own);

    if (own == NULL)
        return NULL;
    *own = *m;
    own->name = pcg_string(r, m->name);
    own->texture = m->texture != NULL ? pcg_string(r, m->texture) : NULL;
    return own->name != NULL && (m->texture == NULL || own->texture != NULL) ? own : NULL;
}

const pcg_material *pcg_material_intern(pcg_run *r, const pcg_material *m)
{
    struct run_materials *t = r->materials;
    const pcg_material **place;

    if (same_material(m, &pcg_material_default))
        return &pcg_material_default;
    if (t == NULL && (t = r->materials = run_alloc_zeroed(r, sizeof *t)) == NULL)
        return NULL;
    if (2 * t->count >= t->capacity && grow(r, t) != PCG_OK)
        return NULL;
    place = find(t, m);
    if (*place == NULL && (*place = own_copy(r, m)) != NULL)
        t->count++;
    return *place;
}

/* parcel.c - packing: entities become bytes. */
#include "parcel.h"

#include <stdlib.h>
#include <string.h>

#include "list.h"
#include "value.h"

enum { FIRST_BYTES = 4096, FIRST_SLOTS = 64 };

/* ---- bytes ---------------------------------------------------------------------------------- */

static bool grow(pcg_packer *p, size_t more)
{
    size_t limit = p->run->memory.limit, size = p->capacity ? p->capacity * 2 : FIRST_BYTES;
    if (more > limit || p->length > limit - more) {
        run_out_of_memory(p->run, more);
        return false;
    }
    while (size < p->length + more)
        size *= 2;
    char *at = realloc(p->at, size);
    if (!at) {
        run_out_of_memory(p->run, size);
        return false;
    }
    p->at = at;
    p->capacity = size;
    return true;
}

void pack_bytes(pcg_packer *p, const void *bytes, size_t count)
{
    if (!count || (count > p->capacity - p->length && !grow(p, count)))
        return;
    memcpy(p->at + p->length, bytes, count);
    p->length += count;
}

void pack_u32(pcg_packer *p, pcg_u32 number)
{
    pack_bytes(p, &number, sizeof number);
}

void pack_u64(pcg_packer *p, pcg_u64 number)
{
    pack_bytes(p, &number, sizeof number);
}

static void pack_pointer(pcg_packer *p, const void *at)
{
    pack_bytes(p, &at, sizeof at);
}

/* ---- what was met --------------------------------------------------------------------------- */

static struct parcel_met *slot_of(const parcel_seen *s, const void *at)
{
    pcg_u32 mask = s->capacity - 1, i = (pcg_u32)pcg_mix((uintptr_t)at, 0) & mask;
    while (s->slots[i].at && s->slots[i].at != at)
        i = (i + 1) & mask;
    return &s->slots[i];
}

static bool seen_grow(pcg_packer *p)
{
    parcel_seen next = {.count = p->seen.count,
                        .capacity = p->seen.capacity ? p->seen.capacity * 2 : FIRST_SLOTS};
    next.slots = run_alloc_array(p->run, next.capacity, sizeof *next.slots);
    if (!next.slots)
        return false;
    for (pcg_u32 i = 0; i < p->seen.capacity; i++)
        if (p->seen.slots[i].at)
            *slot_of(&next, p->seen.slots[i].at) = p->seen.slots[i];
    run_free(p->run, p->seen.slots, p->seen.capacity * sizeof *next.slots);
    p->seen = next;
    return true;
}

bool pack_object(pcg_packer *p, const void *object)
{
    if (!object) {
        pack_u32(p, PARCEL_NONE);
        return false;
    }
    if (p->seen.count >= p->seen.capacity / 2 && !seen_grow(p))
        return false;
    struct parcel_met *met = slot_of(&p->seen, object);
    bool is_new = !met->at;
    if (is_new)
        *met = (struct parcel_met){object, p->seen.count++};
    pack_u32(p, met->number);
    return is_new;
}

/* ---- values --------------------------------------------------------------------------------- */

static void pack_text(pcg_packer *p, const char *s)
{
    size_t length = strlen(s);
    pack_u32(p, (pcg_u32)length);
    pack_bytes(p, s, length);
}

void pack_string(pcg_packer *p, const char *s)
{
    if (p->flags & PARCEL_LOCAL) {
        pack_pointer(p, s);
    } else if (p->flags & PARCEL_KEY) {
        pack_text(p, s ? s : "");
    } else if (pack_object(p, s)) {
        pack_text(p, s);
    }
}

static bool is_text(int kind)
{
    return kind == PCG_STRING || kind == PCG_PATH;
}

static void pack_list(pcg_packer *p, int element, const pcg_list *list)
{
    pack_u32(p, list->count);
    pack_u32(p, list->width);
    if (!is_text(element)) {
        pack_bytes(p, list->at, (size_t)list->count * list->width * sizeof *list->at);
        return;
    }
    for (pcg_u32 i = 0; i < list->count; i++)
        pack_string(p, list->at[i].s);
}

void pack_value(pcg_packer *p, int kind, int element, const pcg_cell *cells)
{
    if (p->flags & PARCEL_LOCAL || (!is_text(kind) && kind != PCG_LIST))
        pack_bytes(p, cells, value_width(kind) * sizeof *cells);
    else if (is_text(kind))
        pack_string(p, cells->s);
    else
        pack_list(p, element, cells->list);
}

void pack_node(pcg_packer *p, const pcg_node *n)
{
    if (p->flags & PARCEL_LOCAL) {
        pack_pointer(p, n);
    } else if (p->flags & PARCEL_KEY) {
        pack_text(p, n ? n->name : "");
    } else if (pack_object(p, n)) {
        pack_string(p, n->graph);
        pack_string(p, n->name);
        pack_string(p, n->procedure);
    }
}

void pack_material(pcg_packer *p, const pcg_material *m)
{
    if (!pack_object(p, m))
        return;
    pack_string(p, m->name);
    pack_string(p, m->texture);
    pack_bytes(p, &m->color, sizeof m->color);
    pack_bytes(p, &m->metallic, sizeof m->metallic);
    pack_bytes(p, &m->roughness, sizeof m->roughness);
    pack_u32(p, m->two_sided);
}

/* ---- entities ------------------------------------------------------------------------------- */

static void pack_type(pcg_packer *p, const pcg_type *type)
{
    if (p->flags & PARCEL_LOCAL)
        pack_pointer(p, type);
    else if (parcel_type(type->name) == type)
        pack_text(p, type->name);
    else
        p->cannot = type->name;
}

static void remember(pcg_packer *p, const pcg_entity *e)
{
    if (list_room(p->run, (void **)&p->entities, &p->entity_capacity, p->entity_count, 1,
                  sizeof *p->entities) == PCG_OK)
        p->entities[p->entity_count++] = (pcg_entity *)(uintptr_t)e;
}

static void pack_head(pcg_packer *p, const pcg_entity *e)
{
    const pcg_cell *origin = pcg_attribute(e, p->cell);
    pack_type(p, e->type);
    pack_node(p, e->maker);
    pack_u32(p, origin ? (pcg_u32)origin->i : PARCEL_NONE);
    if (p->flags & PARCEL_LINEAGE)
        pack_u64(p, e->lineage);
}

void pack_entity(pcg_packer *p, const pcg_entity *e)
{
    if (p->cannot || !pack_object(p, e))
        return;
    remember(p, e);
    pack_head(p, e);
    if (!e->type->pack) {
        if (e->type->size > sizeof *e)
            p->cannot = e->type->name;
    } else if (++p->depth > PARCEL_DEPTH) {
        p->cannot = e->type->name;
    } else {
        e->type->pack(p, e);
        p->depth--;
    }
}

int pack_status(const pcg_packer *p)
{
    return p->cannot || p->run->status != PCG_OK ? PCG_FAILED : PCG_OK;
}

bool parcel_is_alone(const pcg_entity *e)
{
    bool holds = pcg_entity_is(e, &pcg_type_shape) ? ((const pcg_shape *)e)->parts != NULL
                                                   : e->type->leave != NULL;
    return e->references == 1 && !holds && (e->type->pack || e->type->size == sizeof *e);
}

void packer_close(pcg_packer *p)
{
    free(p->at);
    run_free(p->run, p->entities, p->entity_capacity * sizeof *p->entities);
    run_free(p->run, p->seen.slots, p->seen.capacity * sizeof *p->seen.slots);
    p->at = NULL;
    p->entities = NULL;
    p->seen = (parcel_seen){0};
}

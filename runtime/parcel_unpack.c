/* parcel_unpack.c - unpacking: bytes, of which nothing is believed, become entities again. */
#include <string.h>

#include "list.h"
#include "parcel.h"
#include "value.h"

enum { TYPE_NAME_BYTES = 100 };

/* ---- bytes ---------------------------------------------------------------------------------- */

void unpack_bytes(pcg_unpacker *u, void *to, size_t count)
{
    if (u->failed || count > (size_t)(u->end - u->at)) {
        u->failed = true;
        if (count)
            memset(to, 0, count);
        return;
    }
    if (count)
        memcpy(to, u->at, count);
    u->at += count;
}

pcg_u32 unpack_u32(pcg_unpacker *u)
{
    pcg_u32 number;
    unpack_bytes(u, &number, sizeof number);
    return number;
}

pcg_u64 unpack_u64(pcg_unpacker *u)
{
    pcg_u64 number;
    unpack_bytes(u, &number, sizeof number);
    return number;
}

static const void *unpack_pointer(pcg_unpacker *u)
{
    const void *at;
    unpack_bytes(u, &at, sizeof at);
    return at;
}

pcg_u32 unpack_count(pcg_unpacker *u, size_t size)
{
    pcg_u32 count = unpack_u32(u);
    if (!u->failed && count <= (size_t)(u->end - u->at) / size)
        return count;
    u->failed = true;
    return 0;
}

/* ---- objects -------------------------------------------------------------------------------- */

bool unpack_object(pcg_unpacker *u, int kind, pcg_u32 *number, void **object)
{
    *object = NULL;
    *number = unpack_u32(u);
    if (u->failed || *number == PARCEL_NONE)
        return false;
    if (*number < u->object_count) {
        const parcel_object *o = &u->objects[*number];
        *object = o->whole && o->kind == kind ? o->at : NULL;
        u->failed |= !*object;
        return false;
    }
    if (*number > u->object_count ||
        list_room(u->run, (void **)&u->objects, &u->object_capacity, u->object_count, 1,
                  sizeof *u->objects) != PCG_OK) {
        u->failed = true;
        return false;
    }
    u->objects[u->object_count++] = (parcel_object){NULL, kind, false};
    return true;
}

void unpack_made(pcg_unpacker *u, pcg_u32 number, void *object)
{
    u->objects[number].at = object;
    u->objects[number].whole = true;
    u->failed |= !object;
}

/* ---- values --------------------------------------------------------------------------------- */

/* As long as the bytes that are left. */
static const char *unpack_text(pcg_unpacker *u)
{
    pcg_u32 length = unpack_count(u, 1);
    if (u->failed || !length || memchr(u->at, 0, length)) {
        u->failed |= length > 0;
        return "";
    }
    int shown = length < INT32_MAX ? (int)length : INT32_MAX;
    const char *s = pcg_format(u->run, "%.*s", shown, u->at);
    u->at += length;
    return s;
}

const char *unpack_string(pcg_unpacker *u)
{
    pcg_u32 number;
    void *known;
    if (u->flags & PARCEL_LOCAL)
        return unpack_pointer(u);
    if (!unpack_object(u, PARCEL_STRING, &number, &known))
        return known;
    const char *s = unpack_text(u);
    unpack_made(u, number, (void *)(uintptr_t)s);
    return s;
}

/* Never NULL. */
static const char *unpack_some_string(pcg_unpacker *u)
{
    const char *s = unpack_string(u);
    u->failed |= !s;
    return s ? s : "";
}

static bool is_text(int kind)
{
    return kind == PCG_STRING || kind == PCG_PATH;
}

static const pcg_list *unpack_list(pcg_unpacker *u, int element)
{
    pcg_u32 width = value_width(element), count, given;
    count = unpack_count(u, is_text(element) ? sizeof(pcg_u32) : width * sizeof(pcg_cell));
    given = unpack_u32(u);
    pcg_list *list = pcg_list_new(u->run, u->failed || given != width ? 0 : count, width);
    u->failed |= given != width || !list;
    if (u->failed)
        return list;
    if (!is_text(element))
        unpack_bytes(u, list->at, (size_t)count * width * sizeof *list->at);
    for (pcg_u32 i = 0; i < count && is_text(element); i++)
        list->at[i].s = unpack_some_string(u);
    return list;
}

void unpack_value(pcg_unpacker *u, int kind, int element, pcg_cell *to)
{
    if (u->flags & PARCEL_LOCAL || (!is_text(kind) && kind != PCG_LIST))
        unpack_bytes(u, to, value_width(kind) * sizeof *to);
    else if (is_text(kind))
        to->s = unpack_some_string(u);
    else
        to->list = unpack_list(u, element);
}

static const pcg_node *node_named(pcg_unpacker *u, const pcg_node *like)
{
    for (pcg_u32 i = 0; u->module && i < u->module->node_count; i++) {
        const pcg_node *n = &u->module->nodes[i];
        if (!strcmp(n->name, like->name) && !strcmp(n->graph, like->graph) &&
            !strcmp(n->procedure, like->procedure))
            return n;
    }
    pcg_node *own = run_alloc(u->run, sizeof *own);
    if (own)
        *own = *like;
    return own;
}

const pcg_node *unpack_node(pcg_unpacker *u)
{
    pcg_u32 number;
    void *known;
    if (u->flags & PARCEL_LOCAL)
        return unpack_pointer(u);
    if (!unpack_object(u, PARCEL_NODE, &number, &known))
        return known;
    pcg_node like = {.file = ""};
    like.graph = unpack_some_string(u);
    like.name = unpack_some_string(u);
    like.procedure = unpack_some_string(u);
    const pcg_node *n = u->failed ? NULL : node_named(u, &like);
    unpack_made(u, number, (void *)(uintptr_t)n);
    return n;
}

const pcg_material *unpack_material(pcg_unpacker *u)
{
    pcg_u32 number;
    void *known;
    if (!unpack_object(u, PARCEL_MATERIAL, &number, &known))
        return known;
    pcg_material m = {.name = unpack_some_string(u), .texture = unpack_string(u)};
    unpack_bytes(u, &m.color, sizeof m.color);
    unpack_bytes(u, &m.metallic, sizeof m.metallic);
    unpack_bytes(u, &m.roughness, sizeof m.roughness);
    m.two_sided = unpack_u32(u) != 0;
    const pcg_material *own = u->failed ? NULL : pcg_material_intern(u->run, &m);
    unpack_made(u, number, (void *)(uintptr_t)own);
    return own;
}

/* ---- entities ------------------------------------------------------------------------------- */

static const pcg_type *unpack_type(pcg_unpacker *u)
{
    char name[TYPE_NAME_BYTES] = "";
    if (u->flags & PARCEL_LOCAL)
        return unpack_pointer(u);
    pcg_u32 length = unpack_count(u, 1);
    if (length >= sizeof name)
        u->failed = true;
    else
        unpack_bytes(u, name, length);
    const pcg_type *type = u->failed ? NULL : parcel_type(name);
    u->failed |= !type;
    return type;
}

static void remember(pcg_unpacker *u, pcg_entity *e)
{
    if (list_room(u->run, (void **)&u->entities, &u->entity_capacity, u->entity_count, 1,
                  sizeof *u->entities) == PCG_OK)
        u->entities[u->entity_count++] = e;
    else
        u->failed = true;
}

static void inherit(pcg_unpacker *u, pcg_entity *e, pcg_u32 origin)
{
    if (u->origins && origin < u->origin_count)
        e->attributes = attributes_hold(u->origins[origin]->attributes);
    else if (u->origins && origin != PARCEL_NONE)
        u->failed = true;
    pcg_cell *own = u->cell < 0 ? NULL : pcg_attribute_write(u->run, e, u->cell, PCG_INT);
    if (own)
        own->i = u->entity_count;
}

/* NULL: failed. What lies behind the pcg_entity is zero. */
static pcg_entity *unpack_head(pcg_unpacker *u)
{
    const pcg_type *type = unpack_type(u);
    const pcg_node *maker = unpack_node(u);
    pcg_u32 origin = unpack_u32(u);
    pcg_u64 lineage = u->flags & PARCEL_LINEAGE ? unpack_u64(u) : 0;
    pcg_entity *e = u->failed ? NULL : entity_empty(u->run, type);
    if (!e)
        return NULL;
    e->maker = maker;
    e->lineage = lineage;
    inherit(u, e, origin);
    remember(u, e);
    return e;
}

/* A type of which nothing can be read lies in no parcel that this runtime made. */
static bool unpack_body(pcg_unpacker *u, pcg_entity *e)
{
    if (!e->type->unpack)
        return e->type->size == sizeof *e;
    if (u->depth >= PARCEL_DEPTH)
        return false;
    u->depth++;
    int status = e->type->unpack(u, e);
    u->depth--;
    return status == PCG_OK;
}

static void give_up(pcg_unpacker *u, pcg_entity *e)
{
    attributes_drop(u->run, e->attributes);
    run_free(u->run, e, e->type->size);
    u->run->entities--;
    u->failed = true;
}

pcg_entity *unpack_entity(pcg_unpacker *u)
{
    pcg_u32 number;
    void *known;
    if (!unpack_object(u, PARCEL_ENTITY, &number, &known)) {
        u->failed |= !known;
        return known ? pcg_entity_hold(known) : NULL;
    }
    pcg_entity *e = unpack_head(u);
    if (e && !unpack_body(u, e)) {
        give_up(u, e);
        e = NULL;
    }
    unpack_made(u, number, e);
    return e ? pcg_entity_hold(e) : NULL;
}

void unpacker_close(pcg_unpacker *u)
{
    for (pcg_u32 i = 0; i < u->object_count; i++) {
        const parcel_object *o = &u->objects[i];
        if (o->at && o->kind == PARCEL_ENTITY)
            pcg_entity_drop(u->run, o->at);
        else if (o->at && o->kind == PARCEL_MESH)
            pcg_mesh_drop(u->run, o->at);
    }
    run_free(u->run, u->objects, u->object_capacity * sizeof *u->objects);
    run_free(u->run, u->entities, u->entity_capacity * sizeof *u->entities);
    u->objects = NULL;
    u->entities = NULL;
    u->object_count = u->entity_count = 0;
    u->object_capacity = u->entity_capacity = 0;
}

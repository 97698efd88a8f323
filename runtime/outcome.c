/* outcome.c - what an execution of a graph gave and said, as bytes, and back.
 *
 * First what was recorded, with rounds counted from the execution's first; then what the modules
 * have counted; then the entities in the order in which they leave, each with its output and the
 * values that go out along its links. */
#include <string.h>

#include "list.h"
#include "part.h"
#include "surrogate.h"
#include "value.h"

enum { RECORD_BYTES_LEAST = 5 * sizeof(pcg_u32), ENTITY_BYTES_LEAST = 2 * sizeof(pcg_u32) };

/* ---- packing -------------------------------------------------------------------------------- */

static void pack_pointer(pcg_packer *p, const void *at)
{
    pack_bytes(p, &at, sizeof at);
}

/* How many rounds of the node there had been. */
static pcg_u64 rounds_before(const outcome_before *before, const pcg_choice *k, const pcg_node *n)
{
    const pcg_module *m = k->module;
    bool own = n && n->index < m->node_count && n == &m->nodes[n->index];
    return before && own ? before->worked[n->index] : 0;
}

static void pack_said(pcg_packer *p, const pcg_choice *k, const run_record *said,
                      const outcome_before *before)
{
    pack_u32(p, said->items.count);
    for (pcg_u32 i = 0; i < said->items.count; i++) {
        const record_item *item = &said->items.at[i];
        bool is_warning = item->kind == RECORD_WARNED || item->kind == RECORD_ONCE;
        pack_u32(p, item->kind);
        pack_u32(p, item->severity);
        pack_u32(p, (pcg_u32)item->code);
        pack_node(p, item->node);
        pack_u64(p, item->count - (is_warning ? rounds_before(before, k, item->node) : 0));
        if (p->flags & PARCEL_LOCAL)
            pack_pointer(p, item->loaded);
        pack_u32(p, (pcg_u32)strlen(item->text));
        pack_bytes(p, item->text, strlen(item->text));
    }
}

/* Pairs of an index and by how much it has grown, behind how many there are. */
static void pack_growth(pcg_packer *p, const pcg_u64 *now, const pcg_u64 *before, pcg_u32 count)
{
    pcg_u32 grown = 0;
    for (pcg_u32 i = 0; i < count; i++)
        grown += now[i] != (before ? before[i] : 0);
    pack_u32(p, grown);
    for (pcg_u32 i = 0; i < count && grown; i++) {
        pcg_u64 by = now[i] - (before ? before[i] : 0);
        if (!by)
            continue;
        pack_u32(p, i);
        pack_u64(p, by);
    }
}

static void pack_counts(pcg_packer *p, const pcg_loaded *l, const outcome_before *before)
{
    pack_growth(p, l->sent, before ? before->sent : NULL, l->module->port_count);
    pack_growth(p, l->worked, before ? before->worked : NULL, l->module->node_count);
}

static void pack_all_counts(pcg_packer *p)
{
    pcg_u32 count = 0;
    for (pcg_loaded *l = &p->run->own; l; l = l->next)
        count++;
    pack_u32(p, count);
    for (pcg_loaded *l = &p->run->own; l; l = l->next) {
        pack_pointer(p, l);
        pack_counts(p, l, NULL);
    }
}

static void pack_output(pcg_packer *p, const pcg_surrogate *s, const pcg_choice *k, pcg_u32 output)
{
    const pcg_queue *q = choice_output(k, output);
    for (pcg_u32 i = q->head; i < q->end; i++) {
        pack_u32(p, k->outputs[output]);
        pack_entity(p, q->at[i]);
        for (pcg_u32 a = 0; a < s->info->attribute_count; a++)
            if (s->links[a])
                pack_value(p, k->attributes[a]->kind, k->attributes[a]->element,
                           pcg_get(q->at[i], &k->slots[a]));
    }
}

static void pack_outputs(pcg_packer *p, const pcg_surrogate *s, const pcg_choice *k)
{
    const pcg_module *m = k->module;
    pcg_u32 count = 0;
    for (pcg_u32 i = 0; i < m->output_count; i++)
        if (k->outputs[i] != NO_OUTPUT)
            count += choice_output(k, i)->end - choice_output(k, i)->head;
    pack_u32(p, count);
    for (pcg_u32 d = 0; d < s->info->output_count; d++)
        for (pcg_u32 i = 0; i < m->output_count; i++)
            if (k->outputs[i] == d)
                pack_output(p, s, k, i);
}

int outcome_pack(pcg_packer *p, const pcg_surrogate *s, const pcg_choice *k, const run_record *said,
                 const outcome_before *before)
{
    parts_settle(p->run);
    pack_said(p, k, said, before);
    if (p->flags & PARCEL_LOCAL)
        pack_all_counts(p);
    else
        pack_counts(p, k->loaded, before);
    pack_outputs(p, s, k);
    return said->lost ? PCG_FAILED : pack_status(p);
}

/* ---- unpacking ------------------------------------------------------------------------------ */

typedef struct growth { pcg_u64 *to; pcg_u64 by; } growth;
typedef struct leaving { pcg_u32 output; pcg_entity *entity; } leaving;

/* All of it is read before any of it is believed. */
typedef struct outcome {
    pcg_unpacker *u;
    pcg_call *call;
    pcg_surrogate *surrogate;
    record_item *said;
    growth *counts;
    leaving *entities;
    pcg_u32 said_count, growth_count, entity_count;
    pcg_u32 said_capacity, growth_capacity, entity_capacity;
} outcome;

/* Where a module that a worker ran takes part in this run; it joins where it does not yet. */
static pcg_loaded *own_loaded(outcome *o, const pcg_loaded *other)
{
    pcg_run *r = o->call->run;
    for (pcg_loaded *l = &r->own; l; l = l->next)
        if (l->program == other->program)
            return l;
    pcg_loaded *l = loaded_before(r, other->key);
    if (!l && (l = loaded_add(r, other->program, other->key)) != NULL)
        l->borrowed = true;
    o->u->failed |= !l;
    return l;
}

static pcg_loaded *unpack_loaded(outcome *o)
{
    const pcg_loaded *other;
    if (!(o->u->flags & PARCEL_LOCAL))
        return o->surrogate->choice->loaded;
    unpack_bytes(o->u, &other, sizeof other);
    return other && !o->u->failed ? own_loaded(o, other) : NULL;
}

static bool room(outcome *o, void **at, pcg_u32 *capacity, pcg_u32 count, pcg_u32 more, size_t size)
{
    if (more && list_room(o->call->run, at, capacity, count, more, size) != PCG_OK)
        o->u->failed = true;
    return !o->u->failed;
}

/* Of its text the bytes stay where they are, and are made a string when it is said. */
static void unpack_item(outcome *o, record_item *item)
{
    pcg_unpacker *u = o->u;
    pcg_u32 kind = unpack_u32(u), rank = unpack_u32(u), code = unpack_u32(u);
    *item = (record_item){.kind = (record_kind)kind,
                          .severity = (pcg_severity)rank,
                          .code = (int)code,
                          .node = unpack_node(u),
                          .count = unpack_u64(u)};
    item->loaded = unpack_loaded(o);
    pcg_u32 length = unpack_count(u, 1);
    if (u->failed || kind > RECORD_PATH || rank > PCG_ERROR || code > MESSAGE_PLAIN ||
        length > INT32_MAX) {
        u->failed = true;
        return;
    }
    item->text = pcg_format(u->run, "%.*s", (int)length, u->at);
    u->at += length;
    const pcg_loaded *l = item->loaded;
    bool is_warning = item->kind == RECORD_WARNED || item->kind == RECORD_ONCE;
    u->failed |= is_warning && (!l || !item->node || item->node->index >= l->module->node_count ||
                                item->node != &l->module->nodes[item->node->index]);
    u->failed |= item->kind == RECORD_LEFT && !item->node;
    if (is_warning && !u->failed)
        item->count += l->worked[item->node->index];
}

static void unpack_said(outcome *o)
{
    pcg_u32 count = unpack_count(o->u, RECORD_BYTES_LEAST);
    if (room(o, (void **)&o->said, &o->said_capacity, 0, count, sizeof *o->said))
        while (o->said_count < count && !o->u->failed)
            unpack_item(o, &o->said[o->said_count++]);
}

static void unpack_growth(outcome *o, pcg_u64 *to, pcg_u32 length)
{
    pcg_u32 count = unpack_count(o->u, sizeof(pcg_u32) + sizeof(pcg_u64));
    if (!room(o, (void **)&o->counts, &o->growth_capacity, o->growth_count, count,
              sizeof *o->counts))
        return;
    for (pcg_u32 i = 0; i < count; i++) {
        pcg_u32 index = unpack_u32(o->u);
        pcg_u64 by = unpack_u64(o->u);
        if (o->u->failed || index >= length) {
            o->u->failed = true;
            return;
        }
        o->counts[o->growth_count++] = (growth){&to[index], by};
    }
}

static void unpack_counts(outcome *o)
{
    pcg_u32 count = o->u->flags & PARCEL_LOCAL ? unpack_u32(o->u) : 1;
    for (pcg_u32 i = 0; i < count && !o->u->failed; i++) {
        pcg_loaded *l = unpack_loaded(o);
        if (!l) {
            o->u->failed = true;
            return;
        }
        unpack_growth(o, l->sent, l->module->port_count);
        unpack_growth(o, l->worked, l->module->node_count);
    }
}

static void unpack_links(outcome *o, pcg_entity *e)
{
    const pcg_surrogate *s = o->surrogate;
    const pcg_choice *k = s->choice;
    for (pcg_u32 a = 0; a < s->info->attribute_count && !o->u->failed; a++) {
        pcg_cell value[4];
        if (!s->links[a])
            continue;
        unpack_value(o->u, k->attributes[a]->kind, k->attributes[a]->element, value);
        if (!o->u->failed)
            surrogate_write_link(o->call, k, a, value, e, s->links[a]);
    }
}

static void unpack_entities(outcome *o)
{
    pcg_u32 count = unpack_count(o->u, ENTITY_BYTES_LEAST);
    if (!room(o, (void **)&o->entities, &o->entity_capacity, 0, count, sizeof *o->entities))
        return;
    while (o->entity_count < count && !o->u->failed) {
        pcg_u32 output = unpack_u32(o->u);
        pcg_entity *e = unpack_entity(o->u);
        if (!e)
            return;
        o->entities[o->entity_count++] = (leaving){output, e};
        o->u->failed |= output >= o->surrogate->info->output_count;
        unpack_links(o, e);
    }
}

/* ---- taking --------------------------------------------------------------------------------- */

void outcome_renumber(const pcg_call *c, pcg_entity *const *entities, pcg_u32 count)
{
    for (pcg_u32 i = 0; i < count; i++)
        entities[i]->lineage = pcg_mix(pcg_mix(c->lineage, c->key), (pcg_u64)i + 1);
}

/* Status. */
static int apply(outcome *o)
{
    pcg_run *r = o->call->run;
    pcg_surrogate *s = o->surrogate;
    for (pcg_u32 i = 0; i < o->said_count; i++)
        record_replay(r, &o->said[i], o->said[i].loaded);
    for (pcg_u32 i = 0; i < o->growth_count; i++)
        *o->counts[i].to += o->counts[i].by;
    int status = r->status;
    pcg_u32 i = 0;
    for (; i < o->entity_count && status == PCG_OK; i++) {
        s->choice->left++;
        status = pcg_emit(o->call, s->outputs[o->entities[i].output], o->entities[i].entity);
    }
    for (; i < o->entity_count; i++)
        pcg_entity_drop(r, o->entities[i].entity);
    o->entity_count = 0;
    return status;
}

static void outcome_close(outcome *o)
{
    pcg_run *r = o->call->run;
    for (pcg_u32 i = 0; i < o->entity_count; i++)
        pcg_entity_drop(r, o->entities[i].entity);
    run_free(r, o->said, o->said_capacity * sizeof *o->said);
    run_free(r, o->counts, o->growth_capacity * sizeof *o->counts);
    run_free(r, o->entities, o->entity_capacity * sizeof *o->entities);
}

int outcome_take(pcg_unpacker *u, pcg_call *c, pcg_surrogate *s, bool renumber)
{
    outcome o = {.u = u, .call = c, .surrogate = s};
    unpack_said(&o);
    unpack_counts(&o);
    unpack_entities(&o);
    u->failed |= u->at != u->end;
    int status = c->run->status;
    if (!u->failed && renumber)
        outcome_renumber(c, u->entities, u->entity_count);
    if (!u->failed && status == PCG_OK)
        status = apply(&o);
    outcome_close(&o);
    return status;
}

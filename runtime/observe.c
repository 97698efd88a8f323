/* observe.c - entities' numbers and ways, and telling an observer of rounds. */
#include "observe.h"

#include <string.h>

#include "result.h"

enum { TABLE_FIRST = 64, WAY_SHOWN = 256 };

/* ---- opening -------------------------------------------------------------------------------- */

run_observation *observe_open(pcg_run *r)
{
    if (!r->observed)
        r->observed = run_alloc_zeroed(r, sizeof *r->observed);
    return r->observed;
}

void observe_close(pcg_run *r)
{
    if (r->observed)
        arena_free(&r->observed->scratch);
}

/* ---- entities ------------------------------------------------------------------------------- */

static pcg_u64 address_hash(const void *at)
{
    return pcg_mix((uintptr_t)at >> 4, 0);
}

/* The slot of an entity, or the empty one where it belongs. */
static observed_entity *entry_slot(const run_observation *w, const pcg_entity *e)
{
    pcg_u32 mask = w->entry_capacity - 1, i = (pcg_u32)address_hash(e) & mask;
    while (w->entries[i].entity && w->entries[i].entity != e)
        i = (i + 1) & mask;
    return &w->entries[i];
}

/* Room for one more, so that a quarter stays empty. */
static bool entries_reserve(pcg_run *r, run_observation *w)
{
    if (w->entry_count < w->entry_capacity / 4 * 3)
        return true;
    run_observation old = *w;
    pcg_u32 wanted = old.entry_capacity ? old.entry_capacity * 2 : TABLE_FIRST;
    observed_entity *grown = wanted ? run_alloc_array(r, wanted, sizeof *grown) : NULL;
    if (!grown)
        return false;
    w->entries = grown;
    w->entry_capacity = wanted;
    for (pcg_u32 i = 0; i < old.entry_capacity; i++)
        if (old.entries[i].entity)
            *entry_slot(w, old.entries[i].entity) = old.entries[i];
    run_free(r, old.entries, old.entry_capacity * sizeof *old.entries);
    return true;
}

/* The entity's entry, a new one where it has none: the host put it in. NULL: no memory. */
static observed_entity *entry_of(pcg_run *r, const pcg_entity *e)
{
    run_observation *w = r->observed;
    if (!entries_reserve(r, w))
        return NULL;
    observed_entity *slot = entry_slot(w, e);
    if (!slot->entity) {
        w->entry_count++;
        *slot = (observed_entity){.entity = e, .number = ++w->numbered};
    }
    return slot;
}

/* An address may have been another entity's, which is gone. */
void observe_made(pcg_run *r, const pcg_entity *e, const pcg_entity *from)
{
    run_observation *w = r->observed;
    const observed_entity *parent = from ? entry_of(r, from) : NULL;
    pcg_u32 way = parent ? parent->way : OBSERVE_NO_WAY;
    pcg_u64 left = parent ? parent->left : 0;
    pcg_u64 before = w->numbered;
    observed_entity *entry = entry_of(r, e);
    if (!entry)
        return;
    if (w->numbered == before)
        entry->number = ++w->numbered;
    entry->way = way;
    entry->left = left;
}

pcg_u64 observe_number(pcg_run *r, const pcg_entity *e)
{
    const observed_entity *entry = entry_of(r, e);
    return entry ? entry->number : 0;
}

/* ---- ways ----------------------------------------------------------------------------------- */

static bool same_step(const observed_way *a, const observed_way *b)
{
    return a->before == b->before && a->node == b->node && a->port == b->port;
}

static pcg_u32 *way_slot(const run_observation *w, const observed_way *way)
{
    pcg_u64 hash = pcg_mix(pcg_mix(way->before, address_hash(way->node)), address_hash(way->port));
    pcg_u32 mask = w->slot_capacity - 1, i = (pcg_u32)hash & mask;
    while (w->way_slots[i] != OBSERVE_NO_WAY && !same_step(&w->at[w->way_slots[i]], way))
        i = (i + 1) & mask;
    return &w->way_slots[i];
}

static bool ways_reserve(pcg_run *r, run_observation *w)
{
    if (w->way_count + 1 < w->way_capacity)
        return true;
    pcg_u32 old = w->way_capacity, wanted = old ? old * 2 : TABLE_FIRST;
    pcg_u32 *slots = wanted ? run_alloc_array(r, (size_t)wanted * 2, sizeof *slots) : NULL;
    observed_way *at = slots ? run_resize(r, w->at, old * sizeof *at, wanted * sizeof *at) : NULL;
    if (!at) {
        run_free(r, slots, (size_t)wanted * 2 * sizeof *slots);
        return false;
    }
    run_free(r, w->way_slots, w->slot_capacity * sizeof *w->way_slots);
    w->at = at;
    w->way_capacity = wanted;
    w->way_slots = slots;
    w->slot_capacity = wanted * 2;
    for (pcg_u32 i = 1; i <= w->way_count; i++)
        *way_slot(w, &at[i]) = i;
    return true;
}

/* The way `before` with one more port behind it. */
static pcg_u32 way_behind(pcg_run *r, pcg_u32 before, const pcg_node *node, const char *port)
{
    run_observation *w = r->observed;
    if (!ways_reserve(r, w))
        return before;
    pcg_u32 length = before ? w->at[before].length + 1 : 1;
    const observed_way way = {before, length, node, port};
    pcg_u32 *slot = way_slot(w, &way);
    if (*slot == OBSERVE_NO_WAY) {
        *slot = ++w->way_count;
        w->at[*slot] = way;
    }
    return *slot;
}

/* What is made of an entity that has left the node in this round did not come through it before. */
static void way_extend(pcg_call *c, observed_entity *entry, const char *port)
{
    const run_observation *w = c->run->observed;
    pcg_u32 before = entry->way;
    if (before && entry->left == c->run->rounds && w->at[before].node == c->node)
        before = w->at[before].before;
    entry->way = way_behind(c->run, before, c->node, port);
    entry->left = c->run->rounds;
}

static void way_write(const pcg_run *r, const observed_way *way, text *out)
{
    arena scratch = {0};
    text step = {.arena = &scratch};
    if (strcmp(way->node->graph, r->module->name) != 0)
        text_format(&step, "%s/", way->node->graph);
    text_format(&step, "%s.%s", way->node->name, way->port);
    text_quote(out, step.at ? step.at : "");
    arena_free(&scratch);
}

bool result_path_json(const pcg_run *r, const pcg_entity *e, text *out)
{
    const run_observation *w = r->observed;
    if (!w || !w->ways)
        return false;
    pcg_u32 steps[WAY_SHOWN], count = 0;
    pcg_u32 way = w->entry_capacity ? entry_slot(w, e)->way : OBSERVE_NO_WAY;
    pcg_u32 length = way ? w->at[way].length : 0;
    for (; way && count < WAY_SHOWN; way = w->at[way].before)
        steps[count++] = way;
    text_add(out, "\"path\":[");
    for (pcg_u32 i = count; i-- > 0;) {
        way_write(r, &w->at[steps[i]], out);
        text_add(out, i ? "," : "");
    }
    text_add(out, "]");
    if (length > count)
        text_format(out, ",\"path_length\":%u", length);
    return true;
}

/* ---- telling -------------------------------------------------------------------------------- */

static pcg_event event_of(const pcg_call *c, pcg_event_kind kind)
{
    const pcg_node *n = c->node;
    return (pcg_event){.size = sizeof(pcg_event), .kind = kind, .node = n->name,
                       .procedure = n->procedure, .graph = n->graph, .file = n->file,
                       .line = n->line, .column = n->column, .round = c->round,
                       .depth = c->frame->depth, .memory = c->run->memory.used};
}

static void tell(const pcg_call *c, const pcg_event *e)
{
    run_observation *w = c->run->observed;
    w->call = c;
    w->observer(w->user, c->run, e);
    w->call = NULL;
}

void pcg_round_seen(pcg_call *c, const pcg_seen *about, const void *self,
                    const pcg_entities *inputs)
{
    run_observation *w = c->run->observed;
    if (!w || !w->observer)
        return;
    pcg_event e = event_of(c, PCG_EVENT_ROUND);
    e.input_count = about->input_count;
    e.parameter_count = about->parameter_count;
    w->about = about;
    w->self = self;
    w->inputs = inputs;
    tell(c, &e);
    w->about = NULL;
}

void pcg_round_over(pcg_call *c)
{
    run_observation *w = c->run->observed;
    if (!w || !w->observer)
        return;
    const pcg_event e = event_of(c, PCG_EVENT_END);
    tell(c, &e);
}

static const char *port_name(const pcg_call *c, const pcg_port *p)
{
    return c->frame->loaded->module->ports[p->index].name;
}

/* A gate of an encapsulated graph passes on what the node that runs it was given. */
static bool is_gate(const pcg_node *n)
{
    return strcmp(n->procedure, "in") == 0;
}

/* `to` NULL: nothing takes it. */
static void tell_sent(pcg_call *c, const char *port, const pcg_entity *e, pcg_u64 original,
                      const pcg_queue *to)
{
    run_observation *w = c->run->observed;
    if (!w->observer || is_gate(c->node))
        return;
    pcg_event event = event_of(c, PCG_EVENT_SENT);
    event.port = port;
    event.entity = observe_number(c->run, e);
    event.original = original;
    event.dropped = !to;
    w->entity = e;
    w->to = to;
    tell(c, &event);
    w->entity = NULL;
    w->to = NULL;
}

static int send_copies(pcg_call *c, const pcg_port *p, const pcg_entity *e, const char *port)
{
    pcg_run *r = c->run;
    for (pcg_u32 i = 1; i < p->count; i++) {
        pcg_entity *copy = pcg_entity_copy(r, e, i);
        if (!copy)
            return PCG_FAILED;
        tell_sent(c, port, copy, observe_number(r, e), p->to[i]);
        int status = pcg_queue_push(r, p->to[i], copy);
        if (status != PCG_OK)
            return status;
    }
    return PCG_OK;
}

int observe_emit(pcg_call *c, const pcg_port *p, pcg_entity *e)
{
    pcg_run *r = c->run;
    const char *port = port_name(c, p);
    observed_entity *entry = entry_of(r, e);
    if (!entry)
        return PCG_FAILED;
    if (r->observed->ways && !is_gate(c->node))
        way_extend(c, entry, port);
    tell_sent(c, port, e, 0, p->count ? p->to[0] : NULL);
    if (p->count == 0) {
        pcg_entity_drop(r, e);
        return PCG_OK;
    }
    int status = pcg_queue_push(r, p->to[0], e);
    return status == PCG_OK ? send_copies(c, p, e, port) : status;
}

/* ---- what the host asks --------------------------------------------------------------------- */

pcg_status pcg_run_observe(pcg_run *r, pcg_observer *observer, void *user)
{
    if (r->stage != RUN_NEW)
        return run_misuse(r, "the run was executed already: it can no longer be observed");
    if (!r->program->observed)
        return run_misuse(r, "the program was not compiled to be observed");
    run_observation *w = observe_open(r);
    if (!w)
        return (pcg_status)r->status;
    w->observer = observer;
    w->user = user;
    return PCG_STATUS_OK;
}

bool pcg_run_event_input(pcg_run *r, size_t input, pcg_event_input *out)
{
    const run_observation *w = r->observed;
    if (!w || !w->about || input >= w->about->input_count)
        return false;
    out->name = w->about->inputs[input];
    out->count = w->inputs[input].count;
    return true;
}

uint64_t pcg_run_event_entity(pcg_run *r, size_t input, size_t entity)
{
    const run_observation *w = r->observed;
    if (!w || !w->about || input >= w->about->input_count || entity >= w->inputs[input].count)
        return 0;
    return observe_number(r, w->inputs[input].at[entity]);
}

pcg_entities observe_waiting(const run_observation *w, const pcg_queue *q)
{
    pcg_entities all = {q->at + q->head, q->end - q->head};
    for (pcg_u32 i = 0; w->about && all.count && i < w->about->input_count; i++)
        if (w->inputs[i].at == all.at)
            all.count = 0;
    return all;
}

static const pcg_queue *seen_queue(const run_observation *w, size_t queue)
{
    if (!w || !w->about || queue >= w->about->graph->queue_count)
        return NULL;
    const char *frame = (const char *)w->call->frame;
    return (const pcg_queue *)(frame + w->about->graph->queues[queue].offset);
}

bool pcg_run_event_queue(pcg_run *r, size_t queue, pcg_event_queue *out)
{
    const run_observation *w = r->observed;
    const pcg_queue *q = seen_queue(w, queue);
    if (!q)
        return false;
    const pcg_seen_queue *about = &w->about->graph->queues[queue];
    *out = (pcg_event_queue){about->node->name, about->port, observe_waiting(w, q).count,
                             about->leaf != 0};
    return true;
}

uint64_t pcg_run_event_waiting(pcg_run *r, size_t queue, size_t entity)
{
    const pcg_queue *q = seen_queue(r->observed, queue);
    const pcg_entities all = q ? observe_waiting(r->observed, q) : (pcg_entities){0};
    return entity < all.count ? observe_number(r, all.at[entity]) : 0;
}

/* What stands in the struct, as cells. False: it is no value, but named. */
static bool read_cells(const run_observation *w, const pcg_seen_parameter *p, pcg_cell *cells,
                       value_type *t)
{
    const char *at = (const char *)w->self + p->offset;
    *t = (value_type){p->kind, p->element, p->enumerators};
    pcg_any any;
    int number;
    switch (p->storage) {
    case PCG_SEEN_CELLS:
        memcpy(cells, at, value_width(p->kind) * sizeof *cells);
        return true;
    case PCG_SEEN_INT:
        memcpy(&number, at, sizeof number);
        cells->i = number;
        return true;
    case PCG_SEEN_ANY:
        memcpy(&any, at, sizeof any);
        t->kind = any.kind;
        memcpy(cells, any.cell, sizeof any.cell);
        return true;
    default:
        return false;
    }
}

bool observe_parameter(const pcg_run *r, size_t parameter, pcg_cell *cells, value_type *t)
{
    return read_cells(r->observed, &r->observed->about->parameters[parameter], cells, t);
}

static const pcg_seen_parameter *seen_parameter(const pcg_run *r, size_t i)
{
    const run_observation *w = r->observed;
    return w && w->about && i < w->about->parameter_count ? &w->about->parameters[i] : NULL;
}

bool pcg_run_event_parameter(pcg_run *r, size_t parameter, pcg_event_parameter *out)
{
    const pcg_seen_parameter *p = seen_parameter(r, parameter);
    if (!p)
        return false;
    run_observation *w = r->observed;
    pcg_cell cells[4];
    value_type t;
    arena_free(&w->scratch);
    w->scratch = (arena){0};
    text value = {.arena = &w->scratch};
    if (read_cells(w, p, cells, &t))
        value_write(&value, &t, cells);
    else
        text_add(&value, p->text);
    *out = (pcg_event_parameter){p->name, p->type, value.at ? value.at : ""};
    return true;
}

void observe_parameter_json(pcg_run *r, size_t parameter, text *out)
{
    const pcg_seen_parameter *p = seen_parameter(r, parameter);
    pcg_cell cells[4];
    value_type t;
    text_quote(out, p->name);
    text_add(out, ":");
    if (read_cells(r->observed, p, cells, &t))
        value_write_json(out, &t, cells);
    else
        text_quote(out, p->text);
}

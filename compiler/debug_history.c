/* debug_history.c - the view of a run at one time, moved back and forth by records. */
#include "debug_history.h"

#include <string.h>

enum { FIRST_RECORDS = 1024, FIRST_ENTITIES = 64, FIRST_WAITING = 4, FIRST_LEVELS = 8 };

/* ---- memory ---------------------------------------------------------------------------------- */

void *history_alloc(history *h, size_t bytes)
{
    void *block = run_alloc_zeroed(h->store, bytes);
    h->used += block ? bytes : 0;
    h->failed |= !block;
    return block;
}

void history_free(history *h, void *block, size_t bytes)
{
    if (!block)
        return;
    run_free(h->store, block, bytes);
    h->used -= bytes;
}

/* Doubles an array of `*capacity` items. False: no memory, and it is as it was. */
static bool grow(history *h, void **at, uint32_t *capacity, uint32_t first, size_t size)
{
    uint32_t wanted = *capacity ? *capacity * 2 : first;
    void *grown = history_alloc(h, wanted * size);
    if (!grown)
        return false;
    if (*capacity)
        memcpy(grown, *at, *capacity * size);
    history_free(h, *at, *capacity * size);
    *at = grown;
    *capacity = wanted;
    return true;
}

bool history_open(history *h, const pcg_program *p, size_t limit)
{
    const pcg_run_options options = {.size = sizeof options, .max_memory = SIZE_MAX / 2};
    *h = (history){.limit = limit, .store = pcg_run_new(p, &options)};
    if (!h->store)
        return false;
    h->capacity = FIRST_RECORDS;
    h->records = history_alloc(h, FIRST_RECORDS * sizeof *h->records);
    return h->records != NULL;
}

void history_close(history *h)
{
    pcg_run_free(h->store);
    *h = (history){0};
}

/* ---- queues ---------------------------------------------------------------------------------- */

static uint64_t *ring_slot(const seen_queue *q, uint32_t i)
{
    return &q->at[(q->head + i) & (q->capacity - 1)];
}

uint64_t seen_queue_entity(const seen_queue *q, uint32_t i)
{
    return *ring_slot(q, i);
}

static bool queue_grow(history *h, seen_queue *q)
{
    uint32_t wanted = q->capacity ? q->capacity * 2 : FIRST_WAITING;
    uint64_t *grown = history_alloc(h, wanted * sizeof *grown);
    if (!grown)
        return false;
    for (uint32_t i = 0; i < q->count; i++)
        grown[i] = *ring_slot(q, i);
    history_free(h, q->at, q->capacity * sizeof *q->at);
    q->at = grown;
    q->head = 0;
    q->capacity = wanted;
    return true;
}

static bool queue_push(history *h, seen_queue *q, uint64_t entity, bool in_front)
{
    if (q->count == q->capacity && !queue_grow(h, q))
        return false;
    if (in_front)
        q->head = (q->head - 1) & (q->capacity - 1);
    q->count++;
    *ring_slot(q, in_front ? 0 : q->count - 1) = entity;
    return true;
}

static void queue_take(seen_queue *q, bool in_front)
{
    q->count--;
    if (in_front)
        q->head = (q->head + 1) & (q->capacity - 1);
}

/* ---- entities -------------------------------------------------------------------------------- */

static uint32_t home_of(const history *h, uint64_t number)
{
    return (uint32_t)pcg_mix(number, 0) & (h->entity_capacity - 1);
}

static seen_entity *entity_slot(const history *h, uint64_t number)
{
    uint32_t i = home_of(h, number);
    while (h->entities[i].number && h->entities[i].number != number)
        i = (i + 1) & (h->entity_capacity - 1);
    return &h->entities[i];
}

static bool entities_reserve(history *h)
{
    if (h->entity_capacity && h->entity_count < h->entity_capacity / 4 * 3)
        return true;
    history old = *h;
    h->entity_capacity = old.entity_capacity ? old.entity_capacity * 2 : FIRST_ENTITIES;
    h->entities = history_alloc(h, h->entity_capacity * sizeof *h->entities);
    if (!h->entities) {
        h->entities = old.entities;
        h->entity_capacity = old.entity_capacity;
        return false;
    }
    for (uint32_t i = 0; i < old.entity_capacity; i++)
        if (old.entities[i].number)
            *entity_slot(h, old.entities[i].number) = old.entities[i];
    history_free(h, old.entities, old.entity_capacity * sizeof *old.entities);
    return true;
}

seen_entity *history_entity(history *h, uint64_t number)
{
    if (!entities_reserve(h))
        return NULL;
    seen_entity *slot = entity_slot(h, number);
    if (!slot->number) {
        slot->number = number;
        h->entity_count++;
    }
    return slot;
}

/* Closes the gap that an entry leaves, so that the search for those behind it still finds them. */
static void entity_remove(history *h, seen_entity *slot)
{
    uint32_t mask = h->entity_capacity - 1, gap = (uint32_t)(slot - h->entities);
    h->entity_count--;
    for (uint32_t i = (gap + 1) & mask; h->entities[i].number; i = (i + 1) & mask) {
        uint32_t home = home_of(h, h->entities[i].number);
        if (((i - home) & mask) >= ((i - gap) & mask)) {
            h->entities[gap] = h->entities[i];
            gap = i;
        }
    }
    h->entities[gap] = (seen_entity){0};
}

static bool set_state(history *h, uint64_t number, const seen_state *state)
{
    seen_entity *e = history_entity(h, number);
    if (!e)
        return false;
    e->state = state;
    if (!state && !e->places)
        entity_remove(h, e);
    return true;
}

const seen_state *history_state(const history *h, uint64_t entity)
{
    return h->entity_capacity ? entity_slot(h, entity)->state : NULL;
}

bool history_release(history *h, uint64_t number)
{
    seen_entity *e = history_entity(h, number);
    if (!e)
        return false;
    if (e->places > 0)
        e->places--;
    if (e->places > 0 || !e->state)
        return true;
    const seen_record gone = {.kind = SEEN_STATE, .entity = number, .state = {e->state, NULL}};
    return history_add(h, &gone);
}

/* ---- giving up the oldest -------------------------------------------------------------------- */

static void free_round(history *h, seen_round *r)
{
    history_free(h, r->taken, r->about->input_count * sizeof *r->taken);
    history_free(h, r->entities, r->entity_count * sizeof *r->entities);
    history_free(h, r->values, r->about->parameter_count * sizeof *r->values);
    history_free(h, r, sizeof *r);
}

static void free_level(history *h, seen_level *l)
{
    for (uint32_t i = 0; i < l->graph->queue_count; i++)
        history_free(h, l->queues[i].at, l->queues[i].capacity * sizeof *l->queues[i].at);
    history_free(h, l->queues, l->graph->queue_count * sizeof *l->queues);
    history_free(h, l->initial, l->cells * sizeof *l->initial);
    history_free(h, l, sizeof *l);
}

/* What only the way back behind this record needs. */
static void forget(history *h, const seen_record *r)
{
    if (r->kind == SEEN_STATE && r->state.before)
        history_free(h, (void *)(uintptr_t)r->state.before, r->state.before->bytes);
    else if (r->kind == SEEN_END)
        free_round(h, r->round);
    else if (r->kind == SEEN_LEAVE)
        free_level(h, r->level_of);
}

/* All before the next beginning of a round. */
static void forget_round(history *h)
{
    do {
        forget(h, history_record(h, h->first++));
    } while (h->first < h->end && history_record(h, h->first)->kind != SEEN_ROUND);
}

/* What belongs to a round that is under way points at its records: they stay until the next begins. */
static bool records_reserve(history *h, seen_kind next)
{
    while (next == SEEN_ROUND && h->used > h->limit && h->end - h->first > 1)
        forget_round(h);
    if (h->end - h->first < h->capacity)
        return true;
    uint64_t old = h->capacity;
    seen_record *grown = history_alloc(h, 2 * old * sizeof *grown);
    if (!grown)
        return false;
    for (uint64_t i = h->first; i < h->end; i++)
        grown[i & (2 * old - 1)] = h->records[i & (old - 1)];
    history_free(h, h->records, old * sizeof *grown);
    h->records = grown;
    h->capacity = 2 * old;
    return true;
}

/* ---- moving ---------------------------------------------------------------------------------- */

static bool push_level(history *h, seen_level *l)
{
    if (h->level_count == h->level_capacity &&
        !grow(h, (void **)&h->levels, &h->level_capacity, FIRST_LEVELS, sizeof *h->levels))
        return false;
    h->levels[h->level_count++] = l;
    return true;
}

static bool push_round(history *h, seen_round *r)
{
    if (h->open_count == h->open_capacity &&
        !grow(h, (void **)&h->open, &h->open_capacity, FIRST_LEVELS, sizeof *h->open))
        return false;
    h->open[h->open_count++] = r;
    return true;
}

/* Lets the view follow a record, or takes it back. */
static bool apply(history *h, const seen_record *r, bool forward)
{
    switch (r->kind) {
    case SEEN_ENTER:
    case SEEN_LEAVE:
        if ((r->kind == SEEN_ENTER) == forward)
            return push_level(h, r->level_of);
        h->level_count--;
        return true;
    case SEEN_ROUND:
    case SEEN_END:
        if ((r->kind == SEEN_ROUND) == forward)
            return push_round(h, r->round);
        h->open_count--;
        return true;
    case SEEN_PUSH:
    case SEEN_TAKE: {
        seen_queue *q = &h->levels[r->level]->queues[r->queue];
        if ((r->kind == SEEN_PUSH) == forward)
            return queue_push(h, q, r->entity, !forward);
        queue_take(q, forward);
        return true;
    }
    case SEEN_STATE:
        return set_state(h, r->entity, forward ? r->state.after : r->state.before);
    case SEEN_SENT:
        return true;
    }
    return true;
}

bool history_add(history *h, const seen_record *r)
{
    if (!records_reserve(h, r->kind) || !apply(h, r, true))
        return false;
    *history_record(h, h->end++) = *r;
    h->cursor = h->end;
    return true;
}

const seen_record *history_last(const history *h)
{
    return h->cursor > h->first ? history_record(h, h->cursor - 1) : NULL;
}

bool history_back(history *h)
{
    if (h->cursor == h->first)
        return false;
    return apply(h, history_record(h, --h->cursor), false);
}

bool history_forward(history *h)
{
    if (h->cursor == h->end)
        return false;
    return apply(h, history_record(h, h->cursor++), true);
}

/* ---- looking --------------------------------------------------------------------------------- */

seen_round *history_round(const history *h)
{
    return h->open_count ? h->open[h->open_count - 1] : NULL;
}

seen_level *history_level(const history *h)
{
    uint32_t inner = h->open_count ? h->open_count - 1 : 0;
    return inner < h->level_count ? h->levels[inner] : NULL;
}

const pcg_cell *seen_attribute(const seen_level *l, uint32_t attribute, const seen_state *s,
                               bool *written)
{
    const pcg_attribute_info *a = &l->graph->attributes[attribute];
    const pcg_entity shown = {.attributes = s->attributes};
    const pcg_cell *at = pcg_attribute(&shown, (int)(l->frame->base + a->cell));
    *written = at != NULL;
    return at ? at : &l->initial[a->cell];
}

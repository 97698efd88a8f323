/* debug_record.c - what an observed run tells, as records of its history.
 *
 * An event names the round; what waits in the queues of its graph is looked at there and compared
 * with the view. Gates pass entities on without an event, and an encapsulated graph's queues are
 * filled by the code around it: what such steps moved is seen at the next event. */
#include "debug_history.h"

#include <string.h>

/* Of a queue whose entities may change while they wait, so many are looked at again each time. */
enum { LOOKED_AT_AGAIN = 256 };

/* ---- entities -------------------------------------------------------------------------------- */

static seen_state state_of(const pcg_entity *e)
{
    seen_state s = {.type = e->type, .maker = e->maker, .attributes = e->attributes};
    s.bytes = sizeof s + (e->attributes ? attributes_bytes(e->attributes) : 0);
    s.is_shape = pcg_entity_is(e, &pcg_type_shape);
    if (s.is_shape) {
        const pcg_shape *shape = (const pcg_shape *)e;
        s.scope = shape->scope;
        s.faces = shape->mesh->face_count;
        s.vertices = shape->mesh->vertex_count;
    }
    return s;
}

static bool same_attributes(const seen_state *a, const seen_state *b)
{
    size_t head = offsetof(struct pcg_attributes, present);
    if (a->bytes != b->bytes || !a->attributes || !b->attributes)
        return a->attributes == b->attributes;
    return a->attributes->cells == b->attributes->cells &&
           !memcmp((char *)a->attributes + head, (char *)b->attributes + head,
                   a->bytes - sizeof *a - head);
}

static bool same_state(const seen_state *a, const seen_state *b)
{
    return a->type == b->type && a->maker == b->maker && a->faces == b->faces &&
           a->vertices == b->vertices && !memcmp(&a->scope, &b->scope, sizeof a->scope) &&
           same_attributes(a, b);
}

/* The entity is as it is now. */
static bool look_at(history *h, const pcg_entity *e, uint64_t number)
{
    const seen_state *before = history_state(h, number), now = state_of(e);
    if (before && same_state(before, &now))
        return true;
    seen_state *kept = history_alloc(h, now.bytes);
    if (!kept)
        return false;
    *kept = now;
    if (now.attributes) {
        kept->attributes = (struct pcg_attributes *)(kept + 1);
        memcpy(kept->attributes, now.attributes, now.bytes - sizeof now);
    }
    const seen_record r = {.kind = SEEN_STATE, .entity = number, .state = {before, kept}};
    return history_add(h, &r);
}

static bool hold(history *h, uint64_t number)
{
    seen_entity *e = history_entity(h, number);
    if (e)
        e->places++;
    return e != NULL;
}

/* ---- queues ---------------------------------------------------------------------------------- */

static bool push(history *h, uint32_t level, uint32_t queue, uint64_t entity)
{
    const seen_record r = {.kind = SEEN_PUSH, .level = level, .queue = queue, .entity = entity};
    h->levels[level]->queues[queue].fresh++;
    return hold(h, entity) && history_add(h, &r);
}

static bool take(history *h, uint32_t level, uint32_t queue)
{
    const seen_queue *q = &h->levels[level]->queues[queue];
    const seen_record r = {
        .kind = SEEN_TAKE, .level = level, .queue = queue, .entity = seen_queue_entity(q, 0)};
    return history_add(h, &r) && history_release(h, r.entity);
}

static pcg_queue *queue_of(const seen_level *l, uint32_t queue)
{
    return (pcg_queue *)((char *)l->frame + l->graph->queues[queue].offset);
}

static bool is_in_step(pcg_run *r, const seen_queue *q, const pcg_entities *all)
{
    if (q->count != all->count)
        return false;
    return !q->count ||
           (seen_queue_entity(q, 0) == observe_number(r, all->at[0]) &&
            seen_queue_entity(q, q->count - 1) == observe_number(r, all->at[all->count - 1]));
}

/* Whether what is known of the queue, but its first `taken`, is how it begins now. */
static bool follows(pcg_run *r, const seen_queue *q, const pcg_entities *all, uint32_t taken)
{
    for (uint32_t i = taken; i < q->count; i++)
        if (i - taken >= all->count ||
            seen_queue_entity(q, i) != observe_number(r, all->at[i - taken]))
            return false;
    return true;
}

static bool follow_queue(history *h, pcg_run *r, uint32_t level, uint32_t queue,
                         const pcg_entities *all)
{
    const seen_queue *q = &h->levels[level]->queues[queue];
    uint32_t taken = q->count > all->count ? q->count - all->count : 0;
    while (!follows(r, q, all, taken))
        taken++;
    for (; taken; taken--)
        if (!take(h, level, queue))
            return false;
    for (uint32_t i = q->count; i < all->count; i++) {
        uint64_t number = observe_number(r, all->at[i]);
        if (!push(h, level, queue, number) || !look_at(h, all->at[i], number))
            return false;
    }
    return true;
}

/* Something else holds an entity of them: a change there is one here. */
static bool look_at_shared(history *h, pcg_run *r, seen_queue *q, const pcg_entities *all)
{
    for (; q->fresh && q->fresh <= all->count; q->fresh--)
        q->shared |= all->at[all->count - q->fresh]->references > 1;
    q->fresh = 0;
    q->shared &= all->count > 0;
    for (uint32_t i = 0; q->shared && i < all->count && i < LOOKED_AT_AGAIN; i++)
        if (!look_at(h, all->at[i], observe_number(r, all->at[i])))
            return false;
    return true;
}

static bool follow_queues(history *h, pcg_run *r, uint32_t level)
{
    const seen_level *l = h->levels[level];
    for (uint32_t i = 0; i < l->graph->queue_count; i++) {
        const pcg_entities all = observe_waiting(r->observed, queue_of(l, i));
        seen_queue *q = &l->queues[i];
        if (!is_in_step(r, q, &all) && !follow_queue(h, r, level, i, &all))
            return false;
        if ((q->fresh || q->shared) && !look_at_shared(h, r, q, &all))
            return false;
    }
    return true;
}

/* ---- graphs ---------------------------------------------------------------------------------- */

static void take_defaults(seen_level *l)
{
    for (uint32_t i = 0; i < l->graph->attribute_count; i++) {
        const pcg_attribute_info *a = &l->graph->attributes[i];
        memcpy(l->initial + a->cell, (char *)l->frame + a->initial,
               value_width(a->kind) * sizeof *l->initial);
    }
}

static bool enter(history *h, pcg_frame *frame, const pcg_seen_graph *graph)
{
    seen_level *l = history_alloc(h, sizeof *l);
    if (!l)
        return false;
    *l = (seen_level){.frame = frame, .graph = graph};
    for (uint32_t i = 0; i < graph->attribute_count; i++)
        l->cells += value_width(graph->attributes[i].kind);
    l->queues = history_alloc(h, graph->queue_count * sizeof *l->queues);
    l->initial = history_alloc(h, l->cells * sizeof *l->initial);
    if (!l->queues || !l->initial)
        return false;
    take_defaults(l);
    const seen_record r = {.kind = SEEN_ENTER, .level_of = l};
    return history_add(h, &r);
}

/* The graphs that execute below `level` are done. */
static bool leave_below(history *h, uint32_t level)
{
    while (h->level_count > level + 1) {
        uint32_t inner = h->level_count - 1;
        seen_level *l = h->levels[inner];
        for (uint32_t i = 0; i < l->graph->queue_count; i++)
            while (l->queues[i].count)
                if (!take(h, inner, i))
                    return false;
        const seen_record r = {.kind = SEEN_LEAVE, .level_of = l};
        if (!history_add(h, &r))
            return false;
    }
    return true;
}

/* ---- events ---------------------------------------------------------------------------------- */

static bool take_inputs(history *h, pcg_run *r, seen_round *round)
{
    const run_observation *w = r->observed;
    uint32_t at = 0;
    for (uint32_t i = 0; i < w->about->input_count; i++) {
        round->taken[i] = w->inputs[i].count;
        for (uint32_t k = 0; k < w->inputs[i].count; k++) {
            uint64_t number = observe_number(r, w->inputs[i].at[k]);
            round->entities[at++] = number;
            if (!hold(h, number) || !look_at(h, w->inputs[i].at[k], number))
                return false;
        }
    }
    return true;
}

static seen_round *round_new(history *h, const pcg_run *r)
{
    const run_observation *w = r->observed;
    seen_round *round = history_alloc(h, sizeof *round);
    if (!round)
        return NULL;
    *round = (seen_round){
        .id = ++h->rounds, .number = w->call->round, .node = w->call->node, .about = w->about};
    for (uint32_t i = 0; i < w->about->input_count; i++)
        round->entity_count += w->inputs[i].count;
    round->taken = history_alloc(h, w->about->input_count * sizeof *round->taken);
    round->entities = history_alloc(h, round->entity_count * sizeof *round->entities);
    round->values = history_alloc(h, w->about->parameter_count * sizeof *round->values);
    return round->taken && round->entities && round->values ? round : NULL;
}

static bool begin_round(history *h, pcg_run *r)
{
    const run_observation *w = r->observed;
    uint32_t level = h->open_count;
    if (h->level_count > level && h->levels[level]->frame != w->call->frame && level > 0 &&
        !leave_below(h, level - 1))
        return false;
    if (h->level_count == level && !enter(h, w->call->frame, w->about->graph))
        return false;
    seen_round *round = round_new(h, r);
    if (!round || !take_inputs(h, r, round) || !follow_queues(h, r, level))
        return false;
    for (uint32_t i = 0; i < w->about->parameter_count; i++)
        round->values[i].named =
            !observe_parameter(r, i, round->values[i].cells, &round->values[i].type);
    const seen_record begun = {.kind = SEEN_ROUND, .level = level, .round = round};
    return history_add(h, &begun);
}

static bool end_round(history *h, pcg_run *r)
{
    uint32_t level = h->open_count - 1;
    seen_round *round = h->open[level];
    const seen_record ended = {.kind = SEEN_END, .level = level, .round = round};
    if (!leave_below(h, level) || !follow_queues(h, r, level) || !history_add(h, &ended))
        return false;
    for (uint32_t i = 0; i < round->entity_count; i++)
        if (!history_release(h, round->entities[i]))
            return false;
    return true;
}

/* The queue of the level that lies there; SEEN_NOWHERE: none. */
static uint32_t find_queue(const seen_level *l, const pcg_queue *q)
{
    uint32_t low = 0, high = l->graph->queue_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if ((const char *)queue_of(l, middle) < (const char *)q)
            low = middle + 1;
        else
            high = middle;
    }
    return low < l->graph->queue_count && queue_of(l, low) == q ? low : SEEN_NOWHERE;
}

static bool send(history *h, pcg_run *r, const pcg_event *e)
{
    const run_observation *w = r->observed;
    uint32_t level = h->open_count - 1;
    if (!leave_below(h, level))
        return false;
    const seen_state *before = history_state(h, e->entity);
    uint32_t queue = w->to ? find_queue(h->levels[level], w->to) : SEEN_NOWHERE;
    h->pending = (seen_record){.kind = SEEN_SENT,
                               .level = level,
                               .queue = queue,
                               .entity = e->entity,
                               .sent = {e->port, e->original, before}};
    h->has_pending = true;
    return look_at(h, w->entity, e->entity) && history_add(h, &h->pending);
}

/* What was sent has arrived by now; or it is gone. */
static bool arrive(history *h)
{
    const seen_record *p = &h->pending;
    if (!h->has_pending)
        return true;
    h->has_pending = false;
    return p->queue == SEEN_NOWHERE ? history_release(h, p->entity)
                                    : push(h, p->level, p->queue, p->entity);
}

bool history_take(history *h, pcg_run *r, const pcg_event *e)
{
    if (!arrive(h))
        return false;
    if (e->kind == PCG_EVENT_ROUND)
        return begin_round(h, r);
    if (!h->open_count)
        return true;
    return e->kind == PCG_EVENT_SENT ? send(h, r, e) : end_round(h, r);
}

bool history_finish(history *h)
{
    return arrive(h);
}

/* parallel.c - the surrogate `parallel`: its rounds are put off until no more are to come, run by a
 * crew, and taken in their order. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "crew.h"
#include "list.h"
#include "value.h"

/* ---- putting off ---------------------------------------------------------------------------- */

/* Who watches a run sees its rounds in order. */
bool parallel_puts_off(pcg_call *c, pcg_surrogate *s)
{
    const pcg_run *r = c->run;
    return s->info->kind == PCG_SURROGATE_PARALLEL && !s->choice->module->tied && !r->observed &&
           !r->is_worker;
}

static pcg_batch *batch_of(pcg_call *c, pcg_surrogate *s)
{
    if (!s->batch)
        s->batch = run_alloc_zeroed(c->run, sizeof *s->batch);
    if (s->batch)
        s->batch->surrogate = s;
    return s->batch;
}

int parallel_enter(pcg_call *c, pcg_surrogate *s, pcg_u32 input, pcg_entity *e)
{
    pcg_batch *b = batch_of(c, s);
    batch_item *i = b ? &b->next : NULL;
    if (!b || list_room(c->run, (void **)&i->entered, &i->entered_capacity, i->entered_count, 1,
                        sizeof *i->entered) != PCG_OK) {
        pcg_entity_drop(c->run, e);
        return PCG_FAILED;
    }
    i->entered[i->entered_count++] = (batch_entity){input, e};
    if (!parcel_is_alone(e))
        i->stage = BATCH_HERE;
    return PCG_OK;
}

static pcg_u32 given_cells(const pcg_surrogate *s)
{
    pcg_u32 count = 0;
    for (pcg_u32 i = 0; i < s->info->parameter_count; i++)
        count += value_width(s->choice->parameters[i]->kind);
    return count;
}

/* The parameters' cells of the choice's frame from, or to, an item's. */
static void copy_given(const pcg_surrogate *s, const pcg_choice *k, pcg_cell *item, bool to_frame)
{
    for (pcg_u32 i = 0; i < s->info->parameter_count; i++) {
        const pcg_parameter_info *p = k->parameters[i];
        pcg_cell *own = choice_at(k, p->offset);
        size_t size = value_width(p->kind) * sizeof *own;
        memcpy(to_frame ? own : item, to_frame ? item : own, size);
        item += value_width(p->kind);
    }
}

/* When, in an execution one by one, the graph would be started: for this round, or an earlier one.
 */
static void note_start(pcg_call *c, pcg_surrogate *s, batch_item *i)
{
    pcg_choice *k = s->choice;
    i->first = surrogate_is_stale(s);
    if (i->first) {
        k->starts++;
        k->start_lineage = c->lineage;
        k->stale = false;
        k->execution = s->execution;
    }
    i->start = k->starts;
    i->start_lineage = k->start_lineage;
}

int parallel_put_off(pcg_call *c, pcg_surrogate *s, const pcg_entity *impulse)
{
    pcg_batch *b = batch_of(c, s);
    if (!b || list_room(c->run, (void **)&b->items, &b->capacity, b->count, 1, sizeof *b->items) !=
                  PCG_OK)
        return PCG_FAILED;
    batch_item *i = &b->next;
    i->choice = s->choice;
    i->lineage = c->lineage;
    i->impulse = impulse ? pcg_entity_hold((pcg_entity *)(uintptr_t)impulse) : NULL;
    i->given = run_alloc_array(c->run, given_cells(s), sizeof *i->given);
    if (!i->given)
        return PCG_FAILED;
    copy_given(s, s->choice, i->given, false);
    note_start(c, s, i);
    b->items[b->count++] = *i;
    b->next = (batch_item){0};
    return b->count < BATCH_ITEMS_MAX ? PCG_OK : parallel_finish(c, s);
}

/* ---- one by one ----------------------------------------------------------------------------- */

static int enter_frame(pcg_call *c, pcg_choice *k, batch_item *i)
{
    pcg_u32 count = i->entered_count;
    i->entered_count = 0;
    for (pcg_u32 n = 0; n < count; n++)
        PCG_TRY(pcg_queue_push(c->run, k->inputs[i->entered[n].input], i->entered[n].entity));
    return PCG_OK;
}

static int run_frame(pcg_choice *k, const batch_item *i)
{
    if (k->start != i->start) {
        k->frame->lineage = i->start_lineage;
        PCG_TRY((k->started ? k->module->restart : k->module->start)(k->frame));
        k->started = true;
        k->start = i->start;
    }
    k->frame->lineage = i->lineage;
    ((pcg_graph *)k->frame)->impulse = i->impulse;
    return k->module->run(k->frame);
}

/* In the main run itself. The frame holds the parameters of the newest round, which stay. */
static int run_here(pcg_call *c, pcg_surrogate *s, batch_item *i)
{
    pcg_choice *k = s->choice = i->choice;
    pcg_run *r = c->run;
    pcg_cell *newest = run_alloc_array(r, given_cells(s), sizeof *newest);
    if (!newest)
        return r->status;
    PCG_TRY(enter_frame(c, k, i));
    copy_given(s, k, newest, false);
    copy_given(s, k, i->given, true);
    r->by_module = true;
    int status = run_frame(k, i);
    r->by_module = false;
    copy_given(s, k, newest, true);
    run_free(r, newest, given_cells(s) * sizeof *newest);
    return status == PCG_OK ? surrogate_leave(c, s) : status;
}

/* ---- taking --------------------------------------------------------------------------------- */

static void close_item(pcg_run *r, pcg_surrogate *s, batch_item *i)
{
    free(i->result);
    for (pcg_u32 n = 0; n < i->entered_count; n++)
        pcg_entity_drop(r, i->entered[n].entity);
    if (i->impulse)
        pcg_entity_drop(r, i->impulse);
    run_free(r, i->entered, i->entered_capacity * sizeof *i->entered);
    s->choice = i->choice;
    run_free(r, i->given, given_cells(s) * sizeof *i->given);
    *i = (batch_item){0};
}

/* Whether it would have met a limit here; then it does. */
static bool is_within_limits(const pcg_run *r, const batch_item *i)
{
    return i->rounds <= r->max_rounds - r->rounds &&
           i->most_entities <= r->max_entities - r->entities;
}

/* Those that a worker has met in packing: what entered in order, then the impulse. */
static int origins_of(pcg_run *r, const batch_item *i, pcg_packer *p)
{
    *p = (pcg_packer){.run = r, .flags = PARCEL_LOCAL, .cell = -1};
    for (pcg_u32 n = 0; n < i->entered_count; n++)
        pack_entity(p, i->entered[n].entity);
    if (i->impulse)
        pack_entity(p, i->impulse);
    return pack_status(p);
}

static int take_result(pcg_call *c, pcg_surrogate *s, batch_item *i)
{
    pcg_run *r = c->run;
    pcg_packer origins;
    int status = origins_of(r, i, &origins);
    pcg_unpacker u = {.run = r,
                      .flags = PARCEL_LOCAL | PARCEL_LINEAGE,
                      .at = i->result,
                      .end = i->result + i->result_length,
                      .origins = origins.entities,
                      .origin_count = origins.entity_count,
                      .cell = -1};
    r->rounds += i->rounds;
    r->drawn |= i->drawn;
    s->choice = i->choice;
    if (status == PCG_OK)
        status = outcome_take(&u, c, s, false);
    unpacker_close(&u);
    packer_close(&origins);
    return u.failed && status == PCG_OK ? run_here(c, s, i) : status;
}

static int settle(pcg_call *c, pcg_surrogate *s, batch_item *i)
{
    PCG_TRY(pcg_tick(c));
    if (i->stage == BATCH_DONE && is_within_limits(c->run, i))
        return take_result(c, s, i);
    return run_here(c, s, i);
}

/* ---- finishing ------------------------------------------------------------------------------ */

static pcg_u32 threads_of(const pcg_run *r, const pcg_surrogate *s)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    pcg_u64 wanted = s->threads ? (pcg_u64)s->threads : processors > 0 ? (pcg_u64)processors : 1;
    if (r->threads && wanted > r->threads)
        wanted = r->threads;
    return wanted < CREW_THREADS_MAX ? (pcg_u32)wanted : CREW_THREADS_MAX;
}

/* A graph whose parts cannot go from thread to thread is found out once. */
static bool wants_threads(const pcg_batch *b)
{
    for (pcg_u32 i = 0; i < b->count; i++)
        if (b->items[i].choice->alone)
            return false;
    return b->count > 1;
}

static int settle_all(pcg_call *c, pcg_surrogate *s, bool in_threads)
{
    pcg_batch *b = s->batch;
    for (pcg_u32 i = 0; i < b->count; i++) {
        if (in_threads)
            PCG_TRY(crew_wait(c, i));
        b->items[i].choice->alone |= b->items[i].stage == BATCH_FAILED;
        PCG_TRY(settle(c, s, &b->items[i]));
        close_item(c->run, s, &b->items[i]);
    }
    return PCG_OK;
}

int parallel_finish(pcg_call *c, pcg_surrogate *s)
{
    pcg_batch *b = s->batch;
    pcg_choice *choice = s->choice;
    if (s->threads < 0)
        return pcg_fail(c, "cannot run in %lld threads", s->threads);
    pcg_u32 threads = threads_of(c->run, s);
    bool in_threads = threads > 1 && wants_threads(b) && crew_begin(c, b, threads);
    int status = settle_all(c, s, in_threads);
    if (in_threads)
        crew_end(c->run);
    for (pcg_u32 i = 0; i < b->count; i++)
        if (b->items[i].choice)
            close_item(c->run, s, &b->items[i]);
    b->count = 0;
    s->choice = choice;
    return status;
}

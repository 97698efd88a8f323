/* run.c - runs: making, executing, limits, progress, cancelling. */
#include "run.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <time.h>

#include "result.h"
#include "value.h"
#include "crew.h"
#include "observe.h"
#include "part.h"

_Static_assert((int)PCG_OK == (int)PCG_STATUS_OK && (int)PCG_FAILED == (int)PCG_STATUS_FAILED &&
                   (int)PCG_LIMIT == (int)PCG_STATUS_LIMIT &&
                   (int)PCG_CANCELLED == (int)PCG_STATUS_CANCELLED &&
                   (int)PCG_MISUSE == (int)PCG_STATUS_MISUSE,
               "a status is the same inside and outside");

static const pcg_run_options default_options = {
    .size = sizeof(pcg_run_options),
    .max_rounds = 1000000000,
    .max_entities = 100000000,
    .max_depth = 1000,
    .max_memory = (size_t)16 << 30,
};

/* No more than three quarters of the machine's memory: beyond that the system ends the process. */
static size_t default_memory(void)
{
    long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    size_t most = pages > 0 && size > 0 ? (size_t)pages / 4 * 3 * (size_t)size : SIZE_MAX;
    return most < default_options.max_memory ? most : default_options.max_memory;
}

enum {
    MILLISECOND = 1000000,
    PROGRESS_EVERY = 100 * MILLISECOND,
    LOOK_TOO_LATE = 20 * MILLISECOND
};

/* ---- clock ---------------------------------------------------------------------------------- */

pcg_int run_clock(void)
{
    struct timespec now;
#ifdef CLOCK_MONOTONIC_COARSE
    clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
#else
    clock_gettime(CLOCK_MONOTONIC, &now);
#endif
    return (pcg_int)now.tv_sec * 1000 * MILLISECOND + now.tv_nsec;
}

static double seconds_since(pcg_int then, pcg_int now)
{
    return (double)(now - then) * 1e-9;
}

/* ---- limits --------------------------------------------------------------------------------- */

/* "16 GiB": in the largest unit that divides it, or about it where none does. */
static void write_size(char *out, size_t room, size_t bytes)
{
    static const char *const names[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    size_t unit = 0, n = bytes;
    while (unit + 1 < COUNT_OF(names) && n && n % 1024 == 0) {
        n /= 1024;
        unit++;
    }
    snprintf(out, room, "%zu %s", n, n == 1 && !unit ? "byte" : names[unit]);
}

void run_out_of_memory(pcg_run *r, size_t size)
{
    char limit[40], asked[40];
    if (r->status != PCG_OK)
        return;
    /* A block may need up to a head, and its class, more than was asked for. */
    size_t room = r->memory.limit - r->memory.used, need = run_capacity(size);
    bool limited = need > room || room - need < MEMORY_HEAD_MAX;
    write_size(limit, sizeof limit, limited ? r->memory.limit : r->memory.used);
    write_size(asked, sizeof asked, size);
    if (limited)
        run_fail(r, PCG_LIMIT, DIAG_E0706, r->node, r->round, limit);
    else
        run_fail(r, PCG_LIMIT, DIAG_E0707, r->node, r->round, limit, asked);
}

static int stop_cancelled(pcg_run *r)
{
    if (r->status == PCG_OK) {
        r->status = PCG_CANCELLED;
        strcpy(r->messages.error, "the run was cancelled");
    }
    return r->status;
}

/* Rounds take nanoseconds or seconds: the clock is looked at as often as keeps the limits and the
 * progress in time. */
static void set_period(pcg_run *r, pcg_int now)
{
    pcg_int passed = now - r->looked;
    r->looked = now;
    if (passed > LOOK_TOO_LATE)
        r->period = 1;
    else if (r->period < RUN_CLOCK_PERIOD)
        r->period *= 2;
    r->patience = r->period;
}

static void tell_progress(pcg_run *r, pcg_int now)
{
    const pcg_progress p = {.size = sizeof p,
                            .node = r->node ? r->node->name : NULL,
                            .rounds = r->rounds,
                            .entities = r->entities,
                            .memory = r->memory.used + r->messages.arena.used,
                            .seconds = seconds_since(r->started, now)};
    r->told = now;
    if (r->progress(r->user, &p))
        pcg_run_cancel(r);
}

int run_look(pcg_run *r)
{
    r->patience = r->period;
    if (r->status != PCG_OK)
        return r->status;
    if (result_cancelled(r))
        return stop_cancelled(r);
    pcg_int now = run_clock();
    set_period(r, now);
    if (r->max_seconds > 0 && seconds_since(r->started, now) > r->max_seconds) {
        char limit[VALUE_NUMBER_BYTES];
        value_number(limit, r->max_seconds);
        return run_fail(r, PCG_LIMIT, DIAG_E0708, r->node, r->round, limit);
    }
    if (r->progress && now - r->told >= PROGRESS_EVERY)
        tell_progress(r, now);
    return result_cancelled(r) ? stop_cancelled(r) : PCG_OK;
}

/* ---- making --------------------------------------------------------------------------------- */

/* What the host gave, over the defaults; a host of an older version gave less. */
static pcg_run_options options_of(const pcg_run_options *given)
{
    pcg_run_options o = {0};
    if (given)
        memcpy(&o, given, given->size < sizeof o ? given->size : sizeof o);
    if (!o.max_rounds)
        o.max_rounds = default_options.max_rounds;
    if (!o.max_entities)
        o.max_entities = default_options.max_entities;
    if (!o.max_depth)
        o.max_depth = default_options.max_depth;
    if (!o.max_memory)
        o.max_memory = default_memory();
    if (!(o.max_seconds > 0))
        o.max_seconds = 0;
    return o;
}

/* The environment's word, for builds and tests that want to be sure. */
static bool is_cache_off(void)
{
    const char *word = getenv("PCG_NO_CACHE");
    return word && *word;
}

static void take_options(pcg_run *r, const pcg_run_options *o)
{
    r->seed = o->seed;
    r->strict = o->strict;
    r->max_rounds = o->max_rounds;
    r->max_entities = o->max_entities;
    r->flow.batch = RUN_FLOW_BATCH;
    r->max_depth = o->max_depth;
    r->max_seconds = o->max_seconds;
    r->threads = o->threads;
    r->max_cache = o->max_cache;
    r->no_cache = o->no_cache || is_cache_off();
    r->message = o->message;
    r->progress = o->progress;
    r->user = o->user;
}

bool loaded_open(pcg_run *r, pcg_loaded *l, const pcg_program *p)
{
    l->program = p;
    l->module = p->module;
    l->sent = run_alloc_array(r, p->module->port_count, sizeof *l->sent);
    l->worked = run_alloc_array(r, p->module->node_count, sizeof *l->worked);
    return l->sent && l->worked;
}

/* What the run needs for its module. Where that fails the run has failed, and says so when it is
 * executed. */
static void take_memory(pcg_run *r)
{
    const pcg_module *m = r->module;
    loaded_open(r, &r->own, r->program);
    r->outputs = run_alloc_array(r, m->output_count, sizeof *r->outputs);
    if (r->status != PCG_OK)
        return;
    r->frame = run_alloc_zeroed(r, m->frame_size);
    if (!r->frame)
        return;
    r->frame->run = r;
    r->frame->key = pcg_mix(r->seed, 0);
    loaded_take(r->frame, &r->own);
}

pcg_run *pcg_run_new(const pcg_program *p, const pcg_run_options *options)
{
    const pcg_run_options o = options_of(options);
    pcg_run *r = p ? calloc(1, sizeof *r) : NULL;
    if (!r)
        return NULL;
    memory_open(&r->memory, o.max_memory);
    atomic_init(&r->attention, 0);
    take_options(r, &o);
    r->program = p;
    r->module = p->module;
    r->period = r->patience = 1;
    take_memory(r);
    if (o.provenance && observe_open(r))
        r->observed->ways = true;
    return r;
}

void run_ending_add(pcg_run *r, run_ending *e)
{
    e->next = r->endings;
    r->endings = e;
}

void run_ending_remove(pcg_run *r, run_ending *e)
{
    run_ending **at = &r->endings;
    while (*at && *at != e)
        at = &(*at)->next;
    if (*at)
        *at = e->next;
}

void pcg_run_free(pcg_run *r)
{
    if (!r)
        return;
    while (r->endings) {
        run_ending *e = r->endings;
        r->endings = e->next;
        e->end(e->context);
    }
    crew_close(r);
    views_close(r);
    observe_close(r);
    messages_close(r);
    loading_close(r);
    memory_close(&r->memory);
    free(r);
}

/* ---- executing ------------------------------------------------------------------------------ */

static void collect_outputs(pcg_run *r)
{
    for (pcg_u32 i = 0; i < r->module->output_count; i++) {
        const pcg_queue *q = run_at(r, r->module->outputs[i].queue);
        r->outputs[i].at = q->at ? q->at + q->head : NULL;
        r->outputs[i].count = q->end - q->head;
    }
}

static void run_module(pcg_run *r)
{
    int status = r->module->start(r->frame);
    if (status == PCG_OK && r->status == PCG_OK)
        status = r->module->run(r->frame);
    if (status != PCG_OK && r->status == PCG_OK)
        run_fail(r, status == PCG_LIMIT ? PCG_LIMIT : PCG_FAILED, DIAG_E0701, r->node, r->round,
                 "it stopped without saying why");
}

pcg_status pcg_run_execute(pcg_run *r)
{
    if (r->stage != RUN_NEW)
        return run_misuse(r, "the run was executed already: make another one");
    r->stage = RUN_EXECUTING;
    r->started = r->looked = r->told = run_clock();
    if (result_cancelled(r))
        stop_cancelled(r);
    if (r->status == PCG_OK)
        run_module(r);
    parts_settle(r);
    flow_tell(r);
    r->stage = RUN_EXECUTED;
    total_sort(r);
    if (r->status == PCG_OK) {
        collect_outputs(r);
        report_profiles(r);
        report_silence(r);
    }
    return (pcg_status)r->status;
}

void pcg_run_cancel(pcg_run *r)
{
    if (r)
        atomic_fetch_or_explicit(&r->attention, ATTENTION_CANCEL, memory_order_relaxed);
}

const char *pcg_run_error(const pcg_run *r)
{
    return r ? r->messages.error : "out of memory";
}

bool result_cancelled(const pcg_run *r)
{
    return atomic_load_explicit(&((pcg_run *)(uintptr_t)r)->attention, memory_order_relaxed) &
           ATTENTION_CANCEL;
}

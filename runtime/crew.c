/* crew.c - workers: each in a thread, while a batch lasts, with a run that stays. */

#include "crew.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "value.h"

enum { WAIT_MILLISECONDS = 10 };

/* A choice of the main run, as a worker runs it. */
typedef struct worker_choice {
    struct worker_choice *next;
    const pcg_choice *of;
    pcg_frame parent; /* stands for the frame of the graph around it */
    pcg_choice own;
} worker_choice;

typedef struct worker {
    struct run_crew *crew;
    pcg_run *run;
    worker_choice *choices;
    pthread_t thread;
    bool is_broken; /* an execution broke off: its frames hold what is left of it */
} worker;

typedef struct crew_graph {
    const char *key;
    const pcg_program *program;
} crew_graph;

/* What the threads share is written under the lock. */
typedef struct run_crew {
    pthread_mutex_t lock;
    pthread_cond_t done, room;
    pcg_batch *batch;
    pcg_u32 next, taken;   /* items that were begun, and that were waited for */
    pcg_u32 working;       /* threads that may still begin one */
    bool stop;
    worker *workers[CREW_THREADS_MAX];
    pcg_u32 worker_count, thread_count;
    pthread_mutex_t loading; /* held while a run looks for a graph, and loads it */
    LIST(crew_graph) graphs; /* that one of the runs has loaded */
    arena arena;
} run_crew;

/* ---- choices -------------------------------------------------------------------------------- */

static pcg_loaded *loaded_like(pcg_run *r, const pcg_loaded *main)
{
    for (pcg_loaded *l = &r->own; l; l = l->next)
        if (l->program == main->program)
            return l;
    pcg_loaded *l = loaded_add(r, main->program, main->key);
    if (l)
        l->borrowed = true;
    return l;
}

/* Cell 0 is for origins; none of the graphs around it has any here. */
static bool open_choice(worker *w, worker_choice *k)
{
    pcg_run *r = w->run;
    const pcg_choice *of = k->of;
    const pcg_frame *around = of->frame->parent;
    k->parent.run = r;
    k->parent.key = around->key;
    k->parent.depth = around->depth;
    k->own.module = of->module;
    k->own.loaded = loaded_like(r, of->loaded);
    k->own.parameters = of->parameters;
    k->own.attributes = of->attributes;
    k->own.outputs = of->outputs;
    if (!k->own.loaded)
        return false;
    loaded_take(&k->parent, k->own.loaded);
    if (choice_open(&k->own, w->crew->batch->surrogate->info, &k->parent, of->node, 1) != PCG_OK)
        return false;
    k->own.below = 0;
    k->own.origin = 0;
    return true;
}

static worker_choice *choice_like(worker *w, const pcg_choice *of)
{
    for (worker_choice *k = w->choices; k; k = k->next)
        if (k->of == of)
            return k;
    worker_choice *k = run_alloc_zeroed(w->run, sizeof *k);
    if (!k)
        return NULL;
    k->of = of;
    if (!open_choice(w, k))
        return NULL;
    k->next = w->choices;
    w->choices = k;
    return k;
}

/* ---- entering ------------------------------------------------------------------------------- */

/* What is handed in lies in cells from the main frame's base on. */
static void pack_handed(pcg_packer *p, const pcg_surrogate *s, const batch_item *i, pcg_entity *e)
{
    for (pcg_u32 a = 0; a < s->info->attribute_count; a++) {
        const pcg_cell *value = pcg_attribute(e, i->choice->slots[a].cell);
        pack_u32(p, value != NULL);
        if (value)
            pack_value(p, i->choice->attributes[a]->kind, i->choice->attributes[a]->element, value);
    }
}

static pcg_entity *unpack_handed(pcg_unpacker *u, const pcg_surrogate *s, worker_choice *k)
{
    pcg_entity *e = unpack_entity(u);
    for (pcg_u32 a = 0; e && a < s->info->attribute_count; a++) {
        pcg_cell value[4];
        if (!unpack_u32(u))
            continue;
        unpack_value(u, k->own.attributes[a]->kind, k->own.attributes[a]->element, value);
        pcg_set_cells(u->run, e, &k->own.slots[a], value);
    }
    return e;
}

static void pack_item(pcg_packer *p, const pcg_surrogate *s, const batch_item *i)
{
    for (pcg_u32 n = 0; n < i->entered_count; n++) {
        pack_entity(p, i->entered[n].entity);
        pack_handed(p, s, i, i->entered[n].entity);
    }
    if (i->impulse) {
        pack_entity(p, i->impulse);
        pack_handed(p, s, i, i->impulse);
    }
}

static int unpack_item(pcg_unpacker *u, const pcg_surrogate *s, const batch_item *i,
                       worker_choice *k, pcg_entity **impulse)
{
    for (pcg_u32 n = 0; n < i->entered_count; n++) {
        pcg_entity *e = unpack_handed(u, s, k);
        if (!e)
            return PCG_FAILED;
        PCG_TRY(pcg_queue_push(u->run, k->own.inputs[i->entered[n].input], e));
    }
    if (i->impulse)
        *impulse = unpack_handed(u, s, k);
    return i->impulse && !*impulse ? PCG_FAILED : PCG_OK;
}

/* Copies of the item's entities, which are the main run's, into the worker's. Status. */
static int bring(worker *w, const pcg_surrogate *s, const batch_item *i, worker_choice *k,
                 pcg_entity **impulse)
{
    pcg_packer p = {.run = w->run, .flags = PARCEL_LOCAL | PARCEL_LINEAGE, .cell = -1};
    pack_item(&p, s, i);
    int status = pack_status(&p);
    if (status == PCG_OK) {
        pcg_unpacker u = {.run = w->run,
                          .flags = p.flags,
                          .at = p.at,
                          .end = p.at + p.length,
                          .cell = k->own.origin};
        status = unpack_item(&u, s, i, k, impulse);
        status = u.failed ? PCG_FAILED : status;
        unpacker_close(&u);
    }
    packer_close(&p);
    return status;
}

/* ---- executing ------------------------------------------------------------------------------ */

static void give(worker_choice *k, const pcg_surrogate *s, const pcg_cell *from)
{
    for (pcg_u32 i = 0; i < s->info->parameter_count; i++) {
        const pcg_parameter_info *p = k->own.parameters[i];
        memcpy(choice_at(&k->own, p->offset), from, value_width(p->kind) * sizeof *from);
        *(pcg_u8 *)choice_at(&k->own, p->given) = 1;
        from += value_width(p->kind);
    }
}

/* Every worker starts its own frame; what that says is said once, by whoever has the first item. */
static int start(worker_choice *k, const pcg_surrogate *s, const batch_item *i)
{
    pcg_choice *own = &k->own;
    pcg_run *r = own->frame->run;
    give(k, s, i->given);
    if (own->started && own->start == i->start)
        return PCG_OK;
    run_record *said = r->record;
    own->frame->lineage = i->start_lineage;
    r->record = i->first ? said : NULL;
    int status = (own->started ? own->module->restart : own->module->start)(own->frame);
    r->record = said;
    own->started = true;
    own->start = i->start;
    return status;
}

static int run_graph(worker_choice *k, const batch_item *i, const pcg_entity *impulse)
{
    k->own.frame->lineage = i->lineage;
    ((pcg_graph *)k->own.frame)->impulse = impulse;
    int status = k->own.module->run(k->own.frame);
    if (k->own.frame->pool)
        pcg_pool_end(k->own.frame);
    return status;
}

static void forget_counts(pcg_run *r)
{
    for (pcg_loaded *l = &r->own; l; l = l->next) {
        memset(l->sent, 0, l->module->port_count * sizeof *l->sent);
        memset(l->worked, 0, l->module->node_count * sizeof *l->worked);
    }
}

static void drop_outputs(worker_choice *k)
{
    for (pcg_u32 i = 0; i < k->own.module->output_count; i++) {
        pcg_queue *q = choice_output(&k->own, i);
        while (PCG_READY(*q))
            pcg_entity_drop(k->own.frame->run, PCG_TAKE(*q));
    }
}

static int keep_result(worker *w, const pcg_surrogate *s, worker_choice *k, batch_item *i)
{
    pcg_packer p = {
        .run = w->run, .flags = PARCEL_LOCAL | PARCEL_LINEAGE, .cell = k->own.origin};
    int status = outcome_pack(&p, s, &k->own, w->run->record, NULL);
    if (status == PCG_OK) {
        i->result = p.at;
        i->result_length = p.length;
        p.at = NULL;
    }
    packer_close(&p);
    return status;
}

static int execute(worker *w, const pcg_surrogate *s, batch_item *i)
{
    pcg_run *r = w->run;
    pcg_entity *impulse = NULL;
    worker_choice *k = choice_like(w, i->choice);
    if (!k)
        return PCG_FAILED;
    PCG_TRY(start(k, s, i));
    PCG_TRY(bring(w, s, i, k, &impulse));
    PCG_TRY(run_graph(k, i, impulse));
    PCG_TRY(r->status);
    i->rounds = r->rounds;
    i->most_entities = r->most_entities;
    i->drawn = r->drawn;
    PCG_TRY(keep_result(w, s, k, i));
    drop_outputs(k);
    if (impulse)
        pcg_entity_drop(r, impulse);
    return PCG_OK;
}

static bool run_item(worker *w, batch_item *i)
{
    pcg_run *r = w->run;
    run_record said = {0};
    r->record = &said;
    r->rounds = r->most_entities = 0;
    r->drawn = false;
    int status = execute(w, w->crew->batch->surrogate, i);
    record_close(&said);
    r->record = NULL;
    forget_counts(r);
    return status == PCG_OK;
}

/* ---- threads -------------------------------------------------------------------------------- */

static bool may_begin(const run_crew *k)
{
    return k->next < k->batch->count && k->next - k->taken < k->thread_count * CREW_AHEAD;
}

/* The next item, begun; NULL where there is none. The lock is held. */
static batch_item *begin_item(run_crew *k)
{
    while (!k->stop && k->next < k->batch->count) {
        if (!may_begin(k)) {
            pthread_cond_wait(&k->room, &k->lock);
        } else {
            batch_item *i = &k->batch->items[k->next++];
            if (i->stage == BATCH_HERE)
                continue;
            i->stage = BATCH_RUNS;
            return i;
        }
    }
    return NULL;
}

static void *work(void *context)
{
    worker *w = context;
    run_crew *k = w->crew;
    pthread_mutex_lock(&k->lock);
    batch_item *i = begin_item(k);
    while (i) {
        pthread_mutex_unlock(&k->lock);
        bool good = run_item(w, i);
        pthread_mutex_lock(&k->lock);
        i->stage = good ? BATCH_DONE : BATCH_FAILED;
        w->is_broken = !good;
        pthread_cond_signal(&k->done);
        i = good ? begin_item(k) : NULL;
    }
    k->working--;
    pthread_cond_signal(&k->done);
    pthread_mutex_unlock(&k->lock);
    return NULL;
}

/* Signals are the host's threads' business. */
static bool begin_thread(worker *w)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    int failed = pthread_create(&w->thread, NULL, work, w);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return !failed;
}

/* ---- graphs that are loaded ----------------------------------------------------------------- */

const pcg_program *crew_loading_begin(pcg_run *r, const char *key)
{
    run_crew *k = r->crew;
    if (!k)
        return NULL;
    pthread_mutex_lock(&k->loading);
    for (uint32_t i = 0; i < k->graphs.count; i++)
        if (!strcmp(k->graphs.at[i].key, key))
            return k->graphs.at[i].program;
    return NULL;
}

void crew_loading_end(pcg_run *r, const char *key, const pcg_program *loaded)
{
    run_crew *k = r->crew;
    jmp_buf out_of_memory;
    if (!k)
        return;
    k->arena.on_failure = &out_of_memory;
    if (loaded && !setjmp(out_of_memory)) {
        const crew_graph g = {arena_copy(&k->arena, key, strlen(key)), loaded};
        LIST_ADD(&k->arena, &k->graphs, g);
    }
    k->arena.on_failure = NULL;
    pthread_mutex_unlock(&k->loading);
}

/* ---- the crew ------------------------------------------------------------------------------- */

static run_crew *crew_new(void)
{
    run_crew *k = calloc(1, sizeof *k);
    pthread_condattr_t monotonic;
    if (!k)
        return NULL;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&k->lock, NULL);
    pthread_mutex_init(&k->loading, NULL);
    pthread_cond_init(&k->done, &monotonic);
    pthread_cond_init(&k->room, NULL);
    pthread_condattr_destroy(&monotonic);
    return k;
}

static bool add_worker(pcg_run *r, run_crew *k)
{
    worker *w = calloc(1, sizeof *w);
    const pcg_run_options o = {.size = sizeof o, .seed = r->seed, .max_depth = r->max_depth};
    if (w && (w->run = pcg_run_new(r->program, &o)) != NULL) {
        w->crew = w->run->crew = k;
        w->run->is_worker = w->run->by_module = true;
        w->run->strict = r->strict;
        k->workers[k->worker_count++] = w;
        return true;
    }
    free(w);
    return false;
}

/* Each has its share of what the limits leave now, and knows what the main run has loaded. */
static bool prepare(const pcg_run *r, worker *w, pcg_u32 threads)
{
    pcg_run *own = w->run;
    size_t left = r->memory.limit - r->memory.used;
    own->memory.limit = own->memory.used + left / (threads + 1);
    own->max_rounds = r->max_rounds - r->rounds;
    own->max_entities = r->max_entities - r->entities;
    own->max_seconds = r->max_seconds;
    own->started = own->looked = r->started;
    own->stage = RUN_EXECUTING;
    own->stack_floor = 0;
    for (const pcg_loaded *l = r->own.next; l; l = l->next)
        if (!loaded_like(own, l))
            return false;
    return own->status == PCG_OK;
}

bool crew_begin(pcg_call *c, pcg_batch *b, pcg_u32 threads)
{
    pcg_run *r = c->run;
    run_crew *k = r->crew ? r->crew : crew_new();
    r->crew = k;
    if (!k || k->batch)
        return false;
    threads = threads < b->count ? threads : b->count;
    while (k->worker_count < threads && add_worker(r, k)) {
    }
    k->batch = b;
    k->next = k->taken = k->thread_count = k->working = 0;
    k->stop = false;
    pthread_mutex_lock(&k->lock);
    for (pcg_u32 i = 0; i < k->worker_count && k->thread_count < threads; i++) {
        worker *w = k->workers[i];
        if (w->is_broken || !prepare(r, w, threads) || !begin_thread(w)) {
            w->is_broken = true;
            continue;
        }
        worker *swapped = k->workers[k->thread_count];
        k->workers[k->thread_count++] = w;
        k->workers[i] = swapped;
        k->working++;
    }
    pthread_mutex_unlock(&k->lock);
    if (!k->thread_count)
        k->batch = NULL;
    return k->thread_count > 0;
}

static struct timespec soon(void)
{
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    at.tv_nsec += WAIT_MILLISECONDS * 1000000L;
    if (at.tv_nsec >= 1000000000L) {
        at.tv_sec++;
        at.tv_nsec -= 1000000000L;
    }
    return at;
}

/* Nobody is left who would begin it: then it stays BATCH_WAITS. */
static bool is_settled(const run_crew *k, const batch_item *i)
{
    return i->stage == BATCH_HERE || i->stage >= BATCH_DONE ||
           (i->stage == BATCH_WAITS && !k->working);
}

int crew_wait(pcg_call *c, pcg_u32 item)
{
    pcg_run *r = c->run;
    run_crew *k = r->crew;
    const batch_item *i = &k->batch->items[item];
    int status = PCG_OK;
    pthread_mutex_lock(&k->lock);
    k->taken = item;
    pthread_cond_broadcast(&k->room);
    while (status == PCG_OK && !is_settled(k, i)) {
        const struct timespec until = soon();
        pthread_cond_timedwait(&k->done, &k->lock, &until);
        pthread_mutex_unlock(&k->lock);
        status = run_look(r);
        pthread_mutex_lock(&k->lock);
    }
    pthread_mutex_unlock(&k->lock);
    return status;
}

void crew_end(pcg_run *r)
{
    run_crew *k = r->crew;
    pthread_mutex_lock(&k->lock);
    k->stop = true;
    bool left = k->taken + 1 < k->batch->count;
    for (pcg_u32 i = 0; i < k->thread_count && left; i++)
        pcg_run_cancel(k->workers[i]->run);
    pthread_cond_broadcast(&k->room);
    pthread_mutex_unlock(&k->lock);
    for (pcg_u32 i = 0; i < k->thread_count; i++)
        pthread_join(k->workers[i]->thread, NULL);
    k->thread_count = 0;
    k->batch = NULL;
}

void crew_close(pcg_run *r)
{
    run_crew *k = r->crew;
    if (!k || r->is_worker)
        return;
    for (pcg_u32 i = 0; i < k->worker_count; i++) {
        pcg_run_free(k->workers[i]->run);
        free(k->workers[i]);
    }
    arena_free(&k->arena);
    pthread_mutex_destroy(&k->loading);
    pthread_mutex_destroy(&k->lock);
    pthread_cond_destroy(&k->done);
    pthread_cond_destroy(&k->room);
    free(k);
    r->crew = NULL;
}

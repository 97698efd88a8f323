/* call.c - what emitted code calls in every round: frames, rounds, queues, sending. Kept short: a
 * round of a trivial node is these few instructions. */
#include <string.h>

#include "observe.h"
#include "part.h"
#include "stack.h"

enum { QUEUE_FIRST = 8, STACK_ASKED_FROM = 16 };

/* ---- queues --------------------------------------------------------------------------------- */

/* Makes room for one more: by moving down what waits where half of the room is free, else by
 * doubling. */
static int queue_reserve(pcg_run *r, pcg_queue *q)
{
    pcg_u32 waiting = q->end - q->head;
    if (waiting <= q->capacity / 2 && q->capacity) {
        memmove(q->at, q->at + q->head, waiting * sizeof *q->at);
    } else {
        size_t old = q->capacity * sizeof *q->at;
        size_t bytes = run_capacity(old ? old * 2 : QUEUE_FIRST * sizeof *q->at);
        if (bytes / sizeof *q->at > UINT32_MAX) {
            run_out_of_memory(r, bytes);
            return PCG_FAILED;
        }
        pcg_entity **at = run_resize(r, q->at, old, bytes);
        if (!at)
            return PCG_FAILED;
        q->at = at;
        q->capacity = (pcg_u32)(bytes / sizeof *at);
        if (q->head)
            memmove(at, at + q->head, waiting * sizeof *at);
    }
    q->head = 0;
    q->end = waiting;
    return PCG_OK;
}

/* What is exported is never inlined into its callers here: a host may put a function of its own in
 * its place. */
static inline int push(pcg_run *r, pcg_queue *q, pcg_entity *e)
{
    if (q->end == q->capacity && queue_reserve(r, q) != PCG_OK) {
        pcg_entity_drop(r, e);
        return PCG_FAILED;
    }
    q->at[q->end++] = e;
    return PCG_OK;
}

int pcg_queue_push(pcg_run *r, pcg_queue *q, pcg_entity *e)
{
    return push(r, q, e);
}

/* ---- frames --------------------------------------------------------------------------------- */

/* True where the stack has no room for one more encapsulated graph. A frame is made where it is
 * first run, and each frame is run at one depth of the stack, so that looking here is enough.
 * Asking the system takes a while, and is put off until graphs are nested deeper than most. */
static bool stack_is_full(pcg_run *r, pcg_u32 depth)
{
    if (depth < STACK_ASKED_FROM)
        return false;
    if (!r->stack_floor)
        r->stack_floor = stack_floor(RUN_STACK_RESERVE);
    return stack_here() < r->stack_floor;
}

pcg_frame *pcg_frame_new(pcg_frame *parent, const pcg_node *node, pcg_u32 size, pcg_u32 cells)
{
    pcg_run *r = parent->run;
    if (parent->depth >= r->max_depth) {
        run_fail(r, PCG_LIMIT, DIAG_E0704, node, r->round, r->max_depth);
        return NULL;
    }
    if (stack_is_full(r, parent->depth)) {
        run_fail(r, PCG_LIMIT, DIAG_E0705, node, r->round, parent->depth, r->max_depth);
        return NULL;
    }
    pcg_frame *f = run_alloc_zeroed(r, size);
    if (!f)
        return NULL;
    f->run = r;
    f->parent = parent;
    f->key = pcg_mix(parent->key, node->key);
    f->base = parent->base + cells;
    f->depth = parent->depth + 1;
    loaded_take(f, parent->loaded);
    return f;
}

/* ---- rounds --------------------------------------------------------------------------------- */

void pcg_begin(pcg_call *c, pcg_frame *f, const pcg_node *node, pcg_instance *i)
{
    c->run = f->run;
    c->frame = f;
    c->sent = f->sent;
    c->node = node;
    c->instance = i;
    c->key = pcg_mix(f->key, node->key);
    c->lineage = f->lineage;
    c->round = i->rounds;
    c->made = 0;
    c->first = NULL;
}

int pcg_round(pcg_call *c, const pcg_entity *first)
{
    pcg_run *r = c->run;
    if (r->unsettled && (c->node->mixed || !first || !part_is(first)))
        parts_settle(r);
    r->node = c->node;
    pcg_u64 worked = ++c->frame->worked[c->node->index], rounds = ++c->instance->rounds;
    r->round = c->round = r->by_module ? worked : rounds;
    c->made = 0;
    c->first = first;
    if (first)
        c->lineage = first->lineage;
    if (++r->rounds > r->max_rounds)
        return run_fail(r, PCG_LIMIT, DIAG_E0702, c->node, c->round, r->max_rounds);
    if (--r->patience == 0 || atomic_load_explicit(&r->attention, memory_order_relaxed))
        return run_look(r);
    return PCG_OK;
}

int round_again(pcg_call *c)
{
    pcg_run *r = c->run;
    if (++r->rounds > r->max_rounds)
        return run_fail(r, PCG_LIMIT, DIAG_E0702, c->node, c->round, r->max_rounds);
    return pcg_tick(c);
}

int pcg_tick(pcg_call *c)
{
    pcg_run *r = c->run;
    if (--r->patience == 0 || atomic_load_explicit(&r->attention, memory_order_relaxed))
        return run_look(r);
    return PCG_OK;
}

/* ---- sending -------------------------------------------------------------------------------- */

/* Copies for the edges behind the first. The original is in a queue by now, and stays until a node
 * takes it. */
static int emit_copies(pcg_run *r, const pcg_port *p, const pcg_entity *e)
{
    for (pcg_u32 i = 1; i < p->count; i++) {
        pcg_entity *copy = pcg_entity_copy(r, e, i);
        if (!copy || push(r, p->to[i], copy) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

int pcg_emit(pcg_call *c, const pcg_port *p, pcg_entity *e)
{
    pcg_run *r = c->run;
    c->sent[p->index]++;
    if (r->observed)
        return observe_emit(c, p, e);
    if (p->count == 0) {
        pcg_entity_drop(r, e);
        return PCG_OK;
    }
    int status = push(r, p->to[0], e);
    if (status == PCG_OK && p->count > 1)
        status = emit_copies(r, p, e);
    return status;
}

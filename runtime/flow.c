/* flow.c - flows: how many entities go at a time, and the order of what is told meanwhile.
 *
 * Messages wait until the flow is done, and are then put in the order of the nodes that they came
 * from; those of one node came in the order in which the rules would have them. Of a node's warnings
 * only the first are told, and a node of an encapsulated graph may warn from several places: so as
 * many are kept of each place, and the rest is counted. */
#include <stdlib.h>

#include "run.h"
#include "shape.h"

/* ---- batches -------------------------------------------------------------------------------- */

/* Whether a change of it can be seen through nothing else: nobody else holds it, its parts or what
 * it holds. */
static bool is_alone(const pcg_entity *e)
{
    if (e->references != 1)
        return false;
    if (e->type == &pcg_type_shape)
        return !((const pcg_shape *)(const void *)e)->parts;
    return !e->type->drop;
}

pcg_u32 pcg_flow_batch(const pcg_frame *f, const pcg_queue *q)
{
    if (q->end - q->head <= f->run->flow.batch || f->run->strict)
        return PCG_FLOW_ALL;
    for (pcg_u32 i = q->head; i < q->end; i++)
        if (!is_alone(q->at[i]))
            return PCG_FLOW_ALL;
    return f->run->flow.batch;
}

/* ---- what is told --------------------------------------------------------------------------- */

/* The warnings of a node from one place in the flow. */
typedef struct flow_warned {
    pcg_loaded *loaded;
    pcg_u32 node, rank, count;
} flow_warned;

typedef struct flow_held {
    pcg_severity severity;
    int code;
    const pcg_node *node;
    pcg_u64 round;
    const char *line;
    pcg_loaded *loaded; /* of a node's warning: whose it is; else NULL */
    bool once;
    pcg_u32 rank, number;
} flow_held;

/* Room for one more. Status. */
static int reserve(pcg_run *r, void **at, pcg_u32 count, pcg_u32 *capacity, size_t size)
{
    if (count < *capacity)
        return PCG_OK;
    size_t old = *capacity * size, bytes = run_capacity(old ? 2 * old : 8 * size);
    void *moved = run_resize(r, *at, old, bytes);
    if (!moved)
        return PCG_FAILED;
    *at = moved;
    *capacity = (pcg_u32)(bytes / size);
    return PCG_OK;
}

bool flow_admit(pcg_call *c)
{
    run_flow *f = &c->run->flow;
    pcg_loaded *l = c->frame->loaded;
    for (pcg_u32 i = f->warned_count; i-- > 0;) {
        flow_warned *w = &f->warned[i];
        if (w->loaded == l && w->node == c->node->index && w->rank == f->rank)
            return ++w->count <= RUN_WARNINGS_OF_NODE || c->run->record;
    }
    if (reserve(c->run, (void **)&f->warned, f->warned_count, &f->warned_capacity,
                sizeof *f->warned) != PCG_OK)
        return false;
    f->warned[f->warned_count++] = (flow_warned){l, c->node->index, f->rank, 1};
    return true;
}

static bool hold(pcg_run *r, flow_held held)
{
    run_flow *f = &r->flow;
    if (reserve(r, (void **)&f->held, f->held_count, &f->held_capacity, sizeof *f->held) != PCG_OK)
        return false;
    held.line = pcg_string(r, held.line);
    held.rank = f->rank;
    held.number = f->held_count;
    f->held[f->held_count++] = held;
    return true;
}

/* What is said once is kept once from each place: which of them comes first is known at the end. */
static bool is_new(pcg_call *c, const char *line)
{
    run_flow *f = &c->run->flow;
    const char *key = pcg_format(c->run, "%u\n%s\n%s\n%s", f->rank, c->node->graph, c->node->name,
                                 line);
    pcg_u32 count = f->once.count;
    return keys_number(c->run, &f->once, key) == count;
}

void flow_hold_warning(pcg_call *c, bool once, const char *line)
{
    if (once && !c->run->record && !is_new(c, line))
        return;
    hold(c->run, (flow_held){.severity = PCG_WARNING, .node = c->node, .round = c->round,
                             .line = line, .loaded = c->frame->loaded, .once = once});
}

bool flow_hold(pcg_run *r, pcg_severity s, int code, const pcg_node *node, pcg_u64 round,
               const char *line)
{
    return hold(r, (flow_held){.severity = s, .code = code, .node = node, .round = round,
                               .line = line});
}

static int before(const void *a, const void *b)
{
    const flow_held *x = a, *y = b;
    if (x->rank != y->rank)
        return x->rank < y->rank ? -1 : 1;
    return x->number < y->number ? -1 : 1;
}

static void tell(pcg_run *r, const flow_held *h)
{
    if (h->loaded)
        message_warn(r, h->loaded, h->node, h->round, h->once, h->line);
    else
        message_tell(r, h->severity, h->code, h->node, h->round, h->line);
}

void flow_tell(pcg_run *r)
{
    run_flow *f = &r->flow;
    if (!f->running)
        return;
    f->running = false;
    if (f->held_count)
        qsort(f->held, f->held_count, sizeof *f->held, before);
    for (pcg_u32 i = 0; i < f->held_count; i++)
        tell(r, &f->held[i]);
    for (pcg_u32 i = 0; i < f->warned_count && !r->record; i++)
        for (pcg_u32 k = RUN_WARNINGS_OF_NODE; k < f->warned[i].count; k++)
            message_admit(f->warned[i].loaded, f->warned[i].node);
    f->held_count = f->warned_count = 0;
}

void pcg_flow_begin(pcg_frame *f)
{
    run_flow *flow = &f->run->flow;
    flow->running = true;
    flow->held_count = flow->warned_count = 0; /* a cancelled one may have left some */
}

void pcg_flow_turn(pcg_frame *f, pcg_u32 rank)
{
    f->run->flow.rank = rank;
}

void pcg_flow_end(pcg_frame *f)
{
    flow_tell(f->run);
}

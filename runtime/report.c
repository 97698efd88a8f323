/* report.c - what a run says of itself when it is done: where nothing came, what was left waiting,
 * what was held back.
 *
 * In dataflow "nothing came out" is the usual bug. A node is reported where nothing came to it
 * although what leads to it ran: the frontier of the silence, not all that lies behind. A way that
 * was not taken, and joins ways that were, is no bug: only where an end stays silent, a gate or a
 * node that leads nowhere, it is told what leads there.
 */
#include <stdlib.h>
#include <string.h>

#include "record.h"

enum { MOST_REPORTS = 20, MOST_OTHERS = 3 };

typedef struct silence {
    pcg_run *run;
    const pcg_loaded *loaded;
    const pcg_module *module;
    arena arena;
    pcg_u8 *active;     /* by node: it ran, or sent something */
    pcg_u8 *fed;        /* edges lead to it */
    pcg_u8 *frontier;   /* edges from active nodes do */
    pcg_u8 *received;   /* something came along them */
    pcg_u8 *missed;     /* nothing came, and it is a silent end or leads to one */
} silence;

/* ---- nothing came --------------------------------------------------------------------------- */

/* False where memory has run out. */
static bool look_around(silence *s)
{
    const pcg_module *m = s->module;
    s->active = ARENA_ARRAY(&s->arena, pcg_u8, m->node_count);
    s->fed = ARENA_ARRAY(&s->arena, pcg_u8, m->node_count);
    s->frontier = ARENA_ARRAY(&s->arena, pcg_u8, m->node_count);
    s->received = ARENA_ARRAY(&s->arena, pcg_u8, m->node_count);
    s->missed = ARENA_ARRAY(&s->arena, pcg_u8, m->node_count);
    if (!s->active || !s->fed || !s->frontier || !s->received || !s->missed)
        return false;
    for (pcg_u32 i = 0; i < m->node_count; i++)
        s->active[i] = s->loaded->worked[i] > 0;
    for (pcg_u32 i = 0; i < m->port_count; i++)
        if (s->loaded->sent[i])
            s->active[m->ports[i].node] = 1;
    for (pcg_u32 i = 0; i < m->edge_count; i++) {
        const pcg_edge_info *e = &m->edges[i];
        s->fed[e->node] = 1;
        s->frontier[e->node] |= s->active[m->ports[e->port].node];
        s->received[e->node] |= s->loaded->sent[e->port] > 0;
    }
    return true;
}

static bool is_silent(const silence *s, pcg_u32 node)
{
    return s->fed[node] && !s->received[node] && !s->loaded->worked[node];
}

/* The edges by the node that they lead to: those of node n stand from first[n] to first[n + 1]. NULL
 * where memory has run out. */
static pcg_u32 *edges_by_target(silence *s, pcg_u32 *first)
{
    const pcg_module *m = s->module;
    pcg_u32 *edges = ARENA_ARRAY(&s->arena, pcg_u32, m->edge_count + 1);
    if (!edges)
        return NULL;
    for (pcg_u32 i = 0; i < m->edge_count; i++)
        first[m->edges[i].node]++;
    for (pcg_u32 n = 0; n < m->node_count; n++)
        first[n + 1] += first[n];
    for (pcg_u32 i = m->edge_count; i-- > 0;)
        edges[--first[m->edges[i].node]] = i;
    return edges;
}

/* Marks the silent ends, and from there back what is silent and leads to them. */
static bool find_missed(silence *s)
{
    const pcg_module *m = s->module;
    pcg_u8 *leads = ARENA_ARRAY(&s->arena, pcg_u8, m->node_count);
    pcg_u32 *first = ARENA_ARRAY(&s->arena, pcg_u32, m->node_count + 1);
    pcg_u32 *stack = ARENA_ARRAY(&s->arena, pcg_u32, m->node_count), depth = 0;
    const pcg_u32 *edges = leads && first && stack ? edges_by_target(s, first) : NULL;
    if (!edges)
        return false;
    for (pcg_u32 i = 0; i < m->edge_count; i++)
        leads[m->ports[m->edges[i].port].node] = 1;
    for (pcg_u32 n = 0; n < m->node_count; n++)
        if (!leads[n] && is_silent(s, n)) {
            s->missed[n] = 1;
            stack[depth++] = n;
        }
    while (depth) {
        pcg_u32 to = stack[--depth];
        for (pcg_u32 i = first[to]; i < first[to + 1]; i++) {
            pcg_u32 from = m->ports[m->edges[edges[i]].port].node;
            if (!s->missed[from] && is_silent(s, from)) {
                s->missed[from] = 1;
                stack[depth++] = from;
            }
        }
    }
    return true;
}

/* ", 216 to 'ground.no'" for the ports of a node that sent something; how many there are. */
static pcg_u32 add_other_ports(const silence *s, pcg_u32 node, pcg_u32 already, text *out)
{
    const pcg_module *m = s->module;
    pcg_u32 found = 0;
    for (pcg_u32 i = 0; i < m->port_count && already + found < MOST_OTHERS; i++) {
        pcg_u64 sent = s->loaded->sent[i];
        if (m->ports[i].node != node || !sent)
            continue;
        text_format(out, "%s%llu went to '%s.%s'", already + found ? ", " : "", sent,
                    m->nodes[node].name, m->ports[i].name);
        found++;
    }
    return found;
}

static bool is_first_edge_between(const pcg_module *m, pcg_u32 edge)
{
    for (pcg_u32 i = 0; i < edge; i++)
        if (m->edges[i].node == m->edges[edge].node &&
            m->ports[m->edges[i].port].node == m->ports[m->edges[edge].port].node)
            return false;
    return true;
}

/* Where the entities went instead: " (216 went to 'ground.no')", or what ran and sent nothing. */
static void add_reason(const silence *s, pcg_u32 node, text *out)
{
    const pcg_module *m = s->module;
    const pcg_node *idle = NULL;
    pcg_u32 others = 0;
    text_add(out, " (");
    for (pcg_u32 i = 0; i < m->edge_count; i++) {
        pcg_u32 feeder = m->ports[m->edges[i].port].node;
        if (m->edges[i].node != node || !s->active[feeder] || !is_first_edge_between(m, i))
            continue;
        others += add_other_ports(s, feeder, others, out);
        if (!idle)
            idle = &m->nodes[feeder];
    }
    if (!others && idle) {
        pcg_u64 rounds = s->loaded->worked[idle->index];
        text_format(out, "'%s' ran %llu round%s and sent nothing", idle->name, rounds,
                    rounds == 1 ? "" : "s");
    }
    text_add(out, ")");
}

static void report_node(silence *s, pcg_u32 node)
{
    const pcg_node *n = &s->module->nodes[node];
    text reason = {.arena = &s->arena};
    add_reason(s, node, &reason);
    const char *name = arena_format(&s->arena, "'%s'", n->name);
    if (name && reason.at)
        message_diagnose(s->run, DIAG_W0501, n, 0, name, reason.at);
}

static void report_nodes(silence *s)
{
    pcg_u32 reports = 0;
    for (pcg_u32 i = 0; i < s->module->node_count; i++) {
        if (!s->missed[i] || !s->frontier[i])
            continue;
        if (reports++ < MOST_REPORTS)
            report_node(s, i);
    }
    if (reports > MOST_REPORTS) {
        const char *more = arena_format(&s->arena, "%u more nodes", reports - MOST_REPORTS);
        message_diagnose(s->run, DIAG_W0501, NULL, 0, more ? more : "more nodes", "");
    }
}

/* An input gate that nothing in the graph feeds, and the host did not. */
static void report_inputs(silence *s)
{
    const pcg_module *m = s->module;
    for (pcg_u32 i = 0; i < m->input_count; i++) {
        const pcg_u8 *given = run_at(s->run, m->inputs[i].given);
        for (pcg_u32 n = 0; n < m->node_count && !*given; n++) {
            const pcg_node *node = &m->nodes[n];
            if (!strcmp(node->graph, m->name) && !strcmp(node->name, m->inputs[i].name) &&
                !s->fed[n] && !s->active[n])
                message_diagnose(s->run, DIAG_W0704, node, 0, m->inputs[i].name);
        }
    }
}

/* ---- left waiting --------------------------------------------------------------------------- */

/* The number of the module that a node is of, in the order in which they came. */
static pcg_u32 module_number(const pcg_run *r, const pcg_node *node)
{
    pcg_u32 number = 0;
    uintptr_t at = (uintptr_t)node;
    for (const pcg_loaded *l = &r->own; l; l = l->next, number++) {
        uintptr_t first = (uintptr_t)l->module->nodes;
        if (at >= first && at < first + l->module->node_count * sizeof *node)
            break;
    }
    return number;
}

/* Nodes are told of as they are numbered, their inputs by name, whichever had something left first. */
static bool comes_behind(const pcg_run *r, const run_waiting *w, const pcg_node *node,
                         const char *input)
{
    pcg_u32 a = module_number(r, w->node), b = module_number(r, node);
    if (a != b)
        return a > b;
    if (w->node->index != node->index)
        return w->node->index > node->index;
    return strcmp(w->input, input) > 0;
}

static run_waiting *waiting_of(pcg_run *r, const pcg_node *node, const char *input)
{
    run_waiting **at = &r->waiting;
    for (; *at && !comes_behind(r, *at, node, input); at = &(*at)->next)
        if ((*at)->node == node && !strcmp((*at)->input, input))
            return *at;
    run_waiting *w = run_alloc_zeroed(r, sizeof *w);
    if (!w)
        return NULL;
    *w = (run_waiting){.next = *at, .node = node, .input = input};
    *at = w;
    return w;
}

void report_left(pcg_run *r, const pcg_node *node, const char *input, pcg_u64 count)
{
    run_waiting *w = waiting_of(r, node, input);
    if (w)
        w->count += count;
    if (r->record)
        record_left(r->record, node, input, count);
}

void pcg_queue_clear(pcg_frame *f, const pcg_node *node, const char *input, pcg_queue *q)
{
    if (q->head == q->end)
        return;
    pcg_run *r = f->run;
    report_left(r, node, input, q->end - q->head);
    while (q->head < q->end)
        pcg_entity_drop(r, q->at[q->head++]);
    q->head = q->end = 0;
}

static void report_waiting(pcg_run *r)
{
    for (const run_waiting *w = r->waiting; w; w = w->next)
        message_diagnose(r, DIAG_W0702, w->node, 0, w->count,
                         w->count == 1 ? "entity was left" : "entities were left", w->node->name,
                         w->input);
}

/* ---- held back ------------------------------------------------------------------------------ */

static void report_held_back(pcg_run *r, const pcg_loaded *l)
{
    for (pcg_u32 i = 0; l->warnings && i < l->module->node_count; i++) {
        pcg_u32 count = l->warnings[i];
        if (count <= RUN_WARNINGS_OF_NODE)
            continue;
        pcg_u64 more = count - RUN_WARNINGS_OF_NODE;
        const pcg_node *n = &l->module->nodes[i];
        message_diagnose(r, DIAG_W0703, n, 0, more, more == 1 ? "warning" : "warnings", n->name,
                         more == 1 ? "is" : "are");
    }
}

/* The inputs of what was loaded are fed by surrogates. */
static void report_loaded(pcg_run *r, const pcg_loaded *l)
{
    silence s = {.run = r, .loaded = l, .module = l->module};
    if (look_around(&s) && find_missed(&s)) {
        if (l == &r->own)
            report_inputs(&s);
        report_nodes(&s);
    }
    arena_free(&s.arena);
}

void report_silence(pcg_run *r)
{
    for (const pcg_loaded *l = &r->own; l; l = l->next)
        report_held_back(r, l);
    report_waiting(r);
    for (const pcg_loaded *l = &r->own; l; l = l->next)
        report_loaded(r, l);
}

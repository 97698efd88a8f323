/* emit_run.c - the functions that run a graph: its nodes in order, and in cyclic regions back to
 * where edges lead.
 *
 * Before a cyclic region everything is exhausted and stays so. Within one, once a node has run,
 * all that can have become ready before it is what its cyclic edges lead to; so the first node
 * in order that is ready is found by going on from the first of these. */
#include "emit.h"

#define NO_RANK UINT32_MAX

/* The lowest rank that an edge leads back to from the node, or NO_RANK. */
static uint32_t back_to(const emitter *e, const node *n)
{
    uint32_t rank = NO_RANK;
    for (uint32_t i = 0; i < n->output_count; i++) {
        for (uint32_t k = 0; k < n->outputs[i].edge_count; k++) {
            const edge *back = n->outputs[i].edges[k];
            if (back->cyclic && emit_takes_part(e, back->to->node) && back->to->node->rank < rank) {
                rank = back->to->node->rank;
            }
        }
    }
    return rank;
}

static bool runs(const emitter *e, const node *n)
{
    return n->kind != NODE_OUTPUT && emit_takes_part(e, n);
}

/* A stand-in runs only where the host fed its gate nothing. */
static const char *guard(emitter *e, const node *n)
{
    if (!n->stand_in || !n->stands_for) {
        return NULL;
    }
    return emit_name(e, "!g->fed.%s", emit_fed(e, n->stands_for));
}

static void emit_straight(emitter *e, const node *n)
{
    const char *condition = guard(e, n);
    if (condition) {
        emit_line(e, "if (%s)", condition);
        e->depth++;
    }
    emit_line(e, "PCG_TRY(%s(g));", e->form->functions[n->index]);
    if (condition) {
        e->depth--;
    }
}

/* ---- cyclic regions -------------------------------------------------------------------------- */

static const char *label(emitter *e, uint32_t rank)
{
    return emit_name(e, "node_%u", rank);
}

static const char *done(emitter *e, const node *n)
{
    return emit_name(e, "done_%u", n->rank);
}

/* The condition that the node can run, from outside of its function. */
static const char *ready(emitter *e, const node *n)
{
    text all = {.arena = e->arena};
    const char *stand_in = guard(e, n);
    if (stand_in) {
        text_format(&all, "%s && ", stand_in);
    }
    if (n->input_count == 0) {
        text_format(&all, "!%s", done(e, n));
        return all.at;
    }
    const port *impulse = emit_impulse(n);
    if (impulse && !emit_has_open_edge(impulse)) {
        text_format(&all, "(%s.triggered ? PCG_READY(%s) : !%s)", emit_node_path(e, n),
                    emit_queue(e, impulse), done(e, n));
        return all.at;
    }
    for (uint32_t i = 0; i < n->input_count; i++) {
        if (!n->inputs[i].optional) {
            text_format(&all, "%sPCG_READY(%s)", i ? " && " : "", emit_queue(e, &n->inputs[i]));
        }
    }
    return all.at;
}

static void emit_turn(emitter *e, const node *n, bool is_target)
{
    uint32_t back = back_to(e, n);
    if (is_target) {
        e->depth--;
        emit_line(e, "%s:", label(e, n->rank));
        e->depth++;
    }
    emit_open(e, "if (%s)", ready(e, n));
    if (emit_may_run_once(n)) {
        emit_line(e, "%s = 1;", done(e, n));
    }
    emit_line(e, "PCG_TRY(%s(g));", e->form->functions[n->index]);
    if (back != NO_RANK) {
        emit_line(e, "goto %s;", label(e, back));
    }
    emit_close(e, "");
}

static void emit_cyclic(emitter *e, const region *r)
{
    const graph *g = e->form->graph;
    bool *target = ARENA_ARRAY(e->arena, bool, r->last - r->first + 1);
    emit_comment(
        e, emit_name(e, "%s to %s: cyclic", g->order[r->first]->name, g->order[r->last]->name));
    for (uint32_t rank = r->first; rank <= r->last; rank++) {
        const node *n = g->order[rank];
        uint32_t back = runs(e, n) ? back_to(e, n) : NO_RANK;
        if (back != NO_RANK) {
            target[back - r->first] = true;
        }
        if (runs(e, n) && emit_may_run_once(n)) {
            emit_line(e, "int %s = 0;", done(e, n));
        }
    }
    for (uint32_t rank = r->first; rank <= r->last; rank++) {
        if (runs(e, g->order[rank])) {
            emit_turn(e, g->order[rank], target[rank - r->first]);
        }
    }
}

/* ---- the function ---------------------------------------------------------------------------- */

static void emit_region(emitter *e, series *s, const region *r)
{
    if (r->cyclic) {
        emit_series_item(e, s, r->last - r->first + 1);
        emit_cyclic(e, r);
        return;
    }
    for (uint32_t rank = r->first; rank <= r->last; rank++) {
        const node *n = e->form->graph->order[rank];
        if (!runs(e, n)) {
            continue;
        }
        emit_series_item(e, s, 1);
        if (emit_in_flow(e, n)) {
            rank = emit_flow(e, n);
        } else {
            emit_straight(e, n);
        }
    }
}

/* What still waits at one input because another had nothing. */
static void emit_leftovers(emitter *e, series *s)
{
    const graph *g = e->form->graph;
    for (uint32_t rank = 0; rank < g->node_count; rank++) {
        const node *n = g->order[rank];
        for (uint32_t i = 0; runs(e, n) && n->input_count > 1 && i < n->input_count; i++) {
            emit_series_item(e, s, 1);
            emit_line(e, "pcg_queue_clear(&g->frame, %s, %s, &%s);", emit_node_reference(e, n),
                      emit_string(e, n->inputs[i].name), emit_queue(e, &n->inputs[i]));
        }
    }
}

/* What left its ports goes to the aggregative gate, port by port. */
static void emit_gathering(emitter *e, series *s)
{
    const emit_graph *names = e->form->names;
    if (!names->gathering) {
        return;
    }
    emit_series_item(e, s, 1);
    emit_open(e, "for (pcg_u32 i = 0; i < %u; i++)", names->gathered_count);
    emit_open(e, "while (PCG_READY(g->gathered[i]))");
    emit_line(e, "PCG_TRY(pcg_queue_push(g->frame.run, &%s, PCG_TAKE(g->gathered[i])));",
              emit_queue(e, &names->gathering->inputs[0]));
    emit_close(e, "");
    emit_close(e, "");
}

void emit_run(emitter *e)
{
    const graph *g = e->form->graph;
    series s = {.name = e->form->run, .fails = true};
    emit_series_begin(e, &s);
    for (uint32_t i = 0; i < g->region_count; i++) {
        emit_region(e, &s, &g->regions[i]);
    }
    emit_gathering(e, &s);
    emit_leftovers(e, &s);
    emit_series_end(e, &s);
}

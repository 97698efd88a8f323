/* emit_flow.c - flows: stretches of the order whose nodes take a few entities at a time, and hand
 * them on at once, while these are in the cache.
 *
 * By the rules a node runs until its queue is empty before the next one begins. Where none of a
 * stretch is entered from outside of it but the first, and each takes what comes in the same order,
 * nobody can tell that from running it a batch at a time. So a flow is a run of ranks, all of them
 * nodes with one single input, and
 *   - without effect on others: what they remember is their own;
 *   - each but the first is fed by one edge, which is always open, from another one of them;
 *   - no two of them send to the same queue.
 * What is left is seen when the graph runs: entities that others hold, too, or that hold others, go
 * in one batch (pcg_flow_batch), and what the nodes say waits until it can be put in order. */
#include "emit.h"

enum {
    MOST_DEEP = 32,     /* members above one another: each takes a place on the stack */
    MOST_MEMBERS = 1024 /* libtcc gives each call of a function a place of its own there */
};

/* A node's place in its flow. Rank 0 stands for none: no node of a flow leads to it. */
typedef struct flow_place {
    uint32_t end;         /* behind the flow's last rank; 0: the node is in none */
    uint32_t child, next; /* the first that it leads to, and the next that its feeder leads to; 0: none */
} flow_place;

/* ---- which nodes may take part --------------------------------------------------------------- */

/* Nothing else can see that it ran: it is known to be so. */
static bool is_apart(uint32_t traits)
{
    const uint32_t known = TRAIT_PURE | TRAIT_STATEFUL | TRAIT_RANDOM | TRAIT_READS;
    return traits & known && !(traits & TRAIT_EFFECT);
}

static bool is_apart_value(const value *v)
{
    if (v->kind == VALUE_CALL && !is_apart(v->function->traits)) {
        return false;
    }
    for (uint32_t i = 0; i < v->count; i++) {
        if (!is_apart_value(v->operands[i])) {
            return false;
        }
    }
    return true;
}

static bool are_apart(const argument *arguments, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (!is_apart_value(arguments[i].value)) {
            return false;
        }
    }
    return true;
}

static bool are_given_apart(const node *n)
{
    bool apart = are_apart(n->arguments, n->argument_count);
    for (uint32_t i = 0; apart && i < n->item_count; i++) {
        apart = are_apart(n->items[i].arguments, n->items[i].augment->parameter_count);
    }
    for (uint32_t i = 0; apart && i < n->link_count; i++) {
        apart = !n->links[i].in || is_apart_value(n->links[i].in);
    }
    return apart;
}

static bool is_apart_node(const emitter *e, const node *n)
{
    switch (n->kind) {
    case NODE_INPUT:
    case NODE_OUTPUT:
        return true;
    case NODE_PROCEDURE:
        return is_apart(n->procedure->traits) && are_given_apart(n);
    case NODE_GRAPH:
        return e->apart[n->graph->index] && are_given_apart(n);
    default:
        return false;
    }
}

/* Graphs stand behind those that they encapsulate; what encapsulates itself is not apart. */
static void find_apart_graphs(emitter *e)
{
    e->apart = ARENA_ARRAY(e->arena, bool, e->p->graph_count);
    for (uint32_t i = 0; i < e->p->graph_count; i++) {
        const graph *g = e->p->graphs[i];
        bool apart = true;
        for (uint32_t k = 0; apart && k < g->node_count; k++) {
            apart = is_apart_node(e, g->nodes[k]);
        }
        e->apart[g->index] = apart;
    }
}

static bool may_take_part(const emitter *e, const node *n)
{
    bool single = n->input_count == 1 && !n->inputs[0].collective && !n->inputs[0].implicit;
    return single && !n->stand_in && (n->kind == NODE_PROCEDURE || n->kind == NODE_GRAPH) &&
           is_apart_node(e, n);
}

/* ---- finding them ---------------------------------------------------------------------------- */

/* The node that alone feeds another one, always; NULL. */
static const node *feeder_of(const node *n)
{
    const port *in = &n->inputs[0];
    if (in->edge_count != 1 || in->edges[0]->condition || in->edges[0]->from->blocked ||
        in->edges[0]->from->blocked_if) {
        return NULL;
    }
    return in->edges[0]->from->node;
}

static bool within(const node *n, uint32_t first, uint32_t end)
{
    return n->rank >= first && n->rank < end;
}

/* Whether another one of the nodes first … end-1 sends to the same queue. */
static bool shares_queue(const node *n, uint32_t first, uint32_t end)
{
    for (uint32_t i = 0; i < n->output_count; i++) {
        for (uint32_t k = 0; k < n->outputs[i].edge_count; k++) {
            const port *to = n->outputs[i].edges[k]->to;
            for (uint32_t j = 0; j < to->edge_count; j++) {
                const node *other = to->edges[j]->from->node;
                if (other != n && within(other, first, end)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/* Behind the last rank of the flow that begins at a rank of a region. */
static uint32_t flow_end(const emitter *e, uint32_t first, const region *r, uint32_t *depth)
{
    const graph *g = e->form->graph;
    uint32_t end = first + 1;
    depth[first] = 0;
    for (; end <= r->last && end - first < MOST_MEMBERS; end++) {
        const node *n = g->order[end], *from = may_take_part(e, n) ? feeder_of(n) : NULL;
        if (!from || !within(from, first, end) || shares_queue(n, first, end)) {
            break;
        }
        depth[end] = depth[from->rank] + 1;
        if (depth[end] == MOST_DEEP) {
            break;
        }
    }
    return end;
}

/* From behind, so that each node's children stand in their order. */
static void enter_flow(emitter *e, uint32_t first, uint32_t end)
{
    for (uint32_t rank = end; rank-- > first;) {
        flow_place *place = &e->flow[rank];
        place->end = end;
        if (rank > first) {
            flow_place *feeder = &e->flow[feeder_of(e->form->graph->order[rank])->rank];
            place->next = feeder->child;
            feeder->child = rank;
        }
    }
}

void emit_find_flows(emitter *e)
{
    const graph *g = e->form->graph;
    uint32_t *depth = ARENA_ARRAY(e->arena, uint32_t, g->node_count);
    e->flow = ARENA_ARRAY(e->arena, flow_place, g->node_count);
    if (!e->form->main || e->options->observed) {
        return;
    }
    if (!e->apart) {
        find_apart_graphs(e);
    }
    for (uint32_t i = 0; i < g->region_count; i++) {
        const region *r = &g->regions[i];
        for (uint32_t rank = r->first, end; !r->cyclic && rank <= r->last; rank = end) {
            end = may_take_part(e, g->order[rank]) ? flow_end(e, rank, r, depth) : rank + 1;
            if (end > rank + 1) {
                enter_flow(e, rank, end);
            }
        }
    }
}

bool emit_in_flow(const emitter *e, const node *n)
{
    return e->flow[n->rank].end != 0;
}

/* ---- the functions --------------------------------------------------------------------------- */

static const char *flow_name(emitter *e, const node *n)
{
    return emit_name(e, "%s_flow", e->form->functions[n->index]);
}

static void emit_batch(emitter *e, const node *n, const char *most)
{
    emit_line(e, "pcg_flow_turn(&g->frame, %u);", n->rank);
    emit_line(e, "PCG_TRY(%s(g, %s));", e->form->functions[n->index], most);
}

/* Batches of a node, and what becomes of each. */
static void emit_flow_of(emitter *e, const node *n)
{
    const char *queue = emit_queue(e, &n->inputs[0]);
    emit_line(e, "static int %s(struct %s *g)", flow_name(e, n), e->form->tag);
    emit_block(e);
    emit_line(e, "const pcg_u32 most = pcg_flow_batch(&g->frame, &%s);", queue);
    emit_blank(e);
    emit_open(e, "while (PCG_READY(%s))", queue);
    emit_batch(e, n, "most");
    for (uint32_t rank = e->flow[n->rank].child; rank; rank = e->flow[rank].next) {
        const node *next = e->form->graph->order[rank];
        if (e->flow[rank].child) {
            emit_line(e, "PCG_TRY(%s(g));", flow_name(e, next));
        } else {
            emit_batch(e, next, "PCG_FLOW_ALL");
        }
    }
    emit_close(e, "");
    emit_line(e, "return PCG_OK;");
    emit_close(e, "\n");
}

/* What a function calls stands before it. */
void emit_flow_functions(emitter *e)
{
    const graph *g = e->form->graph;
    for (uint32_t rank = g->node_count; rank-- > 0;) {
        const node *n = g->order[rank];
        if (e->flow[rank].child) {
            emit_flow_of(e, n);
        }
    }
}

uint32_t emit_flow(emitter *e, const node *n)
{
    if (!emit_in_flow(e, n)) {
        return n->rank;
    }
    uint32_t last = e->flow[n->rank].end - 1;
    emit_comment(e, emit_name(e, "%s to %s: a flow", n->name,
                              e->form->graph->order[last]->name));
    emit_open(e, "if (PCG_READY(%s))", emit_queue(e, &n->inputs[0]));
    emit_line(e, "pcg_flow_begin(&g->frame);");
    emit_line(e, "PCG_TRY(%s(g));", flow_name(e, n));
    emit_line(e, "pcg_flow_end(&g->frame);");
    emit_close(e, "");
    return last;
}

/* emit_inner.c - the function of a node that encapsulates a graph: what it is given, who enters,
 * what leaves.
 *
 * The graph's frame is made when the node first runs and kept. Each round evaluates the
 * arguments that depend on it, hands the entities in, runs the graph until nothing is left to
 * do, and takes what has come out of its gates. */
#include "emit.h"

#include <string.h>

typedef struct inner {
    const node *node;
    const form *form;            /* of the encapsulated graph */
    const char *prepare, *leave; /* functions of the node */
} inner;

/* ---- arguments ------------------------------------------------------------------------------- */

/* Sets what was given of the parameters, as far as `wanted`; what was not has its default, which
 * the graph itself evaluates. */
static bool give(emitter *e, const inner *in, bool (*wanted)(const value *v), bool write)
{
    bool any = false;
    const graph *g = in->form->graph;
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        const argument *a = &in->node->arguments[i];
        const parameter *p = &g->parameters[i];
        if (!a->given || !wanted(a->value)) {
            continue;
        }
        any = true;
        if (write) {
            const char *name = in->form->names->parameters[p->index];
            const char *to = emit_name(e, "inner->parameter.%s", name);
            emit_place(e, &a->value->span);
            emit_assign(e, to, &p->type, a->value, true);
            emit_line(e, "inner->given.%s = 1;", name);
            emit_constraints(e, p->name, p->constraints, p->constraint_count, &p->type, a->value,
                             to);
            emit_place(e, NULL);
        }
    }
    return any;
}

static bool is_per_round(const value *v)
{
    return emit_is_per_round(v);
}

static bool is_steady(const value *v)
{
    return !emit_is_per_round(v);
}

static const graph *outer(const emitter *e)
{
    return e->form->graph;
}

/* Whether the graph may have changed its own parameters the last time that it ran: what it is given
 * replaces that, and its defaults and open edges are decided anew. */
static bool may_change(const inner *in)
{
    return emit_reflects(in->form->graph);
}

/* Makes the frame, and gives it what is the same in every round of this execution. */
static void emit_prepare(emitter *e, const inner *in)
{
    e->call = "call";
    emit_node_open(e, in->prepare, ", pcg_call *call");
    emit_line(e, "struct %s *inner = n->frame;", in->form->tag);
    emit_blank(e);
    emit_open(e, "if (!inner)");
    emit_line(
        e, "inner = (struct %s *)pcg_frame_new(&g->frame, call->node, (pcg_u32)sizeof *inner, %u);",
        in->form->tag, outer(e)->cells);
    emit_line(e, "if (!inner)");
    emit_line(e, "    return PCG_FAILED;");
    emit_line(e, "%s(inner);", in->form->wire);
    emit_line(e, "n->frame = inner;");
    emit_line(e, "n->stale = 1;");
    emit_close(e, "");
    emit_line(e, "if (!n->stale)");
    emit_line(e, "    return PCG_OK;");
    emit_line(e, "n->stale = 0;");
    if (!may_change(in)) {
        give(e, in, is_steady, true);
    }
    if (may_change(in) || give(e, in, is_per_round, false)) {
        emit_line(e, "return PCG_OK; /* it starts in each round */");
    } else {
        emit_line(e, "return %s(inner);", in->form->start);
    }
    emit_close(e, "\n");
    e->call = "&call";
}

/* ---- entering -------------------------------------------------------------------------------- */

static void set_inner(emitter *e, const inner *in, const char *entity, const attribute *to,
                      const char *cells)
{
    emit_line(e, "pcg_set_cells(call.run, %s, &inner->attribute.%s, %s);", entity,
              in->form->names->attributes[to->index], cells);
}

/* The attributes that are handed in, as they are for the round's entities. */
static void hand_in(emitter *e, const inner *in, const char *entity)
{
    for (uint32_t i = 0; i < in->node->link_count; i++) {
        const attribute_link *l = &in->node->links[i];
        const char *cells = emit_name(e, "t%u", ++e->variables);
        if (l->in) {
            emit_line(e, "pcg_cell %s[%u];", cells, type_cells(&l->inner->type));
            emit_place(e, &l->in->span);
            emit_cells(e, cells, l->in);
            emit_place(e, NULL);
            set_inner(e, in, entity, l->inner, cells);
        } else if (l->kind == LINK_SHARE) {
            const char *from = emit_name(e, "%s_from", cells);
            emit_line(e, "const pcg_cell *%s = pcg_get(%s, &g->attribute.%s);", from, entity,
                      e->form->names->attributes[l->to->index]);
            emit_line(e, "pcg_cell %s[%u];", cells, type_cells(&l->inner->type));
            emit_convert_cells(e, cells, &l->inner->type, from, &l->to->type);
            set_inner(e, in, entity, l->inner, cells);
        }
    }
}

/* The input gate of the encapsulated graph that a port stands for; NULL where it was cut away. */
static const node *gate_of(const inner *in, const port *p)
{
    const graph *g = in->form->graph;
    node *const *gates = p->is_input ? g->inputs : g->outputs;
    uint32_t count = p->is_input ? g->input_count : g->output_count;
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(gates[i]->name, p->name) == 0) {
            return gates[i];
        }
    }
    return NULL;
}

static const char *gate_queue(emitter *e, const inner *in, const node *gate)
{
    const node_names *names = &in->form->names->nodes[gate->index];
    return emit_name(e, "inner->%s.%s", names->field, names->inputs[0]);
}

/* What an entity may still carry of another graph goes before it enters. */
static void enter(emitter *e, const inner *in, const port *p, const char *entity)
{
    const node *gate = gate_of(in, p);
    if (!gate) {
        emit_line(e, "pcg_entity_drop(call.run, %s);", entity);
        return;
    }
    emit_line(e, "PCG_TRY(pcg_enter(&inner->frame, %s, inner->frame.base));", entity);
    const char *before = e->entities[p->index];
    e->entities[p->index] = entity;
    hand_in(e, in, entity);
    e->entities[p->index] = before;
    emit_line(e, "PCG_TRY(pcg_queue_push(call.run, &%s, %s));", gate_queue(e, in, gate), entity);
}

static void enter_all(emitter *e, const inner *in, const port *p)
{
    const char *queue = names_of(e, p->node)->inputs[p->index];
    emit_open(e, "while (PCG_READY(n->%s))", queue);
    emit_line(e, "pcg_entity *each = PCG_TAKE(n->%s);", queue);
    enter(e, in, p, "each");
    emit_close(e, "");
}

static void enter_ports(emitter *e, const inner *in)
{
    const node *n = in->node;
    for (uint32_t i = 0; i < n->input_count; i++) {
        if (n->inputs[i].collective) {
            enter_all(e, in, &n->inputs[i]);
        } else {
            enter(e, in, &n->inputs[i], e->entities[i]);
        }
    }
}

/* ---- leaving --------------------------------------------------------------------------------- */

static bool has_links_out(const node *n)
{
    for (uint32_t i = 0; i < n->link_count; i++) {
        if (n->links[i].kind != LINK_NONE) {
            return true;
        }
    }
    return false;
}

static void write_out(emitter *e, const inner *in, const attribute_link *l)
{
    const char *name = emit_name(e, "t%u", ++e->variables);
    emit_line(e, "const pcg_cell *%s_from = pcg_get(e, &inner->attribute.%s);", name,
              in->form->names->attributes[l->inner->index]);
    emit_line(e, "pcg_cell %s[%u];", name, type_cells(&l->to->type));
    emit_convert_cells(e, name, &l->to->type, emit_name(e, "%s_from", name), &l->inner->type);
    emit_line(e, "pcg_set_cells(call->run, e, &g->attribute.%s, %s);",
              e->form->names->attributes[l->to->index], name);
}

static void write_out_all(emitter *e, const inner *in, const char *queue)
{
    emit_open(e, "for (pcg_u32 i = %s.head; i < %s.end; i++)", queue, queue);
    emit_line(e, "pcg_entity *e = %s.at[i];", queue);
    for (uint32_t i = 0; i < in->node->link_count; i++) {
        if (in->node->links[i].kind != LINK_NONE) {
            write_out(e, in, &in->node->links[i]);
        }
    }
    emit_close(e, "");
}

static void send_all(emitter *e, const inner *in, const port *p, const char *queue)
{
    emit_open(e, "while (PCG_READY(%s))", queue);
    emit_line(e, "pcg_entity *e = PCG_TAKE(%s);", queue);
    emit_line(e, "pcg_leave(call->run, e, inner->frame.base);");
    emit_line(e, "PCG_TRY(pcg_emit(call, &n->%s, e));", names_of(e, in->node)->outputs[p->index]);
    emit_close(e, "");
}

/* One entity may have come out twice: all links are written before any attribute is removed. */
static void emit_leave(emitter *e, const inner *in)
{
    const node *n = in->node;
    emit_node_open(e, in->leave, ", pcg_call *call");
    emit_line(e, "struct %s *inner = n->frame;", in->form->tag);
    emit_blank(e);
    for (uint32_t i = 0; i < n->output_count && has_links_out(n); i++) {
        const node *gate = gate_of(in, &n->outputs[i]);
        if (gate) {
            write_out_all(e, in, gate_queue(e, in, gate));
        }
    }
    for (uint32_t i = 0; i < n->output_count; i++) {
        const node *gate = gate_of(in, &n->outputs[i]);
        if (gate) {
            send_all(e, in, &n->outputs[i], gate_queue(e, in, gate));
        }
    }
    emit_line(e, "return PCG_OK;");
    emit_close(e, "\n");
}

/* ---- rounds ---------------------------------------------------------------------------------- */

static bool reads_entity(const inner *in)
{
    for (uint32_t i = 0; i < in->node->argument_count; i++) {
        if (in->node->arguments[i].given && in->node->arguments[i].value->reads_entity) {
            return true;
        }
    }
    return false;
}

static bool reads_port(const value *v, const port *p)
{
    bool here = (v->kind == VALUE_ATTRIBUTE || v->kind == VALUE_ENTITY) && v->port == p;
    for (uint32_t i = 0; i < v->count && !here; i++) {
        here = reads_port(v->operands[i], p);
    }
    return here;
}

/* Whether something that the node is given reads the entity at that input. */
static bool is_read(const node *n, const port *p)
{
    bool read = p->index == 0;
    for (uint32_t i = 0; i < n->argument_count && !read; i++) {
        read = n->arguments[i].given && reads_port(n->arguments[i].value, p);
    }
    for (uint32_t i = 0; i < n->link_count && !read; i++) {
        read = n->links[i].in && reads_port(n->links[i].in, p);
    }
    return read;
}

/* One entity of each single input; of a collective one the first is kept in view. */
void emit_take_entities(emitter *e, const node *n)
{
    e->entities = ARENA_ARRAY(e->arena, const char *, n->input_count);
    for (uint32_t i = 0; i < n->input_count; i++) {
        const char *name = names_of(e, n)->inputs[i];
        e->entities[i] = name;
        if (!n->inputs[i].collective) {
            emit_line(e, "pcg_entity *%s = PCG_TAKE(n->%s);", name, name);
        } else if (is_read(n, &n->inputs[i])) {
            emit_line(e, "pcg_entity *%s = n->%s.at[n->%s.head];", name, name, name);
        }
    }
    emit_line(e, "PCG_TRY(pcg_round(&call, %s));", e->entities[0]);
}

/* What a graph without input gates makes descends from the impulse, with the attributes that are
 * handed in. */
static void enter_impulse(emitter *e, const inner *in, const port *impulse)
{
    const char *entity = e->entities[0];
    bool always = emit_has_open_edge(impulse);
    emit_line(e, always ? "inner->impulse = %s;" : "inner->impulse = %s ? %s : g->impulse;", entity,
              entity);
    if (!always) {
        emit_open(e, "if (%s)", entity);
    }
    emit_line(e, "PCG_TRY(pcg_enter(&inner->frame, %s, inner->frame.base));", entity);
    hand_in(e, in, entity);
    if (!always) {
        emit_close(e, "");
    }
}

static void emit_execution(emitter *e, const inner *in)
{
    const node *n = in->node;
    const port *impulse = emit_impulse(n);
    if (may_change(in)) {
        give(e, in, is_steady, true);
    }
    if (give(e, in, is_per_round, true) || may_change(in)) {
        emit_line(e, "PCG_TRY(%s(inner));", in->form->start);
    }
    emit_line(e, "inner->frame.lineage = call.lineage;");
    emit_seen(e, "inner");
    if (impulse) {
        enter_impulse(e, in, impulse);
    } else if (n->input_count > 0) {
        enter_ports(e, in);
    } else {
        emit_line(e, "inner->impulse = g->impulse;");
    }
    emit_place(e, &n->span);
    emit_line(e, "PCG_TRY(%s(inner));", in->form->run);
    emit_place(e, NULL);
    if (n->output_count > 0) {
        emit_line(e, "PCG_TRY(%s(g, &call));", in->leave);
    }
    emit_line(e, "if (inner->frame.pool)");
    emit_line(e, "    pcg_pool_end(&inner->frame);");
    if (impulse) {
        emit_drop_impulse(e, impulse);
    }
    emit_seen_end(e);
}

static void emit_inner_rounds(emitter *e, const inner *in)
{
    const node *n = in->node;
    const port *impulse = emit_impulse(n);
    bool once = n->input_count == 0 || emit_is_collective(n);
    if (!once) {
        emit_open(e, "do");
    }
    if (impulse) {
        emit_take_impulse(e, impulse, reads_entity(in));
    } else if (n->input_count > 0) {
        emit_take_entities(e, n);
    } else {
        emit_line(e, "PCG_TRY(pcg_round(&call, g->impulse));");
    }
    emit_execution(e, in);
    if (!once) {
        emit_again(e);
    }
}

void emit_inner(emitter *e)
{
    const node *n = e->node;
    const char *name = e->form->functions[n->index];
    inner in = {.node = n, .form = e->encapsulated[n->graph->index]};
    in.prepare = emit_unique(e->arena, &e->globals, emit_name(e, "%s_enter", name));
    emit_prepare(e, &in);
    if (n->output_count > 0) {
        in.leave = emit_unique(e->arena, &e->globals, emit_name(e, "%s_leave", name));
        emit_leave(e, &in);
    }
    emit_node_open(e, name, emit_in_flow(e, n) ? ", pcg_u32 most" : "");
    emit_line(e, "struct %s *inner;", in.form->tag);
    emit_begin(e);
    emit_line(e, "PCG_TRY(%s(g, &call));", in.prepare);
    emit_line(e, "inner = n->frame;");
    emit_inner_rounds(e, &in);
    emit_line(e, "return PCG_OK;");
    emit_close(e, "\n");
}

/* emit_node.c - the function that runs a node: its rounds, from its queues to its kernel. */
#include "emit.h"

/* ---- what a node is -------------------------------------------------------------------------- */

bool emit_is_collective(const node *n)
{
    for (uint32_t i = 0; i < n->input_count; i++) {
        if (n->inputs[i].collective) {
            return true;
        }
    }
    return false;
}

const port *emit_impulse(const node *n)
{
    return n->input_count == 1 && n->inputs[0].implicit ? &n->inputs[0] : NULL;
}

bool emit_may_run_once(const node *n)
{
    return n->input_count == 0 || (emit_impulse(n) && !emit_has_open_edge(emit_impulse(n)));
}

bool emit_feeds_itself(const port *input)
{
    for (uint32_t i = 0; i < input->edge_count; i++) {
        if (input->edges[i]->from->node == input->node) {
            return true;
        }
    }
    return false;
}

const char *emit_ready(emitter *e, const node *n)
{
    text all = {.arena = e->arena};
    for (uint32_t i = 0; i < n->input_count; i++) {
        const char *queue = names_of(e, n)->inputs[i];
        if (!n->inputs[i].optional) {
            text_format(&all, "%sPCG_READY(n->%s)", i ? " && " : "", queue);
        }
    }
    return all.at;
}

const char *emit_instance(const node *n)
{
    return n->kind == NODE_PROCEDURE || n->kind == NODE_SURROGATE ? ".instance" : "";
}

/* ---- arguments ------------------------------------------------------------------------------- */

/* Goes over the parameters of a procedure, or of one of its augmentations; `e` NULL: only looks. */
static bool visit_arguments(emitter *e, const char *in, const formal *formals,
                            const argument *arguments, uint32_t count,
                            bool (*wanted)(const value *v))
{
    bool found = false, behind_attribute = false;
    for (uint32_t i = 0; i < count; i++) {
        const argument *a = &arguments[i];
        if (wanted(a->value)) {
            found = true;
            if (e) {
                const char *to =
                    emit_name(e, "%s.%s", in, interface_field(e->arena, formals[i].name));
                emit_place(e, a->given && !emit_is_fixed(a->value) ? &a->value->span : NULL);
                emit_assign(e, to, &formals[i].type, a->value, behind_attribute);
                emit_constraints(e, formals[i].name, formals[i].constraints,
                                 formals[i].constraint_count, &formals[i].type, a->value, to);
            }
        }
        behind_attribute |= formals[i].type.kind == TYPE_ATTRIBUTE;
    }
    return found;
}

static bool visit_all(emitter *e, const node *n, bool (*wanted)(const value *v))
{
    const procedure *f = n->procedure;
    if (n->kind != NODE_PROCEDURE) {
        return false;
    }
    bool found =
        visit_arguments(e, "n->self", f->parameters, n->arguments, f->parameter_count, wanted);
    for (uint32_t i = 0; i < n->item_count; i++) {
        const argument_item *item = &n->items[i];
        const char *in =
            e ? emit_name(e, "n->items[%u].%s", i, interface_field(e->arena, item->augment->name))
              : "";
        found |= visit_arguments(e, in, item->augment->parameters, item->arguments,
                                 item->augment->parameter_count, wanted);
    }
    return found;
}

void emit_arguments(emitter *e, bool (*wanted)(const value *v))
{
    visit_all(e, e->node, wanted);
}

bool emit_has_arguments(const node *n, bool (*wanted)(const value *v))
{
    return visit_all(NULL, n, wanted);
}

static bool is_per_round(const value *v)
{
    return emit_is_per_round(v);
}

static bool reads_entity(const value *v)
{
    return v->reads_entity;
}

/* ---- taking entities ------------------------------------------------------------------------- */

const char *emit_input_field(emitter *e, const port *p)
{
    if (p->item) {
        return emit_name(e, "n->items[%u].input", p->item->index);
    }
    return emit_name(e, "n->self.%s", interface_field(e->arena, p->name));
}

static void take_one(emitter *e, const port *p)
{
    const char *name = names_of(e, p->node)->inputs[p->index];
    e->entities[p->index] = name;
    emit_line(e, "pcg_entity *%s = PCG_TAKE(n->%s);", name, name);
}

/* The whole queue. Where the node feeds itself, what it sends must not come into the array that
 * the kernel is reading: the queue changes places with a spare one. */
static void take_all(emitter *e, const port *p)
{
    const char *name = names_of(e, p->node)->inputs[p->index], *to = emit_input_field(e, p);
    e->entities[p->index] = emit_name(e, "%s.at[0]", to);
    emit_line(e, "%s.at = n->%s.at + n->%s.head;", to, name, name);
    emit_line(e, "%s.count = n->%s.end - n->%s.head;", to, name, name);
    if (!emit_feeds_itself(p)) {
        emit_line(e, "n->%s.head = n->%s.end;", name, name);
        return;
    }
    emit_block(e);
    emit_line(e, "pcg_queue whole = n->%s;", name);
    emit_line(e, "n->%s = n->spare_%s;", name, name);
    emit_line(e, "n->spare_%s = whole;", name);
    emit_line(e, "n->spare_%s.head = n->spare_%s.end = 0;", name, name);
    emit_close(e, "");
}

static void hand_in(emitter *e, const port *p)
{
    if (p->collective || p->implicit) {
        return;
    }
    bool shape = !p->item && emit_is_shape(&p->formal->type, p->node->procedure);
    emit_line(e, "%s = %s%s;", emit_input_field(e, p), shape ? "(pcg_shape *)" : "", e->entities[p->index]);
}

void emit_take(emitter *e)
{
    const node *n = e->node;
    e->entities = ARENA_ARRAY(e->arena, const char *, n->input_count);
    for (uint32_t i = 0; i < n->input_count; i++) {
        if (n->inputs[i].collective) {
            take_all(e, &n->inputs[i]);
        } else {
            take_one(e, &n->inputs[i]);
        }
    }
    emit_line(e, "PCG_TRY(pcg_round(&call, %s));", e->entities[0]);
    for (uint32_t i = 0; i < n->input_count; i++) {
        hand_in(e, &n->inputs[i]);
    }
}

/* The impulse, where one is to be had. Entities that a source makes descend from it, or from
 * what set off the encapsulated graph that it stands in. */
void emit_take_impulse(emitter *e, const port *impulse, bool reads)
{
    const char *name = names_of(e, e->node)->inputs[0];
    e->entities = ARENA_ARRAY(e->arena, const char *, 1);
    e->entities[0] = name;
    if (emit_has_open_edge(impulse)) {
        emit_line(e, "pcg_entity *%s = PCG_TAKE(n->%s);", name, name);
        emit_line(e, "PCG_TRY(pcg_round(&call, %s));", name);
        return;
    }
    emit_line(e, "pcg_entity *%s = n->triggered ? PCG_TAKE(n->%s) : 0;", name, name);
    emit_line(e, "PCG_TRY(pcg_round(&call, %s ? %s : g->impulse));", name, name);
    if (reads) {
        emit_line(e, "if (!%s)", name);
        emit_line(e, "    return pcg_fail(&call, \"nothing leads to its impulse: there is no "
                     "entity to read\");");
    }
}

void emit_drop_impulse(emitter *e, const port *impulse)
{
    const char *name = e->entities[0];
    if (!emit_has_open_edge(impulse)) {
        emit_line(e, "if (%s)", name);
        e->depth++;
    }
    emit_line(e, "pcg_entity_drop(call.run, %s);", name);
    if (!emit_has_open_edge(impulse)) {
        e->depth--;
    }
}

/* ---- the function ---------------------------------------------------------------------------- */

void emit_node_open(emitter *e, const char *name, const char *parameters)
{
    const node *n = e->node;
    e->variables = 0;
    emit_line(e, "static int %s(struct %s *g%s)", name, e->form->tag, parameters);
    emit_block(e);
    emit_line(e, "struct %s *n = &%s;", e->form->functions[n->index], emit_node_path(e, n));
}

void emit_begin(emitter *e)
{
    const node *n = e->node;
    const port *impulse = emit_impulse(n);
    emit_line(e, "pcg_call call;");
    emit_blank(e);
    if (impulse && !emit_has_open_edge(impulse)) {
        emit_line(e, "if (n->triggered && !%s)", emit_ready(e, n));
        emit_line(e, "    return PCG_OK;");
    } else if (n->input_count > 0) {
        emit_line(e, n->input_count > 1 ? "if (!(%s))" : "if (!%s)", emit_ready(e, n));
        emit_line(e, "    return PCG_OK;");
    }
    emit_line(e, "pcg_begin(&call, &g->frame, %s, &n->self%s);", emit_node_reference(e, n),
              emit_instance(n));
}

void emit_again(emitter *e)
{
    const char *most = emit_in_flow(e, e->node) ? "--most && " : "";
    emit_close(e, emit_name(e, " while (%s%s);", most, emit_ready(e, e->node)));
}

static void emit_kernel(emitter *e)
{
    emit_arguments(e, is_per_round);
    emit_place(e, NULL);
    emit_seen(e, "n");
    emit_place(e, &e->node->span);
    emit_line(e, "PCG_TRY(%s(&call, &n->self));",
              emit_kernel_name(e, e->node->procedure->symbol, "&call"));
    emit_place(e, NULL);
}

static void emit_rounds(emitter *e)
{
    const node *n = e->node;
    const port *impulse = emit_impulse(n);
    if (n->input_count == 0) {
        emit_line(e, "PCG_TRY(pcg_round(&call, g->impulse));");
        emit_kernel(e);
        emit_seen_end(e);
        return;
    }
    bool once = emit_is_collective(n);
    if (!once) {
        emit_open(e, "do");
    }
    if (impulse) {
        emit_take_impulse(e, impulse, emit_has_arguments(n, reads_entity));
    } else {
        emit_take(e);
    }
    emit_kernel(e);
    if (impulse) {
        emit_drop_impulse(e, impulse);
    }
    emit_seen_end(e);
    if (!once) {
        emit_again(e);
    }
}

static void emit_procedure(emitter *e)
{
    emit_begin(e);
    emit_rounds(e);
}

static void emit_gate(emitter *e)
{
    const node_names *names = names_of(e, e->node);
    emit_begin(e);
    emit_open(e, "do");
    emit_line(e, "PCG_TRY(pcg_emit(&call, &n->%s, PCG_TAKE(n->%s)));", names->outputs[0],
              names->inputs[0]);
    emit_close(e, emit_name(e, " while (%s);", emit_ready(e, e->node)));
}

void emit_node(emitter *e)
{
    const node *n = e->node;
    if (n->kind == NODE_OUTPUT) {
        return;
    }
    emit_node_comment(e, n);
    emit_seen_tables(e);
    if (n->kind == NODE_GRAPH) {
        emit_inner(e);
        return;
    }
    if (n->kind == NODE_SURROGATE) {
        emit_surrogate(e);
        return;
    }
    emit_node_open(e, e->form->functions[n->index], emit_in_flow(e, n) ? ", pcg_u32 most" : "");
    if (n->kind == NODE_PROCEDURE) {
        emit_procedure(e);
    } else {
        emit_gate(e);
    }
    emit_line(e, "return PCG_OK;");
    emit_close(e, "\n");
}

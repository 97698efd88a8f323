/* emit_seen.c - the observed form: what tells an observer of rounds, with the entities that they
 * take and the parameters that they are given. */
#include "emit.h"


/* ---- parameters ------------------------------------------------------------------------------ */

static const char *storage_of(const type *t, bool in_frame)
{
    if (t->kind == TYPE_ANY) {
        return "PCG_SEEN_ANY";
    }
    if (t->kind != TYPE_VALUE) {
        return "PCG_SEEN_NAME";
    }
    bool narrow = type_is(t, PCG_BOOL) || type_is(t, PCG_ENUM);
    return narrow && !in_frame ? "PCG_SEEN_INT" : "PCG_SEEN_CELLS";
}

/* What a value of any kind is made of is known from what it was given. */
static void seen_row(emitter *e, const char *name, const type *t, const value *given,
                     const char *tag, const char *field, bool in_frame)
{
    bool typed = t->kind == TYPE_ANY && given && given->type.kind == TYPE_VALUE;
    const type *exact = typed ? &given->type : t;
    bool is_value = exact->kind == TYPE_VALUE;
    const char *named =
        t->kind == TYPE_ATTRIBUTE && given ? value_text(e->arena, given) : NULL;
    emit_line(e, "{%s, %s, %s, %s,", emit_string(e, name), emit_string(e, type_text(e->arena, t)),
              is_value ? emit_enumerators(e, exact) : "0", emit_string(e, named));
    emit_line(e, " %s, %s, %s, PCG_OFFSET(struct %s, %s)},", is_value ? emit_kind(exact) : "0",
              is_value && type_is(exact, PCG_LIST) ? emit_kind(exact->element) : "0",
              storage_of(t, in_frame), tag, field);
}

static void procedure_rows(emitter *e, const node *n)
{
    const char *tag = e->form->functions[n->index];
    for (uint32_t i = 0; i < n->procedure->parameter_count; i++) {
        const formal *f = &n->procedure->parameters[i];
        const char *field = emit_name(e, "self.%s", interface_field(e->arena, f->name));
        seen_row(e, f->name, &f->type, n->arguments[i].value, tag, field, false);
    }
    for (uint32_t i = 0; i < n->item_count; i++) {
        const argument_item *item = &n->items[i];
        const char *own = interface_field(e->arena, item->augment->name);
        for (uint32_t k = 0; k < item->augment->parameter_count; k++) {
            const formal *f = &item->augment->parameters[k];
            const char *field =
                emit_name(e, "items[%u].%s.%s", i, own, interface_field(e->arena, f->name));
            seen_row(e, emit_name(e, "%s.%s", item->name, f->name), &f->type,
                     item->arguments[k].value, tag, field, false);
        }
    }
}

static void graph_rows(emitter *e, const node *n)
{
    const form *inner = e->encapsulated[n->graph->index];
    for (uint32_t i = 0; i < n->graph->parameter_count; i++) {
        const parameter *p = &n->graph->parameters[i];
        const char *field = emit_name(e, "parameter.%s", inner->names->parameters[p->index]);
        seen_row(e, p->name, &p->type, n->arguments[i].value, inner->tag, field, true);
    }
}

/* The graph's name, and what the braces declare. */
static void surrogate_rows(emitter *e, const node *n)
{
    const char *tag = e->form->functions[n->index];
    uint32_t first = n->procedure->parameter_count;
    const formal *name = n->arguments[0].formal;
    seen_row(e, name->name, &name->type, NULL, tag, "chosen", true);
    for (uint32_t i = first; i < n->argument_count; i++) {
        const argument *a = &n->arguments[i];
        seen_row(e, a->formal->name, &a->formal->type, a->value, tag,
                 emit_name(e, "given_%u", i - first), true);
    }
}

static uint32_t parameter_count(const node *n)
{
    if (n->kind == NODE_SURROGATE) {
        return 1 + n->argument_count - n->procedure->parameter_count;
    }
    uint32_t count =
        n->kind == NODE_GRAPH ? n->graph->parameter_count : n->procedure->parameter_count;
    for (uint32_t i = 0; i < n->item_count; i++) {
        count += n->items[i].augment->parameter_count;
    }
    return count;
}

/* ---- graphs ---------------------------------------------------------------------------------- */

static void queue_row(emitter *e, const node *n, const char *name, const char *queue, bool leaf)
{
    emit_line(e, "{%s, %s, PCG_OFFSET(struct %s, %s), %d},", emit_node_reference(e, n),
              emit_string(e, name), e->form->tag, queue, leaf);
}

/* What left leaf ports, then what the aggregative gate takes, lies before the nodes. */
static uint32_t leaf_rows(emitter *e)
{
    const graph *g = e->form->graph;
    uint32_t count = 0, gathered = 0;
    for (uint32_t i = 0; i < g->node_count; i++) {
        for (uint32_t k = 0; k < g->nodes[i]->output_count; k++) {
            const port *p = &g->nodes[i]->outputs[k];
            if (emit_is_leaf(e, p)) {
                const char *queue = emit_name(e, "leaf[%u]", emit_leaf_number(e, p));
                queue_row(e, p->node, p->name, queue, true);
                count++;
            }
        }
    }
    for (uint32_t i = 0; i < g->node_count; i++) {
        for (uint32_t k = 0; k < g->nodes[i]->output_count; k++) {
            const port *p = &g->nodes[i]->outputs[k];
            if (p->gathered_by) {
                queue_row(e, p->node, p->name, emit_name(e, "gathered[%u]", gathered++), true);
                count++;
            }
        }
    }
    return count;
}

static uint32_t queue_rows(emitter *e)
{
    const graph *g = e->form->graph;
    uint32_t count = leaf_rows(e);
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        for (uint32_t k = 0; k < n->input_count && emit_takes_part(e, n); k++) {
            const node_names *names = names_of(e, n);
            queue_row(e, n, n->inputs[k].name, emit_name(e, "%s.%s", names->field, names->inputs[k]),
                      false);
            count++;
        }
    }
    return count;
}

static uint32_t form_number(const emitter *e)
{
    uint32_t number = 0;
    while (e->forms.at[number] != e->form) {
        number++;
    }
    return number;
}

void emit_seen_graph(emitter *e)
{
    const form *f = e->form;
    if (!e->options->observed) {
        return;
    }
    text rows, *back = emit_capture(e, &rows);
    uint32_t queues = queue_rows(e);
    emit_restore(e, back, NULL);
    if (queues > 0) {
        emit_open(e, "static const pcg_seen_queue queues_%s[%u] =", f->tag, queues);
        emit_restore(e, e->out, &rows);
        emit_close(e, ";");
    }
    const char *seen = emit_name(e, "seen_%s", f->tag);
    uint32_t attributes = f->graph->attribute_count;
    emit_attribute_table(e, seen);
    emit_line(e, "static const pcg_seen_graph watched_%s = {%s, %s, %s, %u, %u, %u};\n", f->tag,
              emit_string(e, f->graph->name), queues ? emit_name(e, "queues_%s", f->tag) : "0",
              attributes ? emit_name(e, "%s_attributes", seen) : "0", queues, attributes,
              form_number(e));
}

/* ---- tables ---------------------------------------------------------------------------------- */

static bool is_seen(const emitter *e)
{
    node_kind kind = e->node->kind;
    return e->options->observed && (kind == NODE_PROCEDURE || kind == NODE_GRAPH || kind == NODE_SURROGATE);
}

void emit_seen_tables(emitter *e)
{
    if (!is_seen(e)) {
        return;
    }
    const node *n = e->node;
    const char *name = e->form->functions[n->index];
    uint32_t parameters = parameter_count(n);
    if (n->input_count > 0) {
        emit_open(e, "static const char *const inputs_%s[%u] =", name, n->input_count);
        for (uint32_t i = 0; i < n->input_count; i++) {
            emit_line(e, "%s,", emit_string(e, n->inputs[i].name));
        }
        emit_close(e, ";");
    }
    if (parameters > 0) {
        emit_open(e, "static const pcg_seen_parameter parameters_%s[%u] =", name, parameters);
        if (n->kind == NODE_GRAPH) {
            graph_rows(e, n);
        } else if (n->kind == NODE_SURROGATE) {
            surrogate_rows(e, n);
        } else {
            procedure_rows(e, n);
        }
        emit_close(e, ";");
    }
    emit_line(e, "static const pcg_seen round_%s = {&watched_%s, %s, %s, %u, %u};", name,
              e->form->tag, n->input_count ? emit_name(e, "inputs_%s", name) : "0",
              parameters ? emit_name(e, "parameters_%s", name) : "0", n->input_count, parameters);
}

/* ---- rounds ---------------------------------------------------------------------------------- */

/* seen[i]: the entities that a round takes from an input. */
static void seen_input(emitter *e, const port *p)
{
    const char *queue = names_of(e, p->node)->inputs[p->index];
    uint32_t i = p->index;
    if (!p->collective) {
        bool always = !p->implicit || emit_has_open_edge(p);
        emit_line(e, "seen[%u].at = &%s;", i, e->entities[i]);
        emit_line(e, always ? "seen[%u].count = 1;" : "seen[%u].count = %s != 0;", i,
                  e->entities[i]);
    } else if (p->node->kind != NODE_PROCEDURE) {
        emit_line(e, "seen[%u].at = n->%s.at + n->%s.head;", i, queue, queue);
        emit_line(e, "seen[%u].count = n->%s.end - n->%s.head;", i, queue, queue);
    } else {
        emit_line(e, "seen[%u] = %s;", i, emit_input_field(e, p));
    }
}

void emit_seen(emitter *e, const char *self)
{
    if (!is_seen(e)) {
        return;
    }
    const node *n = e->node;
    emit_block(e);
    if (n->input_count > 0) {
        emit_line(e, "pcg_entities seen[%u];", n->input_count);
    }
    for (uint32_t i = 0; i < n->input_count; i++) {
        seen_input(e, &n->inputs[i]);
    }
    emit_line(e, "pcg_round_seen(&call, &round_%s, %s, %s);", e->form->functions[n->index], self,
              n->input_count > 0 ? "seen" : "0");
    emit_close(e, "");
}

void emit_seen_end(emitter *e)
{
    if (is_seen(e)) {
        emit_line(e, "pcg_round_over(&call);");
    }
}

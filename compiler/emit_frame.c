/* emit_frame.c - the structs: what a node holds, what a graph holds. */
#include "emit.h"

#include <string.h>

/* ---- nodes ----------------------------------------------------------------------------------- */

static void emit_self(emitter *e, const node *n)
{
    if (n->kind == NODE_SURROGATE) {
        emit_surrogate_fields(e, n);
        return;
    }
    if (n->kind != NODE_PROCEDURE) {
        emit_line(e, "pcg_instance self;");
        return;
    }
    emit_line(e, "struct %s self;", n->procedure->symbol);
    if (n->item_count > 0) {
        emit_line(e, "struct %s_item items[%u];", n->procedure->symbol, n->item_count);
    }
}

static void emit_queues(emitter *e, const node *n)
{
    for (uint32_t i = 0; i < n->input_count; i++) {
        emit_line(e, "pcg_queue %s;", names_of(e, n)->inputs[i]);
        if (n->inputs[i].collective && emit_feeds_itself(&n->inputs[i])) {
            emit_line(e, "pcg_queue spare_%s;", names_of(e, n)->inputs[i]);
        }
    }
}

static void emit_output(emitter *e, const port *p)
{
    const node_names *names = names_of(e, p->node);
    emit_line(e, "pcg_port %s;", names->outputs[p->index]);
    uint32_t most = p->edge_count;
    if (!emit_has_open_edge(p) && (emit_is_leaf(e, p) || p->gathered_by)) {
        most = most > 1 ? most : 1;
    }
    if (most > 0) {
        emit_line(e, "pcg_queue *%s[%u];", names->leads[p->index], most);
    }
}

static void emit_node_struct(emitter *e, const node *n)
{
    emit_node_comment(e, n);
    emit_open(e, "struct %s", e->form->functions[n->index]);
    emit_self(e, n);
    if (n->kind == NODE_GRAPH) {
        emit_line(e, "struct %s *frame;", e->encapsulated[n->graph->index]->tag);
        emit_line(e, "int stale; /* what it is given has to be evaluated */");
    }
    if (emit_impulse(n)) {
        emit_line(e, "int triggered; /* an edge to its impulse is open */");
    }
    emit_queues(e, n);
    for (uint32_t i = 0; i < n->output_count; i++) {
        emit_output(e, &n->outputs[i]);
    }
    emit_close(e, ";\n");
}

/* ---- the graph ------------------------------------------------------------------------------- */

static void emit_parameters(emitter *e, const graph *g)
{
    if (g->parameter_count == 0) {
        return;
    }
    emit_open(e, "struct");
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        const parameter *p = &g->parameters[i];
        emit_line(e, "%s%s;", emit_storage_type(e, &p->type), e->form->names->parameters[p->index]);
    }
    emit_close(e, " parameter;");
    emit_open(e, "struct");
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        emit_line(e, "pcg_u8 %s;", e->form->names->parameters[g->parameters[i].index]);
    }
    emit_close(e, " given; /* set from outside */");
}

static void emit_graph_constants(emitter *e, const graph *g)
{
    if (g->constant_count == 0) {
        return;
    }
    emit_open(e, "struct");
    for (uint32_t i = 0; i < g->constant_count; i++) {
        const constant *k = &g->constants[i];
        emit_line(e, "%s%s;", emit_c_type(e, &k->type), e->form->names->constants[k->index]);
    }
    emit_close(e, " constant;");
}

static void emit_attributes(emitter *e, const graph *g)
{
    if (g->attribute_count == 0) {
        return;
    }
    emit_open(e, "struct");
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        emit_line(e, "pcg_slot %s;", e->form->names->attributes[g->attributes[i].index]);
    }
    emit_close(e, " attribute;");
    emit_open(e, "struct");
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        const attribute *a = &g->attributes[i];
        emit_line(e, "pcg_cell %s[%u];", e->form->names->attributes[a->index],
                  type_cells(&a->type));
    }
    emit_close(e, " initial; /* of the attributes */");
}

/* What the host touches: whether it fed a gate, and what came out of leaf ports. */
static void emit_host_side(emitter *e, const graph *g)
{
    if (g->input_count > 0) {
        emit_open(e, "struct");
        for (uint32_t i = 0; i < g->input_count; i++) {
            emit_line(e, "pcg_u8 %s;", emit_fed(e, g->inputs[i]));
        }
        emit_close(e, " fed; /* by the host: no stand-in runs */");
    }
    uint32_t count = emit_leaf_count(e);
    if (count > 0) {
        emit_line(e, "pcg_queue leaf[%u]; /* what left ports that lead nowhere */", count);
    }
}

static const char *last_name(const char *field)
{
    const char *dot = strrchr(field, '.');
    return dot ? dot + 1 : field;
}

static void emit_node_fields(emitter *e, const graph *g)
{
    for (uint32_t i = 0; i < g->node_count; i++) {
        bool parts = g->node_count > EMIT_PART_NODES;
        if (parts && i % EMIT_PART_NODES == 0) {
            emit_open(e, "struct");
            emit_line(e, "pcg_u8 present; /* so that it is never empty */");
        }
        if (emit_takes_part(e, g->nodes[i])) {
            emit_line(e, "struct %s %s;", e->form->functions[i],
                      last_name(e->form->names->nodes[i].field));
        }
        if (parts && (i % EMIT_PART_NODES == EMIT_PART_NODES - 1 || i + 1 == g->node_count)) {
            emit_close(e, emit_name(e, " part_%u;", i / EMIT_PART_NODES));
        }
    }
}

void emit_frames(emitter *e)
{
    const graph *g = e->form->graph;
    for (uint32_t i = 0; i < g->node_count; i++) {
        if (emit_takes_part(e, g->nodes[i])) {
            emit_node_struct(e, g->nodes[i]);
        }
    }
    emit_open(e, "struct %s", e->form->tag);
    emit_line(e, "pcg_frame frame;");
    emit_line(e, "pcg_instance own; /* of expressions that belong to no node */");
    emit_line(e, "const pcg_entity *impulse; /* what its sources descend from, or NULL */");
    emit_parameters(e, g);
    emit_graph_constants(e, g);
    emit_attributes(e, g);
    if (e->form->main) {
        emit_host_side(e, g);
    }
    if (e->form->names->gathered_count > 0) {
        emit_line(e, "pcg_queue gathered[%u]; /* what the aggregative gate takes, port by port */",
                  e->form->names->gathered_count);
    }
    emit_node_fields(e, g);
    emit_close(e, ";\n");
}

/* emit_module.c - the tables that describe a module: nodes, parameters, ports, attributes,
 * edges; pcg_module. */
#include "closure.h"
#include "emit.h"

/* ---- nodes ----------------------------------------------------------------------------------- */

static const char *procedure_name(const node *n)
{
    switch (n->kind) {
    case NODE_PROCEDURE:
        return n->procedure->name;
    case NODE_GRAPH:
        return n->graph->name;
    case NODE_INPUT:
        return "in";
    case NODE_OUTPUT:
        return "out";
    default:
        return n->tree ? n->tree->procedure.text : "";
    }
}

/* Whether a round's first entity does not tell whether it brings shapes: others may come with it,
 * or, from a source that it sets off, behind it. */
static bool is_mixed(const node *n)
{
    bool all_parts = true;
    for (uint32_t i = 0; i < n->input_count; i++) {
        all_parts &= emit_is_part(&n->inputs[i].type);
    }
    return !all_parts &&
           (n->input_count > 1 || n->inputs[0].collective || n->inputs[0].implicit);
}

static void emit_node_row(emitter *e, const char *name, const char *of, const graph *g, span place,
                          uint32_t index, uint64_t key, bool mixed)
{
    uint32_t line = 0, column = 0;
    if (place.source) {
        source_place(place.source, place.from, &line, &column);
    }
    emit_line(e, "{%s, %s, %s, %s, %u, %u, %u, %s, %d},", emit_string(e, name), emit_string(e, of),
              emit_string(e, g->name), emit_string(e, place.source ? place.source->path : ""), line,
              column, index, arena_format(e->arena, "0x%016llxULL", (unsigned long long)key), mixed);
}

void emit_node_table(emitter *e)
{
    emit_line(e, "/* ---- nodes ---- */\n");
    emit_open(e, "static const pcg_node pcg_nodes[%u] =", e->node_count);
    for (uint32_t i = 0; i < e->p->graph_count; i++) {
        const emit_graph *names = &e->graphs[i];
        const graph *g = names->graph;
        for (uint32_t k = 0; g && k < g->node_count; k++) {
            const node *n = g->nodes[k];
            emit_node_row(e, n->name, procedure_name(n), g, n->span, names->first_node + k, n->key,
                          is_mixed(n));
        }
        if (g) { /* what belongs to no node: parameters, constants, defaults */
            emit_node_row(e, g->name, "graph", g, g->tree->name.span,
                          names->first_node + g->node_count, 0, false);
        }
    }
    emit_close(e, ";\n");
}

/* ---- offsets --------------------------------------------------------------------------------- */

static const char *offset(emitter *e, const char *field)
{
    return emit_name(e, "PCG_OFFSET(struct %s, %s)", e->form->tag, field);
}

static const char *own_queue(emitter *e, const node *gate)
{
    const node_names *names = names_of(e, gate);
    return offset(e, emit_name(e, "%s.%s", names->field, names->inputs[0]));
}

static const char *written_type(emitter *e, const type *t)
{
    return emit_string(e, type_text(e->arena, t));
}

static const char *element_kind(const type *t)
{
    return type_is(t, PCG_LIST) ? emit_kind(t->element) : "0";
}

/* ---- parameters ------------------------------------------------------------------------------ */

static void emit_constraint_table(emitter *e, const char *prefix, const parameter *p)
{
    if (p->constraint_count == 0) {
        return;
    }
    emit_open(e, "static const pcg_constraint_info %s_constraints_%u[%u] =", prefix, p->index,
              p->constraint_count);
    for (uint32_t i = 0; i < p->constraint_count; i++) {
        const pcg_constraint_info *k = &p->constraints[i];
        emit_line(e, "{%d, %s, %s, %s},", k->kind, emit_float(e, k->low), emit_float(e, k->high),
                  emit_string(e, k->text));
    }
    emit_close(e, ";");
}

static void emit_parameter_row(emitter *e, const char *prefix, const parameter *p)
{
    const char *name = e->form->names->parameters[p->index];
    text initial = {.arena = e->arena};
    if (p->tree->initial) {
        lang_write_expression(p->tree->initial, &initial);
    } else {
        text_add(&initial, value_text(e->arena, p->initial));
    }
    const char *constraints =
        p->constraint_count ? emit_name(e, "%s_constraints_%u", prefix, p->index) : "0";
    emit_line(e, "{%s, %s,", emit_string(e, p->name), emit_string(e, p->tree->head.document));
    emit_line(e, " %s, %s, %s,", written_type(e, &p->type), emit_string(e, initial.at),
              emit_enumerators(e, &p->type));
    emit_line(e, " %s, %u, %s, %s, %d,", constraints, p->constraint_count, emit_kind(&p->type),
              element_kind(&p->type), p->hidden);
    emit_line(e, " %s,", offset(e, emit_name(e, "parameter.%s", name)));
    emit_line(e, " %s},", offset(e, emit_name(e, "given.%s", name)));
}

void emit_parameter_table(emitter *e, const char *prefix)
{
    const graph *g = e->form->graph;
    if (g->parameter_count == 0) {
        return;
    }
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        emit_constraint_table(e, prefix, &g->parameters[i]);
    }
    emit_open(e, "static const pcg_parameter_info %s_parameters[%u] =", prefix, g->parameter_count);
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        emit_parameter_row(e, prefix, &g->parameters[i]);
    }
    emit_close(e, ";\n");
}

/* ---- attributes ------------------------------------------------------------------------------ */

void emit_attribute_table(emitter *e, const char *prefix)
{
    const graph *g = e->form->graph;
    if (g->attribute_count == 0) {
        return;
    }
    emit_open(e, "static const pcg_attribute_info %s_attributes[%u] =", prefix, g->attribute_count);
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        const attribute *a = &g->attributes[i];
        emit_line(e, "{%s, %s,", emit_string(e, a->name), emit_string(e, a->tree->head.document));
        emit_line(e, " %s, %s, %s, %s, %u,", written_type(e, &a->type),
                  emit_enumerators(e, &a->type), emit_kind(&a->type), element_kind(&a->type),
                  a->cell);
        emit_line(e, " %s},",
                  offset(e, emit_name(e, "initial.%s", e->form->names->attributes[a->index])));
    }
    emit_close(e, ";\n");
}

/* ---- gates and leaf ports -------------------------------------------------------------------- */

static void emit_port_row(emitter *e, const char *name, const char *document, const port *p,
                          const char *queue, const char *given)
{
    emit_line(e, "{%s, %s, %s, %s, %d, %s, %s},", emit_string(e, name), emit_string(e, document),
              written_type(e, &p->type), emit_bases(e, &p->type), p->collective, queue, given);
}

static void emit_inputs(emitter *e)
{
    const graph *g = e->form->graph;
    if (g->input_count == 0) {
        return;
    }
    emit_open(e, "static const pcg_port_info %s_inputs[%u] =", e->module, g->input_count);
    for (uint32_t i = 0; i < g->input_count; i++) {
        const node *n = g->inputs[i];
        const char *fed = offset(e, emit_name(e, "fed.%s", emit_fed(e, n)));
        emit_port_row(e, n->name, n->gate->head.document, &n->inputs[0], own_queue(e, n), fed);
    }
    emit_close(e, ";\n");
}

static const char *leaf_document(const port *p)
{
    if (p->item) {
        return p->item->augment->tree->head.document;
    }
    return p->formal && p->formal->tree ? p->formal->tree->head.document : NULL;
}

static void emit_outputs(emitter *e)
{
    const graph *g = e->form->graph;
    uint32_t count = g->output_count + emit_leaf_count(e);
    if (count == 0) {
        return;
    }
    emit_open(e, "static const pcg_port_info %s_outputs[%u] =", e->module, count);
    for (uint32_t i = 0; i < g->output_count; i++) {
        const node *n = g->outputs[i];
        emit_port_row(e, n->name, n->gate->head.document, &n->inputs[0], own_queue(e, n), "0");
    }
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        for (uint32_t k = 0; k < n->output_count; k++) {
            const port *p = &n->outputs[k];
            if (emit_is_leaf(e, p)) {
                const char *queue = emit_name(e, "leaf[%u]", emit_leaf_number(e, p));
                emit_port_row(e, emit_name(e, "%s.%s", n->name, p->name), leaf_document(p), p,
                              offset(e, queue), "0");
            }
        }
    }
    emit_close(e, ";\n");
}

/* ---- ports and edges of all graphs ----------------------------------------------------------- */

static void emit_ports(emitter *e)
{
    if (e->port_count == 0) {
        return;
    }
    emit_open(e, "static const pcg_output_info pcg_ports[%u] =", e->port_count);
    for (uint32_t i = 0; i < e->p->graph_count; i++) {
        const emit_graph *names = &e->graphs[i];
        for (uint32_t k = 0; names->graph && k < names->graph->node_count; k++) {
            const node *n = names->graph->nodes[k];
            for (uint32_t o = 0; o < n->output_count; o++) {
                emit_line(e, "{%u, %s},", names->first_node + k,
                          emit_string(e, n->outputs[o].name));
            }
        }
    }
    emit_close(e, ";\n");
}

/* The edges from a port, and the gate that gathers what leaves it. Returns how many there are;
 * `write`: as rows. */
static uint32_t edges_of(emitter *e, const emit_graph *names, const port *p, bool write)
{
    uint32_t number = names->nodes[p->node->index].first_port + p->index;
    for (uint32_t i = 0; write && i < p->edge_count; i++) {
        emit_line(e, "{%u, %u},", number, names->first_node + p->edges[i]->to->node->index);
    }
    if (write && p->gathered_by) {
        emit_line(e, "{%u, %u},", number, names->first_node + p->gathered_by->index);
    }
    return p->edge_count + (p->gathered_by != NULL);
}

/* Stand-ins run in the main graph alone. */
static uint32_t edges_of_graph(emitter *e, const emit_graph *names, bool write)
{
    uint32_t count = 0;
    for (uint32_t k = 0; names->graph && k < names->graph->node_count; k++) {
        const node *n = names->graph->nodes[k];
        for (uint32_t o = 0; o < n->output_count && (!n->stand_in || names->graph == e->p->main);
             o++) {
            count += edges_of(e, names, &n->outputs[o], write);
        }
    }
    return count;
}

static uint32_t emit_edges(emitter *e)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < e->p->graph_count; i++) {
        count += edges_of_graph(e, &e->graphs[i], false);
    }
    if (count == 0) {
        return 0;
    }
    emit_open(e, "static const pcg_edge_info pcg_edges[%u] =", count);
    for (uint32_t i = 0; i < e->p->graph_count; i++) {
        edges_of_graph(e, &e->graphs[i], true);
    }
    emit_close(e, ";\n");
    return count;
}

/* ---- kernels of other libraries -------------------------------------------------------------- */

static void emit_kernels(emitter *e)
{
    if (e->kernels.count == 0) {
        return;
    }
    emit_open(e, "static const pcg_kernel_info pcg_kernels[%u] =", e->kernels.count);
    for (uint32_t i = 0; i < e->kernels.count; i++) {
        const pcg_kernel_info *k = &e->kernels.at[i];
        emit_line(e, "{%s, %s, %s},", emit_string(e, k->library), emit_string(e, k->symbol),
                  arena_format(e->arena, "0x%llxull", k->layout));
    }
    emit_close(e, ";\n");
}

/* ---- the module ------------------------------------------------------------------------------ */

static void emit_entries(emitter *e)
{
    emit_line(e, "static int %s_module_start(pcg_frame *f)", e->module);
    emit_block(e);
    emit_line(e, "struct %s *g = (struct %s *)f;", e->form->tag, e->form->tag);
    emit_blank(e);
    emit_line(e, "%s(g);", e->form->wire);
    emit_line(e, "return %s(g);", e->form->start);
    emit_close(e, "\n");
    emit_line(e, "static int %s_module_restart(pcg_frame *f)", e->module);
    emit_block(e);
    emit_line(e, "return %s((struct %s *)f);", e->form->start, e->form->tag);
    emit_close(e, "\n");
    emit_line(e, "static int %s_module_run(pcg_frame *f)", e->module);
    emit_block(e);
    emit_line(e, "return %s((struct %s *)f);", e->form->run, e->form->tag);
    emit_close(e, "\n");
}

/* "pcg_parameters", or 0 where the table has no rows. */
static const char *table_name(emitter *e, uint32_t count, const char *rows)
{
    return count > 0 ? emit_name(e, "%s_%s", e->module, rows) : "0";
}

static void emit_module_tables(emitter *e)
{
    const graph *g = e->form->graph;
    uint32_t outputs = g->output_count + emit_leaf_count(e);
    emit_line(e, "%s, %s, %s,", table_name(e, g->parameter_count, "parameters"),
              table_name(e, g->input_count, "inputs"), table_name(e, outputs, "outputs"));
    emit_line(e, "%s, pcg_nodes,", table_name(e, g->attribute_count, "attributes"));
    emit_line(e, "%s, %s, %s,", e->port_count > 0 ? "pcg_ports" : "0",
              e->edge_count > 0 ? "pcg_edges" : "0", e->kernels.count > 0 ? "pcg_kernels" : "0");
    emit_line(e, "%u, %u, %u, %u, %u, %u, %u, %u, %u,", g->parameter_count, g->input_count, outputs,
              g->attribute_count, e->node_count, e->port_count, e->edge_count,
              e->kernels.count, g->output_count);
    emit_line(e, "(pcg_u32)sizeof(struct %s),", e->form->tag);
}

/* A file that holds nothing but its main graph documents it. */
static const char *document_of(const graph *g)
{
    return g->tree->head.document ? g->tree->head.document : g->unit->tree->document;
}

static void emit_backends(emitter *e)
{
    const char *name = emit_name(e, "pcg_graph_%s", e->p->main->symbol);
    emit_line(e, "/* What has this graph built in links it by its own name; a shared object is "
                 "asked for one of its own. */");
    emit_line(e, "#ifdef PCG_SHARED");
    emit_line(e, "#define %s pcg_compiled", name);
    emit_line(e, "#endif");
    emit_line(e, "extern const pcg_module %s;", name);
    emit_open(e, "const pcg_module %s =", name);
}

static void emit_module_rows(emitter *e)
{
    const graph *g = e->form->graph;
    const closure all = closure_of(e->p, g);
    emit_line(e, "PCG_ABI, (pcg_u32)sizeof(pcg_module),");
    emit_line(e, "%s, %s, %s, %s,", emit_string(e, g->name), emit_string(e, document_of(g)),
              emit_string(e, e->options->version), emit_string(e, e->p->main->unit->folder));
    emit_module_tables(e);
    emit_line(e, "%s, %s, %d,", emit_string(e, all.digest), emit_string(e, all.tied), all.loads);
    emit_line(e, "%s_module_start, %s_module_restart, %s_module_run", e->module, e->module,
              e->module);
    emit_close(e, ";\n");
}

static void emit_own_tables(emitter *e)
{
    emit_parameter_table(e, e->module);
    emit_inputs(e);
    emit_outputs(e);
    emit_attribute_table(e, e->module);
    emit_entries(e);
}

/* What a surrogate may choose is a module of its own, with the nodes of all. */
static void emit_candidate_module(emitter *e, const form *f)
{
    e->form = f;
    e->module = emit_name(e, "choice_%u", f->graph->index);
    emit_own_tables(e);
    emit_open(e, "static const pcg_module %s =", e->module);
    emit_module_rows(e);
    e->form = NULL;
}

void emit_tables(emitter *e)
{
    emit_line(e, "/* ---- tables ---- */\n");
    emit_ports(e);
    emit_kernels(e);
    e->edge_count = emit_edges(e);
    for (uint32_t i = 0; i < e->p->graph_count; i++) {
        if (e->candidates[i]) {
            emit_candidate_module(e, e->candidates[i]);
        }
    }
}

void emit_module(emitter *e)
{
    e->form = e->main;
    e->module = "pcg";
    emit_line(e, "/* ---- the module ---- */\n");
    emit_own_tables(e);
    emit_backends(e);
    emit_module_rows(e);
    emit_line(e, "#ifdef PCG_EXECUTABLE");
    emit_line(e, "int pcg_main(const pcg_module *module, int argc, char **argv);");
    emit_line(e, "int main(int argc, char **argv)");
    emit_block(e);
    emit_line(e, "return pcg_main(&pcg_graph_%s, argc, argv);", e->p->main->symbol);
    emit_close(e, "");
    emit_line(e, "#endif");
}

/* emit_reflect.c - what a graph knows of itself, where a node of it asks: parameters, attributes,
 * nodes, edges, and how to follow a change of a parameter. */
#include "emit.h"

bool emit_reflects(const graph *g)
{
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        if (n->kind == NODE_PROCEDURE && n->procedure->traits & TRAIT_REFLECTS) {
            return true;
        }
    }
    return false;
}

/* ---- lists of names -------------------------------------------------------------------------- */

static const char *attribute_names(emitter *e, const graph *g)
{
    text all = {.arena = e->arena};
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        const attribute *a = &g->attributes[i];
        text_format(&all, "%s\n%s\n", a->name, type_text(e->arena, &a->type));
    }
    return emit_string(e, all.at ? all.at : "");
}

static const char *what_runs(const node *n)
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

static const char *node_names_of(emitter *e, const graph *g)
{
    text all = {.arena = e->arena};
    for (uint32_t i = 0; i < g->node_count; i++) {
        if (emit_takes_part(e, g->nodes[i])) {
            text_format(&all, "%s\n%s\n", g->nodes[i]->name, what_runs(g->nodes[i]));
        }
    }
    return emit_string(e, all.at ? all.at : "");
}

static void add_end(text *to, const port *p)
{
    bool gate = p->node->kind == NODE_INPUT || p->node->kind == NODE_OUTPUT;
    text_add(to, p->node->name);
    if (!gate) {
        text_format(to, ".%s", p->name);
    }
}

static const char *edge_names(emitter *e, const graph *g)
{
    text all = {.arena = e->arena};
    for (uint32_t i = 0; i < g->edge_count; i++) {
        const edge *k = g->edges[i];
        if (k->disabled || !emit_takes_part(e, k->from->node)) {
            continue;
        }
        add_end(&all, k->from);
        text_add(&all, " -> ");
        add_end(&all, k->to);
        text_format(&all, "\n%s\n", type_text(e->arena, &k->from->type));
    }
    return emit_string(e, all.at ? all.at : "");
}

/* ---- the table ------------------------------------------------------------------------------- */

void emit_about(emitter *e)
{
    const form *f = e->form;
    if (!f->about) {
        return;
    }
    emit_parameter_table(e, f->about);
    emit_line(e, "static int %s_change(pcg_frame *f)", f->about);
    emit_block(e);
    emit_line(e, "return %s((struct %s *)f);", f->change, f->tag);
    emit_close(e, "");
    emit_open(e, "static const pcg_graph_info %s =", f->about);
    emit_line(e, "%s, %s, %u,", emit_string(e, f->graph->name),
              f->graph->parameter_count ? emit_name(e, "%s_parameters", f->about) : "0",
              f->graph->parameter_count);
    emit_line(e, "%s,", attribute_names(e, f->graph));
    emit_line(e, "%s,", node_names_of(e, f->graph));
    emit_line(e, "%s,", edge_names(e, f->graph));
    emit_line(e, "%s_change", f->about);
    emit_close(e, ";\n");
}

/* emit_names.c - which graphs are emitted in which form, and what everything is called in C. */
#include "emit.h"

#include <string.h>

/* ---- names ----------------------------------------------------------------------------------- */

const char *emit_unique(arena *a, table *taken, const char *wish)
{
    const char *name = wish;
    for (uint32_t n = 2; table_get(taken, name); n++) {
        name = arena_format(a, "%s_%u", wish, n);
    }
    table_put(a, taken, name, (void *)(uintptr_t)name);
    return name;
}

static const char *field(emitter *e, table *taken, const char *prefix, const char *name)
{
    const char *identifier = interface_field(e->arena, name);
    return emit_unique(e->arena, taken, emit_name(e, "%s%s", prefix, identifier));
}

/* What the struct of a graph holds beside its nodes. */
static void reserve_fields(emitter *e, table *taken, uint32_t node_count)
{
    static const char *const own[] = {"frame", "own",      "impulse",   "parameter",
                                      "given", "constant", "attribute", "initial",
                                      "fed",   "leaf",     "gathered"};
    for (size_t i = 0; i < COUNT_OF(own); i++) {
        emit_unique(e->arena, taken, own[i]);
    }
    for (uint32_t i = 0; i <= node_count / EMIT_PART_NODES; i++) {
        emit_unique(e->arena, taken, emit_name(e, "part_%u", i));
    }
}

static const char **port_names(emitter *e, const port *ports, uint32_t count, const char *prefix)
{
    const char **names = ARENA_ARRAY(e->arena, const char *, count);
    table taken = {0};
    for (uint32_t i = 0; i < count; i++) {
        names[i] = field(e, &taken, prefix, ports[i].name);
    }
    return names;
}

/* What comes in through a gate that leads nowhere is no result. */
static bool is_leaf(const port *p)
{
    return p->node->kind != NODE_INPUT && !p->blocked && !p->gathered_by && !emit_has_open_edge(p);
}

static void count_ports(emit_graph *names, const node *n)
{
    for (uint32_t k = 0; k < n->output_count; k++) {
        const port *p = &n->outputs[k];
        names->leaf_count += is_leaf(p);
        if (p->gathered_by) {
            names->gathering = p->gathered_by;
            names->gathered_count++;
        }
    }
}

static void name_nodes(emitter *e, emit_graph *names)
{
    const graph *g = names->graph;
    table taken = {0};
    reserve_fields(e, &taken, g->node_count);
    names->nodes = ARENA_ARRAY(e->arena, node_names, g->node_count);
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        node_names *of = &names->nodes[i];
        of->field = field(e, &taken, "", n->name);
        if (g->node_count > EMIT_PART_NODES) {
            of->field = emit_name(e, "part_%u.%s", i / EMIT_PART_NODES, of->field);
        }
        of->inputs = port_names(e, n->inputs, n->input_count, "in_");
        of->outputs = port_names(e, n->outputs, n->output_count, "out_");
        of->leads = port_names(e, n->outputs, n->output_count, "to_");
        of->first_leaf = names->leaf_count;
        of->first_gathered = names->gathered_count;
        count_ports(names, n);
        of->first_port = e->port_count;
        e->port_count += n->output_count;
    }
    names->first_node = e->node_count;
    e->node_count += g->node_count + 1;
}

static void name_graph(emitter *e, emit_graph *names)
{
    const graph *g = names->graph;
    table parameters = {0}, constants = {0}, attributes = {0};
    names->parameters = ARENA_ARRAY(e->arena, const char *, g->parameter_count);
    names->constants = ARENA_ARRAY(e->arena, const char *, g->constant_count);
    names->attributes = ARENA_ARRAY(e->arena, const char *, g->attribute_count);
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        names->parameters[g->parameters[i].index] =
            field(e, &parameters, "", g->parameters[i].name);
    }
    for (uint32_t i = 0; i < g->constant_count; i++) {
        names->constants[g->constants[i].index] = field(e, &constants, "", g->constants[i].name);
    }
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        names->attributes[g->attributes[i].index] =
            field(e, &attributes, "", g->attributes[i].name);
    }
    name_nodes(e, names);
}

/* ---- forms ----------------------------------------------------------------------------------- */

/* The struct and the functions of a graph: graph_house, and main_house for the main graph as
 * such. */
static form *form_new(emitter *e, const graph *g, bool main)
{
    form *f = ARENA_NEW(e->arena, form);
    f->names = &e->graphs[g->index];
    f->graph = g;
    f->main = main;
    f->tag = emit_unique(e->arena, &e->globals,
                         emit_name(e, "%s_%s", main ? "main" : "graph", g->symbol));
    f->wire = emit_unique(e->arena, &e->globals, emit_name(e, "%s_wire", f->tag));
    f->start = emit_unique(e->arena, &e->globals, emit_name(e, "%s_start", f->tag));
    f->run = emit_unique(e->arena, &e->globals, emit_name(e, "%s_run", f->tag));
    if (emit_reflects(f->graph)) {
        f->about = emit_unique(e->arena, &e->globals, emit_name(e, "%s_about", f->tag));
        f->change = emit_unique(e->arena, &e->globals, emit_name(e, "%s_change", f->tag));
    }
    f->functions = ARENA_ARRAY(e->arena, const char *, g->node_count);
    for (uint32_t i = 0; i < g->node_count; i++) {
        const char *last = strrchr(f->names->nodes[i].field, '.');
        const char *name = last ? last + 1 : f->names->nodes[i].field;
        f->functions[i] = emit_unique(e->arena, &e->globals, emit_name(e, "%s_%s", f->tag, name));
    }
    return f;
}

/* The forms that are needed: what is found is looked at in turn. */
typedef struct search {
    bool *marked[2]; /* by graph->index: encapsulated, as a main graph */
    struct found {
        const graph *graph;
        bool main;
    } *list;
    uint32_t count;
} search;

static void find(search *s, const graph *g, bool main)
{
    if (s->marked[main][g->index]) {
        return;
    }
    s->marked[main][g->index] = true;
    s->list[s->count].graph = g;
    s->list[s->count++].main = main;
}

/* The graphs that a form's nodes encapsulate, or may choose. */
static void find_inner(search *s, const struct found *of)
{
    for (uint32_t i = 0; i < of->graph->node_count; i++) {
        const node *n = of->graph->nodes[i];
        uint32_t next = 0;
        if (n->stand_in && !of->main) {
            continue;
        }
        if (n->kind == NODE_GRAPH) {
            find(s, n->graph, false);
        }
        const graph *g = n->kind == NODE_SURROGATE ? emit_candidate(n, &next, NULL) : NULL;
        for (; g; g = emit_candidate(n, &next, NULL)) {
            find(s, g, true);
        }
    }
}

static search find_forms(emitter *e)
{
    const program *p = e->p;
    search s = {.marked = {ARENA_ARRAY(e->arena, bool, p->graph_count),
                           ARENA_ARRAY(e->arena, bool, p->graph_count)}};
    s.list = ARENA_ARRAY(e->arena, struct found, 2 * p->graph_count);
    find(&s, p->main, true);
    s.marked[true][p->main->index] = false; /* a candidate only where it is found again */
    find_inner(&s, &s.list[0]);
    for (uint32_t i = 1; i < s.count; i++) {
        find_inner(&s, &s.list[i]);
    }
    return s;
}

void emit_names(emitter *e)
{
    const program *p = e->p;
    const search s = find_forms(e);
    e->graphs = ARENA_ARRAY(e->arena, emit_graph, p->graph_count);
    e->encapsulated = ARENA_ARRAY(e->arena, form *, p->graph_count);
    e->candidates = ARENA_ARRAY(e->arena, form *, p->graph_count);
    for (uint32_t i = 0; i < p->graph_count; i++) {
        const graph *g = p->graphs[i];
        if (s.marked[false][i] || s.marked[true][i] || g == p->main) {
            e->graphs[i].graph = g;
            name_graph(e, &e->graphs[i]);
        }
        if (s.marked[false][i]) {
            e->encapsulated[i] = form_new(e, g, false);
            LIST_ADD(e->arena, &e->forms, e->encapsulated[i]);
        }
        if (s.marked[true][i] && g != p->main) {
            e->candidates[i] = form_new(e, g, true);
            LIST_ADD(e->arena, &e->forms, e->candidates[i]);
        }
    }
    e->main = form_new(e, p->main, true);
    LIST_ADD(e->arena, &e->forms, e->main);
    if (s.marked[true][p->main->index]) {
        e->candidates[p->main->index] = e->main;
    }
}

/* ---- references ------------------------------------------------------------------------------ */

const char *emit_node_reference(emitter *e, const node *n)
{
    const emit_graph *names = e->form->names;
    uint32_t number = names->first_node + (n ? n->index : names->graph->node_count);
    return emit_name(e, "&pcg_nodes[%u]", number);
}

const char *emit_node_path(emitter *e, const node *n)
{
    return emit_name(e, "g->%s", names_of(e, n)->field);
}

const char *emit_queue(emitter *e, const port *input)
{
    const node_names *names = names_of(e, input->node);
    return emit_name(e, "g->%s.%s", names->field, names->inputs[input->index]);
}

/* ---- what takes part ------------------------------------------------------------------------- */

bool emit_takes_part(const emitter *e, const node *n)
{
    return e->form->main || !n->stand_in;
}

bool emit_has_open_edge(const port *p)
{
    for (uint32_t i = 0; i < p->edge_count; i++) {
        if (!p->edges[i]->condition) {
            return true;
        }
    }
    return false;
}

bool emit_is_leaf(const emitter *e, const port *p)
{
    return e->form->main && is_leaf(p);
}

uint32_t emit_leaf_count(const emitter *e)
{
    return e->form->names->leaf_count;
}

uint32_t emit_leaf_number(const emitter *e, const port *p)
{
    uint32_t number = names_of(e, p->node)->first_leaf;
    for (uint32_t k = 0; k < p->index; k++) {
        number += is_leaf(&p->node->outputs[k]);
    }
    return number;
}

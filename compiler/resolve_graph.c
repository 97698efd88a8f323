/* resolve_graph.c - one graph: what its names mean, its gates, nodes, blocked ports and gathering
 * gates. */
#include "resolve.h"

#include <string.h>

static drawing drawing_of(resolver *r, graph *g)
{
    return (drawing){.r = r, .graph = g, .names = g->names};
}

/* ---- parameters, constants, attributes ----------------------------------------------------- */

/* A type of values: what a parameter or an attribute of a graph is of. */
static type value_type(resolver *r, const char *what, const tree_parameter *t)
{
    type found = t->type ? library_type(r->c, r->p, t->type) : type_error;
    if (type_is_error(&found) || (found.kind == TYPE_VALUE && !t->type->collective))
        return found;
    const char *written = type_text(r->arena, &found);
    if (t->type->collective)
        written = arena_format(r->arena, "%s[]", written);
    diagnose(r->d, DIAG_E0511, t->type->span, what, t->name.text, written);
    return type_error;
}

static void add_parameter(resolver *r, graph *g, const tree_parameter *t)
{
    const parameter *same = table_get(&g->names->parameters, t->name.text);
    if (same) {
        report_duplicate(r, "parameter", &t->name, "another parameter", same->tree->name.span);
        return;
    }
    parameter *p = &g->parameters[g->parameter_count];
    *p = (parameter){.name = t->name.text,
                     .tree = t,
                     .type = value_type(r, "parameter", t),
                     .hidden = t->hidden,
                     .index = g->parameter_count++};
    g->names->formals[p->index] = (formal){.name = p->name, .tree = t, .type = p->type};
    table_put(r->arena, &g->names->parameters, p->name, p);
}

static void add_attribute(resolver *r, graph *g, const tree_parameter *t)
{
    const attribute *same = table_get(&g->names->attributes, t->name.text);
    if (same) {
        report_duplicate(r, "attribute", &t->name, "another attribute", same->tree->name.span);
        return;
    }
    attribute *a = &g->attributes[g->attribute_count];
    *a = (attribute){.name = t->name.text,
                     .tree = t,
                     .type = value_type(r, "attribute", t),
                     .index = g->attribute_count++,
                     .cell = g->cells};
    g->cells += type_cells(&a->type);
    table_put(r->arena, &g->names->attributes, a->name, a);
}

/* ---- gates --------------------------------------------------------------------------------- */

static type gate_type(resolver *r, const tree_gate *t)
{
    type found = library_type(r->c, r->p, t->type);
    if (found.kind != TYPE_ENTITY && !type_is_error(&found)) {
        diagnose(r->d, DIAG_E0313, t->type->span, t->name.text, type_text(r->arena, &found));
        return type_error;
    }
    return found;
}

static port *gate_port(drawing *d, node *n, bool is_input, type t, bool collective)
{
    port *p = ARENA_NEW(d->r->arena, port);
    port_fill(p, n, n->name, is_input, 0);
    p->type = t;
    p->collective = collective;
    return p;
}

static const char *gate_word(const node *n)
{
    return n->kind == NODE_INPUT    ? "an input gate"
           : n->kind == NODE_OUTPUT ? "an output gate"
                                    : "a node";
}

/* Reports a name that a node or gate has already; `what` of it is declared now. */
static bool is_node_taken(drawing *d, const char *what, const tree_name *name)
{
    const node *same = table_get(&d->names->nodes, name->text);
    if (!same)
        return false;
    bool like = (what[0] == 'i' && same->kind == NODE_INPUT) ||
                (what[0] == 'o' && same->kind == NODE_OUTPUT) || (what[0] == 'n' && !same->gate);
    const char *other = like ? arena_format(d->r->arena, "another %s", what) : gate_word(same);
    report_duplicate(d->r, what, name, other,
                     same->gate ? same->gate->name.span : same->tree->name.span);
    return true;
}

static void check_optional_gates(drawing *d)
{
    const graph *g = d->graph;
    const tree_gate **inputs = ARENA_ARRAY(d->r->arena, const tree_gate *, g->input_count);
    for (uint32_t i = 0; i < g->input_count; i++)
        inputs[i] = g->inputs[i]->gate;
    check_optional(d, inputs, g->input_count);
}

static node *add_gate(drawing *d, const tree_gate *t, bool is_input)
{
    if (is_node_taken(d, is_input ? "input gate" : "output gate", &t->name))
        return NULL;
    node *n = node_new(d, is_input ? NODE_INPUT : NODE_OUTPUT, t->name.text, t->name.span);
    type carried = gate_type(d->r, t);
    n->named = true;
    n->gate = t;
    n->gathers = t->gathers;
    n->inputs = gate_port(d, n, true, carried, is_input && t->type->collective);
    n->input_count = 1;
    if (is_input) {
        n->outputs = gate_port(d, n, false, carried, false);
        n->output_count = 1;
        d->graph->inputs[d->graph->input_count++] = n;
    } else {
        d->graph->outputs[d->graph->output_count++] = n;
        if (t->type->collective)
            diagnose(d->r->d, DIAG_E0314, t->type->span, n->name);
    }
    table_put(d->r->arena, &d->names->nodes, n->name, n);
    return n;
}

/* ---- the interface of a graph -------------------------------------------------------------- */

static void count_members(const tree_graph *t, uint32_t counts[MEMBER_BLOCK + 1])
{
    memset(counts, 0, sizeof *counts * (MEMBER_BLOCK + 1));
    for (uint32_t i = 0; i < t->members.count; i++)
        counts[t->members.at[i]->kind]++;
}

void resolve_interface(resolver *r, graph *g)
{
    const tree_graph *t = g->tree;
    r->p->scope = g->unit;
    uint32_t counts[MEMBER_BLOCK + 1];
    drawing d = drawing_of(r, g);
    count_members(t, counts);
    g->parameters = ARENA_ARRAY(r->arena, parameter, counts[MEMBER_PARAMETER]);
    g->names->formals = ARENA_ARRAY(r->arena, formal, counts[MEMBER_PARAMETER]);
    g->attributes = ARENA_ARRAY(r->arena, attribute, counts[MEMBER_ATTRIBUTE]);
    g->inputs = ARENA_ARRAY(r->arena, node *, counts[MEMBER_INPUT]);
    g->outputs = ARENA_ARRAY(r->arena, node *, counts[MEMBER_OUTPUT]);
    for (uint32_t i = 0; i < t->members.count; i++) {
        const tree_member *m = t->members.at[i];
        if (m->kind == MEMBER_PARAMETER)
            add_parameter(r, g, m->parameter);
        else if (m->kind == MEMBER_ATTRIBUTE)
            add_attribute(r, g, m->parameter);
        else if (m->kind == MEMBER_INPUT || m->kind == MEMBER_OUTPUT)
            add_gate(&d, m->gate, m->kind == MEMBER_INPUT);
    }
    check_optional_gates(&d);
    resolve_constants(r, g, counts[MEMBER_CONSTANT]);
}

/* ---- nodes --------------------------------------------------------------------------------- */

static void make_nodes(drawing *d, const tree_chain *chain, node *gate)
{
    for (uint32_t i = 0; i < chain->elements.count; i++) {
        const tree_element *e = chain->elements.at[i];
        if (e->kind != ELEMENT_NODE)
            continue;
        node *n = node_of_element(d, e);
        n->stand_in = gate != NULL;
        n->stands_for = gate;
        LIST_ADD(d->r->arena, &d->names->elements, n);
        if (n->named && !is_node_taken(d, "node", &e->name))
            table_put(d->r->arena, &d->names->nodes, n->name, n);
    }
}

/* The node of a gate; NULL where another one has taken its name. */
static node *node_of_gate(const drawing *d, const tree_gate *t)
{
    node *n = table_get(&d->names->nodes, t->name.text);
    return n && n->gate == t ? n : NULL;
}

/* Calls `visit` for each chain of the graph in order of appearance, with the gate that it stands in
 * for. */
static void each_chain(drawing *d, void (*visit)(drawing *d, const tree_chain *chain, node *gate))
{
    const tree_graph *t = d->graph->tree;
    for (uint32_t i = 0; i < t->members.count; i++) {
        const tree_member *m = t->members.at[i];
        if (m->kind == MEMBER_CHAIN)
            visit(d, m->chain, NULL);
        else if (m->kind == MEMBER_INPUT && m->gate->stand_in && node_of_gate(d, m->gate))
            visit(d, m->gate->stand_in, node_of_gate(d, m->gate));
    }
}

/* Unnamed nodes are called for what they run: split, split_2. */
static void name_nodes(drawing *d)
{
    arena *a = d->r->arena;
    table counts = {0}, taken = {0};
    for (uint32_t i = 0; i < d->graph->node_count; i++) {
        node *n = d->graph->nodes[i];
        if (n->named)
            continue;
        const char *base = n->name;
        uintptr_t number = (uintptr_t)table_get(&counts, base);
        do {
            number++;
            n->name = number == 1 ? base : arena_format(a, "%s_%u", base, (unsigned)number);
        } while (table_get(&d->names->nodes, n->name) || table_get(&taken, n->name));
        table_put(a, &counts, base, (void *)number);
        table_put(a, &taken, n->name, n);
    }
}

/* FNV-1a over the text, then mixed so that near names give far keys. */
static uint64_t hash_text(const char *name, uint64_t ordinal)
{
    uint64_t h = 14695981039346656037u;
    for (; *name; name++)
        h = (h ^ (unsigned char)*name) * 1099511628211u;
    h = (h ^ ordinal) * 1099511628211u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

/* What an unnamed node is keyed by: its procedure with the library, or its graph. */
static const char *kind_name(arena *a, const node *n)
{
    if (n->procedure)
        return arena_format(a, "%s.%s", n->procedure->library->name, n->procedure->name);
    return n->graph ? arena_format(a, ".%s", n->graph->name) : n->name;
}

/* A named node is keyed by its name, ordinal 0; another by what it runs and which of its kind it
 * is. */
static void key_nodes(drawing *d)
{
    table counts = {0};
    for (uint32_t i = 0; i < d->graph->node_count; i++) {
        node *n = d->graph->nodes[i];
        const char *kind = n->named ? n->name : kind_name(d->r->arena, n);
        uintptr_t ordinal = 0;
        if (!n->named) {
            ordinal = (uintptr_t)table_get(&counts, kind) + 1;
            table_put(d->r->arena, &counts, kind, (void *)ordinal);
        }
        n->key = hash_text(kind, ordinal);
    }
}

/* Gates were made first; the order of nodes is that of the text. */
static void order_nodes(drawing *d)
{
    graph *g = d->graph;
    uint32_t made = 0;
    g->nodes = ARENA_ARRAY(d->r->arena, node *,
                           g->input_count + g->output_count + d->names->elements.count);
    for (uint32_t i = 0; i < g->tree->members.count; i++) {
        const tree_member *m = g->tree->members.at[i];
        bool is_gate = m->kind == MEMBER_INPUT || m->kind == MEMBER_OUTPUT;
        const tree_chain *chain = m->kind == MEMBER_CHAIN ? m->chain
                                  : is_gate               ? m->gate->stand_in
                                                          : NULL;
        node *gate = is_gate ? node_of_gate(d, m->gate) : NULL;
        if (gate)
            g->nodes[g->node_count++] = gate;
        for (uint32_t k = 0; chain && (gate || !is_gate) && k < chain->elements.count; k++)
            if (chain->elements.at[k]->kind == ELEMENT_NODE)
                g->nodes[g->node_count++] = d->names->elements.at[made++];
    }
    for (uint32_t i = 0; i < g->node_count; i++)
        g->nodes[i]->index = i;
}

/* ---- blocks and gathering gates ------------------------------------------------------------ */

static void resolve_block(drawing *d, const tree_block *t)
{
    node *n = resolve_reference(d, &t->node, &t->port);
    span place = t->port.text ? t->port.span : t->node.span;
    port *p = NULL;
    if (n)
        p = t->port.text ? port_named(d, n, t->port.text, false) : port_only(d, n, false, place);
    if (!n || (!p && !t->port.text))
        return;
    if (!p)
        report_no_port(d, n, &t->port, false);
    else if (p->block)
        diagnose(d->r->d, DIAG_E0312, t->head.span, node_title(n), p->name)->second =
            (diagnostic_label){p->block->head.span, "first here"};
    else {
        p->block = t;
        p->blocked = !t->condition;
    }
}

static void resolve_blocks(drawing *d)
{
    const tree_graph *t = d->graph->tree;
    for (uint32_t i = 0; i < t->members.count; i++)
        if (t->members.at[i]->kind == MEMBER_BLOCK)
            resolve_block(d, t->members.at[i]->block);
}

static node *gathering_gate(drawing *d)
{
    node *found = NULL;
    for (uint32_t i = 0; i < d->graph->output_count; i++) {
        node *n = d->graph->outputs[i];
        if (!n->gathers)
            continue;
        if (found)
            diagnose(d->r->d, DIAG_E0315, n->span, found->name, n->name)->second =
                (diagnostic_label){found->span, "the other one"};
        else
            found = n;
    }
    return found;
}

/* Whether an edge leaves it that is open whatever the parameters. */
static bool always_leads_on(const port *p)
{
    for (uint32_t i = 0; i < p->edge_count; i++)
        if (!p->edges[i]->chain->condition)
            return true;
    return false;
}

static void gather(drawing *d)
{
    node *gate = gathering_gate(d);
    for (uint32_t i = 0; gate && i < d->graph->node_count; i++) {
        node *n = d->graph->nodes[i];
        if (n->gate || n->stand_in)
            continue;
        for (uint32_t k = 0; k < n->output_count; k++)
            if (!n->outputs[k].blocked && !always_leads_on(&n->outputs[k]))
                n->outputs[k].gathered_by = gate;
    }
}

void resolve_body(resolver *r, graph *g)
{
    drawing d = drawing_of(r, g);
    r->p->scope = g->unit;
    each_chain(&d, make_nodes);
    order_nodes(&d);
    name_nodes(&d);
    key_nodes(&d);
    each_chain(&d, resolve_chain);
    resolve_blocks(&d);
    connect_edges(&d);
    gather(&d);
}

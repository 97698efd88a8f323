/* resolve_chain.c - chains: which node and which ports each element means, and the edges between
 * them. */
#include "resolve.h"

#include <string.h>

enum { INDEXED = 16 }; /* a node with more ports than this finds them by a table */

/* ---- ports by name ------------------------------------------------------------------------- */

static void index_ports(arena *a, table *t, port *ports, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (!table_get(t, ports[i].name))
            table_put(a, t, ports[i].name, &ports[i]);
}

static port *find_port(drawing *d, node *n, const char *name, bool is_input)
{
    port *ports = is_input ? n->inputs : n->outputs;
    uint32_t count = is_input ? n->input_count : n->output_count;
    if (count > INDEXED) {
        if (!n->ports_by_name) {
            n->ports_by_name = ARENA_ARRAY(d->r->arena, table, 2);
            index_ports(d->r->arena, &n->ports_by_name[0], n->outputs, n->output_count);
            index_ports(d->r->arena, &n->ports_by_name[1], n->inputs, n->input_count);
        }
        return table_get(&n->ports_by_name[is_input], name);
    }
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(ports[i].name, name))
            return &ports[i];
    return NULL;
}

/* Of a node that goes with everything: any port that is asked for. */
static port *any_port(drawing *d, node *n, const char *name, bool is_input)
{
    port *p = ARENA_NEW(d->r->arena, port);
    port_fill(p, n, name, is_input, 0);
    return p;
}

static bool goes_with_everything(const node *n)
{
    return n->kind == NODE_ERROR || n->broken;
}

static bool is_source(const node *n)
{
    return n->input_count == 0 || n->inputs[0].implicit;
}

/* A source's implicit input, made when the first edge leads to it. */
static port *impulse_port(drawing *d, node *n)
{
    if (!n->input_count) {
        n->inputs = ARENA_NEW(d->r->arena, port);
        n->input_count = 1;
        port_fill(n->inputs, n, "impulse", true, 0);
        n->inputs->implicit = true;
        n->inputs->type = type_of_entity(find_entity_type(d->r->c, d->r->p, "Entity"));
    }
    return n->inputs;
}

/* Input gates are led to by their stand-in alone, and output gates lead nowhere. */
static bool is_closed(const node *n, bool is_input)
{
    return n->kind == NODE_INPUT && is_input;
}

port *port_named(drawing *d, node *n, const char *name, bool is_input)
{
    if (is_closed(n, is_input))
        return NULL;
    port *p = find_port(d, n, name, is_input);
    if (!p && is_input && !n->gate && is_source(n) && !strcmp(name, "impulse"))
        p = impulse_port(d, n);
    return !p && goes_with_everything(n) ? any_port(d, n, name, is_input) : p;
}

static const char *list_ports(drawing *d, const node *n, bool is_input)
{
    const port *ports = is_input ? n->inputs : n->outputs;
    uint32_t count = is_input ? n->input_count : n->output_count;
    text list = {.arena = d->r->arena};
    text_add(&list, "");
    for (uint32_t i = 0; i < count && i < INDEXED; i++)
        text_format(&list, "%s%s", i ? ", " : "", ports[i].name);
    if (count > INDEXED)
        text_add(&list, ", …");
    return list.at;
}

port *port_only(drawing *d, node *n, bool is_input, span place)
{
    port *ports = is_input ? n->inputs : n->outputs;
    uint32_t count = is_input ? n->input_count : n->output_count;
    const char *direction = is_input ? "input" : "output";
    if (goes_with_everything(n))
        return count == 1 ? ports : any_port(d, n, direction, is_input);
    if (is_closed(n, is_input)) {
        diagnose(d->r->d, DIAG_E0305, place, n->name);
        return NULL;
    }
    if (is_input && !n->gate && is_source(n))
        return impulse_port(d, n);
    if (count == 1)
        return ports;
    if (count)
        diagnose(d->r->d, DIAG_E0303, place, node_title(n), direction, list_ports(d, n, is_input))
            ->help = n->named ? arena_format(d->r->arena, "name the one that is meant: %s.%s",
                                             n->name, ports[0].name)
                              : "give the node a name, and say which one is meant: name.port";
    else
        diagnose(d->r->d, DIAG_E0304, place, node_title(n), direction);
    return NULL;
}

static void add_port_names(arena *a, names *to, const port *ports, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        LIST_ADD(a, to, ports[i].name);
}

static void report_direction(drawing *d, const node *n, const tree_name *name, bool is_input)
{
    const char *what = arena_format(d->r->arena, "%s.%s", node_title(n), name->text);
    diagnose(d->r->d, DIAG_E0319, name->span, what, is_input ? "an output" : "an input",
             is_input ? "an input" : "an output");
}

void report_no_port(drawing *d, node *n, const tree_name *name, bool is_input)
{
    names candidates = {0};
    if (find_port(d, n, name->text, !is_input)) {
        report_direction(d, n, name, is_input);
        return;
    }
    diagnostic *found = diagnose(d->r->d, DIAG_E0302, name->span, node_title(n), name->text);
    if (!suggestions_wanted(d->r->c))
        return;
    add_port_names(d->r->arena, &candidates, n->inputs, n->input_count);
    add_port_names(d->r->arena, &candidates, n->outputs, n->output_count);
    found->text = did_you_mean(d->r->c, name->text, &candidates);
    const char *list = list_ports(d, n, is_input);
    if (*list)
        found->help =
            arena_format(d->r->arena, "its %s ports: %s", is_input ? "input" : "output", list);
}

/* ---- references ---------------------------------------------------------------------------- */

static const char *suggest_node(drawing *d, const char *name)
{
    names candidates = {0};
    const table *nodes = &d->names->nodes;
    if (!suggestions_wanted(d->r->c))
        return NULL;
    for (uint32_t i = 0; i < nodes->entries.count; i++)
        LIST_ADD(d->r->arena, &candidates, nodes->entries.at[i].key);
    for (uint32_t i = 0; i < d->graph->unit->names.entries.count; i++)
        LIST_ADD(d->r->arena, &candidates, d->graph->unit->names.entries.at[i].key);
    library_add_names(d->r->p, d->r->arena, NULL, ENTRY_PROCEDURE, &candidates);
    return did_you_mean(d->r->c, name, &candidates);
}

/* A name that is no node, but could run as one: what it is. */
static const char *what_runs(drawing *d, const char *library, const char *name)
{
    const pcg_library *found[2];
    if (!library && table_get(&d->graph->unit->names, name))
        return "a graph";
    return library_count(d->r->p, library, name, ENTRY_PROCEDURE, found) ? "a procedure" : NULL;
}

static void report_unknown(drawing *d, const tree_name *name, const tree_name *port_name)
{
    const char *what = what_runs(d, NULL, name->text);
    const pcg_library *l = library_named(d->r->p, name->text);
    if (what) {
        diagnose(d->r->d, DIAG_E0116, name->span, name->text, what)->text =
            arena_format(d->r->arena, "write %s()", name->text);
    } else if (l && port_name->text && what_runs(d, l->name, port_name->text)) {
        diagnose(d->r->d, DIAG_E0116, port_name->span, port_name->text, "a procedure")->text =
            arena_format(d->r->arena, "write %s.%s()", name->text, port_name->text);
    } else if (!d->graph->unit->broken) {
        diagnose(d->r->d, DIAG_E0101, name->span, name->text)->text = suggest_node(d, name->text);
    }
}

/* What is unknown is reported where it is named first. */
node *resolve_reference(drawing *d, const tree_name *name, const tree_name *port_name)
{
    node *n = table_get(&d->names->nodes, name->text);
    if (n)
        return n;
    report_unknown(d, name, port_name);
    n = node_of_error(d, name->text, name->span);
    table_put(d->r->arena, &d->names->nodes, name->text, n);
    return n;
}

/* ---- edges --------------------------------------------------------------------------------- */

/* An element of a chain: its node, and the ports that the arrows around it mean (NULL: none, or
 * reported). */
typedef struct stop {
    node *node;
    port *in, *out;
    span place;
} stop;

static void find_ports(drawing *d, const tree_element *e, stop *s, bool needs_in, bool needs_out)
{
    const tree_name *name = &e->port;
    if (!name->text) {
        s->in = needs_in ? port_only(d, s->node, true, s->place) : NULL;
        s->out = needs_out ? port_only(d, s->node, false, s->place) : NULL;
        return;
    }
    port *in = port_named(d, s->node, name->text, true);
    port *out = port_named(d, s->node, name->text, false);
    bool found = needs_in == needs_out ? in || out : needs_in ? in != NULL : out != NULL;
    if (!found) {
        report_no_port(d, s->node, name, needs_in && !needs_out);
    } else if (needs_in && needs_out) {
        s->in = in ? in : port_only(d, s->node, true, s->place);
        s->out = out ? out : port_only(d, s->node, false, s->place);
    } else {
        s->in = needs_in ? in : NULL;
        s->out = needs_out ? out : NULL;
    }
}

/* A node of a chain that stands in for a gate must be of that stand-in, since a supergraph never
 * runs it; and what runs always must not hang on it. */
static bool is_within(drawing *d, const stop *s, const node *gate)
{
    if (s->node->kind == NODE_ERROR || s->node->stands_for == gate)
        return true;
    if (gate)
        diagnose(d->r->d, DIAG_E0306, s->place, node_title(s->node), gate->name);
    else
        diagnose(d->r->d, DIAG_E0307, s->place, node_title(s->node), s->node->stands_for->name);
    return false;
}

static stop stop_at(drawing *d, const tree_chain *chain, uint32_t i, node *gate)
{
    const tree_element *e = chain->elements.at[i];
    bool last = i + 1 == chain->elements.count;
    stop s = {.place = e->span};
    if (e->kind == ELEMENT_NODE) {
        s.node = d->names->elements.at[d->next_element++];
        s.place = s.node->span;
    } else {
        s.node = resolve_reference(d, &e->name, &e->port);
        if (!is_within(d, &s, gate))
            return s;
    }
    find_ports(d, e, &s, i > 0, !last || gate);
    return s;
}

static void add_edge(drawing *d, const tree_chain *chain, const tree_arrow *arrow, const stop *from,
                     const stop *to)
{
    if (!from->out || !to->in)
        return;
    edge *e = ARENA_NEW(d->r->arena, edge);
    *e = (edge){.from = from->out,
                .to = to->in,
                .disabled = arrow && arrow->disabled,
                .span = arrow ? arrow->span : chain->span,
                .from_span = from->place,
                .to_span = to->place,
                .chain = chain};
    LIST_ADD(d->r->arena, &d->names->edges_made, e);
}

void resolve_chain(drawing *d, const tree_chain *chain, node *gate)
{
    if (!chain->elements.count)
        return;
    stop from = stop_at(d, chain, 0, gate);
    if (chain->elements.count == 1 && chain->elements.at[0]->kind == ELEMENT_REFERENCE && !gate &&
        from.node->kind != NODE_ERROR)
        diagnose(d->r->d, DIAG_W0507, chain->span, from.node->name);
    if (chain->elements.count == 1 && chain->condition && !gate)
        diagnose(d->r->d, DIAG_W0508, chain->condition->span);
    for (uint32_t i = 1; i < chain->elements.count; i++) {
        stop to = stop_at(d, chain, i, gate);
        add_edge(d, chain, &chain->arrows.at[i - 1], &from, &to);
        from = to;
    }
    if (gate) {
        stop end = {.node = gate, .in = gate->inputs, .place = gate->span};
        add_edge(d, chain, NULL, &from, &end);
    }
}

static void count_edge(edge *e)
{
    e->from->edge_count++;
    e->to->edge_count++;
}

static void append_edge(arena *a, port *p, edge *e)
{
    if (!p->edges) {
        p->edges = ARENA_ARRAY(a, edge *, p->edge_count);
        p->edge_count = 0;
    }
    p->edges[p->edge_count++] = e;
}

void connect_edges(drawing *d)
{
    graph *g = d->graph;
    g->edges = d->names->edges_made.at;
    g->edge_count = d->names->edges_made.count;
    for (uint32_t i = 0; i < g->edge_count; i++)
        if (!g->edges[i]->disabled)
            count_edge(g->edges[i]);
    for (uint32_t i = 0; i < g->edge_count; i++) {
        if (g->edges[i]->disabled)
            continue;
        append_edge(d->r->arena, g->edges[i]->from, g->edges[i]);
        append_edge(d->r->arena, g->edges[i]->to, g->edges[i]);
    }
}

/* resolve_node.c - one node: what it runs, its ports, its augmentations, room for its arguments and
 * links. */
#include "resolve.h"

#include <string.h>

node *node_new(drawing *d, node_kind kind, const char *name, span place)
{
    node *n = ARENA_NEW(d->r->arena, node);
    n->kind = kind;
    n->owner = d->graph;
    n->name = name;
    n->span = place;
    return n;
}

const char *node_title(const node *n)
{
    if (n->named || !n->tree)
        return n->name;
    return n->procedure ? n->procedure->name : n->tree->procedure.text;
}

node *node_of_error(drawing *d, const char *name, span place)
{
    return node_new(d, NODE_ERROR, name, place);
}

void port_fill(port *p, node *n, const char *name, bool is_input, uint32_t index)
{
    *p = (port){.node = n, .name = name, .is_input = is_input, .index = index};
}

/* ---- what it runs -------------------------------------------------------------------------- */

static const char *suggest_procedure(drawing *d, const char *library, const char *name)
{
    resolver *r = d->r;
    const table *graphs = &d->graph->unit->names;
    names candidates = {0};
    if (!suggestions_wanted(r->c))
        return NULL;
    for (uint32_t i = 0; !library && i < graphs->entries.count; i++)
        LIST_ADD(r->arena, &candidates, graphs->entries.at[i].key);
    library_add_names(r->p, r->arena, library, ENTRY_PROCEDURE, &candidates);
    return did_you_mean(r->c, name, &candidates);
}

/* The library that a name means in this file; NULL: it was reported. */
static const char *find_library(drawing *d, const tree_name *name)
{
    const pcg_library *l = table_get(&d->graph->unit->libraries, name->text);
    if (!l)
        l = library_named(d->r->p, name->text);
    if (!l)
        library_report_unknown(d->r->c, d->r->p, name);
    return l ? l->name : NULL;
}

static const procedure *unknown_procedure(drawing *d, const char *library, const tree_name *name)
{
    diagnostic *found =
        library ? diagnose(d->r->d, DIAG_E0119, name->span, library, "procedure", name->text)
                : diagnose(d->r->d, DIAG_E0102, name->span, name->text);
    found->text = suggest_procedure(d, library, name->text);
    return NULL;
}

static const procedure *procedure_of(drawing *d, const tree_element *e)
{
    resolver *r = d->r;
    const tree_name *name = &e->procedure;
    const pcg_library *found[2] = {NULL, NULL};
    const char *library = e->library.text ? find_library(d, &e->library) : NULL;
    if (e->library.text && !library)
        return NULL;
    uint32_t count = library_count(r->p, library, name->text, ENTRY_PROCEDURE, found);
    if (!count)
        return unknown_procedure(d, library, name);
    if (count > 1 && strcmp(found[0]->name, found[1]->name) != 0)
        diagnose(r->d, DIAG_E0109, name->span, name->text, found[0]->name, found[1]->name)->help =
            arena_format(r->arena, "write %s.%s()", found[0]->name, name->text);
    const procedure *f = find_procedure(r->c, r->p, library, name->text);
    if (f && strcmp(f->name, name->text) != 0)
        diagnose(r->d, DIAG_W0505, name->span, name->text, f->name);
    return f;
}

/* ---- ports --------------------------------------------------------------------------------- */

static void port_of_formal(port *p, node *n, const formal_port *f, bool is_input, uint32_t index)
{
    port_fill(p, n, f->name, is_input, index);
    p->type = f->type;
    p->collective = f->collective;
    p->optional = f->optional;
    p->formal = f;
}

static void check_port_name(drawing *d, const node *n, table *taken, const port *p, span place)
{
    if (table_get(taken, p->name))
        diagnose(d->r->d, DIAG_E0310, place, node_title(n),
                 p->is_input ? "input ports" : "output ports", p->name);
    table_put(d->r->arena, taken, p->name, (void *)(uintptr_t)p);
}

/* The declared ports, then those of augmentations in their order. */
static void make_procedure_ports(drawing *d, node *n)
{
    const procedure *f = n->procedure;
    table taken_in = {0}, taken_out = {0};
    n->inputs = ARENA_ARRAY(d->r->arena, port, f->input_count + n->item_count);
    n->outputs = ARENA_ARRAY(d->r->arena, port, f->output_count + n->item_count);
    for (; n->input_count < f->input_count; n->input_count++) {
        port *p = &n->inputs[n->input_count];
        port_of_formal(p, n, &f->inputs[p - n->inputs], true, n->input_count);
        check_port_name(d, n, &taken_in, p, n->span);
    }
    for (; n->output_count < f->output_count; n->output_count++) {
        port *p = &n->outputs[n->output_count];
        port_of_formal(p, n, &f->outputs[p - n->outputs], false, n->output_count);
        check_port_name(d, n, &taken_out, p, n->span);
    }
    for (uint32_t i = 0; i < n->item_count; i++) {
        argument_item *item = &n->items[i];
        if (item->augment->has_input) {
            item->input = &n->inputs[n->input_count];
            port_of_formal(item->input, n, &item->augment->input, true, n->input_count++);
            item->input->name = item->name;
            item->input->item = item;
            check_port_name(d, n, &taken_in, item->input, item->tree->head.span);
        }
        if (item->augment->has_output) {
            item->output = &n->outputs[n->output_count];
            port_of_formal(item->output, n, &item->augment->output, false, n->output_count++);
            item->output->name = item->name;
            item->output->item = item;
            check_port_name(d, n, &taken_out, item->output, item->tree->head.span);
        }
    }
}

static void make_graph_ports(drawing *d, node *n)
{
    const graph *g = n->graph;
    n->input_count = g->input_count;
    n->output_count = g->output_count;
    n->inputs = ARENA_ARRAY(d->r->arena, port, g->input_count);
    n->outputs = ARENA_ARRAY(d->r->arena, port, g->output_count);
    for (uint32_t i = 0; i < g->input_count; i++) {
        port_fill(&n->inputs[i], n, g->inputs[i]->name, true, i);
        n->inputs[i].type = g->inputs[i]->inputs[0].type;
        n->inputs[i].collective = g->inputs[i]->inputs[0].collective;
        n->inputs[i].optional = g->inputs[i]->gate->type->optional;
    }
    for (uint32_t i = 0; i < g->output_count; i++) {
        port_fill(&n->outputs[i], n, g->outputs[i]->name, false, i);
        n->outputs[i].type = g->outputs[i]->inputs[0].type;
    }
}

void check_optional(drawing *d, const tree_gate *const *inputs, uint32_t count)
{
    const char *single = NULL;
    for (uint32_t i = 0; i < count && !single; i++)
        single = inputs[i]->type->collective ? NULL : inputs[i]->name.text;
    for (uint32_t i = 0; i < count; i++)
        if (inputs[i]->type->optional && (i == 0 || single))
            diagnose(d->r->d, DIAG_E0320, inputs[i]->type->span, inputs[i]->name.text,
                     i == 0 ? "it is the first input, for which its node runs"
                            : arena_format(d->r->arena, "'%s' is single, so its node runs for each "
                                           "entity there", single));
}

static port *make_declared_ports(drawing *d, node *n, const tree_gates *gates, bool is_input)
{
    port *ports = ARENA_ARRAY(d->r->arena, port, gates->count);
    table taken = {0};
    for (uint32_t i = 0; i < gates->count; i++) {
        const tree_gate *t = gates->at[i];
        port_fill(&ports[i], n, t->name.text, is_input, i);
        ports[i].type = library_type(d->r->c, d->r->p, t->type);
        ports[i].collective = is_input && t->type->collective;
        ports[i].optional = is_input && t->type->optional;
        if (ports[i].type.kind != TYPE_ENTITY && !type_is_error(&ports[i].type)) {
            diagnose(d->r->d, DIAG_E0313, t->type->span, t->name.text,
                     type_text(d->r->arena, &ports[i].type));
            ports[i].type = type_error;
        }
        check_port_name(d, n, &taken, &ports[i], t->name.span);
    }
    return ports;
}

/* ---- arguments and links ------------------------------------------------------------------- */

static argument *make_arguments(arena *a, formal *formals, uint32_t count)
{
    argument *arguments = ARENA_ARRAY(a, argument, count);
    for (uint32_t i = 0; i < count; i++)
        arguments[i].formal = &formals[i];
    return arguments;
}

static attribute_link *make_links(arena *a, const formal *attributes, uint32_t count)
{
    attribute_link *links = ARENA_ARRAY(a, attribute_link, count);
    for (uint32_t i = 0; i < count; i++)
        links[i] = (attribute_link){.name = attributes[i].name, .type = attributes[i].type};
    return links;
}

/* ---- augmentations ------------------------------------------------------------------------- */

static const augment *augment_named(const procedure *f, const char *name)
{
    for (uint32_t i = 0; i < f->augment_count; i++)
        if (!strcmp(f->augments[i].name, name))
            return &f->augments[i];
    return NULL;
}

static void unknown_augment(drawing *d, const node *n, const tree_name *kind)
{
    const procedure *f = n->procedure;
    text list = {.arena = d->r->arena};
    names candidates = {0};
    if (!f->augment_count) {
        diagnose(d->r->d, DIAG_E0308, kind->span, f->name);
        return;
    }
    for (uint32_t i = 0; i < f->augment_count; i++) {
        LIST_ADD(d->r->arena, &candidates, f->augments[i].name);
        text_format(&list, "%s%s", i ? ", " : "it has ", f->augments[i].name);
    }
    diagnostic *found = diagnose(d->r->d, DIAG_E0309, kind->span, f->name, kind->text);
    found->text = did_you_mean(d->r->c, kind->text, &candidates);
    found->help = list.at;
}

/* An unnamed item is called for its kind, the second one absolute_2. */
static const char *item_name(drawing *d, const tree_augmentation *t, uint32_t *unnamed)
{
    if (t->name.text)
        return t->name.text;
    uint32_t number = ++*unnamed;
    return number == 1 ? t->kind.text
                       : arena_format(d->r->arena, "%s_%u", t->kind.text, (unsigned)number);
}

static void make_items(drawing *d, node *n, const tree_augmentations *trees)
{
    arena *a = d->r->arena;
    const procedure *f = n->procedure;
    uint32_t *unnamed = ARENA_ARRAY(a, uint32_t, f->augment_count);
    table taken = {0};
    n->items = ARENA_ARRAY(a, argument_item, trees->count);
    for (uint32_t i = 0; i < trees->count; i++) {
        const tree_augmentation *t = trees->at[i];
        const augment *kind = augment_named(f, t->kind.text);
        if (!kind) {
            unknown_augment(d, n, &t->kind);
            n->broken = true;
            continue;
        }
        argument_item *item = &n->items[n->item_count];
        *item =
            (argument_item){.name = item_name(d, t, &unnamed[kind->kind]),
                            .augment = kind,
                            .tree = t,
                            .arguments = make_arguments(a, kind->parameters, kind->parameter_count),
                            .links = make_links(a, kind->attributes, kind->attribute_count),
                            .index = n->item_count++};
        bool has_port = kind->has_input || kind->has_output;
        if (!has_port && table_get(&taken, item->name))
            diagnose(d->r->d, DIAG_E0310, t->head.span, node_title(n), "augmentations", item->name);
        table_put(a, &taken, item->name, item);
    }
}

/* ---- nodes by kind ------------------------------------------------------------------------- */

/* Braces that declare an interface belong to surrogates. */
static void refuse_interface(drawing *d, const node *n, const tree_body *b)
{
    struct {
        const char *what;
        const tree_head *head;
    } found[] = {
        {"an input", b->inputs.count ? &b->inputs.at[0]->head : NULL},
        {"an output", b->outputs.count ? &b->outputs.at[0]->head : NULL},
        {"a parameter", b->parameters.count ? &b->parameters.at[0]->head : NULL},
        {"an attribute", b->attributes.count ? &b->attributes.at[0]->head : NULL},
        {"a loop", b->loops.count ? &b->loops.at[0]->head : NULL},
    };
    for (size_t i = 0; i < COUNT_OF(found); i++)
        if (found[i].head)
            diagnose(d->r->d, DIAG_E0311, found[i].head->span, found[i].what,
                     n->tree->procedure.text);
}

static void fill_procedure(drawing *d, node *n)
{
    const procedure *f = n->procedure;
    arena *a = d->r->arena;
    n->kind = NODE_PROCEDURE;
    if (n->tree->body) {
        refuse_interface(d, n, n->tree->body);
        make_items(d, n, &n->tree->body->augmentations);
    }
    make_procedure_ports(d, n);
    n->arguments = make_arguments(a, f->parameters, f->parameter_count);
    n->argument_count = f->parameter_count;
    n->links = make_links(a, f->attributes, f->attribute_count);
    n->link_count = f->attribute_count;
    n->variables = ARENA_ARRAY(a, type, f->variable_count);
}

static void fill_graph(drawing *d, node *n)
{
    const graph *g = n->graph;
    arena *a = d->r->arena;
    const tree_body *b = n->tree->body;
    n->kind = NODE_GRAPH;
    n->broken = g->unit->broken;
    if (b)
        refuse_interface(d, n, b);
    if (b && b->augmentations.count)
        diagnose(d->r->d, DIAG_E0308, b->augmentations.at[0]->head.span, g->name);
    make_graph_ports(d, n);
    n->arguments = make_arguments(a, g->names->formals, g->parameter_count);
    n->argument_count = g->parameter_count;
    n->links = ARENA_ARRAY(a, attribute_link, g->attribute_count);
    n->link_count = g->attribute_count;
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        attribute *inner = &g->attributes[i];
        n->links[i] = (attribute_link){.name = inner->name, .type = inner->type, .inner = inner};
    }
}

/* Parameters: the procedure's own, then those that the braces declare. */
static formal *surrogate_formals(drawing *d, const node *n, const tree_parameters *declared)
{
    const procedure *f = n->procedure;
    formal *formals = ARENA_ARRAY(d->r->arena, formal, f->parameter_count + declared->count);
    for (uint32_t i = 0; i < f->parameter_count; i++)
        formals[i] = f->parameters[i];
    for (uint32_t i = 0; i < declared->count; i++) {
        const tree_parameter *t = declared->at[i];
        formals[f->parameter_count + i] = (formal){
            .name = t->name.text, .tree = t, .type = library_type(d->r->c, d->r->p, t->type)};
    }
    return formals;
}

static void fill_surrogate(drawing *d, node *n)
{
    static const tree_body none;
    arena *a = d->r->arena;
    const tree_body *b = n->tree->body ? n->tree->body : &none;
    n->kind = NODE_SURROGATE;
    if (b->augmentations.count)
        diagnose(d->r->d, DIAG_E0308, b->augmentations.at[0]->head.span, n->procedure->name);
    n->inputs = make_declared_ports(d, n, &b->inputs, true);
    check_optional(d, (const tree_gate *const *)b->inputs.at, b->inputs.count);
    n->input_count = b->inputs.count;
    n->outputs = make_declared_ports(d, n, &b->outputs, false);
    n->output_count = b->outputs.count;
    n->argument_count = n->procedure->parameter_count + b->parameters.count;
    n->arguments = make_arguments(a, surrogate_formals(d, n, &b->parameters), n->argument_count);
    n->links = ARENA_ARRAY(a, attribute_link, b->attributes.count);
    for (uint32_t i = 0; i < b->attributes.count; i++) {
        const tree_parameter *t = b->attributes.at[i];
        n->links[n->link_count++] =
            (attribute_link){.name = t->name.text, .type = library_type(d->r->c, d->r->p, t->type)};
    }
    resolve_surrogate(d, n);
}

node *node_of_element(drawing *d, const tree_element *e)
{
    span place = {e->procedure.span.source, e->span.from, e->procedure.span.to};
    node *n = node_new(d, NODE_ERROR, e->name.text ? e->name.text : e->procedure.text, place);
    n->named = e->name.text != NULL;
    n->tree = e;
    if (!e->library.text)
        n->graph = table_get(&d->graph->unit->names, e->procedure.text);
    if (n->graph && n->graph->tree)
        fill_graph(d, n);
    if (n->graph)
        return n;
    n->procedure = procedure_of(d, e);
    if (!n->named && n->procedure)
        n->name = n->procedure->name;
    if (n->procedure && library_is_surrogate(n->procedure))
        fill_surrogate(d, n);
    else if (n->procedure)
        fill_procedure(d, n);
    return n;
}

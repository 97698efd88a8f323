/* check_surrogate.c - a surrogate's declared interface: its loops, and the graph or procedure that
 * it names where the name is constant. A plain one becomes a node of that graph. */
#include "check.h"

#include <string.h>

/* What the surrogate runs: one of the two. */
typedef struct target {
    const graph *graph;
    const procedure *procedure;
    const char *text; /* "graph 'window'" */
} target;

/* ---- loops --------------------------------------------------------------------------------- */

static const port *declared_port(checker *k, const node *n, const tree_name *name, bool is_input)
{
    const port *ports = is_input ? n->inputs : n->outputs;
    uint32_t count = is_input ? n->input_count : n->output_count;
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(ports[i].name, name->text))
            return &ports[i];
    diagnose(k->d, DIAG_E0318, name->span, is_input ? "input" : "output", name->text);
    return NULL;
}

static void check_loop(checker *k, const node *n, const tree_loop *t)
{
    const port *from = declared_port(k, n, &t->from, false);
    const port *to = declared_port(k, n, &t->to, true);
    if (!from || !to || type_is_error(&from->type) || type_is_error(&to->type) ||
        entity_derives(from->type.entity, to->type.entity))
        return;
    diagnose(k->d, DIAG_E0301, t->from.span, arena_format(k->arena, "'%s'", from->name),
             type_text(k->arena, &from->type), arena_format(k->arena, "'%s'", to->name),
             type_text(k->arena, &to->type))
        ->second = (diagnostic_label){t->to.span, NULL};
}

/* ---- the interface that it expects --------------------------------------------------------- */

static type bound_type(const procedure *f, const formal_port *p)
{
    return p->type.kind == TYPE_VARIABLE ? type_of_entity(f->bounds[p->type.variable]) : p->type;
}

static bool port_of_target(const target *t, const char *name, bool is_input, type *found)
{
    if (t->graph) {
        node *const *gates = is_input ? t->graph->inputs : t->graph->outputs;
        uint32_t count = is_input ? t->graph->input_count : t->graph->output_count;
        for (uint32_t i = 0; i < count; i++)
            if (!strcmp(gates[i]->name, name)) {
                *found = gates[i]->inputs[0].type;
                return true;
            }
        return false;
    }
    const formal_port *ports = is_input ? t->procedure->inputs : t->procedure->outputs;
    uint32_t count = is_input ? t->procedure->input_count : t->procedure->output_count;
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(ports[i].name, name)) {
            *found = bound_type(t->procedure, &ports[i]);
            return true;
        }
    return false;
}

static bool parameter_of_target(const target *t, const char *name, type *found)
{
    uint32_t count = t->graph ? t->graph->parameter_count : t->procedure->parameter_count;
    const formal *formals = t->graph ? t->graph->names->formals : t->procedure->parameters;
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(formals[i].name, name)) {
            *found = formals[i].type;
            return true;
        }
    return false;
}

static bool attribute_of_target(const target *t, const char *name, type *found)
{
    uint32_t count = t->graph ? t->graph->attribute_count : t->procedure->attribute_count;
    for (uint32_t i = 0; i < count; i++) {
        const char *other = t->graph ? t->graph->attributes[i].name : t->procedure->attributes[i].name;
        if (strcmp(other, name) != 0)
            continue;
        *found = t->graph ? t->graph->attributes[i].type : t->procedure->attributes[i].type;
        return true;
    }
    return false;
}

static bool port_fits(const type *declared, const type *found, bool is_input)
{
    if (type_is_error(declared) || type_is_error(found))
        return true;
    return is_input ? entity_derives(declared->entity, found->entity)
                    : entity_derives(found->entity, declared->entity);
}

static void report_misfit(checker *k, const char *what, const tree_name *name, const type *found,
                          const type *declared)
{
    diagnose(k->d, DIAG_E0316, name->span, what, name->text, type_text(k->arena, found),
             type_text(k->arena, declared));
}

static void compare_ports(checker *k, const node *n, const target *t, bool is_input)
{
    const tree_gates *gates = is_input ? &n->tree->body->inputs : &n->tree->body->outputs;
    const port *ports = is_input ? n->inputs : n->outputs;
    const char *what = is_input ? "input" : "output";
    for (uint32_t i = 0; i < gates->count; i++) {
        const tree_gate *declared = gates->at[i];
        type found;
        if (declared->gathers)
            continue;
        if (!port_of_target(t, declared->name.text, is_input, &found))
            diagnose(k->d, DIAG_E0317, declared->name.span, t->text, what, declared->name.text);
        else if (!port_fits(&ports[i].type, &found, is_input))
            report_misfit(k, what, &declared->name, &found, &ports[i].type);
    }
}

static void compare_parameters(checker *k, const node *n, const target *t)
{
    const tree_parameters *declared = &n->tree->body->parameters;
    for (uint32_t i = 0; i < declared->count; i++) {
        const tree_name *name = &declared->at[i]->name;
        const type *wanted = &n->arguments[n->procedure->parameter_count + i].formal->type;
        type found;
        if (!parameter_of_target(t, name->text, &found))
            diagnose(k->d, DIAG_E0317, name->span, t->text, "parameter", name->text);
        else if (!type_is_error(wanted) && !type_is_error(&found) && !type_equal(wanted, &found))
            report_misfit(k, "parameter", name, &found, wanted);
    }
}

static void compare_attributes(checker *k, const node *n, const target *t)
{
    const tree_parameters *declared = &n->tree->body->attributes;
    for (uint32_t i = 0; i < declared->count; i++) {
        const tree_name *name = &declared->at[i]->name;
        const type *wanted = &n->links[i].type;
        type found;
        if (!attribute_of_target(t, name->text, &found))
            diagnose(k->d, DIAG_E0317, name->span, t->text, "attribute", name->text);
        else if (!type_is_error(wanted) && !type_is_error(&found) && !type_equal(wanted, &found))
            report_misfit(k, "attribute", name, &found, wanted);
    }
}

/* ---- the graph that it names --------------------------------------------------------------- */

static attribute *attribute_of_graph(const graph *g, const char *name)
{
    for (uint32_t i = 0; i < g->attribute_count; i++)
        if (!strcmp(g->attributes[i].name, name))
            return &g->attributes[i];
    return NULL;
}

/* What is handed in is written, what is linked is read. */
static void mark_attributes(const node *n)
{
    for (uint32_t i = 0; i < n->link_count; i++) {
        const attribute_link *l = &n->links[i];
        attribute *inner = attribute_of_graph(n->target, l->name);
        if (!inner)
            continue;
        inner->read |= l->kind != LINK_NONE;
        inner->written |= l->in || l->kind == LINK_SHARE;
    }
}

/* It does nothing but run the graph once, port by port. */
static bool is_encapsulation(const node *n)
{
    for (uint32_t i = 0; n->tree->body && i < n->output_count; i++)
        if (n->tree->body->outputs.at[i]->gathers)
            return false;
    return !strcmp(n->procedure->name, "dynamic");
}

static const argument *declared_argument(const node *n, const char *name)
{
    for (uint32_t i = n->procedure->parameter_count; i < n->argument_count; i++)
        if (!strcmp(n->arguments[i].formal->name, name))
            return &n->arguments[i];
    return NULL;
}

/* The node becomes an ordinary one of that graph. What was declared is given, if only by its default
 * there. */
static void encapsulate(checker *k, node *n)
{
    const graph *g = n->target;
    argument *arguments = ARENA_ARRAY(k->arena, argument, g->parameter_count);
    attribute_link *links = ARENA_ARRAY(k->arena, attribute_link, g->attribute_count);
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        const argument *given = declared_argument(n, g->parameters[i].name);
        arguments[i].formal = &g->names->formals[i];
        arguments[i].value = given ? given->value : g->parameters[i].initial;
        arguments[i].given = given != NULL;
    }
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        links[i] = (attribute_link){.name = g->attributes[i].name, .type = g->attributes[i].type};
        for (uint32_t l = 0; l < n->link_count; l++)
            if (!strcmp(n->links[l].name, links[i].name))
                links[i] = n->links[l];
        links[i].inner = &g->attributes[i];
    }
    n->kind = NODE_GRAPH;
    n->graph = n->target;
    n->arguments = arguments;
    n->argument_count = g->parameter_count;
    n->links = links;
    n->link_count = g->attribute_count;
}

/* ---- what it names ------------------------------------------------------------------------- */

static bool is_file(const char *name)
{
    return strchr(name, '/') || strchr(name, '.');
}

/* False where the name means nothing in this file, or is that of a file, which is looked for when
 * it runs. */
static bool find_target(checker *k, const node *n, const value *name, target *t)
{
    const table *graphs = &n->owner->unit->names;
    graph *g = n->target && is_file(name->string) ? n->target : table_get(graphs, name->string);
    *t = (target){.graph = g, .text = arena_format(k->arena, "graph '%s'", name->string)};
    if (g)
        return g->tree != NULL;
    if (is_file(name->string) || !*name->string)
        return false;
    t->procedure = library_procedure(k->c, k->p, NULL, name->string);
    t->text = arena_format(k->arena, "procedure '%s'", name->string);
    if (t->procedure)
        return true;
    names candidates = {0};
    for (uint32_t i = 0; i < graphs->entries.count; i++)
        LIST_ADD(k->arena, &candidates, graphs->entries.at[i].key);
    library_add_names(k->p, k->arena, NULL, ENTRY_PROCEDURE, &candidates);
    diagnose(k->d, DIAG_E0102, name->span, name->string)->text =
        did_you_mean(k->c, name->string, &candidates);
    return false;
}

/* Names of files are looked up beside the file that the surrogate stands in. */
static void set_way(checker *k, node *n)
{
    const char *file = path_from_main(k, n->owner->unit->source, "x");
    n->way = arena_copy(k->arena, file, strlen(file) - 1);
}

void check_surrogate(checker *k, node *n)
{
    const tree_body *body = n->tree->body;
    value name;
    target t;
    set_way(k, n);
    for (uint32_t i = 0; body && i < body->loops.count; i++)
        check_loop(k, n, body->loops.at[i]);
    for (uint32_t i = 0; body && i < n->argument_count; i++) {
        const argument *a = &n->arguments[i];
        if (strcmp(a->formal->name, "graph") != 0 || !a->given || value_is_error(a->value) ||
            !value_evaluate(k->arena, a->value, &name) || !find_target(k, n, &name, &t))
            continue;
        compare_ports(k, n, &t, true);
        compare_ports(k, n, &t, false);
        compare_parameters(k, n, &t);
        compare_attributes(k, n, &t);
    }
    if (n->target)
        mark_attributes(n);
    if (!k->d->errors && n->target && is_encapsulation(n))
        encapsulate(k, n);
}

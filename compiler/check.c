/* check.c - types of everything: parameters, constants, attributes, ports, arguments, links,
 * conditions.
 *
 * Needs resolve's program; keeps its shape, and fills in types and typed expressions. All graphs of
 * all files are checked, also those that the main graph does not reach. Warnings about the flow
 * come only where there is no error, since an edge that is missing for another reason would bring
 * them out as well. */
#include "check.h"

/* ---- parameters, constants, attributes ----------------------------------------------------- */

static void check_parameter(checker *k, graph *g, parameter *p)
{
    scope s = {.k = k,
               .graph = g,
               .place = "the default of a parameter",
               .sees_parameters = true,
               .parameters = p->index};
    scope none = {.k = k, .graph = g, .place = "a constraint"};
    const char *taker = arena_format(k->arena, "'%s'", p->name);
    p->initial = p->tree->initial ? check_value_as(&s, p->tree->initial, &p->type, taker)
                                  : value_zero(&s, &p->type, p->tree->name.span);
    check_constraints(&none, p->tree, &p->type, &p->constraints, &p->constraint_count);
    if (p->tree->initial)
        check_constrained(k, p->initial, p->name, p->constraints, p->constraint_count);
    formal *f = &g->names->formals[p->index];
    f->checked = true;
    f->initial = p->tree->initial || p->hidden ? p->initial : NULL;
    f->constraints = p->constraints;
    f->constraint_count = p->constraint_count;
}

static void check_constant(checker *k, graph *g, constant *c)
{
    scope s = {.k = k,
               .graph = g,
               .place = "a constant",
               .sees_parameters = true,
               .parameters = g->parameter_count,
               .sees_constants = true,
               .constants = c->index};
    c->value = check_value(&s, c->tree->initial, NULL);
    if (!require_value(&s, c->value, "a value"))
        c->value = value_error(&s, c->value->span);
    c->type = c->value->type;
}

static scope graph_scope(checker *k, graph *g, const char *place)
{
    return (scope){.k = k,
                   .graph = g,
                   .place = place,
                   .sees_parameters = true,
                   .parameters = g->parameter_count,
                   .sees_constants = true,
                   .constants = g->constant_count};
}

static void check_attribute_default(checker *k, graph *g, attribute *a)
{
    scope s = graph_scope(k, g, "the default of an attribute");
    const char *taker = arena_format(k->arena, "'@%s'", a->name);
    a->initial = a->tree->initial ? check_value_as(&s, a->tree->initial, &a->type, taker)
                                  : value_zero(&s, &a->type, a->tree->name.span);
}

static void check_declarations(checker *k, graph *g)
{
    for (uint32_t i = 0; i < g->parameter_count; i++)
        check_parameter(k, g, &g->parameters[i]);
    for (uint32_t i = 0; i < g->constant_count; i++)
        check_constant(k, g, &g->constants[i]);
    for (uint32_t i = 0; i < g->attribute_count; i++)
        check_attribute_default(k, g, &g->attributes[i]);
}

/* ---- conditions ---------------------------------------------------------------------------- */

/* The edges of a chain share one typed condition. */
static void check_edges(checker *k, graph *g)
{
    const tree_chain *last = NULL;
    value *condition = NULL;
    scope s = graph_scope(k, g, "the condition of an edge");
    for (uint32_t i = 0; i < g->edge_count; i++) {
        edge *e = g->edges[i];
        if (!e->chain->condition)
            continue;
        if (e->chain != last)
            condition = check_value_as(&s, e->chain->condition, &type_bool, "'if'");
        last = e->chain;
        e->condition = condition;
    }
}

static void check_blocks(checker *k, graph *g)
{
    scope s = graph_scope(k, g, "the condition of a block");
    for (uint32_t i = 0; i < g->node_count; i++)
        for (uint32_t o = 0; o < g->nodes[i]->output_count; o++) {
            port *p = &g->nodes[i]->outputs[o];
            if (p->block && p->block->condition)
                p->blocked_if = check_value_as(&s, p->block->condition, &type_bool, "'if'");
        }
}

/* ---- the pass ------------------------------------------------------------------------------ */

static void check_body(checker *k, graph *g)
{
    check_ports(k, g);
    for (uint32_t i = 0; i < g->node_count; i++)
        check_node(k, g->nodes[i]);
    check_edges(k, g);
    check_blocks(k, g);
}

static void each_graph(checker *k, void (*visit)(checker *k, graph *g))
{
    for (uint32_t i = 0; i < k->p->unit_count; i++) {
        k->p->scope = k->p->units[i];
        for (uint32_t g = 0; g < k->p->units[i]->graph_count; g++)
            visit(k, k->p->units[i]->graphs[g]);
    }
    k->p->scope = NULL;
}

bool check(compilation *c, program *p)
{
    checker k = {.c = c, .p = p, .arena = &c->arena, .d = &c->diagnostics};
    each_graph(&k, check_declarations);
    each_graph(&k, check_body);
    if (!k.d->errors)
        each_graph(&k, check_flow);
    return !k.d->errors;
}

/* dump_check.c - a checked program as text, for tests: graphs, what they declare, nodes with the
 * types of their ports, typed arguments, links and edges. */
#include "evaluate.h"

static void print_value(const char *separator, const value *v, text *out)
{
    text_add(out, separator);
    value_print(v, out);
}

static void print_constraint(const pcg_constraint_info *c, const type *of, text *out)
{
    static const char *const words[] = {[CONSTRAINT_RANGE] = " range [",
                                        [CONSTRAINT_ONE_OF] = " one of (",
                                        [CONSTRAINT_MATCHES] = " matches ",
                                        [CONSTRAINT_AT_MOST] = " at most "};
    text_add(out, words[c->kind]);
    if (c->kind == CONSTRAINT_RANGE) {
        number_print(c->low, of, out);
        text_add(out, ", ");
        number_print(c->high, of, out);
        text_add(out, "]");
    } else if (c->kind == CONSTRAINT_ONE_OF) {
        for (const char *at = c->text; *at; at++)
            text_add_bytes(out, *at == '\n' ? ", " : at, *at == '\n' ? 2 : 1);
        text_add(out, ")");
    } else if (c->kind == CONSTRAINT_MATCHES) {
        text_quote(out, c->text);
    } else {
        text_number(out, c->high);
        text_add(out, " characters");
    }
}

static void print_declarations(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        const parameter *p = &g->parameters[i];
        text_format(out, "  %sparam %s: ", p->hidden ? "hidden " : "", p->name);
        type_write(&p->type, out);
        print_value(" = ", p->initial, out);
        for (uint32_t k = 0; k < p->constraint_count; k++)
            print_constraint(&p->constraints[k], &p->type, out);
        text_add(out, "\n");
    }
    for (uint32_t i = 0; i < g->constant_count; i++) {
        text_format(out, "  const %s: ", g->constants[i].name);
        type_write(&g->constants[i].type, out);
        print_value(" = ", g->constants[i].value, out);
        text_add(out, "\n");
    }
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        const attribute *a = &g->attributes[i];
        text_format(out, "  attr %s: ", a->name);
        type_write(&a->type, out);
        print_value(" = ", a->initial, out);
        text_format(out, "%s%s\n", a->read ? " read" : "", a->written ? " written" : "");
    }
}

static void print_argument(const argument *a, const char *indent, text *out)
{
    text_format(out, "%s%s: ", indent, a->formal->name);
    type_write(&a->formal->type, out);
    print_value(" = ", a->value, out);
    text_add(out, a->value->reads_entity && a->value->reads_chance ? " (entity, chance)\n"
                  : a->value->reads_entity                         ? " (entity)\n"
                  : a->value->reads_chance                         ? " (chance)\n"
                                                                   : "\n");
}

static void print_link(const attribute_link *l, const char *indent, text *out)
{
    if (l->in) {
        text_format(out, "%s%s: ", indent, l->name);
        type_write(&l->type, out);
        print_value(" = ", l->in, out);
        text_add(out, "\n");
    }
    if (l->kind == LINK_NONE)
        return;
    text_format(out, "%s%s: ", indent, l->name);
    type_write(&l->type, out);
    text_format(out, " %s @%s\n", l->kind == LINK_WRITE ? "=>" : "<=>", l->to->name);
}

static void print_item(const argument_item *item, text *out)
{
    text_format(out, "    %s: %s\n", item->name, item->augment->name);
    for (uint32_t i = 0; i < item->augment->parameter_count; i++)
        print_argument(&item->arguments[i], "      ", out);
    for (uint32_t i = 0; i < item->augment->attribute_count; i++)
        print_link(&item->links[i], "      ", out);
}

static void print_port(const port *p, text *out)
{
    text_format(out, "    %s %s: ", p->is_input ? "in" : "out", p->name);
    type_write(&p->type, out);
    text_add(out, p->optional ? "[]?" : p->collective ? "[]" : "");
    text_add(out, p->implicit ? " implicit" : "");
    text_add(out, p->blocked ? " blocked" : "");
    if (p->blocked_if)
        print_value(" blocked if ", p->blocked_if, out);
    if (p->gathered_by)
        text_format(out, " gathered by %s", p->gathered_by->name);
    text_add(out, "\n");
}

static void print_node(const node *n, text *out)
{
    static const char *const kinds[] = {
        [NODE_PROCEDURE] = "procedure", [NODE_GRAPH] = "graph",         [NODE_INPUT] = "input gate",
        [NODE_OUTPUT] = "output gate",  [NODE_SURROGATE] = "surrogate", [NODE_ERROR] = "error"};
    text_format(out, "  node %s: %s", n->name, kinds[n->kind]);
    if (n->procedure)
        text_format(out, " %s.%s", n->procedure->library->name, n->procedure->name);
    if (n->graph)
        text_format(out, " %s", n->graph->name);
    text_add(out, n->gathers ? " gathers" : "");
    if (n->stands_for)
        text_format(out, " stands in for %s", n->stands_for->name);
    text_add(out, "\n");
    for (uint32_t i = 0; i < n->input_count; i++)
        print_port(&n->inputs[i], out);
    for (uint32_t i = 0; i < n->argument_count; i++)
        print_argument(&n->arguments[i], "    ", out);
    for (uint32_t i = 0; i < n->link_count; i++)
        print_link(&n->links[i], "    ", out);
    for (uint32_t i = 0; i < n->item_count; i++)
        print_item(&n->items[i], out);
    for (uint32_t i = 0; i < n->output_count; i++)
        print_port(&n->outputs[i], out);
}

static void print_edge(const edge *e, text *out)
{
    text_format(out, "  edge %s.%s %s %s.%s", e->from->node->name, e->from->name,
                e->disabled ? "-/>" : "->", e->to->node->name, e->to->name);
    if (e->condition)
        print_value(" if ", e->condition, out);
    text_add(out, "\n");
}

void dump_check(const program *p, text *out)
{
    for (uint32_t i = 0; i < p->graph_count; i++) {
        const graph *g = p->graphs[i];
        text_format(out, "graph %s%s%s\n", g->name, g->main ? " main" : "",
                    g->encapsulated ? " encapsulated" : "");
        print_declarations(g, out);
        for (uint32_t k = 0; k < g->node_count; k++)
            print_node(g->nodes[k], out);
        for (uint32_t k = 0; k < g->edge_count; k++)
            print_edge(g->edges[k], out);
    }
}

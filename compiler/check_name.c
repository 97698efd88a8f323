/* check_name.c - bare words and @attributes: parameters, constants, enumerators, ports. */
#include "check.h"

#include <string.h>

/* ---- enumerators --------------------------------------------------------------------------- */

int64_t enumerator_number(const enumeration *e, const char *name)
{
    for (uint32_t i = 0; i < e->count; i++)
        if (!strcmp(e->names[i], name))
            return i;
    return -1;
}

value *enumerator_value(const scope *s, const type *t, int64_t number, span place)
{
    value *v = value_new(s, VALUE_CONSTANT, *t, place);
    v->any.cell[0].i = number;
    return v;
}

static value *unknown_enumerator(scope *s, const tree_expression *e, const enumeration *of)
{
    names candidates = {0};
    text list = {.arena = s->k->arena};
    for (uint32_t i = 0; i < of->count; i++) {
        LIST_ADD(s->k->arena, &candidates, of->names[i]);
        text_format(&list, "%s%s", i ? ", " : "", of->names[i]);
    }
    diagnose(s->k->d, DIAG_E0208, e->span, e->name.text, list.at ? list.at : of->name)->text =
        did_you_mean(s->k->c, e->name.text, &candidates);
    return value_error(s, e->span);
}

/* ---- bare words ---------------------------------------------------------------------------- */

static port *input_named(const node *n, const char *name)
{
    for (uint32_t i = 0; i < n->input_count; i++)
        if (!strcmp(n->inputs[i].name, name))
            return &n->inputs[i];
    return NULL;
}

bool name_is_known(const scope *s, const char *name)
{
    return s->graph && (table_get(&s->graph->names->parameters, name) ||
                        table_get(&s->graph->names->constants, name) ||
                        (s->node && input_named(s->node, name)));
}

static value *refuse(scope *s, const tree_expression *e, const char *what)
{
    diagnose(s->k->d, DIAG_E0207, e->span, what, s->place);
    return value_error(s, e->span);
}

static value *check_parameter(scope *s, const tree_expression *e, parameter *p)
{
    if (!s->sees_parameters)
        return refuse(s, e, arena_format(s->k->arena, "parameter '%s'", p->name));
    if (p->index >= s->parameters) {
        diagnose(s->k->d, DIAG_E0215, e->span, p->name)->second =
            (diagnostic_label){p->tree->name.span, "declared here"};
        return value_error(s, e->span);
    }
    value *v = value_new(s, VALUE_PARAMETER, p->type, e->span);
    v->parameter = p;
    return v;
}

static value *check_constant(scope *s, const tree_expression *e, constant *k)
{
    if (!s->sees_constants)
        return refuse(s, e, arena_format(s->k->arena, "constant '%s'", k->name));
    if (k->index >= s->constants)
        return value_error(s, e->span);
    value *v = value_new(s, VALUE_CONST, k->type, e->span);
    v->constant = k;
    k->read = true;
    return v;
}

static value *check_port(scope *s, const tree_expression *e, port *p)
{
    if (p->optional)
        diagnose(s->k->d, DIAG_E0321, e->span, p->name);
    value *v = value_new(s, VALUE_ENTITY, p->type, e->span);
    v->port = p;
    v->reads_entity = true;
    return v;
}

static void add_keys(arena *a, names *to, const table *from)
{
    for (uint32_t i = 0; i < from->entries.count; i++)
        LIST_ADD(a, to, from->entries.at[i].key);
}

static value *unknown_name(scope *s, const tree_expression *e, const type *hint)
{
    checker *k = s->k;
    names candidates = {0};
    if (s->graph && s->graph->unit->broken)
        return value_error(s, e->span);
    diagnostic *d = diagnose(k->d, DIAG_E0106, e->span, e->name.text);
    if (!s->graph || !suggestions_wanted(k->c))
        return value_error(s, e->span);
    if (table_get(&s->graph->names->attributes, e->name.text)) {
        d->text = arena_format(k->arena, "write @%s", e->name.text);
        return value_error(s, e->span);
    }
    add_keys(k->arena, &candidates, &s->graph->names->parameters);
    add_keys(k->arena, &candidates, &s->graph->names->constants);
    for (uint32_t i = 0; s->node && i < s->node->input_count; i++)
        LIST_ADD(k->arena, &candidates, s->node->inputs[i].name);
    if (hint && type_is(hint, PCG_COLOR) && (d->text = hint_color(k, e->name.text)))
        return value_error(s, e->span);
    d->text = did_you_mean(k->c, e->name.text, &candidates);
    if (!d->text && hint && type_is(hint, PCG_COLOR))
        d->help = "a color is written #rrggbb, such as #ff8800";
    else if (!d->text && hint && type_is_text(hint))
        d->help = arena_format(k->arena, "text stands in quotes: \"%s\"", e->name.text);
    if (!d->text && table_get(&s->graph->names->nodes, e->name.text))
        d->help = "an expression reads the entities at its own node's inputs, not other nodes";
    return value_error(s, e->span);
}

value *check_name(scope *s, const tree_expression *e, const type *hint)
{
    const char *name = e->name.text;
    const enumeration *of = hint && type_is(hint, PCG_ENUM) ? hint->enumeration : NULL;
    int64_t number = of ? enumerator_number(of, name) : -1;
    if (number >= 0)
        return enumerator_value(s, hint, number, e->span);
    if (s->graph) {
        parameter *p = table_get(&s->graph->names->parameters, name);
        constant *k = table_get(&s->graph->names->constants, name);
        port *input = s->node ? input_named(s->node, name) : NULL;
        if (p)
            return check_parameter(s, e, p);
        if (k)
            return check_constant(s, e, k);
        if (input)
            return check_port(s, e, input);
    }
    return of ? unknown_enumerator(s, e, of) : unknown_name(s, e, hint);
}

/* ---- attributes ---------------------------------------------------------------------------- */

attribute *find_attribute(scope *s, const tree_name *name, const type *like)
{
    checker *k = s->k;
    attribute *a = s->graph ? table_get(&s->graph->names->attributes, name->text) : NULL;
    if (a || (s->graph && s->graph->unit->broken))
        return a;
    names candidates = {0};
    diagnostic *d = diagnose(k->d, DIAG_E0401, name->span, name->text);
    if (s->graph && suggestions_wanted(k->c)) {
        add_keys(k->arena, &candidates, &s->graph->names->attributes);
        d->text = did_you_mean(k->c, name->text, &candidates);
        if (!d->text && table_get(&s->graph->names->parameters, name->text))
            d->text = arena_format(k->arena, "a parameter is written without '@': %s", name->text);
        else if (!d->text)
            d->help = arena_format(k->arena, "declare it in the graph: attr %s: %s%s", name->text,
                                   like ? type_text(k->arena, like) : "int",
                                   like ? "" : " (or another type)");
    }
    return NULL;
}

/* The input whose entity is meant; NULL: it was reported. */
static port *attribute_port(scope *s, const tree_expression *e)
{
    node *n = s->node;
    if (e->port.text) {
        port *p = input_named(n, e->port.text);
        names candidates = {0};
        if (p || n->kind == NODE_ERROR || n->broken)
            return p;
        for (uint32_t i = 0; i < n->input_count; i++)
            LIST_ADD(s->k->arena, &candidates, n->inputs[i].name);
        diagnose(s->k->d, DIAG_E0406, e->port.span, node_title(n), e->port.text)->text =
            did_you_mean(s->k->c, e->port.text, &candidates);
        return NULL;
    }
    if (!n->input_count && n->kind != NODE_ERROR)
        diagnose(s->k->d, DIAG_E0405, e->span, node_title(n), e->name.text)->help =
            "a chain into a source feeds its port 'impulse', whose entity can then be read";
    return n->input_count ? &n->inputs[0] : NULL;
}

value *check_attribute(scope *s, const tree_expression *e)
{
    if (!s->node)
        return refuse(s, e, arena_format(s->k->arena, "'@%s'", e->name.text));
    attribute *a = find_attribute(s, &e->name, NULL);
    port *p = attribute_port(s, e);
    if (!a || !p)
        return value_error(s, e->span);
    if (p->optional)
        diagnose(s->k->d, DIAG_E0321, e->span, p->name);
    value *v = value_new(s, VALUE_ATTRIBUTE, a->type, e->span);
    v->attribute = a;
    v->port = p;
    v->reads_entity = true;
    a->read = true;
    return v;
}

/* What takes an attribute may read and write it. */
value *check_slot(scope *s, const tree_expression *e, const char *taker)
{
    if (e->kind == EXPR_ERROR)
        return value_error(s, e->span);
    if (e->kind != EXPR_ATTRIBUTE || e->port.text || !s->graph) {
        text written = {.arena = s->k->arena};
        lang_write_expression(e, &written);
        diagnostic *d = diagnose(s->k->d, DIAG_E0217, e->span,
                                 arena_format(s->k->arena, "'%s' for %s", written.at, taker));
        if (e->kind == EXPR_NAME && s->graph &&
            table_get(&s->graph->names->attributes, e->name.text))
            d->text = arena_format(s->k->arena, "write @%s", e->name.text);
        return value_error(s, e->span);
    }
    attribute *a = find_attribute(s, &e->name, NULL);
    if (!a)
        return value_error(s, e->span);
    value *v = value_new(s, VALUE_SLOT, (type){.kind = TYPE_ATTRIBUTE}, e->span);
    v->attribute = a;
    a->read = a->written = true;
    return v;
}

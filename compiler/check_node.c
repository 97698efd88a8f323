/* check_node.c - what a node and its augmentations are given: arguments and links. */
#include "check.h"

#include <string.h>

/* A pair of parentheses: a node's, or an augmentation's. */
typedef struct brackets {
    scope *s;
    const char *name; /* of the procedure, graph or augmentation */
    argument *arguments;
    attribute_link *links;
    uint32_t argument_count, link_count;
    const tree_arguments *trees;
    const tree_argument **given; /* by argument */
    span place;                  /* where what is missing is missed */
    bool hands_in; /* its attributes can be given values: those of an encapsulated graph */
    bool unclear;  /* an argument could not be told: others may be missing because of it */
} brackets;

/* ---- which parameter ----------------------------------------------------------------------- */

static bool is_hidden(const argument *a)
{
    return a->formal->tree->hidden;
}

static argument *argument_named(const brackets *b, const char *name)
{
    for (uint32_t i = 0; i < b->argument_count; i++)
        if (!strcmp(b->arguments[i].formal->name, name))
            return &b->arguments[i];
    return NULL;
}

static attribute_link *link_named(const brackets *b, const char *name)
{
    for (uint32_t i = 0; i < b->link_count; i++)
        if (!strcmp(b->links[i].name, name))
            return &b->links[i];
    return NULL;
}

/* The n-th argument that can be given without its name. */
static argument *argument_at(const brackets *b, uint32_t n)
{
    for (uint32_t i = 0; i < b->argument_count; i++)
        if (!is_hidden(&b->arguments[i]) && n-- == 0)
            return &b->arguments[i];
    return NULL;
}

static const char *suggest_argument(const brackets *b, const char *name)
{
    checker *k = b->s->k;
    names candidates = {0};
    if (!suggestions_wanted(k->c))
        return NULL;
    for (uint32_t i = 0; i < b->argument_count; i++)
        if (!is_hidden(&b->arguments[i]))
            LIST_ADD(k->arena, &candidates, b->arguments[i].formal->name);
    for (uint32_t i = 0; i < b->link_count; i++)
        LIST_ADD(k->arena, &candidates, b->links[i].name);
    return did_you_mean(k->c, name, &candidates);
}

static const char *list_arguments(const brackets *b)
{
    text list = {.arena = b->s->k->arena};
    for (uint32_t i = 0; i < b->argument_count; i++)
        if (!is_hidden(&b->arguments[i]))
            text_format(&list, "%s%s",
                        list.length ? ", " : "its parameters: ", b->arguments[i].formal->name);
    return list.at;
}

static void report_twice(const brackets *b, const tree_argument *t, const char *name, span first)
{
    diagnose(b->s->k->d, DIAG_E0502, t->span, name)->second =
        (diagnostic_label){first, "first here"};
}

static void give(brackets *b, argument *a, const tree_argument *t)
{
    const tree_argument **slot = &b->given[a - b->arguments];
    if (*slot)
        report_twice(b, t, a->formal->name, (*slot)->span);
    else if (is_hidden(a))
        diagnose(b->s->k->d, DIAG_E0512, t->name.span, a->formal->name, b->name);
    else
        *slot = t;
}

/* ---- values -------------------------------------------------------------------------------- */

static void report_unknown(brackets *b, const tree_argument *t)
{
    b->unclear = true;
    if (b->s->node->broken)
        return;
    diagnostic *d = diagnose(b->s->k->d, DIAG_E0501, t->name.span, b->name, t->name.text);
    d->text = suggest_argument(b, t->name.text);
    if (!d->text)
        d->help = list_arguments(b);
}

/* name = expression, where the name is an attribute. */
static void hand_in(brackets *b, attribute_link *l, const tree_argument *t)
{
    if (!b->hands_in) {
        diagnose(b->s->k->d, DIAG_E0404, t->span, l->name, b->name)->help =
            arena_format(b->s->k->arena, "write %s => @attribute", l->name);
        return;
    }
    if (l->in) {
        report_twice(b, t, l->name, l->in->span);
        return;
    }
    const char *taker = arena_format(b->s->k->arena, "'%s'", l->name);
    l->in = check_value_as(b->s, t->value, &l->type, taker);
    if (l->inner)
        l->inner->written = true;
}

static void bind_named(brackets *b, const tree_argument *t)
{
    argument *a = argument_named(b, t->name.text);
    attribute_link *l = a ? NULL : link_named(b, t->name.text);
    if (a)
        give(b, a, t);
    else if (l)
        hand_in(b, l, t);
    else
        report_unknown(b, t);
}

static const char *count_text(checker *k, uint32_t count)
{
    return count == 0   ? "no arguments"
           : count == 1 ? "1 argument"
                        : arena_format(k->arena, "%u arguments", (unsigned)count);
}

static uint32_t visible_count(const brackets *b)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < b->argument_count; i++)
        count += !is_hidden(&b->arguments[i]);
    return count;
}

static uint32_t count_unnamed(const tree_arguments *trees)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < trees->count; i++)
        count += trees->at[i].kind == ARGUMENT_VALUE && !trees->at[i].name.text;
    return count;
}

/* Arguments without a name lead, and are those of the first parameters. */
static void bind_values(brackets *b)
{
    checker *k = b->s->k;
    uint32_t positional = 0;
    bool named = false, reported = false;
    for (uint32_t i = 0; i < b->trees->count; i++) {
        const tree_argument *t = &b->trees->at[i];
        if (t->kind == ARGUMENT_VALUE && t->name.text) {
            bind_named(b, t);
        } else if (t->kind == ARGUMENT_VALUE && named) {
            diagnose(k->d, DIAG_E0504, t->span);
            b->unclear = true;
        } else if (t->kind == ARGUMENT_VALUE) {
            argument *a = argument_at(b, positional++);
            if (a)
                give(b, a, t);
            else if (!reported)
                diagnose(k->d, DIAG_E0503, t->span, b->name, count_text(k, visible_count(b)),
                         (unsigned)count_unnamed(b->trees));
            reported |= !a;
        }
        named |= t->name.text != NULL;
    }
}

/* ---- links --------------------------------------------------------------------------------- */

/* Written values may widen as arguments do; shared ones cannot, since they come back. */
static bool link_fits(const attribute_link *l, const attribute *to, link_kind kind)
{
    value like = {.kind = VALUE_ATTRIBUTE, .type = l->type};
    if (kind == LINK_WRITE)
        return conversion_cost(&like, &to->type) < CONVERT_NEVER;
    return type_is_error(&l->type) || type_is_error(&to->type) || type_equal(&l->type, &to->type);
}

static void make_link(brackets *b, attribute_link *l, const tree_argument *t)
{
    checker *k = b->s->k;
    link_kind kind = t->kind == ARGUMENT_WRITE ? LINK_WRITE : LINK_SHARE;
    attribute *to = find_attribute(b->s, &t->attribute, &l->type);
    if (l->kind != LINK_NONE) {
        diagnose(k->d, DIAG_E0502, t->span, l->name);
        return;
    }
    if (!to)
        return;
    if (!link_fits(l, to, kind)) {
        diagnostic *d =
            diagnose(k->d, DIAG_E0403, t->name.span, l->name, type_text(k->arena, &l->type),
                     to->name, type_text(k->arena, &to->type));
        d->second = (diagnostic_label){t->attribute.span, NULL};
    }
    l->kind = kind;
    l->to = to;
    to->written = true;
    to->read |= kind == LINK_SHARE;
    if (l->inner) {
        l->inner->read = true;
        l->inner->written |= kind == LINK_SHARE;
    }
}

static void bind_link(brackets *b, const tree_argument *t)
{
    checker *k = b->s->k;
    attribute_link *l = link_named(b, t->name.text);
    if (l) {
        make_link(b, l, t);
    } else if (argument_named(b, t->name.text)) {
        diagnose(k->d, DIAG_E0407, t->name.span, t->name.text, b->name)->help =
            arena_format(k->arena, "write %s = @%s", t->name.text, t->attribute.text);
    } else {
        diagnose(k->d, DIAG_E0402, t->name.span, b->name, t->name.text)->text =
            suggest_argument(b, t->name.text);
    }
}

static void bind_links(brackets *b)
{
    for (uint32_t i = 0; i < b->trees->count; i++)
        if (b->trees->at[i].kind != ARGUMENT_VALUE)
            bind_link(b, &b->trees->at[i]);
}

/* ---- what each parameter gets -------------------------------------------------------------- */

/* A parameter of type any takes what the attribute named before it holds. */
static const type *wanted_type(const brackets *b, uint32_t i)
{
    const formal *f = b->arguments[i].formal;
    if (f->type.kind != TYPE_ANY)
        return &f->type;
    while (i-- > 0)
        if (b->arguments[i].formal->type.kind == TYPE_ATTRIBUTE) {
            const value *v = b->arguments[i].value;
            return v->kind == VALUE_SLOT ? &v->attribute->type : &type_error;
        }
    return &f->type;
}

/* iterate's `index` is the name of a parameter that its braces declare. */
static const tree_expression *index_name(const brackets *b, const formal *f,
                                         const tree_expression *e)
{
    const node *n = b->s->node;
    if (n->kind != NODE_SURROGATE || strcmp(f->name, "index") != 0 || e->kind != EXPR_NAME)
        return NULL;
    const tree_body *body = n->tree->body;
    for (uint32_t i = 0; body && i < body->parameters.count; i++)
        if (!strcmp(body->parameters.at[i]->name.text, e->name.text))
            return e;
    return NULL;
}

static value *given_value(brackets *b, uint32_t i)
{
    checker *k = b->s->k;
    const formal *f = b->arguments[i].formal;
    const tree_expression *e = b->given[i]->value;
    if (index_name(b, f, e)) {
        value *v = value_new(b->s, VALUE_CONSTANT, type_string, e->span);
        v->any.cell[0].s = v->string = e->name.text;
        return v;
    }
    const char *taker = arena_format(k->arena, "'%s' of '%s'", f->name, b->name);
    value *v = check_value_as(b->s, e, wanted_type(b, i), taker);
    check_constrained(k, v, f->name, f->constraints, f->constraint_count);
    return v;
}

static value *default_value(brackets *b, uint32_t i)
{
    checker *k = b->s->k;
    const formal *f = b->arguments[i].formal;
    if (!f->initial) {
        bool lost = b->unclear || b->s->graph->unit->broken || type_is_error(&f->type);
        if (!lost)
            diagnose(k->d, DIAG_E0505, b->place, b->name, f->name);
        return value_error(b->s, b->place);
    }
    const type *wanted = wanted_type(b, i);
    value *v = wanted->kind == TYPE_VALUE && f->type.kind == TYPE_ANY
                   ? value_convert(k, f->initial, wanted)
                   : f->initial;
    return v ? v
             : report_mismatch(b->s, f->initial, wanted, arena_format(k->arena, "'%s'", f->name));
}

static void check_brackets(brackets *b)
{
    checker *k = b->s->k;
    b->given = ARENA_ARRAY(k->arena, const tree_argument *, b->argument_count);
    bind_values(b);
    for (uint32_t i = 0; i < b->argument_count; i++) {
        argument *a = &b->arguments[i];
        check_formal(k, a->formal);
        a->given = b->given[i] != NULL;
        a->value = a->given ? given_value(b, i) : default_value(b, i);
    }
    bind_links(b);
}

/* A parameter of the graph whose name is known now must be there: what `set_parameter` and its like
 * are given. */
static void check_reflection(const brackets *b, const node *n)
{
    checker *k = b->s->k;
    const graph *g = n->owner;
    names candidates = {0};
    const argument *a = argument_named(b, "parameter");
    if (n->kind != NODE_PROCEDURE || !(n->procedure->traits & TRAIT_REFLECTS) || !a || !a->given ||
        a->value->kind != VALUE_CONSTANT || !a->value->string)
        return;
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        if (!strcmp(g->parameters[i].name, a->value->string))
            return;
        LIST_ADD(k->arena, &candidates, g->parameters[i].name);
    }
    diagnose(k->d, DIAG_E0501, a->value->span, g->name, a->value->string)->text =
        did_you_mean(k->c, a->value->string, &candidates);
}

/* ---- nodes --------------------------------------------------------------------------------- */

static void check_item(scope *s, argument_item *item)
{
    brackets b = {.s = s,
                  .name = item->augment->name,
                  .arguments = item->arguments,
                  .argument_count = item->augment->parameter_count,
                  .links = item->links,
                  .link_count = item->augment->attribute_count,
                  .trees = &item->tree->arguments,
                  .place = item->tree->kind.span};
    check_brackets(&b);
    check_reflection(&b, s->node);
}

void check_node(checker *k, node *n)
{
    if (n->kind != NODE_PROCEDURE && n->kind != NODE_GRAPH && n->kind != NODE_SURROGATE)
        return;
    graph *g = n->owner;
    scope s = {.k = k,
               .place = "an argument",
               .graph = g,
               .node = n,
               .sees_parameters = true,
               .sees_constants = true,
               .parameters = g->parameter_count,
               .constants = g->constant_count};
    brackets b = {.s = &s,
                  .name = n->graph ? n->graph->name : n->procedure->name,
                  .arguments = n->arguments,
                  .argument_count = n->argument_count,
                  .links = n->links,
                  .link_count = n->link_count,
                  .trees = &n->tree->arguments,
                  .place = n->tree->procedure.span,
                  .hands_in = n->kind != NODE_PROCEDURE};
    check_brackets(&b);
    check_reflection(&b, n);
    for (uint32_t i = 0; i < n->item_count; i++)
        check_item(&s, &n->items[i]);
    if (n->kind == NODE_SURROGATE)
        check_surrogate(k, n);
}

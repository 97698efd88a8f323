/* build.c - constructors of the syntax tree: what the grammar's actions call. */
#include "parser.h"

#include <string.h>

/* ---- expressions ----------------------------------------------------------------------------- */

tree_expression *build_expression(parser *p, tree_expression_kind kind, span at)
{
    tree_expression *e = ARENA_NEW(p->arena, tree_expression);
    e->kind = kind;
    e->span = at;
    e->depth = 1;
    return e;
}

/* Adds an operand. What would become too deep ends the parse: every walk over the tree is
 * recursive. */
static void add_operand(parser *p, tree_expression *e, tree_expression *operand)
{
    if (operand->depth >= LANG_MAX_DEPTH) {
        syntax_too_deep(p, operand->span, LANG_MAX_DEPTH);
        operand = build_expression(p, EXPR_ERROR, operand->span);
    }
    LIST_ADD(p->arena, &e->operands, operand);
    if (operand->depth >= e->depth)
        e->depth = operand->depth + 1;
}

static span join(span first, span last)
{
    first.to = last.to;
    return first;
}

tree_expression *build_unary(parser *p, tree_operator op, tree_expression *operand, span at)
{
    tree_expression *e = build_expression(p, EXPR_UNARY, at);
    e->op = op;
    add_operand(p, e, operand);
    return e;
}

tree_expression *build_binary(parser *p, tree_operator op, tree_expression *left,
                              tree_expression *right)
{
    tree_expression *e = build_expression(p, EXPR_BINARY, join(left->span, right->span));
    e->op = op;
    add_operand(p, e, left);
    add_operand(p, e, right);
    return e;
}

tree_expression *build_choice(parser *p, tree_expression *condition, tree_expression *yes,
                              tree_expression *no)
{
    tree_expression *e = build_expression(p, EXPR_CHOICE, join(condition->span, no->span));
    add_operand(p, e, condition);
    add_operand(p, e, yes);
    add_operand(p, e, no);
    return e;
}

tree_expression *build_name(parser *p, tree_name name)
{
    tree_expression *e = build_expression(p, EXPR_NAME, name.span);
    e->name = name;
    return e;
}

tree_expression *build_attribute(parser *p, tree_name port, tree_name attribute, span at)
{
    tree_expression *e = build_expression(p, EXPR_ATTRIBUTE, at);
    e->port = port;
    e->name = attribute;
    return e;
}

static void add_operands(parser *p, tree_expression *e, tree_expressions operands)
{
    for (uint32_t i = 0; i < operands.count; i++)
        add_operand(p, e, operands.at[i]);
}

tree_expression *build_call(parser *p, tree_name name, tree_expressions arguments, span at)
{
    tree_expression *e = build_expression(p, EXPR_CALL, at);
    e->name = name;
    add_operands(p, e, arguments);
    return e;
}

tree_expression *build_list(parser *p, tree_expressions operands, span at)
{
    tree_expression *e = build_expression(p, EXPR_LIST, at);
    add_operands(p, e, operands);
    return e;
}

/* ---- the original notation ------------------------------------------------------------------- */

static bool is_upper(char c)
{
    return c >= 'A' && c <= 'Z';
}

/* .X is .x */
tree_expression *build_member(parser *p, tree_expression *of, tree_name name)
{
    tree_expression *e = build_expression(p, EXPR_MEMBER, join(of->span, name.span));
    if (is_upper(name.text[0]) && !name.text[1])
        name.text = arena_format(p->arena, "%c", name.text[0] - 'A' + 'a');
    e->name = name;
    add_operand(p, e, of);
    return e;
}

/* IsFacing becomes is_facing. */
static const char *snake_case(parser *p, const char *name)
{
    text t = {.arena = p->arena};
    for (const char *s = name; *s; s++) {
        if (is_upper(*s) && s > name && !is_upper(s[-1]))
            text_add(&t, "_");
        char c = is_upper(*s) ? (char)(*s - 'A' + 'a') : *s;
        text_add_bytes(&t, &c, 1);
    }
    return t.at;
}

/* Math.Min(a, b) is min(a, b), Vector3D.New(x, y, z) is vec3(x, y, z). */
static tree_expression *original_static_call(parser *p, const tree_expression *of, tree_name name,
                                             tree_expressions arguments, span at)
{
    static const char *const vectors[] = {"Vector2D", "Vector3D", "Vector4D"};
    static const char *const made[] = {"vec2", "vec3", "vec4"};
    const char *function = snake_case(p, name.text);
    for (size_t i = 0; i < COUNT_OF(vectors); i++)
        if (strcmp(of->name.text, vectors[i]) == 0 && strcmp(name.text, "New") == 0)
            function = made[i];
    name.text = function;
    return build_call(p, name, arguments, at);
}

/* In this language, what a call is of is a library; in the original one also a class, whose name
 * begins with a capital letter, or the value that a method is called on. */
tree_expression *build_member_call(parser *p, tree_expression *of, tree_name name,
                                   tree_expressions arguments, span at)
{
    bool bare = of->kind == EXPR_NAME && !of->parenthesised;
    if (bare && is_upper(of->name.text[0]) && is_upper(name.text[0]))
        return original_static_call(p, of, name, arguments, at);
    if (bare && !is_upper(name.text[0])) {
        tree_expression *call = build_call(p, name, arguments, at);
        call->port = of->name;
        return call;
    }
    tree_expressions all = build_operands(p, of);
    for (uint32_t i = 0; i < arguments.count; i++)
        LIST_ADD(p->arena, &all, arguments.at[i]);
    if (is_upper(name.text[0]))
        name.text = snake_case(p, name.text);
    else
        diagnose(p->diagnostics, DIAG_E0021, name.span, name.text)->help =
            arena_format(p->arena, "write %s(…) with the value as its first argument", name.text);
    return build_call(p, name, all, at);
}

tree_expressions build_operands(parser *p, tree_expression *one)
{
    tree_expressions list = {0};
    LIST_ADD(p->arena, &list, one);
    return list;
}

/* ---- types, parameters ----------------------------------------------------------------------- */

tree_type *build_type(parser *p, tree_name name, tree_type *element, span at)
{
    tree_type *t = ARENA_NEW(p->arena, tree_type);
    int depth = 0;
    t->name = name;
    t->element = element;
    t->span = at;
    for (const tree_type *inner = element; inner; inner = inner->element)
        depth++;
    if (depth >= LANG_MAX_NESTING) {
        syntax_too_deep(p, at, LANG_MAX_NESTING);
        t->element = NULL;
    }
    if (element && strcmp(name.text, "list") != 0)
        diagnose(p->diagnostics, DIAG_E0022, name.span, name.text);
    return t;
}

tree_parameter *build_parameter(parser *p, tree_name name, tree_type *type,
                                tree_expression *initial, span at)
{
    tree_parameter *parameter = ARENA_NEW(p->arena, tree_parameter);
    parameter->head.span = at;
    parameter->name = name;
    parameter->type = type;
    parameter->initial = initial;
    return parameter;
}

tree_constraint build_constraint(tree_constraint_kind kind, tree_expressions operands, span at)
{
    tree_constraint c = {.kind = kind, .span = at, .operands = operands};
    return c;
}

tree_gate *build_gate(parser *p, tree_name name, tree_type *type, span at)
{
    tree_gate *g = ARENA_NEW(p->arena, tree_gate);
    g->head.span = at;
    g->name = name;
    g->type = type;
    return g;
}

/* ---- chains ---------------------------------------------------------------------------------- */

tree_argument build_argument(tree_argument_kind kind, tree_name name, tree_expression *value,
                             tree_name attribute, span at)
{
    tree_argument a = {
        .kind = kind, .span = at, .name = name, .value = value, .attribute = attribute};
    return a;
}

tree_argument build_bare_link(parser *p, tree_argument_kind kind, tree_name name,
                              tree_name attribute, span at)
{
    diagnose(p->diagnostics, DIAG_E0015, attribute.span)->text =
        arena_format(p->arena, "write '@%s'", attribute.text);
    return build_argument(kind, name, NULL, attribute, at);
}

tree_augmentation *build_augmentation(parser *p, tree_name name, tree_name kind,
                                      const tree_arguments *arguments, span at)
{
    tree_augmentation *a = ARENA_NEW(p->arena, tree_augmentation);
    a->head.span = at;
    a->name = name;
    a->kind = kind;
    if (arguments)
        a->arguments = *arguments;
    a->has_parentheses = arguments != NULL;
    return a;
}

tree_element *build_reference(parser *p, tree_name name, tree_name port, span at)
{
    tree_element *e = ARENA_NEW(p->arena, tree_element);
    e->kind = ELEMENT_REFERENCE;
    e->span = at;
    e->name = name;
    e->port = port;
    return e;
}

tree_element *build_node(parser *p, tree_name name, tree_element *path, const tree_element *call,
                         span at)
{
    tree_element *e = ARENA_NEW(p->arena, tree_element);
    e->kind = ELEMENT_NODE;
    e->span = at;
    e->name = name;
    e->procedure = path->port.text ? path->port : path->name;
    if (path->port.text)
        e->library = path->name;
    if (call) {
        e->arguments = call->arguments;
        e->has_parentheses = call->has_parentheses;
        e->body = call->body;
    }
    return e;
}

tree_chain *build_chain(parser *p, tree_element *first)
{
    tree_chain *c = ARENA_NEW(p->arena, tree_chain);
    c->span = first->span;
    LIST_ADD(p->arena, &c->elements, first);
    return c;
}

void build_link(parser *p, tree_chain *chain, tree_arrow arrow, tree_element *to)
{
    LIST_ADD(p->arena, &chain->arrows, arrow);
    if (to)
        LIST_ADD(p->arena, &chain->elements, to);
}

/* ---- members and items ----------------------------------------------------------------------- */

static tree_member *add_member(parser *p, tree_graph *g, tree_member_kind kind, span at)
{
    tree_member *m = ARENA_NEW(p->arena, tree_member);
    m->kind = kind;
    m->head.span = at;
    LIST_ADD(p->arena, &g->members, m);
    return m;
}

void build_parameter_member(parser *p, tree_graph *g, tree_member_kind kind,
                            tree_parameter *parameter, span begin)
{
    parameter->head.span = join(begin, parameter->head.span);
    add_member(p, g, kind, parameter->head.span)->parameter = parameter;
}

void build_gate_member(parser *p, tree_graph *g, tree_member_kind kind, tree_gate *gate, span begin)
{
    gate->head.span = join(begin, gate->head.span);
    add_member(p, g, kind, gate->head.span)->gate = gate;
}

/* A link that could not be read left an arrow without its element. */
static bool is_broken(const tree_chain *chain)
{
    return chain->arrows.count != chain->elements.count - 1;
}

void build_chain_member(parser *p, tree_graph *g, tree_chain *chain)
{
    if (!is_broken(chain)) {
        add_member(p, g, MEMBER_CHAIN, chain->span)->chain = chain;
        return;
    }
    for (uint32_t i = 0; i < chain->elements.count; i++) {
        tree_element *e = chain->elements.at[i];
        if (e->kind == ELEMENT_NODE)
            add_member(p, g, MEMBER_CHAIN, e->span)->chain = build_chain(p, e);
    }
}

void build_block_member(parser *p, tree_graph *g, const tree_element *path,
                        tree_expression *condition, span begin)
{
    tree_block *b = ARENA_NEW(p->arena, tree_block);
    b->head.span = join(begin, condition ? condition->span : path->span);
    b->node = path->name;
    b->port = path->port;
    b->condition = condition;
    add_member(p, g, MEMBER_BLOCK, b->head.span)->block = b;
}

void build_names(parser *p, tree_names *to, tree_names from)
{
    for (uint32_t i = 0; i < from.count; i++)
        LIST_ADD(p->arena, to, from.at[i]);
}

tree_name build_dotted(parser *p, tree_name left, tree_name right, span at)
{
    return (tree_name){arena_format(p->arena, "%s.%s", left.text, right.text), at};
}

void build_item(parser *p, tree_item_kind kind, void *item)
{
    tree_item i = {.kind = kind};
    switch (kind) {
    case ITEM_IMPORT:
        i.import = item;
        break;
    case ITEM_USE:
        i.use = item;
        break;
    case ITEM_GRAPH:
        i.graph = item;
        break;
    case ITEM_PROCEDURE:
        i.procedure = item;
        break;
    case ITEM_FUNCTION:
        i.function = item;
        break;
    case ITEM_ENTITY:
        i.entity = item;
        break;
    case ITEM_ENUMERATION:
        i.enumeration = item;
        break;
    }
    LIST_ADD(p->arena, &p->file->items, i);
}

void build_unknown_item(parser *p, tree_name word)
{
    static const char *const words[] = {"import",   "use",    "graph", "procedure",
                                        "function", "entity", "enum"};
    const char *near = nearest_name(word.text, words, COUNT_OF(words));
    diagnostic *d = diagnose(p->diagnostics, DIAG_E0010, word.span, syntax_quote(p, word.span),
                             "'graph', 'import' or 'use'");
    if (near)
        d->text = arena_format(p->arena, "did you mean '%s'?", near);
}

/* write.c - expressions, types and chains as source text, on one line. */
#include "parser.h"

#include <math.h>
#include <string.h>

/* ---- names ----------------------------------------------------------------------------------- */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_reserved(const char *name)
{
    return strcmp(name, "true") == 0 || strcmp(name, "false") == 0 || strcmp(name, "if") == 0;
}

/* It can stand without quotes. */
static bool is_bare(const char *name)
{
    if (!is_letter(*name) || is_reserved(name))
        return false;
    for (; *name; name++)
        if (!is_letter(*name) && !(*name >= '0' && *name <= '9'))
            return false;
    return true;
}

void lang_write_name(const char *name, text *out)
{
    text_format(out, is_bare(name) ? "%s" : "'%s'", name);
}

/* ---- literals -------------------------------------------------------------------------------- */

/* 0.07 is 7%, though 0.07 * 100 is not 7: the rounded number where it reads back the same. */
static double in_percent(double value)
{
    double exact = value * 100, rounded = round(exact * 1e9) / 1e9;
    return rounded / 100 == value ? rounded : exact;
}

static void write_number(const tree_expression *e, text *out)
{
    static const char *const suffixes[] = {"", "m", "m2", "deg", "%", "s"};
    size_t before = out->length;
    text_number(out, e->unit == UNIT_PERCENT ? in_percent(e->number) : e->number);
    if (e->unit == UNIT_NONE && out->at && !strpbrk(out->at + before, ".en"))
        text_add(out, ".0");
    text_add(out, suffixes[e->unit]);
}

static void write_color(uint32_t color, text *out)
{
    if ((color & 0xFF) == 0xFF)
        text_format(out, "#%06x", (unsigned)(color >> 8));
    else
        text_format(out, "#%08x", (unsigned)color);
}

/* ---- expressions ----------------------------------------------------------------------------- */

/* How tightly a form binds; an operand that binds less tightly than its place asks for takes
 * parentheses. */
enum {
    CHOICE = 0,
    LEVEL_OR,
    LEVEL_AND,
    LEVEL_BIT_OR,
    LEVEL_BIT_XOR,
    LEVEL_BIT_AND,
    LEVEL_EQUAL,
    LEVEL_LESS,
    LEVEL_SHIFT,
    LEVEL_ADD,
    LEVEL_MULTIPLY,
    LEVEL_UNARY,
    LEVEL_POSTFIX
};

static const struct operator_row {
    const char *text;
    int level;
} operators[] = {
    [OP_NEGATE] = {"-", LEVEL_UNARY},
    [OP_NOT] = {"!", LEVEL_UNARY},
    [OP_COMPLEMENT] = {"~", LEVEL_UNARY},
    [OP_MULTIPLY] = {"*", LEVEL_MULTIPLY},
    [OP_DIVIDE] = {"/", LEVEL_MULTIPLY},
    [OP_REMAINDER] = {"%", LEVEL_MULTIPLY},
    [OP_ADD] = {"+", LEVEL_ADD},
    [OP_SUBTRACT] = {"-", LEVEL_ADD},
    [OP_SHIFT_LEFT] = {"<<", LEVEL_SHIFT},
    [OP_SHIFT_RIGHT] = {">>", LEVEL_SHIFT},
    [OP_LESS] = {"<", LEVEL_LESS},
    [OP_LESS_EQUAL] = {"<=", LEVEL_LESS},
    [OP_GREATER] = {">", LEVEL_LESS},
    [OP_GREATER_EQUAL] = {">=", LEVEL_LESS},
    [OP_EQUAL] = {"==", LEVEL_EQUAL},
    [OP_NOT_EQUAL] = {"!=", LEVEL_EQUAL},
    [OP_BIT_AND] = {"&", LEVEL_BIT_AND},
    [OP_BIT_XOR] = {"^", LEVEL_BIT_XOR},
    [OP_BIT_OR] = {"|", LEVEL_BIT_OR},
    [OP_AND] = {"&&", LEVEL_AND},
    [OP_OR] = {"||", LEVEL_OR},
};

const char *lang_operator(tree_operator op)
{
    return operators[op].text;
}

static int level_of(const tree_expression *e)
{
    bool negative =
        (e->kind == EXPR_INT && e->integer < 0) || (e->kind == EXPR_FLOAT && signbit(e->number));
    if (e->kind == EXPR_CHOICE)
        return CHOICE;
    if (e->kind == EXPR_UNARY || e->kind == EXPR_BINARY)
        return operators[e->op].level;
    return negative ? LEVEL_UNARY : LEVEL_POSTFIX;
}

static void write_at(const tree_expression *e, int level, text *out);

static void write_operands(const tree_expressions *operands, text *out)
{
    for (uint32_t i = 0; i < operands->count; i++) {
        text_add(out, i ? ", " : "");
        write_at(operands->at[i], CHOICE, out);
    }
}

/* A name of the original notation may hold what a quoted one cannot. */
static void write_reference(const tree_expression *e, text *out)
{
    bool quotable = !strchr(e->name.text, '\'') && !(e->port.text && strchr(e->port.text, '\''));
    if (e->kind == EXPR_NAME && quotable)
        lang_write_name(e->name.text, out);
    else if (e->kind == EXPR_NAME)
        text_format(out, "@{%s}", e->name.text);
    else if (e->port.text && !quotable)
        text_format(out, "${%s}{%s}", e->port.text, e->name.text);
    else {
        if (e->port.text)
            lang_write_name(e->port.text, out);
        text_add(out, "@");
        lang_write_name(e->name.text, out);
    }
}

static void write_binary(const tree_expression *e, text *out)
{
    int level = operators[e->op].level;
    write_at(e->operands.at[0], level, out);
    text_format(out, " %s ", operators[e->op].text);
    write_at(e->operands.at[1], level + 1, out);
}

static void write_choice(const tree_expression *e, text *out)
{
    write_at(e->operands.at[0], CHOICE + 1, out);
    text_add(out, " ? ");
    write_at(e->operands.at[1], CHOICE, out);
    text_add(out, " : ");
    write_at(e->operands.at[2], CHOICE, out);
}

static void write_call(const tree_expression *e, text *out)
{
    if (e->port.text) {
        lang_write_name(e->port.text, out);
        text_add(out, ".");
    }
    lang_write_name(e->name.text, out);
    text_add(out, "(");
    write_operands(&e->operands, out);
    text_add(out, ")");
}

static void write_bare(const tree_expression *e, text *out)
{
    switch (e->kind) {
    case EXPR_ERROR:
        text_add(out, "?");
        break;
    case EXPR_BOOL:
        text_add(out, e->boolean ? "true" : "false");
        break;
    case EXPR_INT:
        text_format(out, "%lld", (long long)e->integer);
        break;
    case EXPR_FLOAT:
        write_number(e, out);
        break;
    case EXPR_STRING:
        text_quote(out, e->string);
        break;
    case EXPR_COLOR:
        write_color(e->color, out);
        break;
    case EXPR_LIST:
        text_add(out, "[");
        write_operands(&e->operands, out);
        text_add(out, "]");
        break;
    case EXPR_NAME:
    case EXPR_ATTRIBUTE:
        write_reference(e, out);
        break;
    case EXPR_MEMBER:
        write_at(e->operands.at[0], LEVEL_POSTFIX, out);
        text_add(out, ".");
        lang_write_name(e->name.text, out);
        break;
    case EXPR_UNARY:
        text_add(out, operators[e->op].text);
        write_at(e->operands.at[0], LEVEL_UNARY, out);
        break;
    case EXPR_BINARY:
        write_binary(e, out);
        break;
    case EXPR_CHOICE:
        write_choice(e, out);
        break;
    case EXPR_CALL:
        write_call(e, out);
        break;
    }
}

static void write_at(const tree_expression *e, int level, text *out)
{
    bool parentheses = e->parenthesised || level_of(e) < level;
    if (parentheses)
        text_add(out, "(");
    write_bare(e, out);
    if (parentheses)
        text_add(out, ")");
}

void lang_write_expression(const tree_expression *e, text *out)
{
    write_at(e, CHOICE, out);
}

/* ---- types, declarations --------------------------------------------------------------------- */

void lang_write_type(const tree_type *t, text *out)
{
    lang_write_name(t->name.text, out);
    if (t->element) {
        text_add(out, "<");
        lang_write_type(t->element, out);
        text_add(out, ">");
    }
    if (t->collective)
        text_add(out, t->optional ? "[]?" : "[]");
}

static void write_constraint(const tree_constraint *c, text *out)
{
    static const char *const begins[] = {" range [", " one of (", " matches ", " at most "};
    static const char *const ends[] = {"]", ")", "", " characters"};
    text_add(out, begins[c->kind]);
    write_operands(&c->operands, out);
    text_add(out, ends[c->kind]);
}

void lang_write_parameter(const tree_parameter *p, text *out)
{
    lang_write_name(p->name.text, out);
    if (p->type) {
        text_add(out, ": ");
        lang_write_type(p->type, out);
    }
    if (p->initial) {
        text_add(out, " = ");
        lang_write_expression(p->initial, out);
    }
    for (uint32_t i = 0; i < p->constraints.count; i++)
        write_constraint(&p->constraints.at[i], out);
}

/* ---- chains ---------------------------------------------------------------------------------- */

void lang_write_argument(const tree_argument *a, text *out)
{
    static const char *const signs[] = {" = ", " => @", " <=> @"};
    if (a->name.text) {
        lang_write_name(a->name.text, out);
        text_add(out, signs[a->kind]);
    }
    if (a->kind == ARGUMENT_VALUE)
        lang_write_expression(a->value, out);
    else
        lang_write_name(a->attribute.text, out);
}

static void write_arguments(const tree_arguments *arguments, text *out)
{
    text_add(out, "(");
    for (uint32_t i = 0; i < arguments->count; i++) {
        text_add(out, i ? ", " : "");
        lang_write_argument(&arguments->at[i], out);
    }
    text_add(out, ")");
}

static void write_label(const tree_name *name, text *out)
{
    if (!name->text)
        return;
    lang_write_name(name->text, out);
    text_add(out, ": ");
}

static void write_augmentation(const tree_augmentation *a, text *out)
{
    write_label(&a->name, out);
    lang_write_name(a->kind.text, out);
    if (a->has_parentheses)
        write_arguments(&a->arguments, out);
}

static void write_gate(const char *keyword, const tree_gate *g, text *out)
{
    text_format(out, "%s ", keyword);
    lang_write_name(g->name.text, out);
    text_add(out, ": ");
    lang_write_type(g->type, out);
    text_add(out, g->gathers ? " = *" : "");
}

static const char *separator(const char **next)
{
    const char *s = *next;
    *next = "; ";
    return s;
}

static void write_body(const tree_body *b, text *out)
{
    const char *next = " ";
    text_add(out, " {");
    for (uint32_t i = 0; i < b->inputs.count; i++) {
        text_add(out, separator(&next));
        write_gate("in", b->inputs.at[i], out);
    }
    for (uint32_t i = 0; i < b->outputs.count; i++) {
        text_add(out, separator(&next));
        write_gate("out", b->outputs.at[i], out);
    }
    for (uint32_t i = 0; i < b->parameters.count; i++) {
        text_format(out, "%sparam ", separator(&next));
        lang_write_parameter(b->parameters.at[i], out);
    }
    for (uint32_t i = 0; i < b->attributes.count; i++) {
        text_format(out, "%sattr ", separator(&next));
        lang_write_parameter(b->attributes.at[i], out);
    }
    for (uint32_t i = 0; i < b->loops.count; i++) {
        text_format(out, "%sloop ", separator(&next));
        lang_write_name(b->loops.at[i]->from.text, out);
        text_add(out, " -> ");
        lang_write_name(b->loops.at[i]->to.text, out);
    }
    for (uint32_t i = 0; i < b->augmentations.count; i++) {
        text_add(out, separator(&next));
        write_augmentation(b->augmentations.at[i], out);
    }
    text_add(out, *next == ' ' ? "}" : " }");
}

static void write_path(const tree_name *first, const tree_name *second, text *out)
{
    lang_write_name(first->text, out);
    if (second->text) {
        text_add(out, ".");
        lang_write_name(second->text, out);
    }
}

static void write_element(const tree_element *e, text *out)
{
    if (e->kind == ELEMENT_REFERENCE) {
        write_path(&e->name, &e->port, out);
        return;
    }
    write_label(&e->name, out);
    if (e->library.text)
        write_path(&e->library, &e->procedure, out);
    else
        lang_write_name(e->procedure.text, out);
    if (e->has_parentheses)
        write_arguments(&e->arguments, out);
    if (e->body)
        write_body(e->body, out);
}

void lang_write_chain(const tree_chain *c, text *out)
{
    for (uint32_t i = 0; i < c->elements.count; i++) {
        if (i)
            text_add(out, i <= c->arrows.count && c->arrows.at[i - 1].disabled ? " -/> " : " -> ");
        write_element(c->elements.at[i], out);
    }
    if (c->condition) {
        text_add(out, " if ");
        lang_write_expression(c->condition, out);
    }
}

void lang_write_example(const tree_example *e, text *out)
{
    for (uint32_t i = 0; i < e->chains.count; i++) {
        text_add(out, i ? "; " : "");
        lang_write_chain(e->chains.at[i], out);
    }
    text_add(out, " expect ");
    for (uint32_t i = 0; i < e->expectations.count; i++) {
        text_format(out, "%s%s = ", i ? ", " : "", e->expectations.at[i].name.text);
        lang_write_expression(e->expectations.at[i].value, out);
    }
}

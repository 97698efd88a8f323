/* value_print.c - typed values as source text, for dumps and messages. */
#include "evaluate.h"

#include <math.h>
#include <string.h>

/* Percent: 0.07 is 7, although 0.07 * 100 is not quite. */
static double percent_of(double share)
{
    double percent = share * 100, near = round(percent * 1e9) / 1e9;
    return near / 100 == share ? near : percent;
}

void number_print(double number, const type *t, text *out)
{
    static const char *const suffixes[] = {[PCG_LENGTH] = "m",
                                           [PCG_AREA] = "m2",
                                           [PCG_ANGLE] = "deg",
                                           [PCG_RATIO] = "%",
                                           [PCG_SECONDS] = "s"};
    text_number(out, type_is(t, PCG_RATIO) ? percent_of(number) : number);
    if (type_is_unit(t))
        text_add(out, suffixes[t->value]);
}

static void print_color(const pcg_cell *cells, text *out)
{
    unsigned bytes[4];
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned)lround(cells[i].f * 255);
    text_format(out, "#%02x%02x%02x", bytes[0], bytes[1], bytes[2]);
    if (bytes[3] != 255)
        text_format(out, "%02x", bytes[3]);
}

static void print_vector(const value *v, text *out)
{
    type_write(&v->type, out);
    for (uint32_t i = 0; i < type_components(&v->type); i++) {
        text_add(out, i ? ", " : "(");
        text_number(out, v->any.cell[i].f);
    }
    text_add(out, ")");
}

static void print_constant(const value *v, text *out)
{
    const pcg_cell *c = v->any.cell;
    if (type_is_text(&v->type))
        text_quote(out, v->string);
    else if (type_is(&v->type, PCG_BOOL))
        text_add(out, c->i ? "true" : "false");
    else if (type_is(&v->type, PCG_INT))
        text_format(out, "%lld", c->i);
    else if (type_is(&v->type, PCG_ENUM))
        text_add(out, c->i >= 0 && c->i < v->type.enumeration->count
                          ? v->type.enumeration->names[c->i]
                          : "?");
    else if (type_is(&v->type, PCG_COLOR))
        print_color(c, out);
    else if (type_is_vector(&v->type))
        print_vector(v, out);
    else if (type_is(&v->type, PCG_LIST))
        text_add(out, "[]");
    else
        number_print(c->f, &v->type, out);
}

static void print_list(const value *v, uint32_t first, const char *open, const char *close,
                       text *out)
{
    text_add(out, open);
    for (uint32_t i = first; i < v->count; i++) {
        text_add(out, i > first ? ", " : "");
        value_print(v->operands[i], out);
    }
    text_add(out, close);
}

static void print_operation(const value *v, text *out)
{
    text_add(out, "(");
    if (v->kind == VALUE_UNARY)
        text_add(out, operator_text(v->op));
    value_print(v->operands[0], out);
    if (v->kind == VALUE_BINARY) {
        text_format(out, " %s ", operator_text(v->op));
        value_print(v->operands[1], out);
    } else if (v->kind == VALUE_CHOICE) {
        text_add(out, " ? ");
        value_print(v->operands[1], out);
        text_add(out, " : ");
        value_print(v->operands[2], out);
    }
    text_add(out, ")");
}

static void print_component(const value *v, text *out)
{
    value_print(v->operands[0], out);
    text_format(out, ".%c",
                (type_is(&v->operands[0]->type, PCG_COLOR) ? "rgba" : "xyzw")[v->component]);
}

void value_print(const value *v, text *out)
{
    switch (v->kind) {
    case VALUE_ERROR:
        text_add(out, "?");
        break;
    case VALUE_CONSTANT:
        print_constant(v, out);
        break;
    case VALUE_LIST:
        print_list(v, 0, "[", "]", out);
        break;
    case VALUE_PARAMETER:
        text_add(out, v->parameter->name);
        break;
    case VALUE_CONST:
        text_add(out, v->constant->name);
        break;
    case VALUE_ATTRIBUTE:
        text_format(out, "%s@%s", v->port->name, v->attribute->name);
        break;
    case VALUE_ENTITY:
        text_add(out, v->port->name);
        break;
    case VALUE_COMPONENT:
        print_component(v, out);
        break;
    case VALUE_UNARY:
    case VALUE_BINARY:
    case VALUE_CHOICE:
        print_operation(v, out);
        break;
    case VALUE_CALL:
        text_add(out, v->function->name);
        print_list(v, 0, "(", ")", out);
        break;
    case VALUE_CONVERT:
        type_write(&v->type, out);
        print_list(v, 0, "(", ")", out);
        break;
    case VALUE_SLOT:
        text_format(out, "@%s", v->attribute->name);
        break;
    }
}

const char *value_text(arena *a, const value *v)
{
    text out = {.arena = a};
    value_print(v, &out);
    return out.at;
}

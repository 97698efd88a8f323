/* types.c - types of values and entities: equality, descent, units, and how they are written. */
#include "types.h"

#include <string.h>

const type type_error = {.kind = TYPE_ERROR};
const type type_bool = {.kind = TYPE_VALUE, .value = PCG_BOOL};
const type type_int = {.kind = TYPE_VALUE, .value = PCG_INT};
const type type_float = {.kind = TYPE_VALUE, .value = PCG_FLOAT};
const type type_string = {.kind = TYPE_VALUE, .value = PCG_STRING};
const type type_any = {.kind = TYPE_ANY};

/* By kind; NULL where the name is not of the type alone. */
static const char *const kind_names[] = {
    [PCG_BOOL] = "bool",     [PCG_INT] = "int",        [PCG_FLOAT] = "float",
    [PCG_STRING] = "string", [PCG_VEC2] = "vec2",      [PCG_VEC3] = "vec3",
    [PCG_VEC4] = "vec4",     [PCG_COLOR] = "color",    [PCG_QUATERNION] = "quaternion",
    [PCG_PATH] = "path",     [PCG_LIST] = NULL,        [PCG_ENUM] = NULL,
    [PCG_LENGTH] = "length", [PCG_AREA] = "area",      [PCG_ANGLE] = "angle",
    [PCG_RATIO] = "ratio",   [PCG_SECONDS] = "seconds"};

type type_of_kind(int kind)
{
    return (type){.kind = TYPE_VALUE, .value = kind};
}

type type_of_entity(const entity_type *e)
{
    return (type){.kind = TYPE_ENTITY, .entity = e};
}

bool type_of_word(const char *word, type *t)
{
    if (!strcmp(word, "attribute")) {
        *t = (type){.kind = TYPE_ATTRIBUTE};
        return true;
    }
    if (!strcmp(word, "any")) {
        *t = type_any;
        return true;
    }
    for (size_t i = 0; i < COUNT_OF(kind_names); i++)
        if (kind_names[i] && !strcmp(word, kind_names[i])) {
            *t = type_of_kind((int)i);
            return true;
        }
    return false;
}

bool type_equal(const type *a, const type *b)
{
    while (a->kind == TYPE_VALUE && b->kind == TYPE_VALUE && a->value == PCG_LIST &&
           b->value == PCG_LIST) {
        a = a->element;
        b = b->element;
    }
    if (a->kind != b->kind)
        return false;
    switch (a->kind) {
    case TYPE_VALUE:
        return a->value == b->value && (a->value != PCG_ENUM || a->enumeration == b->enumeration);
    case TYPE_ENTITY:
        return a->entity == b->entity;
    case TYPE_VARIABLE:
        return a->variable == b->variable;
    case TYPE_ERROR:
    case TYPE_ATTRIBUTE:
    case TYPE_ANY:
        return true;
    }
    return false;
}

bool type_is(const type *t, int kind)
{
    return t->kind == TYPE_VALUE && t->value == kind;
}

bool type_is_unit(const type *t)
{
    return t->kind == TYPE_VALUE && t->value >= PCG_LENGTH && t->value <= PCG_SECONDS;
}

bool type_is_plain(const type *t)
{
    return type_is(t, PCG_INT) || type_is(t, PCG_FLOAT);
}

bool type_is_number(const type *t)
{
    return type_is_plain(t) || type_is_unit(t);
}

bool type_is_text(const type *t)
{
    return type_is(t, PCG_STRING) || type_is(t, PCG_PATH);
}

bool type_is_vector(const type *t)
{
    return type_components(t) != 0;
}

bool type_is_error(const type *t)
{
    return t->kind == TYPE_ERROR;
}

uint32_t type_cells(const type *t)
{
    uint32_t components = type_components(t);
    return components ? components : 1;
}

uint32_t type_components(const type *t)
{
    if (t->kind != TYPE_VALUE)
        return 0;
    switch (t->value) {
    case PCG_VEC2:
        return 2;
    case PCG_VEC3:
        return 3;
    case PCG_VEC4:
    case PCG_COLOR:
    case PCG_QUATERNION:
        return 4;
    default:
        return 0;
    }
}

/* ---- entities ------------------------------------------------------------------------------ */

bool entity_derives(const entity_type *a, const entity_type *b)
{
    for (; a; a = a->parent)
        if (a == b)
            return true;
    return false;
}

const entity_type *entity_common(const entity_type *a, const entity_type *b)
{
    while (a->parent && !entity_derives(b, a))
        a = a->parent;
    return a;
}

/* ---- units --------------------------------------------------------------------------------- */

/* Has no dimension: a plain number or a ratio. */
static bool is_scalar(const type *t)
{
    return type_is_plain(t) || type_is(t, PCG_RATIO);
}

/* Of two scalars: what both become. A ratio prevails, then a float. */
static type wider(const type *a, const type *b)
{
    if (type_is(a, PCG_RATIO) || type_is(b, PCG_RATIO))
        return type_of_kind(PCG_RATIO);
    return type_is(a, PCG_INT) && type_is(b, PCG_INT) ? type_int : type_float;
}

/* One of each, in any order. */
static bool are(const type *a, const type *b, int one, int other)
{
    return (type_is(a, one) && type_is(b, other)) || (type_is(a, other) && type_is(b, one));
}

/* There is no unit for a volume: cubic metres are a plain number. */
static bool multiply(const type *a, const type *b, type *result)
{
    if (is_scalar(a) || is_scalar(b))
        *result = is_scalar(a) && is_scalar(b) ? wider(a, b) : is_scalar(a) ? *b : *a;
    else if (are(a, b, PCG_LENGTH, PCG_LENGTH))
        *result = type_of_kind(PCG_AREA);
    else if (are(a, b, PCG_LENGTH, PCG_AREA))
        *result = type_float;
    else
        return false;
    return true;
}

static bool divide(const type *a, const type *b, type *result)
{
    if (type_is_unit(a) && type_equal(a, b))
        *result = type_float;
    else if (is_scalar(b))
        *result = is_scalar(a) ? wider(a, b) : *a;
    else if (type_is(a, PCG_AREA) && type_is(b, PCG_LENGTH))
        *result = *b;
    else
        return false;
    return true;
}

bool unit_combine(tree_operator op, const type *a, const type *b, type *result)
{
    if (!type_is_number(a) || !type_is_number(b))
        return false;
    if (op == OP_MULTIPLY)
        return multiply(a, b, result);
    if (op == OP_DIVIDE)
        return divide(a, b, result);
    if (op == OP_REMAINDER) {
        *result = type_int;
        return type_is(a, PCG_INT) && type_is(b, PCG_INT);
    }
    *result = is_scalar(a) && is_scalar(b) ? wider(a, b) : *a;
    return (is_scalar(a) && is_scalar(b)) || type_equal(a, b);
}

/* ---- writing ------------------------------------------------------------------------------- */

static const char *atom_name(const type *t)
{
    switch (t->kind) {
    case TYPE_VALUE:
        return t->value == PCG_ENUM ? t->enumeration->name : kind_names[t->value];
    case TYPE_ENTITY:
        return t->entity->name;
    case TYPE_ATTRIBUTE:
        return "attribute";
    case TYPE_ANY:
        return "any";
    case TYPE_VARIABLE:
        return t->entity ? t->entity->name : kind_names[t->value];
    case TYPE_ERROR:
        break;
    }
    return "?";
}

void type_write(const type *t, text *out)
{
    uint32_t depth = 0;
    for (; type_is(t, PCG_LIST); t = t->element, depth++)
        text_add(out, "list<");
    text_add(out, atom_name(t));
    while (depth--)
        text_add(out, ">");
}

const char *type_text(arena *a, const type *t)
{
    text out = {.arena = a};
    type_write(t, &out);
    return out.at;
}

const char *operator_text(tree_operator op)
{
    static const char *const names[] = {[OP_NEGATE] = "-",      [OP_NOT] = "!",
                                        [OP_COMPLEMENT] = "~",  [OP_MULTIPLY] = "*",
                                        [OP_DIVIDE] = "/",      [OP_REMAINDER] = "%",
                                        [OP_ADD] = "+",         [OP_SUBTRACT] = "-",
                                        [OP_SHIFT_LEFT] = "<<", [OP_SHIFT_RIGHT] = ">>",
                                        [OP_LESS] = "<",        [OP_LESS_EQUAL] = "<=",
                                        [OP_GREATER] = ">",     [OP_GREATER_EQUAL] = ">=",
                                        [OP_EQUAL] = "==",      [OP_NOT_EQUAL] = "!=",
                                        [OP_BIT_AND] = "&",     [OP_BIT_XOR] = "^",
                                        [OP_BIT_OR] = "|",      [OP_AND] = "&&",
                                        [OP_OR] = "||"};
    return names[op];
}

/* emit_type.c - the language's types and literals in C. */
#include "emit.h"

#include <math.h>
#include <string.h>

/* ---- types ----------------------------------------------------------------------------------- */

static const struct kind_row {
    const char *constant, *c;
} kinds[] = {
    [PCG_BOOL] = {"PCG_BOOL", "int "},
    [PCG_INT] = {"PCG_INT", "pcg_int "},
    [PCG_FLOAT] = {"PCG_FLOAT", "double "},
    [PCG_STRING] = {"PCG_STRING", "const char *"},
    [PCG_VEC2] = {"PCG_VEC2", "pcg_vec2 "},
    [PCG_VEC3] = {"PCG_VEC3", "pcg_vec3 "},
    [PCG_VEC4] = {"PCG_VEC4", "pcg_vec4 "},
    [PCG_COLOR] = {"PCG_COLOR", "pcg_color "},
    [PCG_QUATERNION] = {"PCG_QUATERNION", "pcg_vec4 "},
    [PCG_PATH] = {"PCG_PATH", "const char *"},
    [PCG_LIST] = {"PCG_LIST", "const pcg_list *"},
    [PCG_ENUM] = {"PCG_ENUM", "int "},
    [PCG_LENGTH] = {"PCG_LENGTH", "double "},
    [PCG_AREA] = {"PCG_AREA", "double "},
    [PCG_ANGLE] = {"PCG_ANGLE", "double "},
    [PCG_RATIO] = {"PCG_RATIO", "double "},
    [PCG_SECONDS] = {"PCG_SECONDS", "double "},
};

const char *emit_c_type(emitter *e, const type *t)
{
    (void)e;
    switch (t->kind) {
    case TYPE_VALUE:
        return kinds[t->value].c;
    case TYPE_ATTRIBUTE:
        return "pcg_slot ";
    case TYPE_ANY:
        return "pcg_any ";
    default:
        return "pcg_entity *";
    }
}

const char *emit_storage_type(emitter *e, const type *t)
{
    return type_is(t, PCG_BOOL) || type_is(t, PCG_ENUM) ? "pcg_int " : emit_c_type(e, t);
}

bool emit_is_composite(const type *t)
{
    return type_components(t) > 0 || t->kind == TYPE_ANY || t->kind == TYPE_ATTRIBUTE;
}

const char *emit_component(const type *t, uint32_t i)
{
    static const char *const vector[] = {"x", "y", "z", "w"}, *const color[] = {"r", "g", "b", "a"};
    return (type_is(t, PCG_COLOR) ? color : vector)[i];
}

const char *emit_cell_member(const type *t)
{
    switch (t->value) {
    case PCG_BOOL:
    case PCG_INT:
    case PCG_ENUM:
        return "i";
    case PCG_STRING:
    case PCG_PATH:
        return "s";
    case PCG_LIST:
        return "list";
    default:
        return "f";
    }
}

const char *emit_kind(const type *t)
{
    return kinds[t->value].constant;
}

bool emit_is_shape(const type *t, const procedure *of)
{
    const entity_type *entity = t->entity;
    if (t->kind == TYPE_VARIABLE && of) {
        entity = of->bounds[t->variable];
    }
    return entity && strcmp(entity->name, "Shape") == 0;
}

bool emit_is_part(const type *t)
{
    static const char *const parts[] = {"Face", "Edge", "Vertex"};
    for (uint32_t i = 0; t->entity && i < COUNT_OF(parts); i++) {
        if (strcmp(t->entity->name, parts[i]) == 0) {
            return true;
        }
    }
    return false;
}

/* ---- literals -------------------------------------------------------------------------------- */

const char *emit_float(emitter *e, double number)
{
    if (isnan(number)) {
        return "PCG_NAN";
    }
    if (isinf(number)) {
        return number > 0 ? "PCG_INFINITY" : "-PCG_INFINITY";
    }
    text out = {.arena = e->arena};
    text_number(&out, number);
    if (!strpbrk(out.at, ".e")) {
        text_add(&out, ".0");
    }
    return out.at;
}

const char *emit_int(emitter *e, pcg_int number)
{
    if (number == INT64_MIN) {
        return "(-9223372036854775807LL - 1)";
    }
    return emit_name(e, number > INT32_MAX || number < INT32_MIN ? "%lldLL" : "%lld", number);
}

/* Octal escapes take up to three digits, so three are written; a question mark may begin a
 * trigraph. */
static void add_character(text *out, unsigned char c)
{
    const char byte = (char)c;
    if (c == '"' || c == '\\' || c == '?') {
        text_add(out, "\\");
        text_add_bytes(out, &byte, 1);
    } else if (c == '\n') {
        text_add(out, "\\n");
    } else if (c < ' ' || c == 0x7F) {
        text_format(out, "\\%03o", (unsigned)c);
    } else {
        text_add_bytes(out, &byte, 1);
    }
}

const char *emit_string(emitter *e, const char *s)
{
    if (!s) {
        return "0";
    }
    text out = {.arena = e->arena};
    text_add(&out, "\"");
    for (; *s; s++) {
        add_character(&out, (unsigned char)*s);
    }
    text_add(&out, "\"");
    return out.at;
}

const char *emit_enumerators(emitter *e, const type *t)
{
    const type *of = type_is(t, PCG_LIST) ? t->element : t;
    if (!type_is(of, PCG_ENUM)) {
        return "0";
    }
    text names = {.arena = e->arena};
    for (uint32_t i = 0; i < of->enumeration->count; i++) {
        text_format(&names, "%s%s", i ? "\n" : "", of->enumeration->names[i]);
    }
    return emit_string(e, names.at);
}

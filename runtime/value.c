/* value.c - values as text and as JSON. */
#include "value.h"

#include <math.h>
#include <string.h>

/* By kind: its name, and the unit that stands behind its numbers. */
static const struct kind_row {
    const char *name, *unit;
} kinds[] = {
    [PCG_BOOL] = {"bool", ""},
    [PCG_INT] = {"int", ""},
    [PCG_FLOAT] = {"float", ""},
    [PCG_STRING] = {"string", ""},
    [PCG_VEC2] = {"vec2", ""},
    [PCG_VEC3] = {"vec3", ""},
    [PCG_VEC4] = {"vec4", ""},
    [PCG_COLOR] = {"color", ""},
    [PCG_QUATERNION] = {"quaternion", ""},
    [PCG_PATH] = {"path", ""},
    [PCG_LIST] = {"list", ""},
    [PCG_ENUM] = {"enumeration", ""},
    [PCG_LENGTH] = {"length", "m"},
    [PCG_AREA] = {"area", "m2"},
    [PCG_ANGLE] = {"angle", "deg"},
    [PCG_RATIO] = {"ratio", ""},
    [PCG_SECONDS] = {"seconds", "s"},
};

static const struct kind_row *row_of(int kind)
{
    static const struct kind_row unknown = {"unknown", ""};
    return kind >= 0 && (size_t)kind < COUNT_OF(kinds) ? &kinds[kind] : &unknown;
}

const char *value_kind_name(int kind)
{
    return row_of(kind)->name;
}

/* ---- numbers -------------------------------------------------------------------------------- */

void value_number(char *out, double value)
{
    arena none = {.limit = 1}; /* never asked: every number is shorter than the room for it */
    text t = {.arena = &none, .at = out, .capacity = VALUE_NUMBER_BYTES};
    out[0] = '\0';
    text_number(&t, value);
}

void value_quantity(char *out, int kind, double value)
{
    const char *unit = row_of(kind)->unit;
    value_number(out, value);
    size_t length = strlen(out), more = strlen(unit);
    if (length + more < VALUE_NUMBER_BYTES)
        memcpy(out + length, unit, more + 1);
}

static unsigned channel(double level)
{
    if (!(level > 0))
        return 0;
    return level >= 1 ? 255 : (unsigned)(level * 255 + 0.5);
}

static void write_color(text *out, const pcg_cell *at)
{
    text_format(out, "#%02x%02x%02x", channel(at[0].f), channel(at[1].f), channel(at[2].f));
    if (channel(at[3].f) != 255)
        text_format(out, "%02x", channel(at[3].f));
}

/* ---- enumerations --------------------------------------------------------------------------- */

const char *value_enumerator(const char *enumerators, pcg_int number, size_t *length)
{
    const char *at = enumerators;
    if (!at || number < 0)
        return NULL;
    for (; number; number--) {
        at = strchr(at, '\n');
        if (!at)
            return NULL;
        at++;
    }
    *length = strcspn(at, "\n");
    return at;
}

pcg_int value_enumerator_number(const char *enumerators, const char *name, size_t length)
{
    size_t found;
    const char *at;
    for (pcg_int i = 0; (at = value_enumerator(enumerators, i, &found)); i++)
        if (found == length && !memcmp(at, name, length))
            return i;
    return -1;
}

static void write_enumerator(text *out, const value_type *t, pcg_int number)
{
    size_t length;
    const char *at = value_enumerator(t->enumerators, number, &length);
    if (at)
        text_add_bytes(out, at, length);
    else
        text_format(out, "%lld", number);
}

/* ---- values --------------------------------------------------------------------------------- */

static void write_vector(text *out, int kind, const pcg_cell *at)
{
    char number[VALUE_NUMBER_BYTES];
    text_add(out, value_kind_name(kind));
    for (pcg_u32 i = 0; i < value_width(kind); i++) {
        value_number(number, at[i].f);
        text_format(out, "%s%s", i ? ", " : "(", number);
    }
    text_add(out, ")");
}

static value_type element_type(const value_type *list)
{
    value_type t = {.kind = list->element, .element = PCG_INT, .enumerators = list->enumerators};
    return t;
}

static void write_list(text *out, const value_type *t, const pcg_list *list)
{
    value_type element = element_type(t);
    bool quoted = element.kind == PCG_STRING || element.kind == PCG_PATH;
    text_add(out, "[");
    for (pcg_u32 i = 0; list && i < list->count; i++) {
        const pcg_cell *at = list->at + (size_t)i * list->width;
        text_add(out, i ? ", " : "");
        if (quoted)
            text_quote(out, at->s);
        else
            value_write(out, &element, at);
    }
    text_add(out, "]");
}

void value_write(text *out, const value_type *t, const pcg_cell *at)
{
    char number[VALUE_NUMBER_BYTES];
    switch (t->kind) {
    case PCG_BOOL:
        text_add(out, at->i ? "true" : "false");
        break;
    case PCG_INT:
        text_format(out, "%lld", at->i);
        break;
    case PCG_STRING:
    case PCG_PATH:
        text_add(out, at->s ? at->s : "");
        break;
    case PCG_VEC2:
    case PCG_VEC3:
    case PCG_VEC4:
    case PCG_QUATERNION:
        write_vector(out, t->kind, at);
        break;
    case PCG_COLOR:
        write_color(out, at);
        break;
    case PCG_LIST:
        write_list(out, t, at->list);
        break;
    case PCG_ENUM:
        write_enumerator(out, t, at->i);
        break;
    default:
        value_quantity(number, t->kind, at->f);
        text_add(out, number);
        break;
    }
}

/* ---- JSON ----------------------------------------------------------------------------------- */

static void write_json_number(text *out, double value)
{
    char number[VALUE_NUMBER_BYTES];
    value_number(number, value);
    text_add(out, isfinite(value) ? number : "null");
}

static void write_json_vector(text *out, const pcg_cell *at, pcg_u32 count)
{
    for (pcg_u32 i = 0; i < count; i++) {
        text_add(out, i ? ", " : "[");
        write_json_number(out, at[i].f);
    }
    text_add(out, "]");
}

static void write_json_list(text *out, const value_type *t, const pcg_list *list)
{
    value_type element = element_type(t);
    text_add(out, "[");
    for (pcg_u32 i = 0; list && i < list->count; i++) {
        text_add(out, i ? ", " : "");
        value_write_json(out, &element, list->at + (size_t)i * list->width);
    }
    text_add(out, "]");
}

void value_write_json(text *out, const value_type *t, const pcg_cell *at)
{
    switch (t->kind) {
    case PCG_BOOL:
    case PCG_INT:
        value_write(out, t, at);
        break;
    case PCG_STRING:
    case PCG_PATH:
        text_quote(out, at->s ? at->s : "");
        break;
    case PCG_ENUM:
    case PCG_COLOR:
        text_add(out, "\"");
        value_write(out, t, at);
        text_add(out, "\"");
        break;
    case PCG_LIST:
        write_json_list(out, t, at->list);
        break;
    default:
        if (value_width(t->kind) > 1)
            write_json_vector(out, at, value_width(t->kind));
        else
            write_json_number(out, at->f);
        break;
    }
}

bool value_equal(const value_type *t, const pcg_cell *a, const pcg_cell *b)
{
    if (t->kind == PCG_STRING || t->kind == PCG_PATH)
        return !strcmp(a->s, b->s);
    if (t->kind == PCG_LIST) {
        value_type element = element_type(t);
        if (a->list->count != b->list->count)
            return false;
        for (pcg_u32 i = 0; i < a->list->count; i++)
            if (!value_equal(&element, a->list->at + (size_t)i * a->list->width,
                             b->list->at + (size_t)i * b->list->width))
                return false;
        return true;
    }
    if (!value_has_floats(t->kind))
        return a->i == b->i;
    for (pcg_u32 i = 0; i < value_width(t->kind); i++)
        if (a[i].f < b[i].f || a[i].f > b[i].f)
            return false;
    return true;
}

bool value_is_utf8(const char *s)
{
    const unsigned char *u = (const unsigned char *)s;
    while (*u) {
        unsigned length = *u < 0x80   ? 1
                          : *u < 0xC2 ? 0
                          : *u < 0xE0 ? 2
                          : *u < 0xF0 ? 3
                          : *u < 0xF5 ? 4
                                      : 0;
        if (!length || (*u == 0xE0 && u[1] < 0xA0) || (*u == 0xED && u[1] > 0x9F) ||
            (*u == 0xF0 && u[1] < 0x90) || (*u == 0xF4 && u[1] > 0x8F))
            return false;
        for (unsigned i = 1; i < length; i++)
            if ((u[i] & 0xC0) != 0x80)
                return false;
        u += length;
    }
    return true;
}

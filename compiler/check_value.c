/* check_value.c - expressions: literals, components, conversions; and what all typed values have in
 * common. */
#include "check.h"

#include <string.h>

/* ---- making values ------------------------------------------------------------------------- */

value *value_new(const scope *s, value_kind kind, type t, span place)
{
    value *v = ARENA_NEW(s->k->arena, value);
    v->kind = kind;
    v->type = t;
    v->span = place;
    if (t.kind == TYPE_VALUE)
        v->any.kind = t.value;
    return v;
}

value *value_error(const scope *s, span place)
{
    return value_new(s, VALUE_ERROR, type_error, place);
}

bool value_is_error(const value *v)
{
    return type_is_error(&v->type);
}

value *value_finish(const scope *s, value *v, uint32_t count, value *const *operands)
{
    value folded;
    v->operands = ARENA_ARRAY(s->k->arena, value *, count);
    v->count = count;
    for (uint32_t i = 0; i < count; i++) {
        v->operands[i] = operands[i];
        v->reads_entity |= operands[i]->reads_entity;
        v->reads_chance |= operands[i]->reads_chance;
    }
    if (value_evaluate(s->k->arena, v, &folded))
        *v = folded;
    return v;
}

value *value_zero(const scope *s, const type *t, span place)
{
    value *v = value_new(s, type_is(t, PCG_LIST) ? VALUE_LIST : VALUE_CONSTANT, *t, place);
    if (type_is_text(t))
        v->any.cell[0].s = v->string = "";
    if (type_is(t, PCG_COLOR) || type_is(t, PCG_QUATERNION))
        v->any.cell[3].f = 1;
    return v;
}

/* ---- literals ------------------------------------------------------------------------------ */

static value *check_float(scope *s, const tree_expression *e)
{
    static const int kinds[] = {
        [UNIT_NONE] = PCG_FLOAT,   [UNIT_METRE] = PCG_LENGTH,  [UNIT_SQUARE_METRE] = PCG_AREA,
        [UNIT_DEGREE] = PCG_ANGLE, [UNIT_PERCENT] = PCG_RATIO, [UNIT_SECOND] = PCG_SECONDS};
    value *v = value_new(s, VALUE_CONSTANT, type_of_kind(kinds[e->unit]), e->span);
    v->any.cell[0].f = e->number;
    return v;
}

static value *check_integer(scope *s, const tree_expression *e, type t, int64_t number)
{
    value *v = value_new(s, VALUE_CONSTANT, t, e->span);
    v->any.cell[0].i = number;
    return v;
}

static value *check_string(scope *s, const tree_expression *e)
{
    value *v = value_new(s, VALUE_CONSTANT, type_string, e->span);
    v->any.cell[0].s = v->string = e->string;
    return v;
}

static value *check_color(scope *s, const tree_expression *e)
{
    value *v = value_new(s, VALUE_CONSTANT, type_of_kind(PCG_COLOR), e->span);
    for (int i = 0; i < 4; i++)
        v->any.cell[i].f = (double)(e->color >> (24 - 8 * i) & 0xFF) / 255;
    return v;
}

/* ---- components ---------------------------------------------------------------------------- */

/* The number of a component; -1 where the type has none of that name. */
static int component_number(const type *t, const char *name)
{
    const char *letters = type_is(t, PCG_COLOR) ? "rgba" : "xyzw";
    const char *found = name[0] && !name[1] ? strchr(letters, name[0]) : NULL;
    return found && found - letters < (int)type_components(t) ? (int)(found - letters) : -1;
}

static value *check_member(scope *s, const tree_expression *e)
{
    value *of = check_value(s, e->operands.at[0], NULL);
    if (value_is_error(of))
        return value_error(s, e->span);
    int number = component_number(&of->type, e->name.text);
    if (number < 0) {
        diagnostic *d = diagnose(s->k->d, DIAG_E0206, e->name.span,
                                 type_text(s->k->arena, &of->type), e->name.text);
        const pcg_library *found[2];
        if (of->kind == VALUE_ENTITY &&
            library_count(s->k->p, NULL, e->name.text, ENTRY_FUNCTION, found))
            d->help = arena_format(s->k->arena, "write %s(%s)", e->name.text, of->port->name);
        return value_error(s, e->span);
    }
    value *v = value_new(s, VALUE_COMPONENT, type_float, e->span);
    v->component = (uint32_t)number;
    return value_finish(s, v, 1, &of);
}

/* ---- expressions --------------------------------------------------------------------------- */

value *check_value(scope *s, const tree_expression *e, const type *hint)
{
    switch (e->kind) {
    case EXPR_ERROR:
        break;
    case EXPR_BOOL:
        return check_integer(s, e, type_bool, e->boolean);
    case EXPR_INT:
        return check_integer(s, e, type_int, e->integer);
    case EXPR_FLOAT:
        return check_float(s, e);
    case EXPR_STRING:
        return check_string(s, e);
    case EXPR_COLOR:
        return check_color(s, e);
    case EXPR_LIST:
        return hint && type_is_vector(hint) ? check_vector(s, e, hint) : check_list(s, e, hint);
    case EXPR_NAME:
        return check_name(s, e, hint);
    case EXPR_ATTRIBUTE:
        return check_attribute(s, e);
    case EXPR_MEMBER:
        return check_member(s, e);
    case EXPR_UNARY:
        return check_unary(s, e, hint);
    case EXPR_BINARY:
        return check_binary(s, e, hint);
    case EXPR_CHOICE:
        return check_choice(s, e, hint);
    case EXPR_CALL:
        return check_call(s, e);
    }
    return value_error(s, e->span);
}

bool require_value(scope *s, const value *v, const char *expected)
{
    if (type_is(&v->type, PCG_LIST) && type_is_error(v->type.element)) {
        diagnose(s->k->d, DIAG_E0218, v->span);
        return false;
    }
    if (v->type.kind == TYPE_VALUE || value_is_error(v))
        return true;
    diagnose(s->k->d, DIAG_E0213, v->span, v->kind == VALUE_ENTITY ? v->port->name : "?", expected);
    return false;
}

static value *report_bare_path(scope *s, const tree_expression *e)
{
    const char *written =
        arena_copy(s->k->arena, e->span.source->text + e->span.from, e->span.to - e->span.from);
    diagnose(s->k->d, DIAG_E0220, e->span, written)->help =
        arena_format(s->k->arena, "write \"%s\"", written);
    return value_error(s, e->span);
}

value *check_value_as(scope *s, const tree_expression *e, const type *to, const char *taker)
{
    if (to->kind == TYPE_ATTRIBUTE)
        return check_slot(s, e, taker);
    if (type_is(to, PCG_PATH) && is_bare_path(s, e))
        return report_bare_path(s, e);
    value *v = check_value(s, e, to->kind == TYPE_VALUE ? to : NULL);
    if (value_is_error(v) || type_is_error(to))
        return value_error(s, e->span);
    if (to->kind == TYPE_ANY)
        return require_value(s, v, "a value") ? v : value_error(s, e->span);
    value *converted = value_convert(s->k, v, to);
    return converted ? converted : report_mismatch(s, v, to, taker);
}

/* ---- conversions --------------------------------------------------------------------------- */

static uint32_t descent_cost(const entity_type *from, const entity_type *to)
{
    uint32_t steps = 0;
    for (; from; from = from->parent, steps++)
        if (from == to)
            return steps;
    return CONVERT_NEVER;
}

static uint32_t list_cost(const value *v, const type *to)
{
    uint32_t cost = 0;
    if (v->kind != VALUE_LIST || !type_is(to, PCG_LIST))
        return CONVERT_NEVER;
    for (uint32_t i = 0; i < v->count && cost < CONVERT_NEVER; i++)
        cost += conversion_cost(v->operands[i], to->element);
    return cost < CONVERT_NEVER ? cost : CONVERT_NEVER;
}

static uint32_t value_cost(const value *v, const type *to)
{
    const type *from = &v->type;
    if (type_is(from, PCG_INT) && type_is(to, PCG_FLOAT))
        return 1;
    if (type_is_text(from) && type_is_text(to))
        return 1;
    if (type_is_plain(from) && type_is_unit(to))
        return type_is(from, PCG_INT) ? 3 : 2;
    if (type_is(from, PCG_LIST) && (type_is(to, PCG_LIST) || type_is_error(from->element)))
        return list_cost(v, to);
    return type_is(to, PCG_STRING) ? 16 : CONVERT_NEVER;
}

uint32_t conversion_cost(const value *v, const type *to)
{
    const type *from = &v->type;
    if (type_is_error(from) || type_is_error(to))
        return 0;
    if (from->kind == TYPE_ENTITY && to->kind == TYPE_ENTITY)
        return descent_cost(from->entity, to->entity);
    if (from->kind != TYPE_VALUE)
        return CONVERT_NEVER;
    if (to->kind == TYPE_ANY)
        return 8;
    if (to->kind != TYPE_VALUE)
        return CONVERT_NEVER;
    return type_equal(from, to) ? 0 : value_cost(v, to);
}

static value *convert_list(const scope *s, value *v, const type *to)
{
    value *list = value_new(s, VALUE_LIST, *to, v->span);
    value **elements = ARENA_ARRAY(s->k->arena, value *, v->count);
    for (uint32_t i = 0; i < v->count; i++)
        elements[i] = value_convert(s->k, v->operands[i], to->element);
    return value_finish(s, list, v->count, elements);
}

/* A string that is written where a path is wanted; `converted` becomes a copy of it. */
static void convert_to_path(checker *k, value *converted, const value *v)
{
    if (v->kind == VALUE_CONSTANT)
        converted->any.cell[0].s = converted->string = path_from_main(k, v->span.source, v->string);
    if (v->kind != VALUE_CHOICE)
        return;
    converted->operands = ARENA_ARRAY(k->arena, value *, v->count);
    for (uint32_t i = 0; i < v->count; i++)
        converted->operands[i] =
            i ? value_convert(k, v->operands[i], &converted->type) : v->operands[i];
}

value *value_convert(checker *k, value *v, const type *to)
{
    scope s = {.k = k};
    if (conversion_cost(v, to) >= CONVERT_NEVER)
        return NULL;
    if (type_is_error(to) || value_is_error(v) || to->kind != TYPE_VALUE ||
        type_equal(&v->type, to))
        return v;
    if (type_is(to, PCG_LIST))
        return convert_list(&s, v, to);
    /* A float is a number of any unit, and a path a string, as they are. */
    bool same_storage = (type_is_text(&v->type) && type_is_text(to)) ||
                        (type_is(&v->type, PCG_FLOAT) && type_is_unit(to));
    value *converted = value_new(&s, VALUE_CONVERT, *to, v->span);
    if (!same_storage)
        return value_finish(&s, converted, 1, &v);
    *converted = *v;
    converted->type = *to;
    converted->any.kind = to->value;
    if (type_is(to, PCG_PATH) && type_is(&v->type, PCG_STRING))
        convert_to_path(k, converted, v);
    return converted;
}

static const char *suggest_conversion(scope *s, const value *v, const type *to)
{
    text out = {.arena = s->k->arena};
    if (type_is_unit(&v->type) && type_is_plain(to)) {
        text_add(&out, "divide by ");
        number_print(1, &v->type, &out);
        text_add(&out, " to get a plain number");
    } else if (type_is(&v->type, PCG_FLOAT) && type_is(to, PCG_INT)) {
        text_add(&out, "round(), floor() and ceil() make whole numbers");
    } else if (type_is(&v->type, PCG_INT) && type_is(to, PCG_BOOL)) {
        text_add(&out, "compare it: … != 0");
    } else if (type_is(&v->type, PCG_STRING) && type_is(to, PCG_COLOR)) {
        const char *color = v->kind == VALUE_CONSTANT ? hint_color(s->k, v->string) : NULL;
        text_add(&out, color ? color : "a color is written #rrggbb, without quotes");
    }
    return out.at;
}

value *report_mismatch(scope *s, const value *v, const type *to, const char *taker)
{
    if (!value_is_error(v) && !type_is_error(to))
        diagnose(s->k->d, DIAG_E0201, v->span, type_text(s->k->arena, &v->type), taker,
                 type_text(s->k->arena, to))
            ->help = suggest_conversion(s, v, to);
    return value_error(s, v->span);
}

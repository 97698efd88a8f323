/* check_operator.c - operators, choices and lists. */
#include "check.h"

#include <string.h>

/* ---- one operand --------------------------------------------------------------------------- */

static bool takes_operand(tree_operator op, const type *t)
{
    if (op == OP_NEGATE)
        return type_is_number(t) || (type_is_vector(t) && !type_is(t, PCG_COLOR));
    return type_is(t, op == OP_NOT ? PCG_BOOL : PCG_INT);
}

value *check_unary(scope *s, const tree_expression *e, const type *hint)
{
    value *x = check_value(s, e->operands.at[0], hint);
    if (value_is_error(x))
        return value_error(s, e->span);
    if (!takes_operand(e->op, &x->type)) {
        diagnostic *d = diagnose(s->k->d, DIAG_E0203, e->span, operator_text(e->op),
                                 type_text(s->k->arena, &x->type));
        if (e->op == OP_NOT && type_is(&x->type, PCG_INT))
            d->help = "compare it: … == 0";
        return value_error(s, e->span);
    }
    value *v = value_new(s, VALUE_UNARY, x->type, e->span);
    v->op = e->op;
    return value_finish(s, v, 1, &x);
}

/* ---- two operands -------------------------------------------------------------------------- */

static bool is_comparison(tree_operator op)
{
    return op >= OP_LESS && op <= OP_NOT_EQUAL;
}

static bool is_equality(tree_operator op)
{
    return op == OP_EQUAL || op == OP_NOT_EQUAL;
}

static bool are(const value *a, const value *b, int kind)
{
    return type_is(&a->type, kind) && type_is(&b->type, kind);
}

/* Help for a number without a unit beside one with a unit. */
static const char *suggest_unit(scope *s, tree_operator op, const value *a, const value *b)
{
    const value *plain = type_is_plain(&a->type) ? a : b, *other = plain == a ? b : a;
    text out = {.arena = s->k->arena};
    if (op == OP_REMAINDER && type_is_number(&a->type) && type_is_number(&b->type))
        return "mod() takes numbers of any unit";
    if (plain->kind != VALUE_CONSTANT || !type_is_plain(&plain->type) ||
        !type_is_unit(&other->type) || op == OP_DIVIDE)
        return NULL;
    text_add(&out, "write ");
    number_print(value_as_number(plain), &other->type, &out);
    return out.at;
}

static value *refuse_binary(scope *s, const tree_expression *e, const value *a, const value *b)
{
    arena *m = s->k->arena;
    diagnostic *d = diagnose(s->k->d, DIAG_E0202, e->span, operator_text(e->op),
                             type_text(m, &a->type), type_text(m, &b->type));
    d->help = suggest_unit(s, e->op, a, b);
    return value_error(s, e->span);
}

/* Both as floats, unless both are integers: the two sides are stored alike. */
static void store_alike(scope *s, value *sides[2])
{
    if (are(sides[0], sides[1], PCG_INT))
        return;
    for (int i = 0; i < 2; i++)
        if (type_is(&sides[i]->type, PCG_INT))
            sides[i] = value_convert(s->k, sides[i], &type_float);
}

/* False, and reported, where the right side is a constant that the operation cannot take. */
static bool check_right_side(scope *s, const tree_expression *e, const value *right)
{
    value r;
    if (!value_evaluate(s->k->arena, right, &r))
        return true;
    if ((e->op == OP_DIVIDE || e->op == OP_REMAINDER) && type_is_number(&r.type) &&
        value_as_number(&r) == 0) {
        diagnose(s->k->d, DIAG_E0212, right->span);
        return false;
    }
    if ((e->op == OP_SHIFT_LEFT || e->op == OP_SHIFT_RIGHT) &&
        (r.any.cell[0].i < 0 || r.any.cell[0].i > 63)) {
        diagnose(s->k->d, DIAG_E0219, right->span, r.any.cell[0].i);
        return false;
    }
    return true;
}

static bool compares(tree_operator op, const type *a, const type *b)
{
    type common;
    if ((type_is_text(a) && type_is_text(b)) || unit_combine(op, a, b, &common))
        return true;
    return is_equality(op) && a->kind == TYPE_VALUE && type_equal(a, b) &&
           !(type_is(a, PCG_LIST) && type_is_error(a->element));
}

/* Vectors and colours go with their like by components, and are scaled by plain numbers. */
static bool combine_vectors(tree_operator op, const type *a, const type *b, type *result)
{
    bool left = type_is_vector(a), right = type_is_vector(b);
    *result = left ? *a : *b;
    if (type_is(result, PCG_QUATERNION))
        return false;
    if (left && right)
        return type_equal(a, b) && op != OP_REMAINDER;
    return left ? type_is_plain(b) && (op == OP_MULTIPLY || op == OP_DIVIDE)
                : right && type_is_plain(a) && op == OP_MULTIPLY;
}

static bool is_arithmetic(tree_operator op)
{
    return op >= OP_MULTIPLY && op <= OP_SUBTRACT;
}

/* The type of the result; false where the operator does not take the two. */
static bool result_type(tree_operator op, const value *a, const value *b, type *result)
{
    if (is_arithmetic(op))
        return unit_combine(op, &a->type, &b->type, result) ||
               combine_vectors(op, &a->type, &b->type, result);
    if (is_comparison(op) || op == OP_AND || op == OP_OR) {
        *result = type_bool;
        return is_comparison(op) ? compares(op, &a->type, &b->type) : are(a, b, PCG_BOOL);
    }
    *result = type_int;
    return are(a, b, PCG_INT);
}

/* Text + anything is text. */
static value *join_text(scope *s, const tree_expression *e, value *sides[2])
{
    for (int i = 0; i < 2; i++) {
        if (!require_value(s, sides[i], "text"))
            return value_error(s, e->span);
        sides[i] = value_convert(s->k, sides[i], &type_string);
    }
    value *v = value_new(s, VALUE_BINARY, type_string, e->span);
    v->op = OP_ADD;
    return value_finish(s, v, 2, sides);
}

/* Each side can tell the other what its bare words and lists mean: axis == x, size + [0, 0, 1]. */
static void check_sides(scope *s, const tree_expression *e, const type *hint, value *sides[2])
{
    const tree_expression *left = e->operands.at[0], *right = e->operands.at[1];
    bool right_first = left->kind == EXPR_NAME && !name_is_known(s, left->name.text);
    if (!is_comparison(e->op)) {
        sides[0] = check_value(s, left, hint);
        sides[1] = check_value(s, right, type_is_vector(&sides[0]->type) ? &sides[0]->type : hint);
    } else if (right_first) {
        sides[1] = check_value(s, right, NULL);
        sides[0] = check_value(s, left, &sides[1]->type);
    } else {
        sides[0] = check_value(s, left, NULL);
        sides[1] = check_value(s, right, &sides[0]->type);
    }
}

value *check_binary(scope *s, const tree_expression *e, const type *hint)
{
    value *sides[2];
    type result;
    check_sides(s, e, hint, sides);
    if (value_is_error(sides[0]) || value_is_error(sides[1]))
        return value_error(s, e->span);
    if (e->op == OP_ADD && (type_is_text(&sides[0]->type) || type_is_text(&sides[1]->type)))
        return join_text(s, e, sides);
    if (!result_type(e->op, sides[0], sides[1], &result))
        return refuse_binary(s, e, sides[0], sides[1]);
    if (!check_right_side(s, e, sides[1]))
        return value_error(s, e->span);
    store_alike(s, sides);
    value *v = value_new(s, VALUE_BINARY, result, e->span);
    v->op = e->op;
    return value_finish(s, v, 2, sides);
}

/* ---- choices and lists --------------------------------------------------------------------- */

bool common_type(const value *a, const value *b, const type *hint, type *result)
{
    if (hint && hint->kind == TYPE_VALUE && conversion_cost(a, hint) < CONVERT_NEVER &&
        conversion_cost(b, hint) < CONVERT_NEVER)
        *result = *hint;
    else if (type_equal(&a->type, &b->type))
        *result = a->type;
    else if (type_is_plain(&a->type) && type_is_plain(&b->type))
        *result = type_float;
    else if (type_is_text(&a->type) || type_is_text(&b->type))
        *result = type_string;
    else if (type_is(&a->type, PCG_LIST) && conversion_cost(b, &a->type) < CONVERT_NEVER)
        *result = a->type;
    else if (type_is(&b->type, PCG_LIST) && conversion_cost(a, &b->type) < CONVERT_NEVER)
        *result = b->type;
    else
        return false;
    return true;
}

value *check_choice(scope *s, const tree_expression *e, const type *hint)
{
    value *parts[3] = {check_value_as(s, e->operands.at[0], &type_bool, "what stands before '?'"),
                       check_value(s, e->operands.at[1], hint),
                       check_value(s, e->operands.at[2], hint)};
    type result;
    if (value_is_error(parts[0]) || value_is_error(parts[1]) || value_is_error(parts[2]) ||
        !require_value(s, parts[1], "a value") || !require_value(s, parts[2], "a value"))
        return value_error(s, e->span);
    if (!common_type(parts[1], parts[2], hint, &result)) {
        diagnostic *d =
            diagnose(s->k->d, DIAG_E0209, parts[1]->span, type_text(s->k->arena, &parts[1]->type),
                     type_text(s->k->arena, &parts[2]->type));
        d->second = (diagnostic_label){parts[2]->span, NULL};
        return value_error(s, e->span);
    }
    value *v = value_new(s, VALUE_CHOICE, result, e->span);
    parts[1] = value_convert(s->k, parts[1], &result);
    parts[2] = value_convert(s->k, parts[2], &result);
    return value_finish(s, v, 3, parts);
}

/* The type of the elements: the one that all can become. False: it was reported, or an element was.
 */
static bool element_type(scope *s, value *const *elements, uint32_t count, const type *hint,
                         type *result)
{
    value first = *elements[0];
    for (uint32_t i = 0; i < count; i++)
        if (value_is_error(elements[i]) || !require_value(s, elements[i], "an element of a list"))
            return false;
    for (uint32_t i = 1; i < count; i++) {
        type wider;
        if (!common_type(&first, elements[i], hint, &wider)) {
            diagnostic *d = diagnose(s->k->d, DIAG_E0214, elements[i]->span,
                                     type_text(s->k->arena, &first.type),
                                     type_text(s->k->arena, &elements[i]->type));
            d->second = (diagnostic_label){elements[0]->span, NULL};
            return false;
        }
        first.type = wider;
    }
    *result = first.type;
    if (type_is(result, PCG_LIST))
        diagnose(s->k->d, DIAG_E0120, elements[0]->span, type_text(s->k->arena, result));
    return !type_is(result, PCG_LIST);
}

value *check_list(scope *s, const tree_expression *e, const type *hint)
{
    uint32_t count = e->operands.count;
    value **elements = ARENA_ARRAY(s->k->arena, value *, count);
    const type *wanted = hint && type_is(hint, PCG_LIST) ? hint->element : NULL;
    type *element = ARENA_NEW(s->k->arena, type);
    *element = wanted && !count ? *wanted : type_error;
    for (uint32_t i = 0; i < count; i++)
        elements[i] = check_value(s, e->operands.at[i], wanted);
    if (count && !element_type(s, elements, count, wanted, element))
        return value_error(s, e->span);
    for (uint32_t i = 0; i < count; i++)
        elements[i] = value_convert(s->k, elements[i], element);
    type list = {.kind = TYPE_VALUE, .value = PCG_LIST, .element = element};
    return value_finish(s, value_new(s, VALUE_LIST, list, e->span), count, elements);
}

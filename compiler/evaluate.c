/* evaluate.c - folds constant values. Integers wrap around at 64 bits, as they do in the emitted
 * code. */
#include "evaluate.h"

#include <math.h>
#include <string.h>

enum { MAX_TEXT = 64 << 10 };

static bool is_integer(const type *t)
{
    return t->kind == TYPE_VALUE &&
           (t->value == PCG_BOOL || t->value == PCG_INT || t->value == PCG_ENUM);
}

double value_as_number(const value *v)
{
    const pcg_cell *c = &v->any.cell[0];
    return is_integer(&v->type) ? (double)c->i : c->f;
}

static bool give_int(value *result, pcg_int i)
{
    result->any.cell[0].i = i;
    return true;
}

static bool give_float(value *result, double f)
{
    result->any.cell[0].f = f;
    return isfinite(f);
}

/* ---- integers ------------------------------------------------------------------------------ */

static pcg_int wrapped(uint64_t u)
{
    return u <= INT64_MAX ? (pcg_int)u : -(pcg_int)(UINT64_MAX - u) - 1;
}

/* Towards minus infinity, as an arithmetic shift does. */
static pcg_int shift_right(pcg_int x, pcg_int by)
{
    return x >= 0 ? (pcg_int)((uint64_t)x >> by) : -(pcg_int)((uint64_t)(-(x + 1)) >> by) - 1;
}

static bool quotient(tree_operator op, pcg_int x, pcg_int y, value *result)
{
    if (y == 0)
        return false;
    if (y == -1)
        return give_int(result, op == OP_DIVIDE ? wrapped(0 - (uint64_t)x) : 0);
    return give_int(result, op == OP_DIVIDE ? x / y : x % y);
}

static bool fold_int(tree_operator op, pcg_int x, pcg_int y, value *result)
{
    uint64_t a = (uint64_t)x, b = (uint64_t)y;
    switch (op) {
    case OP_MULTIPLY:
        return give_int(result, wrapped(a * b));
    case OP_DIVIDE:
    case OP_REMAINDER:
        return quotient(op, x, y, result);
    case OP_ADD:
        return give_int(result, wrapped(a + b));
    case OP_SUBTRACT:
        return give_int(result, wrapped(a - b));
    case OP_SHIFT_LEFT:
        return y >= 0 && y < 64 && give_int(result, wrapped(a << b));
    case OP_SHIFT_RIGHT:
        return y >= 0 && y < 64 && give_int(result, shift_right(x, y));
    case OP_BIT_AND:
        return give_int(result, wrapped(a & b));
    case OP_BIT_XOR:
        return give_int(result, wrapped(a ^ b));
    case OP_BIT_OR:
        return give_int(result, wrapped(a | b));
    case OP_AND:
        return give_int(result, x && y);
    case OP_OR:
        return give_int(result, x || y);
    default:
        return false;
    }
}

/* ---- comparisons, floats ------------------------------------------------------------------- */

/* The sign of a - b as two comparisons, so that it serves every type. */
static bool compare(tree_operator op, bool less, bool greater, value *result)
{
    switch (op) {
    case OP_LESS:
        return give_int(result, less);
    case OP_LESS_EQUAL:
        return give_int(result, !greater);
    case OP_GREATER:
        return give_int(result, greater);
    case OP_GREATER_EQUAL:
        return give_int(result, !less);
    case OP_EQUAL:
        return give_int(result, !less && !greater);
    case OP_NOT_EQUAL:
        return give_int(result, less || greater);
    default:
        return false;
    }
}

static bool fold_float(tree_operator op, double x, double y, value *result)
{
    switch (op) {
    case OP_MULTIPLY:
        return give_float(result, x * y);
    case OP_DIVIDE:
        return give_float(result, x / y);
    case OP_ADD:
        return give_float(result, x + y);
    case OP_SUBTRACT:
        return give_float(result, x - y);
    default:
        return false;
    }
}

static bool is_comparison(tree_operator op)
{
    return op >= OP_LESS && op <= OP_NOT_EQUAL;
}

static bool fold_text(arena *a, const value *v, const char *x, const char *y, value *result)
{
    if (v->op == OP_ADD) {
        if (strlen(x) + strlen(y) > MAX_TEXT)
            return false;
        result->string = arena_format(a, "%s%s", x, y);
        result->any.cell[0].s = result->string;
        return true;
    }
    int order = strcmp(x, y);
    return compare(v->op, order<0, order> 0, result);
}

/* By components; a number beside a vector goes with each. */
static bool fold_vector(const value *v, const value *x, const value *y, value *result)
{
    bool whole = true;
    uint32_t count = type_components(type_is_vector(&x->type) ? &x->type : &y->type);
    for (uint32_t i = 0; i < count; i++) {
        double a = x->any.cell[type_is_vector(&x->type) ? i : 0].f;
        double b = y->any.cell[type_is_vector(&y->type) ? i : 0].f;
        value part;
        if (is_comparison(v->op)) {
            whole &= a == b;
        } else {
            if (!fold_float(v->op, a, b, &part))
                return false;
            result->any.cell[i] = part.any.cell[0];
        }
    }
    return !is_comparison(v->op) || give_int(result, whole == (v->op == OP_EQUAL));
}

static bool fold_binary(arena *m, const value *v, const value *x, const value *y, value *result)
{
    const pcg_cell *a = &x->any.cell[0], *b = &y->any.cell[0];
    if (type_is_text(&x->type))
        return fold_text(m, v, x->string, y->string, result);
    if (type_is_vector(&x->type) || type_is_vector(&y->type))
        return fold_vector(v, x, y, result);
    if (is_integer(&x->type))
        return is_comparison(v->op) ? compare(v->op, a->i<b->i, a->i> b->i, result)
                                    : fold_int(v->op, a->i, b->i, result);
    return is_comparison(v->op) ? compare(v->op, a->f<b->f, a->f> b->f, result)
                                : fold_float(v->op, a->f, b->f, result);
}

/* ---- the other kinds ----------------------------------------------------------------------- */

static bool fold_unary(const value *v, const value *x, value *result)
{
    pcg_int i = x->any.cell[0].i;
    switch (v->op) {
    case OP_NEGATE:
        for (uint32_t k = 0; k < type_components(&x->type); k++)
            result->any.cell[k].f = -x->any.cell[k].f;
        if (type_is_vector(&x->type))
            return true;
        return is_integer(&x->type) ? give_int(result, wrapped(0 - (uint64_t)i))
                                    : give_float(result, -x->any.cell[0].f);
    case OP_NOT:
        return give_int(result, !i);
    case OP_COMPLEMENT:
        return give_int(result, wrapped(~(uint64_t)i));
    default:
        return false;
    }
}

/* To text only what is text: the run writes numbers in a form of its own. */
static bool fold_convert(const value *v, const value *x, value *result)
{
    if (type_is_text(&v->type)) {
        result->string = x->string;
        result->any.cell[0].s = x->string;
        return type_is_text(&x->type);
    }
    return type_is(&x->type, PCG_INT) && give_float(result, (double)x->any.cell[0].i);
}

/* The value of a constant was folded when it was checked: if it is no VALUE_CONSTANT, it cannot be
 * one. */
static bool fold_const(const value *v, value *result)
{
    const value *k = v->constant->value;
    if (!k || k->kind != VALUE_CONSTANT)
        return false;
    span place = result->span;
    *result = *k;
    result->span = place;
    return true;
}

static bool fold_operands(arena *a, const value *v, value *result)
{
    value operand[2];
    if (v->kind == VALUE_CHOICE) {
        if (!value_evaluate(a, v->operands[0], &operand[0]))
            return false;
        return value_evaluate(a, v->operands[operand[0].any.cell[0].i ? 1 : 2], result);
    }
    for (uint32_t i = 0; i < v->count && i < 2; i++)
        if (!value_evaluate(a, v->operands[i], &operand[i]))
            return false;
    switch (v->kind) {
    case VALUE_UNARY:
        return fold_unary(v, &operand[0], result);
    case VALUE_BINARY:
        return fold_binary(a, v, &operand[0], &operand[1], result);
    case VALUE_CONVERT:
        return fold_convert(v, &operand[0], result);
    case VALUE_COMPONENT:
        return give_float(result, operand[0].any.cell[v->component].f);
    default:
        return false;
    }
}

bool value_evaluate(arena *a, const value *v, value *result)
{
    if (v->kind == VALUE_CONSTANT) {
        *result = *v;
        return true;
    }
    value made = {.kind = VALUE_CONSTANT, .type = v->type, .span = v->span};
    made.any.kind = v->type.value;
    bool folded = v->kind == VALUE_CONST ? fold_const(v, &made) : fold_operands(a, v, &made);
    if (folded) {
        made.type = v->type;
        made.any.kind = v->type.value;
        *result = made;
    }
    return folded;
}

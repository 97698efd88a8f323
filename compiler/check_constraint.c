/* check_constraint.c - what values a parameter may have: range, one of, matches, at most. */
#include "check.h"

#include <string.h>

/* The kinds of pcg_constraint_info are those of the tree, in their order. */
static const char *const words[] = {[CONSTRAINT_RANGE] = "range",
                                    [CONSTRAINT_ONE_OF] = "one of",
                                    [CONSTRAINT_MATCHES] = "matches",
                                    [CONSTRAINT_AT_MOST] = "at most"};

/* ---- declaring ----------------------------------------------------------------------------- */

/* A constant operand as a constant; false: it was reported. */
static bool constant_operand(scope *s, const tree_expression *e, const type *of, const char *taker,
                             value *to)
{
    const value *v = check_value_as(s, e, of, taker);
    if (value_is_error(v))
        return false;
    if (value_evaluate(s->k->arena, v, to))
        return true;
    diagnose(s->k->d, DIAG_E0507, e->span);
    return false;
}

static bool check_range(scope *s, const tree_constraint *t, const type *of, pcg_constraint_info *to)
{
    value low, high;
    if (t->operands.count != 2) {
        diagnose(s->k->d, DIAG_E0513, t->span, (unsigned)t->operands.count);
        return false;
    }
    if (!constant_operand(s, t->operands.at[0], of, "the range", &low) ||
        !constant_operand(s, t->operands.at[1], of, "the range", &high))
        return false;
    to->low = value_as_number(&low);
    to->high = value_as_number(&high);
    if (to->low <= to->high)
        return true;
    diagnose(s->k->d, DIAG_E0509, t->span, value_text(s->k->arena, &low),
             value_text(s->k->arena, &high));
    return false;
}

/* A value as `one of` keeps it: text as it is, all else as it is written. */
static void print_plain(const value *v, text *out)
{
    if (type_is_text(&v->type))
        text_add(out, v->string);
    else
        value_print(v, out);
}

static bool check_one_of(scope *s, const tree_constraint *t, const type *of,
                         pcg_constraint_info *to)
{
    text list = {.arena = s->k->arena};
    text_add(&list, "");
    for (uint32_t i = 0; i < t->operands.count; i++) {
        value one;
        if (!constant_operand(s, t->operands.at[i], of, "'one of'", &one))
            return false;
        text_add(&list, i ? "\n" : "");
        print_plain(&one, &list);
    }
    to->text = list.at;
    return true;
}

static bool check_matches(scope *s, const tree_constraint *t, pcg_constraint_info *to)
{
    const char *error;
    value expression;
    if (!constant_operand(s, t->operands.at[0], &type_string, "'matches'", &expression))
        return false;
    to->text = expression.string;
    if (pattern_new(s->k->arena, to->text, &error))
        return true;
    diagnose(s->k->d, DIAG_E0510, t->operands.at[0]->span, to->text, error);
    return false;
}

static bool check_at_most(scope *s, const tree_constraint *t, pcg_constraint_info *to)
{
    value count;
    if (!constant_operand(s, t->operands.at[0], &type_int, "'at most'", &count))
        return false;
    to->high = value_as_number(&count);
    return true;
}

static bool constrains(tree_constraint_kind kind, const type *of)
{
    if (kind == CONSTRAINT_RANGE)
        return type_is_number(of);
    if (kind == CONSTRAINT_ONE_OF)
        return of->kind == TYPE_VALUE && !type_is(of, PCG_LIST) && !type_is_vector(of);
    return type_is_text(of);
}

static bool check_constraint(scope *s, const tree_constraint *t, const type *of,
                             pcg_constraint_info *to)
{
    to->kind = (int)t->kind;
    if (!constrains(t->kind, of)) {
        diagnose(s->k->d, DIAG_E0508, t->span, words[t->kind], type_text(s->k->arena, of));
        return false;
    }
    switch (t->kind) {
    case CONSTRAINT_RANGE:
        return check_range(s, t, of, to);
    case CONSTRAINT_ONE_OF:
        return check_one_of(s, t, of, to);
    case CONSTRAINT_MATCHES:
        return check_matches(s, t, to);
    case CONSTRAINT_AT_MOST:
        return check_at_most(s, t, to);
    }
    return false;
}

void check_constraints(scope *s, const tree_parameter *t, const type *of,
                       const pcg_constraint_info **constraints, uint32_t *count)
{
    pcg_constraint_info *made = ARENA_ARRAY(s->k->arena, pcg_constraint_info, t->constraints.count);
    *constraints = made;
    *count = 0;
    for (uint32_t i = 0; !type_is_error(of) && i < t->constraints.count; i++)
        *count += check_constraint(s, &t->constraints.at[i], of, &made[*count]);
}

/* ---- holding values against them ----------------------------------------------------------- */

static double characters(const char *s)
{
    double count = 0;
    for (; *s; s++)
        count += ((unsigned char)*s & 0xC0) != 0x80;
    return count;
}

static bool is_listed(checker *k, const value *v, const char *list)
{
    text plain = {.arena = k->arena};
    print_plain(v, &plain);
    for (const char *at = list;; at++) {
        size_t length = strcspn(at, "\n");
        if (length == plain.length && !memcmp(at, plain.at, length))
            return true;
        at += length;
        if (!*at)
            return false;
    }
}

static bool holds(checker *k, const value *v, const pcg_constraint_info *c)
{
    const char *error;
    switch ((tree_constraint_kind)c->kind) {
    case CONSTRAINT_RANGE:
        return value_as_number(v) >= c->low && value_as_number(v) <= c->high;
    case CONSTRAINT_ONE_OF:
        return is_listed(k, v, c->text);
    case CONSTRAINT_MATCHES:
        return pattern_matches(k->arena, pattern_new(k->arena, c->text, &error), v->string);
    case CONSTRAINT_AT_MOST:
        return characters(v->string) <= c->high;
    }
    return true;
}

static const char *describe(checker *k, const pcg_constraint_info *c, const type *of)
{
    text out = {.arena = k->arena};
    if (c->kind == CONSTRAINT_RANGE) {
        text_add(&out, "in the range from ");
        number_print(c->low, of, &out);
        text_add(&out, " to ");
        number_print(c->high, of, &out);
    } else if (c->kind == CONSTRAINT_ONE_OF) {
        text_add(&out, "one of ");
        for (const char *at = c->text; *at; at++)
            text_add_bytes(&out, *at == '\n' ? ", " : at, *at == '\n' ? 2 : 1);
    } else if (c->kind == CONSTRAINT_MATCHES) {
        text_add(&out, "what matches ");
        text_quote(&out, c->text);
    } else {
        text_add(&out, "at most ");
        text_number(&out, c->high);
        text_add(&out, " characters long");
    }
    return out.at;
}

void check_constrained(checker *k, const value *v, const char *name,
                       const pcg_constraint_info *constraints, uint32_t count)
{
    value folded;
    if (!count || value_is_error(v) || !value_evaluate(k->arena, v, &folded))
        return;
    for (uint32_t i = 0; i < count; i++)
        if (!holds(k, &folded, &constraints[i])) {
            const char *found =
                arena_format(k->arena, "'%s' = %s", name, value_text(k->arena, &folded));
            diagnose(k->d, DIAG_E0506, v->span, found, describe(k, &constraints[i], &folded.type));
        }
}

void check_formal(checker *k, formal *f)
{
    scope s = {.k = k, .place = "an interface"};
    if (f->checked)
        return;
    f->checked = true;
    const char *taker = arena_format(k->arena, "'%s'", f->name);
    if (f->tree->initial && (f->type.kind == TYPE_VALUE || f->type.kind == TYPE_ANY))
        f->initial = check_value_as(&s, f->tree->initial, &f->type, taker);
    check_constraints(&s, f->tree, &f->type, &f->constraints, &f->constraint_count);
}

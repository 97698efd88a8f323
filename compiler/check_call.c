/* check_call.c - calls of functions: which overload is meant, and its arguments. */
#include "check.h"

#include <string.h>

enum { SHOWN = 4 }; /* signatures that a message lists */

typedef struct call {
    scope *s;
    const tree_expression *tree; /* NULL: the arguments are checked already */
    const char *library, *name;
    value **arguments; /* NULL where a bare word means nothing without the parameter's type */
    uint32_t count;
    span place;
} call;

/* ---- which function ------------------------------------------------------------------------ */

static bool is_in(const function *f, const call *c)
{
    return (!c->library || !strcmp(f->library->name, c->library)) &&
           library_is_visible(c->s->k->p, f->library);
}

static const formal *formal_of(const function *f, uint32_t i)
{
    bool rest = f->parameter_count && f->parameters[f->parameter_count - 1].collective;
    if (rest && i + 1 >= f->parameter_count)
        return &f->parameters[f->parameter_count - 1];
    return i < f->parameter_count ? &f->parameters[i] : NULL;
}

/* A last parameter of any[] takes what is left, or nothing. */
static bool takes_count(const function *f, uint32_t count)
{
    bool rest = f->parameter_count && f->parameters[f->parameter_count - 1].collective;
    return rest ? count + 1 >= f->parameter_count : count == f->parameter_count;
}

/* A bare word that is an enumerator of the parameter's type is that, whatever else it is. */
static int64_t bare_enumerator(const call *c, uint32_t i, const formal *f)
{
    const tree_expression *e = c->tree ? c->tree->operands.at[i] : NULL;
    if (!e || e->kind != EXPR_NAME || !type_is(&f->type, PCG_ENUM))
        return -1;
    return enumerator_number(f->type.enumeration, e->name.text);
}

static uint32_t call_cost(const call *c, const function *f)
{
    uint32_t cost = 0;
    if (!takes_count(f, c->count))
        return CONVERT_NEVER;
    for (uint32_t i = 0; i < c->count && cost < CONVERT_NEVER; i++) {
        const formal *to = formal_of(f, i);
        if (bare_enumerator(c, i, to) >= 0)
            continue;
        cost += c->arguments[i] ? conversion_cost(c->arguments[i], &to->type) : CONVERT_NEVER;
    }
    return cost < CONVERT_NEVER ? cost : CONVERT_NEVER;
}

/* The overload that needs the least conversion; *tie is another one that needs no more. */
static const function *cheapest(const call *c, const function *first, const function **tie)
{
    const function *best = NULL;
    uint32_t best_cost = CONVERT_NEVER;
    *tie = NULL;
    for (const function *f = first; f; f = f->next) {
        uint32_t cost = is_in(f, c) ? call_cost(c, f) : CONVERT_NEVER;
        if (cost < best_cost) {
            best = f;
            best_cost = cost;
            *tie = NULL;
        } else if (best && cost == best_cost) {
            *tie = f;
        }
    }
    return best;
}

/* The only overload that takes so many arguments; NULL where there is none, or a choice. */
static const function *only_candidate(const call *c, const function *first)
{
    const function *only = NULL;
    for (const function *f = first; f; f = f->next) {
        if (!is_in(f, c) || !takes_count(f, c->count))
            continue;
        if (only)
            return NULL;
        only = f;
    }
    return only;
}

/* ---- messages ------------------------------------------------------------------------------ */

static void print_signature(const function *f, text *out)
{
    text_format(out, "%s(", f->name);
    for (uint32_t i = 0; i < f->parameter_count; i++) {
        text_format(out, "%s%s: ", i ? ", " : "", f->parameters[i].name);
        type_write(&f->parameters[i].type, out);
        text_add(out, f->parameters[i].collective ? "[]" : "");
    }
    text_add(out, ")");
}

/* Those that take as many arguments as there are; where none does, all. */
static const char *list_signatures(const call *c, const function *first)
{
    text out = {.arena = c->s->k->arena};
    uint32_t fitting = 0, count = 0;
    for (const function *f = first; f; f = f->next)
        fitting += is_in(f, c) && takes_count(f, c->count);
    for (const function *f = first; f; f = f->next) {
        if (!is_in(f, c) || (fitting && !takes_count(f, c->count)) || count++ >= SHOWN)
            continue;
        text_add(&out, count > 1 ? "; " : "there is ");
        print_signature(f, &out);
    }
    if (count > SHOWN)
        text_format(&out, "; and %u more", (unsigned)(count - SHOWN));
    return out.at;
}

static const char *argument_types(const call *c)
{
    text out = {.arena = c->s->k->arena};
    text_add(&out, "");
    for (uint32_t i = 0; i < c->count; i++) {
        text_add(&out, i ? ", " : "");
        if (c->arguments[i])
            type_write(&c->arguments[i]->type, &out);
        else
            text_add(&out, c->tree->operands.at[i]->name.text);
    }
    return out.at;
}

static value *unknown_function(const call *c, const tree_name *name)
{
    checker *k = c->s->k;
    names candidates = {0};
    diagnostic *d = c->library
                        ? diagnose(k->d, DIAG_E0119, name->span, c->library, "function", c->name)
                        : diagnose(k->d, DIAG_E0107, name->span, c->name);
    library_add_names(k->p, k->arena, c->library, ENTRY_FUNCTION, &candidates);
    d->text = did_you_mean(k->c, c->name, &candidates);
    const pcg_library *found[2];
    if (!d->text && library_count(k->p, c->library, c->name, ENTRY_PROCEDURE, found))
        d->help = arena_format(k->arena, "'%s' is a procedure: a node of a chain", c->name);
    return value_error(c->s, c->place);
}

/* ---- the call ------------------------------------------------------------------------------ */

static value *make_call(const call *c, const function *f)
{
    scope *s = c->s;
    if (f->traits & TRAIT_RANDOM && !s->node) {
        diagnose(s->k->d, DIAG_E0216, c->place, f->name, s->place);
        return value_error(s, c->place);
    }
    value *v = value_new(s, VALUE_CALL, f->result, c->place);
    v->function = f;
    library_use_function(s->k->p, f);
    if (f->traits & TRAIT_RANDOM) {
        v->reads_chance = true;
        v->site = s->node->random_sites++;
    }
    return value_finish(s, v, c->count, c->arguments);
}

/* Arguments as the parameters want them. */
static void convert_arguments(const call *c, const function *f)
{
    for (uint32_t i = 0; i < c->count; i++) {
        const formal *to = formal_of(f, i);
        int64_t number = bare_enumerator(c, i, to);
        if (number >= 0)
            c->arguments[i] =
                enumerator_value(c->s, &to->type, number, c->tree->operands.at[i]->span);
        else if (!type_is_error(&to->type))
            c->arguments[i] = value_convert(c->s->k, c->arguments[i], &to->type);
    }
}

/* Checks the arguments against the one function that can be meant, so that messages name its
 * parameters. */
static value *check_against(const call *c, const function *f)
{
    bool failed = false;
    for (uint32_t i = 0; i < c->count; i++) {
        const formal *to = formal_of(f, i);
        const char *taker = arena_format(c->s->k->arena, "'%s' of '%s'", to->name, f->name);
        c->arguments[i] = check_value_as(c->s, c->tree->operands.at[i], &to->type, taker);
        failed |= value_is_error(c->arguments[i]);
    }
    return failed ? value_error(c->s, c->place) : make_call(c, f);
}

/* Checks what can be checked before the function is known; false where an argument is wrong in
 * itself. */
static bool check_arguments(const call *c)
{
    bool failed = false;
    for (uint32_t i = 0; i < c->count; i++) {
        const tree_expression *e = c->tree->operands.at[i];
        if (e->kind == EXPR_NAME && !name_is_known(c->s, e->name.text))
            continue;
        c->arguments[i] = check_value(c->s, e, NULL);
        failed |= value_is_error(c->arguments[i]);
    }
    return !failed;
}

/* A bare word that no overload knows as an enumerator: unknown, rather than of the wrong type. */
static bool report_bare_words(const call *c)
{
    bool reported = false;
    for (uint32_t i = 0; i < c->count; i++)
        if (!c->arguments[i]) {
            check_value(c->s, c->tree->operands.at[i], NULL);
            reported = true;
        }
    return reported;
}

static value *choose_overload(const call *c, const function *first)
{
    const function *tie, *f;
    checker *k = c->s->k;
    if (!check_arguments(c))
        return value_error(c->s, c->place);
    f = cheapest(c, first, &tie);
    if (!f && !report_bare_words(c))
        diagnose(k->d, DIAG_E0204, c->place, c->name, argument_types(c))->help =
            list_signatures(c, first);
    if (f && tie) {
        text both = {.arena = k->arena};
        print_signature(f, &both);
        text_add(&both, " and ");
        print_signature(tie, &both);
        diagnose(k->d, DIAG_E0205, c->place, c->name, argument_types(c))->help = both.at;
    }
    if (!f || tie)
        return value_error(c->s, c->place);
    convert_arguments(c, f);
    return make_call(c, f);
}

/* The library that is written before the name; false where there is no such one. */
static bool find_library(call *c, const tree_expression *e)
{
    checker *k = c->s->k;
    if (!e->port.text)
        return true;
    const pcg_library *l =
        c->s->graph ? table_get(&c->s->graph->unit->libraries, e->port.text) : NULL;
    if (!l)
        l = library_named(k->p, e->port.text);
    if (l)
        c->library = l->name;
    else
        library_report_unknown(k->c, k->p, &e->port);
    return l != NULL;
}

value *check_call(scope *s, const tree_expression *e)
{
    call c = {
        .s = s, .tree = e, .name = e->name.text, .count = e->operands.count, .place = e->span};
    c.arguments = ARENA_ARRAY(s->k->arena, value *, c.count);
    if (!find_library(&c, e))
        return value_error(s, e->span);
    const function *first = find_function(s->k->c, s->k->p, c.library, c.name);
    if (!first)
        return unknown_function(&c, &e->name);
    const function *only = only_candidate(&c, first);
    return only ? check_against(&c, only) : choose_overload(&c, first);
}

value *call_function(scope *s, const char *name, value *const *arguments, uint32_t count,
                     span place)
{
    call c = {.s = s, .name = name, .count = count, .place = place};
    const function *tie, *f;
    c.arguments = ARENA_ARRAY(s->k->arena, value *, count);
    for (uint32_t i = 0; i < count; i++)
        c.arguments[i] = arguments[i];
    f = cheapest(&c, find_function(s->k->c, s->k->p, NULL, name), &tie);
    if (!f)
        return NULL;
    convert_arguments(&c, f);
    return make_call(&c, f);
}

/* [1, 2, 3] where a vector is wanted is vec3(1, 2, 3). */
value *check_vector(scope *s, const tree_expression *e, const type *t)
{
    static const char *const makers[] = {[2] = "vec2", [3] = "vec3", [4] = "vec4"};
    uint32_t count = e->operands.count;
    value **parts = ARENA_ARRAY(s->k->arena, value *, count);
    if (count != type_components(t) || type_is(t, PCG_COLOR) || type_is(t, PCG_QUATERNION))
        return check_list(s, e, NULL);
    for (uint32_t i = 0; i < count; i++) {
        parts[i] = check_value(s, e->operands.at[i], NULL);
        if (value_is_error(parts[i]))
            return value_error(s, e->span);
    }
    value *v = call_function(s, makers[count], parts, count, e->span);
    return v ? v : check_list(s, e, NULL);
}

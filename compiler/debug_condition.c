/* debug_condition.c - conditions of breakpoints: expressions of the language, compiled while the
 * graph runs.
 *
 * The expression is parsed as the argument of a node that is made up, and typed as one of the
 * node that it is for. What it says of the run it says of entities as they are; of the past only
 * attributes are known. It is evaluated by code of its own over the frames of the run, with the
 * memory of another run, so that nothing that it does is seen by the one that is looked at. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "debug.h"

static const char before[] = "graph condition { condition(", behind[] = "\n) }\n";

/* A judge that holds more than this is replaced. */
enum { JUDGE_BYTES = 16 << 20 };

/* ---- parsing --------------------------------------------------------------------------------- */

/* From the text that was parsed to the line that was given; `shift` bytes lie between. */
typedef struct relocation {
    const source *from, *to;
    int64_t shift;
} relocation;

static uint32_t moved(const relocation *m, uint32_t at)
{
    int64_t to = (int64_t)at + m->shift;
    return to < 0 ? 0 : to > (int64_t)m->to->size ? (uint32_t)m->to->size : (uint32_t)to;
}

static void move_span(const relocation *m, span *s)
{
    if (s->source == m->from)
        *s = (span){m->to, moved(m, s->from), moved(m, s->to)};
}

static void move_expression(const relocation *m, tree_expression *e)
{
    move_span(m, &e->span);
    move_span(m, &e->name.span);
    move_span(m, &e->port.span);
    for (uint32_t i = 0; i < e->operands.count; i++)
        move_expression(m, e->operands.at[i]);
}

/* The only argument of the only node; NULL where the text holds anything else. */
static tree_expression *only_argument(const tree_file *f)
{
    bool is_graph = f->items.count == 1 && f->items.at[0].kind == ITEM_GRAPH;
    const tree_graph *g = is_graph ? f->items.at[0].graph : NULL;
    const tree_member *m = g && g->members.count == 1 ? g->members.at[0] : NULL;
    const tree_chain *c = m && m->kind == MEMBER_CHAIN ? m->chain : NULL;
    const tree_element *e = c && !c->condition && c->elements.count == 1 ? c->elements.at[0] : NULL;
    if (!e || e->arguments.count != 1 || e->body)
        return NULL;
    const tree_argument *a = &e->arguments.at[0];
    return a->kind == ARGUMENT_VALUE && !a->name.text ? a->value : NULL;
}

static tree_expression *parse(debugger *d, const char *line, const char *expression)
{
    compilation *c = &d->k->t.compilation;
    arena *a = &c->arena;
    const char *written = arena_format(a, "%s%s%s", before, expression, behind);
    source *made = source_new(a, "<condition>", written, strlen(written));
    const source *given =
        source_new(a, "<command>", arena_copy(a, line, strlen(line)), strlen(line));
    const relocation m = {made, given, (expression - line) - (int64_t)strlen(before)};
    tree_expression *e = only_argument(lang_parse(a, made, &c->diagnostics));
    for (uint32_t i = 0; i < c->diagnostics.list.count; i++) {
        move_span(&m, &c->diagnostics.list.at[i].span);
        move_span(&m, &c->diagnostics.list.at[i].second.span);
    }
    if (e)
        move_expression(&m, e);
    else if (!c->diagnostics.errors)
        diagnose(&c->diagnostics, DIAG_E0011,
                 (span){given, (uint32_t)(expression - line), (uint32_t)given->size},
                 "more than one expression");
    return e;
}

/* ---- compiling ------------------------------------------------------------------------------- */

static const value *type_it(debugger *d, tree_expression *e, const node *at)
{
    compilation *c = &d->k->t.compilation;
    program *p = d->k->program;
    checker k = {.c = c, .p = p, .arena = &c->arena, .d = &c->diagnostics};
    scope s = {.k = &k,
               .place = "the condition of a breakpoint",
               .graph = at->owner,
               .node = (node *)(uintptr_t)at, /* which only counts its calls of chance */
               .sees_parameters = true,
               .parameters = at->owner->parameter_count,
               .sees_constants = true,
               .constants = at->owner->constant_count};
    p->scope = at->owner->unit;
    const value *v = check_value_as(&s, e, &type_bool, "'if'");
    p->scope = NULL;
    return c->diagnostics.errors ? NULL : v;
}

static bool is_remembered(const value *v)
{
    bool good = v->kind != VALUE_ENTITY && v->kind != VALUE_PARAMETER && v->kind != VALUE_CONST &&
                !v->reads_chance &&
                (v->kind != VALUE_ATTRIBUTE || v->attribute->initial->kind == VALUE_CONSTANT);
    for (uint32_t i = 0; good && i < v->count; i++)
        good = is_remembered(v->operands[i]);
    return good;
}

static native *compile(debugger *d, const value *v, const node *at)
{
    compilation *c = &d->k->t.compilation;
    const emit_condition condition = {at, v};
    const emit_options options = {
        .version = PCG_VERSION, .observed = true, .condition = &condition};
    text c_text = {.arena = &c->arena};
    char *error = NULL;
    emit(c, d->k->program, &options, &c_text);
    if (c->diagnostics.errors)
        return NULL;
    native *code = native_new(d->k->program, c_text.at, &error);
    if (!code)
        debug_refuse(d, "the condition was not understood by libtcc, which is a bug of pcgc: %s",
                     error ? error : "");
    free(error);
    return code;
}

static debug_condition *make(debugger *d, const char *line, const char *expression, const node *at)
{
    tree_expression *e = parse(d, line, expression);
    const value *v = e && !d->k->t.compilation.diagnostics.errors ? type_it(d, e, at) : NULL;
    native *code = v ? compile(d, v, at) : NULL;
    if (!code)
        return NULL;
    debug_condition *c = ARENA_NEW(&d->memory, debug_condition);
    *c = (debug_condition){.code = code, .at = at, .remembered = is_remembered(v)};
    c->seen = ARENA_ARRAY(&d->memory, pcg_entity *, at->input_count + 1);
    c->shown = ARENA_ARRAY(&d->memory, pcg_entity, at->input_count + 1);
    return c;
}

/* What is wrong with the expression is told as the compiler tells it; the compilation's own
 * messages stay apart. */
debug_condition *debug_condition_new(debugger *d, const char *line, const char *expression,
                                     const node *at)
{
    compilation *c = &d->k->t.compilation;
    const diagnostics own = c->diagnostics;
    jmp_buf *const outer = c->arena.on_failure;
    c->diagnostics = (diagnostics){.arena = &c->arena};
    c->arena.on_failure = &d->out_of_memory;
    debug_condition *made = make(d, line, expression, at);
    c->arena.on_failure = outer;
    for (uint32_t i = 0; i < c->diagnostics.list.count; i++)
        diagnostic_write(&c->diagnostics.list.at[i], false, &d->out);
    c->diagnostics = own;
    return made;
}

void debug_condition_free(debug_condition *c)
{
    if (c)
        native_free(c->code);
}

/* ---- evaluating ------------------------------------------------------------------------------ */

static bool find_judge(debugger *d)
{
    const pcg_run_options options = {.size = sizeof options};
    if (d->judge && d->judge->memory.used > JUDGE_BYTES) {
        pcg_run_free(d->judge);
        d->judge = NULL;
    }
    if (!d->judge)
        d->judge = pcg_run_new(d->run->program, &options);
    return d->judge != NULL;
}

/* The entity at an input now: of a collective one the first, on an edge the one that is sent. */
static pcg_entity *present(const run_observation *w, uint32_t input)
{
    if (w->entity)
        return (pcg_entity *)(uintptr_t)w->entity;
    return w->about && input < w->about->input_count && w->inputs[input].count
               ? w->inputs[input].at[0]
               : NULL;
}

/* As it was: nothing but its attributes. */
static pcg_entity *recorded(const debugger *d, const debug_condition *c, uint32_t input)
{
    const seen_record *last = history_last(&d->past);
    const seen_round *r = history_round(&d->past);
    uint32_t first = 0;
    for (uint32_t i = 0; i < input && last->kind == SEEN_ROUND; i++)
        first += r->taken[i];
    if (last->kind == SEEN_ROUND && !r->taken[input])
        return NULL;
    uint64_t number = last->kind == SEEN_SENT ? last->entity : r->entities[first];
    const seen_state *s = history_state(&d->past, number);
    if (!s)
        return NULL;
    c->shown[input] = (pcg_entity){.type = s->type, .attributes = s->attributes, .references = 1};
    return &c->shown[input];
}

/* False: an input has nothing, so that there is nothing to ask of. */
static bool gather(const debugger *d, const debug_condition *c, bool now)
{
    for (uint32_t i = 0; i < c->at->input_count; i++) {
        c->seen[i] = now ? present(d->run->observed, i) : recorded(d, c, i);
        if (!c->seen[i])
            return false;
    }
    return true;
}

static bool evaluate(debugger *d, const breakpoint *b, bool now)
{
    const seen_level *l = history_level(&d->past);
    const seen_round *r = history_round(&d->past);
    pcg_instance instance = {.rounds = r->number};
    pcg_call call = {.node = r->node, .instance = &instance, .round = r->number, .frame = l->frame};
    int holds = 1;
    if (now)
        call = *d->run->observed->call;
    call.run = d->judge;
    if (native_condition(b->condition->code)(l->graph->form, &call, b->condition->seen, &holds) ==
        PCG_OK)
        return holds;
    text_format(&d->out, "the condition of breakpoint %u cannot be evaluated: %s\n", b->number,
                pcg_run_error(d->judge));
    pcg_run_free(d->judge);
    d->judge = NULL;
    return true;
}

bool debug_condition_holds(debugger *d, breakpoint *b)
{
    const debug_condition *c = b->condition;
    bool now = history_is_present(&d->past) && !d->over;
    const char *why =
        !now && !c->remembered ? "asks for more than attributes, which is not recorded"
        : history_level(&d->past)->frame->loaded->module->nodes != d->run->module->nodes
            ? "is that of another program"
            : NULL;
    if (why) {
        if (!b->told)
            text_format(&d->out, "the condition of breakpoint %u %s: it is passed by there\n",
                        b->number, why);
        b->told = true;
        return false;
    }
    if (!find_judge(d))
        longjmp(d->out_of_memory, 1);
    return gather(d, c, now) && evaluate(d, b, now);
}

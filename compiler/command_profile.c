/* command_profile.c - pcgc profile: where a run spends its time and memory, by node, by encapsulated
 * graph, and by the way down to a node. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "command_run.h"

/* A node as it runs below others: the same node of a graph that is encapsulated twice is two. */
typedef struct place {
    const char *node, *procedure, *graph, *file;
    uint32_t line, column;
    uint32_t above, next;            /* numbers of places; 0: none */
    uint32_t below;                  /* the one that ran last there */
    uint64_t rounds, taken, sent;
    double total, own;               /* seconds: with, and without what ran inside */
    int64_t memory;                  /* bytes that it made the run take (below 0: give back), without what ran inside */
} place;

typedef struct level {
    uint32_t place;
    double began, inside;            /* inside: seconds of the rounds that it holds */
    int64_t memory, memory_inside;
} level;

typedef struct profile {
    bool json;
    const char *stacks;              /* where folded stacks are written to; NULL */
    arena memory;
    jmp_buf out_of_memory;
    LIST(place) places;              /* number 0 is the run itself */
    level *levels;
    uint32_t depth, deepest;
    bool failed;
} profile;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- events ---------------------------------------------------------------------------------- */

static bool is_place(const place *p, const pcg_event *e)
{
    return p->line == e->line && p->column == e->column && !strcmp(p->node, e->node) &&
           !strcmp(p->graph, e->graph) && !strcmp(p->file, e->file);
}

/* The program is gone when its profile is told. */
static const char *keep(profile *p, const char *s)
{
    return arena_copy(&p->memory, s, strlen(s));
}

/* Below the present place: nodes run in an order, so the next one is looked for behind the last. What
 * lies below a place is a ring. */
static uint32_t place_of(profile *p, const pcg_event *e)
{
    uint32_t above = p->depth ? p->levels[p->depth - 1].place : 0;
    uint32_t last = p->places.at[above].below;
    for (uint32_t i = last, end = last; i; i = p->places.at[i].next) {
        if (is_place(&p->places.at[i], e))
            return p->places.at[above].below = i;
        if (p->places.at[i].next == end)
            break;
    }
    uint32_t i = p->places.count;
    const place made = {.node = keep(p, e->node), .procedure = keep(p, e->procedure),
                        .graph = keep(p, e->graph), .file = keep(p, e->file), .line = e->line, .column = e->column,
                        .above = above, .next = last ? p->places.at[last].next : i};
    LIST_ADD(&p->memory, &p->places, made);
    if (last)
        p->places.at[last].next = i;
    return p->places.at[above].below = i;
}

static void begin_round(profile *p, pcg_run *r, const pcg_event *e)
{
    uint32_t i = place_of(p, e);
    pcg_event_input input;
    if (p->depth == p->deepest) {
        uint32_t wanted = p->deepest ? 2 * p->deepest : 16;
        p->levels = arena_resize(&p->memory, p->levels, p->deepest * sizeof *p->levels,
                                 wanted * sizeof *p->levels);
        p->deepest = wanted;
    }
    p->places.at[i].rounds++;
    for (size_t k = 0; k < e->input_count && pcg_run_event_input(r, k, &input); k++)
        p->places.at[i].taken += input.count;
    p->levels[p->depth++] = (level){.place = i, .memory = (int64_t)e->memory, .began = now()};
}

static void end_round(profile *p, int64_t memory)
{
    const level l = p->levels[--p->depth];
    place *at = &p->places.at[l.place];
    double passed = now() - l.began;
    int64_t grown = memory - l.memory;
    at->total += passed;
    at->own += passed - l.inside;
    at->memory += grown - l.memory_inside;
    if (p->depth) {
        p->levels[p->depth - 1].inside += passed;
        p->levels[p->depth - 1].memory_inside += grown;
    }
}

static void on_event(void *user, pcg_run *r, const pcg_event *e)
{
    profile *p = user;
    if (p->failed)
        return;
    if (setjmp(p->out_of_memory)) {
        p->failed = true;
        pcg_run_cancel(r);
        return;
    }
    if (e->kind == PCG_EVENT_ROUND)
        begin_round(p, r, e);
    else if (p->depth && e->kind == PCG_EVENT_SENT)
        p->places.at[p->levels[p->depth - 1].place].sent++;
    else if (p->depth)
        end_round(p, (int64_t)e->memory);
}

/* ---- sums ------------------------------------------------------------------------------------ */

static bool same_node(const place *a, const place *b)
{
    return a->line == b->line && a->column == b->column && !strcmp(a->node, b->node) &&
           !strcmp(a->graph, b->graph) && !strcmp(a->file, b->file);
}

static bool same_graph(const place *a, const place *b)
{
    return !strcmp(a->graph, b->graph) && !strcmp(a->file, b->file);
}

/* A node that runs inside itself spends its time once. */
static bool is_inside_same(const profile *p, const place *at,
                           bool (*same)(const place *a, const place *b))
{
    for (uint32_t i = at->above; i; i = p->places.at[i].above)
        if (same(&p->places.at[i], at))
            return true;
    return false;
}

typedef struct sums {
    place *at;
    uint32_t count;
} sums;

static int by_name(const void *a, const void *b)
{
    const place *x = a, *y = b;
    int order = strcmp(x->file, y->file);
    if (!order)
        order = strcmp(x->graph, y->graph);
    if (!order)
        order = (x->line > y->line) - (x->line < y->line);
    if (!order)
        order = (x->column > y->column) - (x->column < y->column);
    return order ? order : strcmp(x->node, y->node);
}

static int by_time(const void *a, const void *b)
{
    const place *x = a, *y = b;
    int order = (x->own < y->own) - (x->own > y->own);
    return order ? order : by_name(a, b);
}

/* Places that are the same, as one; the most expensive first. */
static sums sum_up(profile *p, bool (*same)(const place *a, const place *b))
{
    sums s = {ARENA_ARRAY(&p->memory, place, p->places.count), 0};
    for (uint32_t i = 1; i < p->places.count; i++) {
        s.at[s.count] = p->places.at[i];
        if (is_inside_same(p, &p->places.at[i], same))
            s.at[s.count].total = 0;
        s.count++;
    }
    qsort(s.at, s.count, sizeof *s.at, by_name);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s.count; i++) {
        if (kept && same(&s.at[kept - 1], &s.at[i])) {
            place *to = &s.at[kept - 1];
            to->rounds += s.at[i].rounds;
            to->taken += s.at[i].taken;
            to->sent += s.at[i].sent;
            to->total += s.at[i].total;
            to->own += s.at[i].own;
            to->memory += s.at[i].memory;
        } else {
            s.at[kept++] = s.at[i];
        }
    }
    s.count = kept;
    qsort(s.at, s.count, sizeof *s.at, by_time);
    return s;
}

/* ---- telling --------------------------------------------------------------------------------- */

static void print_rows(const sums *s, const char *what, bool graphs)
{
    printf("%-32s %10s %10s %10s %11s %11s %10s\n", what, "rounds", "in", "out", "own ms",
           "total ms", "KiB");
    for (uint32_t i = 0; i < s->count; i++) {
        const place *p = &s->at[i];
        char name[128];
        snprintf(name, sizeof name, graphs ? "%s" : "%s/%s", p->graph, p->node);
        printf("%-32s %10llu %10llu %10llu %11.3f %11.3f %10lld\n", name,
               (unsigned long long)p->rounds, (unsigned long long)p->taken,
               (unsigned long long)p->sent, 1e3 * p->own, 1e3 * p->total, (long long)p->memory / 1024);
    }
}

static void add_row(text *out, const place *p, bool of_graph)
{
    text_add(out, "{\"graph\":");
    text_quote(out, p->graph);
    if (!of_graph) {
        text_add(out, ",\"node\":");
        text_quote(out, p->node);
        text_add(out, ",\"procedure\":");
        text_quote(out, p->procedure);
        text_format(out, ",\"line\":%u", p->line);
    }
    text_format(out, ",\"rounds\":%llu,\"in\":%llu,\"out\":%llu,\"own\":",
                (unsigned long long)p->rounds, (unsigned long long)p->taken,
                (unsigned long long)p->sent);
    text_number(out, p->own);
    text_add(out, ",\"total\":");
    text_number(out, p->total);
    text_format(out, ",\"memory\":%lld}", (long long)p->memory);
}

static void add_rows(text *out, const sums *s, const char *name, bool graphs)
{
    text_format(out, "\"%s\":[", name);
    for (uint32_t i = 0; i < s->count; i++) {
        text_add(out, i ? "," : "");
        add_row(out, &s->at[i], graphs);
    }
    text_add(out, "]");
}

static void print(profile *p)
{
    sums nodes = sum_up(p, same_node), graphs = sum_up(p, same_graph);
    if (!p->json) {
        print_rows(&nodes, "node", false);
        putchar('\n');
        print_rows(&graphs, "graph", true);
        return;
    }
    text out = {.arena = &p->memory};
    text_add(&out, "{\"version\":1,");
    add_rows(&out, &nodes, "nodes", false);
    text_add(&out, ",");
    add_rows(&out, &graphs, "graphs", true);
    text_add(&out, "}\n");
    fputs(out.at, stdout);
}

/* "house;tower;roof 1520": what flame graphs are made of, in microseconds. */
static void add_stack(const profile *p, text *out, const place *at)
{
    uint32_t way[64], count = 0;
    for (uint32_t i = (uint32_t)(at - p->places.at); i && count < COUNT_OF(way);
         i = p->places.at[i].above)
        way[count++] = i;
    text_add(out, "run");
    while (count-- > 0)
        text_format(out, ";%s", p->places.at[way[count]].node);
    text_format(out, " %llu\n", (unsigned long long)(at->own > 0 ? 1e6 * at->own + 0.5 : 0));
}

static int write_stacks(profile *p, running *k)
{
    text out = {.arena = &p->memory};
    text_add(&out, "");
    for (uint32_t i = 1; i < p->places.count; i++)
        add_stack(p, &out, &p->places.at[i]);
    return tool_write(&k->t.guard, p->stacks, out.length ? out.at : "", out.length) ? EXIT_DONE
                                                                                     : EXIT_USAGE;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int begin(void *user, running *k)
{
    profile *p = user;
    (void)k;
    p->memory.on_failure = &p->out_of_memory;
    if (setjmp(p->out_of_memory))
        return tool_error(EXIT_LIMIT, "out of memory");
    LIST_ADD(&p->memory, &p->places, (place){0});
    return EXIT_DONE;
}

/* A run that has failed, or met a limit, is told of as far as it came. */
static int tell(profile *p, running *k, int code)
{
    if (setjmp(p->out_of_memory) || p->failed)
        return tool_error(EXIT_LIMIT, "out of memory");
    if (!k->outcome.executed || code == EXIT_INTERRUPTED)
        return code;
    while (p->depth)
        end_round(p, p->levels[p->depth - 1].memory + p->levels[p->depth - 1].memory_inside);
    print(p);
    int written = p->stacks ? write_stacks(p, k) : EXIT_DONE;
    return code == EXIT_DONE ? written : code;
}

static int end(void *user, running *k, int code)
{
    profile *p = user;
    code = tell(p, k, code);
    arena_free(&p->memory);
    return code;
}

static int run_profile(const command *self, int argc, char **argv)
{
    arena a = {0};
    running k = {0};
    profile p = {0};
    const seeing s = {self, on_event, &p, begin, NULL, NULL, end};
    option_texts files = {0};
    const option options[] = {
        {0, "json", OPTION_FLAG, &p.json, NULL, "print it as JSON: seconds and bytes"},
        {0, "stacks", OPTION_TEXT, &p.stacks, "FILE",
         "write what flame graphs are made of: a line for each way down to a node"},
        SEEING_OPTIONS(&k),
        {0}};
    int code = options_read(&a, self, options, argc, argv, &files);
    if (code < 0)
        code = run_seen(&k, &s, &files);
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc profile house.pcg",
                                       "pcgc profile house.pcg --stacks house.folded --json", NULL};
const command command_profile = {"profile", "FILE",
                                 "Runs a graph and tells which nodes took how much time and memory.",
                                 examples, run_profile};

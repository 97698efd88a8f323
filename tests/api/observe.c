/* observe.c - watching a run: what an observer is told, and that watching changes no result. */
#include <stdlib.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

static const char graph[] = "graph row {\n"
                            "    param count: int = 2\n"
                            "    rectangle(width = 4m) -> copies: copy(count = count)\n"
                            "    copies -> part: tower(height = 3m)\n"
                            "    copies -> turned: rotate(x = 90deg, about = centre)\n"
                            "}\n"
                            "graph tower {\n"
                            "    param height: length\n"
                            "    in base: Shape = rectangle()\n"
                            "    out top: Shape\n"
                            "    base -> up: extrude(amount = height) -> top\n"
                            "}\n";

enum { LOG_BYTES = 8192 };

typedef struct watcher {
    char log[LOG_BYTES];
    size_t length;
    int cancel_at; /* events until it cancels; 0: never */
    struct watcher *queues; /* a log of what waits; NULL: none is kept */
} watcher;

static void note(watcher *w, const char *name, unsigned long long number, const char *behind)
{
    int written = snprintf(w->log + w->length, LOG_BYTES - w->length, "%s%llu%s", name, number,
                           behind);
    w->length += written > 0 && (size_t)written < LOG_BYTES - w->length ? (size_t)written : 0;
}

static void note_queues(watcher *w, pcg_run *r, const pcg_event *e)
{
    pcg_event_queue q;
    note(w, e->node, e->round, ":");
    for (size_t i = 0; pcg_run_event_queue(r, i, &q); i++) {
        for (size_t k = 0; k < q.count; k++)
            note(w, q.leaf ? " from " : " before ", pcg_run_event_waiting(r, i, k), q.node);
        CHECK_INTEGER((long long)pcg_run_event_waiting(r, i, q.count), 0);
    }
    note(w, " line ", e->line, "\n");
}

static void note_round(watcher *w, pcg_run *r, const pcg_event *e)
{
    pcg_event_input input;
    pcg_event_parameter p;
    note(w, e->node, e->round, "(");
    for (size_t i = 0; pcg_run_event_input(r, i, &input); i++) {
        for (size_t k = 0; k < input.count; k++)
            note(w, input.name, pcg_run_event_entity(r, i, k), " ");
        CHECK_INTEGER((long long)pcg_run_event_entity(r, i, input.count), 0);
    }
    for (size_t i = 0; pcg_run_event_parameter(r, i, &p); i++) {
        note(w, p.name, i, "=");
        note(w, p.value, e->depth, " ");
    }
    note(w, ")", e->line, "\n");
}

static void observe(void *user, pcg_run *r, const pcg_event *e)
{
    watcher *w = user;
    if (e->kind == PCG_EVENT_ROUND && w->queues)
        note_queues(w->queues, r, e);
    if (e->kind == PCG_EVENT_ROUND)
        note_round(w, r, e);
    else if (e->kind == PCG_EVENT_SENT)
        note(w, e->port, e->entity, e->dropped ? " dropped\n" : e->original ? " copy\n" : "\n");
    else
        note(w, "end ", e->round, "\n");
    if (w->cancel_at && --w->cancel_at == 0)
        pcg_run_cancel(r);
}

static pcg_program *compile(bool observed)
{
    const pcg_compile_options options = {.size = sizeof options, .observed = observed};
    return pcg_compile_text(graph, sizeof graph - 1, "row.pcg", &options);
}

/* Numbers stand behind each name: of rounds, entities, parameters with the depth, and lines. */
static void test_events(void)
{
    watcher queues = {0}, w = {.queues = &queues};
    pcg_program *p = compile(true);
    pcg_run *r = pcg_run_new(p, NULL);
    pcg_event_input none;
    pcg_event_queue no_queue;
    CHECK(r != NULL);
    CHECK_INTEGER(pcg_run_observe(r, observe, &w), PCG_STATUS_OK);
    CHECK(!pcg_run_event_input(r, 0, &none));
    CHECK(!pcg_run_event_queue(r, 0, &no_queue));
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_PART(w.log, "rectangle1(width0=4m0 height1=");
    CHECK_PART(w.log, "copies1(in1 count0=20 ");
    CHECK_PART(w.log, "part1(base1 height0=3m0 )4\nup1(in1 amount0=3m1 ");
    CHECK_PART(w.log, "end 1\ntop1\nend 1\npart2(");
    CHECK_PART(w.log, "turned1(in2 x0=90deg0 y1=0deg0 z2=0deg0 frame3=scope0 about4=centre0 ");
    CHECK_PART(w.log, " copy\n");
    CHECK_PART(queues.log, "part1: before 3part before 2turned before 4turned line 4\n");
    CHECK_PART(queues.log, "up1: line 11\n");
    CHECK_PART(queues.log, " from 1part");
    CHECK_INTEGER(pcg_run_observe(r, observe, &w), PCG_STATUS_MISUSE);
    pcg_run_free(r);
    pcg_program_free(p);
}

static void test_cancel(void)
{
    watcher w = {.cancel_at = 3};
    pcg_program *p = compile(true);
    pcg_run *r = pcg_run_new(p, NULL);
    CHECK_INTEGER(pcg_run_observe(r, observe, &w), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_CANCELLED);
    pcg_run_free(r);
    pcg_program_free(p);
}

static void test_not_compiled_for_it(void)
{
    pcg_program *p = compile(false);
    pcg_run *r = pcg_run_new(p, NULL);
    CHECK_INTEGER(pcg_run_observe(r, observe, NULL), PCG_STATUS_MISUSE);
    CHECK_PART(pcg_run_error(r), "not compiled to be observed");
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    pcg_run_free(r);
    pcg_program_free(p);
}

/* ---- the same results ------------------------------------------------------------------------ */

static void ignore(void *user, pcg_run *r, const pcg_event *e)
{
    unsigned long *count = user;
    pcg_event_parameter p;
    for (size_t i = 0; e->kind == PCG_EVENT_ROUND && i < e->parameter_count; i++)
        *count += pcg_run_event_parameter(r, i, &p);
}

/* What `run --json --entities` prints; from malloc. NULL: it does not compile. `*status`: of the
 * run. */
static char *result_of(const char *path, bool observed, pcg_status *status)
{
    const pcg_compile_options options = {.size = sizeof options, .observed = observed};
    const pcg_run_options limits = {.size = sizeof limits, .max_rounds = 20000,
                                    .max_memory = (size_t)1 << 30};
    const pcg_write_options all = {.size = sizeof all, .entities = true};
    unsigned long count = 0;
    char *text = NULL;
    pcg_program *p = pcg_compile_file(path, &options);
    pcg_run *r = p ? pcg_run_new(p, &limits) : NULL;
    if (r && observed)
        CHECK_INTEGER(pcg_run_observe(r, ignore, &count), PCG_STATUS_OK);
    if (r) {
        *status = pcg_run_execute(r);
        CHECK_INTEGER(pcg_run_write(r, "result.json", NULL, &all), PCG_STATUS_OK);
        FILE *f = fopen("result.json", "rb");
        text = calloc(1, 4 << 20);
        if (f && text)
            text[fread(text, 1, (4 << 20) - 1, f)] = '\0';
        if (f)
            fclose(f);
    }
    pcg_run_free(r);
    pcg_program_free(p);
    return text;
}

static void compare(const char *path)
{
    pcg_status plain = PCG_STATUS_MISUSE, watched = PCG_STATUS_MISUSE;
    char *a = result_of(path, false, &plain), *b = result_of(path, true, &watched);
    unit_integer(watched, plain, path, __FILE__, __LINE__);
    unit_count(a && b && strcmp(a, b) == 0, path, __FILE__, __LINE__);
    free(a);
    free(b);
}

/* Of every kind of node, input and parameter. */
static void compare_all(void)
{
    static const char *const names[] = {
        "core_group", "core_list_errors", "core_measure", "core_pair", "core_random",
        "cycle_collective", "cycle_itself", "edge_condition", "edge_divergence",
        "encapsulated_collective", "encapsulated_links", "encapsulated_parameters",
        "encapsulated_recursion", "encapsulated_source", "expression_division_error",
        "gather_order", "geometry_adjacent", "geometry_nearest", "geometry_split_layout",
        "impulse_closed", "names_in_c", "stand_in"};
    const char *root = getenv("ROOT");
    char path[4096];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/tests/run/%s.pcg", root ? root : ".", names[i]);
        compare(path);
    }
}

int main(void)
{
    test_events();
    test_cancel();
    test_not_compiled_for_it();
    compare_all();
    return unit_done();
}

/* side_by_side.c - several programs in one process, one behind the other and in threads, compiled and
 * run: one that works, one that fails, one without an end that is cancelled. None disturbs another. */
#include <pthread.h>
#include <time.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

enum { REPEATS = 8 };

static const char works[] =
    "graph works {\n"
    "    param style: string = \"inner\"\n"
    "    attr n: int\n"
    "    rectangle() -> copy(count = 40, index => @n) -> turn: set { assign(@n, @n + rand_int(1, 9)) }\n"
    "        -> again: condition(@n < 60)\n"
    "    again.yes -> turn\n"
    "    again.no -> store(key = \"k\") -> d: dynamic(graph = style, n <=> @n) { in in: Shape; out out: Shape; attr n: int }\n"
    "}\n"
    "graph inner {\n"
    "    attr n: int\n"
    "    in  in: Shape\n"
    "    out out: Shape\n"
    "    in -> counter(value => @k) -> set { assign(@n, @n * 100 + @k) } -> out\n"
    "    attr k: int\n"
    "}\n";
static const char fails[] =
    "graph fails {\n"
    "    attr n: int\n"
    "    rectangle() -> copy(count = 9, index => @n) -> bad: extrude(amount = 1m / (@n - 5.0))\n"
    "        -> set_parameter(parameter = \"none\" + @n, value = 1)\n"
    "}\n";
static const char endless[] = "graph endless {\n"
                              "    rectangle() -> again\n"
                              "    again: translate(x = 1m) -> again\n"
                              "}\n";

/* What a program said: how much, and whether all of it was of its own nodes. */
typedef struct heard {
    const char *file;
    int count, foreign;
} heard;

static void hear(void *user, const pcg_message *m)
{
    heard *h = user;
    h->count++;
    h->foreign += m->file && strcmp(m->file, h->file) != 0;
}

static pcg_program *compile(const char *text, size_t size, heard *h)
{
    const pcg_compile_options options = {.size = sizeof options, .message = hear, .user = h};
    return pcg_compile_text(text, size - 1, h->file, &options);
}

static pcg_run *run_of(const pcg_program *p, heard *h)
{
    const pcg_run_options options = {.size = sizeof options, .seed = 7, .message = hear, .user = h};
    return pcg_run_new(p, &options);
}

/* Of all numbers that came out, in order; 0 where something went wrong. */
static uint64_t run_works(void)
{
    heard h = {.file = "works.pcg"};
    pcg_program *p = compile(works, sizeof works, &h);
    pcg_run *r = p ? run_of(p, &h) : NULL;
    uint64_t sum = 0;
    if (r && pcg_run_execute(r) == PCG_STATUS_OK && !h.foreign)
        for (size_t i = 0; i < pcg_program_output_count(p); i++)
            for (size_t k = 0; k < pcg_run_output_count(r, i); k++) {
                double n = 0;
                pcg_run_attribute_float(r, i, k, "n", &n);
                sum = sum * 31 + (uint64_t)n;
            }
    pcg_run_free(r);
    pcg_program_free(p);
    return sum;
}

/* The error that ends it, and the warning before. */
static bool run_fails(void)
{
    heard h = {.file = "fails.pcg"};
    pcg_program *p = compile(fails, sizeof fails, &h);
    pcg_run *r = p ? run_of(p, &h) : NULL;
    bool failed = r && pcg_run_execute(r) == PCG_STATUS_FAILED &&
                  strstr(pcg_run_error(r), "none0") && h.count == 2 && !h.foreign;
    pcg_run_free(r);
    pcg_program_free(p);
    return failed;
}

static void *cancel(void *run)
{
    const struct timespec t = {0, 3000000};
    nanosleep(&t, NULL);
    pcg_run_cancel(run);
    return NULL;
}

static bool run_endless(void)
{
    heard h = {.file = "endless.pcg"};
    pthread_t thread;
    pcg_program *p = compile(endless, sizeof endless, &h);
    pcg_run *r = p ? run_of(p, &h) : NULL;
    if (!r)
        return false;
    pthread_create(&thread, NULL, cancel, r);
    bool cancelled = pcg_run_execute(r) == PCG_STATUS_CANCELLED && !h.foreign;
    pthread_join(thread, NULL);
    pcg_run_free(r);
    pcg_program_free(p);
    return cancelled;
}

typedef struct worker {
    enum { WORKS, FAILS, ENDLESS } kind;
    uint64_t expected;
    int wrong;
} worker;

static void *work(void *context)
{
    worker *w = context;
    for (int i = 0; i < REPEATS; i++) {
        bool right = w->kind == WORKS   ? run_works() == w->expected
                     : w->kind == FAILS ? run_fails()
                                        : run_endless();
        w->wrong += !right;
    }
    return NULL;
}

static void in_threads(uint64_t expected)
{
    worker workers[] = {{.kind = WORKS}, {.kind = FAILS}, {.kind = ENDLESS}, {.kind = WORKS}};
    enum { WORKERS = sizeof workers / sizeof *workers };
    pthread_t threads[WORKERS];
    for (int i = 0; i < WORKERS; i++) {
        workers[i].expected = expected;
        pthread_create(&threads[i], NULL, work, &workers[i]);
    }
    for (int i = 0; i < WORKERS; i++) {
        pthread_join(threads[i], NULL);
        CHECK_INTEGER(workers[i].wrong, 0);
    }
}

/* Runs of one and the other are there at the same time, and take turns. */
static void interleaved(void)
{
    heard h = {.file = "works.pcg"}, bad = {.file = "fails.pcg"};
    pcg_program *p = compile(works, sizeof works, &h), *q = compile(fails, sizeof fails, &bad);
    pcg_run *first = run_of(p, &h), *failing = run_of(q, &bad), *second = run_of(p, &h);
    CHECK_INTEGER(pcg_run_execute(first), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_execute(failing), PCG_STATUS_FAILED);
    pcg_run_cancel(failing);
    CHECK_INTEGER(pcg_run_execute(second), PCG_STATUS_OK);
    CHECK(pcg_run_output_count(second, 0) == pcg_run_output_count(first, 0));
    pcg_run_free(failing);
    pcg_program_free(q);
    CHECK(pcg_run_message_count(first) == pcg_run_message_count(second));
    CHECK_INTEGER(h.foreign + bad.foreign, 0);
    pcg_run_free(first);
    pcg_run_free(second);
    pcg_program_free(p);
}

int main(void)
{
    uint64_t alone = run_works();
    CHECK(alone != 0);
    CHECK(run_fails());
    CHECK(run_endless());
    CHECK(run_works() == alone);
    interleaved();
    in_threads(alone);
    return unit_done();
}

/* flows.c - runs programs node by node and as flows with small batches: all that comes out and all
 * that is told must be the same.
 *
 * Reads records from standard input: the length of a program in bytes, a line end, the program. Its
 * main graph is called `main` and has the attributes trail, steps and number. Prints `N passed, N
 * failed`, and how many flows were run. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/pcg.h"
#include "runtime/run.h"

enum { MOST_BYTES = 1 << 20, SCRATCH_BYTES = 256 << 20 };

typedef struct outcome {
    arena arena;
    text told, results;
    bool flowed;
} outcome;

static void take_message(void *user, const pcg_message *m)
{
    outcome *o = user;
    text_format(&o->told, "%s", m->rendered);
}

static void add_entity(outcome *o, pcg_run *r, size_t output, size_t entity)
{
    double steps = 0, number = 0;
    pcg_run_attribute_float(r, output, entity, "steps", &steps);
    pcg_run_attribute_float(r, output, entity, "number", &number);
    text_format(&o->results, " %s %.0f %.0f;", pcg_run_attribute(r, output, entity, "trail"), steps,
                number);
}

/* Also where each entity comes from: what its random numbers hang on. */
static void add_results(outcome *o, const pcg_program *p, pcg_run *r)
{
    for (size_t i = 0; i < pcg_program_output_count(p); i++) {
        const pcg_entities *list = run_output(r, i);
        text_format(&o->results, "\n%zu:", i);
        for (pcg_u32 k = 0; k < list->count; k++) {
            add_entity(o, r, i, k);
            text_format(&o->results, "%llx", list->at[k]->lineage);
        }
    }
}

static outcome run_with(const pcg_program *p, pcg_u32 batch)
{
    outcome o = {.arena.limit = SCRATCH_BYTES};
    pcg_run_options options = {.size = sizeof options, .message = take_message, .user = &o};
    pcg_run *r = pcg_run_new(p, &options);
    if (!r)
        abort();
    o.told.arena = o.results.arena = &o.arena;
    text_add(&o.told, "");
    r->flow.batch = batch;
    if (pcg_run_execute(r) != PCG_STATUS_OK)
        text_format(&o.results, "%s", pcg_run_error(r));
    add_results(&o, p, r);
    o.flowed = r->flow.rank;
    pcg_run_free(r);
    return o;
}

/* Whether it goes the same way. */
static bool check(const pcg_program *p, pcg_u32 batch, const outcome *whole, bool *flowed)
{
    outcome o = run_with(p, batch);
    bool same = strcmp(o.told.at, whole->told.at) == 0 &&
                strcmp(o.results.at, whole->results.at) == 0;
    if (!same)
        printf("not ok with batches of %u\n  node by node:%s\n%s  as a flow:%s\n%s", batch,
               whole->results.at, whole->told.at, o.results.at, o.told.at);
    *flowed |= o.flowed;
    arena_free(&o.arena);
    return same;
}

static void run_program(const char *program, size_t length, uint64_t count[3])
{
    const pcg_compile_options options = {.size = sizeof options, .graph = "main"};
    pcg_program *p = pcg_compile_text(program, length, "main.pcg", &options);
    if (!p) {
        printf("not ok: it does not compile\n%.*s\n", (int)length, program);
        count[1]++;
        return;
    }
    outcome whole = run_with(p, UINT32_MAX);
    bool flowed = false, same = true;
    for (pcg_u32 batch = 1; same && batch <= 3; batch++)
        same = check(p, batch, &whole, &flowed);
    if (!same)
        printf("%.*s\n", (int)length, program);
    count[!same]++;
    count[2] += flowed;
    arena_free(&whole.arena);
    pcg_program_free(p);
}

int main(void)
{
    char *record = malloc(MOST_BYTES);
    uint64_t count[3] = {0}; /* passed, failed, with flows */
    size_t length;
    while (record && scanf("%zu", &length) == 1 && length < MOST_BYTES && getchar() == '\n' &&
           fread(record, 1, length, stdin) == length)
        run_program(record, length, count);
    if (!record || !feof(stdin) || count[2] < count[0] / 2) {
        printf("not ok: records are cut off, or too few of the programs have flows\n");
        count[1]++;
    }
    printf("# %llu programs had flows\n", (unsigned long long)count[2]);
    printf("%llu passed, %llu failed\n", (unsigned long long)count[0],
           (unsigned long long)count[1]);
    free(record);
    return count[1] != 0;
}

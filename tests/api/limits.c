/* limits.c - each limit of a run, hit: its status and its message. And failures, warnings,
 * notes. */
#include "tests/unit/unit.h"
#include "trouble.h"

static pcg_program *program;

typedef struct heard {
    int notes, warnings, errors;
    char last[1000], last_code[16];
    uint64_t last_round;
} heard;

static void hear(void *user, const pcg_message *m)
{
    heard *h = user;
    h->notes += m->severity == PCG_NOTE;
    h->warnings += m->severity == PCG_WARNING;
    h->errors += m->severity == PCG_ERROR;
    snprintf(h->last, sizeof h->last, "%s", m->rendered);
    snprintf(h->last_code, sizeof h->last_code, "%s", m->code);
    h->last_round = m->round;
}

static heard run(pcg_run_options options, trouble_mode mode, int amount, pcg_status wanted,
                 const char *error)
{
    heard h = {0};
    options.size = sizeof options;
    options.message = hear;
    options.user = &h;
    pcg_run *r = trouble_new(program, &options, mode, amount);
    CHECK(r != NULL);
    CHECK_NUMBER(pcg_run_execute(r), wanted);
    CHECK_TEXT(pcg_run_error(r), error);
    CHECK_NUMBER(pcg_run_output_count(r, 0),
                 wanted == PCG_STATUS_OK && mode == TROUBLE_NOTHING ? 1 : 0);
    pcg_run_free(r);
    return h;
}

static void each_limit(void)
{
    heard h = run((pcg_run_options){.max_rounds = 1000}, TROUBLE_SPIN, 0, PCG_STATUS_LIMIT,
                  "the run passed its limit of 1000 rounds: a cycle may never end (--max-rounds "
                  "raises the limit) "
                  "(node 'maker', round 1001)");
    CHECK_TEXT(h.last_code, "E0702");
    CHECK_NUMBER(h.last_round, 1001);
    CHECK_TEXT(
        h.last,
        "trouble.pcg:3:5: error: the run passed its limit of 1000 rounds: a cycle may never end "
        "(--max-rounds raises the limit) (node 'maker', round 1001) [E0702]\n");
    CHECK_NUMBER(h.errors, 1);
    run((pcg_run_options){.max_entities = 50}, TROUBLE_GROW, 0, PCG_STATUS_LIMIT,
        "the run passed its limit of 50 entities alive at one time (--max-entities raises the "
        "limit) "
        "(node 'maker', round 1)");
    h = run((pcg_run_options){.max_depth = 30}, TROUBLE_NEST, 0, PCG_STATUS_LIMIT,
            "graphs encapsulate each other more than the limit of 30 deep: one may never stop "
            "(--max-depth raises the limit) (node 'inside', round 1)");
    CHECK_TEXT(h.last_code, "E0704");
    run((pcg_run_options){.max_memory = 3 << 20}, TROUBLE_MEMORY, 0, PCG_STATUS_LIMIT,
        "the run needs more memory than its limit of 3 MiB (--max-memory raises the limit) (node "
        "'maker', round 1)");
    run((pcg_run_options){.max_seconds = 0.05}, TROUBLE_TICK, 0, PCG_STATUS_LIMIT,
        "the run took longer than its limit of 0.05 s (--max-seconds raises the limit) (node "
        "'maker', round 1)");
}

/* A host may ask for a depth that the thread's stack has no room for. */
static void depth_beyond_the_stack(void)
{
    heard h = {0};
    const pcg_run_options options = {
        .size = sizeof options, .max_depth = 2000000000, .message = hear, .user = &h};
    pcg_run *r = trouble_new(program, &options, TROUBLE_NEST, 0);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_LIMIT);
    CHECK_TEXT(h.last_code, "E0705");
    CHECK_PART(pcg_run_error(r),
               "the stack of this thread has no room for graphs that encapsulate each other ");
    pcg_run_free(r);
}

static void failures(void)
{
    heard h = run((pcg_run_options){0}, TROUBLE_FAIL, 0, PCG_STATUS_FAILED,
                  "a roof of 1.2 m cannot be built (node 'maker', round 1)");
    CHECK_TEXT(h.last_code, "E0701");
    run((pcg_run_options){0}, TROUBLE_MUTE, 0, PCG_STATUS_FAILED,
        "it stopped without saying why (node 'maker', round 1)");
    h = run((pcg_run_options){0}, TROUBLE_NOTHING, 0, PCG_STATUS_OK, "");
    CHECK_NUMBER(h.warnings + h.errors + h.notes, 0);
}

static void warnings_are_held_back(void)
{
    heard h = run((pcg_run_options){0}, TROUBLE_WARN, 20, PCG_STATUS_OK, "");
    CHECK_NUMBER(h.warnings, 21); /* and the result, to which nothing came */
    CHECK_TEXT(h.last_code, "W0501");
    h = run((pcg_run_options){0}, TROUBLE_WARN, 1000000, PCG_STATUS_OK, "");
    CHECK_NUMBER(h.warnings, 22);
    h = run((pcg_run_options){.strict = true}, TROUBLE_WARN, 5, PCG_STATUS_FAILED,
            "roof 0 of 2.50 m cannot be built (node 'maker', round 1)");
    CHECK_NUMBER(h.warnings, 0);
    CHECK_NUMBER(h.errors, 1);
}

static void notes_come_through(void)
{
    heard h = run((pcg_run_options){0}, TROUBLE_NOTE, 1, PCG_STATUS_OK, "");
    CHECK_NUMBER(h.notes, 1);
    h = run((pcg_run_options){0}, TROUBLE_NOTE, 20000, PCG_STATUS_OK, "");
    CHECK_NUMBER(h.notes, 20000);
}

int main(void)
{
    program = pcg_program_of(&trouble_module);
    each_limit();
    depth_beyond_the_stack();
    failures();
    warnings_are_held_back();
    notes_come_through();
    pcg_program_free(program);
    return unit_done();
}

/* cancel.c - cancelling from another thread, a hundred times; progress; cancelling by progress, and
 * before it runs. */
#include <pthread.h>
#include <time.h>

#include "tests/unit/unit.h"
#include "trouble.h"

enum { TIMES = 100 };

/* The promise is 50 ms. A machine that is busy with other things may wake the threads later: a few
 * may be. */
enum { LATE_ALLOWED = 10 };

static pcg_program *program;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void pause_for(long milliseconds)
{
    const struct timespec t = {milliseconds / 1000, milliseconds % 1000 * 1000000};
    nanosleep(&t, NULL);
}

typedef struct canceller {
    pcg_run *run;
    long after;
    double cancelled;
} canceller;

static void *cancel_later(void *context)
{
    canceller *c = context;
    pause_for(c->after);
    c->cancelled = now();
    pcg_run_cancel(c->run);
    return NULL;
}

/* How long it took from the cancelling to the end, in seconds. */
static double cancel_once(trouble_mode mode, long after)
{
    pthread_t thread;
    canceller c = {.run = trouble_new(program, NULL, mode, 0), .after = after};
    pthread_create(&thread, NULL, cancel_later, &c);
    pcg_status status = pcg_run_execute(c.run);
    double ended = now();
    pthread_join(thread, NULL);
    CHECK_NUMBER(status, PCG_STATUS_CANCELLED);
    CHECK_TEXT(pcg_run_error(c.run), "the run was cancelled");
    CHECK_NUMBER(pcg_run_output_count(c.run, 0), 0);
    pcg_run_free(c.run);
    return ended - c.cancelled;
}

static void cancels_in_time(void)
{
    int late = 0;
    for (int i = 0; i < TIMES; i++)
        late += cancel_once(i % 2 ? TROUBLE_SPIN : TROUBLE_TICK, 1 + i % 7) > 0.05;
    CHECK(late <= LATE_ALLOWED);
}

static void cancels_before_it_runs(void)
{
    pcg_run *r = trouble_new(program, NULL, TROUBLE_SPIN, 0);
    pcg_run_cancel(r);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_CANCELLED);
    pcg_run_free(r);
    pcg_run_cancel(NULL);
}

typedef struct watched {
    int calls, most;
    pcg_progress last;
} watched;

static int watch(void *user, const pcg_progress *p)
{
    watched *w = user;
    w->calls++;
    w->last = *p;
    return w->calls >= w->most;
}

static void tells_progress(void)
{
    watched w = {.most = 3};
    const pcg_run_options options = {.size = sizeof options, .progress = watch, .user = &w};
    pcg_run *r = trouble_new(program, &options, TROUBLE_SPIN, 0);
    double started = now();
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_CANCELLED);
    CHECK(now() - started > 0.25); /* three tenths of a second, but for the clock's grain */
    CHECK_NUMBER(w.calls, 3);
    CHECK_TEXT(w.last.node, "maker");
    CHECK(w.last.rounds > 1000);
    CHECK_NUMBER(w.last.entities, 1);
    CHECK(w.last.memory > 0);
    CHECK(w.last.seconds > 0.25);
    pcg_run_free(r);
}

static void time_limit_in_rounds(void)
{
    const pcg_run_options options = {.size = sizeof options, .max_seconds = 0.05};
    pcg_run *r = trouble_new(program, &options, TROUBLE_SPIN, 0);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_LIMIT);
    CHECK_PART(pcg_run_error(r), "the run took longer than its limit of 0.05 s");
    pcg_run_free(r);
}

int main(void)
{
    program = pcg_program_of(&trouble_module);
    cancels_in_time();
    cancels_before_it_runs();
    tells_progress();
    time_limit_in_rounds();
    pcg_program_free(program);
    return unit_done();
}

/* cancel_examples.c - the example graphs, cancelled anywhere: at rounds that chance picks, and from
 * another thread while they run and are written. Whatever was going on, the run ends as cancelled,
 * and leaves no file, and (where the sanitizer looks) no memory. */
#include <glob.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

enum { TIMES = 4, LARGE = 200000 };

/* How many events of a run there were, the one at which it is cancelled (0: none), and how many
 * rounds began behind that. */
typedef struct watch {
    uint64_t events, cancel_at;
    int late;
} watch;

static uint64_t chance = 88172645463325252u;

static uint64_t below(uint64_t count)
{
    chance ^= chance << 13;
    chance ^= chance >> 7;
    chance ^= chance << 17;
    return chance % count;
}

static void observe(void *user, pcg_run *r, const pcg_event *e)
{
    watch *w = user;
    w->late += w->cancel_at && w->events >= w->cancel_at && e->kind == PCG_EVENT_ROUND;
    if (++w->events == w->cancel_at || (!w->cancel_at && w->events > LARGE))
        pcg_run_cancel(r);
}

static pcg_program *compile(const char *path, bool observed)
{
    const pcg_compile_options options = {.size = sizeof options, .observed = observed};
    pcg_program *p = pcg_compile_file(path, &options);
    CHECK(p != NULL);
    return p;
}

/* Runs it to that event, and looks at what a host may ask then. */
static uint64_t run_observed(const pcg_program *p, uint64_t cancel_at)
{
    watch w = {.cancel_at = cancel_at};
    pcg_run *r = pcg_run_new(p, NULL);
    CHECK_INTEGER(pcg_run_observe(r, observe, &w), PCG_STATUS_OK);
    pcg_status status = pcg_run_execute(r);
    if (cancel_at) {
        bool done = status == PCG_STATUS_OK; /* no round was left */
        CHECK(done || status == PCG_STATUS_CANCELLED);
        CHECK_INTEGER(w.late, 0);
        CHECK_TEXT(pcg_run_error(r), done ? "" : "the run was cancelled");
        CHECK(done || pcg_run_write(r, "cancelled.glb", NULL, NULL) != PCG_STATUS_OK);
        CHECK(access("cancelled.glb", F_OK) != 0);
    }
    pcg_run_free(r);
    return w.events;
}

static void cancel_at_events(const char *path)
{
    pcg_program *p = compile(path, true);
    if (!p)
        return;
    uint64_t events = run_observed(p, 0);
    for (int i = 0; i < TIMES && events > 1; i++)
        run_observed(p, 1 + below(events - 1));
    pcg_program_free(p);
}

static void *cancel_later(void *run)
{
    const struct timespec t = {0, (long)below(20) * 1000000 + 1};
    nanosleep(&t, NULL);
    pcg_run_cancel(run);
    return NULL;
}

/* While it runs or is written: when, the machine says. */
static void cancel_from_thread(const char *path)
{
    pcg_program *p = compile(path, false);
    for (int i = 0; p && i < TIMES; i++) {
        pthread_t thread;
        pcg_run *r = pcg_run_new(p, NULL);
        pthread_create(&thread, NULL, cancel_later, r);
        pcg_status status = pcg_run_execute(r);
        if (status == PCG_STATUS_OK)
            status = pcg_run_write(r, "out.glb", NULL, NULL);
        pthread_join(thread, NULL);
        CHECK(status == PCG_STATUS_OK || status == PCG_STATUS_CANCELLED);
        CHECK((access("out.glb", F_OK) == 0) == (status == PCG_STATUS_OK));
        unlink("out.glb");
        pcg_run_free(r);
    }
    pcg_program_free(p);
}

int main(void)
{
    static const char *const patterns[] = {"examples/lessons/*.pcg", "examples/figures/*.pcg",
                                           "examples/*.pcg"};
    char folder[] = "/tmp/pcgc-cancel-XXXXXX", pattern[4096];
    const char *root = getenv("ROOT");
    if (!mkdtemp(folder) || chdir(folder) != 0)
        return 1;
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s/%s", root ? root : ".", patterns[i]);
        CHECK(glob(pattern, 0, NULL, &found) == 0);
        for (size_t k = 0; k < found.gl_pathc; k++) {
            cancel_at_events(found.gl_pathv[k]);
            cancel_from_thread(found.gl_pathv[k]);
        }
        globfree(&found);
    }
    if (chdir("/") != 0 || rmdir(folder) != 0)
        CHECK(!"nothing is left in the folder");
    return unit_done();
}

/* cancel_write.c - cancelling in the middle of writing, from another thread: it ends in time,
 * leaves no file, not even a part of one, and the run can still be read, and written again. */
#include <dirent.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

/* The promise is 50 ms. What the writing thread itself still does is held to it; on a machine that
 * is busy with other things the clock on the wall says more. */
enum { TIMES = 100, FASTEST_TIMES = 2 };
static const double promise = 0.05, patience = 2;

static const char graph[] =
    "graph boxes {\n"
    "    rectangle(width = 250m, height = 250m)\n"
    "        -> rows: split(axis = y, repeat = true) { absolute(2m) }\n"
    "        -> tiles: split(axis = x, repeat = true) { absolute(2m) }\n"
    "        -> extrude(amount = rand(1m, 9m))\n"
    "}\n";
enum { FACES = 125 * 125 * 6 };
static const char *const formats[] = {"glb", "obj", "json", "png"};
enum { FORMATS = sizeof formats / sizeof formats[0] };

/* A small picture is enough; of each entity a line of JSON. */
static const pcg_write_options how = {
    .size = sizeof how, .width = 160, .height = 120, .entities = true};

static pcg_program *program;

static double now(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

typedef struct canceller {
    pcg_run *run;
    clockid_t writer; /* the time that the writing thread has worked */
    double after, wall, worked; /* when it was cancelled, by both clocks */
} canceller;

static void *cancel_later(void *context)
{
    canceller *c = context;
    const struct timespec t = {(time_t)c->after,
                               (long)((c->after - (double)(time_t)c->after) * 1e9)};
    nanosleep(&t, NULL);
    c->wall = now(CLOCK_MONOTONIC);
    c->worked = now(c->writer);
    pcg_run_cancel(c->run);
    return NULL;
}

static pcg_run *executed(void)
{
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    return r;
}

static void file_name(char *to, size_t size, const char *format)
{
    snprintf(to, size, "boxes.%s", format);
}

static int files_here(void)
{
    DIR *d = opendir(".");
    int count = 0;
    for (struct dirent *e; d && (e = readdir(d));)
        count += strcmp(e->d_name, ".") && strcmp(e->d_name, "..");
    if (d)
        closedir(d);
    return count;
}

/* How long it takes to write, when nobody cancels; the quickest of some. */
static double write_time(const char *format)
{
    char name[32];
    double fastest = 1e9;
    file_name(name, sizeof name, format);
    pcg_run *r = executed();
    for (int i = 0; i < FASTEST_TIMES; i++) {
        double begun = now(CLOCK_MONOTONIC);
        CHECK_INTEGER(pcg_run_write(r, name, NULL, &how), PCG_STATUS_OK);
        fastest = fmin(fastest, now(CLOCK_MONOTONIC) - begun);
        unlink(name);
    }
    unlink("boxes.mtl");
    pcg_run_free(r);
    return fastest;
}

/* How long it worked from the cancelling to the end; 0 where that came too late. */
static double cancel_once(const char *format, double after, int *cancelled)
{
    char name[32];
    pthread_t thread;
    canceller c = {.run = executed(), .after = after};
    pthread_getcpuclockid(pthread_self(), &c.writer);
    file_name(name, sizeof name, format);
    pthread_create(&thread, NULL, cancel_later, &c);
    pcg_status status = pcg_run_write(c.run, name, NULL, &how);
    double wall = now(CLOCK_MONOTONIC), worked = now(c.writer);
    pthread_join(thread, NULL);
    CHECK(status == PCG_STATUS_CANCELLED || status == PCG_STATUS_OK);
    if (status == PCG_STATUS_CANCELLED) {
        ++*cancelled;
        CHECK_INTEGER(files_here(), 0);
        CHECK(wall - c.wall < patience);
        CHECK_INTEGER(pcg_run_face_count(c.run), FACES);
    }
    unlink(name);
    unlink("boxes.mtl");
    pcg_run_free(c.run);
    return status == PCG_STATUS_CANCELLED ? worked - c.worked : 0;
}

/* As tests/run.py tells. */
static bool draws(void)
{
    const char *left_out = getenv("LEFT_OUT");
    return !left_out || !strstr(left_out, "png");
}

int main(void)
{
    char folder[] = "/tmp/pcgc-cancel-XXXXXX";
    double times[FORMATS] = {0}, worst = 0;
    const int models = FORMATS - 1, count = draws() ? FORMATS : models;
    int cancelled = 0;
    program = pcg_compile_text(graph, sizeof graph - 1, "boxes.pcg", NULL);
    CHECK(program != NULL);
    if (!program || !mkdtemp(folder) || chdir(folder) != 0)
        return 1;
    for (int f = 0; f < count; f++)
        times[f] = write_time(formats[f]);
    for (int i = 0; i < TIMES; i++) {
        int f = i % 16 == 15 ? count - 1 : i % models; /* few pictures: they are slow */
        double took = cancel_once(formats[f], (i / 4 % 8 + 0.5) / 8 * times[f], &cancelled);
        worst = fmax(worst, took);
    }
    printf("written in %.0f, %.0f, %.0f, %.0f ms; %d of %d cancelled, the slowest in %.1f ms\n",
           1e3 * times[0], 1e3 * times[1], 1e3 * times[2], 1e3 * times[3], cancelled, TIMES,
           1e3 * worst);
    CHECK(worst < promise);
    CHECK(cancelled >= TIMES / 2);
    CHECK(chdir("/") == 0 && rmdir(folder) == 0);
    pcg_program_free(program);
    return unit_done();
}

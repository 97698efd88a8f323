/* io_output.c - files appear whole or not at all, and nothing else is left behind. */
#include <pthread.h>
#include <sys/stat.h>
#include <time.h>

#include "stdlib/io/io.h"
#include "tests/unit/io_studio.h"

static void build(studio *s)
{
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(1, 2, 3), NULL));
}

static void replaces_what_was_there(const studio_result *r)
{
    studio_write("a.json", "old", 3);
    CHECK_INTEGER(pcg_run_write(r->run, studio_path("a.json"), NULL, NULL), PCG_STATUS_OK);
    char *content = studio_read("a.json", NULL);
    CHECK(content && strncmp(content, "{\"version\":1", 12) == 0);
    free(content);
    CHECK_INTEGER(studio_files(1), 1);
}

static void keeps_links(const studio_result *r)
{
    struct stat s;
    studio_write("real.json", "old", 3);
    CHECK_INTEGER(symlink("real.json", studio_path("link.json")), 0);
    CHECK_INTEGER(pcg_run_write(r->run, studio_path("link.json"), NULL, NULL), PCG_STATUS_OK);
    CHECK(lstat(studio_path("link.json"), &s) == 0 && S_ISLNK(s.st_mode));
    CHECK(lstat(studio_path("real.json"), &s) == 0 && S_ISREG(s.st_mode) && s.st_size > 3);
    CHECK_INTEGER(studio_files(1), 2);
}

static void leaves_devices_alone(const studio_result *r)
{
    struct stat s;
    CHECK_INTEGER(pcg_run_write(r->run, "/dev/null", "glb", NULL), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_write(r->run, "/dev/null", "obj", NULL), PCG_STATUS_OK);
    CHECK(stat("/dev/null", &s) == 0 && S_ISCHR(s.st_mode));
}

static void says_why_not(const studio_result *r)
{
    char expected[700];
    CHECK_INTEGER(pcg_run_write(r->run, studio_path("no/where.glb"), NULL, NULL),
                  PCG_STATUS_MISUSE);
    snprintf(expected, sizeof expected, "cannot write '%s': No such file or directory",
             studio_path("no/where.glb"));
    CHECK_TEXT(pcg_run_error(r->run), expected);
    CHECK_INTEGER(pcg_run_write(r->run, studio_folder, "json", NULL), PCG_STATUS_MISUSE);
    snprintf(expected, sizeof expected, "cannot write '%s': Is a directory", studio_folder);
    CHECK_TEXT(pcg_run_error(r->run), expected);
    CHECK_INTEGER(pcg_run_write(r->run, "house.stl", NULL, NULL), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r->run), "the name 'house.stl' does not say in which format; end it "
                                      "with .glb, .obj, .png, .json or .csv, or name one");
    CHECK_INTEGER(pcg_run_write(r->run, "x.d/house", NULL, NULL), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_write(r->run, "house.glb", "stl", NULL), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r->run), "unknown format 'stl'; there are glb, obj, png, json and csv");
    CHECK_INTEGER(pcg_run_write(r->run, "", NULL, NULL), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_write(NULL, "a.glb", NULL, NULL), PCG_STATUS_MISUSE);
    CHECK_INTEGER(studio_files(0), 0);
}

static void full_disk_is_an_error(const studio_result *r)
{
    if (access("/dev/full", W_OK) != 0)
        return;
    CHECK_INTEGER(pcg_run_write(r->run, "/dev/full", "json", NULL), PCG_STATUS_FAILED);
    CHECK_TEXT(pcg_run_error(r->run), "cannot write '/dev/full': No space left on device");
}

static void nothing_before_it_ran(void)
{
    pcg_program *p = pcg_program_of(&studio_module);
    pcg_run *r = pcg_run_new(p, NULL);
    CHECK_INTEGER(pcg_run_write(r, studio_path("early.glb"), NULL, NULL), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "the graph has not run yet: nothing to write");
    CHECK_INTEGER(studio_files(0), 0);
    pcg_run_free(r);
    pcg_program_free(p);
}

/* The old file stays as it was. */
static void cancelled_leaves_nothing(void)
{
    static const char *const names[] = {"c.glb", "c.obj", "c.png", "c.json"};
    studio_result r = studio_make(build);
    studio_write("c.glb", "old", 3);
    pcg_run_cancel(r.run);
    for (int i = 0; i < 4; i++)
        CHECK_INTEGER(pcg_run_write(r.run, studio_path(names[i]), NULL, NULL),
                      PCG_STATUS_CANCELLED);
    char *content = studio_read("c.glb", NULL);
    CHECK_TEXT(content, "old");
    free(content);
    CHECK_INTEGER(studio_files(1), 1);
    studio_free(&r);
}

/* ---- cancelling while it is written ---------------------------------------------------------- */

static void build_large(studio *s)
{
    const pcg_material *look = studio_material(s, "stone", 0.5, 0.5, 0.5, NULL);
    for (int i = 0; i < 200000; i++)
        studio_emit(s, studio_box(s, vec3(i % 500, i / 500, 0), vec3(0.7, 0.7, 1 + i % 5), look));
}

static double seconds_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

typedef struct canceller {
    pcg_run *run;
    long after;                  /* milliseconds */
    double cancelled;
} canceller;

static void *cancel_later(void *context)
{
    canceller *c = context;
    const struct timespec t = {0, c->after * 1000000};
    nanosleep(&t, NULL);
    c->cancelled = seconds_now();
    pcg_run_cancel(c->run);
    return NULL;
}

/* What is promised is 50 ms; a machine that does other things, too, may take longer. */
static void cancelled_while_it_writes(void)
{
    static const char *const names[] = {"d.png", "d.glb", "d.obj", "d.json"};
    const pcg_write_options each = {.size = sizeof each, .entities = true};
    for (int i = 0; i < 4; i++) {
        studio_result r = studio_make(build_large);
        canceller c = {.run = r.run, .after = i ? 5 : 150};
        pthread_t thread;
        pthread_create(&thread, NULL, cancel_later, &c);
        pcg_status status = pcg_run_write(r.run, studio_path(names[i]), NULL, &each);
        double ended = seconds_now();
        pthread_join(thread, NULL);
        CHECK(status == PCG_STATUS_CANCELLED || strstr(pcg_run_error(r.run), "left out"));
        CHECK(ended - c.cancelled < 1);
        CHECK_INTEGER(studio_files(0), 0);
        studio_free(&r);
    }
}

static void (*const writers[])(io_job *j, const char *path) = {io_write_glb, io_write_obj,
                                                               io_write_json, io_write_picture};

/* Writes with so much memory and no more; true when that was enough. */
static bool write_within(pcg_run *run, void (*write)(io_job *j, const char *path), size_t limit)
{
    static io_job j; /* not in the frame that is jumped to */
    volatile bool done = false;
    memset(&j, 0, sizeof j);
    j.run = run;
    j.module = result_module(run);
    j.options = (pcg_write_options){.size = sizeof j.options, .width = 32, .height = 24};
    j.memory.limit = limit;
    if (setjmp(j.out_of_memory) == 0) {
        j.memory.on_failure = &j.out_of_memory;
        write(&j, studio_path("m.out"));
        outputs_end(&j);
        done = true;
    } else {
        outputs_discard(&j);
    }
    pcg_triangulator_free(j.triangulator);
    image_libraries_close(&j);
    arena_free(&j.memory);
    return done;
}

/* Wherever it ends: no crash, and no file. */
static void memory_may_run_out_anywhere(const studio_result *r)
{
    for (int i = 0; i < 4; i++) {
        size_t limit = 1 << 10;
        while (limit < (size_t)1 << 30 && !write_within(r->run, writers[i], limit)) {
            CHECK_INTEGER(studio_files(1), 0);
            limit += limit / 8;
        }
        CHECK(limit < 1 << 30); /* enough of it is always enough */
        studio_files(1);
    }
}

int main(void)
{
    studio_open_folder();
    studio_result r = studio_make(build);
    replaces_what_was_there(&r);
    keeps_links(&r);
    leaves_devices_alone(&r);
    says_why_not(&r);
    full_disk_is_an_error(&r);
    memory_may_run_out_anywhere(&r);
    studio_free(&r);
    nothing_before_it_ran();
    cancelled_leaves_nothing();
    cancelled_while_it_writes();
    studio_close_folder();
    return unit_done();
}

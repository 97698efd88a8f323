/* command_watch.c - pcgc watch: runs a graph, and again whenever a file is saved that it was made
 * of. */
#include <errno.h>
#include <string.h>
#include <time.h>

#include "command_run.h"
#include "watch.h"

enum { CHANGED_NAMED = 4 };

typedef struct watching {
    const running *settings;
    const char *path;
    watch watch;
    int error; /* an errno: a file cannot be watched; 0: all can */
} watching;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void on_found(void *user, const char *path)
{
    watching *w = user;
    jmp_buf out_of_memory, *before = w->watch.arena->on_failure;
    w->watch.arena->on_failure = &out_of_memory; /* no jump out of a run */
    errno = 0;
    if (setjmp(out_of_memory))
        w->error = ENOMEM;
    else if (!watch_add(&w->watch, path) && !w->error)
        w->error = errno;
    w->watch.arena->on_failure = before;
}

static const char *plural(uint64_t n)
{
    return n == 1 ? "" : "s";
}

static void print_line(const watching *w, const run_outcome *o, int code, double seconds)
{
    fprintf(stderr, "%s: ", w->path);
    if (o->executed)
        fprintf(stderr, "%zu entit%s, %zu face%s, ", o->entities, o->entities == 1 ? "y" : "ies",
                o->faces, plural(o->faces));
    fprintf(stderr, "%u error%s, %u warning%s, %.0f ms%s\n", o->errors, plural(o->errors),
            o->warnings, plural(o->warnings), 1e3 * seconds, code == EXIT_DONE ? "" : "; waiting");
}

static int run_once(watching *w)
{
    running k = *w->settings;
    double began = now();
    k.found = on_found;
    k.user = w;
    k.watched = true;
    watch_begin(&w->watch);
    int code = run_file(&k, w->path);
    if (code != EXIT_INTERRUPTED)
        print_line(w, &k.outcome, code, now() - began);
    return code;
}

static void print_changes(const watching *w)
{
    uint32_t named = 0, more = 0;
    fprintf(stderr, "changed: ");
    for (uint32_t i = 0; i < w->watch.paths.entries.count; i++) {
        const watched_path *p = w->watch.paths.entries.at[i].value;
        if (p->changed && named == CHANGED_NAMED)
            more++;
        else if (p->changed)
            fprintf(stderr, "%s%s", named++ ? ", " : "", p->path);
    }
    if (more)
        fprintf(stderr, " and %u more", (unsigned)more);
    fputc('\n', stderr);
}

/* While nothing runs, Ctrl+C ends the process: nothing is left to be finished. */
static bool wait_for_changes(watching *w)
{
    interrupt guard = {0};
    interrupt_begin(&guard, "pcgc");
    bool changed = watch_wait(&w->watch);
    interrupt_end(&guard);
    return changed;
}

static int watch_file(watching *w)
{
    for (;;) {
        int code = run_once(w);
        if (code == EXIT_INTERRUPTED)
            return code;
        on_found(w, w->path);
        if (w->error)
            return tool_error(EXIT_USAGE, "cannot watch the files of '%s': %s", w->path,
                              strerror(w->error));
        if (!wait_for_changes(w))
            return tool_error(EXIT_USAGE, "cannot wait for changes: %s", strerror(errno));
        print_changes(w);
    }
}

static int open_and_watch(const running *settings, arena *a, const char *path)
{
    watching w = {.settings = settings, .path = path};
    if (!strcmp(path, "-"))
        return usage_error(&command_watch, "standard input cannot be watched: name a file");
    if (!watch_open(&w.watch, a))
        return tool_error(EXIT_USAGE, "cannot watch files: %s", strerror(errno));
    w.watch.ignored = settings->outputs.at;
    w.watch.ignored_count = settings->outputs.count;
    int code = watch_file(&w);
    watch_close(&w.watch);
    return code;
}

static int run_watch(const command *self, int argc, char **argv)
{
    arena a = {0};
    jmp_buf out_of_memory;
    running settings = {0};
    const char *path;
    int code;
    if (setjmp(out_of_memory)) {
        code = tool_error(EXIT_LIMIT, "out of memory");
    } else {
        a.on_failure = &out_of_memory;
        code = run_options(self, &a, &settings, argc, argv, &path);
        if (code < 0)
            code = open_and_watch(&settings, &a, path);
    }
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc watch house.pcg -o house.glb",
                                       "pcgc watch house.pcg -p height=12m -o house.png", NULL};
const command command_watch = {"watch", "[FILE]",
                               "Runs a graph as `pcgc run` does, and again on every save: of the graph, of what it\n"
                               "imports, of textures, maps and folders that it reads. Ctrl+C ends it.",
                               examples, run_watch};

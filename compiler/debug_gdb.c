/* debug_gdb.c - pcgc debug --gdb: the graph as a shared object with what gdb needs to know of its
 * lines, run under gdb. */
#include <errno.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "backend.h"
#include "debug.h"

extern char **environ;

typedef LIST(const char *) words;

typedef struct gdb_session {
    running *k;
    const debug_input *input;
    arena memory;
    const char *folder; /* of what is made for the session; NULL: there is none */
    interrupt_file unfinished;
    const char *object, *name;
} gdb_session;

/* ---- the shared object ----------------------------------------------------------------------- */

static int make_folder(gdb_session *g)
{
    const char *where = getenv("TMPDIR");
    char *folder = arena_format(&g->memory, "%s/pcgc-XXXXXX", where && *where ? where : "/tmp");
    interrupt_lock(&g->k->t.guard);
    g->folder = mkdtemp(folder);
    if (g->folder)
        interrupt_keep(&g->k->t.guard, &g->unfinished, g->folder);
    interrupt_unlock(&g->k->t.guard);
    return g->folder
               ? EXIT_DONE
               : tool_error(EXIT_USAGE, "cannot make a temporary folder: %s", strerror(errno));
}

/* The C that was emitted lies beside the object: gdb shows it for what has no line in the graph. */
static int write_object(gdb_session *g, const program *p, const text *c_text)
{
    running *k = g->k;
    char *error = NULL;
    const char *c_path = arena_format(&g->memory, "%s/%s.c", g->folder, p->main->symbol);
    g->object = arena_format(&g->memory, "%s/%s.so", g->folder, p->main->symbol);
    if (!tool_write(&k->t.guard, c_path, c_text->at, c_text->length))
        return EXIT_USAGE;
    if (write_debuggable(p, c_text->at, g->object, "cc", &k->t.guard, &error))
        return EXIT_DONE;
    int code = tool_error(EXIT_USAGE, "cannot compile for gdb: %s", error ? error : "");
    free(error);
    return code;
}

static int build(void *context, const char *path)
{
    gdb_session *g = context;
    running *k = g->k;
    text c_text = {0};
    int code;
    program *p = tool_compile(&k->t, path, &code);
    if (!p)
        return code;
    if (k->node && !cut_at_node(p, k->node))
        return tool_error(EXIT_USAGE, "graph '%s' has no node '%s'", p->main->name, k->node);
    if (k->node)
        order(&k->t.compilation, p);
    if (!tool_emit(&k->t, p, &c_text))
        return EXIT_NO;
    code = make_folder(g);
    return code == EXIT_DONE ? write_object(g, p, &c_text) : code;
}

/* ---- the command line ------------------------------------------------------------------------ */

static void add(gdb_session *g, words *line, const char *word)
{
    LIST_ADD(&g->memory, line, word);
}

static void add_command(gdb_session *g, words *line, const char *command_line)
{
    add(g, line, "-ex");
    add(g, line, command_line);
}

static void add_texts(gdb_session *g, words *line, const char *name, const option_texts *texts)
{
    for (size_t i = 0; i < texts->count; i++) {
        add(g, line, name);
        add(g, line, texts->at[i]);
    }
}

static void add_limit(gdb_session *g, words *line, const char *name, uint64_t limit)
{
    if (!limit)
        return;
    add(g, line, name);
    add(g, line, arena_format(&g->memory, "%llu", (unsigned long long)limit));
}

/* `pcgc run` of the object, with all that it was asked for. */
static void add_run(gdb_session *g, words *line)
{
    const running *k = g->k;
    char self[4096];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self);
    add(g, line, length > 0 ? arena_copy(&g->memory, self, (size_t)length) : "pcgc");
    add(g, line, "run");
    add(g, line, g->object);
    add_texts(g, line, "-p", &k->parameters);
    add_texts(g, line, "-o", &k->outputs);
    add_texts(g, line, "-L", &k->t.libraries);
    add_limit(g, line, "--seed", k->seed);
    add_limit(g, line, "--max-rounds", k->max_rounds);
    add_limit(g, line, "--max-entities", k->max_entities);
    add_limit(g, line, "--max-depth", k->max_depth);
    add_limit(g, line, "--max-memory", k->max_memory);
    if (k->max_seconds > 0) {
        text seconds = {.arena = &g->memory};
        text_number(&seconds, k->max_seconds);
        add(g, line, "--max-seconds");
        add(g, line, seconds.at);
    }
    if (k->format) {
        add(g, line, "-f");
        add(g, line, k->format);
    }
    if (k->entities)
        add(g, line, "--entities");
    if (k->strict)
        add(g, line, "--strict");
}

/* Each command of -x is one of gdb's. */
static void add_commands(gdb_session *g, words *line)
{
    for (size_t i = 0; i < g->input->lines.count; i++) {
        const char *at = g->input->lines.at[i];
        while (*at) {
            size_t length = strcspn(at, ";\n");
            add_command(g, line, arena_copy(&g->memory, at, length));
            at += length + (at[length] != '\0');
        }
    }
    if (g->input->path) {
        add(g, line, "-x");
        add(g, line, g->input->path);
    }
}

static words gdb_line(gdb_session *g)
{
    words line = {0};
    add(g, &line, "gdb");
    add(g, &line, "-q");
    if (g->input->lines.count || g->input->path)
        add(g, &line, "-batch");
    add(g, &line, "-iex");
    add(g, &line, "set debuginfod enabled off");
    add_command(g, &line, "set breakpoint pending on");
    add_command(g, &line, arena_format(&g->memory, "directory %s", g->folder));
    add_commands(g, &line);
    add(g, &line, "--args");
    add_run(g, &line);
    add(g, &line, NULL);
    return line;
}

/* ---- the session ----------------------------------------------------------------------------- */

/* Ctrl+C is gdb's: it stops what gdb runs. */
static bool leave_to_gdb(void *user)
{
    (void)user;
    return true;
}

static int wait_for(pid_t child)
{
    int state = 0;
    pid_t ended;
    do {
        ended = waitpid(child, &state, 0);
    } while (ended < 0 && errno == EINTR);
    return ended == child && WIFEXITED(state) ? WEXITSTATUS(state) : EXIT_RUN_FAILED;
}

/* Signals reach gdb as they reached this process before it was guarded. */
static int run_gdb(gdb_session *g)
{
    interrupt *guard = &g->k->t.guard;
    posix_spawnattr_t attributes;
    pid_t child;
    words line = gdb_line(g);
    interrupt_lock(guard);
    guard->pause = leave_to_gdb;
    interrupt_unlock(guard);
    int error = posix_spawnattr_init(&attributes);
    if (!error) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
        posix_spawnattr_setsigmask(&attributes, &guard->before);
        error =
            posix_spawnp(&child, "gdb", NULL, &attributes, (char **)(uintptr_t)line.at, environ);
        posix_spawnattr_destroy(&attributes);
    }
    if (error)
        return tool_error(EXIT_USAGE, "cannot run gdb: %s; without --gdb, pcgc debugs by itself",
                          strerror(error));
    return wait_for(child);
}

static int session(void *context, const char *path)
{
    gdb_session *g = context;
    g->memory.on_failure = &g->k->t.out_of_memory;
    int code = build(g, path);
    return code == EXIT_DONE ? run_gdb(g) : code;
}

int debug_by_gdb(const command *self, running *k, const debug_input *input, const char *path)
{
    gdb_session g = {.k = k, .input = input};
    k->t.quiet = true;
    if (is_shared_object(path))
        return usage_error(self, "it needs the source; '%s' is compiled", path);
    int code = tool_begin(&k->t, self);
    if (code >= 0)
        return code;
    code = tool_guarded(&k->t, path, session, &g);
    interrupt_lock(&k->t.guard);
    if (g.folder)
        interrupt_remove(g.folder);
    interrupt_drop(&k->t.guard, &g.unfinished);
    interrupt_unlock(&k->t.guard);
    arena_free(&g.memory);
    return tool_end(&k->t, code);
}

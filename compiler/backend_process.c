/* backend_process.c - running a compiler without a shell; files that appear whole or not at all. */
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "backend.h"

extern char **environ;

/* ---- processes ------------------------------------------------------------------------------- */

typedef LIST(char *) words;

/* The words of the command, then the arguments, then NULL. */
static words command_line(arena *a, const char *cc, const char *const *arguments)
{
    words line = {0};
    for (const char *at = cc; *at;) {
        size_t length = strcspn(at, " \t");
        if (length > 0) {
            LIST_ADD(a, &line, arena_copy(a, at, length));
        }
        at += length + strspn(at + length, " \t");
    }
    for (; *arguments; arguments++) {
        LIST_ADD(a, &line, arena_copy(a, *arguments, strlen(*arguments)));
    }
    LIST_ADD(a, &line, NULL);
    return line;
}

/* Compilers keep files there while they work, and may leave them behind when they are stopped. */
typedef struct scratch {
    interrupt *guard;
    interrupt_file unfinished;
    char *folder; /* NULL: there is none */
} scratch;

static void scratch_begin(scratch *s, arena *a, interrupt *guard)
{
    const char *where = getenv("TMPDIR");
    char *folder = arena_format(a, "%s/pcgc-XXXXXX", where && *where ? where : "/tmp");
    s->guard = guard;
    interrupt_lock(guard);
    s->folder = mkdtemp(folder);
    if (s->folder) {
        interrupt_keep(guard, &s->unfinished, s->folder);
    }
    interrupt_unlock(guard);
}

static void scratch_end(scratch *s)
{
    interrupt_lock(s->guard);
    if (s->folder) {
        interrupt_remove(s->folder);
    }
    interrupt_drop(s->guard, &s->unfinished);
    interrupt_unlock(s->guard);
}

/* This process's, with TMPDIR set. */
static char **environment(arena *a, const char *temporary)
{
    words all = {0};
    for (char **at = environ; *at; at++) {
        if (strncmp(*at, "TMPDIR=", 7) != 0) {
            LIST_ADD(a, &all, *at);
        }
    }
    LIST_ADD(a, &all, arena_format(a, "TMPDIR=%s", temporary));
    LIST_ADD(a, &all, NULL);
    return all.at;
}

/* Signals reach it as they reached this process before it was guarded; it leads a process group,
 * so that the guard finds what it starts. */
static int set_group(posix_spawnattr_t *attributes, const interrupt *guard)
{
    const short flags = POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK;
    if (!guard) {
        return 0;
    }
    int error = posix_spawnattr_setflags(attributes, flags);
    error = error ? error : posix_spawnattr_setpgroup(attributes, 0);
    return error ? error : posix_spawnattr_setsigmask(attributes, &guard->before);
}

static int redirect(posix_spawn_file_actions_t *actions, int in, int out)
{
    int error = posix_spawn_file_actions_adddup2(actions, in, STDIN_FILENO);
    error = error ? error : posix_spawn_file_actions_adddup2(actions, out, STDOUT_FILENO);
    return error ? error : posix_spawn_file_actions_adddup2(actions, out, STDERR_FILENO);
}

/* Starts it with `in` as its input, and `out` as its output and for its messages. An errno. */
static int start(char **line, char **variables, int in, int out, interrupt *guard, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int error = posix_spawn_file_actions_init(&actions);
    if (error) {
        return error;
    }
    error = posix_spawnattr_init(&attributes);
    if (!error) {
        error = redirect(&actions, in, out);
        error = error ? error : set_group(&attributes, guard);
        interrupt_lock(guard);
        error =
            error ? error : posix_spawnp(child, line[0], &actions, &attributes, line, variables);
        interrupt_child(guard, error ? 0 : *child);
        interrupt_unlock(guard);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

static void take_messages(FILE *out, complaint *c)
{
    char buffer[4096];
    size_t length;
    rewind(out);
    while ((length = fread(buffer, 1, sizeof buffer, out)) > 0) {
        complain(c, "%.*s", (int)length, buffer);
    }
    while (c->length && c->text[c->length - 1] == '\n') {
        c->text[--c->length] = '\0';
    }
}

/* Waits for the child; true where it ended with 0. */
static bool succeeded(pid_t child, interrupt *guard)
{
    int state;
    pid_t ended;
    do {
        ended = waitpid(child, &state, 0);
    } while (ended < 0 && errno == EINTR);
    interrupt_lock(guard); /* for good, where it ended because the guard ends everything */
    interrupt_child(guard, 0);
    interrupt_unlock(guard);
    return ended == child && WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

static bool run_with_files(char **line, char **variables, FILE *in, FILE *out, complaint *c,
                           bool *missing, interrupt *guard)
{
    pid_t child;
    int error = start(line, variables, fileno(in), fileno(out), guard, &child);
    if (error) {
        if (missing) {
            *missing = error == ENOENT;
        }
        complain(c, "cannot run '%s': %s", line[0], strerror(error));
        return false;
    }
    if (succeeded(child, guard)) {
        return true;
    }
    take_messages(out, c);
    if (!c->text) {
        complain(c, "'%s' failed without saying why", line[0]);
    }
    return false;
}

static bool fill(FILE *in, const char *input)
{
    size_t length = strlen(input);
    if (fwrite(input, 1, length, in) != length || fflush(in) != 0) {
        return false;
    }
    rewind(in);
    return true;
}

bool run_compiler(const char *cc, const char *const *arguments, const char *input, complaint *c,
                  bool *missing, interrupt *guard)
{
    arena memory = {0};
    jmp_buf out_of_memory;
    FILE *volatile in = tmpfile(), *volatile out = tmpfile();
    volatile bool done = false;
    scratch *own = ARENA_NEW(&memory, scratch);
    memory.on_failure = &out_of_memory;
    if (setjmp(out_of_memory)) {
        complain(c, "out of memory");
    } else if (!own || !in || !out || !fill(in, input)) {
        complain(c, "cannot write a temporary file: %s", strerror(errno));
    } else {
        words line = command_line(&memory, cc, arguments);
        scratch_begin(own, &memory, guard);
        if (!own->folder) {
            complain(c, "cannot make a temporary folder: %s", strerror(errno));
        } else if (line.at[0]) {
            char **variables = environment(&memory, own->folder);
            done = run_with_files(line.at, variables, in, out, c, missing, guard);
        } else {
            complain(c, "no compiler is named");
        }
    }
    if (in) {
        fclose(in);
    }
    if (out) {
        fclose(out);
    }
    if (own) {
        scratch_end(own);
    }
    arena_free(&memory);
    return done;
}

/* ---- files ----------------------------------------------------------------------------------- */

void partial_begin(partial_file *f, arena *a, const char *path, const char *suffix,
                   interrupt *guard)
{
    f->guard = guard;
    f->name = arena_format(a, "%s.%ld.part%s", path, (long)getpid(), suffix);
    interrupt_lock(guard);
    interrupt_keep(guard, &f->unfinished, f->name);
    interrupt_unlock(guard);
}

bool partial_end(partial_file *f, bool complete, const char *path, complaint *c)
{
    interrupt_lock(f->guard);
    bool named = complete && rename(f->name, path) == 0;
    if (complete && !named) {
        complain(c, "%s", strerror(errno));
    }
    if (!named) {
        unlink(f->name);
    }
    interrupt_drop(f->guard, &f->unfinished);
    interrupt_unlock(f->guard);
    return named;
}

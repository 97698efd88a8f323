/* tool.c - what the subcommands share: reading and compiling a graph, messages, timings. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "backend.h"
#include "tool.h"

/* A compilation that needs more than this is stopped; 10,000 nodes take a few megabytes. */
enum { TOOL_MAX_ARENA_MIB = 4096 };

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void lap(void *user, const char *pass)
{
    tool_lap(user, pass);
}

bool tool_colour(void)
{
    const char *no = getenv("NO_COLOR");
    return isatty(STDERR_FILENO) && !(no && *no);
}

const char *path_extension(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    return dot && dot[1] && dot != path && dot[-1] != '/' ? dot + 1 : "";
}

const char *const *tool_paths(arena *a, const option_texts *texts)
{
    const char **paths = ARENA_ARRAY(a, const char *, texts->count + 1);
    if (texts->count)
        memcpy(paths, texts->at, texts->count * sizeof *paths);
    return paths;
}

int tool_begin(tool *t, const command *c)
{
    if (t->message_format && strcmp(t->message_format, "json") && strcmp(t->message_format, "text"))
        return usage_error(c, "option '--message-format' takes text or json, not '%s'",
                           t->message_format);
    t->json_messages = t->message_format && !strcmp(t->message_format, "json");
    compilation *k = &t->compilation;
    k->arena.limit = (size_t)TOOL_MAX_ARENA_MIB << 20;
    k->arena.on_failure = &t->out_of_memory;
    k->diagnostics.arena = &k->arena;
    k->graph = t->graph;
    k->lap = lap;
    k->user = t;
    k->import_paths = tool_paths(&k->arena, &t->imports);
    k->library_paths = tool_paths(&k->arena, &t->libraries);
    t->started = seconds(CLOCK_MONOTONIC);
    t->processor_started = seconds(CLOCK_PROCESS_CPUTIME_ID);
    t->guard = (interrupt){0};
    progress_begin(&t->progress, &t->guard, t->quiet);
    interrupt_begin(&t->guard, "pcgc");
    return -1;
}

int tool_end(tool *t, int code)
{
    progress_end(&t->progress);
    bool interrupted = interrupt_end(&t->guard);
    compilation_end(&t->compilation);
    return interrupted ? EXIT_INTERRUPTED : code;
}

void tool_lap(tool *t, const char *name)
{
    double at = seconds(CLOCK_MONOTONIC), passed = at - t->started;
    double processor = seconds(CLOCK_PROCESS_CPUTIME_ID), spent = processor - t->processor_started;
    t->started = at;
    t->processor_started = processor;
    for (uint32_t i = 0; i < t->times.count; i++)
        if (!strcmp(t->times.at[i].name, name)) {
            t->times.at[i].seconds += passed;
            t->processor.at[i] += spent;
            return;
        }
    pcg_timing timing = {name, passed};
    LIST_ADD(&t->compilation.arena, &t->times, timing);
    LIST_ADD(&t->compilation.arena, &t->processor, spent);
}

void tool_print_timings(tool *t)
{
    progress_hide(&t->progress);
    double sum = 0;
    for (uint32_t i = 0; i < t->times.count; i++) {
        fprintf(stderr, "%-10s %9.3f ms\n", t->times.at[i].name, 1e3 * t->times.at[i].seconds);
        sum += t->times.at[i].seconds;
    }
    fprintf(stderr, "%-10s %9.3f ms\n", "total", 1e3 * sum);
}

void tool_print_diagnostics(tool *t)
{
    const diagnostics *all = &t->compilation.diagnostics;
    diagnostics fresh = *all;
    if (t->printed.count)
        fresh.list.at += t->printed.count;
    fresh.list.count -= t->printed.count;
    fresh.errors -= t->printed.errors;
    fresh.warnings -= t->printed.warnings;
    t->printed.count = all->list.count;
    t->printed.errors = all->errors;
    t->printed.warnings = all->warnings;
    if (!fresh.list.count && !fresh.errors && !fresh.warnings)
        return;
    progress_hide(&t->progress);
    if (t->json_messages)
        diagnostics_print_json(&fresh, stderr);
    else
        diagnostics_print(&fresh, stderr, tool_colour());
}

/* A file, or standard input where the path is "-". NULL: it was told why. */
static source *read_source(compilation *c, const char *path)
{
    bool standard_input = !strcmp(path, "-");
    if (c->found)
        c->found(c->found_user, path);
    source *s = source_read(&c->arena, standard_input ? "/dev/stdin" : path, LANG_MAX_BYTES);
    if (!s && errno == EFBIG)
        tool_error(EXIT_USAGE, "'%s' is larger than %d MiB", path, LANG_MAX_BYTES >> 20);
    else if (!s)
        tool_error(EXIT_USAGE, "cannot read '%s': %s", path, strerror(errno));
    else if (standard_input)
        s->path = "<stdin>";
    return s;
}

int tool_guarded(tool *t, const char *path, int (*body)(void *context, const char *path),
                 void *context)
{
    if (setjmp(t->out_of_memory)) {
        tool_print_diagnostics(t);
        return tool_error(EXIT_LIMIT, "'%s' needs more than %d MiB to compile", path,
                          TOOL_MAX_ARENA_MIB);
    }
    return body(context, path);
}

program *tool_compile(tool *t, const char *path, int *code)
{
    compilation *c = &t->compilation;
    const source *s = read_source(c, path);
    if (!s) {
        *code = EXIT_USAGE;
        return NULL;
    }
    progress_stage(&t->progress, "compiling", path);
    tool_lap(t, "read");
    program *p = compile_front(c, s);
    tool_print_diagnostics(t);
    *code = c->diagnostics.errors ? EXIT_NO : EXIT_DONE;
    return c->diagnostics.errors ? NULL : p;
}

bool tool_emit(tool *t, program *p, text *out)
{
    compilation *c = &t->compilation;
    const emit_options options = {.version = PCG_VERSION, .lines = true, .observed = t->observed};
    out->arena = &c->arena;
    emit(c, p, &options, out);
    tool_lap(t, "emit");
    if (c->diagnostics.errors)
        tool_print_diagnostics(t);
    return !c->diagnostics.errors;
}

/* The file appears complete, or not at all. An errno; 0: it did. */
static int write_file(partial_file *part, const char *path, const char *bytes, size_t length)
{
    interrupt_lock(part->guard);
    FILE *f = fopen(part->name, "wb");
    int error = f ? 0 : errno;
    interrupt_unlock(part->guard);
    if (f && (fwrite(bytes, 1, length, f) != length || fflush(f)))
        error = errno;
    if (f && fclose(f) && !error)
        error = errno;
    complaint why = {0};
    bool done = partial_end(part, !error, path, &why);
    free(why.text);
    return done ? 0 : error ? error : errno;
}

bool tool_write(interrupt *guard, const char *path, const char *bytes, size_t length)
{
    arena a = {0};
    jmp_buf out_of_memory;
    partial_file part = {0};
    int error;
    if (!strcmp(path, "-")) {
        error = fwrite(bytes, 1, length, stdout) == length && !fflush(stdout) ? 0 : errno;
    } else if (setjmp(out_of_memory)) {
        error = ENOMEM;
    } else {
        a.on_failure = &out_of_memory;
        partial_begin(&part, &a, path, "", guard);
        error = write_file(&part, path, bytes, length);
    }
    arena_free(&a);
    if (error)
        tool_error(EXIT_USAGE, "cannot write '%s': %s", path, strerror(error));
    return !error;
}

/* ---- messages of a run ----------------------------------------------------------------------- */

static const char *severity_name(pcg_severity s)
{
    return s == PCG_ERROR ? "error" : s == PCG_WARNING ? "warning" : "note";
}

static void print_message_json(const pcg_message *m)
{
    arena a = {0};
    text out = {.arena = &a};
    text_format(&out, "{\"severity\": \"%s\", \"code\": \"%s\", \"message\": ",
                severity_name(m->severity), m->code);
    text_quote(&out, m->text);
    if (m->file) {
        text_add(&out, ", \"file\": ");
        text_quote(&out, m->file);
        text_format(&out, ", \"line\": %u, \"column\": %u", m->line, m->column);
    }
    if (m->node) {
        text_add(&out, ", \"node\": ");
        text_quote(&out, m->node);
        text_format(&out, ", \"round\": %llu", (unsigned long long)m->round);
    }
    fprintf(stderr, "%s}\n", out.at);
    arena_free(&a);
}

void tool_print_message(void *context, const pcg_message *m)
{
    tool *t = context;
    progress_hide(&t->progress);
    if (t->json_messages) {
        print_message_json(m);
        return;
    }
    size_t length = strlen(m->rendered);
    fprintf(stderr, "%s%s", m->rendered, length && m->rendered[length - 1] == '\n' ? "" : "\n");
}

/* ---- files ----------------------------------------------------------------------------------- */

bool is_shared_object(const char *path)
{
    char magic[4] = {0};
    FILE *f = strcmp(path, "-") ? fopen(path, "rb") : NULL;
    if (f && fread(magic, 1, sizeof magic, f) != sizeof magic)
        magic[0] = 0;
    if (f)
        fclose(f);
    return !memcmp(magic, "\177ELF", sizeof magic);
}

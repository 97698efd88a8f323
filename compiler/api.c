/* api.c - pcg_compile_file and pcg_compile_text: the compiler as a function. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "../runtime/pcg.h"
#include "../runtime/program.h"
#include "compiler.h"

/* A host's compilation that needs more than this is stopped. */
enum { API_MAX_ARENA_MIB = 4096 };

typedef struct compiling {
    compilation compilation;
    const pcg_compile_options *options;
    bool observed;
    jmp_buf out_of_memory;
} compiling;

/* ---- messages -------------------------------------------------------------------------------- */

static pcg_severity public_severity(severity s)
{
    return s == SEVERITY_ERROR ? PCG_ERROR : s == SEVERITY_WARNING ? PCG_WARNING : PCG_NOTE;
}

static void send(const compiling *k, const pcg_message *m)
{
    if (k->options && k->options->message)
        k->options->message(k->options->user, m);
}

static void send_plain(const compiling *k, const char *code, const char *line)
{
    const pcg_message m = {.severity = PCG_ERROR, .code = code, .text = line, .rendered = line};
    send(k, &m);
}

static pcg_message message_of(compiling *k, const diagnostic *d)
{
    text rendered = {.arena = &k->compilation.arena};
    diagnostic_write(d, false, &rendered);
    pcg_message m = {.severity = public_severity(d->severity),
                     .code = diagnostic_name(d->code),
                     .text = d->message,
                     .rendered = rendered.at};
    if (d->span.source) {
        m.file = d->span.source->path;
        source_place(d->span.source, d->span.from, &m.line, &m.column);
    }
    return m;
}

/* Those from number `first` on. */
static void send_diagnostics(compiling *k, uint32_t first)
{
    const diagnostics *d = &k->compilation.diagnostics;
    for (uint32_t i = first; i < d->list.count; i++) {
        const pcg_message m = message_of(k, &d->list.at[i]);
        send(k, &m);
    }
}

/* The warnings of a compilation are part of what its runs have to say. False: no memory. */
static bool keep_warnings(compiling *k, pcg_program *p)
{
    const diagnostics *d = &k->compilation.diagnostics;
    for (uint32_t i = 0; i < d->list.count; i++) {
        const pcg_message m = message_of(k, &d->list.at[i]);
        if (!program_add_message(p, &m))
            return false;
    }
    return true;
}

bool compilation_lend(const compilation *c, pcg_program *p)
{
    const program_loader by = {.compile_file = pcg_compile_file,
                               .compile_text = pcg_compile_text,
                               .import_paths = c->import_paths,
                               .library_paths = c->library_paths};
    return c->closed || program_set_loader(p, &by);
}

/* ---- compiling ------------------------------------------------------------------------------- */

static void release_native(void *owned)
{
    native_free(owned);
}

static pcg_program *compile_native(compiling *k, const program *p)
{
    const emit_options options = {.version = PCG_VERSION, .lines = true, .observed = k->observed};
    text c_text = {.arena = &k->compilation.arena};
    uint32_t sent = k->compilation.diagnostics.list.count;
    emit(&k->compilation, p, &options, &c_text);
    if (k->compilation.diagnostics.errors) {
        send_diagnostics(k, sent);
        return NULL;
    }
    char *error = NULL;
    native *n = native_new(p, c_text.at, &error);
    if (!n) {
        send_plain(k, "", error ? error : "out of memory");
        free(error);
        return NULL;
    }
    const char *why;
    pcg_program *made =
        compilation_program(&k->compilation, native_module(n), release_native, n, &why);
    if (!made) {
        send_plain(k, "", why);
        native_free(n);
    } else if (!keep_warnings(k, made)) {
        pcg_program_free(made);
        return NULL;
    } else {
        made->observed = k->observed;
    }
    return made;
}

static pcg_program *compile_source(compiling *k, const source *s)
{
    compilation *c = &k->compilation;
    program *p = compile_front(c, s);
    bool good = p && !c->diagnostics.errors;
    send_diagnostics(k, 0);
    return good ? compile_native(k, p) : NULL;
}

static void begin(compiling *k, const pcg_compile_options *options)
{
    compilation *c = &k->compilation;
    c->arena.limit = (size_t)API_MAX_ARENA_MIB << 20;
    c->arena.on_failure = &k->out_of_memory;
    c->diagnostics.arena = &c->arena;
    k->options = options;
    if (options) {
        c->graph = options->graph;
        c->import_paths = options->import_paths;
        if (options->size >= offsetof(pcg_compile_options, library_paths) + sizeof(void *))
            c->library_paths = options->library_paths;
        if (options->size >= offsetof(pcg_compile_options, observed) + sizeof options->observed)
            k->observed = options->observed;
    }
}

static void send_unreadable(compiling *k, const char *path)
{
    int reason = errno;
    const char *line =
        reason == EFBIG
            ? arena_format(&k->compilation.arena, "'%s' is larger than %d MiB", path,
                           LANG_MAX_BYTES >> 20)
            : arena_format(&k->compilation.arena, "cannot read '%s': %s", path, strerror(reason));
    send_plain(k, "", line);
}

/* `text_given` NULL: reads the file. All that must survive the jump is in *k. */
static pcg_program *compile(compiling *k, const char *path, const char *text_given, size_t length)
{
    if (setjmp(k->out_of_memory)) {
        send_plain(k, "", "out of memory while compiling");
        return NULL;
    }
    arena *a = &k->compilation.arena;
    const source *s = text_given ? source_new(a, path, arena_copy(a, text_given, length), length)
                                 : source_read(a, path, LANG_MAX_BYTES);
    if (!s) {
        send_unreadable(k, path);
        return NULL;
    }
    return compile_source(k, s);
}

pcg_program *pcg_compile_file(const char *path, const pcg_compile_options *options)
{
    compiling k = {0};
    begin(&k, options);
    pcg_program *p = compile(&k, path, NULL, 0);
    compilation_end(&k.compilation);
    return p;
}

pcg_program *pcg_compile_text(const char *text_given, size_t length, const char *name,
                              const pcg_compile_options *options)
{
    compiling k = {0};
    begin(&k, options);
    pcg_program *p = compile(&k, name, text_given, length);
    compilation_end(&k.compilation);
    return p;
}

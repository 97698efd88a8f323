/* command_compile.c - pcgc FILE -o OUT: a graph ahead of time, as .so, .c or executable; and
 * --dump. */
#include <stdlib.h>
#include <string.h>

#include "tool.h"

typedef struct compiling {
    tool t;
    const char *output, *format, *cc, *dump;
} compiling;

static const char *output_format(const compiling *k)
{
    if (k->format)
        return k->format;
    const char *extension = path_extension(k->output);
    if (!strcmp(extension, "so") || !strcmp(extension, "c"))
        return extension;
    return *extension ? NULL : "exe";
}

/* house.c -> house.h */
static const char *header_path(arena *a, const char *path)
{
    size_t length = strlen(path);
    return arena_format(a, "%.*sh", (int)(length - 1), path);
}

static int write_c(compiling *k, const program *p, const text *c_text)
{
    compilation *c = &k->t.compilation;
    if (!tool_write(&k->t.guard, k->output, c_text->at, c_text->length))
        return EXIT_USAGE;
    if (!strcmp(k->output, "-") || strcmp(path_extension(k->output), "c"))
        return EXIT_DONE;
    text header = {.arena = &c->arena};
    emit_header(c, p, &header);
    bool done = tool_write(&k->t.guard, header_path(&c->arena, k->output), header.at,
                           header.length);
    return done ? EXIT_DONE : EXIT_USAGE;
}

static int write_output(compiling *k, program *p)
{
    const char *format = output_format(k);
    if (!format)
        return usage_error(&command_compile,
                           "'%s': pcgc compiles to .so, .c or a name without extension "
                           "(an executable); models are written by pcgc run",
                           k->output);
    bool shared = !strcmp(format, "so"), executable = !strcmp(format, "exe");
    if (!shared && !executable && strcmp(format, "c"))
        return usage_error(&command_compile, "option '--format' takes so, c or exe, not '%s'",
                           format);
    text c_text = {0};
    if (!tool_emit(&k->t, p, &c_text))
        return EXIT_NO;
    if (!shared && !executable)
        return write_c(k, p, &c_text);
    char *error = NULL;
    progress_stage(&k->t.progress, "making", k->output);
    bool done = shared ? write_shared(p, c_text.at, k->output, k->cc, &k->t.guard, &error)
                       : write_executable(p, c_text.at, k->output, k->cc, &k->t.guard, &error);
    progress_end(&k->t.progress);
    tool_lap(&k->t, shared ? "shared" : "link");
    int code = done ? EXIT_DONE : tool_error(EXIT_USAGE, "cannot make '%s': %s", k->output, error);
    free(error);
    return code;
}

/* ---- --dump ---------------------------------------------------------------------------------- */

static bool dumps(const compiling *k, const char *pass)
{
    size_t length = strlen(pass);
    for (const char *s = k->dump; s && *s; s += strcspn(s, ","), s += *s == ',')
        if (strcspn(s, ",") == length && !memcmp(s, pass, length))
            return true;
    return false;
}

static int check_passes(const compiling *k)
{
    static const char *const passes[] = {"parse", "check", "order", "emit"};
    for (const char *s = k->dump; *s; s += strcspn(s, ","), s += *s == ',') {
        size_t length = strcspn(s, ","), i = 0;
        while (i < COUNT_OF(passes) &&
               (strlen(passes[i]) != length || memcmp(passes[i], s, length)))
            i++;
        if (i == COUNT_OF(passes))
            return usage_error(&command_compile,
                               "option '--dump' takes parse, check, order, emit, not '%.*s'",
                               (int)length, s);
    }
    return -1;
}

/* The tree alone, so that what does not check can be looked at, too. */
static int dump_parse(compiling *k, const char *path)
{
    compilation *c = &k->t.compilation;
    const source *s =
        source_read(&c->arena, !strcmp(path, "-") ? "/dev/stdin" : path, LANG_MAX_BYTES);
    if (!s)
        return tool_error(EXIT_USAGE, "cannot read '%s'", path);
    text out = {.arena = &c->arena};
    lang_dump(lang_parse(&c->arena, s, &c->diagnostics), &out);
    tool_print_diagnostics(&k->t);
    if (!tool_write(NULL, "-", out.at, out.length))
        return EXIT_USAGE;
    return c->diagnostics.errors ? EXIT_NO : EXIT_DONE;
}

static int dump_program(compiling *k, program *p)
{
    text out = {.arena = &k->t.compilation.arena};
    if (dumps(k, "check"))
        dump_check(p, &out);
    if (dumps(k, "order"))
        dump_order(p, &out);
    text c_text = {0};
    if (dumps(k, "emit")) {
        if (!tool_emit(&k->t, p, &c_text))
            return EXIT_NO;
        text_add_bytes(&out, c_text.at, c_text.length);
    }
    return tool_write(NULL, "-", out.at, out.length) ? EXIT_DONE : EXIT_USAGE;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int compile_file(void *context, const char *path)
{
    compiling *k = context;
    int code = k->dump ? check_passes(k) : -1;
    if (code >= 0)
        return code;
    if (k->dump && dumps(k, "parse") && (code = dump_parse(k, path)) != EXIT_DONE)
        return code;
    if (k->dump && !strcmp(k->dump, "parse"))
        return code;
    program *p = tool_compile(&k->t, path, &code);
    if (!p)
        return code;
    code = k->dump ? dump_program(k, p) : EXIT_DONE;
    if (code == EXIT_DONE && k->output)
        code = write_output(k, p);
    return code;
}

static int run_compile(const command *self, int argc, char **argv)
{
    arena a = {0};
    compiling k = {0};
    option_texts files = {0};
    const option options[] = {
        {'o', "output", OPTION_TEXT, &k.output, "FILE",
         "where to: x.so, x.c (and x.h), or x (an executable)"},
        {'f', "format", OPTION_TEXT, &k.format, "so|c|exe",
         "what to write, whatever FILE is called"},
        {0, "cc", OPTION_DEFAULT, &k.cc, "cc",
         "compile with this C compiler and -O2: slow to make, fast to run"},
        {0, "dump", OPTION_TEXT, &k.dump, "PASS,…",
         "print after a pass: parse, check, order, emit"},
        {0, "timings", OPTION_FLAG, &k.t.timings, NULL, "print what each pass took"},
        TOOL_OPTIONS(&k.t),
        {0}};
    int code = options_read(&a, self, options, argc, argv, &files);
    if (code < 0 && files.count != 1)
        code = usage_error(self, files.count ? "one file at a time" : "which file?");
    if (code < 0 && !k.output && !k.dump)
        code =
            usage_error(self, "where to? -o %s", "NAME.so, -o NAME.c or -o NAME (an executable)");
    if (code < 0)
        code = tool_begin(&k.t, self);
    if (code < 0) {
        code = tool_guarded(&k.t, files.at[0], compile_file, &k);
        if (k.t.timings)
            tool_print_timings(&k.t);
        code = tool_end(&k.t, code);
    }
    arena_free(&a);
    return code;
}

static const char *const examples[] = {
    "pcgc house.pcg -o house.so", "pcgc house.pcg --cc -o house.so", "pcgc house.pcg -o house.c",
    "pcgc house.pcg -o house",    "pcgc --dump=order house.pcg",     NULL};
const command command_compile = {NULL, "FILE -o OUT", "Compiles a graph ahead of time.", examples,
                                 run_compile};

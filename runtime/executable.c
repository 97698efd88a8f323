/* executable.c - pcg_main: the command line of an executable that pcgc makes of a graph. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "interrupt.h"
#include "progress.h"
#include "program.h"

enum { EXIT_DONE = 0, EXIT_USAGE = 2, EXIT_RUN_FAILED = 3, EXIT_LIMIT = 4, EXIT_INTERRUPTED = 130 };

typedef struct words {
    const char **at;
    int count;
} words;

typedef struct command_line {
    pcg_program *program;
    const char *name;
    words parameters, outputs, libraries;
    const char *format;
    pcg_run_options run;
    pcg_write_options write;
    bool json, quiet;
    progress progress;
} command_line;

/* ---- options -------------------------------------------------------------------------------- */

typedef enum option_kind { FLAG, TEXT, WORD, COUNT, BYTES, SECONDS, SIZE } option_kind;

/* Where it is written to: an offset into the command line. */
typedef struct option {
    char letter; /* 0: none */
    const char *name;
    option_kind kind;
    size_t to;
    const char *argument, *help;
} option;

#define TO(member) offsetof(command_line, member)

static const option options[] = {
    {'p', "parameter", WORD, TO(parameters), "NAME=VALUE", "set a parameter: -p height=12m"},
    {'o', "output", WORD, TO(outputs), "FILE",
     "write a model (.glb, .obj), a picture (.png), or .json"},
    {'f', "format", TEXT, TO(format), "FORMAT", "what to write, whatever FILE is called"},
    {'s', "seed", COUNT, TO(run.seed), "N", "the seed of all chance; 0 when not given"},
    {0, "json", FLAG, TO(json), NULL, "print what came out of which port"},
    {0, "entities", FLAG, TO(write.entities), NULL, "with --json: list every entity"},
    {0, "size", SIZE, TO(write), "WIDTHxHEIGHT", "of a picture; 1280x960 when not given"},
    {0, "view", TEXT, TO(write.view), "NAME",
     "of a picture: auto, bird, iso, top, front, back, left, right"},
    {0, "look-at", TEXT, TO(write.look_at), "X,Y,Z[,RADIUS]",
     "what is in the middle of a picture, and how much around it is seen"},
    {0, "from", TEXT, TO(write.from), "X,Y,Z", "where the camera of a picture stands"},
    {0, "threads", COUNT, TO(write.threads), "N",
     "at most, for `parallel` and to draw a picture; as many as there are processors when not given"},
    {0, "strict", FLAG, TO(run.strict), NULL, "a bad entity stops the run"},
    {0, "no-cache", FLAG, TO(run.no_cache), NULL, "make again what `cache` has kept, and keep nothing"},
    {0, "max-cache", BYTES, TO(run.max_cache), "BYTES", "that `cache` may keep in memory, and on disk"},
    {'L', "library-path", WORD, TO(libraries), "FOLDER", "look for libraries there, too"},
    {'q', "quiet", FLAG, TO(quiet), NULL, "no summary, no progress"},
    {0, "max-rounds", COUNT, TO(run.max_rounds), "N", "stop after so many rounds"},
    {0, "max-entities", COUNT, TO(run.max_entities), "N", "entities that may be alive at one time"},
    {0, "max-depth", COUNT, TO(run.max_depth), "N", "how deep graphs may be encapsulated"},
    {0, "max-memory", BYTES, TO(run.max_memory), "BYTES", "of the run: 512M, 2G"},
    {0, "max-seconds", SECONDS, TO(run.max_seconds), "TIME", "of the run: 30, 500ms, 2min"},
};

static int usage(const command_line *c, const char *format, ...) PRINTF_LIKE(2, 3);

static int usage(const command_line *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", c->name);
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n%s --help lists the options\n", c->name);
    va_end(arguments);
    return EXIT_USAGE;
}

static bool read_count(const char *s, const char **behind, uint64_t *to)
{
    *to = 0;
    *behind = s;
    for (; *s >= '0' && *s <= '9'; s++) {
        uint64_t digit = (uint64_t)(*s - '0');
        if (*to > (UINT64_MAX - digit) / 10)
            return false;
        *to = *to * 10 + digit;
    }
    bool any = s != *behind;
    *behind = s;
    return any;
}

static bool read_bytes(const char *s, size_t *to)
{
    static const char units[] = "kKMG";
    static const unsigned shifts[] = {10, 10, 20, 30};
    uint64_t n;
    if (!read_count(s, &s, &n))
        return false;
    const char *unit = *s ? strchr(units, *s) : NULL;
    unsigned shift = unit ? shifts[unit - units] : 0;
    if (s[unit != NULL] || n > (SIZE_MAX >> shift))
        return false;
    *to = (size_t)n << shift;
    return true;
}

static bool read_seconds(const char *s, double *to)
{
    static const struct { const char *name; double times, over; } units[] = {
        {"", 1, 1}, {"s", 1, 1}, {"ms", 1, 1000}, {"min", 60, 1}, {"h", 3600, 1}};
    const char *behind;
    double n = number_read(s, &behind);
    for (size_t i = 0; i < COUNT_OF(units) && behind != s && n >= 0; i++)
        if (!strcmp(behind, units[i].name)) {
            *to = n * units[i].times / units[i].over;
            return true;
        }
    return false;
}

static bool read_size(const char *s, pcg_write_options *to)
{
    uint64_t width, height;
    if (!read_count(s, &s, &width) || *s++ != 'x' || !read_count(s, &s, &height) || *s)
        return false;
    if (!width || !height || width > 99999 || height > 99999)
        return false;
    to->width = (uint32_t)width;
    to->height = (uint32_t)height;
    return true;
}

/* Depth and threads are narrower than the other counts. */
static bool read_limit(const char *s, const option *o, void *to)
{
    uint64_t n;
    if (!read_count(s, &s, &n) || *s)
        return false;
    if (o->to == TO(run.max_depth) || o->to == TO(write.threads))
        *(uint32_t *)to = n > UINT32_MAX ? UINT32_MAX : (uint32_t)n;
    else
        *(uint64_t *)to = n;
    return true;
}

static bool set_option(command_line *c, const option *o, const char *value)
{
    void *to = (char *)c + o->to;
    words *list = to;
    switch (o->kind) {
    case FLAG: *(bool *)to = true; return true;
    case TEXT: *(const char **)to = value; return true;
    case WORD: list->at[list->count++] = value; return true;
    case COUNT: return read_limit(value, o, to);
    case BYTES: return read_bytes(value, to);
    case SECONDS: return read_seconds(value, to);
    case SIZE: return read_size(value, to);
    }
    return false;
}

/* The option of a word that begins with a dash, and the value that stands in the same word (or
 * NULL). */
static const option *find_option(const char *word, const char **value)
{
    size_t length = strcspn(word, "=");
    *value = NULL;
    for (size_t i = 0; i < COUNT_OF(options); i++) {
        const option *o = &options[i];
        if (word[1] == '-' && strlen(o->name) == length - 2 &&
            !memcmp(o->name, word + 2, length - 2)) {
            *value = word[length] ? word + length + 1 : NULL;
            return o;
        }
        if (word[1] != '-' && o->letter && o->letter == word[1]) {
            *value = word[2] ? word + 2 : NULL;
            return o;
        }
    }
    return NULL;
}

static int refuse_option(const command_line *c, const char *word)
{
    const char *names[COUNT_OF(options)];
    for (size_t i = 0; i < COUNT_OF(options); i++)
        names[i] = options[i].name;
    const char *near =
        word[0] == '-' && word[1] == '-' ? nearest_name(word + 2, names, COUNT_OF(options)) : NULL;
    if (near)
        return usage(c, "unknown option '%s', did you mean '--%s'?", word, near);
    return usage(c, word[0] == '-' ? "unknown option '%s'" : "'%s' is no option", word);
}

/* The option at argv[*i]; moves *i to its last word. -1 to go on, or an exit code. */
static int read_option(command_line *c, int argc, char **argv, int *i)
{
    const char *word = argv[*i], *value = NULL;
    const option *o = word[0] == '-' && word[1] ? find_option(word, &value) : NULL;
    if (!o)
        return refuse_option(c, word);
    if (o->kind == FLAG && value)
        return usage(c, "option '--%s' takes no value", o->name);
    if (o->kind != FLAG && !value) {
        if (*i + 1 >= argc)
            return usage(c, "option '%s' needs a value: %s", word, o->argument);
        value = argv[++*i];
    }
    if (!set_option(c, o, value))
        return usage(c, "option '--%s' takes %s, not '%s'", o->name, o->argument, value);
    return -1;
}

/* ---- help ----------------------------------------------------------------------------------- */

/* The first line of a documentation. */
static void print_first_line(const char *document)
{
    printf("%.*s\n", (int)strcspn(document, "\n"), document);
}

static void print_parameters(const pcg_program *p)
{
    pcg_parameter about;
    size_t count = pcg_program_parameter_count(p);
    if (count)
        printf("\nParameters:\n");
    for (size_t i = 0; i < count && pcg_program_parameter(p, i, &about); i++) {
        printf("  %s: %s%s%s", about.name, about.type, *about.initial ? " = " : "", about.initial);
        if (*about.document)
            printf("   %.*s", (int)strcspn(about.document, "\n"), about.document);
        printf("\n");
    }
}

static void print_outputs(const pcg_program *p)
{
    pcg_gate about;
    size_t count = pcg_program_output_count(p);
    if (count)
        printf("\nOutputs:\n");
    for (size_t i = 0; i < count && pcg_program_output(p, i, &about); i++) {
        printf("  %s: %s%s", about.name, about.type, *about.document ? "   " : "\n");
        if (*about.document)
            print_first_line(about.document);
    }
}

static void print_options(void)
{
    printf("\nOptions:\n");
    for (size_t i = 0; i < COUNT_OF(options); i++) {
        const option *o = &options[i];
        const char letter[] = {o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
                               o->letter ? ',' : ' ', '\0'};
        int used = printf("  %s --%s%s%s", letter, o->name, o->argument ? " " : "",
                          o->argument ? o->argument : "");
        printf("%*s%s\n", used < 32 ? 32 - used : 1, "", o->help);
    }
    printf("  -h, --help                    this text\n");
    printf("      --version                 the version of pcgc that made this\n");
}

static int print_help(const command_line *c)
{
    const char *document = pcg_program_document(c->program);
    printf("Usage: %s [OPTION]...\n", c->name);
    if (*document)
        printf("%s\n", document);
    print_parameters(c->program);
    print_outputs(c->program);
    print_options();
    return EXIT_DONE;
}

/* ---- running -------------------------------------------------------------------------------- */

static int exit_code(pcg_status status)
{
    switch (status) {
    case PCG_STATUS_OK: return EXIT_DONE;
    case PCG_STATUS_FAILED: return EXIT_RUN_FAILED;
    case PCG_STATUS_LIMIT: return EXIT_LIMIT;
    case PCG_STATUS_CANCELLED: return EXIT_INTERRUPTED;
    case PCG_STATUS_MISUSE: return EXIT_USAGE;
    }
    return EXIT_RUN_FAILED;
}

static int on_progress(void *user, const pcg_progress *now)
{
    command_line *c = user;
    return progress_run(&c->progress, now);
}

static void print_message(void *user, const pcg_message *m)
{
    command_line *c = user;
    progress_hide(&c->progress);
    fputs(m->rendered, stderr);
}

static int complain(command_line *c, const pcg_run *r, pcg_status status)
{
    progress_end(&c->progress);
    fprintf(stderr, "%s: %s\n", c->name, pcg_run_error(r));
    return exit_code(status);
}

static int set_parameters(command_line *c, pcg_run *r)
{
    for (int i = 0; i < c->parameters.count; i++) {
        const char *word = c->parameters.at[i], *equals = strchr(word, '=');
        if (!equals || equals == word)
            return usage(c, "option '--parameter' takes NAME=VALUE, not '%s'", word);
        arena a = {0};
        const char *name = arena_copy(&a, word, (size_t)(equals - word));
        pcg_status status = name ? pcg_run_set(r, name, equals + 1) : PCG_STATUS_LIMIT;
        arena_free(&a);
        if (status != PCG_STATUS_OK)
            return complain(c, r, status);
    }
    return EXIT_DONE;
}

/* What cannot be written is like what cannot be read: the command line named it. */
static int complain_of_writing(command_line *c, const pcg_run *r, pcg_status status)
{
    return complain(c, r, status == PCG_STATUS_FAILED ? PCG_STATUS_MISUSE : status);
}

static int write_results(command_line *c, pcg_run *r)
{
    pcg_status status = PCG_STATUS_OK;
    for (int i = 0; i < c->outputs.count; i++) {
        progress_stage(&c->progress, "writing", c->outputs.at[i]);
        status = pcg_run_write(r, c->outputs.at[i], c->format, &c->write);
        if (status != PCG_STATUS_OK)
            return complain_of_writing(c, r, status);
    }
    progress_end(&c->progress);
    if (c->json)
        status = pcg_run_write(r, "-", "json", &c->write);
    if (status != PCG_STATUS_OK)
        return complain_of_writing(c, r, status);
    if (!c->outputs.count && !c->json && !c->quiet)
        fprintf(
            stderr,
            "%s: %zu faces, %zu vertices; write them with -o %s.glb, look at them with -o %s.png\n",
            c->name, pcg_run_face_count(r), pcg_run_vertex_count(r), pcg_program_name(c->program),
            pcg_program_name(c->program));
    return EXIT_DONE;
}

static int execute(command_line *c, pcg_run *r)
{
    int code = set_parameters(c, r);
    if (code != EXIT_DONE)
        return code;
    pcg_status status = pcg_run_execute(r);
    if (status == PCG_STATUS_OK)
        return write_results(c, r);
    progress_end(&c->progress);
    if (c->json && status != PCG_STATUS_CANCELLED)
        pcg_run_write(r, "-", "json", &c->write);
    return exit_code(status);
}

/* What the graph needs is looked for beside this program, too. False: it was told why. */
static bool link_libraries(const command_line *c)
{
    char own[LIBRARY_PATH_BYTES];
    ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    while (length > 0 && own[length - 1] != '/')
        length--;
    own[length > 0 ? length : 0] = '\0';
    library_search s = {.folder = own, .paths = c->libraries.at};
    bool done = program_link(c->program, NULL, 0, &s);
    if (!done)
        fprintf(stderr, "%s: cannot run: %s\n", c->name, s.why);
    return done;
}

static int run_guarded(command_line *c, interrupt *guard)
{
    c->run.threads = c->write.threads;
    pcg_run *r = pcg_run_new(c->program, &c->run);
    if (!r) {
        fprintf(stderr, "%s: out of memory\n", c->name);
        return EXIT_LIMIT;
    }
    interrupt_run(guard, r);
    int code = execute(c, r);
    interrupt_run(guard, NULL);
    pcg_run_free(r);
    return code;
}

static int run(command_line *c)
{
    if (!link_libraries(c))
        return EXIT_USAGE;
    interrupt guard = {0};
    progress_begin(&c->progress, &guard, c->quiet);
    interrupt_begin(&guard, c->name);
    c->run.size = sizeof c->run;
    c->run.provenance = c->write.entities;
    c->run.message = print_message;
    c->run.progress = on_progress;
    c->run.user = c;
    c->write.size = sizeof c->write;
    int code = run_guarded(c, &guard);
    return interrupt_end(&guard) ? EXIT_INTERRUPTED : code;
}

static int read_and_run(command_line *c, int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h"))
            return print_help(c);
        if (!strcmp(argv[i], "--version")) {
            printf("%s, made by pcgc %s\n", pcg_program_name(c->program),
                   c->program->module->version);
            return EXIT_DONE;
        }
        int code = read_option(c, argc, argv, &i);
        if (code >= 0)
            return code;
    }
    return run(c);
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

int pcg_main(const struct pcg_module *module, int argc, char **argv)
{
    command_line c = {.name = argc > 0 ? base_name(argv[0]) : "graph"};
    pcg_program *p = program_new(module, NULL, NULL);
    size_t most = argc > 0 ? (size_t)argc : 1;
    c.program = p;
    c.parameters.at = calloc(most, sizeof *c.parameters.at);
    c.outputs.at = calloc(most, sizeof *c.outputs.at);
    c.libraries.at = calloc(most + 1, sizeof *c.libraries.at); /* a NULL ends them */
    int code = EXIT_USAGE;
    if (!p)
        fprintf(stderr, "%s: it was made for another runtime than this (interface %d)\n", c.name,
                PCG_ABI);
    else if (!c.parameters.at || !c.outputs.at || !c.libraries.at ||
             !program_set_file(p, "/proc/self/exe"))
        fprintf(stderr, "%s: out of memory\n", c.name);
    else
        code = read_and_run(&c, argc, argv);
    free(c.parameters.at);
    free(c.outputs.at);
    free(c.libraries.at);
    pcg_program_free(p);
    return code;
}

/* command_run.c - pcgc run: compiles a graph in memory (or loads a compiled one), runs it,
 * writes what came out. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../runtime/program.h"
#include "../stdlib/io/io.h"
#include "command_run.h"

/* ---- messages and progress ------------------------------------------------------------------- */

static void on_message(void *user, const pcg_message *m)
{
    running *k = user;
    tool_print_message(&k->t, m);
}

static int on_progress(void *user, const pcg_progress *p)
{
    running *k = user;
    return progress_run(&k->t.progress, p);
}

/* ---- running --------------------------------------------------------------------------------- */

static const command *command_of(const running *k)
{
    return k->seeing ? k->seeing->command : k->command ? k->command : &command_run;
}

static int exit_code(pcg_status status)
{
    switch (status) {
    case PCG_STATUS_OK:
        return EXIT_DONE;
    case PCG_STATUS_FAILED:
        return EXIT_RUN_FAILED;
    case PCG_STATUS_LIMIT:
        return EXIT_LIMIT;
    case PCG_STATUS_CANCELLED:
        return EXIT_INTERRUPTED;
    case PCG_STATUS_MISUSE:
        return EXIT_USAGE;
    }
    return EXIT_BUG;
}

static int set_parameters(const running *k, pcg_run *r)
{
    for (size_t i = 0; i < k->parameters.count; i++) {
        const char *word = k->parameters.at[i], *equals = strchr(word, '=');
        if (!equals || equals == word)
            return usage_error(command_of(k),
                               "option '--parameter' takes name=value, not '%s'", word);
        arena a = {0};
        const char *name = arena_copy(&a, word, (size_t)(equals - word));
        pcg_status status = name ? pcg_run_set(r, name, equals + 1) : PCG_STATUS_FAILED;
        arena_free(&a);
        if (status != PCG_STATUS_OK)
            return tool_error(exit_code(status), "-p %s: %s", word, pcg_run_error(r));
    }
    return EXIT_DONE;
}

static void print_summary(pcg_run *r, const char *name)
{
    fprintf(stderr,
            "%s: %zu faces, %zu vertices; write them with -o %s.glb, look at them with -o %s.png\n",
            name, pcg_run_face_count(r), pcg_run_vertex_count(r), name, name);
}

/* Of a folder's graph: where the result is, and what one can do next. */
static void print_next_steps(const running *k, pcg_run *r, const char *name)
{
    const pcg_module *m = result_module(r);
    const char *first = NULL;
    for (uint32_t i = m->parameter_count; i-- > 0;)
        first = m->parameters[i].hidden ? first : m->parameters[i].name;
    fprintf(stderr, "%s: %zu faces, in", name, pcg_run_face_count(r));
    for (size_t i = 0; i < k->outputs.count; i++)
        fprintf(stderr, "%s %s", i ? " and" : "", k->outputs.at[i]);
    fprintf(stderr, "\nnow try:\n  pcgc run --seed 7\n");
    if (first)
        fprintf(stderr, "  pcgc run -p %s=…          (pcgc info %s lists the parameters)\n", first, k->path);
    fprintf(stderr,
            "  pcgc watch                     (then change %s, and save)\n"
            "  pcgc doc                       (all procedures)\n",
            k->path);
}

/* An interrupt has said so itself. */
static int writing_failed(running *k, const pcg_run *r, pcg_status status)
{
    progress_end(&k->t.progress);
    return status == PCG_STATUS_CANCELLED ? EXIT_INTERRUPTED
                                          : tool_error(EXIT_USAGE, "%s", pcg_run_error(r));
}

/* What is printed as JSON tells of all that went before. */
static void add_times(running *k)
{
    if (!k->t.timings)
        return;
    k->write.timings = k->t.times.at;
    k->write.timing_count = k->t.times.count;
}

static int write_results(running *k, pcg_run *r, const char *name)
{
    for (size_t i = 0; i < k->outputs.count; i++) {
        progress_stage(&k->t.progress, "writing", k->outputs.at[i]);
        if (!strcmp(k->outputs.at[i], "-"))
            progress_end(&k->t.progress);
        pcg_status status = pcg_run_write(r, k->outputs.at[i], k->format, &k->write);
        if (status != PCG_STATUS_OK)
            return writing_failed(k, r, status);
        const char *extension = path_extension(k->outputs.at[i]);
        tool_lap(&k->t, *extension ? extension : "write");
    }
    progress_end(&k->t.progress);
    add_times(k);
    if (k->json) {
        pcg_status status = pcg_run_write(r, "-", "json", &k->write);
        if (status != PCG_STATUS_OK)
            return writing_failed(k, r, status);
    }
    if (k->t.quiet || k->watched)
        return EXIT_DONE;
    if (k->project && k->outputs.count)
        print_next_steps(k, r, name);
    else if (!k->outputs.count && !k->json)
        print_summary(r, name);
    return EXIT_DONE;
}

static int execute(running *k, pcg_run *r, const char *name)
{
    int code = set_parameters(k, r);
    if (code != EXIT_DONE)
        return code;
    progress_stage(&k->t.progress, "running", name);
    if (k->seeing && k->seeing->started)
        k->seeing->started(k->seeing->user, r);
    pcg_status status = pcg_run_execute(r);
    tool_lap(&k->t, "run");
    if (k->seeing && k->seeing->done)
        k->seeing->done(k->seeing->user, r, status);
    if (status == PCG_STATUS_OK)
        return write_results(k, r, name);
    progress_end(&k->t.progress);
    add_times(k);
    if (k->json && status != PCG_STATUS_CANCELLED)
        pcg_run_write(r, "-", "json", &k->write);
    return exit_code(status);
}

static void take_outcome(running *k, pcg_run *r)
{
    const pcg_message *m;
    for (size_t i = 0; i < result_message_count(r) && (m = result_message(r, i)); i++) {
        k->outcome.errors += m->severity == PCG_ERROR;
        k->outcome.warnings += m->severity == PCG_WARNING;
    }
    for (uint32_t i = 0; i < result_module(r)->output_count; i++)
        k->outcome.entities += result_entities(r, i)->count;
    k->outcome.faces = pcg_run_face_count(r);
    k->outcome.rounds = result_rounds(r);
    k->outcome.sent = result_sent(r);
    k->outcome.executed = true;
}

static int run_program(running *k, const pcg_program *p)
{
    pcg_run_options options = {
        .size = sizeof options,
        .seed = k->seed,
        .strict = k->strict,
        .max_rounds = k->max_rounds,
        .max_entities = k->max_entities,
        .max_depth = k->max_depth > UINT32_MAX ? UINT32_MAX : (uint32_t)k->max_depth,
        .max_memory = k->max_memory,
        .max_seconds = k->max_seconds,
        .provenance = k->entities,
        .no_cache = k->no_cache,
        .max_cache = k->max_cache,
        .threads = k->threads > UINT32_MAX ? UINT32_MAX : (uint32_t)k->threads,
        .message = on_message,
        .progress = k->t.progress.wanted ? on_progress : NULL,
        .user = k,
    };
    pcg_run *r = pcg_run_new(p, &options);
    if (!r)
        return tool_error(EXIT_LIMIT, "out of memory");
    result_watch_paths(r, k->found, k->user);
    if (k->seeing)
        pcg_run_observe(r, k->seeing->observer, k->seeing->user);
    interrupt_run(&k->t.guard, r);
    int code = execute(k, r, pcg_program_name(p));
    interrupt_run(&k->t.guard, NULL);
    take_outcome(k, r);
    pcg_run_free(r);
    return code;
}

/* ---- from source, and from a shared object --------------------------------------------------- */

static int run_shared_object(running *k, const char *path)
{
    if (k->seeing)
        return usage_error(k->seeing->command, "it needs the source; '%s' is compiled", path);
    if (k->node)
        return usage_error(command_of(k), "--node needs the source; '%s' is compiled", path);
    pcg_compile_options options = {.size = sizeof options, .message = on_message, .user = k,
                                   .library_paths = k->t.compilation.library_paths};
    pcg_program *p = pcg_program_load(path, &options);
    if (!p)
        return EXIT_USAGE;
    tool_lap(&k->t, "load");
    int code = compilation_lend(&k->t.compilation, p) ? run_program(k, p)
                                                      : tool_error(EXIT_LIMIT, "out of memory");
    pcg_program_free(p);
    return code;
}

static int run_code(running *k, const program *p, const char *c_text)
{
    char *error = NULL;
    native *n = native_new(p, c_text, &error);
    if (!n)
        return tool_error(EXIT_BUG,
                          "the C that was emitted does not compile, which is a bug of pcgc; please "
                          "report it with the "
                          "graph:\n%s",
                          error);
    tool_lap(&k->t, "libtcc");
    const char *why;
    pcg_program *compiled =
        compilation_program(&k->t.compilation, native_module(n), NULL, NULL, &why);
    if (compiled)
        compiled->observed = k->seeing != NULL;
    int result = compiled ? run_program(k, compiled) : tool_error(EXIT_LIMIT, "%s", why);
    pcg_program_free(compiled);
    native_free(n);
    return result;
}

static int unknown_node(const program *p, const char *name)
{
    const graph *g = p->main;
    const char **names = ARENA_ARRAY(p->arena, const char *, g->node_count + 1);
    for (uint32_t i = 0; i < g->node_count; i++)
        names[i] = g->nodes[i]->name;
    const char *near = nearest_name(name, names, g->node_count);
    return tool_error(EXIT_USAGE, "graph '%s' has no node '%s'%s%s%s", g->name, name,
                      near ? ", did you mean '" : "", near ? near : "", near ? "'?" : "");
}

static int run_source(void *context, const char *path)
{
    running *k = context;
    int code;
    program *p = tool_compile(&k->t, path, &code);
    if (!p)
        return code;
    if (k->node && !cut_at_node(p, k->node))
        return unknown_node(p, k->node);
    if (k->node)
        order(&k->t.compilation, p);
    text c_text = {0};
    if (!tool_emit(&k->t, p, &c_text))
        return EXIT_NO;
    k->program = p;
    return run_code(k, p, c_text.at);
}

/* ---- the command ----------------------------------------------------------------------------- */

static int read_size(running *k)
{
    unsigned width, height;
    char behind;
    if (!k->size)
        return -1;
    if (sscanf(k->size, "%5ux%5u%c", &width, &height, &behind) != 2 || !width || !height)
        return usage_error(command_of(k), "option '--size' takes WIDTHxHEIGHT, not '%s'", k->size);
    k->write.width = width;
    k->write.height = height;
    return -1;
}

int run_file(running *k, const char *path)
{
    k->path = path;
    k->write.size = sizeof k->write;
    k->write.entities = k->entities;
    k->write.threads = k->threads > UINT32_MAX ? UINT32_MAX : (uint32_t)k->threads;
    int code = read_size(k);
    if (code < 0)
        code = tool_begin(&k->t, command_of(k));
    if (code >= 0)
        return code;
    k->t.compilation.found = k->found;
    k->t.compilation.found_user = k->user;
    k->t.observed = k->seeing != NULL;
    code = k->seeing ? k->seeing->begin(k->seeing->user, k) : EXIT_DONE;
    if (code == EXIT_DONE)
        code = is_shared_object(path) ? run_shared_object(k, path)
                                      : tool_guarded(&k->t, path, run_source, k);
    if (k->seeing)
        code = k->seeing->end(k->seeing->user, k, code);
    k->outcome.errors += k->t.compilation.diagnostics.errors;
    k->outcome.warnings += k->t.compilation.diagnostics.warnings;
    if (k->measured)
        k->measured(k->measured_user, k);
    if (k->t.timings)
        tool_print_timings(&k->t);
    return tool_end(&k->t, code);
}

int run_seen(running *k, const seeing *s, const option_texts *files)
{
    if (files->count != 1)
        return usage_error(s->command, files->count ? "one file at a time" : "which file?");
    k->seeing = s;
    k->t.quiet = true;
    return run_file(k, files->at[0]);
}

/* The file that `run` means where none is named: the folder's own, or the only one in it. */
static const char *project_file(arena *a)
{
    char here[4096];
    const char *folder = getcwd(here, sizeof here) ? strrchr(here, '/') : NULL;
    const char *own = folder ? arena_format(a, "%s.pcg", folder + 1) : "";
    if (access(own, R_OK) == 0)
        return own;
    DIR *files = opendir(".");
    const char *only = NULL;
    unsigned count = 0;
    for (struct dirent *e = files ? readdir(files) : NULL; e; e = readdir(files))
        if (e->d_name[0] != '.' && !strcmp(path_extension(e->d_name), "pcg") && ++count == 1)
            only = arena_copy(a, e->d_name, strlen(e->d_name));
    if (files)
        closedir(files);
    return count == 1 ? only : NULL;
}

/* Of a folder's graph, where nothing else is asked for, a model and a picture are written. */
static void add_project_outputs(running *k, arena *a, const char *path)
{
    const char *name = arena_copy(a, path, strlen(path) - strlen(".pcg"));
    const char **outputs = ARENA_ARRAY(a, const char *, 2);
    if (k->outputs.count || k->json || k->node)
        return;
    outputs[0] = arena_format(a, "%s.glb", name);
    outputs[1] = arena_format(a, "%s.png", name);
    k->outputs = (option_texts){outputs, image_png_built() ? 2 : 1};
}

int run_options(const command *self, arena *a, running *k, int argc, char **argv, const char **path)
{
    option_texts files = {0};
    const option options[] = {
        {'p', "parameter", OPTION_TEXTS, &k->parameters, "NAME=VALUE",
         "set a parameter: -p height=12m"},
        {'o', "output", OPTION_TEXTS, &k->outputs, "FILE",
         "write a model (.glb, .obj), a picture (.png), .json, or what `report` added up (.csv)"},
        {'f', "format", OPTION_TEXT, &k->format, "FORMAT", "what to write, whatever FILE is called"},
        {'s', "seed", OPTION_COUNT, &k->seed, "N", "the seed of all chance; 0 when not given"},
        {0, "json", OPTION_FLAG, &k->json, NULL, "print what came out of which port"},
        {0, "entities", OPTION_FLAG, &k->entities, NULL, "with --json: list every entity"},
        {'n', "node", OPTION_TEXT, &k->node, "NAME", "stop at this node, and take what leaves it"},
        {0, "size", OPTION_TEXT, &k->size, "WIDTHxHEIGHT", "of a picture; 1280x960 when not given"},
        {0, "view", OPTION_TEXT, &k->write.view, "NAME",
         "of a picture: auto, bird, iso, top, front, back, left, right"},
        {0, "look-at", OPTION_TEXT, &k->write.look_at, "X,Y,Z[,RADIUS]",
         "what is in the middle of a picture, and how much around it is seen"},
        {0, "from", OPTION_TEXT, &k->write.from, "X,Y,Z", "where the camera of a picture stands"},
        {0, "threads", OPTION_COUNT, &k->threads, "N",
         "at most, for `parallel` and to draw a picture; as many as there are processors when not given"},
        {0, "strict", OPTION_FLAG, &k->strict, NULL, "a bad entity stops the run"},
        {0, "no-cache", OPTION_FLAG, &k->no_cache, NULL, "make again what `cache` has kept, and keep nothing"},
        {0, "max-cache", OPTION_BYTES, &k->max_cache, "BYTES",
         "that `cache` may keep in memory, and on disk: 512M, 2G"},
        {'q', "quiet", OPTION_FLAG, &k->t.quiet, NULL, "no summary, no progress"},
        {0, "max-rounds", OPTION_COUNT, &k->max_rounds, "N", "stop after so many rounds"},
        {0, "max-entities", OPTION_COUNT, &k->max_entities, "N",
         "entities that may be alive at one time"},
        {0, "max-depth", OPTION_COUNT, &k->max_depth, "N", "how deep graphs may be encapsulated"},
        {0, "max-memory", OPTION_BYTES, &k->max_memory, "BYTES", "of the run: 512M, 2G"},
        {0, "max-seconds", OPTION_SECONDS, &k->max_seconds, "TIME", "of the run: 30, 500ms, 2min"},
        {0, "timings", OPTION_FLAG, &k->t.timings, NULL, "print what each pass took"},
        TOOL_OPTIONS(&k->t),
        {0}};
    int code = options_read(a, self, options, argc, argv, &files);
    if (code >= 0)
        return code;
    if (files.count > 1)
        return usage_error(self, "one file at a time");
    k->project = !files.count;
    *path = files.count ? files.at[0] : project_file(a);
    if (!*path)
        return usage_error(self, "which file? (without one, it is the folder's: the one that has the folder's name, "
                                 "or the only one)");
    if (k->project)
        add_project_outputs(k, a, *path);
    return -1;
}

static int run_run(const command *self, int argc, char **argv)
{
    arena a = {0};
    running k = {0};
    const char *path;
    int code = run_options(self, &a, &k, argc, argv, &path);
    if (code < 0)
        code = run_file(&k, path);
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc run house.pcg -p height=12m --seed 7 -o house.glb",
                                       "pcgc run house.pcg -o house.png --size 1920x1080",
                                       "pcgc run house.pcg --json --node tiles",
                                       "pcgc run house.so -o house.obj", NULL};
const command command_run = {"run", "[FILE]",
                             "Runs a graph (.pcg, or .so that pcgc made) and writes what came out.",
                             examples, run_run};

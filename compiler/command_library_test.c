/* command_library_test.c - pcgc library --test: the examples of a library, run and compared. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../runtime/program.h"
#include "../runtime/result.h"
#include "command_library.h"

typedef struct testing {
    building *b;
    const pcgen_example *example;
    open_library *library;
    compilation compilation;
    jmp_buf out_of_memory;
    unsigned passed, failed;
    bool said; /* why the example failed */
} testing;

/* "zoning/zone.c:7: in zoning_zone_1: …" */
static void say(testing *t, const char *format, ...) PRINTF_LIKE(2, 3);

static void say(testing *t, const char *format, ...)
{
    uint32_t line, column;
    va_list arguments;
    source_place(t->example->span.source, t->example->span.from, &line, &column);
    fprintf(stderr, "%s:%u: error: example '%s': ", t->example->span.source->path, (unsigned)line,
            t->example->name);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    t->said = true;
}

static void on_message(void *user, const pcg_message *m)
{
    testing *t = user;
    if (m->severity == PCG_ERROR)
        say(t, "%s", m->text);
}

/* ---- measuring ------------------------------------------------------------------------------- */

static const char *const fields[] = {"count", "faces", "vertices", "holes", "area", "volume"};

static double measure_shape(const pcg_shape *s, size_t field)
{
    switch (field) {
    case 1:
        return s->mesh->face_count;
    case 2:
        return s->mesh->vertex_count;
    case 3:
        return pcg_shape_holes(s);
    case 4:
        return pcg_shape_area(s);
    default:
        return pcg_shape_volume(s);
    }
}

static double measure(const pcg_run *r, uint32_t output, size_t field)
{
    const pcg_entities *all = result_entities(r, output);
    double sum = 0;
    for (uint32_t i = 0; field > 0 && i < all->count; i++)
        if (pcg_entity_is(all->at[i], &pcg_type_shape))
            sum += measure_shape((const pcg_shape *)(const void *)all->at[i], field);
    return field > 0 ? sum : all->count;
}

/* Whether an output is called `wanted` (of `length` bytes), or ends with it behind a dot. */
static bool is_port(const char *output, const char *wanted, size_t length)
{
    const char *dot = strrchr(output, '.');
    return (strlen(output) == length && !memcmp(output, wanted, length)) ||
           (dot && strlen(dot + 1) == length && !memcmp(dot + 1, wanted, length));
}

/* What "faces" or "slice.count" names; false where there is no such thing. */
static bool find_value(const pcg_run *r, const char *name, double *sum)
{
    const char *dot = strrchr(name, '.');
    const char *field = dot ? dot + 1 : name;
    size_t number = 0, found = 0;
    while (number < COUNT_OF(fields) && strcmp(fields[number], field))
        number++;
    *sum = 0;
    for (uint32_t i = 0; number < COUNT_OF(fields) && i < result_module(r)->output_count; i++)
        if (!dot || is_port(result_module(r)->outputs[i].name, name, (size_t)(dot - name))) {
            *sum += measure(r, i, number);
            found++;
        }
    return number < COUNT_OF(fields) && (dot ? found == 1 : true);
}

/* ---- expectations ---------------------------------------------------------------------------- */

static bool is_near(double found, double expected, bool exact)
{
    double most = 1e-6 * fmax(fabs(found), fabs(expected));
    return exact ? found == expected : fabs(found - expected) <= fmax(1e-9, most);
}

/* One line "//? faces = 6" behind its "//? ". */
static bool holds(testing *t, const pcg_run *r, const char *line)
{
    const char *name = arena_copy(&t->compilation.arena, line, strcspn(line, " "));
    const char *comparison = line + strlen(name) + 1, *behind;
    double found, expected = number_read(comparison + 2, &behind);
    if (behind == comparison + 2 || !find_value(r, name, &found)) {
        say(t, "'%s' cannot be compared: count, faces, vertices, holes, area and volume can, of a "
               "port or of all that comes out", name);
        return false;
    }
    if (is_near(found, expected, *comparison == '='))
        return true;
    text numbers = {.arena = &t->compilation.arena};
    text_format(&numbers, "expected %s = ", name);
    text_number(&numbers, expected);
    text_add(&numbers, ", found ");
    text_number(&numbers, found);
    say(t, "%s", numbers.at);
    return false;
}

/* Every expectation of the example; `r` NULL: none holds. */
static void compare(testing *t, const pcg_run *r)
{
    static const char mark[] = "//? ";
    const char *at = t->example->graph.at;
    for (; at && *at; at = strchr(at, '\n'), at = at ? at + 1 : NULL) {
        if (strncmp(at, mark, sizeof mark - 1))
            continue;
        const char *line = arena_copy(&t->compilation.arena, at + 4, strcspn(at + 4, "\n"));
        bool good = r && holds(t, r, line);
        t->passed += good;
        t->failed += !good;
    }
}

/* ---- running --------------------------------------------------------------------------------- */

static void run_program(testing *t, const pcg_program *p)
{
    const pcg_run_options options = {.size = sizeof options, .message = on_message, .user = t};
    pcg_run *r = pcg_run_new(p, &options);
    interrupt_run(&t->b->guard, r);
    bool done = r && pcg_run_execute(r) == PCG_STATUS_OK;
    interrupt_run(&t->b->guard, NULL);
    if (!done && !t->said)
        say(t, "it did not run");
    compare(t, done ? r : NULL);
    pcg_run_free(r);
}

static void run_code(testing *t, const program *p)
{
    const emit_options options = {.version = PCG_VERSION, .lines = true};
    text c_text = {.arena = &t->compilation.arena};
    char *error = NULL;
    const char *why = NULL;
    emit(&t->compilation, p, &options, &c_text);
    native *n = t->compilation.diagnostics.errors ? NULL : native_new(p, c_text.at, &error);
    pcg_program *made =
        n ? compilation_program(&t->compilation, native_module(n), NULL, NULL, &why) : NULL;
    if (made) {
        run_program(t, made);
    } else {
        say(t, "%s", why ? why : error ? error : "it does not compile");
        compare(t, NULL);
    }
    pcg_program_free(made);
    native_free(n);
    free(error);
}

/* The library is in scope as the host's own: no other file of its name comes before it. */
static void run_example(testing *t)
{
    compilation *c = &t->compilation;
    opened_library *o = ARENA_NEW(&c->arena, opened_library);
    const pcg_library **given = ARENA_ARRAY(&c->arena, const pcg_library *, 2);
    *o = (opened_library){library_hold(t->library), NULL};
    given[0] = t->library->library;
    c->opened = o;
    c->libraries = given;
    c->library_paths = tool_paths(&c->arena, &t->b->libraries);
    const char *path = arena_format(&c->arena, "%s/%s.pcg", t->b->folder, t->example->name);
    const text *written = &t->example->graph;
    program *p = compile_front(c, source_new(&c->arena, path, written->at, written->length));
    bool good = p && !c->diagnostics.errors;
    if (good) {
        run_code(t, p);
        return;
    }
    say(t, "it does not compile:");
    diagnostics_print(&c->diagnostics, stderr, tool_colour());
    compare(t, NULL);
}

static void run_guarded(testing *t)
{
    t->said = false;
    t->compilation = (compilation){0};
    t->compilation.diagnostics.arena = &t->compilation.arena;
    t->compilation.arena.on_failure = &t->out_of_memory;
    if (setjmp(t->out_of_memory)) {
        say(t, "out of memory");
        t->failed++;
    } else {
        run_example(t);
    }
    compilation_end(&t->compilation);
}

int library_test(building *b)
{
    testing t = {.b = b};
    library_search s = {.why = ""};
    t.library = library_open(&s, b->name, b->made);
    if (!t.library)
        return tool_error(EXIT_NO, "%s", s.why);
    for (uint32_t i = 0; i < b->generator.examples.count; i++) {
        t.example = &b->generator.examples.at[i];
        run_guarded(&t);
    }
    library_close(t.library);
    printf("%u passed, %u failed\n", t.passed, t.failed);
    return t.failed ? EXIT_NO : EXIT_DONE;
}

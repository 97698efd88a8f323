/* command_library_build.c - pcgc library: running the C compiler. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backend.h"
#include "command_library.h"

typedef LIST(const char *) words;

/* ---- where the runtime's headers are --------------------------------------------------------- */

static bool has_headers(arena *a, const char *folder)
{
    return folder && access(arena_format(a, "%s/pcg/library.h", folder), R_OK) == 0;
}

/* Where the user says, beside pcgc where it was built, and where it was installed. NULL: told. */
static const char *find_headers(building *b)
{
    arena *a = &b->generator.arena;
    const char *own = program_folder(a), *said = getenv("PCG_INCLUDE");
    for (size_t i = 0; i < b->includes.count; i++)
        if (has_headers(a, b->includes.at[i]))
            return b->includes.at[i];
    const char *const places[] = {said, arena_format(a, "%sinclude", own),
                                  arena_format(a, "%s../include", own), PCG_PREFIX "/include"};
    for (size_t i = 0; i < COUNT_OF(places); i++)
        if (has_headers(a, places[i]))
            return places[i];
    tool_error(EXIT_USAGE,
               "the headers <pcg/…> are neither in %s nor in %s/include; -I or PCG_INCLUDE says "
               "where they are", *own ? own : "the folder of pcgc", PCG_PREFIX);
    return NULL;
}

/* ---- compiling ------------------------------------------------------------------------------- */

/* What every call begins with. The user's options come last, so that they win. Paths of the private
 * folder stay out of what is made. */
static const char *command_of(building *b)
{
    return arena_format(&b->generator.arena,
                        "%s -std=c11 %s -fPIC -fvisibility=hidden -ffp-contract=off "
                        "-fno-math-errno -Werror=implicit-function-declaration "
                        "-ffile-prefix-map=%s=. %s",
                        b->cc, b->debug ? "-g -O0" : "-O2", b->place, b->flags);
}

static bool say_missing(const building *b)
{
    tool_error(EXIT_USAGE,
               "there is no C compiler '%s': install one (gcc or clang), or name it with --cc",
               b->cc);
    return false;
}

/* One file to one object. False: its messages, which name the user's file, were printed. */
static bool compile(building *b, const char *headers, const char *file, const char *object,
                    bool *missing)
{
    arena *a = &b->generator.arena;
    words line = {0};
    complaint c = {0};
    LIST_ADD(a, &line, "-iquote");
    LIST_ADD(a, &line, b->headers);
    LIST_ADD(a, &line, "-iquote");
    LIST_ADD(a, &line, b->place);
    for (size_t i = 0; i < b->includes.count; i++) {
        LIST_ADD(a, &line, "-I");
        LIST_ADD(a, &line, b->includes.at[i]);
    }
    LIST_ADD(a, &line, "-I");
    LIST_ADD(a, &line, headers);
    LIST_ADD(a, &line, "-c");
    LIST_ADD(a, &line, file);
    LIST_ADD(a, &line, "-o");
    LIST_ADD(a, &line, object);
    LIST_ADD(a, &line, NULL);
    bool done = run_compiler(command_of(b), line.at, "", &c, missing, &b->guard);
    if (!done && !*missing)
        fprintf(stderr, "%s\n", c.text ? c.text : "out of memory");
    free(c.text);
    return done;
}

/* Every file, so that all that is wrong is said at once. */
static bool compile_all(building *b, words *objects)
{
    arena *a = &b->generator.arena;
    const char *headers = find_headers(b);
    bool done = headers != NULL, missing = false;
    pcgen_names files = pcgen_list_folder(&b->generator, b->folder, ".c");
    for (uint32_t i = 0; headers && i <= files.count && !missing; i++) {
        bool last = i == files.count;
        const char *file = last ? arena_format(a, "%s/described.c", b->place)
                                : arena_format(a, "%s/%s", b->folder, files.at[i]);
        const char *object = arena_format(a, "%s/%u.o", b->place, (unsigned)i);
        if (last && !done)
            break; /* where kernels are wrong, their table has nothing to add */
        done &= compile(b, headers, file, object, &missing);
        LIST_ADD(a, objects, object);
    }
    return missing ? say_missing(b) : done;
}

/* ---- linking --------------------------------------------------------------------------------- */

static bool is_part_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static bool mentions(const char *said, const char *symbol)
{
    size_t length = strlen(symbol);
    for (const char *at = said; (at = strstr(at, symbol)) != NULL; at += length)
        if (!is_part_of_name(at[length]) && (at == said || !is_part_of_name(at[-1])))
            return true;
    return false;
}

static void check_defined(building *b, const char *said, const char *what, const tree_name *name,
                          const char *symbol)
{
    if (mentions(said, symbol))
        diagnose(&b->generator.diagnostics, DIAG_E0815, name->span, what, name->text, symbol);
}

static void check_item(building *b, const char *said, const tree_item *item)
{
    arena *a = &b->generator.arena;
    if (item->kind == ITEM_PROCEDURE)
        check_defined(b, said, "procedure", &item->procedure->name,
                      interface_procedure_symbol(a, b->name, item->procedure->name.text));
    if (item->kind == ITEM_FUNCTION)
        check_defined(b, said, "function", &item->function->name,
                      interface_function_symbol(a, b->name, item->function));
    if (item->kind == ITEM_ENTITY)
        check_defined(b, said, "entity type", &item->entity->name,
                      interface_type_symbol(a, b->name, item->entity->name.text));
}

/* What the linker misses is declared in an interface, and said there; all else in its own words. */
static void report_link(building *b, const char *said)
{
    const pcgen_library *l = b->generator.libraries.at[0];
    for (uint32_t i = 0; i < l->files.count; i++)
        for (uint32_t k = 0; k < l->files.at[i]->tree->items.count; k++)
            check_item(b, said, &l->files.at[i]->tree->items.at[k]);
    if (b->generator.diagnostics.errors)
        diagnostics_print(&b->generator.diagnostics, stderr, tool_colour());
    else
        fprintf(stderr, "%s\n", said);
}

static bool link_objects(building *b, words *objects)
{
    arena *a = &b->generator.arena;
    complaint c = {0};
    words line = {0};
    bool missing = false;
    LIST_ADD(a, &line, "-shared");
    LIST_ADD(a, &line, "-o");
    LIST_ADD(a, &line, b->made);
    for (uint32_t i = 0; i < objects->count; i++)
        LIST_ADD(a, &line, objects->at[i]);
    LIST_ADD(a, &line, "-lm");
    LIST_ADD(a, &line, NULL);
    bool done = run_compiler(command_of(b), line.at, "", &c, &missing, &b->guard);
    if (!done)
        report_link(b, c.text ? c.text : "out of memory");
    free(c.text);
    return done;
}

/* Opens it as `use` will. */
static bool try_out(building *b)
{
    library_search s = {.why = ""};
    open_library *l = library_open(&s, b->name, b->made);
    if (!l)
        tool_error(EXIT_NO, "library '%s' could not be used: %s", b->name, s.why);
    library_close(l);
    return l != NULL;
}

bool library_build(building *b)
{
    words objects = {0};
    b->made = arena_format(&b->generator.arena, "%s/%s.so", b->place, b->name);
    return compile_all(b, &objects) && link_objects(b, &objects) && try_out(b);
}

/* command_library.c - pcgc library: a folder of C files with interfaces to a shared object that
 * `use` finds.
 *
 * The generator that makes the built-in libraries' headers and tables makes this one's, in a
 * private folder; a C compiler does the rest. What was made is opened before it is given its name,
 * so that no broken library is left behind. */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command_library.h"
#include "library.h"

/* ---- the private folder ---------------------------------------------------------------------- */

static bool make_place(building *b)
{
    const char *where = getenv("TMPDIR");
    int size = snprintf(b->place, sizeof b->place, "%s/pcgc-library-XXXXXX",
                        where && *where ? where : "/tmp");
    if (size < 0 || (size_t)size >= sizeof b->place)
        snprintf(b->place, sizeof b->place, "/tmp/pcgc-library-XXXXXX");
    interrupt_lock(&b->guard);
    bool made = mkdtemp(b->place) != NULL;
    if (made)
        interrupt_keep(&b->guard, &b->place_kept, b->place);
    interrupt_unlock(&b->guard);
    if (!made) {
        tool_error(EXIT_USAGE, "cannot make the folder '%s': %s", b->place, strerror(errno));
        b->place[0] = '\0';
        return false;
    }
    b->headers = arena_format(&b->generator.arena, "%s/%s", b->place, b->name);
    interrupt_lock(&b->guard); /* what is kept last is removed first */
    interrupt_keep(&b->guard, &b->headers_kept, b->headers);
    interrupt_unlock(&b->guard);
    return true;
}

static void remove_place(building *b)
{
    if (!b->place[0])
        return;
    if (b->headers)
        interrupt_remove(b->headers);
    interrupt_remove(b->place);
    interrupt_lock(&b->guard);
    interrupt_drop(&b->guard, &b->headers_kept);
    interrupt_drop(&b->guard, &b->place_kept);
    interrupt_unlock(&b->guard);
}

/* ---- names ----------------------------------------------------------------------------------- */

static const char *last_part(arena *a, const char *folder)
{
    size_t end = strlen(folder), from;
    while (end > 1 && folder[end - 1] == '/')
        end--;
    for (from = end; from > 0 && folder[from - 1] != '/'; from--)
        ;
    return arena_copy(a, folder + from, end - from);
}

/* -1 to go on, or an exit code. */
static int check_name(building *b, const command *self)
{
    if (!b->name)
        b->name = last_part(&b->generator.arena, b->folder);
    if (!library_is_name(b->name))
        return usage_error(self,
                           "'%s' is no name for a library: a letter, then letters, digits and "
                           "underscores; --name gives it another", b->name);
    for (uint32_t i = 0; library_builtin[i]; i++)
        if (!strcmp(library_builtin[i]->name, b->name))
            return usage_error(self, "there is a library '%s' already, which is built in; --name "
                                     "gives this one another name", b->name);
    return -1;
}

static bool is_part_of_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* Whether the runtime's own header uses that name. */
static bool is_taken(const char *symbol)
{
    size_t length = strlen(symbol);
    for (const char *at = pcg_abi_text; (at = strstr(at, symbol)) != NULL; at += length)
        if (!is_part_of_name(at[length]) && !is_part_of_name(at[-1]))
            return true;
    return false;
}

static void check_symbol(building *b, const tree_name *name, const char *symbol)
{
    if (is_taken(symbol))
        diagnose(&b->generator.diagnostics, DIAG_E0816, name->span, name->text, symbol);
}

static void check_symbols(building *b, const tree_file *tree)
{
    arena *a = &b->generator.arena;
    for (uint32_t i = 0; i < tree->items.count; i++) {
        const tree_item *item = &tree->items.at[i];
        if (item->kind == ITEM_PROCEDURE)
            check_symbol(b, &item->procedure->name,
                         interface_procedure_symbol(a, b->name, item->procedure->name.text));
        else if (item->kind == ITEM_ENTITY)
            check_symbol(b, &item->entity->name,
                         interface_type_symbol(a, b->name, item->entity->name.text));
    }
}

/* ---- the interfaces -------------------------------------------------------------------------- */

static int read_interfaces(building *b)
{
    pcgen *g = &b->generator;
    for (uint32_t i = 0; library_builtin[i]; i++)
        pcgen_know_library(g, library_builtin[i]);
    pcgen_read_library(g, b->folder, b->name);
    if (g->failed)
        return EXIT_USAGE;
    if (!g->libraries.count)
        return tool_error(EXIT_NO,
                          "no file in '%s' holds an interface: a comment that begins with /*pcg",
                          b->folder);
    pcgen_check(g);
    for (uint32_t i = 0; !g->diagnostics.errors && i < g->libraries.at[0]->files.count; i++)
        check_symbols(b, g->libraries.at[0]->files.at[i]->tree);
    if (!g->diagnostics.errors)
        pcgen_make_examples(g);
    diagnostics_print(&g->diagnostics, stderr, tool_colour());
    return g->diagnostics.errors ? EXIT_NO : -1;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int write_made(building *b)
{
    enum { MOST_BYTES = 1 << 30 };
    const char *output = b->output;
    if (!output && b->test)
        return EXIT_DONE;
    if (!output)
        output = arena_format(&b->generator.arena, "%s.so", b->name);
    const source *s = source_read(&b->generator.arena, b->made, MOST_BYTES);
    if (!s)
        return tool_error(EXIT_USAGE, "cannot read '%s': %s", b->made, strerror(errno));
    return tool_write(&b->guard, output, s->text, s->size) ? EXIT_DONE : EXIT_USAGE;
}

static int build(building *b)
{
    pcgen *g = &b->generator;
    int code = read_interfaces(b);
    if (code >= 0)
        return code;
    if (!make_place(b))
        return EXIT_USAGE;
    g->output = b->place;
    pcgen_write_headers(g);
    pcgen_write_description(g);
    if (g->failed)
        return EXIT_USAGE;
    if (!library_build(b))
        return EXIT_NO;
    code = write_made(b);
    return code == EXIT_DONE && b->test ? library_test(b) : code;
}

/* As build; memory that runs out ends it. */
static int build_guarded(building *b)
{
    if (setjmp(b->out_of_memory))
        return tool_error(EXIT_LIMIT, "out of memory");
    b->generator.arena.on_failure = &b->out_of_memory;
    return build(b);
}

static int begin(building *b, const command *self, const option_texts *files)
{
    if (files->count != 1)
        return usage_error(self, files->count ? "one folder at a time" : "which folder?");
    b->folder = files->at[0];
    pcgen_begin(&b->generator, "pcgc", NULL);
    b->generator.foreign = true;
    b->generator.version = PCG_VERSION;
    int code = check_name(b, self);
    if (code < 0 && b->skeleton)
        code = library_skeleton(b->folder, b->name);
    return code < 0 ? build_guarded(b) : code;
}

static int run_library(const command *self, int argc, char **argv)
{
    building b = {.cc = "cc", .flags = ""};
    option_texts files = {0};
    const option options[] = {
        {'o', "output", OPTION_TEXT, &b.output, "FILE", "where to; NAME.so when not given"},
        {0, "name", OPTION_TEXT, &b.name, "NAME",
         "what `use` calls it; the folder's name when not given"},
        {0, "test", OPTION_FLAG, &b.test, NULL, "run its examples; without -o nothing is written"},
        {0, "new", OPTION_FLAG, &b.skeleton, NULL, "write a small library into a new FOLDER"},
        {0, "cc", OPTION_TEXT, &b.cc, "CC", "the C compiler; cc when not given"},
        {0, "cflags", OPTION_TEXT, &b.flags, "FLAGS", "more options for it, also when it links"},
        {0, "debug", OPTION_FLAG, &b.debug, NULL, "for a debugger: -g -O0"},
        {'I', "include", OPTION_TEXTS, &b.includes, "FOLDER",
         "look for headers there, <pcg/…> too"},
        {'L', "library-path", OPTION_TEXTS, &b.libraries, "FOLDER",
         "where its examples find other libraries"},
        {0}};
    int code = options_read(&b.generator.arena, self, options, argc, argv, &files);
    if (code < 0) {
        interrupt_begin(&b.guard, "pcgc");
        code = begin(&b, self, &files);
        remove_place(&b);
        code = interrupt_end(&b.guard) ? EXIT_INTERRUPTED : code;
    }
    arena_free(&b.generator.arena);
    return code;
}

static const char *const examples[] = {
    "pcgc library --new zoning", "pcgc library zoning --test", "pcgc library zoning -o zoning.so",
    "pcgc library zoning --cc clang --cflags '-O3 -Wall'", NULL};
const command command_library = {"library", "FOLDER",
                                 "Builds a procedure library from a folder of C files.", examples,
                                 run_library};

/* command_doc.c - pcgc doc: the reference, from the interfaces of the libraries. */
#include <string.h>

#include "../runtime/library_open.h"
#include "reference.h"
#include "tool.h"

typedef struct documenting {
    jmp_buf out_of_memory;
    arena arena;
    const char *search;
    bool html, json, markdown;
    option_texts names, used, library_paths;
    opened_library *opened;
} documenting;

static int write_out(const text *out)
{
    return tool_write(NULL, "-", out->at ? out->at : "", out->length) ? EXIT_DONE : EXIT_USAGE;
}

static int not_found(const reference *r, const char *word)
{
    const char *near = reference_nearest(r, word);
    if (near)
        return tool_error(EXIT_NO, "nothing is called '%s', did you mean '%s'?", word, near);
    return tool_error(EXIT_NO, "nothing is called '%s'; pcgc doc lists everything", word);
}

static int search(const documenting *k, const reference *r, text *out)
{
    reference_items found = reference_search(r, k->search);
    if (!found.count)
        return not_found(r, k->search);
    if (k->json)
        reference_write_json(r, &found, out);
    else
        reference_write_list(&found, out);
    return write_out(out);
}

/* What a synonym stands for, the best first; nothing where the word is none. */
static reference_items find_synonym(const reference *r, const char *word)
{
    const char *near = reference_nearest(r, word);
    reference_items none = {NULL, 0, 0};
    return near && strcmp(near, word) == 0 ? reference_search(r, word) : none;
}

/* Entries by name; where there is none, libraries, and then those that have it as a synonym. */
static int write_named(const documenting *k, const reference *r, text *out)
{
    reference_items all = {NULL, 0, 0};
    for (size_t i = 0; i < k->names.count; i++) {
        const char *name = k->names.at[i];
        reference_items found = reference_find(r, name);
        if (!found.count && reference_has_library(r, name) && !k->json) {
            reference_write_index(r, name, out);
            continue;
        }
        if (!found.count)
            found = find_synonym(r, name);
        if (!found.count)
            return not_found(r, name);
        for (uint32_t n = 0; n < found.count; n++) {
            LIST_ADD(r->arena, &all, found.at[n]);
            if (k->json)
                continue;
            text_add(out, out->length ? "\n" : "");
            reference_write_text(r, found.at[n], out);
        }
    }
    if (k->json)
        reference_write_json(r, &all, out);
    return write_out(out);
}

static int write_everything(const documenting *k, const reference *r, text *out)
{
    if (k->html)
        reference_write_html(r, out);
    else if (k->markdown)
        reference_write_markdown(r, out);
    else if (k->json)
        reference_write_json(r, &r->items, out);
    else
        reference_write_index(r, NULL, out);
    return write_out(out);
}

/* ---- libraries that are not built in --------------------------------------------------------- */

/* Looks on the search path that a graph in this folder has. False, and search->why, where it is not
 * there. */
static bool add_library(documenting *k, reference *r, library_search *search, const char *name)
{
    char path[LIBRARY_PATH_BYTES];
    if (reference_has_library(r, name))
        return true;
    opened_library *o = ARENA_NEW(&k->arena, opened_library);
    if (!library_locate(search, name, path))
        return false;
    o->library = library_open(search, name, path);
    if (!o->library)
        return false;
    o->next = k->opened;
    k->opened = o;
    reference_add(r, o->library->library);
    return true;
}

/* Something is called so: no file of that name is looked for. */
static bool is_known(const reference *r, const char *name)
{
    bool known = reference_has_library(r, name);
    for (uint32_t i = 0; i < r->libraries.count && !known; i++)
        for (library_entry_kind kind = ENTRY_PROCEDURE; kind <= ENTRY_ENUMERATION && !known; kind++)
            known = library_find(r->libraries.at[i], name, kind) != NULL;
    return known;
}

/* Those of --use, and the ones that names begin with: zoning, zoning.zone. -1 to go on. */
static int add_libraries(documenting *k, reference *r)
{
    library_search s = {.folder = "", .paths = tool_paths(&k->arena, &k->library_paths)};
    for (size_t i = 0; i < k->used.count; i++)
        if (!add_library(k, r, &s, k->used.at[i]))
            return tool_error(EXIT_USAGE, "library '%s': %s", k->used.at[i], s.why);
    for (size_t i = 0; i < k->names.count; i++) {
        const char *name = k->names.at[i];
        size_t length = strcspn(name, ".");
        char path[LIBRARY_PATH_BYTES];
        const char *library = arena_copy(&k->arena, name, length);
        if (!is_known(r, library) && library_locate(&s, library, path) &&
            !add_library(k, r, &s, library))
            return tool_error(EXIT_USAGE, "library '%s': %s", library, s.why);
    }
    return -1;
}

static int document(documenting *k, const command *self)
{
    if (k->html + k->json + k->markdown > 1)
        return usage_error(self, "one of --html, --markdown and --json at a time");
    if ((k->html || k->markdown) && (k->search || k->names.count))
        return usage_error(self, "--html and --markdown write the whole reference");
    if (k->search && (k->names.count || !k->search[strspn(k->search, " ")]))
        return usage_error(self, "--search takes the words that are looked for, and no name");
    reference r = {0};
    text out = {.arena = &k->arena};
    reference_begin(&r, &k->arena);
    int code = add_libraries(k, &r);
    if (code >= 0)
        return code;
    reference_read(&r);
    if (k->search)
        return search(k, &r, &out);
    return k->names.count ? write_named(k, &r, &out) : write_everything(k, &r, &out);
}

/* As document; memory that runs out ends it. */
static int document_guarded(documenting *k, const command *self)
{
    if (setjmp(k->out_of_memory))
        return tool_error(EXIT_LIMIT, "out of memory");
    k->arena.on_failure = &k->out_of_memory;
    return document(k, self);
}

static int run_doc(const command *self, int argc, char **argv)
{
    documenting k = {0};
    const option options[] = {
        {'s', "search", OPTION_TEXT, &k.search, "WORDS", "find by name, synonym, group or summary"},
        {0, "html", OPTION_FLAG, &k.html, NULL, "the whole reference as one page"},
        {0, "markdown", OPTION_FLAG, &k.markdown, NULL, "the whole reference as Markdown"},
        {0, "json", OPTION_FLAG, &k.json, NULL, "for programs"},
        {'u', "use", OPTION_TEXTS, &k.used, "LIBRARY", "with a library that is not built in"},
        {'L', "library-path", OPTION_TEXTS, &k.library_paths, "FOLDER",
         "look for libraries there, too"},
        {0}};
    int code = options_read(&k.arena, self, options, argc, argv, &k.names);
    if (code < 0)
        code = document_guarded(&k, self);
    for (const opened_library *o = k.opened; o; o = o->next)
        library_close(o->library);
    arena_free(&k.arena);
    return code;
}

static const char *const examples[] = {"pcgc doc", "pcgc doc split", "pcgc doc --search roof",
                                       "pcgc doc --html > reference.html", NULL};
const command command_doc = {"doc", "[NAME…]",
                             "Explains procedures, functions, types; without a name, lists them.",
                             examples, run_doc};

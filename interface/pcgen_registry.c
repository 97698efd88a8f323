/* pcgen_registry.c - libraries as tables: those that are built in, and one that is not. */
#include "pcgen.h"

#include <stdlib.h>
#include <string.h>

typedef LIST(library_entry) entry_list;
typedef LIST(pcgen_symbol) symbol_list;

/* ---- layouts --------------------------------------------------------------------------------- */

/* FNV-1a. */
static uint64_t hash_text(uint64_t hash, const text *t)
{
    for (size_t i = 0; i < t->length; i++) {
        hash = (hash ^ (unsigned char)t->at[i]) * 0x100000001b3u;
    }
    return hash;
}

/* Of the library's enumerations: their numbers are part of what callers are compiled with. */
static uint64_t hash_enumerations(pcgen *g, const pcgen_library *l)
{
    text all = {.arena = &g->arena};
    for (uint32_t i = 0; i < l->files.count; i++) {
        const tree_file *tree = l->files.at[i]->tree;
        for (uint32_t k = 0; k < tree->items.count; k++) {
            if (tree->items.at[k].kind == ITEM_ENUMERATION) {
                interface_write_enumeration(&all, l->name, tree->items.at[k].enumeration);
            }
        }
    }
    return hash_text(0xcbf29ce484222325u, &all);
}

static void add_symbol(pcgen *g, symbol_list *symbols, const char *name, const pcgen_library *l,
                       const text *declaration)
{
    const pcgen_symbol s = {name, hash_text(hash_enumerations(g, l), declaration)};
    LIST_ADD(&g->arena, symbols, s);
}

/* ---- what a library declares ----------------------------------------------------------------- */

static void add_entry(pcgen *g, entry_list *list, library_entry e)
{
    LIST_ADD(&g->arena, list, e);
}

static void collect_procedure(pcgen *g, entry_list *entries, symbol_list *symbols,
                              const pcgen_library *l, const tree_procedure *p, uint32_t file)
{
    add_entry(g, entries, (library_entry){p->name.text, ENTRY_PROCEDURE, file, NULL});
    for (uint32_t i = 0; i < p->former.count; i++) {
        library_entry former = {p->former.at[i].text, ENTRY_PROCEDURE, file, p->name.text};
        add_entry(g, entries, former);
    }
    text declaration = {.arena = &g->arena};
    interface_write_procedure(&declaration, l->name, p, "", &g->types);
    add_symbol(g, symbols, interface_procedure_symbol(&g->arena, l->name, p->name.text), l,
               &declaration);
}

/* Overloads of a function in one file are one entry: who looks it up reads the whole file. */
static void collect_function(pcgen *g, entry_list *entries, symbol_list *symbols,
                             const pcgen_library *l, const tree_function *f, uint32_t file)
{
    text declaration = {.arena = &g->arena};
    interface_write_function(&declaration, l->name, f, "", &g->types);
    add_symbol(g, symbols, interface_function_symbol(&g->arena, l->name, f), l, &declaration);
    for (uint32_t i = 0; i < entries->count; i++) {
        const library_entry *e = &entries->at[i];
        if (e->kind == ENTRY_FUNCTION && e->file == file && strcmp(e->name, f->name.text) == 0) {
            return;
        }
    }
    add_entry(g, entries, (library_entry){f->name.text, ENTRY_FUNCTION, file, NULL});
}

static void collect(pcgen *g, const pcgen_library *l, entry_list *entries, symbol_list *symbols)
{
    for (uint32_t i = 0; i < l->files.count; i++) {
        const tree_file *tree = l->files.at[i]->tree;
        for (uint32_t k = 0; k < tree->items.count; k++) {
            const tree_item *item = &tree->items.at[k];
            if (item->kind == ITEM_PROCEDURE) {
                collect_procedure(g, entries, symbols, l, item->procedure, i);
            } else if (item->kind == ITEM_FUNCTION) {
                collect_function(g, entries, symbols, l, item->function, i);
            } else if (item->kind == ITEM_ENTITY) {
                const char *name = item->entity->name.text;
                add_entry(g, entries, (library_entry){name, ENTRY_ENTITY, i, NULL});
            } else if (item->kind == ITEM_ENUMERATION) {
                const char *name = item->enumeration->name.text;
                add_entry(g, entries, (library_entry){name, ENTRY_ENUMERATION, i, NULL});
            }
        }
    }
}

static int compare_entries(const void *a, const void *b)
{
    const library_entry *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    if (order != 0) {
        return order;
    }
    if (x->kind != y->kind) {
        return x->kind < y->kind ? -1 : 1;
    }
    return x->file < y->file ? -1 : x->file > y->file;
}

static int compare_symbols(const void *a, const void *b)
{
    return strcmp(((const pcgen_symbol *)a)->name, ((const pcgen_symbol *)b)->name);
}

static int compare_entities(const void *a, const void *b)
{
    const tree_entity *x = *(const tree_entity *const *)a, *y = *(const tree_entity *const *)b;
    return strcmp(x->name.text, y->name.text);
}

/* ---- tables ---------------------------------------------------------------------------------- */

static void write_files(text *out, const pcgen_library *l)
{
    text_format(out, "static const library_file %s_files[] = {\n", l->name);
    for (uint32_t i = 0; i < l->files.count; i++) {
        const pcgen_file *f = l->files.at[i];
        text_format(out, "    {\"%s\", %u,\n    ", f->path, f->line);
        pcgen_write_string(out, f->block);
        text_add(out, "},\n");
    }
    text_add(out, "};\n\n");
}

static void write_entries(text *out, const pcgen_library *l, const entry_list *entries)
{
    if (entries->count == 0) {
        return; /* C has no empty arrays */
    }
    static const char *const kinds[] = {"ENTRY_PROCEDURE", "ENTRY_FUNCTION", "ENTRY_ENTITY",
                                        "ENTRY_ENUMERATION"};
    text_format(out, "static const library_entry %s_entries[] = {\n", l->name);
    for (uint32_t i = 0; i < entries->count; i++) {
        const library_entry *e = &entries->at[i];
        text_add(out, "    {");
        pcgen_write_string(out, e->name);
        text_format(out, ", %s, %u, ", kinds[e->kind], e->file);
        if (e->former_of) {
            pcgen_write_string(out, e->former_of);
        } else {
            text_add(out, "NULL");
        }
        text_add(out, "},\n");
    }
    text_add(out, "};\n\n");
}

static void write_symbols(text *out, const pcgen_library *l, const symbol_list *symbols)
{
    if (symbols->count == 0) {
        return;
    }
    text_format(out, "static const library_symbol %s_symbols[] = {\n", l->name);
    for (uint32_t i = 0; i < symbols->count; i++) {
        const pcgen_symbol *s = &symbols->at[i];
        text_format(out, "    {\"%s\", (void (*)(void))%s, 0x%llxu},\n", s->name, s->name,
                    (unsigned long long)s->layout);
    }
    text_add(out, "};\n\n");
}

static void write_table(text *out, const pcgen_library *l, const char *name, uint32_t count)
{
    if (count > 0) {
        text_format(out, "%s_%s, ", l->name, name);
    } else {
        text_add(out, "NULL, ");
    }
}

/* The descriptions of the entity types; how many there are. */
static uint32_t write_types(pcgen *g, text *out, const pcgen_library *l)
{
    LIST(const tree_entity *) all = {NULL, 0, 0};
    for (uint32_t i = 0; i < l->files.count; i++) {
        const tree_file *tree = l->files.at[i]->tree;
        for (uint32_t k = 0; k < tree->items.count; k++) {
            if (tree->items.at[k].kind == ITEM_ENTITY) {
                LIST_ADD(&g->arena, &all, tree->items.at[k].entity);
            }
        }
    }
    if (all.count == 0) {
        return 0;
    }
    qsort(all.at, all.count, sizeof all.at[0], compare_entities);
    text_format(out, "static const library_entity %s_types[] = {\n", l->name);
    for (uint32_t i = 0; i < all.count; i++) {
        const tree_entity *e = all.at[i];
        text_format(out, "    {\"%s\", \"%s\", &%s},\n", e->name.text,
                    e->parent.text ? e->parent.text : "Entity",
                    interface_type_symbol(&g->arena, l->name, e->name.text));
    }
    text_add(out, "};\n\n");
    return all.count;
}

/* The tables of a library, and its description under the name that `head` declares. Entity types of
 * what is built in are the runtime's own. */
static void write_library(pcgen *g, text *out, const pcgen_library *l, const char *head)
{
    entry_list entries = {NULL, 0, 0};
    symbol_list symbols = {NULL, 0, 0};
    collect(g, l, &entries, &symbols);
    if (entries.count > 0) {
        qsort(entries.at, entries.count, sizeof entries.at[0], compare_entries);
    }
    if (symbols.count > 0) {
        qsort(symbols.at, symbols.count, sizeof symbols.at[0], compare_symbols);
    }
    write_files(out, l);
    write_entries(out, l, &entries);
    write_symbols(out, l, &symbols);
    uint32_t types = g->foreign ? write_types(g, out, l) : 0;
    text_format(out, "%s = {\n    PCG_ABI, sizeof(pcg_library), \"%s\",\n    ", head, l->name);
    pcgen_write_string(out, l->document ? l->document : "");
    text_add(out, ",\n    ");
    pcgen_write_string(out, g->version ? g->version : "");
    text_format(out, ", %s_files, ", l->name);
    write_table(out, l, "entries", entries.count);
    write_table(out, l, "symbols", symbols.count);
    write_table(out, l, "types", types);
    text_format(out, "%u, %u, %u, %u,\n};\n\n", l->files.count, entries.count, symbols.count,
                types);
}

static void include_headers(text *out, const pcgen_library *l)
{
    for (uint32_t k = 0; k < l->files.count; k++) {
        text_format(out, "#include \"%s/%s.h\"\n", l->name, l->files.at[k]->name);
    }
}

/* What a library declares and does not define is missed when it is linked, not when it is used. */
void pcgen_write_description(pcgen *g)
{
    const pcgen_library *l = g->libraries.at[0];
    text out = {.arena = &g->arena};
    text_format(&out, "/* Made from the interfaces of library %s: change them there. */\n",
                l->name);
    text_add(&out, "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n");
    text_add(&out, "#include <pcg/library.h>\n#pragma GCC visibility push(hidden)\n");
    include_headers(&out, l);
    text_add(&out, "#pragma GCC visibility pop\n\n");
    write_library(g, &out, l,
                  "extern const pcg_library pcg_described;\n"
                  "__attribute__((visibility(\"default\"))) const pcg_library pcg_described");
    pcgen_write_file(g, "described.c", &out);
}

void pcgen_write_registry(pcgen *g)
{
    text out = {.arena = &g->arena};
    text_add(&out, "/* Made from the interfaces of all libraries: change them there. */\n");
    text_add(&out, "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n");
    text_add(&out, "#include \"interface/interface.h\"\n#include \"runtime/abi.h\"\n");
    for (uint32_t i = 0; i < g->libraries.count; i++) {
        include_headers(&out, g->libraries.at[i]);
    }
    text_add(&out, "\n");
    for (uint32_t i = 0; i < g->libraries.count; i++) {
        const char *name = g->libraries.at[i]->name;
        const char *head = arena_format(&g->arena, "static const pcg_library %s_library", name);
        write_library(g, &out, g->libraries.at[i], head);
    }
    text_add(&out, "const pcg_library *const library_builtin[] = {\n");
    for (uint32_t i = 0; i < g->libraries.count; i++) {
        text_format(&out, "    &%s_library,\n", g->libraries.at[i]->name);
    }
    text_add(&out, "    NULL,\n};\n");
    pcgen_write_file(g, "registry.c", &out);
}

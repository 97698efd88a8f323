/* pcgen_read.c - from folders to syntax trees. */
#include "pcgen.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool ends_with(const char *name, const char *end)
{
    size_t length = strlen(name), end_length = strlen(end);
    return length > end_length && strcmp(name + length - end_length, end) == 0;
}

/* ---- the generator --------------------------------------------------------------------------- */

void pcgen_fail(pcgen *g, const char *path)
{
    fprintf(stderr, "%s: %s: %s\n", g->program, path, strerror(errno));
    g->failed = true;
}

static bool is_enumeration(void *context, const char *name)
{
    const pcgen *g = context;
    return table_get(&g->enumerations, name) != NULL;
}

static bool is_entity(void *context, const char *name)
{
    const pcgen *g = context;
    return strcmp(name, "Entity") == 0 || table_get(&g->entities, name) != NULL;
}

void pcgen_begin(pcgen *g, const char *program, const char *output)
{
    g->program = program;
    g->output = output;
    g->diagnostics.arena = &g->arena;
    g->types = (interface_types){g, is_enumeration, is_entity};
}

/* ---- reading --------------------------------------------------------------------------------- */

pcgen_names pcgen_list_folder(pcgen *g, const char *folder, const char *end)
{
    pcgen_names names = {NULL, 0, 0};
    DIR *d = opendir(folder);
    if (!d) {
        pcgen_fail(g, folder);
        return names;
    }
    for (struct dirent *e = readdir(d); e; e = readdir(d)) {
        if (ends_with(e->d_name, end)) {
            LIST_ADD(&g->arena, &names, arena_copy(&g->arena, e->d_name, strlen(e->d_name)));
        }
    }
    closedir(d);
    if (names.count > 0) {
        qsort(names.at, names.count, sizeof names.at[0], compare_names);
    }
    return names;
}

/* The files of a library that may hold an interface, by name. */
static pcgen_names list_files(pcgen *g, const char *folder)
{
    static const char own[] = "library.pcg";
    pcgen_names names = pcgen_list_folder(g, folder, ".c");
    if (!g->failed && access(arena_format(&g->arena, "%s/%s", folder, own), F_OK) == 0) {
        LIST_ADD(&g->arena, &names, own);
        qsort(names.at, names.count, sizeof names.at[0], compare_names);
    }
    return names;
}

/* The file up to the end of its block with everything before the block blank, so that places in
 * the block are places in the file. */
static source *blank_before(pcgen *g, const source *file, const char *path, const pcgen_file *f)
{
    const char *at = file->text;
    for (uint32_t line = 1; line < f->line; line++) {
        at = (const char *)memchr(at, '\n', file->size - (size_t)(at - file->text)) + 1;
    }
    size_t from = (size_t)(at - file->text), size = from + strlen(f->block);
    char *copy = arena_copy(&g->arena, file->text, size);
    for (size_t i = 0; i < from; i++) {
        if (copy[i] != '\n') {
            copy[i] = ' ';
        }
    }
    return source_new(&g->arena, path, copy, size);
}

static pcgen_file *read_file(pcgen *g, const char *folder, const char *library, const char *name)
{
    const char *path = arena_format(&g->arena, "%s/%s", folder, name);
    source *s = source_read(&g->arena, path, LANG_MAX_BYTES);
    if (!s) {
        pcgen_fail(g, path);
        return NULL;
    }
    pcgen_file *f = ARENA_NEW(&g->arena, pcgen_file);
    f->path = arena_format(&g->arena, "%s/%s", library, name);
    f->name = arena_copy(&g->arena, name, (size_t)(strrchr(name, '.') - name));
    if (ends_with(name, ".pcg")) {
        f->block = s->text;
        f->line = 1;
    } else if (!interface_extract(&g->arena, s, &f->block, &f->line)) {
        return NULL;
    } else {
        s = blank_before(g, s, path, f);
    }
    f->tree = lang_parse(&g->arena, s, &g->diagnostics);
    return f;
}

static void note_types(pcgen *g, const tree_file *tree)
{
    for (uint32_t i = 0; i < tree->items.count; i++) {
        const tree_item *item = &tree->items.at[i];
        if (item->kind == ITEM_ENUMERATION && item->enumeration->name.text) {
            table_put(&g->arena, &g->enumerations, item->enumeration->name.text, item->enumeration);
        } else if (item->kind == ITEM_ENTITY && item->entity->name.text) {
            table_put(&g->arena, &g->entities, item->entity->name.text, item->entity);
        }
    }
}

static const char *last_part(pcgen *g, const char *folder)
{
    size_t end = strlen(folder);
    while (end > 1 && folder[end - 1] == '/') {
        end--;
    }
    size_t from = end;
    while (from > 0 && folder[from - 1] != '/') {
        from--;
    }
    return arena_copy(&g->arena, folder + from, end - from);
}

void pcgen_read_library(pcgen *g, const char *folder, const char *name)
{
    pcgen_library *l = ARENA_NEW(&g->arena, pcgen_library);
    l->name = name ? name : last_part(g, folder);
    pcgen_names names = list_files(g, folder);
    for (uint32_t i = 0; i < names.count; i++) {
        pcgen_file *f = read_file(g, folder, l->name, names.at[i]);
        if (!f) {
            continue;
        }
        LIST_ADD(&g->arena, &l->files, f);
        note_types(g, f->tree);
        if (strcmp(f->name, "library") == 0 && f->tree->document) {
            l->document = f->tree->document;
        }
    }
    if (l->files.count > 0) {
        LIST_ADD(&g->arena, &g->libraries, l);
    }
}

void pcgen_know_library(pcgen *g, const pcg_library *l)
{
    pcgen_library *known = ARENA_NEW(&g->arena, pcgen_library);
    known->name = l->name;
    for (uint32_t i = 0; i < l->file_count; i++) {
        const library_file *from = &l->files[i];
        pcgen_file *f = ARENA_NEW(&g->arena, pcgen_file);
        *f = (pcgen_file){.path = from->path, .name = from->path, .block = from->text};
        f->line = from->line;
        const source *s = source_new(&g->arena, f->path, f->block, strlen(f->block));
        f->tree = lang_parse(&g->arena, s, &g->diagnostics);
        LIST_ADD(&g->arena, &known->files, f);
        note_types(g, f->tree);
    }
    LIST_ADD(&g->arena, &g->known, known);
}

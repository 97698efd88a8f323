/* library_use.c - libraries that are not built in: what `use` finds on the search path.
 *
 * The compilation holds each open until it ends. A program that is made of it holds what it calls
 * for itself. */
#include "../runtime/program.h"
#include "library.h"

#include <string.h>

/* ---- what two libraries cannot both declare -------------------------------------------------- */

static bool is_unique_kind(library_entry_kind kind)
{
    return kind == ENTRY_ENTITY || kind == ENTRY_ENUMERATION;
}

/* A type, or a name in C, that both declare; NULL where there is none. */
static const char *common_name(const pcg_library *l, const pcg_library *other)
{
    for (uint32_t i = 0; i < l->entry_count; i++) {
        const library_entry *e = &l->entries[i];
        if (is_unique_kind(e->kind) && library_find(other, e->name, e->kind))
            return e->name;
    }
    for (uint32_t i = 0; i < l->symbol_count; i++)
        if (library_find_symbol(other, l->symbols[i].name))
            return l->symbols[i].name;
    return NULL;
}

/* PCG_ROOF_KIND_FLAT stands for RoofKind's flat and for Roof's kind_flat. */
static void note_constants(compilation *c, program *p, const pcg_library *l, table *all,
                           const char **twice)
{
    for (uint32_t i = 0; i < l->entry_count; i++) {
        if (l->entries[i].kind != ENTRY_ENUMERATION)
            continue;
        const enumeration *e = find_enumeration(c, p, l->entries[i].name);
        for (uint32_t k = 0; e && k < e->count; k++) {
            const char *spelt = interface_constant(&c->arena, e->name, e->names[k]);
            if (table_get(all, spelt))
                *twice = spelt;
            table_put(&c->arena, all, spelt, (void *)(uintptr_t)spelt);
        }
    }
}

/* Whether the newest library can stand beside the others; reports what it shares with one. */
static bool fits_beside(compilation *c, program *p, const tree_name *name)
{
    uint32_t newest = p->libraries.count - 1;
    const char *common = NULL;
    const pcg_library *l = p->libraries.at[newest], *other = NULL;
    for (uint32_t i = 0; i < newest && !common; i++) {
        other = p->libraries.at[i];
        common = common_name(l, other);
    }
    for (uint32_t i = p->common_libraries; i < newest && !common; i++) {
        table constants = {0};
        other = p->libraries.at[i];
        note_constants(c, p, other, &constants, &common);
        note_constants(c, p, l, &constants, &common);
    }
    if (common)
        diagnose(&c->diagnostics, DIAG_E0124, name->span, l->name, other->name, common);
    return !common;
}

/* ---- opening --------------------------------------------------------------------------------- */

static open_library *find_open(const compilation *c, const char *name)
{
    for (const opened_library *o = c->opened; o; o = o->next)
        if (!strcmp(o->library->library->name, name))
            return o->library;
    return NULL;
}

static const pcg_library *bring_in(compilation *c, program *p, const pcg_library *l,
                                   const tree_name *name)
{
    for (uint32_t i = 0; i < p->libraries.count; i++)
        if (p->libraries.at[i] == l)
            return l;
    LIST_ADD(&c->arena, &p->libraries, l);
    if (fits_beside(c, p, name))
        return l;
    p->libraries.count--;
    return NULL;
}

static const pcg_library *open_found(compilation *c, program *p, library_search *s,
                                     const char *path, const tree_name *name)
{
    opened_library *o = ARENA_NEW(&c->arena, opened_library);
    o->library = library_open(s, name->text, path);
    if (!o->library) {
        diagnose(&c->diagnostics, DIAG_E0122, name->span, path, s->why);
        return NULL;
    }
    o->next = c->opened;
    c->opened = o;
    return bring_in(c, p, o->library->library, name);
}

const pcg_library *library_use(compilation *c, program *p, const unit *u, const tree_name *name)
{
    char path[LIBRARY_PATH_BYTES];
    library_search s = {.folder = u->folder, .paths = c->library_paths};
    for (uint32_t i = 0; i < p->common_libraries; i++)
        if (!strcmp(p->libraries.at[i]->name, name->text))
            return p->libraries.at[i];
    bool found = !c->closed && library_locate(&s, name->text, path);
    const open_library *known = find_open(c, name->text);
    if (known && found && !library_is_file(known, path)) {
        diagnose(&c->diagnostics, DIAG_E0123, name->span, name->text, known->path, path);
        return NULL;
    }
    if (known)
        return bring_in(c, p, known->library, name);
    if (found)
        return open_found(c, p, &s, path, name);
    library_report_unknown(c, p, name)->help =
        c->closed ? "this compilation reads no files" : arena_copy(&c->arena, s.why, strlen(s.why));
    return NULL;
}

/* ---- for who owns a compilation -------------------------------------------------------------- */

const char *library_path(const compilation *c, const pcg_library *l)
{
    for (const opened_library *o = c->opened; o; o = o->next)
        if (o->library->library == l)
            return o->library->path;
    return NULL;
}

pcg_program *compilation_program(compilation *c, const pcg_module *module,
                                 void (*release)(void *owned), void *owned, const char **why)
{
    LIST(open_library *) known = {0};
    library_search s = {.why = ""};
    for (const opened_library *o = c->opened; o; o = o->next)
        LIST_ADD(&c->arena, &known, o->library);
    pcg_program *made = program_new(module, NULL, NULL);
    *why = "out of memory";
    if (!made)
        return NULL;
    if (!program_link(made, known.at, known.count, &s)) {
        *why = arena_copy(&c->arena, s.why, strlen(s.why));
        pcg_program_free(made);
        return NULL;
    }
    if (!compilation_lend(c, made)) {
        pcg_program_free(made);
        return NULL;
    }
    made->release = release;
    made->owned = owned;
    return made;
}

void compilation_end(compilation *c)
{
    for (const opened_library *o = c->opened; o; o = o->next)
        library_close(o->library);
    c->opened = NULL;
    arena_free(&c->arena);
}

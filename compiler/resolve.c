/* resolve.c - reads the main file and what it imports, and binds every name.
 *
 * Needs a source. Gives a program whose units, graphs, nodes, ports and edges stand, with the
 * written types of parameters, attributes and gates; expressions stay trees. What cannot be bound
 * was reported, and stands as something that goes with everything (a node of kind NODE_ERROR, a
 * type of kind TYPE_ERROR). */
#include "resolve.h"

#include <errno.h>
#include <string.h>

void report_duplicate(resolver *r, const char *what, const tree_name *name, const char *other,
                      span other_place)
{
    diagnostic *d = diagnose(r->d, DIAG_E0108, name->span, what, name->text, other);
    d->second = (diagnostic_label){other_place, "declared here"};
}

/* ---- paths --------------------------------------------------------------------------------- */

/* The folder of a path: "" where it has none. */
static const char *folder_of(arena *a, const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? arena_copy(a, path, slash == path ? 1 : (size_t)(slash - path)) : "";
}

/* folder/path without "." and with "x/.." taken back, so that one file has one name. */
static const char *join_paths(arena *a, const char *folder, const char *path)
{
    const char *joined = *path == '/' || !*folder ? path : arena_format(a, "%s/%s", folder, path);
    text out = {.arena = a};
    LIST(size_t) starts = {0};
    text_add(&out, *joined == '/' ? "/" : "");
    for (const char *at = joined; *at;) {
        size_t length = strcspn(at, "/");
        bool up = length == 2 && at[0] == '.' && at[1] == '.';
        if (up && starts.count) {
            out.length = starts.at[--starts.count];
            out.at[out.length] = '\0';
        } else if (length && !(length == 1 && *at == '.')) {
            if (!up)
                LIST_ADD(a, &starts, out.length);
            text_add(&out, out.length && out.at[out.length - 1] != '/' ? "/" : "");
            text_add_bytes(&out, at, length);
        }
        at += length + (at[length] == '/');
    }
    return out.length ? out.at : ".";
}

/* The name that a file's exported graph has: its own without folder and extension. */
static const char *stem_of(arena *a, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return arena_copy(a, name, dot && dot != name ? (size_t)(dot - name) : strlen(name));
}

/* ---- files --------------------------------------------------------------------------------- */

static const char *reason_of(int error)
{
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return "there is no such file";
    case EISDIR:
        return "it is a folder";
    case EACCES:
    case EPERM:
        return "reading it is not permitted";
    case EFBIG:
        return "it is too large";
    case ENAMETOOLONG:
        return "the name is too long";
    default:
        return "reading it failed";
    }
}

/* The source of an import: beside the importing file, then on the import paths; or the unit that
 * was made of it before. NULL and no unit: it was reported. */
static const source *read_import(resolver *r, const unit *importing, const tree_import *t,
                                 unit **known)
{
    const char *const *next = r->c->import_paths;
    int error = ENOENT;
    if (r->c->closed || !*t->path) {
        diagnose(r->d, DIAG_E0118, t->path_span, t->path);
        return NULL;
    }
    for (const char *folder = importing->folder; folder; folder = next && *next ? *next++ : NULL) {
        const char *path = join_paths(r->arena, folder, t->path);
        *known = table_get(&r->units, path);
        if (*known)
            return NULL;
        if (r->c->found)
            r->c->found(r->c->found_user, path);
        const source *s = source_read(r->arena, path, LANG_MAX_BYTES);
        if (s)
            return s;
        if (errno != ENOENT)
            error = errno;
    }
    diagnose(r->d, DIAG_E0111, t->path_span, t->path, reason_of(error));
    return NULL;
}

/* "a.pcg imports b.pcg imports a.pcg", from the stack of files that are being read. */
static void report_cycle(resolver *r, const tree_import *t, const unit *again)
{
    text chain = {.arena = r->arena};
    bool within = false;
    for (uint32_t i = 0; i < r->units_read.count; i++) {
        const unit *u = r->units_read.at[i];
        within |= u == again;
        if (within && u->resolving)
            text_format(&chain, "'%s' imports ", u->source->path);
    }
    text_format(&chain, "'%s'", again->source->path);
    diagnose(r->d, DIAG_E0110, t->path_span, chain.at);
}

static void declare_graphs(resolver *r, unit *u);
static void read_imports(resolver *r, unit *u, uint32_t depth);

static unit *read_unit(resolver *r, const source *s, uint32_t depth)
{
    unit *u = ARENA_NEW(r->arena, unit);
    uint32_t errors = r->d->errors;
    u->source = s;
    u->folder = folder_of(r->arena, s->path);
    u->tree = lang_parse(r->arena, s, r->d);
    u->broken = r->d->errors > errors;
    u->resolving = true;
    table_put(r->arena, &r->units, join_paths(r->arena, "", s->path), u);
    LIST_ADD(r->arena, &r->units_read, u);
    declare_graphs(r, u);
    read_imports(r, u, depth);
    u->resolving = false;
    return u;
}

/* The file that an import names, read on its first import. NULL: it was reported. */
static unit *import_unit(resolver *r, unit *importing, const tree_import *t, uint32_t depth)
{
    unit *known = NULL;
    const source *s = read_import(r, importing, t, &known);
    if (known && known->resolving) {
        report_cycle(r, t, known);
        return NULL;
    }
    if (!s || known)
        return known;
    if (depth >= COMPILER_MAX_IMPORT_DEPTH) {
        diagnose(r->d, DIAG_E0112, t->path_span, (int)COMPILER_MAX_IMPORT_DEPTH);
        return NULL;
    }
    if (r->units_read.count >= COMPILER_MAX_FILES) {
        diagnose(r->d, DIAG_E0113, t->path_span, (int)COMPILER_MAX_FILES);
        return NULL;
    }
    return read_unit(r, s, depth + 1);
}

/* ---- names of a file ----------------------------------------------------------------------- */

static graph *own_graph(const unit *u, const char *name)
{
    for (uint32_t i = 0; i < u->graph_count; i++)
        if (!strcmp(u->graphs[i]->name, name))
            return u->graphs[i];
    return NULL;
}

static const char *suggest_graph(resolver *r, const unit *u, const char *name)
{
    names candidates = {0};
    if (!suggestions_wanted(r->c))
        return NULL;
    for (uint32_t i = 0; i < u->graph_count; i++)
        LIST_ADD(r->arena, &candidates, u->graphs[i]->name);
    return did_you_mean(r->c, name, &candidates);
}

/* What stands for a graph that could not be imported: nodes of it go with everything. */
static graph *graph_of_error(resolver *r, const char *name)
{
    graph *g = ARENA_NEW(r->arena, graph);
    g->name = name;
    return g;
}

static span place_of_graph(const unit *u, const graph *g, const char *name)
{
    if (g->unit == u && g->tree)
        return g->tree->name.span;
    for (uint32_t i = 0; i < u->tree->items.count; i++) {
        const tree_item *item = &u->tree->items.at[i];
        for (uint32_t k = 0; item->kind == ITEM_IMPORT && k < item->import->names.count; k++) {
            const struct tree_imported *n = &item->import->names.at[k];
            const tree_name *as = n->alias.text ? &n->alias : &n->name;
            if (!strcmp(as->text, name))
                return as->span;
        }
    }
    return (span){0};
}

static void bind_import(resolver *r, unit *u, const unit *from, const tree_import *t,
                        const struct tree_imported *n)
{
    const tree_name *as = n->alias.text ? &n->alias : &n->name;
    graph *known = table_get(&u->names, as->text);
    graph *g = from ? own_graph(from, n->name.text) : NULL;
    if (known) {
        report_duplicate(r, "import", as,
                         known->unit == u ? "a graph of this file" : "another import",
                         place_of_graph(u, known, as->text));
        return;
    }
    if (from && !g && !from->broken)
        diagnose(r->d, DIAG_E0103, n->name.span, t->path, n->name.text)->text =
            suggest_graph(r, from, n->name.text);
    table_put(r->arena, &u->names, as->text, g ? g : graph_of_error(r, as->text));
}

static void bind_library(resolver *r, unit *u, const tree_use *t)
{
    const tree_name *as = t->alias.text ? &t->alias : &t->library;
    const pcg_library *l = library_use(r->c, r->p, u, &t->library);
    if (!l)
        return;
    const pcg_library *other = table_get(&u->libraries, as->text);
    if (!other)
        other = library_named(r->p, as->text);
    if (other && other != l)
        diagnose(r->d, DIAG_E0108, as->span, "library", as->text, "another library");
    else
        table_put(r->arena, &u->libraries, as->text, (void *)(uintptr_t)l);
}

static void read_imports(resolver *r, unit *u, uint32_t depth)
{
    for (uint32_t i = 0; i < u->tree->items.count; i++) {
        const tree_item *item = &u->tree->items.at[i];
        if (item->kind == ITEM_USE)
            bind_library(r, u, item->use);
        if (item->kind != ITEM_IMPORT)
            continue;
        unit *from = import_unit(r, u, item->import, depth);
        if (from)
            LIST_ADD(r->arena, &u->imports, from);
        for (uint32_t k = 0; k < item->import->names.count; k++)
            bind_import(r, u, from, item->import, &item->import->names.at[k]);
    }
}

/* The head of an item that belongs into an interface block, and what it is; NULL for others. */
static const tree_head *foreign_item(const tree_item *item, const char **what)
{
    switch (item->kind) {
    case ITEM_PROCEDURE:
        *what = "a procedure";
        return &item->procedure->head;
    case ITEM_FUNCTION:
        *what = "a function";
        return &item->function->head;
    case ITEM_ENTITY:
        *what = "an entity type";
        return &item->entity->head;
    case ITEM_ENUMERATION:
        *what = "an enumeration";
        return &item->enumeration->head;
    case ITEM_IMPORT:
    case ITEM_USE:
    case ITEM_GRAPH:
        break;
    }
    return NULL;
}

static void declare_graph(resolver *r, unit *u, const tree_graph *t)
{
    const graph *same = table_get(&u->names, t->name.text);
    if (same) {
        report_duplicate(r, "graph", &t->name, "another graph", same->tree->name.span);
        return;
    }
    graph *g = ARENA_NEW(r->arena, graph);
    g->name = t->name.text;
    g->tree = t;
    g->unit = u;
    g->names = ARENA_NEW(r->arena, struct graph_names);
    u->graphs[u->graph_count++] = g;
    table_put(r->arena, &u->names, g->name, g);
    LIST_ADD(r->arena, &r->graphs_found, g);
}

static void declare_graphs(resolver *r, unit *u)
{
    u->graphs = ARENA_ARRAY(r->arena, graph *, u->tree->items.count);
    for (uint32_t i = 0; i < u->tree->items.count; i++) {
        const tree_item *item = &u->tree->items.at[i];
        const char *what;
        const tree_head *foreign = foreign_item(item, &what);
        if (foreign)
            diagnose(r->d, DIAG_E0117, foreign->span, what, what);
        if (item->kind == ITEM_GRAPH)
            declare_graph(r, u, item->graph);
    }
}

/* ---- the main graph ------------------------------------------------------------------------ */

static span head_of(const unit *u)
{
    return (span){u->source, 0, 0};
}

graph *graph_of_unit(resolver *r, const unit *u)
{
    graph *g = own_graph(u, stem_of(r->arena, u->source->path));
    return g || u->graph_count != 1 ? g : u->graphs[0];
}

/* Where it cannot be told which graph is meant, that is an error, and the first one is checked. */
static graph *find_main(resolver *r, const unit *u)
{
    const char *wanted = r->c->graph ? r->c->graph : stem_of(r->arena, u->source->path);
    if (!u->graph_count) {
        if (!u->broken)
            diagnose(r->d, DIAG_E0114, head_of(u));
        return NULL;
    }
    graph *g = own_graph(u, wanted);
    if (g || (u->graph_count == 1 && !r->c->graph))
        return g ? g : u->graphs[0];
    if (r->c->graph)
        diagnose(r->d, DIAG_E0103, head_of(u), u->source->path, wanted)->text =
            suggest_graph(r, u, wanted);
    else
        diagnose(r->d, DIAG_E0115, u->graphs[0]->tree->name.span, wanted)->help =
            "--graph NAME says which one is meant";
    return u->graphs[0];
}

/* ---- the graphs that are reached ----------------------------------------------------------- */

typedef struct visit {
    graph *graph;
    uint32_t next;      /* node */
    uint32_t candidate; /* of that node, where it is a surrogate */
} visit;

/* The next graph that a surrogate may run: the one that it names, or any that its file knows. NULL when
 * there is none left. */
static graph *next_candidate(visit *v, const node *n)
{
    const table *known = &n->owner->unit->names;
    if (n->target)
        return v->candidate++ ? NULL : n->target;
    while (v->candidate < known->entries.count) {
        graph *g = known->entries.at[v->candidate++].value;
        if (g->tree)
            return g;
    }
    v->candidate = 0;
    return NULL;
}

static graph *next_of_node(visit *v, const node *n)
{
    graph *g = NULL;
    if (n->kind == NODE_SURROGATE)
        g = next_candidate(v, n);
    else if (n->kind == NODE_GRAPH && v->candidate++ == 0)
        g = n->graph;
    if (!g) {
        v->next++;
        v->candidate = 0;
    }
    return g;
}

/* The next graph that this one's nodes use and that was not seen yet; NULL when there is none left.
 */
static graph *next_callee(visit *v, const bool *seen)
{
    while (v->next < v->graph->node_count) {
        const node *n = v->graph->nodes[v->next];
        graph *g = next_of_node(v, n);
        if (!g)
            continue;
        g->encapsulated |= n->kind == NODE_GRAPH;
        if (!seen[g->index])
            return g;
    }
    return NULL;
}

/* Depth first, without recursion: chains of graphs can be as long as a file. */
static void collect_graphs(resolver *r)
{
    program *p = r->p;
    uint32_t all = r->graphs_found.count;
    visit *stack = ARENA_ARRAY(r->arena, visit, all);
    bool *seen = ARENA_ARRAY(r->arena, bool, all);
    uint32_t depth = 1;
    for (uint32_t i = 0; i < all; i++)
        r->graphs_found.at[i]->index = i;
    p->graphs = ARENA_ARRAY(r->arena, graph *, all);
    stack[0] = (visit){.graph = p->main};
    seen[p->main->index] = true;
    while (depth) {
        graph *callee = next_callee(&stack[depth - 1], seen);
        if (callee) {
            seen[callee->index] = true;
            stack[depth++] = (visit){.graph = callee};
        } else {
            p->graphs[p->graph_count++] = stack[--depth].graph;
        }
    }
}

static void number_graphs(resolver *r)
{
    program *p = r->p;
    table symbols = {0};
    for (uint32_t i = 0; i < p->graph_count; i++) {
        graph *g = p->graphs[i];
        const char *base = interface_field(r->arena, g->name);
        g->index = i;
        g->symbol = base;
        for (uint32_t n = 2; table_get(&symbols, g->symbol); n++)
            g->symbol = arena_format(r->arena, "%s_%u", base, (unsigned)n);
        table_put(r->arena, &symbols, g->symbol, g);
        for (uint32_t k = 0; k < g->node_count; k++)
            g->nodes[k]->global = p->node_count++;
    }
}

/* ---- files that surrogates name ------------------------------------------------------------ */

/* What was read while graphs are resolved comes to have its interfaces at once. */
static void resolve_interfaces(resolver *r, uint32_t from)
{
    const unit *scope = r->p->scope;
    for (uint32_t i = from; i < r->graphs_found.count; i++)
        resolve_interface(r, r->graphs_found.at[i]);
    r->p->scope = scope;
}

unit *resolve_file(resolver *r, unit *u, const char *path, span place)
{
    uint32_t before = r->graphs_found.count;
    const tree_import named = {.path = path, .path_span = place};
    unit *found = import_unit(r, u, &named, 0);
    resolve_interfaces(r, before);
    return found;
}

unit *resolve_text(resolver *r, const unit *like, const char *name, const text *written)
{
    uint32_t before = r->graphs_found.count;
    const source *s = source_new(r->arena, name, written->at, written->length);
    unit *u = ARENA_NEW(r->arena, unit);
    u->source = s;
    u->folder = like->folder;
    u->libraries = like->libraries;
    u->tree = lang_parse(r->arena, s, r->d);
    LIST_ADD(r->arena, &r->units_read, u);
    declare_graphs(r, u);
    resolve_interfaces(r, before);
    return u;
}

/* ---- the pass ------------------------------------------------------------------------------ */

/* Bodies may bring files in, whose graphs come behind. */
static void resolve_graphs(resolver *r)
{
    resolve_interfaces(r, 0);
    for (uint32_t i = 0; i < r->graphs_found.count; i++)
        resolve_body(r, r->graphs_found.at[i]);
    r->p->scope = NULL;
}

program *resolve(compilation *c, const source *main)
{
    program *p = ARENA_NEW(&c->arena, program);
    resolver r = {.c = c, .p = p, .arena = &c->arena, .d = &c->diagnostics};
    p->arena = r.arena;
    p->diagnostics = r.d;
    library_begin(c, p);
    unit *u = read_unit(&r, main, 0);
    if (c->lap)
        c->lap(c->user, "parse");
    resolve_graphs(&r);
    p->units = r.units_read.at;
    p->unit_count = r.units_read.count;
    p->main = find_main(&r, u);
    if (!p->main)
        return NULL;
    p->main->main = true;
    collect_graphs(&r);
    number_graphs(&r);
    return p;
}

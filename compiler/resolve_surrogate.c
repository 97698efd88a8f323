/* resolve_surrogate.c - what a surrogate runs, as far as it is written out: a graph of its file, a
 * file, or a procedure, around which a graph is made that has the declared interface. */
#include "resolve.h"

#include <string.h>

#define CALLED "'the procedure'" /* the node in such a graph */

static const tree_body no_body;

static const tree_body *body_of(const node *n)
{
    return n->tree->body ? n->tree->body : &no_body;
}

/* ---- the name ------------------------------------------------------------------------------ */

/* The argument `graph`, or the first one that has no name; NULL. */
static const tree_expression *written_name(const node *n)
{
    const tree_arguments *all = &n->tree->arguments;
    for (uint32_t i = 0; i < all->count; i++) {
        const tree_argument *a = &all->at[i];
        bool meant = a->name.text ? !strcmp(a->name.text, "graph") : i == 0;
        if (a->kind == ARGUMENT_VALUE && meant)
            return a->value->kind == EXPR_STRING ? a->value : NULL;
    }
    return NULL;
}

static bool is_file(const char *name)
{
    return strchr(name, '/') || strchr(name, '.');
}

/* A file's name without folder and extension. */
static const char *stem(const drawing *d, const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    return arena_copy(d->r->arena, name, strcspn(name, "."));
}

static bool is_compiled(const char *name)
{
    size_t length = strlen(name);
    return length > 3 && !strcmp(name + length - 3, ".so");
}

/* ---- a graph around a procedure ------------------------------------------------------------ */

static void write_head(text *out, const char *keyword, const char *name, const char *of)
{
    text_format(out, "    %s ", keyword);
    lang_write_name(name, out);
    text_format(out, ": %s", of);
}

static void write_declarations(arena *a, const node *n, text *out)
{
    const tree_body *b = body_of(n);
    for (uint32_t i = n->procedure->parameter_count; i < n->argument_count; i++) {
        const formal *f = n->arguments[i].formal;
        write_head(out, "param", f->name, type_text(a, &f->type));
        text_add(out, "\n");
    }
    for (uint32_t i = 0; i < n->link_count; i++) {
        write_head(out, "attr", n->links[i].name, type_text(a, &n->links[i].type));
        text_add(out, "\n");
    }
    for (uint32_t i = 0; i < n->input_count; i++) {
        write_head(out, "in", n->inputs[i].name, type_text(a, &n->inputs[i].type));
        const port *p = &n->inputs[i];
        text_add(out, p->optional ? "[]?\n" : p->collective ? "[]\n" : "\n");
    }
    for (uint32_t i = 0; i < n->output_count; i++) {
        write_head(out, "out", n->outputs[i].name, type_text(a, &n->outputs[i].type));
        text_add(out, b->outputs.at[i]->gathers ? " = *\n" : "\n");
    }
}

static void write_pair(text *out, bool *first, const char *name, const char *between)
{
    text_add(out, *first ? "" : ", ");
    lang_write_name(name, out);
    text_add(out, between);
    lang_write_name(name, out);
    *first = false;
}

static void write_call(const node *n, text *out)
{
    bool first = true;
    text_add(out, "(");
    for (uint32_t i = n->procedure->parameter_count; i < n->argument_count; i++)
        write_pair(out, &first, n->arguments[i].formal->name, " = ");
    for (uint32_t i = 0; i < n->link_count; i++)
        write_pair(out, &first, n->links[i].name, " => @");
    text_add(out, ")\n");
}

static void write_edges(const node *n, text *out)
{
    for (uint32_t i = 0; i < n->input_count; i++) {
        text_add(out, "    ");
        lang_write_name(n->inputs[i].name, out);
        text_add(out, " -> " CALLED ".");
        lang_write_name(n->inputs[i].name, out);
        text_add(out, "\n");
    }
    for (uint32_t i = 0; i < n->output_count; i++) {
        if (body_of(n)->outputs.at[i]->gathers)
            continue;
        text_add(out, "    " CALLED ".");
        lang_write_name(n->outputs[i].name, out);
        text_add(out, " -> ");
        lang_write_name(n->outputs[i].name, out);
        text_add(out, "\n");
    }
}

/* The text before and behind the procedure's name. */
static void write_around(arena *a, node *n)
{
    text before = {.arena = a}, behind = {.arena = a};
    text_add(&before, "graph 'around a procedure' {\n");
    write_declarations(a, n, &before);
    text_add(&before, "    " CALLED ": ");
    write_call(n, &behind);
    write_edges(n, &behind);
    text_add(&behind, "}\n");
    n->before = before.at;
    n->behind = behind.at;
}

/* ---- whether the procedure is as declared -------------------------------------------------- */

static bool has_port(const formal_port *ports, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(ports[i].name, name))
            return true;
    return false;
}

static bool has_formal(const formal *formals, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(formals[i].name, name))
            return true;
    return false;
}

/* What is missing is reported when the surrogate is checked. */
static bool has_all(const procedure *f, const node *n)
{
    bool all = true;
    for (uint32_t i = 0; i < n->input_count; i++)
        all &= has_port(f->inputs, f->input_count, n->inputs[i].name);
    for (uint32_t i = 0; i < n->output_count; i++)
        all &= body_of(n)->outputs.at[i]->gathers ||
               has_port(f->outputs, f->output_count, n->outputs[i].name);
    for (uint32_t i = n->procedure->parameter_count; i < n->argument_count; i++)
        all &= has_formal(f->parameters, f->parameter_count, n->arguments[i].formal->name);
    for (uint32_t i = 0; i < n->link_count; i++)
        all &= has_formal(f->attributes, f->attribute_count, n->links[i].name);
    return all;
}

static graph *graph_around(drawing *d, const node *n, const char *name)
{
    resolver *r = d->r;
    const procedure *f = library_procedure(r->c, r->p, NULL, name);
    text written = {.arena = r->arena};
    if (!f || library_is_surrogate(f) || !has_all(f, n))
        return NULL;
    text_format(&written, "%s%s%s", n->before, name, n->behind);
    const char *called = arena_format(r->arena, "procedure '%s'", name);
    return graph_of_unit(r, resolve_text(r, n->owner->unit, called, &written));
}

/* ---- the surrogate ------------------------------------------------------------------------- */

void resolve_surrogate(drawing *d, node *n)
{
    unit *u = n->owner->unit;
    const tree_expression *name = written_name(n);
    write_around(d->r->arena, n);
    if (!name)
        return;
    graph *g = table_get(&u->names, name->string);
    if (g) {
        n->target = g->tree ? g : NULL;
        return;
    }
    if (!is_file(name->string)) {
        n->target = graph_around(d, n, name->string);
    } else if (!is_compiled(name->string)) {
        const unit *file = resolve_file(d->r, u, name->string, name->span);
        n->target = file ? graph_of_unit(d->r, file) : NULL;
        if (file && !n->target && !file->broken)
            diagnose(d->r->d, DIAG_E0115, name->span, stem(d, name->string));
    }
}

/* debug_break.c - breakpoints and watches: what they mean, and whether one is hit. */
#include <stdlib.h>
#include <string.h>

#include "debug.h"

/* ---- hitting --------------------------------------------------------------------------------- */

static bool same(const char *wanted, const char *is)
{
    return !wanted || !strcmp(wanted, is);
}

static bool same_file(const char *wanted, const char *is)
{
    return !wanted || !strcmp(wanted, is) || !strcmp(wanted, debug_file_name(is));
}

static bool is_node(const breakpoint *b, const pcg_node *n)
{
    return same(b->node, n->name) && same(b->graph, n->graph) && same_file(b->file, n->file);
}

static bool is_edge(const breakpoint *b, const debugger *d, const seen_record *sent)
{
    if (!is_node(b, history_round(&d->past)->node) || !same(b->port, sent->sent.port) ||
        sent->queue == SEEN_NOWHERE)
        return false;
    const pcg_seen_queue *q = &history_level(&d->past)->graph->queues[sent->queue];
    return !q->leaf && same(b->to, q->node->name) && same(b->to_port, q->port);
}

/* What an entity that is sent had before: as it was itself, or what this round began from. */
static const seen_state *state_before(const debugger *d, const seen_record *sent)
{
    const seen_round *r = history_round(&d->past);
    if (sent->sent.before)
        return sent->sent.before;
    return r->entity_count ? history_state(&d->past, r->entities[0]) : NULL;
}

static const pcg_cell *cells_before(const debugger *d, const seen_record *sent, uint32_t index)
{
    const seen_level *l = history_level(&d->past);
    const seen_state *s = state_before(d, sent);
    bool written;
    return s ? seen_attribute(l, index, s, &written)
             : &l->initial[l->graph->attributes[index].cell];
}

static bool has_changed(const breakpoint *b, const debugger *d, const seen_record *sent)
{
    const seen_level *l = history_level(&d->past);
    const seen_state *s = history_state(&d->past, sent->entity);
    uint32_t index = debug_find_attribute(l, b->attribute);
    if (index == SEEN_NOWHERE || !s)
        return false;
    const pcg_attribute_info *a = &l->graph->attributes[index];
    const value_type t = {a->kind, a->element, a->enumerators};
    bool written;
    return !value_equal(&t, cells_before(d, sent, index), seen_attribute(l, index, s, &written));
}

void debug_show_change(debugger *d, const breakpoint *b)
{
    const seen_level *l = history_level(&d->past);
    const seen_record *sent = history_last(&d->past);
    uint32_t index = debug_find_attribute(l, b->attribute);
    const pcg_attribute_info *a = &l->graph->attributes[index];
    const value_type t = {a->kind, a->element, a->enumerators};
    text_add(&d->out, "  ");
    debug_add_attribute(d, l, index, history_state(&d->past, sent->entity));
    text_add(&d->out, ", before: ");
    value_write(&d->out, &t, cells_before(d, sent, index));
    text_add(&d->out, "\n");
}

static bool is_hit(const breakpoint *b, const debugger *d, const seen_record *last)
{
    const pcg_node *n = history_round(&d->past)->node;
    switch (b->kind) {
    case BREAK_NODE:
        return last->kind == SEEN_ROUND && is_node(b, n);
    case BREAK_LINE:
        return last->kind == SEEN_ROUND && n->line == b->line && same_file(b->file, n->file);
    case BREAK_EDGE:
        return last->kind == SEEN_SENT && is_edge(b, d, last);
    case BREAK_WATCH:
        return last->kind == SEEN_SENT && has_changed(b, d, last);
    }
    return false;
}

breakpoint *debug_hit(debugger *d)
{
    const seen_record *last = history_last(&d->past);
    for (breakpoint *b = d->breakpoints; b; b = b->next)
        if (is_hit(b, d, last) && (!b->condition || debug_condition_holds(d, b)))
            return b;
    return NULL;
}

/* ---- what names mean ------------------------------------------------------------------------- */

/* One end of what was given: graph/node.port; absent parts are NULL. */
typedef struct place {
    const char *graph, *name, *port;
    const node *node; /* in the program; NULL: it has none of that name */
} place;

static bool runs(const node *n)
{
    return n->kind == NODE_PROCEDURE || n->kind == NODE_GRAPH || n->kind == NODE_SURROGATE;
}

static const node *node_in(const graph *g, const char *name)
{
    for (uint32_t i = 0; i < g->node_count; i++)
        if (!strcmp(g->nodes[i]->name, name))
            return g->nodes[i];
    return NULL;
}

/* In the main graph first. */
static const node *find_node(const program *p, const place *at)
{
    const node *found = same(at->graph, p->main->name) ? node_in(p->main, at->name) : NULL;
    for (uint32_t i = 0; !found && i < p->graph_count; i++)
        if (same(at->graph, p->graphs[i]->name))
            found = node_in(p->graphs[i], at->name);
    return found;
}

/* Whether graphs that are not known yet may be loaded while it runs. */
static bool loads_graphs(const program *p)
{
    for (uint32_t i = 0; i < p->graph_count; i++)
        for (uint32_t k = 0; k < p->graphs[i]->node_count; k++)
            if (p->graphs[i]->nodes[k]->kind == NODE_SURROGATE)
                return true;
    return false;
}

static void refuse_node(debugger *d, const place *at)
{
    const program *p = d->k->program;
    uint32_t count = 0;
    const char **names = ARENA_ARRAY(&d->scratch, const char *, p->node_count + p->graph_count + 1);
    for (uint32_t i = 0; i < p->graph_count; i++)
        for (uint32_t k = 0; same(at->graph, p->graphs[i]->name) && k < p->graphs[i]->node_count;
             k++)
            if (count < p->node_count)
                names[count++] = p->graphs[i]->nodes[k]->name;
    bool no_graph = !count;
    for (uint32_t i = 0; no_graph && i < p->graph_count; i++)
        names[count++] = p->graphs[i]->name;
    const char *near = nearest_name(no_graph ? at->graph : at->name, names, count);
    const char *hint = near ? arena_format(&d->scratch, ", did you mean '%s'?", near) : "";
    if (no_graph)
        debug_refuse(d, "there is no graph '%s'%s", at->graph, hint);
    else
        debug_refuse(d, "%s%s%s has no node '%s'%s", at->graph ? "graph '" : "the program",
                     at->graph ? at->graph : "", at->graph ? "'" : "", at->name, hint);
}

/* False: it was refused. */
static bool find_place(debugger *d, char *word, place *at)
{
    char *slash = strchr(word, '/'), *name = slash ? slash + 1 : word;
    *at = (place){.graph = slash ? word : NULL, .name = name};
    if (slash)
        *slash = '\0';
    at->node = find_node(d->k->program, at);
    char *dot = at->node ? NULL : strrchr(name, '.');
    if (dot) {
        *dot = '\0';
        at->port = dot + 1;
        at->node = find_node(d->k->program, at);
    }
    if (at->node || (slash && loads_graphs(d->k->program)))
        return true;
    refuse_node(d, at);
    return false;
}

/* ---- making one ------------------------------------------------------------------------------ */

static const char *keep(debugger *d, const char *s)
{
    return s ? arena_copy(&d->memory, s, strlen(s)) : NULL;
}

/* Behind the others, with the next number. */
static breakpoint *add(debugger *d, const breakpoint *made)
{
    breakpoint *b = ARENA_NEW(&d->memory, breakpoint), **last = &d->breakpoints;
    *b = *made;
    b->number = ++d->breakpoint_count;
    b->said = keep(d, d->line);
    while (*last)
        last = &(*last)->next;
    *last = b;
    text_format(&d->out, "%s %u: ", b->kind == BREAK_WATCH ? "watch" : "breakpoint", b->number);
    return b;
}

static uint32_t line_of(const node *n)
{
    uint32_t line = 0, column;
    if (n->span.source)
        source_place(n->span.source, n->span.from, &line, &column);
    return line;
}

/* The node, and where it stands, are the program's. */
static void take_node(breakpoint *b, const node *n)
{
    b->node = n->name;
    b->graph = n->owner->name;
    b->file = n->span.source ? n->span.source->path : NULL;
}

static void break_at_node(debugger *d, char *word, const char *condition)
{
    place at;
    breakpoint b = {.kind = BREAK_NODE};
    if (!find_place(d, word, &at))
        return;
    if (at.port) {
        debug_refuse(d, "'%s' is a port; give an edge: break %s.%s -> …", at.port, at.name,
                     at.port);
        return;
    }
    if (at.node && !runs(at.node)) {
        debug_refuse(d, "'%s' is a gate, which has no rounds of its own; take a node beside it",
                     at.name);
        return;
    }
    if (condition && !at.node) {
        debug_refuse(d,
                     "graph '%s' is not part of the program: a condition cannot be compiled for it",
                     at.graph);
        return;
    }
    if (at.node)
        take_node(&b, at.node);
    else
        b = (breakpoint){.kind = BREAK_NODE, .graph = keep(d, at.graph), .node = keep(d, at.name)};
    if (condition && !(b.condition = debug_condition_new(d, d->line, condition, at.node)))
        return;
    add(d, &b);
    if (at.node)
        text_format(&d->out, "'%s' of %s, line %u\n", b.node, b.graph, line_of(at.node));
    else
        text_format(&d->out, "'%s' of %s, once such a graph is loaded\n", b.node, b.graph);
}

static bool has_edge(const node *from, const char *from_port, const node *to, const char *to_port)
{
    for (uint32_t i = 0; i < from->owner->edge_count; i++) {
        const edge *e = from->owner->edges[i];
        if (e->from->node == from && e->to->node == to && same(from_port, e->from->name) &&
            same(to_port, e->to->name))
            return true;
    }
    return false;
}

static void break_at_edge(debugger *d, char *from_word, char *to_word, const char *condition)
{
    place from, to;
    if (!find_place(d, from_word, &from))
        return;
    to = (place){0};
    if (from.graph && !strchr(to_word, '/'))
        to_word = arena_format(&d->scratch, "%s/%s", from.graph, to_word);
    if (!find_place(d, to_word, &to))
        return;
    if (!from.node || !to.node) {
        debug_refuse(d, "graph '%s' is not part of the program: break at its nodes instead",
                     from.node ? to.graph : from.graph);
        return;
    }
    if (!has_edge(from.node, from.port, to.node, to.port)) {
        debug_refuse(d, "there is no edge from '%s' to '%s'", from.name, to.name);
        return;
    }
    if (!runs(from.node)) {
        debug_refuse(d, "'%s' is a gate, which passes on without being seen; break at '%s' instead",
                     from.name, to.name);
        return;
    }
    breakpoint b = {.kind = BREAK_EDGE, .port = keep(d, from.port), .to_port = keep(d, to.port)};
    take_node(&b, from.node);
    b.to = to.node->name;
    if (condition && !(b.condition = debug_condition_new(d, d->line, condition, to.node)))
        return;
    add(d, &b);
    text_format(&d->out, "the edge from '%s' to '%s' of %s\n", b.node, b.to, b.graph);
}

/* ---- lines ----------------------------------------------------------------------------------- */

/* A file of the program; NULL: it has none of that name. */
static const source *find_file(const program *p, const char *name)
{
    for (uint32_t i = 0; i < p->unit_count; i++)
        if (same_file(name, p->units[i]->source->path))
            return p->units[i]->source;
    return NULL;
}

/* The first node that begins in that line, or in the first behind it where one does. */
static const node *node_at(const program *p, const source *file, uint32_t line)
{
    const node *best = NULL;
    for (uint32_t i = 0; i < p->graph_count; i++)
        for (uint32_t k = 0; k < p->graphs[i]->node_count; k++) {
            const node *n = p->graphs[i]->nodes[k];
            if (n->span.source == file && runs(n) && line_of(n) >= line &&
                (!best || line_of(n) < line_of(best)))
                best = n;
        }
    return best;
}

static void break_at_line(debugger *d, const char *file, const char *number, const char *condition)
{
    const program *p = d->k->program;
    uint32_t line = (uint32_t)strtoul(number, NULL, 10);
    const source *in = find_file(p, file);
    const node *n = in ? node_at(p, in, line) : NULL;
    breakpoint b = {.kind = BREAK_LINE, .file = keep(d, file), .line = line};
    if (!in && (!loads_graphs(p) || condition)) {
        debug_refuse(d, "'%s' is no file of the program", file);
        return;
    }
    if (in && !n) {
        debug_refuse(d, "no node begins in line %u of '%s', or behind it", line,
                     debug_file_name(in->path));
        return;
    }
    if (in) {
        b.file = in->path;
        b.line = line_of(n);
    }
    if (condition && !(b.condition = debug_condition_new(d, d->line, condition, n)))
        return;
    add(d, &b);
    if (n)
        text_format(&d->out, "line %u, '%s' of %s\n", b.line, n->name, n->owner->name);
    else
        text_format(&d->out, "line %u of '%s', once it is loaded\n", b.line, b.file);
}

/* ---- the commands ---------------------------------------------------------------------------- */

/* What stands behind `if`, which is cut off; NULL: there is none. */
static const char *cut_condition(const debugger *d, char *arguments)
{
    for (char *at = arguments; (at = strstr(at, "if")); at += 2) {
        bool begins = at > arguments && (at[-1] == ' ' || at[-1] == '\t');
        if (begins && (at[2] == ' ' || at[2] == '\t' || at[2] == '(' || !at[2])) {
            *at = '\0';
            return d->line + (at - d->words) + 2;
        }
    }
    return NULL;
}

static bool is_number(const char *s)
{
    return *s && strspn(s, "0123456789") == strlen(s) && strlen(s) < 10;
}

void debug_break(debugger *d, char *arguments)
{
    const char *condition = cut_condition(d, arguments);
    char *arrow = strstr(arguments, "->"), *behind = arrow ? arrow + 2 : NULL;
    if (arrow)
        *arrow = '\0';
    char *word = debug_word(&arguments), *to = arrow ? debug_word(&behind) : NULL;
    char *colon = word ? strrchr(word, ':') : NULL;
    if (!word || (arrow && !to))
        debug_refuse(d, "where? break window, break 16, break a -> b");
    else if (debug_word(arrow ? &behind : &arguments) || (arrow && debug_word(&arguments)))
        debug_refuse(d, "one place at a time; a condition follows behind 'if'");
    else if (arrow)
        break_at_edge(d, word, to, condition);
    else if (is_number(word))
        break_at_line(d, d->k->program->units[0]->source->path, word, condition);
    else if (colon && is_number(colon + 1)) {
        *colon = '\0';
        break_at_line(d, word, colon + 1, condition);
    } else
        break_at_node(d, word, condition);
}

void debug_watch(debugger *d, char *arguments)
{
    const program *p = d->k->program;
    char *word = debug_word(&arguments);
    if (!word || debug_word(&arguments)) {
        debug_refuse(d, "which attribute? watch @floor");
        return;
    }
    breakpoint b = {.kind = BREAK_WATCH, .attribute = keep(d, word + (*word == '@'))};
    LIST(const char *) names = {0};
    bool found = false;
    for (uint32_t i = 0; i < p->graph_count; i++)
        for (uint32_t k = 0; k < p->graphs[i]->attribute_count; k++) {
            LIST_ADD(&d->scratch, &names, p->graphs[i]->attributes[k].name);
            found |= !strcmp(p->graphs[i]->attributes[k].name, b.attribute);
        }
    const char *near = found ? NULL : nearest_name(b.attribute, names.at, names.count);
    if (!found && !loads_graphs(p)) {
        debug_refuse(d, "no graph has an attribute '@%s'%s%s%s", b.attribute,
                     near ? ", did you mean '@" : "", near ? near : "", near ? "'?" : "");
        return;
    }
    add(d, &b);
    text_format(&d->out, "changes of @%s\n", b.attribute);
}

void debug_delete(debugger *d, char *arguments)
{
    char *word = debug_word(&arguments);
    bool all = word && !strcmp(word, "all"), found = false;
    if (!word || (!all && !is_number(word))) {
        debug_refuse(d, "which one? delete 2, or delete all");
        return;
    }
    uint32_t number = all ? 0 : (uint32_t)strtoul(word, NULL, 10);
    for (breakpoint **at = &d->breakpoints; *at;) {
        breakpoint *b = *at;
        if (!all && b->number != number) {
            at = &b->next;
            continue;
        }
        found = true;
        *at = b->next;
        debug_condition_free(b->condition);
    }
    if (!found && !all)
        debug_refuse(d, "there is no breakpoint %u", number);
}

void debug_list_breakpoints(debugger *d)
{
    if (!d->breakpoints)
        text_add(&d->out, "no breakpoints\n");
    for (const breakpoint *b = d->breakpoints; b; b = b->next)
        text_format(&d->out, "  %u: %s, hit %llu times\n", b->number, b->said,
                    (unsigned long long)b->hits);
}

void debug_forget_breakpoints(debugger *d)
{
    for (breakpoint *b = d->breakpoints; b; b = b->next)
        debug_condition_free(b->condition);
    d->breakpoints = NULL;
}

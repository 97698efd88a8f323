/* debug_show.c - what there is to see where the view stands: queues, entities, values, source. */
#include <stdlib.h>
#include <string.h>

#include "debug.h"

enum { LISTED_ENTITIES = 12, LISTED_LINES = 5 };

/* ---- small parts ----------------------------------------------------------------------------- */

const char *debug_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Zero has no sign here. */
static void add_number(text *out, double number)
{
    text_number(out, number + 0.0);
}

static void add_point(text *out, const char *name, pcg_vec3 p)
{
    text_format(out, "%s (", name);
    add_number(out, p.x);
    text_add(out, ", ");
    add_number(out, p.y);
    text_add(out, ", ");
    add_number(out, p.z);
    text_add(out, ")");
}

static void add_value(text *out, const value_type *t, const pcg_cell *cells)
{
    if (t->kind == PCG_STRING || t->kind == PCG_PATH)
        text_quote(out, cells->s);
    else
        value_write(out, t, cells);
}

/* 'each' (entrance); what it runs is left out where the node is called so. */
static void add_node(text *out, const pcg_node *n)
{
    text_format(out, "'%s'", n->name);
    if (strcmp(n->name, n->procedure) != 0)
        text_format(out, " (%s)", n->procedure);
}

static bool is_gate(const pcg_node *n)
{
    return !strcmp(n->procedure, "in") || !strcmp(n->procedure, "out");
}

/* each.walls; a gate has one port only. */
static void add_port(text *out, const pcg_node *n, const char *name)
{
    text_add(out, n->name);
    if (!is_gate(n))
        text_format(out, ".%s", name);
}

static void add_numbers(text *out, uint32_t count, uint64_t (*at)(const void *of, uint32_t i),
                        const void *of)
{
    for (uint32_t i = 0; i < count && i < LISTED_ENTITIES; i++)
        text_format(out, " #%llu", (unsigned long long)at(of, i));
    if (count > LISTED_ENTITIES)
        text_format(out, " and %u more", count - LISTED_ENTITIES);
    text_add(out, "\n");
}

static uint64_t of_queue(const void *of, uint32_t i)
{
    return seen_queue_entity(of, i);
}

static uint64_t of_array(const void *of, uint32_t i)
{
    return ((const uint64_t *)of)[i];
}

/* ---- source ---------------------------------------------------------------------------------- */

/* A file of the program, or one that it has loaded; NULL where it cannot be read. */
static const source *file_of(debugger *d, const char *path)
{
    const program *p = d->k->program;
    for (uint32_t i = 0; p && i < p->unit_count; i++)
        if (!strcmp(p->units[i]->source->path, path))
            return p->units[i]->source;
    const source *s = table_get(&d->files, path);
    if (!s && (s = source_read(&d->memory, path, LANG_MAX_BYTES)))
        table_put(&d->memory, &d->files, s->path, (void *)(uintptr_t)s);
    return s;
}

/* Without the end of the line. */
static void add_line(debugger *d, const source *s, uint32_t line, const char *mark)
{
    uint32_t from = s->lines[line - 1];
    size_t length = strcspn(s->text + from, "\r\n");
    text_format(&d->out, "%s%4u | %.*s\n", mark, line, (int)length, s->text + from);
}

void debug_add_source_line(debugger *d, const char *file, uint32_t line, bool marked)
{
    const source *s = file_of(d, file);
    if (s && line > 0 && line <= s->line_count)
        add_line(d, s, line, marked ? "> " : "  ");
}

/* The lines around one; where there is no round, the file's first. */
void debug_list(debugger *d, char *arguments)
{
    const seen_round *r = history_round(&d->past);
    const source *s = r ? file_of(d, r->node->file) : d->k->program->units[0]->source;
    char *word = debug_word(&arguments), *end = NULL;
    uint32_t here = r ? r->node->line : 0;
    uint32_t middle = d->shown ? d->shown + 2 * LISTED_LINES + 1 : here ? here : LISTED_LINES + 1;
    if (word)
        middle = (uint32_t)strtoul(word, &end, 10);
    if (word && (*word < '0' || *word > '9' || *end || !middle)) {
        debug_refuse(d, "'%s' is no number of a line", word);
        return;
    }
    uint32_t first = middle > LISTED_LINES ? middle - LISTED_LINES : 1;
    if (!s || first > s->line_count) {
        debug_refuse(d, s ? "the file ends before line %u" : "there is no file to show line %u of",
                     first);
        return;
    }
    for (uint32_t i = first; i <= s->line_count && i <= middle + LISTED_LINES; i++)
        add_line(d, s, i, i == here ? "> " : "  ");
    d->shown = middle;
}

/* ---- the place ------------------------------------------------------------------------------- */

static void add_sent(debugger *d, const seen_record *sent)
{
    const seen_round *r = history_round(&d->past);
    const seen_level *l = history_level(&d->past);
    text_format(&d->out, "  #%llu is about to leave %s.%s", (unsigned long long)sent->entity,
                r->node->name, sent->sent.port);
    if (sent->queue == SEEN_NOWHERE) {
        text_add(&d->out, ", where nothing takes it\n");
        return;
    }
    const pcg_seen_queue *q = &l->graph->queues[sent->queue];
    if (q->leaf) {
        text_add(&d->out, ", to come out of the graph\n");
        return;
    }
    text_add(&d->out, " -> ");
    add_port(&d->out, q->node, q->port);
    if (sent->sent.original)
        text_format(&d->out, ", a copy of #%llu", (unsigned long long)sent->sent.original);
    text_add(&d->out, "\n");
}

static void add_taken(debugger *d, const seen_round *r)
{
    const uint64_t *at = r->entities;
    for (uint32_t i = 0; i < r->about->input_count; i++) {
        if (r->taken[i]) {
            text_format(&d->out, "  %s:", r->about->inputs[i]);
            add_numbers(&d->out, r->taken[i], of_array, at);
        }
        at += r->taken[i];
    }
}

static void add_end(debugger *d)
{
    static const char *const how[] = {"is done", "has failed", "has come to a limit",
                                      "was cancelled", "could not begin"};
    text_format(&d->out, "the run %s: %llu rounds\n", how[d->status],
                (unsigned long long)d->past.rounds);
}

void debug_show_place(debugger *d, const char *why)
{
    const history *h = &d->past;
    const seen_record *last = history_last(h);
    const seen_round *r = history_round(h);
    bool at_end = d->over && history_is_present(h);
    if (at_end)
        add_end(d);
    if (!r)
        return;
    text_format(&d->out, "%sround %llu", why ? why : "", (unsigned long long)r->id);
    if (!history_is_present(h))
        text_format(&d->out, " of %llu so far", (unsigned long long)h->rounds);
    text_add(&d->out, ": ");
    add_node(&d->out, r->node);
    text_format(&d->out, " of %s, its round %llu\n", r->node->graph, (unsigned long long)r->number);
    debug_add_source_line(d, r->node->file, r->node->line, false);
    if (last && last->kind == SEEN_SENT && !at_end)
        add_sent(d, last);
    else
        add_taken(d, r);
}

void debug_where(debugger *d, char *arguments)
{
    (void)arguments;
    const history *h = &d->past;
    if (!h->open_count)
        text_add(&d->out, "no round is under way\n");
    for (uint32_t i = h->open_count; i-- > 0;) {
        const seen_round *r = h->open[i];
        text_add(&d->out, i + 1 == h->open_count ? "" : "in ");
        add_node(&d->out, r->node);
        text_format(&d->out, " of %s, its round %llu, round %llu of all, at %s:%u\n",
                    r->node->graph, (unsigned long long)r->number, (unsigned long long)r->id,
                    debug_file_name(r->node->file), r->node->line);
    }
}

void debug_parameters(debugger *d, char *arguments)
{
    (void)arguments;
    const seen_round *r = history_round(&d->past);
    if (!r || !r->about->parameter_count) {
        text_add(&d->out, r ? "the node has no parameters\n" : "no round is under way\n");
        return;
    }
    for (uint32_t i = 0; i < r->about->parameter_count; i++) {
        const pcg_seen_parameter *p = &r->about->parameters[i];
        text_format(&d->out, "  %s: %s = ", p->name, p->type);
        if (r->values[i].named)
            text_add(&d->out, p->text ? p->text : "");
        else
            add_value(&d->out, &r->values[i].type, r->values[i].cells);
        text_add(&d->out, "\n");
    }
}

/* ---- queues ---------------------------------------------------------------------------------- */

static void add_queue(debugger *d, const seen_level *l, uint32_t queue)
{
    const pcg_seen_queue *q = &l->graph->queues[queue];
    text line = {.arena = &d->scratch};
    add_port(&line, q->node, q->port);
    text_add(&line, q->leaf ? " (leaf)" : "");
    text_format(&d->out, "  %-24s %u%s", line.at, l->queues[queue].count,
                l->queues[queue].count ? ":" : "");
    add_numbers(&d->out, l->queues[queue].count, of_queue, &l->queues[queue]);
}

/* What came out stands last. */
static void add_level(debugger *d, const seen_level *l, bool all)
{
    uint32_t shown = 0;
    text_format(&d->out, "%s:\n", l->graph->name);
    for (int leaf = 0; leaf < 2; leaf++)
        for (uint32_t i = 0; i < l->graph->queue_count; i++)
            if (l->graph->queues[i].leaf == leaf && (all || l->queues[i].count)) {
                add_queue(d, l, i);
                shown++;
            }
    if (!shown)
        text_add(&d->out, "  nothing waits\n");
}

void debug_queues(debugger *d, char *arguments)
{
    const history *h = &d->past;
    const char *word = debug_word(&arguments);
    bool all = word && !strcmp(word, "all");
    if (word && !all) {
        debug_refuse(d, "'queues' takes nothing, or 'all'; 'print %s' shows what waits at one node",
                     word);
        return;
    }
    if (!h->level_count)
        text_add(&d->out, "no graph is executing\n");
    for (uint32_t i = h->level_count; i-- > 0;)
        add_level(d, h->levels[i], all);
}

/* ---- entities -------------------------------------------------------------------------------- */

uint32_t debug_find_attribute(const seen_level *l, const char *name)
{
    uint32_t i = 0;
    while (i < l->graph->attribute_count && strcmp(l->graph->attributes[i].name, name) != 0)
        i++;
    return i < l->graph->attribute_count ? i : SEEN_NOWHERE;
}

void debug_add_attribute(debugger *d, const seen_level *l, uint32_t index, const seen_state *s)
{
    const pcg_attribute_info *a = &l->graph->attributes[index];
    const value_type t = {a->kind, a->element, a->enumerators};
    bool written;
    const pcg_cell *cells = seen_attribute(l, index, s, &written);
    text_format(&d->out, "@%s = ", a->name);
    add_value(&d->out, &t, cells);
    text_add(&d->out, written ? "" : " (default)");
}

static void add_scope(debugger *d, const seen_state *s)
{
    text_add(&d->out, "  scope:");
    add_point(&d->out, " origin", s->scope.origin);
    add_point(&d->out, ", size", s->scope.size);
    add_point(&d->out, "\n         x", s->scope.axis[0]);
    add_point(&d->out, ", y", s->scope.axis[1]);
    add_point(&d->out, ", z", s->scope.axis[2]);
    text_add(&d->out, "\n");
}

static void add_entity(debugger *d, const seen_level *l, uint64_t number)
{
    const seen_state *s = history_state(&d->past, number);
    text_format(&d->out, "#%llu", (unsigned long long)number);
    if (!s) {
        text_add(&d->out, " is gone\n");
        return;
    }
    text_format(&d->out, " %s, made by %s", s->type->name, s->maker ? s->maker->name : "the host");
    if (s->is_shape)
        text_format(&d->out, ": %u face%s, %u vertices", s->faces, s->faces == 1 ? "" : "s",
                    s->vertices);
    text_add(&d->out, "\n");
    for (uint32_t i = 0; i < l->graph->attribute_count; i++) {
        text_add(&d->out, "  ");
        debug_add_attribute(d, l, i, s);
        text_add(&d->out, "\n");
    }
    if (s->is_shape)
        add_scope(d, s);
}

static void add_entities(debugger *d, const seen_level *l, uint32_t count,
                         uint64_t (*at)(const void *of, uint32_t i), const void *of)
{
    for (uint32_t i = 0; i < count && i < LISTED_ENTITIES; i++)
        add_entity(d, l, at(of, i));
    if (count > LISTED_ENTITIES)
        text_format(&d->out, "and %u more\n", count - LISTED_ENTITIES);
}

/* The graph that an entity waits in, or was taken in; NULL where it is in none. */
static const seen_level *level_of(const history *h, uint64_t number)
{
    const seen_record *last = history_last(h);
    if (last && last->kind == SEEN_SENT && last->entity == number)
        return history_level(h);
    for (uint32_t i = h->level_count; i-- > 0;) {
        const seen_level *l = h->levels[i];
        for (uint32_t q = 0; q < l->graph->queue_count; q++)
            for (uint32_t k = 0; k < l->queues[q].count; k++)
                if (seen_queue_entity(&l->queues[q], k) == number)
                    return l;
        for (uint32_t k = 0; i < h->open_count && k < h->open[i]->entity_count; k++)
            if (h->open[i]->entities[k] == number)
                return l;
    }
    return NULL;
}

static void print_number(debugger *d, const char *word)
{
    char *end;
    uint64_t number = strtoull(word + (*word == '#'), &end, 10);
    const seen_level *l = *end ? NULL : level_of(&d->past, number);
    if (l)
        add_entity(d, l, number);
    else if (*end || !number)
        debug_refuse(d, "'%s' is no number of an entity", word);
    else
        debug_refuse(d, "#%llu waits nowhere, and no round has taken it",
                     (unsigned long long)number);
}

static void print_attribute(debugger *d, const char *name)
{
    const seen_level *l = history_level(&d->past);
    const seen_round *r = history_round(&d->past);
    uint32_t index = l ? debug_find_attribute(l, name) : SEEN_NOWHERE;
    if (index == SEEN_NOWHERE) {
        debug_refuse(d, "graph '%s' has no attribute '@%s'", l ? l->graph->name : "", name);
        return;
    }
    for (uint32_t i = 0; r && i < r->entity_count && i < LISTED_ENTITIES; i++) {
        text_format(&d->out, "#%llu ", (unsigned long long)r->entities[i]);
        debug_add_attribute(d, l, index, history_state(&d->past, r->entities[i]));
        text_add(&d->out, "\n");
    }
    if (!r || !r->entity_count)
        text_add(&d->out, "this round has taken no entity\n");
}

/* What the round took from a port of its own. */
static bool print_taken(debugger *d, const char *name)
{
    const seen_round *r = history_round(&d->past);
    uint32_t before = 0;
    for (uint32_t i = 0; r && i < r->about->input_count; i++) {
        if (!strcmp(r->about->inputs[i], name)) {
            add_entities(d, history_level(&d->past), r->taken[i], of_array, r->entities + before);
            return true;
        }
        before += r->taken[i];
    }
    return false;
}

/* What waits before a node, or at one of its ports, in the graph that is executing; in those around
 * it, where that has no such node. */
static bool print_waiting(debugger *d, const char *before, const char *name)
{
    bool found = false;
    for (uint32_t i = d->past.level_count; i-- > 0 && !found;) {
        const seen_level *l = d->past.levels[i];
        for (uint32_t q = 0; q < l->graph->queue_count; q++) {
            const pcg_seen_queue *about = &l->graph->queues[q];
            if (strcmp(about->node->name, before) != 0 || (name && strcmp(about->port, name) != 0))
                continue;
            found = true;
            add_queue(d, l, q);
            add_entities(d, l, l->queues[q].count, of_queue, &l->queues[q]);
        }
    }
    return found;
}

static void print_place(debugger *d, char *word)
{
    char *dot = strchr(word, '.');
    if (!dot && print_taken(d, word))
        return;
    if (dot)
        *dot = '\0';
    if (print_waiting(d, word, dot ? dot + 1 : NULL))
        return;
    debug_refuse(d, "there is no queue '%s%s%s' in what executes", word, dot ? "." : "",
                 dot ? dot + 1 : "");
}

void debug_print(debugger *d, char *arguments)
{
    const seen_record *last = history_last(&d->past);
    const seen_round *r = history_round(&d->past);
    char *word = debug_word(&arguments);
    if (word && (*word == '#' || (*word >= '0' && *word <= '9')))
        print_number(d, word);
    else if (word && *word == '@')
        print_attribute(d, word + 1);
    else if (word)
        print_place(d, word);
    else if (!r)
        text_add(&d->out, "no round is under way\n");
    else if (last && last->kind == SEEN_SENT)
        add_entity(d, history_level(&d->past), last->entity);
    else if (!r->entity_count)
        text_add(&d->out, "this round has taken no entity\n");
    else
        add_entities(d, history_level(&d->past), r->entity_count, of_array, r->entities);
}

/* ---- all in all ------------------------------------------------------------------------------ */

void debug_info(debugger *d, char *arguments)
{
    (void)arguments;
    const history *h = &d->past;
    text_format(&d->out, "graph %s, %llu rounds so far\n", pcg_program_name(d->run->program),
                (unsigned long long)h->rounds);
    debug_show_place(d, NULL);
    text_format(&d->out, "recorded: %llu KiB of %zu at most, from the %s on\n",
                (unsigned long long)(h->used + 1023) >> 10, h->limit >> 10,
                h->first ? "oldest round that fits" : "beginning");
    debug_list_breakpoints(d);
}

/* resolve_constants.c - the constants of a graph, in an order in which each reads only those before
 * it.
 *
 * What a constant reads is told from the names in its expression. A cycle is reported; check takes
 * what a constant reads of those behind it for an error that was reported. */
#include "resolve.h"

enum { SHOWN = 8 }; /* names of a cycle that a message lists */

typedef struct candidate {
    const tree_parameter *tree;
    LIST(struct candidate *) reads;
    uint32_t next; /* of `reads`, while it is visited */
    enum { UNSEEN, OPEN, DONE } state;
} candidate;

typedef struct sorting {
    resolver *r;
    graph *graph;
    table candidates;
    LIST(candidate *) stack;
} sorting;

/* Without recursion: a sum of many terms is a deep tree. */
static void find_reads(sorting *s, candidate *c)
{
    arena *a = s->r->arena;
    LIST(const tree_expression *) waiting = {0};
    LIST_ADD(a, &waiting, c->tree->initial);
    while (waiting.count) {
        const tree_expression *e = waiting.at[--waiting.count];
        candidate *read = e->kind == EXPR_NAME ? table_get(&s->candidates, e->name.text) : NULL;
        if (read)
            LIST_ADD(a, &c->reads, read);
        for (uint32_t i = e->operands.count; i-- > 0;)
            LIST_ADD(a, &waiting, e->operands.at[i]);
    }
}

static void report_cycle(sorting *s, const candidate *again)
{
    text chain = {.arena = s->r->arena};
    uint32_t first = s->stack.count;
    while (s->stack.at[first - 1] != again)
        first--;
    for (uint32_t i = first - 1; i < s->stack.count; i++) {
        if (i == first - 1 + SHOWN) {
            text_add(&chain, "… -> ");
            break;
        }
        text_format(&chain, "%s -> ", s->stack.at[i]->tree->name.text);
    }
    text_add(&chain, again->tree->name.text);
    diagnose(s->r->d, DIAG_E0211, again->tree->name.span, again->tree->name.text, chain.at);
}

static void declare(sorting *s, candidate *c)
{
    graph *g = s->graph;
    constant *k = &g->constants[g->constant_count];
    *k = (constant){.name = c->tree->name.text, .tree = c->tree, .index = g->constant_count++};
    table_put(s->r->arena, &g->names->constants, k->name, k);
    c->state = DONE;
}

static void open_candidate(sorting *s, candidate *c)
{
    c->state = OPEN;
    find_reads(s, c);
    LIST_ADD(s->r->arena, &s->stack, c);
}

static void visit(sorting *s, candidate *start)
{
    if (start->state != UNSEEN)
        return;
    open_candidate(s, start);
    while (s->stack.count) {
        candidate *c = s->stack.at[s->stack.count - 1];
        if (c->next == c->reads.count) {
            declare(s, c);
            s->stack.count--;
            continue;
        }
        candidate *read = c->reads.at[c->next++];
        if (read->state == OPEN)
            report_cycle(s, read);
        else if (read->state == UNSEEN)
            open_candidate(s, read);
    }
}

/* A name that is taken is reported, and the constant left out. */
static void add_candidate(sorting *s, const tree_parameter *t)
{
    const parameter *p = table_get(&s->graph->names->parameters, t->name.text);
    const candidate *same = table_get(&s->candidates, t->name.text);
    if (p)
        report_duplicate(s->r, "constant", &t->name, "a parameter", p->tree->name.span);
    else if (same)
        report_duplicate(s->r, "constant", &t->name, "another constant", same->tree->name.span);
    if (p || same)
        return;
    candidate *c = ARENA_NEW(s->r->arena, candidate);
    c->tree = t;
    table_put(s->r->arena, &s->candidates, t->name.text, c);
}

void resolve_constants(resolver *r, graph *g, uint32_t count)
{
    sorting s = {.r = r, .graph = g};
    g->constants = ARENA_ARRAY(r->arena, constant, count);
    for (uint32_t i = 0; i < g->tree->members.count; i++)
        if (g->tree->members.at[i]->kind == MEMBER_CONSTANT)
            add_candidate(&s, g->tree->members.at[i]->parameter);
    for (uint32_t i = 0; i < s.candidates.entries.count; i++)
        visit(&s, s.candidates.entries.at[i].value);
}

/* closure.c - what a graph and all that it encapsulates is made of: a digest of its text, and
 * whether two executions of it know of each other.
 *
 * Needs check; keeps the program. Stand-ins do not count, since they do not run in a graph that is
 * encapsulated. */
#include "closure.h"

#include <string.h>

#include "../runtime/pcg.h"
#include "library.h"

typedef struct walk {
    const program *p;
    bool *seen;          /* by graph->index */
    const graph **stack; /* those that were seen and not looked at */
    uint32_t depth;
    digest digest;
    closure found;
} walk;

/* ---- text ------------------------------------------------------------------------------------ */

static void add_text(walk *w, const graph *g)
{
    const span *whole = &g->tree->head.span;
    digest_add_text(&w->digest, g->name);
    if (whole->source && whole->to <= whole->source->size)
        digest_add(&w->digest, whole->source->text + whole->from, whole->to - whole->from);
    else
        digest_add(&w->digest, g->unit->source->text, g->unit->source->size);
}

static void add_kernels(walk *w)
{
    for (uint32_t i = 0; i < w->p->procedures.count; i++) {
        const procedure *f = w->p->procedures.at[i];
        if (!library_is_builtin(f->library))
            digest_add_text(&w->digest, f->symbol);
    }
}

/* ---- ties ------------------------------------------------------------------------------------ */

static void tie(walk *w, const char *what, const char *name, const char *why)
{
    if (!w->found.tied)
        w->found.tied = arena_format(w->p->arena, "%s'%s' %s", what, name, why);
}

/* What says nothing of itself may do anything. */
static const char *why_tied(uint32_t traits)
{
    if (traits & TRAIT_REFLECTS)
        return "asks or changes the graph that it is in";
    if (traits & TRAIT_EFFECT)
        return "touches what is outside of it";
    if (traits & TRAIT_STATEFUL)
        return "keeps state";
    if (traits & (TRAIT_PURE | TRAIT_RANDOM | TRAIT_READS))
        return NULL;
    return "does not say that it is pure";
}

static void look_at_functions(walk *w)
{
    for (uint32_t i = 0; i < w->p->functions.count; i++) {
        const function *f = w->p->functions.at[i];
        const char *why = why_tied(f->traits);
        if (why)
            tie(w, "function ", f->name, why);
    }
}

/* ---- walking --------------------------------------------------------------------------------- */

static void visit(walk *w, const graph *g)
{
    if (w->seen[g->index])
        return;
    w->seen[g->index] = true;
    w->stack[w->depth++] = g;
}

static void look_at_surrogate(walk *w, const node *n)
{
    if (!strcmp(n->procedure->name, "profile"))
        tie(w, "", n->name, "is measured over the whole run");
    if (n->target)
        visit(w, n->target);
    else
        w->found.loads = true;
}

static void look_at(walk *w, const node *n)
{
    if (n->stand_in)
        return;
    if (n->kind == NODE_GRAPH) {
        visit(w, n->graph);
    } else if (n->kind == NODE_SURROGATE) {
        look_at_surrogate(w, n);
    } else if (n->kind == NODE_PROCEDURE) {
        const char *why = why_tied(n->procedure->traits);
        if (why)
            tie(w, "", n->name, why);
    }
}

closure closure_of(const program *p, const graph *g)
{
    walk w = {.p = p};
    char digits[DIGEST_TEXT];
    w.seen = ARENA_ARRAY(p->arena, bool, p->graph_count);
    w.stack = ARENA_ARRAY(p->arena, const graph *, p->graph_count);
    digest_add_text(&w.digest, PCG_VERSION);
    add_kernels(&w);
    for (visit(&w, g); w.depth;) {
        const graph *next = w.stack[--w.depth];
        add_text(&w, next);
        for (uint32_t i = 0; i < next->node_count; i++)
            look_at(&w, next->nodes[i]);
    }
    look_at_functions(&w);
    digest_write(&w.digest, digits);
    w.found.digest = arena_copy(p->arena, digits, sizeof digits - 1);
    return w.found;
}

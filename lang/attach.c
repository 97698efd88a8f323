/* attach.c - gives every comment to the element that it belongs to.
 *
 * Needs the finished tree and the comments in order. A comment on a line of its own belongs to the
 * element that begins next, one behind an element on its line to that element; one behind the brace
 * that opens an element's body to that element. What stands within an element and has no place of
 * its own goes before it, and what stands behind the last element of a body is the body's
 * (`dangling`). Nothing is lost.
 */
#include "parser.h"

#include <stdlib.h>
#include <string.h>

typedef struct attaching {
    arena *arena;
    const source *source;
    const tree_comments *comments;
    uint32_t next; /* the first that has no place yet */
} attaching;

/* An element of a body, as this file sees it. */
typedef struct spot {
    span span;
    tree_head *head; /* NULL for chains' elements and for arguments */
    tree_comments *before, *after;
    void (*inside)(attaching *a, void *what); /* NULL: nothing within can hold comments */
    void *what;
} spot;
typedef LIST(spot) spots;

static const tree_comment *next_before(const attaching *a, uint32_t limit)
{
    if (a->next == a->comments->count || a->comments->at[a->next].span.from >= limit)
        return NULL;
    return &a->comments->at[a->next];
}

static void take(attaching *a, tree_comments *to)
{
    LIST_ADD(a->arena, to, a->comments->at[a->next]);
    a->next++;
}

static void take_all(attaching *a, tree_comments *to, uint32_t limit)
{
    while (next_before(a, limit))
        take(a, to);
}

/* A comment behind an opening brace is about what the brace opens. */
static bool follows_brace(const attaching *a, const tree_comment *c)
{
    uint32_t at = c->span.from;
    while (at && strchr(" \t", a->source->text[at - 1]))
        at--;
    return at && a->source->text[at - 1] == '{';
}

/* Comments on the line on which an element ends, as long as nothing else begins before them. */
static void take_trailing(attaching *a, tree_comments *to, uint32_t end, uint32_t limit)
{
    const tree_comment *c;
    while ((c = next_before(a, limit)) &&
           !memchr(a->source->text + end, '\n', c->span.from - end) && !follows_brace(a, c))
        take(a, to);
}

/* ---- documentation --------------------------------------------------------------------------- */

static void add_line(text *t, const char *line)
{
    if (t->at)
        text_add(t, "\n");
    text_add(t, *line == ' ' ? line + 1 : line);
}

static void add_lines(text *t, const tree_comments *comments, tree_comment_kind kind)
{
    for (uint32_t i = 0; i < comments->count; i++)
        if (comments->at[i].kind == kind)
            add_line(t, comments->at[i].text);
}

static void finish_head(attaching *a, tree_head *head)
{
    text document = {.arena = a->arena};
    add_lines(&document, &head->before, COMMENT_DOCUMENT);
    add_lines(&document, &head->after, COMMENT_DOCUMENT);
    head->document = document.at;
}

/* An empty line stands before the line on which `at` is the first thing. */
static bool is_blank_before(const source *s, uint32_t at)
{
    int line_ends = 0;
    for (; at && strchr(" \t\r\n", s->text[at - 1]); at--)
        line_ends += s->text[at - 1] == '\n';
    return line_ends >= 2;
}

/* ---- walking --------------------------------------------------------------------------------- */

static void attach_spot(attaching *a, spot *s, uint32_t limit)
{
    take_all(a, s->before, s->span.from);
    if (s->head)
        s->head->blank_before = s->before->count ? s->before->at[0].blank_before
                                                 : is_blank_before(a->source, s->span.from);
    if (s->inside)
        s->inside(a, s->what);
    take_all(a, s->before, s->span.to);
    take_trailing(a, s->after, s->span.to, limit);
    if (s->head)
        finish_head(a, s->head);
}

/* Elements in the order of the text; `end` is where what holds them ends. */
static void attach_spots(attaching *a, const spots *list, uint32_t end)
{
    for (uint32_t i = 0; i < list->count; i++)
        attach_spot(a, &list->at[i], i + 1 < list->count ? list->at[i + 1].span.from : end);
}

/* Likewise, of an element with braces. Its interface may stand before the brace. */
static void attach_braces(attaching *a, tree_head *owner, const spots *list)
{
    for (uint32_t i = 0; i <= list->count; i++) {
        uint32_t limit = i < list->count ? list->at[i].span.from : owner->span.to;
        const tree_comment *c;
        while ((c = next_before(a, limit)) && follows_brace(a, c))
            take(a, &owner->after);
        if (i < list->count)
            attach_spot(a, &list->at[i],
                        i + 1 < list->count ? list->at[i + 1].span.from : owner->span.to);
    }
}

static int compare_spots(const void *left, const void *right)
{
    const spot *x = left, *y = right;
    return x->span.from < y->span.from ? -1 : x->span.from > y->span.from;
}

static void sort_spots(spots *list)
{
    if (list->count)
        qsort(list->at, list->count, sizeof *list->at, compare_spots);
}

static void add_head(attaching *a, spots *list, tree_head *head,
                     void (*inside)(attaching *, void *), void *what)
{
    spot s = {head->span, head, &head->before, &head->after, inside, what};
    LIST_ADD(a->arena, list, s);
}

/* ---- what has comments within ---------------------------------------------------------------- */

static void attach_arguments(attaching *a, tree_arguments *arguments, uint32_t end)
{
    spots list = {0};
    for (uint32_t i = 0; i < arguments->count; i++) {
        tree_argument *argument = &arguments->at[i];
        spot s = {argument->span, NULL, &argument->before, &argument->after, NULL, NULL};
        LIST_ADD(a->arena, &list, s);
    }
    attach_spots(a, &list, end);
}

static void attach_augmentation(attaching *a, void *what)
{
    tree_augmentation *augmentation = what;
    attach_arguments(a, &augmentation->arguments, augmentation->head.span.to);
}

static void attach_chain(attaching *a, void *what);

static void attach_gate(attaching *a, void *what)
{
    tree_gate *gate = what;
    if (gate->stand_in)
        attach_chain(a, gate->stand_in);
}

static void add_gates(attaching *a, spots *list, tree_gates *gates)
{
    for (uint32_t i = 0; i < gates->count; i++)
        add_head(a, list, &gates->at[i]->head, attach_gate, gates->at[i]);
}

static void add_parameters(attaching *a, spots *list, tree_parameters *parameters)
{
    for (uint32_t i = 0; i < parameters->count; i++)
        add_head(a, list, &parameters->at[i]->head, NULL, NULL);
}

static void attach_body(attaching *a, tree_body *body)
{
    spots list = {0};
    for (uint32_t i = 0; i < body->augmentations.count; i++)
        add_head(a, &list, &body->augmentations.at[i]->head, attach_augmentation,
                 body->augmentations.at[i]);
    add_gates(a, &list, &body->inputs);
    add_gates(a, &list, &body->outputs);
    add_parameters(a, &list, &body->parameters);
    add_parameters(a, &list, &body->attributes);
    for (uint32_t i = 0; i < body->loops.count; i++)
        add_head(a, &list, &body->loops.at[i]->head, NULL, NULL);
    sort_spots(&list);
    attach_spots(a, &list, body->span.to);
    take_all(a, &body->dangling, body->span.to);
}

static void attach_element(attaching *a, void *what)
{
    tree_element *element = what;
    attach_arguments(a, &element->arguments,
                     element->body ? element->body->span.from : element->span.to);
    if (element->body)
        attach_body(a, element->body);
}

/* What stands behind the last element is the statement's. */
static void attach_chain(attaching *a, void *what)
{
    tree_chain *chain = what;
    spots list = {0};
    for (uint32_t i = 0; i < chain->elements.count; i++) {
        tree_element *e = chain->elements.at[i];
        spot s = {e->span, NULL, &e->before, &e->after, attach_element, e};
        LIST_ADD(a->arena, &list, s);
    }
    attach_spots(a, &list, chain->span.to);
}

/* A member's head and that of what it holds are the same. */
static void attach_member(attaching *a, void *what)
{
    tree_member *member = what;
    if (member->kind == MEMBER_CHAIN)
        attach_chain(a, member->chain);
    else if (member->kind == MEMBER_INPUT)
        attach_gate(a, member->gate);
}

static void copy_head(tree_member *member)
{
    switch (member->kind) {
    case MEMBER_PARAMETER:
    case MEMBER_CONSTANT:
    case MEMBER_ATTRIBUTE:
        member->parameter->head = member->head;
        break;
    case MEMBER_INPUT:
    case MEMBER_OUTPUT:
        member->gate->head = member->head;
        break;
    case MEMBER_BLOCK:
        member->block->head = member->head;
        break;
    case MEMBER_CHAIN:
        break;
    }
}

static void attach_graph(attaching *a, void *what)
{
    tree_graph *graph = what;
    spots list = {0};
    for (uint32_t i = 0; i < graph->members.count; i++)
        add_head(a, &list, &graph->members.at[i]->head, attach_member, graph->members.at[i]);
    attach_braces(a, &graph->head, &list);
    take_all(a, &graph->dangling, graph->head.span.to);
    for (uint32_t i = 0; i < graph->members.count; i++)
        copy_head(graph->members.at[i]);
}

/* ---- interfaces ------------------------------------------------------------------------------ */

static void attach_augment(attaching *a, void *what)
{
    tree_augment *augment = what;
    spots list = {0};
    add_parameters(a, &list, &augment->parameters);
    add_parameters(a, &list, &augment->attributes);
    sort_spots(&list);
    attach_spots(a, &list, augment->head.span.to);
}

static void attach_example(attaching *a, void *what)
{
    tree_example *example = what;
    for (uint32_t i = 0; i < example->chains.count; i++)
        attach_chain(a, example->chains.at[i]);
}

static void attach_procedure(attaching *a, void *what)
{
    tree_procedure *procedure = what;
    spots list = {0};
    add_gates(a, &list, &procedure->inputs);
    add_gates(a, &list, &procedure->outputs);
    add_parameters(a, &list, &procedure->parameters);
    add_parameters(a, &list, &procedure->attributes);
    for (uint32_t i = 0; i < procedure->augments.count; i++)
        add_head(a, &list, &procedure->augments.at[i]->head, attach_augment,
                 procedure->augments.at[i]);
    for (uint32_t i = 0; i < procedure->examples.count; i++)
        add_head(a, &list, &procedure->examples.at[i]->head, attach_example,
                 procedure->examples.at[i]);
    sort_spots(&list);
    attach_braces(a, &procedure->head, &list);
    take_all(a, &procedure->dangling, procedure->head.span.to);
}

static void attach_function(attaching *a, void *what)
{
    tree_function *function = what;
    spots list = {0};
    add_parameters(a, &list, &function->parameters);
    attach_braces(a, &function->head, &list);
    take_all(a, &function->dangling, function->head.span.to);
}

static void attach_entity(attaching *a, void *what)
{
    tree_entity *entity = what;
    spots list = {0};
    add_parameters(a, &list, &entity->attributes);
    attach_braces(a, &entity->head, &list);
    take_all(a, &entity->dangling, entity->head.span.to);
}

static void attach_enumeration(attaching *a, void *what)
{
    tree_enumeration *enumeration = what;
    spots list = {0};
    for (uint32_t i = 0; i < enumeration->enumerators.count; i++)
        add_head(a, &list, &enumeration->enumerators.at[i].head, NULL, NULL);
    attach_braces(a, &enumeration->head, &list);
    take_all(a, &enumeration->dangling, enumeration->head.span.to);
}

/* ---- the file -------------------------------------------------------------------------------- */

static void add_item(attaching *a, spots *list, tree_item *item)
{
    switch (item->kind) {
    case ITEM_IMPORT:
        add_head(a, list, &item->import->head, NULL, NULL);
        break;
    case ITEM_USE:
        add_head(a, list, &item->use->head, NULL, NULL);
        break;
    case ITEM_GRAPH:
        add_head(a, list, &item->graph->head, attach_graph, item->graph);
        break;
    case ITEM_PROCEDURE:
        add_head(a, list, &item->procedure->head, attach_procedure, item->procedure);
        break;
    case ITEM_FUNCTION:
        add_head(a, list, &item->function->head, attach_function, item->function);
        break;
    case ITEM_ENTITY:
        add_head(a, list, &item->entity->head, attach_entity, item->entity);
        break;
    case ITEM_ENUMERATION:
        add_head(a, list, &item->enumeration->head, attach_enumeration, item->enumeration);
        break;
    }
}

/* The file's own comments at its top: everything up to the last //! and, behind that, plain ones
 * that an empty line separates from what follows. The rest stays ahead and is the first item's. */
static void attach_top(attaching *a, tree_file *file, uint32_t limit)
{
    uint32_t own = 0, end = a->next;
    while (end < a->comments->count && a->comments->at[end].span.from < limit)
        end++;
    for (uint32_t i = 0; i < end; i++) {
        const tree_comment *c = &a->comments->at[i];
        bool apart = i + 1 < end ? c[1].blank_before
                                 : limit < a->source->size && is_blank_before(a->source, limit);
        if (c->kind == COMMENT_DOCUMENT_FILE || (c->kind == COMMENT_PLAIN && apart))
            own = i + 1;
    }
    while (a->next < own)
        take(a, &file->before);
}

void attach_comments(parser *p)
{
    attaching a = {.arena = p->arena, .source = p->source, .comments = &p->comments};
    tree_file *file = p->file;
    uint32_t end = (uint32_t)p->source->size;
    spots list = {0};
    for (uint32_t i = 0; i < file->items.count; i++)
        add_item(&a, &list, &file->items.at[i]);
    attach_top(&a, file, list.count ? list.at[0].span.from : end);
    attach_spots(&a, &list, end);
    take_all(&a, &file->dangling, end + 1);
    text document = {.arena = p->arena};
    add_lines(&document, &p->comments, COMMENT_DOCUMENT_FILE);
    file->document = document.at;
}

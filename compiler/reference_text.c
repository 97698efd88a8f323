/* reference_text.c - the reference on a terminal: 80 columns, no colours. */
#include <string.h>

#include "reference.h"

enum { WIDTH = 80, LIST_COLUMN = 26 };

/* ---- layout ---------------------------------------------------------------------------------- */

/* Characters of UTF-8, not bytes. */
static size_t columns(const char *s, size_t length)
{
    size_t count = 0;
    for (size_t i = 0; i < length; i++)
        count += ((unsigned char)s[i] & 0xc0) != 0x80;
    return count;
}

static void pad(text *out, size_t from, size_t to)
{
    for (; from < to; from++)
        text_add(out, " ");
}

/* Adds words from column `at` on, broken so that all lines but the first begin at `indent`; ends
 * the line. */
static void wrap(text *out, const char *words, size_t at, size_t indent)
{
    for (words += strspn(words, " \n"); *words; words += strspn(words, " \n")) {
        size_t length = strcspn(words, " \n"), width = columns(words, length);
        if (at > indent && at + 1 + width > WIDTH) {
            text_add(out, "\n");
            pad(out, 0, indent);
            at = indent;
        } else if (at > indent) {
            text_add(out, " ");
            at++;
        }
        text_add_bytes(out, words, length);
        at += width;
        words += length;
    }
    text_add(out, "\n");
}

/* Paragraphs, which empty lines part. */
static void wrap_paragraphs(text *out, const char *document, size_t indent)
{
    while (document && *document) {
        const char *gap = strstr(document, "\n\n");
        size_t length = gap ? (size_t)(gap - document) : strlen(document);
        pad(out, 0, indent);
        wrap(out, arena_copy(out->arena, document, length), indent, indent);
        document += length;
        document += strspn(document, "\n");
        text_add(out, *document ? "\n" : "");
    }
}

/* "  left        words …": the words begin at `column`, on a line of their own where left is too
 * long. */
static void write_row(text *out, const char *left, const char *words, size_t column)
{
    size_t at = 2 + columns(left, strlen(left));
    text_format(out, "  %s", left);
    if (!*words) {
        text_add(out, "\n");
        return;
    }
    if (at + 2 > column) {
        text_add(out, "\n");
        at = 0;
    }
    pad(out, at, column);
    wrap(out, words, column, column);
}

static void heading(text *out, const char *title, uint32_t count)
{
    if (count)
        text_format(out, "\n%s\n", title);
}

/* ---- one entry ------------------------------------------------------------------------------- */

static void write_enumerators(const reference *r, const tree_type *t, size_t column, text *out)
{
    const tree_enumeration *e = reference_enumeration(r, t);
    if (!e)
        return;
    text words = {.arena = out->arena};
    text_add(&words, "One of ");
    for (uint32_t i = 0; i < e->enumerators.count; i++)
        text_format(&words, "%s%s", i ? ", " : "", e->enumerators.at[i].name.text);
    pad(out, 0, column);
    wrap(out, words.at, column, column);
}

static void write_parameter(const reference *r, const tree_parameter *p, size_t column, text *out)
{
    text left = {.arena = out->arena};
    text_format(&left, "%s: ", p->name.text);
    lang_write_type(p->type, &left);
    if (p->initial) {
        text_add(&left, " = ");
        lang_write_expression(p->initial, &left);
    }
    write_row(out, left.at, reference_line(out->arena, p->head.document), column);
    if (p->constraints.count) {
        text words = {.arena = out->arena};
        reference_write_constraints(p, &words);
        pad(out, 0, column);
        wrap(out, words.at, column, column);
    }
    write_enumerators(r, p->type, column, out);
}

static void write_parameters(const reference *r, const char *title, const tree_parameters *list,
                             text *out)
{
    heading(out, title, list->count);
    for (uint32_t i = 0; i < list->count; i++)
        write_parameter(r, list->at[i], 30, out);
}

static void write_augments(const reference *r, const tree_procedure *p, text *out)
{
    heading(out, "Augmentations", p->augments.count);
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        text head = {.arena = out->arena};
        reference_write_augment_head(g, &head);
        text_format(out, "  %s\n", head.at);
        wrap_paragraphs(out, g->head.document, 6);
        for (uint32_t k = 0; k < g->parameters.count; k++) {
            const tree_parameter *q = g->parameters.at[k];
            if (q->head.document || q->constraints.count || reference_enumeration(r, q->type)) {
                text_add(out, "    ");
                write_parameter(r, q, 30, out);
            }
        }
    }
}

static void write_procedure(const reference *r, const tree_procedure *p, text *out)
{
    text head = {.arena = out->arena};
    reference_write_procedure_head(p, &head);
    text_add(out, "\n  ");
    wrap(out, head.at, 2, 6);
    if (p->traits.count) {
        text_add(out, "  [");
        reference_write_names(&p->traits, ", ", out);
        text_add(out, "]\n");
    }
    write_parameters(r, "Parameters", &p->parameters, out);
    write_parameters(r, "Attributes, to be linked with => or <=>", &p->attributes, out);
    write_augments(r, p, out);
    heading(out, "Examples", p->examples.count);
    for (uint32_t i = 0; i < p->examples.count; i++) {
        text_add(out, "  ");
        reference_write_chains(p->examples.at[i], "\n  ", out);
        text_add(out, p->examples.at[i]->expectations.count ? "\n      gives " : "");
        reference_write_expectations(p->examples.at[i], out);
        text_add(out, "\n");
    }
    if (p->synonyms.count) {
        text_add(out, "\nAlso searched for as: ");
        reference_write_names(&p->synonyms, ", ", out);
        text_add(out, "\n");
    }
    if (p->former.count) {
        text_add(out, "\nFormerly: ");
        reference_write_names(&p->former, ", ", out);
        text_add(out, "\n");
    }
}

static void write_functions(const reference_item *item, text *out)
{
    text_add(out, "\n");
    uint32_t examples = 0;
    for (uint32_t i = 0; i < item->functions.count; i++) {
        text head = {.arena = out->arena};
        const char *document = reference_overload_document(item, i);
        if (document) {
            text_add(out, "\n");
            wrap_paragraphs(out, document, 0);
            text_add(out, "\n");
        }
        reference_write_function_head(item->functions.at[i], &head);
        text_add(out, "  ");
        wrap(out, head.at, 2, 6);
        examples += item->functions.at[i]->examples.count;
    }
    heading(out, "Examples", examples);
    for (uint32_t i = 0; i < item->functions.count; i++) {
        const tree_function *f = item->functions.at[i];
        for (uint32_t k = 0; k < f->examples.count; k++) {
            text_add(out, "  ");
            lang_write_expression(f->examples.at[k], out);
            text_add(out, "\n");
        }
    }
}

static void write_enumeration(const tree_enumeration *e, text *out)
{
    heading(out, "Enumerators", e->enumerators.count);
    for (uint32_t i = 0; i < e->enumerators.count; i++) {
        const tree_enumerator *x = &e->enumerators.at[i];
        write_row(out, x->name.text, reference_line(out->arena, x->head.document), LIST_COLUMN);
    }
}

void reference_write_text(const reference *r, const reference_item *item, text *out)
{
    text_format(out, "%s %s.%s", reference_kind(item), item->library->name, item->name);
    text_format(out, "  (%s, %s:%u)\n\n", item->group, item->path, item->line);
    wrap_paragraphs(out, item->summary, 0);
    if (item->details) {
        text_add(out, "\n");
        wrap_paragraphs(out, item->details, 0);
    }
    if (item->procedure)
        write_procedure(r, item->procedure, out);
    if (item->functions.count)
        write_functions(item, out);
    if (item->entity && item->entity->parent.text)
        text_format(out, "\n  entity %s: %s\n", item->name, item->entity->parent.text);
    if (item->entity)
        write_parameters(r, "Attributes", &item->entity->attributes, out);
    if (item->enumeration)
        write_enumeration(item->enumeration, out);
}

/* ---- lists ----------------------------------------------------------------------------------- */

void reference_write_list(const reference_items *items, text *out)
{
    for (uint32_t i = 0; i < items->count; i++) {
        const reference_item *item = items->at[i];
        const char *call = item->kind == ENTRY_FUNCTION ? "()" : "";
        const char *name = arena_format(out->arena, "%s%s", item->name, call);
        write_row(out, name, item->summary, LIST_COLUMN);
    }
}

/* Items from `at` on that share a library, kind and group. */
static reference_items group_at(const reference *r, uint32_t at)
{
    reference_items group = {r->items.at + at, 0, 0};
    const reference_item *first = r->items.at[at];
    while (at + group.count < r->items.count) {
        const reference_item *item = r->items.at[at + group.count];
        if (item->library != first->library || strcmp(item->group, first->group) ||
            (item->kind == ENTRY_PROCEDURE) != (first->kind == ENTRY_PROCEDURE))
            break;
        group.count++;
    }
    return group;
}

void reference_write_index(const reference *r, const char *library, text *out)
{
    const pcg_library *before = NULL;
    for (uint32_t i = 0; i < r->items.count;) {
        reference_items group = group_at(r, i);
        const reference_item *first = group.at[0];
        i += group.count;
        if (library && strcmp(first->library->name, library))
            continue;
        if (first->library != before) {
            text_format(out, "%s%s:", before ? "\n" : "", first->library->name);
            const char *document = reference_line(out->arena, first->library->document);
            wrap(out, document, strlen(first->library->name) + 1, 0);
        }
        before = first->library;
        const char *functions = first->kind == ENTRY_FUNCTION ? "functions: " : "";
        text_format(out, "\n%s%s\n", functions, first->group);
        reference_write_list(&group, out);
    }
}

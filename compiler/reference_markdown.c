/* reference_markdown.c - the whole reference as one Markdown document. */
#include <string.h>

#include "reference.h"

/* A table's cell: on one line, with bars escaped. */
static void cell(text *out, const char *s)
{
    text_add(out, "| ");
    for (; s && *s; s++) {
        if (*s == '|')
            text_add(out, "\\|");
        else
            text_add_bytes(out, *s == '\n' ? " " : s, 1);
    }
    text_add(out, " ");
}

static void code_cell(text *out, const text *s)
{
    cell(out, s->length ? arena_format(out->arena, "`%s`", s->at) : "");
}

static void parameters(const reference *r, const char *title, const tree_parameters *list,
                       text *out)
{
    if (!list->count)
        return;
    text_format(out, "\n| %s | type | default | |\n| --- | --- | --- | --- |\n", title);
    for (uint32_t i = 0; i < list->count; i++) {
        const tree_parameter *p = list->at[i];
        text type_text = {.arena = out->arena}, value = {.arena = out->arena};
        text words = {.arena = out->arena};
        lang_write_type(p->type, &type_text);
        if (p->initial)
            lang_write_expression(p->initial, &value);
        text_add(&words, reference_line(out->arena, p->head.document));
        if (p->constraints.count) {
            text_add(&words, " `");
            reference_write_constraints(p, &words);
            text_add(&words, "`");
        }
        const tree_enumeration *e = reference_enumeration(r, p->type);
        for (uint32_t k = 0; e && k < e->enumerators.count; k++)
            text_format(&words, "%s`%s`", k ? ", " : " One of ", e->enumerators.at[k].name.text);
        cell(out, arena_format(out->arena, "`%s`", p->name.text));
        code_cell(out, &type_text);
        code_cell(out, &value);
        cell(out, words.at);
        text_add(out, "|\n");
    }
}

static void augments(const reference *r, const tree_procedure *p, text *out)
{
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        text head = {.arena = out->arena};
        reference_write_augment_head(g, &head);
        text_format(out, "\n**Augmentation** `%s`. %s\n", head.at,
                    g->head.document ? g->head.document : "");
        bool documented = false;
        for (uint32_t k = 0; k < g->parameters.count; k++)
            documented = documented || g->parameters.at[k]->head.document;
        if (documented)
            parameters(r, "parameter", &g->parameters, out);
    }
}

static void procedure(const reference *r, const tree_procedure *p, text *out)
{
    text_add(out, "\n```pcg-interface\n");
    reference_write_procedure_head(p, out);
    if (p->traits.count) {
        text_add(out, " [");
        reference_write_names(&p->traits, ", ", out);
        text_add(out, "]");
    }
    text_add(out, "\n```\n");
    parameters(r, "parameter", &p->parameters, out);
    parameters(r, "attribute", &p->attributes, out);
    augments(r, p, out);
    for (uint32_t i = 0; i < p->examples.count; i++) {
        text_add(out, "\n```pcg-chain\n");
        reference_write_chains(p->examples.at[i], "\n", out);
        text_add(out, p->examples.at[i]->expectations.count ? "    // gives " : "");
        reference_write_expectations(p->examples.at[i], out);
        text_add(out, "\n```\n");
    }
    if (p->synonyms.count) {
        text_add(out, "\nAlso searched for as: ");
        reference_write_names(&p->synonyms, ", ", out);
        text_add(out, ".\n");
    }
}

static void functions(const reference_item *item, text *out)
{
    text_add(out, "\n```pcg-interface\n");
    for (uint32_t i = 0; i < item->functions.count; i++) {
        const char *document = reference_overload_document(item, i);
        if (document)
            text_format(out, "```\n\n%s\n\n```pcg-interface\n", document);
        reference_write_function_head(item->functions.at[i], out);
        text_add(out, "\n");
    }
    text_add(out, "```\n\nExamples: ");
    uint32_t count = 0;
    for (uint32_t i = 0; i < item->functions.count; i++) {
        for (uint32_t k = 0; k < item->functions.at[i]->examples.count; k++) {
            text_add(out, count++ ? ", `" : "`");
            lang_write_expression(item->functions.at[i]->examples.at[k], out);
            text_add(out, "`");
        }
    }
    text_add(out, ".\n");
}

static void write_item(const reference *r, const reference_item *item, text *out)
{
    const char *call = item->kind == ENTRY_FUNCTION ? "()" : "";
    text_format(out, "\n#### %s%s\n\n%s\n", item->name, call, item->summary);
    if (item->details)
        text_format(out, "\n%s\n", item->details);
    if (item->procedure)
        procedure(r, item->procedure, out);
    if (item->functions.count)
        functions(item, out);
    if (item->entity)
        parameters(r, "attribute", &item->entity->attributes, out);
    for (uint32_t i = 0; item->enumeration && i < item->enumeration->enumerators.count; i++) {
        const tree_enumerator *e = &item->enumeration->enumerators.at[i];
        const char *words = reference_line(out->arena, e->head.document);
        text_format(out, "%s- `%s`%s%s\n", i ? "" : "\n", e->name.text, *words ? ": " : "", words);
    }
}

void reference_write_markdown(const reference *r, text *out)
{
    const pcg_library *library = NULL;
    const char *group = NULL;
    text_add(out, "# Reference\n\nMade from the interfaces of the libraries.\n");
    for (uint32_t i = 0; i < r->items.count; i++) {
        const reference_item *item = r->items.at[i];
        if (item->library != library) {
            const char *document = item->library->document;
            text_format(out, "\n## %s\n\n%s\n", item->library->name, document ? document : "");
            group = NULL;
        }
        library = item->library;
        if (!group || strcmp(group, item->group))
            text_format(out, "\n### %s%s\n", item->kind == ENTRY_FUNCTION ? "Functions: " : "",
                        item->group);
        group = item->group;
        write_item(r, item, out);
    }
}

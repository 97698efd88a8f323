/* reference_json.c - the reference for programs: an array of entries. */
#include <string.h>

#include "reference.h"

static void field(text *out, const char *name, const char *string)
{
    text_format(out, ", \"%s\": ", name);
    if (string)
        text_quote(out, string);
    else
        text_add(out, "null");
}

static void type_field(text *out, const char *name, const tree_type *t)
{
    text type_text = {.arena = out->arena};
    if (t)
        lang_write_type(t, &type_text);
    field(out, name, t ? type_text.at : NULL);
}

static void name_list(text *out, const char *name, const tree_names *list)
{
    text_format(out, ", \"%s\": [", name);
    for (uint32_t i = 0; i < list->count; i++) {
        text_add(out, i ? ", " : "");
        text_quote(out, list->at[i].text);
    }
    text_add(out, "]");
}

static void variables(text *out, const tree_variable *at, uint32_t count)
{
    text_add(out, ", \"variables\": [");
    for (uint32_t i = 0; i < count; i++) {
        text_add(out, i ? ", {\"name\": " : "{\"name\": ");
        text_quote(out, at[i].name.text);
        field(out, "bound", at[i].bound.text ? at[i].bound.text : "Entity");
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void gates(text *out, const char *name, const tree_gates *list)
{
    text_format(out, ", \"%s\": [", name);
    for (uint32_t i = 0; i < list->count; i++) {
        text_add(out, i ? ", {\"name\": " : "{\"name\": ");
        text_quote(out, list->at[i]->name.text);
        type_field(out, "type", list->at[i]->type);
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void parameters(text *out, const char *name, const tree_parameters *list)
{
    text_format(out, ", \"%s\": [", name);
    for (uint32_t i = 0; i < list->count; i++) {
        const tree_parameter *p = list->at[i];
        text_add(out, i ? ", {\"name\": " : "{\"name\": ");
        text_quote(out, p->name.text);
        type_field(out, "type", p->type);
        text value = {.arena = out->arena};
        if (p->initial)
            lang_write_expression(p->initial, &value);
        field(out, "default", p->initial ? value.at : NULL);
        text constraints = {.arena = out->arena};
        reference_write_constraints(p, &constraints);
        field(out, "constraints", constraints.length ? constraints.at : NULL);
        field(out, "document", p->head.document);
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void augments(text *out, const tree_procedure *p)
{
    text_add(out, ", \"augmentations\": [");
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        text_add(out, i ? ", {\"name\": " : "{\"name\": ");
        text_quote(out, g->name.text);
        field(out, "document", g->head.document);
        parameters(out, "parameters", &g->parameters);
        parameters(out, "attributes", &g->attributes);
        type_field(out, "output", g->output);
        type_field(out, "input", g->input);
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void procedure(text *out, const tree_procedure *p)
{
    variables(out, p->variables.at, p->variables.count);
    gates(out, "inputs", &p->inputs);
    gates(out, "outputs", &p->outputs);
    parameters(out, "parameters", &p->parameters);
    parameters(out, "attributes", &p->attributes);
    augments(out, p);
    name_list(out, "traits", &p->traits);
    name_list(out, "synonyms", &p->synonyms);
    name_list(out, "formerly", &p->former);
    text_add(out, ", \"examples\": [");
    for (uint32_t i = 0; i < p->examples.count; i++) {
        text chain = {.arena = out->arena}, expected = {.arena = out->arena};
        reference_write_chains(p->examples.at[i], "; ", &chain);
        reference_write_expectations(p->examples.at[i], &expected);
        text_add(out, i ? ", {\"chain\": " : "{\"chain\": ");
        text_quote(out, chain.at);
        field(out, "expect", expected.length ? expected.at : "");
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void function(text *out, const tree_function *f)
{
    text head = {.arena = out->arena};
    reference_write_function_head(f, &head);
    text_add(out, "{\"head\": ");
    text_quote(out, head.at);
    variables(out, f->variables.at, f->variables.count);
    parameters(out, "parameters", &f->parameters);
    type_field(out, "result", f->result);
    field(out, "document", f->head.document);
    name_list(out, "traits", &f->traits);
    text_add(out, ", \"examples\": [");
    for (uint32_t i = 0; i < f->examples.count; i++) {
        text expression = {.arena = out->arena};
        lang_write_expression(f->examples.at[i], &expression);
        text_add(out, i ? ", " : "");
        text_quote(out, expression.at);
    }
    text_add(out, "]}");
}

static void enumeration(text *out, const tree_enumeration *e)
{
    text_add(out, ", \"enumerators\": [");
    for (uint32_t i = 0; i < e->enumerators.count; i++) {
        text_add(out, i ? ", {\"name\": " : "{\"name\": ");
        text_quote(out, e->enumerators.at[i].name.text);
        field(out, "document", e->enumerators.at[i].head.document);
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void write_item(const reference_item *item, text *out)
{
    text_add(out, "{\"kind\": ");
    text_quote(out, reference_kind(item));
    field(out, "name", item->name);
    field(out, "library", item->library->name);
    field(out, "group", item->group);
    field(out, "summary", item->summary);
    field(out, "details", item->details);
    field(out, "file", item->path);
    text_format(out, ", \"line\": %u", item->line);
    if (item->procedure)
        procedure(out, item->procedure);
    if (item->functions.count)
        text_add(out, ", \"overloads\": [");
    for (uint32_t i = 0; i < item->functions.count; i++) {
        text_add(out, i ? ", " : "");
        function(out, item->functions.at[i]);
    }
    text_add(out, item->functions.count ? "]" : "");
    if (item->entity) {
        field(out, "parent", item->entity->parent.text);
        parameters(out, "attributes", &item->entity->attributes);
    }
    if (item->enumeration)
        enumeration(out, item->enumeration);
    text_add(out, "}");
}

void reference_write_json(const reference *r, const reference_items *items, text *out)
{
    (void)r;
    text_add(out, "{\"version\": 1, \"entries\": [");
    for (uint32_t i = 0; i < items->count; i++) {
        text_add(out, i ? ",\n" : "\n");
        write_item(items->at[i], out);
    }
    text_add(out, "\n]}\n");
}

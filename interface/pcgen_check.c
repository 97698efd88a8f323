/* pcgen_check.c - what must hold of interfaces beyond their syntax: names that tell apart, in the
 * language and in C, types that exist, and that everything is documented and has an example. */
#include "pcgen.h"

#include <string.h>

typedef struct variables {
    const tree_variable *at;
    uint32_t count;
} variables;

typedef struct checker {
    pcgen *g;
    const pcgen_library *library;
    const pcgen_file *file;
    variables variables; /* of the item that is being checked */
    table *names;        /* of the library: "procedure split", the name's span */
    table *constants;    /* of all libraries: C names of enumerators, the span of theirs */
} checker;

static arena *memory(checker *c)
{
    return &c->g->arena;
}

/* Reports a name that the table holds already, and adds it otherwise. */
static void declare(checker *c, table *names, const char *key, const tree_name *name)
{
    span *earlier = table_get(names, key);
    if (earlier) {
        diagnostic *d = diagnose(&c->g->diagnostics, DIAG_E0801, name->span, name->text);
        d->second = (diagnostic_label){*earlier, "first here"};
        return;
    }
    span *place = ARENA_NEW(memory(c), span);
    *place = name->span;
    table_put(memory(c), names, key, place);
}

static void declare_item(checker *c, const char *kind, const tree_name *name)
{
    declare(c, c->names, arena_format(memory(c), "%s %s", kind, name->text), name);
}

/* ---- what every item has --------------------------------------------------------------------- */

static void check_document(checker *c, const char *kind, const tree_head *head,
                           const tree_name *name)
{
    if (!head->document || head->document[0] == '\0') {
        diagnose(&c->g->diagnostics, DIAG_E0803, name->span, kind, name->text);
    }
}

static void check_documents(checker *c, const char *kind, const tree_parameters *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        check_document(c, kind, &list->at[i]->head, &list->at[i]->name);
    }
}

static void check_traits(checker *c, const tree_names *traits)
{
    static const char *const known[] = {"pure",       "stateful", "effect",
                                        "one_to_one", "random",   "reflects", "reads"};
    for (uint32_t i = 0; i < traits->count; i++) {
        bool found = false;
        for (size_t k = 0; k < COUNT_OF(known); k++) {
            found = found || strcmp(known[k], traits->at[i].text) == 0;
        }
        if (!found) {
            diagnose(&c->g->diagnostics, DIAG_E0807, traits->at[i].span, traits->at[i].text);
        }
    }
}

/* ---- types ----------------------------------------------------------------------------------- */

static const char *bound_of(const checker *c, const char *name)
{
    for (uint32_t i = 0; i < c->variables.count; i++) {
        const tree_variable *v = &c->variables.at[i];
        if (strcmp(v->name.text, name) == 0) {
            return v->bound.text ? v->bound.text : "Entity";
        }
    }
    return NULL;
}

static bool is_entity(const checker *c, const char *name)
{
    const interface_types *types = &c->g->types;
    return bound_of(c, name) || types->is_entity(types->context, name);
}

static bool is_value(const checker *c, const char *name)
{
    const interface_types *types = &c->g->types;
    return interface_is_value_type(name) || types->is_enumeration(types->context, name);
}

static void unknown_type(checker *c, const tree_name *name)
{
    LIST(const char *) candidates = {NULL, 0, 0};
    for (uint32_t i = 0; i < c->g->enumerations.entries.count; i++) {
        LIST_ADD(memory(c), &candidates, c->g->enumerations.entries.at[i].key);
    }
    for (uint32_t i = 0; i < c->g->entities.entries.count; i++) {
        LIST_ADD(memory(c), &candidates, c->g->entities.entries.at[i].key);
    }
    const char *near = nearest_name(name->text, candidates.at, candidates.count);
    diagnostic *d = diagnose(&c->g->diagnostics, DIAG_E0802, name->span, name->text);
    if (near) {
        d->text = arena_format(memory(c), "did you mean '%s'?", near);
    }
}

typedef enum expected_type { EXPECT_VALUE = 1, EXPECT_ENTITY = 2, EXPECT_EITHER = 3 } expected_type;

static void check_type(checker *c, const tree_type *t, expected_type expected)
{
    if (!t || !t->name.text) {
        return; /* the parser has said so */
    }
    bool fits = ((expected & EXPECT_VALUE) && is_value(c, t->name.text)) ||
                ((expected & EXPECT_ENTITY) && is_entity(c, t->name.text));
    if (!fits && !is_value(c, t->name.text) && !is_entity(c, t->name.text)) {
        unknown_type(c, &t->name);
    } else if (!fits) {
        diagnose(&c->g->diagnostics, DIAG_E0813, t->span, t->name.text,
                 expected == EXPECT_VALUE ? "a value" : "an entity");
    }
    if (t->element) {
        check_type(c, t->element, EXPECT_VALUE);
    }
}

static void check_types(checker *c, const tree_parameters *list, expected_type expected)
{
    for (uint32_t i = 0; i < list->count; i++) {
        check_type(c, list->at[i]->type, expected);
    }
}

static void check_bounds(checker *c)
{
    for (uint32_t i = 0; i < c->variables.count; i++) {
        const tree_name *bound = &c->variables.at[i].bound;
        const interface_types *types = &c->g->types;
        if (bound->text && !types->is_entity(types->context, bound->text)) {
            unknown_type(c, bound);
        }
    }
}

/* ---- fields of the struct in C --------------------------------------------------------------- */

static void take_field(checker *c, table *fields, const tree_name *name)
{
    if (!name->text) {
        return;
    }
    const char *field = interface_field(memory(c), name->text);
    const char *other = table_get(fields, field);
    if (other) {
        diagnose(&c->g->diagnostics, DIAG_E0806, name->span, name->text, other, field);
    } else {
        table_put(memory(c), fields, field, (void *)(uintptr_t)name->text);
    }
}

static void take_fields(checker *c, table *fields, const tree_parameters *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        take_field(c, fields, &list->at[i]->name);
    }
}

/* Fields that the writer of the struct adds of its own. */
static void reserve_fields(checker *c, table *fields, const char *const *names, size_t count)
{
    static char part[] = "a part of every node";
    for (size_t i = 0; i < count; i++) {
        table_put(memory(c), fields, names[i], part);
    }
}

static void check_fields(checker *c, const tree_procedure *p)
{
    static const char *const own[] = {"instance", "items", "item_count"};
    static const char *const item[] = {"kind", "name", "port", "input"};
    table fields = {0};
    reserve_fields(c, &fields, own, COUNT_OF(own));
    for (uint32_t i = 0; i < p->inputs.count; i++) {
        take_field(c, &fields, &p->inputs.at[i]->name);
    }
    take_fields(c, &fields, &p->parameters);
    take_fields(c, &fields, &p->attributes);
    for (uint32_t i = 0; i < p->outputs.count; i++) {
        take_field(c, &fields, &p->outputs.at[i]->name);
    }
    table kinds = {0};
    reserve_fields(c, &kinds, item, COUNT_OF(item));
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        table own_fields = {0};
        take_field(c, &kinds, &g->name);
        take_fields(c, &own_fields, &g->parameters);
        take_fields(c, &own_fields, &g->attributes);
    }
}

/* ---- items ----------------------------------------------------------------------------------- */

static void check_augments(checker *c, const tree_procedure *p)
{
    uint32_t single = 0, collective = 0;
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        check_document(c, "augmentation", &g->head, &g->name);
        check_types(c, &g->parameters, EXPECT_VALUE);
        check_types(c, &g->attributes, EXPECT_VALUE);
        check_type(c, g->output, EXPECT_ENTITY);
        check_type(c, g->input, EXPECT_ENTITY);
        single += g->input && !g->input->collective;
        collective += g->input && g->input->collective;
    }
    if (single > 0 && collective > 0) {
        diagnose(&c->g->diagnostics, DIAG_E0812, p->name.span, p->name.text);
    }
}

static void check_gates(checker *c, const tree_gates *gates)
{
    for (uint32_t i = 0; i < gates->count; i++) {
        check_type(c, gates->at[i]->type, EXPECT_ENTITY);
    }
}

/* A node runs for what comes to its first input, and once for all of it. */
static void check_inputs(checker *c, const tree_gates *inputs)
{
    check_gates(c, inputs);
    for (uint32_t i = 0; i < inputs->count; i++) {
        const tree_type *t = inputs->at[i]->type, *first = inputs->at[0]->type;
        if (t && t->optional && (i == 0 || !first || !first->collective)) {
            diagnose(&c->g->diagnostics, DIAG_E0320, t->span, inputs->at[i]->name.text,
                     "it stands behind a collective input that is not");
        }
    }
}

static void check_procedure(checker *c, const tree_procedure *p)
{
    c->variables = (variables){p->variables.at, p->variables.count};
    declare_item(c, "procedure", &p->name);
    for (uint32_t i = 0; i < p->former.count; i++) {
        declare_item(c, "procedure", &p->former.at[i]);
    }
    if (strcmp(p->name.text, c->file->name) != 0) {
        diagnose(&c->g->diagnostics, DIAG_E0809, p->name.span, p->name.text, c->file->name);
    }
    check_document(c, "procedure", &p->head, &p->name);
    if (!p->category.text) {
        diagnose(&c->g->diagnostics, DIAG_E0804, p->name.span, p->name.text);
    }
    if (p->examples.count == 0) {
        diagnose(&c->g->diagnostics, DIAG_E0805, p->name.span, "procedure", p->name.text);
    }
    check_traits(c, &p->traits);
    check_bounds(c);
    check_inputs(c, &p->inputs);
    check_gates(c, &p->outputs);
    check_documents(c, "parameter", &p->parameters);
    check_types(c, &p->parameters, EXPECT_VALUE);
    check_documents(c, "attribute", &p->attributes);
    check_types(c, &p->attributes, EXPECT_VALUE);
    check_augments(c, p);
    check_fields(c, p);
}

static void check_function(checker *c, const tree_function *f)
{
    c->variables = (variables){f->variables.at, f->variables.count};
    const char *symbol = interface_function_symbol(memory(c), c->library->name, f);
    declare(c, c->names, arena_format(memory(c), "symbol %s", symbol), &f->name);
    check_document(c, "function", &f->head, &f->name);
    if (f->examples.count == 0) {
        diagnose(&c->g->diagnostics, DIAG_E0805, f->name.span, "function", f->name.text);
    }
    check_traits(c, &f->traits);
    check_bounds(c);
    table fields = {0};
    static const char *const own[] = {"call", "site", "result"};
    reserve_fields(c, &fields, own, COUNT_OF(own));
    take_fields(c, &fields, &f->parameters);
    check_types(c, &f->parameters, EXPECT_EITHER);
    for (uint32_t i = 0; i < f->parameters.count; i++) {
        const tree_type *t = f->parameters.at[i]->type;
        bool rest = t && t->collective;
        if (rest && (i + 1 < f->parameters.count || strcmp(t->name.text, "any") != 0)) {
            diagnose(&c->g->diagnostics, DIAG_E0810, t->span);
        }
    }
    check_type(c, f->result, EXPECT_VALUE);
}

static void check_entity(checker *c, const tree_entity *e)
{
    c->variables = (variables){NULL, 0};
    declare_item(c, "entity", &e->name);
    check_document(c, "entity", &e->head, &e->name);
    if (e->parent.text && !is_entity(c, e->parent.text)) {
        unknown_type(c, &e->parent);
    }
    check_types(c, &e->attributes, EXPECT_VALUE);
}

static void declare_enumeration(checker *c, const tree_enumeration *e)
{
    declare(c, c->constants, arena_format(memory(c), "enum %s", e->name.text), &e->name);
    for (uint32_t i = 0; i < e->enumerators.count; i++) {
        const tree_name *name = &e->enumerators.at[i].name;
        declare(c, c->constants, interface_constant(memory(c), e->name.text, name->text), name);
    }
}

static void check_enumeration(checker *c, const tree_enumeration *e)
{
    declare_enumeration(c, e);
    check_document(c, "enumeration", &e->head, &e->name);
}

static void check_item(checker *c, const tree_item *item)
{
    switch (item->kind) {
    case ITEM_PROCEDURE:
        check_procedure(c, item->procedure);
        break;
    case ITEM_FUNCTION:
        check_function(c, item->function);
        break;
    case ITEM_ENTITY:
        check_entity(c, item->entity);
        break;
    case ITEM_ENUMERATION:
        check_enumeration(c, item->enumeration);
        break;
    case ITEM_GRAPH:
        diagnose(&c->g->diagnostics, DIAG_E0808, item->graph->name.span, "graph");
        break;
    case ITEM_IMPORT:
        diagnose(&c->g->diagnostics, DIAG_E0808, item->import->head.span, "import");
        break;
    case ITEM_USE:
        diagnose(&c->g->diagnostics, DIAG_E0808, item->use->head.span, "use");
        break;
    }
}

/* Enumerations and entity types of what is built in: no other library declares them again. */
static void declare_known(pcgen *g, const pcgen_library *l, table *names, table *constants)
{
    for (uint32_t k = 0; k < l->files.count; k++) {
        checker c = {g, l, l->files.at[k], {NULL, 0}, names, constants};
        for (uint32_t n = 0; n < c.file->tree->items.count; n++) {
            const tree_item *item = &c.file->tree->items.at[n];
            if (item->kind == ITEM_ENUMERATION) {
                declare_enumeration(&c, item->enumeration);
            } else if (item->kind == ITEM_ENTITY) {
                declare_item(&c, "entity", &item->entity->name);
            }
        }
    }
}

void pcgen_check(pcgen *g)
{
    if (g->diagnostics.errors > 0) {
        return; /* a tree with holes would only repeat them */
    }
    table constants = {0}, known = {0};
    for (uint32_t i = 0; i < g->known.count; i++) {
        declare_known(g, g->known.at[i], &known, &constants);
    }
    for (uint32_t i = 0; i < g->libraries.count; i++) {
        table names = known;
        const pcgen_library *l = g->libraries.at[i];
        for (uint32_t k = 0; k < l->files.count; k++) {
            checker c = {g, l, l->files.at[k], {NULL, 0}, &names, &constants};
            for (uint32_t n = 0; n < l->files.at[k]->tree->items.count; n++) {
                check_item(&c, &l->files.at[k]->tree->items.at[n]);
            }
        }
    }
}

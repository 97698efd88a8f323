/* pcgen_example.c - the examples in interfaces as graphs that the tests run.
 *
 * An example of a procedure becomes a graph of its chain, whose leaf ports are its results. The
 * examples of a file's functions become one graph, in which each is the test of a `condition` that
 * a box of 4 by 3 by 2 metres reaches: `in` is that box, and each must let it pass. Attributes
 * that an example names are declared with the type of the node's attribute that they are linked
 * to, or of the value that stands beside them; so are parameters that are named by
 * `parameter = "name"`.
 */
#include "pcgen.h"

#include <string.h>

typedef struct example {
    pcgen *g;
    const pcgen_library *library;
    table attributes; /* by name: the type, as text */
    table parameters; /* the same */
} example;

/* ---- attributes ------------------------------------------------------------------------------ */

static void note_attribute(example *x, const tree_name *name, const char *type)
{
    if (name->text && (type || !table_get(&x->attributes, name->text))) {
        const char *known = type ? type : "int";
        table_put(&x->g->arena, &x->attributes, name->text, (void *)(uintptr_t)known);
    }
}

/* The type of a literal; NULL for other expressions. */
static const char *literal_type(const tree_expression *e)
{
    static const char *const units[] = {
        [UNIT_NONE] = "float",   [UNIT_METRE] = "length",  [UNIT_SQUARE_METRE] = "area",
        [UNIT_DEGREE] = "angle", [UNIT_PERCENT] = "ratio", [UNIT_SECOND] = "seconds",
    };
    switch (e->kind) {
    case EXPR_BOOL:
        return "bool";
    case EXPR_INT:
        return "int";
    case EXPR_FLOAT:
        return units[e->unit];
    case EXPR_STRING:
        return "string";
    case EXPR_COLOR:
        return "color";
    case EXPR_UNARY:
        return literal_type(e->operands.at[0]);
    default:
        return NULL;
    }
}

static void scan_expression(example *x, const tree_expression *e)
{
    if (e->kind == EXPR_ATTRIBUTE) {
        note_attribute(x, &e->name, NULL);
    }
    for (uint32_t i = 0; i < e->operands.count; i++) {
        scan_expression(x, e->operands.at[i]);
    }
}

static const tree_procedure *find_in_library(const pcgen_library *l, const char *name)
{
    for (uint32_t k = 0; k < l->files.count; k++) {
        const tree_file *tree = l->files.at[k]->tree;
        for (uint32_t n = 0; n < tree->items.count; n++) {
            const tree_item *item = &tree->items.at[n];
            if (item->kind == ITEM_PROCEDURE && strcmp(item->procedure->name.text, name) == 0) {
                return item->procedure;
            }
        }
    }
    return NULL;
}

static const tree_procedure *find_procedure(const example *x, const char *name)
{
    const tree_procedure *p = NULL;
    for (uint32_t i = 0; !p && i < x->g->libraries.count; i++) {
        p = find_in_library(x->g->libraries.at[i], name);
    }
    for (uint32_t i = 0; !p && i < x->g->known.count; i++) {
        p = find_in_library(x->g->known.at[i], name);
    }
    return p;
}

/* The declared type of a node's own attribute; NULL where the procedure has none of that name. */
static const char *attribute_type(example *x, const tree_parameters *attributes, const char *name)
{
    for (uint32_t i = 0; attributes && i < attributes->count; i++) {
        if (strcmp(attributes->at[i]->name.text, name) == 0) {
            text out = {.arena = &x->g->arena};
            lang_write_type(attributes->at[i]->type, &out);
            return out.at;
        }
    }
    return NULL;
}

static void note_parameter(example *x, const tree_argument *a, const tree_expression *next)
{
    if (a->kind == ARGUMENT_VALUE && a->name.text && strcmp(a->name.text, "parameter") == 0 &&
        a->value->kind == EXPR_STRING && !table_get(&x->parameters, a->value->string)) {
        const char *type = next ? literal_type(next) : NULL;
        table_put(&x->g->arena, &x->parameters, a->value->string,
                  (void *)(uintptr_t)(type ? type : "int"));
    }
}

static void scan_arguments(example *x, const tree_arguments *list,
                           const tree_parameters *attributes)
{
    for (uint32_t i = 0; i < list->count; i++) {
        const tree_argument *a = &list->at[i];
        const tree_expression *next = i + 1 < list->count ? list->at[i + 1].value : NULL;
        note_parameter(x, a, next);
        if (a->kind != ARGUMENT_VALUE) {
            note_attribute(x, &a->attribute, attribute_type(x, attributes, a->name.text));
        } else if (a->value->kind == EXPR_ATTRIBUTE && next) {
            note_attribute(x, &a->value->name, literal_type(next));
        } else {
            scan_expression(x, a->value);
        }
    }
}

static const tree_augment *find_augment(const tree_procedure *p, const char *kind)
{
    for (uint32_t i = 0; p && i < p->augments.count; i++) {
        if (strcmp(p->augments.at[i]->name.text, kind) == 0) {
            return p->augments.at[i];
        }
    }
    return NULL;
}

static void scan_element(example *x, const tree_element *e)
{
    const tree_procedure *p =
        e->kind == ELEMENT_NODE && e->procedure.text ? find_procedure(x, e->procedure.text) : NULL;
    scan_arguments(x, &e->arguments, p ? &p->attributes : NULL);
    for (uint32_t i = 0; e->body && i < e->body->augmentations.count; i++) {
        const tree_augmentation *a = e->body->augmentations.at[i];
        const tree_augment *g = a->kind.text ? find_augment(p, a->kind.text) : NULL;
        scan_arguments(x, &a->arguments, g ? &g->attributes : NULL);
    }
}

static void write_attributes(const example *x, text *out)
{
    for (uint32_t i = 0; i < x->parameters.entries.count; i++) {
        const table_entry *e = &x->parameters.entries.at[i];
        text_format(out, "    param %s: %s\n", e->key, (const char *)e->value);
    }
    for (uint32_t i = 0; i < x->attributes.entries.count; i++) {
        const table_entry *e = &x->attributes.entries.at[i];
        text_format(out, "    attr %s: %s\n", e->key, (const char *)e->value);
    }
}

/* ---- procedures ------------------------------------------------------------------------------ */

/* The value that is expected, as `run --json` prints it; false for what is no plain value. */
static bool write_value(text *out, const tree_expression *e, double sign)
{
    switch (e->kind) {
    case EXPR_BOOL:
        text_add(out, e->boolean ? "true" : "false");
        return true;
    case EXPR_INT:
        text_number(out, sign * (double)e->integer);
        return true;
    case EXPR_FLOAT:
        text_number(out, sign * e->number);
        return true;
    case EXPR_STRING:
        text_quote(out, e->string);
        return true;
    case EXPR_UNARY:
        return e->op == OP_NEGATE && write_value(out, e->operands.at[0], -sign);
    default:
        return false;
    }
}

/* Counts are exact; what was computed in floating point is compared as such. */
static const char *comparison_of(const char *name, const tree_expression *e)
{
    static const char *const counts[] = {"count", "faces", "vertices", "holes"};
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        if (strcmp(dot ? dot + 1 : name, counts[i]) == 0) {
            return "=";
        }
    }
    return e->kind == EXPR_BOOL || e->kind == EXPR_STRING ? "=" : "~";
}

static void write_expectations(example *x, const tree_example *e, text *out)
{
    for (uint32_t i = 0; i < e->expectations.count; i++) {
        const tree_argument *a = &e->expectations.at[i];
        const char *name = a->name.text ? a->name.text : "";
        text_format(out, "//? %s %s ", name, a->value ? comparison_of(name, a->value) : "");
        if (a->kind != ARGUMENT_VALUE || !a->name.text || !write_value(out, a->value, 1)) {
            diagnose(&x->g->diagnostics, DIAG_E0814, a->span);
        }
        text_add(out, "\n");
    }
}

static void write_use(const example *x, text *out)
{
    if (strcmp(x->library->name, "core") != 0 && strcmp(x->library->name, "geometry") != 0) {
        text_format(out, "use %s\n", x->library->name);
    }
}

static void make_procedure_example(pcgen *g, const pcgen_library *l, const tree_procedure *p,
                                    uint32_t index)
{
    const tree_example *e = p->examples.at[index];
    example x = {.g = g, .library = l};
    for (uint32_t i = 0; i < e->chains.count; i++) {
        for (uint32_t k = 0; k < e->chains.at[i]->elements.count; k++) {
            scan_element(&x, e->chains.at[i]->elements.at[k]);
        }
    }
    const char *name = arena_format(&g->arena, "%s_%s_%u", l->name, p->name.text, index + 1);
    text out = {.arena = &g->arena};
    text_format(&out, "//! Example %u of procedure '%s'.\n", index + 1, p->name.text);
    write_expectations(&x, e, &out);
    write_use(&x, &out);
    text_format(&out, "graph %s {\n", interface_field(&g->arena, name));
    write_attributes(&x, &out);
    for (uint32_t i = 0; i < e->chains.count; i++) {
        text_add(&out, "    ");
        lang_write_chain(e->chains.at[i], &out);
        text_add(&out, "\n");
    }
    text_add(&out, "}\n");
    const pcgen_example made = {name, e->chains.at[0]->span, out};
    LIST_ADD(&g->arena, &g->examples, made);
}

/* ---- functions ------------------------------------------------------------------------------- */

typedef struct function_examples {
    example x;
    text expectations, chains;
    table counts; /* of each function's examples so far, by name */
    span first;   /* of the first one */
} function_examples;

/* min_2: the node of a function's next example. */
static const char *next_node(function_examples *all, const char *function)
{
    arena *a = &all->x.g->arena;
    uint32_t *count = table_get(&all->counts, function);
    if (!count) {
        count = ARENA_NEW(a, uint32_t);
        table_put(a, &all->counts, function, count);
    }
    return arena_format(a, "%s_%u", function, ++*count);
}

static void add_function_examples(function_examples *all, const tree_function *f)
{
    for (uint32_t i = 0; i < f->examples.count; i++) {
        const tree_expression *e = f->examples.at[i];
        const char *node = next_node(all, f->name.text);
        all->first = all->first.source ? all->first : e->span;
        scan_expression(&all->x, e);
        text_format(&all->expectations, "//? %s.yes.count = 1\n", node);
        text_format(&all->chains, "    solid -> %s: condition(", node);
        lang_write_expression(e, &all->chains);
        text_add(&all->chains, ")\n");
    }
}

static void make_function_examples(pcgen *g, const pcgen_library *l, const pcgen_file *f)
{
    function_examples all = {.x = {.g = g, .library = l}};
    all.expectations.arena = all.chains.arena = &g->arena;
    for (uint32_t i = 0; i < f->tree->items.count; i++) {
        if (f->tree->items.at[i].kind == ITEM_FUNCTION) {
            add_function_examples(&all, f->tree->items.at[i].function);
        }
    }
    if (all.counts.entries.count == 0) {
        return;
    }
    const char *name = arena_format(&g->arena, "%s_%s_functions", l->name, f->name);
    text out = {.arena = &g->arena};
    text_format(&out, "//! The examples of the functions in %s.\n", f->path);
    text_add(&out, all.expectations.at);
    write_use(&all.x, &out);
    text_format(&out, "graph %s {\n", interface_field(&g->arena, name));
    write_attributes(&all.x, &out);
    text_add(&out, "    rectangle(width = 4m, height = 3m) -> solid: extrude(amount = 2m)\n");
    text_add(&out, all.chains.at);
    text_add(&out, "}\n");
    const pcgen_example made = {name, all.first, out};
    LIST_ADD(&g->arena, &g->examples, made);
}

void pcgen_write_examples(pcgen *g)
{
    for (uint32_t i = 0; i < g->examples.count; i++) {
        const pcgen_example *e = &g->examples.at[i];
        pcgen_write_file(g, arena_format(&g->arena, "examples/%s.pcg", e->name), &e->graph);
    }
}

void pcgen_make_examples(pcgen *g)
{
    for (uint32_t i = 0; i < g->libraries.count; i++) {
        const pcgen_library *l = g->libraries.at[i];
        for (uint32_t k = 0; k < l->files.count; k++) {
            const tree_file *tree = l->files.at[k]->tree;
            for (uint32_t n = 0; n < tree->items.count; n++) {
                const tree_item *item = &tree->items.at[n];
                uint32_t count = item->kind == ITEM_PROCEDURE ? item->procedure->examples.count : 0;
                for (uint32_t e = 0; e < count; e++) {
                    make_procedure_example(g, l, item->procedure, e);
                }
            }
            make_function_examples(g, l, l->files.at[k]);
        }
    }
}

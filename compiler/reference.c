/* reference.c - reading the interfaces of all libraries, and finding an entry among them. */
#include "library.h"
#include "reference.h"

#include <stdlib.h>
#include <string.h>

/* ---- reading --------------------------------------------------------------------------------- */

static void describe(reference *r, reference_item *item, const char *document)
{
    const char *gap = document ? strstr(document, "\n\n") : NULL;
    size_t length = document ? gap ? (size_t)(gap - document) : strlen(document) : 0;
    const char *first = arena_copy(r->arena, document ? document : "", length);
    item->summary = reference_line(r->arena, first);
    item->details = gap ? gap + strspn(gap, "\n") : NULL;
}

static reference_item *add_item(reference *r, const pcg_library *l, const library_file *f,
                                const tree_head *head)
{
    uint32_t line, column;
    reference_item *item = ARENA_NEW(r->arena, reference_item);
    source_place(head->span.source, head->span.from, &line, &column);
    item->library = l;
    item->path = f->path;
    item->line = f->line + line - 1;
    describe(r, item, head->document);
    LIST_ADD(r->arena, &r->items, item);
    return item;
}

/* math, of core/math.c */
static const char *file_name(arena *a, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    return arena_copy(a, name, strcspn(name, "."));
}

/* The entry that holds the other overloads of a function in the library, or NULL. */
static reference_item *find_overloads(reference *r, const pcg_library *l, const char *name)
{
    for (uint32_t i = 0; i < r->items.count; i++) {
        const reference_item *item = r->items.at[i];
        if (item->library == l && item->kind == ENTRY_FUNCTION && !strcmp(item->name, name))
            return (reference_item *)(uintptr_t)item; /* the list is const to its readers only */
    }
    return NULL;
}

static void read_function(reference *r, const pcg_library *l, const library_file *f,
                          const tree_function *overload)
{
    reference_item *item = find_overloads(r, l, overload->name.text);
    if (!item) {
        item = add_item(r, l, f, &overload->head);
        item->kind = ENTRY_FUNCTION;
        item->name = overload->name.text;
        item->group = file_name(r->arena, f->path);
    }
    LIST_ADD(r->arena, &item->functions, overload);
}

static void read_item(reference *r, const pcg_library *l, const library_file *f, const tree_item *i)
{
    reference_item *item;
    switch (i->kind) {
    case ITEM_PROCEDURE:
        item = add_item(r, l, f, &i->procedure->head);
        item->kind = ENTRY_PROCEDURE;
        item->name = i->procedure->name.text;
        item->group = i->procedure->category.text ? i->procedure->category.text : "other";
        item->procedure = i->procedure;
        break;
    case ITEM_FUNCTION:
        read_function(r, l, f, i->function);
        break;
    case ITEM_ENTITY:
        if (!i->entity->head.document)
            break; /* the compiler's own word for one that a library explains */
        item = add_item(r, l, f, &i->entity->head);
        item->kind = ENTRY_ENTITY;
        item->name = i->entity->name.text;
        item->group = "types";
        item->entity = i->entity;
        break;
    case ITEM_ENUMERATION:
        item = add_item(r, l, f, &i->enumeration->head);
        item->kind = ENTRY_ENUMERATION;
        item->name = i->enumeration->name.text;
        item->group = "types";
        item->enumeration = i->enumeration;
        break;
    case ITEM_GRAPH:
    case ITEM_IMPORT:
    case ITEM_USE:
        break; /* interfaces hold none */
    }
}

static int compare_items(const void *a, const void *b)
{
    const reference_item *x = *(const reference_item *const *)a;
    const reference_item *y = *(const reference_item *const *)b;
    int order = strcmp(x->library->name, y->library->name);
    if (order == 0)
        order = (x->kind > y->kind) - (x->kind < y->kind);
    if (order == 0)
        order = strcmp(x->group, y->group);
    return order ? order : strcmp(x->name, y->name);
}

static void read_file(reference *r, const pcg_library *l, const library_file *f)
{
    diagnostics errors = {.arena = r->arena}; /* none: the build has checked these texts */
    const source *s = source_new(r->arena, f->path, f->text, strlen(f->text));
    const tree_file *tree = lang_parse(r->arena, s, &errors);
    for (uint32_t i = 0; i < tree->items.count; i++)
        read_item(r, l, f, &tree->items.at[i]);
}

void reference_begin(reference *r, arena *a)
{
    r->arena = a;
    for (const pcg_library *const *l = library_builtin; *l; l++)
        reference_add(r, *l);
}

void reference_add(reference *r, const pcg_library *l)
{
    LIST_ADD(r->arena, &r->libraries, l);
}

void reference_read(reference *r)
{
    for (uint32_t k = 0; k < r->libraries.count; k++) {
        const pcg_library *l = r->libraries.at[k];
        for (uint32_t i = 0; i < l->file_count; i++)
            read_file(r, l, &l->files[i]);
        for (uint32_t i = 0; i < library_surrogates.file_count; i++)
            if (!strcmp(l->name, library_surrogates.name))
                read_file(r, l, &library_surrogates.files[i]);
    }
    if (r->items.count)
        qsort(r->items.at, r->items.count, sizeof r->items.at[0], compare_items);
}

bool reference_has_library(const reference *r, const char *name)
{
    for (uint32_t i = 0; i < r->libraries.count; i++)
        if (!strcmp(r->libraries.at[i]->name, name))
            return true;
    return false;
}

/* ---- finding --------------------------------------------------------------------------------- */

static bool has_former_name(const reference_item *item, const char *name)
{
    const tree_procedure *p = item->procedure;
    for (uint32_t i = 0; p && i < p->former.count; i++)
        if (!strcmp(p->former.at[i].text, name))
            return true;
    return false;
}

reference_items reference_find(const reference *r, const char *name)
{
    reference_items found = {NULL, 0, 0};
    const char *dot = strchr(name, '.');
    for (uint32_t i = 0; i < r->items.count; i++) {
        const reference_item *item = r->items.at[i];
        const char *library = item->library->name;
        size_t length = strlen(library);
        bool qualified = dot && (size_t)(dot - name) == length && !memcmp(name, library, length);
        const char *wanted = qualified ? dot + 1 : name;
        if (!strcmp(item->name, wanted) || has_former_name(item, wanted))
            LIST_ADD(r->arena, &found, item);
    }
    return found;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Whether `word` (of `length`) occurs in `in`, capitals or not. */
static bool occurs(const char *in, const char *word, size_t length)
{
    for (; *in; in++) {
        size_t i = 0;
        while (i < length && in[i] && lower(in[i]) == lower(word[i]))
            i++;
        if (i == length)
            return true;
    }
    return false;
}

enum { RANK_NONE, RANK_SUMMARY, RANK_GROUP, RANK_SYNONYM, RANK_NAME, RANK_EXACT };

static int rank_word(const reference_item *item, const char *word, size_t length)
{
    if (strlen(item->name) == length && occurs(item->name, word, length))
        return RANK_EXACT;
    if (occurs(item->name, word, length))
        return RANK_NAME;
    const tree_procedure *p = item->procedure;
    for (uint32_t i = 0; p && i < p->synonyms.count; i++)
        if (occurs(p->synonyms.at[i].text, word, length))
            return RANK_SYNONYM;
    if (occurs(item->group, word, length))
        return RANK_GROUP;
    return occurs(item->summary, word, length) ? RANK_SUMMARY : RANK_NONE;
}

/* The rank of the word that fits worst. */
static int rank_words(const reference_item *item, const char *words)
{
    int rank = RANK_EXACT;
    for (words += strspn(words, " "); *words; words += strspn(words, " ")) {
        size_t length = strcspn(words, " ");
        int of_word = rank_word(item, words, length);
        rank = of_word < rank ? of_word : rank;
        words += length;
    }
    return rank;
}

reference_items reference_search(const reference *r, const char *words)
{
    reference_items found = {NULL, 0, 0};
    for (int rank = RANK_EXACT; rank > RANK_NONE; rank--)
        for (uint32_t i = 0; i < r->items.count; i++)
            if (rank_words(r->items.at[i], words) == rank)
                LIST_ADD(r->arena, &found, r->items.at[i]);
    return found;
}

const char *reference_nearest(const reference *r, const char *word)
{
    LIST(const char *) candidates = {NULL, 0, 0};
    for (uint32_t i = 0; i < r->libraries.count; i++)
        LIST_ADD(r->arena, &candidates, r->libraries.at[i]->name);
    for (uint32_t i = 0; i < r->items.count; i++) {
        const tree_procedure *p = r->items.at[i]->procedure;
        LIST_ADD(r->arena, &candidates, r->items.at[i]->name);
        for (uint32_t k = 0; p && k < p->synonyms.count; k++)
            LIST_ADD(r->arena, &candidates, p->synonyms.at[k].text);
    }
    return nearest_name(word, candidates.at, candidates.count);
}

const char *reference_kind(const reference_item *item)
{
    static const char *const kinds[] = {[ENTRY_PROCEDURE] = "procedure",
                                        [ENTRY_FUNCTION] = "function",
                                        [ENTRY_ENTITY] = "entity",
                                        [ENTRY_ENUMERATION] = "enum"};
    return kinds[item->kind];
}

/* ---- parts ----------------------------------------------------------------------------------- */

const char *reference_line(arena *a, const char *document)
{
    text out = {.arena = a};
    text_add(&out, "");
    for (const char *at = document ? document : ""; *at; at++)
        text_add_bytes(&out, *at == '\n' ? " " : at, 1);
    while (out.length && out.at[out.length - 1] == ' ')
        out.at[--out.length] = '\0';
    return out.at ? out.at : "";
}

static void write_variables(const tree_variable *at, uint32_t count, text *out)
{
    for (uint32_t i = 0; i < count; i++) {
        text_format(out, "%s%s", i ? ", " : "<", at[i].name.text);
        if (at[i].bound.text)
            text_format(out, ": %s", at[i].bound.text);
    }
    text_add(out, count ? ">" : "");
}

static void write_gates(const tree_gates *gates, text *out)
{
    text_add(out, "(");
    for (uint32_t i = 0; i < gates->count; i++) {
        text_format(out, "%s%s: ", i ? ", " : "", gates->at[i]->name.text);
        lang_write_type(gates->at[i]->type, out);
    }
    text_add(out, ")");
}

static void write_parameters(const tree_parameters *list, text *out)
{
    for (uint32_t i = 0; i < list->count; i++) {
        const tree_parameter *p = list->at[i];
        text_format(out, "%s%s: ", i ? ", " : "", p->name.text);
        lang_write_type(p->type, out);
        if (p->initial) {
            text_add(out, " = ");
            lang_write_expression(p->initial, out);
        }
    }
}

void reference_write_procedure_head(const tree_procedure *p, text *out)
{
    text_add(out, p->name.text);
    write_variables(p->variables.at, p->variables.count, out);
    write_gates(&p->inputs, out);
    if (p->outputs.count) {
        text_add(out, " -> ");
        write_gates(&p->outputs, out);
    }
}

void reference_write_function_head(const tree_function *f, text *out)
{
    text_add(out, f->name.text);
    write_variables(f->variables.at, f->variables.count, out);
    text_add(out, "(");
    write_parameters(&f->parameters, out);
    text_add(out, ") -> ");
    lang_write_type(f->result, out);
}

void reference_write_augment_head(const tree_augment *g, text *out)
{
    text_format(out, "%s(", g->name.text);
    write_parameters(&g->parameters, out);
    for (uint32_t i = 0; i < g->attributes.count; i++) {
        text_format(out, "%sattr %s: ", i || g->parameters.count ? ", " : "",
                    g->attributes.at[i]->name.text);
        lang_write_type(g->attributes.at[i]->type, out);
    }
    text_add(out, ")");
    if (g->output) {
        text_add(out, " -> ");
        lang_write_type(g->output, out);
    }
    if (g->input) {
        text_add(out, " <- ");
        lang_write_type(g->input, out);
    }
}

const char *reference_overload_document(const reference_item *item, uint32_t i)
{
    const char *document = item->functions.at[i]->head.document;
    const char *before = i ? item->functions.at[i - 1]->head.document : document;
    bool same = document == before || (document && before && !strcmp(document, before));
    return same ? NULL : document;
}

static void write_operands(const tree_expressions *list, text *out)
{
    for (uint32_t i = 0; i < list->count; i++) {
        text_add(out, i ? ", " : "");
        lang_write_expression(list->at[i], out);
    }
}

void reference_write_constraints(const tree_parameter *p, text *out)
{
    static const char *const before[] = {[CONSTRAINT_RANGE] = "range [",
                                         [CONSTRAINT_ONE_OF] = "one of (",
                                         [CONSTRAINT_MATCHES] = "matches ",
                                         [CONSTRAINT_AT_MOST] = "at most "};
    static const char *const behind[] = {[CONSTRAINT_RANGE] = "]",
                                         [CONSTRAINT_ONE_OF] = ")",
                                         [CONSTRAINT_MATCHES] = "",
                                         [CONSTRAINT_AT_MOST] = " characters"};
    for (uint32_t i = 0; i < p->constraints.count; i++) {
        const tree_constraint *c = &p->constraints.at[i];
        text_add(out, i ? ", " : "");
        text_add(out, before[c->kind]);
        write_operands(&c->operands, out);
        text_add(out, behind[c->kind]);
    }
}

void reference_write_names(const tree_names *list, const char *separator, text *out)
{
    for (uint32_t i = 0; i < list->count; i++)
        text_format(out, "%s%s", i ? separator : "", list->at[i].text);
}

void reference_write_chains(const tree_example *e, const char *between, text *out)
{
    for (uint32_t i = 0; i < e->chains.count; i++) {
        text_add(out, i ? between : "");
        lang_write_chain(e->chains.at[i], out);
    }
}

void reference_write_expectations(const tree_example *e, text *out)
{
    for (uint32_t i = 0; i < e->expectations.count; i++) {
        const tree_argument *a = &e->expectations.at[i];
        text_format(out, "%s%s = ", i ? ", " : "", a->name.text ? a->name.text : "");
        lang_write_expression(a->value, out);
    }
}

const tree_enumeration *reference_enumeration(const reference *r, const tree_type *t)
{
    for (; t && t->element; t = t->element)
        ;
    for (uint32_t i = 0; t && t->name.text && i < r->items.count; i++)
        if (r->items.at[i]->enumeration && !strcmp(r->items.at[i]->name, t->name.text))
            return r->items.at[i]->enumeration;
    return NULL;
}

/* library.c - the libraries in scope and what their interfaces declare, understood on first use.
 *
 * A library carries its interfaces as text with an index of names. What a program names is parsed
 * then, once, and kept in `program.interfaces`; a suggestion needs the index only. */
#include "library.h"

#include <string.h>

struct interfaces {
    table files;        /* tree_file, by library and path */
    table procedures;   /* by library.name */
    table functions;    /* the first overload of all libraries, by name */
    table enumerations; /* by name: they are unique over all libraries */
    table entities;
    table used; /* what the program's lists hold */
};

typedef struct reader { /* an interface that is being understood */
    compilation *c;
    program *p;
    const pcg_library *library;
    const tree_variable *variables;
    uint32_t variable_count;
    bool erases_variables; /* a function's parameter takes whatever its variable's bound does */
} reader;

/* ---- the compiler's own part of core ------------------------------------------------------- */

static const library_file own_files[] = {
    {"core/surrogates", 1,
     "/// Runs the graph or procedure of that name.\n"
     "///\n"
     "/// Its braces declare the interface that it expects, in the syntax of a graph's own: `in`,\n"
     "/// `out`, `param`, `attr`; `out rest: Shape = *` takes what has no port of its own.\n"
     "procedure dynamic() {\n"
     "    category \"dynamic\"\n"
     "    param graph: string /// Its name, or the path of its file.\n"
     "}\n"
     "/// Runs a graph several times, what leaves it entering again where a loop says so.\n"
     "procedure iterate() {\n"
     "    category \"dynamic\"\n"
     "    param graph: string = \"\" /// As of dynamic.\n"
     "    param times: int = 1 /// How often.\n"
     "    param index: string = \"\" /// The graph's parameter that gets the number of the time.\n"
     "}\n"
     "/// Runs a graph for several entities side by side, in threads; what comes out is in the same order,\n"
     "/// and the same, as without. A graph whose executions may know of each other runs one by one.\n"
     "procedure parallel() {\n"
     "    category \"dynamic\"\n"
     "    param graph: string = \"\" /// As of dynamic.\n"
     "    param threads: int = 0 /// How many; 0: as many as the machine has processors.\n"
     "}\n"
     "/// Runs a graph, unless it is known what it gives: for the same text, parameters, entities, files\n"
     "/// and, where it draws by chance, seed, what it gave before is taken.\n"
     "procedure cache() {\n"
     "    category \"dynamic\"\n"
     "    param graph: string = \"\" /// As of dynamic.\n"
     "    param where: CachePlace = memory /// Where it is kept.\n"
     "}\n"
     "/// Measures a graph: time, rounds, entities in and out, parameters.\n"
     "procedure profile() {\n"
     "    category \"dynamic\"\n"
     "    param graph: string = \"\" /// As of dynamic.\n"
     "}\n"
     "/// Where a cache keeps what it was given.\n"
     "enum CachePlace { memory, disk }\n"
     "entity Shape: Entity\n"
     "entity Impulse: Entity\n"}};

static const library_entry own_entries[] = {
    {"CachePlace", ENTRY_ENUMERATION, 0, NULL}, {"Impulse", ENTRY_ENTITY, 0, NULL},
    {"Shape", ENTRY_ENTITY, 0, NULL},           {"cache", ENTRY_PROCEDURE, 0, NULL},
    {"dynamic", ENTRY_PROCEDURE, 0, NULL},      {"iterate", ENTRY_PROCEDURE, 0, NULL},
    {"parallel", ENTRY_PROCEDURE, 0, NULL},     {"profile", ENTRY_PROCEDURE, 0, NULL}};

const pcg_library library_surrogates = {.abi = PCG_ABI,
                                        .size = sizeof(pcg_library),
                                        .name = "core",
                                        .document = "",
                                        .files = own_files,
                                        .entries = own_entries,
                                        .file_count = COUNT_OF(own_files),
                                        .entry_count = COUNT_OF(own_entries)};

static const entity_type root = {.name = "Entity", .library = "core"};

bool library_is_surrogate(const procedure *f)
{
    return f->library == &library_surrogates;
}

void library_begin(compilation *c, program *p)
{
    p->interfaces = ARENA_NEW(&c->arena, struct interfaces);
    for (uint32_t i = 0; library_builtin[i]; i++)
        LIST_ADD(&c->arena, &p->libraries, library_builtin[i]);
    for (uint32_t i = 0; c->libraries && c->libraries[i]; i++)
        LIST_ADD(&c->arena, &p->libraries, c->libraries[i]);
    LIST_ADD(&c->arena, &p->libraries, &library_surrogates);
    p->common_libraries = p->libraries.count;
}

bool library_is_builtin(const pcg_library *l)
{
    for (uint32_t i = 0; library_builtin[i]; i++)
        if (library_builtin[i] == l)
            return true;
    return l == &library_surrogates;
}

bool library_is_visible(const program *p, const pcg_library *l)
{
    const unit *u = p->scope;
    for (uint32_t i = 0; u && i < u->libraries.entries.count; i++)
        if (u->libraries.entries.at[i].value == l)
            return true;
    for (uint32_t i = p->common_libraries; u && i < p->libraries.count; i++)
        if (p->libraries.at[i] == l)
            return false;
    return true;
}

/* ---- looking names up ---------------------------------------------------------------------- */

static bool is_called(const pcg_library *l, const char *name)
{
    return !name || !strcmp(l->name, name);
}

/* It has that name (NULL: any), and is in scope. */
static bool is_meant(const program *p, const pcg_library *l, const char *name)
{
    return is_called(l, name) && library_is_visible(p, l);
}

const pcg_library *library_named(const program *p, const char *name)
{
    for (uint32_t i = 0; i < p->libraries.count; i++)
        if (is_meant(p, p->libraries.at[i], name))
            return p->libraries.at[i];
    return NULL;
}

uint32_t library_count(const program *p, const char *library, const char *name,
                       library_entry_kind kind, const pcg_library *found[2])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->libraries.count; i++) {
        const pcg_library *l = p->libraries.at[i];
        if (!is_meant(p, l, library) || !library_find(l, name, kind))
            continue;
        if (count < 2)
            found[count] = l;
        count++;
    }
    return count;
}

static const library_entry *find_entry(const program *p, const char *library, const char *name,
                                       library_entry_kind kind, const pcg_library **found)
{
    for (uint32_t i = 0; i < p->libraries.count; i++) {
        const library_entry *e = is_meant(p, p->libraries.at[i], library)
                                     ? library_find(p->libraries.at[i], name, kind)
                                     : NULL;
        if (e) {
            *found = p->libraries.at[i];
            return e;
        }
    }
    return NULL;
}

/* An interface's tree. Empty lines before the text give its lines the numbers that they have in the
 * kernel's file. */
static tree_file *read_interface(reader *r, uint32_t file)
{
    const library_file *f = &r->library->files[file];
    arena *a = &r->c->arena;
    table *files = &r->p->interfaces->files;
    const char *key = arena_format(a, "%s:%s", r->library->name, f->path);
    tree_file *tree = table_get(files, key);
    if (tree)
        return tree;
    text padded = {.arena = a};
    for (uint32_t i = 1; i < f->line; i++)
        text_add(&padded, "\n");
    text_add(&padded, f->text);
    tree = lang_parse(a, source_new(a, f->path, padded.at, padded.length), &r->c->diagnostics);
    table_put(a, files, key, tree);
    return tree;
}

/* ---- types --------------------------------------------------------------------------------- */

static bool find_type(compilation *c, program *p, const char *name, type *t)
{
    if (type_of_word(name, t))
        return true;
    const enumeration *e = find_enumeration(c, p, name);
    if (e) {
        *t = (type){.kind = TYPE_VALUE, .value = PCG_ENUM, .enumeration = e};
        return true;
    }
    const entity_type *entity = find_entity_type(c, p, name);
    if (entity)
        *t = type_of_entity(entity);
    return entity != NULL;
}

static const char *suggest_type(compilation *c, const program *p, const char *name)
{
    static const char *const words[] = {"bool", "int",   "float", "string",     "vec2",  "vec3",
                                        "vec4", "color", "path",  "quaternion", "list",  "length",
                                        "area", "angle", "ratio", "seconds",    "Entity"};
    names candidates = {0};
    if (!suggestions_wanted(c))
        return NULL;
    for (size_t i = 0; i < COUNT_OF(words); i++)
        LIST_ADD(&c->arena, &candidates, words[i]);
    library_add_names(p, &c->arena, NULL, ENTRY_ENUMERATION, &candidates);
    library_add_names(p, &c->arena, NULL, ENTRY_ENTITY, &candidates);
    return did_you_mean(c, name, &candidates);
}

static type unknown_type(compilation *c, const program *p, const tree_name *name)
{
    diagnose(&c->diagnostics, DIAG_E0105, name->span, name->text)->text =
        suggest_type(c, p, name->text);
    return type_error;
}

/* A list's elements are values, and lists do not nest: an element takes a fixed number of cells. */
static type list_type(compilation *c, program *p, const tree_type *tree)
{
    type *element = ARENA_NEW(&c->arena, type);
    *element = library_type(c, p, tree->element);
    if (type_is_error(element))
        return type_error;
    if (element->kind != TYPE_VALUE || element->value == PCG_LIST) {
        diagnose(&c->diagnostics, DIAG_E0120, tree->element->span, type_text(&c->arena, element));
        return type_error;
    }
    return (type){.kind = TYPE_VALUE, .value = PCG_LIST, .element = element};
}

type library_type(compilation *c, program *p, const tree_type *tree)
{
    type t;
    if (tree->element && !strcmp(tree->name.text, "list"))
        return list_type(c, p, tree);
    if (tree->element) /* which the parser reported */
        return type_error;
    return find_type(c, p, tree->name.text, &t) ? t : unknown_type(c, p, &tree->name);
}

/* A type variable's bound: Entity where none is written. */
static const char *bound_of(const tree_variable *v)
{
    return v->bound.text ? v->bound.text : root.name;
}

/* A type variable knows its bound. */
static type interface_type(reader *r, const tree_type *tree)
{
    for (uint32_t i = 0; !tree->element && i < r->variable_count; i++) {
        if (strcmp(r->variables[i].name.text, tree->name.text) != 0)
            continue;
        type bound;
        if (!find_type(r->c, r->p, bound_of(&r->variables[i]), &bound))
            return unknown_type(r->c, r->p, &r->variables[i].bound);
        if (!r->erases_variables) {
            bound.kind = TYPE_VARIABLE;
            bound.variable = i;
        }
        return bound;
    }
    return library_type(r->c, r->p, tree);
}

/* Whether a library of that name is in scope. */
static bool is_in_scope(const program *p, const char *library)
{
    return library_named(p, library) != NULL;
}

const enumeration *find_enumeration(compilation *c, program *p, const char *name)
{
    enumeration *e = table_get(&p->interfaces->enumerations, name);
    if (e)
        return is_in_scope(p, e->library) ? e : NULL;
    reader r = {.c = c, .p = p};
    const library_entry *entry = find_entry(p, NULL, name, ENTRY_ENUMERATION, &r.library);
    const tree_file *f = entry ? read_interface(&r, entry->file) : NULL;
    for (uint32_t i = 0; f && i < f->items.count; i++) {
        const tree_item *item = &f->items.at[i];
        if (item->kind != ITEM_ENUMERATION || strcmp(item->enumeration->name.text, name) != 0)
            continue;
        e = ARENA_NEW(&c->arena, enumeration);
        *e = (enumeration){.name = item->enumeration->name.text,
                           .library = r.library->name,
                           .tree = item->enumeration,
                           .count = item->enumeration->enumerators.count};
        e->names = ARENA_ARRAY(&c->arena, const char *, e->count);
        for (uint32_t k = 0; k < e->count; k++)
            e->names[k] = item->enumeration->enumerators.at[k].name.text;
        table_put(&c->arena, &p->interfaces->enumerations, e->name, e);
        LIST_ADD(&c->arena, &p->enumerations, e);
        return e;
    }
    return NULL;
}

/* Its entry in the table comes before its parent's, so that a cycle of parents is seen; such a type
 * derives from Entity. */
static entity_type *make_entity(reader *r, const tree_entity *tree)
{
    entity_type *e = ARENA_NEW(&r->c->arena, entity_type);
    e->name = tree->name.text;
    e->library = r->library->name;
    table_put(&r->c->arena, &r->p->interfaces->entities, e->name, e);
    const entity_type *parent = find_entity_type(r->c, r->p, tree->parent.text);
    if (!parent)
        unknown_type(r->c, r->p, &tree->parent);
    else if (entity_derives(parent, e))
        diagnose(&r->c->diagnostics, DIAG_E0121, tree->parent.span, e->name);
    e->parent = parent && !entity_derives(parent, e) ? parent : &root;
    LIST_ADD(&r->c->arena, &r->p->entities, e);
    return e;
}

/* What an interface names is in scope there, whatever the file that is looked at uses. */
static const unit *leave_scope(program *p)
{
    const unit *u = p->scope;
    p->scope = NULL;
    return u;
}

static entity_type *read_entity(reader *r, const tree_entity *tree)
{
    const unit *scope = leave_scope(r->p);
    entity_type *e = make_entity(r, tree);
    r->p->scope = scope;
    return e;
}

const entity_type *find_entity_type(compilation *c, program *p, const char *name)
{
    if (!strcmp(name, root.name))
        return &root;
    entity_type *e = table_get(&p->interfaces->entities, name);
    if (e)
        return is_in_scope(p, e->library) ? e : NULL;
    reader r = {.c = c, .p = p};
    const library_entry *entry = find_entry(p, NULL, name, ENTRY_ENTITY, &r.library);
    const tree_file *f = entry ? read_interface(&r, entry->file) : NULL;
    for (uint32_t i = 0; f && i < f->items.count; i++)
        if (f->items.at[i].kind == ITEM_ENTITY && !strcmp(f->items.at[i].entity->name.text, name))
            return read_entity(&r, f->items.at[i].entity);
    return NULL;
}

/* ---- procedures ---------------------------------------------------------------------------- */

static formal *read_formals(reader *r, const tree_parameters *trees)
{
    formal *formals = ARENA_ARRAY(&r->c->arena, formal, trees->count);
    for (uint32_t i = 0; i < trees->count; i++) {
        const tree_parameter *t = trees->at[i];
        formals[i] = (formal){.name = t->name.text,
                              .tree = t,
                              .type = t->type ? interface_type(r, t->type) : type_error,
                              .collective = t->type && t->type->collective};
    }
    return formals;
}

static formal_port read_port(reader *r, const char *name, const tree_type *tree)
{
    return (formal_port){.name = name,
                         .type = interface_type(r, tree),
                         .collective = tree->collective,
                         .optional = tree->optional};
}

static formal_port *read_ports(reader *r, const tree_gates *trees)
{
    formal_port *ports = ARENA_ARRAY(&r->c->arena, formal_port, trees->count);
    for (uint32_t i = 0; i < trees->count; i++) {
        ports[i] = read_port(r, trees->at[i]->name.text, trees->at[i]->type);
        ports[i].tree = trees->at[i];
    }
    return ports;
}

static void read_augment(reader *r, const tree_augment *t, augment *a)
{
    a->name = t->name.text;
    a->tree = t;
    a->parameters = read_formals(r, &t->parameters);
    a->parameter_count = t->parameters.count;
    a->attributes = read_formals(r, &t->attributes);
    a->attribute_count = t->attributes.count;
    a->has_output = t->output != NULL;
    if (t->output)
        a->output = read_port(r, a->name, t->output);
    a->has_input = t->input != NULL;
    if (t->input)
        a->input = read_port(r, a->name, t->input);
}

static uint32_t read_traits(const tree_names *traits)
{
    static const struct {
        const char *name;
        uint32_t flag;
    } known[] = {
        {"pure", TRAIT_PURE},     {"stateful", TRAIT_STATEFUL},
        {"effect", TRAIT_EFFECT}, {"one_to_one", TRAIT_ONE_TO_ONE},
        {"random", TRAIT_RANDOM}, {"reflects", TRAIT_REFLECTS},
        {"reads", TRAIT_READS},
    };
    uint32_t flags = 0;
    for (uint32_t i = 0; i < traits->count; i++)
        for (size_t k = 0; k < COUNT_OF(known); k++)
            if (!strcmp(traits->at[i].text, known[k].name))
                flags |= known[k].flag;
    return flags;
}

static void read_bounds(reader *r, procedure *f)
{
    f->variable_count = r->variable_count;
    f->bounds = ARENA_ARRAY(&r->c->arena, const entity_type *, r->variable_count);
    for (uint32_t i = 0; i < r->variable_count; i++) {
        f->bounds[i] = find_entity_type(r->c, r->p, bound_of(&r->variables[i]));
        if (!f->bounds[i]) {
            unknown_type(r->c, r->p, &r->variables[i].bound);
            f->bounds[i] = &root;
        }
    }
}

static procedure *make_procedure(reader *r, const tree_procedure *t)
{
    procedure *f = ARENA_NEW(&r->c->arena, procedure);
    r->variables = t->variables.at;
    r->variable_count = t->variables.count;
    *f = (procedure){.name = t->name.text,
                     .library = r->library,
                     .symbol =
                         interface_procedure_symbol(&r->c->arena, r->library->name, t->name.text),
                     .tree = t,
                     .inputs = read_ports(r, &t->inputs),
                     .input_count = t->inputs.count,
                     .outputs = read_ports(r, &t->outputs),
                     .output_count = t->outputs.count,
                     .parameters = read_formals(r, &t->parameters),
                     .parameter_count = t->parameters.count,
                     .attributes = read_formals(r, &t->attributes),
                     .attribute_count = t->attributes.count,
                     .augment_count = t->augments.count,
                     .traits = read_traits(&t->traits)};
    read_bounds(r, f);
    f->augments = ARENA_ARRAY(&r->c->arena, augment, f->augment_count);
    for (uint32_t i = 0; i < f->augment_count; i++) {
        f->augments[i].kind = i;
        read_augment(r, t->augments.at[i], &f->augments[i]);
    }
    for (uint32_t i = 0; i < f->input_count; i++)
        f->collective |= f->inputs[i].collective;
    for (uint32_t i = 0; i < f->augment_count; i++)
        f->collective |= f->augments[i].has_input && f->augments[i].input.collective;
    return f;
}

const procedure *library_procedure(compilation *c, program *p, const char *library,
                                   const char *name)
{
    reader r = {.c = c, .p = p};
    const library_entry *entry = find_entry(p, library, name, ENTRY_PROCEDURE, &r.library);
    if (!entry)
        return NULL;
    if (entry->former_of)
        name = entry->former_of;
    const char *key = arena_format(&c->arena, "%s.%s", r.library->name, name);
    const procedure *f = table_get(&p->interfaces->procedures, key);
    if (f)
        return f;
    const tree_file *file = read_interface(&r, entry->file);
    for (uint32_t i = 0; i < file->items.count; i++) {
        const tree_item *item = &file->items.at[i];
        if (item->kind != ITEM_PROCEDURE || strcmp(item->procedure->name.text, name) != 0)
            continue;
        const unit *scope = leave_scope(p);
        procedure *made = make_procedure(&r, item->procedure);
        p->scope = scope;
        table_put(&c->arena, &p->interfaces->procedures, key, made);
        return made;
    }
    return NULL;
}

const procedure *find_procedure(compilation *c, program *p, const char *library, const char *name)
{
    const procedure *f = library_procedure(c, p, library, name);
    if (!f || library_is_surrogate(f) || table_get(&p->interfaces->used, f->symbol))
        return f;
    table_put(&c->arena, &p->interfaces->used, f->symbol, (void *)(uintptr_t)f);
    LIST_ADD(&c->arena, &p->procedures, f);
    return f;
}

static bool is_free_to_call(const procedure *f)
{
    for (uint32_t i = 0; i < f->parameter_count; i++)
        if (!f->parameters[i].tree->initial)
            return false;
    return f->input_count == 1 && f->variable_count == 0;
}

static bool makes(const procedure *f, const entity_type *from, const entity_type *to)
{
    const type *in = &f->inputs[0].type;
    if (in->kind != TYPE_ENTITY || !entity_derives(from, in->entity))
        return false;
    for (uint32_t i = 0; i < f->output_count; i++) {
        const type *out = &f->outputs[i].type;
        if (out->kind == TYPE_ENTITY && entity_derives(out->entity, to))
            return true;
    }
    return false;
}

const procedure *library_converter(compilation *c, program *p, const entity_type *from,
                                   const entity_type *to)
{
    for (uint32_t i = 0; i < p->libraries.count; i++) {
        const pcg_library *l = p->libraries.at[i];
        for (uint32_t k = 0; k < l->entry_count; k++) {
            const library_entry *e = &l->entries[k];
            if (e->kind != ENTRY_PROCEDURE || e->former_of)
                continue;
            const procedure *f = library_procedure(c, p, l->name, e->name);
            if (f && is_free_to_call(f) && makes(f, from, to))
                return f;
        }
    }
    return NULL;
}

/* ---- functions ----------------------------------------------------------------------------- */

static function *make_function(reader *r, const tree_function *t)
{
    function *f = ARENA_NEW(&r->c->arena, function);
    r->variables = t->variables.at;
    r->variable_count = t->variables.count;
    f->name = t->name.text;
    f->library = r->library;
    f->symbol = interface_function_symbol(&r->c->arena, r->library->name, t);
    f->tree = t;
    f->parameters = read_formals(r, &t->parameters);
    f->parameter_count = t->parameters.count;
    f->result = interface_type(r, t->result);
    f->traits = read_traits(&t->traits);
    return f;
}

/* Adds the overloads that one file declares behind `last`; returns the new last one. */
static function **read_overloads(reader *r, uint32_t file, const char *name, function **end)
{
    const tree_file *f = read_interface(r, file);
    for (uint32_t i = 0; i < f->items.count; i++) {
        const tree_item *item = &f->items.at[i];
        if (item->kind != ITEM_FUNCTION || strcmp(item->function->name.text, name) != 0)
            continue;
        *end = make_function(r, item->function);
        end = &(*end)->next;
    }
    return end;
}

/* The overloads of all libraries, in their order. */
static function *read_functions(compilation *c, program *p, const char *name)
{
    function *first = NULL, **end = &first;
    for (uint32_t i = 0; i < p->libraries.count; i++) {
        reader r = {.c = c, .p = p, .library = p->libraries.at[i], .erases_variables = true};
        const library_entry *e = library_find(r.library, name, ENTRY_FUNCTION);
        const library_entry *behind = r.library->entries + r.library->entry_count;
        for (uint32_t file = UINT32_MAX;
             e && e < behind && e->kind == ENTRY_FUNCTION && !strcmp(e->name, name);
             file = e->file, e++)
            if (e->file != file)
                end = read_overloads(&r, e->file, name, end);
    }
    return first;
}

const function *find_function(compilation *c, program *p, const char *library, const char *name)
{
    table *functions = &p->interfaces->functions;
    const function *f = table_get(functions, name);
    if (!f) {
        const pcg_library *found[2];
        if (!library_count(p, NULL, name, ENTRY_FUNCTION, found))
            return NULL;
        const unit *scope = leave_scope(p);
        function *made = read_functions(c, p, name);
        p->scope = scope;
        if (made)
            table_put(&c->arena, functions, made->name, made);
        f = made;
    }
    while (f && !is_called(f->library, library))
        f = f->next;
    return f;
}

void library_use_function(program *p, const function *f)
{
    if (table_get(&p->interfaces->used, f->symbol))
        return;
    table_put(p->arena, &p->interfaces->used, f->symbol, (void *)(uintptr_t)f);
    LIST_ADD(p->arena, &p->functions, f);
}

/* ---- did you mean -------------------------------------------------------------------------- */

bool suggestions_wanted(const compilation *c)
{
    const diagnostics *d = &c->diagnostics;
    return d->errors < (d->limit ? d->limit : 100);
}

void library_add_names(const program *p, arena *a, const char *library, library_entry_kind kind,
                       names *to)
{
    for (uint32_t i = 0; i < p->libraries.count; i++) {
        const pcg_library *l = p->libraries.at[i];
        for (uint32_t k = 0; is_meant(p, l, library) && k < l->entry_count; k++)
            if (l->entries[k].kind == kind && !l->entries[k].former_of)
                LIST_ADD(a, to, l->entries[k].name);
    }
}

diagnostic *library_report_unknown(compilation *c, const program *p, const tree_name *name)
{
    names candidates = {0};
    for (uint32_t i = 0; i < p->libraries.count; i++)
        LIST_ADD(&c->arena, &candidates, p->libraries.at[i]->name);
    diagnostic *d = diagnose(&c->diagnostics, DIAG_E0104, name->span, name->text);
    d->text = did_you_mean(c, name->text, &candidates);
    return d;
}

const char *did_you_mean(compilation *c, const char *name, const names *candidates)
{
    if (!suggestions_wanted(c))
        return NULL;
    const char *near = nearest_name(name, candidates->at, candidates->count);
    return near ? arena_format(&c->arena, "did you mean '%s'?", near) : NULL;
}

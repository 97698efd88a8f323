/* write.c - the C that stands for an interface: structs, prototypes, enumerations. The same text
 * goes into the kernels' headers and into emitted C, so that the two cannot disagree. */
#include "interface.h"

#include <string.h>

typedef struct writer {
    text *out;
    const char *library;
    const tree_procedure *procedure; /* NULL while a function is written */
    const tree_function *function;
    const interface_types *types;
} writer;

/* ---- types ----------------------------------------------------------------------------------- */

typedef struct value_type {
    const char *name; /* in the language */
    const char *c;    /* as a field or result; a star or a blank ends it */
    bool by_pointer;  /* functions take it, and give it, through a pointer */
} value_type;

static const value_type value_types[] = {
    {"bool", "int ", false},           {"int", "pcg_int ", false},
    {"float", "double ", false},       {"length", "double ", false},
    {"area", "double ", false},        {"angle", "double ", false},
    {"ratio", "double ", false},       {"seconds", "double ", false},
    {"string", "const char *", false}, {"path", "const char *", false},
    {"vec2", "pcg_vec2 ", true},       {"vec3", "pcg_vec3 ", true},
    {"vec4", "pcg_vec4 ", true},       {"quaternion", "pcg_vec4 ", true},
    {"color", "pcg_color ", true},     {"list", "const pcg_list *", false},
    {"any", "pcg_any ", true},         {"attribute", "pcg_slot ", true},
};

static const value_type *find_value_type(const char *name)
{
    for (size_t i = 0; i < COUNT_OF(value_types); i++) {
        if (strcmp(value_types[i].name, name) == 0) {
            return &value_types[i];
        }
    }
    return NULL;
}

bool interface_is_value_type(const char *name)
{
    return find_value_type(name) != NULL;
}

/* What a type variable of the procedure or function stands for; other names stay. */
static const char *bound_of(const writer *w, const char *name)
{
    const tree_variable *variables = NULL;
    uint32_t count = 0;
    if (w->procedure) {
        variables = w->procedure->variables.at;
        count = w->procedure->variables.count;
    } else if (w->function) {
        variables = w->function->variables.at;
        count = w->function->variables.count;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(variables[i].name.text, name) == 0) {
            return variables[i].bound.text ? variables[i].bound.text : "Entity";
        }
    }
    return name;
}

static const char *type_name(const writer *w, const tree_type *t)
{
    return bound_of(w, t && t->name.text ? t->name.text : "Entity");
}

/* The C type of one entity of that type. */
static const char *entity_type_of(const char *name)
{
    return strcmp(name, "Shape") == 0 ? "pcg_shape *" : "pcg_entity *";
}

static const char *field_type(const writer *w, const tree_type *t)
{
    const char *name = type_name(w, t);
    const value_type *v = find_value_type(name);
    if (v) {
        return v->c;
    }
    return w->types->is_enumeration(w->types->context, name) ? "int " : entity_type_of(name);
}

/* ---- procedures ------------------------------------------------------------------------------ */

static void write_field(const writer *w, const char *indent, const char *type, const char *name)
{
    text_add(w->out, indent);
    text_add(w->out, type);
    text_add(w->out, interface_field(w->out->arena, name));
    text_add(w->out, ";\n");
}

static void write_parameters(const writer *w, const char *indent, const tree_parameters *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        write_field(w, indent, field_type(w, list->at[i]->type), list->at[i]->name.text);
    }
}

static void write_slots(const writer *w, const char *indent, const tree_parameters *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        write_field(w, indent, "pcg_slot ", list->at[i]->name.text);
    }
}

static void write_inputs(const writer *w)
{
    const tree_gates *inputs = &w->procedure->inputs;
    for (uint32_t i = 0; i < inputs->count; i++) {
        const tree_type *t = inputs->at[i]->type;
        bool collective = t && t->collective;
        write_field(w, "    ", collective ? "pcg_entities " : entity_type_of(type_name(w, t)),
                    inputs->at[i]->name.text);
    }
}

static void write_outputs(const writer *w)
{
    const tree_gates *outputs = &w->procedure->outputs;
    for (uint32_t i = 0; i < outputs->count; i++) {
        write_field(w, "    ", "const pcg_port *", outputs->at[i]->name.text);
    }
}

/* What the augmentations of a procedure carry beside their own parameters. Inputs are all
 * collective, or none is. */
typedef struct item_ports {
    bool output, input, collective;
} item_ports;

static item_ports ports_of(const tree_procedure *p)
{
    item_ports has = {false, false, false};
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        has.output = has.output || g->output;
        has.input = has.input || g->input;
        has.collective = has.collective || (g->input && g->input->collective);
    }
    return has;
}

/* An augmentation's own struct, named after its kind; none where it would be empty. */
static void write_augment(const writer *w, const tree_augment *g)
{
    if (g->parameters.count == 0 && g->attributes.count == 0) {
        return;
    }
    text_add(w->out, "        struct {\n");
    write_parameters(w, "            ", &g->parameters);
    write_slots(w, "            ", &g->attributes);
    text_format(w->out, "        } %s;\n", interface_field(w->out->arena, g->name.text));
}

static void write_items(const writer *w, const char *symbol)
{
    const tree_procedure *p = w->procedure;
    if (p->augments.count == 0) {
        return;
    }
    item_ports has = ports_of(p);
    text_format(w->out, "    struct %s_item {\n", symbol);
    text_add(w->out, "        int kind;\n        const char *name;\n");
    if (has.output) {
        text_add(w->out, "        const pcg_port *port;\n");
    }
    if (has.input) {
        text_add(w->out, has.collective ? "        pcg_entities input;\n"
                                        : "        pcg_entity *input;\n");
    }
    for (uint32_t i = 0; i < p->augments.count; i++) {
        write_augment(w, p->augments.at[i]);
    }
    text_add(w->out, "    } *items;\n    pcg_u32 item_count;\n");
}

static void write_kinds(const writer *w)
{
    const tree_procedure *p = w->procedure;
    if (p->augments.count == 0) {
        return;
    }
    text_add(w->out, "enum {\n");
    for (uint32_t i = 0; i < p->augments.count; i++) {
        text_format(w->out, "    %s%s\n",
                    interface_kind_constant(w->out->arena, w->library, p->name.text,
                                            p->augments.at[i]->name.text),
                    i + 1 < p->augments.count ? "," : "");
    }
    text_add(w->out, "};\n");
}

void interface_write_procedure(text *out, const char *library, const tree_procedure *p,
                               const char *before, const interface_types *types)
{
    writer w = {.out = out, .library = library, .procedure = p, .types = types};
    const char *symbol = interface_procedure_symbol(out->arena, library, p->name.text);
    write_kinds(&w);
    text_format(out, "struct %s {\n    pcg_instance instance;\n", symbol);
    write_inputs(&w);
    write_parameters(&w, "    ", &p->parameters);
    write_slots(&w, "    ", &p->attributes);
    write_outputs(&w);
    write_items(&w, symbol);
    text_format(out, "};\n%sint %s(pcg_call *call, struct %s *node);\n", before, symbol, symbol);
}

/* ---- functions ------------------------------------------------------------------------------- */

static bool has_trait(const tree_function *f, const char *name)
{
    for (uint32_t i = 0; i < f->traits.count; i++) {
        if (strcmp(f->traits.at[i].text, name) == 0) {
            return true;
        }
    }
    return false;
}

static void write_argument(const writer *w, const tree_parameter *p)
{
    const char *type = type_name(w, p->type);
    const char *name = interface_field(w->out->arena, p->name.text);
    const value_type *v = find_value_type(type);
    const char *c = field_type(w, p->type);
    if (p->type && p->type->collective) {
        text_format(w->out, ", const %s*%s, pcg_u32 %s_count", c, name, name);
    } else if (v && !v->by_pointer) {
        text_format(w->out, ", %s%s", c, name);
    } else if (v) {
        text_format(w->out, ", const %s*%s", c, name);
    } else if (w->types->is_enumeration(w->types->context, type)) {
        text_format(w->out, ", int %s", name);
    } else {
        text_format(w->out, ", const %s%s", c, name);
    }
}

void interface_write_function(text *out, const char *library, const tree_function *f,
                              const char *before, const interface_types *types)
{
    writer w = {.out = out, .library = library, .function = f, .types = types};
    const value_type *result = find_value_type(type_name(&w, f->result));
    bool through_pointer = result && result->by_pointer;
    text_add(out, before);
    text_add(out, through_pointer ? "void " : field_type(&w, f->result));
    text_format(out, "%s(pcg_call *call", interface_function_symbol(out->arena, library, f));
    if (has_trait(f, "random")) {
        text_add(out, ", pcg_u32 site");
    }
    for (uint32_t i = 0; i < f->parameters.count; i++) {
        write_argument(&w, f->parameters.at[i]);
    }
    if (through_pointer) {
        text_format(out, ", %s*result", result->c);
    }
    text_add(out, ");\n");
}

/* ---- enumerations ---------------------------------------------------------------------------- */

void interface_write_enumeration(text *out, const char *library, const tree_enumeration *e)
{
    (void)library; /* names are unique over all libraries */
    text_add(out, "enum {\n");
    for (uint32_t i = 0; i < e->enumerators.count; i++) {
        text_format(out, "    %s%s\n",
                    interface_constant(out->arena, e->name.text, e->enumerators.at[i].name.text),
                    i + 1 < e->enumerators.count ? "," : "");
    }
    text_add(out, "};\n");
}

/* command_info.c - pcgc info: what a graph takes and gives: parameters, gates, attributes,
 * files. */
#include <string.h>

#include "../runtime/program.h"
#include "library.h"
#include "tool.h"

typedef struct informing {
    tool t;
    bool json;
} informing;

/* ---- for people ------------------------------------------------------------------------------ */

static void add_document(text *out, const char *document)
{
    if (document) {
        text_add(out, "  ");
        text_add_bytes(out, document, strcspn(document, "\n"));
    }
    text_add(out, "\n");
}

static void add_parameters(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        const parameter *p = &g->parameters[i];
        text_format(out, "  %s%s: ", p->hidden ? "hidden " : "", p->name);
        type_write(&p->type, out);
        if (p->tree->initial) {
            text_add(out, " = ");
            lang_write_expression(p->tree->initial, out);
        }
        add_document(out, p->tree->head.document);
    }
}

static void add_gates(node *const *gates, uint32_t count, text *out)
{
    for (uint32_t i = 0; i < count; i++) {
        text_format(out, "  %s: ", gates[i]->name);
        lang_write_type(gates[i]->gate->type, out);
        add_document(out, gates[i]->gate->head.document);
    }
}

static void add_attributes(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        text_format(out, "  %s: ", g->attributes[i].name);
        type_write(&g->attributes[i].type, out);
        add_document(out, g->attributes[i].tree->head.document);
    }
}

static void add_heading(text *out, const char *heading, uint32_t count)
{
    if (count)
        text_format(out, "%s\n", heading);
}

static void describe(const program *p, text *out)
{
    const graph *g = p->main;
    text_format(out, "graph %s", g->name);
    const char *document =
        g->tree->head.document ? g->tree->head.document : g->unit->tree->document;
    if (document)
        text_format(out, ": %.*s", (int)strcspn(document, "\n"), document);
    text_add(out, "\n");
    add_heading(out, "parameters", g->parameter_count);
    add_parameters(g, out);
    add_heading(out, "inputs", g->input_count);
    add_gates(g->inputs, g->input_count, out);
    add_heading(out, "outputs", g->output_count);
    add_gates(g->outputs, g->output_count, out);
    add_heading(out, "attributes", g->attribute_count);
    add_attributes(g, out);
    add_heading(out, "files", p->unit_count);
    for (uint32_t i = 0; i < p->unit_count; i++)
        text_format(out, "  %s\n", p->units[i]->source->path);
}

/* ---- as JSON --------------------------------------------------------------------------------- */

static void add_field(text *out, const char *name, const char *string)
{
    text_format(out, ", \"%s\": ", name);
    if (string)
        text_quote(out, string);
    else
        text_add(out, "null");
}

/* {"name": …, "type": …, "initial": …, "document": …} */
static void add_entry(text *out, bool first, const char *name, const text *type_text,
                      const tree_expression *initial, const char *document)
{
    text_add(out, first ? "\n    {\"name\": " : ",\n    {\"name\": ");
    text_quote(out, name);
    add_field(out, "type", type_text->at);
    if (initial) {
        text expression = {.arena = out->arena};
        lang_write_expression(initial, &expression);
        add_field(out, "initial", expression.at);
    }
    add_field(out, "document", document);
    text_add(out, "}");
}

static void add_parameters_json(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->parameter_count; i++) {
        const parameter *p = &g->parameters[i];
        text type_text = {.arena = out->arena};
        type_write(&p->type, &type_text);
        add_entry(out, i == 0, p->name, &type_text, p->tree->initial, p->tree->head.document);
    }
}

static void add_gates_json(node *const *gates, uint32_t count, text *out)
{
    for (uint32_t i = 0; i < count; i++) {
        text type_text = {.arena = out->arena};
        lang_write_type(gates[i]->gate->type, &type_text);
        add_entry(out, i == 0, gates[i]->name, &type_text, NULL, gates[i]->gate->head.document);
    }
}

static void add_attributes_json(const graph *g, text *out)
{
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        text type_text = {.arena = out->arena};
        type_write(&g->attributes[i].type, &type_text);
        add_entry(out, i == 0, g->attributes[i].name, &type_text, g->attributes[i].tree->initial,
                  g->attributes[i].tree->head.document);
    }
}

/* ---- libraries that are not built in --------------------------------------------------------- */

static void add_libraries(const compilation *c, const program *p, text *out)
{
    add_heading(out, "libraries", p->libraries.count - p->common_libraries);
    for (uint32_t i = p->common_libraries; i < p->libraries.count; i++)
        text_format(out, "  %s  %s\n", p->libraries.at[i]->name,
                    library_path(c, p->libraries.at[i]));
}

static void add_libraries_json(const compilation *c, const program *p, text *out)
{
    for (uint32_t i = p->common_libraries; i < p->libraries.count; i++) {
        text_format(out, "%s\n    {\"name\": ", i > p->common_libraries ? "," : "");
        text_quote(out, p->libraries.at[i]->name);
        add_field(out, "file", library_path(c, p->libraries.at[i]));
        text_add(out, "}");
    }
}

static void describe_json(const compilation *c, const program *p, text *out)
{
    const graph *g = p->main;
    text_add(out, "{\"version\": 1, \"graph\": ");
    text_quote(out, g->name);
    add_field(out, "document",
              g->tree->head.document ? g->tree->head.document : g->unit->tree->document);
    text_add(out, ",\n  \"parameters\": [");
    add_parameters_json(g, out);
    text_add(out, "],\n  \"inputs\": [");
    add_gates_json(g->inputs, g->input_count, out);
    text_add(out, "],\n  \"outputs\": [");
    add_gates_json(g->outputs, g->output_count, out);
    text_add(out, "],\n  \"attributes\": [");
    add_attributes_json(g, out);
    text_add(out, "],\n  \"files\": [");
    for (uint32_t i = 0; i < p->unit_count; i++) {
        text_add(out, i ? ", " : "");
        text_quote(out, p->units[i]->source->path);
    }
    text_add(out, "],\n  \"libraries\": [");
    add_libraries_json(c, p, out);
    text_add(out, "]}\n");
}

/* ---- of a shared object ---------------------------------------------------------------------- */

static void add_gate(text *out, const pcg_gate *g)
{
    text_format(out, "  %s: %s%s", g->name, g->type, g->collective ? "[]" : "");
    add_document(out, g->document);
}

static void describe_compiled(const pcg_program *p, text *out)
{
    const char *document = pcg_program_document(p);
    text_format(out, "graph %s", pcg_program_name(p));
    if (document && *document)
        text_format(out, ": %.*s", (int)strcspn(document, "\n"), document);
    text_add(out, "\n");
    add_heading(out, "parameters", (uint32_t)pcg_program_parameter_count(p));
    pcg_parameter parameter_of;
    for (size_t i = 0; pcg_program_parameter(p, i, &parameter_of); i++) {
        text_format(out, "  %s%s: %s = %s", parameter_of.hidden ? "hidden " : "", parameter_of.name,
                    parameter_of.type, parameter_of.initial);
        add_document(out, parameter_of.document);
    }
    pcg_gate gate;
    add_heading(out, "inputs", (uint32_t)pcg_program_input_count(p));
    for (size_t i = 0; pcg_program_input(p, i, &gate); i++)
        add_gate(out, &gate);
    add_heading(out, "outputs", (uint32_t)pcg_program_output_count(p));
    for (size_t i = 0; pcg_program_output(p, i, &gate); i++)
        add_gate(out, &gate);
    add_heading(out, "attributes", (uint32_t)pcg_program_attribute_count(p));
    for (size_t i = 0; i < pcg_program_attribute_count(p); i++)
        text_format(out, "  %s\n", pcg_program_attribute_name(p, i));
    add_heading(out, "libraries", p->library_count);
    for (uint32_t i = 0; i < p->library_count; i++)
        text_format(out, "  %s  %s\n", p->libraries[i]->library->name, p->libraries[i]->path);
}

static int inform_compiled(informing *k, const char *path)
{
    if (k->json)
        return usage_error(&command_info, "--json needs the source; '%s' is compiled", path);
    pcg_compile_options options = {
        .size = sizeof options, .message = tool_print_message, .user = &k->t,
        .library_paths = k->t.compilation.library_paths};
    pcg_program *p = pcg_program_load(path, &options);
    if (!p)
        return EXIT_USAGE;
    text out = {.arena = &k->t.compilation.arena};
    describe_compiled(p, &out);
    pcg_program_free(p);
    return tool_write(NULL, "-", out.at, out.length) ? EXIT_DONE : EXIT_USAGE;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int inform(void *context, const char *path)
{
    informing *k = context;
    int code;
    if (is_shared_object(path))
        return inform_compiled(k, path);
    program *p = tool_compile(&k->t, path, &code);
    if (!p)
        return code;
    text out = {.arena = &k->t.compilation.arena};
    if (k->json)
        describe_json(&k->t.compilation, p, &out);
    else
        describe(p, &out);
    if (!k->json)
        add_libraries(&k->t.compilation, p, &out);
    return tool_write(NULL, "-", out.at, out.length) ? EXIT_DONE : EXIT_USAGE;
}

static int run_info(const command *self, int argc, char **argv)
{
    arena a = {0};
    informing k = {0};
    option_texts files = {0};
    const option options[] = {
        {0, "json", OPTION_FLAG, &k.json, NULL, "as JSON"}, TOOL_OPTIONS(&k.t), {0}};
    int code = options_read(&a, self, options, argc, argv, &files);
    if (code < 0 && files.count != 1)
        code = usage_error(self, files.count ? "one file at a time" : "which file?");
    if (code < 0)
        code = tool_begin(&k.t, self);
    if (code < 0) {
        code = tool_guarded(&k.t, files.at[0], inform, &k);
        code = tool_end(&k.t, code);
    }
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc info house.pcg", "pcgc info house.pcg --json", NULL};
const command command_info = {"info", "FILE", "Says what a graph takes and gives.", examples,
                              run_info};

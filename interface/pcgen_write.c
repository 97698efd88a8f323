/* pcgen_write.c - the kernels' headers. */
#include "pcgen.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

/* ---- files ----------------------------------------------------------------------------------- */

/* Makes the folders on the way to a file. */
static void make_folders(pcgen *g, const char *path)
{
    char *copy = arena_copy(&g->arena, path, strlen(path));
    for (char *at = strchr(copy + 1, '/'); at; at = strchr(at + 1, '/')) {
        *at = '\0';
        if (mkdir(copy, 0777) != 0 && errno != EEXIST) {
            pcgen_fail(g, copy);
            return;
        }
        *at = '/';
    }
}

static bool holds_already(pcgen *g, const char *path, const text *content)
{
    const source *old = source_read(&g->arena, path, LANG_MAX_BYTES);
    return old && old->size == content->length &&
           memcmp(old->text, content->at, content->length) == 0;
}

void pcgen_write_file(pcgen *g, const char *path, const text *content)
{
    const char *full = arena_format(&g->arena, "%s/%s", g->output, path);
    if (holds_already(g, full, content)) {
        return;
    }
    make_folders(g, full);
    FILE *f = fopen(full, "wb");
    if (!f) {
        pcgen_fail(g, full);
        return;
    }
    bool written = fwrite(content->at, 1, content->length, f) == content->length;
    if (fclose(f) != 0 || !written) {
        pcgen_fail(g, full);
    }
}

/* ---- string literals ------------------------------------------------------------------------- */

/* One byte inside a literal. A question mark behind another would begin a trigraph; three octal
 * digits end an escape whatever follows it. */
static void add_escaped(text *out, char before, char c)
{
    if (c == '"' || c == '\\') {
        text_format(out, "\\%c", c);
    } else if (c == '\t') {
        text_add(out, "\\t");
    } else if (c == '?' && before == '?') {
        text_add(out, "\"\"?");
    } else if ((unsigned char)c < 0x20 || c == 0x7f) {
        text_format(out, "\\%03o", (unsigned char)c);
    } else {
        text_add_bytes(out, &c, 1);
    }
}

void pcgen_write_string(text *out, const char *string)
{
    text_add(out, "\"");
    char before = '\0';
    for (const char *at = string; *at; at++) {
        if (*at != '\n') {
            add_escaped(out, before, *at);
        } else {
            text_add(out, "\\n");
            text_add(out, at[1] ? "\"\n    \"" : "");
        }
        before = *at;
    }
    text_add(out, "\"");
}

/* ---- headers --------------------------------------------------------------------------------- */

static void write_guard(pcgen *g, text *out, const char *library, const char *name)
{
    const char *guard = interface_kind_constant(&g->arena, library, name, "h");
    text_format(out, "#ifndef %s\n#define %s\n\n", guard, guard);
}

static void write_declarations(pcgen *g, text *out, const char *library, const tree_file *tree)
{
    for (uint32_t i = 0; i < tree->items.count; i++) {
        const tree_item *item = &tree->items.at[i];
        if (item->kind == ITEM_PROCEDURE) {
            interface_write_procedure(out, library, item->procedure, "", &g->types);
        } else if (item->kind == ITEM_FUNCTION) {
            interface_write_function(out, library, item->function, "", &g->types);
        } else if (item->kind == ITEM_ENTITY && g->foreign) {
            text_format(out, "extern const pcg_type %s;\n",
                        interface_type_symbol(out->arena, library, item->entity->name.text));
        }
    }
}

static void write_header(pcgen *g, const char *library, const pcgen_file *f)
{
    text out = {.arena = &g->arena};
    text_format(&out, "/* Made from the interface in %s: change it there. */\n", f->path);
    write_guard(g, &out, library, f->name);
    text_add(&out, g->foreign ? "#include <pcg/abi.h>\n" : "#include \"runtime/abi.h\"\n");
    text_add(&out, "#include \"enumerations.h\"\n\n");
    write_declarations(g, &out, library, f->tree);
    text_add(&out, "\n#endif\n");
    pcgen_write_file(g, arena_format(&g->arena, "%s/%s.h", library, f->name), &out);
}

static void write_enumerations(pcgen *g)
{
    text out = {.arena = &g->arena};
    text_add(&out, "/* Made from the interfaces of all libraries: change them there. */\n");
    text_add(&out, "#ifndef PCG_ENUMERATIONS_H\n#define PCG_ENUMERATIONS_H\n");
    for (uint32_t i = 0; i < g->enumerations.entries.count; i++) {
        text_add(&out, "\n");
        interface_write_enumeration(&out, "", g->enumerations.entries.at[i].value);
    }
    text_add(&out, "\n#endif\n");
    pcgen_write_file(g, "enumerations.h", &out);
}

void pcgen_write_headers(pcgen *g)
{
    for (uint32_t i = 0; i < g->libraries.count; i++) {
        const pcgen_library *l = g->libraries.at[i];
        for (uint32_t k = 0; k < l->files.count; k++) {
            write_header(g, l->name, l->files.at[k]);
        }
    }
    write_enumerations(g);
}

/* interface.c - looking things up in a library, finding interface blocks, names in C. */
#include "interface.h"

#include <stdlib.h>
#include <string.h>

/* ---- libraries ------------------------------------------------------------------------------- */

const library_entry *library_find(const pcg_library *l, const char *name, library_entry_kind kind)
{
    uint32_t low = 0, high = l->entry_count;
    while (low < high) { /* the first entry that is not before (name, kind) */
        uint32_t middle = low + (high - low) / 2;
        const library_entry *e = &l->entries[middle];
        int order = strcmp(e->name, name);
        if (order < 0 || (order == 0 && e->kind < kind)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (low == l->entry_count) {
        return NULL;
    }
    const library_entry *e = &l->entries[low];
    return strcmp(e->name, name) == 0 && e->kind == kind ? e : NULL;
}

/* ---- interface blocks ------------------------------------------------------------------------ */

static const char *line_end(const char *at, const char *end)
{
    const char *found = memchr(at, '\n', (size_t)(end - at));
    return found ? found : end;
}

/* Whether the line is the block's first: the opening of a comment with nothing behind "pcg". */
static bool opens_block(const char *at, const char *end)
{
    static const char opening[] = "/*pcg";
    size_t length = sizeof opening - 1;
    if ((size_t)(end - at) < length || memcmp(at, opening, length) != 0) {
        return false;
    }
    for (at += length; at < end; at++) {
        if (*at != ' ' && *at != '\t' && *at != '\r') {
            return false;
        }
    }
    return true;
}

/* The end of the comment that holds the block, or the end of the file where it is not closed. */
static const char *block_end(const char *at, const char *end)
{
    for (; at + 1 < end; at++) {
        if (at[0] == '*' && at[1] == '/') {
            return at;
        }
    }
    return end;
}

bool interface_extract(arena *a, const source *file, const char **block, uint32_t *line)
{
    const char *end = file->text + file->size;
    uint32_t number = 1;
    for (const char *at = file->text; at < end; number++) {
        const char *stop = line_end(at, end);
        if (opens_block(at, stop)) {
            const char *from = stop < end ? stop + 1 : end;
            *block = arena_copy(a, from, (size_t)(block_end(from, end) - from));
            *line = number + 1;
            return *block != NULL;
        }
        at = stop < end ? stop + 1 : end;
    }
    return false;
}

/* ---- names in C ------------------------------------------------------------------------------ */

/* Keywords, those of C23 included, and names that headers or compilers make macros of. Sorted. */
static const char *const reserved[] = {
    "NULL", "alignas", "alignof", "asm", "auto", "bool", "break", "case", "char", "complex",
    "const", "constexpr", "continue", "default", "do", "double", "else", "enum", "errno", "extern",
    "false", "float", "for", "goto", "if", "imaginary", "inline", "int", "linux", "long",
    "noreturn", "nullptr", "register", "restrict", "return", "short", "signed", "sizeof", "static",
    "static_assert", "stderr", "stdin", "stdout", "struct", "switch", "thread_local", "true",
    "typedef", "typeof", "typeof_unqual", "union", "unix", "unsigned", "void", "volatile", "while",
};

static int compare_names(const void *a, const void *b)
{
    return strcmp(a, *(const char *const *)b);
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Adds the name with every byte that no identifier may hold as _xx in hexadecimal. */
static void add_identifier(text *out, const char *name)
{
    if (is_digit(name[0]) || name[0] == '\0') {
        text_add(out, "_");
    }
    for (; *name; name++) {
        if (is_letter(*name) || is_digit(*name) || *name == '_') {
            text_add_bytes(out, name, 1);
        } else {
            text_format(out, "_%02x", (unsigned char)*name);
        }
    }
}

const char *interface_field(arena *a, const char *name)
{
    text out = {.arena = a};
    add_identifier(&out, name);
    if (bsearch(name, reserved, COUNT_OF(reserved), sizeof reserved[0], compare_names)) {
        text_add(&out, "_");
    }
    return out.at;
}

const char *interface_procedure_symbol(arena *a, const char *library, const char *procedure)
{
    text out = {.arena = a};
    text_add(&out, "pcg_");
    add_identifier(&out, library);
    text_add(&out, "_");
    add_identifier(&out, procedure);
    return out.at;
}

const char *interface_type_symbol(arena *a, const char *library, const char *entity)
{
    text out = {.arena = a};
    text_add(&out, "pcg_");
    add_identifier(&out, library);
    text_add(&out, "_type_");
    add_identifier(&out, entity);
    return out.at;
}

static char to_upper(char c)
{
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

/* RoofKind as ROOF_KIND. */
static void add_capitals(text *out, const char *name)
{
    text plain = {.arena = out->arena};
    add_identifier(&plain, name);
    for (size_t i = 0; i < plain.length; i++) {
        char c = plain.at[i];
        bool capital = c >= 'A' && c <= 'Z';
        if (capital && i > 0 && plain.at[i - 1] >= 'a' && plain.at[i - 1] <= 'z') {
            text_add(out, "_");
        }
        c = to_upper(c);
        text_add_bytes(out, &c, 1);
    }
}

const char *interface_constant(arena *a, const char *enumeration, const char *enumerator)
{
    text out = {.arena = a};
    text_add(&out, "PCG_");
    add_capitals(&out, enumeration);
    text_add(&out, "_");
    add_capitals(&out, enumerator);
    return out.at;
}

const char *interface_kind_constant(arena *a, const char *library, const char *procedure,
                                    const char *augment)
{
    text out = {.arena = a};
    text_add(&out, "PCG_");
    add_capitals(&out, library);
    text_add(&out, "_");
    add_capitals(&out, procedure);
    text_add(&out, "_");
    add_capitals(&out, augment);
    return out.at;
}

/* A type variable stands for what bounds it. */
static const char *bound_of(const tree_function *f, const char *name)
{
    for (uint32_t i = 0; i < f->variables.count; i++) {
        const tree_variable *v = &f->variables.at[i];
        if (strcmp(v->name.text, name) == 0) {
            return v->bound.text ? v->bound.text : "Entity";
        }
    }
    return name;
}

const char *interface_function_symbol(arena *a, const char *library, const tree_function *f)
{
    text out = {.arena = a};
    text_add(&out, "pcg_");
    add_identifier(&out, library);
    text_add(&out, "_fn_");
    add_identifier(&out, f->name.text);
    for (uint32_t i = 0; i < f->parameters.count; i++) {
        const tree_type *t = f->parameters.at[i]->type;
        bool collective = t && t->collective;
        for (; t; t = t->element) { /* list<int>: list_int */
            text_add(&out, "_");
            add_identifier(&out, t->name.text ? bound_of(f, t->name.text) : "error");
        }
        if (collective) {
            text_add(&out, "s");
        }
    }
    return out.at;
}

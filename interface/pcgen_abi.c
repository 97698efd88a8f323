/* pcgen_abi.c - abi.h as a string, and the table of what it declares.
 *
 * abi.h is plain: prototypes, `extern` variables, types, enumerations, one declaration a
 * statement. A statement at file level that begins with typedef, struct or enum declares no
 * symbol; of the others the name is what stands before the parenthesis, and in an extern one every
 * name before a comma or the end.
 */
#include "pcgen.h"

#include <stdlib.h>
#include <string.h>

typedef LIST(const char *) name_list;

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* The end of a line, and of those that backslashes join to it. */
static const char *line_end(const char *at)
{
    const char *end = at + strcspn(at, "\n");
    while (*end && end > at && end[-1] == '\\') {
        end += 1 + strcspn(end + 1, "\n");
    }
    return end;
}

/* Behind comments and preprocessor lines, where the text stands at one; else `at`. */
static const char *skip_aside(const char *at, bool line_start)
{
    if (at[0] == '/' && at[1] == '*') {
        const char *end = strstr(at + 2, "*/");
        return end ? end + 2 : at + strlen(at);
    }
    bool comment = at[0] == '/' && at[1] == '/';
    return comment || (line_start && at[0] == '#') ? line_end(at) : at;
}

/* The next statement at file level as text without comments and braces' contents; false at the
 * end. */
static bool next_statement(const char **position, text *statement)
{
    const char *at = *position;
    int depth = 0;
    bool line_start = true;
    statement->length = 0;
    while (*at) {
        const char *behind = skip_aside(at, line_start);
        if (behind != at) {
            at = behind;
            continue;
        }
        if (*at == ';' && depth == 0) {
            *position = at + 1;
            return true;
        }
        depth += *at == '{';
        if (depth == 0) {
            text_add_bytes(statement, *at == '\n' ? " " : at, 1);
        }
        depth -= *at == '}';
        line_start = *at == '\n';
        at++;
    }
    *position = at;
    return false;
}

/* The name that ends before `end`. */
static const char *name_before(arena *a, const char *from, const char *end)
{
    while (end > from && !is_name(end[-1])) {
        end--;
    }
    const char *begin = end;
    while (begin > from && is_name(begin[-1])) {
        begin--;
    }
    return arena_copy(a, begin, (size_t)(end - begin));
}

static bool begins_with(const char *s, const char *word)
{
    size_t length = strlen(word);
    return strncmp(s, word, length) == 0 && !is_name(s[length]);
}

static void add_names(pcgen *g, const char *statement, name_list *names)
{
    statement += strspn(statement, " ");
    if (*statement == '\0' || begins_with(statement, "typedef") || begins_with(statement, "enum") ||
        begins_with(statement, "struct")) {
        return;
    }
    const char *parenthesis = strchr(statement, '(');
    if (parenthesis) {
        const char *name = name_before(&g->arena, statement, parenthesis);
        LIST_ADD(&g->arena, names, name);
        return;
    }
    for (const char *end = statement; *end; end++) {
        if (*end == ',' || end[1] == '\0') {
            const char *name = name_before(&g->arena, statement, *end == ',' ? end : end + 1);
            LIST_ADD(&g->arena, names, name);
        }
    }
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static void write_symbols(pcgen *g, const char *header)
{
    name_list names = {NULL, 0, 0};
    text statement = {.arena = &g->arena};
    while (next_statement(&header, &statement)) {
        if (statement.length > 0) {
            statement.at[statement.length] = '\0';
            add_names(g, statement.at, &names);
        }
    }
    if (names.count > 0) {
        qsort(names.at, names.count, sizeof names.at[0], compare_names);
    }
    text out = {.arena = &g->arena};
    text_add(&out, "/* Made from runtime/abi.h: change it there. */\n");
    text_add(&out, "#include \"interface/interface.h\"\n#include \"runtime/abi.h\"\n\n");
    text_add(&out, "const library_symbol pcg_abi_symbols[] = {\n");
    for (uint32_t i = 0; i < names.count; i++) {
        const char *name = names.at[i];
        text_format(&out, "    {\"%s\", (void (*)(void))(uintptr_t)&%s, 0},\n", name, name);
    }
    text_format(&out, "};\nconst uint32_t pcg_abi_symbol_count = %u;\n", names.count);
    pcgen_write_file(g, "abi_symbols.c", &out);
}

void pcgen_write_abi(pcgen *g, const char *path)
{
    const source *s = source_read(&g->arena, path, LANG_MAX_BYTES);
    if (!s) {
        pcgen_fail(g, path);
        return;
    }
    text out = {.arena = &g->arena};
    text_add(&out, "/* Made from runtime/abi.h: change it there. */\n");
    text_add(&out, "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n");
    text_add(&out, "#include \"interface/interface.h\"\n\nconst char pcg_abi_text[] =\n    ");
    pcgen_write_string(&out, s->text);
    text_add(&out, ";\n");
    pcgen_write_file(g, "abi_text.c", &out);
    write_symbols(g, s->text);
}

/* base_diagnostics.c - sources, and how messages about them are printed. */
#include "../../runtime/base/base.h"

#include <errno.h>
#include <stdlib.h>

#include "unit.h"

/* A compilation's arena and messages, and one source. */
typedef struct fixture {
    arena arena;
    jmp_buf failed;
    diagnostics diagnostics;
    source *source;
} fixture;

static void begin(fixture *f, const char *content)
{
    memset(f, 0, sizeof *f);
    f->diagnostics.arena = &f->arena;
    f->source = source_new(&f->arena, "house.pcg", content, strlen(content));
    f->arena.on_failure = &f->failed;
}

static void end(fixture *f)
{
    arena_free(&f->arena);
}

static span find(const fixture *f, const char *word)
{
    const char *at = strstr(f->source->text, word);
    uint32_t from = (uint32_t)(at - f->source->text);
    return (span){f->source, from, from + (uint32_t)strlen(word)};
}

/* What one of the two ways of printing prints. */
static const char *printed(fixture *f, void (*print)(const diagnostics *, FILE *))
{
    static char buffer[20000];
    FILE *file = tmpfile();
    if (!file)
        return "(no temporary file)";
    print(&f->diagnostics, file);
    rewind(file);
    buffer[fread(buffer, 1, sizeof buffer - 1, file)] = '\0';
    fclose(file);
    return buffer;
}

static void plain(const diagnostics *d, FILE *out)
{
    diagnostics_print(d, out, false);
}

static void coloured(const diagnostics *d, FILE *out)
{
    diagnostics_print(d, out, true);
}

/* ---- sources --------------------------------------------------------------------------------- */

static void check_place(const source *s, uint32_t offset, uint32_t line, uint32_t column)
{
    uint32_t found_line, found_column;
    source_place(s, offset, &found_line, &found_column);
    CHECK_INTEGER(found_line, line);
    CHECK_INTEGER(found_column, column);
}

static void finds_places(void)
{
    fixture f;
    begin(&f, "ab\n\nä→x\n");
    CHECK_INTEGER(f.source->line_count, 4);
    check_place(f.source, 0, 1, 1);
    check_place(f.source, 2, 1, 3);
    check_place(f.source, 3, 2, 1);
    check_place(f.source, 4, 3, 1);
    check_place(f.source, 6, 3, 2);
    check_place(f.source, 9, 3, 3);
    check_place(f.source, 11, 4, 1);
    check_place(f.source, 1000, 4, 1); /* behind the end: the end */
    end(&f);
}

static void reads_files(void)
{
    arena a = {0};
    FILE *file = tmpfile();
    CHECK(source_read(&a, "no/such/file", 100) == NULL && errno == ENOENT);
    if (file) {
        for (int i = 0; i < 100000; i++)
            fputs("0123456789", file);
        rewind(file);
        source *s = source_read_stream(&a, "x.pcg", file, 1000000);
        CHECK(s && s->size == 1000000 && s->text[1000000] == '\0' && s->text[999999] == '9');
        rewind(file);
        CHECK(source_read_stream(&a, "x.pcg", file, 999999) == NULL && errno == EFBIG);
        fclose(file);
    }
    CHECK(source_read(&a, ".", 100) == NULL); /* a folder is no file */
    arena_free(&a);
}

/* ---- the printed form ------------------------------------------------------------------------ */

static void prints_carets_and_label(void)
{
    fixture f;
    begin(&f, "graph g {\n    -> note: lgo()\n}\n");
    diagnose(&f.diagnostics, DIAG_E0102, find(&f, "lgo"), "lgo")->text = "did you mean 'log'?";
    CHECK_TEXT(printed(&f, plain), "house.pcg:2:14: error: unknown procedure 'lgo' [E0102]\n"
                                   "    2 |     -> note: lgo()\n"
                                   "      |              ^~~ did you mean 'log'?\n");
    CHECK_TEXT(printed(&f, coloured),
               "\033[1mhouse.pcg:2:14: \033[0m\033[1;31merror:\033[0m \033[1munknown procedure "
               "'lgo'\033[0m [E0102]\n"
               "    2 |     -> note: lgo()\n"
               "      |              \033[1;31m^~~ did you mean 'log'?\033[0m\n");
    end(&f);
}

static void prints_two_places_of_a_line(void)
{
    fixture f;
    begin(&f, "    network -> floors\n");
    diagnostic *d = diagnose(&f.diagnostics, DIAG_E0015, find(&f, "network"));
    d->second.span = find(&f, "floors");
    d->help = "insert street_to_shape()";
    CHECK_TEXT(printed(&f, plain), "house.pcg:1:5: error: the attribute lacks its '@' [E0015]\n"
                                   "    1 |     network -> floors\n"
                                   "      |     ^~~~~~~    ^~~~~~\n"
                                   "      = help: insert street_to_shape()\n");
    d->text = "left";
    d->second.text = "right";
    CHECK_TEXT(printed(&f, plain), "house.pcg:1:5: error: the attribute lacks its '@' [E0015]\n"
                                   "    1 |     network -> floors\n"
                                   "      |     ^~~~~~~    ^~~~~~ right\n"
                                   "      |     left\n"
                                   "      = help: insert street_to_shape()\n");
    end(&f);
}

static void prints_second_places_elsewhere(void)
{
    fixture f;
    begin(&f, "one\ntwo\n");
    source *other = source_new(&f.arena, "other.pcg", "three\n", 6);
    diagnostic *d = diagnose(&f.diagnostics, DIAG_E0015, find(&f, "two"));
    d->second = (diagnostic_label){find(&f, "one"), "first here"};
    CHECK_TEXT(printed(&f, plain), "house.pcg:2:1: error: the attribute lacks its '@' [E0015]\n"
                                   "    2 | two\n"
                                   "      | ^~~\n"
                                   "    1 | one\n"
                                   "      | ^~~ first here\n");
    d->second = (diagnostic_label){{other, 0, 5}, NULL};
    CHECK_TEXT(printed(&f, plain), "house.pcg:2:1: error: the attribute lacks its '@' [E0015]\n"
                                   "    2 | two\n"
                                   "      | ^~~\n"
                                   "      --> other.pcg:1:1\n"
                                   "    1 | three\n"
                                   "      | ^~~~~\n");
    end(&f);
}

/* Tabs, wide characters, controls, the end of a file: the caret stands under its place. */
static void prints_what_is_not_ascii(void)
{
    fixture f;
    begin(&f, "\tä日x\n\x1b[1m\xff y\r\nz");
    diagnose(&f.diagnostics, DIAG_E0015, find(&f, "x"));
    diagnose(&f.diagnostics, DIAG_E0015, find(&f, "y"));
    diagnose(&f.diagnostics, DIAG_E0015,
             (span){f.source, (uint32_t)f.source->size, (uint32_t)f.source->size});
    CHECK_TEXT(printed(&f, plain), "house.pcg:1:4: error: the attribute lacks its '@' [E0015]\n"
                                   "    1 |     ä日x\n"
                                   "      |        ^\n"
                                   "house.pcg:2:7: error: the attribute lacks its '@' [E0015]\n"
                                   "    2 | <1b>[1m<ff> y\n"
                                   "      |             ^\n"
                                   "house.pcg:3:2: error: the attribute lacks its '@' [E0015]\n"
                                   "    3 | z\n"
                                   "      |  ^\n");
    end(&f);
}

static void cuts_long_lines(void)
{
    fixture f;
    enum { LENGTH = 10000000 };
    char *line = malloc(LENGTH + 1);
    if (!line)
        return;
    memset(line, 'x', LENGTH);
    line[LENGTH] = '\0';
    memcpy(line + LENGTH / 2, "HERE", 4);
    begin(&f, line);
    diagnose(&f.diagnostics, DIAG_E0015, find(&f, "HERE"));
    CHECK_TEXT(
        printed(&f, plain),
        "house.pcg:1:5000001: error: the attribute lacks its '@' [E0015]\n"
        "    1 | …xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxHERE"
        "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx…\n"
        "      |                                                                        ^~~~\n");
    end(&f);
    free(line);
}

static void sorts_by_file_and_place(void)
{
    fixture f;
    begin(&f, "one two three\n");
    source *early = source_new(&f.arena, "a.pcg", "x\n", 2);
    diagnose(&f.diagnostics, DIAG_E0102, find(&f, "three"), "three");
    diagnose(&f.diagnostics, DIAG_E0102, find(&f, "one"), "one");
    diagnose(&f.diagnostics, DIAG_E0102, find(&f, "one"), "one again");
    diagnose(&f.diagnostics, DIAG_E0102, (span){early, 0, 1}, "x");
    diagnose(&f.diagnostics, DIAG_E0102, (span){NULL, 0, 0}, "nowhere");
    CHECK_TEXT(printed(&f, plain), "error: unknown procedure 'nowhere' [E0102]\n"
                                   "a.pcg:1:1: error: unknown procedure 'x' [E0102]\n"
                                   "    1 | x\n"
                                   "      | ^\n"
                                   "house.pcg:1:1: error: unknown procedure 'one' [E0102]\n"
                                   "    1 | one two three\n"
                                   "      | ^~~\n"
                                   "house.pcg:1:1: error: unknown procedure 'one again' [E0102]\n"
                                   "    1 | one two three\n"
                                   "      | ^~~\n"
                                   "house.pcg:1:9: error: unknown procedure 'three' [E0102]\n"
                                   "    1 | one two three\n"
                                   "      |         ^~~~~\n");
    end(&f);
}

static void keeps_a_limit(void)
{
    fixture f;
    begin(&f, "x\n");
    f.diagnostics.limit = 2;
    for (int i = 0; i < 5; i++)
        diagnose(&f.diagnostics, DIAG_E0102, (span){NULL, 0, 0}, "x")->help = "help";
    CHECK_INTEGER(f.diagnostics.errors, 5);
    CHECK_INTEGER(f.diagnostics.list.count, 2);
    CHECK_TEXT(printed(&f, plain), "error: unknown procedure 'x' [E0102]\n"
                                   "      = help: help\n"
                                   "error: unknown procedure 'x' [E0102]\n"
                                   "      = help: help\n"
                                   "3 more are not shown\n");
    end(&f);
}

static void prints_json(void)
{
    fixture f;
    begin(&f, "a\n  ä -> \"b\"\n");
    diagnostic *d = diagnose(&f.diagnostics, DIAG_E0102, find(&f, "->"), "q\"\x01");
    d->text = "label";
    d->second = (diagnostic_label){find(&f, "a"), "other"};
    d->help = "do this";
    diagnose(&f.diagnostics, DIAG_E0102, (span){NULL, 0, 0}, "x");
    CHECK_TEXT(
        printed(&f, diagnostics_print_json),
        "{\"severity\": \"error\", \"code\": \"E0102\", \"message\": \"unknown procedure 'x'\"}\n"
        "{\"severity\": \"error\", \"code\": \"E0102\", \"message\": \"unknown procedure "
        "'q\\\"<01>'\", "
        "\"file\": \"house.pcg\", \"line\": 2, \"column\": 5, \"endLine\": 2, \"endColumn\": 7, "
        "\"label\": \"label\", \"related\": [{\"severity\": \"note\", \"file\": \"house.pcg\", "
        "\"line\": 1, "
        "\"column\": 1, \"endLine\": 1, \"endColumn\": 2, \"label\": \"other\"}], \"help\": \"do "
        "this\"}\n");
    end(&f);
}

int main(void)
{
    finds_places();
    reads_files();
    prints_carets_and_label();
    prints_two_places_of_a_line();
    prints_second_places_elsewhere();
    prints_what_is_not_ascii();
    cuts_long_lines();
    sorts_by_file_and_place();
    keeps_a_limit();
    prints_json();
    return unit_done();
}

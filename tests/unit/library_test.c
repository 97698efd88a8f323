/* library_test.c - libraries in scope: homonyms, names from before a rename, derived entity types,
 * what a message suggests for them; and interfaces that are wrong. */
#include <setjmp.h>
#include <string.h>

#include "../../compiler/compiler.h"
#include "unit.h"

static const library_file files[] = {
    {"zoning/zone.c", 4,
     "/// A part of a town.\n"
     "entity Zone: Shape\n"
     "/// A part of a zone.\n"
     "entity Plot: Zone\n"
     "/// Makes a zone of a shape.\n"
     "procedure zone(in: Shape) -> (out: Zone) [pure, one_to_one] {\n"
     "    formerly area_of_town, quarter\n"
     "    param density: ratio = 50% range [0%, 100%]\n"
     "}\n"
     "procedure develop(in: Zone) -> (out: Shape) [pure] { }\n"
     "procedure log(in: Zone) -> (out: Zone) [effect] { }\n"},
    {"zoning/wrong.c", 1,
     "entity Snake: Tail\n"
     "entity Tail: Snake\n"
     "procedure wrong(in: Shpae) -> (out: Snake) [pure] { param amount: length = 1deg }\n"}};

static const library_entry entries[] = {{"Plot", ENTRY_ENTITY, 0, NULL},
                                        {"Snake", ENTRY_ENTITY, 1, NULL},
                                        {"Tail", ENTRY_ENTITY, 1, NULL},
                                        {"Zone", ENTRY_ENTITY, 0, NULL},
                                        {"area_of_town", ENTRY_PROCEDURE, 0, "zone"},
                                        {"develop", ENTRY_PROCEDURE, 0, NULL},
                                        {"log", ENTRY_PROCEDURE, 0, NULL},
                                        {"quarter", ENTRY_PROCEDURE, 0, "zone"},
                                        {"wrong", ENTRY_PROCEDURE, 1, NULL},
                                        {"zone", ENTRY_PROCEDURE, 0, NULL}};

static const pcg_library zoning = {.abi = PCG_ABI,
                                   .size = sizeof(pcg_library),
                                   .name = "zoning",
                                   .files = files,
                                   .entries = entries,
                                   .file_count = COUNT_OF(files),
                                   .entry_count = COUNT_OF(entries)};

static const pcg_library *const libraries[] = {&zoning, NULL};

/* What compiling a graph's statements says, as text in the arena of `c`, "" where it says nothing.
 */
static const char *messages(compilation *c, const char *statements)
{
    text out = {.arena = &c->arena};
    c->diagnostics = (diagnostics){.arena = &c->arena};
    c->libraries = libraries;
    const char *program_text = arena_format(&c->arena, "graph g {\n%s\n}\n", statements);
    compile_front(c, source_new(&c->arena, "g.pcg", program_text, strlen(program_text)));
    text_add(&out, "");
    for (uint32_t i = 0; i < c->diagnostics.list.count; i++)
        diagnostic_write(&c->diagnostics.list.at[i], false, &out);
    return out.at;
}

static void test_names(compilation *c)
{
    CHECK_TEXT(messages(c, "rectangle() -> zone() -> develop()"), "");
    CHECK_TEXT(messages(c, "rectangle() -> zoning.zone() -> zoning.log() -> core.log()"), "");
    CHECK_PART(messages(c, "rectangle() -> log()"),
               "g.pcg:2:16: error: 'log' is in the libraries 'core' and 'zoning' [E0109]");
    CHECK_PART(messages(c, "rectangle() -> log()"), "= help: write core.log()");
    CHECK_PART(messages(c, "rectangle() -> quarter()"),
               "g.pcg:2:16: warning: 'quarter' is called 'zone' today [W0505]");
    CHECK_PART(messages(c, "rectangle() -> zoning.area_of_town()"), "[W0505]");
    CHECK_PART(messages(c, "rectangle() -> quarte()"), "error: unknown procedure 'quarte' [E0102]");
    CHECK_PART(messages(c, "rectangle() -> zoning.zon()"), "did you mean 'zone'?");
}

static void test_types(compilation *c)
{
    CHECK_PART(messages(c, "rectangle() -> develop()"),
               "'rectangle' gives Shape, 'develop' takes Zone [E0301]");
    CHECK_PART(messages(c, "rectangle() -> develop()"), "= help: insert zone()");
    CHECK_TEXT(messages(c, "in plot: Plot\nplot -> develop()\nplot -> extrude()"), "");
    CHECK_PART(messages(c, "in zone: Zone\nin plot: Plot\nzone -> all: reverse()\nplot -> all\n"
                           "out plots: Plot\nall -> plots"),
               "'all' gives Zone, 'plots' takes Plot [E0301]");
    CHECK_PART(messages(c, "in plot: Plto\nplot -> develop()"), "did you mean 'Plot'?");
}

static void test_parameters(compilation *c)
{
    CHECK_PART(messages(c, "rectangle() -> zone(density = 1.5)"),
               "'density' = 150% is not in the range from 0% to 100% [E0506]");
    CHECK_TEXT(messages(c, "param d: ratio = 20%\nrectangle() -> zone(density = d * 2)"), "");
}

/* The place is that in the kernel's file. */
static void test_wrong_interface(compilation *c)
{
    const char *said = messages(c, "rectangle() -> wrong()");
    CHECK_PART(said, "zoning/wrong.c:3:21: error: unknown type 'Shpae' [E0105]");
    CHECK_PART(said, "error: entity type 'Snake' derives from itself [E0121]");
    CHECK_PART(said, "zoning/wrong.c:3:76: error: found angle, 'amount' takes length [E0201]");
    CHECK_TEXT(messages(c, "rectangle() -> zone()"), "");
}

int main(void)
{
    compilation c = {0};
    jmp_buf out_of_memory;
    if (setjmp(out_of_memory)) {
        puts("not ok memory");
        return 1;
    }
    c.arena.on_failure = &out_of_memory;
    test_names(&c);
    test_types(&c);
    test_parameters(&c);
    test_wrong_interface(&c);
    arena_free(&c.arena);
    return unit_done();
}

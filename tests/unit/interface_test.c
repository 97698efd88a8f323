/* interface_test.c - blocks are found, names become C names, and interfaces become C. */
#include <stdlib.h>
#include <string.h>

#include "../../runtime/library_open.h"
#include "../../interface/interface.h"

static unsigned passed, failed;

static void expect(bool holds, const char *what)
{
    passed += holds;
    failed += !holds;
    if (!holds)
        printf("not so: %s\n", what);
}

static void expect_text(const char *what, const char *found, const char *expected)
{
    bool same = found && strcmp(found, expected) == 0;
    passed += same;
    failed += !same;
    if (!same)
        printf("%s:\n--- found\n%s\n--- expected\n%s\n", what, found ? found : "(NULL)", expected);
}

/* ---- blocks ---------------------------------------------------------------------------------- */

static void expect_block(arena *a, const char *file, const char *expected, uint32_t expected_line)
{
    const char *block = NULL;
    uint32_t line = 0;
    const source *s = source_new(a, "x.c", file, strlen(file));
    bool found = interface_extract(a, s, &block, &line);
    expect(found == (expected != NULL), file);
    if (found && expected) {
        expect_text(file, block, expected);
        expect(line == expected_line, file);
    }
}

static void test_blocks(arena *a)
{
    expect_block(a, "", NULL, 0);
    expect_block(a, "int x;\n", NULL, 0);
    expect_block(a, "/*pcg\nx\n*/\n", "x\n", 2);
    expect_block(a, "/*pcg  \r\nx\n*/\n", "x\n", 2);
    expect_block(a, "/* licence */\n\n/*pcg\nx\ny\n*/\nint z;\n", "x\ny\n", 4);
    expect_block(a, "/*pcg\nx */\n", "x ", 2);
    /* Other comments, other words and what does not begin its line are no blocks. */
    expect_block(a, "/*pcgen\nx\n*/\n", NULL, 0);
    expect_block(a, "/*pcg x\n*/\n", NULL, 0);
    expect_block(a, " /*pcg\nx\n*/\n", NULL, 0);
    expect_block(a, "/* pcg\nx\n*/\n", NULL, 0);
    /* Ends of files in unhappy places. */
    expect_block(a, "/*pcg", "", 2);
    expect_block(a, "/*pcg\n", "", 2);
    expect_block(a, "/*pcg\nx", "x", 2);
    expect_block(a, "/*pcg\nx*", "x*", 2);
}

/* ---- names ----------------------------------------------------------------------------------- */

static void test_names(arena *a)
{
    expect_text("field", interface_field(a, "amount"), "amount");
    expect_text("keyword", interface_field(a, "case"), "case_");
    expect_text("last keyword", interface_field(a, "while"), "while_");
    expect_text("first keyword", interface_field(a, "NULL"), "NULL_");
    expect_text("macro", interface_field(a, "bool"), "bool_");
    expect_text("blank", interface_field(a, "roof tile"), "roof_20tile");
    expect_text("umlaut", interface_field(a, "t\xc3\xbcr"), "t_c3_bcr");
    expect_text("digit", interface_field(a, "2nd"), "_2nd");
    expect_text("symbol", interface_procedure_symbol(a, "geometry", "split"), "pcg_geometry_split");
    expect_text("enumerator", interface_constant(a, "RoofKind", "half_hip"),
                "PCG_ROOF_KIND_HALF_HIP");
    expect_text("enumerator", interface_constant(a, "Axis", "x"), "PCG_AXIS_X");
    expect_text("kind", interface_kind_constant(a, "core", "order_by", "ascending"),
                "PCG_CORE_ORDER_BY_ASCENDING");
}

/* ---- C --------------------------------------------------------------------------------------- */

static bool is_enumeration(void *context, const char *name)
{
    (void)context;
    return strcmp(name, "Axis") == 0;
}

static bool is_entity(void *context, const char *name)
{
    (void)context;
    return strcmp(name, "Entity") == 0 || strcmp(name, "Shape") == 0 || strcmp(name, "Image") == 0;
}

static const interface_types types = {NULL, is_enumeration, is_entity};

static const tree_item *parse(arena *a, const char *interface)
{
    diagnostics d = {.arena = a};
    const tree_file *f = lang_parse(a, source_new(a, "x.pcg", interface, strlen(interface)), &d);
    if (d.errors > 0 || f->items.count == 0) {
        diagnostics_print(&d, stdout, false);
        puts("the test's own interface does not parse");
        exit(1);
    }
    return &f->items.at[0];
}

static void expect_procedure(arena *a, const char *interface, const char *expected)
{
    text out = {.arena = a};
    interface_write_procedure(&out, "lib", parse(a, interface)->procedure, "", &types);
    expect_text(interface, out.at, expected);
}

static void expect_function(arena *a, const char *interface, const char *expected)
{
    text out = {.arena = a};
    interface_write_function(&out, "lib", parse(a, interface)->function, "", &types);
    expect_text(interface, out.at, expected);
}

static void test_procedures(arena *a)
{
    expect_procedure(a, "procedure nothing() { }",
                     "struct pcg_lib_nothing {\n    pcg_instance instance;\n};\n"
                     "int pcg_lib_nothing(pcg_call *call, struct pcg_lib_nothing *node);\n");
    expect_procedure(a,
                     "procedure p<T: Entity, S: Shape>(a: Shape, b: Image, c: T, d: S, e: Shape[]) "
                     "-> (out: T) {\n"
                     "  param one: bool\n  param two: int\n"
                     "  param three: length\n  param four: path\n"
                     "  param five: vec3\n  param six: quaternion\n  param seven: color\n"
                     "  param eight: list<int>\n  param nine: Axis\n  param ten: attribute\n"
                     "  param eleven: any\n  attr twelve: int\n}",
                     "struct pcg_lib_p {\n    pcg_instance instance;\n"
                     "    pcg_shape *a;\n    pcg_entity *b;\n"
                     "    pcg_entity *c;\n    pcg_shape *d;\n"
                     "    pcg_entities e;\n    int one;\n    pcg_int two;\n    double three;\n"
                     "    const char *four;\n    pcg_vec3 five;\n"
                     "    pcg_vec4 six;\n    pcg_color seven;\n"
                     "    const pcg_list *eight;\n    int nine;\n"
                     "    pcg_slot ten;\n    pcg_any eleven;\n"
                     "    pcg_slot twelve;\n    const pcg_port *out;\n};\n"
                     "int pcg_lib_p(pcg_call *call, struct pcg_lib_p *node);\n");
    expect_procedure(a,
                     "procedure q(in: Shape) {\n"
                     "  augment size(value: length, attr index: int) -> Shape\n"
                     "  augment rest() -> Shape\n}",
                     "enum {\n    PCG_LIB_Q_SIZE,\n    PCG_LIB_Q_REST\n};\n"
                     "struct pcg_lib_q {\n    pcg_instance instance;\n    pcg_shape *in;\n"
                     "    struct pcg_lib_q_item {\n        int kind;\n        const char *name;\n"
                     "        const pcg_port *port;\n        struct {\n            double value;\n"
                     "            pcg_slot index;\n        } size;\n    } *items;\n"
                     "    pcg_u32 item_count;\n};\n"
                     "int pcg_lib_q(pcg_call *call, struct pcg_lib_q *node);\n");
    expect_procedure(a, "procedure r(in: Shape) {\n  augment more() <- Shape[]\n}",
                     "enum {\n    PCG_LIB_R_MORE\n};\n"
                     "struct pcg_lib_r {\n    pcg_instance instance;\n    pcg_shape *in;\n"
                     "    struct pcg_lib_r_item {\n        int kind;\n        const char *name;\n"
                     "        pcg_entities input;\n    } *items;\n    pcg_u32 item_count;\n};\n"
                     "int pcg_lib_r(pcg_call *call, struct pcg_lib_r *node);\n");
}

static void test_functions(arena *a)
{
    expect_function(a, "function min(a: int, b: int) -> int",
                    "pcg_int pcg_lib_fn_min_int_int(pcg_call *call, pcg_int a, pcg_int b);\n");
    expect_function(a, "function f() -> string", "const char *pcg_lib_fn_f(pcg_call *call);\n");
    expect_function(a, "function area(s: Shape) -> area",
                    "double pcg_lib_fn_area_Shape(pcg_call *call, const pcg_shape *s);\n");
    expect_function(a, "function same<T: Entity>(a: T, b: T) -> bool",
                    "int pcg_lib_fn_same_Entity_Entity(pcg_call *call, const pcg_entity *a, "
                    "const pcg_entity *b);\n");
    expect_function(a, "function cross(a: vec3, b: vec3) -> vec3",
                    "void pcg_lib_fn_cross_vec3_vec3(pcg_call *call, const pcg_vec3 *a, "
                    "const pcg_vec3 *b, pcg_vec3 *result);\n");
    expect_function(a, "function rand(low: float) -> float [random]",
                    "double pcg_lib_fn_rand_float(pcg_call *call, pcg_u32 site, double low);\n");
    expect_function(a, "function format(pattern: string, values: any[]) -> string",
                    "const char *pcg_lib_fn_format_string_anys(pcg_call *call, "
                    "const char *pattern, "
                    "const pcg_any *values, pcg_u32 values_count);\n");
    expect_function(a, "function sum(l: list<int>, axis: Axis) -> int",
                    "pcg_int pcg_lib_fn_sum_list_int_Axis(pcg_call *call, "
                    "const pcg_list *l, int axis);\n");
}

static void test_enumerations(arena *a)
{
    text out = {.arena = a};
    interface_write_enumeration(&out, "lib", parse(a, "enum Axis { x, y }")->enumeration);
    expect_text("enumeration", out.at, "enum {\n    PCG_AXIS_X,\n    PCG_AXIS_Y\n};\n");
}

/* ---- libraries ------------------------------------------------------------------------------- */

static void test_libraries(void)
{
    for (const pcg_library *const *l = library_builtin; *l; l++) {
        for (uint32_t i = 0; i < (*l)->entry_count; i++) {
            const library_entry *e = &(*l)->entries[i];
            const library_entry *first = library_find(*l, e->name, e->kind);
            bool same = first && strcmp(first->name, e->name) == 0 && first->kind == e->kind;
            expect(same && first <= e, e->name);
            expect(e->file < (*l)->file_count, e->name);
        }
        for (uint32_t i = 0; i < (*l)->symbol_count; i++) {
            const library_symbol *s = &(*l)->symbols[i];
            expect(library_find_symbol(*l, s->name) == s, s->name);
        }
        expect(!library_find(*l, "", ENTRY_PROCEDURE), "no entry without a name");
        expect(!library_find(*l, "~", ENTRY_FUNCTION), "no entry behind the last");
        expect(!library_find_symbol(*l, "pcg_no_such_kernel"), "no such symbol");
    }
    for (uint32_t i = 1; i < pcg_abi_symbol_count; i++)
        expect(strcmp(pcg_abi_symbols[i - 1].name, pcg_abi_symbols[i].name) < 0,
               pcg_abi_symbols[i].name);
    expect(strstr(pcg_abi_text, "#define PCG_ABI ") != NULL, "the text of abi.h");
}

int main(void)
{
    arena a = {0};
    jmp_buf no_memory;
    if (setjmp(no_memory))
        return 1;
    a.on_failure = &no_memory;
    test_blocks(&a);
    test_names(&a);
    test_procedures(&a);
    test_functions(&a);
    test_enumerations(&a);
    test_libraries();
    arena_free(&a);
    printf("%u passed, %u failed\n", passed, failed);
    return failed > 0;
}

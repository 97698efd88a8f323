/* lang_write.c - what the parser reads is written back as it means. */
#include "../../lang/lang.h"

#include "unit.h"

/* Parses `const x = …` and writes the expression. */
static void check(const char *written, const char *expected)
{
    arena a = {0};
    jmp_buf failed;
    if (setjmp(failed)) {
        CHECK(!"memory");
        arena_free(&a);
        return;
    }
    a.on_failure = &failed;
    diagnostics d = {.arena = &a};
    text t = {.arena = &a};
    const char *content = arena_format(&a, "graph g { const x = %s\n}\n", written);
    const tree_file *f = lang_parse(&a, source_new(&a, "x.pcg", content, strlen(content)), &d);
    CHECK_INTEGER(d.errors, 0);
    if (!d.errors)
        lang_write_expression(f->items.at[0].graph->members.at[0]->parameter->initial, &t);
    CHECK_TEXT(t.at, expected);
    arena_free(&a);
}

static void same(const char *written)
{
    check(written, written);
}

static void writes_literals(void)
{
    same("1");
    same("9223372036854775807");
    same("1.5");
    check("2e3", "2000.0");
    check(".5", "0.5");
    same("1e+22");
    same("8m");
    check("250mm", "0.25m");
    check("1.5km", "1500m");
    check("1cm", "0.01m");
    same("12m2");
    same("30deg");
    check("1h", "3600s");
    check("90ms", "0.09s");
    same("7%");
    same("33.3%");
    same("0.1%");
    same("true");
    same("#8a5a2b");
    same("#8a5a2b80");
    check("#f80", "#ff8800");
    same("\"a\\\"b\\\\\\n\\u0001 é\"");
    check("\"\\u00e9\\ud83c\\udfe0\"", "\"é🏠\"");
    same("[]");
    same("[1, [2, 3], \"x\"]");
}

static void writes_names(void)
{
    same("in");
    same("'two words'");
    same("'if'");
    check("'plain'", "plain");
    same("@floor");
    same("in@floor");
    same("'a b'@'c d'.x");
    same("a.b.c");
    check("@{my param}", "'my param'");
    check("${port}", "port");
    check("${port}{direction}.X", "port@direction.x");
    check("${port}{direction}.Length()", "length(port@direction)");
    check("Math.Min(1, 2)", "min(1, 2)");
    check("Vector3D.New(1, 2, 3)", "vec3(1, 2, 3)");
    check("Shape.IsShapeEntity(${in})", "is_shape_entity(in)");
    same("core.min(a, b)");
    same("rand()");
}

/* Parentheses stay where they were written, and are not needed anywhere else. */
static void writes_operators(void)
{
    same("a + b * c - d / e % f");
    same("(a + b) * c");
    same("a - (b - c)");
    same("(a * b) + c");
    same("a << 1 | b >> 2 & 3 ^ 4");
    same("a < b == c >= d != e <= f > g");
    same("a && b || !c && ~d == -e");
    same("a ? b : c ? d : e");
    same("(a ? b : c) ? d : e");
    same("a ? b ? c : d : e");
    same("--a");
    check("+a", "a");
    same("-(a + b).x");
    check("50% + 7 % 3 - 7%3", "50% + 7 % 3 - 7 % 3");
    check("a<-b", "a < -b");
}

int main(void)
{
    writes_literals();
    writes_names();
    writes_operators();
    return unit_done();
}

/* lang_hints.c - what a message about syntax advises: its label, or its help. */
#include "../../lang/lang.h"

#include "unit.h"

/* The first message on `line`, which stands within a graph (or alone, where it begins with '!'). */
static void check(const char *line, const char *expected)
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
    const char *content =
        *line == '!' ? line + 1 : arena_format(&a, "graph g {\n    %s\n}\n", line);
    lang_parse(&a, source_new(&a, "x.pcg", content, strlen(content)), &d);
    CHECK(d.list.count > 0);
    if (!d.list.count)
        printf("    nothing was said about: %s\n", line);
    if (d.list.count) {
        const diagnostic *first = &d.list.at[0];
        const char *advice = first->text   ? first->text
                             : first->help ? first->help
                                           : first->second.text;
        CHECK_TEXT(advice, expected);
    }
    arena_free(&a);
}

static void about_words(void)
{
    check("parm a: int", "did you mean 'param' instead of 'parm'?");
    check("hiden param a: int", "did you mean 'hidden' instead of 'hiden'?");
    check("hidden a: int", "write hidden param");
    check("param true: int", "this word is reserved; as a name it is written in quotes: 'true'");
    check("!grpah g { }", "did you mean 'graph'?");
    check("!improt a from \"b\"", "did you mean 'import'?");
    check("!import \"x.pcg\"", "write import graph from \"file.pcg\"");
    check("graph inner {", "a graph stands beside other graphs, not in one");
    check("käse -> b", "written in quotes, a name may hold any letter: 'like this'");
}

static void about_declarations(void)
{
    check("param a = 8m", "the type comes first: name: type = value");
    check("param a: = 8m", "a type stands between ':' and '='");
    check("const a: int = 3", "a constant has the type of its value: const name = value");
    check("a = 3", "a value is declared: const name = value, or param name: type = value");
    check("out a: Shape = b",
          "'= *' gathers what is left; an edge leads to an output from a line of its own: "
          "node -> output");
}

static void about_arguments(void)
{
    check("a -> b(c 2m)", "an argument is written name = value; ',' separates arguments");
    check("a -> b(c: 2m)", "an argument is written name = value");
    check("a -> b(c = 1 d = 2)", "',' separates arguments");
    check("a -> b(c = 1; d = 2)", "between parentheses, ',' separates");
    check("a -> b(c => floor)", "write '@floor'");
    check(
        "a -> b(c -> @floor)",
        "a link to an attribute of the graph is written name => @attribute or name <=> @attribute");
    check("a -> b(c = 1 + 2", "')' is missing here");
    check("a -> b(c = [1, 2", "']' is missing here");
    check("a -> b { c, d }", "statements and augmentations are separated by ';' or by line ends");
}

static void about_expressions(void)
{
    check("a -> b if c = d", "'==' compares");
    check("a -> b if c and d", "write '&&'");
    check("a -> b if c or d", "write '||'");
    check("const a = b mod c", "write '%'");
    check("const a = 1 +", "an expression goes on in the next line only between parentheses");
    check("const a = 3 + 4metre", "units are mm cm m km, m2, deg rad, %, ms s min h");
    check("const a = 4dge", "did you mean 'deg'?");
    check("const a = \"\\q\"", "escapes are \\n \\r \\t \\\" \\' \\\\ \\/ and \\uXXXX");
    check("const a = (b).c(1)", "write c(…) with the value as its first argument");
    check("/* a */", "comments begin with // and end with the line");
}

static void about_chains(void)
{
    check("a ->\n    b", "an arrow at the beginning of a line goes on with the line before");
    check("a => b", "an edge is written '->'");
    check("a - > b", "an edge is written '->'");
    check("; -> b", "a chain begins with a node or a gate");
}

/* What was meant is one mistake, and the rest is read: exactly the messages that are due come. */
static void check_count(const char *content, uint32_t expected)
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
    const tree_file *f = lang_parse(&a, source_new(&a, "x.pcg", content, strlen(content)), &d);
    CHECK_INTEGER(d.errors, expected);
    CHECK(f != NULL);
    arena_free(&a);
}

int main(void)
{
    about_words();
    about_declarations();
    about_arguments();
    about_expressions();
    about_chains();
    check_count("", 0);
    check_count("graph a { b -> c( }\ngraph d { e => f }\n", 2);
    check_count("graph a {\n b -> c(\n d -> e\n\n", 2);
    check_count("graph a { b -> c }}}\n", 2);
    return unit_done();
}

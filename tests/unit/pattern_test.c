/* pattern_test.c - regular expressions: what matches, what is none, and that time stays bounded. */
#include <setjmp.h>
#include <string.h>

#include "../../runtime/base/base.h"
#include "unit.h"

enum { LONG = 20000 };

static void test_matches(arena *a)
{
    static const struct {
        const char *expression, *matched, *other;
    } cases[] = {
        {"abc", "abc", "abcd"},
        {"", "", "x"},
        {"a*", "", "b"},
        {"a+", "aaa", ""},
        {"a|b|cd", "cd", "c"},
        {"(a|b)*c", "ababc", "abab"},
        {"x(a|)y", "xy", "xby"},
        {"(|a)+", "aa", "b"},
        {"(ab){2,3}", "ababab", "ab"},
        {"(ab){2,3}", "abab", "abababab"},
        {"a{3,}", "aaaa", "aa"},
        {"a{0,2}", "aa", "aaa"},
        {"a{0}", "", "a"},
        {"((a|b)c?){2}x", "acbx", "acx"},
        {"(a*)*b", "aab", "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaac"},
        {"[a-c]+x?", "abcx", "d"},
        {"[^a-c]", "d", "a"},
        {"[]a]", "]", "b"},
        {"[a\\]-]+", "a]-", "b"},
        {"\\d+\\.\\w+", "12.jpg", "12xjpg"},
        {"[\\d\\s]+", "1 2", "a"},
        {"^a$", "a", "aa"},
        {".", "\u00e4", "ab"},
        {"[\u00e4-\u00fc]", "\u00f6", "o"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const char *error;
        const pattern *p = pattern_new(a, cases[i].expression, &error);
        CHECK_TEXT(error, NULL);
        CHECK(p && pattern_matches(a, p, cases[i].matched));
        CHECK(p && !pattern_matches(a, p, cases[i].other));
    }
}

static void test_errors(arena *a)
{
    static const struct {
        const char *expression, *error;
    } cases[] = {
        {"(", "'(' is never closed"},
        {"a)", "')' closes nothing"},
        {"[a", "'[' is never closed"},
        {"*", "there is nothing to repeat"},
        {"a{", "'{' lacks its number"},
        {"a{2", "'{' is never closed"},
        {"a{3,2}", "a count in {…} goes backwards"},
        {"a{9999}", "it repeats too often"},
        {"[b-a]", "a range in […] goes backwards"},
        {"\\q", "a letter or digit behind the backslash means nothing"},
        {"a\\", "it ends with a backslash"},
        {"((((a{100}){100}){100}){100})", "it is too large"},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const char *error = NULL;
        CHECK(!pattern_new(a, cases[i].expression, &error));
        CHECK_TEXT(error, cases[i].error);
    }
}

static void test_depth(arena *a)
{
    char nested[LONG + 1];
    const char *error = NULL;
    memset(nested, '(', LONG);
    nested[LONG] = '\0';
    CHECK(!pattern_new(a, nested, &error));
    CHECK_TEXT(error, "its groups are nested too deep");
}

/* Where a matcher that tries one way after the other needs longer than the world is old. */
static void test_time(arena *a)
{
    char letters[LONG + 2];
    const char *error;
    memset(letters, 'a', LONG);
    strcpy(letters + LONG, "b");
    CHECK(!pattern_matches(a, pattern_new(a, "(a|a)*(a?){20}(a*)*c", &error), letters));
    CHECK(pattern_matches(a, pattern_new(a, "(a|a)*(a?){20}(a*)*b", &error), letters));
}

int main(void)
{
    arena a = {0};
    jmp_buf out_of_memory;
    if (setjmp(out_of_memory)) {
        puts("not ok memory");
        return 1;
    }
    a.on_failure = &out_of_memory;
    test_matches(&a);
    test_errors(&a);
    test_depth(&a);
    test_time(&a);
    arena_free(&a);
    return unit_done();
}

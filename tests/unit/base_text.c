/* base_text.c - growing strings, numbers to text and back in any locale, tables, names that are
 * near. */
#include "../../runtime/base/base.h"

#include <float.h>
#include <locale.h>
#include <math.h>

#include "unit.h"

static void adds(void)
{
    arena a = {0};
    text t = {.arena = &a};
    text_add(&t, "");
    CHECK_TEXT(t.at, "");
    text_add(&t, "one");
    text_add_bytes(&t, " two three", 4);
    text_format(&t, " %d %s", 3, "four");
    CHECK_TEXT(t.at, "one two 3 four");
    for (int i = 0; i < 1000; i++)
        text_add(&t, "0123456789");
    CHECK_INTEGER(t.length, 10014);
    CHECK_INTEGER(strlen(t.at), 10014);
    arena_free(&a);
}

static void quotes(void)
{
    arena a = {0};
    text t = {.arena = &a};
    text_quote(&t, "a\"b\\c\nd\te\x01\x7f é");
    CHECK_TEXT(t.at, "\"a\\\"b\\\\c\\nd\\te\\u0001\\u007f é\"");
    arena_free(&a);
}

/* Without memory a text stays as it is. */
static void leaves_out_what_finds_no_memory(void)
{
    arena a = {.limit = 1};
    text t = {.arena = &a};
    text_add(&t, "some");
    text_format(&t, "%d", 1);
    CHECK(t.at == NULL && t.length == 0);
    arena_free(&a);
}

static void check_number(double value, const char *expected)
{
    arena a = {0};
    text t = {.arena = &a};
    const char *end;
    text_number(&t, value);
    CHECK_TEXT(t.at, expected);
    CHECK(number_read(t.at, &end) == value);
    CHECK(*end == '\0');
    arena_free(&a);
}

static void writes_numbers(void)
{
    check_number(0, "0");
    check_number(-0.0, "-0");
    check_number(3, "3");
    check_number(-1.5, "-1.5");
    check_number(0.1, "0.1");
    check_number(0.1 + 0.2, "0.30000000000000004");
    check_number(1.0 / 3, "0.3333333333333333");
    check_number(1e15, "1000000000000000");
    check_number(1e20, "100000000000000000000");
    check_number(1e21, "1e+21");
    check_number(2.5e22, "2.5e+22");
    check_number(0.000025, "0.000025");
    check_number(2.5e-7, "2.5e-7");
    check_number(DBL_MAX, "1.7976931348623157e+308");
    check_number(DBL_MIN, "2.2250738585072014e-308");
    check_number(5e-324, "5e-324");
}

static void check_not_finite(double value, const char *expected)
{
    arena a = {0};
    text t = {.arena = &a};
    text_number(&t, value);
    CHECK_TEXT(t.at, expected);
    arena_free(&a);
}

static uint64_t next_bits(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static void reads_back_any_double(void)
{
    uint64_t state = 88172645463325252u;
    unsigned wrong = 0;
    for (int i = 0; i < 20000; i++) {
        arena a = {0};
        text t = {.arena = &a};
        uint64_t bits = next_bits(&state);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value))
            continue;
        text_number(&t, value);
        wrong += number_read(t.at, NULL) != value;
        arena_free(&a);
    }
    CHECK_INTEGER(wrong, 0);
}

static void check_read(const char *s, double expected, size_t length)
{
    const char *end;
    CHECK(number_read(s, &end) == expected);
    CHECK_INTEGER(end - s, (long long)length);
}

static void reads_numbers(void)
{
    check_read("12", 12, 2);
    check_read("+1.25x", 1.25, 5);
    check_read("-.5", -0.5, 3);
    check_read("7.", 7, 2);
    check_read("3e2m", 300, 3);
    check_read("3em", 3, 1);
    check_read("1e400", INFINITY, 5);
    check_read("1e-400", 0, 6);
    check_read("1e99999999999999999999", INFINITY, 22);
    check_read("0e99999999999999999999", 0, 22);
    check_read("x", 0, 0);
    check_read(".", 0, 0);
    check_read("-", 0, 0);
    check_read("0x10", 0, 1);
    check_read("inf", 0, 0);
    /* halfway between two doubles, and a hair above, with more digits than a double has */
    check_read("9007199254740993", 9007199254740992.0, 16);
    check_read("9007199254740993.00000000000000000000000000001", 9007199254740994.0, 46);
}

/* More digits than are kept: those behind still count. */
static void reads_long_numbers(void)
{
    char digits[3000] = "9007199254740993.";
    size_t begin = strlen(digits);
    memset(digits + begin, '0', sizeof digits - begin - 1);
    CHECK(number_read(digits, NULL) == 9007199254740992.0);
    digits[sizeof digits - 2] = '1';
    CHECK(number_read(digits, NULL) == 9007199254740994.0);
    memset(digits, '1', 400);
    digits[400] = '\0';
    CHECK(isinf(number_read(digits, NULL)));
}

/* A host may have set a locale whose numbers look different. */
static void minds_no_locale(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "ru_RU.UTF-8"};
    const char *set = NULL;
    for (size_t i = 0; i < COUNT_OF(names) && !set; i++)
        set = setlocale(LC_ALL, names[i]);
    if (!set) {
        printf("no locale with a decimal comma is installed: not checked in one\n");
        return;
    }
    writes_numbers();
    reads_numbers();
    setlocale(LC_ALL, "C");
}

static void tables_find(void)
{
    arena a = {0};
    table t = {0};
    int values[500];
    bool found = true;
    CHECK(table_get(&t, "x") == NULL);
    for (int i = 0; i < 500; i++)
        table_put(&a, &t, arena_format(&a, "key %d", i), &values[i]);
    for (int i = 0; i < 500; i++)
        found = found && table_get(&t, arena_format(&a, "key %d", i)) == &values[i];
    CHECK(found);
    CHECK(table_get(&t, "key 500") == NULL);
    CHECK(table_get(&t, "") == NULL);
    table_put(&a, &t, "key 7", &values[0]);
    CHECK(table_get(&t, "key 7") == &values[0]);
    CHECK_INTEGER(t.entries.count, 500);
    CHECK_TEXT(t.entries.at[3].key, "key 3"); /* in order of insertion */
    arena_free(&a);
}

static void finds_near_names(void)
{
    static const char *const names[] = {"log", "extrude", "shed_roof", "split", "area", "x"};
    size_t count = COUNT_OF(names);
    CHECK_TEXT(nearest_name("lgo", names, count), "log");
    CHECK_TEXT(nearest_name("extrud", names, count), "extrude");
    CHECK_TEXT(nearest_name("shedRoof", names, count), "shed_roof");
    CHECK_TEXT(nearest_name("Area", names, count), "area");
    CHECK_TEXT(nearest_name("X", names, count), "x");
    CHECK_TEXT(nearest_name("banana", names, count), NULL);
    CHECK_TEXT(nearest_name("y", names, count), NULL);
    CHECK_TEXT(nearest_name("", names, count), NULL);
    CHECK_TEXT(nearest_name("log", names, 0), NULL);
    char huge[5000];
    memset(huge, 'a', sizeof huge);
    huge[sizeof huge - 1] = '\0';
    CHECK_TEXT(nearest_name(huge, names, count), NULL);
}

int main(void)
{
    adds();
    quotes();
    leaves_out_what_finds_no_memory();
    writes_numbers();
    check_not_finite(INFINITY, "inf");
    check_not_finite(-INFINITY, "-inf");
    check_not_finite(NAN, "nan");
    reads_back_any_double();
    reads_numbers();
    reads_long_numbers();
    minds_no_locale();
    tables_find();
    finds_near_names();
    return unit_done();
}

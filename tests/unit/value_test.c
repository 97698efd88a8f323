/* value_test.c - values as the language writes them, as JSON, and read back. */
#include "tests/unit/unit.h"
#include "tests/api/trouble.h"
#include "runtime/run.h"
#include "runtime/value.h"

static pcg_run *run;

/* Reads a value and writes it both ways. */
static void round_trip(value_type t, const char *from, const char *written, const char *json)
{
    arena a = {0};
    text plain = {.arena = &a}, quoted = {.arena = &a};
    char why[VALUE_WHY_BYTES];
    pcg_cell cell[4] = {{0}}, again[4] = {{0}};
    CHECK(value_read(run, &t, from, cell, why));
    CHECK_TEXT(why, "");
    value_write(&plain, &t, cell);
    value_write_json(&quoted, &t, cell);
    CHECK_TEXT(plain.at, written);
    CHECK_TEXT(quoted.at, json);
    CHECK(value_read(run, &t, plain.at, again, why) && value_equal(&t, cell, again));
    arena_free(&a);
}

static void every_kind(void)
{
    round_trip((value_type){.kind = PCG_BOOL}, "true", "true", "true");
    round_trip((value_type){.kind = PCG_INT}, "-9223372036854775808", "-9223372036854775808",
               "-9223372036854775808");
    round_trip((value_type){.kind = PCG_FLOAT}, ".1", "0.1", "0.1");
    round_trip((value_type){.kind = PCG_FLOAT}, "-1.5e300", "-1.5e+300", "-1.5e+300");
    round_trip((value_type){.kind = PCG_LENGTH}, "3mm", "0.003m", "0.003");
    round_trip((value_type){.kind = PCG_AREA}, "20m2", "20m2", "20");
    round_trip((value_type){.kind = PCG_ANGLE}, "-30deg", "-30deg", "-30");
    round_trip((value_type){.kind = PCG_RATIO}, "50%", "0.5", "0.5");
    round_trip((value_type){.kind = PCG_SECONDS}, "1.5min", "90s", "90");
    round_trip((value_type){.kind = PCG_STRING}, "two words", "two words", "\"two words\"");
    round_trip((value_type){.kind = PCG_STRING}, "\"tab\\t\\u00e9\\ud83d\\ude00\"",
               "tab\t\xc3\xa9\xf0\x9f\x98\x80", "\"tab\\t\xc3\xa9\xf0\x9f\x98\x80\"");
    round_trip((value_type){.kind = PCG_PATH}, "a/b.jpg", "a/b.jpg", "\"a/b.jpg\"");
    round_trip((value_type){.kind = PCG_VEC2}, "[1,2m]", "vec2(1, 2)", "[1, 2]");
    round_trip((value_type){.kind = PCG_VEC3}, "(1, -2, .5)", "vec3(1, -2, 0.5)", "[1, -2, 0.5]");
    round_trip((value_type){.kind = PCG_VEC4}, "vec4( 1,2 , 3,4 )", "vec4(1, 2, 3, 4)",
               "[1, 2, 3, 4]");
    round_trip((value_type){.kind = PCG_QUATERNION}, "[0, 0, 0, 1]", "quaternion(0, 0, 0, 1)",
               "[0, 0, 0, 1]");
    round_trip((value_type){.kind = PCG_COLOR}, "#F80", "#ff8800", "\"#ff8800\"");
    round_trip((value_type){.kind = PCG_COLOR}, "#ff880080", "#ff880080", "\"#ff880080\"");
    round_trip((value_type){.kind = PCG_ENUM, .enumerators = "left\nright"}, "right", "right",
               "\"right\"");
}

static void lists(void)
{
    round_trip((value_type){.kind = PCG_LIST, .element = PCG_LENGTH}, "[1m, 2, 50cm]",
               "[1m, 2m, 0.5m]", "[1, 2, 0.5]");
    round_trip((value_type){.kind = PCG_LIST, .element = PCG_INT}, "[]", "[]", "[]");
    round_trip((value_type){.kind = PCG_LIST, .element = PCG_STRING}, "[\"a\", \"b, \\\"c\\\"\"]",
               "[\"a\", \"b, \\\"c\\\"\"]", "[\"a\", \"b, \\\"c\\\"\"]");
    round_trip((value_type){.kind = PCG_LIST, .element = PCG_VEC2}, "[[1, 2], vec2(3, 4)]",
               "[vec2(1, 2), vec2(3, 4)]", "[[1, 2], [3, 4]]");
    round_trip((value_type){.kind = PCG_LIST, .element = PCG_COLOR}, "[#fff]", "[#ffffff]",
               "[\"#ffffff\"]");
    round_trip((value_type){.kind = PCG_LIST, .element = PCG_ENUM, .enumerators = "x\ny"}, "[y, x]",
               "[y, x]", "[\"y\", \"x\"]");
}

static void what_no_text_can_be(void)
{
    static const struct {
        int kind;
        const char *text;
    } bad[] = {
        {PCG_INT, "9223372036854775808"},
        {PCG_INT, "1e3"},
        {PCG_INT, "-"},
        {PCG_BOOL, "yes"},
        {PCG_FLOAT, "50%"},
        {PCG_FLOAT, "1 2"},
        {PCG_FLOAT, "inf"},
        {PCG_LENGTH, "1m2"},
        {PCG_AREA, "1m"},
        {PCG_COLOR, "#ff88"},
        {PCG_COLOR, "ff8800"},
        {PCG_COLOR, "#gg8800"},
        {PCG_VEC3, "[1, 2]"},
        {PCG_VEC3, "[1, 2, 3, 4]"},
        {PCG_VEC3, "[1, 2, 3)"},
        {PCG_VEC3, "vec2(1, 2, 3)"},
        {PCG_VEC4, "[1m, 2, 3, 4]"},
        {PCG_STRING, "\"a\" b"},
        {PCG_STRING, "\"\\ud800\""},
        {PCG_STRING, "\"\\u0000\""},
        {PCG_STRING, "\xed\xa0\x80"},
        {PCG_LIST, "[1"},
        {PCG_LIST, "[1,]"},
        {PCG_LIST, "["},
        {PCG_LIST, ""},
    };
    char why[VALUE_WHY_BYTES];
    pcg_cell cell[4];
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        const value_type t = {.kind = bad[i].kind, .element = PCG_INT};
        bool read = value_read(run, &t, bad[i].text, cell, why);
        CHECK(!read);
        if (read)
            printf("  '%s' was read\n", bad[i].text);
        CHECK_PART(why, "takes ");
    }
    const value_type lists_of_lists = {.kind = PCG_LIST, .element = PCG_LIST};
    CHECK(!value_read(run, &lists_of_lists, "[[1]]", cell, why));
}

/* A long value is cut in its message, between characters. */
static void long_values(void)
{
    char value[400], why[VALUE_WHY_BYTES];
    pcg_cell cell[4];
    const value_type t = {.kind = PCG_INT};
    for (size_t i = 0; i + 2 < sizeof value; i += 2)
        memcpy(value + i, "\xc3\xa9", 3);
    CHECK(!value_read(run, &t, value, cell, why));
    CHECK(value_is_utf8(why) && strlen(why) < 140);
}

int main(void)
{
    pcg_program *p = pcg_program_of(&trouble_module);
    run = pcg_run_new(p, NULL);
    every_kind();
    lists();
    what_no_text_can_be();
    long_values();
    pcg_run_free(run);
    pcg_program_free(p);
    return unit_done();
}

/* parameters.c - setting parameters: values of every kind as text, typed setters, every kind of
 * error. */
#include <stdint.h>

#include "tests/unit/unit.h"
#include "toy.h"

static pcg_program *program;
/* What the graph saw of its parameters when it ran. */
static toy seen;

static int remember(pcg_frame *f)
{
    seen = *(const toy *)f;
    return PCG_OK;
}

static void accepts(const char *name, const char *value)
{
    pcg_run *r = pcg_run_new(program, NULL);
    pcg_status status = pcg_run_set(r, name, value);
    CHECK_NUMBER(status, PCG_STATUS_OK);
    if (status != PCG_STATUS_OK)
        printf("  %s = %s: %s\n", name, value, pcg_run_error(r));
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    pcg_run_free(r);
}

static void refuses(const char *name, const char *value, const char *why)
{
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_NUMBER(pcg_run_set(r, name, value), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), why);
    pcg_run_free(r);
}

static void reads_numbers(void)
{
    accepts("count", "12");
    CHECK_NUMBER(seen.count.i, 12);
    CHECK_NUMBER(seen.given[0], 1);
    CHECK_NUMBER(seen.given[1], 0);
    accepts("count", "  +0 ");
    CHECK_NUMBER(seen.count.i, 0);
    accepts("height", "2.5");
    CHECK_NUMBER(seen.height.f, 2.5);
    accepts("height", "2500mm");
    CHECK_NUMBER(seen.height.f, 2.5);
    accepts("height", "250cm");
    CHECK_NUMBER(seen.height.f, 2.5);
    accepts("height", "0.0025km");
    CHECK_NUMBER(seen.height.f, 2.5);
    accepts("odds", "25%");
    CHECK_NUMBER(seen.odds.f, 0.25);
    accepts("odds", "1e-3");
    CHECK_NUMBER(seen.odds.f, 0.001);
}

static void reads_the_rest(void)
{
    accepts("mode", "z");
    CHECK_NUMBER(seen.mode.i, 2);
    accepts("flag", "true");
    CHECK_NUMBER(seen.flag.i, 1);
    accepts("title", "Anna");
    CHECK_NUMBER(seen.given[4], 1);
    accepts("title", "\"Anna\"");
    accepts("title", "\"\\u0041nna\"");
    accepts("picture", "stone.jpg");
    accepts("sizes", "[1, 2.5 ,3]");
    accepts("sizes", "[]");
}

static void refuses_what_does_not_fit(void)
{
    refuses("hight", "3m", "graph 'toy' has no parameter 'hight': did you mean 'height'?");
    refuses("zzzzzz", "3m", "graph 'toy' has no parameter 'zzzzzz'");
    refuses("count", "1.5", "parameter 'count' takes a whole number, not '1.5'");
    refuses("count", "", "parameter 'count' takes a whole number, not ''");
    refuses("count", "12m", "parameter 'count' takes a whole number, not '12m'");
    refuses("count", "99999999999999999999",
            "parameter 'count' takes a whole number of 64 bits, not '99999999999999999999'");
    refuses("height", "tall", "parameter 'height' takes a length, as in 12m, not 'tall'");
    refuses("height", "3 m", "parameter 'height' takes a length, as in 12m, not '3 m'");
    refuses("height", "3xm", "parameter 'height' takes a length, as in 12m, not '3xm'");
    refuses("height", "30deg", "parameter 'height' takes a length, as in 12m; '30deg' is an angle");
    refuses("height", "1e999", "parameter 'height' takes a finite number, not '1e999'");
    refuses("height", "nan", "parameter 'height' takes a length, as in 12m, not 'nan'");
    refuses("odds", "3m", "parameter 'odds' takes a ratio, as in 50% or 0.5; '3m' is a length");
    refuses("mode", "w", "parameter 'mode' takes x, y or z, not 'w'");
    refuses("mode", "x y", "parameter 'mode' takes x, y or z, not 'x y'");
    refuses("flag", "1", "parameter 'flag' takes true or false, not '1'");
    refuses("sizes", "1, 2", "parameter 'sizes' takes a list, as in [1, 2, 3], not '1, 2'");
    refuses("sizes", "[1, 2", "parameter 'sizes' takes a list that ends with ], not '[1, 2'");
    refuses("sizes", "[1, x]", "parameter 'sizes' takes a number, not 'x]'");
    refuses("sizes", "[1] 2", "parameter 'sizes' takes a list, as in [1, 2, 3], not '[1] 2'");
    refuses("title", "\"Anna",
            "parameter 'title' takes a text that ends with its quote, not '\"Anna'");
    refuses(
        "title", "\"A\\q\"",
        "parameter 'title' takes a text with escapes such as \\n, \\\" and \\u00e9, not '\\q\"'");
    refuses("title", "A\xff", "parameter 'title' takes a text in UTF-8, not 'A\xff'");
}

static void keeps_constraints(void)
{
    refuses("height", "11m", "parameter 'height' must be from 1m to 10m, not 11m");
    refuses("height", "0.5", "parameter 'height' must be from 1m to 10m, not 0.5m");
    refuses("count", "-1", "parameter 'count' must be from 0 to 1000000, not -1");
    refuses("title", "anna", "parameter 'title' must match \"[A-Z][a-z]*\", not 'anna'");
    refuses("title", "Annabelle", "parameter 'title' must have at most 6 characters, not 9");
    refuses("picture", "wood.jpg",
            "parameter 'picture' must be one of (brick.jpg, stone.jpg), not wood.jpg");
    refuses("odds", "101%", "parameter 'odds' must be from 0 to 1, not 1.01");
    accepts("height", "1m");
    accepts("height", "10m");
}

static void typed_setters_fit(void)
{
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_NUMBER(pcg_run_set_int(r, "count", 3), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_set_int(r, "height", 3), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_set_float(r, "odds", 0.125), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_set_bool(r, "flag", true), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_set_string(r, "title", "Bea"), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_set_string(r, "mode", "y"), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(seen.count.i, 3);
    CHECK_NUMBER(seen.height.f, 3);
    CHECK_NUMBER(seen.odds.f, 0.125);
    CHECK_NUMBER(seen.flag.i, 1);
    CHECK_NUMBER(seen.mode.i, 1);
    pcg_run_free(r);
}

static void typed_setters_refuse(void)
{
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_NUMBER(pcg_run_set_float(r, "count", 3), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'count' is of type int, not float");
    CHECK_NUMBER(pcg_run_set_int(r, "flag", 1), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'flag' is of type bool, not int");
    CHECK_NUMBER(pcg_run_set_bool(r, "height", true), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'height' is of type length, not bool");
    CHECK_NUMBER(pcg_run_set_string(r, "height", "3m"), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'height' is of type length, not string");
    CHECK_NUMBER(pcg_run_set_float(r, "height", NAN), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'height' takes a finite number");
    CHECK_NUMBER(pcg_run_set_float(r, "height", 0.5), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'height' must be from 1m to 10m, not 0.5m");
    CHECK_NUMBER(pcg_run_set_int(r, "nothing", 1), PCG_STATUS_MISUSE);
    CHECK_NUMBER(pcg_run_set(r, NULL, "1"), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "no parameter is named");
    CHECK_NUMBER(pcg_run_set(r, "height", NULL), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "parameter 'height' needs a value");
    CHECK_NUMBER(pcg_run_set_string(r, "title", NULL), PCG_STATUS_MISUSE);
    CHECK_NUMBER(pcg_run_set_string(r, "title", "\xc0\x80"), PCG_STATUS_MISUSE);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(seen.given[0] + seen.given[1] + seen.given[3] + seen.given[4], 0);
    pcg_run_free(r);
}

int main(void)
{
    pcg_module listening = toy_module;
    listening.run = remember;
    program = pcg_program_of(&listening);
    reads_numbers();
    reads_the_rest();
    refuses_what_does_not_fit();
    keeps_constraints();
    typed_setters_fit();
    typed_setters_refuse();
    pcg_program_free(program);
    return unit_done();
}

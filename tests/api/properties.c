/* properties.c - what a kernel says of the result as a whole: set, changed, read by kernels and by
 * the host, and what cannot be one. */
#include "tests/unit/unit.h"
#include "runtime/result.h"
#include "toy.h"

static pcg_program *program;
static int (*set)(pcg_call *c);

static int run(pcg_frame *f)
{
    toy *g = (toy *)f;
    pcg_call c;
    pcg_begin(&c, f, &toy_nodes[TOY_MAKER], &g->maker_instance);
    return pcg_round(&c, NULL) == PCG_OK ? set(&c) : PCG_FAILED;
}

static int set_several(pcg_call *c)
{
    const pcg_cell latitude = {.f = 47.25}, words = {.s = "a \"b\""}, number = {.i = -3};
    CHECK(!pcg_property_get(c->run, "origin.latitude", PCG_FLOAT));
    PCG_TRY(pcg_property_set(c, "origin.latitude", PCG_INT, &number));
    PCG_TRY(pcg_property_set(c, "other.thing", PCG_INT, &number));
    PCG_TRY(pcg_property_set(c, "origin.crs", PCG_STRING, &words));
    PCG_TRY(pcg_property_set(c, "origin.latitude", PCG_FLOAT, &latitude));
    CHECK(!pcg_property_get(c->run, "origin.latitude", PCG_INT));
    CHECK(pcg_property_get(c->run, "origin.latitude", PCG_FLOAT)->f == 47.25);
    return PCG_OK;
}

static void are_set_and_read(void)
{
    pcg_run *r = pcg_run_new(program, NULL);
    double number = 0;
    arena memory = {0};
    text json = {.arena = &memory};
    set = set_several;
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_property_count(r), 3);
    CHECK_TEXT(pcg_run_property_key(r, 0), "origin.latitude");
    CHECK_TEXT(pcg_run_property_key(r, 2), "origin.crs");
    CHECK(!pcg_run_property_key(r, 3));
    CHECK_TEXT(pcg_run_property(r, "origin.latitude"), "47.25");
    CHECK_TEXT(pcg_run_property(r, "other.thing"), "-3");
    CHECK_TEXT(pcg_run_property(r, "origin.crs"), "a \"b\"");
    CHECK(!pcg_run_property(r, "origin"));
    CHECK_NUMBER(pcg_run_property_float(r, "other.thing", &number), PCG_STATUS_OK);
    CHECK(number == -3);
    CHECK_NUMBER(pcg_run_property_float(r, "origin.crs", &number), PCG_STATUS_MISUSE);
    CHECK_PART(pcg_run_error(r), "property 'origin.crs' is of type string, no number");
    CHECK_NUMBER(pcg_run_property_float(r, "x.y", &number), PCG_STATUS_MISUSE);
    CHECK(result_properties_json(r, &json));
    CHECK_TEXT(json.at, "\"origin\":{\"latitude\":47.25,\"crs\":\"a \\\"b\\\"\"},"
                        "\"other\":{\"thing\":-3}");
    arena_free(&memory);
    pcg_run_free(r);
}

static const char *bad_key;
static int bad_kind;

static int set_bad(pcg_call *c)
{
    const pcg_cell cells[4] = {{.i = 1}};
    return pcg_property_set(c, bad_key, bad_kind, cells);
}

static void that_cannot_be(void)
{
    static const char *const keys[] = {"",      "origin", "origin.", ".x",        "a.b.c",
                                       "a b.c", "A.b",    "1.b",     "outputs.x", "a.b "};
    static const int kinds[] = {PCG_VEC2, PCG_LIST, PCG_ENUM, PCG_COLOR};
    set = set_bad;
    for (size_t i = 0; i < COUNT_OF(keys) + COUNT_OF(kinds); i++) {
        pcg_run *r = pcg_run_new(program, NULL);
        bad_key = i < COUNT_OF(keys) ? keys[i] : "a.b";
        bad_kind = i < COUNT_OF(keys) ? PCG_INT : kinds[i - COUNT_OF(keys)];
        CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_FAILED);
        CHECK_PART(pcg_run_error(r), "cannot be a property of the run");
        CHECK_NUMBER(pcg_run_property_count(r), 0);
        pcg_run_free(r);
    }
}

int main(void)
{
    pcg_module module = toy_module;
    module.run = run;
    program = pcg_program_of(&module);
    are_set_and_read();
    that_cannot_be();
    pcg_program_free(program);
    return unit_done();
}

/* random.c - chance: pinned values (a seed means the same for ever), evenness, lines of descent,
 * attributes through them. */
#include "runtime/run.h"
#include "tests/unit/unit.h"
#include "trouble.h"

static pcg_program *program;

/* A frame and a call of a run, as emitted code has them. */
typedef struct stand {
    pcg_run *run;
    pcg_instance instance;
    pcg_frame frame;
    pcg_call call;
} stand;

static void stand_up(stand *s, uint64_t seed)
{
    const pcg_run_options options = {.size = sizeof options, .seed = seed};
    s->run = pcg_run_new(program, &options);
    s->instance = (pcg_instance){0};
    s->frame = (pcg_frame){.run = s->run, .key = pcg_mix(seed, 0)};
    loaded_take(&s->frame, &s->run->own);
    pcg_begin(&s->call, &s->frame, &trouble_nodes[TROUBLE_MAKER], &s->instance);
}

static pcg_u64 bits_of(double x)
{
    pcg_u64 bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void values_stay(void)
{
    stand s;
    stand_up(&s, 0);
    CHECK(pcg_mix(0, 0) == 0x3EBFC17E22B13337u);
    CHECK(pcg_mix(1, 2) == 0x684236E4D47D8708u);
    CHECK(pcg_mix(2, 1) == 0x64CFF0528186F2D3u);
    CHECK(pcg_mix(0xFFFFFFFFFFFFFFFFu, 0x123456789ABCDEFu) == 0xB663BB018D3A146Bu);
    CHECK_NUMBER(pcg_round(&s.call, NULL), PCG_OK);
    CHECK(bits_of(pcg_random(&s.call, 0, 0)) == 0x3FD42DAE1BCFE444u);
    CHECK(bits_of(pcg_random(&s.call, 0, 1)) == 0x3FDB50573574BA1Cu);
    CHECK(bits_of(pcg_random(&s.call, 1, 0)) == 0x3FDE2DD8AEEDBB74u);
    pcg_run_free(s.run);
    stand_up(&s, 7);
    CHECK_NUMBER(pcg_round(&s.call, NULL), PCG_OK);
    CHECK(bits_of(pcg_random(&s.call, 0, 0)) == 0x3FCB2F08658535B8u);
    pcg_run_free(s.run);
}

/* Counters make numbers that fill the interval evenly: chi squared over 64 parts, 63 degrees of
 * freedom. */
static void values_are_even(void)
{
    enum { PARTS = 64, DRAWS = 64000 };
    stand s;
    stand_up(&s, 3);
    for (pcg_u32 site = 0; site < 4; site++) {
        int parts[PARTS] = {0}, outside = 0;
        double squares = 0, before = 0, product = 0;
        for (pcg_u64 i = 0; i < DRAWS; i++) {
            double x = pcg_random(&s.call, site, i);
            if (x >= 0 && x < 1)
                parts[(int)(x * PARTS)]++;
            else
                outside++;
            product += (x - 0.5) * (before - 0.5);
            before = x;
        }
        for (int i = 0; i < PARTS; i++) {
            double off = parts[i] - (double)DRAWS / PARTS;
            squares += off * off / ((double)DRAWS / PARTS);
        }
        CHECK_NUMBER(outside, 0);
        CHECK(squares > 30 && squares < 115);
        CHECK(fabs(product / DRAWS) < 0.002);
    }
    pcg_run_free(s.run);
}

static void descent_tells_apart(void)
{
    stand s;
    stand_up(&s, 1);
    CHECK_NUMBER(pcg_round(&s.call, NULL), PCG_OK);
    pcg_entity *a = pcg_entity_new(&s.call, &pcg_type_entity, NULL);
    pcg_entity *b = pcg_entity_new(&s.call, &pcg_type_entity, NULL);
    pcg_entity *child = pcg_entity_new(&s.call, &pcg_type_entity, a);
    pcg_entity *copy = pcg_entity_copy(s.run, a, 1), *other = pcg_entity_copy(s.run, a, 2);
    CHECK(a->lineage != b->lineage && a->lineage != child->lineage && b->lineage != child->lineage);
    CHECK(copy->lineage != a->lineage && copy->lineage != other->lineage);
    CHECK(a->maker == &trouble_nodes[TROUBLE_MAKER] && copy->maker == a->maker);
    CHECK_NUMBER(pcg_round(&s.call, a), PCG_OK);
    double of_a = pcg_random(&s.call, 0, 0);
    CHECK(s.call.first == a && s.call.lineage == a->lineage);
    pcg_entity *heir = pcg_entity_new(&s.call, &pcg_type_entity, NULL);
    CHECK(heir->lineage == pcg_mix(pcg_mix(a->lineage, s.call.key), 1));
    CHECK_NUMBER(pcg_round(&s.call, b), PCG_OK);
    CHECK(bits_of(pcg_random(&s.call, 0, 0)) != bits_of(of_a));
    CHECK_NUMBER(pcg_round(&s.call, a), PCG_OK);
    CHECK(bits_of(pcg_random(&s.call, 0, 0)) == bits_of(of_a));
    CHECK(pcg_entity_is(a, &pcg_type_entity) && !pcg_entity_is(a, &pcg_type_shape));
    pcg_run_free(s.run);
}

static void attributes_are_inherited(void)
{
    static const pcg_cell initial = {.i = 5}, none[3] = {{.f = 0}, {.f = 0}, {.f = 0}},
                          place[3] = {{.f = 1}, {.f = 2}, {.f = 3}};
    const pcg_slot number = {0, PCG_INT, &initial, 0}, far = {100, PCG_VEC3, none, 0},
                   unlinked = {-1, PCG_INT, &initial, 0};
    stand s;
    stand_up(&s, 1);
    pcg_entity *a = pcg_entity_new(&s.call, &pcg_type_entity, NULL);
    CHECK_NUMBER(pcg_get(a, &number)->i, 5);
    CHECK(pcg_attribute(a, 0) == NULL);
    pcg_set_int(s.run, a, &number, 6);
    pcg_entity *child = pcg_entity_new(&s.call, &pcg_type_entity, a);
    CHECK(child->attributes == a->attributes);
    pcg_set_cells(s.run, child, &far, place);
    pcg_set_int(s.run, child, &number, 7);
    pcg_set_int(s.run, child, &unlinked, 8);
    CHECK_NUMBER(pcg_get(a, &number)->i, 6);
    CHECK(pcg_attribute(a, 100) == NULL);
    CHECK_NUMBER(pcg_get(child, &number)->i, 7);
    CHECK_NUMBER(pcg_get(child, &far)[2].f, 3);
    CHECK_NUMBER(pcg_get(child, &unlinked)->i, 5);
    pcg_entity *copy = pcg_entity_copy(s.run, child, 1);
    pcg_leave(s.run, copy, 64); /* while it is shared */
    CHECK(pcg_attribute(copy, 100) == NULL);
    CHECK_NUMBER(pcg_get(copy, &number)->i, 7);
    CHECK_NUMBER(pcg_get(child, &far)[0].f, 1);
    pcg_leave(s.run, child, 101); /* inside a vector of no one */
    CHECK_NUMBER(pcg_get(child, &far)[0].f, 1);
    pcg_leave(s.run, child, 1); /* alone */
    CHECK(pcg_attribute(child, 100) == NULL);
    pcg_leave(s.run, child, 0);
    CHECK(child->attributes == NULL);
    pcg_leave(s.run, child, 0);
    pcg_run_free(s.run);
}

static void attributes_are_converted(void)
{
    static const pcg_cell zero = {.i = 0}, empty = {.s = ""};
    const pcg_slot length = {0, PCG_LENGTH, &zero, 0}, name = {1, PCG_STRING, &empty, 0},
                   flag = {2, PCG_BOOL, &zero, 0};
    stand s;
    stand_up(&s, 1);
    pcg_entity *e = pcg_entity_new(&s.call, &pcg_type_entity, NULL);
    pcg_set_int(s.run, e, &length, 3);
    CHECK_NUMBER(pcg_get(e, &length)->f, 3);
    pcg_set_int(s.run, e, &name, -12);
    CHECK_TEXT(pcg_get(e, &name)->s, "-12");
    pcg_set_float(s.run, e, &name, 0.1);
    CHECK_TEXT(pcg_get(e, &name)->s, "0.1");
    pcg_set_bool(s.run, e, &name, 1);
    CHECK_TEXT(pcg_get(e, &name)->s, "true");
    pcg_set_bool(s.run, e, &flag, 3);
    CHECK_NUMBER(pcg_get(e, &flag)->i, 1);
    CHECK(pcg_string(s.run, "tile") == pcg_format(s.run, "%s%c", "til", 'e'));
    /* A precision says where it ends: no byte is behind it, and no character is cut. */
    const char bytes[4] = {'a', (char)0xC3, (char)0xA9, 'b'};
    CHECK_TEXT(pcg_format(s.run, "%.*s", 4, bytes), "a\xC3\xA9"
                                                   "b");
    CHECK_TEXT(pcg_format(s.run, "%.*s|%.*s", 2, bytes, 3, bytes), "a|a\xC3\xA9");
    CHECK_TEXT(pcg_format(s.run, "%5d|%-4s|%.3s|%08.3f|%g|%%|%x|%lld|%zu|%+d", 42, "ab", "abcdef",
                          3.14159, 1e21, 255u, -1LL, (size_t)9, 7),
               "   42|ab  |abc|0003.142|1e+21|%|ff|-1|9|+7");
    pcg_set_float(s.run, e, &flag, 1);
    CHECK_NUMBER(pcg_round(&s.call, NULL), PCG_FAILED);
    CHECK_PART(pcg_run_error(s.run), "an attribute of kind bool cannot hold a value of kind float");
    pcg_run_free(s.run);
}

int main(void)
{
    program = pcg_program_of(&trouble_module);
    values_stay();
    values_are_even();
    descent_tells_apart();
    attributes_are_inherited();
    attributes_are_converted();
    pcg_program_free(program);
    return unit_done();
}

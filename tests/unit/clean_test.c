/* clean_test.c - joining polygons whose edges run along each other but for the last digits. */
#include "runtime/base/base.h"
#include "runtime/polygon.h"
#include "tests/unit/io_studio.h"

static void add_loop(studio *s, polygons *p, const pcg_vec2 *at, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        polygons_add(s->call->run, p, at[i]);
    polygons_end_loop(s->call->run, p);
}

/* Crossings of edges that hardly cross must not be taken beyond their ends: each cut would make
 * them longer, and the drawing would grow without end. */
static void test_hardly_crossing(studio *s)
{
    static const pcg_vec2 a[] = {{0.23761587751618896, 2.5565540077584301},
                                 {0, 2.2900231982024133},
                                 {0.087963920761833458, 1.7531959272362516},
                                 {0.041056, 0.818281},
                                 {0, 0}};
    static const pcg_vec2 b[] = {{0.0053570237471321502, 0.1067700499732176}, {0, 0}, {0, 0}};
    static const pcg_vec2 c[] = {{0.3, 5.1}, {4.3, 5.7}, {7.4, 6.2}};
    static const pcg_vec2 d[] = {{0.11332431676712165, 2.2586502385550027},
                                 {0.25576095341465338, 5.097533829656042},
                                 {0.0053570237471321572, 0.106770049973218},
                                 {0, 0}};
    static const pcg_vec2 e[] = {{6.1, 8.9}, {4.48, 10.37}, {1.74862, 10.37141}};
    polygons in = {0}, out = {0};
    bool changed;

    add_loop(s, &in, a, COUNT_OF(a));
    add_loop(s, &in, b, COUNT_OF(b));
    add_loop(s, &in, c, COUNT_OF(c));
    add_loop(s, &in, d, COUNT_OF(d));
    add_loop(s, &in, e, COUNT_OF(e));
    CHECK_INTEGER(polygons_clean(s->call->run, &in, 0, &out, &changed), PCG_OK);
    CHECK(out.points > 0 && out.points < 40);
    polygons_free(s->call->run, &in);
    polygons_free(s->call->run, &out);
}

int main(void)
{
    studio_result made = studio_make(test_hardly_crossing);

    studio_free(&made);
    return unit_done();
}

/* offset_test.c - cleaning and offsetting polygons: areas add up, distances are kept, results are
 * simple. */
#include <math.h>

#include "runtime/polygon.h"
#include "tests/unit/io_studio.h"
#include "tests/unit/outlines.h"

static void expect(bool holds, const char *what, double found, double wanted)
{
    unit_count(holds, what, __FILE__, 0);
    if (!holds)
        printf("    found %.17g, expected %.17g; %u corners, %u loops\n", found, wanted, corners,
               loops);
}

static void expect_near(double found, double wanted, double tolerance, const char *what)
{
    expect(fabs(found - wanted) <= tolerance, what, found, wanted);
}

/* The polygon that was built last, as one face. */
static polygons load(pcg_run *r)
{
    polygons p = {0};

    polygons_begin_face(r, &p);
    for (uint32_t l = 0; l < loops; l++) {
        for (uint32_t i = loop_corner[l]; i < loop_corner[l + 1]; i++)
            polygons_add(r, &p, (pcg_vec2){position[i].x, position[i].y});
        polygons_end_loop(r, &p);
    }
    return p;
}

static double distance_to_segment(pcg_vec2 p, pcg_vec2 a, pcg_vec2 b)
{
    double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    double t = square > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / square : 0;

    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(p.x - a.x - t * x, p.y - a.y - t * y);
}

static double distance_to_border(const polygons *p, pcg_vec2 at)
{
    double least = INFINITY;

    for (uint32_t l = 0; l < p->loops; l++)
        for (uint32_t i = loop_begin(p, l), j = p->end[l] - 1; i < p->end[l]; j = i++)
            least = fmin(least, distance_to_segment(at, p->point[j], p->point[i]));
    return least;
}

/* How often the loops go around a point, by the crossings of a ray. */
static int winding_at(const polygons *p, pcg_vec2 at)
{
    int winding = 0;

    for (uint32_t l = 0; l < p->loops; l++)
        for (uint32_t i = loop_begin(p, l), j = p->end[l] - 1; i < p->end[l]; j = i++) {
            pcg_vec2 a = p->point[j], b = p->point[i];

            if ((a.y > at.y) != (b.y > at.y) &&
                a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) > at.x)
                winding += b.y > a.y ? 1 : -1;
        }
    return winding;
}

static polygons difference(pcg_run *r, const polygons *outer, const polygons *inner)
{
    polygons all = {0}, out = {0};
    bool changed;

    for (uint32_t i = 0, l = 0; l < outer->loops; l++) {
        for (; i < outer->end[l]; i++)
            polygons_add(r, &all, outer->point[i]);
        polygons_end_loop(r, &all);
    }
    for (uint32_t l = 0; l < inner->loops; l++) {
        for (uint32_t i = inner->end[l]; i-- > loop_begin(inner, l);)
            polygons_add(r, &all, inner->point[i]);
        polygons_end_loop(r, &all);
    }
    CHECK_INTEGER(polygons_clean(r, &all, 0, &out, &changed), PCG_OK);
    polygons_free(r, &all);
    return out;
}

/* ---- what must hold -------------------------------------------------------------------------- */

/* A result: every face an outline and its holes, and nothing in it left to be cleaned. */
static void expect_simple(pcg_run *r, const polygons *p, double extent, const char *what)
{
    polygons again = {0};
    bool changed;

    for (uint32_t f = 0; f < p->faces; f++)
        for (uint32_t l = p->face[f]; l < face_end(p, f); l++)
            expect((polygons_loop_area(p, l) > 0) == (l == p->face[f]), what,
                   polygons_loop_area(p, l), 0);
    CHECK_INTEGER(polygons_clean(r, p, 0, &again, &changed), PCG_OK);
    expect_near(polygons_area(&again), polygons_area(p), 1e-6 * extent * extent, what);
    expect(again.faces == p->faces, what, again.faces, p->faces);
    polygons_free(r, &again);
}

/* No point is on the wrong side: near the border of the original nothing is left, far from it
 * everything. */
static void expect_points(const polygons *in, const polygons *moved, double distance, double extent,
                          const char *what)
{
    double hair = 1e-6 * extent;

    for (int i = 0; i < 60; i++) {
        pcg_vec2 at = {position[0].x + extent * (2 * share() - 1),
                       position[0].y + extent * (2 * share() - 1)};
        double away = distance_to_border(in, at);
        int before = winding_at(in, at), after = winding_at(moved, at);

        if (distance_to_border(moved, at) < hair || away < hair)
            continue;
        if (distance > 0 ? before > 0 && away > POLYGON_MITRE * distance + hair : before > 0)
            expect(after == 1, what, after, 1);
        if (distance > 0 ? before <= 0 || away < distance - hair
                         : before <= 0 && away > -POLYGON_MITRE * distance + hair)
            expect(after == 0, what, after, 0);
        if (distance < 0 && before <= 0 && away < -distance - hair)
            expect(after == 1, what, after, 1);
    }
}

static void try_offset(pcg_run *r, double distance, double extent, const char *what)
{
    polygons in = load(r), moved = {0}, ring;
    double area = polygons_area(&in);
    bool plain;

    CHECK_INTEGER(polygons_offset(r, &in, distance, &moved, &plain), PCG_OK);
    ring = distance > 0 ? difference(r, &in, &moved) : difference(r, &moved, &in);
    expect_near(polygons_area(&ring), fabs(area - polygons_area(&moved)), 1e-6 * extent * extent,
                what);
    if (plain)
        expect(moved.points == in.points && moved.loops == in.loops, what, moved.points, in.points);
    else
        expect_simple(r, &moved, extent, what);
    expect_points(&in, &moved, distance, extent, what);
    polygons_free(r, &in);
    polygons_free(r, &moved);
    polygons_free(r, &ring);
}

/* ---- cases ----------------------------------------------------------------------------------- */

static void square(double x, double y, double size, bool left)
{
    corner(x, y);
    left ? corner(x + size, y) : corner(x, y + size);
    corner(x + size, y + size);
    left ? corner(x, y + size) : corner(x + size, y);
    end_loop();
}

static void expect_offset(pcg_run *r, double distance, double area, uint32_t faces,
                          uint32_t loop_count, const char *what)
{
    polygons in = load(r), moved = {0};
    bool plain;

    CHECK_INTEGER(polygons_offset(r, &in, distance, &moved, &plain), PCG_OK);
    expect_near(polygons_area(&moved), area, 1e-6, what);
    expect(moved.faces == faces, what, moved.faces, faces);
    expect(moved.loops == loop_count, what, moved.loops, loop_count);
    polygons_free(r, &in);
    polygons_free(r, &moved);
}

static void test_squares(pcg_run *r)
{
    begin(), square(0, 0, 4, true);
    expect_offset(r, 1, 4, 1, 1, "square inward");
    expect_offset(r, -1, 36, 1, 1, "square outward");
    expect_offset(r, 2, 0, 0, 0, "square to its middle");
    expect_offset(r, 3, 0, 0, 0, "square beyond its middle");
    expect_offset(r, 1e6, 0, 0, 0, "square far beyond its middle");
    square(1, 1, 2, false);
    expect_offset(r, 0.25, 3.5 * 3.5 - 2.5 * 2.5, 1, 2, "frame inward");
    expect_offset(r, 0.5, 0, 0, 0, "frame until it is gone");
    expect_offset(r, -0.5, 25 - 1, 1, 2, "frame outward");
    expect_offset(r, -2, 64, 1, 1, "frame outward until its hole is gone");
}

/* Two squares of 4 with a bridge of 1 between them. */
static void test_dumbbell(pcg_run *r)
{
    begin(), corner(0, 0), corner(4, 0), corner(4, 1.5), corner(6, 1.5), corner(6, 0),
        corner(10, 0), corner(10, 4);
    corner(6, 4), corner(6, 2.5), corner(4, 2.5), corner(4, 4), corner(0, 4), end_loop();
    expect_offset(r, 0.25, 2 * 3.5 * 3.5 + 2.5 * 0.5, 1, 1, "dumbbell in one piece");
    expect_offset(r, 1, 8, 2, 2, "dumbbell in two pieces");
    expect_offset(r, -1, 2 * 36, 1, 1, "dumbbell outward: its notches close");
}

static void test_crossing(pcg_run *r)
{
    polygons in, out = {0};
    bool changed;

    begin(), corner(0, 0), corner(2, 2), corner(2, 0), corner(0, 2), end_loop();
    in = load(r);
    CHECK_INTEGER(polygons_clean(r, &in, 0, &out, &changed), PCG_OK);
    CHECK(changed && out.faces == 1);
    expect_near(polygons_area(&out), 1, 1e-9, "the half of a bow tie that turns left");
    polygons_free(r, &in);
    polygons_clear(&out);
    begin(), square(0, 0, 2, true), square(1, 1, 2, true), square(5, 0, 1, true);
    in = load(r);
    CHECK_INTEGER(polygons_clean(r, &in, 0, &out, &changed), PCG_OK);
    CHECK(changed && out.faces == 2);
    expect_near(polygons_area(&out), 8, 1e-9, "two squares that overlap, and one apart");
    polygons_clear(&out);
    CHECK_INTEGER(polygons_clean(r, &in, 1, &out, &changed), PCG_OK);
    expect_near(polygons_area(&out), 1, 1e-9, "what two squares share");
    polygons_free(r, &in);
    polygons_free(r, &out);
}

static void test_degenerate(pcg_run *r)
{
    begin(), end_loop();
    expect_offset(r, 1, 0, 0, 0, "no corner");
    begin(), corner(1, 1), end_loop();
    expect_offset(r, 1, 0, 0, 0, "one corner, inward");
    begin(), corner(0, 0), corner(1, 0), corner(2, 0), end_loop();
    expect_offset(r, 1, 0, 0, 0, "a line, inward");
    begin(), corner(0, 0), corner(0, 0), corner(4, 0), corner(4, 0), corner(4, 4), corner(0, 4),
        corner(0, 4), end_loop();
    expect_offset(r, 1, 4, 1, 1, "corners that stand twice");
    begin(), corner(0, 0), corner(2, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop();
    expect_offset(r, 1, 4, 1, 1, "a flat corner");
    begin(), corner(0, 0), corner(NAN, 0), corner(4, 4), end_loop();
    expect_offset(r, 1, 0, 0, 0, "a corner that is no number");
    begin(), corner(0, 0), corner(INFINITY, 0), corner(4, 4), end_loop();
    expect_offset(r, 1, 0, 0, 0, "a corner that is nowhere");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), corner(0, 2), corner(-3, 2),
        corner(0, 2), end_loop();
    expect_offset(r, 1, 4, 1, 1, "a spike");
}

/* ---- families -------------------------------------------------------------------------------- */

static void test_families(pcg_run *r)
{
    for (uint32_t i = 0; i < 200; i++) {
        begin(), star(3 + below(40), 0, 0, 2, 2 + 3 * share(), true);
        try_offset(r, 2 * share(), 10, "star inward");
        try_offset(r, -2 * share(), 10, "star outward");
        begin(), star(3 + below(20), 0, 0, 8, 10, true), star(3 + below(20), 0, 0, 1, 3, false);
        try_offset(r, 3 * share(), 20, "star with a hole, inward");
        try_offset(r, -3 * share(), 20, "star with a hole, outward");
    }
    for (uint32_t i = 0; i < 300; i++) {
        grow_piece(5 + below(200));
        trace_piece(i % 2 == 0);
        if (i % 3 == 0)
            shear();
        try_offset(r, i % 5 == 0 ? 0.25 : 0.7 * share(), 60, "piece of a board, inward");
        try_offset(r, i % 5 == 0 ? -0.5 : -2 * share(), 60, "piece of a board, outward");
    }
}

/* Nothing is known of the loops: the result is simple all the same, and where the loops wind often
 * enough. */
static void test_garbage(pcg_run *r)
{
    for (uint32_t i = 0; i < 400; i++) {
        polygons in, out = {0};
        bool changed, whole = i % 2 == 0;

        begin();
        for (uint32_t l = 0, n = 1 + below(4); l < n; l++) {
            for (uint32_t j = 0, k = below(20); j < k; j++)
                corner(whole ? below(9) : 8 * share(), whole ? below(9) : 8 * share());
            end_loop();
        }
        in = load(r);
        CHECK_INTEGER(polygons_clean(r, &in, 0, &out, &changed), PCG_OK);
        expect_simple(r, &out, 10, "loops by chance");
        for (uint32_t j = 0; j < 50; j++) {
            pcg_vec2 at = {8 * share(), 8 * share()};

            if (distance_to_border(&in, at) > 1e-6)
                expect(winding_at(&out, at) == (winding_at(&in, at) > 0),
                       "loops by chance: a point", winding_at(&out, at), winding_at(&in, at));
        }
        polygons_free(r, &in);
        polygons_free(r, &out);
    }
}

/* Rectangles with sides that nearly coincide, a hair apart: they are cut a few times, not again and
 * again. */
static void test_coincident(pcg_run *r)
{
    static const pcg_vec2 at[] = {
        {1409.5467011092178, 4616.3765938718825}, {1409.5468931624732, 4615.5713347187066},
        {1412.5468930771508, 4615.5720502147651}, {1412.5467410717552, 4616.2093928923096},
        {1409.547515597761, 4612.960302238258},   {1411.6995367118407, 4614.8140274076341},
        {1410.3942495277834, 4616.3293575258376}, {1408.1974570801372, 4614.4370668668589},
        {1409.5468931624332, 4615.5713348867703}, {1409.5475155977613, 4612.960302238258},
        {1412.5475155125189, 4612.9610173981891}, {1412.5468930771908, 4615.5720500467014},
        {1411.046893119812, 4615.5716924667358},  {1412.5468930771908, 4615.5720500467014},
        {1412.5468930771508, 4615.5720502147651}};
    static const uint32_t end[] = {4, 8, 12, 15};
    polygons in = {0}, out = {0};
    bool changed;

    for (uint32_t i = 0, l = 0; l < COUNT_OF(end); l++) {
        for (; i < end[l]; i++)
            polygons_add(r, &in, at[i]);
        polygons_end_loop(r, &in);
    }
    CHECK_INTEGER(polygons_clean(r, &in, 0, &out, &changed), PCG_OK);
    expect(out.points < 100, "nearly coincident sides", out.points, 100);
    expect_simple(r, &out, 5, "nearly coincident sides");
    polygons_free(r, &in);
    polygons_free(r, &out);
}

static void test_large(pcg_run *r)
{
    begin(), star(20000, 0, 0, 10, 10.01, true);
    try_offset(r, 1, 20, "20,000 corners");
}

static void build(studio *s)
{
    pcg_run *r = s->call->run;

    test_squares(r);
    test_dumbbell(r);
    test_crossing(r);
    test_degenerate(r);
    test_families(r);
    test_garbage(r);
    test_coincident(r);
    test_large(r);
}

int main(void)
{
    studio_result made = studio_make(build);

    studio_free(&made);
    return unit_done();
}

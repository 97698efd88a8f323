/* triangulate_test.c - triangles of polygons: they cover the polygon, turn one way, and name its
 * corners. */
#include <math.h>

#include "runtime/orientation.h"
#include "tests/unit/outlines.h"
#include "tests/unit/unit.h"

static void expect(bool holds, const char *what)
{
    unit_count(holds, what, __FILE__, 0);
}

static uint32_t triangle[3 * MAX_CORNERS + 6 * MAX_LOOPS];

static double area_of_loops(uint32_t count)
{
    double sum = 0;

    for (uint32_t l = 0; l < count; l++)
        for (uint32_t i = loop_corner[l], j = loop_corner[l + 1] - 1; i < loop_corner[l + 1];
             j = i++)
            sum += (position[j].x - position[0].x) * (position[i].y - position[0].y) -
                   (position[j].y - position[0].y) * (position[i].x - position[0].x);
    return sum / 2;
}

static uint32_t triangulate(pcg_triangulator *t)
{
    static uint32_t face_loop[2];
    pcg_mesh m = {.references = 1,
                  .face_count = 1,
                  .position = position,
                  .face_loop = face_loop,
                  .loop_corner = loop_corner,
                  .corner_vertex = corner_vertex};

    face_loop[1] = loops;
    m.vertex_count = m.corner_count = corners;
    m.loop_count = loops;
    return pcg_triangulate(t, &m, 0, NULL, triangle);
}

static pcg_vec2 flat(uint32_t c)
{
    return (pcg_vec2){position[c].x, position[c].y};
}

/* Sums the triangles; false where one names no corner, has no area, or does not turn as the outline
 * does. */
static bool sum_triangles(uint32_t count, double *sum)
{
    double way = area_of_loops(1) < 0 ? -1 : 1;

    *sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *c = &triangle[3 * (size_t)i];
        double area;

        if (c[0] >= corners || c[1] >= corners || c[2] >= corners)
            return false;
        area = orientation(flat(c[0]), flat(c[1]), flat(c[2]));
        if (!(way * area > 0))
            return false;
        *sum += area / 2;
    }
    return true;
}

/* The polygon that was built last is simple: its triangles must cover it. */
static void expect_covered(pcg_triangulator *t, const char *what)
{
    double area = area_of_loops(loops), sum;
    uint32_t count = triangulate(t);
    bool sound = sum_triangles(count, &sum);

    expect(sound, what);
    expect(count <= corners + 2 * (loops - 1) - 2, what);
    expect(fabs(sum - area) <= 1e-9 * fabs(area), what);
    if (fabs(sum - area) > 1e-9 * fabs(area))
        printf("  %u corners, %u loops, area %.17g, triangles %.17g\n", corners, loops, area, sum);
}

/* Nothing is known of the polygon: nothing may go wrong. */
static void expect_survived(pcg_triangulator *t, const char *what)
{
    double sum;
    uint32_t count = triangulate(t);

    expect(sum_triangles(count, &sum), what);
    expect(count == 0 || count + 2 <= corners + 2 * (loops - 1), what);
}

/* ---- cases ----------------------------------------------------------------------------------- */

static void test_small(pcg_triangulator *t)
{
    begin(), corner(0, 0), corner(2, 0), corner(0, 1), end_loop();
    expect_covered(t, "triangle");
    begin(), corner(0, 0), corner(2, 0), corner(2, 1), corner(0, 1), end_loop();
    expect_covered(t, "rectangle");
    begin(), corner(0, 0), corner(4, 0), corner(1, 1), corner(0, 4), end_loop();
    expect_covered(t, "dart");
    begin(), corner(1, 1), corner(0, 4), corner(0, 0), corner(4, 0), end_loop();
    expect_covered(t, "dart, begun at its notch");
    begin(), corner(0, 0), corner(1, 0), corner(2, 0), corner(0, 1), end_loop();
    expect_covered(t, "triangle with a flat corner");
    begin(), corner(0, 0), corner(0, 0), corner(2, 0), corner(2, 0), corner(2, 2), corner(0, 2),
        corner(0, 0), end_loop();
    expect_covered(t, "square with corners that stand twice");
    begin(), corner(0, 0), corner(1, 0), corner(2, 0), corner(3, 0), corner(3, 1), corner(3, 2),
        corner(3, 3);
    corner(2, 3), corner(1, 3), corner(0, 3), corner(0, 2), corner(0, 1), end_loop();
    expect_covered(t, "square with flat corners on every side");
}

static void test_degenerate(pcg_triangulator *t)
{
    begin(), corner(0, 0), corner(1, 1), corner(2, 2), corner(3, 3), end_loop();
    expect(triangulate(t) == 0, "a line has no triangles");
    begin(), corner(1, 1), corner(1, 1), corner(1, 1), end_loop();
    expect(triangulate(t) == 0, "a point has no triangles");
    begin(), corner(1, 1), corner(2, 1), end_loop();
    expect(triangulate(t) == 0, "two corners have no triangles");
    begin(), end_loop();
    expect(triangulate(t) == 0, "no corner, no triangles");
    begin(), corner(0, 0), corner(2, 2), corner(2, 0), corner(0, 2), end_loop();
    expect_survived(t, "bow tie");
    begin(), corner(0, 0), corner(3, 2), corner(3, 0), corner(0, 1), end_loop();
    expect_survived(t, "uneven bow tie");
    begin(), corner(0, 0), corner(NAN, 1), corner(2, 0), corner(0, INFINITY), end_loop();
    expect_survived(t, "corners that are no numbers");
    begin(), corner(0, 0), corner(1e300, 0), corner(1e300, 1e300), corner(0, 1e300),
        corner(-1e300, 1), end_loop();
    expect_survived(t, "huge coordinates");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), corner(0, 0);
    corner(1, 1), corner(1, 2), corner(2, 2), corner(2, 1), corner(1, 1), end_loop();
    expect_covered(t, "hole that the outline reaches by a bridge");
}

static void square_hole(double x, double y, double size)
{
    corner(x, y), corner(x, y + size), corner(x + size, y + size), corner(x + size, y), end_loop();
}

static void test_holes(pcg_triangulator *t)
{
    begin(), corner(0, 0), corner(9, 0), corner(9, 9), corner(0, 9), end_loop();
    square_hole(1, 1, 2), square_hole(5, 1, 2), square_hole(1, 5, 2), square_hole(5, 5, 2);
    expect_covered(t, "four holes in line");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop(),
        square_hole(0, 1, 1);
    expect_covered(t, "hole with a side on the outline");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop(),
        square_hole(0, 0, 4);
    expect_survived(t, "hole that is all of it");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop();
    corner(0, 2), corner(1, 3), corner(2, 2), corner(1, 1), end_loop();
    expect_covered(t, "hole that touches a side with a corner");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop();
    corner(0, 0), corner(1, 2), corner(2, 1), end_loop();
    expect_covered(t, "hole that touches a corner");
    begin(), corner(0, 0), corner(6, 0), corner(6, 6), corner(0, 6), end_loop();
    square_hole(1, 1, 2), square_hole(3, 3, 2), square_hole(1, 3, 2);
    expect_covered(t, "holes that touch each other");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop(),
        square_hole(7, 7, 1);
    expect_survived(t, "hole outside");
    begin(), corner(0, 0), corner(4, 0), corner(4, 4), corner(0, 4), end_loop();
    corner(1, 1), corner(2, 1), corner(2, 2), corner(1, 2), end_loop();
    expect(triangulate(t) == 8, "hole that turns the wrong way");
}

/* ---- families -------------------------------------------------------------------------------- */

static void test_stars(pcg_triangulator *t)
{
    for (uint32_t i = 0; i < 300; i++) {
        begin(), star(3 + below(200), 3, -2, 1, 1 + 5 * share(), true);
        expect_covered(t, "star");
        begin(), star(3 + below(60), 0, 0, 4, 6, true), star(3 + below(30), 0, 0, 0.5, 1, false);
        expect_covered(t, "star with a hole");
    }
    begin(), star(100, 0, 0, 110, 120, true);
    for (uint32_t x = 0; x < 40; x++)
        for (uint32_t y = 0; y < 40; y++)
            star(3 + below(9), 3 * (double)x - 59, 3 * (double)y - 59, 0.2, 1.4, false);
    expect_covered(t, "1,600 holes");
}

static void test_pieces(pcg_triangulator *t)
{
    for (uint32_t i = 0; i < 2000; i++) {
        grow_piece(5 + below(300));
        trace_piece(i % 2 == 0);
        if (i % 3 == 0)
            shear();
        expect_covered(t, "piece of a board");
    }
}

static void test_garbage(pcg_triangulator *t)
{
    for (uint32_t i = 0; i < 3000; i++) {
        begin();
        for (uint32_t l = 0, n = 1 + below(4); l < n; l++) {
            for (uint32_t j = 0, k = below(30); j < k; j++)
                corner(below(8), below(8));
            end_loop();
        }
        expect_survived(t, "corners by chance");
    }
}

static void test_large(pcg_triangulator *t)
{
    enum { N = 100000 };

    begin(), star(N, 0, 0, 1, 1, true);
    expect_covered(t, "circle of 100,000 corners");
    begin(), star(N, 0, 0, 1, 2, true);
    expect_covered(t, "star of 100,000 corners");
    begin(), corner(-1, -1), corner(N, -1);
    for (uint32_t i = N - 2; i > 0; i--)
        corner(i, i % 2 == 0 ? 1000 : 0);
    end_loop();
    expect_covered(t, "comb of 100,000 corners");
    begin();
    for (uint32_t i = 0; i < N / 2; i++)
        corner((1 + i * 0.001) * cos(i * 0.01), (1 + i * 0.001) * sin(i * 0.01));
    for (uint32_t i = N / 2; i-- > 0;)
        corner((1.3 + i * 0.001) * cos(i * 0.01), (1.3 + i * 0.001) * sin(i * 0.01));
    end_loop();
    expect_covered(t, "spiral of 100,000 corners");
    begin();
    for (uint32_t i = 0; i < N; i++)
        corner(share(), share());
    end_loop();
    expect_survived(t, "100,000 corners by chance");
}

int main(void)
{
    pcg_triangulator *t = pcg_triangulator_new();

    test_small(t);
    test_degenerate(t);
    test_holes(t);
    test_stars(t);
    test_pieces(t);
    test_garbage(t);
    test_large(t);
    pcg_triangulator_free(t);
    return unit_done();
}

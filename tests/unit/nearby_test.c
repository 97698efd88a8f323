/* nearby_test.c - what is near and what blocks a sight, against looking at everything. */
#include <math.h>

#include "stdlib/geometry/nearby.h"
#include "tests/unit/io_studio.h"
#include "tests/unit/outlines.h"

enum { SHAPES = 300, SAMPLES = 12 };

static pcg_vec3 place(double extent)
{
    return vec3(extent * share(), extent * share(), extent * share());
}

/* A triangle, an edge or a vertex; now and then one without area or length. */
static nearby_part any_part(double extent, double size)
{
    nearby_part p = {.corners = 1 + below(3)};
    pcg_vec3 at = place(extent);

    for (uint32_t i = 0; i < 3; i++)
        p.corner[i] =
            i < p.corners && (i == 0 || below(20) > 0) ? vec3_add(at, place(size)) : p.corner[0];
    if (p.corners == 3 && below(20) == 0)
        p.corner[2] = vec3_scale(vec3_add(p.corner[0], p.corner[1]), 0.5);
    return p;
}

static pcg_vec3 inside(const nearby_part *p, double a, double b)
{
    pcg_vec3 at = p->corner[0];

    if (p->corners < 3)
        b = 0;
    at = vec3_add(at, vec3_scale(vec3_subtract(p->corner[1], p->corner[0]), a * (1 - b)));
    return vec3_add(at, vec3_scale(vec3_subtract(p->corner[2], p->corner[0]), b));
}

/* No pair of points of the two parts is nearer; and it is between points of theirs. */
static void test_closest(void)
{
    for (int turn = 0; turn < 400; turn++) {
        nearby_part a = any_part(2, 1), b = any_part(2, 1), at_a = {.corners = 1}, at_b = at_a;
        double least = INFINITY, found;
        pcg_vec3 on_a, on_b, p, q;

        found = nearby_closest(&a, &b, &on_a, &on_b);
        for (uint32_t i = 0; i < SAMPLES * SAMPLES; i++)
            for (uint32_t k = 0; k < SAMPLES * SAMPLES; k++) {
                pcg_vec3 d = vec3_subtract(
                    inside(&a, (i % SAMPLES) / (SAMPLES - 1.0), (i / SAMPLES) / (SAMPLES - 1.0)),
                    inside(&b, (k % SAMPLES) / (SAMPLES - 1.0), (k / SAMPLES) / (SAMPLES - 1.0)));

                least = fmin(least, vec3_dot(d, d));
            }
        CHECK(found <= least + 1e-12);
        CHECK(sqrt(found) >= sqrt(least) - 0.3);
        for (uint32_t i = 0; i < 3; i++) {
            at_a.corner[i] = on_a;
            at_b.corner[i] = on_b;
        }
        CHECK(nearby_closest(&a, &at_a, &p, &q) < 1e-20);
        CHECK(nearby_closest(&b, &at_b, &p, &q) < 1e-20);
        p = vec3_subtract(on_a, on_b);
        CHECK(fabs(vec3_dot(p, p) - found) < 1e-12);
    }
}

/* ---- the tree -------------------------------------------------------------------------------- */

static pcg_shape *shape_of(studio *s, const nearby_part *p)
{
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    pcg_run *r = s->call->run;
    uint32_t vertex[3] = {0, 1, 2};

    for (uint32_t i = 0; i < p->corners; i++)
        pcg_mesh_add_vertex(r, shape->mesh, p->corner[i]);
    if (p->corners == 3)
        pcg_mesh_add_face(r, shape->mesh, vertex, 3);
    if (p->corners == 2)
        pcg_mesh_add_edge(r, shape->mesh, 0, 1);
    return shape;
}

static bool is_odd(const void *user, uint32_t owner)
{
    (void)user;
    return owner % 2 == 1;
}

static void expect_nearest(const nearby *n, const nearby_filter *filter)
{
    nearby_part of = any_part(10, 2);
    nearby_parts list = {.at = &of, .count = 1, .capacity = 1};
    double least = INFINITY, within = below(2) == 0 ? INFINITY : 0.2;
    nearby_hit hit = {.owner = UINT32_MAX};
    uint32_t best = UINT32_MAX;
    pcg_vec3 a, b;
    bool found;

    for (uint32_t i = 0; i < n->parts.count; i++) {
        uint32_t owner = n->parts.at[i].owner;
        double square = nearby_closest(&of, &n->parts.at[i], &a, &b);

        if (filter != NULL && !is_odd(NULL, owner))
            continue;
        if (square < least || (square == least && owner < best)) {
            least = square;
            best = owner;
        }
    }
    found = best != UINT32_MAX && least <= within * within;
    CHECK_INTEGER(nearby_nearest(n, &list, filter, within, &hit), found);
    if (found) {
        CHECK_INTEGER(hit.owner, best);
        CHECK_NUMBER(hit.distance, sqrt(least));
    }
}

static void expect_around(const nearby *n)
{
    pcg_vec3 low = place(10), high = vec3_add(low, place(2)), a, b;
    nearby_part box = {.corner = {low, high, vec3(low.x, high.y, low.z)}, .corners = 3};
    double reach = 2 * share();
    nearby_list list = {0};

    CHECK_INTEGER(nearby_around(n, low, high, reach, &list), PCG_OK);
    for (uint32_t i = 0; i < n->parts.count; i++) {
        bool listed = false;

        for (uint32_t k = 0; k < list.count; k++)
            listed = listed || list.at[k] == i;
        /* A triangle in the box is not farther from a part than the box is. */
        CHECK(listed || nearby_closest(&box, &n->parts.at[i], &a, &b) > reach * reach);
    }
    nearby_list_free(n->run, &list);
}

static void expect_blocked(const nearby *n, const nearby_filter *filter)
{
    nearby_part way = {.corner = {place(10), place(10)}, .corners = 2};
    bool crossed = false;
    pcg_vec3 a, b;

    way.corner[2] = way.corner[0];
    for (uint32_t i = 0; i < n->parts.count; i++)
        crossed = crossed || (n->parts.at[i].corners == 3 &&
                              (filter == NULL || is_odd(NULL, n->parts.at[i].owner)) &&
                              nearby_closest(&way, &n->parts.at[i], &a, &b) == 0);
    CHECK_INTEGER(nearby_blocks(n, way.corner[0], way.corner[1], 0, filter), crossed);
}

static void test_tree(studio *s, uint32_t count, double size, bool alike)
{
    static pcg_entity *list[SHAPES];
    const nearby_filter odd = {is_odd, NULL};
    nearby_part first = any_part(10, size);
    nearby_reader reader;
    nearby n;

    for (uint32_t i = 0; i < count; i++) {
        nearby_part p = alike ? first : any_part(10, size);

        list[i] = &shape_of(s, &p)->entity;
    }
    CHECK_INTEGER(nearby_reader_open(s->call->run, &reader), PCG_OK);
    CHECK_INTEGER(nearby_open(s->call, &reader, &(pcg_entities){list, count}, &n), PCG_OK);
    for (int turn = 0; turn < 60; turn++) {
        expect_nearest(&n, turn % 2 == 0 ? NULL : &odd);
        expect_around(&n);
        expect_blocked(&n, turn % 2 == 0 ? NULL : &odd);
    }
    nearby_close(&n);
    nearby_reader_close(&reader);
    for (uint32_t i = 0; i < count; i++)
        pcg_entity_drop(s->call->run, list[i]);
}

/* What has coordinates that are no numbers is left out, whatever else there is. */
static void test_no_numbers(studio *s)
{
    nearby_part good = {.corner = {{1, 2, 3}}, .corners = 1}, bad = good;
    pcg_entity *list[2];
    nearby_parts of = {.at = &good, .count = 1, .capacity = 1};
    nearby_reader reader;
    nearby_hit hit;
    nearby n;

    bad.corner[0].y = NAN;
    list[0] = &shape_of(s, &bad)->entity;
    list[1] = &shape_of(s, &good)->entity;
    CHECK_INTEGER(nearby_reader_open(s->call->run, &reader), PCG_OK);
    CHECK_INTEGER(nearby_open(s->call, &reader, &(pcg_entities){list, 2}, &n), PCG_OK);
    CHECK_INTEGER(n.parts.count, 1);
    CHECK(nearby_nearest(&n, &of, NULL, 0, &hit));
    CHECK_INTEGER(hit.owner, 1);
    CHECK(!nearby_nearest(&n, &of, NULL, NAN, &hit));
    nearby_close(&n);
    nearby_reader_close(&reader);
    pcg_entity_drop(s->call->run, list[0]);
    pcg_entity_drop(s->call->run, list[1]);
}

static void build(studio *s)
{
    test_closest();
    for (uint32_t count = 0; count < SHAPES; count = 2 * count + 1) {
        test_tree(s, count, 2, false);
        test_tree(s, count, 0.1, false);
        test_tree(s, count, 1, true);
    }
    test_no_numbers(s);
}

int main(void)
{
    studio_result made = studio_make(build);

    studio_free(&made);
    return unit_done();
}

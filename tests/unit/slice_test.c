/* slice_test.c - cutting faces by planes: the pieces are where they should be, and add up to the
 * whole. */
#include <math.h>

#include "runtime/mesh_slice.h"
#include "runtime/topology.h"
#include "tests/unit/io_studio.h"
#include "tests/unit/outlines.h"

static void expect(bool holds, const char *what, double found, double wanted)
{
    unit_count(holds, what, __FILE__, 0);
    if (!holds)
        printf("    found %.17g, expected %.17g; %u corners, %u loops\n", found, wanted, corners,
               loops);
}

/* The polygon that was built last as a face at height z. */
static void add_face(studio *s, pcg_shape *shape, double z, bool turned)
{
    static uint32_t vertices[MAX_CORNERS];
    pcg_run *r = s->call->run;

    for (uint32_t l = 0; l < loops; l++) {
        uint32_t count = loop_corner[l + 1] - loop_corner[l];

        for (uint32_t i = 0; i < count; i++) {
            pcg_vec3 p = position[turned ? loop_corner[l + 1] - 1 - i : loop_corner[l] + i];

            vertices[i] = pcg_mesh_add_vertex(r, shape->mesh, vec3(p.x, p.y, z));
        }
        if (l == 0)
            pcg_mesh_add_face(r, shape->mesh, vertices, count);
        else
            pcg_mesh_add_hole(r, shape->mesh, vertices, count);
    }
}

/* The pieces as a shape, to be measured. */
static pcg_shape *shape_of(studio *s, const pcg_shape *from, const slices *cut)
{
    pcg_shape *pieces = pcg_shape_new(s->call, &from->entity);

    pcg_shape_set_mesh(s->call->run, pieces, pcg_mesh_hold(cut->pieces));
    return pieces;
}

static void expect_in_slab(const slices *cut, uint32_t face, int axis, const double *plane,
                           uint32_t planes, double hair, const char *what)
{
    const pcg_mesh *m = cut->pieces;
    uint32_t slab = cut->slab[face];
    double low = slab > 0 ? plane[slab - 1] : -INFINITY,
           high = slab < planes ? plane[slab] : INFINITY;

    for (uint32_t c = m->loop_corner[m->face_loop[face]];
         c < m->loop_corner[m->face_loop[face + 1]]; c++) {
        pcg_vec3 p = m->position[m->corner_vertex[c]];
        double at = axis == 0 ? p.x : axis == 1 ? p.y : p.z;

        expect(at >= low - hair, what, at, low);
        expect(at <= high + hair, what, at, high);
    }
}

/* Cuts a shape, and checks its pieces. */
static void try_cuts(studio *s, const pcg_shape *shape, int axis, const double *plane,
                     uint32_t planes, const char *what)
{
    pcg_vec3 size = shape->scope.size;
    double extent = fmax(size.x, fmax(size.y, size.z)), hair = 1e-8 * extent;
    slices cut;
    pcg_shape *pieces;

    CHECK_INTEGER(slices_open(s->call, shape, axis, plane, planes, &cut), PCG_OK);
    pieces = shape_of(s, shape, &cut);
    expect(fabs(pcg_shape_area(pieces) - pcg_shape_area(shape)) <= 1e-9 * extent * extent, what,
           pcg_shape_area(pieces), pcg_shape_area(shape));
    for (uint32_t f = 0; f < cut.pieces->face_count; f++) {
        pcg_vec3 n = pcg_shape_face_normal(pieces, f);

        expect(vec3_dot(n, n) > 0, what, vec3_dot(n, n), 0);
        expect_in_slab(&cut, f, axis, plane, planes, hair, what);
    }
    expect(fabs(pcg_shape_volume(pieces) - pcg_shape_volume(shape)) <=
               1e-8 * extent * extent * extent,
           what, pcg_shape_volume(pieces), pcg_shape_volume(shape));
    pcg_entity_drop(s->call->run, &pieces->entity);
    slices_close(s->call->run, &cut);
}

/* Ascending places in an extent; whole numbers, where corners of boards are, or by chance. */
static uint32_t choose_planes(double extent, bool whole, double *plane, uint32_t most)
{
    uint32_t count = 0;

    for (double at = 0; count < most;) {
        at += whole ? 1 + below(3) : extent * (0.01 + 0.3 * share());
        if (at >= extent)
            break;
        plane[count++] = at;
    }
    return count;
}

static void try_polygon(studio *s, bool whole, const char *what)
{
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    double plane[64];

    add_face(s, shape, 0, false);
    pcg_shape_fit(s->call->run, shape);
    for (int axis = 0; axis < 2; axis++) {
        uint32_t planes =
            choose_planes(axis == 0 ? shape->scope.size.x : shape->scope.size.y, whole, plane, 64);

        try_cuts(s, shape, axis, plane, planes, what);
    }
    pcg_entity_drop(s->call->run, &shape->entity);
}

static void test_families(studio *s)
{
    for (uint32_t i = 0; i < 200; i++) {
        begin(), star(3 + below(60), 0, 0, 1, 2 + 3 * share(), true);
        try_polygon(s, false, "star");
        begin(), star(3 + below(20), 0, 0, 8, 10, true), star(3 + below(20), 0, 0, 1, 3, false);
        try_polygon(s, false, "star with a hole");
        grow_piece(5 + below(300));
        trace_piece(i % 2 == 0);
        try_polygon(s, true, "piece of a board, cut through corners");
        try_polygon(s, false, "piece of a board");
        shear();
        try_polygon(s, false, "slanted piece of a board");
    }
}

/* Sides between the two outlines that were added as the shape's first faces. */
static void add_sides(studio *s, pcg_shape *shape, uint32_t top)
{
    for (uint32_t l = 0; l < loops; l++)
        for (uint32_t i = loop_corner[l]; i < loop_corner[l + 1]; i++) {
            uint32_t next = i + 1 < loop_corner[l + 1] ? i + 1 : loop_corner[l];
            uint32_t quad[4] = {i, next, top + next, top + i};

            pcg_mesh_add_face(s->call->run, shape->mesh, quad, 4);
        }
}

/* A prism over the polygon; both ends share their vertices with the sides. */
static pcg_shape *prism(studio *s, double height)
{
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    uint32_t top, *at;

    add_face(s, shape, 0, false);
    top = shape->mesh->vertex_count;
    add_face(s, shape, height, false);
    add_sides(s, shape, top);
    /* The base was added as it is seen from above: its loops are turned round. */
    at = shape->mesh->corner_vertex;
    for (uint32_t l = 0; l < loops; l++)
        for (uint32_t i = loop_corner[l], j = loop_corner[l + 1]; j > i + 1; i++) {
            uint32_t kept = at[i];

            at[i] = at[--j];
            at[j] = kept;
        }
    pcg_shape_fit(s->call->run, shape);
    return shape;
}

static void test_prisms(studio *s)
{
    double plane[64];

    for (uint32_t i = 0; i < 100; i++) {
        pcg_shape *shape;

        begin(), star(3 + below(20), 0, 0, 8, 10, true), star(3 + below(20), 0, 0, 1, 3, false);
        shape = prism(s, 7);
        CHECK(is_closed(s->call->run, shape));
        for (int axis = 0; axis < 3; axis++) {
            double extent = axis == 0 ? shape->scope.size.x : axis == 1 ? shape->scope.size.y : 7;

            try_cuts(s, shape, axis, plane, choose_planes(extent, false, plane, 64), "prism");
        }
        pcg_entity_drop(s->call->run, &shape->entity);
    }
}

/* Neighbouring faces share the vertices that a cut makes: cut pieces are still closed where they
 * were. */
static void test_sharing(studio *s)
{
    pcg_shape *box = studio_box(s, vec3(1, 2, 3), vec3(4, 4, 4), NULL), *pieces;
    slices cut;

    CHECK_INTEGER(slices_open(s->call, box, 2, (const double[]){1, 2, 3}, 3, &cut), PCG_OK);
    CHECK_INTEGER(cut.pieces->vertex_count, 8 + 3 * 4);
    CHECK_INTEGER(cut.pieces->face_count, 2 + 4 * 4);
    pieces = shape_of(s, box, &cut);
    CHECK(is_closed(s->call->run, pieces));
    pcg_entity_drop(s->call->run, &pieces->entity);
    slices_close(s->call->run, &cut);
    pcg_entity_drop(s->call->run, &box->entity);
}

/* What lies in a plane goes to the slab that it closes. */
static void test_in_plane(studio *s)
{
    pcg_shape *box = studio_box(s, vec3(0, 0, 0), vec3(2, 2, 2), NULL);
    slices cut;

    CHECK_INTEGER(pcg_shape_edit(s->call->run, box) != NULL, 1);
    box->scope.size = vec3(2, 2, 4); /* as if there were more above: its top is in the plane at 2 */
    CHECK_INTEGER(slices_open(s->call, box, 2, (const double[]){2}, 1, &cut), PCG_OK);
    for (uint32_t f = 0; f < cut.pieces->face_count; f++)
        CHECK_INTEGER(cut.slab[f], 0);
    slices_close(s->call->run, &cut);
    pcg_entity_drop(s->call->run, &box->entity);
}

static void test_streams(studio *s)
{
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    const pcg_material *red = studio_material(s, "red", 1, 0, 0, NULL);
    pcg_run *r = s->call->run;
    slices cut;

    begin(), corner(0, 0), corner(4, 0), corner(4, 2), corner(0, 2), end_loop();
    add_face(s, shape, 0, false);
    pcg_shape_fit(r, shape);
    pcg_mesh_need_uvs(r, shape->mesh);
    pcg_mesh_need_materials(r, shape->mesh);
    pcg_mesh_need_tags(r, shape->mesh);
    for (uint32_t i = 0; i < 4; i++) {
        shape->mesh->corner_uv[2 * i] = (float)position[i].x / 4;
        shape->mesh->corner_uv[2 * i + 1] = (float)position[i].y / 2;
    }
    shape->mesh->face_material[0] = red;
    shape->mesh->face_tag[0] = 7;
    CHECK_INTEGER(slices_open(s->call, shape, 0, (const double[]){1, 3}, 2, &cut), PCG_OK);
    CHECK_INTEGER(cut.pieces->face_count, 3);
    for (uint32_t f = 0; f < cut.pieces->face_count; f++)
        CHECK(cut.pieces->face_material[f] == red && cut.pieces->face_tag[f] == 7);
    for (uint32_t c = 0; c < cut.pieces->corner_count; c++) {
        pcg_vec3 p = cut.pieces->position[cut.pieces->corner_vertex[c]];

        CHECK(fabs((double)cut.pieces->corner_uv[2 * c] - p.x / 4) < 1e-6);
        CHECK(fabs((double)cut.pieces->corner_uv[2 * c + 1] - p.y / 2) < 1e-6);
    }
    slices_close(r, &cut);
    pcg_entity_drop(r, &shape->entity);
}

/* Nothing is known of the loops: nothing may go wrong. */
static void test_garbage(studio *s)
{
    for (uint32_t i = 0; i < 500; i++) {
        pcg_shape *shape = studio_shape(s, NULL, NULL);
        slices cut;

        begin();
        for (uint32_t l = 0, n = 1 + below(3); l < n; l++) {
            for (uint32_t j = 0, k = below(20); j < k; j++)
                corner(below(9), below(9));
            end_loop();
        }
        add_face(s, shape, 0, i % 2 == 0);
        pcg_shape_fit(s->call->run, shape);
        CHECK_INTEGER(
            slices_open(s->call, shape, (int)(i % 2), (const double[]){1, 2.5, 4, 7.9}, 4, &cut),
            PCG_OK);
        for (uint32_t f = 0; f < cut.pieces->face_count; f++)
            CHECK(cut.slab[f] <= 4);
        slices_close(s->call->run, &cut);
        pcg_entity_drop(s->call->run, &shape->entity);
    }
}

static void build(studio *s)
{
    test_families(s);
    test_prisms(s);
    test_sharing(s);
    test_in_plane(s);
    test_streams(s);
    test_garbage(s);
}

int main(void)
{
    studio_result made = studio_make(build);

    studio_free(&made);
    return unit_done();
}

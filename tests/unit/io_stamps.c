/* io_stamps.c - a mesh put down as a stamp is what its faces are one by one. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "stdlib/io/io.h"
#include "tests/unit/io_studio.h"

typedef struct desk {
    io_job job;
    io_tessellator tessellator;
    io_stamps *stamps;
    studio_result made;
} desk;

static void open_desk(desk *d, void (*build)(studio *s))
{
    *d = (desk){.made = studio_make(build)};
    if (setjmp(d->job.out_of_memory))
        abort();
    d->job.memory.on_failure = &d->job.out_of_memory;
    d->job.run = d->made.run;
    d->tessellator = (io_tessellator){.job = &d->job, .y_up = true, .flip_v = true};
    d->stamps = ARENA_NEW(&d->job.memory, io_stamps);
}

static void close_desk(desk *d)
{
    if (d->job.triangulator)
        pcg_triangulator_free(d->job.triangulator);
    arena_free(&d->job.memory);
    studio_free(&d->made);
}

static const pcg_shape *shape_of(const desk *d, uint32_t number)
{
    return io_shape(result_entities(d->made.run, 0)->at[number]);
}

static void one_by_one(desk *d, const pcg_shape *s, io_batch *b)
{
    tessellate_begin(&d->tessellator, s);
    for (uint32_t f = 0; f < s->mesh->face_count; f++)
        tessellate_face(&d->tessellator, f, b);
    batch_bound(b);
}

static bool same_bounds(const io_batch *a, const io_batch *b)
{
    return a->bounded == b->bounded && memcmp(a->low, b->low, sizeof a->low) == 0 &&
           memcmp(a->high, b->high, sizeof a->high) == 0;
}

/* Positions and texture coordinates to the bit, normals as closely as they are worked out. */
static bool same_vertices(const io_batch *a, const io_batch *b)
{
    for (uint32_t i = 0; i < a->vertex_count * a->stride; i++) {
        uint32_t part = i % a->stride;
        float off = fabsf(a->vertices[i] - b->vertices[i]);
        if (off > (part >= 3 && part < 6 ? 2e-7f : 0))
            return false;
    }
    return true;
}

static void check_same(const io_batch *a, const io_batch *b)
{
    CHECK_INTEGER(a->vertex_count, b->vertex_count);
    CHECK_INTEGER(a->index_count, b->index_count);
    CHECK(same_bounds(a, b));
    if (a->vertex_count != b->vertex_count || a->index_count != b->index_count)
        return;
    CHECK(same_vertices(a, b));
    CHECK(memcmp(a->indices, b->indices, a->index_count * sizeof *a->indices) == 0);
}

/* ---- shapes of many kinds ------------------------------------------------------------------- */

static void turn(pcg_shape *s, double by)
{
    s->scope.axis[0] = vec3(cos(by), sin(by), 0);
    s->scope.axis[1] = vec3(0, 0, 1);
    s->scope.axis[2] = vec3(sin(by), -cos(by), 0);
}

/* An L, and a quad without area, which is left out. */
static pcg_shape *make_corner(studio *s)
{
    static const double l[] = {0, 0, 0, 4, 0, 0, 4, 1, 0, 1, 1, 0, 1, 5, 0, 0, 5, 0};
    static const double flat[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    studio_face(s, shape, l, 6);
    studio_face(s, shape, flat, 4);
    return shape;
}

/* A square with a hole, and texture coordinates. */
static pcg_shape *make_frame(studio *s)
{
    static const double outline[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    pcg_run *r = s->call->run;
    uint32_t hole[4];
    studio_face(s, shape, outline, 4);
    for (uint32_t i = 0; i < 4; i++) {
        pcg_vec3 p = vec3(i == 1 || i == 2 ? 3 : 1, i < 2 ? 3 : 1, 0);
        hole[i] = pcg_mesh_add_vertex(r, shape->mesh, p);
    }
    const uint32_t turned[4] = {hole[0], hole[1], hole[2], hole[3]};
    pcg_mesh_add_hole(r, shape->mesh, turned, 4);
    pcg_mesh_need_uvs(r, shape->mesh);
    for (uint32_t i = 0; i < 2 * shape->mesh->corner_count; i++)
        shape->mesh->corner_uv[i] = (float)i / 16;
    return shape;
}

static void build_kinds(studio *s)
{
    static const pcg_mesh *const canonical[] = {&pcg_mesh_square, &pcg_mesh_cube,
                                                &pcg_mesh_tray,   &pcg_mesh_lid,
                                                &pcg_mesh_cup,    &pcg_mesh_reveal};
    for (uint32_t i = 0; i < 6; i++) {
        pcg_shape *shape = studio_shape(s, canonical[i], NULL);
        shape->scope.origin = vec3(100 * i, -3.25, 7);
        shape->scope.size = vec3(2.5, 3, i == 0 ? 0 : 0.2);
        turn(shape, 0.3 * i);
        studio_emit(s, shape);
    }
    pcg_shape *corner = make_corner(s), *frame = make_frame(s);
    turn(corner, 1);
    turn(frame, 2);
    studio_emit(s, corner);
    studio_emit(s, frame);
}

enum { KINDS = 8 };

/* All into one batch, twice, so that the second time the stamps are there already. */
static void stamp_is_the_faces(uint32_t stride)
{
    desk d;
    open_desk(&d, build_kinds);
    io_batch faces = {.stride = stride}, stamps = {.stride = stride};
    for (uint32_t i = 0; i < 2 * KINDS; i++) {
        const pcg_shape *s = shape_of(&d, i % KINDS);
        const io_stamp *k = stamp_find(d.stamps, &d.tessellator, s);
        CHECK(k && stamp_put(k, &d.tessellator, s, &stamps));
        CHECK(k && k->closed == tessellate_closed(s->mesh));
        one_by_one(&d, s, &faces);
        check_same(&faces, &stamps);
    }
    close_desk(&d);
}

/* The same mesh in two sizes is two stamps; a place of its own is none. */
static void build_sizes(studio *s)
{
    for (int i = 0; i < 3; i++)
        studio_emit(s, studio_box(s, vec3(i, 0, 0), vec3(i == 1 ? 2 : 1, 1, 3), NULL));
}

static void sizes_are_told_apart(void)
{
    desk d;
    open_desk(&d, build_sizes);
    const io_stamp *first = stamp_find(d.stamps, &d.tessellator, shape_of(&d, 0));
    CHECK(first && first->shortest == 1);
    const io_stamp *wide = stamp_find(d.stamps, &d.tessellator, shape_of(&d, 1));
    CHECK(wide && wide->mesh == &pcg_mesh_cube && wide->size.x == 2);
    CHECK(stamp_find(d.stamps, &d.tessellator, shape_of(&d, 2)) == first || first == wide);
    close_desk(&d);
}

/* ---- what has none -------------------------------------------------------------------------- */

static void build_exceptions(studio *s)
{
    pcg_run *r = s->call->run;
    pcg_shape *colored = make_corner(s), *smooth = make_corner(s), *loose = make_corner(s);
    pcg_mesh_need_materials(r, colored->mesh);
    pcg_mesh_need_normals(r, smooth->mesh);
    pcg_mesh_add_vertex(r, loose->mesh, vec3(9, 9, 9));
    pcg_shape *broken = make_corner(s), *empty = studio_shape(s, NULL, NULL);
    broken->mesh->position[2].y = NAN;
    studio_emit(s, colored);
    studio_emit(s, smooth);
    studio_emit(s, loose);
    studio_emit(s, broken);
    studio_emit(s, empty);
}

static void what_is_not_plain_has_none(void)
{
    desk d;
    open_desk(&d, build_exceptions);
    for (uint32_t i = 0; i < 5; i++)
        CHECK(!stamp_find(d.stamps, &d.tessellator, shape_of(&d, i)));
    close_desk(&d);
}

/* Where single precision would put two corners in one place, or nowhere. */
static void build_misplaced(studio *s)
{
    pcg_shape *far = studio_box(s, vec3(1e6, 0, 0), vec3(0.1, 1, 1), NULL);
    pcg_shape *farther = studio_box(s, vec3(1e39, 0, 0), vec3(1, 1, 1), NULL);
    pcg_shape *nowhere = studio_box(s, vec3(0, NAN, 0), vec3(1, 1, 1), NULL);
    studio_emit(s, far);
    studio_emit(s, farther);
    studio_emit(s, nowhere);
}

static void what_would_collapse_goes_face_by_face(void)
{
    desk d;
    open_desk(&d, build_misplaced);
    io_batch b = {.stride = IO_PLAIN};
    const pcg_shape *s;
    for (uint32_t i = 0; i < 3; i++) {
        s = shape_of(&d, i);
        const io_stamp *k = stamp_find(d.stamps, &d.tessellator, s);
        CHECK(k && !stamp_put(k, &d.tessellator, s, &b));
        CHECK_INTEGER(b.vertex_count, 0);
        CHECK_INTEGER(b.bounded, 0);
    }
    close_desk(&d);
}

int main(void)
{
    stamp_is_the_faces(IO_PLAIN);
    stamp_is_the_faces(IO_TEXTURED);
    sizes_are_told_apart();
    what_is_not_plain_has_none();
    what_would_collapse_goes_face_by_face();
    return unit_done();
}

/* mesh_test.c - meshes, shapes and scopes: what changes a scope leaves the shape where it is. */
#include <math.h>

#include "runtime/topology.h"
#include "tests/unit/io_studio.h"
#include "tests/unit/outlines.h"

static bool is_near(pcg_vec3 a, pcg_vec3 b)
{
    return vec3_length(vec3_subtract(a, b)) < 1e-9;
}

/* Axes by chance, orthonormal and right-handed. */
static void turn(pcg_scope *s)
{
    pcg_vec3 x = vec3_normal(vec3(share() - 0.5, share() - 0.5, share() - 0.5));
    pcg_vec3 y = vec3_normal(vec3_cross(vec3(share(), 0.3, share() + 0.1), x));

    s->axis[0] = x;
    s->axis[1] = y;
    s->axis[2] = vec3_cross(x, y);
    s->origin = vec3(10 * share(), 10 * share(), 10 * share());
}

static void test_canonical(void)
{
    pcg_shape s = {.scope = {.axis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .size = {4, 3, 2}}};

    s.mesh = (pcg_mesh *)&pcg_mesh_cube;
    CHECK(pcg_shape_volume(&s) == 24 && pcg_shape_area(&s) == 52);
    CHECK(pcg_shape_face_normal(&s, 0).y < 0 && pcg_shape_face_normal(&s, 1).x > 0);
    CHECK(pcg_shape_face_normal(&s, 2).y > 0 && pcg_shape_face_normal(&s, 3).x < 0);
    CHECK(pcg_shape_face_normal(&s, 4).z > 0 && pcg_shape_face_normal(&s, 5).z < 0);
    s.mesh = (pcg_mesh *)&pcg_mesh_square;
    CHECK(pcg_shape_area(&s) == 12 && pcg_shape_face_normal(&s, 0).z == 24);
    s.mesh = (pcg_mesh *)&pcg_mesh_tray;
    CHECK(pcg_shape_area(&s) == 40 && pcg_shape_face_normal(&s, 4).z > 0);
    CHECK(pcg_shape_face_normal(&s, 0).y > 0 && pcg_shape_face_normal(&s, 1).x < 0);
    s.mesh = (pcg_mesh *)&pcg_mesh_cup;
    CHECK(pcg_shape_area(&s) == 40 && pcg_shape_face_normal(&s, 4).z < 0);
    s.mesh = (pcg_mesh *)&pcg_mesh_reveal;
    CHECK(pcg_shape_area(&s) == 28);
    s.mesh = (pcg_mesh *)&pcg_mesh_empty;
    CHECK(pcg_shape_area(&s) == 0 && pcg_shape_volume(&s) == 0 && pcg_shape_holes(&s) == 0);
}

/* A mesh that grows keeps all streams as long as it is. */
static void test_streams(studio *s)
{
    pcg_run *r = s->call->run;
    pcg_mesh *m = pcg_mesh_new(r, false), *copy;

    CHECK(m->face_loop[0] == 0 && m->loop_corner[0] == 0);
    for (uint32_t i = 0; i < 100; i++) {
        uint32_t v = pcg_mesh_add_vertex(r, m, vec3(i, 0, 0));
        uint32_t corner[3] = {v, v > 0 ? v - 1 : v, v > 1 ? v - 2 : v};

        CHECK_INTEGER(pcg_mesh_add_face(r, m, corner, 3), i);
        if (i == 10)
            pcg_mesh_need_uvs(r, m);
        if (i == 20)
            pcg_mesh_need_tags(r, m);
        if (i == 30)
            pcg_mesh_need_materials(r, m);
        if (i == 40)
            pcg_mesh_need_normals(r, m);
        if (i >= 20)
            m->face_tag[i] = i;
        if (i >= 10)
            m->corner_uv[6 * i] = (float)i;
    }
    CHECK_INTEGER(pcg_mesh_add_hole(r, m, (const uint32_t[]){1, 2, 3}, 3), 100);
    CHECK_INTEGER(pcg_mesh_add_edge(r, m, 5, 6), 0);
    copy = pcg_mesh_copy(r, m);
    CHECK(copy->face_count == 100 && copy->loop_count == 101 && copy->corner_count == 303);
    CHECK(copy->edge_count == 1 && copy->edge_vertex[1] == 6);
    for (uint32_t i = 0; i < 100; i++) {
        CHECK_INTEGER(copy->face_tag[i], i < 20 ? 0 : i);
        CHECK(copy->corner_uv[6 * i] == (i < 10 ? 0.0f : (float)i));
        CHECK(copy->corner_normal[9 * i] == 0.0f && copy->face_material[i] == NULL);
        CHECK_INTEGER(copy->corner_vertex[3 * i], i);
    }
    CHECK_INTEGER(copy->face_loop[100], 101);
    pcg_mesh_drop(r, m);
    pcg_mesh_drop(r, copy);
}

static void test_sharing(studio *s)
{
    pcg_run *r = s->call->run;
    pcg_shape *a = studio_box(s, vec3(1, 2, 3), vec3(4, 5, 6), NULL);
    pcg_shape *b = (pcg_shape *)pcg_entity_copy(r, &a->entity, 1);
    pcg_mesh *m;

    CHECK(a->mesh == b->mesh);
    m = pcg_shape_edit(r, a);
    CHECK(m != NULL && m != b->mesh && !m->unit && m->references == 1);
    CHECK(is_near(m->position[6], vec3(4, 5, 6)) && is_near(b->mesh->position[6], vec3(1, 1, 1)));
    CHECK(pcg_shape_edit(r, a) == m);
    pcg_entity_drop(r, &b->entity);
    b = (pcg_shape *)pcg_entity_copy(r, &a->entity, 2);
    CHECK(m->references == 2 && pcg_shape_edit(r, b) != m && m->references == 1);
    pcg_entity_drop(r, &a->entity);
    pcg_entity_drop(r, &b->entity);
}

/* Fitting and aligning leave every vertex where it is in the world. */
static void test_fit_and_align(studio *s)
{
    pcg_run *r = s->call->run;

    for (int n = 0; n < 50; n++) {
        pcg_shape *a = studio_box(s, vec3(0, 0, 0), vec3(1 + share(), 2 + share(), 3), NULL);
        pcg_vec3 world[8], low, high;
        pcg_scope other;

        turn(&a->scope);
        turn(&other);
        for (uint32_t i = 0; i < 8; i++)
            world[i] = pcg_shape_world(a, i);
        CHECK_INTEGER(pcg_shape_fit(r, a), PCG_OK);
        CHECK(a->mesh == &pcg_mesh_cube);
        CHECK_INTEGER(pcg_shape_align(r, a, other.axis), PCG_OK);
        for (uint32_t i = 0; i < 8; i++)
            CHECK(is_near(pcg_shape_world(a, i), world[i]));
        for (uint32_t i = 0; i < 8; i++) {
            pcg_vec3 p = pcg_shape_local(a, i), q = vec3_subtract(a->scope.size, p);

            CHECK(fmin(p.x, fmin(p.y, p.z)) >= 0 && fmin(q.x, fmin(q.y, q.z)) >= -1e-12);
        }
        CHECK(pcg_shape_bounds(a, &low, &high) && low.x < high.x);
        CHECK(is_near(pcg_scope_local(&a->scope, pcg_scope_point(&a->scope, low)), low));
        pcg_entity_drop(r, &a->entity);
    }
}

/* Each face of a box, however it stands, is the unit square in a scope on it; walls are upright. */
static void test_faces(studio *s)
{
    pcg_run *r = s->call->run;

    for (int n = 0; n < 50; n++) {
        pcg_shape *a = studio_box(s, vec3(0, 0, 0), vec3(1 + share(), 2 + share(), 3), NULL);
        double area = 0;

        turn(&a->scope);
        if (n % 2 == 0) { /* upright, turned about z */
            a->scope.axis[0] = vec3_normal(vec3(a->scope.axis[0].x, a->scope.axis[0].y, 0));
            a->scope.axis[2] = vec3(0, 0, 1);
            a->scope.axis[1] = vec3_cross(a->scope.axis[2], a->scope.axis[0]);
        }
        for (uint32_t f = 0; f < 6; f++) {
            pcg_shape *face = pcg_shape_face(s->call, a, f);
            const pcg_scope *o = &face->scope;
            pcg_vec3 out = pcg_scope_direction(&a->scope, pcg_shape_face_normal(a, f));

            CHECK(n % 2 != 0 || face->mesh == &pcg_mesh_square);
            CHECK(is_near(o->axis[2], vec3_normal(out)));
            CHECK(is_near(vec3_cross(o->axis[0], o->axis[1]), o->axis[2]));
            CHECK(f > 3 || n % 2 != 0 || (fabs(o->axis[0].z) < 1e-12 && o->axis[1].z > 0.999));
            area += pcg_shape_area(face);
            pcg_entity_drop(r, &face->entity);
        }
        CHECK(fabs(area - pcg_shape_area(a)) < 1e-9);
        pcg_entity_drop(r, &a->entity);
    }
}

/* Some faces of a box stay canonical; the others get a mesh with their own vertices alone. */
static void test_some_faces(studio *s)
{
    pcg_run *r = s->call->run;
    pcg_shape *a = studio_box(s, vec3(1, 1, 1), vec3(2, 3, 4), NULL);
    pcg_shape *lid = pcg_shape_faces(s->call, a, (const uint32_t[]){0, 1, 2, 3, 4}, 5);
    pcg_shape *cup = pcg_shape_faces(s->call, a, (const uint32_t[]){0, 1, 2, 3, 5}, 5);
    pcg_shape *sides = pcg_shape_faces(s->call, a, (const uint32_t[]){0, 1, 2, 3}, 4);
    pcg_shape *ends = pcg_shape_faces(s->call, a, (const uint32_t[]){4, 5}, 2);
    pcg_shape *corner_sides = pcg_shape_faces(s->call, a, (const uint32_t[]){1, 2}, 2);

    CHECK(lid->mesh == &pcg_mesh_lid && cup->mesh == &pcg_mesh_cup &&
          sides->mesh == &pcg_mesh_sides);
    CHECK(ends->mesh->vertex_count == 8 && pcg_shape_area(ends) == 12);
    CHECK(corner_sides->mesh->vertex_count == 6 && pcg_shape_area(corner_sides) == 20);
    CHECK(!is_closed(r, lid) && is_closed(r, a));
    pcg_entity_drop(r, &a->entity);
    pcg_entity_drop(r, &lid->entity);
    pcg_entity_drop(r, &cup->entity);
    pcg_entity_drop(r, &sides->entity);
    pcg_entity_drop(r, &ends->entity);
    pcg_entity_drop(r, &corner_sides->entity);
}

static void test_append(studio *s)
{
    pcg_run *r = s->call->run;
    const pcg_material *red = studio_material(s, "red", 1, 0, 0, NULL);
    const pcg_material *blue = studio_material(s, "blue", 0, 0, 1, NULL);
    pcg_shape *to = studio_shape(s, NULL, NULL);
    pcg_shape *a = studio_box(s, vec3(0, 0, 0), vec3(1, 2, 3), red);
    pcg_shape *b = studio_box(s, vec3(5, 0, 0), vec3(1, 1, 1), blue);

    turn(&to->scope);
    turn(&b->scope);
    CHECK_INTEGER(pcg_shape_append(r, to, a), PCG_OK);
    CHECK(to->material == red && to->mesh->face_material == NULL);
    CHECK_INTEGER(pcg_shape_append(r, to, a), PCG_OK);
    CHECK(to->mesh->face_material == NULL);
    CHECK_INTEGER(pcg_shape_append(r, to, b), PCG_OK);
    CHECK(pcg_shape_face_material(to, 0) == red && pcg_shape_face_material(to, 12) == blue);
    CHECK_INTEGER(pcg_shape_fit(r, to), PCG_OK);
    CHECK(fabs(pcg_shape_volume(to) - 13) < 1e-9);
    for (uint32_t i = 0; i < 8; i++) {
        CHECK(is_near(pcg_shape_world(to, i), pcg_shape_world(a, i)));
        CHECK(is_near(pcg_shape_world(to, 16 + i), pcg_shape_world(b, i)));
    }
    CHECK(pcg_material_intern(r, red) == red);
    CHECK(pcg_material_intern(r, &pcg_material_default) == &pcg_material_default);
    pcg_entity_drop(r, &to->entity);
    pcg_entity_drop(r, &a->entity);
    pcg_entity_drop(r, &b->entity);
}

static void test_topology(studio *s)
{
    pcg_run *r = s->call->run;
    pcg_shape *to = studio_shape(s, NULL, NULL);
    pcg_shape *box = studio_box(s, vec3(0, 0, 0), vec3(1, 1, 1), NULL);
    uint32_t group[24], count;
    edge_list edges;

    for (int i = 0; i < 4; i++) { /* two that touch along an edge, two apart */
        static const double at[4][3] = {{0, 0, 0}, {1, 1, 0}, {5, 0, 0}, {0, 5, 5e-7}};

        box->scope.origin = vec3(at[i][0], at[i][1], at[i][2]);
        CHECK_INTEGER(pcg_shape_append(r, to, box), PCG_OK);
    }
    CHECK_INTEGER(group_connected(r, to, group, &count), PCG_OK);
    CHECK(count == 3 && group[0] == 0 && group[6] == 0 && group[12] == 1 && group[18] == 2);
    CHECK_INTEGER(edge_list_open(r, to, &edges), PCG_OK);
    CHECK_INTEGER(edges.count, 4 * 12 - 1);
    CHECK(edge_list_find(&edges, 0, 1) != NULL && edge_list_find(&edges, 0, 6) == NULL);
    edge_list_close(r, to, &edges);
    pcg_entity_drop(r, &to->entity);
    pcg_entity_drop(r, &box->entity);
}

static void test_vectors(void)
{
    CHECK(fabs(vec3_length(vec3(3e200, 4e200, 0)) / 5e200 - 1) < 1e-12);
    CHECK(fabs(vec3_length(vec3(0, 3e-200, 4e-200)) / 5e-200 - 1) < 1e-12);
    CHECK(vec3_length(vec3_normal(vec3(1e-310, 0, 0))) == 1 &&
          vec3_length(vec3_normal(vec3(0, 0, 0))) == 0);
    CHECK(vec3_length(vec3_normal(vec3(INFINITY, 0, 0))) == 0);
    CHECK(pcg_tag("") != 0 && pcg_tag("a") != pcg_tag("b"));
}

static void build(studio *s)
{
    test_canonical();
    test_streams(s);
    test_sharing(s);
    test_fit_and_align(s);
    test_faces(s);
    test_some_faces(s);
    test_append(s);
    test_topology(s);
    test_vectors();
}

int main(void)
{
    studio_result made = studio_make(build);

    studio_free(&made);
    return unit_done();
}

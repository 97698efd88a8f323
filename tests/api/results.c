/* results.c - results as flat arrays: points, loops, normals, triangles over holes, materials;
 * attributes as text. */
#include "tests/unit/unit.h"
#include "toy.h"

static pcg_program *program;

/* A frame of 4 m with a hole of 2 m, standing on its edge, of two colours; a cube; and what is no
 * shape. */
static int make_frame(pcg_call *c, toy *g)
{
    static const uint32_t outline[] = {0, 1, 2, 3}, hole[] = {4, 7, 6, 5};
    static const double xs[] = {0, 4, 4, 0, 1, 3, 3, 1}, ys[] = {0, 0, 4, 4, 1, 1, 3, 3};
    pcg_material red = pcg_material_default;
    pcg_shape *s = pcg_shape_new(c, NULL);
    pcg_mesh *m = pcg_mesh_new(c->run, false);
    for (int i = 0; i < 8; i++)
        pcg_mesh_add_vertex(c->run, m, vec3(xs[i], ys[i], 0));
    pcg_mesh_add_face(c->run, m, outline, 4);
    pcg_mesh_add_hole(c->run, m, hole, 4);
    pcg_shape_set_mesh(c->run, s, m);
    s->scope = (pcg_scope){{10, 20, 30}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, {4, 4, 0}};
    red.color = (pcg_color){1, 0, 0, 1};
    red.name = "red";
    s->material = pcg_material_intern(c->run, &red);
    return pcg_emit(c, &g->sorter_odd, &s->entity);
}

static int make_cube(pcg_call *c, toy *g)
{
    pcg_shape *s = pcg_shape_new(c, NULL);
    pcg_shape_set_mesh(c->run, s, pcg_mesh_hold(&pcg_mesh_cube));
    s->scope.size = vec3(1, 2, 3);
    return pcg_emit(c, &g->sorter_odd, &s->entity);
}

static int run(pcg_frame *f)
{
    toy *g = (toy *)f;
    pcg_call c;
    pcg_begin(&c, f, &toy_nodes[TOY_MAKER], &g->maker_instance);
    if (pcg_round(&c, NULL) != PCG_OK || make_frame(&c, g) != PCG_OK || make_cube(&c, g) != PCG_OK)
        return PCG_FAILED;
    pcg_entity *e = pcg_entity_new(&c, &pcg_type_impulse, NULL);
    const pcg_slot side = {1, PCG_LENGTH, &g->initial_side, 0};
    pcg_set_float(f->run, e, &side, 0.1);
    return pcg_emit(&c, &g->sorter_odd, e);
}

static double area_of_triangles(const pcg_mesh_view *v)
{
    double area = 0;
    for (size_t t = 0; t < v->triangle_count; t++) {
        pcg_vec3 p[3];
        for (int k = 0; k < 3; k++)
            memcpy(&p[k], v->points + 3 * v->corner_points[v->triangles[3 * t + (size_t)k]],
                   sizeof p[k]);
        area += vec3_length(vec3_cross(vec3_subtract(p[1], p[0]), vec3_subtract(p[2], p[0]))) / 2;
    }
    return area;
}

static void frame_with_a_hole(pcg_run *r)
{
    pcg_mesh_view v = {.size = sizeof v};
    CHECK_NUMBER(pcg_run_mesh(r, 1, 0, &v), PCG_STATUS_OK);
    CHECK_NUMBER(v.size, sizeof v);
    CHECK_NUMBER(v.point_count, 8);
    CHECK_NUMBER(v.face_count, 1);
    CHECK_NUMBER(v.loop_count, 2);
    CHECK_NUMBER(v.corner_count, 8);
    CHECK_NUMBER(v.face_loops[1], 2);
    CHECK_NUMBER(v.loop_corners[1], 4);
    CHECK_NUMBER(v.triangle_count, 8);
    CHECK(fabs(area_of_triangles(&v) - 12) < 1e-12);
    CHECK_NUMBER(v.points[3 * 2], 14);
    CHECK_NUMBER(v.points[3 * 2 + 1], 20);
    CHECK_NUMBER(v.points[3 * 2 + 2], 34);
    CHECK_NUMBER(v.normals[0], 0);
    CHECK_NUMBER(v.normals[1], -1);
    CHECK_NUMBER(v.normals[2], 0);
    CHECK(v.uvs == NULL);
    CHECK_NUMBER(v.triangle_faces[7], 0);
    CHECK_NUMBER(v.face_materials[0], 0);
    pcg_mesh_view again = {.size = offsetof(pcg_mesh_view, face_count)};
    CHECK_NUMBER(pcg_run_mesh(r, 1, 0, &again), PCG_STATUS_OK);
    CHECK_NUMBER(again.point_count, 8);
    CHECK(again.points == NULL);
}

static void cube(pcg_run *r)
{
    pcg_mesh_view v = {.size = sizeof v};
    CHECK_NUMBER(pcg_run_mesh(r, 1, 1, &v), PCG_STATUS_OK);
    CHECK_NUMBER(v.face_count, 6);
    CHECK_NUMBER(v.triangle_count, 12);
    CHECK(fabs(area_of_triangles(&v) - 22) < 1e-12);
    for (size_t f = 0; f < 6; f++)
        CHECK_NUMBER(v.face_materials[f], 1);
}

static void materials(pcg_run *r)
{
    pcg_material_view m = {.size = sizeof m};
    CHECK_NUMBER(pcg_run_material_count(r), 2);
    CHECK_NUMBER(pcg_run_material(r, 0, &m), PCG_STATUS_OK);
    CHECK_TEXT(m.name, "red");
    CHECK_NUMBER(m.color[0], 1);
    CHECK_NUMBER(m.color[1], 0);
    CHECK(m.texture == NULL);
    CHECK_NUMBER(pcg_run_material(r, 1, &m), PCG_STATUS_OK);
    CHECK_NUMBER(m.color[0], pcg_material_default.color.r);
    CHECK_NUMBER(pcg_run_material(r, 2, &m), PCG_STATUS_MISUSE);
}

static void what_is_no_shape(pcg_run *r)
{
    pcg_mesh_view v = {.size = sizeof v};
    double side = 0;
    CHECK_NUMBER(pcg_run_mesh(r, 1, 2, &v), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "entity 2 of output 1 is of type Impulse, which has no mesh");
    CHECK_NUMBER(pcg_run_mesh(r, 9, 0, &v), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_attribute(r, 1, 2, "side"), "0.1m");
    CHECK_NUMBER(pcg_run_attribute_float(r, 1, 2, "side", &side), PCG_STATUS_OK);
    CHECK_NUMBER(side, 0.1);
    CHECK_NUMBER(pcg_run_attribute_float(r, 1, 2, "size", &side), PCG_STATUS_MISUSE);
    CHECK_NUMBER(pcg_run_attribute_float(r, 1, 3, "side", &side), PCG_STATUS_MISUSE);
}

int main(void)
{
    pcg_module made = toy_module;
    made.run = run;
    program = pcg_program_of(&made);
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_NUMBER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_NUMBER(pcg_run_face_count(r), 7);
    CHECK_NUMBER(pcg_run_vertex_count(r), 16);
    frame_with_a_hole(r);
    cube(r);
    materials(r);
    what_is_no_shape(r);
    pcg_run_free(r);
    pcg_program_free(program);
    return unit_done();
}

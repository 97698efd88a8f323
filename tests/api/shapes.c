/* shapes.c - whole shapes in and out: holes, lines, uvs, normals, materials, attributes; all shapes
 * of an output as one mesh; what a host of an older header gets. */
#include "runtime/pcg.h"
#include "tests/unit/unit.h"

static const char graph[] = "graph lots {\n"
                            "    param cell: length = 2m range [1m, 5m]\n"
                            "    param side: Axis = x\n"
                            "    param style: string = \"old\" one of (\"old\", \"new\")\n"
                            "    attr levels: int = 1\n"
                            "    attr width: length = 3m\n"
                            "    attr tint: color = #ff0000\n"
                            "    attr name: string = \"none\"\n"
                            "    in lot: Shape\n"
                            "    in other: Shape[]\n"
                            "    out kept: Shape\n"
                            "    lot -> kept\n"
                            "    other -> merge() -> grown: extrude(amount = cell)\n"
                            "}\n";

/* A square of 4 m with a hole of 2 m, and a triangle; two lines. Two materials. */
static const double points[] = {10, 0, 5, 14, 0, 5, 14, 4, 5, 10, 4, 5, 11, 1, 5, 13, 1, 5,
                                13, 3, 5, 11, 3, 5, 20, 0, 5, 22, 0, 5, 20, 2, 5};
static const uint32_t face_loops[] = {0, 2, 3}, loop_corners[] = {0, 4, 8, 11},
                      corner_points[] = {0, 1, 2, 3, 4, 7, 6, 5, 8, 9, 10},
                      face_materials[] = {1, 0}, edges[] = {0, 8, 8, 10};
static const float uvs[] = {0, 0, 1, 0, 1, 1, 0, 1, .25f, .25f, .25f, .75f, .75f, .75f, .75f, .25f,
                            0, 0, 2, 0, 0, 2};
static const pcg_material_view materials[] = {
    {.size = sizeof materials[0], .name = "grass", .color = {0, 0.5, 0, 1}, .roughness = 1},
    {.size = sizeof materials[0], .name = "paving", .color = {0.5, 0.5, 0.5, 7}, .roughness = 0.25,
     .metallic = -1, .texture = "/nowhere/paving.jpg", .two_sided = true}};
static const pcg_mesh_view square = {.size = sizeof square,
                                     .point_count = 11,
                                     .face_count = 2,
                                     .loop_count = 3,
                                     .corner_count = 11,
                                     .edge_count = 2,
                                     .points = points,
                                     .face_loops = face_loops,
                                     .loop_corners = loop_corners,
                                     .corner_points = corner_points,
                                     .face_materials = face_materials,
                                     .edges = edges,
                                     .uvs = uvs};

static pcg_program *program;

static void feed(pcg_run *r)
{
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &square, materials, 2), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_attribute(r, "levels", "4"), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_attribute(r, "tint", "#0000ff"), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_attribute(r, "name", "corner shop"), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_attribute_float(r, "width", 2.5), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &square, NULL, 0), PCG_STATUS_MISUSE);
    CHECK_PART(pcg_run_error(r), "face_materials names a material");
    pcg_mesh_view plain = square;
    plain.face_materials = NULL;
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &plain, NULL, 0), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_attribute_float(r, "levels", 7), PCG_STATUS_OK);
}

static void same_numbers(const uint32_t *found, const uint32_t *expected, size_t count)
{
    CHECK(found && !memcmp(found, expected, count * sizeof *found));
}

/* The shape is as it was fed. */
static void is_square(pcg_run *r, const pcg_mesh_view *v)
{
    CHECK_INTEGER(v->point_count, 11);
    CHECK_INTEGER(v->face_count, 2);
    CHECK_INTEGER(v->loop_count, 3);
    CHECK_INTEGER(v->corner_count, 11);
    CHECK_INTEGER(v->edge_count, 2);
    CHECK_INTEGER(v->triangle_count, 9);
    for (size_t i = 0; i < 33; i++)
        CHECK_NUMBER(v->points[i], points[i]);
    same_numbers(v->face_loops, face_loops, 3);
    same_numbers(v->loop_corners, loop_corners, 4);
    same_numbers(v->corner_points, corner_points, 11);
    same_numbers(v->edges, edges, 4);
    CHECK(v->uvs && !memcmp(v->uvs, uvs, sizeof uvs));
    pcg_material_view m = {.size = sizeof m};
    CHECK_INTEGER(pcg_run_material(r, v->face_materials[0], &m), PCG_STATUS_OK);
    CHECK_TEXT(m.name, "paving");
    CHECK_TEXT(m.texture, "/nowhere/paving.jpg");
    CHECK_NUMBER(m.color[3], 1);
    CHECK_NUMBER(m.metallic, 0);
    CHECK_NUMBER(m.roughness, 0.25);
    CHECK(m.two_sided);
    CHECK_INTEGER(pcg_run_material(r, v->face_materials[1], &m), PCG_STATUS_OK);
    CHECK_TEXT(m.name, "grass");
}

static void attributes_came_along(pcg_run *r)
{
    double levels[2], widths[2], tints[8];
    CHECK_INTEGER(pcg_run_attribute_floats(r, 0, "levels", 1, levels), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_attribute_floats(r, 0, "width", 1, widths), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_attribute_floats(r, 0, "tint", 4, tints), PCG_STATUS_OK);
    CHECK_NUMBER(levels[0], 4);
    CHECK_NUMBER(levels[1], 7);
    CHECK_NUMBER(widths[0], 2.5);
    CHECK_NUMBER(widths[1], 3);
    CHECK_NUMBER(tints[2], 1);
    CHECK_NUMBER(tints[4], 1);
    CHECK_NUMBER(tints[6], 0);
    CHECK_PART(pcg_run_attribute(r, 0, 0, "name"), "corner shop");
    CHECK_INTEGER(pcg_run_attribute_floats(r, 0, "tint", 3, tints), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "attribute 'tint' is of type color, which has 4 numbers, not 3");
    CHECK_INTEGER(pcg_run_attribute_floats(r, 0, "name", 1, tints), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_attribute_floats(r, 0, "weight", 1, tints), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_program_attribute_type(program, 1), "length");
    CHECK(pcg_program_attribute_type(program, 4) == NULL);
}

/* Both shapes as one mesh: the second one's numbers stand behind the first one's. */
static void one_mesh_of_all(pcg_run *r)
{
    pcg_mesh_view v = {.size = sizeof v}, one = {.size = sizeof one};
    CHECK_INTEGER(pcg_run_output_mesh(r, 0, &v), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_mesh(r, 0, 1, &one), PCG_STATUS_OK);
    CHECK_INTEGER(v.face_count, 4);
    CHECK_INTEGER(v.point_count, 22);
    CHECK_INTEGER(v.triangle_count, 18);
    CHECK_INTEGER(v.edge_count, 4);
    for (uint32_t f = 0; f < 4; f++)
        CHECK_INTEGER(v.face_entities[f], f / 2);
    CHECK(one.face_entities == NULL);
    CHECK_INTEGER(v.face_loops[4], 6);
    CHECK_INTEGER(v.loop_corners[6], 22);
    CHECK_INTEGER(v.edges[5], 19);
    CHECK_INTEGER(v.triangle_faces[17], 3);
    for (size_t i = 0; i < 11; i++) {
        CHECK_INTEGER(v.corner_points[11 + i], one.corner_points[i] + 11);
        CHECK_NUMBER(v.points[3 * (11 + i)], one.points[3 * i]);
        CHECK_NUMBER(v.normals[3 * (11 + i) + 2], one.normals[3 * i + 2]);
    }
    for (size_t i = 0; i < 27; i++)
        CHECK_INTEGER(v.triangles[27 + i], one.triangles[i] + 11);
    CHECK_INTEGER(pcg_run_output_mesh(r, 1, &v), PCG_STATUS_OK);
    CHECK_INTEGER(v.face_count, 0);
    CHECK_INTEGER(v.face_loops[0], 0);
    CHECK_INTEGER(pcg_run_output_mesh(r, 2, &v), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "graph 'lots' has no output 2");
}

/* What came out goes into another run, materials and all. */
static void feeds_another_run(pcg_run *from)
{
    pcg_material_view all[8];
    pcg_mesh_view v = {.size = sizeof v};
    size_t count = pcg_run_material_count(from);
    CHECK_INTEGER(count, 3);
    for (uint32_t i = 0; i < count; i++) {
        all[i].size = sizeof all[i];
        CHECK_INTEGER(pcg_run_material(from, i, &all[i]), PCG_STATUS_OK);
    }
    CHECK_INTEGER(pcg_run_mesh(from, 0, 0, &v), PCG_STATUS_OK);
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &v, all, count), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_mesh(r, 0, 0, &v), PCG_STATUS_OK);
    is_square(r, &v);
    pcg_run_free(r);
}

static void comes_out_as_it_went_in(void)
{
    pcg_mesh_view v = {.size = sizeof v};
    pcg_run *r = pcg_run_new(program, NULL);
    feed(r);
    CHECK_INTEGER(pcg_run_output_mesh(r, 0, &v), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_output_count(r, 0), 2);
    CHECK_INTEGER(pcg_run_mesh(r, 0, 0, &v), PCG_STATUS_OK);
    is_square(r, &v);
    attributes_came_along(r);
    one_mesh_of_all(r);
    feeds_another_run(r);
    CHECK_TEXT(pcg_run_entity_type(r, 0, 0), "Shape");
    CHECK_TEXT(pcg_run_entity_node(r, 0, 0), "");
    CHECK(pcg_run_entity_type(r, 0, 2) == NULL && pcg_run_entity_node(r, 0, 2) == NULL);
    CHECK(pcg_run_message_count(r) > 0);
    CHECK_TEXT(pcg_run_message(r, 0)->text, "attribute 'levels' is never used");
    CHECK(pcg_run_message(r, pcg_run_message_count(r)) == NULL);
    pcg_run_free(r);
}

/* ---- what makes no sense --------------------------------------------------------------------- */

static void refuses(pcg_run *r, const pcg_mesh_view *v, const char *why)
{
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", v, materials, 2), PCG_STATUS_MISUSE);
    CHECK_PART(pcg_run_error(r), why);
}

static void refuses_meshes(pcg_run *r)
{
    static const uint32_t backward[] = {0, 3, 2}, behind[] = {1, 2, 3},
                          short_loop[] = {0, 4, 6, 11}, empty_face[] = {0, 3, 3},
                          far[] = {0, 1, 2, 3, 4, 7, 6, 5, 8, 9, 11};
    static const float endless[22] = {[21] = HUGE_VALF};
    static const double no_number[33] = {[32] = (double)NAN};
    pcg_mesh_view v;
    refuses(r, NULL, "there is no mesh");
    v = square, v.face_loops = backward, refuses(r, &v, "face_loops does not divide 3 loops");
    v = square, v.face_loops = behind, refuses(r, &v, "face_loops does not divide 3 loops");
    v = square, v.face_loops = empty_face, refuses(r, &v, "face_loops does not divide 3 loops");
    v = square, v.face_loops = NULL, refuses(r, &v, "face_loops does not divide 3 loops");
    v = square, v.loop_corners = short_loop, refuses(r, &v, "loop_corners does not divide 11");
    v = square, v.loop_corners = NULL, refuses(r, &v, "loop_corners does not divide 11");
    v = square, v.corner_points = far, refuses(r, &v, "corner_points names a point");
    v = square, v.corner_points = NULL, refuses(r, &v, "corner_points names a point");
    v = square, v.edges = far + 9, refuses(r, &v, "edges names a point");
    v = square, v.uvs = endless, refuses(r, &v, "uvs holds a number that is not finite");
    v = square, v.points = no_number, refuses(r, &v, "point 10 has no finite position");
    v = square, v.corner_count = SIZE_MAX, refuses(r, &v, "too many corners or edges");
    v = square, v.face_count = v.edge_count = 0, refuses(r, &v, "needs a face or an edge");
}

static void refuses_what_makes_no_sense(void)
{
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_INTEGER(pcg_run_input_attribute(r, "levels", "4"), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "attribute 'levels' is set before a shape was fed");
    refuses_meshes(r);
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &square, NULL, 2), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_shape(r, "plot", &square, materials, 2), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &square, materials, 2), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_input_attribute(r, "levels", "many"), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_attribute(r, "levels", NULL), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_attribute(r, "level", "1"), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_attribute_float(r, "width", (double)NAN), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_attribute_float(r, "levels", 1e300), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_input_attribute_float(r, "name", 1), PCG_STATUS_MISUSE);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_output_count(r, 0), 1);
    CHECK_INTEGER(pcg_run_input_attribute(r, "levels", "4"), PCG_STATUS_MISUSE);
    pcg_run_free(r);
}

/* ---- the rest -------------------------------------------------------------------------------- */

static void tells_what_parameters_may_be(void)
{
    double low = 0, high = 0;
    CHECK(pcg_program_parameter_range(program, 0, &low, &high));
    CHECK_NUMBER(low, 1);
    CHECK_NUMBER(high, 5);
    CHECK(!pcg_program_parameter_range(program, 1, &low, &high));
    CHECK(!pcg_program_parameter_range(program, 3, &low, &high));
    CHECK(pcg_program_parameter_choices(program, 0) == NULL);
    CHECK_TEXT(pcg_program_parameter_choices(program, 1), "x\ny\nz");
    CHECK_PART(pcg_program_parameter_choices(program, 2), "old");
    CHECK(pcg_program_parameter_choices(program, 3) == NULL);
    CHECK_TEXT(pcg_version(), PCG_VERSION);
}

/* It knows the counts only: nothing behind them is written, nothing behind them is read. */
static void serves_an_older_host(void)
{
    struct { pcg_mesh_view known; } older;
    pcg_run *r = pcg_run_new(program, NULL);
    CHECK_INTEGER(pcg_run_input_shape(r, "lot", &square, materials, 2), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    memset(&older, 0x55, sizeof older);
    older.known.size = offsetof(pcg_mesh_view, points);
    CHECK_INTEGER(pcg_run_mesh(r, 0, 0, &older.known), PCG_STATUS_OK);
    CHECK_INTEGER(older.known.size, offsetof(pcg_mesh_view, points));
    CHECK_INTEGER(older.known.triangle_count, 9);
    const unsigned char *behind = (const unsigned char *)&older.known.points;
    CHECK(behind[0] == 0x55 && behind[sizeof older.known.points] == 0x55);
    pcg_run_free(r);
}

int main(void)
{
    program = pcg_compile_text(graph, sizeof graph - 1, "lots.pcg", NULL);
    CHECK(program != NULL);
    if (program) {
        comes_out_as_it_went_in();
        refuses_what_makes_no_sense();
        tells_what_parameters_may_be();
        serves_an_older_host();
    }
    pcg_program_free(program);
    return unit_done();
}

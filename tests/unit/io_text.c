/* io_text.c - OBJ with its materials, and JSON: exact texts. */
#include <math.h>

#include "tests/unit/io_studio.h"

/* What the file holds; CHECK_TEXT shows both where they differ. */
static void file_is(const char *name, const char *expected)
{
    char *content = studio_read(name, NULL);
    CHECK_TEXT(content, expected);
    free(content);
}

/* ---- OBJ ------------------------------------------------------------------------------------- */

static char texture_path[512];

static void build_window(studio *s)
{
    static const double frame[] = {0, 0, 0, 4, 0, 0, 4, 0, 3, 0, 0, 3};
    static const double hole[][3] = {{1, 0, 2}, {3, 0, 2}, {3, 0, 1}, {1, 0, 1}};
    static const double pane[] = {1, 0.25, 1, 3, 0.25, 1, 2, 0.25, 1.5, 3, 0.25, 2, 1, 0.25, 2};
    static const float uv[] = {0, 0, 1, 0, 0.5f, 0.25f, 1, 1, 0, 1};
    pcg_run *r = s->call->run;
    pcg_material glass = *studio_material(s, "my glass", 0.25, 0.5, 1, pcg_string(r, texture_path));
    glass.color.a = 0.5;
    pcg_shape *wall = studio_shape(s, NULL, studio_material(s, "", 0.8, 0.7, 0.6, NULL));
    pcg_shape *window = studio_shape(s, NULL, pcg_material_intern(r, &glass));
    uint32_t v[4];
    studio_face(s, wall, frame, 4);
    for (int i = 0; i < 4; i++)
        v[i] = pcg_mesh_add_vertex(r, wall->mesh, vec3(hole[i][0], hole[i][1], hole[i][2]));
    pcg_mesh_add_hole(r, wall->mesh, v, 4);
    studio_face(s, window, pane, 5);
    pcg_mesh_need_uvs(r, window->mesh);
    memcpy(window->mesh->corner_uv, uv, sizeof uv);
    studio_emit(s, wall);
    studio_emit(s, window);
}

static void faces_stay_polygons_unless_they_have_holes(void)
{
    studio_result r = studio_make(build_window);
    studio_write("pane.jpg", "\xff\xd8\xff\xe0 not much of a picture", 26);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("my window.obj"), NULL, NULL), PCG_STATUS_OK);
    char *content = studio_read("my window.obj", NULL);
    const char *walls = content ? strstr(content, "usemtl material\n") : NULL;
    const char *panes = content ? strstr(content, "usemtl my_glass\n") : NULL;
    int triangles = 0;
    CHECK(content && strncmp(content,
                             "# pcgc " PCG_VERSION ": metres, y up\nmtllib my window.mtl\no model\n"
                             "g maker\nv 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 1 2 0\n",
                             100) == 0);
    for (const char *f = walls; f && panes && (f = strstr(f, "\nf ")) && f < panes; f++)
        triangles++;
    CHECK_INTEGER(triangles, 8);
    CHECK(content && strstr(content, "\nv 2 1.5 -0.25\n") && strstr(content, "\nvt 0.5 0.25\n"));
    CHECK_TEXT(panes, "usemtl my_glass\nf 9/1 10/2 11/3 12/4 13/5\no extra\n");
    free(content);
    file_is("my window.mtl", "# pcgc " PCG_VERSION "\n\n"
                             "newmtl material\nKd 0.8 0.7 0.6\nKs 0 0 0\nPr 0.9\nPm 0\nillum 1\n\n"
                             "newmtl my_glass\nKd 0.25 0.5 1\nKs 0 0 0\nd 0.5\nPr 0.9\nPm 0\n"
                             "illum 1\nmap_Kd my_window_pane.jpg\n");
    file_is("my_window_pane.jpg", "\xff\xd8\xff\xe0 not much of a picture");
    studio_free(&r);
    CHECK_INTEGER(studio_files(1), 4);
}

static void build_odd(studio *s)
{
    const double bad[] = {0, 0, 0, 0, NAN, 0, 1, 1, 0};
    pcg_run *r = s->call->run;
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    pcg_mesh_add_vertex(r, shape->mesh, vec3(-0.0, 1e-9, -1234.5678901));
    pcg_mesh_add_vertex(r, shape->mesh, vec3(1e15, -0.125, 0.1));
    pcg_mesh_add_vertex(r, shape->mesh, vec3(7, 8, 9));
    pcg_mesh_add_edge(r, shape->mesh, 0, 1);
    studio_face(s, shape, bad, 3);
    studio_emit(s, shape);
    pcg_shape *box = studio_box(s, vec3(0, 0, 0), vec3(1, 1, 1), NULL);
    studio_emit(s, box);
}

/* Indices count over the whole file; what is not finite takes none. */
static void lines_points_and_numbers(void)
{
    char messages[512];
    studio_result r = studio_make(build_odd);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("odd.obj"), NULL, NULL), PCG_STATUS_OK);
    char *content = studio_read("odd.obj", NULL);
    CHECK(content &&
          strstr(content, "v 0 -1234.56789 0\nv 1000000000000000 0.1 0.125\nv 7 9 -8\nv 0 0 0\n"
                          "v 1 0 -1\nusemtl material\nl 1 2\np 3\nv 0 0 0\nv 1 0 0\n"));
    CHECK(content && strstr(content, "\nf 6 7 11 10\nf 7 8 12 11\n"));
    studio_messages(&r, messages, sizeof messages);
    CHECK_TEXT(messages,
               "a face, edge or point was left out: its coordinates are not finite\n");
    free(content);
    studio_free(&r);
    CHECK_INTEGER(studio_files(1), 2);
}

static void build_same_names(studio *s)
{
    studio_emit(
        s, studio_box(s, vec3(0, 0, 0), vec3(1, 1, 1), studio_material(s, "a", 0, 0, 0, NULL)));
    studio_emit(
        s, studio_box(s, vec3(2, 0, 0), vec3(1, 1, 1), studio_material(s, "a_2", 0, 0, 0, NULL)));
    studio_emit(
        s, studio_box(s, vec3(4, 0, 0), vec3(1, 1, 1), studio_material(s, "a", 1, 0, 0, NULL)));
    studio_emit(
        s, studio_box(s, vec3(6, 0, 0), vec3(1, 1, 1), studio_material(s, "a", 0, 1, 0, NULL)));
}

static void materials_have_names_of_their_own(void)
{
    studio_result r = studio_make(build_same_names);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("n.obj"), NULL, NULL), PCG_STATUS_OK);
    char *content = studio_read("n.mtl", NULL);
    CHECK(content && strstr(content, "newmtl a\nKd 0 0 0") &&
          strstr(content, "newmtl a_2\nKd 0 0 0") && strstr(content, "newmtl a_3\nKd 1 0 0") &&
          strstr(content, "newmtl a_4\nKd 0 1 0"));
    free(content);
    studio_free(&r);
    studio_files(1);
}

static void build_smooth(studio *s)
{
    static const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0.6f, 0, 0.8f};
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    studio_face(s, shape, points, 3);
    pcg_mesh_need_normals(s->call->run, shape->mesh);
    memcpy(shape->mesh->corner_normal, normals, sizeof normals);
    studio_emit(s, shape);
}

static void corners_have_normals(void)
{
    studio_result r = studio_make(build_smooth);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("s.obj"), NULL, NULL), PCG_STATUS_OK);
    char *content = studio_read("s.obj", NULL);
    CHECK(content &&
          strstr(content, "vn 0 1 0\nvn 0 1 0\nvn 0.6 0.8 0\nusemtl material\nf 1//1 2//2 3//3\n"));
    free(content);
    studio_free(&r);
    studio_files(1);
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static void build_measured(studio *s)
{
    const pcg_slot floor_slot = {0, PCG_INT, &s->initial_floor, 0};
    const pcg_slot label = {1, PCG_STRING, &s->initial_label, 0};
    pcg_shape *box = studio_box(s, vec3(1, 2, 3), vec3(2, 3, 0.1), NULL);
    pcg_set_int(s->call->run, &box->entity, &floor_slot, -3);
    pcg_set_string(s->call->run, &box->entity, &label, "a \"b\"\n\x01\xff");
    studio_emit(s, box);
    studio_emit(s, studio_shape(s, &pcg_mesh_square, NULL));
    pcg_entity *plain = pcg_entity_new(s->call, &pcg_type_entity, NULL);
    pcg_emit(s->call, &s->extra_out, plain);
    pcg_warn(s->call, "a warning");
}

static const char json_head[] =
    "{\"version\":1,\"graph\":\"studio\",\"seed\":0,\"outputs\":[{\"port\":\"model\","
    "\"type\":\"Shape\",\"count\":2,\"faces\":7,\"vertices\":12,\"holes\":0,\"area\":14,"
    "\"volume\":0.6000000000000001,\"bounds\":[[0,0,0],[3,5,3.1]]";
static const char json_entities[] =
    ",\"entities\":[{\"node\":\"maker\",\"type\":\"Shape\",\"faces\":6,\"area\":13,"
    "\"bounds\":[[1,2,3],[3,5,3.1]],"
    "\"attributes\":{\"floor\":-3,\"label\":\"a \\\"b\\\"\\n\\u0001?\"}},"
    "{\"node\":\"maker\",\"type\":\"Shape\",\"faces\":1,\"area\":1,\"bounds\":[[0,0,0],[1,1,0]],"
    "\"attributes\":{\"floor\":0,\"label\":\"none\"}}]";
static const char json_extra[] = "},{\"port\":\"extra\",\"type\":\"Entity\",\"count\":1";
static const char json_extra_entities[] = ",\"entities\":[{\"node\":\"maker\",\"type\":\"Entity\","
                                          "\"attributes\":{\"floor\":0,\"label\":\"none\"}}]";
static const char json_end[] =
    "}],\"diagnostics\":[{\"severity\":\"warning\",\"code\":\"W0701\",\"message\":\"a warning\","
    "\"file\":\"studio.pcg\",\"line\":4,\"column\":5,\"node\":\"maker\",\"round\":1}]}\n";

static void json_has_every_key_in_order(void)
{
    char expected[4096];
    const pcg_write_options all = {.size = sizeof all, .entities = true};
    studio_result r = studio_make(build_measured);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("m.json"), NULL, NULL), PCG_STATUS_OK);
    snprintf(expected, sizeof expected, "%s%s%s", json_head, json_extra, json_end);
    file_is("m.json", expected);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("m.json"), NULL, &all), PCG_STATUS_OK);
    snprintf(expected, sizeof expected, "%s%s%s%s%s", json_head, json_entities, json_extra,
             json_extra_entities, json_end);
    file_is("m.json", expected);
    studio_free(&r);
}

static void build_unmeasurable(studio *s)
{
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(NAN, 1, 1), NULL));
}

/* JSON has no form for what is not finite. */
static void json_of_what_is_not_finite(void)
{
    studio_result r = studio_make(build_unmeasurable);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("n.json"), NULL, NULL), PCG_STATUS_OK);
    char *content = studio_read("n.json", NULL);
    CHECK(content && strstr(content, "\"area\":null,\"volume\":null") && !strstr(content, "nan"));
    free(content);
    studio_free(&r);
}

int main(void)
{
    studio_open_folder();
    snprintf(texture_path, sizeof texture_path, "%s", studio_path("pane.jpg"));
    faces_stay_polygons_unless_they_have_holes();
    lines_points_and_numbers();
    materials_have_names_of_their_own();
    corners_have_normals();
    json_has_every_key_in_order();
    json_of_what_is_not_finite();
    studio_close_folder();
    return unit_done();
}

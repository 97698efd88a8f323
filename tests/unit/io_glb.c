/* io_glb.c - binary glTF: its frame, nodes and attributes, shared meshes, materials, what is
 * left out, streaming. */
#include <math.h>
#include <stdbool.h>
#include <sys/stat.h>

#include "stdlib/io/io.h"
#include "tests/unit/io_studio.h"

typedef struct model {
    char *file; /* owns all */
    char *json; /* NUL-terminated */
    const unsigned char *binary;
    size_t size, json_size, binary_size;
} model;

static uint32_t word_at(const char *bytes)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

/* Reads the file and checks its frame. */
static model open_model(const char *name)
{
    model m = {.file = studio_read(name, NULL)};
    CHECK(m.file != NULL);
    if (!m.file)
        exit(unit_done() + 1);
    CHECK(word_at(m.file) == 0x46546c67 && word_at(m.file + 4) == 2);
    m.size = word_at(m.file + 8);
    m.json_size = word_at(m.file + 12);
    CHECK(m.json_size % 4 == 0 && word_at(m.file + 16) == 0x4e4f534a);
    if (m.size > 20 + m.json_size) {
        m.binary_size = word_at(m.file + 20 + m.json_size);
        CHECK(word_at(m.file + 24 + m.json_size) == 0x004e4942);
        CHECK(m.size == 28 + m.json_size + m.binary_size);
    }
    m.json = calloc(1, m.json_size + 1);
    memcpy(m.json, m.file + 20, m.json_size);
    m.binary = (unsigned char *)m.file + 28 + m.json_size;
    return m;
}

static void close_model(model *m)
{
    free(m->file);
    free(m->json);
}

static int occurrences(const char *in, const char *what)
{
    int count = 0;
    for (const char *s = in; (s = strstr(s, what)); s += strlen(what))
        count++;
    return count;
}

static bool has(const model *m, const char *part)
{
    bool found = strstr(m->json, part) != NULL;
    if (!found)
        printf("    no %s in %s\n", part, m->json_size < 4000 ? m->json : "a long text");
    return found;
}

static model write_model(void (*build)(studio *s), const pcg_write_options *options, char *messages)
{
    studio_result r = studio_make(build);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("m.glb"), NULL, options), PCG_STATUS_OK);
    if (messages)
        studio_messages(&r, messages, 1024);
    studio_free(&r);
    return open_model("m.glb");
}

/* ---- one of everything ----------------------------------------------------------------------- */

static void set_floor(studio *s, pcg_entity *e, pcg_int floor)
{
    const pcg_slot slot = {0, PCG_INT, &s->initial_floor, 0};
    pcg_set_int(s->call->run, e, &slot, floor);
}

static void build_one_box(studio *s)
{
    pcg_shape *box = studio_box(s, vec3(1, 2, 3), vec3(4, 5, 6),
                                studio_material(s, "clay \"red\"", 0.5, 0, 1, NULL));
    set_floor(s, &box->entity, 7);
    studio_emit(s, box);
}

/* z becomes y, y becomes -z; colours become linear; a box is closed, so it needs one side. */
static void box_as_it_stands_in_the_file(void)
{
    model m = write_model(build_one_box, NULL, NULL);
    CHECK(has(&m, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"pcgc " PCG_VERSION "\"}"));
    CHECK(has(&m, "\"scenes\":[{\"nodes\":[0,2]}]"));
    CHECK(has(&m, "{\"name\":\"model\",\"children\":[1],\"extras\":{\"entities\":1}}"));
    CHECK(has(&m, "{\"name\":\"maker\",\"mesh\":0,"
                  "\"extras\":{\"floor\":7,\"label\":\"none\"}}"));
    CHECK(has(&m, "{\"name\":\"extra\",\"extras\":{\"entities\":0}}"));
    CHECK(has(&m, "\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2,\"material\":0}"));
    CHECK(has(&m, "\"count\":24,\"type\":\"VEC3\",\"min\":[1,3,-7],\"max\":[5,9,-2]}"));
    CHECK(has(&m, "\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\""));
    CHECK(has(&m, "{\"name\":\"clay \\\"red\\\"\",\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                  "[0.214041,0,1,1],\"metallicFactor\":0,\"roughnessFactor\":0.9}}"));
    CHECK_INTEGER(m.binary_size, 24 * 24 + 36 * 2);
    close_model(&m);
}

/* Every normal has length 1 and looks away from the middle of the box. */
static void normals_look_outward(void)
{
    model m = write_model(build_one_box, NULL, NULL);
    int outward = 0;
    for (int v = 0; v < 24; v++) {
        float p[6];
        memcpy(p, m.binary + 24 * v, sizeof p);
        double out = (double)((p[0] - 3) * p[3] + (p[1] - 6) * p[4] + (p[2] + 4.5f) * p[5]);
        double length = (double)(p[3] * p[3] + p[4] * p[4] + p[5] * p[5]);
        outward += out > 1 && fabs(length - 1) < 1e-6;
    }
    CHECK_INTEGER(outward, 24);
    close_model(&m);
}

static void build_nothing(studio *s)
{
    (void)s;
}

static void empty_result_is_a_model(void)
{
    model m = write_model(build_nothing, NULL, NULL);
    CHECK(has(&m, "\"nodes\":[{\"name\":\"model\",\"extras\":{\"entities\":0}},"));
    CHECK(!strstr(m.json, "meshes") && !strstr(m.json, "buffers") && m.binary_size == 0);
    close_model(&m);
}

/* ---- many entities --------------------------------------------------------------------------- */

static void build_tiles(studio *s, int count)
{
    const pcg_material *grey = studio_material(s, "grey", 0.5, 0.5, 0.5, NULL);
    for (int i = 0; i < count; i++) {
        pcg_shape *tile = studio_shape(s, &pcg_mesh_square, grey);
        tile->scope.origin = vec3(i, 0, 0);
        studio_emit(s, tile);
    }
}

static void build_few_tiles(studio *s)
{
    build_tiles(s, 3);
    pcg_shape *turned =
        studio_shape(s, &pcg_mesh_square, studio_material(s, "grey", 0.5, 0.5, 0.5, NULL));
    turned->scope.axis[0] = vec3(0, 1, 0);
    turned->scope.axis[1] = vec3(-1, 0, 0);
    studio_emit(s, turned);
    pcg_shape *larger = studio_shape(s, &pcg_mesh_square, turned->material);
    larger->scope.size = vec3(2, 1, 1);
    studio_emit(s, larger);
}

/* What is equal in its scope is one mesh under several nodes. */
static void equal_shapes_share_a_mesh(void)
{
    model m = write_model(build_few_tiles, NULL, NULL);
    CHECK(has(&m, "{\"name\":\"maker\",\"mesh\":0,\"extras\""));
    CHECK(has(&m, "{\"name\":\"maker\",\"mesh\":0,\"translation\":[2,0,0]"));
    CHECK(has(&m, "{\"name\":\"maker\",\"mesh\":0,"
                  "\"matrix\":[0,0,-1,0,0,1,0,0,1,0,0,0,0,0,0,1]"));
    CHECK(has(&m, "{\"name\":\"maker\",\"mesh\":1,\"extras\""));
    CHECK_INTEGER(occurrences(m.json, "\"primitives\""), 2);
    CHECK(has(&m, "\"doubleSided\":true"));
    close_model(&m);
}

static void build_many_tiles(studio *s)
{
    build_tiles(s, IO_GLB_NODES_MAX + 1);
}

static void many_entities_are_one_mesh_a_port(void)
{
    const pcg_write_options each = {.size = sizeof each, .entities = true};
    model m = write_model(build_many_tiles, NULL, NULL);
    CHECK(has(&m, "\"nodes\":[{\"name\":\"model\",\"mesh\":0,\"extras\":{\"entities\":2001}},"));
    CHECK_INTEGER(occurrences(m.json, "\"name\":\"maker\""), 0);
    CHECK(has(&m, "\"count\":8004,"));
    close_model(&m);
    m = write_model(build_many_tiles, &each, NULL);
    CHECK_INTEGER(occurrences(m.json, "\"name\":\"maker\",\"mesh\":0,"), 2001);
    close_model(&m);
}

/* ---- large ones ------------------------------------------------------------------------------ */

static void build_large(studio *s)
{
    const pcg_material *looks[2] = {studio_material(s, "a", 1, 0, 0, NULL),
                                    studio_material(s, "b", 0, 1, 0, NULL)};
    for (int i = 0; i < 30000; i++) {
        pcg_shape *box =
            studio_box(s, vec3(i % 200, i / 200 * 2, 0), vec3(0.5, 0.5, 1 + i % 7), looks[i % 2]);
        studio_emit(s, box);
    }
}

/* To a file it is streamed, with room left for the text; to a pipe it is held and fits exactly. */
static void streamed_and_held_are_the_same_model(void)
{
    studio_result r = studio_make(build_large);
    char command[600];
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("m.glb"), NULL, NULL), PCG_STATUS_OK);
    model streamed = open_model("m.glb");
    CHECK_INTEGER(mkfifo(studio_path("pipe"), 0600), 0);
    snprintf(command, sizeof command, "cat '%s/pipe' >'%s/held.glb'", studio_folder, studio_folder);
    FILE *reader = popen(command, "r");
    CHECK(reader != NULL);
    CHECK_INTEGER(pcg_run_write(r.run, studio_path("pipe"), "glb", NULL), PCG_STATUS_OK);
    CHECK_INTEGER(pclose(reader), 0);
    model held = open_model("held.glb");
    CHECK(streamed.json_size > held.json_size);
    CHECK(strncmp(streamed.json, held.json, strlen(held.json) - 3) == 0);
    CHECK(streamed.binary_size == held.binary_size && held.binary_size > 16 << 20 &&
          memcmp(streamed.binary, held.binary, held.binary_size) == 0);
    CHECK_INTEGER(occurrences(held.json, "\"componentType\":5123"), 12);
    close_model(&streamed);
    close_model(&held);
    studio_free(&r);
}

/* Every entity has a label of its own, and a material: more text than is expected. */
static void build_many_looks(studio *s)
{
    const pcg_slot label = {1, PCG_STRING, &s->initial_label, 0};
    char name[1001];
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    for (int i = 0; i < 30000; i++) {
        name[0] = (char)('a' + i % 26);
        pcg_material look = *studio_material(s, name, 0, 1, 0, NULL);
        look.roughness = i / 30000.0;
        pcg_shape *box = studio_box(s, vec3(i % 200, i / 200 * 2, 0), vec3(0.5, 0.5, 1),
                                    pcg_material_intern(s->call->run, &look));
        pcg_set_string(s->call->run, &box->entity, &label, "a");
        studio_emit(s, box);
    }
}

/* Where the room that was left for the text is too small, the binary part moves. */
static void text_that_outgrows_its_room(void)
{
    model m = write_model(build_many_looks, NULL, NULL);
    CHECK(m.json_size > 13000 * 1000 && m.binary_size > 16 << 20);
    CHECK(m.json[strlen(m.json) - 1] == '}' || m.json[strlen(m.json) - 1] == ' ');
    CHECK(has(&m, "\"count\":24,\"type\":\"VEC3\""));
    float first[3];
    memcpy(first, m.binary, sizeof first);
    CHECK(first[0] >= 0 && first[0] <= 0 && first[2] <= 0);
    close_model(&m);
}

/* Many colours, a few of them translucent; one that most has. Lines of many colours, too. */
static void build_colors(studio *s)
{
    for (int i = 0; i < 3000; i++) {
        pcg_material look = *studio_material(s, "c", i / 3000.0, 0.5, 0, NULL);
        look.color.a = i % 100 ? 1 : 0.5;
        const pcg_material *own = pcg_material_intern(s->call->run, &look);
        const pcg_material *walls = studio_material(s, "walls", 1, 1, 0, NULL);
        studio_emit(s, studio_box(s, vec3(i, 0, 0), vec3(0.5, 0.5, 1), own));
        studio_emit(s, studio_box(s, vec3(i, 2, 0), vec3(0.5, 0.5, 1), walls));
        pcg_shape *line = studio_shape(s, NULL, own);
        pcg_mesh_add_vertex(s->call->run, line->mesh, vec3(i, 0, 2));
        pcg_mesh_add_vertex(s->call->run, line->mesh, vec3(i, 1, 2));
        pcg_mesh_add_edge(s->call->run, line->mesh, 0, 1);
        studio_emit(s, line);
    }
}

/* Where the colour of the first vertex that has one stands in the binary part. */
static size_t first_color(const char *json)
{
    const char *accessor = strstr(json, ",\"byteOffset\":24,\"componentType\":5123");
    const char *view = strstr(json, "\"bufferViews\":");
    while (accessor && accessor > json && strncmp(accessor, "\"bufferView\":", 13) != 0)
        accessor--;
    if (!accessor || !view)
        return 0;
    for (long left = strtol(accessor + 13, NULL, 10); left >= 0 && view; left--)
        view = strstr(view + 1, "\"byteOffset\":");
    return view ? strtoul(view + 13, NULL, 10) + 24 : 0;
}

static void many_colors_are_vertex_colors(void)
{
    model m = write_model(build_colors, NULL, NULL);
    uint16_t color[4];
    CHECK_INTEGER(occurrences(m.json, "\"baseColorFactor\""), 3);
    CHECK_INTEGER(occurrences(m.json, "\"baseColorFactor\":[1,1,1,1]"), 2);
    CHECK_INTEGER(occurrences(m.json, "\"alphaMode\":\"BLEND\""), 1);
    CHECK(has(&m, "{\"name\":\"walls\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,0,1]"));
    CHECK(occurrences(m.json, "\"COLOR_0\":") >= 4);
    CHECK(has(&m, "\"byteOffset\":24,\"componentType\":5123,\"normalized\":true,"));
    CHECK(has(&m, "\"byteOffset\":12,\"componentType\":5123,\"normalized\":true,"));
    CHECK(occurrences(m.json, "\"mode\":1}") == 2);
    CHECK(occurrences(m.json, "\"indices\"") < 12);
    memcpy(color, m.binary + first_color(m.json), sizeof color);
    CHECK_INTEGER(color[1], 14027); /* 0.5 in sRGB */
    CHECK(color[2] == 0 && color[3] >= 32767);
    close_model(&m);
}

static void build_round(studio *s)
{
    enum { CORNERS = 70000 };
    pcg_shape *disc = studio_shape(s, NULL, NULL);
    uint32_t *v = malloc(CORNERS * sizeof *v);
    for (uint32_t i = 0; i < CORNERS; i++) {
        double turn = 6.283185307179586 * i / CORNERS;
        v[i] = pcg_mesh_add_vertex(s->call->run, disc->mesh,
                                   vec3(1000 * cos(turn), 1000 * sin(turn), 0));
    }
    pcg_mesh_add_face(s->call->run, disc->mesh, v, CORNERS);
    free(v);
    studio_emit(s, disc);
}

static void face_with_many_corners_has_wide_indices(void)
{
    model m = write_model(build_round, NULL, NULL);
    CHECK(
        has(&m, "\"count\":70000,\"type\":\"VEC3\",\"min\":[-1000,0,-1000],\"max\":[1000,0,1000]"));
    CHECK(has(&m, "\"componentType\":5125,"));
    close_model(&m);
}

/* ---- what does not belong in a file ---------------------------------------------------------- */

static void build_bad(studio *s)
{
    static const double good[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    static const double line[] = {0, 0, 5, 1, 0, 5, 2, 0, 5};
    const double bad[] = {0, 0, 0, NAN, 0, 0, 1, 1, 0};
    const double far_away[] = {0, 0, 0, 1e300, 0, 0, 1, 1, 0};
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    studio_face(s, shape, good, 3);
    studio_face(s, shape, line, 3);
    studio_face(s, shape, bad, 3);
    studio_face(s, shape, far_away, 3);
    studio_emit(s, shape);
    pcg_shape *lost = studio_box(s, vec3(INFINITY, 0, 0), vec3(1, 1, 1), NULL);
    studio_emit(s, lost);
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(0, 0, 0), NULL));
}

static void what_is_not_finite_is_left_out(void)
{
    char messages[1024];
    model m = write_model(build_bad, NULL, messages);
    CHECK(has(&m, "\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,-1],\"max\":[1,0,0]"));
    CHECK_INTEGER(occurrences(m.json, "\"primitives\""), 1);
    CHECK_INTEGER(occurrences(m.json, "{\"name\":\"maker\",\"extras\""), 2);
    CHECK(!strstr(m.json, "nan") && !strstr(m.json, "inf"));
    CHECK_TEXT(messages,
               "8 faces, edges or points were left out: their coordinates are not finite\n");
    close_model(&m);
}

static void build_far(studio *s)
{
    studio_emit(s, studio_box(s, vec3(500000.25, 5000000, 400), vec3(1, 1, 1), NULL));
    studio_emit(s, studio_box(s, vec3(500010.25, 5000000, 400), vec3(1, 2, 1), NULL));
}

/* Half a million metres from the origin floats are 3 cm apart: the roots are moved there
 * instead. */
static void far_away_keeps_its_precision(void)
{
    model m = write_model(build_far, NULL, NULL);
    CHECK(has(&m, "{\"name\":\"model\",\"children\":[1,2],\"translation\":[500005,400,-5000000]"));
    CHECK(has(&m, "\"min\":[-4.75,0,-1],\"max\":[-3.75,1,0]"));
    close_model(&m);
}

static void build_loose(studio *s)
{
    pcg_shape *shape = studio_shape(s, NULL, NULL);
    for (int i = 0; i < 5; i++)
        pcg_mesh_add_vertex(s->call->run, shape->mesh, vec3(i, 0, 0));
    pcg_mesh_add_edge(s->call->run, shape->mesh, 0, 2);
    pcg_mesh_add_edge(s->call->run, shape->mesh, 2, 3);
    studio_emit(s, shape);
}

static void edges_are_lines_and_vertices_points(void)
{
    model m = write_model(build_loose, NULL, NULL);
    CHECK(has(&m, "{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0,\"mode\":1}"));
    CHECK(has(&m, "{\"attributes\":{\"POSITION\":2},\"material\":0,\"mode\":0}"));
    CHECK(has(&m, "\"count\":2,\"type\":\"VEC3\",\"min\":[1,0,0],\"max\":[4,0,0]"));
    close_model(&m);
}

/* ---- streams and textures -------------------------------------------------------------------- */

static char texture_path[512];

static void build_textured(studio *s)
{
    static const double square[] = {0, 0, 0, 2, 0, 0, 2, 0, 2, 0, 0, 2};
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0, 1};
    const char *texture = pcg_string(s->call->run, texture_path);
    const pcg_material *look = studio_material(s, "bricks", 1, 1, 1, texture);
    pcg_shape *with = studio_shape(s, NULL, look), *without = studio_shape(s, NULL, look);
    studio_face(s, with, square, 4);
    studio_face(s, without, square, 4);
    pcg_mesh_need_uvs(s->call->run, with->mesh);
    memcpy(with->mesh->corner_uv, uv, sizeof uv);
    studio_emit(s, with);
    studio_emit(s, without);
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(1, 1, 1), look));
}

/* Once in the file, whatever refers to it; only faces with uv show it. glTF counts v from the
 * top. */
static void textures_are_embedded_once(void)
{
    snprintf(texture_path, sizeof texture_path, "%s", studio_brick());
    model m = write_model(build_textured, NULL, NULL);
    CHECK(has(
        &m, "\"images\":[{\"name\":\"brick.jpg\",\"mimeType\":\"image/jpeg\",\"bufferView\":0}]"));
    CHECK(has(&m, "\"textures\":[{\"sampler\":0,\"source\":0}]"));
    CHECK_INTEGER(occurrences(m.json, "\"baseColorTexture\":{\"index\":0}"), 1);
    CHECK_INTEGER(occurrences(m.json, "\"TEXCOORD_0\""), 1);
    const unsigned char *at = m.binary;
    CHECK(at[0] == 0xff && at[1] == 0xd8);
    float v;
    const char *view = strstr(m.json, "\"byteStride\":32");
    while (view && view > m.json && strncmp(view, "\"byteOffset\":", 13) != 0)
        view--;
    memcpy(&v, m.binary + (view ? atoi(view + 13) : 0) + 28, sizeof v);
    CHECK(v > 0.999f && v < 1.001f);
    close_model(&m);
}

static void textures_that_cannot_be_used_leave_a_plain_colour(void)
{
    char messages[1024];
    snprintf(texture_path, sizeof texture_path, "%s", studio_path("none.jpg"));
    model m = write_model(build_textured, NULL, messages);
    CHECK_TEXT(messages, "the texture 'none.jpg' cannot be read (No such file or directory): its "
                         "surfaces stay plain\n");
    CHECK(!strstr(m.json, "images") && !strstr(m.json, "baseColorTexture"));
    close_model(&m);
    studio_write("cut.jpg", "\xff\xd8\xff\xe0\0\4ab", 8);
    snprintf(texture_path, sizeof texture_path, "%s", studio_path("cut.jpg"));
    m = write_model(build_textured, NULL, messages);
    CHECK_TEXT(messages, "the texture 'cut.jpg' is damaged: its surfaces stay plain\n");
    CHECK(!strstr(m.json, "images"));
    close_model(&m);
}

static void build_wrong_text(studio *s)
{
    const pcg_slot label = {1, PCG_STRING, &s->initial_label, 0};
    pcg_shape *box = studio_box(s, vec3(0, 0, 0), vec3(1, 1, 1), NULL);
    pcg_set_string(s->call->run, &box->entity, &label, "k\xc3\xa4se \xff\xc0\xaf \"x\"\n");
    studio_emit(s, box);
}

static void text_is_utf8(void)
{
    model m = write_model(build_wrong_text, NULL, NULL);
    CHECK(has(&m, "\"label\":\"k\xc3\xa4se ??? \\\"x\\\"\\n\""));
    close_model(&m);
}

int main(void)
{
    studio_open_folder();
    box_as_it_stands_in_the_file();
    normals_look_outward();
    empty_result_is_a_model();
    equal_shapes_share_a_mesh();
    many_entities_are_one_mesh_a_port();
    streamed_and_held_are_the_same_model();
    text_that_outgrows_its_room();
    many_colors_are_vertex_colors();
    face_with_many_corners_has_wide_indices();
    what_is_not_finite_is_left_out();
    far_away_keeps_its_precision();
    edges_are_lines_and_vertices_points();
    textures_are_embedded_once();
    textures_that_cannot_be_used_leave_a_plain_colour();
    text_is_utf8();
    studio_close_folder();
    return unit_done();
}

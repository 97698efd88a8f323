/* io_picture.c - pictures: what is where, equal bytes for equal scenes, scenes and sizes without
 * sense. */
#include <math.h>

#include "stdlib/io/io.h"
#include "tests/unit/io_studio.h"

enum { WIDTH = 320, HEIGHT = 240 };

static const pcg_write_options small = {.size = sizeof small, .width = WIDTH, .height = HEIGHT};

/* A picture, decoded again. */
typedef struct shot {
    io_job job;
    io_image image;
} shot;

/* False where the build has no PNG. */
static int take(shot *t, void (*build)(studio *s), const pcg_write_options *options)
{
    size_t size = 0;
    studio_result r = studio_make(build);
    pcg_status status = pcg_run_write(r.run, studio_path("p.png"), NULL, options);
    int left_out =
        status != PCG_STATUS_OK &&
        strstr(pcg_run_error(r.run), "PNG was left out when this program was built") != NULL;
    memset(t, 0, sizeof *t);
    if (!left_out)
        CHECK_INTEGER(status, PCG_STATUS_OK);
    char *file = left_out ? NULL : studio_read("p.png", &size);
    t->job.memory.on_failure = &t->job.out_of_memory;
    if (file)
        CHECK(image_decode(&t->job, (unsigned char *)file, size, 0, &t->image) == NULL);
    free(file);
    studio_free(&r);
    return t->image.pixels != NULL;
}

static void drop(shot *t)
{
    image_libraries_close(&t->job);
    arena_free(&t->job.memory);
}

static const unsigned char *pixel(const shot *t, double x, double y)
{
    uint32_t column = (uint32_t)(x * t->image.width), row = (uint32_t)(y * t->image.height);
    return t->image.pixels + 4 * ((size_t)row * t->image.width + column);
}

static int brightness(const unsigned char *p)
{
    return p[0] + p[1] + p[2];
}

/* ---- what is where --------------------------------------------------------------------------- */

static void build_box(studio *s)
{
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(2, 2, 2),
                              studio_material(s, "red", 1, 0.1, 0.1, NULL)));
}

/* The box is red and fills the picture, the backdrop is bright, and the ground to the right lies
 * in shadow. */
static void a_box_on_the_ground(void)
{
    shot t;
    if (take(&t, build_box, &small)) {
        const unsigned char *middle = pixel(&t, 0.5, 0.5), *corner = pixel(&t, 0.02, 0.02);
        CHECK(t.image.width == WIDTH && t.image.height == HEIGHT);
        CHECK(middle[0] > 100 && middle[1] < middle[0] / 2 && middle[2] < middle[0] / 2);
        CHECK(brightness(corner) > 550);
        CHECK(brightness(pixel(&t, 0.78, 0.72)) + 90 < brightness(pixel(&t, 0.15, 0.9)));
        int red = 0, rows = 0;
        for (int y = 0; y < HEIGHT; y++) {
            const unsigned char *p = pixel(&t, 0.5, (y + 0.5) / HEIGHT);
            red += p[0] > 2 * p[1];
        }
        rows = HEIGHT;
        CHECK(red > rows * 7 / 10 && red < rows * 95 / 100);
    }
    drop(&t);
}

static void build_pair(studio *s)
{
    const pcg_material *front = studio_material(s, "front", 0.1, 0.9, 0.1, NULL);
    const pcg_material *side = studio_material(s, "side", 0.1, 0.1, 0.9, NULL);
    static const double facing[] = {0, 0, 0, 4, 0, 0, 4, 0, 3, 0, 0, 3};
    static const double aside[] = {4, 0, 0, 4, 4, 0, 4, 4, 3, 4, 0, 3};
    pcg_shape *a = studio_shape(s, NULL, front), *b = studio_shape(s, NULL, side);
    studio_face(s, a, facing, 4);
    studio_face(s, b, aside, 4);
    studio_emit(s, a);
    studio_emit(s, b);
}

/* The side towards -y is on the left of the picture and in the sun, the one towards +x on the
 * right and not. */
static void seen_from_the_front(void)
{
    shot t;
    if (take(&t, build_pair, &small)) {
        const unsigned char *left = pixel(&t, 0.35, 0.55), *right = pixel(&t, 0.78, 0.5);
        CHECK(left[1] > 2 * left[0] && left[1] > 2 * left[2]);
        CHECK(right[2] > right[0] + 30 && right[2] > right[1] + 30);
        CHECK(left[1] > right[2] + 30);
    }
    drop(&t);
}

static char texture_path[512];

static void build_textured(studio *s)
{
    static const double facing[] = {0, 0, 0, 4, 0, 0, 4, 0, 4, 0, 0, 4};
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0, 1};
    pcg_shape *a = studio_shape(
        s, NULL, studio_material(s, "t", 1, 1, 1, pcg_string(s->call->run, texture_path)));
    studio_face(s, a, facing, 4);
    pcg_mesh_need_uvs(s->call->run, a->mesh);
    memcpy(a->mesh->corner_uv, uv, sizeof uv);
    studio_emit(s, a);
}

/* Red above, green below in the file is so on a wall whose v points up. */
static void textures_stand_upright(void)
{
    studio_result r = studio_make(NULL);
    io_job j = {.memory.on_failure = &j.out_of_memory, .run = r.run};
    unsigned char pixels[16 * 16 * 3] = {0}, *png;
    size_t size;
    shot t;
    for (int i = 0; i < 16 * 16; i++)
        pixels[3 * i + (i < 128 ? 0 : 1)] = 255;
    if (!image_encode_png(&j, pixels, 16, 16, &png, &size)) {
        studio_write("t.png", png, size);
        snprintf(texture_path, sizeof texture_path, "%s", studio_path("t.png"));
        CHECK(take(&t, build_textured, &small));
        const unsigned char *above = pixel(&t, 0.5, 0.3), *below = pixel(&t, 0.5, 0.7);
        CHECK(above[0] > 150 && above[1] < 60);
        CHECK(below[1] > 150 && below[0] < 60);
        drop(&t);
    }
    image_libraries_close(&j);
    arena_free(&j.memory);
    studio_free(&r);
}

/* A texture that cannot be used leaves the colour, and a warning. */
static void broken_textures_are_plain(void)
{
    char messages[600];
    studio_write("t.png", "\x89PNG\r\n\x1a\nnothing more", 20);
    snprintf(texture_path, sizeof texture_path, "%s", studio_path("t.png"));
    studio_result r = studio_make(build_textured);
    pcg_status status = pcg_run_write(r.run, studio_path("p.png"), NULL, &small);
    studio_messages(&r, messages, sizeof messages);
    CHECK(status == PCG_STATUS_FAILED || /* without PNG */
          strstr(messages, "the texture 't.png' cannot be used: ") != NULL);
    studio_free(&r);
}

/* ---- the same bytes -------------------------------------------------------------------------- */

static void build_mixed(studio *s)
{
    pcg_material glass = *studio_material(s, "glass", 0.3, 0.5, 0.6, NULL);
    glass.color.a = 0.4;
    glass.roughness = 0.05;
    pcg_shape *loose = studio_shape(s, NULL, NULL);
    for (int i = 0; i < 4; i++)
        pcg_mesh_add_vertex(s->call->run, loose->mesh, vec3(i, -1, 3));
    pcg_mesh_add_edge(s->call->run, loose->mesh, 0, 1);
    studio_emit(s, loose);
    for (int i = 0; i < 30; i++)
        studio_emit(s, studio_box(s, vec3(i % 6, i / 6, 0), vec3(0.7, 0.7, 1 + i % 4), NULL));
    studio_emit(s, studio_box(s, vec3(1, -2, 0), vec3(3, 0.1, 2),
                              pcg_material_intern(s->call->run, &glass)));
}

static void equal_scenes_are_equal_bytes(void)
{
    char *file[2] = {NULL, NULL};
    size_t size[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        studio_result r = studio_make(build_mixed);
        pcg_run_write(r.run, studio_path("e.png"), NULL, &small);
        file[i] = studio_read("e.png", &size[i]);
        studio_free(&r);
    }
    CHECK(size[0] == size[1] && (size[0] == 0 || memcmp(file[0], file[1], size[0]) == 0));
    free(file[0]);
    free(file[1]);
}

/* Writes the scene and hands its bytes over. */
static char *write_scene(void (*build)(studio *s), const pcg_write_options *options, size_t *size)
{
    studio_result r = studio_make(build);
    *size = 0;
    pcg_run_write(r.run, studio_path("e.png"), NULL, options);
    char *file = studio_read("e.png", size);
    studio_free(&r);
    return file;
}

/* Several chunks over several tiles. */
static void build_many(studio *s)
{
    build_mixed(s);
    for (int i = 0; i < 400; i++)
        studio_emit(s, studio_box(s, vec3(i % 20, i / 20, -1), vec3(0.5, 0.6, 0.3 + i % 7), NULL));
}

static void threads_do_not_show(void)
{
    size_t size[3];
    char *file[3];
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t threads[] = {1, 2, 13};
        pcg_write_options o = small;
        o.threads = threads[i];
        file[i] = write_scene(build_many, &o, &size[i]);
    }
    for (int i = 1; i < 3; i++)
        CHECK(size[i] == size[0] && (!size[0] || memcmp(file[i], file[0], size[0]) == 0));
    for (int i = 0; i < 3; i++)
        free(file[i]);
}

static void build_flat(studio *s);

/* ---- views ----------------------------------------------------------------------------------- */

/* Ground of kilometres; on it, by hands' breadths, a strip and a cross street; a hut. */
static void build_layers(studio *s)
{
    static const double ground[] = {0, 0, 0, 12000, 0, 0, 12000, 12000, 0, 0, 12000, 0};
    static const double strip[] = {4000, 0, .02, 8000, 0, .02, 8000, 12000, .02, 4000, 12000, .02};
    static const double cross[] = {0, 5000, .04, 12000, 5000, .04, 12000, 7000, .04,
                                   0, 7000, .04};
    static const double *const layers[] = {ground, strip, cross};
    const pcg_material *const looks[] = {studio_material(s, "green", 0.1, 0.8, 0.1, NULL),
                                         studio_material(s, "blue", 0.1, 0.1, 0.9, NULL),
                                         studio_material(s, "red", 0.9, 0.1, 0.1, NULL)};
    for (int i = 0; i < 3; i++) {
        pcg_shape *a = studio_shape(s, NULL, looks[i]);
        studio_face(s, a, layers[i], 4);
        studio_emit(s, a);
    }
    studio_emit(s, studio_box(s, vec3(100, 100, 0), vec3(8, 8, 6),
                              studio_material(s, "white", 1, 1, 1, NULL)));
}

/* Which of red, green and blue leads; -1: none. */
static int leading(const unsigned char *p)
{
    for (int i = 0; i < 3; i++)
        if (p[i] > p[(i + 1) % 3] + 30 && p[i] > p[(i + 2) % 3] + 30)
            return i;
    return -1;
}

/* Every pixel of an area shows one colour: what lies above. */
static bool all_lead(const shot *t, int color, double left, double top, double right, double bottom)
{
    for (double y = top; y < bottom; y += 0.01)
        for (double x = left; x < right; x += 0.01)
            if (leading(pixel(t, x, y)) != color)
                return false;
    return true;
}

static void layers_stay_apart(void)
{
    static const char *const views[] = {NULL, "bird", "top"};
    for (int i = 0; i < 3; i++) {
        shot t;
        pcg_write_options o = small;
        o.view = views[i];
        if (take(&t, build_layers, &o)) {
            CHECK(all_lead(&t, 0, 0.3, 0.46, 0.7, 0.5));
            CHECK(all_lead(&t, 2, 0.48, 0.7, 0.52, 0.8));
            CHECK(all_lead(&t, 1, 0.28, 0.7, 0.31, 0.8));
        }
        drop(&t);
    }
}

/* North is up, and east is right; seen from above nothing is nearer. */
static void the_top_is_a_map(void)
{
    shot t;
    pcg_write_options o = small;
    o.view = "top";
    if (take(&t, build_layers, &o)) {
        CHECK(leading(pixel(&t, 0.5, 0.1)) == 2 && leading(pixel(&t, 0.5, 0.9)) == 2);
        CHECK(leading(pixel(&t, 0.2, 0.5)) == 0 && leading(pixel(&t, 0.8, 0.5)) == 0);
        CHECK(leading(pixel(&t, 0.2, 0.2)) == 1 && leading(pixel(&t, 0.8, 0.8)) == 1);
        CHECK(leading(pixel(&t, 0.05, 0.5)) == -1);
    }
    drop(&t);
}

/* The hut in the middle of the picture, from far and from near, over ground that reaches behind
 * the camera. */
static void a_part_is_looked_at(void)
{
    pcg_write_options o = small;
    o.look_at = "104,104,3,20";
    for (int i = 0; i < 2; i++) {
        shot t;
        o.from = i ? "104,80,9" : NULL;
        if (take(&t, build_layers, &o)) {
            CHECK(leading(pixel(&t, 0.5, 0.5)) == -1 && brightness(pixel(&t, 0.5, 0.5)) > 300);
            CHECK(leading(pixel(&t, 0.1, 0.95)) == 1 && leading(pixel(&t, 0.9, 0.95)) == 1);
        }
        drop(&t);
    }
}

static void views_without_sense(void)
{
    static const pcg_write_options wrong[] = {
        {.size = sizeof small, .view = "above"},       {.size = sizeof small, .look_at = "1,2"},
        {.size = sizeof small, .look_at = "1,2,nan"},  {.size = sizeof small, .look_at = "1,2,3,0"},
        {.size = sizeof small, .look_at = "1,2,3,4,"}, {.size = sizeof small, .from = "1,2,3,4"},
        {.size = sizeof small, .from = "1,2,1e99"},
        {.size = sizeof small, .from = "1,2,3", .view = "top"},
    };
    studio_result r = studio_make(build_flat);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        CHECK_INTEGER(pcg_run_write(r.run, studio_path("v.png"), NULL, &wrong[i]),
                      PCG_STATUS_MISUSE);
    CHECK(strstr(pcg_run_error(r.run), "a place to look from takes no view, not 'top'") != NULL);
    studio_free(&r);
}

/* From inside of a box, from where it is looked at, from a place that is far beyond all. */
static void any_place_to_stand(void)
{
    static const char *const places[][2] = {{"0.3,0.3,0.3", "9,9,9"}, {"1,1,1", "1,1,1"},
                                            {"0,0,1e9", "0,0,0"},     {"0,0,-5", "0,0,0,1e-9"},
                                            {"1e30,0,0", "0,1e30,0"}, {"0,0,0", "0,0,-1e-30"}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        shot t;
        pcg_write_options o = small;
        o.from = places[i][0];
        o.look_at = places[i][1];
        if (take(&t, build_mixed, &o))
            CHECK(t.image.width == WIDTH);
        drop(&t);
    }
}

/* ---- without sense --------------------------------------------------------------------------- */

static void build_nothing(studio *s)
{
    (void)s;
}

static void build_point(studio *s)
{
    pcg_shape *p = studio_shape(s, NULL, NULL);
    pcg_mesh_add_vertex(s->call->run, p->mesh, vec3(5, 5, 5));
    studio_emit(s, p);
}

static void build_flat(studio *s)
{
    studio_emit(s, studio_shape(s, &pcg_mesh_square, NULL));
}

static void build_line(studio *s)
{
    pcg_shape *p = studio_shape(s, NULL, NULL);
    pcg_mesh_add_vertex(s->call->run, p->mesh, vec3(0, 0, 0));
    pcg_mesh_add_vertex(s->call->run, p->mesh, vec3(0, 0, 9));
    pcg_mesh_add_edge(s->call->run, p->mesh, 0, 1);
    studio_emit(s, p);
}

static void build_without_size(studio *s)
{
    studio_emit(s, studio_box(s, vec3(3, 3, 3), vec3(0, 0, 0), NULL));
}

static void build_not_finite(studio *s)
{
    studio_emit(s, studio_box(s, vec3(NAN, 0, 0), vec3(1, 1, 1), NULL));
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(INFINITY, 1, 1), NULL));
}

static void build_huge(studio *s)
{
    studio_emit(s, studio_box(s, vec3(-1e30, -1e30, 0), vec3(2e30, 2e30, 1e30), NULL));
    studio_emit(s, studio_box(s, vec3(0, 0, 0), vec3(1e-30, 1e-30, 1e-30), NULL));
}

static void build_needles(studio *s)
{
    for (int i = 0; i < 50; i++) {
        const double needle[] = {i, 0, 0, i + 1e-6, 0, 1000, i, 1e-6, 1000, i - 1e-7, 0, 500};
        pcg_shape *p = studio_shape(s, NULL, NULL);
        studio_face(s, p, needle, 4);
        studio_emit(s, p);
    }
}

static void any_scene_is_a_picture(void)
{
    static void (*const builds[])(studio * s) = {
        build_nothing,      build_point,      build_flat, build_line,
        build_without_size, build_not_finite, build_huge, build_needles};
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        shot t;
        if (take(&t, builds[i], &small))
            CHECK(brightness(pixel(&t, 0.02, 0.02)) > 400);
        drop(&t);
    }
}

static void sizes_have_limits(void)
{
    const pcg_write_options options[] = {
        {.size = sizeof options[0], .width = 9000, .height = 10},
        {.size = sizeof options[0], .width = 8192, .height = 8192},
        {.size = sizeof options[0], .width = UINT32_MAX},
        {.size = sizeof options[0], .height = UINT32_MAX},
    };
    studio_result r = studio_make(build_flat);
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++)
        CHECK_INTEGER(pcg_run_write(r.run, studio_path("s.png"), NULL, &options[i]),
                      PCG_STATUS_MISUSE);
    CHECK(strstr(pcg_run_error(r.run), "8192 pixels a side and 16777216 in all") != NULL);
    studio_free(&r);
}

static void odd_sizes(void)
{
    static const uint32_t sizes[][2] = {{1, 1}, {1, 90}, {200, 3}, {37, 53}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const pcg_write_options o = {.size = sizeof o, .width = sizes[i][0], .height = sizes[i][1]};
        shot t;
        if (take(&t, build_mixed, &o))
            CHECK(t.image.width == sizes[i][0] && t.image.height == sizes[i][1]);
        drop(&t);
    }
}

int main(void)
{
    studio_open_folder();
    a_box_on_the_ground();
    seen_from_the_front();
    textures_stand_upright();
    broken_textures_are_plain();
    equal_scenes_are_equal_bytes();
    threads_do_not_show();
    layers_stay_apart();
    the_top_is_a_map();
    a_part_is_looked_at();
    views_without_sense();
    any_place_to_stand();
    any_scene_is_a_picture();
    sizes_have_limits();
    odd_sizes();
    studio_close_folder();
    return unit_done();
}

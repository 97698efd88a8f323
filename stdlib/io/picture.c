/* picture.c - a PNG of everything that came out: scene, camera, tiles, light, colours, file. */
#include "stdlib/io/picture.h"

#include <float.h>
#include <string.h>

enum { EDGE_REACH = 3, STEPS = 1 << 14 };

#define EDGE_DARK 0.50f      /* how much darker a full outline is */
#define SHOULDER 0.72f       /* above it, light is compressed */

typedef struct picture {
    io_job *job;
    picture_scene scene;
    picture_camera camera;
    picture_span *spans;         /* of each chunk */
    picture_lights lights;
    picture_tile *tiles;         /* of each thread */
    unsigned char *edges;        /* of each pixel, in ninths */
    unsigned char *pixels;       /* 3 each */
    float *levels;               /* sRGB by the square root of light: there the curve is even */
} picture;

/* ---- tiles ----------------------------------------------------------------------------------- */

static picture_tile new_tile(arena *a)
{
    enum { SIDE = PICTURE_TILE + 2 * PICTURE_RIM, PIXELS = PICTURE_TILE * PICTURE_TILE };
    size_t samples = (size_t)SIDE * SIDE * PICTURE_SAMPLES;
    size_t grid = (size_t)PICTURE_LIGHT_GRID * PICTURE_LIGHT_GRID;
    size_t fragments = (size_t)PIXELS * PICTURE_SAMPLES;
    picture_tile t = {.low = {FLT_MAX, FLT_MAX, FLT_MAX}, .high = {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    t.samples.nearness = ARENA_ARRAY(a, float, samples);
    t.samples.triangle = ARENA_ARRAY(a, uint32_t, samples);
    t.points = ARENA_ARRAY(a, picture_point, PICTURE_CHUNK_VERTICES);
    t.fragments = ARENA_ARRAY(a, picture_fragment, fragments);
    t.grid = ARENA_ARRAY(a, picture_fragment, grid);
    t.color = ARENA_ARRAY(a, vec, PIXELS);
    return t;
}

static uint32_t tile_count(const picture_camera *c)
{
    return (c->width + PICTURE_TILE - 1) / PICTURE_TILE *
           ((c->height + PICTURE_TILE - 1) / PICTURE_TILE);
}

/* The first time: what can be seen, and where outlines are. */
static void look_at_tile(void *context, uint32_t thread, uint32_t item)
{
    picture *p = context;
    picture_tile *t = &p->tiles[thread];
    picture_draw_tile(&p->scene, &p->camera, p->spans, item, t);
    picture_find_edges(&p->scene, &p->camera, t, p->edges);
    picture_see(&p->scene, &p->camera, t);
}

/* ---- colours --------------------------------------------------------------------------------- */

/* Where edges crowd, they would turn everything dark: there they are thinned out. */
static float edge_weight(const picture *p, uint32_t x, uint32_t y)
{
    uint32_t width = p->camera.width, height = p->camera.height, sum = 0;
    uint32_t left = x > EDGE_REACH ? x - EDGE_REACH : 0, top = y > EDGE_REACH ? y - EDGE_REACH : 0;
    uint32_t right = x + EDGE_REACH < width ? x + EDGE_REACH : width - 1;
    uint32_t bottom = y + EDGE_REACH < height ? y + EDGE_REACH : height - 1;
    for (uint32_t row = top; row <= bottom; row++)
        for (uint32_t column = left; column <= right; column++)
            sum += p->edges[(size_t)width * row + column];
    float count = (float)((right - left + 1) * (bottom - top + 1) * PICTURE_SAMPLES);
    return clamp(1.25f - 4 * (float)sum / count, 0.1f, 1);
}

static float compress(float x)
{
    if (x <= SHOULDER)
        return x > 0 ? x : 0;
    float over = (x - SHOULDER) / (1 - SHOULDER);
    return SHOULDER + (1 - SHOULDER) * over / (1 + over);
}

/* The ground is the backdrop, as much darker as less light gets there. */
static vec ground_color(const picture *p, const picture_fragment *f)
{
    const picture_day *day = &p->scene.day;
    vec light = vec_add(picture_sky_light(f->open, f->above), vec_scale(day->sun_color, f->sun));
    vec open = day->open;
    vec back = picture_backdrop(&p->camera, f->at_x, f->at_y);
    return vec_of(back.x * clamp(light.x / open.x, 0, 1), back.y * clamp(light.y / open.y, 0, 1),
                  back.z * clamp(light.z / open.z, 0, 1));
}

static vec surface_color(const picture *p, const picture_fragment *f)
{
    const picture_camera *c = &p->camera;
    unsigned char edge = p->edges[(size_t)c->width * f->y + f->x];
    vec color = picture_shade(&p->scene, c, f);
    color = vec_of(compress(color.x), compress(color.y), compress(color.z));
    if (edge) {
        float line = clamp((float)edge / 3, 0, 1) * edge_weight(p, f->x, f->y);
        color = vec_scale(color, 1 - EDGE_DARK * line);
    }
    vec air = picture_backdrop(c, f->at_x, f->at_y);
    return vec_mix(color, air, picture_haze(c, picture_depth(c, f->place)));
}

/* A regular pattern that hides the steps of even gradients. */
static float dither(uint32_t x, uint32_t y)
{
    static const unsigned char order[16] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return ((float)order[y % 4 * 4 + x % 4] + 0.5f) / 16 - 0.5f;
}

static void encode(const picture *p, uint32_t x, uint32_t y, vec light)
{
    const float color[3] = {light.x, light.y, light.z};
    unsigned char *out = p->pixels + 3 * ((size_t)p->camera.width * y + x);
    for (int k = 0; k < 3; k++) {
        float value = p->levels[(int)(sqrtf(clamp(color[k], 0, 1)) * STEPS + 0.5f)];
        out[k] = (unsigned char)clamp(value + 0.5f + 0.7f * dither(x, y), 0, 255);
    }
}

/* The fragments of a pixel follow each other; what they leave of it is backdrop. */
static void color_tile(picture *p, const picture_tile *t)
{
    uint32_t next = 0;
    for (uint32_t y = t->top; y < t->bottom; y++)
        for (uint32_t x = t->left; x < t->right; x++) {
            vec color = vec_of(0, 0, 0);
            float rest = 1;
            for (; next < t->fragment_count; next++) {
                const picture_fragment *f = &t->fragments[next];
                if (f->x != x || f->y != y)
                    break;
                vec own = f->triangle == PICTURE_NOTHING ? ground_color(p, f)
                                                         : surface_color(p, f);
                color = vec_add(color, vec_scale(own, f->share));
                rest -= f->share;
            }
            if (rest > 1e-3f) {
                vec back = picture_backdrop(&p->camera, (float)x + 0.5f, (float)y + 0.5f);
                color = vec_add(color, vec_scale(back, rest));
            }
            encode(p, x, y, color);
        }
}

/* The second time: what it looks like. */
static void paint_tile(void *context, uint32_t thread, uint32_t item)
{
    picture *p = context;
    picture_tile *t = &p->tiles[thread];
    picture_draw_tile(&p->scene, &p->camera, p->spans, item, t);
    picture_find_fragments(&p->scene, &p->camera, t);
    picture_light_tile(&p->scene, &p->camera, &p->lights, t);
    color_tile(p, t);
}

/* ---- the file -------------------------------------------------------------------------------- */

static void write_file(picture *p, io_output *out)
{
    unsigned char *file;
    size_t size;
    const char *wrong = image_encode_png(p->job, p->pixels, p->camera.width, p->camera.height,
                                         &file, &size);
    if (wrong)
        io_fail(p->job, PCG_STATUS_FAILED, "no picture '%s': %s", out->path, wrong);
    else
        output_bytes(out, file, size);
}

/* What would make all the work useless is found first. */
static bool check_png(io_job *j, const char *path)
{
    const char *missing = image_png_missing(j);
    if (missing)
        io_fail(j, PCG_STATUS_FAILED, "no picture '%s': %s", path, missing);
    return !missing;
}

static bool check_size(io_job *j, const char *path)
{
    uint32_t width = j->options.width, height = j->options.height;
    if (width && height && width <= IO_PICTURE_SIDE_MAX && height <= IO_PICTURE_SIDE_MAX &&
        (uint64_t)width * height <= IO_PICTURE_PIXELS_MAX)
        return true;
    io_fail(j, PCG_STATUS_MISUSE,
            "a picture of %u by %u for '%s': up to %d pixels a side and %d in all can be had",
            width, height, path, IO_PICTURE_SIDE_MAX, IO_PICTURE_PIXELS_MAX);
    return false;
}

/* Of all threads together; all of the scene where nothing can be seen. */
static void find_seen(const picture *p, vec *low, vec *high)
{
    *low = p->tiles[0].low;
    *high = p->tiles[0].high;
    for (uint32_t i = 1; i < io_threads(p->job); i++) {
        *low = vec_least(*low, p->tiles[i].low);
        *high = vec_most(*high, p->tiles[i].high);
    }
    if (low->x > high->x) {
        *low = p->scene.low;
        *high = p->scene.high;
    }
}

static void prepare(picture *p, uint32_t width, uint32_t height)
{
    arena *a = &p->job->memory;
    uint32_t threads = io_threads(p->job);
    p->edges = arena_alloc_array(a, width, height);
    p->pixels = arena_alloc_array(a, 3 * (size_t)width, height);
    p->spans = ARENA_ARRAY(a, picture_span, p->scene.chunks.count + 1);
    for (uint32_t i = 0; i < p->scene.chunks.count; i++)
        p->spans[i] = picture_chunk_span(&p->camera.projection, &p->scene.chunks.at[i]);
    p->tiles = ARENA_ARRAY(a, picture_tile, threads);
    for (uint32_t i = 0; i < threads; i++)
        p->tiles[i] = new_tile(a);
    p->levels = ARENA_ARRAY(a, float, STEPS + 1);
    for (int i = 0; i <= STEPS; i++)
        p->levels[i] = (float)(255 * color_srgb((double)i / STEPS * ((double)i / STEPS)));
}

static void paint(picture *p)
{
    uint32_t width = p->camera.width, height = p->camera.height;
    vec low, high;
    io_parallel(p->job, tile_count(&p->camera), look_at_tile, p);
    if (io_stopped(p->job))
        return;
    find_seen(p, &low, &high);
    picture_draw_lights(&p->scene, low, high, width > height ? width : height, &p->lights);
    if (!io_stopped(p->job))
        io_parallel(p->job, tile_count(&p->camera), paint_tile, p);
}

/* What was taken off world coordinates: the middle of what is far away, or what is looked at. */
static pcg_vec3 find_center(const io_job *j, const picture_aim *aim)
{
    io_extent extent = {.any = false};
    for (uint32_t o = 0; o < j->module->output_count; o++) {
        const pcg_entities *list = result_entities(j->run, o);
        for (uint32_t i = 0; i < list->count; i++) {
            const pcg_shape *s = io_shape(list->at[i]);
            if (s)
                io_extent_add(&extent, s);
        }
    }
    return aim->aimed ? aim->target : io_extent_center(&extent);
}

void io_write_picture(io_job *j, const char *path)
{
    picture p = {.job = j};
    picture_aim aim;
    if (!check_size(j, path) || !picture_read_aim(j, path, &aim) || !check_png(j, path))
        return;
    io_output *out = output_open(j, path);
    picture_gather(&p.scene, j, find_center(j, &aim));
    if (io_stopped(j))
        return;
    picture_frame(&p.camera, &p.scene, &aim, j->options.width, j->options.height);
    picture_ribbons(&p.scene, &p.camera);
    prepare(&p, j->options.width, j->options.height);
    paint(&p);
    if (!io_stopped(j))
        write_file(&p, out);
}

/* picture_light.c - how much light of the sky and of the sun reaches each fragment.
 *
 * Light comes from a number of directions: many that cover the sky, some that cover a sun of a
 * few degrees. Each has a depth map, drawn along it, of what lies between what can be seen and
 * the light; a fragment is lit from there where the map shows nothing in front of it. What is
 * summed over the sky darkens corners and the ground around what stands on it; what is summed
 * over the sun has shadows that are sharp where they begin and soften with distance. Maps cover
 * what the picture shows and no more: so their texels keep their size in pixels, from a window to
 * a town.
 *
 * The light of the sky is found exactly on a grid of pixels. Where the four around a fragment lie
 * on its plane and agree, it is taken from them.
 */
#include "stdlib/io/picture.h"

#include <float.h>
#include <string.h>

#include "runtime/real.h"

enum {
    SKY_MAP_MOST = 1024, SUN_MAP_MOST = 3072, MAP_LEAST = 128, /* texels a side */
    SKY_MOST = 112, SKY_LEAST = 24,       /* directions: fewer where drawing the scene takes long */
    SUN_MOST = 16, SUN_LEAST = 8,
    BUDGET = 40 * 1000 * 1000,            /* triangles to draw, in all maps */
    MAP_RIM = 4,                          /* texels around a map that stay empty */
    MAP_FULL = UINT16_MAX
};

/* Texels of a map for each pixel of the longer side of the picture: the sun's shadows have
 * edges. */
#define SKY_TEXELS 0.5f
#define SUN_TEXELS 1.2f

#define GOLDEN_TURN 137.50776405003785 /* degrees */
#define SUN_ANGLE 1.6 /* degrees, from middle to rim: larger than life, for soft shadows */
#define SUN_TURN -38.0 /* degrees from the front: to the left, as the camera is on the right */
#define SUN_HEIGHT 43.0

/* Where the sky's light on the grid agrees so well, it is taken from there. */
#define AGREES 0.05f
#define SAME_NORMAL 0.998f
#define SAME_PLANE_PIXELS 1.5f

/* ---- directions ------------------------------------------------------------------------------ */

/* The sky is brighter and whiter towards the horizon, blue above: a mixture by `above`. */
static const vec sky_horizon = {0.50f, 0.53f, 0.57f}, sky_zenith = {0.27f, 0.34f, 0.44f};

vec picture_sky(vec direction)
{
    static const vec ground = {0.46f, 0.45f, 0.43f};
    float z = direction.z;
    if (z < 0)
        return vec_mix(sky_horizon, ground, clamp(-z * 6, 0, 1));
    return vec_mix(sky_horizon, sky_zenith, sqrtf(z));
}

vec picture_sky_light(float open, float above)
{
    return vec_add(vec_scale(sky_horizon, open),
                   vec_scale(vec_subtract(sky_zenith, sky_horizon), above));
}

/* An orthonormal frame around a direction. */
static void set_frame(vec direction, vec *right, vec *up)
{
    vec helper = fabsf(direction.z) > 0.99f ? vec_of(1, 0, 0) : vec_of(0, 0, 1);
    *right = vec_unit(vec_cross(helper, direction));
    *up = vec_cross(direction, *right);
}

/* Even over the half of the sphere that is sky; the same ones for every picture. */
static vec sky_direction(uint32_t i, uint32_t count)
{
    double z = ((double)i + 0.5) / (double)count, turn = GOLDEN_TURN * (double)i;
    double flat = sqrt(1 - z * z);
    return vec_of((float)(flat * real_cos(turn)), (float)(flat * real_sin(turn)), (float)z);
}

static vec sun_direction(vec middle, uint32_t i, uint32_t count)
{
    vec right, up;
    double reach = real_tan(SUN_ANGLE) * sqrt(((double)i + 0.5) / (double)count);
    double turn = GOLDEN_TURN * (double)i;
    set_frame(middle, &right, &up);
    vec off = vec_add(vec_scale(right, (float)(reach * real_cos(turn))),
                      vec_scale(up, (float)(reach * real_sin(turn))));
    return vec_unit(vec_add(middle, off));
}

picture_day picture_daylight(void)
{
    float flat = (float)real_cos(SUN_HEIGHT), open = 0, above = 0;
    picture_day day = {
        .sun = {flat * (float)real_sin(SUN_TURN), -flat * (float)real_cos(SUN_TURN),
                (float)real_sin(SUN_HEIGHT)},
        .sun_color = {1.10f, 0.99f, 0.84f},
    };
    for (uint32_t i = 0; i < SKY_MOST; i++) {
        float z = sky_direction(i, SKY_MOST).z;
        open += 2 * z / SKY_MOST;
        above += 2 * z / SKY_MOST * sqrtf(z);
    }
    day.open = vec_add(vec_scale(day.sun_color, day.sun.z), picture_sky_light(open, above));
    return day;
}

/* ---- depth maps ------------------------------------------------------------------------------ */

/* What all lights of a picture have in common while they are drawn. */
typedef struct drawing {
    const picture_scene *scene;
    vec low, high;               /* of what is lit */
    picture_light *lights;
    float **depth;               /* of each thread: room for the largest map */
    picture_point **points;
} drawing;

/* Along three axes, how far a box reaches. */
static void measure(const picture_light *l, vec low, vec high, vec *least, vec *most)
{
    *least = vec_of(FLT_MAX, FLT_MAX, FLT_MAX);
    *most = vec_scale(*least, -1);
    for (uint32_t i = 0; i < 8; i++) {
        vec p = vec_of(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        vec at = vec_of(vec_dot(p, l->right), vec_dot(p, l->up), vec_dot(p, l->direction));
        *least = vec_least(*least, at);
        *most = vec_most(*most, at);
    }
}

/* The map covers what is lit tightly, with an empty rim. */
static void aim(picture_light *l, const drawing *d)
{
    vec least, most;
    set_frame(l->direction, &l->right, &l->up);
    measure(l, d->low, d->high, &least, &most);
    float side = fmaxf(fmaxf(most.x - least.x, most.y - least.y), 1e-3f * d->scene->radius);
    l->texel = side / (float)(l->size - 2 * MAP_RIM);
    l->across = vec_scale(l->right, 1 / l->texel);
    l->down = vec_scale(l->up, 1 / l->texel);
    l->left = ((float)l->size - (least.x + most.x) / l->texel) / 2;
    l->top = ((float)l->size - (least.y + most.y) / l->texel) / 2;
    l->low = least.z - 2 * l->texel;
    l->scale = MAP_FULL / (most.z + 4 * l->texel - l->low);
}

static void set_row(double row[4], vec v, float more)
{
    row[0] = (double)v.x;
    row[1] = (double)v.y;
    row[2] = (double)v.z;
    row[3] = (double)more;
}

/* What is beyond all that is lit is as good as at its end: 1 … MAP_FULL, 0 nothing. */
static void keep_map(const picture_light *l, const float *depth)
{
    for (size_t i = 0; i < (size_t)l->size * l->size; i++)
        l->map[i] = depth[i] == -FLT_MAX
                        ? 0
                        : (uint16_t)clamp((depth[i] - l->low) * l->scale + 0.5f, 1, MAP_FULL);
}

static void draw_light(void *context, uint32_t thread, uint32_t item)
{
    const drawing *d = context;
    const picture_scene *s = d->scene;
    picture_light *l = &d->lights[item];
    picture_projection p = {.parallel = true, .slope = 1};
    aim(l, d);
    set_row(p.across, l->across, l->left);
    set_row(p.down, l->down, l->top);
    set_row(p.depth, l->direction, 0);
    const picture_samples to = {.width = l->size, .height = l->size, .nearness = d->depth[thread]};
    for (size_t i = 0; i < (size_t)l->size * l->size; i++)
        to.nearness[i] = -FLT_MAX;
    for (uint32_t i = 0; i < s->solids; i++) {
        picture_span reach = picture_chunk_span(&p, &s->chunks.at[i]);
        if (picture_may_show(&to, &reach))
            picture_draw_chunk(s, NULL, &p, i, d->points[thread], &to);
        if (i % 256 == 255 && result_cancelled(s->job->run))
            return;
    }
    keep_map(l, to.nearness);
}

static uint32_t affordable(uint64_t triangles, uint32_t part, uint32_t most, uint32_t least)
{
    uint64_t count = (uint64_t)BUDGET * part / 100 / (triangles + 1);
    return count > most ? most : count < least ? least : (uint32_t)count;
}

/* What is summed over all directions of the sky comes to 1 on open level ground. */
static picture_light *plan(const picture_scene *s, uint32_t count, uint32_t size, bool sun)
{
    arena *a = &s->job->memory;
    picture_light *lights = ARENA_ARRAY(a, picture_light, count);
    for (uint32_t i = 0; i < count; i++) {
        picture_light *l = &lights[i];
        l->direction = sun ? sun_direction(s->day.sun, i, count) : sky_direction(i, count);
        l->share = (sun ? 1.0f : 2.0f) / (float)count;
        l->above = sqrtf(fmaxf(l->direction.z, 0));
        l->size = size;
        l->map = arena_alloc_array(a, sizeof(uint16_t) * size, size);
    }
    return lights;
}

void picture_draw_lights(const picture_scene *s, vec low, vec high, uint32_t pixels,
                         picture_lights *out)
{
    arena *a = &s->job->memory;
    uint32_t threads = io_threads(s->job);
    uint32_t sky = (uint32_t)clamp(SKY_TEXELS * (float)pixels, MAP_LEAST, SKY_MAP_MOST);
    uint32_t sun = (uint32_t)clamp(SUN_TEXELS * (float)pixels, MAP_LEAST, SUN_MAP_MOST);
    drawing d = {.scene = s, .low = low, .high = high};
    d.depth = ARENA_ARRAY(a, float *, threads);
    d.points = ARENA_ARRAY(a, picture_point *, threads);
    for (uint32_t i = 0; i < threads; i++) {
        d.depth[i] = arena_alloc_array(a, sizeof(float) * sun, sun);
        d.points[i] = ARENA_ARRAY(a, picture_point, PICTURE_CHUNK_VERTICES);
    }
    out->sky_count = affordable(s->triangle_count, 75, SKY_MOST, SKY_LEAST);
    out->sun_count = affordable(s->triangle_count, 25, SUN_MOST, SUN_LEAST);
    d.lights = out->sky = plan(s, out->sky_count, sky, false);
    io_parallel(s->job, out->sky_count, draw_light, &d);
    d.lights = out->sun = plan(s, out->sun_count, sun, true);
    io_parallel(s->job, out->sun_count, draw_light, &d);
}

/* ---- what reaches a place -------------------------------------------------------------------- */

/* Texels that a place is moved off its surface, so that the surface does not shade itself, and
 * how much nearer to the light it counts on top of that. */
#define OFF_SURFACE 1.5f
#define NEARER 0.2f

/* How much of the light reaches a place: 0 … 1, between the four texels around it. `facing`:
 * normal . direction. */
static float reaches(const picture_light *l, vec place, vec normal, float facing)
{
    float x = vec_dot(place, l->across) + l->left + OFF_SURFACE * vec_dot(normal, l->right) - 0.5f;
    float y = vec_dot(place, l->down) + l->top + OFF_SURFACE * vec_dot(normal, l->up) - 0.5f;
    float last = (float)(l->size - 2);
    if (!(x >= 0 && y >= 0 && x < last && y < last))
        return 1;
    int column = (int)x, row = (int)y;
    float fx = x - (float)column, fy = y - (float)row;
    float height = vec_dot(place, l->direction) + l->texel * (OFF_SURFACE * facing + NEARER);
    height = fmaxf((height - l->low) * l->scale, 0);
    const uint16_t *map = l->map + (size_t)row * l->size + (size_t)column, *below = map + l->size;
    float above = (float)(map[0] <= height) * (1 - fx) + (float)(map[1] <= height) * fx;
    float under = (float)(below[0] <= height) * (1 - fx) + (float)(below[1] <= height) * fx;
    return above * (1 - fy) + under * fy;
}

/* All that arrives at one place of the lights of the sky, or of the sun. */
static void gather_at(const picture_light *lights, uint32_t count, bool sun, picture_fragment *f)
{
    float sum = 0, high = 0;
    for (uint32_t k = 0; k < count; k++) {
        const picture_light *l = &lights[k];
        float facing = vec_dot(f->normal, l->direction);
        if (!(facing > 0))
            continue;
        float lit = facing * l->share * reaches(l, f->place, f->normal, facing);
        sum += lit;
        high += lit * l->above;
    }
    if (sun) {
        f->sun = sum;
    } else {
        f->open = sum;
        f->above = high;
    }
}

/* ---- tiles ----------------------------------------------------------------------------------- */

/* The grid's pixel that is number i behind the start; the last one in the picture ends it. */
static uint32_t grid_pixel(uint32_t start, uint32_t i, uint32_t size)
{
    uint32_t at = start + i * PICTURE_LIGHT_STEP;
    return at < size ? at : size - 1;
}

static uint32_t grid_count(uint32_t from, uint32_t to)
{
    return (to - from - 1) / PICTURE_LIGHT_STEP + 2;
}

static void light_grid(const picture_scene *s, const picture_camera *c, const picture_lights *l,
                       picture_tile *t)
{
    for (uint32_t i = 0; i < grid_count(t->top, t->bottom); i++)
        for (uint32_t k = 0; k < grid_count(t->left, t->right); k++) {
            picture_fragment *f = &t->grid[i * PICTURE_LIGHT_GRID + k];
            bool any = picture_middle(s, c, t, grid_pixel(t->left, k, c->width),
                                      grid_pixel(t->top, i, c->height), f);
            f->share = any ? 1 : 0;
            if (any)
                gather_at(l->sky, l->sky_count, false, f);
        }
}

/* Whether the light at a pixel of the grid is that of the fragment's surface. */
static bool is_beside(const picture_camera *c, const picture_fragment *f, const picture_fragment *g)
{
    float apart = vec_dot(vec_subtract(g->place, f->place), f->flat);
    return g->share > 0 && vec_dot(f->normal, g->normal) > SAME_NORMAL &&
           fabsf(apart) < SAME_PLANE_PIXELS * picture_pixel(c, picture_depth(c, f->place));
}

/* Between the four pixels of the grid; false where they say too little. */
static bool take_from_grid(const picture_camera *c, const picture_tile *t, picture_fragment *f)
{
    uint32_t column = (f->x - t->left) / PICTURE_LIGHT_STEP;
    uint32_t row = (f->y - t->top) / PICTURE_LIGHT_STEP;
    const picture_fragment *g = t->grid + row * PICTURE_LIGHT_GRID + column;
    const picture_fragment *at[4] = {g, g + 1, g + PICTURE_LIGHT_GRID, g + PICTURE_LIGHT_GRID + 1};
    float least = FLT_MAX, most = -FLT_MAX;
    for (uint32_t i = 0; i < 4; i++) {
        if (!is_beside(c, f, at[i]))
            return false;
        least = fminf(least, at[i]->open);
        most = fmaxf(most, at[i]->open);
    }
    if (most - least > AGREES)
        return false;
    uint32_t wide = at[3]->x - at[0]->x, high = at[3]->y - at[0]->y;
    float x = wide ? clamp((f->at_x - 0.5f - (float)at[0]->x) / (float)wide, 0, 1) : 0;
    float y = high ? clamp((f->at_y - 0.5f - (float)at[0]->y) / (float)high, 0, 1) : 0;
    const float weight[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (uint32_t i = 0; i < 4; i++) {
        f->open += weight[i] * at[i]->open;
        f->above += weight[i] * at[i]->above;
    }
    return true;
}

void picture_light_tile(const picture_scene *s, const picture_camera *c, const picture_lights *l,
                        picture_tile *t)
{
    light_grid(s, c, l, t);
    for (uint32_t i = 0; i < t->fragment_count; i++) {
        picture_fragment *f = &t->fragments[i];
        if (!take_from_grid(c, t, f))
            gather_at(l->sky, l->sky_count, false, f);
        gather_at(l->sun, l->sun_count, true, f);
    }
}

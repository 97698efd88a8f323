/* picture_texture.c - textures with smaller levels, sampled over the footprint of a pixel.
 *
 * Levels are averaged in linear light. A footprint that is longer than wide is covered by
 * several samples along its length, each from the level that fits its width. Method: McCormack
 * and others, Feline, 1999, simplified.
 */
#include "stdlib/io/picture.h"

#include <string.h>

#include "runtime/real.h"

#define LN_2 0.69314718055994531

enum { ENOUGH = 1024, TAPS_MAX = 8, ENCODE_STEPS = 4096 };

float *picture_linear_table(io_job *j)
{
    float *linear = ARENA_ARRAY(&j->memory, float, 256);
    for (int i = 0; i < 256; i++)
        linear[i] = (float)color_linear(i / 255.0);
    return linear;
}

/* ---- levels ---------------------------------------------------------------------------------- */

typedef struct encoder {
    unsigned char byte[ENCODE_STEPS + 1]; /* sRGB, in equal steps of the light's square root */
} encoder;

static void fill_encoder(encoder *e)
{
    for (int i = 0; i <= ENCODE_STEPS; i++) {
        double root = (double)i / ENCODE_STEPS;
        e->byte[i] = (unsigned char)(color_srgb(root * root) * 255 + 0.5);
    }
}

static unsigned char encode(const encoder *e, float linear)
{
    return e->byte[(int)(sqrtf(clamp(linear, 0, 1)) * ENCODE_STEPS + 0.5f)];
}

/* The average of four texels; what is transparent has no say in the colour. */
static void average(const unsigned char *from[4], const float *linear, const encoder *e,
                    unsigned char *to)
{
    float color[3] = {0, 0, 0}, plain[3] = {0, 0, 0}, alpha = 0;
    for (int i = 0; i < 4; i++) {
        float weight = from[i][3];
        alpha += weight;
        for (int k = 0; k < 3; k++) {
            color[k] += weight * linear[from[i][k]];
            plain[k] += linear[from[i][k]];
        }
    }
    for (int k = 0; k < 3; k++)
        to[k] = encode(e, alpha > 0 ? color[k] / alpha : plain[k] / 4);
    to[3] = (unsigned char)(alpha / 4 + 0.5f);
}

static void halve(io_job *j, const picture_level *from, picture_level *to, const float *linear,
                  const encoder *e)
{
    to->width = from->width > 1 ? from->width / 2 : 1;
    to->height = from->height > 1 ? from->height / 2 : 1;
    unsigned char *out = arena_alloc(&j->memory, 4 * (size_t)to->width * to->height);
    to->texels = out;
    for (uint32_t y = 0; y < to->height; y++)
        for (uint32_t x = 0; x < to->width; x++) {
            uint32_t right = 2 * x + 1 < from->width ? 2 * x + 1 : from->width - 1;
            uint32_t below = 2 * y + 1 < from->height ? 2 * y + 1 : from->height - 1;
            uint32_t left = 2 * x < from->width ? 2 * x : right;
            uint32_t above = 2 * y < from->height ? 2 * y : below;
            const unsigned char *at[4] = {
                from->texels + 4 * ((size_t)above * from->width + left),
                from->texels + 4 * ((size_t)above * from->width + right),
                from->texels + 4 * ((size_t)below * from->width + left),
                from->texels + 4 * ((size_t)below * from->width + right)};
            average(at, linear, e, out + 4 * ((size_t)y * to->width + x));
        }
}

const picture_texture *picture_texture_read(io_job *j, const char *path, const float *linear)
{
    size_t size;
    const unsigned char *bytes = image_file_read(j, path, &size);
    if (!bytes)
        return NULL;
    io_image image;
    const char *wrong = image_decode(j, bytes, size, ENOUGH, &image);
    if (wrong) {
        result_warn(j->run, "the texture '%s' cannot be used: %s; its surfaces stay plain",
                    image_file_name(path), wrong);
        return NULL;
    }
    picture_texture *t = ARENA_NEW(&j->memory, picture_texture);
    encoder e;
    fill_encoder(&e);
    t->linear = linear;
    t->opaque = image.opaque;
    t->level[0] = (picture_level){image.width, image.height, image.pixels};
    for (t->level_count = 1; t->level_count < PICTURE_MIP_LEVELS; t->level_count++) {
        const picture_level *last = &t->level[t->level_count - 1];
        if (last->width == 1 && last->height == 1)
            break;
        halve(j, last, &t->level[t->level_count], linear, &e);
    }
    return t;
}

/* ---- sampling -------------------------------------------------------------------------------- */

typedef struct texel {
    float r, g, b, a;
} texel;

static texel fetch(const picture_texture *t, const picture_level *l, uint32_t x, uint32_t y)
{
    const unsigned char *p = l->texels + 4 * ((size_t)y * l->width + x);
    return (texel){t->linear[p[0]], t->linear[p[1]], t->linear[p[2]], (float)p[3] / 255};
}

static void add(texel *sum, texel t, float weight)
{
    sum->r += t.r * weight;
    sum->g += t.g * weight;
    sum->b += t.b * weight;
    sum->a += t.a * weight;
}

/* Splits a coordinate that repeats into the texel before it, the one behind it and how far it is
 * on the way. */
static float neighbours(float x, uint32_t size, uint32_t *before, uint32_t *behind)
{
    float at = (x - floorf(x)) * (float)size - 0.5f;
    if (!(at >= -0.5f && at <= (float)size)) /* not finite */
        at = 0;
    float floor_ = floorf(at);
    int32_t whole = (int32_t)floor_;
    *before = whole < 0 ? size - 1 : (uint32_t)whole < size ? (uint32_t)whole : size - 1;
    *behind = *before + 1 < size ? *before + 1 : 0;
    return at - floor_;
}

/* Bilinear; v points up. */
static void add_level(const picture_texture *t, uint32_t number, const float uv[2], float weight,
                      texel *sum)
{
    const picture_level *l = &t->level[number];
    uint32_t x0, x1, y0, y1;
    float fx = neighbours(uv[0], l->width, &x0, &x1), fy = neighbours(-uv[1], l->height, &y0, &y1);
    add(sum, fetch(t, l, x0, y0), weight * (1 - fx) * (1 - fy));
    add(sum, fetch(t, l, x1, y0), weight * fx * (1 - fy));
    add(sum, fetch(t, l, x0, y1), weight * (1 - fx) * fy);
    add(sum, fetch(t, l, x1, y1), weight * fx * fy);
}

/* The axes of a footprint: in texels of the largest level, the longer one first. */
typedef struct footprint {
    float step[2];               /* uv along the longer axis */
    float longer, shorter;
} footprint;

static footprint measure(const picture_texture *t, const float du[2], const float dv[2])
{
    float width = (float)t->level[0].width, height = (float)t->level[0].height;
    const float p[2] = {du[0] * width, du[1] * height}, q[2] = {dv[0] * width, dv[1] * height};
    float a = sqrtf(p[0] * p[0] + p[1] * p[1]), b = sqrtf(q[0] * q[0] + q[1] * q[1]);
    footprint f = {.longer = a, .shorter = b};
    memcpy(f.step, du, sizeof f.step);
    if (b > a) {
        f = (footprint){.longer = b, .shorter = a};
        memcpy(f.step, dv, sizeof f.step);
    }
    return f;
}

vec picture_texture_sample(const picture_texture *t, const float uv[2], const float du[2],
                           const float dv[2], float *alpha)
{
    footprint f = measure(t, du, dv);
    float width = fmaxf(f.shorter, fmaxf(f.longer / TAPS_MAX, 1e-6f));
    if (!isfinite(width))
        width = 1e6f;
    int taps = (int)clamp(ceilf(f.longer / width - 0.01f), 1, TAPS_MAX);
    float level = clamp((float)(real_log((double)width) / LN_2), 0, (float)(t->level_count - 1));
    uint32_t lower = (uint32_t)level;
    float rest = level - (float)lower;
    texel sum = {0, 0, 0, 0};
    for (int i = 0; i < taps; i++) {
        float along = ((float)i + 0.5f) / (float)taps - 0.5f;
        const float at[2] = {uv[0] + along * f.step[0], uv[1] + along * f.step[1]};
        add_level(t, lower, at, (1 - rest) / (float)taps, &sum);
        if (rest > 0)
            add_level(t, lower + 1, at, rest / (float)taps, &sum);
    }
    *alpha = sum.a;
    return vec_of(sum.r, sum.g, sum.b);
}

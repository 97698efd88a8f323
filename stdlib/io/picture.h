/* picture.h - a picture of a result, by our own rasteriser: what the picture_*.c files share.
 *
 * The scene is a list of triangles in chunks. A camera frames it. The picture is made tile by
 * tile, by several threads, each time in a buffer of nine samples a pixel that shows which
 * triangle each sample sees: first to find outlines and what can be seen at all, then for the
 * colours. Between the two, lights are drawn as depth maps of what can be seen: many that cover
 * the sky, some that cover a sun which is not a point. That gives soft shadows, and corners that
 * are dark because little of the sky reaches them. Samples of a pixel that show one surface are
 * one fragment, which is lit and coloured once; the light of the sky, which changes slowly, is
 * taken from a grid of pixels where that says enough. The ground catches shadows and is otherwise
 * the backdrop. No tile and no light depends on which thread makes it, so that equal scenes are
 * equal bytes. Memory is the scene, the maps, four bytes a pixel, and the tiles of the threads.
 *
 * Light is linear; a white surface that faces the sun has about 1.
 */
#ifndef PCG_PICTURE_H
#define PCG_PICTURE_H

#include <math.h>

#include "stdlib/io/io.h"

enum {
    PICTURE_GRID = 3,            /* samples a pixel, across and down */
    PICTURE_SAMPLES = PICTURE_GRID * PICTURE_GRID,
    PICTURE_TILE = 64,           /* pixels a side */
    PICTURE_RIM = 1,             /* pixels around a tile that are drawn, too */
    PICTURE_CHUNK_BITS = 8,
    PICTURE_CHUNK = 1 << PICTURE_CHUNK_BITS, /* triangles */
    PICTURE_CHUNK_VERTICES = 3 * PICTURE_CHUNK,
    PICTURE_DETAIL = 5,          /* floats a vertex: normal, uv */
    PICTURE_MIP_LEVELS = 15
};

#define PICTURE_NOTHING UINT32_MAX /* no triangle: the ground, or the backdrop */

/* ---- vectors --------------------------------------------------------------------------------- */

typedef struct vec {
    float x, y, z;
} vec;

static inline vec vec_of(float x, float y, float z)
{
    return (vec){x, y, z};
}
static inline vec vec_add(vec a, vec b)
{
    return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline vec vec_subtract(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline vec vec_scale(vec a, float k)
{
    return (vec){a.x * k, a.y * k, a.z * k};
}
static inline vec vec_multiply(vec a, vec b)
{
    return (vec){a.x * b.x, a.y * b.y, a.z * b.z};
}
static inline float vec_dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline vec vec_cross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* Of length 1; zero where it has none. */
static inline vec vec_unit(vec a)
{
    float square = vec_dot(a, a);
    return square > 0 && isfinite(square) ? vec_scale(a, 1 / sqrtf(square)) : vec_of(0, 0, 0);
}
static inline vec vec_mix(vec a, vec b, float t)
{
    return vec_add(a, vec_scale(vec_subtract(b, a), t));
}
/* Of each part the least, the most. */
static inline vec vec_least(vec a, vec b)
{
    return (vec){a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
static inline vec vec_most(vec a, vec b)
{
    return (vec){a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}
static inline float clamp(float x, float low, float high)
{
    return x > low ? x < high ? x : high : low;
}

/* ---- daylight -------------------------------------------------------------------------------- */

typedef struct picture_day {
    vec sun, sun_color;          /* towards its middle; as a surface that faces it gets it */
    vec open;                    /* what level ground gets that nothing stands on */
} picture_day;

picture_day picture_daylight(void);
/* Radiance of the sky in a direction, over a ground that reflects. */
vec picture_sky(vec direction);

/* ---- the scene ------------------------------------------------------------------------------- */

typedef struct picture_level {
    uint32_t width, height;
    const unsigned char *texels; /* 4 each: sRGB and alpha, top row first */
} picture_level;

typedef struct picture_texture {
    picture_level level[PICTURE_MIP_LEVELS];
    uint32_t level_count;
    bool opaque;
    const float *linear;         /* 256: linear light of sRGB bytes */
} picture_texture;

typedef struct picture_material {
    vec color;
    float alpha, metallic, roughness;
    const picture_texture *texture; /* NULL: none */
} picture_material;

/* Up to PICTURE_CHUNK triangles that came one after the other. Triangle i of chunk c has the
 * number c * PICTURE_CHUNK + i. */
typedef struct picture_chunk {
    vec low, high;               /* bounds */
    const float *place;          /* 3 a vertex */
    const float *detail;         /* PICTURE_DETAIL a vertex; NULL: flat, and without texture */
    const uint16_t *index;       /* 3 a triangle */
    const uint32_t *material;    /* of each triangle */
    uint16_t vertex_count, triangle_count;
} picture_chunk;

typedef struct picture_scene {
    io_job *job;
    LIST(picture_chunk) chunks;
    struct picture_filling *filling; /* the chunk that is being made */
    LIST(picture_material) materials; /* by number of the look */
    io_pointers looks;
    table textures;              /* by path: pointers to picture_texture *, which may be NULL */
    float *linear;
    pcg_vec3 center;             /* of the world: what was taken off its coordinates */
    io_batch lines, points;      /* until they are made triangles */
    uint32_t *line_material, *point_material;
    uint32_t line_count, line_capacity, point_count, point_capacity;
    uint32_t ribbons;            /* triangles from here on are lines and points: no outlines */
    uint32_t solids;             /* chunks before those */
    uint64_t triangle_count;     /* in them */
    bool empty;
    vec low, high;               /* its bounds; a unit cube when empty */
    float radius;                /* half of their diagonal */
    picture_day day;
} picture_scene;

static inline const picture_chunk *picture_chunk_of(const picture_scene *s, uint32_t triangle)
{
    return &s->chunks.at[triangle >> PICTURE_CHUNK_BITS];
}
/* Number, in its chunk, of a triangle's corner. */
static inline uint32_t picture_corner(const picture_chunk *c, uint32_t triangle, uint32_t corner)
{
    return c->index[3 * (triangle % PICTURE_CHUNK) + corner];
}
static inline vec picture_place(const picture_scene *s, uint32_t triangle, uint32_t corner)
{
    const picture_chunk *c = picture_chunk_of(s, triangle);
    const float *v = c->place + 3 * picture_corner(c, triangle, corner);
    return vec_of(v[0], v[1], v[2]);
}
static inline const picture_material *picture_material_of(const picture_scene *s,
                                                          uint32_t triangle)
{
    const picture_chunk *c = picture_chunk_of(s, triangle);
    return &s->materials.at[c->material[triangle % PICTURE_CHUNK]];
}

/* Takes up what came out; `center`: what to take off its coordinates. */
void picture_gather(picture_scene *s, io_job *j, pcg_vec3 center);
/* A triangle of three places and one normal in the chunk that is being made. */
void picture_add_triangle(picture_scene *s, const vec place[3], vec normal, uint32_t material);
/* Ends the chunk that is being made. */
void picture_end_chunk(picture_scene *s);
/* A texture with its levels; NULL, having warned, where the file cannot be used. `linear` as in
 * the texture. */
const picture_texture *picture_texture_read(io_job *j, const char *path, const float *linear);
/* The 256 values of picture_texture.linear. */
float *picture_linear_table(io_job *j);
/* Linear colour (x y z) and alpha, filtered over the parallelogram of uv that a pixel covers. */
vec picture_texture_sample(const picture_texture *t, const float uv[2], const float du[2],
                           const float dv[2], float *alpha);

/* ---- the camera ------------------------------------------------------------------------------ */

/* From the scene to samples of a picture or texels of a map, in double: seen from far away, what
 * lies a few centimetres apart stays apart. Rows hold x, y, z, 1. */
typedef struct picture_projection {
    double across[4], down[4];   /* samples; in perspective, times the depth */
    double depth[4];             /* metres along the direction that is looked in */
    bool parallel;
    double middle_x, middle_y;   /* samples */
    double slope, base;          /* nearness: slope / depth + base, or slope * depth + base */
    double nearest;              /* what is less deep is cut off */
} picture_projection;

/* What a projection makes of a place. Nearness is affine over the picture: 0 at the far end of the
 * scene, 1 at its near one. A triangle whose corners have one column, or one row, holds no
 * sample. */
typedef struct picture_point {
    double x, y, near;           /* near infinite: cut off */
    uint32_t column, row;        /* of the first sample behind it, right and down */
} picture_point;

typedef struct picture_camera {
    vec eye, right, up, forward; /* of length 1 */
    bool parallel;               /* rays are; then the eye is anywhere before the scene */
    float focal;                 /* pixels; where rays are parallel, a metre in pixels */
    float middle_x, middle_y;    /* pixels, of the picture */
    float nearest, farthest;     /* depths between which the scene is */
    float gap;                   /* metres that the ground lies below the scene */
    float haze;                  /* how much of what is farthest vanishes in the air */
    uint32_t width, height;
    picture_projection projection;
} picture_camera;

/* Which way the options look, and from where. Returns false, having failed the job, where they
 * make no sense. */
typedef struct picture_aim {
    const char *view;            /* NULL: chosen by what the scene is like */
    bool aimed, placed;
    pcg_vec3 target, from;       /* in the world */
    double radius;               /* around the target; 0: all of the scene */
} picture_aim;
bool picture_read_aim(io_job *j, const char *path, picture_aim *out);
/* Frames the scene, or what is aimed at, tightly. */
void picture_frame(picture_camera *c, const picture_scene *s, const picture_aim *a,
                   uint32_t width, uint32_t height);
/* The ray through a place in the picture, in pixels: where it begins, and its direction, not of
 * length 1, whose part along `forward` is 1. */
static inline vec picture_ray(const picture_camera *c, float x, float y, vec *origin)
{
    vec aside = vec_add(vec_scale(c->right, (x - c->middle_x) / c->focal),
                        vec_scale(c->up, (c->middle_y - y) / c->focal));
    *origin = c->parallel ? vec_add(c->eye, aside) : c->eye;
    return c->parallel ? c->forward : vec_add(c->forward, aside);
}
static inline float picture_depth(const picture_camera *c, vec p)
{
    return vec_dot(vec_subtract(p, c->eye), c->forward);
}
/* Metres that a pixel is wide at a depth. */
static inline float picture_pixel(const picture_camera *c, float depth)
{
    return (c->parallel ? 1 : fmaxf(depth, c->nearest)) / c->focal;
}
/* Towards the eye, of length 1. */
static inline vec picture_view(const picture_camera *c, vec p)
{
    return c->parallel ? vec_scale(c->forward, -1) : vec_unit(vec_subtract(c->eye, p));
}
/* Depth of a nearness. */
static inline float picture_depth_of(const picture_camera *c, float nearness)
{
    const picture_projection *p = &c->projection;
    double above = (double)nearness - p->base;
    return (float)(c->parallel ? above / p->slope : p->slope / above);
}
/* Makes lines and points triangles that are about a pixel wide. */
void picture_ribbons(picture_scene *s, const picture_camera *c);

/* ---- drawing --------------------------------------------------------------------------------- */

/* Samples of a part of the picture, or texels of a map. */
typedef struct picture_samples {
    uint32_t left, top;          /* in samples, of the whole picture */
    uint32_t width, height;
    float *nearness;             /* 0, or what the map was cleared to: nothing */
    uint32_t *triangle;          /* NULL: a map */
    float floor;                 /* nearness that every sample has at least */
} picture_samples;

/* How far right of its middle a sample of some row lies: so the three rows of a pixel see nine
 * columns. */
static inline float picture_shift(uint32_t row)
{
    static const float shift[PICTURE_GRID] = {0, 1.0f / 3, -1.0f / 3};
    return shift[row % PICTURE_GRID];
}

/* Where a chunk may be seen, in samples, and how near. */
typedef struct picture_span {
    float left, top, right, bottom, near;
} picture_span;

picture_span picture_chunk_span(const picture_projection *p, const picture_chunk *c);
/* Whether some of a chunk can be seen in the samples. */
bool picture_may_show(const picture_samples *t, const picture_span *span);
/* Draws a chunk. `c` NULL: into a map, and only what casts shadows. `points`: room for
 * PICTURE_CHUNK_VERTICES. */
void picture_draw_chunk(const picture_scene *s, const picture_camera *c,
                        const picture_projection *p, uint32_t chunk, picture_point *points,
                        const picture_samples *t);
/* Of length 1; zero where it has none. */
vec picture_flat_normal(const picture_scene *s, uint32_t triangle);
/* Where a ray meets a triangle's plane, kept between the depths of its corners. */
float picture_meet(const picture_scene *s, const picture_camera *c, uint32_t triangle, vec normal,
                   vec origin, vec ray);
/* How much the corners of a triangle weigh at a place on its plane; they sum to 1. */
void picture_weights(const picture_scene *s, uint32_t triangle, vec p, float weight[3]);
/* False where the triangle has no texture. */
bool picture_uv(const picture_scene *s, uint32_t triangle, vec p, float uv[2]);

/* ---- tiles and fragments --------------------------------------------------------------------- */

/* What samples of one pixel show of one surface. */
typedef struct picture_fragment {
    uint32_t x, y;               /* its pixel */
    uint32_t triangle;           /* PICTURE_NOTHING: the ground */
    float share;                 /* of the pixel */
    float at_x, at_y;            /* the middle of its samples, in pixels */
    vec place;                   /* on its plane */
    vec flat, normal;            /* of the plane, and as shaded; towards the eye */
    float open, above, sun;      /* light that reaches it: see picture_sky_light */
} picture_fragment;

/* A part of the picture while a thread works on it. */
typedef struct picture_tile {
    uint32_t left, top, right, bottom; /* pixels, the last ones behind it */
    uint32_t first_x, first_y, end_x, end_y; /* with its rim */
    picture_samples samples;
    picture_point *points;
    picture_fragment *fragments; /* room for PICTURE_SAMPLES a pixel */
    uint32_t fragment_count;
    picture_fragment *grid;
    vec *color;                  /* of each pixel */
    vec low, high;               /* bounds of what can be seen, over the tiles of a thread */
} picture_tile;

/* Sets tile number `item` up and draws it. */
void picture_draw_tile(const picture_scene *s, const picture_camera *c, const picture_span *spans,
                       uint32_t item, picture_tile *t);
/* How much of each pixel is an outline: an edge, a crease, a rim; in ninths, into `edges` of the
 * whole picture. */
void picture_find_edges(const picture_scene *s, const picture_camera *c, const picture_tile *t,
                        unsigned char *edges);
/* Adds what the tile sees to its bounds. */
void picture_see(const picture_scene *s, const picture_camera *c, picture_tile *t);
void picture_find_fragments(const picture_scene *s, const picture_camera *c, picture_tile *t);
/* What the middle sample of a pixel shows; false where that is nothing that light falls on. */
bool picture_middle(const picture_scene *s, const picture_camera *c, const picture_tile *t,
                    uint32_t x, uint32_t y, picture_fragment *out);

/* ---- light ----------------------------------------------------------------------------------- */

/* Depth along a direction, of what light from there meets first, in steps of 16 bits. */
typedef struct picture_light {
    vec direction;               /* towards it */
    vec right, up;               /* of length 1 */
    vec across, down;            /* p is at (p . across + left, p . down + top), in texels */
    float left, top, texel;      /* texel: in metres */
    float low, scale;            /* value of a depth: (depth - low) * scale */
    float share, above;          /* of all the light; of that, how much is from high up */
    uint32_t size;
    uint16_t *map;
} picture_light;

typedef struct picture_lights {
    picture_light *sky, *sun;
    uint32_t sky_count, sun_count;
} picture_lights;

/* Light of the sky, of which the share `open` arrives, and of that `above` from high up. */
vec picture_sky_light(float open, float above);
/* Draws the lights of what lies between two corners. `pixels`: of the longer side of the picture,
 * which says how fine shadows have to be. */
void picture_draw_lights(const picture_scene *s, vec low, vec high, uint32_t pixels,
                         picture_lights *out);
/* Fills in what reaches the fragments of a tile: of the sky, 1 on open level ground; of the sun,
 * 1 on what faces it. */
void picture_light_tile(const picture_scene *s, const picture_camera *c, const picture_lights *l,
                        picture_tile *t);
/* Room for the grid of a tile: a pixel in so many, and the one behind the last. */
enum { PICTURE_LIGHT_STEP = 4, PICTURE_LIGHT_GRID = PICTURE_TILE / PICTURE_LIGHT_STEP + 1 };

/* The colour of a fragment that is not ground, in linear light. */
vec picture_shade(const picture_scene *s, const picture_camera *c, const picture_fragment *f);
/* What stands behind everything, in linear light: x, y in pixels. */
vec picture_backdrop(const picture_camera *c, float x, float y);
/* How much of what is so deep vanishes in the air. */
float picture_haze(const picture_camera *c, float depth);

#endif

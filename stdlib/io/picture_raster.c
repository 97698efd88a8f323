/* picture_raster.c - which triangle is nearest at each sample, for cameras and for the depth
 * maps of lights.
 *
 * A sample belongs to a triangle when it is inside; edges are always walked from their upper end
 * to their lower one, so that two triangles with an edge in common leave no gap and share no
 * sample. Nearness is affine over the picture both in perspective and without. It is reckoned in
 * double and kept in single precision, which over the depth of a scene is finer than what tells
 * surfaces apart.
 */
#include "stdlib/io/picture.h"

#include <float.h>

/* Of two surfaces in one place, the one that was drawn first stays: no speckles. In one place is
 * what lies nearer together than coordinates in single precision can say: this share of the
 * depth, and that of the coordinates themselves. */
#define SAME_DEPTH 1.2e-7
#define SAME_PLACE 2.4e-7

/* ---- projecting ------------------------------------------------------------------------------ */

static double row_at(const double row[4], const float *p)
{
    return row[0] * (double)p[0] + row[1] * (double)p[1] + row[2] * (double)p[2] + row[3];
}

static picture_point project(const picture_projection *p, const float *at)
{
    double x = row_at(p->across, at), y = row_at(p->down, at), depth = row_at(p->depth, at);
    if (p->parallel)
        return (picture_point){p->middle_x + x, p->middle_y + y, p->slope * depth + p->base, 0, 0};
    if (depth < p->nearest)
        return (picture_point){0, 0, HUGE_VAL, 0, 0};
    double inverse = 1 / depth;
    return (picture_point){p->middle_x + x * inverse, p->middle_y + y * inverse,
                           p->slope * inverse + p->base, 0, 0};
}

picture_span picture_chunk_span(const picture_projection *p, const picture_chunk *c)
{
    const picture_span nowhere = {FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX, 0};
    picture_span s = nowhere;
    uint32_t behind = 0; /* corners that are behind the camera */
    for (uint32_t i = 0; i < 8; i++) {
        const float at[3] = {i & 1 ? c->high.x : c->low.x, i & 2 ? c->high.y : c->low.y,
                             i & 4 ? c->high.z : c->low.z};
        picture_point q = project(p, at);
        if (isinf(q.near)) {
            behind++;
            continue;
        }
        s.left = fminf(s.left, (float)(q.x - 1));
        s.top = fminf(s.top, (float)(q.y - 1));
        s.right = fmaxf(s.right, (float)(q.x + 1));
        s.bottom = fmaxf(s.bottom, (float)(q.y + 1));
        s.near = fmaxf(s.near, (float)q.near * 1.000001f);
    }
    if (behind == 8)
        return nowhere;
    if (behind > 0) /* it passes beside the camera: it may be anywhere */
        return (picture_span){-FLT_MAX, -FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX};
    return s;
}

bool picture_may_show(const picture_samples *t, const picture_span *s)
{
    return s->left <= (float)(t->left + t->width) && s->right >= (float)t->left &&
           s->top <= (float)(t->top + t->height) && s->bottom >= (float)t->top &&
           (!t->triangle || s->near > t->floor);
}

/* The first sample whose middle is behind x, within the picture: without branches, since that is
 * asked of every vertex. */
static uint32_t first_sample(double x, uint32_t size)
{
    double at = x + 0.5, last = (double)size;
    at = at > 0 ? at : 0;
    at = at < last ? at : last;
    return (uint32_t)at;
}

/* To where the samples begin. */
static void move(picture_point *p, const picture_samples *t)
{
    p->x -= t->left;
    p->y -= t->top;
    p->column = first_sample(p->x, t->width);
    p->row = first_sample(p->y, t->height);
}

/* ---- a triangle ------------------------------------------------------------------------------ */

/* How much nearness can differ in one place: always + v (once + twice v), where v = nearness - base
 * goes with the inverse of the depth. A triangle can reach from the camera's feet to the
 * horizon. */
typedef struct tie {
    float base, always, once, twice;
} tie;

/* A triangle while it is drawn. */
typedef struct drawing {
    picture_point top, middle, bottom;
    double across, down, origin; /* nearness at (x, y): origin + across x + down y */
    float least, most;           /* of its corners: slivers do not reach beyond */
    const struct tie *tie;
    uint32_t number;
} drawing;

static void swap(picture_point *a, picture_point *b)
{
    picture_point c = *a;
    *a = *b;
    *b = c;
}

/* False where the triangle is too thin to hold a sample. */
static bool set_up(drawing *d, const picture_point *a, const picture_point *b,
                   const picture_point *c)
{
    d->top = *a;
    d->middle = *b;
    d->bottom = *c;
    if (d->middle.y < d->top.y)
        swap(&d->middle, &d->top);
    if (d->bottom.y < d->middle.y)
        swap(&d->bottom, &d->middle);
    if (d->middle.y < d->top.y)
        swap(&d->middle, &d->top);
    double ux = d->middle.x - d->top.x, uy = d->middle.y - d->top.y;
    double vx = d->bottom.x - d->top.x, vy = d->bottom.y - d->top.y;
    double un = d->middle.near - d->top.near, vn = d->bottom.near - d->top.near;
    double area = ux * vy - uy * vx;
    if (!(fabs(area) > 1e-12))
        return false;
    d->across = (un * vy - uy * vn) / area;
    d->down = (ux * vn - un * vx) / area;
    d->origin = d->top.near - d->across * d->top.x - d->down * d->top.y;
    d->least = (float)fmin(fmin(d->top.near, d->middle.near), d->bottom.near);
    d->most = (float)fmax(fmax(d->top.near, d->middle.near), d->bottom.near);
    return true;
}

static double edge_at(const picture_point *upper, const picture_point *lower, double y)
{
    return upper->x + (y - upper->y) * ((lower->x - upper->x) / (lower->y - upper->y));
}

/* ---- transparency ---------------------------------------------------------------------------- */

/* Which samples of a span a transparent triangle takes. */
typedef struct veil {
    const picture_scene *scene;
    const picture_camera *camera;
    const picture_texture *holes; /* a texture that has some; NULL: none */
    uint32_t level, shift;
    float alpha;
} veil;

/* In how many of nine samples a surface of some opacity is seen: each in its turn. */
static bool takes_sample(uint32_t x, uint32_t y, uint32_t shift, float alpha)
{
    static const unsigned char turn[PICTURE_SAMPLES] = {0, 5, 2, 7, 3, 8, 4, 1, 6};
    uint32_t sample = turn[y % PICTURE_GRID * PICTURE_GRID + x % PICTURE_GRID];
    return (float)((sample + shift) % PICTURE_SAMPLES) + 0.5f < alpha * PICTURE_SAMPLES;
}

/* Of the texture, at a sample of the picture. */
static float texture_alpha(const veil *v, uint32_t triangle, uint32_t x, uint32_t y)
{
    const picture_scene *s = v->scene;
    const picture_level *l = &v->holes->level[v->level];
    vec origin, ray = picture_ray(v->camera, ((float)x + 0.5f + picture_shift(y)) / PICTURE_GRID,
                                  ((float)y + 0.5f) / PICTURE_GRID, &origin);
    vec normal = picture_flat_normal(s, triangle);
    float depth = picture_meet(s, v->camera, triangle, normal, origin, ray), uv[2];
    if (!picture_uv(s, triangle, vec_add(origin, vec_scale(ray, depth)), uv))
        return 1;
    float fx = uv[0] - floorf(uv[0]), fy = -uv[1] - floorf(-uv[1]);
    if (!(fx >= 0 && fy >= 0))
        return 1;
    uint32_t column = (uint32_t)(fx * (float)l->width), row = (uint32_t)(fy * (float)l->height);
    column = column < l->width ? column : l->width - 1;
    row = row < l->height ? row : l->height - 1;
    return (float)l->texels[4 * ((size_t)row * l->width + column) + 3] / 255;
}

/* The level of a texture whose texels are about as large as samples, where the surface faces the
 * eye. */
static uint32_t fitting_level(const veil *v, uint32_t triangle)
{
    const picture_scene *s = v->scene;
    const picture_texture *t = v->holes;
    vec a = picture_place(s, triangle, 0), b = picture_place(s, triangle, 1);
    vec c = picture_place(s, triangle, 2);
    vec cross = vec_cross(vec_subtract(b, a), vec_subtract(c, a));
    float p[2], q[2], r[2], area = sqrtf(vec_dot(cross, cross));
    if (!picture_uv(s, triangle, a, p) || !picture_uv(s, triangle, b, q) ||
        !picture_uv(s, triangle, c, r))
        return 0;
    float texels = fabsf((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) *
                   (float)t->level[0].width * (float)t->level[0].height;
    float sample = picture_pixel(v->camera, picture_depth(v->camera, a)) / PICTURE_GRID;
    uint32_t level = 0;
    for (texels *= sample * sample; texels > 4 * area && level + 1 < t->level_count; level++)
        texels /= 4;
    return level;
}

/* ---- spans ----------------------------------------------------------------------------------- */

/* Whether it is nearer than what was drawn before, and not in the same place. */
static bool is_nearer(const drawing *d, float near, float before)
{
    float v = near - d->tie->base;
    return near > before &&
           near > before + d->tie->always + v * (d->tie->once + d->tie->twice * v);
}

static float nearness_at(const drawing *d, double x, double y)
{
    float near = (float)(d->origin + d->across * x + d->down * y);
    return clamp(near, d->least, d->most);
}

/* Samples of a row, from the first of which nearness is taken: over the few that follow, steps in
 * single precision are fine enough. */
static void draw_span(const picture_samples *t, const drawing *d, uint32_t y, uint32_t from,
                      uint32_t to)
{
    float *nearness = t->nearness + (size_t)t->width * y, step = (float)d->across;
    double left = (double)from + 0.5 + (t->triangle ? (double)picture_shift(y) : 0);
    float start = (float)(d->origin + d->across * left + d->down * ((double)y + 0.5));
    if (!t->triangle) {
        for (uint32_t x = from; x < to; x++) {
            float near = clamp(start + step * (float)(x - from), d->least, d->most);
            nearness[x] = near > nearness[x] ? near : nearness[x];
        }
        return;
    }
    uint32_t *triangle = t->triangle + (size_t)t->width * y;
    for (uint32_t x = from; x < to; x++) {
        float near = clamp(start + step * (float)(x - from), d->least, d->most);
        if (is_nearer(d, near, nearness[x])) {
            nearness[x] = near;
            triangle[x] = d->number;
        }
    }
}

static void draw_veil(const picture_samples *t, const drawing *d, uint32_t y, uint32_t from,
                      uint32_t to, const veil *v)
{
    size_t row = (size_t)t->width * y;
    for (uint32_t x = from; x < to; x++) {
        double at = (double)x + 0.5 + (double)picture_shift(y);
        float near = nearness_at(d, at, (double)y + 0.5), alpha = v->alpha;
        if (!is_nearer(d, near, t->nearness[row + x]))
            continue;
        if (v->holes)
            alpha *= texture_alpha(v, d->number, t->left + x, t->top + y);
        if (!takes_sample(t->left + x, t->top + y, v->shift, alpha))
            continue;
        t->nearness[row + x] = near;
        t->triangle[row + x] = d->number;
    }
}

/* The rows of one half of a triangle, between its long edge and one of the others. */
static void draw_half(const picture_samples *t, const drawing *d, const picture_point *upper,
                      const picture_point *lower, const veil *v)
{
    uint32_t end = first_sample(lower->y, t->height);
    for (uint32_t y = first_sample(upper->y, t->height); y < end; y++) {
        double middle = (double)y + 0.5, shift = t->triangle ? (double)picture_shift(y) : 0;
        double a = edge_at(&d->top, &d->bottom, middle) - shift;
        double b = edge_at(upper, lower, middle) - shift;
        uint32_t from = first_sample(a < b ? a : b, t->width);
        uint32_t to = first_sample(a < b ? b : a, t->width);
        if (v)
            draw_veil(t, d, y, from, to, v);
        else if (from < to)
            draw_span(t, d, y, from, to);
    }
}

/* ---- chunks ---------------------------------------------------------------------------------- */

/* What triangles of a chunk are drawn with. */
typedef struct pen {
    const picture_scene *scene;
    const picture_camera *camera;
    const picture_projection *projection;
    const picture_samples *to;
    tie tie;
} pen;

/* Coordinates of the chunk are as exact as single precision is. */
static tie find_tie(const picture_projection *p, double place_error)
{
    if (p->parallel)
        return (tie){0, (float)(SAME_DEPTH + place_error * fabs(p->slope)), 0, 0};
    return (tie){(float)p->base, 0, (float)SAME_DEPTH, (float)(place_error / p->slope)};
}

/* Rows of the picture are shifted by less than half a sample. */
static bool misses_columns(const picture_samples *t, double a, double b, double c)
{
    double low = fmin(fmin(a, b), c) - 0.34, high = fmax(fmax(a, b), c) + 0.34;
    return first_sample(low, t->width) == first_sample(high, t->width);
}

/* In large scenes most triangles are smaller than a sample: they leave at once. */
static void draw_points(const pen *k, const picture_point *a, const picture_point *b,
                        const picture_point *c, uint32_t number, const veil *v)
{
    const picture_samples *t = k->to;
    drawing d;
    if ((a->row == b->row && b->row == c->row) ||
        (a->column == b->column && b->column == c->column &&
         (!t->triangle || misses_columns(t, a->x, b->x, c->x))) ||
        !set_up(&d, a, b, c))
        return;
    d.number = number;
    d.tie = &k->tie;
    draw_half(t, &d, &d.top, &d.middle, v);
    draw_half(t, &d, &d.middle, &d.bottom, v);
}

/* Of a triangle that reaches behind the camera, what is before it: up to four corners. */
static void draw_clipped(const pen *k, uint32_t number, const veil *v)
{
    const picture_projection *p = k->projection;
    picture_point out[4];
    uint32_t count = 0;
    for (uint32_t i = 0; i < 3; i++) {
        vec a = picture_place(k->scene, number, i);
        vec b = picture_place(k->scene, number, (i + 1) % 3);
        const float at[3] = {a.x, a.y, a.z}, next[3] = {b.x, b.y, b.z};
        double from = row_at(p->depth, at), to = row_at(p->depth, next);
        if (from >= p->nearest)
            out[count++] = project(p, at);
        if ((from >= p->nearest) == (to >= p->nearest))
            continue;
        double along = (p->nearest - from) / (to - from), inverse = 1 / p->nearest;
        double x = row_at(p->across, at), y = row_at(p->down, at);
        x += along * (row_at(p->across, next) - x);
        y += along * (row_at(p->down, next) - y);
        out[count++] = (picture_point){p->middle_x + x * inverse, p->middle_y + y * inverse,
                                       p->slope * inverse + p->base, 0, 0};
    }
    for (uint32_t i = 0; i < count; i++)
        move(&out[i], k->to);
    for (uint32_t i = 2; i < count; i++)
        draw_points(k, &out[0], &out[i - 1], &out[i], number, v);
}

static void draw_triangle(const pen *k, const picture_chunk *c, const picture_point *points,
                          uint32_t number, const veil *v)
{
    const uint16_t *corner = c->index + 3 * (number % PICTURE_CHUNK);
    const picture_point *p = &points[corner[0]], *q = &points[corner[1]], *r = &points[corner[2]];
    if (isinf(p->near) || isinf(q->near) || isinf(r->near))
        draw_clipped(k, number, v);
    else
        draw_points(k, p, q, r, number, v);
}

static void draw_seen(const pen *k, const picture_chunk *c, const picture_point *points,
                      uint32_t number)
{
    const picture_material *m = picture_material_of(k->scene, number);
    bool holes = m->texture && !m->texture->opaque && c->detail;
    if (m->alpha >= 1 && !holes) {
        draw_triangle(k, c, points, number, NULL);
        return;
    }
    veil v = {.scene = k->scene, .camera = k->camera, .holes = holes ? m->texture : NULL};
    v.alpha = m->alpha;
    v.shift = c->material[number % PICTURE_CHUNK];
    if (holes)
        v.level = fitting_level(&v, number);
    draw_triangle(k, c, points, number, &v);
}

static void project_all(const picture_projection *p, const picture_chunk *c, picture_point *points,
                        const picture_samples *t)
{
    for (uint32_t v = 0; v < c->vertex_count; v++) {
        points[v] = project(p, c->place + 3 * v);
        move(&points[v], t);
    }
}

/* The same for rays that are parallel, as those of lights are: most of all projecting. */
static void project_parallel(const picture_projection *p, const picture_chunk *c,
                             picture_point *points, const picture_samples *t)
{
    picture_projection q = *p;
    uint32_t width = t->width, height = t->height;
    q.across[3] += q.middle_x - t->left;
    q.down[3] += q.middle_y - t->top;
    for (uint32_t v = 0; v < c->vertex_count; v++) {
        const float *at = c->place + 3 * v;
        double x = row_at(q.across, at), y = row_at(q.down, at);
        points[v] = (picture_point){x, y, q.slope * row_at(q.depth, at) + q.base,
                                    first_sample(x, width), first_sample(y, height)};
    }
}

static float largest(vec v)
{
    return fmaxf(fmaxf(fabsf(v.x), fabsf(v.y)), fabsf(v.z));
}

void picture_draw_chunk(const picture_scene *s, const picture_camera *camera,
                        const picture_projection *p, uint32_t chunk, picture_point *points,
                        const picture_samples *t)
{
    const picture_chunk *c = &s->chunks.at[chunk];
    pen k = {.scene = s, .camera = camera, .projection = p, .to = t};
    k.tie = find_tie(p, SAME_PLACE * (double)fmaxf(largest(c->low), largest(c->high)));
    if (p->parallel)
        project_parallel(p, c, points, t);
    else
        project_all(p, c, points, t);
    uint32_t first = chunk << PICTURE_CHUNK_BITS;
    for (uint32_t i = 0; i < c->triangle_count; i++)
        if (camera)
            draw_seen(&k, c, points, first + i);
        else if (s->materials.at[c->material[i]].alpha >= 0.5f)
            draw_points(&k, &points[c->index[3 * i]], &points[c->index[3 * i + 1]],
                        &points[c->index[3 * i + 2]], first + i, NULL);
}

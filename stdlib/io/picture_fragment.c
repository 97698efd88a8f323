/* picture_fragment.c - tiles: from samples to fragments and outlines.
 *
 * Samples of a pixel that show the same surface are one fragment: most pixels have one, those on
 * edges two or three. So light and textures are computed about once a pixel, and edges still
 * have nine steps.
 */
#include "stdlib/io/picture.h"

#define SAME_PLANE 0.9999f   /* cosine between normals */
#define CREASE 0.82f         /* cosine between normals: 35 degrees */
#define STEP_PIXELS 2.5f     /* a step in depth of so many pixels is an edge */
enum { EDGE_MOST = 6 };       /* ninths of a pixel: then it is as dark as it gets */
#define GROUND_REACH 60.0f   /* radii of the scene that the ground reaches */

/* ---- surfaces -------------------------------------------------------------------------------- */

vec picture_flat_normal(const picture_scene *s, uint32_t triangle)
{
    vec a = picture_place(s, triangle, 0);
    return vec_unit(vec_cross(vec_subtract(picture_place(s, triangle, 1), a),
                              vec_subtract(picture_place(s, triangle, 2), a)));
}

float picture_meet(const picture_scene *s, const picture_camera *c, uint32_t triangle, vec normal,
                   vec origin, vec ray)
{
    vec a = picture_place(s, triangle, 0);
    float d0 = picture_depth(c, a), d1 = picture_depth(c, picture_place(s, triangle, 1));
    float d2 = picture_depth(c, picture_place(s, triangle, 2));
    float low = fminf(fminf(d0, d1), d2), high = fmaxf(fmaxf(d0, d1), d2);
    float slope = vec_dot(ray, normal);
    if (!(fabsf(slope) > 1e-6f))
        return (low + high) / 2;
    return clamp(vec_dot(vec_subtract(a, origin), normal) / slope, low, high);
}

void picture_weights(const picture_scene *s, uint32_t triangle, vec p, float weight[3])
{
    vec a = picture_place(s, triangle, 0);
    vec u = vec_subtract(picture_place(s, triangle, 1), a);
    vec v = vec_subtract(picture_place(s, triangle, 2), a), w = vec_subtract(p, a);
    float uu = vec_dot(u, u), uv = vec_dot(u, v), vv = vec_dot(v, v);
    float wu = vec_dot(w, u), wv = vec_dot(w, v), area = uu * vv - uv * uv;
    weight[1] = area > 0 ? (vv * wu - uv * wv) / area : 0;
    weight[2] = area > 0 ? (uu * wv - uv * wu) / area : 0;
    if (!isfinite(weight[1]) || !isfinite(weight[2]))
        weight[1] = weight[2] = 0;
    weight[0] = 1 - weight[1] - weight[2];
}

static vec shading_normal(const picture_scene *s, uint32_t triangle, vec p, vec flat)
{
    const picture_chunk *c = picture_chunk_of(s, triangle);
    float weight[3];
    vec sum = {0, 0, 0};
    if (!c->detail)
        return flat;
    picture_weights(s, triangle, p, weight);
    for (uint32_t i = 0; i < 3; i++) {
        const float *n = c->detail + PICTURE_DETAIL * picture_corner(c, triangle, i);
        sum = vec_add(sum, vec_scale(vec_of(n[0], n[1], n[2]), clamp(weight[i], 0, 1)));
    }
    sum = vec_unit(sum);
    if (vec_dot(sum, flat) < 0)
        sum = vec_scale(sum, -1);
    return vec_dot(sum, sum) > 0 ? sum : flat;
}

bool picture_uv(const picture_scene *s, uint32_t triangle, vec p, float uv[2])
{
    const picture_chunk *c = picture_chunk_of(s, triangle);
    float weight[3];
    uv[0] = uv[1] = 0;
    if (!c->detail)
        return false;
    picture_weights(s, triangle, p, weight);
    for (uint32_t i = 0; i < 3; i++) {
        const float *at = c->detail + PICTURE_DETAIL * picture_corner(c, triangle, i) + 3;
        uv[0] += at[0] * weight[i];
        uv[1] += at[1] * weight[i];
    }
    return true;
}

/* ---- tiles ----------------------------------------------------------------------------------- */

enum { CHUNKS_BETWEEN = 64 };  /* after so many, what lies behind all that was drawn is found */

static void set_tile(const picture_camera *c, uint32_t item, picture_tile *t)
{
    uint32_t across = (c->width + PICTURE_TILE - 1) / PICTURE_TILE;
    t->left = item % across * PICTURE_TILE;
    t->top = item / across * PICTURE_TILE;
    t->right = t->left + PICTURE_TILE < c->width ? t->left + PICTURE_TILE : c->width;
    t->bottom = t->top + PICTURE_TILE < c->height ? t->top + PICTURE_TILE : c->height;
    t->first_x = t->left ? t->left - PICTURE_RIM : 0;
    t->first_y = t->top ? t->top - PICTURE_RIM : 0;
    t->end_x = t->right + PICTURE_RIM < c->width ? t->right + PICTURE_RIM : c->width;
    t->end_y = t->bottom + PICTURE_RIM < c->height ? t->bottom + PICTURE_RIM : c->height;
    t->samples.left = t->first_x * PICTURE_GRID;
    t->samples.top = t->first_y * PICTURE_GRID;
    t->samples.width = (t->end_x - t->first_x) * PICTURE_GRID;
    t->samples.height = (t->end_y - t->first_y) * PICTURE_GRID;
}

static float find_floor(const picture_samples *t)
{
    float floor = t->nearness[0];
    for (size_t i = 1; i < (size_t)t->width * t->height && floor > 0; i++)
        floor = t->nearness[i] < floor ? t->nearness[i] : floor;
    return floor;
}

void picture_draw_tile(const picture_scene *s, const picture_camera *c, const picture_span *spans,
                       uint32_t item, picture_tile *t)
{
    picture_samples *to = &t->samples;
    set_tile(c, item, t);
    to->floor = 0;
    for (size_t i = 0; i < (size_t)to->width * to->height; i++) {
        to->nearness[i] = 0;
        to->triangle[i] = PICTURE_NOTHING;
    }
    for (uint32_t i = 0, drawn = 0; i < s->chunks.count; i++) {
        if (!picture_may_show(to, &spans[i]))
            continue;
        picture_draw_chunk(s, c, &c->projection, i, t->points, to);
        if (++drawn % CHUNKS_BETWEEN == 0) {
            to->floor = find_floor(to);
            if (result_cancelled(s->job->run))
                return;
        }
    }
}

/* The sample of the picture that is number i, k of the pixel. */
static size_t sample_of(const picture_tile *t, uint32_t x, uint32_t y, uint32_t i, uint32_t k)
{
    return (size_t)t->samples.width * ((y - t->first_y) * PICTURE_GRID + i) +
           (x - t->first_x) * PICTURE_GRID + k;
}

/* ---- fragments ------------------------------------------------------------------------------- */

/* Samples of one pixel that go together. */
typedef struct group {
    uint32_t triangle, count;
    float x, y;                  /* sums */
} group;

/* Two triangles of one flat face, say. */
static bool same_surface(const picture_scene *s, uint32_t a, uint32_t b)
{
    if (a == b)
        return true;
    if (a == PICTURE_NOTHING || b == PICTURE_NOTHING ||
        picture_material_of(s, a) != picture_material_of(s, b))
        return false;
    vec n = picture_flat_normal(s, a);
    if (!(vec_dot(n, picture_flat_normal(s, b)) > SAME_PLANE))
        return false;
    vec between = vec_subtract(picture_place(s, b, 0), picture_place(s, a, 0));
    float apart = sqrtf(vec_dot(between, between));
    return fabsf(vec_dot(between, n)) <= 1e-3f * apart + 1e-5f * s->radius;
}

/* The ground goes to where it cannot be told from the backdrop. */
static bool ground_place(const picture_scene *s, const picture_camera *c, vec origin, vec ray,
                         vec *place)
{
    float depth = (s->low.z - c->gap - origin.z) / ray.z;
    if (!(ray.z < 0) || !(depth > 0) || depth > GROUND_REACH * s->radius)
        return false;
    *place = vec_add(origin, vec_scale(ray, depth));
    return true;
}

/* Where the fragment's surface is, and how it lies. */
static bool place_fragment(const picture_scene *s, const picture_camera *c, picture_fragment *f)
{
    vec origin, ray = picture_ray(c, f->at_x, f->at_y, &origin);
    f->open = f->above = f->sun = 0;
    if (f->triangle == PICTURE_NOTHING) {
        f->flat = f->normal = vec_of(0, 0, 1);
        return ground_place(s, c, origin, ray, &f->place);
    }
    f->flat = picture_flat_normal(s, f->triangle);
    float depth = picture_meet(s, c, f->triangle, f->flat, origin, ray);
    f->place = vec_add(origin, vec_scale(ray, depth));
    if (vec_dot(f->flat, ray) > 0)
        f->flat = vec_scale(f->flat, -1);
    f->normal = shading_normal(s, f->triangle, f->place, f->flat);
    return true;
}

static void finish_group(const picture_scene *s, const picture_camera *c, uint32_t x, uint32_t y,
                         const group *g, picture_tile *t)
{
    picture_fragment *f = &t->fragments[t->fragment_count];
    *f = (picture_fragment){.x = x, .y = y, .triangle = g->triangle};
    f->share = (float)g->count / PICTURE_SAMPLES;
    f->at_x = g->x / (float)g->count;
    f->at_y = g->y / (float)g->count;
    t->fragment_count += place_fragment(s, c, f);
}

static void add_sample(const picture_scene *s, group *groups, uint32_t *count, uint32_t triangle,
                       float x, float y)
{
    uint32_t i = 0;
    while (i < *count && groups[i].triangle != triangle)
        i++;
    if (i == *count)
        for (i = 0; i < *count && !same_surface(s, groups[i].triangle, triangle);)
            i++;
    if (i == *count)
        groups[(*count)++] = (group){.triangle = triangle};
    groups[i].count++;
    groups[i].x += x;
    groups[i].y += y;
}

/* Most pixels show one triangle. */
static bool is_even(const picture_tile *t, uint32_t x, uint32_t y)
{
    const uint32_t *at = t->samples.triangle + sample_of(t, x, y, 0, 0);
    uint32_t width = t->samples.width;
    bool even = true;
    for (uint32_t i = 0; i < PICTURE_GRID; i++)
        for (uint32_t k = 0; k < PICTURE_GRID; k++)
            even = even && at[(size_t)width * i + k] == *at;
    return even;
}

static void find_in_pixel(const picture_scene *s, const picture_camera *c, uint32_t x, uint32_t y,
                          picture_tile *t)
{
    group groups[PICTURE_SAMPLES];
    uint32_t count = 0;
    if (is_even(t, x, y)) {
        const group whole = {t->samples.triangle[sample_of(t, x, y, 0, 0)], PICTURE_SAMPLES,
                             PICTURE_SAMPLES * ((float)x + 0.5f),
                             PICTURE_SAMPLES * ((float)y + 0.5f)};
        finish_group(s, c, x, y, &whole, t);
        return;
    }
    for (uint32_t i = 0; i < PICTURE_GRID; i++)
        for (uint32_t k = 0; k < PICTURE_GRID; k++) {
            uint32_t triangle = t->samples.triangle[sample_of(t, x, y, i, k)];
            float aside = ((float)k + 0.5f + picture_shift(i)) / PICTURE_GRID;
            add_sample(s, groups, &count, triangle, (float)x + aside,
                       (float)y + ((float)i + 0.5f) / PICTURE_GRID);
        }
    for (uint32_t i = 0; i < count; i++)
        finish_group(s, c, x, y, &groups[i], t);
}

void picture_find_fragments(const picture_scene *s, const picture_camera *c, picture_tile *t)
{
    t->fragment_count = 0;
    for (uint32_t y = t->top; y < t->bottom; y++)
        for (uint32_t x = t->left; x < t->right; x++)
            find_in_pixel(s, c, x, y, t);
}

bool picture_middle(const picture_scene *s, const picture_camera *c, const picture_tile *t,
                    uint32_t x, uint32_t y, picture_fragment *out)
{
    *out = (picture_fragment){.x = x, .y = y};
    out->triangle = t->samples.triangle[sample_of(t, x, y, 1, 1)];
    out->at_x = (float)x + 0.5f + picture_shift(1) / PICTURE_GRID;
    out->at_y = (float)y + 0.5f;
    return place_fragment(s, c, out);
}

/* Of the ground, what lies about the scene, where shadows fall. */
static bool about_scene(const picture_scene *s, vec p)
{
    float reach = 2 * (s->high.z - s->low.z) + 0.1f * s->radius;
    return p.x > s->low.x - reach && p.x < s->high.x + reach && p.y > s->low.y - reach &&
           p.y < s->high.y + reach;
}

void picture_see(const picture_scene *s, const picture_camera *c, picture_tile *t)
{
    for (uint32_t y = t->top; y < t->bottom; y++)
        for (uint32_t x = t->left; x < t->right; x++) {
            size_t at = sample_of(t, x, y, 1, 1);
            vec origin, ray = picture_ray(c, (float)x + 0.5f, (float)y + 0.5f, &origin), p;
            if (t->samples.triangle[at] != PICTURE_NOTHING) {
                float depth = picture_depth_of(c, t->samples.nearness[at]);
                p = vec_add(origin, vec_scale(ray, depth));
                p = vec_least(vec_most(p, s->low), s->high);
            } else if (!ground_place(s, c, origin, ray, &p) || !about_scene(s, p)) {
                continue;
            }
            t->low = vec_least(t->low, p);
            t->high = vec_most(t->high, p);
        }
}

/* ---- outlines -------------------------------------------------------------------------------- */

/* A sample and its neighbour. */
typedef struct neighbours {
    uint32_t a, b;               /* triangles */
    float near_a, near_b;
    float x_b, y_b;              /* pixels */
} neighbours;

/* Whether there is an outline between them; the nearer one shows it. Two planes that meet
 * without a step and at a flat angle have none. */
static bool is_edge(const picture_scene *s, const picture_camera *c, const neighbours *n)
{
    if (n->a >= s->ribbons || n->b >= s->ribbons) /* PICTURE_NOTHING is, too */
        return (n->a < s->ribbons && n->b == PICTURE_NOTHING) ||
               (n->b < s->ribbons && n->a == PICTURE_NOTHING);
    vec normal_a = picture_flat_normal(s, n->a), normal_b = picture_flat_normal(s, n->b);
    if (fabsf(vec_dot(normal_a, normal_b)) < CREASE)
        return true;
    vec origin, ray = picture_ray(c, n->x_b, n->y_b, &origin);
    float depth = picture_depth_of(c, n->near_b), slope = vec_dot(ray, normal_a);
    if (!(fabsf(slope) > 1e-6f))
        return false;
    vec to = vec_subtract(picture_place(s, n->a, 0), origin);
    float expected = vec_dot(to, normal_a) / slope;
    /* Along the normal, so that surfaces that are seen from the side have no more edges than
     * others. */
    float step = fabsf(expected - depth) * fabsf(slope);
    return step > STEP_PIXELS * picture_pixel(c, depth);
}

/* A sample that shows another triangle than all around it: what shines through the seam of two
 * faces that meet. */
static bool is_alone(const picture_samples *t, uint32_t x, uint32_t y)
{
    const uint32_t *at = t->triangle + (size_t)t->width * y + x;
    return !((x > 0 && at[-1] == *at) || (x + 1 < t->width && at[1] == *at) ||
             (y > 0 && *(at - t->width) == *at) || (y + 1 < t->height && at[t->width] == *at));
}

/* The pixel of the tile whose outline it would be; NULL: another tile's, or dark enough. */
static unsigned char *edge_pixel(const picture_camera *c, const picture_tile *t, uint32_t x,
                                 uint32_t y, unsigned char *edges)
{
    uint32_t column = t->first_x + x / PICTURE_GRID, row = t->first_y + y / PICTURE_GRID;
    if (column < t->left || column >= t->right || row < t->top || row >= t->bottom)
        return NULL;
    unsigned char *edge = edges + (size_t)c->width * row + column;
    return *edge < EDGE_MOST ? edge : NULL;
}

static void look_at(const picture_scene *s, const picture_camera *c, const picture_tile *tile,
                    uint32_t x, uint32_t y, uint32_t x_b, uint32_t y_b, unsigned char *edges)
{
    const picture_samples *t = &tile->samples;
    size_t at = (size_t)t->width * y + x, behind = (size_t)t->width * y_b + x_b;
    bool first = t->nearness[at] >= t->nearness[behind];
    unsigned char *edge = edge_pixel(c, tile, first ? x : x_b, first ? y : y_b, edges);
    if (!edge || is_alone(t, x, y) || is_alone(t, x_b, y_b))
        return;
    const neighbours n = {
        t->triangle[at], t->triangle[behind], t->nearness[at], t->nearness[behind],
        ((float)(t->left + x_b) + 0.5f + picture_shift(y_b)) / PICTURE_GRID,
        ((float)(t->top + y_b) + 0.5f) / PICTURE_GRID};
    *edge = (unsigned char)(*edge + is_edge(s, c, &n));
}

/* The rim takes part: an outline between two tiles is that of one of them. */
void picture_find_edges(const picture_scene *s, const picture_camera *c, const picture_tile *tile,
                        unsigned char *edges)
{
    const picture_samples *t = &tile->samples;
    for (uint32_t y = 0; y < t->height; y++) {
        const uint32_t *row = t->triangle + (size_t)t->width * y;
        for (uint32_t x = 0; x < t->width; x++) {
            if (x + 1 < t->width && row[x] != row[x + 1])
                look_at(s, c, tile, x, y, x + 1, y, edges);
            if (y + 1 < t->height && row[x] != row[x + t->width])
                look_at(s, c, tile, x, y, x, y + 1, edges);
        }
    }
}

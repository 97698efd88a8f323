/* picture_scene.c - everything that came out of a run as triangles with materials, in chunks.
 *
 * A face is cut to triangles in a batch that is used again for the next one; only what is drawn
 * is kept. Most faces are flat and have no texture: of them that is places and indices, 15 bytes
 * a corner. Each output's shapes are taken in an order of place, so that chunks are small in the
 * world.
 */
#include "stdlib/io/picture.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- materials ------------------------------------------------------------------------------- */

/* Each file is read once, also when it cannot be used. */
static const picture_texture *find_texture(picture_scene *s, const char *path)
{
    io_job *j = s->job;
    const picture_texture **known = table_get(&s->textures, path);
    if (!s->linear)
        s->linear = picture_linear_table(j);
    if (!known) {
        known = ARENA_NEW(&j->memory, const picture_texture *);
        *known = picture_texture_read(j, path, s->linear);
        table_put(&j->memory, &s->textures, path, known);
    }
    return *known;
}

static float fraction(double x)
{
    return x > 0 ? x < 1 ? (float)x : 1 : 0;
}

static uint32_t find_material(picture_scene *s, const pcg_material *look)
{
    arena *a = &s->job->memory;
    uint32_t number = io_pointer_number(a, &s->looks, look);
    if (number == s->materials.count) {
        picture_material m = {
            .color = {(float)color_linear(look->color.r), (float)color_linear(look->color.g),
                      (float)color_linear(look->color.b)},
            .alpha = fraction(look->color.a),
            .metallic = fraction(look->metallic),
            .roughness = fraction(look->roughness),
        };
        if (look->texture && *look->texture)
            m.texture = find_texture(s, look->texture);
        LIST_ADD(a, &s->materials, m);
    }
    return number;
}

/* ---- chunks ---------------------------------------------------------------------------------- */

/* A chunk while it is made. */
struct picture_filling {
    uint32_t vertex_count, triangle_count;
    bool detailed;               /* some face needs its normals, or uv */
    float place[3 * PICTURE_CHUNK_VERTICES];
    float detail[PICTURE_DETAIL * PICTURE_CHUNK_VERTICES];
    uint16_t index[3 * PICTURE_CHUNK];
    uint32_t material[PICTURE_CHUNK];
};

static void *copy_array(arena *a, const void *from, size_t size, size_t count)
{
    return memcpy(arena_alloc_array(a, size, count), from, size * count);
}

static void find_chunk_bounds(picture_chunk *c)
{
    c->low = vec_of(FLT_MAX, FLT_MAX, FLT_MAX);
    c->high = vec_scale(c->low, -1);
    for (uint32_t v = 0; v < c->vertex_count; v++) {
        const float *p = c->place + 3 * v;
        c->low = vec_least(c->low, vec_of(p[0], p[1], p[2]));
        c->high = vec_most(c->high, vec_of(p[0], p[1], p[2]));
    }
}

void picture_end_chunk(picture_scene *s)
{
    struct picture_filling *f = s->filling;
    arena *a = &s->job->memory;
    if (!f->triangle_count)
        return;
    if (s->chunks.count >= PICTURE_NOTHING >> PICTURE_CHUNK_BITS)
        longjmp(s->job->out_of_memory, 1);
    size_t vertices = f->vertex_count, triangles = f->triangle_count;
    picture_chunk c = {.vertex_count = (uint16_t)vertices, .triangle_count = (uint16_t)triangles};
    c.place = copy_array(a, f->place, 3 * sizeof(float), vertices);
    if (f->detailed)
        c.detail = copy_array(a, f->detail, PICTURE_DETAIL * sizeof(float), vertices);
    c.index = copy_array(a, f->index, 3 * sizeof *f->index, triangles);
    c.material = copy_array(a, f->material, sizeof *f->material, triangles);
    find_chunk_bounds(&c);
    LIST_ADD(a, &s->chunks, c);
    s->triangle_count += triangles;
    f->vertex_count = f->triangle_count = 0;
    f->detailed = false;
}

static void need_room(picture_scene *s, uint32_t vertices, uint32_t triangles)
{
    const struct picture_filling *f = s->filling;
    if (f->vertex_count + vertices > PICTURE_CHUNK_VERTICES ||
        f->triangle_count + triangles > PICTURE_CHUNK)
        picture_end_chunk(s);
}

static uint32_t put_vertex(struct picture_filling *f, const float *place, const float *detail)
{
    memcpy(f->place + 3 * f->vertex_count, place, 3 * sizeof(float));
    memcpy(f->detail + PICTURE_DETAIL * f->vertex_count, detail, PICTURE_DETAIL * sizeof(float));
    return f->vertex_count++;
}

/* A face that fits into a chunk shares its vertices; of a larger one each triangle has its own. */
static void put_face(picture_scene *s, const io_batch *b, uint32_t material, bool detailed)
{
    struct picture_filling *f = s->filling;
    uint32_t triangles = b->index_count / 3;
    bool whole = triangles <= PICTURE_CHUNK && b->vertex_count <= PICTURE_CHUNK_VERTICES;
    uint32_t step = whole ? triangles : 1;
    for (uint32_t from = 0; from < triangles; from += step) {
        need_room(s, whole ? b->vertex_count : 3, step);
        uint32_t first = f->vertex_count;
        for (uint32_t v = 0; whole && v < b->vertex_count; v++)
            put_vertex(f, b->vertices + IO_TEXTURED * v, b->vertices + IO_TEXTURED * v + 3);
        for (uint32_t i = 3 * from; i < 3 * (from + step); i++) {
            const float *v = b->vertices + (size_t)IO_TEXTURED * b->indices[i];
            uint32_t to = whole ? first + b->indices[i] : put_vertex(f, v, v + 3);
            f->index[3 * f->triangle_count + (i - 3 * from)] = (uint16_t)to;
        }
        for (uint32_t i = 0; i < step; i++)
            f->material[f->triangle_count + i] = material;
        f->triangle_count += step;
        f->detailed = f->detailed || detailed;
    }
}

void picture_add_triangle(picture_scene *s, const vec place[3], vec normal, uint32_t material)
{
    struct picture_filling *f = s->filling;
    const float detail[PICTURE_DETAIL] = {normal.x, normal.y, normal.z, 0, 0};
    need_room(s, 3, 1);
    for (uint32_t i = 0; i < 3; i++) {
        const float at[3] = {place[i].x, place[i].y, place[i].z};
        f->index[3 * f->triangle_count + i] = (uint16_t)put_vertex(f, at, detail);
    }
    f->material[f->triangle_count++] = material;
    f->detailed = true;
}

/* ---- gathering ------------------------------------------------------------------------------- */

static void gather_faces(picture_scene *s, io_tessellator *t, io_batch *b, const pcg_shape *shape)
{
    const pcg_mesh *m = shape->mesh;
    for (uint32_t f = 0; f < m->face_count; f++) {
        if (f % 4096 == 4095 && io_stopped(s->job))
            return;
        b->vertex_count = b->index_count = 0;
        if (!tessellate_face(t, f, b))
            continue;
        uint32_t material = find_material(s, io_material(shape, f));
        bool uv = m->corner_uv && s->materials.at[material].texture;
        put_face(s, b, material, uv || m->corner_normal);
    }
}

/* Room for the materials of so many lines or points. */
static uint32_t *need_materials(io_job *j, uint32_t *old, uint32_t *capacity, uint64_t wanted)
{
    if (wanted <= *capacity)
        return old;
    uint64_t room = wanted * 2;
    if (room > UINT32_MAX)
        longjmp(j->out_of_memory, 1);
    uint32_t *result = arena_resize(&j->memory, old, *capacity * sizeof *old,
                                    (size_t)room * sizeof *old);
    *capacity = (uint32_t)room;
    return result;
}

static void gather_loose(picture_scene *s, io_tessellator *t, const pcg_shape *shape)
{
    const uint32_t *loose;
    uint32_t count = tessellate_loose(t, &loose);
    if (!count && !shape->mesh->edge_count)
        return;
    uint32_t material = find_material(s, io_material(shape, UINT32_MAX));
    for (uint32_t e = 0; e < shape->mesh->edge_count; e++)
        tessellate_edge(t, e, &s->lines);
    for (uint32_t i = 0; i < count; i++)
        tessellate_point(t, loose[i], &s->points);
    uint32_t line = s->lines.index_count / 2, point = s->points.vertex_count;
    uint32_t old_line = s->line_count, old_point = s->point_count;
    s->line_material = need_materials(s->job, s->line_material, &s->line_capacity, line);
    s->point_material = need_materials(s->job, s->point_material, &s->point_capacity, point);
    for (; old_line < line; old_line++)
        s->line_material[old_line] = material;
    for (; old_point < point; old_point++)
        s->point_material[old_point] = material;
    s->line_count = line;
    s->point_count = point;
}

static void grow_bounds(picture_scene *s, const io_batch *b)
{
    for (uint32_t v = 0; v < b->vertex_count; v++) {
        const float *p = b->vertices + (size_t)b->stride * v;
        s->low = vec_least(s->low, vec_of(p[0], p[1], p[2]));
        s->high = vec_most(s->high, vec_of(p[0], p[1], p[2]));
    }
}

/* A scene without extent is framed as if it were of some size. */
static void find_bounds(picture_scene *s)
{
    s->low = vec_of(FLT_MAX, FLT_MAX, FLT_MAX);
    s->high = vec_scale(s->low, -1);
    for (uint32_t i = 0; i < s->chunks.count; i++) {
        s->low = vec_least(s->low, s->chunks.at[i].low);
        s->high = vec_most(s->high, s->chunks.at[i].high);
    }
    grow_bounds(s, &s->lines);
    grow_bounds(s, &s->points);
    s->empty = s->low.x > s->high.x;
    if (s->empty) {
        s->low = vec_of(0, 0, 0);
        s->high = vec_of(1, 1, 1);
    }
    vec size = vec_subtract(s->high, s->low);
    s->radius = sqrtf(vec_dot(size, size)) / 2;
    if (!(s->radius > 1e-6f))
        s->radius = 0.5f;
}

/* ---- shapes by place ------------------------------------------------------------------------- */

/* A shape, and where it stands on a curve that visits each quarter of the ground in turn. */
typedef struct placed {
    uint32_t code, index;
} placed;

/* The 16 bits of x, with a zero in front of each. */
static uint32_t spread(uint32_t x)
{
    x = (x | x << 8) & 0x00FF00FFu;
    x = (x | x << 4) & 0x0F0F0F0Fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

static uint32_t cell_of(double at, double low, double high)
{
    double share = high > low ? (at - low) / (high - low) : 0;
    return share > 0 ? (uint32_t)(65535 * (share < 1 ? share : 1)) : 0; /* what is no number: 0 */
}

static int compare_placed(const void *a, const void *b)
{
    const placed *x = a, *y = b;
    if (x->code != y->code)
        return x->code < y->code ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

static pcg_vec3 middle_of(const pcg_entity *e)
{
    const pcg_shape *shape = io_shape(e);
    return shape ? pcg_scope_point(&shape->scope, vec3_scale(shape->scope.size, 0.5))
                 : vec3(0, 0, 0);
}

/* The shapes of an output in an order in which neighbours follow each other, so that a chunk is a
 * small place, whatever order they came out in. */
static const placed *sort_by_place(const picture_scene *s, const pcg_entities *list)
{
    placed *order = ARENA_ARRAY(&s->job->memory, placed, list->count);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < list->count; i++) {
        pcg_vec3 p = middle_of(list->at[i]);
        low[0] = fmin(low[0], p.x), high[0] = fmax(high[0], p.x);
        low[1] = fmin(low[1], p.y), high[1] = fmax(high[1], p.y);
    }
    for (uint32_t i = 0; i < list->count; i++) {
        pcg_vec3 p = middle_of(list->at[i]);
        uint32_t x = cell_of(p.x, low[0], high[0]), y = cell_of(p.y, low[1], high[1]);
        order[i] = (placed){spread(x) | spread(y) << 1, i};
    }
    qsort(order, list->count, sizeof *order, compare_placed);
    return order;
}

static void gather_output(picture_scene *s, io_tessellator *t, io_batch *b, uint32_t output)
{
    const pcg_entities *list = result_entities(s->job->run, output);
    const placed *order = sort_by_place(s, list);
    for (uint32_t i = 0; i < list->count; i++) {
        const pcg_shape *shape = io_shape(list->at[order[i].index]);
        if (i % 256 == 0 && io_stopped(s->job))
            return;
        if (!shape)
            continue;
        tessellate_begin(t, shape);
        gather_faces(s, t, b, shape);
        gather_loose(s, t, shape);
    }
}

void picture_gather(picture_scene *s, io_job *j, pcg_vec3 center)
{
    io_tessellator t = {.job = j, .center = center};
    io_batch batch = {.stride = IO_TEXTURED};
    *s = (picture_scene){.job = j, .day = picture_daylight(), .center = center};
    s->filling = ARENA_NEW(&j->memory, struct picture_filling);
    s->lines.stride = s->points.stride = IO_BARE;
    for (uint32_t o = 0; o < j->module->output_count && !io_stopped(j); o++)
        gather_output(s, &t, &batch, o);
    picture_end_chunk(s);
    tessellate_end(&t);
    s->solids = s->chunks.count;
    s->ribbons = s->solids << PICTURE_CHUNK_BITS;
    find_bounds(s);
}

/* ---- lines and points ------------------------------------------------------------------------ */

/* The quadrilateral a ± side, b ± end as two triangles. Lines and points take light as if they
 * faced half up and half the eye. */
static void put_ribbon(picture_scene *s, vec a, vec side, vec b, vec end, vec normal,
                       uint32_t material)
{
    const vec first[3] = {vec_subtract(a, side), vec_subtract(b, end), vec_add(b, end)};
    const vec second[3] = {vec_subtract(a, side), vec_add(b, end), vec_add(a, side)};
    picture_add_triangle(s, first, normal, material);
    picture_add_triangle(s, second, normal, material);
}

static vec bare_vertex(const io_batch *b, uint32_t i)
{
    return vec_of(b->vertices[3 * (size_t)i], b->vertices[3 * (size_t)i + 1],
                  b->vertices[3 * (size_t)i + 2]);
}

static float pixel_size(const picture_camera *c, vec p)
{
    return picture_pixel(c, picture_depth(c, p));
}

/* Nearer to the eye by as much as a line is wide: so it is seen on the surface that it lies on. */
static vec lift(const picture_camera *c, vec p)
{
    return vec_add(p, vec_scale(picture_view(c, p), pixel_size(c, p)));
}

void picture_ribbons(picture_scene *s, const picture_camera *c)
{
    for (uint32_t i = 0; i + 1 < s->lines.vertex_count; i += 2) {
        vec a = lift(c, bare_vertex(&s->lines, i)), b = lift(c, bare_vertex(&s->lines, i + 1));
        vec view = picture_view(c, a), side = vec_unit(vec_cross(vec_subtract(b, a), view));
        put_ribbon(s, a, vec_scale(side, 0.75f * pixel_size(c, a)), b,
                   vec_scale(side, 0.75f * pixel_size(c, b)),
                   vec_unit(vec_add(view, vec_of(0, 0, 1))), s->line_material[i / 2]);
    }
    for (uint32_t i = 0; i < s->points.vertex_count; i++) {
        vec p = lift(c, bare_vertex(&s->points, i)), view = picture_view(c, p);
        float half = 2 * pixel_size(c, p);
        vec up = vec_scale(c->up, half), side = vec_scale(c->right, half);
        put_ribbon(s, vec_subtract(p, up), side, vec_add(p, up), side,
                   vec_unit(vec_add(view, vec_of(0, 0, 1))), s->point_material[i]);
    }
    picture_end_chunk(s);
}

/* view.c - results as flat arrays, of one shape or of all that left an output: made when first
 * asked for, kept with the run. */
#include <string.h>

#include "run.h"
#include "shape.h"

/* The materials of all results, numbered in order of first use: open addressing by pointer. */
typedef struct material_table {
    const pcg_material **list;
    struct material_slot { const pcg_material *material; uint32_t number; } *slots;
    uint32_t count, capacity; /* of the slots; the list has room for half as many */
    bool complete;
} material_table;

struct run_views {
    pcg_triangulator *triangulator;
    pcg_mesh_view ***of;   /* by output and entity; NULL while not asked for */
    pcg_mesh_view **whole; /* by output */
    material_table materials;
};

enum { MATERIALS_FIRST = 64 };

/* NULL where memory has run out. */
static struct run_views *views_of(pcg_run *r)
{
    if (!r->views)
        r->views = run_alloc_zeroed(r, sizeof *r->views);
    return r->views;
}

void views_close(pcg_run *r)
{
    if (r->views && r->views->triangulator)
        pcg_triangulator_free(r->views->triangulator);
    r->views = NULL;
}

/* ---- materials ------------------------------------------------------------------------------ */

static struct material_slot *slot_of(const material_table *t, const pcg_material *m)
{
    uint32_t mask = t->capacity - 1;
    for (uint32_t i = (uint32_t)pcg_mix((uintptr_t)m, 0) & mask;; i = (i + 1) & mask)
        if (!t->slots[i].material || t->slots[i].material == m)
            return &t->slots[i];
}

static bool materials_grow(pcg_run *r, material_table *t)
{
    material_table next = {.capacity = t->capacity ? t->capacity * 2 : MATERIALS_FIRST,
                           .count = t->count};
    next.slots = run_alloc_array(r, next.capacity, sizeof *next.slots);
    next.list = run_alloc_array(r, next.capacity / 2, sizeof *next.list);
    if (!next.slots || !next.list)
        return false;
    for (uint32_t i = 0; i < t->count; i++) {
        *slot_of(&next, t->list[i]) = (struct material_slot){t->list[i], i};
        next.list[i] = t->list[i];
    }
    run_free(r, t->slots, t->capacity * sizeof *t->slots);
    run_free(r, t->list, t->capacity / 2 * sizeof *t->list);
    *t = next;
    return true;
}

/* The material's number, which it is given now where it has none; UINT32_MAX where memory has run
 * out. */
static uint32_t material_number(pcg_run *r, material_table *t, const pcg_material *m)
{
    if (t->count >= t->capacity / 2 && !materials_grow(r, t))
        return UINT32_MAX;
    struct material_slot *slot = slot_of(t, m);
    if (!slot->material) {
        *slot = (struct material_slot){m, t->count};
        t->list[t->count++] = m;
    }
    return slot->number;
}

static bool number_materials_of(pcg_run *r, material_table *t, const pcg_shape *s)
{
    uint32_t faces = s->mesh->face_count;
    if (faces && !s->mesh->face_material)
        faces = 1; /* all have the shape's */
    for (uint32_t f = 0; f < faces; f++)
        if (material_number(r, t, pcg_shape_face_material(s, f)) == UINT32_MAX)
            return false;
    return true;
}

/* Numbers the materials of all results, once; NULL where memory has run out. */
static material_table *materials_of(pcg_run *r)
{
    struct run_views *views = views_of(r);
    if (!views || views->materials.complete)
        return views ? &views->materials : NULL;
    for (uint32_t i = 0; i < r->module->output_count; i++) {
        const pcg_entities *all = run_output(r, i);
        for (uint32_t k = 0; k < all->count; k++)
            if (pcg_entity_is(all->at[k], &pcg_type_shape) &&
                !number_materials_of(r, &views->materials, (const pcg_shape *)all->at[k]))
                return NULL;
    }
    views->materials.complete = true;
    return &views->materials;
}

size_t pcg_run_material_count(const pcg_run *r)
{
    /* Counting makes the table, which is no change that the host could see. */
    const material_table *t = materials_of((pcg_run *)(uintptr_t)r);
    return t ? t->count : 0;
}

pcg_status pcg_run_material(const pcg_run *r, uint32_t material, pcg_material_view *out)
{
    const material_table *t = materials_of((pcg_run *)(uintptr_t)r);
    if (!t)
        return (pcg_status)r->status;
    if (material >= t->count)
        return PCG_STATUS_MISUSE;
    const pcg_material *m = t->list[material];
    const pcg_material_view made = {.size = out->size,
                                    .name = m->name ? m->name : "",
                                    .color = {m->color.r, m->color.g, m->color.b, m->color.a},
                                    .texture = m->texture,
                                    .metallic = m->metallic,
                                    .roughness = m->roughness,
                                    .two_sided = m->two_sided};
    memcpy(out, &made, out->size < sizeof made ? out->size : sizeof made);
    return PCG_STATUS_OK;
}

/* ---- geometry ------------------------------------------------------------------------------- */

/* The arrays of a view while they are filled; its counts are how far that has come. */
typedef struct filling {
    pcg_run *run;
    pcg_mesh_view *view;
    material_table *materials;
    pcg_triangulator *triangulator;
    double *points;
    float *normals, *uvs;
    uint32_t *face_loops, *loop_corners, *corner_points, *triangles, *triangle_faces,
        *face_materials, *face_entities, *edges;
} filling;

static const pcg_shape *shape_of(const pcg_entity *e)
{
    return pcg_entity_is(e, &pcg_type_shape) ? (const pcg_shape *)e : NULL;
}

/* Adds up what the shapes have; whether one has uvs. */
static bool count_shapes(pcg_mesh_view *v, const pcg_entities *all)
{
    bool uvs = false;
    for (uint32_t i = 0; i < all->count; i++) {
        const pcg_shape *s = shape_of(all->at[i]);
        const pcg_mesh *m = s ? s->mesh : &pcg_mesh_empty;
        v->point_count += m->vertex_count;
        v->face_count += m->face_count;
        v->loop_count += m->loop_count;
        v->corner_count += m->corner_count;
        v->edge_count += m->edge_count;
        uvs = uvs || m->corner_uv;
    }
    return uvs;
}

/* At most so many triangles have the faces that were counted. */
static size_t most_triangles(const pcg_mesh_view *v)
{
    return v->corner_count + 2 * v->loop_count;
}

static bool find_room(filling *f, bool uvs, bool whole)
{
    pcg_run *r = f->run;
    const pcg_mesh_view *v = f->view;
    size_t triangles = most_triangles(v);
    f->points = run_alloc_array(r, v->point_count, 3 * sizeof *f->points);
    f->face_loops = run_alloc_array(r, v->face_count + 1, sizeof *f->face_loops);
    f->loop_corners = run_alloc_array(r, v->loop_count + 1, sizeof *f->loop_corners);
    f->corner_points = run_alloc_array(r, v->corner_count, sizeof *f->corner_points);
    f->normals = run_alloc_array(r, v->corner_count, 3 * sizeof *f->normals);
    f->uvs = uvs ? run_alloc_array(r, v->corner_count, 2 * sizeof *f->uvs) : NULL;
    f->triangles = run_alloc_array(r, triangles, 3 * sizeof *f->triangles);
    f->triangle_faces = run_alloc_array(r, triangles, sizeof *f->triangle_faces);
    f->face_materials = run_alloc_array(r, v->face_count, sizeof *f->face_materials);
    f->face_entities = whole ? run_alloc_array(r, v->face_count, sizeof *f->face_entities) : NULL;
    f->edges = run_alloc_array(r, v->edge_count, 2 * sizeof *f->edges);
    if (!r->views->triangulator)
        r->views->triangulator = pcg_triangulator_new();
    if (!r->views->triangulator)
        run_out_of_memory(r, triangles);
    f->triangulator = r->views->triangulator;
    return r->status == PCG_OK;
}

static void hand_over(const filling *f)
{
    pcg_mesh_view *v = f->view;
    v->points = f->points;
    v->face_loops = f->face_loops;
    v->loop_corners = f->loop_corners;
    v->corner_points = f->corner_points;
    v->normals = f->normals;
    v->uvs = f->uvs;
    v->triangles = f->triangles;
    v->triangle_faces = f->triangle_faces;
    v->face_materials = f->face_materials;
    v->face_entities = f->face_entities;
    v->edges = f->edges;
}

/* ---- geometry of one shape ------------------------------------------------------------------ */

static void fill_points(filling *f, const pcg_shape *s)
{
    double *to = f->points + 3 * f->view->point_count;
    for (uint32_t i = 0; i < s->mesh->vertex_count; i++) {
        pcg_vec3 p = pcg_shape_world(s, i);
        memcpy(to + 3 * (size_t)i, &p, sizeof p);
    }
}

/* Copies numbers that count from the first of something, which has moved by `first`. */
static void fill_numbers(uint32_t *to, const uint32_t *from, size_t count, size_t first)
{
    for (size_t i = 0; i < count; i++)
        to[i] = from[i] + (uint32_t)first;
}

/* The ends of faces and loops are written behind the 0 that each list begins with. */
static void fill_faces(filling *f, const pcg_mesh *m)
{
    const pcg_mesh_view *v = f->view;
    if (m->face_count)
        fill_numbers(f->face_loops + v->face_count + 1, m->face_loop + 1, m->face_count,
                     v->loop_count);
    if (m->loop_count)
        fill_numbers(f->loop_corners + v->loop_count + 1, m->loop_corner + 1, m->loop_count,
                     v->corner_count);
    fill_numbers(f->corner_points + v->corner_count, m->corner_vertex, m->corner_count,
                 v->point_count);
    fill_numbers(f->edges + 2 * v->edge_count, m->edge_vertex, 2 * (size_t)m->edge_count,
                 v->point_count);
}

static bool is_zero(const float *n)
{
    return !(n[0] < 0 || n[0] > 0 || n[1] < 0 || n[1] > 0 || n[2] < 0 || n[2] > 0);
}

static void put_normal(float *to, const pcg_shape *s, pcg_vec3 local)
{
    pcg_vec3 world = vec3_normal(pcg_scope_direction(&s->scope, local));
    to[0] = (float)world.x;
    to[1] = (float)world.y;
    to[2] = (float)world.z;
}

static void fill_normals(filling *f, const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    float *to = f->normals + 3 * f->view->corner_count;
    for (uint32_t k = 0; k < m->face_count; k++) {
        pcg_vec3 flat = pcg_shape_face_normal(s, k);
        for (uint32_t c = m->loop_corner[m->face_loop[k]]; c < m->loop_corner[m->face_loop[k + 1]];
             c++) {
            const float *own = m->corner_normal ? m->corner_normal + 3 * (size_t)c : NULL;
            put_normal(to + 3 * (size_t)c, s,
                       own && !is_zero(own) ? vec3(own[0], own[1], own[2]) : flat);
        }
    }
}

static void fill_uvs(filling *f, const pcg_mesh *m)
{
    float *to = f->uvs ? f->uvs + 2 * f->view->corner_count : NULL;
    size_t size = 2 * (size_t)m->corner_count * sizeof *to;
    if (to && m->corner_uv)
        memcpy(to, m->corner_uv, size);
    else if (to)
        memset(to, 0, size);
}

static void fill_triangles(filling *f, const pcg_shape *s)
{
    pcg_mesh_view *v = f->view;
    const pcg_mesh *m = s->mesh;
    for (uint32_t k = 0; k < m->face_count; k++) {
        uint32_t *at = f->triangles + 3 * v->triangle_count;
        uint32_t count =
            pcg_triangulate(f->triangulator, m, k, m->unit ? &s->scope.size : NULL, at);
        for (uint32_t i = 0; i < 3 * count; i++)
            at[i] += (uint32_t)v->corner_count;
        for (uint32_t i = 0; i < count; i++)
            f->triangle_faces[v->triangle_count++] = (uint32_t)v->face_count + k;
    }
}

static void fill_shape(filling *f, const pcg_shape *s, uint32_t entity)
{
    pcg_mesh_view *v = f->view;
    const pcg_mesh *m = s->mesh;
    fill_points(f, s);
    fill_faces(f, m);
    fill_normals(f, s);
    fill_uvs(f, m);
    fill_triangles(f, s);
    for (uint32_t k = 0; k < m->face_count; k++) {
        f->face_materials[v->face_count + k] =
            material_number(f->run, f->materials, pcg_shape_face_material(s, k));
        if (f->face_entities)
            f->face_entities[v->face_count + k] = entity;
    }
    v->point_count += m->vertex_count;
    v->face_count += m->face_count;
    v->loop_count += m->loop_count;
    v->corner_count += m->corner_count;
    v->edge_count += m->edge_count;
}

/* ---- views ---------------------------------------------------------------------------------- */

/* Of all shapes among the entities; NULL where memory has run out, or the numbers are too large. */
static pcg_mesh_view *make_view(pcg_run *r, const pcg_entities *all, bool whole)
{
    static const pcg_mesh_view nothing = {.size = sizeof nothing};
    filling f = {.run = r, .view = run_alloc_zeroed(r, sizeof *f.view)};
    f.materials = f.view ? materials_of(r) : NULL;
    if (!f.materials)
        return NULL;
    bool uvs = count_shapes(f.view, all);
    if (f.view->point_count > UINT32_MAX / 2 || most_triangles(f.view) > UINT32_MAX / 2) {
        run_out_of_memory(r, most_triangles(f.view));
        return NULL;
    }
    if (!find_room(&f, uvs, whole))
        return NULL;
    *f.view = nothing;
    f.face_loops[0] = f.loop_corners[0] = 0;
    for (uint32_t i = 0; i < all->count; i++)
        if (shape_of(all->at[i]))
            fill_shape(&f, shape_of(all->at[i]), i);
    hand_over(&f);
    return f.view;
}

/* Copies as much of it as the host has room for. */
static pcg_status give_view(const pcg_run *r, const pcg_mesh_view *made, pcg_mesh_view *out)
{
    size_t size = out->size;
    if (!made)
        return (pcg_status)r->status;
    memcpy(out, made, size < sizeof *out ? size : sizeof *out);
    out->size = size;
    return PCG_STATUS_OK;
}

/* Where the view of an entity is kept; NULL where memory has run out. */
static pcg_mesh_view **place_of(pcg_run *r, size_t output, size_t entity)
{
    struct run_views *views = views_of(r);
    if (!views)
        return NULL;
    if (!views->of)
        views->of = run_alloc_array(r, r->module->output_count, sizeof *views->of);
    if (views->of && !views->of[output])
        views->of[output] = run_alloc_array(r, run_output(r, output)->count, sizeof **views->of);
    return views->of && views->of[output] ? &views->of[output][entity] : NULL;
}

pcg_status pcg_run_mesh(pcg_run *r, size_t output, size_t entity, pcg_mesh_view *out)
{
    const pcg_entities *all = run_output(r, output);
    if (entity >= all->count)
        return run_misuse(r, "output %zu has no entity %zu", output, entity);
    if (!shape_of(all->at[entity]))
        return run_misuse(r, "entity %zu of output %zu is of type %s, which has no mesh", entity,
                          output, all->at[entity]->type->name);
    const pcg_entities one = {&all->at[entity], 1};
    pcg_mesh_view **place = place_of(r, output, entity);
    if (place && !*place)
        *place = make_view(r, &one, false);
    return give_view(r, place ? *place : NULL, out);
}

pcg_status pcg_run_output_mesh(pcg_run *r, size_t output, pcg_mesh_view *out)
{
    if (r->stage != RUN_EXECUTED)
        return run_misuse(r, "the run has not been executed");
    if (output >= r->module->output_count)
        return run_misuse(r, "graph '%s' has no output %zu", r->module->name, output);
    struct run_views *views = views_of(r);
    if (views && !views->whole)
        views->whole = run_alloc_array(r, r->module->output_count, sizeof *views->whole);
    if (!views || !views->whole)
        return (pcg_status)r->status;
    if (!views->whole[output])
        views->whole[output] = make_view(r, run_output(r, output), true);
    return give_view(r, views->whole[output], out);
}

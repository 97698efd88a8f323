/* spatial.c - measuring what has a place: shapes, and their parts. */
#include "spatial.h"

#include "geometry.h"
#include "runtime/mesh.h"

static const pcg_shape *as_shape(const pcg_entity *e)
{
    return pcg_entity_is(e, &pcg_type_shape) ? (const pcg_shape *)e : NULL;
}

/* NULL, and a warning, where it is of no shape any more. */
static const pcg_part *as_part(pcg_call *call, const pcg_entity *e)
{
    const pcg_part *p = (const pcg_part *)e;

    if (!part_is(e))
        return NULL;
    if (part_shape(p) != NULL)
        return p;
    (void)part_warn_lost(call, p); /* under --strict the run knows */
    return NULL;
}

/* ---- places ---------------------------------------------------------------------------------- */

static pcg_vec3 place_world(const pcg_part *p, uint32_t i)
{
    return pcg_shape_world(p->shape, part_place_vertex(p->shape, part_place(p, i)));
}

pcg_vec3 spatial_centre(pcg_call *call, const pcg_entity *e)
{
    const pcg_shape *s = as_shape(e);
    const pcg_part *p = s == NULL ? as_part(call, e) : NULL;

    if (s != NULL)
        return geometry_centre(s);
    if (p == NULL)
        return vec3(0, 0, 0);
    if (p->kind == PART_FACE)
        return geometry_face_centre(p->shape, p->index);
    return vec3_scale(vec3_add(place_world(p, 0), place_world(p, part_place_count(p) - 1)), 0.5);
}

static void part_bounds(const pcg_part *p, pcg_vec3 *low, pcg_vec3 *high)
{
    uint32_t count = part_place_count(p);

    if (count > 0)
        *low = *high = place_world(p, 0);
    for (uint32_t i = 1; i < count; i++)
        bounds_add(low, high, place_world(p, i));
}

void spatial_bounds(pcg_call *call, const pcg_entity *e, pcg_vec3 *low, pcg_vec3 *high)
{
    const pcg_shape *s = as_shape(e);
    const pcg_part *p = s == NULL ? as_part(call, e) : NULL;

    *low = *high = vec3(0, 0, 0);
    if (p != NULL)
        part_bounds(p, low, high);
    else if (s != NULL && !pcg_shape_bounds(s, low, high))
        *low = *high = vec3(0, 0, 0);
}

/* ---- faces ----------------------------------------------------------------------------------- */

pcg_vec3 faced_normal(pcg_call *call, const pcg_entity *e)
{
    const pcg_shape *s = as_shape(e);
    const pcg_part *p = s == NULL ? as_part(call, e) : NULL;

    if (s != NULL)
        return geometry_normal(s);
    if (p == NULL || p->kind != PART_FACE)
        return vec3(0, 0, 0);
    return pcg_scope_direction(&p->shape->scope,
                               vec3_normal(pcg_shape_face_normal(p->shape, p->index)));
}

double faced_area(pcg_call *call, const pcg_entity *e)
{
    const pcg_shape *s = as_shape(e);
    const pcg_part *p = s == NULL ? as_part(call, e) : NULL;

    if (s != NULL)
        return pcg_shape_area(s);
    if (p == NULL || p->kind != PART_FACE)
        return 0;
    return vec3_length(pcg_shape_face_normal(p->shape, p->index)) / 2;
}

static double loops_length(const pcg_shape *s, uint32_t from, uint32_t to)
{
    double sum = 0;

    for (uint32_t l = from; l < to; l++) {
        uint32_t first = s->mesh->loop_corner[l], end = s->mesh->loop_corner[l + 1];

        for (uint32_t c = first; c < end; c++)
            sum += vec3_length(
                vec3_subtract(shape_corner(s, c + 1 < end ? c + 1 : first), shape_corner(s, c)));
    }
    return sum;
}

double faced_perimeter(pcg_call *call, const pcg_entity *e)
{
    const pcg_shape *s = as_shape(e);
    const pcg_part *p = s == NULL ? as_part(call, e) : NULL;

    if (s != NULL)
        return loops_length(s, 0, s->mesh->loop_count);
    if (p == NULL || p->kind != PART_FACE)
        return 0;
    return loops_length(p->shape, p->shape->mesh->face_loop[p->index],
                        p->shape->mesh->face_loop[p->index + 1]);
}

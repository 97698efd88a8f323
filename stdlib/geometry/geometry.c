/* geometry.c - what the kernels of this library share. */
#include "geometry.h"

#include <math.h>
#include <string.h>

#include "runtime/mesh.h"
#include "runtime/real.h"
#include "runtime/value.h"

bool geometry_is_length(double length)
{
    return fabs(length) <= GEOMETRY_MAX_LENGTH; /* false for what is no number */
}

bool geometry_is_size(double size)
{
    return size > 0 && size <= GEOMETRY_MAX_LENGTH;
}

int geometry_emit(pcg_call *call, const pcg_port *port, pcg_shape *s)
{
    return s != NULL ? pcg_emit(call, port, &s->entity) : PCG_FAILED;
}

double geometry_component(pcg_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

bool geometry_is_upright(const pcg_scope *s)
{
    const pcg_vec3 *n = &s->axis[2];

    return n->x * n->x + n->y * n->y <= 1e-8 || (fabs(s->axis[0].z) <= 1e-12 && s->axis[1].z > 0);
}

int geometry_add_quad(pcg_run *r, pcg_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t quad[4] = {a, b, c, d};

    return pcg_mesh_add_face(r, m, quad, 4) != UINT32_MAX ? PCG_OK : PCG_FAILED;
}

/* ---- centres and directions ------------------------------------------------------------------ */

static pcg_vec3 mean_of_vertices(const pcg_shape *s)
{
    pcg_vec3 sum = vec3(0, 0, 0);
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        sum = vec3_add(sum, shape_point(s, v));
    return s->mesh->vertex_count ? vec3_scale(sum, 1.0 / s->mesh->vertex_count) : sum;
}

/* Adds a loop's fan of triangles, weighted by their area along the face's normal, so that
 * concave corners and holes (which turn the other way) count negatively. Returns the weight. */
static double add_loop(const pcg_shape *s, uint32_t loop, pcg_vec3 unit_normal, pcg_vec3 *sum)
{
    uint32_t first = s->mesh->loop_corner[loop], end = s->mesh->loop_corner[loop + 1];
    double weights = 0;
    for (uint32_t c = first + 1; c + 1 < end; c++) {
        pcg_vec3 a = shape_corner(s, first), b = shape_corner(s, c), d = shape_corner(s, c + 1);
        double weight = vec3_dot(vec3_cross(vec3_subtract(b, a), vec3_subtract(d, a)), unit_normal);
        *sum = vec3_add(*sum, vec3_scale(vec3_add(vec3_add(a, b), d), weight / 3));
        weights += weight;
    }
    return weights;
}

/* The same of all loops of a face. */
static double add_face(const pcg_shape *s, uint32_t face, pcg_vec3 *sum)
{
    pcg_vec3 unit_normal = vec3_normal(pcg_shape_face_normal(s, face));
    double weights = 0;

    for (uint32_t l = s->mesh->face_loop[face]; l < s->mesh->face_loop[face + 1]; l++)
        weights += add_loop(s, l, unit_normal, sum);
    return weights;
}

pcg_vec3 geometry_centre(const pcg_shape *s)
{
    pcg_vec3 sum = vec3(0, 0, 0);
    double weights = 0;

    for (uint32_t f = 0; f < s->mesh->face_count; f++)
        weights += add_face(s, f, &sum);
    return pcg_scope_point(&s->scope,
                           weights > 0 ? vec3_scale(sum, 1 / weights) : mean_of_vertices(s));
}

pcg_vec3 geometry_face_centre(const pcg_shape *s, uint32_t face)
{
    uint32_t first = face_first_corner(s->mesh, face), end = face_last_corner(s->mesh, face);
    pcg_vec3 sum = vec3(0, 0, 0);
    double weights = add_face(s, face, &sum);

    if (weights > 0)
        return pcg_scope_point(&s->scope, vec3_scale(sum, 1 / weights));
    sum = vec3(0, 0, 0);
    for (uint32_t c = first; c < end; c++)
        sum = vec3_add(sum, vec3_scale(shape_corner(s, c), 1.0 / (end - first)));
    return pcg_scope_point(&s->scope, sum);
}

pcg_vec3 geometry_normal(const pcg_shape *s)
{
    pcg_vec3 sum = vec3(0, 0, 0);

    for (uint32_t f = 0; f < s->mesh->face_count; f++)
        sum = vec3_add(sum, pcg_shape_face_normal(s, f));
    return pcg_scope_direction(&s->scope, vec3_normal(sum));
}

double geometry_angle(pcg_vec3 a, pcg_vec3 b)
{
    pcg_vec3 across = vec3_cross(a, b);

    return real_atan2(vec3_length(across), vec3_dot(a, b));
}

/* ---- attributes ------------------------------------------------------------------------------ */

bool geometry_same_value(const pcg_slot *key, const pcg_entity *a, const pcg_entity *b)
{
    const pcg_cell *p = pcg_get(a, key), *q = pcg_get(b, key);

    if (key->kind == PCG_STRING || key->kind == PCG_PATH)
        return strcmp(p->s, q->s) == 0;
    return memcmp(p, q, value_width(key->kind) * sizeof *p) == 0;
}

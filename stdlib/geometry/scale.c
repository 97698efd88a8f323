/*pcg
/// Scales a shape, or a part of one, along the axes of its scope.
///
/// A factor of 0 flattens it, a negative one mirrors it: faces are turned round so that they still
/// face outward. With `absolute`, x, y and z are the new size in metres; an axis along which the
/// shape is flat stays so. Of a part, the corners move and nothing is turned round; a vertex moves
/// only about the world's origin.
procedure scale<T: Spatial>(in: T) -> (out: T) [pure] {
    category "place"
    synonyms "resize", "size", "stretch", "mirror", "s"
    param x: float = 1 /// Factor along x.
    param y: float = 1 /// Along y.
    param z: float = 1 /// Along z.
    param absolute: bool = false    /// x, y and z are sizes in metres instead of factors.
    /// What stays in place: the scope's origin or its centre, or the world's origin.
    param about: Pivot = origin
    example rectangle(width = 2m, height = 3m) -> scale(x = 2, y = 3) expect faces = 1, area = 36
    example box(width = 1m, depth = 1m, height = 1m)
        -> scale(x = 4, y = 5, z = 6, absolute = true) expect volume = 120
    example box(width = 1m, depth = 2m, height = 3m) -> scale(x = -1) expect volume = 6
}
*/
#include <math.h>

#include "stdlib/geometry/placing.h"
#include "scale.h"

static void reverse(uint32_t *from, uint32_t count)
{
    for (uint32_t i = 0, j = count; j > i + 1; i++) {
        uint32_t kept = from[i];
        from[i] = from[--j];
        from[j] = kept;
    }
}

static void reverse_stream(float *stream, uint32_t width, uint32_t count)
{
    for (uint32_t i = 0, j = count; j > i + 1; i++) {
        j--;
        for (uint32_t k = 0; k < width; k++) {
            float kept = stream[i * width + k];
            stream[i * width + k] = stream[j * width + k];
            stream[j * width + k] = kept;
        }
    }
}

/* Turns every face round, with what its corners carry. */
static void reverse_faces(pcg_mesh *m)
{
    for (uint32_t l = 0; l < m->loop_count; l++) {
        uint32_t first = m->loop_corner[l], count = m->loop_corner[l + 1] - first;
        reverse(m->corner_vertex + first, count);
        if (m->corner_uv)
            reverse_stream(m->corner_uv + 2 * (size_t)first, 2, count);
        if (m->corner_normal)
            reverse_stream(m->corner_normal + 3 * (size_t)first, 3, count);
    }
}

/* Normals go by the inverse of what positions go by. */
static void scale_normals(pcg_mesh *m, pcg_vec3 by)
{
    for (uint32_t c = 0; m->corner_normal && c < m->corner_count; c++) {
        float *n = m->corner_normal + 3 * (size_t)c;
        pcg_vec3 turned =
            vec3_normal(vec3(n[0] * by.y * by.z, n[1] * by.x * by.z, n[2] * by.x * by.y));
        n[0] = (float)turned.x;
        n[1] = (float)turned.y;
        n[2] = (float)turned.z;
    }
}

static int scale_mesh(pcg_run *r, pcg_shape *s, pcg_vec3 by)
{
    pcg_mesh *m = pcg_shape_edit(r, s);
    if (!m)
        return PCG_FAILED;
    for (uint32_t v = 0; v < m->vertex_count; v++)
        m->position[v] = vec3_multiply(m->position[v], by);
    scale_normals(m, by);
    if (by.x * by.y * by.z < 0)
        reverse_faces(m);
    return pcg_shape_fit(r, s);
}

/* A mesh that is stored in 0 … 1 of the scope, and has no normals of its own, follows the scope. */
static bool scope_is_enough(const pcg_mesh *m, pcg_vec3 by)
{
    return m->unit && !m->corner_normal && by.x > 0 && by.y > 0 && by.z > 0;
}

static double factor(double given, double size, bool absolute)
{
    if (!absolute)
        return given;
    return size > 0 ? given / size : 1;
}

static pcg_vec3 pivot_of(const pcg_scope *s, int about)
{
    if (about == PCG_PIVOT_CENTRE)
        return vec3_scale(s->size, 0.5);
    return about == PCG_PIVOT_WORLD ? pcg_scope_local(s, vec3(0, 0, 0)) : vec3(0, 0, 0);
}

/* A shape is moved by its scope; what of it is its mesh is scaled here. */
static int scale_shape(pcg_run *r, pcg_shape *s, pcg_vec3 by)
{
    if (!scope_is_enough(s->mesh, by))
        return scale_mesh(r, s, by);
    s->scope.size = vec3_multiply(s->scope.size, by);
    return PCG_OK;
}

int pcg_geometry_scale(pcg_call *call, struct pcg_geometry_scale *node)
{
    placing p;

    PCG_TRY(placing_open(call, node->in, &p));
    pcg_vec3 by = vec3(factor(node->x, p.scope.size.x, node->absolute),
                       factor(node->y, p.scope.size.y, node->absolute),
                       factor(node->z, p.scope.size.z, node->absolute));
    if (!isfinite(by.x) || !isfinite(by.y) || !isfinite(by.z)) {
        PCG_TRY(pcg_warn(call, "it is not scaled: a factor is not a finite number"));
        return pcg_emit(call, node->out, node->in);
    }
    pcg_vec3 pivot = pivot_of(&p.scope, node->about);
    p.scope.origin = pcg_scope_point(&p.scope, vec3_subtract(pivot, vec3_multiply(pivot, by)));
    PCG_TRY(placing_close(call, &p, by));
    if (!part_is(node->in))
        PCG_TRY(scale_shape(call->run, (pcg_shape *)node->in, by));
    return pcg_emit(call, node->out, node->in);
}

/*pcg
/// Lays the texture on each face by itself: its lower left corner at the face's, upright on walls.
///
/// With `absolute` one image covers `u` by `v` metres, so that bricks have their size on any wall.
/// Without, the image is repeated `u` by `v` times over the face, whatever its size: 1 and 1 fit it
/// in once.
procedure map_uv_faces(in: Shape) -> (out: Shape) [pure] {
    category "look"
    synonyms "face uv mapping", "texture coordinates", "unwrap", "planar"
    /// Metres that the image is wide, or how often it is repeated to the right.
    param u: float = 1
    /// Metres that the image is high, or how often it is repeated upward.
    param v: float = 1
    param absolute: bool = true        /// In metres; otherwise in parts of the face.
    example rectangle(width = 2m, height = 3m) -> map_uv_faces() expect faces = 1, area = 6
    example box() -> map_uv_faces(u = 1, v = 1, absolute = false) expect faces = 6
}
*/
#include <float.h>
#include <math.h>

#include "look.h"
#include "runtime/mesh.h"
#include "map_uv_faces.h"

typedef struct extent {
    double low[2], high[2];
} extent;

/* The face's own axes, as directions along those of the shape's scope: pcg_shape_face's. */
static void face_axes(const pcg_shape *s, uint32_t face, pcg_vec3 local[2])
{
    pcg_vec3 axis[3],
        n = vec3_normal(pcg_scope_direction(&s->scope, pcg_shape_face_normal(s, face)));
    shape_face_axes(&s->scope, n, axis);
    for (int i = 0; i < 2; i++)
        local[i] = vec3(vec3_dot(axis[i], s->scope.axis[0]), vec3_dot(axis[i], s->scope.axis[1]),
                        vec3_dot(axis[i], s->scope.axis[2]));
}

static extent face_extent(const pcg_shape *s, uint32_t first, uint32_t end, const pcg_vec3 axis[2])
{
    extent e = {{DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX}};
    for (uint32_t c = first; c < end; c++) {
        for (int i = 0; i < 2; i++) {
            double at = vec3_dot(axis[i], shape_corner(s, c));
            e.low[i] = at < e.low[i] ? at : e.low[i];
            e.high[i] = at > e.high[i] ? at : e.high[i];
        }
    }
    return e;
}

static void map_face(const struct pcg_geometry_map_uv_faces *node, pcg_shape *s, uint32_t face)
{
    uint32_t first = face_first_corner(s->mesh, face), end = face_last_corner(s->mesh, face);
    pcg_vec3 axis[2];
    face_axes(s, face, axis);
    extent e = face_extent(s, first, end, axis);
    double scale[2] = {look_density(node->u, node->absolute, e.high[0] - e.low[0]),
                       look_density(node->v, node->absolute, e.high[1] - e.low[1])};
    for (uint32_t c = first; c < end; c++)
        for (int i = 0; i < 2; i++)
            s->mesh->corner_uv[2 * (size_t)c + (size_t)i] =
                (float)((vec3_dot(axis[i], shape_corner(s, c)) - e.low[i]) * scale[i]);
}

int pcg_geometry_map_uv_faces(pcg_call *call, struct pcg_geometry_map_uv_faces *node)
{
    pcg_shape *s = node->in;
    if (!look_is_size(node->u, node->absolute) || !look_is_size(node->v, node->absolute)) {
        int status =
            pcg_warn(call, "the texture is not laid: its size is 0, or not a finite number");
        return status == PCG_OK ? pcg_emit(call, node->out, &s->entity) : status;
    }
    pcg_mesh *m = pcg_shape_edit(call->run, s);
    if (!m || pcg_mesh_need_uvs(call->run, m) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t f = 0; f < m->face_count; f++)
        map_face(node, s, f);
    return pcg_emit(call, node->out, &s->entity);
}

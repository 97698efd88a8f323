/*pcg
/// Lays the texture on a shape from the six sides of its scope: each face takes it from the side
/// that it looks to most.
///
/// Faces that lie in one plane continue each other's pattern, which is what walls of many pieces
/// need; `align_scope(to = axes)` before it makes pieces of several shapes agree. With `absolute`
/// one image covers `u` by `v` metres; without, the image is repeated `u` by `v` times over each
/// side of the scope.
procedure map_uv_box(in: Shape) -> (out: Shape) [pure] {
    category "look"
    synonyms "box uv mapping", "cube mapping", "triplanar", "texture coordinates"
    /// Metres that the image is wide, or how often it is repeated to the right.
    param u: float = 1
    /// Metres that the image is high, or how often it is repeated upward.
    param v: float = 1
    param absolute: bool = true        /// In metres; otherwise in parts of the scope.
    example box(width = 2m, depth = 3m, height = 4m) -> map_uv_box() expect faces = 6, area = 52
    example rectangle(width = 2m, height = 3m) -> map_uv_box(absolute = false) expect faces = 1
}
*/
#include <math.h>

#include "look.h"
#include "runtime/mesh.h"
#include "map_uv_box.h"

/* Which coordinates of the scope run along u and v on a side, and whether u runs against its
 * own, so that nothing is mirrored: seen from outside, u is to the right and v up. */
typedef struct side {
    int u, v;
    bool reversed;
} side;

static double component(pcg_vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static side side_of(pcg_vec3 n)
{
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    if (z >= x && z >= y)
        return (side){0, 1, n.z < 0};
    if (x >= y)
        return (side){1, 2, n.x < 0};
    return (side){0, 2, n.y > 0};
}

static void map_face(const struct pcg_geometry_map_uv_box *node, pcg_shape *s, uint32_t face)
{
    side to = side_of(pcg_shape_face_normal(s, face));
    double size_u = component(s->scope.size, to.u), size_v = component(s->scope.size, to.v);
    double scale_u = look_density(node->u, node->absolute, size_u),
           scale_v = look_density(node->v, node->absolute, size_v);
    for (uint32_t c = face_first_corner(s->mesh, face); c < face_last_corner(s->mesh, face); c++) {
        pcg_vec3 p = shape_corner(s, c);
        double u = component(p, to.u);
        float *uv = s->mesh->corner_uv + 2 * (size_t)c;
        uv[0] = (float)((to.reversed ? size_u - u : u) * scale_u);
        uv[1] = (float)(component(p, to.v) * scale_v);
    }
}

int pcg_geometry_map_uv_box(pcg_call *call, struct pcg_geometry_map_uv_box *node)
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

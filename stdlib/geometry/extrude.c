/*pcg
/// Grows a prism from every face of a shape, along the face's normal.
///
/// Outward (a positive amount) it leaves a solid: the sides in the order of the outline, then the
/// displaced face, then the face itself, turned round, as its base. Pushed inward (a negative one)
/// the face leaves its place open: the sides look into the opening, and the displaced face lies at
/// its bottom. Holes get sides too. An amount of 0 changes nothing. Loose edges and vertices, and
/// faces without area, are left out.
///
/// A face by reference grows in its shape: it moves, and sides join it to where it was. All parts
/// of the shape stay. Nothing is left where it was, so that `base` has no meaning; without `cap`
/// the face is taken out as `remove` does it, and nothing leaves.
procedure extrude<T: Faced>(in: T) -> (out: T) [pure, one_to_one] {
    category "model"
    synonyms "push", "pull", "thicken", "prism", "solid", "mass", "recess"
    param amount: length = 1m        /// Distance; a negative one pushes inward.
    param cap: bool = true           /// Keep the displaced face.
    param base: bool = true          /// Keep the face itself, turned round, when it grows outward.
    example rectangle(width = 4m, height = 3m) -> extrude(amount = 2m) expect faces = 6, volume = 24
    example rectangle(width = 4m, height = 3m)
        -> extrude(amount = 2m, base = false) expect faces = 5, area = 40
    example rectangle(width = 4m, height = 3m) -> extrude(amount = -2m) expect faces = 5, area = 40
    example rectangle(width = 4m, height = 3m)
        -> extrude(amount = -2m, cap = false) expect faces = 4, area = 28
    example regular_polygon(sides = 6, radius = 1m)
        -> extrude(amount = 1m) expect faces = 8, volume = 2.598076211353316
    example box(width = 4m, depth = 3m, height = 2m) -> s: sequence { change: step; look: step };
        s.change -> parts { faces } -> top: condition(normal(in).z == 1);
        top.yes -> scale(x = 0.5, y = 0.5, about = centre) -> extrude(amount = 1m)
        -> gone: copy(count = 0);
        s.look -> whole: condition(faces(in) == 10) expect whole.yes.count = 1
}
*/
#include "extrude.h"
#include "geometry.h"
#include "runtime/part.h"

/* A prism under construction. */
typedef struct prism {
    pcg_run *run;
    const pcg_shape *from;
    uint32_t face;
    pcg_vec3 shift; /* from a corner to where it is displaced */
    bool cap, base;
    pcg_mesh *to;
    uint32_t first; /* vertex of the face's first corner; the displaced ones follow all of these */
    uint32_t corners;
    uint32_t *loop; /* room for the vertices of the longest loop */
} prism;

static int add_vertices(prism *p, uint32_t first_corner)
{
    const pcg_mesh *m = p->from->mesh;

    p->first = p->to->vertex_count;
    for (uint32_t side = 0; side < 2; side++)
        for (uint32_t i = 0; i < p->corners; i++) {
            pcg_vec3 at = pcg_shape_local(p->from, m->corner_vertex[first_corner + i]);

            if (side == 1)
                at = vec3_add(at, p->shift);
            if (pcg_mesh_add_vertex(p->run, p->to, at) == UINT32_MAX)
                return PCG_FAILED;
        }
    return PCG_OK;
}

static bool same_place(const pcg_mesh *m, uint32_t a, uint32_t b)
{
    pcg_vec3 d = vec3_subtract(m->position[a], m->position[b]);

    return d.x == 0 && d.y == 0 && d.z == 0;
}

/* The sides along a loop whose corners are from..to-1 of the face's. */
static int add_sides(prism *p, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        uint32_t a = p->first + i, b = p->first + (i + 1 < to ? i + 1 : from);

        if (!same_place(p->to, a, b) &&
            geometry_add_quad(p->run, p->to, a, b, b + p->corners, a + p->corners) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* The face itself once more, over its displaced vertices or, turned round, over its own. */
static int add_end(prism *p, bool displaced, uint32_t first_corner)
{
    const pcg_mesh *m = p->from->mesh;
    uint32_t shift = p->first + (displaced ? p->corners : 0);

    for (uint32_t l = m->face_loop[p->face]; l < m->face_loop[p->face + 1]; l++) {
        uint32_t from = m->loop_corner[l] - first_corner,
                 count = m->loop_corner[l + 1] - m->loop_corner[l], added;

        for (uint32_t i = 0; i < count; i++)
            p->loop[i] = shift + from + (displaced ? i : count - 1 - i);
        added = l == m->face_loop[p->face] ? pcg_mesh_add_face(p->run, p->to, p->loop, count)
                                           : pcg_mesh_add_hole(p->run, p->to, p->loop, count);
        if (added == UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* What lies on the face stays on the displaced one: texture coordinates and the tag. */
static int keep_streams(prism *p, uint32_t first_corner)
{
    const pcg_mesh *m = p->from->mesh;
    uint32_t at = p->to->corner_count - p->corners;

    if (m->corner_uv != NULL) {
        if (pcg_mesh_need_uvs(p->run, p->to) != PCG_OK)
            return PCG_FAILED;
        for (size_t i = 0; i < 2 * (size_t)p->corners; i++)
            p->to->corner_uv[2 * (size_t)at + i] = m->corner_uv[2 * (size_t)first_corner + i];
    }
    if (m->face_tag != NULL && m->face_tag[p->face] != 0) {
        if (pcg_mesh_need_tags(p->run, p->to) != PCG_OK)
            return PCG_FAILED;
        p->to->face_tag[p->to->face_count - 1] = m->face_tag[p->face];
    }
    return PCG_OK;
}

static int keep_material(const prism *p, uint32_t first_face)
{
    const pcg_mesh *m = p->from->mesh;

    if (m->face_material == NULL || m->face_material[p->face] == NULL)
        return PCG_OK;
    if (pcg_mesh_need_materials(p->run, p->to) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t f = first_face; f < p->to->face_count; f++)
        p->to->face_material[f] = m->face_material[p->face];
    return PCG_OK;
}

static int add_prism(prism *p)
{
    const pcg_mesh *m = p->from->mesh;
    uint32_t first_corner = m->loop_corner[m->face_loop[p->face]], first_face = p->to->face_count;

    p->corners = m->loop_corner[m->face_loop[p->face + 1]] - first_corner;
    if (add_vertices(p, first_corner) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t l = m->face_loop[p->face]; l < m->face_loop[p->face + 1]; l++)
        if (add_sides(p, m->loop_corner[l] - first_corner, m->loop_corner[l + 1] - first_corner) !=
            PCG_OK)
            return PCG_FAILED;
    if (p->cap &&
        (add_end(p, true, first_corner) != PCG_OK || keep_streams(p, first_corner) != PCG_OK))
        return PCG_FAILED;
    if (p->base && add_end(p, false, first_corner) != PCG_OK)
        return PCG_FAILED;
    return keep_material(p, first_face);
}

static int add_prisms(pcg_call *call, const struct pcg_geometry_extrude *node, const pcg_shape *s,
                      pcg_mesh *to, uint32_t *loop)
{
    prism p = {.run = call->run,
               .from = s,
               .to = to,
               .loop = loop,
               .cap = node->cap,
               .base = node->base && node->amount > 0};
    int status = PCG_OK;

    for (p.face = 0; p.face < s->mesh->face_count && status == PCG_OK; p.face++) {
        pcg_vec3 normal = vec3_normal(pcg_shape_face_normal(s, p.face));

        p.shift = vec3_scale(normal, node->amount);
        if (vec3_dot(normal, normal) > 0)
            status = add_prism(&p);
        if (status == PCG_OK)
            status = pcg_tick(call);
    }
    return status;
}

static uint32_t longest_loop(const pcg_mesh *m)
{
    uint32_t longest = 0;

    for (uint32_t l = 0; l < m->loop_count; l++)
        if (m->loop_corner[l + 1] - m->loop_corner[l] > longest)
            longest = m->loop_corner[l + 1] - m->loop_corner[l];
    return longest;
}

static int extrude_faces(pcg_call *call, const struct pcg_geometry_extrude *node, pcg_shape *s)
{
    size_t room = (size_t)longest_loop(s->mesh) * sizeof(uint32_t);
    pcg_mesh *to = pcg_mesh_new(call->run, false);
    uint32_t *loop = run_alloc(call->run, room);
    int status = to != NULL && loop != NULL ? add_prisms(call, node, s, to, loop) : PCG_FAILED;

    run_free(call->run, loop, room);
    if (status != PCG_OK) {
        pcg_mesh_drop(call->run, to);
        return status;
    }
    pcg_shape_set_mesh(call->run, s, to);
    return pcg_shape_fit(call->run, s);
}

/* The unit square becomes a part of the unit cube by its scope alone. */
static void extrude_square(pcg_run *r, const struct pcg_geometry_extrude *node, pcg_shape *square)
{
    pcg_scope *s = &square->scope;
    const pcg_mesh *to;

    if (node->amount > 0) {
        to = node->cap ? (node->base ? &pcg_mesh_cube : &pcg_mesh_lid)
                       : (node->base ? &pcg_mesh_cup : &pcg_mesh_sides);
        s->size.z = node->amount;
    } else {
        to = node->cap ? &pcg_mesh_tray : &pcg_mesh_reveal;
        s->origin = vec3_add(s->origin, vec3_scale(s->axis[2], node->amount));
        s->size.z = -node->amount;
    }
    pcg_shape_set_mesh(r, square, pcg_mesh_hold(to));
}

static int extrude_shape(pcg_call *call, const struct pcg_geometry_extrude *node, pcg_shape *s)
{
    if (node->amount != 0 && s->mesh == &pcg_mesh_square)
        extrude_square(call->run, node, s);
    else if (node->amount != 0 && s->mesh->face_count > 0)
        return extrude_faces(call, node, s);
    return PCG_OK;
}

/* *taken: it is out of its shape. */
static int extrude_part(pcg_call *call, const struct pcg_geometry_extrude *node, pcg_part *face,
                        bool *taken)
{
    pcg_vec3 normal;

    if (part_shape(face) == NULL)
        return part_warn_lost(call, face);
    normal = vec3_normal(pcg_shape_face_normal(face->shape, face->index));
    if (node->amount == 0 || vec3_dot(normal, normal) == 0)
        return PCG_OK;
    PCG_TRY(part_grow(call->run, face, vec3_scale(normal, node->amount)));
    *taken = !node->cap;
    return *taken ? part_remove(call->run, face) : PCG_OK;
}

int pcg_geometry_extrude(pcg_call *call, struct pcg_geometry_extrude *node)
{
    bool taken = false;
    int status;

    if (!geometry_is_length(node->amount))
        status = pcg_warn(call, "the amount is %g m: the shape is not extruded", node->amount);
    else if (part_is(node->in))
        status = extrude_part(call, node, (pcg_part *)node->in, &taken);
    else
        status = extrude_shape(call, node, (pcg_shape *)node->in);
    if (status == PCG_OK && !taken)
        return pcg_emit(call, node->out, node->in);
    pcg_entity_drop(call->run, node->in);
    return status;
}

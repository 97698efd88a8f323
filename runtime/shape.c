/* shape.c - shapes: their scopes, and editing their meshes. */
#include <math.h>

#include "runtime/mesh.h"
#include "runtime/parcel.h"
#include "runtime/memory.h"
#include "runtime/part.h"

/* ---- life ------------------------------------------------------------------------------------ */

static int shape_copy(pcg_run *r, pcg_entity *to, const pcg_entity *from)
{
    pcg_shape *copy = (pcg_shape *)to;
    const pcg_shape *s = (const pcg_shape *)from;

    (void)r;
    copy->scope = s->scope;
    copy->material = s->material;
    copy->mesh = pcg_mesh_hold(s->mesh);
    return PCG_OK;
}

static void shape_drop(pcg_run *r, pcg_entity *e)
{
    parts_close(r, (pcg_shape *)e);
    pcg_mesh_drop(r, ((pcg_shape *)e)->mesh);
}

static void shape_leave(pcg_run *r, pcg_entity *e, pcg_u32 base)
{
    parts_leave(r, (pcg_shape *)e, base);
}

const pcg_type pcg_type_shape = {"Shape",        &pcg_type_faced, sizeof(pcg_shape),
                                 shape_copy,     shape_drop,      shape_leave,
                                 pcg_shape_pack, pcg_shape_unpack};

pcg_shape *pcg_shape_new(pcg_call *c, const pcg_entity *ancestor)
{
    return pcg_shape_new_of(c, &pcg_type_shape, ancestor);
}

pcg_shape *pcg_shape_new_of(pcg_call *c, const pcg_type *type, const pcg_entity *ancestor)
{
    pcg_shape *s = (pcg_shape *)pcg_entity_new(c, type, ancestor);

    if (s == NULL)
        return NULL;
    s->mesh = pcg_mesh_hold(&pcg_mesh_empty);
    if (ancestor != NULL && pcg_entity_is(ancestor, &pcg_type_shape)) {
        s->scope = ((const pcg_shape *)ancestor)->scope;
        s->material = ((const pcg_shape *)ancestor)->material;
    } else {
        s->scope = (pcg_scope){.axis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        s->material = NULL;
    }
    return s;
}

void pcg_shape_set_mesh(pcg_run *r, pcg_shape *s, pcg_mesh *m)
{
    pcg_mesh *old = s->mesh;

    parts_new_mesh(r, s, m);
    s->mesh = m;
    pcg_mesh_drop(r, old);
}

static void make_metric(pcg_mesh *m, pcg_vec3 size)
{
    for (uint32_t i = 0; i < m->vertex_count; i++)
        m->position[i] = vec3_multiply(m->position[i], size);
    m->unit = false;
}

pcg_mesh *pcg_shape_edit(pcg_run *r, pcg_shape *s)
{
    if (s->mesh->forever || s->mesh->references > 1) {
        pcg_mesh *own = pcg_mesh_copy(r, s->mesh);

        if (own == NULL)
            return NULL;
        pcg_shape_set_mesh(r, s, own);
    }
    if (s->mesh->unit)
        make_metric(s->mesh, s->scope.size);
    return s->mesh;
}

pcg_vec3 pcg_shape_local(const pcg_shape *s, uint32_t vertex)
{
    return shape_point(s, vertex);
}

pcg_vec3 pcg_shape_world(const pcg_shape *s, uint32_t vertex)
{
    return pcg_scope_point(&s->scope, shape_point(s, vertex));
}

const pcg_material *pcg_shape_face_material(const pcg_shape *s, uint32_t face)
{
    const pcg_material *m = s->mesh->face_material != NULL ? s->mesh->face_material[face] : NULL;

    if (m == NULL)
        m = s->material;
    return m != NULL ? m : &pcg_material_default;
}

/* ---- bounds and fitting ---------------------------------------------------------------------- */

bool mesh_bounds(const pcg_mesh *m, pcg_vec3 *low, pcg_vec3 *high)
{
    if (m->vertex_count == 0) {
        *low = *high = vec3(0, 0, 0);
        return false;
    }
    *low = *high = m->position[0];
    for (uint32_t i = 1; i < m->vertex_count; i++)
        bounds_add(low, high, m->position[i]);
    return true;
}

bool pcg_shape_bounds(const pcg_shape *s, pcg_vec3 *low, pcg_vec3 *high)
{
    const pcg_mesh *m = s->mesh;

    *low = *high = vec3(0, 0, 0);
    if (m->vertex_count == 0)
        return false;
    *low = *high = pcg_shape_world(s, 0);
    for (uint32_t i = 1; i < m->vertex_count; i++)
        bounds_add(low, high, pcg_shape_world(s, i));
    return true;
}

static bool is_zero(pcg_vec3 a)
{
    return a.x == 0 && a.y == 0 && a.z == 0;
}

/* A unit mesh fits when it fills 0 … 1, or is flat at 0, along each axis. */
static bool unit_axis_fits(double low, double high, double *size)
{
    if (low == 0 && high == 0)
        *size = 0;
    return low == 0 && (high == 1 || *size == 0);
}

static bool unit_fits(pcg_shape *s, pcg_vec3 low, pcg_vec3 high)
{
    bool x = unit_axis_fits(low.x, high.x, &s->scope.size.x);
    bool y = unit_axis_fits(low.y, high.y, &s->scope.size.y);
    bool z = unit_axis_fits(low.z, high.z, &s->scope.size.z);

    return x && y && z;
}

/* Moves all positions of a metric mesh that is the shape's own, keeping them in place in the
 * world. */
static void shift_to_zero(pcg_shape *s, pcg_vec3 low)
{
    for (uint32_t i = 0; i < s->mesh->vertex_count; i++)
        s->mesh->position[i] = vec3_subtract(s->mesh->position[i], low);
    s->scope.origin = pcg_scope_point(&s->scope, low);
}

int pcg_shape_fit(pcg_run *r, pcg_shape *s)
{
    pcg_vec3 low, high;

    if (!mesh_bounds(s->mesh, &low, &high)) {
        s->scope.size = vec3(0, 0, 0);
        return PCG_OK;
    }
    if (s->mesh->unit) {
        if (unit_fits(s, low, high))
            return PCG_OK;
        low = vec3_multiply(low, s->scope.size);
        high = vec3_multiply(high, s->scope.size);
    }
    if (!is_zero(low) || s->mesh->unit) {
        if (pcg_shape_edit(r, s) == NULL)
            return PCG_FAILED;
        shift_to_zero(s, low);
    }
    s->scope.size = vec3_subtract(high, low);
    return PCG_OK;
}

/* ---- aligning -------------------------------------------------------------------------------- */

static bool same_axes(const pcg_vec3 a[3], const pcg_vec3 b[3])
{
    for (int i = 0; i < 3; i++)
        if (a[i].x != b[i].x || a[i].y != b[i].y || a[i].z != b[i].z)
            return false;
    return true;
}

void rotation_between(const pcg_vec3 from[3], const pcg_vec3 to[3], pcg_vec3 row[3])
{
    for (int i = 0; i < 3; i++)
        row[i] = vec3(vec3_dot(to[i], from[0]), vec3_dot(to[i], from[1]), vec3_dot(to[i], from[2]));
}

void rotate_normals(float *normal, uint32_t count, const pcg_vec3 row[3])
{
    for (uint32_t i = 0; i < count; i++, normal += 3) {
        pcg_vec3 n = rotated(row, vec3((double)normal[0], (double)normal[1], (double)normal[2]));

        normal[0] = (float)n.x;
        normal[1] = (float)n.y;
        normal[2] = (float)n.z;
    }
}

int pcg_shape_align(pcg_run *r, pcg_shape *s, const pcg_vec3 axis[3])
{
    pcg_vec3 row[3];
    pcg_mesh *m;

    if (same_axes(s->scope.axis, axis))
        return pcg_shape_fit(r, s);
    if ((m = pcg_shape_edit(r, s)) == NULL)
        return PCG_FAILED;
    rotation_between(s->scope.axis, axis, row);
    for (uint32_t i = 0; i < m->vertex_count; i++)
        m->position[i] = rotated(row, m->position[i]);
    if (m->corner_normal != NULL)
        rotate_normals(m->corner_normal, m->corner_count, row);
    for (int i = 0; i < 3; i++)
        s->scope.axis[i] = axis[i];
    return pcg_shape_fit(r, s);
}

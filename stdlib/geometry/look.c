/* look.c - changing materials, laying textures. */
#include <math.h>

#include "look.h"
#include "runtime/part.h"

static int change_faces(pcg_run *r, pcg_shape *s, look_function *f, const void *context)
{
    /* Neighbouring faces mostly have the same material: it goes through `f` once. */
    const pcg_material *before = NULL, *after = NULL;
    pcg_mesh *m = pcg_shape_edit(r, s);
    if (!m)
        return PCG_FAILED;
    for (uint32_t i = 0; i < m->face_count; i++) {
        const pcg_material *own = m->face_material[i];
        if (!own)
            continue;
        if (own != before) {
            const pcg_material changed = f(own, context);
            before = own;
            after = pcg_material_intern(r, &changed);
        }
        if (!after)
            return PCG_FAILED;
        m->face_material[i] = after;
    }
    return PCG_OK;
}

static int change_shape(pcg_run *r, pcg_shape *s, look_function *f, const void *context)
{
    const pcg_material changed = f(s->material ? s->material : &pcg_material_default, context);
    const pcg_material *interned = pcg_material_intern(r, &changed);
    if (!interned)
        return PCG_FAILED;
    s->material = interned;
    return s->mesh->face_material ? change_faces(r, s, f, context) : PCG_OK;
}

static int change_face(pcg_run *r, pcg_shape *s, uint32_t face, look_function *f,
                       const void *context)
{
    const pcg_material changed = f(pcg_shape_face_material(s, face), context);
    const pcg_material *interned = pcg_material_intern(r, &changed);
    pcg_mesh *m = pcg_shape_edit(r, s);
    if (!interned || !m || pcg_mesh_need_materials(r, m) != PCG_OK)
        return PCG_FAILED;
    m->face_material[face] = interned;
    return PCG_OK;
}

int look_change(pcg_call *call, pcg_entity *e, look_function *f, const void *context)
{
    pcg_part *face = (pcg_part *)e;
    if (e->type != &pcg_type_face)
        return change_shape(call->run, (pcg_shape *)e, f, context);
    if (!part_shape(face))
        return part_warn_lost(call, face);
    return change_face(call->run, face->shape, face->index, f, context);
}

double look_density(double given, int absolute, double size)
{
    if (absolute)
        return 1 / given;
    return size > 0 ? given / size : 0;
}

bool look_is_size(double given, int absolute)
{
    return isfinite(given) && (!absolute || fabs(given) > 1e-9);
}

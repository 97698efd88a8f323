/* polygon_face.c - from the faces of a shape to polygons in the plane, and back. */
#include "runtime/polygon_face.h"

#include <math.h>

#include "runtime/list.h"
#include "runtime/mesh.h"

/* The frame of a face with the given normal, of length 1. */
static face_frame frame_of(const pcg_shape *s, uint32_t face, pcg_vec3 normal)
{
    face_frame f = {.origin = shape_corner(s, face_first_corner(s->mesh, face)), .z = normal};

    if (normal.z > 1 - 1e-12) {
        f.origin = vec3(0, 0, f.origin.z);
        f.x = vec3(1, 0, 0);
        f.y = vec3(0, 1, 0);
        f.z = vec3(0, 0, 1);
        return f;
    }
    f.x = fabs(normal.z) > 0.9 ? vec3(1, 0, 0) : vec3(-normal.y, normal.x, 0);
    f.x = vec3_normal(vec3_subtract(f.x, vec3_scale(normal, vec3_dot(f.x, normal))));
    f.y = vec3_cross(normal, f.x);
    return f;
}

static int add_loop(pcg_run *r, const pcg_shape *s, uint32_t loop, const face_frame *f,
                    polygons *out)
{
    const pcg_mesh *m = s->mesh;

    for (uint32_t i = m->loop_corner[loop]; i < m->loop_corner[loop + 1]; i++) {
        pcg_vec3 p = vec3_subtract(shape_corner(s, i), f->origin);

        if (polygons_add(r, out, (pcg_vec2){vec3_dot(p, f->x), vec3_dot(p, f->y)}) != PCG_OK)
            return PCG_FAILED;
    }
    return polygons_end_loop(r, out);
}

static void turn_round(polygons *p, uint32_t loop)
{
    for (uint32_t i = loop_begin(p, loop), j = p->end[loop]; j > i + 1; i++) {
        pcg_vec2 kept = p->point[i];

        p->point[i] = p->point[--j];
        p->point[j] = kept;
    }
}

int polygons_of_face(pcg_run *r, const pcg_shape *s, uint32_t face, face_frame *frame,
                     polygons *out)
{
    const pcg_mesh *m = s->mesh;
    pcg_vec3 normal = vec3_normal(pcg_shape_face_normal(s, face));

    if (vec3_dot(normal, normal) == 0)
        return PCG_OK;
    *frame = frame_of(s, face, normal);
    if (polygons_begin_face(r, out) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t l = m->face_loop[face]; l < m->face_loop[face + 1]; l++) {
        if (m->loop_corner[l + 1] - m->loop_corner[l] < 3 && l > m->face_loop[face])
            continue;
        if (add_loop(r, s, l, frame, out) != PCG_OK)
            return PCG_FAILED;
        if ((polygons_loop_area(out, out->loops - 1) < 0) != (l > m->face_loop[face]))
            turn_round(out, out->loops - 1);
    }
    return PCG_OK;
}

/* Adds the vertices of a loop, and their numbers to `vertices`. */
static int add_vertices(pcg_run *r, const polygons *p, uint32_t loop, const face_frame *f,
                        pcg_mesh *m, uint32_t *vertices)
{
    uint32_t from = loop_begin(p, loop);

    for (uint32_t i = from; i < p->end[loop]; i++) {
        vertices[i - from] = pcg_mesh_add_vertex(r, m, frame_point(f, p->point[i]));
        if (vertices[i - from] == UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

int polygons_to_mesh(pcg_run *r, const polygons *p, const face_frame *frame, pcg_mesh *m)
{
    uint32_t *vertices = run_alloc(r, p->points * sizeof *vertices);
    int status = vertices != NULL ? PCG_OK : PCG_FAILED;

    for (uint32_t l = 0, face = 0; l < p->loops && status == PCG_OK; l++) {
        uint32_t count = p->end[l] - loop_begin(p, l), added;
        bool outline = face < p->faces && p->face[face] == l;

        face += outline;
        status = add_vertices(r, p, l, frame, m, vertices);
        if (status == PCG_OK) {
            added = outline ? pcg_mesh_add_face(r, m, vertices, count)
                            : pcg_mesh_add_hole(r, m, vertices, count);
            status = added != UINT32_MAX ? PCG_OK : PCG_FAILED;
        }
    }
    run_free(r, vertices, p->points * sizeof *vertices);
    return status;
}

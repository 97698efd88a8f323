/* polygon_face.h - from the faces of a shape to polygons in the plane, and back. */
#ifndef PCG_POLYGON_FACE_H
#define PCG_POLYGON_FACE_H

#include "runtime/polygon.h"

/* The plane of a face, along the axes of the shape's scope: origin + x * u + y * v; z is the
 * normal. */
typedef struct face_frame {
    pcg_vec3 origin, x, y, z;
} face_frame;

/* A face as polygons, one face of them; loops turn as they should whatever the mesh says. A face
 * without area gives none. On a flat shape, the plane's coordinates are the scope's own. Status. */
int polygons_of_face(pcg_run *r, const pcg_shape *s, uint32_t face, face_frame *frame,
                     polygons *out);
static inline pcg_vec3 frame_point(const face_frame *f, pcg_vec2 p)
{
    return vec3_add(f->origin, vec3_add(vec3_scale(f->x, p.x), vec3_scale(f->y, p.y)));
}
/* Adds polygons to a mesh in metres as faces. Status. */
int polygons_to_mesh(pcg_run *r, const polygons *p, const face_frame *frame, pcg_mesh *m);

#endif

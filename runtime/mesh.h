/* mesh.h - what the files behind shape.h share: small things inside loops. */
#ifndef PCG_MESH_H
#define PCG_MESH_H

#include "runtime/shape.h"

/* A vertex in metres along the scope's axes. */
static inline pcg_vec3 shape_point(const pcg_shape *s, uint32_t vertex)
{
    pcg_vec3 p = s->mesh->position[vertex];

    return s->mesh->unit ? vec3_multiply(p, s->scope.size) : p;
}

static inline pcg_vec3 shape_corner(const pcg_shape *s, uint32_t corner)
{
    return shape_point(s, s->mesh->corner_vertex[corner]);
}

/* The corners of a face, all its loops: from .. to-1. */
static inline uint32_t face_first_corner(const pcg_mesh *m, uint32_t face)
{
    return m->loop_corner[m->face_loop[face]];
}
static inline uint32_t face_last_corner(const pcg_mesh *m, uint32_t face)
{
    return m->loop_corner[m->face_loop[face + 1]];
}

static inline void bounds_add(pcg_vec3 *low, pcg_vec3 *high, pcg_vec3 p)
{
    low->x = p.x < low->x ? p.x : low->x;
    low->y = p.y < low->y ? p.y : low->y;
    low->z = p.z < low->z ? p.z : low->z;
    high->x = p.x > high->x ? p.x : high->x;
    high->y = p.y > high->y ? p.y : high->y;
    high->z = p.z > high->z ? p.z : high->z;
}

/* Of the positions as they are stored, unused vertices included; false and zeros when there are
 * none. */
bool mesh_bounds(const pcg_mesh *m, pcg_vec3 *low, pcg_vec3 *high);

/* The rows of the matrix that expresses a direction along the axes `from` along the axes `to`. */
void rotation_between(const pcg_vec3 from[3], const pcg_vec3 to[3], pcg_vec3 row[3]);
static inline pcg_vec3 rotated(const pcg_vec3 row[3], pcg_vec3 p)
{
    return vec3(vec3_dot(row[0], p), vec3_dot(row[1], p), vec3_dot(row[2], p));
}
void rotate_normals(float *normal, uint32_t count, const pcg_vec3 row[3]);

/* The axes of a scope on a face whose normal (in the world, of length 1) is given: see
 * pcg_shape_face. */
void shape_face_axes(const pcg_scope *parent, pcg_vec3 normal, pcg_vec3 axis[3]);

/* What pcg_shape_face makes of a face: the scope alone, and the whole, of a shape that is there.
 * `part` must not be `s`. Status. */
void shape_face_scope(const pcg_shape *s, uint32_t face, pcg_scope *scope);
int shape_become_face(pcg_run *r, const pcg_shape *s, uint32_t face, pcg_shape *part);
/* The same of the line between two vertices: x runs along it. Twice one vertex is that vertex. */
void shape_edge_scope(const pcg_shape *s, uint32_t a, uint32_t b, pcg_scope *scope);
int shape_become_edge(pcg_run *r, const pcg_shape *s, uint32_t a, uint32_t b, pcg_shape *part);

/* As pcg_shape_faces, but always with a mesh of its own, that holds those faces' vertices and no
 * others. */
pcg_shape *shape_extract(pcg_call *c, const pcg_shape *s, const uint32_t *faces, uint32_t count);

/* Leaves a shape those faces (count of them, ascending) and its loose edges, with their vertices and
 * no others; the scope stays as it is. Status. */
int shape_keep_faces(pcg_run *r, pcg_shape *s, const uint32_t *faces, uint32_t count);

/* Fits the scope of a shape that is done; where its mesh is but a rectangle along the scope's axes,
 * it becomes the unit square, so that what comes after need not touch a vertex. Status. */
int shape_settle(pcg_run *r, pcg_shape *s);

#endif

/* geometry.h - what the kernels of this library share. */
#ifndef PCG_GEOMETRY_H
#define PCG_GEOMETRY_H

#include "runtime/base/base.h"
#include "runtime/memory.h"
#include "runtime/shape.h"

/* Lengths up to this can be built with: squares and cubes of them stay exact enough to be
 * compared. */
#define GEOMETRY_MAX_LENGTH 1e9

/* Finite, and no larger than can be built with. */
bool geometry_is_length(double length);
/* The same, and above 0. */
bool geometry_is_size(double size);

/* Emits a shape that the caller has; on failure it is gone. `s` NULL, which is memory that has run
 * out, fails. */
int geometry_emit(pcg_call *call, const pcg_port *port, pcg_shape *s);

/* A component of a vector, by number: 0 is x. */
double geometry_component(pcg_vec3 v, int axis);

/* Whether a flat shape's scope is as pcg_shape_face would lay it: level, or x level and y up. */
bool geometry_is_upright(const pcg_scope *s);

/* Adds a quad with the vertices a, b, c, d; status. */
int geometry_add_quad(pcg_run *r, pcg_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

/* The centre of the area of its faces, in the world; without any, the mean of its vertices. */
pcg_vec3 geometry_centre(const pcg_shape *s);
/* Of one face; where it has no area, the mean of its corners. */
pcg_vec3 geometry_face_centre(const pcg_shape *s, uint32_t face);
/* The direction in the world that its faces look to on the whole, of length 1; (0, 0, 0) where they
 * cancel out, as those of a solid do. */
pcg_vec3 geometry_normal(const pcg_shape *s);
/* Between two directions of any length, in degrees; 0 where one has no length. */
double geometry_angle(pcg_vec3 a, pcg_vec3 b);

/* Whether two entities have the same value of an attribute, to the bit; lists: the same list. */
bool geometry_same_value(const pcg_slot *key, const pcg_entity *a, const pcg_entity *b);

#endif

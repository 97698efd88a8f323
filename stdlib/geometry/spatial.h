/* spatial.h - measuring what has a place: shapes, and their parts.
 *
 * A part of no shape is warned of, and measures zero. */
#ifndef PCG_GEOMETRY_SPATIAL_H
#define PCG_GEOMETRY_SPATIAL_H

#include "runtime/part.h"

/* In the world: of a shape as geometry_centre, of a face the centre of its area, of an edge its
 * middle. */
pcg_vec3 spatial_centre(pcg_call *call, const pcg_entity *e);
/* The bounding box in the world; zeros where it is empty. */
void spatial_bounds(pcg_call *call, const pcg_entity *e, pcg_vec3 *low, pcg_vec3 *high);

/* Of a shape or a face. The direction in the world that it looks to, of length 1 or (0, 0, 0). */
pcg_vec3 faced_normal(pcg_call *call, const pcg_entity *e);
double faced_area(pcg_call *call, const pcg_entity *e);
/* The length of all outlines, holes included. */
double faced_perimeter(pcg_call *call, const pcg_entity *e);

#endif

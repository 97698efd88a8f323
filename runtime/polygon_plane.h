/* polygon_plane.h - what the files behind polygons_clean share: points on a grid, segments between
 * them, and the faces that they bound. */
#ifndef PCG_POLYGON_PLANE_H
#define PCG_POLYGON_PLANE_H

#include "runtime/list.h"
#include "runtime/polygon.h"

/* A place on the grid: 2^30 steps across, so that products of differences fit 64 bits with room for
 * a sum. */
typedef struct grid_point {
    int64_t x, y;
    pcg_vec2 at; /* the place that it stands for */
    bool made;   /* where segments cross; not a corner that was given */
} grid_point;

/* Between two points; `winding` is how many more times loops go from a to b than from b to a. */
typedef struct segment {
    uint32_t a, b;
    int winding;
} segment;

typedef struct plane {
    pcg_run *run;
    grid_point *point;
    uint32_t points, point_capacity;
    uint32_t *slot; /* a hash table of points: numbers + 1 */
    uint32_t slots;
    segment *segment;
    uint32_t segments, segment_capacity;
    pcg_vec2 middle; /* of the grid */
    double step;
    bool changed; /* something was cut or joined */
} plane;

/* Lays the loops out on a grid and cuts segments where they meet, until they do so at their ends
 * only; each stands once then. Status. To be closed in any case. */
int plane_open(pcg_run *r, const polygons *loops, plane *p);
void plane_close(plane *p);

/* Twice the area of the triangle of three points; exact. */
static inline int64_t grid_turn(const grid_point *a, const grid_point *b, const grid_point *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

#endif

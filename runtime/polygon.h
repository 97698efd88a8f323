/* polygon.h - polygons in the plane: cleaning what crosses itself, and offsetting.
 *
 * Loops turn left around what is inside and right around holes. All memory is the run's; a
 * `polygons` that is zeroed is empty, and is given back with polygons_free, also after a failure.
 */
#ifndef PCG_POLYGON_H
#define PCG_POLYGON_H

#include "runtime/shape.h"

typedef struct polygons {
    pcg_vec2 *point;
    uint32_t *end;  /* where each loop ends; it begins where the one before ends */
    uint32_t *face; /* at which loop each face begins: its outline, then its holes */
    uint32_t points, loops, faces;
    uint32_t point_capacity, loop_capacity, face_capacity;
} polygons;

static inline uint32_t loop_begin(const polygons *p, uint32_t loop)
{
    return loop > 0 ? p->end[loop - 1] : 0;
}
/* The loops of a face end here. */
static inline uint32_t face_end(const polygons *p, uint32_t face)
{
    return face + 1 < p->faces ? p->face[face + 1] : p->loops;
}

/* All of these return a status. A face begins with the next loop that is ended. */
int polygons_begin_face(pcg_run *r, polygons *p);
int polygons_add(pcg_run *r, polygons *p, pcg_vec2 at);
int polygons_end_loop(pcg_run *r, polygons *p);
void polygons_clear(polygons *p);
void polygons_free(pcg_run *r, polygons *p);
/* Signed: negative for a loop that turns right; and the sum over all loops. */
double polygons_loop_area(const polygons *p, uint32_t loop);
double polygons_area(const polygons *p);

/* The part of the plane that the loops wind around more than `least` times, counter-clockwise, as
 * faces whose loops do not cross themselves or each other (they may touch in points). With `least`
 * 0 it joins polygons, and of a difference (loops turned round) it leaves what stays. Works on a
 * grid of a billionth of the extent: what is smaller is lost. *changed says whether anything had to
 * be cut, joined or left out; if not, the result may have the loops in another order. Status. */
int polygons_clean(pcg_run *r, const polygons *loops, int least, polygons *out, bool *changed);

/* What `from` has and `without` has not, as faces. Status. */
int polygons_subtract(pcg_run *r, const polygons *from, const polygons *without, polygons *out);
/* What both have, as faces; neither may wind around anything more than once. Status. */
int polygons_intersect(pcg_run *r, const polygons *a, const polygons *b, polygons *out);

/* All outlines moved inward by `distance`, or outward by a negative one, as faces. Corners are
 * mitred, up to POLYGON_MITRE times the distance, beyond which they are cut off square. What
 * collapses is gone, what comes apart is several faces, what grows together is one. *plain: no such
 * thing happened; the result then has the loops of `in` in their order, each with the same corners
 * in the same order. Status. */
#define POLYGON_MITRE 5.0
int polygons_offset(pcg_run *r, const polygons *in, double distance, polygons *out, bool *plain);

#endif

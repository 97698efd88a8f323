/* mesh_slice.h - cutting the faces of a shape by parallel planes. */
#ifndef PCG_MESH_SLICE_H
#define PCG_MESH_SLICE_H

#include "runtime/shape.h"

/* The pieces that faces were cut into, in one mesh: in metres, with the shape's own vertices and
 * those on the planes. Pieces of neighbouring faces share these, as the faces did. */
typedef struct slices {
    pcg_mesh *pieces;
    uint32_t *slab; /* for each piece how many planes are below it */
    uint32_t slab_capacity;
} slices;

/* Cuts along an axis (0, 1, 2) of the scope at `plane`, ascending and different, in metres from its
 * origin. Streams, materials and tags travel. A face in a plane belongs to the slab that it closes.
 * Faces without area stay whole. Loose edges and vertices are left out. Status; what it holds is to
 * be closed even when it fails. */
int slices_open(pcg_call *c, const pcg_shape *s, int axis, const double *plane, uint32_t planes,
                slices *out);
void slices_close(pcg_run *r, slices *out);

#endif

/* topology.h - what hangs together in a mesh: derived when asked for, never stored.
 *
 * Vertices of a mesh that stand in one place (nearer than a micrometre) count as one here, since
 * parts that were made apart share no vertices. All memory is the run's, and is given back by the
 * function that goes with each.
 */
#ifndef PCG_TOPOLOGY_H
#define PCG_TOPOLOGY_H

#include "runtime/shape.h"

/* For each vertex the first one in its place. NULL: out of memory. */
uint32_t *weld(pcg_run *r, const pcg_shape *s);
void weld_free(pcg_run *r, const pcg_shape *s, uint32_t *first);

/* An edge between two welded vertices. */
typedef struct edge_use {
    uint32_t a, b;          /* as first met */
    uint32_t forward, back; /* how many loops go along it from a to b, and from b to a */
} edge_use;

/* The edges of all loops and the loose ones, each once, in the order in which they are met. */
typedef struct edge_list {
    edge_use *at;
    uint32_t count, capacity;
    uint32_t *slot; /* a hash table of numbers + 1 */
    uint32_t slots;
    uint32_t *first; /* the vertices, welded */
} edge_list;
/* Status. The list is sound, and to be closed, even when it fails. */
int edge_list_open(pcg_run *r, const pcg_shape *s, edge_list *list);
void edge_list_close(pcg_run *r, const pcg_shape *s, edge_list *list);
/* Between any two vertices of the mesh; NULL where there is none. */
const edge_use *edge_list_find(const edge_list *list, uint32_t a, uint32_t b);

/* For each face, the number of the piece that it belongs to; pieces are numbered as they first
 * appear. Status. */
int group_connected(pcg_run *r, const pcg_shape *s, uint32_t *group, uint32_t *count);

/* Whether every edge has one face on either side, which agree on what is outside. False when memory
 * has run out. */
bool is_closed(pcg_run *r, const pcg_shape *s);

/* Axes of a scope with x along a direction of length 1, y level, z as far up as can be. */
void axes_along(pcg_vec3 x, pcg_vec3 axis[3]);

#endif

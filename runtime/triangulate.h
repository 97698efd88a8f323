/* triangulate.h - what the two files behind pcg_triangulate share: rings of nodes, and bridging
 * holes. */
#ifndef PCG_TRIANGULATE_H
#define PCG_TRIANGULATE_H

#include "runtime/base/base.h"
#include "runtime/orientation.h"
#include "runtime/shape.h"

#define NONE UINT32_MAX

/* A corner in the plane, in a ring that turns counter-clockwise around the inside. */
typedef struct node {
    pcg_vec2 at;
    uint32_t corner;
    uint32_t before, after;
    uint32_t cell;                    /* of the grid of blockers; NONE: in none */
    uint32_t cell_before, cell_after; /* in that cell's list */
    bool gone, waiting;
} node;

/* Nodes by the rows of the plane that the edge from them to their successors touches. */
typedef struct row_index {
    struct row_entry {
        uint32_t node, next;
    } * entry;
    uint32_t *row;
    uint32_t row_count, row_capacity, entry_count, entry_capacity;
    double low, scale;
} row_index;

struct pcg_triangulator {
    node *nodes;
    uint32_t node_count, node_capacity;
    uint32_t *queue; /* a ring buffer of nodes that may be ears */
    uint32_t queue_head, queue_count, queue_capacity;
    uint32_t *cell; /* first blocker in each cell of the grid */
    uint32_t cell_capacity, across, down;
    pcg_vec2 low, scale; /* from a place to its cell */
    uint32_t *hole;      /* the leftmost node of each hole */
    uint32_t hole_count, hole_capacity;
    row_index rows;
};

/* Makes an array of the triangulator's at least `count` items long, old items kept; false: no
 * memory. */
bool triangulator_reserve(void **at, uint32_t *capacity, size_t count, size_t size);
/* A new node with another's place and corner, in no ring. Room was reserved. */
uint32_t triangulator_twin(pcg_triangulator *t, uint32_t of);
/* Joins the rings of t->hole to the one that `outline` is in, each by two edges there and back. A
 * hole that lies outside is left out. False: no memory. */
bool triangulator_bridge(pcg_triangulator *t, uint32_t outline);

static inline bool same_place(const node *a, const node *b)
{
    return a->at.x == b->at.x && a->at.y == b->at.y;
}

#endif

/* nearby.h - which of many shapes are near a place, or stand in a line of sight.
 *
 * Shapes come as parts in the world: the triangles of their faces, their loose edges, their loose
 * vertices. A tree of boxes over all of them answers each question in about the time of a few dozen
 * boxes, wherever the shapes are. All memory is the run's; what is found depends on nothing but the
 * shapes and their order.
 */
#ifndef PCG_NEARBY_H
#define PCG_NEARBY_H

#include "geometry.h"

/* A triangle, an edge or a vertex. */
typedef struct nearby_part {
    pcg_vec3 corner[3];
    uint32_t corners; /* 3, 2 or 1; the rest of the array repeats the first */
    uint32_t owner;   /* number of the shape that it is of */
} nearby_part;

typedef struct nearby_parts {
    nearby_part *at;
    uint32_t count, capacity;
} nearby_parts;

/* Takes shapes apart; scratch that is reused from one to the next. */
typedef struct nearby_reader {
    pcg_run *run;
    pcg_triangulator *triangulator;
    uint32_t *triangle, triangle_capacity;
    bool *used; /* which vertices a face or edge has */
    uint32_t used_capacity;
} nearby_reader;

/* Status. To be closed in any case. */
int nearby_reader_open(pcg_run *r, nearby_reader *reader);
void nearby_reader_close(nearby_reader *reader);
/* Adds the parts of a shape; those with a coordinate that is no number are left out. Status. */
int nearby_read(nearby_reader *reader, const pcg_shape *s, uint32_t owner, nearby_parts *parts);
void nearby_parts_free(pcg_run *r, nearby_parts *parts);

/* A box of the tree. A leaf has `count` parts from `first` on; any other box holds the next one and
 * the one numbered `first`. */
typedef struct nearby_box {
    pcg_vec3 low, high;
    uint32_t first, count;
    uint32_t least; /* the lowest owner in it */
} nearby_box;

typedef struct nearby {
    pcg_run *run;
    nearby_parts parts; /* in the order of the tree */
    nearby_box *box;
    uint32_t boxes, box_capacity;
} nearby;

/* Reads the shapes of a list, whose numbers become the owners, and builds the tree. Status. To be
 * closed in any case. */
int nearby_open(pcg_call *call, nearby_reader *reader, const pcg_entities *shapes, nearby *n);
void nearby_close(nearby *n);

/* Which owners count; `takes` NULL: all. */
typedef struct nearby_filter {
    bool (*takes)(const void *user, uint32_t owner);
    const void *user;
} nearby_filter;

typedef struct nearby_hit {
    uint32_t owner;
    double distance;
    pcg_vec3 from, at; /* where they are nearest: on what was asked about, and on the owner */
} nearby_hit;

/* What is nearest to any of some parts, and not farther than `within`; the one with the lowest
 * number of those that are equally near. False where there is none. */
bool nearby_nearest(const nearby *n, const nearby_parts *of, const nearby_filter *filter,
                    double within, nearby_hit *hit);
/* Lists the parts (by their place in n->parts) whose boxes are not farther than `reach` from the
 * box low … high, in the order of the tree. Status. */
typedef struct nearby_list {
    uint32_t *at;
    uint32_t count, capacity;
} nearby_list;
int nearby_around(const nearby *n, pcg_vec3 low, pcg_vec3 high, double reach, nearby_list *list);
void nearby_list_free(pcg_run *r, nearby_list *list);
/* Whether a triangle crosses the way from a to b; what is nearer than `margin` to either end does
 * not count. */
bool nearby_blocks(const nearby *n, pcg_vec3 a, pcg_vec3 b, double margin,
                   const nearby_filter *filter);

/* The distance between two parts, squared, and where they are nearest. Touching and crossing ones
 * are at 0. */
double nearby_closest(const nearby_part *a, const nearby_part *b, pcg_vec3 *on_a, pcg_vec3 *on_b);

#endif

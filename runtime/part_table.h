/* part_table.h - what a shape knows of its parts: what the files behind part.h share. */
#ifndef PCG_PART_TABLE_H
#define PCG_PART_TABLE_H

#include "part.h"

/* One part of a shape. */
typedef struct part_record {
    pcg_part *out;                     /* its entity, while something holds it; else NULL */
    struct pcg_attributes *attributes; /* what the entity had, while there is none */
    const pcg_node *maker;
} part_record;

/* The parts of a kind. */
typedef struct part_records {
    part_record *at; /* NULL until that kind is asked for */
    uint32_t count, capacity;
} part_records;

typedef struct part_numbers {
    uint32_t *at;
    uint32_t count, capacity;
} part_numbers;

struct shape_parts {
    /* Of the mesh that this was made for. */
    uint32_t vertex_count, face_count, loop_count, corner_count, loose_count;
    uint32_t place_count;
    part_numbers place;        /* of each vertex */
    part_numbers place_first;  /* place_count + 1: where a place's vertices begin … */
    part_numbers place_vertex; /* … here */
    uint64_t *moved;           /* by place: the number of the move that it last took part in */
    uint32_t moved_capacity;
    uint64_t moves, settled; /* moves so far, and when the shape was last settled */
    part_numbers above;      /* by place, while a face grows: the vertex that is new there; 0 */
    part_numbers edge;       /* the two places of each; NULL until edges are asked for */
    part_numbers gone;       /* faces that go when the shape is settled */
    part_records record[PART_KINDS];
};

/* A shape that is to be settled: held. */
typedef struct part_unsettled {
    struct part_unsettled *next;
    pcg_shape *shape;
} part_unsettled;

/* Makes the shape's table where it has none. `apart`: every vertex is a place of its own, every
 * loose edge an edge. Status. */
int part_table_open(pcg_run *r, pcg_shape *s, bool apart);
int part_number_add(pcg_run *r, part_numbers *list, uint32_t number); /* status */
/* The table is of this mesh from now on. */
void part_table_count(struct shape_parts *t, const pcg_mesh *m);
/* Changes of the parts are there for the scope to be fitted to; before they begin. Status. */
int part_unsettle(pcg_run *r, pcg_shape *s);
/* Whether two meshes have the same faces, edges and vertices, wherever these are. */
bool part_same_topology(const pcg_mesh *a, const pcg_mesh *b);

#endif

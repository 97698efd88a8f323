/* part.h - the parts of shapes: faces, edges and vertices as entities that point into their shape.
 *
 * A part is a shape and a number. It holds its shape, which lives as long as one of its parts; the
 * shape knows its parts without holding them. Each part is one entity: asked for twice, it is the
 * same. What an entity of it carried when its last reference went, its attributes, is kept with the
 * shape, and is there again when the part is next asked for.
 *
 * Vertices of the mesh that stand in one place (topology.h) when the parts of a shape are first
 * asked for are one vertex here, and stay one. Edges lie between two places. To move a part moves
 * all of its places, and with them whatever else hangs on those.
 *
 * A shape keeps its parts while its mesh keeps its faces, edges and vertices, wherever these move.
 * A mesh of other ones parts with them: the entities stay, with their attributes, but are of no
 * shape any more (`part_shape` is NULL). A copy of a shape has parts of its own. A copy of a part
 * is the one part of a shape of its own, which nothing else holds.
 *
 * Moving parts leaves a shape's scope as it was, so that many can be moved in linear time. It is
 * fitted before a round that may see the shape, and at the end of the run (`parts_settle`).
 */
#ifndef PCG_PART_H
#define PCG_PART_H

#include "shape.h"

typedef enum part_kind { PART_FACE, PART_EDGE, PART_VERTEX, PART_KINDS } part_kind;

typedef struct pcg_part {
    pcg_entity entity;
    pcg_shape *shape; /* held; NULL once it is of none */
    part_kind kind;
    uint32_t index; /* of all parts of that kind in its shape */
} pcg_part;

/* Whether an entity is a face, an edge or a vertex. */
bool part_is(const pcg_entity *e);
/* "face", "edge" or "vertex". */
const char *part_name(part_kind kind);

/* ---- of a shape ------------------------------------------------------------------------------ */

/* How many parts of that kind the shape has; each comes to be, with the attributes of the shape,
 * when this is first called. Status. */
int parts_count(pcg_run *r, pcg_shape *s, part_kind kind, uint32_t *count);
/* One of them, counted by the last call of parts_count: one more reference. It descends from the
 * shape. NULL: out of memory, or over the entity limit. */
pcg_part *parts_at(pcg_call *c, pcg_shape *s, part_kind kind, uint32_t index);
/* What shape.c calls: the shape's mesh is about to be replaced; the shape is leaving a graph; it is
 * being given up. */
void parts_new_mesh(pcg_run *r, pcg_shape *s, const pcg_mesh *m);
void parts_leave(pcg_run *r, pcg_shape *s, pcg_u32 base);
void parts_close(pcg_run *r, pcg_shape *s);

/* ---- of a part ------------------------------------------------------------------------------- */

/* The shape that it is a part of, or NULL. */
pcg_shape *part_shape(const pcg_part *p);
/* Says that it is a part of no shape any more. Status of pcg_warn. */
int part_warn_lost(pcg_call *c, const pcg_part *p);

/* What follows is for parts of a shape. The places that a part has: one, two, or those of a face's
 * corners, where one may come up again; and a vertex of the mesh in a place. */
uint32_t part_place_count(const pcg_part *p);
uint32_t part_place(const pcg_part *p, uint32_t i);
uint32_t part_place_vertex(const pcg_shape *s, uint32_t place);
/* The scope that the part has as a shape by itself: as `decompose` makes it. */
void part_scope(const pcg_part *p, pcg_scope *scope);
/* Moves what stands at a point of `from`, times `by` along its axes, to that point of `to`.
 * Status. */
int part_move(pcg_run *r, pcg_part *p, const pcg_scope *from, const pcg_scope *to, pcg_vec3 by);
/* Moves a face, and adds sides between where it was and where it is: they, their edges and vertices
 * are new parts behind all others, with the attributes of the face. `shift` is along the axes of
 * the shape's scope. Status. */
int part_grow(pcg_run *r, pcg_part *face, pcg_vec3 shift);
/* Takes a face, and the vertices that nothing else hangs on, out of its shape: at once as far as
 * the part is concerned, which is of no shape from then on; the mesh follows when it is settled,
 * and then parts with all of its parts. Status. */
int part_remove(pcg_run *r, pcg_part *face);
/* Fits the scopes of all shapes whose parts have moved. Out of memory is on the run. */
void parts_settle(pcg_run *r);

#endif

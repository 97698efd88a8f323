/* streets.h - street networks: what the kernels of this library and the writers share.
 *
 * A network is a drawing of centre lines: vertices in the world, edges between them, and ways,
 * which hold what edges have in common. Nothing is said by it of crossings: two edges meet where
 * they share a vertex, and nowhere else, which is what `blend_streets` sees to. Heights are kept,
 * but all reasoning is in the plane of x and y.
 *
 * The drawing is shared between networks, and immutable while shared: streets_edit gives one
 * that may be changed.
 */
#ifndef PCG_STREETS_H
#define PCG_STREETS_H

#include "runtime/base/base.h"
#include "runtime/list.h"
#include "runtime/shape.h"

/* Farther from the origin, and wider than this, a street is left out. */
#define STREETS_FARTHEST 1e8
#define STREETS_WIDEST   1e4

typedef struct street_way {
    double width;                 /* of the roadway; it is what it was given, maybe 0 or below */
    double left, right;           /* widths of the sidewalks, seen along the edges; 0: none */
    pcg_int level;                /* 0 is the ground, bridges lie above, tunnels below */
    const char *name, *kind, *id; /* the run's strings */
} street_way;

typedef struct street_edge {
    uint32_t from, to; /* vertices */
    uint32_t way;
} street_edge;

/* The edges of a way stand in the order in which it runs. */
typedef struct street_drawing {
    uint32_t references;
    uint32_t vertices, edges, ways;
    uint32_t vertex_capacity, edge_capacity, way_capacity;
    pcg_vec3 *vertex;
    street_edge *edge;
    street_way *way;
} street_drawing;

typedef struct pcg_streets {
    pcg_entity entity;
    street_drawing *drawing;
} pcg_streets;

extern const pcg_type pcg_type_street_network;

/* A new network with an empty drawing of its own, descending from `ancestor` (NULL: from the
 * round). NULL: out of memory, or over the entity limit. */
pcg_streets *streets_new(pcg_call *c, const pcg_entity *ancestor);
/* Its drawing, for itself alone. NULL: out of memory. */
street_drawing *streets_edit(pcg_run *r, pcg_streets *s);
/* Puts a drawing in; takes over one reference to it, gives up the old one's. */
void streets_set(pcg_run *r, pcg_streets *s, street_drawing *d);
/* One with room for that many, one reference to it. NULL: out of memory. */
street_drawing *drawing_new(pcg_run *r, uint32_t vertices, uint32_t edges, uint32_t ways);
void drawing_drop(pcg_run *r, street_drawing *d);

/* These return the number of what they add, or UINT32_MAX when memory has run out. */
uint32_t drawing_add_vertex(pcg_run *r, street_drawing *d, pcg_vec3 at);
uint32_t drawing_add_edge(pcg_run *r, street_drawing *d, uint32_t from, uint32_t to, uint32_t way);
uint32_t drawing_add_way(pcg_run *r, street_drawing *d, const street_way *way);

/* In the plane, of all edges. */
double drawing_length(const street_drawing *d);
/* Whether a place is finite and near enough to be worked with. */
bool streets_is_place(pcg_vec3 at);
/* A width that can be built; what is wider than STREETS_WIDEST, negative or no number is 0. */
double streets_width(double width);
/* To the nearest of places about a micrometre apart. They stay the same to the bit when they are
 * expressed in a scope with such an origin. */
double streets_snap(double a);
/* Emits a network that the caller has; on failure it is gone. NULL, which is memory that has run
 * out, fails. */
int streets_emit(pcg_call *call, const pcg_port *port, pcg_streets *s);

static inline pcg_vec2 vec2_of(pcg_vec3 p)
{
    return (pcg_vec2){p.x, p.y};
}
static inline pcg_vec2 vec2_add(pcg_vec2 a, pcg_vec2 b)
{
    return (pcg_vec2){a.x + b.x, a.y + b.y};
}
static inline pcg_vec2 vec2_subtract(pcg_vec2 a, pcg_vec2 b)
{
    return (pcg_vec2){a.x - b.x, a.y - b.y};
}
static inline pcg_vec2 vec2_scale(pcg_vec2 a, double k)
{
    return (pcg_vec2){a.x * k, a.y * k};
}
static inline double vec2_dot(pcg_vec2 a, pcg_vec2 b)
{
    return a.x * b.x + a.y * b.y;
}
static inline double vec2_cross(pcg_vec2 a, pcg_vec2 b)
{
    return a.x * b.y - a.y * b.x;
}
static inline pcg_vec2 vec2_left(pcg_vec2 a)
{
    return (pcg_vec2){-a.y, a.x};
}
/* Exactly a at 0 and exactly b at 1. */
static inline pcg_vec2 vec2_between(pcg_vec2 a, pcg_vec2 b, double share)
{
    return share >= 1 ? b : (pcg_vec2){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}
static inline pcg_vec2 vec2_snap(pcg_vec2 a)
{
    return (pcg_vec2){streets_snap(a.x), streets_snap(a.y)};
}
double vec2_length(pcg_vec2 a);
pcg_vec2 vec2_normal(pcg_vec2 a); /* of length 1; (0, 0) where `a` has none */

#endif

/* layout.h - from a drawing of streets to areas: what the files behind street_to_shape share.
 *
 * A *link* is a street between two places where more happens than a bend. A *band* is what it
 * covers: its roadway, or its corridor, which is the roadway and the sidewalks. Across each of its
 * points a link has a cross-section, from the band's left border to its right one; between two of
 * them lies a *piece*. A *station* is a place along a link: its whole part says behind which point,
 * its fraction the share of the piece, and the cross-section there is between those of the piece.
 *
 * A *cluster* is one or more nodes of the drawing with all that is too close to be told apart: the
 * *stubs* of the links that meet there, up to the stations from which on each is clear of the
 * others, and links that are all stub. The union of these is the crossing. So a crossing and its
 * streets have the cross-sections at the stations in common, to the bit, and nothing else.
 */
#ifndef PCG_STREETS_LAYOUT_H
#define PCG_STREETS_LAYOUT_H

#include "runtime/polygon.h"
#include "streets.h"

enum { ROADWAY, CORRIDOR, BANDS };
enum { LEFT, RIGHT, SIDES };

/* What happens at a vertex of the drawing. */
typedef enum node_kind {
    NODE_BEND,    /* the street goes on: no node */
    NODE_SEAM,    /* one street ends, another goes on as wide as it */
    NODE_CHANGE,  /* the width changes, or the bend is sharp */
    NODE_END,     /* a dead end */
    NODE_CROSSING /* three or more meet */
} node_kind;

typedef struct street_link {
    uint32_t node[2]; /* vertices of the drawing: where it begins, where it ends */
    uint32_t way;
    uint32_t first, points;   /* in the layout's arrays; 2 or more */
    double along;             /* how far from the way's begin it begins */
    bool internal[BANDS];     /* all stub */
    double station[BANDS][2]; /* where the stubs end: 0 <= [0] < [1] <= points - 1 */
} street_link;

/* Two pieces overlap: of the pieces' lengths, from low to high. */
typedef struct overlap {
    uint32_t piece[2];
    double low[2], high[2];
} overlap;

typedef struct overlaps {
    overlap *at;
    uint32_t count, capacity;
    uint32_t *begin; /* of each piece, in `of`; one more than there are points */
    uint32_t *of;    /* numbers of overlaps, doubled; odd: the piece is the second one */
} overlaps;

/* A link's end at a node. */
typedef struct arm {
    uint32_t link;
    uint32_t end;
} arm;

typedef struct layout {
    pcg_call *call;
    pcg_run *run;
    const street_drawing *drawing;
    street_way *way; /* of the drawing, with what was overridden */
    bool sidewalks;  /* there are any */
    uint8_t *kind;   /* of each vertex: a node_kind */
    street_link *link;
    uint32_t links, link_capacity;
    pcg_vec3 *point;   /* of all links */
    uint32_t *link_of; /* of each point; its piece lies behind it, the last has none */
    double *arc;       /* of each point: how far from the link's begin */
    pcg_vec2 *border[BANDS][SIDES];
    uint32_t points, point_capacity;
    uint32_t *arm_begin;      /* of each vertex, in `arm`; one more than there are vertices */
    arm *arm;                 /* by vertex, counter-clockwise */
    uint32_t *cluster[BANDS]; /* of each vertex: a vertex that stands for the cluster (see below) */
    overlaps overlaps[BANDS];
} layout;

/* ---- links.c --------------------------------------------------------------------------------- */

/* Finds links and arms, and draws borders. What has no width is no street. Closed in any case.
 * Status. */
int layout_open(pcg_call *call, const street_drawing *d, street_way *way, layout *l);
void layout_close(layout *l);
static inline uint32_t link_last(const street_link *k)
{
    return k->points - 1;
}
static inline double link_length(const layout *l, const street_link *k)
{
    return l->arc[k->first + link_last(k)];
}
/* The place of a station on a border, on the centre line, and how far along the link. */
pcg_vec2 border_at(const layout *l, int band, int side, const street_link *k, double station);
pcg_vec3 center_at(const layout *l, const street_link *k, double station);
double arc_at(const layout *l, const street_link *k, double station);
/* Where an end of a link points to, leaving its node; of length 1. */
pcg_vec2 arm_direction(const layout *l, arm a);
/* The border that is on the left of who leaves a node along an arm, at the node (or the right). */
pcg_vec2 arm_border(const layout *l, int band, arm a, int side);

/* ---- overlaps.c ------------------------------------------------------------------------------ */

/* Finds which pieces of a band overlap: of links on one level, or with a node in common. Status. */
int layout_find_overlaps(layout *l, int band);

/* ---- clusters.c ------------------------------------------------------------------------------ */

/* Finds clusters and stations of a band. Status. */
int layout_find_clusters(layout *l, int band);
/* The vertex that stands for a vertex's cluster. */
uint32_t cluster_of(const layout *l, int band, uint32_t vertex);

/* ---- crossings.c ----------------------------------------------------------------------------- */

typedef struct crossings {
    uint32_t count;
    uint32_t *number;  /* of each vertex: its cluster's crossing + 1; 0: none */
    uint32_t *cluster; /* of each crossing: the vertex that stands for it */
    polygons *area;    /* of each crossing */
    uint32_t room;
} crossings;

/* What the clusters of a band cover beside the streets. Status; to be closed in any case. */
int crossings_open(const layout *l, int band, crossings *c);
void crossings_close(const layout *l, crossings *c);
/* Adds what a link covers between two stations as a loop that turns left, or right. Status. */
int link_outline(const layout *l, int band, const street_link *k, double from, double to,
                 bool reversed, polygons *out);
/* What clusters of corridors cover beside roadways: the corners of sidewalks. Status. `corner` has
 * the same numbers as `corridor`. */
int corners_open(const layout *l, const crossings *roadway, const crossings *corridor,
                 crossings *corner);

/* ---- lots.c ---------------------------------------------------------------------------------- */

/* The faces of the ground that streets and crossings of a band enclose. Status. */
int lots_find(const layout *l, int band, const crossings *c, polygons *lots);

#endif

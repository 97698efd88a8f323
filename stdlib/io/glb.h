/* glb.h - a glTF binary while it is made: what glb.c plans and streams, and glb_json.c writes
 * down.
 *
 * One root node per output, named like it. Up to IO_GLB_NODES_MAX entities (or always, where the
 * option `entities` is set), each entity is a child of its output's node: named by the node that
 * made it, its attributes in `extras`. With more, the output's node has one mesh with a primitive
 * per material; more than IO_GLB_LOOKS_MAX materials become fewer: plain ones that differ in their
 * colour alone are one, and the vertices have the colours, but for what much has. Shapes that share
 * mesh, size and material share one mesh under nodes with transforms. The world's z becomes glTF's
 * y.
 */
#ifndef PCG_GLB_H
#define PCG_GLB_H

#include "stdlib/io/io.h"

#define GLB_NONE UINT32_MAX

/* As glTF numbers them. */
typedef enum glb_mode { GLB_POINTS = 0, GLB_LINES = 1, GLB_TRIANGLES = 4 } glb_mode;

typedef struct glb_node {
    const char *name;
    const char *extras;          /* JSON; NULL: none */
    uint32_t mesh;               /* as planned; GLB_NONE: none */
    const pcg_scope *scope;      /* where a mesh that is shared stands; NULL: as it is */
    bool output;                 /* a root: the nodes up to the next root are its children */
} glb_node;

/* Of one shape, or (shape NULL) of all shapes of an output. */
typedef struct glb_mesh {
    const pcg_shape *shape;
    const char *name;
    uint32_t output;
    bool shared;                 /* by several nodes: in its scope's frame */
    uint32_t first, count;       /* primitives */
    uint32_t written;            /* its number in the file; GLB_NONE: nothing of it is left */
} glb_mesh;

typedef struct glb_view {        /* of the buffer */
    uint64_t offset, size;
    uint32_t stride;             /* of vertices; 0 */
    bool vertices, indices;      /* neither: an image */
} glb_view;

typedef struct glb_primitive {
    glb_mode mode;
    uint32_t material;           /* its number in the file */
    uint32_t vertices, indices;  /* views; indices may be GLB_NONE */
    uint32_t vertex_count, index_count, stride;
    bool wide;                   /* indices of 4 bytes, not 2 */
    bool colored;                /* a colour stands where uv would, or behind the position */
    float low[3], high[3];
} glb_primitive;

typedef struct glb_image {
    const char *path;
    const unsigned char *bytes;
    size_t size;
    io_image_kind kind;
    bool alpha;
    uint32_t view;
} glb_image;

/* A primitive while it grows. */
typedef struct glb_bucket {
    io_batch batch;
    glb_mode mode;
    struct glb_material *material;
    bool two_sided, textured, colored;
    bool touched;                /* by the mesh that is being streamed */
} glb_bucket;

typedef struct glb_material {
    const pcg_material *look;
    struct glb_material *common; /* of all that differ in colour alone; NULL: none is needed */
    uint32_t members;            /* of such a one */
    bool colored;                /* it is such a one: its colours are those of the vertices */
    uint32_t image;              /* GLB_NONE: none */
    uint64_t corners;            /* of faces that have it */
    uint32_t written[2][2];      /* numbers in the file, by two_sided and textured; or GLB_NONE */
    glb_bucket *triangles[2][2]; /* by two_sided and textured; NULL at first */
    glb_bucket *lines, *points;
} glb_material;

typedef struct glb_written {     /* a material in the file */
    const glb_material *material;
    bool two_sided, textured;
} glb_written;

typedef struct glb {
    io_job *job;
    arena *arena;
    io_output *out;
    bool by_entity, planned;
    io_tessellator tessellator;
    io_stamps *stamps;
    LIST(glb_node) nodes;
    LIST(glb_mesh) meshes;
    LIST(glb_view) views;
    LIST(glb_primitive) primitives;
    LIST(glb_image) images;
    LIST(glb_written) written;
    io_pointers looks;
    LIST(glb_material *) materials; /* by number of the look */
    table commons;               /* by all but the colour: glb_material */
    LIST(glb_bucket *) touched;
    uint32_t *mesh_slots, mesh_slot_count; /* meshes by what they share: open addressing */
    const pcg_mesh *last_mesh;   /* that was asked whether it is closed, and the answer */
    bool last_closed;
    uint16_t *narrow;            /* indices on their way to 2 bytes */
    uint32_t narrow_capacity;
    /* The binary part: held in memory while it is small, so that the text before it fits
     * exactly; then streamed behind room that is kept for the text. */
    LIST(struct glb_piece { unsigned char *bytes; size_t size; }) held;
    uint64_t binary_size;
    bool streaming;
    uint64_t text_room;
    uint64_t primitives_expected, vertices_expected;
    uint32_t materials_expected;
    io_extent extent;
} glb;

/* The text of the file, as far as it is known now. */
void glb_json(const glb *g, text *out);
/* About how long it will be at the end, rather more. */
uint64_t glb_json_estimate(const glb *g);

#endif

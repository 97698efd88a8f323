/* io.h - what the writers of results share: a job, its output files, images, triangles.
 *
 * pcg_run_write makes a job, hands it to the writer of the format and ends it. All memory of a
 * write is the job's arena: running out of it jumps to the job's owner. Whatever else goes wrong
 * is noted on the job (io_fail) and ends it early: from then on outputs swallow what they are
 * given, loops ask io_stopped now and then, and no file is left behind. So writers need no error
 * paths of their own.
 */
#ifndef PCG_IO_H
#define PCG_IO_H

#include "runtime/interrupt.h"
#include "runtime/result.h"

enum {
    IO_GLB_NODES_MAX = 2000,              /* entities with a node each; above, a port is a mesh */
    IO_GLB_LOOKS_MAX = 64,                /* materials; above, colours go to the vertices there */
    IO_IMAGE_SIDE_MAX = 16384,            /* pixels, of an image that is read */
    IO_IMAGE_PIXELS_MAX = 64 << 20,
    IO_IMAGE_BYTES_MAX = 256 << 20,       /* of an image file */
    IO_PICTURE_SIDE_MAX = 8192,           /* of a picture that is written */
    IO_PICTURE_PIXELS_MAX = 16 << 20,
    IO_THREADS_MAX = 64
};

/* ---- jobs ------------------------------------------------------------------------------------ */

typedef struct io_job {
    arena memory;                         /* with on_failure set */
    jmp_buf out_of_memory;
    pcg_run *run;
    const pcg_module *module;
    pcg_write_options options;            /* complete: no zeros left for defaults */
    pcg_status status;                    /* of what failed first; PCG_STATUS_OK: nothing did */
    struct io_output *outputs;            /* the newest first: what was opened first appears last */
    pcg_triangulator *triangulator;       /* made when first asked for */
    void *png, *jpeg;                     /* libraries, opened when first used */
} io_job;

/* Notes the first failure, as what pcg_run_error returns. */
void io_fail(io_job *j, pcg_status status, const char *format, ...) PRINTF_LIKE(3, 4);
/* Whether there is no use in going on: something failed, or the run was cancelled. */
bool io_stopped(io_job *j);
/* Never NULL: without memory for it, jumps. */
pcg_triangulator *io_triangulator(io_job *j);
/* The shape that an entity is; NULL where it has no geometry. */
const pcg_shape *io_shape(const pcg_entity *e);
/* The streets of an entity that is a network; NULL where it is none. */
const struct street_drawing *io_network(const pcg_entity *e);
/* Entities over all outputs. */
uint64_t io_entity_count(const io_job *j);
/* Where the scopes of shapes are, and what to take off world coordinates before they become
 * floats: whole metres, zero unless the world is so far away from its origin that floats would
 * be coarse. */
/* Far inside what single precision holds: what stands further away is left out. */
#define IO_FARTHEST_PLACE 1e37

typedef struct io_extent {
    pcg_vec3 low, high;
    bool any;
} io_extent;
void io_extent_add(io_extent *e, const pcg_shape *s);
pcg_vec3 io_extent_center(const io_extent *e);

/* Replaces bytes that are no UTF-8 by '?': JSON has to be. */
void io_repair_utf8(char *bytes, size_t length);

/* Pointers, numbered in the order in which they were met. */
typedef struct io_pointers {
    const void **at;
    uint32_t count;
    uint32_t *slots, slot_count;
    uint32_t last;                        /* that was asked for */
} io_pointers;
/* A pointer's number; it is added where it is new: the number is then the old count. */
uint32_t io_pointer_number(arena *a, io_pointers *t, const void *p);

/* What a face looks like; face UINT32_MAX: the shape's edges and points. Never NULL. */
const pcg_material *io_material(const pcg_shape *s, uint32_t face);

/* How many threads share a job's work, the caller's among them: what the options say, or one a
 * processor. */
uint32_t io_threads(const io_job *j);
/* Does items 0 … count-1 by several threads, each of which has a number below io_threads; returns
 * when all are done, or, where the run was cancelled, those that were begun. Workers must not
 * touch the job: its memory and its failures are the caller's. */
typedef void io_work(void *context, uint32_t thread, uint32_t item);
void io_parallel(io_job *j, uint32_t count, io_work *work, void *context);

/* The writers. Each opens its outputs itself, but ends none. */
void io_write_glb(io_job *j, const char *path);
void io_write_obj(io_job *j, const char *path);
void io_write_json(io_job *j, const char *path);
void io_write_csv(io_job *j, const char *path);
void io_write_picture(io_job *j, const char *path);

/* ---- output files ---------------------------------------------------------------------------- */

/* A file that appears under its name only when the whole job went well: until then it has
 * another name beside it. "-" is stdout; it and what is no regular file (a pipe, a device) are
 * written as they come. */
typedef struct io_output {
    io_job *job;
    struct io_output *next;
    const char *path;                     /* as given, for messages */
    const char *target, *temporary;       /* NULL: written as it comes */
    interrupt_file unfinished;            /* tells of it while `temporary` is its name */
    int file;                             /* -1: closed */
    unsigned char *buffer;
    size_t used;
    uint64_t flushed;                     /* bytes that went to the file */
} io_output;

/* Never NULL; what went wrong is noted on the job. */
io_output *output_open(io_job *j, const char *path);
void output_bytes(io_output *o, const void *bytes, size_t size);
void output_text(io_output *o, const char *string);
/* Bytes written so far. */
uint64_t output_position(const io_output *o);
/* Whether output_patch can be used. */
bool output_patchable(const io_output *o);
/* Replaces bytes that were written before. */
void output_patch(io_output *o, uint64_t position, const void *bytes, size_t size);
/* Moves what was written from a position on, to make room there. */
void output_shift(io_output *o, uint64_t position, uint64_t by);
/* Flushes and closes everything and gives the files their names, the newest first, so that a
 * file that refers to others is the last to appear; removes them where the job failed. */
void outputs_end(io_job *j);
/* The same in a job that has no memory left, or none of whose outputs may stay. */
void outputs_discard(io_job *j);

/* ---- images ---------------------------------------------------------------------------------- */

typedef struct io_image {
    uint32_t width, height;
    unsigned char *pixels;                /* 4 each: sRGB, alpha, not multiplied; from the top */
    bool opaque;                          /* every alpha is 255 */
} io_image;

typedef enum io_image_kind { IO_IMAGE_OTHER, IO_IMAGE_PNG, IO_IMAGE_JPEG } io_image_kind;

/* What the first bytes say. */
io_image_kind image_kind(const unsigned char *bytes, size_t size);
/* Decodes a PNG or JPEG file; a large JPEG at a half, a quarter or an eighth of its size where
 * that still has `enough` pixels a side (0: as it is). NULL, or what was wrong with it. */
const char *image_decode(io_job *j, const unsigned char *bytes, size_t size, uint32_t enough,
                         io_image *out);
/* PNG was not left out when this was built. */
bool image_png_built(void);
/* NULL where PNG files can be written, or why not. */
const char *image_png_missing(io_job *j);
/* Writes `pixels`, 3 bytes each, as a PNG file in memory. NULL, or what was wrong. */
const char *image_encode_png(io_job *j, const unsigned char *pixels, uint32_t width,
                             uint32_t height, unsigned char **out, size_t *size);
/* Closes the libraries. */
void image_libraries_close(io_job *j);
/* Reads the file of a texture. NULL, having warned on the run, where that fails or is no image. */
const unsigned char *image_file_read(io_job *j, const char *path, size_t *size);
/* What messages and files call it: its name without the folders, which differ from machine to
 * machine. */
const char *image_file_name(const char *path);
/* A copy of an image file without what is no picture: metadata, previews, colour profiles. NULL
 * where the file is damaged. *alpha: whether it can be transparent. */
const unsigned char *image_file_strip(io_job *j, const unsigned char *bytes, size_t size,
                                      size_t *stripped, bool *alpha);
/* sRGB in 0 … 1 to linear light and back. */
double color_linear(double srgb);
double color_srgb(double linear);

/* ---- triangles ------------------------------------------------------------------------------- */

enum { IO_PLAIN = 6, IO_TEXTURED = 8, IO_BARE = 3 }; /* floats a vertex: position, normal, uv */

/* Vertices and indices as they stand in a file; indices count from the batch's first vertex. */
typedef struct io_batch {
    uint32_t stride;                      /* IO_PLAIN, IO_TEXTURED; IO_BARE for lines and points */
    float *vertices;
    uint32_t *indices;
    uint32_t vertex_count, index_count, vertex_capacity, index_capacity;
    float low[3], high[3];                /* of the first `bounded` vertices */
    uint32_t bounded;
} io_batch;

/* Makes room for so many more. */
void batch_reserve(io_job *j, io_batch *b, uint64_t vertices, uint64_t indices);
/* Takes the vertices that were added since the last time into its bounds. */
void batch_bound(io_batch *b);

/* Turns the faces of one shape after the other to triangles. */
typedef struct io_tessellator {
    io_job *job;
    bool y_up, flip_v;                    /* as glTF has it */
    bool local;                           /* in the scope's frame, not in the world */
    pcg_vec3 center;                      /* of the world, taken off */
    const pcg_shape *shape;
    const pcg_mesh *mesh;
    double rows[3][4];                    /* from the mesh's coordinates to the file's */
    double turn[3][3];                    /* the same for normals */
    double *world;                        /* 3 a vertex of the mesh */
    float *position;
    bool any_bad;                         /* some vertex is not finite … */
    bool *bad;                            /* … this one */
    uint32_t *shared;                     /* where each vertex went in a batch last */
    uint32_t *corners;                    /* of a face's triangles */
    uint32_t vertex_capacity, corner_capacity;
    uint64_t not_finite;                  /* faces, edges and vertices that were left out */
} io_tessellator;

/* Takes up a shape: its vertices go through its scope into the file's space. */
void tessellate_begin(io_tessellator *t, const pcg_shape *s);
/* The same without its vertices: there is room for them, and the matrices are its. */
void tessellate_frame(io_tessellator *t, const pcg_shape *s);
/* Appends a face; returns how many triangles. Faces without an area, and triangles that have two
 * corners in one place, are left out. */
uint32_t tessellate_face(io_tessellator *t, uint32_t face, io_batch *b);
/* The triangles of a face as three corners each, counted from its first: how tessellate_face
 * cuts it; and its normal, of length 1, where there are any. */
uint32_t tessellate_cut(io_tessellator *t, uint32_t face, const uint32_t **corners,
                        double normal[3]);
/* The texture coordinates of a corner of the mesh; zeros where it has none. */
void tessellate_uv(const io_tessellator *t, uint32_t corner, float to[2]);
/* Whether tessellate_face would append something: corners are finite, and there is an area. */
bool tessellate_usable(io_tessellator *t, uint32_t face);
/* Appends a loose edge as two indices to a batch that is bare. */
void tessellate_edge(io_tessellator *t, uint32_t edge, io_batch *b);
/* The vertices that no corner and no edge uses; valid until the next call on the tessellator.
 * Returns how many. */
uint32_t tessellate_loose(io_tessellator *t, const uint32_t **loose);
/* Appends a vertex, without an index, to a batch that is bare. */
void tessellate_point(io_tessellator *t, uint32_t vertex, io_batch *b);
/* Warns about what was left out because it was not finite. */
void tessellate_end(io_tessellator *t);
/* Whether every edge of every face has a neighbour, so that no back face can be seen from
 * outside. */
bool tessellate_closed(const pcg_mesh *m);
/* The most vertices that tessellate_face can append for a face. */
uint32_t tessellate_face_corners(const pcg_mesh *m, uint32_t face);

/* ---- stamps ---------------------------------------------------------------------------------- */

/* The faces of a mesh as they are put down for every shape that has it: one material, flat, and
 * nothing beside them. */
typedef struct io_stamp {
    const pcg_mesh *mesh;
    pcg_vec3 size;                        /* of the scope, where the mesh is a unit one */
    bool usable, closed;                  /* closed: as tessellate_closed says */
    uint32_t vertices, indices, faces, capacity;
    uint32_t *vertex;                     /* of the mesh, by vertex put down */
    float *uv;                            /* 2 each */
    uint32_t *index;
    uint32_t *face_end;                   /* by face: the vertices up to and with it */
    double *normal;                       /* 3 a face, along the scope's axes */
    double shortest;                      /* side of a triangle, in metres */
} io_stamp;

enum { IO_STAMPS = 1024 };
typedef struct io_stamps {
    io_stamp *kept[IO_STAMPS], *other;
} io_stamps;

/* The stamp of a shape; NULL where it has none, and faces go one by one. Valid until the next
 * call. The tessellator has taken up no shape after it. */
const io_stamp *stamp_find(io_stamps *all, io_tessellator *t, const pcg_shape *s);
/* Appends all faces. False where that might give triangles with two corners in one place: nothing
 * is appended. */
bool stamp_put(const io_stamp *k, io_tessellator *t, const pcg_shape *s, io_batch *b);

#endif

/* shape.h - shapes, scopes, meshes, materials: what geometry kernels and writers stand on.
 *
 * A shape is a scope and a mesh in coordinates relative to it. Meshes are shared between shapes
 * and immutable while shared (references > 1): `pcg_shape_edit` gives one that may be changed.
 * World space is right-handed, in metres, z up. A flat shape lies in the x-y plane of its scope,
 * its normal is +z.
 *
 * Other libraries' kernels are compiled with this header: a change of its structs changes
 * PCG_ABI. */
#ifndef PCG_SHAPE_H
#define PCG_SHAPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "abi.h"

/* origin + p.x * axis[0] + p.y * axis[1] + p.z * axis[2]. Axes are orthonormal and right-handed;
 * size is the extent of the mesh along them, in metres, never negative. */
typedef struct pcg_scope {
    pcg_vec3 origin;
    pcg_vec3 axis[3];
    pcg_vec3 size;
} pcg_scope;

/* How a surface looks; interned per run: equal materials are the same pointer. glTF's
 * metallic-roughness model. */
typedef struct pcg_material {
    const char *name;     /* "" when it has none */
    pcg_color color;      /* base colour factor, sRGB */
    const char *texture;  /* absolute path of an image file, or NULL */
    double metallic, roughness;
    bool two_sided;
} pcg_material;

/* Polygonal faces with holes, loose edges and loose vertices, as arrays.
 *
 * face f has the loops face_loop[f] .. face_loop[f+1]-1: the first is its outline
 * (counter-clockwise seen from where its normal points), the others are holes (clockwise). Loop
 * l has the corners loop_corner[l] .. loop_corner[l+1]-1; corner c is at vertex
 * corner_vertex[c]. Loose edges are pairs of vertices. A vertex that no corner and no edge uses
 * is a loose one.
 *
 * `unit`: positions are in 0 … 1 of the scope's size (canonical meshes: a rectangle split in
 * two, or a scaled box, touches no vertex). Otherwise they are metres along the scope's axes
 * from its origin. */
typedef struct pcg_mesh {
    uint32_t references;
    bool unit;
    bool forever;              /* a canonical one: static data, not counted, never edited in place */
    uint32_t vertex_count, face_count, loop_count, corner_count, edge_count;
    uint32_t vertex_capacity, face_capacity, loop_capacity, corner_capacity, edge_capacity;
    pcg_vec3 *position;        /* vertex_count */
    uint32_t *face_loop;       /* face_count + 1 */
    uint32_t *loop_corner;     /* loop_count + 1 */
    uint32_t *corner_vertex;   /* corner_count */
    uint32_t *edge_vertex;     /* 2 * edge_count */
    /* Optional streams: NULL where absent. */
    float *corner_normal;      /* 3 * corner_count, in the scope's axes; absent, or (0, 0, 0): the face's own */
    float *corner_uv;          /* 2 * corner_count; u to the right, v up: (0, 0) is the image's lower left */
    const pcg_material **face_material; /* face_count; NULL in it, or no stream: the shape's */
    uint32_t *face_tag;        /* face_count, from pcg_tag; 0: none */
} pcg_mesh;

struct pcg_shape {
    pcg_entity entity;
    pcg_scope scope;
    pcg_mesh *mesh;
    const pcg_material *material; /* NULL: the default one, plain light grey */
    struct shape_parts *parts;    /* what is known of its parts (runtime/part.h); NULL: none */
};

/* ---- canonical meshes ------------------------------------------------------------------------ */

/* Static, unit: the square (0,0,0)-(1,1,0) as one face; the cube as six: the sides -y +x +y -x
 * in turn, then top, then bottom. */
extern const pcg_mesh pcg_mesh_square, pcg_mesh_cube, pcg_mesh_empty;
/* Parts of the cube: without its bottom; without its top; the sides alone. The tray is what a
 * square that is pushed in leaves: the four sides seen from inside, then the floor at z = 0,
 * facing up; and its sides alone. */
extern const pcg_mesh pcg_mesh_lid, pcg_mesh_cup, pcg_mesh_sides, pcg_mesh_tray, pcg_mesh_reveal;

/* ---- shapes ---------------------------------------------------------------------------------- */

/* A new shape descending from `ancestor` (NULL: from the round), with its material and scope
 * where it is a shape, an empty mesh otherwise. NULL: out of memory, or over the entity limit;
 * the caller returns PCG_FAILED. */
pcg_shape *pcg_shape_new(pcg_call *c, const pcg_entity *ancestor);
/* The same, of a type that derives from Shape; what lies behind the pcg_shape is zero. */
pcg_shape *pcg_shape_new_of(pcg_call *c, const pcg_type *type, const pcg_entity *ancestor);
/* Puts a mesh in; takes over one reference to it, gives up the old one's. */
void pcg_shape_set_mesh(pcg_run *r, pcg_shape *s, pcg_mesh *m);
/* The shape's mesh, for itself alone and in metres: edited freely. NULL: out of memory. */
pcg_mesh *pcg_shape_edit(pcg_run *r, pcg_shape *s);
/* A vertex in metres along the scope's axes (its own frame), and in the world. */
pcg_vec3 pcg_shape_local(const pcg_shape *s, uint32_t vertex);
pcg_vec3 pcg_shape_world(const pcg_shape *s, uint32_t vertex);
/* Moves origin and size so that the scope is the bounding box of the mesh along its axes (and
 * the mesh starts at 0). Kernels call it after editing positions. */
int pcg_shape_fit(pcg_run *r, pcg_shape *s);
/* Expresses the mesh in other axes without moving it in the world, then fits. */
int pcg_shape_align(pcg_run *r, pcg_shape *s, const pcg_vec3 axis[3]);
/* Splits off one face as a shape of its own, with a scope on the face: z its normal, x along the
 * longest bottom edge (horizontal where the face is not), y up the face; on a level face x and y
 * follow the parent's scope. */
pcg_shape *pcg_shape_face(pcg_call *c, const pcg_shape *s, uint32_t face);
/* The faces in `faces` (count of them, ascending) as one shape with the scope's axes kept,
 * fitted. */
pcg_shape *pcg_shape_faces(pcg_call *c, const pcg_shape *s, const uint32_t *faces, uint32_t count);
/* Appends all of `from`, as it stands in the world, to `to`'s mesh; materials and streams
 * travel. Status. */
int pcg_shape_append(pcg_run *r, pcg_shape *to, const pcg_shape *from);
const pcg_material *pcg_shape_face_material(const pcg_shape *s, uint32_t face); /* never NULL */

/* ---- meshes ---------------------------------------------------------------------------------- */

pcg_mesh *pcg_mesh_new(pcg_run *r, bool unit);
pcg_mesh *pcg_mesh_hold(const pcg_mesh *m);
void pcg_mesh_drop(pcg_run *r, pcg_mesh *m);
pcg_mesh *pcg_mesh_copy(pcg_run *r, const pcg_mesh *m);
/* Makes room for that many more of each. Status. */
int pcg_mesh_reserve(pcg_run *r, pcg_mesh *m, uint32_t vertices, uint32_t faces, uint32_t loops,
                     uint32_t corners);
/* All of these return the index of what they add, or UINT32_MAX when memory has run out. */
uint32_t pcg_mesh_add_vertex(pcg_run *r, pcg_mesh *m, pcg_vec3 p);
uint32_t pcg_mesh_add_face(pcg_run *r, pcg_mesh *m, const uint32_t *vertices,
                           uint32_t count); /* its outline */
uint32_t pcg_mesh_add_hole(pcg_run *r, pcg_mesh *m, const uint32_t *vertices,
                           uint32_t count); /* to the last face */
uint32_t pcg_mesh_add_edge(pcg_run *r, pcg_mesh *m, uint32_t a, uint32_t b);
/* Adds a stream, zeroed, where it is missing. Status. */
int pcg_mesh_need_normals(pcg_run *r, pcg_mesh *m);
int pcg_mesh_need_uvs(pcg_run *r, pcg_mesh *m);
int pcg_mesh_need_materials(pcg_run *r, pcg_mesh *m);
int pcg_mesh_need_tags(pcg_run *r, pcg_mesh *m);
/* The number that stands for a tag in face_tag: a hash of its name, never 0. */
uint32_t pcg_tag(const char *name);
/* Of a face, in the mesh's metres for a shape (unit meshes need the scope): Newell's normal, not
 * normalised, whose length is twice the area, holes taken off. */
pcg_vec3 pcg_shape_face_normal(const pcg_shape *s, uint32_t face); /* along the scope's axes */
double pcg_shape_area(const pcg_shape *s);     /* of all faces */
double pcg_shape_volume(const pcg_shape *s);   /* signed, exact when closed */
uint32_t pcg_shape_holes(const pcg_shape *s);
/* World bounding box; false when there is no vertex. */
bool pcg_shape_bounds(const pcg_shape *s, pcg_vec3 *low, pcg_vec3 *high);

/* Triangles of one face: corner indices, 3 a triangle, into `out`, which has room for 3 *
 * (corners + 2 * holes - 2); they turn the way of the outline. Returns how many triangles; 0 for
 * a degenerate face. Any planar polygon with holes; self-crossing input gives some covering,
 * never a crash. `size`: the scope's, which unit meshes need; NULL: 1. The triangulator is
 * scratch that grows as needed and is reused. */
typedef struct pcg_triangulator pcg_triangulator;
pcg_triangulator *pcg_triangulator_new(void);
void pcg_triangulator_free(pcg_triangulator *t);
uint32_t pcg_triangulate(pcg_triangulator *t, const pcg_mesh *m, uint32_t face,
                         const pcg_vec3 *size, uint32_t *out);

/* ---- materials ------------------------------------------------------------------------------- */

extern const pcg_material pcg_material_default;
/* The run's own copy: equal ones are one pointer. NULL: out of memory. */
const pcg_material *pcg_material_intern(pcg_run *r, const pcg_material *m);

/* ---- vectors --------------------------------------------------------------------------------- */

static inline pcg_vec3 vec3(double x, double y, double z)
{
    return (pcg_vec3){x, y, z};
}
static inline pcg_vec3 vec3_add(pcg_vec3 a, pcg_vec3 b)
{
    return (pcg_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline pcg_vec3 vec3_subtract(pcg_vec3 a, pcg_vec3 b)
{
    return (pcg_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline pcg_vec3 vec3_scale(pcg_vec3 a, double k)
{
    return (pcg_vec3){a.x * k, a.y * k, a.z * k};
}
static inline pcg_vec3 vec3_multiply(pcg_vec3 a, pcg_vec3 b)
{
    return (pcg_vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}
static inline double vec3_dot(pcg_vec3 a, pcg_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline pcg_vec3 vec3_cross(pcg_vec3 a, pcg_vec3 b)
{
    return (pcg_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* What a library calls bears the runtime's prefix. */
#define vec3_length pcg_vec3_length
#define vec3_normal pcg_vec3_normal
double vec3_length(pcg_vec3 a);
pcg_vec3 vec3_normal(pcg_vec3 a); /* of length 1; (0, 0, 0) where `a` has none */
/* p along the scope's axes to the world, and a direction likewise. */
pcg_vec3 pcg_scope_point(const pcg_scope *s, pcg_vec3 p);
pcg_vec3 pcg_scope_direction(const pcg_scope *s, pcg_vec3 d);
pcg_vec3 pcg_scope_local(const pcg_scope *s, pcg_vec3 world);

#endif

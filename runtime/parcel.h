/* parcel.h - entities as bytes: what a cache keeps, and what threads hand on to each other.
 *
 * A parcel holds values, and entities with all that they hold, each once however often it is
 * there, so that what was one entity is one again. Two forms: a local one is unpacked in the
 * process that packed it, and may hold addresses of static data; the other one may be read by
 * another process, and is mistrusted: whatever its bytes are, unpacking it gives entities that
 * kernels can work with, or fails.
 *
 * Attributes are not part of an entity here, since only its graph knows their types: of what they
 * were an entity remembers its `origin`, the number of an entity (in the order of packing) whose
 * attributes it inherits.
 */
#ifndef PCG_PARCEL_H
#define PCG_PARCEL_H

#include "run.h"
#include "shape.h"

#define PARCEL_NONE 0xFFFFFFFFu

enum { PARCEL_DEPTH = 1100 }; /* of entities that hold entities */

/* What of an entity is packed, beside what it holds. */
enum { PARCEL_LOCAL = 1, PARCEL_LINEAGE = 2, PARCEL_KEY = 4 /* of nodes the names: to compare */ };

/* Pointers that were met, numbered: open addressing. */
typedef struct parcel_seen {
    struct parcel_met { const void *at; pcg_u32 number; } *slots;
    pcg_u32 count, capacity;
} parcel_seen;

struct pcg_packer { /* begins with `run`, `flags` and `cell`, otherwise zeroed */
    pcg_run *run;          /* told where memory runs out */
    pcg_u32 flags;
    int cell;              /* the attribute that holds an entity's origin; below 0: none does */
    char *at;              /* what is packed so far; malloc's */
    size_t length, capacity;
    parcel_seen seen;
    pcg_entity **entities; /* that were packed, in their order; borrowed */
    pcg_u32 entity_count, entity_capacity, depth;
    const char *cannot;    /* the type of an entity that cannot be packed; NULL */
};

typedef struct parcel_object {
    void *at;
    int kind;
    bool whole; /* while it is being read, nothing may lead to it */
} parcel_object;

struct pcg_unpacker { /* begins with what is above the line, otherwise zeroed */
    pcg_run *run;
    pcg_u32 flags;
    const char *at, *end;
    const pcg_module *module;      /* whose nodes are meant by their names; not of a local one */
    pcg_entity *const *origins;    /* whose attributes are inherited; NULL: none */
    pcg_u32 origin_count;
    int cell;                      /* gets each entity's own number; below 0: none does */
    /* ---- */
    parcel_object *objects;        /* the run's */
    pcg_u32 object_count, object_capacity;
    pcg_entity **entities;         /* that were made, in the order of packing; borrowed */
    pcg_u32 entity_count, entity_capacity, depth;
    bool failed;                   /* it is no parcel, or memory ran out */
};

/* ---- packing: whatever fails makes the packer fail, which is asked at the end --------------- */

void pack_bytes(pcg_packer *p, const void *bytes, size_t count);
void pack_u32(pcg_packer *p, pcg_u32 number);
void pack_u64(pcg_packer *p, pcg_u64 number);
/* Of the run, or static. NULL is kept apart from "". */
void pack_string(pcg_packer *p, const char *s);
void pack_node(pcg_packer *p, const pcg_node *n);
void pack_material(pcg_packer *p, const pcg_material *m);
/* A value of a kind; `element`: of a list its elements' kind. */
void pack_value(pcg_packer *p, int kind, int element, const pcg_cell *cells);
void pack_entity(pcg_packer *p, const pcg_entity *e);
/* Whether a copy can take an entity's place: not where it is referred to from elsewhere, or holds
 * others that may be. */
bool parcel_is_alone(const pcg_entity *e);
/* For objects of other kinds, which may be shared: true where this one is new, and is to be packed
 * behind. */
bool pack_object(pcg_packer *p, const void *object);
/* Status: PCG_FAILED where memory has run out (the run knows), or an entity cannot be packed
 * (p->cannot tells). */
int pack_status(const pcg_packer *p);
void packer_close(pcg_packer *p);

/* ---- unpacking: behind the end, or where something is wrong, `failed` is set and zeros are read */

void unpack_bytes(pcg_unpacker *u, void *to, size_t count);
pcg_u32 unpack_u32(pcg_unpacker *u);
pcg_u64 unpack_u64(pcg_unpacker *u);
/* A count of what takes at least `size` bytes each, of which so many can still be there. */
pcg_u32 unpack_count(pcg_unpacker *u, size_t size);
const char *unpack_string(pcg_unpacker *u); /* the run's */
const pcg_node *unpack_node(pcg_unpacker *u);
const pcg_material *unpack_material(pcg_unpacker *u);
void unpack_value(pcg_unpacker *u, int kind, int element, pcg_cell *to);
/* One reference to it; NULL: failed. */
pcg_entity *unpack_entity(pcg_unpacker *u);
/* What pack_object has numbered. True: it is new, and follows; *number then is for unpack_made.
 * Otherwise *object is it, or NULL where that failed. */
bool unpack_object(pcg_unpacker *u, int kind, pcg_u32 *number, void **object);
void unpack_made(pcg_unpacker *u, pcg_u32 number, void *object);
/* Gives up what the unpacker itself holds. */
void unpacker_close(pcg_unpacker *u);

enum { PARCEL_STRING, PARCEL_NODE, PARCEL_MATERIAL, PARCEL_MESH, PARCEL_ENTITY };

/* ---- types ---------------------------------------------------------------------------------- */

/* The type of that name among those that are built in; NULL. Defined where all of them are known.
 */
const pcg_type *parcel_type(const char *name);

/* For pcg_type_shape, and for types of other libraries that begin with a pcg_shape. */
int pcg_shape_pack(pcg_packer *p, const pcg_entity *e);
int pcg_shape_unpack(pcg_unpacker *u, pcg_entity *e);

#endif

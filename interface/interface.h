/* interface.h - procedure libraries as the compiler sees them, and what is written from
 * interface blocks.
 *
 * A library is a folder of C files, one for each procedure, or family of functions. A kernel
 * file begins with a block that holds its interface in the language itself: a comment whose
 * first line is slash, star, pcg. The interface is the only place where a signature stands. It
 * is carried as text: a library is a list of interface texts with an index of the names that
 * they declare, and the addresses of the kernels' symbols. The compiler parses the few that a
 * program uses. What has no kernel stands in library.pcg beside them: the library's
 * documentation (its //! lines), entities, enumerations. */
#ifndef PCG_INTERFACE_H
#define PCG_INTERFACE_H

#include "../lang/lang.h"
#include "../runtime/library.h"

/* The libraries that are built in, ended by NULL: made when the project is built. */
extern const pcg_library *const library_builtin[];

/* The first entry of that name and kind, or NULL; overloads of a function follow it. */
const library_entry *library_find(const pcg_library *l, const char *name, library_entry_kind kind);

/* abi.h as it stands, for the head of emitted C. */
extern const char pcg_abi_text[];
/* The functions and variables that abi.h declares, sorted by name: what emitted C may name
 * beside kernels. A variable's address is cast to the type of a function's. */
extern const library_symbol pcg_abi_symbols[];
extern const uint32_t pcg_abi_symbol_count;

/* Finds the interface block of a kernel file: its text (in the arena) and first line; false
 * where it has none. */
bool interface_extract(arena *a, const source *file, const char **block, uint32_t *line);

/* ---- names in C ------------------------------------------------------------------------------ */

/* pcg_geometry_split: the struct and the kernel of a procedure. */
const char *interface_procedure_symbol(arena *a, const char *library, const char *procedure);
/* pcg_core_fn_min_int_int: the kernel of a function, by its parameters' types as written
 * (list<int>: list_int; any[]: anys; a type variable: its bound). */
const char *interface_function_symbol(arena *a, const char *library, const tree_function *f);
/* pcg_zoning_type_Zone: the description of an entity type. */
const char *interface_type_symbol(arena *a, const char *library, const char *entity);
/* PCG_AXIS_X: an enumerator. */
const char *interface_constant(arena *a, const char *enumeration, const char *enumerator);
/* PCG_GEOMETRY_SPLIT_ABSOLUTE: a kind of augmentation. */
const char *interface_kind_constant(arena *a, const char *library, const char *procedure,
                                    const char *augment);
/* The name as a C identifier that collides with no keyword: what the fields are called. Bytes
 * that no identifier holds become _xx. */
const char *interface_field(arena *a, const char *name);

/* ---- what is written ------------------------------------------------------------------------- */

/* Tells apart what a type name means: interfaces name enumerations and entities that other files
 * declare. */
typedef struct interface_types {
    void *context;
    bool (*is_enumeration)(void *context, const char *name);
    bool (*is_entity)(void *context, const char *name);
} interface_types;

/* Whether the name is a type of value that the language has from the start: int, length, list,
 * any, … */
bool interface_is_value_type(const char *name);

/* The struct (and the kinds of its augmentations) and the prototype of one procedure in C, as
 * its kernel's header and emitted C both hold it; the prototype of a function; an enumeration's
 * constants. `before` stands before the prototype: "", or "typedef ", which makes the kernel's type
 * of it. */
void interface_write_procedure(text *out, const char *library, const tree_procedure *p,
                               const char *before, const interface_types *types);
void interface_write_function(text *out, const char *library, const tree_function *f,
                              const char *before, const interface_types *types);
void interface_write_enumeration(text *out, const char *library, const tree_enumeration *e);

#endif

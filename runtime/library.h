/* library.h - what a procedure library says of itself.
 *
 * A library is carried as text: a list of interface texts with an index of the names that they
 * declare, and the addresses of the kernels' symbols. Those that are built in are listed in
 * library_builtin; any other is a shared object that `pcgc library` made, whose one exported symbol
 * is `const pcg_library pcg_described`. The generator writes these tables; nobody else does.
 */
#ifndef PCG_LIBRARY_H
#define PCG_LIBRARY_H

#include <stddef.h>
#include <stdint.h>

#include "abi.h"

#define PCG_LIBRARY_SYMBOL "pcg_described"

typedef struct library_file {
    const char *path;   /* relative to the library's parent: geometry/split.c */
    uint32_t line;      /* where the text begins in that file, from 1 */
    const char *text;   /* the block, without its first and last line */
} library_file;

typedef enum library_entry_kind {
    ENTRY_PROCEDURE, ENTRY_FUNCTION, ENTRY_ENTITY, ENTRY_ENUMERATION
} library_entry_kind;

typedef struct library_entry { /* sorted by name, then kind, then file */
    const char *name;
    library_entry_kind kind;
    uint32_t file;
    const char *former_of; /* the name is one from before a rename: today's; else NULL */
} library_entry;

typedef struct library_symbol { /* sorted by name */
    const char *name;
    void (*address)(void);
    pcg_u64 layout; /* a hash of its struct or prototype, and of the library's enumerations */
} library_symbol;

/* An entity type of a library that is not built in: sorted by name. */
typedef struct library_entity {
    const char *name, *parent; /* as declared */
    const pcg_type *type;
} library_entity;

typedef struct pcg_library {
    pcg_u32 abi, size;    /* PCG_ABI, sizeof(pcg_library) */
    const char *name, *document;
    const char *version;  /* of the generator */
    const library_file *files;
    const library_entry *entries;
    const library_symbol *symbols;
    const library_entity *types;
    uint32_t file_count, entry_count, symbol_count, type_count;
} pcg_library;

#endif

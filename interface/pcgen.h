/* pcgen.h - the generator: reads the interface blocks of procedure libraries, checks them, and
 * writes what is made of them. The build runs it as pcgen, for the libraries that are built in;
 * `pcgc library` calls it for one that is not. */
#ifndef PCG_PCGEN_H
#define PCG_PCGEN_H

#include "interface.h"

/* A file that holds an interface: a kernel file with a block, or library.pcg, which is one as a
 * whole. */
typedef struct pcgen_file {
    const char *path;     /* relative to the library's parent: geometry/split.c */
    const char *name;     /* split */
    const char *block;
    uint32_t line;        /* where the block begins in the file, from 1 */
    tree_file *tree;
} pcgen_file;

typedef struct pcgen_library {
    const char *name, *document;
    LIST(pcgen_file *) files; /* by name */
} pcgen_library;

typedef LIST(const char *) pcgen_names;

typedef struct pcgen_symbol {
    const char *name;
    uint64_t layout;          /* as library_symbol has it */
} pcgen_symbol;

typedef struct pcgen_example {
    const char *name;         /* of its graph, and of its file without extension */
    span span;                /* in the interface */
    text graph;               /* with lines //? for what it expects */
} pcgen_example;

typedef struct pcgen {
    arena arena;
    diagnostics diagnostics;
    const char *output;       /* the folder that everything is written to */
    const char *program;      /* that is running, as it calls itself on stderr */
    const char *version;      /* of pcgc */
    bool foreign;             /* not built in: it includes <pcg/…>, and describes itself */
    LIST(pcgen_library *) libraries;
    LIST(pcgen_library *) known; /* built in, where the one that is read is not */
    LIST(pcgen_example) examples;
    table enumerations;       /* by name: tree_enumeration */
    table entities;           /* by name: tree_entity */
    interface_types types;
    bool failed;              /* a file could not be read or written; that was said on stderr */
} pcgen;

/* Sets what the functions below need, but for the arena's `on_failure`. */
void pcgen_begin(pcgen *g, const char *program, const char *output);
/* Says what errno says of a file; nothing good comes of the run any more. */
void pcgen_fail(pcgen *g, const char *path);

/* The names in a folder that end so, sorted. */
pcgen_names pcgen_list_folder(pcgen *g, const char *folder, const char *end);
/* pcgen_read.c: adds a library with the interfaces of its files; files without one are passed
 * over. `name` NULL: the folder's. */
void pcgen_read_library(pcgen *g, const char *folder, const char *name);
/* What a library that is built in declares can be named in the interfaces. */
void pcgen_know_library(pcgen *g, const pcg_library *l);

/* pcgen_check.c: reports what is wrong in any interface to the diagnostics. */
void pcgen_check(pcgen *g);

/* pcgen_write.c: <library>/<file>.h and enumerations.h. */
void pcgen_write_headers(pcgen *g);
/* Writes a file below the output folder, unless it holds exactly that already. */
void pcgen_write_file(pcgen *g, const char *path, const text *content);
/* A string literal of C, a source line a line; free of trigraphs. */
void pcgen_write_string(text *out, const char *string);

/* pcgen_registry.c: registry.c, which defines library_builtin. */
void pcgen_write_registry(pcgen *g);
/* described.c, which defines pcg_described: the only library that was read. */
void pcgen_write_description(pcgen *g);

/* pcgen_abi.c: abi_text.c and abi_symbols.c, from abi.h. */
void pcgen_write_abi(pcgen *g, const char *path);

/* pcgen_example.c: a graph for each example of a procedure, and one for those of a file's
 * functions, into `examples`; and as files examples/…. */
void pcgen_make_examples(pcgen *g);
void pcgen_write_examples(pcgen *g);

#endif

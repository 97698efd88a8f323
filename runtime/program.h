/* program.h - programs: a module, and who owns its code. */
#ifndef PCG_PROGRAM_INTERNAL_H
#define PCG_PROGRAM_INTERNAL_H

#include "abi.h"
#include "base/base.h"
#include "library_open.h"
#include "pcg.h"

/* The compiler, where there is one: what surrogates load graphs and procedures by. */
typedef struct program_loader {
    pcg_program *(*compile_file)(const char *path, const pcg_compile_options *options);
    pcg_program *(*compile_text)(const char *text, size_t length, const char *name,
                                 const pcg_compile_options *options);
    const char *const *import_paths, *const *library_paths; /* NULL-terminated; NULL: none */
} program_loader;

struct pcg_program {
    const pcg_module *module;
    const program_loader *loader;  /* in the arena; NULL: nothing can be compiled */
    void (*release)(void *owned);
    void *owned;
    pcg_code **kernels;            /* as the module lists them; NULL until program_link */
    open_library **libraries;      /* that they are of, each held once */
    uint32_t library_count;
    struct cache_store *cache;     /* what its runs have kept; NULL: no memory for it */
    bool observed;                 /* the code tells of its rounds: emit_options.observed */
    const char *folder;            /* of the file that the code came from, absolute; NULL: none */
    arena arena;                   /* of the messages and the folder */
    LIST(pcg_message *) messages; /* of the compilation: every run begins with them */
};

/* A program over a module. `release(owned)` is called when it is freed (the compiler gives up the
 * code it made, the loader closes its library); `release` may be NULL. When NULL is returned (no
 * memory, or the module is of another ABI) nothing was taken over. */
pcg_program *program_new(const pcg_module *module, void (*release)(void *owned), void *owned);
/* The file that the program's code came from: paths that are not found where the graph was compiled
 * are looked up beside it. False: no memory. */
bool program_set_file(pcg_program *p, const char *path);
/* Looks up the module's kernels: in the `count` libraries that the caller has open, then in those that
 * the search finds. Needed before the first run; nothing to do for a module that lists none. False,
 * and search->why, where one cannot be had. */
bool program_link(pcg_program *p, open_library *const *known, size_t count,
                  library_search *search);
/* Keeps a copy of the loader and of its paths. False: no memory. Before the first run. */
bool program_set_loader(pcg_program *p, const program_loader *l);
/* Keeps a copy of a message of the compilation (a warning), for result_message. False: no memory.
 * Before the first run. */
bool program_add_message(pcg_program *p, const pcg_message *m);

#endif

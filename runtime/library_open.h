/* library_open.h - finding libraries that are not built in, opening them, and looking up what a
 * module takes from them.
 *
 * A library is open while anyone holds it: a compilation that uses it, a program that calls it.
 */
#ifndef PCG_LIBRARY_OPEN_H
#define PCG_LIBRARY_OPEN_H

#include <stdatomic.h>
#include <stdbool.h>

#include "library.h"

enum { LIBRARY_PATH_BYTES = 4096 };

typedef struct open_library {
    const pcg_library *library;
    void *handle;           /* of dlopen */
    atomic_uint references;
    char path[];            /* as it was found */
} open_library;

/* Where libraries are looked for: in the folder, on the paths, on PCG_LIBRARY_PATH (folders
 * separated by colons), where the runtime is installed. The first that is there counts. */
typedef struct library_search {
    const char *folder;       /* of the graph; "": the current one */
    const char *const *paths; /* ended by NULL; NULL: none */
    char why[2 * LIBRARY_PATH_BYTES]; /* what the last call has to say where it failed */
} library_search;

/* Whether a library can be called so: a letter, then letters, digits and underscores. */
bool library_is_name(const char *name);
/* Finds NAME.so. False, and `why` names the places, where there is none. */
bool library_locate(library_search *s, const char *name, char path[LIBRARY_PATH_BYTES]);
/* Opens the library in that file and checks that it is NAME, made for this runtime and sound. The
 * caller holds it. NULL: `why`. */
open_library *library_open(library_search *s, const char *name, const char *path);
open_library *library_hold(open_library *l); /* one more reference */
void library_close(open_library *l);         /* one less; NULL is allowed */
/* Whether the path leads to the file that was opened. */
bool library_is_file(const open_library *l, const char *path);

/* The symbol of that name, or NULL where there is none. */
const library_symbol *library_find_symbol(const pcg_library *l, const char *symbol);

/* Why the system's loader would not survive that file, or NULL: it is none of its kind, or is cut
 * short. */
const char *library_unsound(const char *path);
/* The runtime's symbols are there for what is opened: where a host opened libpcgrt.so for itself
 * alone (as scripting languages do) they are made visible. False: there is no way. */
bool library_show_runtime(void);

#endif

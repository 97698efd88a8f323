/* command_library.h - what the parts of `pcgc library` share. */
#ifndef PCG_COMMAND_LIBRARY_H
#define PCG_COMMAND_LIBRARY_H

#include "../interface/pcgen.h"
#include "../runtime/library_open.h"
#include "tool.h"

typedef struct building {
    pcgen generator;
    jmp_buf out_of_memory;
    const char *folder, *name, *output;
    const char *cc, *flags;
    option_texts includes, libraries;
    bool debug, test, skeleton;
    interrupt guard;
    char place[64];           /* the private folder that everything is made in; "": none yet */
    const char *headers;      /* the folder in it that the generated headers are in */
    interrupt_file place_kept, headers_kept;
    const char *made;         /* the shared object in it */
} building;

/* command_library_build.c: compiles the folder's C files with the generated ones and links them:
 * `made`. False: it was told why. */
bool library_build(building *b);
/* command_library_test.c: runs the examples with what was made; prints "N passed, N failed". An
 * exit code. */
int library_test(building *b);
/* command_library_new.c: writes a small library into a folder, over nothing that is there. An exit
 * code. */
int library_skeleton(const char *folder, const char *name);

#endif

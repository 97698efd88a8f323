/* closure.h - a graph with all that it encapsulates, as caches and threads see it. */
#ifndef PCG_COMPILER_CLOSURE_H
#define PCG_COMPILER_CLOSURE_H

#include "program.h"

typedef struct closure {
    const char *digest; /* of the text of all these graphs: changes with each change of one */
    const char *tied;   /* why what one execution does may depend on another; NULL: it does not */
    bool loads;         /* a surrogate in it computes the name of what it runs */
} closure;

/* Of a checked graph as an encapsulated one. Texts are the program's. */
closure closure_of(const program *p, const graph *g);

#endif

/* precedence.h - a growing relation "comes before" that never becomes cyclic.
 *
 * Vertices are numbers. Each keeps a position such that what must come before stands before; an
 * addition that the positions contradict moves only what lies between its two ends (Pearce and
 * Kelly, "A dynamic topological sort algorithm for directed acyclic graphs", 2006).
 */
#ifndef PCG_COMPILER_PRECEDENCE_H
#define PCG_COMPILER_PRECEDENCE_H

#include "../runtime/base/base.h"

#define PRECEDENCE_NONE UINT32_MAX

typedef struct precedence_link {
    uint32_t from, to;
    uint32_t next_out, next_in; /* links of the same `from`, of the same `to`; or PRECEDENCE_NONE */
} precedence_link;

typedef struct precedence {
    arena *arena;
    uint32_t count;
    uint32_t *position; /* of each vertex */
    uint32_t *at;       /* the vertex at each position */
    uint32_t *out, *in; /* newest link of each vertex, or PRECEDENCE_NONE */
    LIST(precedence_link) links;
    bool *marked; /* of the two searches; all false between calls */
    LIST(uint32_t) before, after, slots;
} precedence;

/* `count` vertices; `at` holds them in an order that the first additions had better agree with.
 * It is taken over. */
precedence precedence_new(arena *a, uint32_t *at, uint32_t count);
/* Demands `from` before `to`. False, and nothing is demanded, where `to` already comes before
 * `from`. */
bool precedence_add(precedence *p, uint32_t from, uint32_t to);

#endif

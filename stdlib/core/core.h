/* core.h - what the kernels of this library share. */
#ifndef PCG_STDLIB_CORE_H
#define PCG_STDLIB_CORE_H

#include <stddef.h>
#include "runtime/abi.h"

/* Call sites of random numbers that kernels draw themselves begin here: those below belong to the
 * random functions in the node's expressions, so that the two never draw the same number. */
enum { CORE_RANDOM_SITE = 0x40000000 };

/* A number that is in order where the values are: they are none that are no number; -0 is 0. */
pcg_u64 core_float_word(double value);

/* ---- lists ----------------------------------------------------------------------------------- */

enum { CORE_LIST_MAX = 1 << 28 };

/* A list of the run's for `count` elements of one cell, zeroed. NULL when memory has run out, or
 * there would be more than CORE_LIST_MAX elements; that ends the run. */
pcg_list *core_list_new(pcg_call *call, pcg_u64 count);
/* The list without elements: what a function returns when it has no other. */
extern const pcg_list core_list_empty;

/* ---- text ------------------------------------------------------------------------------------ */

/* A growing string in memory of the run. Start with {.run = call->run}. */
typedef struct core_buffer {
    pcg_run *run;
    char *at;
    size_t length, capacity;
    int failed; /* memory has run out: what is added is left out */
} core_buffer;

void core_add_bytes(core_buffer *b, const char *bytes, size_t count);
void core_add(core_buffer *b, const char *string);
/* A number as the language writes it, 0.1, whatever the locale. */
void core_add_number(core_buffer *b, double value);
/* A number with that many decimals (at most 20), whatever the locale. */
void core_add_fixed(core_buffer *b, double value, int decimals);
/* A value as the language converts it to a string. */
void core_add_value(core_buffer *b, const pcg_any *value);
/* The string, which is the run's; gives the buffer's memory back. Never NULL: "" where memory has
 * run out. */
const char *core_finish(core_buffer *b);

/* A number as a string of the run's, for messages. */
const char *core_number(pcg_call *call, double value);

#endif

/* evaluate.h - constant values: folding them, and writing typed values as the language does. */
#ifndef PCG_COMPILER_EVALUATE_H
#define PCG_COMPILER_EVALUATE_H

#include "types.h"

/* What `v` is, where it is the same in every run: *result is then a VALUE_CONSTANT. False for all
 * else, and for what no constant can be: a quotient of integers by zero, a number that is not
 * finite, text longer than 64 KiB. */
bool value_evaluate(arena *a, const value *v, value *result);

/* The number that a constant holds, of whatever kind. */
double value_as_number(const value *v);

/* The value as source text: 3m, (height * 2), min(a, b). */
void value_print(const value *v, text *out);
const char *value_text(arena *a, const value *v);
/* A number of that type as source text. */
void number_print(double number, const type *t, text *out);

#endif

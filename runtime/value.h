/* value.h - values of every kind: how many cells they take, as the language writes them, as JSON,
 * and read from text. What the public setters, getters and writers stand on.
 */
#ifndef PCG_VALUE_H
#define PCG_VALUE_H

#include "base/base.h"
#include "abi.h"

enum { VALUE_NUMBER_BYTES = 64, VALUE_WHY_BYTES = 400 };

/* What a cell means. `enumerators` of an enumeration (and of a list's elements), separated by
 * \n. */
typedef struct value_type {
    int kind, element;
    const char *enumerators;
} value_type;

/* How many cells a value of a kind takes. */
static inline pcg_u32 value_width(int kind)
{
    switch (kind) {
    case PCG_VEC2: return 2;
    case PCG_VEC3: return 3;
    case PCG_VEC4: case PCG_COLOR: case PCG_QUATERNION: return 4;
    default: return 1;
    }
}
/* float, or a unit over it. */
static inline bool value_is_float(int kind)
{
    return kind == PCG_FLOAT || kind >= PCG_LENGTH;
}
/* float, its units, or what is made of floats. */
static inline bool value_has_floats(int kind)
{
    return value_is_float(kind) || value_width(kind) > 1;
}
const char *value_kind_name(int kind); /* "length" */

/* A number as text_number writes it, without an arena; `out` has VALUE_NUMBER_BYTES. */
void value_number(char *out, double value);
/* A number with its kind's unit: 3m, 30deg, 0.5. */
void value_quantity(char *out, int kind, double value);
/* A value as the language writes it; a string stands without quotes (but in a list with them). */
void value_write(text *out, const value_type *t, const pcg_cell *at);
/* As JSON: numbers (null where JSON has none), strings, arrays; an enumerator as a string, a colour
 * as "#rrggbb". */
void value_write_json(text *out, const value_type *t, const pcg_cell *at);

/* Reads a value as the language writes it; of a string the quotes may be left out. Blanks around it
 * do not count. Strings and lists are the run's. False: `why` (VALUE_WHY_BYTES) says what was
 * expected and found. */
bool value_read(pcg_run *r, const value_type *t, const char *from, pcg_cell *to, char *why);
/* True where two values of a type are equal. */
bool value_equal(const value_type *t, const pcg_cell *a, const pcg_cell *b);
/* True where the bytes are well-formed UTF-8. */
bool value_is_utf8(const char *s);

/* The enumerator of a number, NULL where it has none; it ends at \n or NUL and has *length
 * bytes. */
const char *value_enumerator(const char *enumerators, pcg_int number, size_t *length);
/* The number of a name of `length` bytes, or -1. */
pcg_int value_enumerator_number(const char *enumerators, const char *name, size_t length);

#endif

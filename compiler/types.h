/* types.h - types of values and entities: equality, descent, units, and how they are written.
 *
 * Units are kinds of float that stay apart: a length times a length is an area, an area through a
 * length is a length, two of one kind make a plain number, and plain numbers scale any of them. A
 * ratio is a number without a dimension: it scales like a plain one, and mixes with plain ones.
 */
#ifndef PCG_COMPILER_TYPES_H
#define PCG_COMPILER_TYPES_H

#include "compiler.h"

extern const type type_error, type_bool, type_int, type_float, type_string, type_any;

/* A value type without enumerators or elements: PCG_BOOL … PCG_PATH, PCG_LENGTH … */
type type_of_kind(int kind);
type type_of_entity(const entity_type *e);
/* The value type of that name (bool … path, length …), and `attribute` and `any`. False where it is
 * none. */
bool type_of_word(const char *word, type *t);

bool type_equal(const type *a, const type *b);
bool type_is(const type *t, int kind);
bool type_is_unit(const type *t);   /* length … seconds */
bool type_is_plain(const type *t);  /* int or float */
bool type_is_number(const type *t); /* either */
bool type_is_text(const type *t);   /* string or path */
bool type_is_vector(const type *t); /* vec2, vec3, vec4, color, quaternion */
bool type_is_error(const type *t);

/* Cells of storage that a value takes. */
uint32_t type_cells(const type *t);
/* As many components as .x .y … (.r .g …) can name: 0 where it has none. */
uint32_t type_components(const type *t);

/* Whether `a` is `b` or derives from it. */
bool entity_derives(const entity_type *a, const entity_type *b);
/* The nearest type that both derive from. */
const entity_type *entity_common(const entity_type *a, const entity_type *b);

/* What * / + - % and comparisons make of two numbers: false where the units do not go together.
 * The result of a comparison is the type that both are compared in. */
bool unit_combine(tree_operator op, const type *a, const type *b, type *result);

/* The type as text. */
const char *type_text(arena *a, const type *t);
/* As the language writes the operator. */
const char *operator_text(tree_operator op);

#endif

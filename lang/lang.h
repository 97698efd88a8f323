/* lang.h - text to syntax tree and back. Knows the grammar; knows no procedure and no meaning. */
#ifndef PCG_LANG_H
#define PCG_LANG_H

#include "tree.h"

/* Limits of a text; passing one is a located error. */
enum {
    LANG_MAX_NESTING = 200,   /* of (), [], {} and list<> */
    LANG_MAX_DEPTH = 1000,    /* of an expression's tree: a row of operators counts each */
    LANG_MAX_BYTES = 64 << 20 /* of one file */
};

/* Parses a file. Errors go to `d`, all of them in one run; the tree holds what could be understood
 * and is never NULL. Memory comes from `a`. */
tree_file *lang_parse(arena *a, const source *s, diagnostics *d);

/* Prints the tree in a form for tests: one element a line, indented. */
void lang_dump(const tree_file *f, text *out);

/* Prints an expression, a chain, a type as source text, on one line. */
void lang_write_expression(const tree_expression *e, text *out);
void lang_write_chain(const tree_chain *c, text *out);
void lang_write_type(const tree_type *t, text *out);
/* name: type = default constraints, without a keyword. */
void lang_write_parameter(const tree_parameter *p, text *out);
/* name = value, name => @attribute. */
void lang_write_argument(const tree_argument *a, text *out);
/* chain expect faces = 6, port.count = 2 */
void lang_write_example(const tree_example *e, text *out);
/* A name, in quotes where it needs them. */
void lang_write_name(const char *name, text *out);
/* An operator's sign. */
const char *lang_operator(tree_operator op);

#endif

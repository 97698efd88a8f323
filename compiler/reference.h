/* reference.h - the reference of the procedure libraries, made from their interfaces, and the
 * forms that it is written in. */
#ifndef PCG_COMPILER_REFERENCE_H
#define PCG_COMPILER_REFERENCE_H

#include "../interface/interface.h"

/* One entry: a procedure, a function with all its overloads, an entity type, an enumeration. */
typedef struct reference_item {
    library_entry_kind kind;
    const char *name;
    const pcg_library *library;
    const char *path;    /* where it is declared: geometry/split.c */
    uint32_t line;
    const char *group;   /* a procedure's category; a function's file; "types" */
    const char *summary; /* the first paragraph of its documentation, on one line; maybe "" */
    const char *details; /* what stands behind that; NULL */
    const tree_procedure *procedure;
    LIST(const tree_function *) functions;
    const tree_entity *entity;
    const tree_enumeration *enumeration;
} reference_item;

typedef LIST(const reference_item *) reference_items;

typedef struct reference {
    arena *arena;
    LIST(const pcg_library *) libraries;
    reference_items items; /* by library, kind, group, name */
} reference;

/* Begins with the libraries that are built in; adds one; reads the interfaces of all. */
void reference_begin(reference *r, arena *a);
void reference_add(reference *r, const pcg_library *l);
void reference_read(reference *r);
/* Whether a library of that name is there. */
bool reference_has_library(const reference *r, const char *name);
/* The items of that name, in the form name or library.name; former names lead to today's. */
reference_items reference_find(const reference *r, const char *name);
/* Those in whose name, synonyms, group or summary every blank-separated word of `words` occurs,
 * the best first. */
reference_items reference_search(const reference *r, const char *words);
/* The name of an entry or library, or the synonym, that is nearest to a word, or NULL. */
const char *reference_nearest(const reference *r, const char *word);

/* "procedure", "function", "entity", "enum". */
const char *reference_kind(const reference_item *item);

/* ---- parts that every form holds ------------------------------------------------------------- */

/* split<T: Entity>(in: Shape) -> (out: Shape): the head without the traits. */
void reference_write_procedure_head(const tree_procedure *p, text *out);
void reference_write_function_head(const tree_function *f, text *out);
/* absolute(size: length) -> Shape */
void reference_write_augment_head(const tree_augment *g, text *out);
/* "range [3m, 60m]"; nothing where there is none. */
void reference_write_constraints(const tree_parameter *p, text *out);
void reference_write_names(const tree_names *names, const char *separator, text *out);
void reference_write_expectations(const tree_example *e, text *out);
/* The chains of an example, with `between` between them. */
void reference_write_chains(const tree_example *e, const char *between, text *out);
/* What is said of overload i and those behind it, where it is not what is said of the one before;
 * else NULL. */
const char *reference_overload_document(const reference_item *item, uint32_t i);
/* The documentation with its lines joined; "" for NULL. */
const char *reference_line(arena *a, const char *document);
/* The enumeration that a type names, or NULL. */
const tree_enumeration *reference_enumeration(const reference *r, const tree_type *t);

/* ---- forms ----------------------------------------------------------------------------------- */

/* For a terminal: one entry in full; entries as a list of names and summaries; everything by
 * library and group. */
void reference_write_text(const reference *r, const reference_item *item, text *out);
void reference_write_list(const reference_items *items, text *out);
void reference_write_index(const reference *r, const char *library, text *out);
/* Documents of everything. */
void reference_write_markdown(const reference *r, text *out);
void reference_write_html(const reference *r, text *out);
void reference_write_json(const reference *r, const reference_items *items, text *out);

#endif

/* library.h - what the passes ask of the procedure libraries beside the find_… functions of
 * compiler.h.
 *
 * The library `core` has a part that is no kernel but a form of the compiler: the surrogates
 * (dynamic, iterate, parallel, cache, profile) and the entity types that the runtime itself holds.
 * Their interfaces are text like all others, in library.c.
 */
#ifndef PCG_COMPILER_LIBRARY_H
#define PCG_COMPILER_LIBRARY_H

#include "types.h"

typedef LIST(const char *) names;

/* Puts the built-in libraries and the compilation's own in scope. */
void library_begin(compilation *c, program *p);
/* The library that `use` names, built in or found on the search path, now in scope in that file;
 * NULL: it was reported. */
const pcg_library *library_use(compilation *c, program *p, const unit *u, const tree_name *name);
/* Where it was found; NULL where it is built in. */
const char *library_path(const compilation *c, const pcg_library *l);
/* It is part of pcgc: its kernels are called by their names. */
bool library_is_builtin(const pcg_library *l);
/* Whether what it declares may be named in the file that is looked at. */
bool library_is_visible(const program *p, const pcg_library *l);
/* The library in scope that has that name, or NULL. */
const pcg_library *library_named(const program *p, const char *name);
/* How many libraries in scope (`library` NULL: any) declare the name, formerly used names included;
 * the first two. */
uint32_t library_count(const program *p, const char *library, const char *name,
                       library_entry_kind kind, const pcg_library *found[2]);
/* As find_procedure, but the program does not come to use it. */
const procedure *library_procedure(compilation *c, program *p, const char *library,
                                   const char *name);
/* The program uses it: emit declares it. */
void library_use_function(program *p, const function *f);
bool library_is_surrogate(const procedure *f);
/* That part of core. */
extern const pcg_library library_surrogates;
/* A procedure that makes `to` of `from` without being given anything; NULL when there is none. */
const procedure *library_converter(compilation *c, program *p, const entity_type *from,
                                   const entity_type *to);

/* The type that is written, outside of interfaces: reports one that is unknown. Collectivity is the
 * caller's. */
type library_type(compilation *c, program *p, const tree_type *tree);

/* ---- did you mean -------------------------------------------------------------------------- */

/* False once so many errors were found that no more are kept: looking for suggestions is in vain.
 */
bool suggestions_wanted(const compilation *c);
/* Adds the names that libraries (`library` NULL: all in scope) declare. */
void library_add_names(const program *p, arena *a, const char *library, library_entry_kind kind,
                       names *to);
/* "unknown library 'geometri'", with a suggestion. */
diagnostic *library_report_unknown(compilation *c, const program *p, const tree_name *name);
/* "did you mean 'split'?", or NULL. */
const char *did_you_mean(compilation *c, const char *name, const names *candidates);

#endif

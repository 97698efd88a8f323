/* compiler.h - the passes, and what the subcommands share. */
#ifndef PCG_COMPILER_H
#define PCG_COMPILER_H

#include "program.h"

/* A library that `use` has found. */
typedef struct opened_library {
    struct open_library *library;
    struct opened_library *next;
} opened_library;

/* One compilation. `arena.on_failure` is set by its owner: memory that runs out ends the
 * compilation. */
typedef struct compilation {
    arena arena;
    diagnostics diagnostics;
    const char *const *import_paths; /* NULL-terminated; NULL: none */
    const char *const *library_paths; /* where `use` looks; NULL: none */
    const pcg_library *const *libraries; /* in scope beside the built-in ones, NULL-terminated; NULL: none */
    opened_library *opened;          /* that it holds, the newest first */
    bool closed;                     /* imports are refused: no file is read, no library opened */
    const char *graph;               /* which graph is the main one; NULL: the one named like the file, or the only one */
    void (*found)(void *user, const char *path); /* told of each file before it is read, whether or not it is there; may be NULL */
    void *found_user;
    void (*lap)(void *user, const char *pass); /* called as each pass ends; may be NULL */
    void *user;
} compilation;

/* Gives back everything that it took. */
void compilation_end(compilation *c);

enum { COMPILER_MAX_IMPORT_DEPTH = 100, COMPILER_MAX_FILES = 10000 };

/* The front end: resolve, check, order. NULL when there is no main graph; with errors in
 * c->diagnostics the program must not be emitted. Memory that runs out jumps to
 * c->arena.on_failure. */
program *compile_front(compilation *c, const source *main);

/* parse + resolve: reads the main file and what it imports; binds every name. Needs a source;
 * gives a program whose names, nodes, ports and edges stand; types of expressions are missing.
 * NULL only when the main graph is. */
program *resolve(compilation *c, const source *main);
/* check: types through generics and cycles, typed expressions, units, links, constraints. Needs
 * resolve's program; keeps its shape. False when there were errors. */
bool check(compilation *c, program *p);
/* order: cyclic edges, ranks, regions. Needs check without errors. */
void order(compilation *c, program *p);
/* emit: the C of the whole program, the same for every backend. Needs order. An expression that
 * needs more room than there is on a stack is an error in c->diagnostics: the text must not be
 * compiled then. */
typedef struct emit_condition {
    const node *node;   /* that it stands at: typed as the argument of such a node */
    const value *value; /* a bool */
} emit_condition;
typedef struct emit_options {
    const char *version;
    bool lines;       /* #line directives */
    bool observed;    /* each round is told to pcg_round_seen and pcg_round_over */
    const emit_condition *condition; /* is to be a function, for native_condition; NULL */
} emit_options;
void emit(compilation *c, const program *p, const emit_options *o, text *out);
void emit_header(compilation *c, const program *p, text *out); /* for -o x.c: x.h */

/* Forms for tests. */
void dump_check(const program *p, text *out);
void dump_order(const program *p, text *out);

/* Libraries and the interfaces in them, understood on first use. */
const procedure *find_procedure(compilation *c, program *p, const char *library, const char *name);
const function *find_function(compilation *c, program *p, const char *library, const char *name); /* first overload */
const enumeration *find_enumeration(compilation *c, program *p, const char *name);
const entity_type *find_entity_type(compilation *c, program *p, const char *name);
void type_write(const type *t, text *out); /* as the language writes it */

/* ---- backends -------------------------------------------------------------------------------- */

typedef struct native native; /* native code in memory */
/* Compiles emitted C in memory. NULL with a message in `error` (ours to fix: emitted C must
 * compile). */
native *native_new(const program *p, const char *c_text, char **error);
const pcg_module *native_module(const native *n);
/* The function of emit_options.condition, which evaluates it: `form` is the pcg_seen_graph's, `at` the
 * call of the node's round, `seen` an entity for each of its inputs. Returns a status, and what it came to in
 * *holds. NULL where the text has none. */
typedef int condition_function(pcg_u32 form, const pcg_call *at, pcg_entity *const *seen, int *holds);
condition_function *native_condition(const native *n);
void native_free(native *n);
/* A program of compiled code, with the kernels that it takes from the compilation's libraries, which it
 * holds open. `release(owned)` is called when it is freed; where NULL is returned, and `*why` (the
 * compilation's) tells, nothing was taken over. */
struct pcg_program *compilation_program(compilation *c, const pcg_module *module,
                                        void (*release)(void *owned), void *owned,
                                        const char **why);
/* Runs of the program may compile what its surrogates name: as this compilation does. False: no
 * memory. */
bool compilation_lend(const compilation *c, struct pcg_program *p);
/* Writes a shared object or executable; `cc` NULL: by libtcc, else by that compiler with -O2.
 * `guard` (may be NULL) removes what is incomplete on Ctrl+C. */
struct interrupt;
bool write_shared(const program *p, const char *c_text, const char *path, const char *cc,
                  struct interrupt *guard, char **error);
/* The same with what a debugger needs, and as it is written: for `cc` alone. */
bool write_debuggable(const program *p, const char *c_text, const char *path, const char *cc,
                      struct interrupt *guard, char **error);
bool write_executable(const program *p, const char *c_text, const char *path, const char *cc,
                      struct interrupt *guard, char **error);

#endif

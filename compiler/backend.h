/* backend.h - what the backends share: libtcc behind one lock, running compilers, files that appear
 * whole or not at all.
 */
#ifndef PCG_COMPILER_BACKEND_H
#define PCG_COMPILER_BACKEND_H

#include "../runtime/interrupt.h"
#include "compiler.h"

struct TCCState;

/* What a backend has to say, as far as there is memory for it. */
typedef struct complaint {
    char *text; /* from malloc; NULL while there is none */
    size_t length;
} complaint;

void complain(complaint *c, const char *format, ...) PRINTF_LIKE(2, 3);
/* Hands the text to the caller's `error`, which frees it; returns false. */
bool complain_to(complaint *c, char **error);

/* ---- libtcc (backend_tcc.c) ------------------------------------------------------------------ */

typedef bool tcc_finish(void *context, struct TCCState *s, complaint *c);

/* Compiles emitted C by libtcc, with `define` set, for `output` (TCC_OUTPUT_MEMORY …) and calls
 * `finish` while libtcc is ours: it keeps global state, and reads numbers by the locale. False,
 * with `c` saying why, where either failed. On success `*keep` takes the state over, where
 * `keep` is not NULL, until tcc_discard. */
bool tcc_compile(const char *c_text, const char *define, int output, complaint *c,
                 tcc_finish *finish, void *context, struct TCCState **keep);
void tcc_discard(struct TCCState *s);

/* The C library's variables under the names that our copy of libtcc has for them
 * (tcc_variables.c); tcc_take_variables sets them, while libtcc is ours. */
extern FILE *tcc_stdout, *tcc_stderr;
extern char **tcc_environ;
void tcc_take_variables(void);

/* ---- compilers and files (backend_process.c) ------------------------------------------------- */

/* Runs the command `cc` (which may hold options, separated by blanks) with more arguments, up to
 * a NULL, and `input` as its standard input. False: what it said is in `c`. `*missing` (may be
 * NULL): there is no such command. Ctrl+C ends it, with all that it started, through `guard`,
 * which may be NULL, as below. */
bool run_compiler(const char *cc, const char *const *arguments, const char *input, complaint *c,
                  bool *missing, interrupt *guard);

/* The folder of the running program, with a slash behind it: "" where the system does not tell. */
const char *program_folder(arena *a);

/* A file that is not complete: it has a name of its own beside the one that it will have. */
typedef struct partial_file {
    interrupt *guard;
    interrupt_file unfinished;
    const char *name;      /* in the arena */
} partial_file;
/* `suffix` tells several partial files for one path apart. No file is made. */
void partial_begin(partial_file *f, arena *a, const char *path, const char *suffix,
                   interrupt *guard);
/* Gives a complete file its name, or removes what is incomplete, if it is there. */
bool partial_end(partial_file *f, bool complete, const char *path, complaint *c);

#endif

/* progress.h - a line on the terminal that says what a long run is doing: for programs that own
 * their process.
 *
 * It appears after half a second, on stderr, where that is a terminal that can erase a line and
 * NO_COLOR is not set; it is as wide as the terminal at most. The thread of an interrupt draws it,
 * ten times a second, so that it lives on in kernels and writers that take long; the interrupt's
 * lock guards it. Whoever prints something else hides it first.
 */
#ifndef PCG_PROGRESS_H
#define PCG_PROGRESS_H

#include "interrupt.h"

enum { PROGRESS_LINE = 512 };

typedef struct progress {
    interrupt *guard;
    bool wanted, shown;
    double began;
    unsigned drawn;                    /* times: turns the spinner */
    char what[PROGRESS_LINE];          /* such as "writing house.glb", or a node's name */
    uint64_t rounds, entities;         /* 0, 0: not running */
} progress;

/* Before interrupt_begin: takes its `tick` and `clear`. Nothing is drawn where stderr is no such
 * terminal, or `quiet`. */
void progress_begin(progress *p, interrupt *guard, bool quiet);
/* What is done from now on, and to which file ("" for none). */
void progress_stage(progress *p, const char *verb, const char *path);
/* A pcg_run_options.progress, whose `user` is the progress. Returns 0. */
int progress_run(void *p, const pcg_progress *now);
/* Erases the line, if there is one; it comes back by itself. */
void progress_hide(progress *p);
/* Erases it for good. */
void progress_end(progress *p);

/* The line as it is drawn in `columns` columns, without the control codes around it; for tests. */
size_t progress_line(const progress *p, double seconds, unsigned columns, char *out, size_t room);

#endif

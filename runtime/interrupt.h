/* interrupt.h - Ctrl+C: for programs that own their process.
 *
 * While an interrupt lasts, SIGINT, SIGTERM and SIGHUP are kept from this thread and from those
 * that are begun later, and a thread of its own waits for them: a handler would need a global to
 * know what to stop. The first signal cancels the run that is going on, which then ends by itself.
 * What has not ended after INTERRUPT_GRACE milliseconds, has no run, or is asked a second time, is
 * ended where it stands: child processes are stopped, files under names that are not their last
 * ones are removed, and the process exits with INTERRUPT_EXIT. Signals that the process was started
 * to ignore stay ignored.
 *
 * The lock keeps the thread from ending the process between two steps that belong together, such as
 * opening a file and telling of it; it is held for microseconds. Every function takes NULL for
 * "nobody is interrupted".
 */
#ifndef PCG_INTERRUPT_H
#define PCG_INTERRUPT_H

#include <pthread.h>
#include <signal.h>
#include <sys/types.h>

#include "pcg.h"

enum {
    INTERRUPT_EXIT = 130,
    INTERRUPT_GRACE = 20,  /* milliseconds that a cancelled run has to end in */
    INTERRUPT_TICK = 100   /* milliseconds between two calls of `tick` */
};

/* A file that must not stay behind under this name, or a folder that must not with all files in it.
 * Its owner keeps the struct and the path in place until interrupt_drop. */
typedef struct interrupt_file {
    struct interrupt_file *next;
    const char *path;
} interrupt_file;

typedef struct interrupt {
    const char *program;               /* who says "interrupted" */
    void (*tick)(void *user);          /* called now and then, with the lock held; may be NULL */
    void (*clear)(void *user);         /* before a message is printed, with the lock held; may be NULL */
    void *user;
    /* Asked at each SIGINT, with the lock held: true where nothing is to be stopped by it. May be NULL,
     * and may be set later, with the lock held. */
    bool (*pause)(void *pauser);
    void *pauser;
    pthread_t thread;
    sigset_t signals, before;
    bool waiting;                      /* there is a thread */
    pthread_mutex_t lock;
    /* Behind the lock: */
    pcg_run *run;
    pid_t child;                       /* leads a process group; 0: none */
    interrupt_file *files;
    bool asked, over;
    long long deadline;                /* monotonic milliseconds */
} interrupt;

/* `tick`, `clear` and `user` are set before, or zero. */
void interrupt_begin(interrupt *i, const char *program);
/* True where a signal had come: the exit code is INTERRUPT_EXIT then. Signals stay blocked: one
 * that comes later waits for the next interrupt, or comes too late. */
bool interrupt_end(interrupt *i);
bool interrupt_asked(interrupt *i);

/* What a signal cancels from now on; NULL before the run is freed. A run that is begun after the
 * signal is cancelled at once. */
void interrupt_run(interrupt *i, pcg_run *r);

void interrupt_lock(interrupt *i);
void interrupt_unlock(interrupt *i);

/* With the lock held: */
void interrupt_keep(interrupt *i, interrupt_file *f, const char *path);
void interrupt_drop(interrupt *i, interrupt_file *f);
void interrupt_child(interrupt *i, pid_t leader); /* 0: it has ended */

/* Removes a file, or a folder with the files in it. */
void interrupt_remove(const char *path);

#endif

/* interrupt.c - a thread that waits for Ctrl+C. */
#include "interrupt.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/base.h"
#include "run.h"

/* How long a compiler has to remove its own temporary files, in milliseconds, and then to die. */
enum { CHILD_GRACE = 50, CHILD_KILLED = 20 };

static long long milliseconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (long long)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

/* ---- ending the process ---------------------------------------------------------------------- */

static void say(const char *line)
{
    ssize_t written = write(STDERR_FILENO, line, strlen(line));
    (void)written; /* nobody is left to tell */
}

static void announce(interrupt *i)
{
    if (i->clear)
        i->clear(i->user);
    say(i->program);
    say(": interrupted\n");
}

/* Whether the whole process group has ended within the time. */
static bool ended_within(pid_t leader, long time)
{
    const struct timespec pause = {.tv_nsec = 1000000};
    for (long long until = milliseconds() + time; milliseconds() < until;) {
        if (kill(-leader, 0) != 0 && errno == ESRCH)
            return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

static void end_child(const interrupt *i)
{
    if (!i->child)
        return;
    kill(-i->child, SIGTERM);
    if (ended_within(i->child, CHILD_GRACE))
        return;
    kill(-i->child, SIGKILL);
    ended_within(i->child, CHILD_KILLED);
}

void interrupt_remove(const char *path)
{
    if (unlink(path) == 0 || (errno != EISDIR && errno != EPERM))
        return;
    DIR *folder = opendir(path);
    for (struct dirent *e = folder ? readdir(folder) : NULL; e; e = readdir(folder))
        unlinkat(dirfd(folder), e->d_name, 0); /* fails for "." and ".." */
    if (folder)
        closedir(folder);
    rmdir(path);
}

/* The lock stays held: no thread begins a new file. */
static void end_process(const interrupt *i)
{
    end_child(i);
    for (const interrupt_file *f = i->files; f; f = f->next)
        interrupt_remove(f->path);
    _exit(INTERRUPT_EXIT);
}

/* ---- the thread ------------------------------------------------------------------------------ */

/* The next signal; 0 where it is time for a tick, or for the end of what was cancelled. */
static int next_signal(const interrupt *i, bool asked, long long deadline)
{
    long long left = asked ? deadline - milliseconds() : INTERRUPT_TICK;
    const struct timespec pause = {.tv_nsec = left > 0 ? (long)left * 1000000 : 0};
    int which = asked || i->tick ? sigtimedwait(&i->signals, NULL, &pause)
                                 : sigwaitinfo(&i->signals, NULL);
    return which > 0 && which != SIGUSR2 ? which : 0;
}

static void take_signal(interrupt *i, int which)
{
    if (which == SIGINT && !i->asked && i->pause && i->pause(i->pauser))
        return;
    bool again = i->asked;
    i->asked = true;
    if (!again)
        announce(i);
    if (again || !i->run)
        end_process(i);
    pcg_run_cancel(i->run);
    i->deadline = milliseconds() + INTERRUPT_GRACE;
}

static void *attend(void *context)
{
    interrupt *i = context;
    bool asked = false;
    long long deadline = 0;
    for (;;) {
        int which = next_signal(i, asked, deadline);
        pthread_mutex_lock(&i->lock);
        if (i->over)
            break;
        if (which)
            take_signal(i, which);
        else if (i->asked && milliseconds() >= i->deadline)
            end_process(i);
        else if (!i->asked && i->tick)
            i->tick(i->user);
        asked = i->asked;
        deadline = i->deadline;
        pthread_mutex_unlock(&i->lock);
    }
    pthread_mutex_unlock(&i->lock);
    return NULL;
}

/* ---- beginning and ending -------------------------------------------------------------------- */

static void choose_signals(interrupt *i)
{
    static const int all[] = {SIGINT, SIGTERM, SIGHUP};
    sigemptyset(&i->signals);
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        struct sigaction now;
        if (sigaction(all[k], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaddset(&i->signals, all[k]);
    }
}

/* Where there is no thread, Ctrl+C ends the process, as it does by itself. SIGUSR2 is for
 * interrupt_end. */
void interrupt_begin(interrupt *i, const char *program)
{
    i->program = program;
    choose_signals(i);
    pthread_mutex_init(&i->lock, NULL);
    sigaddset(&i->signals, SIGUSR2);
    pthread_sigmask(SIG_BLOCK, &i->signals, &i->before);
    i->waiting = pthread_create(&i->thread, NULL, attend, i) == 0;
    if (!i->waiting)
        pthread_sigmask(SIG_SETMASK, &i->before, NULL);
}

bool interrupt_end(interrupt *i)
{
    interrupt_lock(i);
    i->over = true;
    interrupt_unlock(i);
    if (i->waiting) {
        pthread_kill(i->thread, SIGUSR2);
        pthread_join(i->thread, NULL);
    }
    pthread_mutex_destroy(&i->lock);
    return i->asked;
}

bool interrupt_asked(interrupt *i)
{
    interrupt_lock(i);
    bool asked = i && i->asked;
    interrupt_unlock(i);
    return asked;
}

/* ---- what is to be stopped ------------------------------------------------------------------- */

void interrupt_lock(interrupt *i)
{
    if (i)
        pthread_mutex_lock(&i->lock);
}

void interrupt_unlock(interrupt *i)
{
    if (i)
        pthread_mutex_unlock(&i->lock);
}

void interrupt_run(interrupt *i, pcg_run *r)
{
    if (!i)
        return;
    interrupt_lock(i);
    i->run = r;
    if (r)
        r->guard = i;
    if (r && i->asked)
        pcg_run_cancel(r);
    interrupt_unlock(i);
}

void interrupt_keep(interrupt *i, interrupt_file *f, const char *path)
{
    if (!i)
        return;
    f->path = path;
    f->next = i->files;
    i->files = f;
}

void interrupt_drop(interrupt *i, interrupt_file *f)
{
    interrupt_file **at = i ? &i->files : NULL;
    while (at && *at && *at != f)
        at = &(*at)->next;
    if (at && *at)
        *at = f->next;
}

void interrupt_child(interrupt *i, pid_t leader)
{
    if (i)
        i->child = leader;
}

/* watch.c - waits until files change.
 *
 * Events only wake it: what counts is whether a file looks different from what it looked like
 * before it was read. So no event is needed to be understood, and none that comes while the files
 * are read is lost. */
#include "watch.h"

#include <dirent.h>
#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    QUIET = 50,         /* milliseconds without an event: the save is over */
    MISSING_QUIET = 250, /* where a file is gone that editors may be about to put back */
    QUIETS_MAX = 20,    /* then it is over all the same */
    EVENT_BYTES = 1 << 14
};

/* ---- what files look like -------------------------------------------------------------------- */

static bool is_ignored(const watch *w, const char *name)
{
    if (name[0] == '.')
        return true;
    for (size_t i = 0; i < w->ignored_count; i++) {
        const char *slash = strrchr(w->ignored[i], '/');
        if (!strcmp(name, slash ? slash + 1 : w->ignored[i]))
            return true;
    }
    return false;
}

/* The names in a folder, whatever their order: a sum of hashes (FNV-1a). */
static uint64_t hash_names(const watch *w, const char *path)
{
    uint64_t sum = 0;
    DIR *folder = opendir(path);
    for (struct dirent *e = folder ? readdir(folder) : NULL; e; e = readdir(folder)) {
        uint64_t hash = 14695981039346656037u;
        for (const char *s = e->d_name; *s; s++)
            hash = (hash ^ (unsigned char)*s) * 1099511628211u;
        sum += is_ignored(w, e->d_name) ? 0 : hash;
    }
    if (folder)
        closedir(folder);
    return sum;
}

static watch_look look_at(const watch *w, const char *path)
{
    struct stat s;
    watch_look look = {0};
    if (stat(path, &s) != 0)
        return look;
    look.there = true;
    look.inode = (uint64_t)s.st_ino;
    if (S_ISDIR(s.st_mode)) {
        look.names = hash_names(w, path);
        return look;
    }
    look.size = (uint64_t)s.st_size;
    look.seconds = s.st_mtim.tv_sec;
    look.nanoseconds = s.st_mtim.tv_nsec;
    return look;
}

static bool same_look(const watch_look *a, const watch_look *b)
{
    return a->there == b->there && a->size == b->size && a->inode == b->inode &&
           a->names == b->names && a->seconds == b->seconds && a->nanoseconds == b->nanoseconds;
}

/* ---- events ---------------------------------------------------------------------------------- */

/* The folder itself; of a file the folder that it is in; where that is missing, the nearest one
 * that is there. */
static bool watch_nearest(const watch *w, char *folder)
{
    static const uint32_t events = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE |
                                   IN_DELETE | IN_ATTRIB | IN_DELETE_SELF | IN_MOVE_SELF |
                                   IN_ONLYDIR;
    for (;;) {
        if (inotify_add_watch(w->notify, *folder ? folder : ".", events) >= 0)
            return true;
        if (errno != ENOENT && errno != ENOTDIR && errno != ENAMETOOLONG)
            return false;
        char *slash = strrchr(folder, '/');
        if (!slash && !*folder)
            return false;
        if (slash == folder && folder[1])
            folder[1] = '\0';
        else if (slash && slash != folder)
            *slash = '\0';
        else if (!slash)
            *folder = '\0';
        else
            return false;
    }
}

static bool watch_folder_of(const watch *w, const char *path)
{
    arena a = {0};
    char *folder = arena_copy(&a, path, strlen(path));
    errno = ENOMEM;
    bool watching = folder && watch_nearest(w, folder);
    int error = errno;
    arena_free(&a);
    errno = error;
    return watching;
}

/* Compares all; returns how many have changed, and how many of those are gone. */
static uint32_t compare(watch *w, uint32_t *gone)
{
    uint32_t changed = 0;
    *gone = 0;
    for (uint32_t i = 0; i < w->paths.entries.count; i++) {
        watched_path *p = w->paths.entries.at[i].value;
        if (!p->look.there)
            watch_folder_of(w, p->path); /* the way to it may be there by now */
        watch_look now = look_at(w, p->path);
        p->changed = !same_look(&now, &p->look);
        changed += p->changed;
        *gone += p->changed && !now.there;
    }
    return changed;
}

/* Waits for events, at most so many milliseconds (-1: for ever), and forgets them. 1: some came; 0:
 * none; -1: errno is set. */
static int take_events(const watch *w, int time)
{
    char events[EVENT_BYTES];
    struct pollfd one = {.fd = w->notify, .events = POLLIN};
    int ready = poll(&one, 1, time);
    if (ready < 0)
        return errno == EINTR ? 1 : -1;
    if (ready && read(w->notify, events, sizeof events) < 0 && errno != EAGAIN && errno != EINTR)
        return -1;
    return ready > 0;
}

/* ---- watching -------------------------------------------------------------------------------- */

bool watch_open(watch *w, arena *a)
{
    *w = (watch){.arena = a, .notify = inotify_init1(IN_CLOEXEC | IN_NONBLOCK)};
    return w->notify >= 0;
}

void watch_close(watch *w)
{
    if (w->notify >= 0)
        close(w->notify);
    w->notify = -1;
}

void watch_begin(watch *w)
{
    for (uint32_t i = 0; i < w->paths.entries.count; i++) {
        watched_path *p = w->paths.entries.at[i].value;
        watch_folder_of(w, p->path); /* another folder may have taken its place */
        p->look = look_at(w, p->path);
        p->changed = false;
    }
}

bool watch_add(watch *w, const char *path)
{
    if (table_get(&w->paths, path))
        return true;
    watched_path *p = ARENA_NEW(w->arena, watched_path);
    p->path = arena_copy(w->arena, path, strlen(path));
    bool watching = watch_folder_of(w, path);
    p->look = look_at(w, path);
    table_put(w->arena, &w->paths, p->path, p);
    return watching;
}

/* Waits until nothing has happened for a moment. */
static bool settle(watch *w)
{
    uint32_t gone;
    int came = 1;
    for (int i = 0; i < QUIETS_MAX && came > 0; i++) {
        compare(w, &gone);
        came = take_events(w, gone ? MISSING_QUIET : QUIET);
    }
    return came >= 0;
}

bool watch_wait(watch *w)
{
    uint32_t gone;
    do {
        while (!compare(w, &gone))
            if (take_events(w, -1) < 0)
                return false;
        if (!settle(w))
            return false;
    } while (!compare(w, &gone)); /* what had changed may be as it was */
    return true;
}

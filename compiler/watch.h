/* watch.h - waits until files change: by inotify on the folders that they are in, so that files
 * that editors put in the place of others are seen, and files that are not there yet. */
#ifndef PCG_WATCH_H
#define PCG_WATCH_H

#include "../runtime/base/base.h"

/* What a file looked like; of a folder, the names in it. */
typedef struct watch_look {
    bool there;
    uint64_t size, inode, names;
    int64_t seconds, nanoseconds; /* of its last change */
} watch_look;

typedef struct watched_path {
    const char *path;
    watch_look look; /* before it was read last */
    bool changed;
} watched_path;

typedef struct watch {
    arena *arena;      /* with on_failure set */
    int notify;        /* -1: not open */
    table paths;       /* to watched_path */
    const char *const *ignored; /* names of files that do not count in folders: what we write ourselves */
    size_t ignored_count;
} watch;

/* False with errno set where the system cannot watch. */
bool watch_open(watch *w, arena *a);
void watch_close(watch *w);
/* Remembers what all files look like, before they are read once more. */
void watch_begin(watch *w);
/* Watches a file or folder from now on, which is about to be read. False with errno set. */
bool watch_add(watch *w, const char *path);
/* Waits until some have changed, and the changing is over; `changed` is set on those. False with
 * errno set where waiting fails. */
bool watch_wait(watch *w);

#endif

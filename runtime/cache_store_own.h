/* cache_store_own.h - what the two files of cache_store.h share. */
#ifndef PCG_CACHE_STORE_OWN_H
#define PCG_CACHE_STORE_OWN_H

#include <pthread.h>

#include "cache_store.h"

typedef struct cache_entry {
    struct cache_entry *next;          /* in its bucket */
    struct cache_entry *newer, *older; /* by when they were used last; a ring through the store */
    digest key;
    size_t size;
    char *bytes;                       /* behind the entry */
} cache_entry;

struct cache_store {
    pthread_mutex_t lock; /* of all that follows */
    cache_entry **buckets;
    size_t bucket_count, count, used;
    cache_entry ring;     /* no entry: `newer` is the oldest one, `older` the newest */
    size_t disk_used;     /* as far as it is known; 0: not yet looked */
    unsigned written;     /* files so far: tells their names apart while they are incomplete */
};

#endif

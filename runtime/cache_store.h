/* cache_store.h - bytes that are kept by a digest: in memory, for the runs of a program, and on
 * disk, for whoever comes later.
 *
 * Memory holds what was used last, up to a limit. On disk each entry is a file of its own in
 * $XDG_CACHE_HOME/pcgc, or ~/.cache/pcgc, that appears whole or not at all, so that processes
 * share the folder without knowing of each other; the oldest ones go where there are too many. A
 * file says by digests what it is and that it is whole, and is not believed otherwise.
 */
#ifndef PCG_CACHE_STORE_H
#define PCG_CACHE_STORE_H

#include <stddef.h>

#include "base/base.h"

typedef struct cache_store cache_store;

/* What is found in place of an entry. */
typedef enum cache_answer { CACHE_FOUND, CACHE_NONE, CACHE_DAMAGED, CACHE_NO_FOLDER } cache_answer;

/* NULL: no memory. Any thread may use it. */
cache_store *cache_store_new(void);
void cache_store_free(cache_store *s);

/* A copy of an entry, malloc's. */
cache_answer cache_memory_get(cache_store *s, const digest *key, char **bytes, size_t *size);
/* Keeps a copy, where all of them then take no more than `limit` bytes; nothing where memory has
 * run out. */
void cache_memory_put(cache_store *s, const digest *key, const char *bytes, size_t size,
                      size_t limit);

cache_answer cache_disk_get(const digest *key, char **bytes, size_t *size);
/* 0, or an errno that says why it was not written. */
int cache_disk_put(cache_store *s, const digest *key, const char *bytes, size_t size, size_t limit);

enum { CACHE_HEAD_BYTES = 64 };
/* The head of an entry's file; whether a file's bytes are that entry, whole. */
void cache_head_write(const digest *key, const char *bytes, size_t size,
                      char head[CACHE_HEAD_BYTES]);
bool cache_file_is_whole(const digest *key, const char *file, size_t size);

#endif

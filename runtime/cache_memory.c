/* cache_memory.c - the part of a cache that is in memory: entries in a table, and in a ring by when
 * they were last used. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "cache_store_own.h"

enum { FIRST_BUCKETS = 64 };

/* ---- the ring ------------------------------------------------------------------------------- */

static void unlink_entry(cache_entry *e)
{
    e->newer->older = e->older;
    e->older->newer = e->newer;
}

static void link_newest(cache_store *s, cache_entry *e)
{
    e->older = s->ring.older;
    e->newer = &s->ring;
    e->older->newer = e;
    s->ring.older = e;
}

/* ---- the table ------------------------------------------------------------------------------ */

static cache_entry **bucket_of(const cache_store *s, const digest *key)
{
    return &s->buckets[key->word[0] & (s->bucket_count - 1)];
}

static cache_entry **place_of(const cache_store *s, const digest *key)
{
    cache_entry **at = bucket_of(s, key);
    while (*at && memcmp(&(*at)->key, key, sizeof *key) != 0)
        at = &(*at)->next;
    return at;
}

static void remove_entry(cache_store *s, cache_entry **at)
{
    cache_entry *e = *at;
    *at = e->next;
    unlink_entry(e);
    s->used -= e->size;
    s->count--;
    free(e);
}

static void grow(cache_store *s)
{
    size_t count = s->bucket_count * 2;
    cache_entry **buckets = calloc(count, sizeof(cache_entry *)), **old = s->buckets;
    if (!buckets)
        return;
    size_t old_count = s->bucket_count;
    s->buckets = buckets;
    s->bucket_count = count;
    for (size_t i = 0; i < old_count; i++)
        for (cache_entry *e = old[i], *next; e; e = next) {
            cache_entry **to = bucket_of(s, &e->key);
            next = e->next;
            e->next = *to;
            *to = e;
        }
    free(old);
}

/* ---- entries -------------------------------------------------------------------------------- */

cache_answer cache_memory_get(cache_store *s, const digest *key, char **bytes, size_t *size)
{
    pthread_mutex_lock(&s->lock);
    cache_entry *e = *place_of(s, key);
    *bytes = e ? malloc(e->size + 1) : NULL;
    if (*bytes) {
        memcpy(*bytes, e->bytes, e->size);
        *size = e->size;
        unlink_entry(e);
        link_newest(s, e);
    }
    pthread_mutex_unlock(&s->lock);
    return *bytes ? CACHE_FOUND : CACHE_NONE;
}

static void put(cache_store *s, const digest *key, const char *bytes, size_t size)
{
    cache_entry *e = malloc(sizeof *e + size);
    if (!e)
        return;
    if (s->count >= s->bucket_count)
        grow(s);
    cache_entry **to = bucket_of(s, key);
    e->key = *key;
    e->size = size;
    e->bytes = (char *)(e + 1);
    e->next = *to;
    *to = e;
    memcpy(e->bytes, bytes, size);
    link_newest(s, e);
    s->used += size;
    s->count++;
}

void cache_memory_put(cache_store *s, const digest *key, const char *bytes, size_t size,
                      size_t limit)
{
    pthread_mutex_lock(&s->lock);
    cache_entry **old = place_of(s, key);
    if (*old)
        remove_entry(s, old);
    while (s->count && size <= limit && s->used > limit - size)
        remove_entry(s, place_of(s, &s->ring.newer->key));
    if (size <= limit)
        put(s, key, bytes, size);
    pthread_mutex_unlock(&s->lock);
}

/* ---- the store ------------------------------------------------------------------------------ */

cache_store *cache_store_new(void)
{
    cache_store *s = calloc(1, sizeof *s);
    if (!s || !(s->buckets = calloc(FIRST_BUCKETS, sizeof *s->buckets))) {
        free(s);
        return NULL;
    }
    s->bucket_count = FIRST_BUCKETS;
    s->ring.newer = s->ring.older = &s->ring;
    pthread_mutex_init(&s->lock, NULL);
    return s;
}

void cache_store_free(cache_store *s)
{
    if (!s)
        return;
    while (s->count)
        remove_entry(s, place_of(s, &s->ring.newer->key));
    pthread_mutex_destroy(&s->lock);
    free(s->buckets);
    free(s);
}

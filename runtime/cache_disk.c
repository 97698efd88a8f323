/* cache_disk.c - the part of a cache that is on disk.
 *
 * A file is a head of 64 bytes and the entry: eight letters with the version of the format in
 * them, a word that tells byte orders apart, the key, the entry's size, a digest of it. Numbers
 * are in the machine's order: entries of another one are not read. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cache_store_own.h"

enum {
    PATH_BYTES = 4096,
    FILES_MAX = 1 << 20,
    ABANDONED_SECONDS = 3600, /* an incomplete file that is older is nobody's any more */
    STALE_SIGN = '.'          /* what the names of incomplete files begin with */
};
#define ENTRY_BYTES_MAX ((size_t)4 << 30)

static const char magic[8] = "PCGKEPT1";
static const uint64_t order = 0x0102030405060708u;

/* ---- format --------------------------------------------------------------------------------- */

void cache_head_write(const digest *key, const char *bytes, size_t size,
                      char head[CACHE_HEAD_BYTES])
{
    digest whole = {{0, 0}};
    uint64_t length = size;
    digest_add(&whole, bytes, size);
    memset(head, 0, CACHE_HEAD_BYTES);
    memcpy(head, magic, 8);
    memcpy(head + 8, &order, 8);
    memcpy(head + 16, key, 16);
    memcpy(head + 32, &length, 8);
    memcpy(head + 40, &whole, 16);
}

bool cache_file_is_whole(const digest *key, const char *file, size_t size)
{
    char head[CACHE_HEAD_BYTES];
    if (size < CACHE_HEAD_BYTES)
        return false;
    cache_head_write(key, file + CACHE_HEAD_BYTES, size - CACHE_HEAD_BYTES, head);
    return !memcmp(head, file, CACHE_HEAD_BYTES);
}

/* ---- places --------------------------------------------------------------------------------- */

static bool folder_path(char path[PATH_BYTES])
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = -1;
    if (cache && *cache == '/')
        length = snprintf(path, PATH_BYTES, "%s/pcgc", cache);
    else if (home && *home == '/')
        length = snprintf(path, PATH_BYTES, "%s/.cache/pcgc", home);
    return length > 0 && length < PATH_BYTES - 100;
}

static bool entry_path(const digest *key, char path[PATH_BYTES])
{
    char digits[DIGEST_TEXT];
    if (!folder_path(path))
        return false;
    digest_write(key, digits);
    size_t length = strlen(path);
    snprintf(path + length, PATH_BYTES - length, "/%s.kept", digits);
    return true;
}

/* With those above it. */
static int make_folder(char path[PATH_BYTES])
{
    for (char *at = path + 1; *at; at++) {
        if (*at != '/')
            continue;
        *at = '\0';
        int failed = mkdir(path, 0700) && errno != EEXIST && errno != EROFS && errno != EACCES;
        *at = '/';
        if (failed)
            return errno;
    }
    return mkdir(path, 0700) && errno != EEXIST ? errno : 0;
}

/* ---- reading -------------------------------------------------------------------------------- */

static bool read_all(int file, char *to, size_t size)
{
    while (size) {
        ssize_t count = read(file, to, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return false;
        to += count;
        size -= (size_t)count;
    }
    return true;
}

static cache_answer read_entry(int file, const digest *key, char **bytes, size_t *size)
{
    struct stat about;
    if (fstat(file, &about) || !S_ISREG(about.st_mode) || about.st_size < CACHE_HEAD_BYTES ||
        (uint64_t)about.st_size > ENTRY_BYTES_MAX)
        return CACHE_DAMAGED;
    size_t length = (size_t)about.st_size;
    char *all = malloc(length);
    if (!all)
        return CACHE_NONE;
    if (!read_all(file, all, length) || !cache_file_is_whole(key, all, length)) {
        free(all);
        return CACHE_DAMAGED;
    }
    *size = length - CACHE_HEAD_BYTES;
    memmove(all, all + CACHE_HEAD_BYTES, *size);
    *bytes = all;
    return CACHE_FOUND;
}

cache_answer cache_disk_get(const digest *key, char **bytes, size_t *size)
{
    char path[PATH_BYTES];
    *bytes = NULL;
    if (!entry_path(key, path))
        return CACHE_NO_FOLDER;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (file < 0)
        return errno == ENOENT || errno == ENOTDIR ? CACHE_NONE : CACHE_DAMAGED;
    cache_answer answer = read_entry(file, key, bytes, size);
    if (answer == CACHE_FOUND)
        futimens(file, NULL); /* it was used; unnoted, it only goes earlier */
    close(file);
    return answer;
}

/* ---- making room ---------------------------------------------------------------------------- */

typedef struct kept_file {
    char name[DIGEST_TEXT + 8];
    struct timespec used;
    size_t size;
} kept_file;

static int by_age(const void *a, const void *b)
{
    const struct timespec *x = &((const kept_file *)a)->used, *y = &((const kept_file *)b)->used;
    if (x->tv_sec != y->tv_sec)
        return x->tv_sec < y->tv_sec ? -1 : 1;
    if (x->tv_nsec != y->tv_nsec)
        return x->tv_nsec < y->tv_nsec ? -1 : 1;
    return strcmp(((const kept_file *)a)->name, ((const kept_file *)b)->name);
}

static bool is_entry(const char *name)
{
    size_t digits = strspn(name, "0123456789abcdef");
    return digits == DIGEST_TEXT - 1 && !strcmp(name + digits, ".kept");
}

/* ".PROCESS-NUMBER." and the entry's name. */
static bool is_incomplete(const char *name)
{
    const char *point = *name == STALE_SIGN ? strchr(name + 1, '.') : NULL;
    return point && is_entry(point + 1);
}

/* The entries in a folder; removes what somebody began long ago and did not end. */
static size_t list_files(DIR *folder, kept_file **files)
{
    size_t count = 0, room = 0;
    for (struct dirent *e = readdir(folder); e && count < FILES_MAX; e = readdir(folder)) {
        struct stat about;
        bool incomplete = is_incomplete(e->d_name);
        if ((!incomplete && !is_entry(e->d_name)) ||
            fstatat(dirfd(folder), e->d_name, &about, AT_SYMLINK_NOFOLLOW))
            continue;
        if (incomplete) {
            if (time(NULL) - about.st_mtime > ABANDONED_SECONDS)
                unlinkat(dirfd(folder), e->d_name, 0);
            continue;
        }
        if (count == room) {
            kept_file *more = realloc(*files, (room = room ? 2 * room : 64) * sizeof *more);
            if (!more)
                break;
            *files = more;
        }
        kept_file *f = &(*files)[count++];
        *f = (kept_file){.used = about.st_mtim, .size = (size_t)about.st_size};
        memcpy(f->name, e->d_name, strlen(e->d_name) + 1);
    }
    return count;
}

/* Removes the oldest files until no more than `limit` bytes are left. Returns how many are. */
static size_t make_room(const char *path, size_t limit)
{
    kept_file *files = NULL;
    DIR *folder = opendir(path);
    size_t used = 0, count = folder ? list_files(folder, &files) : 0;
    for (size_t i = 0; i < count; i++)
        used += files[i].size;
    if (used > limit)
        qsort(files, count, sizeof *files, by_age);
    for (size_t i = 0; i < count && used > limit; i++) {
        unlinkat(dirfd(folder), files[i].name, 0);
        used -= files[i].size;
    }
    free(files);
    if (folder)
        closedir(folder);
    return used;
}

/* ---- writing -------------------------------------------------------------------------------- */

static int write_all(int file, const char *from, size_t size)
{
    while (size) {
        ssize_t count = write(file, from, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return errno;
        from += count;
        size -= (size_t)count;
    }
    return 0;
}

static int write_entry(const char *path, const digest *key, const char *bytes, size_t size)
{
    char head[CACHE_HEAD_BYTES];
    int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file < 0)
        return errno;
    cache_head_write(key, bytes, size, head);
    int failed = write_all(file, head, sizeof head);
    if (!failed)
        failed = write_all(file, bytes, size);
    if (close(file) && !failed)
        failed = errno;
    if (failed)
        unlink(path);
    return failed;
}

static unsigned next_number(cache_store *s)
{
    pthread_mutex_lock(&s->lock);
    unsigned number = s->written++;
    pthread_mutex_unlock(&s->lock);
    return number;
}

static void count_size(cache_store *s, const char *folder, size_t size, size_t limit)
{
    pthread_mutex_lock(&s->lock);
    s->disk_used += s->disk_used ? size : 0;
    if (!s->disk_used || s->disk_used > limit)
        s->disk_used = make_room(folder, limit);
    pthread_mutex_unlock(&s->lock);
}

int cache_disk_put(cache_store *s, const digest *key, const char *bytes, size_t size, size_t limit)
{
    char folder[PATH_BYTES], path[PATH_BYTES], draft[PATH_BYTES + 64], digits[DIGEST_TEXT];
    if (size > ENTRY_BYTES_MAX - CACHE_HEAD_BYTES || size + CACHE_HEAD_BYTES > limit)
        return EFBIG;
    if (!folder_path(folder) || !entry_path(key, path))
        return ENOENT;
    int failed = make_folder(folder);
    if (failed)
        return failed;
    digest_write(key, digits);
    snprintf(draft, sizeof draft, "%s/%c%ld-%u.%s.kept", folder,
             STALE_SIGN, (long)getpid(), next_number(s), digits);
    failed = write_entry(draft, key, bytes, size);
    if (!failed && rename(draft, path)) {
        failed = errno;
        unlink(draft);
    }
    if (!failed)
        count_size(s, folder, size + CACHE_HEAD_BYTES, limit);
    return failed;
}

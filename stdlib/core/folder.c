/* folder.c - the files of a folder, by the names that a pattern lets through. */
#include "folder.h"
#include "core.h"
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Files of a folder: more than this are an error. */
enum { FOLDER_MAX_FILES = 1 << 20 };

/* `*` stands for any bytes, `?` for one character; the rest for itself. */
static int folder_matches(const char *pattern, const char *name)
{
    const char *star = 0, *resume = 0;
    while (*name) {
        if (*pattern == '*') {
            star = ++pattern;
            resume = name;
        } else if (*pattern == '?' || *pattern == *name) {
            name++;
            while (*pattern == '?' && ((unsigned char)*name & 0xC0) == 0x80) {
                name++; /* the rest of a character of several bytes */
            }
            pattern++;
        } else if (star) {
            pattern = star;
            name = ++resume;
        } else {
            return 0;
        }
    }
    while (*pattern == '*') {
        pattern++;
    }
    return *pattern == 0;
}

static int folder_compare(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static const char *folder_join(pcg_run *run, const char *folder, const char *name)
{
    size_t length = strlen(folder);
    const char *slash = length == 0 || folder[length - 1] == '/' ? "" : "/";
    return pcg_format(run, "%s%s%s", folder, slash, name);
}

/* Status; PCG_OK also where `name` is no file that counts. */
static int folder_add(pcg_call *call, folder_listing *l, const char *real, const char *name)
{
    struct stat about;
    if (name[0] == '.' || !folder_matches(l->pattern, name)) {
        return PCG_OK;
    }
    const char *path = folder_join(call->run, real, name);
    if (!path) {
        return PCG_FAILED;
    }
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode)) {
        return PCG_OK;
    }
    if (l->count == FOLDER_MAX_FILES) {
        return pcg_fail(call, "folder '%s' holds more than %d files", l->folder, FOLDER_MAX_FILES);
    }
    if (l->count == l->capacity) {
        pcg_u32 capacity = l->capacity ? 2 * l->capacity : 16;
        const char **files = pcg_alloc(call->run, capacity * sizeof *files);
        if (!files) {
            return PCG_FAILED;
        }
        if (l->count) {
            memcpy(files, l->files, l->count * sizeof *files);
        }
        l->files = files;
        l->capacity = capacity;
    }
    l->files[l->count] = folder_join(call->run, l->folder, name);
    return l->files[l->count++] ? PCG_OK : PCG_FAILED;
}

static int folder_read(pcg_call *call, folder_listing *l)
{
    const char *real = pcg_path(call, l->folder);
    DIR *folder = real ? opendir(real) : 0;
    if (!folder) {
        const char *why = errno == ENOENT ? "there is none of that name" : "it cannot be read";
        return pcg_warn_once(call, "no file from folder '%s': %s", l->folder, why);
    }
    int status = PCG_OK;
    for (struct dirent *e = readdir(folder); e && status == PCG_OK; e = readdir(folder)) {
        status = folder_add(call, l, real, e->d_name);
        if (status == PCG_OK) {
            status = pcg_tick(call);
        }
    }
    closedir(folder);
    if (status == PCG_OK && l->count == 0) {
        status = pcg_warn_once(call, "folder '%s' holds no file that fits '%s'", l->folder, l->pattern);
    }
    if (l->count > 1) {
        qsort(l->files, l->count, sizeof *l->files, folder_compare);
    }
    return status;
}

int core_folder_listing(pcg_call *call, const char *folder, const char *pattern,
                      folder_listing **found)
{
    folder_listing *l = call->instance->state;
    while (l && (strcmp(l->folder, folder) != 0 || strcmp(l->pattern, pattern) != 0)) {
        l = l->next;
    }
    *found = l;
    if (l) {
        return PCG_OK;
    }
    l = pcg_alloc(call->run, sizeof *l);
    if (!l) {
        return PCG_FAILED;
    }
    l->folder = folder;
    l->pattern = pattern;
    l->next = call->instance->state;
    call->instance->state = l;
    *found = l;
    return folder_read(call, l);
}

pcg_u32 core_folder_draw(const pcg_call *call, const folder_listing *l)
{
    pcg_u32 drawn = (pcg_u32)(pcg_random(call, CORE_RANDOM_SITE, 0) * l->count);
    return drawn < l->count ? drawn : 0;
}

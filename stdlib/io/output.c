/* output.c - files that appear whole or not at all, written in large blocks. */
#include "stdlib/io/io.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_SIZE = 1 << 20, NAMES_TRIED = 1000 };

static void fail_errno(io_output *o, const char *what, int error)
{
    pcg_status status = error == ENOSPC || error == EFBIG || error == EIO ? PCG_STATUS_FAILED
                                                                          : PCG_STATUS_MISUSE;
    io_fail(o->job, status, "cannot %s '%s': %s", what, o->path, strerror(error));
}

/* ---- opening --------------------------------------------------------------------------------- */

/* False with errno set. From then on Ctrl+C removes it. */
static bool create_unfinished(io_output *o, const char *name)
{
    interrupt *guard = result_guard(o->job->run);
    interrupt_lock(guard);
    o->file = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    int error = errno;
    if (o->file >= 0) {
        o->temporary = name;
        interrupt_keep(guard, &o->unfinished, name);
    }
    interrupt_unlock(guard);
    errno = error;
    return o->file >= 0;
}

/* A name for the file while it grows, in the folder of the target. */
static bool open_temporary(io_output *o)
{
    io_job *j = o->job;
    const char *slash = strrchr(o->target, '/');
    int folder = slash ? (int)(slash + 1 - o->target) : 0;
    for (int i = 0; i < NAMES_TRIED; i++) {
        const char *name = arena_format(&j->memory, "%.*s.pcgc-%ld-%d.part", folder, o->target,
                                        (long)getpid(), i);
        if (create_unfinished(o, name))
            return true;
        if (errno != EEXIST)
            break;
    }
    return false;
}

/* Where a link leads, so that the link stays; else the path itself. */
static const char *resolve_link(io_output *o)
{
    char *real = realpath(o->path, NULL);
    if (!real)
        return o->path;
    const char *copy = arena_copy(&o->job->memory, real, strlen(real));
    free(real);
    return copy;
}

static bool open_path(io_output *o)
{
    struct stat s;
    bool exists = stat(o->path, &s) == 0;
    if (exists && S_ISDIR(s.st_mode)) {
        errno = EISDIR;
        return false;
    }
    if (exists && !S_ISREG(s.st_mode)) {
        o->file = open(o->path, O_WRONLY | O_CLOEXEC);
        return o->file >= 0;
    }
    struct stat link;
    bool is_link = exists && lstat(o->path, &link) == 0 && S_ISLNK(link.st_mode);
    o->target = is_link ? resolve_link(o) : o->path;
    return open_temporary(o);
}

io_output *output_open(io_job *j, const char *path)
{
    io_output *o = ARENA_NEW(&j->memory, io_output);
    o->job = j;
    o->path = arena_copy(&j->memory, path, strlen(path));
    o->buffer = arena_alloc(&j->memory, BUFFER_SIZE);
    o->file = -1;
    o->next = j->outputs;
    j->outputs = o;
    if (j->status != PCG_STATUS_OK)
        return o;
    if (strcmp(path, "-") == 0)
        o->file = STDOUT_FILENO;
    else if (!open_path(o))
        fail_errno(o, "write", errno);
    return o;
}

/* ---- writing --------------------------------------------------------------------------------- */

static void write_all(io_output *o, const unsigned char *bytes, size_t size)
{
    while (size && !io_stopped(o->job)) {
        ssize_t done = write(o->file, bytes, size);
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0) {
            fail_errno(o, "write", errno);
            return;
        }
        bytes += done;
        size -= (size_t)done;
        o->flushed += (uint64_t)done;
    }
}

static void flush(io_output *o)
{
    write_all(o, o->buffer, o->used);
    o->used = 0;
}

void output_bytes(io_output *o, const void *bytes, size_t size)
{
    if (o->job->status != PCG_STATUS_OK)
        return;
    if (size > BUFFER_SIZE - o->used)
        flush(o);
    if (size > BUFFER_SIZE) {
        write_all(o, bytes, size);
    } else if (size) {
        memcpy(o->buffer + o->used, bytes, size);
        o->used += size;
    }
}

void output_text(io_output *o, const char *string)
{
    output_bytes(o, string, strlen(string));
}

uint64_t output_position(const io_output *o)
{
    return o->flushed + o->used;
}

bool output_patchable(const io_output *o)
{
    return o->temporary != NULL;
}

void output_patch(io_output *o, uint64_t position, const void *bytes, size_t size)
{
    flush(o);
    while (size && !io_stopped(o->job)) {
        ssize_t done = pwrite(o->file, bytes, size, (off_t)position);
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0) {
            fail_errno(o, "write", errno);
            return;
        }
        bytes = (const char *)bytes + done;
        size -= (size_t)done;
        position += (uint64_t)done;
    }
}

/* One block from where it is to where it goes; false where that fails. */
static bool move_block(io_output *o, uint64_t from, uint64_t to, size_t size)
{
    size_t done = 0;
    while (done < size && !io_stopped(o->job)) {
        ssize_t got = pread(o->file, o->buffer + done, size - done, (off_t)(from + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0) {
            fail_errno(o, "write", got < 0 ? errno : EIO);
            return false;
        }
        done += (size_t)got;
    }
    output_patch(o, to, o->buffer, done);
    return !io_stopped(o->job);
}

void output_shift(io_output *o, uint64_t position, uint64_t by)
{
    flush(o);
    uint64_t at = o->flushed;
    while (at > position) {
        uint64_t left = at - position;
        size_t size = left < BUFFER_SIZE ? (size_t)left : BUFFER_SIZE;
        at -= size;
        if (!move_block(o, at, at + by, size))
            return;
    }
    o->flushed += by;
    if (lseek(o->file, (off_t)o->flushed, SEEK_SET) < 0)
        fail_errno(o, "write", errno);
}

/* ---- ending ---------------------------------------------------------------------------------- */

/* stdout stays open: it is not ours. */
static void close_output(io_output *o)
{
    if (o->file >= 0 && o->file != STDOUT_FILENO && close(o->file) != 0)
        fail_errno(o, "write", errno);
    o->file = -1;
}

/* The file has its last name, or is gone. With the guard's lock held. */
static void forget_unfinished(io_output *o)
{
    interrupt_drop(result_guard(o->job->run), &o->unfinished);
    o->temporary = NULL;
}

static void name_output(io_output *o)
{
    if (o->job->status != PCG_STATUS_OK || !o->temporary)
        return;
    if (rename(o->temporary, o->target) == 0)
        forget_unfinished(o);
    else
        fail_errno(o, "write", errno);
}

void outputs_end(io_job *j)
{
    for (io_output *o = j->outputs; o; o = o->next) {
        if (o->file >= 0)
            flush(o);
        close_output(o);
    }
    interrupt *guard = result_guard(j->run);
    interrupt_lock(guard); /* all of them appear, or none */
    if (!io_stopped(j))
        for (io_output *o = j->outputs; o; o = o->next)
            name_output(o);
    interrupt_unlock(guard);
    outputs_discard(j);
}

void outputs_discard(io_job *j)
{
    interrupt *guard = result_guard(j->run);
    for (io_output *o = j->outputs; o; o = o->next) {
        close_output(o);
        interrupt_lock(guard);
        if (o->temporary)
            unlink(o->temporary);
        forget_unfinished(o);
        interrupt_unlock(guard);
    }
    j->outputs = NULL;
}

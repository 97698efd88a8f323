/* source.c - a file's text and its lines. */
#include "base.h"

#include <errno.h>
#include <string.h>

enum { FIRST_READ = 32 << 10 };

source *source_new(arena *a, const char *path, const char *bytes, size_t size)
{
    source *s = ARENA_NEW(a, source);
    if (!s)
        return NULL;
    s->path = path;
    s->text = bytes;
    s->size = size < UINT32_MAX ? size : UINT32_MAX - 1; /* places are 32 bits */
    size_t lines = 1;
    for (size_t i = 0; i < s->size; i++)
        lines += bytes[i] == '\n';
    s->lines = ARENA_ARRAY(a, uint32_t, lines);
    if (!s->lines)
        return NULL;
    s->line_count = 1;
    for (size_t i = 0; i < s->size; i++)
        if (bytes[i] == '\n')
            s->lines[s->line_count++] = (uint32_t)(i + 1);
    return s;
}

/* Everything that is left in a stream, with a NUL behind; NULL with errno set. The arena must not
 * jump: the caller has a file to close. */
static char *read_all(arena *a, FILE *in, size_t limit, size_t *size)
{
    size_t capacity = FIRST_READ, length = 0;
    char *buffer = arena_alloc(a, capacity);
    errno = ENOMEM;
    while (buffer) {
        errno = 0;
        length += fread(buffer + length, 1, capacity - 1 - length, in);
        if (ferror(in)) {
            errno = errno ? errno : EIO;
            return NULL;
        }
        if (length > limit) {
            errno = EFBIG;
            return NULL;
        }
        if (feof(in))
            break;
        if (length == capacity - 1) {
            buffer = arena_resize(a, buffer, capacity, capacity * 2);
            capacity *= 2;
            errno = ENOMEM;
        }
    }
    if (buffer)
        buffer[length] = '\0';
    *size = length;
    return buffer;
}

/* Reads, closes where asked to, and only then lets the arena's failure jump. */
static source *read_and_close(arena *a, const char *path, FILE *in, size_t limit, bool close)
{
    jmp_buf *on_failure = a->on_failure;
    size_t size = 0;
    a->on_failure = NULL;
    char *bytes = read_all(a, in, limit < UINT32_MAX ? limit : UINT32_MAX - 1, &size);
    int error = errno;
    if (close)
        fclose(in);
    a->on_failure = on_failure;
    errno = error;
    if (!bytes && error == ENOMEM && on_failure)
        longjmp(*on_failure, 1);
    if (!bytes)
        return NULL;
    char *kept = arena_copy(a, path, strlen(path));
    source *s = kept ? source_new(a, kept, bytes, size) : NULL;
    if (!s)
        errno = ENOMEM;
    return s;
}

source *source_read_stream(arena *a, const char *path, FILE *in, size_t limit)
{
    return read_and_close(a, path, in, limit, false);
}

source *source_read(arena *a, const char *path, size_t limit)
{
    FILE *in = fopen(path, "rb");
    return in ? read_and_close(a, path, in, limit, true) : NULL;
}

/* The last line that begins at or before the offset. */
static uint32_t line_of(const source *s, uint32_t offset)
{
    uint32_t low = 0, high = s->line_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (s->lines[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void source_place(const source *s, uint32_t offset, uint32_t *line, uint32_t *column)
{
    if (offset > s->size)
        offset = (uint32_t)s->size;
    uint32_t index = line_of(s, offset);
    uint32_t characters = 0;
    for (uint32_t i = s->lines[index]; i < offset; i++)
        characters += ((unsigned char)s->text[i] & 0xC0) != 0x80;
    *line = index + 1;
    *column = characters + 1;
}

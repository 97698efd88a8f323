/* arena.c - memory that is given back all at once, and the lists that grow in it. */
#include "base.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 16, FIRST_BLOCK = 16 << 10, LARGEST_BLOCK = 1 << 20 };

/* The head of each piece that was taken from the system; what is given out follows it. */
struct arena_block {
    struct arena_block *next;
    size_t size; /* the head included */
};

enum { HEAD = (sizeof(struct arena_block) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT };

static void *fail(arena *a)
{
    if (a->on_failure)
        longjmp(*a->on_failure, 1);
    return NULL;
}

/* NULL where the system, or the limit, gives no more. */
static struct arena_block *block_new(arena *a, size_t size)
{
    if (a->limit && (size > a->limit || a->used > a->limit - size))
        return NULL;
    struct arena_block *b = calloc(1, size);
    if (!b)
        return NULL;
    b->size = size;
    a->used += size;
    return b;
}

/* A large piece gets a block of its own, behind the one that is being carved. */
static void *alloc_apart(arena *a, size_t size)
{
    struct arena_block *b = block_new(a, HEAD + size);
    if (!b)
        return fail(a);
    if (a->block) {
        b->next = a->block->next;
        a->block->next = b;
    } else {
        a->block = b;
        a->at = a->end = (char *)b + b->size;
    }
    return (char *)b + HEAD;
}

/* Blocks grow with the arena, so that a small one stays small and a large one makes few calls. */
static size_t block_size(const arena *a)
{
    size_t size = a->used < FIRST_BLOCK ? FIRST_BLOCK : a->used;
    return size < LARGEST_BLOCK ? size : LARGEST_BLOCK;
}

void *arena_alloc(arena *a, size_t size)
{
    if (size > SIZE_MAX / 2)
        return fail(a);
    size = (size + (size == 0) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if ((size_t)(a->end - a->at) < size) {
        size_t whole = block_size(a);
        if (size > (whole - HEAD) / 2)
            return alloc_apart(a, size);
        struct arena_block *b = block_new(a, whole);
        if (!b)
            return alloc_apart(a, size); /* a little may still be left below the limit */
        b->next = a->block;
        a->block = b;
        a->at = (char *)b + HEAD;
        a->end = (char *)b + whole;
    }
    void *result = a->at;
    a->at += size;
    return result;
}

void *arena_alloc_array(arena *a, size_t size, size_t count)
{
    if (size && count > SIZE_MAX / size)
        return fail(a);
    return arena_alloc(a, size * count);
}

void *arena_resize(arena *a, void *old, size_t old_size, size_t size)
{
    if (size <= old_size)
        return old;
    size_t room = (old_size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (old && a->at == (char *)old + room && size < SIZE_MAX / 2) {
        size_t more = (size - room + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
        if (size <= room)
            return old;
        if ((size_t)(a->end - a->at) >= more) {
            a->at += more;
            return old;
        }
    }
    void *result = arena_alloc(a, size);
    if (result && old)
        memcpy(result, old, old_size);
    return result;
}

char *arena_copy(arena *a, const char *bytes, size_t length)
{
    char *result = arena_alloc(a, length + 1);
    if (result && length)
        memcpy(result, bytes, length);
    return result;
}

char *arena_format_list(arena *a, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    char *result = length < 0 ? NULL : arena_alloc(a, (size_t)length + 1);
    if (result)
        vsnprintf(result, (size_t)length + 1, format, again);
    va_end(again);
    return length < 0 ? fail(a) : result;
}

char *arena_format(arena *a, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *result = arena_format_list(a, format, arguments);
    va_end(arguments);
    return result;
}

void arena_free(arena *a)
{
    struct arena_block *b = a->block;
    while (b) {
        struct arena_block *next = b->next;
        free(b);
        b = next;
    }
    a->block = NULL;
    a->at = a->end = NULL;
    a->used = 0;
}

/* `at` points to a pointer of some type; its bytes are copied, since it must not be read as a void
 * *. */
void list_reserve(arena *a, void **at, uint32_t *capacity, uint32_t count, size_t size)
{
    if (count < *capacity)
        return;
    uint32_t wanted = *capacity < 4 ? 4 : *capacity > UINT32_MAX / 2 ? UINT32_MAX : *capacity * 2;
    void *array;
    memcpy(&array, (const void *)at, sizeof array);
    if (wanted <= count || wanted > SIZE_MAX / size)
        array = fail(a);
    else
        array = arena_resize(a, array, *capacity * size, wanted * size);
    assert(array && "a list's arena must have on_failure set");
    memcpy((void *)at, &array, sizeof array);
    *capacity = wanted;
}

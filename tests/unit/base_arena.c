/* base_arena.c - arenas and the lists that grow in them. */
#include "../../runtime/base/base.h"

#include "unit.h"

static bool is_zero(const char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (bytes[i])
            return false;
    return true;
}

static void gives_zeroed_aligned_memory(void)
{
    arena a = {0};
    bool aligned = true, zero = true;
    for (size_t size = 0; size < 3000; size += 7) {
        char *bytes = arena_alloc(&a, size);
        aligned = aligned && (uintptr_t)bytes % 16 == 0;
        zero = zero && is_zero(bytes, size);
        memset(bytes, 0xAA, size);
    }
    CHECK(aligned);
    CHECK(zero);
    char *large = arena_alloc(&a, 5 << 20);
    CHECK(large && is_zero(large, 5 << 20));
    char *small = arena_alloc(&a, 1);
    CHECK(small && small != large);
    arena_free(&a);
    CHECK(a.used == 0);
    CHECK(arena_alloc(&a, 10) != NULL); /* it can be used again */
    arena_free(&a);
}

static void keeps_its_limit(void)
{
    arena a = {.limit = 100000};
    size_t given = 0;
    while (arena_alloc(&a, 1000))
        given += 1000;
    CHECK(given > 50000 && given < 100000);
    CHECK(a.used <= a.limit);
    CHECK(arena_alloc(&a, SIZE_MAX) == NULL);
    CHECK(arena_alloc_array(&a, SIZE_MAX / 2, 3) == NULL);
    arena_free(&a);
}

static void jumps_on_failure(void)
{
    arena a = {.limit = 1000};
    jmp_buf failed;
    volatile bool jumped = false;
    a.on_failure = &failed;
    if (setjmp(failed))
        jumped = true;
    else
        arena_alloc(&a, 2000);
    CHECK(jumped);
    arena_free(&a);
}

static void resizes(void)
{
    arena a = {0};
    char *first = arena_alloc(&a, 20);
    memcpy(first, "0123456789", 11);
    char *grown = arena_resize(&a, first, 20, 200);
    CHECK(grown == first); /* the newest grows in place */
    CHECK_TEXT(grown, "0123456789");
    CHECK(is_zero(grown + 20, 180));
    arena_alloc(&a, 1);
    char *moved = arena_resize(&a, grown, 200, 400);
    CHECK(moved != grown);
    CHECK_TEXT(moved, "0123456789");
    CHECK(arena_resize(&a, moved, 400, 10) == moved);
    CHECK(is_zero(arena_resize(&a, NULL, 0, 50), 50));
    arena_free(&a);
}

static void copies_and_formats(void)
{
    arena a = {0};
    CHECK_TEXT(arena_copy(&a, "abcdef", 3), "abc");
    CHECK_TEXT(arena_copy(&a, NULL, 0), "");
    CHECK_TEXT(arena_format(&a, "%s-%d", "x", 7), "x-7");
    arena_free(&a);
}

static void lists_grow(void)
{
    arena a = {0};
    LIST(int) list = {0};
    bool kept = true;
    for (int i = 0; i < 1000; i++) {
        LIST_ADD(&a, &list, i);
        if (i % 10 == 0)
            arena_alloc(&a, 3); /* so that it must move */
    }
    for (int i = 0; i < 1000; i++)
        kept = kept && list.at[i] == i;
    CHECK_INTEGER(list.count, 1000);
    CHECK(kept);
    arena_free(&a);
}

int main(void)
{
    gives_zeroed_aligned_memory();
    keeps_its_limit();
    jumps_on_failure();
    resizes();
    copies_and_formats();
    lists_grow();
    return unit_done();
}

/* memory_test.c - blocks of a run's memory: every size is there, on its own, whatever came
 * before. */
#include <string.h>

#include "runtime/memory.h"
#include "unit.h"

enum { LIMIT = 64 << 20 };

/* The first block of a run may be larger than the chunk that memory begins with. */
static void test_first_block(void)
{
    for (size_t size = 1; size < 2 * (size_t)MEMORY_CLASS_MAX; size += size / 3 + 1) {
        run_memory m;
        memory_open(&m, LIMIT);
        char *block = memory_take(&m, size);
        CHECK(block != NULL);
        if (block)
            memset(block, 1, size);
        memory_close(&m);
    }
}

/* Sizes that rise and fall: no block lies in another. */
static void test_apart(void)
{
    enum { COUNT = 40 };
    unsigned char *blocks[COUNT];
    run_memory m;
    memory_open(&m, LIMIT);
    for (size_t i = 0; i < COUNT; i++) {
        size_t size = i % 2 ? 1 + i : 5000 * i + 1;
        blocks[i] = memory_take(&m, size);
        CHECK(blocks[i] != NULL);
        if (blocks[i])
            memset(blocks[i], (int)i, size);
    }
    for (size_t i = 0; i < COUNT; i++) {
        size_t size = i % 2 ? 1 + i : 5000 * i + 1;
        CHECK(blocks[i] && blocks[i][0] == i && blocks[i][size - 1] == i);
    }
    memory_close(&m);
}

static void test_limit(void)
{
    run_memory m;
    memory_open(&m, 100 << 10);
    CHECK(memory_take(&m, 90 << 10) != NULL);
    CHECK(memory_take(&m, 90 << 10) == NULL);
    CHECK(memory_take(&m, 1 << 20) == NULL);
    memory_close(&m);
}

int main(void)
{
    test_first_block();
    test_apart();
    test_limit();
    return unit_done();
}

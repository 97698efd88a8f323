/* check_fuzz.c - any text through parse, resolve, check and order; and the dumps of what is sound.
 * No file is read. */
#include <stdlib.h>
#include <string.h>

#include "../../compiler/compiler.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MEMORY = 256 << 20 };

static void compile(compilation *c, const char *bytes, size_t size)
{
    text out = {.arena = &c->arena};
    const source *s = source_new(&c->arena, "fuzz.pcg", bytes, size);
    program *p = compile_front(c, s);
    if (p && !c->diagnostics.errors) {
        dump_check(p, &out);
        dump_order(p, &out);
    }
    for (uint32_t i = 0; i < c->diagnostics.list.count; i++)
        diagnostic_write(&c->diagnostics.list.at[i], false, &out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    jmp_buf out_of_memory;
    compilation *c = calloc(1, sizeof *c);
    char *bytes = malloc(size + 1);
    if (c && bytes && !setjmp(out_of_memory)) {
        memcpy(bytes, data, size);
        bytes[size] = '\0';
        c->arena.limit = MEMORY;
        c->arena.on_failure = &out_of_memory;
        c->diagnostics.arena = &c->arena;
        c->closed = true;
        compile(c, bytes, size);
    }
    if (c)
        compilation_end(c);
    free(c);
    free(bytes);
    return 0;
}

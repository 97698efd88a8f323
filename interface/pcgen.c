/* pcgen.c - the generator's command line: pcgen --abi FILE -o FOLDER LIBRARY… */
#include "pcgen.h"

#include <string.h>

static void generate(pcgen *g, const char *abi, char **folders, int count)
{
    for (int i = 0; i < count; i++) {
        pcgen_read_library(g, folders[i], NULL);
    }
    if (!g->failed) {
        pcgen_check(g);
    }
    if (!g->failed && g->diagnostics.errors == 0) {
        pcgen_write_headers(g);
        pcgen_write_registry(g);
        pcgen_write_abi(g, abi);
        pcgen_make_examples(g);
        pcgen_write_examples(g);
    }
    diagnostics_print(&g->diagnostics, stderr, false);
}

static int usage(void)
{
    fputs("usage: pcgen --abi FILE -o FOLDER LIBRARY…\n", stderr);
    return 2;
}

/* As generate; memory that runs out ends it. */
static int generate_guarded(pcgen *g, const char *abi, char **folders, int count)
{
    jmp_buf no_memory;
    if (setjmp(no_memory)) {
        fputs("pcgen: out of memory\n", stderr);
        return 1;
    }
    g->arena.on_failure = &no_memory;
    generate(g, abi, folders, count);
    return g->failed || g->diagnostics.errors > 0;
}

int main(int argc, char **argv)
{
    const char *abi = NULL, *output = NULL;
    int at = 1;
    for (; at + 1 < argc && argv[at][0] == '-'; at += 2) {
        if (strcmp(argv[at], "--abi") == 0) {
            abi = argv[at + 1];
        } else if (strcmp(argv[at], "-o") == 0) {
            output = argv[at + 1];
        } else {
            return usage();
        }
    }
    if (!abi || !output) {
        return usage();
    }
    pcgen g = {0};
    pcgen_begin(&g, "pcgen", output);
    int status = generate_guarded(&g, abi, argv + at, argc - at);
    arena_free(&g.arena);
    return status;
}

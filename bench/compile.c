/* compile.c - libtcc alone on the C that pcgc has emitted: what a graph costs to compile when all
 * else is there. The text becomes machine code; it is not linked, since nothing runs.
 *
 *     compile FILE.c
 */
#include <errno.h>
#include <libtcc.h>
#include <string.h>

#include "compiler/backend.h"
#include "rival.h"

static char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    size_t room = 1 << 16, length = 0, got;
    char *at = rival_array(room, 1);
    if (!file)
        rival_fail(path);
    while ((got = fread(at + length, 1, room - 1 - length, file)) > 0) {
        length += got;
        if (room - 1 == length) {
            at = realloc(at, room *= 2);
            if (!at)
                rival_fail("memory");
        }
    }
    fclose(file);
    at[length] = '\0';
    return at;
}

static void show(void *context, const char *message)
{
    (void)context;
    fprintf(stderr, "%s\n", message);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: compile FILE.c\n", stderr);
        return 2;
    }
    char *c_text = read_text(argv[1]);
    rival r = {0};
    tcc_take_variables();
    rival_begin(&r);
    TCCState *s = tcc_new();
    if (!s)
        rival_fail("libtcc");
    tcc_set_error_func(s, NULL, show);
    tcc_set_options(s, "-nostdlib -nostdinc");
    tcc_set_output_type(s, TCC_OUTPUT_MEMORY);
    tcc_define_symbol(s, "PCG_SHARED", "1");
    const int status = tcc_compile_string(s, c_text);
    rival_end(&r, "compile");
    if (status == 0)
        rival_print(&r, "bytes", strlen(c_text));
    tcc_delete(s);
    free(c_text);
    return status == 0 ? 0 : 1;
}

/* backend_executable.c - emitted C to a program of its own, with the runtime inside.
 *
 * The runtime's names stay visible, for the libraries that the program opens.
 * libtcc makes the object, or a C compiler does with -O2; the C compiler links it with
 * libpcgrt.a either way. */
#include <libtcc.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backend.h"

/* ---- the runtime ----------------------------------------------------------------------------- */

const char *program_folder(arena *a)
{
    char path[4096];
    ssize_t length = readlink("/proc/self/exe", path, sizeof path);
    while (length > 0 && path[length - 1] != '/') {
        length--;
    }
    return length > 0 ? arena_copy(a, path, (size_t)length) : "";
}

/* Beside pcgc where it was built, below it for its tests, then where it was installed. */
static const char *find_runtime(arena *a, complaint *c)
{
    const char *own = program_folder(a);
    const char *const places[] = {
        arena_format(a, "%slibpcgrt.a", own),
        arena_format(a, "%s../lib/libpcgrt.a", own),
        arena_format(a, "%s../lib/" PCG_MULTIARCH "/libpcgrt.a", own),
        arena_format(a, "%s../libpcgrt.a", own),
        arena_format(a, "%s../../libpcgrt.a", own),
        PCG_PREFIX "/lib/libpcgrt.a",
    };
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        if (access(places[i], R_OK) == 0) {
            return places[i];
        }
    }
    complain(c, "libpcgrt.a is neither beside %s nor in " PCG_PREFIX "/lib", *own ? own : "pcgc");
    return NULL;
}

/* ---- backends -------------------------------------------------------------------------------- */

typedef struct linking {
    const char *runtime;  /* libpcgrt.a */
    partial_file program; /* what becomes the program */
    partial_file object;  /* what libtcc makes of the C */
    interrupt *guard;
} linking;

static bool by_compiler(const char *cc, const char *c_text, const linking *k, complaint *c)
{
    const char *const arguments[] = {
        "-O2", "-std=c11", "-ffp-contract=off", "-DPCG_EXECUTABLE", "-rdynamic", "-o",
        k->program.name, "-x", "c", "-", "-x", "none", k->runtime, "-ldl", "-lm", "-lpthread", NULL};
    return run_compiler(cc, arguments, c_text, c, NULL, k->guard);
}

static bool write_object(void *context, TCCState *s, complaint *c)
{
    const linking *k = context;
    (void)c;
    interrupt_lock(k->guard); /* libtcc opens the file when it likes */
    bool done = tcc_output_file(s, k->object.name) == 0;
    interrupt_unlock(k->guard);
    return done;
}

/* libtcc's objects hold absolute addresses: the program is linked to a fixed place. */
static bool by_tcc(const char *c_text, linking *k, complaint *c)
{
    bool missing = false;
    const char *const arguments[] = {
        "-no-pie", "-rdynamic", "-z", "noexecstack", "-o", k->program.name, k->object.name,
        k->runtime, "-ldl", "-lm", "-lpthread", NULL};
    bool done = tcc_compile(c_text, "PCG_EXECUTABLE", TCC_OUTPUT_OBJ, c, write_object, k, NULL) &&
                run_compiler("cc", arguments, "", c, &missing, k->guard);
    if (missing) {
        complain(c, ": a C compiler is needed to link a program (a .so is made without)");
    }
    return done;
}

bool write_executable(const program *p, const char *c_text, const char *path, const char *cc,
                      interrupt *guard, char **error)
{
    complaint c = {0};
    linking k = {.runtime = find_runtime(p->arena, &c), .guard = guard};
    partial_begin(&k.program, p->arena, path, "", guard);
    partial_begin(&k.object, p->arena, path, ".o", guard);
    bool done = k.runtime && (cc ? by_compiler(cc, c_text, &k, &c) : by_tcc(c_text, &k, &c));
    partial_end(&k.object, false, NULL, &c);
    if (partial_end(&k.program, done, path, &c)) {
        free(c.text);
        return true;
    }
    return complain_to(&c, error);
}

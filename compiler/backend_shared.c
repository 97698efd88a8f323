/* backend_shared.c - emitted C to a shared object: by libtcc, or by a C compiler.
 *
 * It leaves the names of the runtime and of kernels undefined: they are found in the process
 * that loads it. It needs no other library, and says that it needs no executable stack. */
#include <elf.h>
#include <errno.h>
#include <libtcc.h>
#include <stdlib.h>
#include <string.h>

#include "backend.h"

/* ---- the stack note that libtcc leaves out --------------------------------------------------- */

enum { ELF_PAGE = 4096 };

/* The program headers move to the end of the file, with one more, on a page that no segment is
 * loaded from: what the loader clears behind a segment's data does not reach them there. */
static bool add_stack_header(const char *file, size_t size, FILE *out)
{
    Elf64_Ehdr head;
    if (size < sizeof head) {
        return false;
    }
    memcpy(&head, file, sizeof head);
    size_t old = (size_t)head.e_phnum * sizeof(Elf64_Phdr);
    if (memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_phentsize != sizeof(Elf64_Phdr) ||
        head.e_phoff > size || size - head.e_phoff < old) {
        return false;
    }
    const Elf64_Phdr stack = {.p_type = PT_GNU_STACK, .p_flags = PF_R | PF_W, .p_align = 16};
    size_t from = (size_t)head.e_phoff, to = (size + ELF_PAGE - 1) / ELF_PAGE * ELF_PAGE;
    head.e_phoff = to;
    head.e_phnum++;
    return fwrite(&head, sizeof head, 1, out) == 1 && fseek(out, (long)to, SEEK_SET) == 0 &&
           fwrite(file + from, 1, old, out) == old && fwrite(&stack, sizeof stack, 1, out) == 1 &&
           fflush(out) == 0;
}

static bool mend(const char *path, complaint *c)
{
    enum { MOST_BYTES = 1 << 30 };
    arena memory = {0};
    const source *file = source_read(&memory, path, MOST_BYTES);
    FILE *out = file ? fopen(path, "r+b") : NULL;
    bool done = out && add_stack_header(file->text, file->size, out);
    if (out && fclose(out) != 0) {
        done = false;
    }
    if (!done) {
        complain(c, "what libtcc wrote cannot be completed");
    }
    arena_free(&memory);
    return done;
}

/* ---- backends -------------------------------------------------------------------------------- */

static bool write_output(void *context, TCCState *s, complaint *c)
{
    const partial_file *partial = context;
    (void)c;
    interrupt_lock(partial->guard); /* libtcc opens the file when it likes */
    bool done = tcc_output_file(s, partial->name) == 0;
    interrupt_unlock(partial->guard);
    return done;
}

static bool shared_by_tcc(const char *c_text, partial_file *partial, complaint *c)
{
    return tcc_compile(c_text, "PCG_SHARED", TCC_OUTPUT_DLL, c, write_output, partial, NULL) &&
           mend(partial->name, c);
}

/* `debuggable`: as it is written, with lines and names for a debugger. */
static bool shared_by_compiler(const char *cc, const char *c_text, bool debuggable,
                               const partial_file *partial, complaint *c)
{
    const char *const arguments[] = {
        debuggable ? "-O0" : "-O2", debuggable ? "-g" : "-O2", "-std=c11", "-ffp-contract=off", "-fPIC", "-shared", "-nostdlib", "-DPCG_SHARED",
        "-x", "c", "-o", partial->name, "-", NULL};
    return run_compiler(cc, arguments, c_text, c, NULL, partial->guard);
}

static bool write_object(const program *p, const char *c_text, const char *path, const char *cc,
                         bool debuggable, interrupt *guard, char **error)
{
    complaint c = {0};
    partial_file partial = {0};
    partial_begin(&partial, p->arena, path, "", guard);
    bool done = cc ? shared_by_compiler(cc, c_text, debuggable, &partial, &c)
                   : shared_by_tcc(c_text, &partial, &c);
    if (partial_end(&partial, done, path, &c)) {
        free(c.text);
        return true;
    }
    return complain_to(&c, error);
}

bool write_shared(const program *p, const char *c_text, const char *path, const char *cc,
                  interrupt *guard, char **error)
{
    return write_object(p, c_text, path, cc, false, guard, error);
}

bool write_debuggable(const program *p, const char *c_text, const char *path, const char *cc,
                      interrupt *guard, char **error)
{
    return write_object(p, c_text, path, cc, true, guard, error);
}

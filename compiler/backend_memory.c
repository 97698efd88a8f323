/* backend_memory.c - emitted C to native code in memory, by libtcc.
 *
 * The code goes into a mapping of our own, which is written first and made executable then; when
 * it runs, nothing is both. Emitted code has no data that it writes. Names of the runtime and of
 * kernels are given their addresses in this process. A later libtcc, whose tcc_relocate takes no
 * address, does the same in a mapping of its own, which lives as long as its state. */
#include <libtcc.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "../runtime/library_open.h"
#include "backend.h"
#include "emit.h"
#include "library.h"

struct native {
    void *memory;    /* NULL where the mapping is libtcc's */
    size_t size;
    TCCState *state; /* which then holds it; else NULL */
    const pcg_module *module;
    condition_function *condition; /* NULL: there is none */
};

/* ---- symbols --------------------------------------------------------------------------------- */

/* An address of a function as libtcc takes it: both are words on every machine that it compiles
 * for. */
static const void *address_of(void (*f)(void))
{
    const void *p;
    memcpy(&p, &f, sizeof p);
    return p;
}

static bool add_symbol(TCCState *s, const char *name, void (*address)(void), complaint *c)
{
    if (!address) {
        complain(c, "no library has the code of '%s'", name);
        return false;
    }
    return tcc_add_symbol(s, name, address_of(address)) == 0;
}

/* What libtcc itself calls to copy and clear structs. */
static void add_memory_functions(TCCState *s)
{
    void *(*copy)(void *, const void *, size_t) = memcpy;
    void *(*move)(void *, const void *, size_t) = memmove;
    void *(*set)(void *, int, size_t) = memset;
    tcc_add_symbol(s, "memcpy", address_of((void (*)(void))copy));
    tcc_add_symbol(s, "memmove", address_of((void (*)(void))move));
    tcc_add_symbol(s, "memset", address_of((void (*)(void))set));
}

/* The code calls kernels by name where their library is built in; others are the program's to find.
 */
static bool add_kernel(TCCState *s, const pcg_library *l, const char *name, complaint *c)
{
    const library_symbol *found = library_find_symbol(l, name);
    return !library_is_builtin(l) || add_symbol(s, name, found ? found->address : NULL, c);
}

static bool add_symbols(const program *p, TCCState *s, complaint *c)
{
    bool done = true;
    add_memory_functions(s);
    for (uint32_t i = 0; i < pcg_abi_symbol_count; i++) {
        done &= add_symbol(s, pcg_abi_symbols[i].name, pcg_abi_symbols[i].address, c);
    }
    for (uint32_t i = 0; i < p->procedures.count; i++) {
        done &= add_kernel(s, p->procedures.at[i]->library, p->procedures.at[i]->symbol, c);
    }
    for (uint32_t i = 0; i < p->functions.count; i++) {
        done &= add_kernel(s, p->functions.at[i]->library, p->functions.at[i]->symbol, c);
    }
    return done;
}

/* ---- placing code ---------------------------------------------------------------------------- */

typedef struct placing {
    const program *p;
    native *n;
} placing;

#if PCG_TCC_RELOCATE_ARGS == 2
static size_t whole_pages(size_t size)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    return (size + page - 1) / page * page;
}

static bool relocate(native *n, TCCState *s, complaint *c)
{
    int size = tcc_relocate(s, NULL);
    if (size <= 0) {
        return false;
    }
    n->size = whole_pages((size_t)size);
    n->memory = mmap(NULL, n->size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (n->memory == MAP_FAILED) {
        n->memory = NULL;
        complain(c, "no memory for %zu bytes of code", n->size);
        return false;
    }
    if (tcc_relocate(s, n->memory) != 0) {
        return false;
    }
    if (mprotect(n->memory, n->size, PROT_READ | PROT_EXEC) != 0) {
        complain(c, "the system does not let code be made in memory");
        return false;
    }
    return true;
}
#else
static bool relocate(native *n, TCCState *s, complaint *c)
{
    (void)n;
    (void)c;
    return tcc_relocate(s) == 0;
}
#endif

static bool place(void *context, TCCState *s, complaint *c)
{
    const placing *k = context;
    native *n = k->n;
    if (!add_symbols(k->p, s, c) || !relocate(n, s, c)) {
        return false;
    }
    n->module = tcc_get_symbol(s, PCG_MODULE_SYMBOL);
    void *condition = tcc_get_symbol(s, EMIT_CONDITION_SYMBOL);
    memcpy(&n->condition, &condition, sizeof condition);
    if (!n->module) {
        complain(c, "the code holds no module");
        return false;
    }
    return true;
}

/* ---- native code ----------------------------------------------------------------------------- */

native *native_new(const program *p, const char *c_text, char **error)
{
    complaint c = {0};
    native *n = calloc(1, sizeof *n);
    placing k = {p, n};
    bool own_mapping = PCG_TCC_RELOCATE_ARGS == 2;
    if (!n) {
        complain(&c, "out of memory");
    } else if (tcc_compile(c_text, "PCG_SHARED", TCC_OUTPUT_MEMORY, &c, place, &k,
                           own_mapping ? NULL : &n->state)) {
        free(c.text);
        return n;
    }
    native_free(n);
    complain_to(&c, error);
    return NULL;
}

const pcg_module *native_module(const native *n)
{
    return n->module;
}

condition_function *native_condition(const native *n)
{
    return n->condition;
}

void native_free(native *n)
{
    if (n && n->memory) {
        munmap(n->memory, n->size);
    }
    if (n && n->state) {
        tcc_discard(n->state);
    }
    free(n);
}

/* program_link.c - the kernels that a module takes from libraries that are not built in. */
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "run.h"

pcg_code *pcg_kernel(const pcg_frame *f, pcg_u32 number)
{
    return f->loaded->program->kernels[number];
}

/* ---- libraries ------------------------------------------------------------------------------ */

static open_library *linked_library(const pcg_program *p, const char *name)
{
    for (uint32_t i = 0; i < p->library_count; i++)
        if (!strcmp(p->libraries[i]->library->name, name))
            return p->libraries[i];
    return NULL;
}

/* One that the caller has open, or that is found. NULL: it was said why. */
static open_library *hold_library(const char *name, open_library *const *known, size_t count,
                                  library_search *s)
{
    char path[LIBRARY_PATH_BYTES], why[sizeof s->why];
    for (size_t i = 0; i < count; i++)
        if (!strcmp(known[i]->library->name, name))
            return library_hold(known[i]);
    if (!library_locate(s, name, path)) {
        memcpy(why, s->why, sizeof why);
        snprintf(s->why, sizeof s->why, "it needs library '%s': %.4000s", name, why);
        return NULL;
    }
    open_library *l = library_open(s, name, path);
    if (!l) {
        memcpy(why, s->why, sizeof why);
        snprintf(s->why, sizeof s->why,
                 "it needs library '%s', and '%.3000s' cannot be used: %.3000s", name, path, why);
    }
    return l;
}

/* ---- linking -------------------------------------------------------------------------------- */

static bool link_kernel(pcg_program *p, uint32_t number, open_library *const *known, size_t count,
                        library_search *s)
{
    const pcg_kernel_info *k = &p->module->kernels[number];
    open_library *l = linked_library(p, k->library);
    if (!l) {
        l = hold_library(k->library, known, count, s);
        if (!l)
            return false;
        p->libraries[p->library_count++] = l;
    }
    const library_symbol *found = library_find_symbol(l->library, k->symbol);
    if (!found || found->layout != k->layout) {
        snprintf(s->why, sizeof s->why,
                 "it was compiled with another version of library '%s' than '%.4000s', which %s "
                 "'%s': compile it again",
                 k->library, l->path, found ? "has another" : "lacks", k->symbol);
        return false;
    }
    p->kernels[number] = found->address;
    return true;
}

bool program_link(pcg_program *p, open_library *const *known, size_t count, library_search *s)
{
    uint32_t kernels = p->module->kernel_count;
    s->why[0] = '\0';
    if (!kernels || p->kernels)
        return true;
    p->kernels = calloc(kernels, sizeof *p->kernels);
    p->libraries = calloc(kernels, sizeof *p->libraries); /* never more than kernels */
    if (!p->kernels || !p->libraries) {
        snprintf(s->why, sizeof s->why, "out of memory");
        return false;
    }
    for (uint32_t i = 0; i < kernels; i++)
        if (!link_kernel(p, i, known, count, s))
            return false;
    return true;
}

/* library_open.c - libraries that are not built in: found on a search path, opened, checked. */
#define _GNU_SOURCE /* dladdr */
#include "library_open.h"

#include <dlfcn.h>
#include <elf.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/base.h"

/* Appends to `why` as far as there is room. */
static void say(library_search *s, const char *format, ...) PRINTF_LIKE(2, 3);

static void say(library_search *s, const char *format, ...)
{
    size_t length = strlen(s->why);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(s->why + length, sizeof s->why - length, format, arguments);
    va_end(arguments);
}

/* ---- finding --------------------------------------------------------------------------------- */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool library_is_name(const char *name)
{
    if (!is_letter(*name))
        return false;
    for (; *name; name++)
        if (!is_letter(*name) && !(*name >= '0' && *name <= '9') && *name != '_')
            return false;
    return true;
}

typedef struct lookup {
    library_search *search;
    const char *name;
    char *path;
    unsigned places;
} lookup;

/* Looks in the first `length` bytes of `folder`. */
static bool look_in(lookup *l, const char *folder, size_t length, const char *below)
{
    struct stat about;
    if (!length)
        folder = ".", length = 1;
    int size = snprintf(l->path, LIBRARY_PATH_BYTES, "%.*s%s/%s.so", (int)length, folder, below,
                        l->name);
    if (size < 0 || size >= LIBRARY_PATH_BYTES)
        return false;
    if (!stat(l->path, &about) && S_ISREG(about.st_mode))
        return true;
    say(l->search, "%s%.*s%s", l->places++ ? ", " : "there is none in ", (int)length, folder,
        below);
    return false;
}

static bool look_in_list(lookup *l, const char *list)
{
    for (size_t length; list && *list; list += length + (list[length] == ':')) {
        length = strcspn(list, ":");
        if (length && look_in(l, list, length, ""))
            return true;
    }
    return false;
}

/* Beside or near the file that this code was loaded from: lib/libpcgrt.so, bin/pcgc. */
static bool look_installed(lookup *l)
{
    Dl_info about;
    const char *own = dladdr((void *)(uintptr_t)&library_locate, &about) ? about.dli_fname : NULL;
    const char *slash = own ? strrchr(own, '/') : NULL;
    if (slash && look_in(l, own, (size_t)(slash - own), "/../lib/pcg"))
        return true;
    static const char installed[] = PCG_LIBRARIES; /* which the build tells */
    return look_in(l, installed, strlen(installed), "");
}

bool library_locate(library_search *s, const char *name, char path[LIBRARY_PATH_BYTES])
{
    lookup l = {s, name, path, 0};
    s->why[0] = '\0';
    if (!library_is_name(name)) {
        say(s, "a library's name has letters, digits and underscores");
        return false;
    }
    if (s->folder && look_in(&l, s->folder, strlen(s->folder), ""))
        return true;
    for (const char *const *p = s->paths; p && *p; p++)
        if (look_in(&l, *p, strlen(*p), ""))
            return true;
    return look_in_list(&l, getenv("PCG_LIBRARY_PATH")) || look_installed(&l);
}

/* ---- what the system's loader would not survive ---------------------------------------------- */

/* Whether a segment lies within the file: what it is loaded from would be missing else, and
 * touching it ends the process. */
static bool holds_segments(FILE *f, const Elf64_Ehdr *head, uint64_t size)
{
    for (unsigned i = 0; i < head->e_phnum; i++) {
        Elf64_Phdr segment;
        if (head->e_phoff > size ||
            fseek(f, (long)(head->e_phoff + i * sizeof segment), SEEK_SET) ||
            fread(&segment, sizeof segment, 1, f) != 1)
            return false;
        if (segment.p_type == PT_LOAD &&
            (segment.p_offset > size || segment.p_filesz > size - segment.p_offset))
            return false;
    }
    return head->e_phnum > 0;
}

static const char *unsound(FILE *f, uint64_t size)
{
    Elf64_Ehdr head;
    if (fread(&head, sizeof head, 1, f) != 1 || memcmp(head.e_ident, ELFMAG, SELFMAG) ||
        head.e_ident[EI_CLASS] != ELFCLASS64 || head.e_phentsize != sizeof(Elf64_Phdr))
        return "it is no shared object";
    return holds_segments(f, &head, size) ? NULL : "it is cut short";
}

const char *library_unsound(const char *path)
{
    struct stat about;
    FILE *f = fopen(path, "rb");
    const char *why = f ? NULL : strerror(errno);
    if (f && fstat(fileno(f), &about))
        why = strerror(errno);
    else if (f)
        why = unsound(f, (uint64_t)about.st_size);
    if (f)
        fclose(f);
    return why;
}

/* ---- checking -------------------------------------------------------------------------------- */

static bool derives(const pcg_type *t, const pcg_type *from)
{
    while (t && t != from)
        t = t->parent;
    return t != NULL;
}

/* What the runtime calls to copy and drop must not be left out where the parent has it: the
 * parent's own is not called besides. */
static bool is_sound_type(library_search *s, const library_entity *e)
{
    const pcg_type *t = e->type;
    if (!t->name || strcmp(t->name, e->name) || !t->parent || strcmp(t->parent->name, e->parent))
        say(s, "entity type '%s': its pcg_type is not called so, or does not derive from '%s'",
            e->name, e->parent);
    else if (t->size < t->parent->size)
        say(s, "entity type '%s' is smaller than '%s', from which it derives", e->name, e->parent);
    else if ((t->parent->copy && !t->copy) || (t->parent->drop && !t->drop))
        say(s, "entity type '%s' lacks a copy or drop that '%s', from which it derives, has",
            e->name, e->parent);
    else if (derives(t, &pcg_type_spatial) && !derives(t, &pcg_type_shape))
        say(s, "entity type '%s' derives from '%s': of what has a place only 'Shape' can be "
               "derived from",
            e->name, e->parent);
    else
        return true;
    return false;
}

static bool is_sound(library_search *s, const pcg_library *l, const char *name)
{
    if (!l) {
        say(s, "it is no library that pcgc made");
        return false;
    }
    if (l->abi != PCG_ABI || l->size != sizeof *l) {
        say(s, "it was made for interface %u of the runtime, this one has interface %d: make it "
               "again", l->abi, PCG_ABI);
        return false;
    }
    if (strcmp(l->name, name)) {
        say(s, "the library in it is called '%s'", l->name);
        return false;
    }
    for (uint32_t i = 0; i < l->type_count; i++)
        if (!is_sound_type(s, &l->types[i]))
            return false;
    return true;
}

/* ---- opening --------------------------------------------------------------------------------- */

/* This process exports pcg_round and its like, for a library to find. */
static bool runtime_is_visible(void)
{
    void *process = dlopen(NULL, RTLD_NOW);
    bool visible = process && dlsym(process, "pcg_round");
    if (process)
        dlclose(process);
    return visible;
}

bool library_show_runtime(void)
{
    Dl_info about;
    if (!runtime_is_visible() && dladdr((void *)(uintptr_t)&library_show_runtime, &about) &&
        about.dli_fname)
        dlopen(about.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
    return runtime_is_visible();
}

/* "zoning.so: undefined symbol: pcg_emt" */
static void say_unloadable(library_search *s, bool visible)
{
    static const char undefined[] = "undefined symbol: ";
    const char *error = dlerror(), *found = error ? strstr(error, undefined) : NULL;
    if (!found)
        say(s, "%s", error ? error : "the system does not say why");
    else if (!visible)
        say(s, "it finds no runtime: link this program with libpcgrt.so, or with libpcgrt.a and "
               "-rdynamic");
    else
        say(s, "it needs '%.*s', which neither it nor this runtime has",
            (int)strcspn(found + sizeof undefined - 1, " ,\n"), found + sizeof undefined - 1);
}

static void *open_file(library_search *s, const char *path)
{
    bool visible = library_show_runtime();
    const char *why = library_unsound(path);
    if (why) {
        say(s, "%s", why);
        return NULL;
    }
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!handle)
        say_unloadable(s, visible);
    return handle;
}

open_library *library_open(library_search *s, const char *name, const char *path)
{
    size_t length = strlen(path);
    open_library *l = malloc(sizeof *l + length + 1);
    s->why[0] = '\0';
    if (!l) {
        say(s, "out of memory");
        return NULL;
    }
    memcpy(l->path, path, length + 1);
    atomic_init(&l->references, 1);
    l->handle = open_file(s, path);
    l->library = l->handle ? dlsym(l->handle, PCG_LIBRARY_SYMBOL) : NULL;
    if (l->handle && is_sound(s, l->library, name))
        return l;
    library_close(l);
    return NULL;
}

open_library *library_hold(open_library *l)
{
    atomic_fetch_add(&l->references, 1);
    return l;
}

void library_close(open_library *l)
{
    if (!l || atomic_fetch_sub(&l->references, 1) > 1)
        return;
    if (l->handle)
        dlclose(l->handle);
    free(l);
}

bool library_is_file(const open_library *l, const char *path)
{
    struct stat a, b;
    return !stat(l->path, &a) && !stat(path, &b) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

const library_symbol *library_find_symbol(const pcg_library *l, const char *symbol)
{
    uint32_t low = 0, high = l->symbol_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        int order = strcmp(l->symbols[middle].name, symbol);
        if (!order)
            return &l->symbols[middle];
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

/* load.c - programs from shared objects that pcgc made. */
#include <dlfcn.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "program.h"

/* What the caller of pcg_program_load is told. */
typedef struct loading {
    const char *path;
    const pcg_compile_options *options;
    arena arena;
} loading;

static void say(loading *l, const char *format, ...) PRINTF_LIKE(2, 3);

static void say(loading *l, const char *format, ...)
{
    va_list arguments;
    if (!l->options || !l->options->message)
        return;
    va_start(arguments, format);
    const char *line = arena_format_list(&l->arena, format, arguments);
    va_end(arguments);
    const char *rendered = line ? arena_format(&l->arena, "error: %s\n", line) : NULL;
    const pcg_message m = {.severity = PCG_ERROR,
                           .code = "",
                           .text = line ? line : "out of memory",
                           .rendered = rendered ? rendered : "error: out of memory\n"};
    l->options->message(l->options->user, &m);
}

/* ---- missing symbols ------------------------------------------------------------------------ */

/* "geometry.split" for pcg_geometry_split; NULL where the symbol is none of a library. */
static const char *procedure_name(loading *l, const char *symbol)
{
    if (strncmp(symbol, "pcg_", 4))
        return NULL;
    char *name = arena_copy(&l->arena, symbol + 4, strlen(symbol + 4));
    char *between = name ? strchr(name, '_') : NULL;
    if (!between || !between[1])
        return NULL;
    *between = '.';
    return name;
}

/* "house.so: undefined symbol: pcg_geometry_split" */
static void say_unloadable(loading *l, const char *why)
{
    static const char undefined[] = "undefined symbol: ";
    const char *found = strstr(why, undefined);
    if (!found) {
        say(l, "cannot load '%s': %s", l->path, why);
        return;
    }
    found += sizeof undefined - 1;
    char *symbol = arena_copy(&l->arena, found, strcspn(found, " ,\n"));
    const char *name = symbol ? procedure_name(l, symbol) : NULL;
    const char *function = name ? strstr(name, ".fn_") : NULL;
    if (function) /* a function's symbol names the types of its parameters, too */
        name = arena_format(&l->arena, "%.*s.%s", (int)(function - name), name, function + 4);
    if (!library_show_runtime())
        say(l,
            "'%s' finds no runtime: link this program with libpcgrt.so, or with libpcgrt.a and "
            "-rdynamic",
            l->path);
    else
        say(l, "'%s' needs %s '%s', which this runtime does not have", l->path,
            function ? "function" : "procedure", name ? name : found);
}

/* ---- loading -------------------------------------------------------------------------------- */

static void *open_graph(loading *l)
{
    const char *path = strchr(l->path, '/') ? l->path : arena_format(&l->arena, "./%s", l->path);
    if (!path) {
        say(l, "out of memory");
        return NULL;
    }
    library_show_runtime();
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char *why = dlerror();
        say_unloadable(l, why ? why : "the system does not say why");
    }
    return library;
}

static bool is_readable_file(loading *l)
{
    struct stat about;
    if (stat(l->path, &about)) {
        say(l, "cannot read '%s': %s", l->path, strerror(errno));
        return false;
    }
    if (!S_ISREG(about.st_mode))
        say(l, "cannot read '%s': it is no file", l->path);
    return S_ISREG(about.st_mode);
}

static bool fits(loading *l, const pcg_module *m)
{
    if (!m)
        say(l, "'%s' is no graph that pcgc made", l->path);
    else if (m->abi != PCG_ABI || m->size != sizeof *m)
        say(l,
            "'%s' was made for interface %u of the runtime, this one has interface %d: compile it "
            "again",
            l->path, m->abi, PCG_ABI);
    return m && m->abi == PCG_ABI && m->size == sizeof *m;
}

static void close_library(void *library)
{
    dlclose(library);
}

static const char *const *library_paths(const pcg_compile_options *o)
{
    size_t needed = offsetof(pcg_compile_options, library_paths) + sizeof o->library_paths;
    return o && o->size >= needed ? o->library_paths : NULL;
}

/* What the program needs is looked for beside it, too: in the first `length` bytes of its path.
 * NULL, and the program is gone, where it is not all there. */
static pcg_program *link_libraries(loading *l, pcg_program *p, ptrdiff_t length)
{
    library_search s = {.folder = arena_copy(&l->arena, l->path, (size_t)length),
                        .paths = library_paths(l->options)};
    if (program_link(p, NULL, 0, &s))
        return p;
    say(l, "cannot load '%s': %s", *l->path ? l->path : pcg_program_name(p), s.why);
    pcg_program_free(p);
    return NULL;
}

static pcg_program *load(loading *l)
{
    void *library = is_readable_file(l) ? open_graph(l) : NULL;
    if (!library)
        return NULL;
    const pcg_module *module = dlsym(library, PCG_MODULE_SYMBOL);
    bool good = fits(l, module);
    pcg_program *p = good ? program_new(module, close_library, library) : NULL;
    if (p && !program_set_file(p, l->path)) {
        pcg_program_free(p);
        say(l, "out of memory");
        return NULL;
    }
    if (good && !p)
        say(l, "out of memory");
    if (!p)
        dlclose(library);
    const char *slash = strrchr(l->path, '/');
    return p ? link_libraries(l, p, slash ? slash - l->path + 1 : 0) : NULL;
}

pcg_program *pcg_program_load(const char *path, const pcg_compile_options *options)
{
    loading l = {.path = path ? path : "", .options = options};
    pcg_program *p = load(&l);
    arena_free(&l.arena);
    return p;
}

pcg_program *pcg_program_link(const struct pcg_module *module, const pcg_compile_options *options)
{
    loading l = {.path = "", .options = options};
    pcg_program *p = program_new(module, NULL, NULL);
    if (p)
        p = link_libraries(&l, p, 0);
    else
        say(&l, "the graph was made for another runtime than this (interface %d)", PCG_ABI);
    arena_free(&l.arena);
    return p;
}

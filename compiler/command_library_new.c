/* command_library_new.c - pcgc library --new: a small library to begin with. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "command_library.h"

static const char about[] = "//! What this library is for, in one line.\n";

static const char kernel[] =
    "/*pcg\n"
    "/// Moves shapes upwards.\n"
    "///\n"
    "/// What more there is to say of it: edge cases, what becomes of a bad entity.\n"
    "procedure lift(in: Shape) -> (out: Shape) [pure, one_to_one] {\n"
    "    category \"place\"\n"
    "    synonyms \"raise\", \"up\"\n"
    "    param height: length = 1m   /// How far; below 0 downwards.\n"
    "    example rectangle(width = 2m, height = 3m)\n"
    "        -> lift(height = 4m) expect faces = 1, area = 6\n"
    "}\n"
    "*/\n"
    "#include \"lift.h\"     /* made from the block above */\n"
    "#include <pcg/shape.h> /* the runtime's shapes */\n"
    "\n"
    "int pcg_%s_lift(pcg_call *call, struct pcg_%s_lift *node)\n"
    "{\n"
    "    node->in->scope.origin.z += node->height;\n"
    "    return pcg_emit(call, node->out, (pcg_entity *)node->in);\n"
    "}\n";

/* Nothing that is there is overwritten. */
static bool write_new(arena *a, const char *folder, const char *name, const char *content)
{
    struct stat there;
    const char *path = arena_format(a, "%s/%s", folder, name);
    if (!path || !content) {
        tool_error(EXIT_LIMIT, "out of memory");
        return false;
    }
    if (!stat(path, &there)) {
        tool_error(EXIT_USAGE, "'%s' is there already", path);
        return false;
    }
    return tool_write(NULL, path, content, strlen(content));
}

int library_skeleton(const char *folder, const char *name)
{
    arena a = {0};
    if (mkdir(folder, 0777) && errno != EEXIST)
        return tool_error(EXIT_USAGE, "cannot make '%s': %s", folder, strerror(errno));
    bool done = write_new(&a, folder, "library.pcg", about) &&
                write_new(&a, folder, "lift.c", arena_format(&a, kernel, name, name));
    arena_free(&a);
    if (done)
        fprintf(stderr,
                "%s: run its examples with pcgc library %s --test, build it with pcgc library %s\n",
                folder, folder, folder);
    return done ? EXIT_DONE : EXIT_USAGE;
}

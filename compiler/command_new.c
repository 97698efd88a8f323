/* command_new.c - pcgc new: a folder with a graph to begin from. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "tool.h"

/* The graph; behind each @ stands its name. */
static const char graph_text[] =
    "//! A town square: houses around it, none like the others.\n"
    "//! Change something, run it again, and look.\n"
    "\n"
    "graph @ {\n"
    "    param side:   int    = 5 range [2, 40]          /// Houses along a side of the square.\n"
    "    param storey: length = 3m range [2m, 6m]        /// Height of a storey.\n"
    "    param lot:    length = 13m range [10m, 50m]     /// From house to house.\n"
    "    const plaster = #e3d2ae\n"
    "    const brick   = #a5583f\n"
    "    const slate   = #4b5563\n"
    "    const glass   = #8fb4cc\n"
    "\n"
    "    attr number: int                                /// Of the lot, row by row.\n"
    "\n"
    "    // The lots at the rim of the square: the others stay empty.\n"
    "    impulse(count = side * side, index => @number)\n"
    "        -> rim: condition(min(@number % side, @number / side) == 0 ||\n"
    "                          max(@number % side, @number / side) == side - 1)\n"
    "    block rim.no\n"
    "\n"
    "    // A house: walls of a height by chance, and a roof.\n"
    "    rim.yes\n"
    "        -> rectangle(width = rand(8m, 10m), height = rand(8m, 10m))\n"
    "        -> translate(x = (@number % side) * lot, y = (@number / side) * lot)\n"
    "        -> extrude(amount = storey * round(rand(1.6, 5.4)))\n"
    "        -> mass: select { top; bottom; sides: all }\n"
    "    block mass.bottom\n"
    "    mass.top\n"
    "        -> roof: shed_roof(height = 2m, overhang = 0.5m)\n"
    "    roof.slope\n"
    "        -> special_extrude(amount = 0.2m, cap = true)\n"
    "        -> color(color = slate)\n"
    "\n"
    "    // Walls become storeys, storeys become tiles, and in each tile stands a window.\n"
    "    mass.sides\n"
    "        -> decompose()\n"
    "        -> split(axis = y, repeat = true) { absolute(storey) }\n"
    "        -> split(axis = x, repeat = true) { absolute(2.5m) }\n"
    "        -> tile: offset(amount = -0.6m)\n"
    "    tile.inside\n"
    "        -> extrude(amount = -0.2m)\n"
    "        -> window: select { top; frame: all }\n"
    "    window.top\n"
    "        -> color(color = glass)\n"
    "\n"
    "    // Every other house is of brick.\n"
    "    tile.border  -> wall: condition(@number % 2 == 0)\n"
    "    window.frame -> wall\n"
    "    roof.wall    -> wall\n"
    "    wall.yes     -> color(color = plaster)\n"
    "    wall.no      -> color(color = brick)\n"
    "}\n";

/* What a name in the text may be without quotes. */
static bool is_plain(const char *name)
{
    static const char *const reserved[] = {"true", "false", "if"};
    for (size_t i = 0; i < COUNT_OF(reserved); i++)
        if (!strcmp(name, reserved[i]))
            return false;
    for (const char *s = name; *s; s++)
        if (!(*s >= 'a' && *s <= 'z') && !(*s >= 'A' && *s <= 'Z') && *s != '_' &&
            !(s > name && *s >= '0' && *s <= '9'))
            return false;
    return true;
}

/* The last name of a path; NULL where it can be none of a graph. */
static const char *project_name(arena *a, const char *path)
{
    size_t length = strlen(path);
    while (length && path[length - 1] == '/')
        length--;
    size_t from = length;
    while (from && path[from - 1] != '/')
        from--;
    const char *name = arena_copy(a, path + from, length - from);
    bool good = *name && strcmp(name, ".") && strcmp(name, "..");
    for (const char *s = name; *s; s++)
        good = good && *s != '\'' && (unsigned char)*s >= ' ' && *s != 0x7F;
    return good ? name : NULL;
}

static int write_graph(arena *a, const char *folder, const char *name)
{
    text out = {.arena = a};
    for (const char *s = graph_text; *s; s++) {
        if (*s == '@' && s[1] == ' ' && s[2] == '{')
            text_format(&out, is_plain(name) ? "%s" : "'%s'", name);
        else
            text_add_bytes(&out, s, 1);
    }
    const char *file = arena_format(a, "%s/%s.pcg", folder, name);
    return tool_write(NULL, file, out.at, out.length) ? EXIT_DONE : EXIT_USAGE;
}

static int make_project(arena *a, const char *folder)
{
    const char *name = project_name(a, folder);
    if (!name)
        return tool_error(EXIT_USAGE, "'%s' cannot be the name of a graph", folder);
    if (mkdir(folder, 0777) != 0)
        return tool_error(EXIT_USAGE, "cannot make the folder '%s': %s", folder,
                          errno == EEXIST ? "there is one of that name" : strerror(errno));
    int code = write_graph(a, folder, name);
    if (code == EXIT_DONE)
        fprintf(stderr, "made %s/%s.pcg\nnow try:\n  cd %s\n  pcgc run\n", folder, name, folder);
    return code;
}

static int run_new(const command *self, int argc, char **argv)
{
    arena a = {0};
    jmp_buf out_of_memory;
    option_texts files = {0};
    const option options[] = {{0}};
    int code;
    if (setjmp(out_of_memory)) {
        code = tool_error(EXIT_LIMIT, "out of memory");
    } else {
        a.on_failure = &out_of_memory;
        code = options_read(&a, self, options, argc, argv, &files);
        if (code < 0 && files.count != 1)
            code = usage_error(self, files.count ? "one project at a time" : "called what?");
        if (code < 0)
            code = make_project(&a, files.at[0]);
    }
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc new hello && cd hello && pcgc run", NULL};
const command command_new = {"new", "NAME", "Makes a folder with a graph in it to begin from.",
                             examples, run_new};

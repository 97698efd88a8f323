/* command_check.c - pcgc check: errors and warnings of files and whole folders; nothing runs. */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tool.h"

/* Folders nested deeper than this are a loop of links. */
enum { CHECK_MAX_DEPTH = 64 };

typedef struct checking {
    const tool *options;
    uint32_t files, errors, warnings;
    int code;
} checking;

static int worse(int a, int b)
{
    return a > b ? a : b;
}

static int compile_only(void *context, const char *path)
{
    int code;
    tool_compile(context, path, &code);
    return code;
}

static void check_file(checking *k, const char *path)
{
    tool t = *k->options;
    int code = tool_begin(&t, &command_check);
    k->files++;
    if (code < 0) {
        code = tool_guarded(&t, path, compile_only, &t);
        k->errors += t.compilation.diagnostics.errors;
        k->warnings += t.compilation.diagnostics.warnings;
        code = tool_end(&t, code);
    }
    k->code = worse(k->code, code);
}

static void check_path(checking *k, const char *path, unsigned depth);

static int visible(const struct dirent *e)
{
    return e->d_name[0] != '.';
}

/* All .pcg files of a folder and of those in it, by name. */
static void check_folder(checking *k, const char *path, unsigned depth)
{
    struct dirent **entries;
    int count = depth < CHECK_MAX_DEPTH ? scandir(path, &entries, visible, alphasort) : -1;
    if (count < 0) {
        k->code =
            worse(k->code, tool_error(EXIT_USAGE, "cannot read the folder '%s': %s", path,
                                      depth < CHECK_MAX_DEPTH ? strerror(errno) : "too deep"));
        return;
    }
    for (int i = 0; i < count; i++) {
        arena a = {0};
        const char *child = arena_format(&a, "%s/%s", path, entries[i]->d_name);
        struct stat info;
        bool folder = child && !stat(child, &info) && S_ISDIR(info.st_mode);
        if (folder || (child && !strcmp(path_extension(child), "pcg")))
            check_path(k, child, depth + 1);
        arena_free(&a);
        free(entries[i]);
    }
    free(entries);
}

static void check_path(checking *k, const char *path, unsigned depth)
{
    struct stat info;
    if (!stat(path, &info) && S_ISDIR(info.st_mode))
        check_folder(k, path, depth);
    else
        check_file(k, path);
}

static int run_check(const command *self, int argc, char **argv)
{
    arena a = {0};
    tool t = {0};
    bool quiet = false;
    option_texts files = {0};
    const option options[] = {
        {'q', "quiet", OPTION_FLAG, &quiet, NULL, "no summary"}, TOOL_OPTIONS(&t), {0}};
    int code = options_read(&a, self, options, argc, argv, &files);
    if (code < 0 && files.count == 0)
        code = usage_error(self, "which file or folder?");
    if (code < 0) {
        checking k = {.options = &t};
        for (size_t i = 0; i < files.count; i++)
            check_path(&k, files.at[i], 0);
        if (!quiet)
            fprintf(stderr, "%u %s checked: %u %s, %u %s\n", k.files,
                    k.files == 1 ? "file" : "files", k.errors, k.errors == 1 ? "error" : "errors",
                    k.warnings, k.warnings == 1 ? "warning" : "warnings");
        code = k.code;
    }
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc check house.pcg", "pcgc check .", NULL};
const command command_check = {"check", "FILE|FOLDER…", "Prints errors and warnings; nothing runs.",
                               examples, run_check};

/* main.c - pcgc: which subcommand is meant. */
#include <stdio.h>
#include <string.h>

#include "tool.h"

/* NULL behind the last. */
static const command *const commands[] = {&command_new,   &command_run,  &command_watch,
                                          &command_check, &command_info, &command_doc,
                                          &command_trace, &command_profile, &command_debug,
                                          &command_bench, &command_library, &command_completion, NULL};
enum { COMMANDS = COUNT_OF(commands) - 1 };

static void print_introduction(FILE *out)
{
    fputs(
        "pcgc compiles procedural content graphs: programs that generate cities.\n"
        "\n"
        "  pcgc new hello && cd hello && pcgc run    a graph to begin from, and what it makes\n"
        "  pcgc run house.pcg -o house.glb           run a graph, write a model\n"
        "  pcgc run house.pcg -p height=12m -o a.png the same, higher, as a picture\n"
        "  pcgc house.pcg -o house.so                compile ahead of time (.so, .c, executable)\n"
        "  pcgc doc split                            what a procedure does\n"
        "\n"
        "Commands: new, run, watch, check, info, doc, trace, profile, debug, bench, library.\n"
        "Without one, pcgc compiles.\n"
        "pcgc COMMAND --help explains a command, pcgc --help compiling, pcgc --version the "
        "version.\n",
        out);
}

static const command *find_command(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++)
        if (!strcmp(commands[i]->name, name))
            return commands[i];
    return NULL;
}

/* A word that is no file name may be a subcommand with a slip in it. */
static int unknown_command(const char *word)
{
    const char *names[COMMANDS];
    for (size_t i = 0; i < COMMANDS; i++)
        names[i] = commands[i]->name;
    const char *near = nearest_name(word, names, COMMANDS);
    if (near)
        return tool_error(EXIT_USAGE, "unknown command '%s', did you mean '%s'?", word, near);
    return tool_error(EXIT_USAGE, "unknown command '%s'; the commands are new, run, watch, check, "
                      "info, doc, trace, profile, debug, bench, library",
                      word);
}

static bool looks_like_command(const char *word)
{
    return word[0] != '-' && !strpbrk(word, "./");
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        print_introduction(stdout);
        return EXIT_DONE;
    }
    const char *word = argv[1];
    if (!strcmp(word, "--version")) {
        printf("pcgc %s\n", PCG_VERSION);
        return EXIT_DONE;
    }
    if (!strcmp(word, "help") && argc == 2) {
        print_introduction(stdout);
        return EXIT_DONE;
    }
    if (!strcmp(word, "help")) {
        char *help[] = {(char[]){"--help"}, NULL};
        const command *c = find_command(argv[2]);
        return c ? c->run(c, 1, help) : unknown_command(argv[2]);
    }
    if (!strcmp(word, TOOL_COMPLETE)) {
        complete_word(commands, argc - 1, argv + 1);
        return EXIT_DONE;
    }
    if (!strcmp(word, TOOL_MANUAL)) {
        manual_page(commands);
        return EXIT_DONE;
    }
    const command *c = find_command(word);
    if (c)
        return c->run(c, argc - 2, argv + 2);
    if (looks_like_command(word))
        return unknown_command(word);
    return command_compile.run(&command_compile, argc - 1, argv + 1);
}

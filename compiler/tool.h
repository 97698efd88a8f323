/* tool.h - what the subcommands of pcgc share: exit codes, options, messages, compiling a file. */
#ifndef PCG_TOOL_H
#define PCG_TOOL_H

#include "../runtime/pcg.h"
#include "../runtime/progress.h"
#include "compiler.h"

enum {
    EXIT_DONE = 0,
    EXIT_NO = 1,    /* errors in the source, differences, tests failed */
    EXIT_USAGE = 2, /* wrong usage, or a file that cannot be read or written */
    EXIT_RUN_FAILED = 3,
    EXIT_LIMIT = 4,
    EXIT_BUG = 70, /* ours */
    EXIT_INTERRUPTED = 130
};

/* ---- options --------------------------------------------------------------------------------- */

typedef enum option_kind {
    OPTION_FLAG,    /* bool *to */
    OPTION_TEXT,    /* const char **to; the last one counts */
    OPTION_TEXTS,   /* option_texts *to; each one counts */
    OPTION_DEFAULT, /* const char **to: --name or --name=text; without text it becomes `argument` */
    OPTION_COUNT,   /* uint64_t *to */
    OPTION_BYTES,   /* size_t *to: 512M, 2G */
    OPTION_SECONDS  /* double *to: 30, 30s, 2min, 500ms */
} option_kind;

typedef struct option_texts {
    const char **at;
    size_t count;
} option_texts;

typedef struct option {
    char letter;      /* 0: none */
    const char *name; /* without the dashes */
    option_kind kind;
    void *to;
    const char *argument; /* how its value is called in the help */
    const char *help;
} option;

typedef struct command {
    const char *name;      /* NULL: compile */
    const char *arguments; /* "FILE" */
    const char *summary;
    const char *const *examples; /* NULL-terminated lines for the help */
    int (*run)(const struct command *self, int argc, char **argv); /* argv without the subcommand */
} command;

/* Reads options into their places; what is none goes to `files` (memory from `a`). Returns -1 to
 * go on, or the exit code where the command is over: --help was printed, or a wrong usage was
 * told. `options` ends with a row without a name. */
int options_read(arena *a, const command *c, const option *options, int argc, char **argv,
                 option_texts *files);
/* Prints "pcgc run: text" and how to get help to stderr; returns EXIT_USAGE. */
int usage_error(const command *c, const char *format, ...) PRINTF_LIKE(2, 3);
/* Prints "pcgc: text" to stderr; returns `code`. */
int tool_error(int code, const char *format, ...) PRINTF_LIKE(2, 3);

/* ---- the tables of options, told to others ---------------------------------------------------- */

/* As the first word of a command's line: options_read does not read, but hands its table to
 * complete_command with the rest of the line, or to manual_command. */
#define TOOL_COMPLETE "--complete"
#define TOOL_MANUAL "--manual"

/* Prints what may stand for the last of the words of a command's line (completion.c). */
void complete_command(const command *c, const option *options, int count, char **words);
/* The same for a whole command line; argv[0] is TOOL_COMPLETE. `commands` ends with NULL. */
void complete_word(const command *const *commands, int argc, char **argv);
/* Prints a command's part of the manual page (manual.c), and the whole page. */
void manual_command(const command *c, const option *options);
void manual_page(const command *const *commands);

/* ---- compiling ------------------------------------------------------------------------------- */

/* What every command that reads a graph takes, and what it makes of it. */
typedef struct tool {
    compilation compilation;
    jmp_buf out_of_memory;
    const char *graph, *message_format;
    option_texts imports, libraries;
    bool json_messages, timings, quiet;
    bool observed; /* what is emitted tells of its rounds */
    LIST(pcg_timing) times; /* a name once: a pass that comes again adds to it */
    LIST(double) processor; /* seconds of processor time of the same passes, by all threads */
    double started, processor_started;
    struct { uint32_t count, errors, warnings; } printed; /* of the diagnostics */
    interrupt guard;
    progress progress;
} tool;

/* The rows that such commands have in common; the caller copies them behind its own. */
#define TOOL_OPTIONS(t)                                                                            \
    {'g', "graph", OPTION_TEXT, &(t)->graph, "NAME", "the graph of the file that is meant"},       \
        {'I', "import-path", OPTION_TEXTS, &(t)->imports, "FOLDER", "look imports up there, too"}, \
        {'L', "library-path", OPTION_TEXTS, &(t)->libraries, "FOLDER",                             \
         "look for libraries there, too"},                                                         \
    {                                                                                              \
        0, "message-format", OPTION_TEXT, &(t)->message_format, "text|json",                       \
            "how messages are printed: for people, or one JSON object a line"                      \
    }

/* The texts, ended by a NULL, as a compilation takes paths. */
const char *const *tool_paths(arena *a, const option_texts *texts);
/* Checks the common options, and has Ctrl+C and the progress attended to until tool_end: the tool stays
 * where it is. -1 to go on, or an exit code. */
int tool_begin(tool *t, const command *c);
/* Returns the exit code: `code`, or EXIT_INTERRUPTED. */
int tool_end(tool *t, int code);
/* Calls `body`; where memory runs out in it, what was found so far is printed and the result is
 * EXIT_LIMIT. */
int tool_guarded(tool *t, const char *path, int (*body)(void *context, const char *path),
                 void *context);
/* Within tool_guarded: reads and compiles a file up to order, and prints its diagnostics. NULL:
 * `*code` is the exit code. */
program *tool_compile(tool *t, const char *path, int *code);
/* Those that were not printed yet. */
void tool_print_diagnostics(tool *t);
/* Prints a message of a run, in the form that was asked for: a pcg_message_function whose `user`
 * is the tool. */
void tool_print_message(void *t, const pcg_message *m);
/* Emits its C; false (told why, exit code EXIT_NO) where it holds what cannot be run. */
bool tool_emit(tool *t, program *p, text *out);
/* Writes a whole file or nothing; "-" is stdout. `guard` may be NULL. False: it was told why. */
bool tool_write(interrupt *guard, const char *path, const char *bytes, size_t length);
/* Remembers that a pass took the time since the last call, by the clock and of the processors. */
void tool_lap(tool *t, const char *name);
void tool_print_timings(tool *t);
bool is_shared_object(const char *path); /* by content */
bool tool_colour(void);                  /* stderr is a terminal, and NO_COLOR is not set */
/* The extension of a path without its dot; "" when it has none. */
const char *path_extension(const char *path);

/* ---- passes that only commands use ----------------------------------------------------------- */

/* run --node: keeps what leads to a node of the main graph, makes its ports leaves. False when
 * there is no such node. */
bool cut_at_node(program *p, const char *name);

extern const command command_compile, command_run, command_watch, command_check, command_info,
    command_doc, command_new, command_library, command_completion, command_trace,
    command_profile, command_debug, command_bench;

#endif

/* debug.h - what the files of `pcgc debug` share.
 *
 * command_debug.c reads the command line and is told of the run; debug_command.c reads commands
 * and knows what there is of them; debug_move.c goes on and back; debug_break.c decides where to
 * stop (debug_condition.c whether a condition holds); debug_show.c prints what there is to see,
 * from the history alone (debug_history.h), so that the present and the past look the same. */
#ifndef PCG_DEBUG_H
#define PCG_DEBUG_H

#include "command_run.h"
#include "debug_history.h"

/* ---- where to stop --------------------------------------------------------------------------- */

/* The condition of a breakpoint, compiled. */
typedef struct debug_condition {
    native *code;
    const node *at;                /* what it is typed for */
    bool remembered;               /* it reads attributes alone, which are known of the past, too */
    pcg_entity **seen;             /* by input, while it is evaluated: the entities … */
    pcg_entity *shown;             /* … and what stands for those that are only recorded */
} debug_condition;

typedef enum breakpoint_kind { BREAK_NODE, BREAK_LINE, BREAK_EDGE, BREAK_WATCH } breakpoint_kind;

/* What it says of a node or port is NULL where any will do. */
typedef struct breakpoint {
    uint32_t number;
    breakpoint_kind kind;
    const char *said;              /* as it was given */
    const char *graph, *file, *node, *port;
    const char *to, *to_port;      /* BREAK_EDGE: its other end */
    const char *attribute;         /* BREAK_WATCH */
    uint32_t line;
    debug_condition *condition;    /* NULL: always */
    uint64_t hits;
    bool told;                     /* it was said that the condition cannot be asked of the past */
    struct breakpoint *next;
} breakpoint;

/* ---- the debugger ---------------------------------------------------------------------------- */

typedef enum going {
    GO_STEP,      /* to the next round */
    GO_NEXT,      /* until another node runs */
    GO_OVER,      /* not into encapsulated graphs */
    GO_OUT,       /* until the graph is done */
    GO_ON,        /* to a breakpoint */
    GO_TO         /* to round .wanted */
} going;

typedef struct debug_input {
    option_texts lines;            /* -x */
    size_t next;
    const char *path;              /* --batch; NULL: none */
    FILE *file;
    bool terminal;                 /* someone is typing: asked for each command */
    bool closed;                   /* nothing more is read from the standard input */
} debug_input;

typedef struct debugger {
    running *k;
    pcg_run *run;                  /* NULL before it begins */
    pcg_run *judge;                /* whose memory conditions use; NULL until there is one */
    history past;
    size_t history_limit;
    debug_input input;
    arena memory;                  /* of breakpoints */
    arena scratch;                 /* of one command */
    text out;                      /* of one command, in `scratch` */
    jmp_buf out_of_memory;
    table files;                   /* sources, by path: what `list` shows */
    breakpoint *breakpoints;
    uint32_t breakpoint_count;
    going mode;
    uint64_t wanted;               /* of GO_TO */
    uint32_t from_depth;           /* where it was last stopped */
    const pcg_node *from_node;
    const pcg_frame *from_frame;
    uint32_t shown;                /* the line that `list` has come to */
    const char *last;              /* the last command that moved */
    const char *line;              /* the command, as it was given */
    char *words;                   /* a copy, that is taken apart */
    bool resume;                   /* the command was one that goes on */
    bool over, quit;               /* the run has come to its end; nobody wants to go on */
    pcg_status status;             /* of a run that is over */
    int failed;                    /* an exit code: the debugger itself cannot go on */
    atomic_bool idle;              /* a command is waited for, or the run is over: Ctrl+C ends */
    atomic_bool pause;             /* Ctrl+C came: stop at the next round */
} debugger;

/* ---- commands (debug_command.c) -------------------------------------------------------------- */

typedef struct debug_command {
    const char *name, *letter;     /* a shorter name, or NULL */
    const char *arguments, *summary;
    const char *help;              /* more, and examples */
    void (*run)(debugger *d, char *arguments);
} debug_command;

/* All of them; a row without a name ends them. */
extern const debug_command debug_commands[];
/* Prints what was found, then asks for commands and obeys them until the run is to go on, or there
 * are no more. */
void debug_converse(debugger *d);
/* Prints the answer so far. */
void debug_answer(debugger *d);
/* Opens what commands are read from. False: it was told why. */
bool debug_open_input(debug_input *in);
void debug_close_input(debug_input *in);
/* The next word of a command's arguments, ended by a NUL; NULL behind the last. */
char *debug_word(char **arguments);
/* Prints "error: …" as the answer to a command. */
void debug_refuse(debugger *d, const char *format, ...) PRINTF_LIKE(2, 3);

/* ---- moving (debug_move.c) ------------------------------------------------------------------- */

/* The newest record: whether to stop there, which is told then. */
bool debug_stops(debugger *d);
/* Goes forward through what is recorded; true where that led to a stop. */
bool debug_replay(debugger *d);
void debug_step(debugger *d, char *arguments);
void debug_next(debugger *d, char *arguments);
void debug_over(debugger *d, char *arguments);
void debug_out(debugger *d, char *arguments);
void debug_continue(debugger *d, char *arguments);
void debug_back(debugger *d, char *arguments);
void debug_goto(debugger *d, char *arguments);

/* ---- breakpoints (debug_break.c) ------------------------------------------------------------- */

/* The one that the newest record hits, or NULL. */
breakpoint *debug_hit(debugger *d);
void debug_break(debugger *d, char *arguments);
void debug_watch(debugger *d, char *arguments);
void debug_delete(debugger *d, char *arguments);
/* Of a watch that was hit: what has changed. */
void debug_show_change(debugger *d, const breakpoint *b);
/* Adds a line for each. */
void debug_list_breakpoints(debugger *d);
void debug_forget_breakpoints(debugger *d);

/* ---- conditions (debug_condition.c) ---------------------------------------------------------- */

/* Compiles the expression that stands in the command's line from `expression` on, typed as an
 * argument of `at`. NULL: it was told why. */
debug_condition *debug_condition_new(debugger *d, const char *line, const char *expression,
                                     const node *at);
void debug_condition_free(debug_condition *c);
/* Whether it holds at the newest record; where it cannot be evaluated that is told, and it counts
 * as holding. */
bool debug_condition_holds(debugger *d, breakpoint *b);

/* ---- showing (debug_show.c) ------------------------------------------------------------------ */

/* Where the view stands; `why` comes first, NULL: nothing. */
void debug_show_place(debugger *d, const char *why);
void debug_add_source_line(debugger *d, const char *file, uint32_t line, bool marked);
/* "figure_4_6.pcg": without its folders. */
const char *debug_file_name(const char *path);
/* The number of a level's attribute of that name; SEEN_NOWHERE: it has none. */
uint32_t debug_find_attribute(const seen_level *l, const char *name);
void debug_add_attribute(debugger *d, const seen_level *l, uint32_t attribute, const seen_state *s);
void debug_queues(debugger *d, char *arguments);
void debug_print(debugger *d, char *arguments);
void debug_parameters(debugger *d, char *arguments);
void debug_list(debugger *d, char *arguments);
void debug_where(debugger *d, char *arguments);
void debug_info(debugger *d, char *arguments);

/* ---- gdb (debug_gdb.c) ----------------------------------------------------------------------- */

/* Runs the graph under gdb; returns the exit code. */
int debug_by_gdb(const command *self, running *k, const debug_input *input, const char *path);

#endif

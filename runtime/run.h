/* run.h - a run from inside: what the files of runtime/ share.
 *
 * A run belongs to the thread that executes it. Only `attention` is touched by others. Everything
 * that can fail says why by run_fail, once: the first reason stands, every round from then on
 * returns its status, and pcg_run_execute gives it to the host.
 */
#ifndef PCG_RUN_H
#define PCG_RUN_H

#include <stdatomic.h>

#include "base/base.h"
#include "keys.h"
#include "memory.h"
#include "pcg.h"
#include "program.h"

/* Why the next round has to stop, as flags. */
enum { ATTENTION_CANCEL = 1, ATTENTION_FAILED = 2 };

enum {
    RUN_CLOCK_PERIOD = 64,        /* rounds and ticks between two looks at the clock, at most */
    RUN_WARNINGS_OF_NODE = 20,    /* told; those behind them are counted */
    RUN_NOTES_KEPT = 10000,       /* those behind them go to the callback only */
    RUN_FLOW_BATCH = 64,          /* entities that a node of a flow takes at a time */
    RUN_MESSAGE_BYTES = 64 << 20, /* of all messages that are kept */
    RUN_STACK_RESERVE = 256 << 10 /* bytes of stack left to run one more encapsulated graph */
};

/* What was left waiting in one input of a node, over all executions. */
typedef struct run_waiting {
    struct run_waiting *next;
    const pcg_node *node;
    const char *input;
    pcg_u64 count;
} run_waiting;

/* Strings of the run, each once: open addressing. */
typedef struct run_strings {
    struct run_string { pcg_u64 hash; const char *at; } *slots;
    pcg_u32 count, capacity;
} run_strings;

typedef struct run_messages {
    arena arena;                   /* of all that is kept */
    LIST(pcg_message *) list;
    table sources; /* the files that messages point into, as far as they can be read */
    pcg_u64 lost;                  /* found no memory */
    pcg_u64 notes;
    char error[1024];              /* what pcg_run_error returns; needs no memory */
} run_messages;

/* Of the result as a whole. */
typedef struct run_property {
    struct run_property *next;
    const char *key; /* "origin.latitude" */
    int kind;
    pcg_cell value;
} run_property;

/* What a kernel leaves to be ended with the run: a thread that could not be waited for when the run
 * was cancelled, say. The newest first, before any memory goes. */
typedef struct run_ending {
    struct run_ending *next;
    void (*end)(void *context);
    void *context;
} run_ending;

/* A module that takes part in a run: the program's own, and each that a surrogate has loaded. Nodes
 * and ports number themselves within it. */
typedef struct pcg_loaded {
    struct pcg_loaded *next;       /* in the order in which they came */
    const pcg_program *program;
    const pcg_module *module;
    const char *key;               /* its file, or what it was compiled from; NULL: the program's own */
    pcg_u64 *sent;                 /* entities that left each output port */
    pcg_u64 *worked;               /* rounds of each node */
    pcg_u32 *warnings;             /* by node; NULL until the first */
    bool borrowed;                 /* the program is another run's, which outlives what is done with it */
} pcg_loaded;

/* What was added up, by the number of its key; in order of the keys once the run is done. */
typedef struct run_totals {
    run_keys keys;
    pcg_total *at;
    pcg_u32 count, capacity;
} run_totals;

/* The flow that is running; what is told waits for its end. */
typedef struct run_flow {
    bool running;
    pcg_u32 batch;                 /* RUN_FLOW_BATCH */
    pcg_u32 rank;                  /* in the order, of the node whose turn it is */
    struct flow_held *held;        /* messages */
    struct flow_warned *warned;    /* how often which node warned */
    pcg_u32 held_count, held_capacity, warned_count, warned_capacity;
    run_keys once;                 /* what was warned of once, and from where in the order */
} run_flow;

typedef enum run_stage { RUN_NEW, RUN_EXECUTING, RUN_EXECUTED } run_stage;

struct pcg_run {
    run_memory memory;             /* first */

    /* Read or written in every round. */
    atomic_uint attention;         /* set by any thread */
    pcg_u32 patience;              /* rounds and ticks until the clock is looked at */
    pcg_u64 rounds, max_rounds;
    pcg_u64 entities, max_entities, most_entities; /* alive; the most that ever were */
    bool by_module;                /* rounds are numbered by node over all frames, not in each of them */
    bool drawn;                    /* a random number was drawn; reset by who asks */
    pcg_u32 cells;                 /* of an entity's attributes that were written so far, or few */
    const pcg_node *node;          /* of the newest round, and its number */
    pcg_u64 round;
    struct run_observation *observed; /* NULL: nobody watches */

    pcg_u32 period;                /* what patience begins at */
    pcg_int started, looked, told; /* nanoseconds: execution, look at the clock, progress */
    pcg_u32 max_depth;
    double max_seconds;            /* 0: none */
    uintptr_t stack_floor; /* no encapsulated graph is begun below it; 0: not asked for yet */

    const pcg_program *program;
    const pcg_module *module;
    pcg_loaded own;                /* the first in the list of what was loaded */
    pcg_frame *frame;              /* of the main graph; NULL where memory ran out at once */
    run_stage stage;
    int status;                    /* PCG_OK, or why it stopped */
    bool strict;
    uint64_t seed;
    pcg_message_function *message;
    int (*progress)(void *user, const pcg_progress *p);
    void *user;

    run_strings strings;
    run_messages messages;
    run_flow flow;
    run_waiting *waiting;          /* in the order of nodes */
    run_property *properties, **properties_end;
    run_totals totals;
    void (*found)(void *user, const char *path); /* see result_watch_paths; NULL */
    void *found_user;
    struct interrupt *guard; /* whom to tell of unfinished files; NULL: nobody */
    run_ending *endings;
    struct part_unsettled *unsettled; /* shapes whose parts have changed; NULL: none */
    pcg_u64 fed; /* entities that the host put in: numbers their lines of descent */
    pcg_entity *newest_fed; /* whose attributes the host may set; NULL before the first */
    pcg_entities *outputs;         /* what came out of each output */
    struct pcg_choice *profiled, **profiled_end; /* what `profile` has run */
    struct run_record *record;     /* what is being said, for who will say it again; NULL */
    run_keys once;                 /* what pcg_warn_once has said */
    struct run_crew *crew;         /* whose threads run parts of it; NULL: none yet */
    bool is_worker;                /* it runs such parts itself, and says nothing but by its record */
    pcg_u32 threads;               /* at most; 0: as many as there are processors */
    size_t max_cache;              /* bytes; 0: what is usual */
    bool no_cache;
    bool disk_told;                /* that something is wrong with what is kept on disk */
    struct run_views *views;       /* flat arrays of results; NULL until asked for */
    struct run_materials *materials; /* for pcg_material_intern; NULL at first */
};

/* ---- failing -------------------------------------------------------------------------------- */

/* Ends the run: records the error, unless there was one already. `node` NULL: no place. Returns the
 * status that the run has now. The arguments fill the catalogue's format. */
int run_fail(pcg_run *r, int status, diagnostic_code code, const pcg_node *node, pcg_u64 round,
             ...);
/* The memory limit, or the system, gave no `size` bytes. */
void run_out_of_memory(pcg_run *r, size_t size);
/* Sets what pcg_run_error returns, and nothing else; returns PCG_STATUS_MISUSE. */
pcg_status run_misuse(pcg_run *r, const char *format, ...) PRINTF_LIKE(2, 3);
/* Where the run has failed or is cancelled: its status. Otherwise looks at the clock and tells
 * progress, and may fail by that. What pcg_round and pcg_tick do now and then. */
int run_look(pcg_run *r);

/* ---- messages ------------------------------------------------------------------------------- */

enum { MESSAGE_PLAIN = DIAG_COUNT }; /* no code: what `log` prints */

/* Records a message and hands it to the host's callback. `code`: a row of the catalogue, or
 * MESSAGE_PLAIN. */
void message_tell(pcg_run *r, pcg_severity s, int code, const pcg_node *node, pcg_u64 round,
                  const char *line);
/* As message_tell for a row of the catalogue, whose format the arguments fill. */
void message_diagnose(pcg_run *r, diagnostic_code code, const pcg_node *node, pcg_u64 round, ...);
/* printf's formats, but '.' is the decimal point in every locale. */
void message_format(text *out, const char *format, va_list arguments);
/* Records what a compiler or loader has to say, and hands it on. */
void message_forward(pcg_run *r, const pcg_message *m);
/* A copy with texts of its own. Memory that has run out goes to the arena's owner. */
pcg_message *message_copy(arena *a, const pcg_message *m);
/* Fills what pcg_run_error returns, which needs no memory of its own. */
void message_error(pcg_run *r, const char *format, va_list arguments);
void messages_close(pcg_run *r);
/* Counts a warning of a node; false where enough were told. */
bool message_admit(pcg_loaded *l, pcg_u32 node);

/* While a flow runs: counts a warning of the call's node, and says whether it may yet be told; keeps
 * it back; keeps another message back: false where there is no memory. */
bool flow_admit(pcg_call *c);
void flow_hold_warning(pcg_call *c, bool once, const char *line);
bool flow_hold(pcg_run *r, pcg_severity s, int code, const pcg_node *node, pcg_u64 round,
               const char *line);
/* Tells what was kept back, in order; then the flow is over. */
void flow_tell(pcg_run *r);

/* After the run: nodes to which nothing came, entities that waited for nothing, warnings that were
 * held back. */
void report_silence(pcg_run *r);
/* Counts what was left waiting in an input of a node. */
void report_left(pcg_run *r, const pcg_node *node, const char *input, pcg_u64 count);
/* A warning of a node of that module, told unless there were too many; `once`: or it was said before. */
void message_warn(pcg_run *r, pcg_loaded *l, const pcg_node *node, pcg_u64 round, bool once,
                  const char *line);
/* Tells whoever wants to know that the run asks for a file. */
void path_note(pcg_run *r, const char *path);
/* What `profile` has measured. */
void report_profiles(pcg_run *r);

/* ---- loaded modules ------------------------------------------------------------------------- */

/* Fills in what counts a module's rounds and entities. False: no memory, and the run knows. */
bool loaded_open(pcg_run *r, pcg_loaded *l, const pcg_program *p);
/* The frame's graph is of that module. */
static inline void loaded_take(pcg_frame *f, pcg_loaded *l)
{
    f->loaded = l;
    f->sent = l->sent;
    f->worked = l->worked;
}
/* Adds one to those that take part in the run; NULL: no memory. `key` lives as long as the run. */
pcg_loaded *loaded_add(pcg_run *r, const pcg_program *p, const char *key);
/* That was added with an equal key; NULL. */
pcg_loaded *loaded_before(pcg_run *r, const char *key);
/* Gives up what was loaded; nothing of it may be looked at any more. */
void loading_close(pcg_run *r);

/* ---- totals -------------------------------------------------------------------------------- */

/* Adds to the total of a key. Status. */
int total_add(pcg_run *r, const char *key, double amount);
/* Puts them in order of their keys: nothing can be added from then on. */
void total_sort(pcg_run *r);

/* ---- attributes ----------------------------------------------------------------------------- */

/* What an entity's written cells are kept in: this head, a bit a cell that says whether it was
 * written, the cells. An encapsulated graph's cells lie behind its supergraph's. Shared by
 * descendants and copies until one is written. */
struct pcg_attributes {
    pcg_u32 references;
    pcg_u32 cells;
    pcg_u64 present[];
};

static inline struct pcg_attributes *attributes_hold(struct pcg_attributes *a)
{
    if (a)
        a->references++;
    return a;
}
void attributes_drop(pcg_run *r, struct pcg_attributes *a); /* NULL is allowed */
size_t attributes_bytes(const struct pcg_attributes *a); /* of the whole block */
/* As pcg_leave for the entity alone, not for what it holds. */
void attributes_leave(pcg_run *r, pcg_entity *e, pcg_u32 base);
/* The attribute is at its default again. */
void attributes_unwrite(pcg_run *r, pcg_entity *e, const pcg_slot *s);
/* The attributes from cell `base` on become those of `from`, defaults included. */
void attributes_take(pcg_run *r, pcg_entity *to, const pcg_entity *from, pcg_u32 base);

/* ---- entities ------------------------------------------------------------------------------- */

/* An entity of which all is zero but its type and one reference; counted. NULL: no memory, or over the
 * limit. */
pcg_entity *entity_empty(pcg_run *r, const pcg_type *type);

/* ---- endings -------------------------------------------------------------------------------- */

/* `e` is the caller's, and stays where it is until it is removed or the run is freed. */
void run_ending_add(pcg_run *r, run_ending *e);
void run_ending_remove(pcg_run *r, run_ending *e);

/* One more time of an iteration: it counts as a round. Status. */
int round_again(pcg_call *c);

/* ---- the rest ------------------------------------------------------------------------------- */

/* The run's cells of a parameter, output queue and such: what lies at an offset of the main
 * frame. */
static inline void *run_at(const pcg_run *r, pcg_u32 offset)
{
    return (char *)r->frame + offset;
}
/* What came out of an output; nothing unless the run was done. */
const pcg_entities *run_output(const pcg_run *r, size_t output);
pcg_int run_clock(void); /* monotonic nanoseconds, cheap and a few milliseconds coarse */
void views_close(pcg_run *r);

#endif

/* surrogate.h - what the files that run surrogates share: surrogate.c runs one, surrogate_fit.c
 * looks whether what it chose is as its braces declare, loading.c finds and loads it; outcome.c
 * carries what came out of it from run to run, for parallel.c and its workers in crew.c, and for
 * cache.c.
 */
#ifndef PCG_SURROGATE_H
#define PCG_SURROGATE_H

#include "parcel.h"
#include "record.h"
#include "run.h"

#define NO_OUTPUT UINT32_MAX /* what comes out there is dropped */

/* One graph that a surrogate runs. */
typedef struct pcg_choice {
    struct pcg_choice *next;       /* of the same surrogate */
    const char *name;              /* by which it was chosen first */
    pcg_loaded *loaded;
    const pcg_module *module;      /* the loaded one, or one that it holds */
    pcg_frame *frame;
    pcg_queue **inputs;            /* by declared input: its gate's queue */
    const pcg_parameter_info **parameters; /* by declared parameter */
    const pcg_attribute_info **attributes; /* by declared attribute */
    pcg_slot *slots;               /* of these, in the frame */
    pcg_u32 *outputs;              /* by output of the module: the declared one, or NO_OUTPUT */
    pcg_u32 below;                 /* the first cell that goes when an entity leaves */
    int origin;                    /* the cell of its origin (parcel.h); below 0: none */
    pcg_u32 execution;             /* of the surrogate's graph, in which it was started last */
    pcg_u32 starts, start;         /* how often it was to be started; which of these its frame has had */
    pcg_u64 start_lineage;         /* of the newest of these */
    bool alone;                    /* it is no longer tried in threads */
    bool told;                     /* why what it gives is not kept */
    struct cached_path *paths;     /* of `cache` */
    const pcg_node *node;          /* the surrogate; of these here only `profile` makes use */
    struct pcg_choice *next_profiled;
    pcg_u64 executions, rounds, entered, left;
    pcg_int time;                  /* nanoseconds */
    bool started, stale;           /* stale: a parameter has changed, it must be started anew */
} pcg_choice;

/* What a surrogate has run so far. */
typedef struct pcg_choices {
    run_keys names;
    pcg_choice **by_name;          /* by the name's number */
    pcg_u32 capacity;
    pcg_choice *all;
    const char *last;              /* of the newest round */
} pcg_choices;

/* The graph that a name means, loaded where it was not yet: a graph of the surrogate's file, a file, a
 * procedure. Fills in `module` and `loaded`. Status. */
int loading_find(pcg_call *c, const pcg_surrogate_info *info, const char *name, pcg_choice *found);
/* Looks whether it is as declared, and fills in what leads from the declarations to it; the frame is
 * not needed yet. Status. */
int surrogate_fit(pcg_call *c, const pcg_surrogate_info *info, pcg_choice *made);

/* Its frame, for a node of the graph of `parent`, of whose attribute cells so many are taken. Status. */
int choice_open(pcg_choice *k, const pcg_surrogate_info *info, pcg_frame *parent,
                const pcg_node *node, pcg_u32 cells);
/* Something of the choice's frame. */
static inline void *choice_at(const pcg_choice *k, pcg_u32 offset)
{
    return (char *)k->frame + offset;
}
static inline pcg_queue *choice_output(const pcg_choice *k, pcg_u32 output)
{
    return choice_at(k, k->module->outputs[output].queue);
}
/* Whether the next execution has to start it first. */
bool surrogate_is_stale(const pcg_surrogate *s);
/* Runs the graph for what has entered its frame, after starting it where that is due. Status. */
int surrogate_execute(const pcg_surrogate *s);
/* Sends on what came out of it, and empties its content pool. Status. */
int surrogate_leave(pcg_call *c, pcg_surrogate *s);
/* Writes the value of the graph's attribute `number` to what it is linked to. */
void surrogate_write_link(pcg_call *c, const pcg_choice *k, pcg_u32 number, const pcg_cell *value,
                          pcg_entity *e, const pcg_slot *to);

/* ---- outcomes: what an execution gave, and said, as bytes --------------------------------------- */

/* What a module had counted before the execution; NULL for nothing. */
typedef struct outcome_before { const pcg_u64 *sent, *worked; } outcome_before;

/* Packs what waits at the outputs of k's frame, for the surrogate s that is, or stands for, its node;
 * what was recorded; and what was counted: of all modules that take part in the packer's run where the
 * packer is local, else of k's own since `before`. Status. */
int outcome_pack(pcg_packer *p, const pcg_surrogate *s, const pcg_choice *k, const run_record *said,
                 const outcome_before *before);
/* Unpacks one, as if s had run just now: says and counts it, sends on what came out. Where its bytes
 * are wrong nothing of this is done, and u->failed is set. `renumber`: lines of descent are numbered
 * anew. Status. */
int outcome_take(pcg_unpacker *u, pcg_call *c, pcg_surrogate *s, bool renumber);
/* Gives entities the lines of descent that what leaves a cache has. */
void outcome_renumber(const pcg_call *c, pcg_entity *const *entities, pcg_u32 count);

/* ---- parallel ----------------------------------------------------------------------------------- */

/* Whether rounds of a surrogate are put off until the batch is run. */
bool parallel_puts_off(pcg_call *c, pcg_surrogate *s);
/* An entity for a round that is put off; takes the reference over. Status. */
int parallel_enter(pcg_call *c, pcg_surrogate *s, pcg_u32 input, pcg_entity *e);
/* That round is complete. Status. */
int parallel_put_off(pcg_call *c, pcg_surrogate *s, const pcg_entity *impulse);
/* Runs all that was put off. Status. */
int parallel_finish(pcg_call *c, pcg_surrogate *s);

/* ---- cache -------------------------------------------------------------------------------------- */

/* A file that a graph that is kept has asked for, as it was when it did so first. */
typedef struct cached_path {
    struct cached_path *next;
    const char *path;
    file_stamp stamp;
} cached_path;

/* Runs the graph for what has entered it, or takes what it gave for that before. Status. */
int cache_run(pcg_call *c, pcg_surrogate *s);

/* `profile` is going to tell of it at the end of the run. */
void profile_begin(pcg_run *r, pcg_choice *k);
pcg_int profile_clock(void); /* monotonic nanoseconds */

#endif

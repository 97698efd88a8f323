/* crew.h - threads that run parts of a run.
 *
 * Each worker has a run of its own, with its own memory, frames and counters, and shares nothing
 * with the main one but what is not written while they work: code, tables, entities that were put
 * off, and what these hold. What it makes goes back as bytes (outcome_pack), which the main thread
 * takes in order, so that no result depends on which worker was first. Where a worker fails, for
 * whatever reason, its item is run once more by the main run, which so fails as it would have
 * without threads, or does not. Workers stay until the main run is freed: what they have loaded is
 * referred to.
 *
 * A crew knows of surrogates only by batch_item, so that other nodes can put rounds off, too.
 */
#ifndef PCG_CREW_H
#define PCG_CREW_H

#include "surrogate.h"

enum {
    CREW_THREADS_MAX = 256,
    CREW_AHEAD = 16,           /* items for each thread that may be done and not taken yet */
    BATCH_ITEMS_MAX = 4096     /* more are run in batches */
};

/* BATCH_HERE: it is for the main run alone. */
typedef enum batch_stage {
    BATCH_WAITS, BATCH_HERE, BATCH_RUNS, BATCH_DONE, BATCH_FAILED
} batch_stage;

typedef struct batch_entity {
    pcg_u32 input;
    pcg_entity *entity;
} batch_entity;

/* A round that was put off. All is the main run's but for `result`. */
typedef struct batch_item {
    pcg_choice *choice;
    batch_entity *entered;     /* each a reference */
    pcg_u32 entered_count, entered_capacity;
    pcg_entity *impulse;       /* a reference; NULL */
    pcg_cell *given;           /* the graph's declared parameters, one behind the other */
    pcg_u64 lineage, start_lineage;
    pcg_u32 start;             /* the choice's start that it needs */
    bool first;                /* of that start */
    batch_stage stage;
    char *result;              /* malloc's */
    size_t result_length;
    pcg_u64 rounds, most_entities;
    bool drawn;
} batch_item;

/* Rounds that wait to be run. */
typedef struct pcg_batch {
    pcg_surrogate *surrogate;
    batch_item *items;
    pcg_u32 count, capacity;
    batch_item next;           /* that is being put together */
} pcg_batch;

/* Workers begin on the batch's items, by no more than `threads` threads. False: there are none. */
bool crew_begin(pcg_call *c, pcg_batch *b, pcg_u32 threads);
/* Waits for an item, whose stage tells how it went; looks after the run meanwhile. Status. */
int crew_wait(pcg_call *c, pcg_u32 item);
/* No item is begun any more; those that run are cancelled. Waits for the threads. */
void crew_end(pcg_run *r);
/* Graphs are loaded once for all runs of a crew; nothing happens where the run has none. Begin
 * waits until no other run loads, and gives the program where one has it; end is told what was
 * loaded instead, NULL: nothing. */
const pcg_program *crew_loading_begin(pcg_run *r, const char *key);
void crew_loading_end(pcg_run *r, const char *key, const pcg_program *loaded);
/* When the run is freed. */
void crew_close(pcg_run *r);

#endif

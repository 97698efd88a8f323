/* record.h - what an execution of a graph says, kept so that it can be said again, or somewhere
 * else: where a cache has its result, and where a thread has run it for another run.
 */
#ifndef PCG_RECORD_H
#define PCG_RECORD_H

#include "run.h"

typedef enum record_kind {
    RECORD_TOLD, RECORD_WARNED, RECORD_ONCE, RECORD_LEFT, RECORD_PATH
} record_kind;

/* By which one sees that a file is another one: whether it is there, size, times of its content and
 * of its entry. */
typedef struct file_stamp {
    uint64_t there, size, modified, modified_nanoseconds, changed, changed_nanoseconds;
} file_stamp;
file_stamp file_stamp_of(const char *path); /* NULL is not there */

typedef struct record_item {
    record_kind kind;
    pcg_severity severity; /* of RECORD_TOLD */
    int code;
    const pcg_node *node;
    pcg_loaded *loaded;    /* of a warning: the module that the node is of */
    pcg_u64 count;         /* its round; of RECORD_LEFT how many were left waiting */
    const char *text;      /* the message, the input, the path */
    file_stamp stamp;      /* of RECORD_PATH: as it is before it is read */
} record_item;

/* Records may lie in each other: what is said goes to all of them. Starts zeroed but for `outer`.
 */
typedef struct run_record {
    struct run_record *outer;
    arena arena;
    LIST(record_item) items;
    bool lost; /* memory ran out: it is not all here */
} run_record;

void record_told(run_record *k, pcg_severity s, int code, const pcg_node *node, pcg_u64 round,
                 const char *line);
void record_warned(run_record *k, pcg_loaded *l, const pcg_node *node, pcg_u64 round, bool once,
                   const char *line);
void record_left(run_record *k, const pcg_node *node, const char *input, pcg_u64 count);
void record_path(run_record *k, const char *path);
/* Says it in a run, where `loaded` takes part that the node of a warning is of there. */
void record_replay(pcg_run *r, const record_item *item, pcg_loaded *loaded);
/* Empties it. */
void record_close(run_record *k);

#endif

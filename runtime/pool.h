/* pool.h - what a graph keeps by key: the content pool of `store` and `load`, and the messages
 * of `broadcast`.
 *
 * Each frame may have a pool of its own, which is there for the graph and the graphs that it
 * encapsulates, and is emptied when an execution of the graph is done. That of the main frame is
 * there for the whole run. Entities are kept by reference. One that is handed over a graph's
 * border this way, inward or outward, loses the attributes of that graph when its execution is
 * done, as if it left through a gate.
 */
#ifndef PCG_POOL_H
#define PCG_POOL_H

#include "abi.h"

typedef enum pool_shelf { POOL_STORED, POOL_MESSAGES } pool_shelf;

/* What is kept under a key, in the order in which it came. */
typedef struct pool_list {
    pcg_entity **at;
    pcg_u32 count, capacity;
} pool_list;

/* Keeps a reference in the pool of `owner`, which is the frame of the call or one around it.
 * Status. */
int pool_add(pcg_call *call, pcg_frame *owner, pool_shelf shelf, const char *key, pcg_entity *e);
/* What the nearest frame that has the key keeps under it, from `from` outward; *owner is that
 * frame. NULL where none has it. Valid until the next pool_add. */
pool_list *pool_find(pcg_frame *from, pool_shelf shelf, const char *key, pcg_frame **owner);
/* The number of a key on the frame's shelf; KEYS_NONE where it has none. */
pcg_u32 pool_number(const pcg_frame *f, pool_shelf shelf, const char *key);
/* What is kept under that number. */
const pool_list *pool_at(const pcg_frame *f, pool_shelf shelf, pcg_u32 number);
/* Notes that an entity of the pool of `owner` is about to be sent on in the frame of the call.
 * Status. */
int pool_lend(pcg_call *call, pcg_frame *owner, pcg_entity *e);
/* Drops what is kept, and leaves attributes as they are: between the times of an iteration. */
void pool_empty(pcg_frame *f);
/* The frame of the main graph. */
pcg_frame *pool_outermost(pcg_frame *f);

#endif

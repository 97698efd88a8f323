/* observe.h - a run that is watched: entities have numbers, and remember which ports they left; rounds
 * are told to an observer.
 *
 * A run that nobody watches has no run_observation, and what calls these functions asks for that first.
 * Numbers and ways stand in tables beside the entities, so that neither an entity nor a result
 * depends on being watched. */
#ifndef PCG_OBSERVE_H
#define PCG_OBSERVE_H

#include "run.h"
#include "value.h"

enum { OBSERVE_NO_WAY = 0 };

/* The way of an entity: the ports that it left, the last one first. Ways share their beginnings. */
typedef struct observed_way {
    pcg_u32 before;        /* another way; OBSERVE_NO_WAY at the beginning */
    pcg_u32 length;
    const pcg_node *node;
    const char *port;
} observed_way;

typedef struct observed_entity {
    const pcg_entity *entity; /* NULL: the slot is empty */
    pcg_u64 number;           /* from 1, in the order in which they were made */
    pcg_u32 way;
    pcg_u64 left;             /* the run's rounds when it left the last port of its way */
} observed_entity;

typedef struct run_observation {
    pcg_observer *observer;  /* NULL: only the ways are wanted */
    void *user;
    bool ways;
    pcg_u64 numbered;
    observed_entity *entries;    /* open addressing */
    pcg_u32 entry_count, entry_capacity;
    observed_way *at;           /* ways; number 0 is none */
    pcg_u32 way_count, way_capacity;
    pcg_u32 *way_slots;      /* open addressing, so that each way is there once */
    pcg_u32 slot_capacity;
    arena scratch;           /* of what an event's values are written into */
    const pcg_seen *about;   /* of the round that is being told; NULL */
    const void *self;
    const pcg_entities *inputs;
    const pcg_call *call;    /* of the event that is being told, with what it runs in; NULL */
    const pcg_entity *entity; /* of PCG_EVENT_SENT, and the queue that it is about to enter; NULL */
    const pcg_queue *to;
} run_observation;

/* The run's watch, made where there is none. NULL: no memory, and the run knows. */
run_observation *observe_open(pcg_run *r);
void observe_close(pcg_run *r);
/* An entity was made as a descendant of another, or as its copy; `from` may be NULL. */
void observe_made(pcg_run *r, const pcg_entity *e, const pcg_entity *from);
/* What pcg_emit does in a run that is watched. Status. */
int observe_emit(pcg_call *c, const pcg_port *p, pcg_entity *e);
/* Its number, a new one where it has none. 0: no memory, and the run knows. */
pcg_u64 observe_number(pcg_run *r, const pcg_entity *e);
/* What waits in a queue. What the round that is being told has taken does not, though it may still
 * lie there. */
pcg_entities observe_waiting(const run_observation *w, const pcg_queue *q);
/* While a PCG_EVENT_ROUND is told: a value of that round, as cells (4 at most). False: it is none, but
 * named; what stands for it is the parameter's `text`. */
bool observe_parameter(const pcg_run *r, size_t parameter, pcg_cell *cells, value_type *t);
/* The same as JSON. */
void observe_parameter_json(pcg_run *r, size_t parameter, text *out);

#endif

/* debug_history.h - what a debugger remembers of a run: its rounds, queues and entities, back and
 * forth.
 *
 * A view holds what the run looks like at one time: the graphs that are executing, each with its
 * queues; the rounds that are under way; each entity that waits or was taken, as it is then. All
 * that happens is a record that changes the view and can be taken back, so that the view stands at
 * any time between the oldest record and the present. Where records need more than their limit,
 * whole rounds are given up, the oldest first. Nothing of it belongs to the run that is looked at:
 * it has memory of its own. */
#ifndef PCG_DEBUG_HISTORY_H
#define PCG_DEBUG_HISTORY_H

#include "../runtime/observe.h"
#include "../runtime/shape.h"

/* An entity at one time. */
typedef struct seen_state {
    const pcg_type *type;
    const pcg_node *maker;         /* NULL: the host */
    bool is_shape;
    uint32_t faces, vertices;
    pcg_scope scope;
    size_t bytes;                  /* of the whole block */
    struct pcg_attributes *attributes; /* behind this struct; NULL: all at their defaults */
} seen_state;

/* Numbers of entities: a ring. */
typedef struct seen_queue {
    uint64_t *at;
    uint32_t head, count, capacity;
    bool shared;                   /* something else may change what waits in it */
    uint32_t fresh;                /* the last so many came since a round ended */
} seen_queue;

/* A graph that is executing. */
typedef struct seen_level {
    pcg_frame *frame;
    const pcg_seen_graph *graph;
    seen_queue *queues;            /* as many as the graph has */
    pcg_cell *initial;             /* defaults of its attributes, one behind the other */
    uint32_t cells;
} seen_level;

/* A parameter of a round, as it was evaluated. */
typedef struct seen_value {
    bool named;                    /* no value: what it was given is its `text` */
    value_type type;
    pcg_cell cells[4];
} seen_value;

typedef struct seen_round {
    uint64_t id;                   /* among all rounds, from 1, as they begin */
    uint64_t number;               /* among those of its node */
    const pcg_node *node;
    const pcg_seen *about;
    uint32_t *taken;               /* by input, how many entities */
    uint64_t *entities;            /* of all inputs, one behind the other */
    uint32_t entity_count;
    seen_value *values;            /* by parameter */
} seen_round;

typedef enum seen_kind {
    SEEN_ENTER,  /* .level: a graph begins to execute */
    SEEN_LEAVE,
    SEEN_ROUND,  /* .round begins */
    SEEN_SENT,   /* .sent: it is about to send an entity */
    SEEN_END,
    SEEN_PUSH,   /* an entity enters, or leaves, a queue */
    SEEN_TAKE,
    SEEN_STATE   /* an entity is another than before */
} seen_kind;

#define SEEN_NOWHERE UINT32_MAX

typedef struct seen_record {
    seen_kind kind;
    uint32_t level, queue;         /* SEEN_SENT: the queue that takes it, or SEEN_NOWHERE */
    uint64_t entity;
    union {
        seen_level *level_of;
        seen_round *round;
        struct { const seen_state *before, *after; } state; /* NULL: not remembered */
        struct { const char *port; uint64_t original; const seen_state *before; } sent;
    };
} seen_record;

/* What is known of an entity. */
typedef struct seen_entity {
    uint64_t number;               /* 0: the slot is empty */
    const seen_state *state;
    uint32_t places;               /* queues and rounds that hold it at present */
} seen_entity;

typedef struct history {
    pcg_run *store;                /* whose memory it is; never executed */
    size_t limit, used;            /* bytes */
    bool failed;                   /* there was no memory: it can no longer be trusted */
    seen_record *records;          /* a ring; numbered from the beginning of the run */
    uint64_t first, end, cursor;   /* the view stands behind the record before `cursor` */
    uint64_t capacity;
    uint64_t rounds;               /* begun so far */
    /* The view: */
    seen_level **levels;           /* the main graph first */
    seen_round **open;             /* rounds under way, the outermost first */
    uint32_t level_count, level_capacity, open_count, open_capacity;
    seen_entity *entities;         /* open addressing */
    uint32_t entity_count, entity_capacity;
    /* What the last event has sent is in its queue from the next one on. */
    seen_record pending;
    bool has_pending;
} history;

/* False: no memory. */
bool history_open(history *h, const pcg_program *p, size_t limit);
void history_close(history *h);

/* ---- recording (debug_record.c) ------------------------------------------------------------- */

/* Adds what an event of the run tells; the view must stand at the present. The newest record is the
 * event's own. False: no memory. */
bool history_take(history *h, pcg_run *r, const pcg_event *e);
/* The run is over: what was still on its way arrives. */
bool history_finish(history *h);

/* ---- moving --------------------------------------------------------------------------------- */

static inline bool history_is_present(const history *h)
{
    return h->cursor == h->end;
}
static inline seen_record *history_record(const history *h, uint64_t number)
{
    return &h->records[number & (h->capacity - 1)];
}
/* The record that led to where the view stands; NULL at the beginning. */
const seen_record *history_last(const history *h);
/* One record; false at either end. */
bool history_back(history *h);
bool history_forward(history *h);

/* ---- looking -------------------------------------------------------------------------------- */

/* The innermost round under way, or NULL; the graph that it stands in. */
seen_round *history_round(const history *h);
seen_level *history_level(const history *h);
/* NULL where it is not remembered. */
const seen_state *history_state(const history *h, uint64_t entity);
uint64_t seen_queue_entity(const seen_queue *q, uint32_t i);
/* An attribute of the level's graph: its cells, those of its default while it is not written
 * (*written tells). */
const pcg_cell *seen_attribute(const seen_level *l, uint32_t attribute, const seen_state *s,
                               bool *written);

/* ---- within: for debug_record.c ------------------------------------------------------------- */

/* Adds a record and lets the view follow it. False: no memory. */
bool history_add(history *h, const seen_record *r);
/* Counted memory of the history's own, cleared; NULL: there is none. */
void *history_alloc(history *h, size_t bytes);
void history_free(history *h, void *block, size_t bytes);
/* Its entry, a new one where it has none; NULL: no memory. Entries move when others are made. */
seen_entity *history_entity(history *h, uint64_t number);
/* It is held in one place less: forgotten where that was the last. False: no memory. */
bool history_release(history *h, uint64_t number);

#endif

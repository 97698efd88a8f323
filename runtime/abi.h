/* abi.h - what emitted C and kernels see of the runtime.
 *
 * The compiler writes this file, as it stands here, at the head of the C that it emits (a build
 * step turns it into a string), so that emitted C includes nothing and means the same to libtcc,
 * tcc, gcc and clang. Hence: no system header, no bit-fields, no alignment attributes, nothing
 * inline that tcc cannot do, and no struct of 16 bytes or less passed or returned by value (libtcc
 * passes those wrongly).
 *
 * Any change here changes PCG_ABI.
 */
#ifndef PCG_ABI_H
#define PCG_ABI_H

#define PCG_ABI 11

typedef unsigned char pcg_u8;
typedef unsigned int pcg_u32;
typedef unsigned long long pcg_u64;
typedef long long pcg_int;

typedef struct pcg_run pcg_run;
typedef struct pcg_entity pcg_entity;
typedef struct pcg_shape pcg_shape;
typedef struct pcg_frame pcg_frame;
typedef struct pcg_packer pcg_packer;
typedef struct pcg_unpacker pcg_unpacker;

/* ---- status: what every kernel and every emitted function returns ---------------------------- */

/* Anything but PCG_OK unwinds to pcg_run_execute; what was wrong is on the run. A bad entity is no
 * failure: it is reported (pcg_warn) and dropped or passed on, and the kernel returns PCG_OK. */
enum {
    PCG_OK = 0,
    PCG_FAILED,     /* the run failed: a message with node, round and place is on the run */
    PCG_LIMIT,      /* a limit was hit */
    PCG_CANCELLED,  /* pcg_run_cancel was called */
    PCG_MISUSE      /* a call on the API that makes no sense: unknown parameter, wrong type */
};

/* ---- values ---------------------------------------------------------------------------------- */

typedef struct pcg_vec2 { double x, y; } pcg_vec2;
typedef struct pcg_vec3 { double x, y, z; } pcg_vec3;
typedef struct pcg_vec4 { double x, y, z, w; } pcg_vec4;
typedef struct pcg_color { double r, g, b, a; } pcg_color; /* sRGB as written, 0 … 1 */

/* One cell of storage: an attribute or a list element takes 1 cell, a vec2 2, a vec3 3, a vec4,
 * quaternion (x y z w) or color 4. Strings are NUL-terminated UTF-8, never NULL, and live as
 * long as the run. */
typedef union pcg_cell {
    pcg_int i;             /* bool, int, enumerations */
    double f;              /* float; in metres, square metres, degrees, 1 = 100 %, seconds */
    const char *s;         /* string, path */
    const struct pcg_list *list;
} pcg_cell;

typedef struct pcg_list { /* immutable, lives as long as the run */
    pcg_u32 count;         /* elements */
    pcg_u32 width;         /* cells an element */
    pcg_cell at[1];        /* count * width of them */
} pcg_list;

/* Kinds of value; the order is part of the ABI. Those behind PCG_ENUM are floats with a unit. */
enum {
    PCG_BOOL, PCG_INT, PCG_FLOAT, PCG_STRING, PCG_VEC2, PCG_VEC3, PCG_VEC4, PCG_COLOR,
    PCG_QUATERNION, PCG_PATH, PCG_LIST, PCG_ENUM,
    PCG_LENGTH, PCG_AREA, PCG_ANGLE, PCG_RATIO, PCG_SECONDS
};

/* A value of any kind: what a parameter of type `any` brings. Where the parameter stands behind
 * one of type `attribute`, the value has been converted to that attribute's kind. */
typedef struct pcg_any {
    int kind;
    pcg_cell cell[4];
} pcg_any;

/* ---- attributes ------------------------------------------------------------------------------ */

/* Where an attribute of the graph lives in its entities; what a node's own attribute is linked
 * to, and what a parameter of type `attribute` names. cell < 0: linked to nothing, writes go
 * nowhere. */
typedef struct pcg_slot {
    int cell;            /* absolute: the frame's base is in it */
    int kind;            /* PCG_INT … of the graph's attribute */
    const pcg_cell *initial; /* its default, as many cells as the kind takes */
    int element;         /* of a list: its elements' kind */
} pcg_slot;

/* The cells of an attribute, or NULL while it has its default. */
const pcg_cell *pcg_attribute(const pcg_entity *e, int cell);
/* As many cells as `kind` takes, to be filled by the caller; NULL when memory has run out (the run
 * knows, and its next round stops). */
pcg_cell *pcg_attribute_write(pcg_run *r, pcg_entity *e, int cell, int kind);
/* What kernels use. Conversions as in the language: int to float, any value to string. */
void pcg_set_bool(pcg_run *r, pcg_entity *e, const pcg_slot *s, int value);
void pcg_set_int(pcg_run *r, pcg_entity *e, const pcg_slot *s, pcg_int value);
void pcg_set_float(pcg_run *r, pcg_entity *e, const pcg_slot *s, double value);
void pcg_set_string(pcg_run *r, pcg_entity *e, const pcg_slot *s, const char *value);
/* `from` holds as many cells as the slot's kind takes. */
void pcg_set_cells(pcg_run *r, pcg_entity *e, const pcg_slot *s, const pcg_cell *from);
/* The attribute's cells, those of its default while it was not written. */
const pcg_cell *pcg_get(const pcg_entity *e, const pcg_slot *s);

/* ---- entities -------------------------------------------------------------------------------- */

typedef struct pcg_type {
    const char *name;
    const struct pcg_type *parent;             /* NULL for Entity */
    pcg_u32 size;                              /* of the struct that begins with a pcg_entity */
    /* Copies what lies behind the pcg_entity; may share. Status. */
    int (*copy)(pcg_run *r, pcg_entity *to, const pcg_entity *from);
    void (*drop)(pcg_run *r, pcg_entity *e);   /* gives up what lies behind the pcg_entity */
    /* Attributes from cell `base` on are to go from the entities that it holds (pcg_leave); NULL
     * where it holds none. Those of the types that it derives from are called besides. */
    void (*leave)(pcg_run *r, pcg_entity *e, pcg_u32 base);
    /* Writes what lies behind the pcg_entity down, and reads it into a zeroed one (parcel.h): what
     * caches keep and threads hand on. NULL: cannot be done, unless nothing lies there. Status. */
    int (*pack)(pcg_packer *p, const pcg_entity *e);
    int (*unpack)(pcg_unpacker *u, pcg_entity *e);
} pcg_type;

/* Spatial is what has a place: shapes and their parts; Faced what of it has faces: a shape, or one
 * face of it. */
extern const pcg_type pcg_type_entity, pcg_type_impulse, pcg_type_spatial, pcg_type_faced;
extern const pcg_type pcg_type_shape, pcg_type_face, pcg_type_edge, pcg_type_vertex;

/* What describes a node of the graph; static data of the emitted code. */
typedef struct pcg_node {
    const char *name;      /* its name, or the one that it is given in messages: split_2 */
    const char *procedure;
    const char *graph;     /* the graph that it stands in */
    const char *file;
    pcg_u32 line, column;
    pcg_u32 index;         /* of all nodes of the module */
    pcg_u64 key;           /* for random numbers: by its name, or by what it runs */
    int mixed;             /* a round may bring shapes along with their faces, edges or vertices */
} pcg_node;

struct pcg_entity {
    const pcg_type *type;
    struct pcg_attributes *attributes; /* shared until written; NULL: all at their defaults */
    const pcg_node *maker;             /* the node that made it; NULL: the host */
    pcg_u64 lineage;                   /* its line of descent, hashed: keys its random numbers */
    pcg_u32 references;
    pcg_u32 mark;                      /* for a kernel's own use within one call; 0 between calls */
};

/* ---- queues and ports ------------------------------------------------------------------------ */

typedef struct pcg_queue { /* entities at[head .. end-1] wait */
    pcg_entity **at;
    pcg_u32 head, end, capacity;
} pcg_queue;

typedef struct pcg_port {
    pcg_queue **to;  /* where its edges lead; the first takes the original, the others copies */
    pcg_u32 count;   /* 0: blocked, or nobody listens: what leaves is dropped. A kernel may ask */
    pcg_u32 index;   /* of all output ports of the module */
} pcg_port;

/* An input of a collective port for one call: the whole queue. The kernel consumes every entity. */
typedef struct pcg_entities {
    pcg_entity **at;
    pcg_u32 count;
} pcg_entities;

/* Appends; takes the reference over. PCG_FAILED when memory has run out. */
int pcg_queue_push(pcg_run *r, pcg_queue *q, pcg_entity *e);
/* What emitted code makes of a zeroed port: its number, and the queues that it leads to. */
void pcg_port_lead(pcg_port *p, pcg_u32 index, pcg_queue **to, pcg_u32 count);

/* What a graph knows of itself, where a node of it has the trait `reflects`. */
typedef struct pcg_graph_info {
    const char *name;
    const struct pcg_parameter_info *parameters;
    pcg_u32 parameter_count;
    const char *attributes;    /* name and type in turn, each behind its \n; and so below: */
    const char *nodes;         /* name and what it runs */
    const char *edges;         /* "split.base -> extrude.in" and what travels along it */
    /* A parameter was changed: evaluates again what depends on parameters, constants and arguments;
     * but neither defaults nor which edges are open. Status. */
    int (*change)(pcg_frame *f);
} pcg_graph_info;

/* ---- frames and calls ------------------------------------------------------------------------ */

/* One instance of a graph: the head of the struct that emitted code declares for it. */
struct pcg_frame {
    pcg_run *run;
    struct pcg_frame *parent;  /* NULL for the main graph */
    pcg_u64 key;               /* from the seed and the nodes on the way here */
    pcg_u64 lineage;           /* of the entity that this execution is for */
    pcg_u32 base;              /* first attribute cell that is this graph's own */
    pcg_u32 depth;
    struct pcg_pool *pool;     /* what is kept by key; NULL: nothing so far */
    const pcg_graph_info *about; /* NULL unless a node asks for it */
    struct pcg_loaded *loaded; /* the module that the graph's code and tables are of */
    pcg_u64 *sent, *worked;    /* that module's counters: by output port, by node */
};

/* What a node keeps between its rounds: the head of every procedure's struct. */
typedef struct pcg_instance {
    void *state;      /* a stateful procedure's own, from pcg_alloc; NULL at first */
    pcg_u64 rounds;   /* run so far */
} pcg_instance;

/* What the struct of every graph begins with. */
typedef struct pcg_graph {
    pcg_frame frame;
    pcg_instance own;          /* of expressions that belong to no node */
    const pcg_entity *impulse; /* what its sources descend from, or NULL */
} pcg_graph;

/* One activation of a node: what a kernel is handed next to its struct. */
typedef struct pcg_call {
    pcg_run *run;
    const pcg_node *node;
    pcg_instance *instance;
    pcg_u64 key;       /* node and frame: half of the key of its random numbers */
    pcg_u64 lineage;   /* of this round's first entity (in a source of the frame): the other half */
    pcg_u64 round;     /* from 1 */
    pcg_u32 made;      /* entities made in this round */
    const pcg_entity *first; /* this round's first, or NULL; borrowed: gone once it was consumed */
    pcg_frame *frame;  /* of the graph that the node stands in */
    pcg_u64 *sent;     /* the frame's */
} pcg_call;

/* Zeroed frame of `size` bytes for the graph that `node` of `parent` encapsulates; NULL (and the
 * run knows why) when memory or the depth limit is passed. It lives as long as the run. `cells`:
 * attribute cells of the parent graph. */
pcg_frame *pcg_frame_new(pcg_frame *parent, const pcg_node *node, pcg_u32 size, pcg_u32 cells);
void pcg_begin(pcg_call *c, pcg_frame *f, const pcg_node *node, pcg_instance *i);
/* Begins a round: counts it, checks limits and cancellation. `first`: the round's first entity,
 * or NULL. Status. */
int pcg_round(pcg_call *c, const pcg_entity *first);
/* Sends an entity out; takes the reference over. Whatever leaves an output port goes through
 * here: the run counts it, and says at its end where nothing came. Status. */
int pcg_emit(pcg_call *c, const pcg_port *p, pcg_entity *e);
/* Empties an input queue of `node` when an execution of its graph is done: what waits there was
 * never taken, because another input of the node had nothing. It is dropped, counted, and
 * reported at the end of the run. Emitted code calls it for the queues of nodes with several
 * inputs (cheap when empty). */
void pcg_queue_clear(pcg_frame *f, const pcg_node *node, const char *input, pcg_queue *q);
/* A flow: nodes that take a batch of entities at a time, and hand it on. What is told from one begin
 * to the end is put in the order in which it would have been told node by node; `turn` says which
 * node's turn it is, by its place in that order. */
void pcg_flow_begin(pcg_frame *f);
void pcg_flow_turn(pcg_frame *f, pcg_u32 rank);
void pcg_flow_end(pcg_frame *f);
/* How many of the entities that wait may be taken at a time: PCG_FLOW_ALL, or a number that suits
 * the cache. It is all where some of them are seen from elsewhere, too, or hold others. */
pcg_u32 pcg_flow_batch(const pcg_frame *f, const pcg_queue *q);
#define PCG_FLOW_ALL 0
/* An execution of an encapsulated graph is done: its pool, which there must be, is emptied. */
void pcg_pool_end(pcg_frame *f);
/* An entity enters an encapsulated graph: what it carries from cell `base` on goes now, and where
 * others hold it too, or it holds others, once more when the execution is done. Status. */
int pcg_enter(pcg_frame *f, pcg_entity *e, pcg_u32 base);
/* An entity leaves an encapsulated graph: attributes from cell `base` on are removed, from what it
 * holds, too. */
void pcg_leave(pcg_run *r, pcg_entity *e, pcg_u32 base);

/* ---- what kernels use ------------------------------------------------------------------------ */

/* A new entity of a type, descending from `ancestor` (NULL: from the round's first entity, which
 * must still be held then, or from the frame where the round has none): it inherits its
 * attributes. NULL when memory or the entity limit is passed. The caller owns the one reference. */
pcg_entity *pcg_entity_new(pcg_call *c, const pcg_type *type, const pcg_entity *ancestor);
/* A copy with everything it holds (shared until changed); `which` tells the copies of one entity
 * apart. */
pcg_entity *pcg_entity_copy(pcg_run *r, const pcg_entity *e, pcg_u64 which);
pcg_entity *pcg_entity_hold(pcg_entity *e); /* one more reference */
void pcg_entity_drop(pcg_run *r, pcg_entity *e);
/* Whether it is of that type, or of one that derives from it. */
int pcg_entity_is(const pcg_entity *e, const pcg_type *type);

/* Memory of the run: zeroed, 16-aligned, freed with the run. NULL when the limit is passed. */
void *pcg_alloc(pcg_run *r, pcg_u64 size);
const char *pcg_string(pcg_run *r, const char *s); /* the run's own, interned copy */
const char *pcg_format(pcg_run *r, const char *format, ...);
/* The i-th random number of call site `site` in this round, in [0, 1). */
double pcg_random(const pcg_call *c, pcg_u32 site, pcg_u64 i);
pcg_u64 pcg_mix(pcg_u64 a, pcg_u64 b); /* a hash of two words */

/* A message about this round. pcg_warn returns PCG_OK, or PCG_FAILED under --strict; pcg_fail
 * returns PCG_FAILED; pcg_note is for `log` and its like. */
int pcg_warn(pcg_call *c, const char *format, ...);
/* As pcg_warn, but what a node has said once is not said again in the run. */
int pcg_warn_once(pcg_call *c, const char *format, ...);
int pcg_fail(pcg_call *c, const char *format, ...);
void pcg_note(pcg_call *c, const char *format, ...);
/* Properties of the run's result as a whole, which are written out with it: "origin.latitude" is
 * where on Earth its origin is. A key is two words with a point between them, its kind one that
 * takes one cell and is no list and no enumeration. Setting one again changes it. Status. */
int pcg_property_set(pcg_call *c, const char *key, int kind, const pcg_cell *value);
/* NULL where there is none, or one of another kind. */
const pcg_cell *pcg_property_get(const pcg_run *r, const char *key, int kind);
/* For loops that can take long: cheap; not PCG_OK once the run is cancelled or out of time. */
int pcg_tick(pcg_call *c);
/* A file name of the graph's, made absolute: relative ones are looked up beside the .pcg file, and
 * where nothing is there, beside the .so or the executable that was made of it. */
const char *pcg_path(pcg_call *c, const char *path);

/* ---- what emitted C uses: expressions -------------------------------------------------------- */

/* Returns from the function with whatever is not PCG_OK. */
#define PCG_TRY(status)                                                                            \
    do {                                                                                           \
        int pcg_status_ = (status);                                                                \
        if (pcg_status_ != PCG_OK)                                                                 \
            return pcg_status_;                                                                    \
    } while (0)
/* Whether something waits in a queue, and the entity that has waited longest. */
#define PCG_READY(queue) ((queue).head < (queue).end)
#define PCG_TAKE(queue) ((queue).at[(queue).head++])
/* The language's integers wrap around. */
#define PCG_INT_ADD(a, b) ((pcg_int)((pcg_u64)(a) + (pcg_u64)(b)))
#define PCG_INT_SUBTRACT(a, b) ((pcg_int)((pcg_u64)(a) - (pcg_u64)(b)))
#define PCG_INT_MULTIPLY(a, b) ((pcg_int)((pcg_u64)(a) * (pcg_u64)(b)))
#define PCG_INFINITY (1e308 * 10.0)
#define PCG_NAN (PCG_INFINITY - PCG_INFINITY)

/* Rounded to zero. By zero: the run fails, and its status is returned. */
int pcg_int_divide(pcg_call *c, pcg_int a, pcg_int b, pcg_int *result);
int pcg_int_remainder(pcg_call *c, pcg_int a, pcg_int b, pcg_int *result);
/* By 0 … 63, else the run fails. To the right the sign comes in. */
int pcg_int_shift_left(pcg_call *c, pcg_int a, pcg_int by, pcg_int *result);
int pcg_int_shift_right(pcg_call *c, pcg_int a, pcg_int by, pcg_int *result);
/* Below 0, 0 or above 0 as `a` comes before, is, or comes behind `b`, by their bytes. */
int pcg_string_compare(const char *a, const char *b);
/* One string behind the other; the run's own. "" where memory has run out, which ends the run. */
const char *pcg_string_join(pcg_run *r, const char *a, const char *b);
/* A value as the language converts it to a string; the run's own. `element`: of a list its
 * elements' kind. `enumerators`: of an enumeration, or of a list's, their names separated by \n;
 * else NULL. "" where memory has run out. */
const char *pcg_text(pcg_run *r, const pcg_cell *at, int kind, int element,
                     const char *enumerators);
/* A zeroed list of the run's; NULL where memory has run out. */
pcg_list *pcg_list_new(pcg_run *r, pcg_u32 count, pcg_u32 width);
/* Whether two lists of elements of that kind are equal. */
int pcg_list_equal(const pcg_list *a, const pcg_list *b, int kind);

/* What a parameter demands of its values. */
typedef struct pcg_constraint_info {
    int kind;                  /* 0 range: low, high; 1 one of; 2 matches: text; 3 at most: high */
    double low, high;
    const char *text;          /* the regex; of `one of` the values as text, separated by \n */
} pcg_constraint_info;
/* Whether an argument is as its parameter demands; where it is not, the run fails. Status. The kinds
 * are pcg_text's. */
int pcg_constrain(pcg_call *c, const char *parameter, const pcg_constraint_info *demand,
                  const pcg_cell *at, int kind, int element, const char *enumerators);

/* ---- observed form: emitted only where a run is to be watched -------------------------------- */

/* How a parameter lies in a struct: as its cells; as an int; as a pcg_any; or not as a value. */
enum { PCG_SEEN_CELLS, PCG_SEEN_INT, PCG_SEEN_ANY, PCG_SEEN_NAME };
typedef struct pcg_seen_parameter {
    const char *name, *type;
    const char *enumerators;   /* of an enumeration, separated by \n; else NULL */
    const char *text;          /* of PCG_SEEN_NAME: what it was given; else NULL */
    int kind, element, storage;
    pcg_u32 offset;            /* in the struct that pcg_round_seen is handed */
} pcg_seen_parameter;
typedef struct pcg_seen_queue {
    const pcg_node *node;      /* that the queue waits before; of a leaf port, that it comes from */
    const char *port;
    pcg_u32 offset;            /* in the frame */
    int leaf;
} pcg_seen_queue;
typedef struct pcg_seen_graph { /* what there is to see of a graph while it runs */
    const char *name;
    const pcg_seen_queue *queues; /* by offset */
    const struct pcg_attribute_info *attributes;
    pcg_u32 queue_count, attribute_count;
    pcg_u32 form;              /* its number among the forms of graphs in the emitted text */
} pcg_seen_graph;
typedef struct pcg_seen {      /* what there is to see of a node's rounds */
    const pcg_seen_graph *graph; /* that the node stands in */
    const char *const *inputs;
    const pcg_seen_parameter *parameters;
    pcg_u32 input_count, parameter_count;
} pcg_seen;
/* A round has its entities and parameters and is about to run; it is done, with what it sent. */
void pcg_round_seen(pcg_call *c, const pcg_seen *about, const void *self,
                    const pcg_entities *inputs);
void pcg_round_over(pcg_call *c);

/* ---- module: a compiled graph ---------------------------------------------------------------- */

typedef struct pcg_parameter_info {
    const char *name, *document;
    const char *type;          /* as the language writes it: length, Axis, list<int> */
    const char *initial;       /* its default as text */
    const char *enumerators;   /* of an enumeration, separated by \n; NULL */
    const pcg_constraint_info *constraints;
    pcg_u32 constraint_count;
    int kind;                  /* PCG_FLOAT … */
    int element;               /* of a list: its elements' kind */
    int hidden;
    pcg_u32 offset;            /* of its cells in the frame */
    pcg_u32 given;             /* offset of the byte that says that the host set it */
} pcg_parameter_info;

typedef struct pcg_attribute_info {
    const char *name, *document;
    const char *type;
    const char *enumerators;
    int kind, element;
    pcg_u32 cell;              /* in the main graph */
    pcg_u32 initial;           /* offset of its default's cells in the frame, once it runs */
} pcg_attribute_info;

typedef struct pcg_port_info { /* a gate, or a leaf port of the main graph: "node.port" */
    const char *name, *document;
    const char *type;          /* Shape */
    const char *bases;         /* that type and those that it derives from, separated by \n */
    int collective;
    pcg_u32 queue;             /* offset of its pcg_queue in the frame */
    pcg_u32 given;             /* inputs: offset of the byte that says that the host fed it */
} pcg_port_info;

/* An edge from an output port, by pcg_port.index, to a node: for "received nothing". */
typedef struct pcg_edge_info { pcg_u32 port, node; } pcg_edge_info;
/* An output port, by pcg_port.index. */
typedef struct pcg_output_info { pcg_u32 node; const char *name; } pcg_output_info;

/* A kernel of a library that is not built in. It is looked up by its name when the program is made;
 * `layout` tells whether its struct, or prototype, is still the one that it is called with. */
typedef struct pcg_kernel_info {
    const char *library, *symbol;
    pcg_u64 layout;
} pcg_kernel_info;

typedef void pcg_code(void); /* cast to the kernel's own type before it is called */
/* The kernel that the module lists under that number, never NULL. */
pcg_code *pcg_kernel(const pcg_frame *f, pcg_u32 number);
#define PCG_KERNEL(type, call, number) ((type *)pcg_kernel((call)->frame, number))

/* A .so exports its module as the object PCG_MODULE_SYMBOL: `const pcg_module pcg_compiled`. */
#define PCG_MODULE_SYMBOL "pcg_compiled"
typedef struct pcg_module {
    pcg_u32 abi, size;         /* PCG_ABI, sizeof(pcg_module) */
    const char *name, *document, *version; /* version: of the compiler that emitted it */
    const char *folder;        /* where relative paths are looked up: the .pcg file's, or "" */
    const pcg_parameter_info *parameters;
    const pcg_port_info *inputs, *outputs; /* outputs: gates first, then leaf ports */
    const pcg_attribute_info *attributes;
    const pcg_node *nodes;     /* of every graph in the module, by index */
    const pcg_output_info *ports;
    const pcg_edge_info *edges;
    const pcg_kernel_info *kernels; /* of libraries that are not built in */
    pcg_u32 parameter_count, input_count, output_count, attribute_count;
    pcg_u32 node_count, port_count, edge_count, kernel_count;
    pcg_u32 gate_count;        /* how many of the outputs are gates */
    pcg_u32 frame_size;
    const char *digest;        /* of the text of the graph and of all that it encapsulates */
    const char *tied;          /* why one execution may depend on another: "'n' keeps state"; NULL */
    pcg_u32 loads;             /* a name that is computed says what more it runs */
    int (*start)(pcg_frame *f); /* fills in what the host did not give; defaults of attributes */
    int (*restart)(pcg_frame *f); /* the same for another execution in a frame that was started */
    int (*run)(pcg_frame *f);
} pcg_module;

/* ---- surrogates: nodes that run a graph that is chosen in each round ------------------------- */

/* A port, parameter or attribute that a surrogate's braces declare. */
typedef struct pcg_declared {
    const char *name, *type;
    const char *bases;         /* of a port, as in pcg_port_info; NULL */
    pcg_u32 line;              /* in the node's file */
} pcg_declared;

/* A graph in the scope of the surrogate's file. */
typedef struct pcg_candidate {
    const char *name;
    const pcg_module *module;
} pcg_candidate;

/* loop out -> in, by the numbers of the ports. */
typedef struct pcg_loop { pcg_u32 from, to; } pcg_loop;

enum { PCG_SURROGATE_DYNAMIC, PCG_SURROGATE_ITERATE, PCG_SURROGATE_PARALLEL, PCG_SURROGATE_CACHE,
       PCG_SURROGATE_PROFILE };
#define PCG_NO_REST 0xFFFFFFFFu

/* What is known of a surrogate when it is compiled. */
typedef struct pcg_surrogate_info {
    int kind;                  /* PCG_SURROGATE_DYNAMIC … */
    pcg_u32 cells;             /* of the attributes of the graph that it stands in */
    const pcg_declared *inputs, *outputs, *parameters, *attributes;
    const pcg_candidate *candidates;
    const pcg_loop *loops;
    pcg_u32 input_count, output_count, parameter_count, attribute_count;
    pcg_u32 candidate_count, loop_count;
    pcg_u32 rest;              /* the output that takes what has no port of its own; PCG_NO_REST */
    const char *way;           /* from the main file's folder to that of the surrogate's file */
    const char *before, *behind; /* what makes a graph of a procedure's name between them */
} pcg_surrogate_info;

/* The head of a surrogate's struct. */
typedef struct pcg_surrogate {
    pcg_instance instance;
    const pcg_surrogate_info *info;
    const pcg_port **outputs;  /* as declared */
    const pcg_slot **links;    /* by declared attribute: what it is linked to; NULL: nothing */
    struct pcg_choice *choice; /* what this round runs */
    struct pcg_choices *choices; /* what it has run so far; NULL: nothing */
    pcg_u32 execution;         /* of the graph that it stands in, counted */
    int each_round;            /* what it hands over may be another in each round */
    pcg_int times;             /* of iterate */
    const char *index;
    pcg_int threads;           /* of parallel; 0: as many as there are */
    pcg_int where;             /* of cache: 0 memory, 1 disk */
    struct pcg_batch *batch;   /* of parallel: what waits to be run; NULL: nothing so far */
} pcg_surrogate;

/* One round, in this order. Finds, or loads, the graph of that name and looks whether it is as was
 * declared; its frame is made when it is first chosen, and kept. Status. */
int pcg_surrogate_choose(pcg_call *c, pcg_surrogate *s, const char *name);
/* Gives a declared parameter its value. Status. */
int pcg_surrogate_set(pcg_call *c, pcg_surrogate *s, pcg_u32 parameter, const pcg_cell *value);
/* An entity is about to enter, as pcg_enter says. Status. */
int pcg_surrogate_admit(pcg_call *c, pcg_surrogate *s, pcg_entity *e);
/* Hands a declared attribute in with an entity. */
void pcg_surrogate_hand_in(pcg_call *c, pcg_surrogate *s, pcg_u32 attribute, pcg_entity *e,
                           const pcg_cell *value);
/* Takes the reference over. Status. */
int pcg_surrogate_enter(pcg_call *c, pcg_surrogate *s, pcg_u32 input, pcg_entity *e);
/* Runs the graph, and sends what came out of it on. `impulse`: what its sources descend from, or
 * NULL. Status. */
int pcg_surrogate_run(pcg_call *c, pcg_surrogate *s, const pcg_entity *impulse);
/* Behind the last round of an activation of `parallel`, whose rounds may have been put off: runs
 * them, and sends what came out of them on in their order. Status. */
int pcg_surrogate_finish(pcg_call *c, pcg_surrogate *s);

#endif

/* emit.h - what the files of the pass `emit` share.
 *
 * emit.c assembles the text; emit_names.c gives everything its name in C; emit_value.c compiles
 * expressions, emit_type.c knows what they are made of; emit_frame.c writes the structs,
 * emit_wire.c what is filled into them when a frame is made, emit_start.c when an execution starts;
 * emit_node.c writes the functions of nodes, emit_inner.c those of encapsulated graphs,
 * emit_surrogate.c those of surrogates, emit_run.c those that run a graph, emit_flow.c those that
 * run nodes a few entities at a time; emit_module.c writes the
 * tables, emit_reflect.c those that a graph itself asks.
 */
#ifndef PCG_COMPILER_EMIT_H
#define PCG_COMPILER_EMIT_H

#include "evaluate.h"
#include "types.h"

enum {
    EMIT_PART_NODES = 64,      /* larger graphs have their nodes' structs in parts of so many */
    EMIT_FUNCTION_ITEMS = 128, /* a generated function holds no more, where that can be helped */
    EMIT_OPERAND_LENGTH = 120, /* a longer C expression goes into a variable */
    EMIT_MOST_ON_STACK = 32,   /* longer lists of arguments are the run's memory */
    EMIT_MAX_VARIABLES = 4096, /* of what belongs together: they must fit on the stack */
    EMIT_SERIES_VARIABLES = 512 /* of a function that ends behind the item with that one */
};

/* ---- names ----------------------------------------------------------------------------------- */

typedef struct node_names {
    const char *field;       /* where its struct is in the graph's: "roof", "part_2.roof" */
    const char **inputs;     /* queues, and variables for their entities: in_wall */
    const char **outputs;    /* ports: out_top */
    const char **leads;      /* the array that a port's edges are in: to_top */
    uint32_t first_port;     /* pcg_port.index of its first output */
    uint32_t first_leaf;     /* leaf ports of the graph, as the main one, before its own */
    uint32_t first_gathered; /* ports whose entities an aggregative gate takes, before its own */
} node_names;

/* What both forms of a graph share. */
typedef struct emit_graph {
    const graph *graph;
    const char **parameters, **constants, **attributes; /* fields, by index */
    node_names *nodes;       /* by node->index */
    uint32_t first_node;     /* pcg_node.index of its first node; its own is behind its last */
    uint32_t leaf_count, gathered_count;
    const node *gathering;   /* the aggregative gate; NULL */
} emit_graph;

/* A graph as it is emitted: as the main one, or encapsulated. */
typedef struct form {
    const emit_graph *names;
    const graph *graph;
    bool main;
    const char *tag;         /* of its struct, and what its functions begin with: graph_house */
    const char **functions;  /* by node->index: node's struct, and function: graph_house_roof */
    const char *wire, *start, *run; /* its own functions */
    /* What it knows of itself, and what follows a change of a parameter; or NULL. */
    const char *about, *change;
} form;

/* ---- the emitter ----------------------------------------------------------------------------- */

typedef struct emitter {
    compilation *c;
    const program *p;
    const emit_options *options;
    arena *arena;
    text *out;               /* where lines go */
    uint32_t depth;          /* their indentation */
    text scratch;            /* of emit_name; this one and the next two are used again and again */
    text part;               /* of a series */
    text block;              /* of a node in one */
    table globals;           /* names at file scope */
    emit_graph *graphs;      /* by graph->index */
    form *main;              /* the main graph as such */
    form **encapsulated;     /* by graph->index; NULL where the graph is not */
    form **candidates;       /* what surrogates may choose, as main graphs; NULL where they cannot */
    const char *module;      /* that is being written: what its tables begin with */
    LIST(form *) forms;      /* in the order in which they are written */
    uint32_t node_count, port_count, edge_count;
    LIST(pcg_kernel_info) kernels; /* of libraries that are not built in */
    table kernel_numbers;    /* uint32_t, by symbol: their places in that list */

    /* where it is */
    bool *apart;             /* by graph->index: nothing outside sees that it ran; NULL at first */
    const form *form;
    struct flow_place *flow; /* by rank: where nodes stand in flows */
    const node *node;        /* NULL: in what belongs to the graph */
    const span *place;       /* that lines stem from; NULL: from nowhere */
    const char *call;        /* C expression of type pcg_call * */
    const char **entities;   /* by index of the input: the variable with the round's entity */
    uint32_t variables;      /* t1, t2, … of the function so far */
    bool uses_call;          /* something was emitted that needs `call` */
} emitter;

/* What is written before the parenthesis to call a kernel: its symbol; or, where its library is not
 * built in, an expression that needs `call`. Its own string. */
const char *emit_kernel_name(emitter *e, const char *symbol, const char *call);

/* ---- lines (emit.c) -------------------------------------------------------------------------- */

/* One line, indented. Of printf's formats %s, %u, %d and %lld are known. */
void emit_line(emitter *e, const char *format, ...) PRINTF_LIKE(2, 3);
void emit_blank(emitter *e);
/* "… {", or "{" alone, and what follows deeper; the brace that closes it, with what stands
 * behind it. */
void emit_block(emitter *e);
void emit_open(emitter *e, const char *format, ...) PRINTF_LIKE(2, 3);
void emit_close(emitter *e, const char *behind);
/* What comes next stems from that place of the source, until the next of these; `place` NULL:
 * from nowhere. */
void emit_place(emitter *e, const span *place);
/* A comment on one line, whatever stands in the words. */
void emit_comment(emitter *e, const char *words);
/* One that holds a node's source, cut where it is long. */
void emit_node_comment(emitter *e, const node *n);
/* Redirects lines to a text of its own, and back. */
text *emit_capture(emitter *e, text *into);
void emit_restore(emitter *e, text *back, const text *captured);
char *emit_name(emitter *e, const char *format, ...) PRINTF_LIKE(2, 3); /* the same formats */

/* ---- names (emit_names.c) -------------------------------------------------------------------- */

/* Decides on the forms and names everything. */
void emit_names(emitter *e);
/* A name that is not yet in `taken`, like the one that is wished for; enters it. */
const char *emit_unique(arena *a, table *taken, const char *wish);
static inline const node_names *names_of(const emitter *e, const node *n)
{
    return &e->form->names->nodes[n->index];
}
/* &pcg_nodes[12]: of a node, or of the graph itself where `n` is NULL. */
const char *emit_node_reference(emitter *e, const node *n);
/* g->roof */
const char *emit_node_path(emitter *e, const node *n);
/* g->roof.in_wall: the queue at an input. */
const char *emit_queue(emitter *e, const port *input);

/* The byte in g->fed that says that the host fed an input gate. */
static inline const char *emit_fed(const emitter *e, const node *gate)
{
    return names_of(e, gate)->inputs[0];
}

/* Whether a node takes part in this form: stand-ins do not in an encapsulated one. */
bool emit_takes_part(const emitter *e, const node *n);
/* Whether what leaves an output port while no edge is open comes out of the main graph. */
bool emit_is_leaf(const emitter *e, const port *p);
/* How many there are of these; the number of one among them. */
uint32_t emit_leaf_count(const emitter *e);
uint32_t emit_leaf_number(const emitter *e, const port *p);
/* Whether some edge from the port is always open. */
bool emit_has_open_edge(const port *p);

/* ---- types and literals (emit_type.c) -------------------------------------------------------- */

const char *emit_c_type(emitter *e, const type *t); /* "const char *", "double " */
/* The same for a parameter in the frame, which is as wide as its cells. */
const char *emit_storage_type(emitter *e, const type *t);
bool emit_is_composite(const type *t);                 /* a struct in C */
const char *emit_component(const type *t, uint32_t i); /* x, or r */
const char *emit_cell_member(const type *t);           /* of pcg_cell: i, f, s or list */
const char *emit_kind(const type *t);                  /* PCG_LENGTH */
const char *emit_float(emitter *e, double number);
const char *emit_int(emitter *e, pcg_int number);
const char *emit_string(emitter *e, const char *s);    /* a C literal; 0 for NULL */
/* The names of an enumeration (or of a list's) separated by \n, as a C literal; 0 where there
 * are none. */
const char *emit_enumerators(emitter *e, const type *t);
bool emit_is_shape(const type *t, const procedure *of); /* its C type is pcg_shape * */
bool emit_is_part(const type *t); /* of a port: a face, edge or vertex of a shape */

/* ---- expressions (emit_value.c) -------------------------------------------------------------- */

typedef struct operand {
    const char *text; /* a C expression without side effects */
    bool atomic;      /* needs no parentheses inside another one */
} operand;

/* Emits the statements that the value needs, and says what then stands for it. A composite is
 * always an lvalue. */
operand emit_value(emitter *e, const value *v);
/* to = value; whatever the type is. `keeps_kind`: of `any`, an enumerator or a list goes as it
 * is, not as text. */
void emit_assign(emitter *e, const char *to, const type *t, const value *v, bool keeps_kind);
/* to[0] = …, as many cells as it takes. */
void emit_cells(emitter *e, const char *to, const value *v);
/* Whether it is the same in every execution, and needs nothing of the frame. */
bool emit_is_fixed(const value *v);
static inline bool emit_is_per_round(const value *v)
{
    return v->reads_entity || v->reads_chance;
}
/* Cells as a value of another type, where they differ: from one attribute to another that it is
 * linked to. */
void emit_convert_cells(emitter *e, const char *to, const type *to_type, const char *from,
                        const type *from_type);
/* Checks an argument for a parameter of type `t` that was not known when it was checked; `at` is what
 * holds it. */
void emit_constraints(emitter *e, const char *name, const pcg_constraint_info *constraints,
                      uint32_t count, const type *t, const value *v, const char *at);

/* ---- nodes (emit_node.c, emit_inner.c) ------------------------------------------------------- */

/* The functions that run e->node: of a procedure, a gate; of an encapsulated graph. */
void emit_node(emitter *e);
void emit_inner(emitter *e);
void emit_surrogate(emitter *e);
/* Over the candidates of a surrogate: the graph that it names, or all of its file. Starts at *next = 0;
 * NULL at the end. `name` (may be NULL) is what it is called there. */
const graph *emit_candidate(const node *n, uint32_t *next, const char **name);
/* The tables that describe the surrogates of a form. */
void emit_surrogate_tables(emitter *e);
void emit_surrogate_fields(emitter *e, const node *n); /* of the node's struct */
void emit_surrogate_wire(emitter *e, const node *n);
/* The types that one derives from, itself first, as pcg_port_info.bases holds them. */
const char *emit_bases(emitter *e, const type *t);
/* "static int name(struct graph_house *g, …)", the brace, and `n`, the node's struct. */
void emit_node_open(emitter *e, const char *name, const char *parameters);
/* Returns where nothing can be done, else begins the node's call. */
void emit_begin(emitter *e);
/* Takes the entities of a round from the queues, begins the round and hands them to the kernel's
 * struct. */
void emit_take(emitter *e);
/* The same without handing them to anything: e->entities names them; of a collective input the first
 * that waits, where it is read. */
void emit_take_entities(emitter *e, const node *n);
/* The same for a source's impulse; `reads`: something is going to read it. Gives it up once the
 * round is done. */
void emit_take_impulse(emitter *e, const port *impulse, bool reads);
void emit_drop_impulse(emitter *e, const port *impulse);
/* The field of the kernel's struct that an input is handed in by. */
const char *emit_input_field(emitter *e, const port *p);
/* Closes the loop over the rounds of e->node. */
void emit_again(emitter *e);
/* The condition that all inputs have something, over `n`. */
const char *emit_ready(emitter *e, const node *n);
/* Where a node's pcg_instance is in its `self`. */
const char *emit_instance(const node *n);
bool emit_is_collective(const node *n);
/* The implicit input of a node that is a source otherwise; NULL. */
const port *emit_impulse(const node *n);
/* It is a source, or becomes one while nothing may lead to its impulse. */
bool emit_may_run_once(const node *n);
/* An edge leads to the input from the node itself. */
bool emit_feeds_itself(const port *input);

/* Its arguments that `wanted` holds of are filled in; whether there are any. */
void emit_arguments(emitter *e, bool (*wanted)(const value *v));
bool emit_has_arguments(const node *n, bool (*wanted)(const value *v));

/* emit_seen.c: of the observed form; in the normal one they write nothing. What there is to see of
 * e->node's rounds, as tables; the statements that tell of a round, once `self` (a pointer) is
 * filled in; and of its end. */
void emit_seen_graph(emitter *e); /* a table of the form's queues and attributes */
void emit_seen_tables(emitter *e);
void emit_seen(emitter *e, const char *self);
void emit_seen_end(emitter *e);

/* emit_condition.c: what evaluates emit_options.condition; nothing where there is none. */
#define EMIT_CONDITION_SYMBOL "pcg_condition"
void emit_condition_functions(emitter *e);

/* ---- graphs ---------------------------------------------------------------------------------- */

void emit_frames(emitter *e); /* emit_frame.c: the structs of its nodes, and its own */
void emit_wire(emitter *e);   /* emit_wire.c: a new frame */
/* Whether what is behind a port is known only when an execution starts. */
bool emit_is_dynamic(const port *p);
/* The queue that takes what leaves a port while no edge is open; NULL where it is dropped. */
const char *emit_spare_queue(emitter *e, const port *p);
void emit_start(emitter *e);  /* emit_start.c: what is the same in every round of an execution */
void emit_change(emitter *e); /* the part of it that follows a change of a parameter */
/* emit_reflect.c: whether a node of the graph has the trait `reflects`; the table that it asks,
 * behind the structs. */
bool emit_reflects(const graph *g);
void emit_about(emitter *e);
/* The table `<prefix>_parameters` of the form's graph, where it has any. */
void emit_parameter_table(emitter *e, const char *prefix);
/* The same of its attributes: `<prefix>_attributes`. */
void emit_attribute_table(emitter *e, const char *prefix);
void emit_run(emitter *e);    /* emit_run.c: its nodes in order */
/* emit_flow.c: finds the flows of a form; whether a node is in one: its function then has a
 * parameter `most`, how many rounds to run (0: all); the functions that run flows, and the call of
 * the one that begins with a node: the rank of the last node that is run. */
void emit_find_flows(emitter *e);
bool emit_in_flow(const emitter *e, const node *n);
void emit_flow_functions(emitter *e);
uint32_t emit_flow(emitter *e, const node *n);
void emit_node_table(emitter *e); /* emit_module.c */
/* What all modules of the text share, and the modules of graphs that surrogates may choose. */
void emit_tables(emitter *e);
void emit_module(emitter *e);

/* ---- long functions (emit.c) ----------------------------------------------------------------- */

/* A function of statements that are given one by one; beyond EMIT_FUNCTION_ITEMS it becomes
 * name_1, name_2, … and one that calls these. libtcc gives every variable of a function a place
 * of its own on the stack. */
typedef struct series {
    const char *name;
    bool fails;               /* returns a status, else nothing */
    LIST(const char *) parts; /* the functions behind it, once there are several */
    uint32_t items;           /* of the present one */
    text *outer;
} series;

void emit_series_begin(emitter *e, series *s);
/* What follows counts as so many items; it is kept together. */
void emit_series_item(emitter *e, series *s, uint32_t items);
void emit_series_end(emitter *e, series *s);

#endif

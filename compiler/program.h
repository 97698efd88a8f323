/* program.h - the program that the passes hand on: what the tree means.
 *
 * resolve makes it from the trees (files, graphs, nodes, ports, edges: every name bound), check
 * fills in types, typed expressions and links, order numbers the nodes and finds the cyclic
 * edges and regions, emit reads it. Everything lives in the compilation's arena. Lists keep the
 * order of appearance. */
#ifndef PCG_PROGRAM_H
#define PCG_PROGRAM_H

#include "../interface/interface.h"
#include "../runtime/abi.h"

/* ---- types ----------------------------------------------------------------------------------- */

typedef struct enumeration {
    const char *name, *library;
    const tree_enumeration *tree;
    const char **names; /* enumerators; their values are 0, 1, … */
    uint32_t count;
} enumeration;

typedef struct entity_type {
    const char *name, *library;
    const struct entity_type *parent; /* NULL for Entity */
} entity_type;

typedef enum type_kind {
    TYPE_ERROR,     /* something was wrong and was reported; goes with everything */
    TYPE_VALUE,     /* .value: PCG_BOOL …; .enumeration of PCG_ENUM, .element of PCG_LIST */
    TYPE_ENTITY,    /* .entity */
    TYPE_ATTRIBUTE, /* a parameter that names an attribute of the graph */
    TYPE_ANY,       /* a parameter that takes a value of any kind */
    TYPE_VARIABLE   /* T: Entity of a generic procedure, .variable; gone once check is done */
} type_kind;

typedef struct type {
    type_kind kind;
    int value;
    const enumeration *enumeration;
    const struct type *element;
    const entity_type *entity;
    uint32_t variable;
} type;

/* ---- procedures and functions: interfaces, understood ---------------------------------------- */

typedef struct formal {          /* a parameter of a procedure, augmentation, function or graph */
    const char *name;
    const tree_parameter *tree;
    type type;
    bool collective;             /* any[]: takes all remaining arguments; only a function's last */
    bool checked;                /* the three below stand */
    struct value *initial;       /* its default; NULL: an argument must be given */
    const pcg_constraint_info *constraints;
    uint32_t constraint_count;
} formal;

typedef struct formal_port {
    const char *name;
    const tree_gate *tree;
    type type;                   /* may be TYPE_VARIABLE */
    bool collective, optional;
} formal_port;

typedef struct augment {
    const char *name;
    const tree_augment *tree;
    uint32_t kind;               /* its number within the procedure */
    formal *parameters, *attributes;
    uint32_t parameter_count, attribute_count;
    bool has_output, has_input;
    formal_port output, input;
} augment;

enum { /* traits, as flags */
    TRAIT_PURE = 1, TRAIT_STATEFUL = 2, TRAIT_EFFECT = 4, TRAIT_ONE_TO_ONE = 8, TRAIT_RANDOM = 16,
    TRAIT_READS = 64, /* touches nothing of the outside world but files that it asks pcg_path for, and reads */
    TRAIT_REFLECTS = 32 /* asks what the graph is that it runs in: call->frame->about */
};

typedef struct procedure {
    const char *name;
    const pcg_library *library;
    const char *symbol;          /* pcg_geometry_split */
    const tree_procedure *tree;
    const entity_type **bounds;  /* of its type variables */
    uint32_t variable_count;
    formal_port *inputs, *outputs;
    formal *parameters, *attributes;
    augment *augments;
    uint32_t input_count, output_count, parameter_count, attribute_count, augment_count;
    uint32_t traits;
    bool collective;             /* any input is */
} procedure;

typedef struct function {
    const char *name;
    const pcg_library *library;
    const char *symbol;          /* pcg_core_fn_min_int_int */
    const tree_function *tree;
    formal *parameters;
    uint32_t parameter_count;
    type result;
    uint32_t traits;
    struct function *next;       /* the next overload */
} function;

/* ---- expressions, typed ---------------------------------------------------------------------- */

typedef enum value_kind {
    VALUE_ERROR,
    VALUE_CONSTANT,     /* .any (numbers, bool, color, enumerators in .any.cell[0].i), .string */
    VALUE_LIST,         /* .operands */
    VALUE_PARAMETER,    /* .parameter of the graph */
    VALUE_CONST,        /* .constant of the graph */
    VALUE_ATTRIBUTE,    /* .attribute of the entity at input .port */
    VALUE_ENTITY,       /* the entity at input .port: an argument of a function */
    VALUE_COMPONENT,    /* operands[0] . component number .component */
    VALUE_UNARY,        /* .op, operands[0] */
    VALUE_BINARY,       /* .op, .operands: two that are stored alike (ints; floats and their units; text), or a vector
                         * and a vector of its type or a float */
    VALUE_CHOICE,       /* .operands: a bool, and two of the value's own type */
    VALUE_CALL,         /* .function, .operands; arguments have the formals' types, those of any[] follow */
    VALUE_CONVERT,      /* operands[0] to .type: int to float, any to string */
    VALUE_SLOT          /* the attribute itself, for a parameter of type attribute: .attribute */
} value_kind;

typedef struct value value;
struct value {
    value_kind kind;
    type type;
    span span;
    tree_operator op;
    pcg_any any;
    const char *string;
    struct parameter *parameter;
    struct constant *constant;
    struct attribute *attribute;
    struct port *port;
    const function *function;
    uint32_t component;
    uint32_t site;           /* of a call of a random function: its number within the node */
    value **operands;
    uint32_t count;
    /* What it depends on: emit hoists what is free of both. */
    bool reads_entity;       /* an attribute or an entity of this round */
    bool reads_chance;       /* a random function */
};

/* ---- graphs ---------------------------------------------------------------------------------- */

typedef struct parameter {
    const char *name;
    const tree_parameter *tree;
    type type;
    bool hidden;
    value *initial;          /* never NULL once checked: a type's zero where none is written */
    const pcg_constraint_info *constraints;
    uint32_t constraint_count;
    uint32_t index;
} parameter;

typedef struct constant {
    const char *name;
    const tree_parameter *tree;
    type type;
    value *value;
    uint32_t index;          /* in order of evaluation */
    bool read;
} constant;

typedef struct attribute {
    const char *name;
    const tree_parameter *tree;
    type type;
    value *initial;
    uint32_t index;
    uint32_t cell;           /* relative to the frame's base */
    bool read, written;
} attribute;

typedef struct node node;
typedef struct edge edge;

typedef struct port {
    node *node;
    const char *name;
    bool is_input, collective;
    bool optional;           /* its node does not wait for it */
    bool implicit;           /* a source's impulse; there only where an edge leads to it */
    bool blocked;            /* always */
    value *blocked_if;       /* blocked while it holds; NULL */
    type type;               /* TYPE_ENTITY once checked */
    const formal_port *formal;
    uint32_t index;          /* within the node's inputs or outputs */
    struct argument_item *item; /* the augmentation that it belongs to; NULL */
    edge **edges;            /* in order of lines, disabled ones left out */
    uint32_t edge_count;
    struct node *gathered_by; /* an `out … = *` that takes what leaves while no edge is open; NULL */
    const tree_block *block; /* the statement that blocks it; NULL */
} port;

struct edge {
    port *from, *to;
    bool disabled;
    bool cyclic;             /* ignored for ordering */
    value *condition;        /* open only while it holds; NULL: always */
    span span;               /* of the arrow */
    span from_span, to_span; /* of the elements at its ends; an edge to a gate from its stand-in ends at the gate */
    const tree_chain *chain; /* that it is part of */
};

typedef struct argument {    /* one parameter of a node: what it is given */
    formal *formal;
    value *value;            /* never NULL once checked: the default's where none is written */
    bool given;
} argument;

typedef enum link_kind { LINK_NONE, LINK_WRITE, LINK_SHARE } link_kind;

typedef struct attribute_link { /* one attribute of a node (of an encapsulated graph): what it is linked to */
    const char *name;
    type type;
    link_kind kind;
    attribute *to;           /* of the graph; NULL for LINK_NONE */
    attribute *inner;        /* of an encapsulated graph: its own attribute */
    value *in;               /* name = expression on an encapsulated graph's attribute: handed in; NULL */
} attribute_link;

typedef struct argument_item { /* one augmentation of a node */
    const char *name;
    const augment *augment;
    const tree_augmentation *tree;
    argument *arguments;     /* as many as the augment has parameters */
    attribute_link *links;             /* as many as it has attributes */
    port *input, *output;    /* NULL: none */
    uint32_t index;
} argument_item;

typedef enum node_kind {
    NODE_PROCEDURE, /* .procedure */
    NODE_GRAPH,     /* .graph, encapsulated */
    NODE_INPUT,     /* an input gate: one input (from its stand-in or the host), one output */
    NODE_OUTPUT,    /* an output gate: one input, no output */
    NODE_SURROGATE, /* dynamic, iterate, …; a dynamic whose graph is known becomes NODE_GRAPH in check */
    NODE_ERROR      /* its procedure is unknown; goes with everything */
} node_kind;

struct node {
    node_kind kind;
    struct graph *owner;
    const char *name;        /* unique in the graph: as written, or split_2, which no reference can mean */
    bool named;              /* it was written */
    const tree_element *tree;
    const tree_gate *gate;
    span span;
    uint32_t index;          /* in order of appearance */
    uint32_t global;         /* of all nodes of the program: pcg_node.index */
    uint64_t key;
    const procedure *procedure;
    struct graph *graph;
    struct graph *target;    /* of a surrogate: the graph that it names, where the name is written out; NULL */
    const char *way;         /* from the main file's folder to that of its own file; NULL: none */
    const char *before, *behind; /* of a surrogate: a graph around the procedure whose name is put between them */
    port *inputs, *outputs;
    uint32_t input_count, output_count;
    argument *arguments;     /* as many as the procedure, or graph, has parameters */
    attribute_link *links;             /* as many as it has attributes */
    uint32_t argument_count, link_count;
    argument_item *items;
    uint32_t item_count;
    bool stand_in;           /* of the chain that feeds an input gate when the graph runs on its own */
    struct node *stands_for; /* that gate; NULL */
    bool gathers;            /* NODE_OUTPUT: = * */
    type *variables;         /* what its procedure's type variables are bound to */
    bool broken;             /* an augmentation, or its graph's file, was not understood: it may lack ports */
    table *ports_by_name;    /* outputs, inputs: where there are many; NULL */
    /* order */
    uint32_t rank;           /* position in the order */
    uint32_t random_sites;
};

/* A span of the order: straight code, or a loop because edges lead back in it. */
typedef struct region {
    uint32_t first, last;    /* ranks, both included */
    bool cyclic;
} region;

typedef struct graph {
    const char *name;
    const char *symbol;      /* unique in the program: a C identifier */
    const tree_graph *tree;
    struct unit *unit;
    uint32_t index;
    parameter *parameters;
    constant *constants;     /* in order of evaluation */
    attribute *attributes;
    uint32_t parameter_count, constant_count, attribute_count;
    node **nodes;            /* in order of appearance, gates included */
    uint32_t node_count;
    node **inputs, **outputs; /* the gates */
    uint32_t input_count, output_count;
    edge **edges;            /* in order of lines; disabled ones too */
    uint32_t edge_count;
    uint32_t cells;          /* of its attributes */
    node **order;
    region *regions;
    uint32_t region_count;
    bool encapsulated;       /* another graph (or itself) uses it */
    bool main;
    struct graph_names *names; /* resolve's: what its names mean */
} graph;

/* One file. */
typedef struct unit {
    const source *source;
    tree_file *tree;
    const char *folder;      /* where its relative paths are looked up, imports and assets */
    graph **graphs;
    uint32_t graph_count;
    LIST(struct unit *) imports;
    bool resolving;
    bool broken;             /* its text had errors: what a name means may be lost */
    table names;             /* graphs in scope, its own and imported, by the name that they have here */
    table libraries;         /* libraries by the name that `use … as` gives them here */
} unit;

typedef struct program {
    arena *arena;
    diagnostics *diagnostics;
    unit **units;            /* in order of first import, the main file first */
    uint32_t unit_count;
    graph **graphs;          /* every graph that the main one reaches, callees before callers where possible */
    uint32_t graph_count;
    graph *main;
    uint32_t node_count;     /* over all graphs */
    LIST(const procedure *) procedures; /* used, each once */
    LIST(const function *) functions;
    LIST(const enumeration *) enumerations;
    LIST(const entity_type *) entities;
    LIST(const pcg_library *) libraries; /* built in, given by the host, and those that `use` found */
    uint32_t common_libraries; /* the first so many are in scope everywhere, the others where they are used */
    const unit *scope;         /* whose names are looked up; NULL: all libraries are in scope */
    struct interfaces *interfaces; /* library.c's: what was understood of them so far */
} program;

#endif

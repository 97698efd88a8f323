/* tree.h - the syntax tree: what a file says, and nothing about what it means.
 *
 * Made by the parser, read by everything behind it. Names are NUL-terminated and stand as written
 * (a quoted name without its quotes). Every element carries its span. Lists keep the order of the
 * text; that order has a meaning (LANGUAGE, "Order of lines"). Absent parts are NULL, or have a
 * count of 0.
 *
 * The same tree holds programs (graphs) and interfaces (procedures, functions, entities,
 * enumerations): the interface block of a kernel file is a file of this language.
 */
#ifndef PCG_TREE_H
#define PCG_TREE_H

#include "../runtime/base/base.h"

/* ---- comments -------------------------------------------------------------------------------- */

typedef enum tree_comment_kind {
    COMMENT_PLAIN,        /* // … */
    COMMENT_DOCUMENT,     /* /// … */
    COMMENT_DOCUMENT_FILE /* //! … */
} tree_comment_kind;

/* One line of comment. `text` is what stands behind the slashes, without the line end. */
typedef struct tree_comment {
    span span;
    tree_comment_kind kind;
    const char *text;
    bool trailing;      /* ends a line that holds something else before it */
    bool blank_before;  /* an empty line stands before it */
} tree_comment;
typedef LIST(tree_comment) tree_comments;

/* What every element that takes a line has. `document` is the documentation as one string: the
 * lines of `///` before the element and the one behind it, joined by '\n', without a leading blank;
 * or NULL. */
typedef struct tree_head {
    span span;              /* the whole element */
    const char *document;
    tree_comments before;   /* comments on lines of their own before it, of every kind */
    tree_comments after;    /* behind it, on its last line */
    bool blank_before;      /* an empty line stands before it (and before its comments) */
} tree_head;

typedef struct tree_name {
    const char *text;
    span span;
} tree_name;
typedef LIST(tree_name) tree_names;

/* ---- expressions ----------------------------------------------------------------------------- */

typedef enum tree_unit {
    UNIT_NONE,
    UNIT_METRE,      /* 3m; mm cm km are read too and converted */
    UNIT_SQUARE_METRE, /* 3m2 */
    UNIT_DEGREE,     /* 30deg; rad is read too and converted */
    UNIT_PERCENT,    /* 50%: the value is 0.5 */
    UNIT_SECOND      /* 2s; ms min h are read too and converted */
} tree_unit;

typedef enum tree_operator {
    OP_NEGATE, OP_NOT, OP_COMPLEMENT,
    OP_MULTIPLY, OP_DIVIDE, OP_REMAINDER, OP_ADD, OP_SUBTRACT, OP_SHIFT_LEFT, OP_SHIFT_RIGHT,
    OP_LESS, OP_LESS_EQUAL, OP_GREATER, OP_GREATER_EQUAL, OP_EQUAL, OP_NOT_EQUAL,
    OP_BIT_AND, OP_BIT_XOR, OP_BIT_OR, OP_AND, OP_OR
} tree_operator;

typedef enum tree_expression_kind {
    EXPR_ERROR,     /* where the parser recovered; says nothing more */
    EXPR_BOOL,      /* .boolean */
    EXPR_INT,       /* .integer */
    EXPR_FLOAT,     /* .number, .unit; an integer literal with a unit is one of these */
    EXPR_STRING,    /* .string, escapes resolved */
    EXPR_COLOR,     /* .color, 0xRRGGBBAA */
    EXPR_LIST,      /* .operands */
    EXPR_NAME,      /* .name: a parameter, constant, enumerator or port */
    EXPR_ATTRIBUTE, /* @name, or port@name: .name, .port (text is NULL for the first input) */
    EXPR_MEMBER,    /* operands[0] . name: a component of a value; may also be library.name before a call */
    EXPR_UNARY,     /* .op, operands[0] */
    EXPR_BINARY,    /* .op, operands[0], operands[1] */
    EXPR_CHOICE,    /* operands[0] ? operands[1] : operands[2] */
    EXPR_CALL       /* .port.text is the library or NULL, .name the function, .operands the arguments */
} tree_expression_kind;

typedef struct tree_expression tree_expression;
typedef LIST(tree_expression *) tree_expressions;

struct tree_expression {
    tree_expression_kind kind;
    tree_operator op;
    tree_unit unit;
    span span;
    bool parenthesised; /* written in parentheses, which the formatter keeps */
    uint32_t depth;     /* of the tree below it, itself included; at most LANG_MAX_DEPTH */
    bool boolean;
    int64_t integer;
    double number;
    uint32_t color;
    const char *string;
    tree_name name;
    tree_name port;
    tree_expressions operands;
};

/* ---- types, ports, parameters ---------------------------------------------------------------- */

/* Type, Type[], Type[]?, list<Type>, or a type variable. */
typedef struct tree_type {
    span span;
    tree_name name;
    struct tree_type *element; /* of list<…> */
    bool collective;           /* [] */
    bool optional;             /* []?, an input that may be empty */
} tree_type;

typedef enum tree_constraint_kind {
    CONSTRAINT_RANGE,   /* range [lo, hi]: operands lo, hi */
    CONSTRAINT_ONE_OF,  /* one of (a, b, …): operands */
    CONSTRAINT_MATCHES, /* matches "regex": operands[0] */
    CONSTRAINT_AT_MOST  /* at most n characters: operands[0] */
} tree_constraint_kind;

typedef struct tree_constraint {
    tree_constraint_kind kind;
    span span;
    tree_expressions operands;
} tree_constraint;

/* param, const and attr of a graph; param and attr of a procedure; a parameter of an augmentation
 * or of a function (name: type [= initial], without a keyword). */
typedef struct tree_parameter {
    tree_head head;
    bool hidden;
    tree_name name;
    tree_type *type;             /* NULL for a const */
    tree_expression *initial;    /* the default; NULL where there is none */
    LIST(tree_constraint) constraints;
} tree_parameter;
typedef LIST(tree_parameter *) tree_parameters;

/* ---- chains ---------------------------------------------------------------------------------- */

typedef enum tree_argument_kind {
    ARGUMENT_VALUE,  /* name = expression, or an expression alone (name.text is NULL) */
    ARGUMENT_WRITE,  /* name => @attribute */
    ARGUMENT_SHARE   /* name <=> @attribute */
} tree_argument_kind;

typedef struct tree_argument {
    tree_argument_kind kind;
    span span;
    tree_name name;
    tree_expression *value;
    tree_name attribute;
    tree_comments before, after; /* where arguments stand on lines of their own */
} tree_argument;
typedef LIST(tree_argument) tree_arguments;

/* name: kind(args), or kind(args). */
typedef struct tree_augmentation {
    tree_head head;
    tree_name name; /* text is NULL where it has none of its own */
    tree_name kind;
    tree_arguments arguments;
    bool has_parentheses;
} tree_augmentation;
typedef LIST(tree_augmentation *) tree_augmentations;

typedef struct tree_gate tree_gate;
typedef LIST(tree_gate *) tree_gates;

/* loop out -> in, in the braces of iterate. */
typedef struct tree_loop {
    tree_head head;
    tree_name from, to;
} tree_loop;

/* A surrogate's declared interface, or a node's augmentations: what stands in a node's braces. */
typedef struct tree_body {
    span span;
    tree_augmentations augmentations;
    tree_gates inputs, outputs;      /* in …, out …: a surrogate's */
    tree_parameters parameters;      /* param … */
    tree_parameters attributes;      /* attr … */
    LIST(tree_loop *) loops;
    tree_comments dangling;          /* comments before the closing brace */
} tree_body;

typedef enum tree_element_kind {
    ELEMENT_REFERENCE, /* name, or name.port */
    ELEMENT_NODE       /* [name:] [library.]procedure(args) { body } */
} tree_element_kind;

typedef struct tree_element {
    tree_element_kind kind;
    span span;
    tree_name name;      /* the referenced node, or the new node's own name (text NULL: none) */
    tree_name port;      /* of a reference; text NULL: none given */
    tree_name library;   /* of a new node; text NULL: none given */
    tree_name procedure; /* of a new node */
    tree_arguments arguments;
    bool has_parentheses;
    tree_body *body;     /* NULL: no braces */
    tree_comments before; /* comments on the lines between the arrow's line and this element's */
    tree_comments after;
} tree_element;

typedef struct tree_arrow {
    span span;
    bool disabled; /* -/> */
} tree_arrow;

/* Elements joined by arrows: arrows.at[i] stands between elements.at[i] and elements.at[i + 1]. */
typedef struct tree_chain {
    span span;
    LIST(tree_element *) elements;
    LIST(tree_arrow) arrows;
    tree_expression *condition; /* if …; or NULL */
} tree_chain;

/* in name: Type = chain; out name: Type = *. In a procedure's head: name: Type. */
struct tree_gate {
    tree_head head;
    tree_name name;
    tree_type *type;
    tree_chain *stand_in; /* of an input */
    bool gathers;         /* = * of an output */
};

/* block name.port if expr */
typedef struct tree_block {
    tree_head head;
    tree_name node, port;
    tree_expression *condition;
} tree_block;

/* ---- graphs ---------------------------------------------------------------------------------- */

typedef enum tree_member_kind {
    MEMBER_PARAMETER, /* .parameter */
    MEMBER_CONSTANT,  /* .parameter */
    MEMBER_ATTRIBUTE, /* .parameter */
    MEMBER_INPUT,     /* .gate */
    MEMBER_OUTPUT,    /* .gate */
    MEMBER_CHAIN,     /* .chain: edges, or a node on its own */
    MEMBER_BLOCK      /* .block */
} tree_member_kind;

typedef struct tree_member {
    tree_member_kind kind;
    tree_head head; /* of every kind; the head inside parameter, gate or block is the same one */
    union {
        tree_parameter *parameter;
        tree_gate *gate;
        tree_chain *chain;
        tree_block *block;
    };
} tree_member;

typedef struct tree_graph {
    tree_head head;
    tree_name name;
    LIST(tree_member *) members; /* in order of appearance */
    tree_comments dangling;
} tree_graph;

/* ---- interfaces ------------------------------------------------------------------------------ */

/* <T: Entity> */
typedef struct tree_variable {
    tree_name name;
    tree_name bound;
} tree_variable;

/* augment name(parameters) -> Type, or … <- Type for one that carries an input port. */
typedef struct tree_augment {
    tree_head head;
    tree_name name;
    tree_parameters parameters;
    tree_parameters attributes; /* attr name: type in the parentheses */
    tree_type *output;          /* NULL: carries no output port */
    tree_type *input;           /* NULL: carries no input port */
} tree_augment;

/* example chain expect name = expression, … */
typedef struct tree_example {
    tree_head head;
    LIST(tree_chain *) chains; /* one at least */
    tree_arguments expectations;
} tree_example;

typedef struct tree_procedure {
    tree_head head;
    tree_name name;
    LIST(tree_variable) variables;
    tree_gates inputs, outputs;
    tree_names traits;
    tree_parameters parameters;
    tree_parameters attributes;
    LIST(tree_augment *) augments;
    LIST(tree_example *) examples;
    tree_names former; /* formerly …: names from before a rename */
    tree_name category; /* category "…"; text NULL: none */
    tree_names synonyms; /* synonyms "…", "…": words that a search finds it by */
    tree_comments dangling;
} tree_procedure;

/* function name<T: Entity>(parameters) -> type [traits] { example … } */
typedef struct tree_function {
    tree_head head;
    tree_name name;
    LIST(tree_variable) variables;
    tree_parameters parameters;
    tree_type *result;
    tree_names traits;
    /* example name(arguments) = value, as an expression that must hold: example min(1, 2) == 1 */
    tree_expressions examples;
    tree_comments dangling;
} tree_function;

/* entity name: parent { attr … } */
typedef struct tree_entity {
    tree_head head;
    tree_name name, parent;
    tree_parameters attributes;
    tree_comments dangling;
} tree_entity;

/* enum name { a, b, c } */
typedef struct tree_enumerator {
    tree_head head;
    tree_name name;
} tree_enumerator;
typedef struct tree_enumeration {
    tree_head head;
    tree_name name;
    LIST(tree_enumerator) enumerators;
    tree_comments dangling;
} tree_enumeration;

/* ---- files ----------------------------------------------------------------------------------- */

/* import graph [as name] from "path"; the graph named `*`-less; several: import a, b from
 * "path". */
typedef struct tree_import {
    tree_head head;
    LIST(struct tree_imported { tree_name name; tree_name alias; }) names;
    const char *path;
    span path_span;
} tree_import;

/* use library [as name] */
typedef struct tree_use {
    tree_head head;
    tree_name library, alias;
} tree_use;

typedef enum tree_item_kind {
    ITEM_IMPORT, ITEM_USE, ITEM_GRAPH, ITEM_PROCEDURE, ITEM_FUNCTION, ITEM_ENTITY, ITEM_ENUMERATION
} tree_item_kind;

typedef struct tree_item {
    tree_item_kind kind;
    union {
        tree_import *import;
        tree_use *use;
        tree_graph *graph;
        tree_procedure *procedure;
        tree_function *function;
        tree_entity *entity;
        tree_enumeration *enumeration;
    };
} tree_item;

typedef struct tree_file {
    const source *source;
    const char *document; /* //! lines at the top, joined by '\n'; or NULL */
    tree_comments before; /* those lines, and plain comments before the first item */
    LIST(tree_item) items;
    tree_comments dangling; /* behind the last item */
} tree_file;

#endif

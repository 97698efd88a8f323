/* check.h - what the files of the pass `check` share.
 *
 * check.c goes over graphs; check_port.c infers what ports carry; check_value.c types expressions
 * (check_name.c names, check_operator.c operators, check_call.c functions); check_constraint.c what
 * parameters may be; check_node.c a node's arguments and links; check_surrogate.c surrogates;
 * check_hint.c advice; check_flow.c warns of what cannot be meant.
 */
#ifndef PCG_COMPILER_CHECK_H
#define PCG_COMPILER_CHECK_H

#include "evaluate.h"
#include "library.h"
#include "resolve.h"

typedef struct checker {
    compilation *c;
    program *p;
    arena *arena;
    diagnostics *d;
} checker;

/* Where an expression stands: what its names can mean. */
typedef struct scope {
    checker *k;
    const char *place; /* in messages: "the default of a parameter" */
    graph *graph;      /* NULL in an interface: no names but enumerators */
    node *node; /* whose round it is: its ports, @attributes and chance can be read; or NULL */
    bool sees_parameters, sees_constants;
    uint32_t parameters; /* how many of the graph's are declared before */
    uint32_t constants;  /* how many; to read one behind them is a cycle, which was reported */
} scope;

/* ---- expressions --------------------------------------------------------------------------- */

/* The typed expression; never NULL: a VALUE_ERROR where something was wrong, which was reported.
 * `hint` is the type that is wanted, or NULL: it tells enumerators and the elements of lists, and
 * is not enforced. */
value *check_value(scope *s, const tree_expression *e, const type *hint);
/* The same, of that very type; `taker`, such as "'amount'", is what takes it in the message where
 * that fails. */
value *check_value_as(scope *s, const tree_expression *e, const type *to, const char *taker);
/* The value as one of that type, or NULL where there is no conversion. A plain number becomes one
 * of base units. */
value *value_convert(checker *k, value *v, const type *to);
/* How far the conversion goes: 0 none is needed; CONVERT_NEVER. */
enum { CONVERT_NEVER = 1 << 20 };
uint32_t conversion_cost(const value *v, const type *to);
/* A path that is written in `written_in`, as one to be looked up beside the main file. */
const char *path_from_main(checker *k, const source *written_in, const char *path);
/* check_hint.c: what a newcomer may have meant. "write #ff0000" for a colour's name; NULL for
 * another word. */
const char *hint_color(checker *k, const char *word);
/* Whether the expression is a path without quotes, such as assets/brick.jpg. */
bool is_bare_path(const scope *s, const tree_expression *e);
/* Reports that a value does not fit, unless it or the type is an error. */
value *report_mismatch(scope *s, const value *v, const type *to, const char *taker);
/* False (reported) for entities, which are no values, and for empty lists of unknown type. */
bool require_value(scope *s, const value *v, const char *expected);

value *value_new(const scope *s, value_kind kind, type t, span place);
value *value_error(const scope *s, span place);
bool value_is_error(const value *v);
/* Sets operands and what follows from them; replaces what is constant by its value. */
value *value_finish(const scope *s, value *v, uint32_t count, value *const *operands);
/* The value that a type begins with: 0, false, "", the first enumerator. */
value *value_zero(const scope *s, const type *t, span place);

value *check_name(scope *s, const tree_expression *e, const type *hint);
value *check_attribute(scope *s, const tree_expression *e);
/* For a parameter of type attribute: the attribute itself. */
value *check_slot(scope *s, const tree_expression *e, const char *taker);
/* NULL where the graph has none of that name: it was reported. `like`: what type it would have;
 * NULL: any. */
attribute *find_attribute(scope *s, const tree_name *name, const type *like);
/* Whether a bare word means something here without a hint. */
bool name_is_known(const scope *s, const char *name);
/* The number of an enumerator, or -1. */
int64_t enumerator_number(const enumeration *e, const char *name);
value *enumerator_value(const scope *s, const type *t, int64_t number, span place);

value *check_unary(scope *s, const tree_expression *e, const type *hint);
value *check_binary(scope *s, const tree_expression *e, const type *hint);
value *check_choice(scope *s, const tree_expression *e, const type *hint);
value *check_list(scope *s, const tree_expression *e, const type *hint);
/* The type that two values can both become; false where there is none. */
bool common_type(const value *a, const value *b, const type *hint, type *result);

value *check_call(scope *s, const tree_expression *e);
/* A call of a function of that name with arguments that are checked already; NULL where none takes
 * them. */
value *call_function(scope *s, const char *name, value *const *arguments, uint32_t count,
                     span place);
value *check_vector(scope *s, const tree_expression *e, const type *t);

/* ---- parameters, nodes --------------------------------------------------------------------- */

/* A formal's default and constraints, understood once. */
void check_formal(checker *k, formal *f);
void check_constraints(scope *s, const tree_parameter *t, const type *of,
                       const pcg_constraint_info **constraints, uint32_t *count);
/* Reports a constant value that a constraint forbids. */
void check_constrained(checker *k, const value *v, const char *name,
                       const pcg_constraint_info *constraints, uint32_t count);

void check_ports(checker *k, graph *g);
void check_node(checker *k, node *n);
void check_surrogate(checker *k, node *n);
void check_flow(checker *k, graph *g);
/* check_cycle.c; `reached`: by node index, whether it can run. */
void warn_of_endless_cycles(checker *k, const graph *g, const bool *reached);

#endif

/* parser.h - what the parts of the parser share. Internal to lang/.
 *
 * text -> lexer.re (lexemes; keeps no state) -> layout.c (which line ends count, brackets that are
 * never closed, comments put aside) -> grammar.y (tree, by the constructors of build.c; messages by
 * syntax.c) -> attach.c (comments and documentation go to their elements). parse.c runs them.
 */
#ifndef PCG_PARSER_H
#define PCG_PARSER_H

#include "lang.h"

/* ---- lexer.re -------------------------------------------------------------------------------- */

/* A token's kind is a T_… of grammar.h; these are lexemes that the grammar never sees. */
enum {
    LEX_NEWLINE = 10000,
    LEX_COMMENT,
    LEX_BLOCK_COMMENT, /* as in C: this language has none */
    LEX_BAD_CHARACTER,
    LEX_OPEN_STRING, /* without its closing quote */
    LEX_OPEN_NAME,
    LEX_FOREIGN_NAME, /* of letters beyond a to z: has to be quoted */
    LEX_NUMBER,       /* with its unit: becomes T_VALUE */
    LEX_COLOR,        /* likewise */
    LEX_REFERENCE,    /* @{name}, ${port}, ${port}{attribute}: likewise */
};

typedef struct lexeme {
    int kind;
    uint32_t from, to;
} lexeme;

/* The lexeme behind the blanks at an offset; T_END at the end. A pure function of the text. */
lexeme lex(const source *s, uint32_t at);

/* ---- parser ---------------------------------------------------------------------------------- */

typedef struct bracket {
    char kind;    /* ( [ { */
    char closer;  /* what closes it in the text: ] where [ was written for { */
    bool made_up; /* the text lacks it: that is reported */
    uint32_t at;
} bracket;

/* One run of the parser. */
typedef struct parser {
    arena *arena;
    const source *source;
    diagnostics *diagnostics;
    tree_file *file;
    tree_comments comments; /* all of them, in order */
    /* layout */
    uint32_t at;             /* where the next lexeme is looked for */
    lexeme previous, before; /* the token that was handed on last, and the one before it */
    bool line_began;         /* a line end stands between `previous` and the next token */
    bool stopped;            /* a limit was passed: nothing but T_END comes */
    bool unmatched;          /* the last token is a closing bracket that closes nothing */
    bool made_up;            /* the last token is a bracket that the text lacks: that is reported */
    uint32_t braces_made_up; /* so many } are too many at the end: their errors are known */
    uint32_t types;          /* how many < of list<list<… are open, where each > closes one */
    bracket open[LANG_MAX_NESTING];
    uint32_t depth;
} parser;

/* Span of bytes from..to-1 of the parser's source. */
span parser_span(const parser *p, uint32_t from, uint32_t to);

/* ---- literals.c: what lexemes mean ----------------------------------------------------------- */

tree_expression *literal_number(parser *p, span at);
tree_expression *literal_color(parser *p, span at);
tree_expression *literal_string(parser *p, span at, bool closed);
tree_expression *literal_reference(parser *p, span at);
/* A name as written, without its quotes; `skip` bytes stand before it (the @ of an attribute). */
tree_name literal_name(parser *p, span at, uint32_t skip);

/* Whether the bytes are the name of a unit. */
bool literal_is_unit(const parser *p, span at);

/* ---- syntax.c: messages ---------------------------------------------------------------------- */

enum { SYNTAX_MAX_EXPECTED = 80 };

/* A token that no rule takes, the last one that was handed on. `expected` are the names of those
 * that one would take. */
void syntax_error(parser *p, span at, const char *const *expected, int count);
/* Something is nested beyond a limit: reports it, and nothing more is read. */
void syntax_too_deep(parser *p, span at, int limit);
/* A bracket that is not closed behind the last token, where it should be. */
void syntax_unclosed(parser *p, bracket open);
/* The text of a span in quotes, shortened where long. */
const char *syntax_quote(parser *p, span at);

/* ---- build.c: constructors of the tree ------------------------------------------------------- */

tree_expression *build_expression(parser *p, tree_expression_kind kind, span at);
tree_expression *build_unary(parser *p, tree_operator op, tree_expression *operand, span at);
tree_expression *build_binary(parser *p, tree_operator op, tree_expression *left,
                              tree_expression *right);
tree_expression *build_choice(parser *p, tree_expression *condition, tree_expression *yes,
                              tree_expression *no);
tree_expression *build_name(parser *p, tree_name name);
tree_expression *build_attribute(parser *p, tree_name port, tree_name attribute, span at);
tree_expression *build_member(parser *p, tree_expression *of, tree_name name);
tree_expression *build_call(parser *p, tree_name name, tree_expressions arguments, span at);
/* of.name(arguments): a library's function, or the original notation's Math.Min(…) and of.Length().
 */
tree_expression *build_member_call(parser *p, tree_expression *of, tree_name name,
                                   tree_expressions arguments, span at);
tree_expression *build_list(parser *p, tree_expressions operands, span at);

tree_type *build_type(parser *p, tree_name name, tree_type *element, span at);
tree_parameter *build_parameter(parser *p, tree_name name, tree_type *type,
                                tree_expression *initial, span at);
tree_constraint build_constraint(tree_constraint_kind kind, tree_expressions operands, span at);
tree_expressions build_operands(parser *p, tree_expression *one);
tree_gate *build_gate(parser *p, tree_name name, tree_type *type, span at);

tree_argument build_argument(tree_argument_kind kind, tree_name name, tree_expression *value,
                             tree_name attribute, span at);
/* As ARGUMENT_WRITE or _SHARE, where the attribute was written without its @; reports that. */
tree_argument build_bare_link(parser *p, tree_argument_kind kind, tree_name name,
                              tree_name attribute, span at);
tree_augmentation *build_augmentation(parser *p, tree_name name, tree_name kind,
                                      const tree_arguments *arguments, span at);
/* A reference becomes a node: with a name of its own (text NULL: none), and what stands behind it
 * (NULL: nothing). */
tree_element *build_node(parser *p, tree_name name, tree_element *path, const tree_element *call,
                         span at);
tree_element *build_reference(parser *p, tree_name name, tree_name port, span at);
tree_chain *build_chain(parser *p, tree_element *first);
/* `to` NULL: where the parser recovered. Such a chain has no edges any more, since they would lead
 * past the gap. */
void build_link(parser *p, tree_chain *chain, tree_arrow arrow, tree_element *to);

/* Adds to a graph. `begin` is the keyword that the statement begins with; a chain with an error in
 * it is added as its nodes, each on its own. */
void build_parameter_member(parser *p, tree_graph *g, tree_member_kind kind,
                            tree_parameter *parameter, span begin);
void build_gate_member(parser *p, tree_graph *g, tree_member_kind kind, tree_gate *gate,
                       span begin);
void build_chain_member(parser *p, tree_graph *g, tree_chain *chain);
void build_block_member(parser *p, tree_graph *g, const tree_element *path,
                        tree_expression *condition, span begin);

typedef LIST(tree_variable) variable_list;
/* Copies a list into the one of a procedure or function; NULL: nothing. */
#define build_variables(p, to, from)                                                               \
    do                                                                                             \
        for (uint32_t i_ = 0; (from) && i_ < (from)->count; i_++)                                  \
            LIST_ADD((p)->arena, (to), (from)->at[i_]);                                            \
    while (0)
void build_names(parser *p, tree_names *to, tree_names from);
/* a.b as one name: what an example expects of a port. */
tree_name build_dotted(parser *p, tree_name left, tree_name right, span at);
void build_item(parser *p, tree_item_kind kind, void *item);
/* An item that begins with a word that means nothing, such as grahp: reports it. */
void build_unknown_item(parser *p, tree_name word);

/* ---- attach.c -------------------------------------------------------------------------------- */

/* Gives every comment to the element that it belongs to, and sets documents. */
void attach_comments(parser *p);

#endif

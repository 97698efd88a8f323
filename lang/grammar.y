/* grammar.y - the grammar, LALR(1) without a conflict.
 *
 * Line ends are tokens; layout.c has left out those that do not count (in () and [], before an
 * arrow), and closes brackets that the text leaves open, so that braces are balanced here: no '}'
 * comes without its '{', and none is missing at the end. Most keywords are words only where they
 * begin something: everywhere else they are names (`name`). Errors are taken up at the next
 * argument, augmentation, statement or item, so that all of a file's are found in one run.
 */
%define api.pure full
%define api.prefix {grammar_}
%define api.token.prefix {T_}
%define api.location.type {span}
%define parse.error custom
%define lr.default-reduction consistent
%expect 0
%locations
%param {parser *p}

%code requires {
#include "parser.h"
}

%union {
    tree_name name;
    tree_names names;
    tree_expression *expression;
    tree_expressions expressions;
    tree_type *type;
    tree_constraint constraint;
    tree_parameter *parameter;
    tree_parameters parameters;
    tree_gate *gate;
    tree_gates gates;
    tree_argument argument;
    tree_arguments arguments;
    tree_augmentation *augmentation;
    tree_body *body;
    tree_loop *loop;
    tree_element *element;
    tree_arrow arrow;
    tree_chain *chain;
    tree_graph *graph;
    tree_variable variable;
    variable_list *variables;
    tree_augment *augment;
    tree_example *example;
    tree_procedure *procedure;
    tree_function *function;
    tree_entity *entity;
    tree_enumeration *enumeration;
    tree_import *import;
    tree_use *use;
}

%code provides {
/* layout.c: the next token. */
int grammar_lex(GRAMMAR_STYPE *value, span *at, parser *p);
}

%code {
/* The parser's stack is the arena's, so that a jump out of it leaks nothing. */
#define YYMALLOC(size) arena_alloc(p->arena, (size))
#define YYFREE(pointer) ((void)(pointer))
#define YYMAXDEPTH 10000

/* A rule's span: from its first symbol that is not empty to its last one. */
static span location_of(const span *symbols, int count)
{
    span at = symbols[1];
    for (int i = 1; i < count && at.from >= at.to; i++)
        at = symbols[i + 1];
    at.to = symbols[count].to > at.to ? symbols[count].to : at.to;
    return at;
}
#define YYLLOC_DEFAULT(at, symbols, count)                                                         \
    ((at) = (count) ? location_of((symbols), (count))                                              \
                    : parser_span(p, (symbols)[0].to, (symbols)[0].to))

static void grammar_error(const span *at, parser *p, const char *message);

/* The element's own span began behind its keyword. */
static void begin(tree_head *head, span keyword)
{
    head->span.from = keyword.from;
}

#define ADD(list, item) LIST_ADD(p->arena, &(list), (item))
}

%token END 0 "end of file" NEWLINE "end of line"
%token <name> NAME "name" ATTRIBUTE "attribute"
%token <expression> VALUE "value" STRING "string" TRUE "true" FALSE "false"
%token IF "if"
%token <name>
    IMPORT "import" FROM "from" AS "as" USE "use" GRAPH "graph"
    HIDDEN "hidden" PARAM "param" CONST "const" ATTR "attr" IN "in" OUT "out" BLOCK "block"
    LOOP "loop"
    RANGE "range" ONE "one" OF "of" MATCHES "matches" AT "at" MOST "most" CHARACTERS "characters"
    PROCEDURE "procedure" FUNCTION "function" ENTITY "entity" ENUM "enum" AUGMENT "augment"
    EXAMPLE "example" EXPECT "expect" FORMERLY "formerly" CATEGORY "category" SYNONYMS "synonyms"
%token ARROW "->" DISABLED "-/>" WRITE "=>" SHARE "<=>" BRACKETS "[]"
%token LESS_EQUAL "<=" GREATER_EQUAL ">=" EQUAL "==" NOT_EQUAL "!=" SHIFT_LEFT "<<" SHIFT_RIGHT ">>"
%token AND "&&" OR "||"
%token ',' ':' '=' '(' ')' '[' ']' /* messages name expected tokens in the order of these lines */

%left "||"
%left "&&"
%left '|'
%left '^'
%left '&'
%left "==" "!="
%left '<' "<=" '>' ">="
%left "<<" ">>"
%left '+' '-'
%left '*' '/' '%'
%precedence UNARY

%type <name> name word string alias dotted entity_parent
%type <names> names strings traits
%type <expression> expression operation postfix primary condition bad_value
%type <expressions> expressions
%type <type> type
%type <constraint> constraint
%type <parameter> declared constant
%type <parameters> declared_list
%type <gate> gate input output
%type <gates> gates gate_list outputs
%type <argument> argument link_to expectation
%type <arguments> arguments argument_list expectations
%type <augmentation> augmentation
%type <body> body body_open body_full
%type <loop> loop
%type <element> element path call
%type <arrow> arrow
%type <chain> links chain
%type <graph> graph members_open members_full
%type <variable> variable
%type <variables> variables variable_list
%type <augment> augment augment_parts flow
%type <example> example example_chains
%type <procedure> procedure procedure_braces procedure_open procedure_full
%type <function> function function_braces function_open function_full
%type <entity> entity entity_braces entity_open entity_full
%type <enumeration> enumeration enumerators_open enumerators_full
%type <import> import imported
%type <use> use

%%

file: items_open END | items_full END ;

items_open: %empty | items_open separator | items_full separator ;
items_full:
    items_open import       { build_item(p, ITEM_IMPORT, $2); }
  | items_open use          { build_item(p, ITEM_USE, $2); }
  | items_open graph        { build_item(p, ITEM_GRAPH, $2); }
  | items_open procedure    { build_item(p, ITEM_PROCEDURE, $2); }
  | items_open function     { build_item(p, ITEM_FUNCTION, $2); }
  | items_open entity       { build_item(p, ITEM_ENTITY, $2); }
  | items_open enumeration  { build_item(p, ITEM_ENUMERATION, $2); }
  | items_open bad
  | items_full bad
  ;

/* Only where a separator was taken are messages given again, so that one mistake is one. */
separator: NEWLINE { yyerrok; } | ';' { yyerrok; } ;
comma: ',' { yyerrok; } ;

/* What is left out where an item or a statement cannot be read: the rest of the line, and a whole
 * {…} in it. */
bad: error | error '{' skipped '}' ;
bad_value: error { $$ = build_expression(p, EXPR_ERROR, @1); }
  | error '{' skipped '}' { $$ = build_expression(p, EXPR_ERROR, @1); } ;
skipped: %empty | skipped skip | skipped '{' skipped '}' ;
skip: NEWLINE | ';' | ARROW | DISABLED | '(' | ')' | '[' | ']' | skip_anywhere ;
skip_anywhere: ATTRIBUTE | VALUE | STRING | TRUE | FALSE | IF | name | WRITE | SHARE | BRACKETS
  | LESS_EQUAL | GREATER_EQUAL | EQUAL | NOT_EQUAL | SHIFT_LEFT | SHIFT_RIGHT | AND | OR
  | '<' | '>' | '+' | '-' | '*' | '/' | '%' | '&' | '|' | '^' | '!' | '~'
  | '?' | ':' | '=' | '.' | ',' ;

/* ---- names and types ------------------------------------------------------------------------- */

name: NAME | word ;
word: IMPORT | FROM | AS | USE | GRAPH | HIDDEN | PARAM | CONST | ATTR | IN | OUT | BLOCK | LOOP
  | RANGE | ONE | OF | MATCHES | AT | MOST | CHARACTERS | PROCEDURE | FUNCTION | ENTITY | ENUM
  | AUGMENT | EXAMPLE | EXPECT | FORMERLY | CATEGORY | SYNONYMS ;

names: name { $$ = (tree_names){0}; ADD($$, $1); } | names comma name { $$ = $1; ADD($$, $3); } ;
string: STRING { $$ = (tree_name){$1->string, @1}; } ;
strings:
    string                { $$ = (tree_names){0}; ADD($$, $1); }
  | strings comma string  { $$ = $1; ADD($$, $3); }
  ;

type:
    name                { $$ = build_type(p, $1, NULL, @$); }
  | name BRACKETS       { $$ = build_type(p, $1, NULL, @$); $$->collective = true; }
  | name BRACKETS '?'   {
        $$ = build_type(p, $1, NULL, @$);
        $$->collective = $$->optional = true;
    }
  | name '<' type '>'   { $$ = build_type(p, $1, $3, @$); }
  ;

/* ---- expressions ----------------------------------------------------------------------------- */

expression:
    operation
  | operation '?' expression ':' expression { $$ = build_choice(p, $1, $3, $5); }
  ;
operation:
    postfix
  | '-' operation %prec UNARY { $$ = build_unary(p, OP_NEGATE, $2, @$); }
  | '!' operation %prec UNARY { $$ = build_unary(p, OP_NOT, $2, @$); }
  | '~' operation %prec UNARY { $$ = build_unary(p, OP_COMPLEMENT, $2, @$); }
  | '+' operation %prec UNARY { $$ = $2; }
  | operation "||" operation  { $$ = build_binary(p, OP_OR, $1, $3); }
  | operation "&&" operation  { $$ = build_binary(p, OP_AND, $1, $3); }
  | operation '|' operation   { $$ = build_binary(p, OP_BIT_OR, $1, $3); }
  | operation '^' operation   { $$ = build_binary(p, OP_BIT_XOR, $1, $3); }
  | operation '&' operation   { $$ = build_binary(p, OP_BIT_AND, $1, $3); }
  | operation "==" operation  { $$ = build_binary(p, OP_EQUAL, $1, $3); }
  | operation "!=" operation  { $$ = build_binary(p, OP_NOT_EQUAL, $1, $3); }
  | operation '<' operation   { $$ = build_binary(p, OP_LESS, $1, $3); }
  | operation "<=" operation  { $$ = build_binary(p, OP_LESS_EQUAL, $1, $3); }
  | operation '>' operation   { $$ = build_binary(p, OP_GREATER, $1, $3); }
  | operation ">=" operation  { $$ = build_binary(p, OP_GREATER_EQUAL, $1, $3); }
  | operation "<<" operation  { $$ = build_binary(p, OP_SHIFT_LEFT, $1, $3); }
  | operation ">>" operation  { $$ = build_binary(p, OP_SHIFT_RIGHT, $1, $3); }
  | operation '+' operation   { $$ = build_binary(p, OP_ADD, $1, $3); }
  | operation '-' operation   { $$ = build_binary(p, OP_SUBTRACT, $1, $3); }
  | operation '*' operation   { $$ = build_binary(p, OP_MULTIPLY, $1, $3); }
  | operation '/' operation   { $$ = build_binary(p, OP_DIVIDE, $1, $3); }
  | operation '%' operation   { $$ = build_binary(p, OP_REMAINDER, $1, $3); }
  ;
postfix:
    primary
  | postfix '.' name                      { $$ = build_member(p, $1, $3); }
  | postfix '.' name '(' ')'
    { $$ = build_member_call(p, $1, $3, (tree_expressions){0}, @$); }
  | postfix '.' name '(' expressions ')'  { $$ = build_member_call(p, $1, $3, $5, @$); }
  ;
primary:
    VALUE | STRING | TRUE | FALSE
  | name                      { $$ = build_name(p, $1); }
  | ATTRIBUTE                 { $$ = build_attribute(p, (tree_name){0}, $1, @$); }
  | name ATTRIBUTE            { $$ = build_attribute(p, $1, $2, @$); }
  | name '(' ')'              { $$ = build_call(p, $1, (tree_expressions){0}, @$); }
  | name '(' expressions ')'  { $$ = build_call(p, $1, $3, @$); }
  | '(' expression ')'        { $$ = $2; $$->parenthesised = true; $$->span = @$; }
  | '(' error ')'             { $$ = build_expression(p, EXPR_ERROR, @$); }
  | BRACKETS                  { $$ = build_list(p, (tree_expressions){0}, @$); }
  | '[' expressions ']'       { $$ = build_list(p, $2, @$); }
  | '[' error ']'             { $$ = build_expression(p, EXPR_ERROR, @$); }
  ;
expressions:
    expression                  { $$ = (tree_expressions){0}; ADD($$, $1); }
  | expressions comma expression  { $$ = $1; ADD($$, $3); }
  | expressions comma error       { $$ = $1; ADD($$, build_expression(p, EXPR_ERROR, @3)); }
  ;

/* ---- parameters and gates -------------------------------------------------------------------- */

declared:
    name ':' type                 { $$ = build_parameter(p, $1, $3, NULL, @$); }
  | name ':' type '=' expression  { $$ = build_parameter(p, $1, $3, $5, @$); }
  | name ':' type '=' bad_value   { $$ = build_parameter(p, $1, $3, $5, @$); }
  | declared constraint { $$ = $1; $$->head.span = @$; ADD($$->constraints, $2); }
  ;
constraint:
    RANGE '[' expressions ']'    { $$ = build_constraint(CONSTRAINT_RANGE, $3, @$); }
  | ONE OF '(' expressions ')'   { $$ = build_constraint(CONSTRAINT_ONE_OF, $4, @$); }
  | MATCHES STRING
    { $$ = build_constraint(CONSTRAINT_MATCHES, build_operands(p, $2), @$); }
  | AT MOST operation CHARACTERS
    { $$ = build_constraint(CONSTRAINT_AT_MOST, build_operands(p, $3), @$); }
  ;
declared_list:
    declared                    { $$ = (tree_parameters){0}; ADD($$, $1); }
  | error                       { $$ = (tree_parameters){0}; }
  | declared_list comma declared  { $$ = $1; ADD($$, $3); }
  | declared_list comma error
  ;
constant:
    name '=' expression  { $$ = build_parameter(p, $1, NULL, $3, @$); }
  | name '=' bad_value   { $$ = build_parameter(p, $1, NULL, $3, @$); }
  ;
gate: name ':' type { $$ = build_gate(p, $1, $3, @$); } ;
input: gate | gate '=' chain { $$ = $1; $$->head.span = @$; $$->stand_in = $3; } ;
output: gate | gate '=' '*' { $$ = $1; $$->head.span = @$; $$->gathers = true; } ;
gates:
    gate            { $$ = (tree_gates){0}; ADD($$, $1); }
  | error           { $$ = (tree_gates){0}; }
  | gates comma gate  { $$ = $1; ADD($$, $3); }
  | gates comma error
  ;

/* ---- chains ---------------------------------------------------------------------------------- */

arguments: '(' ')' { $$ = (tree_arguments){0}; } | '(' argument_list ')' { $$ = $2; } ;
argument_list:
    argument                         { $$ = (tree_arguments){0}; ADD($$, $1); }
  | bad_argument                     { $$ = (tree_arguments){0}; }
  | argument_list comma argument       { $$ = $1; ADD($$, $3); }
  | argument_list comma bad_argument
  ;
argument:
    expression
    { $$ = build_argument(ARGUMENT_VALUE, (tree_name){0}, $1, (tree_name){0}, @$); }
  | name '=' expression  { $$ = build_argument(ARGUMENT_VALUE, $1, $3, (tree_name){0}, @$); }
  | link_to
  ;
link_to:
    name "=>" ATTRIBUTE   { $$ = build_argument(ARGUMENT_WRITE, $1, NULL, $3, @$); }
  | name "<=>" ATTRIBUTE  { $$ = build_argument(ARGUMENT_SHARE, $1, NULL, $3, @$); }
  | name "=>" name        { $$ = build_bare_link(p, ARGUMENT_WRITE, $1, $3, @$); }
  | name "<=>" name       { $$ = build_bare_link(p, ARGUMENT_SHARE, $1, $3, @$); }
  ;
bad_argument: error | bad_argument '(' skipped_inside ')' | bad_argument '[' skipped_inside ']' ;
skipped_inside: %empty | skipped_inside skip_inside
  | skipped_inside '(' skipped_inside ')' | skipped_inside '[' skipped_inside ']' ;
skip_inside: skip_anywhere | ';' ;

path:
    name           { $$ = build_reference(p, $1, (tree_name){0}, @$); }
  | name '.' name  { $$ = build_reference(p, $1, $3, @$); }
  ;
call:
    arguments
    { $$ = ARENA_NEW(p->arena, tree_element); $$->arguments = $1; $$->has_parentheses = true; }
  | arguments body
    { $$ = ARENA_NEW(p->arena, tree_element); $$->arguments = $1; $$->has_parentheses = true;
      $$->body = $2; }
  | body { $$ = ARENA_NEW(p->arena, tree_element); $$->body = $1; }
  ;
element:
    path                { $$ = $1; }
  | path call           { $$ = build_node(p, (tree_name){0}, $1, $2, @$); }
  | name ':' path       { $$ = build_node(p, $1, $3, NULL, @$); }
  | name ':' path call  { $$ = build_node(p, $1, $3, $4, @$); }
  ;
arrow: ARROW { $$ = (tree_arrow){@1, false}; } | DISABLED { $$ = (tree_arrow){@1, true}; } ;
links:
    element              { $$ = build_chain(p, $1); }
  | links arrow element  { $$ = $1; build_link(p, $$, $2, $3); $$->span = @$; }
  | links arrow error    { $$ = $1; build_link(p, $$, $2, NULL); }
  | links arrow error '{' skipped '}'  { $$ = $1; build_link(p, $$, $2, NULL); }
  ;
condition: IF expression { $$ = $2; } | IF bad_value { $$ = $2; } ;
chain: links | links condition { $$ = $1; $$->condition = $2; $$->span = @$; } ;

augmentation:
    name                     { $$ = build_augmentation(p, (tree_name){0}, $1, NULL, @$); }
  | name arguments           { $$ = build_augmentation(p, (tree_name){0}, $1, &$2, @$); }
  | name ':' name            { $$ = build_augmentation(p, $1, $3, NULL, @$); }
  | name ':' name arguments  { $$ = build_augmentation(p, $1, $3, &$4, @$); }
  ;
body:
    '{' body_open '}'  { $$ = $2; $$->span = @$; }
  | '{' body_full '}'  { $$ = $2; $$->span = @$; }
  ;
body_open:
    %empty { $$ = ARENA_NEW(p->arena, tree_body); }
  | body_open separator
  | body_full separator
  ;
body_full:
    body_open augmentation    { $$ = $1; ADD($$->augmentations, $2); }
  | body_open IN gate         { $$ = $1; begin(&$3->head, @2); ADD($$->inputs, $3); }
  | body_open OUT output      { $$ = $1; begin(&$3->head, @2); ADD($$->outputs, $3); }
  | body_open PARAM declared  { $$ = $1; begin(&$3->head, @2); ADD($$->parameters, $3); }
  | body_open ATTR declared   { $$ = $1; begin(&$3->head, @2); ADD($$->attributes, $3); }
  | body_open LOOP loop       { $$ = $1; begin(&$3->head, @2); ADD($$->loops, $3); }
  | body_open bad
  | body_full bad
  ;
loop: name ARROW name
    { $$ = ARENA_NEW(p->arena, tree_loop); $$->head.span = @$; $$->from = $1; $$->to = $3; } ;

/* ---- graphs, imports ------------------------------------------------------------------------- */

import: IMPORT imported FROM STRING
    { $$ = $2; $$->head.span = @$; $$->path = $4->string; $$->path_span = @4; } ;
imported:
    name alias
    { struct tree_imported one = {$1, $2};
      $$ = ARENA_NEW(p->arena, tree_import); ADD($$->names, one); }
  | imported comma name alias { struct tree_imported one = {$3, $4}; $$ = $1; ADD($$->names, one); }
  ;
alias: %empty { $$ = (tree_name){0}; } | AS name { $$ = $2; } ;
use: USE name alias
    { $$ = ARENA_NEW(p->arena, tree_use); $$->head.span = @$; $$->library = $2; $$->alias = $3; } ;

graph:
    GRAPH name '{' members_open '}'  { $$ = $4; $$->name = $2; $$->head.span = @$; }
  | GRAPH name '{' members_full '}'  { $$ = $4; $$->name = $2; $$->head.span = @$; }
  | NAME name '{' members_open '}'
    { build_unknown_item(p, $1); $$ = $4; $$->name = $2; $$->head.span = @$; }
  | NAME name '{' members_full '}'
    { build_unknown_item(p, $1); $$ = $4; $$->name = $2; $$->head.span = @$; }
  ;
members_open:
    %empty { $$ = ARENA_NEW(p->arena, tree_graph); }
  | members_open separator
  | members_full separator
  ;
members_full:
    members_open PARAM declared
    { $$ = $1; build_parameter_member(p, $$, MEMBER_PARAMETER, $3, @2); }
  | members_open HIDDEN PARAM declared
    { $$ = $1; $4->hidden = true; build_parameter_member(p, $$, MEMBER_PARAMETER, $4, @2); }
  | members_open CONST constant
    { $$ = $1; build_parameter_member(p, $$, MEMBER_CONSTANT, $3, @2); }
  | members_open ATTR declared
    { $$ = $1; build_parameter_member(p, $$, MEMBER_ATTRIBUTE, $3, @2); }
  | members_open IN input               { $$ = $1; build_gate_member(p, $$, MEMBER_INPUT, $3, @2); }
  | members_open OUT output
    { $$ = $1; build_gate_member(p, $$, MEMBER_OUTPUT, $3, @2); }
  | members_open BLOCK path             { $$ = $1; build_block_member(p, $$, $3, NULL, @2); }
  | members_open BLOCK path condition   { $$ = $1; build_block_member(p, $$, $3, $4, @2); }
  | members_open chain                  { $$ = $1; build_chain_member(p, $$, $2); }
  | members_open bad
  | members_full bad
  ;

/* ---- interfaces ------------------------------------------------------------------------------ */

variables: %empty { $$ = NULL; } | '<' variable_list '>' { $$ = $2; } ;
variable_list:
    variable                    { $$ = ARENA_NEW(p->arena, variable_list); ADD(*$$, $1); }
  | variable_list comma variable  { $$ = $1; ADD(*$$, $3); }
  ;
variable:
    name           { $$ = (tree_variable){.name = $1}; }
  | name ':' name  { $$ = (tree_variable){$1, $3}; }
  ;
gate_list: '(' ')' { $$ = (tree_gates){0}; } | '(' gates ')' { $$ = $2; } ;
outputs: %empty { $$ = (tree_gates){0}; } | ARROW gate_list { $$ = $2; } ;
traits: %empty { $$ = (tree_names){0}; } | '[' names ']' { $$ = $2; } ;

procedure:
    PROCEDURE name variables gate_list outputs traits procedure_braces
    { $$ = $7; $$->head.span = @$; $$->name = $2; build_variables(p, &$$->variables, $3);
      $$->inputs = $4; $$->outputs = $5; $$->traits = $6; }
  ;
procedure_braces:
    %empty                  { $$ = ARENA_NEW(p->arena, tree_procedure); }
  | '{' procedure_open '}'  { $$ = $2; }
  | '{' procedure_full '}'  { $$ = $2; }
  ;
procedure_open:
    %empty { $$ = ARENA_NEW(p->arena, tree_procedure); }
  | procedure_open separator
  | procedure_full separator
  ;
procedure_full:
    procedure_open PARAM declared   { $$ = $1; begin(&$3->head, @2); ADD($$->parameters, $3); }
  | procedure_open HIDDEN PARAM declared
    { $$ = $1; begin(&$4->head, @2); $4->hidden = true; ADD($$->parameters, $4); }
  | procedure_open ATTR declared    { $$ = $1; begin(&$3->head, @2); ADD($$->attributes, $3); }
  | procedure_open AUGMENT augment  { $$ = $1; begin(&$3->head, @2); ADD($$->augments, $3); }
  | procedure_open EXAMPLE example  { $$ = $1; begin(&$3->head, @2); ADD($$->examples, $3); }
  | procedure_open FORMERLY names   { $$ = $1; build_names(p, &$$->former, $3); }
  | procedure_open CATEGORY string  { $$ = $1; $$->category = $3; }
  | procedure_open SYNONYMS strings { $$ = $1; build_names(p, &$$->synonyms, $3); }
  | procedure_open bad
  | procedure_full bad
  ;

augment:
    name flow { $$ = $2; $$->name = $1; $$->head.span = @$; }
  | name '(' ')' flow { $$ = $4; $$->name = $1; $$->head.span = @$; }
  | name '(' augment_parts ')' flow
    { $$ = $5; $$->name = $1; $$->head.span = @$;
      $$->parameters = $3->parameters; $$->attributes = $3->attributes; }
  ;
augment_parts:
    declared       { $$ = ARENA_NEW(p->arena, tree_augment); ADD($$->parameters, $1); }
  | ATTR declared
    { $$ = ARENA_NEW(p->arena, tree_augment); begin(&$2->head, @1); ADD($$->attributes, $2); }
  | error          { $$ = ARENA_NEW(p->arena, tree_augment); }
  | augment_parts comma declared       { $$ = $1; ADD($$->parameters, $3); }
  | augment_parts comma ATTR declared  { $$ = $1; begin(&$4->head, @3); ADD($$->attributes, $4); }
  | augment_parts comma error
  ;
flow:
    %empty        { $$ = ARENA_NEW(p->arena, tree_augment); }
  | ARROW type    { $$ = ARENA_NEW(p->arena, tree_augment); $$->output = $2; }
  | '<' '-' type  { $$ = ARENA_NEW(p->arena, tree_augment); $$->input = $3; }
  ;

example:
    example_chains EXPECT expectations
    { $$ = $1; $$->expectations = $3; $$->head.span = @$; }
  ;
example_chains:
    chain            { $$ = ARENA_NEW(p->arena, tree_example); ADD($$->chains, $1); }
  | example_chains ';' chain          { $$ = $1; ADD($$->chains, $3); }
  | example_chains ';' NEWLINE chain  { $$ = $1; ADD($$->chains, $4); }
  ;
expectations:
    expectation                     { $$ = (tree_arguments){0}; ADD($$, $1); }
  | expectations comma expectation  { $$ = $1; ADD($$, $3); }
  ;
expectation: dotted '=' expression
    { $$ = build_argument(ARGUMENT_VALUE, $1, $3, (tree_name){0}, @$); } ;
dotted: name | dotted '.' name { $$ = build_dotted(p, $1, $3, @$); } ;

function:
    FUNCTION name variables '(' ')' ARROW type traits function_braces
    { $$ = $9; $$->head.span = @$; $$->name = $2; build_variables(p, &$$->variables, $3);
      $$->result = $7; $$->traits = $8; }
  | FUNCTION name variables '(' declared_list ')' ARROW type traits function_braces
    { $$ = $10; $$->head.span = @$; $$->name = $2; build_variables(p, &$$->variables, $3);
      $$->parameters = $5; $$->result = $8; $$->traits = $9; }
  ;
function_braces:
    %empty                 { $$ = ARENA_NEW(p->arena, tree_function); }
  | '{' function_open '}'  { $$ = $2; }
  | '{' function_full '}'  { $$ = $2; }
  ;
function_open:
    %empty { $$ = ARENA_NEW(p->arena, tree_function); }
  | function_open separator
  | function_full separator
  ;
function_full:
    function_open EXAMPLE expression  { $$ = $1; ADD($$->examples, $3); }
  | function_open bad
  | function_full bad
  ;

entity:
    ENTITY name entity_parent entity_braces
    { $$ = $4; $$->head.span = @$; $$->name = $2; $$->parent = $3; }
  ;
entity_parent: %empty { $$ = (tree_name){0}; } | ':' name { $$ = $2; } ;
entity_braces:
    %empty               { $$ = ARENA_NEW(p->arena, tree_entity); }
  | '{' entity_open '}'  { $$ = $2; }
  | '{' entity_full '}'  { $$ = $2; }
  ;
entity_open:
    %empty { $$ = ARENA_NEW(p->arena, tree_entity); }
  | entity_open separator
  | entity_full separator
  ;
entity_full:
    entity_open ATTR declared  { $$ = $1; begin(&$3->head, @2); ADD($$->attributes, $3); }
  | entity_open bad
  | entity_full bad
  ;

enumeration:
    ENUM name '{' enumerators_open '}'  { $$ = $4; $$->head.span = @$; $$->name = $2; }
  | ENUM name '{' enumerators_full '}'  { $$ = $4; $$->head.span = @$; $$->name = $2; }
  ;
enumerators_open:
    %empty { $$ = ARENA_NEW(p->arena, tree_enumeration); }
  | enumerators_open separator
  | enumerators_full separator
  | enumerators_full comma
  ;
enumerators_full:
    enumerators_open name
    { tree_enumerator one = {.head.span = @2, .name = $2}; $$ = $1; ADD($$->enumerators, one); }
  | enumerators_open bad
  | enumerators_full bad
  ;

%%

/* Called where the stack is full; syntax errors go to yyreport_syntax_error. */
static void grammar_error(const span *at, parser *p, const char *message)
{
    (void)message;
    syntax_too_deep(p, *at, LANG_MAX_DEPTH);
}

static int yyreport_syntax_error(const yypcontext_t *context, parser *p)
{
    yysymbol_kind_t symbols[SYNTAX_MAX_EXPECTED];
    const char *names[SYNTAX_MAX_EXPECTED];
    int count = yypcontext_expected_tokens(context, symbols, SYNTAX_MAX_EXPECTED);
    for (int i = 0; i < count; i++)
        names[i] = yysymbol_name(symbols[i]);
    syntax_error(p, *yypcontext_location(context), names, count);
    return 0;
}

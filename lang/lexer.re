/* lexer.re - text to lexemes. Keeps no state, so that what stands ahead can be looked at at will. */
#include "parser.h"

#include "grammar.h"

#include <string.h>

/* Behind the end of C's comment, or the end of the text. */
static const unsigned char *skip_block_comment(const unsigned char *at, const unsigned char *end)
{
    while (at < end && !(at[0] == '*' && at[1] == '/'))
        at++;
    return at < end ? at + 2 : end;
}

/* The text holds no NUL but the one behind its end (parse.c sees to it), so the NUL is the end. */
lexeme lex(const source *s, uint32_t at)
{
    const unsigned char *first = (const unsigned char *)s->text;
    const unsigned char *YYCURSOR = first + at, *YYMARKER, *begin;
    int kind;
    if (at == 0 && memcmp(first, "\xEF\xBB\xBF", s->size < 3 ? s->size + 1 : 3) == 0)
        YYCURSOR += 3; /* a byte order mark */
again:
    begin = YYCURSOR;
    /*!re2c
    re2c:define:YYCTYPE = "unsigned char";
    re2c:yyfill:enable = 0;

    letter  = [A-Za-z_];
    digit   = [0-9];
    word    = letter (letter | digit)*;
    foreign = (letter | [\x80-\xFF]) (letter | digit | [\x80-\xFF])*;
    number  = digit+ ("." digit+)? ([eE] [-+]? digit+)? | "." digit+ ([eE] [-+]? digit+)?;
    quoted  = "'" [^'\n\x00]* "'";
    braced  = "{" [^}\n\x00]* "}";
    string  = ["] ([^"\\\n\x00] | "\\" [^\n\x00])*;
    operand = [A-Za-z0-9_(@$"'#[.];

    [ \t\r\f\v]+    { goto again; }
    "\x00"          { YYCURSOR = begin; kind = T_END; goto done; }
    "\n"            { kind = LEX_NEWLINE; goto done; }
    "//" [^\n\x00]* { kind = LEX_COMMENT; goto done; }
    "/*"            { YYCURSOR = skip_block_comment(YYCURSOR, first + s->size);
                      kind = LEX_BLOCK_COMMENT; goto done; }

    "import"     { kind = T_IMPORT; goto done; }
    "from"       { kind = T_FROM; goto done; }
    "as"         { kind = T_AS; goto done; }
    "use"        { kind = T_USE; goto done; }
    "graph"      { kind = T_GRAPH; goto done; }
    "hidden"     { kind = T_HIDDEN; goto done; }
    "param"      { kind = T_PARAM; goto done; }
    "const"      { kind = T_CONST; goto done; }
    "attr"       { kind = T_ATTR; goto done; }
    "in"         { kind = T_IN; goto done; }
    "out"        { kind = T_OUT; goto done; }
    "block"      { kind = T_BLOCK; goto done; }
    "loop"       { kind = T_LOOP; goto done; }
    "range"      { kind = T_RANGE; goto done; }
    "one"        { kind = T_ONE; goto done; }
    "of"         { kind = T_OF; goto done; }
    "matches"    { kind = T_MATCHES; goto done; }
    "at"         { kind = T_AT; goto done; }
    "most"       { kind = T_MOST; goto done; }
    "characters" { kind = T_CHARACTERS; goto done; }
    "procedure"  { kind = T_PROCEDURE; goto done; }
    "function"   { kind = T_FUNCTION; goto done; }
    "entity"     { kind = T_ENTITY; goto done; }
    "enum"       { kind = T_ENUM; goto done; }
    "augment"    { kind = T_AUGMENT; goto done; }
    "example"    { kind = T_EXAMPLE; goto done; }
    "expect"     { kind = T_EXPECT; goto done; }
    "formerly"   { kind = T_FORMERLY; goto done; }
    "category"   { kind = T_CATEGORY; goto done; }
    "synonyms"   { kind = T_SYNONYMS; goto done; }
    "if"         { kind = T_IF; goto done; }
    "true"       { kind = T_TRUE; goto done; }
    "false"      { kind = T_FALSE; goto done; }

    word              { kind = T_NAME; goto done; }
    foreign           { kind = LEX_FOREIGN_NAME; goto done; }
    quoted            { kind = T_NAME; goto done; }
    "'" [^'\n\x00]*   { kind = LEX_OPEN_NAME; goto done; }
    "@" word          { kind = T_ATTRIBUTE; goto done; }
    "@" quoted        { kind = T_ATTRIBUTE; goto done; }
    "@" braced        { kind = LEX_REFERENCE; goto done; }
    "$" braced        { kind = LEX_REFERENCE; goto done; }
    "$" braced braced { kind = LEX_REFERENCE; goto done; }

    number               { kind = LEX_NUMBER; goto done; }
    number word          { kind = LEX_NUMBER; goto done; }
    number "%" / operand { YYCURSOR--; kind = LEX_NUMBER; goto done; }
    number "%"           { kind = LEX_NUMBER; goto done; }
    "#" (letter | digit)* { kind = LEX_COLOR; goto done; }
    string ["]           { kind = T_STRING; goto done; }
    string "\\"?         { kind = LEX_OPEN_STRING; goto done; }

    "->"  { kind = T_ARROW; goto done; }
    "-/>" { kind = T_DISABLED; goto done; }
    "=>"  { kind = T_WRITE; goto done; }
    "<=>" { kind = T_SHARE; goto done; }
    "<="  { kind = T_LESS_EQUAL; goto done; }
    ">="  { kind = T_GREATER_EQUAL; goto done; }
    "=="  { kind = T_EQUAL; goto done; }
    "!="  { kind = T_NOT_EQUAL; goto done; }
    "<<"  { kind = T_SHIFT_LEFT; goto done; }
    ">>"  { kind = T_SHIFT_RIGHT; goto done; }
    "&&"  { kind = T_AND; goto done; }
    "||"  { kind = T_OR; goto done; }
    "[" [ \t]* "]" { kind = T_BRACKETS; goto done; }
    [-+*/%<>=!~&|^?:.,;(){}] | "[" | "]" { kind = *begin; goto done; }

    *            { kind = LEX_BAD_CHARACTER; goto done; }
    */
done:
    return (lexeme){kind, (uint32_t)(begin - first), (uint32_t)(YYCURSOR - first)};
}

/* layout.c - from lexemes to the grammar's tokens: which line ends count, comments put aside,
 * brackets that the text leaves open closed where it becomes plain, so that one mistake is one
 * message. */
#include "parser.h"

#include "grammar.h"

#include <string.h>

span parser_span(const parser *p, uint32_t from, uint32_t to)
{
    return (span){p->source, from, to};
}

static span span_of(const parser *p, lexeme l)
{
    return parser_span(p, l.from, l.to);
}

/* ---- comments -----------------------------------------------------------------------------------
 */

/* Only blanks stand before it on its line. */
static bool begins_line(const source *s, uint32_t at)
{
    while (at && (s->text[at - 1] == ' ' || s->text[at - 1] == '\t'))
        at--;
    return !at || s->text[at - 1] == '\n' || (at == 3 && memcmp(s->text, "\xEF\xBB\xBF", 3) == 0);
}

/* An empty line, or the text's beginning, stands before the line of `at`; `at` is the first thing
 * on it. */
static bool blank_line_before(const source *s, uint32_t at)
{
    int line_ends = 0;
    for (; at && strchr(" \t\r\n", s->text[at - 1]); at--)
        line_ends += s->text[at - 1] == '\n';
    return line_ends >= 2;
}

static void keep_comment(parser *p, lexeme l)
{
    const char *slashes = p->source->text + l.from;
    uint32_t from = l.from + 2, to = l.to;
    tree_comment c = {.span = span_of(p, l), .kind = COMMENT_PLAIN};
    if (slashes[2] == '!')
        c.kind = COMMENT_DOCUMENT_FILE;
    else if (slashes[2] == '/' && slashes[3] != '/')
        c.kind = COMMENT_DOCUMENT;
    from += c.kind != COMMENT_PLAIN;
    while (to > from && strchr(" \t\r", p->source->text[to - 1]))
        to--;
    c.text = arena_copy(p->arena, p->source->text + from, to - from);
    c.trailing = !begins_line(p->source, l.from);
    c.blank_before = !c.trailing && blank_line_before(p->source, l.from);
    LIST_ADD(p->arena, &p->comments, c);
}

/* ---- what a token is ------------------------------------------------------------------------- */

static bool is_arrow(int kind)
{
    return kind == T_ARROW || kind == T_DISABLED;
}

static bool is_name(int kind)
{
    return kind == T_NAME || kind == LEX_FOREIGN_NAME || (kind >= T_IMPORT && kind <= T_SYNONYMS);
}

static bool is_item_word(int kind)
{
    return kind == T_IMPORT || kind == T_USE || kind == T_GRAPH ||
           (kind >= T_PROCEDURE && kind <= T_ENUM);
}

/* Words that begin a statement when a name follows. Not attr, which may stand in an augmentation's
 * parentheses. */
static bool is_statement_word(int kind)
{
    return is_item_word(kind) || (kind >= T_HIDDEN && kind <= T_CONST) ||
           (kind >= T_IN && kind <= T_LOOP) || kind == T_AUGMENT || kind == T_EXAMPLE;
}

/* The next lexeme but comments. */
static lexeme next_lexeme(parser *p, uint32_t at)
{
    lexeme l = lex(p->source, at);
    while (l.kind == LEX_COMMENT)
        l = lex(p->source, l.to);
    return l;
}

/* An arrow that leads somewhere; before an attribute it is rather a link that was meant. */
static bool leads_on(parser *p, lexeme l)
{
    return is_arrow(l.kind) && next_lexeme(p, l.to).kind != T_ATTRIBUTE;
}

/* The lexeme, first on its line, begins a statement: a word and a name, or a name and an arrow. */
static bool begins_statement(parser *p, lexeme l)
{
    lexeme next = next_lexeme(p, l.to);
    bool named =
        is_name(next.kind) || next.kind == T_TRUE || next.kind == T_FALSE || next.kind == T_IF;
    if (is_statement_word(l.kind) && named)
        return true;
    if (!is_name(l.kind))
        return false;
    if (next.kind == '.')
        next = next_lexeme(p, next_lexeme(p, next.to).to);
    return leads_on(p, next);
}

/* ---- brackets -------------------------------------------------------------------------------- */

static char innermost(const parser *p)
{
    return p->depth ? p->open[p->depth - 1].kind : '\0';
}

/* Line ends count in braces and outside everything. */
static bool in_parentheses(const parser *p)
{
    return innermost(p) == '(' || innermost(p) == '[';
}

static char closer_of(char kind)
{
    return kind == '(' ? ')' : kind == '[' ? ']' : '}';
}

/* A [ below the innermost (, or the other way round, without a brace between. */
static bool is_open_in_statement(const parser *p, char kind)
{
    for (uint32_t i = p->depth; i && p->open[i - 1].kind != '{'; i--)
        if (p->open[i - 1].kind == kind)
            return true;
    return false;
}

/* Before this lexeme the innermost bracket must have been closed, whatever it is. */
static bool must_be_closed(parser *p, lexeme l)
{
    if (!p->depth)
        return false;
    if (!in_parentheses(p)) {
        bool at_margin = l.from == 0 || p->source->text[l.from - 1] == '\n';
        return l.kind == T_END ||
               (at_margin && is_item_word(l.kind) && is_name(next_lexeme(p, l.to).kind));
    }
    if (l.kind == T_END || l.kind == '{' || l.kind == '}' || leads_on(p, l))
        return true;
    if (l.kind == ')' && innermost(p) == '[')
        return is_open_in_statement(p, '(');
    if (l.kind == ']' && innermost(p) == '(')
        return is_open_in_statement(p, '[');
    return p->line_began && begins_statement(p, l);
}

static void open_bracket(parser *p, lexeme l)
{
    if (p->depth == LANG_MAX_NESTING)
        syntax_too_deep(p, span_of(p, l), LANG_MAX_NESTING);
    else
        p->open[p->depth++] = (bracket){
            .kind = (char)l.kind, .closer = closer_of((char)l.kind), .at = l.from};
}

static void follow_brackets(parser *p, lexeme l)
{
    if (l.kind == '(' || l.kind == '[' || l.kind == '{')
        open_bracket(p, l);
    else if (p->depth && l.kind == closer_of(innermost(p)))
        p->depth--;
    else
        p->unmatched = l.kind == ')' || l.kind == ']';
}

/* In list<list<int>> each > is a token of its own. A < opens a type when it stands right behind the
 * word list. */
static void follow_types(parser *p, lexeme *l)
{
    const char *bytes = p->source->text;
    if (p->types && (l->kind == T_SHIFT_RIGHT || l->kind == T_GREATER_EQUAL)) {
        l->kind = '>';
        l->to = l->from + 1;
    }
    if (l->kind == '<' && p->previous.kind == T_NAME && p->previous.to == l->from &&
        p->previous.to - p->previous.from == 4 && memcmp(bytes + p->previous.from, "list", 4) == 0)
        p->types++;
    else if (l->kind == '>' && p->types)
        p->types--;
    else if (!is_name(l->kind) && l->kind != T_BRACKETS)
        p->types = 0;
}

/* ---- line ends ------------------------------------------------------------------------------- */

/* A line end stands before this lexeme: does it end a statement? Reports what stands on the wrong
 * line. */
static bool ends_statement(parser *p, lexeme l)
{
    if (p->previous.kind == T_NEWLINE || in_parentheses(p))
        return false;
    if (is_arrow(l.kind) && p->previous.kind != '{' && p->previous.kind != ';' && p->previous.to)
        return false;
    if (is_arrow(p->previous.kind) && l.kind != '}' && l.kind != T_END) {
        diagnose(p->diagnostics, DIAG_E0019, span_of(p, p->previous))->help =
            "an arrow at the beginning of a line goes on with the line before";
        return false;
    }
    if (l.kind == '{' &&
        (is_name(p->previous.kind) || p->previous.kind == ')' || p->previous.kind == ']')) {
        diagnose(p->diagnostics, DIAG_E0020, span_of(p, l));
        return false;
    }
    return true;
}

/* ---- tokens ---------------------------------------------------------------------------------- */

static void hand_on(parser *p, lexeme l, span *at)
{
    *at = span_of(p, l);
    p->before = p->previous;
    p->previous = l;
    p->line_began = false;
}

/* A token that the text does not hold, behind the last one that it does. */
static int make_up(parser *p, int kind, span *at)
{
    lexeme l = {kind, p->previous.to, p->previous.to};
    bool began = p->line_began;
    p->made_up = kind != T_NEWLINE;
    hand_on(p, l, at);
    p->line_began = began && kind != T_NEWLINE;
    return kind;
}

static int close_bracket(parser *p, span *at)
{
    bracket b = p->open[--p->depth];
    if (!p->stopped && !b.made_up)
        syntax_unclosed(p, b);
    make_up(p, closer_of(b.kind), at);
    if (b.kind == '{') {
        p->braces_made_up++;
        p->line_began = true; /* what it closed ends here */
    }
    return p->previous.kind;
}

/* ---- what other languages write -------------------------------------------------------------- */

/* A # that begins no colour: with a blank behind it, or where no value can stand. */
static bool begins_hash_comment(const parser *p, lexeme l)
{
    int before = p->previous.kind;
    bool behind_end = before == ')' || before == '}' || before == '{' || before == ';';
    bool operand = before > 0 && before < 128 && strchr("=+-*/%<>&|^?!~", before);
    return (l.to - l.from == 1 && !operand) ||
           (!in_parentheses(p) && (behind_end || begins_line(p->source, l.from)));
}

/* The rest of the line is none of the language: reports it, and moves *l to its end. */
static void skip_hash_comment(parser *p, lexeme *l)
{
    const char *end = memchr(p->source->text + l->from, '\n', p->source->size - l->from);
    diagnose(p->diagnostics, DIAG_E0025, parser_span(p, l->from, l->from + 1))->help =
        "comments begin with // and end with the line";
    l->to = end ? (uint32_t)(end - p->source->text) : (uint32_t)p->source->size;
}

/* Arrows as other programs set them, which stand for '->'. */
static bool is_arrow_sign(const parser *p, lexeme l)
{
    static const char *const signs[] = {"\u2192", "\u21d2", "\u27f6"};
    for (size_t i = 0; i < COUNT_OF(signs) && l.kind == LEX_FOREIGN_NAME && l.to - l.from == 3; i++)
        if (!memcmp(p->source->text + l.from, signs[i], 3))
            return true;
    return false;
}

static void report_arrow_sign(parser *p, lexeme l)
{
    diagnose(p->diagnostics, DIAG_E0001, span_of(p, l), syntax_quote(p, span_of(p, l)))->help =
        "an edge is written '->'";
}

/* The line declares something: a word such as param, and a name. */
static bool line_declares(const parser *p, uint32_t at)
{
    while (at && p->source->text[at - 1] != '\n')
        at--;
    lexeme first = lex(p->source, at);
    return is_statement_word(first.kind) && is_name(lex(p->source, first.to).kind);
}

/* A [ where only { can stand: behind the name of a node or graph. */
static bool stands_for_brace(const parser *p, lexeme l)
{
    if (l.kind != '[' || p->line_began || in_parentheses(p) || !is_name(p->previous.kind))
        return false;
    return p->depth ? !line_declares(p, l.from) : p->before.kind == T_GRAPH;
}

static void take_for_brace(parser *p, lexeme *l)
{
    bool graph = p->before.kind == T_GRAPH;
    diagnose(p->diagnostics, DIAG_E0010, span_of(p, *l), "'['", "'{'")->help =
        graph ? "a graph's statements stand in braces: graph name { … }"
              : "augmentations stand in braces: select { top; sides: all }";
    l->kind = '{';
}

/* `graph name` goes on with something else than a brace. */
static bool lacks_brace(const parser *p, lexeme l)
{
    return !p->depth && p->before.kind == T_GRAPH && is_name(p->previous.kind) &&
           p->previous.to && l.kind != '{' && (p->line_began || l.kind == ':' || l.kind == T_END);
}

/* Reports it, and opens the brace: what follows is the graph. */
static int open_missing_brace(parser *p, lexeme l, span *at)
{
    uint32_t end = p->previous.to;
    bool colon = l.kind == ':';
    span place = colon ? span_of(p, l) : parser_span(p, end, end);
    diagnose(p->diagnostics, DIAG_E0010, place, colon ? "':'" : "the end of the line", "'{'")
        ->help = "a graph's statements stand in braces: graph name { … }";
    if (colon)
        p->at = l.to;
    p->open[p->depth++] = (bracket){.kind = '{', .closer = '}', .made_up = true, .at = end};
    return make_up(p, '{', at);
}

/* ---- tokens, one by one ---------------------------------------------------------------------- */

/* Lexemes that are no tokens: keeps or reports them, and moves *lexeme_ to their end. False for a
 * token. */
static bool put_aside(parser *p, lexeme *lexeme_)
{
    lexeme l = *lexeme_;
    if (l.kind == LEX_COLOR && begins_hash_comment(p, l)) {
        skip_hash_comment(p, lexeme_);
        return true;
    }
    switch (l.kind) {
    case LEX_COMMENT:
        keep_comment(p, l);
        return true;
    case LEX_BLOCK_COMMENT:
        diagnose(p->diagnostics, DIAG_E0016, parser_span(p, l.from, l.from + 2))->help =
            "comments begin with // and end with the line";
        return true;
    case LEX_NEWLINE:
        p->line_began = true;
        return true;
    case LEX_BAD_CHARACTER:
        diagnose(p->diagnostics, DIAG_E0001, span_of(p, l), syntax_quote(p, span_of(p, l)))->help =
            "names are letters, digits and '_'; with anything else they are written 'like this'";
        return true;
    case '}':
        if (p->depth)
            return false;
        if (p->braces_made_up) {
            p->braces_made_up--;
            return true;
        }
        diagnose(p->diagnostics, DIAG_E0023, span_of(p, l), "'}'");
        return true;
    default:
        return false;
    }
}

static tree_expression *truth(parser *p, lexeme l)
{
    tree_expression *e = build_expression(p, EXPR_BOOL, span_of(p, l));
    e->boolean = l.kind == T_TRUE;
    return e;
}

/* What the lexeme means; the token that it is to the grammar. */
static int evaluate(parser *p, lexeme l, GRAMMAR_STYPE *value)
{
    span at = span_of(p, l);
    switch (l.kind) {
    case LEX_NUMBER:
        value->expression = literal_number(p, at);
        return T_VALUE;
    case LEX_COLOR:
        value->expression = literal_color(p, at);
        return T_VALUE;
    case LEX_REFERENCE:
        value->expression = literal_reference(p, at);
        return T_VALUE;
    case T_TRUE:
    case T_FALSE:
        value->expression = truth(p, l);
        return l.kind;
    case T_STRING:
    case LEX_OPEN_STRING:
        value->expression = literal_string(p, at, l.kind == T_STRING);
        return T_STRING;
    case LEX_OPEN_NAME:
        diagnose(p->diagnostics, DIAG_E0009, at);
        value->name = literal_name(p, at, 0);
        return T_NAME;
    case LEX_FOREIGN_NAME:
        value->name = literal_name(p, at, 0);
        diagnose(p->diagnostics, DIAG_E0024, at, syntax_quote(p, at))->help =
            "written in quotes, a name may hold any letter: 'like this'";
        return T_NAME;
    default:
        if (is_name(l.kind) || l.kind == T_ATTRIBUTE)
            value->name = literal_name(p, at, l.kind == T_ATTRIBUTE);
        return l.kind;
    }
}

int grammar_lex(GRAMMAR_STYPE *value, span *at, parser *p)
{
    lexeme l = lex(p->source, p->at);
    p->made_up = p->unmatched = false;
    while (!p->stopped && put_aside(p, &l)) {
        p->at = l.to;
        l = lex(p->source, p->at);
    }
    if (p->stopped)
        l = (lexeme){T_END, p->previous.to, p->previous.to};
    bool arrow_sign = is_arrow_sign(p, l);
    if (arrow_sign)
        l.kind = T_ARROW;
    if (!p->stopped && lacks_brace(p, l))
        return open_missing_brace(p, l, at);
    if (p->line_began && l.kind != T_END && ends_statement(p, l))
        return make_up(p, T_NEWLINE, at);
    if (must_be_closed(p, l))
        return close_bracket(p, at);
    if (arrow_sign)
        report_arrow_sign(p, l);
    if (stands_for_brace(p, l)) {
        take_for_brace(p, &l);
        follow_brackets(p, l);
        if (p->depth)
            p->open[p->depth - 1].closer = ']';
    } else {
        follow_types(p, &l);
        if (p->depth && innermost(p) == '{' && p->open[p->depth - 1].closer == l.kind)
            l.kind = '}';
        follow_brackets(p, l);
    }
    if (p->stopped && l.kind != T_END)
        return grammar_lex(value, at, p); /* once: what comes then is the end */
    p->at = l.to;
    hand_on(p, l, at);
    return evaluate(p, l, value);
}

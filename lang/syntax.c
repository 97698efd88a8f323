/* syntax.c - messages about syntax: what was found, what was expected, and what was likely meant.
 */
#include "parser.h"

#include "grammar.h"

#include <string.h>

enum { QUOTED = 40, LISTED = 4, LONGEST_LINE = 200 };

const char *syntax_quote(parser *p, span at)
{
    const char *bytes = p->source->text + at.from;
    uint32_t length = at.to - at.from;
    if (length <= QUOTED)
        return arena_format(p->arena, "'%.*s'", (int)length, bytes);
    length = QUOTED;
    while (length && ((unsigned char)bytes[length] & 0xC0) == 0x80)
        length--;
    return arena_format(p->arena, "'%.*s…'", (int)length, bytes);
}

/* ---- limits and brackets --------------------------------------------------------------------- */

void syntax_too_deep(parser *p, span at, int limit)
{
    if (!p->stopped)
        diagnose(p->diagnostics, DIAG_E0012, at, limit);
    p->stopped = true;
}

void syntax_unclosed(parser *p, bracket open)
{
    char closer = open.kind == '(' ? ')' : open.kind == '[' ? ']' : '}';
    diagnostic *d =
        diagnose(p->diagnostics, DIAG_E0014, parser_span(p, open.at, open.at + 1), open.kind);
    d->second.span = parser_span(p, p->previous.to, p->previous.to);
    d->second.text = arena_format(p->arena, "'%c' is missing here", closer);
}

/* ---- what was expected ----------------------------------------------------------------------- */

/* The tokens that would have been taken, by their names in the grammar. */
typedef struct expectation {
    const char *const *names;
    int count;
} expectation;

/* The bracket that the found token stands in, which it may itself have opened. */
static char innermost(const parser *p)
{
    uint32_t depth = p->depth;
    if (depth && p->open[depth - 1].at == p->previous.from)
        depth--;
    return depth ? p->open[depth - 1].kind : '\0';
}

static bool in_parentheses(const parser *p)
{
    return innermost(p) == '(' || innermost(p) == '[';
}

static bool expects(const expectation *e, const char *name)
{
    for (int i = 0; i < e->count; i++)
        if (strcmp(e->names[i], name) == 0)
            return true;
    return false;
}

/* What stands for the many tokens of a place; NULL where they are few. */
static const char *expected_at_large(const expectation *e)
{
    if (expects(e, "value"))
        return "a value";
    if (expects(e, "augment"))
        return expects(e, "name") ? NULL : "'param', 'attr', 'augment' or 'example'";
    if (expects(e, "graph") && !expects(e, "in"))
        return "'graph', 'import' or 'use'";
    return NULL;
}

/* Tokens that are not worth naming where another one can stand, too; "'*'" stands for all
 * operators. */
static bool is_implied(const expectation *e, const char *name)
{
    static const struct {
        const char *token, *by;
    } implied[] = {
        {"';'", "end of line"},
        {"'}'", "end of line"},
        {"end of file", "end of line"},
        {"expect", "end of line"},
        {"characters", "end of line"},
        {"characters", "','"},
        {"-/>", "->"},
        {"if", "->"},
        {"'{'", "->"},
        {"=>", "'='"},
        {"<=>", "'='"},
        {"[]", "'='"},
        {"'<'", "'='"},
        {"'['", "'='"},
        {"'>'", "'='"},
        {"'{'", "end of line"},
        {"'.'", "'*'"},
        {"'.'", "'('"},
        {"attribute", "'*'"},
        {"'('", "'*'"},
        {"'?'", "'*'"},
        {"':'", "'*'"},
    };
    static const char *const operators[] = {
        "'*'", "'/'", "'%'", "'+'", "'-'", "'<'", "'>'", "'&'", "'|'",
        "'^'", "<=",  ">=",  "==",  "!=",  "<<",  ">>",  "&&",  "||"};
    for (size_t i = 0; i < COUNT_OF(implied); i++)
        if (strcmp(name, implied[i].token) == 0 && expects(e, implied[i].by))
            return true;
    for (size_t i = 0; i < COUNT_OF(operators) && expects(e, "'*'") && expects(e, "'/'"); i++)
        if (strcmp(name, operators[i]) == 0)
            return true;
    return false;
}

/* The grammar's table takes some tokens for possible that the open brackets rule out. */
static bool fits_brackets(const parser *p, const expectation *e, const char *name)
{
    bool line_end = strcmp(name, "end of line") == 0 || strcmp(name, "->") == 0;
    if (strcmp(name, "')'") == 0)
        return innermost(p) == '(';
    if (strcmp(name, "']'") == 0)
        return innermost(p) == '[';
    if (strcmp(name, "','") == 0)
        return in_parentheses(p) || !expects(e, "end of line");
    return !line_end || !in_parentheses(p);
}

/* One token as a message calls it; NULL where it is not to be named. */
static const char *call_token(parser *p, const expectation *e, const char *name)
{
    static const struct {
        const char *token, *call;
    } calls[] = {
        {"name", "a name"},
        {"attribute", "an attribute (@name)"},
        {"string", "a string"},
        {"end of line", "the end of the line"},
        {"end of file", "the end of the file"},
        {"range", NULL},
        {"one", NULL},
        {"matches", NULL},
        {"at", NULL},
    };
    if (is_implied(e, name) || !fits_brackets(p, e, name))
        return NULL;
    for (size_t i = 0; i < COUNT_OF(calls); i++)
        if (strcmp(name, calls[i].token) == 0)
            return calls[i].call;
    return name[0] == '\'' ? name : arena_format(p->arena, "'%s'", name);
}

static bool is_word(const char *name)
{
    static const char *const others[] = {"name", "value", "string", "attribute",
                                         "true", "false", "if"};
    if (name[0] < 'a' || name[0] > 'z' || strchr(name, ' '))
        return false;
    for (size_t i = 0; i < COUNT_OF(others); i++)
        if (strcmp(name, others[i]) == 0)
            return false;
    return true;
}

/* "')' or ','"; NULL where that would be a long list. */
static const char *describe(parser *p, const expectation *e)
{
    const char *calls[LISTED];
    int count = 0;
    const char *large = expected_at_large(e);
    if (large)
        return large;
    if (expects(e, "name") && expects(e, "';'"))
        return p->before.kind >= T_IMPORT && p->before.kind <= T_SYNONYMS ? "a name"
                                                                          : "a statement";
    for (int i = 0; i < e->count; i++) {
        if (expects(e, "name") && is_word(e->names[i]))
            continue;
        const char *call = call_token(p, e, e->names[i]);
        if (call && count == LISTED)
            return NULL;
        if (call)
            calls[count++] = call;
    }
    text t = {.arena = p->arena};
    for (int i = 0; i < count; i++)
        text_format(&t, "%s%s", i == 0 ? "" : i + 1 < count ? ", " : " or ", calls[i]);
    return t.at;
}

/* ---- what was meant -------------------------------------------------------------------------- */

/* The place of an error: the token that was found, and the one before it. */
typedef struct slip {
    parser *p;
    lexeme found, before;
    expectation expected;
    const char *text, *help; /* the advice */
} slip;

static bool is_text(const slip *s, lexeme l, const char *word)
{
    return l.to - l.from == strlen(word) &&
           memcmp(s->p->source->text + l.from, word, l.to - l.from) == 0;
}

static bool is_any_name(int kind)
{
    return kind == T_NAME || (kind >= T_IMPORT && kind <= T_SYNONYMS);
}

static bool begins_value(int kind)
{
    return is_any_name(kind) || kind == LEX_NUMBER || kind == LEX_COLOR || kind == LEX_REFERENCE ||
           kind == T_STRING || kind == T_TRUE || kind == T_FALSE || kind == T_ATTRIBUTE ||
           kind == '[';
}

/* It begins a statement. */
static bool is_first(const slip *s, lexeme l)
{
    uint32_t at = l.from;
    while (at && strchr(" \t", s->p->source->text[at - 1]))
        at--;
    return !at || strchr("\n{;", s->p->source->text[at - 1]);
}

/* A misspelt keyword: two names at the beginning of a line. */
static void advise_keyword(slip *s)
{
    static const char *const words[] = {"param",   "const",   "attr",     "in",       "out",
                                        "block",   "hidden",  "import",   "use",      "graph",
                                        "augment", "example", "formerly", "category", "synonyms"};
    if (s->before.kind != T_NAME || !is_first(s, s->before))
        return;
    const char *word =
        arena_copy(s->p->arena, s->p->source->text + s->before.from, s->before.to - s->before.from);
    const char *near = nearest_name(word, words, COUNT_OF(words));
    if (near)
        s->help = arena_format(s->p->arena, "did you mean '%s' instead of '%s'?", near, word);
}

static void advise_operator(slip *s)
{
    static const struct {
        const char *found, *text;
    } words[] = {
        {"and", "write '&&'"}, {"or", "write '||'"}, {"not", "write '!'"},
        {"mod", "write '%'"},  {"is", "write '=='"}, {"=", "'==' compares"},
    };
    if (!expects(&s->expected, "=="))
        return;
    for (size_t i = 0; i < COUNT_OF(words); i++)
        if (is_text(s, s->found, words[i].found) &&
            !(i + 1 == COUNT_OF(words) && expects(&s->expected, "'='")))
            s->text = words[i].text;
}

/* A word as the text has it. */
static const char *word_of(const slip *s, lexeme l)
{
    return arena_copy(s->p->arena, s->p->source->text + l.from, l.to - l.from);
}

/* Words that begin a declaration elsewhere: let k = 3, float k = 3. */
static void advise_declaration(slip *s)
{
    static const char *const words[] = {"let",  "var",    "val",    "def",    "auto",  "set",
                                        "int",  "float",  "double", "number", "bool",  "string",
                                        "str",  "length", "angle",  "color",  "path",  "ratio",
                                        "area", "vec2",   "vec3",   "final",  "static"};
    if (!is_first(s, s->before) || !is_any_name(s->found.kind) ||
        lex(s->p->source, s->found.to).kind != '=')
        return;
    for (size_t i = 0; i < COUNT_OF(words); i++)
        if (is_text(s, s->before, words[i]))
            s->help = arena_format(s->p->arena,
                                   "a value is declared: const %s = …, or param %s: type = … where "
                                   "it can be set from outside",
                                   word_of(s, s->found), word_of(s, s->found));
}

/* extrude amount = 2, and f x within an expression. */
static void advise_parentheses(slip *s)
{
    bool value = begins_value(s->found.kind), inside = in_parentheses(s->p);
    const expectation *e = &s->expected;
    if (!is_any_name(s->before.kind) || (s->before.kind != T_NAME && is_first(s, s->before)))
        return;
    if (value && !inside && expects(e, "'('") && expects(e, "->"))
        s->help = arena_format(s->p->arena, "arguments stand in parentheses: %s(%s%s)",
                               word_of(s, s->before), word_of(s, s->found),
                               lex(s->p->source, s->found.to).kind == '=' ? " = …" : "");
    else if (inside && (s->found.kind == T_IN || s->found.kind == T_OF) && expects(e, "'('"))
        s->help = arena_format(s->p->arena, "a function's argument stands in parentheses: %s(in)",
                               word_of(s, s->before));
}

/* 3 m */
static void advise_unit(slip *s)
{
    if (s->before.kind == LEX_NUMBER &&
        literal_is_unit(s->p, parser_span(s->p, s->found.from, s->found.to)))
        s->help = arena_format(s->p->arena, "a unit stands right behind its number: %s%s",
                               word_of(s, s->before), word_of(s, s->found));
}

/* ./brick.jpg */
static void advise_path(slip *s)
{
    if ((s->found.kind == '.' || s->found.kind == '/') && expects(&s->expected, "value"))
        s->help = "a path stands in quotes: \"folder/file.jpg\"";
}

/* Between arguments, and between a name and its value. */
static void advise_argument(slip *s)
{
    const expectation *e = &s->expected;
    bool inside = in_parentheses(s->p);
    if (s->found.kind == ':' && expects(e, "'='"))
        s->help = inside ? "an argument is written name = value"
                         : "a constant has the type of its value: const name = value";
    else if (s->found.kind == '=' && expects(e, "->"))
        s->help = "a value is declared: const name = value, or param name: type = value";
    else if (s->found.kind == '=' && expects(e, "':'"))
        s->help = "the type comes first: name: type = value";
    else if (s->found.kind == '=' && s->before.kind == ':')
        s->help = "a type stands between ':' and '='";
    else if (!inside)
        return;
    else if (s->found.kind == ';')
        s->help = "between parentheses, ',' separates";
    else if ((s->found.kind == T_ARROW || s->found.kind == T_WRITE || s->found.kind == T_SHARE) &&
             expects(e, "','"))
        s->help = "a link to an attribute of the graph is written name => @attribute or name <=> "
                  "@attribute";
    else if (begins_value(s->found.kind) && is_any_name(s->before.kind) && expects(e, "'='"))
        s->help = "an argument is written name = value; ',' separates arguments";
    else if (begins_value(s->found.kind) && expects(e, "','") && expects(e, "')'"))
        s->help = "',' separates arguments";
}

static bool is_like_arrow(int kind)
{
    return kind == T_WRITE || kind == T_SHARE || kind == '-' || kind == '<' || kind == '>' ||
           kind == T_SHIFT_RIGHT || kind == T_GREATER_EQUAL || kind == '|';
}

static void advise_statement(slip *s)
{
    const expectation *e = &s->expected;
    if (s->found.kind == ',' && expects(e, "end of line"))
        s->help = "statements and augmentations are separated by ';' or by line ends";
    else if ((s->found.kind == T_ARROW || s->found.kind == T_DISABLED) && expects(e, "name"))
        s->help = "a chain begins with a node or a gate";
    else if (s->found.kind == '(' && s->before.kind == ')' && expects(e, "->"))
        s->help = "augmentations stand in braces: { … }";
    else if (is_like_arrow(s->found.kind) && expects(e, "->"))
        s->help = "an edge is written '->'";
    else if (e->count == 1 && expects(e, "'{'"))
        s->help = "a graph's statements stand in braces: graph name { … }";
    else if (s->before.kind == T_HIDDEN)
        s->help = "write hidden param";
    else if (s->before.kind == T_GRAPH && expects(e, "->"))
        s->help = "a graph stands beside other graphs, not in one";
    else if (s->before.kind == T_IMPORT && s->found.kind == T_STRING)
        s->help = "write import graph from \"file.pcg\"";
    else if (s->found.kind == T_NEWLINE && expects(e, "value"))
        s->help = "an expression goes on in the next line only between parentheses";
    else if (e->count == 1 && expects(e, "'*'"))
        s->help = "'= *' gathers what is left; an edge leads to an output from a line of its own: "
                  "node -> output";
}

static void advise_reserved(slip *s)
{
    if ((s->found.kind == T_TRUE || s->found.kind == T_FALSE || s->found.kind == T_IF) &&
        expects(&s->expected, "name"))
        s->help = arena_format(s->p->arena,
                               "this word is reserved; as a name it is written in quotes: %s",
                               syntax_quote(s->p, parser_span(s->p, s->found.from, s->found.to)));
}

static void advise(slip *s)
{
    advise_operator(s);
    if (s->text)
        return;
    if (is_any_name(s->found.kind))
        advise_keyword(s);
    if (!s->help)
        advise_declaration(s);
    if (!s->help)
        advise_unit(s);
    if (!s->help)
        advise_parentheses(s);
    if (!s->help)
        advise_path(s);
    if (!s->help)
        advise_argument(s);
    if (!s->help)
        advise_statement(s);
    if (!s->help)
        advise_reserved(s);
}

/* Outside of everything, a line begins with a word that begins nothing: that word. */
static bool find_unknown_item(const slip *s, lexeme *word)
{
    const source *all = s->p->source;
    uint32_t from = s->found.from;
    if (s->p->depth)
        return false;
    while (from && s->found.from - from < LONGEST_LINE && all->text[from - 1] != '\n')
        from--;
    *word = lex(all, from);
    return word->kind == T_NAME && word->from < s->found.from && is_first(s, *word);
}

/* ---- reporting ------------------------------------------------------------------------------- */

static const char *describe_found(parser *p, lexeme found)
{
    if (found.kind == T_END)
        return "the end of the file";
    if (found.kind == T_NEWLINE)
        return "the end of the line";
    if (found.kind == T_STRING && found.to - found.from <= QUOTED)
        return arena_copy(p->arena, p->source->text + found.from, found.to - found.from);
    return syntax_quote(p, parser_span(p, found.from, found.to));
}

void syntax_error(parser *p, span at, const char *const *expected, int count)
{
    if (p->stopped || p->made_up)
        return;
    if (p->unmatched) {
        diagnose(p->diagnostics, DIAG_E0023, at, syntax_quote(p, at));
        return;
    }
    if (diagnostics_full(p->diagnostics)) {
        diagnose(p->diagnostics, DIAG_E0011, at, "");
        return;
    }
    slip s = {.p = p, .found = p->previous, .before = p->before, .expected = {expected, count}};
    lexeme word;
    if (find_unknown_item(&s, &word)) {
        const char *written =
            arena_copy(p->arena, p->source->text + word.from, word.to - word.from);
        build_unknown_item(p, (tree_name){written, parser_span(p, word.from, word.to)});
        return;
    }
    advise(&s);
    const char *wanted = describe(p, &s.expected), *found = describe_found(p, s.found);
    diagnostic *d = wanted ? diagnose(p->diagnostics, DIAG_E0010, at, found, wanted)
                           : diagnose(p->diagnostics, DIAG_E0011, at, found);
    d->text = s.text;
    d->help = s.help;
}

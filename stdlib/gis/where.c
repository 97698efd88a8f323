/* where.c - conditions on the fields of a feature, parsed once and looked at for each.
 *
 * The nodes and strings of a condition lie in one block that the caller gives: a text has no more
 * of either than bytes. A chain of `and` or of `or` is a list to the right, which is followed in a
 * loop, so that only parentheses and `not` nest.
 */
#include <string.h>

#include "gis.h"

typedef enum operation {
    OP_TRUE,
    OP_AND,
    OP_OR,
    OP_NOT,
    OP_PRESENT,
    OP_LIKE,
    OP_IN,
    OP_EQUAL,
    OP_UNEQUAL,
    OP_LESS,
    OP_LESS_EQUAL,
    OP_GREATER,
    OP_GREATER_EQUAL
} operation;

#define NONE UINT32_MAX

typedef struct where_node {
    operation op;
    uint32_t left,
        right; /* operands; of OP_IN `right` is the next value to compare with, or NONE */
    const char *field, *value;
    double number;
    bool is_number;
} where_node;

struct gis_where {
    uint32_t root;
    where_node nodes[];
};

typedef struct parser {
    const char *text, *at;
    gis_where *where;
    uint32_t count;
    char *strings;
    const char *error;
    int depth;
} parser;

static size_t aligned(size_t size)
{
    return (size + 15) / 16 * 16;
}

size_t gis_where_size(const char *text)
{
    size_t length = strlen(text);
    if (length > GIS_WHERE_BYTES_MAX)
        return 0;
    return aligned(sizeof(gis_where) + (length + 2) * sizeof(where_node)) + 2 * length + 2;
}

/* ---- words ----------------------------------------------------------------------------------- */

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c & 0x80) || (c && strchr("_:.-@/#+", c));
}

static void skip_space(parser *p)
{
    while (is_space(*p->at))
        p->at++;
}

static bool take(parser *p, const char *token)
{
    skip_space(p);
    size_t length = strlen(token);
    if (strncmp(p->at, token, length) != 0)
        return false;
    p->at += length;
    return true;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Takes a word of the language, in either case, where it stands as a whole. */
static bool take_keyword(parser *p, const char *keyword)
{
    skip_space(p);
    size_t i = 0;
    while (keyword[i] && lower(p->at[i]) == keyword[i])
        i++;
    if (keyword[i] || is_word(p->at[i]))
        return false;
    p->at += i;
    return true;
}

static void *fail(parser *p, const char *error)
{
    if (!p->error)
        p->error = error;
    return NULL;
}

/* A text in quotes; the quote twice is the quote itself. */
static const char *parse_quoted(parser *p)
{
    char quote = *p->at, *begin = p->strings;
    const char *from = p->at + 1;
    while (*from && (*from != quote || from[1] == quote)) {
        from += *from == quote;
        *p->strings++ = *from++;
    }
    if (!*from)
        return fail(p, "a closing quote");
    p->at = from + 1;
    *p->strings++ = '\0';
    return begin;
}

static const char *parse_word(parser *p, const char *what)
{
    skip_space(p);
    if (*p->at == '"' || *p->at == '\'')
        return parse_quoted(p);
    size_t length = 0;
    while (is_word(p->at[length]))
        length++;
    if (!length)
        return fail(p, what);
    char *word = memcpy(p->strings, p->at, length);
    word[length] = '\0';
    p->strings += length + 1;
    p->at += length;
    return word;
}

/* ---- parsing --------------------------------------------------------------------------------- */

static uint32_t add_node(parser *p, operation op, uint32_t left, uint32_t right)
{
    p->where->nodes[p->count] = (where_node){.op = op, .left = left, .right = right};
    return p->count++;
}

static uint32_t add_test(parser *p, operation op, const char *field)
{
    const char *value = parse_word(p, "a value");
    if (!value)
        return NONE;
    uint32_t n = add_node(p, op, NONE, NONE);
    where_node *node = &p->where->nodes[n];
    node->field = field;
    node->value = value;
    node->is_number = gis_number_read(value, &node->number);
    return n;
}

static uint32_t parse_in(parser *p, const char *field)
{
    uint32_t first = NONE, last = NONE;
    if (!take(p, "(")) {
        fail(p, "'(' behind 'in'");
        return NONE;
    }
    do {
        uint32_t n = add_test(p, OP_IN, field);
        if (n == NONE)
            return NONE;
        if (last == NONE)
            first = n;
        else
            p->where->nodes[last].right = n;
        last = n;
    } while (take(p, ","));
    if (!take(p, ")")) {
        fail(p, "')' or ','");
        return NONE;
    }
    return first;
}

static uint32_t add_present(parser *p, const char *field)
{
    uint32_t n = add_node(p, OP_PRESENT, NONE, NONE);
    p->where->nodes[n].field = field;
    return n;
}

static uint32_t negated(parser *p, bool negate, uint32_t n)
{
    return negate && n != NONE ? add_node(p, OP_NOT, n, NONE) : n;
}

static uint32_t parse_test(parser *p)
{
    static const struct {
        const char *token;
        operation op;
    } compare[] = {
        {"==", OP_EQUAL},      {"=", OP_EQUAL}, {"!=", OP_UNEQUAL},       {"<>", OP_UNEQUAL},
        {"<=", OP_LESS_EQUAL}, {"<", OP_LESS},  {">=", OP_GREATER_EQUAL}, {">", OP_GREATER},
    };
    const char *field = parse_word(p, "the name of a field");
    if (!field)
        return NONE;
    for (size_t i = 0; i < sizeof compare / sizeof compare[0]; i++)
        if (take(p, compare[i].token))
            return add_test(p, compare[i].op, field);
    if (take_keyword(p, "is")) {
        bool present = take_keyword(p, "not");
        if (take_keyword(p, "null"))
            return negated(p, !present, add_present(p, field));
        fail(p, "'null' or 'not null' behind 'is'");
        return NONE;
    }
    bool negate = take_keyword(p, "not");
    if (take_keyword(p, "in"))
        return negated(p, negate, parse_in(p, field));
    if (take_keyword(p, "like"))
        return negated(p, negate, add_test(p, OP_LIKE, field));
    if (!negate)
        return add_present(p, field);
    fail(p, "'in' or 'like' behind 'not'");
    return NONE;
}

static uint32_t parse_or(parser *p);

static uint32_t parse_operand(parser *p)
{
    uint32_t n = NONE;
    if (p->depth == GIS_WHERE_DEPTH_MAX) {
        fail(p, "less parentheses in each other");
        return NONE;
    }
    p->depth++;
    if (take_keyword(p, "not")) {
        n = negated(p, true, parse_operand(p));
    } else if (take(p, "(")) {
        n = parse_or(p);
        if (n != NONE && !take(p, ")")) {
            fail(p, "')', 'and' or 'or'");
            n = NONE;
        }
    } else {
        n = parse_test(p);
    }
    p->depth--;
    return n;
}

/* One kind of chain: `first` is the whole of it, `last` the newest node that has operands on
 * both sides. */
static uint32_t parse_chain(parser *p, operation op, const char *keyword,
                            uint32_t (*operand)(parser *p))
{
    uint32_t first = operand(p), last = NONE;
    while (first != NONE && take_keyword(p, keyword)) {
        uint32_t next = operand(p);
        if (next == NONE)
            return NONE;
        uint32_t before = last == NONE ? first : p->where->nodes[last].right;
        uint32_t both = add_node(p, op, before, next);
        if (last == NONE)
            first = both;
        else
            p->where->nodes[last].right = both;
        last = both;
    }
    return first;
}

static uint32_t parse_and(parser *p)
{
    return parse_chain(p, OP_AND, "and", parse_operand);
}

static uint32_t parse_or(parser *p)
{
    return parse_chain(p, OP_OR, "or", parse_and);
}

const gis_where *gis_where_parse(const char *text, void *memory, const char **error, size_t *at)
{
    size_t nodes = aligned(sizeof(gis_where) + (strlen(text) + 2) * sizeof(where_node));
    parser p = {.text = text, .at = text, .where = memory, .strings = (char *)memory + nodes};
    skip_space(&p);
    p.where->root = *p.at ? parse_or(&p) : add_node(&p, OP_TRUE, NONE, NONE);
    skip_space(&p);
    if (!p.error && *p.at)
        fail(&p, "'and', 'or' or the end");
    *error = p.error;
    *at = (size_t)(p.at - text);
    return p.error ? NULL : p.where;
}

/* ---- holding --------------------------------------------------------------------------------- */

/* `%` stands for any bytes, `_` for one; upper and lower case are the same. */
static bool is_like(const char *pattern, const char *s)
{
    const char *star = NULL, *resume = NULL;
    while (*s) {
        if (*pattern == '%') {
            star = ++pattern;
            resume = s;
        } else if (*pattern && (*pattern == '_' || lower(*pattern) == lower(*s))) {
            pattern++;
            s++;
        } else if (star) {
            pattern = star;
            s = ++resume;
        } else {
            return false;
        }
    }
    while (*pattern == '%')
        pattern++;
    return !*pattern;
}

static bool is_equal(const where_node *n, const char *value)
{
    double number;
    return !strcmp(n->value, value) ||
           (n->is_number && gis_number_read(value, &number) && number == n->number);
}

/* What is no number is neither less nor greater. */
static bool is_ordered(const where_node *n, const char *value)
{
    double number;
    if (!n->is_number || !gis_number_read(value, &number))
        return false;
    switch (n->op) {
    case OP_LESS:
        return number < n->number;
    case OP_LESS_EQUAL:
        return number <= n->number;
    case OP_GREATER:
        return number > n->number;
    default:
        return number >= n->number;
    }
}

static bool test_holds(const gis_where *w, const where_node *n, gis_lookup *lookup, void *context)
{
    const char *value = lookup(context, n->field);
    if (!value)
        return false;
    switch (n->op) {
    case OP_PRESENT:
        return *value != '\0';
    case OP_LIKE:
        return is_like(n->value, value);
    case OP_EQUAL:
        return is_equal(n, value);
    case OP_UNEQUAL:
        return !is_equal(n, value);
    case OP_IN:
        while (!is_equal(n, value) && n->right != NONE)
            n = &w->nodes[n->right];
        return is_equal(n, value);
    default:
        return is_ordered(n, value);
    }
}

static bool node_holds(const gis_where *w, uint32_t index, gis_lookup *lookup, void *context)
{
    for (;;) {
        const where_node *n = &w->nodes[index];
        switch (n->op) {
        case OP_TRUE:
            return true;
        case OP_NOT:
            return !node_holds(w, n->left, lookup, context);
        case OP_AND:
        case OP_OR:
            if (node_holds(w, n->left, lookup, context) == (n->op == OP_OR))
                return n->op == OP_OR;
            index = n->right;
            break;
        default:
            return test_holds(w, n, lookup, context);
        }
    }
}

bool gis_where_holds(const gis_where *w, gis_lookup *lookup, void *context)
{
    return node_holds(w, w->root, lookup, context);
}

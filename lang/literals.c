/* literals.c - what numbers, colors, strings and quoted names mean. */
#include "parser.h"

#include <math.h>
#include <string.h>

static const struct unit_row {
    const char *name;
    tree_unit unit;
    double times, over; /* to the base unit; one of them is 1 */
} units[] = {
    {"m", UNIT_METRE, 1, 1},
    {"mm", UNIT_METRE, 1, 1000},
    {"cm", UNIT_METRE, 1, 100},
    {"km", UNIT_METRE, 1000, 1},
    {"m2", UNIT_SQUARE_METRE, 1, 1},
    {"deg", UNIT_DEGREE, 1, 1},
    {"rad", UNIT_DEGREE, 57.295779513082320877, 1},
    {"%", UNIT_PERCENT, 1, 100},
    {"s", UNIT_SECOND, 1, 1},
    {"ms", UNIT_SECOND, 1, 1000},
    {"min", UNIT_SECOND, 60, 1},
    {"h", UNIT_SECOND, 3600, 1},
};

static const struct unit_row *find_unit(const char *name)
{
    for (size_t i = 0; i < COUNT_OF(units); i++)
        if (strcmp(units[i].name, name) == 0)
            return &units[i];
    return NULL;
}

bool literal_is_unit(const parser *p, span at)
{
    for (size_t i = 0; i < COUNT_OF(units); i++)
        if (strlen(units[i].name) == at.to - at.from &&
            !memcmp(units[i].name, p->source->text + at.from, at.to - at.from))
            return true;
    return false;
}

static void report_unit(parser *p, span at, const char *name)
{
    const char *names[COUNT_OF(units)];
    for (size_t i = 0; i < COUNT_OF(units); i++)
        names[i] = units[i].name;
    const char *near = nearest_name(name, names, COUNT_OF(units));
    diagnostic *d = diagnose(p->diagnostics, DIAG_E0006, at, name);
    if (near)
        d->text = arena_format(p->arena, "did you mean '%s'?", near);
    d->help = "units are mm cm m km, m2, deg rad, %, ms s min h";
}

static bool is_whole(const char *digits)
{
    return !strpbrk(digits, ".eE");
}

/* False where it is larger than 64 bits hold. */
static bool read_integer(const char *digits, int64_t *result)
{
    int64_t value = 0;
    for (; *digits; digits++) {
        int digit = *digits - '0';
        if (value > (INT64_MAX - digit) / 10)
            return false;
        value = value * 10 + digit;
    }
    *result = value;
    return true;
}

static tree_expression *error_value(parser *p, span at)
{
    return build_expression(p, EXPR_ERROR, at);
}

tree_expression *literal_number(parser *p, span at)
{
    const char *written = arena_copy(p->arena, p->source->text + at.from, at.to - at.from), *behind;
    double number = number_read(written, &behind);
    span unit_at = parser_span(p, at.from + (uint32_t)(behind - written), at.to);
    const struct unit_row *unit = find_unit(behind);
    const char *digits = arena_copy(p->arena, written, (size_t)(behind - written));
    if (*behind && !unit) {
        report_unit(p, unit_at, behind);
        return error_value(p, at);
    }
    tree_expression *e = build_expression(p, EXPR_FLOAT, at);
    e->number = unit ? number * unit->times / unit->over : number;
    e->unit = unit ? unit->unit : UNIT_NONE;
    if (!unit && is_whole(digits)) {
        e->kind = EXPR_INT;
        if (read_integer(digits, &e->integer))
            return e;
    } else if (isfinite(e->number)) {
        return e;
    }
    diagnose(p->diagnostics, DIAG_E0007, at, syntax_quote(p, at));
    return error_value(p, at);
}

static int hex_value(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* #rgb, #rrggbb, #rrggbbaa */
tree_expression *literal_color(parser *p, span at)
{
    const char *digits = p->source->text + at.from + 1;
    uint32_t count = at.to - at.from - 1, color = 0;
    bool good = count == 3 || count == 6 || count == 8;
    for (uint32_t i = 0; good && i < count; i++) {
        int digit = hex_value(digits[i]);
        good = digit >= 0;
        color = color << 4 | (uint32_t)(digit & 15);
        if (count == 3)
            color = color << 4 | (uint32_t)(digit & 15);
    }
    if (!good) {
        diagnose(p->diagnostics, DIAG_E0008, at, syntax_quote(p, at));
        return error_value(p, at);
    }
    tree_expression *e = build_expression(p, EXPR_COLOR, at);
    e->color = count == 8 ? color : color << 8 | 0xFF;
    return e;
}

/* ---- strings --------------------------------------------------------------------------------- */

static void add_utf8(text *t, uint32_t c)
{
    char bytes[4];
    size_t count = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = count - 1; i; i--, c >>= 6)
        bytes[i] = (char)(0x80 | (c & 0x3F));
    bytes[0] = (char)(count == 1 ? c : (0xF00u >> count & 0xF0) | c);
    text_add_bytes(t, bytes, count);
}

/* Four hexadecimal digits; false where there are none. */
static bool read_code_unit(const char *s, uint32_t *result)
{
    *result = 0;
    for (int i = 0; i < 4; i++) {
        int digit = hex_value(s[i]);
        if (digit < 0)
            return false;
        *result = *result << 4 | (uint32_t)digit;
    }
    return true;
}

/* uXXXX, or a pair of them for what lies beyond; how many bytes, 0 where it is none. The NUL has no
 * place in a string. */
static uint32_t read_unicode(const char *s, text *out)
{
    uint32_t c, low;
    if (!read_code_unit(s + 1, &c) || c == 0 || (c >= 0xDC00 && c < 0xE000))
        return 0;
    if (c < 0xD800 || c >= 0xE000) {
        add_utf8(out, c);
        return 5;
    }
    if (s[5] != '\\' || s[6] != 'u' || !read_code_unit(s + 7, &low) || low < 0xDC00 ||
        low >= 0xE000)
        return 0;
    add_utf8(out, 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00));
    return 11;
}

/* What stands behind a backslash; how many bytes it is, 0 where it is no escape. */
static uint32_t read_escape(const char *s, text *out)
{
    static const char names[] = "nrt\"'\\/", values[] = "\n\r\t\"'\\/";
    const char *known = *s ? strchr(names, *s) : NULL;
    if (known) {
        text_add_bytes(out, values + (known - names), 1);
        return 1;
    }
    return *s == 'u' ? read_unicode(s, out) : 0;
}

static void report_escape(parser *p, uint32_t backslash)
{
    uint32_t to = backslash + 2;
    while (to < p->source->size && ((unsigned char)p->source->text[to] & 0xC0) == 0x80)
        to++;
    diagnose(p->diagnostics, DIAG_E0005, parser_span(p, backslash, to),
             arena_copy(p->arena, p->source->text + backslash + 1, to - backslash - 1))
        ->help = "escapes are \\n \\r \\t \\\" \\' \\\\ \\/ and \\uXXXX";
}

tree_expression *literal_string(parser *p, span at, bool closed)
{
    text out = {.arena = p->arena};
    const char *bytes = p->source->text;
    uint32_t end = closed ? at.to - 1 : at.to;
    text_add(&out, "");
    for (uint32_t i = at.from + 1; i < end;) {
        uint32_t run = i;
        while (run < end && bytes[run] != '\\')
            run++;
        text_add_bytes(&out, bytes + i, run - i);
        i = run;
        if (i + 1 >= end)
            break;
        uint32_t length = read_escape(bytes + i + 1, &out);
        if (!length)
            report_escape(p, i);
        i += 1 + (length ? length : 1);
    }
    if (!closed)
        diagnose(p->diagnostics, DIAG_E0004, at);
    tree_expression *e = build_expression(p, EXPR_STRING, at);
    e->string = out.at;
    return e;
}

/* ---- names ----------------------------------------------------------------------------------- */

tree_name literal_name(parser *p, span at, uint32_t skip)
{
    const char *bytes = p->source->text + at.from + skip;
    uint32_t length = at.to - at.from - skip;
    if (*bytes == '\'') {
        bool closed = length > 1 && bytes[length - 1] == '\'';
        bytes++;
        length -= closed ? 2 : 1;
        if (!length)
            diagnose(p->diagnostics, DIAG_E0018, at);
    }
    return (tree_name){arena_copy(p->arena, bytes, length), at};
}

/* The text between the next braces at or behind *at, without blanks around it; *at goes behind
 * them. */
static tree_name braced_name(parser *p, uint32_t *at)
{
    const char *bytes = p->source->text;
    while (bytes[*at] != '{')
        ++*at;
    uint32_t from = ++*at;
    while (bytes[*at] != '}')
        ++*at;
    uint32_t to = (*at)++;
    while (from < to && bytes[from] == ' ')
        from++;
    while (to > from && bytes[to - 1] == ' ')
        to--;
    span place = parser_span(p, from, to);
    if (from == to)
        diagnose(p->diagnostics, DIAG_E0018, parser_span(p, from - 1, to + 1));
    return (tree_name){arena_copy(p->arena, bytes + from, to - from), place};
}

/* The original notation: @{parameter}, ${port}, ${port}{attribute}. */
tree_expression *literal_reference(parser *p, span at)
{
    uint32_t behind = at.from;
    tree_name name = braced_name(p, &behind);
    if (behind >= at.to) {
        tree_expression *e = build_name(p, name);
        e->span = at;
        return e;
    }
    return build_attribute(p, name, braced_name(p, &behind), at);
}

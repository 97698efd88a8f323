/* diagnostics.c - the messages of a compilation: collecting, sorting, printing with carets and as
 * JSON. */
#include "base.h"

#include <stdlib.h>
#include <string.h>

enum {
    DEFAULT_LIMIT = 100,
    GUTTER = 5,          /* digits of a line number */
    TAB = 4,             /* columns */
    EXCERPT_BEFORE = 70, /* bytes of a long line that are shown before the place */
    EXCERPT_WIDTH = 120  /* and in all */
};

/* ---- collecting -------------------------------------------------------------------------------
 */

typedef struct catalogue_row {
    const char *name;
    severity severity;
    const char *format;
} catalogue_row;

static const catalogue_row catalogue[] = {
#define DIAGNOSTIC(code, severity, format) {#code, SEVERITY_##severity, format},
#include "diagnostics.def"
#undef DIAGNOSTIC
};

static const char *const severity_names[] = {"note", "warning", "error"};

const char *diagnostic_name(diagnostic_code code)
{
    return catalogue[code].name;
}

static uint32_t limit_of(const diagnostics *d)
{
    return d->limit ? d->limit : DEFAULT_LIMIT;
}

bool diagnostics_full(const diagnostics *d)
{
    return d->errors >= limit_of(d);
}

/* Counts it, and says whether there is room for it. */
static bool count_in(diagnostics *d, severity s)
{
    if (s == SEVERITY_ERROR)
        return d->errors++ < limit_of(d);
    if (s == SEVERITY_WARNING)
        return d->warnings++ < limit_of(d);
    return true;
}

diagnostic *diagnose(diagnostics *d, diagnostic_code code, span place, ...)
{
    const catalogue_row *row = &catalogue[code];
    diagnostic made = {.code = code, .severity = row->severity, .message = "", .span = place};
    if (!count_in(d, row->severity)) {
        d->spare = made;
        return &d->spare;
    }
    va_list arguments;
    va_start(arguments, place);
    made.message = arena_format_list(d->arena, row->format, arguments);
    va_end(arguments);
    LIST_ADD(d->arena, &d->list, made);
    return &d->list.at[d->list.count - 1];
}

/* ---- text that a terminal can be given --------------------------------------------------------
 */

/* Decodes the character at `s`, which has `left` bytes; its length, or 0 where the bytes are no
 * UTF-8. */
static uint32_t decode(const char *s, size_t left, uint32_t *character)
{
    static const uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *u = (const unsigned char *)s;
    uint32_t length = u[0] < 0x80   ? 1
                      : u[0] < 0xC2 ? 0
                      : u[0] < 0xE0 ? 2
                      : u[0] < 0xF0 ? 3
                      : u[0] < 0xF5 ? 4
                                    : 0;
    if (!length || length > left)
        return 0;
    uint32_t c = length == 1 ? u[0] : u[0] & (0x7Fu >> length);
    for (uint32_t i = 1; i < length; i++) {
        if ((u[i] & 0xC0) != 0x80)
            return 0;
        c = c << 6 | (u[i] & 0x3F);
    }
    *character = c;
    return c < smallest[length] || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000) ? 0 : length;
}

/* What would move the cursor, ring, or turn the direction of writing. */
static bool is_control(uint32_t c)
{
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x200E || c == 0x200F ||
           (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
}

/* Columns that a terminal gives a character: 2 to East Asian ones and pictures, 0 to marks over
 * others. */
static uint32_t width_of(uint32_t c)
{
    static const struct {
        uint32_t first, last, width;
    } ranges[] = {
        {0x0300, 0x036F, 0},   {0x1100, 0x115F, 2}, {0x200B, 0x200D, 0}, {0x2E80, 0x303E, 2},
        {0x3041, 0xA4CF, 2},   {0xAC00, 0xD7A3, 2}, {0xF900, 0xFAFF, 2}, {0xFE00, 0xFE0F, 0},
        {0xFE30, 0xFE6F, 2},   {0xFF00, 0xFF60, 2}, {0xFFE0, 0xFFE6, 2}, {0x1F300, 0x1FAFF, 2},
        {0x20000, 0x3FFFD, 2},
    };
    for (size_t i = 0; i < COUNT_OF(ranges) && c >= ranges[i].first; i++)
        if (c <= ranges[i].last)
            return ranges[i].width;
    return 1;
}

/* Appends one character of `s` (of `left` bytes) as it may be shown at `column`, and says how many
 * columns it took; returns how many bytes it was. What cannot be shown becomes <1b> (a byte) or
 * <U+202E>. */
static uint32_t show_character(text *out, const char *s, size_t left, uint32_t column,
                               uint32_t *width)
{
    size_t before = out->length;
    uint32_t c = 0;
    uint32_t length = decode(s, left, &c);
    if (length && !is_control(c)) {
        text_add_bytes(out, s, length);
        *width = width_of(c);
        return length;
    }
    if (c == '\t')
        text_add_bytes(out, "    ", TAB - column % TAB);
    else if (!length || c < 0x80)
        text_format(out, "<%02x>", (unsigned)(unsigned char)*s);
    else
        text_format(out, "<U+%04X>", (unsigned)c);
    *width = (uint32_t)(out->length - before);
    return length ? length : 1;
}

static void show(text *out, const char *s)
{
    uint32_t width;
    for (size_t left = strlen(s); left;) {
        uint32_t length = show_character(out, s, left, 0, &width);
        s += length;
        left -= length;
    }
}

/* ---- excerpts ---------------------------------------------------------------------------------
 */

typedef struct colours {
    const char *bold, *severity, *second, *off;
} colours;

static colours colours_of(severity s, bool colour)
{
    static const char *const by_severity[] = {"\033[1;36m", "\033[1;35m", "\033[1;31m"};
    colours c = {"", "", "", ""};
    if (colour)
        c = (colours){"\033[1m", by_severity[s], "\033[1;34m", "\033[0m"};
    return c;
}

/* Carets under a line: columns from..to-1 of the excerpt. */
typedef struct carets {
    uint32_t from, to;
    const char *text, *colour;
} carets;

/* The part of a line that is shown: bytes from..to-1 of the source. */
typedef struct excerpt {
    const source *source;
    uint32_t line; /* from 1 */
    uint32_t from, to;
    bool cut_before, cut_after;
} excerpt;

static bool is_inside_character(const source *s, uint32_t offset)
{
    return ((unsigned char)s->text[offset] & 0xC0) == 0x80;
}

/* The line of an offset; of a very long one, what stands around the offset. */
static excerpt excerpt_at(const source *s, uint32_t offset)
{
    uint32_t line, column;
    source_place(s, offset, &line, &column);
    uint32_t first = s->lines[line - 1];
    uint32_t last = line < s->line_count ? s->lines[line] - 1 : (uint32_t)s->size;
    if (last > first && s->text[last - 1] == '\r')
        last--;
    excerpt e = {.source = s, .line = line, .from = first, .to = last};
    if (last - first <= EXCERPT_WIDTH)
        return e;
    if (offset > last)
        offset = last;
    if (offset - first > EXCERPT_BEFORE)
        e.from = offset - EXCERPT_BEFORE;
    if (e.to - e.from > EXCERPT_WIDTH)
        e.to = e.from + EXCERPT_WIDTH;
    for (int i = 0; i < 3 && e.from > first && is_inside_character(s, e.from); i++)
        e.from--;
    for (int i = 0; i < 3 && e.to < last && is_inside_character(s, e.to); i++)
        e.to++;
    e.cut_before = e.from > first;
    e.cut_after = e.to < last;
    return e;
}

/* Writes the line, and turns the offsets of each caret pair into columns of what was written. */
static void write_line(text *out, const excerpt *e, carets *marks, size_t count)
{
    const char *bytes = e->source->text;
    uint32_t column = e->cut_before ? 1 : 0;
    carets places[2] = {{0}};
    memcpy(places, marks, count * sizeof *marks);
    if (e->cut_before)
        text_add(out, "…");
    for (uint32_t at = e->from; at < e->to;) {
        uint32_t width;
        uint32_t length = show_character(out, bytes + at, e->to - at, column, &width);
        for (size_t i = 0; i < count; i++) {
            if (places[i].from >= at && places[i].from < at + length)
                marks[i].from = column;
            if (places[i].to > at && places[i].to <= at + length)
                marks[i].to = column + width;
        }
        at += length;
        column += width;
    }
    for (size_t i = 0; i < count; i++) {
        if (places[i].from >= e->to)
            marks[i].from = column;
        if (places[i].to > e->to)
            marks[i].to = column + e->cut_after;
        if (marks[i].to <= marks[i].from || places[i].to <= places[i].from)
            marks[i].to = marks[i].from + 1;
    }
    if (e->cut_after)
        text_add(out, "…");
    text_add(out, "\n");
}

static void pad(text *out, uint32_t count)
{
    for (; count; count--)
        text_add(out, " ");
}

/* The row without a line number, up to the text's first column. */
static void write_gutter(text *out, int width)
{
    pad(out, (uint32_t)width);
    text_add(out, " |");
}

/* One row of carets; only the last one's text fits behind them, the first one's goes below. */
static void write_carets(text *out, const carets *marks, size_t count, int gutter, const colours *c)
{
    uint32_t column = 0;
    write_gutter(out, gutter);
    text_add(out, " ");
    for (size_t i = 0; i < count; i++) {
        pad(out, marks[i].from - column);
        text_format(out, "%s^", marks[i].colour);
        for (uint32_t k = marks[i].from + 1; k < marks[i].to; k++)
            text_add(out, "~");
        column = marks[i].to;
        if (i + 1 == count && marks[i].text) {
            text_add(out, " ");
            show(out, marks[i].text);
        }
        text_add(out, c->off);
    }
    text_add(out, "\n");
    if (count == 2 && marks[0].text) {
        write_gutter(out, gutter);
        pad(out, marks[0].from + 1);
        text_add(out, marks[0].colour);
        show(out, marks[0].text);
        text_format(out, "%s\n", c->off);
    }
}

static int digits_of(uint32_t number)
{
    int digits = 1;
    for (; number >= 10; number /= 10)
        digits++;
    return digits > GUTTER ? digits : GUTTER;
}

static void write_excerpt(text *out, const excerpt *e, carets *marks, size_t count,
                          const colours *c)
{
    int gutter = digits_of(e->line);
    text_format(out, "%*u |%s", gutter, (unsigned)e->line, e->to > e->from ? " " : "");
    write_line(out, e, marks, count);
    write_carets(out, marks, count, gutter, c);
}

static carets carets_of(span place, const char *label, const char *colour)
{
    carets c = {place.from, place.to, label, colour};
    return c;
}

/* Both places stand in the shown part of one line, and do not overlap. */
static bool share_a_row(const excerpt *e, span a, span b)
{
    return b.source == e->source && b.from >= e->from && b.to <= e->to && b.from <= e->to &&
           (b.from >= a.to || b.to <= a.from) && b.from != a.from && a.to <= e->to;
}

static void write_second(text *out, const diagnostic *d, const colours *c)
{
    const span place = d->second.span;
    uint32_t line, column;
    source_place(place.source, place.from, &line, &column);
    if (place.source != d->span.source) {
        text_add(out, "      --> ");
        show(out, place.source->path);
        text_format(out, ":%u:%u\n", (unsigned)line, (unsigned)column);
    }
    excerpt e = excerpt_at(place.source, place.from);
    carets mark = carets_of(place, d->second.text, c->second);
    write_excerpt(out, &e, &mark, 1, c);
}

static void write_places(text *out, const diagnostic *d, const colours *c)
{
    excerpt e = excerpt_at(d->span.source, d->span.from);
    carets marks[2] = {carets_of(d->span, d->text, c->severity),
                       carets_of(d->second.span, d->second.text, c->second)};
    if (!d->second.span.source) {
        write_excerpt(out, &e, marks, 1, c);
    } else if (!share_a_row(&e, d->span, d->second.span)) {
        write_excerpt(out, &e, marks, 1, c);
        write_second(out, d, c);
    } else {
        if (d->second.span.from < d->span.from) {
            carets first = marks[1];
            marks[1] = marks[0];
            marks[0] = first;
        }
        write_excerpt(out, &e, marks, 2, c);
    }
}

void diagnostic_write(const diagnostic *d, bool colour, text *out)
{
    colours c = colours_of(d->severity, colour);
    text_add(out, c.bold);
    if (d->span.source) {
        uint32_t line, column;
        source_place(d->span.source, d->span.from, &line, &column);
        show(out, d->span.source->path);
        text_format(out, ":%u:%u: ", (unsigned)line, (unsigned)column);
    }
    text_format(out, "%s%s%s:%s %s", c.off, c.severity, severity_names[d->severity], c.off, c.bold);
    show(out, d->message);
    text_format(out, "%s [%s]\n", c.off, diagnostic_name(d->code));
    if (d->span.source)
        write_places(out, d, &c);
    if (d->help) {
        text_add(out, "      = help: ");
        show(out, d->help);
        text_add(out, "\n");
    }
}

/* ---- JSON -------------------------------------------------------------------------------------
 */

/* JSON must be UTF-8, and messages may quote bytes that are not. */
static void write_json_string(text *out, const char *name, const char *value)
{
    text clean = {.arena = out->arena};
    text_add(&clean, "");
    show(&clean, value);
    text_format(out, ", \"%s\": ", name);
    text_quote(out, clean.at ? clean.at : "");
}

static void write_json_place(text *out, span place)
{
    uint32_t line, column, end_line, end_column;
    source_place(place.source, place.from, &line, &column);
    source_place(place.source, place.to > place.from ? place.to : place.from, &end_line,
                 &end_column);
    write_json_string(out, "file", place.source->path);
    text_format(out, ", \"line\": %u, \"column\": %u, \"endLine\": %u, \"endColumn\": %u",
                (unsigned)line, (unsigned)column, (unsigned)end_line, (unsigned)end_column);
}

void diagnostic_write_json(const diagnostic *d, text *out)
{
    text_format(out, "{\"severity\": \"%s\", \"code\": \"%s\"", severity_names[d->severity],
                diagnostic_name(d->code));
    write_json_string(out, "message", d->message);
    if (d->span.source)
        write_json_place(out, d->span);
    if (d->text)
        write_json_string(out, "label", d->text);
    if (d->second.span.source) {
        text_format(out, ", \"related\": [{\"severity\": \"note\"");
        write_json_place(out, d->second.span);
        if (d->second.text)
            write_json_string(out, "label", d->second.text);
        text_add(out, "}]");
    }
    if (d->help)
        write_json_string(out, "help", d->help);
    text_add(out, "}\n");
}

/* ---- printing ---------------------------------------------------------------------------------
 */

/* By file, then place; what was found first comes first at one place. Those without a place lead.
 */
static int compare(const void *a, const void *b)
{
    const diagnostic *x = *(const diagnostic *const *)a, *y = *(const diagnostic *const *)b;
    if (x->span.source != y->span.source) {
        if (!x->span.source || !y->span.source)
            return x->span.source ? 1 : -1;
        int order = strcmp(x->span.source->path, y->span.source->path);
        if (order)
            return order;
    }
    if (x->span.source && x->span.from != y->span.from)
        return x->span.from < y->span.from ? -1 : 1;
    return x < y ? -1 : x > y;
}

/* Pointers to all of them, in order; NULL where memory is out. */
static const diagnostic **sorted(const diagnostics *d, arena *a)
{
    const diagnostic **order = ARENA_ARRAY(a, const diagnostic *, d->list.count);
    if (!order)
        return NULL;
    for (uint32_t i = 0; i < d->list.count; i++)
        order[i] = &d->list.at[i];
    qsort(order, d->list.count, sizeof *order, compare);
    return order;
}

static void write_left_out(const diagnostics *d, text *out)
{
    uint32_t kept[3] = {0};
    for (uint32_t i = 0; i < d->list.count; i++)
        kept[d->list.at[i].severity]++;
    uint32_t more = d->errors - kept[SEVERITY_ERROR] + d->warnings - kept[SEVERITY_WARNING];
    if (more)
        text_format(out, "%u more are not shown\n", (unsigned)more);
}

static void put(const text *t, FILE *out)
{
    if (t->length)
        fwrite(t->at, 1, t->length, out);
}

/* The arena of the compilation may be what has run out, so printing has one of its own; each
 * message is written at once, so that little is needed. */
void diagnostics_print(const diagnostics *d, FILE *out, bool colour)
{
    arena own = {0}, one = {0};
    const diagnostic **order = sorted(d, &own);
    for (uint32_t i = 0; i < d->list.count; i++) {
        text t = {.arena = &one};
        diagnostic_write(order ? order[i] : &d->list.at[i], colour, &t);
        put(&t, out);
        arena_free(&one);
    }
    text t = {.arena = &own};
    write_left_out(d, &t);
    put(&t, out);
    arena_free(&own);
}

void diagnostics_print_json(const diagnostics *d, FILE *out)
{
    arena own = {0}, one = {0};
    const diagnostic **order = sorted(d, &own);
    for (uint32_t i = 0; i < d->list.count; i++) {
        text t = {.arena = &one};
        diagnostic_write_json(order ? order[i] : &d->list.at[i], &t);
        put(&t, out);
        arena_free(&one);
    }
    arena_free(&own);
}

/* value_read.c - values from text, as the language writes its literals. */
#include <math.h>
#include <string.h>

#include "memory.h"
#include "value.h"

typedef struct reader {
    pcg_run *run;
    const char *at;
    char *why;
} reader;

static const struct unit_row {
    const char *name;
    int kind;
    double times,
        over; /* to the base unit; one of them is 1, so that 3mm is 3 / 1000 and not 3 * 0.001 */
} units[] = {
    {"m", PCG_LENGTH, 1, 1},      {"mm", PCG_LENGTH, 1, 1000},  {"cm", PCG_LENGTH, 1, 100},
    {"km", PCG_LENGTH, 1000, 1},  {"m2", PCG_AREA, 1, 1},       {"deg", PCG_ANGLE, 1, 1},
    {"rad", PCG_ANGLE, 57.295779513082320877, 1},               {"%", PCG_RATIO, 1, 100},
    {"s", PCG_SECONDS, 1, 1},     {"ms", PCG_SECONDS, 1, 1000}, {"min", PCG_SECONDS, 60, 1},
    {"h", PCG_SECONDS, 3600, 1},
};

/* ---- errors --------------------------------------------------------------------------------- */

enum { SHOWN = 60 }; /* bytes of a value that a message shows */

/* The beginning of a text on one line, fit to be printed. */
static void show(char *out, const char *s)
{
    size_t n = 0;
    while (s[n] && n < SHOWN) {
        unsigned char c = (unsigned char)s[n];
        out[n] = c < 0x20 || c == 0x7F ? ' ' : (char)c;
        n++;
    }
    while (s[n] && n && ((unsigned char)s[n] & 0xC0) == 0x80)
        n--; /* no half of a character */
    strcpy(out + n, s[n] ? "…" : "");
}

static bool refuse(const reader *in, const char *expected, const char *found)
{
    char shown[SHOWN + 8];
    show(shown, found);
    snprintf(in->why, VALUE_WHY_BYTES, "takes %s, not '%s'", expected, shown);
    return false;
}

static const char *article(const char *noun)
{
    return strchr("aeiou", *noun) ? "an" : "a";
}

static const char *expected_of(int kind)
{
    switch (kind) {
    case PCG_BOOL: return "true or false";
    case PCG_INT: return "a whole number";
    case PCG_FLOAT: return "a number";
    case PCG_STRING: case PCG_PATH: return "a text in double quotes";
    case PCG_VEC2: return "two numbers, as in [1, 2]";
    case PCG_VEC3: return "three numbers, as in [1, 2, 3]";
    case PCG_VEC4: case PCG_QUATERNION: return "four numbers, as in [1, 2, 3, 4]";
    case PCG_COLOR: return "a color, as in #ff8800";
    case PCG_LIST: return "a list, as in [1, 2, 3]";
    case PCG_LENGTH: return "a length, as in 12m";
    case PCG_AREA: return "an area, as in 20m2";
    case PCG_ANGLE: return "an angle, as in 30deg";
    case PCG_RATIO: return "a ratio, as in 50% or 0.5";
    case PCG_SECONDS: return "a time, as in 2s";
    default: return "another value";
    }
}

/* ---- words ---------------------------------------------------------------------------------- */

static void skip_blanks(reader *in)
{
    while (*in->at == ' ' || *in->at == '\t' || *in->at == '\n' || *in->at == '\r')
        in->at++;
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           ((unsigned char)c & 0x80);
}

static size_t word_length(const char *s)
{
    size_t n = 0;
    while (is_word(s[n]))
        n++;
    return n;
}

static bool word_is(const char *s, size_t length, const char *word)
{
    return strlen(word) == length && !memcmp(s, word, length);
}

static bool take(reader *in, char c)
{
    skip_blanks(in);
    if (*in->at != c)
        return false;
    in->at++;
    return true;
}

/* ---- numbers -------------------------------------------------------------------------------- */

static bool read_bool(reader *in, pcg_cell *to)
{
    size_t length = word_length(in->at);
    bool yes = word_is(in->at, length, "true");
    if (!yes && !word_is(in->at, length, "false"))
        return refuse(in, expected_of(PCG_BOOL), in->at);
    to->i = yes;
    in->at += length;
    return true;
}

static bool read_int(reader *in, pcg_cell *to)
{
    const char *s = in->at;
    bool negative = *s == '-';
    pcg_u64 value = 0, limit = (pcg_u64)INT64_MAX + negative;
    if (*s == '-' || *s == '+')
        s++;
    if (*s < '0' || *s > '9')
        return refuse(in, expected_of(PCG_INT), in->at);
    for (; *s >= '0' && *s <= '9'; s++) {
        pcg_u64 digit = (pcg_u64)(*s - '0');
        if (value > (limit - digit) / 10)
            return refuse(in, "a whole number of 64 bits", in->at);
        value = value * 10 + digit;
    }
    if (is_word(*s) || *s == '.' || *s == '%')
        return refuse(in, expected_of(PCG_INT), in->at);
    to->i = negative ? (pcg_int)(0 - value) : (pcg_int)value;
    in->at = s;
    return true;
}

static const struct unit_row *find_unit(const char *s, size_t length)
{
    for (size_t i = 0; i < COUNT_OF(units); i++)
        if (word_is(s, length, units[i].name))
            return &units[i];
    return NULL;
}

static bool refuse_unit(const reader *in, int kind, int found)
{
    char shown[SHOWN + 8];
    const char *what = value_kind_name(found);
    show(shown, in->at);
    snprintf(in->why, VALUE_WHY_BYTES, "takes %s; '%s' is %s %s", expected_of(kind), shown,
             article(what), what);
    return false;
}

/* A number whose unit, where it has one, is that of `kind`. */
static bool read_number(reader *in, int kind, int expected, double *to)
{
    const char *behind;
    double value = number_read(in->at, &behind);
    if (behind == in->at)
        return refuse(in, expected_of(expected), in->at);
    size_t length = *behind == '%' ? 1 : word_length(behind);
    const struct unit_row *unit = length ? find_unit(behind, length) : NULL;
    if (length && !unit)
        return refuse(in, expected_of(expected), in->at);
    if (unit && unit->kind != kind)
        return refuse_unit(in, expected, unit->kind);
    if (unit)
        value = value * unit->times / unit->over;
    if (!isfinite(value))
        return refuse(in, "a finite number", in->at);
    *to = value;
    in->at = behind + length;
    return true;
}

/* [1, 2, 3], (1, 2, 3) or vec3(1, 2, 3). Components of vec2 and vec3 may be lengths. */
static bool read_vector(reader *in, int kind, pcg_cell *to)
{
    const char *from = in->at;
    size_t length = word_length(from);
    if (length && word_is(from, length, value_kind_name(kind)))
        in->at += length;
    char close = take(in, '[') ? ']' : take(in, '(') ? ')' : '\0';
    if (!close)
        return refuse(in, expected_of(kind), from);
    for (pcg_u32 i = 0; i < value_width(kind); i++) {
        if (i && !take(in, ','))
            return refuse(in, expected_of(kind), from);
        skip_blanks(in);
        if (!read_number(in, kind == PCG_VEC2 || kind == PCG_VEC3 ? PCG_LENGTH : PCG_FLOAT, kind,
                         &to[i].f))
            return false;
    }
    return take(in, close) || refuse(in, expected_of(kind), from);
}

/* ---- colors and enumerators ----------------------------------------------------------------- */

static int hex_value(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* #rgb, #rrggbb, #rrggbbaa */
static bool read_color(reader *in, pcg_cell *to)
{
    const char *s = in->at + 1;
    size_t length = *in->at == '#' ? word_length(s) : 0;
    bool good = length == 3 || length == 6 || length == 8;
    for (size_t i = 0; i < length; i++)
        good = good && hex_value(s[i]) >= 0;
    if (!good)
        return refuse(in, expected_of(PCG_COLOR), in->at);
    to[3].f = 1;
    for (size_t i = 0; i < (length == 8 ? 4 : 3); i++) {
        int high = hex_value(s[length == 3 ? i : 2 * i]);
        int low = hex_value(s[length == 3 ? i : 2 * i + 1]);
        to[i].f = (double)(high * 16 + low) / 255;
    }
    in->at = s + length;
    return true;
}

/* "x, y or z" */
static void list_enumerators(char *out, size_t size, const char *enumerators)
{
    size_t used = 0, length, next;
    const char *at;
    out[0] = '\0';
    for (pcg_int i = 0; (at = value_enumerator(enumerators, i, &length)); i++) {
        const char *between = i == 0                                        ? ""
                              : value_enumerator(enumerators, i + 1, &next) ? ", "
                                                                            : " or ";
        if (used + length + 8 > size) {
            strcpy(out + used, " …");
            return;
        }
        used += (size_t)snprintf(out + used, size - used, "%s%.*s", between, (int)length, at);
    }
}

static bool refuse_enumerator(const reader *in, const char *enumerators, const char *found)
{
    char expected[240];
    list_enumerators(expected, sizeof expected, enumerators);
    return refuse(in, expected, found);
}

static bool read_enumerator(reader *in, const char *enumerators, pcg_cell *to)
{
    size_t length = word_length(in->at);
    to->i = value_enumerator_number(enumerators, in->at, length);
    if (to->i < 0)
        return refuse_enumerator(in, enumerators, in->at);
    in->at += length;
    return true;
}

/* ---- strings -------------------------------------------------------------------------------- */

static size_t put_utf8(char *out, uint32_t c)
{
    size_t count = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = count - 1; i; i--, c >>= 6)
        out[i] = (char)(0x80 | (c & 0x3F));
    out[0] = (char)(count == 1 ? c : (0xF00u >> count & 0xF0) | c);
    return count;
}

static bool read_hex4(const char *s, uint32_t *to)
{
    *to = 0;
    for (int i = 0; i < 4; i++) {
        int digit = hex_value(s[i]);
        if (digit < 0)
            return false;
        *to = *to << 4 | (uint32_t)digit;
    }
    return true;
}

/* uXXXX, or a pair of them; how many bytes were read, 0 where it is no character. */
static size_t read_unicode(const char *s, char *out, size_t *length)
{
    uint32_t c, low;
    size_t read = 5;
    if (!read_hex4(s + 1, &c) || c == 0 || (c >= 0xDC00 && c < 0xE000))
        return 0;
    if (c >= 0xD800 && c < 0xDC00) {
        if (s[5] != '\\' || s[6] != 'u' || !read_hex4(s + 7, &low) || low < 0xDC00 || low >= 0xE000)
            return 0;
        c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
        read = 11;
    }
    *length += put_utf8(out + *length, c);
    return read;
}

/* What stands behind a backslash; how many bytes were read, 0 where it is no escape. Writes no more
 * than it reads. */
static size_t read_escape(const char *s, char *out, size_t *length)
{
    static const char names[] = "nrt\"'\\/", values[] = "\n\r\t\"'\\/";
    const char *known = *s ? strchr(names, *s) : NULL;
    if (known) {
        out[(*length)++] = values[known - names];
        return 1;
    }
    return *s == 'u' ? read_unicode(s, out, length) : 0;
}

/* Escapes resolved into `out`, which is as long as the text; false where it does not end. */
static bool unescape(reader *in, char *out)
{
    const char *s = in->at + 1;
    size_t length = 0;
    while (*s && *s != '"') {
        if (*s != '\\') {
            out[length++] = *s++;
            continue;
        }
        size_t read = read_escape(s + 1, out, &length);
        if (!read)
            return refuse(in, "a text with escapes such as \\n, \\\" and \\u00e9", s);
        s += 1 + read;
    }
    out[length] = '\0';
    if (*s != '"')
        return refuse(in, "a text that ends with its quote", in->at);
    in->at = s + 1;
    return true;
}

static bool keep_string(const reader *in, const char *s, pcg_cell *to)
{
    if (!value_is_utf8(s))
        return refuse(in, "a text in UTF-8", s);
    to->s = pcg_string(in->run, s);
    return true;
}

static bool read_quoted(reader *in, pcg_cell *to)
{
    if (*in->at != '"')
        return refuse(in, expected_of(PCG_STRING), in->at);
    size_t size = strlen(in->at) + 1;
    char *out = run_alloc(in->run, size);
    if (!out)
        return refuse(in, "what memory has room for", in->at);
    bool good = unescape(in, out) && keep_string(in, out, to);
    run_free(in->run, out, size);
    return good;
}

/* ---- lists and all of them ------------------------------------------------------------------ */

static bool read_value(reader *in, const value_type *t, pcg_cell *to);

typedef struct cells {
    pcg_cell *at;
    size_t count, capacity;
} cells;

static bool cells_reserve(pcg_run *r, cells *c, size_t more)
{
    if (c->count + more <= c->capacity)
        return true;
    size_t bytes = run_capacity((c->capacity * 2 + more) * sizeof *c->at);
    pcg_cell *at = run_resize(r, c->at, c->capacity * sizeof *at, bytes);
    if (!at)
        return false;
    c->at = at;
    c->capacity = bytes / sizeof *at;
    return true;
}

static bool read_elements(reader *in, const value_type *element, cells *found)
{
    const char *from = in->at;
    size_t width = value_width(element->kind);
    if (take(in, ']'))
        return true;
    do {
        skip_blanks(in);
        if (!cells_reserve(in->run, found, width))
            return refuse(in, "what memory has room for", in->at);
        if (!read_value(in, element, found->at + found->count))
            return false;
        found->count += width;
    } while (take(in, ','));
    return take(in, ']') || refuse(in, "a list that ends with ]", from - 1);
}

static bool keep_list(const reader *in, const cells *found, pcg_u32 width, pcg_cell *to)
{
    pcg_list *list = found->count > UINT32_MAX
                         ? NULL
                         : pcg_alloc(in->run, sizeof *list + found->count * sizeof *found->at);
    if (!list)
        return refuse(in, "what memory has room for", in->at);
    list->count = (pcg_u32)found->count / width;
    list->width = width;
    if (found->count)
        memcpy(list->at, found->at, found->count * sizeof *found->at);
    to->list = list;
    return true;
}

static bool read_list(reader *in, const value_type *t, pcg_cell *to)
{
    value_type element = {.kind = t->element, .element = PCG_INT, .enumerators = t->enumerators};
    cells found = {0};
    if (t->element == PCG_LIST)
        return refuse(in, "lists of lists, which no text can set", in->at);
    if (!take(in, '['))
        return refuse(in, expected_of(PCG_LIST), in->at);
    bool good =
        read_elements(in, &element, &found) && keep_list(in, &found, value_width(t->element), to);
    run_free(in->run, found.at, found.capacity * sizeof *found.at);
    return good;
}

static bool read_value(reader *in, const value_type *t, pcg_cell *to)
{
    switch (t->kind) {
    case PCG_BOOL: return read_bool(in, to);
    case PCG_INT: return read_int(in, to);
    case PCG_STRING: case PCG_PATH: return read_quoted(in, to);
    case PCG_COLOR: return read_color(in, to);
    case PCG_VEC2:
    case PCG_VEC3:
    case PCG_VEC4:
    case PCG_QUATERNION:
        return read_vector(in, t->kind, to);
    case PCG_LIST: return read_list(in, t, to);
    case PCG_ENUM: return read_enumerator(in, t->enumerators, to);
    default: return read_number(in, t->kind, t->kind, &to->f);
    }
}

bool value_read(pcg_run *r, const value_type *t, const char *from, pcg_cell *to, char *why)
{
    reader in = {.run = r, .at = from, .why = why};
    why[0] = '\0';
    skip_blanks(&in);
    if ((t->kind == PCG_STRING || t->kind == PCG_PATH) && *in.at != '"')
        return keep_string(&in, from, to);
    if (!read_value(&in, t, to))
        return false;
    skip_blanks(&in);
    if (!*in.at)
        return true;
    return t->kind == PCG_ENUM ? refuse_enumerator(&in, t->enumerators, from)
                               : refuse(&in, expected_of(t->kind), from);
}

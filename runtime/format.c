/* format.c - printf's formats without its locale: '.' is the decimal point everywhere. */
#include <math.h>
#include <string.h>

#include "run.h"

enum { PIECE = 512, MAX_DIGITS = 150 };

typedef enum argument_length {
    LENGTH_INT,
    LENGTH_LONG,
    LENGTH_LONG_LONG,
    LENGTH_SIZE
} argument_length;

/* One directive: %[flags][width][.precision][length]conversion. */
typedef struct directive {
    char flags[6];
    int width, precision; /* -1: none */
    argument_length length;
    char conversion;
} directive;

static int limited(int n)
{
    return n > MAX_DIGITS ? MAX_DIGITS : n;
}

static const char *read_count(const char *s, va_list *arguments, int *to)
{
    *to = 0;
    if (*s == '*') {
        int given = va_arg(*arguments, int);
        *to = given < 0 ? -1 : limited(given);
        return s + 1;
    }
    for (; *s >= '0' && *s <= '9'; s++)
        *to = limited(*to * 10 + (*s - '0'));
    return s;
}

static const char *read_length(const char *s, argument_length *to)
{
    *to = LENGTH_INT;
    for (; *s == 'h'; s++) {
    }
    for (; *s == 'l'; s++)
        *to = *to == LENGTH_INT ? LENGTH_LONG : LENGTH_LONG_LONG;
    if (*s == 'z' || *s == 't' || *s == 'j') {
        *to = *s == 'j' ? LENGTH_LONG_LONG : LENGTH_SIZE;
        s++;
    }
    return s;
}

/* Reads what follows a '%'; returns what is behind it. */
static const char *read_directive(const char *s, va_list *arguments, directive *d)
{
    size_t flags = 0;
    memset(d, 0, sizeof *d);
    d->width = d->precision = -1;
    for (; *s && strchr("-+ #0", *s); s++)
        if (flags + 1 < sizeof d->flags)
            d->flags[flags++] = *s;
    if (*s == '*' || (*s >= '1' && *s <= '9'))
        s = read_count(s, arguments, &d->width);
    if (*s == '.')
        s = read_count(s + 1, arguments, &d->precision);
    s = read_length(s, &d->length);
    d->conversion = *s;
    return *s ? s + 1 : s;
}

/* "%-08.3lld", for a directive whose argument is of the length that `modifier` names. */
static void write_directive(const directive *d, const char *modifier, char *out, size_t size)
{
    size_t used = (size_t)snprintf(out, size, "%%%s", d->flags);
    if (d->width >= 0)
        used += (size_t)snprintf(out + used, size - used, "%d", d->width);
    if (d->precision >= 0)
        used += (size_t)snprintf(out + used, size - used, ".%d", d->precision);
    snprintf(out + used, size - used, "%s%c", modifier, d->conversion);
}

static long long signed_argument(argument_length length, va_list *arguments)
{
    switch (length) {
    case LENGTH_LONG: return va_arg(*arguments, long);
    case LENGTH_LONG_LONG: return va_arg(*arguments, long long);
    case LENGTH_SIZE: return va_arg(*arguments, ptrdiff_t);
    default: return va_arg(*arguments, int);
    }
}

static unsigned long long unsigned_argument(argument_length length, va_list *arguments)
{
    switch (length) {
    case LENGTH_LONG: return va_arg(*arguments, unsigned long);
    case LENGTH_LONG_LONG: return va_arg(*arguments, unsigned long long);
    case LENGTH_SIZE: return va_arg(*arguments, size_t);
    default: return va_arg(*arguments, unsigned);
    }
}

/* What is no part of a number in the C locale is the host's decimal point, of however many
 * bytes. */
static void add_float(text *out, const char *piece)
{
    while (*piece) {
        size_t known = strspn(piece, "0123456789+-eExXpPaAbBcCdDfFiInNtTyY ");
        text_add_bytes(out, piece, known);
        piece += known;
        if (!*piece)
            break;
        text_add(out, ".");
        while (*piece && !(*piece >= '0' && *piece <= '9') && *piece != ' ')
            piece++;
    }
}

/* How many of so many bytes are whole characters; the byte behind them may not be there. */
static size_t whole_characters(const char *s, size_t length)
{
    size_t start = length;
    while (start && ((unsigned char)s[start - 1] & 0xC0) == 0x80)
        start--;
    if (!start)
        return length;
    unsigned char first = (unsigned char)s[start - 1];
    size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    return start - 1 + size > length ? start - 1 : length;
}

/* A string with width and precision, which count bytes, as in C, but never cut a character. */
static void add_string(text *out, const directive *d, const char *s)
{
    size_t length = 0, limit = d->precision < 0 ? SIZE_MAX : (size_t)d->precision;
    if (!s)
        s = "(null)";
    while (length < limit && s[length])
        length++;
    if (length == limit)
        length = whole_characters(s, length);
    size_t pad = d->width > 0 && (size_t)d->width > length ? (size_t)d->width - length : 0;
    bool left = strchr(d->flags, '-') != NULL;
    for (size_t i = 0; i < pad && !left; i++)
        text_add(out, " ");
    text_add_bytes(out, s, length);
    for (size_t i = 0; i < pad && left; i++)
        text_add(out, " ");
}

/* Which sign it has when something has no result, machines and compilers do not agree on. */
static double without_sign_of_nan(double x)
{
    return isnan(x) ? copysign(x, 1) : x;
}

static void add_argument(text *out, const directive *d, va_list *arguments)
{
    char format[64], piece[PIECE];
    switch (d->conversion) {
    case 'd': case 'i':
        write_directive(d, "ll", format, sizeof format);
        snprintf(piece, sizeof piece, format, signed_argument(d->length, arguments));
        text_add(out, piece);
        break;
    case 'u': case 'x': case 'X': case 'o':
        write_directive(d, "ll", format, sizeof format);
        snprintf(piece, sizeof piece, format, unsigned_argument(d->length, arguments));
        text_add(out, piece);
        break;
    case 'e': case 'E': case 'f': case 'F': case 'g': case 'G':
        write_directive(d, "", format, sizeof format);
        snprintf(piece, sizeof piece, format, without_sign_of_nan(va_arg(*arguments, double)));
        add_float(out, piece);
        break;
    case 'c':
        piece[0] = (char)va_arg(*arguments, int);
        text_add_bytes(out, piece, 1);
        break;
    case 's':
        add_string(out, d, va_arg(*arguments, const char *));
        break;
    default: /* %%, and what is none: as it stands */
        text_add_bytes(out, d->conversion ? &d->conversion : "%", 1);
        break;
    }
}

void message_format(text *out, const char *format, va_list arguments)
{
    va_list rest;
    va_copy(rest, arguments);
    text_add(out, "");
    while (*format) {
        size_t plain = strcspn(format, "%");
        text_add_bytes(out, format, plain);
        format += plain;
        if (!*format)
            break;
        directive d;
        format = read_directive(format + 1, &rest, &d);
        add_argument(out, &d, &rest);
    }
    va_end(rest);
}

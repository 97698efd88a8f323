/* text.c - a growing string; numbers to text and back, whatever the locale. */
#include "base.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Room for `more` bytes and a NUL behind what is there; false where there is none. */
static bool reserve(text *t, size_t more)
{
    if (more > SIZE_MAX / 4 - t->length)
        more = SIZE_MAX / 2; /* the arena says no to it */
    if (t->at && t->length + more < t->capacity)
        return true;
    size_t wanted = t->capacity < 32 ? 64 : t->capacity * 2;
    if (wanted <= t->length + more)
        wanted = t->length + more + 1;
    char *at = arena_resize(t->arena, t->at, t->capacity, wanted);
    if (!at)
        return false;
    t->at = at;
    t->capacity = wanted;
    return true;
}

void text_add_bytes(text *t, const char *bytes, size_t length)
{
    if (!reserve(t, length))
        return;
    if (length)
        memcpy(t->at + t->length, bytes, length);
    t->length += length;
    t->at[t->length] = '\0';
}

void text_add(text *t, const char *string)
{
    text_add_bytes(t, string, strlen(string));
}

void text_format(text *t, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    if (length >= 0 && reserve(t, (size_t)length)) {
        vsnprintf(t->at + t->length, (size_t)length + 1, format, again);
        t->length += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

void text_quote(text *t, const char *string)
{
    text_add(t, "\"");
    for (const char *s = string; *s; s++) {
        unsigned char c = (unsigned char)*s;
        if (c == '"' || c == '\\')
            text_format(t, "\\%c", c);
        else if (c == '\n')
            text_add(t, "\\n");
        else if (c == '\t')
            text_add(t, "\\t");
        else if (c < 0x20 || c == 0x7f)
            text_format(t, "\\u%04x", (unsigned)c);
        else
            text_add_bytes(t, s, 1);
    }
    text_add(t, "\"");
}

/* ---- numbers to text --------------------------------------------------------------------------
 */

enum { DIGITS = 17 }; /* that always tell two doubles apart */

/* A decimal: 0.d1d2d3… * 10^point. */
typedef struct decimal {
    char digits[DIGITS + 1];
    int count, point;
} decimal;

/* The first `count` significant digits of a finite value > 0. The locale's radix character is
 * skipped, whatever it is: only digits are taken. */
static decimal decimal_round(double value, int count)
{
    char printed[64];
    decimal d = {.count = 0};
    snprintf(printed, sizeof printed, "%.*e", count - 1, value);
    const char *s = printed;
    for (; *s && *s != 'e'; s++)
        if (*s >= '0' && *s <= '9' && d.count < DIGITS)
            d.digits[d.count++] = *s;
    d.point = *s ? atoi(s + 1) + 1 : 1;
    while (d.count > 1 && d.digits[d.count - 1] == '0')
        d.count--;
    d.digits[d.count] = '\0';
    return d;
}

static double decimal_value(const decimal *d)
{
    char written[40];
    snprintf(written, sizeof written, "%se%d", d->digits, d->point - d->count);
    return number_read(written, NULL);
}

/* 15 digits are right for every value that has a form as short, except where doubles themselves
 * hold fewer digits. */
static decimal decimal_shortest(double value)
{
    decimal d;
    int count = value < 1e-290 ? 1 : 15;
    do
        d = decimal_round(value, count);
    while (decimal_value(&d) != value && count++ < DIGITS);
    return d;
}

static void write_zeros(text *t, int count)
{
    for (; count > 0; count--)
        text_add(t, "0");
}

static void write_plain(text *t, const decimal *d)
{
    if (d->point <= 0) {
        text_add(t, "0.");
        write_zeros(t, -d->point);
        text_add(t, d->digits);
    } else if (d->count <= d->point) {
        text_add(t, d->digits);
        write_zeros(t, d->point - d->count);
    } else {
        text_add_bytes(t, d->digits, (size_t)d->point);
        text_add(t, ".");
        text_add(t, d->digits + d->point);
    }
}

static void write_exponent(text *t, const decimal *d)
{
    text_add_bytes(t, d->digits, 1);
    if (d->count > 1) {
        text_add(t, ".");
        text_add(t, d->digits + 1);
    }
    text_format(t, "e%+d", d->point - 1);
}

void text_number(text *t, double value)
{
    if (isnan(value)) {
        text_add(t, "nan");
        return;
    }
    if (signbit(value))
        text_add(t, "-");
    value = fabs(value);
    if (isinf(value)) {
        text_add(t, "inf");
    } else if (value < 1e15 && value == floor(value)) {
        text_format(t, "%lld", (long long)value);
    } else {
        decimal d = decimal_shortest(value);
        if (d.point > -6 && d.point <= 21)
            write_plain(t, &d);
        else
            write_exponent(t, &d);
    }
}

/* ---- text to numbers --------------------------------------------------------------------------
 */

/* More significant digits than this cannot change the nearest double, but for one more that says
 * that some digit behind was not 0. */
enum { SIGNIFICANT = 780, LARGEST_EXPONENT = 100000 };

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* The digits of a number without point and leading zeros, and the power of ten they are times. */
typedef struct scan {
    char digits[SIGNIFICANT + 16];
    int count;
    long exponent;
    bool any;
} scan;

static const char *scan_digits(scan *n, const char *s, bool fraction)
{
    for (; is_digit(*s); s++) {
        n->any = true;
        if (n->count >= SIGNIFICANT) {
            if (*s != '0')
                n->digits[SIGNIFICANT - 1] = '1';
            n->exponent += n->exponent < LARGEST_EXPONENT * 1000L && !fraction;
        } else {
            if (n->count || *s != '0')
                n->digits[n->count++] = *s;
            n->exponent -= n->exponent > -LARGEST_EXPONENT * 1000L && fraction;
        }
    }
    return s;
}

/* e [+-] digits; without digits, the e is not part of the number. */
static const char *scan_exponent(scan *n, const char *s)
{
    if (*s != 'e' && *s != 'E') /* it may be the NUL, behind which nothing is */
        return s;
    const char *at = s + 1;
    bool negative = *at == '-';
    long exponent = 0;
    at += *at == '-' || *at == '+';
    if (!is_digit(*at))
        return s;
    for (; is_digit(*at); at++)
        if (exponent < LARGEST_EXPONENT * 1000L)
            exponent = exponent * 10 + (*at - '0');
    n->exponent += negative ? -exponent : exponent;
    return at;
}

/* strtod is right to the last bit but reads the locale's radix character; a whole number with an
 * exponent has none. */
double number_read(const char *s, const char **end)
{
    scan n = {.count = 0};
    const char *at = s + (*s == '-' || *s == '+');
    at = scan_digits(&n, at, false);
    if (*at == '.' && (n.any || is_digit(at[1])))
        at = scan_digits(&n, at + 1, true);
    if (n.any)
        at = scan_exponent(&n, at);
    if (end)
        *end = n.any ? at : s;
    if (!n.count)
        return n.any && *s == '-' ? -0.0 : 0.0;
    long exponent = n.exponent;
    if (exponent > LARGEST_EXPONENT)
        exponent = LARGEST_EXPONENT;
    if (exponent < -LARGEST_EXPONENT)
        exponent = -LARGEST_EXPONENT;
    snprintf(n.digits + n.count, sizeof n.digits - (size_t)n.count, "e%ld", exponent);
    int before = errno;
    double value = strtod(n.digits, NULL);
    errno = before; /* too large and too small are values here, no errors */
    return *s == '-' ? -value : value;
}

/* quantity.c - what people write into the fields of maps, as values of the language: "12", "12 m",
 * "40'", "3;4", "yes", "NW", "brown".
 */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gis.h"
#include "runtime/base/base.h"

/* A part of a field is no longer than this; longer ones are none of the values that are read. */
enum { PART_BYTES = 64 };

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* ---- units ----------------------------------------------------------------------------------- */

typedef struct unit {
    const char *name;
    int kind;
    double factor; /* to the language's base unit; of speeds, to kilometres an hour */
} unit;

static const unit units[] = {
    {"m", PCG_LENGTH, 1},          {"meter", PCG_LENGTH, 1},     {"meters", PCG_LENGTH, 1},
    {"metres", PCG_LENGTH, 1},     {"cm", PCG_LENGTH, 0.01},     {"mm", PCG_LENGTH, 0.001},
    {"km", PCG_LENGTH, 1000},      {"ft", PCG_LENGTH, 0.3048},   {"feet", PCG_LENGTH, 0.3048},
    {"'", PCG_LENGTH, 0.3048},     {"in", PCG_LENGTH, 0.0254},   {"\"", PCG_LENGTH, 0.0254},
    {"yd", PCG_LENGTH, 0.9144},    {"mi", PCG_LENGTH, 1609.344}, {"m2", PCG_AREA, 1},
    {"m\302\262", PCG_AREA, 1},    {"ha", PCG_AREA, 10000},      {"km2", PCG_AREA, 1e6},
    {"km\302\262", PCG_AREA, 1e6}, {"deg", PCG_ANGLE, 1},        {"\302\260", PCG_ANGLE, 1},
    {"%", PCG_RATIO, 0.01},        {"s", PCG_SECONDS, 1},        {"min", PCG_SECONDS, 60},
    {"h", PCG_SECONDS, 3600},      {"km/h", PCG_FLOAT, 1},       {"kmh", PCG_FLOAT, 1},
    {"mph", PCG_FLOAT, 1.609344},
};

/* Plain numbers take every unit, kinds with a unit take their own. */
static bool unit_read(const char *name, int kind, double *value)
{
    if (!*name)
        return true;
    for (size_t i = 0; i < COUNT_OF(units); i++)
        if (!strcmp(units[i].name, name) &&
            (kind == PCG_FLOAT || kind == PCG_INT || units[i].kind == kind)) {
            *value *= units[i].factor;
            return true;
        }
    return false;
}

/* "6'" is behind us: the inches of 6'7". */
static bool inches_read(const char *s, int kind, double *value)
{
    const char *end;
    double inches = number_read(s, &end);
    if (end == s || strcmp(end, "\"") != 0 ||
        (kind != PCG_LENGTH && kind != PCG_FLOAT && kind != PCG_INT))
        return false;
    *value = *value * 0.3048 + inches * 0.0254;
    return true;
}

/* ---- numbers --------------------------------------------------------------------------------- */

/* Turns a decimal comma into a point. What could be thousands, "1,200", is left, and is then no
 * number. */
static void mend_comma(char *part)
{
    char *comma = strchr(part, ',');
    size_t digits = 0;
    while (comma && is_digit(comma[1 + digits]))
        digits++;
    if (comma && digits && digits != 3 && !strchr(part, '.') && !strchr(comma + 1, ','))
        *comma = '.';
}

static bool quantity_read(char *part, int kind, double *to)
{
    const char *end;
    mend_comma(part);
    *to = number_read(part, &end);
    if (end == part)
        return false;
    while (is_space(*end))
        end++;
    bool read =
        end[0] == '\'' && end[1] ? inches_read(end + 1, kind, to) : unit_read(end, kind, to);
    return read && isfinite(*to);
}

bool gis_number_read(const char *field, double *to)
{
    const char *end;
    *to = number_read(field, &end);
    return end != field && !*end && isfinite(*to);
}

static bool direction_read(const char *part, double *to)
{
    static const char points[16][4] = {"n", "nne", "ne", "ene", "e", "ese", "se", "sse",
                                       "s", "ssw", "sw", "wsw", "w", "wnw", "nw", "nnw"};
    for (size_t i = 0; i < COUNT_OF(points); i++)
        if (!strcmp(points[i], part)) {
            *to = 22.5 * (double)i;
            return true;
        }
    return false;
}

static bool int_read(char *part, pcg_int *to)
{
    char *end;
    double value;
    errno = 0;
    *to = strtoll(part, &end, 10);
    if (end != part && !*end)
        return errno == 0;
    if (!quantity_read(part, PCG_INT, &value) || fabs(value) > 9e18)
        return false;
    *to = (pcg_int)floor(value + 0.5);
    return true;
}

static bool bool_read(const char *part, pcg_int *to)
{
    *to = !strcmp(part, "yes") || !strcmp(part, "true") || !strcmp(part, "1");
    return *to || !strcmp(part, "no") || !strcmp(part, "false") || !strcmp(part, "0");
}

/* ---- colours --------------------------------------------------------------------------------- */

typedef struct named_color {
    const char *name;
    uint32_t rgb;
} named_color;

/* Those of HTML, and what else walls and roofs are said to be. */
static const named_color colors[] = {
    {"black", 0x000000},     {"silver", 0xc0c0c0},    {"gray", 0x808080},
    {"grey", 0x808080},      {"white", 0xffffff},     {"maroon", 0x800000},
    {"red", 0xff0000},       {"purple", 0x800080},    {"fuchsia", 0xff00ff},
    {"green", 0x008000},     {"lime", 0x00ff00},      {"olive", 0x808000},
    {"yellow", 0xffff00},    {"navy", 0x000080},      {"blue", 0x0000ff},
    {"teal", 0x008080},      {"aqua", 0x00ffff},      {"orange", 0xffa500},
    {"brown", 0xa52a2a},     {"beige", 0xf5f5dc},     {"tan", 0xd2b48c},
    {"pink", 0xffc0cb},      {"cream", 0xfffdd0},     {"darkgray", 0xa9a9a9},
    {"darkgrey", 0xa9a9a9},  {"lightgray", 0xd3d3d3}, {"lightgrey", 0xd3d3d3},
    {"darkred", 0x8b0000},   {"firebrick", 0xb22222}, {"sienna", 0xa0522d},
    {"chocolate", 0xd2691e}, {"ivory", 0xfffff0},
};

static int hexadecimal(char c)
{
    return is_digit(c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* "#rgb" and "#rrggbb". */
static bool hexadecimal_read(const char *digits, uint32_t *rgb)
{
    size_t length = strlen(digits);
    *rgb = 0;
    if (length != 3 && length != 6)
        return false;
    for (size_t i = 0; i < length; i++) {
        int digit = hexadecimal(digits[i]);
        if (digit < 0)
            return false;
        *rgb = length == 6 ? *rgb * 16 + (uint32_t)digit : *rgb * 256 + (uint32_t)digit * 17;
    }
    return true;
}

static bool color_read(const char *part, pcg_cell *to)
{
    uint32_t rgb = 0;
    bool found = part[0] == '#' && hexadecimal_read(part + 1, &rgb);
    for (size_t i = 0; !found && i < COUNT_OF(colors); i++)
        if (!strcmp(colors[i].name, part)) {
            rgb = colors[i].rgb;
            found = true;
        }
    for (int i = 0; i < 3; i++)
        to[i].f = (double)(rgb >> (16 - 8 * i) & 255) / 255;
    to[3].f = 1;
    return found;
}

/* ---- values ---------------------------------------------------------------------------------- */

bool gis_kind_is_read(int kind)
{
    return kind == PCG_BOOL || kind == PCG_INT || kind == PCG_FLOAT || kind == PCG_COLOR ||
           kind >= PCG_LENGTH;
}

static bool part_read(char *part, int kind, pcg_cell *to)
{
    switch (kind) {
    case PCG_BOOL:
        return bool_read(part, &to->i);
    case PCG_INT:
        return int_read(part, &to->i);
    case PCG_COLOR:
        return color_read(part, to);
    case PCG_ANGLE:
        return direction_read(part, &to->f) || quantity_read(part, kind, &to->f);
    default:
        return quantity_read(part, kind, &to->f);
    }
}

bool gis_value_read(const char *field, int kind, pcg_cell *to)
{
    if (!gis_kind_is_read(kind))
        return false;
    while (field) {
        char part[PART_BYTES];
        size_t length = strcspn(field, ";");
        const char *next = field[length] ? field + length + 1 : NULL;
        while (length && is_space(*field))
            field++, length--;
        while (length && is_space(field[length - 1]))
            length--;
        for (size_t i = 0; i < length && i < PART_BYTES; i++)
            part[i] = lower(field[i]);
        if (length && length < PART_BYTES) {
            part[length] = '\0';
            if (part_read(part, kind, to))
                return true;
        }
        field = next;
    }
    return false;
}

/* ---- tags ------------------------------------------------------------------------------------ */

/* Copies what stands in quotes at *at, and moves behind it. False where no quotes stand there,
 * or they do not close. */
static bool quoted_copy(const char **at, char *out)
{
    const char *s = *at;
    if (*s++ != '"')
        return false;
    while (*s && *s != '"') {
        if (*s == '\\' && s[1])
            s++;
        *out++ = *s++;
    }
    *out = '\0';
    bool closed = *s == '"';
    *at = s + closed;
    return closed;
}

bool gis_tags_find(const char *tags, const char *key, char *out)
{
    for (;;) {
        if (!quoted_copy(&tags, out) || strncmp(tags, "=>", 2) != 0)
            return false;
        bool found = !strcmp(out, key);
        tags += 2;
        if (!quoted_copy(&tags, out))
            return false;
        if (found)
            return true;
        if (*tags++ != ',')
            return false;
    }
}

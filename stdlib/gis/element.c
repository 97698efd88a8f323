/* element.c - finds what stands among the features of a GeoJSON file and is no object, which GDAL
 * passes over without a word. It knows so much of JSON as that takes: GDAL judges the rest.
 */
#include <string.h>

#include "gis.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* A byte of a string; those of a key at the top are kept, as far as they matter. */
static void take_string_byte(gis_elements *e, char c)
{
    bool kept = e->depth == 1 && e->key_length < sizeof e->key;
    if (e->escaped) {
        e->escaped = false;
    } else if (c == '\\') {
        e->escaped = true;
    } else if (c == '"') {
        e->in_string = false;
        return;
    }
    if (kept)
        e->key[e->key_length] = c;
    e->key_length += e->depth == 1;
}

static bool at_features(const gis_elements *e)
{
    static const char name[] = "features";
    return e->depth == 1 && e->is_value && e->key_length == sizeof name - 1 &&
           !memcmp(e->key, name, sizeof name - 1);
}

static void open_bracket(gis_elements *e, char c)
{
    if (c == '[' && at_features(e))
        e->in_features = true;
    e->depth++;
}

static void close_bracket(gis_elements *e)
{
    if (e->depth > 0)
        e->depth--;
    if (e->depth <= 1)
        e->in_features = false;
}

/* Whether an element begins here that is no object. */
static bool begins_other(gis_elements *e, char c)
{
    if (!e->in_features || e->depth != 2)
        return false;
    if (c == ',') {
        e->index++;
        e->begun = false;
        return false;
    }
    bool first = !e->begun && c != ']';
    e->begun = true;
    return first && c != '{';
}

bool gis_element_is_other(gis_elements *e, char c)
{
    if (e->in_string) {
        take_string_byte(e, c);
        return false;
    }
    if (is_blank(c))
        return false;
    bool other = begins_other(e, c);
    if (c == '"') {
        e->in_string = true;
        if (e->depth == 1)
            e->key_length = 0;
    } else if (c == '[' || c == '{') {
        open_bracket(e, c);
    } else if (c == ']' || c == '}') {
        close_bracket(e);
    }
    if (e->depth == 1 && (c == ':' || c == ','))
        e->is_value = c == ':';
    return other;
}

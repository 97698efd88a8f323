/* constraint.c - constraints of parameters. */
#include "constraint.h"

#include <string.h>

enum { RANGE, ONE_OF, MATCHES, AT_MOST }; /* pcg_constraint_info.kind */

enum { PATTERN_MEMORY = 64 << 20, SHOWN_BYTES = 80 };

/* The value as a message shows it. */
static void show(const value_type *t, const pcg_cell *at, char *out)
{
    arena scratch = {.limit = 1 << 20};
    text line = {.arena = &scratch};
    value_write(&line, t, at);
    const char *from = line.at ? line.at : "";
    size_t length = strlen(from);
    bool cut = length > SHOWN_BYTES;
    if (cut)
        for (length = SHOWN_BYTES; length && ((unsigned char)from[length] & 0xC0) == 0x80;
             length--) {
        }
    snprintf(out, SHOWN_BYTES + 8, "%.*s%s", (int)length, from, cut ? "…" : "");
    arena_free(&scratch);
}

/* ---- range ---------------------------------------------------------------------------------- */

static bool refuse_range(const pcg_constraint_info *c, int kind, double value, char *why)
{
    char low[VALUE_NUMBER_BYTES], high[VALUE_NUMBER_BYTES], given[VALUE_NUMBER_BYTES];
    value_quantity(low, kind, c->low);
    value_quantity(high, kind, c->high);
    value_quantity(given, kind, value);
    snprintf(why, VALUE_WHY_BYTES, "must be from %s to %s, not %s", low, high, given);
    return false;
}

/* Each number of the value: components of a vector, elements of a list. */
static bool in_range(const pcg_constraint_info *c, const value_type *t, const pcg_cell *at,
                     char *why)
{
    if (t->kind == PCG_LIST) {
        value_type element = {
            .kind = t->element, .element = PCG_INT, .enumerators = t->enumerators};
        for (pcg_u32 i = 0; i < at->list->count; i++)
            if (!in_range(c, &element, at->list->at + (size_t)i * at->list->width, why))
                return false;
        return true;
    }
    if (t->kind == PCG_INT)
        return ((double)at->i >= c->low && (double)at->i <= c->high) ||
               refuse_range(c, t->kind, (double)at->i, why);
    for (pcg_u32 i = 0; value_has_floats(t->kind) && i < value_width(t->kind); i++)
        if (!(at[i].f >= c->low && at[i].f <= c->high))
            return refuse_range(c, t->kind, at[i].f, why);
    return true;
}

/* ---- one of --------------------------------------------------------------------------------- */

static bool equals_text(pcg_run *r, const value_type *t, const pcg_cell *at, const char *from,
                        size_t length)
{
    char option[256], why[VALUE_WHY_BYTES];
    pcg_cell read[4] = {{0}};
    if (t->kind == PCG_STRING || t->kind == PCG_PATH)
        return strlen(at->s) == length && !memcmp(at->s, from, length);
    if (length >= sizeof option)
        return false;
    memcpy(option, from, length);
    option[length] = '\0';
    return value_read(r, t, option, read, why) && value_equal(t, at, read);
}

static bool is_one_of(pcg_run *r, const pcg_constraint_info *c, const value_type *t,
                      const pcg_cell *at, char *why)
{
    size_t used = 0, length;
    const char *option;
    char shown[SHOWN_BYTES + 8];
    for (pcg_int i = 0; (option = value_enumerator(c->text, i, &length)); i++)
        if (equals_text(r, t, at, option, length))
            return true;
    show(t, at, shown);
    used = (size_t)snprintf(why, VALUE_WHY_BYTES, "must be one of (");
    for (pcg_int i = 0; (option = value_enumerator(c->text, i, &length)); i++) {
        if (used + length + sizeof shown + 16 > VALUE_WHY_BYTES) {
            used += (size_t)snprintf(why + used, VALUE_WHY_BYTES - used, ", …");
            break;
        }
        used += (size_t)snprintf(why + used, VALUE_WHY_BYTES - used, "%s%.*s", i ? ", " : "",
                                 (int)length, option);
    }
    snprintf(why + used, VALUE_WHY_BYTES - used, "), not %s", shown);
    return false;
}

/* ---- matches -------------------------------------------------------------------------------- */

/* `why` where the pattern is none, or memory has run out; else NULL. */
static const char *try_pattern(arena *a, const char *expression, const char *s, bool *found)
{
    jmp_buf out_of_memory;
    a->on_failure = &out_of_memory;
    if (setjmp(out_of_memory))
        return "it takes too much memory";
    const char *error = NULL;
    const pattern *p = pattern_new(a, expression, &error);
    *found = p && pattern_matches(a, p, s);
    return error;
}

static bool matches(const pcg_constraint_info *c, const char *s, char *why)
{
    arena scratch = {.limit = PATTERN_MEMORY};
    bool found = false;
    const char *error = try_pattern(&scratch, c->text, s, &found);
    arena_free(&scratch);
    if (error)
        snprintf(why, VALUE_WHY_BYTES, "must match \"%.120s\", which cannot be tried: %s", c->text,
                 error);
    else if (!found)
        snprintf(why, VALUE_WHY_BYTES, "must match \"%.120s\", not '%.80s'", c->text, s);
    return found && !error;
}

/* ---- at most -------------------------------------------------------------------------------- */

static bool is_at_most(const pcg_constraint_info *c, const char *s, char *why)
{
    size_t characters = 0;
    for (; *s; s++)
        characters += ((unsigned char)*s & 0xC0) != 0x80;
    if ((double)characters <= c->high)
        return true;
    snprintf(why, VALUE_WHY_BYTES, "must have at most %.0f characters, not %zu", c->high,
             characters);
    return false;
}

bool constraint_holds(pcg_run *r, const pcg_constraint_info *c, const value_type *t,
                      const pcg_cell *at, char *why)
{
    bool is_text = t->kind == PCG_STRING || t->kind == PCG_PATH;
    switch (c->kind) {
    case RANGE: return in_range(c, t, at, why);
    case ONE_OF: return is_one_of(r, c, t, at, why);
    case MATCHES: return !is_text || matches(c, at->s, why);
    case AT_MOST: return !is_text || is_at_most(c, at->s, why);
    default: return true;
    }
}

/* property.c - what a run says of its result as a whole: where on Earth its origin is, say.
 *
 * There are a few of them, kept in the order in which they were first set. A key is two words with
 * a point between them: what the first word is the same of stands together where it is written.
 */
#include <string.h>

#include "result.h"
#include "run.h"
#include "value.h"

enum { KEY_BYTES_MAX = 100 };

/* How many bytes of a key are its first word, or its second one. */
static size_t word_length(const char *word)
{
    size_t length = word[0] >= 'a' && word[0] <= 'z';
    return length ? strspn(word, "abcdefghijklmnopqrstuvwxyz0123456789_") : 0;
}

/* What the first word of a key may not be: `run --json` has members of that name. */
static bool is_taken(const char *key, size_t length)
{
    static const char *const taken[] = {"version", "graph",       "seed", "report",
                                        "outputs", "diagnostics", "time"};
    for (size_t i = 0; i < COUNT_OF(taken); i++)
        if (strlen(taken[i]) == length && !strncmp(key, taken[i], length))
            return true;
    return false;
}

static bool is_key(const char *key)
{
    size_t group = word_length(key);
    if (!group || key[group] != '.' || is_taken(key, group))
        return false;
    size_t member = word_length(key + group + 1);
    return member && !key[group + 1 + member] && group + member < KEY_BYTES_MAX;
}

static run_property *find(const pcg_run *r, const char *key)
{
    run_property *p = r->properties;
    while (p && strcmp(p->key, key) != 0)
        p = p->next;
    return p;
}

static run_property *add(pcg_run *r, const char *key)
{
    run_property *p = run_alloc_zeroed(r, sizeof *p);
    const char *own = pcg_string(r, key);
    if (!p || !own)
        return NULL;
    p->key = own;
    *(r->properties_end ? r->properties_end : &r->properties) = p;
    r->properties_end = &p->next;
    return p;
}

int pcg_property_set(pcg_call *c, const char *key, int kind, const pcg_cell *value)
{
    if (!is_key(key) || value_width(kind) != 1 || kind == PCG_LIST || kind == PCG_ENUM)
        return pcg_fail(c, "'%s' cannot be a property of the run", key);
    run_property *p = find(c->run, key);
    pcg_cell own = *value;
    if (kind == PCG_STRING || kind == PCG_PATH)
        own.s = pcg_string(c->run, value->s);
    if (!p)
        p = add(c->run, key);
    if (!p || ((kind == PCG_STRING || kind == PCG_PATH) && !own.s))
        return PCG_FAILED;
    p->kind = kind;
    p->value = own;
    return PCG_OK;
}

const pcg_cell *pcg_property_get(const pcg_run *r, const char *key, int kind)
{
    const run_property *p = find(r, key);
    return p && p->kind == kind ? &p->value : NULL;
}

/* ---- as writers read them -------------------------------------------------------------------- */

static bool same_group(const run_property *a, const run_property *b)
{
    size_t length = word_length(a->key);
    return word_length(b->key) == length && !strncmp(a->key, b->key, length);
}

/* Whether one before it is of its group. */
static bool is_grouped(const pcg_run *r, const run_property *p)
{
    const run_property *first = r->properties;
    while (first != p && !same_group(first, p))
        first = first->next;
    return first != p;
}

static void write_group(const run_property *first, text *out)
{
    size_t group = word_length(first->key);
    text_format(out, "\"%.*s\":{", (int)group, first->key);
    for (const run_property *p = first; p; p = p->next) {
        if (!same_group(first, p))
            continue;
        const value_type type = {.kind = p->kind};
        text_add(out, p == first ? "" : ",");
        text_quote(out, p->key + group + 1);
        text_add(out, ":");
        value_write_json(out, &type, &p->value);
    }
    text_add(out, "}");
}

bool result_properties_json(const pcg_run *r, text *out)
{
    for (const run_property *p = r->properties; p; p = p->next) {
        if (is_grouped(r, p))
            continue;
        text_add(out, p == r->properties ? "" : ",");
        write_group(p, out);
    }
    return r->properties != NULL;
}

/* ---- as hosts read them ---------------------------------------------------------------------- */

size_t pcg_run_property_count(const pcg_run *r)
{
    size_t count = 0;
    for (const run_property *p = r->properties; p; p = p->next)
        count++;
    return count;
}

const char *pcg_run_property_key(const pcg_run *r, size_t i)
{
    const run_property *p = r->properties;
    for (; p && i > 0; i--)
        p = p->next;
    return p ? p->key : NULL;
}

const char *pcg_run_property(pcg_run *r, const char *key)
{
    const run_property *p = find(r, key);
    if (!p)
        return NULL;
    arena scratch = {0};
    text line = {.arena = &scratch};
    const value_type type = {.kind = p->kind};
    value_write(&line, &type, &p->value);
    const char *kept = line.at ? pcg_string(r, line.at) : "";
    arena_free(&scratch);
    return kept;
}

pcg_status pcg_run_property_float(pcg_run *r, const char *key, double *out)
{
    const run_property *p = find(r, key);
    if (!p)
        return run_misuse(r, "the run has no property '%s'", key);
    if (value_is_float(p->kind))
        *out = p->value.f;
    else if (p->kind == PCG_INT || p->kind == PCG_BOOL)
        *out = (double)p->value.i;
    else
        return run_misuse(r, "property '%s' is of type %s, no number", key,
                          value_kind_name(p->kind));
    return PCG_STATUS_OK;
}

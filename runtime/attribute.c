/* attribute.c - attributes of entities: cells that are shared until they are written. */
#include <string.h>

#include "run.h"
#include "value.h"

enum { WORD = 64, MOST_AHEAD = 16 };

static size_t words_of(pcg_u32 cells)
{
    return ((size_t)cells + WORD - 1) / WORD;
}

static size_t bytes_of(pcg_u32 cells)
{
    return sizeof(struct pcg_attributes) + words_of(cells) * sizeof(pcg_u64) +
           (size_t)cells * sizeof(pcg_cell);
}

static pcg_cell *cells_of(struct pcg_attributes *a)
{
    return (pcg_cell *)(a->present + words_of(a->cells));
}

static int is_present(const struct pcg_attributes *a, pcg_u32 cell)
{
    return (int)(a->present[cell / WORD] >> cell % WORD & 1);
}

/* The bits of word `word` that stand for cells below `end`. */
static pcg_u64 mask_below(size_t word, pcg_u32 end)
{
    size_t first = word * WORD;
    if (end <= first)
        return 0;
    return end - first >= WORD ? ~(pcg_u64)0 : ((pcg_u64)1 << (end - first)) - 1;
}

/* ---- blocks --------------------------------------------------------------------------------- */

/* Room for at least `cells`, none present; what its memory block has room for is used. */
static struct pcg_attributes *attributes_new(pcg_run *r, pcg_u32 cells)
{
    size_t bytes = bytes_of(cells), whole = run_capacity(bytes);
    struct pcg_attributes *a = run_alloc(r, bytes);
    if (!a)
        return NULL;
    cells += (pcg_u32)((whole - bytes) / sizeof(pcg_cell));
    while (bytes_of(cells) > whole)
        cells--;
    memset(a, 0, bytes_of(cells));
    a->references = 1;
    a->cells = cells;
    return a;
}

size_t attributes_bytes(const struct pcg_attributes *a)
{
    return bytes_of(a->cells);
}

void attributes_drop(pcg_run *r, struct pcg_attributes *a)
{
    if (a && --a->references == 0)
        run_free(r, a, bytes_of(a->cells));
}

/* A copy of what stands in the cells below `end`, with room for `cells`. */
static struct pcg_attributes *attributes_copy(pcg_run *r, struct pcg_attributes *from,
                                              pcg_u32 cells, pcg_u32 end)
{
    struct pcg_attributes *a = attributes_new(r, cells);
    if (!a)
        return NULL;
    if (end > from->cells)
        end = from->cells;
    for (size_t word = 0; word < words_of(end); word++)
        a->present[word] = from->present[word] & mask_below(word, end);
    memcpy(cells_of(a), cells_of(from), (size_t)end * sizeof(pcg_cell));
    return a;
}

/* What has been written to others is going to be written here, too: room for it now saves a copy of
 * the block for each attribute more. */
static pcg_u32 cells_ahead(pcg_run *r, pcg_u32 cells)
{
    if (cells > r->cells && cells <= MOST_AHEAD)
        r->cells = cells;
    return cells > r->cells ? cells : r->cells;
}

/* Makes the entity's block one of its own, with room for `cells`. */
static struct pcg_attributes *attributes_own(pcg_run *r, pcg_entity *e, pcg_u32 cells)
{
    struct pcg_attributes *old = e->attributes, *a;
    if (!old)
        return e->attributes = attributes_new(r, cells_ahead(r, cells));
    if (old->references == 1 && old->cells >= cells)
        return old;
    cells = cells_ahead(r, cells);
    a = attributes_copy(r, old, cells > old->cells ? cells : old->cells, old->cells);
    if (!a)
        return NULL;
    attributes_drop(r, old);
    return e->attributes = a;
}

/* ---- reading and writing cells -------------------------------------------------------------- */

const pcg_cell *pcg_attribute(const pcg_entity *e, int cell)
{
    struct pcg_attributes *a = e->attributes;
    pcg_u32 at = (pcg_u32)cell; /* of an unlinked one: larger than any */
    if (!a || at >= a->cells || !is_present(a, at))
        return NULL;
    return cells_of(a) + at;
}

const pcg_cell *pcg_get(const pcg_entity *e, const pcg_slot *s)
{
    const pcg_cell *at = pcg_attribute(e, s->cell);
    return at ? at : s->initial;
}

pcg_cell *pcg_attribute_write(pcg_run *r, pcg_entity *e, int cell, int kind)
{
    if (cell < 0)
        return NULL;
    pcg_u32 first = (pcg_u32)cell, end = first + value_width(kind);
    struct pcg_attributes *a = attributes_own(r, e, end);
    if (!a)
        return NULL;
    for (pcg_u32 i = first; i < end; i++)
        a->present[i / WORD] |= (pcg_u64)1 << i % WORD;
    return cells_of(a) + first;
}

/* True where a cell from `base` on was written. */
static int reaches(const struct pcg_attributes *a, pcg_u32 base)
{
    for (size_t word = base / WORD; word < words_of(a->cells); word++)
        if (a->present[word] & ~mask_below(word, base))
            return 1;
    return 0;
}

void attributes_unwrite(pcg_run *r, pcg_entity *e, const pcg_slot *s)
{
    if (!pcg_attribute(e, s->cell))
        return;
    struct pcg_attributes *a = attributes_own(r, e, 0);
    pcg_u32 first = (pcg_u32)s->cell, end = first + value_width(s->kind);
    for (pcg_u32 i = first; a && i < end; i++)
        a->present[i / WORD] &= ~((pcg_u64)1 << i % WORD);
}

void attributes_take(pcg_run *r, pcg_entity *to, const pcg_entity *from, pcg_u32 base)
{
    struct pcg_attributes *given = from->attributes;
    attributes_leave(r, to, base);
    if (!given || !reaches(given, base))
        return;
    attributes_hold(given); /* which `to` may share */
    struct pcg_attributes *a = attributes_own(r, to, given->cells);
    for (pcg_u32 i = base; a && i < given->cells; i++) {
        if (is_present(given, i)) {
            a->present[i / WORD] |= (pcg_u64)1 << i % WORD;
            cells_of(a)[i] = cells_of(given)[i];
        }
    }
    attributes_drop(r, given);
}

void pcg_leave(pcg_run *r, pcg_entity *e, pcg_u32 base)
{
    attributes_leave(r, e, base);
    for (const pcg_type *t = e->type; t; t = t->parent)
        if (t->leave)
            t->leave(r, e, base);
}

void attributes_leave(pcg_run *r, pcg_entity *e, pcg_u32 base)
{
    struct pcg_attributes *a = e->attributes;
    if (!a || !reaches(a, base))
        return;
    if (base == 0) {
        attributes_drop(r, a);
        e->attributes = NULL;
    } else if (a->references > 1) {
        struct pcg_attributes *left = attributes_copy(r, a, base, base);
        if (!left)
            return;
        attributes_drop(r, a);
        e->attributes = left;
    } else {
        for (size_t word = base / WORD; word < words_of(a->cells); word++)
            a->present[word] &= mask_below(word, base);
    }
}

/* ---- values with conversion ----------------------------------------------------------------- */

/* Emitted code links only what fits, so this tells of a library whose interface says something else
 * than its kernel. */
static void kinds_differ(pcg_run *r, int slot, int value)
{
    run_fail(r, PCG_FAILED, DIAG_E0709, r->node, r->round, value_kind_name(slot),
             value_kind_name(value));
}

void pcg_set_cells(pcg_run *r, pcg_entity *e, const pcg_slot *s, const pcg_cell *from)
{
    pcg_cell *to = pcg_attribute_write(r, e, s->cell, s->kind);
    if (to)
        memcpy(to, from, value_width(s->kind) * sizeof *to);
}

void pcg_set_string(pcg_run *r, pcg_entity *e, const pcg_slot *s, const char *value)
{
    if (s->cell < 0)
        return;
    if (s->kind != PCG_STRING && s->kind != PCG_PATH) {
        kinds_differ(r, s->kind, PCG_STRING);
        return;
    }
    pcg_cell cell = {.s = pcg_string(r, value)};
    pcg_set_cells(r, e, s, &cell);
}

void pcg_set_bool(pcg_run *r, pcg_entity *e, const pcg_slot *s, int value)
{
    pcg_cell cell = {.i = value != 0};
    if (s->cell < 0)
        return;
    if (s->kind == PCG_BOOL)
        pcg_set_cells(r, e, s, &cell);
    else if (s->kind == PCG_STRING)
        pcg_set_string(r, e, s, value ? "true" : "false");
    else
        kinds_differ(r, s->kind, PCG_BOOL);
}

void pcg_set_int(pcg_run *r, pcg_entity *e, const pcg_slot *s, pcg_int value)
{
    pcg_cell cell = {.i = value};
    if (s->cell < 0)
        return;
    if (s->kind == PCG_INT || s->kind == PCG_ENUM)
        pcg_set_cells(r, e, s, &cell);
    else if (value_is_float(s->kind))
        pcg_set_float(r, e, s, (double)value);
    else if (s->kind == PCG_STRING)
        pcg_set_string(r, e, s, pcg_format(r, "%lld", value));
    else
        kinds_differ(r, s->kind, PCG_INT);
}

void pcg_set_float(pcg_run *r, pcg_entity *e, const pcg_slot *s, double value)
{
    pcg_cell cell = {.f = value};
    char number[VALUE_NUMBER_BYTES];
    if (s->cell < 0)
        return;
    if (value_is_float(s->kind)) {
        pcg_set_cells(r, e, s, &cell);
    } else if (s->kind == PCG_STRING) {
        value_number(number, value);
        pcg_set_string(r, e, s, number);
    } else {
        kinds_differ(r, s->kind, PCG_FLOAT);
    }
}

/* expression.c - what emitted C calls where an operator of the language is more than one of C. */
#include <string.h>

#include "constraint.h"
#include "run.h"
#include "value.h"

/* ---- ports ----------------------------------------------------------------------------------- */

void pcg_port_lead(pcg_port *p, pcg_u32 index, pcg_queue **to, pcg_u32 count)
{
    p->index = index;
    p->to = to;
    p->count = count;
}

/* ---- integers -------------------------------------------------------------------------------- */

int pcg_int_divide(pcg_call *c, pcg_int a, pcg_int b, pcg_int *result)
{
    if (b == 0)
        return pcg_fail(c, "division by zero: %lld / 0", a);
    *result = b == -1 ? PCG_INT_SUBTRACT(0, a) : a / b;
    return PCG_OK;
}

int pcg_int_remainder(pcg_call *c, pcg_int a, pcg_int b, pcg_int *result)
{
    if (b == 0)
        return pcg_fail(c, "division by zero: %lld %% 0", a);
    *result = b == -1 ? 0 : a % b;
    return PCG_OK;
}

int pcg_int_shift_left(pcg_call *c, pcg_int a, pcg_int by, pcg_int *result)
{
    if (by < 0 || by > 63)
        return pcg_fail(c, "a shift by %lld, expected 0 to 63: %lld << %lld", by, a, by);
    *result = (pcg_int)((pcg_u64)a << by);
    return PCG_OK;
}

int pcg_int_shift_right(pcg_call *c, pcg_int a, pcg_int by, pcg_int *result)
{
    if (by < 0 || by > 63)
        return pcg_fail(c, "a shift by %lld, expected 0 to 63: %lld >> %lld", by, a, by);
    pcg_u64 sign = a < 0 ? ~(~(pcg_u64)0 >> by) : 0;
    *result = (pcg_int)((pcg_u64)a >> by | sign);
    return PCG_OK;
}

/* ---- strings --------------------------------------------------------------------------------- */

int pcg_string_compare(const char *a, const char *b)
{
    return strcmp(a, b);
}

const char *pcg_string_join(pcg_run *r, const char *a, const char *b)
{
    size_t first = strlen(a), size = first + strlen(b) + 1;
    char *both = run_alloc(r, size);
    if (!both)
        return "";
    memcpy(both, a, first);
    memcpy(both + first, b, size - first);
    const char *kept = pcg_string(r, both);
    run_free(r, both, size);
    return kept ? kept : "";
}

/* Numbers stand without their unit: read back, they mean the same in its base unit. */
const char *pcg_text(pcg_run *r, const pcg_cell *at, int kind, int element, const char *enumerators)
{
    char number[VALUE_NUMBER_BYTES];
    const char *kept = NULL;
    if (value_is_float(kind)) {
        value_number(number, at->f);
        kept = pcg_string(r, number);
    } else if (kind == PCG_STRING || kind == PCG_PATH) {
        kept = at->s;
    } else {
        arena scratch = {0};
        text written = {.arena = &scratch};
        const value_type t = {kind, value_is_float(element) ? PCG_FLOAT : element, enumerators};
        value_write(&written, &t, at);
        if (written.at)
            kept = pcg_string(r, written.at);
        else
            run_out_of_memory(r, VALUE_NUMBER_BYTES);
        arena_free(&scratch);
    }
    return kept ? kept : "";
}

/* ---- lists ----------------------------------------------------------------------------------- */

pcg_list *pcg_list_new(pcg_run *r, pcg_u32 count, pcg_u32 width)
{
    /* A cell more than needed is there: the declared one. */
    pcg_list *list = pcg_alloc(r, sizeof *list + (pcg_u64)count * width * sizeof list->at[0]);
    if (list) {
        list->count = count;
        list->width = width;
    }
    return list;
}

int pcg_list_equal(const pcg_list *a, const pcg_list *b, int kind)
{
    const value_type t = {.kind = PCG_LIST, .element = kind};
    const pcg_cell first = {.list = a}, second = {.list = b};
    return value_equal(&t, &first, &second);
}

/* ---- constraints ----------------------------------------------------------------------------- */

int pcg_constrain(pcg_call *c, const char *parameter, const pcg_constraint_info *demand,
                  const pcg_cell *at, int kind, int element, const char *enumerators)
{
    char why[VALUE_WHY_BYTES];
    const value_type t = {kind, element, enumerators};
    if (constraint_holds(c->run, demand, &t, at, why))
        return PCG_OK;
    return pcg_fail(c, "'%s' %s", parameter, why);
}

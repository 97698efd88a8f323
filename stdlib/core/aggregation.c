/* aggregation.c - one value out of an attribute of many entities. */
#include "aggregation.h"
#include <string.h>
#include "core.h"
#include "runtime/memory.h"
#include "runtime/value.h"

/* ---- types ----------------------------------------------------------------------------------- */

static int aggregate_is_whole(int kind)
{
    return kind == PCG_INT || kind == PCG_BOOL;
}

static int aggregate_is_number(int kind)
{
    return aggregate_is_whole(kind) || (value_has_floats(kind) && kind != PCG_QUATERNION);
}

static int aggregate_fits(const core_aggregate *a)
{
    int of = a->of.kind, to = a->to.kind;
    switch (a->how) {
    case CORE_COUNT:
        return to == PCG_INT || value_is_float(to);
    case CORE_FIRST:
    case CORE_LAST:
        return of == to && a->of.element == a->to.element;
    default:
        if (aggregate_is_whole(of)) {
            return to == PCG_INT || value_is_float(to);
        }
        return of == to || (of == PCG_FLOAT && value_is_float(to));
    }
}

int core_aggregate_check(pcg_call *call, const core_aggregate *a)
{
    int passes_on = a->how == CORE_COUNT || a->how == CORE_FIRST || a->how == CORE_LAST;
    if (!passes_on && !aggregate_is_number(a->of.kind)) {
        return pcg_fail(call, "'%s' works on numbers and vectors, its attribute is of type %s",
                        a->name, value_kind_name(a->of.kind));
    }
    if (!aggregate_fits(a)) {
        return pcg_fail(
            call, "'%s' cannot write what it makes of an attribute of type %s to one of type %s",
            a->name, value_kind_name(a->how == CORE_COUNT ? PCG_INT : a->of.kind),
            value_kind_name(a->to.kind));
    }
    return PCG_OK;
}

/* ---- the median ------------------------------------------------------------------------------ */

static pcg_u64 aggregate_word(int whole, pcg_cell cell)
{
    return whole ? (pcg_u64)cell.i ^ (pcg_u64)1 << 63 : core_float_word(cell.f);
}

static double aggregate_unword(int whole, pcg_u64 word, pcg_int *as_int)
{
    if (whole) {
        *as_int = (pcg_int)(word ^ (pcg_u64)1 << 63);
        return (double)*as_int;
    }
    pcg_u64 bits = word >> 63 ? word ^ (pcg_u64)1 << 63 : ~word;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void aggregate_sort(pcg_u64 *words, pcg_u32 count)
{
    for (pcg_u32 i = 1; i < count; i++) {
        pcg_u64 word = words[i];
        pcg_u32 at = i;
        for (; at > 0 && words[at - 1] > word; at--) {
            words[at] = words[at - 1];
        }
        words[at] = word;
    }
}

/* The word that would stand at `place` of the sorted ones: found byte by byte, from the highest;
 * few are sorted. */
static pcg_u64 aggregate_select(pcg_u64 *words, pcg_u32 count, pcg_u32 place)
{
    enum { FEW = 48 };
    pcg_u64 prefix = 0, mask = 0;
    if (count <= FEW) {
        aggregate_sort(words, count);
        return words[place];
    }
    for (int shift = 56; shift >= 0; shift -= 8) {
        pcg_u32 bucket[256] = {0}, byte = 0;
        for (pcg_u32 i = 0; i < count; i++) {
            if ((words[i] & mask) == prefix) {
                bucket[words[i] >> shift & 255]++;
            }
        }
        for (; place >= bucket[byte]; byte++) {
            place -= bucket[byte];
        }
        prefix |= (pcg_u64)byte << shift;
        mask |= (pcg_u64)255 << shift;
    }
    return prefix;
}

/* Of two in the middle: what lies between them, for ints the lower one. */
static pcg_cell aggregate_middle(int whole, int to_whole, pcg_u64 *words, pcg_u32 count)
{
    pcg_int low_int = 0, high_int = 0;
    double low = aggregate_unword(whole, aggregate_select(words, count, (count - 1) / 2), &low_int);
    if (to_whole) {
        return (pcg_cell){.i = low_int};
    }
    double high = aggregate_unword(whole, aggregate_select(words, count, count / 2), &high_int);
    return (pcg_cell){.f = low == high ? low : low / 2 + high / 2};
}

static int aggregate_median(pcg_call *call, const core_aggregate *a, pcg_entity *const *at,
                            pcg_u32 count, pcg_cell *result)
{
    int whole = aggregate_is_whole(a->of.kind), to_whole = a->to.kind == PCG_INT;
    pcg_u64 *words = run_alloc_array(call->run, count, sizeof *words);
    if (!words) {
        return PCG_FAILED;
    }
    for (pcg_u32 k = 0; k < value_width(a->of.kind); k++) {
        pcg_u32 numbers = 0;
        for (pcg_u32 i = 0; i < count; i++) {
            pcg_cell cell = pcg_get(at[i], &a->of)[k];
            if (whole || cell.f == cell.f) {
                words[numbers++] = aggregate_word(whole, cell);
            }
        }
        if (numbers) {
            result[k] = aggregate_middle(whole, to_whole, words, numbers);
        }
    }
    run_free(call->run, words, count * sizeof *words);
    return PCG_OK;
}

/* ---- the others ------------------------------------------------------------------------------ */

static void aggregate_whole(const core_aggregate *a, pcg_entity *const *at, pcg_u32 count,
                            pcg_cell *result)
{
    pcg_int low = 0, high = 0, sum = 0;
    double real_sum = 0; /* which does not wrap around */
    for (pcg_u32 i = 0; i < count; i++) {
        pcg_int value = pcg_get(at[i], &a->of)->i;
        low = i == 0 || value < low ? value : low;
        high = i == 0 || value > high ? value : high;
        sum = PCG_INT_ADD(sum, value);
        real_sum += (double)value;
    }
    pcg_int whole = a->how == CORE_MIN ? low : a->how == CORE_MAX ? high : sum;
    double average = count ? real_sum / (double)count : 0;
    if (a->to.kind != PCG_INT) {
        result->f = a->how == CORE_AVERAGE ? average : (double)whole;
    } else {
        result->i = a->how != CORE_AVERAGE                  ? whole
                    : average < 9.2e18 && average > -9.2e18 ? (pcg_int)average
                                                            : 0;
    }
}

static void aggregate_float(const core_aggregate *a, pcg_entity *const *at, pcg_u32 count,
                            pcg_u32 component, pcg_cell *result)
{
    double low = 0, high = 0, sum = 0;
    pcg_u32 numbers = 0;
    for (pcg_u32 i = 0; i < count; i++) {
        double value = pcg_get(at[i], &a->of)[component].f;
        if (value == value) {
            low = numbers == 0 || value < low ? value : low;
            high = numbers == 0 || value > high ? value : high;
            sum += value;
            numbers++;
        }
    }
    if (a->how == CORE_SUM) {
        result->f = sum;
    } else if (numbers) {
        result->f = a->how == CORE_MIN ? low : a->how == CORE_MAX ? high : sum / numbers;
    }
}

static void aggregate_count(const core_aggregate *a, pcg_u32 count, pcg_cell *result)
{
    if (a->to.kind == PCG_INT) {
        result->i = count;
    } else {
        result->f = count;
    }
}

int core_aggregate_compute(pcg_call *call, const core_aggregate *a, pcg_entity *const *at,
                           pcg_u32 count, pcg_cell *result)
{
    pcg_u32 width = value_width(a->to.kind);
    for (pcg_u32 k = 0; k < width; k++) {
        result[k] = a->to.kind == PCG_INT ? (pcg_cell){.i = 0} : (pcg_cell){.f = PCG_NAN};
    }
    if (a->how == CORE_COUNT) {
        aggregate_count(a, count, result);
    } else if (a->how == CORE_FIRST || a->how == CORE_LAST) {
        const pcg_entity *which = at[a->how == CORE_FIRST ? 0 : count - 1];
        memcpy(result, pcg_get(which, &a->of), width * sizeof *result);
    } else if (a->how == CORE_MEDIAN) {
        return aggregate_median(call, a, at, count, result);
    } else if (aggregate_is_whole(a->of.kind)) {
        aggregate_whole(a, at, count, result);
    } else {
        for (pcg_u32 k = 0; k < width; k++) {
            aggregate_float(a, at, count, k, &result[k]);
        }
    }
    return pcg_tick(call);
}

/*pcg
/// How many elements a list has.
function count(values: list<int>) -> int [pure] { example count([3, 1, 2]) == 3 }
/// How many elements a list has.
function count(values: list<float>) -> int [pure] { example count([3.5, 1.5, 2.5]) == 3 }
/// How many elements a list has.
function count(values: list<length>) -> int [pure] { example count([3m, 1m, 2m]) == 3 }
/// How many elements a list has.
function count(values: list<string>) -> int [pure] { example count(["c", "a", "b"]) == 3 }

/// The element at a position, from 0; a negative one counts from the end. Where there is none: 0 or "", with a warning.
function at(values: list<int>, index: int) -> int [pure] { example at([3, 1, 2], -2) == 1 }
/// The element at a position, from 0; a negative one counts from the end. Where there is none: 0 or "", with a warning.
function at(values: list<float>, index: int) -> float [pure] {
    example at([3.5, 1.5, 2.5], -2) == 1.5
}
/// The element at a position, from 0; a negative one counts from the end. Where there is none: 0 or "", with a warning.
function at(values: list<length>, index: int) -> length [pure] {
    example at([3m, 1m, 2m], -2) == 1m
}
/// The element at a position, from 0; a negative one counts from the end. Where there is none: 0 or "", with a warning.
function at(values: list<string>, index: int) -> string [pure] {
    example at(["c", "a", "b"], -2) == "a"
}

/// The first element; of an empty list 0 or "", with a warning.
function first(values: list<int>) -> int [pure] { example first([3, 1, 2]) == 3 }
/// The first element; of an empty list 0 or "", with a warning.
function first(values: list<float>) -> float [pure] { example first([3.5, 1.5, 2.5]) == 3.5 }
/// The first element; of an empty list 0 or "", with a warning.
function first(values: list<length>) -> length [pure] { example first([3m, 1m, 2m]) == 3m }
/// The first element; of an empty list 0 or "", with a warning.
function first(values: list<string>) -> string [pure] { example first(["c", "a", "b"]) == "c" }

/// The last element; of an empty list 0 or "", with a warning.
function last(values: list<int>) -> int [pure] { example last([3, 1, 2]) == 2 }
/// The last element; of an empty list 0 or "", with a warning.
function last(values: list<float>) -> float [pure] { example last([3.5, 1.5, 2.5]) == 2.5 }
/// The last element; of an empty list 0 or "", with a warning.
function last(values: list<length>) -> length [pure] { example last([3m, 1m, 2m]) == 2m }
/// The last element; of an empty list 0 or "", with a warning.
function last(values: list<string>) -> string [pure] { example last(["c", "a", "b"]) == "b" }

/// Whether a value is among the elements.
function contains(values: list<int>, value: int) -> bool [pure] { example contains([3, 1], 1) }
/// Whether a value is among the elements.
function contains(values: list<float>, value: float) -> bool [pure] {
    example contains([3.5, 1.5], 1.5)
}
/// Whether a value is among the elements.
function contains(values: list<length>, value: length) -> bool [pure] {
    example contains([3m, 1m], 1m)
}
/// Whether a value is among the elements.
function contains(values: list<string>, value: string) -> bool [pure] {
    example contains(["c", "a"], "a")
}

/// Where a value first stands, from 0; -1 where it does not.
function find(values: list<int>, value: int) -> int [pure] { example find([3, 1], 1) == 1 }
/// Where a value first stands, from 0; -1 where it does not.
function find(values: list<float>, value: float) -> int [pure] {
    example find([3.5, 1.5], 1.5) == 1
}
/// Where a value first stands, from 0; -1 where it does not.
function find(values: list<length>, value: length) -> int [pure] { example find([3m, 1m], 1m) == 1 }
/// Where a value first stands, from 0; -1 where it does not.
function find(values: list<string>, value: string) -> int [pure] {
    example find(["c", "a"], "a") == 1
}

/// The list with one element more at its end.
function append(values: list<int>, value: int) -> list<int> [pure] {
    example last(append([3], 1)) == 1
}
/// The list with one element more at its end.
function append(values: list<float>, value: float) -> list<float> [pure] {
    example last(append([3.5], 1.5)) == 1.5
}
/// The list with one element more at its end.
function append(values: list<length>, value: length) -> list<length> [pure] {
    example last(append([3m], 1m)) == 1m
}
/// The list with one element more at its end.
function append(values: list<string>, value: string) -> list<string> [pure] {
    example last(append(["c"], "a")) == "a"
}

/// The elements of one list, then those of another.
function concat(a: list<int>, b: list<int>) -> list<int> [pure] {
    example count(concat([3], [1, 2])) == 3
}
/// The elements of one list, then those of another.
function concat(a: list<float>, b: list<float>) -> list<float> [pure] {
    example count(concat([3.5], [1.5, 2.5])) == 3
}
/// The elements of one list, then those of another.
function concat(a: list<length>, b: list<length>) -> list<length> [pure] {
    example count(concat([3m], [1m, 2m])) == 3
}
/// The elements of one list, then those of another.
function concat(a: list<string>, b: list<string>) -> list<string> [pure] {
    example count(concat(["c"], ["a", "b"])) == 3
}

/// The sum of all elements; 0 of an empty list.
function sum(values: list<int>) -> int [pure] { example sum([3, 1, 2]) == 3 + 1 + 2 }
/// The sum of all elements; 0 of an empty list.
function sum(values: list<float>) -> float [pure] {
    example sum([3.5, 1.5, 2.5]) == 3.5 + 1.5 + 2.5
}
/// The sum of all elements; 0 of an empty list.
function sum(values: list<length>) -> length [pure] { example sum([3m, 1m, 2m]) == 3m + 1m + 2m }

/// The mean of all elements; of an empty list 0, with a warning.
function average(values: list<int>) -> float [pure] { example average([1, 2]) == 1.5 }
/// The mean of all elements; of an empty list 0, with a warning.
function average(values: list<float>) -> float [pure] { example average([1.5, 3.5]) == 2.5 }
/// The mean of all elements; of an empty list 0, with a warning.
function average(values: list<length>) -> length [pure] { example average([1m, 3m]) == 2m }

/// The smallest element; of an empty list 0, with a warning.
function min(values: list<int>) -> int [pure] { example min([3, 1, 2]) == 1 }
/// The smallest element; of an empty list 0, with a warning.
function min(values: list<float>) -> float [pure] { example min([3.5, 1.5, 2.5]) == 1.5 }
/// The smallest element; of an empty list 0, with a warning.
function min(values: list<length>) -> length [pure] { example min([3m, 1m, 2m]) == 1m }

/// The largest element; of an empty list 0, with a warning.
function max(values: list<int>) -> int [pure] { example max([3, 1, 2]) == 3 }
/// The largest element; of an empty list 0, with a warning.
function max(values: list<float>) -> float [pure] { example max([3.5, 1.5, 2.5]) == 3.5 }
/// The largest element; of an empty list 0, with a warning.
function max(values: list<length>) -> length [pure] { example max([3m, 1m, 2m]) == 3m }

/// The whole numbers from `first` up to `last`, both included; none where `last` is smaller.
function numbers(first: int, last: int) -> list<int> [pure] { example sum(numbers(1, 4)) == 10 }
*/
#include "list.h"
#include <string.h>
#include "core.h"

/* ---- what all lists have in common ----------------------------------------------------------- */

/* The element at a position, from the end where it is negative. NULL, and a warning, where there is
 * none. */
static const pcg_cell *list_at(pcg_call *call, const char *function, const pcg_list *values,
                               pcg_int index)
{
    pcg_int count = values->count;
    pcg_int position = index < 0 ? index + count : index;
    if (position < 0 || position >= count) {
        pcg_warn(call, "'%s' asks for element %lld of a list of %lld", function, index, count);
        return 0;
    }
    return &values->at[position];
}

static const pcg_list *list_append(pcg_call *call, const pcg_list *values, pcg_cell value)
{
    pcg_list *list = core_list_new(call, (pcg_u64)values->count + 1);
    if (!list) {
        return &core_list_empty;
    }
    memcpy(list->at, values->at, values->count * sizeof list->at[0]);
    list->at[values->count] = value;
    return list;
}

static const pcg_list *list_concat(pcg_call *call, const pcg_list *a, const pcg_list *b)
{
    pcg_list *list = core_list_new(call, (pcg_u64)a->count + b->count);
    if (!list) {
        return &core_list_empty;
    }
    memcpy(list->at, a->at, a->count * sizeof list->at[0]);
    memcpy(list->at + a->count, b->at, b->count * sizeof list->at[0]);
    return list;
}

static int list_not_empty(pcg_call *call, const char *function, const pcg_list *values)
{
    if (values->count == 0) {
        pcg_warn(call, "'%s' of an empty list", function);
    }
    return values->count > 0;
}

/* Each kind of element has symbols of its own; `same(a, b)` compares two values. */
#define LIST_OF(type, c_type, field, none, same)                                                   \
    pcg_int pcg_core_fn_count_list_##type(pcg_call *call, const pcg_list *values)                  \
    {                                                                                              \
        (void)call;                                                                                \
        return values->count;                                                                      \
    }                                                                                              \
    c_type pcg_core_fn_at_list_##type##_int(pcg_call *call, const pcg_list *values, pcg_int index) \
    {                                                                                              \
        const pcg_cell *cell = list_at(call, "at", values, index);                                 \
        return cell ? cell->field : none;                                                          \
    }                                                                                              \
    c_type pcg_core_fn_first_list_##type(pcg_call *call, const pcg_list *values)                   \
    {                                                                                              \
        const pcg_cell *cell = list_at(call, "first", values, 0);                                  \
        return cell ? cell->field : none;                                                          \
    }                                                                                              \
    c_type pcg_core_fn_last_list_##type(pcg_call *call, const pcg_list *values)                    \
    {                                                                                              \
        const pcg_cell *cell = list_at(call, "last", values, -1);                                  \
        return cell ? cell->field : none;                                                          \
    }                                                                                              \
    pcg_int pcg_core_fn_find_list_##type##_##type(pcg_call *call, const pcg_list *values,          \
                                                  c_type value)                                    \
    {                                                                                              \
        (void)call;                                                                                \
        for (pcg_u32 i = 0; i < values->count; i++) {                                              \
            if (same(values->at[i].field, value)) {                                                \
                return i;                                                                          \
            }                                                                                      \
        }                                                                                          \
        return -1;                                                                                 \
    }                                                                                              \
    int pcg_core_fn_contains_list_##type##_##type(pcg_call *call, const pcg_list *values,          \
                                                  c_type value)                                    \
    {                                                                                              \
        return pcg_core_fn_find_list_##type##_##type(call, values, value) >= 0;                    \
    }                                                                                              \
    const pcg_list *pcg_core_fn_append_list_##type##_##type(pcg_call *call,                        \
                                                            const pcg_list *values, c_type value)  \
    {                                                                                              \
        return list_append(call, values, (pcg_cell){.field = value});                              \
    }                                                                                              \
    const pcg_list *pcg_core_fn_concat_list_##type##_list_##type(                                  \
        pcg_call *call, const pcg_list *a, const pcg_list *b)                                      \
    {                                                                                              \
        return list_concat(call, a, b);                                                            \
    }

static int list_same_int(pcg_int a, pcg_int b)
{
    return a == b;
}

static int list_same_float(double a, double b)
{
    return a == b;
}

static int list_same_string(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

LIST_OF(int, pcg_int, i, 0, list_same_int)
LIST_OF(float, double, f, 0, list_same_float)
LIST_OF(length, double, f, 0, list_same_float)
LIST_OF(string, const char *, s, "", list_same_string)

/* ---- numbers in lists ------------------------------------------------------------------------ */

/* The smallest where `sign` is 1, the largest where it is -1. */
static double list_extreme(pcg_call *call, const char *function, const pcg_list *values, int sign)
{
    double best = list_not_empty(call, function, values) ? values->at[0].f : 0;
    for (pcg_u32 i = 1; i < values->count; i++) {
        if ((values->at[i].f - best) * sign < 0) {
            best = values->at[i].f;
        }
    }
    return best;
}

static double list_sum(const pcg_list *values)
{
    double sum = 0;
    for (pcg_u32 i = 0; i < values->count; i++) {
        sum += values->at[i].f;
    }
    return sum;
}

static double list_average(pcg_call *call, const pcg_list *values)
{
    return list_not_empty(call, "average", values) ? list_sum(values) / values->count : 0;
}

#define LIST_OF_NUMBERS(type)                                                                      \
    double pcg_core_fn_sum_list_##type(pcg_call *call, const pcg_list *values)                     \
    {                                                                                              \
        (void)call;                                                                                \
        return list_sum(values);                                                                   \
    }                                                                                              \
    double pcg_core_fn_average_list_##type(pcg_call *call, const pcg_list *values)                 \
    {                                                                                              \
        return list_average(call, values);                                                         \
    }                                                                                              \
    double pcg_core_fn_min_list_##type(pcg_call *call, const pcg_list *values)                     \
    {                                                                                              \
        return list_extreme(call, "min", values, 1);                                               \
    }                                                                                              \
    double pcg_core_fn_max_list_##type(pcg_call *call, const pcg_list *values)                     \
    {                                                                                              \
        return list_extreme(call, "max", values, -1);                                              \
    }

LIST_OF_NUMBERS(float)
LIST_OF_NUMBERS(length)

/* Wraps around where the sum is no int, as + does. */
pcg_int pcg_core_fn_sum_list_int(pcg_call *call, const pcg_list *values)
{
    (void)call;
    pcg_u64 sum = 0;
    for (pcg_u32 i = 0; i < values->count; i++) {
        sum += (pcg_u64)values->at[i].i;
    }
    return (pcg_int)sum;
}

double pcg_core_fn_average_list_int(pcg_call *call, const pcg_list *values)
{
    double sum = 0;
    for (pcg_u32 i = 0; i < values->count; i++) {
        sum += (double)values->at[i].i;
    }
    return list_not_empty(call, "average", values) ? sum / values->count : 0;
}

pcg_int pcg_core_fn_min_list_int(pcg_call *call, const pcg_list *values)
{
    pcg_int best = list_not_empty(call, "min", values) ? values->at[0].i : 0;
    for (pcg_u32 i = 1; i < values->count; i++) {
        best = values->at[i].i < best ? values->at[i].i : best;
    }
    return best;
}

pcg_int pcg_core_fn_max_list_int(pcg_call *call, const pcg_list *values)
{
    pcg_int best = list_not_empty(call, "max", values) ? values->at[0].i : 0;
    for (pcg_u32 i = 1; i < values->count; i++) {
        best = values->at[i].i > best ? values->at[i].i : best;
    }
    return best;
}

const pcg_list *pcg_core_fn_numbers_int_int(pcg_call *call, pcg_int first, pcg_int last)
{
    pcg_u64 span = (pcg_u64)last - (pcg_u64)first;
    if (last < first) {
        return &core_list_empty;
    }
    pcg_list *list = core_list_new(call, span < ~(pcg_u64)0 ? span + 1 : span);
    if (!list) {
        return &core_list_empty;
    }
    for (pcg_u32 i = 0; i < list->count; i++) {
        list->at[i].i = first + i;
        if (i % 65536 == 65535 && pcg_tick(call) != PCG_OK) {
            break;
        }
    }
    return list;
}

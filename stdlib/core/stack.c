/*pcg
/// The list with one element more at its end: a stack with one on top. The same as `append`.
function push(values: list<int>, value: int) -> list<int> [pure] {
    example last(push([3, 1, 2], 9)) == 9
}
/// The list with one element more at its end: a stack with one on top. The same as `append`.
function push(values: list<float>, value: float) -> list<float> [pure] {
    example last(push([3.5, 1.5, 2.5], 9.5)) == 9.5
}
/// The list with one element more at its end: a stack with one on top. The same as `append`.
function push(values: list<length>, value: length) -> list<length> [pure] {
    example last(push([3m, 1m, 2m], 9m)) == 9m
}
/// The list with one element more at its end: a stack with one on top. The same as `append`.
function push(values: list<string>, value: string) -> list<string> [pure] {
    example last(push(["c", "a", "b"], "z")) == "z"
}

/// The list without its last element: a stack without its top. An empty list stays empty.
function pop(values: list<int>) -> list<int> [pure] { example last(pop([3, 1, 2])) == 1 }
/// The list without its last element: a stack without its top. An empty list stays empty.
function pop(values: list<float>) -> list<float> [pure] {
    example last(pop([3.5, 1.5, 2.5])) == 1.5
}
/// The list without its last element: a stack without its top. An empty list stays empty.
function pop(values: list<length>) -> list<length> [pure] { example last(pop([3m, 1m, 2m])) == 1m }
/// The list without its last element: a stack without its top. An empty list stays empty.
function pop(values: list<string>) -> list<string> [pure] {
    example last(pop(["c", "a", "b"])) == "a"
}

/// Elements of a list, from a position on, as far as there are so many; a negative position counts from the end.
function slice(values: list<int>, from: int, count: int) -> list<int> [pure] {
    example first(slice([3, 1, 2], -2, 1)) == 1
}
/// Elements of a list, from a position on, as far as there are so many; a negative position counts from the end.
function slice(values: list<float>, from: int, count: int) -> list<float> [pure] {
    example first(slice([3.5, 1.5, 2.5], -2, 1)) == 1.5
}
/// Elements of a list, from a position on, as far as there are so many; a negative position counts from the end.
function slice(values: list<length>, from: int, count: int) -> list<length> [pure] {
    example first(slice([3m, 1m, 2m], -2, 1)) == 1m
}
/// Elements of a list, from a position on, as far as there are so many; a negative position counts from the end.
function slice(values: list<string>, from: int, count: int) -> list<string> [pure] {
    example first(slice(["c", "a", "b"], -2, 1)) == "a"
}

/// The list with its last element first.
function reverse(values: list<int>) -> list<int> [pure] { example first(reverse([3, 1, 2])) == 2 }
/// The list with its last element first.
function reverse(values: list<float>) -> list<float> [pure] {
    example first(reverse([3.5, 1.5, 2.5])) == 2.5
}
/// The list with its last element first.
function reverse(values: list<length>) -> list<length> [pure] {
    example first(reverse([3m, 1m, 2m])) == 2m
}
/// The list with its last element first.
function reverse(values: list<string>) -> list<string> [pure] {
    example first(reverse(["c", "a", "b"])) == "b"
}

/// The list in order, small before large; what is no number comes last, text is compared by its bytes.
function sort(values: list<int>) -> list<int> [pure] { example first(sort([3, 1, 2])) == 1 }
/// The list in order, small before large; what is no number comes last, text is compared by its bytes.
function sort(values: list<float>) -> list<float> [pure] {
    example first(sort([3.5, 1.5, 2.5])) == 1.5
}
/// The list in order, small before large; what is no number comes last, text is compared by its bytes.
function sort(values: list<length>) -> list<length> [pure] {
    example first(sort([3m, 1m, 2m])) == 1m
}
/// The list in order, small before large; what is no number comes last, text is compared by its bytes.
function sort(values: list<string>) -> list<string> [pure] {
    example first(sort(["c", "a", "b"])) == "a"
}

/// The list with one element more at a position; beyond either end it goes there. A negative position counts from the end.
function insert(values: list<int>, index: int, value: int) -> list<int> [pure] {
    example at(insert([3, 1, 2], 1, 9), 1) == 9
}
/// The list with one element more at a position; beyond either end it goes there. A negative position counts from the end.
function insert(values: list<float>, index: int, value: float) -> list<float> [pure] {
    example at(insert([3.5, 1.5, 2.5], 1, 9.5), 1) == 9.5
}
/// The list with one element more at a position; beyond either end it goes there. A negative position counts from the end.
function insert(values: list<length>, index: int, value: length) -> list<length> [pure] {
    example at(insert([3m, 1m, 2m], 1, 9m), 1) == 9m
}
/// The list with one element more at a position; beyond either end it goes there. A negative position counts from the end.
function insert(values: list<string>, index: int, value: string) -> list<string> [pure] {
    example at(insert(["c", "a", "b"], 1, "z"), 1) == "z"
}

/// The list without the element at a position; a negative one counts from the end. Where there is none, all stay.
function remove(values: list<int>, index: int) -> list<int> [pure] {
    example first(remove([3, 1, 2], 0)) == 1
}
/// The list without the element at a position; a negative one counts from the end. Where there is none, all stay.
function remove(values: list<float>, index: int) -> list<float> [pure] {
    example first(remove([3.5, 1.5, 2.5], 0)) == 1.5
}
/// The list without the element at a position; a negative one counts from the end. Where there is none, all stay.
function remove(values: list<length>, index: int) -> list<length> [pure] {
    example first(remove([3m, 1m, 2m], 0)) == 1m
}
/// The list without the element at a position; a negative one counts from the end. Where there is none, all stay.
function remove(values: list<string>, index: int) -> list<string> [pure] {
    example first(remove(["c", "a", "b"], 0)) == "a"
}

/// The list with another element at a position; a negative one counts from the end. Where there is none, all stay.
function replace(values: list<int>, index: int, value: int) -> list<int> [pure] {
    example at(replace([3, 1, 2], -1, 9), 2) == 9
}
/// The list with another element at a position; a negative one counts from the end. Where there is none, all stay.
function replace(values: list<float>, index: int, value: float) -> list<float> [pure] {
    example at(replace([3.5, 1.5, 2.5], -1, 9.5), 2) == 9.5
}
/// The list with another element at a position; a negative one counts from the end. Where there is none, all stay.
function replace(values: list<length>, index: int, value: length) -> list<length> [pure] {
    example at(replace([3m, 1m, 2m], -1, 9m), 2) == 9m
}
/// The list with another element at a position; a negative one counts from the end. Where there is none, all stay.
function replace(values: list<string>, index: int, value: string) -> list<string> [pure] {
    example at(replace(["c", "a", "b"], -1, "z"), 2) == "z"
}

/// The list with each value once, where it stands first.
function distinct(values: list<int>) -> list<int> [pure] {
    example count(distinct(concat([3, 1, 2], [3, 1, 2]))) == 3
}
/// The list with each value once, where it stands first.
function distinct(values: list<float>) -> list<float> [pure] {
    example count(distinct(concat([3.5, 1.5, 2.5], [3.5, 1.5, 2.5]))) == 3
}
/// The list with each value once, where it stands first.
function distinct(values: list<length>) -> list<length> [pure] {
    example count(distinct(concat([3m, 1m, 2m], [3m, 1m, 2m]))) == 3
}
/// The list with each value once, where it stands first.
function distinct(values: list<string>) -> list<string> [pure] {
    example count(distinct(concat(["c", "a", "b"], ["c", "a", "b"]))) == 3
}
*/
#include "stack.h"
#include <string.h>
#include "core.h"
#include "runtime/grouping.h"
#include "runtime/memory.h"
#include "runtime/value.h"

/* ---- parts ----------------------------------------------------------------------------------- */

/* A new list of `count` elements, or NULL, which ends the run. */
static pcg_list *stack_copy(pcg_call *call, const pcg_list *from, pcg_u32 begin, pcg_u32 count)
{
    pcg_list *list = core_list_new(call, count);
    if (list && count) {
        memcpy(list->at, from->at + begin, count * sizeof list->at[0]);
    }
    return list;
}

static const pcg_list *stack_slice(pcg_call *call, const pcg_list *values, pcg_int from,
                                   pcg_int count)
{
    pcg_int size = values->count;
    pcg_int begin = from < 0 ? from + size : from;
    begin = begin < 0 ? 0 : begin > size ? size : begin;
    pcg_int length = count < 0 ? 0 : count > size - begin ? size - begin : count;
    const pcg_list *list = stack_copy(call, values, (pcg_u32)begin, (pcg_u32)length);
    return list ? list : &core_list_empty;
}

static const pcg_list *stack_reverse(pcg_call *call, const pcg_list *values)
{
    pcg_list *list = core_list_new(call, values->count);
    for (pcg_u32 i = 0; list && i < values->count; i++) {
        list->at[i] = values->at[values->count - 1 - i];
    }
    return list ? list : &core_list_empty;
}

/* Puts `value` before element `at`, of which `drop` are left out. */
static const pcg_list *stack_splice(pcg_call *call, const pcg_list *values, pcg_u32 at,
                                    pcg_u32 drop, const pcg_cell *value)
{
    pcg_u32 behind = values->count - at - drop, more = value != 0;
    pcg_list *list = core_list_new(call, (pcg_u64)at + more + behind);
    if (!list) {
        return &core_list_empty;
    }
    memcpy(list->at, values->at, at * sizeof list->at[0]);
    if (value) {
        list->at[at] = *value;
    }
    memcpy(list->at + at + more, values->at + at + drop, behind * sizeof list->at[0]);
    return list;
}

static const pcg_list *stack_insert(pcg_call *call, const pcg_list *values, pcg_int index,
                                    pcg_cell value)
{
    pcg_int size = values->count, at = index < 0 ? index + size : index;
    at = at < 0 ? 0 : at > size ? size : at;
    return stack_splice(call, values, (pcg_u32)at, 0, &value);
}

/* The element is replaced by `value`; NULL: removed. */
static const pcg_list *stack_replace(pcg_call *call, const char *function, const pcg_list *values,
                                     pcg_int index, const pcg_cell *value)
{
    pcg_int size = values->count, at = index < 0 ? index + size : index;
    if (at < 0 || at >= size) {
        pcg_warn(call, "'%s' asks for element %lld of a list of %lld", function, index, size);
        return values;
    }
    return stack_splice(call, values, (pcg_u32)at, 1, value);
}

/* ---- order ----------------------------------------------------------------------------------- */

static int stack_before(int kind, const pcg_cell *a, const pcg_cell *b)
{
    if (kind == PCG_STRING) {
        return strcmp(a->s, b->s) <= 0;
    }
    if (kind == PCG_INT) {
        return a->i <= b->i;
    }
    return b->f != b->f || a->f <= b->f;
}

/* Merges from[low .. middle) and from[middle .. high) into `to`; of equals the left one comes
 * first. */
static void stack_merge(int kind, const pcg_cell *from, pcg_cell *to, size_t low, size_t middle,
                        size_t high)
{
    size_t left = low, right = middle;
    for (size_t i = low; i < high; i++) {
        int take_left =
            right >= high || (left < middle && stack_before(kind, &from[left], &from[right]));
        to[i] = take_left ? from[left++] : from[right++];
    }
}

static const pcg_list *stack_sort(pcg_call *call, int kind, const pcg_list *values)
{
    size_t count = values->count;
    pcg_list *from = stack_copy(call, values, 0, values->count);
    pcg_list *to = from ? core_list_new(call, count) : 0;
    if (!to) {
        return &core_list_empty;
    }
    for (size_t width = 1; width < count; width *= 2) {
        for (size_t low = 0; low < count; low += 2 * width) {
            size_t middle = low + width < count ? low + width : count;
            size_t high = low + 2 * width < count ? low + 2 * width : count;
            stack_merge(kind, from->at, to->at, low, middle, high);
        }
        pcg_list *swap = from;
        from = to;
        to = swap;
    }
    return from;
}

/* ---- distinct -------------------------------------------------------------------------------- */

/* Whether the value was not in the set, which is open addressing of elements' numbers + 1. */
static int stack_is_new(const value_type *t, const pcg_list *kept, pcg_u32 *slots, size_t mask,
                        const pcg_cell *value)
{
    pcg_u64 hash = grouping_hash(0, t->kind, 0, value);
    for (size_t at = hash & mask;; at = (at + 1) & mask) {
        if (!slots[at]) {
            slots[at] = kept->count + 1;
            return 1;
        }
        const pcg_cell *other = &kept->at[slots[at] - 1];
        if (grouping_hash(0, t->kind, 0, other) == hash && value_equal(t, other, value)) {
            return 0;
        }
    }
}

static const pcg_list *stack_distinct(pcg_call *call, int kind, const pcg_list *values)
{
    const value_type t = {.kind = kind};
    size_t room = 8;
    while (room < 2 * (size_t)values->count) {
        room *= 2;
    }
    pcg_u32 *slots = run_alloc_array(call->run, room, sizeof *slots);
    pcg_list *kept = slots ? core_list_new(call, values->count) : 0;
    if (kept) {
        kept->count = 0;
    }
    for (pcg_u32 i = 0; kept && i < values->count; i++) {
        if (stack_is_new(&t, kept, slots, room - 1, &values->at[i])) {
            kept->at[kept->count++] = values->at[i];
        }
    }
    run_free(call->run, slots, room * sizeof *slots);
    return kept ? kept : &core_list_empty;
}

/* ---- functions ------------------------------------------------------------------------------- */

#define STACK_OF(type, c_type, field, kind)                                                        \
    const pcg_list *pcg_core_fn_push_list_##type##_##type(pcg_call *call, const pcg_list *values,  \
                                                          c_type value)                            \
    {                                                                                              \
        const pcg_cell cell = {.field = value};                                                    \
        return stack_splice(call, values, values->count, 0, &cell);                                \
    }                                                                                              \
    const pcg_list *pcg_core_fn_pop_list_##type(pcg_call *call, const pcg_list *values)            \
    {                                                                                              \
        return stack_slice(call, values, 0, (pcg_int)values->count - 1);                           \
    }                                                                                              \
    const pcg_list *pcg_core_fn_slice_list_##type##_int_int(                                       \
        pcg_call *call, const pcg_list *values, pcg_int from, pcg_int count)                       \
    {                                                                                              \
        return stack_slice(call, values, from, count);                                             \
    }                                                                                              \
    const pcg_list *pcg_core_fn_reverse_list_##type(pcg_call *call, const pcg_list *values)        \
    {                                                                                              \
        return stack_reverse(call, values);                                                        \
    }                                                                                              \
    const pcg_list *pcg_core_fn_sort_list_##type(pcg_call *call, const pcg_list *values)           \
    {                                                                                              \
        return stack_sort(call, kind, values);                                                     \
    }                                                                                              \
    const pcg_list *pcg_core_fn_insert_list_##type##_int_##type(                                   \
        pcg_call *call, const pcg_list *values, pcg_int index, c_type value)                       \
    {                                                                                              \
        return stack_insert(call, values, index, (pcg_cell){.field = value});                      \
    }                                                                                              \
    const pcg_list *pcg_core_fn_remove_list_##type##_int(pcg_call *call, const pcg_list *values,   \
                                                         pcg_int index)                            \
    {                                                                                              \
        return stack_replace(call, "remove", values, index, 0);                                    \
    }                                                                                              \
    const pcg_list *pcg_core_fn_replace_list_##type##_int_##type(                                  \
        pcg_call *call, const pcg_list *values, pcg_int index, c_type value)                       \
    {                                                                                              \
        const pcg_cell cell = {.field = value};                                                    \
        return stack_replace(call, "replace", values, index, &cell);                               \
    }                                                                                              \
    const pcg_list *pcg_core_fn_distinct_list_##type(pcg_call *call, const pcg_list *values)       \
    {                                                                                              \
        return stack_distinct(call, kind, values);                                                 \
    }

STACK_OF(int, pcg_int, i, PCG_INT)
STACK_OF(float, double, f, PCG_FLOAT)
STACK_OF(length, double, f, PCG_FLOAT)
STACK_OF(string, const char *, s, PCG_STRING)

/*pcg
/// Sorts a list by attributes.
///
/// The first key decides; where entities are equal in it, the second, and so on. What is equal in all keys
/// keeps its order. Numbers are sorted by size, with what is not a number last either way; strings and paths by
/// their bytes; false before true; enumerators in the order of their declaration; vectors and colours by their
/// first component, then the second and so on; lists by how many elements they have.
procedure order_by<T: Entity>(in: T[]) -> (out: T) [pure] {
    category "order"
    synonyms "sort", "rank", "arrange", "ascending", "descending"
    /// Small before large.
    augment ascending(
        key: attribute /// What is compared.
    )
    /// Large before small.
    augment descending(
        key: attribute /// What is compared.
    )
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 5, index => @n)
        -> order_by { descending(@n) }
        -> count(index => @place)
        -> c: condition(@n + @place == 4) expect c.yes.count = 5
}
*/
#include "order_by.h"
#include "core.h"
#include "runtime/memory.h"
#include "runtime/value.h"
#include <string.h>

/* An entity to sort. `word` maps its first key to a number that is in order where the keys are;
 * equal words say that the keys must be looked at. */
typedef struct order_record {
    pcg_u64 word;
    pcg_entity *entity;
} order_record;

static const pcg_slot *order_key(const struct pcg_core_order_by_item *item)
{
    return item->kind == PCG_CORE_ORDER_BY_DESCENDING ? &item->descending.key
                                                      : &item->ascending.key;
}

static pcg_u64 order_word_string(const char *s)
{
    pcg_u64 word = 0;
    for (int i = 0; i < 8; i++) {
        word = word << 8 | (pcg_u64)(unsigned char)*s;
        s += *s != 0;
    }
    return word;
}

static pcg_u64 order_word(int kind, const pcg_cell *at, int descending)
{
    pcg_u64 word;
    switch (kind) {
    case PCG_BOOL:
    case PCG_INT:
    case PCG_ENUM:
        word = (pcg_u64)at->i ^ (pcg_u64)1 << 63;
        break;
    case PCG_STRING:
    case PCG_PATH:
        word = order_word_string(at->s);
        break;
    case PCG_LIST:
        word = at->list->count;
        break;
    default:
        if (at->f != at->f) {
            return ~(pcg_u64)0;
        }
        word = core_float_word(at->f);
        break;
    }
    return descending ? ~word : word;
}

static int order_compare_string(const char *a, const char *b)
{
    int sign = strcmp(a, b);
    return (sign > 0) - (sign < 0);
}

/* Below 0 where a's key comes before b's, above 0 where behind it. */
static int order_compare_key(const struct pcg_core_order_by_item *item, const pcg_entity *a,
                             const pcg_entity *b)
{
    const pcg_slot *key = order_key(item);
    int descending = item->kind == PCG_CORE_ORDER_BY_DESCENDING;
    const pcg_cell *left = pcg_get(a, key), *right = pcg_get(b, key);
    if (key->kind == PCG_STRING || key->kind == PCG_PATH) {
        int sign = order_compare_string(left->s, right->s);
        return descending ? -sign : sign;
    }
    pcg_u32 cells = value_width(key->kind);
    for (pcg_u32 i = 0; i < cells; i++) {
        int kind = cells > 1 ? PCG_FLOAT : key->kind;
        pcg_u64 first = order_word(kind, left + i, descending);
        pcg_u64 second = order_word(kind, right + i, descending);
        if (first != second) {
            return first < second ? -1 : 1;
        }
    }
    return 0;
}

static int order_compare(const struct pcg_core_order_by *node, const order_record *a,
                         const order_record *b)
{
    if (a->word != b->word) {
        return a->word < b->word ? -1 : 1;
    }
    int sign = 0;
    for (pcg_u32 i = 0; i < node->item_count && sign == 0; i++) {
        sign = order_compare_key(&node->items[i], a->entity, b->entity);
    }
    return sign;
}

/* Merges from[low .. middle) and from[middle .. high) into `to`; of equals the left one comes
 * first. */
static void order_merge(const struct pcg_core_order_by *node, const order_record *from,
                        order_record *to, size_t low, size_t middle, size_t high)
{
    size_t left = low, right = middle;
    for (size_t i = low; i < high; i++) {
        int take_left = right >= high || (left < middle &&
                                          order_compare(node, &from[left], &from[right]) <= 0);
        to[i] = take_left ? from[left++] : from[right++];
    }
}

/* Sorts bottom up, between the two arrays; `sorted` says which holds the result. Status. */
static int order_sort(pcg_call *call, const struct pcg_core_order_by *node, order_record *from,
                      order_record *to, order_record **sorted)
{
    size_t count = node->in.count;
    for (size_t width = 1; width < count; width *= 2) {
        for (size_t low = 0; low < count; low += 2 * width) {
            size_t middle = low + width < count ? low + width : count;
            size_t high = low + 2 * width < count ? low + 2 * width : count;
            order_merge(node, from, to, low, middle, high);
            int status = pcg_tick(call);
            if (status != PCG_OK) {
                return status;
            }
        }
        order_record *swap = from;
        from = to;
        to = swap;
    }
    *sorted = from;
    return PCG_OK;
}

static void order_fill(const struct pcg_core_order_by *node, order_record *records)
{
    const struct pcg_core_order_by_item *first = node->item_count ? &node->items[0] : 0;
    for (pcg_u32 i = 0; i < node->in.count; i++) {
        records[i].entity = node->in.at[i];
        if (first) {
            const pcg_slot *key = order_key(first);
            records[i].word = order_word(key->kind, pcg_get(records[i].entity, key),
                                         first->kind == PCG_CORE_ORDER_BY_DESCENDING);
        }
    }
}

int pcg_core_order_by(pcg_call *call, struct pcg_core_order_by *node)
{
    size_t count = node->in.count, size = 2 * sizeof(order_record);
    order_record *room = run_alloc_array(call->run, count, size), *sorted;
    if (!room) {
        return PCG_FAILED;
    }
    order_fill(node, room);
    int status = order_sort(call, node, room, room + count, &sorted);
    for (size_t i = 0; i < count && status == PCG_OK; i++) {
        status = pcg_emit(call, node->out, sorted[i].entity);
        if (status == PCG_OK) {
            status = pcg_tick(call);
        }
    }
    run_free(call->run, room, count * size);
    return status;
}

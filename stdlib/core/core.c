/* core.c - lists and text for the kernels of this library. */
#include "core.h"
#include <stdio.h>
#include <string.h>
#include "runtime/memory.h"
#include "runtime/value.h"

pcg_u64 core_float_word(double value)
{
    pcg_u64 bits;
    double plus = value + 0.0; /* -0 becomes 0 */
    memcpy(&bits, &plus, sizeof bits);
    return bits >> 63 ? ~bits : bits | (pcg_u64)1 << 63;
}

/* ---- lists ----------------------------------------------------------------------------------- */

const pcg_list core_list_empty = {0, 1, {{0}}};

pcg_list *core_list_new(pcg_call *call, pcg_u64 count)
{
    if (count > CORE_LIST_MAX) {
        pcg_fail(call, "a list of %llu elements is too long", count);
        return 0;
    }
    return pcg_list_new(call->run, (pcg_u32)count, 1);
}

/* ---- text ------------------------------------------------------------------------------------ */

void core_add_bytes(core_buffer *b, const char *bytes, size_t count)
{
    if (b->failed) {
        return;
    }
    if (b->length + count + 1 > b->capacity) {
        size_t capacity = run_capacity(2 * b->capacity + count + 32);
        char *at = run_resize(b->run, b->at, b->capacity, capacity);
        if (!at) {
            b->failed = 1;
            return;
        }
        b->at = at;
        b->capacity = capacity;
    }
    if (count) {
        memcpy(b->at + b->length, bytes, count);
    }
    b->length += count;
    b->at[b->length] = 0;
}

void core_add(core_buffer *b, const char *string)
{
    core_add_bytes(b, string, strlen(string));
}

void core_add_number(core_buffer *b, double value)
{
    char written[VALUE_NUMBER_BYTES];
    value_number(written, value);
    core_add(b, written);
}

void core_add_fixed(core_buffer *b, double value, int decimals)
{
    char printed[400], written[400];
    size_t length = 0;
    int zero = 1;
    int places = decimals < 0 ? 0 : decimals > 20 ? 20 : decimals;
    int printed_length = snprintf(printed, sizeof printed, "%.*f", places, value);
    for (int i = 0; i < printed_length; i++) {
        char c = printed[i];
        if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '-') {
            zero = zero && (c == '0' || c == '-');
            written[length++] = c;
        } else if (length && written[length - 1] != '.') {
            written[length++] = '.'; /* the locale's radix character, of however many bytes */
        }
    }
    size_t sign = zero && written[0] == '-'; /* -0.00 says nothing that 0.00 does not */
    core_add_bytes(b, written + sign, length - sign);
}

void core_add_value(core_buffer *b, const pcg_any *value)
{
    char count[32];
    switch (value->kind) {
    case PCG_LIST: /* the value does not say what its elements are */
        snprintf(count, sizeof count, "list of %u", value->cell[0].list->count);
        core_add(b, count);
        break;
    case PCG_ENUM: /* nor what its numbers are called */
        core_add(b, pcg_text(b->run, value->cell, PCG_INT, 0, 0));
        break;
    default:
        core_add(b, pcg_text(b->run, value->cell, value->kind, 0, 0));
        break;
    }
}

const char *core_finish(core_buffer *b)
{
    const char *string = b->at && !b->failed ? pcg_string(b->run, b->at) : 0;
    run_free(b->run, b->at, b->capacity);
    *b = (core_buffer){.run = b->run};
    return string ? string : "";
}

const char *core_number(pcg_call *call, double value)
{
    core_buffer b = {.run = call->run};
    core_add_number(&b, value);
    return core_finish(&b);
}

/*pcg
/// The string with so many characters at least: a character, or a string, is repeated before it.
function pad_left(s: string, width: int, fill: string) -> string [pure] { example pad_left("7", 3, "0") == "007" }
/// The string with so many characters at least: a character, or a string, is repeated behind it.
function pad_right(s: string, width: int, fill: string) -> string [pure] { example pad_right("oak", 5, ".") == "oak.." }
/// The string with its first letter as a capital.
function capitalize(s: string) -> string [pure] { example capitalize("über") == "Über" }
/// The string's characters, the last one first.
function reverse(s: string) -> string [pure] { example reverse("Tür") == "rüT" }
/// Whether the whole string is as a pattern says, as in `matches` of a parameter: . [a-z] \d \w \s ( ) | * + ? {2,5}.
/// False, with a warning, where the pattern is none.
function matches(s: string, pattern: string) -> bool [pure] { example matches("B-12", "[A-Z]-[0-9]+") }
*/
#include "text.h"
#include <setjmp.h>
#include <string.h>
#include "letters.h"
#include "runtime/base/base.h"

/* ---- characters ------------------------------------------------------------------------------ */

enum { TEXT_WIDTH_MAX = 1 << 20 };

static pcg_int text_characters(const char *s)
{
    pcg_int count = 0;
    for (; *s; count++) {
        letters_read(s, &s);
    }
    return count;
}

/* So many characters of `fill`, over and over. */
static void text_fill(core_buffer *b, const char *fill, pcg_int count)
{
    const char *at = fill;
    for (; count > 0 && *fill; count--) {
        const char *begin = *at ? at : fill;
        letters_read(begin, &at);
        core_add_bytes(b, begin, (size_t)(at - begin));
    }
}

static const char *text_pad(pcg_call *call, const char *s, pcg_int width, const char *fill,
                            int left)
{
    core_buffer b = {.run = call->run};
    if (width > TEXT_WIDTH_MAX) {
        pcg_warn(call, "a width of %lld characters is too large: it is cut to %d", width,
                 TEXT_WIDTH_MAX);
        width = TEXT_WIDTH_MAX;
    }
    pcg_int missing = width - text_characters(s);
    if (left) {
        text_fill(&b, fill, missing);
    }
    core_add(&b, s);
    if (!left) {
        text_fill(&b, fill, missing);
    }
    return core_finish(&b);
}

const char *pcg_core_fn_pad_left_string_int_string(pcg_call *call, const char *s, pcg_int width,
                                                   const char *fill)
{
    return text_pad(call, s, width, fill, 1);
}

const char *pcg_core_fn_pad_right_string_int_string(pcg_call *call, const char *s, pcg_int width,
                                                    const char *fill)
{
    return text_pad(call, s, width, fill, 0);
}

const char *pcg_core_fn_capitalize_string(pcg_call *call, const char *s)
{
    core_buffer b = {.run = call->run};
    char written[4];
    if (*s) {
        const char *begin = s;
        pcg_u32 letter = letters_read(s, &s), upper = letters_upper(letter);
        if (upper == letter) {
            core_add_bytes(&b, begin, (size_t)(s - begin));
        } else {
            core_add_bytes(&b, written, letters_write(upper, written));
        }
    }
    core_add(&b, s);
    return core_finish(&b);
}

const char *pcg_core_fn_reverse_string(pcg_call *call, const char *s)
{
    size_t length = strlen(s), end = length;
    char *turned = pcg_alloc(call->run, length + 1);
    while (turned && *s) {
        const char *begin = s;
        letters_read(s, &s);
        size_t bytes = (size_t)(s - begin);
        end -= bytes;
        memcpy(turned + end, begin, bytes);
    }
    return turned ? turned : "";
}

/* ---- patterns -------------------------------------------------------------------------------- */

/* 1 or 0, or -1 with `why` where the pattern is none. */
static int text_match(arena *a, const char *s, const char *expression, const char **why)
{
    jmp_buf out_of_memory;
    a->on_failure = &out_of_memory;
    if (setjmp(out_of_memory)) {
        *why = "it needs too much memory";
        return -1;
    }
    const pattern *p = pattern_new(a, expression, why);
    return p ? pattern_matches(a, p, s) : -1;
}

int pcg_core_fn_matches_string_string(pcg_call *call, const char *s, const char *expression)
{
    arena a = {.limit = 64 << 20};
    const char *why = "";
    int matches = text_match(&a, s, expression, &why);
    if (matches < 0) {
        pcg_warn(call, "\"%s\" is no pattern: %s", expression, why);
    }
    arena_free(&a);
    return matches > 0;
}

/*pcg
/// How many characters a string has.
function length(s: string) -> int [pure] { example length("Häuser") == 6 }
/// The string in capitals: Latin, Greek and Cyrillic letters that have one capital letter.
function upper(s: string) -> string [pure] { example upper("Tür 3") == "TÜR 3" }
/// The string in small letters: Latin, Greek and Cyrillic letters that have one small letter.
function lower(s: string) -> string [pure] { example lower("TÜR 3") == "tür 3" }
/// The string without blanks, tabs and line ends at both ends.
function trim(s: string) -> string [pure] { example trim("  oak ") == "oak" }
/// Whether a part occurs in a string. The empty string occurs in every string.
function contains(s: string, part: string) -> bool [pure] { example contains("brick wall", "wall") }
/// Whether a string begins with a part.
function starts_with(s: string, part: string) -> bool [pure] {
    example starts_with("brick wall", "brick")
}
/// Whether a string ends with a part.
function ends_with(s: string, part: string) -> bool [pure] {
    example ends_with("brick.jpg", ".jpg")
}
/// Where a part first occurs, in characters from 0; -1 where it does not.
function find(s: string, part: string) -> int [pure] { example find("Häuser", "user") == 2 }
/// The string with every occurrence of a part replaced. An empty part replaces nothing.
function replace(s: string, part: string, by: string) -> string [pure] {
    example replace("a-b-c", "-", "+") == "a+b+c"
}
/// Up to `count` characters from position `from` on; a negative `from` counts from the end.
function substring(s: string, from: int, count: int) -> string [pure] {
    example substring("Häuser", 1, 2) == "äu"
    example substring("Häuser", -2, 9) == "er"
}
/// The string so many times; 0 or less gives the empty string.
function repeat(s: string, times: int) -> string [pure] { example repeat("ab", 3) == "ababab" }
/// The parts between occurrences of a separator. An empty separator splits into characters.
function split(s: string, separator: string) -> list<string> [pure] {
    example at(split("a,b,c", ","), 1) == "b"
}
/// The strings of a list with a separator between them.
function join(values: list<string>, separator: string) -> string [pure] {
    example join(["a", "b"], ", ") == "a, b"
}
/// Text with values in it: each pair of braces stands for the next value.
///
/// `{}` writes a value as the language does, `{:.2}` a number with two decimals, `{:4}` fills up to four characters with
/// blanks before a number and behind a text, `{:04}` with zeros; `{{` and `}}` are braces. Braces without a
/// value, and values without braces, are reported; the former stay as they are.
function format(pattern: string, values: any[]) -> string [pure] {
    example format("{} of {:.1}", 2, 2.345) == "2 of 2.3"
    example format("{:03}{{{:3}}}", 7, "a") == "007{a  }"
}
*/
#include "string.h"
#include <string.h>
#include "core.h"
#include "letters.h"

/* ---- characters: strings are UTF-8; a byte that continues a character is none of its own ---------- */

static int string_continues(char c)
{
    return ((unsigned char)c & 0xc0) == 0x80;
}

/* Behind the character at s; the string's end stays. */
static const char *string_next(const char *s)
{
    s += *s != 0;
    while (string_continues(*s)) {
        s++;
    }
    return s;
}

static pcg_int string_characters(const char *s, const char *end)
{
    pcg_int count = 0;
    for (; s < end; s++) {
        count += !string_continues(*s);
    }
    return count;
}

static const char *string_skip(const char *s, pcg_int characters)
{
    while (characters-- > 0 && *s) {
        s = string_next(s);
    }
    return s;
}

static const char *string_slice(pcg_call *call, const char *from, const char *to)
{
    core_buffer b = {.run = call->run};
    core_add_bytes(&b, from, (size_t)(to - from));
    return core_finish(&b);
}

/* ---- functions ------------------------------------------------------------------------------- */

pcg_int pcg_core_fn_length_string(pcg_call *call, const char *s)
{
    (void)call;
    return string_characters(s, s + strlen(s));
}

static const char *string_change(pcg_call *call, const char *s, pcg_u32 (*change)(pcg_u32))
{
    core_buffer b = {.run = call->run};
    char written[4];
    while (*s) {
        const char *end;
        pcg_u32 letter = letters_read(s, &end);
        pcg_u32 changed = change(letter);
        if (changed == letter) {
            core_add_bytes(&b, s, (size_t)(end - s));
        } else {
            core_add_bytes(&b, written, letters_write(changed, written));
        }
        s = end;
    }
    return core_finish(&b);
}

const char *pcg_core_fn_upper_string(pcg_call *call, const char *s)
{
    return string_change(call, s, letters_upper);
}

const char *pcg_core_fn_lower_string(pcg_call *call, const char *s)
{
    return string_change(call, s, letters_lower);
}

const char *pcg_core_fn_trim_string(pcg_call *call, const char *s)
{
    static const char blanks[] = " \t\r\n";
    s += strspn(s, blanks);
    const char *end = s + strlen(s);
    while (end > s && strchr(blanks, end[-1])) {
        end--;
    }
    return string_slice(call, s, end);
}

int pcg_core_fn_contains_string_string(pcg_call *call, const char *s, const char *part)
{
    (void)call;
    return strstr(s, part) != 0;
}

int pcg_core_fn_starts_with_string_string(pcg_call *call, const char *s, const char *part)
{
    (void)call;
    return strncmp(s, part, strlen(part)) == 0;
}

int pcg_core_fn_ends_with_string_string(pcg_call *call, const char *s, const char *part)
{
    (void)call;
    size_t length = strlen(s), end = strlen(part);
    return end <= length && memcmp(s + length - end, part, end) == 0;
}

pcg_int pcg_core_fn_find_string_string(pcg_call *call, const char *s, const char *part)
{
    (void)call;
    const char *found = strstr(s, part);
    return found ? string_characters(s, found) : -1;
}

const char *pcg_core_fn_replace_string_string_string(pcg_call *call, const char *s,
                                                     const char *part, const char *by)
{
    size_t length = strlen(part);
    core_buffer b = {.run = call->run};
    for (const char *found = length ? strstr(s, part) : 0; found; found = strstr(s, part)) {
        core_add_bytes(&b, s, (size_t)(found - s));
        core_add(&b, by);
        s = found + length;
        if (b.failed || pcg_tick(call) != PCG_OK) {
            break;
        }
    }
    core_add(&b, s);
    return core_finish(&b);
}

const char *pcg_core_fn_substring_string_int_int(pcg_call *call, const char *s, pcg_int from,
                                                 pcg_int count)
{
    if (from < 0) {
        from += string_characters(s, s + strlen(s));
        from = from < 0 ? 0 : from;
    }
    const char *begin = string_skip(s, from);
    return string_slice(call, begin, string_skip(begin, count));
}

const char *pcg_core_fn_repeat_string_int(pcg_call *call, const char *s, pcg_int times)
{
    core_buffer b = {.run = call->run};
    for (pcg_int i = 0; i < times && *s && !b.failed && pcg_tick(call) == PCG_OK; i++) {
        core_add(&b, s);
    }
    return core_finish(&b);
}

/* The end of the part that begins at s, and in *next the beginning of the one behind it; NULL:
 * there is none. */
static const char *string_part(const char *s, const char *separator, const char **next)
{
    size_t length = strlen(separator);
    const char *end = length ? strstr(s, separator) : string_next(s);
    if (!end || *end == 0) {
        *next = 0;
        return s + strlen(s);
    }
    *next = end + length;
    return end;
}

const pcg_list *pcg_core_fn_split_string_string(pcg_call *call, const char *s,
                                                const char *separator)
{
    pcg_u64 count = 0;
    const char *next;
    for (const char *at = s; at; at = next) {
        string_part(at, separator, &next);
        count++;
    }
    pcg_list *list = core_list_new(call, count);
    if (!list) {
        return &core_list_empty;
    }
    for (pcg_u32 i = 0; i < list->count; i++) {
        list->at[i].s = string_slice(call, s, string_part(s, separator, &next));
        s = next;
    }
    return list;
}

const char *pcg_core_fn_join_list_string_string(pcg_call *call, const pcg_list *values,
                                                const char *separator)
{
    core_buffer b = {.run = call->run};
    for (pcg_u32 i = 0; i < values->count; i++) {
        core_add(&b, i ? separator : "");
        core_add(&b, values->at[i].s);
    }
    return core_finish(&b);
}

/* ---- format ---------------------------------------------------------------------------------- */

/* What stands between a pair of braces. */
typedef struct string_field {
    int zeros;    /* filled up with zeros */
    int width;    /* at least so many characters */
    int decimals; /* -1: as many as there are */
} string_field;

enum { FORMAT_MAX_WIDTH = 1000, FORMAT_MAX_DECIMALS = 20 };

static const char *string_read_number(const char *s, int limit, int *value)
{
    for (*value = 0; *s >= '0' && *s <= '9'; s++) {
        *value = *value > limit ? *value : *value * 10 + (*s - '0');
    }
    return s;
}

/* Reads a field behind its opening brace: what follows its closing one, or NULL where that is no
 * field. */
static const char *string_read_field(const char *s, string_field *f)
{
    *f = (string_field){0, 0, -1};
    if (*s == ':') {
        s++;
        f->zeros = *s == '0';
        s = string_read_number(s, FORMAT_MAX_WIDTH, &f->width);
        if (*s == '.') {
            s = string_read_number(s + 1, FORMAT_MAX_DECIMALS, &f->decimals);
        }
    }
    return *s == '}' && f->width <= FORMAT_MAX_WIDTH && f->decimals <= FORMAT_MAX_DECIMALS ? s + 1
                                                                                         : 0;
}

static int string_is_text(const pcg_any *value)
{
    return value->kind == PCG_STRING || value->kind == PCG_PATH;
}

static void string_add_plain(core_buffer *b, const string_field *f, const pcg_any *value)
{
    int is_float = value->kind == PCG_FLOAT || value->kind > PCG_ENUM;
    if (f->decimals >= 0 && is_float) {
        core_add_fixed(b, value->cell[0].f, f->decimals);
    } else if (f->decimals >= 0 && value->kind == PCG_INT) {
        core_add_fixed(b, (double)value->cell[0].i, f->decimals);
    } else {
        core_add_value(b, value);
    }
}

static void string_add_field(core_buffer *b, const string_field *f, const pcg_any *value)
{
    core_buffer plain = {.run = b->run};
    string_add_plain(&plain, f, value);
    const char *written = core_finish(&plain);
    pcg_int missing = f->width - string_characters(written, written + strlen(written));
    int behind = string_is_text(value);
    if (f->zeros && !behind && *written == '-') {
        core_add(b, "-");
        written++;
    }
    for (pcg_int i = 0; !behind && i < missing; i++) {
        core_add(b, f->zeros ? "0" : " ");
    }
    core_add(b, written);
    for (pcg_int i = 0; behind && i < missing; i++) {
        core_add(b, " ");
    }
}

const char *pcg_core_fn_format_string_anys(pcg_call *call, const char *pattern,
                                           const pcg_any *values, pcg_u32 values_count)
{
    core_buffer b = {.run = call->run};
    const char *whole = pattern;
    pcg_u32 used = 0;
    while (*pattern) {
        string_field field;
        const char *end;
        if ((*pattern == '{' || *pattern == '}') && pattern[1] == *pattern) {
            core_add_bytes(&b, pattern, 1);
            pattern += 2;
        } else if (*pattern == '{' && (end = string_read_field(pattern + 1, &field)) != 0) {
            if (used < values_count) {
                string_add_field(&b, &field, &values[used]);
            } else {
                core_add_bytes(&b, pattern, (size_t)(end - pattern));
            }
            used++;
            pattern = end;
        } else {
            core_add_bytes(&b, pattern, 1);
            pattern++;
        }
    }
    if (used != values_count) {
        pcg_warn(call, "format \"%s\" has %u places for %u values", whole, used, values_count);
    }
    return core_finish(&b);
}

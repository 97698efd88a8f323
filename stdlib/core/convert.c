/*pcg
/// The whole number that a number begins with: its decimals are cut off.
function int(x: float) -> int [pure] { example int(-2.75) == -2 }
/// The number of metres, without its decimals.
function int(x: length) -> int [pure] { example int(275cm) == 2 }
/// 1 for true, 0 for false.
function int(x: bool) -> int [pure] { example int(true) == 1 }
/// The whole number that a string holds; 0, with a warning, where it holds none.
function int(s: string) -> int [pure] { example int(" -42 ") == -42 }

/// The number itself, as one with decimals.
function float(x: int) -> float [pure] { example float(1) / 2 == 0.5 }
/// The number of metres.
function float(x: length) -> float [pure] { example float(250cm) == 2.5 }
/// The number of square metres.
function float(x: area) -> float [pure] { example float(2.5m2) == 2.5 }
/// The number of degrees.
function float(x: angle) -> float [pure] { example float(90deg) == 90.0 }
/// The share, where 1 is the whole.
function float(x: ratio) -> float [pure] { example float(50%) == 0.5 }
/// The number of seconds.
function float(x: seconds) -> float [pure] { example float(500ms) == 0.5 }
/// The number that a string holds; 0, with a warning, where it holds none.
function float(s: string) -> float [pure] { example float("2.5") == 2.5 }

/// Whether a number is not 0.
function bool(x: int) -> bool [pure] { example bool(3) }
/// Whether a string is "true"; a warning, and false, where it is neither that nor "false".
function bool(s: string) -> bool [pure] { example bool("true") }

/// A value as text, as an expression that needs a string converts it.
function string(value: any) -> string [pure] { example string(2.5) == "2.5" }
*/
#include "convert.h"
#include "core.h"
#include "runtime/base/base.h"

#include <math.h>
#include <string.h>

/* ---- to whole numbers ------------------------------------------------------------------------ */

static pcg_int convert_whole(double x)
{
    if (x >= 9223372036854775808.0) {
        return INT64_MAX;
    }
    return x > -9223372036854775808.0 ? (pcg_int)x : INT64_MIN;
}

pcg_int pcg_core_fn_int_float(pcg_call *call, double x)
{
    (void)call;
    return convert_whole(x);
}

pcg_int pcg_core_fn_int_length(pcg_call *call, double x)
{
    (void)call;
    return convert_whole(x);
}

pcg_int pcg_core_fn_int_bool(pcg_call *call, int x)
{
    (void)call;
    return x != 0;
}

static const char *convert_skip_blanks(const char *s)
{
    return s + strspn(s, " \t\r\n");
}

/* The number in s, with nothing but blanks around it; 0 and a warning where that is not so. */
static double convert_number(pcg_call *call, const char *s)
{
    const char *begin = convert_skip_blanks(s), *end;
    double value = number_read(begin, &end);
    if (end == begin || *convert_skip_blanks(end) || !isfinite(value)) {
        pcg_warn(call, "\"%s\" is no number: 0 stands for it", s);
        return 0;
    }
    return value;
}

pcg_int pcg_core_fn_int_string(pcg_call *call, const char *s)
{
    const char *at = convert_skip_blanks(s);
    int negative = *at == '-';
    pcg_u64 value = 0;
    at += *at == '-' || *at == '+';
    const char *first = at;
    for (; *at >= '0' && *at <= '9' && at - first < 18; at++) {
        value = value * 10 + (pcg_u64)(*at - '0');
    }
    if (at == first || *convert_skip_blanks(at)) {
        return convert_whole(convert_number(call, s)); /* has decimals, or is large, or is none */
    }
    return negative ? -(pcg_int)value : (pcg_int)value;
}

/* ---- to numbers with decimals ---------------------------------------------------------------- */

double pcg_core_fn_float_int(pcg_call *call, pcg_int x)
{
    (void)call;
    return (double)x;
}

#define CONVERT_FLOAT(type)                                                                        \
    double pcg_core_fn_float_##type(pcg_call *call, double x)                                      \
    {                                                                                              \
        (void)call;                                                                                \
        return x;                                                                                  \
    }

CONVERT_FLOAT(length)
CONVERT_FLOAT(area)
CONVERT_FLOAT(angle)
CONVERT_FLOAT(ratio)
CONVERT_FLOAT(seconds)

double pcg_core_fn_float_string(pcg_call *call, const char *s)
{
    return convert_number(call, s);
}

/* ---- to the rest ----------------------------------------------------------------------------- */

int pcg_core_fn_bool_int(pcg_call *call, pcg_int x)
{
    (void)call;
    return x != 0;
}

int pcg_core_fn_bool_string(pcg_call *call, const char *s)
{
    if (strcmp(s, "true") != 0 && strcmp(s, "false") != 0) {
        pcg_warn(call, "\"%s\" is neither true nor false: false stands for it", s);
    }
    return strcmp(s, "true") == 0;
}

const char *pcg_core_fn_string_any(pcg_call *call, const pcg_any *value)
{
    core_buffer b = {.run = call->run};
    core_add_value(&b, value);
    return core_finish(&b);
}

/*pcg
/// The smaller of two values.
function min(a: int, b: int) -> int [pure] { example min(3, 2) == 2 }
/// The smaller of two values.
function min(a: float, b: float) -> float [pure] { example min(3.0, 2.0) == 2.0 }
/// The smaller of two values.
function min(a: length, b: length) -> length [pure] { example min(3m, 2m) == 2m }
/// The smaller of two values.
function min(a: area, b: area) -> area [pure] { example min(3m2, 2m2) == 2m2 }
/// The smaller of two values.
function min(a: angle, b: angle) -> angle [pure] { example min(3deg, 2deg) == 2deg }
/// The smaller of two values.
function min(a: ratio, b: ratio) -> ratio [pure] { example min(300%, 200%) == 200% }
/// The smaller of two values.
function min(a: seconds, b: seconds) -> seconds [pure] { example min(3s, 2s) == 2s }

/// The larger of two values.
function max(a: int, b: int) -> int [pure] { example max(3, 2) == 3 }
/// The larger of two values.
function max(a: float, b: float) -> float [pure] { example max(3.0, 2.0) == 3.0 }
/// The larger of two values.
function max(a: length, b: length) -> length [pure] { example max(3m, 2m) == 3m }
/// The larger of two values.
function max(a: area, b: area) -> area [pure] { example max(3m2, 2m2) == 3m2 }
/// The larger of two values.
function max(a: angle, b: angle) -> angle [pure] { example max(3deg, 2deg) == 3deg }
/// The larger of two values.
function max(a: ratio, b: ratio) -> ratio [pure] { example max(300%, 200%) == 300% }
/// The larger of two values.
function max(a: seconds, b: seconds) -> seconds [pure] { example max(3s, 2s) == 3s }

/// The value without its sign.
function abs(x: int) -> int [pure] { example abs(-3) == 3 }
/// The value without its sign.
function abs(x: float) -> float [pure] { example abs(-3.0) == 3.0 }
/// The value without its sign.
function abs(x: length) -> length [pure] { example abs(-3m) == 3m }
/// The value without its sign.
function abs(x: area) -> area [pure] { example abs(-3m2) == 3m2 }
/// The value without its sign.
function abs(x: angle) -> angle [pure] { example abs(-3deg) == 3deg }
/// The value without its sign.
function abs(x: ratio) -> ratio [pure] { example abs(-300%) == 300% }
/// The value without its sign.
function abs(x: seconds) -> seconds [pure] { example abs(-3s) == 3s }

/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: int, low: int, high: int) -> int [pure] { example clamp(7, 1, 5) == 5 }
/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: float, low: float, high: float) -> float [pure] {
    example clamp(7.0, 1.0, 5.0) == 5.0
}
/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: length, low: length, high: length) -> length [pure] {
    example clamp(7m, 1m, 5m) == 5m
}
/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: area, low: area, high: area) -> area [pure] {
    example clamp(7m2, 1m2, 5m2) == 5m2
}
/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: angle, low: angle, high: angle) -> angle [pure] {
    example clamp(7deg, 1deg, 5deg) == 5deg
}
/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: ratio, low: ratio, high: ratio) -> ratio [pure] {
    example clamp(700%, 100%, 500%) == 500%
}
/// The value kept between two bounds: `min(max(x, low), high)`.
function clamp(x: seconds, low: seconds, high: seconds) -> seconds [pure] {
    example clamp(7s, 1s, 5s) == 5s
}

/// The value on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: float, b: float, t: ratio) -> float [pure] { example lerp(2.0, 4.0, 50%) == 3.0 }
/// The value on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: length, b: length, t: ratio) -> length [pure] { example lerp(2m, 4m, 50%) == 3m }
/// The value on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: area, b: area, t: ratio) -> area [pure] { example lerp(2m2, 4m2, 50%) == 3m2 }
/// The value on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: angle, b: angle, t: ratio) -> angle [pure] {
    example lerp(2deg, 4deg, 50%) == 3deg
}
/// The value on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: ratio, b: ratio, t: ratio) -> ratio [pure] {
    example lerp(200%, 400%, 50%) == 300%
}
/// The value on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: seconds, b: seconds, t: ratio) -> seconds [pure] {
    example lerp(2s, 4s, 50%) == 3s
}

/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: int, b: int) -> int [pure] { example mod(-1, 3) == 2 }
/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: float, b: float) -> float [pure] { example mod(-1.0, 3.0) == 2.0 }
/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: length, b: length) -> length [pure] { example mod(-1m, 3m) == 2m }
/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: area, b: area) -> area [pure] { example mod(-1m2, 3m2) == 2m2 }
/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: angle, b: angle) -> angle [pure] { example mod(-1deg, 3deg) == 2deg }
/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: ratio, b: ratio) -> ratio [pure] { example mod(-100%, 300%) == 200% }
/// What is left of `a` after whole multiples of `b`, with the sign of `b` (`%` has the sign of `a`).
/// By zero: 0, with a warning.
function mod(a: seconds, b: seconds) -> seconds [pure] { example mod(-1s, 3s) == 2s }

/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: int, step: int) -> int [pure] { example snap(7, 3) == 6 }
/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: float, step: float) -> float [pure] { example snap(7.0, 2.5) == 7.5 }
/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: length, step: length) -> length [pure] { example snap(7m, 2.5m) == 7.5m }
/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: area, step: area) -> area [pure] { example snap(7m2, 2.5m2) == 7.5m2 }
/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: angle, step: angle) -> angle [pure] { example snap(7deg, 2.5deg) == 7.5deg }
/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: ratio, step: ratio) -> ratio [pure] { example snap(700%, 250%) == 750% }
/// The multiple of `step` that is nearest to the value. A step of 0 leaves it as it is.
function snap(x: seconds, step: seconds) -> seconds [pure] { example snap(7s, 2.5s) == 7.5s }

/// The square root of the sum of two squares.
function hypot(a: float, b: float) -> float [pure] { example hypot(3.0, 4.0) == 5.0 }
/// The square root of the sum of two squares.
function hypot(a: length, b: length) -> length [pure] { example hypot(3m, 4m) == 5m }

/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: int) -> int [pure] { example sign(-2) == -1 }
/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: float) -> int [pure] { example sign(-2.0) == -1 }
/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: length) -> int [pure] { example sign(-2m) == -1 }
/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: area) -> int [pure] { example sign(-2m2) == -1 }
/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: angle) -> int [pure] { example sign(-2deg) == -1 }
/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: ratio) -> int [pure] { example sign(-200%) == -1 }
/// -1, 0 or 1, as the value is below, at or above 0.
function sign(x: seconds) -> int [pure] { example sign(-2s) == -1 }

/// The largest whole number that is not above the value.
function floor(x: float) -> int [pure] { example floor(-2.5) == -3 }

/// The smallest whole number that is not below the value.
function ceil(x: float) -> int [pure] { example ceil(-2.5) == -2 }

/// The nearest whole number; a half goes away from 0.
function round(x: float) -> int [pure] { example round(-2.5) == -3 }

/// The value without its decimals.
function trunc(x: float) -> int [pure] { example trunc(-2.5) == -2 }

/// The value's part behind the point: `x - floor(x)`.
function fract(x: float) -> float [pure] { example fract(-2.25) == 0.75 }

/// The square root; of a negative value 0, with a warning.
function sqrt(x: float) -> float [pure] { example sqrt(2.25) == 1.5 }
/// The side of the square that has this area; of a negative one 0, with a warning.
function sqrt(x: area) -> length [pure] { example sqrt(9m2) == 3m }
/// x to the power y. Where that is not defined (a negative number to a broken power) 0, with a warning.
function pow(x: float, y: float) -> float [pure] { example pow(2.0, 0.5) == sqrt(2.0) }
/// e to the power x.
function exp(x: float) -> float [pure] { example exp(0.0) == 1.0 }
/// The natural logarithm; of 0 and less 0, with a warning.
function log(x: float) -> float [pure] { example log(exp(1.0)) == 1.0 }
/// The logarithm to base 10; of 0 and less 0, with a warning.
function log10(x: float) -> float [pure] { example log10(1000.0) == 3.0 }

/// The sine of an angle.
function sin(x: angle) -> float [pure] { example sin(30deg) == 0.5 }
/// The cosine of an angle.
function cos(x: angle) -> float [pure] { example cos(60deg) == 0.5 }
/// The tangent of an angle; at 90 degrees the largest number, with a warning.
function tan(x: angle) -> float [pure] { example tan(45deg) == 1.0 }
/// The angle from -90 to 90 degrees that has this sine. Beyond -1 and 1 it is that of the bound, with a warning.
function asin(x: float) -> angle [pure] { example asin(0.5) == 30deg }
/// The angle from 0 to 180 degrees that has this cosine. Beyond -1 and 1 it is that of the bound, with a warning.
function acos(x: float) -> angle [pure] { example acos(0.5) == 60deg }
/// The angle from -90 to 90 degrees that has this tangent.
function atan(x: float) -> angle [pure] { example atan(1.0) == 45deg }
/// The direction of the point (x, y), from -180 to 180 degrees, counter-clockwise from the x axis; 0 where both are 0.
function atan2(y: float, x: float) -> angle [pure] { example atan2(1.0, -1.0) == 135deg }
/// The direction of the point (x, y), from -180 to 180 degrees, counter-clockwise from the x axis; 0 where both are 0.
function atan2(y: length, x: length) -> angle [pure] { example atan2(-2m, 0m) == -90deg }
/// A circle's circumference by its diameter.
function pi() -> float [pure] { example abs(pi() - 3.14159265) < 0.00000001 }
*/
#include "math.h"
#include "core.h"
#include "runtime/real.h"
#include <float.h>
#include <math.h>

/* ---- results that are always numbers --------------------------------------------------------- */

/* The result of `name` of x, if it is a finite number; what stands for it, and a warning, if
 * not. */
static double math_result(pcg_call *call, const char *name, double x, double result)
{
    if (isfinite(result)) {
        return result;
    }
    if (isnan(result)) {
        pcg_warn(call, "'%s' of %s has no result: 0 stands for it", name, core_number(call, x));
        return 0;
    }
    pcg_warn(call, "'%s' of %s is too large: the largest number stands for it", name,
             core_number(call, x));
    return result > 0 ? DBL_MAX : -DBL_MAX;
}

static pcg_int math_whole(double x)
{
    if (x >= 9223372036854775808.0) {
        return 0x7fffffffffffffffLL;
    }
    return x > -9223372036854775808.0 ? (pcg_int)x : -0x7fffffffffffffffLL - 1;
}

/* ---- functions of numbers with any unit ------------------------------------------------------ */

static double math_mod(pcg_call *call, double a, double b)
{
    if (b == 0) {
        pcg_warn(call, "'mod' by zero: 0 stands for it");
        return 0;
    }
    double rest = fmod(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

static double math_snap(double x, double step)
{
    double snapped = step == 0 ? x : round(x / step) * step;
    return isfinite(snapped) ? snapped : x;
}

/* The numbers with a fraction share their code; each unit has a symbol of its own. */
#define MATH_OF(type)                                                                              \
    double pcg_core_fn_min_##type##_##type(pcg_call *call, double a, double b)                     \
    {                                                                                              \
        (void)call;                                                                                \
        return b < a ? b : a;                                                                      \
    }                                                                                              \
    double pcg_core_fn_max_##type##_##type(pcg_call *call, double a, double b)                     \
    {                                                                                              \
        (void)call;                                                                                \
        return b > a ? b : a;                                                                      \
    }                                                                                              \
    double pcg_core_fn_abs_##type(pcg_call *call, double x)                                        \
    {                                                                                              \
        (void)call;                                                                                \
        return fabs(x);                                                                            \
    }                                                                                              \
    double pcg_core_fn_clamp_##type##_##type##_##type(pcg_call *call, double x, double low,        \
                                                      double high)                                 \
    {                                                                                              \
        (void)call;                                                                                \
        double raised = x < low ? low : x;                                                         \
        return raised > high ? high : raised;                                                      \
    }                                                                                              \
    double pcg_core_fn_lerp_##type##_##type##_ratio(pcg_call *call, double a, double b, double t)  \
    {                                                                                              \
        (void)call;                                                                                \
        return t == 1 ? b : a + (b - a) * t;                                                       \
    }                                                                                              \
    double pcg_core_fn_mod_##type##_##type(pcg_call *call, double a, double b)                     \
    {                                                                                              \
        return math_mod(call, a, b);                                                               \
    }                                                                                              \
    double pcg_core_fn_snap_##type##_##type(pcg_call *call, double x, double step)                 \
    {                                                                                              \
        (void)call;                                                                                \
        return math_snap(x, step);                                                                 \
    }                                                                                              \
    pcg_int pcg_core_fn_sign_##type(pcg_call *call, double x)                                      \
    {                                                                                              \
        (void)call;                                                                                \
        return (x > 0) - (x < 0);                                                                  \
    }

MATH_OF(float)
MATH_OF(length)
MATH_OF(area)
MATH_OF(angle)
MATH_OF(ratio)
MATH_OF(seconds)

/* ---- functions of whole numbers -------------------------------------------------------------- */

pcg_int pcg_core_fn_min_int_int(pcg_call *call, pcg_int a, pcg_int b)
{
    (void)call;
    return b < a ? b : a;
}

pcg_int pcg_core_fn_max_int_int(pcg_call *call, pcg_int a, pcg_int b)
{
    (void)call;
    return b > a ? b : a;
}

pcg_int pcg_core_fn_abs_int(pcg_call *call, pcg_int x)
{
    (void)call;
    return x >= 0 ? x : x < -0x7fffffffffffffffLL ? 0x7fffffffffffffffLL : -x;
}

pcg_int pcg_core_fn_clamp_int_int_int(pcg_call *call, pcg_int x, pcg_int low, pcg_int high)
{
    (void)call;
    pcg_int raised = x < low ? low : x;
    return raised > high ? high : raised;
}

pcg_int pcg_core_fn_mod_int_int(pcg_call *call, pcg_int a, pcg_int b)
{
    if (b == 0) {
        pcg_warn(call, "'mod' by zero: 0 stands for it");
        return 0;
    }
    pcg_int rest = b == -1 ? 0 : a % b;
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

pcg_int pcg_core_fn_snap_int_int(pcg_call *call, pcg_int x, pcg_int step)
{
    if (step == 0) {
        return x;
    }
    pcg_int width = pcg_core_fn_abs_int(call, step);
    pcg_int rest = pcg_core_fn_mod_int_int(call, x, width);
    pcg_int up = width - rest;
    if (rest < up || (rest == up && x < 0) || x > 0x7fffffffffffffffLL - up) {
        /* Down, unless the multiple below is no int. */
        return x < -0x7fffffffffffffffLL - 1 + rest ? x : x - rest;
    }
    return x + up;
}

pcg_int pcg_core_fn_sign_int(pcg_call *call, pcg_int x)
{
    (void)call;
    return (x > 0) - (x < 0);
}

/* ---- to whole numbers ------------------------------------------------------------------------ */

pcg_int pcg_core_fn_floor_float(pcg_call *call, double x)
{
    (void)call;
    return math_whole(floor(x));
}

pcg_int pcg_core_fn_ceil_float(pcg_call *call, double x)
{
    (void)call;
    return math_whole(ceil(x));
}

pcg_int pcg_core_fn_round_float(pcg_call *call, double x)
{
    (void)call;
    return math_whole(round(x));
}

pcg_int pcg_core_fn_trunc_float(pcg_call *call, double x)
{
    (void)call;
    return math_whole(x);
}

double pcg_core_fn_fract_float(pcg_call *call, double x)
{
    (void)call;
    return x - floor(x);
}

/* ---- roots, powers, logarithms --------------------------------------------------------------- */

double pcg_core_fn_sqrt_float(pcg_call *call, double x)
{
    return math_result(call, "sqrt", x, sqrt(x));
}

double pcg_core_fn_sqrt_area(pcg_call *call, double x)
{
    return math_result(call, "sqrt", x, sqrt(x));
}

double pcg_core_fn_hypot_float_float(pcg_call *call, double a, double b)
{
    return math_result(call, "hypot", a, real_hypot(a, b));
}

double pcg_core_fn_hypot_length_length(pcg_call *call, double a, double b)
{
    return math_result(call, "hypot", a, real_hypot(a, b));
}

double pcg_core_fn_pow_float_float(pcg_call *call, double x, double y)
{
    return math_result(call, "pow", x, real_pow(x, y));
}

double pcg_core_fn_exp_float(pcg_call *call, double x)
{
    return math_result(call, "exp", x, real_exp(x));
}

double pcg_core_fn_log_float(pcg_call *call, double x)
{
    return math_result(call, "log", x, x == 0 ? (double)NAN : real_log(x));
}

double pcg_core_fn_log10_float(pcg_call *call, double x)
{
    return math_result(call, "log10", x, x == 0 ? (double)NAN : real_log10(x));
}

/* ---- angles ---------------------------------------------------------------------------------- */

double pcg_core_fn_sin_angle(pcg_call *call, double x)
{
    return math_result(call, "sin", x, real_sin(x));
}

double pcg_core_fn_cos_angle(pcg_call *call, double x)
{
    return math_result(call, "cos", x, real_cos(x));
}

double pcg_core_fn_tan_angle(pcg_call *call, double x)
{
    return math_result(call, "tan", x, real_tan(x));
}

/* The sine or cosine that an arc is taken of, within its bounds. */
static double math_within_one(pcg_call *call, const char *name, double x)
{
    if (fabs(x) <= 1) {
        return x;
    }
    if (fabs(x) > 1 + 1e-12) { /* a difference of rounding is not worth a word */
        pcg_warn(call, "'%s' of %s has no result: %d is taken instead", name, core_number(call, x),
                 x > 0 ? 1 : -1);
    }
    return x > 0 ? 1 : -1;
}

double pcg_core_fn_asin_float(pcg_call *call, double x)
{
    return real_asin(math_within_one(call, "asin", x));
}

double pcg_core_fn_acos_float(pcg_call *call, double x)
{
    return real_acos(math_within_one(call, "acos", x));
}

double pcg_core_fn_atan_float(pcg_call *call, double x)
{
    return math_result(call, "atan", x, real_atan(x));
}

double pcg_core_fn_atan2_float_float(pcg_call *call, double y, double x)
{
    return math_result(call, "atan2", y, real_atan2(y, x));
}

double pcg_core_fn_atan2_length_length(pcg_call *call, double y, double x)
{
    return math_result(call, "atan2", y, real_atan2(y, x));
}

double pcg_core_fn_pi(pcg_call *call)
{
    (void)call;
    return 3.14159265358979323846;
}

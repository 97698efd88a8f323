/* real.c - elementary functions from the four operations and the square root.
 *
 * Each reduces its argument to where a short Taylor series holds, exactly if it can. Logarithms and
 * powers are carried as sums of two doubles (Dekker, "A floating-point technique for extending the
 * available precision", 1971), since a power raises the error of a logarithm by its size. The build
 * must not fuse a multiplication with an addition (-ffp-contract=off).
 */
#include "real.h"

#include <math.h>

#define DEGREE 0.017453292519943295769 /* in radians */
#define LN_2_HIGH 0x1.62e42fefa39efp-1 /* the natural logarithm of 2, as a sum of two doubles */
#define LN_2_LOW 0x1.abc9e3b39803fp-56
#define LN_2_SHORT 0x1.62e42fep-1 /* its first 28 bits: whole multiples up to 2^25 are exact */
#define LN_2_REST 0x1.f473de6af278fp-30
#define LN_10 2.302585092994045684

/* ---- polynomials ----------------------------------------------------------------------------- */

static double polynomial(const double *coefficients, int count, double x)
{
    double sum = 0;
    while (count-- > 0) {
        sum = sum * x + coefficients[count];
    }
    return sum;
}
#define POLYNOMIAL(of, x) polynomial(of, (int)(sizeof(of) / sizeof(of)[0]), x)

/* ---- sines ----------------------------------------------------------------------------------- */

/* Of radians, |t| <= pi/4. */
static double sine(double t)
{
    static const double c[] = {-1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800,
                               1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
    double z = t * t;
    return t + t * (z * POLYNOMIAL(c, z));
}

static double cosine(double t)
{
    static const double c[] = {1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800, 1.0 / 479001600,
                               -1.0 / 87178291200, 1.0 / 20922789888000};
    double z = t * t, half = z / 2;
    double sum = 1 - half;
    return sum + ((1 - sum - half) + z * z * POLYNOMIAL(c, z)); /* with what 1 - half lost */
}

/* Degrees as whole quarters of a turn, 0 … 3, and the rest, -45 … 45: exact. */
static int quarter(double degrees, double *rest)
{
    double turn = fmod(degrees, 360);
    double quarters = floor(turn / 90 + 0.5);
    *rest = turn - quarters * 90;
    return ((int)quarters + 8) % 4;
}

static double sine_degrees(double rest)
{
    if (fabs(rest) == 30) {
        return rest / 60;
    }
    return sine(rest * DEGREE);
}

double real_sin(double degrees)
{
    double rest;
    if (!isfinite(degrees)) {
        return NAN;
    }
    switch (quarter(degrees, &rest)) {
    case 0:
        return sine_degrees(rest);
    case 1:
        return cosine(rest * DEGREE);
    case 2:
        return 0 - sine_degrees(rest);
    default:
        return -cosine(rest * DEGREE);
    }
}

double real_cos(double degrees)
{
    double rest;
    if (!isfinite(degrees)) {
        return NAN;
    }
    switch (quarter(degrees, &rest)) {
    case 0:
        return cosine(rest * DEGREE);
    case 1:
        return 0 - sine_degrees(rest);
    case 2:
        return -cosine(rest * DEGREE);
    default:
        return sine_degrees(rest);
    }
}

double real_tan(double degrees)
{
    double rest;
    if (!isfinite(degrees)) {
        return NAN;
    }
    int odd = quarter(degrees, &rest) % 2;
    if (fabs(rest) == 45) {
        return (rest > 0) != odd ? 1 : -1;
    }
    double s = sine(rest * DEGREE), c = cosine(rest * DEGREE);
    return odd ? (s == 0 ? INFINITY : -c / s) : s / c;
}

/* ---- arcs ------------------------------------------------------------------------------------ */

/* In degrees, 0 <= x <= 1. */
static double arc(double x)
{
    static const double c[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13,
                               -1.0 / 15, 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23};
    double turned = x > 0.41421356237309503 ? 45 : 0;
    double t = turned > 0 ? (x - 1) / (x + 1) : x;
    double half = t / (1 + sqrt(1 + t * t)); /* the tangent of half the angle: at most 0.2 */
    double z = half * half;
    return turned + 2 * (half + half * (z * POLYNOMIAL(c, z))) / DEGREE;
}

double real_atan2(double y, double x)
{
    double across = fabs(x), up = fabs(y);
    double angle = 0;
    if (isnan(x) || isnan(y)) {
        return NAN;
    }
    if (isinf(across) && isinf(up)) {
        angle = 45;
    } else if (up > across) {
        angle = 90 - arc(across / up);
    } else if (across > 0) {
        angle = arc(up / across);
    }
    if (x < 0) {
        angle = 180 - angle;
    }
    return y < 0 ? -angle : angle;
}

double real_atan(double x)
{
    return real_atan2(x, 1);
}

double real_asin(double x)
{
    if (!(fabs(x) <= 1)) {
        return NAN;
    }
    return fabs(x) == 0.5 ? 60 * x : real_atan2(x, sqrt((1 - x) * (1 + x)));
}

double real_acos(double x)
{
    if (!(fabs(x) <= 1)) {
        return NAN;
    }
    return fabs(x) == 0.5 ? 90 - 60 * x : real_atan2(sqrt((1 - x) * (1 + x)), x);
}

/* ---- sums of two doubles --------------------------------------------------------------------- */

/* high + low, |low| at most half a unit in the last place of high. */
typedef struct pair {
    double high, low;
} pair;

/* a + b; exact. */
static pair pair_sum(double a, double b)
{
    double high = a + b;
    double of_b = high - a;
    return (pair){high, (a - (high - of_b)) + (b - of_b)};
}

/* a * b; exact while neither passes 2^996 and the product does not fall below 2^-960. */
static pair pair_product(double a, double b)
{
    double split_a = 134217729 * a, split_b = 134217729 * b;
    double a_high = split_a - (split_a - a), b_high = split_b - (split_b - b);
    double a_low = a - a_high, b_low = b - b_high;
    double high = a * b;
    double low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
    return (pair){high, low};
}

static pair pair_add(pair a, pair b)
{
    pair sum = pair_sum(a.high, b.high);
    return pair_sum(sum.high, sum.low + (a.low + b.low));
}

static pair pair_multiply(pair a, pair b)
{
    pair product = pair_product(a.high, b.high);
    return pair_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

static pair pair_divide(pair a, pair b)
{
    double high = a.high / b.high;
    pair back = pair_multiply((pair){high, 0}, b);
    double rest = ((a.high - back.high) - back.low) + a.low;
    return pair_sum(high, rest / b.high);
}

/* ---- exponentials and logarithms ------------------------------------------------------------- */

/* e to the high + low. */
static double exponential(double high, double low)
{
    static const double c[] = {1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040,
                               1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800,
                               1.0 / 479001600, 1.0 / 6227020800, 1.0 / 87178291200};
    if (isnan(high)) {
        return NAN;
    }
    if (high > 710) {
        return INFINITY;
    }
    if (high < -746) {
        return 0;
    }
    double twos = floor(high / LN_2_HIGH + 0.5);
    pair r = pair_sum((high - twos * LN_2_SHORT) - twos * LN_2_REST, low);
    double rest = r.low + r.high * r.high * POLYNOMIAL(c, r.high);
    return ldexp(1 + (r.high + rest), (int)twos);
}

double real_exp(double x)
{
    return exponential(x, 0);
}

/* Of a finite x > 0: 2 atanh((m - 1) / (m + 1)) for the mantissa, and its exponent's share. */
static pair logarithm(double x)
{
    static const double c[] = {1.0 / 9, 1.0 / 11, 1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21,
                               1.0 / 23, 1.0 / 25, 1.0 / 27, 1.0 / 29, 1.0 / 31};
    int exponent;
    double m = frexp(x, &exponent);
    if (m < 0.70710678118654757) {
        m *= 2;
        exponent--;
    }
    pair s = pair_divide((pair){m - 1, 0}, pair_sum(m, 1));
    pair z = pair_multiply(s, s);
    pair sum = {POLYNOMIAL(c, z.high), 0};
    for (int odd = 7; odd > 0; odd -= 2) {
        sum = pair_add(pair_divide((pair){1, 0}, (pair){odd, 0}), pair_multiply(z, sum));
    }
    pair mantissa = pair_multiply(s, sum);
    pair twos = pair_multiply((pair){exponent, 0}, (pair){LN_2_HIGH, LN_2_LOW});
    return pair_add(twos, (pair){2 * mantissa.high, 2 * mantissa.low});
}

double real_log(double x)
{
    if (!(x > 0)) {
        return x == 0 ? -INFINITY : NAN;
    }
    return isinf(x) ? x : logarithm(x).high;
}

double real_log10(double x)
{
    if (!(x > 0) || isinf(x)) {
        return real_log(x);
    }
    /* The quotient of two that are longer than a double: powers of ten come out whole. */
    return pair_divide(logarithm(x), logarithm(10)).high;
}

/* x to a whole number 0 … 1024, squaring: right to the last bit where the result fits a double. */
static pair power_whole(double x, int exponent)
{
    pair result = {1, 0}, square = {x, 0};
    for (; exponent > 0; exponent >>= 1) {
        if (exponent & 1) {
            result = pair_multiply(result, square);
        }
        square = pair_multiply(square, square);
    }
    return result;
}

/* x > 0 and finite, x not 1. */
static double power(double x, double y)
{
    double magnitude = fabs(y);
    if (magnitude <= 1024 && magnitude == floor(magnitude)) {
        pair result = power_whole(x, (int)magnitude);
        if (y < 0) {
            result = pair_divide((pair){1, 0}, result);
        }
        /* Far from the ends of the doubles nothing on the way has overflown. */
        if (result.high > 1e-140 && result.high < 1e140) {
            return result.high;
        }
    }
    pair l = logarithm(x);
    double rough = y * l.high;
    if (!(fabs(rough) < 800)) {
        return rough > 0 ? INFINITY : 0;
    }
    pair product = pair_product(y, l.high);
    return exponential(product.high, product.low + y * l.low);
}

double real_pow(double x, double y)
{
    double magnitude = fabs(x);
    if (y == 0 || x == 1) {
        return 1;
    }
    if (isnan(x) || isnan(y) || (x < 0 && (y != floor(y) || isinf(y)))) {
        return NAN;
    }
    int odd = x < 0 && fmod(y, 2) != 0;
    double result;
    if (magnitude == 0 || isinf(magnitude)) {
        result = (magnitude == 0) == (y > 0) ? 0 : INFINITY;
    } else if (isinf(y)) {
        result = (magnitude > 1) == (y > 0) ? INFINITY : 0;
    } else {
        result = magnitude == 1 ? 1 : power(magnitude, y);
    }
    return odd ? -result : result;
}

double real_hypot(double x, double y)
{
    double large = fabs(x) > fabs(y) ? fabs(x) : fabs(y);
    double small = fabs(x) > fabs(y) ? fabs(y) : fabs(x);
    if (large > 1e-140 && large < 1e140) {
        return sqrt(x * x + y * y);
    }
    if (!(large > 0) || isinf(large)) {
        return large;
    }
    int exponent;
    double near = frexp(large, &exponent), rest = ldexp(small, -exponent);
    return ldexp(sqrt(near * near + rest * rest), exponent);
}

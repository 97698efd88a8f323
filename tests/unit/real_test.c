/* real_test.c - elementary functions: near the C library's, exact where one would look, defined
 * everywhere. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "runtime/real.h"

static unsigned passed, failed;

static void expect(bool holds, const char *what, double found)
{
    passed += holds;
    failed += !holds;
    if (!holds)
        printf("not ok %s: %.17g\n", what, found);
}

static uint64_t chance_state = 88172645463325252u;

static double between(double low, double high)
{
    chance_state ^= chance_state << 13;
    chance_state ^= chance_state >> 7;
    chance_state ^= chance_state << 17;
    return low + (high - low) * ((double)(chance_state >> 11) / 9007199254740992.0);
}

/* The distance of two numbers in units of the last place. */
static double units_apart(double found, double expected)
{
    double unit = nextafter(fabs(expected), INFINITY) - fabs(expected);
    return found == expected ? 0 : fabs(found - expected) / unit;
}

static const double degree = 0.017453292519943295769;

static double library_sin(double x)
{
    return sin(x * degree);
}
static double library_cos(double x)
{
    return cos(x * degree);
}
static double library_tan(double x)
{
    return tan(x * degree);
}
static double library_asin(double x)
{
    return asin(x) / degree;
}
static double library_acos(double x)
{
    return acos(x) / degree;
}
static double library_atan(double x)
{
    return atan(x) / degree;
}
static double root(double x)
{
    return real_pow(x, 0.5);
}
static double broken_power(double x)
{
    return real_pow(x, -3.7);
}
static double library_broken_power(double x)
{
    return pow(x, -3.7);
}

/* `units`: how far apart they may be; the references in degrees are themselves off by a few. */
static void expect_near(const char *what, double low, double high, double units,
                        double (*found)(double), double (*expected)(double))
{
    double worst = 0, at = 0;
    for (int i = 0; i < 100000; i++) {
        double x = between(low, high);
        double apart = units_apart(found(x), expected(x));
        if (!(apart <= worst)) {
            worst = apart;
            at = x;
        }
    }
    expect(worst <= units, what, at);
}

static void expect_exact(const char *what, double found, double expected)
{
    expect(found == expected, what, found);
}

static void check_exact(void)
{
    expect_exact("sin 30", real_sin(30), 0.5);
    expect_exact("sin -150", real_sin(-150), -0.5);
    expect_exact("sin 180", real_sin(180), 0);
    expect_exact("sin 360e9", real_sin(360e9), 0);
    expect_exact("cos 60", real_cos(60), 0.5);
    expect_exact("cos 90", real_cos(90), 0);
    expect_exact("cos 270", real_cos(-270), 0);
    expect_exact("tan 45", real_tan(45), 1);
    expect_exact("tan 135", real_tan(135), -1);
    expect_exact("tan 225", real_tan(225), 1);
    expect_exact("asin 0.5", real_asin(0.5), 30);
    expect_exact("acos -0.5", real_acos(-0.5), 120);
    expect_exact("acos 0", real_acos(0), 90);
    expect_exact("atan 1", real_atan(1), 45);
    expect_exact("atan2 0 -1", real_atan2(0, -1), 180);
    expect_exact("atan2 -1 -1", real_atan2(-1, -1), -135);
    expect_exact("atan2 0 0", real_atan2(0, 0), 0);
    expect_exact("exp 0", real_exp(0), 1);
    expect_exact("log 1", real_log(1), 0);
    expect_exact("2 to the -1074", real_pow(2, -1074), 0x1p-1074);
    expect_exact("-3 to the 3", real_pow(-3, 3), -27);
    expect_exact("0 to the 0", real_pow(0, 0), 1);
    expect_exact("hypot 3 4", real_hypot(3, 4), 5);
    expect_exact("hypot of large ones", real_hypot(0x3p700, 0x4p700), 0x5p700);
    double power = 1;
    for (int i = 0; i <= 22; i++, power *= 10) {
        expect_exact("power of ten", real_pow(10, i), power);
        expect_exact("its logarithm", real_log10(power), i);
    }
}

static void check_edges(void)
{
    expect(isnan(real_asin(1.5)), "asin 1.5", real_asin(1.5));
    expect(isnan(real_log(-1)), "log -1", real_log(-1));
    expect(isnan(real_pow(-2, 0.5)), "root of -2", real_pow(-2, 0.5));
    expect(isnan(real_sin(INFINITY)), "sin of infinity", real_sin(INFINITY));
    expect(isinf(real_exp(1000)), "exp 1000", real_exp(1000));
    expect(isinf(real_pow(1e300, 1e300)), "overflow", real_pow(1e300, 1e300));
    expect_exact("underflow", real_pow(1e300, -1e300), 0);
    expect_exact("exp -1000", real_exp(-1000), 0);
    expect(isinf(real_log(0)) && real_log(0) < 0, "log 0", real_log(0));
    expect(isinf(real_tan(90)), "tan 90", real_tan(90));
}

int main(void)
{
    expect_near("sin", -45, 45, 4, real_sin, library_sin);
    expect_near("cos", -45, 45, 4, real_cos, library_cos);
    expect_near("tan", -44, 44, 5, real_tan, library_tan);
    expect_near("asin", -1, 1, 8, real_asin, library_asin);
    expect_near("acos", -1, 0.99, 8, real_acos, library_acos);
    expect_near("atan", -10, 10, 8, real_atan, library_atan);
    expect_near("exp", -700, 700, 2, real_exp, exp);
    expect_near("log", 0, 1e6, 2, real_log, log);
    expect_near("log near 1", 0.9, 1.1, 2, real_log, log);
    expect_near("log10", 0, 1e6, 2, real_log10, log10);
    expect_near("square root by power", 0, 1e6, 2, root, sqrt);
    expect_near("broken power", 0, 1e6, 2, broken_power, library_broken_power);
    check_exact();
    check_edges();
    printf("%u passed, %u failed\n", passed, failed);
    return failed != 0;
}

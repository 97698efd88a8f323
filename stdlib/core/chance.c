/*pcg
/// A random number from 0 to 1, 1 not included.
///
/// Like all of its kind it depends on the run's seed, the node, the place in the node's expressions and the line
/// of descent of the round's first entity: a change elsewhere in the graph does not re-roll it.
function rand() -> float [random] { example rand() < 1 }
/// A random number between two bounds, each as probable as the others.
function rand(low: float, high: float) -> float [random] { example rand(3.0, 3.0) == 3.0 }
/// A random length between two bounds, each as probable as the others.
function rand(low: length, high: length) -> length [random] { example rand(5m, 15m) >= 5m }
/// A random area between two bounds, each as probable as the others.
function rand(low: area, high: area) -> area [random] { example rand(5m2, 15m2) >= 5m2 }
/// A random angle between two bounds, each as probable as the others.
function rand(low: angle, high: angle) -> angle [random] { example rand(0deg, 90deg) < 90deg }
/// A random share between two bounds, each as probable as the others.
function rand(low: ratio, high: ratio) -> ratio [random] { example rand(10%, 20%) < 20% }
/// A random time between two bounds, each as probable as the others.
function rand(low: seconds, high: seconds) -> seconds [random] { example rand(1s, 2s) < 2s }
/// A random whole number from `low` to `high`, both included.
function rand_int(low: int, high: int) -> int [random] { example rand_int(4, 4) == 4 }
/// Whether something of this probability happens.
function rand_bool(probability: ratio) -> bool [random] { example rand_bool(100%) }
/// A random number from a normal distribution.
function rand_normal(mean: float, deviation: float) -> float [random] {
    example rand_normal(2.0, 0.0) == 2.0
}
/// A random length from a normal distribution.
function rand_normal(mean: length, deviation: length) -> length [random] {
    example rand_normal(2m, 0m) == 2m
}
/// A random angle from a normal distribution.
function rand_normal(mean: angle, deviation: angle) -> angle [random] {
    example rand_normal(2deg, 0deg) == 2deg
}
/// One element of a list by chance, each as probable as the others; of an empty list 0, with a warning.
function choose(values: list<int>) -> int [random] { example choose([7]) == 7 }
/// One element of a list by chance, each as probable as the others; of an empty list 0, with a warning.
function choose(values: list<float>) -> float [random] { example choose([7.5]) == 7.5 }
/// One element of a list by chance, each as probable as the others; of an empty list 0, with a warning.
function choose(values: list<length>) -> length [random] { example choose([7m]) == 7m }
/// One element of a list by chance, each as probable as the others; of an empty list "", with a warning.
function choose(values: list<string>) -> string [random] { example choose(["oak"]) == "oak" }
/// One element of a list by chance, each as probable as the others; of an empty list black, with a warning.
function choose(values: list<color>) -> color [random] { example choose([#8a5a2b]) == #8a5a2b }

/// Smooth noise from -1 to 1 over a line: 0 at whole numbers, never twice the same in between.
///
/// It depends on the coordinates alone; add an offset to them to get another stretch of it.
function noise(x: float) -> float [pure] { example noise(3.0) == 0.0 }
/// Smooth noise from -1 to 1 over a plane; 0 where both coordinates are whole.
function noise(x: float, y: float) -> float [pure] { example noise(3.0, -2.0) == 0.0 }
/// Smooth noise from -1 to 1 over space; 0 where all coordinates are whole.
function noise(x: float, y: float, z: float) -> float [pure] {
    example noise(3.0, -2.0, 8.0) == 0.0
}
*/
#include "chance.h"
#include <math.h>
#include "core.h"
#include "runtime/real.h"

/* ---- even distributions ---------------------------------------------------------------------- */

static double chance_between(pcg_call *call, pcg_u32 site, double low, double high)
{
    return low + (high - low) * pcg_random(call, site, 0);
}

double pcg_core_fn_rand(pcg_call *call, pcg_u32 site)
{
    return pcg_random(call, site, 0);
}

double pcg_core_fn_rand_float_float(pcg_call *call, pcg_u32 site, double low, double high)
{
    return chance_between(call, site, low, high);
}

double pcg_core_fn_rand_length_length(pcg_call *call, pcg_u32 site, double low, double high)
{
    return chance_between(call, site, low, high);
}

double pcg_core_fn_rand_area_area(pcg_call *call, pcg_u32 site, double low, double high)
{
    return chance_between(call, site, low, high);
}

double pcg_core_fn_rand_angle_angle(pcg_call *call, pcg_u32 site, double low, double high)
{
    return chance_between(call, site, low, high);
}

double pcg_core_fn_rand_ratio_ratio(pcg_call *call, pcg_u32 site, double low, double high)
{
    return chance_between(call, site, low, high);
}

double pcg_core_fn_rand_seconds_seconds(pcg_call *call, pcg_u32 site, double low, double high)
{
    return chance_between(call, site, low, high);
}

/* A number below `count`, which is at least 1. */
static pcg_u64 chance_below(pcg_call *call, pcg_u32 site, pcg_u64 count)
{
    pcg_u64 drawn = (pcg_u64)(pcg_random(call, site, 0) * (double)count);
    return drawn < count ? drawn : count - 1;
}

pcg_int pcg_core_fn_rand_int_int_int(pcg_call *call, pcg_u32 site, pcg_int low, pcg_int high)
{
    pcg_int first = low < high ? low : high;
    pcg_u64 span = (pcg_u64)(low < high ? high : low) - (pcg_u64)first;
    pcg_u64 drawn = span == ~(pcg_u64)0 ? (pcg_u64)(pcg_random(call, site, 0) * 0x1p63) * 2
                                        : chance_below(call, site, span + 1);
    return (pcg_int)((pcg_u64)first + drawn);
}

int pcg_core_fn_rand_bool_ratio(pcg_call *call, pcg_u32 site, double probability)
{
    return pcg_random(call, site, 0) < probability;
}

/* ---- normal distributions -------------------------------------------------------------------- */

/* Box and Muller, "A note on the generation of random normal deviates", 1958. */
static double chance_normal(pcg_call *call, pcg_u32 site, double mean, double deviation)
{
    double drawn = 1 - pcg_random(call, site, 0); /* above 0: it has a logarithm */
    double radius = sqrt(-2 * real_log(drawn));
    return mean + deviation * radius * real_cos(360 * pcg_random(call, site, 1));
}

double pcg_core_fn_rand_normal_float_float(pcg_call *call, pcg_u32 site, double mean,
                                           double deviation)
{
    return chance_normal(call, site, mean, deviation);
}

double pcg_core_fn_rand_normal_length_length(pcg_call *call, pcg_u32 site, double mean,
                                             double deviation)
{
    return chance_normal(call, site, mean, deviation);
}

double pcg_core_fn_rand_normal_angle_angle(pcg_call *call, pcg_u32 site, double mean,
                                           double deviation)
{
    return chance_normal(call, site, mean, deviation);
}

/* ---- elements of lists ----------------------------------------------------------------------- */

/* NULL where there is none. */
static const pcg_cell *chance_element(pcg_call *call, pcg_u32 site, const pcg_list *values)
{
    if (values->count == 0) {
        pcg_warn(call, "'choose' from an empty list");
        return 0;
    }
    return &values->at[(size_t)chance_below(call, site, values->count) * values->width];
}

pcg_int pcg_core_fn_choose_list_int(pcg_call *call, pcg_u32 site, const pcg_list *values)
{
    const pcg_cell *cell = chance_element(call, site, values);
    return cell ? cell->i : 0;
}

double pcg_core_fn_choose_list_float(pcg_call *call, pcg_u32 site, const pcg_list *values)
{
    const pcg_cell *cell = chance_element(call, site, values);
    return cell ? cell->f : 0;
}

double pcg_core_fn_choose_list_length(pcg_call *call, pcg_u32 site, const pcg_list *values)
{
    const pcg_cell *cell = chance_element(call, site, values);
    return cell ? cell->f : 0;
}

const char *pcg_core_fn_choose_list_string(pcg_call *call, pcg_u32 site, const pcg_list *values)
{
    const pcg_cell *cell = chance_element(call, site, values);
    return cell ? cell->s : "";
}

void pcg_core_fn_choose_list_color(pcg_call *call, pcg_u32 site, const pcg_list *values,
                                   pcg_color *result)
{
    const pcg_cell *cell = chance_element(call, site, values);
    *result = cell ? (pcg_color){cell[0].f, cell[1].f, cell[2].f, cell[3].f}
                   : (pcg_color){0, 0, 0, 1};
}

/* ---- noise: gradients at whole coordinates, faded into each other (Perlin, "Improving noise", 2002) ---- */

/* A whole coordinate's bits: coordinates beyond all ints share theirs. */
static pcg_u64 chance_whole(double x)
{
    return x > -9.2e18 && x < 9.2e18 ? (pcg_u64)(pcg_int)x : 0;
}

static double chance_fade(double t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

static double chance_blend(double a, double b, double t)
{
    return a + (b - a) * chance_fade(t);
}

/* What the gradient at a whole point, drawn from its twelve or so directions, says at (x, y, z)
 * from it. */
static double chance_gradient(pcg_u64 hash, double x, double y, double z)
{
    double u = (hash & 15) < 8 ? x : y;
    double v = (hash & 15) < 4 ? y : (hash & 13) == 12 ? x : z;
    return ((hash & 1) ? -u : u) + ((hash & 2) ? -v : v);
}

static double chance_noise(double x, double y, double z)
{
    double left = floor(x), front = floor(y), low = floor(z);
    double at[3] = {x - left, y - front, z - low};
    double corner[8];
    if (!isfinite(x) || !isfinite(y) || !isfinite(z)) {
        return 0;
    }
    for (int i = 0; i < 8; i++) {
        int right = i & 1, back = i >> 1 & 1, high = i >> 2;
        pcg_u64 hash = pcg_mix(pcg_mix(chance_whole(left + right), chance_whole(front + back)),
                               chance_whole(low + high));
        corner[i] = chance_gradient(hash, at[0] - right, at[1] - back, at[2] - high);
    }
    double edge[4], side[2];
    for (int i = 0; i < 4; i++) {
        edge[i] = chance_blend(corner[2 * i], corner[2 * i + 1], at[0]);
    }
    for (int i = 0; i < 2; i++) {
        side[i] = chance_blend(edge[2 * i], edge[2 * i + 1], at[1]);
    }
    double value = chance_blend(side[0], side[1], at[2]);
    return value < -1 ? -1 : value > 1 ? 1 : value;
}

double pcg_core_fn_noise_float(pcg_call *call, double x)
{
    (void)call;
    return chance_noise(x, 0, 0);
}

double pcg_core_fn_noise_float_float(pcg_call *call, double x, double y)
{
    (void)call;
    return chance_noise(x, y, 0);
}

double pcg_core_fn_noise_float_float_float(pcg_call *call, double x, double y, double z)
{
    (void)call;
    return chance_noise(x, y, z);
}

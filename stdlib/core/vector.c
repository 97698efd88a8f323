/*pcg
/// A vector of two components.
function vec2(x: float, y: float) -> vec2 [pure] { example vec2(1, 2).y == 2.0 }
/// A vector of two lengths, in metres.
function vec2(x: length, y: length) -> vec2 [pure] { example vec2(1m, 50cm).y == 0.5 }
/// A vector of three components.
function vec3(x: float, y: float, z: float) -> vec3 [pure] { example vec3(1, 2, 3).z == 3.0 }
/// A vector of three lengths, in metres.
function vec3(x: length, y: length, z: length) -> vec3 [pure] {
    example vec3(1m, 2m, 50cm).z == 0.5
}
/// A vector of four components.
function vec4(x: float, y: float, z: float, w: float) -> vec4 [pure] {
    example vec4(1, 2, 3, 4).w == 4.0
}

/// The product that is 0 where the vectors are at right angles.
function dot(a: vec2, b: vec2) -> float [pure] { example dot(vec2(1, 2), vec2(3, 4)) == 11.0 }
/// The product that is 0 where the vectors are at right angles.
function dot(a: vec3, b: vec3) -> float [pure] { example dot(vec3(1, 2, 3), vec3(4, 5, 6)) == 32.0 }
/// The vector at right angles to both, right-handed, as long as their parallelogram is large.
function cross(a: vec3, b: vec3) -> vec3 [pure] {
    example cross(vec3(1, 0, 0), vec3(0, 1, 0)).z == 1.0
}
/// How long a vector is.
function length(v: vec2) -> float [pure] { example length(vec2(3, 4)) == 5.0 }
/// How long a vector is.
function length(v: vec3) -> float [pure] { example length(vec3(2, 3, 6)) == 7.0 }
/// The vector's direction, of length 1; that of a zero vector is the zero vector.
function normalize(v: vec2) -> vec2 [pure] { example normalize(vec2(0, -5)).y == -1.0 }
/// The vector's direction, of length 1; that of a zero vector is the zero vector.
function normalize(v: vec3) -> vec3 [pure] { example normalize(vec3(0, 0, 5)).z == 1.0 }
/// How far two points are from each other.
function distance(a: vec2, b: vec2) -> float [pure] {
    example distance(vec2(1, 1), vec2(4, 5)) == 5.0
}
/// How far two points are from each other.
function distance(a: vec3, b: vec3) -> float [pure] {
    example distance(vec3(1, 1, 1), vec3(3, 4, 7)) == 7.0
}
/// The vector on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: vec2, b: vec2, t: ratio) -> vec2 [pure] {
    example lerp(vec2(0, 0), vec2(4, 2), 0.5).x == 2.0
}
/// The vector on the way from `a` (at t = 0) to `b` (at t = 1), and beyond them.
function lerp(a: vec3, b: vec3, t: ratio) -> vec3 [pure] {
    example lerp(vec3(0, 0, 0), vec3(4, 2, 8), 0.25).z == 2.0
}
/// The angle between two directions, 0 to 180 degrees; 0 where one has no length.
function angle_between(a: vec3, b: vec3) -> angle [pure] {
    example angle_between(vec3(1, 0, 0), vec3(0, 2, 0)) == 90deg
}
*/
#include "vector.h"
#include "runtime/real.h"

/* ---- making ---------------------------------------------------------------------------------- */

void pcg_core_fn_vec2_float_float(pcg_call *call, double x, double y, pcg_vec2 *result)
{
    (void)call;
    *result = (pcg_vec2){x, y};
}

void pcg_core_fn_vec2_length_length(pcg_call *call, double x, double y, pcg_vec2 *result)
{
    (void)call;
    *result = (pcg_vec2){x, y};
}

void pcg_core_fn_vec3_float_float_float(pcg_call *call, double x, double y, double z,
                                        pcg_vec3 *result)
{
    (void)call;
    *result = (pcg_vec3){x, y, z};
}

void pcg_core_fn_vec3_length_length_length(pcg_call *call, double x, double y, double z,
                                           pcg_vec3 *result)
{
    (void)call;
    *result = (pcg_vec3){x, y, z};
}

void pcg_core_fn_vec4_float_float_float_float(pcg_call *call, double x, double y, double z,
                                              double w, pcg_vec4 *result)
{
    (void)call;
    *result = (pcg_vec4){x, y, z, w};
}

/* ---- products and lengths -------------------------------------------------------------------- */

static double vector_dot(const pcg_vec3 *a, const pcg_vec3 *b)
{
    return a->x * b->x + a->y * b->y + a->z * b->z;
}

/* In two steps, so that no square overflows. */
static double vector_length(double x, double y, double z)
{
    return real_hypot(real_hypot(x, y), z);
}

double pcg_core_fn_dot_vec2_vec2(pcg_call *call, const pcg_vec2 *a, const pcg_vec2 *b)
{
    (void)call;
    return a->x * b->x + a->y * b->y;
}

double pcg_core_fn_dot_vec3_vec3(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b)
{
    (void)call;
    return vector_dot(a, b);
}

static pcg_vec3 vector_cross(const pcg_vec3 *a, const pcg_vec3 *b)
{
    return (pcg_vec3){a->y * b->z - a->z * b->y, a->z * b->x - a->x * b->z,
                      a->x * b->y - a->y * b->x};
}

void pcg_core_fn_cross_vec3_vec3(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b,
                                 pcg_vec3 *result)
{
    (void)call;
    *result = vector_cross(a, b);
}

double pcg_core_fn_length_vec2(pcg_call *call, const pcg_vec2 *v)
{
    (void)call;
    return real_hypot(v->x, v->y);
}

double pcg_core_fn_length_vec3(pcg_call *call, const pcg_vec3 *v)
{
    (void)call;
    return vector_length(v->x, v->y, v->z);
}

void pcg_core_fn_normalize_vec2(pcg_call *call, const pcg_vec2 *v, pcg_vec2 *result)
{
    (void)call;
    double length = real_hypot(v->x, v->y);
    *result = length > 0 ? (pcg_vec2){v->x / length, v->y / length} : (pcg_vec2){0, 0};
}

void pcg_core_fn_normalize_vec3(pcg_call *call, const pcg_vec3 *v, pcg_vec3 *result)
{
    (void)call;
    double length = vector_length(v->x, v->y, v->z);
    *result = length > 0 ? (pcg_vec3){v->x / length, v->y / length, v->z / length}
                         : (pcg_vec3){0, 0, 0};
}

double pcg_core_fn_distance_vec2_vec2(pcg_call *call, const pcg_vec2 *a, const pcg_vec2 *b)
{
    (void)call;
    return real_hypot(b->x - a->x, b->y - a->y);
}

double pcg_core_fn_distance_vec3_vec3(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b)
{
    (void)call;
    return vector_length(b->x - a->x, b->y - a->y, b->z - a->z);
}

/* ---- between vectors ------------------------------------------------------------------------- */

static double vector_between(double a, double b, double t)
{
    return t == 1 ? b : a + (b - a) * t;
}

void pcg_core_fn_lerp_vec2_vec2_ratio(pcg_call *call, const pcg_vec2 *a, const pcg_vec2 *b,
                                      double t, pcg_vec2 *result)
{
    (void)call;
    *result = (pcg_vec2){vector_between(a->x, b->x, t), vector_between(a->y, b->y, t)};
}

void pcg_core_fn_lerp_vec3_vec3_ratio(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b,
                                      double t, pcg_vec3 *result)
{
    (void)call;
    *result = (pcg_vec3){vector_between(a->x, b->x, t), vector_between(a->y, b->y, t),
                         vector_between(a->z, b->z, t)};
}

double pcg_core_fn_angle_between_vec3_vec3(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b)
{
    (void)call;
    pcg_vec3 across = vector_cross(a, b);
    return real_atan2(vector_length(across.x, across.y, across.z), vector_dot(a, b));
}

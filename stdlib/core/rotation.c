/*pcg
/// The vector turned to the left by an angle.
function rotate(v: vec2, by: angle) -> vec2 [pure] { example rotate(vec2(1, 0), 90deg).y == 1.0 }
/// The vector turned about an axis, right-handed; a zero axis turns nothing.
function rotate(v: vec3, axis: vec3, by: angle) -> vec3 [pure] {
    example rotate(vec3(1, 0, 0), vec3(0, 0, 5), 90deg).y == 1.0
}
/// The vector turned by a rotation.
function rotate(v: vec3, by: quaternion) -> vec3 [pure] {
    example abs(rotate(vec3(1, 0, 0), quaternion(vec3(0, 0, 1), 90deg)).y - 1.0) < 0.000001
}
/// The rotation about an axis by an angle, right-handed; a zero axis gives the one that turns nothing.
function quaternion(axis: vec3, by: angle) -> quaternion [pure] {
    example quaternion(vec3(0, 0, 2), 180deg).z == 1.0
}
/// The vector that is thrown back by a plane with that normal, of any length.
function reflect(v: vec3, normal: vec3) -> vec3 [pure] {
    example reflect(vec3(1, 2, -3), vec3(0, 0, 2)).z == 3.0
}
/// The part of a vector that is along another one; the zero vector along a zero vector.
function project(v: vec3, onto: vec3) -> vec3 [pure] {
    example project(vec3(1, 2, 3), vec3(0, 5, 0)).y == 2.0
}
/// The direction of a vector, from that of x to the left, -180 to 180 degrees; 0 for the zero vector.
function direction(v: vec2) -> angle [pure] { example direction(vec2(0, 3)) == 90deg }
/// The smaller of each component.
function min(a: vec3, b: vec3) -> vec3 [pure] { example min(vec3(1, 5, 3), vec3(4, 2, 3)).y == 2.0 }
/// The larger of each component.
function max(a: vec3, b: vec3) -> vec3 [pure] { example max(vec3(1, 5, 3), vec3(4, 2, 3)).x == 4.0 }
*/
#include "rotation.h"
#include <math.h>
#include "runtime/real.h"
#include "runtime/shape.h"

/* Of length 1; the zero vector where it has no direction. */
static pcg_vec3 rotation_unit(const pcg_vec3 *v)
{
    double length = real_hypot(real_hypot(v->x, v->y), v->z);
    return length > 0 ? vec3(v->x / length, v->y / length, v->z / length) : vec3(0, 0, 0);
}

void pcg_core_fn_rotate_vec2_angle(pcg_call *call, const pcg_vec2 *v, double by, pcg_vec2 *result)
{
    (void)call;
    double s = real_sin(by), c = real_cos(by);
    *result = (pcg_vec2){v->x * c - v->y * s, v->x * s + v->y * c};
}

void pcg_core_fn_rotate_vec3_vec3_angle(pcg_call *call, const pcg_vec3 *v, const pcg_vec3 *axis,
                                        double by, pcg_vec3 *result)
{
    (void)call;
    double s = real_sin(by), c = real_cos(by);
    pcg_vec3 u = rotation_unit(axis);
    if (!(vec3_dot(u, u) > 0)) {
        *result = *v;
        return;
    }
    pcg_vec3 along = vec3_scale(u, vec3_dot(u, *v) * (1 - c));
    *result = vec3_add(vec3_add(vec3_scale(*v, c), vec3_scale(vec3_cross(u, *v), s)), along);
}

void pcg_core_fn_rotate_vec3_quaternion(pcg_call *call, const pcg_vec3 *v, const pcg_vec4 *by,
                                        pcg_vec3 *result)
{
    (void)call;
    pcg_vec3 q = vec3(by->x, by->y, by->z);
    pcg_vec3 twice = vec3_scale(vec3_cross(q, *v), 2);
    *result = vec3_add(vec3_add(*v, vec3_scale(twice, by->w)), vec3_cross(q, twice));
}

void pcg_core_fn_quaternion_vec3_angle(pcg_call *call, const pcg_vec3 *axis, double by,
                                       pcg_vec4 *result)
{
    (void)call;
    pcg_vec3 u = rotation_unit(axis);
    double s = real_sin(by / 2);
    int turns = vec3_dot(u, u) > 0;
    *result =
        turns ? (pcg_vec4){u.x * s, u.y * s, u.z * s, real_cos(by / 2)} : (pcg_vec4){0, 0, 0, 1};
}

void pcg_core_fn_project_vec3_vec3(pcg_call *call, const pcg_vec3 *v, const pcg_vec3 *onto,
                                   pcg_vec3 *result)
{
    (void)call;
    pcg_vec3 u = rotation_unit(onto);
    *result = vec3_scale(u, vec3_dot(u, *v));
}

void pcg_core_fn_reflect_vec3_vec3(pcg_call *call, const pcg_vec3 *v, const pcg_vec3 *normal,
                                   pcg_vec3 *result)
{
    (void)call;
    pcg_vec3 u = rotation_unit(normal);
    *result = vec3_subtract(*v, vec3_scale(u, 2 * vec3_dot(u, *v)));
}

double pcg_core_fn_direction_vec2(pcg_call *call, const pcg_vec2 *v)
{
    (void)call;
    return real_atan2(v->y, v->x);
}

void pcg_core_fn_min_vec3_vec3(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b,
                               pcg_vec3 *result)
{
    (void)call;
    *result = vec3(a->x < b->x ? a->x : b->x, a->y < b->y ? a->y : b->y, a->z < b->z ? a->z : b->z);
}

void pcg_core_fn_max_vec3_vec3(pcg_call *call, const pcg_vec3 *a, const pcg_vec3 *b,
                               pcg_vec3 *result)
{
    (void)call;
    *result = vec3(a->x > b->x ? a->x : b->x, a->y > b->y ? a->y : b->y, a->z > b->z ? a->z : b->z);
}

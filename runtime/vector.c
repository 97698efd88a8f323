/* vector.c - vectors, and points between a scope and the world. */
#include <float.h>
#include <math.h>

#include "runtime/real.h"
#include "runtime/shape.h"

double vec3_length(pcg_vec3 a)
{
    double square = vec3_dot(a, a);

    /* hypot avoids what the plain form cannot: squares that overflow or vanish. */
    if (square < DBL_MIN || !isfinite(square))
        return real_hypot(real_hypot(a.x, a.y), a.z);
    return sqrt(square);
}

pcg_vec3 vec3_normal(pcg_vec3 a)
{
    double length = vec3_length(a);

    if (!(length > 0) || !isfinite(length))
        return vec3(0, 0, 0);
    if (length < DBL_MIN) { /* its inverse would overflow */
        a = vec3_scale(a, 1 / DBL_EPSILON / DBL_EPSILON);
        length = vec3_length(a);
    }
    return vec3(a.x / length, a.y / length, a.z / length);
}

pcg_vec3 pcg_scope_direction(const pcg_scope *s, pcg_vec3 d)
{
    return vec3(s->axis[0].x * d.x + s->axis[1].x * d.y + s->axis[2].x * d.z,
                s->axis[0].y * d.x + s->axis[1].y * d.y + s->axis[2].y * d.z,
                s->axis[0].z * d.x + s->axis[1].z * d.y + s->axis[2].z * d.z);
}

pcg_vec3 pcg_scope_point(const pcg_scope *s, pcg_vec3 p)
{
    return vec3_add(s->origin, pcg_scope_direction(s, p));
}

pcg_vec3 pcg_scope_local(const pcg_scope *s, pcg_vec3 world)
{
    pcg_vec3 d = vec3_subtract(world, s->origin);

    return vec3(vec3_dot(d, s->axis[0]), vec3_dot(d, s->axis[1]), vec3_dot(d, s->axis[2]));
}

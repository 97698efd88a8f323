/* closest.c - where two triangles, edges or vertices are nearest to each other.
 *
 * That is between two of their edges, between a corner of one and the inside of the other, or where
 * an edge of one goes through the other. Triangles and edges may be without area or length.
 */
#include <math.h>

#include "nearby.h"

/* The nearest pair so far. */
typedef struct pair {
    pcg_vec3 a, b;
    double square;
} pair;

static void consider(pair *best, pcg_vec3 a, pcg_vec3 b)
{
    pcg_vec3 d = vec3_subtract(a, b);
    double square = vec3_dot(d, d);

    if (square < best->square)
        *best = (pair){a, b, square};
}

static double clamped(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0; /* 0 for what is no number */
}

/* Between the edges from p to q and from r to s. */
static void consider_edges(pair *best, pcg_vec3 p, pcg_vec3 q, pcg_vec3 r, pcg_vec3 s)
{
    pcg_vec3 u = vec3_subtract(q, p), v = vec3_subtract(s, r), w = vec3_subtract(p, r);
    double a = vec3_dot(u, u), b = vec3_dot(u, v), c = vec3_dot(v, v);
    double d = vec3_dot(u, w), e = vec3_dot(v, w), across = a * c - b * b;
    double along_u = across > 1e-12 * a * c ? clamped((b * e - c * d) / across) : 0, along_v = 0;

    if (c > 0)
        along_v = clamped((b * along_u + e) / c);
    if (a > 0)
        along_u = clamped((b * along_v - d) / a);
    consider(best, vec3_add(p, vec3_scale(u, along_u)), vec3_add(r, vec3_scale(v, along_v)));
}

/* Whether a point lies over the inside of a triangle with the given normal, which is not 0. */
static bool is_over(const nearby_part *t, pcg_vec3 normal, pcg_vec3 p)
{
    for (uint32_t i = 0; i < 3; i++) {
        pcg_vec3 edge = vec3_subtract(t->corner[(i + 1) % 3], t->corner[i]);

        if (!(vec3_dot(vec3_cross(edge, vec3_subtract(p, t->corner[i])), normal) >= 0))
            return false;
    }
    return true;
}

static pcg_vec3 triangle_normal(const nearby_part *t)
{
    return vec3_cross(vec3_subtract(t->corner[1], t->corner[0]),
                      vec3_subtract(t->corner[2], t->corner[0]));
}

/* Between the corners of `other` and the inside of the triangle `t`, and where an edge of `other`
 * goes through it. `swapped`: `t` is the second of the pair. */
static void consider_inside(pair *best, const nearby_part *t, const nearby_part *other,
                            bool swapped)
{
    pcg_vec3 normal = triangle_normal(t);
    double square = vec3_dot(normal, normal), height[3];

    if (!(square > 0))
        return;
    for (uint32_t i = 0; i < other->corners; i++) {
        pcg_vec3 p = other->corner[i], foot;

        height[i] = vec3_dot(vec3_subtract(p, t->corner[0]), normal);
        foot = vec3_subtract(p, vec3_scale(normal, height[i] / square));
        if (is_over(t, normal, p))
            consider(best, swapped ? p : foot, swapped ? foot : p);
    }
    for (uint32_t i = 0; i < other->corners && other->corners > 1; i++) {
        uint32_t next = (i + 1) % other->corners;
        pcg_vec3 from = other->corner[i], way = vec3_subtract(other->corner[next], from), at;

        if ((height[i] > 0) == (height[next] > 0))
            continue;
        at = vec3_add(from, vec3_scale(way, height[i] / (height[i] - height[next])));
        if (is_over(t, normal, at))
            consider(best, at, at);
    }
}

static uint32_t edges_of(const nearby_part *p)
{
    return p->corners == 3 ? 3 : 1;
}

double nearby_closest(const nearby_part *a, const nearby_part *b, pcg_vec3 *on_a, pcg_vec3 *on_b)
{
    pair best = {a->corner[0], b->corner[0], INFINITY};

    for (uint32_t i = 0; i < edges_of(a); i++)
        for (uint32_t j = 0; j < edges_of(b); j++)
            consider_edges(&best, a->corner[i], a->corner[(i + 1) % 3], b->corner[j],
                           b->corner[(j + 1) % 3]);
    if (a->corners == 3)
        consider_inside(&best, a, b, false);
    if (b->corners == 3)
        consider_inside(&best, b, a, true);
    *on_a = best.a;
    *on_b = best.b;
    return best.square;
}

/* orientation.c - the orientation predicate: a filter that decides nearly always, exact sums for
 * the rest. */
#include <math.h>
#include <stdint.h>

#include "runtime/orientation.h"

/* A sum of doubles that do not overlap, smallest first: its sign is that of the last one that is
 * not 0. */
typedef struct expansion {
    double part[12];
    uint32_t count;
} expansion;

static void add_exactly(expansion *e, double b)
{
    for (uint32_t i = 0; i < e->count; i++) {
        double sum = b + e->part[i];
        double virtual_part = sum - b;

        e->part[i] = (b - (sum - virtual_part)) + (e->part[i] - virtual_part);
        b = sum;
    }
    e->part[e->count++] = b;
}

static void add_product(expansion *e, double a, double b)
{
    double product = a * b;

    add_exactly(e, fma(a, b, -product));
    add_exactly(e, product);
}

double orientation_exactly(pcg_vec2 a, pcg_vec2 b, pcg_vec2 c)
{
    expansion e = {.count = 0};

    add_product(&e, a.x, b.y);
    add_product(&e, -a.x, c.y);
    add_product(&e, -c.x, b.y);
    add_product(&e, -a.y, b.x);
    add_product(&e, a.y, c.x);
    add_product(&e, c.y, b.x);
    while (e.count > 1 && e.part[e.count - 1] == 0)
        e.count--;
    return isfinite(e.part[e.count - 1]) ? e.part[e.count - 1] : 0;
}

double orientation(pcg_vec2 a, pcg_vec2 b, pcg_vec2 c)
{
    double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    double area = left - right;

    /* (3 + 16 u) u, where u is the unit roundoff 2^-53 */
    if (fabs(area) > 3.3306690738754716e-16 * (fabs(left) + fabs(right)))
        return area;
    return left == 0 && right == 0 ? 0 : orientation_exactly(a, b, c);
}

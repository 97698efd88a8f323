/* fruit_tree.c - the tree of fruit_tree.pcg by a function that calls itself: every branch a prism
 * of six sides, three of the next level on its top, a box at each tip. The corners of all faces go
 * into one array.
 *
 *     fruit_tree LEVELS
 */
#include <math.h>

#include "rival.h"

enum { SIDES = 6, FORKS = 3, FRUIT_FACES = 6 };

typedef struct vector {
    double x, y, z;
} vector;

/* Where a branch begins, and the axes of its foot: x and y across, z along. */
typedef struct frame {
    vector at, x, y, z;
    double radius;
} frame;

typedef struct tree {
    vector *corners;
    uint64_t corner_count, faces;
    unsigned levels;
} tree;

static vector along(vector from, vector by, double amount)
{
    return (vector){from.x + amount * by.x, from.y + amount * by.y, from.z + amount * by.z};
}

static void put_quad(tree *t, vector a, vector b, vector c, vector d)
{
    vector *to = t->corners + t->corner_count;
    to[0] = a;
    to[1] = b;
    to[2] = c;
    to[3] = d;
    t->corner_count += 4;
    t->faces++;
}

static void put_fruit(tree *t, vector middle)
{
    const double h = 0.125;
    vector at[8];
    for (int i = 0; i < 8; i++)
        at[i] = (vector){middle.x + (i & 1 ? h : -h), middle.y + (i & 2 ? h : -h),
                         middle.z + (i & 4 ? h : -h)};
    put_quad(t, at[0], at[2], at[3], at[1]);
    put_quad(t, at[4], at[5], at[7], at[6]);
    put_quad(t, at[0], at[1], at[5], at[4]);
    put_quad(t, at[2], at[6], at[7], at[3]);
    put_quad(t, at[0], at[4], at[6], at[2]);
    put_quad(t, at[1], at[3], at[7], at[5]);
}

/* Turns two axes towards each other by an angle of which sine and cosine are given. */
static void turn(vector *a, vector *b, double sine, double cosine)
{
    const vector p = *a, q = *b;
    *a = along((vector){cosine * p.x, cosine * p.y, cosine * p.z}, q, sine);
    *b = along((vector){cosine * q.x, cosine * q.y, cosine * q.z}, p, -sine);
}

static void put_prism(tree *t, const frame *f, double length)
{
    vector foot[SIDES], head[SIDES];
    for (int i = 0; i < SIDES; i++) {
        const double angle = i * acos(-1.0) / 3;
        foot[i] = along(along(f->at, f->x, f->radius * cos(angle)), f->y, f->radius * sin(angle));
        head[i] = along(foot[i], f->z, length);
    }
    for (int i = 0; i < SIDES; i++)
        put_quad(t, foot[i], foot[(i + 1) % SIDES], head[(i + 1) % SIDES], head[i]);
}

static void grow(tree *t, frame f, unsigned level)
{
    const double degree = acos(-1.0) / 180, length = 2 * pow(0.75, level);
    put_prism(t, &f, length);
    f.at = along(f.at, f.z, length);
    if (level + 1 >= t->levels) {
        put_fruit(t, f.at);
        return;
    }
    f.radius *= 0.7;
    for (int way = 0; way < FORKS; way++) {
        frame next = f;
        const double about_x = 30 * degree * cos(way * 120 * degree);
        const double about_y = 30 * degree * sin(way * 120 * degree);
        turn(&next.y, &next.z, sin(about_x), cos(about_x));
        turn(&next.z, &next.x, sin(about_y), cos(about_y));
        grow(t, next, level + 1);
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: fruit_tree LEVELS\n", stderr);
        return 2;
    }
    tree t = {.levels = (unsigned)rival_number(argv[1], 14)};
    uint64_t branches = 0, tips = 1;
    for (unsigned i = 0; i < t.levels; i++) {
        branches += tips;
        tips *= i + 1 < t.levels ? FORKS : 1;
    }
    const frame trunk = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.2};
    t.corners = rival_array(4 * (branches * SIDES + tips * FRUIT_FACES), sizeof(vector));
    rival r = {0};
    rival_begin(&r);
    grow(&t, trunk, 0);
    rival_end(&r, "grow");
    rival_print(&r, "faces", t.faces);
    free(t.corners);
    return 0;
}

/* triangulate.c - polygons with holes into triangles, by clipping ears.
 *
 * The face is looked at along the axis nearest to its normal, which changes no coordinate.
 * Triangles and convex polygons go straight through. For the rest, holes are bridged into one ring,
 * and ears are cut off it: a corner is an ear when it turns left and no corner that does not turn
 * left lies in its triangle. Those are kept in a grid, so that an ear costs about as much in a
 * polygon of a hundred thousand corners as in one of ten. Where no ear is left (the polygon is
 * degenerate, or crosses itself), conditions are relaxed step by step until the ring is gone.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/mesh.h"
#include "runtime/triangulate.h"

enum {
    GRID_MIN = 64,         /* blockers that are worth a grid */
    GRID_MAX = 1024,       /* cells across */
    PATIENCE = 6,          /* times around the ring that may be spent on being stuck … */
    PATIENCE_LEAST = 10000 /* … and nodes, whatever its length */
};

/* How strict the test for an ear is; each takes what the one before takes. */
typedef enum strictness {
    STRICT,      /* nothing in the triangle or on its border */
    FLAT_TOO,    /* corners without area are dropped as well */
    BORDER_FREE, /* what is on the border does not count */
    ANY_LEFT,    /* whatever turns left */
    ANY          /* whatever is left; what turns right leaves no triangle */
} strictness;

/* ---- memory ---------------------------------------------------------------------------------- */

bool triangulator_reserve(void **at, uint32_t *capacity, size_t count, size_t size)
{
    size_t next = (size_t)*capacity * 2;
    void *moved;

    if (count <= *capacity)
        return true;
    next = next < count ? count : next;
    next = next < 64 ? 64 : next;
    if (next >= UINT32_MAX || next > SIZE_MAX / size || (moved = realloc(*at, next * size)) == NULL)
        return false;
    *at = moved;
    *capacity = (uint32_t)next;
    return true;
}

pcg_triangulator *pcg_triangulator_new(void)
{
    return calloc(1, sizeof(pcg_triangulator));
}

void pcg_triangulator_free(pcg_triangulator *t)
{
    if (t == NULL)
        return;
    free(t->nodes);
    free(t->queue);
    free(t->cell);
    free(t->hole);
    free(t->rows.entry);
    free(t->rows.row);
    free(t);
}

uint32_t triangulator_twin(pcg_triangulator *t, uint32_t of)
{
    node *twin = &t->nodes[t->node_count];

    *twin = t->nodes[of];
    twin->cell = NONE;
    return t->node_count++;
}

/* ---- rings ----------------------------------------------------------------------------------- */

static pcg_vec2 flattened(pcg_vec3 p, pcg_vec3 normal)
{
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    pcg_vec2 a = z >= x && z >= y ? (pcg_vec2){p.x, p.y}
                 : x >= y         ? (pcg_vec2){p.y, p.z}
                                  : (pcg_vec2){p.z, p.x};
    double along = z >= x && z >= y ? normal.z : x >= y ? normal.x : normal.y;

    return along >= 0 ? a : (pcg_vec2){a.y, a.x};
}

static double ring_area(const pcg_triangulator *t, uint32_t from, uint32_t to)
{
    pcg_vec2 about = t->nodes[from].at;
    double sum = 0;

    for (uint32_t i = from, j = to - 1; i < to; j = i++) {
        pcg_vec2 a = t->nodes[j].at, b = t->nodes[i].at;

        sum += (a.x - about.x) * (b.y - about.y) - (a.y - about.y) * (b.x - about.x);
    }
    return sum;
}

/* Links nodes from..to-1 into a ring that turns left, or right; of nodes in one place in turn, one
 * stays. Returns how many did; the first is among them. */
static uint32_t link_ring(pcg_triangulator *t, uint32_t from, uint32_t to, bool left)
{
    bool forward = (ring_area(t, from, to) >= 0) == left;
    uint32_t last = from, count = 1;

    for (uint32_t i = 1; i < to - from; i++) {
        uint32_t n = forward ? from + i : to - i;

        if (same_place(&t->nodes[n], &t->nodes[last]))
            continue;
        t->nodes[last].after = n;
        t->nodes[n].before = last;
        last = n;
        count++;
    }
    if (count > 1 && same_place(&t->nodes[from], &t->nodes[last])) {
        last = t->nodes[last].before;
        count--;
    }
    t->nodes[last].after = from;
    t->nodes[from].before = last;
    return count;
}

static uint32_t leftmost(const pcg_triangulator *t, uint32_t start)
{
    uint32_t best = start;

    for (uint32_t n = t->nodes[start].after; n != start; n = t->nodes[n].after) {
        pcg_vec2 a = t->nodes[n].at, b = t->nodes[best].at;

        if (a.x < b.x || (a.x == b.x && a.y < b.y))
            best = n;
    }
    return best;
}

/* Newell's normal of an outline. */
static pcg_vec3 outline_normal(const pcg_mesh *m, uint32_t first, uint32_t end, pcg_vec3 scale)
{
    pcg_vec3 sum = vec3(0, 0, 0), about = m->position[m->corner_vertex[first]], before, here;

    before = vec3_multiply(vec3_subtract(m->position[m->corner_vertex[end - 1]], about), scale);
    for (uint32_t i = first; i < end; i++, before = here) {
        here = vec3_multiply(vec3_subtract(m->position[m->corner_vertex[i]], about), scale);
        sum = vec3_add(sum, vec3_cross(before, here));
    }
    return sum;
}

/* Makes the nodes of a face, one ring a loop; false: no memory, or it has no area. */
static bool load(pcg_triangulator *t, const pcg_mesh *m, uint32_t face, pcg_vec3 scale)
{
    uint32_t first_loop = m->face_loop[face], last_loop = m->face_loop[face + 1];
    uint32_t first = face_first_corner(m, face), corners = face_last_corner(m, face) - first;
    pcg_vec3 normal = outline_normal(m, first, m->loop_corner[first_loop + 1], scale);

    t->node_count = t->hole_count = 0;
    if (!(vec3_dot(normal, normal) > 0) ||
        !triangulator_reserve((void **)&t->nodes, &t->node_capacity,
                              (size_t)corners + 2 * (size_t)(last_loop - first_loop),
                              sizeof *t->nodes) ||
        !triangulator_reserve((void **)&t->hole, &t->hole_capacity, last_loop - first_loop,
                              sizeof *t->hole))
        return false;
    for (uint32_t i = first; i < first + corners; i++) {
        pcg_vec3 p = vec3_multiply(m->position[m->corner_vertex[i]], scale);

        t->nodes[t->node_count++] = (node){.at = flattened(p, normal), .corner = i, .cell = NONE};
    }
    for (uint32_t l = first_loop; l < last_loop; l++) {
        uint32_t from = m->loop_corner[l] - first, to = m->loop_corner[l + 1] - first;
        bool area = to - from >= 3 && link_ring(t, from, to, l == first_loop) >= 3;

        if (l == first_loop && !area)
            return false;
        if (l > first_loop && area)
            t->hole[t->hole_count++] = leftmost(t, from);
    }
    return true;
}

/* ---- what goes straight through -------------------------------------------------------------- */

static uint32_t put(uint32_t *out, uint32_t count, uint32_t a, uint32_t b, uint32_t c)
{
    out[3 * (size_t)count] = a;
    out[3 * (size_t)count + 1] = b;
    out[3 * (size_t)count + 2] = c;
    return count + 1;
}

static double turn(const pcg_triangulator *t, uint32_t a, uint32_t b, uint32_t c)
{
    return orientation(t->nodes[a].at, t->nodes[b].at, t->nodes[c].at);
}

/* Whether every corner of an outline turns left, and it goes around once: x changes its direction
 * twice. */
static bool is_convex(const pcg_triangulator *t)
{
    const node *n = t->nodes;
    uint32_t changes = 0, i = 0;
    int direction = 0, first_direction = 0;

    do {
        double step = n[n[i].after].at.x - n[i].at.x;
        int sign = (step > 0) - (step < 0);

        if (!(turn(t, n[i].before, i, n[i].after) > 0))
            return false;
        if (sign != 0) {
            changes += direction != 0 && sign != direction;
            direction = sign;
            first_direction = first_direction == 0 ? sign : first_direction;
        }
        i = n[i].after;
    } while (i != 0);
    return changes + (direction != first_direction) <= 2;
}

static uint32_t fan(const pcg_triangulator *t, uint32_t *out)
{
    const node *n = t->nodes;
    uint32_t triangles = 0;

    for (uint32_t b = n[0].after, c = n[b].after; c != 0; b = c, c = n[c].after)
        triangles = put(out, triangles, n[0].corner, n[b].corner, n[c].corner);
    return triangles;
}

/* Whether the triangle a b c turns clearly the way of `normal`, whose square is given. */
static bool turns_with(pcg_vec3 a, pcg_vec3 b, pcg_vec3 c, pcg_vec3 normal, double square)
{
    return vec3_dot(vec3_cross(vec3_subtract(b, a), vec3_subtract(c, b)), normal) > 1e-9 * square;
}

/* A quad that is clearly convex: cut along its shorter diagonal. */
static bool cut_quad(const pcg_mesh *m, uint32_t first, pcg_vec3 scale, uint32_t *out)
{
    pcg_vec3 p[4], across, back, normal;
    double square;
    uint32_t apex;

    for (uint32_t i = 0; i < 4; i++)
        p[i] = vec3_multiply(m->position[m->corner_vertex[first + i]], scale);
    across = vec3_subtract(p[2], p[0]);
    back = vec3_subtract(p[3], p[1]);
    normal = vec3_cross(across, back);
    square = vec3_dot(normal, normal);
    for (uint32_t i = 0; i < 4; i++)
        if (!turns_with(p[i], p[(i + 1) % 4], p[(i + 2) % 4], normal, square))
            return false;
    apex = first + (vec3_dot(back, back) < vec3_dot(across, across));
    put(out, 0, apex, apex + 1, apex + 2);
    put(out, 1, apex, apex + 2, apex == first ? first + 3 : first);
    return true;
}

/* ---- blockers -------------------------------------------------------------------------------- */

static uint32_t cell_at(double at, double low, double scale, uint32_t count)
{
    double cell = (at - low) * scale;

    if (!(cell > 0))
        return 0;
    return cell < count ? (uint32_t)cell : count - 1;
}

static void blockers_add(pcg_triangulator *t, uint32_t n)
{
    node *v = &t->nodes[n];

    v->cell = cell_at(v->at.y, t->low.y, t->scale.y, t->down) * t->across +
              cell_at(v->at.x, t->low.x, t->scale.x, t->across);
    v->cell_before = NONE;
    v->cell_after = t->cell[v->cell];
    if (v->cell_after != NONE)
        t->nodes[v->cell_after].cell_before = n;
    t->cell[v->cell] = n;
}

static void blockers_remove(pcg_triangulator *t, uint32_t n)
{
    node *v = &t->nodes[n];

    if (v->cell == NONE)
        return;
    if (v->cell_before != NONE)
        t->nodes[v->cell_before].cell_after = v->cell_after;
    else
        t->cell[v->cell] = v->cell_after;
    if (v->cell_after != NONE)
        t->nodes[v->cell_after].cell_before = v->cell_before;
    v->cell = NONE;
}

/* A node is a blocker while it does not turn left. */
static void blockers_update(pcg_triangulator *t, uint32_t n)
{
    bool blocks = turn(t, t->nodes[n].before, n, t->nodes[n].after) <= 0;

    if (blocks && t->nodes[n].cell == NONE)
        blockers_add(t, n);
    else if (!blocks)
        blockers_remove(t, n);
}

static void measure_ring(pcg_triangulator *t, uint32_t start, uint32_t *blockers, pcg_vec2 *high)
{
    uint32_t n = start;

    *blockers = 0;
    t->low = *high = t->nodes[start].at;
    do {
        const node *v = &t->nodes[n];

        *blockers += turn(t, v->before, n, v->after) <= 0;
        t->low.x = fmin(t->low.x, v->at.x);
        t->low.y = fmin(t->low.y, v->at.y);
        high->x = fmax(high->x, v->at.x);
        high->y = fmax(high->y, v->at.y);
        n = v->after;
    } while (n != start);
}

/* Lays the grid over the ring and puts its blockers in. */
static bool blockers_open(pcg_triangulator *t, uint32_t start)
{
    uint32_t blockers, n = start, side;
    pcg_vec2 high;

    measure_ring(t, start, &blockers, &high);
    side = blockers < GRID_MIN ? 1 : (uint32_t)sqrt(blockers);
    t->across = t->down = side < GRID_MAX ? side : GRID_MAX;
    t->scale.x = high.x > t->low.x ? t->across / (high.x - t->low.x) : 0;
    t->scale.y = high.y > t->low.y ? t->down / (high.y - t->low.y) : 0;
    if (!triangulator_reserve((void **)&t->cell, &t->cell_capacity, (size_t)t->across * t->down,
                              sizeof *t->cell))
        return false;
    for (uint32_t i = 0; i < t->across * t->down; i++)
        t->cell[i] = NONE;
    do {
        blockers_update(t, n);
        n = t->nodes[n].after;
    } while (n != start);
    return true;
}

/* ---- ears ------------------------------------------------------------------------------------ */

typedef struct ear {
    uint32_t before, tip, after;
    pcg_vec2 a, b, c;
    strictness how;
} ear;

/* A node in the place of the tip is in the way when one of its edges goes into the triangle. */
static bool enters_at_tip(const pcg_triangulator *t, const ear *e, const node *v)
{
    pcg_vec2 p = t->nodes[v->before].at, q = t->nodes[v->after].at;

    return (orientation(e->a, e->b, p) > 0 && orientation(e->b, e->c, p) > 0) ||
           (orientation(e->a, e->b, q) > 0 && orientation(e->b, e->c, q) > 0);
}

static bool is_in_the_way(const pcg_triangulator *t, const ear *e, uint32_t n)
{
    const node *v = &t->nodes[n];
    double ab, bc, ca;

    if (n == e->before || n == e->tip || n == e->after ||
        (v->at.x == e->a.x && v->at.y == e->a.y) || (v->at.x == e->c.x && v->at.y == e->c.y))
        return false;
    if (v->at.x == e->b.x && v->at.y == e->b.y)
        return enters_at_tip(t, e, v);
    if ((ab = orientation(e->a, e->b, v->at)) < 0 || (bc = orientation(e->b, e->c, v->at)) < 0 ||
        (ca = orientation(e->c, e->a, v->at)) < 0)
        return false;
    return e->how < BORDER_FREE || (ab > 0 && bc > 0 && ca > 0);
}

static double least(double a, double b, double c)
{
    double m = a < b ? a : b;

    return m < c ? m : c;
}

static double most(double a, double b, double c)
{
    double m = a > b ? a : b;

    return m > c ? m : c;
}

static bool is_blocked(const pcg_triangulator *t, const ear *e)
{
    uint32_t left = cell_at(least(e->a.x, e->b.x, e->c.x), t->low.x, t->scale.x, t->across);
    uint32_t right = cell_at(most(e->a.x, e->b.x, e->c.x), t->low.x, t->scale.x, t->across);
    uint32_t bottom = cell_at(least(e->a.y, e->b.y, e->c.y), t->low.y, t->scale.y, t->down);
    uint32_t top = cell_at(most(e->a.y, e->b.y, e->c.y), t->low.y, t->scale.y, t->down);

    for (uint32_t row = bottom; row <= top; row++)
        for (uint32_t column = left; column <= right; column++)
            for (uint32_t n = t->cell[row * t->across + column]; n != NONE;
                 n = t->nodes[n].cell_after)
                if (is_in_the_way(t, e, n))
                    return true;
    return false;
}

/* Whether a node can be cut off; `area` is then twice its triangle's. */
static bool is_ear(const pcg_triangulator *t, uint32_t n, strictness how, double *area)
{
    const node *v = &t->nodes[n];
    ear e = {v->before, n, v->after, t->nodes[v->before].at, v->at, t->nodes[v->after].at, how};

    *area = orientation(e.a, e.b, e.c);
    if (*area == 0)
        return how >= FLAT_TOO;
    if (*area < 0)
        return how == ANY;
    return how >= ANY_LEFT || !is_blocked(t, &e);
}

static void queue_add(pcg_triangulator *t, uint32_t n)
{
    uint32_t at = t->queue_head + t->queue_count;

    if (t->nodes[n].waiting)
        return;
    t->nodes[n].waiting = true;
    t->queue[at < t->queue_capacity ? at : at - t->queue_capacity] = n;
    t->queue_count++;
}

static uint32_t queue_take(pcg_triangulator *t)
{
    uint32_t n = t->queue[t->queue_head];

    t->queue_head = t->queue_head + 1 == t->queue_capacity ? 0 : t->queue_head + 1;
    t->queue_count--;
    t->nodes[n].waiting = false;
    return n;
}

static void queue_ring(pcg_triangulator *t, uint32_t start)
{
    uint32_t n = start;

    do {
        queue_add(t, n);
        n = t->nodes[n].after;
    } while (n != start);
}

/* Takes a node out of its ring; its neighbours may be ears now. */
static void cut(pcg_triangulator *t, uint32_t n)
{
    node *v = &t->nodes[n];

    blockers_remove(t, n);
    v->gone = true;
    t->nodes[v->before].after = v->after;
    t->nodes[v->after].before = v->before;
    blockers_update(t, v->before);
    blockers_update(t, v->after);
    queue_add(t, v->before);
    queue_add(t, v->after);
}

/* The ring that is being cut up. */
typedef struct work {
    uint32_t left; /* nodes in it */
    uint32_t some; /* one of them */
    uint32_t triangles;
    uint32_t *out;
} work;

/* Cuts off what can be cut off until nothing in the queue can; true when something was. */
static bool cut_ears(pcg_triangulator *t, work *w, strictness how, bool hurry)
{
    bool any = false;

    while (t->queue_count > 0 && w->left > 2) {
        uint32_t n = queue_take(t);
        const node *v = &t->nodes[n];
        double area;

        if (v->gone || !is_ear(t, n, how, &area))
            continue;
        if (area > 0)
            w->triangles = put(w->out, w->triangles, t->nodes[v->before].corner, v->corner,
                               t->nodes[v->after].corner);
        w->some = v->before;
        w->left--;
        cut(t, n);
        any = true;
        if (how == BORDER_FREE || (how == ANY_LEFT && !hurry))
            break; /* one at a time: it may have made stricter ears */
    }
    return any;
}

static uint32_t count_ring(const pcg_triangulator *t, uint32_t start)
{
    uint32_t count = 0, n = start;

    do {
        count++;
        n = t->nodes[n].after;
    } while (n != start);
    return count;
}

static uint32_t cut_up(pcg_triangulator *t, uint32_t start, uint32_t *out)
{
    work w = {count_ring(t, start), start, 0, out};
    uint64_t patience = (uint64_t)w.left * PATIENCE + PATIENCE_LEAST;
    strictness how = STRICT;
    bool hurry = false;

    t->queue_head = t->queue_count = 0;
    if (!triangulator_reserve((void **)&t->queue, &t->queue_capacity, t->node_count,
                              sizeof *t->queue) ||
        !blockers_open(t, start))
        return 0;
    while (w.left > 2) {
        queue_ring(t, w.some);
        if (cut_ears(t, &w, how, hurry)) {
            how = hurry ? ANY_LEFT : STRICT;
        } else {
            hurry = hurry || patience < w.left;
            patience -= hurry ? 0 : w.left;
            how = hurry && how < ANY_LEFT ? ANY_LEFT : how + 1;
        }
    }
    return w.triangles;
}

uint32_t pcg_triangulate(pcg_triangulator *t, const pcg_mesh *m, uint32_t face,
                         const pcg_vec3 *size, uint32_t *out)
{
    uint32_t loops = m->face_loop[face + 1] - m->face_loop[face], outline;
    pcg_vec3 scale = size != NULL && m->unit ? *size : vec3(1, 1, 1);

    if (loops == 0)
        return 0;
    outline = m->loop_corner[m->face_loop[face] + 1] - face_first_corner(m, face);
    if (loops == 1 && outline == 4 && cut_quad(m, face_first_corner(m, face), scale, out))
        return 2;
    if (outline < 3 || !load(t, m, face, scale))
        return 0;
    if (t->hole_count == 0 && is_convex(t))
        return fan(t, out);
    if (t->hole_count > 0 && !triangulator_bridge(t, 0))
        return 0;
    return cut_up(t, 0, out);
}

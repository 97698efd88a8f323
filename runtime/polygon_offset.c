/* polygon_offset.c - polygons moved inward or outward.
 *
 * Every edge is moved along its normal, and what is between the moved edges is joined. Where they
 * come apart at a corner, by the mitre; where they run into each other, by their crossing if
 * neither has lost all of itself so, and otherwise through the corner itself. The curve then winds
 * around a point once per polygon that holds it, less once for every strip between an edge and its
 * moved copy (plus, when they move outward): what it winds around more than 0 times is exactly what
 * is left when the strips are taken away. polygons_clean finds that, so no event is ever missed or
 * taken twice. Where nothing meets, the curve is the result as it is.
 *
 * Where many edges are short against the distance their strips would cross each other without end:
 * the way is gone in steps then, the first of which smooth them out.
 */
#include <math.h>

#include "runtime/list.h"
#include "runtime/polygon.h"
#include "runtime/real.h"

enum {
    CROSSINGS_MAX = 4096, /* of the curve with itself, and some for each corner, are borne */
    HALVINGS_MAX = 20,
    STEPS_MAX = 200
};

/* An edge of a loop, and how its first corner turns. */
typedef struct moved_edge {
    pcg_vec2 from, along; /* of length 1 */
    double length;
    double cosine; /* of the turn */
    double half_cosine, half_sine;
    bool left;
    double loss; /* of the moved copies of both edges at the corner; 0 where they come apart */
} moved_edge;

typedef struct offsetter {
    pcg_run *run;
    double distance;  /* to the left */
    moved_edge *edge; /* of the loop at hand */
    uint32_t edges, edge_capacity;
    polygons *raw;
    bool mitred; /* every corner has become one corner, every edge goes where it went */
    bool convex; /* as far as corners tell */
} offsetter;

/* ---- edges ----------------------------------------------------------------------------------- */

static int list_edges(offsetter *o, const polygons *in, uint32_t loop)
{
    uint32_t from = loop_begin(in, loop), to = in->end[loop];

    o->edges = 0;
    if (list_room(o->run, (void **)&o->edge, &o->edge_capacity, 0, to - from, sizeof *o->edge) !=
        PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = from; i < to; i++) {
        pcg_vec2 a = in->point[i], b = in->point[i + 1 < to ? i + 1 : from];
        double x = b.x - a.x, y = b.y - a.y, length = sqrt(x * x + y * y);

        if (length > 0 && isfinite(length))
            o->edge[o->edges++] =
                (moved_edge){.from = a, .along = {x / length, y / length}, .length = length};
        else
            o->mitred = false;
    }
    return PCG_OK;
}

/* Says how the loop turns at the first corner of `out`. */
static void measure_corner(offsetter *o, const moved_edge *in, moved_edge *out)
{
    double sine = in->along.x * out->along.y - in->along.y * out->along.x;

    out->cosine = in->along.x * out->along.x + in->along.y * out->along.y;
    out->half_cosine = sqrt(fmax(0, (1 + out->cosine) / 2));
    out->half_sine = sqrt(fmax(0, (1 - out->cosine) / 2));
    out->left = sine > 0 || (sine == 0 && out->cosine < 0);
    out->loss = 0;
    if (out->left == (o->distance > 0) && sine != 0)
        out->loss = fabs(o->distance) * out->half_sine / out->half_cosine;
    else if (out->left && o->distance > 0)
        out->loss = INFINITY;
    o->convex = o->convex && sine >= 0;
}

static pcg_vec2 beside(pcg_vec2 p, pcg_vec2 along, double to_left)
{
    return (pcg_vec2){p.x - along.y * to_left, p.y + along.x * to_left};
}

static pcg_vec2 ahead(pcg_vec2 p, pcg_vec2 along, double by)
{
    return (pcg_vec2){p.x + along.x * by, p.y + along.y * by};
}

/* ---- corners --------------------------------------------------------------------------------- */

/* Through the corner itself: a moved edge runs into both its neighbours before it has come to an
 * end. */
static int add_knot(offsetter *o, const moved_edge *in, const moved_edge *out)
{
    o->mitred = false;
    if (polygons_add(o->run, o->raw, beside(out->from, in->along, o->distance)) != PCG_OK ||
        polygons_add(o->run, o->raw, out->from) != PCG_OK)
        return PCG_FAILED;
    return polygons_add(o->run, o->raw, beside(out->from, out->along, o->distance));
}

/* A corner that would reach too far, cut off square. */
static int add_square(offsetter *o, const moved_edge *in, const moved_edge *out)
{
    double reach = fabs(o->distance) * (POLYGON_MITRE - out->half_cosine) / out->half_sine;

    o->mitred = false;
    if (polygons_add(o->run, o->raw,
                     ahead(beside(out->from, in->along, o->distance), in->along, reach)) != PCG_OK)
        return PCG_FAILED;
    return polygons_add(o->run, o->raw,
                        ahead(beside(out->from, out->along, o->distance), out->along, -reach));
}

static bool is_used_up(const moved_edge *edge, const moved_edge *next)
{
    return edge->loss + next->loss > edge->length;
}

/* The corner between `in` and `out`, which `next` follows. */
static int add_corner(offsetter *o, const moved_edge *in, const moved_edge *out,
                      const moved_edge *next)
{
    double across;

    if (out->loss > 0 && (is_used_up(in, out) || is_used_up(out, next)))
        return add_knot(o, in, out);
    if (out->loss == 0 && out->half_cosine * POLYGON_MITRE < 1)
        return add_square(o, in, out);
    across = o->distance / (1 + out->cosine);
    return polygons_add(o->run, o->raw,
                        (pcg_vec2){out->from.x - (in->along.y + out->along.y) * across,
                                   out->from.y + (in->along.x + out->along.x) * across});
}

/* Whether the edges of the last loop still go where they went. */
static bool keeps_directions(const offsetter *o, uint32_t from)
{
    for (uint32_t i = 0; i < o->edges; i++) {
        pcg_vec2 a = o->raw->point[from + i],
                 b = o->raw->point[from + (i + 1 < o->edges ? i + 1 : 0)];

        if (!((b.x - a.x) * o->edge[i].along.x + (b.y - a.y) * o->edge[i].along.y > 0))
            return false;
    }
    return true;
}

/* Whether a loop whose corners all turn left goes around once: it changes its direction along x
 * twice. */
static bool goes_around_once(const offsetter *o)
{
    uint32_t changes = 0;
    bool right = o->edge[o->edges - 1].along.x > 0;

    for (uint32_t i = 0; i < o->edges; i++)
        if (o->edge[i].along.x != 0 && (o->edge[i].along.x > 0) != right) {
            right = !right;
            changes++;
        }
    return changes <= 2;
}

static int move_loop(offsetter *o, const polygons *in, uint32_t loop)
{
    uint32_t from = o->raw->points;

    if (list_edges(o, in, loop) != PCG_OK)
        return PCG_FAILED;
    if (o->edges < 3)
        o->mitred = false;
    for (uint32_t i = 0; i < o->edges; i++)
        measure_corner(o, &o->edge[i > 0 ? i - 1 : o->edges - 1], &o->edge[i]);
    for (uint32_t i = 0; i < o->edges; i++)
        if (add_corner(o, &o->edge[i > 0 ? i - 1 : o->edges - 1], &o->edge[i],
                       &o->edge[i + 1 < o->edges ? i + 1 : 0]) != PCG_OK)
            return PCG_FAILED;
    if (o->mitred && !keeps_directions(o, from))
        o->mitred = false;
    if (o->edges >= 3 && o->convex)
        o->convex = goes_around_once(o);
    return polygons_end_loop(o->run, o->raw);
}

/* ---- all of it ------------------------------------------------------------------------------- */

static int move_loops(offsetter *o, const polygons *in)
{
    for (uint32_t l = 0, face = 0; l < in->loops; l++) {
        if (face < in->faces && in->face[face] == l) {
            if (polygons_begin_face(o->run, o->raw) != PCG_OK)
                return PCG_FAILED;
            face++;
        }
        if (move_loop(o, in, l) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static void take_over(polygons *to, polygons *from)
{
    polygons kept = *to;

    *to = *from;
    *from = kept;
}

/* Moves everything at once. */
static int move_at_once(pcg_run *r, const polygons *in, double distance, polygons *out, bool *plain)
{
    polygons raw = {0};
    offsetter o = {
        .run = r, .distance = distance, .raw = &raw, .mitred = true, .convex = in->loops == 1};
    bool changed = false;
    int status = move_loops(&o, in);

    *plain = false;
    if (status == PCG_OK && !(o.mitred && o.convex))
        status = polygons_clean(r, &raw, 0, out, &changed);
    if (status == PCG_OK && o.mitred && !changed) {
        *plain = true;
        take_over(out, &raw);
    }
    polygons_free(r, &raw);
    run_free(r, o.edge, o.edge_capacity * sizeof *o.edge);
    return status;
}

/* ---- in steps -------------------------------------------------------------------------------- */

/* About how often the curve will cross itself: strips that are much longer than edges cross all
 * that are near. */
static double expected_crossings(const polygons *in, double distance)
{
    double knots = 0, perimeter = 0;

    for (uint32_t l = 0; l < in->loops; l++) {
        uint32_t from = loop_begin(in, l), count = in->end[l] - from;

        for (uint32_t i = 0; i < count; i++) {
            pcg_vec2 a = in->point[from + (i > 0 ? i - 1 : count - 1)], b = in->point[from + i];
            pcg_vec2 c = in->point[from + (i + 1 < count ? i + 1 : 0)];
            double ab = real_hypot(b.x - a.x, b.y - a.y), bc = real_hypot(c.x - b.x, c.y - b.y);
            double sine = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
            double cosine = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);

            perimeter += ab;
            knots += sine * distance > 0 &&
                     fabs(distance) * fabs(sine) > fmin(ab, bc) * (ab * bc + cosine);
        }
    }
    return perimeter > 0 ? knots * fabs(distance) * in->points / perimeter : 0;
}

/* How far to go at once: less where many edges are short against the distance. A short way smooths
 * them out. */
static double next_step(const polygons *in, double distance)
{
    double step = distance;

    for (int i = 0;
         i < HALVINGS_MAX && expected_crossings(in, step) > CROSSINGS_MAX + 4.0 * in->points; i++)
        step /= 2;
    return step;
}

/* ---- what is used up ------------------------------------------------------------------------- */

/* Whether nothing of a face can be left so far inside: no place in it is farther from its outline
 * than half the narrow side of the box around it. */
static bool is_too_narrow(const polygons *p, uint32_t face, double distance)
{
    pcg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};

    if (p->face[face] >= p->loops)
        return true;
    for (uint32_t i = loop_begin(p, p->face[face]); i < p->end[p->face[face]]; i++) {
        low = (pcg_vec2){fmin(low.x, p->point[i].x), fmin(low.y, p->point[i].y)};
        high = (pcg_vec2){fmax(high.x, p->point[i].x), fmax(high.y, p->point[i].y)};
    }
    return fmin(high.x - low.x, high.y - low.y) * (1 + 1e-9) < 2 * distance;
}

static bool has_narrow_face(const polygons *p, double distance)
{
    if (!(distance > 0) || (p->faces > 0 && p->face[0] > 0))
        return false;
    for (uint32_t f = 0; f < p->faces; f++)
        if (is_too_narrow(p, f, distance))
            return true;
    return false;
}

/* Copies the faces that are not too narrow. Status. */
static int keep_wide_faces(pcg_run *r, const polygons *in, double distance, polygons *out)
{
    for (uint32_t f = 0; f < in->faces; f++) {
        if (is_too_narrow(in, f, distance))
            continue;
        if (polygons_begin_face(r, out) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t l = in->face[f]; l < face_end(in, f); l++) {
            for (uint32_t i = loop_begin(in, l); i < in->end[l]; i++)
                if (polygons_add(r, out, in->point[i]) != PCG_OK)
                    return PCG_FAILED;
            if (polygons_end_loop(r, out) != PCG_OK)
                return PCG_FAILED;
        }
    }
    return PCG_OK;
}

/* Moves by one step of the way that is left, without what will not last. Status. */
static int move_step(pcg_run *r, const polygons *in, double left, double step, polygons *out,
                     bool *plain)
{
    polygons wide = {0};
    int status;

    if (!has_narrow_face(in, left))
        return move_at_once(r, in, step, out, plain);
    status = keep_wide_faces(r, in, left, &wide);
    if (status == PCG_OK && wide.faces > 0)
        status = move_at_once(r, &wide, step, out, plain);
    *plain = false;
    polygons_free(r, &wide);
    return status;
}

int polygons_offset(pcg_run *r, const polygons *in, double distance, polygons *out, bool *plain)
{
    double step = next_step(in, distance), gone = step;
    polygons before = {0};
    int status = move_step(r, in, distance, step, out, plain);

    for (int i = 0; gone != distance && status == PCG_OK && out->loops > 0; i++) {
        *plain = false;
        take_over(&before, out);
        polygons_clear(out);
        step = i < STEPS_MAX ? next_step(&before, distance - gone) : distance - gone;
        status = move_step(r, &before, distance - gone, step, out, &(bool){false});
        gone = step == distance - gone ? distance : gone + step;
    }
    polygons_free(r, &before);
    return status;
}

/*pcg
/// Turns the scope of a shape; the shape itself stays where it is.
///
/// What the scope's axes are decides where `split` cuts, which faces `select` calls front and how
/// `map_uv_box` lays a texture.
procedure align_scope(in: Shape) -> (out: Shape) [pure] {
    category "scope"
    synonyms "align scope to axes", "reorient", "coordinate system", "pivot"
    param to: Alignment = axes    /// What the axes follow.
    example rectangle(width = 2m, height = 3m) -> rotate(z = 45deg)
        -> align_scope(to = axes) expect faces = 1, area = 6
    example rectangle(width = 2m, height = 3m) -> rotate(z = 45deg)
        -> align_scope(to = longest_edge)
        -> condition(test = abs(size(in).x - 3) < 0.000001) expect yes.count = 1
}

/// What a scope's axes are aligned to.
enum Alignment {
    axes          /// The axes of the world, z up.
    face          /// The largest face: z is its normal, x level, y up the face.
    longest_edge  /// As `face`, with x along the longest edge of that face.
    smallest_box  /// As `face`, with x along a side of the smallest box around that face.
}
*/
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "geometry.h"
#include "runtime/mesh.h"
#include "runtime/real.h"
#include "align_scope.h"

/* Of a length or an area: what differs by less is equal. */
static const double hair = 1e-9;

static const pcg_vec3 world_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* The face with the largest area; false where none has any. */
static bool largest_face(const pcg_shape *s, uint32_t *face)
{
    double largest = 0;
    for (uint32_t f = 0; f < s->mesh->face_count; f++) {
        double area = vec3_length(pcg_shape_face_normal(s, f));
        if (area > largest) {
            largest = area;
            *face = f;
        }
    }
    return largest > 0;
}

/* The direction of the edge that begins at a corner of the face's outline, in the world; not
 * normalised. */
static pcg_vec3 edge_direction(const pcg_shape *s, uint32_t face, uint32_t corner)
{
    uint32_t outline = s->mesh->face_loop[face];
    uint32_t first = s->mesh->loop_corner[outline], end = s->mesh->loop_corner[outline + 1];
    pcg_vec3 a = shape_corner(s, corner),
             b = shape_corner(s, corner + 1 < end ? corner + 1 : first);
    return pcg_scope_direction(&s->scope, vec3_subtract(b, a));
}

/* Turns x (and y) of axes on a face along a direction. */
static void turn_to(pcg_vec3 axis[3], pcg_vec3 edge)
{
    pcg_vec3 along = vec3_subtract(edge, vec3_scale(axis[2], vec3_dot(edge, axis[2])));

    axis[0] = vec3_normal(along);
    axis[1] = vec3_cross(axis[2], axis[0]);
}

static void follow_longest_edge(const pcg_shape *s, uint32_t face, pcg_vec3 axis[3])
{
    uint32_t outline = s->mesh->face_loop[face];
    double longest = 0;
    pcg_vec3 best = axis[0];
    for (uint32_t c = s->mesh->loop_corner[outline]; c < s->mesh->loop_corner[outline + 1]; c++) {
        pcg_vec3 edge = edge_direction(s, face, c);
        double length = vec3_length(edge);
        /* Edges of a rectangle come in equal pairs: the first one counts, whatever rounding
         * says. */
        if (length > longest * (1 + hair)) {
            longest = length;
            best = edge;
        }
    }
    turn_to(axis, best);
}

/* ---- the smallest box ------------------------------------------------------------------------ */

/* A corner in the plane of the face. */
typedef struct hull_point {
    double x, y;
    uint32_t corner; /* its place in the outline */
} hull_point;

static int compare_points(const void *a, const void *b)
{
    const hull_point *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return (p->corner > q->corner) - (p->corner < q->corner);
}

static double turn_of(const hull_point *a, const hull_point *b, const hull_point *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* The corners of the convex hull, counter-clockwise, from sorted points into `hull`, which has room
 * for one more than them. Returns how many. */
static uint32_t wrap(const hull_point *p, uint32_t count, hull_point *hull)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        while (n > 1 && turn_of(&hull[n - 2], &hull[n - 1], &p[i]) <= 0)
            n--;
        hull[n++] = p[i];
    }
    for (uint32_t i = count - 1, lower = n + 1; i-- > 0;) {
        while (n >= lower && turn_of(&hull[n - 2], &hull[n - 1], &p[i]) <= 0)
            n--;
        hull[n++] = p[i];
    }
    return n > 1 ? n - 1 : n;
}

/* How far a point reaches along a direction. */
static double reach(const hull_point *p, double x, double y)
{
    return p->x * x + p->y * y;
}

/* From `at` on, the corner that reaches farthest along a direction. Only as the direction turns
 * with the hull. */
static uint32_t farthest(const hull_point *hull, uint32_t count, uint32_t at, double x, double y)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t next = at + 1 < count ? at + 1 : 0;
        if (reach(&hull[next], x, y) < reach(&hull[at], x, y))
            break;
        at = next;
    }
    return at;
}

/* The direction of the hull's edge that has the smallest box along it, of those that are equal the
 * first of the outline: the box's other sides turn with the edge around the hull. */
static pcg_vec2 smallest_box(const hull_point *hull, uint32_t count)
{
    uint32_t right = 1, up = 1, left = 1, first = UINT32_MAX;
    double best = DBL_MAX;
    pcg_vec2 direction = {0, 0};
    for (uint32_t i = 0; i < count; i++) {
        const hull_point *a = &hull[i], *b = &hull[i + 1 < count ? i + 1 : 0];
        double length = real_hypot(b->x - a->x, b->y - a->y);
        double x = (b->x - a->x) / length, y = (b->y - a->y) / length, area;
        right = farthest(hull, count, i > 0 ? right : 0, x, y);
        up = farthest(hull, count, i > 0 ? up : right, -y, x);
        left = farthest(hull, count, i > 0 ? left : up, -x, -y);
        area = (reach(&hull[right], x, y) - reach(&hull[left], x, y)) *
               (reach(&hull[up], -y, x) - reach(a, -y, x));
        if (area < best - hair * fabs(best) ||
            (area <= best + hair * fabs(best) && a->corner < first)) {
            best = area;
            first = a->corner;
            direction = (pcg_vec2){x, y};
        }
    }
    return direction;
}

/* Turns x (and y) of axes on a face along the side of its smallest box. Status. */
static int follow_smallest_box(pcg_call *call, const pcg_shape *s, uint32_t face, pcg_vec3 axis[3])
{
    uint32_t first = s->mesh->loop_corner[s->mesh->face_loop[face]];
    uint32_t count = s->mesh->loop_corner[s->mesh->face_loop[face] + 1] - first;
    size_t room = (2 * (size_t)count + 1) * sizeof(hull_point);
    hull_point *at = run_alloc(call->run, room);
    pcg_vec2 d;
    if (at == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++) {
        pcg_vec3 p = vec3_subtract(shape_corner(s, first + i), shape_corner(s, first));
        p = pcg_scope_direction(&s->scope, p);
        at[i] = (hull_point){vec3_dot(p, axis[0]), vec3_dot(p, axis[1]), i};
    }
    qsort(at, count, sizeof *at, compare_points);
    d = smallest_box(at + count, wrap(at, count, at + count));
    run_free(call->run, at, room);
    if (d.x != 0 || d.y != 0)
        turn_to(axis, vec3_add(vec3_scale(axis[0], d.x), vec3_scale(axis[1], d.y)));
    return PCG_OK;
}

int pcg_geometry_align_scope(pcg_call *call, struct pcg_geometry_align_scope *node)
{
    pcg_shape *s = node->in;
    uint32_t face = 0;
    pcg_vec3 axis[3] = {world_axes[0], world_axes[1], world_axes[2]};
    bool on_face = node->to != PCG_ALIGNMENT_AXES;
    if (on_face && !largest_face(s, &face)) {
        int status = pcg_warn(call, "the scope stays as it is: the shape has no face with an area");
        return status == PCG_OK ? pcg_emit(call, node->out, &s->entity) : status;
    }
    if (on_face)
        shape_face_axes(&s->scope,
                        vec3_normal(pcg_scope_direction(&s->scope, pcg_shape_face_normal(s, face))),
                        axis);
    if (node->to == PCG_ALIGNMENT_LONGEST_EDGE)
        follow_longest_edge(s, face, axis);
    if (node->to == PCG_ALIGNMENT_SMALLEST_BOX)
        PCG_TRY(follow_smallest_box(call, s, face, axis));
    if (pcg_shape_align(call->run, s, axis) != PCG_OK)
        return PCG_FAILED;
    return pcg_emit(call, node->out, &s->entity);
}

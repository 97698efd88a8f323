/*pcg
/// The area of all faces, both sides counted once, holes taken off.
function area(s: Faced) -> area [pure] { example area(in) == 52m2 }
/// The volume that the faces enclose; exact where they are closed and face outward.
function volume(s: Shape) -> float [pure] { example volume(in) == 24 }
/// The length of all outlines; an edge between two faces counts twice.
function perimeter(s: Faced) -> length [pure] { example perimeter(in) == 72m }
/// The extent along the x axis of its scope.
function width(s: Shape) -> length [pure] { example width(in) == 4m }
/// The extent along the y axis of its scope: up, on a facade; into the depth, on the ground.
function depth(s: Shape) -> length [pure] { example depth(in) == 3m }
/// The extent upward, in the world.
function height(s: Shape) -> length [pure] { example height(in) == 2m }
/// The extents along the three axes of its scope, in metres.
function size(s: Shape) -> vec3 [pure] { example size(in).z == 2 }
/// The centre of the area of its faces, in the world; without faces, the mean of its vertices.
function centroid(s: Spatial) -> vec3 [pure] { example centroid(in).z == 1 }
/// The lowest corner of its bounding box in the world; (0, 0, 0) where it is empty.
function bounds_low(s: Spatial) -> vec3 [pure] { example bounds_low(in).z == 0 }
/// The highest corner of its bounding box in the world; (0, 0, 0) where it is empty.
function bounds_high(s: Spatial) -> vec3 [pure] { example bounds_high(in).z == 2 }
/// The direction that its faces look to on the whole, of length 1; (0, 0, 0) where they cancel out.
function normal(s: Faced) -> vec3 [pure] { example normal(in).x == 0 }
/// The angle between its normal and straight up: 0 is level ground, 90 a wall.
function slope(s: Faced) -> angle [pure] { example slope(in) == 0deg }
/// The compass direction that it looks to: 0 is north (+y), 90 east (+x).
function azimuth(s: Faced) -> angle [pure] { example azimuth(in) == 0deg }
/// How many faces it has.
function faces(s: Shape) -> int [pure] { example faces(in) == 6 }
/// How many vertices it has.
function vertices(s: Shape) -> int [pure] { example vertices(in) == 8 }
/// How many holes its faces have.
function holes(s: Shape) -> int [pure] { example holes(in) == 0 }
/// Whether it has faces, and all their corners lie in one plane.
function is_planar(s: Shape) -> bool [pure] { example !is_planar(in) }
/// How many edges it has, those between two faces once.
function edges(s: Shape) -> int [pure] { example edges(in) == 12 }
/// Whether every edge has one face on either side, which agree on what is outside.
function is_closed(s: Shape) -> bool [pure] { example is_closed(in) }
/// Whether it is one face, without a hole, all of whose corners turn the same way.
function is_convex(s: Shape) -> bool [pure] { example !is_convex(in) }
/// Whether it is one face with four right angles, to a tenth of a degree; corners along a side do not count.
function is_rectangular(s: Shape) -> bool [pure] { example !is_rectangular(in) }
/// The angle between where two look on the whole; 0 where one looks nowhere, as a solid does.
function angle(a: Faced, b: Faced) -> angle [pure] { example angle(in, in) == 0deg }
/// Whether it looks towards a point, by the angle between where it looks and the way from its centre.
function is_facing(s: Faced, point: vec3, tolerance: angle) -> bool [pure] { example !is_facing(in, [9, 9, 9], 45deg) }
/// How far its centre is from a point in the world.
function distance(s: Spatial, point: vec3) -> length [pure] { example distance(in, centroid(in)) == 0m }
/// How far the centres of two are from each other.
function distance(a: Spatial, b: Spatial) -> length [pure] { example distance(in, in) == 0m }
*/
#include <math.h>

#include "geometry.h"
#include "measure.h"
#include "runtime/mesh.h"
#include "runtime/real.h"
#include "runtime/topology.h"
#include "spatial.h"

double pcg_geometry_fn_area_Faced(pcg_call *call, const pcg_entity *s)
{
    return faced_area(call, s);
}

double pcg_geometry_fn_volume_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    return pcg_shape_volume(s);
}

double pcg_geometry_fn_perimeter_Faced(pcg_call *call, const pcg_entity *s)
{
    return faced_perimeter(call, s);
}

/* ---- extents --------------------------------------------------------------------------------- */

double pcg_geometry_fn_width_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    return s->scope.size.x;
}

double pcg_geometry_fn_depth_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    return s->scope.size.y;
}

double pcg_geometry_fn_height_Shape(pcg_call *call, const pcg_shape *s)
{
    pcg_vec3 low, high;
    spatial_bounds(call, &s->entity, &low, &high);
    return high.z - low.z;
}

void pcg_geometry_fn_size_Shape(pcg_call *call, const pcg_shape *s, pcg_vec3 *result)
{
    (void)call;
    *result = s->scope.size;
}

void pcg_geometry_fn_bounds_low_Spatial(pcg_call *call, const pcg_entity *s, pcg_vec3 *result)
{
    pcg_vec3 high;
    spatial_bounds(call, s, result, &high);
}

void pcg_geometry_fn_bounds_high_Spatial(pcg_call *call, const pcg_entity *s, pcg_vec3 *result)
{
    pcg_vec3 low;
    spatial_bounds(call, s, &low, result);
}

/* ---- centres and directions ------------------------------------------------------------------ */

void pcg_geometry_fn_centroid_Spatial(pcg_call *call, const pcg_entity *s, pcg_vec3 *result)
{
    *result = spatial_centre(call, s);
}

void pcg_geometry_fn_normal_Faced(pcg_call *call, const pcg_entity *s, pcg_vec3 *result)
{
    *result = faced_normal(call, s);
}

double pcg_geometry_fn_slope_Faced(pcg_call *call, const pcg_entity *s)
{
    pcg_vec3 n = faced_normal(call, s);
    return real_atan2(real_hypot(n.x, n.y), n.z);
}

double pcg_geometry_fn_azimuth_Faced(pcg_call *call, const pcg_entity *s)
{
    pcg_vec3 n = faced_normal(call, s);
    double degrees = real_atan2(n.x, n.y);
    return degrees < 0 ? degrees + 360 : degrees;
}

/* ---- counts and tests ------------------------------------------------------------------------ */

pcg_int pcg_geometry_fn_faces_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    return s->mesh->face_count;
}

pcg_int pcg_geometry_fn_vertices_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    return s->mesh->vertex_count;
}

pcg_int pcg_geometry_fn_holes_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    return pcg_shape_holes(s);
}

int pcg_geometry_fn_is_planar_Shape(pcg_call *call, const pcg_shape *s)
{
    (void)call;
    if (!s->mesh->face_count || !s->mesh->corner_count)
        return 0;
    pcg_vec3 n = vec3_normal(pcg_shape_face_normal(s, 0)), at = shape_corner(s, 0);
    double tolerance = 1e-9 * (1 + vec3_length(s->scope.size));
    for (uint32_t c = 0; c < s->mesh->corner_count; c++)
        if (fabs(vec3_dot(n, vec3_subtract(shape_corner(s, c), at))) > tolerance)
            return 0;
    return 1;
}

pcg_int pcg_geometry_fn_edges_Shape(pcg_call *call, const pcg_shape *s)
{
    edge_list list;
    pcg_int count = edge_list_open(call->run, s, &list) == PCG_OK ? list.count : 0;

    edge_list_close(call->run, s, &list);
    return count;
}

int pcg_geometry_fn_is_closed_Shape(pcg_call *call, const pcg_shape *s)
{
    return s->mesh->face_count > 0 && is_closed(call->run, s);
}

/* How a face goes round: what of its corners turn, and how. */
typedef struct turning {
    uint32_t left, right, square; /* `square`: of the left ones, by a right angle */
    double total;                 /* degrees */
} turning;

/* The first corner behind `c` of the loop that is in another place than `c`; `c` where there is
 * none. */
static uint32_t next_place(const pcg_shape *s, uint32_t first, uint32_t end, uint32_t c)
{
    uint32_t next = c;

    do {
        pcg_vec3 d;

        next = next + 1 < end ? next + 1 : first;
        d = vec3_subtract(shape_corner(s, next), shape_corner(s, c));
        if (vec3_dot(d, d) > 0)
            return next;
    } while (next != c);
    return c;
}

/* Of the outline of the one face. */
static turning turn_along(const pcg_shape *s)
{
    const double hair = 0.1; /* degrees */
    uint32_t first = s->mesh->loop_corner[0], end = s->mesh->loop_corner[1];
    pcg_vec3 normal = vec3_normal(pcg_shape_face_normal(s, 0));
    turning t = {0};

    for (uint32_t c = first; c < end; c++) {
        uint32_t before = c > first ? c - 1 : end - 1, next = next_place(s, first, end, c);
        pcg_vec3 in = vec3_subtract(shape_corner(s, c), shape_corner(s, before));
        pcg_vec3 out = vec3_subtract(shape_corner(s, next), shape_corner(s, c));
        double degrees;

        if (vec3_dot(in, in) == 0)
            continue; /* one place is one corner: the first that stands there */
        degrees = real_atan2(vec3_dot(vec3_cross(in, out), normal), vec3_dot(in, out));
        t.left += degrees > hair;
        t.right += degrees < -hair;
        t.square += fabs(degrees - 90) <= hair;
        t.total += degrees;
    }
    return t;
}

static bool is_one_face(const pcg_shape *s)
{
    return s->mesh->face_count == 1 && s->mesh->loop_count == 1;
}

int pcg_geometry_fn_is_convex_Shape(pcg_call *call, const pcg_shape *s)
{
    turning t;

    (void)call;
    if (!is_one_face(s))
        return 0;
    t = turn_along(s);
    return t.left > 2 && t.right == 0 && t.total < 361;
}

int pcg_geometry_fn_is_rectangular_Shape(pcg_call *call, const pcg_shape *s)
{
    turning t;

    (void)call;
    if (!is_one_face(s))
        return 0;
    t = turn_along(s);
    return t.left == 4 && t.square == 4 && t.right == 0;
}

double pcg_geometry_fn_angle_Faced_Faced(pcg_call *call, const pcg_entity *a, const pcg_entity *b)
{
    return geometry_angle(faced_normal(call, a), faced_normal(call, b));
}

int pcg_geometry_fn_is_facing_Faced_vec3_angle(pcg_call *call, const pcg_entity *s,
                                               const pcg_vec3 *point, double tolerance)
{
    pcg_vec3 normal = faced_normal(call, s);

    return vec3_dot(normal, normal) > 0 &&
           geometry_angle(normal, vec3_subtract(*point, spatial_centre(call, s))) <= tolerance;
}

double pcg_geometry_fn_distance_Spatial_vec3(pcg_call *call, const pcg_entity *s,
                                             const pcg_vec3 *point)
{
    return vec3_length(vec3_subtract(spatial_centre(call, s), *point));
}

double pcg_geometry_fn_distance_Spatial_Spatial(pcg_call *call, const pcg_entity *a,
                                                const pcg_entity *b)
{
    return vec3_length(vec3_subtract(spatial_centre(call, a), spatial_centre(call, b)));
}

/*pcg
/// Divides faces by whether they touch, or nearly touch, those of others: party walls, say.
///
/// A place on a face is covered where a face of the others is not farther than the gap from it,
/// before it or behind it, measured along its normal. Shapes of which more than the least share is
/// covered are adjacent, all others free; what has no face with an area is free. Where the shapes
/// themselves are among the others, `different` keeps them apart.
procedure adjacent(in: Shape[], to: Shape[]?) -> (adjacent: Shape, free: Shape) [pure] {
    category "context"
    synonyms "touches", "party wall", "neighbour", "contact", "shared wall", "against", "covered"
    param gap: length = 10cm range [0m, 1000m]    /// How far apart they may be.
    param least: ratio = 1% range [0%, 100%]      /// More than this share has to be covered.
    attr share: ratio                             /// Written: the share that is covered.
    attr index: int                               /// Written: the number of the first that covers some of it, from 0; -1: none.
    /// Only those count whose value of an attribute is another: other houses' walls, say.
    augment different(
        key: attribute                            /// What must differ.
    )
    example box(width = 4m, depth = 4m, height = 4m) -> select { side } -> decompose() -> a.in;
        box(width = 4m, depth = 2m, height = 2m) -> translate(x = 4m) -> a.to;
        a: adjacent(share => @s); a.adjacent -> c: condition(@s == 0.25) expect c.yes.count = 1, free.count = 3
}
*/
#include "adjacent.h"

#include "nearby.h"
#include "runtime/polygon_face.h"
#include "runtime/mesh.h"

enum {
    CUT_MAX = 9, /* corners of a triangle in a box */
    BATCH = 24   /* covering polygons that are joined at a time: what overlaps is one then */
};

typedef struct meeting {
    pcg_call *call;
    struct pcg_geometry_adjacent *node;
    const pcg_shape *shape; /* that is asked about */
    nearby_reader reader;
    nearby others;
    nearby_list around;
    polygons face, cover, joined;
    face_frame frame;
    pcg_vec3 low, high; /* of the space in which the face is covered, in its frame */
    uint32_t waiting;   /* covering polygons that are not joined yet */
    uint32_t first;     /* of those that cover; UINT32_MAX: none yet */
} meeting;

/* ---- what covers a face ---------------------------------------------------------------------- */

static bool differs(const meeting *m, uint32_t owner)
{
    for (uint32_t i = 0; i < m->node->item_count; i++)
        if (geometry_same_value(&m->node->items[i].different.key, &m->shape->entity,
                                m->node->to.at[owner]))
            return false;
    return true;
}

/* Keeps what of a convex polygon is not above a limit along an axis; below, where `sign` is -1.
 * Returns how many corners it has. */
static uint32_t cut(const pcg_vec3 *in, uint32_t count, int axis, double sign, double limit,
                    pcg_vec3 *out)
{
    uint32_t kept = 0;

    for (uint32_t i = 0; i < count; i++) {
        pcg_vec3 a = in[i], b = in[i + 1 < count ? i + 1 : 0];
        double over_a = sign * (geometry_component(a, axis) - limit);
        double over_b = sign * (geometry_component(b, axis) - limit);

        if (over_a <= 0)
            out[kept++] = a;
        if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0))
            out[kept++] = vec3_add(a, vec3_scale(vec3_subtract(b, a), over_a / (over_a - over_b)));
    }
    return kept;
}

/* Keeps what of a triangle is in the space in which the face is covered; `at` has room for
 * CUT_MAX. */
static uint32_t cut_to_space(const meeting *m, pcg_vec3 *at)
{
    pcg_vec3 half[CUT_MAX];
    uint32_t count = 3;

    for (int axis = 0; axis < 3; axis++) {
        count = cut(at, count, axis, 1, geometry_component(m->high, axis), half);
        count = cut(half, count, axis, -1, geometry_component(m->low, axis), at);
    }
    return count;
}

/* A part's corners in the frame of the face. */
static void to_frame(const meeting *m, const nearby_part *part, pcg_vec3 corner[3])
{
    for (uint32_t i = 0; i < 3; i++) {
        pcg_vec3 p =
            vec3_subtract(pcg_scope_local(&m->shape->scope, part->corner[i]), m->frame.origin);

        corner[i] = vec3(vec3_dot(p, m->frame.x), vec3_dot(p, m->frame.y), vec3_dot(p, m->frame.z));
    }
}

/* Twice the signed area, seen along z. */
static double turn_of(const pcg_vec3 *p, uint32_t count)
{
    double sum = 0;

    for (uint32_t i = 1; i + 1 < count; i++)
        sum +=
            (p[i].x - p[0].x) * (p[i + 1].y - p[0].y) - (p[i].y - p[0].y) * (p[i + 1].x - p[0].x);
    return sum;
}

/* Adds what of a part is within the gap to what covers the face. Status. */
static int add_cover(meeting *m, const nearby_part *part)
{
    pcg_vec3 at[CUT_MAX];
    uint32_t count;
    double turn;

    to_frame(m, part, at);
    count = cut_to_space(m, at);
    turn = turn_of(at, count);
    if (count < 3 || turn == 0)
        return PCG_OK;
    for (uint32_t i = 0; i < count; i++) {
        pcg_vec3 p = at[turn > 0 ? i : count - 1 - i];

        if (polygons_add(m->call->run, &m->cover, (pcg_vec2){p.x, p.y}) != PCG_OK)
            return PCG_FAILED;
    }
    m->first = part->owner < m->first ? part->owner : m->first;
    m->waiting++;
    return polygons_end_loop(m->call->run, &m->cover);
}

/* Makes one of what overlaps. Status. */
static int join_cover(meeting *m)
{
    polygons kept = m->joined;
    bool changed;
    int status;

    polygons_clear(&kept);
    status = polygons_clean(m->call->run, &m->cover, 0, &kept, &changed);
    m->joined = m->cover;
    m->cover = kept;
    m->waiting = 0;
    return status == PCG_OK ? pcg_tick(m->call) : status;
}

static int list_cover(meeting *m)
{
    int status = PCG_OK;

    polygons_clear(&m->cover);
    m->waiting = 0;
    for (uint32_t i = 0; i < m->around.count && status == PCG_OK; i++) {
        const nearby_part *part = &m->others.parts.at[m->around.at[i]];

        if (part->corners == 3 && differs(m, part->owner))
            status = add_cover(m, part);
        if (status == PCG_OK && m->waiting == BATCH)
            status = join_cover(m);
    }
    return status == PCG_OK && m->waiting > 0 ? join_cover(m) : status;
}

/* The area that the face and what covers it have in common. Status. */
static int common_area(meeting *m, double *area)
{
    int status = PCG_OK;

    *area = 0;
    polygons_clear(&m->joined);
    if (m->cover.loops > 0)
        status = polygons_intersect(m->call->run, &m->cover, &m->face, &m->joined);
    *area = polygons_area(&m->joined);
    return status;
}

/* ---- one shape ------------------------------------------------------------------------------- */

static void face_bounds(const pcg_shape *s, uint32_t face, pcg_vec3 *low, pcg_vec3 *high)
{
    uint32_t first = face_first_corner(s->mesh, face);

    *low = *high = pcg_scope_point(&s->scope, shape_corner(s, first));
    for (uint32_t c = first + 1; c < face_last_corner(s->mesh, face); c++)
        bounds_add(low, high, pcg_scope_point(&s->scope, shape_corner(s, c)));
}

/* Where the face is covered: the box around it, as thick as the gap on either side. */
static void measure_space(meeting *m)
{
    double gap = m->node->gap;
    pcg_vec2 first = m->face.point[0];

    m->low = vec3(first.x, first.y, -gap);
    m->high = vec3(first.x, first.y, gap);
    for (uint32_t i = 0; i < m->face.points; i++) {
        pcg_vec2 p = m->face.point[i];

        bounds_add(&m->low, &m->high, vec3(p.x, p.y, 0));
    }
}

/* Adds a face's area, and that which is covered. Status. */
static int measure_face(meeting *m, uint32_t face, double *area, double *covered)
{
    pcg_vec3 low, high;
    double common = 0;
    int status;

    polygons_clear(&m->face);
    status = polygons_of_face(m->call->run, m->shape, face, &m->frame, &m->face);
    if (status != PCG_OK || m->face.loops == 0)
        return status;
    measure_space(m);
    face_bounds(m->shape, face, &low, &high);
    status = nearby_around(&m->others, low, high, m->node->gap, &m->around);
    if (status == PCG_OK)
        status = list_cover(m);
    if (status == PCG_OK)
        status = common_area(m, &common);
    *area += polygons_area(&m->face);
    *covered += common;
    return status;
}

static int divide(meeting *m, pcg_shape *s)
{
    double area = 0, covered = 0, share;
    int status = PCG_OK;

    m->shape = s;
    m->first = UINT32_MAX;
    for (uint32_t f = 0; f < s->mesh->face_count && status == PCG_OK; f++)
        status = measure_face(m, f, &area, &covered);
    if (status == PCG_OK)
        status = pcg_tick(m->call);
    if (status != PCG_OK)
        return status;
    share = area > 0 ? covered / area : 0;
    share = share > 1 ? 1 : share;
    pcg_set_float(m->call->run, &s->entity, &m->node->share, share);
    pcg_set_int(m->call->run, &s->entity, &m->node->index,
                m->first < UINT32_MAX && covered > 0 ? (pcg_int)m->first : -1);
    return pcg_emit(m->call, share > m->node->least ? m->node->adjacent : m->node->free,
                    &s->entity);
}

/* ---- all of them ----------------------------------------------------------------------------- */

static int divide_all(meeting *m)
{
    int status = nearby_reader_open(m->call->run, &m->reader);

    if (status == PCG_OK)
        status = nearby_open(m->call, &m->reader, &m->node->to, &m->others);
    for (uint32_t i = 0; i < m->node->in.count && status == PCG_OK; i++)
        status = divide(m, (pcg_shape *)m->node->in.at[i]);
    return status;
}

int pcg_geometry_adjacent(pcg_call *call, struct pcg_geometry_adjacent *node)
{
    meeting m = {.call = call, .node = node};
    int status = divide_all(&m);

    nearby_reader_close(&m.reader);
    nearby_close(&m.others);
    nearby_list_free(call->run, &m.around);
    polygons_free(call->run, &m.face);
    polygons_free(call->run, &m.cover);
    polygons_free(call->run, &m.joined);
    for (uint32_t i = 0; i < node->to.count; i++)
        pcg_entity_drop(call->run, node->to.at[i]);
    return status;
}

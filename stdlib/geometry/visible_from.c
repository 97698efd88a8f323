/*pcg
/// Divides shapes by whether they can be seen from others: what is oriented to a street, say.
///
/// A shape is looked at in the middle of its faces, from the points of the others: of each face,
/// edge or vertex the point nearest to that, its corners and its middle. It is visible where one of
/// these is near enough, not farther off the direction in which the shape looks than the tolerance,
/// and nothing stands between. Nearer ones are tried first. What stands between are faces of the
/// blockers, and those of the other shapes that are asked about. Within a millimetre of both ends
/// nothing blocks, so that a wall may be looked at in front of the solid that it is a side of. A
/// shape that looks nowhere on the whole, an edge, say, is seen from all around.
procedure visible_from(in: Shape[], from: Shape[]?) -> (visible: Shape, hidden: Shape) [pure] {
    category "context"
    synonyms "is oriented to", "facing", "line of sight", "occlusion", "ray cast", "street", "view"
    param within: length = 50m       /// How far is looked.
    param tolerance: angle = 60deg   /// How far off the direction in which it looks it may be seen from; 180: all around.
    param self: bool = true          /// The shapes stand in each other's way.
    attr index: int                  /// Written on what is visible: the number of what it is seen from, from 0.
    attr distance: length            /// Written on what is visible: from how far.
    attr angle: angle                /// Written on what is visible: how far off the direction in which it looks.
    /// Shapes that stand in the way; they go no further.
    augment blockers() <- Shape[]?
    example box() -> select { side } -> decompose() -> v.in; rectangle(width = 1m, height = 1m) -> translate(x = 3m) -> v.from;
        v: visible_from() expect visible.count = 1, hidden.count = 3
    example box(width = 1m, depth = 9m) -> copy(count = 2, index => @n) -> translate(x = 5m * @n) -> select { side } -> decompose() -> v.in;
        rectangle(width = 9m, height = 9m) -> translate(x = 9m) -> v.from;
        v: visible_from(tolerance = 30deg) expect visible.count = 1
}
*/
#include "visible_from.h"

#include <math.h>
#include <stdlib.h>

#include "nearby.h"
#include "runtime/list.h"

enum {
    POINTS = 5, /* that a part is looked at from: the nearest, three corners, the middle */
    RINGS = 8   /* in which the parts around are gone through: most shapes need the first ones */
};

/* What is nearer than this to either end does not stand in between: metres. */
static const double margin = 1e-3;
/* What an angle may be off by rounding: degrees. */
static const double hair = 1e-7;

/* A part that may see the shape. */
typedef struct viewer {
    double square; /* of how far it is */
    uint32_t part;
    pcg_vec3 nearest;
} viewer;

/* The shape that is asked about. */
typedef struct sighting {
    uint32_t number;
    pcg_vec3 eye, normal; /* its middle, and where it looks */
    bool looks;
    uint32_t seen_from;
    double distance, angle;
} sighting;

typedef struct looking {
    pcg_call *call;
    struct pcg_geometry_visible_from *node;
    nearby_reader reader;
    nearby from, self;
    nearby *blockers; /* one an item */
    nearby_list around;
    viewer *viewer;
    uint32_t viewer_capacity;
} looking;

/* ---- one shape ------------------------------------------------------------------------------- */

static bool is_other(const void *user, uint32_t owner)
{
    return owner != *(const uint32_t *)user;
}

static bool is_free(const looking *l, const sighting *s, pcg_vec3 point)
{
    const nearby_filter others = {is_other, &s->number};

    if (nearby_blocks(&l->self, s->eye, point, margin, &others))
        return false;
    for (uint32_t i = 0; i < l->node->item_count; i++)
        if (nearby_blocks(&l->blockers[i], s->eye, point, margin, NULL))
            return false;
    return true;
}

/* Whether the shape is seen from a point; notes how. */
static bool sees(const looking *l, sighting *s, pcg_vec3 point)
{
    pcg_vec3 way = vec3_subtract(point, s->eye);

    s->distance = vec3_length(way);
    s->angle = s->looks ? geometry_angle(s->normal, way) : 0;
    return s->distance <= l->node->within && s->angle <= l->node->tolerance + hair &&
           is_free(l, s, point);
}

static bool sees_from_part(const looking *l, sighting *s, const viewer *v)
{
    const nearby_part *p = &l->from.parts.at[v->part];
    pcg_vec3 point[POINTS] = {v->nearest, p->corner[0], p->corner[1], p->corner[2]};
    uint32_t count = p->corners + 1;

    if (p->corners == 1)
        count = 1;
    else if (p->corners == 2)
        point[count++] = vec3_scale(vec3_add(p->corner[0], p->corner[1]), 0.5);
    else
        point[count++] =
            vec3_scale(vec3_add(vec3_add(p->corner[0], p->corner[1]), p->corner[2]), 1.0 / 3);
    s->seen_from = p->owner;
    for (uint32_t i = 0; i < count; i++)
        if (sees(l, s, point[i]))
            return true;
    return false;
}

static int compare_viewers(const void *a, const void *b)
{
    const viewer *p = a, *q = b;

    if (p->square != q->square)
        return p->square < q->square ? -1 : 1;
    return (p->part > q->part) - (p->part < q->part);
}

/* Lists the parts that are farther than `from` (squared) and not farther than `to`, the nearest
 * first. Status. */
static int list_viewers(looking *l, const sighting *s, double from, double to, uint32_t *count)
{
    const nearby_part eye = {.corner = {s->eye, s->eye, s->eye}, .corners = 1};

    *count = 0;
    if (nearby_around(&l->from, s->eye, s->eye, to, &l->around) != PCG_OK ||
        list_room(l->call->run, (void **)&l->viewer, &l->viewer_capacity, 0, l->around.count,
                  sizeof *l->viewer) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < l->around.count; i++) {
        viewer v = {.part = l->around.at[i]};
        pcg_vec3 at;

        v.square = nearby_closest(&eye, &l->from.parts.at[v.part], &at, &v.nearest);
        if (v.square > from && v.square <= to * to)
            l->viewer[(*count)++] = v;
    }
    if (*count > 0)
        qsort(l->viewer, *count, sizeof *l->viewer, compare_viewers);
    return PCG_OK;
}

/* Goes through the parts around from the nearest on, ring by ring. Status. */
static int look(looking *l, sighting *s, bool *visible)
{
    double from = -1;
    int status = PCG_OK;

    *visible = false;
    for (int ring = RINGS; ring-- > 0 && status == PCG_OK && !*visible;) {
        double to = ldexp(l->node->within, -ring);
        uint32_t count;

        status = list_viewers(l, s, from, to, &count);
        for (uint32_t i = 0; i < count && status == PCG_OK && !*visible; i++) {
            *visible = sees_from_part(l, s, &l->viewer[i]);
            status = pcg_tick(l->call);
        }
        from = to * to;
    }
    return status;
}

/* ---- all of them ----------------------------------------------------------------------------- */

static int divide(looking *l, uint32_t number)
{
    pcg_shape *shape = (pcg_shape *)l->node->in.at[number];
    pcg_run *r = l->call->run;
    sighting s = {
        .number = number, .eye = geometry_centre(shape), .normal = geometry_normal(shape)};
    bool visible;
    int status;

    s.looks = vec3_dot(s.normal, s.normal) > 0;
    status = look(l, &s, &visible);
    if (status != PCG_OK)
        return status;
    if (!visible)
        return pcg_emit(l->call, l->node->hidden, &shape->entity);
    pcg_set_int(r, &shape->entity, &l->node->index, s.seen_from);
    pcg_set_float(r, &shape->entity, &l->node->distance, s.distance);
    pcg_set_float(r, &shape->entity, &l->node->angle, s.angle);
    return pcg_emit(l->call, l->node->visible, &shape->entity);
}

static int look_at_all(looking *l)
{
    int status = nearby_reader_open(l->call->run, &l->reader);

    if (status == PCG_OK)
        status = nearby_open(l->call, &l->reader, &l->node->from, &l->from);
    if (status == PCG_OK && l->node->self)
        status = nearby_open(l->call, &l->reader, &l->node->in, &l->self);
    for (uint32_t i = 0; i < l->node->item_count && status == PCG_OK; i++)
        status = nearby_open(l->call, &l->reader, &l->node->items[i].input, &l->blockers[i]);
    for (uint32_t i = 0; i < l->node->in.count && status == PCG_OK; i++)
        status = divide(l, i);
    return status;
}

static void drop_all(pcg_run *r, const pcg_entities *list)
{
    for (uint32_t i = 0; i < list->count; i++)
        pcg_entity_drop(r, list->at[i]);
}

static void close_all(looking *l)
{
    pcg_run *r = l->call->run;

    for (uint32_t i = 0; i < l->node->item_count; i++) {
        nearby_close(&l->blockers[i]);
        drop_all(r, &l->node->items[i].input);
    }
    drop_all(r, &l->node->from);
    run_free(r, l->blockers, l->node->item_count * sizeof *l->blockers);
    run_free(r, l->viewer, l->viewer_capacity * sizeof *l->viewer);
    nearby_list_free(r, &l->around);
    nearby_close(&l->from);
    nearby_close(&l->self);
    nearby_reader_close(&l->reader);
}

int pcg_geometry_visible_from(pcg_call *call, struct pcg_geometry_visible_from *node)
{
    looking l = {.call = call, .node = node};
    int status;

    l.blockers = run_alloc_array(call->run, node->item_count, sizeof *l.blockers);
    if (l.blockers == NULL)
        return PCG_FAILED;
    l.reader.run = call->run;
    status = look_at_all(&l);
    close_all(&l);
    return status;
}

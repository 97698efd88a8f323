/*pcg
/// Divides the faces of a shape among selectors.
///
/// Each face goes to the first selector that takes it; what none takes is left out. What a selector
/// takes leaves through its port as one shape: a single face with a scope of its own (as
/// `decompose` lays it), several with the axes of the shape's scope. A selector that takes nothing
/// sends nothing.
///
/// Directions are along the axes of the shape's scope, or the world's. `top` and `bottom` take
/// faces that look up or down by 45 degrees at least; `front` (-y), `back` (+y), `left` (-x) and
/// `right` (+x) take the others by where they look; `side` takes all that are neither top nor
/// bottom.
procedure select(in: Shape) [pure] {
    category "split"
    synonyms "selection split", "faces", "components", "comp", "filter", "top", "side", "front"
    param frame: Frame = scope                   /// Whose axes directions are along.
    /// How far a face may lean that `vertical` or `horizontal` takes.
    param tolerance: angle = 1deg
    augment top() -> Shape                       /// Faces that look up.
    augment bottom() -> Shape                    /// Faces that look down.
    augment side() -> Shape                      /// Faces that look neither up nor down.
    augment front() -> Shape                     /// Side faces that look along -y.
    augment back() -> Shape                      /// Side faces that look along +y.
    augment left() -> Shape                      /// Side faces that look along -x.
    augment right() -> Shape                     /// Side faces that look along +x.
    augment vertical() -> Shape                  /// Upright faces, within the tolerance.
    augment horizontal() -> Shape                /// Level faces, within the tolerance.
    augment aslant() -> Shape                    /// Faces that are neither upright nor level.
    /// Faces that look along a direction.
    augment facing(
        x: float = 0,                            /// The direction, along x.
        y: float = 0,                            /// Along y.
        z: float = 0,                            /// Along z.
        tolerance: angle = 45deg                 /// How far they may look past it.
    ) -> Shape
    /// Faces by their number.
    augment index(
        first: int,                              /// The first one, from 0; -1 is the last face.
        count: int = 1                           /// How many, from there on.
    ) -> Shape
    /// Faces that have a tag.
    augment tagged(
        name: string                             /// The tag.
    ) -> Shape
    augment largest() -> Shape                   /// The largest of the faces that are left.
    augment smallest() -> Shape                  /// The smallest of the faces that are left.
    augment all() -> Shape                       /// All faces that are left.
    example box(width = 4m, depth = 3m, height = 2m)
        -> select { top; rest: all } expect top.faces = 1, top.area = 12, rest.faces = 5
    example box(width = 4m, depth = 3m, height = 2m)
        -> select { side; bottom } expect side.area = 28, bottom.area = 12
    example box(width = 4m, depth = 3m, height = 2m)
        -> select { front; left; vertical } expect front.area = 8, left.area = 6, vertical.faces = 2
    example box(width = 4m, depth = 3m, height = 2m)
        -> select { facing(x = 1, z = 1); largest } expect facing.faces = 2, largest.area = 12
    example box(width = 4m, depth = 3m, height = 2m)
        -> select { index(first = -1); smallest } expect index.area = 12, smallest.area = 6
}
*/
#include "select.h"

#include <math.h>

#include "geometry.h"
#include "runtime/real.h"

#define NOBODY UINT32_MAX

/* What is known of a face before it is divided. */
typedef struct candidate {
    pcg_vec3 normal; /* of length 1, in the frame; (0, 0, 0) without area */
    double area;
    uint32_t taker; /* number of the selector; NOBODY at first */
} candidate;

typedef struct selection {
    const struct pcg_geometry_select *node;
    candidate *face;
    uint32_t count;
    double level; /* the sine of the tolerance */
} selection;

static const double half = 0.70710678118654752; /* the cosine of 45 degrees */

/* A hair that rounding may cost a face that looks exactly along a border. */
static const double hair = 1e-9;

static void measure(selection *s)
{
    const pcg_shape *in = s->node->in;

    for (uint32_t f = 0; f < s->count; f++) {
        pcg_vec3 n = pcg_shape_face_normal(in, f);

        s->face[f].area = vec3_length(n) / 2;
        n = vec3_normal(n);
        s->face[f].normal =
            s->node->frame == PCG_FRAME_WORLD ? pcg_scope_direction(&in->scope, n) : n;
        s->face[f].taker = NOBODY;
    }
}

static bool looks_up_or_down(pcg_vec3 n)
{
    return fabs(n.z) >= half - hair;
}

static bool is_side(pcg_vec3 n)
{
    return !looks_up_or_down(n) && (n.x != 0 || n.y != 0 || n.z != 0);
}

static bool looks_along(const struct pcg_geometry_select_item *item, pcg_vec3 n)
{
    pcg_vec3 d = vec3_normal(vec3(item->facing.x, item->facing.y, item->facing.z));
    double away = real_acos(fmax(-1, fmin(1, vec3_dot(d, n))));

    return vec3_dot(d, d) > 0 && vec3_dot(n, n) > 0 && away <= item->facing.tolerance + hair;
}

static bool has_number(const selection *s, const struct pcg_geometry_select_item *item,
                       uint32_t face)
{
    pcg_int first = item->index.first < 0 ? item->index.first + s->count : item->index.first;

    return item->index.count > 0 && (pcg_int)face >= first &&
           (pcg_int)face - first < item->index.count;
}

static bool has_tag(const selection *s, const struct pcg_geometry_select_item *item, uint32_t face)
{
    const uint32_t *tag = s->node->in->mesh->face_tag;

    return tag != NULL && tag[face] != 0 && tag[face] == pcg_tag(item->tagged.name);
}

/* Whether a selector takes a face that is still free. */
static bool takes(const selection *s, const struct pcg_geometry_select_item *item, uint32_t face)
{
    pcg_vec3 n = s->face[face].normal;

    switch (item->kind) {
    case PCG_GEOMETRY_SELECT_TOP:
        return n.z >= half - hair;
    case PCG_GEOMETRY_SELECT_BOTTOM:
        return n.z <= hair - half;
    case PCG_GEOMETRY_SELECT_SIDE:
        return is_side(n);
    case PCG_GEOMETRY_SELECT_FRONT:
        return is_side(n) && n.y < 0 && -n.y >= fabs(n.x) - hair;
    case PCG_GEOMETRY_SELECT_BACK:
        return is_side(n) && n.y > 0 && n.y >= fabs(n.x) - hair;
    case PCG_GEOMETRY_SELECT_LEFT:
        return is_side(n) && n.x < 0 && -n.x >= fabs(n.y) - hair;
    case PCG_GEOMETRY_SELECT_RIGHT:
        return is_side(n) && n.x > 0 && n.x >= fabs(n.y) - hair;
    case PCG_GEOMETRY_SELECT_VERTICAL:
        return fabs(n.z) <= s->level + hair && vec3_dot(n, n) > 0;
    case PCG_GEOMETRY_SELECT_HORIZONTAL:
        return real_hypot(n.x, n.y) <= s->level + hair && vec3_dot(n, n) > 0;
    case PCG_GEOMETRY_SELECT_ASLANT:
        return fabs(n.z) > s->level + hair && real_hypot(n.x, n.y) > s->level + hair;
    case PCG_GEOMETRY_SELECT_FACING:
        return looks_along(item, n);
    case PCG_GEOMETRY_SELECT_INDEX:
        return has_number(s, item, face);
    case PCG_GEOMETRY_SELECT_TAGGED:
        return has_tag(s, item, face);
    default:
        return true;
    }
}

/* The largest or smallest of the faces that are free; the first of those that are equal. */
static uint32_t extreme(const selection *s, bool largest)
{
    uint32_t best = NOBODY;

    for (uint32_t f = 0; f < s->count; f++) {
        if (s->face[f].taker != NOBODY)
            continue;
        if (best == NOBODY || (largest ? s->face[f].area > s->face[best].area * (1 + hair)
                                       : s->face[f].area < s->face[best].area * (1 - hair)))
            best = f;
    }
    return best;
}

static void divide(selection *s)
{
    for (uint32_t i = 0; i < s->node->item_count; i++) {
        const struct pcg_geometry_select_item *item = &s->node->items[i];
        bool one =
            item->kind == PCG_GEOMETRY_SELECT_LARGEST || item->kind == PCG_GEOMETRY_SELECT_SMALLEST;
        uint32_t best = one ? extreme(s, item->kind == PCG_GEOMETRY_SELECT_LARGEST) : NOBODY;

        for (uint32_t f = 0; f < s->count; f++)
            if (s->face[f].taker == NOBODY && (one ? f == best : takes(s, item, f)))
                s->face[f].taker = i;
    }
}

/* Sends out what one selector took; `list` has room for all faces. */
static int send(pcg_call *call, const selection *s, uint32_t taker, uint32_t *list)
{
    const pcg_port *port = s->node->items[taker].port;
    uint32_t taken = 0;

    if (port->count == 0)
        return PCG_OK;
    for (uint32_t f = 0; f < s->count; f++)
        if (s->face[f].taker == taker)
            list[taken++] = f;
    if (taken == 0)
        return PCG_OK;
    if (taken == 1)
        return geometry_emit(call, port, pcg_shape_face(call, s->node->in, list[0]));
    return geometry_emit(call, port, pcg_shape_faces(call, s->node->in, list, taken));
}

static int select_faces(pcg_call *call, selection *s)
{
    size_t room = s->count * (sizeof(candidate) + sizeof(uint32_t));
    int status = PCG_OK;

    if ((s->face = run_alloc(call->run, room)) == NULL)
        return PCG_FAILED;
    measure(s);
    divide(s);
    for (uint32_t i = 0; i < s->node->item_count && status == PCG_OK; i++)
        status = send(call, s, i, (uint32_t *)(s->face + s->count));
    run_free(call->run, s->face, room);
    return status;
}

int pcg_geometry_select(pcg_call *call, struct pcg_geometry_select *node)
{
    selection s = {.node = node, .count = node->in->mesh->face_count};
    int status;

    s.level = real_sin(node->tolerance >= 0 && node->tolerance <= 90 ? node->tolerance : 1);
    status = s.count > 0 ? select_faces(call, &s) : PCG_OK;
    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

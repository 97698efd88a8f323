/*pcg
/// Makes a street from the points of its centre line, in turn.
///
/// A point that repeats the one before is left out; less than two points make nothing, with a
/// warning. The result is one way; `merge_streets` and `blend_streets` join it to others.
procedure street() -> (out: StreetNetwork) [pure] {
    category "create"
    synonyms "road", "path", "way", "centre line", "polyline"
    param width: length = 6m              /// Of the roadway.
    param sidewalk: length = 0m           /// Of the sidewalks on both sides.
    param sidewalk_left: length = -1m     /// Of the sidewalk on the left; below 0: as `sidewalk`.
    param sidewalk_right: length = -1m    /// Of the sidewalk on the right; below 0: as `sidewalk`.
    param level: int = 0                  /// 0 is the ground; bridges lie above, tunnels below.
    param name: string = ""               /// What it is called.
    param kind: string = ""               /// What it is: "residential", say.
    param id: string = ""                 /// Its number in the data that it comes from.
    augment vertex(x: length, y: length, z: length = 0m)   /// A point of the centre line.
    example street(width = 5m) { vertex(0m, 0m); vertex(30m, 0m) } -> t: street_to_shape() expect t.streets.area = 150
}
*/
#include "streets.h"
#include "street.h"

static bool same_place(pcg_vec3 a, pcg_vec3 b)
{
    return a.x == b.x && a.y == b.y;
}

static int add_points(pcg_call *call, const struct pcg_streets_street *node, street_drawing *d)
{
    for (uint32_t i = 0; i < node->item_count; i++) {
        pcg_vec3 at = {node->items[i].vertex.x, node->items[i].vertex.y, node->items[i].vertex.z};

        if (!streets_is_place(at)) {
            int status =
                pcg_warn(call, "point %u is left out: it is too far away, or no number", i + 1);
            if (status != PCG_OK)
                return status;
        } else if ((d->vertices == 0 || !same_place(at, d->vertex[d->vertices - 1])) &&
                   drawing_add_vertex(call->run, d, at) == UINT32_MAX) {
            return PCG_FAILED;
        }
    }
    return PCG_OK;
}

static int fill(pcg_call *call, const struct pcg_streets_street *node, street_drawing *d)
{
    street_way way = {.width = node->width,
                      .left = node->sidewalk_left < 0 ? node->sidewalk : node->sidewalk_left,
                      .right = node->sidewalk_right < 0 ? node->sidewalk : node->sidewalk_right,
                      .level = node->level,
                      .name = node->name,
                      .kind = node->kind,
                      .id = node->id};
    int status = add_points(call, node, d);

    if (status != PCG_OK || drawing_add_way(call->run, d, &way) == UINT32_MAX)
        return status != PCG_OK ? status : PCG_FAILED;
    for (uint32_t i = 1; i < d->vertices; i++)
        if (drawing_add_edge(call->run, d, i - 1, i, 0) == UINT32_MAX)
            return PCG_FAILED;
    return PCG_OK;
}

int pcg_streets_street(pcg_call *call, struct pcg_streets_street *node)
{
    pcg_streets *s = streets_new(call, NULL);
    int status;

    if (s == NULL)
        return PCG_FAILED;
    status = fill(call, node, s->drawing);
    if (status == PCG_OK && s->drawing->edges > 0)
        return streets_emit(call, node->out, s);
    if (status == PCG_OK)
        status = pcg_warn(call, "a street of less than two points is left out");
    pcg_entity_drop(call->run, &s->entity);
    return status;
}

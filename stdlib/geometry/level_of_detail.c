/*pcg
/// Divides shapes by how far they are from a viewer: what is near is worth more detail.
///
/// The distance is that to the box around the shape, along the axes of the world, and 0 inside of it. A shape
/// leaves through the first level that it is near enough for; the last one is usually written without `until`,
/// and takes what is left. What is too far for all of them is left out. A shape without a vertex is at its scope's
/// origin.
procedure level_of_detail(in: Shape) [pure] {
    category "flow"
    synonyms "lod", "distance", "viewer", "camera", "simplify", "near", "far"
    param viewer: vec3 = [0, 0, 0]               /// Where it is looked from, in metres in the world.
    attr distance: length                        /// Written: how far the shape is.
    /// One level.
    augment level(
        until: length = 1000000km                /// The farthest that takes it.
    ) -> Shape
    example box(width = 1m, depth = 1m, height = 1m) -> copy(count = 5, index => @n) -> translate(x = 10m * @n)
        -> l: level_of_detail(viewer = [-1, 0.5, 0.5], distance => @far) { near: level(until = 11m); middle: level(until = 30m); far: level } expect l.near.count = 2, l.middle.count = 1, l.far.count = 2
}
*/
#include "level_of_detail.h"

#include <math.h>

#include "geometry.h"

static double outside(double at, double low, double high)
{
    return fmax(0, fmax(low - at, at - high));
}

static double distance_to(const pcg_shape *s, pcg_vec3 viewer)
{
    pcg_vec3 low, high;

    if (!pcg_shape_bounds(s, &low, &high))
        low = high = s->scope.origin;
    return vec3_length(vec3(outside(viewer.x, low.x, high.x), outside(viewer.y, low.y, high.y),
                            outside(viewer.z, low.z, high.z)));
}

int pcg_geometry_level_of_detail(pcg_call *call, struct pcg_geometry_level_of_detail *node)
{
    double distance = distance_to(node->in, node->viewer);

    pcg_set_float(call->run, &node->in->entity, &node->distance, distance);
    for (uint32_t i = 0; i < node->item_count; i++)
        if (distance <= node->items[i].level.until)
            return pcg_emit(call, node->items[i].port, &node->in->entity);
    pcg_entity_drop(call->run, &node->in->entity);
    return PCG_OK;
}

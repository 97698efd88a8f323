/*pcg
/// Gives a shape, or one face of it, a material: how its surface looks under light.
///
/// The model is that of glTF: a base colour, how metallic and how rough the surface is. A texture
/// that the shape has stays, unless `keep_texture` is off.
procedure material<T: Faced>(in: T) -> (out: T) [pure] {
    category "look"
    synonyms "pbr", "surface", "shader", "metal", "glass"
    /// The base colour; with an alpha below 1 it is translucent.
    param color: color = #ffffff
    param metallic: ratio = 0% range [0%, 100%] /// 100% for bare metal.
    param roughness: ratio = 90% range [0%, 100%] /// 0% for a mirror.
    param two_sided: bool = false                             /// Seen from behind, too.
    param keep_texture: bool = true /// Keep the texture that the shape has.
    /// What it is called in the files that are written.
    param name: string = ""
    example rectangle(width = 2m, height = 3m)
        -> material(color = #88aacc, metallic = 100%, roughness = 20%) expect faces = 1, area = 6
}
*/
#include "runtime/shape.h"
#include "stdlib/geometry/look.h"
#include "material.h"

static double clamped(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

static pcg_material made_over(const pcg_material *from, const void *context)
{
    const struct pcg_geometry_material *node = context;
    return (pcg_material){.name = node->name,
                          .color = node->color,
                          .texture = node->keep_texture ? from->texture : NULL,
                          .metallic = clamped(node->metallic),
                          .roughness = clamped(node->roughness),
                          .two_sided = node->two_sided};
}

int pcg_geometry_material(pcg_call *call, struct pcg_geometry_material *node)
{
    if (look_change(call, node->in, made_over, node) != PCG_OK)
        return PCG_FAILED;
    return pcg_emit(call, node->out, node->in);
}

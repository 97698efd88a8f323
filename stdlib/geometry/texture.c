/*pcg
/// Puts an image on a shape, or on one face of it.
///
/// How it lies on the faces is up to `map_uv_faces` or `map_uv_box`, before or behind this node.
/// The colour becomes white, so that the image shows as it is, unless `keep_color` is on. Where
/// there is no such file, a warning says so and the shape goes on as it was.
procedure texture<T: Faced>(in: T) -> (out: T) [reads, one_to_one] {
    category "look"
    synonyms "image", "texture material", "bitmap", "picture"
    param file: path                      /// A JPEG or PNG file, looked up beside the graph's file.
    param keep_color: bool = false        /// Tints the image with the colour that the shape has.
    example rectangle(width = 2m, height = 3m)
        -> texture(file = "examples/assets/walls/brick.jpg") expect faces = 1, area = 6
}
*/
#include <unistd.h>

#include "runtime/shape.h"
#include "stdlib/geometry/look.h"
#include "texture.h"

typedef struct texturing {
    const char *file;
    int keep_color;
} texturing;

static pcg_material textured(const pcg_material *from, const void *context)
{
    const texturing *t = context;
    pcg_material m = *from;
    m.texture = t->file;
    if (!t->keep_color)
        m.color = (pcg_color){1, 1, 1, 1};
    return m;
}

/* What was last looked for: a city asks for the same few files again and again. */
typedef struct looked_up {
    const char *asked, *found; /* `found` NULL: there is no such file, and that was told */
} looked_up;

static int find_file(pcg_call *call, struct pcg_geometry_texture *node, const char **found)
{
    looked_up *last = call->instance->state;
    if (!last && !(last = call->instance->state = pcg_alloc(call->run, sizeof *last)))
        return PCG_FAILED;
    int status = PCG_OK;
    const char *asked = pcg_string(call->run, node->file);
    if (!asked)
        return PCG_FAILED;
    if (last->asked != asked) {
        last->asked = asked;
        last->found = pcg_path(call, asked);
        if (!last->found)
            return PCG_FAILED;
        if (access(last->found, R_OK) != 0) {
            last->found = NULL;
            status = pcg_warn_once(call, "no image file '%s'", asked);
        }
    }
    *found = last->found;
    return status;
}

int pcg_geometry_texture(pcg_call *call, struct pcg_geometry_texture *node)
{
    texturing t = {.keep_color = node->keep_color};
    int status = find_file(call, node, &t.file);
    if (status != PCG_OK)
        return status;
    if (t.file && look_change(call, node->in, textured, &t) != PCG_OK)
        return PCG_FAILED;
    return pcg_emit(call, node->out, node->in);
}

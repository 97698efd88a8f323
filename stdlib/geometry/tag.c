/*pcg
/// Gives all faces of a shape, or one face, a tag, by which `select` finds them again.
///
/// A face has one tag; it keeps it through splits, offsets, merges and as the displaced face of an
/// extrusion. An empty name takes the tags away.
procedure tag<T: Faced>(in: T) -> (out: T) [pure, one_to_one] {
    category "look"
    synonyms "label", "mark", "name", "group"
    param name: string       /// The tag.
    example box()
        -> tag(name = "old")
        -> extrude(amount = 1m)
        -> select { tagged(name = "old"); rest: all } expect tagged.faces = 6, rest.faces = 30
}
*/
#include "tag.h"
#include "geometry.h"
#include "runtime/part.h"

/* Of the faces from `first` on. */
static int set_tags(pcg_run *r, pcg_shape *s, uint32_t first, uint32_t count, uint32_t tag)
{
    pcg_mesh *m;

    if (tag == 0 && s->mesh->face_tag == NULL)
        return PCG_OK;
    if ((m = pcg_shape_edit(r, s)) == NULL || pcg_mesh_need_tags(r, m) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t f = first; f < first + count; f++)
        m->face_tag[f] = tag;
    return PCG_OK;
}

static int set_tag(pcg_call *call, pcg_entity *e, uint32_t tag)
{
    pcg_part *face = (pcg_part *)e;

    if (e->type != &pcg_type_face)
        return set_tags(call->run, (pcg_shape *)e, 0, ((pcg_shape *)e)->mesh->face_count, tag);
    if (part_shape(face) == NULL)
        return part_warn_lost(call, face);
    return set_tags(call->run, face->shape, face->index, 1, tag);
}

int pcg_geometry_tag(pcg_call *call, struct pcg_geometry_tag *node)
{
    if (set_tag(call, node->in, node->name[0] != '\0' ? pcg_tag(node->name) : 0) == PCG_OK)
        return pcg_emit(call, node->out, node->in);
    pcg_entity_drop(call->run, node->in);
    return PCG_FAILED;
}

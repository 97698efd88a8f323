/*pcg
/// Changes ways of a street network: their widths, sidewalks, levels and kinds.
///
/// Each `ways` applies to those ways whose kind, name and id are as it says, `""` being any; they
/// are taken in their order, so that a later one may change what an earlier one has set. What is
/// left at its default stays as it is.
procedure set_street(in: StreetNetwork) -> (out: StreetNetwork) [pure, one_to_one] {
    category "streets"
    synonyms "width", "lanes", "sidewalk", "assign", "change"
    /// What is set for some ways, or all.
    augment ways(
        kind: string = "",               /// Only ways of this kind.
        name: string = "",               /// Only ways of this name.
        id: string = "",                 /// Only the ways with this id.
        width: length = -1m,             /// Of the roadway; below 0: as it is.
        sidewalk: length = -1m,          /// Of the sidewalks on both sides; below 0: as they are.
        sidewalk_left: length = -1m,     /// Of the one on the left; below 0: as it is, or as `sidewalk` says.
        sidewalk_right: length = -1m,    /// Of the one on the right; below 0: as it is, or as `sidewalk` says.
        rename: string = "",             /// A new name; "": as it is.
        new_kind: string = ""            /// A new kind; "": as it is.
    )
    example street(width = 5m, kind = "path") { vertex(0m, 0m); vertex(10m, 0m) }
        -> set_street { ways(kind = "path", width = 2m); ways(kind = "primary", width = 9m) }
        -> t: street_to_shape() expect t.streets.area = 20
}
*/
#include <string.h>

#include "streets.h"
#include "set_street.h"

typedef struct pcg_streets_set_street_item item;

static bool is_wanted(const char *wanted, const char *found)
{
    return wanted[0] == '\0' || strcmp(wanted, found) == 0;
}

static void change(street_way *way, const item *i)
{
    if (!is_wanted(i->ways.kind, way->kind) || !is_wanted(i->ways.name, way->name) ||
        !is_wanted(i->ways.id, way->id))
        return;
    if (i->ways.width >= 0)
        way->width = i->ways.width;
    if (i->ways.sidewalk >= 0)
        way->left = way->right = i->ways.sidewalk;
    if (i->ways.sidewalk_left >= 0)
        way->left = i->ways.sidewalk_left;
    if (i->ways.sidewalk_right >= 0)
        way->right = i->ways.sidewalk_right;
    if (i->ways.rename[0] != '\0')
        way->name = i->ways.rename;
    if (i->ways.new_kind[0] != '\0')
        way->kind = i->ways.new_kind;
}

int pcg_streets_set_street(pcg_call *call, struct pcg_streets_set_street *node)
{
    street_drawing *d = streets_edit(call->run, (pcg_streets *)node->in);

    if (d == NULL) {
        pcg_entity_drop(call->run, node->in);
        return PCG_FAILED;
    }
    for (uint32_t i = 0; i < node->item_count; i++)
        for (uint32_t w = 0; w < d->ways; w++)
            change(&d->way[w], &node->items[i]);
    return pcg_emit(call, node->out, node->in);
}

/*pcg
/// Puts all street networks into one.
///
/// Nothing is joined or cut by it: streets that cross are told so by `blend_streets`. The result has
/// the attributes of the first network; an empty list makes an empty network.
procedure merge_streets(in: StreetNetwork[]) -> (out: StreetNetwork) [pure] {
    category "join"
    synonyms "merge", "join", "combine", "collect", "unite", "network"
    example rectangle() -> copy(count = 3) -> streets_from_shapes() -> merge_streets() expect count = 1
}
*/
#include <string.h>

#include "streets.h"
#include "merge_streets.h"

/* How many of each there are in all; false where that is too many to be numbered. */
static bool count_all(const pcg_entities *in, uint32_t *vertices, uint32_t *edges, uint32_t *ways)
{
    uint64_t sums[3] = {0, 0, 0};

    for (uint32_t i = 0; i < in->count; i++) {
        const street_drawing *d = ((const pcg_streets *)in->at[i])->drawing;

        sums[0] += d->vertices;
        sums[1] += d->edges;
        sums[2] += d->ways;
    }
    *vertices = (uint32_t)sums[0];
    *edges = (uint32_t)sums[1];
    *ways = (uint32_t)sums[2];
    return sums[0] < UINT32_MAX / 2 && sums[1] < UINT32_MAX / 2 && sums[2] < UINT32_MAX / 2;
}

/* Room was made. */
static void append(street_drawing *to, const street_drawing *from)
{
    if (from->vertices > 0)
        memcpy(to->vertex + to->vertices, from->vertex, from->vertices * sizeof *to->vertex);
    if (from->ways > 0)
        memcpy(to->way + to->ways, from->way, from->ways * sizeof *to->way);
    for (uint32_t i = 0; i < from->edges; i++) {
        street_edge e = from->edge[i];

        to->edge[to->edges + i] =
            (street_edge){e.from + to->vertices, e.to + to->vertices, e.way + to->ways};
    }
    to->vertices += from->vertices;
    to->edges += from->edges;
    to->ways += from->ways;
}

static pcg_streets *merge_all(pcg_call *call, const pcg_entities *in)
{
    pcg_streets *s = streets_new(call, in->count > 0 ? in->at[0] : NULL);
    uint32_t vertices, edges, ways;
    street_drawing *d;

    if (s == NULL)
        return NULL;
    if (!count_all(in, &vertices, &edges, &ways))
        pcg_fail(call, "the networks have too many edges to be one");
    else if ((d = drawing_new(call->run, vertices, edges, ways)) != NULL) {
        for (uint32_t i = 0; i < in->count; i++)
            append(d, ((const pcg_streets *)in->at[i])->drawing);
        streets_set(call->run, s, d);
        return s;
    }
    pcg_entity_drop(call->run, &s->entity);
    return NULL;
}

int pcg_streets_merge_streets(pcg_call *call, struct pcg_streets_merge_streets *node)
{
    pcg_streets *s = merge_all(call, &node->in);

    for (uint32_t i = 0; i < node->in.count; i++)
        pcg_entity_drop(call->run, node->in.at[i]);
    return streets_emit(call, node->out, s);
}

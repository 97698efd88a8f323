/*pcg
/// Takes a shape apart: into its faces, edges, vertices, pieces, or what is of one material.
///
/// A face gets a scope of its own: z along its normal, x level and to the right as seen from
/// outside, y up; on a level face x and y follow the shape's scope. An edge gets x along itself.
/// Pieces are what hangs together by vertices in one place. The parts come in the order in which
/// the shape holds them. They are shapes of their own: what is done to them is not done to the
/// shape that they come from. `parts` takes a shape apart by reference.
procedure decompose(in: Shape) -> (out: Shape) [pure] {
    category "split"
    synonyms "explode", "components", "faces", "comp", "separate", "parts"
    param into: Part = faces  /// What the parts are.
    attr index: int           /// Written: the number of the part, from 0.
    attr count: int           /// Written: how many parts there are.
    example box(width = 4m, depth = 3m, height = 2m)
        -> decompose() expect count = 6, faces = 6, area = 52
    example box() -> decompose(into = edges) expect count = 12, faces = 0
    example box() -> decompose(into = vertices) expect count = 8, vertices = 8
    example box() -> decompose(into = connected) expect count = 1, faces = 6
}

/// What a shape is taken apart into.
enum Part {
    faces       /// Each face.
    edges       /// Each edge, those of faces and loose ones, once.
    vertices    /// Each place that a vertex is in, once.
    connected   /// What hangs together.
    materials   /// The faces of each material.
}
*/
#include "decompose.h"
#include "geometry.h"
#include "runtime/mesh.h"
#include "runtime/topology.h"

/* One part leaves. */
static int emit_part(pcg_call *call, const struct pcg_geometry_decompose *node, pcg_shape *part,
                     uint32_t index, uint32_t count)
{
    int status;

    if (part == NULL)
        return PCG_FAILED;
    pcg_set_int(call->run, &part->entity, &node->index, index);
    pcg_set_int(call->run, &part->entity, &node->count, count);
    status = geometry_emit(call, node->out, part);
    return status == PCG_OK ? pcg_tick(call) : status;
}

static int emit_faces(pcg_call *call, const struct pcg_geometry_decompose *node)
{
    uint32_t count = node->in->mesh->face_count;
    int status = PCG_OK;

    for (uint32_t f = 0; f < count && status == PCG_OK; f++)
        status = emit_part(call, node, pcg_shape_face(call, node->in, f), f, count);
    return status;
}

/* ---- edges and vertices ---------------------------------------------------------------------- */

/* A shape of one edge or, where both ends are the same, one vertex. */
static pcg_shape *loose_part(pcg_call *call, const pcg_shape *s, uint32_t a, uint32_t b)
{
    pcg_shape *part = pcg_shape_new(call, &s->entity);

    if (part != NULL && shape_become_edge(call->run, s, a, b, part) != PCG_OK) {
        pcg_entity_drop(call->run, &part->entity);
        return NULL;
    }
    return part;
}

static int emit_edges(pcg_call *call, const struct pcg_geometry_decompose *node)
{
    edge_list list;
    int status = edge_list_open(call->run, node->in, &list);

    for (uint32_t i = 0; i < list.count && status == PCG_OK; i++)
        status = emit_part(call, node, loose_part(call, node->in, list.at[i].a, list.at[i].b), i,
                           list.count);
    edge_list_close(call->run, node->in, &list);
    return status;
}

static int emit_vertices(pcg_call *call, const struct pcg_geometry_decompose *node)
{
    uint32_t vertices = node->in->mesh->vertex_count, count = 0, index = 0;
    uint32_t *first = weld(call->run, node->in);
    int status = first != NULL ? PCG_OK : PCG_FAILED;

    for (uint32_t v = 0; v < vertices && status == PCG_OK; v++)
        count += first[v] == v;
    for (uint32_t v = 0; v < vertices && status == PCG_OK; v++)
        if (first[v] == v)
            status = emit_part(call, node, loose_part(call, node->in, v, v), index++, count);
    weld_free(call->run, node->in, first);
    return status;
}

/* ---- groups of faces ------------------------------------------------------------------------- */

/* For each face, the number of its group, from 0 in the order in which groups first appear; and how
 * many there are. */
typedef struct grouping {
    uint32_t *group;
    uint32_t count;
} grouping;

static int group_by_material(pcg_run *r, const pcg_shape *s, grouping *g)
{
    const pcg_material **seen = run_alloc(r, (size_t)s->mesh->face_count * sizeof *seen);

    if (seen == NULL)
        return PCG_FAILED;
    for (uint32_t f = 0; f < s->mesh->face_count; f++) {
        const pcg_material *m = pcg_shape_face_material(s, f);
        uint32_t i = 0;

        while (i < g->count && seen[i] != m)
            i++;
        if (i == g->count)
            seen[g->count++] = m;
        g->group[f] = i;
    }
    run_free(r, (void *)seen, (size_t)s->mesh->face_count * sizeof *seen);
    return PCG_OK;
}

/* The faces of one group after the other, and where each group ends. */
static int sort_groups(pcg_run *r, const grouping *g, uint32_t faces, uint32_t *sorted,
                       uint32_t **end)
{
    uint32_t *at = run_alloc_array(r, (size_t)g->count + 1, sizeof *at);

    if (at == NULL)
        return PCG_FAILED;
    for (uint32_t f = 0; f < faces; f++)
        at[g->group[f] + 1]++;
    for (uint32_t i = 0; i < g->count; i++)
        at[i + 1] += at[i];
    for (uint32_t f = 0; f < faces; f++)
        sorted[at[g->group[f]]++] = f;
    *end = at;
    return PCG_OK;
}

static int emit_sorted(pcg_call *call, const struct pcg_geometry_decompose *node, const grouping *g,
                       uint32_t *sorted)
{
    uint32_t *end = NULL, from = 0;
    int status = sort_groups(call->run, g, node->in->mesh->face_count, sorted, &end);

    for (uint32_t i = 0; i < g->count && status == PCG_OK; from = end[i++])
        status = emit_part(
            call, node, pcg_shape_faces(call, node->in, sorted + from, end[i] - from), i, g->count);
    run_free(call->run, end, ((size_t)g->count + 1) * sizeof *end);
    return status;
}

static int emit_groups(pcg_call *call, const struct pcg_geometry_decompose *node)
{
    size_t room = 2 * (size_t)node->in->mesh->face_count * sizeof(uint32_t);
    grouping g = {.group = run_alloc(call->run, room)};
    int status = PCG_FAILED;

    if (g.group == NULL)
        return PCG_FAILED;
    if (node->into == PCG_PART_MATERIALS)
        status = group_by_material(call->run, node->in, &g);
    else
        status = group_connected(call->run, node->in, g.group, &g.count);
    if (status == PCG_OK)
        status = emit_sorted(call, node, &g, g.group + node->in->mesh->face_count);
    run_free(call->run, g.group, room);
    return status;
}

int pcg_geometry_decompose(pcg_call *call, struct pcg_geometry_decompose *node)
{
    int status;

    if (node->into == PCG_PART_FACES && node->in->mesh == &pcg_mesh_square &&
        geometry_is_upright(&node->in->scope))
        return emit_part(call, node, node->in, 0, 1); /* it is its only part already */
    if (node->into == PCG_PART_FACES)
        status = emit_faces(call, node);
    else if (node->into == PCG_PART_EDGES)
        status = emit_edges(call, node);
    else if (node->into == PCG_PART_VERTICES)
        status = emit_vertices(call, node);
    else
        status = emit_groups(call, node);
    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

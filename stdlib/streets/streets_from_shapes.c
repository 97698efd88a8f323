/*pcg
/// Makes streets of a shape's lines: of its loose edges, and of the outlines and holes of its faces.
///
/// What a street is, its parameters say, for each shape anew, so that attributes become widths and
/// names: `width = @width, name = @name`. All streets of a shape are one way. Nothing is joined:
/// `merge_streets` puts the networks into one, and `blend_streets` finds where they meet. Edges
/// without length, or too far away, are left out; where nothing is left, with a warning.
procedure streets_from_shapes(in: Shape) -> (out: StreetNetwork) [pure] {
    category "create"
    synonyms "shape to street", "roads", "osm", "lines", "boundaries", "network"
    param width: length = 6m              /// Of the roadway; without one there is no street, but a line that bounds lots.
    param sidewalk: length = 0m           /// Of the sidewalks on both sides.
    param sidewalk_left: length = -1m     /// Of the sidewalk on the left; below 0: as `sidewalk`.
    param sidewalk_right: length = -1m    /// Of the sidewalk on the right; below 0: as `sidewalk`.
    param level: int = 0                  /// 0 is the ground; bridges lie above, tunnels below.
    param name: string = ""               /// What it is called.
    param kind: string = ""               /// What it is: "residential", say.
    param id: string = ""                 /// Its number in the data that it comes from.
    example rectangle(width = 40m, height = 30m) -> streets_from_shapes(width = 4m)
        -> t: street_to_shape() expect t.streets.area = 560, t.lots.area = 936
}
*/
#include <math.h>

#include "streets.h"
#include "streets_from_shapes.h"

typedef struct drawer {
    pcg_run *run;
    const pcg_shape *shape;
    street_drawing *drawing;
    uint32_t *vertex; /* of each vertex of the mesh that is drawn, + 1 */
} drawer;

static uint32_t vertex_of(drawer *w, uint32_t from)
{
    if (w->vertex[from] == 0)
        w->vertex[from] =
            1 + drawing_add_vertex(w->run, w->drawing, pcg_shape_world(w->shape, from));
    return w->vertex[from] - 1;
}

static int draw_edge(drawer *w, uint32_t a, uint32_t b)
{
    pcg_vec3 p = pcg_shape_world(w->shape, a), q = pcg_shape_world(w->shape, b);
    uint32_t from, to;

    if (!streets_is_place(p) || !streets_is_place(q) || (p.x == q.x && p.y == q.y))
        return PCG_OK;
    from = vertex_of(w, a);
    to = vertex_of(w, b);
    if (from == UINT32_MAX || to == UINT32_MAX ||
        drawing_add_edge(w->run, w->drawing, from, to, 0) == UINT32_MAX)
        return PCG_FAILED;
    return PCG_OK;
}

static int draw_loops(drawer *w)
{
    const pcg_mesh *m = w->shape->mesh;

    for (uint32_t l = 0; l < m->loop_count; l++)
        for (uint32_t c = m->loop_corner[l], end = m->loop_corner[l + 1]; c < end; c++) {
            uint32_t next = c + 1 < end ? c + 1 : m->loop_corner[l];

            if (draw_edge(w, m->corner_vertex[c], m->corner_vertex[next]) != PCG_OK)
                return PCG_FAILED;
        }
    return PCG_OK;
}

static int draw_lines(drawer *w)
{
    const pcg_mesh *m = w->shape->mesh;

    for (uint32_t i = 0; i < m->edge_count; i++)
        if (draw_edge(w, m->edge_vertex[2 * (size_t)i], m->edge_vertex[2 * (size_t)i + 1]) !=
            PCG_OK)
            return PCG_FAILED;
    return PCG_OK;
}

static int draw(pcg_call *call, const struct pcg_streets_streets_from_shapes *node,
                street_drawing *d)
{
    drawer w = {.run = call->run, .shape = node->in, .drawing = d};
    size_t size = (node->in->mesh->vertex_count + (size_t)1) * sizeof *w.vertex;
    street_way way = {.width = node->width,
                      .left = node->sidewalk_left < 0 ? node->sidewalk : node->sidewalk_left,
                      .right = node->sidewalk_right < 0 ? node->sidewalk : node->sidewalk_right,
                      .level = node->level,
                      .name = node->name,
                      .kind = node->kind,
                      .id = node->id};
    int status = PCG_FAILED;

    w.vertex = run_alloc_zeroed(call->run, size);
    if (w.vertex != NULL && drawing_add_way(call->run, d, &way) != UINT32_MAX)
        status = draw_loops(&w);
    if (status == PCG_OK)
        status = draw_lines(&w);
    run_free(call->run, w.vertex, size);
    return status;
}

int pcg_streets_streets_from_shapes(pcg_call *call, struct pcg_streets_streets_from_shapes *node)
{
    pcg_streets *s = streets_new(call, &node->in->entity);
    int status = s != NULL ? draw(call, node, s->drawing) : PCG_FAILED;

    pcg_entity_drop(call->run, &node->in->entity);
    if (status == PCG_OK && s->drawing->edges > 0)
        return streets_emit(call, node->out, s);
    if (status == PCG_OK)
        status = pcg_warn(call, "the shape has no lines that could be streets");
    if (s != NULL)
        pcg_entity_drop(call->run, &s->entity);
    return status;
}

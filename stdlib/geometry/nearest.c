/*pcg
/// Finds for each shape the nearest of others, and how it lies to that.
///
/// The distance is between the two points that are nearest to each other, on faces, loose edges and
/// loose vertices; of several others equally near, the first of the list is taken. `angle` is
/// between where the shape's faces look on the whole and the way to that point: a wall that faces a
/// street has a small one, a wall behind the house more than 90 degrees. Where both touch, or the
/// shape's faces look nowhere on the whole, it is 0. Where nothing is within reach, `index` is -1
/// and all else stays as it was. All shapes leave, in their order.
procedure nearest(in: Shape[], to: Shape[]?) -> (out: Shape) [pure] {
    category "context"
    synonyms "closest", "distance", "street", "neighbour", "proximity", "near", "find"
    param within: length = 1000km   /// How far is looked.
    attr index: int                 /// Written: the number of the nearest in its list, from 0; -1: none.
    attr distance: length           /// Written: how far it is; 0 where they touch or cross.
    attr angle: angle               /// Written: between where the shape looks and the way to the nearest.
    attr point: vec3                /// Written: where the nearest is nearest, in the world.
    attr direction: vec3            /// Written: the way there, of length 1; (0, 0, 0) where they touch.
    /// Only those count whose value of an attribute is another: other houses' walls, say.
    augment different(
        key: attribute              /// What must differ.
    )
    /// Copies an attribute of the nearest: its name, say. An enumeration only to the same attribute.
    augment copy(
        from: attribute,            /// Of the nearest.
        to: attribute               /// Of the shape: the same one, or one of the same type.
    )
    example rectangle(width = 4m, height = 3m) -> near.in;
        rectangle(width = 1m, height = 1m) -> copy(count = 5, index => @n) -> translate(x = 10m * (5 - @n)) -> near.to;
        near: nearest(distance => @far, index => @i) -> c: condition(@far == 6m && @i == 4) expect c.yes.count = 1
    example box() -> select { side } -> decompose() -> near.in; rectangle(width = 1m, height = 1m) -> translate(x = 3m) -> near.to;
        near: nearest(angle => @away) -> c: condition(@away < 30deg) expect c.yes.count = 1, c.no.count = 3
}
*/
#include "nearest.h"

#include <string.h>

#include "nearby.h"
#include "runtime/value.h"

/* A degenerate way is no direction: metres. */
static const double hair = 1e-9;

typedef struct asking {
    pcg_call *call;
    const struct pcg_geometry_nearest *node;
    const pcg_entity *shape; /* that is asked about */
    nearby_reader reader;
    nearby others;
    nearby_parts parts; /* of the shape */
    nearby_filter filter;
} asking;

/* ---- items ----------------------------------------------------------------------------------- */

/* Whether another shape differs from the one that is asked about in all that must differ. */
static bool differs(const void *user, uint32_t owner)
{
    const asking *a = user;

    for (uint32_t i = 0; i < a->node->item_count; i++) {
        const struct pcg_geometry_nearest_item *item = &a->node->items[i];

        if (item->kind == PCG_GEOMETRY_NEAREST_DIFFERENT &&
            geometry_same_value(&item->different.key, a->shape, a->node->to.at[owner]))
            return false;
    }
    return true;
}

/* Whether a value of one attribute can be that of another as it stands. The kind does not say which
 * enumeration it is of. */
static bool can_copy(const pcg_slot *from, const pcg_slot *to)
{
    bool is_text = from->kind == PCG_STRING || from->kind == PCG_PATH;

    if (from->cell == to->cell)
        return true;
    if (from->kind == PCG_LIST && to->kind == PCG_LIST)
        return from->element == to->element && from->element != PCG_ENUM;
    return (from->kind == to->kind && from->kind != PCG_ENUM) ||
           (is_text && (to->kind == PCG_STRING || to->kind == PCG_PATH)) ||
           (value_is_float(to->kind) && (from->kind == PCG_INT || value_is_float(from->kind)));
}

static int check_items(pcg_call *call, const struct pcg_geometry_nearest *node)
{
    for (uint32_t i = 0; i < node->item_count; i++) {
        const pcg_slot *from = &node->items[i].copy.from, *to = &node->items[i].copy.to;

        if (node->items[i].kind == PCG_GEOMETRY_NEAREST_COPY && !can_copy(from, to))
            return pcg_fail(call, "'%s' cannot copy: %s does not become %s", node->items[i].name,
                            value_kind_name(from->kind), value_kind_name(to->kind));
    }
    return PCG_OK;
}

static void copy_attributes(const asking *a, pcg_entity *to, const pcg_entity *from)
{
    for (uint32_t i = 0; i < a->node->item_count; i++) {
        const pcg_slot *read = &a->node->items[i].copy.from, *written = &a->node->items[i].copy.to;
        pcg_cell value[4]; /* of its own: both may be one entity */

        if (a->node->items[i].kind != PCG_GEOMETRY_NEAREST_COPY)
            continue;
        memcpy(value, pcg_get(from, read), value_width(read->kind) * sizeof *value);
        if (read->kind == PCG_INT)
            pcg_set_int(a->call->run, to, written, value->i);
        else
            pcg_set_cells(a->call->run, to, written, value);
    }
}

static bool has_different(const struct pcg_geometry_nearest *node)
{
    for (uint32_t i = 0; i < node->item_count; i++)
        if (node->items[i].kind == PCG_GEOMETRY_NEAREST_DIFFERENT)
            return true;
    return false;
}

/* ---- asking ---------------------------------------------------------------------------------- */

static void set_vector(pcg_run *r, pcg_entity *e, const pcg_slot *slot, pcg_vec3 v)
{
    const pcg_cell cells[3] = {{.f = v.x}, {.f = v.y}, {.f = v.z}};

    pcg_set_cells(r, e, slot, cells);
}

static void write_hit(const asking *a, pcg_shape *s, const nearby_hit *hit)
{
    const struct pcg_geometry_nearest *node = a->node;
    pcg_run *r = a->call->run;
    pcg_entity *e = &s->entity;
    pcg_vec3 way = vec3_subtract(hit->at, hit->from);

    way = hit->distance > hair ? vec3_normal(way) : vec3(0, 0, 0);
    pcg_set_int(r, e, &node->index, hit->owner);
    pcg_set_float(r, e, &node->distance, hit->distance);
    pcg_set_float(r, e, &node->angle, geometry_angle(geometry_normal(s), way));
    set_vector(r, e, &node->point, hit->at);
    set_vector(r, e, &node->direction, way);
    copy_attributes(a, e, node->to.at[hit->owner]);
}

static int ask(asking *a, pcg_shape *s)
{
    nearby_hit hit;

    a->shape = &s->entity;
    a->parts.count = 0;
    if (nearby_read(&a->reader, s, 0, &a->parts) != PCG_OK)
        return PCG_FAILED;
    if (nearby_nearest(&a->others, &a->parts, &a->filter, a->node->within, &hit))
        write_hit(a, s, &hit);
    else
        pcg_set_int(a->call->run, &s->entity, &a->node->index, -1);
    return pcg_tick(a->call);
}

static int ask_all(asking *a)
{
    int status = nearby_reader_open(a->call->run, &a->reader);

    if (status == PCG_OK)
        status = nearby_open(a->call, &a->reader, &a->node->to, &a->others);
    for (uint32_t i = 0; i < a->node->in.count && status == PCG_OK; i++)
        status = ask(a, (pcg_shape *)a->node->in.at[i]);
    nearby_parts_free(a->call->run, &a->parts);
    nearby_close(&a->others);
    nearby_reader_close(&a->reader);
    return status;
}

int pcg_geometry_nearest(pcg_call *call, struct pcg_geometry_nearest *node)
{
    asking a = {.call = call, .node = node};
    int status = check_items(call, node);

    a.filter = (nearby_filter){has_different(node) ? differs : NULL, &a};
    if (status == PCG_OK)
        status = ask_all(&a);
    for (uint32_t i = 0; i < node->to.count; i++)
        pcg_entity_drop(call->run, node->to.at[i]);
    for (uint32_t i = 0; i < node->in.count && status == PCG_OK; i++)
        status = pcg_emit(call, node->out, node->in.at[i]);
    return status;
}

/*pcg
/// Cuts a shape into slices along an axis of its scope.
///
/// The slices come one after the other, from the axis's origin on. An absolute one has a fixed
/// size, a relative one a share of the whole extent, and flexible ones share by weight what these
/// leave over. What reaches beyond the extent is cut off there; without `repeat`, what no slice
/// takes is left out.
///
/// With `repeat` all the slices repeat as a pattern as often as they fit. If none of them is
/// flexible, `leftover` says what becomes of the rest. A pattern that does not fit even once is
/// squeezed in, cut, or left out, likewise.
///
/// Faces are cut, not closed: a slice of a box is a tube. A slice gets a scope of its own, with the
/// same axes, around what is in it; slices without size are passed over, those in which nothing of
/// the shape is are numbered but send nothing. Along an axis on which the shape is flat it cannot
/// be cut: it is dropped, with a warning. Loose edges and vertices are left out.
procedure split(in: Shape) [pure] {
    category "split"
    synonyms "slice", "cut", "divide", "subdivide", "floors", "tiles", "repeat"
    param axis: Axis = x                          /// The axis of the scope that it is cut along.
    param repeat: bool = false                    /// Repeat the slices as long as they fit.
    param leftover: Leftover = stretch            /// With `repeat`: what becomes of the rest.
    attr slice_index: int                         /// Written: the number of the slice, from 0.
    attr slice_count: int                         /// Written: how many slices there are.
    /// A slice of a fixed size.
    augment absolute(
        size: length                              /// In metres.
    ) -> Shape
    /// A share of the whole extent.
    augment relative(
        share: ratio                              /// 50% is half of it.
    ) -> Shape
    /// Takes what the others leave over.
    augment flexible(
        weight: float = 1                         /// Its share, against other flexible ones.
    ) -> Shape
    example rectangle(width = 10m, height = 3m)
        -> split(axis = x) { a: absolute(2m); b: flexible } expect a.area = 6, b.area = 24
    example rectangle(width = 10m, height = 3m)
        -> split(axis = x) { a: relative(30%); b: absolute(2m) } expect a.area = 9, b.area = 6
    example rectangle(width = 10m, height = 3m)
        -> split { a: flexible(1); b: absolute(1m); c: flexible(2) } expect a.area = 9, c.area = 18
    example rectangle(width = 15m, height = 4m)
        -> split(axis = x, repeat = true) { absolute(2.5m) } expect count = 6, area = 60
    example rectangle(width = 11m, height = 1m)
        -> split(repeat = true, leftover = cut) { absolute(2m) } expect count = 6, area = 11
    example rectangle(width = 11m, height = 1m)
        -> split(repeat = true, leftover = drop) { absolute(2m) } expect count = 5, area = 10
    example rectangle(width = 11.5m, height = 1m)
        -> split(repeat = true) { pier: absolute(1m); bay: flexible } expect pier.area = 11
    example box(width = 4m, depth = 3m, height = 2m)
        -> split(axis = z) { a: absolute(1m); b: flexible } expect a.faces = 5, area = 52
}

/// What becomes of what a repeated pattern leaves over.
enum Leftover {
    stretch    /// The slices share it in proportion, so that they fill the whole.
    cut        /// The pattern goes on and is cut at the end.
    drop       /// It is left out.
}
*/
#include "split.h"

#include <math.h>

#include "geometry.h"
#include "runtime/list.h"
#include "runtime/mesh.h"
#include "runtime/mesh_slice.h"

enum { SPLIT_MAX_SLICES = 10000000 };

/* What is taken to be rounding, of a number of patterns and of an extent. */
static const double hair = 1e-9;

/* Where the slices are: the pattern begins `patterns` times, every `length`; slice i of it begins
 * at begin[i]. */
typedef struct layout {
    double extent;
    double *begin; /* one more than there are items: the last is the length of the pattern */
    double patterns;
} layout;

typedef struct slice {
    uint32_t item;
    double from, to;
    double size; /* that, without the rounding of places: slices of one item are equal */
} slice;

typedef struct slice_list {
    slice *at;
    uint32_t count, capacity;
} slice_list;

/* ---- layout ---------------------------------------------------------------------------------- */

/* The size that an item asks for; 0 for a flexible one. Status. */
static int fixed_size(pcg_call *call, const struct pcg_geometry_split_item *item, double extent,
                      double *size)
{
    *size = 0;
    if (item->kind == PCG_GEOMETRY_SPLIT_FLEXIBLE)
        return PCG_OK;
    *size = item->kind == PCG_GEOMETRY_SPLIT_ABSOLUTE ? item->absolute.size
                                                      : item->relative.share * extent;
    if (*size >= 0 && isfinite(*size))
        return PCG_OK;
    int status = pcg_warn(call, "slice '%s' has a size of %g m: it is left out", item->name, *size);
    *size = 0;
    return status;
}

static double weight_of(const struct pcg_geometry_split_item *item)
{
    double weight = item->kind == PCG_GEOMETRY_SPLIT_FLEXIBLE ? item->flexible.weight : 0;

    return weight > 0 && isfinite(weight) ? weight : 0;
}

/* How often a pattern of the given length is laid, and what it is stretched by. */
static double count_patterns(const struct pcg_geometry_split *node, double extent, double length,
                             bool flexible, double *stretch)
{
    double fit = floor(extent / length * (1 + hair) + hair);

    *stretch = 1;
    if (!node->repeat || !(length > 0))
        return 1;
    if (flexible)
        return fit > 1 ? fit : 1;
    if (node->leftover == PCG_LEFTOVER_DROP)
        return fit;
    if (node->leftover == PCG_LEFTOVER_CUT)
        return ceil(extent / length * (1 - hair) - hair);
    fit = fit > 1 ? fit : 1;
    *stretch = extent / (fit * length);
    return fit;
}

/* Fills in the sizes of the items in turn, and then where each begins. */
static int lay_out(pcg_call *call, const struct pcg_geometry_split *node, layout *l)
{
    double length = 0, weights = 0, stretch, rest, at = 0;
    int status = PCG_OK;

    for (uint32_t i = 0; i < node->item_count && status == PCG_OK; i++) {
        status = fixed_size(call, &node->items[i], l->extent, &l->begin[i]);
        length += l->begin[i];
        weights += weight_of(&node->items[i]);
    }
    l->patterns = count_patterns(node, l->extent, length, weights > 0, &stretch);
    rest = l->patterns > 0 ? l->extent / l->patterns - length : 0;
    for (uint32_t i = 0; i < node->item_count; i++) {
        double size = l->begin[i] * stretch;

        if (weights > 0 && rest > 0)
            size += rest * (weight_of(&node->items[i]) / weights);
        l->begin[i] = at;
        at += size;
    }
    l->begin[node->item_count] = at;
    return status;
}

/* The size of an item, when it is what was measured but for rounding. */
static double size_of(const layout *l, uint32_t item, double measured)
{
    double size = l->begin[item + 1] - l->begin[item];

    return fabs(size - measured) <= 4 * hair * l->extent ? size : measured;
}

static int list_slices(pcg_run *r, const struct pcg_geometry_split *node, const layout *l,
                       slice_list *list)
{
    double end = l->extent * (1 - hair), length = l->begin[node->item_count];

    for (double turn = 0; turn < l->patterns && turn * length < end; turn++)
        for (uint32_t i = 0; i < node->item_count; i++) {
            double from = turn * length + l->begin[i], to = turn * length + l->begin[i + 1];

            to = to > end ? l->extent : to;
            if (!(to - from > 4 * hair * l->extent) || from >= end)
                continue;
            if (list_room(r, (void **)&list->at, &list->capacity, list->count, 1,
                          sizeof *list->at) != PCG_OK)
                return PCG_FAILED;
            list->at[list->count++] = (slice){i, from, to, size_of(l, i, to - from)};
        }
    return PCG_OK;
}

/* ---- slices of the unit square --------------------------------------------------------------- */

static double *size_along(pcg_vec3 *size, int axis)
{
    return axis == PCG_AXIS_X ? &size->x : axis == PCG_AXIS_Y ? &size->y : &size->z;
}

static int emit_slice(pcg_call *call, const struct pcg_geometry_split *node, const slice_list *list,
                      uint32_t i, pcg_shape *s)
{
    int status;

    if (s == NULL)
        return PCG_FAILED;
    pcg_set_int(call->run, &s->entity, &node->slice_index, i);
    pcg_set_int(call->run, &s->entity, &node->slice_count, list->count);
    status = geometry_emit(call, node->items[list->at[i].item].port, s);
    return status == PCG_OK ? pcg_tick(call) : status;
}

/* A slice of a rectangle is one again: only its scope is new. */
static pcg_shape *slice_of_square(pcg_call *call, const struct pcg_geometry_split *node,
                                  const slice *cut)
{
    pcg_shape *s = pcg_shape_new(call, &node->in->entity);

    if (s == NULL)
        return NULL;
    s->mesh = pcg_mesh_hold(&pcg_mesh_square);
    s->scope.origin = vec3_add(s->scope.origin, vec3_scale(s->scope.axis[node->axis], cut->from));
    *size_along(&s->scope.size, node->axis) = cut->size;
    return s;
}

static int split_square(pcg_call *call, const struct pcg_geometry_split *node,
                        const slice_list *list)
{
    int status = PCG_OK;

    for (uint32_t i = 0; i < list->count && status == PCG_OK; i++)
        if (node->items[list->at[i].item].port->count > 0)
            status = emit_slice(call, node, list, i, slice_of_square(call, node, &list->at[i]));
    return status;
}

/* ---- slices of any mesh ---------------------------------------------------------------------- */

/* The faces of each slab, one slab after the other, and where each ends. */
typedef struct slab_faces {
    uint32_t *face, *end;
    uint32_t faces, slabs;
} slab_faces;

static int sort_faces(pcg_run *r, const slices *cut, slab_faces *s)
{
    s->face = run_alloc(r, s->faces * sizeof *s->face);
    s->end = run_alloc_array(r, (size_t)s->slabs + 1, sizeof *s->end);
    if (s->face == NULL || s->end == NULL)
        return PCG_FAILED;
    for (uint32_t f = 0; f < s->faces; f++)
        s->end[cut->slab[f] + 1]++;
    for (uint32_t i = 0; i < s->slabs; i++)
        s->end[i + 1] += s->end[i];
    for (uint32_t f = 0; f < s->faces; f++)
        s->face[s->end[cut->slab[f]]++] = f;
    return PCG_OK;
}

static int emit_slabs(pcg_call *call, const struct pcg_geometry_split *node, const slice_list *list,
                      const slab_faces *s)
{
    uint32_t from = 0;
    int status = PCG_OK;

    for (uint32_t i = 0; i < list->count && i < s->slabs && status == PCG_OK; i++) {
        if (s->end[i] > from && node->items[list->at[i].item].port->count > 0)
            status = emit_slice(call, node, list, i,
                                shape_extract(call, node->in, s->face + from, s->end[i] - from));
        from = s->end[i];
    }
    return status;
}

/* Puts the pieces in the place of the shape's mesh, which is of no use any more, and takes them out
 * slab by slab. */
static int emit_pieces(pcg_call *call, const struct pcg_geometry_split *node,
                       const slice_list *list, const slices *cut, uint32_t planes)
{
    slab_faces s = {.faces = cut->pieces->face_count, .slabs = planes + 1};
    int status = sort_faces(call->run, cut, &s);

    pcg_shape_set_mesh(call->run, node->in, pcg_mesh_hold(cut->pieces));
    if (status == PCG_OK)
        status = emit_slabs(call, node, list, &s);
    run_free(call->run, s.face, s.faces * sizeof *s.face);
    run_free(call->run, s.end, ((size_t)s.slabs + 1) * sizeof *s.end);
    return status;
}

/* The planes between slices, and behind the last one where something is left over. */
static uint32_t list_planes(const slice_list *list, double extent, double *plane)
{
    uint32_t count = 0;

    for (uint32_t i = 1; i < list->count; i++)
        plane[count++] = list->at[i].from;
    if (list->at[list->count - 1].to < extent * (1 - hair))
        plane[count++] = list->at[list->count - 1].to;
    return count;
}

static int split_mesh(pcg_call *call, const struct pcg_geometry_split *node, const slice_list *list,
                      double extent)
{
    size_t room = list->count * sizeof(double);
    double *plane = run_alloc(call->run, room);
    uint32_t planes;
    slices cut;
    int status;

    if (plane == NULL)
        return PCG_FAILED;
    planes = list_planes(list, extent, plane);
    status = slices_open(call, node->in, node->axis, plane, planes, &cut);
    if (status == PCG_OK)
        status = emit_pieces(call, node, list, &cut, planes);
    slices_close(call->run, &cut);
    run_free(call->run, plane, room);
    return status;
}

/* ---- the procedure --------------------------------------------------------------------------- */

static int split_slices(pcg_call *call, const struct pcg_geometry_split *node, const layout *l)
{
    slice_list list = {NULL, 0, 0};
    int status;

    if (l->patterns * node->item_count > SPLIT_MAX_SLICES)
        return pcg_warn(call, "%g slices are too many: the shape is dropped",
                        l->patterns * node->item_count);
    status = list_slices(call->run, node, l, &list);
    if (status == PCG_OK && list.count > 0)
        status = node->in->mesh == &pcg_mesh_square ? split_square(call, node, &list)
                                                    : split_mesh(call, node, &list, l->extent);
    run_free(call->run, list.at, list.capacity * sizeof *list.at);
    return status;
}

static int split_shape(pcg_call *call, const struct pcg_geometry_split *node)
{
    layout l = {.extent = geometry_component(node->in->scope.size, node->axis)};
    size_t room = ((size_t)node->item_count + 1) * sizeof *l.begin;
    int status;

    if (node->in->mesh->face_count == 0 || node->item_count == 0)
        return PCG_OK;
    if (!(l.extent > 0))
        return pcg_warn(call, "the shape is flat along %c: it cannot be split there",
                        "xyz"[node->axis]);
    if ((l.begin = run_alloc(call->run, room)) == NULL)
        return PCG_FAILED;
    status = lay_out(call, node, &l);
    if (status == PCG_OK)
        status = split_slices(call, node, &l);
    run_free(call->run, l.begin, room);
    return status;
}

int pcg_geometry_split(pcg_call *call, struct pcg_geometry_split *node)
{
    int status = split_shape(call, node);

    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

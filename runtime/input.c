/* input.c - a host feeds the input gates of a run. */
#include <math.h>
#include <string.h>

#include "mesh.h"
#include "run.h"
#include "shape.h"
#include "value.h"

/* What the host gave: n of each, in arrays that are the host's. */
typedef struct given_mesh {
    const double *points;
    size_t point_count;
    const uint32_t *counts;
    size_t face_count;
    const uint32_t *corners;
} given_mesh;

/* ---- checking ------------------------------------------------------------------------------- */

static pcg_status find_gate(pcg_run *r, const char *gate, const pcg_port_info **found)
{
    const pcg_module *m = r->module;
    if (!gate)
        return run_misuse(r, "no input is named");
    if (r->stage != RUN_NEW)
        return run_misuse(r, "inputs are fed before the run is executed, '%s' comes too late",
                          gate);
    if (r->status != PCG_OK)
        return (pcg_status)r->status;
    for (pcg_u32 i = 0; i < m->input_count; i++)
        if (!strcmp(m->inputs[i].name, gate)) {
            *found = &m->inputs[i];
            return PCG_STATUS_OK;
        }
    return run_misuse(r, "graph '%s' has no input '%s'", m->name, gate);
}

static pcg_status check_points(pcg_run *r, const given_mesh *g)
{
    if (g->point_count && !g->points)
        return run_misuse(r, "there are %zu points, but points is NULL", g->point_count);
    if (g->point_count > UINT32_MAX / 4)
        return run_misuse(r, "%zu points are too many", g->point_count);
    for (size_t i = 0; i < 3 * g->point_count; i++)
        if (!isfinite(g->points[i]))
            return run_misuse(r, "point %zu has no finite position", i / 3);
    return PCG_STATUS_OK;
}

static pcg_status check_face(pcg_run *r, const given_mesh *g, size_t face, size_t first)
{
    for (size_t i = first; i < first + g->counts[face]; i++)
        if (g->corners[i] >= g->point_count)
            return run_misuse(r, "face %zu has a corner at point %u, there are %zu points", face,
                              g->corners[i], g->point_count);
    return PCG_STATUS_OK;
}

static pcg_status check_faces(pcg_run *r, const given_mesh *g)
{
    size_t corners = 0;
    if (g->face_count && (!g->counts || !g->corners))
        return run_misuse(r, "there are %zu faces, but %s is NULL", g->face_count,
                          g->counts ? "corners" : "counts");
    if (!g->face_count)
        return run_misuse(r, "a shape needs a face");
    for (size_t f = 0; f < g->face_count; f++) {
        if (g->counts[f] < 3)
            return run_misuse(r, "face %zu has %u corner%s, a face needs 3", f, g->counts[f],
                              g->counts[f] == 1 ? "" : "s");
        if (corners + g->counts[f] > UINT32_MAX / 4)
            return run_misuse(r, "the faces have too many corners");
        pcg_status status = check_face(r, g, f, corners);
        if (status != PCG_STATUS_OK)
            return status;
        corners += g->counts[f];
    }
    return PCG_STATUS_OK;
}

/* Of that type, or of one that Shape derives from. */
static bool takes_shapes(const char *type)
{
    for (const pcg_type *t = &pcg_type_shape; t; t = t->parent)
        if (!strcmp(type, t->name))
            return true;
    return false;
}

/* A shape fits through the gate. */
static pcg_status find_shape_gate(pcg_run *r, const char *gate, const pcg_port_info **found)
{
    pcg_status status = find_gate(r, gate, found);
    if (status == PCG_STATUS_OK && !takes_shapes((*found)->type))
        status = run_misuse(r, "input '%s' takes %s, not a shape", gate, (*found)->type);
    return status;
}

/* ---- checking views ------------------------------------------------------------------------- */

static bool all_finite(const float *at, size_t count)
{
    for (size_t i = 0; at && i < count; i++)
        if (!isfinite(at[i]))
            return false;
    return true;
}

static bool all_below(const uint32_t *at, size_t count, size_t end)
{
    for (size_t i = 0; i < count; i++)
        if (at[i] >= end)
            return false;
    return true;
}

/* A list of count + 1 numbers from 0 to `last`, each at least `least` above the one before. */
static bool divides(const uint32_t *at, size_t count, size_t last, uint32_t least)
{
    if (!at || at[0] != 0 || at[count] != last)
        return false;
    for (size_t i = 0; i < count; i++)
        if (at[i + 1] < at[i] || at[i + 1] - at[i] < least)
            return false;
    return true;
}

static pcg_status check_streams(pcg_run *r, const pcg_mesh_view *v, size_t material_count)
{
    if (!all_finite(v->uvs, 2 * v->corner_count))
        return run_misuse(r, "uvs holds a number that is not finite");
    if (!all_finite(v->normals, 3 * v->corner_count))
        return run_misuse(r, "normals holds a number that is not finite");
    if (v->face_materials && !all_below(v->face_materials, v->face_count, material_count))
        return run_misuse(r, "face_materials names a material that is not among the %zu given",
                          material_count);
    return PCG_STATUS_OK;
}

static pcg_status check_view(pcg_run *r, const pcg_mesh_view *v, size_t material_count)
{
    const given_mesh points = {.points = v->points, .point_count = v->point_count};
    pcg_status status = check_points(r, &points);
    if (status != PCG_STATUS_OK)
        return status;
    if (!v->face_count && !v->edge_count)
        return run_misuse(r, "a shape needs a face or an edge");
    if (v->corner_count > UINT32_MAX / 4 || v->edge_count > UINT32_MAX / 4)
        return run_misuse(r, "the shape has too many corners or edges");
    if (v->face_count && !divides(v->face_loops, v->face_count, v->loop_count, 1))
        return run_misuse(r, "face_loops does not divide %zu loops among %zu faces", v->loop_count,
                          v->face_count);
    if (v->face_count && !divides(v->loop_corners, v->loop_count, v->corner_count, 3))
        return run_misuse(r, "loop_corners does not divide %zu corners among %zu loops, 3 at least",
                          v->corner_count, v->loop_count);
    if (v->face_count &&
        (!v->corner_points || !all_below(v->corner_points, v->corner_count, v->point_count)))
        return run_misuse(r, "corner_points names a point that is not among the %zu given",
                          v->point_count);
    if (v->edge_count && (!v->edges || !all_below(v->edges, 2 * v->edge_count, v->point_count)))
        return run_misuse(r, "edges names a point that is not among the %zu given",
                          v->point_count);
    return check_streams(r, v, material_count);
}

/* ---- feeding -------------------------------------------------------------------------------- */

/* NULL where memory has run out. */
static pcg_mesh *make_mesh(pcg_run *r, const given_mesh *g)
{
    pcg_mesh *m = pcg_mesh_new(r, false);
    const uint32_t *corners = g->corners;
    bool good = m != NULL;
    for (size_t i = 0; good && i < g->point_count; i++) {
        const double *p = g->points + 3 * i;
        good = pcg_mesh_add_vertex(r, m, vec3(p[0], p[1], p[2])) != UINT32_MAX;
    }
    for (size_t f = 0; good && f < g->face_count; f++) {
        good = pcg_mesh_add_face(r, m, corners, g->counts[f]) != UINT32_MAX;
        corners += g->counts[f];
    }
    if (!good && m)
        pcg_mesh_drop(r, m);
    return good ? m : NULL;
}

/* A shape of that mesh (NULL: none, memory has run out). The host's entities have lines of descent
 * of their own, by the order in which they came. */
static pcg_shape *make_shape(pcg_run *r, pcg_mesh *m)
{
    static const pcg_u64 host_key = 0x686F7374; /* "host" */
    pcg_call call = {.run = r, .key = host_key, .lineage = r->fed++};
    pcg_shape *s = m ? pcg_shape_new(&call, NULL) : NULL;
    if (!s && m)
        pcg_mesh_drop(r, m);
    if (!s)
        return NULL;
    pcg_shape_set_mesh(r, s, m);
    return pcg_shape_fit(r, s) == PCG_OK ? s : NULL;
}

static pcg_status feed(pcg_run *r, const pcg_port_info *port, pcg_shape *s)
{
    if (!s || pcg_queue_push(r, run_at(r, port->queue), &s->entity) != PCG_OK)
        return (pcg_status)r->status;
    *(pcg_u8 *)run_at(r, port->given) = 1;
    r->newest_fed = &s->entity;
    return PCG_STATUS_OK;
}

pcg_status pcg_run_input_mesh(pcg_run *r, const char *gate, const double *points,
                              size_t point_count, const uint32_t *counts, size_t face_count,
                              const uint32_t *corners)
{
    const given_mesh g = {points, point_count, counts, face_count, corners};
    const pcg_port_info *port = NULL;
    pcg_status status = find_shape_gate(r, gate, &port);
    if (status == PCG_STATUS_OK)
        status = check_points(r, &g);
    if (status == PCG_STATUS_OK)
        status = check_faces(r, &g);
    return status == PCG_STATUS_OK ? feed(r, port, make_shape(r, make_mesh(r, &g))) : status;
}

/* ---- feeding views -------------------------------------------------------------------------- */

/* Status. */
static int add_faces(pcg_run *r, pcg_mesh *m, const pcg_mesh_view *v)
{
    for (size_t f = 0; f < v->face_count; f++)
        for (uint32_t l = v->face_loops[f]; l < v->face_loops[f + 1]; l++) {
            const uint32_t *at = v->corner_points + v->loop_corners[l];
            uint32_t count = v->loop_corners[l + 1] - v->loop_corners[l];
            uint32_t added = l == v->face_loops[f] ? pcg_mesh_add_face(r, m, at, count)
                                                   : pcg_mesh_add_hole(r, m, at, count);
            if (added == UINT32_MAX)
                return PCG_FAILED;
        }
    return PCG_OK;
}

static int add_points_and_edges(pcg_run *r, pcg_mesh *m, const pcg_mesh_view *v)
{
    for (size_t i = 0; i < v->point_count; i++) {
        const double *p = v->points + 3 * i;
        if (pcg_mesh_add_vertex(r, m, vec3(p[0], p[1], p[2])) == UINT32_MAX)
            return PCG_FAILED;
    }
    for (size_t i = 0; i < v->edge_count; i++)
        if (pcg_mesh_add_edge(r, m, v->edges[2 * i], v->edges[2 * i + 1]) == UINT32_MAX)
            return PCG_FAILED;
    return PCG_OK;
}

static int add_streams(pcg_run *r, pcg_mesh *m, const pcg_mesh_view *v)
{
    if (v->uvs) {
        if (pcg_mesh_need_uvs(r, m) != PCG_OK)
            return PCG_FAILED;
        memcpy(m->corner_uv, v->uvs, 2 * v->corner_count * sizeof *v->uvs);
    }
    if (v->normals) {
        if (pcg_mesh_need_normals(r, m) != PCG_OK)
            return PCG_FAILED;
        memcpy(m->corner_normal, v->normals, 3 * v->corner_count * sizeof *v->normals);
    }
    return PCG_OK;
}

static double within(double low, double x, double high)
{
    return x > low ? x < high ? x : high : low;
}

/* The run's own of what the host described; of an older host some is missing. */
static const pcg_material *take_material(pcg_run *r, const pcg_material_view *given)
{
    pcg_material_view v = {.name = "", .color = {1, 1, 1, 1}, .roughness = 1};
    memcpy(&v, given, given->size < sizeof v ? given->size : sizeof v);
    const pcg_material m = {
        .name = v.name && value_is_utf8(v.name) ? v.name : "",
        .color = {within(0, v.color[0], 1), within(0, v.color[1], 1), within(0, v.color[2], 1),
                  within(0, v.color[3], 1)},
        .texture = v.texture && *v.texture ? v.texture : NULL,
        .metallic = within(0, v.metallic, 1),
        .roughness = within(0, v.roughness, 1),
        .two_sided = v.two_sided,
    };
    return pcg_material_intern(r, &m);
}

/* The materials stand behind each other at the size that the host knows. */
static const pcg_material_view *nth(const pcg_material_view *first, size_t i)
{
    return (const pcg_material_view *)((const char *)first + i * first->size);
}

static int add_materials(pcg_run *r, pcg_shape *s, const pcg_mesh_view *v,
                         const pcg_material_view *materials, size_t count)
{
    if (!count)
        return PCG_OK;
    const pcg_material **own = run_alloc_array(r, count, sizeof *own);
    bool good = own != NULL;
    for (size_t i = 0; good && i < count; i++)
        good = (own[i] = take_material(r, nth(materials, i))) != NULL;
    if (good)
        s->material = own[0];
    if (good && v->face_materials && v->face_count) {
        good = pcg_mesh_need_materials(r, s->mesh) == PCG_OK;
        for (size_t f = 0; good && f < v->face_count; f++)
            s->mesh->face_material[f] = own[v->face_materials[f]];
    }
    run_free(r, (void *)own, count * sizeof *own);
    return good ? PCG_OK : PCG_FAILED;
}

/* NULL where memory has run out. */
static pcg_shape *shape_of_view(pcg_run *r, const pcg_mesh_view *v,
                                const pcg_material_view *materials, size_t count)
{
    pcg_mesh *m = pcg_mesh_new(r, false);
    if (m && (add_points_and_edges(r, m, v) != PCG_OK || add_faces(r, m, v) != PCG_OK ||
              add_streams(r, m, v) != PCG_OK)) {
        pcg_mesh_drop(r, m);
        m = NULL;
    }
    pcg_shape *s = make_shape(r, m);
    return s && add_materials(r, s, v, materials, count) == PCG_OK ? s : NULL;
}

pcg_status pcg_run_input_shape(pcg_run *r, const char *gate, const pcg_mesh_view *mesh,
                               const pcg_material_view *materials, size_t material_count)
{
    pcg_mesh_view v = {0};
    const pcg_port_info *port = NULL;
    pcg_status status = find_shape_gate(r, gate, &port);
    if (status == PCG_STATUS_OK && !mesh)
        status = run_misuse(r, "there is no mesh");
    if (status == PCG_STATUS_OK && material_count && (!materials || !materials->size))
        status = run_misuse(r, "there are %zu materials, but %s", material_count,
                            materials ? "their size is 0" : "materials is NULL");
    if (status != PCG_STATUS_OK)
        return status;
    memcpy(&v, mesh, mesh->size < sizeof v ? mesh->size : sizeof v);
    status = check_view(r, &v, material_count);
    if (status != PCG_STATUS_OK)
        return status;
    return feed(r, port, shape_of_view(r, &v, materials, material_count));
}

/* ---- attributes ----------------------------------------------------------------------------- */

/* The attribute, where it may be set now; otherwise NULL, and *status. */
static const pcg_attribute_info *find_attribute(pcg_run *r, const char *name, pcg_status *status)
{
    *status = (pcg_status)r->status;
    if (!name)
        *status = run_misuse(r, "no attribute is named");
    else if (r->stage != RUN_NEW)
        *status = run_misuse(
            r, "attributes are set before the run is executed, '%s' comes too late", name);
    else if (!r->newest_fed)
        *status = run_misuse(r, "attribute '%s' is set before a shape was fed", name);
    if (*status != PCG_STATUS_OK)
        return NULL;
    for (pcg_u32 i = 0; i < r->module->attribute_count; i++)
        if (!strcmp(r->module->attributes[i].name, name))
            return &r->module->attributes[i];
    *status = run_misuse(r, "graph '%s' has no attribute '%s'", r->module->name, name);
    return NULL;
}

static pcg_status write_attribute(pcg_run *r, const pcg_attribute_info *a, const pcg_cell *from)
{
    pcg_cell *to = pcg_attribute_write(r, r->newest_fed, (int)a->cell, a->kind);
    if (to)
        memcpy(to, from, value_width(a->kind) * sizeof *to);
    return (pcg_status)r->status;
}

pcg_status pcg_run_input_attribute(pcg_run *r, const char *name, const char *value)
{
    char why[VALUE_WHY_BYTES];
    pcg_cell cell[4] = {{0}};
    pcg_status status;
    const pcg_attribute_info *a = find_attribute(r, name, &status);
    if (!a)
        return status;
    if (!value)
        return run_misuse(r, "attribute '%s' needs a value", name);
    const value_type t = {.kind = a->kind, .element = a->element, .enumerators = a->enumerators};
    if (value_read(r, &t, value, cell, why))
        return write_attribute(r, a, cell);
    return r->status != PCG_OK ? (pcg_status)r->status
                               : run_misuse(r, "attribute '%s' %s", name, why);
}

pcg_status pcg_run_input_attribute_float(pcg_run *r, const char *name, double value)
{
    pcg_cell cell = {.f = value};
    pcg_status status;
    const pcg_attribute_info *a = find_attribute(r, name, &status);
    if (!a)
        return status;
    if (!isfinite(value))
        return run_misuse(r, "attribute '%s' takes a finite number", name);
    if (value_is_float(a->kind))
        return write_attribute(r, a, &cell);
    if (a->kind != PCG_INT || !(fabs(value) <= 9007199254740992.0)) /* 2^53: whole numbers */
        return run_misuse(r, "attribute '%s' is of type %s, not %.17g", name, a->type, value);
    cell.i = (pcg_int)value;
    return write_attribute(r, a, &cell);
}

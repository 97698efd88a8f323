/*pcg
/// Thickens a shape as one skin: faces that share an edge stay joined.
///
/// Where `extrude` grows a prism of its own from every face, this moves all faces together: a
/// vertex goes where its faces, each moved by the amount along its normal, meet again, and only
/// open borders get sides. A folded roof becomes a plate of even thickness. Vertices at one place
/// count as one. Outward the shape itself, turned round, closes the body; inward it leaves its
/// place open. Texture coordinates are given up. Faces without area, loose edges and loose vertices
/// are left out.
procedure special_extrude(in: Shape) -> (out: Shape) [pure, one_to_one] {
    category "model"
    synonyms "thicken", "shell", "solidify", "plate", "offset surface"
    param amount: length = 1m        /// Thickness; a negative one pushes inward.
    param cap: bool = true           /// Keep the displaced faces.
    param base: bool = true          /// Keep the shape itself, turned round, when it grows outward.
    example rectangle(width = 4m, height = 3m)
        -> special_extrude(amount = 2m) expect faces = 6, volume = 24
    example rectangle(width = 4m, height = 3m)
        -> special_extrude(amount = 2m, cap = false) expect faces = 5, area = 40
    example box(width = 2m, depth = 2m, height = 2m)
        -> special_extrude(amount = 1m, base = false) expect faces = 6, volume = 64
}
*/
#include <math.h>
#include <string.h>

#include "geometry.h"
#include "runtime/mesh.h"
#include "special_extrude.h"

/* No vertex moves further than this many amounts: between faces that fold back on each other it
 * would go to infinity. */
static const double farthest = 4;
/* A face that is turned by less than this (as a sine) against those before it adds no condition
 * of its own. */
static const double parallel = 1e-6;

/* Up to three directions at right angles: what the faces at a vertex have fixed so far, and
 * where it goes. */
typedef struct displacement {
    pcg_vec3 fixed[3], by;
    uint32_t count;
} displacement;

typedef struct skin {
    pcg_call *call;
    const pcg_shape *from;
    double amount;
    bool cap, base;
    uint32_t *place; /* a vertex to the first one at its place */
    uint32_t *place_slots;
    pcg_u64 *edges;      /* directed edges between places, by hash; 0 is empty */
    displacement *moves; /* of a place */
    uint32_t *loop;      /* room for the vertices of the longest loop */
    uint32_t slot_count; /* of both tables: a power of two */
    pcg_mesh *to;
    uint32_t *
        added; /* by vertex, then by displaced vertex: its number in `to` and 1; 0 while it is not needed */
} skin;

/* ---- places and edges ------------------------------------------------------------------------ */

static pcg_u64 bits_of(double x)
{
    pcg_u64 bits;
    x += 0.0; /* -0 is 0 */
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void find_places(skin *k)
{
    const pcg_mesh *m = k->from->mesh;
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        pcg_vec3 p = m->position[v];
        uint32_t slot = (uint32_t)pcg_mix(pcg_mix(bits_of(p.x), bits_of(p.y)), bits_of(p.z)) &
                        (k->slot_count - 1);
        for (; k->place_slots[slot]; slot = (slot + 1) & (k->slot_count - 1)) {
            pcg_vec3 d = vec3_subtract(m->position[k->place_slots[slot] - 1], p);
            if (d.x == 0 && d.y == 0 && d.z == 0)
                break;
        }
        if (!k->place_slots[slot])
            k->place_slots[slot] = v + 1;
        k->place[v] = k->place_slots[slot] - 1;
    }
}

/* The slot of a directed edge, or the empty one where it would stand. */
static pcg_u64 *edge_slot(const skin *k, uint32_t a, uint32_t b)
{
    pcg_u64 key = ((pcg_u64)a + 1) << 32 | b;
    uint32_t slot = (uint32_t)pcg_mix(key, 0) & (k->slot_count - 1);
    while (k->edges[slot] && k->edges[slot] != key)
        slot = (slot + 1) & (k->slot_count - 1);
    return &k->edges[slot];
}

static pcg_vec3 face_normal(const skin *k, uint32_t face)
{
    return vec3_normal(pcg_shape_face_normal(k->from, face));
}

static bool has_area(const skin *k, uint32_t face)
{
    pcg_vec3 n = face_normal(k, face);
    return vec3_dot(n, n) > 0;
}

/* The place of the corner behind c in its loop. */
static uint32_t next_place(const skin *k, uint32_t loop, uint32_t c)
{
    const pcg_mesh *m = k->from->mesh;
    return k
        ->place[m->corner_vertex[c + 1 < m->loop_corner[loop + 1] ? c + 1 : m->loop_corner[loop]]];
}

static void find_edges(skin *k)
{
    const pcg_mesh *m = k->from->mesh;
    for (uint32_t f = 0; f < m->face_count; f++) {
        if (!has_area(k, f))
            continue;
        for (uint32_t l = m->face_loop[f]; l < m->face_loop[f + 1]; l++)
            for (uint32_t c = m->loop_corner[l]; c < m->loop_corner[l + 1]; c++) {
                uint32_t a = k->place[m->corner_vertex[c]], b = next_place(k, l, c);
                *edge_slot(k, a, b) = ((pcg_u64)a + 1) << 32 | b;
            }
    }
}

/* ---- displacement ---------------------------------------------------------------------------- */

/* Makes the place lie on one more displaced plane, without leaving those that it lies on. */
static void add_plane(displacement *d, pcg_vec3 normal, double amount)
{
    pcg_vec3 free = normal;
    for (uint32_t i = 0; i < d->count; i++)
        free = vec3_subtract(free, vec3_scale(d->fixed[i], vec3_dot(free, d->fixed[i])));
    if (d->count == 3 || vec3_length(free) < parallel)
        return;
    free = vec3_normal(free);
    d->by = vec3_add(d->by,
                     vec3_scale(free, (amount - vec3_dot(d->by, normal)) / vec3_dot(free, normal)));
    d->fixed[d->count++] = free;
}

static void find_moves(skin *k)
{
    const pcg_mesh *m = k->from->mesh;
    for (uint32_t f = 0; f < m->face_count; f++) {
        pcg_vec3 n = face_normal(k, f);
        if (vec3_dot(n, n) == 0)
            continue;
        for (uint32_t c = face_first_corner(m, f); c < face_last_corner(m, f); c++)
            add_plane(&k->moves[k->place[m->corner_vertex[c]]], n, k->amount);
    }
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        displacement *d = &k->moves[v];
        double length = vec3_length(d->by), most = farthest * fabs(k->amount);
        if (length > most)
            d->by = vec3_scale(d->by, most / length);
    }
}

/* ---- the new mesh ---------------------------------------------------------------------------- */

/* A vertex of the new mesh, added when it is first needed; UINT32_MAX when memory has run out. */
static uint32_t vertex_of(skin *k, uint32_t v, bool displaced)
{
    uint32_t *added = &k->added[displaced ? v + k->from->mesh->vertex_count : v];
    if (!*added) {
        pcg_vec3 p = k->from->mesh->position[v];
        *added = 1 + pcg_mesh_add_vertex(k->call->run, k->to,
                                         displaced ? vec3_add(p, k->moves[k->place[v]].by) : p);
    }
    return *added - 1;
}

static int add_side(skin *k, uint32_t a, uint32_t b)
{
    const uint32_t v[4] = {vertex_of(k, a, false), vertex_of(k, b, false), vertex_of(k, b, true),
                           vertex_of(k, a, true)};
    for (int i = 0; i < 4; i++)
        if (v[i] == UINT32_MAX)
            return PCG_FAILED;
    return geometry_add_quad(k->call->run, k->to, v[0], v[1], v[2], v[3]);
}

static int keep_material(skin *k, uint32_t face)
{
    const pcg_mesh *m = k->from->mesh;
    if (!m->face_material || !m->face_material[face])
        return PCG_OK;
    if (pcg_mesh_need_materials(k->call->run, k->to) != PCG_OK)
        return PCG_FAILED;
    k->to->face_material[k->to->face_count - 1] = m->face_material[face];
    return PCG_OK;
}

/* The sides along the open borders of a face. */
static int add_sides(skin *k, uint32_t face)
{
    const pcg_mesh *m = k->from->mesh;
    for (uint32_t l = m->face_loop[face]; l < m->face_loop[face + 1]; l++)
        for (uint32_t c = m->loop_corner[l]; c < m->loop_corner[l + 1]; c++) {
            uint32_t a = k->place[m->corner_vertex[c]], b = next_place(k, l, c);
            if (a == b || *edge_slot(k, b, a))
                continue;
            if (add_side(k, a, b) != PCG_OK || keep_material(k, face) != PCG_OK)
                return PCG_FAILED;
        }
    return PCG_OK;
}

/* The face once more: displaced, or turned round in its own place. */
static int add_end(skin *k, uint32_t face, bool displaced)
{
    const pcg_mesh *m = k->from->mesh;
    for (uint32_t l = m->face_loop[face]; l < m->face_loop[face + 1]; l++) {
        uint32_t first = m->loop_corner[l], count = m->loop_corner[l + 1] - first, added;
        for (uint32_t i = 0; i < count; i++) {
            k->loop[i] =
                vertex_of(k, m->corner_vertex[first + (displaced ? i : count - 1 - i)], displaced);
            if (k->loop[i] == UINT32_MAX)
                return PCG_FAILED;
        }
        added = l == m->face_loop[face] ? pcg_mesh_add_face(k->call->run, k->to, k->loop, count)
                                        : pcg_mesh_add_hole(k->call->run, k->to, k->loop, count);
        if (added == UINT32_MAX)
            return PCG_FAILED;
    }
    return keep_material(k, face);
}

static int for_each_face(skin *k, int (*add)(skin *k, uint32_t face))
{
    int status = PCG_OK;
    for (uint32_t f = 0; f < k->from->mesh->face_count && status == PCG_OK; f++) {
        if (has_area(k, f))
            status = add(k, f);
        if (status == PCG_OK)
            status = pcg_tick(k->call);
    }
    return status;
}

static int add_displaced(skin *k, uint32_t face)
{
    return add_end(k, face, true);
}

static int add_base(skin *k, uint32_t face)
{
    return add_end(k, face, false);
}

static int build(skin *k)
{
    find_places(k);
    find_edges(k);
    find_moves(k);
    int status = for_each_face(k, add_sides);
    if (status == PCG_OK && k->cap)
        status = for_each_face(k, add_displaced);
    if (status == PCG_OK && k->base)
        status = for_each_face(k, add_base);
    return status;
}

/* ---- the kernel ------------------------------------------------------------------------------ */

static uint32_t power_of_two_above(uint64_t n)
{
    uint64_t power = 16;
    while (power < n && power < (uint64_t)1 << 31)
        power *= 2;
    return (uint32_t)power;
}

/* Gets the tables, builds, and gives them back. */
static int build_with_tables(skin *k)
{
    pcg_run *r = k->call->run;
    const pcg_mesh *m = k->from->mesh;
    size_t vertices = m->vertex_count, corners = m->corner_count;
    k->slot_count = power_of_two_above(2 * (uint64_t)(vertices > corners ? vertices : corners));
    k->place = run_alloc_array(r, vertices, sizeof *k->place);
    k->place_slots = run_alloc_array(r, k->slot_count, sizeof *k->place_slots);
    k->edges = run_alloc_array(r, k->slot_count, sizeof *k->edges);
    k->moves = run_alloc_array(r, vertices, sizeof *k->moves);
    k->loop = run_alloc_array(r, corners, sizeof *k->loop);
    k->added = run_alloc_array(r, 2 * vertices, sizeof *k->added);
    k->to = pcg_mesh_new(r, false);
    bool got = k->place && k->place_slots && k->edges && k->moves && k->loop && k->added && k->to;
    int status = got ? build(k) : PCG_FAILED;
    run_free(r, k->place, vertices * sizeof *k->place);
    run_free(r, k->place_slots, k->slot_count * sizeof *k->place_slots);
    run_free(r, k->edges, k->slot_count * sizeof *k->edges);
    run_free(r, k->moves, vertices * sizeof *k->moves);
    run_free(r, k->loop, corners * sizeof *k->loop);
    run_free(r, k->added, 2 * vertices * sizeof *k->added);
    return status;
}

static int thicken(pcg_call *call, const struct pcg_geometry_special_extrude *node)
{
    pcg_shape *s = node->in;
    if (!pcg_shape_edit(call->run, s))
        return PCG_FAILED;
    skin k = {.call = call,
              .from = s,
              .amount = node->amount,
              .cap = node->cap,
              .base = node->base && node->amount > 0};
    int status = build_with_tables(&k);
    if (status != PCG_OK) {
        if (k.to)
            pcg_mesh_drop(call->run, k.to);
        return status;
    }
    pcg_shape_set_mesh(call->run, s, k.to);
    return pcg_shape_fit(call->run, s);
}

int pcg_geometry_special_extrude(pcg_call *call, struct pcg_geometry_special_extrude *node)
{
    int status = PCG_OK;
    if (!geometry_is_length(node->amount))
        status = pcg_warn(call, "the amount is %g m: the shape is not extruded", node->amount);
    else if (node->amount != 0 && node->in->mesh->face_count > 0)
        status = thicken(call, node);
    if (status == PCG_OK)
        return pcg_emit(call, node->out, &node->in->entity);
    pcg_entity_drop(call->run, &node->in->entity);
    return status;
}

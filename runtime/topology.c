/* topology.c - vertices in one place, edges, pieces. */
#include "runtime/topology.h"

#include <math.h>

#include "runtime/memory.h"
#include "runtime/mesh.h"

/* ---- welding --------------------------------------------------------------------------------- */

static const double weld_distance = 1e-6;

/* Vertices by the cubes of space that they are in, twice as wide as the distance. */
typedef struct cubes {
    uint32_t *head, *next;
    uint32_t mask;
} cubes;

typedef struct cube {
    int64_t x, y, z;
} cube;

static int64_t cube_floor(double at)
{
    double whole = floor(at / (2 * weld_distance));

    return whole > -9e18 && whole < 9e18 ? (int64_t)whole : 0;
}

static uint32_t cube_slot(const cubes *c, cube k)
{
    uint64_t hash = (uint64_t)k.x * 0x9E3779B97F4A7C15u ^ (uint64_t)k.y * 0xC2B2AE3D27D4EB4Fu ^
                    (uint64_t)k.z * 0x165667B19E3779F9u;

    hash ^= hash >> 32;
    hash *= 0xD6E8FEB86659FD93u;
    return (uint32_t)(hash >> 32) & c->mask;
}

static bool is_near(pcg_vec3 a, pcg_vec3 b)
{
    return fabs(a.x - b.x) <= weld_distance && fabs(a.y - b.y) <= weld_distance &&
           fabs(a.z - b.z) <= weld_distance;
}

static uint32_t find_in_cube(const cubes *c, cube k, const pcg_shape *s, pcg_vec3 p)
{
    for (uint32_t v = c->head[cube_slot(c, k)]; v != 0; v = c->next[v - 1])
        if (is_near(shape_point(s, v - 1), p))
            return v - 1;
    return UINT32_MAX;
}

/* The cube next to that of a coordinate which is nearer than the weld distance, as a step. */
static int64_t nearer_side(double at, int64_t own)
{
    return at / (2 * weld_distance) - (double)own < 0.5 ? -1 : 1;
}

/* A vertex in the place of p, in the eight cubes that it can be in; UINT32_MAX when there is
 * none. */
static uint32_t find_near(const cubes *c, const pcg_shape *s, pcg_vec3 p, cube own)
{
    int64_t x = nearer_side(p.x, own.x), y = nearer_side(p.y, own.y), z = nearer_side(p.z, own.z);

    for (int i = 0; i < 8; i++) {
        cube k = {own.x + (i & 1 ? x : 0), own.y + (i & 2 ? y : 0), own.z + (i & 4 ? z : 0)};
        uint32_t found = find_in_cube(c, k, s, p);

        if (found != UINT32_MAX)
            return found;
    }
    return UINT32_MAX;
}

static void weld_vertices(cubes *c, const pcg_shape *s, uint32_t *first)
{
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        pcg_vec3 p = shape_point(s, v);
        cube own = {cube_floor(p.x), cube_floor(p.y), cube_floor(p.z)};
        uint32_t found = find_near(c, s, p, own), slot;

        if (found != UINT32_MAX) {
            first[v] = first[found];
            continue;
        }
        first[v] = v;
        slot = cube_slot(c, own);
        c->next[v] = c->head[slot];
        c->head[slot] = v + 1;
    }
}

uint32_t *weld(pcg_run *r, const pcg_shape *s)
{
    uint32_t count = s->mesh->vertex_count, slots = 16;
    uint32_t *first = run_alloc(r, count * sizeof *first);
    cubes c;

    while (slots < count && slots < 1u << 30)
        slots *= 2;
    c.mask = slots - 1;
    c.head = run_alloc_array(r, slots, sizeof *c.head);
    c.next = run_alloc(r, count * sizeof *c.next);
    if (first != NULL && c.head != NULL && c.next != NULL) {
        weld_vertices(&c, s, first);
    } else {
        run_free(r, first, count * sizeof *first);
        first = NULL;
    }
    run_free(r, c.head, slots * sizeof *c.head);
    run_free(r, c.next, count * sizeof *c.next);
    return first;
}

void weld_free(pcg_run *r, const pcg_shape *s, uint32_t *first)
{
    run_free(r, first, s->mesh->vertex_count * sizeof *first);
}

/* ---- edges ----------------------------------------------------------------------------------- */

static uint32_t edge_slot(const edge_list *list, uint32_t a, uint32_t b)
{
    uint64_t hash = ((uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a)) * 0x9E3779B97F4A7C15u;

    return (uint32_t)(hash >> 32) & (list->slots - 1);
}

/* The edge's place in the table: where it is, or would be. */
static uint32_t *edge_place(const edge_list *list, uint32_t a, uint32_t b)
{
    uint32_t slot = edge_slot(list, a, b);

    while (list->slot[slot] != 0) {
        const edge_use *e = &list->at[list->slot[slot] - 1];

        if ((e->a == a && e->b == b) || (e->a == b && e->b == a))
            break;
        slot = (slot + 1) & (list->slots - 1);
    }
    return &list->slot[slot];
}

static edge_use *edge_between(edge_list *list, uint32_t a, uint32_t b)
{
    uint32_t *place;

    a = list->first[a];
    b = list->first[b];
    place = edge_place(list, a, b);
    if (*place == 0) {
        list->at[list->count] = (edge_use){a, b, 0, 0};
        *place = ++list->count;
    }
    return &list->at[*place - 1];
}

static void use_edge(edge_list *list, uint32_t from, uint32_t to)
{
    edge_use *e;

    if (list->first[from] == list->first[to])
        return;
    e = edge_between(list, from, to);
    if (e->a == list->first[from])
        e->forward++;
    else
        e->back++;
}

const edge_use *edge_list_find(const edge_list *list, uint32_t a, uint32_t b)
{
    uint32_t place = *edge_place(list, list->first[a], list->first[b]);

    return place != 0 ? &list->at[place - 1] : NULL;
}

static void collect_edges(const pcg_mesh *m, edge_list *list)
{
    for (uint32_t l = 0; l < m->loop_count; l++) {
        uint32_t first = m->loop_corner[l], end = m->loop_corner[l + 1];

        for (uint32_t i = first; i < end; i++)
            use_edge(list, m->corner_vertex[i], m->corner_vertex[i + 1 < end ? i + 1 : first]);
    }
    for (uint32_t i = 0; i < m->edge_count; i++) {
        const uint32_t *pair = &m->edge_vertex[2 * (size_t)i];

        if (list->first[pair[0]] != list->first[pair[1]])
            edge_between(list, pair[0], pair[1]);
    }
}

int edge_list_open(pcg_run *r, const pcg_shape *s, edge_list *list)
{
    uint64_t most = (uint64_t)s->mesh->corner_count + s->mesh->edge_count;

    *list = (edge_list){.slots = 16};
    while (list->slots < 2 * most && list->slots < 1u << 31)
        list->slots *= 2;
    if (most >= UINT32_MAX / 2)
        return run_alloc_array(r, SIZE_MAX, SIZE_MAX) == NULL ? PCG_FAILED : PCG_OK;
    list->capacity = (uint32_t)most;
    list->first = weld(r, s);
    list->slot = run_alloc_array(r, list->slots, sizeof *list->slot);
    list->at = run_alloc(r, list->capacity * sizeof *list->at);
    if (list->first == NULL || list->slot == NULL || list->at == NULL)
        return PCG_FAILED;
    collect_edges(s->mesh, list);
    return PCG_OK;
}

void edge_list_close(pcg_run *r, const pcg_shape *s, edge_list *list)
{
    if (list->first != NULL)
        weld_free(r, s, list->first);
    run_free(r, list->slot, list->slots * sizeof *list->slot);
    run_free(r, list->at, list->capacity * sizeof *list->at);
}

bool is_closed(pcg_run *r, const pcg_shape *s)
{
    edge_list list;
    bool closed = s->mesh->face_count > 0 && edge_list_open(r, s, &list) == PCG_OK;

    if (s->mesh->face_count == 0)
        return false;
    for (uint32_t i = 0; i < list.count && closed; i++)
        closed = list.at[i].forward == 1 && list.at[i].back == 1;
    edge_list_close(r, s, &list);
    return closed;
}

/* ---- pieces ---------------------------------------------------------------------------------- */

/* The vertex that stands for all that hang together with v. */
static uint32_t root_of(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

static void join_faces(const pcg_mesh *m, uint32_t *parent)
{
    for (uint32_t f = 0; f < m->face_count; f++) {
        uint32_t first = face_first_corner(m, f), end = face_last_corner(m, f);

        for (uint32_t i = first + 1; i < end; i++) {
            uint32_t a = root_of(parent, m->corner_vertex[first]),
                     b = root_of(parent, m->corner_vertex[i]);

            if (a < b)
                parent[b] = a;
            else
                parent[a] = b;
        }
    }
}

int group_connected(pcg_run *r, const pcg_shape *s, uint32_t *group, uint32_t *count)
{
    const pcg_mesh *m = s->mesh;
    uint32_t *parent = weld(r, s), *number = run_alloc_array(r, m->vertex_count, sizeof *number);
    int status = parent != NULL && number != NULL ? PCG_OK : PCG_FAILED;

    *count = 0;
    if (status == PCG_OK)
        join_faces(m, parent);
    for (uint32_t f = 0; f < m->face_count && status == PCG_OK; f++) {
        uint32_t first = face_first_corner(m, f), root;

        if (first == face_last_corner(m, f)) {
            group[f] = (*count)++;
            continue;
        }
        root = root_of(parent, m->corner_vertex[first]);
        if (number[root] == 0)
            number[root] = ++*count;
        group[f] = number[root] - 1;
    }
    if (parent != NULL)
        weld_free(r, s, parent);
    run_free(r, number, m->vertex_count * sizeof *number);
    return status;
}

void axes_along(pcg_vec3 x, pcg_vec3 axis[3])
{
    bool upright = x.x * x.x + x.y * x.y < 1e-12;

    axis[0] = x;
    axis[1] = upright ? vec3(0, 1, 0) : vec3_normal(vec3(-x.y, x.x, 0));
    axis[2] = vec3_normal(vec3_cross(axis[0], axis[1]));
    axis[1] = vec3_cross(axis[2], axis[0]);
}

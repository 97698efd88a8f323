/* part_grow.c - growing a face in its shape: what is added to the mesh comes behind what is there,
 * so that all parts stay what they are. */
#include "list.h"
#include "mesh.h"
#include "part_table.h"
#include "run.h"

/* A face that is being grown. */
typedef struct growth {
    pcg_run *run;
    pcg_part *face;
    pcg_mesh *mesh;
    struct shape_parts *table;
    uint32_t first, corners; /* of the face */
    uint32_t *base;          /* by corner: the vertex where it was */
} growth;

/* ---- vertices -------------------------------------------------------------------------------- */

/* The vertex is the only one in a new place. */
static int add_place(const growth *g, uint32_t vertex)
{
    struct shape_parts *t = g->table;

    if (part_number_add(g->run, &t->place, t->place_count) != PCG_OK ||
        part_number_add(g->run, &t->place_vertex, vertex) != PCG_OK ||
        part_number_add(g->run, &t->place_first, t->place_vertex.count) != PCG_OK ||
        part_number_add(g->run, &t->above, 0) != PCG_OK ||
        list_room(g->run, (void **)&t->moved, &t->moved_capacity, t->place_count, 1,
                  sizeof *t->moved) != PCG_OK)
        return PCG_FAILED;
    t->moved[t->place_count++] = 0;
    return PCG_OK;
}

/* The places where a corner of the face was, and where it is now. */
static uint32_t base_place(const growth *g, uint32_t corner)
{
    return g->table->place.at[g->base[corner]];
}
static uint32_t top_place(const growth *g, uint32_t corner)
{
    return g->table->place.at[g->mesh->corner_vertex[g->first + corner]];
}

/* Puts each corner of the face on a new vertex; corners that were in one place share it. */
static int add_vertices(const growth *g, pcg_vec3 shift)
{
    struct shape_parts *t = g->table;
    pcg_mesh *m = g->mesh;

    for (uint32_t i = 0; i < g->corners; i++)
        g->base[i] = m->corner_vertex[g->first + i];
    for (uint32_t i = 0; i < g->corners; i++) {
        uint32_t place = base_place(g, i), vertex = t->above.at[place];

        if (vertex == 0) {
            vertex = pcg_mesh_add_vertex(g->run, m, vec3_add(m->position[g->base[i]], shift));
            if (vertex == UINT32_MAX || add_place(g, vertex) != PCG_OK)
                return PCG_FAILED;
            t->above.at[place] = vertex;
        }
        m->corner_vertex[g->first + i] = vertex;
    }
    for (uint32_t i = 0; i < g->corners; i++)
        t->above.at[base_place(g, i)] = 0;
    return PCG_OK;
}

/* ---- sides and edges ------------------------------------------------------------------------- */

static int add_side(const growth *g, uint32_t a, uint32_t b)
{
    const uint32_t *top = g->mesh->corner_vertex + g->first;
    const uint32_t quad[4] = {g->base[a], g->base[b], top[b], top[a]};
    uint32_t side = pcg_mesh_add_face(g->run, g->mesh, quad, 4);

    if (side == UINT32_MAX)
        return PCG_FAILED;
    if (g->mesh->face_material != NULL)
        g->mesh->face_material[side] = g->mesh->face_material[g->face->index];
    return PCG_OK;
}

static int add_edge(const growth *g, uint32_t a, uint32_t b)
{
    struct shape_parts *t = g->table;

    return part_number_add(g->run, &t->edge, a) == PCG_OK ? part_number_add(g->run, &t->edge, b)
                                                          : PCG_FAILED;
}

/* The edge that leads up to a corner, where none does yet, and the one to the next corner. */
static int add_edges(const growth *g, uint32_t a, uint32_t b)
{
    struct shape_parts *t = g->table;
    uint32_t top = top_place(g, a);

    if (t->edge.at == NULL)
        return PCG_OK;
    if (t->moved[top] != t->moves && add_edge(g, base_place(g, a), top) != PCG_OK)
        return PCG_FAILED;
    t->moved[top] = t->moves;
    return base_place(g, a) != base_place(g, b) ? add_edge(g, top, top_place(g, b)) : PCG_OK;
}

static int add_sides(const growth *g)
{
    const pcg_mesh *m = g->mesh;

    for (uint32_t l = m->face_loop[g->face->index]; l < m->face_loop[g->face->index + 1]; l++) {
        uint32_t from = m->loop_corner[l] - g->first, to = m->loop_corner[l + 1] - g->first;

        for (uint32_t i = from; i < to; i++) {
            uint32_t next = i + 1 < to ? i + 1 : from;

            if (base_place(g, i) != base_place(g, next) && add_side(g, i, next) != PCG_OK)
                return PCG_FAILED;
            if (add_edges(g, i, next) != PCG_OK)
                return PCG_FAILED;
        }
    }
    return PCG_OK;
}

/* ---- the table ------------------------------------------------------------------------------- */

/* What is new has the attributes of the face. */
static int add_records(const growth *g, part_kind kind, uint32_t count)
{
    part_records *list = &g->table->record[kind];

    if (list->at == NULL)
        return PCG_OK;
    if (list_room(g->run, (void **)&list->at, &list->capacity, list->count, count - list->count,
                  sizeof *list->at) != PCG_OK)
        return PCG_FAILED;
    while (list->count < count)
        list->at[list->count++] =
            (part_record){.attributes = attributes_hold(g->face->entity.attributes)};
    return PCG_OK;
}

static int update_table(const growth *g)
{
    struct shape_parts *t = g->table;

    part_table_count(t, g->mesh);
    return add_records(g, PART_FACE, t->face_count) == PCG_OK &&
                   add_records(g, PART_EDGE, t->edge.count / 2) == PCG_OK
               ? add_records(g, PART_VERTEX, t->place_count)
               : PCG_FAILED;
}

/* A zero for each place that there is. */
static int open_above(pcg_run *r, struct shape_parts *t)
{
    while (t->above.count < t->place_count)
        if (part_number_add(r, &t->above, 0) != PCG_OK)
            return PCG_FAILED;
    return PCG_OK;
}

int part_grow(pcg_run *r, pcg_part *face, pcg_vec3 shift)
{
    growth g = {.run = r, .face = face, .table = face->shape->parts};
    size_t room;
    int status = PCG_FAILED;

    if (pcg_shape_edit(r, face->shape) == NULL || part_unsettle(r, face->shape) != PCG_OK ||
        open_above(r, g.table) != PCG_OK)
        return PCG_FAILED;
    g.mesh = face->shape->mesh;
    g.first = face_first_corner(g.mesh, face->index);
    g.corners = part_place_count(face);
    room = g.corners * sizeof *g.base;
    if ((g.base = run_alloc(r, room)) == NULL)
        return PCG_FAILED;
    if (add_vertices(&g, shift) == PCG_OK && add_sides(&g) == PCG_OK)
        status = update_table(&g);
    run_free(r, g.base, room);
    return status;
}

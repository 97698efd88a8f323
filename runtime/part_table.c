/* part_table.c - what a shape knows of its parts: places, edges, and a record of each part. */
#include "part_table.h"

#include <string.h>

#include "list.h"
#include "memory.h"
#include "run.h"
#include "topology.h"

int part_number_add(pcg_run *r, part_numbers *list, uint32_t number)
{
    if (list_room(r, (void **)&list->at, &list->capacity, list->count, 1, sizeof *list->at) !=
        PCG_OK)
        return PCG_FAILED;
    list->at[list->count++] = number;
    return PCG_OK;
}

/* ---- places ---------------------------------------------------------------------------------- */

/* Numbers the places in the order of their first vertices. `first`: for each vertex the first one
 * in its place; NULL: each is one. */
static void number_places(struct shape_parts *t, const uint32_t *first)
{
    for (uint32_t v = 0; v < t->vertex_count; v++)
        t->place.at[v] = first == NULL || first[v] == v ? t->place_count++ : t->place.at[first[v]];
}

/* Lists the vertices of each place, in their order. */
static void list_places(struct shape_parts *t)
{
    uint32_t *first = t->place_first.at;

    for (uint32_t v = 0; v < t->vertex_count; v++)
        first[t->place.at[v] + 1]++;
    for (uint32_t i = 0; i < t->place_count; i++)
        first[i + 1] += first[i];
    for (uint32_t v = 0; v < t->vertex_count; v++)
        t->place_vertex.at[first[t->place.at[v]]++] = v;
    for (uint32_t i = t->place_count; i > 0; i--)
        first[i] = first[i - 1];
    first[0] = 0;
}

/* Zeros. */
static int open_numbers(pcg_run *r, part_numbers *n, uint32_t count)
{
    n->at = run_alloc_array(r, count, sizeof *n->at);
    n->count = n->capacity = n->at != NULL ? count : 0;
    return n->at != NULL ? PCG_OK : PCG_FAILED;
}

static int open_places(pcg_run *r, const pcg_shape *s, struct shape_parts *t, bool apart)
{
    uint32_t *first = NULL;

    if (!apart && (first = weld(r, s)) == NULL)
        return PCG_FAILED;
    if (open_numbers(r, &t->place, t->vertex_count) == PCG_OK)
        number_places(t, first);
    weld_free(r, s, first);
    t->moved = run_alloc_array(r, t->place_count, sizeof *t->moved);
    t->moved_capacity = t->moved != NULL ? t->place_count : 0;
    if (t->place.at == NULL || t->moved == NULL ||
        open_numbers(r, &t->place_vertex, t->vertex_count) != PCG_OK ||
        open_numbers(r, &t->place_first, t->place_count + 1) != PCG_OK)
        return PCG_FAILED;
    list_places(t);
    return PCG_OK;
}

/* ---- edges ----------------------------------------------------------------------------------- */

/* All edges, as topology.h finds them. */
static int open_edges(pcg_run *r, const pcg_shape *s, struct shape_parts *t)
{
    edge_list list;
    int status = edge_list_open(r, s, &list);

    if (status == PCG_OK)
        status = open_numbers(r, &t->edge, 2 * list.count);
    for (uint32_t i = 0; i < t->edge.count; i++)
        t->edge.at[i] = t->place.at[i % 2 == 0 ? list.at[i / 2].a : list.at[i / 2].b];
    edge_list_close(r, s, &list);
    return status;
}

/* The loose edges alone. */
static int open_loose_edges(pcg_run *r, const pcg_mesh *m, struct shape_parts *t)
{
    if (open_numbers(r, &t->edge, 2 * m->edge_count) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < t->edge.count; i++)
        t->edge.at[i] = t->place.at[m->edge_vertex[i]];
    return PCG_OK;
}

/* ---- the table ------------------------------------------------------------------------------- */

bool part_same_topology(const pcg_mesh *a, const pcg_mesh *b)
{
    if (a->vertex_count != b->vertex_count || a->face_count != b->face_count ||
        a->loop_count != b->loop_count || a->corner_count != b->corner_count ||
        a->edge_count != b->edge_count)
        return false;
    return memcmp(a->face_loop, b->face_loop, (a->face_count + 1) * sizeof *a->face_loop) == 0 &&
           memcmp(a->loop_corner, b->loop_corner, (a->loop_count + 1) * sizeof *a->loop_corner) ==
               0 &&
           (a->corner_count == 0 || memcmp(a->corner_vertex, b->corner_vertex,
                                           a->corner_count * sizeof *a->corner_vertex) == 0) &&
           (a->edge_count == 0 || memcmp(a->edge_vertex, b->edge_vertex,
                                         2 * a->edge_count * sizeof *a->edge_vertex) == 0);
}

static void free_arrays(pcg_run *r, struct shape_parts *t)
{
    const part_numbers *const lists[] = {&t->place, &t->place_vertex, &t->place_first,
                                         &t->above, &t->edge,         &t->gone};

    for (size_t i = 0; i < COUNT_OF(lists); i++)
        run_free(r, lists[i]->at, lists[i]->capacity * sizeof *lists[i]->at);
    run_free(r, t->moved, t->moved_capacity * sizeof *t->moved);
    for (int k = 0; k < PART_KINDS; k++)
        run_free(r, t->record[k].at, t->record[k].capacity * sizeof *t->record[k].at);
    run_free(r, t, sizeof *t);
}

void part_table_count(struct shape_parts *t, const pcg_mesh *m)
{
    t->vertex_count = m->vertex_count;
    t->face_count = m->face_count;
    t->loop_count = m->loop_count;
    t->corner_count = m->corner_count;
    t->loose_count = m->edge_count;
}

int part_table_open(pcg_run *r, pcg_shape *s, bool apart)
{
    const pcg_mesh *m = s->mesh;
    struct shape_parts *t;

    if (s->parts != NULL)
        return PCG_OK;
    if ((t = run_alloc_zeroed(r, sizeof *t)) == NULL)
        return PCG_FAILED;
    part_table_count(t, m);
    if (open_places(r, s, t, apart) != PCG_OK || (apart && open_loose_edges(r, m, t) != PCG_OK)) {
        free_arrays(r, t);
        return PCG_FAILED;
    }
    s->parts = t;
    return PCG_OK;
}

/* The entities that are out are of no shape any more. Who calls holds the shape. */
static void part_with(pcg_run *r, struct shape_parts *t)
{
    for (int k = 0; k < PART_KINDS; k++) {
        for (uint32_t i = 0; i < t->record[k].count; i++) {
            part_record *record = &t->record[k].at[i];

            if (record->out != NULL) {
                pcg_entity_drop(r, &record->out->shape->entity);
                record->out->shape = NULL;
            } else {
                attributes_drop(r, record->attributes);
            }
        }
    }
}

void parts_close(pcg_run *r, pcg_shape *s)
{
    struct shape_parts *t = s->parts;

    if (t == NULL)
        return;
    s->parts = NULL;
    part_with(r, t);
    free_arrays(r, t);
}

void parts_new_mesh(pcg_run *r, pcg_shape *s, const pcg_mesh *m)
{
    if (s->parts != NULL && m != s->mesh && !part_same_topology(s->mesh, m))
        parts_close(r, s);
}

/* Kernels that change a mesh in place may have added to it. */
static bool is_current(const pcg_shape *s)
{
    const struct shape_parts *t = s->parts;
    const pcg_mesh *m = s->mesh;

    return t->vertex_count == m->vertex_count && t->face_count == m->face_count &&
           t->loop_count == m->loop_count && t->corner_count == m->corner_count &&
           t->loose_count == m->edge_count;
}

/* ---- records --------------------------------------------------------------------------------- */

static int open_records(pcg_run *r, pcg_shape *s, part_kind kind)
{
    struct shape_parts *t = s->parts;
    uint32_t count = kind == PART_FACE   ? t->face_count
                     : kind == PART_EDGE ? t->edge.count / 2
                                         : t->place_count;
    part_record *record = run_alloc_array(r, count, sizeof *record);

    if (record == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++)
        record[i].attributes = attributes_hold(s->entity.attributes);
    t->record[kind] = (part_records){record, count, count};
    return PCG_OK;
}

int parts_count(pcg_run *r, pcg_shape *s, part_kind kind, uint32_t *count)
{
    *count = 0;
    if (s->parts != NULL && !is_current(s))
        parts_close(r, s);
    if (part_table_open(r, s, false) != PCG_OK)
        return PCG_FAILED;
    if (kind == PART_EDGE && s->parts->edge.at == NULL && open_edges(r, s, s->parts) != PCG_OK)
        return PCG_FAILED;
    if (s->parts->record[kind].at == NULL && open_records(r, s, kind) != PCG_OK)
        return PCG_FAILED;
    *count = s->parts->record[kind].count;
    return PCG_OK;
}

void parts_leave(pcg_run *r, pcg_shape *s, pcg_u32 base)
{
    struct shape_parts *t = s->parts;

    for (int k = 0; t != NULL && k < PART_KINDS; k++) {
        for (uint32_t i = 0; i < t->record[k].count; i++) {
            part_record *record = &t->record[k].at[i];
            pcg_entity kept = {.attributes = record->attributes};

            if (record->out != NULL) {
                attributes_leave(r, &record->out->entity, base);
                continue;
            }
            attributes_leave(r, &kept, base);
            record->attributes = kept.attributes;
        }
    }
}

pcg_shape *part_shape(const pcg_part *p)
{
    return p->shape != NULL && is_current(p->shape) ? p->shape : NULL;
}

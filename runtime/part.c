/* part.c - faces, edges and vertices as entities. */
#include "part.h"

#include <string.h>

#include "mesh.h"
#include "part_table.h"
#include "run.h"

/* Tells the lines of a shape's parts from those of its descendants; by kind. */
static const pcg_u64 part_key[PART_KINDS] = {0x5FACE5FACE5FACE5u, 0x0ED6E0ED6E0ED6E0u,
                                             0xC0A6E2C0A6E2C0A6u};

/* ---- life ------------------------------------------------------------------------------------ */

/* Makes `own`, which is a copy of the part's shape, a shape of that part alone. */
static int keep_alone(pcg_run *r, const pcg_part *p, pcg_shape *own)
{
    const pcg_shape *s = p->shape;
    uint32_t a, b;

    if (p->kind == PART_FACE)
        return shape_become_face(r, s, p->index, own);
    a = part_place_vertex(s, part_place(p, 0));
    b = part_place_vertex(s, part_place(p, part_place_count(p) - 1));
    return shape_become_edge(r, s, a, b, own);
}

static int part_copy(pcg_run *r, pcg_entity *to, const pcg_entity *from)
{
    pcg_part *copy = (pcg_part *)to;
    const pcg_part *p = (const pcg_part *)from;
    pcg_shape *own;
    uint32_t count;

    copy->kind = p->kind;
    if (part_shape(p) == NULL)
        return PCG_OK;
    if ((own = (pcg_shape *)pcg_entity_copy(r, &p->shape->entity, to->lineage)) == NULL)
        return PCG_FAILED;
    if (keep_alone(r, p, own) != PCG_OK || part_table_open(r, own, true) != PCG_OK ||
        parts_count(r, own, p->kind, &count) != PCG_OK) {
        pcg_entity_drop(r, &own->entity);
        return PCG_FAILED;
    }
    copy->shape = own;
    attributes_drop(r, own->parts->record[p->kind].at[0].attributes);
    own->parts->record[p->kind].at[0] = (part_record){copy, NULL, from->maker};
    return PCG_OK;
}

static void part_drop(pcg_run *r, pcg_entity *e)
{
    pcg_part *p = (pcg_part *)e;

    if (p->shape == NULL)
        return;
    part_record *record = &p->shape->parts->record[p->kind].at[p->index];
    record->out = NULL;
    record->attributes = attributes_hold(e->attributes);
    record->maker = e->maker;
    pcg_entity_drop(r, &p->shape->entity);
}

const pcg_type pcg_type_spatial = {"Spatial", &pcg_type_entity, sizeof(pcg_entity), NULL, NULL,
                                   NULL,      NULL,             NULL};
const pcg_type pcg_type_faced = {"Faced", &pcg_type_spatial, sizeof(pcg_entity), NULL, NULL, NULL,
                                 NULL,    NULL};
const pcg_type pcg_type_face = {"Face",    &pcg_type_faced, sizeof(pcg_part),
                                part_copy, part_drop,       NULL, NULL, NULL};
const pcg_type pcg_type_edge = {"Edge",    &pcg_type_spatial, sizeof(pcg_part),
                                part_copy, part_drop,         NULL, NULL, NULL};
const pcg_type pcg_type_vertex = {"Vertex",  &pcg_type_spatial, sizeof(pcg_part),
                                  part_copy, part_drop,         NULL, NULL, NULL};

static const pcg_type *const part_type[PART_KINDS] = {&pcg_type_face, &pcg_type_edge,
                                                      &pcg_type_vertex};

bool part_is(const pcg_entity *e)
{
    return e->type == &pcg_type_face || e->type == &pcg_type_edge || e->type == &pcg_type_vertex;
}

const char *part_name(part_kind kind)
{
    static const char *const names[PART_KINDS] = {"face", "edge", "vertex"};

    return names[kind];
}

pcg_part *parts_at(pcg_call *c, pcg_shape *s, part_kind kind, uint32_t index)
{
    part_record *record = &s->parts->record[kind].at[index];
    pcg_part *p;

    if (record->out != NULL)
        return (pcg_part *)pcg_entity_hold(&record->out->entity);
    if ((p = (pcg_part *)pcg_entity_new(c, part_type[kind], &s->entity)) == NULL)
        return NULL;
    attributes_drop(c->run, p->entity.attributes);
    p->entity.attributes = record->attributes;
    p->entity.lineage = pcg_mix(pcg_mix(s->entity.lineage, part_key[kind]), index);
    if (record->maker != NULL)
        p->entity.maker = record->maker;
    p->shape = (pcg_shape *)pcg_entity_hold(&s->entity);
    p->kind = kind;
    p->index = index;
    *record = (part_record){.out = p};
    return p;
}

int part_warn_lost(pcg_call *c, const pcg_part *p)
{
    return pcg_warn(c,
                    "the %s belongs to no shape any more: the shape that it was of has got other "
                    "faces, edges and vertices",
                    part_name(p->kind));
}

/* ---- places ---------------------------------------------------------------------------------- */

uint32_t part_place_count(const pcg_part *p)
{
    const pcg_mesh *m = p->shape->mesh;

    if (p->kind == PART_FACE)
        return face_last_corner(m, p->index) - face_first_corner(m, p->index);
    return p->kind == PART_EDGE ? 2 : 1;
}

uint32_t part_place(const pcg_part *p, uint32_t i)
{
    const struct shape_parts *t = p->shape->parts;
    const pcg_mesh *m = p->shape->mesh;

    if (p->kind == PART_FACE)
        return t->place.at[m->corner_vertex[face_first_corner(m, p->index) + i]];
    return p->kind == PART_EDGE ? t->edge.at[2 * p->index + i] : p->index;
}

uint32_t part_place_vertex(const pcg_shape *s, uint32_t place)
{
    return s->parts->place_vertex.at[s->parts->place_first.at[place]];
}

void part_scope(const pcg_part *p, pcg_scope *scope)
{
    if (p->kind == PART_FACE)
        shape_face_scope(p->shape, p->index, scope);
    else
        shape_edge_scope(p->shape, part_place_vertex(p->shape, part_place(p, 0)),
                         part_place_vertex(p->shape, part_place(p, part_place_count(p) - 1)),
                         scope);
}

/* ---- moving ---------------------------------------------------------------------------------- */

/* From coordinates along the scope of a shape to others along it. */
typedef struct motion {
    const pcg_scope *shape, *from, *to;
    pcg_vec3 by;
} motion;

static pcg_vec3 moved(const motion *m, pcg_vec3 p)
{
    pcg_vec3 at = pcg_scope_local(m->from, pcg_scope_point(m->shape, p));

    return pcg_scope_local(m->shape, pcg_scope_point(m->to, vec3_multiply(at, m->by)));
}

int part_unsettle(pcg_run *r, pcg_shape *s)
{
    part_unsettled *u;

    if (s->parts->moves++ > s->parts->settled)
        return PCG_OK; /* it waits already */
    if ((u = run_alloc(r, sizeof *u)) == NULL)
        return PCG_FAILED;
    *u = (part_unsettled){r->unsettled, (pcg_shape *)pcg_entity_hold(&s->entity)};
    r->unsettled = u;
    return PCG_OK;
}

int part_move(pcg_run *r, pcg_part *p, const pcg_scope *from, const pcg_scope *to, pcg_vec3 by)
{
    pcg_shape *s = p->shape;
    struct shape_parts *t = s->parts;
    const motion m = {&s->scope, from, to, by};
    uint32_t count = part_place_count(p);

    if (pcg_shape_edit(r, s) == NULL || part_unsettle(r, s) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t place = part_place(p, i);

        if (t->moved[place] == t->moves)
            continue; /* a corner that comes up twice */
        t->moved[place] = t->moves;
        for (uint32_t k = t->place_first.at[place]; k < t->place_first.at[place + 1]; k++) {
            pcg_vec3 *at = &s->mesh->position[t->place_vertex.at[k]];

            *at = moved(&m, *at);
        }
    }
    return PCG_OK;
}

/* ---- settling -------------------------------------------------------------------------------- */

/* Faces with a corner that has moved look where they lie: their corners' own normals go. */
static void forget_normals(pcg_mesh *m, const struct shape_parts *t)
{
    for (uint32_t f = 0; m->corner_normal != NULL && f < m->face_count; f++) {
        uint32_t first = face_first_corner(m, f), end = face_last_corner(m, f);
        bool has_moved = false;

        for (uint32_t c = first; c < end; c++)
            has_moved |= t->moved[t->place.at[m->corner_vertex[c]]] > t->settled;
        if (has_moved)
            memset(m->corner_normal + 3 * (size_t)first, 0,
                   3 * (size_t)(end - first) * sizeof *m->corner_normal);
    }
}

int part_remove(pcg_run *r, pcg_part *face)
{
    pcg_shape *s = face->shape;

    if (part_unsettle(r, s) != PCG_OK || part_number_add(r, &s->parts->gone, face->index) != PCG_OK)
        return PCG_FAILED;
    s->parts->record[PART_FACE].at[face->index] = (part_record){NULL, NULL, NULL};
    face->shape = NULL;
    pcg_entity_drop(r, &s->entity); /* which waits to be settled, and is held by that */
    return PCG_OK;
}

static int keep_others(pcg_run *r, pcg_shape *s)
{
    const part_numbers *gone = &s->parts->gone;
    uint32_t faces = s->mesh->face_count, count = 0;
    uint32_t *kept = run_alloc_array(r, faces, sizeof *kept);
    int status = PCG_FAILED;

    if (kept == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < gone->count; i++)
        kept[gone->at[i]] = 1;
    for (uint32_t f = 0; f < faces; f++)
        if (kept[f] == 0)
            kept[count++] = f;
    status = shape_keep_faces(r, s, kept, count);
    run_free(r, kept, faces * sizeof *kept);
    return status;
}

static void settle(pcg_run *r, pcg_shape *s)
{
    if (s->parts == NULL || s->parts->moves == s->parts->settled)
        return;
    forget_normals(s->mesh, s->parts);
    s->parts->settled = s->parts->moves;
    if (s->parts->gone.count > 0 && keep_others(r, s) != PCG_OK)
        return;
    (void)pcg_shape_fit(r, s); /* the run knows where there was no memory */
}

void parts_settle(pcg_run *r)
{
    while (r->unsettled != NULL) {
        part_unsettled *u = r->unsettled;

        r->unsettled = u->next;
        settle(r, u->shape);
        pcg_entity_drop(r, &u->shape->entity);
        run_free(r, u, sizeof *u);
    }
}

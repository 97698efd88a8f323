/* network.c - street networks as entities: making, sharing and adding to them. */
#include <math.h>
#include <string.h>

#include "runtime/parcel.h"
#include "streets.h"

/* ---- drawings -------------------------------------------------------------------------------- */

static void drawing_free(pcg_run *r, street_drawing *d)
{
    run_free(r, d->vertex, d->vertex_capacity * sizeof *d->vertex);
    run_free(r, d->edge, d->edge_capacity * sizeof *d->edge);
    run_free(r, d->way, d->way_capacity * sizeof *d->way);
    run_free(r, d, sizeof *d);
}

street_drawing *drawing_new(pcg_run *r, uint32_t vertices, uint32_t edges, uint32_t ways)
{
    street_drawing *d = run_alloc_zeroed(r, sizeof *d);

    if (d == NULL)
        return NULL;
    d->references = 1;
    if (list_room(r, (void **)&d->vertex, &d->vertex_capacity, 0, vertices, sizeof *d->vertex) ==
            PCG_OK &&
        list_room(r, (void **)&d->edge, &d->edge_capacity, 0, edges, sizeof *d->edge) == PCG_OK &&
        list_room(r, (void **)&d->way, &d->way_capacity, 0, ways, sizeof *d->way) == PCG_OK)
        return d;
    drawing_free(r, d);
    return NULL;
}

void drawing_drop(pcg_run *r, street_drawing *d)
{
    if (--d->references == 0)
        drawing_free(r, d);
}

static street_drawing *drawing_copy(pcg_run *r, const street_drawing *d)
{
    street_drawing *copy = drawing_new(r, d->vertices, d->edges, d->ways);

    if (copy == NULL)
        return NULL;
    copy->vertices = d->vertices;
    copy->edges = d->edges;
    copy->ways = d->ways;
    if (d->vertices > 0)
        memcpy(copy->vertex, d->vertex, d->vertices * sizeof *d->vertex);
    if (d->edges > 0)
        memcpy(copy->edge, d->edge, d->edges * sizeof *d->edge);
    if (d->ways > 0)
        memcpy(copy->way, d->way, d->ways * sizeof *d->way);
    return copy;
}

uint32_t drawing_add_vertex(pcg_run *r, street_drawing *d, pcg_vec3 at)
{
    if (list_room(r, (void **)&d->vertex, &d->vertex_capacity, d->vertices, 1, sizeof *d->vertex) !=
        PCG_OK)
        return UINT32_MAX;
    d->vertex[d->vertices] = at;
    return d->vertices++;
}

uint32_t drawing_add_edge(pcg_run *r, street_drawing *d, uint32_t from, uint32_t to, uint32_t way)
{
    if (list_room(r, (void **)&d->edge, &d->edge_capacity, d->edges, 1, sizeof *d->edge) != PCG_OK)
        return UINT32_MAX;
    d->edge[d->edges] = (street_edge){from, to, way};
    return d->edges++;
}

uint32_t drawing_add_way(pcg_run *r, street_drawing *d, const street_way *way)
{
    if (list_room(r, (void **)&d->way, &d->way_capacity, d->ways, 1, sizeof *d->way) != PCG_OK)
        return UINT32_MAX;
    d->way[d->ways] = *way;
    return d->ways++;
}

double drawing_length(const street_drawing *d)
{
    double length = 0;

    for (uint32_t i = 0; i < d->edges; i++)
        length += vec2_length(
            vec2_subtract(vec2_of(d->vertex[d->edge[i].to]), vec2_of(d->vertex[d->edge[i].from])));
    return length;
}

/* ---- networks -------------------------------------------------------------------------------- */

static int network_copy(pcg_run *r, pcg_entity *to, const pcg_entity *from)
{
    street_drawing *d = ((const pcg_streets *)from)->drawing;

    (void)r;
    d->references++;
    ((pcg_streets *)to)->drawing = d;
    return PCG_OK;
}

static void pack_way(pcg_packer *p, const street_way *w)
{
    const double widths[] = {w->width, w->left, w->right};

    pack_bytes(p, widths, sizeof widths);
    pack_u64(p, (pcg_u64)w->level);
    pack_string(p, w->name);
    pack_string(p, w->kind);
    pack_string(p, w->id);
}

static int network_pack(pcg_packer *p, const pcg_entity *e)
{
    const street_drawing *d = ((const pcg_streets *)e)->drawing;

    pack_u32(p, d->vertices);
    pack_u32(p, d->edges);
    pack_u32(p, d->ways);
    pack_bytes(p, d->vertex, d->vertices * sizeof *d->vertex);
    pack_bytes(p, d->edge, d->edges * sizeof *d->edge);
    for (uint32_t i = 0; i < d->ways; i++)
        pack_way(p, &d->way[i]);
    return pack_status(p);
}

static void unpack_way(pcg_unpacker *u, street_way *w)
{
    double widths[3];

    unpack_bytes(u, widths, sizeof widths);
    w->width = widths[0];
    w->left = widths[1];
    w->right = widths[2];
    w->level = (pcg_int)unpack_u64(u);
    w->name = unpack_string(u);
    w->kind = unpack_string(u);
    w->id = unpack_string(u);
    u->failed |= w->name == NULL || w->kind == NULL || w->id == NULL;
}

static bool is_sound(const street_drawing *d)
{
    for (uint32_t i = 0; i < d->edges; i++)
        if (d->edge[i].from >= d->vertices || d->edge[i].to >= d->vertices ||
            d->edge[i].way >= d->ways)
            return false;
    return true;
}

static int network_unpack(pcg_unpacker *u, pcg_entity *e)
{
    uint32_t vertices = unpack_count(u, sizeof(pcg_vec3)), edges = unpack_count(u, sizeof(street_edge));
    uint32_t ways = unpack_count(u, 3 * sizeof(double));
    street_drawing *d = u->failed ? NULL : drawing_new(u->run, vertices, edges, ways);

    if (d == NULL)
        return PCG_FAILED;
    d->vertices = vertices;
    d->edges = edges;
    d->ways = ways;
    unpack_bytes(u, d->vertex, vertices * sizeof *d->vertex);
    unpack_bytes(u, d->edge, edges * sizeof *d->edge);
    for (uint32_t i = 0; i < ways; i++)
        unpack_way(u, &d->way[i]);
    if (u->failed || !is_sound(d)) {
        drawing_drop(u->run, d);
        return PCG_FAILED;
    }
    ((pcg_streets *)e)->drawing = d;
    return PCG_OK;
}

static void network_drop(pcg_run *r, pcg_entity *e)
{
    drawing_drop(r, ((pcg_streets *)e)->drawing);
}

const pcg_type pcg_type_street_network = {"StreetNetwork", &pcg_type_entity, sizeof(pcg_streets),
                                          network_copy,    network_drop,     NULL,
                                          network_pack,    network_unpack};

pcg_streets *streets_new(pcg_call *c, const pcg_entity *ancestor)
{
    street_drawing *d = drawing_new(c->run, 0, 0, 0);
    pcg_streets *s = NULL;

    if (d != NULL)
        s = (pcg_streets *)pcg_entity_new(c, &pcg_type_street_network, ancestor);
    if (s != NULL)
        s->drawing = d;
    else if (d != NULL)
        drawing_drop(c->run, d);
    return s;
}

void streets_set(pcg_run *r, pcg_streets *s, street_drawing *d)
{
    street_drawing *old = s->drawing;

    s->drawing = d;
    drawing_drop(r, old);
}

street_drawing *streets_edit(pcg_run *r, pcg_streets *s)
{
    if (s->drawing->references > 1) {
        street_drawing *own = drawing_copy(r, s->drawing);

        if (own == NULL)
            return NULL;
        streets_set(r, s, own);
    }
    return s->drawing;
}

int streets_emit(pcg_call *call, const pcg_port *port, pcg_streets *s)
{
    return s != NULL ? pcg_emit(call, port, &s->entity) : PCG_FAILED;
}

/* ---- numbers --------------------------------------------------------------------------------- */

bool streets_is_place(pcg_vec3 at)
{
    return fabs(at.x) <= STREETS_FARTHEST && fabs(at.y) <= STREETS_FARTHEST &&
           fabs(at.z) <= STREETS_FARTHEST;
}

double streets_width(double width)
{
    return width > 0 && width <= STREETS_WIDEST ? width : 0;
}

double streets_snap(double a)
{
    return nearbyint(a * 1048576) / 1048576;
}

double vec2_length(pcg_vec2 a)
{
    return sqrt(a.x * a.x + a.y * a.y);
}

pcg_vec2 vec2_normal(pcg_vec2 a)
{
    double length = vec2_length(a);

    return length > 0 ? (pcg_vec2){a.x / length, a.y / length} : (pcg_vec2){0, 0};
}

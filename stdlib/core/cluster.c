/*pcg
/// Divides a list into clusters of what is alike.
///
/// Entities are points whose coordinates are the numbers and the vectors' components of all keys. The first `count`
/// of them are the first centres: `shuffle` before chooses them by chance. Each entity goes to the nearest centre,
/// the centres move to the middle of theirs, and so on until nothing changes (k-means). Keys count as they are: a
/// number of metres outweighs a share. An entity with a coordinate that is no finite number is in no cluster, which is
/// reported, and its `index` is -1. All entities leave in their order.
procedure cluster<T: Entity>(in: T[]) -> (out: T) [pure] {
    category "order"
    synonyms "k-means", "group", "partition", "classify", "nearest", "centroid", "zone"
    param count: int        /// How many clusters; there are never more than entities, and at least one.
    param rounds: int = 50 /// The most that the centres move.
    attr index: int         /// Written: the number of the cluster, from 0.
    attr distance: float    /// Written: how far the entity is from its cluster's centre.
    attr size: int          /// Written: how many are in the cluster.
    augment by(key: attribute) /// A number, a vector or a colour that tells how near entities are to each other.
    example rectangle(width = 2m, height = 3m)
        -> copy(count = 8, index => @n)
        -> set { assign(@place, @n % 2 * 100 + @n) }
        -> cluster(count = 2, index => @zone, size => @many) { by(@place) }
        -> c: condition(@zone == @n % 2 && @many == 4) expect c.yes.count = 8
}
*/
#include "cluster.h"
#include <math.h>
#include <stdint.h>
#include <string.h>
#include "runtime/memory.h"
#include "runtime/value.h"

typedef struct clusters {
    pcg_u32 points, dimensions, count;
    double *at;       /* points * dimensions */
    double *centre;   /* count * dimensions */
    double *sum;      /* the same */
    double *distance; /* of each point from its centre, squared */
    pcg_u32 *index;   /* of each point, its cluster; CLUSTER_NONE where it has none */
    pcg_u32 *size;    /* of each cluster */
} clusters;

#define CLUSTER_NONE UINT32_MAX

/* ---- points ---------------------------------------------------------------------------------- */

static int cluster_dimensions(pcg_call *call, const struct pcg_core_cluster *node, pcg_u32 *sum)
{
    *sum = 0;
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        int kind = node->items[i].by.key.kind;
        if (kind != PCG_INT && kind != PCG_BOOL && !value_has_floats(kind)) {
            return pcg_fail(
                call, "'%s' takes a number, a vector or a colour, not an attribute of type %s",
                node->items[i].name, value_kind_name(kind));
        }
        *sum += value_width(kind);
    }
    return *sum ? PCG_OK
                : pcg_fail(call, "there is no key to tell how near entities are: { by(@place) }");
}

/* False where a coordinate is no finite number. */
static int cluster_read(const struct pcg_core_cluster *node, const pcg_entity *e, double *to)
{
    int finite = 1;
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        const pcg_slot *key = &node->items[i].by.key;
        const pcg_cell *cells = pcg_get(e, key);
        for (pcg_u32 k = 0; k < value_width(key->kind); k++, to++) {
            *to = value_has_floats(key->kind) ? cells[k].f : (double)cells[k].i;
            finite &= isfinite(*to) != 0;
        }
    }
    return finite;
}

static int cluster_open(pcg_call *call, const struct pcg_core_cluster *node, clusters *c)
{
    pcg_run *r = call->run;
    pcg_u32 points = node->in.count;
    pcg_int count = node->count < 1 ? 1 : node->count;
    *c = (clusters){.points = points, .count = count < points ? (pcg_u32)count : points};
    PCG_TRY(cluster_dimensions(call, node, &c->dimensions));
    c->at = run_alloc_array(r, points, c->dimensions * sizeof *c->at);
    c->centre = run_alloc_array(r, c->count, c->dimensions * sizeof *c->centre);
    c->sum = run_alloc_array(r, c->count, c->dimensions * sizeof *c->sum);
    c->distance = run_alloc_array(r, points, sizeof *c->distance);
    c->index = run_alloc_array(r, points, sizeof *c->index);
    c->size = run_alloc_array(r, c->count, sizeof *c->size);
    return c->at && c->centre && c->sum && c->distance && c->index && c->size ? PCG_OK : PCG_FAILED;
}

static void cluster_close(pcg_run *r, clusters *c)
{
    size_t coordinates = c->dimensions * sizeof(double);
    run_free(r, c->at, c->points * coordinates);
    run_free(r, c->centre, c->count * coordinates);
    run_free(r, c->sum, c->count * coordinates);
    run_free(r, c->distance, c->points * sizeof *c->distance);
    run_free(r, c->index, c->points * sizeof *c->index);
    run_free(r, c->size, c->count * sizeof *c->size);
}

/* Reads the points; the first good ones are the centres. */
static int cluster_fill(pcg_call *call, const struct pcg_core_cluster *node, clusters *c)
{
    pcg_u32 seeds = 0, bad = 0;
    for (pcg_u32 i = 0; i < c->points; i++) {
        double *at = c->at + (size_t)i * c->dimensions;
        int good = cluster_read(node, node->in.at[i], at);
        c->index[i] = good ? 0 : CLUSTER_NONE;
        bad += !good;
        if (good && seeds < c->count) {
            memcpy(c->centre + (size_t)seeds++ * c->dimensions, at, c->dimensions * sizeof *at);
        }
        PCG_TRY(pcg_tick(call));
    }
    c->count = seeds ? seeds : c->count;
    return bad ? pcg_warn(call,
                          "%u entities have a coordinate that is no finite number: they are in no "
                          "cluster",
                          bad)
               : PCG_OK;
}

/* ---- rounds ---------------------------------------------------------------------------------- */

static pcg_u32 cluster_nearest(const clusters *c, const double *at, double *distance)
{
    pcg_u32 nearest = 0;
    *distance = INFINITY;
    for (pcg_u32 k = 0; k < c->count; k++) {
        const double *centre = c->centre + (size_t)k * c->dimensions;
        double sum = 0;
        for (pcg_u32 d = 0; d < c->dimensions; d++) {
            sum += (at[d] - centre[d]) * (at[d] - centre[d]);
        }
        if (sum < *distance) {
            *distance = sum;
            nearest = k;
        }
    }
    return nearest;
}

/* Gives each point to its nearest centre; *changed says whether one went elsewhere. */
static int cluster_assign(pcg_call *call, clusters *c, int *changed)
{
    for (pcg_u32 i = 0; i < c->points; i++) {
        if (c->index[i] != CLUSTER_NONE) {
            const double *at = c->at + (size_t)i * c->dimensions;
            pcg_u32 nearest = cluster_nearest(c, at, &c->distance[i]);
            *changed |= nearest != c->index[i];
            c->index[i] = nearest;
        }
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

/* A centre that nothing is near stays where it is. */
static void cluster_move(clusters *c)
{
    size_t bytes = (size_t)c->count * c->dimensions * sizeof *c->sum;
    memset(c->sum, 0, bytes);
    memset(c->size, 0, c->count * sizeof *c->size);
    for (pcg_u32 i = 0; i < c->points; i++) {
        if (c->index[i] != CLUSTER_NONE) {
            double *sum = c->sum + (size_t)c->index[i] * c->dimensions;
            for (pcg_u32 d = 0; d < c->dimensions; d++) {
                sum[d] += c->at[(size_t)i * c->dimensions + d];
            }
            c->size[c->index[i]]++;
        }
    }
    for (pcg_u32 k = 0; k < c->count; k++) {
        for (pcg_u32 d = 0; d < c->dimensions && c->size[k]; d++) {
            size_t at = (size_t)k * c->dimensions + d;
            c->centre[at] = c->sum[at] / c->size[k];
        }
    }
}

static int cluster_settle(pcg_call *call, clusters *c, pcg_int rounds)
{
    int changed = 1;
    PCG_TRY(cluster_assign(call, c, &changed));
    for (pcg_int round = 0; round < rounds && changed; round++) {
        changed = 0;
        cluster_move(c);
        PCG_TRY(cluster_assign(call, c, &changed));
    }
    memset(c->size, 0, c->count * sizeof *c->size);
    for (pcg_u32 i = 0; i < c->points; i++) {
        if (c->index[i] != CLUSTER_NONE) {
            c->size[c->index[i]]++;
        }
    }
    return PCG_OK;
}

/* ---- sending --------------------------------------------------------------------------------- */

static int cluster_send(pcg_call *call, const struct pcg_core_cluster *node, const clusters *c)
{
    for (pcg_u32 i = 0; i < c->points; i++) {
        pcg_entity *e = node->in.at[i];
        int none = c->index[i] == CLUSTER_NONE;
        pcg_set_int(call->run, e, &node->index, none ? -1 : (pcg_int)c->index[i]);
        pcg_set_float(call->run, e, &node->distance, none ? PCG_NAN : sqrt(c->distance[i]));
        pcg_set_int(call->run, e, &node->size, none ? 0 : (pcg_int)c->size[c->index[i]]);
        PCG_TRY(pcg_emit(call, node->out, e));
        PCG_TRY(pcg_tick(call));
    }
    return PCG_OK;
}

int pcg_core_cluster(pcg_call *call, struct pcg_core_cluster *node)
{
    clusters c;
    int status = cluster_open(call, node, &c);
    pcg_u32 room = c.count;
    if (status == PCG_OK) {
        status = cluster_fill(call, node, &c);
    }
    if (status == PCG_OK) {
        status = cluster_settle(call, &c, node->rounds);
    }
    if (status == PCG_OK) {
        status = cluster_send(call, node, &c);
    }
    c.count = room; /* what there was room for */
    cluster_close(call->run, &c);
    return status;
}

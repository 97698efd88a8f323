/* lists.c - what lists.pcg does with a list, by plain loops and qsort over an array of the same
 * keys.
 *
 *     lists COUNT
 */
#include <math.h>

#include "rival.h"

enum { PARTS = 1000, CLUSTERS = 8, CLUSTER_ROUNDS = 10 };

typedef struct item {
    int64_t key;
    uint32_t number, zone;
} item;

typedef struct list {
    item *at;
    size_t count;
} list;

/* What was computed, so that nothing is left out as useless. */
typedef struct outcome {
    int64_t total, most;
    uint64_t groups, moved;
} outcome;

static list make(size_t count)
{
    list l = {rival_array(count, sizeof(item)), count};
    for (size_t i = 0; i < count; i++)
        l.at[i] = (item){.key = (int64_t)i * 7919 % 1000003, .number = (uint32_t)i};
    return l;
}

static void aggregate(const list *l, outcome *o)
{
    for (size_t i = 0; i < l->count; i++) {
        o->total += l->at[i].key;
        o->most = l->at[i].key > o->most ? l->at[i].key : o->most;
    }
}

/* What is equal keeps its order. */
static int by_key(const void *a, const void *b)
{
    const item *x = a, *y = b;
    const int order = (x->key > y->key) - (x->key < y->key);
    return order ? order : (x->number > y->number) - (x->number < y->number);
}

/* The members of each group, one behind the other. */
static void group(const list *l, outcome *o)
{
    size_t ends[PARTS + 1] = {0};
    uint32_t *members = rival_array(l->count, sizeof *members);
    for (size_t i = 0; i < l->count; i++)
        ends[l->at[i].key % PARTS + 1]++;
    for (int i = 0; i < PARTS; i++) {
        o->groups += ends[i + 1] > 0;
        ends[i + 1] += ends[i];
    }
    for (size_t i = 0; i < l->count; i++)
        members[ends[l->at[i].key % PARTS]++] = (uint32_t)i;
    free(members);
}

static uint32_t nearest(const double centres[CLUSTERS], uint32_t count, double key)
{
    uint32_t best = 0;
    for (uint32_t i = 1; i < count; i++)
        if (fabs(centres[i] - key) < fabs(centres[best] - key))
            best = i;
    return best;
}

static uint64_t assign_zones(const list *l, const double centres[CLUSTERS], uint32_t clusters)
{
    uint64_t moved = 0;
    for (size_t i = 0; i < l->count; i++) {
        const uint32_t zone = nearest(centres, clusters, (double)l->at[i].key);
        moved += zone != l->at[i].zone;
        l->at[i].zone = zone;
    }
    return moved;
}

static void cluster(const list *l, outcome *o)
{
    const uint32_t clusters = l->count < CLUSTERS ? (uint32_t)l->count : CLUSTERS;
    double centres[CLUSTERS] = {0};
    for (uint32_t i = 0; i < clusters; i++)
        centres[i] = (double)l->at[i].key;
    for (size_t i = 0; i < l->count; i++)
        l->at[i].zone = CLUSTERS;
    for (int round = 0; round < CLUSTER_ROUNDS && assign_zones(l, centres, clusters); round++) {
        double sums[CLUSTERS] = {0}, counts[CLUSTERS] = {0};
        for (size_t i = 0; i < l->count; i++) {
            sums[l->at[i].zone] += (double)l->at[i].key;
            counts[l->at[i].zone]++;
        }
        for (uint32_t i = 0; i < clusters; i++)
            centres[i] = counts[i] > 0 ? sums[i] / counts[i] : centres[i];
        o->moved++;
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: lists COUNT\n", stderr);
        return 2;
    }
    const size_t count = rival_number(argv[1], 10000000);
    rival r = {0};
    outcome o = {0};
    rival_begin(&r);
    list l = make(count);
    rival_end(&r, "made");
    rival_begin(&r);
    aggregate(&l, &o);
    rival_end(&r, "aggregated");
    rival_begin(&r);
    group(&l, &o);
    rival_end(&r, "grouped");
    rival_begin(&r);
    cluster(&l, &o);
    rival_end(&r, "clustered");
    rival_begin(&r);
    qsort(l.at, l.count, sizeof *l.at, by_key);
    rival_end(&r, "ordered");
    fprintf(stderr, "sum %lld, most %lld, %llu rounds of clustering\n", (long long)o.total,
            (long long)o.most, (unsigned long long)o.moved);
    rival_print(&r, "groups", o.groups);
    free(l.at);
    return 0;
}

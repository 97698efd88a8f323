/* by.c - lists taken apart by what is equal in their entities' attributes. */
#include "by.h"
#include <string.h>
#include "runtime/grouping.h"
#include "runtime/memory.h"

/* Puts each entity into its group's part; `ends` are the parts' beginnings before. */
static void by_distribute(const pcg_entities *in, core_by *by)
{
    for (pcg_u32 i = 0; i < in->count; i++) {
        by->at[by->ends[by->group[i]]++] = in->at[i];
    }
}

static void by_fill(const pcg_entities *in, const grouping *g, core_by *by)
{
    pcg_u32 begin = 0;
    for (pcg_u32 i = 0; i < g->count; i++) {
        by->ends[i] = begin;
        begin += g->size[i];
    }
    by->count = g->count;
    memcpy(by->group, g->group, in->count * sizeof *by->group);
    by_distribute(in, by);
}

int core_by_open(pcg_call *call, const pcg_entities *in, const pcg_slot *const *keys,
                 pcg_u32 key_count, core_by *by)
{
    grouping g;
    *by = (core_by){.entities = in->count};
    PCG_TRY(grouping_open(call, in, keys, key_count, &g));
    by->at = run_alloc_array(call->run, in->count, sizeof *by->at);
    by->ends = run_alloc_array(call->run, in->count, sizeof *by->ends);
    by->group = run_alloc_array(call->run, in->count, sizeof *by->group);
    int status = by->at && by->ends && by->group ? PCG_OK : PCG_FAILED;
    if (status == PCG_OK) {
        by_fill(in, &g, by);
    } else {
        core_by_close(call->run, by);
    }
    grouping_close(call->run, &g);
    return status;
}

void core_by_close(pcg_run *r, core_by *by)
{
    run_free(r, by->at, by->entities * sizeof *by->at);
    run_free(r, by->ends, by->entities * sizeof *by->ends);
    run_free(r, by->group, by->entities * sizeof *by->group);
    *by = (core_by){0};
}

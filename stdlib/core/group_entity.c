/* group_entity.c - groups: entities that hold others, by reference. */
#include "group_entity.h"
#include <string.h>
#include "runtime/parcel.h"

static core_group *group_within(pcg_entity *e)
{
    return e->type == &core_type_group ? (core_group *)e : 0;
}

/* ---- copies ---------------------------------------------------------------------------------- */

static void group_give_up(pcg_run *r, core_group *g, pcg_u32 count, pcg_u32 room)
{
    for (pcg_u32 i = 0; i < count; i++) {
        pcg_entity_drop(r, g->members[i]);
    }
    run_free(r, g->members, room * sizeof *g->members);
}

static int group_copy(pcg_run *r, pcg_entity *to, const pcg_entity *from)
{
    core_group *copy = (core_group *)to;
    const core_group *original = (const core_group *)from;
    copy->members = run_alloc_array(r, original->count, sizeof *copy->members);
    if (!copy->members) {
        return PCG_FAILED;
    }
    for (pcg_u32 i = 0; i < original->count; i++) {
        copy->members[i] = pcg_entity_copy(r, original->members[i], to->lineage);
        if (!copy->members[i]) {
            group_give_up(r, copy, i, original->count);
            return PCG_FAILED;
        }
    }
    copy->count = original->count;
    copy->depth = original->depth;
    return PCG_OK;
}

static void group_drop(pcg_run *r, pcg_entity *e)
{
    core_group *g = (core_group *)e;
    group_give_up(r, g, g->count, g->count);
}

/* ---- leaving a graph ------------------------------------------------------------------------- */

/* Entities may be in a group by many ways: marked ones were seen. */
static void group_visit(pcg_run *r, core_group *g, pcg_u32 base)
{
    if (g->entity.mark) {
        return;
    }
    g->entity.mark = 1;
    for (pcg_u32 i = 0; i < g->count; i++) {
        core_group *within = group_within(g->members[i]);
        if (within) {
            attributes_leave(r, &within->entity, base);
            group_visit(r, within, base);
        } else {
            pcg_leave(r, g->members[i], base);
        }
    }
}

static void group_unmark(core_group *g)
{
    if (!g->entity.mark) {
        return;
    }
    g->entity.mark = 0;
    for (pcg_u32 i = 0; i < g->count && g->depth > 1; i++) {
        core_group *within = group_within(g->members[i]);
        if (within) {
            group_unmark(within);
        }
    }
}

static void group_leave(pcg_run *r, pcg_entity *e, pcg_u32 base)
{
    group_visit(r, (core_group *)e, base);
    group_unmark((core_group *)e);
}

/* ---- parcels --------------------------------------------------------------------------------- */

static pcg_u32 group_depth(pcg_entity *const *members, pcg_u32 count)
{
    pcg_u32 depth = 0;
    for (pcg_u32 i = 0; i < count; i++) {
        const core_group *within = group_within(members[i]);
        if (within && within->depth > depth) {
            depth = within->depth;
        }
    }
    return depth + 1;
}

static int group_pack(pcg_packer *p, const pcg_entity *e)
{
    const core_group *g = (const core_group *)e;
    pack_u32(p, g->count);
    for (pcg_u32 i = 0; i < g->count; i++) {
        pack_entity(p, g->members[i]);
    }
    return pack_status(p);
}

static int group_unpack(pcg_unpacker *u, pcg_entity *e)
{
    core_group *g = (core_group *)e;
    pcg_u32 count = unpack_count(u, sizeof(pcg_u32));
    g->members = count ? run_alloc_array(u->run, count, sizeof *g->members) : 0;
    while (g->members && g->count < count && !u->failed) {
        pcg_entity *member = unpack_entity(u);
        if (member) {
            g->members[g->count++] = member;
        }
    }
    if (!count || g->count < count) {
        group_give_up(u->run, g, g->count, count);
        return PCG_FAILED;
    }
    g->depth = group_depth(g->members, count);
    return PCG_OK;
}

const pcg_type core_type_group = {"Group",    &pcg_type_entity, sizeof(core_group),
                                  group_copy, group_drop,       group_leave,
                                  group_pack, group_unpack};

/* ---- making ---------------------------------------------------------------------------------- */

static core_group *group_begin(pcg_call *call, pcg_entity *const *members, pcg_u32 count)
{
    pcg_u32 depth = group_depth(members, count);
    if (depth > CORE_GROUP_DEPTH) {
        pcg_fail(call, "groups are in groups more than %d deep", CORE_GROUP_DEPTH);
        return 0;
    }
    core_group *g = (core_group *)pcg_entity_new(call, &core_type_group, members[0]);
    if (!g) {
        return 0;
    }
    g->members = run_alloc_array(call->run, count, sizeof *g->members);
    if (!g->members) {
        pcg_entity_drop(call->run, &g->entity);
        return 0;
    }
    g->depth = depth;
    return g;
}

core_group *core_group_new(pcg_call *call, pcg_entity *const *members, pcg_u32 count)
{
    core_group *g = group_begin(call, members, count);
    if (!g) {
        for (pcg_u32 i = 0; i < count; i++) {
            pcg_entity_drop(call->run, members[i]);
        }
        return 0;
    }
    memcpy(g->members, members, count * sizeof *g->members);
    g->count = count;
    return g;
}

/* members.c - what a container holds: the members of a group, the parts of a shape. */
#include "members.h"
#include "enumerations.h"
#include "group_entity.h"
#include "runtime/memory.h"
#include "runtime/part.h"

static int members_of_shape(pcg_call *call, pcg_shape *s, part_kind kind, core_members *m)
{
    pcg_u32 count;
    PCG_TRY(parts_count(call->run, s, kind, &count));
    if (count == 0) {
        return PCG_OK;
    }
    m->at = run_alloc_array(call->run, count, sizeof *m->at);
    if (!m->at) {
        return PCG_FAILED;
    }
    m->count = count;
    for (; m->owned < count; m->owned++) {
        pcg_part *part = parts_at(call, s, kind, m->owned);
        if (!part) {
            core_members_close(call->run, m);
            return PCG_FAILED;
        }
        m->at[m->owned] = &part->entity;
    }
    return PCG_OK;
}

int core_members_open(pcg_call *call, pcg_entity *container, int kind, core_members *m)
{
    static const part_kind kinds[] = {
        [PCG_PART_KIND_FACES] = PART_FACE,
        [PCG_PART_KIND_EDGES] = PART_EDGE,
        [PCG_PART_KIND_VERTICES] = PART_VERTEX,
    };
    *m = (core_members){.there = 1};
    if (container->type == &core_type_group) {
        m->at = ((core_group *)container)->members;
        m->count = ((core_group *)container)->count;
        return PCG_OK;
    }
    if (pcg_entity_is(container, &pcg_type_shape)) {
        return members_of_shape(call, (pcg_shape *)container, kinds[kind], m);
    }
    m->there = 0;
    return pcg_warn(call, "an entity of type %s holds no others: only groups and shapes do",
                    container->type->name);
}

void core_members_close(pcg_run *r, core_members *m)
{
    for (pcg_u32 i = 0; i < m->owned; i++) {
        pcg_entity_drop(r, m->at[i]);
    }
    if (m->owned) {
        run_free(r, m->at, m->count * sizeof *m->at);
    }
}

/* entity.c - entities: making, copying, counting references. */
#include <string.h>

#include "observe.h"

const pcg_type pcg_type_entity = {"Entity", NULL, sizeof(pcg_entity), NULL, NULL, NULL,
                                  NULL,     NULL};
const pcg_type pcg_type_impulse = {"Impulse", &pcg_type_entity, sizeof(pcg_entity), NULL, NULL,
                                   NULL,      NULL,             NULL};

/* Tells the line of a copy from that of a descendant. */
static const pcg_u64 copy_key = 0xC0F1E5C0F1E5C0F1u;

/* Memory for one more entity, counted; NULL when it or the limit is passed. */
static pcg_entity *entity_alloc(pcg_run *r, const pcg_type *type, const pcg_node *node,
                                pcg_u64 round)
{
    if (r->entities >= r->max_entities) {
        run_fail(r, PCG_LIMIT, DIAG_E0703, node, round, r->max_entities);
        return NULL;
    }
    pcg_entity *e = run_alloc(r, type->size);
    if (e && ++r->entities > r->most_entities)
        r->most_entities = r->entities;
    return e;
}

pcg_entity *pcg_entity_new(pcg_call *c, const pcg_type *type, const pcg_entity *ancestor)
{
    pcg_run *r = c->run;
    if (!ancestor)
        ancestor = c->first;
    pcg_entity *e = entity_alloc(r, type, c->node, c->round);
    if (!e)
        return NULL;
    memset(e, 0, type->size);
    e->type = type;
    e->maker = c->node;
    e->references = 1;
    e->lineage = pcg_mix(pcg_mix(ancestor ? ancestor->lineage : c->lineage, c->key), ++c->made);
    if (ancestor)
        e->attributes = attributes_hold(ancestor->attributes);
    if (r->observed)
        observe_made(r, e, ancestor);
    return e;
}

pcg_entity *pcg_entity_copy(pcg_run *r, const pcg_entity *e, pcg_u64 which)
{
    const pcg_type *type = e->type;
    pcg_entity *copy = entity_alloc(r, type, r->node, r->round);
    if (!copy)
        return NULL;
    memset(copy, 0, type->size);
    memcpy(copy, e, type->copy ? sizeof *e : type->size);
    copy->references = 1;
    copy->mark = 0;
    copy->lineage = pcg_mix(pcg_mix(e->lineage, copy_key), which);
    if (type->copy && type->copy(r, copy, e) != PCG_OK) {
        run_free(r, copy, type->size);
        r->entities--;
        return NULL;
    }
    attributes_hold(copy->attributes);
    if (r->observed)
        observe_made(r, copy, e);
    return copy;
}

pcg_entity *entity_empty(pcg_run *r, const pcg_type *type)
{
    pcg_entity *e = entity_alloc(r, type, r->node, r->round);
    if (!e)
        return NULL;
    memset(e, 0, type->size);
    e->type = type;
    e->references = 1;
    return e;
}

pcg_entity *pcg_entity_hold(pcg_entity *e)
{
    e->references++;
    return e;
}

void pcg_entity_drop(pcg_run *r, pcg_entity *e)
{
    if (--e->references)
        return;
    const pcg_type *type = e->type;
    if (type->drop)
        type->drop(r, e);
    attributes_drop(r, e->attributes);
    run_free(r, e, type->size);
    r->entities--;
}

int pcg_entity_is(const pcg_entity *e, const pcg_type *type)
{
    for (const pcg_type *t = e->type; t; t = t->parent)
        if (t == type)
            return 1;
    return 0;
}

/* pool.c - what a graph keeps by key. */
#include "pool.h"

#include "keys.h"
#include "list.h"
#include "run.h"

enum { SHELVES = POOL_MESSAGES + 1 };

typedef struct shelf {
    run_keys keys;
    pool_list *lists; /* by the key's number */
    pcg_u32 list_capacity;
} shelf;

struct pcg_pool {
    shelf shelves[SHELVES];
    pool_list touched; /* what others hold, too: loses this graph's attributes */
};

/* ---- adding ---------------------------------------------------------------------------------- */

static int list_add(pcg_run *r, pool_list *list, pcg_entity *e)
{
    if (list_room(r, (void **)&list->at, &list->capacity, list->count, 1, sizeof *list->at) !=
        PCG_OK)
        return PCG_FAILED;
    list->at[list->count++] = pcg_entity_hold(e);
    return PCG_OK;
}

static struct pcg_pool *pool_of(pcg_run *r, pcg_frame *f)
{
    if (!f->pool)
        f->pool = run_alloc_zeroed(r, sizeof *f->pool);
    return f->pool;
}

/* The list of a key, which is made where it is new; NULL when memory has run out. */
static pool_list *list_of(pcg_run *r, shelf *s, const char *key)
{
    pcg_u32 before = s->keys.count, number = keys_number(r, &s->keys, key);
    if (number == KEYS_NONE)
        return NULL;
    if (s->keys.count > before) {
        if (list_room(r, (void **)&s->lists, &s->list_capacity, before, 1, sizeof *s->lists) !=
            PCG_OK)
            return NULL;
        s->lists[number] = (pool_list){0};
    }
    return &s->lists[number];
}

int pool_lend(pcg_call *call, pcg_frame *owner, pcg_entity *e)
{
    for (pcg_frame *f = call->frame; f && f != owner; f = f->parent) {
        struct pcg_pool *pool = pool_of(call->run, f);
        if (!pool || list_add(call->run, &pool->touched, e) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* Who holds a part of a shape holds the shape. */
static bool is_held_elsewhere(const pcg_entity *e)
{
    return e->references > 1 || (e->type->leave && !pcg_entity_is(e, &pcg_type_shape));
}

int pcg_enter(pcg_frame *f, pcg_entity *e, pcg_u32 base)
{
    pcg_leave(f->run, e, base);
    if (!is_held_elsewhere(e))
        return PCG_OK;
    struct pcg_pool *pool = pool_of(f->run, f);
    return pool ? list_add(f->run, &pool->touched, e) : PCG_FAILED;
}

int pool_add(pcg_call *call, pcg_frame *owner, pool_shelf where, const char *key, pcg_entity *e)
{
    struct pcg_pool *pool = pool_of(call->run, owner);
    pool_list *list = pool ? list_of(call->run, &pool->shelves[where], key) : NULL;
    if (!list || list_add(call->run, list, e) != PCG_OK)
        return PCG_FAILED;
    return pool_lend(call, owner, e);
}

/* ---- finding --------------------------------------------------------------------------------- */

pcg_u32 pool_number(const pcg_frame *f, pool_shelf where, const char *key)
{
    return f->pool ? keys_find(&f->pool->shelves[where].keys, key) : KEYS_NONE;
}

const pool_list *pool_at(const pcg_frame *f, pool_shelf where, pcg_u32 number)
{
    return &f->pool->shelves[where].lists[number];
}

pool_list *pool_find(pcg_frame *from, pool_shelf where, const char *key, pcg_frame **owner)
{
    for (pcg_frame *f = from; f; f = f->parent) {
        pcg_u32 number = pool_number(f, where, key);
        if (number != KEYS_NONE) {
            *owner = f;
            return &f->pool->shelves[where].lists[number];
        }
    }
    return NULL;
}

pcg_frame *pool_outermost(pcg_frame *f)
{
    while (f->parent)
        f = f->parent;
    return f;
}

/* ---- the end of an execution ----------------------------------------------------------------- */

static void list_close(pcg_run *r, pool_list *list)
{
    for (pcg_u32 i = 0; i < list->count; i++)
        pcg_entity_drop(r, list->at[i]);
    run_free(r, list->at, list->capacity * sizeof *list->at);
}

static void shelf_close(pcg_run *r, shelf *s)
{
    for (pcg_u32 k = 0; k < s->keys.count; k++)
        list_close(r, &s->lists[k]);
    run_free(r, s->lists, s->list_capacity * sizeof *s->lists);
    keys_close(r, &s->keys);
}

void pool_empty(pcg_frame *f)
{
    for (int i = 0; f->pool && i < SHELVES; i++) {
        shelf_close(f->run, &f->pool->shelves[i]);
        f->pool->shelves[i] = (shelf){0};
    }
}

void pcg_pool_end(pcg_frame *f)
{
    pcg_run *r = f->run;
    struct pcg_pool *pool = f->pool;
    for (pcg_u32 i = 0; i < pool->touched.count; i++)
        pcg_leave(r, pool->touched.at[i], f->base);
    list_close(r, &pool->touched);
    for (int i = 0; i < SHELVES; i++)
        shelf_close(r, &pool->shelves[i]);
    run_free(r, pool, sizeof *pool);
    f->pool = NULL;
}

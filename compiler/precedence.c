/* precedence.c - see precedence.h. */
#include "precedence.h"

#include <stdlib.h>

precedence precedence_new(arena *a, uint32_t *at, uint32_t count)
{
    precedence p = {.arena = a, .count = count, .at = at};
    p.position = ARENA_ARRAY(a, uint32_t, count);
    p.out = ARENA_ARRAY(a, uint32_t, count);
    p.in = ARENA_ARRAY(a, uint32_t, count);
    p.marked = ARENA_ARRAY(a, bool, count);
    for (uint32_t i = 0; i < count; i++) {
        p.position[at[i]] = i;
        p.out[i] = p.in[i] = PRECEDENCE_NONE;
    }
    return p;
}

static void record(precedence *p, uint32_t from, uint32_t to)
{
    precedence_link l = {from, to, p->out[from], p->in[to]};
    p->out[from] = p->in[to] = p->links.count;
    LIST_ADD(p->arena, &p->links, l);
}

/* Collects in `after` what `to` comes before, up to the position of `from`; false when that is
 * `from` itself. */
static bool search_after(precedence *p, uint32_t from, uint32_t to)
{
    uint32_t last = p->position[from];
    p->after.count = 0;
    p->marked[to] = true;
    LIST_ADD(p->arena, &p->after, to);
    for (uint32_t i = 0; i < p->after.count; i++) {
        uint32_t vertex = p->after.at[i];
        for (uint32_t l = p->out[vertex]; l != PRECEDENCE_NONE; l = p->links.at[l].next_out) {
            uint32_t next = p->links.at[l].to;
            if (next == from) {
                return false;
            }
            if (p->position[next] < last && !p->marked[next]) {
                p->marked[next] = true;
                LIST_ADD(p->arena, &p->after, next);
            }
        }
    }
    return true;
}

/* Collects in `before` what comes before `from`, down to the position of `to`. */
static void search_before(precedence *p, uint32_t from, uint32_t to)
{
    uint32_t first = p->position[to];
    p->before.count = 0;
    p->marked[from] = true;
    LIST_ADD(p->arena, &p->before, from);
    for (uint32_t i = 0; i < p->before.count; i++) {
        uint32_t vertex = p->before.at[i];
        for (uint32_t l = p->in[vertex]; l != PRECEDENCE_NONE; l = p->links.at[l].next_in) {
            uint32_t next = p->links.at[l].from;
            if (p->position[next] > first && !p->marked[next]) {
                p->marked[next] = true;
                LIST_ADD(p->arena, &p->before, next);
            }
        }
    }
}

static int compare_numbers(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Replaces vertices by their positions, in ascending order. */
static void sort_positions(const precedence *p, uint32_t *vertices, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        vertices[i] = p->position[vertices[i]];
    }
    qsort(vertices, count, sizeof *vertices, compare_numbers);
}

/* Gives the places that both sets hold to `before` first and to `after` then, each in the order
 * that it had. */
static void move(precedence *p)
{
    uint32_t first = p->before.count, count = first + p->after.count;
    sort_positions(p, p->before.at, p->before.count);
    sort_positions(p, p->after.at, p->after.count);
    p->slots.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        LIST_ADD(p->arena, &p->slots, i < first ? p->before.at[i] : p->after.at[i - first]);
    }
    for (uint32_t i = 0; i < count;
         i++) { /* from positions back to vertices, before any is overwritten */
        uint32_t *position = i < first ? &p->before.at[i] : &p->after.at[i - first];
        *position = p->at[*position];
    }
    qsort(p->slots.at, count, sizeof *p->slots.at, compare_numbers);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t vertex = i < first ? p->before.at[i] : p->after.at[i - first];
        p->at[p->slots.at[i]] = vertex;
        p->position[vertex] = p->slots.at[i];
    }
}

bool precedence_add(precedence *p, uint32_t from, uint32_t to)
{
    if (from == to) {
        return false;
    }
    bool possible = true;
    if (p->position[from] > p->position[to]) {
        possible = search_after(p, from, to);
        for (uint32_t i = 0; i < p->after.count; i++) {
            p->marked[p->after.at[i]] = false;
        }
        if (possible) {
            search_before(p, from, to);
            for (uint32_t i = 0; i < p->before.count; i++) {
                p->marked[p->before.at[i]] = false;
            }
            move(p);
        }
    }
    if (possible) {
        record(p, from, to);
    }
    return possible;
}

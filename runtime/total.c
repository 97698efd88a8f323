/* total.c - what `report` adds up, by key. */
#include <stdlib.h>
#include <string.h>

#include "list.h"
#include "result.h"
#include "run.h"

int total_add(pcg_run *r, const char *key, double amount)
{
    run_totals *t = &r->totals;
    pcg_u32 before = t->keys.count, number = keys_number(r, &t->keys, key);
    if (number == KEYS_NONE)
        return PCG_FAILED;
    if (t->keys.count > before) {
        if (list_room(r, (void **)&t->at, &t->capacity, before, 1, sizeof *t->at) != PCG_OK)
            return PCG_FAILED;
        t->at[number] = (pcg_total){t->keys.at[number], 0, amount, amount, 0};
        t->count = t->keys.count;
    }
    pcg_total *total = &t->at[number];
    total->count++;
    total->sum += amount;
    total->least = amount < total->least ? amount : total->least;
    total->most = amount > total->most ? amount : total->most;
    return PCG_OK;
}

static int compare(const void *a, const void *b)
{
    return strcmp(((const pcg_total *)a)->key, ((const pcg_total *)b)->key);
}

void total_sort(pcg_run *r)
{
    if (r->totals.count)
        qsort(r->totals.at, r->totals.count, sizeof *r->totals.at, compare);
}

size_t pcg_run_total_count(const pcg_run *r)
{
    return result_ready(r) ? r->totals.count : 0;
}

bool pcg_run_total(const pcg_run *r, size_t i, pcg_total *out)
{
    if (i >= pcg_run_total_count(r))
        return false;
    *out = r->totals.at[i];
    return true;
}

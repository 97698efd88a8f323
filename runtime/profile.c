/* profile.c - what the surrogate `profile` tells at the end of a run. */
#include <time.h>

#include "surrogate.h"
#include "value.h"

pcg_int profile_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (pcg_int)now.tv_sec * 1000000000 + now.tv_nsec;
}

void profile_begin(pcg_run *r, pcg_choice *k)
{
    *(r->profiled_end ? r->profiled_end : &r->profiled) = k;
    r->profiled_end = &k->next_profiled;
}

/* "; height = 3m, count = 2": the newest values. */
static void add_parameters(const pcg_choice *k, text *out)
{
    for (pcg_u32 i = 0; i < k->module->parameter_count; i++) {
        const pcg_parameter_info *p = &k->module->parameters[i];
        const value_type type = {p->kind, p->element, p->enumerators};
        text_format(out, "%s %s = ", i ? "," : ";", p->name);
        value_write(out, &type, (const pcg_cell *)((const char *)k->frame + p->offset));
    }
}

static const char *plural(pcg_u64 count)
{
    return count == 1 ? "" : "s";
}

static void report_profile(pcg_run *r, const pcg_choice *k)
{
    char seconds[VALUE_NUMBER_BYTES];
    arena scratch = {.limit = 1 << 20};
    text line = {.arena = &scratch};
    snprintf(seconds, sizeof seconds, "%lld.%06lld", k->time / 1000000000,
             k->time / 1000 % 1000000);
    text_format(&line, "graph '%s' ran %llu time%s in %s s: %llu round%s, %llu in, %llu out",
                k->module->name, k->executions, plural(k->executions), seconds, k->rounds,
                plural(k->rounds), k->entered, k->left);
    if (k->started)
        add_parameters(k, &line);
    if (line.at)
        message_tell(r, PCG_NOTE, MESSAGE_PLAIN, k->node, 0, line.at);
    arena_free(&scratch);
}

void report_profiles(pcg_run *r)
{
    for (const pcg_choice *k = r->profiled; k; k = k->next_profiled)
        report_profile(r, k);
}

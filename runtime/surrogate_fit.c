/* surrogate_fit.c - whether a graph that a surrogate has chosen is as its braces declare: every
 * declared name is there, and of a type that goes with it. */
#include <string.h>

#include "surrogate.h"

typedef struct fitting {
    pcg_call *call;
    const pcg_surrogate_info *info;
    pcg_choice *made;
} fitting;

/* ---- places --------------------------------------------------------------------------------- */

/* The row of a gate, or, where there is none of that name, of the graph itself. */
static const pcg_node *node_of(const pcg_module *m, const char *name)
{
    const pcg_node *whole = NULL;
    for (pcg_u32 i = 0; i < m->node_count; i++) {
        const pcg_node *n = &m->nodes[i];
        if (strcmp(n->graph, m->name) != 0)
            continue;
        if (!strcmp(n->name, name) && (!strcmp(n->procedure, "in") || !strcmp(n->procedure, "out")))
            return n;
        if (!strcmp(n->procedure, "graph"))
            whole = n;
    }
    return whole;
}

static const char *place_of(const fitting *f, const char *name)
{
    const pcg_node *n = node_of(f->made->module, name);
    return n ? pcg_format(f->call->run, "%s:%u:%u", n->file, n->line, n->column) : "";
}

/* ---- what does not fit ---------------------------------------------------------------------- */

static int misfit(const fitting *f, const char *what, const pcg_declared *d, const char *name,
                  const char *type)
{
    pcg_call *c = f->call;
    return run_fail(c->run, PCG_FAILED, DIAG_E0711, c->node, c->round, what, name,
                    f->made->module->name, type, place_of(f, name), d->type, d->line);
}

static int missing(const fitting *f, const char *what, const pcg_declared *d)
{
    pcg_call *c = f->call;
    return run_fail(c->run, PCG_FAILED, DIAG_E0712, c->node, c->round, f->made->module->name,
                    place_of(f, ""), what, d->name, d->type, d->line);
}

/* Whether a type is one of those separated by \n. */
static bool is_among(const char *type, const char *types)
{
    size_t length = strlen(type);
    for (const char *at = types; *at;) {
        size_t line = strcspn(at, "\n");
        if (line == length && !memcmp(at, type, length))
            return true;
        at += line + (at[line] == '\n');
    }
    return false;
}

/* ---- ports ---------------------------------------------------------------------------------- */

static int fit_input(const fitting *f, pcg_u32 number)
{
    const pcg_declared *d = &f->info->inputs[number];
    const pcg_module *m = f->made->module;
    for (pcg_u32 i = 0; i < m->input_count; i++) {
        const pcg_port_info *p = &m->inputs[i];
        if (strcmp(p->name, d->name) != 0)
            continue;
        return is_among(p->type, d->bases) ? PCG_OK : misfit(f, "input", d, p->name, p->type);
    }
    return missing(f, "input", d);
}

static int fit_output(const fitting *f, pcg_u32 number)
{
    const pcg_declared *d = &f->info->outputs[number];
    const pcg_module *m = f->made->module;
    for (pcg_u32 i = 0; i < m->gate_count; i++) {
        const pcg_port_info *p = &m->outputs[i];
        if (strcmp(p->name, d->name) != 0)
            continue;
        f->made->outputs[i] = number;
        return is_among(d->type, p->bases) ? PCG_OK : misfit(f, "output", d, p->name, p->type);
    }
    return missing(f, "output", d);
}

/* Every output that has no port of its own goes out of the aggregating one. */
static int fit_rest(const fitting *f)
{
    const pcg_declared *d = &f->info->outputs[f->info->rest];
    const pcg_module *m = f->made->module;
    for (pcg_u32 i = 0; i < m->output_count; i++) {
        const pcg_port_info *p = &m->outputs[i];
        if (f->made->outputs[i] != NO_OUTPUT)
            continue;
        f->made->outputs[i] = f->info->rest;
        if (!is_among(d->type, p->bases))
            return misfit(f, "output", d, p->name, p->type);
    }
    return PCG_OK;
}

static int fit_ports(const fitting *f)
{
    for (pcg_u32 i = 0; i < f->info->input_count; i++)
        PCG_TRY(fit_input(f, i));
    for (pcg_u32 i = 0; i < f->info->output_count; i++)
        if (i != f->info->rest)
            PCG_TRY(fit_output(f, i));
    return f->info->rest == PCG_NO_REST ? PCG_OK : fit_rest(f);
}

/* ---- parameters and attributes -------------------------------------------------------------- */

static int fit_parameter(const fitting *f, pcg_u32 number)
{
    const pcg_declared *d = &f->info->parameters[number];
    const pcg_module *m = f->made->module;
    for (pcg_u32 i = 0; i < m->parameter_count; i++) {
        const pcg_parameter_info *p = &m->parameters[i];
        if (strcmp(p->name, d->name) != 0)
            continue;
        f->made->parameters[number] = p;
        return !strcmp(p->type, d->type) ? PCG_OK : misfit(f, "parameter", d, p->name, p->type);
    }
    return missing(f, "parameter", d);
}

static int fit_attribute(const fitting *f, pcg_u32 number)
{
    const pcg_declared *d = &f->info->attributes[number];
    const pcg_module *m = f->made->module;
    for (pcg_u32 i = 0; i < m->attribute_count; i++) {
        const pcg_attribute_info *a = &m->attributes[i];
        if (strcmp(a->name, d->name) != 0)
            continue;
        f->made->attributes[number] = a;
        return !strcmp(a->type, d->type) ? PCG_OK : misfit(f, "attribute", d, a->name, a->type);
    }
    return missing(f, "attribute", d);
}

/* ---- the whole interface -------------------------------------------------------------------- */

int surrogate_fit(pcg_call *c, const pcg_surrogate_info *info, pcg_choice *made)
{
    pcg_run *r = c->run;
    const fitting f = {c, info, made};
    made->parameters = run_alloc_array(r, info->parameter_count, sizeof *made->parameters);
    made->attributes = run_alloc_array(r, info->attribute_count, sizeof *made->attributes);
    made->outputs = run_alloc_array(r, made->module->output_count, sizeof *made->outputs);
    if (r->status != PCG_OK)
        return r->status;
    for (pcg_u32 i = 0; i < made->module->output_count; i++)
        made->outputs[i] = NO_OUTPUT;
    PCG_TRY(fit_ports(&f));
    for (pcg_u32 i = 0; i < info->parameter_count; i++)
        PCG_TRY(fit_parameter(&f, i));
    for (pcg_u32 i = 0; i < info->attribute_count; i++)
        PCG_TRY(fit_attribute(&f, i));
    return PCG_OK;
}

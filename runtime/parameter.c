/* parameter.c - a host sets the parameters of a run. */
#include <math.h>
#include <string.h>

#include "constraint.h"
#include "run.h"

/* ---- finding and storing -------------------------------------------------------------------- */

static pcg_status refuse_name(pcg_run *r, const char *name)
{
    const pcg_module *m = r->module;
    arena scratch = {.limit = 1 << 20};
    const char **names =
        m->parameter_count ? ARENA_ARRAY(&scratch, const char *, m->parameter_count) : NULL;
    for (pcg_u32 i = 0; names && i < m->parameter_count; i++)
        names[i] = m->parameters[i].name;
    const char *near = names ? nearest_name(name, names, m->parameter_count) : NULL;
    if (near)
        run_misuse(r, "graph '%s' has no parameter '%s': did you mean '%s'?", m->name, name, near);
    else
        run_misuse(r, "graph '%s' has no parameter '%s'", m->name, name);
    arena_free(&scratch);
    return PCG_STATUS_MISUSE;
}

/* The parameter, where one may be set now; otherwise NULL, and *status. */
static const pcg_parameter_info *find(pcg_run *r, const char *name, pcg_status *status)
{
    *status = (pcg_status)r->status;
    if (!name)
        *status = run_misuse(r, "no parameter is named");
    else if (r->stage != RUN_NEW)
        *status = run_misuse(
            r, "parameters are set before the run is executed, '%s' comes too late", name);
    if (*status != PCG_STATUS_OK)
        return NULL;
    for (pcg_u32 i = 0; i < r->module->parameter_count; i++)
        if (!strcmp(r->module->parameters[i].name, name))
            return &r->module->parameters[i];
    *status = refuse_name(r, name);
    return NULL;
}

static value_type type_of(const pcg_parameter_info *p)
{
    value_type t = {.kind = p->kind, .element = p->element, .enumerators = p->enumerators};
    return t;
}

/* Where memory ran out while a value was read, the run is over, and that is what was wrong. */
static pcg_status refuse(pcg_run *r, const pcg_parameter_info *p, const char *why)
{
    if (r->status != PCG_OK)
        return (pcg_status)r->status;
    return run_misuse(r, "parameter '%s' %s", p->name, why);
}

static pcg_status store(pcg_run *r, const pcg_parameter_info *p, const pcg_cell *from)
{
    char why[VALUE_WHY_BYTES];
    const value_type t = type_of(p);
    for (pcg_u32 i = 0; i < p->constraint_count; i++)
        if (!constraint_holds(r, &p->constraints[i], &t, from, why))
            return refuse(r, p, why);
    if (r->status != PCG_OK)
        return (pcg_status)r->status;
    memcpy(run_at(r, p->offset), from, value_width(p->kind) * sizeof *from);
    *(pcg_u8 *)run_at(r, p->given) = 1;
    return PCG_STATUS_OK;
}

static pcg_status refuse_type(pcg_run *r, const pcg_parameter_info *p, const char *found)
{
    return run_misuse(r, "parameter '%s' is of type %s, not %s", p->name, p->type, found);
}

/* ---- setters -------------------------------------------------------------------------------- */

pcg_status pcg_run_set(pcg_run *r, const char *name, const char *value)
{
    char why[VALUE_WHY_BYTES];
    pcg_cell cell[4] = {{0}};
    pcg_status status;
    const pcg_parameter_info *p = find(r, name, &status);
    if (!p)
        return status;
    if (!value)
        return refuse(r, p, "needs a value");
    const value_type t = type_of(p);
    return value_read(r, &t, value, cell, why) ? store(r, p, cell) : refuse(r, p, why);
}

pcg_status pcg_run_set_bool(pcg_run *r, const char *name, bool value)
{
    const pcg_cell cell = {.i = value};
    pcg_status status;
    const pcg_parameter_info *p = find(r, name, &status);
    if (!p)
        return status;
    return p->kind == PCG_BOOL ? store(r, p, &cell) : refuse_type(r, p, "bool");
}

pcg_status pcg_run_set_float(pcg_run *r, const char *name, double value)
{
    const pcg_cell cell = {.f = value};
    pcg_status status;
    const pcg_parameter_info *p = find(r, name, &status);
    if (!p)
        return status;
    if (!value_is_float(p->kind))
        return refuse_type(r, p, "float");
    return isfinite(value) ? store(r, p, &cell) : refuse(r, p, "takes a finite number");
}

pcg_status pcg_run_set_int(pcg_run *r, const char *name, int64_t value)
{
    const pcg_cell cell = {.i = value};
    pcg_status status;
    const pcg_parameter_info *p = find(r, name, &status);
    if (!p)
        return status;
    if (value_is_float(p->kind))
        return pcg_run_set_float(r, name, (double)value);
    return p->kind == PCG_INT ? store(r, p, &cell) : refuse_type(r, p, "int");
}

pcg_status pcg_run_set_string(pcg_run *r, const char *name, const char *value)
{
    pcg_cell cell = {0};
    pcg_status status;
    const pcg_parameter_info *p = find(r, name, &status);
    if (!p)
        return status;
    if (p->kind == PCG_ENUM)
        return pcg_run_set(r, name, value);
    if (p->kind != PCG_STRING && p->kind != PCG_PATH)
        return refuse_type(r, p, "string");
    if (!value)
        return refuse(r, p, "needs a value");
    if (!value_is_utf8(value))
        return refuse(r, p, "takes a text in UTF-8");
    cell.s = pcg_string(r, value);
    return store(r, p, &cell);
}

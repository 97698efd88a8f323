/* result.c - what came out of a run: entities, attributes, messages. */
#include "result.h"

#include <string.h>

#include "run.h"
#include "value.h"

static const pcg_entities nothing = {NULL, 0};

const pcg_entities *run_output(const pcg_run *r, size_t output)
{
    return r->stage == RUN_EXECUTED && r->outputs && output < r->module->output_count
               ? &r->outputs[output]
               : &nothing;
}

/* NULL where there is no such entity. */
static const pcg_entity *find_entity(const pcg_run *r, size_t output, size_t entity)
{
    const pcg_entities *all = run_output(r, output);
    return entity < all->count ? all->at[entity] : NULL;
}

/* ---- as writers read it --------------------------------------------------------------------- */

bool result_ready(const pcg_run *r)
{
    return r->stage == RUN_EXECUTED;
}

const pcg_module *result_module(const pcg_run *r)
{
    return r->module;
}

uint64_t result_seed(const pcg_run *r)
{
    return r->seed;
}

uint64_t result_rounds(const pcg_run *r)
{
    return r->rounds;
}

uint64_t result_sent(const pcg_run *r)
{
    uint64_t sum = 0;
    for (const pcg_loaded *l = &r->own; l; l = l->next)
        for (pcg_u32 i = 0; l->sent && i < l->module->port_count; i++)
            sum += l->sent[i];
    return sum;
}

const pcg_entities *result_entities(const pcg_run *r, uint32_t output)
{
    return run_output(r, output);
}

const pcg_cell *result_attribute(const pcg_run *r, const pcg_entity *e, const pcg_attribute_info *a)
{
    const pcg_cell *at = pcg_attribute(e, (int)a->cell);
    return at ? at : run_at(r, a->initial);
}

static value_type type_of(const pcg_attribute_info *a)
{
    value_type t = {.kind = a->kind, .element = a->element, .enumerators = a->enumerators};
    return t;
}

void result_attribute_json(const pcg_run *r, const pcg_entity *e, const pcg_attribute_info *a,
                           text *out)
{
    const value_type t = type_of(a);
    value_write_json(out, &t, result_attribute(r, e, a));
}

size_t result_message_count(const pcg_run *r)
{
    return (size_t)r->program->messages.count + r->messages.list.count;
}

const pcg_message *result_message(const pcg_run *r, size_t i)
{
    size_t before = r->program->messages.count;
    if (i < before)
        return r->program->messages.at[i];
    return i - before < r->messages.list.count ? r->messages.list.at[i - before] : NULL;
}

pcg_status result_fail(pcg_run *r, pcg_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    message_error(r, format, arguments);
    va_end(arguments);
    return status;
}

void result_watch_paths(pcg_run *r, void (*found)(void *user, const char *path), void *user)
{
    r->found = found;
    r->found_user = user;
}

struct interrupt *result_guard(const pcg_run *r)
{
    return r->guard;
}

void result_warn(pcg_run *r, const char *format, ...)
{
    arena scratch = {.limit = 1 << 20};
    text line = {.arena = &scratch};
    va_list arguments;
    va_start(arguments, format);
    message_format(&line, format, arguments);
    va_end(arguments);
    if (line.at)
        message_tell(r, PCG_WARNING, DIAG_W0701, NULL, 0, line.at);
    arena_free(&scratch);
}

/* ---- as hosts read it ----------------------------------------------------------------------- */

size_t pcg_run_output_count(const pcg_run *r, size_t output)
{
    return run_output(r, output)->count;
}

static const pcg_mesh *mesh_of(const pcg_entity *e)
{
    return pcg_entity_is(e, &pcg_type_shape) ? ((const pcg_shape *)e)->mesh : &pcg_mesh_empty;
}

size_t pcg_run_face_count(const pcg_run *r)
{
    size_t faces = 0;
    for (size_t i = 0; i < r->module->output_count; i++)
        for (size_t k = 0; k < run_output(r, i)->count; k++)
            faces += mesh_of(run_output(r, i)->at[k])->face_count;
    return faces;
}

size_t pcg_run_vertex_count(const pcg_run *r)
{
    size_t vertices = 0;
    for (size_t i = 0; i < r->module->output_count; i++)
        for (size_t k = 0; k < run_output(r, i)->count; k++)
            vertices += mesh_of(run_output(r, i)->at[k])->vertex_count;
    return vertices;
}

static const pcg_attribute_info *find_attribute(const pcg_run *r, const char *name)
{
    for (pcg_u32 i = 0; i < r->module->attribute_count; i++)
        if (!strcmp(r->module->attributes[i].name, name))
            return &r->module->attributes[i];
    return NULL;
}

const char *pcg_run_attribute(pcg_run *r, size_t output, size_t entity, const char *name)
{
    const pcg_entity *e = find_entity(r, output, entity);
    const pcg_attribute_info *a = find_attribute(r, name);
    if (!e || !a)
        return NULL;
    arena scratch = {0};
    text line = {.arena = &scratch};
    const value_type t = type_of(a);
    value_write(&line, &t, result_attribute(r, e, a));
    const char *kept = pcg_string(r, line.at);
    arena_free(&scratch);
    return kept;
}

pcg_status pcg_run_attribute_float(pcg_run *r, size_t output, size_t entity, const char *name,
                                   double *out)
{
    const pcg_entity *e = find_entity(r, output, entity);
    const pcg_attribute_info *a = find_attribute(r, name);
    if (!a)
        return run_misuse(r, "graph '%s' has no attribute '%s'", r->module->name, name);
    if (!e)
        return run_misuse(r, "output %zu has no entity %zu", output, entity);
    const pcg_cell *at = result_attribute(r, e, a);
    if (value_is_float(a->kind))
        *out = at->f;
    else if (a->kind == PCG_INT || a->kind == PCG_BOOL || a->kind == PCG_ENUM)
        *out = (double)at->i;
    else
        return run_misuse(r, "attribute '%s' is of type %s, no number", name, a->type);
    return PCG_STATUS_OK;
}

pcg_status pcg_run_attribute_floats(pcg_run *r, size_t output, const char *name, size_t width,
                                    double *out)
{
    const pcg_entities *all = run_output(r, output);
    const pcg_attribute_info *a = find_attribute(r, name);
    if (!a)
        return run_misuse(r, "graph '%s' has no attribute '%s'", r->module->name, name);
    bool whole = a->kind == PCG_INT || a->kind == PCG_BOOL || a->kind == PCG_ENUM;
    if (!whole && !value_has_floats(a->kind))
        return run_misuse(r, "attribute '%s' is of type %s, no number", name, a->type);
    if (width != value_width(a->kind))
        return run_misuse(r, "attribute '%s' is of type %s, which has %u numbers, not %zu", name,
                          a->type, value_width(a->kind), width);
    for (pcg_u32 i = 0; i < all->count; i++) {
        const pcg_cell *at = result_attribute(r, all->at[i], a);
        for (size_t k = 0; k < width; k++)
            *out++ = whole ? (double)at[k].i : at[k].f;
    }
    return PCG_STATUS_OK;
}

const char *pcg_run_entity_node(const pcg_run *r, size_t output, size_t entity)
{
    const pcg_entity *e = find_entity(r, output, entity);
    return e ? e->maker ? e->maker->name : "" : NULL;
}

const char *pcg_run_entity_type(const pcg_run *r, size_t output, size_t entity)
{
    const pcg_entity *e = find_entity(r, output, entity);
    return e ? e->type->name : NULL;
}

size_t pcg_run_message_count(const pcg_run *r)
{
    return result_message_count(r);
}

const pcg_message *pcg_run_message(const pcg_run *r, size_t i)
{
    return result_message(r, i);
}

/* program.c - programs, and what they say of themselves. */
#include "cache_store.h"
#include "program.h"
#include "run.h"

#include <stdlib.h>
#include <string.h>

pcg_program *program_new(const pcg_module *module, void (*release)(void *owned), void *owned)
{
    if (!module || module->abi != PCG_ABI || module->size != sizeof *module)
        return NULL;
    pcg_program *p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    p->module = module;
    p->release = release;
    p->owned = owned;
    p->cache = cache_store_new();
    return p;
}

pcg_program *pcg_program_of(const struct pcg_module *module)
{
    return pcg_program_link(module, NULL);
}

void pcg_program_free(pcg_program *p)
{
    if (!p)
        return;
    if (p->release)
        p->release(p->owned);
    for (uint32_t i = 0; i < p->library_count; i++)
        library_close(p->libraries[i]);
    free(p->libraries);
    free(p->kernels);
    cache_store_free(p->cache);
    arena_free(&p->arena);
    free(p);
}

bool program_set_file(pcg_program *p, const char *path)
{
    char *real = realpath(path, NULL);
    char *slash = real ? strrchr(real, '/') : NULL;
    if (slash)
        p->folder = arena_copy(&p->arena, real, (size_t)(slash - real) + 1);
    free(real);
    return p->folder || !slash;
}

static const char *copy(arena *a, const char *s)
{
    return s ? arena_copy(a, s, strlen(s)) : NULL;
}

bool program_add_message(pcg_program *p, const pcg_message *m)
{
    jmp_buf out_of_memory;
    arena *a = &p->arena;
    a->on_failure = &out_of_memory;
    if (setjmp(out_of_memory)) {
        p->arena.on_failure = NULL;
        return false;
    }
    pcg_message *kept = message_copy(a, m);
    LIST_ADD(a, &p->messages, kept);
    a->on_failure = NULL;
    return true;
}

static const char *const *copy_all(arena *a, const char *const *texts)
{
    size_t count = 0;
    if (!texts)
        return NULL;
    while (texts[count])
        count++;
    const char **copies = ARENA_ARRAY(a, const char *, count + 1);
    for (size_t i = 0; i < count; i++)
        copies[i] = copy(a, texts[i]);
    return copies;
}

bool program_set_loader(pcg_program *p, const program_loader *l)
{
    jmp_buf out_of_memory;
    arena *a = &p->arena;
    a->on_failure = &out_of_memory;
    if (setjmp(out_of_memory)) {
        p->arena.on_failure = NULL;
        return false;
    }
    program_loader *kept = ARENA_NEW(a, program_loader);
    *kept = *l;
    kept->import_paths = copy_all(a, l->import_paths);
    kept->library_paths = copy_all(a, l->library_paths);
    p->loader = kept;
    a->on_failure = NULL;
    return true;
}

/* ---- description ---------------------------------------------------------------------------- */

static const char *or_empty(const char *s)
{
    return s ? s : "";
}

const char *pcg_program_name(const pcg_program *p)
{
    return or_empty(p->module->name);
}

const char *pcg_program_document(const pcg_program *p)
{
    return or_empty(p->module->document);
}

size_t pcg_program_parameter_count(const pcg_program *p)
{
    return p->module->parameter_count;
}

bool pcg_program_parameter(const pcg_program *p, size_t i, pcg_parameter *out)
{
    if (i >= p->module->parameter_count)
        return false;
    const pcg_parameter_info *about = &p->module->parameters[i];
    out->name = or_empty(about->name);
    out->document = or_empty(about->document);
    out->type = or_empty(about->type);
    out->initial = or_empty(about->initial);
    out->hidden = about->hidden != 0;
    return true;
}

static bool describe_gate(const pcg_port_info *ports, size_t count, size_t i, pcg_gate *out)
{
    if (i >= count)
        return false;
    out->name = or_empty(ports[i].name);
    out->document = or_empty(ports[i].document);
    out->type = or_empty(ports[i].type);
    out->collective = ports[i].collective != 0;
    return true;
}

bool pcg_program_parameter_range(const pcg_program *p, size_t i, double *low, double *high)
{
    if (i >= p->module->parameter_count)
        return false;
    const pcg_parameter_info *about = &p->module->parameters[i];
    for (pcg_u32 k = 0; k < about->constraint_count; k++)
        if (about->constraints[k].kind == 0) {
            *low = about->constraints[k].low;
            *high = about->constraints[k].high;
            return true;
        }
    return false;
}

const char *pcg_program_parameter_choices(const pcg_program *p, size_t i)
{
    if (i >= p->module->parameter_count)
        return NULL;
    const pcg_parameter_info *about = &p->module->parameters[i];
    for (pcg_u32 k = 0; k < about->constraint_count; k++)
        if (about->constraints[k].kind == 1)
            return about->constraints[k].text;
    return about->enumerators;
}

size_t pcg_program_input_count(const pcg_program *p)
{
    return p->module->input_count;
}

bool pcg_program_input(const pcg_program *p, size_t i, pcg_gate *out)
{
    return describe_gate(p->module->inputs, p->module->input_count, i, out);
}

size_t pcg_program_output_count(const pcg_program *p)
{
    return p->module->output_count;
}

bool pcg_program_output(const pcg_program *p, size_t i, pcg_gate *out)
{
    return describe_gate(p->module->outputs, p->module->output_count, i, out);
}

size_t pcg_program_attribute_count(const pcg_program *p)
{
    return p->module->attribute_count;
}

const char *pcg_program_attribute_name(const pcg_program *p, size_t i)
{
    return i < p->module->attribute_count ? p->module->attributes[i].name : NULL;
}

const char *pcg_program_attribute_type(const pcg_program *p, size_t i)
{
    return i < p->module->attribute_count ? p->module->attributes[i].type : NULL;
}

const char *pcg_version(void)
{
    return PCG_VERSION;
}

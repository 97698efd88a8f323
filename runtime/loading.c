/* loading.c - the graphs that surrogates name: those of their file's scope, which are part of the
 * module; files, compiled or not; procedures, for which a graph is written that holds just the one.
 *
 * What was loaded once is kept for the run: a file that changes meanwhile is as it was first
 * read. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crew.h"

typedef struct request {
    pcg_call *call;
    const pcg_surrogate_info *info;
    const char *name;
} request;

static int refuse(const request *q, const char *why)
{
    pcg_call *c = q->call;
    return run_fail(c->run, PCG_FAILED, DIAG_E0710, c->node, c->round, q->name, why);
}

/* ---- what was loaded ------------------------------------------------------------------------ */

pcg_loaded *loaded_before(pcg_run *r, const char *key)
{
    for (pcg_loaded *l = r->own.next; l; l = l->next)
        if (l->key && !strcmp(l->key, key))
            return l;
    return NULL;
}

pcg_loaded *loaded_add(pcg_run *r, const pcg_program *p, const char *key)
{
    pcg_loaded *last = &r->own, *l = run_alloc_zeroed(r, sizeof *l);
    if (!l || !loaded_open(r, l, p))
        return NULL;
    l->key = key;
    while (last->next)
        last = last->next;
    last->next = l;
    return l;
}

void loading_close(pcg_run *r)
{
    for (pcg_loaded *l = r->own.next; l; l = l->next)
        if (!l->borrowed)
            pcg_program_free((pcg_program *)(uintptr_t)l->program);
    r->own.next = NULL;
}

/* What a compilation says belongs to the round that wants the graph first, which is not known in a
 * thread: there the graph counts as broken, and the main run loads it. */
static void on_message(void *user, const pcg_message *m)
{
    pcg_run *r = user;
    if (r->is_worker)
        run_fail(r, PCG_FAILED, DIAG_E0701, NULL, 0, m->text);
    else
        message_forward(r, m);
}

/* Loads the graph by `make`, unless the run has it, or another of its crew. NULL: it cannot be had. */
static pcg_loaded *load_once(const request *q, const char *key, const char *what,
                             pcg_program *make(const request *q, const char *what))
{
    pcg_run *r = q->call->run;
    pcg_loaded *l = loaded_before(r, key);
    if (l)
        return l;
    const pcg_program *shared = crew_loading_begin(r, key);
    if (shared) {
        l = loaded_add(r, shared, key);
        if (l)
            l->borrowed = true;
    } else {
        pcg_program *made = make(q, what);
        l = r->is_worker && r->status != PCG_OK ? NULL : made ? loaded_add(r, made, key) : NULL;
        if (!l)
            pcg_program_free(made);
    }
    crew_loading_end(r, key, shared || !l ? NULL : l->program);
    return l;
}

static int found(pcg_choice *to, pcg_loaded *l)
{
    to->loaded = l;
    to->module = l->module;
    return PCG_OK;
}

/* ---- files ---------------------------------------------------------------------------------- */

static bool ends_in(const char *name, const char *extension)
{
    size_t length = strlen(name), end = strlen(extension);
    return length > end && !strcmp(name + length - end, extension);
}

static bool is_there(const char *path)
{
    return path && access(path, F_OK) == 0;
}

/* As it was written, seen from where the process is; for messages, too. NULL: nothing is there. */
static const char *beside_source(const request *q, const char *way)
{
    const char *folder = q->call->frame->loaded->module->folder;
    size_t length = folder ? strlen(folder) : 0;
    const char *slash = length && folder[length - 1] != '/' ? "/" : "";
    const char *path =
        pcg_format(q->call->run, "%s%s%s%s", length ? folder : "", slash, way, q->name);
    return is_there(path) ? path : NULL;
}

/* Beside the file that the surrogate stands in, beside the main one, beside the code. */
static const char *file_path(const request *q)
{
    const char *path = NULL;
    if (*q->name == '/')
        return is_there(q->name) ? q->name : NULL;
    if (*q->info->way)
        path = beside_source(q, q->info->way);
    if (!path)
        path = beside_source(q, "");
    if (!path)
        path = pcg_path(q->call, q->name);
    return is_there(path) ? path : NULL;
}

static pcg_program *compile_file(const request *q, const char *path)
{
    pcg_run *r = q->call->run;
    const program_loader *by = r->program->loader;
    const pcg_compile_options options = {.size = sizeof options,
                                         .message = on_message,
                                         .user = r,
                                         .import_paths = by ? by->import_paths : NULL,
                                         .library_paths = by ? by->library_paths : NULL,
                                         .observed = r->program->observed};
    if (ends_in(path, ".so"))
        return pcg_program_load(path, &options);
    return by ? by->compile_file(path, &options) : NULL;
}

static int load_file(const request *q, pcg_choice *to)
{
    pcg_run *r = q->call->run;
    struct stat about;
    const char *path = file_path(q);
    if (!path)
        return refuse(q, "there is no such file");
    if (stat(path, &about))
        return refuse(q, strerror(errno));
    if (!S_ISREG(about.st_mode))
        return refuse(q, "it is no file");
    char *whole = realpath(path, NULL);
    const char *key = whole ? pcg_string(r, whole) : pcg_string(r, path);
    free(whole);
    if (!ends_in(path, ".so") && !r->program->loader)
        return refuse(q, "it is source, and this program holds no compiler: compile it with pcgc -o "
                         "to a .so");
    pcg_loaded *l = load_once(q, key, path, compile_file);
    return l ? found(to, l) : refuse(q, "it does not compile, or cannot be loaded");
}

/* ---- procedures ----------------------------------------------------------------------------- */

static bool is_word(const char *name)
{
    for (const char *at = name; *at; at++)
        if (!(*at >= 'a' && *at <= 'z') && !(*at >= 'A' && *at <= 'Z') && *at != '_' &&
            !(*at >= '0' && *at <= '9'))
            return false;
    return *name && !(*name >= '0' && *name <= '9');
}

static pcg_program *compile_procedure(const request *q, const char *written)
{
    pcg_run *r = q->call->run;
    const program_loader *by = r->program->loader;
    const pcg_compile_options options = {.size = sizeof options,
                                         .message = on_message,
                                         .user = r,
                                         .library_paths = by->library_paths,
                                         .observed = r->program->observed};
    return by->compile_text(written, strlen(written), pcg_format(r, "procedure '%s'", q->name),
                            &options);
}

static int load_procedure(const request *q, pcg_choice *to)
{
    pcg_run *r = q->call->run;
    if (!*q->name)
        return refuse(q, "no name is given");
    if (!is_word(q->name))
        return refuse(q, "no graph of this file is called so, and no procedure can be");
    const char *written = pcg_format(r, "%s%s%s", q->info->before, q->name, q->info->behind);
    if (!r->program->loader)
        return refuse(q, "no graph of this file is called so; a procedure would need the compiler, "
                         "which this program does not hold");
    pcg_loaded *l = load_once(q, written, written, compile_procedure);
    return l ? found(to, l)
             : refuse(q, "no graph of this file is called so, and no procedure that fits what is "
                         "declared");
}

/* ---- all of them ---------------------------------------------------------------------------- */

int loading_find(pcg_call *c, const pcg_surrogate_info *info, const char *name, pcg_choice *to)
{
    const request q = {c, info, name};
    for (pcg_u32 i = 0; i < info->candidate_count; i++)
        if (!strcmp(info->candidates[i].name, name)) {
            to->loaded = c->frame->loaded;
            to->module = info->candidates[i].module;
            return PCG_OK;
        }
    bool is_file = strchr(name, '/') || strchr(name, '.');
    return is_file ? load_file(&q, to) : load_procedure(&q, to);
}

/* cache.c - the surrogate `cache`: what a graph gave for the same content is not made again.
 *
 * The key says what an execution depends on: the graph's text and all that it encapsulates, the
 * surrogate's interface, parameters, what entered with what was handed in, the runtime and the
 * libraries that run it. Chance is not in it: where an execution has drawn a random number, its
 * entry says only that, and what it gave is kept by a second key, with the seed and the lines of
 * descent in it. An entry lists the files that were asked for, as they were then; once one of them
 * is another one it is no answer any more.
 *
 * Lines of descent of what leaves are numbered anew, by the round of the surrogate, whether it was
 * kept or made: so they do not depend on it. Attributes of the graph around are those of the
 * entity that an entity descends from (parcel.h). */
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "cache_store.h"
#include "list.h"
#include "surrogate.h"
#include "value.h"

enum { MEMORY_BYTES = 256 << 20, DISK_BYTES = 1 << 30 };
enum { ENTRY_DRAWS, ENTRY_RESULT };
enum { WHERE_DISK = 1 };

/* One execution. */
typedef struct caching {
    pcg_call *call;
    pcg_surrogate *surrogate;
    pcg_choice *choice;
    pcg_packer entered;    /* packed: a part of the key; its entities are the origins */
    digest key, drawn_key;
    bool draws;            /* by what was kept: the second key is the one that counts */
} caching;

/* ---- what is not kept ----------------------------------------------------------------------- */

static const char *why_not_graph(const pcg_module *m)
{
    return m->loads ? "the names of graphs that it loads are computed" : m->tied;
}

static const char *why_not(const pcg_choice *k, const pcg_surrogate_info *info)
{
    const char *why = why_not_graph(k->module);
    for (pcg_u32 i = 0; i < info->input_count && !why; i++)
        for (pcg_u32 n = k->inputs[i]->head; n < k->inputs[i]->end && !why; n++)
            if (!parcel_is_alone(k->inputs[i]->at[n]))
                why = "what enters it is referred to from elsewhere, or holds others";
    return why;
}

static void warn_not_kept(pcg_call *c, pcg_choice *k, const char *why)
{
    if (!k->told)
        message_diagnose(c->run, DIAG_W0705, c->node, 0, k->module->name, why);
    k->told = true;
}

static void warn_disk(pcg_call *c, diagnostic_code code, const char *why)
{
    if (!c->run->disk_told)
        message_diagnose(c->run, code, c->node, 0, why);
    c->run->disk_told = true;
}

/* ---- keys ----------------------------------------------------------------------------------- */

static void add_number(digest *d, uint64_t number)
{
    digest_add(d, &number, sizeof number);
}

static void add_file(digest *d, const char *path)
{
    const file_stamp stamp = file_stamp_of(path);
    digest_add_text(d, path);
    digest_add(d, &stamp, sizeof stamp);
}

/* Where relative paths are looked up, and whose code it is that runs. */
static void add_places(digest *d, const pcg_loaded *l)
{
    Dl_info about;
    const char *folder = l->module->folder;
    char *real = realpath(folder && *folder ? folder : ".", NULL);
    digest_add_text(d, real);
    free(real);
    digest_add_text(d, l->program->folder);
    add_file(d, dladdr((void *)(uintptr_t)&pcg_type_entity, &about) ? about.dli_fname : NULL);
    for (uint32_t i = 0; i < l->program->library_count; i++)
        add_file(d, l->program->libraries[i]->path);
}

static void add_interface(digest *d, const pcg_surrogate *s)
{
    const pcg_surrogate_info *i = s->info;
    add_number(d, i->rest);
    add_number(d, i->output_count);
    for (pcg_u32 o = 0; o < i->output_count; o++)
        digest_add_text(d, i->outputs[o].name);
    add_number(d, i->attribute_count);
    for (pcg_u32 a = 0; a < i->attribute_count; a++) {
        digest_add_text(d, i->attributes[a].name);
        add_number(d, s->links[a] != NULL);
    }
}

static void pack_parameters(pcg_packer *p, const pcg_surrogate *s)
{
    for (pcg_u32 i = 0; i < s->info->parameter_count; i++) {
        const pcg_parameter_info *about = s->choice->parameters[i];
        pack_value(p, about->kind, about->element, choice_at(s->choice, about->offset));
    }
}

static void pack_handed(pcg_packer *p, const pcg_surrogate *s, const pcg_entity *e)
{
    for (pcg_u32 a = 0; a < s->info->attribute_count; a++) {
        const pcg_attribute_info *about = s->choice->attributes[a];
        const pcg_cell *value = pcg_attribute(e, s->choice->slots[a].cell);
        pack_u32(p, value != NULL);
        if (value)
            pack_value(p, about->kind, about->element, value);
    }
}

static const pcg_entity *impulse_of(const pcg_choice *k)
{
    return ((const pcg_graph *)k->frame)->impulse;
}

/* What entered, and what was handed in with it. Of an impulse nothing else is seen. Status. */
static int pack_entered(caching *k)
{
    const pcg_surrogate *s = k->surrogate;
    pcg_packer *p = &k->entered;
    pack_parameters(p, s);
    for (pcg_u32 i = 0; i < s->info->input_count; i++) {
        const pcg_queue *q = k->choice->inputs[i];
        pack_u32(p, q->end - q->head);
        for (pcg_u32 n = q->head; n < q->end; n++) {
            pack_entity(p, q->at[n]);
            pack_handed(p, s, q->at[n]);
        }
    }
    pack_u32(p, impulse_of(k->choice) != NULL);
    if (impulse_of(k->choice))
        pack_handed(p, s, impulse_of(k->choice));
    return pack_status(p);
}

static void make_keys(caching *k)
{
    const pcg_module *m = k->choice->module;
    digest *d = &k->key;
    add_number(d, PCG_ABI);
    digest_add_text(d, m->version);
    digest_add_text(d, m->digest);
    add_places(d, k->choice->loaded);
    add_interface(d, k->surrogate);
    add_number(d, k->call->run->strict);
    digest_add(d, k->entered.at, k->entered.length);
    k->drawn_key = *d;
    add_number(&k->drawn_key, k->choice->frame->key);
    add_number(&k->drawn_key, k->call->lineage);
    for (pcg_u32 i = 0; i < k->entered.entity_count; i++)
        add_number(&k->drawn_key, k->entered.entities[i]->lineage);
}

/* ---- entries -------------------------------------------------------------------------------- */

static size_t limit_of(const pcg_run *r, bool on_disk)
{
    return r->max_cache ? r->max_cache : on_disk ? DISK_BYTES : MEMORY_BYTES;
}

/* Of what was found on disk a copy stays in memory. */
static cache_answer get(caching *k, const digest *key, char **bytes, size_t *size)
{
    pcg_run *r = k->call->run;
    cache_answer answer = cache_memory_get(r->program->cache, key, bytes, size);
    if (answer == CACHE_FOUND || k->surrogate->where != WHERE_DISK)
        return answer;
    answer = cache_disk_get(key, bytes, size);
    if (answer == CACHE_FOUND)
        cache_memory_put(r->program->cache, key, *bytes, *size, limit_of(r, false));
    else if (answer == CACHE_DAMAGED)
        warn_disk(k->call, DIAG_W0706, "");
    return answer;
}

static void put(caching *k, const digest *key, const char *bytes, size_t size)
{
    pcg_run *r = k->call->run;
    cache_memory_put(r->program->cache, key, bytes, size, limit_of(r, false));
    if (k->surrogate->where != WHERE_DISK)
        return;
    int failed = cache_disk_put(r->program->cache, key, bytes, size, limit_of(r, true));
    if (failed)
        warn_disk(k->call, DIAG_W0707, strerror(failed));
}

/* The files that the execution, or an earlier one whose nodes may remember it, has asked for. */
static void pack_files(pcg_packer *p, const pcg_choice *k)
{
    pcg_u32 count = 0;
    for (const cached_path *f = k->paths; f; f = f->next)
        count++;
    pack_u32(p, count);
    for (const cached_path *f = k->paths; f; f = f->next) {
        pack_bytes(p, &f->stamp, sizeof f->stamp);
        pack_u32(p, (pcg_u32)strlen(f->path));
        pack_bytes(p, f->path, strlen(f->path));
    }
}

static bool files_are_as_then(pcg_unpacker *u)
{
    pcg_u32 count = unpack_count(u, sizeof(file_stamp));
    for (pcg_u32 i = 0; i < count && !u->failed; i++) {
        file_stamp then, now;
        unpack_bytes(u, &then, sizeof then);
        pcg_u32 length = unpack_count(u, 1);
        if (u->failed || length > INT32_MAX)
            return false;
        now = file_stamp_of(pcg_format(u->run, "%.*s", (int)length, u->at));
        u->at += length;
        if (memcmp(&then, &now, sizeof now) != 0)
            return false;
    }
    return !u->failed;
}

static void note_files(pcg_run *r, pcg_choice *k, const run_record *said)
{
    for (uint32_t i = 0; i < said->items.count; i++) {
        const record_item *item = &said->items.at[i];
        const cached_path *f = k->paths;
        while (f && (item->kind != RECORD_PATH || strcmp(f->path, item->text) != 0))
            f = f->next;
        cached_path *own = f || item->kind != RECORD_PATH ? NULL : run_alloc(r, sizeof *own);
        if (!own)
            continue;
        *own = (cached_path){k->paths, pcg_string(r, item->text), item->stamp};
        k->paths = own;
    }
}

/* ---- taking --------------------------------------------------------------------------------- */

static void drop_entered(caching *k)
{
    for (pcg_u32 i = 0; i < k->surrogate->info->input_count; i++) {
        pcg_queue *q = k->choice->inputs[i];
        while (PCG_READY(*q))
            pcg_entity_drop(k->call->run, PCG_TAKE(*q));
    }
}

/* The entered ones, and the impulse behind them: the order of origins. NULL: no memory. */
static pcg_entity **origins_of(caching *k, pcg_u32 *count)
{
    size_t room = (size_t)k->entered.entity_count + 1;
    pcg_entity **all = run_alloc_array(k->call->run, room, sizeof *all);
    *count = k->entered.entity_count;
    if (!all)
        return NULL;
    if (*count)
        memcpy(all, k->entered.entities, *count * sizeof *all);
    if (impulse_of(k->choice))
        all[(*count)++] = (pcg_entity *)(uintptr_t)impulse_of(k->choice);
    return all;
}

/* PCG_OK with *done: it was an answer. */
static int take(caching *k, char *bytes, size_t size, bool *done)
{
    pcg_run *r = k->call->run;
    pcg_u32 count;
    pcg_entity **origins = origins_of(k, &count);
    pcg_unpacker u = {.run = r,
                      .at = bytes,
                      .end = bytes + size,
                      .module = k->choice->module,
                      .origins = origins,
                      .origin_count = count,
                      .cell = -1};
    int status = r->status;
    pcg_u32 kind = unpack_u32(&u);
    k->draws |= kind == ENTRY_DRAWS && !u.failed;
    *done = false;
    if (origins && kind == ENTRY_RESULT && files_are_as_then(&u)) {
        status = outcome_take(&u, k->call, k->surrogate, true);
        *done = !u.failed;
    }
    unpacker_close(&u);
    run_free(r, origins, ((size_t)k->entered.entity_count + 1) * sizeof *origins);
    return status;
}

static int take_kept(caching *k, const digest *key, bool *done)
{
    char *bytes;
    size_t size;
    *done = false;
    if (get(k, key, &bytes, &size) != CACHE_FOUND)
        return PCG_OK;
    int status = take(k, bytes, size, done);
    free(bytes);
    return status;
}

/* ---- making --------------------------------------------------------------------------------- */

static void mark_origin(caching *k, pcg_entity *e, pcg_u32 number)
{
    pcg_cell *origin = pcg_attribute_write(k->call->run, e, k->choice->origin, PCG_INT);
    if (origin)
        origin->i = number;
}

static void mark_origins(caching *k)
{
    for (pcg_u32 i = 0; i < k->entered.entity_count; i++)
        mark_origin(k, k->entered.entities[i], i);
    if (impulse_of(k->choice))
        mark_origin(k, (pcg_entity *)(uintptr_t)impulse_of(k->choice), k->entered.entity_count);
}

/* What it was handed lies above the graph's own cells, and is not for whoever else has it. */
static void clear_impulse(caching *k)
{
    pcg_entity *impulse = (pcg_entity *)(uintptr_t)impulse_of(k->choice);
    if (impulse)
        attributes_leave(k->call->run, impulse, k->choice->below);
}

static int execute(caching *k)
{
    pcg_run *r = k->call->run;
    bool before = r->by_module;
    r->by_module |= !k->choice->module->tied;
    int status = surrogate_execute(k->surrogate);
    r->by_module = before;
    clear_impulse(k);
    return status == PCG_OK ? r->status : status;
}

/* By their order in a parcel; where there can be none, by that at the outputs. */
static void renumber(caching *k, const pcg_packer *p, bool packed)
{
    const pcg_choice *choice = k->choice;
    pcg_u32 number = 0;
    if (packed)
        outcome_renumber(k->call, p->entities, p->entity_count);
    for (pcg_u32 i = 0; i < choice->module->output_count && !packed; i++) {
        const pcg_queue *q = choice_output(choice, i);
        for (pcg_u32 n = q->head; n < q->end; n++)
            q->at[n]->lineage =
                pcg_mix(pcg_mix(k->call->lineage, k->call->key), (pcg_u64)++number);
    }
}

static int leave(caching *k, const pcg_packer *p, bool packed)
{
    if (p->cannot)
        warn_not_kept(k->call, k->choice, pcg_format(k->call->run, "it gives a %s", p->cannot));
    PCG_TRY(k->call->run->status);
    renumber(k, p, packed);
    return surrogate_leave(k->call, k->surrogate);
}

/* The lines of descent come out as they would have. */
static int make(caching *k)
{
    const run_record nothing = {0};
    pcg_packer p = {.run = k->call->run, .cell = k->choice->origin};
    int status = execute(k);
    if (status == PCG_OK) {
        bool packed = outcome_pack(&p, k->surrogate, k->choice, &nothing, NULL) == PCG_OK;
        status = leave(k, &p, packed);
    }
    packer_close(&p);
    return status;
}

static pcg_u64 *copy_counts(pcg_run *r, const pcg_u64 *from, pcg_u32 count)
{
    pcg_u64 *to = run_alloc_array(r, count, sizeof *to);
    if (to && count)
        memcpy(to, from, count * sizeof *to);
    return to;
}

static void keep(caching *k, const pcg_packer *p, bool drawn)
{
    pcg_packer draws = {.run = k->call->run, .cell = -1};
    if (drawn) {
        pack_u32(&draws, ENTRY_DRAWS);
        if (pack_status(&draws) == PCG_OK)
            put(k, &k->key, draws.at, draws.length);
        packer_close(&draws);
    }
    put(k, drawn ? &k->drawn_key : &k->key, p->at, p->length);
}

static int pack_and_leave(caching *k, const run_record *said, const outcome_before *before,
                          bool drawn)
{
    pcg_packer p = {.run = k->call->run, .cell = k->choice->origin};
    note_files(k->call->run, k->choice, said);
    pack_u32(&p, ENTRY_RESULT);
    pack_files(&p, k->choice);
    bool packed = outcome_pack(&p, k->surrogate, k->choice, said, before) == PCG_OK;
    if (packed)
        keep(k, &p, drawn);
    int status = leave(k, &p, packed);
    packer_close(&p);
    return status;
}

static int make_and_keep(caching *k)
{
    pcg_run *r = k->call->run;
    const pcg_loaded *l = k->choice->loaded;
    run_record said = {.outer = r->record};
    pcg_u64 *sent = copy_counts(r, l->sent, l->module->port_count);
    pcg_u64 *worked = copy_counts(r, l->worked, l->module->node_count);
    const outcome_before before = {sent, worked};
    bool drawn_before = r->drawn;
    int status = sent && worked ? PCG_OK : r->status;
    if (status == PCG_OK) {
        mark_origins(k);
        r->record = &said;
        r->drawn = false;
        status = execute(k);
        r->record = said.outer;
    }
    if (status == PCG_OK)
        status = pack_and_leave(k, &said, &before, r->drawn);
    r->drawn |= drawn_before;
    run_free(r, sent, l->module->port_count * sizeof *sent);
    run_free(r, worked, l->module->node_count * sizeof *worked);
    record_close(&said);
    return status;
}

/* ---- all of it ------------------------------------------------------------------------------ */

static int look_up(caching *k)
{
    bool done;
    make_keys(k);
    PCG_TRY(take_kept(k, &k->key, &done));
    if (!done && k->draws)
        PCG_TRY(take_kept(k, &k->drawn_key, &done));
    if (!done)
        return make_and_keep(k);
    k->call->run->drawn |= k->draws;
    clear_impulse(k);
    drop_entered(k);
    return PCG_OK;
}

/* Who watches a run sees all of its rounds. */
int cache_run(pcg_call *c, pcg_surrogate *s)
{
    pcg_run *r = c->run;
    caching k = {.call = c,
                 .surrogate = s,
                 .choice = s->choice,
                 .entered = {.run = r, .flags = PARCEL_KEY, .cell = -1}};
    const char *why = why_not(s->choice, s->info);
    if (why)
        warn_not_kept(c, s->choice, why);
    if (why || r->observed || r->no_cache || !r->program->cache)
        return make(&k);
    int status = pack_entered(&k);
    if (status == PCG_OK)
        status = look_up(&k);
    else if (k.entered.cannot)
        status = make(&k);
    packer_close(&k.entered);
    return status;
}

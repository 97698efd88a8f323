/* string.c - the run's memory as kernels see it: blocks, strings that are kept once, paths. */
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include "record.h"

enum { STRINGS_FIRST = 64, FORMAT_BYTES = 64 << 20 /* of one text */, CWD_BYTES = 4096 };

void *pcg_alloc(pcg_run *r, pcg_u64 size)
{
    if (size > SIZE_MAX) {
        run_out_of_memory(r, SIZE_MAX);
        return NULL;
    }
    return run_alloc_zeroed(r, (size_t)size);
}

/* ---- strings -------------------------------------------------------------------------------- */

static pcg_u64 hash_of(const char *s, size_t length)
{
    pcg_u64 hash = length;
    for (; length >= 8; s += 8, length -= 8) {
        pcg_u64 word;
        memcpy(&word, s, 8);
        hash = pcg_mix(hash, word);
    }
    pcg_u64 rest = 0;
    memcpy(&rest, s, length);
    return pcg_mix(hash, rest);
}

/* The slot that holds the string, or the empty one where it belongs. */
static struct run_string *slot_of(const run_strings *t, const char *s, size_t length, pcg_u64 hash)
{
    pcg_u32 mask = t->capacity - 1;
    for (pcg_u32 i = (pcg_u32)hash & mask;; i = (i + 1) & mask) {
        struct run_string *slot = &t->slots[i];
        if (!slot->at || (slot->hash == hash && !strncmp(slot->at, s, length) && !slot->at[length]))
            return slot;
    }
}

static bool strings_grow(pcg_run *r)
{
    run_strings *t = &r->strings;
    pcg_u32 capacity = t->capacity ? t->capacity * 2 : STRINGS_FIRST, mask = capacity - 1;
    struct run_string *slots = run_alloc_array(r, capacity, sizeof *slots);
    if (!slots)
        return false;
    for (pcg_u32 i = 0; i < t->capacity; i++) {
        pcg_u32 at = (pcg_u32)t->slots[i].hash & mask;
        if (!t->slots[i].at)
            continue;
        while (slots[at].at)
            at = (at + 1) & mask;
        slots[at] = t->slots[i];
    }
    run_free(r, t->slots, t->capacity * sizeof *slots);
    t->slots = slots;
    t->capacity = capacity;
    return true;
}

/* "" where memory has run out: a string is never NULL, and the next round stops. */
static const char *intern(pcg_run *r, const char *s, size_t length)
{
    run_strings *t = &r->strings;
    if (!length || (t->count >= t->capacity / 4 * 3 && !strings_grow(r)))
        return "";
    pcg_u64 hash = hash_of(s, length);
    struct run_string *slot = slot_of(t, s, length, hash);
    if (slot->at)
        return slot->at;
    char *kept = run_alloc(r, length + 1);
    if (!kept)
        return "";
    memcpy(kept, s, length);
    kept[length] = '\0';
    slot->at = kept;
    slot->hash = hash;
    t->count++;
    return kept;
}

const char *pcg_string(pcg_run *r, const char *s)
{
    return s ? intern(r, s, strlen(s)) : "";
}

/* False where memory has run out. */
static bool format_line(text *line, const char *format, va_list arguments)
{
    jmp_buf out_of_memory;
    line->arena->on_failure = &out_of_memory;
    if (setjmp(out_of_memory))
        return false;
    message_format(line, format, arguments);
    return true;
}

/* Short results, which nearly all are, are made on the stack. */
const char *pcg_format(pcg_run *r, const char *format, ...)
{
    char room[256] = "";
    arena scratch = {.limit = FORMAT_BYTES};
    text line = {.arena = &scratch, .at = room, .capacity = sizeof room};
    const char *kept = "";
    va_list arguments;
    va_start(arguments, format);
    if (format_line(&line, format, arguments))
        kept = intern(r, line.at, line.length);
    else
        run_out_of_memory(r, FORMAT_BYTES);
    va_end(arguments);
    arena_free(&scratch);
    return kept;
}

/* ---- paths ---------------------------------------------------------------------------------- */

static const char *join(pcg_run *r, const char *folder, const char *name)
{
    size_t length = strlen(folder);
    return pcg_format(r, "%s%s%s", folder, length && folder[length - 1] == '/' ? "" : "/", name);
}

/* Where a graph says "assets/brick.jpg": in the folder that was its file's when it was compiled. */
static const char *compiled_path(pcg_call *c, const char *path)
{
    char cwd[CWD_BYTES];
    pcg_run *r = c->run;
    const char *folder = c->frame->loaded->module->folder;
    if (folder && folder[0])
        path = join(r, folder, path);
    if (path[0] != '/' && getcwd(cwd, sizeof cwd))
        path = join(r, cwd, path);
    return pcg_string(r, path);
}

void path_note(pcg_run *r, const char *path)
{
    if (r->found)
        r->found(r->found_user, path);
    if (r->record)
        record_path(r->record, path);
}

static const char *note_path(pcg_run *r, const char *path)
{
    if (*path)
        path_note(r, path);
    return path;
}

const char *pcg_path(pcg_call *c, const char *path)
{
    pcg_run *r = c->run;
    while (path[0] == '.' && path[1] == '/')
        path += 2;
    if (path[0] == '/' || path[0] == '\0')
        return note_path(r, pcg_string(r, path));
    const char *first = compiled_path(c, path), *folder = c->frame->loaded->program->folder;
    if (access(first, F_OK) == 0)
        return note_path(r, first);
    const char *beside = folder ? join(r, folder, path) : first;
    if (access(beside, F_OK) == 0)
        return note_path(r, beside);
    return note_path(r, access(path, F_OK) == 0 ? pcg_string(r, path) : first);
}

/* record.c - what is said while a graph runs, written down. */
#include "record.h"

#include <string.h>
#include <sys/stat.h>

enum { RECORD_BYTES = 64 << 20 };

static const char *kept(arena *a, const char *s)
{
    return arena_copy(a, s, strlen(s));
}

static void add(run_record *k, const record_item *item)
{
    jmp_buf out_of_memory;
    k->arena.limit = RECORD_BYTES;
    k->arena.on_failure = &out_of_memory;
    if (setjmp(out_of_memory)) {
        k->lost = true;
    } else {
        record_item own = *item;
        own.text = kept(&k->arena, item->text);
        LIST_ADD(&k->arena, &k->items, own);
    }
    k->arena.on_failure = NULL;
}

static void add_to_all(run_record *k, const record_item *item)
{
    for (; k; k = k->outer)
        add(k, item);
}

void record_told(run_record *k, pcg_severity s, int code, const pcg_node *node, pcg_u64 round,
                 const char *line)
{
    const record_item item = {
        .kind = RECORD_TOLD, .severity = s, .code = code, .node = node, .count = round,
        .text = line};
    add_to_all(k, &item);
}

void record_warned(run_record *k, pcg_loaded *l, const pcg_node *node, pcg_u64 round, bool once,
                   const char *line)
{
    const record_item item = {.kind = once ? RECORD_ONCE : RECORD_WARNED,
                              .node = node,
                              .loaded = l,
                              .count = round,
                              .text = line};
    add_to_all(k, &item);
}

void record_left(run_record *k, const pcg_node *node, const char *input, pcg_u64 count)
{
    const record_item item = {.kind = RECORD_LEFT, .node = node, .count = count, .text = input};
    add_to_all(k, &item);
}

file_stamp file_stamp_of(const char *path)
{
    struct stat about;
    if (!path || stat(path, &about))
        return (file_stamp){0};
    return (file_stamp){1,
                        (uint64_t)about.st_size,
                        (uint64_t)about.st_mtim.tv_sec,
                        (uint64_t)about.st_mtim.tv_nsec,
                        (uint64_t)about.st_ctim.tv_sec,
                        (uint64_t)about.st_ctim.tv_nsec};
}

void record_path(run_record *k, const char *path)
{
    const record_item item = {.kind = RECORD_PATH, .text = path, .stamp = file_stamp_of(path)};
    add_to_all(k, &item);
}

void record_replay(pcg_run *r, const record_item *i, pcg_loaded *loaded)
{
    switch (i->kind) {
    case RECORD_TOLD:
        message_tell(r, i->severity, i->code, i->node, i->count, i->text);
        break;
    case RECORD_WARNED:
    case RECORD_ONCE:
        message_warn(r, loaded, i->node, i->count, i->kind == RECORD_ONCE, i->text);
        break;
    case RECORD_LEFT:
        report_left(r, i->node, pcg_string(r, i->text), i->count);
        break;
    case RECORD_PATH:
        path_note(r, i->text);
        break;
    }
}

void record_close(run_record *k)
{
    arena_free(&k->arena);
    *k = (run_record){.outer = k->outer};
}

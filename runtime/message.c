/* message.c - what a run says: recording, rendering with the source line, telling the host. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "record.h"

enum { SOURCE_BYTES = 4 << 20, SCRATCH_BYTES = 16 << 20 };

static const struct catalogue_row {
    const char *format;
    severity severity;
} catalogue[] = {
#define DIAGNOSTIC(code, severity, format) {format, SEVERITY_##severity},
#include "base/diagnostics.def"
#undef DIAGNOSTIC
};

/* A message before it has memory of its own. */
typedef struct draft {
    pcg_severity severity;
    int code;
    const pcg_node *node;
    pcg_u64 round;
    const char *line;
    bool recorded; /* as what it is, rather than as what is told */
} draft;

static const char *code_name(int code)
{
    return code == MESSAGE_PLAIN ? "" : diagnostic_name((diagnostic_code)code);
}

static severity base_severity(pcg_severity s)
{
    return s == PCG_ERROR ? SEVERITY_ERROR : s == PCG_WARNING ? SEVERITY_WARNING : SEVERITY_NOTE;
}

/* ---- the source line ------------------------------------------------------------------------ */

/* A file that cannot be read, kept in its place so that it is tried once. */
static const source unreadable;

static const source *read_source(pcg_run *r, const char *path)
{
    struct stat about;
    const source *s = table_get(&r->messages.sources, path);
    if (s)
        return s;
    /* A pipe or a device would be waited for. */
    if (stat(path, &about) == 0 && S_ISREG(about.st_mode))
        s = source_read(&r->messages.arena, path, SOURCE_BYTES);
    if (!s)
        s = &unreadable;
    table_put(&r->messages.arena, &r->messages.sources, path, (void *)(uintptr_t)s);
    return s;
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           ((unsigned char)c & 0x80);
}

/* Where the name that begins at `from` ends: a word, a quoted name, or one character. */
static uint32_t name_end(const source *s, uint32_t from, uint32_t line_end)
{
    uint32_t to = from;
    if (s->text[from] == '\'') {
        for (to++; to < line_end && s->text[to] != '\''; to++) {
        }
        return to < line_end ? to + 1 : to;
    }
    while (to < line_end && is_word(s->text[to]))
        to++;
    return to > from ? to : from + 1;
}

/* The node's place in its file; without a source where the file cannot be read, or is another one
 * than it was. */
static span place_of(pcg_run *r, const pcg_node *node)
{
    span none = {0};
    const source *s = read_source(r, node->file);
    if (node->line == 0 || node->line > s->line_count)
        return none;
    uint32_t at = s->lines[node->line - 1];
    uint32_t end = node->line < s->line_count ? s->lines[node->line] - 1 : (uint32_t)s->size;
    for (uint32_t column = 1; column < node->column && at < end; column++)
        for (at++; at < end && ((unsigned char)s->text[at] & 0xC0) == 0x80; at++) {
        }
    if (at >= end)
        return none;
    return (span){s, at, name_end(s, at, end)};
}

/* ---- rendering ------------------------------------------------------------------------------ */

static void write_header(text *out, const draft *d, const char *line)
{
    static const char *const names[] = {
        [PCG_NOTE] = "note", [PCG_WARNING] = "warning", [PCG_ERROR] = "error"};
    if (d->node && d->node->file)
        text_format(out, "%s:%u:%u: ", d->node->file, d->node->line, d->node->column);
    text_format(out, "%s: %s", names[d->severity], line);
    if (d->code != MESSAGE_PLAIN)
        text_format(out, " [%s]", code_name(d->code));
    text_add(out, "\n");
}

static const char *render(pcg_run *r, arena *a, const draft *d, const char *line)
{
    text out = {.arena = a};
    span place = {0};
    if (d->node && d->round && d->code != MESSAGE_PLAIN)
        line = arena_format(a, "%s (node '%s', round %llu)", line, d->node->name, d->round);
    if (d->node && d->node->file && d->code != MESSAGE_PLAIN)
        place = place_of(r, d->node);
    if (place.source) {
        diagnostic shown = {.code = (diagnostic_code)d->code,
                            .severity = base_severity(d->severity),
                            .message = line,
                            .span = place};
        diagnostic_write(&shown, false, &out);
    } else {
        write_header(&out, d, line);
    }
    return out.at;
}

/* One line that a terminal can be given. */
static char *clean_line(arena *a, const char *line)
{
    char *clean = arena_copy(a, line, strlen(line));
    for (char *s = clean; *s; s++)
        if ((unsigned char)*s < 0x20 || *s == 0x7F)
            *s = ' ';
    return clean;
}

static pcg_message *build(pcg_run *r, arena *a, const draft *d)
{
    pcg_message *m = ARENA_NEW(a, pcg_message);
    m->severity = d->severity;
    m->code = code_name(d->code);
    m->text = clean_line(a, d->line);
    if (d->node) {
        m->file = d->node->file;
        m->line = d->node->line;
        m->column = d->node->column;
        m->node = d->node->name;
        m->round = d->round;
    }
    m->rendered = render(r, a, d, m->text);
    if (a == &r->messages.arena)
        LIST_ADD(a, &r->messages.list, m);
    return m;
}

/* NULL where memory has run out. */
static pcg_message *build_guarded(pcg_run *r, arena *a, const draft *d)
{
    jmp_buf out_of_memory;
    pcg_message *m = NULL;
    a->on_failure = r->messages.arena.on_failure = &out_of_memory;
    if (!setjmp(out_of_memory))
        m = build(r, a, d);
    else
        m = NULL;
    a->on_failure = r->messages.arena.on_failure = NULL;
    return m;
}

/* ---- telling -------------------------------------------------------------------------------- */

static void tell(pcg_run *r, const draft *d)
{
    run_messages *all = &r->messages;
    if (d->severity == PCG_ERROR)
        flow_tell(r);
    else if (r->flow.running && flow_hold(r, d->severity, d->code, d->node, d->round, d->line))
        return;
    if (r->record && !d->recorded)
        record_told(r->record, d->severity, d->code, d->node, d->round, d->line);
    if (r->is_worker)
        return;
    bool keep = d->severity != PCG_NOTE || all->notes++ < RUN_NOTES_KEPT;
    arena scratch = {.limit = SCRATCH_BYTES};
    all->arena.limit = RUN_MESSAGE_BYTES;
    pcg_message *m = build_guarded(r, keep ? &all->arena : &scratch, d);
    pcg_message bare = {
        .severity = d->severity, .code = code_name(d->code), .text = d->line, .rendered = d->line};
    if (!m)
        all->lost++;
    if (r->message)
        r->message(r->user, m ? m : &bare);
    arena_free(&scratch);
}

void message_tell(pcg_run *r, pcg_severity s, int code, const pcg_node *node, pcg_u64 round,
                  const char *line)
{
    const draft d = {.severity = s, .code = code, .node = node, .round = round, .line = line};
    tell(r, &d);
}

static const char *kept_text(arena *a, const char *s)
{
    return s ? arena_copy(a, s, strlen(s)) : NULL;
}

pcg_message *message_copy(arena *a, const pcg_message *m)
{
    pcg_message *kept = ARENA_NEW(a, pcg_message);
    *kept = *m;
    kept->code = kept_text(a, m->code);
    kept->text = kept_text(a, m->text);
    kept->file = kept_text(a, m->file);
    kept->node = kept_text(a, m->node);
    kept->rendered = kept_text(a, m->rendered);
    return kept;
}

static void keep_message(run_messages *all, const pcg_message *m)
{
    arena *a = &all->arena;
    jmp_buf out_of_memory;
    a->limit = RUN_MESSAGE_BYTES;
    a->on_failure = &out_of_memory;
    if (!setjmp(out_of_memory)) {
        pcg_message *kept = message_copy(a, m);
        LIST_ADD(a, &all->list, kept);
    } else {
        all->lost++;
    }
    a->on_failure = NULL;
}

void message_forward(pcg_run *r, const pcg_message *m)
{
    keep_message(&r->messages, m);
    if (r->message)
        r->message(r->user, m);
}

/* Tells what `format` and its arguments say. */
static void tell_list(pcg_run *r, draft *d, const char *format, va_list arguments)
{
    arena scratch = {.limit = SCRATCH_BYTES};
    text line = {.arena = &scratch};
    message_format(&line, format, arguments);
    d->line = line.at ? line.at : format;
    tell(r, d);
    arena_free(&scratch);
}

void message_diagnose(pcg_run *r, diagnostic_code code, const pcg_node *node, pcg_u64 round, ...)
{
    va_list arguments;
    draft d = {.severity = catalogue[code].severity == SEVERITY_ERROR ? PCG_ERROR : PCG_WARNING,
               .code = (int)code,
               .node = node,
               .round = round};
    va_start(arguments, round);
    tell_list(r, &d, catalogue[code].format, arguments);
    va_end(arguments);
}

void messages_close(pcg_run *r)
{
    arena_free(&r->messages.arena);
    for (pcg_loaded *l = &r->own; l; l = l->next) {
        free(l->warnings);
        l->warnings = NULL;
    }
}

/* ---- failing -------------------------------------------------------------------------------- */

/* A long one is cut behind a whole character. */
void message_error(pcg_run *r, const char *format, va_list arguments)
{
    char *error = r->messages.error;
    arena scratch = {.limit = SCRATCH_BYTES};
    text whole = {.arena = &scratch};
    message_format(&whole, format, arguments);
    const char *from = whole.at ? whole.at : format;
    size_t length = strlen(from), most = sizeof r->messages.error - 1;
    if (length > most)
        for (length = most; length && ((unsigned char)from[length] & 0xC0) == 0x80; length--) {
        }
    memcpy(error, from, length);
    error[length] = '\0';
    arena_free(&scratch);
}

/* Where it happened, behind what it says. */
static void add_place(pcg_run *r, const pcg_node *node, pcg_u64 round)
{
    char *error = r->messages.error;
    size_t length = strlen(error), size = sizeof r->messages.error;
    if (node && round)
        snprintf(error + length, size - length, " (node '%s', round %llu)", node->name, round);
}

static int fail_list(pcg_run *r, int status, diagnostic_code code, const pcg_node *node,
                     pcg_u64 round, const char *format, va_list arguments)
{
    if (r->status != PCG_OK)
        return r->status;
    r->status = status;
    atomic_fetch_or_explicit(&r->attention, ATTENTION_FAILED, memory_order_relaxed);
    message_error(r, format, arguments);
    message_tell(r, PCG_ERROR, (int)code, node, round, r->messages.error);
    add_place(r, node, round);
    return status;
}

int run_fail(pcg_run *r, int status, diagnostic_code code, const pcg_node *node, pcg_u64 round, ...)
{
    va_list arguments;
    va_start(arguments, round);
    int result = fail_list(r, status, code, node, round, catalogue[code].format, arguments);
    va_end(arguments);
    return result;
}

pcg_status run_misuse(pcg_run *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    message_error(r, format, arguments);
    va_end(arguments);
    return PCG_STATUS_MISUSE;
}

/* ---- what kernels say ----------------------------------------------------------------------- */

bool message_admit(pcg_loaded *l, pcg_u32 index)
{
    if (!l->warnings)
        l->warnings = calloc(l->module->node_count, sizeof *l->warnings);
    if (!l->warnings || l->warnings[index] == UINT32_MAX)
        return !l->warnings;
    return l->warnings[index]++ < RUN_WARNINGS_OF_NODE;
}

/* True where that node has not said so before. */
static bool is_new(pcg_run *r, const pcg_node *node, const char *line)
{
    const char *key = pcg_format(r, "%s\n%s\n%s", node->graph, node->name, line);
    pcg_u32 before = r->once.count;
    return keys_number(r, &r->once, key) == before;
}

void message_warn(pcg_run *r, pcg_loaded *l, const pcg_node *node, pcg_u64 round, bool once,
                  const char *line)
{
    const draft d = {.severity = PCG_WARNING, .code = DIAG_W0701, .node = node, .round = round,
                     .line = line, .recorded = true};
    if (r->record)
        record_warned(r->record, l, node, round, once, line);
    if (!r->is_worker && (!once || is_new(r, node, line)) && message_admit(l, node->index))
        tell(r, &d);
}

/* The words are formed only where somebody is going to read them. */
static bool is_heard(const pcg_call *c)
{
    const pcg_loaded *l = c->frame->loaded;
    return c->run->record || !l->warnings || l->warnings[c->node->index] < RUN_WARNINGS_OF_NODE;
}

static int warn_list(pcg_call *c, bool once, const char *format, va_list arguments)
{
    pcg_run *r = c->run;
    if (r->strict)
        return fail_list(r, PCG_FAILED, DIAG_E0701, c->node, c->round, format, arguments);
    arena scratch = {.limit = SCRATCH_BYTES};
    text line = {.arena = &scratch};
    bool flowing = r->flow.running;
    if (flowing ? once || flow_admit(c) : once || is_heard(c))
        message_format(&line, format, arguments);
    const char *words = line.at ? line.at : format;
    if (!flowing)
        message_warn(r, c->frame->loaded, c->node, c->round, once, words);
    else if (line.at)
        flow_hold_warning(c, once, words);
    arena_free(&scratch);
    return PCG_OK;
}

int pcg_warn(pcg_call *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int status = warn_list(c, false, format, arguments);
    va_end(arguments);
    return status;
}

int pcg_warn_once(pcg_call *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int status = warn_list(c, true, format, arguments);
    va_end(arguments);
    return status;
}

int pcg_fail(pcg_call *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int status = fail_list(c->run, PCG_FAILED, DIAG_E0701, c->node, c->round, format, arguments);
    va_end(arguments);
    return status;
}

void pcg_note(pcg_call *c, const char *format, ...)
{
    va_list arguments;
    draft d = {.severity = PCG_NOTE, .code = MESSAGE_PLAIN, .node = c->node, .round = c->round};
    va_start(arguments, format);
    tell_list(c->run, &d, format, arguments);
    va_end(arguments);
}

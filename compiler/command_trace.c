/* command_trace.c - pcgc trace: every round of a run, as lines of JSON or for a viewer of traces.
 *
 * A line is written when its round is done, so that it holds what the round sent; those of an
 * encapsulated graph's nodes stand before the one of the node that runs it, and name it. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../runtime/observe.h"
#include "backend.h"
#include "command_run.h"

/* A round that is not done. */
typedef struct open_round {
    uint64_t id;       /* rounds are numbered from 1, as they begin */
    text begun, sent;  /* its line up to the outputs, and these */
} open_round;

typedef struct trace {
    const char *path, *format;
    bool viewer;       /* written for a viewer, with times */
    FILE *out;
    partial_file part;
    arena memory;
    jmp_buf out_of_memory;
    text line;         /* used again and again */
    open_round *open;  /* from the outermost on; `deepest` have texts */
    uint32_t depth, deepest;
    uint64_t rounds;
    struct timespec started;
    bool first;
    int error;         /* an errno: the trace is not complete */
} trace;

/* ---- what both forms hold -------------------------------------------------------------------- */

static void add_member(text *out, const char *name, const char *is)
{
    text_format(out, "\"%s\":", name);
    text_quote(out, is);
}

static void add_inputs(text *out, pcg_run *r, const pcg_event *e)
{
    pcg_event_input input;
    text_add(out, "\"inputs\":{");
    for (size_t i = 0; i < e->input_count && pcg_run_event_input(r, i, &input); i++) {
        text_add(out, i ? "," : "");
        text_quote(out, input.name);
        text_add(out, ":[");
        for (size_t k = 0; k < input.count; k++)
            text_format(out, "%s%llu", k ? "," : "",
                        (unsigned long long)pcg_run_event_entity(r, i, k));
        text_add(out, "]");
    }
    text_add(out, "},\"parameters\":{");
    for (size_t i = 0; i < e->parameter_count; i++) {
        text_add(out, i ? "," : "");
        observe_parameter_json(r, i, out);
    }
    text_add(out, "}");
}

static void add_sent(text *out, const pcg_event *e)
{
    text_add(out, out->length ? ",{" : "{");
    add_member(out, "port", e->port);
    text_format(out, ",\"entity\":%llu", (unsigned long long)e->entity);
    if (e->original)
        text_format(out, ",\"copy_of\":%llu", (unsigned long long)e->original);
    text_add(out, e->dropped ? ",\"dropped\":true}" : "}");
}

static const char *text_of(const text *t)
{
    return t->length ? t->at : "";
}

/* ---- the file -------------------------------------------------------------------------------- */

static void put(trace *t, const char *s)
{
    if (fputs(s, t->out) < 0)
        t->error = errno;
}

/* Between two events for the viewer. */
static void separate(trace *t)
{
    put(t, t->first ? "\n" : ",\n");
    t->first = false;
}

static double microseconds(const trace *t)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - t->started.tv_sec) * 1e6 +
           (double)(now.tv_nsec - t->started.tv_nsec) * 1e-3;
}

static void put_end(trace *t, const open_round *o, bool done)
{
    t->line.length = 0;
    if (t->viewer) {
        separate(t);
        text_add(&t->line, "{\"ph\":\"E\",\"pid\":1,\"tid\":1,\"ts\":");
        text_number(&t->line, microseconds(t));
        text_format(&t->line, ",\"args\":{\"outputs\":[%s]}}", text_of(&o->sent));
    } else {
        text_format(&t->line, "%s,\"outputs\":[%s]%s}\n", text_of(&o->begun), text_of(&o->sent),
                    done ? "" : ",\"done\":false");
    }
    put(t, t->line.at);
}

/* ---- events ---------------------------------------------------------------------------------- */

static open_round *open_one(trace *t)
{
    if (t->depth == t->deepest) {
        uint32_t wanted = t->deepest ? 2 * t->deepest : 16;
        t->open = arena_resize(&t->memory, t->open, t->deepest * sizeof *t->open,
                               wanted * sizeof *t->open);
        for (uint32_t i = t->deepest; i < wanted; i++)
            t->open[i] = (open_round){.begun.arena = &t->memory, .sent.arena = &t->memory};
        t->deepest = wanted;
    }
    open_round *o = &t->open[t->depth++];
    o->id = ++t->rounds;
    o->begun.length = o->sent.length = 0;
    return o;
}

static void begin_viewer(trace *t, pcg_run *r, const pcg_event *e)
{
    t->line.length = 0;
    separate(t);
    text_add(&t->line, "{");
    add_member(&t->line, "name", e->node);
    text_add(&t->line, ",");
    add_member(&t->line, "cat", e->graph);
    text_add(&t->line, ",\"ph\":\"B\",\"pid\":1,\"tid\":1,\"ts\":");
    text_number(&t->line, microseconds(t));
    text_format(&t->line, ",\"args\":{\"number\":%llu,", (unsigned long long)e->round);
    add_inputs(&t->line, r, e);
    text_add(&t->line, "}}");
    put(t, t->line.at);
}

static void begin_line(trace *t, text *out, pcg_run *r, const pcg_event *e)
{
    text_format(out, "{\"round\":%llu,", (unsigned long long)t->rounds);
    add_member(out, "node", e->node);
    text_format(out, ",\"number\":%llu,", (unsigned long long)e->round);
    add_member(out, "procedure", e->procedure);
    text_add(out, ",");
    add_member(out, "graph", e->graph);
    text_format(out, ",\"line\":%u,\"inside\":", e->line);
    if (t->depth > 1)
        text_format(out, "%llu,", (unsigned long long)t->open[t->depth - 2].id);
    else
        text_add(out, "null,");
    add_inputs(out, r, e);
}

static void take_event(trace *t, pcg_run *r, const pcg_event *e)
{
    if (e->kind == PCG_EVENT_ROUND) {
        open_round *o = open_one(t);
        if (t->viewer)
            begin_viewer(t, r, e);
        else
            begin_line(t, &o->begun, r, e);
    } else if (t->depth && e->kind == PCG_EVENT_SENT) {
        add_sent(&t->open[t->depth - 1].sent, e);
    } else if (t->depth) {
        put_end(t, &t->open[--t->depth], true);
    }
}

/* The run goes no further where the trace cannot follow it. */
static void on_event(void *user, pcg_run *r, const pcg_event *e)
{
    trace *t = user;
    if (t->error)
        return;
    if (setjmp(t->out_of_memory))
        t->error = ENOMEM;
    else
        take_event(t, r, e);
    if (t->error)
        pcg_run_cancel(r);
}

/* ---- the command ----------------------------------------------------------------------------- */

static const char *written_to(const trace *t)
{
    return t->path ? t->path : "-";
}

static int begin(void *user, running *k)
{
    trace *t = user;
    t->memory.on_failure = &t->out_of_memory;
    t->line.arena = &t->memory;
    clock_gettime(CLOCK_MONOTONIC, &t->started);
    t->first = true;
    if (!strcmp(written_to(t), "-")) {
        t->out = stdout;
    } else {
        partial_begin(&t->part, &k->t.compilation.arena, t->path, "", &k->t.guard);
        interrupt_lock(&k->t.guard);
        t->out = fopen(t->part.name, "wb");
        t->error = t->out ? 0 : errno;
        interrupt_unlock(&k->t.guard);
    }
    if (t->out && t->viewer)
        put(t, "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[");
    return t->out ? EXIT_DONE : EXIT_USAGE;
}

/* What was under way when the run stopped is told, too. */
static void put_unfinished(trace *t)
{
    if (setjmp(t->out_of_memory)) {
        t->error = ENOMEM;
        return;
    }
    while (t->depth)
        put_end(t, &t->open[--t->depth], false);
    if (t->viewer)
        put(t, "\n]}\n");
}

static int end(void *user, running *k, int code)
{
    trace *t = user;
    bool ran = k->outcome.executed && code != EXIT_INTERRUPTED;
    if (t->out && !t->error && ran)
        put_unfinished(t);
    if (t->out && (t->out == stdout ? fflush(t->out) : fclose(t->out)) && !t->error)
        t->error = errno;
    if (t->part.name) {
        complaint why = {0};
        if (!partial_end(&t->part, ran && !t->error, t->path, &why) && ran && !t->error)
            t->error = errno;
        free(why.text);
    }
    arena_free(&t->memory);
    if (t->error)
        code = tool_error(t->error == ENOMEM ? EXIT_LIMIT : EXIT_USAGE, "cannot write '%s': %s",
                          written_to(t), strerror(t->error));
    return code;
}

/* -1 to go on, or an exit code. */
static int choose_format(const command *self, trace *t)
{
    const char *format = t->format;
    if (!format)
        format = t->path && !strcmp(path_extension(t->path), "json") ? "perfetto" : "ndjson";
    t->viewer = !strcmp(format, "perfetto");
    return t->viewer || !strcmp(format, "ndjson")
               ? -1
               : usage_error(self, "option '--format' takes ndjson or perfetto, not '%s'", format);
}

static int run_trace(const command *self, int argc, char **argv)
{
    arena a = {0};
    running k = {0};
    trace t = {0};
    const seeing s = {self, on_event, &t, begin, NULL, NULL, end};
    option_texts files = {0};
    const option options[] = {
        {'o', "output", OPTION_TEXT, &t.path, "FILE",
         "where to; .json is for a viewer (ui.perfetto.dev), all else a line of JSON a round"},
        {'f', "format", OPTION_TEXT, &t.format, "ndjson|perfetto",
         "what to write, whatever FILE is called"},
        SEEING_OPTIONS(&k),
        {0}};
    int code = options_read(&a, self, options, argc, argv, &files);
    if (code < 0)
        code = choose_format(self, &t);
    if (code < 0)
        code = run_seen(&k, &s, &files);
    arena_free(&a);
    return code;
}

static const char *const examples[] = {"pcgc trace house.pcg -o rounds.ndjson",
                                       "pcgc trace house.pcg -p height=12m -o rounds.json", NULL};
const command command_trace = {"trace", "FILE",
                               "Runs a graph and writes every round: what a node took, the values "
                               "of its parameters, what it sent.",
                               examples, run_trace};

/* command_debug.c - pcgc debug: a graph run under a debugger.
 *
 * The observer of the run records each event, and asks for commands within it where the run is to
 * stop: the run waits there, unchanged, and goes on when the observer returns. */
#include <string.h>

#include "debug.h"

/* ---- the run --------------------------------------------------------------------------------- */

/* The debugger cannot follow: the run ends here. */
static void give_up(debugger *d, pcg_run *r)
{
    d->quit = true;
    d->failed = tool_error(EXIT_LIMIT, "out of memory for the record of the run");
    pcg_run_cancel(r);
}

/* Time that passes at a stop is not the run's. */
static void converse(debugger *d, pcg_run *r)
{
    pcg_int before = run_clock();
    debug_converse(d);
    r->started += run_clock() - before;
}

static void on_event(void *user, pcg_run *r, const pcg_event *e)
{
    debugger *d = user;
    if (d->quit)
        return;
    if (setjmp(d->out_of_memory))
        d->past.failed = true;
    else if (history_take(&d->past, r, e) && debug_stops(d))
        converse(d, r);
    if (d->past.failed)
        give_up(d, r);
}

/* With the lock of the guard held. A second time, before the run has stopped, it is ended. */
static bool on_interrupt(void *user)
{
    debugger *d = user;
    return !atomic_load(&d->idle) && !atomic_exchange(&d->pause, true);
}

static void started(void *user, pcg_run *r)
{
    debugger *d = user;
    interrupt *guard = &d->k->t.guard;
    d->run = r;
    if (!history_open(&d->past, r->program, d->history_limit))
        give_up(d, r);
    interrupt_lock(guard);
    guard->pause = on_interrupt;
    guard->pauser = d;
    interrupt_unlock(guard);
}

/* What went wrong was told by the run's own message. */
static void look_back(debugger *d, pcg_status status)
{
    d->over = true;
    d->status = status;
    atomic_store(&d->idle, true);
    while (history_forward(&d->past))
        continue;
    if (!history_finish(&d->past))
        return;
    debug_show_place(d, NULL);
    debug_converse(d);
}

static void done(void *user, pcg_run *r, pcg_status status)
{
    debugger *d = user;
    if (setjmp(d->out_of_memory))
        give_up(d, r);
    else if (!d->quit)
        look_back(d, status);
    interrupt_lock(&d->k->t.guard);
    d->k->t.guard.pause = NULL;
    interrupt_unlock(&d->k->t.guard);
    if (d->past.store)
        debug_answer(d);
    debug_forget_breakpoints(d);
    pcg_run_free(d->judge);
    history_close(&d->past);
    d->run = r;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int begin(void *user, running *k)
{
    debugger *d = user;
    d->k = k;
    d->memory.on_failure = d->scratch.on_failure = &d->out_of_memory;
    d->out.arena = &d->scratch;
    return debug_open_input(&d->input) ? EXIT_DONE : EXIT_USAGE;
}

static int end(void *user, running *k, int code)
{
    debugger *d = user;
    bool ended = d->quit && !d->over && !interrupt_asked(&k->t.guard);
    debug_close_input(&d->input);
    arena_free(&d->scratch);
    arena_free(&d->memory);
    return d->failed ? d->failed : ended ? EXIT_DONE : code;
}

/* -1 to go on, or an exit code. */
static int check_input(const command *self, const debugger *d, const option_texts *files)
{
    bool piped = files->count && !strcmp(files->at[0], "-");
    bool commands = d->input.path ? !strcmp(d->input.path, "-") : !d->input.lines.count;
    return piped && commands
               ? usage_error(self, "the graph and the commands cannot both come from the "
                                   "standard input")
               : -1;
}

enum { HISTORY_MIB = 64 };

static int run_debug(const command *self, int argc, char **argv)
{
    arena a = {0};
    running k = {0};
    debugger *d = ARENA_NEW(&a, debugger);
    if (!d)
        return tool_error(EXIT_LIMIT, "out of memory");
    d->history_limit = (size_t)HISTORY_MIB << 20;
    const seeing s = {self, on_event, d, begin, started, done, end};
    option_texts files = {0};
    bool gdb = false;
    const option options[] = {
        {'x', "execute", OPTION_TEXTS, &d->input.lines, "COMMANDS",
         "commands to begin with, separated by ';'"},
        {'b', "batch", OPTION_TEXT, &d->input.path, "FILE", "read commands from a file"},
        {0, "history", OPTION_BYTES, &d->history_limit, "BYTES",
         "how much of the run is remembered to go back in; 64M when not given"},
        {0, "gdb", OPTION_FLAG, &gdb, NULL, "run it under gdb, which stops on lines of the graph"},
        {'o', "output", OPTION_TEXTS, &k.outputs, "FILE", "write what came out, as run does"},
        {'f', "format", OPTION_TEXT, &k.format, "FORMAT", "what to write, whatever FILE is called"},
        {0, "entities", OPTION_FLAG, &k.entities, NULL, "in .json: list every entity"},
        SEEING_OPTIONS(&k),
        {0}};
    int code = options_read(&a, self, options, argc, argv, &files);
    if (code < 0)
        code = check_input(self, d, &files);
    if (code < 0 && files.count == 1 && gdb)
        code = debug_by_gdb(self, &k, &d->input, files.at[0]);
    if (code < 0)
        code = run_seen(&k, &s, &files);
    arena_free(&a);
    return code;
}

static const char *const examples[] = {
    "pcgc debug house.pcg", "pcgc debug house.pcg -x 'break window; continue; print; queues'",
    "pcgc debug house.pcg -p height=12m --batch steps.txt", "pcgc debug --gdb house.pcg", NULL};
const command command_debug = {"debug", "FILE",
                               "Runs a graph step by step, with what waits in its queues in view.",
                               examples, run_debug};

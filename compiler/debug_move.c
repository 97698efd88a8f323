/* debug_move.c - going on: by round, node, graph or to a breakpoint; and back in the record. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "debug.h"

/* ---- where it stops -------------------------------------------------------------------------- */

/* Whether a round that begins is where the last command wanted to go. */
static bool is_wanted(const debugger *d)
{
    const seen_round *r = history_round(&d->past);
    const seen_level *l = history_level(&d->past);
    uint32_t depth = d->past.open_count;
    switch (d->mode) {
    case GO_STEP:
        return true;
    case GO_NEXT:
        return r->node != d->from_node || l->frame != d->from_frame;
    case GO_OVER:
        return depth <= d->from_depth;
    case GO_OUT:
        return depth < d->from_depth;
    case GO_ON:
        return false;
    case GO_TO:
        return r->id >= d->wanted;
    }
    return true;
}

static void remember_place(debugger *d)
{
    const seen_round *r = history_round(&d->past);
    const seen_level *l = history_level(&d->past);
    d->from_depth = d->past.open_count;
    d->from_node = r ? r->node : NULL;
    d->from_frame = l ? l->frame : NULL;
    d->shown = 0;
}

static void show(debugger *d, const char *why)
{
    remember_place(d);
    debug_show_place(d, why);
}

bool debug_stops(debugger *d)
{
    const seen_record *last = history_last(&d->past);
    if (!last || (last->kind != SEEN_ROUND && last->kind != SEEN_SENT))
        return false;
    breakpoint *hit = debug_hit(d);
    if (hit) {
        hit->hits++;
        show(d, arena_format(&d->scratch, "%s %u: ",
                             hit->kind == BREAK_WATCH ? "watch" : "breakpoint", hit->number));
        if (hit->kind == BREAK_WATCH)
            debug_show_change(d, hit);
        return true;
    }
    if (last->kind != SEEN_ROUND)
        return false;
    bool interrupted = atomic_exchange(&d->pause, false), stops = interrupted || is_wanted(d);
    if (stops)
        show(d, interrupted ? "interrupted: " : NULL);
    return stops;
}

bool debug_replay(debugger *d)
{
    while (!history_is_present(&d->past)) {
        d->past.failed |= !history_forward(&d->past);
        if (d->past.failed || debug_stops(d))
            return true;
    }
    return false;
}

/* ---- on -------------------------------------------------------------------------------------- */

static void go(debugger *d, going mode)
{
    if (d->over && history_is_present(&d->past)) {
        debug_refuse(d, "the run is over; 'back' looks at its rounds, 'quit' ends");
        return;
    }
    d->mode = mode;
    d->resume = true;
}

void debug_step(debugger *d, char *arguments)
{
    (void)arguments;
    go(d, GO_STEP);
}

void debug_next(debugger *d, char *arguments)
{
    (void)arguments;
    go(d, GO_NEXT);
}

void debug_over(debugger *d, char *arguments)
{
    (void)arguments;
    go(d, GO_OVER);
}

void debug_out(debugger *d, char *arguments)
{
    (void)arguments;
    if (d->past.open_count < 2)
        debug_refuse(
            d, "this is the main graph: there is none to go out of; 'continue' runs to its end");
    else
        go(d, GO_OUT);
}

void debug_continue(debugger *d, char *arguments)
{
    (void)arguments;
    go(d, GO_ON);
}

/* ---- back ------------------------------------------------------------------------------------ */

static bool at_round(const history *h)
{
    const seen_record *last = history_last(h);
    return last && last->kind == SEEN_ROUND;
}

/* To the beginning of the round before; false where none is recorded. */
static bool back_one(history *h)
{
    do {
        if (!history_back(h))
            return false;
    } while (!at_round(h));
    return true;
}

/* To the first round that is recorded; its number, 0: none is. */
static uint64_t to_first(debugger *d)
{
    history *h = &d->past;
    while (history_back(h))
        continue;
    while (!at_round(h) && history_forward(h))
        continue;
    return at_round(h) ? history_round(h)->id : 0;
}

/* The wanted round is older than what is remembered. */
static void tell_oldest(debugger *d)
{
    uint64_t oldest = to_first(d);
    if (!oldest)
        debug_refuse(d, "no round is recorded");
    else if (oldest == 1)
        text_add(&d->out, "this is the first round\n");
    else
        text_format(&d->out,
                    "rounds before %llu are no longer recorded: they needed more than %zu KiB "
                    "(--history sets the limit)\n",
                    (unsigned long long)oldest, d->past.limit >> 10);
    if (oldest)
        show(d, NULL);
}

/* A count, or a round's number; `otherwise` where none is given. False: it was refused. */
static bool read_count(debugger *d, char *arguments, uint64_t otherwise, uint64_t *to)
{
    char *word = debug_word(&arguments), *end = NULL;
    *to = otherwise;
    if (!word)
        return true;
    errno = 0;
    if (*word >= '0' && *word <= '9')
        *to = strtoull(word, &end, 10);
    if (end && !*end && !errno && *to > 0 && !debug_word(&arguments))
        return true;
    debug_refuse(d, "'%s' is no number of rounds", word);
    return false;
}

void debug_back(debugger *d, char *arguments)
{
    uint64_t count;
    if (!read_count(d, arguments, 1, &count))
        return;
    for (; count; count--)
        if (!back_one(&d->past)) {
            tell_oldest(d);
            return;
        }
    show(d, NULL);
}

static uint64_t round_of(const history *h)
{
    return at_round(h) ? history_round(h)->id : 0;
}

/* Numbers grow as rounds begin, so that one way leads there. */
static void go_in_record(debugger *d, uint64_t wanted)
{
    history *h = &d->past;
    while (history_forward(h) && round_of(h) < wanted)
        continue;
    while (round_of(h) != wanted)
        if (!back_one(h)) {
            tell_oldest(d);
            return;
        }
    show(d, NULL);
}

void debug_goto(debugger *d, char *arguments)
{
    uint64_t wanted;
    if (!read_count(d, arguments, 0, &wanted))
        return;
    if (!wanted) {
        debug_refuse(d, "to which round? goto 12");
    } else if (wanted <= d->past.rounds) {
        go_in_record(d, wanted);
    } else if (d->over) {
        debug_refuse(d, "the run was over after %llu rounds", (unsigned long long)d->past.rounds);
    } else {
        while (history_forward(&d->past))
            continue;
        d->wanted = wanted;
        go(d, GO_TO);
    }
}

/* progress.c - the line on the terminal. */
#include "progress.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "base/base.h"

static const double FIRST_DRAWN = 0.5; /* seconds */
enum { COLUMNS_WHEN_UNKNOWN = 80, CONTROL_ROOM = 8 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- the line -------------------------------------------------------------------------------- */

/* 1,234,567 */
static void add_count(text *t, uint64_t n, const char *one, const char *many)
{
    char digits[32];
    int length = snprintf(digits, sizeof digits, "%llu", (unsigned long long)n);
    text_add(t, "  ");
    for (int i = 0; i < length; i++) {
        text_add_bytes(t, digits + i, 1);
        if ((length - i) % 3 == 1 && i + 1 < length)
            text_add(t, ",");
    }
    text_format(t, " %s", n == 1 ? one : many);
}

/* How many bytes the character has whose first one this is. */
static size_t bytes_of(unsigned char first)
{
    return first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

/* Characters from U+1100 on may take two columns: counted so, none is too wide. */
static unsigned columns_of(const unsigned char *s)
{
    return s[0] > 0xE1 || (s[0] == 0xE1 && s[1] >= 0x84) ? 2 : 1;
}

/* Copies what fits; names may hold anything, and nothing in them may speak to the terminal. */
static size_t copy_columns(const char *from, unsigned columns, char *out, size_t room)
{
    size_t length = 0, left = strlen(from);
    for (const unsigned char *s = (const unsigned char *)from; *s;) {
        size_t size = bytes_of(*s);
        bool whole = size <= left, control = *s < 0x20 || *s == 0x7F || (*s == 0xC2 && s[1] < 0xA0);
        unsigned wide = whole && !control ? columns_of(s) : 1;
        size = whole ? size : left;
        if (wide > columns || length + size >= room)
            break;
        if (control || !whole || (size == 1 && *s >= 0x80)) {
            out[length++] = '?';
        } else {
            memcpy(out + length, s, size);
            length += size;
        }
        columns -= wide;
        left -= size;
        s += size;
    }
    out[length] = '\0';
    return length;
}

size_t progress_line(const progress *p, double seconds, unsigned columns, char *out, size_t room)
{
    static const char spinner[] = "|/-\\";
    arena a = {0};
    text line = {.arena = &a};
    uint64_t tenths = (uint64_t)(seconds * 10);
    text_format(&line, "%c %llu.%u s  %s", spinner[p->drawn % (sizeof spinner - 1)],
                (unsigned long long)tenths / 10, (unsigned)(tenths % 10), p->what);
    if (p->rounds || p->entities) {
        add_count(&line, p->rounds, "round", "rounds");
        add_count(&line, p->entities, "entity", "entities");
    }
    size_t length = copy_columns(line.at ? line.at : "", columns, out, room);
    arena_free(&a);
    return length;
}

/* ---- the terminal ---------------------------------------------------------------------------- */

static unsigned terminal_columns(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || !size.ws_col)
        return COLUMNS_WHEN_UNKNOWN;
    return size.ws_col;
}

/* A terminal that is stopped by Ctrl+S takes nothing: Ctrl+C must get through all the same. */
static void put(const char *bytes, size_t length)
{
    struct pollfd terminal = {.fd = STDERR_FILENO, .events = POLLOUT};
    if (poll(&terminal, 1, 0) != 1 || !(terminal.revents & POLLOUT))
        return;
    ssize_t written = write(STDERR_FILENO, bytes, length);
    (void)written; /* the next one is drawn anew */
}

/* One write a line, which erases only behind it: nothing flickers. The last column stays free, for
 * the cursor. */
static void draw(void *context)
{
    progress *p = context;
    char line[PROGRESS_LINE + CONTROL_ROOM] = "\r";
    double seconds = now() - p->began;
    if (seconds < FIRST_DRAWN || !*p->what)
        return;
    size_t length = 1 + progress_line(p, seconds, terminal_columns() - 1, line + 1, PROGRESS_LINE);
    memcpy(line + length, "\033[K", 3);
    put(line, length + 3);
    p->shown = true;
    p->drawn++;
}

static void erase(void *context)
{
    static const char all[] = "\r\033[K";
    progress *p = context;
    if (p->shown)
        put(all, sizeof all - 1);
    p->shown = false;
}

static bool terminal_can(void)
{
    const char *no = getenv("NO_COLOR"), *kind = getenv("TERM");
    return isatty(STDERR_FILENO) && !(no && *no) && !(kind && !strcmp(kind, "dumb"));
}

/* ---- what callers tell it -------------------------------------------------------------------- */

void progress_begin(progress *p, interrupt *guard, bool quiet)
{
    *p = (progress){.guard = guard, .wanted = !quiet && terminal_can(), .began = now()};
    if (!p->wanted)
        return;
    guard->tick = draw;
    guard->clear = erase;
    guard->user = p;
}

void progress_stage(progress *p, const char *verb, const char *path)
{
    if (!p->wanted)
        return;
    interrupt_lock(p->guard);
    if (snprintf(p->what, sizeof p->what, "%s%s%s", verb, *path ? " " : "", path) < 0)
        p->what[0] = '\0';
    p->rounds = p->entities = 0;
    interrupt_unlock(p->guard);
}

int progress_run(void *context, const pcg_progress *run)
{
    progress *p = context;
    interrupt_lock(p->guard);
    if (run->node && snprintf(p->what, sizeof p->what, "%s", run->node) < 0)
        p->what[0] = '\0';
    p->rounds = run->rounds;
    p->entities = run->entities;
    interrupt_unlock(p->guard);
    return 0;
}

void progress_hide(progress *p)
{
    if (!p->wanted)
        return;
    interrupt_lock(p->guard);
    erase(p);
    interrupt_unlock(p->guard);
}

void progress_end(progress *p)
{
    if (!p->wanted)
        return;
    interrupt_lock(p->guard);
    p->what[0] = '\0';
    erase(p);
    interrupt_unlock(p->guard);
}

/* pattern.c - regular expressions: what the constraint `matches` holds values against.
 *
 * An expression becomes a program of a small machine that is run in all its states at once, so that
 * the time is bounded by the length of the program times that of the text whatever the two are (K.
 * Thompson, "Regular expression search algorithm", 1968). */
#include "base.h"

#include <string.h>

enum {
    MAX_STEPS = 20000, /* of a program: counted repetitions multiply */
    MAX_DEPTH = 100,   /* of groups */
    MAX_COUNT = 1000,  /* in {…} */
    NO_END = -1        /* {2,} */
};

typedef enum step_kind {
    STEP_CHARACTER, /* takes .character */
    STEP_ANY,       /* takes one, whatever it is */
    STEP_SET,       /* takes one that the set holds */
    STEP_FORK,      /* goes on at .first, and at .second */
    STEP_BEGIN,     /* goes on at the text's begin only */
    STEP_END,       /* … at its end only */
    STEP_MATCH
} step_kind;

typedef struct range {
    uint32_t low, high;
} range;

typedef struct set {
    LIST(range) ranges;
    bool negated;
} set;

typedef struct step {
    step_kind kind;
    uint32_t character;
    const set *set;
    uint32_t first, second;
} step;

struct pattern {
    LIST(step) steps;
};

typedef struct reader {
    arena *arena;
    pattern *pattern;
    const char *at;
    const char *error; /* NULL while there is none */
    uint32_t depth;
} reader;

/* ---- characters ---------------------------------------------------------------------------- */

/* The next character; a byte that is no UTF-8 counts as one of its own. */
static uint32_t next_character(const char **at)
{
    const unsigned char *u = (const unsigned char *)*at;
    uint32_t more = u[0] < 0xC0 ? 0 : u[0] < 0xE0 ? 1 : u[0] < 0xF0 ? 2 : u[0] < 0xF8 ? 3 : 0;
    uint32_t c = more ? u[0] & (0x3Fu >> more) : u[0];
    for (uint32_t i = 1; i <= more; i++) {
        if ((u[i] & 0xC0) != 0x80) {
            *at += 1;
            return u[0];
        }
        c = c << 6 | (u[i] & 0x3F);
    }
    *at += 1 + more;
    return c;
}

static void add_range(reader *r, set *s, uint32_t low, uint32_t high)
{
    range one = {low, high};
    LIST_ADD(r->arena, &s->ranges, one);
}

/* \d, \w, \s: false where the letter is none of them. */
static bool add_class(reader *r, set *s, char letter)
{
    switch (letter) {
    case 'd':
        add_range(r, s, '0', '9');
        return true;
    case 'w':
        add_range(r, s, '0', '9');
        add_range(r, s, 'A', 'Z');
        add_range(r, s, 'a', 'z');
        add_range(r, s, '_', '_');
        return true;
    case 's':
        add_range(r, s, '\t', '\r');
        add_range(r, s, ' ', ' ');
        return true;
    default:
        return false;
    }
}

static bool holds(const set *s, uint32_t c)
{
    for (uint32_t i = 0; i < s->ranges.count; i++)
        if (c >= s->ranges.at[i].low && c <= s->ranges.at[i].high)
            return !s->negated;
    return s->negated;
}

/* ---- the program --------------------------------------------------------------------------- */

static void fail(reader *r, const char *error)
{
    if (!r->error)
        r->error = error;
}

static uint32_t add_step(reader *r, step s)
{
    pattern *p = r->pattern;
    if (p->steps.count >= MAX_STEPS) {
        fail(r, "it is too large");
        return 0;
    }
    LIST_ADD(r->arena, &p->steps, s);
    return p->steps.count - 1;
}

/* Makes room for one step at `place`: what lies behind moves, and what it leads to with it. */
static void insert_step(reader *r, uint32_t place)
{
    pattern *p = r->pattern;
    add_step(r, (step){.kind = STEP_FORK});
    if (r->error)
        return;
    for (uint32_t i = p->steps.count - 1; i > place; i--) {
        p->steps.at[i] = p->steps.at[i - 1];
        p->steps.at[i].first += p->steps.at[i].first >= place;
        p->steps.at[i].second += p->steps.at[i].second >= place;
    }
}

/* A fork that goes on at the next step, or jumps. */
static step fork_to(uint32_t first, uint32_t second)
{
    return (step){.kind = STEP_FORK, .first = first, .second = second};
}

/* Appends the steps from..to-1 once more. */
static void repeat_steps(reader *r, uint32_t from, uint32_t to)
{
    uint32_t shift = r->pattern->steps.count - from;
    for (uint32_t i = from; i < to && !r->error; i++) {
        step s = r->pattern->steps.at[i];
        s.first += shift;
        s.second += shift;
        add_step(r, s);
    }
}

static void make_optional(reader *r, uint32_t from)
{
    insert_step(r, from);
    if (!r->error)
        r->pattern->steps.at[from] = fork_to(from + 1, r->pattern->steps.count);
}

/* Once or more: back to `from`, or on. */
static void make_loop(reader *r, uint32_t from)
{
    uint32_t here = r->pattern->steps.count;
    add_step(r, fork_to(from, here + 1));
}

/* What stands from `from` on, between `low` and `high` times. */
static void repeat(reader *r, uint32_t from, int low, int high)
{
    uint32_t to = r->pattern->steps.count, last = from;
    if (high == 0) {
        r->pattern->steps.count = from;
        return;
    }
    for (int i = 1; i < (low ? low : 1) && !r->error; i++) {
        last = r->pattern->steps.count;
        repeat_steps(r, from, to);
    }
    if (high == NO_END) {
        make_loop(r, last);
    } else {
        for (int i = low ? low : 1; i < high && !r->error; i++) {
            uint32_t more = r->pattern->steps.count;
            repeat_steps(r, from, to);
            make_optional(r, more);
        }
    }
    if (low == 0 && !r->error)
        make_optional(r, from);
}

/* ---- reading ------------------------------------------------------------------------------- */

static void read_choice(reader *r);

static uint32_t read_escape(reader *r)
{
    char c = *r->at;
    if (!c) {
        fail(r, "it ends with a backslash");
        return 0;
    }
    if (c == 'n' || c == 't' || c == 'r') {
        r->at++;
        return c == 'n' ? '\n' : c == 't' ? '\t' : '\r';
    }
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) {
        fail(r, "a letter or digit behind the backslash means nothing");
        return 0;
    }
    return next_character(&r->at);
}

static void read_set_item(reader *r, set *s)
{
    if (r->at[0] == '\\' && r->at[1] && add_class(r, s, r->at[1])) {
        r->at += 2;
        return;
    }
    uint32_t low = next_character(&r->at);
    if (low == '\\')
        low = read_escape(r);
    uint32_t high = low;
    if (r->at[0] == '-' && r->at[1] && r->at[1] != ']') {
        r->at++;
        high = next_character(&r->at);
        if (high == '\\')
            high = read_escape(r);
    }
    if (high < low)
        fail(r, "a range in […] goes backwards");
    add_range(r, s, low, high);
}

static void read_set(reader *r)
{
    set *s = ARENA_NEW(r->arena, set);
    if (*r->at == '^') {
        s->negated = true;
        r->at++;
    }
    do {
        if (!*r->at)
            fail(r, "'[' is never closed");
        else
            read_set_item(r, s);
    } while (!r->error && *r->at != ']');
    r->at += !r->error;
    add_step(r, (step){.kind = STEP_SET, .set = s});
}

static void read_group(reader *r)
{
    if (++r->depth > MAX_DEPTH) {
        fail(r, "its groups are nested too deep");
        return;
    }
    read_choice(r);
    r->depth--;
    if (*r->at != ')')
        fail(r, "'(' is never closed");
    else
        r->at++;
}

static void read_atom(reader *r)
{
    uint32_t c = next_character(&r->at);
    set *s;
    switch (c) {
    case '.':
        add_step(r, (step){.kind = STEP_ANY});
        break;
    case '^':
        add_step(r, (step){.kind = STEP_BEGIN});
        break;
    case '$':
        add_step(r, (step){.kind = STEP_END});
        break;
    case '[':
        read_set(r);
        break;
    case '(':
        read_group(r);
        break;
    case '*':
    case '+':
    case '?':
    case '{':
        fail(r, "there is nothing to repeat");
        break;
    case '\\':
        s = ARENA_NEW(r->arena, set);
        if (*r->at && add_class(r, s, *r->at)) {
            r->at++;
            add_step(r, (step){.kind = STEP_SET, .set = s});
            break;
        }
        c = read_escape(r);
        add_step(r, (step){.kind = STEP_CHARACTER, .character = c});
        break;
    default:
        add_step(r, (step){.kind = STEP_CHARACTER, .character = c});
    }
}

static int read_count(reader *r)
{
    int count = 0;
    if (*r->at < '0' || *r->at > '9')
        fail(r, "'{' lacks its number");
    for (; *r->at >= '0' && *r->at <= '9' && count <= MAX_COUNT; r->at++)
        count = count * 10 + (*r->at - '0');
    if (count > MAX_COUNT)
        fail(r, "it repeats too often");
    return count;
}

/* {2}, {2,} or {2,5} */
static void read_counts(reader *r, int *low, int *high)
{
    *low = *high = read_count(r);
    if (*r->at == ',') {
        r->at++;
        *high = *r->at == '}' ? NO_END : read_count(r);
    }
    if (*r->at != '}')
        fail(r, "'{' is never closed");
    else if (*high != NO_END && *high < *low)
        fail(r, "a count in {…} goes backwards");
    else
        r->at++;
}

static void read_repeated(reader *r)
{
    uint32_t from = r->pattern->steps.count;
    read_atom(r);
    while (!r->error && *r->at && strchr("*+?{", *r->at)) {
        int low = 0, high = NO_END;
        char c = *r->at++;
        if (c == '+')
            low = 1;
        else if (c == '?')
            high = 1;
        else if (c == '{')
            read_counts(r, &low, &high);
        if (!r->error)
            repeat(r, from, low, high);
    }
}

static void read_sequence(reader *r)
{
    while (*r->at && *r->at != '|' && *r->at != ')' && !r->error)
        read_repeated(r);
}

/* a|b|c becomes: fork to a or to the rest; a; jump behind all. */
static void read_choice(reader *r)
{
    LIST(uint32_t) jumps = {0};
    uint32_t from = r->pattern->steps.count;
    read_sequence(r);
    while (*r->at == '|' && !r->error) {
        r->at++;
        insert_step(r, from);
        uint32_t jump = add_step(r, fork_to(0, 0));
        if (r->error)
            break;
        LIST_ADD(r->arena, &jumps, jump);
        r->pattern->steps.at[from] = fork_to(from + 1, jump + 1);
        from = jump + 1;
        read_sequence(r);
    }
    for (uint32_t i = 0; i < jumps.count && !r->error; i++) {
        uint32_t behind = r->pattern->steps.count;
        r->pattern->steps.at[jumps.at[i]] = fork_to(behind, behind);
    }
}

pattern *pattern_new(arena *a, const char *expression, const char **error)
{
    reader r = {.arena = a, .pattern = ARENA_NEW(a, pattern), .at = expression};
    read_choice(&r);
    if (*r.at == ')')
        fail(&r, "')' closes nothing");
    add_step(&r, (step){.kind = STEP_MATCH});
    *error = r.error;
    return r.error ? NULL : r.pattern;
}

/* ---- matching ------------------------------------------------------------------------------ */

/* The steps that the machine stands at, each once. */
typedef struct states {
    uint32_t *at, count;
    uint64_t *seen; /* by step: the position at which it was added last, from 1 */
    uint32_t *waiting;
} states;

/* Adds a step, and through forks all that it leads to without taking a character. */
static void add_state(const pattern *p, states *s, uint32_t first, uint64_t position, bool at_begin,
                      bool at_end)
{
    uint32_t count = 0;
    s->waiting[count++] = first;
    while (count) {
        uint32_t i = s->waiting[--count];
        const step *t = &p->steps.at[i];
        if (s->seen[i] == position)
            continue;
        s->seen[i] = position;
        if (t->kind == STEP_FORK) {
            s->waiting[count++] = t->second;
            s->waiting[count++] = t->first;
        } else if ((t->kind == STEP_BEGIN && at_begin) || (t->kind == STEP_END && at_end)) {
            s->waiting[count++] = i + 1;
        } else {
            s->at[s->count++] = i;
        }
    }
}

static bool takes(const step *t, uint32_t c)
{
    return t->kind == STEP_ANY || (t->kind == STEP_CHARACTER && t->character == c) ||
           (t->kind == STEP_SET && holds(t->set, c));
}

bool pattern_matches(arena *a, const pattern *p, const char *s)
{
    uint32_t count = p->steps.count;
    states now = {.at = ARENA_ARRAY(a, uint32_t, count), .seen = ARENA_ARRAY(a, uint64_t, count)};
    states next = {.at = ARENA_ARRAY(a, uint32_t, count), .seen = now.seen};
    now.waiting = next.waiting = ARENA_ARRAY(a, uint32_t, (size_t)count * 2 + 2);
    uint64_t position = 1;
    add_state(p, &now, 0, position, true, !*s);
    while (*s && now.count) {
        uint32_t c = next_character(&s);
        position++;
        next.count = 0;
        for (uint32_t i = 0; i < now.count; i++)
            if (takes(&p->steps.at[now.at[i]], c))
                add_state(p, &next, now.at[i] + 1, position, false, !*s);
        states swapped = now;
        now = next;
        next = swapped;
    }
    for (uint32_t i = 0; !*s && i < now.count; i++)
        if (p->steps.at[now.at[i]].kind == STEP_MATCH)
            return true;
    return false;
}

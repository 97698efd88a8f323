/* command_bench.c - pcgc bench: what compiling a graph, running it and writing its result take,
 * over several runs, over values of parameters and over threads.
 *
 * Each run is a process of its own, forked from this one, so that its peak of memory is its own
 * and no run finds memory that another has touched. It tells what it measured through a pipe. The
 * points (one for each combination of values) take turns, so that what else the machine does meets
 * all of them alike. */
#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command_run.h"

enum {
    BENCH_PASSES = 32,
    BENCH_POINTS_MAX = 1000,
    BENCH_RUNS_MAX = 10000,
    BENCH_THREADS_MAX = 1024
};

typedef struct duration {
    double wall, processor; /* seconds */
} duration;

/* What a run tells: short enough for a pipe to take it whole. */
typedef struct telling {
    uint64_t rounds, sent, entities, faces;
    uint32_t pass_count;
    struct {
        char name[16];
        duration took;
    } passes[BENCH_PASSES];
} telling;
_Static_assert(sizeof(telling) <= 4096, "a pipe takes it whole");

typedef struct sample {
    telling told;
    duration compile, run, write;
    double user, system; /* seconds of the whole process */
    double memory;       /* bytes, at its peak */
} sample;

/* One value for each --vary, and a number of threads. */
typedef struct point {
    const char **values;
    uint64_t threads; /* 0: not given */
    sample *samples;
} point;

typedef struct varied {
    const char *name;
    LIST(const char *) values;
} varied;

typedef struct bench {
    const command *self;
    arena memory;
    jmp_buf out_of_memory;
    running settings;
    option_texts vary;
    const char *threads, *path;
    uint64_t runs, warmups;
    bool json;
    LIST(varied) parameters;
    LIST(uint64_t) thread_counts;
    point *points;
    uint32_t point_count;
    FILE *messages; /* of runs behind a point's first: shown where one fails */
} bench;

/* ---- within a run ---------------------------------------------------------------------------- */

/* `user` is the end of the pipe. */
static void tell(void *user, const running *k)
{
    const int *pipe_end = user;
    telling t = {.rounds = k->outcome.rounds,
                 .sent = k->outcome.sent,
                 .entities = k->outcome.entities,
                 .faces = k->outcome.faces};
    for (uint32_t i = 0; i < k->t.times.count && i < BENCH_PASSES; i++) {
        snprintf(t.passes[i].name, sizeof t.passes[i].name, "%s", k->t.times.at[i].name);
        t.passes[i].took = (duration){k->t.times.at[i].seconds, k->t.processor.at[i]};
        t.pass_count++;
    }
    if (write(*pipe_end, &t, sizeof t) != (ssize_t)sizeof t)
        tool_error(EXIT_BUG, "a run cannot tell what it measured: %s", strerror(errno));
}

/* Never returns. The parent's death ends it. */
static void run_point(bench *b, const point *p, int pipe_end, bool silent, void (*interrupted)(int))
{
    running k = b->settings;
    size_t given = k.parameters.count;
    const char **all = ARENA_ARRAY(&b->memory, const char *, given + b->parameters.count);
    signal(SIGINT, interrupted);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (silent)
        dup2(fileno(b->messages), STDERR_FILENO);
    if (given)
        memcpy(all, k.parameters.at, given * sizeof *all);
    for (uint32_t i = 0; i < b->parameters.count; i++)
        all[given + i] = arena_format(&b->memory, "%s=%s", b->parameters.at[i].name, p->values[i]);
    k.parameters = (option_texts){all, given + b->parameters.count};
    k.threads = p->threads;
    k.command = b->self;
    k.t.quiet = true;
    k.measured = tell;
    k.measured_user = &pipe_end;
    int code = run_file(&k, b->path);
    fflush(NULL);
    _exit(code);
}

/* ---- a run, from outside --------------------------------------------------------------------- */

static void show_messages(FILE *messages)
{
    char buffer[4096];
    size_t length;
    rewind(messages);
    while ((length = fread(buffer, 1, sizeof buffer, messages)) > 0)
        fwrite(buffer, 1, length, stderr);
}

/* Compiling is what comes before "run", writing what comes behind it. */
static void sort_passes(sample *s)
{
    duration *to = &s->compile;
    for (uint32_t i = 0; i < s->told.pass_count; i++) {
        bool runs = !strcmp(s->told.passes[i].name, "run");
        duration *d = runs ? &s->run : to;
        d->wall += s->told.passes[i].took.wall;
        d->processor += s->told.passes[i].took.processor;
        to = runs ? &s->write : to;
    }
}

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* Waits for the run and takes what it told. Its exit code. */
static int take_sample(pid_t child, int pipe_end, sample *s)
{
    int state;
    struct rusage used;
    bool whole = read(pipe_end, &s->told, sizeof s->told) == (ssize_t)sizeof s->told;
    pid_t ended;
    while ((ended = wait4(child, &state, 0, &used)) < 0 && errno == EINTR)
        continue;
    if (ended < 0)
        return tool_error(EXIT_BUG, "a run is lost: %s", strerror(errno));
    if (WIFSIGNALED(state))
        return tool_error(EXIT_BUG, "a run was ended by signal %d", WTERMSIG(state));
    s->user = seconds_of(used.ru_utime);
    s->system = seconds_of(used.ru_stime);
    s->memory = (double)used.ru_maxrss * 1024;
    sort_passes(s);
    return WEXITSTATUS(state) ? WEXITSTATUS(state)
           : whole            ? EXIT_DONE
                              : tool_error(EXIT_BUG, "a run did not tell what it measured");
}

/* Ctrl+C reaches both processes: the run cleans up, this one waits for it. */
static int measure_once(bench *b, const point *p, bool silent, sample *s)
{
    int ends[2];
    *s = (sample){0};
    if (pipe(ends) != 0)
        return tool_error(EXIT_LIMIT, "no pipe: %s", strerror(errno));
    rewind(b->messages);
    if (ftruncate(fileno(b->messages), 0) != 0)
        return tool_error(EXIT_LIMIT, "no temporary file: %s", strerror(errno));
    fflush(NULL);
    void (*before)(int) = signal(SIGINT, SIG_IGN);
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        run_point(b, p, ends[1], silent, before);
    }
    close(ends[1]);
    int code = child < 0 ? tool_error(EXIT_LIMIT, "no process: %s", strerror(errno))
                         : take_sample(child, ends[0], s);
    close(ends[0]);
    signal(SIGINT, before);
    if (code != EXIT_DONE && silent)
        show_messages(b->messages);
    return code;
}

static int measure_points(bench *b)
{
    b->messages = tmpfile();
    if (!b->messages)
        return tool_error(EXIT_LIMIT, "no temporary file: %s", strerror(errno));
    int code = EXIT_DONE;
    sample warm;
    for (uint64_t run = 0; run < b->warmups + b->runs && code == EXIT_DONE; run++)
        for (uint32_t i = 0; i < b->point_count && code == EXIT_DONE; i++) {
            sample *to = run < b->warmups ? &warm : &b->points[i].samples[run - b->warmups];
            code = measure_once(b, &b->points[i], run > 0, to);
        }
    fclose(b->messages);
    return code;
}

/* ---- statistics ------------------------------------------------------------------------------ */

typedef struct spread {
    double median, least, most;
} spread;

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Sorts the values. */
static spread spread_of(double *values, size_t count)
{
    qsort(values, count, sizeof *values, by_size);
    size_t half = count / 2;
    double median = count % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
    return (spread){median, values[0], values[count - 1]};
}

/* Of the member of all samples of a point that stands at that offset: a double. */
static spread measured(bench *b, const point *p, size_t member)
{
    double *values = ARENA_ARRAY(&b->memory, double, b->runs);
    for (uint64_t i = 0; i < b->runs; i++)
        memcpy(&values[i], (const char *)&p->samples[i] + member, sizeof values[i]);
    return spread_of(values, b->runs);
}
#define MEASURED(b, p, member) measured((b), (p), offsetof(sample, member))

/* Of one pass, in all runs of all points: they compile the same text. */
static spread pass_spread(bench *b, uint32_t pass, bool processor)
{
    double *values = ARENA_ARRAY(&b->memory, double, b->runs * b->point_count);
    size_t count = 0;
    for (uint32_t i = 0; i < b->point_count; i++)
        for (uint64_t k = 0; k < b->runs; k++) {
            const duration *d = &b->points[i].samples[k].told.passes[pass].took;
            values[count++] = processor ? d->processor : d->wall;
        }
    return spread_of(values, count);
}

/* Passes up to "run". */
static uint32_t compile_passes(const bench *b)
{
    const telling *t = &b->points[0].samples[0].told;
    uint32_t count = 0;
    while (count < t->pass_count && strcmp(t->passes[count].name, "run") != 0)
        count++;
    return count;
}

static double per(double amount, double of)
{
    return of > 0 ? amount / of : 0;
}

/* ---- a table for people ---------------------------------------------------------------------- */

static void print_passes(bench *b)
{
    uint32_t count = compile_passes(b);
    printf("%-10s %9s %19s %9s\n", "pass", "ms", "(least to most)", "cpu ms");
    for (uint32_t i = 0; i < count; i++) {
        spread wall = pass_spread(b, i, false), processor = pass_spread(b, i, true);
        printf("%-10s %9.3f %8.3f - %8.3f %9.3f\n", b->points[0].samples[0].told.passes[i].name,
               1e3 * wall.median, 1e3 * wall.least, 1e3 * wall.most, 1e3 * processor.median);
    }
    duration sum = {0};
    for (uint32_t i = 0; i < b->point_count; i++) {
        sum.wall += MEASURED(b, &b->points[i], compile.wall).median / b->point_count;
        sum.processor += MEASURED(b, &b->points[i], compile.processor).median / b->point_count;
    }
    printf("%-10s %9.3f %19s %9.3f\n\n", "all", 1e3 * sum.wall, "", 1e3 * sum.processor);
}

static void print_heads(const bench *b)
{
    for (uint32_t i = 0; i < b->parameters.count; i++)
        printf("%12s ", b->parameters.at[i].name);
    if (b->threads)
        printf("%7s ", "threads");
    printf("%10s %10s %10s %10s %19s %10s %7s %10s %10s %9s %9s %8s %8s\n", "rounds", "entities",
           "faces", "run ms", "(least to most)", "cpu ms", "growth", "write ms", "cpu ms",
           "rounds/s", "entit./s", "MiB", "B/face");
}

/* Growth is that of the run's processor time, from the first point on. */
static void print_point(bench *b, const point *p)
{
    const telling *t = &p->samples[0].told;
    spread run = MEASURED(b, p, run.wall);
    double processor = MEASURED(b, p, run.processor).median, memory = MEASURED(b, p, memory).median;
    double first = MEASURED(b, &b->points[0], run.processor).median;
    for (uint32_t i = 0; i < b->parameters.count; i++)
        printf("%12s ", p->values[i]);
    if (b->threads)
        printf("%7llu ", (unsigned long long)p->threads);
    printf("%10llu %10llu %10llu %10.3f %8.2f - %8.2f %10.3f %6.2fx %10.3f %10.3f %9.3g %9.3g "
           "%8.1f %8.1f\n",
           (unsigned long long)t->rounds, (unsigned long long)t->entities,
           (unsigned long long)t->faces, 1e3 * run.median, 1e3 * run.least, 1e3 * run.most,
           1e3 * processor, per(processor, first), 1e3 * MEASURED(b, p, write.wall).median,
           1e3 * MEASURED(b, p, write.processor).median, per((double)t->rounds, run.median),
           per((double)t->sent, run.median), memory / (1 << 20), per(memory, (double)t->faces));
}

static void print_table(bench *b)
{
    printf("%s: %llu run%s a line, medians\n\n", b->path, (unsigned long long)b->runs,
           b->runs == 1 ? "" : "s");
    print_passes(b);
    print_heads(b);
    for (uint32_t i = 0; i < b->point_count; i++)
        print_point(b, &b->points[i]);
}

/* ---- JSON for machines ----------------------------------------------------------------------- */

static void add_spread(text *out, const char *name, spread s)
{
    const double values[] = {s.median, s.least, s.most};
    static const char *const names[] = {"median", "least", "most"};
    text_format(out, "\"%s\":{", name);
    for (size_t i = 0; i < COUNT_OF(values); i++) {
        text_format(out, "%s\"%s\":", i ? "," : "", names[i]);
        text_number(out, values[i]);
    }
    text_add(out, "}");
}

static void add_duration(text *out, const char *name, spread wall, spread processor)
{
    text_format(out, ",\"%s\":{", name);
    add_spread(out, "wall", wall);
    text_add(out, ",");
    add_spread(out, "cpu", processor);
    text_add(out, "}");
}

static void add_passes(bench *b, text *out)
{
    uint32_t count = compile_passes(b);
    text_add(out, ",\"passes\":[");
    for (uint32_t i = 0; i < count; i++) {
        text_add(out, i ? ",{\"name\":" : "{\"name\":");
        text_quote(out, b->points[0].samples[0].told.passes[i].name);
        text_add(out, ",");
        add_spread(out, "wall", pass_spread(b, i, false));
        text_add(out, ",");
        add_spread(out, "cpu", pass_spread(b, i, true));
        text_add(out, "}");
    }
    text_add(out, "]");
}

static void add_point(bench *b, text *out, const point *p)
{
    const telling *t = &p->samples[0].told;
    text_add(out, "{\"parameters\":{");
    for (uint32_t i = 0; i < b->parameters.count; i++) {
        text_add(out, i ? "," : "");
        text_quote(out, b->parameters.at[i].name);
        text_add(out, ":");
        text_quote(out, p->values[i]);
    }
    text_add(out, "},\"threads\":");
    if (b->threads)
        text_format(out, "%llu", (unsigned long long)p->threads);
    else
        text_add(out, "null");
    text_format(out, ",\"rounds\":%llu,\"sent\":%llu,\"entities\":%llu,\"faces\":%llu",
                (unsigned long long)t->rounds, (unsigned long long)t->sent,
                (unsigned long long)t->entities, (unsigned long long)t->faces);
    add_duration(out, "compile", MEASURED(b, p, compile.wall), MEASURED(b, p, compile.processor));
    add_duration(out, "run", MEASURED(b, p, run.wall), MEASURED(b, p, run.processor));
    add_duration(out, "write", MEASURED(b, p, write.wall), MEASURED(b, p, write.processor));
    text_add(out, ",\"process\":{");
    add_spread(out, "user", MEASURED(b, p, user));
    text_add(out, ",");
    add_spread(out, "system", MEASURED(b, p, system));
    text_add(out, "},");
    add_spread(out, "memory", MEASURED(b, p, memory));
    text_add(out, "}");
}

static void print_json(bench *b)
{
    text out = {.arena = &b->memory};
    text_add(&out, "{\"version\":1,\"file\":");
    text_quote(&out, b->path);
    text_format(&out, ",\"runs\":%llu", (unsigned long long)b->runs);
    add_passes(b, &out);
    text_add(&out, ",\"points\":[");
    for (uint32_t i = 0; i < b->point_count; i++) {
        text_add(&out, i ? ",\n" : "\n");
        add_point(b, &out, &b->points[i]);
    }
    text_add(&out, "]}\n");
    fputs(out.at, stdout);
}

/* ---- the points ------------------------------------------------------------------------------ */

/* Up to the next comma that is neither in brackets nor in quotes. */
static size_t value_length(const char *s)
{
    int depth = 0;
    bool quoted = false;
    size_t length = 0;
    for (; s[length] && (s[length] != ',' || depth > 0 || quoted); length++) {
        if (s[length] == '"')
            quoted = !quoted;
        else if (!quoted && (s[length] == '[' || s[length] == '('))
            depth++;
        else if (!quoted && (s[length] == ']' || s[length] == ')'))
            depth--;
    }
    return length;
}

/* "houses=1,10,100". -1, or an exit code. */
static int read_varied(bench *b, const char *word)
{
    const char *equals = strchr(word, '=');
    if (!equals || equals == word || !equals[1])
        return usage_error(b->self, "option '--vary' takes name=value,value…, not '%s'", word);
    varied v = {.name = arena_copy(&b->memory, word, (size_t)(equals - word))};
    for (const char *at = equals; at; at = *at == ',' ? at : NULL) {
        size_t length = value_length(at + 1);
        LIST_ADD(&b->memory, &v.values, arena_copy(&b->memory, at + 1, length));
        at += 1 + length;
    }
    LIST_ADD(&b->memory, &b->parameters, v);
    return -1;
}

/* "1,2,4". -1, or an exit code. */
static int read_threads(bench *b)
{
    for (const char *at = b->threads; at;) {
        char *end;
        unsigned long n = *at >= '0' && *at <= '9' ? strtoul(at, &end, 10) : 0;
        if (!n || n > BENCH_THREADS_MAX || (*end && *end != ','))
            return usage_error(b->self,
                               "option '--threads' takes numbers from 1 to %d with commas between "
                               "them, not '%s'",
                               BENCH_THREADS_MAX, b->threads);
        LIST_ADD(&b->memory, &b->thread_counts, n);
        at = *end ? end + 1 : NULL;
    }
    if (!b->thread_counts.count)
        LIST_ADD(&b->memory, &b->thread_counts, 0);
    return -1;
}

/* The last value changes fastest. */
static void fill_point(bench *b, point *p, uint32_t number)
{
    p->threads = b->thread_counts.at[number % b->thread_counts.count];
    number /= b->thread_counts.count;
    p->values = ARENA_ARRAY(&b->memory, const char *, b->parameters.count);
    p->samples = ARENA_ARRAY(&b->memory, sample, b->runs);
    for (uint32_t i = b->parameters.count; i-- > 0;) {
        const varied *v = &b->parameters.at[i];
        p->values[i] = v->values.at[number % v->values.count];
        number /= v->values.count;
    }
}

static int make_points(bench *b)
{
    uint64_t count = 1;
    int code = read_threads(b);
    for (size_t i = 0; i < b->vary.count && code < 0; i++)
        code = read_varied(b, b->vary.at[i]);
    if (code >= 0)
        return code;
    count = b->thread_counts.count;
    for (uint32_t i = 0; i < b->parameters.count && count <= BENCH_POINTS_MAX; i++)
        count *= b->parameters.at[i].values.count;
    if (count > BENCH_POINTS_MAX)
        return usage_error(b->self, "no more than %d combinations of values", BENCH_POINTS_MAX);
    b->point_count = (uint32_t)count;
    b->points = ARENA_ARRAY(&b->memory, point, count);
    for (uint32_t i = 0; i < b->point_count; i++)
        fill_point(b, &b->points[i], i);
    return -1;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int check_options(bench *b, const option_texts *files)
{
    if (files->count != 1)
        return usage_error(b->self, files->count ? "one file at a time" : "which file?");
    b->path = files->at[0];
    if (!strcmp(b->path, "-"))
        return usage_error(b->self, "standard input cannot be read several times: name a file");
    for (size_t i = 0; i < b->settings.outputs.count; i++)
        if (!strcmp(b->settings.outputs.at[i], "-"))
            return usage_error(b->self, "standard output is for what was measured: name a file");
    if (!b->runs || b->runs > BENCH_RUNS_MAX || b->warmups > BENCH_RUNS_MAX)
        return usage_error(b->self, "option '--runs' takes 1 to %d", BENCH_RUNS_MAX);
    return make_points(b);
}

static int read_options(bench *b, int argc, char **argv)
{
    option_texts files = {0};
    const option options[] = {
        {0, "runs", OPTION_COUNT, &b->runs, "N",
         "how often each point is measured; 5 when not given"},
        {0, "warmups", OPTION_COUNT, &b->warmups, "N",
         "runs before them that do not count; 1 when not given"},
        {0, "vary", OPTION_TEXTS, &b->vary, "NAME=VALUE,VALUE…",
         "measure with each of these values of a parameter; with several, with each combination"},
        {0, "threads", OPTION_TEXT, &b->threads, "N,N…",
         "measure with each of these numbers of threads"},
        {0, "json", OPTION_FLAG, &b->json, NULL, "print it as JSON: seconds and bytes"},
        {'o', "output", OPTION_TEXTS, &b->settings.outputs, "FILE",
         "write this each time, as `run` does, and measure it"},
        {'f', "format", OPTION_TEXT, &b->settings.format, "FORMAT",
         "what to write, whatever FILE is called"},
        {0, "size", OPTION_TEXT, &b->settings.size, "WIDTHxHEIGHT", "of a picture"},
        SEEING_OPTIONS(&b->settings),
        {0}};
    int code = options_read(&b->memory, b->self, options, argc, argv, &files);
    return code < 0 ? check_options(b, &files) : code;
}

static int run_bench(const command *self, int argc, char **argv)
{
    bench b = {.self = self, .runs = 5, .warmups = 1};
    int code;
    b.memory.on_failure = &b.out_of_memory;
    if (setjmp(b.out_of_memory)) {
        code = tool_error(EXIT_LIMIT, "out of memory");
    } else {
        code = read_options(&b, argc, argv);
        if (code < 0)
            code = measure_points(&b);
        else
            b.point_count = 0;
        if (code == EXIT_DONE && b.point_count)
            (b.json ? print_json : print_table)(&b);
    }
    arena_free(&b.memory);
    return code;
}

static const char *const examples[] = {
    "pcgc bench house.pcg", "pcgc bench city.pcg --vary houses=10,100,1000 --threads 1,2",
    "pcgc bench city.pcg -p houses=1000 -o city.glb --runs 9 --json", NULL};
const command command_bench = {
    "bench", "FILE",
    "Runs a graph several times and tells what compiling it, running it and writing its\n"
    "result take: medians, by the clock and of the processors, rounds, memory, growth.",
    examples, run_bench};

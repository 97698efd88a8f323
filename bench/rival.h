/* rival.h - what the programs share that graphs are compared with: clocks, and one line of JSON.
 *
 * Each prints an object with what it counted, so that the driver can compare it with what the
 * graph made, and "parts": the seconds of each part, by the clock and of the processor. */
#ifndef BENCH_RIVAL_H
#define BENCH_RIVAL_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RIVAL_PARTS = 8 };

typedef struct rival {
    double wall, processor; /* when the part that is measured began */
    unsigned count;
    struct {
        const char *name;
        double wall, processor, memory;
    } parts[RIVAL_PARTS];
} rival;

static inline double rival_clock(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Bytes that this program has had at most; 0 where the system does not tell. rusage would count what
 * the process was before it began this program, too. */
static inline double rival_peak(void)
{
    char line[128];
    double kibibytes = 0;
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status))
        if (!strncmp(line, "VmHWM:", 6))
            kibibytes = strtod(line + 6, NULL);
    if (status)
        fclose(status);
    return 1024 * kibibytes;
}

/* A part begins. */
static inline void rival_begin(rival *r)
{
    r->wall = rival_clock(CLOCK_MONOTONIC);
    r->processor = rival_clock(CLOCK_PROCESS_CPUTIME_ID);
}

/* It has ended. At most RIVAL_PARTS. */
static inline void rival_end(rival *r, const char *name)
{
    r->parts[r->count].name = name;
    r->parts[r->count].wall = rival_clock(CLOCK_MONOTONIC) - r->wall;
    r->parts[r->count].processor = rival_clock(CLOCK_PROCESS_CPUTIME_ID) - r->processor;
    r->parts[r->count++].memory = rival_peak();
}

/* Prints everything; `counted` is a number by the name `what`. */
static inline void rival_print(const rival *r, const char *what, uint64_t counted)
{
    printf("{\"%s\":%llu,\"parts\":{", what, (unsigned long long)counted);
    for (unsigned i = 0; i < r->count; i++)
        printf("%s\"%s\":{\"wall\":%.9f,\"cpu\":%.9f,\"memory\":%.0f}", i ? "," : "",
               r->parts[i].name, r->parts[i].wall, r->parts[i].processor, r->parts[i].memory);
    printf("}}\n");
}

/* Ends the program: a benchmark that cannot be run is an error, not a slow one. */
_Noreturn static inline void rival_fail(const char *what)
{
    perror(what);
    exit(1);
}

/* A whole number of a command line, or a usage error. */
static inline uint64_t rival_number(const char *word, uint64_t most)
{
    char *end;
    unsigned long long n = strtoull(word, &end, 10);
    if (*word < '0' || *word > '9' || *end || n > most) {
        fprintf(stderr, "a number up to %llu, not '%s'\n", (unsigned long long)most, word);
        exit(2);
    }
    return n;
}

/* Memory for `count` items that nothing has touched; never NULL. */
static inline void *rival_array(size_t count, size_t size)
{
    void *p = calloc(count ? count : 1, size);
    if (!p)
        rival_fail("memory");
    return p;
}

#endif

/* cycles.c - ten thousand graphs compiled, run and freed in one process: memory, file descriptors
 * and mappings stay as they are after the first thousand; and two threads that do so side by
 * side. */
#include <dirent.h>
#include <pthread.h>
#include <stdlib.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

/* A sanitizer keeps what was freed, and takes its time: there it finds leaks itself. */
#if defined(__SANITIZE_ADDRESS__)
enum { CYCLES = 300, SANITIZED = 1 };
#elif defined(__has_feature)
enum { CYCLES = __has_feature(address_sanitizer) ? 300 : 10000,
       SANITIZED = __has_feature(address_sanitizer) };
#else
enum { CYCLES = 10000, SANITIZED = 0 };
#endif
enum { WARM = CYCLES / 10, THREADS = 2, OF_THREAD = CYCLES / 20 };

/* What the pools of malloc may differ by, in KiB. */
enum { RSS_SLACK = 1024 };

static const char graph[] = "graph box {\n"
                            "    param height: length = 2m\n"
                            "    rectangle(width = 2m, height = 3m) -> extrude(amount = height)\n"
                            "}\n";
static const char wrong[] = "graph box { rectangle(widht = 2m) -> nowhere }\n";

typedef struct usage {
    long resident; /* KiB */
    int files, mappings;
} usage;

static int count_entries(const char *folder)
{
    DIR *d = opendir(folder);
    int count = 0;
    while (d && readdir(d))
        count++;
    if (d)
        closedir(d);
    return count;
}

static usage use(void)
{
    usage u = {.files = count_entries("/proc/self/fd")};
    char line[1024];
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status))
        sscanf(line, "VmRSS: %ld", &u.resident);
    if (status)
        fclose(status);
    FILE *maps = fopen("/proc/self/maps", "r");
    while (maps && fgets(line, sizeof line, maps))
        u.mappings++;
    if (maps)
        fclose(maps);
    return u;
}

/* Whether a compilation and a run went as they should. */
static bool cycle(int i)
{
    if (i % 8 == 7) /* mistakes are freed, too */
        return !pcg_compile_text(wrong, sizeof wrong - 1, "box.pcg", NULL);
    pcg_mesh_view v = {.size = sizeof v};
    pcg_program *p = pcg_compile_text(graph, sizeof graph - 1, "box.pcg", NULL);
    pcg_run *r = pcg_run_new(p, NULL);
    bool good = r && pcg_run_set_float(r, "height", 1 + i % 7) == PCG_STATUS_OK &&
                pcg_run_execute(r) == PCG_STATUS_OK &&
                pcg_run_output_mesh(r, 0, &v) == PCG_STATUS_OK && v.face_count == 6;
    pcg_run_free(r);
    pcg_program_free(p);
    return good;
}

static int failures_of(int from, int to)
{
    int failures = 0;
    for (int i = from; i < to; i++)
        failures += !cycle(i);
    return failures;
}

static void stays_flat(void)
{
    CHECK_INTEGER(failures_of(0, WARM), 0);
    const usage before = use();
    CHECK_INTEGER(failures_of(WARM, CYCLES), 0);
    const usage after = use();
    CHECK(before.resident > 0 && before.mappings > 0);
    CHECK_INTEGER(after.files, before.files);
    if (!SANITIZED) {
        CHECK_INTEGER(after.mappings, before.mappings);
        CHECK(after.resident <= before.resident + RSS_SLACK);
    }
    printf("%d cycles: %ld KiB after %d of them, %ld KiB at the end; %d mappings\n", CYCLES,
           before.resident, WARM, after.resident, after.mappings);
}

static void *work(void *context)
{
    *(int *)context = failures_of(0, OF_THREAD);
    return NULL;
}

static void threads_side_by_side(void)
{
    pthread_t threads[THREADS];
    int failures[THREADS];
    for (int i = 0; i < THREADS; i++)
        pthread_create(&threads[i], NULL, work, &failures[i]);
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK_INTEGER(failures[i], 0);
    }
}

int main(void)
{
    stays_flat();
    threads_side_by_side();
    return unit_done();
}

/* native.c - code that is made in memory: never writable while it runs, gone with its program. */
#include <pthread.h>
#include <stdlib.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

enum { THREADS = 4, REPEATS = 5 };

static const char graph[] = "graph box {\n"
                            "    param height: length = 2m\n"
                            "    rectangle(width = 2m, height = 3m) -> extrude(amount = height)\n"
                            "}\n";

static pcg_program *compile(void)
{
    return pcg_compile_text(graph, sizeof graph - 1, "box.pcg", NULL);
}

/* How many mappings of this process have those permissions, such as "r-xp", and no file. */
static int mappings(const char *permissions)
{
    FILE *maps = fopen("/proc/self/maps", "r");
    char line[1024];
    int count = 0;
    while (maps && fgets(line, sizeof line, maps)) {
        char found[8];
        long inode = -1;
        if (sscanf(line, "%*s %7s %*s %*s %ld", found, &inode) == 2)
            count += inode == 0 && strcmp(found, permissions) == 0 && !strstr(line, "[v");
    }
    if (maps)
        fclose(maps);
    return count;
}

static void test_mappings(void)
{
    int writable = mappings("rwxp"), executable = mappings("r-xp");
    pcg_program *p = compile();
    CHECK(p != NULL);
    CHECK_INTEGER(mappings("rwxp"), writable);
    CHECK_INTEGER(mappings("r-xp"), executable + 1);
    pcg_program_free(p);
    CHECK_INTEGER(mappings("r-xp"), executable);
}

static size_t faces(void)
{
    pcg_program *p = compile();
    pcg_run *r = p ? pcg_run_new(p, NULL) : NULL;
    size_t count = r && pcg_run_execute(r) == PCG_STATUS_OK ? pcg_run_face_count(r) : 0;
    pcg_run_free(r);
    pcg_program_free(p);
    return count;
}

static void *work(void *context)
{
    int *wrong = context;
    for (int i = 0; i < REPEATS; i++)
        *wrong += faces() != 6;
    return NULL;
}

/* libtcc is one for the process: compilations in several threads take turns. */
static void test_threads(void)
{
    pthread_t threads[THREADS];
    int wrong[THREADS] = {0};
    for (int i = 0; i < THREADS; i++)
        CHECK(pthread_create(&threads[i], NULL, work, &wrong[i]) == 0);
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK_INTEGER(wrong[i], 0);
    }
}

int main(void)
{
    test_mappings();
    test_threads();
    return unit_done();
}

/* threads.c - runs of one program side by side: each gives what it gives alone. */
#include <pthread.h>

#include "tests/unit/unit.h"
#include "toy.h"

enum { THREADS = 4, REPEATS = 20, COUNT = 3000 };

typedef struct worker {
    const pcg_program *program;
    uint64_t seed, sum;
    int failures;
} worker;

static uint64_t hash_results(pcg_run *r)
{
    uint64_t sum = 0;
    for (size_t output = 0; output < 3; output++)
        for (size_t i = 0; i < pcg_run_output_count(r, output); i++)
            for (const char *s = pcg_run_attribute(r, output, i, "label"); *s; s++)
                sum = pcg_mix(sum, (pcg_u64)(unsigned char)*s);
    return sum + pcg_run_face_count(r);
}

static void *work(void *context)
{
    worker *w = context;
    for (int i = 0; i < REPEATS; i++) {
        const pcg_run_options options = {.size = sizeof options, .seed = w->seed};
        pcg_run *r = pcg_run_new(w->program, &options);
        w->failures += pcg_run_set_int(r, "count", COUNT) != PCG_STATUS_OK;
        w->failures += pcg_run_execute(r) != PCG_STATUS_OK;
        uint64_t sum = hash_results(r);
        w->failures += i > 0 && sum != w->sum;
        w->sum = sum;
        pcg_run_free(r);
    }
    return NULL;
}

int main(void)
{
    pcg_program *p = pcg_program_of(&toy_module);
    pthread_t threads[THREADS];
    worker workers[THREADS], alone = {.program = p};
    work(&alone);
    for (int i = 0; i < THREADS; i++) {
        workers[i] = (worker){.program = p};
        pthread_create(&threads[i], NULL, work, &workers[i]);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK_NUMBER(workers[i].failures, 0);
        CHECK_NUMBER(workers[i].sum, alone.sum);
    }
    CHECK_NUMBER(alone.failures, 0);
    pcg_program_free(p);
    return unit_done();
}

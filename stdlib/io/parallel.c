/* parallel.c - work that is done by several threads at a time.
 *
 * Items are handed out in order, one after the other; which thread takes one is chance. So an
 * item must depend on nothing but its number, and write nothing that another one reads or writes.
 */
#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#include "stdlib/io/io.h"

typedef struct shared {
    io_job *job;
    io_work *work;
    void *context;
    uint32_t count;
    atomic_uint next;
} shared;

typedef struct worker {
    shared *all;
    uint32_t number;
    pthread_t thread;
} worker;

static void *take_items(void *context)
{
    worker *w = context;
    shared *s = w->all;
    while (!result_cancelled(s->job->run)) {
        uint32_t item = atomic_fetch_add_explicit(&s->next, 1, memory_order_relaxed);
        if (item >= s->count)
            break;
        s->work(s->context, w->number, item);
    }
    return NULL;
}

uint32_t io_threads(const io_job *j)
{
    long processors = j->options.threads ? 0 : sysconf(_SC_NPROCESSORS_ONLN);
    uint64_t wanted = j->options.threads ? j->options.threads
                      : processors > 0   ? (uint64_t)processors
                                         : 1;
    return wanted < IO_THREADS_MAX ? (uint32_t)wanted : IO_THREADS_MAX;
}

/* The caller is one of the threads. Where another cannot be had, the rest do its work. */
void io_parallel(io_job *j, uint32_t count, io_work *work, void *context)
{
    worker workers[IO_THREADS_MAX];
    shared all = {.job = j, .work = work, .context = context, .count = count};
    uint32_t wanted = io_threads(j), begun = 1;
    atomic_init(&all.next, 0);
    if (wanted > count)
        wanted = count ? count : 1;
    workers[0] = (worker){.all = &all};
    for (uint32_t i = 1; i < wanted; i++) {
        workers[begun] = (worker){.all = &all, .number = begun};
        if (pthread_create(&workers[begun].thread, NULL, take_items, &workers[begun]) == 0)
            begun++;
    }
    take_items(&workers[0]);
    for (uint32_t i = 1; i < begun; i++)
        pthread_join(workers[i].thread, NULL);
}

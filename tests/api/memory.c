/* memory.c - memory that runs out at every place: an error each time, never a crash, and the same
 * result once there is enough. */
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/unit/unit.h"
#include "trouble.h"

enum { AMOUNT = 40, STEP = 512, ENOUGH = 1 << 20 };

static pcg_program *program;

/* Every result can be asked for, or memory has run out while it was made. */
static int results_are_there(pcg_run *r)
{
    pcg_mesh_view view = {.size = sizeof view};
    int good = 1;
    for (size_t i = 0; i < pcg_run_output_count(r, 0); i++) {
        pcg_status status = pcg_run_mesh(r, 0, i, &view);
        good = good && (status == PCG_STATUS_OK || status == PCG_STATUS_LIMIT);
        good = good && pcg_run_attribute(r, 0, i, "number") != NULL;
    }
    pcg_status whole = pcg_run_output_mesh(r, 0, &view);
    good = good && (whole == PCG_STATUS_OK || whole == PCG_STATUS_LIMIT);
    return good;
}

/* The status of a run with so much memory. */
static pcg_status run_with(size_t memory)
{
    const pcg_run_options options = {.size = sizeof options, .max_memory = memory};
    pcg_run *r = pcg_run_new(program, &options);
    pcg_status set = pcg_run_set_int(r, "mode", TROUBLE_ALL);
    if (set == PCG_STATUS_OK)
        set = pcg_run_set_int(r, "amount", AMOUNT);
    pcg_status status = pcg_run_execute(r);
    if (status == PCG_STATUS_OK) {
        CHECK(set == PCG_STATUS_OK && pcg_run_output_count(r, 0) == AMOUNT + AMOUNT / 2);
    } else {
        CHECK_NUMBER(status, PCG_STATUS_LIMIT);
        CHECK_PART(pcg_run_error(r), "the run needs more memory than its limit of ");
        CHECK_NUMBER(pcg_run_output_count(r, 0), 0);
    }
    CHECK(results_are_there(r));
    pcg_run_free(r);
    return status;
}

/* A sanitizer takes more of the address space than can be spared here, and does not return from
 * malloc without. */
#if defined(__SANITIZE_ADDRESS__)
enum { SYSTEM_CAN_RUN_OUT = 0 };
#elif defined(__has_feature)
enum { SYSTEM_CAN_RUN_OUT = !__has_feature(address_sanitizer) };
#else
enum { SYSTEM_CAN_RUN_OUT = 1 };
#endif

/* The limit is far, the system gives no more. In a process of its own, since it stays so. */
static void system_runs_out(void)
{
    int status = 0;
    pid_t child = SYSTEM_CAN_RUN_OUT ? fork() : -1;
    if (child == 0) {
        const struct rlimit little = {256 << 20, 256 << 20};
        setrlimit(RLIMIT_AS, &little);
        pcg_run *r = trouble_new(program, NULL, TROUBLE_MEMORY, 0);
        int good = pcg_run_execute(r) == PCG_STATUS_LIMIT &&
                   strstr(pcg_run_error(r), "the system has no more memory");
        pcg_run_free(r);
        _exit(good ? 0 : 1);
    }
    if (child > 0)
        waitpid(child, &status, 0);
    CHECK(child == -1 || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

int main(void)
{
    program = pcg_program_of(&trouble_module);
    size_t first = 0;
    for (size_t memory = 1; memory < ENOUGH && !first; memory += STEP)
        if (run_with(memory) == PCG_STATUS_OK)
            first = memory;
    CHECK(first > 1000);
    /* More is never worse. */
    for (size_t memory = first; memory < 2 * first; memory += STEP)
        CHECK_NUMBER(run_with(memory), PCG_STATUS_OK);
    system_runs_out();
    pcg_program_free(program);
    return unit_done();
}

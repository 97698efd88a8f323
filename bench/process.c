/* process.c - what a process takes from its start to its end: runs a command with its output
 * thrown away.
 *
 *     process COMMAND [ARGUMENT…]
 */
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rival.h"

extern char **environ;

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

int main(int argc, char **argv)
{
    posix_spawn_file_actions_t actions;
    struct rusage used;
    pid_t child;
    int state;
    if (argc < 2) {
        fputs("usage: process COMMAND [ARGUMENT…]\n", stderr);
        return 2;
    }
    rival r = {.count = 1, .parts = {{.name = "process"}}};
    if (posix_spawn_file_actions_init(&actions) != 0 ||
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0) != 0)
        rival_fail("memory");
    rival_begin(&r);
    if (posix_spawn(&child, argv[1], &actions, NULL, argv + 1, environ) != 0)
        rival_fail(argv[1]);
    if (wait4(child, &state, 0, &used) != child || !WIFEXITED(state) || WEXITSTATUS(state) != 0)
        rival_fail(argv[1]);
    r.parts[0].wall = rival_clock(CLOCK_MONOTONIC) - r.wall;
    r.parts[0].processor = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    r.parts[0].memory = 1024.0 * (double)used.ru_maxrss;
    posix_spawn_file_actions_destroy(&actions);
    rival_print(&r, "exit", (uint64_t)WEXITSTATUS(state));
    return 0;
}

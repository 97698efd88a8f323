/* executable.c - the command line of an executable: exit codes, and what stands on which stream. */
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/unit/unit.h"
#include "toy.h"
#include "trouble.h"

enum { MOST = 20000 };

static char out[MOST], err[MOST];

static void read_file(const char *path, char *to)
{
    FILE *f = fopen(path, "r");
    size_t length = f ? fread(to, 1, MOST - 1, f) : 0;
    to[length] = '\0';
    if (f)
        fclose(f);
}

static pid_t begin(const pcg_module *m, char **arguments)
{
    pid_t child;
    int count = 0;
    fflush(stdout);
    while (arguments[count])
        count++;
    child = fork();
    if (child)
        return child;
    if (!freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr))
        _exit(99);
    int code = pcg_main(m, count, arguments);
    fflush(stdout);
    fflush(stderr);
    _exit(code);
}

static int end(pid_t child)
{
    int status = 0;
    waitpid(child, &status, 0);
    read_file("out.txt", out);
    read_file("err.txt", err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

#define RUN(module, ...) end(begin(&(module), (char *[]){"folder/toy", __VA_ARGS__, NULL}))

static void says_what_it_is(void)
{
    CHECK_NUMBER(RUN(toy_module, "--help"), 0);
    CHECK_PART(out, "Usage: toy [OPTION]...\nA toy.\nFor tests.\n");
    CHECK_PART(out, "  height: length = 2m\n");
    CHECK_PART(out, "  count: int = 4   How many.\n");
    CHECK_PART(out, "  even: Shape   The even ones.\n");
    CHECK_PART(out, "  -p, --parameter NAME=VALUE    set a parameter: -p height=12m\n");
    CHECK_PART(out, "      --max-rounds N ");
    CHECK_TEXT(err, "");
    CHECK_NUMBER(RUN(toy_module, "--version"), 0);
    CHECK_TEXT(out, "toy, made by pcgc 0\n");
}

static void refuses_wrong_usage(void)
{
    CHECK_NUMBER(RUN(toy_module, "--sed", "1"), 2);
    CHECK_TEXT(
        err, "toy: unknown option '--sed', did you mean '--seed'?\ntoy --help lists the options\n");
    CHECK_NUMBER(RUN(toy_module, "-x"), 2);
    CHECK_NUMBER(RUN(toy_module, "house.pcg"), 2);
    CHECK_PART(err, "'house.pcg' is no option");
    CHECK_NUMBER(RUN(toy_module, "--seed"), 2);
    CHECK_PART(err, "option '--seed' needs a value: N");
    CHECK_NUMBER(RUN(toy_module, "--seed", "-1"), 2);
    CHECK_PART(err, "option '--seed' takes N, not '-1'");
    CHECK_NUMBER(RUN(toy_module, "--json=1"), 2);
    CHECK_NUMBER(RUN(toy_module, "--max-memory", "12Q"), 2);
    CHECK_NUMBER(RUN(toy_module, "--max-seconds", "soon"), 2);
    CHECK_NUMBER(RUN(toy_module, "--size", "0x5"), 2);
    CHECK_NUMBER(RUN(toy_module, "-p", "height"), 2);
    CHECK_NUMBER(RUN(toy_module, "-p", "height=99m"), 2);
    CHECK_PART(err, "toy: parameter 'height' must be from 1m to 10m, not 99m\n");
    CHECK_TEXT(out, "");
    CHECK_NUMBER(RUN(toy_module, "-o", "absent/toy.obj"), 2);
    CHECK_NUMBER(RUN(toy_module, "-o", "toy.doc"), 2);
}

static void runs_and_writes(void)
{
    CHECK_NUMBER(RUN(toy_module, "-pcount=6", "--seed=3"), 0);
    CHECK_PART(err, "toy: 9 faces, 36 vertices; write them with -o toy.glb");
    CHECK_TEXT(out, "");
    CHECK_NUMBER(RUN(toy_module, "--quiet", "-p", "count=6", "-o", "one.obj", "--output=two.json"),
                 0);
    CHECK(access("one.obj", R_OK) == 0 && access("two.json", R_OK) == 0);
    CHECK_PART(err, "warning: 'lonely' received nothing");
    CHECK_NUMBER(RUN(toy_module, "--json"), 0);
    CHECK_PART(out, "\"graph\"");
}

static void tells_how_it_ended(void)
{
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=7"), 3);
    CHECK_TEXT(err, "trouble.pcg:3:5: error: a roof of 1.2 m cannot be built (node 'maker', round "
                    "1) [E0701]\n");
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=6", "-p", "amount=1", "--strict"), 3);
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=1", "--max-rounds", "10"), 4);
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=3", "--max-entities", "10"), 4);
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=4", "--max-memory", "2M"), 4);
    CHECK_PART(err, "limit of 2 MiB");
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=5", "--max-depth", "10"), 4);
    CHECK_NUMBER(RUN(trouble_module, "-p", "mode=2", "--max-seconds", "50ms"), 4);
    CHECK_NUMBER(RUN(trouble_module, "--max-memory", "1"), 4);
}

static void is_interrupted(int which)
{
    pid_t child =
        begin(&trouble_module, (char *[]){"trouble", "-p", "mode=1", "-o", "never.json", NULL});
    usleep(300000);
    kill(child, which);
    CHECK_NUMBER(end(child), 130);
    CHECK_TEXT(err, "trouble: interrupted\n");
    CHECK(access("never.json", F_OK) != 0);
}

int main(void)
{
    says_what_it_is();
    refuses_wrong_usage();
    runs_and_writes();
    tells_how_it_ended();
    is_interrupted(SIGINT);
    is_interrupted(SIGTERM);
    return unit_done();
}

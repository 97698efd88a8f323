/* command_run.h - what `run` and `watch` share: compiling and running a file once. */
#ifndef PCG_COMMAND_RUN_H
#define PCG_COMMAND_RUN_H

#include "tool.h"

/* What a run came to, for one line. */
typedef struct run_outcome {
    size_t entities, faces; /* faces: where they are asked for, since counting takes time */
    uint64_t rounds, sent; /* entities that left a port, each time that they did */
    uint32_t errors, warnings;
    bool executed;
} run_outcome;

struct running;

/* What watches a run: the program is emitted in the observed form. */
typedef struct seeing {
    const command *command;   /* whose messages these are */
    pcg_observer *observer;
    void *user;
    /* Before the program is compiled, and once it has run, however it went; each returns an exit
     * code, the one that it was given or a worse one. */
    int (*begin)(void *user, struct running *k);
    /* The run begins, and has come to its end, before anything of it is given back; may be NULL. */
    void (*started)(void *user, pcg_run *r);
    void (*done)(void *user, pcg_run *r, pcg_status status);
    int (*end)(void *user, struct running *k, int code);
} seeing;

/* The options, and one use of them: run_file wants a copy each time. */
typedef struct running {
    tool t;
    option_texts parameters, outputs;
    const char *format, *node, *size;
    uint64_t seed, max_rounds, max_entities, max_depth, threads;
    size_t max_memory, max_cache;
    double max_seconds;
    bool json, entities, strict, no_cache;
    const char *path;
    bool project; /* no file was named: the folder's graph */
    bool watched; /* the summary is the watcher's */
    pcg_write_options write;
    run_outcome outcome;
    /* Called with each file and folder before it is read; may be NULL. */
    void (*found)(void *user, const char *path);
    void *user;
    const struct seeing *seeing; /* what watches the run; NULL */
    const command *command;      /* whose messages these are; NULL: run's, or the watcher's */
    /* Called once all is done, while `t.times` and `outcome` are complete; may be NULL. */
    void (*measured)(void *user, const struct running *k);
    void *measured_user;
    program *program;            /* what it was compiled from; NULL: it was loaded */
} running;

/* Reads the command line; *path is the file that is meant. -1 to go on, or an exit code. Texts are the
 * arena's. */
int run_options(const command *self, arena *a, running *k, int argc, char **argv, const char **path);
/* The rows of a command that runs a graph to see how. */
#define SEEING_OPTIONS(k)                                                                          \
    {'p', "parameter", OPTION_TEXTS, &(k)->parameters, "NAME=VALUE",                               \
     "set a parameter: -p height=12m"},                                                            \
        {'s', "seed", OPTION_COUNT, &(k)->seed, "N", "the seed of all chance; 0 when not given"},  \
        {'n', "node", OPTION_TEXT, &(k)->node, "NAME", "stop at this node"},                       \
        {0, "strict", OPTION_FLAG, &(k)->strict, NULL, "a bad entity stops the run"},              \
        {0, "max-rounds", OPTION_COUNT, &(k)->max_rounds, "N", "stop after so many rounds"},       \
        {0, "max-entities", OPTION_COUNT, &(k)->max_entities, "N",                                 \
         "entities that may be alive at one time"},                                                \
        {0, "max-depth", OPTION_COUNT, &(k)->max_depth, "N",                                       \
         "how deep graphs may be encapsulated"},                                                   \
        {0, "max-memory", OPTION_BYTES, &(k)->max_memory, "BYTES", "of the run: 512M, 2G"},        \
        {0, "max-seconds", OPTION_SECONDS, &(k)->max_seconds, "TIME",                              \
         "of the run: 30, 500ms, 2min"},                                                           \
    TOOL_OPTIONS(&(k)->t)

/* Runs the one file of such a command, watched. Returns the exit code. */
int run_seen(running *k, const seeing *s, const option_texts *files);
/* Compiles and runs it, and writes what was asked for. Returns the exit code. */
int run_file(running *k, const char *path);

#endif

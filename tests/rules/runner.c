/* runner.c - compiles and runs programs, one behind the other, and says what became of each.
 *
 * Reads records from standard input: the length of a program in bytes, a line end, the program. Its
 * main graph is called `main` and has the attributes trail, steps and number. Writes a line of JSON
 * for each: {"order": what --dump=order prints, "log": what its log nodes said, "left": the warnings of
 * what was left waiting, "results": {port: [[trail, steps, number], …]}}, or {"error": …}. */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compiler.h"
#include "runtime/pcg.h"

enum { MOST_ROUNDS = 4000, MOST_BYTES = 1 << 20, MOST_MEMORY = 64 << 20 };

/* ---- JSON ------------------------------------------------------------------------------------ */

static void put_string(const char *s)
{
    putchar('"');
    for (; *s; s++) {
        unsigned char c = (unsigned char)*s;
        if (c == '"' || c == '\\' || c < ' ')
            printf("\\u%04x", c);
        else
            putchar(c);
    }
    putchar('"');
}

static void put_attributes(pcg_run *r, size_t output, size_t entity)
{
    static const char *const numbers[] = {"steps", "number"};
    putchar('[');
    put_string(pcg_run_attribute(r, output, entity, "trail"));
    for (size_t i = 0; i < 2; i++) {
        double number = 0;
        pcg_run_attribute_float(r, output, entity, numbers[i], &number);
        printf(", %.0f", number);
    }
    putchar(']');
}

static void put_results(const pcg_program *p, pcg_run *r)
{
    putchar('{');
    for (size_t i = 0; i < pcg_program_output_count(p); i++) {
        pcg_gate gate;
        pcg_program_output(p, i, &gate);
        printf("%s", i ? ", " : "");
        put_string(gate.name);
        printf(": [");
        for (size_t k = 0; k < pcg_run_output_count(r, i); k++) {
            printf("%s", k ? ", " : "");
            put_attributes(r, i, k);
        }
        putchar(']');
    }
    putchar('}');
}

/* ---- one program ----------------------------------------------------------------------------- */

typedef struct notes {
    size_t count;
} notes;

/* Prints what `log` says as it comes: the line of JSON is begun by then. */
static void take_message(void *user, const pcg_message *m)
{
    notes *n = user;
    if (m->severity != PCG_NOTE || !m->node)
        return;
    printf("%s", n->count++ ? ", " : "");
    put_string(m->text);
}

/* What was left waiting: the messages that say so. */
static void put_left(const pcg_run *r)
{
    size_t count = 0;
    printf(", \"left\": [");
    for (size_t i = 0; i < pcg_run_message_count(r); i++) {
        const pcg_message *m = pcg_run_message(r, i);
        if (strcmp(m->code, "W0702") != 0)
            continue;
        printf("%s", count++ ? ", " : "");
        put_string(m->text);
    }
    putchar(']');
}

static void run_program(const pcg_program *p)
{
    notes n = {0};
    pcg_run_options options = {
        .size = sizeof options, .max_rounds = MOST_ROUNDS, .max_memory = MOST_MEMORY,
        .message = take_message, .user = &n};
    pcg_run *r = pcg_run_new(p, &options);
    printf(", \"log\": [");
    pcg_status status = r ? pcg_run_execute(r) : PCG_STATUS_FAILED;
    putchar(']');
    if (status == PCG_STATUS_OK) {
        put_left(r);
        printf(", \"results\": ");
        put_results(p, r);
    } else {
        printf(", \"error\": ");
        put_string(r ? pcg_run_error(r) : "out of memory");
    }
    pcg_run_free(r);
}

/* The order, by the passes; false, and the first error, where the program has one. */
static bool put_order(const char *program_text, size_t length)
{
    compilation c = {0};
    jmp_buf out_of_memory;
    volatile bool good = false;
    c.arena.on_failure = &out_of_memory;
    c.diagnostics.arena = &c.arena;
    c.graph = "main";
    if (!setjmp(out_of_memory)) {
        const source *s = source_new(&c.arena, "main.pcg", program_text, length);
        program *p = compile_front(&c, s);
        text out = {.arena = &c.arena};
        good = p && !c.diagnostics.errors;
        if (good)
            dump_order(p, &out);
        else
            text_format(&out, "%s", c.diagnostics.list.at[0].message);
        printf("\"%s\": ", good ? "order" : "error");
        put_string(out.at);
    }
    arena_free(&c.arena);
    return good;
}

static void put_program(const char *program_text, size_t length)
{
    const pcg_compile_options options = {.size = sizeof options, .graph = "main"};
    putchar('{');
    if (put_order(program_text, length)) {
        pcg_program *p = pcg_compile_text(program_text, length, "main.pcg", &options);
        if (p)
            run_program(p);
        else
            printf(", \"error\": \"it does not compile\"");
        pcg_program_free(p);
    }
    puts("}");
}

int main(void)
{
    char *record = malloc(MOST_BYTES);
    size_t length;
    int status = record ? EXIT_SUCCESS : EXIT_FAILURE;
    while (record && scanf("%zu", &length) == 1) {
        if (length >= MOST_BYTES || getchar() != '\n' ||
            fread(record, 1, length, stdin) != length) {
            fprintf(stderr, "a record is cut off, or too long\n");
            status = EXIT_FAILURE;
            break;
        }
        record[length] = '\0';
        put_program(record, length);
        fflush(stdout);
    }
    free(record);
    return status;
}

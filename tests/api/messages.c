/* messages.c - messages with their source line, kept in order; those of the compilation come
 * first. */
#include "tests/unit/unit.h"
#include "runtime/program.h"
#include "runtime/result.h"
#include "trouble.h"

static void write_source(const char *content)
{
    FILE *f = fopen("trouble.pcg", "w");
    CHECK(f && fputs(content, f) >= 0 && fclose(f) == 0);
}

static pcg_run *run_of(const pcg_program *p, trouble_mode mode, int amount)
{
    pcg_run *r = trouble_new(p, NULL, mode, amount);
    pcg_run_execute(r);
    return r;
}

static void points_into_the_source(const pcg_program *p)
{
    write_source(
        "graph trouble {\n    out result: Entity = *\n    maker: make(mode = 7) -> result\n}\n");
    pcg_run *r = run_of(p, TROUBLE_FAIL, 0);
    CHECK_NUMBER(result_message_count(r), 1);
    const pcg_message *m = result_message(r, 0);
    CHECK_NUMBER(m->severity, PCG_ERROR);
    CHECK_TEXT(m->code, "E0701");
    CHECK_TEXT(m->text, "a roof of 1.2 m cannot be built");
    CHECK_TEXT(m->file, "trouble.pcg");
    CHECK_NUMBER(m->line, 3);
    CHECK_NUMBER(m->column, 5);
    CHECK_TEXT(m->node, "maker");
    CHECK_NUMBER(m->round, 1);
    CHECK_TEXT(
        m->rendered,
        "trouble.pcg:3:5: error: a roof of 1.2 m cannot be built (node 'maker', round 1) [E0701]\n"
        "    3 |     maker: make(mode = 7) -> result\n"
        "      |     ^~~~~\n");
    CHECK(result_message(r, 1) == NULL);
    pcg_run_free(r);
}

/* The file may have changed since the graph was compiled. */
static void does_without_the_line(const pcg_program *p)
{
    static const char *const sources[] = {"", "\n\n", "\n\n  ", "\xff\xff\n\n\xc3\xa9\xc3\xa9\xc3"};
    for (size_t i = 0; i < COUNT_OF(sources); i++) {
        write_source(sources[i]);
        pcg_run *r = run_of(p, TROUBLE_FAIL, 0);
        CHECK_TEXT(result_message(r, 0)->rendered, "trouble.pcg:3:5: error: a roof of 1.2 m cannot "
                                                   "be built (node 'maker', round 1) [E0701]\n");
        pcg_run_free(r);
    }
    remove("trouble.pcg");
}

static void notes_are_one_line(const pcg_program *p)
{
    pcg_run *r = run_of(p, TROUBLE_NOTE, 2);
    const pcg_message *m = result_message(r, 1);
    CHECK_NUMBER(m->severity, PCG_NOTE);
    CHECK_TEXT(m->code, "");
    CHECK_TEXT(m->text, "note 1 in two lines");
    CHECK_TEXT(m->rendered, "trouble.pcg:3:5: note: note 1 in two lines\n");
    pcg_run_free(r);
}

static void held_back_ones_are_counted(const pcg_program *p)
{
    pcg_run *r = run_of(p, TROUBLE_WARN, 23);
    CHECK_NUMBER(result_message_count(r), 22);
    CHECK_TEXT(result_message(r, 19)->text, "roof 19 of 2.50 m cannot be built");
    CHECK_TEXT(result_message(r, 20)->text, "3 more warnings of 'maker' are not shown");
    CHECK_TEXT(result_message(r, 21)->text,
               "'result' received nothing ('maker' ran 1 round and sent nothing)");
    pcg_run_free(r);
    r = run_of(p, TROUBLE_WARN, 21);
    CHECK_TEXT(result_message(r, 20)->text, "1 more warning of 'maker' is not shown");
    pcg_run_free(r);
}

static void those_of_the_compilation_come_first(void)
{
    pcg_program *p = pcg_program_of(&trouble_module);
    char line[] = "unused";
    const pcg_message m = {
        .severity = PCG_WARNING, .code = "W0504", .text = line, .rendered = "warning: unused\n"};
    CHECK(program_add_message(p, &m));
    line[0] = 'x';
    pcg_run *r = run_of(p, TROUBLE_NOTE, 1);
    CHECK_NUMBER(result_message_count(r), 3);
    CHECK_TEXT(result_message(r, 0)->text, "unused");
    CHECK_TEXT(result_message(r, 1)->text, "note 0 in two lines");
    result_warn(r, "texture '%s' cannot be read", "a.jpg");
    CHECK_TEXT(result_message(r, 3)->rendered, "warning: texture 'a.jpg' cannot be read [W0701]\n");
    CHECK_NUMBER(result_fail(r, PCG_STATUS_MISUSE, "no %s", "file"), PCG_STATUS_MISUSE);
    CHECK_TEXT(pcg_run_error(r), "no file");
    CHECK(result_ready(r) && !result_cancelled(r));
    pcg_run_free(r);
    pcg_program_free(p);
}

int main(void)
{
    pcg_program *p = pcg_program_of(&trouble_module);
    points_into_the_source(p);
    does_without_the_line(p);
    notes_are_one_line(p);
    held_back_ones_are_counted(p);
    those_of_the_compilation_come_first();
    pcg_program_free(p);
    return unit_done();
}

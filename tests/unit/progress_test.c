/* progress_test.c - the line of progress: what it says, how wide it gets, what names may do to
 * it. */
#include "runtime/progress.h"
#include "tests/unit/unit.h"

static const char *line_of(const char *what, uint64_t rounds, uint64_t entities, unsigned columns,
                           char *out)
{
    progress p = {.rounds = rounds, .entities = entities};
    snprintf(p.what, sizeof p.what, "%s", what);
    size_t length = progress_line(&p, 3.46, columns, out, PROGRESS_LINE);
    CHECK_NUMBER(length, strlen(out));
    return out;
}

static void says_what_is_done(void)
{
    char out[PROGRESS_LINE];
    CHECK_TEXT(line_of("writing a.glb", 0, 0, 80, out), "| 3.4 s  writing a.glb");
    CHECK_TEXT(line_of("split", 1234567, 89, 80, out),
               "| 3.4 s  split  1,234,567 rounds  89 entities");
    CHECK_TEXT(line_of("split", 1, 1, 80, out), "| 3.4 s  split  1 round  1 entity");
    CHECK_TEXT(line_of("split", 1000, 100, 80, out), "| 3.4 s  split  1,000 rounds  100 entities");
}

static void is_never_too_wide(void)
{
    char out[PROGRESS_LINE];
    CHECK_TEXT(line_of("split", 1234567, 89, 15, out), "| 3.4 s  split ");
    CHECK_TEXT(line_of("split", 1, 1, 1, out), "|");
    CHECK_TEXT(line_of("split", 1, 1, 0, out), "");
    CHECK_TEXT(line_of("\xC3\xA4\xC3\xB6\xC3\xBC", 0, 0, 11, out), "| 3.4 s  \xC3\xA4\xC3\xB6");
    CHECK_TEXT(line_of("\xE5\xAE\xB6\xE5\xAE\xB6", 0, 0, 12, out), "| 3.4 s  \xE5\xAE\xB6");
    char wide[PROGRESS_LINE];
    memset(wide, 'w', sizeof wide - 1);
    wide[sizeof wide - 1] = '\0';
    CHECK(strlen(line_of(wide, 1, 1, 100000, out)) < PROGRESS_LINE);
}

static void does_not_let_names_speak_to_the_terminal(void)
{
    char out[PROGRESS_LINE];
    CHECK_TEXT(line_of("a\x1b[2Jb\n\x7f", 0, 0, 80, out), "| 3.4 s  a?[2Jb??");
    CHECK_TEXT(line_of("a\xC2\x9B" "2J", 0, 0, 80, out), "| 3.4 s  a?2J");
    CHECK_TEXT(line_of("\xE5\xAE", 0, 0, 80, out), "| 3.4 s  ?");
    CHECK_TEXT(line_of("\x80z", 0, 0, 80, out), "| 3.4 s  ?z");
}

int main(void)
{
    says_what_is_done();
    is_never_too_wide();
    does_not_let_names_speak_to_the_terminal();
    return unit_done();
}

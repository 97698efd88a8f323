/* manual.c - the manual page pcgc(1), in roff, from the same tables as --help: `pcgc --manual`. */
#include <string.h>

#include "tool.h"

/* Of the page: there is none that is right for every build, and the same input gives the same
 * bytes. */
static const char date[] = "2026-11-22";

/* Text in roff: dashes stay dashes, nothing is a request. */
static void put_bytes(const char *s, size_t length)
{
    if (length && (*s == '.' || *s == '\''))
        fputs("\\&", stdout);
    for (size_t i = 0; i < length; i++) {
        if (s[i] == '\\')
            fputs("\\e", stdout);
        else if (s[i] == '-')
            fputs("\\-", stdout);
        else
            putchar(s[i]);
    }
}

static void put(const char *s)
{
    put_bytes(s, strlen(s));
}

static void put_synopsis(const command *c)
{
    fputs("\\fBpcgc", stdout);
    if (c->name) {
        putchar(' ');
        put(c->name);
    }
    fputs("\\fR ", stdout);
    put(c->arguments);
    puts(" [\\fIoptions\\fR]");
}

static void put_option(const option *o)
{
    puts(".TP");
    if (o->letter)
        printf("\\fB\\-%c\\fR, ", o->letter);
    fputs("\\fB\\-\\-", stdout);
    put(o->name);
    fputs("\\fR", stdout);
    if (o->kind != OPTION_FLAG) {
        fputs(o->kind == OPTION_DEFAULT ? "[=" : " ", stdout);
        fputs("\\fI", stdout);
        put(o->argument);
        fputs("\\fR", stdout);
        fputs(o->kind == OPTION_DEFAULT ? "]" : "", stdout);
    }
    putchar('\n');
    put(o->help);
    putchar('\n');
}

void manual_command(const command *c, const option *options)
{
    printf(".SS \"%s\"\n", c->name ? c->name : "compiling");
    put_synopsis(c);
    puts(".PP");
    put(c->summary);
    putchar('\n');
    for (const option *o = options; o->name; o++)
        put_option(o);
    puts(".PP\nExamples:\n.PP\n.nf\n.RS 4");
    for (const char *const *line = c->examples; line && *line; line++) {
        put(*line);
        putchar('\n');
    }
    puts(".RE\n.fi");
}

/* ---- the page -------------------------------------------------------------------------------- */

static void describe(const command *c)
{
    char *argv[] = {(char[]){TOOL_MANUAL}, NULL};
    c->run(c, 1, argv);
}

static void put_synopses(const command *const *commands)
{
    puts(".SH SYNOPSIS");
    put_synopsis(&command_compile);
    for (size_t i = 0; commands[i]; i++) {
        puts(".br");
        put_synopsis(commands[i]);
    }
    puts(".br\n\\fBpcgc\\fR \\-\\-help | \\-\\-version | help \\fICOMMAND\\fR");
}

static void put_exit_codes(void)
{
    static const struct {
        int code;
        const char *meaning;
    } codes[] = {
        {EXIT_DONE, "Done."},
        {EXIT_NO, "The answer is no: there are errors in the source."},
        {EXIT_USAGE, "Wrong usage, or a file that cannot be read or written."},
        {EXIT_RUN_FAILED, "The graph ran and failed."},
        {EXIT_LIMIT, "A limit was hit: rounds, entities, depth, memory or time."},
        {EXIT_BUG, "A mistake in pcgc itself; please report it."},
        {EXIT_INTERRUPTED, "Interrupted; nothing is half-written."},
    };
    puts(".SH EXIT STATUS");
    for (size_t i = 0; i < COUNT_OF(codes); i++)
        printf(".TP\n.B %d\n%s\n", codes[i].code, codes[i].meaning);
}

void manual_page(const command *const *commands)
{
    printf(".TH PCGC 1 \"%s\" \"pcgc %s\"\n", date, PCG_VERSION);
    puts(".SH NAME\npcgc \\- compile and run procedural content graphs");
    put_synopses(commands);
    puts(".SH DESCRIPTION\n"
         "A graph is a program that makes models: its nodes run procedures, and\n"
         "shapes travel along its edges.\n"
         "\\fBpcgc\\fR compiles graphs to C and runs them at once in memory, or makes\n"
         "a shared object, a C file or an executable of them.\n"
         ".PP\n"
         "Data goes to standard output, everything else to standard error; the file\n"
         "name \\fB\\-\\fR stands for standard input or output.\n"
         "Every command takes \\fB\\-h\\fR and \\fB\\-\\-help\\fR.\n"
         ".SH COMMANDS");
    describe(&command_compile);
    for (size_t i = 0; commands[i]; i++)
        describe(commands[i]);
    put_exit_codes();
    puts(".SH ENVIRONMENT\n.TP\n.B NO_COLOR\nWhere it is set, messages have no colour.\n"
         ".SH SEE ALSO\n"
         "The language and the tutorial are in the folder \\fIshare/doc/pcgc\\fR of\n"
         "the installation; \\fBpcgc doc\\fR explains every procedure.");
}

/* options.c - command lines: tables of options, read and explained. */
#include <stdlib.h>
#include <string.h>

#include "tool.h"

static int usage_error_list(const command *c, const char *format, va_list arguments)
{
    fprintf(stderr, "pcgc%s%s: ", c->name ? " " : "", c->name ? c->name : "");
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n  = help: pcgc%s%s --help\n", c->name ? " " : "", c->name ? c->name : "");
    return EXIT_USAGE;
}

int usage_error(const command *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int code = usage_error_list(c, format, arguments);
    va_end(arguments);
    return code;
}

int tool_error(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("pcgc: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return code;
}

/* ---- help ------------------------------------------------------------------------------------ */

static void print_option(const option *o)
{
    char left[64];
    const char *equals = o->kind == OPTION_FLAG ? "" : o->kind == OPTION_DEFAULT ? "[=" : " ";
    const char *close = o->kind == OPTION_DEFAULT ? "]" : "";
    const char *operand = o->kind == OPTION_FLAG ? "" : o->argument;
    if (o->letter)
        snprintf(left, sizeof left, "-%c, --%s%s%s%s", o->letter, o->name, equals, operand, close);
    else
        snprintf(left, sizeof left, "    --%s%s%s%s", o->name, equals, operand, close);
    printf("  %-32s %s\n", left, o->help);
}

static void print_help(const command *c, const option *options)
{
    printf("usage: pcgc%s%s %s [options]\n\n%s\n\n", c->name ? " " : "", c->name ? c->name : "",
           c->arguments, c->summary);
    for (const option *o = options; o->name; o++)
        print_option(o);
    printf("  %-32s %s\n", "-h, --help", "this text");
    for (const char *const *line = c->examples; line && *line; line++)
        printf("%s  %s\n", line == c->examples ? "\nexamples:\n" : "", *line);
}

/* ---- values ---------------------------------------------------------------------------------- */

static bool read_count(const char *s, uint64_t *to)
{
    if (*s < '0' || *s > '9')
        return false;
    char *end;
    *to = strtoull(s, &end, 10);
    return !*end;
}

static bool read_bytes(const char *s, size_t *to)
{
    if (*s < '0' || *s > '9')
        return false;
    char *end;
    unsigned long long n = strtoull(s, &end, 10);
    unsigned shift = 0;
    if (*end == 'k' || *end == 'K')
        shift = 10, end++;
    else if (*end == 'M')
        shift = 20, end++;
    else if (*end == 'G')
        shift = 30, end++;
    if (*end || n > (UINT64_MAX >> shift))
        return false;
    *to = (size_t)n << shift;
    return true;
}

static bool read_seconds(const char *s, double *to)
{
    static const struct {
        const char *unit;
        double factor;
    } units[] = {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"min", 60}, {"h", 3600}};
    if ((*s < '0' || *s > '9') && *s != '.')
        return false;
    char *end;
    double n = strtod(s, &end);
    for (size_t i = 0; i < COUNT_OF(units); i++) {
        if (!strcmp(end, units[i].unit)) {
            *to = n * units[i].factor;
            return true;
        }
    }
    return false;
}

static void add_text(arena *a, option_texts *list, const char *s)
{
    if ((list->count & (list->count - 1)) == 0) {
        const char **grown = ARENA_ARRAY(a, const char *, list->count ? 2 * list->count : 1);
        if (list->count)
            memcpy(grown, list->at, list->count * sizeof *grown);
        list->at = grown;
    }
    list->at[list->count++] = s;
}

static bool set_value(arena *a, const option *o, const char *word)
{
    switch (o->kind) {
    case OPTION_FLAG:
        *(bool *)o->to = true;
        return true;
    case OPTION_DEFAULT:
    case OPTION_TEXT:
        *(const char **)o->to = word;
        return true;
    case OPTION_TEXTS:
        add_text(a, o->to, word);
        return true;
    case OPTION_COUNT:
        return read_count(word, o->to);
    case OPTION_BYTES:
        return read_bytes(word, o->to);
    case OPTION_SECONDS:
        return read_seconds(word, o->to);
    }
    return false;
}

/* ---- reading --------------------------------------------------------------------------------- */

static const option *find_long(const option *options, const char *name, size_t length)
{
    for (const option *o = options; o->name; o++)
        if (strlen(o->name) == length && !memcmp(o->name, name, length))
            return o;
    return NULL;
}

static const option *find_letter(const option *options, char letter)
{
    for (const option *o = options; o->name; o++)
        if (o->letter == letter)
            return o;
    return NULL;
}

static int unknown_option(const command *c, const option *options, const char *word)
{
    const char *names[64];
    size_t count = 0;
    for (const option *o = options; o->name && count < COUNT_OF(names); o++)
        names[count++] = o->name;
    const char *near = word[1] == '-' ? nearest_name(word + 2, names, count) : NULL;
    if (near)
        return usage_error(c, "unknown option '%s', did you mean '--%s'?", word, near);
    return usage_error(c, "unknown option '%s'", word);
}

/* One option at argv[*i], which begins with a dash; moves *i on to its last word. */
static int read_option(arena *a, const command *c, const option *options, int argc, char **argv,
                       int *i)
{
    const char *word = argv[*i], *given = NULL;
    const option *o;
    if (word[1] == '-') {
        const char *equals = strchr(word, '=');
        size_t length = equals ? (size_t)(equals - word) - 2 : strlen(word) - 2;
        o = find_long(options, word + 2, length);
        given = equals ? equals + 1 : NULL;
    } else {
        o = find_letter(options, word[1]);
        given = word[2] ? word + 2 : NULL;
    }
    if (!o)
        return unknown_option(c, options, word);
    if (o->kind == OPTION_FLAG && given)
        return usage_error(c, "option '--%s' takes no value", o->name);
    if (o->kind == OPTION_DEFAULT && !given)
        given = o->argument;
    if (o->kind != OPTION_FLAG && !given) {
        if (*i + 1 >= argc)
            return usage_error(c, "option '%s' needs a value: %s", word, o->argument);
        given = argv[++*i];
    }
    if (!set_value(a, o, given))
        return usage_error(c, "option '--%s' takes %s, not '%s'", o->name, o->argument, given);
    return -1;
}

int options_read(arena *a, const command *c, const option *options, int argc, char **argv,
                 option_texts *files)
{
    bool only_files = false;
    if (argc > 0 && !strcmp(argv[0], TOOL_COMPLETE)) {
        complete_command(c, options, argc - 1, argv + 1);
        return EXIT_DONE;
    }
    if (argc > 0 && !strcmp(argv[0], TOOL_MANUAL)) {
        manual_command(c, options);
        return EXIT_DONE;
    }
    for (int i = 0; i < argc; i++) {
        const char *word = argv[i];
        if (only_files || word[0] != '-' || !word[1]) {
            add_text(a, files, word);
        } else if (!strcmp(word, "--")) {
            only_files = true;
        } else if (!strcmp(word, "--help") || !strcmp(word, "-h")) {
            print_help(c, options);
            return EXIT_DONE;
        } else {
            int code = read_option(a, c, options, argc, argv, &i);
            if (code >= 0)
                return code;
        }
    }
    return -1;
}

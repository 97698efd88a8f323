/* debug_command.c - the commands of the debugger: what there is, reading them, help. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#include "debug.h"

static void help(debugger *d, char *arguments);
static void quit(debugger *d, char *arguments);

/* ---- the table ------------------------------------------------------------------------------- */

const debug_command debug_commands[] = {
    {"break", "b", "PLACE [if EXPRESSION]", "stops where a node runs, or an entity takes an edge",
     "  break window              when the node 'window' is about to run a round\n"
     "  break tower/up            a node of the graph 'tower'\n"
     "  break 16                  the node that begins in line 16\n"
     "  break doors.pcg:4         a line of another file\n"
     "  break mass.rest -> tiles  when an entity is about to go along that edge\n"
     "  break window if @floor == 2 && area(in) > 3m2\n"
     "The expression is one of the language, as an argument of that node could be. On an edge\n"
     "it is asked of the entity that goes along it.\n",
     debug_break},
    {"watch", NULL, "@ATTRIBUTE", "stops when an entity leaves a node with another value of it",
     "  watch @floor\n"
     "An entity is compared with what it was when the round began, a new one with the first\n"
     "entity that the round took.\n",
     debug_watch},
    {"delete", NULL, "NUMBER|all", "removes a breakpoint, or a watch",
     "  delete 2\n  delete all\nThe numbers are those that 'info' lists.\n", debug_delete},
    {"step", "s", "", "goes on to the next round, in whatever graph",
     "A round of an encapsulated graph's node comes before its rounds inside.\n", debug_step},
    {"next", "n", "", "goes on until another node runs",
     "Further rounds of the same node are passed by.\n", debug_next},
    {"over", NULL, "", "goes on to the next round, not into encapsulated graphs",
     "Where an encapsulated graph is about to run, it runs as a whole. Breakpoints in it stop all\n"
     "the same.\n",
     debug_over},
    {"out", NULL, "", "goes on until the encapsulated graph is done",
     "Stops at the next round in the graph around it.\n", debug_out},
    {"continue", "c", "", "goes on to a breakpoint, or to the end",
     "Ctrl+C stops it at the next round.\n", debug_continue},
    {"back", NULL, "[COUNT]", "looks at the round before, or COUNT rounds before",
     "  back\n  back 5\n"
     "The run stays where it is: queues, entities and values are shown as they were. 'step'\n"
     "and its like go forward through what is recorded, then on with the run.\n",
     debug_back},
    {"goto", NULL, "ROUND", "looks at the round of that number, or goes on to it",
     "  goto 12\nRounds are numbered from 1, over all graphs.\n", debug_goto},
    {"queues", "q", "[all]", "shows what waits before each node, and what came out",
     "The innermost graph comes first. 'queues all' lists empty queues, too.\n", debug_queues},
    {"print", "p", "[#ENTITY|PORT|NODE|@ATTRIBUTE]", "shows entities with their attributes",
     "  print                     the entities that this round has taken\n"
     "  print in                  those from its port 'in'\n"
     "  print #12                 an entity that waits, or was taken\n"
     "  print roof                all that wait before the node 'roof'\n"
     "  print roof.wall           at one port of it\n"
     "  print @floor              an attribute of what this round has taken\n",
     debug_print},
    {"parameters", NULL, "", "shows what this round's parameters were evaluated to",
     "Lengths are in metres, areas in square metres, angles in degrees.\n", debug_parameters},
    {"list", "l", "[LINE]", "shows the source around this round's node, or a line",
     "Again, it shows what follows.\n", debug_list},
    {"where", NULL, "", "shows the round, and those of the graphs around it",
     "The outermost graph comes last.\n", debug_where},
    {"info", "i", "", "shows where it is, what is recorded, and all breakpoints", "", debug_info},
    {"help", "h", "[COMMAND]", "explains the commands, or one of them", "", help},
    {"quit", NULL, "", "ends the run, and the debugger",
     "Nothing is written of a run that was not over. The end of the commands means the same.\n",
     quit},
    {0}};

/* ---- answers --------------------------------------------------------------------------------- */

void debug_refuse(debugger *d, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const char *line = arena_format_list(&d->scratch, format, arguments);
    va_end(arguments);
    text_format(&d->out, "error: %s\n", line);
}

/* What was added to the answer goes out, and its memory with it. */
void debug_answer(debugger *d)
{
    if (d->out.length)
        fputs(d->out.at, stdout);
    fflush(stdout);
    arena_free(&d->scratch);
    d->scratch.on_failure = &d->out_of_memory;
    d->out = (text){.arena = &d->scratch};
}

/* ---- finding a command ----------------------------------------------------------------------- */

/* By its name, its letter, or a beginning that no other has. NULL: it was told why. */
static const debug_command *find(debugger *d, const char *word)
{
    const debug_command *found = NULL, *c;
    const char *names[64];
    size_t count = 0;
    unsigned fitting = 0;
    for (c = debug_commands; c->name; c++) {
        if (!strcmp(c->name, word) || (c->letter && !strcmp(c->letter, word)))
            return c;
        names[count++] = c->name;
        if (!strncmp(c->name, word, strlen(word))) {
            found = c;
            fitting++;
        }
    }
    if (fitting == 1)
        return found;
    const char *near = fitting ? NULL : nearest_name(word, names, count);
    if (fitting > 1)
        debug_refuse(d, "'%s' may be more than one command; 'help' lists them", word);
    else if (near)
        debug_refuse(d, "unknown command '%s', did you mean '%s'?", word, near);
    else
        debug_refuse(d, "unknown command '%s'; 'help' lists them", word);
    return NULL;
}

static void help(debugger *d, char *arguments)
{
    const char *word = debug_word(&arguments);
    const debug_command *c = word ? find(d, word) : NULL;
    if (c) {
        text_format(&d->out, "%s %s%s%s\n%s.\n%s", c->name, c->arguments,
                    c->letter ? "   short: " : "", c->letter ? c->letter : "", c->summary, c->help);
        return;
    }
    for (c = word ? NULL : debug_commands; c && c->name; c++)
        text_format(&d->out, "  %-10s %-3s%s\n", c->name, c->letter ? c->letter : "", c->summary);
    if (!word)
        text_add(&d->out, "help COMMAND says more. An unambiguous beginning of a name will do.\n");
}

static void quit(debugger *d, char *arguments)
{
    (void)arguments;
    d->quit = d->resume = true;
    if (!d->over)
        pcg_run_cancel(d->run);
}

/* ---- words ----------------------------------------------------------------------------------- */

/* A name in quotes is one word. */
char *debug_word(char **arguments)
{
    char *at = *arguments + strspn(*arguments, " \t\r\n");
    char *end = *at == '\'' ? strchr(at + 1, '\'') : NULL;
    *arguments = at;
    if (!*at)
        return NULL;
    if (end)
        at++;
    else
        end = at + strcspn(at, " \t\r\n");
    *arguments = end + (*end != '\0');
    *end = '\0';
    return at;
}

/* ---- reading --------------------------------------------------------------------------------- */

bool debug_open_input(debug_input *in)
{
    if (in->path && strcmp(in->path, "-") != 0 && !(in->file = fopen(in->path, "r"))) {
        tool_error(EXIT_USAGE, "cannot read '%s': %s", in->path, strerror(errno));
        return false;
    }
    bool standard = !in->path || !strcmp(in->path, "-");
    if (standard)
        in->file = stdin;
    in->terminal = standard && isatty(STDIN_FILENO);
    /* What -x says is all, unless someone is there to go on. */
    in->closed = !in->path && in->lines.count > 0 && !in->terminal;
    return true;
}

void debug_close_input(debug_input *in)
{
    if (in->file && in->file != stdin)
        fclose(in->file);
    in->file = NULL;
}

/* The next command of -x: they are separated by ';' outside of quotes. */
static const char *next_given(debugger *d)
{
    debug_input *in = &d->input;
    const char *from = in->lines.at[in->next], *at = from;
    for (bool quoted = false; *at && (quoted || (*at != ';' && *at != '\n')); at++)
        quoted ^= *at == '"';
    if (*at)
        in->lines.at[in->next] = at + 1;
    else
        in->next++;
    from += strspn(from, " \t");
    return arena_copy(&d->scratch, from, at > from ? (size_t)(at - from) : 0);
}

static const char *next_read(debugger *d)
{
    debug_input *in = &d->input;
    char *line = NULL;
    size_t room = 0;
    if (in->terminal)
        fputs("(pcgc) ", stdout);
    fflush(stdout);
    atomic_store(&d->idle, true);
    ssize_t length = getline(&line, &room, in->file);
    atomic_store(&d->idle, d->over);
    const char *copy =
        length < 0 ? NULL : arena_format(&d->scratch, "%.*s", (int)strcspn(line, "\r\n"), line);
    free(line);
    if (length < 0 && in->terminal)
        putchar('\n');
    return copy;
}

/* NULL: there are no more. What nobody has typed is shown as if someone had. */
static const char *next_command(debugger *d)
{
    debug_input *in = &d->input;
    bool given = in->next < in->lines.count;
    const char *line = given ? next_given(d) : in->closed ? NULL : next_read(d);
    if (line && (given || !in->terminal) && line[strspn(line, " \t")])
        printf("(pcgc) %s\n", line);
    return line;
}

/* ---- obeying --------------------------------------------------------------------------------- */

static bool moves(const debug_command *c)
{
    return c->run == debug_step || c->run == debug_next || c->run == debug_over ||
           c->run == debug_back || c->run == debug_out || c->run == debug_continue;
}

/* An empty line at the terminal moves once more. */
static void obey(debugger *d, const char *line)
{
    bool empty = !line[strspn(line, " \t")];
    if (empty && d->input.terminal && d->last)
        line = d->last;
    char *arguments = arena_copy(&d->scratch, line, strlen(line));
    d->line = line;
    d->words = arguments;
    char *word = debug_word(&arguments);
    if (!word || *word == '#')
        return;
    const debug_command *c = find(d, word);
    if (!c)
        return;
    if (moves(c) && line != d->last)
        d->last = arena_copy(&d->memory, line, strlen(line));
    c->run(d, arguments);
}

void debug_converse(debugger *d)
{
    d->resume = false;
    while (!d->resume) {
        debug_answer(d);
        const char *line = next_command(d);
        if (line)
            obey(d, line);
        else
            quit(d, NULL);
        if (d->resume && !d->quit && debug_replay(d))
            d->resume = false;
        if (d->resume && !d->quit && d->over) {
            debug_show_place(d, NULL);
            d->resume = false;
        }
    }
    debug_answer(d);
}

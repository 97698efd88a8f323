/* completion.c - what may stand where a command line is being written; the scripts by which bash
 * and zsh ask for it.
 *
 * The scripts call `pcgc --complete WORD…`, the last word being the one at the cursor. It prints a
 * candidate a line, with what it means behind a tab; or a line ":files", ":folders": whatever the
 * shell has of these. The shell leaves out what does not begin with the word. */
#include <stdlib.h>
#include <string.h>

#include "debug.h"

/* ---- candidates ------------------------------------------------------------------------------ */

static void candidate(const char *prefix, const char *word, size_t length, const char *meaning)
{
    printf("%s%.*s", prefix, (int)length, word);
    if (meaning && *meaning)
        printf("\t%.*s", (int)strcspn(meaning, "\n"), meaning);
    putchar('\n');
}

/* Each of some words. */
static void candidates(const char *prefix, const char *words, char between)
{
    const char between_them[] = {between, '\0'};
    while (*words) {
        size_t length = strcspn(words, between_them);
        candidate(prefix, words, length, NULL);
        words += length + (words[length] == between);
    }
}

/* ---- parameters of a graph ------------------------------------------------------------------- */

/* The graph that the command line names, compiled or loaded; NULL where that fails. */
static pcg_program *program_of(const char *path)
{
    if (!path)
        return NULL;
    return is_shared_object(path) ? pcg_program_load(path, NULL) : pcg_compile_file(path, NULL);
}

static void parameter_names(const pcg_program *p)
{
    pcg_parameter about;
    for (size_t i = 0; pcg_program_parameter(p, i, &about); i++)
        printf("%s=\t%.*s\n", about.name, (int)strcspn(about.document, "\n"), about.document);
}

/* `word` is "name=", and maybe the beginning of a value. */
static void parameter_values(const pcg_program *p, const char *word, size_t length)
{
    pcg_parameter about;
    for (size_t i = 0; pcg_program_parameter(p, i, &about); i++) {
        if (strlen(about.name) != length || memcmp(about.name, word, length))
            continue;
        char *prefix = strndup(word, length + 1);
        const char *choices = pcg_program_parameter_choices(p, i);
        if (prefix && choices)
            candidates(prefix, choices, '\n');
        else if (prefix && !strcmp(about.type, "bool"))
            candidates(prefix, "true\nfalse", '\n');
        free(prefix);
    }
}

static void parameters(const char *file, const char *word)
{
    pcg_program *p = program_of(file);
    size_t length = strcspn(word, "=");
    if (p && word[length])
        parameter_values(p, word, length);
    else if (p)
        parameter_names(p);
    pcg_program_free(p);
}

/* ---- options --------------------------------------------------------------------------------- */

static void debugger_commands(const char *prefix)
{
    for (const debug_command *c = debug_commands; c->name; c++)
        candidate(prefix, c->name, strlen(c->name), c->summary);
}

/* A value of the option, behind `prefix` ("" or "--name="). */
static void option_values(const option *o, const char *prefix, const char *file, const char *word)
{
    if (!strcmp(o->argument, "NAME=VALUE"))
        parameters(file, word);
    else if (!strcmp(o->argument, "FILE"))
        puts(":files");
    else if (!strcmp(o->argument, "FOLDER"))
        puts(":folders");
    else if (!strcmp(o->argument, "COMMANDS"))
        debugger_commands(prefix);
    else if (strchr(o->argument, '|'))
        candidates(prefix, o->argument, '|');
}

static void option_names(const option *options)
{
    for (const option *o = options; o->name; o++)
        candidate("--", o->name, strlen(o->name), o->help);
    for (const option *o = options; o->name; o++)
        if (o->letter)
            candidate("-", &o->letter, 1, o->help);
    candidate("--", "help", 4, "explains the command");
}

/* The option that a word names, if any. */
static const option *named(const option *options, const char *word)
{
    size_t length = strcspn(word, "=");
    for (const option *o = options; o->name; o++) {
        bool is_long = !strncmp(word, "--", 2) && strlen(o->name) == length - 2;
        if (is_long && !memcmp(o->name, word + 2, length - 2))
            return o;
        if (o->letter && word[0] == '-' && word[1] == o->letter)
            return o;
    }
    return NULL;
}

static bool takes_next_word(const option *o, const char *word)
{
    bool whole = word[1] == '-' ? !strchr(word, '=') : !word[2];
    return o->kind != OPTION_FLAG && o->kind != OPTION_DEFAULT && whole;
}

/* "--name=" and maybe more. */
static void value_in_word(const option *o, const char *file, const char *word)
{
    size_t length = strcspn(word, "=") + 1;
    char *prefix = strndup(word, length);
    if (prefix && o->kind != OPTION_FLAG)
        option_values(o, prefix, file, word + length);
    free(prefix);
}

void complete_command(const command *c, const option *options, int count, char **words)
{
    const char *last = count > 0 ? words[count - 1] : "", *file = NULL;
    const option *waiting = NULL;
    for (int i = 0; i + 1 < count; i++) {
        const option *o = waiting ? NULL : named(options, words[i]);
        if (!waiting && !o && words[i][0] != '-' && !file)
            file = words[i];
        waiting = o && takes_next_word(o, words[i]) ? o : NULL;
    }
    if (waiting)
        option_values(waiting, "", file, last);
    else if (!strncmp(last, "--", 2) && strchr(last, '=') && named(options, last))
        value_in_word(named(options, last), file, last);
    else if (last[0] == '-')
        option_names(options);
    else if (strstr(c->arguments, "FILE") || strstr(c->arguments, "FOLDER"))
        puts(":files");
    else if (strchr(c->arguments, '|'))
        candidates("", c->arguments, '|');
}

void complete_word(const command *const *commands, int argc, char **argv)
{
    const char *first = argc > 1 ? argv[1] : "";
    bool helped = !strcmp(first, "help") && argc == 3;
    for (size_t i = 0; commands[i]; i++)
        if (argc > 2 && !strcmp(commands[i]->name, first)) {
            argv[1] = argv[0];
            commands[i]->run(commands[i], argc - 1, argv + 1);
            return;
        }
    for (size_t i = 0; commands[i] && (argc == 2 || helped) && first[0] != '-'; i++)
        candidate("", commands[i]->name, strlen(commands[i]->name), commands[i]->summary);
    if (!helped)
        command_compile.run(&command_compile, argc, argv);
}

/* ---- scripts --------------------------------------------------------------------------------- */

/* bash breaks words at '=' and ':'; they are put together again, and what stands before the last
 * such sign is taken off the candidates, since bash keeps it. */
static const char bash[] =
    "# Completion of pcgc in bash: . <(pcgc completion bash)\n"
    "_pcgc() {\n"
    "    local -a words=()\n"
    "    local i line word glue= current kept\n"
    "    for ((i = 1; i <= COMP_CWORD; i++)); do\n"
    "        word=${COMP_WORDS[i]}\n"
    "        if ((${#words[@]})) && [[ $glue || $word == [=:]* ]]; then\n"
    "            words[-1]+=$word\n"
    "        else\n"
    "            words+=(\"$word\")\n"
    "        fi\n"
    "        glue=\n"
    "        [[ $word == [=:] ]] && glue=yes\n"
    "    done\n"
    "    current=${words[-1]-}\n"
    "    kept=${current%\"${COMP_WORDS[COMP_CWORD]}\"}\n"
    "    [[ ${COMP_WORDS[COMP_CWORD]} == [=:] ]] && kept=$current\n"
    "    COMPREPLY=()\n"
    "    while IFS= read -r line; do\n"
    "        line=${line%%$'\\t'*}\n"
    "        case $line in\n"
    "        :files) compopt -o filenames; mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < \\\n"
    "            <(compgen -f -- \"${current#\"$kept\"}\") ;;\n"
    "        :folders) compopt -o filenames; mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < \\\n"
    "            <(compgen -d -- \"${current#\"$kept\"}\") ;;\n"
    "        *=) [[ $line == \"$current\"* ]] && compopt -o nospace && COMPREPLY+=(\"${line#\"$kept\"}\") ;;\n"
    "        \"$current\"*) COMPREPLY+=(\"${line#\"$kept\"}\") ;;\n"
    "        esac\n"
    "    done < <(\"${COMP_WORDS[0]}\" --complete \"${words[@]}\" 2>/dev/null)\n"
    "} 2>/dev/null\n"
    "complete -F _pcgc pcgc\n";

static const char zsh[] =
    "#compdef pcgc\n"
    "# Completion of pcgc in zsh: in a folder of $fpath, as _pcgc; or source <(pcgc completion zsh)\n"
    "_pcgc() {\n"
    "    local line word meaning\n"
    "    local -a described bare\n"
    "    for line in \"${(@f)$($words[1] --complete \"${(@)words[2,CURRENT]}\" 2>/dev/null)}\"; do\n"
    "        word=${line%%$'\\t'*}\n"
    "        meaning=${line#*$'\\t'}\n"
    "        case $word in\n"
    "        '') ;;\n"
    "        :files) _files ;;\n"
    "        :folders) _files -/ ;;\n"
    "        *=) bare+=(\"$word\") ;;\n"
    "        *) described+=(\"${word//:/\\\\:}:${meaning//:/\\\\:}\") ;;\n"
    "        esac\n"
    "    done\n"
    "    (( $#described )) && _describe pcgc described\n"
    "    (( $#bare )) && compadd -S '' -- \"${bare[@]}\"\n"
    "}\n"
    "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n"
    "    _pcgc \"$@\"\n"
    "else\n"
    "    compdef _pcgc pcgc\n"
    "fi\n";

static int run_completion(const command *self, int argc, char **argv)
{
    arena a = {0};
    option_texts shells = {0};
    const option options[] = {{0}};
    int code = options_read(&a, self, options, argc, argv, &shells);
    if (code < 0 && shells.count != 1)
        code = usage_error(self, "for which shell? bash or zsh");
    if (code < 0) {
        const char *shell = shells.at[0];
        const char *script = !strcmp(shell, "bash") ? bash : !strcmp(shell, "zsh") ? zsh : NULL;
        code = script ? EXIT_DONE : usage_error(self, "there is bash and zsh, not '%s'", shell);
        if (script)
            fputs(script, stdout);
    }
    arena_free(&a);
    return code;
}

static const char *const examples[] = {". <(pcgc completion bash)",
                                       "pcgc completion zsh > ~/.zfunc/_pcgc", NULL};
const command command_completion = {"completion", "bash|zsh",
                                    "Prints what makes a shell complete pcgc's command lines.",
                                    examples, run_completion};

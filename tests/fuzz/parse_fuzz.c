/* parse_fuzz.c - any bytes are parsed, dumped, and what they say of expressions written and read
 * again.
 *
 * With PARSE_FUZZ_REPLAY defined it needs no libFuzzer, and replays the files that it is given. */
#include "../../lang/lang.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MEMORY = 1 << 28 };

static void stop_if(bool wrong, const char *what, const char *first, const char *second)
{
    if (!wrong)
        return;
    fprintf(stderr, "%s\n%s\n%s\n", what, first, second);
    abort();
}

static const char *written(arena *a, const tree_expression *e)
{
    text t = {.arena = a};
    lang_write_expression(e, &t);
    return t.at;
}

/* Writing and reading again must come to the same text. Expressions that hold an error have none.
 */
static void check_written(arena *a, const tree_expression *e)
{
    const char *first = written(a, e);
    if (strchr(first, '?'))
        return;
    diagnostics d = {.arena = a};
    const char *content = arena_format(a, "graph g { const x = %s\n}", first);
    const tree_file *f = lang_parse(a, source_new(a, "again", content, strlen(content)), &d);
    stop_if(d.errors > 0, "what was written cannot be read", first,
            d.errors ? d.list.at[0].message : "");
    const char *second = written(a, f->items.at[0].graph->members.at[0]->parameter->initial);
    stop_if(strcmp(first, second) != 0, "written differently the second time", first, second);
}

static void check_graph(arena *a, const tree_graph *g)
{
    for (uint32_t i = 0; i < g->members.count; i++) {
        const tree_member *m = g->members.at[i];
        text t = {.arena = a};
        if (m->kind == MEMBER_CONSTANT)
            check_written(a, m->parameter->initial);
        if (m->kind == MEMBER_CHAIN)
            lang_write_chain(m->chain, &t);
    }
}

/* Bytes that are no UTF-8, and empty names, are kept as they are, and would be wrong in the second
 * text, too. */
static bool is_writable(const diagnostics *d)
{
    for (uint32_t i = 0; i < d->list.count; i++)
        if (d->list.at[i].code == DIAG_E0003 || d->list.at[i].code == DIAG_E0018)
            return false;
    return true;
}

/* Everything that is said of a text can be printed. */
static void print_all(const diagnostics *d, arena *a)
{
    for (uint32_t i = 0; i < d->list.count; i++) {
        text t = {.arena = a};
        diagnostic_write(&d->list.at[i], true, &t);
        diagnostic_write_json(&d->list.at[i], &t);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    arena a = {.limit = MEMORY};
    jmp_buf failed;
    if (setjmp(failed)) {
        arena_free(&a);
        return 0;
    }
    a.on_failure = &failed;
    diagnostics d = {.arena = &a};
    char *copy = arena_copy(&a, (const char *)data, size);
    const tree_file *f = lang_parse(&a, source_new(&a, "fuzz.pcg", copy, size), &d);
    text dump = {.arena = &a};
    lang_dump(f, &dump);
    print_all(&d, &a);
    for (uint32_t i = 0; i < f->items.count && is_writable(&d); i++)
        if (f->items.at[i].kind == ITEM_GRAPH)
            check_graph(&a, f->items.at[i].graph);
    arena_free(&a);
    return 0;
}

#ifdef PARSE_FUZZ_REPLAY
int main(int count, char **paths)
{
    for (int i = 1; i < count; i++) {
        arena a = {0};
        const source *s = source_read(&a, paths[i], MEMORY);
        if (!s) {
            perror(paths[i]);
            return 2;
        }
        LLVMFuzzerTestOneInput((const uint8_t *)s->text, s->size);
        arena_free(&a);
    }
    return 0;
}
#endif

/* check_path.c - paths are looked up beside the file that they are written in.
 *
 * While a graph runs there is one folder, the main file's. So a path that is written in a file of
 * another folder is rewritten here to lead there from the main file's folder: "brick.jpg" in
 * ../walls/wall.pcg becomes "../walls/brick.jpg". */
#include "check.h"

#include <stdlib.h>
#include <string.h>

static const unit *unit_of(const program *p, const source *s)
{
    for (uint32_t i = 0; i < p->unit_count; i++)
        if (p->units[i]->source == s)
            return p->units[i];
    return NULL;
}

/* How many bytes of both folders, whole names, are the same; those of `a` with the slash behind
 * them. */
static size_t common_length(const char *a, const char *b)
{
    size_t common = 0;
    for (size_t i = 0;; i++) {
        bool a_ends = a[i] == '/' || a[i] == '\0', b_ends = b[i] == '/' || b[i] == '\0';
        if (a_ends && b_ends)
            common = a[i] && b[i] ? i + 1 : i;
        if (a[i] != b[i] || !a[i])
            return common;
    }
}

/* From the folder `from` to the folder `to`, both as written, with a slash at its end; "" where
 * they are the same. NULL where the names do not tell: `from` goes up out of folders that have
 * none, or only one begins at the root. */
static const char *way_between(arena *a, const char *from, const char *to)
{
    size_t common = common_length(from, to);
    text way = {.arena = a};
    if ((*from == '/') != (*to == '/'))
        return NULL;
    const char *rest = from + (common < strlen(from) ? common : strlen(from));
    text_add(&way, "");
    while (*rest) {
        size_t length = strcspn(rest, "/");
        if (length == 2 && !strncmp(rest, "..", 2))
            return NULL;
        text_add(&way, length ? "../" : "");
        rest += length + (rest[length] == '/');
    }
    rest = to + (common < strlen(to) ? common : strlen(to));
    rest += *rest == '/' && common;
    text_add(&way, rest);
    if (*rest && way.at[way.length - 1] != '/')
        text_add(&way, "/");
    return way.at;
}

const char *path_from_main(checker *k, const source *written_in, const char *path)
{
    const unit *u = unit_of(k->p, written_in);
    if (!u || *path == '/' || *path == '\0' || !strcmp(u->folder, k->p->units[0]->folder))
        return path;
    const char *way = way_between(k->arena, k->p->units[0]->folder, u->folder);
    if (way)
        return arena_format(k->arena, "%s%s", way, path);
    char *real = realpath(*u->folder ? u->folder : ".", NULL);
    const char *whole = real ? arena_format(k->arena, "%s/%s", real, path) : path;
    free(real);
    return whole;
}

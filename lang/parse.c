/* parse.c - a text to its syntax tree. */
#include "parser.h"

#include "grammar.h"

#include <string.h>

/* How many bytes the character at `at` has; 0 where they are no UTF-8 (RFC 3629). */
static uint32_t character_length(const unsigned char *at, size_t left)
{
    static const struct {
        unsigned char first, last, low, high;
        uint32_t length;
    } forms[] = {
        {0x01, 0x7F, 0x80, 0xBF, 1}, {0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
        {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3}, {0xEE, 0xEF, 0x80, 0xBF, 3},
        {0xF0, 0xF0, 0x90, 0xBF, 4}, {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4},
    };
    for (size_t i = 0; i < COUNT_OF(forms); i++) {
        if (at[0] < forms[i].first || at[0] > forms[i].last)
            continue;
        if (forms[i].length > left ||
            (forms[i].length > 1 && (at[1] < forms[i].low || at[1] > forms[i].high)))
            return 0;
        for (uint32_t k = 2; k < forms[i].length; k++)
            if ((at[k] & 0xC0) != 0x80)
                return 0;
        return forms[i].length;
    }
    return 0;
}

/* A NUL is reported, and nothing is read then: false. */
static bool check_nul(parser *p)
{
    const source *s = p->source;
    const char *nul = memchr(s->text, '\0', s->size);
    if (!nul)
        return true;
    uint32_t at = (uint32_t)(nul - s->text);
    diagnostic *d = diagnose(p->diagnostics, DIAG_E0002, parser_span(p, at, at + 1));
    if (s->size > 1 && (memcmp(s->text, "\xFF\xFE", 2) == 0 || memcmp(s->text, "\xFE\xFF", 2) == 0))
        d->help = "it looks like UTF-16: save it as UTF-8";
    return false;
}

/* Whether the file holds control characters that no editor writes. */
static bool holds_controls(const source *s)
{
    for (size_t i = 0; i < s->size; i++)
        if ((unsigned char)s->text[i] < ' ' && !strchr("\t\n\v\f\r", s->text[i]))
            return true;
    return false;
}

/* Reports the first bytes that are no UTF-8. Text in another encoding is read all the same, for the
 * errors behind it; false where it is no text. */
static bool check_utf8(parser *p)
{
    const source *s = p->source;
    uint32_t at = 0, length = 1;
    while (length && at < s->size) {
        length = character_length((const unsigned char *)s->text + at, s->size - at);
        at += length;
    }
    if (length)
        return true;
    bool binary = holds_controls(s);
    diagnose(p->diagnostics, DIAG_E0003, parser_span(p, at, at + 1),
             (unsigned)(unsigned char)s->text[at])
        ->help = binary ? "this seems to be no text file" : "save the file as UTF-8";
    return !binary;
}

tree_file *lang_parse(arena *a, const source *s, diagnostics *d)
{
    parser *p = ARENA_NEW(a, parser);
    p->arena = a;
    p->source = s;
    p->diagnostics = d;
    p->file = ARENA_NEW(a, tree_file);
    p->file->source = s;
    if (s->size > LANG_MAX_BYTES) {
        diagnose(d, DIAG_E0013, parser_span(p, 0, 0), s->size, (size_t)LANG_MAX_BYTES);
        return p->file;
    }
    if (!check_nul(p))
        return p->file;
    if (!check_utf8(p))
        return p->file;
    grammar_parse(p);
    attach_comments(p);
    return p->file;
}

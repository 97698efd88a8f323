/* check_hint.c - what newcomers to the language may have meant. */
#include "check.h"

#include <string.h>

const char *hint_color(checker *k, const char *word)
{
    static const struct {
        const char *name, *color;
    } named[] = {
        {"black", "#000000"},  {"white", "#ffffff"},  {"gray", "#808080"},   {"grey", "#808080"},
        {"silver", "#c0c0c0"}, {"red", "#ff0000"},    {"maroon", "#800000"}, {"orange", "#ffa500"},
        {"yellow", "#ffff00"}, {"olive", "#808000"},  {"lime", "#00ff00"},   {"green", "#008000"},
        {"teal", "#008080"},   {"cyan", "#00ffff"},   {"aqua", "#00ffff"},   {"blue", "#0000ff"},
        {"navy", "#000080"},   {"purple", "#800080"}, {"violet", "#ee82ee"}, {"magenta", "#ff00ff"},
        {"pink", "#ffc0cb"},   {"brown", "#a52a2a"},  {"beige", "#f5f5dc"},  {"gold", "#ffd700"},
    };
    if (*word == '#')
        return arena_format(k->arena, "write %s, without quotes", word);
    for (size_t i = 0; i < COUNT_OF(named); i++)
        if (!strcmp(word, named[i].name))
            return arena_format(k->arena, "write %s", named[i].color);
    return NULL;
}

/* A part of a path: a name that means nothing, a number, or parts with '/', '.' or '-' between. */
static bool is_part_of_path(const scope *s, const tree_expression *e, bool *named)
{
    switch (e->kind) {
    case EXPR_NAME:
        *named = true;
        return !e->parenthesised && !name_is_known(s, e->name.text);
    case EXPR_INT:
    case EXPR_FLOAT:
        return true;
    case EXPR_MEMBER:
        return is_part_of_path(s, e->operands.at[0], named);
    case EXPR_BINARY:
        return (e->op == OP_DIVIDE || e->op == OP_SUBTRACT) && !e->parenthesised &&
               is_part_of_path(s, e->operands.at[0], named) &&
               is_part_of_path(s, e->operands.at[1], named);
    default:
        return false;
    }
}

bool is_bare_path(const scope *s, const tree_expression *e)
{
    bool named = false;
    return (e->kind == EXPR_MEMBER || e->kind == EXPR_BINARY) && is_part_of_path(s, e, &named) &&
           named;
}

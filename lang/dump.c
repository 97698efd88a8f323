/* dump.c - the tree in a form for tests: one element a line, what it holds indented below it.
 * Expressions are written with all the parentheses that their tree has, so that precedence shows.
 */
#include "parser.h"

#include <string.h>

typedef struct dumping {
    text *out;
    int depth;
} dumping;

static void begin_line(dumping *d)
{
    for (int i = 0; i < d->depth; i++)
        text_add(d->out, "  ");
}

static void end_line(dumping *d)
{
    text_add(d->out, "\n");
}

/* ---- names, expressions ---------------------------------------------------------------------- */

static void add_name(dumping *d, const char *before, const tree_name *name)
{
    if (!name->text)
        return;
    text_add(d->out, before);
    lang_write_name(name->text, d->out);
}

static void add_expression(dumping *d, const tree_expression *e);

static void add_operands(dumping *d, const tree_expressions *operands)
{
    for (uint32_t i = 0; i < operands->count; i++) {
        text_add(d->out, i ? ", " : "");
        add_expression(d, operands->at[i]);
    }
}

static void add_compound(dumping *d, const tree_expression *e)
{
    const char *sign = e->kind == EXPR_CHOICE ? "?" : lang_operator(e->op);
    text_add(d->out, "(");
    if (e->kind == EXPR_UNARY)
        text_add(d->out, sign);
    for (uint32_t i = 0; i < e->operands.count; i++) {
        if (i)
            text_format(d->out, " %s ", i == 2 ? ":" : sign);
        add_expression(d, e->operands.at[i]);
    }
    text_add(d->out, ")");
}

static void add_expression(dumping *d, const tree_expression *e)
{
    switch (e->kind) {
    case EXPR_UNARY:
    case EXPR_BINARY:
    case EXPR_CHOICE:
        add_compound(d, e);
        break;
    case EXPR_LIST:
        text_add(d->out, "[");
        add_operands(d, &e->operands);
        text_add(d->out, "]");
        break;
    case EXPR_MEMBER:
        add_expression(d, e->operands.at[0]);
        add_name(d, ".", &e->name);
        break;
    case EXPR_CALL:
        add_name(d, "", &e->port);
        add_name(d, e->port.text ? "." : "", &e->name);
        text_add(d->out, "(");
        add_operands(d, &e->operands);
        text_add(d->out, ")");
        break;
    case EXPR_ERROR:
        text_add(d->out, "<error>");
        break;
    default:
        lang_write_expression(e, d->out);
    }
}

/* A test's expectations (tests/README.md) stand in comments that the dump, which they speak of,
 * leaves out. */
static bool is_expectation(const tree_comment *c)
{
    return c->kind == COMMENT_PLAIN && *c->text && strchr("~=?", *c->text);
}

/* ---- comments -------------------------------------------------------------------------------- */

static void dump_comments(dumping *d, const char *where, const tree_comments *comments)
{
    static const char *const slashes[] = {"//", "///", "//!"};
    for (uint32_t i = 0; i < comments->count; i++) {
        if (is_expectation(&comments->at[i]))
            continue;
        begin_line(d);
        text_format(d->out, "%s %s%s\n", where, slashes[comments->at[i].kind],
                    comments->at[i].text);
    }
}

/* What belongs to a head stands below its element's line, documentation first. */
static void dump_head(dumping *d, const tree_head *head)
{
    d->depth++;
    if (head->document) {
        begin_line(d);
        text_add(d->out, "document ");
        text_quote(d->out, head->document);
        end_line(d);
    }
    dump_comments(d, "before", &head->before);
    dump_comments(d, "after", &head->after);
    d->depth--;
}

/* ---- parameters, gates ----------------------------------------------------------------------- */

static void dump_operands(dumping *d, const char *what, const tree_expressions *operands)
{
    begin_line(d);
    text_add(d->out, what);
    add_operands(d, operands);
    end_line(d);
}

static void dump_parameter(dumping *d, const char *keyword, const tree_parameter *p)
{
    static const char *const kinds[] = {"range ", "one of ", "matches ", "at most "};
    begin_line(d);
    text_format(d->out, "%s%s ", p->hidden ? "hidden " : "", keyword);
    lang_write_name(p->name.text, d->out);
    if (p->type) {
        text_add(d->out, ": ");
        lang_write_type(p->type, d->out);
    }
    if (p->initial) {
        text_add(d->out, " = ");
        add_expression(d, p->initial);
    }
    end_line(d);
    dump_head(d, &p->head);
    d->depth++;
    for (uint32_t i = 0; i < p->constraints.count; i++)
        dump_operands(d, kinds[p->constraints.at[i].kind], &p->constraints.at[i].operands);
    d->depth--;
}

static void dump_parameters(dumping *d, const char *keyword, const tree_parameters *parameters)
{
    for (uint32_t i = 0; i < parameters->count; i++)
        dump_parameter(d, keyword, parameters->at[i]);
}

static void dump_chain(dumping *d, const tree_chain *c);

static void dump_gate(dumping *d, const char *keyword, const tree_gate *g)
{
    begin_line(d);
    text_format(d->out, "%s ", keyword);
    lang_write_name(g->name.text, d->out);
    text_add(d->out, ": ");
    lang_write_type(g->type, d->out);
    text_add(d->out, g->gathers ? " = *\n" : "\n");
    dump_head(d, &g->head);
    d->depth++;
    if (g->stand_in)
        dump_chain(d, g->stand_in);
    d->depth--;
}

static void dump_gates(dumping *d, const char *keyword, const tree_gates *gates)
{
    for (uint32_t i = 0; i < gates->count; i++)
        dump_gate(d, keyword, gates->at[i]);
}

/* ---- chains ---------------------------------------------------------------------------------- */

static void dump_arguments(dumping *d, const tree_arguments *arguments)
{
    static const char *const signs[] = {" = ", " => @", " <=> @"};
    for (uint32_t i = 0; i < arguments->count; i++) {
        const tree_argument *a = &arguments->at[i];
        begin_line(d);
        text_add(d->out, "argument ");
        add_name(d, "", &a->name);
        text_add(d->out, a->name.text ? signs[a->kind] : "");
        if (a->kind == ARGUMENT_VALUE)
            add_expression(d, a->value);
        else
            lang_write_name(a->attribute.text, d->out);
        end_line(d);
        d->depth++;
        dump_comments(d, "before", &a->before);
        dump_comments(d, "after", &a->after);
        d->depth--;
    }
}

static void dump_augmentation(dumping *d, const tree_augmentation *a)
{
    begin_line(d);
    text_add(d->out, "augmentation ");
    if (a->name.text) {
        lang_write_name(a->name.text, d->out);
        text_add(d->out, ": ");
    }
    lang_write_name(a->kind.text, d->out);
    text_add(d->out, a->has_parentheses ? "()\n" : "\n");
    dump_head(d, &a->head);
    d->depth++;
    dump_arguments(d, &a->arguments);
    d->depth--;
}

static void dump_body(dumping *d, const tree_body *b)
{
    dump_gates(d, "in", &b->inputs);
    dump_gates(d, "out", &b->outputs);
    dump_parameters(d, "param", &b->parameters);
    dump_parameters(d, "attr", &b->attributes);
    for (uint32_t i = 0; i < b->loops.count; i++) {
        begin_line(d);
        add_name(d, "loop ", &b->loops.at[i]->from);
        add_name(d, " -> ", &b->loops.at[i]->to);
        end_line(d);
        dump_head(d, &b->loops.at[i]->head);
    }
    for (uint32_t i = 0; i < b->augmentations.count; i++)
        dump_augmentation(d, b->augmentations.at[i]);
    dump_comments(d, "dangling", &b->dangling);
}

static void dump_element(dumping *d, const char *arrow, const tree_element *e)
{
    begin_line(d);
    text_add(d->out, arrow);
    if (e->kind == ELEMENT_REFERENCE) {
        add_name(d, "reference ", &e->name);
        add_name(d, ".", &e->port);
    } else {
        add_name(d, "node ", &e->name);
        text_add(d->out, e->name.text ? ": " : "node ");
        add_name(d, "", &e->library);
        add_name(d, e->library.text ? "." : "", &e->procedure);
        text_format(d->out, "%s%s", e->has_parentheses ? "()" : "", e->body ? " {}" : "");
    }
    end_line(d);
    d->depth++;
    dump_comments(d, "before", &e->before);
    dump_comments(d, "after", &e->after);
    dump_arguments(d, &e->arguments);
    if (e->body)
        dump_body(d, e->body);
    d->depth--;
}

static void dump_chain(dumping *d, const tree_chain *c)
{
    for (uint32_t i = 0; i < c->elements.count; i++)
        dump_element(d, !i ? "" : c->arrows.at[i - 1].disabled ? "-/> " : "-> ", c->elements.at[i]);
    if (!c->condition)
        return;
    begin_line(d);
    text_add(d->out, "if ");
    add_expression(d, c->condition);
    end_line(d);
}

/* ---- graphs ---------------------------------------------------------------------------------- */

static void dump_block(dumping *d, const tree_block *b)
{
    begin_line(d);
    add_name(d, "block ", &b->node);
    add_name(d, ".", &b->port);
    if (b->condition) {
        text_add(d->out, " if ");
        add_expression(d, b->condition);
    }
    end_line(d);
    dump_head(d, &b->head);
}

static void dump_chain_member(dumping *d, const tree_member *m)
{
    begin_line(d);
    text_add(d->out, "chain\n");
    dump_head(d, &m->head);
    d->depth++;
    dump_chain(d, m->chain);
    d->depth--;
}

static void dump_member(dumping *d, const tree_member *m)
{
    static const char *const keywords[] = {"param", "const", "attr", "in", "out"};
    switch (m->kind) {
    case MEMBER_PARAMETER:
    case MEMBER_CONSTANT:
    case MEMBER_ATTRIBUTE:
        dump_parameter(d, keywords[m->kind], m->parameter);
        break;
    case MEMBER_INPUT:
    case MEMBER_OUTPUT:
        dump_gate(d, keywords[m->kind], m->gate);
        break;
    case MEMBER_CHAIN:
        dump_chain_member(d, m);
        break;
    case MEMBER_BLOCK:
        dump_block(d, m->block);
        break;
    }
}

static void dump_graph(dumping *d, const tree_graph *g)
{
    begin_line(d);
    add_name(d, "graph ", &g->name);
    end_line(d);
    dump_head(d, &g->head);
    d->depth++;
    for (uint32_t i = 0; i < g->members.count; i++)
        dump_member(d, g->members.at[i]);
    dump_comments(d, "dangling", &g->dangling);
    d->depth--;
}

/* ---- interfaces ------------------------------------------------------------------------------ */

static void dump_names(dumping *d, const char *what, const tree_names *names)
{
    if (!names->count)
        return;
    begin_line(d);
    text_add(d->out, what);
    for (uint32_t i = 0; i < names->count; i++)
        add_name(d, i ? ", " : " ", &names->at[i]);
    end_line(d);
}

static void dump_string(dumping *d, const char *what, const tree_name *string)
{
    if (!string->text)
        return;
    begin_line(d);
    text_add(d->out, what);
    text_quote(d->out, string->text);
    end_line(d);
}

static void add_variables(dumping *d, const tree_variable *variables, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        add_name(d, i ? ", " : "<", &variables[i].name);
        add_name(d, ": ", &variables[i].bound);
    }
    text_add(d->out, count ? ">" : "");
}

static void dump_augment(dumping *d, const tree_augment *a)
{
    begin_line(d);
    add_name(d, "augment ", &a->name);
    if (a->output || a->input) {
        text_add(d->out, a->output ? " -> " : " <- ");
        lang_write_type(a->output ? a->output : a->input, d->out);
    }
    end_line(d);
    dump_head(d, &a->head);
    d->depth++;
    dump_parameters(d, "param", &a->parameters);
    dump_parameters(d, "attr", &a->attributes);
    d->depth--;
}

static void dump_example(dumping *d, const tree_example *e)
{
    begin_line(d);
    text_add(d->out, "example\n");
    dump_head(d, &e->head);
    d->depth++;
    for (uint32_t i = 0; i < e->chains.count; i++)
        dump_chain(d, e->chains.at[i]);
    for (uint32_t i = 0; i < e->expectations.count; i++) {
        begin_line(d);
        text_format(d->out, "expect %s = ", e->expectations.at[i].name.text);
        add_expression(d, e->expectations.at[i].value);
        end_line(d);
    }
    d->depth--;
}

static void dump_procedure(dumping *d, const tree_procedure *p)
{
    begin_line(d);
    add_name(d, "procedure ", &p->name);
    add_variables(d, p->variables.at, p->variables.count);
    end_line(d);
    dump_head(d, &p->head);
    d->depth++;
    dump_gates(d, "in", &p->inputs);
    dump_gates(d, "out", &p->outputs);
    dump_names(d, "traits", &p->traits);
    dump_parameters(d, "param", &p->parameters);
    dump_parameters(d, "attr", &p->attributes);
    for (uint32_t i = 0; i < p->augments.count; i++)
        dump_augment(d, p->augments.at[i]);
    for (uint32_t i = 0; i < p->examples.count; i++)
        dump_example(d, p->examples.at[i]);
    dump_names(d, "formerly", &p->former);
    dump_string(d, "category ", &p->category);
    for (uint32_t i = 0; i < p->synonyms.count; i++)
        dump_string(d, "synonym ", &p->synonyms.at[i]);
    dump_comments(d, "dangling", &p->dangling);
    d->depth--;
}

static void dump_function(dumping *d, const tree_function *f)
{
    begin_line(d);
    add_name(d, "function ", &f->name);
    add_variables(d, f->variables.at, f->variables.count);
    text_add(d->out, " -> ");
    lang_write_type(f->result, d->out);
    end_line(d);
    dump_head(d, &f->head);
    d->depth++;
    dump_parameters(d, "param", &f->parameters);
    dump_names(d, "traits", &f->traits);
    for (uint32_t i = 0; i < f->examples.count; i++)
        dump_operands(d, "example ", &(tree_expressions){.at = &f->examples.at[i], .count = 1});
    dump_comments(d, "dangling", &f->dangling);
    d->depth--;
}

static void dump_entity(dumping *d, const tree_entity *e)
{
    begin_line(d);
    add_name(d, "entity ", &e->name);
    add_name(d, ": ", &e->parent);
    end_line(d);
    dump_head(d, &e->head);
    d->depth++;
    dump_parameters(d, "attr", &e->attributes);
    dump_comments(d, "dangling", &e->dangling);
    d->depth--;
}

static void dump_enumeration(dumping *d, const tree_enumeration *e)
{
    begin_line(d);
    add_name(d, "enum ", &e->name);
    end_line(d);
    dump_head(d, &e->head);
    d->depth++;
    for (uint32_t i = 0; i < e->enumerators.count; i++) {
        begin_line(d);
        add_name(d, "", &e->enumerators.at[i].name);
        end_line(d);
        dump_head(d, &e->enumerators.at[i].head);
    }
    dump_comments(d, "dangling", &e->dangling);
    d->depth--;
}

/* ---- files ----------------------------------------------------------------------------------- */

static void dump_import(dumping *d, const tree_import *i)
{
    begin_line(d);
    text_add(d->out, "import");
    for (uint32_t k = 0; k < i->names.count; k++) {
        add_name(d, k ? ", " : " ", &i->names.at[k].name);
        add_name(d, " as ", &i->names.at[k].alias);
    }
    text_add(d->out, " from ");
    text_quote(d->out, i->path);
    end_line(d);
    dump_head(d, &i->head);
}

static void dump_use(dumping *d, const tree_use *u)
{
    begin_line(d);
    add_name(d, "use ", &u->library);
    add_name(d, " as ", &u->alias);
    end_line(d);
    dump_head(d, &u->head);
}

static void dump_item(dumping *d, const tree_item *i)
{
    switch (i->kind) {
    case ITEM_IMPORT:
        dump_import(d, i->import);
        break;
    case ITEM_USE:
        dump_use(d, i->use);
        break;
    case ITEM_GRAPH:
        dump_graph(d, i->graph);
        break;
    case ITEM_PROCEDURE:
        dump_procedure(d, i->procedure);
        break;
    case ITEM_FUNCTION:
        dump_function(d, i->function);
        break;
    case ITEM_ENTITY:
        dump_entity(d, i->entity);
        break;
    case ITEM_ENUMERATION:
        dump_enumeration(d, i->enumeration);
        break;
    }
}

void lang_dump(const tree_file *f, text *out)
{
    dumping d = {.out = out};
    text_add(out, ""); /* of an empty file too it is a string */
    if (f->document) {
        text_add(out, "document ");
        text_quote(out, f->document);
        end_line(&d);
    }
    dump_comments(&d, "before", &f->before);
    for (uint32_t i = 0; i < f->items.count; i++)
        dump_item(&d, &f->items.at[i]);
    dump_comments(&d, "dangling", &f->dangling);
}

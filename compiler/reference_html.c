/* reference_html.c - the whole reference as one page that needs no other file. */
#include <string.h>

#include "reference.h"

static const char style[] =
    ":root{color-scheme:light dark;--ink:#1d2430;--soft:#5b6675;--line:#dde2e9;--paper:#fff;"
    "--side:#f5f7fa;--code:#eef2f7;--accent:#2563a8}\n"
    "@media(prefers-color-scheme:dark){:root{--ink:#dfe5ee;--soft:#94a0b2;--line:#2c3442;"
    "--paper:#12161d;--side:#171c25;--code:#1e2531;--accent:#7db4f0}}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0;display:flex;color:var(--ink);background:var(--paper);"
    "font:16px/1.55 system-ui,sans-serif}\n"
    "nav{position:sticky;top:0;height:100vh;flex:0 0 17rem;overflow-y:auto;padding:1rem;"
    "background:var(--side);border-right:1px solid var(--line);font-size:.9rem}\n"
    "nav input{width:100%;padding:.45rem .6rem;margin-bottom:.5rem;font:inherit;color:inherit;"
    "background:var(--paper);border:1px solid var(--line);border-radius:.4rem}\n"
    "nav h2{margin:1.1rem 0 .2rem;font-size:1rem}\n"
    "nav h3{margin:.7rem 0 .1rem;font-size:.75rem;letter-spacing:.06em;text-transform:uppercase;"
    "color:var(--soft)}\n"
    "nav a{display:block;padding:.08rem 0;color:inherit;text-decoration:none}\n"
    "nav a:hover,nav a:focus{color:var(--accent)}\n"
    "main{flex:1;min-width:0;max-width:56rem;padding:1.5rem 2.5rem 6rem}\n"
    "main>h2{margin:3rem 0 .3rem;font-size:1.7rem}\n"
    "main>h3{margin:2.2rem 0 0;color:var(--soft);font-weight:600}\n"
    "article{padding:1.2rem 0;border-bottom:1px solid var(--line)}\n"
    "article h4{margin:0 0 .3rem;font-size:1.25rem}\n"
    "article h4 a{color:inherit;text-decoration:none}\n"
    "article h4 small{font-weight:400;font-size:.8rem;color:var(--soft)}\n"
    "p{margin:.4rem 0}\n"
    "pre,code{font-family:ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;font-size:.88em}\n"
    "code{background:var(--code);border-radius:.25rem;padding:.08em .3em}\n"
    "pre{background:var(--code);border-radius:.5rem;padding:.7rem .9rem;overflow-x:auto}\n"
    "pre code{background:none;padding:0}\n"
    "table{border-collapse:collapse;width:100%;margin:.6rem 0;font-size:.93rem}\n"
    "th{text-align:left;font-weight:600;color:var(--soft);font-size:.8rem}\n"
    "th,td{padding:.3rem .8rem .3rem 0;border-bottom:1px solid var(--line);vertical-align:top}\n"
    "td code{white-space:nowrap}\n"
    ".soft{color:var(--soft);font-size:.88rem}\n"
    "@media(max-width:50rem){body{display:block}nav{position:static;height:auto;max-height:45vh}"
    "main{padding:1rem}}\n";

static const char script[] =
    "const box=document.querySelector('nav input');\n"
    "box.addEventListener('input',()=>{\n"
    "  const words=box.value.toLowerCase().split(/\\s+/).filter(Boolean);\n"
    "  const fits=e=>words.every(w=>e.dataset.words.includes(w));\n"
    "  document.querySelectorAll('nav a,article').forEach(e=>{e.hidden=!fits(e)});\n"
    "  document.querySelectorAll('nav h2,nav h3,main>h2,main>h3,main>p').forEach(e=>{\n"
    "    e.hidden=words.length>0});\n"
    "});\n";

/* ---- text ------------------------------------------------------------------------------------ */

static void escape(text *out, const char *s, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (s[i] == '<')
            text_add(out, "&lt;");
        else if (s[i] == '&')
            text_add(out, "&amp;");
        else if (s[i] == '"')
            text_add(out, "&quot;");
        else
            text_add_bytes(out, s + i, 1);
    }
}

static void escape_all(text *out, const char *s)
{
    escape(out, s ? s : "", s ? strlen(s) : 0);
}

/* Prose in which `code` may stand. */
static void prose(text *out, const char *s, size_t length)
{
    bool code = false;
    while (length) {
        const char *tick = memchr(s, '`', length);
        size_t before = tick ? (size_t)(tick - s) : length;
        escape(out, s, before);
        if (tick) {
            text_add(out, code ? "</code>" : "<code>");
            code = !code;
        }
        s += before + (tick != NULL);
        length -= before + (tick != NULL);
    }
    text_add(out, code ? "</code>" : "");
}

static void prose_all(text *out, const char *s)
{
    prose(out, s ? s : "", s ? strlen(s) : 0);
}

static void paragraphs(text *out, const char *document)
{
    while (document && *document) {
        const char *gap = strstr(document, "\n\n");
        size_t length = gap ? (size_t)(gap - document) : strlen(document);
        text_add(out, "<p>");
        prose(out, document, length);
        text_add(out, "</p>\n");
        document += length;
        document += strspn(document, "\n");
    }
}

static void code_cell(text *out, const text *s)
{
    text_add(out, "<td>");
    if (s->length) {
        text_add(out, "<code>");
        escape(out, s->at, s->length);
        text_add(out, "</code>");
    }
    text_add(out, "</td>");
}

/* ---- entries --------------------------------------------------------------------------------- */

static void words_of(const reference *r, const tree_parameter *p, text *out)
{
    text_add(out, "<td>");
    prose_all(out, p->head.document);
    if (p->constraints.count) {
        text constraints = {.arena = out->arena};
        reference_write_constraints(p, &constraints);
        text_add(out, " <code>");
        escape_all(out, constraints.at);
        text_add(out, "</code>");
    }
    const tree_enumeration *e = reference_enumeration(r, p->type);
    for (uint32_t i = 0; e && i < e->enumerators.count; i++) {
        text_add(out, i ? ", <code>" : " One of <code>");
        escape_all(out, e->enumerators.at[i].name.text);
        text_add(out, "</code>");
    }
    text_add(out, "</td>");
}

static void parameters(const reference *r, const char *title, const tree_parameters *list,
                       text *out)
{
    if (!list->count)
        return;
    text_format(out, "<table><tr><th>%s</th><th>type</th><th>default</th><th></th></tr>\n", title);
    for (uint32_t i = 0; i < list->count; i++) {
        const tree_parameter *p = list->at[i];
        text name = {.arena = out->arena}, type_text = {.arena = out->arena};
        text value = {.arena = out->arena};
        text_add(&name, p->name.text);
        lang_write_type(p->type, &type_text);
        if (p->initial)
            lang_write_expression(p->initial, &value);
        text_add(out, "<tr>");
        code_cell(out, &name);
        code_cell(out, &type_text);
        code_cell(out, &value);
        words_of(r, p, out);
        text_add(out, "</tr>\n");
    }
    text_add(out, "</table>\n");
}

static void augments(const reference *r, const tree_procedure *p, text *out)
{
    for (uint32_t i = 0; i < p->augments.count; i++) {
        const tree_augment *g = p->augments.at[i];
        text head = {.arena = out->arena};
        reference_write_augment_head(g, &head);
        text_add(out, "<p><span class=soft>augmentation</span> <code>");
        escape_all(out, head.at);
        text_add(out, "</code> ");
        prose_all(out, g->head.document);
        text_add(out, "</p>\n");
        bool documented = false;
        for (uint32_t k = 0; k < g->parameters.count; k++)
            documented = documented || g->parameters.at[k]->head.document;
        if (documented)
            parameters(r, "parameter", &g->parameters, out);
    }
}

static void procedure(const reference *r, const tree_procedure *p, text *out)
{
    text head = {.arena = out->arena};
    reference_write_procedure_head(p, &head);
    if (p->traits.count) {
        text_add(&head, " [");
        reference_write_names(&p->traits, ", ", &head);
        text_add(&head, "]");
    }
    text_add(out, "<pre><code>");
    escape_all(out, head.at);
    text_add(out, "</code></pre>\n");
    parameters(r, "parameter", &p->parameters, out);
    parameters(r, "attribute", &p->attributes, out);
    augments(r, p, out);
    for (uint32_t i = 0; i < p->examples.count; i++) {
        text chain = {.arena = out->arena};
        reference_write_chains(p->examples.at[i], "\n", &chain);
        if (p->examples.at[i]->expectations.count) {
            text_add(&chain, "\n// gives ");
            reference_write_expectations(p->examples.at[i], &chain);
        }
        text_add(out, "<pre><code>");
        escape_all(out, chain.at);
        text_add(out, "</code></pre>\n");
    }
}

static void functions(const reference_item *item, text *out)
{
    text examples = {.arena = out->arena};
    text_add(out, "<pre><code>");
    for (uint32_t i = 0; i < item->functions.count; i++) {
        const tree_function *f = item->functions.at[i];
        const char *document = reference_overload_document(item, i);
        if (document) {
            text_add(out, "</code></pre>\n");
            paragraphs(out, document);
            text_add(out, "<pre><code>");
        }
        text head = {.arena = out->arena};
        reference_write_function_head(f, &head);
        escape_all(out, head.at);
        text_add(out, "\n");
        for (uint32_t k = 0; k < f->examples.count; k++) {
            text_add(&examples, "\n");
            lang_write_expression(f->examples.at[k], &examples);
        }
    }
    text_add(out, "</code></pre>\n<pre><code>// examples");
    escape_all(out, examples.at);
    text_add(out, "</code></pre>\n");
}

static void enumeration(const tree_enumeration *e, text *out)
{
    text_add(out, "<table>\n");
    for (uint32_t i = 0; i < e->enumerators.count; i++) {
        text_add(out, "<tr><td><code>");
        escape_all(out, e->enumerators.at[i].name.text);
        text_add(out, "</code></td><td>");
        prose_all(out, e->enumerators.at[i].head.document);
        text_add(out, "</td></tr>\n");
    }
    text_add(out, "</table>\n");
}

/* procedure-geometry-split: where an entry is, for links. */
static void anchor(const reference_item *item, text *out)
{
    text_format(out, "%s-%s-", reference_kind(item), item->library->name);
    escape_all(out, item->name);
}

/* What the filter looks at. */
static void search_words(const reference_item *item, text *out)
{
    text words = {.arena = out->arena};
    text_format(&words, "%s %s %s ", item->name, item->group, item->summary);
    if (item->procedure)
        reference_write_names(&item->procedure->synonyms, " ", &words);
    for (size_t i = 0; i < words.length; i++)
        if (words.at[i] >= 'A' && words.at[i] <= 'Z')
            words.at[i] = (char)(words.at[i] - 'A' + 'a');
    text_add(out, " data-words=\"");
    escape_all(out, words.at);
    text_add(out, "\"");
}

static void write_item(const reference *r, const reference_item *item, text *out)
{
    text_add(out, "<article id=\"");
    anchor(item, out);
    text_add(out, "\"");
    search_words(item, out);
    text_add(out, "><h4><a href=\"#");
    anchor(item, out);
    text_add(out, "\">");
    escape_all(out, item->name);
    text_format(out, "</a>%s <small>%s</small></h4>\n", item->kind == ENTRY_FUNCTION ? "()" : "",
                reference_kind(item));
    paragraphs(out, item->summary);
    paragraphs(out, item->details);
    if (item->procedure)
        procedure(r, item->procedure, out);
    if (item->functions.count)
        functions(item, out);
    if (item->entity)
        parameters(r, "attribute", &item->entity->attributes, out);
    if (item->enumeration)
        enumeration(item->enumeration, out);
    text_format(out, "<p class=soft>%s:%u</p></article>\n", item->path, item->line);
}

/* ---- the page -------------------------------------------------------------------------------- */

/* Headings where a library or a group begins. */
static void write_headings(const reference_item *item, const reference_item *before, bool documents,
                           text *out)
{
    if (!before || before->library != item->library) {
        text_format(out, "<h2>%s</h2>\n", item->library->name);
        if (documents)
            paragraphs(out, item->library->document);
        before = NULL;
    }
    if (!before || strcmp(before->group, item->group)) {
        text_format(out, "<h3>%s", item->kind == ENTRY_FUNCTION ? "functions: " : "");
        escape_all(out, item->group);
        text_add(out, "</h3>\n");
    }
}

void reference_write_html(const reference *r, text *out)
{
    text_add(out, "<!doctype html>\n<html lang=en><meta charset=utf-8>\n"
                  "<meta name=viewport content=\"width=device-width,initial-scale=1\">\n"
                  "<title>pcgc reference</title>\n<style>\n");
    text_add(out, style);
    text_add(out, "</style>\n<body><nav><input type=search placeholder=\"Find a procedure\" "
                  "aria-label=\"Find a procedure\">\n");
    for (uint32_t i = 0; i < r->items.count; i++) {
        const reference_item *item = r->items.at[i];
        write_headings(item, i ? r->items.at[i - 1] : NULL, false, out);
        text_add(out, "<a href=\"#");
        anchor(item, out);
        text_add(out, "\"");
        search_words(item, out);
        text_add(out, ">");
        escape_all(out, item->name);
        text_add(out, "</a>\n");
    }
    text_add(out, "</nav><main>\n<h1>Reference</h1>\n");
    for (uint32_t i = 0; i < r->items.count; i++) {
        write_headings(r->items.at[i], i ? r->items.at[i - 1] : NULL, true, out);
        write_item(r, r->items.at[i], out);
    }
    text_add(out, "</main>\n<script>\n");
    text_add(out, script);
    text_add(out, "</script>\n</html>\n");
}

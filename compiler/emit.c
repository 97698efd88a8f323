/* emit.c - the C of a program: what stands in which order, and how lines are written.
 *
 * Needs order; keeps the program. The text includes nothing: abi.h stands at its head. It is the
 * same for every backend; what only a shared object or an executable needs is under #ifdef at
 * its end. */
#include "../runtime/library_open.h"
#include "emit.h"
#include "library.h"

#include <string.h>

/* ---- lines ----------------------------------------------------------------------------------- */

static void add_unsigned(text *out, unsigned long long number)
{
    char digits[24];
    size_t at = sizeof digits;
    do {
        digits[--at] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    text_add_bytes(out, digits + at, sizeof digits - at);
}

static void add_signed(text *out, long long number)
{
    if (number < 0) {
        text_add_bytes(out, "-", 1);
    }
    add_unsigned(out, number < 0 ? 0 - (unsigned long long)number : (unsigned long long)number);
}

/* Formats are few and lines are many: %s, %u, %d and %lld, with nothing between the sign and its
 * letter. */
static void add_formatted(text *out, const char *format, va_list arguments)
{
    for (const char *at = format; *at;) {
        size_t plain = strcspn(at, "%");
        text_add_bytes(out, at, plain);
        at += plain;
        if (*at == '\0') {
            return;
        }
        at++;
        if (*at == 's') {
            text_add(out, va_arg(arguments, const char *));
        } else if (*at == 'u') {
            add_unsigned(out, va_arg(arguments, unsigned));
        } else if (*at == 'd') {
            add_signed(out, va_arg(arguments, int));
        } else {
            add_signed(out, va_arg(arguments, long long));
            at += 2;
        }
        at++;
    }
}

static void indent(emitter *e)
{
    static const char blanks[] = "                                ";
    size_t width = (size_t)e->depth * 4;
    text_add_bytes(e->out, blanks, width < sizeof blanks - 1 ? width : sizeof blanks - 1);
}

char *emit_name(emitter *e, const char *format, ...)
{
    va_list arguments;
    e->scratch.length = 0;
    va_start(arguments, format);
    add_formatted(&e->scratch, format, arguments);
    va_end(arguments);
    return arena_copy(e->arena, e->scratch.length ? e->scratch.at : "", e->scratch.length);
}

void emit_line(emitter *e, const char *format, ...)
{
    va_list arguments;
    indent(e);
    va_start(arguments, format);
    add_formatted(e->out, format, arguments);
    va_end(arguments);
    text_add_bytes(e->out, "\n", 1);
}

void emit_blank(emitter *e)
{
    text_add_bytes(e->out, "\n", 1);
}

void emit_open(emitter *e, const char *format, ...)
{
    va_list arguments;
    indent(e);
    va_start(arguments, format);
    add_formatted(e->out, format, arguments);
    va_end(arguments);
    text_add(e->out, " {\n");
    e->depth++;
}

void emit_block(emitter *e)
{
    emit_line(e, "{");
    e->depth++;
}

void emit_close(emitter *e, const char *behind)
{
    e->depth--;
    emit_line(e, "}%s", behind);
}

text *emit_capture(emitter *e, text *into)
{
    text *before = e->out;
    *into = (text){.arena = e->arena};
    e->out = into;
    return before;
}

void emit_restore(emitter *e, text *back, const text *captured)
{
    e->out = back;
    if (captured) {
        text_add_bytes(back, captured->at ? captured->at : "", captured->length);
    }
}

/* ---- where lines come from ------------------------------------------------------------------- */

/* A path that stands in a #line directive as it is. */
static bool is_plain(const char *path)
{
    for (; *path; path++) {
        if ((unsigned char)*path < ' ' || *path == '"' || *path == '\\') {
            return false;
        }
    }
    return true;
}

/* A directive that is not final: `number_lines` repeats it before every line that it holds for. */
void emit_place(emitter *e, const span *place)
{
    e->place = place;
    if (!e->options->lines) {
        return;
    }
    if (!place || !place->source || !is_plain(place->source->path)) {
        text_add(e->out, "#line 0\n");
        return;
    }
    uint32_t line, column;
    source_place(place->source, place->from, &line, &column);
    text_format(e->out, "#line %u \"%s\"\n", line, place->source->path);
}

/* What the compiler would call the place of the next line: NULL and the number in this text, or
 * the source's. */
typedef struct line_counter {
    const char *own;        /* this text's name */
    char *wanted, *present; /* file, with its quotes */
    uint32_t wanted_line, present_line, physical;
} line_counter;

static void write_line(text *out, line_counter *n, const char *at, size_t length)
{
    bool same =
        n->wanted == n->present || (n->wanted && n->present && !strcmp(n->wanted, n->present));
    if (!same || (n->wanted && n->wanted_line != n->present_line)) {
        n->physical++;
        if (n->wanted) {
            text_format(out, "#line %u %s\n", n->wanted_line, n->wanted);
        } else {
            text_format(out, "#line %u \"%s\"\n", n->physical, n->own);
        }
        n->present = n->wanted;
        n->present_line = n->wanted_line;
    }
    text_add_bytes(out, at, length);
    n->present_line++;
    n->physical++;
}

static void want_place(arena *a, line_counter *n, const char *at, const char *end)
{
    n->wanted_line = 0;
    for (; at < end && *at >= '0' && *at <= '9'; at++) {
        n->wanted_line = n->wanted_line * 10 + (uint32_t)(*at - '0');
    }
    n->wanted = n->wanted_line ? arena_copy(a, at + 1, (size_t)(end - at - 1)) : NULL;
}

/* Copies `from`, each line with the directive that it needs. */
static void number_lines(emitter *e, const text *from, text *out)
{
    static const char directive[] = "#line ";
    line_counter n = {.own = emit_name(e, "%s.c", e->p->main->symbol), .physical = 1};
    const char *end = from->at + from->length;
    for (const char *at = from->at; at < end;) {
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        if (strncmp(at, directive, sizeof directive - 1) == 0) {
            want_place(e->arena, &n, at + sizeof directive - 1, stop);
        } else {
            write_line(out, &n, at, (size_t)(stop - at) + 1);
        }
        at = stop + 1;
    }
}

/* ---- comments -------------------------------------------------------------------------------- */

/* No byte that ends the comment, begins one inside it, or makes a trigraph. */
static void add_comment_byte(text *out, char c)
{
    char last = out->length ? out->at[out->length - 1] : ' ';
    if ((unsigned char)c <= ' ') {
        c = ' ';
    }
    if (c == ' ' && last == ' ') {
        return;
    }
    if ((c == '/' && last == '*') || (c == '*' && last == '/') || (c == '?' && last == '?')) {
        text_add(out, " ");
    }
    text_add_bytes(out, &c, 1);
}

void emit_comment(emitter *e, const char *words)
{
    text line = {.arena = e->arena};
    for (; *words; words++) {
        add_comment_byte(&line, *words);
    }
    emit_line(e, "/* %s */", line.at ? line.at : "");
}

/* Whether the source there begins with the name, followed by something that is none. */
static bool begins_with(span place, const char *name)
{
    size_t length = strlen(name);
    return place.to - place.from > length &&
           memcmp(place.source->text + place.from, name, length) == 0 &&
           !strchr("_0123456789", place.source->text[place.from + length]);
}

void emit_node_comment(emitter *e, const node *n)
{
    enum { LONGEST = 90 };
    span place = n->tree ? n->tree->span : n->gate ? n->gate->head.span : (span){0};
    uint32_t end = place.source ? place.to : 0;
    text words = {.arena = e->arena};
    if (!n->gate && !(place.source && begins_with(place, n->name))) {
        text_format(&words, "%s: ", n->name);
    }
    if (end > place.from + LONGEST) {
        end = place.from + LONGEST;
        while (((unsigned char)place.source->text[end] & 0xC0) == 0x80) {
            end--; /* no half character */
        }
    }
    if (place.source) {
        text_add_bytes(&words, place.source->text + place.from, end - place.from);
        text_add(&words, end < place.to ? " …" : "");
    }
    emit_comment(e, words.at ? words.at : "");
}

/* ---- long functions -------------------------------------------------------------------------- */

static void begin_part(emitter *e, series *s)
{
    s->items = 0;
    e->variables = 0;
    e->uses_call = false;
    e->part.length = 0;
    e->out = &e->part;
    e->depth = 1;
}

static void write_part(emitter *e, series *s, const char *name)
{
    e->depth = 0;
    e->out = s->outer;
    emit_line(e, "static %s %s(struct %s *g)", s->fails ? "int" : "void", name, e->form->tag);
    emit_block(e);
    if (e->uses_call) {
        emit_line(e, "pcg_call call;");
        emit_line(e, "pcg_begin(&call, &g->frame, %s, &g->own);", emit_node_reference(e, NULL));
    }
    if (e->part.length == 0) {
        emit_line(e, "(void)g;");
    }
    emit_restore(e, e->out, &e->part);
    if (s->fails) {
        emit_line(e, "return PCG_OK;");
    }
    emit_close(e, "\n");
}

static void write_numbered_part(emitter *e, series *s)
{
    const char *wish = emit_name(e, "%s_%u", s->name, s->parts.count + 1);
    const char *name = emit_unique(e->arena, &e->globals, wish);
    LIST_ADD(e->arena, &s->parts, name);
    write_part(e, s, name);
}

void emit_series_begin(emitter *e, series *s)
{
    s->outer = e->out;
    begin_part(e, s);
}

void emit_series_item(emitter *e, series *s, uint32_t items)
{
    if (s->items > 0 &&
        (s->items + items > EMIT_FUNCTION_ITEMS || e->variables > EMIT_SERIES_VARIABLES)) {
        write_numbered_part(e, s);
        begin_part(e, s);
    }
    s->items += items;
}

void emit_series_end(emitter *e, series *s)
{
    if (s->parts.count > 0) {
        write_numbered_part(e, s);
        begin_part(e, s);
        for (uint32_t i = 0; i < s->parts.count; i++) {
            emit_line(e, s->fails ? "PCG_TRY(%s(g));" : "%s(g);", s->parts.at[i]);
        }
    }
    write_part(e, s, s->name);
}

/* ---- what the program uses ------------------------------------------------------------------- */

typedef struct lookup {
    compilation *c;
    program *p;
} lookup;

static bool is_enumeration(void *context, const char *name)
{
    const lookup *l = context;
    return find_enumeration(l->c, l->p, name) != NULL;
}

static bool is_entity(void *context, const char *name)
{
    const lookup *l = context;
    return find_entity_type(l->c, l->p, name) != NULL;
}

/* Kernels of other libraries are called by address: their names stand for their types. */
static const char *kernel_prefix(const pcg_library *l)
{
    return library_is_builtin(l) ? "" : "typedef ";
}

static void list_kernel(emitter *e, const pcg_library *l, const char *symbol)
{
    if (!library_is_builtin(l)) {
        const pcg_kernel_info info = {l->name, symbol, library_find_symbol(l, symbol)->layout};
        LIST_ADD(e->arena, &e->kernels, info);
    }
}

/* Those that the program must find before it runs, by their numbers. */
static void list_kernels(emitter *e)
{
    for (uint32_t i = 0; i < e->p->procedures.count; i++) {
        list_kernel(e, e->p->procedures.at[i]->library, e->p->procedures.at[i]->symbol);
    }
    for (uint32_t i = 0; i < e->p->functions.count; i++) {
        list_kernel(e, e->p->functions.at[i]->library, e->p->functions.at[i]->symbol);
    }
    for (uint32_t i = 0; i < e->kernels.count; i++) {
        uint32_t *number = ARENA_NEW(e->arena, uint32_t);
        *number = i;
        table_put(e->arena, &e->kernel_numbers, e->kernels.at[i].symbol, number);
    }
}

const char *emit_kernel_name(emitter *e, const char *symbol, const char *call)
{
    const uint32_t *number = table_get(&e->kernel_numbers, symbol);
    return number ? arena_format(e->arena, "PCG_KERNEL(%s, %s, %u)", symbol, call, *number)
                  : symbol;
}

static void emit_interfaces(emitter *e)
{
    const program *p = e->p;
    lookup l = {e->c, (program *)(uintptr_t)p}; /* which only notes what it understood */
    const interface_types types = {&l, is_enumeration, is_entity};
    text declared = {.arena = e->arena};
    for (uint32_t i = 0; i < p->procedures.count; i++) {
        const procedure *f = p->procedures.at[i];
        interface_write_procedure(&declared, f->library->name, f->tree, kernel_prefix(f->library),
                                  &types);
        text_add(&declared, "\n");
    }
    for (uint32_t i = 0; i < p->functions.count; i++) {
        const function *f = p->functions.at[i];
        interface_write_function(&declared, f->library->name, f->tree, kernel_prefix(f->library),
                                 &types);
    }
    text_add(e->out, "/* ---- enumerations, procedures and functions ---- */\n\n");
    for (uint32_t i = 0; i < p->enumerations.count; i++) {
        const enumeration *n = p->enumerations.at[i];
        interface_write_enumeration(e->out, n->library, n->tree);
    }
    emit_blank(e);
    emit_restore(e, e->out, &declared);
    emit_blank(e);
}

/* ---- the pass -------------------------------------------------------------------------------- */

static void emit_head(emitter *e)
{
    emit_line(e, "/* %s.c - the graph %s in C, made by pcgc %s. It needs libpcgrt to run. */",
              e->p->main->symbol, e->p->main->symbol, e->options->version);
    emit_line(e, "/* ---- the runtime ---- */\n");
    text_add(e->out, pcg_abi_text);
    emit_line(e, "#if defined(__TINYC__)");
    emit_line(e, "#define PCG_OFFSET(type, field) ((pcg_u32)(pcg_u64)&((type *)0)->field)");
    emit_line(e, "#else");
    emit_line(e, "#define PCG_OFFSET(type, field) ((pcg_u32)__builtin_offsetof(type, field))");
    emit_line(e, "#endif\n");
}

static void emit_graph_functions(emitter *e)
{
    const graph *g = e->form->graph;
    emit_find_flows(e);
    for (uint32_t i = 0; i < g->node_count; i++) {
        e->node = g->order[i];
        if (emit_takes_part(e, e->node)) {
            emit_node(e);
        }
    }
    e->node = NULL;
    emit_wire(e);
    emit_start(e);
    emit_change(e);
    emit_flow_functions(e);
    emit_run(e);
}

/* A frame's functions are called by the nodes that encapsulate the graph, which may stand before
 * them. */
static void declare_graph(emitter *e)
{
    emit_line(e, "struct %s;", e->form->tag);
    emit_line(e, "static void %s(struct %s *g);", e->form->wire, e->form->tag);
    emit_line(e, "static int %s(struct %s *g);", e->form->start, e->form->tag);
    emit_line(e, "static int %s(struct %s *g);", e->form->run, e->form->tag);
    if (e->form->change) {
        emit_line(e, "static int %s(struct %s *g);", e->form->change, e->form->tag);
    }
}

static void for_each_form(emitter *e, const char *what, void (*write)(emitter *e))
{
    for (uint32_t i = 0; i < e->forms.count; i++) {
        e->form = e->forms.at[i];
        if (what) {
            emit_line(e, "/* ---- graph %s%s: %s ---- */\n", e->form->graph->symbol,
                      e->form->main ? ", the main one" : "", what);
        }
        write(e);
    }
    e->form = NULL;
}

/* What the text is about to take, so that it need not move as it grows. */
enum { BYTES_AT_FIRST = 64 << 10, BYTES_OF_NODE = 2048 };

void emit(compilation *c, const program *p, const emit_options *o, text *out)
{
    emitter e = {.c = c, .p = p, .options = o, .arena = &c->arena, .call = "&call"};
    e.scratch.arena = e.part.arena = e.block.arena = e.arena;
    text body = {.arena = e.arena,
                 .capacity = BYTES_AT_FIRST + (size_t)p->node_count * BYTES_OF_NODE};
    body.at = arena_alloc(e.arena, body.capacity);
    e.out = &body;
    list_kernels(&e);
    emit_head(&e);
    emit_interfaces(&e);
    emit_names(&e);
    emit_node_table(&e);
    for_each_form(&e, NULL, declare_graph);
    emit_blank(&e);
    for_each_form(&e, "what it holds", emit_frames);
    emit_tables(&e);
    for_each_form(&e, NULL, emit_about);
    for_each_form(&e, NULL, emit_seen_graph);
    for_each_form(&e, NULL, emit_surrogate_tables);
    for_each_form(&e, "what it does", emit_graph_functions);
    emit_module(&e);
    emit_condition_functions(&e);
    number_lines(&e, &body, out);
}

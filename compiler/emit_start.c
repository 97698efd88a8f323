/* emit_start.c - what is evaluated when an execution of a graph starts: parameters that were not
 * given, constants, defaults of attributes, arguments that are the same in every round, edges
 * that are open while a condition holds. */
#include "emit.h"

/* ---- parameters and constants, each behind what it reads ------------------------------------- */

enum { NOT_YET, UNDER_WAY, DEFINED };

/* The parameters of a graph, then its constants, by number. */
typedef struct definitions {
    const graph *graph;
    uint8_t *state;
    uint32_t *stack, depth, count;
} definitions;

#define NO_DEFINITION UINT32_MAX

static const value *definition_value(const definitions *d, uint32_t i)
{
    uint32_t parameters = d->graph->parameter_count;
    return i < parameters ? d->graph->parameters[i].initial
                          : d->graph->constants[i - parameters].value;
}

/* The first thing that the value reads and that is not defined. */
static uint32_t next_missing(const definitions *d, const value *v)
{
    uint32_t i = NO_DEFINITION;
    if (v->kind == VALUE_PARAMETER) {
        i = (uint32_t)(v->parameter - d->graph->parameters);
    } else if (v->kind == VALUE_CONST) {
        i = d->graph->parameter_count + (uint32_t)(v->constant - d->graph->constants);
    }
    if (i < d->count && d->state[i] == NOT_YET) {
        return i;
    }
    for (i = 0; i < v->count; i++) {
        uint32_t missing = next_missing(d, v->operands[i]);
        if (missing != NO_DEFINITION) {
            return missing;
        }
    }
    return NO_DEFINITION;
}

static void define_parameter(emitter *e, const parameter *p)
{
    const char *name = e->form->names->parameters[p->index];
    emit_open(e, "if (!g->given.%s)", name);
    emit_place(e, &p->initial->span);
    emit_assign(e, emit_name(e, "g->parameter.%s", name), &p->type, p->initial, true);
    emit_place(e, NULL);
    emit_close(e, "");
}

static void define_constant(emitter *e, const constant *k)
{
    emit_place(e, &k->value->span);
    emit_assign(e, emit_name(e, "g->constant.%s", e->form->names->constants[k->index]), &k->type,
                k->value, true);
    emit_place(e, NULL);
}

static void define(emitter *e, definitions *d, series *s, uint32_t i)
{
    uint32_t parameters = d->graph->parameter_count;
    emit_series_item(e, s, 1);
    if (i < parameters) {
        define_parameter(e, &d->graph->parameters[i]);
    } else {
        define_constant(e, &d->graph->constants[i - parameters]);
    }
    d->state[i] = DEFINED;
}

static void push(definitions *d, uint32_t i)
{
    d->state[i] = UNDER_WAY;
    d->stack[d->depth++] = i;
}

/* All of them; or the constants alone, where parameters stay what they are. */
static void emit_definitions(emitter *e, series *s, bool parameters)
{
    const graph *g = e->form->graph;
    definitions d = {.graph = g, .count = g->parameter_count + g->constant_count};
    d.state = ARENA_ARRAY(e->arena, uint8_t, d.count);
    d.stack = ARENA_ARRAY(e->arena, uint32_t, d.count);
    for (uint32_t i = 0; i < g->parameter_count && !parameters; i++) {
        d.state[i] = DEFINED;
    }
    for (uint32_t i = 0; i < d.count; i++) {
        if (d.state[i] == NOT_YET) {
            push(&d, i);
        }
        while (d.depth > 0) {
            uint32_t top = d.stack[d.depth - 1];
            uint32_t missing = next_missing(&d, definition_value(&d, top));
            if (missing != NO_DEFINITION) {
                push(&d, missing);
            } else {
                define(e, &d, s, top);
                d.depth--;
            }
        }
    }
}

static void emit_defaults(emitter *e, series *s)
{
    const graph *g = e->form->graph;
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        const attribute *a = &g->attributes[i];
        emit_series_item(e, s, 1);
        emit_place(e, &a->initial->span);
        emit_cells(e, emit_name(e, "g->initial.%s", e->form->names->attributes[a->index]),
                   a->initial);
        emit_place(e, NULL);
    }
}

/* ---- edges and blocks with a condition ------------------------------------------------------- */

static void emit_edge(emitter *e, const edge *k, const char *out, const char *to)
{
    const char *queue = emit_queue(e, k->to);
    if (!k->condition) {
        emit_line(e, "n->%s[n->%s.count++] = &%s;", to, out, queue);
        return;
    }
    emit_place(e, &k->condition->span);
    operand open = emit_value(e, k->condition);
    emit_line(e, "if (%s)", open.text);
    emit_line(e, "    n->%s[n->%s.count++] = &%s;", to, out, queue);
    emit_place(e, NULL);
}

static void emit_dynamic_port(emitter *e, const port *p)
{
    const node_names *names = names_of(e, p->node);
    const char *out = names->outputs[p->index], *to = names->leads[p->index];
    const char *spare = emit_has_open_edge(p) ? NULL : emit_spare_queue(e, p);
    if (p->edge_count == 0 && !spare) {
        return;
    }
    emit_line(e, "n->%s.count = 0;", out);
    for (uint32_t i = 0; i < p->edge_count; i++) {
        emit_edge(e, p->edges[i], out, to);
    }
    if (spare) {
        emit_line(e, "if (n->%s.count == 0)", out);
        emit_line(e, "    n->%s[n->%s.count++] = &%s;", to, out, spare);
    }
    if (p->blocked_if) {
        emit_place(e, &p->blocked_if->span);
        operand blocked = emit_value(e, p->blocked_if);
        emit_line(e, "if (%s)", blocked.text);
        emit_line(e, "    n->%s.count = 0;", out);
        emit_place(e, NULL);
    }
}

static bool has_dynamic_port(const node *n)
{
    for (uint32_t i = 0; i < n->output_count; i++) {
        if (!n->outputs[i].blocked && emit_is_dynamic(&n->outputs[i])) {
            return true;
        }
    }
    return false;
}

/* Whether an edge to a source's impulse is open, which makes it no source. */
static void emit_trigger(emitter *e, const port *impulse)
{
    emit_line(e, "n->triggered = %d;", emit_has_open_edge(impulse));
    for (uint32_t i = 0; i < impulse->edge_count && !emit_has_open_edge(impulse); i++) {
        operand open = emit_value(e, impulse->edges[i]->condition);
        emit_line(e, "if (%s)", open.text);
        emit_line(e, "    n->triggered = 1;");
    }
}

/* ---- nodes ----------------------------------------------------------------------------------- */

static bool is_once(const value *v)
{
    return !emit_is_per_round(v) && !emit_is_fixed(v);
}

static void emit_preparation(emitter *e, const node *n)
{
    emit_arguments(e, is_once);
    emit_place(e, NULL);
    for (uint32_t i = 0; i < n->output_count; i++) {
        if (!n->outputs[i].blocked && emit_is_dynamic(&n->outputs[i])) {
            emit_dynamic_port(e, &n->outputs[i]);
        }
    }
    if (emit_impulse(n)) {
        emit_trigger(e, emit_impulse(n));
    }
}

/* What of it follows a change of a parameter. */
static void emit_arguments_again(emitter *e, const node *n)
{
    (void)n;
    emit_arguments(e, is_once);
    emit_place(e, NULL);
}

static bool needs_preparation(const node *n, bool again)
{
    return emit_has_arguments(n, is_once) || (!again && (has_dynamic_port(n) || emit_impulse(n)));
}

/* A block of its own, whose errors are the node's. */
static void emit_node_block(emitter *e, const node *n, void (*prepare)(emitter *, const node *))
{
    text *before = e->out;
    bool used_before = e->uses_call;
    e->uses_call = false;
    e->block.length = 0;
    e->out = &e->block;
    e->depth++;
    prepare(e, n);
    e->depth--;
    e->out = before;
    emit_block(e);
    emit_line(e, "struct %s *n = &%s;", e->form->functions[n->index], emit_node_path(e, n));
    if (e->uses_call) {
        emit_line(e, "pcg_begin(&call, &g->frame, %s, &n->self%s);", emit_node_reference(e, n),
                  emit_instance(n));
    }
    emit_restore(e, e->out, &e->block);
    emit_close(e, "");
    e->uses_call |= used_before;
}

static void emit_nodes(emitter *e, series *s, bool again)
{
    const graph *g = e->form->graph;
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        if (!emit_takes_part(e, n)) {
            continue;
        }
        e->node = n;
        if (n->kind == NODE_GRAPH) {
            emit_series_item(e, s, 1);
            emit_line(e, "%s.stale = 1;", emit_node_path(e, n));
        }
        if (n->kind == NODE_SURROGATE) {
            emit_series_item(e, s, 1);
            emit_line(e, "%s.self.execution++;", emit_node_path(e, n));
        }
        if (needs_preparation(n, again)) {
            emit_series_item(e, s, 4);
            emit_node_block(e, n, again ? emit_arguments_again : emit_preparation);
        }
    }
    e->node = NULL;
}

void emit_start(emitter *e)
{
    series s = {.name = e->form->start, .fails = true};
    emit_series_begin(e, &s);
    emit_definitions(e, &s, true);
    emit_defaults(e, &s);
    emit_nodes(e, &s, false);
    emit_series_end(e, &s);
}

void emit_change(emitter *e)
{
    series s = {.name = e->form->change, .fails = true};
    if (!s.name) {
        return;
    }
    emit_series_begin(e, &s);
    emit_definitions(e, &s, false);
    emit_nodes(e, &s, true);
    emit_series_end(e, &s);
}

/* emit_surrogate.c - surrogates: the tables that say what their braces declare and what they may
 * choose, and the functions of their nodes.
 *
 * A round evaluates the name, what is handed over, and enters; all else the runtime does, since
 * what is run is known only then. */
#include "emit.h"

#include <string.h>

static const tree_body no_body;

static const tree_body *body_of(const node *n)
{
    return n->tree->body ? n->tree->body : &no_body;
}

/* ---- candidates ------------------------------------------------------------------------------ */

const graph *emit_candidate(const node *n, uint32_t *next, const char **name)
{
    const table *known = &n->owner->unit->names;
    while (!n->target && *next < known->entries.count) {
        const graph *g = known->entries.at[*next].value;
        if (name) {
            *name = known->entries.at[*next].key;
        }
        (*next)++;
        if (g->tree) {
            return g;
        }
    }
    if (!n->target || (*next)++ > 0) {
        return NULL;
    }
    if (name) {
        *name = n->arguments[0].value->string;
    }
    return n->target;
}

/* ---- tables ---------------------------------------------------------------------------------- */

static const char *table_of(emitter *e, const node *n, const char *what)
{
    return emit_name(e, "surrogate_%s_%s", e->form->functions[n->index], what);
}

const char *emit_bases(emitter *e, const type *t)
{
    text all = {.arena = e->arena};
    text_add(&all, "");
    for (const entity_type *of = t->entity; of; of = of->parent) {
        text_format(&all, "%s%s", all.length ? "\n" : "", of->name);
    }
    return emit_string(e, all.at);
}

static void emit_declared(emitter *e, const char *name, const type *t, span place)
{
    uint32_t line = 0, column = 0;
    if (place.source) {
        source_place(place.source, place.from, &line, &column);
    }
    emit_line(e, "{%s, %s, %s, %u},", emit_string(e, name), emit_string(e, type_text(e->arena, t)),
              t->kind == TYPE_ENTITY ? emit_bases(e, t) : "0", line);
}

static void open_table(emitter *e, const node *n, const char *row, const char *what,
                       uint32_t count)
{
    emit_open(e, "static const %s %s[%u] =", row, table_of(e, n, what), count);
}

static void emit_port_table(emitter *e, const node *n, const char *what, const port *ports,
                            const tree_gates *trees)
{
    if (trees->count == 0) {
        return;
    }
    open_table(e, n, "pcg_declared", what, trees->count);
    for (uint32_t i = 0; i < trees->count; i++) {
        emit_declared(e, ports[i].name, &ports[i].type, trees->at[i]->name.span);
    }
    emit_close(e, ";");
}

static void emit_value_tables(emitter *e, const node *n)
{
    const tree_body *b = body_of(n);
    if (b->parameters.count > 0) {
        open_table(e, n, "pcg_declared", "parameters", b->parameters.count);
        for (uint32_t i = 0; i < b->parameters.count; i++) {
            const formal *f = n->arguments[n->procedure->parameter_count + i].formal;
            emit_declared(e, f->name, &f->type, b->parameters.at[i]->name.span);
        }
        emit_close(e, ";");
    }
    if (n->link_count > 0) {
        open_table(e, n, "pcg_declared", "attributes", n->link_count);
        for (uint32_t i = 0; i < n->link_count; i++) {
            emit_declared(e, n->links[i].name, &n->links[i].type, b->attributes.at[i]->name.span);
        }
        emit_close(e, ";");
    }
}

static uint32_t emit_candidate_table(emitter *e, const node *n)
{
    const char *name;
    uint32_t count = 0, next = 0;
    while (emit_candidate(n, &next, NULL)) {
        count++;
    }
    if (count == 0) {
        return 0;
    }
    open_table(e, n, "pcg_candidate", "candidates", count);
    next = 0;
    for (const graph *g = emit_candidate(n, &next, &name); g; g = emit_candidate(n, &next, &name)) {
        emit_line(e, "{%s, &choice_%u},", emit_string(e, name), g->index);
    }
    emit_close(e, ";");
    return count;
}

static uint32_t number_of(const port *ports, uint32_t count, const char *name)
{
    uint32_t i = 0;
    while (i < count && strcmp(ports[i].name, name) != 0) {
        i++;
    }
    return i;
}

static void emit_loop_table(emitter *e, const node *n)
{
    const tree_body *b = body_of(n);
    if (b->loops.count == 0) {
        return;
    }
    open_table(e, n, "pcg_loop", "loops", b->loops.count);
    for (uint32_t i = 0; i < b->loops.count; i++) {
        const tree_loop *l = b->loops.at[i];
        emit_line(e, "{%u, %u},", number_of(n->outputs, n->output_count, l->from.text),
                  number_of(n->inputs, n->input_count, l->to.text));
    }
    emit_close(e, ";");
}

static const char *kind_of(const node *n)
{
    static const char *const kinds[][2] = {{"dynamic", "PCG_SURROGATE_DYNAMIC"},
                                           {"iterate", "PCG_SURROGATE_ITERATE"},
                                           {"parallel", "PCG_SURROGATE_PARALLEL"},
                                           {"cache", "PCG_SURROGATE_CACHE"},
                                           {"profile", "PCG_SURROGATE_PROFILE"}};
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        if (strcmp(kinds[i][0], n->procedure->name) == 0) {
            return kinds[i][1];
        }
    }
    return kinds[0][1];
}

static const char *table_or_none(emitter *e, const node *n, const char *what, uint32_t count)
{
    return count > 0 ? table_of(e, n, what) : "0";
}

static void emit_info(emitter *e, const node *n, uint32_t candidates)
{
    const tree_body *b = body_of(n);
    uint32_t rest = 0;
    while (rest < b->outputs.count && !b->outputs.at[rest]->gathers) {
        rest++;
    }
    emit_open(e, "static const pcg_surrogate_info %s =", table_of(e, n, "info"));
    emit_line(e, "%s, %u,", kind_of(n), n->owner->cells);
    emit_line(e, "%s, %s,", table_or_none(e, n, "inputs", b->inputs.count),
              table_or_none(e, n, "outputs", b->outputs.count));
    emit_line(e, "%s, %s,", table_or_none(e, n, "parameters", b->parameters.count),
              table_or_none(e, n, "attributes", n->link_count));
    emit_line(e, "%s, %s,", table_or_none(e, n, "candidates", candidates),
              table_or_none(e, n, "loops", b->loops.count));
    emit_line(e, "%u, %u, %u, %u, %u, %u,", b->inputs.count, b->outputs.count, b->parameters.count,
              n->link_count, candidates, b->loops.count);
    emit_line(e, "%s, %s,",
              rest < b->outputs.count ? emit_name(e, "%u", rest) : "PCG_NO_REST",
              emit_string(e, n->way ? n->way : ""));
    emit_line(e, "%s, %s", emit_string(e, n->before), emit_string(e, n->behind));
    emit_close(e, ";\n");
}

void emit_surrogate_tables(emitter *e)
{
    const graph *g = e->form->graph;
    for (uint32_t i = 0; i < g->node_count; i++) {
        const node *n = g->nodes[i];
        if (n->kind != NODE_SURROGATE || !emit_takes_part(e, n)) {
            continue;
        }
        emit_port_table(e, n, "inputs", n->inputs, &body_of(n)->inputs);
        emit_port_table(e, n, "outputs", n->outputs, &body_of(n)->outputs);
        emit_value_tables(e, n);
        emit_loop_table(e, n);
        emit_info(e, n, emit_candidate_table(e, n));
    }
}

/* ---- its struct ------------------------------------------------------------------------------ */

void emit_surrogate_fields(emitter *e, const node *n)
{
    emit_line(e, "pcg_surrogate self;");
    emit_line(e, "const char *chosen;");
    for (uint32_t i = n->procedure->parameter_count; i < n->argument_count; i++) {
        emit_line(e, "pcg_cell given_%u[%u];", i - n->procedure->parameter_count,
                  type_cells(&n->arguments[i].formal->type));
    }
    if (n->output_count > 0) {
        emit_line(e, "const pcg_port *declared_outputs[%u];", n->output_count);
    }
    if (n->link_count > 0) {
        emit_line(e, "const pcg_slot *declared_links[%u];", n->link_count);
    }
}

/* As in a node that encapsulates the graph: then it is started anew in each round. */
static bool is_given_each_round(const node *n)
{
    for (uint32_t i = n->procedure->parameter_count; i < n->argument_count; i++) {
        if (emit_is_per_round(n->arguments[i].value)) {
            return true;
        }
    }
    return false;
}

void emit_surrogate_wire(emitter *e, const node *n)
{
    emit_line(e, "n->self.info = &%s;", table_of(e, n, "info"));
    emit_line(e, "n->self.each_round = %d;", is_given_each_round(n));
    for (uint32_t i = 0; i < n->output_count; i++) {
        emit_line(e, "n->declared_outputs[%u] = &n->%s;", i, names_of(e, n)->outputs[i]);
    }
    for (uint32_t i = 0; i < n->link_count; i++) {
        const attribute_link *l = &n->links[i];
        if (l->kind != LINK_NONE && l->to) {
            emit_line(e, "n->declared_links[%u] = &g->attribute.%s;", i,
                      e->form->names->attributes[l->to->index]);
        }
    }
    if (n->output_count > 0) {
        emit_line(e, "n->self.outputs = n->declared_outputs;");
    }
    if (n->link_count > 0) {
        emit_line(e, "n->self.links = n->declared_links;");
    }
}

/* ---- a round --------------------------------------------------------------------------------- */

static const argument *argument_named(const node *n, const char *name)
{
    for (uint32_t i = 0; i < n->procedure->parameter_count; i++) {
        if (strcmp(n->arguments[i].formal->name, name) == 0) {
            return &n->arguments[i];
        }
    }
    return NULL;
}

/* What the surrogate itself is given: which graph, and how it is run. */
static void choose(emitter *e, const node *n)
{
    const argument *a = argument_named(n, "graph");
    emit_place(e, a->given ? &a->value->span : NULL);
    emit_assign(e, "n->chosen", &a->formal->type, a->value, false);
    emit_place(e, &n->span);
    emit_line(e, "PCG_TRY(pcg_surrogate_choose(&call, &n->self, n->chosen));");
    emit_place(e, NULL);
    static const char *const own[] = {"times", "index", "threads", "where"};
    for (size_t i = 0; i < COUNT_OF(own); i++) {
        const argument *of = argument_named(n, own[i]);
        if (of) {
            emit_place(e, of->given ? &of->value->span : NULL);
            emit_assign(e, emit_name(e, "n->self.%s", own[i]), &of->formal->type, of->value, false);
            emit_place(e, NULL);
        }
    }
}

static const char *cells_of(emitter *e, const type *t)
{
    const char *cells = emit_name(e, "t%u", ++e->variables);
    emit_line(e, "pcg_cell %s[%u];", cells, type_cells(t));
    return cells;
}

static void give(emitter *e, const node *n)
{
    uint32_t first = n->procedure->parameter_count;
    for (uint32_t i = first; i < n->argument_count; i++) {
        const argument *a = &n->arguments[i];
        const char *cells = emit_name(e, "n->given_%u", i - first);
        emit_place(e, a->given ? &a->value->span : NULL);
        emit_cells(e, cells, a->value);
        emit_line(e, "PCG_TRY(pcg_surrogate_set(&call, &n->self, %u, %s));", i - first, cells);
        emit_place(e, NULL);
    }
}

static void hand_in(emitter *e, const node *n, const char *entity)
{
    for (uint32_t i = 0; i < n->link_count; i++) {
        const attribute_link *l = &n->links[i];
        if (!l->in && l->kind != LINK_SHARE) {
            continue;
        }
        const char *cells = cells_of(e, &l->type);
        if (l->in) {
            emit_place(e, &l->in->span);
            emit_cells(e, cells, l->in);
            emit_place(e, NULL);
        } else {
            const char *from = emit_name(e, "%s_from", cells);
            emit_line(e, "const pcg_cell *%s = pcg_get(%s, &g->attribute.%s);", from, entity,
                      e->form->names->attributes[l->to->index]);
            emit_convert_cells(e, cells, &l->type, from, &l->to->type);
        }
        emit_line(e, "pcg_surrogate_hand_in(&call, &n->self, %u, %s, %s);", i, entity, cells);
    }
}

static void enter(emitter *e, const port *p, const char *entity)
{
    const char *before = e->entities[p->index];
    emit_line(e, "PCG_TRY(pcg_surrogate_admit(&call, &n->self, %s));", entity);
    e->entities[p->index] = entity;
    hand_in(e, p->node, entity);
    e->entities[p->index] = before;
    emit_line(e, "PCG_TRY(pcg_surrogate_enter(&call, &n->self, %u, %s));", p->index, entity);
}

static void enter_ports(emitter *e, const node *n)
{
    for (uint32_t i = 0; i < n->input_count; i++) {
        const char *queue = names_of(e, n)->inputs[i];
        if (!n->inputs[i].collective) {
            enter(e, &n->inputs[i], e->entities[i]);
            continue;
        }
        emit_open(e, "while (PCG_READY(n->%s))", queue);
        emit_line(e, "pcg_entity *each = PCG_TAKE(n->%s);", queue);
        enter(e, &n->inputs[i], "each");
        emit_close(e, "");
    }
}

/* Sources descend from the impulse, with the attributes that are handed in. */
static const char *enter_impulse(emitter *e, const node *n, const port *impulse)
{
    const char *entity = e->entities[0];
    bool always = emit_has_open_edge(impulse);
    if (!always) {
        emit_open(e, "if (%s)", entity);
    }
    emit_line(e, "PCG_TRY(pcg_surrogate_admit(&call, &n->self, %s));", entity);
    hand_in(e, n, entity);
    if (!always) {
        emit_close(e, "");
    }
    return always ? entity : emit_name(e, "%s ? %s : g->impulse", entity, entity);
}

static bool reads_entity(const node *n)
{
    for (uint32_t i = 0; i < n->argument_count; i++) {
        if (n->arguments[i].value->reads_entity) {
            return true;
        }
    }
    return false;
}

static void emit_round(emitter *e, const node *n)
{
    const port *impulse = emit_impulse(n);
    const char *from = "g->impulse";
    if (impulse) {
        emit_take_impulse(e, impulse, reads_entity(n));
    } else if (n->input_count > 0) {
        emit_take_entities(e, n);
        from = "0";
    } else {
        emit_line(e, "PCG_TRY(pcg_round(&call, g->impulse));");
    }
    choose(e, n);
    give(e, n);
    emit_seen(e, "n");
    if (impulse) {
        from = enter_impulse(e, n, impulse);
    } else {
        enter_ports(e, n);
    }
    emit_place(e, &n->span);
    emit_line(e, "PCG_TRY(pcg_surrogate_run(&call, &n->self, %s));", from);
    emit_place(e, NULL);
    emit_seen_end(e);
    if (impulse) {
        emit_drop_impulse(e, impulse);
    }
}

/* What was put off may have fed the node itself. */
static void emit_finish(emitter *e, const node *n, bool once)
{
    emit_place(e, &n->span);
    emit_line(e, "PCG_TRY(pcg_surrogate_finish(&call, &n->self));");
    emit_place(e, NULL);
    if (!once) {
        emit_close(e, emit_name(e, " while (%s);", emit_ready(e, n)));
    }
}

void emit_surrogate(emitter *e)
{
    const node *n = e->node;
    bool once = n->input_count == 0 || emit_is_collective(n);
    bool put_off = !strcmp(n->procedure->name, "parallel");
    emit_node_open(e, e->form->functions[n->index], "");
    emit_begin(e);
    if (put_off && !once) {
        emit_open(e, "do");
    }
    if (once) {
        emit_block(e);
    } else {
        emit_open(e, "do");
    }
    emit_round(e, n);
    emit_close(e, once ? "" : emit_name(e, " while (%s);", emit_ready(e, n)));
    if (put_off) {
        emit_finish(e, n, once);
    }
    emit_line(e, "return PCG_OK;");
    emit_close(e, "\n");
}

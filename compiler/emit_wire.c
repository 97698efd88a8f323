/* emit_wire.c - what is filled into a frame when it is made, and never changes: attributes'
 * slots, ports and the queues that they lead to, augmentations, arguments that are literals. */
#include "emit.h"

/* ---- attributes ------------------------------------------------------------------------------ */

static void wire_attribute(emitter *e, const attribute *a)
{
    const char *name = e->form->names->attributes[a->index];
    emit_line(e, "g->attribute.%s.cell = (int)g->frame.base + %u;", name, a->cell);
    emit_line(e, "g->attribute.%s.kind = %s;", name, emit_kind(&a->type));
    emit_line(e, "g->attribute.%s.initial = g->initial.%s;", name, name);
    if (type_is(&a->type, PCG_LIST)) {
        emit_line(e, "g->attribute.%s.element = %s;", name, emit_kind(a->type.element));
    }
}

/* A slot that leads nowhere still has something to read. */
static void wire_unlinked(emitter *e, const char *to, const type *t)
{
    const char *nothing = emit_name(e, "t%u", ++e->variables);
    if (type_is(t, PCG_LIST)) {
        emit_line(e, "static const pcg_list %s_list = {0, 1, {{.i = 0}}};", nothing);
        emit_line(e, "static const pcg_cell %s[1] = {{.list = &%s_list}};", nothing, nothing);
    } else {
        emit_line(e, "static const pcg_cell %s[%u] = {{%s}};", nothing, type_cells(t),
                  type_is_text(t) ? ".s = \"\"" : ".i = 0");
    }
    emit_line(e, "%s.cell = -1;", to);
    emit_line(e, "%s.kind = %s;", to, emit_kind(t));
    emit_line(e, "%s.initial = %s;", to, nothing);
    if (type_is(t, PCG_LIST)) {
        emit_line(e, "%s.element = %s;", to, emit_kind(t->element));
    }
}

/* The attributes of a procedure, or of one of its augmentations, which stand in the struct `in`. */
static void wire_links(emitter *e, const char *in, const attribute_link *links, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const attribute_link *l = &links[i];
        const char *to = emit_name(e, "%s.%s", in, interface_field(e->arena, l->name));
        if (l->kind == LINK_NONE || !l->to) {
            wire_unlinked(e, to, &l->type);
        } else {
            emit_line(e, "%s = g->attribute.%s;", to, e->form->names->attributes[l->to->index]);
        }
    }
}

/* ---- procedures ------------------------------------------------------------------------------ */

static void wire_items(emitter *e, const node *n)
{
    const procedure *f = n->procedure;
    for (uint32_t i = 0; i < n->item_count; i++) {
        const argument_item *item = &n->items[i];
        const char *at = emit_name(e, "n->items[%u]", i);
        emit_line(
            e, "%s.kind = %s;", at,
            interface_kind_constant(e->arena, f->library->name, f->name, item->augment->name));
        emit_line(e, "%s.name = %s;", at, emit_string(e, item->name));
        if (item->output) {
            emit_line(e, "%s.port = &n->%s;", at, names_of(e, n)->outputs[item->output->index]);
        }
        const char *own = interface_field(e->arena, item->augment->name);
        wire_links(e, emit_name(e, "%s.%s", at, own), item->links, item->augment->attribute_count);
    }
    if (n->item_count > 0) {
        emit_line(e, "n->self.items = n->items;");
        emit_line(e, "n->self.item_count = %u;", n->item_count);
    }
}

static void wire_procedure(emitter *e, const node *n)
{
    for (uint32_t i = 0; i < n->procedure->output_count; i++) {
        emit_line(e, "n->self.%s = &n->%s;", interface_field(e->arena, n->outputs[i].name),
                  names_of(e, n)->outputs[i]);
    }
    wire_links(e, "n->self", n->links, n->link_count);
    wire_items(e, n);
    emit_arguments(e, emit_is_fixed);
    emit_place(e, NULL);
}

/* ---- ports ----------------------------------------------------------------------------------- */

bool emit_is_dynamic(const port *p)
{
    for (uint32_t i = 0; i < p->edge_count; i++) {
        if (p->edges[i]->condition) {
            return true;
        }
    }
    return p->blocked_if != NULL;
}

/* An aggregative gate takes its ports one after the other, once all is done: each has a queue of
 * its own. */
static const char *gathered_queue(emitter *e, const port *p)
{
    uint32_t number = names_of(e, p->node)->first_gathered;
    for (uint32_t k = 0; k < p->index; k++) {
        number += p->node->outputs[k].gathered_by != NULL;
    }
    return emit_name(e, "g->gathered[%u]", number);
}

const char *emit_spare_queue(emitter *e, const port *p)
{
    if (p->gathered_by) {
        return gathered_queue(e, p);
    }
    return emit_is_leaf(e, p) ? emit_name(e, "g->leaf[%u]", emit_leaf_number(e, p)) : NULL;
}

static void wire_port(emitter *e, const port *p)
{
    const node_names *names = names_of(e, p->node);
    const char *to = names->leads[p->index], *spare = emit_spare_queue(e, p);
    uint32_t count = p->blocked ? 0 : p->edge_count;
    bool fixed = !emit_is_dynamic(p), leads = !p->blocked && (p->edge_count > 0 || spare);
    for (uint32_t i = 0; fixed && i < count; i++) {
        emit_line(e, "n->%s[%u] = &%s;", to, i, emit_queue(e, p->edges[i]->to));
    }
    if (fixed && leads && count == 0) {
        emit_line(e, "n->%s[0] = &%s;", to, spare);
        count = 1;
    }
    emit_line(e, "pcg_port_lead(&n->%s, %u, %s%s, %u);", names->outputs[p->index],
              names->first_port + p->index, leads ? "n->" : "", leads ? to : "0",
              fixed ? count : 0);
}

/* ---- graphs ---------------------------------------------------------------------------------- */

static void wire_node(emitter *e, const node *n)
{
    if (n->output_count == 0 && n->kind != NODE_PROCEDURE && n->kind != NODE_SURROGATE) {
        return;
    }
    emit_block(e);
    emit_line(e, "struct %s *n = &%s;", e->form->functions[n->index], emit_node_path(e, n));
    for (uint32_t i = 0; i < n->output_count; i++) {
        wire_port(e, &n->outputs[i]);
    }
    if (n->kind == NODE_PROCEDURE) {
        wire_procedure(e, n);
    }
    if (n->kind == NODE_SURROGATE) {
        emit_surrogate_wire(e, n);
    }
    emit_close(e, "");
}

void emit_wire(emitter *e)
{
    const graph *g = e->form->graph;
    series s = {.name = e->form->wire};
    emit_series_begin(e, &s);
    if (e->form->about) {
        emit_line(e, "g->frame.about = &%s;", e->form->about);
    }
    for (uint32_t i = 0; i < g->attribute_count; i++) {
        emit_series_item(e, &s, 1);
        wire_attribute(e, &g->attributes[i]);
    }
    for (uint32_t i = 0; i < g->node_count; i++) {
        e->node = g->nodes[i];
        if (emit_takes_part(e, e->node)) {
            emit_series_item(e, &s, 4);
            wire_node(e, e->node);
        }
    }
    e->node = NULL;
    emit_series_end(e, &s);
}

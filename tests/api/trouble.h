/* trouble.h - a graph, written by hand as the compiler emits graphs, that does whatever a test asks
 * for: loops that never end, entities without number, graphs inside graphs. What it does is its
 * parameter `mode`.
 */
#ifndef TESTS_TROUBLE_H
#define TESTS_TROUBLE_H

#include "runtime/pcg.h"
#include "runtime/shape.h"

typedef struct trouble {
    pcg_frame frame;
    pcg_cell mode, amount;
    pcg_u8 given[2];
    pcg_cell initial;
    pcg_queue result, loop;
    pcg_queue *to_result[1], *to_loop[1];
    pcg_port out, back;
    pcg_instance instance, inner;
} trouble;

typedef enum trouble_mode {
    TROUBLE_NOTHING, /* one entity, then done */
    TROUBLE_SPIN,    /* a cycle that never empties */
    TROUBLE_TICK,    /* a kernel that never ends, but ticks */
    TROUBLE_GROW,    /* entities without end */
    TROUBLE_MEMORY,  /* memory without end */
    TROUBLE_NEST,    /* a graph that encapsulates itself */
    TROUBLE_WARN,    /* `amount` warnings */
    TROUBLE_FAIL,    /* a kernel that fails */
    TROUBLE_MUTE,    /* a kernel that fails and does not say why */
    TROUBLE_NOTE,    /* `amount` notes */
    TROUBLE_ALL      /* a little of what needs memory: entities, attributes, strings, lists, queues,
                        frames */
} trouble_mode;

enum { TROUBLE_MAKER, TROUBLE_INSIDE, TROUBLE_RESULT, TROUBLE_NODES };
enum { TROUBLE_OUT, TROUBLE_BACK, TROUBLE_PORTS };

static const pcg_node trouble_nodes[TROUBLE_NODES] = {
    {"maker", "make", "trouble", "trouble.pcg", 3, 5, 0, 77, 0},
    {"inside", "trouble", "trouble", "trouble.pcg", 4, 5, 1, 78, 0},
    {"result", "out", "trouble", "trouble.pcg", 2, 5, 2, 79, 0},
};
static const pcg_output_info trouble_ports[TROUBLE_PORTS] = {{TROUBLE_MAKER, "out"},
                                                             {TROUBLE_MAKER, "back"}};
static const pcg_edge_info trouble_edges[] = {{TROUBLE_OUT, TROUBLE_RESULT}};

static int trouble_start(pcg_frame *f)
{
    trouble *g = (trouble *)f;
    g->initial.i = 0;
    g->to_result[0] = &g->result;
    g->to_loop[0] = &g->loop;
    g->out = (pcg_port){g->to_result, 1, TROUBLE_OUT};
    g->back = (pcg_port){g->to_loop, 1, TROUBLE_BACK};
    return PCG_OK;
}

static int trouble_spin(pcg_call *c, trouble *g)
{
    pcg_entity *e = pcg_entity_new(c, &pcg_type_entity, NULL);
    int status = e ? pcg_emit(c, &g->back, e) : PCG_FAILED;
    while (status == PCG_OK && g->loop.head < g->loop.end) {
        e = g->loop.at[g->loop.head++];
        status = pcg_round(c, e);
        if (status == PCG_OK)
            status = pcg_emit(c, &g->back, e);
    }
    return status;
}

static int trouble_tick(pcg_call *c)
{
    int status = PCG_OK;
    while (status == PCG_OK)
        status = pcg_tick(c);
    return status;
}

static int trouble_grow(pcg_call *c, trouble *g)
{
    int status = PCG_OK;
    while (status == PCG_OK) {
        pcg_entity *e = pcg_entity_new(c, &pcg_type_entity, NULL);
        status = e ? pcg_emit(c, &g->out, e) : PCG_FAILED;
    }
    return status;
}

static int trouble_memory(pcg_call *c)
{
    while (pcg_alloc(c->run, 100000)) {
    }
    return PCG_FAILED;
}

static int trouble_nest(pcg_frame *f)
{
    volatile char used[1000]; /* as much stack as emitted code needs a level */
    pcg_frame *inner = pcg_frame_new(f, &trouble_nodes[TROUBLE_INSIDE], sizeof(trouble), 1);
    used[0] = 0;
    int status = inner ? trouble_nest(inner) : PCG_FAILED;
    return used[0] ? PCG_OK : status;
}

static int trouble_warn(pcg_call *c, const trouble *g)
{
    int status = PCG_OK;
    for (pcg_int i = 0; i < g->amount.i && status == PCG_OK; i++)
        status = pcg_warn(c, "roof %lld of %.2f m cannot be built", i, 2.5);
    return status;
}

static int trouble_note(pcg_call *c, const trouble *g)
{
    for (pcg_int i = 0; i < g->amount.i; i++)
        pcg_note(c, "note %lld\nin two lines", i);
    return PCG_OK;
}

/* Half of the entities go out, half are dropped; attributes are written in the frame and in one
 * inside it. */
static int trouble_all(pcg_call *c, trouble *g)
{
    const pcg_slot number = {0, PCG_INT, &g->initial, 0}, name = {3, PCG_STRING, &g->initial, 0},
                   far = {70, PCG_VEC3, &g->initial, 0};
    const pcg_cell place[3] = {{.f = 1}, {.f = 2}, {.f = 3}};
    pcg_frame *inner =
        pcg_frame_new(&g->frame, &trouble_nodes[TROUBLE_INSIDE], sizeof(trouble), 60);
    if (!inner)
        return PCG_FAILED;
    for (pcg_int i = 0; i < g->amount.i; i++) {
        int status = pcg_tick(c);
        pcg_shape *s = status == PCG_OK ? pcg_shape_new(c, NULL) : NULL;
        if (!s)
            return PCG_FAILED;
        pcg_set_int(c->run, &s->entity, &number, i);
        pcg_entity *copy = pcg_entity_copy(c->run, &s->entity, 1);
        if (!copy)
            return PCG_FAILED;
        pcg_set_string(c->run, copy, &name, pcg_format(c->run, "number %lld of %g", i, 0.5));
        pcg_set_cells(c->run, copy, &far, place);
        pcg_shape_set_mesh(c->run, s, pcg_mesh_hold(&pcg_mesh_cube));
        s->scope.size = vec3(1, 2, 3);
        pcg_mesh *m = pcg_shape_edit(c->run, s);
        if (!m || pcg_mesh_need_uvs(c->run, m) != PCG_OK)
            return PCG_FAILED;
        pcg_leave(c->run, copy, inner->base);
        if (i % 2)
            pcg_entity_drop(c->run, copy);
        else if ((status = pcg_emit(c, &g->out, copy)) != PCG_OK)
            return status;
        if ((status = pcg_emit(c, &g->out, &s->entity)) != PCG_OK)
            return status;
    }
    return PCG_OK;
}

static int trouble_nothing(pcg_call *c, trouble *g)
{
    pcg_entity *e = pcg_entity_new(c, &pcg_type_entity, NULL);
    return e ? pcg_emit(c, &g->out, e) : PCG_FAILED;
}

static int trouble_run(pcg_frame *f)
{
    trouble *g = (trouble *)f;
    pcg_call c;
    pcg_begin(&c, f, &trouble_nodes[TROUBLE_MAKER], &g->instance);
    int status = pcg_round(&c, NULL);
    if (status != PCG_OK)
        return status;
    switch ((trouble_mode)g->mode.i) {
    case TROUBLE_NOTHING: return trouble_nothing(&c, g);
    case TROUBLE_SPIN: return trouble_spin(&c, g);
    case TROUBLE_TICK: return trouble_tick(&c);
    case TROUBLE_GROW: return trouble_grow(&c, g);
    case TROUBLE_MEMORY: return trouble_memory(&c);
    case TROUBLE_NEST: return trouble_nest(f);
    case TROUBLE_WARN: return trouble_warn(&c, g);
    case TROUBLE_FAIL: return pcg_fail(&c, "a roof of %.1f m cannot be built", 1.25);
    case TROUBLE_MUTE: return PCG_FAILED;
    case TROUBLE_NOTE: return trouble_note(&c, g);
    case TROUBLE_ALL: return trouble_all(&c, g);
    }
    return PCG_OK;
}

static const pcg_parameter_info trouble_parameters[] = {
    {"mode", "", "int", "0", NULL, NULL, 0, PCG_INT, 0, 0, offsetof(trouble, mode),
     offsetof(trouble, given)},
    {"amount", "", "int", "0", NULL, NULL, 0, PCG_INT, 0, 0, offsetof(trouble, amount),
     offsetof(trouble, given) + 1},
};
static const pcg_port_info trouble_outputs[] = {
    {"result", "", "Entity", "Entity", 0, offsetof(trouble, result), 0}};
static const pcg_attribute_info trouble_attributes[] = {
    {"number", "", "int", NULL, PCG_INT, 0, 0, offsetof(trouble, initial)}};

static const pcg_module trouble_module = {
    .abi = PCG_ABI,
    .size = sizeof(pcg_module),
    .name = "trouble",
    .document = "",
    .version = "0",
    .folder = "",
    .parameters = trouble_parameters,
    .outputs = trouble_outputs,
    .attributes = trouble_attributes,
    .nodes = trouble_nodes,
    .ports = trouble_ports,
    .edges = trouble_edges,
    .parameter_count = 2,
    .output_count = 1,
    .attribute_count = 1,
    .node_count = TROUBLE_NODES,
    .port_count = TROUBLE_PORTS,
    .edge_count = 1,
    .gate_count = 1,
    .frame_size = sizeof(trouble),
    .start = trouble_start,
    .run = trouble_run,
};

/* A run of it that is to do `mode`. */
static inline pcg_run *trouble_new(const pcg_program *p, const pcg_run_options *options,
                                   trouble_mode mode, int amount)
{
    pcg_run *r = pcg_run_new(p, options);
    if (r && (pcg_run_set_int(r, "mode", (int64_t)mode) != PCG_STATUS_OK ||
              pcg_run_set_int(r, "amount", amount) != PCG_STATUS_OK)) {
        pcg_run_free(r);
        return NULL;
    }
    return r;
}

#endif

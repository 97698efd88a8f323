/* toy.h - a graph in the form in which the compiler emits graphs, written by hand.
 *
 *     graph toy {
 *         param count: int = 4 range [0, 1000000]
 *         attr number: int = -1
 *         attr side: length = 2m
 *         attr label: string = "none"
 *         in lot: Shape
 *         out even: Shape
 *         out odd: Shape
 *         out again: Shape
 *         maker: make(count = count) -> sorter: sort(number => @number, label => @label)
 *         sorter.even -> even
 *         sorter.even -> again
 *         sorter.odd -> odd
 *         lot -> odd
 *         sorter.never -> lonely: pass() -> beyond: pass()
 *         pairing: pair(); sorter.even -> pairing.left; sorter.never -> pairing.right
 *     }
 */
#ifndef TESTS_TOY_H
#define TESTS_TOY_H

#include "runtime/pcg.h"
#include "runtime/shape.h"

/* What lies at the parameters' offsets are their cells. */
typedef struct toy {
    pcg_frame frame;
    pcg_cell count, height, mode, flag, title, tint, place, sizes, picture, odds;
    pcg_u8 given[16];
    pcg_cell initial_number, initial_side, initial_label, initial_tints;
    pcg_queue lot, sorter, even, odd, again, lonely, beyond, left, right;
    pcg_queue *to_sorter[1], *to_even[3], *to_odd[1], *to_never[2], *to_beyond[1], *from_lot[1];
    pcg_port maker_out, sorter_even, sorter_odd, sorter_never, lonely_out, lot_out;
    pcg_instance maker_instance, sorter_instance, lonely_instance, beyond_instance, lot_instance,
        pairing_instance;
} toy;

enum {
    TOY_LOT,
    TOY_MAKER,
    TOY_SORTER,
    TOY_EVEN,
    TOY_ODD,
    TOY_AGAIN,
    TOY_LONELY,
    TOY_BEYOND,
    TOY_PAIRING,
    TOY_NODES
};
enum {
    TOY_FROM_LOT,
    TOY_MAKER_OUT,
    TOY_SORTER_EVEN,
    TOY_SORTER_ODD,
    TOY_SORTER_NEVER,
    TOY_LONELY_OUT,
    TOY_PORTS
};

#define TOY_NODE(name, procedure, line, index)                                                     \
    {                                                                                              \
        name, procedure, "toy", "toy.pcg", line, 5, index, 1000 + index, 0                         \
    }

static const pcg_node toy_nodes[TOY_NODES] = {
    TOY_NODE("lot", "in", 6, TOY_LOT),         TOY_NODE("maker", "make", 10, TOY_MAKER),
    TOY_NODE("sorter", "sort", 10, TOY_SORTER), TOY_NODE("even", "out", 7, TOY_EVEN),
    TOY_NODE("odd", "out", 8, TOY_ODD),        TOY_NODE("again", "out", 9, TOY_AGAIN),
    TOY_NODE("lonely", "pass", 15, TOY_LONELY), TOY_NODE("beyond", "pass", 15, TOY_BEYOND),
    TOY_NODE("pairing", "pair", 16, TOY_PAIRING),
};

static const pcg_output_info toy_ports[TOY_PORTS] = {
    {TOY_LOT, "out"},     {TOY_MAKER, "out"},    {TOY_SORTER, "even"},
    {TOY_SORTER, "odd"},  {TOY_SORTER, "never"}, {TOY_LONELY, "out"},
};

static const pcg_edge_info toy_edges[] = {
    {TOY_FROM_LOT, TOY_ODD},        {TOY_MAKER_OUT, TOY_SORTER},   {TOY_SORTER_EVEN, TOY_EVEN},
    {TOY_SORTER_EVEN, TOY_AGAIN},   {TOY_SORTER_ODD, TOY_ODD},     {TOY_SORTER_NEVER, TOY_LONELY},
    {TOY_LONELY_OUT, TOY_BEYOND},   {TOY_SORTER_EVEN, TOY_PAIRING}, {TOY_SORTER_NEVER, TOY_PAIRING},
};

static int toy_start(pcg_frame *f)
{
    toy *g = (toy *)f;
    g->initial_number.i = -1;
    g->initial_side.f = 2;
    g->initial_label.s = "none";
    if (!g->given[0])
        g->count.i = 4;
    g->to_sorter[0] = &g->sorter;
    g->to_even[0] = &g->even;
    g->to_even[1] = &g->again;
    g->to_even[2] = &g->left;
    g->to_odd[0] = &g->odd;
    g->to_never[0] = &g->lonely;
    g->to_never[1] = &g->right;
    g->to_beyond[0] = &g->beyond;
    g->from_lot[0] = &g->odd;
    g->lot_out = (pcg_port){g->from_lot, 1, TOY_FROM_LOT};
    g->maker_out = (pcg_port){g->to_sorter, 1, TOY_MAKER_OUT};
    g->sorter_even = (pcg_port){g->to_even, 3, TOY_SORTER_EVEN};
    g->sorter_odd = (pcg_port){g->to_odd, 1, TOY_SORTER_ODD};
    g->sorter_never = (pcg_port){g->to_never, 2, TOY_SORTER_NEVER};
    g->lonely_out = (pcg_port){g->to_beyond, 1, TOY_LONELY_OUT};
    return PCG_OK;
}

/* Squares, count of them. */
static int toy_make(pcg_call *c, toy *g)
{
    for (pcg_int i = 0; i < g->count.i; i++) {
        pcg_shape *s = pcg_shape_new(c, NULL);
        int status = pcg_tick(c);
        if (!s)
            return PCG_FAILED;
        s->scope.size = vec3(1, (double)i + 1, 0);
        pcg_shape_set_mesh(c->run, s, pcg_mesh_hold(&pcg_mesh_square));
        if (status == PCG_OK)
            status = pcg_emit(c, &g->maker_out, &s->entity);
        if (status != PCG_OK)
            return status;
    }
    return PCG_OK;
}

/* Numbers what comes, and sends it out by its number. */
static int toy_sort(pcg_call *c, toy *g, pcg_entity *e)
{
    const pcg_slot number = {0, PCG_INT, &g->initial_number, 0},
                   label = {2, PCG_STRING, &g->initial_label, 0};
    pcg_int n = (pcg_int)c->round - 1;
    pcg_set_int(c->run, e, &number, n);
    pcg_set_string(c->run, e, &label, pcg_format(c->run, "no. %lld", n));
    return pcg_emit(c, n % 2 ? &g->sorter_odd : &g->sorter_even, e);
}

static int toy_pass(pcg_call *c, pcg_queue *q, const pcg_port *out)
{
    while (q->head < q->end) {
        pcg_entity *e = q->at[q->head++];
        int status = pcg_round(c, e);
        if (status == PCG_OK)
            status = pcg_emit(c, out, e);
        if (status != PCG_OK)
            return status;
    }
    return PCG_OK;
}

static int toy_sorter_run(toy *g)
{
    pcg_call c;
    pcg_begin(&c, &g->frame, &toy_nodes[TOY_SORTER], &g->sorter_instance);
    while (g->sorter.head < g->sorter.end) {
        pcg_entity *e = g->sorter.at[g->sorter.head++];
        int status = pcg_round(&c, e);
        if (status == PCG_OK)
            status = toy_sort(&c, g, e);
        if (status != PCG_OK)
            return status;
    }
    return PCG_OK;
}

static int toy_run(pcg_frame *f)
{
    toy *g = (toy *)f;
    pcg_call c;
    int status;
    pcg_begin(&c, f, &toy_nodes[TOY_LOT], &g->lot_instance);
    if ((status = toy_pass(&c, &g->lot, &g->lot_out)) != PCG_OK)
        return status;
    pcg_begin(&c, f, &toy_nodes[TOY_MAKER], &g->maker_instance);
    if ((status = pcg_round(&c, NULL)) != PCG_OK || (status = toy_make(&c, g)) != PCG_OK)
        return status;
    if ((status = toy_sorter_run(g)) != PCG_OK)
        return status;
    pcg_begin(&c, f, &toy_nodes[TOY_LONELY], &g->lonely_instance);
    if ((status = toy_pass(&c, &g->lonely, &g->lonely_out)) != PCG_OK)
        return status;
    pcg_queue_clear(f, &toy_nodes[TOY_PAIRING], "left", &g->left);
    pcg_queue_clear(f, &toy_nodes[TOY_PAIRING], "right", &g->right);
    return PCG_OK;
}

#define TOY_CELL(member) ((pcg_u32)offsetof(toy, member))
#define TOY_GIVEN(n)     ((pcg_u32)(offsetof(toy, given) + (n)))

static const pcg_constraint_info toy_count_range = {0, 0, 1000000, NULL};
static const pcg_constraint_info toy_height_range = {0, 1, 10, NULL};
static const pcg_constraint_info toy_title_rules[] = {{2, 0, 0, "[A-Z][a-z]*"}, {3, 0, 6, NULL}};
static const pcg_constraint_info toy_picture_choice = {1, 0, 0, "brick.jpg\nstone.jpg"};
static const pcg_constraint_info toy_odds_range = {0, 0, 1, NULL};

/* More of them than the graph reads, so that there is one of every kind. */
static const pcg_parameter_info toy_parameters[] = {
    {"count", "How many.", "int", "4", NULL, &toy_count_range, 1, PCG_INT, 0, 0, TOY_CELL(count),
     TOY_GIVEN(0)},
    {"height", "", "length", "2m", NULL, &toy_height_range, 1, PCG_LENGTH, 0, 0, TOY_CELL(height),
     TOY_GIVEN(1)},
    {"mode", "", "Axis", "x", "x\ny\nz", NULL, 0, PCG_ENUM, 0, 0, TOY_CELL(mode), TOY_GIVEN(2)},
    {"flag", "", "bool", "false", NULL, NULL, 0, PCG_BOOL, 0, 1, TOY_CELL(flag), TOY_GIVEN(3)},
    {"title", "", "string", "", NULL, toy_title_rules, 2, PCG_STRING, 0, 0, TOY_CELL(title),
     TOY_GIVEN(4)},
    {"sizes", "", "list<float>", "[]", NULL, NULL, 0, PCG_LIST, PCG_FLOAT, 0, TOY_CELL(sizes),
     TOY_GIVEN(5)},
    {"picture", "", "path", "", NULL, &toy_picture_choice, 1, PCG_PATH, 0, 0, TOY_CELL(picture),
     TOY_GIVEN(6)},
    {"odds", "", "ratio", "0.5", NULL, &toy_odds_range, 1, PCG_RATIO, 0, 0, TOY_CELL(odds),
     TOY_GIVEN(7)},
};

static const pcg_attribute_info toy_attributes[] = {
    {"number", "", "int", NULL, PCG_INT, 0, 0, TOY_CELL(initial_number)},
    {"side", "", "length", NULL, PCG_LENGTH, 0, 1, TOY_CELL(initial_side)},
    {"label", "", "string", NULL, PCG_STRING, 0, 2, TOY_CELL(initial_label)},
};

static const pcg_port_info toy_inputs[] = {
    {"lot", "What is built on.", "Shape", "Shape\nEntity", 0, TOY_CELL(lot), TOY_GIVEN(10)},
    {"net", "", "StreetNetwork", "StreetNetwork\nEntity", 0, TOY_CELL(beyond), TOY_GIVEN(11)},
};
static const pcg_port_info toy_outputs[] = {
    {"even", "The even ones.", "Shape", "Shape\nEntity", 0, TOY_CELL(even), 0},
    {"odd", "", "Shape", "Shape\nEntity", 0, TOY_CELL(odd), 0},
    {"again", "", "Shape", "Shape\nEntity", 0, TOY_CELL(again), 0},
};

static const pcg_module toy_module = {
    .abi = PCG_ABI,
    .size = sizeof(pcg_module),
    .name = "toy",
    .document = "A toy.\nFor tests.",
    .version = "0",
    .folder = "",
    .parameters = toy_parameters,
    .inputs = toy_inputs,
    .outputs = toy_outputs,
    .attributes = toy_attributes,
    .nodes = toy_nodes,
    .ports = toy_ports,
    .edges = toy_edges,
    .parameter_count = sizeof toy_parameters / sizeof toy_parameters[0],
    .input_count = 2,
    .output_count = 3,
    .attribute_count = 3,
    .node_count = TOY_NODES,
    .port_count = TOY_PORTS,
    .edge_count = sizeof toy_edges / sizeof toy_edges[0],
    .gate_count = 3,
    .frame_size = sizeof(toy),
    .start = toy_start,
    .run = toy_run,
};

#endif

/* order_test.c - ranks, cyclic edges and regions of graphs that are written as strings. */
#include <stdlib.h>

#include "compiler/compiler.h"
#include "unit.h"

enum { MAX_PORTS = 4, MAX_PORT_EDGES = 64 };

/* ---- graphs ---------------------------------------------------------------------------------- */

static node *add_node(arena *a, graph *g, const char *name)
{
    node *n = ARENA_NEW(a, node);
    n->name = name;
    n->owner = g;
    n->index = g->node_count;
    n->inputs = ARENA_ARRAY(a, port, MAX_PORTS);
    n->outputs = ARENA_ARRAY(a, port, MAX_PORTS);
    for (uint32_t i = 0; i < MAX_PORTS; i++) {
        n->inputs[i] = (port){.node = n, .is_input = true, .name = "in", .index = i};
        n->outputs[i] = (port){.node = n, .name = "out", .index = i};
        n->inputs[i].edges = ARENA_ARRAY(a, edge *, MAX_PORT_EDGES);
        n->outputs[i].edges = ARENA_ARRAY(a, edge *, MAX_PORT_EDGES);
    }
    n->input_count = n->output_count = MAX_PORTS;
    g->nodes[g->node_count++] = n;
    return n;
}

static node *find_node(const graph *g, char name)
{
    for (uint32_t i = 0; i < g->node_count; i++) {
        if (g->nodes[i]->name[0] == name) {
            return g->nodes[i];
        }
    }
    abort();
}

static void add_edge(arena *a, graph *g, port *from, port *to)
{
    edge *e = ARENA_NEW(a, edge);
    e->from = from;
    e->to = to;
    from->edges[from->edge_count++] = e;
    to->edges[to->edge_count++] = e;
    g->edges[g->edge_count++] = e;
}

/* Nodes "abc"; edges "a1b0 a0c2": from a's output 1 to b's input 0, and so on. */
static program *build(arena *a, const char *nodes, const char *edges)
{
    program *p = ARENA_NEW(a, program);
    graph *g = ARENA_NEW(a, graph);
    p->arena = a;
    p->main = g;
    p->graphs = ARENA_ARRAY(a, graph *, 1);
    p->graphs[0] = g;
    p->graph_count = 1;
    g->name = "g";
    g->nodes = ARENA_ARRAY(a, node *, strlen(nodes));
    g->edges = ARENA_ARRAY(a, edge *, strlen(edges));
    for (const char *s = nodes; *s; s++) {
        add_node(a, g, arena_copy(a, s, 1));
    }
    for (const char *s = edges; *s; s += s[4] ? 5 : 4) {
        node *from = find_node(g, s[0]), *to = find_node(g, s[2]);
        add_edge(a, g, &from->outputs[s[1] - '0'], &to->inputs[s[3] - '0']);
    }
    return p;
}

/* "abc cyclic:a0 regions:0-2" for the order abc, a cyclic edge that leaves a's output 0, and a
 * loop. */
static const char *describe(arena *a, const graph *g)
{
    text out = {.arena = a};
    text_add(&out, "");
    for (uint32_t i = 0; i < g->node_count; i++) {
        text_add(&out, g->order[i]->name);
        if (g->order[i]->rank != i) {
            text_add(&out, "?");
        }
    }
    for (uint32_t i = 0; i < g->edge_count; i++) {
        const edge *e = g->edges[i];
        if (e->cyclic) {
            text_format(&out, " %s>%s", e->from->node->name, e->to->node->name);
        }
    }
    for (uint32_t i = 0; i < g->region_count; i++) {
        const region *r = &g->regions[i];
        text_format(&out, "%s%u-%u", r->cyclic ? " loop " : " ", r->first, r->last);
    }
    return out.at;
}

static void expect_order(const char *nodes, const char *edges, const char *expected)
{
    arena memory = {0};
    jmp_buf out_of_memory;
    compilation c = {0};
    if (setjmp(out_of_memory)) {
        abort();
    }
    memory.on_failure = &out_of_memory;
    program *p = build(&memory, nodes, edges);
    order(&c, p);
    CHECK_TEXT(describe(&memory, p->main), expected);
    arena_free(&memory);
}

/* ---- the rules ------------------------------------------------------------------------------- */

static void test_topological(void)
{
    expect_order("", "", "");
    expect_order("abc", "", "abc 0-2");
    expect_order("cba", "a0b0 b0c0", "abc 0-2");
    /* A diamond closes no cycle. */
    expect_order("abcd", "a0b0 a0c0 b0d0 c0d0", "abcd 0-3");
    /* Appearance decides between sources, and between nodes behind one port. */
    expect_order("abxy", "a0x0 b0y0", "abxy 0-3");
    expect_order("axby", "a0x0 b0y0", "axby 0-3");
    expect_order("ayx", "a0x0 a0y0", "ayx 0-2");
}

static void test_ports(void)
{
    expect_order("ayx", "a0x0 a1y0", "axy 0-2");
    expect_order("ayx", "a1y0 a0x0", "axy 0-2");
    /* Across a port that nothing leaves, and over three. */
    expect_order("azyx", "a3z0 a1y0 a0x0", "axyz 0-3");
    /* What the first port leads to further on comes first, too. */
    expect_order("ayqxp", "a1y0 y0q0 a0x0 x0p0", "axpyq 0-4");
    /* A node that both lead to waits for both. */
    expect_order("ajyx", "a0x0 a1y0 x0j0 y0j0", "axyj 0-3");
    /* The first port's node waits for another source: the second port's waits for it. */
    expect_order("ayxz", "a0x0 z0x1 a1y0", "azxy 0-3");
    /* An edge prevails over the ports. */
    expect_order("axy", "a0x0 a1y0 y0x1", "ayx 0-2");
    /* Two nodes that demand opposite orders: the first of the text prevails. */
    expect_order("abxy", "a0y0 a1x0 b0x1 b1y1", "abyx 0-3");
    /* Nested ports. */
    expect_order("asrqpy", "a0p0 p0q0 p1r0 a1y0 q0s0", "apqsry 0-5");
}

static void test_feeders(void)
{
    expect_order("abm", "b0m0 a0m0", "bam 0-2");
    expect_order("abm", "b0m0 a0m1", "abm 0-2");
    /* Ports prevail over lines. */
    expect_order("cabm", "c0a0 c1b0 b0m0 a0m0", "cabm 0-3");
}

static void test_cycles(void)
{
    expect_order("a", "a0a0", "a a>a loop 0-0");
    expect_order("ab", "a0b0 b0a0", "ab b>a loop 0-1");
    expect_order("sabt", "s0a0 a0b0 b0a1 b1t0", "sabt b>a 0-0 loop 1-2 3-3");
    /* Entered in the middle: the search from the first node of the text decides which edge leads
     * back. */
    expect_order("bas", "s0a0 a0b0 b0a1", "bsa a>b loop 0-2");
    /* Overlapping cycles share a region, separate ones do not. */
    expect_order("abcd", "a0b0 b0c0 c0a1 c0d0 d0b1", "abcd c>a d>b loop 0-3");
    expect_order("abcd", "a0b0 b0a1 b0c0 c0d0 d0c1", "abcd b>a d>c loop 0-1 loop 2-3");
    /* A node between the ends of a cycle is in its region. */
    expect_order("axb", "a0x0 a1b0 b0a1", "axb b>a loop 0-2");
}

/* ---- sizes ----------------------------------------------------------------------------------- */

/* A chain written backwards, whose last node leads back to the first: as deep as it is long. */
static void test_long_cycle(void)
{
    enum { LENGTH = 20000 };
    arena memory = {0};
    jmp_buf out_of_memory;
    compilation c = {0};
    if (setjmp(out_of_memory)) {
        abort();
    }
    memory.on_failure = &out_of_memory;
    program *p = build(&memory, "", "");
    graph *g = p->main;
    g->nodes = ARENA_ARRAY(&memory, node *, LENGTH);
    g->edges = ARENA_ARRAY(&memory, edge *, LENGTH);
    for (uint32_t i = 0; i < LENGTH; i++) {
        add_node(&memory, g, "n");
    }
    for (uint32_t i = LENGTH; i-- > 0;) {
        node *to = g->nodes[i == 0 ? LENGTH - 1 : i - 1];
        add_edge(&memory, g, &g->nodes[i]->outputs[0], &to->inputs[0]);
    }
    order(&c, p);
    bool right = g->region_count == 1 && g->regions[0].cyclic && g->nodes[0]->rank == 0;
    for (uint32_t i = 1; i < LENGTH; i++) {
        right = right && g->nodes[i]->rank == LENGTH - i;
    }
    CHECK(right);
    arena_free(&memory);
}

int main(void)
{
    test_topological();
    test_ports();
    test_feeders();
    test_cycles();
    test_long_cycle();
    return unit_done();
}

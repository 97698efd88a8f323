/* placement.h - the order in which a graph's nodes run: order.c's second half. */
#ifndef PCG_COMPILER_PLACEMENT_H
#define PCG_COMPILER_PLACEMENT_H

#include "program.h"

/* Edges that are neither disabled nor cyclic, leaving each node: those of node n are
 * edges[first[n]] .. edges[first[n + 1] - 1], by port, and by line within a port. */
typedef struct successors {
    uint32_t count; /* of nodes */
    uint32_t *first;
    edge **edges;
} successors;

/* `with_cyclic`: cyclic edges stay in. */
successors successors_of(arena *a, const graph *g, bool with_cyclic);

/* Fills graph.order and node.rank. `topological` holds the nodes' indices in some order that no
 * edge of `s` contradicts; it is overwritten.
 *
 * 1. The source of an edge comes before its target.
 * 2. The nodes that an output port leads to by one edge come before those of the node's next
 *    connected port.
 * 3. Nodes that feed the same input port come in the order of the edges' lines.
 *    A demand of 2 or 3 that contradicts 1, or an earlier one (2 before 3, nodes in order of
 *    appearance), is void.
 * 4. Of what may come next, that which became possible through an earlier port of one node comes
 *    first, with all that it makes possible in turn.
 * 5. Otherwise, order of appearance. */
void place_nodes(arena *a, graph *g, const successors *s, uint32_t *topological);

#endif

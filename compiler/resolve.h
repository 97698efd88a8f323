/* resolve.h - what the files of the pass `resolve` share.
 *
 * resolve.c reads files and binds imports (resolve_surrogate.c what surrogates name); resolve_graph.c declares what a graph's names mean
 * (resolve_constants.c its constants) and makes its nodes; resolve_node.c makes one node with its
 * ports; resolve_chain.c turns chains into edges.
 */
#ifndef PCG_COMPILER_RESOLVE_H
#define PCG_COMPILER_RESOLVE_H

#include "library.h"

/* What the names of a graph mean. Nodes and gates share one space, parameters and constants
 * another. */
struct graph_names {
    table parameters, constants, attributes, nodes;
    formal *formals;       /* the graph's parameters, as a node that encapsulates it sees them */
    LIST(node *) elements; /* the node of each element that makes one, in the order of chains */
    LIST(edge *) edges_made;
};

typedef struct resolver {
    compilation *c;
    program *p;
    arena *arena;
    diagnostics *d;
    table units; /* by path */
    LIST(unit *) units_read;
    LIST(graph *) graphs_found; /* of all files, in order */
} resolver;

/* Where a graph is being resolved. */
typedef struct drawing {
    resolver *r;
    graph *graph;
    struct graph_names *names;
    uint32_t next_element; /* of names->elements */
} drawing;

/* "node 'roof' has the name of another node": both places. */
void report_duplicate(resolver *r, const char *what, const tree_name *name, const char *other,
                      span other_place);

/* First for all graphs: parameters, constants, attributes, gates. Then for all: nodes and edges. */
void resolve_interface(resolver *r, graph *g);
void resolve_body(resolver *r, graph *g);

/* The file of that path beside the one of `u`, or on the import paths, read where it was not yet. NULL:
 * it was reported at `place`. */
unit *resolve_file(resolver *r, unit *u, const char *path, span place);
/* A file that is made up, and sees what `like` sees. */
unit *resolve_text(resolver *r, const unit *like, const char *name, const text *written);
/* The graph of a file that is named like it, or its only one; NULL. */
graph *graph_of_unit(resolver *r, const unit *u);
/* A surrogate's ports and parameters stand: finds the graph that it names, where that is written
 * out, and makes what a procedure would be encapsulated in. */
void resolve_surrogate(drawing *d, node *n);

/* Declares its `count` constants in the order in which they can be evaluated. */
void resolve_constants(resolver *r, graph *g, uint32_t count);

/* A node of that kind without ports. */
node *node_new(drawing *d, node_kind kind, const char *name, span place);
/* The node that an element makes, with its ports and augmentations; what is unknown is reported. */
node *node_of_element(drawing *d, const tree_element *e);
/* As messages call it: by its name, or by what it runs. */
const char *node_title(const node *n);
/* One that goes with everything: what names it was reported. */
node *node_of_error(drawing *d, const char *name, span place);
void port_fill(port *p, node *n, const char *name, bool is_input, uint32_t index);

/* The node's port of that name, or NULL; `impulse` of a source comes to be when it is asked for. */
port *port_named(drawing *d, node *n, const char *name, bool is_input);
/* The node's only port in that direction; where there is none, or more than one, that is reported
 * at `place`. */
port *port_only(drawing *d, node *n, bool is_input, span place);

/* Reports optional inputs where they cannot be: as the first, or beside a single one. */
void check_optional(drawing *d, const tree_gate *const *inputs, uint32_t count);

/* "'roof' has no port 'slop'", with a suggestion and a list; or that it is one of the other
 * direction. */
void report_no_port(drawing *d, node *n, const tree_name *name, bool is_input);

/* Makes the edges of a chain; `gate` is the input gate that it stands in for, or NULL. */
void resolve_chain(drawing *d, const tree_chain *chain, node *gate);
/* The node that a name means, or NULL: it was reported. */
node *resolve_reference(drawing *d, const tree_name *name, const tree_name *port);
/* Adds the graph's edges to their ports, once all are made. */
void connect_edges(drawing *d);

#endif

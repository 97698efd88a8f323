/*pcg
/// Writes what the graph is that the node stands in: its name, its nodes, edges, types, parameters and attributes.
///
/// Lists that belong together have the same order: `nodes` and `runs`, `edges` and `edge_types`, and so on. An edge is
/// written "lots.out -> extrude.in"; a gate stands for its one port. Edges that are disabled are left out.
procedure graph_info<T: Entity>(in: T) -> (out: T) [stateful, one_to_one, reflects] {
    category "reflection"
    synonyms "reflect", "introspection", "name", "nodes", "edges", "types"
    attr name: string                   /// Written: the graph's name.
    attr depth: int                     /// Written: how many graphs are around it.
    attr nodes: list<string>            /// Written: the nodes' names.
    attr runs: list<string>             /// Written: of each node, the procedure or graph that it runs.
    attr edges: list<string>            /// Written: from which port to which.
    attr edge_types: list<string>       /// Written: of each edge, the type of what travels along it.
    attr parameters: list<string>       /// Written: the parameters' names.
    attr parameter_types: list<string>  /// Written: their types.
    attr attributes: list<string>       /// Written: the attributes' names.
    attr attribute_types: list<string>  /// Written: their types.
    example rectangle(width = 2m, height = 3m)
        -> graph_info(depth => @depth)
        -> c: condition(@depth == 0) expect c.yes.count = 1
}
*/
#include "graph_info.h"
#include <string.h>
#include "core.h"

/* Every second of the lines, from the first or the second one on, as a list; NULL when memory
 * has run out. */
static const pcg_list *info_lines(pcg_call *call, const char *lines, int first)
{
    pcg_u64 count = 0, number = 0;
    for (const char *at = lines; *at; at++) {
        count += *at == '\n';
    }
    pcg_list *list = core_list_new(call, count / 2);
    for (; list && *lines; number++) {
        size_t length = strcspn(lines, "\n");
        if ((number & 1) == (pcg_u64)first) {
            core_buffer b = {.run = call->run};
            core_add_bytes(&b, lines, length);
            list->at[number / 2].s = core_finish(&b);
        }
        lines += length + 1;
    }
    return list;
}

static const pcg_list *info_parameters(pcg_call *call, int types)
{
    const pcg_graph_info *about = call->frame->about;
    pcg_list *list = core_list_new(call, about->parameter_count);
    for (pcg_u32 i = 0; list && i < about->parameter_count; i++) {
        list->at[i].s = types ? about->parameters[i].type : about->parameters[i].name;
    }
    return list;
}

/* Writes a list that somebody wants. Status. */
static int info_write(pcg_call *call, pcg_entity *e, const pcg_slot *to, const char *lines,
                      int second)
{
    if (to->cell < 0) {
        return PCG_OK;
    }
    pcg_cell cell = {.list =
                         lines ? info_lines(call, lines, second) : info_parameters(call, second)};
    if (!cell.list) {
        return PCG_FAILED;
    }
    pcg_set_cells(call->run, e, to, &cell);
    return PCG_OK;
}

int pcg_core_graph_info(pcg_call *call, struct pcg_core_graph_info *node)
{
    const pcg_graph_info *about = call->frame->about;
    pcg_entity *e = node->in;
    pcg_set_string(call->run, e, &node->name, about->name);
    pcg_set_int(call->run, e, &node->depth, call->frame->depth);
    PCG_TRY(info_write(call, e, &node->nodes, about->nodes, 0));
    PCG_TRY(info_write(call, e, &node->runs, about->nodes, 1));
    PCG_TRY(info_write(call, e, &node->edges, about->edges, 0));
    PCG_TRY(info_write(call, e, &node->edge_types, about->edges, 1));
    PCG_TRY(info_write(call, e, &node->parameters, 0, 0));
    PCG_TRY(info_write(call, e, &node->parameter_types, 0, 1));
    PCG_TRY(info_write(call, e, &node->attributes, about->attributes, 0));
    PCG_TRY(info_write(call, e, &node->attribute_types, about->attributes, 1));
    return pcg_emit(call, node->out, e);
}

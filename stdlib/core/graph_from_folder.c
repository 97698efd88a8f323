/*pcg
/// Writes the path of a graph's file, chosen from a folder by chance or by number, into an attribute.
///
/// A surrogate such as `dynamic` then runs it: a new file in the folder is one more choice, without a change of the
/// graph. The folder is looked up beside the graph's file, and is read once per node. Its files are in the order of
/// their names' bytes; hidden ones do not count. By chance the choice depends on the seed, on this node and on the
/// entity's line of descent. Where the folder cannot be read, or holds no file that fits, that is reported and the
/// entity goes on without a change.
procedure graph_from_folder<T: Entity>(in: T) -> (out: T) [reads, one_to_one] {
    category "dynamic"
    synonyms "style", "choose", "exception", "random", "folder", "load"
    param folder: path             /// Where the graphs are.
    param index: int = -1          /// Which one, from 0; beyond the last it begins again. Below 0: by chance.
    param pattern: string = "*.pcg" /// Which files: `*` stands for any characters, `?` for one.
    attr graph: path               /// Written: the folder and the name of the file, as in "styles/modern.pcg".
    example rectangle() -> graph_from_folder(folder = "no-such-folder") expect count = 1
}
*/
#include "graph_from_folder.h"
#include "core.h"
#include "folder.h"

int pcg_core_graph_from_folder(pcg_call *call, struct pcg_core_graph_from_folder *node)
{
    folder_listing *l;
    int status = core_folder_listing(call, node->folder, node->pattern, &l);
    if (status != PCG_OK) {
        return status;
    }
    if (l->count > 0) {
        pcg_u32 drawn = core_folder_draw(call, l);
        pcg_int chosen = node->index < 0 ? (pcg_int)drawn : node->index % (pcg_int)l->count;
        pcg_set_string(call->run, node->in, &node->graph, l->files[chosen]);
    }
    return pcg_emit(call, node->out, node->in);
}

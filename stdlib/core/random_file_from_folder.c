/*pcg
/// Writes the path of a file, drawn from a folder by chance, into an attribute.
///
/// The folder is looked up beside the graph's file, and is read once per node. Files below it, hidden files and
/// what is no file do not count. The files are in the order of their names' bytes, so that the same folder gives the
/// same choice everywhere; it depends on the seed, on this node and on the entity's line of descent. Where the folder
/// cannot be read, or holds no file that fits, that is reported and the entity goes on without a change.
procedure random_file_from_folder<T: Entity>(in: T) -> (out: T) [reads, one_to_one] {
    category "attributes"
    synonyms "file", "folder", "directory", "texture", "random", "choose", "path"
    param folder: path            /// Where the files are.
    param pattern: string = "*"   /// Which files: `*` stands for any characters, `?` for one, as in "*.jpg".
    attr file: path               /// Written: the folder and the name of the file, as in "assets/roofs/tiles.jpg".
    example rectangle(width = 2m, height = 3m)
        -> random_file_from_folder(folder = "no-such-folder") expect count = 1
}
*/
#include "random_file_from_folder.h"
#include "core.h"
#include "folder.h"

int pcg_core_random_file_from_folder(pcg_call *call, struct pcg_core_random_file_from_folder *node)
{
    folder_listing *l;
    int status = core_folder_listing(call, node->folder, node->pattern, &l);
    if (status != PCG_OK) {
        return status;
    }
    if (l->count > 0) {
        pcg_set_string(call->run, node->in, &node->file, l->files[core_folder_draw(call, l)]);
    }
    return pcg_emit(call, node->out, node->in);
}

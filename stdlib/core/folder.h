/* folder.h - the files of a folder, for procedures that choose one of them. */
#ifndef PCG_CORE_FOLDER_H
#define PCG_CORE_FOLDER_H

#include "runtime/abi.h"

/* A folder's files as a node saw them: kept for its later rounds. */
typedef struct folder_listing {
    struct folder_listing *next;
    const char *folder, *pattern;
    const char **files; /* folder/name */
    pcg_u32 count, capacity;
} folder_listing;

/* The listing of a folder, in the order of the names' bytes: the node's own, kept as its state, read
 * when it is first asked for. What cannot be read is reported; its listing is empty. Status. */
int core_folder_listing(pcg_call *call, const char *folder, const char *pattern,
                      folder_listing **found);
/* One of its files by chance; there must be any. The call's first random number decides. */
pcg_u32 core_folder_draw(const pcg_call *call, const folder_listing *l);

#endif

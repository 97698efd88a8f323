/* members.h - what a container holds: the members of a group, the parts of a shape. */
#ifndef PCG_CORE_MEMBERS_H
#define PCG_CORE_MEMBERS_H

#include "runtime/abi.h"

typedef struct core_members {
    pcg_entity **at;
    pcg_u32 count;
    pcg_u32 owned; /* parts of a shape: how many of them are held, in an array of as many */
    int there;     /* it is a container */
} core_members;

/* `kind`: PCG_PART_KIND_FACES … , of a shape. What is no container has no members, which a warning
 * says. Status; there is something to close unless it fails. */
int core_members_open(pcg_call *call, pcg_entity *container, int kind, core_members *m);
void core_members_close(pcg_run *r, core_members *m);

#endif

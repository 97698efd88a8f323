/* group_entity.h - groups: entities that hold others, by reference. */
#ifndef PCG_CORE_GROUP_ENTITY_H
#define PCG_CORE_GROUP_ENTITY_H

#include "runtime/abi.h"

/* How deep groups may be in groups: what they hold is copied and given up recursively. */
enum { CORE_GROUP_DEPTH = 1000 };

typedef struct core_group {
    pcg_entity entity;
    pcg_entity **members; /* a reference to each */
    pcg_u32 count;
    pcg_u32 depth; /* 1 where no member is a group itself */
} core_group;

extern const pcg_type core_type_group;

/* A group that descends from the first of its members and takes their references over, also
 * where it fails: then NULL. At least one member. */
core_group *core_group_new(pcg_call *call, pcg_entity *const *members, pcg_u32 count);

#endif

/* types.c - the types of entities that are built in, by their names, for parcels. */
#include <string.h>

#include "runtime/parcel.h"
#include "stdlib/core/group_entity.h"
#include "stdlib/streets/streets.h"

const pcg_type *parcel_type(const char *name)
{
    static const pcg_type *const types[] = {&pcg_type_entity, &pcg_type_impulse, &pcg_type_shape,
                                            &core_type_group, &pcg_type_street_network};
    for (size_t i = 0; i < COUNT_OF(types); i++)
        if (!strcmp(types[i]->name, name))
            return types[i];
    return NULL;
}

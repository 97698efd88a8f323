/* gdal.c - finds GDAL's functions. */
#include "gdal.h"

#ifdef PCG_GDAL_LIBRARY

#include <dlfcn.h>
#include <string.h>

/* dlsym gives functions as data pointers, which C does not convert. */
static int find_symbol(void *library, const char *name, void *function, size_t size)
{
    void *address = dlsym(library, name);
    memcpy(function, &address, size);
    return address != NULL;
}

const char *gdal_load(gdal_library *l)
{
    void *library = dlopen(PCG_GDAL_LIBRARY, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library)
        return "the library " PCG_GDAL_LIBRARY " cannot be loaded; install GDAL";
    int found = 1;
#define GDAL_FIND(result, name, parameters)                                                        \
    found &= find_symbol(library, #name, &l->name, sizeof l->name);
    GDAL_FUNCTIONS(GDAL_FIND)
#undef GDAL_FIND
    dlclose(library);
    if (!found)
        return "the library " PCG_GDAL_LIBRARY " lacks functions; version 3.4 or later is wanted";
    l->GDALAllRegister();
    if (!strstr(l->GDALVersionInfo("BUILD_INFO"), "GEOS_ENABLED=YES"))
        return "the library " PCG_GDAL_LIBRARY
               " was built without GEOS, which looks for bad geometry";
    return NULL;
}

void *gdal_handler_data(void)
{
    void *(*data)(void) = NULL;
    void *library = dlopen(PCG_GDAL_LIBRARY, RTLD_NOW | RTLD_NOLOAD);
    if (!library)
        return NULL;
    int found = find_symbol(library, "CPLGetErrorHandlerUserData", &data, sizeof data);
    dlclose(library);
    return found ? data() : NULL;
}

#else

typedef int gdal_is_left_out; /* a file of C holds something */

#endif

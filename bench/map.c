/* map.c - how fast a map can be read at best: GDAL alone, which is what read_map stands on. Every
 * feature is read, and its points are asked for, and nothing is made of them.
 *
 *     map FILE
 */
#include "rival.h"
#include "stdlib/gis/gdal.h"

#ifdef PCG_GDAL_LIBRARY

static uint64_t count_points(const gdal_library *l, gdal_geometry *g)
{
    uint64_t sum = (uint64_t)l->OGR_G_GetPointCount(g);
    for (int i = 0; i < l->OGR_G_GetGeometryCount(g); i++)
        sum += count_points(l, l->OGR_G_GetGeometryRef(g, i));
    return sum;
}

/* OpenStreetMap's layers come interleaved: the file is asked for features, not its layers. */
static uint64_t read_points(const gdal_library *l, gdal_dataset *map)
{
    uint64_t points = 0;
    gdal_layer *layer;
    gdal_feature *f;
    while ((f = l->GDALDatasetGetNextFeature(map, &layer, NULL, NULL, NULL))) {
        gdal_geometry *g = l->OGR_F_GetGeometryRef(f);
        const int type = g ? l->OGR_GT_Flatten(l->OGR_G_GetGeometryType(g)) : 0;
        if (type && type != GDAL_POINT)
            points += count_points(l, g);
        l->OGR_F_Destroy(f);
    }
    return points;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: map FILE\n", stderr);
        return 2;
    }
    gdal_library l;
    rival r = {0};
    rival_begin(&r);
    const char *why = gdal_load(&l);
    rival_end(&r, "load");
    if (why) {
        fprintf(stderr, "%s\n", why);
        return 1;
    }
    l.CPLSetThreadLocalConfigOption("OGR_INTERLEAVED_READING", "YES");
    rival_begin(&r);
    gdal_dataset *map =
        l.GDALOpenEx(argv[1], GDAL_READ_VECTORS | GDAL_TELL_ERRORS, NULL, NULL, NULL);
    if (!map)
        return 1;
    const uint64_t points = read_points(&l, map);
    l.GDALClose(map);
    rival_end(&r, "read");
    rival_print(&r, "points", points);
    return 0;
}

#else

int main(void)
{
    fputs("built without GDAL\n", stderr);
    return 1;
}

#endif

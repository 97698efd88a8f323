/* map.c - a file of features: its layers, where they are on Earth, one feature after the other. */
#include "map.h"

#ifdef PCG_GDAL_LIBRARY

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "runtime/value.h"

/* ---- what GDAL says -------------------------------------------------------------------------- */

void map_hush(map *m)
{
    m->said = (map_said){{0}, 0, false};
}

int map_tell(map *m)
{
    const map_said *said = &m->said;
    if (!said->message[0])
        return PCG_OK;
    char more[40] = "";
    if (said->more)
        snprintf(more, sizeof more, " (and %u more)", said->more);
    int status = pcg_warn(m->call, "the reader of '%s' says: %s%s", m->file, said->message, more);
    map_hush(m);
    return status;
}

/* ---- layers ---------------------------------------------------------------------------------- */

/* The transformation of a coordinate system into longitude and latitude, in that order. */
static int find_transform(map *m, map_layer *l, gdal_reference *from)
{
    gdal_library *g = &m->gdal;
    if (g->OSRIsSame(from, m->wgs84)) {
        l->place = MAP_DEGREES;
        return PCG_OK;
    }
    l->place = MAP_TRANSFORMED;
    l->transform = g->OCTNewCoordinateTransformation(from, m->wgs84);
    if (l->transform)
        return PCG_OK;
    return pcg_fail(m->call, "the coordinate system of layer '%s' of '%s' cannot be used: %s",
                    l->name, m->file, m->said.message);
}

static int place_layer(map *m, map_layer *l, const char *crs)
{
    gdal_library *g = &m->gdal;
    gdal_reference *own = g->OGR_L_GetSpatialRef(l->layer);
    if (own)
        return find_transform(m, l, own);
    l->place = MAP_UNKNOWN;
    if (!crs[0])
        return PCG_OK;
    l->place = MAP_LOCAL;
    if (!strcmp(crs, "local"))
        return PCG_OK;
    gdal_reference *given = g->OSRNewSpatialReference(NULL);
    g->OSRSetAxisMappingStrategy(given, GDAL_LONGITUDE_FIRST);
    int status = strchr(crs, '/') || g->OSRSetFromUserInput(given, crs) != GDAL_DONE
                     ? pcg_fail(m->call, "'%s' is no coordinate system", crs)
                     : find_transform(m, l, given);
    g->OSRDestroySpatialReference(given);
    return status;
}

static int find_layers(map *m, const char *crs)
{
    gdal_library *g = &m->gdal;
    int count = g->GDALDatasetGetLayerCount(m->dataset);
    m->layer_room = (size_t)(count > 0 ? count : 0) + 1;
    m->layers = run_alloc_array(m->run, m->layer_room, sizeof *m->layers);
    if (!m->layers)
        return PCG_FAILED;
    int status = PCG_OK;
    for (int i = 0; i < count && status == PCG_OK; i++) {
        map_layer *l = &m->layers[m->layer_count++];
        l->layer = g->GDALDatasetGetLayer(m->dataset, i);
        const char *name = g->OGR_L_GetName(l->layer);
        l->name = pcg_string(m->call->run, value_is_utf8(name) ? name : "?");
        l->tags = g->OGR_FD_GetFieldIndex(g->OGR_L_GetLayerDefn(l->layer), "other_tags");
        status = l->name ? place_layer(m, l, crs) : PCG_FAILED;
    }
    return status;
}

/* ---- opening --------------------------------------------------------------------------------- */

/* Only what is in the file system: GDAL itself takes addresses on the net, and texts, for file
 * names. */
static int check_file(const map *m)
{
    struct stat about;
    if (stat(m->path, &about) != 0)
        return pcg_fail(m->call, "no map '%s'", m->file);
    if (!S_ISREG(about.st_mode))
        return pcg_fail(m->call, "the map '%s' is no file", m->file);
    return PCG_OK;
}

static int open_dataset(map *m)
{
    int status = worker_do(m, work_open);
    if (status != PCG_OK)
        return status;
    if (m->wrong)
        return pcg_fail(m->call, "maps cannot be read: %s", m->wrong);
    if (!m->dataset)
        return pcg_fail(m->call, "'%s' is no map in OSM, GeoJSON, Shapefile or GeoPackage: %s",
                        m->file, m->said.message[0] ? m->said.message : "none of them reads it");
    return map_tell(m);
}

int map_open(map *m, pcg_call *call, const char *file, const char *crs)
{
    m->run = call->run;
    m->call = call;
    m->file = file;
    m->memory = call->run->memory.limit;
    m->path = pcg_path(call, file);
    PCG_TRY(m->path ? check_file(m) : PCG_FAILED);
    PCG_TRY(worker_start(m));
    PCG_TRY(open_dataset(m));
    m->gdal.CPLPushErrorHandlerEx(worker_message, m);
    m->hushed = true;
    return find_layers(m, crs);
}

bool map_close(map *m)
{
    pcg_run *r = m->run;
    if (m->hushed)
        m->gdal.CPLPopErrorHandler();
    m->hushed = false;
    if (m->worker.started && worker_do(m, work_close) != PCG_OK)
        return false;
    worker_end(m);
    run_free(r, m->points, m->point_capacity * sizeof *m->points);
    run_free(r, m->vertices, m->point_capacity * sizeof *m->vertices);
    run_free(r, m->tag, m->tag_capacity);
    run_free(r, m->layers, m->layers ? m->layer_room * sizeof *m->layers : 0);
    return true;
}

/* ---- where it is ----------------------------------------------------------------------------- */

/* Six decimals are 0.1 m, and can be typed. */
static double short_degrees(double degrees)
{
    return floor(degrees * 1e6 + 0.5) / 1e6;
}

static bool any_on_earth(const map *m)
{
    for (uint32_t i = 0; i < m->layer_count; i++)
        if (m->layers[i].place == MAP_DEGREES || m->layers[i].place == MAP_TRANSFORMED)
            return true;
    return false;
}

int map_locate(map *m, const pcg_list *origin)
{
    if (origin->count == 2) {
        double latitude = origin->at[0].f, longitude = origin->at[1].f;
        if (!(fabs(latitude) <= 90) || !(fabs(longitude) <= 180))
            return pcg_fail(
                m->call,
                "the origin is no place: its latitude is -90 to 90, its longitude -180 to 180");
        gis_projection_open(&m->projection, latitude, longitude);
        m->on_earth = any_on_earth(m);
        return PCG_OK;
    }
    if (origin->count)
        return pcg_fail(m->call,
                        "the origin is a latitude and a longitude, or nothing; found %u numbers",
                        origin->count);
    PCG_TRY(worker_do(m, work_bounds));
    map_hush(m);
    const gdal_envelope *b = &m->bounds;
    bool found = b->low_x <= b->high_x;
    m->on_earth = found;
    gis_projection_open(&m->projection, found ? short_degrees((b->low_y + b->high_y) / 2) : 0,
                        found ? short_degrees((b->low_x + b->high_x) / 2) : 0);
    return PCG_OK;
}

/* ---- features -------------------------------------------------------------------------------- */

/* way/123 in OSM, and the number of the feature elsewhere. */
static void name_feature(map *m)
{
    static const char *const kinds[][2] = {{"points", "node"}, {"lines", "way"}};
    const char *kind = "relation", *id = m->is_osm ? map_value(m, "osm_id") : NULL;
    for (size_t i = 0; i < COUNT_OF(kinds); i++)
        if (!strcmp(m->layer->name, kinds[i][0]))
            kind = kinds[i][1];
    if (m->is_osm && !id) {
        kind = "way";
        id = map_value(m, "osm_way_id");
    }
    if (id)
        snprintf(m->id, sizeof m->id, "%s/%s", kind, id);
    else
        snprintf(m->id, sizeof m->id, "%lld", (long long)m->gdal.OGR_F_GetFID(m->feature));
}

static const map_layer *layer_of(const map *m, const gdal_layer *layer)
{
    for (uint32_t i = 0; i < m->layer_count; i++)
        if (m->layers[i].layer == layer)
            return &m->layers[i];
    return &m->layers[0];
}

/* Takes the next feature of the batch; with the last one comes what happened when it was read. */
static void take_feature(map *m)
{
    map_batch *b = &m->batch;
    if (b->taken < b->count) {
        m->layer = layer_of(m, b->layers[b->taken]);
        m->feature = b->features[b->taken++];
    }
    if (b->taken < b->count)
        return;
    m->said = b->said;
    b->said = (map_said){{0}, 0, false};
    map_lost **end = &m->lost;
    while (*end)
        end = &(*end)->next;
    *end = b->lost;
    b->lost = NULL;
}

int map_next(map *m)
{
    if (m->feature)
        m->gdal.OGR_F_Destroy(m->feature);
    m->feature = NULL;
    m->problem = NULL;
    PCG_TRY(pcg_tick(m->call));
    if (m->batch.taken == m->batch.count && !m->batch.ended)
        PCG_TRY(worker_do(m, work_read));
    take_feature(m);
    if (m->feature)
        name_feature(m);
    return PCG_OK;
}

map_lost *map_take_lost(map *m)
{
    map_lost *lost = m->lost;
    m->lost = NULL;
    return lost;
}

void map_free_lost(map_lost *l)
{
    while (l) {
        map_lost *next = l->next;
        free(l);
        l = next;
    }
}

/* ---- fields ---------------------------------------------------------------------------------- */

/* The number of a field that has a value, or -1. */
static int field_of(const map *m, const char *field)
{
    int index = m->gdal.OGR_FD_GetFieldIndex(m->gdal.OGR_F_GetDefnRef(m->feature), field);
    return index >= 0 && m->gdal.OGR_F_IsFieldSetAndNotNull(m->feature, index) ? index : -1;
}

/* Room for the value of a tag. */
static bool grow_tag(map *m, size_t size)
{
    if (size <= m->tag_capacity)
        return true;
    char *tag = run_resize(m->call->run, m->tag, m->tag_capacity, size);
    if (!tag)
        return false;
    m->tag = tag;
    m->tag_capacity = size;
    return true;
}

const char *map_value(void *context, const char *field)
{
    map *m = context;
    int index = field_of(m, field);
    if (index >= 0)
        return m->gdal.OGR_F_GetFieldAsString(m->feature, index);
    if (!m->layer || m->layer->tags < 0 ||
        !m->gdal.OGR_F_IsFieldSetAndNotNull(m->feature, m->layer->tags))
        return NULL;
    const char *tags = m->gdal.OGR_F_GetFieldAsString(m->feature, m->layer->tags);
    return grow_tag(m, strlen(tags) + 1) && gis_tags_find(tags, field, m->tag) ? m->tag : NULL;
}

bool map_number(map *m, const char *field, double *to)
{
    int index = field_of(m, field);
    if (index < 0)
        return false;
    gdal_field *about = m->gdal.OGR_FD_GetFieldDefn(m->gdal.OGR_F_GetDefnRef(m->feature), index);
    int type = m->gdal.OGR_Fld_GetType(about);
    *to = m->gdal.OGR_F_GetFieldAsDouble(m->feature, index);
    return type == GDAL_TYPE_REAL && isfinite(*to);
}

bool map_has_field(const map *m, const char *field)
{
    for (uint32_t i = 0; i < m->layer_count; i++) {
        gdal_definition *about = m->gdal.OGR_L_GetLayerDefn(m->layers[i].layer);
        if (m->layers[i].tags >= 0 || m->gdal.OGR_FD_GetFieldIndex(about, field) >= 0)
            return true;
    }
    return false;
}

#else

typedef int map_is_left_out; /* a file of C holds something */

#endif

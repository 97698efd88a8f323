/* worker.c - GDAL at work on a map, in a thread of its own: opening, reading ahead, and what takes
 * long with large geometry. Nothing here touches the run or the call, but for worker_do, which the
 * run's own thread is in.
 */
#include "map.h"

#ifdef PCG_GDAL_LIBRARY

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "runtime/value.h"

enum {
    STACK_BYTES = 8 << 20,      /* what GDAL's parsers are used to */
    WAIT_NANOSECONDS = 5000000, /* between two looks at whether the run was cancelled */
    BLOCK_BYTES = 16 << 10,
    LARGE_BYTES = 64 << 10, /* geometry that is not looked at on the spot */
    BATCH_BYTES = 4 << 20,  /* of geometry that is read ahead */
    MEGABYTE = 1 << 20,
    OBJECT_SHARE = 32,          /* what GeoJSON takes in memory, in times of its text */
    OBJECT_MEGABYTES_MAX = 200, /* of one feature's text: GDAL's own */
    TEMPORARY_MEGABYTES_MAX =
        100 /* of the nodes of an OSM file: GDAL's own, then it takes a file */
};

/* ---- what GDAL says -------------------------------------------------------------------------- */

static bool add_lost(map_lost ***end, const char *problem)
{
    map_lost *lost = calloc(1, sizeof *lost);
    if (!lost)
        return false;
    lost->problem = problem;
    **end = lost;
    *end = &lost->next;
    return true;
}

/* "OSM: Way 12 with 1 nodes that could be found. Discarding it" */
static void collect_lost(map *m, const char *said)
{
    static const struct {
        const char *begin, *kind, *problem;
    } forms[] = {
        {"OSM: Way ", "way", "less than two of its nodes are in the file"},
        {"OSM: Relation ", "relation", "its ways are not all in the file"},
    };
    for (size_t i = 0; i < COUNT_OF(forms); i++) {
        size_t length = strlen(forms[i].begin);
        if (strncmp(said, forms[i].begin, length) != 0 ||
            !(strstr(said, "Discarding it") || strstr(said, "Ignoring it")))
            continue;
        map_lost **lost = m->batch.lost_end;
        int digits = (int)strspn(said + length, "-0123456789");
        if (add_lost(&m->batch.lost_end, forms[i].problem))
            snprintf((*lost)->id, sizeof(*lost)->id, "%s/%.*s", forms[i].kind, digits,
                     said + length);
    }
}

/* Leaves out the folders of the map, which differ from machine to machine. */
static void copy_message(char *to, size_t room, const char *said, const char *path)
{
    const char *slash = strrchr(path, '/');
    size_t folder = slash ? (size_t)(slash - path) + 1 : 0, length = 0;
    while (*said && length + 1 < room) {
        if (folder > 1 && !strncmp(said, path, folder))
            said += folder;
        else
            to[length++] = *said++;
    }
    to[length] = '\0';
}

static void keep_message(const map *m, map_said *to, const char *said, bool failed)
{
    to->failed = failed;
    copy_message(to->message, sizeof to->message, said, m->path);
    bool utf8 = value_is_utf8(to->message);
    for (char *c = to->message; *c; c++)
        if ((unsigned char)*c < ' ' || (!utf8 && (*c & 0x80)))
            *c = '?';
}

void worker_message(gdal_level level, int number, const char *said)
{
    (void)number;
    map *m = gdal_handler_data();
    bool failed = level >= GDAL_FAILURE;
    if (m && level == GDAL_DEBUG && m->batch.lost_end)
        collect_lost(m, said);
    if (!m || level < GDAL_WARNING)
        return;
    m->said.more += m->said.message[0] != '\0';
    if (!m->said.message[0] || (failed && !m->said.failed))
        keep_message(m, &m->said, said, failed);
}

/* ---- opening --------------------------------------------------------------------------------- */

/* Sets an option to a number of megabytes: a share of what the run may take, within GDAL's own
 * bound. */
static void bound(const map *m, const char *option, size_t share, size_t most)
{
    char number[32];
    size_t megabytes = m->memory / share / MEGABYTE;
    megabytes = megabytes < 1 ? 1 : megabytes > most ? most : megabytes;
    snprintf(number, sizeof number, "%zu", megabytes);
    m->gdal.CPLSetThreadLocalConfigOption(option, number);
}

/* Elements of a GeoJSON file that are no features come with the first batch. */
static void find_others(map *m)
{
    gis_elements place = {.index = 0};
    char block[BLOCK_BYTES];
    map_lost **end = &m->lost;
    size_t read;
    FILE *f = fopen(m->path, "rb");
    while (f && !atomic_load(&m->worker.stop) && (read = fread(block, 1, sizeof block, f)) > 0)
        for (size_t i = 0; i < read; i++) {
            map_lost **lost = end;
            if (gis_element_is_other(&place, block[i]) && add_lost(&end, "it is no object"))
                snprintf((*lost)->id, sizeof(*lost)->id, "features[%llu]",
                         (unsigned long long)place.index);
        }
    if (f)
        fclose(f);
}

void work_open(map *m)
{
    static const char *const drivers[] = {"OSM", "GeoJSON", "ESRI Shapefile", "GPKG", NULL};
    gdal_library *g = &m->gdal;
    m->wrong = gdal_load(g);
    if (m->wrong)
        return;
    g->CPLPushErrorHandlerEx(worker_message, m);
    bound(m, "OGR_GEOJSON_MAX_OBJ_SIZE", OBJECT_SHARE, OBJECT_MEGABYTES_MAX);
    bound(m, "OSM_MAX_TMPFILE_SIZE", OBJECT_SHARE, TEMPORARY_MEGABYTES_MAX);
    m->wgs84 = g->OSRNewSpatialReference(NULL);
    g->OSRSetWellKnownGeogCS(m->wgs84, "WGS84");
    g->OSRSetAxisMappingStrategy(m->wgs84, GDAL_LONGITUDE_FIRST);
    m->dataset = g->GDALOpenEx(m->path, GDAL_READ_VECTORS | GDAL_TELL_ERRORS, drivers, NULL, NULL);
    if (!m->dataset)
        return;
    const char *driver = g->GDALGetDriverShortName(g->GDALGetDatasetDriver(m->dataset));
    m->is_osm = !strcmp(driver, "OSM");
    if (!strcmp(driver, "GeoJSON"))
        find_others(m);
}

static void destroy_lost(map_lost **lost)
{
    map_free_lost(*lost);
    *lost = NULL;
}

/* Whatever of GDAL's there is. */
void work_close(map *m)
{
    gdal_library *g = &m->gdal;
    map_batch *b = &m->batch;
    destroy_lost(&b->lost);
    destroy_lost(&m->lost);
    if (!m->wgs84)
        return;
    while (b->taken < b->count)
        g->OGR_F_Destroy(b->features[b->taken++]);
    if (m->feature)
        g->OGR_F_Destroy(m->feature);
    if (m->straight)
        g->OGR_G_DestroyGeometry(m->straight);
    if (m->mended)
        g->OGR_G_DestroyGeometry(m->mended);
    for (uint32_t i = 0; i < m->layer_count; i++)
        if (m->layers[i].transform)
            g->OCTDestroyCoordinateTransformation(m->layers[i].transform);
    if (m->dataset)
        g->GDALClose(m->dataset);
    g->OSRDestroySpatialReference(m->wgs84);
    g->CPLPopErrorHandler();
    m->wgs84 = NULL;
}

/* ---- where it is ----------------------------------------------------------------------------- */

/* Widens the bounds, in longitude and latitude, by an envelope in a layer's coordinates. False
 * where that is nowhere. */
static bool add_envelope(map *m, const map_layer *l, const gdal_envelope *e)
{
    double x[4] = {e->low_x, e->high_x, e->low_x, e->high_x};
    double y[4] = {e->low_y, e->low_y, e->high_y, e->high_y};
    if (l->place == MAP_LOCAL || l->place == MAP_UNKNOWN)
        return true;
    if (l->transform && !m->gdal.OCTTransform(l->transform, 4, x, y, NULL))
        return false;
    for (int i = 0; i < 4; i++)
        if (!(fabs(x[i]) <= 360) || !(fabs(y[i]) <= 90))
            return false;
    for (int i = 0; i < 4; i++) {
        m->bounds.low_x = fmin(m->bounds.low_x, x[i]);
        m->bounds.high_x = fmax(m->bounds.high_x, x[i]);
        m->bounds.low_y = fmin(m->bounds.low_y, y[i]);
        m->bounds.high_y = fmax(m->bounds.high_y, y[i]);
    }
    return true;
}

/* What the file says of its layers. False where it does not. */
static bool ask_layers(map *m)
{
    for (uint32_t i = 0; i < m->layer_count; i++) {
        gdal_envelope e;
        /* A layer without features has no bounds, and needs none. */
        if (m->gdal.OGR_L_GetExtent(m->layers[i].layer, &e, !m->is_osm) != GDAL_DONE) {
            if (m->is_osm)
                return false;
        } else if (!add_envelope(m, &m->layers[i], &e)) {
            return false;
        }
    }
    return true;
}

static const map_layer *layer_of(const map *m, const gdal_layer *layer)
{
    for (uint32_t i = 0; i < m->layer_count; i++)
        if (m->layers[i].layer == layer)
            return &m->layers[i];
    return &m->layers[0];
}

/* Goes through the features. */
static void look_for_bounds(map *m)
{
    do {
        work_read(m);
        for (; m->batch.taken < m->batch.count; m->batch.taken++) {
            gdal_envelope e;
            gdal_feature *f = m->batch.features[m->batch.taken];
            gdal_geometry *g = m->gdal.OGR_F_GetGeometryRef(f);
            if (g && !m->gdal.OGR_G_IsEmpty(g)) {
                m->gdal.OGR_G_GetEnvelope(g, &e);
                add_envelope(m, layer_of(m, m->batch.layers[m->batch.taken]), &e);
            }
            m->gdal.OGR_F_Destroy(f);
        }
    } while (!m->batch.ended);
}

void work_bounds(map *m)
{
    const gdal_envelope none = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
    m->bounds = none;
    if (!ask_layers(m)) {
        m->bounds = none;
        look_for_bounds(m);
        m->batch = (map_batch){.count = 0};
    }
    /* Asked for bounds, the reader of OSM begins to read, and tells what is wrong but once. */
    m->gdal.GDALDatasetResetReading(m->dataset);
}

/* ---- reading --------------------------------------------------------------------------------- */

/* GDAL stops where this returns 0. */
static int on_progress(double done, const char *message, void *context)
{
    map *m = context;
    (void)done, (void)message;
    return !atomic_load(&m->worker.stop);
}

/* One more feature for the batch; false at the end. */
static bool read_one(map *m, size_t *bytes)
{
    map_batch *b = &m->batch;
    gdal_layer *layer = NULL;
    /* Elsewhere features come one by one, and GDAL may call without the context. */
    gdal_feature *f = m->gdal.GDALDatasetGetNextFeature(m->dataset, &layer, NULL,
                                                        m->is_osm ? on_progress : NULL, m);
    if (!f)
        return false;
    gdal_geometry *g = m->gdal.OGR_F_GetGeometryRef(f);
    int size = g ? m->gdal.OGR_G_WkbSize(g) : 0;
    *bytes += size > 0 ? (size_t)size : 0;
    b->features[b->count] = f;
    b->layers[b->count++] = layer;
    return true;
}

/* Until the batch is full, or there is something to tell of its last feature. */
void work_read(map *m)
{
    map_batch *b = &m->batch;
    size_t bytes = 0;
    b->count = b->taken = 0;
    m->said = (map_said){{0}, 0, false};
    if (m->collects_lost && m->is_osm) {
        b->lost_end = &b->lost;
        m->gdal.CPLSetThreadLocalConfigOption("CPL_DEBUG", "OSM");
    }
    do {
        b->ended = !read_one(m, &bytes);
    } while (!b->ended && !b->lost && !m->said.message[0] && b->count < MAP_BATCH &&
             bytes < BATCH_BYTES && !atomic_load(&m->worker.stop));
    b->lost_end = NULL;
    b->said = m->said;
    m->said = (map_said){{0}, 0, false};
}

/* ---- geometry -------------------------------------------------------------------------------- */

void work_straighten(map *m)
{
    gdal_library *g = &m->gdal;
    m->straight = g->OGR_G_HasCurveGeometry(m->geometry, 1)
                      ? g->OGR_G_GetLinearGeometry(m->geometry, 0, NULL)
                      : g->OGR_G_Clone(m->geometry);
    if (!m->straight || !m->layer->transform ||
        g->OGR_G_Transform(m->straight, m->layer->transform) == GDAL_DONE)
        return;
    g->OGR_G_DestroyGeometry(m->straight);
    m->straight = NULL;
}

void work_validate(map *m)
{
    m->gdal.OGR_G_CloseRings(m->geometry);
    m->valid = m->gdal.OGR_G_IsValid(m->geometry);
}

void work_mend(map *m)
{
    /* Holes are taken off their outlines; one outside becomes an area of its own. */
    char method[] = "METHOD=STRUCTURE", *options[] = {method, NULL};
    m->mended = m->gdal.OGR_G_MakeValidEx(m->geometry, options);
}

/* ---- the thread ------------------------------------------------------------------------------ */

static void *work_on(void *context)
{
    map *m = context;
    map_worker *w = &m->worker;
    pthread_mutex_lock(&w->mutex);
    while (w->work || !w->over) {
        map_work_function *work = w->work;
        if (!work) {
            pthread_cond_wait(&w->changed, &w->mutex);
            continue;
        }
        pthread_mutex_unlock(&w->mutex);
        work(m);
        pthread_mutex_lock(&w->mutex);
        w->work = NULL;
        pthread_cond_broadcast(&w->changed);
    }
    pthread_mutex_unlock(&w->mutex);
    work_close(m);
    return NULL;
}

static void end_with_run(void *context)
{
    worker_end(context);
}

/* The thread takes no signals: they are the host's. */
static bool start_thread(map *m)
{
    pthread_attr_t attributes;
    sigset_t all, before;
    sigfillset(&all);
    if (pthread_attr_init(&attributes) != 0)
        return false;
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    m->worker.started = pthread_create(&m->worker.thread, &attributes, work_on, m) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    return m->worker.started;
}

int worker_start(map *m)
{
    map_worker *w = &m->worker;
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_mutex_init(&w->mutex, NULL);
    pthread_cond_init(&w->changed, &attributes);
    pthread_condattr_destroy(&attributes);
    atomic_init(&w->stop, false);
    if (!start_thread(m)) {
        pthread_cond_destroy(&w->changed);
        pthread_mutex_destroy(&w->mutex);
        return pcg_fail(m->call, "maps cannot be read: no thread can be started");
    }
    w->ending = (run_ending){NULL, end_with_run, m};
    run_ending_add(m->run, &w->ending);
    return PCG_OK;
}

void worker_end(map *m)
{
    map_worker *w = &m->worker;
    if (!w->started)
        return;
    atomic_store(&w->stop, true);
    pthread_mutex_lock(&w->mutex);
    w->over = true;
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->mutex);
    pthread_join(w->thread, NULL);
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->mutex);
    w->started = false;
    run_ending_remove(m->run, &w->ending);
}

/* ---- waiting for it -------------------------------------------------------------------------- */

static struct timespec soon(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    t.tv_nsec += WAIT_NANOSECONDS;
    if (t.tv_nsec >= 1000000000) {
        t.tv_nsec -= 1000000000;
        t.tv_sec++;
    }
    return t;
}

int worker_do(map *m, map_work_function *work)
{
    map_worker *w = &m->worker;
    int status = m->interrupted;
    if (status != PCG_OK)
        return status;
    pthread_mutex_lock(&w->mutex);
    w->work = work;
    pthread_cond_broadcast(&w->changed);
    while (w->work && status == PCG_OK) {
        const struct timespec until = soon();
        if (pthread_cond_timedwait(&w->changed, &w->mutex, &until) == ETIMEDOUT) {
            pthread_mutex_unlock(&w->mutex);
            status = pcg_tick(m->call);
            pthread_mutex_lock(&w->mutex);
        }
    }
    m->interrupted = w->work ? status : PCG_OK;
    pthread_mutex_unlock(&w->mutex);
    if (m->interrupted != PCG_OK)
        atomic_store(&w->stop, true);
    return status;
}

int worker_do_with(map *m, gdal_geometry *g, map_work_function *work)
{
    if (m->interrupted != PCG_OK)
        return m->interrupted;
    m->geometry = g;
    int size = m->gdal.OGR_G_WkbSize(g);
    if (size < 0 || size > LARGE_BYTES)
        return worker_do(m, work);
    work(m);
    return PCG_OK;
}

#else

typedef int worker_is_left_out; /* a file of C holds something */

#endif

/* map.h - a map while it is read: the file and its layers (map.c), GDAL at work (worker.c), and a
 * feature's geometry as a shape (outline.c).
 *
 * GDAL reads, and GEOS looks at large geometry, in a thread of the map's own, so that a run can be
 * cancelled meanwhile: what works there touches neither the run nor the call. One of the two
 * threads waits for the other at any time, until the run is cancelled: then the kernel returns at
 * once, and the map is closed when the thread is done, at the latest by pcg_run_free.
 */
#ifndef PCG_GIS_MAP_H
#define PCG_GIS_MAP_H

#include "gdal.h"

#ifdef PCG_GDAL_LIBRARY

#include <pthread.h>
#include <stdatomic.h>

#include "gis.h"
#include "runtime/base/base.h"
#include "runtime/memory.h"
#include "runtime/run.h"
#include "runtime/shape.h"

enum { MAP_MESSAGE_BYTES = 300, MAP_ID_BYTES = 64, MAP_BATCH = 256 };

typedef enum map_place {
    MAP_DEGREES,     /* longitude and latitude on WGS 84 */
    MAP_TRANSFORMED, /* become that by `transform` */
    MAP_LOCAL,       /* metres, and stay as they are */
    MAP_UNKNOWN      /* the layer does not say, and neither does the graph */
} map_place;

typedef struct map_layer {
    gdal_layer *layer;
    const char *name;
    map_place place;
    gdal_transform *transform;
    int tags; /* the number of the field that holds all tags without a field of their own, or -1 */
} map_layer;

/* A feature that GDAL's reader of OSM leaves out, and says so in passing: its nodes or ways are
 * not in the file. */
typedef struct map_lost {
    struct map_lost *next;
    const char *problem;
    char id[MAP_ID_BYTES];
} map_lost;

/* What GDAL said: the first message, or the first one of an error; "" where nothing. */
typedef struct map_said {
    char message[MAP_MESSAGE_BYTES];
    unsigned more; /* messages besides it */
    bool failed;   /* it is of an error */
} map_said;

/* Features that were read ahead; what GDAL said, and has lost, comes with the last of them. */
typedef struct map_batch {
    gdal_feature *features[MAP_BATCH];
    gdal_layer *layers[MAP_BATCH];
    unsigned count, taken;
    bool ended; /* behind them there are no more */
    map_said said;
    map_lost *lost, **lost_end;
} map_batch;

/* What outline.c estimates from. */
typedef struct map_segment {
    float low_x, high_x, low_y, high_y;
} map_segment;

typedef struct map map;
typedef void map_work_function(map *m);

typedef struct map_worker {
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    map_work_function *work; /* to do, or being done; NULL: none */
    bool started, over;
    atomic_bool stop;        /* whatever is being done may as well end */
    run_ending ending;
} map_worker;

struct map {
    pcg_run *run;
    pcg_call *call;   /* not in the worker */
    const char *file; /* as the graph names it */
    const char *path;
    const char *wrong; /* with GDAL itself, or NULL */
    map_worker worker;
    int interrupted; /* the status that left the worker alone */
    gdal_library gdal;
    bool hushed; /* this thread's errors come here */
    size_t memory; /* bytes that the run may take */
    gdal_dataset *dataset;
    bool is_osm, collects_lost;
    map_layer *layers;
    uint32_t layer_count;
    size_t layer_room;
    gdal_reference *wgs84;
    gdal_envelope bounds;
    gis_projection projection;
    bool on_earth; /* the projection is that of features: they are not local, and there are some */
    bool keep_height;
    map_said said; /* since map_hush */
    map_batch batch;
    map_lost *lost; /* up to the feature in hand */
    /* The feature in hand, and what is made of it; geometries in work. */
    gdal_feature *feature;
    const map_layer *layer;
    char id[MAP_ID_BYTES];
    const char *problem; /* what is wrong with it, or NULL; the run's */
    gdal_geometry *geometry; /* the feature's, or a part of it */
    gdal_geometry *straight; /* of straight lines, in longitude and latitude; owned */
    gdal_geometry *mended;   /* owned */
    bool valid;
    map_segment *segments; /* for work_estimate; the run's */
    size_t segment_count;
    bool few_meetings;
    /* Scratch that grows. */
    pcg_vec3 *points;
    uint32_t *vertices;
    size_t point_capacity;
    char *tag;
    size_t tag_capacity;
};

/* ---- map.c ----------------------------------------------------------------------------------- */

/* Loads GDAL, opens a file and finds its layers. `m` is zeroed but for what the caller chooses, and
 * the run's: it stays until the run is freed where map_close returns false. `crs`: of layers that
 * name none. On failure, too, map_close has to follow. Status. */
int map_open(map *m, pcg_call *call, const char *file, const char *crs);
/* False where the worker is still at it: `m` and what it refers to must not be freed then. */
bool map_close(map *m);
/* Lays the origin: latitude and longitude of a list, or where it is empty the middle of the
 * data. Status. */
int map_locate(map *m, const pcg_list *origin);
/* The next feature, which lasts until the next call, or the end: m->feature is NULL. Status. */
int map_next(map *m);
/* Features that were lost before the one in hand; the caller's, until map_free_lost. */
map_lost *map_take_lost(map *m);
void map_free_lost(map_lost *l);
/* The value of a field of the feature in hand, or of a tag; NULL where it has none. Lasts until
 * the next call. A gis_lookup. */
const char *map_value(void *map, const char *field);
/* The same as a number, where the file holds it as one. */
bool map_number(map *m, const char *field, double *to);
bool map_has_field(const map *m, const char *field); /* in one of the layers */
void map_hush(map *m);
/* Tells what GDAL said, if anything. Status. */
int map_tell(map *m);

/* ---- worker.c -------------------------------------------------------------------------------- */

/* For CPLPushErrorHandlerEx, with the map. */
void worker_message(gdal_level level, int number, const char *said);
/* Begins the thread. Status. */
int worker_start(map *m);
/* Has something done in it, and waits. Where the status is not PCG_OK it goes on alone: of the map,
 * nothing but map_close may be used from then on. */
int worker_do(map *m, map_work_function *work);
/* The same, or at once where `g`, which it is about, is small. */
int worker_do_with(map *m, gdal_geometry *g, map_work_function *work);
/* Ends the thread, which is idle, or waits for it; everything of GDAL's is given back by then. */
void worker_end(map *m);

/* What it is made for. */
void work_open(map *m);       /* m->path to m->dataset; m->wrong */
void work_bounds(map *m);     /* m->bounds; the first is read next */
void work_read(map *m);       /* the next batch */
void work_straighten(map *m); /* m->geometry to m->straight */
void work_validate(map *m);   /* m->geometry to m->valid */
void work_mend(map *m);       /* m->geometry to m->mended */
void work_close(map *m);

/* ---- outline.c ------------------------------------------------------------------------------- */

enum { OUTLINE_AREAS = 1, OUTLINE_LINES = 2, OUTLINE_POINTS = 4 };

/* Which of these a geometry has, as bits. */
int outline_kinds(const map *m, gdal_geometry *g, int depth);
/* Adds what a geometry has of one of them to an empty mesh, projected; geometry that is bad is
 * mended or left out, and m->problem says so. Status. */
int outline_add(map *m, gdal_geometry *g, int kind, pcg_mesh *mesh);
/* Notes what is wrong with the feature in hand; what came first stands. */
void outline_problem(map *m, const char *problem);

#endif

#endif

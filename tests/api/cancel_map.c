/* cancel_map.c - cancelling from another thread while a map is read, at every stage of it: many
 * features, one of many points, a file of OpenStreetMap. Without GDAL nothing can be cancelled. */
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

enum { FEATURES = 30000, RING = 150000, NODES = 50000, TIMES = 12, FILES = 3 };

/* The promise is 50 ms. A machine that is busy with other things may wake the threads later: some
 * may be. */
enum { LATE_ALLOWED = 4 };

static const char graph[] =
    "use gis\n"
    "graph town {\n"
    "    param map: path\n"
    "    m: read_map(file = map) { areas: polygons(); lines: lines(); points: points() }\n"
    "}\n";

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* ---- the maps -------------------------------------------------------------------------------- */

static void write_features(FILE *f)
{
    fputs("{\"type\":\"FeatureCollection\",\"features\":[", f);
    for (int i = 0; i < FEATURES; i++) {
        double x = 9 + i % 300 * 1e-4, y = 47 + i / 300 * 1e-4;
        fprintf(f,
                "%s{\"type\":\"Feature\",\"properties\":{\"n\":%d},\"geometry\":{\"type\":"
                "\"Polygon\",\"coordinates\":[[[%.5f,%.5f],[%.5f,%.5f],[%.5f,%.5f],[%.5f,%.5f]]]}}",
                i ? "," : "", i, x, y, x + 5e-5, y, x, y + 5e-5, x, y);
    }
    fputs("]}", f);
}

static void write_ring(FILE *f)
{
    fputs("{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\","
          "\"coordinates\":[[",
          f);
    for (int i = 0; i <= RING; i++) {
        double turn = 6.283185307179586 * (i % RING) / RING;
        fprintf(f, "%s[%.8f,%.8f]", i ? "," : "", 9 + 0.01 * cos(turn), 47 + 0.01 * sin(turn));
    }
    fputs("]]}}", f);
}

static void write_streets(FILE *f)
{
    fputs("<osm version=\"0.6\">\n", f);
    for (int i = 1; i <= NODES; i++)
        fprintf(f, "<node id=\"%d\" lat=\"%.5f\" lon=\"%.5f\"/>\n", i, 47 + i / 300 * 1e-4,
                9 + i % 300 * 1e-4);
    for (int i = 1; i + 10 <= NODES; i += 10) {
        fprintf(f, "<way id=\"%d\">", i);
        for (int k = 0; k < 10; k++)
            fprintf(f, "<nd ref=\"%d\"/>", i + k);
        fputs("<tag k=\"highway\" v=\"track\"/></way>\n", f);
    }
    fputs("</osm>\n", f);
}

static const struct {
    const char *name;
    void (*write)(FILE *f);
} files[FILES] = {
    {"features.geojson", write_features},
    {"ring.geojson", write_ring},
    {"streets.osm", write_streets},
};

/* ---- cancelling ------------------------------------------------------------------------------ */

typedef struct canceller {
    pcg_run *run;
    double after, cancelled;
} canceller;

static void *cancel_later(void *context)
{
    canceller *c = context;
    const struct timespec t = {(time_t)c->after,
                               (long)((c->after - (double)(time_t)c->after) * 1e9)};
    nanosleep(&t, NULL);
    c->cancelled = now();
    pcg_run_cancel(c->run);
    return NULL;
}

/* Whether the run ended in time. One that was done before it was cancelled counts as such. */
static bool cancel_once(const pcg_program *p, const char *file, double after)
{
    pthread_t thread;
    canceller c = {.run = pcg_run_new(p, NULL), .after = after};
    CHECK_NUMBER(pcg_run_set_string(c.run, "map", file), PCG_STATUS_OK);
    pthread_create(&thread, NULL, cancel_later, &c);
    pcg_status status = pcg_run_execute(c.run);
    double ended = now();
    pthread_join(thread, NULL);
    CHECK(status == PCG_STATUS_CANCELLED || status == PCG_STATUS_OK);
    CHECK_TEXT(pcg_run_error(c.run), status == PCG_STATUS_OK ? "" : "the run was cancelled");
    pcg_run_free(c.run);
    return ended - c.cancelled < 0.05;
}

/* How long reading takes; negative where it cannot be done. */
static double read_once(const pcg_program *p, const char *file)
{
    pcg_run *r = pcg_run_new(p, NULL);
    double began = now();
    CHECK_NUMBER(pcg_run_set_string(r, "map", file), PCG_STATUS_OK);
    pcg_status status = pcg_run_execute(r);
    double took = now() - began;
    bool left_out = strstr(pcg_run_error(r), "GDAL was left out") != NULL;
    CHECK(left_out || status == PCG_STATUS_OK);
    pcg_run_free(r);
    return left_out ? -1 : took;
}

static int cancel_often(const pcg_program *p, int file)
{
    int late = 0;
    double took = read_once(p, files[file].name);
    for (int i = 0; i < TIMES && took >= 0; i++)
        late += !cancel_once(p, files[file].name, took * i / TIMES);
    return late;
}

int main(void)
{
    const pcg_compile_options options = {.size = sizeof options};
    pcg_program *p = pcg_compile_text(graph, strlen(graph), "town.pcg", &options);
    int late = 0;
    CHECK(p != NULL);
    for (int i = 0; i < FILES && p; i++) {
        FILE *f = fopen(files[i].name, "w");
        CHECK(f != NULL);
        if (!f)
            continue;
        files[i].write(f);
        CHECK(fclose(f) == 0);
        late += cancel_often(p, i);
    }
    if (late > LATE_ALLOWED)
        printf("    %d of %d were late\n", late, FILES * TIMES);
    CHECK(late <= LATE_ALLOWED);
    pcg_program_free(p);
    return unit_done();
}

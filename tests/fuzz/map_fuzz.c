/* map_fuzz.c - areas and lines of random coordinates, as GeoJSON and as OSM, through the whole of
 * read_map: what comes out must be finite, wound as it should be, and add up.
 *
 * The first byte chooses the form, OSM more seldom, since that takes longer; each further byte is a
 * coordinate on a grid of 16 by 16, or begins a ring, an area, a feature. Without GDAL nothing is
 * read.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/base.h"
#include "runtime/pcg.h"

int LLVMFuzzerInitialize(int *count, char ***arguments);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
const char *__asan_default_options(void);

enum { BYTES_MAX = 400, NEXT_RING = 0xf0, NEXT_AREA = 0xf1, NEXT_FEATURE = 0xf2, NODES = 256 };

static pcg_program *program;
static char map[1000];

static const char graph[] = "use gis\n"
                            "graph fuzz {\n"
                            "    param map: path\n"
                            "    m: read_map(file = map, origin = [47, 9]) {\n"
                            "        areas: polygons(); lines: lines(); points: points()\n"
                            "    }\n"
                            "}\n";

/* GEOS 3.11 loses memory where its buffer, which mends rings, fails on the way. What is our own to
 * give back is looked after by tests/api/cancel_map.c. */
const char *__asan_default_options(void)
{
    return "detect_leaks=0";
}

static void forget(void)
{
    unlink(map);
}

int LLVMFuzzerInitialize(int *count, char ***arguments)
{
    const pcg_compile_options options = {.size = sizeof options};
    (void)count, (void)arguments;
    snprintf(map, sizeof map, "%s/map_fuzz_XXXXXX", P_tmpdir);
    if (close(mkstemp(map)) != 0)
        abort();
    atexit(forget);
    program = pcg_compile_text(graph, strlen(graph), "fuzz.pcg", &options);
    if (!program)
        abort();
    return 0;
}

/* ---- GeoJSON --------------------------------------------------------------------------------- */

static const char feature_begin[] =
    "{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":"
    "\"MultiPolygon\",\"coordinates\":[[[";
static const char feature_end[] = "]]]}}";

static void write_geojson(FILE *f, const uint8_t *data, size_t size)
{
    bool first = true;
    fprintf(f, "{\"type\":\"FeatureCollection\",\"features\":[%s", feature_begin);
    for (size_t i = 0; i < size; i++) {
        if (data[i] == NEXT_RING || data[i] == NEXT_AREA) {
            fputs(data[i] == NEXT_RING ? "],[" : "]],[[", f);
            first = true;
        } else if (data[i] == NEXT_FEATURE) {
            fprintf(f, "%s,%s", feature_end, feature_begin);
            first = true;
        } else {
            fprintf(f, "%s[9.00%02u,47.00%02u]", first ? "" : ",", (unsigned)(data[i] & 15),
                    (unsigned)(data[i] >> 4));
            first = false;
        }
    }
    fprintf(f, "%s]}", feature_end);
}

/* ---- OSM ------------------------------------------------------------------------------------- */

static void write_nodes(FILE *f)
{
    for (unsigned i = 1; i <= NODES; i++)
        fprintf(f, "<node id=\"%u\" lat=\"47.00%02u\" lon=\"9.00%02u\"/>\n", i, (i - 1) >> 4,
                (i - 1) & 15);
}

/* Ways, then relations of the ways before each; some ways and nodes are not there. */
static void write_osm(FILE *f, const uint8_t *data, size_t size)
{
    unsigned ways = 0, relations = 0, told = 0;
    fputs("<osm version=\"0.6\">\n", f);
    write_nodes(f);
    fprintf(f, "<way id=\"%u\">", ++ways);
    for (size_t i = 0; i < size; i++) {
        if (data[i] == NEXT_RING)
            fprintf(f, "</way>\n<way id=\"%u\">", ++ways);
        else if (data[i] == NEXT_AREA)
            fprintf(f, "<tag k=\"building\" v=\"yes\"/></way>\n<way id=\"%u\">", ++ways);
        else if (data[i] == NEXT_FEATURE)
            fprintf(f, "<nd ref=\"999\"/><tag k=\"highway\" v=\"track\"/></way>\n<way id=\"%u\">",
                    ++ways);
        else
            fprintf(f, "<nd ref=\"%u\"/>", (unsigned)data[i] + 1);
    }
    fputs("</way>\n", f);
    for (; told <= ways; told += 3) {
        fprintf(f, "<relation id=\"%u\"><tag k=\"type\" v=\"multipolygon\"/>", ++relations);
        for (unsigned way = told; way < told + 4; way++)
            fprintf(f, "<member type=\"way\" ref=\"%u\" role=\"%s\"/>", way + 1,
                    way == told + 1 ? "inner" : "outer");
        fputs("<tag k=\"landuse\" v=\"forest\"/></relation>\n", f);
    }
    fputs("</osm>\n", f);
}

/* ---- what comes out -------------------------------------------------------------------------- */

/* Twice the area of a loop, seen from above. */
static double turn(const pcg_mesh_view *v, uint32_t loop)
{
    uint32_t first = v->loop_corners[loop], end = v->loop_corners[loop + 1];
    double sum = 0;
    for (uint32_t c = first; c < end; c++) {
        const double *p = v->points + 3 * v->corner_points[c];
        const double *q = v->points + 3 * v->corner_points[c + 1 < end ? c + 1 : first];
        sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum;
}

static void check_shape(pcg_run *r, size_t output, size_t entity)
{
    pcg_mesh_view v = {.size = sizeof v};
    if (pcg_run_mesh(r, output, entity, &v) != PCG_STATUS_OK)
        abort();
    for (size_t i = 0; i < 3 * v.point_count; i++)
        if (!isfinite(v.points[i]) || fabs(v.points[i]) > 1e6)
            abort();
    for (size_t face = 0; face < v.face_count; face++)
        for (uint32_t loop = v.face_loops[face]; loop < v.face_loops[face + 1]; loop++)
            if ((turn(&v, loop) > 0) != (loop == v.face_loops[face]))
                abort();
}

static void hear(void *user, const pcg_message *m)
{
    unsigned long long read, shapes, mended, bad, unfit;
    const char *counts = strstr(m->text, "': ");
    bool *noted = user;
    if (m->severity != PCG_NOTE || !counts ||
        sscanf(counts,
               "': %llu features: %llu became shapes, %llu of them mended; %llu are left out, %llu "
               "fit",
               &read, &shapes, &mended, &bad, &unfit) != 5)
        return;
    if (read != shapes + bad + unfit || mended > shapes)
        abort();
    *noted = true;
}

static void read_map(void)
{
    bool noted = false;
    const pcg_run_options options = {.size = sizeof options, .message = hear, .user = &noted};
    pcg_run *r = pcg_run_new(program, &options);
    if (!r || pcg_run_set_string(r, "map", map) != PCG_STATUS_OK)
        abort();
    pcg_status status = pcg_run_execute(r);
    if (status == PCG_STATUS_OK && !noted)
        abort();
    for (size_t output = 0; output < pcg_program_output_count(program); output++)
        for (size_t i = 0; i < pcg_run_output_count(r, output); i++)
            if (output > 0) /* the first is `bad` */
                check_shape(r, output, i);
    pcg_run_free(r);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    FILE *f = size > 1 && size < BYTES_MAX ? fopen(map, "w") : NULL;
    if (!f)
        return 0;
    (data[0] % 16 == 1 ? write_osm : write_geojson)(f, data + 1, size - 1);
    fclose(f);
    read_map();
    return 0;
}

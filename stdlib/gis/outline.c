/* outline.c - the geometry of a feature as faces, edges and vertices, in metres about the origin.
 *
 * Areas are looked at before they are used: rings that cross themselves or each other, nested holes
 * and the like are mended by GEOS. That takes memory with the square of the crossings, so those are
 * estimated first.
 */
#include "map.h"

#ifdef PCG_GDAL_LIBRARY

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Collections in collections that are followed; meetings of segments that are mended, besides
 * some a segment; and pairs of segments that are compared to find out. */
enum { DEPTH_MAX = 32, MEETINGS_MAX = 20000, MEETINGS_A_SEGMENT = 4, COMPARISONS_MAX = 50000000 };

enum { TICK_EVERY = 1024 };

static int type_of(const map *m, gdal_geometry *g)
{
    return m->gdal.OGR_GT_Flatten(m->gdal.OGR_G_GetGeometryType(g));
}

void outline_problem(map *m, const char *problem)
{
    if (!m->problem)
        m->problem = pcg_string(m->call->run, problem);
}

int outline_kinds(const map *m, gdal_geometry *g, int depth)
{
    int kinds = 0;
    switch (type_of(m, g)) {
    case GDAL_POINT:
        return OUTLINE_POINTS;
    case GDAL_LINE_STRING:
        return OUTLINE_LINES;
    case GDAL_POLYGON:
    case GDAL_TRIANGLE:
        return OUTLINE_AREAS;
    default:
        if (depth == DEPTH_MAX) /* outline_add then finds that it nests too deep */
            return OUTLINE_AREAS | OUTLINE_LINES | OUTLINE_POINTS;
        for (int i = 0; i < m->gdal.OGR_G_GetGeometryCount(g); i++)
            kinds |= outline_kinds(m, m->gdal.OGR_G_GetGeometryRef(g, i), depth + 1);
        return kinds;
    }
}

/* ---- points ---------------------------------------------------------------------------------- */

/* Room for `count` points in all. Status. */
static int grow_points(map *m, size_t count)
{
    pcg_run *r = m->call->run;
    size_t old = m->point_capacity, capacity = old;
    if (count <= old)
        return PCG_OK;
    capacity = count < 2 * old ? 2 * old : count;
    pcg_vec3 *points = run_resize(r, m->points, old * sizeof *points, capacity * sizeof *points);
    if (!points)
        return PCG_FAILED;
    m->points = points;
    m->point_capacity = capacity;
    uint32_t *vertices =
        run_resize(r, m->vertices, old * sizeof *vertices, capacity * sizeof *vertices);
    if (vertices)
        m->vertices = vertices;
    else /* the two have one capacity */
        m->point_capacity = old;
    return vertices ? PCG_OK : PCG_FAILED;
}

/* Fetches the points of a line, ring or point behind the first `from`; *count is how many.
 * Status. */
static int fetch(map *m, gdal_geometry *g, size_t from, size_t *count)
{
    int points = m->gdal.OGR_G_GetPointCount(g);
    *count = points > 0 ? (size_t)points : 0;
    if (grow_points(m, from + *count + 1) != PCG_OK)
        return PCG_FAILED;
    pcg_vec3 *to = m->points + from;
    const int stride = sizeof *to;
    if (*count)
        m->gdal.OGR_G_GetPoints(g, &to->x, stride, &to->y, stride, &to->z, stride);
    return PCG_OK;
}

static bool all_finite(const map *m, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(m->points[i].x) || !isfinite(m->points[i].y))
            return false;
    return true;
}

static bool place_point(const map *m, pcg_vec3 *p)
{
    double east = p->x, north = p->y, up = m->keep_height && isfinite(p->z) ? p->z : 0;
    if (m->layer->place != MAP_LOCAL && !gis_project(&m->projection, p->y, p->x, &east, &north))
        return false;
    if (!(fabs(east) <= 1e8) || !(fabs(north) <= 1e8) || !(fabs(up) <= 1e8))
        return false;
    *p = vec3(gis_rounded(east), gis_rounded(north), gis_rounded(up));
    return true;
}

/* Fetches and projects the points of `g`, those left out that repeat the one before. *count is 0
 * where they cannot be used: the problem is noted. Status. */
static int fetch_placed(map *m, gdal_geometry *g, size_t *count)
{
    size_t fetched;
    *count = 0;
    if (fetch(m, g, 0, &fetched) != PCG_OK)
        return PCG_FAILED;
    for (size_t i = 0; i < fetched; i++) {
        pcg_vec3 p = m->points[i];
        if (i % TICK_EVERY == TICK_EVERY - 1)
            PCG_TRY(pcg_tick(m->call));
        if (!isfinite(p.x) || !isfinite(p.y) || !place_point(m, &p)) {
            *count = 0;
            outline_problem(m, isfinite(p.x) && isfinite(p.y)
                                   ? "a point is too far from the origin"
                                   : "a coordinate is not a finite number");
            return PCG_OK;
        }
        const pcg_vec3 *last = *count ? &m->points[*count - 1] : NULL;
        if (!last || last->x != p.x || last->y != p.y || last->z != p.z)
            m->points[(*count)++] = p;
    }
    return PCG_OK;
}

/* Adds vertices for points; their numbers go to m->vertices. Status. */
static int add_vertices(map *m, pcg_mesh *mesh, size_t count)
{
    pcg_run *r = m->call->run;
    if (pcg_mesh_reserve(r, mesh, (uint32_t)count, 1, 1, (uint32_t)count) != PCG_OK)
        return PCG_FAILED;
    for (size_t i = 0; i < count; i++)
        if ((m->vertices[i] = pcg_mesh_add_vertex(r, mesh, m->points[i])) == UINT32_MAX)
            return PCG_FAILED;
    return PCG_OK;
}

static bool same_place(const map *m, size_t a, size_t b)
{
    pcg_vec3 d = vec3_subtract(m->points[a], m->points[b]);
    return d.x == 0 && d.y == 0 && d.z == 0;
}

static int add_point(map *m, gdal_geometry *g, pcg_mesh *mesh)
{
    size_t count;
    PCG_TRY(fetch_placed(m, g, &count));
    return add_vertices(m, mesh, count);
}

static int add_line(map *m, gdal_geometry *g, pcg_mesh *mesh)
{
    size_t count;
    PCG_TRY(fetch_placed(m, g, &count));
    if (count < 2) {
        outline_problem(m, "a line has less than two points");
        return PCG_OK;
    }
    bool closed = count > 2 && same_place(m, 0, count - 1);
    if (add_vertices(m, mesh, count - closed) != PCG_OK)
        return PCG_FAILED;
    if (closed)
        m->vertices[count - 1] = m->vertices[0];
    for (size_t i = 0; i + 1 < count; i++)
        if (pcg_mesh_add_edge(m->call->run, mesh, m->vertices[i], m->vertices[i + 1]) == UINT32_MAX)
            return PCG_FAILED;
    return PCG_OK;
}

/* ---- areas ----------------------------------------------------------------------------------- */

/* Twice the area, positive where the points go counter-clockwise. */
static double turn(const map *m, size_t count)
{
    double sum = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        pcg_vec3 a = vec3_subtract(m->points[i], m->points[0]),
                 b = vec3_subtract(m->points[i + 1], m->points[0]);
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

static void reverse(map *m, size_t count)
{
    for (size_t i = 0; i < count / 2; i++) {
        pcg_vec3 p = m->points[i];
        m->points[i] = m->points[count - 1 - i];
        m->points[count - 1 - i] = p;
    }
}

/* Adds a ring as an outline or a hole; *added tells whether there was one to add. Status. */
static int add_ring(map *m, gdal_geometry *ring, bool hole, pcg_mesh *mesh, bool *added)
{
    size_t count;
    *added = false;
    PCG_TRY(fetch_placed(m, ring, &count));
    if (count > 1 && same_place(m, 0, count - 1))
        count--;
    double area = count < 3 ? 0 : turn(m, count);
    if (area == 0) {
        outline_problem(m, hole ? "a hole has no area" : "an outline has no area");
        return PCG_OK;
    }
    if ((area < 0) != hole)
        reverse(m, count);
    if (add_vertices(m, mesh, count) != PCG_OK)
        return PCG_FAILED;
    pcg_run *r = m->call->run;
    uint32_t index = hole ? pcg_mesh_add_hole(r, mesh, m->vertices, (uint32_t)count)
                          : pcg_mesh_add_face(r, mesh, m->vertices, (uint32_t)count);
    *added = index != UINT32_MAX;
    return *added ? PCG_OK : PCG_FAILED;
}

static int add_polygon(map *m, gdal_geometry *g, pcg_mesh *mesh)
{
    bool added = true;
    int status = PCG_OK;
    for (int i = 0; i < m->gdal.OGR_G_GetGeometryCount(g) && status == PCG_OK; i++) {
        bool ring_added;
        status = add_ring(m, m->gdal.OGR_G_GetGeometryRef(g, i), i > 0, mesh, &ring_added);
        added = added && (i > 0 || ring_added);
        if (!added)
            break;
        if (status == PCG_OK)
            status = pcg_tick(m->call);
    }
    return status;
}

/* ---- mending --------------------------------------------------------------------------------- */

static int segment_compare(const void *a, const void *b)
{
    const map_segment *p = a, *q = b;
    return (p->low_x > q->low_x) - (p->low_x < q->low_x);
}

/* Fetches all points of a geometry's rings, one ring behind the other; between two rings there
 * is a segment too many, which does not matter for an estimate. Status. */
static int fetch_all(map *m, gdal_geometry *g, size_t *count, int depth)
{
    int parts = m->gdal.OGR_G_GetGeometryCount(g);
    if (parts == 0) {
        size_t added;
        if (fetch(m, g, *count, &added) != PCG_OK)
            return PCG_FAILED;
        *count += added;
    }
    for (int i = 0; i < parts && depth < DEPTH_MAX; i++)
        if (fetch_all(m, m->gdal.OGR_G_GetGeometryRef(g, i), count, depth + 1) != PCG_OK)
            return PCG_FAILED;
    return PCG_OK;
}

/* Whether so few of the segments' boxes meet that the geometry can be mended. */
static void work_estimate(map *m)
{
    map_segment *s = m->segments;
    size_t count = m->segment_count, meetings = 0, comparisons = 0;
    size_t most = MEETINGS_MAX + MEETINGS_A_SEGMENT * count;
    qsort(s, count, sizeof *s, segment_compare);
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count && s[k].low_x <= s[i].high_x; k++) {
            meetings += s[k].low_y <= s[i].high_y && s[i].low_y <= s[k].high_y;
            if (meetings > most || ++comparisons > COMPARISONS_MAX)
                return;
        }
    m->few_meetings = true;
}

/* m->points holds `count` points, those of `g`: m->few_meetings then tells whether it may be
 * mended. Status. */
static int estimate(map *m, gdal_geometry *g, size_t count)
{
    map_segment *s = run_alloc_array(m->run, count + 1, sizeof *s);
    if (!s)
        return PCG_FAILED;
    for (size_t i = 0; i + 1 < count; i++) {
        pcg_vec3 a = m->points[i], b = m->points[i + 1];
        s[i] = (map_segment){(float)fmin(a.x, b.x), (float)fmax(a.x, b.x), (float)fmin(a.y, b.y),
                             (float)fmax(a.y, b.y)};
    }
    m->segments = s;
    m->segment_count = count ? count - 1 : 0;
    m->few_meetings = false;
    int status = worker_do_with(m, g, work_estimate);
    if (m->interrupted == PCG_OK)
        run_free(m->run, s, (count + 1) * sizeof *s);
    return status;
}

static int add_parts(map *m, gdal_geometry *g, int kind, pcg_mesh *mesh, bool sound, int depth);

/* What GEOS found wrong, in lower case; "Self-intersection at or near point 9.5 47.1". */
static const char *reason_of(map *m)
{
    static const char prefix[] = "IllegalArgumentException: ";
    const char *said = m->said.message[0] ? m->said.message : "invalid geometry";
    if (!strncmp(said, prefix, sizeof prefix - 1))
        said += sizeof prefix - 1;
    char first = said[0] >= 'A' && said[0] <= 'Z' ? (char)(said[0] - 'A' + 'a') : said[0];
    return pcg_format(m->call->run, "%c%s", first, said + 1);
}

/* Adds areas that are not sound, mended where that can be. Status. */
static int add_mended(map *m, gdal_geometry *g, size_t count, pcg_mesh *mesh)
{
    const char *reason = reason_of(m);
    map_hush(m);
    if (!reason)
        return PCG_FAILED;
    PCG_TRY(estimate(m, g, count));
    if (m->few_meetings)
        PCG_TRY(worker_do_with(m, g, work_mend));
    map_hush(m);
    const char *problem = pcg_format(m->run, "%s%s", reason,
                                     m->few_meetings ? "" : ", and too much else to be mended");
    int status = problem ? PCG_OK : PCG_FAILED;
    if (problem)
        outline_problem(m, problem);
    if (m->mended && status == PCG_OK)
        status = add_parts(m, m->mended, OUTLINE_AREAS, mesh, true, 0);
    if (m->mended)
        m->gdal.OGR_G_DestroyGeometry(m->mended);
    m->mended = NULL;
    return status;
}

/* Adds areas once they are known to be sound. Status. */
static int add_areas(map *m, gdal_geometry *g, pcg_mesh *mesh)
{
    size_t count = 0;
    if (fetch_all(m, g, &count, 0) != PCG_OK)
        return PCG_FAILED;
    if (!all_finite(m, count)) {
        outline_problem(m, "a coordinate is not a finite number");
        return PCG_OK;
    }
    map_hush(m);
    PCG_TRY(worker_do_with(m, g, work_validate));
    return m->valid ? add_parts(m, g, OUTLINE_AREAS, mesh, true, 0) : add_mended(m, g, count, mesh);
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* `sound`: areas have been looked at. */
static int add_parts(map *m, gdal_geometry *g, int kind, pcg_mesh *mesh, bool sound, int depth)
{
    int type = type_of(m, g);
    bool areas = type == GDAL_POLYGON || type == GDAL_TRIANGLE || type == GDAL_MULTI_POLYGON;
    if (areas && kind == OUTLINE_AREAS && !sound)
        return add_areas(m, g, mesh);
    if (type == GDAL_POLYGON || type == GDAL_TRIANGLE)
        return kind == OUTLINE_AREAS ? add_polygon(m, g, mesh) : PCG_OK;
    if (type == GDAL_LINE_STRING)
        return kind == OUTLINE_LINES ? add_line(m, g, mesh) : PCG_OK;
    if (type == GDAL_POINT)
        return kind == OUTLINE_POINTS ? add_point(m, g, mesh) : PCG_OK;
    int status = PCG_OK;
    if (depth == DEPTH_MAX)
        outline_problem(m, "its geometry nests too deep");
    for (int i = 0; i < m->gdal.OGR_G_GetGeometryCount(g) && status == PCG_OK && depth < DEPTH_MAX;
         i++)
        status = add_parts(m, m->gdal.OGR_G_GetGeometryRef(g, i), kind, mesh, sound, depth + 1);
    return status;
}

int outline_add(map *m, gdal_geometry *g, int kind, pcg_mesh *mesh)
{
    return add_parts(m, g, kind, mesh, false, 0);
}

#else

typedef int outline_is_left_out; /* a file of C holds something */

#endif

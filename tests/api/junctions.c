/* junctions.c - checks crossings, by nothing but the shapes that come out: each is simple, overlaps
 * none of the streets that meet there, and has their ends as edges of its own, to the bit.
 *
 *     junctions [MAP]      the streets of a map, and of networks that are hard to lay out
 *
 * Without MAP, $PCG_MAP is read, or ../shared/data/liechtenstein.osm.pbf beside the project,
 * where it is there. Crossings that do not hold are listed with their places and the ids of
 * their streets.
 */
#include <stdlib.h>
#include <unistd.h>

#include "runtime/base/base.h"
#include "runtime/pcg.h"
#include "tests/unit/unit.h"

/* Square metres that rounding may amount to; the share of all crossings that has to hold, on a map
 * and in tangles. */
static const double least_overlap = 1e-3, least_share = 0.99, least_share_in_tangles = 0.98;

enum { CLIP_MAX = 8 };

/* ---- what is checked ------------------------------------------------------------------------- */

typedef struct area {
    pcg_mesh_view mesh;
    size_t entity;
    long from, to; /* of a street: the crossings at its ends; of others -1 */
    double width;
    long level;
    double low[2], high[2];
    size_t first, count; /* of a crossing: the ends of streets at it, in ground.end */
} area;

typedef struct ground {
    pcg_program *program;
    pcg_run *run;
    size_t street_output, crossing_output, streets, crossings;
    area *street, *crossing;
    size_t *end; /* streets by the crossing that they end at */
} ground;

static void *need(void *memory)
{
    if (memory == NULL) {
        printf("not ok memory\n");
        exit(1);
    }
    return memory;
}

static long whole(ground *g, size_t output, size_t entity, const char *name)
{
    double value = -1;

    pcg_run_attribute_float(g->run, output, entity, name, &value);
    return (long)value;
}

static void read_area(ground *g, size_t output, size_t entity, area *a)
{
    *a = (area){.mesh = {.size = sizeof a->mesh}, .entity = entity, .from = -1, .to = -1};
    pcg_run_mesh(g->run, output, entity, &a->mesh);
    a->low[0] = a->low[1] = HUGE_VAL;
    a->high[0] = a->high[1] = -HUGE_VAL;
    for (size_t i = 0; i < a->mesh.point_count; i++)
        for (int k = 0; k < 2; k++) {
            a->low[k] = fmin(a->low[k], a->mesh.points[3 * i + (size_t)k]);
            a->high[k] = fmax(a->high[k], a->mesh.points[3 * i + (size_t)k]);
        }
    a->level = whole(g, output, entity, "level");
}

static size_t find_output(const pcg_program *p, const char *name)
{
    pcg_gate gate;

    for (size_t i = 0; pcg_program_output(p, i, &gate); i++)
        if (strcmp(gate.name, name) == 0)
            return i;
    return SIZE_MAX;
}

/* Calls for each end of a street at a crossing: first counts, then lists. */
static void visit_ends(ground *g, int list)
{
    for (size_t s = 0; s < g->streets; s++)
        for (int k = 0; k < 2; k++) {
            long at = k == 0 ? g->street[s].from : g->street[s].to;

            if (at < 0 || (size_t)at >= g->crossings)
                continue;
            if (list)
                g->end[g->crossing[at].first + g->crossing[at].count] = s;
            g->crossing[at].count++;
        }
}

/* One that begins and ends at the same crossing stands there twice. */
static void list_ends(ground *g)
{
    size_t ends = 0;

    visit_ends(g, 0);
    for (size_t i = 0; i < g->crossings; i++) {
        g->crossing[i].first = ends;
        ends += g->crossing[i].count;
        g->crossing[i].count = 0;
    }
    visit_ends(g, 1);
}

static void read_ground(ground *g)
{
    g->street_output = find_output(g->program, "streets");
    g->crossing_output = find_output(g->program, "crossings");
    g->streets = pcg_run_output_count(g->run, g->street_output);
    g->crossings = pcg_run_output_count(g->run, g->crossing_output);
    g->street = need(calloc(g->streets + 1, sizeof *g->street));
    g->crossing = need(calloc(g->crossings + 1, sizeof *g->crossing));
    g->end = need(calloc(2 * g->streets + 1, sizeof *g->end));
    for (size_t i = 0; i < g->streets; i++) {
        read_area(g, g->street_output, i, &g->street[i]);
        g->street[i].from = whole(g, g->street_output, i, "from");
        g->street[i].to = whole(g, g->street_output, i, "to");
        pcg_run_attribute_float(g->run, g->street_output, i, "width", &g->street[i].width);
    }
    for (size_t i = 0; i < g->crossings; i++)
        read_area(g, g->crossing_output, i, &g->crossing[i]);
    list_ends(g);
}

/* ---- overlaps: triangle by triangle ---------------------------------------------------------- */

typedef struct point {
    double x, y;
} point;

typedef struct triangle {
    point at[3];
} triangle;

static double turn(point a, point b, point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static point point_of(const area *a, uint32_t corner)
{
    const double *p = &a->mesh.points[3 * (size_t)a->mesh.corner_points[corner]];

    return (point){p[0], p[1]};
}

/* Counter-clockwise, seen from above. */
static triangle triangle_of(const area *a, size_t t)
{
    const uint32_t *corner = &a->mesh.triangles[3 * t];
    triangle made = {{point_of(a, corner[0]), point_of(a, corner[1]), point_of(a, corner[2])}};

    if (turn(made.at[0], made.at[1], made.at[2]) < 0) {
        point swapped = made.at[1];

        made.at[1] = made.at[2];
        made.at[2] = swapped;
    }
    return made;
}

static int cut(const point *in, int count, point a, point b, point *out)
{
    int kept = 0;

    for (int i = 0, j = count - 1; i < count; j = i++) {
        double before = turn(a, b, in[j]), here = turn(a, b, in[i]);

        if ((before < 0) != (here < 0)) {
            double share = before / (before - here);

            out[kept++] = (point){in[j].x + (in[i].x - in[j].x) * share,
                                  in[j].y + (in[i].y - in[j].y) * share};
        }
        if (here >= 0)
            out[kept++] = in[i];
    }
    return kept;
}

static double common_area(const triangle *s, const triangle *t)
{
    point a[CLIP_MAX], b[CLIP_MAX];
    int count = 3;
    double sum = 0;

    memcpy(a, s->at, sizeof s->at);
    for (int i = 0; i < 3 && count > 0; i++) {
        count = cut(a, count, t->at[i], t->at[(i + 1) % 3], b);
        memcpy(a, b, sizeof a);
    }
    for (int i = 2; i < count; i++)
        sum += turn(a[0], a[i - 1], a[i]);
    return sum / 2;
}

static int boxes_apart(const double *low, const double *high, const triangle *t)
{
    for (int k = 0; k < 2; k++) {
        double v[3] = {k == 0 ? t->at[0].x : t->at[0].y, k == 0 ? t->at[1].x : t->at[1].y,
                       k == 0 ? t->at[2].x : t->at[2].y};

        if (fmax(fmax(v[0], v[1]), v[2]) < low[k] || fmin(fmin(v[0], v[1]), v[2]) > high[k])
            return 1;
    }
    return 0;
}

static double overlap(const area *a, const area *b)
{
    double sum = 0;

    for (int k = 0; k < 2; k++)
        if (a->high[k] < b->low[k] || b->high[k] < a->low[k])
            return 0;
    for (size_t i = 0; i < a->mesh.triangle_count; i++) {
        triangle s = triangle_of(a, i);

        if (boxes_apart(b->low, b->high, &s))
            continue;
        for (size_t k = 0; k < b->mesh.triangle_count; k++) {
            triangle t = triangle_of(b, k);

            sum += common_area(&s, &t);
        }
    }
    return sum;
}

/* ---- simple ---------------------------------------------------------------------------------- */

/* Places are multiples of 2^-20 m: as whole numbers, about a place nearby, they are exact. */
typedef struct spot {
    int64_t x, y;
} spot;

static spot spot_of(const area *a, uint32_t corner)
{
    point p = point_of(a, corner);

    return (spot){llround((p.x - a->low[0]) * 1048576), llround((p.y - a->low[1]) * 1048576)};
}

static int side(spot a, spot b, spot c)
{
    int64_t twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);

    return twice > 0 ? 1 : twice < 0 ? -1 : 0;
}

static int within(spot a, spot b, spot c)
{
    return (c.x - a.x) * (c.x - b.x) <= 0 && (c.y - a.y) * (c.y - b.y) <= 0;
}

/* Whether two segments have a point in common. */
static int touch(spot a, spot b, spot c, spot d)
{
    int ac = side(a, b, c), ad = side(a, b, d), ca = side(c, d, a), cb = side(c, d, b);

    if (ac * ad < 0 && ca * cb < 0)
        return 1;
    return (ac == 0 && within(a, b, c)) || (ad == 0 && within(a, b, d)) ||
           (ca == 0 && within(c, d, a)) || (cb == 0 && within(c, d, b));
}

/* No side of a loop meets another one, but its neighbours in their common ends. */
static int loop_is_simple(const area *a, uint32_t from, uint32_t to)
{
    uint32_t count = to - from;

    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 2; k < count; k++) {
            if (i == 0 && k == count - 1)
                continue;
            if (touch(spot_of(a, from + i), spot_of(a, from + i + 1), spot_of(a, from + k),
                      spot_of(a, from + (k + 1) % count)))
                return 0;
        }
    return count >= 3;
}

static int is_simple(const area *a)
{
    for (size_t l = 0; l < a->mesh.loop_count; l++)
        if (!loop_is_simple(a, a->mesh.loop_corners[l], a->mesh.loop_corners[l + 1]))
            return 0;
    return a->mesh.loop_count > 0;
}

/* ---- gaps ------------------------------------------------------------------------------------ */

static int same_point(point a, point b)
{
    return !(a.x < b.x) && !(a.x > b.x) && !(a.y < b.y) && !(a.y > b.y);
}

/* Whether an area has a side from one point to another. */
static int has_side(const area *a, point from, point to)
{
    for (size_t l = 0; l < a->mesh.loop_count; l++)
        for (uint32_t i = a->mesh.loop_corners[l], end = a->mesh.loop_corners[l + 1]; i < end; i++)
            if (same_point(point_of(a, i), from) &&
                same_point(point_of(a, i + 1 < end ? i + 1 : a->mesh.loop_corners[l]), to))
                return 1;
    return 0;
}

/* How many sides of a street, about as long as it is wide, are also a crossing's. */
static size_t common_sides(const area *street, const area *crossing)
{
    size_t count = 0;

    for (size_t l = 0; l < street->mesh.loop_count; l++) {
        uint32_t from = street->mesh.loop_corners[l], to = street->mesh.loop_corners[l + 1];

        for (uint32_t i = from; i < to; i++) {
            point a = point_of(street, i), b = point_of(street, i + 1 < to ? i + 1 : from);
            double length = hypot(b.x - a.x, b.y - a.y);

            count += length > 0.5 * street->width && has_side(crossing, b, a);
        }
    }
    return count;
}

static int has_no_gaps(const ground *g, const area *c)
{
    for (size_t i = c->first; i < c->first + c->count; i++) {
        size_t ends = 0;

        for (size_t k = c->first; k < c->first + c->count; k++)
            ends += g->end[k] == g->end[i];
        if (common_sides(&g->street[g->end[i]], c) < ends)
            return 0;
    }
    return 1;
}

/* ---- crossings ------------------------------------------------------------------------------- */

typedef struct tally {
    size_t crossings, tangled, overlapped, gaping, bad;
} tally;

static double overlap_with_streets(const ground *g, const area *c)
{
    double sum = 0;

    for (size_t i = c->first; i < c->first + c->count; i++)
        if (i == c->first || g->end[i] != g->end[i - 1])
            sum += overlap(c, &g->street[g->end[i]]);
    return sum;
}

static void list_bad(ground *g, const area *c, int simple, double common, int whole_ends)
{
    printf("    at (%.2f, %.2f):%s%s", (c->low[0] + c->high[0]) / 2, (c->low[1] + c->high[1]) / 2,
           simple ? "" : " not simple", whole_ends ? "" : " gap");
    if (common > least_overlap)
        printf(" overlap %.4f m2", common);
    for (size_t i = c->first; i < c->first + c->count; i++) {
        const char *id = pcg_run_attribute(g->run, g->street_output, g->end[i], "id");

        printf(" %s", id != NULL ? id : "");
    }
    printf("\n");
}

static tally check_crossings(ground *g, int list)
{
    tally t = {.crossings = g->crossings};

    for (size_t i = 0; i < g->crossings; i++) {
        const area *c = &g->crossing[i];
        int simple = is_simple(c), whole_ends = has_no_gaps(g, c);
        double common = overlap_with_streets(g, c);

        t.tangled += !simple;
        t.gaping += !whole_ends;
        t.overlapped += common > least_overlap;
        if (simple && whole_ends && common <= least_overlap)
            continue;
        t.bad++;
        if (list)
            list_bad(g, c, simple, common, whole_ends);
    }
    return t;
}

/* ---- streets over each other ----------------------------------------------------------------- */

static int compare_left(const void *a, const void *b)
{
    const area *s = *(const area *const *)a, *t = *(const area *const *)b;

    return s->low[0] < t->low[0] ? -1 : s->low[0] > t->low[0];
}

static double total(const area *a)
{
    double sum = 0;

    for (size_t i = 0; i < a->mesh.triangle_count; i++) {
        triangle t = triangle_of(a, i);

        sum += turn(t.at[0], t.at[1], t.at[2]) / 2;
    }
    return sum;
}

/* What pairs of areas on one level have in common, in all. */
static double all_overlaps(area *const *sorted, size_t count)
{
    double sum = 0;

    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count && sorted[k]->low[0] <= sorted[i]->high[0]; k++)
            if (sorted[i]->level == sorted[k]->level)
                sum += overlap(sorted[i], sorted[k]);
    return sum;
}

/* Prints how much of all streets and crossings lies over others. */
static double check_overlaps(const ground *g)
{
    size_t count = g->streets + g->crossings;
    area **sorted = need(calloc(count + 1, sizeof *sorted));
    double covered = 0, common;

    for (size_t i = 0; i < count; i++) {
        sorted[i] = i < g->streets ? &g->street[i] : &g->crossing[i - g->streets];
        covered += total(sorted[i]);
    }
    qsort(sorted, count, sizeof *sorted, compare_left);
    common = all_overlaps(sorted, count);
    free(sorted);
    printf("    %.0f m2 of streets and crossings, %.1f m2 of them over others: %.3f %%\n", covered,
           common, covered > 0 ? 100 * common / covered : 0);
    return covered > 0 ? common / covered : 0;
}

/* ---- graphs ---------------------------------------------------------------------------------- */

static void print_message(void *user, const pcg_message *m)
{
    (void)user;
    if (m->severity == PCG_ERROR)
        printf("    %s", m->rendered);
}

static int open_ground(ground *g, pcg_program *program, const char *parameter, const char *value)
{
    *g = (ground){.program = program};
    if (program == NULL)
        return 0;
    g->run = pcg_run_new(
        program, &(pcg_run_options){.size = sizeof(pcg_run_options), .message = print_message});
    if (parameter != NULL)
        pcg_run_set_string(g->run, parameter, value);
    if (pcg_run_execute(g->run) != PCG_STATUS_OK)
        return 0;
    read_ground(g);
    return 1;
}

static void close_ground(ground *g)
{
    free(g->street);
    free(g->crossing);
    free(g->end);
    pcg_run_free(g->run);
    pcg_program_free(g->program);
}

static tally check_ground(ground *g, const char *what)
{
    tally t = check_crossings(g, 1);

    printf(
        "    %s: %zu streets, %zu crossings: %zu not simple, %zu over a street that meets there, "
        "%zu with gaps; %.2f %% hold\n",
        what, g->streets, t.crossings, t.tangled, t.overlapped, t.gaping,
        t.crossings > 0 ? 100.0 * (double)(t.crossings - t.bad) / (double)t.crossings : 100.0);
    return t;
}

static void check_map(const char *file)
{
    const char *root = getenv("ROOT");
    char path[4096];
    ground g;
    tally t;

    snprintf(path, sizeof path, "%s/tests/api/streets/map.pcg", root != NULL ? root : ".");
    if (open_ground(&g, pcg_compile_file(path, NULL), "file", file)) {
        t = check_ground(&g, file);
        CHECK(t.crossings > 0);
        CHECK((double)t.bad <= (1 - least_share) * (double)t.crossings);
        CHECK(check_overlaps(&g) < 0.02);
    } else {
        printf("    the map is not checked: %s\n", g.run != NULL ? pcg_run_error(g.run) : path);
        CHECK(g.run != NULL && strstr(pcg_run_error(g.run), "GDAL was left out") != NULL);
    }
    close_ground(&g);
}

/* ---- networks that are hard ------------------------------------------------------------------ */

typedef struct writer {
    char *text;
    size_t length, room;
} writer;

static void add(writer *w, const char *format, ...) PRINTF_LIKE(2, 3);

static void add(writer *w, const char *format, ...)
{
    va_list arguments;

    if (w->length + 512 > w->room)
        w->text = need(realloc(w->text, w->room = 2 * w->room + 1024));
    va_start(arguments, format);
    w->length += (size_t)vsnprintf(w->text + w->length, 512, format, arguments);
    va_end(arguments);
}

static uint64_t state;

/* From 0 to 1. */
static double draw(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static void begin(writer *w)
{
    add(w, "graph net {\nattr id: string\nattr from: int = -1\nattr to: int = -1\n"
           "attr width: length\nattr level: int\nout streets: Shape\nout crossings: Shape\n"
           "m: merge_streets() -> blend_streets() -> g: street_to_shape(from => @from, to => @to, "
           "id => @id, street_width => @width, level => @level)\n"
           "g.streets -> streets\ng.crossings -> crossings\nblock g.sidewalks\nblock g.lots\n");
}

static void begin_street(writer *w, double width)
{
    add(w, "street(width = %.3fm, sidewalk = 1m, id = \"%zu\") {", width, w->length);
}

static void vertex(writer *w, double x, double y)
{
    add(w, " vertex(%.6fm, %.6fm);", x, y);
}

static void end_street(writer *w)
{
    add(w, " } -> m\n");
}

/* A star of arms around the origin, `step` degrees apart. */
static void star(writer *w, int arms, double step)
{
    for (int i = 0; i < arms; i++) {
        double angle = i * step * 3.14159265358979 / 180;

        begin_street(w, 3 + i % 3);
        vertex(w, 0, 0);
        vertex(w, 300 * cos(angle), 300 * sin(angle));
        end_street(w);
    }
}

static void ring(writer *w, double x, double y, double radius, double width)
{
    begin_street(w, width);
    for (int i = 0; i <= 24; i++)
        vertex(w, x + radius * cos(i % 24 * 0.2617993877991494),
               y + radius * sin(i % 24 * 0.2617993877991494));
    end_street(w);
}

static void roundabout(writer *w, double radius)
{
    ring(w, 0, 0, radius, 5);
    for (int i = 0; i < 4; i++) {
        begin_street(w, 6);
        vertex(w, radius * cos(i * 1.5707963267948966), radius * sin(i * 1.5707963267948966));
        vertex(w, 100 * cos(i * 1.5 + 0.1), 100 * sin(i * 1.5 + 0.1));
        end_street(w);
    }
}

/* Two carriageways nearer than they are wide, crossed by streets. */
static void carriageways(writer *w)
{
    for (int i = 0; i < 2; i++) {
        begin_street(w, 7);
        vertex(w, -100, 4.0 * i);
        vertex(w, 0, 5.0 * i);
        vertex(w, 100, 4.0 * i);
        end_street(w);
    }
    for (int i = -2; i <= 2; i++) {
        begin_street(w, 4);
        vertex(w, 30 * i, -50);
        vertex(w, 30 * i + 5, 50);
        end_street(w);
    }
}

/* A street that crosses itself, a loop from a street to itself, a hairpin, edges without length. */
static void curves(writer *w)
{
    begin_street(w, 5);
    for (int i = 0; i <= 60; i++)
        vertex(w, 60 * sin(i * 0.1), 40 * sin(i * 0.2));
    end_street(w);
    begin_street(w, 4);
    vertex(w, 100, 0), vertex(w, 130, 0), vertex(w, 150, 20), vertex(w, 150, -20);
    vertex(w, 130, 0), vertex(w, 130, 0), vertex(w, 130, -60);
    end_street(w);
    begin_street(w, 4);
    vertex(w, 200, 0), vertex(w, 240, 0), vertex(w, 241, 6), vertex(w, 200, 7);
    vertex(w, 180, 7), vertex(w, 179.99, 7), vertex(w, 170, 3), vertex(w, 170, 30);
    end_street(w);
}

static void tangle(writer *w, int streets, double extent)
{
    for (int i = 0; i < streets; i++) {
        double x = draw() * extent, y = draw() * extent;
        int points = 2 + (int)(draw() * 6);

        begin_street(w, 1 + 6 * draw());
        for (int k = 0; k < points; k++) {
            vertex(w, x, y);
            x += (draw() - 0.5) * extent / 3;
            y += (draw() - 0.5) * extent / 3;
        }
        end_street(w);
    }
}

/* How many crossings of a network do not hold. */
static tally check_net(writer *w, const char *what)
{
    ground g;
    tally t = {0};

    add(w, "}\n");
    CHECK(open_ground(&g,
                      pcg_compile_text(w->text, w->length, "net.pcg",
                                       &(pcg_compile_options){.size = sizeof(pcg_compile_options),
                                                              .message = print_message}),
                      NULL, NULL));
    if (g.street != NULL) {
        t = check_ground(&g, what);
        check_overlaps(&g);
    }
    close_ground(&g);
    w->length = 0;
    return t;
}

static void check_nets(void)
{
    writer w = {.text = NULL};
    tally tangled = {0};

    begin(&w), star(&w, 12, 30);
    CHECK_INTEGER(check_net(&w, "a star of 12").bad, 0);
    begin(&w), star(&w, 3, 1);
    CHECK_INTEGER(check_net(&w, "angles of 1 degree").bad, 0);
    begin(&w), star(&w, 7, 20);
    CHECK_INTEGER(check_net(&w, "a fan").bad, 0);
    begin(&w), roundabout(&w, 15);
    CHECK_INTEGER(check_net(&w, "a roundabout").bad, 0);
    begin(&w), roundabout(&w, 4);
    CHECK_INTEGER(check_net(&w, "a small roundabout").bad, 0);
    begin(&w), carriageways(&w);
    CHECK_INTEGER(check_net(&w, "carriageways").bad, 0);
    begin(&w), curves(&w);
    CHECK_INTEGER(check_net(&w, "curves").bad, 0);
    for (int i = 0; i < 8; i++) {
        tally t;

        begin(&w), tangle(&w, 30, 150 + 100 * i);
        t = check_net(&w, "a tangle");
        tangled.crossings += t.crossings;
        tangled.bad += t.bad;
    }
    begin(&w), tangle(&w, 60, 0.5);
    CHECK(check_net(&w, "nothing but a knot").crossings <= 1);
    begin(&w), tangle(&w, 60, 5e7);
    CHECK(check_net(&w, "a tangle of continents").crossings > 0);
    CHECK((double)tangled.bad <= (1 - least_share_in_tangles) * (double)tangled.crossings);
    free(w.text);
}

int main(int count, char **arguments)
{
    const char *map = count > 1 ? arguments[1] : getenv("PCG_MAP"), *root = getenv("ROOT");
    char path[4096];

    snprintf(path, sizeof path, "%s/../shared/data/liechtenstein.osm.pbf",
             root != NULL ? root : ".");
    if (map == NULL && access(path, R_OK) == 0)
        map = path;
    check_nets();
    if (map != NULL)
        check_map(map);
    return unit_done();
}

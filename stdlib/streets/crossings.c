/* crossings.c - what clusters cover: the union of their stubs, of links that are all stub, and of
 * the wedges outside of bends. */
#include <math.h>
#include <stdlib.h>

#include "layout.h"

/* Smaller faces, in square metres, are what rounding leaves over. */
static const double least_area = 1e-4;
/* In lengths of the longer one: how far a wedge's tip may be from its node. */
static const double longest_tip = 1.5;

/* In metres: places as near as that are one, beside a cross-section; how far places are from a line
 * that they are on; and how much of a cross-section may be hidden. */
static const double nearest = 1e-4, rounding = 1e-5, hidden = 5e-3;

/* A piece of a street that overlaps a crossing, from which it is taken. */
typedef struct intrusion {
    uint32_t cluster, piece;
} intrusion;

/* Corners of cross-sections, in pairs. */
typedef struct sections {
    pcg_vec2 *corner;
    uint32_t count, capacity;
} sections;

typedef struct builder {
    const layout *l;
    int band;
    uint32_t *begin, *vertex; /* the vertices of each cluster; one more than there are vertices */
    intrusion *intrusion;
    uint32_t intrusions, intrusion_capacity;
} builder;

/* ---- outlines -------------------------------------------------------------------------------- */

/* Adds a place to the loop that is being made, unless it repeats the one before. */
static int add_corner(const layout *l, polygons *out, pcg_vec2 at)
{
    uint32_t first = out->loops > 0 ? out->end[out->loops - 1] : 0;
    const pcg_vec2 *last = out->points > first ? &out->point[out->points - 1] : NULL;

    at = vec2_snap(at);
    if (last != NULL && last->x == at.x && last->y == at.y)
        return PCG_OK;
    return polygons_add(l->run, out, at);
}

static void reverse_loop(polygons *p)
{
    for (uint32_t i = p->loops > 0 ? p->end[p->loops - 1] : 0, j = p->points; i + 1 < j; i++) {
        pcg_vec2 at = p->point[i];

        p->point[i] = p->point[--j];
        p->point[j] = at;
    }
}

/* One border between two stations, in either direction. */
static int add_border(const layout *l, int band, int side, const street_link *k, double from,
                      double to, polygons *out)
{
    const pcg_vec2 *border = &l->border[band][side][k->first];
    int status = add_corner(l, out, border_at(l, band, side, k, from));

    if (from < to)
        for (double i = floor(from) + 1; i < to && status == PCG_OK; i++)
            status = add_corner(l, out, border[(uint32_t)i]);
    else
        for (double i = ceil(from) - 1; i > to && status == PCG_OK; i--)
            status = add_corner(l, out, border[(uint32_t)i]);
    return status == PCG_OK ? add_corner(l, out, border_at(l, band, side, k, to)) : status;
}

int link_outline(const layout *l, int band, const street_link *k, double from, double to,
                 bool reversed, polygons *out)
{
    int status;

    if (!(from < to))
        return PCG_OK;
    status = add_border(l, band, RIGHT, k, from, to, out);
    if (status == PCG_OK)
        status = add_border(l, band, LEFT, k, to, from, out);
    if (status == PCG_OK && reversed)
        reverse_loop(out);
    return status == PCG_OK ? polygons_end_loop(l->run, out) : status;
}

/* Adds all loops of polygons, turned round. */
static int add_reversed(const layout *l, const polygons *p, polygons *out)
{
    for (uint32_t i = 0; i < p->loops; i++) {
        for (uint32_t k = p->end[i]; k > loop_begin(p, i); k--)
            if (polygons_add(l->run, out, p->point[k - 1]) != PCG_OK)
                return PCG_FAILED;
        if (polygons_end_loop(l->run, out) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static double face_area(const polygons *p, uint32_t face)
{
    double area = 0;

    for (uint32_t i = p->face[face]; i < face_end(p, face); i++)
        area += polygons_loop_area(p, i);
    return area;
}

/* Adds the faces that are more than rounding. */
static int add_faces(const layout *l, const polygons *p, polygons *out)
{
    for (uint32_t f = 0; f < p->faces; f++) {
        if (face_area(p, f) < least_area)
            continue;
        if (polygons_begin_face(l->run, out) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t i = p->face[f]; i < face_end(p, f); i++) {
            for (uint32_t k = loop_begin(p, i); k < p->end[i]; k++)
                if (add_corner(l, out, p->point[k]) != PCG_OK)
                    return PCG_FAILED;
            if (polygons_end_loop(l->run, out) != PCG_OK)
                return PCG_FAILED;
        }
    }
    return PCG_OK;
}

/* What loops wind around, as faces. `loops` is used up. */
static int unite(const layout *l, polygons *loops, polygons *out)
{
    polygons clean = {0};
    bool changed;
    int status = polygons_clean(l->run, loops, 0, &clean, &changed);

    polygons_clear(out);
    if (status == PCG_OK)
        status = add_faces(l, &clean, out);
    polygons_free(l->run, &clean);
    polygons_clear(loops);
    return status;
}

/* ---- wedges ---------------------------------------------------------------------------------- */

/* Where the borders beside two arms meet behind their node; false where that is too far. */
static bool tip_of(pcg_vec2 node, pcg_vec2 left, pcg_vec2 a, pcg_vec2 right, pcg_vec2 b,
                   pcg_vec2 *tip)
{
    double turn = vec2_cross(a, b), longest;

    if (!(fabs(turn) > 1e-6))
        return false;
    *tip = vec2_add(left, vec2_scale(a, vec2_cross(vec2_subtract(right, left), b) / turn));
    longest = fmax(vec2_length(vec2_subtract(left, node)), vec2_length(vec2_subtract(right, node)));
    return vec2_length(vec2_subtract(*tip, node)) <= longest_tip * longest;
}

/* Fills what is between two arms that follow each other counter-clockwise by more than a half
 * turn. */
static int add_wedge(const builder *b, uint32_t node, arm from, arm to, polygons *out)
{
    const layout *l = b->l;
    pcg_vec2 at = vec2_of(l->drawing->vertex[node]), tip;
    pcg_vec2 left = arm_border(l, b->band, from, LEFT), right = arm_border(l, b->band, to, RIGHT);
    pcg_vec2 a = arm_direction(l, from), c = arm_direction(l, to);
    int status;

    if (!(vec2_cross(a, c) < 0))
        return PCG_OK;
    status = add_corner(l, out, at);
    if (status == PCG_OK)
        status = add_corner(l, out, left);
    if (status == PCG_OK && tip_of(at, left, a, right, c, &tip))
        status = add_corner(l, out, tip);
    if (status == PCG_OK)
        status = add_corner(l, out, right);
    return status == PCG_OK ? polygons_end_loop(l->run, out) : status;
}

static int add_wedges(const builder *b, uint32_t node, polygons *out)
{
    const layout *l = b->l;
    uint32_t from = l->arm_begin[node], to = l->arm_begin[node + 1];
    int status = PCG_OK;

    if (l->kind[node] == NODE_SEAM || to < from + 2)
        return PCG_OK;
    for (uint32_t i = from; i < to && status == PCG_OK; i++)
        status = add_wedge(b, node, l->arm[i], l->arm[i + 1 < to ? i + 1 : from], out);
    return status;
}

/* ---- clusters -------------------------------------------------------------------------------- */

static double stub_from(const builder *b, arm a)
{
    return a.end == 0 ? 0 : b->l->link[a.link].station[b->band][1];
}

static double stub_to(const builder *b, arm a)
{
    const street_link *k = &b->l->link[a.link];

    return a.end == 0 ? k->station[b->band][0] : link_last(k);
}

static int add_arm(const builder *b, arm a, polygons *out)
{
    const street_link *k = &b->l->link[a.link];

    if (!k->internal[b->band])
        return link_outline(b->l, b->band, k, stub_from(b, a), stub_to(b, a), false, out);
    return a.end == 0 ? link_outline(b->l, b->band, k, 0, link_last(k), false, out) : PCG_OK;
}

/* Whether there is anything but ends and seams. */
static bool has_area(const builder *b, uint32_t cluster)
{
    for (uint32_t i = b->begin[cluster]; i < b->begin[cluster + 1]; i++) {
        uint32_t v = b->vertex[i];

        if (b->l->kind[v] == NODE_CROSSING || b->l->kind[v] == NODE_CHANGE)
            return true;
        for (uint32_t k = b->l->arm_begin[v]; k < b->l->arm_begin[v + 1]; k++)
            if (b->l->link[b->l->arm[k].link].internal[b->band] ||
                stub_from(b, b->l->arm[k]) < stub_to(b, b->l->arm[k]))
                return true;
    }
    return false;
}

/* Where a width changes, straight lines from one cross-section to the other, if that can be.
 * *done says so. */
static int add_taper(const builder *b, uint32_t cluster, polygons *out, bool *done)
{
    const layout *l = b->l;
    pcg_vec2 corner[4];
    int status;

    *done = false;
    if (b->begin[cluster + 1] - b->begin[cluster] != 1 || l->kind[cluster] != NODE_CHANGE)
        return PCG_OK;
    for (uint32_t i = 0; i < 2; i++) {
        arm a = l->arm[l->arm_begin[cluster] + i];
        const street_link *k = &l->link[a.link];

        if (k->internal[b->band])
            return PCG_OK;
        corner[2 * i] =
            border_at(l, b->band, a.end == 0 ? RIGHT : LEFT, k, k->station[b->band][a.end]);
        corner[2 * i + 1] =
            border_at(l, b->band, a.end == 0 ? LEFT : RIGHT, k, k->station[b->band][a.end]);
    }
    for (uint32_t i = 0; i < 4; i++)
        if (!(vec2_cross(vec2_subtract(corner[(i + 1) % 4], corner[i]),
                         vec2_subtract(corner[(i + 2) % 4], corner[i])) > 0))
            return PCG_OK;
    *done = true;
    status = polygons_begin_face(l->run, out);
    for (uint32_t i = 0; i < 4 && status == PCG_OK; i++)
        status = polygons_add(l->run, out, corner[i]);
    return status == PCG_OK ? polygons_end_loop(l->run, out) : status;
}

static int add_stubs(const builder *b, uint32_t cluster, polygons *out)
{
    const layout *l = b->l;
    int status = PCG_OK;

    for (uint32_t i = b->begin[cluster]; i < b->begin[cluster + 1] && status == PCG_OK; i++) {
        uint32_t v = b->vertex[i];

        for (uint32_t k = l->arm_begin[v]; k < l->arm_begin[v + 1] && status == PCG_OK; k++)
            status = add_arm(b, l->arm[k], out);
        if (status == PCG_OK)
            status = add_wedges(b, v, out);
    }
    return status;
}

/* ---- cross-sections -------------------------------------------------------------------------- */

static bool same_place(pcg_vec2 a, pcg_vec2 b)
{
    return a.x == b.x && a.y == b.y;
}

/* The corners of all cross-sections that bound a cluster, in pairs: right and left, as seen from
 * within. */
static int find_sections(const builder *b, uint32_t cluster, sections *s)
{
    const layout *l = b->l;

    for (uint32_t i = b->begin[cluster]; i < b->begin[cluster + 1]; i++)
        for (uint32_t v = b->vertex[i], k = l->arm_begin[v]; k < l->arm_begin[v + 1]; k++) {
            arm a = l->arm[k];
            const street_link *of = &l->link[a.link];
            double station = of->station[b->band][a.end];

            if (of->internal[b->band])
                continue;
            if (list_room(l->run, (void **)&s->corner, &s->capacity, s->count, 2,
                          sizeof *s->corner) != PCG_OK)
                return PCG_FAILED;
            s->corner[s->count++] = border_at(l, b->band, a.end == 0 ? RIGHT : LEFT, of, station);
            s->corner[s->count++] = border_at(l, b->band, a.end == 0 ? LEFT : RIGHT, of, station);
        }
    return PCG_OK;
}

/* Where a place of the outline belongs: at the corner of a cross-section that is near to it, or
 * less near but on the cross-section: there the side of another stub, nearly parallel, may have
 * hidden the corner. */
static pcg_vec2 welded(const sections *s, pcg_vec2 at)
{
    pcg_vec2 to = at;

    for (uint32_t i = 0; i < s->count; i++) {
        pcg_vec2 corner = s->corner[i], away = vec2_subtract(at, corner);
        pcg_vec2 way = vec2_normal(vec2_subtract(s->corner[i ^ 1], corner));
        double along = vec2_dot(way, away);

        if (same_place(at, corner))
            return at;
        if ((fabs(away.x) <= nearest && fabs(away.y) <= nearest) ||
            (fabs(vec2_cross(way, away)) <= rounding && along >= 0 && along <= hidden))
            to = corner;
    }
    return to;
}

/* Whether a place is between two others, on the straight line. */
static bool is_between(pcg_vec2 from, pcg_vec2 to, pcg_vec2 at)
{
    pcg_vec2 way = vec2_subtract(to, from), part = vec2_subtract(at, from);
    double square = vec2_dot(way, way), along = vec2_dot(way, part), turn = vec2_cross(way, part);

    return along >= 0 && along <= square && turn * turn <= nearest * nearest * square;
}

static bool has_corner(const polygons *p, pcg_vec2 at)
{
    for (uint32_t i = 0; i < p->points; i++)
        if (same_place(p->point[i], at))
            return true;
    return false;
}

/* Puts a corner into the side that it is on, if there is one. */
static int insert(const layout *l, polygons *p, pcg_vec2 corner)
{
    uint32_t loop = 0;

    for (uint32_t i = 0; i < p->points; i++) {
        uint32_t next = i + 1;

        while (i >= p->end[loop])
            loop++;
        next = next < p->end[loop] ? next : loop_begin(p, loop);
        if (!is_between(p->point[i], p->point[next], corner))
            continue;
        if (polygons_add(l->run, p, corner) != PCG_OK)
            return PCG_FAILED;
        for (uint32_t k = p->points - 1; k > i + 1; k--)
            p->point[k] = p->point[k - 1];
        p->point[i + 1] = corner;
        for (; loop < p->loops; loop++)
            p->end[loop]++;
        break;
    }
    return PCG_OK;
}

/* Makes one side of those that lead straight from one place to another: what is between moves to
 * the end. */
static void straighten(polygons *p, pcg_vec2 from, pcg_vec2 to)
{
    for (uint32_t l = 0; l < p->loops; l++) {
        uint32_t first = loop_begin(p, l), count = p->end[l] - first;

        for (uint32_t i = 0; i < count; i++) {
            uint32_t k = 1;

            if (!same_place(p->point[first + i], from))
                continue;
            while (k < count && !same_place(p->point[first + (i + k) % count], to) &&
                   is_between(from, to, p->point[first + (i + k) % count]))
                k++;
            if (k == count || !same_place(p->point[first + (i + k) % count], to))
                continue;
            while (--k > 0)
                p->point[first + (i + k) % count] = to;
        }
    }
}

/* Takes out corners that repeat the one before, and loops that have not three corners then. */
static void drop_repeated(polygons *p)
{
    uint32_t points = 0, loops = 0, from = 0, faces = 0;

    for (uint32_t f = 0; f < p->faces; f++) {
        uint32_t outline = p->face[f], end = face_end(p, f);

        p->face[faces] = loops;
        for (uint32_t l = outline; l < end; l++) {
            uint32_t to = p->end[l], first = points;

            for (uint32_t i = from; i < to; i++)
                if (!same_place(p->point[i], p->point[i + 1 < to ? i + 1 : from]))
                    p->point[points++] = p->point[i];
            from = to;
            if (points < first + 3 || (l > outline && loops == p->face[faces]))
                points = first;
            else
                p->end[loops++] = points;
        }
        faces += loops > p->face[faces];
    }
    *p = (polygons){p->point,          p->end,           p->face,         points, loops, faces,
                    p->point_capacity, p->loop_capacity, p->face_capacity};
}

/* The union is cut where stubs touch the end of another, and rounded: so that the ends of stubs
 * become sides of it again, with the very corners of the streets. */
static int fit_sections(const builder *b, uint32_t cluster, polygons *area)
{
    sections s = {.count = 0};
    int status = find_sections(b, cluster, &s);

    if (status == PCG_OK) {
        for (uint32_t i = 0; i < area->points; i++)
            area->point[i] = welded(&s, area->point[i]);
        for (uint32_t i = 0; i < s.count && status == PCG_OK; i++)
            if (!has_corner(area, s.corner[i]))
                status = insert(b->l, area, s.corner[i]);
        for (uint32_t i = 0; i < s.count; i += 2)
            straighten(area, s.corner[i], s.corner[i + 1]);
        drop_repeated(area);
    }
    run_free(b->l->run, s.corner, s.capacity * sizeof *s.corner);
    return status;
}

/* ---- covers ---------------------------------------------------------------------------------- */

/* What a cluster covers. `at` is its first intrusion; it is moved behind its last one. */
static int cover(const builder *b, uint32_t cluster, uint32_t *at, polygons *out)
{
    const layout *l = b->l;
    polygons loops = {0};
    bool done;
    int status = add_taper(b, cluster, out, &done);

    if (status == PCG_OK && !done)
        status = add_stubs(b, cluster, &loops);
    if (status == PCG_OK && !done)
        status = unite(l, &loops, out);
    if (*at < b->intrusions && b->intrusion[*at].cluster == cluster && status == PCG_OK) {
        status = add_faces(l, out, &loops);
        for (; *at < b->intrusions && b->intrusion[*at].cluster == cluster && status == PCG_OK;
             ++*at) {
            const street_link *k = &l->link[l->link_of[b->intrusion[*at].piece]];
            double from = b->intrusion[*at].piece - k->first;

            status = link_outline(l, b->band, k, fmax(from, k->station[b->band][0]),
                                  fmin(from + 1, k->station[b->band][1]), true, &loops);
        }
        if (status == PCG_OK)
            status = unite(l, &loops, out);
    }
    if (status == PCG_OK)
        status = fit_sections(b, cluster, out);
    polygons_free(l->run, &loops);
    return status;
}

/* ---- intrusions ------------------------------------------------------------------------------ */

/* The cluster at an end of a piece's link, where a part of the piece is in its stub; UINT32_MAX
 * where it is not. */
static uint32_t stub_at(const builder *b, uint32_t piece, double low, double high, uint32_t end)
{
    const street_link *k = &b->l->link[b->l->link_of[piece]];
    double from = piece - k->first + low, to = piece - k->first + high, hair = 1e-7;

    if (!k->internal[b->band] &&
        (end == 0 ? from > k->station[b->band][0] - hair : to < k->station[b->band][1] + hair))
        return UINT32_MAX;
    return cluster_of(b->l, b->band, k->node[end]);
}

/* Whether part of a piece is of the street, not of its stubs. */
static bool is_street(const builder *b, uint32_t piece, double low, double high)
{
    const street_link *k = &b->l->link[b->l->link_of[piece]];
    double from = piece - k->first + low, to = piece - k->first + high, hair = 1e-7;

    return !k->internal[b->band] && to > k->station[b->band][0] + hair &&
           from < k->station[b->band][1] - hair;
}

static bool meets(const builder *b, uint32_t piece, uint32_t cluster)
{
    const street_link *k = &b->l->link[b->l->link_of[piece]];

    return cluster_of(b->l, b->band, k->node[0]) == cluster ||
           cluster_of(b->l, b->band, k->node[1]) == cluster;
}

/* Where a street overlaps a stub of a cluster where it begins or ends. */
static int add_intrusion(builder *b, const overlap *o, uint32_t own)
{
    if (!is_street(b, o->piece[own], o->low[own], o->high[own]))
        return PCG_OK;
    for (uint32_t end = 0; end < 2; end++) {
        uint32_t cluster = stub_at(b, o->piece[1 - own], o->low[1 - own], o->high[1 - own], end);

        if (cluster == UINT32_MAX || !meets(b, o->piece[own], cluster))
            continue;
        if (list_room(b->l->run, (void **)&b->intrusion, &b->intrusion_capacity, b->intrusions, 1,
                      sizeof *b->intrusion) != PCG_OK)
            return PCG_FAILED;
        b->intrusion[b->intrusions++] = (intrusion){cluster, o->piece[own]};
    }
    return PCG_OK;
}

static int compare_intrusions(const void *a, const void *b)
{
    const intrusion *s = a, *t = b;

    if (s->cluster != t->cluster)
        return s->cluster < t->cluster ? -1 : 1;
    return s->piece < t->piece ? -1 : s->piece > t->piece;
}

static int find_intrusions(builder *b)
{
    const overlaps *o = &b->l->overlaps[b->band];
    uint32_t kept = 0;

    for (uint32_t i = 0; i < o->count; i++)
        if (add_intrusion(b, &o->at[i], 0) != PCG_OK || add_intrusion(b, &o->at[i], 1) != PCG_OK)
            return PCG_FAILED;
    if (b->intrusions > 1)
        qsort(b->intrusion, b->intrusions, sizeof *b->intrusion, compare_intrusions);
    for (uint32_t i = 0; i < b->intrusions; i++)
        if (kept == 0 || compare_intrusions(&b->intrusion[kept - 1], &b->intrusion[i]) != 0)
            b->intrusion[kept++] = b->intrusion[i];
    b->intrusions = kept;
    return PCG_OK;
}

/* ---- all of them ----------------------------------------------------------------------------- */

static void list_clusters(builder *b)
{
    uint32_t vertices = b->l->drawing->vertices;

    for (uint32_t v = 0; v < vertices; v++)
        b->begin[cluster_of(b->l, b->band, v) + 2]++;
    for (uint32_t v = 2; v < vertices + 2; v++)
        b->begin[v] += b->begin[v - 1];
    for (uint32_t v = 0; v < vertices; v++)
        b->vertex[b->begin[cluster_of(b->l, b->band, v) + 1]++] = v;
}

static int builder_open(const layout *l, int band, builder *b)
{
    size_t vertices = l->drawing->vertices + (size_t)2;

    *b = (builder){.l = l, .band = band};
    b->begin = run_alloc_array(l->run, vertices, sizeof *b->begin);
    b->vertex = run_alloc(l->run, vertices * sizeof *b->vertex);
    if (b->begin == NULL || b->vertex == NULL)
        return PCG_FAILED;
    list_clusters(b);
    return PCG_OK;
}

static void builder_close(builder *b)
{
    size_t vertices = b->l->drawing->vertices + (size_t)2;

    run_free(b->l->run, b->begin, vertices * sizeof *b->begin);
    run_free(b->l->run, b->vertex, vertices * sizeof *b->vertex);
    run_free(b->l->run, b->intrusion, b->intrusion_capacity * sizeof *b->intrusion);
}

/* One that covers nothing is none. */
static int add_crossing(const builder *b, uint32_t cluster, uint32_t *at, crossings *c)
{
    polygons area = {0};
    int status;

    while (*at < b->intrusions && b->intrusion[*at].cluster < cluster)
        ++*at;
    status = has_area(b, cluster) ? cover(b, cluster, at, &area) : PCG_OK;
    if (status != PCG_OK || area.faces == 0) {
        polygons_free(b->l->run, &area);
        return status;
    }
    c->cluster[c->count] = cluster;
    c->area[c->count++] = area;
    c->number[cluster] = c->count;
    return pcg_tick(b->l->call);
}

static int add_crossings(const builder *b, crossings *c)
{
    uint32_t at = 0, vertices = b->l->drawing->vertices;
    int status = PCG_OK;

    for (uint32_t v = 0; v < vertices && status == PCG_OK; v++)
        if (b->begin[v] < b->begin[v + 1])
            status = add_crossing(b, v, &at, c);
    for (uint32_t v = 0; v < vertices; v++)
        c->number[v] = c->number[cluster_of(b->l, b->band, v)];
    return status;
}

static int crossings_room(const layout *l, crossings *c)
{
    size_t vertices = l->drawing->vertices + (size_t)1;

    *c = (crossings){.room = l->drawing->vertices + 1};
    c->number = run_alloc_array(l->run, vertices, sizeof *c->number);
    c->cluster = run_alloc_array(l->run, vertices, sizeof *c->cluster);
    c->area = run_alloc_array(l->run, vertices, sizeof *c->area);
    return c->number != NULL && c->cluster != NULL && c->area != NULL ? PCG_OK : PCG_FAILED;
}

int crossings_open(const layout *l, int band, crossings *c)
{
    builder b = {.l = l};
    int status = crossings_room(l, c);

    if (status == PCG_OK)
        status = builder_open(l, band, &b);
    if (status == PCG_OK)
        status = find_intrusions(&b);
    if (status == PCG_OK)
        status = add_crossings(&b, c);
    builder_close(&b);
    return status;
}

void crossings_close(const layout *l, crossings *c)
{
    for (uint32_t i = 0; i < c->count; i++)
        polygons_free(l->run, &c->area[i]);
    run_free(l->run, c->number, c->room * sizeof *c->number);
    run_free(l->run, c->cluster, c->room * sizeof *c->cluster);
    run_free(l->run, c->area, c->room * sizeof *c->area);
}

/* ---- corners --------------------------------------------------------------------------------- */

/* Takes away the roadway of an arm between the roadway's crossing and the corridor's. */
static int take_arm(const layout *l, arm a, polygons *out)
{
    const street_link *k = &l->link[a.link];
    double from = k->station[ROADWAY][0], to = k->station[ROADWAY][1];

    if (k->internal[ROADWAY] || (k->internal[CORRIDOR] && a.end == 1))
        return PCG_OK;
    if (!k->internal[CORRIDOR] && a.end == 0)
        to = k->station[CORRIDOR][0];
    if (!k->internal[CORRIDOR] && a.end == 1)
        from = k->station[CORRIDOR][1];
    return link_outline(l, ROADWAY, k, from, to, true, out);
}

static int take_roadways(const builder *b, const crossings *roadway, uint32_t cluster,
                         polygons *out)
{
    const layout *l = b->l;
    int status = PCG_OK;

    for (uint32_t i = b->begin[cluster]; i < b->begin[cluster + 1] && status == PCG_OK; i++) {
        uint32_t v = b->vertex[i];

        if (cluster_of(l, ROADWAY, v) == v && roadway->number[v] != 0)
            status = add_reversed(l, &roadway->area[roadway->number[v] - 1], out);
        for (uint32_t k = l->arm_begin[v]; k < l->arm_begin[v + 1] && status == PCG_OK; k++)
            status = take_arm(l, l->arm[k], out);
    }
    return status;
}

int corners_open(const layout *l, const crossings *roadway, const crossings *corridor,
                 crossings *corner)
{
    builder b = {.l = l};
    polygons loops = {0};
    int status = crossings_room(l, corner);

    if (status == PCG_OK)
        status = builder_open(l, CORRIDOR, &b);
    for (uint32_t i = 0; i < corridor->count && status == PCG_OK; i++) {
        corner->cluster[i] = corridor->cluster[i];
        corner->count = i + 1;
        status = add_faces(l, &corridor->area[i], &loops);
        if (status == PCG_OK)
            status = take_roadways(&b, roadway, corridor->cluster[i], &loops);
        if (status == PCG_OK)
            status = unite(l, &loops, &corner->area[i]);
        if (status == PCG_OK)
            status = pcg_tick(l->call);
    }
    polygons_free(l->run, &loops);
    builder_close(&b);
    return status;
}

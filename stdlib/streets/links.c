/* links.c - links between nodes, and the borders of what they cover. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"

/* Points nearer than this are one; a link turns by less than 120 degrees in a bend. */
static const double least_step = 1e-6;
static const double sharpest_bend = -0.5;
/* In metres: points that are put in are farther than that from others. */
static const double least_inset = 0.05;

/* ---- what meets at a vertex ------------------------------------------------------------------ */

/* The ends of edges at each vertex: edges doubled, odd for the end that the edge comes to. */
typedef struct meeting {
    uint32_t *begin, *end_at; /* of each vertex, one more than there are; the ends */
    uint32_t ends;
} meeting;

static bool is_street(const layout *l, uint32_t edge)
{
    const street_edge *e = &l->drawing->edge[edge];
    pcg_vec3 a = l->drawing->vertex[e->from], b = l->drawing->vertex[e->to];

    return l->way[e->way].width > 0 &&
           vec2_length(vec2_subtract(vec2_of(b), vec2_of(a))) > least_step;
}

static int meeting_open(const layout *l, meeting *m)
{
    const street_drawing *d = l->drawing;

    m->begin = run_alloc_array(l->run, d->vertices + (size_t)2, sizeof *m->begin);
    m->end_at = run_alloc(l->run, (2 * (size_t)d->edges + 1) * sizeof *m->end_at);
    if (m->begin == NULL || m->end_at == NULL)
        return PCG_FAILED;
    for (uint32_t i = 0; i < d->edges; i++)
        if (is_street(l, i)) {
            m->begin[d->edge[i].from + 2]++;
            m->begin[d->edge[i].to + 2]++;
        }
    for (uint32_t i = 2; i < d->vertices + 2; i++)
        m->begin[i] += m->begin[i - 1];
    for (uint32_t i = 0; i < d->edges; i++)
        if (is_street(l, i)) {
            m->end_at[m->begin[d->edge[i].from + 1]++] = 2 * i;
            m->end_at[m->begin[d->edge[i].to + 1]++] = 2 * i + 1;
        }
    return PCG_OK;
}

static void meeting_close(const layout *l, meeting *m)
{
    run_free(l->run, m->begin, (l->drawing->vertices + (size_t)2) * sizeof *m->begin);
    run_free(l->run, m->end_at, (2 * (size_t)l->drawing->edges + 1) * sizeof *m->end_at);
}

static uint32_t vertex_of_end(const layout *l, uint32_t end)
{
    const street_edge *e = &l->drawing->edge[end / 2];

    return end & 1 ? e->to : e->from;
}

/* The other of the two ends at a bend or seam. */
static uint32_t other_end(const layout *l, const meeting *m, uint32_t end)
{
    const uint32_t *at = &m->end_at[m->begin[vertex_of_end(l, end)]];

    return at[0] == end ? at[1] : at[0];
}

/* Where an edge leads to from one of its ends. */
static pcg_vec2 direction_of_end(const layout *l, uint32_t end)
{
    pcg_vec3 from = l->drawing->vertex[vertex_of_end(l, end)];
    pcg_vec3 to = l->drawing->vertex[vertex_of_end(l, end ^ 1)];

    return vec2_normal(vec2_subtract(vec2_of(to), vec2_of(from)));
}

static bool same(double a, double b)
{
    return !(a < b) && !(a > b);
}

static node_kind kind_of_two(const layout *l, uint32_t s, uint32_t t)
{
    const street_way *a = &l->way[l->drawing->edge[s / 2].way];
    const street_way *b = &l->way[l->drawing->edge[t / 2].way];
    bool along = (s & 1) != (t & 1);

    if (vec2_dot(direction_of_end(l, s), direction_of_end(l, t)) > -sharpest_bend ||
        !same(a->width, b->width) || !same(a->left, along ? b->left : b->right) ||
        !same(a->right, along ? b->right : b->left))
        return NODE_CHANGE;
    if (a == b || (a->level == b->level && strcmp(a->name, b->name) == 0 &&
                   strcmp(a->kind, b->kind) == 0 && strcmp(a->id, b->id) == 0))
        return NODE_BEND;
    return NODE_SEAM;
}

static void find_kinds(layout *l, const meeting *m)
{
    for (uint32_t v = 0; v < l->drawing->vertices; v++) {
        uint32_t degree = m->begin[v + 1] - m->begin[v];
        const uint32_t *end = &m->end_at[m->begin[v]];

        l->kind[v] = (uint8_t)(degree > 2    ? NODE_CROSSING
                               : degree == 2 ? kind_of_two(l, end[0], end[1])
                                             : NODE_END);
    }
}

/* ---- links ----------------------------------------------------------------------------------- */

typedef struct linker {
    layout *l;
    const meeting *m;
    bool *taken;   /* of each edge */
    double *along; /* of each edge: how far from its way's begin it begins */
} linker;

static int add_point(layout *l, pcg_vec3 at)
{
    if (list_room(l->run, (void **)&l->point, &l->point_capacity, l->points, 1, sizeof *l->point) !=
        PCG_OK)
        return PCG_FAILED;
    l->point[l->points++] = at;
    return PCG_OK;
}

/* The first end of the link that an edge is in, going against the edge; of a ring, the edge's
 * own. */
static uint32_t first_end(const linker *k, uint32_t edge)
{
    uint32_t end = 2 * edge;

    while (k->l->kind[vertex_of_end(k->l, end)] == NODE_BEND) {
        end = other_end(k->l, k->m, end) ^ 1;
        if (end == 2 * edge)
            break;
    }
    return end;
}

/* Follows a link from its first end to its last node. */
static int follow(linker *k, uint32_t end, street_link *made)
{
    layout *l = k->l;
    uint32_t last;

    if (l->kind[vertex_of_end(l, end)] == NODE_BEND) /* a ring begins anywhere */
        l->kind[vertex_of_end(l, end)] = NODE_SEAM;
    made->node[0] = vertex_of_end(l, end);
    if (add_point(l, l->drawing->vertex[made->node[0]]) != PCG_OK)
        return PCG_FAILED;
    for (;;) {
        k->taken[end / 2] = true;
        last = vertex_of_end(l, end ^ 1);
        if (add_point(l, l->drawing->vertex[last]) != PCG_OK)
            return PCG_FAILED;
        if (l->kind[last] != NODE_BEND)
            break;
        end = other_end(l, k->m, end ^ 1);
    }
    made->node[1] = last;
    return PCG_OK;
}

static double half_of(const layout *l, const street_link *k, int band, int side)
{
    const street_way *w = &l->way[k->way];
    double half = w->width / 2;

    return band == ROADWAY ? half : half + (side == LEFT ? w->left : w->right);
}

/* Puts a point between a node and the first bend, where the bend's cross-section reaches to on the
 * inner side: so that cross-sections up to there are square, not slanting towards the bend. */
static int square_end(layout *l, const street_link *k, bool at_end)
{
    uint32_t last = l->points - 1, bend = at_end ? last - 1 : k->first + 1;
    pcg_vec3 node = l->point[at_end ? last : k->first], at = l->point[bend];
    pcg_vec3 next = l->point[at_end ? bend - 1 : bend + 1];
    pcg_vec2 in = vec2_subtract(vec2_of(at), vec2_of(node));
    pcg_vec2 out = vec2_normal(vec2_subtract(vec2_of(next), vec2_of(at)));
    double length = vec2_length(in), turn = vec2_dot(vec2_normal(in), out);
    double half = fmax(half_of(l, k, CORRIDOR, LEFT), half_of(l, k, CORRIDOR, RIGHT));
    double inset = half * sqrt(fmax(0, 1 - turn) / (1 + turn));

    if (!(inset >= least_inset && inset <= length - least_inset))
        return PCG_OK;
    if (add_point(l, l->point[last]) != PCG_OK)
        return PCG_FAILED;
    at = vec3_add(at, vec3_scale(vec3_subtract(node, at), inset / length));
    for (uint32_t i = last; !at_end && i > k->first + 1; i--)
        l->point[i] = l->point[i - 1];
    l->point[at_end ? last : k->first + 1] = at;
    return PCG_OK;
}

static int square_ends(layout *l, const street_link *k)
{
    if (l->points < k->first + 3)
        return PCG_OK;
    return square_end(l, k, false) == PCG_OK ? square_end(l, k, true) : PCG_FAILED;
}

static int add_link(linker *k, uint32_t edge)
{
    layout *l = k->l;
    uint32_t end = first_end(k, edge);
    street_link made = {.way = l->drawing->edge[edge].way, .first = l->points};

    /* Along a link that runs against some of its ways' edges, distances go on all the same. */
    made.along = k->along[end / 2];
    if (follow(k, end, &made) != PCG_OK || square_ends(l, &made) != PCG_OK ||
        list_room(l->run, (void **)&l->link, &l->link_capacity, l->links, 1, sizeof *l->link) !=
            PCG_OK)
        return PCG_FAILED;
    made.points = l->points - made.first;
    for (int band = 0; band < BANDS; band++) {
        made.station[band][0] = 0;
        made.station[band][1] = link_last(&made);
    }
    l->link[l->links++] = made;
    return pcg_tick(l->call);
}

static void measure_ways(const layout *l, double *along, double *length)
{
    for (uint32_t i = 0; i < l->drawing->edges; i++) {
        const street_edge *e = &l->drawing->edge[i];

        along[i] = length[e->way];
        length[e->way] += vec2_length(vec2_subtract(vec2_of(l->drawing->vertex[e->to]),
                                                    vec2_of(l->drawing->vertex[e->from])));
    }
}

static int find_links(layout *l, const meeting *m)
{
    size_t edges = l->drawing->edges + (size_t)1, ways = l->drawing->ways + (size_t)1;
    linker k = {.l = l, .m = m};
    double *length = run_alloc_array(l->run, ways, sizeof *length);
    int status = PCG_FAILED;

    k.taken = run_alloc_array(l->run, edges, sizeof *k.taken);
    k.along = run_alloc_array(l->run, edges, sizeof *k.along);
    if (k.taken != NULL && k.along != NULL && length != NULL) {
        measure_ways(l, k.along, length);
        status = PCG_OK;
    }
    for (uint32_t i = 0; i < l->drawing->edges && status == PCG_OK; i++)
        if (!k.taken[i] && is_street(l, i))
            status = add_link(&k, i);
    run_free(l->run, k.taken, edges * sizeof *k.taken);
    run_free(l->run, k.along, edges * sizeof *k.along);
    run_free(l->run, length, ways * sizeof *length);
    return status;
}

/* ---- borders --------------------------------------------------------------------------------- */

/* What a border is drawn along: points and what leads from each to the next. */
typedef struct border_line {
    const pcg_vec3 *point;
    uint32_t last;
    double offset;       /* to the left */
    pcg_vec2 *direction; /* of each segment, of length 1 */
    uint32_t *active;    /* segments that the border follows */
    pcg_vec2 *joint;     /* where it begins to follow each of them */
    uint32_t count;
} border_line;

/* From a bend to its border at distance 1 on the left. The same, turned round, when the bend is
 * seen from the other end. */
static pcg_vec2 mitre(pcg_vec2 in, pcg_vec2 out)
{
    pcg_vec2 sum = vec2_add(vec2_left(in), vec2_left(out));

    return vec2_scale(sum, 1 / (1 + vec2_dot(in, out)));
}

static pcg_vec2 offset_point(const border_line *b, uint32_t point, uint32_t segment)
{
    return vec2_add(vec2_of(b->point[point]),
                    vec2_scale(vec2_left(b->direction[segment]), b->offset));
}

/* Where the lines beside two segments meet. */
static pcg_vec2 joint_of(const border_line *b, uint32_t s, uint32_t t)
{
    pcg_vec2 in = b->direction[s], out = b->direction[t];
    pcg_vec2 p, q, meet;
    double turn = vec2_cross(in, out), reach;

    if (t == s + 1 && vec2_dot(in, out) >= sharpest_bend)
        return vec2_add(vec2_of(b->point[t]), vec2_scale(mitre(in, out), b->offset));
    p = offset_point(b, s + 1, s);
    q = offset_point(b, t, t);
    reach = 2 * fabs(b->offset) + vec2_length(vec2_subtract(q, p));
    if (fabs(turn) > 1e-3) {
        meet = vec2_add(p, vec2_scale(in, vec2_cross(vec2_subtract(q, p), out) / turn));
        if (vec2_length(vec2_subtract(meet, p)) <= reach)
            return meet;
    }
    return vec2_between(p, q, 0.5);
}

static bool goes_back(const border_line *b, uint32_t at, pcg_vec2 to)
{
    return vec2_dot(vec2_subtract(to, b->joint[at]), b->direction[b->active[at]]) <= 0;
}

/* Chooses the segments that the border follows: one that it would follow backwards, in a bend that
 * is tighter than the offset, is passed over. */
static void choose_segments(border_line *b, pcg_vec2 start, pcg_vec2 end)
{
    b->active[0] = 0;
    b->joint[0] = start;
    b->count = 1;
    for (uint32_t s = 1; s < b->last; s++) {
        pcg_vec2 meet = joint_of(b, b->active[b->count - 1], s);

        while (b->count > 1 && goes_back(b, b->count - 1, meet)) {
            b->count--;
            meet = joint_of(b, b->active[b->count - 1], s);
        }
        if (b->count == 1 && goes_back(b, 0, meet)) {
            b->active[0] = s;
            continue;
        }
        b->active[b->count] = s;
        b->joint[b->count++] = meet;
    }
    while (b->count > 1 && goes_back(b, b->count - 1, end))
        b->count--;
}

static void draw_border(border_line *b, pcg_vec2 start, pcg_vec2 end, pcg_vec2 *border)
{
    uint32_t at = 0;

    choose_segments(b, start, end);
    border[0] = start;
    border[b->last] = end;
    for (uint32_t i = 1; i < b->last; i++) {
        while (at < b->count && b->active[at] < i)
            at++;
        border[i] = at < b->count ? b->joint[at] : end;
    }
    for (uint32_t i = 0; i <= b->last; i++)
        border[i] = vec2_snap(border[i]);
}

/* From a link's end to its left border at distance 1: across it, or along the seam. */
static pcg_vec2 across(const layout *l, const meeting *m, const street_link *k, uint32_t end)
{
    const pcg_vec3 *p = &l->point[k->first];
    uint32_t last = link_last(k), v = k->node[end];
    pcg_vec2 own = end == 0 ? vec2_normal(vec2_subtract(vec2_of(p[1]), vec2_of(p[0])))
                            : vec2_normal(vec2_subtract(vec2_of(p[last]), vec2_of(p[last - 1])));
    pcg_vec2 leaving = end == 0 ? own : vec2_scale(own, -1), here, there;

    if (l->kind[v] != NODE_SEAM)
        return vec2_left(own);
    /* Both links take the directions from the drawing, so that they come to the same to the bit. */
    here = direction_of_end(l, m->end_at[m->begin[v]]);
    there = direction_of_end(l, m->end_at[m->begin[v] + 1]);
    if (vec2_dot(there, leaving) > vec2_dot(here, leaving)) {
        pcg_vec2 swapped = here;

        here = there;
        there = swapped;
    }
    return end == 0 ? mitre(vec2_scale(there, -1), here) : mitre(vec2_scale(here, -1), there);
}

static void draw_borders(layout *l, const meeting *m, const street_link *k, border_line *b)
{
    pcg_vec2 first = vec2_of(l->point[k->first]), last = vec2_of(l->point[k->first + link_last(k)]);
    pcg_vec2 start = across(l, m, k, 0), end = across(l, m, k, 1);

    b->point = &l->point[k->first];
    b->last = link_last(k);
    for (uint32_t i = 0; i < b->last; i++)
        b->direction[i] =
            vec2_normal(vec2_subtract(vec2_of(b->point[i + 1]), vec2_of(b->point[i])));
    for (int band = 0; band < BANDS; band++)
        for (int side = 0; side < SIDES; side++) {
            b->offset = half_of(l, k, band, side) * (side == LEFT ? 1 : -1);
            draw_border(b, vec2_add(first, vec2_scale(start, b->offset)),
                        vec2_add(last, vec2_scale(end, b->offset)),
                        &l->border[band][side][k->first]);
        }
}

static int draw_all_borders(layout *l, const meeting *m)
{
    size_t room = l->points + (size_t)1;
    border_line b = {.count = 0};
    int status = PCG_OK;

    for (int band = 0; band < BANDS; band++)
        for (int side = 0; side < SIDES; side++) {
            l->border[band][side] = run_alloc(l->run, room * sizeof(pcg_vec2));
            status = l->border[band][side] != NULL ? status : PCG_FAILED;
        }
    b.direction = run_alloc(l->run, room * sizeof *b.direction);
    b.joint = run_alloc(l->run, room * sizeof *b.joint);
    b.active = run_alloc(l->run, room * sizeof *b.active);
    if (b.direction == NULL || b.joint == NULL || b.active == NULL)
        status = PCG_FAILED;
    for (uint32_t i = 0; i < l->links && status == PCG_OK; i++) {
        draw_borders(l, m, &l->link[i], &b);
        status = pcg_tick(l->call);
    }
    run_free(l->run, b.direction, room * sizeof *b.direction);
    run_free(l->run, b.joint, room * sizeof *b.joint);
    run_free(l->run, b.active, room * sizeof *b.active);
    return status;
}

/* ---- stations -------------------------------------------------------------------------------- */

/* The piece that a station is in, by its first point, and how far in it. */
static uint32_t piece_at(const street_link *k, double station, double *share)
{
    uint32_t last = link_last(k) - 1, at = station < last ? (uint32_t)station : last;

    *share = station - at;
    return k->first + at;
}

pcg_vec2 border_at(const layout *l, int band, int side, const street_link *k, double station)
{
    double share;
    uint32_t at = piece_at(k, station, &share);
    const pcg_vec2 *border = l->border[band][side];

    return vec2_snap(vec2_between(border[at], border[at + 1], share));
}

pcg_vec3 center_at(const layout *l, const street_link *k, double station)
{
    double share;
    uint32_t at = piece_at(k, station, &share);
    pcg_vec3 a = l->point[at], b = l->point[at + 1];

    return vec3_add(a, vec3_scale(vec3_subtract(b, a), share));
}

double arc_at(const layout *l, const street_link *k, double station)
{
    double share;
    uint32_t at = piece_at(k, station, &share);

    return l->arc[at] + (l->arc[at + 1] - l->arc[at]) * share;
}

/* ---- arms ------------------------------------------------------------------------------------ */

pcg_vec2 arm_direction(const layout *l, arm a)
{
    const street_link *k = &l->link[a.link];
    const pcg_vec3 *p = &l->point[k->first];
    uint32_t last = link_last(k);

    return a.end == 0 ? vec2_normal(vec2_subtract(vec2_of(p[1]), vec2_of(p[0])))
                      : vec2_normal(vec2_subtract(vec2_of(p[last - 1]), vec2_of(p[last])));
}

pcg_vec2 arm_border(const layout *l, int band, arm a, int side)
{
    const street_link *k = &l->link[a.link];
    int own = a.end == 0 ? side : side == LEFT ? RIGHT : LEFT;

    return l->border[band][own][a.end == 0 ? k->first : k->first + link_last(k)];
}

static int half_plane(pcg_vec2 a)
{
    return a.y < 0 || (a.y <= 0 && a.x < 0);
}

typedef struct sorted_arm {
    pcg_vec2 direction;
    uint32_t node;
    arm arm;
} sorted_arm;

/* By node, then counter-clockwise. */
static int compare_arms(const void *a, const void *b)
{
    const sorted_arm *s = a, *t = b;
    double turn = vec2_cross(s->direction, t->direction);

    if (s->node != t->node)
        return s->node < t->node ? -1 : 1;
    if (half_plane(s->direction) != half_plane(t->direction))
        return half_plane(s->direction) - half_plane(t->direction);
    if (turn > 0 || turn < 0)
        return turn > 0 ? -1 : 1;
    if (s->arm.link != t->arm.link)
        return s->arm.link < t->arm.link ? -1 : 1;
    return s->arm.end < t->arm.end ? -1 : s->arm.end > t->arm.end;
}

static void fill_arms(layout *l, sorted_arm *sorted)
{
    uint32_t arms = 2 * l->links;

    for (uint32_t i = 0; i < arms; i++) {
        arm a = {i / 2, i % 2};

        sorted[i] = (sorted_arm){arm_direction(l, a), l->link[a.link].node[a.end], a};
        l->arm_begin[sorted[i].node + 1]++;
    }
    if (arms > 1)
        qsort(sorted, arms, sizeof *sorted, compare_arms);
    for (uint32_t i = 0; i < arms; i++)
        l->arm[i] = sorted[i].arm;
    for (uint32_t v = 0; v < l->drawing->vertices; v++)
        l->arm_begin[v + 1] += l->arm_begin[v];
}

static int find_arms(layout *l)
{
    size_t arms = 2 * (size_t)l->links + 1;
    sorted_arm *sorted = run_alloc(l->run, arms * sizeof *sorted);

    l->arm_begin = run_alloc_array(l->run, l->drawing->vertices + (size_t)1, sizeof *l->arm_begin);
    l->arm = run_alloc(l->run, arms * sizeof *l->arm);
    if (sorted == NULL || l->arm_begin == NULL || l->arm == NULL)
        return PCG_FAILED;
    fill_arms(l, sorted);
    run_free(l->run, sorted, arms * sizeof *sorted);
    return PCG_OK;
}

/* ---- all of it ------------------------------------------------------------------------------- */

static int measure_links(layout *l)
{
    l->link_of = run_alloc(l->run, (l->points + (size_t)1) * sizeof *l->link_of);
    l->arc = run_alloc(l->run, (l->points + (size_t)1) * sizeof *l->arc);
    if (l->link_of == NULL || l->arc == NULL)
        return PCG_FAILED;
    for (uint32_t k = 0; k < l->links; k++) {
        uint32_t first = l->link[k].first;
        double arc = 0;

        for (uint32_t i = first; i < first + l->link[k].points; i++) {
            if (i > first)
                arc += vec2_length(vec2_subtract(vec2_of(l->point[i]), vec2_of(l->point[i - 1])));
            l->link_of[i] = k;
            l->arc[i] = arc;
        }
    }
    return PCG_OK;
}

static void find_sidewalks(layout *l)
{
    for (uint32_t i = 0; i < l->links; i++) {
        const street_way *w = &l->way[l->link[i].way];

        l->sidewalks = l->sidewalks || w->left > 0 || w->right > 0;
    }
}

int layout_open(pcg_call *call, const street_drawing *d, street_way *way, layout *l)
{
    meeting m = {.ends = 0};
    int status = PCG_FAILED;

    *l = (layout){.call = call, .run = call->run, .drawing = d, .way = way};
    l->kind = run_alloc_zeroed(call->run, d->vertices + (size_t)1);
    if (l->kind != NULL)
        status = meeting_open(l, &m);
    if (status == PCG_OK) {
        find_kinds(l, &m);
        status = find_links(l, &m);
    }
    if (status == PCG_OK)
        status = measure_links(l);
    if (status == PCG_OK)
        status = draw_all_borders(l, &m);
    if (status == PCG_OK)
        status = find_arms(l);
    meeting_close(l, &m);
    find_sidewalks(l);
    return status;
}

void layout_close(layout *l)
{
    pcg_run *r = l->run;
    size_t points = l->points + (size_t)1, vertices = l->drawing->vertices + (size_t)1;

    run_free(r, l->kind, vertices);
    run_free(r, l->link, l->link_capacity * sizeof *l->link);
    run_free(r, l->point, l->point_capacity * sizeof *l->point);
    run_free(r, l->link_of, points * sizeof *l->link_of);
    run_free(r, l->arc, points * sizeof *l->arc);
    run_free(r, l->arm_begin, vertices * sizeof *l->arm_begin);
    run_free(r, l->arm, (2 * (size_t)l->links + 1) * sizeof *l->arm);
    for (int band = 0; band < BANDS; band++) {
        overlaps *o = &l->overlaps[band];

        for (int side = 0; side < SIDES; side++)
            run_free(r, l->border[band][side], points * sizeof(pcg_vec2));
        run_free(r, l->cluster[band], vertices * sizeof(uint32_t));
        run_free(r, o->at, o->capacity * sizeof *o->at);
        run_free(r, o->begin, (points + 1) * sizeof *o->begin);
        run_free(r, o->of, (2 * (size_t)o->count + 1) * sizeof *o->of);
    }
}

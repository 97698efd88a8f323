/*pcg
/// Makes the ground of a street network: roadways, crossings, sidewalks, and the lots in between.
///
/// `streets` are strips, one for each street between two crossings or ends, mitred in bends;
/// `crossings` lie between them, with the same vertices where they meet, and overlap none of the
/// streets that meet there. `sidewalks` lie beside the streets, and around the corners of crossings;
/// `lots` are the faces of the ground that is enclosed by all these, of streets on level 0. Streets
/// end square. Where streets of different width follow each other, a short crossing levels it out;
/// crossings that are too near to each other for a street in between are one. Networks are to be
/// blended first: streets that cross without a vertex in common lie over each other.
///
/// Texture coordinates run along the way: u once in each `texture_length`, v from 0 on the right to
/// 1 on the left. All is level with the vertices of the network; lots, where those are not in one
/// plane, with their mean. Ways without width are left out, with a warning.
procedure street_to_shape(in: StreetNetwork) -> (streets: Shape, sidewalks: Shape, crossings: Shape, lots: Shape) [pure] {
    category "streets"
    synonyms "roads", "roadway", "sidewalk", "pavement", "junction", "intersection", "lot", "block", "parcel"
    param width: length = 0m            /// Of all roadways; 0: each as wide as its way says.
    param sidewalk: length = -1m        /// Of the sidewalks on both sides; below 0: as the way says.
    param texture_length: length = 0m   /// How far it is from one u to the next; 0: as far as the street is wide.
    attr index: int       /// Written: the number of the street, crossing or lot; of a sidewalk, its street's, or its corner's.
    attr name: string     /// Written: of the way; of a crossing, its widest one's.
    attr kind: string     /// Written: likewise.
    attr id: string       /// Written: likewise.
    attr street_width: length   /// Written: likewise; of a sidewalk, its own.
    attr level: int       /// Written: likewise.
    attr from: int        /// Written: the index of the crossing where a street begins, -1 where there is none.
    attr to: int          /// Written: the index of the crossing where it ends, -1 where there is none.
    attr arms: int        /// Written: how many streets meet at a crossing.
    attr side: string     /// Written: of a sidewalk: left, right or corner.
    example street(width = 4m) { vertex(0m, 0m); vertex(20m, 0m); vertex(20m, 20m) }
        -> t: street_to_shape() expect t.streets.count = 1, t.streets.area = 160
    example rectangle(width = 80m, height = 80m)
        -> split(axis = y, repeat = true) { absolute(20m) }
        -> split(axis = x, repeat = true) { absolute(20m) }
        -> streets_from_shapes() -> merge_streets() -> blend_streets()
        -> t: street_to_shape(width = 4m) expect t.streets.count = 36, t.crossings.count = 21, t.lots.count = 16, t.lots.area = 4096
}
*/
#include <math.h>

#include "layout.h"
#include "street_to_shape.h"

typedef struct pcg_streets_street_to_shape shaper_node;

typedef struct shaper {
    pcg_call *call;
    pcg_run *run;
    const shaper_node *node;
    layout layout;
    crossings crossings[BANDS]; /* of what is there: without sidewalks, the corridor's are none */
    double height;              /* mean of all vertices */
    bool level;                 /* all vertices are at that height */
} shaper;

/* ---- meshes ---------------------------------------------------------------------------------- */

static uint32_t add_vertex(const shaper *s, pcg_mesh *m, pcg_vec2 at, double height)
{
    return pcg_mesh_add_vertex(s->run, m,
                               vec3(streets_snap(at.x), streets_snap(at.y), streets_snap(height)));
}

static pcg_shape *new_shape(const shaper *s)
{
    pcg_shape *made = pcg_shape_new(s->call, s->node->in);
    pcg_mesh *m = made != NULL ? pcg_mesh_new(s->run, false) : NULL;

    if (m != NULL) {
        pcg_shape_set_mesh(s->run, made, m);
        return made;
    }
    if (made != NULL)
        pcg_entity_drop(s->run, &made->entity);
    return NULL;
}

/* Sends a shape out, or drops it where what made it has failed, or where it is empty. */
static int emit(const shaper *s, const pcg_port *port, pcg_shape *made, int status)
{
    if (status == PCG_OK && made->mesh->face_count > 0)
        status = pcg_shape_fit(s->run, made);
    if (status == PCG_OK && made->mesh->face_count > 0)
        return pcg_emit(s->call, port, &made->entity);
    pcg_entity_drop(s->run, &made->entity);
    return status;
}

static void describe_way(const shaper *s, pcg_shape *made, const street_way *w)
{
    const shaper_node *n = s->node;

    pcg_set_string(s->run, &made->entity, &n->name, w->name);
    pcg_set_string(s->run, &made->entity, &n->kind, w->kind);
    pcg_set_string(s->run, &made->entity, &n->id, w->id);
    pcg_set_float(s->run, &made->entity, &n->street_width, w->width);
    pcg_set_int(s->run, &made->entity, &n->level, w->level);
}

/* ---- strips ---------------------------------------------------------------------------------- */

/* What lies between two borders of a link. */
typedef struct strip {
    const street_link *k;
    int left_band, left_side, right_band, right_side;
    double texture_length;
} strip;

/* A cross-section of a strip: its vertices, and u. */
typedef struct section {
    uint32_t left, right;
    double u;
} section;

static bool same_vertex(const pcg_mesh *m, uint32_t a, pcg_vec2 at)
{
    return m->position[a].x == streets_snap(at.x) && m->position[a].y == streets_snap(at.y);
}

/* Where a border stands still, in a tight bend, the vertex before is used again. */
static int add_section(const shaper *s, const strip *t, pcg_mesh *m, double station,
                       const section *before, section *made)
{
    const layout *l = &s->layout;
    pcg_vec2 left = border_at(l, t->left_band, t->left_side, t->k, station);
    pcg_vec2 right = border_at(l, t->right_band, t->right_side, t->k, station);
    double height = center_at(l, t->k, station).z;

    made->u = (t->k->along + arc_at(l, t->k, station)) / t->texture_length;
    made->right = before != NULL && same_vertex(m, before->right, right)
                      ? before->right
                      : add_vertex(s, m, right, height);
    made->left = before != NULL && same_vertex(m, before->left, left)
                     ? before->left
                     : add_vertex(s, m, left, height);
    return made->left != UINT32_MAX && made->right != UINT32_MAX ? PCG_OK : PCG_FAILED;
}

static void set_uv(pcg_mesh *m, uint32_t corner, double u, double v)
{
    m->corner_uv[2 * (size_t)corner] = (float)u;
    m->corner_uv[2 * (size_t)corner + 1] = (float)v;
}

/* The face between two cross-sections: four corners, or three where a border stands still. */
static int add_piece(const shaper *s, pcg_mesh *m, const section *a, const section *b)
{
    const struct {
        uint32_t vertex;
        double u, v;
    } corner[4] = {
        {a->right, a->u, 0}, {b->right, b->u, 0}, {b->left, b->u, 1}, {a->left, a->u, 1}};
    uint32_t vertex[4], count = 0, first;
    double uv[4][2];

    for (uint32_t i = 0; i < 4; i++) {
        if (corner[i].vertex == corner[(i + 3) % 4].vertex)
            continue;
        vertex[count] = corner[i].vertex;
        uv[count][0] = corner[i].u;
        uv[count++][1] = corner[i].v;
    }
    if (count < 3)
        return PCG_OK;
    first = m->corner_count;
    if (pcg_mesh_add_face(s->run, m, vertex, count) == UINT32_MAX ||
        pcg_mesh_need_uvs(s->run, m) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < count; i++)
        set_uv(m, first + i, uv[i][0], uv[i][1]);
    return PCG_OK;
}

static int add_strip(const shaper *s, const strip *t, pcg_mesh *m, double from, double to)
{
    section before, here;
    double station = from;
    int status = add_section(s, t, m, from, NULL, &before);

    while (station < to && status == PCG_OK) {
        station = fmin(floor(station) + 1, to);
        status = add_section(s, t, m, station, &before, &here);
        if (status == PCG_OK)
            status = add_piece(s, m, &before, &here);
        before = here;
    }
    return status;
}

static double texture_length(const shaper *s, double width)
{
    double given = s->node->texture_length;

    return given > 0 && isfinite(given) ? given : width;
}

/* ---- streets --------------------------------------------------------------------------------- */

static int emit_street(const shaper *s, uint32_t index)
{
    const street_link *k = &s->layout.link[index];
    const street_way *w = &s->layout.way[k->way];
    const strip t = {k, ROADWAY, LEFT, ROADWAY, RIGHT, texture_length(s, w->width)};
    const crossings *c = &s->crossings[ROADWAY];
    pcg_shape *made;
    int status;

    if (k->internal[ROADWAY])
        return PCG_OK;
    if ((made = new_shape(s)) == NULL)
        return PCG_FAILED;
    status = add_strip(s, &t, made->mesh, k->station[ROADWAY][0], k->station[ROADWAY][1]);
    describe_way(s, made, w);
    pcg_set_int(s->run, &made->entity, &s->node->index, index);
    pcg_set_int(s->run, &made->entity, &s->node->from, (pcg_int)c->number[k->node[0]] - 1);
    pcg_set_int(s->run, &made->entity, &s->node->to, (pcg_int)c->number[k->node[1]] - 1);
    return emit(s, s->node->streets, made, status);
}

static int emit_streets(const shaper *s)
{
    int status = PCG_OK;

    for (uint32_t i = 0; i < s->layout.links && status == PCG_OK; i++) {
        status = emit_street(s, i);
        if (status == PCG_OK)
            status = pcg_tick(s->call);
    }
    return status;
}

/* ---- sidewalks ------------------------------------------------------------------------------- */

static int emit_sidewalk(const shaper *s, uint32_t index, int side)
{
    const street_link *k = &s->layout.link[index];
    const street_way *w = &s->layout.way[k->way];
    double width = side == LEFT ? w->left : w->right;
    strip t = {k, CORRIDOR, LEFT, ROADWAY, LEFT, texture_length(s, width)};
    pcg_shape *made;
    int status;

    if (k->internal[CORRIDOR] || !(width > 0))
        return PCG_OK;
    if (side == RIGHT)
        t = (strip){k, ROADWAY, RIGHT, CORRIDOR, RIGHT, texture_length(s, width)};
    if ((made = new_shape(s)) == NULL)
        return PCG_FAILED;
    status = add_strip(s, &t, made->mesh, k->station[CORRIDOR][0], k->station[CORRIDOR][1]);
    describe_way(s, made, w);
    pcg_set_float(s->run, &made->entity, &s->node->street_width, width);
    pcg_set_int(s->run, &made->entity, &s->node->index, index);
    pcg_set_string(s->run, &made->entity, &s->node->side, side == LEFT ? "left" : "right");
    return emit(s, s->node->sidewalks, made, status);
}

/* ---- faces of any form ----------------------------------------------------------------------- */

/* The height of a place of a crossing: that of the cross-section whose border it is, else between
 * those of all of them, the nearer the more. */
static double height_at(const shaper *s, int band, const crossings *c, uint32_t crossing,
                        pcg_vec2 at)
{
    const layout *l = &s->layout;
    uint32_t cluster = c->cluster[crossing];
    double sum = l->drawing->vertex[cluster].z * 1e-9, weights = 1e-9;

    for (uint32_t i = l->arm_begin[cluster]; !s->level && i < l->arm_begin[cluster + 1]; i++) {
        const street_link *k = &l->link[l->arm[i].link];
        double station = k->station[band][l->arm[i].end];
        pcg_vec3 center = center_at(l, k, station);

        for (int side = 0; side < SIDES; side++) {
            pcg_vec2 away = vec2_subtract(at, border_at(l, band, side, k, station));
            double square = vec2_dot(away, away);

            if (!(square > 1e-18))
                return center.z;
            sum += center.z / square;
            weights += 1 / square;
        }
    }
    return s->level ? s->height : sum / weights;
}

typedef struct surface {
    const polygons *area;
    int band;
    const crossings *crossings; /* NULL: all is at the mean height */
    uint32_t crossing;
} surface;

/* Adds one loop's vertices; their numbers go into `vertex`. How many. UINT32_MAX: no memory. */
static uint32_t add_loop(const shaper *s, const surface *f, uint32_t loop, pcg_mesh *m,
                         uint32_t *vertex)
{
    uint32_t count = 0;

    for (uint32_t i = loop_begin(f->area, loop); i < f->area->end[loop]; i++) {
        pcg_vec2 at = f->area->point[i];
        double height =
            f->crossings != NULL ? height_at(s, f->band, f->crossings, f->crossing, at) : s->height;

        vertex[count] = add_vertex(s, m, at, height);
        if (vertex[count++] == UINT32_MAX)
            return UINT32_MAX;
    }
    return count;
}

static int add_face(const shaper *s, const surface *f, uint32_t face, pcg_mesh *m, uint32_t *vertex)
{
    for (uint32_t i = f->area->face[face]; i < face_end(f->area, face); i++) {
        uint32_t count = add_loop(s, f, i, m, vertex), made;

        if (count == UINT32_MAX)
            return PCG_FAILED;
        made = i == f->area->face[face] ? pcg_mesh_add_face(s->run, m, vertex, count)
                                        : pcg_mesh_add_hole(s->run, m, vertex, count);
        if (made == UINT32_MAX)
            return PCG_FAILED;
    }
    return PCG_OK;
}

/* Faces from one number up to another. Texture coordinates are places in the plane. */
static int add_faces(const shaper *s, const surface *f, uint32_t from, uint32_t to, pcg_mesh *m)
{
    size_t size = (f->area->points + (size_t)1) * sizeof(uint32_t);
    uint32_t *vertex = run_alloc(s->run, size);
    double length = texture_length(s, 4);
    int status = vertex != NULL ? PCG_OK : PCG_FAILED;

    for (uint32_t i = from; i < to && status == PCG_OK; i++)
        status = add_face(s, f, i, m, vertex);
    run_free(s->run, vertex, size);
    if (status != PCG_OK || pcg_mesh_need_uvs(s->run, m) != PCG_OK)
        return PCG_FAILED;
    for (uint32_t i = 0; i < m->corner_count; i++) {
        pcg_vec3 at = m->position[m->corner_vertex[i]];

        set_uv(m, i, at.x / length, at.y / length);
    }
    return PCG_OK;
}

/* The widest way at a crossing, and how many streets meet there. */
static const street_way *widest_way(const shaper *s, const crossings *c, uint32_t *arms,
                                    const street_way **widest)
{
    const layout *l = &s->layout;

    for (uint32_t i = 0; i < 2 * l->links; i++) {
        const street_link *k = &l->link[i / 2];
        uint32_t crossing = c->number[k->node[i % 2]];
        const street_way *w = &l->way[k->way];

        if (crossing == 0)
            continue;
        arms[crossing - 1] += !k->internal[ROADWAY];
        if (widest[crossing - 1] == NULL || w->width > widest[crossing - 1]->width)
            widest[crossing - 1] = w;
    }
    return NULL;
}

static int emit_crossing(const shaper *s, uint32_t index, uint32_t arms, const street_way *widest)
{
    const crossings *c = &s->crossings[ROADWAY];
    const surface f = {&c->area[index], ROADWAY, c, index};
    pcg_shape *made = new_shape(s);
    int status;

    if (made == NULL)
        return PCG_FAILED;
    status = add_faces(s, &f, 0, f.area->faces, made->mesh);
    if (widest != NULL)
        describe_way(s, made, widest);
    pcg_set_int(s->run, &made->entity, &s->node->index, index);
    pcg_set_int(s->run, &made->entity, &s->node->arms, arms);
    return emit(s, s->node->crossings, made, status);
}

static int emit_crossings(const shaper *s)
{
    const crossings *c = &s->crossings[ROADWAY];
    size_t count = c->count + (size_t)1;
    uint32_t *arms = run_alloc_array(s->run, count, sizeof *arms);
    const street_way **widest = run_alloc_array(s->run, count, sizeof *widest);
    int status = arms != NULL && widest != NULL ? PCG_OK : PCG_FAILED;

    if (status == PCG_OK)
        widest_way(s, c, arms, widest);
    for (uint32_t i = 0; i < c->count && status == PCG_OK; i++)
        status = emit_crossing(s, i, arms[i], widest[i]);
    run_free(s->run, arms, count * sizeof *arms);
    run_free(s->run, (void *)(uintptr_t)widest, count * sizeof *widest);
    return status;
}

static int emit_corners(const shaper *s)
{
    crossings corner;
    int status = corners_open(&s->layout, &s->crossings[ROADWAY], &s->crossings[CORRIDOR], &corner);

    for (uint32_t i = 0; i < corner.count && status == PCG_OK; i++) {
        const surface f = {&corner.area[i], CORRIDOR, &corner, i};
        pcg_shape *made = new_shape(s);

        if (made == NULL) {
            status = PCG_FAILED;
            break;
        }
        status = add_faces(s, &f, 0, f.area->faces, made->mesh);
        pcg_set_int(s->run, &made->entity, &s->node->index, i);
        pcg_set_string(s->run, &made->entity, &s->node->side, "corner");
        status = emit(s, s->node->sidewalks, made, status);
    }
    crossings_close(&s->layout, &corner);
    return status;
}

static int emit_sidewalks(const shaper *s)
{
    int status = PCG_OK;

    for (uint32_t i = 0; i < s->layout.links && status == PCG_OK; i++) {
        status = emit_sidewalk(s, i, LEFT);
        if (status == PCG_OK)
            status = emit_sidewalk(s, i, RIGHT);
        if (status == PCG_OK)
            status = pcg_tick(s->call);
    }
    return status == PCG_OK ? emit_corners(s) : status;
}

static int emit_lots(const shaper *s, int band)
{
    polygons lots = {0};
    int status = lots_find(&s->layout, band, &s->crossings[band], &lots);

    for (uint32_t i = 0; i < lots.faces && status == PCG_OK; i++) {
        const surface f = {&lots, band, NULL, 0};
        pcg_shape *made = new_shape(s);

        if (made == NULL) {
            status = PCG_FAILED;
            break;
        }
        status = add_faces(s, &f, i, i + 1, made->mesh);
        pcg_set_int(s->run, &made->entity, &s->node->index, i);
        status = emit(s, s->node->lots, made, status);
    }
    polygons_free(s->run, &lots);
    return status;
}

/* ---- the procedure --------------------------------------------------------------------------- */

/* The ways with what the node overrides. */
static street_way *widths(pcg_call *call, const shaper_node *node, const street_drawing *d)
{
    street_way *way = run_alloc(call->run, (d->ways + (size_t)1) * sizeof *way);
    uint32_t without = 0;

    for (uint32_t i = 0; way != NULL && i < d->ways; i++) {
        way[i] = d->way[i];
        way[i].width = streets_width(node->width > 0 ? node->width : way[i].width);
        way[i].left = streets_width(node->sidewalk >= 0 ? node->sidewalk : way[i].left);
        way[i].right = streets_width(node->sidewalk >= 0 ? node->sidewalk : way[i].right);
        without += !(way[i].width > 0);
    }
    if (way != NULL && without > 0 &&
        pcg_warn(call, "%u way%s without a width that can be built %s left out", without,
                 without == 1 ? "" : "s", without == 1 ? "is" : "are") != PCG_OK)
        return NULL;
    return way;
}

static void measure_heights(shaper *s, const street_drawing *d)
{
    double sum = 0;

    s->level = true;
    for (uint32_t i = 0; i < d->vertices; i++) {
        sum += d->vertex[i].z - d->vertex[0].z;
        s->level = s->level && d->vertex[i].z == d->vertex[0].z;
    }
    s->height = d->vertices > 0 ? d->vertex[0].z + sum / d->vertices : 0;
}

static int lay_out(shaper *s, int band)
{
    int status = layout_find_overlaps(&s->layout, band);

    if (status == PCG_OK)
        status = layout_find_clusters(&s->layout, band);
    return status == PCG_OK ? crossings_open(&s->layout, band, &s->crossings[band]) : status;
}

static int make_shapes(shaper *s)
{
    int band = ROADWAY, status = lay_out(s, ROADWAY);

    if (status == PCG_OK)
        status = emit_streets(s);
    if (status == PCG_OK && s->layout.sidewalks &&
        (s->node->sidewalks->count > 0 || s->node->lots->count > 0)) {
        band = CORRIDOR;
        status = lay_out(s, CORRIDOR);
    }
    if (status == PCG_OK && band == CORRIDOR && s->node->sidewalks->count > 0)
        status = emit_sidewalks(s);
    if (status == PCG_OK && s->node->crossings->count > 0)
        status = emit_crossings(s);
    if (status == PCG_OK && s->node->lots->count > 0)
        status = emit_lots(s, band);
    return status;
}

int pcg_streets_street_to_shape(pcg_call *call, struct pcg_streets_street_to_shape *node)
{
    const street_drawing *d = ((const pcg_streets *)node->in)->drawing;
    shaper s = {.call = call, .run = call->run, .node = node};
    street_way *way = widths(call, node, d);
    int status = PCG_FAILED;

    if (way != NULL) {
        measure_heights(&s, d);
        status = layout_open(call, d, way, &s.layout);
        if (status == PCG_OK)
            status = make_shapes(&s);
        for (int band = 0; band < BANDS; band++)
            crossings_close(&s.layout, &s.crossings[band]);
        layout_close(&s.layout);
    }
    run_free(call->run, way, (d->ways + (size_t)1) * sizeof *way);
    pcg_entity_drop(call->run, node->in);
    return status;
}

/* picture_camera.c - frames a scene: from where one looks at a model on a table.
 *
 * What is as high as it is wide is seen from the front (-y), a little from the right and from
 * above. The flatter a scene is, the steeper one looks down at it; a town is seen from the south
 * with the north up, as on a map. Options ask for other views, for a part, or for a place to
 * stand.
 */
#include "stdlib/io/picture.h"

#include <float.h>
#include <string.h>

#include "runtime/real.h"

#define TURN 32.0            /* degrees from the front (-y) to the right (+x) */
#define TILT_TALL 8.0        /* degrees that the camera looks down: at a tower … */
#define TILT_FLAT 40.0       /* … at what lies flat … */
#define TILT_TOWN 56.0       /* … and at a town, which is wider than high by so much: */
#define TOWN_BEGINS 15.0f
#define TOWN_ENDS 60.0f
#define TOWN_HAZE 0.22f
enum { TOWN_LEAVES_OUT = 500 }; /* one corner in so many may stand outside of the picture */
#define FIELD 24.0           /* degrees of the picture's smaller side */
#define STANDING_FIELD 60.0  /* of who stands somewhere and looks around */
#define FIELD_MOST 100.0
#define MARGIN 0.07f         /* of the picture, on each side */
#define GAP_SHARE 2e-3f      /* of the scene; a pixel where that is less */
#define NEAREST_SHARE 0.005f /* of the distance to what is looked at: what is nearer is cut off */

/* ---- what the options say -------------------------------------------------------------------- */

typedef struct view {
    const char *name;
    double turn, tilt;           /* degrees */
    bool parallel;
} view;

static const view views[] = {
    {"bird", 0, TILT_TOWN, false}, {"iso", 45, 35.264389682754654, true}, {"top", 0, 90, true},
    {"front", 0, 0, true},         {"back", 180, 0, true},               {"left", -90, 0, true},
    {"right", 90, 0, true},
};

static const view *find_view(const char *name)
{
    for (size_t i = 0; i < COUNT_OF(views); i++)
        if (strcmp(name, views[i].name) == 0)
            return &views[i];
    return NULL;
}

/* Numbers between commas; returns how many, 0 where the text is none of that. */
static int read_numbers(const char *text_, double *out, int most)
{
    for (int count = 1; count <= most; count++) {
        const char *end;
        out[count - 1] = number_read(text_, &end);
        if (end == text_ || !(fabs(out[count - 1]) < IO_FARTHEST_PLACE))
            return 0;
        if (!*end)
            return count;
        if (*end != ',')
            return 0;
        text_ = end + 1;
    }
    return 0;
}

static bool refuse(io_job *j, const char *path, const char *why, const char *what)
{
    io_fail(j, PCG_STATUS_MISUSE, "no picture '%s': %s, not '%s'", path, why, what);
    return false;
}

bool picture_read_aim(io_job *j, const char *path, picture_aim *out)
{
    const pcg_write_options *o = &j->options;
    double at[4] = {0, 0, 0, 0}, from[3];
    int count = o->look_at ? read_numbers(o->look_at, at, 4) : 0;
    *out = (picture_aim){.view = o->view && strcmp(o->view, "auto") != 0 ? o->view : NULL,
                         .aimed = o->look_at, .placed = o->from};
    if (out->view && !find_view(out->view))
        return refuse(j, path, "the view is auto, bird, iso, top, front, back, left or right",
                      out->view);
    if (out->aimed && (count < 3 || (count == 4 && !(at[3] > 0))))
        return refuse(j, path, "what to look at is x,y,z or x,y,z,radius in metres", o->look_at);
    if (out->placed && read_numbers(o->from, from, 3) != 3)
        return refuse(j, path, "where to look from is x,y,z in metres", o->from);
    if (out->placed && out->view)
        return refuse(j, path, "a place to look from takes no view", out->view);
    out->target = vec3(at[0], at[1], at[2]);
    out->radius = count == 4 ? at[3] : 0;
    if (out->placed)
        out->from = vec3(from[0], from[1], from[2]);
    return true;
}

/* ---- which way ------------------------------------------------------------------------------- */

static void set_axes(picture_camera *c, double turn, double tilt)
{
    float sin_turn = (float)real_sin(turn), cos_turn = (float)real_cos(turn);
    float sin_down = (float)real_sin(tilt), cos_down = (float)real_cos(tilt);
    c->forward = vec_of(-sin_turn * cos_down, cos_turn * cos_down, -sin_down);
    c->right = vec_of(cos_turn, sin_turn, 0);
    c->up = vec_cross(c->right, c->forward);
}

/* By what the scene, or the part that is looked at, is like. */
static void choose_axes(picture_camera *c, vec low, vec high)
{
    vec size = vec_subtract(high, low);
    float wide = sqrtf(size.x * size.x + size.y * size.y), least = 1e-9f;
    float flat = clamp(wide / (wide + 2.5f * size.z + least), 0, 1);
    float town = (wide / (size.z + least) - TOWN_BEGINS) / (TOWN_ENDS - TOWN_BEGINS);
    double much = (double)clamp(town, 0, 1);
    double tilt = TILT_TALL + (TILT_FLAT - TILT_TALL) * (double)(flat * flat);
    set_axes(c, TURN * (1 - much), tilt + (TILT_TOWN - TILT_FLAT) * much);
    c->haze = TOWN_HAZE * (float)much;
}

/* ---- framing --------------------------------------------------------------------------------- */

/* The planes around the picture, through the eye, outward: left, right, bottom, top. */
typedef struct planes {
    vec side[4];
} planes;

/* How far what the camera looks at reaches: of its points p, the largest p . side. */
typedef struct limits {
    float side[4];
} limits;

/* Of how many points what share of the reach they have. */
enum { REACH_STEPS = 1024 };
typedef struct reaches {
    limits most;
    uint64_t all, count[4][REACH_STEPS + 1];
} reaches;

typedef void visit(reaches *r, const planes *n, vec p);

static void widen(reaches *r, const planes *n, vec p)
{
    for (int i = 0; i < 4; i++)
        r->most.side[i] = fmaxf(r->most.side[i], vec_dot(p, n->side[i]));
}

static void count(reaches *r, const planes *n, vec p)
{
    r->all++;
    for (int i = 0; i < 4; i++) {
        float share = vec_dot(p, n->side[i]) / r->most.side[i];
        r->count[i][(int)(clamp(share, 0, 1) * REACH_STEPS)]++;
    }
}

static void visit_places(reaches *r, const planes *n, visit *what, const float *place,
                         uint32_t places, vec about)
{
    for (uint32_t v = 0; v < places; v++) {
        const float *at = place + 3 * (size_t)v;
        what(r, n, vec_subtract(vec_of(at[0], at[1], at[2]), about));
    }
}

static void visit_scene(reaches *r, const planes *n, visit *what, const picture_scene *s, vec about)
{
    for (uint32_t i = 0; i < s->chunks.count; i++) {
        if (i % 256 == 255 && result_cancelled(s->job->run))
            return;
        visit_places(r, n, what, s->chunks.at[i].place, s->chunks.at[i].vertex_count, about);
    }
    visit_places(r, n, what, s->lines.vertices, s->lines.vertex_count, about);
    visit_places(r, n, what, s->points.vertices, s->points.vertex_count, about);
}

/* Without what stands far outside of all others, as a river that leaves a town. */
static void leave_out_few(reaches *r)
{
    for (int i = 0; i < 4; i++) {
        uint64_t beyond = 0;
        int step = REACH_STEPS;
        for (; step > 0; step--) {
            beyond += r->count[i][step];
            if (beyond * TOWN_LEAVES_OUT > r->all)
                break;
        }
        if (r->most.side[i] > 0)
            r->most.side[i] *= (float)(step + 1) / REACH_STEPS;
    }
}

/* Of a ball of some radius, or of the whole scene. */
static limits find_limits(const picture_camera *c, const picture_scene *s, const planes *n,
                          vec about, float radius)
{
    reaches *r = ARENA_NEW(&s->job->memory, reaches);
    for (int i = 0; i < 4; i++)
        r->most.side[i] = radius > 0 ? radius : s->empty ? s->radius : -FLT_MAX;
    if (radius > 0 || s->empty)
        return r->most;
    visit_scene(r, n, widen, s, about);
    if (c->haze > 0) {
        visit_scene(r, n, count, s, about);
        leave_out_few(r);
    }
    return r->most;
}

/* The eye that sees all points between two opposite planes, which meet in it: where it is along
 * the axis between them, and how far behind `about` it has to be. `slope` is the tangent of half
 * the angle. */
static void meet(float low, float high, float slope, float *along, float *behind)
{
    float secant = sqrtf(1 + slope * slope);
    /* low: the largest of -x - slope z; high: of x - slope z; both over the secant. */
    *along = (high - low) * secant / 2;
    *behind = (high + low) * secant / (2 * slope);
}

static void frame_perspective(picture_camera *c, const picture_scene *s, vec about, float radius)
{
    float smaller = (float)(c->width < c->height ? c->width : c->height);
    c->focal = smaller / (2 * (float)real_tan(FIELD / 2));
    float across = (1 - 2 * MARGIN) * c->middle_x / c->focal;
    float upward = (1 - 2 * MARGIN) * c->middle_y / c->focal;
    vec deep_x = vec_scale(c->forward, -across), deep_y = vec_scale(c->forward, -upward);
    planes n = {{vec_unit(vec_subtract(deep_x, c->right)), vec_unit(vec_add(deep_x, c->right)),
                 vec_unit(vec_subtract(deep_y, c->up)), vec_unit(vec_add(deep_y, c->up))}};
    limits l = find_limits(c, s, &n, about, radius);
    float x, y, behind_x, behind_y;
    meet(l.side[0], l.side[1], across, &x, &behind_x);
    meet(l.side[2], l.side[3], upward, &y, &behind_y);
    float behind = fmaxf(fmaxf(behind_x, behind_y), 0);
    behind += 0.02f * (radius > 0 ? radius : s->radius);
    c->eye = vec_add(about, vec_add(vec_scale(c->right, x), vec_scale(c->up, y)));
    c->eye = vec_subtract(c->eye, vec_scale(c->forward, behind));
}

/* The eye is before all of the scene. */
static void frame_parallel(picture_camera *c, const picture_scene *s, vec about, float radius)
{
    planes n = {{vec_scale(c->right, -1), c->right, vec_scale(c->up, -1), c->up}};
    limits l = find_limits(c, s, &n, about, radius);
    float wide = fmaxf(l.side[0] + l.side[1], 1e-3f * s->radius);
    float high = fmaxf(l.side[2] + l.side[3], 1e-3f * s->radius), share = 2 * (1 - 2 * MARGIN);
    c->focal = fminf(share * c->middle_x / wide, share * c->middle_y / high);
    c->eye = vec_add(about, vec_scale(c->right, (l.side[1] - l.side[0]) / 2));
    c->eye = vec_add(c->eye, vec_scale(c->up, (l.side[3] - l.side[2]) / 2));
    c->eye = vec_subtract(c->eye, vec_scale(c->forward, 4 * s->radius));
}

/* From a place to another one. */
static void stand(picture_camera *c, vec from, vec to, float radius)
{
    float smaller = (float)(c->width < c->height ? c->width : c->height);
    vec way = vec_subtract(to, from), level = vec_of(way.x, way.y, 0);
    float distance = sqrtf(vec_dot(way, way));
    c->forward = distance > 0 ? vec_unit(way) : vec_of(0, 1, 0);
    level = vec_unit(level);
    c->right = vec_dot(level, level) > 0 ? vec_of(level.y, -level.x, 0) : vec_of(1, 0, 0);
    c->up = vec_cross(c->right, c->forward);
    float slope = radius > 0 && distance > 0 ? radius / distance : 0;
    float most = (float)real_tan(FIELD_MOST / 2);
    if (!(slope > 0))
        slope = (float)real_tan(STANDING_FIELD / 2);
    c->focal = smaller / (2 * fminf(slope, most));
    c->eye = from;
}

/* ---- depths ---------------------------------------------------------------------------------- */

/* Between which the scene is; what stands nearer than a little before the eye is cut off. */
static void find_depths(picture_camera *c, const picture_scene *s, float distance)
{
    float least = FLT_MAX, most = -FLT_MAX;
    for (uint32_t i = 0; i < 8; i++) {
        float depth = picture_depth(c, vec_of(i & 1 ? s->high.x : s->low.x,
                                              i & 2 ? s->high.y : s->low.y,
                                              i & 4 ? s->high.z : s->low.z));
        least = fminf(least, depth);
        most = fmaxf(most, depth);
    }
    float slack = 1e-3f * s->radius + 1e-5f * fmaxf(fabsf(least), fabsf(most));
    least -= slack;
    most += slack;
    float close = fmaxf(NEAREST_SHARE * distance, FLT_MIN * 1e6f);
    c->nearest = c->parallel ? least : fmaxf(least, close);
    c->farthest = fmaxf(most, c->parallel ? most : 2 * c->nearest);
}

/* Positions turned to the camera's axes: v . p - v . eye, in double. */
static void set_row(double row[4], vec v, vec eye, double scale)
{
    const double axis[3] = {(double)v.x, (double)v.y, (double)v.z};
    const double at[3] = {(double)eye.x, (double)eye.y, (double)eye.z};
    row[3] = 0;
    for (int i = 0; i < 3; i++) {
        row[i] = axis[i] * scale;
        row[3] -= row[i] * at[i];
    }
}

static void set_projection(picture_camera *c)
{
    picture_projection *p = &c->projection;
    double near = (double)c->nearest, far = (double)c->farthest;
    *p = (picture_projection){.parallel = c->parallel, .nearest = near};
    p->middle_x = (double)c->middle_x * PICTURE_GRID;
    p->middle_y = (double)c->middle_y * PICTURE_GRID;
    set_row(p->across, c->right, c->eye, (double)c->focal * PICTURE_GRID);
    set_row(p->down, c->up, c->eye, -(double)c->focal * PICTURE_GRID);
    set_row(p->depth, c->forward, c->eye, 1);
    p->slope = c->parallel ? -1 / (far - near) : near * far / (far - near);
    p->base = c->parallel ? far / (far - near) : -near / (far - near);
}

static vec to_vec(pcg_vec3 p)
{
    return vec_of((float)p.x, (float)p.y, (float)p.z);
}

/* What is looked at: all of the scene, or a ball in it. */
static void frame_view(picture_camera *c, const picture_scene *s, const picture_aim *a, vec about,
                       float radius)
{
    const view *v = a->view ? find_view(a->view) : NULL;
    vec low = s->low, high = s->high, ball = vec_of(radius, radius, radius);
    if (radius > 0) {
        low = vec_most(low, vec_subtract(about, ball));
        high = vec_least(high, vec_add(about, ball));
    }
    if (v)
        set_axes(c, v->turn, v->tilt);
    else
        choose_axes(c, low, vec_most(low, high));
    c->parallel = v && v->parallel;
    c->haze = v && !v->parallel ? TOWN_HAZE : c->haze;
    if (c->parallel)
        frame_parallel(c, s, about, radius);
    else
        frame_perspective(c, s, about, radius);
}

void picture_frame(picture_camera *c, const picture_scene *s, const picture_aim *a,
                   uint32_t width, uint32_t height)
{
    vec about = vec_scale(vec_add(s->low, s->high), 0.5f);
    *c = (picture_camera){.width = width, .height = height};
    c->middle_x = (float)width / 2;
    c->middle_y = (float)height / 2;
    if (a->aimed)
        about = to_vec(vec3_subtract(a->target, s->center));
    float radius = (float)a->radius;
    if (a->aimed && !(radius > 0)) {
        vec away = vec_most(vec_subtract(s->high, about), vec_subtract(about, s->low));
        radius = fmaxf(sqrtf(vec_dot(away, away)), 1e-6f);
    }
    if (a->placed)
        stand(c, to_vec(vec3_subtract(a->from, s->center)), about, (float)a->radius);
    else
        frame_view(c, s, a, about, radius);
    vec way = vec_subtract(about, c->eye);
    float distance = sqrtf(vec_dot(way, way));
    find_depths(c, s, distance);
    c->gap = fminf(GAP_SHARE * s->radius, picture_pixel(c, distance));
    set_projection(c);
}

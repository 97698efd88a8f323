/* picture_shade.c - the colour of a fragment from its material and the light that it gathered. */
#include "stdlib/io/picture.h"

#define BOUNCE 0.30f         /* of the light on open ground: what comes back from it */

/* ---- the surface ----------------------------------------------------------------------------- */

typedef struct surface {
    vec color;
    float metallic, roughness;
} surface;

/* Where the ray through a neighbouring pixel meets the fragment's plane. */
static vec neighbour(const picture_camera *c, const picture_fragment *f, float dx, float dy)
{
    vec origin, ray = picture_ray(c, f->at_x + dx, f->at_y + dy, &origin);
    float slope = vec_dot(ray, f->flat), depth = picture_depth(c, f->place);
    vec to = vec_subtract(f->place, origin);
    float away = fabsf(slope) > 1e-6f ? vec_dot(to, f->flat) / slope : depth;
    return vec_add(origin, vec_scale(ray, clamp(away, depth / 4, depth * 4)));
}

static vec texture_color(const picture_scene *s, const picture_camera *c, const picture_fragment *f,
                         const picture_texture *t)
{
    float uv[2], du[2], dv[2], alpha;
    if (!picture_uv(s, f->triangle, f->place, uv))
        return vec_of(1, 1, 1);
    picture_uv(s, f->triangle, neighbour(c, f, 1, 0), du);
    picture_uv(s, f->triangle, neighbour(c, f, 0, 1), dv);
    for (int i = 0; i < 2; i++) {
        du[i] -= uv[i];
        dv[i] -= uv[i];
    }
    return picture_texture_sample(t, uv, du, dv, &alpha);
}

static surface find_surface(const picture_scene *s, const picture_camera *c,
                            const picture_fragment *f)
{
    const picture_material *m = picture_material_of(s, f->triangle);
    surface out = {m->color, m->metallic, m->roughness};
    if (m->texture)
        out.color = vec_multiply(out.color, texture_color(s, c, f, m->texture));
    return out;
}

/* ---- light ----------------------------------------------------------------------------------- */

static float fifth_power(float x)
{
    return x * x * x * x * x;
}

/* What a mirror would show, as far as the surface is smooth; corners see little of the sky. */
static vec reflection(const surface *m, const picture_fragment *f, vec view)
{
    float facing = clamp(vec_dot(f->normal, view), 0, 1), smooth = 1 - m->roughness;
    vec mirror = vec_subtract(vec_scale(f->normal, 2 * vec_dot(f->normal, view)), view);
    vec base = vec_mix(vec_of(0.04f, 0.04f, 0.04f), m->color, m->metallic);
    vec grazing = vec_of(smooth, smooth, smooth);
    grazing = vec_of(fmaxf(grazing.x, base.x), fmaxf(grazing.y, base.y), fmaxf(grazing.z, base.z));
    vec share = vec_mix(base, grazing, fifth_power(1 - facing));
    float keep = 0.15f + 0.85f * smooth * smooth + 0.6f * m->metallic * m->roughness;
    float seen = clamp(0.25f + f->open, 0, 1);
    return vec_scale(vec_multiply(picture_sky(mirror), share), keep * seen);
}

/* The sun in it. Method: the distribution of Trowbridge and Reitz. */
static vec highlight(const picture_day *day, const surface *m, const picture_fragment *f, vec view)
{
    vec half = vec_unit(vec_add(view, day->sun));
    float wide = clamp(m->roughness * m->roughness, 0.01f, 1), facing = vec_dot(f->normal, half);
    if (!(facing > 0) || !(f->sun > 0))
        return vec_of(0, 0, 0);
    float below = facing * facing * (wide * wide - 1) + 1;
    float amount = clamp(wide * wide / (below * below) * 0.25f, 0, 8) * f->sun;
    vec base = vec_mix(vec_of(0.04f, 0.04f, 0.04f), m->color, m->metallic);
    return vec_scale(vec_multiply(base, day->sun_color), amount);
}

vec picture_shade(const picture_scene *s, const picture_camera *c, const picture_fragment *f)
{
    surface m = find_surface(s, c, f);
    vec view = picture_view(c, f->place);
    vec light = vec_add(picture_sky_light(f->open, f->above), vec_scale(s->day.sun_color, f->sun));
    float down = 0.5f * (1 - f->normal.z), seen = clamp(0.35f + f->open, 0, 1);
    vec warm = vec_multiply(s->day.open, vec_of(1.03f, 1, 0.95f));
    light = vec_add(light, vec_scale(warm, BOUNCE * down * seen));
    vec diffuse = vec_scale(vec_multiply(m.color, light), 1 - m.metallic);
    return vec_add(diffuse, vec_add(reflection(&m, f, view), highlight(&s->day, &m, f, view)));
}

vec picture_backdrop(const picture_camera *c, float x, float y)
{
    static const vec top = {0.62f, 0.71f, 0.80f}, bottom = {0.86f, 0.86f, 0.85f};
    float down = y / (float)c->height, aside = (x - c->middle_x) / (float)c->width;
    vec color = vec_mix(top, bottom, clamp(down * 1.25f, 0, 1));
    return vec_scale(color, 1 - 0.25f * aside * aside);
}

float picture_haze(const picture_camera *c, float depth)
{
    float along = (depth - c->nearest) / (c->farthest - c->nearest);
    return c->haze * clamp(along, 0, 1);
}

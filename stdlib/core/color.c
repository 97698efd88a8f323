/*pcg
/// A colour from red, green and blue, each 0 to 1.
function rgb(red: ratio, green: ratio, blue: ratio) -> color [pure] {
    example rgb(1, 0.5, 0).g == 0.5
}
/// A colour from red, green, blue and opacity, each 0 to 1.
function rgb(red: ratio, green: ratio, blue: ratio, opacity: ratio) -> color [pure] {
    example rgb(1, 0, 0, 0.5).a == 0.5
}
/// A colour from hue (0 is red, 120 green, 240 blue), saturation and brightness, the last two 0 to 1.
function hsv(hue: angle, saturation: ratio, brightness: ratio) -> color [pure] {
    example hsv(120deg, 1, 1).g == 1 && hsv(120deg, 1, 1).r == 0
    example hsv(-60deg, 1, 0.5).b == 0.5
}
/// The colour on the way from `a` (at t = 0) to `b` (at t = 1); `t` is kept between them.
function mix(a: color, b: color, t: ratio) -> color [pure] {
    example mix(rgb(0, 0, 0), rgb(1, 1, 1), 0.25).r == 0.25
}
/// The colour, nearer to white by a share of the way.
function lighten(c: color, by: ratio) -> color [pure] {
    example lighten(rgb(0, 0.5, 1), 50%).g == 0.75
}
/// The colour, nearer to black by a share of the way.
function darken(c: color, by: ratio) -> color [pure] {
    example darken(rgb(0, 0.5, 1), 50%).g == 0.25
}
/// The grey that is as bright as the colour.
function grey(c: color) -> color [pure] { example grey(rgb(1, 1, 1)).b > 0.999 }
/// The colour with another opacity, 0 to 1.
function with_opacity(c: color, opacity: ratio) -> color [pure] {
    example with_opacity(rgb(1, 0, 0), 0.5).a == 0.5
}
/// The colour that a string holds, such as #ff8800; black, with a warning, where it holds none.
function color(s: string) -> color [pure] { example color("#ff0000").r == 1.0 }
/// A colour's hue, 0 to 360 degrees: red 0, green 120, blue 240; 0 for greys.
function hue(c: color) -> angle [pure] { example hue(#0000ff) == 240deg }
/// How strong a colour is, from 0 for greys to 1.
function saturation(c: color) -> ratio [pure] { example saturation(#ff0000) == 1 }
/// How bright a colour is, from 0 for black to 1.
function brightness(c: color) -> ratio [pure] { example brightness(#ff8800) == 1 }
*/
#include "color.h"
#include <math.h>
#include "runtime/value.h"

/* Every function gives channels from 0 to 1, whatever it was given. */
static double color_channel(double value)
{
    return value > 0 ? (value < 1 ? value : 1) : 0;
}

static pcg_color color_of(double r, double g, double b, double a)
{
    return (pcg_color){color_channel(r), color_channel(g), color_channel(b), color_channel(a)};
}

void pcg_core_fn_rgb_ratio_ratio_ratio(pcg_call *call, double red, double green, double blue,
                                       pcg_color *result)
{
    (void)call;
    *result = color_of(red, green, blue, 1);
}

void pcg_core_fn_rgb_ratio_ratio_ratio_ratio(pcg_call *call, double red, double green,
                                             double blue, double opacity, pcg_color *result)
{
    (void)call;
    *result = color_of(red, green, blue, opacity);
}

/* One channel: full within 60 degrees of its own hue, none beyond 120, and in between in proportion. */
static double color_of_hue(double hue, double own, double saturation, double brightness)
{
    double away = fabs(fmod(hue - own + 540, 360) - 180);
    double share = color_channel(2 - away / 60);
    return brightness * (1 - saturation * (1 - share));
}

void pcg_core_fn_hsv_angle_ratio_ratio(pcg_call *call, double hue, double saturation,
                                       double brightness, pcg_color *result)
{
    (void)call;
    double turn = isfinite(hue) ? fmod(hue, 360) : 0;
    double full = turn < 0 ? turn + 360 : turn;
    double strong = color_channel(saturation), bright = color_channel(brightness);
    *result = color_of(color_of_hue(full, 0, strong, bright), color_of_hue(full, 120, strong, bright),
                       color_of_hue(full, 240, strong, bright), 1);
}

static pcg_color color_between(const pcg_color *a, const pcg_color *b, double t)
{
    double way = color_channel(t);
    return color_of(a->r + (b->r - a->r) * way, a->g + (b->g - a->g) * way,
                    a->b + (b->b - a->b) * way, a->a + (b->a - a->a) * way);
}

void pcg_core_fn_mix_color_color_ratio(pcg_call *call, const pcg_color *a, const pcg_color *b,
                                       double t, pcg_color *result)
{
    (void)call;
    *result = color_between(a, b, t);
}

void pcg_core_fn_lighten_color_ratio(pcg_call *call, const pcg_color *c, double by,
                                     pcg_color *result)
{
    (void)call;
    pcg_color white = {1, 1, 1, c->a};
    *result = color_between(c, &white, by);
}

void pcg_core_fn_darken_color_ratio(pcg_call *call, const pcg_color *c, double by,
                                    pcg_color *result)
{
    (void)call;
    pcg_color black = {0, 0, 0, c->a};
    *result = color_between(c, &black, by);
}

void pcg_core_fn_grey_color(pcg_call *call, const pcg_color *c, pcg_color *result)
{
    (void)call;
    double bright = 0.2126 * c->r + 0.7152 * c->g + 0.0722 * c->b; /* Rec. 709; the weights sum to 1 */
    *result = color_of(bright, bright, bright, c->a);
}

void pcg_core_fn_with_opacity_color_ratio(pcg_call *call, const pcg_color *c, double opacity,
                                          pcg_color *result)
{
    (void)call;
    *result = color_of(c->r, c->g, c->b, opacity);
}

/* ---- from text, and what a colour is made of ---------------------------------------------------- */

void pcg_core_fn_color_string(pcg_call *call, const char *s, pcg_color *result)
{
    const value_type t = {.kind = PCG_COLOR};
    char why[VALUE_WHY_BYTES];
    pcg_cell cells[4] = {{.f = 0}, {.f = 0}, {.f = 0}, {.f = 1}};
    if (!value_read(call->run, &t, s, cells, why)) {
        pcg_warn(call, "\"%s\" is no colour: black stands for it", s);
    }
    *result = (pcg_color){cells[0].f, cells[1].f, cells[2].f, cells[3].f};
}

typedef struct color_levels {
    double high, low;
} color_levels;

static color_levels color_levels_of(const pcg_color *c)
{
    return (color_levels){fmax(fmax(c->r, c->g), c->b), fmin(fmin(c->r, c->g), c->b)};
}

double pcg_core_fn_hue_color(pcg_call *call, const pcg_color *c)
{
    color_levels l = color_levels_of(c);
    double range = l.high - l.low;
    (void)call;
    if (!(range > 0)) {
        return 0;
    }
    double sixth = l.high == c->r   ? (c->g - c->b) / range
                   : l.high == c->g ? 2 + (c->b - c->r) / range
                                    : 4 + (c->r - c->g) / range;
    return sixth < 0 ? 60 * sixth + 360 : 60 * sixth;
}

double pcg_core_fn_saturation_color(pcg_call *call, const pcg_color *c)
{
    color_levels l = color_levels_of(c);
    (void)call;
    return l.high > 0 ? (l.high - l.low) / l.high : 0;
}

double pcg_core_fn_brightness_color(pcg_call *call, const pcg_color *c)
{
    (void)call;
    return color_levels_of(c).high;
}

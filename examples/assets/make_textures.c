/* make_textures.c - draws the textures of the examples, from nothing but numbers.
 *
 *     cc -O2 -o make_textures make_textures.c -ljpeg -lm && ./make_textures .
 *
 * Each texture is a function from a place in the unit square (u to the right, v up) to a colour. Those that
 * cover walls, roofs and ground repeat seamlessly: every pattern in them has a whole number of periods. The pictures
 * are kept beside this file; it is run again only to change them.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <jpeglib.h>

/* ---- colours ------------------------------------------------------------------------------------- */

typedef struct color {
    double r, g, b;
} color;

static color rgb(unsigned hex)
{
    return (color){(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* 0 at low, 1 at high, smooth in between. */
static double step(double low, double high, double x)
{
    double t = clamp((x - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}

static color mix(color a, color b, double t)
{
    return (color){a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

static color shade(color c, double factor)
{
    return (color){c.r * factor, c.g * factor, c.b * factor};
}

/* ---- noise that repeats ---------------------------------------------------------------------------- */

static unsigned hash(unsigned x, unsigned y, unsigned seed)
{
    unsigned h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return h ^ h >> 15;
}

static int wrap(int x, int period)
{
    int rest = x % period;
    return rest < 0 ? rest + period : rest;
}

/* 0 to 1, the same for cells a period apart. */
static double cell_random(int x, int y, int period_x, int period_y, unsigned seed)
{
    return hash((unsigned)wrap(x, period_x), (unsigned)wrap(y, period_y), seed) / 4294967296.0;
}

/* -1 to 1, over a lattice of whole numbers. */
static double noise(double x, double y, int period_x, int period_y, unsigned seed)
{
    int left = (int)floor(x), low = (int)floor(y);
    double tx = step(0, 1, x - left), ty = step(0, 1, y - low);
    double a = cell_random(left, low, period_x, period_y, seed);
    double b = cell_random(left + 1, low, period_x, period_y, seed);
    double c = cell_random(left, low + 1, period_x, period_y, seed);
    double d = cell_random(left + 1, low + 1, period_x, period_y, seed);
    return 2 * (a + (b - a) * tx + (c - a + (a - b - c + d) * tx) * ty) - 1;
}

/* Octaves of noise over the unit square, the first with nx by ny cells. */
static double rough(double u, double v, int nx, int ny, int octaves, unsigned seed)
{
    double sum = 0, weight = 0.5;
    for (int i = 0; i < octaves; i++, nx *= 2, ny *= 2, weight *= 0.5) {
        sum += weight * noise(u * nx, v * ny, nx, ny, seed + (unsigned)i);
    }
    return sum;
}

/* The nearest of nx by ny scattered points: how far it is from the border to the next nearest one's area,
 * in cells, and a number that is the point's own. */
typedef struct pebble {
    double border, own;
} pebble;

static pebble nearest_pebble(double u, double v, int nx, int ny, double scatter, unsigned seed)
{
    int column = (int)floor(u * nx), row = (int)floor(v * ny);
    double first = 9, second = 9, own = 0;
    for (int y = row - 2; y <= row + 2; y++) {
        for (int x = column - 2; x <= column + 2; x++) {
            double shift = y & 1 ? 0.5 : 0;
            double at_x = x + shift + 0.5 + scatter * (cell_random(x, y, nx, ny, seed) - 0.5);
            double at_y = y + 0.5 + scatter * (cell_random(x, y, nx, ny, seed + 1) - 0.5);
            double far = hypot(u * nx - at_x, v * ny - at_y);
            if (far < first) {
                second = first;
                first = far;
                own = cell_random(x, y, nx, ny, seed + 2);
            } else if (far < second) {
                second = far;
            }
        }
    }
    return (pebble){second - first, own};
}

/* ---- bricks, slates and other courses -------------------------------------------------------------- */

/* A place in courses of `columns` pieces, every other one shifted by half a piece. */
typedef struct piece {
    int column, row;
    double x, y; /* 0 … 1 within it */
} piece;

static piece find_piece(double u, double v, int columns, int rows)
{
    piece p;
    p.row = (int)floor(v * rows);
    double x = u * columns + (p.row & 1 ? 0.5 : 0);
    p.column = (int)floor(x);
    p.x = x - p.column;
    p.y = v * rows - p.row;
    return p;
}

static double piece_random(const piece *p, int columns, int rows, unsigned seed)
{
    return cell_random(p->column, p->row, columns, rows, seed);
}

/* How far from the edge of a piece that is `wide` times as wide as high, in heights. */
static double piece_edge(const piece *p, double wide)
{
    double x = (p->x < 0.5 ? p->x : 1 - p->x) * wide;
    double y = p->y < 0.5 ? p->y : 1 - p->y;
    return x < y ? x : y;
}

static color brickwork(double u, double v, color dark, color light, color mortar, unsigned seed)
{
    enum { COLUMNS = 6, ROWS = 18 };
    piece p = find_piece(u, v, COLUMNS, ROWS);
    double grain = rough(u, v, 40, 40, 4, seed);
    double edge = piece_edge(&p, 3) + 0.05 * rough(u, v, 48, 48, 2, seed + 20);
    double own = piece_random(&p, COLUMNS, ROWS, seed + 10);
    color clay = shade(mix(dark, light, own), 1 + 0.22 * grain);
    double relief = step(0.08, 0.2, edge);
    double lit = 1 + 0.1 * (p.y - 0.5) * (1 - step(0.1, 0.4, edge));
    color joint = shade(mortar, 0.88 + 0.18 * grain);
    return mix(joint, shade(clay, lit * (0.85 + 0.15 * relief)), relief);
}

static color brick(double u, double v)
{
    return brickwork(u, v, rgb(0x8c4230), rgb(0xb9674a), rgb(0xb9ae9f), 1);
}

static color brick_yellow(double u, double v)
{
    return brickwork(u, v, rgb(0xb08d58), rgb(0xd8bd86), rgb(0xa89d8c), 2);
}

static color plasterwork(double u, double v, color base, unsigned seed)
{
    double wide = rough(u, v, 4, 4, 3, seed), fine = rough(u, v, 64, 64, 3, seed + 9);
    double strokes = rough(u, v, 8, 40, 2, seed + 17);
    return shade(base, 0.97 + 0.05 * wide + 0.07 * fine + 0.03 * strokes);
}

static color plaster(double u, double v)
{
    return plasterwork(u, v, rgb(0xe6dcc8), 3);
}

static color plaster_ochre(double u, double v)
{
    return plasterwork(u, v, rgb(0xd9a866), 4);
}

static color stone(double u, double v)
{
    double bend = 0.012 * rough(u, v, 10, 10, 2, 60), drift = 0.012 * rough(u, v, 10, 10, 2, 70);
    pebble p = nearest_pebble(u + bend, v + drift, 6, 10, 0.75, 5);
    color body = mix(rgb(0x8f8a7e), rgb(0xb9ad97), p.own);
    double grain = rough(u, v, 32, 32, 4, 6);
    double solid = step(0.06, 0.16, p.border);
    return mix(shade(rgb(0x6d675d), 1 + 0.25 * grain),
               shade(body, 0.9 + 0.13 * step(0.1, 0.5, p.border) + 0.3 * grain), solid);
}

/* ---- roofs: rows that cover each other, seen from above; down is where v is small -------------------- */

static color tilework(double u, double v, color dark, color light, unsigned seed)
{
    enum { COLUMNS = 8, ROWS = 8 };
    double x = u * COLUMNS;
    int column = (int)floor(x);
    double across = x - column;
    double pipe = sin(3.14159265358979 * across); /* each tile is half a pipe, whose lower end is round */
    double sag = 0.06 * (cell_random(column, 0, COLUMNS, 1, seed + 1) - 0.5);
    double y = v * ROWS + sag + 0.22 * pipe;
    int row = (int)floor(y);
    double own = cell_random(column, row, COLUMNS, ROWS, seed + 2);
    double up = y - row, wave = 0.7 + 0.36 * pipe;
    double gap = step(0, 0.06, across) * step(0, 0.06, 1 - across);
    double lip = step(0, 0.05, up), shadow = 0.55 + 0.45 * step(0, 0.35, 1 - up);
    double weather = 1 + 0.16 * rough(u, v, 16, 16, 4, seed + 3);
    return shade(mix(dark, light, own), wave * weather * shadow * (0.45 + 0.55 * gap) * (0.7 + 0.3 * lip));
}

static color tiles(double u, double v)
{
    return tilework(u, v, rgb(0x9c4b34), rgb(0xc27a57), 11);
}

static color tiles_brown(double u, double v)
{
    return tilework(u, v, rgb(0x6b4433), rgb(0x93654c), 12);
}

static color slatework(double u, double v, int columns, int rows, color dark, color light,
                       double streaks, unsigned seed)
{
    piece p = find_piece(u, v, columns, rows);
    double own = piece_random(&p, columns, rows, seed);
    double side = p.x < 0.5 ? p.x : 1 - p.x;
    double gap = step(0.01, 0.05, side), lip = step(0, 0.07, p.y);
    double covered = 0.62 + 0.38 * step(0, 0.3, 1 - p.y);
    double grain = rough(u, v, 48, 16, 3, seed + 4);
    double lines = rough(u, v, columns * 8, 4, 2, seed + 5);
    color body = mix(dark, light, own);
    return shade(body, (1 + 0.14 * grain + streaks * lines) * covered * (0.4 + 0.6 * gap) * (0.55 + 0.45 * lip));
}

static color slate(double u, double v)
{
    return slatework(u, v, 8, 12, rgb(0x4e5a66), rgb(0x76828c), 0.05, 13);
}

static color shingles(double u, double v)
{
    return slatework(u, v, 14, 8, rgb(0x75624c), rgb(0xa58f70), 0.3, 14);
}

/* ---- windows and doors: one picture each --------------------------------------------------------------- */

static color curtains(double u, double v)
{
    double glow = 0.5 + 0.5 * v + 0.1 * rough(u, v, 3, 3, 2, 20);
    color room = mix(rgb(0x232b33), rgb(0x4c5a66), glow * 0.8);
    double side = u < 0.5 ? u : 1 - u;
    double hem = 0.27 + 0.1 * (v - 0.35) * (v - 0.35) * 4; /* drawn aside in the middle of its height */
    double fold = sin(side / hem * 31 + 2.2 * rough(u, v * 0.5, 8, 2, 2, 21));
    color cloth = shade(rgb(0xf0e6d2), 0.8 + 0.14 * fold + 0.04 * rough(u, v, 96, 96, 1, 22));
    double rail = step(0.955, 0.965, v);
    color hung = mix(cloth, room, step(hem - 0.012, hem + 0.004, side));
    return mix(hung, rgb(0x5a4733), rail);
}

static double wood_grain(double u, double v, int across, unsigned seed)
{
    double warp = 0.02 * rough(u, v, 3, 2, 2, seed);
    double rings = sin(6.2831853 * ((u + warp) * across + 1.5 * rough(u, v, 4, 1, 2, seed + 3)));
    return 0.55 * rings + 1.2 * rough(u, v, across * 6, 3, 3, seed + 6);
}

static color wood_fine(double u, double v)
{
    return shade(mix(rgb(0x9a6b42), rgb(0xc4935f), 0.5 + 0.35 * wood_grain(u, v, 6, 30)),
                 1 + 0.04 * rough(u, v, 64, 64, 2, 31));
}

/* 1 inside of a rectangle, falling to 0 within `soft` outside of it. */
static double inside(double u, double v, double left, double low, double right, double high, double soft)
{
    double x = fmax(left - u, u - right), y = fmax(low - v, v - high) * 2; /* the door is 1 by 2 */
    return 1 - step(0, soft, fmax(x, y));
}

static color door_wood(double u, double v)
{
    color body = mix(rgb(0xb9ac9b), rgb(0xf4ece0), 0.5 + 0.3 * wood_grain(u, v, 7, 40)); /* light: doors tint it */
    const double panels[4][2] = {{0.12, 0.07}, {0.56, 0.07}, {0.12, 0.52}, {0.56, 0.52}};
    double light = 1;
    for (int i = 0; i < 4; i++) {
        double left = panels[i][0], low = panels[i][1], high = low + (low < 0.5 ? 0.38 : 0.41);
        double groove = inside(u, v, left, low, left + 0.32, high, 0.01) -
                        inside(u, v, left + 0.03, low + 0.015, left + 0.29, high - 0.015, 0.012);
        light *= 1 - (0.26 + 0.26 * step(low, high, v)) * clamp(groove, 0, 1); /* lit from above */
    }
    double frame = fmin(fmin(u, 1 - u), 2 * fmin(v, 1 - v));
    light *= 0.65 + 0.35 * step(0.005, 0.03, frame);
    color lit = shade(body, light);
    double knob = hypot(u - 0.93, (v - 0.475) * 2);
    color brass = shade(rgb(0xd8b765), 1.1 - 6 * hypot(u - 0.92, (v - 0.48) * 2));
    return mix(brass, lit, step(0.026, 0.032, knob));
}

/* ---- ground ---------------------------------------------------------------------------------------------- */

static color grass(double u, double v)
{
    double wide = rough(u, v, 5, 5, 3, 50), fine = rough(u, v, 90, 60, 3, 51);
    color base = mix(rgb(0x4f7a32), rgb(0x7fa04a), 0.5 + 0.8 * wide);
    return shade(base, 1 + 0.5 * fine);
}

static color cobble(double u, double v)
{
    pebble p = nearest_pebble(u, v, 8, 8, 0.3, 54);
    color body = mix(rgb(0x77736c), rgb(0xa39b8f), p.own);
    double grain = rough(u, v, 32, 32, 4, 55);
    double solid = step(0.08, 0.2, p.border), round = 0.72 + 0.4 * step(0.05, 0.75, p.border);
    return mix(shade(rgb(0x4a463f), 1 + 0.3 * grain), shade(body, round * (1 + 0.2 * grain)), solid);
}

/* A lane each way along u, with a broken line between them. */
static color roads(double u, double v)
{
    double fine = rough(u, v, 110, 110, 2, 58), wide = rough(u, v, 4, 4, 3, 59);
    double tracks = 0.05 * (cos(4 * 6.2831853 * v) - 1);
    color asphalt = shade(rgb(0x5c5d60), 1 + 0.35 * fine + 0.12 * wide + tracks);
    double line = (1 - step(0.012, 0.016, fabs(v - 0.5))) *
                  (1 - step(0.248, 0.25, fabs(u - 0.5)));
    return mix(asphalt, shade(rgb(0xdad7cd), 1 + 0.4 * fine), line * 0.85);
}

/* ---- files ------------------------------------------------------------------------------------------------ */

typedef struct texture {
    const char *path;
    int width, height, quality;
    color (*paint)(double u, double v);
} texture;

static const texture textures[] = {
    {"roofs/tiles.jpg", 384, 384, 78, tiles},
    {"roofs/tiles_brown.jpg", 384, 384, 78, tiles_brown},
    {"roofs/slate.jpg", 384, 384, 78, slate},
    {"roofs/shingles.jpg", 384, 384, 78, shingles},
    {"walls/brick.jpg", 512, 512, 76, brick},
    {"walls/brick_yellow.jpg", 512, 512, 76, brick_yellow},
    {"walls/plaster.jpg", 256, 256, 80, plaster},
    {"walls/plaster_ochre.jpg", 256, 256, 80, plaster_ochre},
    {"walls/stone.jpg", 384, 384, 76, stone},
    {"housing/curtains.jpg", 256, 256, 84, curtains},
    {"housing/wood_fine.jpg", 256, 256, 80, wood_fine},
    {"housing/door_wood.jpg", 256, 512, 84, door_wood},
    {"ground/grass.jpg", 320, 320, 70, grass},
    {"ground/cobble.jpg", 320, 320, 74, cobble},
    {"ground/roads.jpg", 320, 320, 72, roads},
};

static unsigned char to_byte(double level)
{
    return (unsigned char)(clamp(level, 0, 1) * 255 + 0.5);
}

/* One line of the picture, from the top; each pixel is the mean of four places in it. */
static void paint_line(const texture *t, int line, unsigned char *pixels)
{
    for (int x = 0; x < t->width; x++) {
        color sum = {0, 0, 0};
        for (int i = 0; i < 4; i++) {
            double u = (x + 0.25 + 0.5 * (i & 1)) / t->width;
            double v = 1 - (line + 0.25 + 0.5 * (i >> 1)) / t->height;
            color c = t->paint(u, v);
            sum = (color){sum.r + c.r / 4, sum.g + c.g / 4, sum.b + c.b / 4};
        }
        pixels[3 * x] = to_byte(sum.r);
        pixels[3 * x + 1] = to_byte(sum.g);
        pixels[3 * x + 2] = to_byte(sum.b);
    }
}

static int write_texture(const texture *t, const char *folder)
{
    char path[1024];
    unsigned char pixels[3 * 512];
    snprintf(path, sizeof path, "%s/%s", folder, t->path);
    FILE *out = fopen(path, "wb");
    if (!out) {
        perror(path);
        return 1;
    }
    struct jpeg_error_mgr errors;
    struct jpeg_compress_struct jpeg = {.err = jpeg_std_error(&errors)};
    jpeg_create_compress(&jpeg);
    jpeg_stdio_dest(&jpeg, out);
    jpeg.image_width = (JDIMENSION)t->width;
    jpeg.image_height = (JDIMENSION)t->height;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, t->quality, TRUE);
    jpeg.optimize_coding = TRUE;
    jpeg_start_compress(&jpeg, TRUE);
    for (int line = 0; line < t->height; line++) {
        unsigned char *row = pixels;
        paint_line(t, line, pixels);
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return fclose(out) != 0;
}

int main(int argc, char **argv)
{
    static const char *const folders[] = {"roofs", "walls", "housing", "ground"};
    const char *folder = argc > 1 ? argv[1] : ".";
    int failed = 0;
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, folders[i]);
        mkdir(path, 0777); /* may be there; a file that cannot be written says so */
    }
    for (size_t i = 0; i < sizeof textures / sizeof textures[0]; i++) {
        failed |= write_texture(&textures[i], folder);
    }
    return failed;
}

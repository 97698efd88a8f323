/* outlines.h - polygons that tests are tried on: written by hand, and by chance. One is built at a
 * time, in the arrays below. */
#ifndef TESTS_OUTLINES_H
#define TESTS_OUTLINES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "runtime/shape.h"

/* ---- chance ---------------------------------------------------------------------------------- */

static uint64_t chance_state = 88172645463325252u;

static inline uint64_t chance(void)
{
    chance_state ^= chance_state << 13;
    chance_state ^= chance_state >> 7;
    chance_state ^= chance_state << 17;
    return chance_state * 2685821657736338717u;
}

static inline uint32_t below(uint32_t n)
{
    return (uint32_t)((chance() >> 33) % n);
}

static inline double share(void)
{
    return (double)(chance() >> 11) / 9007199254740992.0;
}

/* ---- polygons -------------------------------------------------------------------------------- */

enum { MAX_CORNERS = 400000, MAX_LOOPS = 40000 };

/* The polygon under construction: an outline, then its holes. */
static pcg_vec3 position[MAX_CORNERS];
static uint32_t corner_vertex[MAX_CORNERS], loop_corner[MAX_LOOPS];
static uint32_t corners, loops;

static inline void begin(void)
{
    corners = loops = 0;
}

static inline void corner(double x, double y)
{
    position[corners] = vec3(x, y, 0);
    corner_vertex[corners] = corners;
    corners++;
}

static inline void end_loop(void)
{
    loop_corner[++loops] = corners;
}

/* ---- families -------------------------------------------------------------------------------- */

/* Corners around a place, at distances by chance; it turns left, or right. */
static inline void star(uint32_t n, double x, double y, double low, double high, bool left)
{
    for (uint32_t i = 0; i < n; i++) {
        double a = (left ? 1 : -1) * 6.283185307179586 * i / n, r = low + (high - low) * share();

        corner(x + r * cos(a), y + r * sin(a));
    }
    end_loop();
}

/* Cells of a board that hang together, traced: the outline and holes touch themselves and each
 * other in corners. */
enum { BOARD = 24 };
static bool board[BOARD][BOARD];
static bool seen[BOARD + 1][BOARD + 1][4];

static inline bool filled(int x, int y)
{
    return x >= 0 && y >= 0 && x < BOARD && y < BOARD && board[y][x];
}

/* Fills the board with one piece that grows from its middle. */
static inline void grow_piece(uint32_t cells)
{
    memset(board, 0, sizeof board);
    board[BOARD / 2][BOARD / 2] = true;
    for (uint32_t i = 0; i < cells * 20 && cells > 0; i++) {
        int x = (int)below(BOARD), y = (int)below(BOARD);

        if (!board[y][x] &&
            (filled(x - 1, y) || filled(x + 1, y) || filled(x, y - 1) || filled(x, y + 1))) {
            board[y][x] = true;
            cells--;
        }
    }
}

/* Follows the border from the point (x, y) in direction d, cells on its left; at a touching corner
 * it turns left, so that loops touch rather than cross. */
static inline void trace(int x, int y, int d, bool keep_flat)
{
    static const int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
    /* The cells to the left and right of a step in direction d from a point, relative to it. */
    static const int lx[] = {0, -1, -1, 0}, ly[] = {0, 0, -1, -1};
    int sx = x, sy = y, sd = d, next;

    do {
        seen[y][x][d] = true;
        x += dx[d], y += dy[d];
        next = (d + 1) % 4;
        if (!(filled(x + lx[next], y + ly[next]) && !filled(x + lx[d], y + ly[d]))) {
            int right = (d + 3) % 4;

            next = filled(x + lx[d], y + ly[d]) ? d : next;
            if (filled(x + lx[d], y + ly[d]) && filled(x + lx[right], y + ly[right]))
                next = right;
        }
        if (keep_flat || next != d)
            corner(x, y);
        d = next;
    } while (x != sx || y != sy || d != sd);
    end_loop();
}

static inline bool starts_border(int x, int y)
{
    return filled(x, y) && !filled(x, y - 1) && !seen[y][x][0];
}

/* All loops of the piece, the outline (which is met first, at the lowest row) before the holes. */
static inline void trace_piece(bool keep_flat)
{
    memset(seen, 0, sizeof seen);
    begin();
    for (int y = 0; y < BOARD; y++)
        for (int x = 0; x < BOARD; x++)
            if (starts_border(x, y))
                trace(x, y, 0, keep_flat);
}

/* Slants all of it, so that nothing is level any more. */
static inline void shear(void)
{
    double a = share(), b = share();

    for (uint32_t i = 0; i < corners; i++)
        position[i] = vec3(position[i].x + a * position[i].y, position[i].y + b * position[i].x, 0);
}

#endif

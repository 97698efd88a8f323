/* limit.c - how fast facade_city.pcg could be at best: the same city by loops in C.
 *
 * One thread fills flat arrays of corners (position and normal) and of triangles, and writes them
 * as one GLB. There is no graph, no mesh, no entity: whatever makes the city of parts can come
 * near to this and not below. The parts that are measured: "fill", all of it in fresh memory;
 * "refill", the same memory again; "stream", filled a few lots at a time, in buffers that stay in
 * the cache, and written block by block.
 *
 *     limit LOTS FILE.glb
 */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "rival.h"

enum {
    FLOORS = 5,
    LOT_TILES = 20 * FLOORS,       /* 4, 6, 4 and 6 a floor */
    LOT_QUADS = 9 * LOT_TILES + 1, /* a tile: 4 of the frame, 4 of the reveal, the pane */
    LOT_CORNERS = 4 * LOT_QUADS,
    LOT_INDICES = 6 * LOT_QUADS,
    BLOCK_LOTS = 10, /* about a MiB of corners */
    HEAD = 1024      /* bytes of the GLB before the arrays */
};

static const float width = 10, depth = 15, height = 15, storey = 3, bay = 2.5f, inset = 0.5f,
                   recess = 0.2f;
static const uint64_t most_lots = 24000; /* more would not fit into a GLB's 4 GiB */

/* glTF has y up. */
typedef struct point {
    float x, y, z;
} point;

typedef struct corner {
    point at, normal;
} corner;

typedef struct arrays {
    corner *corners;
    uint32_t *indices;
    size_t corner_count, index_count;
    uint32_t first; /* the number of the first corner here within the file */
} arrays;

/* A wall's plane: its lower left corner, and the directions along it and out of it. */
typedef struct wall {
    point origin, along, out;
    float width;
} wall;

/* ---- filling --------------------------------------------------------------------------------- */

static inline point on_wall(const wall *w, float s, float t, float out)
{
    return (point){w->origin.x + s * w->along.x + out * w->out.x, w->origin.y + t,
                   w->origin.z + s * w->along.z + out * w->out.z};
}

/* Counter-clockwise as seen from where the normal points. */
static inline void put_quad(arrays *a, point p, point q, point r, point s, point normal)
{
    static const uint32_t order[] = {0, 1, 2, 0, 2, 3};
    const uint32_t number = a->first + (uint32_t)a->corner_count;
    corner *c = a->corners + a->corner_count;
    uint32_t *indices = a->indices + a->index_count;
    c[0] = (corner){p, normal};
    c[1] = (corner){q, normal};
    c[2] = (corner){r, normal};
    c[3] = (corner){s, normal};
    for (int i = 0; i < 6; i++)
        indices[i] = number + order[i];
    a->corner_count += 4;
    a->index_count += 6;
}

/* The tile whose lower left corner is at (s, t) of the wall. */
static inline void put_tile(arrays *a, const wall *w, float s, float t)
{
    const float s0 = s + inset, s1 = s + bay - inset, t0 = t + inset, t1 = t + storey - inset;
    const point up = {0, 1, 0}, down = {0, -1, 0}, left = {-w->along.x, 0, -w->along.z};
    const point outer[] = {on_wall(w, s, t, 0), on_wall(w, s + bay, t, 0),
                           on_wall(w, s + bay, t + storey, 0), on_wall(w, s, t + storey, 0)};
    const point inner[] = {on_wall(w, s0, t0, 0), on_wall(w, s1, t0, 0), on_wall(w, s1, t1, 0),
                           on_wall(w, s0, t1, 0)};
    const point pane[] = {on_wall(w, s0, t0, -recess), on_wall(w, s1, t0, -recess),
                          on_wall(w, s1, t1, -recess), on_wall(w, s0, t1, -recess)};
    const point looks[] = {up, left, down, w->along};
    for (int i = 0; i < 4; i++) {
        const int next = (i + 1) & 3;
        put_quad(a, outer[i], outer[next], inner[next], inner[i], w->out);
        put_quad(a, inner[i], inner[next], pane[next], pane[i], looks[i]);
    }
    put_quad(a, pane[0], pane[1], pane[2], pane[3], w->out);
}

static void put_wall(arrays *a, const wall *w)
{
    const int bays = (int)(w->width / bay + 0.5f);
    for (int floor = 0; floor < FLOORS; floor++)
        for (int i = 0; i < bays; i++)
            put_tile(a, w, bay * (float)i, storey * (float)floor);
}

/* A lot whose front left corner is at (x, z); the front looks along +z. */
static void put_lot(arrays *a, float x, float z)
{
    const point right = {1, 0, 0}, back = {0, 0, -1}, left = {-1, 0, 0}, front = {0, 0, 1};
    const wall walls[] = {{{x, 0, z}, right, front, width},
                          {{x + width, 0, z}, back, right, depth},
                          {{x + width, 0, z - depth}, left, back, width},
                          {{x, 0, z - depth}, front, left, depth}};
    for (int i = 0; i < 4; i++)
        put_wall(a, &walls[i]);
    put_quad(a, (point){x, height, z}, (point){x + width, height, z},
             (point){x + width, height, z - depth}, (point){x, height, z - depth},
             (point){0, 1, 0});
}

static uint64_t lots_in_row(uint64_t lots)
{
    return (uint64_t)ceil(sqrt((double)lots));
}

static void fill(arrays *a, uint64_t from, uint64_t to, uint64_t row)
{
    a->corner_count = a->index_count = 0;
    for (uint64_t i = from; i < to; i++)
        put_lot(a, 20.0f * (float)(i % row), -25.0f * (float)(i / row));
}

/* ---- the file -------------------------------------------------------------------------------- */

/* What stands before the arrays; the bounds of a grid are known without looking. */
static void make_head(char head[HEAD], uint64_t lots, uint64_t row)
{
    const uint64_t corners = lots * LOT_CORNERS, indices = lots * LOT_INDICES;
    const uint64_t first = corners * sizeof(corner), second = indices * sizeof(uint32_t);
    const double wide = 20.0 * (double)((lots < row ? lots : row) - 1) + (double)width;
    const double far_back = 25.0 * (double)((lots - 1) / row) + (double)depth;
    const uint32_t outer[] = {0x46546C67, 2, (uint32_t)(HEAD + first + second), HEAD - 28,
                              0x4E4F534A};
    const uint32_t inner[] = {(uint32_t)(first + second), 0x004E4942};
    memset(head, ' ', HEAD);
    memcpy(head, outer, sizeof outer);
    memcpy(head + HEAD - sizeof inner, inner, sizeof inner);
    int length = snprintf(
        head + sizeof outer, HEAD - 28,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
        "\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]"
        "}],"
        "\"buffers\":[{\"byteLength\":%llu}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%llu,"
        "\"byteStride\":24,\"target\":34962},{\"buffer\":0,\"byteOffset\":%llu,\"byteLength\":%llu,"
        "\"target\":34963}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%llu,"
        "\"type\":\"VEC3\",\"min\":[0,0,%.9g],\"max\":[%.9g,%.9g,0]},{\"bufferView\":0,"
        "\"byteOffset\":12,"
        "\"componentType\":5126,\"count\":%llu,\"type\":\"VEC3\"},{\"bufferView\":1,"
        "\"componentType\":5125,\"count\":%llu,\"type\":\"SCALAR\"}]}",
        (unsigned long long)(first + second), (unsigned long long)first, (unsigned long long)first,
        (unsigned long long)second, (unsigned long long)corners, -far_back, wide, (double)height,
        (unsigned long long)corners, (unsigned long long)indices);
    head[sizeof outer + (size_t)length] = ' '; /* where snprintf ended its string */
}

static void put_at(int file, const void *bytes, size_t size, uint64_t position)
{
    const char *from = bytes;
    while (size) {
        const ssize_t n = pwrite(file, from, size, (off_t)position);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            rival_fail("writing");
        from += n;
        size -= (size_t)n;
        position += (uint64_t)n;
    }
}

static void stream(arrays *a, uint64_t lots, uint64_t row, const char *path)
{
    char head[HEAD];
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0)
        rival_fail(path);
    make_head(head, lots, row);
    put_at(file, head, sizeof head, 0);
    uint64_t corners_at = HEAD, indices_at = HEAD + lots * LOT_CORNERS * sizeof(corner);
    for (uint64_t i = 0; i < lots; i += BLOCK_LOTS) {
        a->first = (uint32_t)(i * LOT_CORNERS);
        fill(a, i, i + BLOCK_LOTS < lots ? i + BLOCK_LOTS : lots, row);
        put_at(file, a->corners, a->corner_count * sizeof(corner), corners_at);
        put_at(file, a->indices, a->index_count * sizeof(uint32_t), indices_at);
        corners_at += a->corner_count * sizeof(corner);
        indices_at += a->index_count * sizeof(uint32_t);
    }
    if (close(file) != 0)
        rival_fail(path);
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fputs("usage: limit LOTS FILE.glb\n", stderr);
        return 2;
    }
    const uint64_t lots = rival_number(argv[1], most_lots), row = lots_in_row(lots);
    static corner corners[BLOCK_LOTS * LOT_CORNERS];
    static uint32_t indices[BLOCK_LOTS * LOT_INDICES];
    arrays block = {.corners = corners, .indices = indices};
    arrays whole = {.corners = rival_array(lots * LOT_CORNERS, sizeof(corner)),
                    .indices = rival_array(lots * LOT_INDICES, sizeof(uint32_t))};
    rival r = {0};
    if (!lots)
        return 2;
    stream(&block, BLOCK_LOTS < lots ? BLOCK_LOTS : lots, row,
           argv[2]); /* pages of the code and the block */
    rival_begin(&r);
    stream(&block, lots, row, argv[2]);
    rival_end(&r, "stream");
    rival_begin(&r);
    fill(&whole, 0, lots, row);
    rival_end(&r, "fill");
    rival_begin(&r);
    fill(&whole, 0, lots, row);
    rival_end(&r, "refill");
    rival_print(&r, "faces", whole.corner_count / 4);
    free(whole.corners);
    free(whole.indices);
    return 0;
}

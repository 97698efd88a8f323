/* mesh_canonical.c - the meshes that are stored once: the unit square, the unit cube and its
 * parts. */
#include "runtime/base/base.h"
#include "runtime/shape.h"

static const pcg_vec3 cube_position[] = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
};
/* Every face is one loop of four corners, so that one array of each kind serves all. */
static const uint32_t quad_loop[] = {0, 1, 2, 3, 4, 5, 6};
static const uint32_t quad_corner[] = {0, 4, 8, 12, 16, 20, 24};

static const uint32_t square_vertex[] = {0, 1, 2, 3};
static const uint32_t cube_vertex[] = {
    0, 1, 5, 4, /* -y */
    1, 2, 6, 5, /* +x */
    2, 3, 7, 6, /* +y */
    3, 0, 4, 7, /* -x */
    4, 5, 6, 7, /* top */
    0, 3, 2, 1, /* bottom */
};
static const uint32_t cup_vertex[] = {
    0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7, 0, 3, 2, 1,
};
static const uint32_t tray_vertex[] = {
    4, 5, 1, 0, 5, 6, 2, 1, 6, 7, 3, 2, 7, 4, 0, 3, 0, 1, 2, 3,
};

#define QUADS(vertices, faces, corners)                                                            \
    {                                                                                              \
        .references = 1, .unit = true, .forever = true, .vertex_count = (vertices),                \
        .face_count = (faces), .loop_count = (faces), .corner_count = 4 * (faces),                 \
        .position = (pcg_vec3 *)cube_position, .face_loop = (uint32_t *)quad_loop,                 \
        .loop_corner = (uint32_t *)quad_corner, .corner_vertex = (uint32_t *)(corners),            \
    }

const pcg_mesh pcg_mesh_empty = QUADS(0, 0, square_vertex);
const pcg_mesh pcg_mesh_square = QUADS(4, 1, square_vertex);
const pcg_mesh pcg_mesh_cube = QUADS(8, 6, cube_vertex);
const pcg_mesh pcg_mesh_lid = QUADS(8, 5, cube_vertex);
const pcg_mesh pcg_mesh_cup = QUADS(8, 5, cup_vertex);
const pcg_mesh pcg_mesh_sides = QUADS(8, 4, cube_vertex);
const pcg_mesh pcg_mesh_tray = QUADS(8, 5, tray_vertex);
const pcg_mesh pcg_mesh_reveal = QUADS(8, 4, tray_vertex);

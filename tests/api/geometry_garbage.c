/* geometry_garbage.c - shapes that nobody would draw go through every kind of procedure: bent and crossing faces, holes
 * that are none, corners that stand twice, sizes from nothing to huge. Nothing may go wrong but messages. */
#include <math.h>
#include <stdlib.h>

#include "runtime/pcg.h"
#include "tests/unit/outlines.h"
#include "tests/unit/unit.h"

static const char graph[] =
    "graph garbage {\n"
    "    param amount: length = 1m\n"
    "    in thing: Shape = box()\n"
    "    out all: Shape = *\n"
    "    thing -> up: extrude(amount = amount)\n"
    "    thing -> down: extrude(amount = -amount, cap = false)\n"
    "    thing -> skin: special_extrude(amount = amount)\n"
    "    thing -> inset: offset(amount = -amount)\n"
    "    thing -> outset: offset(amount = amount)\n"
    "    thing -> roof: shed_roof(height = amount, overhang = amount)\n"
    "    thing -> across: split(axis = x, repeat = true) { absolute(amount * 0.3); flexible }\n"
    "    thing -> along: split(axis = y) { a: relative(30%); b: absolute(amount); c: flexible }\n"
    "    thing -> high: split(axis = z, repeat = true, leftover = cut) { absolute(amount) }\n"
    "    thing -> sides: select { top; front; vertical; largest; smallest; all }\n"
    "    thing -> faces: decompose()\n"
    "    thing -> edges: decompose(into = edges)\n"
    "    thing -> pieces: decompose(into = connected)\n"
    "    faces -> boxed: align_scope(to = smallest_box)\n"
    "    boxed -> fine: split(axis = y, repeat = true) { absolute(amount * 0.7) }\n"
    "    inset.inside -> again: offset(amount = -amount * 0.5)\n"
    "    up -> cut: split(axis = x, repeat = true) { absolute(amount) }\n"
    "    cut -> map_uv_faces() -> uv: split(axis = y) { low: relative(50%); high: flexible }\n"
    "    outset.border -> one: merge()\n"
    "    pieces -> one\n"
    "    thing -> flat: flat_roof(height = amount, width = amount * 0.2, sink = amount * 0.1)\n"
    "    faces -> near: level_of_detail { close: level(until = amount); far: level }\n"
    "    faces -> next.in\n"
    "    up -> next.to\n"
    "    next: nearest(within = amount)\n"
    "    faces -> seen.in\n"
    "    edges -> seen.from\n"
    "    outset.border -> seen.screen\n"
    "    seen: visible_from(within = amount * 5) { screen: blockers }\n"
    "    faces -> beside.in\n"
    "    up -> beside.to\n"
    "    beside: adjacent(gap = amount * 0.02)\n"
    "    one -> tag(name = \"x\") -> map_uv_box() -> last: extrude(amount = amount)\n"
    "}\n";

enum { MOST_POINTS = 60, MOST_FACES = 12 };

typedef struct garbage {
    double points[3 * MOST_POINTS];
    uint32_t counts[MOST_FACES], corners[MOST_FACES * 16];
    uint32_t point_count, face_count;
} garbage;

/* How large the things of a kind are. */
static double size_of(uint32_t kind)
{
    static const double sizes[] = {4, 10, 1e-9, 300};

    return sizes[kind];
}

static double coordinate(uint32_t kind)
{
    return kind == 0 ? below(5) : size_of(kind) * share();
}

static garbage make(uint32_t round)
{
    garbage g = {.point_count = 1 + below(MOST_POINTS), .face_count = 1 + below(MOST_FACES)};
    uint32_t corner_count = 0, kind = round % 4;

    for (uint32_t i = 0; i < g.point_count; i++) {
        g.points[3 * i] = coordinate(kind);
        g.points[3 * i + 1] = coordinate(kind);
        g.points[3 * i + 2] = round % 3 == 0 ? 0 : coordinate(kind);
    }
    for (uint32_t f = 0; f < g.face_count; f++) {
        g.counts[f] = 3 + below(13);
        for (uint32_t i = 0; i < g.counts[f]; i++)
            g.corners[corner_count++] = below(g.point_count);
    }
    return g;
}

/* Asks for the triangles of everything that came out. */
static void read_all(pcg_run *r, const pcg_program *p)
{
    bool sound = true;

    for (size_t output = 0; output < pcg_program_output_count(p); output++)
        for (size_t i = 0; i < pcg_run_output_count(r, output); i++) {
            pcg_mesh_view view = {.size = sizeof view};

            sound = sound && pcg_run_mesh(r, output, i, &view) == PCG_STATUS_OK;
            for (size_t k = 0; k < 3 * view.point_count; k++)
                sound = sound && isfinite(view.points[k]);
            for (size_t k = 0; k < 3 * view.triangle_count; k++)
                sound = sound && view.triangles[k] < view.corner_count;
        }
    CHECK(sound);
}

static void run_once(const pcg_program *p, uint32_t round)
{
    static const double amounts[] = {0.04, 0.1, 0.25, 0.7, 3};
    double amount = fmin(100, amounts[below(5)] * size_of(round % 4));
    garbage g = make(round);
    pcg_run_options options = {.size = sizeof options, .max_entities = 50000};
    pcg_run *r = pcg_run_new(p, &options);
    pcg_status status;

    CHECK(pcg_run_set_float(r, "amount", amount) == PCG_STATUS_OK);
    CHECK(pcg_run_input_mesh(r, "thing", g.points, g.point_count, g.counts, g.face_count,
                             g.corners) == PCG_STATUS_OK);
    status = pcg_run_execute(r);
    CHECK(status == PCG_STATUS_OK || status == PCG_STATUS_LIMIT);
    if (status == PCG_STATUS_OK)
        read_all(r, p);
    pcg_run_free(r);
}

int main(void)
{
    pcg_program *p = pcg_compile_text(graph, sizeof graph - 1, "garbage.pcg", NULL);

    CHECK(p != NULL);
    for (uint32_t round = 0; p != NULL && round < 150; round++)
        run_once(p, round);
    pcg_program_free(p);
    return unit_done();
}

/* parts.c - faces, edges and vertices by reference, as a host sees them: types, attributes, what the
 * shape has become; limits; a great many of them, in linear time. */
#include <stdlib.h>
#include <time.h>

#include "runtime/pcg.h"
#include "tests/unit/unit.h"

/* Gate outputs: the shape, the vertices that have moved. */
enum { SHAPE, MOVED };

static const char moving[] =
    "graph moving {\n"
    "    attr number: int\n"
    "    in solid: Spatial = box()\n"
    "    out shape: Shape\n"
    "    out moved: Vertex\n"
    "    solid -> t: type_filter { shape }\n"
    "    t.shape -> s: sequence { change: step; look: step }\n"
    "    s.change -> parts(index => @number) { vertices } -> top: condition(centroid(in).z > 0.5)\n"
    "    top.yes -> translate(z = 1m) -> moved\n"
    "    s.look -> shape\n"
    "    block t.rest\n"
    "    block top.no\n"
    "}\n";

/* A wedge: a roof without ends, its corners' normals smooth along the ridge. */
static const double points[] = {0, 0, 0, 4, 0, 0, 4, 1, 1, 0, 1, 1, 4, 2, 0, 0, 2, 0};
static const uint32_t face_loops[] = {0, 1, 2}, loop_corners[] = {0, 4, 8};
static const uint32_t corner_points[] = {0, 1, 2, 3, 3, 2, 4, 5};
static const float normals[] = {0, -1, 0, 0, -1, 0, 0, 0, 1, 0, 0, 1,
                                0, 0,  1, 0, 0,  1, 0, 1, 0, 0, 1, 0};

static pcg_program *compile(const char *text, const char *name)
{
    pcg_program *p = pcg_compile_text(text, strlen(text), name, NULL);

    CHECK(p != NULL);
    return p;
}

static pcg_run *run_wedge(const pcg_program *p)
{
    const pcg_mesh_view wedge = {.size = sizeof wedge,
                                 .point_count = 6,
                                 .face_count = 2,
                                 .loop_count = 2,
                                 .corner_count = 8,
                                 .points = points,
                                 .face_loops = face_loops,
                                 .loop_corners = loop_corners,
                                 .corner_points = corner_points,
                                 .normals = normals};
    pcg_run *r = pcg_run_new(p, NULL);

    CHECK_INTEGER(pcg_run_input_shape(r, "solid", &wedge, NULL, 0), PCG_STATUS_OK);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    return r;
}

static void test_what_hosts_see(const pcg_program *p)
{
    pcg_run *r = run_wedge(p);
    pcg_mesh_view v = {.size = sizeof v};

    CHECK_INTEGER(pcg_run_output_count(r, SHAPE), 1);
    CHECK_INTEGER(pcg_run_output_count(r, MOVED), 2);
    CHECK_TEXT(pcg_run_entity_type(r, MOVED, 0), "Vertex");
    CHECK_TEXT(pcg_run_entity_node(r, MOVED, 0), "parts");
    CHECK_TEXT(pcg_run_attribute(r, MOVED, 1, "number"), "3");
    CHECK_INTEGER(pcg_run_face_count(r), 2);
    CHECK_INTEGER(pcg_run_mesh(r, SHAPE, 0, &v), PCG_STATUS_OK);
    CHECK_NUMBER(v.points[2 * 3 + 2], 2);
    CHECK_NUMBER(v.points[1 * 3 + 2], 0);
    /* Both faces are steeper now, and look where they lie. */
    CHECK_NUMBER(v.normals[2], v.normals[2 * 3 + 2]);
    CHECK(v.normals[2] > 0.4F && v.normals[2] < 0.5F);
    CHECK_INTEGER(pcg_run_output_mesh(r, MOVED, &v), PCG_STATUS_OK);
    CHECK_INTEGER(v.point_count, 0);
    pcg_run_free(r);
}

/* ---- limits ---------------------------------------------------------------------------------- */

static pcg_status run_within(const pcg_program *p, size_t entities, size_t memory)
{
    const pcg_run_options options = {
        .size = sizeof options, .max_entities = entities, .max_memory = memory};
    pcg_run *r = pcg_run_new(p, &options);
    pcg_status status = r ? pcg_run_execute(r) : PCG_STATUS_LIMIT;

    pcg_run_free(r);
    return status;
}

/* Copies, groups and colours of parts, and a mesh that loses them. */
static const char much[] =
    "graph much {\n"
    "    attr n: int\n"
    "    attr m: float\n"
    "    regular_polygon(sides = 40) -> extrude(amount = 1m)\n"
    "        -> s: sequence { change: step; values: step; grow: step; look: step }\n"
    "    s.change -> p: parts(index => @n) { vertices; edges; faces }\n"
    "    p.vertices -> two: copy(count = 2) -> translate(z = @n * 1cm) -> group() -> u: ungroup { "
    "vertex }\n"
    "    p.edges -> rotate(z = 3deg, about = centre)\n"
    "    p.edges -> scale(x = 2)\n"
    "    p.faces -> color(#ff0000) -> tag(name = \"t\")\n"
    "    s.values -> to_parts(kind = vertices) { value(@n, @n) } -> from_parts(kind = edges) { "
    "sum(@n, @m) }\n"
    "    s.grow -> parts { faces } -> extrude(amount = 1m) -> extrude(amount = 1m, cap = false)\n"
    "    s.look -> extrude(amount = 1m) -> parts { edges } -> translate(x = 1m)\n"
    "}\n";

static void test_limits(const pcg_program *p)
{
    unsigned done = 0, stopped = 0;

    CHECK_INTEGER(run_within(p, 0, 0), PCG_STATUS_OK);
    for (size_t entities = 1; entities < 1500; entities += 7)
        stopped += run_within(p, entities, 0) == PCG_STATUS_LIMIT;
    CHECK(stopped > 10);
    stopped = 0;
    for (size_t memory = 1 << 16; memory < 6 << 20; memory += memory / 24) {
        pcg_status status = run_within(p, 0, memory);

        CHECK(status == PCG_STATUS_OK || status == PCG_STATUS_LIMIT);
        done += status == PCG_STATUS_OK;
        stopped += status == PCG_STATUS_LIMIT;
    }
    CHECK(done > 0 && stopped > 0);
}

/* ---- many ------------------------------------------------------------------------------------ */

/* Each vertex goes through a graph of its own, in which it moves twice. */
static const char many[] =
    "graph many {\n"
    "    param count: int = 1000\n"
    "    attr n: int\n"
    "    out shape: Shape\n"
    "    regular_polygon(sides = count, radius = 100m) -> s: sequence { change: step; look: step "
    "}\n"
    "    s.change -> parts(index => @n) { vertices } -> translate(x = -@n * 1cm) -> lift(by = @n * "
    "1mm)\n"
    "    s.look -> shape\n"
    "}\n"
    "graph lift {\n"
    "    param by: length = 0m\n"
    "    in vertex: Vertex\n"
    "    out lifted: Vertex\n"
    "    vertex -> translate(z = by) -> rotate(z = 1deg, about = world, frame = world) -> lifted\n"
    "}\n";

static double seconds_for(const pcg_program *p, int64_t count)
{
    struct timespec from, to;
    pcg_run *r = pcg_run_new(p, NULL);

    CHECK_INTEGER(pcg_run_set_int(r, "count", count), PCG_STATUS_OK);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
    CHECK_INTEGER(pcg_run_execute(r), PCG_STATUS_OK);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
    CHECK_INTEGER(pcg_run_vertex_count(r), count);
    pcg_run_free(r);
    return (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
}

/* Ten times as many take ten times as long; a quadratic algorithm would take a hundred times. */
static void test_many(const pcg_program *p)
{
    double few = seconds_for(p, 10000), much_more = seconds_for(p, 100000);

    CHECK(much_more < 40 * few + 0.1);
}

int main(void)
{
    pcg_program *p = compile(moving, "moving.pcg");

    test_what_hosts_see(p);
    pcg_program_free(p);
    p = compile(much, "much.pcg");
    test_limits(p);
    pcg_program_free(p);
    p = compile(many, "many.pcg");
    test_many(p);
    pcg_program_free(p);
    return unit_done();
}

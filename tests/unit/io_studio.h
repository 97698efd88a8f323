/* io_studio.h - a graph without nodes but one, which a test fills: what it builds is what the
 * writers write.
 *
 *     graph studio {
 *         attr floor: int = 0
 *         attr label: string = "none"
 *         maker: build() -> model
 *         maker.other -> extra
 *         out model: Shape
 *         out extra: Entity
 *     }
 */
#ifndef TESTS_IO_STUDIO_H
#define TESTS_IO_STUDIO_H

#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

#include "runtime/pcg.h"
#include "runtime/result.h"
#include "runtime/shape.h"
#include "tests/unit/unit.h"

typedef struct studio {
    pcg_frame frame;
    pcg_cell initial_floor, initial_label;
    pcg_queue model, extra;
    pcg_queue *to_model[1], *to_extra[1];
    pcg_port model_out, extra_out;
    pcg_instance instance;
    pcg_call *call; /* while it is built */
} studio;

/* What the next run builds. Tests run one after the other. */
static void (*studio_build)(studio *s);

static const pcg_node studio_nodes[] = {{"maker", "build", "studio", "studio.pcg", 4, 5, 0, 77, 0}};
static const pcg_output_info studio_ports[] = {{0, "model"}, {0, "other"}};

static int studio_start(pcg_frame *f)
{
    studio *s = (studio *)f;
    s->initial_label.s = "none";
    s->to_model[0] = &s->model;
    s->to_extra[0] = &s->extra;
    s->model_out = (pcg_port){s->to_model, 1, 0};
    s->extra_out = (pcg_port){s->to_extra, 1, 1};
    return PCG_OK;
}

static int studio_run(pcg_frame *f)
{
    studio *s = (studio *)f;
    pcg_call call;
    pcg_begin(&call, f, &studio_nodes[0], &s->instance);
    int status = pcg_round(&call, NULL);
    s->call = &call;
    if (status == PCG_OK && studio_build)
        studio_build(s);
    s->call = NULL;
    return status;
}

static const pcg_attribute_info studio_attributes[] = {
    {"floor", "", "int", NULL, PCG_INT, 0, 0, (pcg_u32)offsetof(studio, initial_floor)},
    {"label", "", "string", NULL, PCG_STRING, 0, 1, (pcg_u32)offsetof(studio, initial_label)},
};
static const pcg_port_info studio_outputs[] = {
    {"model", "", "Shape", "Shape\nEntity", 0, (pcg_u32)offsetof(studio, model), 0},
    {"extra", "", "Entity", "Entity", 0, (pcg_u32)offsetof(studio, extra), 0},
};

static const pcg_module studio_module = {
    .abi = PCG_ABI,
    .size = sizeof(pcg_module),
    .name = "studio",
    .document = "",
    .version = "0",
    .folder = "",
    .outputs = studio_outputs,
    .attributes = studio_attributes,
    .nodes = studio_nodes,
    .ports = studio_ports,
    .output_count = 2,
    .attribute_count = 2,
    .node_count = 1,
    .port_count = 2,
    .gate_count = 2,
    .frame_size = sizeof(studio),
    .start = studio_start,
    .run = studio_run,
};

/* ---- building -------------------------------------------------------------------------------- */

static inline const pcg_material *studio_material(studio *s, const char *name, double r, double g,
                                                  double b, const char *texture)
{
    pcg_material m = pcg_material_default;
    m.name = name;
    m.color = (pcg_color){r, g, b, 1};
    m.texture = texture;
    return pcg_material_intern(s->call->run, &m);
}

/* A shape at (x, y, z) with a mesh of its own, empty; unless it is given one that is shared. */
static inline pcg_shape *studio_shape(studio *s, const pcg_mesh *mesh, const pcg_material *material)
{
    pcg_shape *shape = pcg_shape_new(s->call, NULL);
    pcg_mesh *own = mesh ? pcg_mesh_hold(mesh) : pcg_mesh_new(s->call->run, false);
    if (!shape || !own)
        abort();
    pcg_shape_set_mesh(s->call->run, shape, own);
    shape->material = material;
    shape->scope = (pcg_scope){{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 1, 1}};
    return shape;
}

static inline void studio_emit(studio *s, pcg_shape *shape)
{
    if (pcg_emit(s->call, &s->model_out, &shape->entity) != PCG_OK)
        abort();
}

static inline pcg_shape *studio_box(studio *s, pcg_vec3 from, pcg_vec3 size,
                                    const pcg_material *material)
{
    pcg_shape *shape = studio_shape(s, &pcg_mesh_cube, material);
    shape->scope.origin = from;
    shape->scope.size = size;
    return shape;
}

/* A face of a shape with a mesh of its own; points of 3 numbers each. */
static inline void studio_face(studio *s, pcg_shape *shape, const double *points, uint32_t count)
{
    uint32_t vertices[64];
    for (uint32_t i = 0; i < count && i < 64; i++)
        vertices[i] = pcg_mesh_add_vertex(
            s->call->run, shape->mesh, vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]));
    pcg_mesh_add_face(s->call->run, shape->mesh, vertices, count);
}

/* ---- running --------------------------------------------------------------------------------- */

typedef struct studio_result {
    pcg_program *program;
    pcg_run *run;
} studio_result;

static inline studio_result studio_make(void (*build)(studio *s))
{
    studio_result r = {.program = pcg_program_of(&studio_module)};
    r.run = pcg_run_new(r.program, NULL);
    studio_build = build;
    CHECK_INTEGER(pcg_run_execute(r.run), PCG_STATUS_OK);
    return r;
}

/* The warnings and errors that a run gave, each on a line. */
static inline void studio_messages(const studio_result *r, char *messages, size_t size)
{
    messages[0] = '\0';
    for (size_t i = 0; i < result_message_count(r->run); i++)
        if (result_message(r->run, i)->severity != PCG_NOTE)
            snprintf(messages + strlen(messages), size - strlen(messages), "%s\n",
                     result_message(r->run, i)->text);
}

static inline void studio_free(studio_result *r)
{
    pcg_run_free(r->run);
    pcg_program_free(r->program);
}

/* ---- files ----------------------------------------------------------------------------------- */

/* A folder of its own for a test program: what is in it is removed at the end. */
static char studio_folder[256];

static inline void studio_open_folder(void)
{
    snprintf(studio_folder, sizeof studio_folder, "%s/pcgc-io-XXXXXX", P_tmpdir);
    CHECK(mkdtemp(studio_folder) != NULL);
}

/* The path of a file in it; each call overwrites what the fourth before it returned. */
static inline const char *studio_path(const char *name)
{
    static char paths[4][512];
    static unsigned next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", studio_folder, name);
    return path;
}

/* A picture of the project's: the tests run in folders of their own, and are told where the
 * project is. */
static inline const char *studio_brick(void)
{
    static char path[512];
    const char *root = getenv("ROOT");
    snprintf(path, sizeof path, "%s/examples/assets/walls/brick.jpg", root ? root : ".");
    return path;
}

/* A file's bytes with a NUL behind them, for free(); NULL when it cannot be read. */
static inline char *studio_read(const char *name, size_t *size)
{
    FILE *f = fopen(studio_path(name), "rb");
    char *bytes = NULL;
    size_t length = 0, got = 0;
    if (!f)
        return NULL;
    do {
        bytes = realloc(bytes, length + (1 << 20) + 1);
        got = bytes ? fread(bytes + length, 1, 1 << 20, f) : 0;
        length += got;
    } while (got);
    fclose(f);
    if (bytes)
        bytes[length] = '\0';
    if (size)
        *size = length;
    return bytes;
}

static inline void studio_write(const char *name, const void *bytes, size_t size)
{
    FILE *f = fopen(studio_path(name), "wb");
    CHECK(f && fwrite(bytes, 1, size, f) == size);
    if (f)
        fclose(f);
}

/* How many files there are in it; removes them where that is asked for. */
static inline int studio_files(int removed)
{
    DIR *d = opendir(studio_folder);
    int count = 0;
    for (struct dirent *e; d && (e = readdir(d));) {
        if (!strcmp(e->d_name, ".") || !strcmp(e->d_name, ".."))
            continue;
        count++;
        if (removed)
            unlink(studio_path(e->d_name));
    }
    if (d)
        closedir(d);
    return count;
}

static inline void studio_close_folder(void)
{
    studio_files(1);
    CHECK_INTEGER(rmdir(studio_folder), 0);
}

#endif

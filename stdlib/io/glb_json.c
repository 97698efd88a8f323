/* glb_json.c - the text of a glTF binary: nodes, meshes, materials, and where their data is. */
#include "stdlib/io/glb.h"

#include <math.h>

enum { FLOAT = 5126, SHORT = 5123, INT = 5125, ARRAY_BUFFER = 34962, ELEMENT_BUFFER = 34963 };

/* What the text of one of them usually takes. */
enum { PRIMITIVE_BYTES = 800, REFERENCE_BYTES = 64, MATERIAL_BYTES = 200, SPARE_BYTES = 1024 };

/* ---- pieces ---------------------------------------------------------------------------------- */

static void separate(text *out, uint32_t i)
{
    if (i)
        text_add(out, ",");
}

/* Before the i-th of many: whether to go on is in vain. */
static bool stopped(const glb *g, uint32_t i)
{
    return i % 1024 == 0 && io_stopped(g->job);
}

/* A member of an object that may follow another. */
static void key(text *out, const char *name)
{
    if (out->length && out->at[out->length - 1] != '{')
        text_add(out, ",");
    text_quote(out, name);
    text_add(out, ":");
}

static void numbers(text *out, const double *x, uint32_t count)
{
    text_add(out, "[");
    for (uint32_t i = 0; i < count; i++) {
        separate(out, i);
        text_number(out, x[i] + 0.0); /* no -0 */
    }
    text_add(out, "]");
}

static void floats(text *out, const float *x)
{
    const double wide[3] = {(double)x[0], (double)x[1], (double)x[2]};
    numbers(out, wide, 3);
}

/* In 0 … 1, to six places. */
static double fraction(double x)
{
    return x > 0 ? floor((x < 1 ? x : 1) * 1e6 + 0.5) / 1e6 : 0;
}

/* ---- nodes ----------------------------------------------------------------------------------- */

static void write_roots(const glb *g, text *out)
{
    bool first = true;
    text_add(out, "[");
    for (uint32_t i = 0; i < g->nodes.count; i++) {
        if (!g->nodes.at[i].output)
            continue;
        text_format(out, first ? "%u" : ",%u", i);
        first = false;
    }
    text_add(out, "]");
}

static void write_children(const glb *g, uint32_t root, text *out)
{
    uint32_t i = root + 1;
    if (i == g->nodes.count || g->nodes.at[i].output)
        return;
    key(out, "children");
    text_format(out, "[%u", i++);
    while (i < g->nodes.count && !g->nodes.at[i].output)
        text_format(out, ",%u", i++);
    text_add(out, "]");
}

static pcg_vec3 y_up(pcg_vec3 v)
{
    return vec3(v.x, v.z, -v.y);
}

static bool is_axis(pcg_vec3 v, double x, double y, double z)
{
    return v.x == x && v.y == y && v.z == z;
}

/* Where a shared mesh stands: a translation where that is all, else a matrix, whose zeros and
 * ones keep what is parallel to an axis exactly so. */
static void write_place(const glb *g, const pcg_scope *s, text *out)
{
    pcg_vec3 at = y_up(vec3_subtract(s->origin, g->tessellator.center));
    pcg_vec3 x = y_up(s->axis[0]), y = y_up(s->axis[2]), z = vec3_scale(y_up(s->axis[1]), -1);
    if (is_axis(x, 1, 0, 0) && is_axis(y, 0, 1, 0) && is_axis(z, 0, 0, 1)) {
        const double translation[3] = {at.x, at.y, at.z};
        if (is_axis(at, 0, 0, 0))
            return;
        key(out, "translation");
        numbers(out, translation, 3);
        return;
    }
    const double matrix[16] = {x.x, x.y, x.z, 0, y.x,  y.y,  y.z,  0,
                               z.x, z.y, z.z, 0, at.x, at.y, at.z, 1};
    key(out, "matrix");
    numbers(out, matrix, 16);
}

static void write_node(const glb *g, uint32_t i, text *out)
{
    const glb_node *n = &g->nodes.at[i];
    pcg_vec3 center = y_up(g->tessellator.center);
    const double translation[3] = {center.x, center.y, center.z};
    text_add(out, "{");
    key(out, "name");
    text_quote(out, n->name);
    if (n->mesh != GLB_NONE && g->meshes.at[n->mesh].written != GLB_NONE) {
        key(out, "mesh");
        text_format(out, "%u", g->meshes.at[n->mesh].written);
        if (n->scope && g->meshes.at[n->mesh].shared)
            write_place(g, n->scope, out);
    }
    if (n->output) {
        write_children(g, i, out);
        if (!is_axis(center, 0, 0, 0)) {
            key(out, "translation");
            numbers(out, translation, 3);
        }
    }
    if (n->extras) {
        key(out, "extras");
        text_add(out, n->extras);
    }
    text_add(out, "}");
}

/* ---- meshes ---------------------------------------------------------------------------------- */

static bool has_normals(const glb_primitive *p)
{
    return p->stride >= IO_PLAIN;
}

static bool has_uv(const glb_primitive *p)
{
    return p->stride == IO_TEXTURED && !p->colored;
}

/* How many accessors a primitive has. */
static uint32_t accessor_count(const glb_primitive *p)
{
    uint32_t attributes = 1u + has_normals(p) + has_uv(p) + p->colored;
    return attributes + (p->indices != GLB_NONE ? 1 : 0);
}

/* Accessors are numbered in the order of primitives: position, normal, uv or colour, indices. */
static void write_primitive(const glb_primitive *p, uint32_t accessor, text *out)
{
    text_add(out, "{\"attributes\":{");
    key(out, "POSITION");
    text_format(out, "%u", accessor++);
    if (has_normals(p)) {
        key(out, "NORMAL");
        text_format(out, "%u", accessor++);
    }
    if (has_uv(p) || p->colored) {
        key(out, p->colored ? "COLOR_0" : "TEXCOORD_0");
        text_format(out, "%u", accessor++);
    }
    text_add(out, "}");
    if (p->indices != GLB_NONE)
        text_format(out, ",\"indices\":%u", accessor);
    text_format(out, ",\"material\":%u", p->material);
    if (p->mode != GLB_TRIANGLES)
        text_format(out, ",\"mode\":%d", (int)p->mode);
    text_add(out, "}");
}

static void write_meshes(const glb *g, text *out)
{
    uint32_t accessor = 0, written = 0;
    for (uint32_t i = 0; i < g->meshes.count && !stopped(g, i); i++) {
        const glb_mesh *m = &g->meshes.at[i];
        if (m->written == GLB_NONE)
            continue;
        separate(out, written++);
        text_add(out, "{");
        key(out, "name");
        text_quote(out, m->name);
        key(out, "primitives");
        text_add(out, "[");
        for (uint32_t k = 0; k < m->count; k++) {
            const glb_primitive *p = &g->primitives.at[m->first + k];
            separate(out, k);
            write_primitive(p, accessor, out);
            accessor += accessor_count(p);
        }
        text_add(out, "]}");
    }
}

static void write_attribute(const glb_primitive *p, uint32_t offset, const char *type, text *out)
{
    text_format(out, "{\"bufferView\":%u", p->vertices);
    if (offset)
        text_format(out, ",\"byteOffset\":%u", offset);
    text_format(out, ",\"componentType\":%d,\"count\":%u,\"type\":\"%s\"", FLOAT, p->vertex_count,
                type);
    if (!offset) {
        key(out, "min");
        floats(out, p->low);
        key(out, "max");
        floats(out, p->high);
    }
    text_add(out, "}");
}

static void write_accessors(const glb *g, text *out)
{
    for (uint32_t i = 0; i < g->primitives.count && !stopped(g, i); i++) {
        const glb_primitive *p = &g->primitives.at[i];
        separate(out, i);
        write_attribute(p, 0, "VEC3", out);
        if (has_normals(p)) {
            text_add(out, ",");
            write_attribute(p, 12, "VEC3", out);
        }
        if (has_uv(p)) {
            text_add(out, ",");
            write_attribute(p, 24, "VEC2", out);
        }
        if (p->colored)
            text_format(out,
                        ",{\"bufferView\":%u,\"byteOffset\":%u,\"componentType\":%d,"
                        "\"normalized\":true,\"count\":%u,\"type\":\"VEC4\"}",
                        p->vertices, 4 * p->stride - 8, SHORT, p->vertex_count);
        if (p->indices != GLB_NONE)
            text_format(out,
                        ",{\"bufferView\":%u,\"componentType\":%d,\"count\":%u,"
                        "\"type\":\"SCALAR\"}",
                        p->indices, p->wide ? INT : SHORT, p->index_count);
    }
}

static void write_view(const glb_view *v, text *out)
{
    text_format(out, "{\"buffer\":0,\"byteOffset\":%llu,\"byteLength\":%llu",
                (unsigned long long)v->offset, (unsigned long long)v->size);
    if (v->stride)
        text_format(out, ",\"byteStride\":%u", v->stride);
    if (v->vertices || v->indices)
        text_format(out, ",\"target\":%d", v->vertices ? ARRAY_BUFFER : ELEMENT_BUFFER);
    text_add(out, "}");
}

/* ---- materials ------------------------------------------------------------------------------- */

/* glTF's factors are linear light. A texture is only referred to where the primitives have uv. */
static void write_material(const glb *g, const glb_written *w, text *out)
{
    const pcg_material *look = w->material->look;
    bool image = w->textured && w->material->image != GLB_NONE;
    const double all[4] = {1, 1, 1, 1};
    const double own[4] = {
        fraction(color_linear(look->color.r)), fraction(color_linear(look->color.g)),
        fraction(color_linear(look->color.b)), fraction(look->color.a)};
    const double *color = w->material->colored ? all : own;
    const double finish[2] = {fraction(look->metallic), fraction(look->roughness)};
    text_add(out, "{");
    if (!w->material->colored && look->name && *look->name) {
        key(out, "name");
        text_quote(out, look->name);
    }
    key(out, "pbrMetallicRoughness");
    text_add(out, "{\"baseColorFactor\":");
    numbers(out, color, 4);
    if (image)
        text_format(out, ",\"baseColorTexture\":{\"index\":%u}", w->material->image);
    text_add(out, ",\"metallicFactor\":");
    text_number(out, finish[0]);
    text_add(out, ",\"roughnessFactor\":");
    text_number(out, finish[1]);
    text_add(out, "}");
    if (own[3] < 1)
        text_add(out, ",\"alphaMode\":\"BLEND\"");
    else if (image && g->images.at[w->material->image].alpha)
        text_add(out, ",\"alphaMode\":\"MASK\"");
    if (w->two_sided)
        text_add(out, ",\"doubleSided\":true");
    text_add(out, "}");
}

static void write_images(const glb *g, text *out)
{
    key(out, "textures");
    text_add(out, "[");
    for (uint32_t i = 0; i < g->images.count; i++)
        text_format(out, i ? ",{\"sampler\":0,\"source\":%u}" : "{\"sampler\":0,\"source\":%u}", i);
    text_add(out, "]");
    key(out, "images");
    text_add(out, "[");
    for (uint32_t i = 0; i < g->images.count; i++) {
        const glb_image *image = &g->images.at[i];
        separate(out, i);
        text_add(out, "{");
        key(out, "name");
        text_quote(out, image_file_name(image->path));
        text_format(out, ",\"mimeType\":\"image/%s\",\"bufferView\":%u}",
                    image->kind == IO_IMAGE_PNG ? "png" : "jpeg", image->view);
    }
    text_add(out, "],\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987}]");
}

/* ---- the whole ------------------------------------------------------------------------------- */

/* In the scene's extras, which viewers keep: where on Earth the origin is, say. */
static void write_properties(const glb *g, text *out)
{
    text members = {.arena = g->arena};
    if (!result_properties_json(g->job->run, &members))
        return;
    io_repair_utf8(members.at, members.length);
    key(out, "extras");
    text_add(out, "{");
    text_add_bytes(out, members.at, members.length);
    text_add(out, "}");
}

static void write_scene(const glb *g, text *out)
{
    text_add(out, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"pcgc " PCG_VERSION "\"},"
                  "\"scene\":0,\"scenes\":[{");
    if (g->nodes.count) {
        key(out, "nodes");
        write_roots(g, out);
    }
    write_properties(g, out);
    text_add(out, "}]");
    if (!g->nodes.count)
        return;
    key(out, "nodes");
    text_add(out, "[");
    for (uint32_t i = 0; i < g->nodes.count && !stopped(g, i); i++) {
        separate(out, i);
        write_node(g, i, out);
    }
    text_add(out, "]");
}

static void write_geometry(const glb *g, text *out)
{
    key(out, "meshes");
    text_add(out, "[");
    write_meshes(g, out);
    text_add(out, "]");
    key(out, "materials");
    text_add(out, "[");
    for (uint32_t i = 0; i < g->written.count; i++) {
        separate(out, i);
        write_material(g, &g->written.at[i], out);
    }
    text_add(out, "]");
    key(out, "accessors");
    text_add(out, "[");
    write_accessors(g, out);
    text_add(out, "]");
}

void glb_json(const glb *g, text *out)
{
    write_scene(g, out);
    if (g->primitives.count)
        write_geometry(g, out);
    if (g->images.count)
        write_images(g, out);
    if (g->views.count) {
        key(out, "bufferViews");
        text_add(out, "[");
        for (uint32_t i = 0; i < g->views.count && !stopped(g, i); i++) {
            separate(out, i);
            write_view(&g->views.at[i], out);
        }
        text_add(out, "],\"buffers\":[{\"byteLength\":");
        text_format(out, "%llu}]", (unsigned long long)g->binary_size);
    }
    text_add(out, "}");
}

uint64_t glb_json_estimate(const glb *g)
{
    text now = {.arena = g->arena};
    uint64_t node = g->by_entity ? REFERENCE_BYTES : 0;
    glb_json(g, &now);
    return now.length + g->primitives_expected * PRIMITIVE_BYTES +
           2 * (uint64_t)g->materials_expected * MATERIAL_BYTES + g->nodes.count * node +
           SPARE_BYTES;
}

/* glb.c - glTF 2.0 in its binary form: plans nodes and meshes, then streams vertices and
 * indices.
 *
 * Planning looks at entities only; streaming looks at each face once. Vertices and indices go
 * straight from the meshes to the blocks that are written. glb.h says what the file is made of.
 */
#include "stdlib/io/glb.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "glTF is little-endian, and this writes memory as it is"
#endif

enum {
    PRIMITIVE_VERTICES = 65535,  /* indices take 2 bytes, and none is the one that restarts */
    PIECE_SIZE = 1 << 20,        /* of what is held in memory */
    HELD_MAX = 4 << 20,          /* more is streamed */
    AHEAD = 8,                   /* entities that are fetched before they are needed */
    RESERVING_MATERIALS = 64,    /* with more, blocks begin small */
    GLB_MAGIC = 0x46546c67, GLB_VERSION = 2, GLB_JSON = 0x4e4f534a, GLB_BINARY = 0x004e4942,
    GLB_HEADS = 12 + 8 + 8       /* of the file and of its two chunks */
};

/* ---- the binary part ------------------------------------------------------------------------- */

static void put_word(unsigned char *to, uint64_t word)
{
    uint32_t narrow = (uint32_t)word;
    memcpy(to, &narrow, sizeof narrow);
}

static void put_spaces(io_output *o, uint64_t count)
{
    char spaces[256];
    memset(spaces, ' ', sizeof spaces);
    for (; count > sizeof spaces; count -= sizeof spaces)
        output_bytes(o, spaces, sizeof spaces);
    output_bytes(o, spaces, (size_t)count);
}

/* The heads of the file and of the text chunk. */
static void put_heads(glb *g, unsigned char out[20], uint64_t room)
{
    uint64_t binary = g->binary_size ? 8 + g->binary_size : 0;
    put_word(out, GLB_MAGIC);
    put_word(out + 4, GLB_VERSION);
    put_word(out + 8, 20 + room + binary);
    put_word(out + 12, room);
    put_word(out + 16, GLB_JSON);
}

static void put_binary_head(glb *g, unsigned char out[8])
{
    put_word(out, g->binary_size);
    put_word(out + 4, GLB_BINARY);
}

static void write_held(glb *g)
{
    for (uint32_t i = 0; i < g->held.count; i++)
        output_bytes(g->out, g->held.at[i].bytes, g->held.at[i].size);
    g->held.count = 0;
}

static void begin_streaming(glb *g)
{
    unsigned char head[8] = {0};
    g->streaming = true;
    g->text_room = (glb_json_estimate(g) + 3) / 4 * 4;
    put_spaces(g->out, 20 + g->text_room);
    output_bytes(g->out, head, sizeof head);
    write_held(g);
}

static void hold(glb *g, const void *bytes, size_t size)
{
    while (size) {
        struct glb_piece *last = g->held.count ? &g->held.at[g->held.count - 1] : NULL;
        if (!last || last->size == PIECE_SIZE) {
            struct glb_piece piece = {.bytes = arena_alloc(g->arena, PIECE_SIZE)};
            LIST_ADD(g->arena, &g->held, piece);
            last = &g->held.at[g->held.count - 1];
        }
        size_t part = PIECE_SIZE - last->size < size ? PIECE_SIZE - last->size : size;
        memcpy(last->bytes + last->size, bytes, part);
        last->size += part;
        bytes = (const char *)bytes + part;
        size -= part;
    }
}

/* Lengths in the file are 32 bits. */
static void check_size(glb *g)
{
    if (g->binary_size + g->text_room + GLB_HEADS > UINT32_MAX)
        io_fail(g->job, PCG_STATUS_FAILED,
                "'%s' would have more than the 4 GiB that a GLB can have; write .obj instead",
                g->out->path);
}

static void put_binary(glb *g, const void *bytes, size_t size)
{
    if (!g->streaming && g->binary_size + size > HELD_MAX && output_patchable(g->out))
        begin_streaming(g);
    if (g->streaming)
        output_bytes(g->out, bytes, size);
    else
        hold(g, bytes, size);
    g->binary_size += size;
    check_size(g);
}

/* Data begins at multiples of 4. */
static uint32_t put_view(glb *g, const void *bytes, size_t size, glb_view view)
{
    static const unsigned char zeros[4];
    view.offset = g->binary_size;
    view.size = size;
    LIST_ADD(g->arena, &g->views, view);
    put_binary(g, bytes, size);
    put_binary(g, zeros, (4 - size % 4) % 4);
    return g->views.count - 1;
}

/* ---- materials and images -------------------------------------------------------------------- */

static uint32_t add_image(glb *g, const char *path)
{
    for (uint32_t i = 0; i < g->images.count; i++)
        if (strcmp(g->images.at[i].path, path) == 0)
            return g->images.at[i].bytes ? i : GLB_NONE;
    size_t size = 0;
    glb_image image = {.path = path};
    const unsigned char *bytes = image_file_read(g->job, path, &size);
    if (bytes) {
        image.kind = image_kind(bytes, size);
        image.bytes = image_file_strip(g->job, bytes, size, &image.size, &image.alpha);
        if (!image.bytes)
            result_warn(g->job->run, "the texture '%s' is damaged: its surfaces stay plain",
                        image_file_name(path));
    }
    LIST_ADD(g->arena, &g->images, image);
    return image.bytes ? g->images.count - 1 : GLB_NONE;
}

/* The material of all that differ from this one in their colour alone. */
static glb_material *find_common(glb *g, const pcg_material *look)
{
    const char *key = arena_format(g->arena, "%a %a %d", look->metallic, look->roughness,
                                   look->color.a < 1);
    glb_material *m = table_get(&g->commons, key);
    if (!m) {
        m = ARENA_NEW(g->arena, glb_material);
        *m = (glb_material){.look = look, .colored = true, .image = GLB_NONE};
        memset(m->written, 0xff, sizeof m->written);
        table_put(g->arena, &g->commons, key, m);
    }
    m->members++;
    return m;
}

/* Once there are many materials, in what has no nodes for entities. Those that much of it has stay
 * as they are: they are few, and their vertices need no colours. */
static void merge_materials(glb *g)
{
    g->materials_expected = g->materials.count;
    if (g->by_entity || g->materials.count <= IO_GLB_LOOKS_MAX)
        return;
    for (uint32_t i = 0; i < g->materials.count; i++) {
        glb_material *m = g->materials.at[i];
        if (m->image != GLB_NONE || m->corners * IO_GLB_LOOKS_MAX > g->vertices_expected)
            continue;
        m->common = find_common(g, m->look);
        g->materials_expected--;
    }
    for (uint32_t i = 0; i < g->materials.count; i++) {
        glb_material *m = g->materials.at[i];
        if (m->common && m->common->members == 1) /* has nothing to share with others */
            m->common = NULL;
    }
    g->materials_expected += g->commons.entries.count;
}

/* What is met only after the plan is the material of edges or points, which show no texture. */
static glb_material *find_material(glb *g, const pcg_material *look)
{
    uint32_t number = io_pointer_number(g->arena, &g->looks, look);
    if (number < g->materials.count)
        return g->materials.at[number];
    glb_material *m = ARENA_NEW(g->arena, glb_material);
    bool image = look->texture && *look->texture && !g->planned;
    m->look = look;
    m->image = image ? add_image(g, look->texture) : GLB_NONE;
    m->written[0][0] = m->written[0][1] = m->written[1][0] = m->written[1][1] = GLB_NONE;
    LIST_ADD(g->arena, &g->materials, m);
    if (g->planned && !g->by_entity && number >= IO_GLB_LOOKS_MAX)
        m->common = find_common(g, look);
    return m;
}

static uint32_t written_material(glb *g, glb_material *m, bool two_sided, bool textured)
{
    textured = textured && m->image != GLB_NONE;
    uint32_t *number = &m->written[two_sided][textured];
    if (*number == GLB_NONE) {
        glb_written w = {m, two_sided, textured};
        *number = g->written.count;
        LIST_ADD(g->arena, &g->written, w);
    }
    return *number;
}

/* ---- primitives ------------------------------------------------------------------------------ */

static uint32_t put_indices(glb *g, const io_batch *b, bool wide)
{
    glb_view view = {.indices = true};
    if (wide)
        return put_view(g, b->indices, b->index_count * sizeof *b->indices, view);
    if (b->index_count > g->narrow_capacity) {
        g->narrow_capacity = b->index_capacity;
        g->narrow = ARENA_ARRAY(g->arena, uint16_t, g->narrow_capacity);
    }
    for (uint32_t i = 0; i < b->index_count; i++)
        g->narrow[i] = (uint16_t)b->indices[i];
    return put_view(g, g->narrow, b->index_count * sizeof *g->narrow, view);
}

/* Writes what a bucket holds as a primitive of the mesh that is being streamed, and empties it. */
static void close_primitive(glb *g, glb_bucket *k)
{
    io_batch *b = &k->batch;
    if (!b->vertex_count)
        return;
    glb_primitive p = {.mode = k->mode, .stride = b->stride, .indices = GLB_NONE};
    glb_view view = {.vertices = true, .stride = b->stride * (uint32_t)sizeof(float)};
    p.material = written_material(g, k->material, k->two_sided, k->textured);
    p.vertex_count = b->vertex_count;
    p.index_count = b->index_count;
    p.wide = b->vertex_count > PRIMITIVE_VERTICES;
    p.colored = k->colored;
    batch_bound(b);
    memcpy(p.low, b->low, sizeof p.low);
    memcpy(p.high, b->high, sizeof p.high);
    p.vertices = put_view(g, b->vertices, b->vertex_count * b->stride * sizeof(float), view);
    if (b->index_count)
        p.indices = put_indices(g, b, p.wide);
    LIST_ADD(g->arena, &g->primitives, p);
    b->vertex_count = b->index_count = b->bounded = 0;
}

static glb_bucket *new_bucket(glb *g, glb_bucket like)
{
    glb_bucket *k = ARENA_NEW(g->arena, glb_bucket);
    *k = like;
    if (!g->by_entity && g->materials.count <= RESERVING_MATERIALS)
        batch_reserve(g->job, &k->batch, PRIMITIVE_VERTICES, 2 * PRIMITIVE_VERTICES);
    return k;
}

/* The bucket takes part in the mesh that is being streamed. */
static glb_bucket *touch(glb *g, glb_bucket **at, glb_bucket like)
{
    glb_bucket *k = *at ? *at : (*at = new_bucket(g, like));
    if (!k->touched)
        LIST_ADD(g->arena, &g->touched, k);
    k->touched = true;
    return k;
}

/* Makes room for so many more vertices. */
static io_batch *make_room(glb *g, glb_bucket *k, uint32_t vertices)
{
    if (k->batch.vertex_count + (uint64_t)vertices > PRIMITIVE_VERTICES)
        close_primitive(g, k);
    return &k->batch;
}

static bool mesh_closed(glb *g, const pcg_mesh *m)
{
    if (g->last_mesh != m) {
        g->last_mesh = m;
        g->last_closed = tessellate_closed(m);
    }
    return g->last_closed;
}

/* A colour takes the place of uv: four linear 16-bit numbers. */
typedef struct color_bits {
    uint16_t at[4];
} color_bits;
enum { COLOR_FLOATS = sizeof(color_bits) / sizeof(float) };
static_assert(IO_PLAIN + COLOR_FLOATS == IO_TEXTURED, "a colour is as large as uv");

static uint16_t color_part(double x)
{
    return (uint16_t)((x > 0 ? x < 1 ? x : 1 : 0) * UINT16_MAX + 0.5);
}

static color_bits color_of(const pcg_material *look)
{
    return (color_bits){{color_part(color_linear(look->color.r)),
                         color_part(color_linear(look->color.g)),
                         color_part(color_linear(look->color.b)), color_part(look->color.a)}};
}

/* Of the vertices from one on. */
static void put_colors(const io_batch *b, uint32_t from, const color_bits *color)
{
    for (uint32_t v = from; v < b->vertex_count; v++)
        memcpy(b->vertices + (size_t)b->stride * (v + 1) - COLOR_FLOATS, color, sizeof *color);
}

static glb_bucket *face_bucket(glb *g, const pcg_material *look, bool open, bool textured)
{
    glb_material *material = find_material(g, look);
    bool two_sided = open || look->two_sided, colored = material->common;
    material = colored ? material->common : material;
    textured = textured && !colored;
    const glb_bucket like = {.batch.stride = textured || colored ? IO_TEXTURED : IO_PLAIN,
                             .colored = colored,
                             .mode = GLB_TRIANGLES,
                             .material = material,
                             .two_sided = two_sided,
                             .textured = textured};
    return touch(g, &material->triangles[two_sided][textured], like);
}

/* All faces at once; false where they have to go one by one. */
static bool stream_stamp(glb *g, const pcg_shape *s)
{
    const io_stamp *stamp = stamp_find(g->stamps, &g->tessellator, s);
    if (!stamp)
        return false;
    const pcg_material *look = io_material(s, 0);
    glb_bucket *k = face_bucket(g, look, !stamp->closed, s->mesh->corner_uv != NULL);
    io_batch *b = make_room(g, k, stamp->vertices);
    uint32_t first = b->vertex_count;
    if (!stamp_put(stamp, &g->tessellator, s, b))
        return false;
    if (k->colored) {
        color_bits color = color_of(look);
        put_colors(b, first, &color);
    }
    return true;
}

static void stream_faces(glb *g, const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    const pcg_material *last = NULL;
    glb_bucket *k = NULL;
    color_bits color = {{0}};
    bool open = m->face_count && !mesh_closed(g, m);
    for (uint32_t f = 0; f < m->face_count; f++) {
        const pcg_material *look = io_material(s, f);
        if (look != last)
            k = face_bucket(g, look, open, m->corner_uv != NULL);
        if (look != last && k->colored)
            color = color_of(look);
        last = look;
        io_batch *b = make_room(g, k, tessellate_face_corners(m, f));
        uint32_t first = b->vertex_count;
        tessellate_face(&g->tessellator, f, b);
        if (k->colored)
            put_colors(b, first, &color);
        if (f % 65536 == 65535 && io_stopped(g->job))
            return;
    }
}

static color_bits find_bare_buckets(glb *g, const pcg_material *look, glb_bucket **lines,
                                    glb_bucket **points)
{
    glb_material *material = find_material(g, look);
    bool colored = material->common;
    material = colored ? material->common : material;
    glb_bucket like = {.batch.stride = colored ? IO_BARE + COLOR_FLOATS : IO_BARE,
                       .material = material, .mode = GLB_LINES, .colored = colored};
    *lines = touch(g, &material->lines, like);
    like.mode = GLB_POINTS;
    *points = touch(g, &material->points, like);
    return color_of(look);
}

static void stream_loose(glb *g, const pcg_shape *s)
{
    const uint32_t *loose;
    uint32_t count = tessellate_loose(&g->tessellator, &loose);
    if (!count && !s->mesh->edge_count)
        return;
    glb_bucket *lines, *points;
    color_bits color = find_bare_buckets(g, io_material(s, UINT32_MAX), &lines, &points);
    for (uint32_t e = 0; e < s->mesh->edge_count; e++) {
        io_batch *b = make_room(g, lines, 2);
        uint32_t first = b->vertex_count;
        tessellate_edge(&g->tessellator, e, b);
        if (lines->colored)
            put_colors(b, first, &color);
    }
    for (uint32_t i = 0; i < count; i++) {
        io_batch *b = make_room(g, points, 1);
        uint32_t first = b->vertex_count;
        tessellate_point(&g->tessellator, loose[i], b);
        if (points->colored)
            put_colors(b, first, &color);
    }
}

static void stream_shape(glb *g, const pcg_shape *s)
{
    if (stream_stamp(g, s))
        return;
    tessellate_begin(&g->tessellator, s);
    stream_faces(g, s);
    if (!s->mesh->forever)
        stream_loose(g, s);
}

static void stream_mesh(glb *g, glb_mesh *m)
{
    g->tessellator.local = m->shared;
    m->first = g->primitives.count;
    if (m->shape) {
        stream_shape(g, m->shape);
    } else {
        const pcg_entities *list = result_entities(g->job->run, m->output);
        for (uint32_t i = 0; i < list->count; i++) {
            __builtin_prefetch(list->at[i + AHEAD < list->count ? i + AHEAD : i]);
            const pcg_shape *s = io_shape(list->at[i]);
            if (s)
                stream_shape(g, s);
            if (i % 1024 == 0 && io_stopped(g->job))
                return;
        }
    }
    for (uint32_t i = 0; i < g->touched.count; i++) {
        close_primitive(g, g->touched.at[i]);
        g->touched.at[i]->touched = false;
    }
    g->touched.count = 0;
    m->count = g->primitives.count - m->first;
}

static void stream_meshes(glb *g)
{
    uint32_t written = 0;
    for (uint32_t i = 0; i < g->images.count; i++) {
        glb_image *image = &g->images.at[i];
        glb_view view = {0};
        image->view = put_view(g, image->bytes, image->size, view);
    }
    for (uint32_t i = 0; i < g->meshes.count && !io_stopped(g->job); i++) {
        glb_mesh *m = &g->meshes.at[i];
        stream_mesh(g, m);
        m->written = m->count ? written++ : GLB_NONE;
    }
}

/* ---- the plan -------------------------------------------------------------------------------- */

/* Whether a shape can stand where its scope does: a node's place is read in single precision, and
 * so are vertices; what is beyond that is left out as these are. */
static bool finite_scope(const pcg_scope *s)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += s->axis[i].x + s->axis[i].y + s->axis[i].z;
    return isfinite(sum) && fabs(s->origin.x) < IO_FARTHEST_PLACE &&
           fabs(s->origin.y) < IO_FARTHEST_PLACE && fabs(s->origin.z) < IO_FARTHEST_PLACE;
}

static bool same_size(pcg_vec3 a, pcg_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Whether both look the same, each in the frame of its scope. */
static bool same_shape(const pcg_shape *a, const pcg_shape *b)
{
    return a->mesh == b->mesh && a->material == b->material &&
           (!a->mesh->unit || same_size(a->scope.size, b->scope.size));
}

static uint64_t mix(uint64_t h, uint64_t word)
{
    h = (h ^ word) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 32;
}

static uint64_t double_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static uint64_t shape_hash(const pcg_shape *s)
{
    uint64_t h = mix(mix(0, (uintptr_t)s->mesh), (uintptr_t)s->material);
    if (s->mesh->unit)
        h = mix(mix(mix(h, double_bits(s->scope.size.x)), double_bits(s->scope.size.y)),
                double_bits(s->scope.size.z));
    return h;
}

static uint32_t add_mesh(glb *g, const pcg_shape *shape, const char *name, uint32_t output)
{
    glb_mesh m = {.shape = shape, .name = name, .output = output, .written = GLB_NONE};
    LIST_ADD(g->arena, &g->meshes, m);
    return g->meshes.count - 1;
}

/* The mesh of a shape: one that is planned already, where it looks the same. The table has room
 * for all. */
static uint32_t plan_mesh(glb *g, const pcg_shape *s, const char *name, uint32_t output)
{
    uint32_t mask = g->mesh_slot_count - 1;
    uint64_t at = shape_hash(s);
    if (!finite_scope(&s->scope))
        return add_mesh(g, s, name, output);
    for (; g->mesh_slots[at & mask]; at++) {
        glb_mesh *m = &g->meshes.at[g->mesh_slots[at & mask] - 1];
        if (same_shape(m->shape, s)) {
            m->shared = true;
            return g->mesh_slots[at & mask] - 1;
        }
    }
    uint32_t number = add_mesh(g, s, name, output);
    g->mesh_slots[at & mask] = number + 1;
    return number;
}

static const char *entity_extras(glb *g, const pcg_entity *e)
{
    const pcg_module *module = g->job->module;
    text out = {.arena = g->arena};
    if (!module->attribute_count)
        return NULL;
    for (uint32_t i = 0; i < module->attribute_count; i++) {
        text_add(&out, i ? "," : "{");
        text_quote(&out, module->attributes[i].name);
        text_add(&out, ":");
        result_attribute_json(g->job->run, e, &module->attributes[i], &out);
    }
    text_add(&out, "}");
    return out.at;
}

static uint32_t face_corners(const pcg_mesh *m, uint32_t face)
{
    return m->loop_corner[m->face_loop[face + 1]] - m->loop_corner[m->face_loop[face]];
}

/* Materials are met here first, so that images come before geometry. */
static void look_at_materials(glb *g, const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    const pcg_material *before = NULL;
    glb_material *material = NULL;
    uint64_t runs = 0;
    for (uint32_t f = 0; f < m->face_count; f++) {
        const pcg_material *look = io_material(s, f);
        if (look != before) {
            material = find_material(g, look);
            runs++;
            before = look;
        }
        material->corners += m->face_material ? face_corners(m, f) : m->corner_count;
        if (!m->face_material)
            break;
    }
    if (g->by_entity)
        g->primitives_expected += runs < g->materials.count ? runs : g->materials.count;
    g->vertices_expected += m->corner_count;
}

static void plan_entity(glb *g, const pcg_entity *e, uint32_t output)
{
    const pcg_shape *s = io_shape(e);
    if (s) {
        look_at_materials(g, s);
        io_extent_add(&g->extent, s);
    }
    if (!g->by_entity)
        return;
    glb_node n = {.name = e->maker ? e->maker->name : "entity", .mesh = GLB_NONE};
    n.extras = entity_extras(g, e);
    if (s && s->mesh->vertex_count) {
        n.mesh = plan_mesh(g, s, n.name, output);
        n.scope = &s->scope;
    }
    LIST_ADD(g->arena, &g->nodes, n);
}

static void plan_output(glb *g, uint32_t output)
{
    const pcg_entities *list = result_entities(g->job->run, output);
    const char *name = g->job->module->outputs[output].name;
    glb_node root = {.name = name, .mesh = GLB_NONE, .output = true};
    root.extras = arena_format(g->arena, "{\"entities\":%u}", list->count);
    if (!g->by_entity && list->count)
        root.mesh = add_mesh(g, NULL, name, output);
    LIST_ADD(g->arena, &g->nodes, root);
    for (uint32_t i = 0; i < list->count && !(i % 1024 == 0 && io_stopped(g->job)); i++)
        plan_entity(g, list->at[i], output);
}

static void plan(glb *g)
{
    io_job *j = g->job;
    uint64_t entities = io_entity_count(j);
    g->by_entity = j->options.entities || entities <= IO_GLB_NODES_MAX;
    g->mesh_slot_count = 64;
    while (g->by_entity && g->mesh_slot_count < 2 * entities)
        g->mesh_slot_count *= 2;
    g->mesh_slots = ARENA_ARRAY(g->arena, uint32_t, g->mesh_slot_count);
    for (uint32_t o = 0; o < j->module->output_count; o++)
        plan_output(g, o);
    merge_materials(g);
    g->primitives_expected += g->vertices_expected / (PRIMITIVE_VERTICES - 100);
    g->primitives_expected += g->by_entity ? 0 : g->materials_expected + g->meshes.count;
}

/* ---- the file -------------------------------------------------------------------------------- */

/* Puts the text where room was left for it; where that was too little, the rest makes way. */
static void finish_stream(glb *g, const text *json)
{
    unsigned char heads[20], binary_head[8];
    if (json->length > g->text_room) {
        output_shift(g->out, sizeof heads + g->text_room, json->length - g->text_room);
        g->text_room = json->length;
        check_size(g);
    }
    put_heads(g, heads, g->text_room);
    put_binary_head(g, binary_head);
    output_patch(g->out, 0, heads, sizeof heads);
    output_patch(g->out, sizeof heads, json->at, json->length);
    output_patch(g->out, sizeof heads + g->text_room, binary_head, sizeof binary_head);
}

static void finish(glb *g)
{
    unsigned char heads[20], binary_head[8];
    text json = {.arena = g->arena};
    glb_json(g, &json);
    if (io_stopped(g->job))
        return;
    io_repair_utf8(json.at, json.length);
    while (json.length % 4)
        text_add(&json, " ");
    if (g->streaming) {
        finish_stream(g, &json);
        return;
    }
    g->text_room = json.length;
    check_size(g);
    put_heads(g, heads, json.length);
    put_binary_head(g, binary_head);
    output_bytes(g->out, heads, sizeof heads);
    output_bytes(g->out, json.at, json.length);
    if (g->binary_size)
        output_bytes(g->out, binary_head, sizeof binary_head);
    write_held(g);
}

/* Images that could not be read were counted too: they leave, and the others close up. */
static void drop_missing_images(glb *g)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < g->images.count; i++) {
        if (!g->images.at[i].bytes)
            continue;
        for (uint32_t m = 0; m < g->materials.count; m++)
            if (g->materials.at[m]->image == i)
                g->materials.at[m]->image = kept;
        g->images.at[kept++] = g->images.at[i];
    }
    g->images.count = kept;
}

void io_write_glb(io_job *j, const char *path)
{
    glb *g = ARENA_NEW(&j->memory, glb);
    g->job = j;
    g->arena = &j->memory;
    g->out = output_open(j, path);
    g->stamps = ARENA_NEW(g->arena, io_stamps);
    g->tessellator = (io_tessellator){.job = j, .y_up = true, .flip_v = true};
    plan(g);
    g->tessellator.center = io_extent_center(&g->extent);
    drop_missing_images(g);
    g->planned = true;
    stream_meshes(g);
    tessellate_end(&g->tessellator);
    if (!io_stopped(j))
        finish(g);
}

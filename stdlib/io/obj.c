/* obj.c - Wavefront OBJ with its material library and textures beside it.
 *
 * Faces stay polygons, except those with holes, which the format does not have. One object (o)
 * per output, one group (g) per making node. y is up, as in GLB; coordinates have six decimals,
 * that is, micrometres. house.obj comes with house.mtl and with copies of its textures,
 * house_<name>: nothing refers to another folder.
 */
#include "stdlib/io/io.h"

#include <math.h>
#include <string.h>

typedef struct obj_material {
    const pcg_material *look;
    const char *name;
} obj_material;

typedef struct obj {
    io_job *job;
    arena *arena;
    io_output *out;
    const char *stem;            /* the path without .obj; NULL: nothing can be beside the file */
    io_tessellator tessellator;
    uint64_t vertices, uvs, normals; /* written so far: indices count from 1 over the whole file */
    uint32_t *index;             /* of the shape's vertices, from 0; UINT32_MAX: left out */
    uint32_t index_capacity;
    const pcg_material *current; /* of the last usemtl */
    const char *group;           /* of the last g */
    io_pointers looks;
    LIST(obj_material) materials; /* by number of the look */
    table names, files;          /* names that are taken; textures' copies by path */
} obj;

/* ---- numbers --------------------------------------------------------------------------------- */

static char *put_whole(char *to, uint64_t x)
{
    char digits[24];
    int count = 0;
    do {
        digits[count++] = (char)('0' + x % 10);
        x /= 10;
    } while (x);
    while (count)
        *to++ = digits[--count];
    return to;
}

/* Six decimals at most, none of them trailing zeros. */
static char *put_number(char *to, double x)
{
    double scaled = floor(fabs(x) * 1e6 + 0.5);
    if (!(scaled < 9e15)) { /* too large to have decimals */
        int length = snprintf(to, 400, "%.0f", x);
        return to + (length > 0 ? length : 0);
    }
    uint64_t whole = (uint64_t)scaled, rest = whole % 1000000;
    if (x < 0 && whole)
        *to++ = '-';
    to = put_whole(to, whole / 1000000);
    if (!rest)
        return to;
    *to++ = '.';
    for (uint64_t place = 100000; rest; place /= 10) {
        *to++ = (char)('0' + rest / place);
        rest %= place;
    }
    return to;
}

static char *put_word(char *to, const char *word)
{
    size_t length = strlen(word);
    memcpy(to, word, length);
    return to + length;
}

/* `word` and the numbers as a line. Numbers of the world may take 310 digits each: line by line. */
static void write_numbers(obj *o, const char *word, const double *x, int count)
{
    char line[3 * 400], *to = put_word(line, word);
    for (int i = 0; i < count; i++) {
        *to++ = ' ';
        to = put_number(to, isfinite(x[i]) ? x[i] : 0);
    }
    *to++ = '\n';
    output_bytes(o->out, line, (size_t)(to - line));
}

/* ---- names ----------------------------------------------------------------------------------- */

/* A word that the format can hold: without spaces and control characters. */
static char *word_of(arena *a, const char *name, const char *otherwise)
{
    char *word = arena_format(a, "%s", name && *name ? name : otherwise);
    for (char *s = word; *s; s++)
        if ((unsigned char)*s <= ' ' || *s == 0x7f || *s == '#')
            *s = '_';
    return word;
}

/* The word, or with _2, _3 … before its extension where another has it already. */
static const char *unique_word(obj *o, const char *word)
{
    uint32_t *number = table_get(&o->names, word); /* that was given to it last */
    if (!number) {
        table_put(o->arena, &o->names, word, number = ARENA_NEW(o->arena, uint32_t));
        *number = 1;
        return word;
    }
    const char *dot = strrchr(word, '.'), *result;
    int length = (int)(dot ? (size_t)(dot - word) : strlen(word));
    do {
        result = arena_format(o->arena, "%.*s_%u%s", length, word, ++*number, dot ? dot : "");
    } while (table_get(&o->names, result));
    return unique_word(o, result);
}

static const char *material_name(obj *o, const pcg_material *look)
{
    uint32_t number = io_pointer_number(o->arena, &o->looks, look);
    if (number == o->materials.count) {
        obj_material m = {look, unique_word(o, word_of(o->arena, look->name, "material"))};
        LIST_ADD(o->arena, &o->materials, m);
    }
    return o->materials.at[number].name;
}

/* ---- geometry -------------------------------------------------------------------------------- */

static void use_material(obj *o, const pcg_material *look)
{
    if (o->current == look)
        return;
    o->current = look;
    output_text(o->out, "usemtl ");
    output_text(o->out, material_name(o, look));
    output_text(o->out, "\n");
}

static void write_vertices(obj *o, const pcg_mesh *m)
{
    uint32_t written = 0;
    if (m->vertex_count > o->index_capacity) {
        o->index_capacity = m->vertex_count;
        o->index = ARENA_ARRAY(o->arena, uint32_t, o->index_capacity);
    }
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        o->index[v] = UINT32_MAX;
        if (o->tessellator.bad[v])
            continue;
        o->index[v] = written++;
        write_numbers(o, "v", o->tessellator.world + 3 * (size_t)v, 3);
    }
}

/* uv and normals as the corners have them: corner c of the mesh is number c behind what was
 * written before. */
static void write_streams(obj *o, const pcg_mesh *m)
{
    const double(*turn)[3] = (const double(*)[3])o->tessellator.turn;
    for (uint32_t c = 0; m->corner_uv && c < m->corner_count; c++) {
        const double uv[2] = {(double)m->corner_uv[2 * (size_t)c],
                              (double)m->corner_uv[2 * (size_t)c + 1]};
        write_numbers(o, "vt", uv, 2);
    }
    for (uint32_t c = 0; m->corner_normal && c < m->corner_count; c++) {
        const float *n = m->corner_normal + 3 * (size_t)c;
        double normal[3];
        for (int i = 0; i < 3; i++)
            normal[i] = turn[i][0] * (double)n[0] + turn[i][1] * (double)n[1] +
                        turn[i][2] * (double)n[2];
        write_numbers(o, "vn", normal, 3);
    }
}

/* " v", " v/vt", " v//vn" or " v/vt/vn". */
static void write_corner(obj *o, const pcg_mesh *m, uint32_t corner)
{
    char line[96], *to = line;
    *to++ = ' ';
    to = put_whole(to, o->vertices + o->index[m->corner_vertex[corner]] + 1);
    if (m->corner_uv || m->corner_normal)
        *to++ = '/';
    if (m->corner_uv)
        to = put_whole(to, o->uvs + corner + 1);
    if (m->corner_normal) {
        *to++ = '/';
        to = put_whole(to, o->normals + corner + 1);
    }
    output_bytes(o->out, line, (size_t)(to - line));
}

static void write_face(obj *o, const pcg_shape *s, uint32_t face)
{
    const pcg_mesh *m = s->mesh;
    uint32_t first = m->loop_corner[m->face_loop[face]], end;
    const uint32_t *corners;
    double normal[3];
    if (m->face_loop[face + 1] - m->face_loop[face] > 1) {
        uint32_t triangles = tessellate_cut(&o->tessellator, face, &corners, normal);
        for (uint32_t i = 0; i < 3 * triangles; i++) {
            if (i % 3 == 0)
                output_text(o->out, "f");
            write_corner(o, m, first + corners[i]);
            if (i % 3 == 2)
                output_text(o->out, "\n");
        }
        return;
    }
    if (!tessellate_usable(&o->tessellator, face))
        return;
    end = m->loop_corner[m->face_loop[face + 1]];
    output_text(o->out, "f");
    for (uint32_t c = first; c < end; c++)
        write_corner(o, m, c);
    output_text(o->out, "\n");
}

/* A line or point element: "l 1 2", "p 1". */
static void write_element(obj *o, const char *word, const uint32_t *vertices, int count)
{
    char line[96], *to = put_word(line, word);
    for (int i = 0; i < count; i++) {
        if (o->index[vertices[i]] == UINT32_MAX) {
            o->tessellator.not_finite++;
            return;
        }
        *to++ = ' ';
        to = put_whole(to, o->vertices + o->index[vertices[i]] + 1);
    }
    *to++ = '\n';
    output_bytes(o->out, line, (size_t)(to - line));
}

static void write_loose(obj *o, const pcg_shape *s)
{
    const uint32_t *loose;
    uint32_t count = tessellate_loose(&o->tessellator, &loose);
    if (count || s->mesh->edge_count)
        use_material(o, io_material(s, UINT32_MAX));
    for (uint32_t e = 0; e < s->mesh->edge_count; e++)
        write_element(o, "l", s->mesh->edge_vertex + 2 * (size_t)e, 2);
    for (uint32_t i = 0; i < count; i++)
        write_element(o, "p", &loose[i], 1);
}

static void write_shape(obj *o, const pcg_shape *s)
{
    const pcg_mesh *m = s->mesh;
    const char *group = s->entity.maker ? s->entity.maker->name : "entity";
    if (!m->vertex_count)
        return;
    if (o->group != group) {
        output_text(o->out, "g ");
        output_text(o->out, word_of(o->arena, group, "entity"));
        output_text(o->out, "\n");
    }
    o->group = group;
    tessellate_begin(&o->tessellator, s);
    write_vertices(o, m);
    write_streams(o, m);
    for (uint32_t f = 0; f < m->face_count; f++) {
        use_material(o, io_material(s, f));
        write_face(o, s, f);
    }
    write_loose(o, s);
    for (uint32_t v = 0; v < m->vertex_count; v++)
        o->vertices += o->index[v] != UINT32_MAX;
    o->uvs += m->corner_uv ? m->corner_count : 0;
    o->normals += m->corner_normal ? m->corner_count : 0;
}

static void write_output(obj *o, uint32_t output)
{
    const pcg_entities *list = result_entities(o->job->run, output);
    output_text(o->out, "o ");
    output_text(o->out, word_of(o->arena, o->job->module->outputs[output].name, "output"));
    output_text(o->out, "\n");
    o->group = NULL;
    for (uint32_t i = 0; i < list->count; i++) {
        const pcg_shape *s = io_shape(list->at[i]);
        if (s)
            write_shape(o, s);
        if (i % 256 == 0 && io_stopped(o->job))
            return;
    }
}

/* ---- materials ------------------------------------------------------------------------------- */

/* Copies a texture beside the file; returns the copy's name without folders, NULL where it
 * cannot be read. */
static const char *copy_texture(obj *o, const char *path)
{
    char *copy = table_get(&o->files, path);
    if (copy)
        return *copy ? copy : NULL;
    size_t size;
    const unsigned char *bytes = image_file_read(o->job, path, &size);
    const char *name = "";
    if (bytes) {
        const char *word = word_of(o->arena, image_file_name(path), "texture");
        const char *stem = word_of(o->arena, image_file_name(o->stem), "model");
        name = unique_word(o, arena_format(o->arena, "%s_%s", stem, word));
        int folder = (int)(image_file_name(o->stem) - o->stem);
        io_output *out =
            output_open(o->job, arena_format(o->arena, "%.*s%s", folder, o->stem, name));
        output_bytes(out, bytes, size);
    }
    table_put(o->arena, &o->files, path, (void *)name);
    return *name ? name : NULL;
}

static double fraction(double x)
{
    return x > 0 ? x < 1 ? x : 1 : 0;
}

static void add_numbers(text *out, const char *word, const double *x, int count)
{
    text_add(out, word);
    for (int i = 0; i < count; i++) {
        char number[512];
        text_add(out, " ");
        text_add_bytes(out, number, (size_t)(put_number(number, fraction(x[i])) - number));
    }
    text_add(out, "\n");
}

/* Kd is what the material was given, as most programs read it; Pr and Pm are roughness and
 * metal. */
static void add_material(obj *o, const obj_material *m, text *out)
{
    const pcg_material *look = m->look;
    const double color[3] = {look->color.r, look->color.g, look->color.b}, none[3] = {0, 0, 0};
    text_format(out, "\nnewmtl %s\n", m->name);
    add_numbers(out, "Kd", color, 3);
    add_numbers(out, "Ks", none, 3);
    if (look->color.a < 1)
        add_numbers(out, "d", &look->color.a, 1);
    add_numbers(out, "Pr", &look->roughness, 1);
    add_numbers(out, "Pm", &look->metallic, 1);
    text_add(out, "illum 1\n");
    const char *texture = look->texture && *look->texture ? copy_texture(o, look->texture) : NULL;
    if (texture)
        text_format(out, "map_Kd %s\n", texture);
}

static void write_materials(obj *o)
{
    text out = {.arena = o->arena};
    if (!o->stem || !o->materials.count)
        return;
    text_add(&out, "# pcgc " PCG_VERSION "\n");
    for (uint32_t i = 0; i < o->materials.count; i++)
        add_material(o, &o->materials.at[i], &out);
    io_output *file = output_open(o->job, arena_format(o->arena, "%s.mtl", o->stem));
    output_bytes(file, out.at, out.length);
}

/* ---- the file -------------------------------------------------------------------------------- */

/* A stream has nothing beside it. */
static void find_stem(obj *o, const char *path)
{
    const char *dot = strrchr(image_file_name(path), '.');
    if (output_patchable(o->out))
        o->stem = arena_copy(o->arena, path, dot ? (size_t)(dot - path) : strlen(path));
}

/* As comments, "# origin.latitude 47.1": the format has no other place for them. */
static void write_properties(obj *o)
{
    pcg_run *r = o->job->run;
    const char *name;
    for (size_t i = 0; (name = pcg_run_property_key(r, i)) != NULL; i++) {
        output_text(o->out, "# ");
        output_text(o->out, name);
        output_text(o->out, " ");
        const char *value = pcg_run_property(r, name);
        for (char c[2] = {0}; value && (c[0] = *value); value++)
            output_bytes(o->out, (unsigned char)c[0] < ' ' ? " " : c, 1);
        output_text(o->out, "\n");
    }
}

void io_write_obj(io_job *j, const char *path)
{
    obj o = {.job = j, .arena = &j->memory, .out = output_open(j, path)};
    o.tessellator = (io_tessellator){.job = j, .y_up = true};
    find_stem(&o, path);
    output_text(o.out, "# pcgc " PCG_VERSION ": metres, y up\n");
    write_properties(&o);
    if (o.stem) {
        output_text(o.out, "mtllib ");
        output_text(o.out, image_file_name(o.stem));
        output_text(o.out, ".mtl\n");
    }
    for (uint32_t i = 0; i < j->module->output_count && !io_stopped(j); i++)
        write_output(&o, i);
    tessellate_end(&o.tessellator);
    write_materials(&o);
}

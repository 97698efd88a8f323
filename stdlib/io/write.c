/* write.c - pcg_run_write: picks the writer, and ends what it began. */
#include "stdlib/io/io.h"

#include <math.h>
#include <string.h>

#include "stdlib/streets/streets.h"

enum { CENTER_BEYOND = 10000 }; /* metres: floats are a millimetre apart there */

typedef struct format {
    const char *name;
    void (*write)(io_job *j, const char *path);
} format;

static const format formats[] = {
    {"glb", io_write_glb},
    {"obj", io_write_obj},
    {"png", io_write_picture},
    {"json", io_write_json},
    {"csv", io_write_csv},
};

/* ---- what writers ask of a job --------------------------------------------------------------- */

void io_fail(io_job *j, pcg_status status, const char *format_, ...)
{
    char line[1024];
    va_list arguments;
    if (j->status != PCG_STATUS_OK)
        return;
    va_start(arguments, format_);
    vsnprintf(line, sizeof line, format_, arguments);
    va_end(arguments);
    j->status = result_fail(j->run, status, "%s", line);
}

bool io_stopped(io_job *j)
{
    if (j->status == PCG_STATUS_OK && result_cancelled(j->run))
        io_fail(j, PCG_STATUS_CANCELLED, "cancelled");
    return j->status != PCG_STATUS_OK;
}

pcg_triangulator *io_triangulator(io_job *j)
{
    if (!j->triangulator)
        j->triangulator = pcg_triangulator_new();
    if (!j->triangulator)
        longjmp(j->out_of_memory, 1);
    return j->triangulator;
}

/* Most entities are plain shapes. */
const pcg_shape *io_shape(const pcg_entity *e)
{
    bool is = e->type == &pcg_type_shape || pcg_entity_is(e, &pcg_type_shape);
    return is ? (const pcg_shape *)(const void *)e : NULL;
}

const struct street_drawing *io_network(const pcg_entity *e)
{
    return e->type != &pcg_type_shape && pcg_entity_is(e, &pcg_type_street_network)
               ? ((const pcg_streets *)(const void *)e)->drawing
               : NULL;
}

const pcg_material *io_material(const pcg_shape *s, uint32_t face)
{
    const pcg_material *own =
        face != UINT32_MAX && s->mesh->face_material ? s->mesh->face_material[face] : NULL;
    return own ? own : s->material ? s->material : &pcg_material_default;
}

uint64_t io_entity_count(const io_job *j)
{
    uint64_t count = 0;
    for (uint32_t o = 0; o < j->module->output_count; o++)
        count += result_entities(j->run, o)->count;
    return count;
}

void io_extent_add(io_extent *e, const pcg_shape *s)
{
    pcg_vec3 p = s->scope.origin, *low = &e->low, *high = &e->high;
    if (!(fmax(fmax(fabs(p.x), fabs(p.y)), fabs(p.z)) < IO_FARTHEST_PLACE) ||
        isnan(p.x + p.y + p.z))
        return;
    if (!e->any) {
        *low = *high = p;
        e->any = true;
    }
    *low = vec3(p.x < low->x ? p.x : low->x, p.y < low->y ? p.y : low->y,
                p.z < low->z ? p.z : low->z);
    *high = vec3(p.x > high->x ? p.x : high->x, p.y > high->y ? p.y : high->y,
                 p.z > high->z ? p.z : high->z);
}

pcg_vec3 io_extent_center(const io_extent *e)
{
    pcg_vec3 low = e->low, high = e->high;
    double farthest = fmax(fmax(fmax(-low.x, high.x), fmax(-low.y, high.y)), fmax(-low.z, high.z));
    if (!e->any || !(farthest > CENTER_BEYOND))
        return vec3(0, 0, 0);
    return vec3(floor(low.x / 2 + high.x / 2), floor(low.y / 2 + high.y / 2),
                floor(low.z / 2 + high.z / 2));
}

/* How many bytes the character has that begins here; 0 where none does. */
static size_t utf8_length(const unsigned char *s, size_t left)
{
    size_t length = s[0] < 0x80         ? 1
                    : s[0] >> 5 == 0x06 ? 2
                    : s[0] >> 4 == 0x0e ? 3
                    : s[0] >> 3 == 0x1e ? 4
                                        : 0;
    if (!length || length > left)
        return 0;
    for (size_t i = 1; i < length; i++)
        if (s[i] >> 6 != 2)
            return 0;
    bool overlong = (length == 2 && s[0] < 0xc2) || (length == 3 && s[0] == 0xe0 && s[1] < 0xa0) ||
                    (length == 4 && s[0] == 0xf0 && s[1] < 0x90);
    bool outside = (length == 3 && s[0] == 0xed && s[1] > 0x9f) ||
                   (length == 4 && (s[0] > 0xf4 || (s[0] == 0xf4 && s[1] > 0x8f)));
    return overlong || outside ? 0 : length;
}

void io_repair_utf8(char *bytes, size_t length)
{
    for (size_t i = 0; i < length;) {
        size_t step = utf8_length((const unsigned char *)bytes + i, length - i);
        if (!step)
            bytes[i] = '?';
        i += step ? step : 1;
    }
}

/* ---- the job --------------------------------------------------------------------------------- */

static bool same_name(const char *a, const char *b)
{
    for (; *a && *b; a++, b++) {
        char x = *a >= 'A' && *a <= 'Z' ? (char)(*a + 'a' - 'A') : *a;
        if (x != *b)
            return false;
    }
    return !*a && !*b;
}

static const format *find_format(const char *path, const char *name)
{
    if (!name) {
        const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
        name = dot ? dot + 1 : "";
    }
    for (size_t i = 0; i < COUNT_OF(formats); i++)
        if (same_name(name, formats[i].name))
            return &formats[i];
    return NULL;
}

/* What the caller filled in of the options as they were when it was compiled. */
static pcg_write_options complete_options(const pcg_write_options *given)
{
    pcg_write_options o = {.size = sizeof o};
    if (given)
        memcpy(&o, given, given->size < sizeof o ? given->size : sizeof o);
    o.size = sizeof o;
    if (!o.width && !o.height)
        o.width = 1280;
    if (!o.height)
        o.height = (uint32_t)((uint64_t)o.width * 3 / 4) + (o.width < 2);
    if (!o.width)
        o.width = (uint32_t)((uint64_t)o.height * 4 / 3 & UINT32_MAX);
    return o;
}

/* Models and pictures hold surfaces; a network has none of its own. */
static void warn_of_networks(const io_job *j)
{
    uint64_t count = 0;
    for (uint32_t o = 0; o < j->module->output_count; o++) {
        const pcg_entities *list = result_entities(j->run, o);
        for (uint32_t i = 0; i < list->count; i++)
            count += io_network(list->at[i]) != NULL;
    }
    if (count)
        result_warn(j->run,
                    "%llu street network%s left out of the file: 'street_to_shape' makes shapes of "
                    "%s",
                    (unsigned long long)count, count == 1 ? " is" : "s are",
                    count == 1 ? "it" : "them");
}

static void run_job(io_job *j, const format *f, const char *path)
{
    if (setjmp(j->out_of_memory) == 0) {
        j->memory.on_failure = &j->out_of_memory;
        if (f->write != io_write_json)
            warn_of_networks(j);
        if (!io_stopped(j))
            f->write(j, path);
        outputs_end(j);
    } else {
        io_fail(j, PCG_STATUS_LIMIT, "no memory is left to write '%s'", path);
        outputs_discard(j);
    }
    if (j->triangulator)
        pcg_triangulator_free(j->triangulator);
    image_libraries_close(j);
    arena_free(&j->memory);
}

pcg_status pcg_run_write(pcg_run *r, const char *path, const char *format_name,
                         const pcg_write_options *options)
{
    if (!r)
        return PCG_STATUS_MISUSE;
    if (!path || !*path)
        return result_fail(r, PCG_STATUS_MISUSE, "no file is named to write to");
    if (!result_ready(r))
        return result_fail(r, PCG_STATUS_MISUSE, "the graph has not run yet: nothing to write");
    const format *f = find_format(path, format_name);
    if (!f)
        return result_fail(r, PCG_STATUS_MISUSE,
                           format_name ? "unknown format '%s'; there are glb, obj, png, json and csv"
                                       : "the name '%s' does not say in which format; "
                                         "end it with .glb, .obj, .png, .json or .csv, or name one",
                           format_name ? format_name : path);
    io_job j = {.run = r, .module = result_module(r), .options = complete_options(options)};
    run_job(&j, f, path);
    return j.status;
}

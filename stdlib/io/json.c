/* json.c - what came out of which port, as `pcgc run --json` prints it: one object on one line.
 *
 * Keys stand in a fixed order and numbers in their shortest form, so that equal results are
 * equal bytes. Coordinates are the world's: metres, z up.
 */
#include "stdlib/io/io.h"

#include <math.h>
#include <string.h>

#include "runtime/part.h"
#include "stdlib/streets/streets.h"

enum { FLUSH_AT = 1 << 16 };

typedef struct json {
    io_job *job;
    io_output *out;
    text text;                   /* what is not written yet */
} json;

/* Sums over entities. */
typedef struct measures {
    uint64_t faces, vertices, holes;
    double area, volume;
    pcg_vec3 low, high;
} measures;

static const measures nothing = {.low = {INFINITY, INFINITY, INFINITY},
                                 .high = {-INFINITY, -INFINITY, -INFINITY}};

static void flush(json *w)
{
    if (w->text.length)
        io_repair_utf8(w->text.at, w->text.length);
    output_bytes(w->out, w->text.at, w->text.length);
    w->text.length = 0;
}

/* ---- values ---------------------------------------------------------------------------------- */

static void key(json *w, const char *name, bool first)
{
    text_add(&w->text, first ? "" : ",");
    text_quote(&w->text, name);
    text_add(&w->text, ":");
}

static void string(json *w, const char *name, bool first, const char *value)
{
    key(w, name, first);
    if (value)
        text_quote(&w->text, value);
    else
        text_add(&w->text, "null");
}

static void whole(json *w, const char *name, uint64_t value)
{
    key(w, name, false);
    text_format(&w->text, "%llu", (unsigned long long)value);
}

static void number(json *w, double value)
{
    if (isfinite(value))
        text_number(&w->text, value + 0.0); /* no -0 */
    else
        text_add(&w->text, "null");
}

static void point(json *w, pcg_vec3 p)
{
    text_add(&w->text, "[");
    number(w, p.x);
    text_add(&w->text, ",");
    number(w, p.y);
    text_add(&w->text, ",");
    number(w, p.z);
    text_add(&w->text, "]");
}

static void bounds(json *w, const measures *m)
{
    key(w, "bounds", false);
    if (!(m->low.x <= m->high.x)) {
        text_add(&w->text, "null");
        return;
    }
    text_add(&w->text, "[");
    point(w, m->low);
    text_add(&w->text, ",");
    point(w, m->high);
    text_add(&w->text, "]");
}

/* ---- outputs --------------------------------------------------------------------------------- */

static measures measure(const pcg_shape *s)
{
    measures m = nothing;
    m.faces = s->mesh->face_count;
    m.vertices = s->mesh->vertex_count;
    m.holes = pcg_shape_holes(s);
    m.area = pcg_shape_area(s);
    m.volume = pcg_shape_volume(s);
    pcg_shape_bounds(s, &m.low, &m.high);
    if (!m.vertices)
        m.low = nothing.low;
    return m;
}

static void add(measures *sum, const measures *m)
{
    sum->faces += m->faces;
    sum->vertices += m->vertices;
    sum->holes += m->holes;
    sum->area += m->area;
    sum->volume += m->volume;
    if (!(m->low.x <= m->high.x))
        return;
    sum->low = vec3(fmin(sum->low.x, m->low.x), fmin(sum->low.y, m->low.y),
                    fmin(sum->low.z, m->low.z));
    sum->high = vec3(fmax(sum->high.x, m->high.x), fmax(sum->high.y, m->high.y),
                     fmax(sum->high.z, m->high.z));
}

/* Of street networks: how many ways, edges and vertices, and how long they are in all. */
static void networks(json *w, pcg_entity *const *entities, uint32_t count)
{
    uint64_t ways = 0, edges = 0, vertices = 0;
    double length = 0;
    for (uint32_t i = 0; i < count; i++) {
        const street_drawing *d = io_network(entities[i]);
        ways += d ? d->ways : 0;
        edges += d ? d->edges : 0;
        vertices += d ? d->vertices : 0;
        length += d ? drawing_length(d) : 0;
    }
    whole(w, "ways", ways);
    whole(w, "edges", edges);
    whole(w, "vertices", vertices);
    key(w, "length", false);
    number(w, length);
}

static void attributes(json *w, const pcg_entity *e)
{
    const pcg_module *module = w->job->module;
    key(w, "attributes", false);
    text_add(&w->text, "{");
    for (uint32_t i = 0; i < module->attribute_count; i++) {
        key(w, module->attributes[i].name, i == 0);
        result_attribute_json(w->job->run, e, &module->attributes[i], &w->text);
    }
    text_add(&w->text, "}");
}

/* Which of its shape it is, and where; null: of no shape any more. */
static void part(json *w, const pcg_part *p)
{
    const pcg_shape *s = part_shape(p);
    measures m = nothing;
    for (uint32_t i = 0; s && i < part_place_count(p); i++) {
        pcg_vec3 at = pcg_shape_world(s, part_place_vertex(s, part_place(p, i)));
        const measures corner = {.low = at, .high = at};
        add(&m, &corner);
    }
    whole(w, "index", p->index);
    bounds(w, &m);
}

static void entity(json *w, const pcg_entity *e)
{
    const pcg_shape *s = io_shape(e);
    text_add(&w->text, "{");
    string(w, "node", true, e->maker ? e->maker->name : NULL);
    string(w, "type", false, e->type->name);
    if (s) {
        measures m = measure(s);
        whole(w, "faces", m.faces);
        key(w, "area", false);
        number(w, m.area);
        bounds(w, &m);
    }
    if (part_is(e))
        part(w, (const pcg_part *)e);
    text_add(&w->text, ",");
    if (!result_path_json(w->job->run, e, &w->text))
        w->text.length--;
    if (io_network(e))
        networks(w, (pcg_entity *const[]){(pcg_entity *)(uintptr_t)e}, 1);
    attributes(w, e);
    text_add(&w->text, "}");
}

static void entities(json *w, const pcg_entities *list)
{
    key(w, "entities", false);
    text_add(&w->text, "[");
    for (uint32_t i = 0; i < list->count && !io_stopped(w->job); i++) {
        text_add(&w->text, i ? "," : "");
        entity(w, list->at[i]);
        if (w->text.length > FLUSH_AT)
            flush(w);
    }
    text_add(&w->text, "]");
}

/* By its declared type, or by what is there: a port of type Entity may carry shapes. */
static bool has_geometry(const pcg_port_info *port, const pcg_entities *list)
{
    if (strcmp(port->type, pcg_type_shape.name) == 0)
        return true;
    for (uint32_t i = 0; i < list->count; i++)
        if (io_shape(list->at[i]))
            return true;
    return false;
}

static void geometry(json *w, const pcg_entities *list)
{
    measures sum = nothing;
    for (uint32_t i = 0; i < list->count; i++) {
        const pcg_shape *s = io_shape(list->at[i]);
        if (s) {
            measures m = measure(s);
            add(&sum, &m);
        }
        if (i % 1024 == 0 && io_stopped(w->job))
            return;
    }
    whole(w, "faces", sum.faces);
    whole(w, "vertices", sum.vertices);
    whole(w, "holes", sum.holes);
    key(w, "area", false);
    number(w, sum.area);
    key(w, "volume", false);
    number(w, sum.volume);
    bounds(w, &sum);
}

static void output(json *w, uint32_t i)
{
    const pcg_port_info *port = &w->job->module->outputs[i];
    const pcg_entities *list = result_entities(w->job->run, i);
    text_add(&w->text, i ? ",{" : "{");
    string(w, "port", true, port->name);
    string(w, "type", false, port->type);
    whole(w, "count", list->count);
    if (has_geometry(port, list))
        geometry(w, list);
    else if (strcmp(port->type, pcg_type_street_network.name) == 0)
        networks(w, list->at, list->count);
    if (w->job->options.entities)
        entities(w, list);
    text_add(&w->text, "}");
}

/* ---- totals ---------------------------------------------------------------------------------- */

/* "report":{"floor.area":{"sum":12,"count":2,"least":4,"most":8}}, where anything was reported. */
static void totals(json *w)
{
    size_t count = pcg_run_total_count(w->job->run);
    pcg_total t;
    if (!count)
        return;
    text_add(&w->text, "\"report\":{");
    for (size_t i = 0; i < count && pcg_run_total(w->job->run, i, &t); i++) {
        key(w, t.key, i == 0);
        text_add(&w->text, "{\"sum\":");
        number(w, t.sum);
        whole(w, "count", t.count);
        key(w, "least", false);
        number(w, t.least);
        key(w, "most", false);
        number(w, t.most);
        text_add(&w->text, "}");
        if (w->text.length > FLUSH_AT)
            flush(w);
    }
    text_add(&w->text, "},");
}

/* ---- diagnostics ----------------------------------------------------------------------------- */

/* A number from 1, or null where there is none. */
static void place(json *w, const char *name, uint64_t value)
{
    if (value) {
        whole(w, name, value);
    } else {
        key(w, name, false);
        text_add(&w->text, "null");
    }
}

static void message(json *w, const pcg_message *m, bool first)
{
    static const char *const severities[] = {"note", "warning", "error"};
    text_add(&w->text, first ? "{" : ",{");
    string(w, "severity", true, severities[m->severity]);
    string(w, "code", false, m->code && *m->code ? m->code : NULL);
    string(w, "message", false, m->text);
    string(w, "file", false, m->file);
    place(w, "line", m->file ? m->line : 0);
    place(w, "column", m->file ? m->column : 0);
    string(w, "node", false, m->node);
    place(w, "round", m->round);
    text_add(&w->text, "}");
}

/* In seconds; the sum behind them. */
static void times(json *w)
{
    const pcg_write_options *o = &w->job->options;
    double sum = 0;
    if (!o->timings)
        return;
    key(w, "time", false);
    text_add(&w->text, "{");
    for (size_t i = 0; i < o->timing_count; i++) {
        key(w, o->timings[i].name, i == 0);
        number(w, o->timings[i].seconds);
        sum += o->timings[i].seconds;
    }
    key(w, "total", !o->timing_count);
    number(w, sum);
    text_add(&w->text, "}");
}

void io_write_json(io_job *j, const char *path)
{
    json w = {.job = j, .text.arena = &j->memory};
    size_t messages = result_message_count(j->run);
    w.out = output_open(j, path);
    text_add(&w.text, "{\"version\":1,\"graph\":");
    text_quote(&w.text, j->module->name);
    whole(&w, "seed", result_seed(j->run));
    text_add(&w.text, ",");
    if (result_properties_json(j->run, &w.text))
        text_add(&w.text, ",");
    totals(&w);
    text_add(&w.text, "\"outputs\":[");
    for (uint32_t i = 0; i < j->module->output_count && !io_stopped(j); i++)
        output(&w, i);
    text_add(&w.text, "],\"diagnostics\":[");
    for (size_t i = 0; i < messages; i++)
        message(&w, result_message(j->run, i), i == 0);
    text_add(&w.text, "]");
    times(&w);
    text_add(&w.text, "}\n");
    flush(&w);
}

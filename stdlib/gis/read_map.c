/*pcg
/// Reads buildings, streets and places out of a map: OpenStreetMap (.osm, .osm.pbf), GeoJSON,
/// Shapefile, GeoPackage.
///
/// Each output takes one kind of geometry: `polygons` faces with their holes, `lines` chains of
/// loose edges, `points` loose vertices; a feature of several parts is one shape. It leaves through
/// the first output of its kind whose `layer` and `where` fit. A condition names fields, or tags of
/// OpenStreetMap: `building`, `highway in (primary, secondary)`, `'building:levels' >= 3 and not
/// name`, `name like 'St. %'`, `ref is not null`; a comparison with a field that a feature lacks
/// does not hold. `field` copies a field to an attribute: numbers with their unit ("12 m", "40'",
/// "12,5"; of "3;4" the first), yes and no, colours; where a value cannot be read the attribute
/// stays at its default, and a warning counts such values.
///
/// Places become metres to the east (x) and north (y) of the origin, by a transverse Mercator
/// projection about it (PROJ: `+proj=tmerc +lat_0=… +lon_0=… +datum=WGS84`), rounded to a
/// micrometre or so: what two features share is the same in both, to the bit. The origin is
/// written out with the result. Areas that cross themselves are mended; what is left out, for want
/// of points, say, leaves as an impulse through `bad`, and a warning names it: `way/123` in
/// OpenStreetMap, elsewhere the feature's number. A map that is not there, or is none, fails the
/// run.
procedure read_map() -> (bad: Impulse) [effect] {
    category "create"
    synonyms "osm", "openstreetmap", "geojson", "shapefile", "geopackage", "gis", "import", "gdal", "footprints", "streets", "load"
    param file: path                  /// The map; what it is shows from its content and its name.
    param origin: list<float> = []    /// Latitude and longitude that become (0, 0), in degrees; `[]`: the middle of the file's data.
    param crs: string = ""            /// The coordinate system of layers that name none, as "EPSG:2056"; "local": they are metres, and stay as they are.
    param keep_height: bool = false   /// Takes the height of points where the file has it; else all is at 0.
    attr id: string                   /// Written: way/123 in OpenStreetMap, elsewhere the feature's number.
    attr layer: string                /// Written: the name of the feature's layer.
    attr latitude: float              /// Written: of the origin, in degrees.
    attr longitude: float             /// Written: of the origin, in degrees.
    attr problem: string              /// Written: what was mended, or why the feature was left out; "" where it is sound.
    /// Areas, as faces.
    augment polygons(where: string = "", layer: string = "") -> Shape
    /// Lines, as loose edges.
    augment lines(where: string = "", layer: string = "") -> Shape
    /// Points, as loose vertices.
    augment points(where: string = "", layer: string = "") -> Shape
    /// Copies a field, or a tag of OpenStreetMap, to an attribute: bool, int, float or a unit, color, string.
    augment field(name: string, to: attribute)
    example m: read_map(file = "examples/assets/maps/hamlet.osm") { houses: polygons(where = "building") } expect m.houses.count = 4
    example m: read_map(file = "examples/assets/maps/hamlet.osm") { streets: lines(where = "highway"); field("maxspeed", to = @limit) } expect m.streets.count = 2
}
*/
#include "read_map.h"

#include "map.h"

#ifndef PCG_GDAL_LIBRARY

int pcg_gis_read_map(pcg_call *call, struct pcg_gis_read_map *node)
{
    return pcg_fail(call,
                    "the map '%s' cannot be read: GDAL was left out when this program was built",
                    node->file);
}

#else

#include <string.h>

#include "runtime/value.h"

enum { ORIGIN_BYTES = 2 * VALUE_NUMBER_BYTES + 8 };

typedef struct pcg_gis_read_map_item item;

/* What is kept of an item of the node besides: its condition, or how reading its field went. */
typedef struct item_state {
    const gis_where *where;
    size_t where_size;
    pcg_u64 unreadable;
    const char *first; /* "'~7' of way/1" */
} item_state;

typedef struct reading {
    map map; /* first */
    struct pcg_gis_read_map *node;
    item_state *items;
    bool is_shape, is_bad, is_mended; /* of the feature in hand */
    const char *told;                 /* why it is left out */
    /* Each feature counts once: features = shapes + bad + unfit. */
    pcg_u64 features, shapes, mended, bad, unfit;
} reading;

/* ---- items ----------------------------------------------------------------------------------- */

/* An output's kind of geometry, condition and layer; false for a field. */
static bool output_of(const item *i, int *kind, const char **where, const char **layer)
{
    switch (i->kind) {
    case PCG_GIS_READ_MAP_POLYGONS:
        *kind = OUTLINE_AREAS, *where = i->polygons.where, *layer = i->polygons.layer;
        return true;
    case PCG_GIS_READ_MAP_LINES:
        *kind = OUTLINE_LINES, *where = i->lines.where, *layer = i->lines.layer;
        return true;
    case PCG_GIS_READ_MAP_POINTS:
        *kind = OUTLINE_POINTS, *where = i->points.where, *layer = i->points.layer;
        return true;
    default:
        return false;
    }
}

static int parse_where(reading *r, uint32_t index, const char *where)
{
    pcg_call *call = r->map.call;
    item_state *state = &r->items[index];
    const char *error;
    size_t at, size = gis_where_size(where);
    if (!size)
        return pcg_fail(call, "the condition of '%s' is too long", r->node->items[index].name);
    void *memory = run_alloc(call->run, size);
    if (!memory)
        return PCG_FAILED;
    state->where = gis_where_parse(where, memory, &error, &at);
    state->where_size = size;
    if (state->where)
        return PCG_OK;
    run_free(call->run, memory, size);
    return pcg_fail(call,
                    "the condition of '%s', %s, has no sense at its character %llu: expected %s",
                    r->node->items[index].name, where, (unsigned long long)at + 1, error);
}

static int check_layer(reading *r, const char *layer)
{
    const map *m = &r->map;
    const char *names = "";
    for (uint32_t i = 0; i < m->layer_count; i++) {
        if (!layer[0] || !strcmp(m->layers[i].name, layer))
            return PCG_OK;
        names =
            pcg_format(m->call->run, "%s%s'%s'", names, names[0] ? ", " : "", m->layers[i].name);
        if (!names)
            return PCG_FAILED;
    }
    if (!layer[0])
        return PCG_OK;
    return pcg_fail(m->call, "'%s' has no layer '%s': it has %s", m->file, layer,
                    names[0] ? names : "none");
}

static int check_field(reading *r, const item *i)
{
    int kind = i->field.to.kind;
    if (kind != PCG_STRING && kind != PCG_PATH && !gis_kind_is_read(kind))
        return pcg_fail(r->map.call, "field '%s' cannot be copied to an attribute of type %s",
                        i->field.name, value_kind_name(kind));
    if (!map_has_field(&r->map, i->field.name))
        pcg_note(r->map.call, "'%s' has no field '%s'", r->map.file, i->field.name);
    return PCG_OK;
}

static int open_items(reading *r)
{
    uint32_t count = r->node->item_count;
    r->items = run_alloc_array(r->map.call->run, count + 1, sizeof *r->items);
    int status = r->items ? PCG_OK : PCG_FAILED;
    for (uint32_t i = 0; i < count && status == PCG_OK; i++) {
        int kind;
        const char *where, *layer;
        if (output_of(&r->node->items[i], &kind, &where, &layer)) {
            status = parse_where(r, i, where);
            if (status == PCG_OK)
                status = check_layer(r, layer);
        } else {
            status = check_field(r, &r->node->items[i]);
        }
    }
    return status;
}

static void close_items(reading *r, pcg_run *run)
{
    for (uint32_t i = 0; r->items && i < r->node->item_count; i++)
        if (r->items[i].where)
            run_free(run, (void *)(uintptr_t)r->items[i].where, r->items[i].where_size);
    run_free(run, r->items, r->items ? (r->node->item_count + 1) * sizeof *r->items : 0);
}

/* ---- attributes ------------------------------------------------------------------------------ */

static int set_text(reading *r, pcg_entity *e, const pcg_slot *slot, const char *value)
{
    const char *own = slot->cell >= 0 ? pcg_string(r->map.call->run, value) : "";
    if (own && slot->cell >= 0)
        pcg_set_string(r->map.call->run, e, slot, own);
    return own ? PCG_OK : PCG_FAILED;
}

/* Reads a field into cells of the attribute's kind. False where that cannot be. */
static bool read_field(reading *r, const item *i, const char *value, pcg_cell *to)
{
    map *m = &r->map;
    int kind = i->field.to.kind;
    if (kind == PCG_STRING || kind == PCG_PATH) {
        to->s = value_is_utf8(value) ? pcg_string(m->call->run, value) : NULL;
        return to->s != NULL;
    }
    return (value_is_float(kind) && map_number(m, i->field.name, &to->f)) ||
           gis_value_read(value, kind, to);
}

static int note_unreadable(reading *r, uint32_t index, const char *value)
{
    item_state *state = &r->items[index];
    if (state->unreadable++)
        return PCG_OK;
    state->first = pcg_format(r->map.call->run, "'%.40s' of %s", value_is_utf8(value) ? value : "?",
                              r->map.id);
    return state->first ? PCG_OK : PCG_FAILED;
}

static int set_fields(reading *r, pcg_entity *e)
{
    for (uint32_t k = 0; k < r->node->item_count; k++) {
        const item *i = &r->node->items[k];
        pcg_cell cells[4];
        const char *value =
            i->kind == PCG_GIS_READ_MAP_FIELD ? map_value(&r->map, i->field.name) : NULL;
        if (!value || !value[0])
            continue;
        if (read_field(r, i, value, cells))
            pcg_set_cells(r->map.call->run, e, &i->field.to, cells);
        else if (note_unreadable(r, k, value) != PCG_OK)
            return PCG_FAILED;
    }
    return PCG_OK;
}

static int describe(reading *r, pcg_entity *e, const char *id, const char *layer,
                    const char *problem)
{
    const struct pcg_gis_read_map *node = r->node;
    pcg_run *run = r->map.call->run;
    if (set_text(r, e, &node->id, id) != PCG_OK || set_text(r, e, &node->layer, layer) != PCG_OK ||
        set_text(r, e, &node->problem, problem) != PCG_OK)
        return PCG_FAILED;
    pcg_set_float(run, e, &node->latitude, r->map.projection.latitude);
    pcg_set_float(run, e, &node->longitude, r->map.projection.longitude);
    return PCG_OK;
}

static int describe_feature(reading *r, pcg_entity *e)
{
    const map *m = &r->map;
    if (describe(r, e, m->id, m->layer->name, m->problem ? m->problem : "") != PCG_OK)
        return PCG_FAILED;
    return set_fields(r, e);
}

/* ---- features -------------------------------------------------------------------------------- */

/* The first output for a kind of geometry that takes the feature in hand, or NULL. */
static const item *output_for(reading *r, int kinds)
{
    for (uint32_t k = 0; k < r->node->item_count; k++) {
        int kind;
        const char *where, *layer;
        if (output_of(&r->node->items[k], &kind, &where, &layer) && (kind & kinds) &&
            (!layer[0] || !strcmp(layer, r->map.layer->name)) &&
            gis_where_holds(r->items[k].where, map_value, &r->map))
            return &r->node->items[k];
    }
    return NULL;
}

/* One impulse a feature, whatever is wrong with each of its kinds of geometry. */
static int emit_bad(reading *r)
{
    pcg_call *call = r->map.call;
    if (r->is_bad && r->told == r->map.problem) /* strings of the run are each there once */
        return PCG_OK;
    r->told = r->map.problem;
    PCG_TRY(pcg_warn(call, "%s is left out: %s", r->map.id, r->map.problem));
    if (r->is_bad)
        return PCG_OK;
    r->is_bad = true;
    pcg_entity *e = pcg_entity_new(call, &pcg_type_impulse, NULL);
    if (!e)
        return PCG_FAILED;
    if (describe_feature(r, e) == PCG_OK)
        return pcg_emit(call, r->node->bad, e);
    pcg_entity_drop(call->run, e);
    return PCG_FAILED;
}

static int emit_lost(reading *r, const map_lost *l)
{
    pcg_call *call = r->map.call;
    r->features++;
    r->bad++;
    PCG_TRY(pcg_warn(call, "%s is left out: %s", l->id, l->problem));
    pcg_entity *e = pcg_entity_new(call, &pcg_type_impulse, NULL);
    if (!e)
        return PCG_FAILED;
    if (describe(r, e, l->id, "", l->problem) == PCG_OK)
        return pcg_emit(call, r->node->bad, e);
    pcg_entity_drop(call->run, e);
    return PCG_FAILED;
}

/* What GDAL has left out meanwhile. */
static int emit_all_lost(reading *r)
{
    map_lost *lost = map_take_lost(&r->map);
    int status = PCG_OK;
    for (const map_lost *l = lost; l && status == PCG_OK; l = l->next)
        status = emit_lost(r, l);
    map_free_lost(lost);
    return status;
}

static int emit_shape(reading *r, const item *output, pcg_shape *s)
{
    pcg_call *call = r->map.call;
    if (describe_feature(r, &s->entity) != PCG_OK || pcg_shape_fit(call->run, s) != PCG_OK)
        return PCG_FAILED;
    if (r->map.problem)
        PCG_TRY(pcg_warn(call, "%s is mended: %s", r->map.id, r->map.problem));
    r->is_shape = true;
    r->is_mended = r->is_mended || r->map.problem;
    pcg_entity_hold(&s->entity); /* the caller drops the other one */
    return pcg_emit(call, output->port, &s->entity);
}

/* What the feature has of one kind of geometry, as a shape. */
static int make_shape(reading *r, gdal_geometry *g, int kind, const item *output)
{
    pcg_call *call = r->map.call;
    r->map.problem = NULL;
    pcg_shape *s = pcg_shape_new(call, NULL);
    if (!s)
        return PCG_FAILED;
    pcg_mesh *mesh = pcg_mesh_new(call->run, false);
    if (mesh)
        pcg_shape_set_mesh(call->run, s, mesh);
    int status = mesh ? outline_add(&r->map, g, kind, mesh) : PCG_FAILED;
    bool empty = mesh && !mesh->vertex_count;
    if (status == PCG_OK && !empty)
        status = emit_shape(r, output, s);
    pcg_entity_drop(call->run, &s->entity);
    if (status != PCG_OK || !empty)
        return status;
    outline_problem(&r->map, "it has no points");
    return emit_bad(r);
}

static int make_shapes(reading *r, gdal_geometry *g)
{
    int kinds = outline_kinds(&r->map, g, 0), status = PCG_OK;
    for (int kind = OUTLINE_AREAS; kind <= OUTLINE_POINTS && status == PCG_OK; kind *= 2) {
        const item *output = kinds & kind ? output_for(r, kind) : NULL;
        if (output)
            status = make_shape(r, g, kind, output);
    }
    return status;
}

/* Says what is wrong with the whole geometry, where an output would take it. */
static int refuse(reading *r, int kinds, const char *problem)
{
    outline_problem(&r->map, problem);
    return output_for(r, kinds) ? emit_bad(r) : PCG_OK;
}

/* Makes shapes of geometry that has curves, or another coordinate system. */
static int make_straight_shapes(reading *r, gdal_geometry *g)
{
    map *m = &r->map;
    PCG_TRY(worker_do_with(m, g, work_straighten));
    map_hush(m);
    if (!m->straight)
        return refuse(r, outline_kinds(m, g, 0), "a point is outside of its coordinate system");
    int status = make_shapes(r, m->straight);
    if (m->interrupted == PCG_OK) {
        m->gdal.OGR_G_DestroyGeometry(m->straight);
        m->straight = NULL;
    }
    return status;
}

static int read_feature(reading *r)
{
    map *m = &r->map;
    gdal_geometry *g = m->gdal.OGR_F_GetGeometryRef(m->feature);
    if (!g || m->gdal.OGR_G_IsEmpty(g))
        return refuse(r, OUTLINE_AREAS | OUTLINE_LINES | OUTLINE_POINTS, "it has no geometry");
    if (m->layer->place == MAP_UNKNOWN)
        return pcg_fail(m->call,
                        "layer '%s' of '%s' does not name its coordinate system: give `crs`, "
                        "\"EPSG:4326\" for degrees, say, or \"local\" for metres",
                        m->layer->name, m->file);
    bool straight = m->layer->place != MAP_TRANSFORMED && !m->gdal.OGR_G_HasCurveGeometry(g, 1);
    return straight ? make_shapes(r, g) : make_straight_shapes(r, g);
}

static int count_feature(reading *r)
{
    r->is_shape = r->is_bad = r->is_mended = false;
    PCG_TRY(read_feature(r));
    r->features++;
    r->bad += r->is_bad;
    r->shapes += r->is_shape && !r->is_bad;
    r->mended += r->is_shape && !r->is_bad && r->is_mended;
    r->unfit += !r->is_shape && !r->is_bad;
    return PCG_OK;
}

/* ---- the origin ------------------------------------------------------------------------------ */

static void write_origin(char *out, size_t room, double latitude, double longitude)
{
    char numbers[2][VALUE_NUMBER_BYTES];
    value_number(numbers[0], latitude);
    value_number(numbers[1], longitude);
    snprintf(out, room, "[%s, %s]", numbers[0], numbers[1]);
}

/* Where another map of the run has its origin elsewhere: what they hold does not fit together. */
static int compare_origin(reading *r, double latitude, double longitude)
{
    const gis_projection *p = &r->map.projection;
    char here[ORIGIN_BYTES], there[ORIGIN_BYTES];
    if (p->latitude == latitude && p->longitude == longitude)
        return PCG_OK;
    write_origin(here, sizeof here, p->latitude, p->longitude);
    write_origin(there, sizeof there, latitude, longitude);
    return pcg_warn(r->map.call,
                    "'%s' has its origin at %s, a map before it at %s, which stands for the "
                    "result: the two do not fit together; give both one `origin`",
                    r->map.file, here, there);
}

/* Keeps the origin with the result, so that models go back on the map. */
static int keep_origin(reading *r)
{
    pcg_call *call = r->map.call;
    const gis_projection *p = &r->map.projection;
    const pcg_cell *latitude = pcg_property_get(call->run, "origin.latitude", PCG_FLOAT),
                   *longitude = pcg_property_get(call->run, "origin.longitude", PCG_FLOAT);
    char crs[GIS_PROJ_BYTES];
    if (!r->map.on_earth)
        return PCG_OK;
    if (latitude && longitude)
        return compare_origin(r, latitude->f, longitude->f);
    gis_projection_write(p, crs);
    const pcg_cell cells[] = {{.f = p->latitude}, {.f = p->longitude}, {.s = crs}};
    PCG_TRY(pcg_property_set(call, "origin.latitude", PCG_FLOAT, &cells[0]));
    PCG_TRY(pcg_property_set(call, "origin.longitude", PCG_FLOAT, &cells[1]));
    return pcg_property_set(call, "origin.crs", PCG_STRING, &cells[2]);
}

/* ---- all of it ------------------------------------------------------------------------------- */

static int report(reading *r)
{
    map *m = &r->map;
    char origin[ORIGIN_BYTES];
    for (uint32_t i = 0; i < r->node->item_count; i++) {
        const item_state *state = &r->items[i];
        int status =
            state->unreadable
                ? pcg_warn(m->call, "field '%s': %llu value%s cannot be read as %s, the first %s",
                           r->node->items[i].field.name, state->unreadable,
                           state->unreadable == 1 ? "" : "s",
                           value_kind_name(r->node->items[i].field.to.kind), state->first)
                : PCG_OK;
        if (status != PCG_OK)
            return status;
    }
    write_origin(origin, sizeof origin, m->projection.latitude, m->projection.longitude);
    pcg_note(m->call,
             "'%s': %llu features: %llu became shapes, %llu of them mended; %llu are left out, "
             "%llu fit no output; origin %s",
             m->file, r->features, r->shapes, r->mended, r->bad, r->unfit, origin);
    return PCG_OK;
}

static int read_features(reading *r)
{
    map *m = &r->map;
    m->collects_lost = true;
    do {
        PCG_TRY(map_next(m));
        PCG_TRY(map_tell(m)); /* also of a file that ends too early */
        PCG_TRY(emit_all_lost(r));
        if (m->feature)
            PCG_TRY(count_feature(r));
        PCG_TRY(map_tell(m));
    } while (m->feature);
    return report(r);
}

static int read_all(reading *r, pcg_call *call)
{
    const struct pcg_gis_read_map *node = r->node;
    PCG_TRY(map_open(&r->map, call, node->file, node->crs));
    PCG_TRY(open_items(r));
    PCG_TRY(map_locate(&r->map, node->origin));
    PCG_TRY(keep_origin(r));
    return read_features(r);
}

int pcg_gis_read_map(pcg_call *call, struct pcg_gis_read_map *node)
{
    reading *r = run_alloc_zeroed(call->run, sizeof *r);
    if (!r)
        return PCG_FAILED;
    r->node = node;
    r->map.keep_height = node->keep_height;
    int status = read_all(r, call);
    close_items(r, call->run);
    if (map_close(&r->map))
        run_free(call->run, r, sizeof *r);
    return status;
}

#endif

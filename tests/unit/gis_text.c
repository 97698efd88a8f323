/* gis_text.c - conditions on features, values out of what people write into maps, tags, and the
 * projection. */
#include "../../stdlib/gis/gis.h"

#include <stdlib.h>

#include "unit.h"

/* The fields of the feature that conditions are tried on. */
static const char *look_up(void *context, const char *field)
{
    static const char *const fields[][2] = {
        {"building", "house"}, {"levels", "3"},        {"name", "St. Mary's"},
        {"empty", ""},         {"addr:city", "Vaduz"},
    };
    (void)context;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++)
        if (!strcmp(fields[i][0], field))
            return fields[i][1];
    return NULL;
}

/* 1 or 0: whether it holds; -1: it is no condition. */
static int holds(const char *condition)
{
    const char *error;
    size_t at;
    void *memory = malloc(gis_where_size(condition));
    const gis_where *w = memory ? gis_where_parse(condition, memory, &error, &at) : NULL;
    int result = w ? gis_where_holds(w, look_up, NULL) : -1;
    free(memory);
    return result;
}

static void conditions(void)
{
    static const char *const hold[] = {
        "",
        "building",
        "building = house",
        "building == 'house'",
        "not shop",
        "levels >= 3",
        "levels < 10",
        "levels = 3.0",
        "building in (yes, house)",
        "building not in (shed)",
        "name like 'st.%y''s'",
        "\"addr:city\" = Vaduz",
        "addr:city",
        "shop is null",
        "building is not null",
        "shop or building and levels",
        "(shop or building) and not (a or b)",
        "BUILDING or building",
        "building != shed",
        "not shop = x",
        "shop = x or levels = 4 or levels = 3",
        "empty is null",
    };
    static const char *const do_not[] = {
        "shop",
        "empty",
        "shop != x",
        "building < 3",
        "levels > 3",
        "building in (a, b)",
        "name like 'St'",
        "building and shop",
        "shop and building or shop",
        "not building",
        "levels < x",
        "building and levels and shop",
    };
    static const char *const have_no_sense[] = {
        "building =",    "= x", "(building",    "building)", "building in x", "building in (a",
        "building is 3", "a b", "name = 'open", "not",       "a and",         "building not x",
        "a,b",
    };
    for (size_t i = 0; i < sizeof hold / sizeof hold[0]; i++)
        CHECK_INTEGER(holds(hold[i]), 1);
    for (size_t i = 0; i < sizeof do_not / sizeof do_not[0]; i++)
        CHECK_INTEGER(holds(do_not[i]), 0);
    for (size_t i = 0; i < sizeof have_no_sense / sizeof have_no_sense[0]; i++)
        CHECK_INTEGER(holds(have_no_sense[i]), -1);
}

static void nested_conditions(void)
{
    static char deep[3 * GIS_WHERE_BYTES_MAX];
    memset(deep, '(', GIS_WHERE_BYTES_MAX);
    CHECK_INTEGER(holds(deep), -1);
    strcpy(deep, "x");
    for (size_t i = 1; i + 6 < GIS_WHERE_BYTES_MAX; i += 5)
        strcpy(deep + i, " or x");
    CHECK_INTEGER(holds(deep), 0);
    memset(deep, 'x', GIS_WHERE_BYTES_MAX + 1);
    CHECK(gis_where_size(deep) == 0);
}

static double read_as(const char *field, int kind)
{
    pcg_cell cells[4];
    if (!gis_value_read(field, kind, cells))
        return -1;
    return kind == PCG_BOOL || kind == PCG_INT ? (double)cells[0].i : cells[0].f;
}

static void values(void)
{
    static const struct {
        const char *field;
        int kind;
        double value;
    } rows[] = {
        {"12", PCG_INT, 12},
        {"12 m", PCG_INT, 12},
        {"2.5", PCG_INT, 3},
        {"3;4", PCG_INT, 3},
        {"several;4", PCG_INT, 4},
        {"~12", PCG_INT, -1},
        {"", PCG_INT, -1},
        {";;", PCG_INT, -1},
        {"99999999999999999999", PCG_INT, -1},
        {"12", PCG_LENGTH, 12},
        {" 12.5m ", PCG_LENGTH, 12.5},
        {"12,5", PCG_LENGTH, 12.5},
        {"1,200", PCG_LENGTH, -1},
        {"10'", PCG_LENGTH, 3.048},
        {"6'6\"", PCG_LENGTH, 1.9812},
        {"10 FT", PCG_LENGTH, 3.048},
        {"1.2 km", PCG_LENGTH, 1200},
        {"12 kg", PCG_LENGTH, -1},
        {"nan", PCG_LENGTH, -1},
        {"1e999", PCG_LENGTH, -1},
        {"50 mph", PCG_FLOAT, 80.4672},
        {"2 ha", PCG_AREA, 20000},
        {"2 m", PCG_AREA, -1},
        {"NW", PCG_ANGLE, 315},
        {"90\302\260", PCG_ANGLE, 90},
        {"25%", PCG_RATIO, 0.25},
        {"yes", PCG_BOOL, 1},
        {"No", PCG_BOOL, 0},
        {"maybe", PCG_BOOL, -1},
        {"#f00", PCG_COLOR, 1},
        {"#0000ff", PCG_COLOR, 0},
        {"White", PCG_COLOR, 1},
        {"#12", PCG_COLOR, -1},
        {"x", PCG_STRING, -1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        CHECK(fabs(read_as(rows[i].field, rows[i].kind) - rows[i].value) < 1e-9);
        if (!(fabs(read_as(rows[i].field, rows[i].kind) - rows[i].value) < 1e-9))
            printf("    '%s'\n", rows[i].field);
    }
}

static void tags(void)
{
    const char *all = "\"a\"=>\"1\",\"roof:shape\"=>\"gabled\",\"say \\\"x\\\"\"=>\"\\\\y\"";
    char out[100];
    CHECK(gis_tags_find(all, "a", out) && !strcmp(out, "1"));
    CHECK(gis_tags_find(all, "roof:shape", out) && !strcmp(out, "gabled"));
    CHECK(gis_tags_find(all, "say \"x\"", out) && !strcmp(out, "\\y"));
    CHECK(!gis_tags_find(all, "1", out));
    CHECK(!gis_tags_find("", "a", out));
    CHECK(!gis_tags_find("\"a\"=>\"open", "a", out));
    CHECK(!gis_tags_find("\"a\"", "a", out));
}

/* Expected places are those of PROJ's own transverse Mercator. */
static void projection(void)
{
    static const double rows[][4] = {
        {47.0, 9.5, -4080.25215611361, -17731.7119880342},
        {47.27, 9.63, 5777.70894761837, 12286.5568198915},
        {46, 12, 189500.561329605, -125983.197576655},
        {-30, -20, -2913947.55283219, -8943405.08145497},
        {85, 80, 526767.455260967, 4589654.11707118},
    };
    gis_projection p;
    double east, north;
    gis_projection_open(&p, 47.15951, 9.553648);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        CHECK(gis_project(&p, rows[i][0], rows[i][1], &east, &north));
        CHECK(fabs(east - rows[i][2]) < 1e-4 && fabs(north - rows[i][3]) < 1e-4);
    }
    CHECK(!gis_project(&p, 91, 0, &east, &north));
    CHECK(!gis_project(&p, 0, 120, &east, &north));
    CHECK(!gis_project(&p, NAN, 0, &east, &north));
    CHECK(!gis_project(&p, 0, INFINITY, &east, &north));
    CHECK(gis_project(&p, 90, 0, &east, &north) && fabs(east) < 1e-3);
    gis_projection_open(&p, 0, 179.9);
    CHECK(gis_project(&p, 0, -179.9, &east, &north) && fabs(east - 22263.9) < 1);
    CHECK(gis_rounded(0.3) != 0.3 && fabs(gis_rounded(-0.3) + 0.3) < 1e-6);
}

int main(void)
{
    conditions();
    nested_conditions();
    values();
    tags();
    projection();
    return unit_done();
}

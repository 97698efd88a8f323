/* gis.h - what the files of this library share: conditions on features, values out of text, the
 * elements of a file, the projection.
 *
 * They read what strangers wrote, and know nothing of GDAL, so that they can be tested, and fuzzed,
 * by themselves.
 */
#ifndef PCG_GIS_H
#define PCG_GIS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/abi.h"

/* ---- conditions: where.c --------------------------------------------------------------------- */

/* A condition on the fields of a feature, such as `building and levels >= 3`. */
typedef struct gis_where gis_where;
/* The value of a field, or NULL where the feature has none; it need only last until the next
 * call. */
typedef const char *gis_lookup(void *context, const char *field);

enum { GIS_WHERE_DEPTH_MAX = 100, GIS_WHERE_BYTES_MAX = 1 << 16 };

/* How many bytes gis_where_parse needs for a text; 0 where it is longer than
 * GIS_WHERE_BYTES_MAX. */
size_t gis_where_size(const char *text);
/* Parses into `memory`, which has gis_where_size bytes and is aligned for pointers. NULL where
 * the text is no condition: *error then says what was expected, and *at is the offset. An empty
 * text holds for every feature. */
const gis_where *gis_where_parse(const char *text, void *memory, const char **error, size_t *at);
bool gis_where_holds(const gis_where *w, gis_lookup *lookup, void *context);

/* ---- values out of text: quantity.c ---------------------------------------------------------- */

/* Reads a field as a value of a kind (PCG_INT, PCG_LENGTH …): "12", "12,5 m", "40'", "yes",
 * "NW", "#fff". Of a list, "3;4", the first part counts that can be read. False where none can,
 * or where the kind is none of those that gis_kind_is_read takes. Strings are left to the
 * caller. */
bool gis_value_read(const char *field, int kind, pcg_cell *to);
bool gis_kind_is_read(int kind);
/* The whole field as one plain number. */
bool gis_number_read(const char *field, double *to);

/* Finds a key among tags written as "key"=>"value","key"=>"value" with backslashes before
 * quotes, and copies its value to `out`, which has room for as many bytes as `tags` has, and a
 * NUL. False where it is not there. */
bool gis_tags_find(const char *tags, const char *key, char *out);

/* ---- elements of GeoJSON: element.c ---------------------------------------------------------- */

/* A place in the text of a GeoJSON file. Zeroed at its beginning. */
typedef struct gis_elements {
    uint64_t index; /* of the element among the features, from 0 */
    uint64_t depth; /* of brackets */
    uint64_t key_length;
    char key[8]; /* the last string at the top, as far as it matters */
    bool in_string, escaped, is_value, in_features, begun;
} gis_elements;

/* Takes the next byte; whether an element of the array "features" begins with it that is no
 * object: the one with the number `index`. */
bool gis_element_is_other(gis_elements *e, char c);

/* ---- the projection: projection.c ------------------------------------------------------------ */

/* Transverse Mercator on the ellipsoid of WGS 84 about an origin, at scale 1: metres to the east
 * and north. */
typedef struct gis_projection {
    double latitude, longitude; /* of the origin, in degrees */
    double north;               /* of the origin from the equator, in units of the radius */
} gis_projection;

void gis_projection_open(gis_projection *p, double latitude, double longitude);
/* The same for PROJ and what stands on it, as the text of a coordinate system. */
enum { GIS_PROJ_BYTES = 256 };
void gis_projection_write(const gis_projection *p, char *out);
/* False where the place is none on Earth, or further than 80 degrees of longitude away. */
bool gis_project(const gis_projection *p, double latitude, double longitude, double *east,
                 double *north);
/* The nearest multiple of 2^-20 m: sums and differences of such coordinates are exact, so that
 * what two features share is the same to the bit. */
double gis_rounded(double metres);

#endif

# What stdlib/gis/gdal.h declares of GDAL is what GDAL's own headers declare, where they are installed.
. "$ROOT/tests/tool/expect.inc"

headers=$(pkg-config --variable=includedir gdal 2>/dev/null || echo /usr/include/gdal)
if ! [ -e "$headers/gdal.h" ]; then
    echo "ok no headers of GDAL's to compare with"
    done_testing
fi

# The table, in GDAL's own types. GDALClose gives a result since 3.7, which nobody asks for.
sed -n '/^#define GDAL_FUNCTIONS/,/^$/p' "$ROOT/stdlib/gis/gdal.h" |
    sed -e '/GDALClose,/d' -e 's/gdal_dataset \*\*/GDALDatasetH */g; s/gdal_dataset \*/GDALDatasetH /g
        s/gdal_driver \*/GDALDriverH /g; s/gdal_layer \*\*/OGRLayerH */g; s/gdal_layer \*/OGRLayerH /g
        s/gdal_definition \*/OGRFeatureDefnH /g; s/gdal_field \*/OGRFieldDefnH /g
        s/gdal_feature \*/OGRFeatureH /g; s/gdal_geometry \*/OGRGeometryH /g
        s/gdal_reference \*/OGRSpatialReferenceH /g
        s/gdal_transform \*/OGRCoordinateTransformationH /g; s/gdal_envelope/OGREnvelope/g
        s/gdal_field_type/OGRFieldType/g; s/gdal_geometry_type/OGRwkbGeometryType/g
        s/gdal_axis_order/OSRAxisMappingStrategy/g; s/gdal_progress \*/GDALProgressFunc /g
        s/gdal_handler \*/CPLErrorHandler /g; s/long long/GIntBig/g' >table.inc
cat >compare.c <<'END'
#define PCG_GDAL_LIBRARY "" /* for the constants and the envelope */
#include "stdlib/gis/gdal.h"
#undef GDAL_FUNCTIONS
#include <stddef.h>
#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include "table.inc"
#define COMPARE(result, name, parameters) extern result(*compare_##name) parameters; \
    result(*compare_##name) parameters = name;
GDAL_FUNCTIONS(COMPARE)
#define SAME(a, b) _Static_assert((int)(a) == (int)(b), #a " is " #b);
SAME(GDAL_READ_VECTORS, GDAL_OF_VECTOR) SAME(GDAL_TELL_ERRORS, GDAL_OF_VERBOSE_ERROR)
SAME(GDAL_DEBUG, CE_Debug) SAME(GDAL_WARNING, CE_Warning) SAME(GDAL_FAILURE, CE_Failure)
SAME(GDAL_LONGITUDE_FIRST, OAMS_TRADITIONAL_GIS_ORDER) SAME(GDAL_DONE, OGRERR_NONE)
SAME(GDAL_TYPE_REAL, OFTReal) SAME(GDAL_POINT, wkbPoint) SAME(GDAL_LINE_STRING, wkbLineString)
SAME(GDAL_POLYGON, wkbPolygon) SAME(GDAL_MULTI_POLYGON, wkbMultiPolygon)
SAME(GDAL_TRIANGLE, wkbTriangle) SAME(sizeof(gdal_envelope), sizeof(OGREnvelope))
SAME(offsetof(gdal_envelope, low_x), offsetof(OGREnvelope, MinX))
SAME(offsetof(gdal_envelope, high_x), offsetof(OGREnvelope, MaxX))
SAME(offsetof(gdal_envelope, low_y), offsetof(OGREnvelope, MinY))
SAME(offsetof(gdal_envelope, high_y), offsetof(OGREnvelope, MaxY))
END
run "$CC" -std=gnu11 -Wall -Werror -fsyntax-only -iquote "$ROOT" -iquote . -isystem "$headers" compare.c
expect_code 0 "the declarations agree"
sed 's/X(int, OGR_G_IsEmpty/X(double, OGR_G_IsEmpty/' table.inc >wrong.inc
mv wrong.inc table.inc
run "$CC" -std=gnu11 -Wall -Werror -fsyntax-only -iquote "$ROOT" -iquote . -isystem "$headers" compare.c
expect "one that is wrong would be found" test "$code" != 0
done_testing

/* gdal.h - GDAL's functions, found in its library when a graph first asks for a map.
 *
 * What is used of its C interface, which is stable, is declared here: neither building nor running
 * takes more than the library itself. tests/tool/gdal_headers.sh compares with GDAL's own headers.
 * The library stays in the process once it is there: it registers its drivers for good.
 */
#ifndef PCG_GIS_GDAL_H
#define PCG_GIS_GDAL_H

#ifdef PCG_GDAL_LIBRARY

/* GDAL's own handles are pointers to structs as well. */
typedef struct gdal_dataset gdal_dataset;
typedef struct gdal_driver gdal_driver;
typedef struct gdal_layer gdal_layer;
typedef struct gdal_definition gdal_definition; /* of a layer's features: its fields */
typedef struct gdal_field gdal_field;
typedef struct gdal_feature gdal_feature;
typedef struct gdal_geometry gdal_geometry;
typedef struct gdal_reference gdal_reference; /* a coordinate system */
typedef struct gdal_transform gdal_transform; /* from one to another */

typedef struct gdal_envelope {
    double low_x, high_x, low_y, high_y;
} gdal_envelope;

/* Enumerations of GDAL's, and what is used of them. */
typedef int gdal_level, gdal_axis_order, gdal_field_type, gdal_geometry_type;
enum { GDAL_READ_VECTORS = 0x04, GDAL_TELL_ERRORS = 0x40 };
enum { GDAL_DEBUG = 1, GDAL_WARNING = 2, GDAL_FAILURE = 3 };
enum { GDAL_LONGITUDE_FIRST = 0 };
enum { GDAL_DONE = 0 };
enum { GDAL_TYPE_REAL = 2 };
enum {
    GDAL_POINT = 1,
    GDAL_LINE_STRING = 2,
    GDAL_POLYGON = 3,
    GDAL_MULTI_POLYGON = 6,
    GDAL_TRIANGLE = 17
};

typedef int gdal_progress(double done, const char *message, void *context);
typedef void gdal_handler(gdal_level level, int number, const char *said);

/* X(result, name, (parameters)) for every function that is used. */
#define GDAL_FUNCTIONS(X)                                                                          \
    X(void, GDALAllRegister, (void))                                                               \
    X(const char *, GDALVersionInfo, (const char *))                                               \
    X(gdal_dataset *, GDALOpenEx,                                                                  \
      (const char *, unsigned, const char *const *, const char *const *, const char *const *))     \
    X(void, GDALClose, (gdal_dataset *))                                                           \
    X(gdal_driver *, GDALGetDatasetDriver, (gdal_dataset *))                                       \
    X(const char *, GDALGetDriverShortName, (gdal_driver *))                                       \
    X(int, GDALDatasetGetLayerCount, (gdal_dataset *))                                             \
    X(gdal_layer *, GDALDatasetGetLayer, (gdal_dataset *, int))                                    \
    X(gdal_feature *, GDALDatasetGetNextFeature,                                                   \
      (gdal_dataset *, gdal_layer **, double *, gdal_progress *, void *))                          \
    X(void, GDALDatasetResetReading, (gdal_dataset *))                                             \
    X(const char *, OGR_L_GetName, (gdal_layer *))                                                 \
    X(gdal_definition *, OGR_L_GetLayerDefn, (gdal_layer *))                                       \
    X(gdal_reference *, OGR_L_GetSpatialRef, (gdal_layer *))                                       \
    X(int, OGR_L_GetExtent, (gdal_layer *, gdal_envelope *, int))                                  \
    X(int, OGR_FD_GetFieldIndex, (gdal_definition *, const char *))                                \
    X(gdal_field *, OGR_FD_GetFieldDefn, (gdal_definition *, int))                                 \
    X(gdal_field_type, OGR_Fld_GetType, (gdal_field *))                                            \
    X(gdal_geometry *, OGR_F_GetGeometryRef, (gdal_feature *))                                     \
    X(long long, OGR_F_GetFID, (gdal_feature *))                                                   \
    X(gdal_definition *, OGR_F_GetDefnRef, (gdal_feature *))                                       \
    X(int, OGR_F_IsFieldSetAndNotNull, (gdal_feature *, int))                                      \
    X(const char *, OGR_F_GetFieldAsString, (gdal_feature *, int))                                 \
    X(double, OGR_F_GetFieldAsDouble, (gdal_feature *, int))                                       \
    X(void, OGR_F_Destroy, (gdal_feature *))                                                       \
    X(gdal_geometry_type, OGR_G_GetGeometryType, (gdal_geometry *))                                \
    X(int, OGR_G_GetGeometryCount, (gdal_geometry *))                                              \
    X(gdal_geometry *, OGR_G_GetGeometryRef, (gdal_geometry *, int))                               \
    X(int, OGR_G_GetPointCount, (gdal_geometry *))                                                 \
    X(int, OGR_G_GetPoints, (gdal_geometry *, void *, int, void *, int, void *, int))              \
    X(int, OGR_G_IsValid, (gdal_geometry *))                                                       \
    X(gdal_geometry *, OGR_G_MakeValidEx, (gdal_geometry *, char **))                              \
    X(void, OGR_G_CloseRings, (gdal_geometry *))                                                   \
    X(int, OGR_G_IsEmpty, (gdal_geometry *))                                                       \
    X(int, OGR_G_WkbSize, (gdal_geometry *))                                                       \
    X(void, OGR_G_GetEnvelope, (gdal_geometry *, gdal_envelope *))                                 \
    X(void, OGR_G_DestroyGeometry, (gdal_geometry *))                                              \
    X(gdal_geometry *, OGR_G_GetLinearGeometry, (gdal_geometry *, double, char **))                \
    X(int, OGR_G_HasCurveGeometry, (gdal_geometry *, int))                                         \
    X(gdal_geometry *, OGR_G_Clone, (gdal_geometry *))                                             \
    X(int, OGR_G_Transform, (gdal_geometry *, gdal_transform *))                                   \
    X(gdal_geometry_type, OGR_GT_Flatten, (gdal_geometry_type))                                    \
    X(gdal_reference *, OSRNewSpatialReference, (const char *))                                    \
    X(int, OSRSetWellKnownGeogCS, (gdal_reference *, const char *))                                \
    X(int, OSRSetFromUserInput, (gdal_reference *, const char *))                                  \
    X(int, OSRIsSame, (gdal_reference *, gdal_reference *))                                        \
    X(void, OSRSetAxisMappingStrategy, (gdal_reference *, gdal_axis_order))                        \
    X(void, OSRDestroySpatialReference, (gdal_reference *))                                        \
    X(gdal_transform *, OCTNewCoordinateTransformation, (gdal_reference *, gdal_reference *))      \
    X(void, OCTDestroyCoordinateTransformation, (gdal_transform *))                                \
    X(int, OCTTransform, (gdal_transform *, int, double *, double *, double *))                    \
    X(void, CPLPushErrorHandlerEx, (gdal_handler *, void *))                                       \
    X(void, CPLPopErrorHandler, (void))                                                            \
    X(void *, CPLGetErrorHandlerUserData, (void))                                                  \
    X(void, CPLSetThreadLocalConfigOption, (const char *, const char *))

typedef struct gdal_library {
#define GDAL_MEMBER(result, name, parameters) result(*name) parameters;
    GDAL_FUNCTIONS(GDAL_MEMBER)
#undef GDAL_MEMBER
} gdal_library;

/* Loads the library where it is not there yet, and fills the table. NULL, or what is wrong. */
const char *gdal_load(gdal_library *l);
/* For an error handler: what was given when it was pushed, in this thread. */
void *gdal_handler_data(void);

#endif

#endif

/* projection.c - from latitude and longitude to metres: transverse Mercator by Krueger's series in
 * the third flattening, to its fourth power, which is good to micrometres within thousands of
 * kilometres.
 */
#include "gis.h"

#include <math.h>
#include <stdio.h>

#include "runtime/real.h"
#include "runtime/value.h"

#define FLATTENING (1 / 298.257223563)
#define EQUATOR    6378137.0
#define N          (FLATTENING / (2 - FLATTENING))
/* The radius of the sphere with the ellipsoid's meridians. */
#define RADIUS (EQUATOR / (1 + N) * (1 + N * N / 4 + N * N * N * N / 64))

enum { TERMS = 4, LONGITUDE_MAX = 80 };

#define DEGREES 57.295779513082320877

typedef struct complex_number {
    double re, im;
} complex_number;

static double inverse_tanh(double x)
{
    return real_log((1 + x) / (1 - x)) / 2;
}

/* The tangent of the conformal latitude. */
static double conformal_tangent(double latitude)
{
    double sine = real_sin(latitude), eccentricity = sqrt(FLATTENING * (2 - FLATTENING));
    if (fabs(sine) >= 1)
        return sine * 1e15;
    double psi = inverse_tanh(sine) - eccentricity * inverse_tanh(eccentricity * sine);
    double e = real_exp(psi);
    return (e - 1 / e) / 2;
}

/* Adds the series: the sum of alpha[j] sin(2 j z). */
static complex_number corrected(complex_number z)
{
    static const double alpha[TERMS] = {
        N / 2 - 2 * N * N / 3 + 5 * N * N * N / 16 + 41 * N * N * N * N / 180,
        13 * N * N / 48 - 3 * N * N * N / 5 + 557 * N * N * N * N / 1440,
        61 * N * N * N / 240 - 103 * N * N * N * N / 140,
        49561 * N * N * N * N / 161280,
    };
    double s = real_sin(2 * z.re * DEGREES), c = real_cos(2 * z.re * DEGREES),
           e = real_exp(2 * z.im);
    double hyperbolic_cosine = (e + 1 / e) / 2, hyperbolic_sine = (e - 1 / e) / 2;
    complex_number before = {0, 0}, sine = {s * hyperbolic_cosine, c * hyperbolic_sine};
    complex_number twice_cosine = {2 * c * hyperbolic_cosine, -2 * s * hyperbolic_sine};
    for (int j = 0; j < TERMS; j++) {
        z.re += alpha[j] * sine.re;
        z.im += alpha[j] * sine.im;
        complex_number next = {twice_cosine.re * sine.re - twice_cosine.im * sine.im - before.re,
                               twice_cosine.re * sine.im + twice_cosine.im * sine.re - before.im};
        before = sine;
        sine = next;
    }
    return z;
}

/* Northing and easting in radii; `longitude` is that from the origin. */
static complex_number on_sphere(double latitude, double longitude)
{
    double t = conformal_tangent(latitude);
    complex_number z = {real_atan2(t, real_cos(longitude)) / DEGREES,
                        inverse_tanh(real_sin(longitude) / real_hypot(1, t))};
    return corrected(z);
}

void gis_projection_open(gis_projection *p, double latitude, double longitude)
{
    p->latitude = latitude;
    p->longitude = longitude;
    p->north = on_sphere(latitude, 0).re;
}

void gis_projection_write(const gis_projection *p, char *out)
{
    char latitude[VALUE_NUMBER_BYTES], longitude[VALUE_NUMBER_BYTES];
    value_number(latitude, p->latitude);
    value_number(longitude, p->longitude);
    snprintf(out, GIS_PROJ_BYTES,
             "+proj=tmerc +lat_0=%s +lon_0=%s +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
             latitude, longitude);
}

bool gis_project(const gis_projection *p, double latitude, double longitude, double *east,
                 double *north)
{
    if (!(fabs(latitude) <= 90) || !(fabs(longitude) <= 360))
        return false;
    double from_origin = longitude - p->longitude;
    if (from_origin > 180)
        from_origin -= 360;
    if (from_origin < -180)
        from_origin += 360;
    if (!(fabs(from_origin) <= LONGITUDE_MAX))
        return false;
    complex_number z = on_sphere(latitude, from_origin);
    *east = RADIUS * z.im;
    *north = RADIUS * (z.re - p->north);
    return true;
}

double gis_rounded(double metres)
{
    return floor(metres * 0x1p20 + 0.5) * 0x1p-20;
}

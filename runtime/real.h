/* real.h - elementary functions with the same result on every machine.
 *
 * The C library picks its sine or exponential by the processor's instructions, so their last bits
 * differ between two machines, and a graph's result with them. These use additions,
 * multiplications, divisions and square roots alone, which IEEE 754 fixes to the bit. They are off
 * by a few units in the last place at most, and exact where a user would look: the sine of 30
 * degrees is 0.5, 10 to the third is 1000.
 *
 * Angles are in degrees. Where there is no result they return a NaN, where it is too large an
 * infinity.
 */
#ifndef PCG_REAL_H
#define PCG_REAL_H

double real_sin(double degrees);
double real_cos(double degrees);
double real_tan(double degrees); /* infinity at 90, 270 … */
double real_asin(double x);      /* -90 … 90; NaN outside of -1 … 1 */
double real_acos(double x);      /* 0 … 180; NaN outside of -1 … 1 */
double real_atan(double x);      /* -90 … 90 */
double real_atan2(double y, double x); /* -180 … 180: the direction of (x, y); 0 for (0, 0) */
double real_exp(double x);
double real_log(double x);       /* natural; NaN below 0, -infinity at 0 */
double real_log10(double x);
double real_pow(double x, double y); /* NaN where x < 0 and y is not whole */
double real_hypot(double x, double y); /* without overflow or underflow on the way */

#endif

/* All that a printed solver needs of <math.h>, for a compiler without a C library: whoever links it gives these functions. */
#ifndef FREESTANDING_MATH_H
#define FREESTANDING_MATH_H

#define NAN __builtin_nanf("")
#define INFINITY __builtin_inff()
#define isnan(x) __builtin_isnan(x)
#define isfinite(x) __builtin_isfinite(x)

double sqrt(double), sin(double), cos(double), round(double), floor(double), ceil(double);
double fabs(double), copysign(double, double), fmax(double, double), fmin(double, double);

float sqrtf(float), sinf(float), cosf(float), roundf(float), floorf(float), ceilf(float);
float fabsf(float), copysignf(float, float), fmaxf(float, float), fminf(float, float);

#endif

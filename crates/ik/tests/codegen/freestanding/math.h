/* The functions of <math.h> that a printed solver needs, for a compiler without a C library. They must be provided when linking. */
#ifndef FREESTANDING_MATH_H
#define FREESTANDING_MATH_H

#define INFINITY __builtin_inff()
#define isnan(x) __builtin_isnan(x)
#define isfinite(x) __builtin_isfinite(x)
#define NAN __builtin_nanf("")

double sqrt(double), fmod(double, double), fabs(double), copysign(double, double), round(double);
float sqrtf(float), fmodf(float, float), fabsf(float), copysignf(float, float), roundf(float);

#endif

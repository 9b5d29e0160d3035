/* Functions that printed equations of motion use, in C99: cosines and sines. The only dependency is the C library's fmod, for angles beyond a million rad (a
 * thousand in single precision). The operations are those of groebot-runtime's trigonometry.rs. Results are bitwise equal with every compiler, if products are
 * not contracted (gcc: -std=c99 or -ffp-contract=off).
 *
 * With GB_FLOAT every number is a float. */
#ifndef GROEBOT_DYNAMICS_H
#define GROEBOT_DYNAMICS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#ifndef GB_REAL
#define GB_REAL
#ifdef GB_FLOAT
typedef float gb_real;
#else
typedef double gb_real;
#endif
#endif

/* A literal, and a choice of two literals by precision. */
#ifdef GB_FLOAT
#define GB_N(number) number##f
#define GB_N_OR(number, single) single##f
typedef uint32_t gb_bits;
#define GB_SIGN_AT 30
#else
#define GB_N(number) number
#define GB_N_OR(number, single) number
typedef uint64_t gb_bits;
#define GB_SIGN_AT 62
#endif

#if defined(__GNUC__)
#define GB_RESTRICT __restrict
#else
#define GB_RESTRICT
#endif

/* The bits of a number, and the number of bits. */
static inline gb_bits gb_bits_of(gb_real number)
{
    gb_bits bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static inline gb_real gb_of_bits(gb_bits bits)
{
    gb_real number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

/* The cosine and the sine of an angle, each within one unit of its last place up to a million rad. There is no branch, so that compilers can vectorise over
 * several angles. */
static inline void gb_pair(gb_real angle, gb_real *cosine, gb_real *sine)
{
    /* Adding this to a number rounds that one to an integer, which is then in the last bits. */
    const gb_real whole = GB_N_OR(6755399441055744.0, 12582912.0);
    const gb_real shifted = angle * GB_N(0.6366197723675814) + whole, quarters = shifted - whole;
    /* Products of the first two parts of a quarter turn are exact, and so is the first difference. */
    const gb_real first = angle - quarters * GB_N_OR(1.5707963267341256, 1.5703125);
    const gb_real second = quarters * GB_N_OR(6.077100506303966e-11, 4.837512969970703e-4);
    const gb_real sum = first - second, almost = first - sum;
    const gb_real lost = (first - (sum + almost)) + (almost - second);
    const gb_real third = lost - quarters * GB_N_OR(2.0222662487959506e-21, 7.54978995489188e-8);
    const gb_real x = sum + third, rest = (sum - x) + third;
    const gb_real u = x * x, half = GB_N(0.5) * u, left = GB_N(1.0) - half;
    const gb_real high = GB_N(0.008333333333330948)
        + u * (GB_N(-0.00019841269836758574) + u * (GB_N(2.755731610255244e-06) + u * (GB_N(-2.5051131845003624e-08) + u * GB_N(1.5918129294866608e-10))));
    const gb_real s = x + (x * u * (GB_N(-0.16666666666666666) + u * high) + rest * left);
    const gb_real low = GB_N(2.480158729876569e-05)
        + u * (GB_N(-2.7557317271729793e-07) + u * (GB_N(2.08761462684032e-09) + u * GB_N(-1.1382632425521717e-11)));
    const gb_real top = GB_N(0.041666666666666664) + u * (GB_N(-0.0013888888888887398) + u * low);
    const gb_real c = left + (((GB_N(1.0) - left) - half) + (u * u * top - x * rest));
    const gb_bits turn = gb_bits_of(shifted), odd = (gb_bits)0 - (turn & 1), bits_c = gb_bits_of(c), bits_s = gb_bits_of(s);
    *cosine = gb_of_bits(((bits_c & ~odd) | (bits_s & odd)) ^ (((turn + 1) & 2) << GB_SIGN_AT));
    *sine = gb_of_bits(((bits_s & ~odd) | (bits_c & odd)) ^ ((turn & 2) << GB_SIGN_AT));
}

/* An angle in the range in which gb_pair is accurate. */
static inline gb_real gb_near(gb_real angle)
{
    const gb_real most = GB_N_OR(1e6, 1e3);
    if (angle <= most && angle >= -most) {
        return angle;
    }
#ifdef GB_FLOAT
    return fmodf(angle, 6.2831855f);
#else
    return fmod(angle, 6.283185307179586);
#endif
}

#endif

/* Parts of the run time that are compiled once for all robots: roots of polynomials, Newton's method near singular configurations, self-motions, merging of
 * equal solutions, limits and turns. They do the same operations as the files of groebot-runtime with these names; a robot is given by its gb_mechanism. */
#ifndef GROEBOT_C
#define GROEBOT_C

#ifndef GB_RUNTIME
#define GB_RUNTIME
#endif
#include "groebot.h"

/* The tolerances are those of groebot-runtime's tolerances.rs, where they are documented. */
#define GB_PIVOT GB_EITHER(1e-9, 1e-4)
#define GB_NEGLIGIBLE GB_EITHER(1e-290, 1e-30)
#define GB_TOLERATED GB_EITHER(1e-6, 1e-3)
#define GB_POLISH_STEPS 32
#define GB_FITTING_STEPS 16
#define GB_OVERSHOT R(100.0)
#define GB_RETURNS 4
#define GB_STIFF R(1e-6)
#define GB_PATIENCE 3
#define GB_SHORT GB_EITHER(1e-9, 1e-4)
#define GB_ADRIFT GB_EITHER(1e-6, 1e-3)
#define GB_ASIDE R(0.1)
#define GB_SINGULAR GB_EITHER(1e-13, 3e-5)
#define GB_REGULAR GB_EITHER(1e-6, 1e-2)
#define GB_DISTINCT GB_EITHER(1e-4, 1e-2)
#define GB_NARROWS GB_EITHER_COUNT(5, 1)
#define GB_DOUBLINGS 8
#define GB_FIRST_STAGE R(128.0)
#define GB_APART_BY R(0.7)
#define GB_FARTHER R(16.0)
#define GB_FARTHEST R(256.0)
#define GB_ALONE GB_EITHER(1e-13, 5e-6)
#define GB_DOUBTED GB_EITHER(1e-9, 1e-3)
#define GB_LEVER R(0.1)
#define GB_TWIN R(10.0)
#define GB_TWIN_AT R(2.0)
#define GB_TWIN_WITHIN R(32.0)
#define GB_INVERSIONS 3
#define GB_ALIKE GB_EITHER(2.5e-15, 1e-6)
#define GB_BENT GB_EITHER(1e-4, 1e-2)
#define GB_ARRIVED R(1e-3)
#define GB_LEAPT R(0.1)
#define GB_ASTRAY GB_EITHER(1e-8, 1e-3)
#define GB_PACES 100
#define GB_SLACK GB_EITHER(1e-9, 1e-5)
#define GB_STRIDE R(0.1)
#define GB_STRIDES 63

#ifdef GB_FLOAT
#define GB_EITHER_COUNT(number, single) single
#else
#define GB_EITHER_COUNT(number, single) number
#endif

static const gb_real gb_leaps[] = {R(0.5), R(0.1), R(0.02)};
static const gb_real gb_freeing[] = {R(1e-2), R(1e-4), R(1e-6), R(1e-8), R(1e-8)};
static const gb_real gb_along[] = {R(6e-3), R(2.5e-2), R(0.2)};
#ifdef GB_FLOAT
static const gb_real gb_dampings[] = {R(0.0), R(1e-5), R(1e-4), R(1e-3)};
#else
static const gb_real gb_dampings[] = {R(0.0), R(1e-12), R(1e-9), R(1e-6), R(1e-3), R(1e-18)};
#endif

#define GB_LENGTH_OF(list) (sizeof(list) / sizeof(list)[0])

/* Whether a number is finite. */
static bool gb_is_finite(gb_real x)
{
    return gb_magnitude(x) <= GB_GREATEST;
}

/* Whether a number is within bounds. */
static bool gb_is_between(gb_real x, gb_real low, gb_real high)
{
    return x >= low && x <= high;
}

#include "groebot/trigonometry.c"
#include "groebot/quartic.c"
#include "groebot/roots.c"
#include "groebot/joints.c"
#include "groebot/problem.c"
#include "groebot/newton.c"
#include "groebot/self_motion.c"
#include "groebot/strays.c"
#include "groebot/freedom.c"
#include "groebot/curve.c"
#include "groebot/refine.c"
#include "groebot/members.c"
#include "groebot/limits.c"

#endif

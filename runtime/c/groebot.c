/* Parts of the run time that are compiled once for all robots: roots of polynomials, Newton's method near singular configurations, self-motions, merging of
 * equal solutions, limits and turns. They do the same operations as the files of groebot-runtime with these names; a robot is given by its gb_mechanism. */
#ifndef GROEBOT_C
#define GROEBOT_C

#ifndef GB_RUNTIME
#define GB_RUNTIME
#endif
#include "groebot.h"

/* Numbers and lengths of steps are those of groebot-runtime's effort.rs, where they are documented. */
#define GB_POLISH_STEPS 32
#define GB_FITTING_STEPS 16
#define GB_DESCENTS 32
#define GB_OVERSHOT R(100.0)
#define GB_RETURNS 4
#define GB_PATIENCE 3
#define GB_ASIDE R(0.1)
#define GB_NARROWS GB_EITHER_COUNT(5, 1)
#define GB_DOUBLINGS 8
#define GB_FIRST_STAGE R(128.0)
#define GB_APART_BY R(0.7)
#define GB_FARTHER R(16.0)
#define GB_FARTHEST R(256.0)
#define GB_LEVER R(0.1)
#define GB_LEAPT R(0.1)
#define GB_PACES 100
#define GB_STRIDE R(0.1)
#define GB_STRIDES 63

#ifdef GB_FLOAT
#define GB_EITHER_COUNT(number, single) single
#else
#define GB_EITHER_COUNT(number, single) number
#endif

static const gb_real gb_leaps[] = {R(0.5), R(0.1), R(0.02)};
static const gb_real gb_freeing[] = {GB_POLISHING_FREEING};
static const gb_real gb_along[] = {R(6e-3), R(2.5e-2), R(0.2)};
static const gb_real gb_dampings[] = {GB_POLISHING_DAMPINGS};

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
#include "groebot/triangle.c"
#include "groebot/newton.c"
#include "groebot/self_motion.c"
#include "groebot/connection.c"
#include "groebot/rejected.c"
#include "groebot/freedom.c"
#include "groebot/curve_steps.c"
#include "groebot/curve.c"
#include "groebot/keep.c"
#include "groebot/refine.c"
#include "groebot/members.c"
#include "groebot/order.c"
#include "groebot/limits.c"
#include "groebot/nearest.c"

#endif

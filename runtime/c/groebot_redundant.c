/* Arms with one joint more than their task determines: arcs of solutions within limits. The operations are those of groebot-runtime's redundant. */
#ifndef GROEBOT_REDUNDANT_C
#define GROEBOT_REDUNDANT_C

#ifndef GB_RUNTIME
#define GB_RUNTIME
#endif
#ifndef GB_SHARED
#include "groebot.h"
#endif
#include "groebot_redundant.h"

/* Maximal number of equations. */
#define GB_ARM_ROWS (GB_MOST_ARM_JOINTS - 1)
/* An entry for each joint, rounded up to whole registers. */
#define GB_ARM_ANGLES (GB_MOST_ARM_JOINTS + 1)

/* The first and the longest step (rad, or relative to the characteristic length). */
#define GB_ARM_FIRST_PACE R(0.2)
#define GB_ARM_LONGEST_PACE R(0.5)
/* The shortest step. Where a shorter one would be necessary, two curves cross. Number and lengths of the steps across such a crossing. */
#define GB_ARM_SHORTEST_PACE (R(0.1) * GB_MERGING_APART)
#define GB_ARM_LEAPS 4
static const gb_real gb_arm_leaps[GB_ARM_LEAPS] = {GB_MERGING_APART, R(1e-3), R(1e-2), R(5e-2)};
/* Maximal length of the first correction; maximal ratio of the second one to it; the least cosine of the angle between directions at both ends of a step. */
#define GB_ARM_CORRECTION R(2e-3)
#define GB_ARM_CONTRACTION R(0.25)
#define GB_ARM_STRAIGHT R(0.8)
/* With steps shorter than this share of the longest one, the curvature is checked. It is wrong if its relative error is more than the second number. */
#define GB_ARM_SMALL R(0.2)
#define GB_ARM_WRONG R(0.5)
/* Maximal change of a piece's length, relative to it, by the term of degree four. */
#define GB_ARM_FOURTH R(1e-3)

/* Iterations for a root of a cubic. Maximal length of the correction of a predicted crossing, relative to its piece. */
#define GB_ARM_ROOT_STEPS 40
#define GB_ARM_CROSSING R(0.1)

/* Maximal number of steps along a curve. A crossing is not searched for with steps shorter than this. Newton steps to a crossing that is no known end point. */
#define GB_ARM_PIECES 5000
#define GB_ARM_SHORTEST (R(0.2) * GB_MERGING_APART)
#define GB_ARM_LOCATING 12
/* The least cosine of the angle between the directions of a curve and of an end point on it. A point is on a piece when it is within this distance, relative
 * to the piece's length. */
#define GB_ARM_ALIGNED R(0.7)
#define GB_ARM_ON R(0.02)

/* Maximal number of end points of a target, and of solutions on curves along which a joint remains at its limit. The partner of an end point that belongs to
 * no arc. */
#define GB_ARM_ENDS 256
#define GB_ARM_TOUCHING 32
#define GB_ARM_FREE SIZE_MAX

/* Maximal number of solutions that are waiting for a curve. The number of values of the grid at first. Between two values, so many times the middle
 * is added where the number of solutions changes, or where solutions are close to each other. */
#define GB_ARM_SEEDS 384
#define GB_ARM_SCANNED 16
#define GB_ARM_HALVINGS 2
/* Starts of Newton's method where there is no solution for any value; maximal numbers of steps and of halvings of a step; maximal length of a step, and of one
 * that is not shortened to it because the equations are singular. What is added to the golden ratio for each further joint. */
#define GB_ARM_STARTS 8
#define GB_ARM_APPROACH_STEPS 60
#define GB_ARM_APPROACH_HALVINGS 6
#define GB_ARM_APPROACH R(0.7)
#define GB_ARM_SINGULAR R(1e6)
#define GB_ARM_STRIDE R(0.13)
/* Maximal number of values, with those of solutions by Newton's method. A value that each closed curve passes along which an unlimited joint makes a whole
 * turn. */
#define GB_ARM_GROUPS (GB_ARM_SCANNED + (GB_ARM_SCANNED - 1) * GB_ARM_HALVINGS + GB_MOST_SECTIONS + GB_MOST_ARM_JOINTS + GB_ARM_STARTS)
#define GB_ARM_ANY_VALUE R(1.0)
/* Solutions for one value are close when no joint differs by more than this. Steps of Newton's method for a root of a cubic. Values of a prismatic joint
 * without limits, relative to the characteristic length. */
#define GB_ARM_CLOSE R(0.1)
#define GB_ARM_SEED_STEPS 4
#define GB_ARM_FARTHEST R(10.0)

/* Where two traces lead to one end point, both are repeated with steps of a quarter of the length, at most so many times. */
#define GB_ARM_LEVELS 3

/* Newton steps from the cubic of a piece to the curve. */
#define GB_ARM_CORRECTIONS 8

/* Shares of the scanned joint's range, in the order in which values are tried. The number of values in the whole turn of the scanned joint, from which it
 * follows whether the target is reachable at all. */
#define GB_ARM_TRIED 7
static const gb_real gb_arm_tried[GB_ARM_TRIED] = {R(0.5), R(0.375), R(0.625), R(0.25), R(0.75), R(0.125), R(0.875)};
#define GB_ARM_AROUND 32

/* The number of samples on each piece of a curve. Iterations of golden section search on the cubics of pieces, and on a cubic close to an optimum. Half of the
 * length of that cubic, relative to the distance of the samples beside the optimum; it is moved at most so many times. Samples differ from the curve by at most
 * GB_ARM_SAMPLED. The golden ratio's inverse. */
#define GB_ARM_SAMPLES 6
#define GB_ARM_COARSE 12
#define GB_ARM_FINE 40
#define GB_ARM_CLOSE_OPTIMUM R(0.06)
#define GB_ARM_MOVES 8
#define GB_ARM_SAMPLED R(2e-3)
#define GB_ARM_GOLDEN R(0.6180339887498949)

#include "groebot/six_axes/lanes.c"
#include "groebot/six_axes/vector.c"
#include "groebot/six_axes/rigid.c"
#include "groebot/redundant/lists.c"
#include "groebot/redundant/elimination.c"
#include "groebot/redundant/goal.c"
#include "groebot/redundant/links.c"
#include "groebot/redundant/model.c"
#include "groebot/redundant/step.c"
#include "groebot/redundant/crossing.c"
#include "groebot/redundant/ends.c"
#include "groebot/redundant/seeds.c"
#include "groebot/redundant/approach.c"
#include "groebot/redundant/trace.c"
#include "groebot/redundant/arcs.c"
#include "groebot/redundant/closed.c"
#include "groebot/redundant/along.c"
#include "groebot/redundant/turns.c"
#include "groebot/redundant/within.c"
#include "groebot/redundant/best.c"

#endif

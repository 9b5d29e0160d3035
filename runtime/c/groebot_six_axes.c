/* Six joints in any place, found together: all real solutions, sixteen at most, by one eigenvalue problem. As groebot-runtime's six_axes, operation by
 * operation.
 *
 * The joint that is hidden moves E2 E3 (line 4) to G E6^-1 E5^-1 (line 4), joints counted from it and the axes behind the target moved to its other side.
 * Of a line, fourteen functions (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508) turn with each joint by matrices that are affine in the
 * cosine and sine of its angle. Seen from the hidden joint, four pairs of them turn as plane vectors do, and six stay as they are. Two vectors a, b with b
 * turned from a fulfil Rodrigues' equation b - a = x w x (a + b), x the tangent of half the angle: linear in x, so that the eigenvalue problem has as many
 * rows as the chain has solutions. */
#ifndef GROEBOT_SIX_AXES_C
#define GROEBOT_SIX_AXES_C

#ifndef GB_RUNTIME
#define GB_RUNTIME
#endif
#ifndef GB_SHARED
#include "groebot.h"
#endif
#include "groebot_six_axes.h"

/* Rows and columns of the pencil, the number of complex solutions of a general chain. */
#define GB_SIX_SIZE 16
/* Functions that the motion along the hidden axis leaves alone, and those that it moves; the products of one of 1, c, s of a first joint and one of 1, c, s
 * of a second one: the second changes fastest. */
#define GB_SIX_STILL 6
#define GB_SIX_MOVING 8
#define GB_SIX_PRODUCTS 9
/* Products of the joints on the far side, without 1; those on the near side and then those on the far side. */
#define GB_SIX_FAR 8
#define GB_SIX_COLUMNS 17
/* Monomials of the doubled joint times products of the other near one; columns before elimination: the near ones, then the far ones with the cosine and
 * with the sine of the half angle. */
#define GB_SIX_NEAR 12
#define GB_SIX_ALL 28
/* What was solved for in the pencil at most. */
#define GB_SIX_SOLVED 12
/* The most answers that are kept while formulations are united, and the most candidates that are remembered. */
#define GB_SIX_KEPT 32

/* A pivot of a still equation below this share of its largest coefficient is not taken while the far products alone are solved for. */
#define GB_SIX_WEAK GB_EITHER(1e-3, 1e-2)
/* Half angles (arc tangents of half a way) from which the hidden one is counted: the first whose matrix can be inverted well is taken. */
#define GB_SIX_ORIGINS 3
static const gb_real gb_six_origins[GB_SIX_ORIGINS] = {R(0.4), R(1.1), -R(0.5)};
/* The smallest share of a pivot in the largest entry of its matrix at which an origin is taken at once. */
#define GB_SIX_SOUND_ORIGIN GB_EITHER(1e-9, 1e-3)
/* The square, times the share of the pivot, of the distance of eigenvalues that coincide: closer than its root, as a share of 1 + |x|^2, rounding may have
 * parted a multiple one, into a complex pair as well. */
#define GB_SIX_COINCIDING GB_EITHER(1e-14, 1e-6)
/* Rounds of simultaneous iteration, and the distance of its shift from the eigenvalue, as a share of 1 + |x|, so that the matrix is regular. */
#define GB_SIX_CLUSTER_ROUNDS 2
#define GB_SIX_SHIFT GB_EITHER(1e-9, 1e-4)
/* Half the doubled angle is counted from here. */
#define GB_SIX_CLUSTER_ORIGIN R(0.7)
/* The smallest share of a pivot at which the monomials determine the matrix of tangents. */
#define GB_SIX_DETERMINED GB_EITHER(1e-10, 1e-4)
/* Tangents closer than this share of 1 + |t|^2 do not separate solutions. */
#define GB_SIX_SEPARATE GB_EITHER(1e-4, 1e-2)
/* QR steps for one deflation; every tenth has an exceptional shift. */
#define GB_SIX_QR_STEPS 60
/* The square of a column that is taken for zero. */
#define GB_SIX_FAINT GB_EITHER(1e-280, 1e-35)
/* Solutions of (H - x) y = b, each from the one before. Their number is odd: next to a double eigenvalue with one eigenvector the inverse is like that of a
 * Jordan block that rounding has disturbed, whose square is like the identity. */
#define GB_SIX_ROUNDS 3

/* Newton steps at most: at a singular pose each only halves the miss. */
#define GB_SIX_STEPS 40
/* A miss below which no further step is tried. */
#define GB_SIX_EXACT GB_EITHER(2e-15, 5e-7)
/* A miss below which a single step that does not halve it is the last. */
#define GB_SIX_ROUNDING GB_EITHER(1e-13, 1e-5)
/* How often a step may be shortened, over all steps. */
#define GB_SIX_SHORTENED 12
/* A step that moves a joint by more than this is shortened. */
#define GB_SIX_LONGEST R(0.5)
/* The sine of a turn next to half a one, whose axis rounding hides. */
#define GB_SIX_NO_AXIS GB_EITHER(1e-6, 1e-3)
/* A column of the Jacobian of which no more than this share is across the columns behind it depends on them. */
#define GB_SIX_SINGULAR GB_EITHER(1e-6, 2e-3)

/* A fifth pivot of the Jacobian below this share of the first: there is more than a curve. */
#define GB_SIX_RANK R(1e-3)
/* The largest singular value, about, of what is taken for a curve. */
#define GB_SIX_STEEP R(1e-2)
/* Where joints change the sixth equation by more after so many steps across, no curve is near. */
#define GB_SIX_FLAT R(5e-2)
#define GB_SIX_EARLY 2
/* The most that may be missed on a curve, as a share of the length scale or in radians. */
#define GB_SIX_ADRIFT R(1e-3)
/* A last step across the curve. */
#define GB_SIX_SETTLED GB_EITHER(1e-9, 1e-4)
/* What rounding leaves of the equations on a self-motion. */
#define GB_SIX_LEVEL GB_EITHER(1e-13, 1e-5)
/* Steps across the curve at most, from where a walk may begin, and from the end of a step along it. */
#define GB_SIX_MANY 12
#define GB_SIX_FEW 5
/* The length of a step along the curve; the least one, as a share of it; the most steps of a walk in one direction. */
#define GB_SIX_STRIDE R(0.1)
#define GB_SIX_SHORT R(0.015)
#define GB_SIX_PACES 400
/* Rounds of the false position between two steps. */
#define GB_SIX_NEXT R(30.0)
#define GB_SIX_NARROWED 16

/* Answers whose joints all differ by no more than this (rad) are one. */
#define GB_SIX_MERGE GB_EITHER(1e-7, 2e-3)
/* The largest residual of an answer, as a share of the length scale or in radians. */
#define GB_SIX_ACCEPT GB_EITHER(1e-12, 2e-5)
/* Candidates that are no farther than this from one that is known are not remembered again. */
#define GB_SIX_ALIKE R(1e-2)
/* An answer on a curve that is no farther than this from one that is known is that one. */
#define GB_SIX_APART GB_EITHER(1e-4, 2e-2)
/* The share of a pivot below which another formulation is asked too. */
#define GB_SIX_SOUND GB_EITHER(1e-11, 1e-4)
/* The share of a pivot below which the pencil is singular: every number is an eigenvalue, and those that are found say nothing. */
#define GB_SIX_SINGULAR_PENCIL GB_EITHER(1e-13, 1e-6)
/* The share of a pivot at which a target without real eigenvalues is out of reach. */
#define GB_SIX_CLEAR GB_EITHER(1e-6, 1e-3)
/* A candidate that misses the target by more before polishing shows that the eigenvalues are not accurate. */
#define GB_SIX_ACCURATE GB_EITHER(1e-6, 2e-2)
/* What stands in for the accuracy of the eigenvalues when it is better than that. */
#define GB_SIX_UNKNOWN GB_EITHER(1e-11, 1e-5)
/* The square of a complex eigenvalue's depth as a multiple of the eigenvalues' accuracy: below it, it may be a double root. */
#define GB_SIX_OFF GB_EITHER(1e3, 1e2)
/* Below it, it is tried. */
#define GB_SIX_FAR_OFF GB_EITHER(1e7, 1e3)
/* A complex pair that is farther off the real line is no double root that rounding has parted. */
#define GB_SIX_BLURRED GB_EITHER(1e-2, 1e-1)
/* More than any eigenvalue is off the real line. */
#define GB_SIX_DEEPEST R(1.0)
/* A way of so many length scales stands for an infinite one. */
#define GB_SIX_LONG GB_EITHER(1e4, 1e2)
/* Targets next to one where complex solutions nearly meet, for a robot that is a little off: how many times as far as that robot is off, in turn to one side and
 * the other. */
#define GB_SIX_MEETINGS 4
static const gb_real gb_six_meetings[GB_SIX_MEETINGS] = {R(30.0), R(30.0), R(1e3), R(1e3)};
/* Stages in which a candidate next to the target is led to it. */
#ifdef GB_FLOAT
#define GB_SIX_STAGES 8
#else
#define GB_SIX_STAGES 20
#endif
/* By attempt, how far aside the target is put: where solutions share a hidden angle, or a self-motion stands at the same target, the eigenvectors of isolated
 * ones are only found next to it. */
#define GB_SIX_ATTEMPTS 10
static const gb_real gb_six_disturbances[GB_SIX_ATTEMPTS] = {
    R(0.0), R(0.0), R(0.0), R(0.0), GB_EITHER(1e-4, 1e-2), GB_EITHER(1e-4, 1e-2), GB_EITHER(1e-3, 3e-2), GB_EITHER(1e-3, 3e-2), R(1e-2), R(1e-2),
};
/* The axis of the motions that put targets aside. */
static const gb_real gb_six_direction[3] = {R(0.48), R(0.6), R(0.64)};

#include "groebot/six_axes/lanes.c"
#include "groebot/six_axes/vector.c"
#include "groebot/six_axes/rigid.c"
#include "groebot/six_axes/screw.c"
#include "groebot/six_axes/chain.c"
#include "groebot/six_axes/profile.c"
#include "groebot/six_axes/rows.c"
#include "groebot/six_axes/pencil.c"
#include "groebot/six_axes/linear.c"
#include "groebot/six_axes/hessenberg.c"
#include "groebot/six_axes/shifted_qr.c"
#include "groebot/six_axes/inverse_iteration.c"
#include "groebot/six_axes/cluster.c"
#include "groebot/six_axes/candidates.c"
#include "groebot/six_axes/polish.c"
#include "groebot/six_axes/answers.c"
#include "groebot/six_axes/section.c"
#include "groebot/six_axes/curve.c"
#include "groebot/six_axes/solve.c"

#endif

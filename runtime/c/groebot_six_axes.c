/* General chains of six joints: all real solutions, at most sixteen, by one eigenvalue problem. The operations are those of groebot-runtime's six_axes.
 *
 * Joints are counted from the hidden one, and the axes after the target are moved to its other side. The hidden joint maps E2 E3 (line 4) to G E6^-1 E5^-1
 * (line 4). Fourteen functions of a line (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508) are transformed by each joint with matrices that
 * are affine in the cosine and sine of its angle. In the frame of the hidden joint, four pairs of them rotate as plane vectors do, and six are invariant.
 * Two vectors a, b with b rotated from a fulfil Rodrigues' equation b - a = x w x (a + b), where x is the tangent of half the angle. It is linear in x, so
 * that the eigenvalue problem has as many rows as the chain has solutions. */
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
/* Number of functions that the motion along the hidden axis leaves invariant, and of those that it moves. Products of one of 1, c, s of a first joint and
 * one of 1, c, s of a second one; the second index changes fastest. */
#define GB_SIX_STILL 6
#define GB_SIX_MOVING 8
#define GB_SIX_PRODUCTS 9
/* Number of products of the joints on the far side, without 1, and of those on the near side followed by those on the far side. */
#define GB_SIX_FAR 8
#define GB_SIX_COLUMNS 17
/* Monomials of the doubled joint times products of the other near one. Columns before elimination: the near ones, then the far ones with the cosine and with
 * the sine of the half angle. */
#define GB_SIX_NEAR 12
#define GB_SIX_ALL 28
/* Maximal number of unknowns that are eliminated in the pencil. */
#define GB_SIX_SOLVED 12
/* Maximal number of solutions that are kept while formulations are merged, and of candidates that are stored. */
#define GB_SIX_KEPT 32

/* While the equations are solved for far products, a pivot below this share of its equation's largest coefficient is not used. */
#define GB_SIX_WEAK GB_EITHER(1e-3, 1e-2)
/* Origins of the hidden half angle (arc tangent of half a displacement). The first one with a well-conditioned matrix is used. */
#define GB_SIX_ORIGINS 3
static const gb_real gb_six_origins[GB_SIX_ORIGINS] = {R(0.4), R(1.1), -R(0.5)};
/* Least pivot, relative to the largest entry of its matrix, at which an origin is accepted at once. */
#define GB_SIX_SOUND_ORIGIN GB_EITHER(1e-9, 1e-3)
/* Bound on the squared distance of coincident eigenvalues, relative to `1 + |x|^2`, times the relative pivot. Within it rounding may have split a multiple
 * eigenvalue, possibly into a complex pair. */
#define GB_SIX_COINCIDING GB_EITHER(1e-14, 1e-6)
/* Number of simultaneous iterations, and the distance of their shift from the eigenvalue, relative to 1 + |x|, so that the matrix is regular. */
#define GB_SIX_CLUSTER_ROUNDS 2
#define GB_SIX_SHIFT GB_EITHER(1e-9, 1e-4)
/* Origin of half the doubled angle. */
#define GB_SIX_CLUSTER_ORIGIN R(0.7)
/* Least relative pivot at which the monomials determine the matrix of tangents. */
#define GB_SIX_DETERMINED GB_EITHER(1e-10, 1e-4)
/* Tangents closer than this, relative to `1 + |t|^2`, do not separate solutions. */
#define GB_SIX_SEPARATE GB_EITHER(1e-4, 1e-2)
/* Maximal number of QR steps for one deflation; every tenth has an exceptional shift. */
#define GB_SIX_QR_STEPS 60
/* A column with a smaller squared length counts as zero. */
#define GB_SIX_FAINT GB_EITHER(1e-280, 1e-35)
/* Number of iterations: solutions of `(H - x) y = b`. It is odd, because near a double eigenvalue with one eigenvector the inverse resembles that of a
 * perturbed Jordan block, whose square is close to the identity. */
#define GB_SIX_ROUNDS 3

/* Maximal number of Newton steps: at a singular pose each one only halves the residual. */
#define GB_SIX_STEPS 40
/* A residual below which no further step is tried. */
#define GB_SIX_EXACT GB_EITHER(2e-15, 5e-7)
/* A residual below which polishing ends after one step that does not halve it. */
#define GB_SIX_ROUNDING GB_EITHER(1e-13, 1e-5)
/* Maximal number of times that steps are shortened, over all steps. */
#define GB_SIX_SHORTENED 12
/* A step that moves a joint by more than this is shortened. */
#define GB_SIX_LONGEST R(0.5)
/* The sine of a rotation close to half a turn, at which rounding makes the axis inaccurate. */
#define GB_SIX_NO_AXIS GB_EITHER(1e-6, 1e-3)
/* A Jacobian column depends on the columns after it if at most this share of it is orthogonal to them. */
#define GB_SIX_SINGULAR GB_EITHER(1e-6, 2e-3)

/* Where the fifth pivot of the Jacobian is below this share of the first, the solution set has more than one dimension. */
#define GB_SIX_RANK R(1e-3)
/* The largest value of the least singular value, approximately, at which a curve is assumed. */
#define GB_SIX_STEEP R(1e-2)
/* Where the joints change the sixth equation by more than this after so many steps across the curve, no curve is near. */
#define GB_SIX_FLAT R(5e-2)
#define GB_SIX_EARLY 2
/* The largest residual on a curve, relative to the length scale or in radians. */
#define GB_SIX_ADRIFT R(1e-3)
/* The length of a last step across the curve. */
#define GB_SIX_SETTLED GB_EITHER(1e-9, 1e-4)
/* Rounding error of the equations on a self-motion. */
#define GB_SIX_LEVEL GB_EITHER(1e-13, 1e-5)
/* Maximal number of steps across the curve, from the start of a walk and from the end of a step along it. */
#define GB_SIX_MANY 12
#define GB_SIX_FEW 5
/* Length of a step along the curve; its least length, relative to that; maximal number of steps of a walk in one direction. */
#define GB_SIX_STRIDE R(0.1)
#define GB_SIX_SHORT R(0.015)
#define GB_SIX_PACES 400
/* Iterations of false position between two steps. */
#define GB_SIX_NEXT R(30.0)
#define GB_SIX_NARROWED 16

/* Solutions are equal when no joint differs by more than this (rad). */
#define GB_SIX_MERGE GB_EITHER(1e-7, 2e-3)
/* The largest residual of a solution, relative to the length scale or in radians. */
#define GB_SIX_ACCEPT GB_EITHER(1e-12, 2e-5)
/* Candidates within this distance of a stored one are not stored again. */
#define GB_SIX_ALIKE R(1e-2)
/* A solution on a curve within this distance of a known one is that one. */
#define GB_SIX_APART GB_EITHER(1e-4, 2e-2)
/* Relative pivot below which another formulation is run too. */
#define GB_SIX_SOUND GB_EITHER(1e-11, 1e-4)
/* Relative pivot below which the pencil is singular: every number is an eigenvalue, so that the computed ones are meaningless. */
#define GB_SIX_SINGULAR_PENCIL GB_EITHER(1e-13, 1e-6)
/* Relative pivot above which a target without real eigenvalues is out of reach. */
#define GB_SIX_CLEAR GB_EITHER(1e-6, 1e-3)
/* A candidate with a larger residual before polishing shows that the eigenvalues are inaccurate. */
#define GB_SIX_ACCURATE GB_EITHER(1e-6, 2e-2)
/* Lower bound on the assumed accuracy of the eigenvalues. */
#define GB_SIX_UNKNOWN GB_EITHER(1e-11, 1e-5)
/* Bound on the squared depth of a complex eigenvalue that may be a double root, relative to the accuracy of the eigenvalues. */
#define GB_SIX_OFF GB_EITHER(1e3, 1e2)
/* Bound on the squared depth of a complex eigenvalue that is tried, relative to that accuracy. */
#define GB_SIX_FAR_OFF GB_EITHER(1e7, 1e3)
/* A complex pair farther off the real line is not a double root split by rounding. */
#define GB_SIX_BLURRED GB_EITHER(1e-2, 1e-1)
/* An upper bound on the depth of all eigenvalues. */
#define GB_SIX_DEEPEST R(1.0)
/* A displacement of so many length scales represents an infinite one. */
#define GB_SIX_LONG GB_EITHER(1e4, 1e2)
/* Displacements of targets at which complex solutions nearly meet, for a robot within a tolerance. They are relative to that tolerance, alternately in both
 * directions. */
#define GB_SIX_MEETINGS 4
static const gb_real gb_six_meetings[GB_SIX_MEETINGS] = {R(30.0), R(30.0), R(1e3), R(1e3)};
/* Maximal number of stages in which a candidate at a displaced target is moved to the target. */
#ifdef GB_FLOAT
#define GB_SIX_STAGES 8
#else
#define GB_SIX_STAGES 20
#endif
/* Displacement of the target in each attempt. Some eigenvectors of isolated solutions can only be computed at a displaced target: where solutions share a
 * hidden angle, and where the target also has a self-motion. */
#define GB_SIX_ATTEMPTS 10
static const gb_real gb_six_disturbances[GB_SIX_ATTEMPTS] = {
    R(0.0), R(0.0), R(0.0), R(0.0), GB_EITHER(1e-4, 1e-2), GB_EITHER(1e-4, 1e-2), GB_EITHER(1e-3, 3e-2), GB_EITHER(1e-3, 3e-2), R(1e-2), R(1e-2),
};
/* The axis of the motions that displace targets. */
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

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

/* Origins of the hidden half angle (arc tangent of half a displacement). The first one with a well-conditioned matrix is used. */
#define GB_SIX_ORIGINS 3
static const gb_real gb_six_origins[GB_SIX_ORIGINS] = {R(0.4), R(1.1), -R(0.5)};
/* Number of simultaneous iterations. */
#define GB_SIX_CLUSTER_ROUNDS 2
/* Origin of half the doubled angle. */
#define GB_SIX_CLUSTER_ORIGIN R(0.7)
/* Maximal number of QR steps for one deflation; every tenth has an exceptional shift. */
#define GB_SIX_QR_STEPS 60
/* Number of iterations: solutions of `(H - x) y = b`. It is odd, because near a double eigenvalue with one eigenvector the inverse resembles that of a
 * perturbed Jordan block, whose square is close to the identity. */
#define GB_SIX_ROUNDS 3

/* Maximal number of Newton steps: at a singular pose each one only halves the residual. */
#define GB_SIX_STEPS 40
/* A residual below which no further step is tried. */
#define GB_SIX_EXACT (R(2.0) * GB_POLISHING_DONE_POSE)
/* Maximal number of times that steps are shortened, over all steps. */
#define GB_SIX_SHORTENED 12
/* A step that moves a joint by more than this is shortened. */
#define GB_SIX_LONGEST R(0.5)

/* Number of steps across the curve before the flatness is tested. */
#define GB_SIX_EARLY 2
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

/* Bound on the squared depth of a complex eigenvalue that may be a double root, relative to the accuracy of the eigenvalues. */
#define GB_SIX_OFF GB_EITHER(1e3, 1e2)
/* Bound on the squared depth of a complex eigenvalue that is tried, relative to that accuracy. */
#define GB_SIX_FAR_OFF GB_EITHER(1e7, 1e3)
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
static const gb_real gb_six_disturbances[GB_SIX_ATTEMPTS] = {GB_EIGENVALUES_ASIDE};
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
#include "groebot/six_axes/given.c"

#endif

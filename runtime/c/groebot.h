/* What runs on a robot, in C99: the run time of inverse kinematics that groebot derives.
 *
 * A robot's own file holds its program as straight-line code, and includes this one. It stands there for three readers:
 *   - callers of a robot find the types and functions that GB_DECLARE declares;
 *   - a robot's file, which includes itself, finds what its program is written in, once for each type of number (GB_WIDTH is 1 for one number, or how many
 *     a register holds), and at last (GB_WIDTH is 0) the functions that it offers;
 *   - groebot.c, compiled once for all robots, holds what seldom runs: it refines answers at singular poses, and finds roots of polynomials.
 *
 * Nothing is allocated, there is no state, and the same target has the same answers, to the last bit, with every compiler: all is built of IEEE 754's
 * operations in the order in which they are written. Compile with -ffp-contract=off where products may be contracted (gcc without -std=c99), and never
 * with -ffast-math. Of the C library it takes sqrt, and fmod for angles beyond a million.
 *
 * GB_FLOAT makes every number a float. GB_LANES says how many numbers a register takes at once: 1 for plain C.
 *
 * The folder groebot/ beside this file holds what this file and groebot.c are made of. All in one file: GB_LINKAGE defined as `static GB_UNUSED`, then this
 * file, the robot's header, its source, which then includes that one file, and groebot.c, parts in their places and without the other lines that include. */
#ifndef GROEBOT_H
#define GROEBOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef GB_API
#ifdef __cplusplus
#define GB_API extern "C"
#else
#define GB_API extern
#endif
#endif

#ifndef GB_REAL
#define GB_REAL
#ifdef GB_FLOAT
typedef float gb_real;
#else
typedef double gb_real;
#endif
#endif

/* A number of the target is infinite or not a number. */
#define GB_NOT_FINITE (-1)
/* The target lies on a stratum that could not be derived. */
#define GB_OPEN_STRATUM (-2)
/* The rotation of the target is off by more than 1e-9 (1e-4 in single precision). */
#define GB_NOT_ROTATION (-3)
/* The direction of the target is not of length one within 1e-9 (1e-4 in single precision). */
#define GB_NOT_UNIT (-4)
/* The steps of the target were spent before an answer was found: there may be some. */
#define GB_UNSETTLED (-5)
/* The task is not the pose of one tip: base and tool cannot be taken off the target. */
#define GB_NOT_POSE (-6)
/* The most steps of polishing that a target may take, where it is not said otherwise (define it when you compile the robot's file and groebot.c). A step is a
 * linear system of Newton's method, or an evaluation of the equations at joint values. When they are spent, candidates are not polished any more, and answers
 * are not settled. */
#ifndef GB_MOST_STEPS
#define GB_MOST_STEPS 300000
#endif
/* The most turns that are counted. */
#define GB_MOST_TURNS 1000000

/* Declares what a robot offers. Targets have so many numbers in metres and radians, unless the robot's file says so: the pose of the tip in the base
 * frame as its position and its rotation by rows, or what else the task is. Angles of solutions lie in (-pi, pi].
 *
 * NAME_solution: an answer.
 *     q           joint values, in the order of the joints
 *     residual    the largest magnitude among the equations' values at q, in the equations' own unit
 *     relative    the largest share of an equation's value in its size
 *     branch      which cases and which roots gave it; it keeps its number from target to target
 *     chosen      whether the source of the mechanism would choose this one
 *     settled     false where the steps of the target (GB_MOST_STEPS) were spent before all work was done. All of its answers say so: others may be missing,
 *                 and `relative` tells how well each holds, at most 1e-6 (1e-3 in single precision)
 *     free        bit j is set where joint j may take any value here: this is one member of a self-motion
 * NAME_pairs: an answer by joint's cosine and sine; a length's value and zero.
 *
 * NAME_solve: writes all solutions to the front of out, which has room for NAME_CAPACITY, by branch; their number, 0 out of reach, or a code below 0.
 * NAME_solve_bounded: the same with so many steps at most; GB_UNSETTLED where no answer was found before they were spent.
 * NAME_solve_or_nearest: as NAME_solve; where there is none, nearest is what missed the equations by the least share, or its residual is infinite.
 * NAME_solve_pairs: the same by cosines and sines; at ordinary targets no arc tangent is taken.
 * NAME_solve_placed: as NAME_solve, for a target whose first 12 numbers are world_from_tool, the pose of a tool in a world frame. base is world_from_base,
 *     tool is tip_from_tool; NULL is the identity. GB_NOT_POSE where the task is not the pose of one tip.
 * NAME_solve_batch: many targets, several at once in the lanes of registers. The solutions of a target stand in out behind those of the one before,
 *     counts says how many they are or why there are none. How many targets were solved: all, unless out has no room for those of the next one.
 *     Each solution is that of NAME_solve to the last bit.
 * NAME_residual: the largest magnitude of an equation's value at joint values q; not a number for a target that NAME_solve refuses, and where
 *     equations read what follows from no joint.
 * NAME_forward: the target that joint values reach; false for equations that do not compare the tip with the target.
 * NAME_target_of: the target base_from_tip for a pose world_from_tool, with base world_from_base and tool tip_from_tool.
 * NAME_count_turns: limits are the least and the greatest value of each joint in turn. The number of joint values that differ from q by whole turns of
 *     angles and lie within limits, which hold within 1e-9; an angle that lacks a limit counts once.
 * NAME_turn: writes the one with this index to out. Turns of the last joint follow one another.
 * NAME_solve_within: as NAME_solve, moved into limits by as few turns as can be, members of a self-motion along it; those that cannot are left out.
 * NAME_nearest: the index of the solution that comes nearest to a reference by turns within limits, which are written to q; -1 when none does. The
 *     distance is the sum of the squared differences, each times its weight. */
#define GB_DECLARE(name, inputs, joints_, capacity)                                                                                \
    typedef struct {                                                                                                               \
        gb_real q[joints_];                                                                                                        \
        gb_real residual;                                                                                                          \
        gb_real relative;                                                                                                          \
        size_t branch;                                                                                                             \
        bool chosen;                                                                                                               \
        bool settled;                                                                                                              \
        uint32_t free;                                                                                                             \
    } name##_solution;                                                                                                             \
    typedef struct {                                                                                                               \
        gb_real joints[joints_][2];                                                                                                \
        gb_real residual;                                                                                                          \
        size_t branch;                                                                                                             \
        uint32_t free;                                                                                                             \
        bool settled;                                                                                                              \
    } name##_pairs;                                                                                                                \
    GB_API const char *const name##_input_names[inputs];                                                                           \
    GB_API const char *const name##_joint_names[joints_];                                                                          \
    GB_API const gb_real name##_limits[2 * (joints_)];                                                                             \
    GB_API int name##_solve(const gb_real *target, name##_solution *out);                                                          \
    GB_API int name##_solve_bounded(const gb_real *target, size_t most, name##_solution *out);                                     \
    GB_API int name##_solve_or_nearest(const gb_real *target, name##_solution *out, name##_solution *nearest);                     \
    GB_API int name##_solve_pairs(const gb_real *target, name##_pairs *out);                                                       \
    GB_API int name##_solve_placed(const gb_real *base, const gb_real *tool, const gb_real *target, name##_solution *out);         \
    GB_API size_t name##_solve_batch(const gb_real *targets, size_t count, name##_solution *out, size_t room, int *counts);        \
    GB_API size_t name##_solve_pairs_batch(const gb_real *targets, size_t count, name##_pairs *out, size_t room, int *counts);     \
    GB_API gb_real name##_residual(const gb_real *target, const gb_real *q);                                                       \
    GB_API bool name##_forward(const gb_real *q, gb_real *target);                                                                 \
    GB_API void name##_target_of(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target);                  \
    GB_API size_t name##_count_turns(const gb_real *q, const gb_real *limits);                                                     \
    GB_API void name##_turn(const gb_real *q, const gb_real *limits, size_t index, gb_real *out);                                  \
    GB_API int name##_solve_within(const gb_real *target, const gb_real *limits, name##_solution *out);                            \
    GB_API int name##_nearest(const name##_solution *list, int count, const gb_real *reference, const gb_real *weights,            \
                              const gb_real *limits, gb_real *q)

#endif

#if (defined(GB_ROBOT) || defined(GB_RUNTIME)) && !defined(GB_SHARED)
#define GB_SHARED
#include "groebot/shared.h"
#endif

#if defined(GB_ROBOT) && !(defined(GB_WIDTH) && GB_WIDTH == 0)
#include "groebot/width.h"
#if GB_WIDTH > 0
#include "groebot/number.h"
#include "groebot/roots.h"
#include "groebot/angles.h"
#include "groebot/conditions.h"
#include "groebot/program.h"
#if GB_WIDTH > 1 || GB_LANES == 1
#include "groebot/measure.h"
#endif
#ifdef GB_SHORTS
#include "groebot/approach.h"
#endif
#include "groebot/candidates.h"
#if GB_WIDTH > 1 && GB_WIDTH == GB_LANES && defined(GB_RUNS)
#include "groebot/batch.h"
#endif
#else
#include "groebot/mechanism.h"
#ifdef GB_SHORTS
#include "groebot/ways.h"
#endif
#include "groebot/answers.h"
#include "groebot/described.h"
#include "groebot/solve.h"
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif
#endif

/* Run time of inverse kinematics in C99: the code that runs on a robot with solvers that groebot derives.
 *
 * A robot's own file has its program as straight-line code, and includes this one. This file serves three purposes:
 * - for callers of a robot's solver, GB_DECLARE declares the types and functions;
 * - a robot's file includes itself once for each type of number (GB_WIDTH is 1 for one number, or the number of lanes of a register), and this file then
 *   defines what its program uses. At last (GB_WIDTH is 0) this file defines the public functions;
 * - groebot.c, compiled once for all robots, has the rarely used parts: it refines solutions at singular poses, and finds roots of polynomials.
 *
 * Solving allocates nothing and has no state. Equal targets have bitwise equal solutions with every compiler, because all operations are those of IEEE 754 in
 * the written order. Compile with -ffp-contract=off where products may be contracted (gcc without -std=c99), and never with -ffast-math. The C library must
 * provide sqrt, and fmod for angles beyond a million.
 *
 * With GB_FLOAT every number is a float. GB_LANES is the number of lanes of a register: 1 for plain C.
 *
 * The folder groebot/ next to this file has the parts of this file and of groebot.c. All of them can be combined in one file. Define GB_LINKAGE as `static
 * GB_UNUSED`, then append this file, the robot's header, its source, which includes that one file, and groebot.c. Insert the parts in their places, and
 * remove the other lines that include files. */
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

/* A target number is infinite or NaN. */
#define GB_NOT_FINITE (-1)
/* The target is on a stratum for which no derivation exists. */
#define GB_OPEN_STRATUM (-2)
/* The rotation of the target is not orthogonal within 1e-9 (1e-4 in single precision). */
#define GB_NOT_ROTATION (-3)
/* The direction of the target does not have length one within 1e-9 (1e-4 in single precision). */
#define GB_NOT_UNIT (-4)
/* The steps of the target were used up before a solution was found. Solutions may exist. */
#define GB_UNSETTLED (-5)
/* The task is not the pose of one tip. The base and the tool cannot be removed from the target. */
#define GB_NOT_POSE (-6)
/* Default of the maximal number of polishing steps for a target (define it when you compile the robot's file and groebot.c). A step is one linear system of
 * Newton's method, or one evaluation of the equations at joint values. When they are used up, candidates are no longer polished, and solutions are not
 * settled. */
#ifndef GB_MOST_STEPS
#define GB_MOST_STEPS 300000
#endif
/* Maximal number of turns that are counted. */
#define GB_MOST_TURNS 1000000

/* Declares the types and functions of a robot's solver. For a pose task, a target is the pose of the tip in the base frame: its position and its rotation by
 * rows. Other tasks have their own numbers. Units are metres and radians unless the robot's file specifies others. Angles of solutions are in (-pi, pi].
 *
 * NAME_solution: one solution.
 * - q: joint values, in the order of the joints
 * - residual: the largest magnitude among the equations' values at q, in the equations' own unit
 * - relative: the largest value of an equation relative to its size
 * - branch: number of the combination of cases and roots; consistent from target to target
 * - chosen: whether the source of the mechanism would select this solution
 * - settled: false where the steps of the target (GB_MOST_STEPS) were used up before all work was done. This holds for all of its solutions, and others may be
 *   missing. `relative` is then at most 1e-6 (1e-3 in single precision)
 * - free: bit j is set where joint j is free: this is one member of a self-motion
 * NAME_pairs: one solution by the cosine and sine of each joint; a length's value and zero.
 *
 * NAME_solve: writes all solutions to the front of out, ordered by branch. out has room for NAME_CAPACITY. Returns their number, 0 if the target is out of
 * reach, or a code below 0.
 * NAME_solve_bounded: same as NAME_solve with at most so many steps. Returns GB_UNSETTLED where no solution was found before they were used up.
 * NAME_solve_or_nearest: same as NAME_solve. Where there is no solution, nearest has the least relative residual found; its residual is infinite if none was
 * found.
 * NAME_solve_pairs: same as NAME_solve by cosines and sines; at ordinary targets no arc tangent is computed.
 * NAME_solve_placed: same as NAME_solve for a target whose first 12 numbers are world_from_tool, the pose of a tool in a world frame. base is world_from_base,
 * and tool is tip_from_tool; NULL is the identity. Returns GB_NOT_POSE if the task is not the pose of one tip.
 * NAME_solve_batch: same as NAME_solve for many targets; the lanes of registers process several at once. The solutions of a target follow those of the target
 * before in out. An entry of counts is their number or an error code. Returns the number of solved targets: all, unless out has no room for the solutions of
 * the next one. Each solution is bitwise equal to that of NAME_solve.
 * NAME_residual: the largest magnitude of an equation's value at joint values q. NaN for a target that NAME_solve rejects, and where equations read numbers
 * that follow from no joint.
 * NAME_forward: the target that joint values reach. Returns false for equations that do not compare the tip with the target.
 * NAME_target_of: the target base_from_tip for a pose world_from_tool. base is world_from_base, and tool is tip_from_tool.
 * NAME_count_turns: the number of joint values that differ from q by whole turns of angles and are within limits. limits has the least and the greatest value
 * of each joint in turn. They hold within 1e-9. An angle that lacks a limit counts once.
 * NAME_turn: writes the turn with this index to out. The last joint changes fastest.
 * NAME_solve_within: same as NAME_solve, with each solution moved into limits by as few turns as possible, and members of a self-motion along it. Other
 * solutions are omitted.
 * NAME_nearest: the index of the solution that is nearest to a reference after turns within limits, or -1 if there is none. Writes its turn to q. The
 * distance is the sum of the squared differences, each times its weight. A member of a self-motion is used as listed.
 * NAME_nearest_to: writes the solution of a target that is nearest to a reference after turns within limits to out; its angles are not wrapped. Returns 1, 0
 * if no solution is within limits, or a code below 0. At a singular target the self-motions are searched, too. */
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
                              const gb_real *limits, gb_real *q);                                                              \
    GB_API int name##_nearest_to(const gb_real *target, const gb_real *reference, const gb_real *weights, const gb_real *limits,   \
                                 name##_solution *out)

#endif

#if (defined(GB_ROBOT) || defined(GB_RUNTIME)) && !defined(GB_SHARED)
#define GB_SHARED
#include "groebot/shared.h"
#include "groebot/tolerances.h"
#endif

#if defined(GB_PART) && defined(GB_WIDTH) && GB_WIDTH == 0
#include "groebot/part.h"
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
#if GB_WIDTH > 1 && GB_WIDTH == GB_LANES && defined(GB_RUNS) && !defined(GB_PART)
#include "groebot/batch.h"
#endif
#else
#include "groebot/mechanism.h"
#ifdef GB_SHORTS
#include "groebot/approaches.h"
#endif
#include "groebot/answers.h"
#include "groebot/described.h"
#include "groebot/solve.h"
#ifndef GB_PART
#include "groebot/public.h"
#endif
#ifdef GB_GIVEN
#include "groebot/given.h"
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif
#endif

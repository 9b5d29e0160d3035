/* General chains of six joints: declarations for the files of such robots. groebot_six_axes.c, compiled once for all robots, solves them. */
#ifndef GROEBOT_SIX_AXES_H
#define GROEBOT_SIX_AXES_H

#ifndef GROEBOT_H
#include "groebot.h"
#endif

/* Maximal number of solutions that are written. */
#define GB_SIX_ROOM 64
/* Capacity: each joint can be hidden, and each of the two after it doubled. */
#define GB_SIX_FORMULATIONS 12

/* A rigid motion: the rotation matrix, by rows, and the image of the origin. */
typedef struct {
    gb_real rotation[3][3];
    gb_real translation[3];
} gb_rigid;

/* The joint that is hidden in the pencil, and the one that is doubled. */
typedef struct {
    /* The joint, from 0, whose angle or displacement is the eigenvalue. */
    size_t hidden;
    /* Whether the equations are multiplied by half the angle, or by the displacement, of the second joint after the hidden one instead of the first. */
    bool second;
} gb_formulation;

/* A chain of six joints, given by their axes of rotation or translation. */
typedef struct {
    /* Directions of the axes at zero, of length one. */
    gb_real directions[6][3];
    /* Points on the axes at zero, divided by `length`, as are all lengths except those of `back`. */
    gb_real points[6][3];
    /* For each axis, two unit vectors orthogonal to it and to each other. */
    gb_real across[6][2][3];
    /* Whether joints are prismatic. */
    bool slides[6];
    /* At zero, each joint's frame in the frame of the joint before; the first one in the base. Its z axis is the joint's axis. */
    gb_rigid steps[6];
    /* At zero, the last joint's frame in the base. */
    gb_rigid last;
    /* The base in the frame of the tip at zero, in the unit of the target. */
    gb_rigid back;
    /* Characteristic length of the chain, in the unit of the target. */
    gb_real length;
    /* The eigenvalue problems, in the order in which they are tried, and their number, at least one. */
    gb_formulation formulations[GB_SIX_FORMULATIONS];
    size_t formulation_count;
    /* Tolerance between this robot and the one for which solutions are wanted (relative to `length`, and rad); zero where both are equal. Complex solutions
     * within this distance of each other count as lost solutions, because they may be real for the other robot. */
    gb_real within;
} gb_chain;

/* The axis of a joint with a given value between the six of a chain. */
typedef struct {
    /* The number of joints of the six before it, 1 to 5. */
    size_t before;
    /* Direction of its axis at zero, of length one. */
    gb_real direction[3];
    /* A point on its axis at zero, divided by the chain's `length`. */
    gb_real point[3];
    /* Whether it is prismatic. */
    bool slides;
} gb_given;

/* Joint values that reach the target, or a start near a solution that was lost. */
typedef struct {
    /* The joint values: angles in (-pi, pi] (rad), displacements in the unit of the target. */
    gb_real q[6];
    /* By joint: whether other joints compensate its motion, to first order. It may be free here, in a member of a self-motion. */
    bool free[6];
    /* Whether it is only near a solution. */
    bool lost;
} gb_six_answer;

/* gb_six_axes(chain, target, out) writes all joint values that reach a target, a position and a rotation matrix by rows, to the front of out, which has room
 * for GB_SIX_ROOM. Solutions are first, ascending by joint values, then the lost ones. Returns their number.
 *
 * gb_six_axes_given(chain, given, count, numbers, out) does the same when `count` joints between the six, from base to tip, have given values. After the
 * twelve numbers of the target, `numbers` contains for each of them the cosine and sine of its angle, or its displacement and an unused number. */

#endif

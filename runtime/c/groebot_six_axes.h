/* Six joints in any place, found together: for files of robots that have such. groebot_six_axes.c, compiled once for all robots, solves them. */
#ifndef GROEBOT_SIX_AXES_H
#define GROEBOT_SIX_AXES_H

#ifndef GROEBOT_H
#include "groebot.h"
#endif

/* The most answers that are written. */
#define GB_SIX_ROOM 64
/* Each joint can be hidden, and each of the two behind it doubled. */
#define GB_SIX_FORMULATIONS 12

/* A rigid motion: the rotation matrix, by rows, and the image of the origin. */
typedef struct {
    gb_real rotation[3][3];
    gb_real translation[3];
} gb_rigid;

/* Which angle is hidden in the pencil, and which is doubled. */
typedef struct {
    /* The joint, from 0, whose angle or way is the eigenvalue. */
    size_t hidden;
    /* Whether the equations are multiplied by half the angle, or by the way, of the second joint behind it, and not of the first. */
    bool second;
} gb_formulation;

/* Six joints, by the lines that they turn about or slide along. */
typedef struct {
    /* Directions of the axes at zero, of length one. */
    gb_real directions[6][3];
    /* Points on the axes at zero; as all lengths but those of `back`, shares of `length`. */
    gb_real points[6][3];
    /* Two directions of length one across each axis and each other. */
    gb_real across[6][2][3];
    /* Whether joints slide along their axes. */
    bool slides[6];
    /* At zero each joint's frame, whose z axis is the joint's, in that of the joint before; the first one in the base. */
    gb_rigid steps[6];
    /* At zero the last joint's frame in the base. */
    gb_rigid last;
    /* The base seen from the tip at zero, in the unit of the target. */
    gb_rigid back;
    /* A length typical of the chain, in the unit of the target. */
    gb_real length;
    /* The eigenvalue problems, in the order in which they are tried, and how many there are: one at least. */
    gb_formulation formulations[GB_SIX_FORMULATIONS];
    size_t formulation_count;
    /* How far the robot for which answers are wanted may be from this one (shares of `length`, and rad); zero where it is this one. Two complex solutions that
     * are as near to each other are lost answers: of that robot they may be real. */
    gb_real within;
} gb_chain;

/* Joint values that reach the target, or some to start from once more, near an answer that was lost. */
typedef struct {
    /* The joint angles, in (-pi, pi] (rad); ways in the unit of the target. */
    gb_real q[6];
    /* By joint: whether others make up for it, to first order. They may be free here: one member of a self-motion. */
    bool free[6];
    /* Whether it is only near an answer. */
    bool lost;
} gb_six_answer;

/* gb_six_axes(chain, target, out) writes all joint values that reach a target, a position and a rotation matrix by rows, to the front of out, which has room
 * for GB_SIX_ROOM: the answers by ascending joints, then what was lost; their number. */

#endif

/* Arms with one joint more than their task determines: seven joints and a pose, four and a position, six and a ray, five and a position with yaw. Compile
 * groebot_redundant.c and groebot.c with the program.
 *
 * The solutions of a target are curves. Along a curve, joint values stay within limits until a joint reaches one of its limits. These end points are solutions
 * of problems in which one joint is given at a limit (solve_given of gb_redundant). Curves are traced from end point to end point, and each end point belongs
 * to one arc. Curves that touch no limit are searched at values of some joints.
 *
 * No function allocates, and none has a state. gb_arcs and gb_any_within need about 100 kB of stack besides that of solve_given. Equal targets have bitwise
 * equal results with every compiler, also equal to those of groebot-runtime's `redundant` (see groebot.h for the options of the compiler). Numbers are in
 * double precision only.
 *
 * Joint values are in rad, or in the unit of lengths. Lists of joint values have GB_MOST_ARM_JOINTS entries; those from the number of joints on are 0. Limits
 * are the least and the greatest value of each joint in turn, infinite where there is none; they hold within 1e-9. Vectors are in the base frame. */
#ifndef GROEBOT_REDUNDANT_H
#define GROEBOT_REDUNDANT_H

#ifndef GROEBOT_SIX_AXES_H
#include "groebot_six_axes.h"
#endif
#ifdef GB_FLOAT
#error "redundant arms need double precision"
#endif

/* Maximal number of joints, numbers of a target, and maximal numbers of solutions of a problem with one joint given and of sections. */
#define GB_MOST_ARM_JOINTS 7
#define GB_ARM_TARGET 12
#define GB_MOST_MEMBERS 64
#define GB_MOST_SECTIONS 8

/* The limits of a joint are not in order, or NaN. Other codes below 0 are in groebot.h. */
#define GB_NOT_LIMITS (-7)

/* Which numbers of the tip's pose a target specifies, in this order. The remaining numbers of the target are 0. Directions are unit vectors. */
typedef enum {
    /* The position (3 numbers), then the rotation matrix base_from_tip by rows (9 numbers). */
    GB_TASK_POSE,
    /* The position (3 numbers). */
    GB_TASK_POSITION,
    /* The rotation matrix base_from_tip by rows (9 numbers). */
    GB_TASK_ROTATION,
    /* The position (3 numbers), then the image of a direction of the tip (3 numbers). */
    GB_TASK_RAY,
    /* The image of a direction of the tip (3 numbers). */
    GB_TASK_DIRECTION,
    /* The position (3 numbers), then pitch and roll (rad) of R = Rz(yaw) Ry(pitch) Rx(roll). */
    GB_TASK_POSITION_PITCH_ROLL,
    /* The position (3 numbers), then the angle (rad) of a direction of the tip about an axis of the base. The tip rotates about this axis only, and the
     * direction is perpendicular to it. The angle is measured from x about z, from y about x, from z about y. */
    GB_TASK_POSITION_YAW,
    /* Two coordinates of the position. The whole arm moves parallel to their plane. */
    GB_TASK_PLANAR_POSITION,
    /* Two coordinates of the position, then the angle (rad) about the axis of the third one, right-handed, from the zero configuration. The whole arm moves
     * parallel to the plane. */
    GB_TASK_PLANAR_POSE
} gb_task_kind;

/* A task. It has one independent equation less than the arm has joints. */
typedef struct {
    gb_task_kind kind;
    /* Of a ray, a direction, and a position with yaw: the direction in the tip frame, a unit vector. */
    gb_real direction[3];
    /* Of a position with yaw: the coordinate of the axis, 0, 1, 2 for x, y, z. */
    size_t axis;
    /* Of planar tasks: the two coordinates, in increasing order. */
    size_t coordinates[2];
} gb_task;

/* Which solver exists for the problem with a certain joint given. */
typedef enum {
    /* There is none. Limits of this joint are found along the curves only, so that completeness depends on a grid. */
    GB_ARM_UNSOLVED,
    /* solve_given finds all solutions for any value of the joint. */
    GB_ARM_SOLVED,
    /* The joint is constant on every curve of solutions, which is proved. Its value is only compared with the limits. */
    GB_ARM_CONSTANT
} gb_arm_given;

/* The solutions of a target with a joint, which is GB_ARM_SOLVED, at a value (rad, or the unit of lengths). Where the derivatives of the tip's pose are
 * dependent, closed curves of solutions begin. On many arms a joint has the same value at all these places. Short closed curves around them then pass this
 * value, however short they are. */
typedef struct {
    size_t joint;
    gb_real value;
} gb_arm_section;

/* The data of an arm: axes at zero in the base frame, and limits. The numbers are those of the robot as described, not of its idealisation. */
typedef struct {
    /* The number of joints, at most GB_MOST_ARM_JOINTS. */
    size_t count;
    /* The directions of the axes at zero, unit vectors. */
    gb_real directions[GB_MOST_ARM_JOINTS][3];
    /* A point on each axis at zero; of no meaning for a prismatic joint. */
    gb_real points[GB_MOST_ARM_JOINTS][3];
    /* Whether a joint is prismatic. */
    bool slides[GB_MOST_ARM_JOINTS];
    /* The pose base_from_tip at zero. */
    gb_rigid tip;
    gb_task task;
    /* The characteristic length: an error of this length counts as much as one of 1 rad. */
    gb_real length;
    /* The described limits. */
    gb_real limits[2 * GB_MOST_ARM_JOINTS];
    /* By joint: which solver exists with this joint given. */
    gb_arm_given given[GB_MOST_ARM_JOINTS];
    /* The joint whose values are tried for first solutions. It is GB_ARM_SOLVED. Best is a joint with a fast solver that has solutions for most values. */
    size_t scanned;
    /* The joint whose values are a grid for curves that touch no limit. It is GB_ARM_SOLVED. Best is a joint that moves far along short closed curves. */
    size_t grid;
    /* Sections that short closed curves pass. */
    gb_arm_section sections[GB_MOST_SECTIONS];
    size_t section_count;
} gb_arm;

/* A solution of a problem with one joint given. */
typedef struct {
    /* Joint values: angles in (-pi, pi]; the given joint has the given value. */
    gb_real q[GB_MOST_ARM_JOINTS];
    /* Bit j is set where joint j is free: the problem itself has a self-motion, of which this is one member. */
    uint32_t free;
    /* False where the solver's work was bounded: other solutions may be missing. */
    bool settled;
} gb_arm_member;

/* A list of solutions with fixed room, and whether solutions were dropped because there was no room. */
typedef struct {
    gb_arm_member list[GB_MOST_MEMBERS];
    size_t count;
    bool is_short;
} gb_arm_members;

/* Adds a solution to the list, or drops it if there is no room. */
static inline void gb_add_arm_member(gb_arm_members *members, const gb_arm_member *member)
{
    if (members->count == GB_MOST_MEMBERS) {
        members->is_short = true;
    } else {
        members->list[members->count++] = *member;
    }
}

/* An arm with its solvers. */
typedef struct {
    const gb_arm *arm;
    /* Passed to solve_given. */
    void *context;
    /* Adds all solutions of the target with `joint` given at `value` to the list, which is empty, whatever the limits of the other joints. Returns 0, or for
     * a target that is not valid GB_NOT_FINITE, GB_NOT_ROTATION, GB_NOT_UNIT, or GB_OPEN_STRATUM and GB_UNSETTLED for a target that the solver could not
     * decide. Only called for joints that are GB_ARM_SOLVED. */
    int (*solve_given)(void *context, const gb_real *target, size_t joint, gb_real value, gb_arm_members *members);
} gb_redundant;

/* An end of an arc. */
typedef struct {
    gb_real q[GB_MOST_ARM_JOINTS];
    /* The joint that is at its limit; the first one if there are several. -1 for closed curves, and where a curve could not be followed. */
    int joint;
    /* Whether it is at its upper limit. */
    bool is_upper;
} gb_arc_end;

/* A maximal connected curve of solutions within limits. */
typedef struct {
    /* Where it begins. For a closed curve, some point on it. */
    gb_arc_end start;
    gb_arc_end end;
    /* The length in the space of joint values: rad, where lengths are relative to the arm's `length`. */
    gb_real length;
    /* Whether the curve is closed and reaches no limit. */
    bool is_closed;
    /* Whether something was not decided: the curve passes a point where it crosses another one, or it could not be followed to a known end point. */
    bool is_unsure;
    /* How it was traced, so that it can be traced again. */
    gb_real side;
    uint32_t tied;
    uint32_t level;
    bool is_frozen;
} gb_arc;

/* The result of gb_arcs. */
typedef struct {
    /* The number of arcs. It is greater than the buffer's length when there was no room for all. */
    size_t count;
    /* The number of solutions within limits with a joint at a limit, where an arc ends. */
    size_t ends;
    /* Whether arcs may be missing, or some arc is unsure. */
    bool is_unsure;
    /* The number of closed curves. */
    size_t closed;
    /* Whether closed curves that reach no limit were searched by a grid and sections only. A closed curve that is narrower than the grid may
     * then be missing. This holds for all targets at present, except where solutions are a surface. */
    bool is_grid_only;
    /* Whether the solutions are a surface. The only arc is then one solution within limits, if one was found. */
    bool is_surface;
    /* Whether there are solutions, within limits or not. */
    bool is_reachable;
    /* The joints that are beyond their limits in the solution that exceeds limits least, as bits. 0 where there are arcs. */
    uint32_t beyond;
} gb_arcs_outcome;

/* The least and the greatest value of each joint along an arc, continuous from its start, so that angles may be beyond limits. For one solution, all three are
 * its joint values. */
typedef struct {
    gb_real start[GB_MOST_ARM_JOINTS];
    gb_real low[GB_MOST_ARM_JOINTS];
    gb_real high[GB_MOST_ARM_JOINTS];
} gb_arm_span;

/* The result of gb_any_within. */
typedef struct {
    /* Whether there is a solution within limits, and its joint values. */
    bool is_found;
    gb_real q[GB_MOST_ARM_JOINTS];
    /* If there is none: whether any solution was found, whatever the limits: with a joint at a limit, or for a grid of values of the scanned joint. The joints
     * that are beyond their limits in the one that exceeds limits least, as bits. */
    bool is_reachable;
    uint32_t beyond;
    /* If there is none: whether a solution may have been missed. */
    bool is_unsure;
} gb_within;

/* What is to be large along arcs. */
typedef enum {
    /* The least distance of a joint to its limits (rad, where lengths are relative to the arm's `length`), or that distance divided by half of the joint's
     * range; not that of a joint with only one limit. Joints without limits, or with a range of at least one turn, do not count. */
    GB_CRITERION_MARGIN,
    /* The distance to a reference, negative: -sqrt(sum w (q - q0)^2). Angles whose range is at least one turn are compared up to whole turns. */
    GB_CRITERION_NEAREST,
    /* sqrt(det(J J^T)) of the task's Jacobian, where lengths are relative to the arm's `length` (T. Yoshikawa, Int. J. Robotics Research 4 (1985) 3-9). */
    GB_CRITERION_MANIPULABILITY,
    /* The difference of one joint from a value, as a negative magnitude. */
    GB_CRITERION_CHANGE
} gb_criterion_kind;

/* A criterion with the numbers of its kind; the others are not read. */
typedef struct {
    gb_criterion_kind kind;
    /* Of a margin: whether distances are divided by half of the range, so that 1 is in the middle. */
    bool is_relative;
    /* Of the distance to a reference: the reference and the weights w. */
    gb_real q0[GB_MOST_ARM_JOINTS];
    gb_real weights[GB_MOST_ARM_JOINTS];
    /* Of the change of a joint: the joint and the value. */
    size_t joint;
    gb_real value;
} gb_criterion;

/* The distance to joint values, all of which count alike, as a criterion. */
static inline gb_criterion gb_nearest_to_joints(const gb_real *q0)
{
    gb_criterion criterion = {GB_CRITERION_NEAREST, false, {0}, {0}, 0, 0};
    for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        criterion.q0[i] = q0[i];
        criterion.weights[i] = 1;
    }
    return criterion;
}

/* An optimum on an arc. */
typedef struct {
    gb_real q[GB_MOST_ARM_JOINTS];
    /* The value of the criterion. */
    gb_real value;
    /* The number of the arc, and the length from its start. */
    size_t arc;
    gb_real s;
} gb_optimum;

/* The functions. In one file with a robot's solver they are static, and then declared after groebot/shared.h only.
 *
 * All of them return GB_NOT_LIMITS for limits that are not in order. gb_any_within and gb_arcs also return the codes of solve_given. Results are then not
 * written. Arcs must belong to the target and the limits with which they are used.
 *
 * gb_any_within: one solution within limits: first from a few values of the scanned joint, then from the end points of arcs, then from the search for closed
 * curves. Returns 1 if there is one, else 0.
 * gb_arcs: writes all maximal arcs of solutions within limits to out, which has this room. Angles are moved into their limits by whole turns. A revolute joint
 * whose range is at least one turn ends no arc. The end points are all solutions with a joint at a limit, as far as the joints have solvers, at most 256.
 * Curves join them in pairs, numerically: where two curves lead to one end point, the arcs are unsure. Closed curves that reach no limit are found by a grid.
 * Returns 0.
 * gb_arc_at: writes the joint values at a length s from the start of an arc. s is limited to the arc. Returns 0.
 * gb_arc_sample: writes joint values at equal distances along an arc (within 1e-3 of them) to out, as many as count, from its start to its end. If count
 * is 1, the start. Returns 0.
 * gb_arc_sample_from: same, but joint values are continuous along the arc from `start`, which differs from the arc's start by whole turns.
 * gb_arc_span: writes the span of an arc, within 1e-6. Returns 0.
 * gb_span_turns: the number of arcs within limits that differ from the arc of a span by whole turns of its angles, itself included; for the span of one
 * solution, that of solutions. 0 if the arc passes the limits of a joint whose range is at least one turn. An angle that lacks a limit counts once; at most
 * 1,000,000.
 * gb_span_turn: writes the start of the arc with this index, which must be below their number. The last joint changes fastest.
 * gb_best: writes the best solution by a criterion over arcs. Curves are sampled at six points for each step, and each sample that is better than its
 * neighbours is refined. Two optima between neighbouring samples are found as one. Returns 1, or 0 if there are no arcs.
 * gb_optima: writes all local optima of a criterion over arcs to out, which has this room, the best ones first. If there are more, the worst ones are dropped.
 * Returns their number. */
#if defined(GB_SHARED) || !defined(GB_LINKAGE)
#ifdef GB_SHARED
#define GB_REDUNDANT GB_LINKAGE
#else
#define GB_REDUNDANT GB_API
#endif
GB_REDUNDANT int gb_any_within(const gb_redundant *robot, const gb_real *target, const gb_real *limits, gb_within *within);
GB_REDUNDANT int gb_arcs(const gb_redundant *robot, const gb_real *target, const gb_real *limits, gb_arc *out, size_t room, gb_arcs_outcome *outcome);
GB_REDUNDANT int gb_arc_at(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_real s, gb_real *q);
GB_REDUNDANT int gb_arc_sample(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_real (*out)[GB_MOST_ARM_JOINTS],
                               size_t count);
GB_REDUNDANT int gb_arc_sample_from(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, const gb_real *start,
                                    gb_real (*out)[GB_MOST_ARM_JOINTS], size_t count);
GB_REDUNDANT int gb_arc_span(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_arm_span *span);
GB_REDUNDANT size_t gb_span_turns(const gb_arm *arm, const gb_real *limits, const gb_arm_span *span);
GB_REDUNDANT void gb_span_turn(const gb_arm *arm, const gb_real *limits, const gb_arm_span *span, size_t index, gb_real *start);
GB_REDUNDANT int gb_best(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count, const gb_criterion *criterion,
                         gb_optimum *best);
GB_REDUNDANT int gb_optima(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,
                           const gb_criterion *criterion, gb_optimum *out, size_t room);
#endif

/* Declares the functions of a redundant arm's own file. A target has GB_ARM_TARGET entries: the numbers
 * of NAME_solve without the value of the given joint, then zeros. Limits have the form of NAME_limits, which are the described ones.
 *
 * NAME_arm, NAME_redundant: the data of the arm, also with its solvers.
 * NAME_solve_given: adds all solutions with a joint given to the list: see solve_given of gb_redundant.
 * NAME_any_within, NAME_arcs, NAME_arc_at, NAME_arc_sample, NAME_best, NAME_optima: same as gb_any_within and so on, for this arm.
 * NAME_nearest_on_arcs: same as NAME_best for the least distance to joint values q0. */
#define GB_DECLARE_REDUNDANT(name)                                                                                                 \
    GB_API const gb_arm name##_arm;                                                                                                \
    GB_API const gb_redundant name##_redundant;                                                                                    \
    GB_API int name##_solve_given(const gb_real *target, size_t joint, gb_real value, gb_arm_members *members);                    \
    GB_API int name##_any_within(const gb_real *target, const gb_real *limits, gb_within *within);                                 \
    GB_API int name##_arcs(const gb_real *target, const gb_real *limits, gb_arc *out, size_t room, gb_arcs_outcome *outcome);      \
    GB_API int name##_arc_at(const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_real s, gb_real *q);              \
    GB_API int name##_arc_sample(const gb_real *target, const gb_real *limits, const gb_arc *arc,                                  \
                                 gb_real (*out)[GB_MOST_ARM_JOINTS], size_t count);                                                \
    GB_API int name##_best(const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,                         \
                           const gb_criterion *criterion, gb_optimum *best);                                                       \
    GB_API int name##_optima(const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,                       \
                             const gb_criterion *criterion, gb_optimum *out, size_t room);                                         \
    GB_API int name##_nearest_on_arcs(const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,              \
                                      const gb_real *q0, gb_optimum *best)

/* Defines these functions for the arm `name`_arm and its solvers by joint, GB_MOST_ARM_JOINTS functions or NULL, in `name`_given. */
#define GB_DEFINE_REDUNDANT(name)                                                                                                  \
    int name##_solve_given(const gb_real *target, size_t joint, gb_real value, gb_arm_members *members)                            \
    {                                                                                                                              \
        const bool is_solved = joint < GB_MOST_ARM_JOINTS && name##_given[joint];                                                  \
        return is_solved ? name##_given[joint](target, value, members) : 0;                                                        \
    }                                                                                                                              \
    static int name##_solve_in(void *context, const gb_real *target, size_t joint, gb_real value, gb_arm_members *members)         \
    {                                                                                                                              \
        (void)context;                                                                                                             \
        return name##_solve_given(target, joint, value, members);                                                                  \
    }                                                                                                                              \
    const gb_redundant name##_redundant = {&name##_arm, NULL, name##_solve_in};                                                    \
    int name##_any_within(const gb_real *target, const gb_real *limits, gb_within *within)                                         \
    {                                                                                                                              \
        return gb_any_within(&name##_redundant, target, limits, within);                                                           \
    }                                                                                                                              \
    int name##_arcs(const gb_real *target, const gb_real *limits, gb_arc *out, size_t room, gb_arcs_outcome *outcome)              \
    {                                                                                                                              \
        return gb_arcs(&name##_redundant, target, limits, out, room, outcome);                                                     \
    }                                                                                                                              \
    int name##_arc_at(const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_real s, gb_real *q)                      \
    {                                                                                                                              \
        return gb_arc_at(&name##_arm, target, limits, arc, s, q);                                                                  \
    }                                                                                                                              \
    int name##_arc_sample(const gb_real *target, const gb_real *limits, const gb_arc *arc,                                         \
                          gb_real (*out)[GB_MOST_ARM_JOINTS], size_t count)                                                        \
    {                                                                                                                              \
        return gb_arc_sample(&name##_arm, target, limits, arc, out, count);                                                        \
    }                                                                                                                              \
    int name##_best(const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,                                \
                    const gb_criterion *criterion, gb_optimum *best)                                                               \
    {                                                                                                                              \
        return gb_best(&name##_arm, target, limits, arcs, count, criterion, best);                                                 \
    }                                                                                                                              \
    int name##_optima(const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,                              \
                      const gb_criterion *criterion, gb_optimum *out, size_t room)                                                 \
    {                                                                                                                              \
        return gb_optima(&name##_arm, target, limits, arcs, count, criterion, out, room);                                          \
    }                                                                                                                              \
    int name##_nearest_on_arcs(const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,                     \
                               const gb_real *q0, gb_optimum *best)                                                                \
    {                                                                                                                              \
        const gb_criterion criterion = gb_nearest_to_joints(q0);                                                                   \
        return gb_best(&name##_arm, target, limits, arcs, count, &criterion, best);                                                \
    }

#endif

/* Joint limits and turns: see limits.rs */

/* The least and the greatest number of turns that bring a joint within its limits. The first is greater when none does. */
static void gb_turns_within(const gb_joint *joint, gb_real value, const gb_real *limit, gb_real *first, gb_real *last)
{
    const gb_real low = limit[0] - GB_ACCEPTANCE_INPUT_LIMITS - value, high = limit[1] + GB_ACCEPTANCE_INPUT_LIMITS - value;
    const bool is_within = low <= R(0.0) && R(0.0) <= high;
    *first = joint->is_angle ? gb_ceiling(low / GB_TAU) : R(0.0);
    *last = joint->is_angle ? gb_floor(high / GB_TAU) : is_within ? R(0.0) : R(-1.0);
}

/* The number of turns between bounds that is nearest to a given one. A bound that is NaN is ignored. */
static gb_real gb_nearest_turn(gb_real turn, gb_real first, gb_real last)
{
    return gb_smaller(gb_larger(turn, first), last) + R(0.0);
}

/* The bounds made finite and limited to a maximal distance. */
static void gb_make_finite(gb_real *first, gb_real *last)
{
    if (!gb_is_finite(*first) || !gb_is_finite(*last)) {
        *first = *last = gb_nearest_turn(R(0.0), *first, *last);
    }
    *last = gb_smaller(*first + (gb_real)GB_MOST_TURNS, *last);
}

/* The period of a joint: a full turn for an angle, 0 for a length. */
static gb_real gb_turn_of(const gb_joint *joint)
{
    return joint->is_angle ? GB_TAU : R(0.0);
}

GB_LINKAGE size_t gb_count_turns(const gb_mechanism *m, const gb_real *q, const gb_real *limits)
{
    gb_real count = R(1.0), first, last;
    for (size_t i = 0; i < m->joints; i++) {
        gb_turns_within(&m->joint[i], q[i], limits + 2 * i, &first, &last);
        if (!(first <= last)) {
            return 0;
        }
        gb_make_finite(&first, &last);
        count = gb_smaller((gb_real)GB_MOST_TURNS, count * (last - first + R(1.0)));
    }
    return (size_t)count;
}

GB_LINKAGE void gb_turn(const gb_mechanism *m, const gb_real *q, const gb_real *limits, size_t index, gb_real *out)
{
    gb_real first, last;
    for (size_t i = m->joints; i-- > 0;) {
        gb_turns_within(&m->joint[i], q[i], limits + 2 * i, &first, &last);
        gb_make_finite(&first, &last);
        const size_t count = last > first ? (size_t)(last - first) + 1 : 1;
        out[i] = q[i] + gb_turn_of(&m->joint[i]) * (first + (gb_real)(index % count));
        index /= count;
    }
}

/* Moves joints within limits by as few turns as possible; false when that is impossible. */
static bool gb_turn_within(const gb_mechanism *m, const gb_real *q, const gb_real *limits, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        gb_real first, last;
        gb_turns_within(&m->joint[i], q[i], limits + 2 * i, &first, &last);
        if (!(first <= last)) {
            return false;
        }
        out[i] = q[i] + gb_turn_of(&m->joint[i]) * gb_nearest_turn(R(0.0), first, last);
    }
    return true;
}

/* Moves one joint in short steps along a self-motion from q until it is within limits; false when no such place is found. */
static bool gb_stride_within(const gb_problem *problem, const gb_real *q, uint32_t free, size_t joint, gb_real delta, const gb_real *limits, gb_end *place)
{
    const gb_mechanism *m = problem->mechanism;
    gb_end end;
    gb_copy(end.q, q, m->joints);
    for (int i = 0; i < GB_STRIDES; i++) {
        end.q[joint] = gb_moved(m, end.q, joint, delta);
        gb_polish_from(problem, &end, free);
        if (!end.fit.accepted) {
            return false;
        }
        if (gb_turn_within(m, end.q, limits, place->q)) {
            place->fit = end.fit;
            return true;
        }
    }
    return false;
}

/* Same with one free joint after the other, in both directions. */
static bool gb_strides_within(const gb_answers *all, size_t answer, const gb_real *limits, gb_end *place)
{
    const uint32_t free = *gb_free_of(all, answer);
    *all->problem.steps = gb_steps_at_most(GB_MOST_STEPS);
    for (size_t i = 0; i < 2 * all->problem.mechanism->joints; i++) {
        const gb_real delta = i % 2 == 0 ? GB_STRIDE : -GB_STRIDE;
        if (gb_is_in(free, i / 2) && gb_stride_within(&all->problem, gb_q_of(all, answer), free, i / 2, delta, limits, place)) {
            return true;
        }
    }
    return false;
}

/* Moves solutions within limits, and drops those for which that is impossible. Returns the number of the remaining ones. */
GB_LINKAGE size_t gb_keep_within(const gb_answers *all, const gb_real *limits)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_end place;
    size_t kept = 0;
    for (size_t k = 0; k < all->count; k++) {
        place.fit.residual = *gb_residual_of(all, k);
        if (gb_turn_within(m, gb_q_of(all, k), limits, place.q) || (!m->has_extras && gb_strides_within(all, k, limits, &place))) {
            memmove(gb_at(all, kept), gb_at(all, k), m->solution);
            gb_copy(gb_q_of(all, kept), place.q, m->joints);
            *gb_residual_of(all, kept) = place.fit.residual;
            kept++;
        }
    }
    return kept;
}

/* Reference joint values, the non-negative weights of their squared differences, and limits, for the choice of a solution. */
typedef struct {
    const gb_real *reference;
    const gb_real *weights;
    const gb_real *limits;
} gb_aim;

/* Joint values after the turns within limits that are nearest to a reference. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    /* The sum of the weighted squared differences from the reference. */
    gb_real distance;
    /* The sum of the distances from the limits of joints that no turn brings within them. */
    gb_real excess;
} gb_turned_joints;

/* A value that no turn brings within limits, at the turn nearest to their middle. */
static gb_real gb_beside(const gb_joint *joint, gb_real value, const gb_real *limit)
{
    return value + gb_turn_of(joint) * gb_round((R(0.5) * (limit[0] + limit[1]) - value) / GB_TAU);
}

/* The distance of a value from its limits; infinite where these are not numbers. */
static gb_real gb_excess(gb_real value, const gb_real *limit)
{
    return value < limit[0] ? limit[0] - value : value > limit[1] ? value - limit[1] : INFINITY;
}

/* The nearest turn of joint values. */
static void gb_turn_to(const gb_mechanism *m, const gb_aim *aim, const gb_real *q, gb_turned_joints *turned)
{
    turned->distance = turned->excess = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        const gb_real wanted = aim->reference[i], *limit = aim->limits + 2 * i;
        gb_real first, last, moved;
        gb_turns_within(&m->joint[i], q[i], limit, &first, &last);
        if (first <= last) {
            const gb_real turn = m->joint[i].is_angle ? gb_round((wanted - q[i]) / GB_TAU) : R(0.0);
            moved = q[i] + gb_turn_of(&m->joint[i]) * gb_nearest_turn(turn, first, last);
        } else {
            moved = gb_beside(&m->joint[i], q[i], limit);
            turned->excess += gb_excess(moved, limit);
        }
        turned->q[i] = moved;
        turned->distance += aim->weights[i] * (moved - wanted) * (moved - wanted);
    }
}

/* Whether joint values are nearer to the limits than others, or equally near and nearer to the reference. */
static bool gb_is_better(const gb_turned_joints *a, const gb_turned_joints *b)
{
    return a->excess < b->excess || (a->excess == b->excess && a->distance < b->distance);
}

/* Moves joints that no turn brings within their limits to the nearer limit. Returns these joints as a set. */
static uint32_t gb_stop_at_limits(const gb_mechanism *m, const gb_aim *aim, gb_real *q)
{
    uint32_t stopped = 0;
    for (size_t i = 0; i < m->joints; i++) {
        const gb_real *limit = aim->limits + 2 * i;
        gb_real first, last;
        gb_turns_within(&m->joint[i], q[i], limit, &first, &last);
        if (!(first <= last)) {
            q[i] = gb_wrapped(m, i, gb_beside(&m->joint[i], q[i], limit) < limit[0] ? limit[0] : limit[1]);
            stopped |= (uint32_t)1 << i;
        }
    }
    return stopped;
}

/* The index of the solution that is nearest to a reference after turns within limits, and that turn. -1 when no solution is within limits. */
GB_LINKAGE int gb_nearest(const gb_answers *all, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_real *q)
{
    const gb_mechanism *m = all->problem.mechanism;
    const gb_aim aim = {reference, weights, limits};
    gb_real least = INFINITY;
    int best = -1;
    for (size_t k = 0; k < all->count; k++) {
        gb_turned_joints turned;
        gb_turn_to(m, &aim, gb_q_of(all, k), &turned);
        if (turned.excess == R(0.0) && turned.distance < least) {
            least = turned.distance;
            best = (int)k;
            gb_copy(q, turned.q, m->joints);
        }
    }
    return best;
}

/* The target for which the tool is at `pose`, where `base` is the pose of the base, and `tool` that of the tool in the frame of the tip: base^-1 pose
 * tool^-1. */
GB_LINKAGE void gb_target_of(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target)
{
    for (int i = 0; i < 12; i++) {
        target[i] = R(0.0);
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 9; k++) {
                target[3 + 3 * i + j] += base[3 + 3 * (k / 3) + i] * pose[3 + k] * tool[3 + 3 * j + k % 3];
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            target[i] += base[3 + 3 * k + i] * (pose[k] - base[k]) - target[3 + 3 * i + k] * tool[k];
        }
    }
}

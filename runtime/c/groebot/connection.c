/* Tests whether two members are on one self-motion: a continuous motion connects them, during which the equations hold: see connection.rs */

/* Whether the equations hold on the straight line along `delta`, as for coincident axes. */
static bool gb_is_straight(const gb_problem *problem, const gb_real *a, const gb_real *delta)
{
    static const gb_real shares[] = {R(0.5), R(0.25), R(0.75)};
    for (size_t k = 0; k < GB_LENGTH_OF(shares); k++) {
        gb_real at[GB_MAX_JOINTS];
        for (size_t i = 0; i < problem->mechanism->joints; i++) {
            at[i] = a[i] + shares[k] * delta[i];
        }
        if (!(gb_measure(problem, at).relative <= GB_ACCEPTANCE_ROUNDING)) {
            return false;
        }
    }
    return true;
}

/* Whether joint values next to a member of a self-motion are on that self-motion: the equations hold half-way too. */
static bool gb_is_there(const gb_problem *problem, gb_end *end, const gb_real *b, uint32_t free)
{
    gb_polish(problem, end, free);
    const bool is_close = end->fit.accepted && gb_is_close(problem->mechanism, end->q, b, 0, GB_MERGING_APART_MEMBERS);
    return is_close && gb_are_joined(problem, end->q, b, GB_ACCEPTANCE_ROUNDING, free);
}

/* The largest displacement of a free joint on `delta`. */
static gb_real gb_length_of(const gb_mechanism *m, const gb_real *delta, uint32_t free)
{
    gb_real freed[GB_MAX_JOINTS];
    for (size_t i = 0; i < m->joints; i++) {
        freed[i] = gb_is_in(free, i) ? delta[i] : R(0.0);
    }
    return gb_longest(m, freed);
}

/* Whether the other joints follow, from end->q, after the free joints were moved: by a few steps. */
static bool gb_correct(const gb_problem *problem, gb_end *end, uint32_t free)
{
    const gb_mechanism *m = problem->mechanism;
    end->fit = gb_measure(problem, end->q);
    for (int k = 0; k < GB_RETURNS && !(end->fit.relative <= GB_SELF_MOTIONS_CURVE || gb_are_spent(problem)); k++) {
        gb_real step[GB_MAX_JOINTS], next[GB_MAX_JOINTS];
        if (!gb_newton_step(problem, end->q, gb_dampings[1], free, step)) {
            return false;
        }
        gb_stepped(m, end->q, step, next);
        gb_copy(end->q, next, m->joints);
        end->fit = gb_measure(problem, end->q);
    }
    return end->fit.relative <= GB_SELF_MOTIONS_CURVE;
}

/* Same as gb_correct, and the result must be near. */
static bool gb_followed(const gb_problem *problem, gb_end *end, uint32_t free)
{
    gb_real ahead[GB_MAX_JOINTS];
    gb_copy(ahead, end->q, problem->mechanism->joints);
    return gb_correct(problem, end, free) && gb_farthest(problem->mechanism, end->q, ahead) <= GB_LEAPT;
}

/* A member of a self-motion, with its tangent if that is known, else null. */
typedef struct {
    const gb_real *q;
    const gb_real *tangent;
} gb_member;

/* A knot of the cubic curves on a self-motion: joint values, tangent, and displacement of the free joint. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_real tangent[GB_MAX_JOINTS];
    gb_real gone;
} gb_knot;

/* The knot of a member; false if the self-motion is not a curve there. */
static bool gb_make_knot(const gb_problem *problem, gb_member member, uint32_t free, gb_knot *knot)
{
    const size_t joints = problem->mechanism->joints;
    gb_copy(knot->q, member.q, joints);
    if (!member.tangent) {
        return gb_find_tangent(problem, member.q, free, knot->tangent);
    }
    gb_copy(knot->tangent, member.tangent, joints);
    return true;
}

/* The midpoint of the cubic curve between two knots. */
static void gb_half_way(const gb_mechanism *m, const gb_knot *near, const gb_knot *far, gb_real *out)
{
    const gb_real bend = R(0.125) * (far->gone - near->gone);
    for (size_t i = 0; i < m->joints; i++) {
        const gb_real turned = bend * (near->tangent[i] - far->tangent[i]);
        out[i] = gb_wrapped(m, i, near->q[i] + R(0.5) * gb_shortest(m, i, far->q[i] - near->q[i]) + turned);
    }
}

/* Logarithm to base two of the maximal number of cubic curves between two members, plus one. */
#define GB_DIVISIONS 5

/* Whether cubic Hermite curves approximate the self-motion between two of its places. Half-way along each curve, the correction of the other joints must be
 * at most GB_MERGING_APART_MEMBERS. Otherwise the curve is divided there, until it is too short. (The curves have the self-motion's tangents at their ends.
 * Their error is of fourth order in their length.) */
static bool gb_is_interpolated(const gb_problem *problem, const gb_knot *first, const gb_knot *last, uint32_t free)
{
    const gb_mechanism *m = problem->mechanism;
    const size_t joint = gb_single(m, free);
    gb_knot at = *first, ends[GB_DIVISIONS];
    size_t count = 1;
    ends[0] = *last;
    while (count > 0) {
        const gb_real gone = R(0.5) * (at.gone + ends[count - 1].gone);
        gb_real middle[GB_MAX_JOINTS];
        gb_end end;
        gb_half_way(m, &at, &ends[count - 1], middle);
        middle[joint] = gb_wrapped(m, joint, first->q[joint] + gone);
        gb_copy(end.q, middle, m->joints);
        if (!gb_correct(problem, &end, free)) {
            return false;
        }
        if (gb_farthest(m, end.q, middle) <= GB_MERGING_APART_MEMBERS) {
            at = ends[--count];
        } else if (count < GB_DIVISIONS) {
            gb_knot *knot = &ends[count++];
            const gb_member member = {end.q, NULL};
            knot->gone = gone;
            if (!gb_make_knot(problem, member, free, knot)) {
                return false;
            }
        } else {
            return false;
        }
    }
    return true;
}

/* Whether cubic curves connect two members of a self-motion along one of two displacements of a free joint, the second of which may be null. Not tried where
 * the displacement is shorter than the first step of following it. */
static bool gb_are_joined_by_cubics(const gb_problem *problem, gb_member a, gb_member b, uint32_t free, const gb_real *delta, const gb_real *other)
{
    const size_t joint = gb_single(problem->mechanism, free);
    gb_knot first, last;
    if (!(gb_is_single(free) && gb_magnitude(delta[joint]) > gb_along[1])
        || !gb_make_knot(problem, a, free, &first) || !gb_make_knot(problem, b, free, &last)) {
        return false;
    }
    first.gone = R(0.0);
    last.gone = delta[joint];
    if (gb_is_interpolated(problem, &first, &last, free)) {
        return true;
    }
    last.gone = other ? other[joint] : R(0.0);
    return other && gb_is_interpolated(problem, &first, &last, free);
}

/* Moves the free joints by `delta` from a while the others follow, with step size control. Returns whether they follow; `*arrives` is whether they arrive at
 * b. */
static bool gb_leads_along(const gb_problem *problem, const gb_real *a, const gb_real *b, uint32_t free, const gb_real *delta, bool *arrives)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real length = gb_length_of(m, delta, free);
    gb_real before[GB_MAX_JOINTS], at[GB_MAX_JOINTS], gone = R(0.0), last = R(1.0), pace = gb_along[1];
    gb_copy(before, a, m->joints);
    gb_copy(at, a, m->joints);
    for (int k = 0; k < GB_PACES && !gb_are_spent(problem); k++) {
        const bool is_last = pace >= length - gone;
        const gb_real step = is_last ? length - gone : pace, share = is_last ? R(1.0) : (gone + pace) / length;
        gb_end next;
        gb_beyond(m, before, at, step / last, next.q);
        for (size_t i = 0; i < m->joints; i++) {
            next.q[i] = gb_is_in(free, i) ? gb_wrapped(m, i, a[i] + share * delta[i]) : next.q[i];
        }
        if (gb_followed(problem, &next, free)) {
            if (is_last) {
                *arrives = gb_is_there(problem, &next, b, free);
                return true;
            }
            gb_copy(before, at, m->joints);
            gb_copy(at, next.q, m->joints);
            gone += step;
            last = step;
            pace = gb_smaller(R(2.0) * pace, gb_along[2]);
        } else if (pace > gb_along[0]) {
            pace *= R(0.25);
        } else {
            return false;
        }
    }
    return false;
}

/* The displacement in which the free joint rotates in the opposite direction; false if it is not revolute. */
static bool gb_opposite(const gb_mechanism *m, const gb_real *delta, uint32_t free, gb_real *other)
{
    bool turns = false;
    for (size_t i = 0; i < m->joints; i++) {
        const bool is_turned = free == (uint32_t)1 << i && m->joint[i].is_angle;
        other[i] = is_turned ? delta[i] - (delta[i] < R(0.0) ? -GB_TAU : GB_TAU) : delta[i];
        turns |= is_turned;
    }
    return turns;
}

/* Whether the equations hold on a straight line between two members of self-motions, on which one joint may rotate in the longer direction. */
static bool gb_leads_straight_to(const gb_problem *problem, const gb_real *a, const gb_real *b, uint32_t free)
{
    gb_real delta[GB_MAX_JOINTS] = {R(0.0)}, other[GB_MAX_JOINTS] = {R(0.0)};
    gb_differences(problem->mechanism, b, a, delta);
    return gb_is_straight(problem, a, delta) || (gb_opposite(problem->mechanism, delta, free, other) && gb_is_straight(problem, a, other));
}

/* Whether the joints arrive at the second member as the free ones move and the others follow. */
static bool gb_leads_round_to(const gb_problem *problem, gb_member a, gb_member b, uint32_t free)
{
    gb_real delta[GB_MAX_JOINTS] = {R(0.0)}, other[GB_MAX_JOINTS] = {R(0.0)};
    bool arrives = false;
    gb_differences(problem->mechanism, b.q, a.q, delta);
    const bool turns = gb_opposite(problem->mechanism, delta, free, other);
    if (gb_are_joined_by_cubics(problem, a, b, free, delta, turns ? other : NULL)) {
        return true;
    }
    if (!gb_leads_along(problem, a.q, b.q, free, delta, &arrives) && turns) {
        return gb_leads_along(problem, a.q, b.q, free, other, &arrives) && arrives;
    }
    return arrives;
}

/* Whether a continuous motion of the joints, during which the equations hold, connects two members of self-motions with equal free joints. It is a straight
 * line, or the free joints move straight and the others follow. If the shorter direction of rotation fails, a joint takes the longer one. */
static bool gb_leads_to(const gb_problem *problem, const gb_real *a, const gb_real *b, uint32_t free)
{
    const gb_member from = {a, NULL}, to = {b, NULL};
    return gb_leads_straight_to(problem, a, b, free) || gb_leads_round_to(problem, from, to, free);
}

/* Members of self-motions: see self_motion.rs */

/* Whether steps return to `q` on the line from `far` through `near`. */
static bool gb_leads_back(const gb_problem *problem, const gb_real *q, uint32_t free, const gb_real *near, const gb_real *far, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    gb_end back;
    gb_beyond(m, far, near, R(1.0), back.q);
    for (size_t i = 0; i < m->joints; i++) {
        back.q[i] = gb_is_in(free, i) ? q[i] : back.q[i];
    }
    gb_polish_from(problem, &back, free);
    return back.fit.accepted && gb_are_joined(problem, back.q, q, bound, free);
}

/* Whether the equations hold within `bound` where free joints are moved in one direction. The displacement is doubled until it has its full length. From a
 * short one the joints must return to q: steps may lead from an isolated solution to a self-motion next to it, but not back. */
static bool gb_leads_aside(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real delta, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real before[GB_MAX_JOINTS], at[GB_MAX_JOINTS], share = R(1.0) / GB_FIRST_STAGE;
    gb_copy(before, q, m->joints);
    gb_copy(at, q, m->joints);
    for (int stage = 0; stage < GB_DOUBLINGS; stage++) {
        gb_end next;
        gb_beyond(m, before, at, stage == 1 ? R(1.0) : R(2.0), next.q);
        for (size_t i = 0; i < m->joints; i++) {
            next.q[i] = gb_is_in(free, i) ? gb_moved(m, q, i, share * delta) : next.q[i];
        }
        next.fit = gb_measure(problem, next.q);
        if (!(next.fit.relative <= bound)) {
            gb_polish(problem, &next, free);
        }
        if (next.fit.relative > bound || (stage == 1 && !gb_leads_back(problem, q, free, at, next.q, bound))) {
            return false;
        }
        gb_copy(before, at, m->joints);
        gb_copy(at, next.q, m->joints);
        share *= R(2.0);
    }
    return true;
}

/* Whether the others follow when the joints `free` are moved by the first stage of a displacement. */
static bool gb_sets_out(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real delta, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    gb_end next;
    for (size_t i = 0; i < m->joints; i++) {
        next.q[i] = gb_is_in(free, i) ? gb_moved(m, q, i, delta / GB_FIRST_STAGE) : q[i];
    }
    gb_polish_from(problem, &next, free);
    return next.fit.relative <= bound;
}

/* One of the trial displacements, each an eighth of the one before. */
static gb_real gb_narrowed(int narrow)
{
    gb_real delta = GB_ASIDE;
    for (int i = 0; i < narrow; i++) {
        delta = delta / R(8.0);
    }
    return delta;
}

/* Whether the joints can move from q along a self-motion, given the regularity at q. */
static bool gb_leads_to_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound, gb_real regularity)
{
    bound = gb_larger(GB_ACCEPTANCE_ROUNDING, bound);
    if (regularity > GB_PIVOTS_REGULAR || gb_are_spent(problem)) {
        return false;
    }
    const int narrows = bound > GB_ACCEPTANCE_ROUNDING || regularity > GB_PIVOTS_SINGULAR ? 1 : GB_NARROWS;
    /* If the last displacement but one fails, longer ones fail too. */
    const gb_real first = gb_narrowed(GB_NARROWS - 2);
    if (narrows > 1 && !gb_sets_out(problem, q, free, first, bound) && !gb_sets_out(problem, q, free, -first, bound)) {
        return false;
    }
    for (int narrow = 0; narrow < narrows; narrow++) {
        const gb_real delta = gb_narrowed(narrow);
        if (gb_leads_aside(problem, q, free, delta, bound) || gb_leads_aside(problem, q, free, -delta, bound)) {
            return true;
        }
    }
    return false;
}

/* Whether the equations also hold, within `bound` or rounding, when the joints `free` are moved and the others follow. One direction suffices, because in
 * the other one the self-motion may branch. Where `q` is not singular this is false without a trial. A self-motion may cover only a small part of the
 * circle. Where `q` is singular within rounding, shorter displacements are therefore tried, each an eighth of the one before. */
GB_LINKAGE bool gb_is_on_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound)
{
    return gb_leads_to_self_motion(problem, q, free, bound, gb_regularity(problem, q));
}

static bool gb_leads_far_aside(const gb_problem *problem, const gb_real *q, uint32_t free)
{
    return !gb_are_spent(problem)
        && (gb_leads_aside(problem, q, free, GB_ASIDE, GB_ACCEPTANCE_ROUNDING) || gb_leads_aside(problem, q, free, -GB_ASIDE, GB_ACCEPTANCE_ROUNDING));
}

/* Same as gb_is_on_self_motion within rounding, without self-motions that cover only a small part of the circle. */
static bool gb_is_on_long_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free)
{
    return gb_regularity(problem, q) <= GB_PIVOTS_REGULAR && gb_leads_far_aside(problem, q, free);
}

/* Whether a joint may be free: some case frees it, or the formulas are those of a nearby mechanism and free none. */
static bool gb_may_be_free(const gb_mechanism *m, size_t joint)
{
    for (size_t i = 0; i < m->freed_count; i++) {
        if (m->freed[i] == joint) {
            return true;
        }
    }
    return m->freed_count == 0 && m->is_nearby;
}

/* A joint that alone parametrises a self-motion, as a set that may be empty. Of the joints that some case frees, it is the one found first. If the formulas
 * are those of a nearby mechanism and free none, it may be any joint. */
static uint32_t gb_joint_on_self_motion(const gb_problem *problem, const gb_real *q, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    if (m->freed_count == 0 && !m->is_nearby) {
        return 0;
    }
    const gb_real regularity = gb_regularity(problem, q);
    for (size_t i = m->joints; i-- > 0;) {
        const uint32_t free = (uint32_t)1 << m->last_first[i];
        if (gb_may_be_free(m, m->last_first[i]) && gb_leads_to_self_motion(problem, q, free, bound, regularity)) {
            return free;
        }
    }
    return 0;
}

/* Same as gb_joint_on_self_motion, for long self-motions within rounding and singular joint values. */
static uint32_t gb_joint_on_long_self_motion(const gb_problem *problem, const gb_real *q)
{
    const gb_mechanism *m = problem->mechanism;
    for (size_t i = m->joints; i-- > 0;) {
        const uint32_t free = (uint32_t)1 << m->last_first[i];
        if (gb_may_be_free(m, m->last_first[i]) && gb_leads_far_aside(problem, q, free)) {
            return free;
        }
    }
    return 0;
}

/* Whether joint values next to `q` reach the target and are on a self-motion of one of the joints `free`. */
GB_LINKAGE bool gb_has_member(const gb_problem *problem, const gb_real *q, uint32_t free)
{
    const size_t joints = problem->mechanism->joints;
    gb_end end;
    gb_copy(end.q, q, joints);
    gb_polish_from(problem, &end, 0);
    for (size_t i = 0; end.fit.accepted && i < joints; i++) {
        if (gb_is_in(free, i) && gb_is_on_self_motion(problem, end.q, (uint32_t)1 << i, GB_ACCEPTANCE_ROUNDING)) {
            return true;
        }
    }
    return false;
}

/* Whether exactly one joint is free. */
static bool gb_is_single(uint32_t free)
{
    return free != 0 && (free & (free - 1)) == 0;
}

/* The only free joint. */
static size_t gb_single(const gb_mechanism *m, uint32_t free)
{
    size_t joint = 0;
    while (joint + 1 < m->joints && !gb_is_in(free, joint)) {
        joint++;
    }
    return joint;
}

/* The tangent of the self-motion at q: the derivatives of all joints by one free joint. False unless the self-motion is a curve there that this joint
 * parametrises. */
static bool gb_find_tangent(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real *tangent)
{
    const gb_mechanism *m = problem->mechanism;
    gb_triangle triangle;
    gb_slopes slopes;
    gb_real at[GB_MAX_PLACES];
    if (!gb_is_single(free)) {
        return false;
    }
    const size_t joint = gb_single(m, free);
    gb_place(problem, q, at);
    m->jacobian(problem->p, at, slopes.rows);
    for (size_t i = 0; i < m->equations; i++) {
        slopes.values[i] = slopes.rows[i * m->joints + joint];
    }
    gb_triangle_of(problem, &slopes, R(0.0), free, &triangle);
    if (!(gb_regularity_in(&triangle) > GB_PIVOTS_REGULAR && gb_substitute(&triangle, tangent))) {
        return false;
    }
    for (size_t i = 0; i < m->joints; i++) {
        tangent[i] = i == joint ? R(1.0) : -tangent[i];
    }
    return true;
}

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

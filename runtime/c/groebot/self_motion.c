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

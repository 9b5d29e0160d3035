/* Members of self-motions: self_motion.rs */

/* Whether the joints come back to q on along the line from `far` through `near`. */
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

/* Whether the equations hold within `bound` where free joints are moved one way, which is doubled until it is that long, and from where it is short the
 * joints must come back: an isolated answer may be led to a self-motion next to it, but not back. */
static bool gb_leads_aside(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real way, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real before[GB_MAX_JOINTS], at[GB_MAX_JOINTS], share = R(1.0);
    gb_copy(before, q, m->joints);
    gb_copy(at, q, m->joints);
    for (int i = 1; i < GB_DOUBLINGS; i++) {
        share *= R(0.5);
    }
    for (int stage = 0; stage < GB_DOUBLINGS; stage++) {
        gb_end next;
        gb_beyond(m, before, at, stage == 1 ? R(1.0) : R(2.0), next.q);
        for (size_t i = 0; i < m->joints; i++) {
            next.q[i] = gb_is_in(free, i) ? gb_moved(m, q, i, share * way) : next.q[i];
        }
        gb_polish_from(problem, &next, free);
        if (next.fit.relative > bound || (stage == 1 && !gb_leads_back(problem, q, free, at, next.q, bound))) {
            return false;
        }
        gb_copy(before, at, m->joints);
        gb_copy(at, next.q, m->joints);
        share *= R(2.0);
    }
    return true;
}

/* Whether q leads aside, with what its regularity is. */
static bool gb_leads_to_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound, gb_real regularity)
{
    gb_real way = GB_ASIDE;
    bound = gb_larger(GB_ROUNDING, bound);
    if (regularity > GB_REGULAR) {
        return false;
    }
    for (int narrow = 0; narrow < GB_NARROWS; narrow++) {
        if (narrow == 1 && (bound > GB_ROUNDING || regularity > GB_SINGULAR)) {
            return false;
        }
        if (gb_leads_aside(problem, q, free, way, bound) || gb_leads_aside(problem, q, free, -way, bound)) {
            return true;
        }
        way /= R(8.0);
    }
    return false;
}

/* Whether the equations hold too, within `bound` or rounding, where the joints `free` are elsewhere and the others follow, to one side at least: to the
 * other there may be a branching. Where q is not singular that is not tried. A self-motion may go round a small part of the circle only: where q is
 * singular within rounding, shorter ways are tried as well, each an eighth of the one before. */
static bool gb_lies_on_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound)
{
    return gb_leads_to_self_motion(problem, q, free, bound, gb_regularity(problem, q));
}

/* The same within rounding, but for self-motions that go round a small part of the circle only. */
static bool gb_lies_on_long_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free)
{
    return gb_regularity(problem, q) <= GB_REGULAR
        && (gb_leads_aside(problem, q, free, GB_ASIDE, GB_ROUNDING) || gb_leads_aside(problem, q, free, -GB_ASIDE, GB_ROUNDING));
}

/* A joint that lies alone on a self-motion, the first of those that some case frees; as a set, empty without one. */
static uint32_t gb_joint_on_self_motion(const gb_problem *problem, const gb_real *q, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real regularity = m->freed_count > 0 ? gb_regularity(problem, q) : INFINITY;
    for (size_t i = 0; i < m->freed_count; i++) {
        const uint32_t free = (uint32_t)1 << m->freed[i];
        if (gb_leads_to_self_motion(problem, q, free, bound, regularity)) {
            return free;
        }
    }
    return 0;
}

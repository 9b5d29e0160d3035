/* Refinement of candidates that are not solutions yet: see refine.rs */

/* Polishes again from points on either side of a candidate. Their distance is the square root of the residual, for a double root or an angle with little
 * influence. If none of these leads to a solution, starts are farther away. */
static void gb_around(gb_answers *all, const gb_found_1 *found, const gb_end *end, gb_real missed)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_real weights[GB_MAX_JOINTS];
    bool is_found = end->fit.accepted;
    gb_weights(&all->problem, end->q, weights);
    for (gb_real farther = R(1.0); farther <= GB_FARTHEST && !gb_are_spent(&all->problem); farther *= GB_FARTHER) {
        for (size_t i = 0; i < 2 * m->joints; i++) {
            const gb_real sign = i % 2 == 0 ? R(-1.0) : R(1.0), weight = end->fit.accepted ? R(1.0) : weights[i / 2];
            const gb_real delta = gb_smaller(GB_APART_BY, farther * gb_square_root(missed / weight));
            gb_end start = *end;
            start.q[i / 2] = gb_moved(m, end->q, i / 2, R(2.0) * sign * delta);
            gb_polish_from(&all->problem, &start, 0);
            is_found |= start.fit.accepted;
            gb_keep(all, found, start.q, &start.fit);
        }
        if (is_found) {
            return;
        }
    }
}

/* Searches for a second solution next to one whose candidate was a double root. Their distance is about the square root of the candidate's residual. The
 * second one is in the direction in which the equations change least: a parabola through the first one has its second root there. */
static void gb_twin(gb_answers *all, const gb_found_1 *found, const gb_real *end, gb_triangle *triangle, gb_real missed)
{
    const gb_problem *problem = &all->problem;
    const gb_real nearby = gb_square_root(missed);
    gb_real delta[GB_MAX_JOINTS], at[GB_MAX_PLACES], share, distance;
    gb_approach approach;
    gb_end start;
    if (!gb_stillest(problem, triangle, delta, &share) || share > GB_TWIN * nearby ||
        !gb_second_root(problem, end, delta, GB_TWIN_AT * nearby, &distance) || gb_magnitude(distance) > GB_TWIN_WITHIN * nearby) {
        return;
    }
    gb_shifted(problem->mechanism, end, delta, distance, start.q);
    gb_place(problem, start.q, at);
    if (problem->mechanism->approach(problem, at, start.q, &approach)) {
        gb_keep(all, found, approach.end, &approach.fit);
    } else {
        gb_polish_from(problem, &start, 0);
        gb_keep(all, found, start.q, &start.fit);
    }
}

/* Keeps a solution that is a member of a self-motion of one joint that a case frees. The formulas of a nearby mechanism do not distinguish these from
 * isolated solutions. Returns whether it is one. */
static bool gb_keep_moving(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_fit *fit, gb_real regularity)
{
    gb_found_1 moving = *found;
    moving.free = fit->relative <= GB_ACCEPTANCE_ROUNDING && regularity <= GB_PIVOTS_REGULAR ? gb_joint_on_long_self_motion(&all->problem, q) : 0;
    if (moving.free != 0) {
        gb_keep(all, &moving, q, fit);
    }
    return moving.free != 0;
}

/* Stores a solution of a nearby mechanism for continuation if a curve goes through it. If the solution is regular, there may be others on the curve only next to
 * a crossing. The equations then change, along the curve, by less than the square root of the candidate's residual. */
static bool gb_begin_curve_through(gb_answers *all, const gb_found_1 *found, const gb_real *q, gb_real regularity, gb_real missed)
{
    if (regularity <= GB_PIVOTS_REGULAR) {
        return gb_begin_curve(all, found, q);
    }
    return regularity <= gb_square_root(missed) && gb_begin_crossing_curve(all, found, q);
}

/* Whether a curve goes through a solution of a nearby mechanism, or through the end of the steps from one. Such a curve is followed. */
static bool gb_is_curve(gb_answers *all, const gb_found_1 *found, const gb_end *end, gb_real regularity, gb_real missed)
{
    if (gb_is_between(end->fit.relative, GB_ACCEPTANCE_ROUNDING, GB_STRATA_NEAR)) {
        return gb_begin_curve(all, found, end->q);
    }
    return end->fit.accepted && gb_begin_curve_through(all, found, end->q, regularity, missed);
}

/* Keeps the end of the Newton steps from the candidate with this number. If the equations are ill-conditioned, searches for a second solution. */
GB_LINKAGE void gb_arrive(gb_answers *all, size_t number, const gb_found_1 *found, const gb_approach *approach)
{
    gb_triangle triangle;
    const bool is_steep = approach->pivot < approach->missed * (found->close ? GB_STEEP : GB_MILD);
    all->unsound = is_steep ? number : all->unsound;
    if (!(is_steep && approach->is_doubled)) {
        gb_keep(all, found, approach->end, &approach->fit);
        return;
    }
    gb_make_triangle(&all->problem, approach->end, R(0.0), 0, &triangle);
    const gb_real regularity = gb_regularity_in(&triangle);
    if (gb_keep_moving(all, found, approach->end, &approach->fit, regularity)) {
        return;
    }
    gb_begin_curve_through(all, found, approach->end, regularity, approach->missed);
    gb_keep(all, found, approach->end, &approach->fit);
    gb_twin(all, found, approach->end, &triangle, approach->missed);
}

static void gb_refine_member(gb_answers *all, const gb_found_1 *found, const gb_real *q);

/* Such a candidate is between two solutions: starts again from the other side. */
static void gb_start_beyond(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_end *end)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_end start;
    for (size_t i = 0; i < m->joints; i++) {
        start.q[i] = gb_wrapped(m, i, q[i] + gb_shortest(m, i, q[i] - end->q[i]));
    }
    gb_polish_from(&all->problem, &start, 0);
    gb_keep(all, found, start.q, &start.fit);
}

/* Searches for curves next to the end of the steps from a candidate, and next to the candidate if that is far away. Returns whether the steps ended on a
 * curve. */
static bool gb_leads_to_curve(gb_answers *all, const gb_found_1 *found, const gb_real *q, gb_real missed, const gb_end *end, gb_real regularity)
{
    const bool is_beside = gb_is_between(missed, GB_ACCEPTANCE_ROUNDING, GB_NEARBY_ROBOTS_OFF);
    if (is_beside && gb_is_curve(all, found, end, regularity, missed) && end->fit.relative >= GB_ACCEPTANCE_ROUNDING) {
        return true;
    }
    if (gb_farthest(all->problem.mechanism, q, end->q) > GB_MERGING_BLUR) {
        gb_begin_curve(all, found, q);
    }
    return false;
}

/* Polishes a candidate with its number, and keeps the result if it solves the equations. Where two solutions almost meet, further starts around it are
 * tried. */
GB_LINKAGE void gb_refine(gb_answers *all, size_t number, const gb_found_1 *found, const gb_real *q)
{
    const gb_problem *problem = &all->problem;
    gb_end end;
    if (found->free != 0) {
        all->unsound = number;
        gb_refine_member(all, found, q);
        return;
    }
    gb_copy(end.q, q, problem->mechanism->joints);
    end.fit = gb_measure(problem, q);
    const gb_real missed = end.fit.relative;
    gb_polish(problem, &end, 0);
    const gb_real miss = end.fit.relative, delta = gb_farthest(problem->mechanism, q, end.q);
    const bool is_nearby = problem->mechanism->is_nearby;
    const bool is_beside = gb_is_between(missed, GB_ACCEPTANCE_ROUNDING, is_nearby ? GB_NEARBY_ROBOTS_OFF : GB_STRATA_NEAR);
    const bool holds = missed < GB_ACCEPTANCE_ROUNDING || (miss < GB_ACCEPTANCE_ROUNDING && delta <= GB_MERGING_JOINTS);
    all->unsound = end.fit.accepted && holds ? all->unsound : number;
    all->doubted = found->close ? number : all->doubted;
    gb_triangle triangle;
    gb_real regularity = R(1.0);
    if (is_nearby && is_beside) {
        gb_make_triangle(problem, end.q, R(0.0), 0, &triangle);
        regularity = gb_regularity_in(&triangle);
        if (gb_keep_moving(all, found, end.q, &end.fit, regularity)) {
            return;
        }
    }
    if (is_nearby && gb_leads_to_curve(all, found, q, missed, &end, regularity)) {
        gb_miss(all, end.q, &end.fit);
        return;
    }
    if (gb_is_between(miss, GB_ACCEPTANCE_ROUNDING, GB_STRATA_NEAR)) {
        gb_around(all, found, &end, miss);
    } else if (is_beside && delta > GB_LEVER * gb_square_root(missed)) {
        if (!is_nearby || regularity <= GB_PIVOTS_ISOLATED) {
            gb_around(all, found, &end, missed);
        }
        gb_start_beyond(all, found, q, &end);
    }
    if (is_nearby && is_beside) {
        gb_twin(all, found, end.q, &triangle, missed);
    }
    gb_keep(all, found, end.q, &end.fit);
}

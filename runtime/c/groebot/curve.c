/* Continuation along curves on which the equations of a nearby mechanism hold almost: see curve.rs
 *
 * Where the formulas have a self-motion, the mechanism itself may have isolated solutions anywhere on the remaining curve. Newton steps find none of them,
 * because the equations change little along the curve. A walk holds one joint after the other while the remaining ones minimise the residual. At each
 * solution the residual changes its sign. Where the ideal mechanism has two self-motions through one configuration, two curves cross: from one of them the
 * other is found, too. (E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.) */

/* The constants are those of curve.rs, where they are documented. */
#define GB_CURVE_PACES 400
#define GB_CURVE_NARROWED 24
#define GB_CURVE_CROSSING R(5e-2)
#define GB_CURVE_AT_CROSSING R(2e-2)
#define GB_CURVE_PARABOLAS 12
#define GB_CURVE_FALLEN R(0.5)
#define GB_CURVE_STALLS 2

/* A walk along one curve: how its solutions are found, its start, the place with the least residual so far, and the largest residual so far. */
typedef struct {
    gb_found_1 found;
    gb_spot home;
    gb_spot best;
    gb_real most;
} gb_curve;

static bool gb_is_listed(const gb_answers *all, const gb_real *q);

/* Polishes a place on a curve and keeps the result if it is a new solution: a member of a self-motion where one joint can move. */
static void gb_keep_on_curve(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    gb_found_1 moving = *found;
    gb_end end;
    gb_copy(end.q, q, all->problem.mechanism->joints);
    gb_polish_from(&all->problem, &end, 0);
    if (gb_is_listed(all, end.q)) {
        return;
    }
    moving.free = gb_regularity(&all->problem, end.q) <= GB_PIVOTS_REGULAR ? gb_joint_on_long_self_motion(&all->problem, end.q) : 0;
    gb_keep(all, &moving, end.q, &end.fit);
}

/* Keeps the solution between two places where the residual changes its sign, by false position (the Illinois rule: M. Dowell and P. Jarratt, BIT 11 (1971)
 * 168-174). */
static void gb_keep_change(gb_answers *all, const gb_found_1 *found, const gb_spot *a, const gb_spot *b)
{
    const gb_mechanism *m = all->problem.mechanism;
    if (gb_miss_along(m, a, b) > R(0.0) || gb_larger(a->most, b->most) <= GB_SELF_MOTIONS_MEMBER) {
        return;
    }
    const gb_spot unit = a->most > b->most ? *a : *b;
    gb_spot near = *a, far = *b, middle;
    gb_real low = gb_miss_along(m, a, &unit), high = gb_miss_along(m, b, &unit);
    int side = 0;
    for (int round = 0; round < GB_CURVE_NARROWED; round++) {
        if (!gb_between_spots(&all->problem, &near, &far, low / (low - high), &middle)) {
            break;
        }
        const gb_real value = gb_miss_along(m, &middle, &unit);
        if ((value <= R(0.0)) == (low <= R(0.0))) {
            high = side < 0 ? R(0.5) * high : gb_miss_along(m, &far, &unit);
            near = middle;
            low = value;
            side = -1;
        } else {
            low = side > 0 ? R(0.5) * low : gb_miss_along(m, &near, &unit);
            far = middle;
            high = value;
            side = 1;
        }
        if (middle.most <= GB_ACCEPTANCE_ROUNDING) {
            break;
        }
    }
    gb_keep_on_curve(all, found, near.most <= far.most ? near.q : far.q);
}

/* Searches for two solutions, or a double one, where the residual has a minimum without a change of sign: at the vertex of a parabola. */
static void gb_keep_dip(gb_answers *all, const gb_found_1 *found, const gb_spot *a, const gb_spot *b, const gb_spot *c)
{
    const gb_mechanism *m = all->problem.mechanism;
    const gb_spot unit = a->most > c->most ? *a : *c;
    const bool is_zero = b->most <= GB_SELF_MOTIONS_MEMBER;
    const gb_real ends = gb_smaller(gb_miss_along(m, a, &unit), gb_miss_along(m, c, &unit));
    const bool are_alike = ends > R(0.0) && (is_zero || gb_miss_along(m, b, &unit) > R(0.0));
    /* By the sizes of residuals, as for the triples before and after this one: of two places with equal residuals exactly one is the least. */
    const gb_real size = gb_miss_along(m, b, b);
    const bool is_least = size < gb_miss_along(m, a, a) && size <= gb_miss_along(m, c, c);
    if (!(gb_smaller(a->most, c->most) > GB_SELF_MOTIONS_MEMBER && are_alike && is_least)) {
        return;
    }
    gb_spot least = *b, sides[2] = {*a, *c}, vertex;
    size_t side;
    int stalls = 0;
    for (int k = 0; k < GB_CURVE_PARABOLAS && gb_larger(sides[0].most, sides[1].most) > GB_SELF_MOTIONS_MEMBER; k++) {
        if (!gb_find_vertex(&all->problem, &unit, &least, sides, &side, &vertex)) {
            break;
        }
        if (gb_miss_along(m, &vertex, &unit) < R(0.0)) {
            gb_keep_change(all, found, &vertex, &sides[0]);
            gb_keep_change(all, found, &vertex, &sides[1]);
            /* Rounding alone may have changed the sign. */
            if (least.most <= GB_SELF_MOTIONS_MEMBER) {
                gb_keep_on_curve(all, found, least.q);
            }
            return;
        }
        stalls += vertex.most > GB_CURVE_FALLEN * least.most;
        if (vertex.most < least.most) {
            sides[1 - side] = least;
            least = vertex;
        } else {
            sides[side] = vertex;
        }
        if (least.most > GB_SELF_MOTIONS_MEMBER && stalls >= GB_CURVE_STALLS) {
            break;
        }
    }
    if (is_zero || least.most <= GB_CURVE_FALLEN * b->most) {
        gb_keep_on_curve(all, found, least.q);
    }
}

/* Keeps a member of a self-motion of the joints that the candidate frees, or of the joint that was held first. */
static void gb_keep_whole_curve(gb_answers *all, const gb_found_1 *found, size_t held, const gb_real *q)
{
    gb_found_1 moving = *found;
    gb_end end;
    moving.free = found->free == 0 ? (uint32_t)1 << held : found->free;
    gb_copy(end.q, q, all->problem.mechanism->joints);
    gb_polish_from(&all->problem, &end, moving.free);
    gb_keep(all, &moving, end.q, &end.fit);
}

/* Adds a start in the place of one that has been removed, or after the last one. */
static void gb_insert_start(const gb_mechanism *m, gb_starts *starts, const gb_found_1 *found, const gb_real *q)
{
    size_t place = 0;
    while (place < starts->count && starts->is_open[place]) {
        place++;
    }
    if (place < GB_STARTS) {
        starts->count += place == starts->count;
        starts->found[place] = *found;
        starts->is_open[place] = true;
        gb_copy(starts->q[place], q, m->joints);
    }
}

/* Stores a crossing of curves. Returns whether it is new and there is room. */
static bool gb_is_new_crossing(const gb_mechanism *m, gb_starts *starts, const gb_real *q)
{
    for (size_t k = 0; k < starts->crossings_count; k++) {
        if (gb_farthest(m, starts->crossings[k], q) <= R(2.0) * gb_curve_pace[2]) {
            return false;
        }
    }
    if (starts->crossings_count == GB_CROSSINGS) {
        return false;
    }
    gb_copy(starts->crossings[starts->crossings_count++], q, m->joints);
    return true;
}

/* Adds starts on a curve that crosses another one next to the second of three places. */
static void gb_branch_off(gb_answers *all, gb_starts *starts, const gb_found_1 *found, const gb_spot *before, const gb_spot *at, const gb_spot *next)
{
    const gb_problem *problem = &all->problem;
    const bool is_least = at->pivot < GB_CURVE_CROSSING && at->pivot <= before->pivot && at->pivot <= next->pivot;
    gb_real direction[GB_MAX_JOINTS];
    gb_spot place;
    if (is_least && gb_is_new_crossing(problem->mechanism, starts, at->q) && gb_find_crossing(problem, before, at, direction)) {
        for (int side = 0; side < 2; side++) {
            if (gb_find_aside(problem, at, direction, side == 0 ? R(-1.0) : R(1.0), &place)) {
                gb_insert_start(problem->mechanism, starts, found, place.q);
            }
        }
    }
}

/* Whether joint values are next to a step of a walk. */
static bool gb_is_passed(const gb_mechanism *m, const gb_real *q, const gb_real *from, const gb_real *to)
{
    gb_real delta[GB_MAX_JOINTS], aside[GB_MAX_JOINTS], nearest[GB_MAX_JOINTS];
    gb_differences(m, to, from, delta);
    gb_differences(m, q, from, aside);
    const gb_real share = gb_scalar_product(aside, delta, m->joints) / gb_scalar_product(delta, delta, m->joints);
    gb_beyond(m, to, from, -gb_smaller(gb_larger(share, R(0.0)), R(1.0)), nearest);
    return gb_farthest(m, q, nearest) <= GB_MERGING_KNOWN;
}

/* Records a new place of a walk, and removes the starts next to the step. */
static void gb_pass(const gb_mechanism *m, gb_starts *starts, gb_curve *curve, const gb_spot *before, const gb_spot *at)
{
    for (size_t k = 0; k < starts->count; k++) {
        starts->is_open[k] = starts->is_open[k] && !gb_is_passed(m, starts->q[k], before->q, at->q);
    }
    curve->most = gb_larger(curve->most, at->most);
    curve->best = at->most < curve->best.most ? *at : curve->best;
}

/* Follows the curve from home through a place until it closes or ends. Returns whether it closed. */
static bool gb_leads_home(gb_answers *all, gb_starts *starts, gb_curve *curve, const gb_spot *side)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_spot before = curve->home, at = *side, next;
    gb_real pace = gb_curve_pace[1], last = gb_curve_pace[1];
    bool is_away = false;
    gb_keep_change(all, &curve->found, &before, &at);
    for (int k = 0; k < GB_CURVE_PACES; k++) {
        gb_pass(m, starts, curve, &before, &at);
        const gb_real delta = gb_farthest(m, at.q, curve->home.q);
        is_away |= delta > R(3.0) * gb_curve_pace[2];
        if (is_away && delta <= gb_curve_pace[2]) {
            gb_keep_change(all, &curve->found, &at, &curve->home);
            return true;
        }
        if (!gb_pace(&all->problem, &before, &at, &last, &pace, &next)) {
            gb_branch_off(all, starts, &curve->found, &before, &at, &before);
            return false;
        }
        gb_keep_change(all, &curve->found, &at, &next);
        gb_keep_dip(all, &curve->found, &before, &at, &next);
        gb_branch_off(all, starts, &curve->found, &before, &at, &next);
        /* Consecutive places with residuals within rounding are one solution, or several close together. */
        if ((at.most <= GB_SELF_MOTIONS_MEMBER) != (next.most <= GB_SELF_MOTIONS_MEMBER)) {
            gb_keep_on_curve(all, &curve->found, at.most <= GB_SELF_MOTIONS_MEMBER ? at.q : next.q);
        }
        before = at;
        at = next;
    }
    return false;
}

/* Follows the curve next to a candidate, in both directions if it is not closed. Where the residual is zero along the curve, it is a self-motion, and one
 * member is kept. */
static void gb_walk_curve(gb_answers *all, gb_starts *starts, const gb_found_1 *found, const gb_real *q)
{
    const gb_problem *problem = &all->problem;
    gb_curve curve;
    gb_spot sides[2];
    bool is_there[2];
    size_t held;
    if (!gb_start_on_curve(problem, q, found->free, &curve.home, &held)) {
        return;
    }
    for (int k = 0; k < 2; k++) {
        gb_copy(sides[k].q, curve.home.q, problem->mechanism->joints);
        sides[k].q[held] = gb_moved(problem->mechanism, curve.home.q, held, k == 0 ? -gb_curve_pace[1] : gb_curve_pace[1]);
        is_there[k] = gb_settle_on_curve(problem, held, &sides[k]);
    }
    curve.found = *found;
    curve.found.free = 0;
    curve.best = curve.home;
    curve.most = curve.home.most;
    if (curve.home.most <= GB_SELF_MOTIONS_MEMBER) {
        gb_keep_on_curve(all, &curve.found, curve.home.q);
    }
    if (is_there[0] && is_there[1]) {
        gb_keep_dip(all, &curve.found, &sides[0], &curve.home, &sides[1]);
        gb_branch_off(all, starts, &curve.found, &sides[0], &curve.home, &sides[1]);
    }
    if (!(is_there[0] && gb_leads_home(all, starts, &curve, &sides[0])) && is_there[1]) {
        gb_leads_home(all, starts, &curve, &sides[1]);
    }
    /* A place without neighbours shows no self-motion. */
    if ((is_there[0] || is_there[1]) && curve.most <= GB_CURVE_WHOLE) {
        gb_keep_whole_curve(all, found, held, curve.best.q);
    }
}

/* The first start that is left, or the number of starts. */
static size_t gb_next_start(const gb_starts *starts)
{
    size_t place = 0;
    while (place < starts->count && !starts->is_open[place]) {
        place++;
    }
    return place;
}

/* Follows the curves next to the stored candidates, and keeps the solutions on them. */
GB_LINKAGE void gb_walk_curves(gb_answers *all)
{
    gb_starts starts = all->starts;
    all->starts.count = 0;
    starts.crossings_count = 0;
    for (size_t k = gb_next_start(&starts); k < starts.count; k = gb_next_start(&starts)) {
        const gb_found_1 found = starts.found[k];
        gb_real q[GB_MAX_JOINTS];
        gb_copy(q, starts.q[k], all->problem.mechanism->joints);
        starts.is_open[k] = false;
        gb_walk_curve(all, &starts, &found, q);
    }
}

/* Stores a candidate next to which there is a curve, to follow it after all candidates, if the least pivot of the joints that follow is at most `pivot` there.
 * Returns whether there is one. */
static bool gb_begin_curve_within(gb_answers *all, const gb_found_1 *found, const gb_real *q, gb_real pivot)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_spot start;
    size_t held;
    /* Numbers that follow from no joint belong to one candidate, so they cannot be stored. */
    if (m->has_extras || !gb_start_on_curve(&all->problem, q, found->free, &start, &held) || !(start.pivot <= pivot)) {
        return false;
    }
    if (all->starts.count == GB_STARTS) {
        gb_walk_curves(all);
    }
    const size_t k = all->starts.count++;
    all->starts.found[k] = *found;
    all->starts.found[k].free = gb_is_in(found->free, held) ? found->free : 0;
    all->starts.is_open[k] = true;
    gb_copy(all->starts.q[k], start.q, m->joints);
    return true;
}

/* Stores a candidate next to which there is a curve, to follow it after all candidates. Returns whether there is one. */
static bool gb_begin_curve(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    return gb_begin_curve_within(all, found, q, R(1.0));
}

/* Same as gb_begin_curve, if another curve crosses it next to the candidate. */
static bool gb_begin_crossing_curve(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    return gb_begin_curve_within(all, found, q, GB_CURVE_AT_CROSSING);
}

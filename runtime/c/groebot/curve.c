/* Continuation along curves on which the equations of a nearby mechanism hold almost: see curve.rs
 *
 * Where the formulas have a self-motion, the mechanism itself may have isolated solutions anywhere on the remaining curve. Newton steps find none of them,
 * because the equations change little along the curve. A walk holds one joint after the other while the remaining ones minimise the residual. At each
 * solution the residual changes its sign. (E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.) */

/* The constants are those of curve.rs, where they are documented. */
#define GB_CURVE_ROUNDS 6
#define GB_CURVE_BOUND R(0.5)
#define GB_CURVE_PACES 400
#define GB_CURVE_STRAIGHT R(0.5)
#define GB_CURVE_NARROWED 24
#define GB_CURVE_PARABOLAS 12
#define GB_CURVE_FALLEN R(0.5)
#define GB_CURVE_STALLS 2
#define GB_CURVE_ALIGNED R(0.5)
#define GB_CURVE_FEWFOLD R(30.0)
#define GB_CURVE_WHOLE (R(10.0) * GB_ACCEPTANCE_RESIDUAL)
/* The shortest, the first and the longest step along a curve. */
static const gb_real gb_curve_pace[] = {R(1.5e-3), R(2.5e-2), R(0.1)};

/* A place on a curve: joints, the relative residuals there, and the largest of them. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_real miss[GB_MAX_EQUATIONS];
    gb_real most;
} gb_spot;

/* A walk along one curve: how its solutions are found, its start, the place with the least residual so far, and the largest residual so far. */
typedef struct {
    gb_found_1 found;
    gb_spot home;
    gb_spot best;
    gb_real most;
} gb_curve;

static bool gb_is_listed(const gb_answers *all, const gb_real *q);

/* The index of the entry with the greatest magnitude, the first of equals. */
static size_t gb_greatest(const gb_real *delta, size_t count)
{
    size_t best = 0;
    for (size_t i = 1; i < count; i++) {
        best = gb_magnitude(delta[i]) > gb_magnitude(delta[best]) ? i : best;
    }
    return best;
}

/* The joint with the largest difference between `b` and `a`. */
static size_t gb_farthest_joint(const gb_mechanism *m, const gb_real *a, const gb_real *b)
{
    gb_real delta[GB_MAX_JOINTS];
    gb_differences(m, a, b, delta);
    return gb_greatest(delta, m->joints);
}

static gb_real gb_scalar_product(const gb_real *a, const gb_real *b, size_t count)
{
    gb_real sum = R(0.0);
    for (size_t i = 0; i < count; i++) {
        sum = sum + a[i] * b[i];
    }
    return sum;
}

/* The scalar product of the residual vectors of two places. */
static gb_real gb_miss_along(const gb_mechanism *m, const gb_spot *a, const gb_spot *b)
{
    return gb_scalar_product(a->miss, b->miss, m->equations);
}

/* Whether the residual vector changes little from another place, or only its sign: then no solution between the two is missed. */
static bool gb_goes_on(const gb_mechanism *m, const gb_spot *spot, const gb_spot *other)
{
    const gb_real here = gb_miss_along(m, spot, spot), there = gb_miss_along(m, other, other), along = gb_miss_along(m, spot, other);
    const bool is_flat = gb_is_between(spot->most, GB_ACCEPTANCE_ROUNDING, GB_CURVE_WHOLE);
    return along * along > GB_CURVE_ALIGNED * here * there && !is_flat
        && (along < R(0.0) || gb_larger(here, there) <= GB_CURVE_FEWFOLD * gb_smaller(here, there));
}

/* Takes least-squares steps from `spot->q` with one joint held, until they are short. False where they do not converge. */
static bool gb_settle_on_curve(const gb_problem *problem, size_t held, gb_spot *spot)
{
    const gb_mechanism *m = problem->mechanism;
    for (int round = 0; round < GB_CURVE_ROUNDS; round++) {
        gb_real rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS], step[GB_MAX_JOINTS];
        gb_triangle triangle;
        if (gb_are_spent(problem)) {
            return false;
        }
        gb_share(problem, spot->q, rows, spot->miss);
        gb_clear_triangle(m, &triangle);
        gb_copy(gb_column(&triangle, m->joints), spot->miss, m->equations);
        gb_fill_triangle(problem, rows, R(0.0), (uint32_t)1 << held, &triangle);
        if (!gb_substitute(&triangle, step)) {
            return false;
        }
        const gb_real longest = gb_longest(m, step);
        if (longest > GB_CURVE_BOUND) {
            return false;
        }
        gb_stepped(m, spot->q, step, spot->q);
        if (longest <= GB_SELF_MOTIONS_CURVE) {
            spot->most = R(0.0);
            for (size_t i = 0; i < m->equations; i++) {
                for (size_t k = 0; k < m->joints; k++) {
                    spot->miss[i] = spot->miss[i] - rows[i * m->joints + k] * step[k];
                }
                spot->most = gb_larger(spot->most, gb_magnitude(spot->miss[i]));
            }
            return spot->most <= GB_STRATA_NEAR;
        }
    }
    return false;
}

/* The place next to joint values reached with one joint held. Returns whether it is on a curve along which all other joints follow. */
static bool gb_start_with(const gb_problem *problem, const gb_real *q, size_t held, gb_spot *spot)
{
    gb_copy(spot->q, q, problem->mechanism->joints);
    return gb_settle_on_curve(problem, held, spot) && gb_regularity_of(problem, spot->q, (uint32_t)1 << held) > GB_PIVOTS_WEAK;
}

/* The place on the curve next to `q`, and the joint that is held to reach it. This is a free joint. Where none is free, or the others move without it, it is
 * the joint that moves farthest in the direction in which the equations change least. */
static bool gb_start_on_curve(const gb_problem *problem, const gb_real *q, uint32_t free, gb_spot *spot, size_t *held)
{
    gb_triangle triangle;
    gb_real delta[GB_MAX_JOINTS], share;
    if (free != 0) {
        for (*held = 0; !gb_is_in(free, *held); (*held)++) {
        }
        if (gb_start_with(problem, q, *held, spot)) {
            return true;
        }
    }
    gb_make_triangle(problem, q, R(0.0), 0, &triangle);
    if (!gb_stillest(problem, &triangle, delta, &share)) {
        return false;
    }
    *held = gb_greatest(delta, problem->mechanism->joints);
    return gb_start_with(problem, q, *held, spot);
}

/* The place on the curve at a fraction `share` of the distance from `a` to `b`. */
static bool gb_between_spots(const gb_problem *problem, const gb_spot *a, const gb_spot *b, gb_real share, gb_spot *middle)
{
    const gb_mechanism *m = problem->mechanism;
    gb_beyond(m, b->q, a->q, -share, middle->q);
    return gb_settle_on_curve(problem, gb_farthest_joint(m, b->q, a->q), middle);
}

/* A step along the curve from `at`, shorter where it bends, and its length. `last` is the length of the step before. False where the curve ends. */
static bool gb_pace(const gb_problem *problem, const gb_spot *before, const gb_spot *at, gb_real *last, gb_real *pace, gb_spot *next)
{
    const gb_mechanism *m = problem->mechanism;
    const size_t held = gb_farthest_joint(m, at->q, before->q);
    for (; *pace >= gb_curve_pace[0]; *pace *= R(0.5)) {
        gb_real ahead[GB_MAX_JOINTS];
        gb_beyond(m, before->q, at->q, *pace / *last, ahead);
        gb_copy(next->q, ahead, m->joints);
        if (gb_settle_on_curve(problem, held, next) && gb_farthest(m, next->q, ahead) <= GB_CURVE_STRAIGHT * *pace
            && (*pace <= gb_curve_pace[1] || gb_goes_on(m, next, at))) {
            *last = gb_farthest(m, next->q, at->q);
            *pace = gb_smaller(R(2.0) * *pace, gb_curve_pace[2]);
            return true;
        }
    }
    return false;
}

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

/* The minimum of a parabola through the residuals of three places, projected on a direction; the middle place has the least residual. Also returns the side
 * on which the minimum is. */
static bool gb_find_vertex(const gb_problem *problem, const gb_spot *unit, const gb_spot *least, const gb_spot *sides, size_t *side, gb_spot *vertex)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real low = gb_miss_along(m, &sides[0], unit), middle = gb_miss_along(m, least, unit), high = gb_miss_along(m, &sides[1], unit);
    const gb_real lengths[2] = {gb_farthest(m, sides[0].q, least->q), gb_farthest(m, sides[1].q, least->q)};
    const gb_real fall = (middle - low) / lengths[0], rise = (high - middle) / lengths[1];
    const gb_real delta = R(0.5) * (fall * lengths[1] + rise * lengths[0]) / (fall - rise);
    *side = delta >= R(0.0);
    return gb_between_spots(problem, least, &sides[*side], gb_magnitude(delta) / lengths[*side], vertex);
}

/* Searches for two solutions, or a double one, where the residual has a minimum without a change of sign: at the vertex of a parabola. */
static void gb_keep_dip(gb_answers *all, const gb_found_1 *found, const gb_spot *a, const gb_spot *b, const gb_spot *c)
{
    const gb_mechanism *m = all->problem.mechanism;
    const gb_spot unit = a->most > c->most ? *a : *c;
    const gb_real middle = gb_miss_along(m, b, &unit), ends = gb_smaller(gb_miss_along(m, a, &unit), gb_miss_along(m, c, &unit));
    const bool is_zero = b->most <= GB_SELF_MOTIONS_MEMBER;
    if (!(gb_smaller(a->most, c->most) > GB_SELF_MOTIONS_MEMBER && ends > middle && (is_zero || middle > R(0.0)))) {
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
            return false;
        }
        gb_keep_change(all, &curve->found, &at, &next);
        gb_keep_dip(all, &curve->found, &before, &at, &next);
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
    }
    if (!(is_there[0] && gb_leads_home(all, starts, &curve, &sides[0])) && is_there[1]) {
        gb_leads_home(all, starts, &curve, &sides[1]);
    }
    if (curve.most <= GB_CURVE_WHOLE) {
        gb_keep_whole_curve(all, found, held, curve.best.q);
    }
}

/* Follows the curves next to the stored candidates, and keeps the solutions on them. */
GB_LINKAGE void gb_walk_curves(gb_answers *all)
{
    gb_starts starts = all->starts;
    all->starts.count = 0;
    for (size_t k = 0; k < starts.count; k++) {
        if (starts.is_open[k]) {
            starts.is_open[k] = false;
            gb_walk_curve(all, &starts, &starts.found[k], starts.q[k]);
        }
    }
}

/* Stores a candidate next to which there is a curve, to follow it after all candidates. Returns whether there is one. */
static bool gb_begin_curve(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_spot start;
    size_t held;
    /* Numbers that follow from no joint belong to one candidate, so they cannot be stored. */
    if (m->has_extras || !gb_start_on_curve(&all->problem, q, found->free, &start, &held)) {
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

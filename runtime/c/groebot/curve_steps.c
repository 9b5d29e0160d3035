/* Steps along a curve on which the equations of a nearby mechanism hold almost: see curve_steps.rs */

/* The constants are those of curve_steps.rs, where they are documented. */
#define GB_CURVE_ROUNDS 6
#define GB_CURVE_BOUND R(0.5)
#define GB_CURVE_STRAIGHT R(0.5)
#define GB_CURVE_ALIGNED R(0.5)
#define GB_CURVE_FEWFOLD R(30.0)
#define GB_CURVE_WHOLE (R(10.0) * GB_ACCEPTANCE_RESIDUAL)
/* The shortest, the first and the longest step along a curve. */
static const gb_real gb_curve_pace[] = {R(1.5e-3), R(2.5e-2), R(0.1)};
/* Distances from a crossing at which the other curve is searched for. */
#define GB_CURVE_ASIDES 3
static const gb_real gb_curve_aside[GB_CURVE_ASIDES] = {R(0.1), R(0.2), R(0.4)};
#define GB_CURVE_ASTRAY R(3.0)

/* A place on a curve: joints, the relative residuals there, the largest of them, and the least pivot of the joints that follow the one that is held, relative
 * to the largest. It is small where another curve crosses. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_real miss[GB_MAX_EQUATIONS];
    gb_real most;
    gb_real pivot;
} gb_spot;

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
            spot->pivot = gb_regularity_in(&triangle);
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

/* The place on one side of `at` on a curve that crosses the one from another place there, in a direction of the other curve. */
static bool gb_find_aside(const gb_problem *problem, const gb_spot *at, const gb_real *direction, gb_real sign, gb_spot *place)
{
    const gb_mechanism *m = problem->mechanism;
    const size_t joint = gb_greatest(direction, m->joints);
    for (int i = 0; i < GB_CURVE_ASIDES; i++) {
        gb_shifted(m, at->q, direction, sign * gb_curve_aside[i], place->q);
        if (gb_settle_on_curve(problem, joint, place) && gb_farthest(m, place->q, at->q) <= GB_CURVE_ASTRAY * gb_curve_aside[i]
            && place->pivot > at->pivot) {
            return true;
        }
    }
    return false;
}

/* The direction of a curve that crosses the one from `before` to `at` there: in it the equations change least while the joint that is held on the first curve
 * does not move. */
static bool gb_find_crossing(const gb_problem *problem, const gb_spot *before, const gb_spot *at, gb_real *direction)
{
    const gb_mechanism *m = problem->mechanism;
    const size_t held = gb_farthest_joint(m, at->q, before->q);
    gb_real rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS], miss[GB_MAX_EQUATIONS], share;
    gb_triangle triangle;
    gb_share(problem, at->q, rows, miss);
    gb_clear_triangle(m, &triangle);
    gb_copy(gb_column(&triangle, m->joints), miss, m->equations);
    gb_fill_triangle(problem, rows, R(0.0), (uint32_t)1 << held, &triangle);
    return gb_stillest(problem, &triangle, direction, &share);
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

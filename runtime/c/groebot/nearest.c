/* The solution nearest to reference joint values, on the self-motions of a singular target too: see nearest.rs
 *
 * Where a self-motion is a curve, it is followed from its listed member by tangents and Newton steps with one joint held (E. L. Allgower and K. Georg,
 * Numerical Continuation Methods, 1990, chapter 3). Golden sections locate each local minimum of the distance (J. Kiefer, Proceedings of the American
 * Mathematical Society 4 (1953) 502-506). On surfaces, and next to the reference, Gauss-Newton steps minimise the distance subject to the equations. */

/* The constants are those of nearest.rs, where they are documented. */
#define GB_NEAREST_PACES 600
#define GB_NEAREST_STRAIGHT R(0.25)
#define GB_NEAREST_SECTIONS 48
#define GB_NEAREST_GOLDEN R(0.6180339887498949)
#define GB_NEAREST_LONGER R(2.0)
static const gb_real gb_nearest_pace[] = {R(1.5e-3), R(2.5e-2), R(0.2)};

/* The search along self-motions. */
typedef struct {
    const gb_problem *problem;
    gb_aim aim;
    gb_nearest_end *best;
} gb_search;

/* A place on a self-motion. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_turned_joints turned;
} gb_stop;

/* Keeps joint values if they are a solution within limits and nearer than the others. `member` is the index of the listed solution on their self-motion, or
 * -1. */
static void gb_consider(const gb_search *search, const gb_end *end, int member, gb_turned_joints *turned)
{
    const gb_mechanism *m = search->problem->mechanism;
    gb_nearest_end *best = search->best;
    gb_turn_to(m, &search->aim, end->q, turned);
    if (!end->fit.accepted || turned->excess > R(0.0)) {
        return;
    }
    if (best->is_found && best->distance <= turned->distance) {
        if (best->member < 0) {
            gb_real wrapped[GB_MAX_JOINTS];
            for (size_t i = 0; i < m->joints; i++) {
                wrapped[i] = gb_wrapped(m, i, best->q[i]);
            }
            best->member = gb_farthest(m, wrapped, end->q) <= GB_MERGING_APART ? member : best->member;
        }
        return;
    }
    best->is_found = true;
    best->member = member;
    best->distance = turned->distance;
    best->fit = end->fit;
    gb_copy(best->q, turned->q, m->joints);
}

/* The displacement to the reference within limits, shortened to a leap. Joints that are `held` do not move. */
static void gb_toward(const gb_search *search, const gb_real *q, uint32_t held, gb_real *toward)
{
    const gb_mechanism *m = search->problem->mechanism;
    gb_turned_joints turned;
    gb_turn_to(m, &search->aim, q, &turned);
    for (size_t i = 0; i < m->joints; i++) {
        const gb_real *limit = search->aim.limits + 2 * i;
        const gb_real wanted = gb_smaller(gb_larger(search->aim.reference[i], limit[0]), limit[1]);
        toward[i] = gb_is_in(held, i) ? R(0.0) : wanted - turned.q[i];
    }
    const gb_real longest = gb_longest(m, toward), share = longest > gb_leaps[0] ? gb_leaps[0] / longest : R(1.0);
    for (size_t i = 0; i < m->joints; i++) {
        toward[i] = share * toward[i];
    }
}

/* The displacement with which the linearised equations hold, nearest to `toward` by the weights. */
static bool gb_project(const gb_search *search, const gb_real *q, const gb_real *toward, uint32_t held, gb_real *step)
{
    const gb_mechanism *m = search->problem->mechanism;
    const gb_real *weights = search->aim.weights;
    gb_real scale[GB_MAX_JOINTS], greatest = R(0.0);
    gb_slopes slopes;
    gb_triangle triangle;
    if (gb_are_spent(search->problem)) {
        return false;
    }
    for (size_t i = 0; i < m->joints; i++) {
        greatest = gb_larger(greatest, weights[i]);
    }
    for (size_t i = 0; i < m->joints; i++) {
        const gb_real weight = gb_larger(GB_PIVOTS_REGULAR_STEPS * greatest, weights[i]);
        scale[i] = greatest > R(0.0) ? gb_square_root(greatest / weight) : R(1.0);
    }
    gb_find_slopes(search->problem, q, &slopes);
    for (size_t k = 0; k < m->equations; k++) {
        for (size_t i = 0; i < m->joints; i++) {
            slopes.values[k] += slopes.rows[k * m->joints + i] * toward[i];
            slopes.rows[k * m->joints + i] *= scale[i];
        }
    }
    gb_triangle_of(search->problem, &slopes, gb_dampings[1], held, &triangle);
    if (!gb_substitute(&triangle, step)) {
        return false;
    }
    for (size_t i = 0; i < m->joints; i++) {
        step[i] = toward[i] - scale[i] * step[i];
    }
    return true;
}

/* Takes a few Newton steps, each the shortest one. */
static void gb_come_near(const gb_problem *problem, gb_end *end, uint32_t held)
{
    gb_real step[GB_MAX_JOINTS];
    end->fit = gb_measure(problem, end->q);
    for (int k = 0; k < GB_RETURNS; k++) {
        if (end->fit.relative <= GB_ACCEPTANCE_ROUNDING || !gb_newton_step(problem, end->q, gb_dampings[1], held, step)) {
            return;
        }
        gb_stepped(problem->mechanism, end->q, step, end->q);
        end->fit = gb_measure(problem, end->q);
    }
}

/* Minimises the distance subject to the equations by Gauss-Newton steps from `q`. A joint that reaches its limit stays there. */
static void gb_descend(const gb_search *search, const gb_real *start, int member)
{
    const gb_mechanism *m = search->problem->mechanism;
    gb_real q[GB_MAX_JOINTS], toward[GB_MAX_JOINTS], step[GB_MAX_JOINTS];
    uint32_t held = 0;
    for (size_t i = 0; i < m->joints; i++) {
        q[i] = gb_wrapped(m, i, start[i] + R(0.0));
    }
    gb_stop_at_limits(m, &search->aim, q);
    for (int k = 0; k < GB_DESCENTS; k++) {
        gb_end end;
        gb_turned_joints turned;
        gb_toward(search, q, held, toward);
        if (!gb_project(search, q, toward, held, step)) {
            return;
        }
        gb_shifted(m, q, step, R(1.0), end.q);
        held |= gb_stop_at_limits(m, &search->aim, end.q);
        gb_come_near(search->problem, &end, held);
        gb_consider(search, &end, member, &turned);
        const gb_real moved = gb_farthest(m, end.q, q);
        gb_copy(q, end.q, m->joints);
        if (!(moved > GB_POLISHING_STEP)) {
            return;
        }
    }
}

/* The tangent of a self-motion at `q`, with its longest component equal to one. The joints of a set are tried first as its parameter. False unless the
 * self-motion is a curve there. */
static bool gb_find_direction(const gb_problem *problem, const gb_real *q, uint32_t first, gb_real *tangent)
{
    const size_t joints = problem->mechanism->joints;
    bool is_found = false;
    for (size_t i = 0; !is_found && i < 2 * joints; i++) {
        is_found = gb_is_in(first, i % joints) == (i < joints) && gb_find_tangent(problem, q, (uint32_t)1 << i % joints, tangent);
    }
    if (!is_found) {
        return false;
    }
    const gb_real longest = gb_longest(problem->mechanism, tangent);
    for (size_t i = 0; i < joints; i++) {
        tangent[i] = tangent[i] / longest;
    }
    return longest > GB_PIVOTS_REGULAR;
}

/* Replaces a tangent by that at `q`, on the same side. */
static bool gb_go_on(const gb_problem *problem, const gb_real *q, gb_real *tangent)
{
    const size_t joints = problem->mechanism->joints;
    gb_real before[GB_MAX_JOINTS];
    gb_copy(before, tangent, joints);
    if (!gb_find_direction(problem, q, (uint32_t)1 << gb_greatest(before, joints), tangent)) {
        return false;
    }
    const gb_real side = gb_scalar_product(tangent, before, joints) < R(0.0) ? R(-1.0) : R(1.0);
    for (size_t i = 0; i < joints; i++) {
        tangent[i] = side * tangent[i];
    }
    return true;
}

/* A step along a tangent, which is shortened where the curve bends. */
static bool gb_advance(const gb_search *search, const gb_real *from, const gb_real *tangent, gb_real *pace, gb_stop *next)
{
    const gb_mechanism *m = search->problem->mechanism;
    const uint32_t held = (uint32_t)1 << gb_greatest(tangent, m->joints);
    gb_real ahead[GB_MAX_JOINTS];
    gb_end end;
    while (*pace >= gb_nearest_pace[0]) {
        gb_shifted(m, from, tangent, *pace, ahead);
        gb_copy(end.q, ahead, m->joints);
        if (gb_correct(search->problem, &end, held) && gb_farthest(m, end.q, ahead) <= GB_NEAREST_STRAIGHT * *pace) {
            *pace = gb_smaller(gb_nearest_pace[2], R(2.0) * *pace);
            gb_copy(next->q, end.q, m->joints);
            gb_turn_to(m, &search->aim, next->q, &next->turned);
            return true;
        }
        *pace *= R(0.5);
    }
    return false;
}

/* Whether a step passes home. */
static bool gb_passes_home(const gb_mechanism *m, const gb_stop *home, const gb_stop *at, const gb_stop *next)
{
    gb_real step[GB_MAX_JOINTS], delta[GB_MAX_JOINTS], foot[GB_MAX_JOINTS];
    gb_differences(m, next->q, at->q, step);
    gb_differences(m, home->q, at->q, delta);
    const gb_real along = gb_scalar_product(step, delta, m->joints), square = gb_scalar_product(step, step, m->joints);
    gb_beyond(m, at->q, next->q, along / square - R(1.0), foot);
    return along >= R(0.0) && along <= square && gb_farthest(m, foot, home->q) <= GB_NEAREST_STRAIGHT * gb_longest(m, step);
}

/* Whether no place between three consecutive ones is nearer than the best solution so far. */
static bool gb_is_hopeless(const gb_search *search, const gb_stop *const *places)
{
    const gb_mechanism *m = search->problem->mechanism;
    gb_real back[GB_MAX_JOINTS], ahead[GB_MAX_JOINTS], square = R(0.0);
    if (!search->best->is_found) {
        return false;
    }
    gb_differences(m, places[0]->q, places[1]->q, back);
    gb_differences(m, places[2]->q, places[1]->q, ahead);
    for (size_t i = 0; i < m->joints; i++) {
        const gb_real most = GB_NEAREST_LONGER * gb_larger(gb_magnitude(back[i]), gb_magnitude(ahead[i]));
        square += search->aim.weights[i] * most * most;
    }
    const gb_real least = gb_square_root(places[1]->turned.distance) - gb_square_root(square);
    return least > gb_square_root(search->best->distance);
}

/* The place on the curve at a share, from -1 to 1, of the distances from the middle one of three places. */
static void gb_between(const gb_search *search, const gb_stop *const *places, gb_real share, uint32_t held, int member, gb_turned_joints *turned)
{
    gb_end end;
    gb_beyond(search->problem->mechanism, places[share < R(0.0) ? 0 : 2]->q, places[1]->q, -gb_magnitude(share), end.q);
    gb_polish_from(search->problem, &end, held);
    gb_consider(search, &end, member, turned);
}

/* Searches a minimum between three consecutive places if the middle one is the best of them: nearest to the limits, then nearest to the reference. */
static void gb_bracket(const gb_search *search, const gb_stop *const *places, int member)
{
    const gb_turned_joints *middle = &places[1]->turned;
    if (gb_is_better(&places[0]->turned, middle) || gb_is_better(&places[2]->turned, middle) || gb_is_hopeless(search, places)) {
        return;
    }
    const uint32_t held = (uint32_t)1 << gb_farthest_joint(search->problem->mechanism, places[0]->q, places[2]->q);
    gb_real low = R(-1.0), high = R(1.0);
    gb_real left = low + (R(1.0) - GB_NEAREST_GOLDEN) * (high - low), right = low + GB_NEAREST_GOLDEN * (high - low);
    gb_turned_joints at_left, at_right;
    gb_between(search, places, left, held, member, &at_left);
    gb_between(search, places, right, held, member, &at_right);
    for (int k = 0; k < GB_NEAREST_SECTIONS; k++) {
        if (gb_is_better(&at_left, &at_right)) {
            high = right;
            right = left;
            at_right = at_left;
            left = low + (R(1.0) - GB_NEAREST_GOLDEN) * (high - low);
            gb_between(search, places, left, held, member, &at_left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + GB_NEAREST_GOLDEN * (high - low);
            gb_between(search, places, right, held, member, &at_right);
        }
    }
}

/* Follows a curve from home and searches each local minimum on it. Returns whether it leads back home. */
static bool gb_is_closed(const gb_search *search, const gb_stop *home, gb_real *tangent, int member)
{
    const gb_mechanism *m = search->problem->mechanism;
    gb_real opposite[GB_MAX_JOINTS], back = gb_nearest_pace[1], pace = gb_nearest_pace[1];
    gb_stop before, at = *home, next;
    gb_end end;
    gb_turned_joints turned;
    bool is_home = false;
    for (size_t i = 0; i < m->joints; i++) {
        opposite[i] = -tangent[i];
    }
    bool has_before = gb_advance(search, home->q, opposite, &back, &before);
    for (int steps = 0; steps < GB_NEAREST_PACES && gb_advance(search, at.q, tangent, &pace, &next); steps++) {
        const gb_stop *const places[] = {&before, &at, &next};
        if (has_before) {
            gb_bracket(search, places, member);
        }
        if (is_home) {
            return true;
        }
        is_home = steps > 1 && gb_passes_home(m, home, &at, &next);
        if (!gb_go_on(search->problem, next.q, tangent)) {
            break;
        }
        before = at;
        at = next;
        has_before = true;
    }
    gb_copy(end.q, at.q, m->joints);
    gb_polish_from(search->problem, &end, (uint32_t)1 << gb_greatest(tangent, m->joints));
    gb_consider(search, &end, member, &turned);
    return false;
}

/* Follows the self-motion of a member in both directions if it is a curve. Otherwise the distance is minimised from the member. */
static void gb_follow_member(const gb_search *search, const gb_real *q, uint32_t free, int member)
{
    const gb_mechanism *m = search->problem->mechanism;
    gb_real tangent[GB_MAX_JOINTS], opposite[GB_MAX_JOINTS];
    gb_stop home;
    if (!gb_find_direction(search->problem, q, free, tangent)) {
        gb_descend(search, q, member);
        return;
    }
    gb_copy(home.q, q, m->joints);
    gb_turn_to(m, &search->aim, q, &home.turned);
    for (size_t i = 0; i < m->joints; i++) {
        opposite[i] = -tangent[i];
    }
    if (!gb_is_closed(search, &home, tangent, member)) {
        gb_is_closed(search, &home, opposite, member);
    }
}

/* Whether a listed solution, or one on its self-motion, equals the reference within rounding. */
static bool gb_is_reached(const gb_nearest_end *best)
{
    return best->is_found && best->member >= 0 && best->distance <= GB_ACCEPTANCE_ROUNDING * GB_ACCEPTANCE_ROUNDING;
}

/* The listed solution that is nearest to a reference. */
GB_LINKAGE void gb_begin_nearest(const gb_answers *all, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_nearest_end *best)
{
    const gb_mechanism *m = all->problem.mechanism;
    const gb_aim aim = {reference, weights, limits};
    gb_turned_joints turned;
    best->member = gb_nearest(all, reference, weights, limits, best->q);
    best->is_found = best->member >= 0;
    best->can_search = !m->has_extras && all->count > 0;
    for (size_t i = 0; i < m->joints; i++) {
        best->can_search = best->can_search && gb_is_finite(reference[i]) && gb_is_finite(weights[i]);
    }
    if (best->is_found) {
        gb_turn_to(m, &aim, gb_q_of(all, (size_t)best->member), &turned);
        best->distance = turned.distance;
        best->fit.residual = *gb_residual_of(all, (size_t)best->member);
        best->fit.relative = *gb_relative_of(all, (size_t)best->member);
    }
}

/* Follows the self-motion of a member through `q`. */
GB_LINKAGE void gb_search_along(const gb_problem *problem, const gb_real *q, uint32_t free, const gb_real *const *aim, gb_nearest_end *best)
{
    const gb_search search = {problem, {aim[0], aim[1], aim[2]}, best};
    gb_follow_member(&search, q, free, best->follows);
}

/* Moves the nearest solution to `q` if that is within limits. */
GB_LINKAGE void gb_move_nearest(const gb_mechanism *m, const gb_real *q, const gb_fit *fit, const gb_real *const *aim, gb_nearest_end *best)
{
    const gb_aim own = {aim[0], aim[1], aim[2]};
    gb_turned_joints turned;
    gb_turn_to(m, &own, q, &turned);
    if (turned.excess == R(0.0)) {
        gb_copy(best->q, turned.q, m->joints);
        best->distance = turned.distance;
        best->fit = *fit;
    }
}

/* Searches next to the reference, then along the self-motion of each listed member. Where there is none, only if the reference is a solution itself: next to
 * a singular pose rounding moves the listed solution away from it. */
GB_LINKAGE void gb_search_all(const gb_answers *all, const gb_real *const *aim, gb_nearest_end *best)
{
    const gb_search search = {&all->problem, {aim[0], aim[1], aim[2]}, best};
    bool has_member = false;
    for (size_t k = 0; k < all->count; k++) {
        has_member = has_member || *gb_free_of(all, k) != 0;
    }
    if (!has_member && (gb_is_reached(best) || !(gb_measure(&all->problem, aim[0]).relative <= GB_ACCEPTANCE_UNSETTLED))) {
        return;
    }
    gb_descend(&search, aim[0], -1);
    for (size_t k = 0; k < all->count && !gb_is_reached(best); k++) {
        if (*gb_free_of(all, k) != 0) {
            gb_follow_member(&search, gb_q_of(all, k), *gb_free_of(all, k), (int)k);
        }
    }
}

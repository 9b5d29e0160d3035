/* Newton's method with damping and other safeguards near singular configurations: see newton.rs */

/* The least-squares step (J^T J + d |J^T J|)^-1 J^T f; false when it is singular, or when no steps are left. */
static bool gb_newton_step(const gb_problem *problem, const gb_real *q, gb_real damping, uint32_t held, gb_real *step)
{
    gb_triangle triangle;
    if (gb_are_spent(problem)) {
        return false;
    }
    gb_make_triangle(problem, q, damping, held, &triangle);
    return gb_substitute(&triangle, step);
}

/* q + factor delta, angles in (-pi, pi]. */
static void gb_shifted(const gb_mechanism *m, const gb_real *q, const gb_real *delta, gb_real factor, gb_real *next)
{
    for (size_t i = 0; i < m->joints; i++) {
        next[i] = gb_wrapped(m, i, q[i] + factor * delta[i]);
    }
}

/* The distance along `delta` from a root to a second one, if the equations are quadratic there. It is computed by a Newton step at the distance `ahead`. */
static bool gb_second_root(const gb_problem *problem, const gb_real *root, const gb_real *delta, gb_real ahead, gb_real *distance)
{
    gb_real start[GB_MAX_JOINTS], step[GB_MAX_JOINTS], along = R(0.0), square = R(0.0);
    gb_shifted(problem->mechanism, root, delta, ahead, start);
    if (!gb_newton_step(problem, start, R(0.0), 0, step)) {
        return false;
    }
    for (size_t i = 0; i < problem->mechanism->joints; i++) {
        along = along + step[i] * delta[i];
        square = square + delta[i] * delta[i];
    }
    const gb_real arrived = ahead - along / square;
    *distance = R(2.0) * ahead - ahead * ahead / arrived;
    return gb_is_finite(*distance);
}

/* Takes Newton steps until the relative residual is less than `relative`. Between two close roots the first step leads beyond one of them; each further one
 * divides the residual by four. */
static bool gb_return(const gb_problem *problem, gb_end *end, gb_real relative, uint32_t held)
{
    gb_real step[GB_MAX_JOINTS];
    for (int i = 0; i < GB_RETURNS; i++) {
        if (!gb_newton_step(problem, end->q, R(0.0), held, step)) {
            return false;
        }
        gb_stepped(problem->mechanism, end->q, step, end->q);
        end->fit = gb_measure(problem, end->q);
        if (end->fit.relative < relative) {
            return true;
        }
    }
    return false;
}

/* Takes damped steps until the relative residual is at most `enough`. */
static bool gb_come_back(const gb_problem *problem, gb_end *end, gb_real enough, uint32_t held)
{
    gb_real back[GB_MAX_JOINTS];
    for (int i = 0; i < GB_RETURNS && gb_newton_step(problem, end->q, GB_PIVOTS_REGULAR_STEPS, held, back); i++) {
        gb_stepped(problem->mechanism, end->q, back, end->q);
        end->fit = gb_measure(problem, end->q);
        if (end->fit.relative < enough) {
            return true;
        }
    }
    return false;
}

/* Takes a full or partial Newton step, then damped steps until the relative residual is at most `enough`. Next to a self-motion the residual changes little
 * along a curved path, but increases along each straight one. */
static bool gb_leap(const gb_problem *problem, const gb_real *q, gb_real enough, uint32_t held, gb_end *end)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real step[GB_MAX_JOINTS], delta[GB_MAX_JOINTS];
    if (!gb_newton_step(problem, q, R(0.0), held, step)) {
        return false;
    }
    const gb_real longest = gb_longest(m, step);
    if (!gb_is_finite(longest)) {
        return false;
    }
    for (size_t k = 0; k < GB_LENGTH_OF(gb_leaps); k++) {
        const gb_real share = gb_smaller(R(1.0), gb_leaps[k] / longest);
        for (size_t i = 0; i < m->joints; i++) {
            delta[i] = share * step[i];
        }
        gb_stepped(m, q, delta, end->q);
        if (gb_come_back(problem, end, enough, held)) {
            return true;
        }
    }
    return false;
}

/* The least damped step that lowers the relative residual. Where the residual exceeds rounding, the first choice is a step that halves it, then a leap, then
 * any decrease. Where it is within rounding, a short plain step is the last one. */
static bool gb_improve(const gb_problem *problem, gb_end *end, uint32_t held)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real relative = end->fit.relative;
    const bool leaps = gb_is_between(relative, GB_ACCEPTANCE_ROUNDING, GB_STRATA_NEAR);
    const gb_real enough = leaps ? R(0.5) * relative : relative, last = held == 0 ? GB_SELF_MOTIONS_MEMBER : GB_ACCEPTANCE_ROUNDING;
    bool has_fallen = false;
    gb_end fallen, next, other;
    gb_real step[GB_MAX_JOINTS];
    gb_triangle triangle;
    gb_slopes slopes;
    gb_find_slopes(problem, end->q, &slopes);
    for (size_t k = 0; k < GB_LENGTH_OF(gb_dampings); k++) {
        const bool is_plain = k == 0;
        gb_triangle_of(problem, &slopes, gb_dampings[k], held, &triangle);
        if (!gb_substitute(&triangle, step)) {
            continue;
        }
        gb_stepped(m, end->q, step, next.q);
        next.fit = gb_measure(problem, next.q);
        if (next.fit.relative < enough) {
            *end = next;
            return true;
        }
        if (is_plain && relative < GB_ACCEPTANCE_ROUNDING && gb_longest(m, step) <= GB_POLISHING_STEP) {
            return false;
        }
        if (is_plain && relative > last && gb_is_regular(&triangle)) {
            has_fallen = next.fit.relative < relative;
            *end = has_fallen ? next : *end;
            return has_fallen;
        }
        other = next;
        if (leaps && is_plain && held == 0 && next.fit.relative <= GB_OVERSHOT * relative && gb_return(problem, &other, relative, held)) {
            *end = other;
            return true;
        }
        if (next.fit.relative < relative && !has_fallen) {
            has_fallen = true;
            fallen = next;
        }
    }
    if (leaps && gb_leap(problem, end->q, enough, held, &next)) {
        *end = next;
        return true;
    }
    if (has_fallen) {
        *end = fallen;
    }
    return has_fallen;
}

/* Takes Newton steps from joint values with known residuals, damped where a plain step fails. A step is accepted only if the relative residual decreases, at
 * once or after a leap. Joints that are `held` do not move. */
static void gb_polish(const gb_problem *problem, gb_end *end, uint32_t held)
{
    int slow = 0;
    for (int i = 0; i < GB_POLISH_STEPS; i++) {
        const gb_end before = *end;
        gb_real step[GB_MAX_JOINTS];
        const bool is_done = before.fit.relative <= GB_POLISHING_DONE || slow == GB_PATIENCE || gb_are_spent(problem);
        if (is_done || !gb_improve(problem, end, held)) {
            return;
        }
        slow = end->fit.relative <= gb_larger(GB_ACCEPTANCE_ROUNDING, R(0.5) * before.fit.relative) ? 0 : slow + 1;
        for (size_t k = 0; k < problem->mechanism->joints; k++) {
            step[k] = end->q[k] - before.q[k];
        }
        if (end->fit.relative < GB_ACCEPTANCE_ROUNDING && gb_longest(problem->mechanism, step) <= GB_POLISHING_STEP) {
            return;
        }
    }
}

/* Same as gb_polish, from joint values that are not measured yet. */
static void gb_polish_from(const gb_problem *problem, gb_end *end, uint32_t held)
{
    end->fit = gb_measure(problem, end->q);
    gb_polish(problem, end, held);
}

/* Whether the equations hold within `bound` half-way between two close configurations, on a path that may be curved. */
static bool gb_are_joined(const gb_problem *problem, const gb_real *a, const gb_real *b, gb_real bound, uint32_t held)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real middle[GB_MAX_JOINTS], back[GB_MAX_JOINTS];
    if (gb_farthest(m, a, b) > GB_MERGING_BLUR) {
        return false;
    }
    gb_beyond(m, a, b, R(-0.5), middle);
    gb_fit fit = gb_measure(problem, middle);
    for (int i = 0; i < GB_RETURNS; i++) {
        if (fit.relative <= bound) {
            return true;
        }
        if (!gb_newton_step(problem, middle, GB_PIVOTS_REGULAR_STEPS, held, back)) {
            return false;
        }
        gb_stepped(m, middle, back, middle);
        fit = gb_measure(problem, middle);
    }
    return fit.relative <= bound;
}

/* The sum of the squared relative residuals. */
static gb_real gb_squares(const gb_problem *problem, const gb_real *q)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real at[GB_MAX_PLACES], values[GB_MAX_EQUATIONS], sizes[GB_MAX_SIZES], sum = R(0.0);
    gb_take_step(problem);
    gb_place(problem, q, at);
    m->values(problem->p, at, values);
    m->measures(problem->p, at, sizes);
    for (size_t i = 0; i < m->equations; i++) {
        const gb_real share = values[i] / gb_larger(GB_LEAST_POSITIVE, sizes[m->size_of[i]]);
        sum += share * share;
    }
    return sum;
}

/* Takes the least damped step that lowers the sum of squares, and returns its length; false where none does. */
static bool gb_fall(const gb_problem *problem, gb_real *q, gb_real *squares, uint32_t held, gb_real most, gb_real *longest)
{
    const gb_mechanism *m = problem->mechanism;
    gb_triangle triangle;
    gb_real step[GB_MAX_JOINTS], next[GB_MAX_JOINTS];
    for (size_t k = 0; k < GB_LENGTH_OF(gb_dampings); k++) {
        gb_make_shares(problem, q, gb_dampings[k], held, &triangle);
        if (!gb_substitute(&triangle, step)) {
            continue;
        }
        *longest = gb_longest(m, step);
        if (!(*longest <= most)) {
            continue;
        }
        gb_stepped(m, q, step, next);
        const gb_real fallen = gb_squares(problem, next);
        if (fallen < *squares) {
            gb_copy(q, next, m->joints);
            *squares = fallen;
            return true;
        }
    }
    return false;
}

/* Takes damped Gauss-Newton steps from `q` to the minimum of the sum of squared relative residuals. A step is accepted only if the sum decreases, and moves
 * each joint by at most `most` (rad, or relative to the length scale). Joints that are `held` do not move. */
GB_LINKAGE gb_fit gb_fitted(const gb_problem *problem, gb_real *q, uint32_t held, gb_real most)
{
    gb_real squares = gb_squares(problem, q), longest = INFINITY;
    for (int i = 0; i < GB_FITTING_STEPS && longest > GB_POLISHING_STEP; i++) {
        if (squares <= GB_POLISHING_DONE * GB_POLISHING_DONE || gb_are_spent(problem) || !gb_fall(problem, q, &squares, held, most, &longest)) {
            break;
        }
    }
    return gb_measure(problem, q);
}

/* Tasks with more conditions than joints, for a mechanism whose description has rounded numbers: see described.rs */

#ifdef GB_WITHIN

static int gb_conform(const gb_real *target, gb_real *conforming);
static int gb_walk_through(gb_sink_1 *c, const gb_real *target, gb_real *p, gb_solution *out, gb_pairs *pairs, enum gb_sought sought, size_t *steps);
GB_INLINE int gb_solve_ideal(const gb_real *target, gb_solution *out, size_t *steps);
GB_INLINE int gb_settle(size_t steps, gb_solution *out, size_t count);

/* The equations' values of the mechanism as described. */
static void gb_values_as_described(const gb_real *p, const gb_real *at, gb_real *values)
{
    gb_described_1(p, at, values);
}

static void gb_jacobian_as_described(const gb_real *p, const gb_real *at, gb_real *rows)
{
    gb_derive_affine(gb_described_1, p, at, rows);
}

/* The mechanism as described. */
static gb_mechanism gb_as_described(void)
{
    gb_mechanism mechanism = gb_this;
    mechanism.values = gb_values_as_described;
    mechanism.jacobian = gb_jacobian_as_described;
    return mechanism;
}

/* The target computed from the values that the equations compare. */
static void gb_read_off(const gb_real *tip, const gb_real *q, gb_real *target)
{
    static const gb_reached reached[GB_INPUTS] = {GB_REACHED};
    for (int i = 0; i < GB_INPUTS; i++) {
        const size_t first = reached[i].of[0], second = reached[i].of[1];
        target[i] = reached[i].kind == GB_AS_JOINT ? q[first] : reached[i].kind == GB_AS_VALUE ? tip[first] : gb_angle(tip[first], tip[second]);
    }
}

/* The target that the ideal mechanism reaches. */
static void gb_ideal_target(const gb_real *q, gb_real *target)
{
    const gb_problem problem = {&gb_this, NULL, NULL, NULL};
    gb_real at[GB_PLACES], tip[GB_EQUATIONS];
    gb_place(&problem, q, at);
    gb_tip_1(at, tip);
    gb_read_off(tip, q, target);
}

/* The parameters of that target; false where it is invalid. */
static bool gb_ideal_parameters(const gb_real *q, gb_real *p)
{
    gb_real target[GB_INPUTS], conforming[GB_INPUTS] = {0};
    gb_ideal_target(q, target);
    if (gb_conform(target, conforming) < 0) {
        return false;
    }
    gb_parameters_1(conforming, p);
    return true;
}

/* Residuals of joint values. */
static gb_fit gb_measure_of(const gb_problem *problem, const gb_real *q)
{
    gb_real at[GB_PLACES];
    gb_place(problem, q, at);
    return gb_measure_at(problem, at, q);
}

/* Moves q to where the ideal mechanism has a self-motion of the joints `free` and reaches the target within the tolerance. False where there is none. */
static bool gb_onto_self_motion(const gb_problem *problem, gb_real *q, uint32_t free)
{
    const gb_real within = gb_larger(GB_WITHIN, GB_ACCEPTANCE_RESIDUAL);
    gb_real p[GB_PARAMETERS];
    const gb_problem ideal = {&gb_this, p, NULL, problem->steps};
    if (!(gb_fitted(problem, q, free, R(0.5)).relative <= within) || !gb_free_joints(problem, q, free) || !gb_ideal_parameters(q, p)) {
        return false;
    }
    return gb_measure_of(problem, q).relative <= within && gb_is_on_self_motion(&ideal, q, free, GB_ACCEPTANCE_ROUNDING);
}

/* Moves a solution of the ideal mechanism to where the mechanism as described is nearest to the target. */
static void gb_fit_to(const gb_problem *problem, gb_solution *answer)
{
    const gb_fit fit = gb_fitted(problem, answer->q, answer->free, GB_MERGING_BLUR);
    answer->residual = fit.residual;
    answer->relative = fit.relative;
}

/* Adds further joint values with which the ideal mechanism reaches the target within the tolerance, and sorts all solutions of the target that q reaches.
 * Returns their number, or a code below zero. */
static int gb_add_others(const gb_real *target, const gb_real *q, gb_solution *out, size_t count, size_t *steps)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS], reached[GB_PARAMETERS];
    const gb_problem ideal = {&gb_this, reached, NULL, steps};
    c.known = count;
    c.moving = 0;
    for (size_t i = 0; i < count; i++) {
        c.moving |= out[i].free;
    }
    c.ideal = c.moving != 0 && gb_ideal_parameters(q, reached) ? &ideal : NULL;
    const int code = gb_walk_through(&c, target, p, out, NULL, GB_OTHERS, steps);
    if (code < 0) {
        return code;
    }
    for (size_t end = 1; end < c.all.count; end++) {
        for (size_t i = end; i > 0 && out[i - 1].branch > out[i].branch; i--) {
            const gb_solution other = out[i];
            out[i] = out[i - 1];
            out[i - 1] = other;
        }
    }
    return (int)c.all.count;
}

/* Whether a solution differs from all those before. */
static bool gb_is_new(const gb_solution *before, size_t count, const gb_solution *answer)
{
    for (size_t i = 0; i < count; i++) {
        if (gb_are_within(before[i].q, answer->q, before[i].free | answer->free, GB_MERGING_JOINTS)) {
            return false;
        }
    }
    return true;
}

/* Moves all solutions to where the described mechanism is nearest to the target, keeps those that are distinct and returns their number. A solution that
 * would coincide with another one is not moved: the ideal mechanism distinguishes them. */
static size_t gb_fit_all(const gb_problem *problem, gb_solution *out, size_t count)
{
    size_t kept = 0;
    for (size_t k = 0; k < count; k++) {
        gb_solution answer = out[k];
        gb_fit_to(problem, &answer);
        if (!gb_is_new(out, kept, &answer)) {
            answer = out[k];
            const gb_fit fit = gb_measure_of(problem, answer.q);
            answer.residual = fit.residual;
            answer.relative = fit.relative;
        }
        if (gb_is_new(out, kept, &answer)) {
            out[kept++] = answer;
        }
    }
    return kept;
}

/* All solutions of a target, or a code below zero. If there is none, `nearest` has the joint values with which the mechanism is nearest to it. */
static GB_APART int gb_solve_described(const gb_real *target, gb_solution *out, gb_solution *nearest, size_t *steps)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS], same[GB_PARAMETERS], q[GB_JOINTS], ideal[GB_INPUTS];
    const gb_mechanism mechanism = gb_as_described();
    const gb_problem problem = {&mechanism, p, NULL, steps};
    int code = gb_walk_through(&c, target, p, NULL, NULL, GB_CLOSEST, steps);
    if (code < 0 || !c.all.has_nearest) {
        return code;
    }
    memcpy(q, c.all.nearest, sizeof q);
    if (!(c.all.nearest_fit.relative <= gb_larger(GB_WITHIN, GB_ACCEPTANCE_RESIDUAL))) {
        if (nearest) {
            memcpy(nearest->q, q, sizeof q);
            gb_fit_to(&problem, nearest);
        }
        return gb_settle(*steps, out, 0);
    }
    if (c.free != 0) {
        code = gb_walk_through(&c, target, same, NULL, NULL, GB_MEMBER, steps);
        if (code < 0) {
            return code;
        }
        if (c.all.has_nearest) {
            memcpy(q, c.all.nearest, sizeof q);
        }
    }
    gb_ideal_target(q, ideal);
    const int found = gb_solve_ideal(ideal, out, steps), count = found < 0 ? found : gb_add_others(target, q, out, (size_t)found, steps);
    return count < 0 ? count : gb_settle(*steps, out, gb_fit_all(&problem, out, (size_t)count));
}

/* Moves a solution of a target of the ideal mechanism within limits; false where that is impossible. */
static bool gb_keep_one_within(const gb_real *p, const gb_real *limits, gb_solution *answer, size_t *steps)
{
    gb_answers all;
    memset(&all, 0, sizeof all);
    all.problem.mechanism = &gb_this;
    all.problem.p = p;
    all.problem.steps = steps;
    all.out = answer;
    all.count = 1;
    return gb_keep_within(&all, limits) == 1;
}

/* Moves a solution within limits, members of a self-motion along that of the ideal mechanism; false where that is impossible. */
static bool gb_bring_within(const gb_real *p, const gb_real *limits, gb_solution *answer)
{
    gb_real ideal[GB_PARAMETERS];
    const gb_mechanism mechanism = gb_as_described();
    size_t steps = gb_steps_at_most(GB_MOST_STEPS);
    const gb_problem problem = {&mechanism, p, NULL, &steps}, own = {&gb_this, p, NULL, &steps};
    const uint32_t free = answer->free;
    answer->free = 0;
    bool is_within = gb_keep_one_within(p, limits, answer, &steps);
    answer->free = free;
    if (!is_within && free != 0 && gb_onto_self_motion(&own, answer->q, free) && gb_ideal_parameters(answer->q, ideal)) {
        is_within = gb_keep_one_within(ideal, limits, answer, &steps);
    }
    answer->residual = gb_measure_of(&problem, answer->q).residual;
    return is_within;
}

/* Moves the solutions that can be brought within limits to the front. Returns their number. */
static int gb_bring_all_within(const gb_real *p, const gb_real *limits, gb_solution *out, int count)
{
    int kept = 0;
    for (int k = 0; k < count; k++) {
        gb_solution answer = out[k];
        if (gb_bring_within(p, limits, &answer)) {
            out[k] = out[kept];
            out[kept++] = answer;
        }
    }
    return kept;
}

/* Searches along the self-motions of the ideal mechanism for the solution nearest to a reference. The result is then moved to where the mechanism as described
 * is nearest to the target. */
static void gb_search_ideal(const gb_real *p, const gb_solution *list, int count, const gb_real *const *aim, gb_nearest_end *best)
{
    gb_real ideal[GB_PARAMETERS], q[GB_MAX_JOINTS];
    const gb_mechanism mechanism = gb_as_described();
    size_t steps = gb_steps_at_most(GB_MOST_STEPS);
    const gb_problem described = {&mechanism, p, NULL, &steps}, own = {&gb_this, p, NULL, &steps}, problem = {&gb_this, ideal, NULL, &steps};
    for (int k = 0; k < count; k++) {
        memcpy(q, list[k].q, sizeof list[k].q);
        if (list[k].free == 0 || !gb_onto_self_motion(&own, q, list[k].free) || !gb_ideal_parameters(q, ideal)) {
            continue;
        }
        best->follows = k;
        gb_search_along(&problem, q, list[k].free, aim, best);
        if (best->is_found && best->member == k) {
            for (int i = 0; i < GB_JOINTS; i++) {
                q[i] = gb_joints[i].is_angle ? gb_wrap(best->q[i]) : best->q[i];
            }
            const gb_fit fit = gb_fitted(&described, q, list[k].free, GB_MERGING_BLUR);
            gb_move_nearest(&gb_this, q, &fit, aim, best);
        }
    }
}
#endif

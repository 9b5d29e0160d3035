/* Tasks that ask for more than the joints can do, of a mechanism that a description tells in rounded numbers: described.rs */

#ifdef GB_WITHIN

static int gb_conform(const gb_real *target, gb_real *conforming);
static int gb_walk_through(gb_sink_1 *c, const gb_real *target, gb_real *p, gb_solution *out, gb_pairs *pairs, enum gb_sought sought);
GB_INLINE int gb_solve_ideal(const gb_real *target, gb_solution *out);

/* The equations' values, as described. */
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

/* The target that is read off what the equations compare. */
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
    const gb_problem problem = {&gb_this, NULL, NULL};
    gb_real at[GB_PLACES], tip[GB_EQUATIONS];
    gb_place(&problem, q, at);
    gb_tip_1(at, tip);
    gb_read_off(tip, q, target);
}

/* Brings an answer of the ideal mechanism to where the described one is nearest to the target. */
static void gb_fit_to(const gb_problem *problem, gb_solution *answer)
{
    const gb_fit fit = gb_fitted(problem, answer->q, answer->free, GB_BLUR);
    answer->residual = fit.residual;
    answer->relative = fit.relative;
}

/* Adds those beside answers that come within the tolerance of the target, too, and puts all in order; their number, or a code below zero. */
static int gb_add_others(const gb_real *target, gb_solution *out, size_t count)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    c.known = count;
    const int code = gb_walk_through(&c, target, p, out, NULL, GB_OTHERS);
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

/* Keeps the first of answers that have become one; their number. */
static size_t gb_keep_distinct(gb_solution *out, size_t count)
{
    size_t kept = 0;
    for (size_t k = 0; k < count; k++) {
        bool is_new = true;
        for (size_t i = 0; i < kept; i++) {
            is_new = is_new && !gb_are_within(out[i].q, out[k].q, out[i].free | out[k].free, GB_MERGE);
        }
        if (is_new) {
            const gb_solution other = out[kept];
            out[kept++] = out[k];
            out[k] = other;
        }
    }
    return kept;
}

/* All answers to a target, or a code below zero; where there is none, where the mechanism comes nearest to it. */
static GB_APART int gb_solve_described(const gb_real *target, gb_solution *out, gb_solution *nearest)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS], ideal[GB_INPUTS];
    const gb_mechanism mechanism = gb_as_described();
    const gb_problem problem = {&mechanism, p, NULL};
    const int code = gb_walk_through(&c, target, p, NULL, NULL, GB_CLOSEST);
    if (code < 0 || !c.all.has_nearest) {
        return code;
    }
    if (!(c.all.nearest_fit.relative <= gb_larger(GB_WITHIN, GB_ACCEPT))) {
        if (nearest) {
            memcpy(nearest->q, c.all.nearest, sizeof nearest->q);
            gb_fit_to(&problem, nearest);
        }
        return 0;
    }
    gb_ideal_target(c.all.nearest, ideal);
    const int found = gb_solve_ideal(ideal, out), count = found < 0 ? found : gb_add_others(target, out, (size_t)found);
    for (int i = 0; i < count; i++) {
        gb_fit_to(&problem, &out[i]);
    }
    return count < 0 ? count : (int)gb_keep_distinct(out, (size_t)count);
}

/* Moves an answer within limits, members of a self-motion along that of the ideal mechanism; false where that cannot be. */
static bool gb_bring_within(const gb_real *p, const gb_real *limits, gb_solution *answer)
{
    gb_real target[GB_INPUTS], conforming[GB_INPUTS] = {0}, ideal[GB_PARAMETERS], at[GB_PLACES];
    const gb_mechanism mechanism = gb_as_described();
    const gb_problem problem = {&mechanism, p, NULL};
    gb_answers all;
    memset(&all, 0, sizeof all);
    gb_ideal_target(answer->q, target);
    if (gb_conform(target, conforming) < 0) {
        return false;
    }
    gb_parameters_1(conforming, ideal);
    all.problem.mechanism = &gb_this;
    all.problem.p = ideal;
    all.out = answer;
    all.count = 1;
    if (gb_keep_within(&all, limits) == 0) {
        return false;
    }
    gb_place(&problem, answer->q, at);
    answer->residual = gb_measure_at(&problem, at, answer->q).residual;
    return true;
}

/* The answers that can be brought within limits, to the front. */
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
#endif

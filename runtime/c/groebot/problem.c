/* The equations at one target: see problem.rs */

/* The numbers that the equations read of joint values. */
GB_LINKAGE void gb_place(const gb_problem *problem, const gb_real *q, gb_real *at)
{
    const gb_mechanism *m = problem->mechanism;
    for (size_t i = 0; i < m->places; i++) {
        at[i] = problem->extras ? problem->extras[i] : R(0.0);
    }
    for (size_t i = 0; i < m->joints; i++) {
        const gb_joint joint = m->joint[i];
        if (joint.is_angle) {
            gb_cosine_and_sine(q[i], &at[joint.places[0]], &at[joint.places[1]]);
        } else {
            at[joint.places[0]] = q[i];
        }
    }
}

/* Uses one step of the target. */
static void gb_take_step(const gb_problem *problem)
{
    *problem->steps -= *problem->steps > 0;
}

/* Whether no steps are left: candidates that have not been polished are then kept unchanged. */
static bool gb_are_spent(const gb_problem *problem)
{
    return *problem->steps == 0;
}

/* The residuals of joint values whose cosines and sines are `at`. */
GB_LINKAGE gb_fit gb_measure_at(const gb_problem *problem, const gb_real *at, const gb_real *q)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real values[GB_MAX_EQUATIONS], sizes[GB_MAX_SIZES], largest[GB_MAX_SIZES] = {R(0.0)};
    gb_fit fit = {R(0.0), R(0.0), true};
    gb_take_step(problem);
    m->values(problem->p, at, values);
    m->measures(problem->p, at, sizes);
    for (size_t i = 0; i < m->joints; i++) {
        fit.accepted = fit.accepted && gb_is_finite(q[i]);
    }
    for (size_t i = 0; i < m->equations; i++) {
        const size_t size = m->size_of[i];
        const gb_real value = gb_magnitude(values[i]);
        largest[size] = gb_larger(largest[size], value);
        fit.accepted = fit.accepted && value <= GB_ACCEPTANCE_RESIDUAL * sizes[size];
    }
    for (size_t i = 0; i < m->sizes; i++) {
        fit.residual = gb_larger(fit.residual, largest[i]);
        fit.relative = gb_larger(fit.relative, largest[i] / gb_larger(GB_LEAST_POSITIVE, sizes[i]));
    }
    fit.accepted = fit.accepted && gb_is_finite(fit.residual);
    return fit;
}

/* Residuals of joint values. */
static gb_fit gb_measure(const gb_problem *problem, const gb_real *q)
{
    gb_real at[GB_MAX_PLACES];
    gb_place(problem, q, at);
    return gb_measure_at(problem, at, q);
}

/* The influence of each joint on the equations: the greatest derivative relative to its equation's size, at most one. It is one for a length. */
static void gb_weights(const gb_problem *problem, const gb_real *q, gb_real *weights)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real at[GB_MAX_PLACES], sizes[GB_MAX_SIZES], rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS];
    gb_place(problem, q, at);
    m->jacobian(problem->p, at, rows);
    m->measures(problem->p, at, sizes);
    for (size_t i = 0; i < m->joints; i++) {
        gb_real greatest = m->joint[i].is_angle ? R(0.0) : R(1.0);
        for (size_t k = 0; m->joint[i].is_angle && k < m->equations; k++) {
            greatest = gb_larger(greatest, gb_magnitude(rows[k * m->joints + i]) / gb_larger(GB_LEAST_POSITIVE, sizes[m->size_of[k]]));
        }
        weights[i] = gb_smaller(R(1.0), greatest);
    }
}

/* Description of a robot for groebot.c */

#if GB_LANES > 1
#define GB_STEP 2
#define GB_PAIR(name) GB_JOIN(gb_##name##_, 2, GB_OF_PART)
#else
#define GB_STEP 1
#define GB_PAIR(name) GB_JOIN(gb_##name##_, 1, GB_OF_PART)
#endif

#ifdef GB_FREED
static const unsigned char gb_freed[] = {GB_FREED};
#endif

static void gb_values_of(const gb_real *p, const gb_real *at, gb_real *values)
{
    gb_values_1(p, at, values);
}

static void gb_sizes_of(const gb_real *p, const gb_real *at, gb_real *sizes)
{
    gb_sizes_1(p, at, sizes);
}

#if !defined(GB_JACOBIAN) || defined(GB_WITHIN)
/* The derivative of each equation by each joint, for equations that are affine in the numbers of each joint. It is their values at the numbers' derivatives
 * minus their values at zeros. */
GB_INLINE void gb_derive_affine(void (*values)(const gb_real *, const gb_real *, gb_real *), const gb_real *p, const gb_real *at, gb_real *rows)
{
    for (int j = 0; j < GB_JOINTS; j++) {
        const gb_joint joint = gb_joints[j];
        gb_real moved[GB_PLACES], along[GB_EQUATIONS], without[GB_EQUATIONS];
        memcpy(moved, at, sizeof moved);
        for (int i = 0; i < 2; i++) {
            moved[joint.places[i]] = R(0.0);
        }
        values(p, moved, without);
        moved[joint.places[0]] = joint.is_angle ? -at[joint.places[1]] : R(1.0);
        moved[joint.places[1]] = joint.is_angle ? at[joint.places[0]] : R(1.0);
        values(p, moved, along);
        for (int i = 0; i < GB_EQUATIONS; i++) {
            rows[i * GB_JOINTS + j] = along[i] - without[i];
        }
    }
}
#endif

#ifndef GB_JACOBIAN
static void gb_jacobian(const gb_real *p, const gb_real *at, gb_real *rows)
{
    gb_derive_affine(gb_values_1, p, at, rows);
}
#endif

#ifdef GB_SHORTS
/* Subtracts a step from q and updates the cosines and sines; false where a pair is far from the unit circle. */
static bool gb_step_back(const gb_real *step, gb_real *at, gb_real *q)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        gb_real *first = &at[gb_joints[i].places[0]], *second = &at[gb_joints[i].places[1]];
        q[i] = q[i] - step[i];
        if (!gb_joints[i].is_angle) {
            *first = q[i];
            continue;
        }
        q[i] = gb_magnitude(q[i]) < GB_PI ? q[i] : gb_wrap(q[i]);
        const gb_real norm = gb_turn_back_1(step[i], first, second);
        if (!(gb_magnitude(norm - R(1.0)) <= GB_TURN)) {
            return false;
        }
        if (gb_magnitude(step[i]) > GB_TURN) {
            gb_cosine_and_sine(q[i], first, second);
        }
    }
    return true;
}

/* The end of plain Newton steps by the normal equations from q. False unless the equations hold there within rounding and are regular at each step. */
static bool gb_approach_from(const gb_problem *problem, const gb_real *from, const gb_real *q, gb_approach *approach)
{
    gb_real at[GB_PLACES], step[GB_JOINTS] = {0};
    memcpy(at, from, sizeof at);
    memcpy(approach->end, q, sizeof step);
    if (!gb_step_back(step, at, approach->end)) {
        return false;
    }
    for (int round = 0; round < GB_APPROACHES; round++) {
        gb_normal_1 normal;
        gb_real missed, sound = R(1.0);
        gb_first_step_1(problem->p, at, step, &normal, &missed, &sound);
        if (round == 0) {
            approach->missed = missed;
            approach->pivot = normal.pivot;
            approach->is_doubled = true;
        }
        if (!(sound > R(0.0))) {
            return false;
        }
        for (int second = 0; second < 2; second++) {
            if (second) {
                gb_second_step_1(problem->p, at, step, &normal);
            }
            if (!gb_step_back(step, at, approach->end)) {
                return false;
            }
            if (!second && missed > GB_CHORD) {
                continue;
            }
            approach->fit = gb_measure_at(problem, at, approach->end);
            if (approach->fit.relative < GB_ACCEPTANCE_ROUNDING) {
                return approach->fit.accepted;
            }
        }
    }
    return false;
}
#endif

static const gb_mechanism gb_this = {
    GB_JOINTS,
    GB_PLACES,
    GB_EQUATIONS,
    GB_SIZES,
    GB_CAPACITY,
    gb_joints,
    gb_last_first,
    gb_size_of,
#ifdef GB_FREED
    gb_freed,
    sizeof gb_freed,
#else
    NULL,
    0,
#endif
    GB_SCALE,
    GB_ISOLATED,
    GB_EXTRAS,
#ifdef GB_SHORTS
    true,
#else
    false,
#endif
    GB_PREFERRED,
    GB_PREFERS_GREATEST,
    sizeof(gb_solution),
    offsetof(gb_solution, residual),
    offsetof(gb_solution, relative),
    offsetof(gb_solution, branch),
    offsetof(gb_solution, chosen),
    offsetof(gb_solution, free),
    gb_values_of,
    gb_sizes_of,
    gb_jacobian,
#ifdef GB_SHORTS
    gb_approach_from,
#else
    NULL,
#endif
};

/* By candidate: its residuals, and whether it is valid: 1, else 0. */
typedef struct {
    gb_real residual[GB_CANDIDATES];
    gb_real relative[GB_CANDIDATES];
    gb_real sound[GB_CANDIDATES];
} gb_fits;

/* The parameters repeated in all lanes. */
GB_INLINE void gb_everywhere(const gb_real *p, GB_PAIR(number) *all)
{
    for (int i = 0; i < GB_PARAMETERS; i++) {
        all[i] = GB_PAIR(of)(p[i]);
    }
}

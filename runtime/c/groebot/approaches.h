/* Newton steps of several candidates side by side: see approach.rs */

/* By candidate, the result of its Newton steps: their sum, the residuals at the end, and the relative residual and least pivot at the candidate. The last
 * field of these is 1 where the equations are regular and the steps short, else 0. */
typedef struct {
    gb_real steps[GB_JOINTS][GB_CANDIDATES];
    gb_real residual[GB_CANDIDATES];
    gb_real relative[GB_CANDIDATES];
    gb_real missed[GB_CANDIDATES];
    gb_real pivot[GB_CANDIDATES];
    gb_real sound[GB_CANDIDATES];
    /* Where a second solution may be near: 1, else 0. */
    gb_real doubled[GB_CANDIDATES];
    /* The cosines and sines at the ends. */
    gb_real at[GB_PLACES][GB_CANDIDATES];
} gb_approaches;

/* The state of candidates side by side, and whether each is finished: it has converged or has failed. */
typedef struct {
    GB_PAIR(number) at[GB_PLACES], steps[GB_JOINTS], sound, residual, relative;
    bool are_done[GB_STEP];
} gb_walker;

/* Writes the result of one of several candidates. */
GB_INLINE void gb_write_one(gb_approaches *approaches, const gb_walker *walker, size_t first, size_t lane)
{
    gb_real numbers[GB_STEP];
    for (int i = 0; i < GB_JOINTS; i++) {
        GB_PAIR(store)(numbers, walker->steps[i]);
        approaches->steps[i][first + lane] = numbers[lane];
    }
    for (int i = 0; i < GB_PLACES; i++) {
        GB_PAIR(store)(numbers, walker->at[i]);
        approaches->at[i][first + lane] = numbers[lane];
    }
    GB_PAIR(store)(numbers, walker->residual);
    approaches->residual[first + lane] = numbers[lane];
    GB_PAIR(store)(numbers, walker->relative);
    approaches->relative[first + lane] = numbers[lane];
    GB_PAIR(store)(numbers, walker->sound);
    approaches->sound[first + lane] = numbers[lane];
}

/* Writes the results of the given candidates that were not finished before, and returns whether all are finished. */
GB_INLINE bool gb_write_approaches(gb_approaches *approaches, const GB_PAIR(number) *p, gb_walker *walker, size_t first, const bool *these)
{
    bool are_done = true, is_any = false;
    for (size_t lane = 0; lane < GB_STEP; lane++) {
        is_any |= these[lane] && !walker->are_done[lane];
    }
    if (is_any) {
        GB_PAIR(fit)(p, walker->at, &walker->residual, &walker->relative);
    }
    for (size_t lane = 0; lane < GB_STEP; lane++) {
        if (these[lane] && !walker->are_done[lane]) {
            gb_write_one(approaches, walker, first, lane);
            walker->are_done[lane] = !(approaches->sound[first + lane] > R(0.0)) || approaches->relative[first + lane] < GB_ACCEPTANCE_ROUNDING;
        }
        are_done &= walker->are_done[lane];
    }
    return are_done;
}

GB_INLINE void gb_step_walker(gb_walker *walker, const GB_PAIR(number) *step)
{
    GB_PAIR(step_back)(step, walker->at, &walker->sound);
    for (int i = 0; i < GB_JOINTS; i++) {
        walker->steps[i] = walker->steps[i] + step[i];
    }
}

/* Takes a step of candidates side by side, then a second one with equal derivatives. The end of the first step is measured where the residual is small.
 * Returns whether all are finished. */
GB_INLINE bool gb_step_approaches(gb_approaches *approaches, const GB_PAIR(number) *p, gb_walker *walker, size_t first, bool is_first)
{
    GB_PAIR(number) step[GB_JOINTS], missed;
    GB_PAIR(normal) normal;
    gb_real numbers[GB_STEP];
    bool are_near[GB_STEP], are_all[GB_STEP];
    GB_PAIR(first_step)(p, walker->at, step, &normal, &missed, &walker->sound);
    if (is_first) {
        GB_PAIR(store)(&approaches->missed[first], missed);
        GB_PAIR(store)(&approaches->pivot[first], normal.pivot);
    }
    GB_PAIR(store)(numbers, missed);
    for (size_t lane = 0; lane < GB_STEP; lane++) {
        are_near[lane] = numbers[lane] <= GB_CHORD;
        are_all[lane] = true;
    }
    gb_step_walker(walker, step);
    if (gb_write_approaches(approaches, p, walker, first, are_near)) {
        return true;
    }
    GB_PAIR(second_step)(p, walker->at, step, &normal);
    gb_step_walker(walker, step);
    return gb_write_approaches(approaches, p, walker, first, are_all);
}

/* Whether the equations at a candidate are so ill-conditioned that a second solution may be near. */
GB_INLINE bool gb_is_steep(const gb_sink_1 *c, size_t k, gb_real pivot, gb_real missed)
{
    return pivot < missed * (c->found[k].close ? GB_STEEP : GB_MILD);
}

/* Finds where a second solution may be near the ends of the steps. */
GB_INLINE void gb_find_doubled(const gb_sink_1 *c, gb_approaches *approaches, const GB_PAIR(number) *p, size_t first)
{
    GB_PAIR(number) at[GB_PLACES];
    bool is_any = false;
    for (size_t k = first; k < first + GB_STEP && k < c->waiting; k++) {
        is_any |= gb_is_steep(c, k, approaches->pivot[k], approaches->missed[k]);
    }
    if (!is_any) {
        return;
    }
    for (int i = 0; i < GB_PLACES; i++) {
        at[i] = GB_PAIR(load)(&approaches->at[i][first]);
    }
    GB_PAIR(store)(&approaches->doubled[first], GB_PAIR(is_doubled)(p, at, GB_PAIR(load)(&approaches->missed[first])));
}

/* Initialises candidates side by side. */
GB_INLINE void gb_start_approaches(const gb_sink_1 *c, gb_walker *walker, size_t first)
{
    for (int i = 0; i < GB_PLACES; i++) {
        walker->at[i] = GB_PAIR(load)(&c->at[i][first]);
    }
    for (int i = 0; i < GB_JOINTS; i++) {
        walker->steps[i] = GB_PAIR(of)(R(0.0));
    }
    walker->sound = GB_PAIR(of)(R(1.0));
    for (size_t lane = 0; lane < GB_STEP; lane++) {
        walker->are_done[lane] = first + lane >= c->waiting;
    }
    GB_PAIR(step_back)(walker->steps, walker->at, &walker->sound);
}

/* Takes the Newton steps of the waiting candidates. The result of one does not depend on the others. */
static GB_APART void gb_find_approaches(const gb_sink_1 *c, gb_approaches *approaches)
{
    GB_PAIR(number) p[GB_PARAMETERS];
    gb_everywhere(c->all.problem.p, p);
    for (size_t first = 0; first < c->waiting; first += GB_STEP) {
        gb_walker walker;
        gb_start_approaches(c, &walker, first);
        for (int round = 0; round < GB_APPROACHES; round++) {
            if (gb_step_approaches(approaches, p, &walker, first, round == 0)) {
                break;
            }
        }
        gb_find_doubled(c, approaches, p, first);
    }
}

/* The end of the Newton steps of a candidate that begins at q. */
static void gb_follow(const gb_approaches *approaches, size_t k, const gb_real *q, gb_approach *approach)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real value = q[i] - approaches->steps[i][k];
        approach->end[i] = !gb_joints[i].is_angle || gb_magnitude(value) < GB_PI ? value : gb_wrap(value);
    }
    approach->fit.residual = approaches->residual[k];
    approach->fit.relative = approaches->relative[k];
    approach->fit.accepted = true;
    approach->missed = approaches->missed[k];
    approach->pivot = approaches->pivot[k];
    approach->is_doubled = approaches->doubled[k] > R(0.0);
}

/* Moves a candidate by its Newton steps; false where it must be refined. */
static bool gb_lead(gb_sink_1 *c, const gb_approaches *approaches, size_t k, const gb_real *q, gb_approach *approach)
{
    if (c->found[k].free != 0) {
        return false;
    }
    if (approaches->sound[k] > R(0.0) && approaches->relative[k] < GB_ACCEPTANCE_ROUNDING) {
        gb_follow(approaches, k, q, approach);
        return true;
    }
    gb_real at[GB_PLACES];
    for (int i = 0; i < GB_PLACES; i++) {
        at[i] = c->at[i][k];
    }
    return gb_approach_from(&c->all.problem, at, q, approach);
}

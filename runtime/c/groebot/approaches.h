/* Newton steps of several candidates side by side: see approach.rs */

/* By candidate, the result of its Newton steps: their sum, the residuals at the end, and the relative residual and least pivot at the candidate. The last
 * field is 1 where the equations are regular and the steps short, else 0. */
typedef struct {
    gb_real steps[GB_JOINTS][GB_CANDIDATES];
    gb_real residual[GB_CANDIDATES];
    gb_real relative[GB_CANDIDATES];
    gb_real missed[GB_CANDIDATES];
    gb_real pivot[GB_CANDIDATES];
    gb_real sound[GB_CANDIDATES];
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
    GB_PAIR(store)(numbers, walker->residual);
    approaches->residual[first + lane] = numbers[lane];
    GB_PAIR(store)(numbers, walker->relative);
    approaches->relative[first + lane] = numbers[lane];
    GB_PAIR(store)(numbers, walker->sound);
    approaches->sound[first + lane] = numbers[lane];
}

/* Writes the results of the candidates that were not finished before, and returns whether all are finished. */
GB_INLINE bool gb_write_approaches(gb_approaches *approaches, const GB_PAIR(number) *p, gb_walker *walker, size_t first)
{
    bool are_done = true;
    GB_PAIR(fit)(p, walker->at, &walker->residual, &walker->relative);
    for (size_t lane = 0; lane < GB_STEP; lane++) {
        if (!walker->are_done[lane]) {
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

/* Takes a step of candidates side by side. If that is not enough and the first of all candidates has a small residual, takes a second one with equal
 * derivatives. Returns whether all are finished. */
GB_INLINE bool gb_step_approaches(gb_approaches *approaches, const GB_PAIR(number) *p, gb_walker *walker, size_t first, bool is_first)
{
    GB_PAIR(number) step[GB_JOINTS], missed;
    GB_PAIR(normal) normal;
    GB_PAIR(first_step)(p, walker->at, step, &normal, &missed, &walker->sound);
    if (is_first) {
        GB_PAIR(store)(&approaches->missed[first], missed);
        GB_PAIR(store)(&approaches->pivot[first], normal.pivot);
    }
    gb_step_walker(walker, step);
    if (gb_write_approaches(approaches, p, walker, first)) {
        return true;
    }
    if (approaches->missed[0] > GB_POLISHING_CHORD) {
        return false;
    }
    GB_PAIR(second_step)(p, walker->at, step, &normal);
    gb_step_walker(walker, step);
    return gb_write_approaches(approaches, p, walker, first);
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

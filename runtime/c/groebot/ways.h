/* The short ways of candidates next to each other: as approach.rs */

/* By candidate, the short ways: the sums of their steps, how well the equations hold behind them, what they were missed by and the least pivot before, and
 * whether the equations are regular and near: 1, else 0. */
typedef struct {
    gb_real steps[GB_JOINTS][GB_CANDIDATES];
    gb_real residual[GB_CANDIDATES];
    gb_real relative[GB_CANDIDATES];
    gb_real missed[GB_CANDIDATES];
    gb_real pivot[GB_CANDIDATES];
    gb_real sound[GB_CANDIDATES];
} gb_ways;

/* What candidates next to each other have come to, and whether each need not go on: it has arrived, or cannot. */
typedef struct {
    GB_PAIR(number) at[GB_PLACES], steps[GB_JOINTS], sound, residual, relative;
    bool are_done[GB_STEP];
} gb_walker;

/* Writes what one of candidates next to each other has come to. */
GB_INLINE void gb_write_one(gb_ways *ways, const gb_walker *walker, size_t first, size_t lane)
{
    gb_real numbers[GB_STEP];
    for (int i = 0; i < GB_JOINTS; i++) {
        GB_PAIR(store)(numbers, walker->steps[i]);
        ways->steps[i][first + lane] = numbers[lane];
    }
    GB_PAIR(store)(numbers, walker->residual);
    ways->residual[first + lane] = numbers[lane];
    GB_PAIR(store)(numbers, walker->relative);
    ways->relative[first + lane] = numbers[lane];
    GB_PAIR(store)(numbers, walker->sound);
    ways->sound[first + lane] = numbers[lane];
}

/* Writes what the candidates that were not done before have come to; whether all are done. */
GB_INLINE bool gb_write_ways(gb_ways *ways, const GB_PAIR(number) *p, gb_walker *walker, size_t first)
{
    bool are_done = true;
    GB_PAIR(fit)(p, walker->at, &walker->residual, &walker->relative);
    for (size_t lane = 0; lane < GB_STEP; lane++) {
        if (!walker->are_done[lane]) {
            gb_write_one(ways, walker, first, lane);
            walker->are_done[lane] = !(ways->sound[first + lane] > R(0.0)) || ways->relative[first + lane] < GB_ROUNDING;
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

/* A step of candidates next to each other, and where that is not enough another one by the same derivatives, if the first of all candidates misses little;
 * whether all are done. */
GB_INLINE bool gb_step_ways(gb_ways *ways, const GB_PAIR(number) *p, gb_walker *walker, size_t first, bool is_first)
{
    GB_PAIR(number) step[GB_JOINTS], missed;
    GB_PAIR(normal) normal;
    GB_PAIR(first_step)(p, walker->at, step, &normal, &missed, &walker->sound);
    if (is_first) {
        GB_PAIR(store)(&ways->missed[first], missed);
        GB_PAIR(store)(&ways->pivot[first], normal.pivot);
    }
    gb_step_walker(walker, step);
    if (gb_write_ways(ways, p, walker, first)) {
        return true;
    }
    if (ways->missed[0] > GB_CHORD) {
        return false;
    }
    GB_PAIR(second_step)(p, walker->at, step, &normal);
    gb_step_walker(walker, step);
    return gb_write_ways(ways, p, walker, first);
}

/* Where candidates next to each other start. */
GB_INLINE void gb_start_ways(const gb_sink_1 *c, gb_walker *walker, size_t first)
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

/* The short ways of the candidates that wait. What one of them comes to does not depend on those next to it. */
static GB_APART void gb_find_ways(const gb_sink_1 *c, gb_ways *ways)
{
    GB_PAIR(number) p[GB_PARAMETERS];
    gb_everywhere(c->all.problem.p, p);
    for (size_t first = 0; first < c->waiting; first += GB_STEP) {
        gb_walker walker;
        gb_start_ways(c, &walker, first);
        for (int round = 0; round < GB_APPROACHES; round++) {
            if (gb_step_ways(ways, p, &walker, first, round == 0)) {
                break;
            }
        }
    }
}

/* Where the short way of a candidate has led from q. */
static void gb_follow(const gb_ways *ways, size_t k, const gb_real *q, gb_approach *approach)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real value = q[i] - ways->steps[i][k];
        approach->end[i] = !gb_joints[i].is_angle || gb_magnitude(value) < GB_PI ? value : gb_wrap(value);
    }
    approach->fit.residual = ways->residual[k];
    approach->fit.relative = ways->relative[k];
    approach->fit.accepted = true;
    approach->missed = ways->missed[k];
    approach->pivot = ways->pivot[k];
}

/* Where a candidate is led; false where it must be refined. */
static bool gb_lead(gb_sink_1 *c, const gb_ways *ways, size_t k, const gb_real *q, gb_approach *approach)
{
    if (c->found[k].free != 0) {
        return false;
    }
    if (ways->sound[k] > R(0.0) && ways->relative[k] < GB_ROUNDING) {
        gb_follow(ways, k, q, approach);
        return true;
    }
    gb_real at[GB_PLACES];
    for (int i = 0; i < GB_PLACES; i++) {
        at[i] = c->at[i][k];
    }
    return gb_approach_from(&c->all.problem, at, q, approach);
}

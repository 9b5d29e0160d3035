/* From candidates to solutions: see answers.rs */

/* Whether the waiting candidates are those of an ordinary target. */
GB_INLINE bool gb_are_ordinary(const gb_sink_1 *c)
{
    return c->is_ordinary && c->waiting == GB_CANDIDATES && c->all.candidates == GB_CANDIDATES;
}

/* How many consecutive waiting candidates have equal residuals. */
GB_INLINE size_t gb_twins(const gb_sink_1 *c)
{
    return GB_CANDIDATES % (GB_STEP * GB_TWINS) == 0 && gb_are_ordinary(c) ? GB_TWINS : 1;
}

/* Measures the waiting candidates; so many of them in a row may have equal residuals. */
static GB_APART void gb_measure_waiting(const gb_sink_1 *c, size_t alike, gb_fits *fits)
{
    GB_PAIR(number) p[GB_PARAMETERS], at[GB_PLACES], residual, relative;
    gb_everywhere(c->all.problem.p, p);
    for (size_t first = 0; first < c->waiting; first += GB_STEP * alike) {
        gb_real fit[3][GB_STEP];
        GB_UNROLL
        for (int i = 0; i < GB_PLACES; i++) {
            const gb_real *row = &c->at[i][first];
            at[i] = GB_TWINS == 1 ? GB_PAIR(load)(row) : GB_PAIR(lanes_of)(row[0], row[(GB_STEP - 1) * alike]);
        }
        GB_PAIR(fit)(p, at, &residual, &relative);
        GB_PAIR(store)(fit[0], residual);
        GB_PAIR(store)(fit[1], relative);
        GB_PAIR(store)(fit[2], GB_PAIR(sound)(at));
        for (size_t lane = 0; lane < GB_STEP; lane++) {
            for (size_t k = first + lane * alike; k < first + (lane + 1) * alike; k++) {
                fits->residual[k] = fit[0][lane];
                fits->relative[k] = fit[1][lane];
                fits->sound[k] = fit[2][lane];
            }
        }
    }
}

/* The binary logarithm of the number of consecutive angles of a joint that are computed as one at an ordinary target. */
GB_INLINE int gb_run_of(int joint)
{
    int alike = 0;
#ifdef GB_RUNS
    while (((gb_runs[joint] | GB_CANDIDATES / GB_STEP) >> alike & 1) == 0) {
        alike++;
    }
#endif
    (void)joint;
    return alike;
}

/* The joint values, by joint and waiting candidate. Angles that differ only in sign, as at an ordinary target, are computed once. */
static GB_APART void gb_find_joints(const gb_sink_1 *c, gb_real (*q)[GB_CANDIDATES])
{
    const bool is_ordinary = gb_are_ordinary(c);
    gb_real acute[GB_JOINTS * GB_CANDIDATES + 1], up[GB_JOINTS * GB_CANDIDATES + 1];
    size_t count = 0;
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real *cosines = c->at[gb_joints[i].places[0]], *sines = c->at[gb_joints[i].places[1]];
        const size_t stride = (size_t)1 << (is_ordinary ? gb_run_of(i) : 0);
        for (size_t k = 0; gb_joints[i].is_angle && k < c->waiting; k += stride) {
            acute[count] = gb_magnitude(cosines[k]);
            up[count++] = gb_magnitude(sines[k]);
        }
    }
    acute[count] = up[count] = R(1.0);
    for (size_t first = 0; first < count; first += GB_STEP) {
        GB_PAIR(store)(&acute[first], GB_PAIR(acute)(GB_PAIR(load)(&acute[first]), GB_PAIR(load)(&up[first])));
    }
    const gb_real *own = acute;
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real *cosines = c->at[gb_joints[i].places[0]], *sines = c->at[gb_joints[i].places[1]];
        const int alike = is_ordinary ? gb_run_of(i) : 0;
        if (!gb_joints[i].is_angle) {
            memcpy(q[i], cosines, sizeof q[i]);
            continue;
        }
        for (size_t k = 0; k < c->waiting; k += GB_STEP) {
            const GB_PAIR(number) pair = GB_PAIR(lanes_of)(own[k >> alike], own[(k + GB_STEP - 1) >> alike]);
            GB_PAIR(store)(&q[i][k], GB_PAIR(unfold)(pair, GB_PAIR(load)(&cosines[k]), GB_PAIR(load)(&sines[k])));
        }
        own += c->waiting >> alike;
    }
}

/* Whether two candidates differ in at least one angle. */
GB_INLINE bool gb_are_apart(const gb_sink_1 *c, size_t k, size_t other)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_joint joint = gb_joints[gb_last_first[i]];
        const gb_real *cosines = c->at[joint.places[0]], *sines = c->at[joint.places[1]];
        if (joint.is_angle && cosines[k] * cosines[other] + sines[k] * sines[other] < GB_FAR_APART) {
            return true;
        }
    }
    return false;
}

/* Writes an accepted candidate if there is room and it differs from the others from `nearest` on. */
GB_INLINE bool gb_write_apart(gb_sink_1 *c, size_t nearest, size_t k, const gb_real *q, gb_real residual, gb_real relative)
{
    for (size_t other = nearest; other < k; other++) {
        if (!gb_are_apart(c, k, other)) {
            return false;
        }
    }
    if (c->all.count == GB_CAPACITY) {
        return false;
    }
    gb_solution *out = &c->out[c->all.count];
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        out->q[i] = q[i];
    }
    out->residual = residual;
    out->relative = relative;
    out->branch = c->found[k].branch;
    out->chosen = false;
    out->free = c->found[k].free;
    c->all.count++;
    return true;
}

/* Copies the numbers that follow from no joint from a waiting candidate, so that the equations read them. */
static void gb_extras_of(gb_sink_1 *c, size_t k)
{
    if (GB_EXTRAS) {
        for (int i = 0; i < GB_PLACES; i++) {
            c->extras[i] = c->at[i][k];
        }
        c->all.problem.extras = c->extras;
    }
}

/* Keeps a candidate that needs comparison with others, or refines it. */
static GB_COLD void gb_look_closer(gb_sink_1 *c, size_t k, size_t waiting, const gb_real *q, const gb_fit *fit)
{
    const gb_found_1 found = c->found[k];
    gb_extras_of(c, k);
    if (fit) {
        gb_keep(&c->all, &found, q, fit);
    } else {
        gb_refine(&c->all, c->all.candidates + 1 + k - waiting, &found, q);
    }
}

GB_INLINE void gb_joints_of(gb_real (*joints)[GB_CANDIDATES], size_t k, gb_real *q)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        q[i] = joints[i][k];
    }
}

#ifdef GB_SHORTS
/* Keeps the solutions near the waiting candidates of a nearby mechanism's formulas. */
static void gb_keep_waiting(gb_sink_1 *c, gb_real (*joints)[GB_CANDIDATES])
{
    gb_approaches approaches;
    gb_find_approaches(c, &approaches);
    const size_t waiting = c->waiting;
    bool is_usual = c->all.count == 0;
    for (size_t k = 0; k < waiting; k++) {
        gb_approach approach;
        gb_real q[GB_JOINTS];
        gb_joints_of(joints, k, q);
        c->waiting = 0;
        if (!gb_lead(c, &approaches, k, q, &approach)) {
            is_usual = false;
            gb_look_closer(c, k, waiting, q, NULL);
            continue;
        }
        const bool holds = approach.pivot >= approach.missed * (c->found[k].close ? GB_STEEP : GB_MILD);
        if (holds && is_usual && gb_write_apart(c, 0, k, approach.end, approach.fit.residual, approach.fit.relative)) {
            continue;
        }
        is_usual = false;
        gb_extras_of(c, k);
        gb_arrive(&c->all, c->all.candidates + 1 + k - waiting, &c->found[k], &approach);
    }
}

#else
/* Keeps the waiting candidates that solve the equations within rounding, and refines the others. */
static void gb_keep_waiting(gb_sink_1 *c, gb_real (*joints)[GB_CANDIDATES])
{
    gb_fits fits;
    const size_t twins = gb_twins(c);
    gb_measure_waiting(c, twins, &fits);
    bool is_usual = c->all.count == 0;
    for (size_t k = 0; k < c->waiting; k++) {
        const gb_fit fit = {fits.residual[k], fits.relative[k], true};
        const bool holds = c->found[k].free == 0 && !c->found[k].close && fit.relative < GB_ACCEPTANCE_ROUNDING && fits.sound[k] > R(0.0);
        gb_real q[GB_JOINTS];
        gb_joints_of(joints, k, q);
        /* The second of two twins has the same distance to earlier candidates as the first. */
        const size_t nearest = k % twins == 0 ? 0 : k - 1;
        if (holds && is_usual && gb_write_apart(c, nearest, k, q, fit.residual, fit.relative)) {
            continue;
        }
        is_usual = false;
        gb_look_closer(c, k, c->waiting, q, holds ? &fit : NULL);
    }
}
#endif

/* Whether two solutions differ in at least one angle. */
static bool gb_tell_apart(const gb_pairs *a, const gb_pairs *b)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const size_t joint = gb_last_first[i];
        if (gb_joints[joint].is_angle && a->joints[joint][0] * b->joints[joint][0] + a->joints[joint][1] * b->joints[joint][1] < GB_FAR_APART) {
            return true;
        }
    }
    return false;
}

/* Writes a candidate as pairs if it differs from all before it. */
static bool gb_write_pairs(gb_sink_1 *c, size_t k, gb_real residual)
{
    if (c->all.count == GB_CAPACITY) {
        return false;
    }
    gb_pairs *out = &c->pairs[c->all.count];
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_joint joint = gb_joints[i];
        out->joints[i][0] = joint.is_angle ? c->at[joint.places[0]][k] + R(0.0) : c->at[joint.places[0]][k];
        out->joints[i][1] = joint.is_angle ? c->at[joint.places[1]][k] + R(0.0) : R(0.0);
    }
    out->residual = residual;
    out->branch = c->found[k].branch;
    out->free = 0;
    out->settled = true;
    for (size_t other = 0; other < c->all.count; other++) {
        if (c->pairs[other].branch == out->branch || !gb_tell_apart(out, &c->pairs[other])) {
            return false;
        }
    }
    c->all.count++;
    return true;
}

/* Writes the waiting candidates as pairs, as long as all solve the equations within rounding and differ from each other. */
static void gb_keep_pairs(gb_sink_1 *c)
{
    gb_fits fits;
    gb_measure_waiting(c, gb_twins(c), &fits);
    c->is_usual = c->is_usual && !gb_this.is_nearby;
    for (size_t k = 0; c->is_usual && k < c->waiting; k++) {
        const bool holds = c->found[k].free == 0 && !c->found[k].close && fits.relative[k] < GB_ACCEPTANCE_ROUNDING && fits.sound[k] > R(0.0);
        c->is_usual = holds && gb_write_pairs(c, k, fits.residual[k]);
    }
}

#ifdef GB_WITHIN
/* Whether two rows of joint values agree within a tolerance; free joints are left out. */
static bool gb_are_within(const gb_real *a, const gb_real *b, uint32_t free, gb_real tolerance)
{
    for (size_t i = 0; i < GB_JOINTS; i++) {
        gb_real delta = a[i] - b[i], span = R(1.0);
        if (gb_joints[i].is_angle) {
            delta = delta > GB_PI ? delta - GB_TAU : delta < -GB_PI ? delta + GB_TAU : delta;
        } else {
            span = gb_larger(GB_SCALE, gb_magnitude(a[i]));
        }
        if (!(free >> i & 1) && !(gb_magnitude(delta) <= tolerance * span)) {
            return false;
        }
    }
    return true;
}

static bool gb_onto_self_motion(const gb_problem *problem, gb_real *q, uint32_t free);

/* Keeps a candidate that is nearer to the target than those before. */
static void gb_take_closest(gb_answers *all, gb_real *q)
{
    /* On a stratum a joint may only appear free, because the remaining equations determine it. */
    const gb_fit fit = gb_fitted(&all->problem, q, 0, R(0.5));
    if (!(all->has_nearest && fit.relative >= all->nearest_fit.relative)) {
        all->has_nearest = true;
        all->nearest_fit = fit;
        memcpy(all->nearest, q, GB_JOINTS * sizeof *q);
    }
}

/* Keeps a member of a self-motion within the tolerance of the target, next to a candidate for one. */
static void gb_take_member(gb_answers *all, const gb_found_1 *found, gb_real *q)
{
    if (found->free != 0 && gb_onto_self_motion(&all->problem, q, found->free)) {
        all->has_nearest = true;
        memcpy(all->nearest, q, GB_JOINTS * sizeof *q);
    }
}

/* Whether joint values are far from all solutions. */
static bool gb_is_far(const gb_sink_1 *c, const gb_real *q)
{
    for (size_t i = 0; i < c->all.count; i++) {
        if (gb_are_within(c->out[i].q, q, c->out[i].free, GB_MERGING_BLUR)) {
            return false;
        }
    }
    return true;
}

/* Adds a candidate within the tolerance that is far from all solutions and on no self-motion. */
static void gb_take_other(gb_sink_1 *c, const gb_found_1 *found, gb_real *q)
{
    const gb_real within = gb_larger(GB_WITHIN, GB_ACCEPTANCE_RESIDUAL);
    if (c->all.count == GB_CAPACITY || (found->free == 0 && !gb_is_far(c, q))) {
        return;
    }
    const gb_fit fit = gb_fitted(&c->all.problem, q, 0, R(0.5));
    /* On a stratum a joint may only appear free, because the remaining equations determine it: then no other joint values nearby are within the tolerance. */
    if (fit.relative <= within && gb_is_far(c, q) && (found->free == 0 || gb_regularity(&c->all.problem, q) * GB_MERGING_BLUR > within)
        && !(c->ideal && gb_has_member(c->ideal, q, c->moving))) {
        gb_solution *out = &c->out[c->all.count++];
        memcpy(out->q, q, sizeof out->q);
        out->residual = fit.residual;
        out->relative = fit.relative;
        out->branch = found->branch;
        out->chosen = false;
        out->free = 0;
    }
}

/* Whether no more candidates are needed. */
static bool gb_has_enough(const gb_sink_1 *c)
{
    return c->all.has_nearest && (c->sought == GB_MEMBER || c->all.nearest_fit.relative <= GB_POLISHING_DONE);
}

/* Processes the waiting candidates, until no more are needed. */
static void gb_fit_waiting(gb_sink_1 *c)
{
    /* This makes the cases of all strata run. */
    c->all.unsound = c->all.candidates;
    for (size_t k = 0; k < c->waiting; k++) {
        gb_real q[GB_MAX_JOINTS];
        bool is_finite = true;
        c->free |= c->found[k].free;
        for (int i = 0; i < GB_JOINTS; i++) {
            const gb_real first = c->at[gb_joints[i].places[0]][k], second = c->at[gb_joints[i].places[1]][k];
            q[i] = gb_joints[i].is_angle ? gb_angle(first, second) : first;
            is_finite = is_finite && gb_magnitude(q[i]) <= GB_GREATEST;
        }
        /* Next to a stratum formulas may divide zero by zero. */
        if (!is_finite || gb_has_enough(c)) {
            continue;
        }
        if (c->sought == GB_CLOSEST) {
            gb_take_closest(&c->all, q);
        } else if (c->sought == GB_MEMBER) {
            gb_take_member(&c->all, &c->found[k], q);
        } else {
            gb_take_other(c, &c->found[k], q);
        }
    }
}
#endif

/* Keeps the solutions among the waiting candidates. */
static GB_APART void gb_flush(gb_sink_1 *c)
{
    for (int i = 0; c->waiting % 2 == 1 && i < GB_PLACES; i++) {
        c->at[i][c->waiting] = c->at[i][c->waiting - 1];
    }
#ifdef GB_WITHIN
    if (c->sought != GB_ANSWERS) {
        gb_fit_waiting(c);
        c->waiting = 0;
        return;
    }
#endif
    if (c->pairs) {
        gb_keep_pairs(c);
    } else {
        gb_real joints[GB_JOINTS][GB_CANDIDATES];
        gb_find_joints(c, joints);
        gb_keep_waiting(c, joints);
    }
    c->waiting = 0;
}

/* Public functions of a robot's solver */

int GB_PUBLIC(solve_bounded)(const gb_real *target, size_t most, gb_solution *out)
{
    size_t steps = gb_steps_at_most(most);
#ifdef GB_WITHIN
    return gb_solve_described(target, out, NULL, &steps);
#else
    return gb_solve_ideal(target, out, &steps);
#endif
}

int GB_PUBLIC(solve)(const gb_real *target, gb_solution *out)
{
    return GB_PUBLIC(solve_bounded)(target, GB_MOST_STEPS, out);
}

int GB_PUBLIC(solve_or_nearest)(const gb_real *target, gb_solution *out, gb_solution *nearest)
{
    memset(nearest, 0, sizeof *nearest);
    nearest->residual = nearest->relative = INFINITY;
    nearest->settled = true;
    size_t steps = gb_steps_at_most(GB_MOST_STEPS);
#ifdef GB_WITHIN
    return gb_solve_described(target, out, nearest, &steps);
#else
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    const int code = gb_walk_through(&c, target, p, out, NULL, GB_ANSWERS, &steps);
    if (code < 0) {
        return code;
    }
    gb_put_in_order(&c.all);
    if (c.all.count == 0 && c.all.has_nearest) {
        memcpy(nearest->q, c.all.nearest, sizeof nearest->q);
        nearest->residual = c.all.nearest_fit.residual;
        nearest->relative = c.all.nearest_fit.relative;
    }
    return gb_settle(steps, out, c.all.count);
#endif
}

/* A solution by cosines and sines. */
static void gb_pairs_of(const gb_solution *solution, gb_pairs *out)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        out->joints[i][0] = gb_joints[i].is_angle ? gb_cosine(solution->q[i]) : solution->q[i];
        out->joints[i][1] = gb_joints[i].is_angle ? gb_sine(solution->q[i]) : R(0.0);
    }
    out->residual = solution->residual;
    out->branch = solution->branch;
    out->free = solution->free;
    out->settled = solution->settled;
}

/* The solutions of the robot's solve function, as pairs. */
static GB_COLD int gb_solve_by_angles(const gb_real *target, gb_pairs *out)
{
    gb_solution list[GB_CAPACITY];
    const int count = GB_PUBLIC(solve)(target, list);
    for (int i = 0; i < count; i++) {
        gb_pairs_of(&list[i], &out[i]);
    }
    return count;
}

int GB_PUBLIC(solve_pairs)(const gb_real *target, gb_pairs *out)
{
#ifdef GB_WITHIN
    return gb_solve_by_angles(target, out);
#else
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    size_t steps = gb_steps_at_most(GB_MOST_STEPS);
    const int code = gb_walk_through(&c, target, p, NULL, out, GB_ANSWERS, &steps);
    if (code < 0) {
        return code;
    }
    if (!c.is_usual || c.all.count > GB_ISOLATED) {
        return gb_solve_by_angles(target, out);
    }
    for (size_t end = 1; end < c.all.count; end++) {
        for (size_t i = end; i > 0 && out[i - 1].branch > out[i].branch; i--) {
            const gb_pairs other = out[i];
            out[i] = out[i - 1];
            out[i - 1] = other;
        }
    }
    return (int)c.all.count;
#endif
}

/* Writes all solutions of one target, or none if there is not enough room. */
static GB_COLD int gb_solve_into(const gb_real *target, gb_solution *solutions, gb_pairs *pairs, size_t room)
{
    if (room >= GB_CAPACITY) {
        return solutions ? GB_PUBLIC(solve)(target, solutions) : GB_PUBLIC(solve_pairs)(target, pairs);
    }
    union {
        gb_solution solutions[GB_CAPACITY];
        gb_pairs pairs[GB_CAPACITY];
    } list;
    const int count = solutions ? GB_PUBLIC(solve)(target, list.solutions) : GB_PUBLIC(solve_pairs)(target, list.pairs);
    if (count > 0 && (size_t)count <= room && solutions) {
        memcpy(solutions, list.solutions, (size_t)count * sizeof *solutions);
    } else if (count > 0 && (size_t)count <= room) {
        memcpy(pairs, list.pairs, (size_t)count * sizeof *pairs);
    }
    return count;
}

#if GB_LANES > 1 && defined(GB_RUNS)
#define GB_SOLVE_MANY GB_JOIN(gb_solve_many, _, GB_LANES)
#else
#define GB_SOLVE_MANY gb_solve_singly
/* Solves the targets of a batch one after the other. */
static size_t gb_solve_singly(const gb_real *targets, size_t count, gb_solution *solutions, gb_pairs *pairs, size_t room, int *counts)
{
    size_t filled = 0;
    for (size_t done = 0; done < count; done++) {
        gb_solution *solution = solutions ? solutions + filled : NULL;
        gb_pairs *pair = pairs ? pairs + filled : NULL;
        const int found = gb_solve_into(targets + done * GB_INPUTS, solution, pair, room - filled);
        if (found > 0 && (size_t)found > room - filled) {
            return done;
        }
        counts[done] = found;
        filled += found > 0 ? (size_t)found : 0;
    }
    return count;
}
#endif

size_t GB_PUBLIC(solve_batch)(const gb_real *targets, size_t count, gb_solution *out, size_t room, int *counts)
{
    return GB_SOLVE_MANY(targets, count, out, NULL, room, counts);
}

size_t GB_PUBLIC(solve_pairs_batch)(const gb_real *targets, size_t count, gb_pairs *out, size_t room, int *counts)
{
    return GB_SOLVE_MANY(targets, count, NULL, out, room, counts);
}

gb_real GB_PUBLIC(residual)(const gb_real *target, const gb_real *q)
{
    gb_real conforming[GB_INPUTS] = {0}, p[GB_PARAMETERS], at[GB_PLACES], values[GB_EQUATIONS], largest = R(0.0);
    const gb_problem problem = {&gb_this, p, NULL, NULL};
    if (GB_EXTRAS || gb_conform(target, conforming) < 0) {
        return NAN;
    }
    gb_parameters_1(conforming, p);
    gb_place(&problem, q, at);
#ifdef GB_WITHIN
    gb_described_1(p, at, values);
#else
    gb_values_of(p, at, values);
#endif
    for (int i = 0; i < GB_EQUATIONS; i++) {
        if (isnan(values[i])) {
            return NAN;
        }
        largest = gb_larger(largest, gb_magnitude(values[i]));
    }
    return largest;
}

bool GB_PUBLIC(forward)(const gb_real *q, gb_real *target)
{
#ifdef GB_REACHED
    static const gb_reached reached[GB_INPUTS] = {GB_REACHED};
    const gb_problem problem = {&gb_this, NULL, NULL, NULL};
    gb_real at[GB_PLACES], tip[GB_EQUATIONS];
    gb_place(&problem, q, at);
#ifdef GB_WITHIN
    const gb_real nothing[GB_PARAMETERS] = {0};
    gb_described_1(nothing, at, tip);
#else
    gb_tip_1(at, tip);
#endif
    for (int i = 0; i < GB_INPUTS; i++) {
        const size_t first = reached[i].of[0], second = reached[i].of[1];
        if (reached[i].kind == GB_AS_JOINT) {
            target[i] = q[first];
        } else if (reached[i].kind == GB_AS_VALUE) {
            target[i] = tip[first];
        } else {
            target[i] = gb_unfold_1(gb_acute_1(gb_magnitude(tip[first]), gb_magnitude(tip[second])), tip[first], tip[second]);
        }
    }
    return true;
#else
    (void)q;
    (void)target;
    return false;
#endif
}

int GB_PUBLIC(solve_placed)(const gb_real *base, const gb_real *tool, const gb_real *target, gb_solution *out)
{
#if defined(GB_CONDITIONS) && GB_INPUTS >= 12
    static const gb_real identity[12] = {0, 0, 0, R(1.0), 0, 0, 0, R(1.0), 0, 0, 0, R(1.0)};
    gb_real placed[GB_INPUTS];
    if (sizeof gb_conditions == sizeof gb_conditions[0] && gb_conditions[0].is_rotation && gb_conditions[0].first == 3) {
        memcpy(placed, target, sizeof placed);
        gb_target_of(base ? base : identity, tool ? tool : identity, target, placed);
        return GB_PUBLIC(solve)(placed, out);
    }
#else
    (void)base;
    (void)tool;
    (void)target;
    (void)out;
#endif
    return GB_NOT_POSE;
}

void GB_PUBLIC(target_of)(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target)
{
    gb_target_of(base, tool, pose, target);
}

size_t GB_PUBLIC(count_turns)(const gb_real *q, const gb_real *limits)
{
    return gb_count_turns(&gb_this, q, limits);
}

void GB_PUBLIC(turn)(const gb_real *q, const gb_real *limits, size_t index, gb_real *out)
{
    gb_turn(&gb_this, q, limits, index, out);
}

int GB_PUBLIC(solve_within)(const gb_real *target, const gb_real *limits, gb_solution *out)
{
    gb_real conforming[GB_INPUTS] = {0}, p[GB_PARAMETERS];
    const int count = GB_PUBLIC(solve)(target, out);
    if (count <= 0) {
        return count;
    }
    gb_conform(target, conforming);
    gb_parameters_1(conforming, p);
#ifdef GB_WITHIN
    return gb_bring_all_within(p, limits, out, count);
#else
    gb_answers all;
    size_t steps;
    memset(&all, 0, sizeof all);
    all.problem.mechanism = &gb_this;
    all.problem.p = p;
    all.problem.steps = &steps;
    all.out = out;
    all.count = (size_t)count;
    return (int)gb_keep_within(&all, limits);
#endif
}

int GB_PUBLIC(nearest)(const gb_solution *list, int count, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_real *q)
{
    gb_answers all;
    memset(&all, 0, sizeof all);
    all.problem.mechanism = &gb_this;
    all.out = (void *)list;
    all.count = count > 0 ? (size_t)count : 0;
    return gb_nearest(&all, reference, weights, limits, q);
}

int GB_PUBLIC(nearest_to)(const gb_real *target, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_solution *out)
{
    const gb_real *const aim[] = {reference, weights, limits};
    gb_real conforming[GB_INPUTS] = {0}, p[GB_PARAMETERS];
    gb_solution list[GB_CAPACITY];
    gb_nearest_end best;
    gb_answers all;
    const int count = GB_PUBLIC(solve)(target, list);
    if (count <= 0) {
        return count;
    }
    memset(&all, 0, sizeof all);
    all.problem.mechanism = &gb_this;
    all.out = list;
    all.count = (size_t)count;
    gb_begin_nearest(&all, reference, weights, limits, &best);
    int known = best.member < 0 ? 0 : best.member;
    for (int k = count; k-- > 0;) {
        known = list[k].free != 0 ? k : known;
    }
    if (best.can_search) {
        gb_conform(target, conforming);
        gb_parameters_1(conforming, p);
#ifdef GB_WITHIN
        gb_search_ideal(p, list, count, aim, &best);
#else
        size_t steps = gb_steps_at_most(GB_MOST_STEPS);
        all.problem.p = p;
        all.problem.steps = &steps;
        gb_search_all(&all, aim, &best);
#endif
    }
    if (!best.is_found) {
        return 0;
    }
    *out = list[best.member < 0 ? known : best.member];
    memcpy(out->q, best.q, sizeof out->q);
    out->residual = best.fit.residual;
    out->relative = best.fit.relative;
    return 1;
}

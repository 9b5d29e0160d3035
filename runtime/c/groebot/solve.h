/* All solutions of a target */

/* Projects a target onto its conditions. Returns a code below zero if it is farther from them than the tolerance. */
static int gb_conform(const gb_real *target, gb_real *conforming)
{
    for (int i = 0; i < GB_INPUTS; i++) {
        conforming[i] = target[i];
        if (!(gb_magnitude(target[i]) <= GB_GREATEST)) {
            return GB_NOT_FINITE;
        }
    }
#ifdef GB_CONDITIONS
    GB_UNROLL
    for (size_t i = 0; i < sizeof gb_conditions / sizeof gb_conditions[0]; i++) {
        if (!gb_fulfil_1(gb_conditions[i], conforming)) {
            return gb_conditions[i].is_rotation ? GB_NOT_ROTATION : GB_NOT_UNIT;
        }
    }
#endif
    return 0;
}

/* Evaluates the program to find the solutions of a target with these parameters. Returns 0, or a code below. */
static int gb_walk_through(gb_sink_1 *c, const gb_real *target, gb_real *p, gb_solution *out, gb_pairs *pairs, enum gb_sought sought, size_t *steps)
{
    gb_real conforming[GB_INPUTS] = {0};
    const int code = gb_conform(target, conforming);
    if (code < 0) {
        return code;
    }
    gb_parameters_1(conforming, p);
    c->all.problem.mechanism = &gb_this;
    c->all.problem.p = p;
    c->all.problem.extras = NULL;
    c->all.problem.steps = steps;
    c->all.out = c->out = out;
    c->all.room = GB_CAPACITY;
    c->all.count = sought == GB_OTHERS ? c->known : 0;
    c->all.candidates = c->all.unsound = c->all.doubted = c->waiting = 0;
    c->all.suffices = !gb_this.is_nearby;
    c->all.starts.count = 0;
    c->all.rejected.count = 0;
    c->all.rejected.are_too_many = false;
    c->all.members_count = 0;
    c->all.merged_count = c->all.known_isolated_count = 0;
    c->all.is_open = c->all.has_nearest = c->all.is_another = false;
    c->pairs = pairs;
    c->sought = sought;
    c->is_usual = c->is_ordinary = true;
    gb_walk_1(p, c);
    gb_flush(c);
    if (gb_this.is_nearby && c->all.starts.count > 0) {
        gb_walk_curves(&c->all);
    }
    if (gb_are_doubtful(&c->all.rejected) && !gb_are_all(&c->all) && *steps > 0) {
        c->all.suffices = false;
        gb_walk_1(p, c);
        gb_flush(c);
    }
    return c->all.is_open ? GB_OPEN_STRATUM : 0;
}

/* Whether solutions are already sorted. */
GB_INLINE bool gb_are_in_order(const gb_sink_1 *c)
{
    bool are_sorted = GB_PREFERRED < 0 && c->all.count <= GB_ISOLATED;
    for (size_t i = 1; i < c->all.count; i++) {
        are_sorted &= c->out[i - 1].branch <= c->out[i].branch;
    }
    return are_sorted;
}

/* Marks all solutions of a target as not settled if its steps are used up. Returns their number, or a code below zero. */
GB_INLINE int gb_settle(size_t steps, gb_solution *out, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        out[i].settled = steps > 0;
    }
    return steps > 0 || count > 0 ? (int)count : GB_UNSETTLED;
}

/* Finds all joint values with which the equations hold. Returns their number, or a code below zero. */
GB_INLINE int gb_solve_ideal(const gb_real *target, gb_solution *out, size_t *steps)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    const int code = gb_walk_through(&c, target, p, out, NULL, GB_ANSWERS, steps);
    if (code < 0) {
        return code;
    }
    if (!gb_are_in_order(&c)) {
        gb_put_in_order(&c.all);
    }
    return gb_settle(*steps, out, c.all.count);
}

/* Joint values next to a target at which a joint can move while the tip does not: see freedom.rs */

/* The component of a column orthogonal to the derivatives by the joints that are not `free`, and the joint velocities that cancel the rest. False where
 * there are none. */
static bool gb_across(const gb_problem *problem, const gb_real *rows, const gb_real *columns, size_t column, uint32_t free, gb_real *rest, gb_real *direction)
{
    const gb_mechanism *m = problem->mechanism;
    gb_triangle triangle;
    gb_real along[GB_MAX_JOINTS];
    gb_clear_triangle(m, &triangle);
    for (size_t i = 0; i < m->equations; i++) {
        gb_column(&triangle, m->joints)[i] = columns[i * m->joints + column];
    }
    gb_fill_triangle(problem, rows, gb_dampings[1], free, &triangle);
    if (!gb_substitute(&triangle, along)) {
        return false;
    }
    for (size_t i = 0; i < m->equations; i++) {
        rest[i] = columns[i * m->joints + column];
        for (size_t k = 0; k < m->joints; k++) {
            rest[i] = gb_is_in(free, k) ? rest[i] : rest[i] - rows[i * m->joints + k] * along[k];
        }
    }
    for (size_t k = 0; k < m->joints; k++) {
        direction[k] = k == column ? R(1.0) : gb_is_in(free, k) ? R(0.0) : -along[k];
    }
    return true;
}

/* The change of the Jacobian along a displacement of the joints. */
static void gb_bend(const gb_problem *problem, const gb_real *q, const gb_real *direction, gb_real *bends)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real width = GB_POLISHING_DIFFERENCE / gb_larger(gb_longest(m, direction), R(1.0));
    gb_real back[GB_MAX_JOINTS], moved[GB_MAX_JOINTS], behind[GB_MAX_EQUATIONS * GB_MAX_JOINTS], values[GB_MAX_EQUATIONS];
    for (size_t i = 0; i < m->joints; i++) {
        back[i] = -width * direction[i];
    }
    gb_stepped(m, q, back, moved);
    gb_share(problem, moved, bends, values);
    for (size_t i = 0; i < m->joints; i++) {
        back[i] = width * direction[i];
    }
    gb_stepped(m, q, back, moved);
    gb_share(problem, moved, behind, values);
    for (size_t i = 0; i < m->equations * m->joints; i++) {
        bends[i] = (bends[i] - behind[i]) / (R(2.0) * width);
    }
}

/* A step to where the first of the joints `free` can move; false where there is none. */
static bool gb_freeing_step(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real share, gb_real *step)
{
    const gb_mechanism *m = problem->mechanism;
    gb_triangle nearer, triangle;
    gb_real rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS], bends[GB_MAX_EQUATIONS * GB_MAX_JOINTS], values[GB_MAX_EQUATIONS], direction[GB_MAX_JOINTS];
    size_t first = 0;
    while (first + 1 < m->joints && !gb_is_in(free, first)) {
        first++;
    }
    gb_clear_triangle(m, &triangle);
    gb_share(problem, q, rows, values);
    if (!gb_across(problem, rows, rows, first, free, gb_column(&triangle, m->joints), direction)) {
        return false;
    }
    gb_bend(problem, q, direction, bends);
    gb_make_shares(problem, q, GB_PIVOTS_REGULAR_STEPS, free, &nearer);
    for (size_t i = 0; i <= m->joints; i++) {
        gb_real *filled = gb_column(&triangle, i);
        if (i < m->joints && !gb_is_in(free, i) && !gb_across(problem, rows, bends, i, free, filled, direction)) {
            return false;
        }
        for (size_t k = 0; k <= i && k < m->joints; k++) {
            filled[m->equations + k] = share * gb_column(&nearer, i)[k];
        }
    }
    gb_reflect(&triangle);
    return gb_substitute(&triangle, step);
}

/* Joint values next to q at which the first of the joints `free` can move, to first order, while the others keep the equations' values. Among these, those
 * with the least residual. The joints `free` keep their values. False where no such joint values are near. */
GB_LINKAGE bool gb_free_joints(const gb_problem *problem, gb_real *q, uint32_t free)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real step[GB_MAX_JOINTS];
    for (size_t i = 0; i < GB_LENGTH_OF(gb_freeing); i++) {
        if (!gb_freeing_step(problem, q, free, gb_freeing[i], step) || !(gb_longest(m, step) <= gb_leaps[0])) {
            return false;
        }
        gb_stepped(m, q, step, q);
    }
    return true;
}

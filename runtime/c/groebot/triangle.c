/* The triangular factor of Newton steps, and how singular it is: see triangle.rs */

/* A QR factorisation, stored by columns; the right side is the last one. A column has one entry for each equation, then one for each joint. Only the first
 * `damped` joints have non-zero entries. Before the reflection of a pivot, the entries after that of its joint are zero. */
typedef struct {
    gb_real numbers[(GB_MAX_JOINTS + 1) * (GB_MAX_EQUATIONS + GB_MAX_JOINTS)];
    size_t rows;
    size_t joints;
    size_t damped;
} gb_triangle;

static gb_real *gb_column(gb_triangle *triangle, size_t column)
{
    return triangle->numbers + column * triangle->rows;
}

/* Reduces columns to a triangle by Householder reflections (A. Householder, "Unitary triangularization of a nonsymmetric matrix", 1958). */
static void gb_reflect(gb_triangle *triangle)
{
    for (size_t pivot = 0; pivot < triangle->joints; pivot++) {
        const size_t damped = pivot < triangle->damped ? pivot + 1 : triangle->damped;
        const size_t end = triangle->rows - triangle->joints + damped;
        gb_real *mirror = gb_column(triangle, pivot), square = R(0.0);
        for (size_t i = pivot; i < end; i++) {
            square = square + mirror[i] * mirror[i];
        }
        if (square == R(0.0)) {
            continue;
        }
        const gb_real length = gb_signed(gb_square_root(square), mirror[pivot]);
        mirror[pivot] += length;
        const gb_real half = length * mirror[pivot];
        for (size_t other = pivot + 1; other <= triangle->joints; other++) {
            gb_real *column = gb_column(triangle, other), along = R(0.0);
            for (size_t i = pivot; i < end; i++) {
                along = along + mirror[i] * column[i];
            }
            along = along / half;
            for (size_t i = pivot; i < end; i++) {
                column[i] -= along * mirror[i];
            }
        }
        mirror[pivot] = -length;
    }
}

/* A triangle of zeros for a mechanism. */
static void gb_clear_triangle(const gb_mechanism *m, gb_triangle *triangle)
{
    triangle->rows = m->equations + m->joints;
    triangle->joints = m->joints;
    triangle->damped = m->joints;
    memset(triangle->numbers, 0, (m->joints + 1) * triangle->rows * sizeof *triangle->numbers);
}

/* The matrix of equations with these derivatives, their values in the last column. Joints that are `held` do not move. */
static void gb_fill_triangle(const gb_problem *problem, const gb_real *rows, gb_real damping, uint32_t held, gb_triangle *triangle)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real size = R(0.0);
    gb_take_step(problem);
    for (size_t i = 0; i < m->joints; i++) {
        gb_real *column = gb_column(triangle, i), square = R(0.0);
        for (size_t k = 0; !gb_is_in(held, i) && k < m->equations; k++) {
            column[k] = rows[k * m->joints + i];
            square += column[k] * column[k];
        }
        size = gb_larger(size, square);
    }
    while (damping == R(0.0) && triangle->damped > 0 && !gb_is_in(held, triangle->damped - 1)) {
        triangle->damped--;
    }
    for (size_t i = 0; i < m->joints; i++) {
        gb_column(triangle, i)[m->equations + i] = gb_is_in(held, i) ? R(1.0) : gb_square_root(damping * size);
    }
    gb_reflect(triangle);
}

/* The Jacobian of the equations and their values. */
typedef struct {
    gb_real rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS];
    gb_real values[GB_MAX_EQUATIONS];
} gb_slopes;

static void gb_find_slopes(const gb_problem *problem, const gb_real *q, gb_slopes *slopes)
{
    gb_real at[GB_MAX_PLACES];
    gb_place(problem, q, at);
    problem->mechanism->jacobian(problem->p, at, slopes->rows);
    problem->mechanism->values(problem->p, at, slopes->values);
}

/* The triangular factor of a step's equations, with damping. */
static void gb_triangle_of(const gb_problem *problem, const gb_slopes *slopes, gb_real damping, uint32_t held, gb_triangle *triangle)
{
    const gb_mechanism *m = problem->mechanism;
    gb_clear_triangle(m, triangle);
    gb_copy(gb_column(triangle, m->joints), slopes->values, m->equations);
    gb_fill_triangle(problem, slopes->rows, damping, held, triangle);
}

/* The triangular factor of a step's equations at joint values. */
static void gb_make_triangle(const gb_problem *problem, const gb_real *q, gb_real damping, uint32_t held, gb_triangle *triangle)
{
    gb_slopes slopes;
    gb_find_slopes(problem, q, &slopes);
    gb_triangle_of(problem, &slopes, damping, held, triangle);
}

/* The Jacobian of the relative equations and their values. */
static void gb_share(const gb_problem *problem, const gb_real *q, gb_real *rows, gb_real *right)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real at[GB_MAX_PLACES], sizes[GB_MAX_SIZES];
    gb_place(problem, q, at);
    m->jacobian(problem->p, at, rows);
    m->values(problem->p, at, right);
    m->measures(problem->p, at, sizes);
    for (size_t i = 0; i < m->equations; i++) {
        const gb_real size = gb_larger(GB_LEAST_POSITIVE, sizes[m->size_of[i]]);
        right[i] = right[i] / size;
        for (size_t k = 0; k < m->joints; k++) {
            rows[i * m->joints + k] = rows[i * m->joints + k] / size;
        }
    }
}

/* The triangular factor of the relative equations (each divided by its size). */
static void gb_make_shares(const gb_problem *problem, const gb_real *q, gb_real damping, uint32_t held, gb_triangle *triangle)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS];
    gb_clear_triangle(m, triangle);
    gb_share(problem, q, rows, gb_column(triangle, m->joints));
    gb_fill_triangle(problem, rows, damping, held, triangle);
}

/* Solves the triangular system by back substitution; false for a zero or non-finite pivot. */
static bool gb_substitute(gb_triangle *triangle, gb_real *solution)
{
    const gb_real *right = gb_column(triangle, triangle->joints);
    for (size_t row = triangle->joints; row-- > 0;) {
        const gb_real pivot = gb_column(triangle, row)[row];
        if (pivot == R(0.0) || !gb_is_finite(pivot)) {
            return false;
        }
        gb_real sum = right[row];
        for (size_t k = row + 1; k < triangle->joints; k++) {
            sum -= gb_column(triangle, k)[row] * solution[k];
        }
        solution[row] = sum / pivot;
    }
    return true;
}

/* The least and the greatest pivot of a triangle. */
static void gb_pivots(gb_triangle *triangle, gb_real *least, gb_real *most)
{
    *least = INFINITY;
    *most = R(0.0);
    for (size_t i = 0; i < triangle->joints; i++) {
        const gb_real pivot = gb_magnitude(gb_column(triangle, i)[i]);
        *least = gb_smaller(*least, pivot);
        *most = gb_larger(*most, pivot);
    }
}

/* The least pivot of a triangle, relative to the largest. */
static gb_real gb_regularity_in(gb_triangle *triangle)
{
    gb_real least, most;
    gb_pivots(triangle, &least, &most);
    return least / most;
}

/* The least pivot of the triangular factor of the Jacobian at q with joints `held`, relative to the largest. It is within rounding at a double root, and
 * where the other joints can move while the equations hold. */
static gb_real gb_regularity_of(const gb_problem *problem, const gb_real *q, uint32_t held)
{
    gb_triangle triangle;
    gb_make_triangle(problem, q, R(0.0), held, &triangle);
    return gb_regularity_in(&triangle);
}

/* Same as gb_regularity_of, with no joint held. */
GB_LINKAGE gb_real gb_regularity(const gb_problem *problem, const gb_real *q)
{
    return gb_regularity_of(problem, q, 0);
}

static gb_real gb_norm(const gb_real *vector, size_t count)
{
    gb_real sum = R(0.0);
    for (size_t i = 0; i < count; i++) {
        sum = sum + vector[i] * vector[i];
    }
    return gb_square_root(sum);
}

/* Whether the least pivot exceeds the equations' values: then no configuration nearby has smaller residuals than the end of the plain step. */
static bool gb_is_regular(gb_triangle *triangle)
{
    gb_real least, most;
    gb_pivots(triangle, &least, &most);
    return least * least > GB_STEEP * most * gb_norm(gb_column(triangle, triangle->joints), triangle->rows);
}

/* The direction in which the equations change least, with its largest component equal to one, and that change relative to the largest pivot. Computed by
 * inverse iteration from the triangular factor. False where a pivot is zero, or no steps are left. */
static bool gb_stillest(const gb_problem *problem, gb_triangle *triangle, gb_real *delta, gb_real *share)
{
    const size_t joints = problem->mechanism->joints;
    gb_real least, most;
    if (gb_are_spent(problem)) {
        return false;
    }
    gb_pivots(triangle, &least, &most);
    gb_real *right = gb_column(triangle, joints);
    for (size_t i = 0; i < joints; i++) {
        delta[i] = R(1.0);
    }
    *share = R(1.0);
    for (int i = 0; i < GB_INVERSIONS; i++) {
        for (size_t row = 0; row < joints; row++) {
            gb_real above = delta[row];
            for (size_t k = 0; k < row; k++) {
                above = above - gb_column(triangle, row)[k] * right[k];
            }
            right[row] = above / gb_column(triangle, row)[row];
        }
        const gb_real before = gb_norm(right, joints);
        if (!gb_substitute(triangle, delta)) {
            return false;
        }
        *share = before / (gb_norm(delta, joints) * most);
    }
    const gb_real longest = gb_longest(problem->mechanism, delta);
    for (size_t i = 0; i < joints; i++) {
        delta[i] = delta[i] / longest;
    }
    return gb_is_finite(longest) && longest > R(0.0);
}

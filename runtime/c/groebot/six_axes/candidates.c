/* From the matrix pencil to joint angles: eigenvalues, eigenvectors, back-substitution: see candidates.rs */

/* The angle of a cosine and a sine; zero where both are zero. */
static gb_real gb_six_turn(gb_real cosine, gb_real sine)
{
    return cosine == R(0.0) && sine == R(0.0) ? R(0.0) : gb_angle(cosine, sine);
}

/* The joint values of a candidate. That of the joint whose line was used is not computed yet, and a displacement may be infinite. */
typedef struct {
    gb_real q[6];
    /* The eigenvalue's imaginary part relative to 1 + |x|^2: half the distance of the hidden angle from the real line. */
    gb_real depth;
} gb_six_candidate;

/* Candidates for solutions of one formulation. */
typedef struct {
    /* Candidates of single eigenvalues first, and of these the real ones. */
    gb_six_candidate list[GB_SIX_SIZE];
    size_t count;
    /* Whether some solutions were not separated, because both the hidden joint and the doubled one have equal values in them. */
    bool are_crowded;
    /* The smallest pivot, relative to the largest entry of the inverted matrix. */
    gb_real conditioning;
} gb_six_candidates;

/* The eigenvalue problem of one formulation at a target. */
typedef struct {
    const gb_chain *chain;
    gb_formulation formulation;
    gb_six_equations rows;
    gb_six_pencil pencil;
    gb_six_hessenberg form;
    gb_real origin;
    /* Eigenvalues closer than this, relative to `1 + |x|^2`, coincide. */
    gb_real coinciding;
} gb_six_problem;

/* Eigenvalues near the real line, real ones first. */
typedef struct {
    gb_six_eigenvalue list[GB_SIX_SIZE];
    size_t count;
    /* By eigenvalue, the index of the first one that coincides with it, which may be its own. */
    size_t first[GB_SIX_SIZE];
} gb_six_near_real;

/* Half of the doubled angle, or the arc tangent of its displacement. */
static gb_real gb_six_half_angle(const gb_real *wide, bool is_first)
{
    const gb_real first = gb_six_dot(wide, wide), last = gb_six_dot(wide + 9, wide + 9);
    return is_first ? gb_six_turn(first, gb_six_dot(wide + 3, wide)) : gb_six_turn(gb_six_dot(wide + 6, wide + 9), last);
}

/* The products of the far joints; `factor` is the factor of the eigenvector. */
static void gb_six_far(const gb_six_equations *rows, const gb_real *wide, gb_real c, gb_real s, gb_real factor, bool slides, const gb_real *near, gb_real *far)
{
    const gb_real scale = slides ? factor * (c * c) : factor;
    const size_t left = GB_SIX_FAR - rows->solved;
    gb_real values[GB_SIX_COLUMNS] = {R(0.0)}, known[GB_SIX_COLUMNS];
    memcpy(values, near, GB_SIX_PRODUCTS * sizeof *values);
    for (size_t k = 0; k < left; k++) {
        values[rows->order[rows->solved + k]] = (c * wide[GB_SIX_NEAR + k] + s * wide[GB_SIX_NEAR + left + k]) / scale;
    }
    memcpy(known, values, sizeof known);
    for (size_t k = 0; k < rows->solved; k++) {
        values[rows->order[k]] = -gb_six_product(rows->still[k].at, known, GB_SIX_COLUMNS);
    }
    memcpy(far, values + GB_SIX_PRODUCTS, GB_SIX_FAR * sizeof *far);
}

/* The products of the near joints: 1, c, s of an angle, or 1, d^2, d of a displacement, times the same of another. */
static void gb_six_near(const bool *slides, const gb_real *values, gb_real *products)
{
    gb_real factors[2][3], angles[GB_SIX_PADDED(2)] = {R(0.0)}, c[GB_SIX_PADDED(2)], s[GB_SIX_PADDED(2)];
    angles[0] = values[0];
    angles[1] = values[1];
    gb_six_turns(angles, 2, c, s);
    for (int k = 0; k < 2; k++) {
        factors[k][0] = R(1.0);
        factors[k][1] = slides[k] ? values[k] * values[k] : c[k];
        factors[k][2] = slides[k] ? values[k] : s[k];
    }
    for (int k = 0; k < GB_SIX_PRODUCTS; k++) {
        products[k] = factors[0][k / 3] * factors[1][k % 3];
    }
}

/* The angle or displacement of the hidden joint, given half of it. */
static gb_real gb_six_double(gb_real half, bool slides)
{
    return slides ? R(2.0) * (gb_sine(half) / gb_cosine(half)) : R(2.0) * half;
}

/* The joint values, given half the hidden angle and its eigenvector. */
static void gb_six_read(const gb_six_problem *problem, gb_real hidden, const gb_real *vector, gb_real *q)
{
    const gb_formulation formulation = problem->formulation;
    const size_t near = formulation.second ? 2 : 1, away = formulation.second ? 1 : 2;
    gb_real ordered[6], products[GB_SIX_PRODUCTS], far[GB_SIX_FAR], half[GB_SIX_PADDED(1)] = {R(0.0)}, c[GB_SIX_PADDED(1)], s[GB_SIX_PADDED(1)];
    gb_six_wide wide;
    bool slides[6];
    for (size_t steps = 0; steps < 6; steps++) {
        slides[steps] = problem->chain->slides[gb_six_joint(formulation, steps)];
    }
    gb_six_widen(&problem->pencil, vector, &wide);
    /* Whether the greatest monomial is the cube of the half angle's cosine, else that of its sine; the products of the other near joint there. */
    const bool is_first = gb_six_dot(wide.at, wide.at) >= gb_six_dot(wide.at + 9, wide.at + 9);
    const gb_real *head = is_first ? wide.at : wide.at + 9;
    half[0] = gb_six_half_angle(wide.at, is_first);
    gb_six_turns(half, 1, c, s);
    const gb_real unit = is_first ? c[0] : s[0], sign = gb_signed(R(1.0), head[0]);
    ordered[0] = gb_six_double(hidden, slides[0]);
    ordered[away] = slides[away] ? head[2] / head[0] : gb_six_turn(head[1] * sign, head[2] * sign);
    ordered[near] = slides[near] ? s[0] / c[0] : R(2.0) * half[0];
    ordered[3] = R(0.0);
    gb_six_near(slides + 1, ordered + 1, products);
    gb_six_far(&problem->rows, wide.at, c[0], s[0], head[0] / (unit * unit * unit), slides[near], products, far);
    ordered[4] = slides[4] ? -far[1] : -gb_six_turn(far[0], far[1]);
    ordered[5] = slides[5] ? -far[5] : -gb_six_turn(far[2], far[5]);
    for (size_t steps = 0; steps < 6; steps++) {
        q[gb_six_joint(formulation, steps)] = ordered[steps];
    }
}

/* Half the hidden angle, or the arc tangent of half the displacement. */
static gb_real gb_six_half(const gb_six_problem *problem, gb_six_eigenvalue value)
{
    return problem->origin + gb_angle(R(1.0), value.re + value.im);
}

/* Whether rounding may have split the two eigenvalues. */
static bool gb_six_coincide(gb_six_eigenvalue a, gb_six_eigenvalue b, gb_real coinciding)
{
    const bool is_close = gb_magnitude(a.re - b.re) <= coinciding * (R(1.0) + a.re * a.re + b.re * b.re);
    return is_close && gb_six_depth(a) <= coinciding && gb_six_depth(b) <= coinciding;
}

/* The eigenvalues at most `deepest` off the real line. */
static void gb_six_choose(const gb_six_problem *problem, const gb_six_eigenvalue *values, gb_real deepest, gb_six_near_real *near)
{
    const bool slides = problem->chain->slides[problem->formulation.hidden];
    near->count = 0;
    for (int is_complex = 0; is_complex < 2; is_complex++) {
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            if ((values[k].im != R(0.0)) == (is_complex == 1) && gb_six_depth(values[k]) <= deepest
                && !(slides && gb_six_is_infinite(gb_six_double(gb_six_half(problem, values[k]), true)))) {
                near->list[near->count++] = values[k];
            }
        }
    }
    for (size_t k = 0; k < near->count; k++) {
        size_t other = 0;
        while (other < k && !gb_six_coincide(near->list[other], near->list[k], problem->coinciding)) {
            other++;
        }
        near->first[k] = other < k ? near->first[other] : k;
    }
}

/* Number of eigenvalues that coincide with the one at an index, if none before it does. */
static size_t gb_six_size_of(const gb_six_near_real *near, size_t index)
{
    size_t size = 0;
    for (size_t k = 0; k < near->count; k++) {
        size += near->first[k] == index ? 1 : 0;
    }
    return size;
}

/* Adds the candidates of eigenvalues that coincide with no other one. */
static void gb_six_add_alone(const gb_six_problem *problem, const gb_six_near_real *near, gb_six_candidates *found)
{
    gb_six_eigenvalue alone[GB_SIX_SIZE] = {{R(0.0), R(0.0)}};
    gb_six_matrix vectors;
    for (size_t k = 0; k < near->count; k++) {
        if (gb_six_size_of(near, k) == 1) {
            alone[found->count] = near->list[k];
            found->list[found->count++].depth = gb_six_depth(near->list[k]);
        }
    }
    gb_six_eigenvectors(&problem->form, alone, found->count, &vectors);
    for (size_t k = 0; k < found->count; k++) {
        gb_six_read(problem, gb_six_half(problem, alone[k]), vectors.at[k], found->list[k].q);
    }
}

/* Adds the candidates of coincident eigenvalues; if these are not separated, a single one. */
static GB_COLD void gb_six_add_coinciding(const gb_six_problem *problem, const gb_six_near_real *near, gb_six_candidates *found)
{
    gb_six_cluster cluster;
    for (size_t k = 0; k < near->count; k++) {
        const gb_six_eigenvalue value = near->list[k];
        size_t size = gb_six_size_of(near, k);
        if (size < 2) {
            continue;
        }
        if (!gb_six_find_cluster(&problem->form, &problem->pencil, value.re, size, &cluster)) {
            gb_six_eigenvectors(&problem->form, &value, 1, &cluster.vectors);
            cluster.depths[0] = gb_six_depth(value);
            found->are_crowded = true;
            size = 1;
        }
        for (size_t i = 0; i < size; i++) {
            found->list[found->count].depth = cluster.depths[i];
            gb_six_read(problem, gb_six_half(problem, value), cluster.vectors.at[i], found->list[found->count++].q);
        }
    }
}

/* Candidates at a displacement, for eigenvalues at most `deepest` off the real line. Each attempt has another origin of the half angle. False when the
 * pencil is singular for this target, or not finite. */
static bool gb_six_find_candidates(const gb_chain *chain, const gb_rigid *displacement, size_t attempt, gb_real deepest, gb_six_candidates *found)
{
    gb_six_problem problem;
    gb_six_eigenvalue values[GB_SIX_SIZE];
    gb_six_near_real near;
    problem.chain = chain;
    problem.formulation = gb_six_formulation(chain, attempt);
    gb_six_equate(chain, problem.formulation, displacement, &problem.rows);
    if (!gb_six_make_pencil(&problem.rows, problem.formulation.second, chain->slides[gb_six_doubled(problem.formulation)], &problem.pencil)) {
        return false;
    }
    found->conditioning = gb_six_standardise(&problem.pencil, attempt, &problem.form.matrix, &problem.origin);
    if (!(found->conditioning > R(0.0))) {
        return false;
    }
    gb_six_reduce(&problem.form);
    if (!gb_six_eigenvalues(&problem.form, values)) {
        return false;
    }
    problem.coinciding = gb_square_root(GB_ACCEPTANCE_ROUNDING_EIGENVALUES / found->conditioning);
    gb_six_choose(&problem, values, deepest, &near);
    found->count = 0;
    found->are_crowded = false;
    gb_six_add_alone(&problem, &near, found);
    if (found->count < near.count) {
        gb_six_add_coinciding(&problem, &near, found);
    }
    return true;
}

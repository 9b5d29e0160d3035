/* From the pencil to joint angles: eigenvalues, eigenvectors, back-substitution: candidates.rs */

/* The joint values of a candidate for a solution; that of the joint whose line was used is still missing, and a way may be infinite. */
typedef struct {
    gb_real q[6];
    /* The size of the eigenvalue's imaginary part as a share of 1 + |x|^2: half the way off the real line of the hidden angle. */
    gb_real depth;
} gb_six_candidate;

/* Candidates for solutions of one formulation. */
typedef struct {
    /* Those of real eigenvalues first. */
    gb_six_candidate list[GB_SIX_SIZE];
    size_t count;
    bool are_crowded;
    /* The smallest share of a pivot in the largest entry of the matrix that was inverted. */
    gb_real conditioning;
} gb_six_candidates;

/* Half of the doubled angle, and the products of the other near joint at the greatest monomial: multiples of 1, c, s. */
static gb_real gb_six_half_angle(const gb_real *wide, const gb_real **head)
{
    const gb_real first = gb_six_dot(wide, wide), last = gb_six_dot(wide + 9, wide + 9);
    *head = first >= last ? wide : wide + 9;
    return first >= last ? gb_six_turn(first, gb_six_dot(wide + 3, wide)) : gb_six_turn(gb_six_dot(wide + 6, wide + 9), last);
}

/* The products of the far joints; `head` is the first one of the doubled joint's monomials there. */
static void gb_six_far(const gb_six_equations *rows, const gb_real *wide, gb_real c, gb_real s, gb_real head, bool slides, const gb_real *near, gb_real *far)
{
    const gb_real over = gb_magnitude(c) >= gb_magnitude(s) ? head / (c * c * c) : head / (s * s * s), scale = slides ? over * (c * c) : over;
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

/* 1, c, s of an angle, or 1, d^2, d of a way, times the same of another: the products of the near joints. */
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

/* The joint values, given half the hidden angle and its eigenvector. */
static void gb_six_read(const gb_chain *chain, gb_formulation formulation, const gb_six_equations *rows, const gb_six_pencil *pencil, gb_real hidden,
                        const gb_real *vector, gb_real *q)
{
    const size_t near = formulation.second ? 2 : 1, away = formulation.second ? 1 : 2;
    gb_real ordered[6], products[GB_SIX_PRODUCTS], far[GB_SIX_FAR], half[GB_SIX_PADDED(1)] = {R(0.0)}, c[GB_SIX_PADDED(1)], s[GB_SIX_PADDED(1)];
    const gb_real *head;
    gb_six_wide wide;
    bool slides[6];
    for (size_t steps = 0; steps < 6; steps++) {
        slides[steps] = chain->slides[gb_six_joint(formulation, steps)];
    }
    gb_six_widen(pencil, vector, &wide);
    half[0] = gb_six_half_angle(wide.at, &head);
    gb_six_turns(half, 1, c, s);
    const gb_real sign = gb_signed(R(1.0), head[0]);
    ordered[0] = slides[0] ? R(2.0) * (gb_sine(hidden) / gb_cosine(hidden)) : R(2.0) * hidden;
    ordered[away] = slides[away] ? head[2] / head[0] : gb_six_turn(head[1] * sign, head[2] * sign);
    ordered[near] = slides[near] ? s[0] / c[0] : R(2.0) * half[0];
    ordered[3] = R(0.0);
    gb_six_near(slides + 1, ordered + 1, products);
    gb_six_far(rows, wide.at, c[0], s[0], head[0], slides[near], products, far);
    ordered[4] = slides[4] ? -far[1] : -gb_six_turn(far[0], far[1]);
    ordered[5] = slides[5] ? -far[5] : -gb_six_turn(far[2], far[5]);
    for (size_t steps = 0; steps < 6; steps++) {
        q[gb_six_joint(formulation, steps)] = ordered[steps];
    }
}

/* The eigenvalues no farther off the real line than `deepest`, real ones first, how far off they are, and their number. */
static size_t gb_six_choose(const gb_six_eigenvalue *values, gb_real deepest, gb_six_eigenvalue *chosen, gb_six_candidate *list)
{
    size_t count = 0;
    for (int is_complex = 0; is_complex < 2; is_complex++) {
        for (int k = 0; k < GB_SIX_SIZE; k++) {
            const gb_real re = values[k].re, im = values[k].im, depth = gb_magnitude(im) / (R(1.0) + re * re + im * im);
            if ((im != R(0.0)) == (is_complex == 1) && depth <= deepest) {
                chosen[count] = values[k];
                list[count++].depth = depth;
            }
        }
    }
    return count;
}

/* Candidates at a displacement, of eigenvalues no farther off the real line than `deepest`; each attempt begins with another origin of the half angle. False
 * when the pencil is singular for this target, or not finite. */
static bool gb_six_find_candidates(const gb_chain *chain, const gb_rigid *displacement, size_t attempt, gb_real deepest, gb_six_candidates *found)
{
    const gb_formulation formulation = gb_six_formulation(chain, attempt);
    gb_six_equations rows;
    gb_six_pencil pencil;
    gb_six_hessenberg form;
    gb_six_matrix vectors;
    gb_six_eigenvalue values[GB_SIX_SIZE], chosen[GB_SIX_SIZE];
    gb_real origin = R(0.0);
    gb_six_equate(chain, formulation, displacement, &rows);
    if (!gb_six_make_pencil(&rows, formulation.second, chain->slides[gb_six_doubled(formulation)], &pencil)) {
        return false;
    }
    found->conditioning = gb_six_standardise(&pencil, attempt, &form.matrix, &origin);
    if (!(found->conditioning > R(0.0))) {
        return false;
    }
    gb_six_reduce(&form);
    if (!gb_six_eigenvalues(&form, values)) {
        return false;
    }
    found->count = gb_six_choose(values, deepest, chosen, found->list);
    found->are_crowded = gb_six_are_crowded(values);
    gb_six_eigenvectors(&form, chosen, found->count, &vectors);
    for (size_t k = 0; k < found->count; k++) {
        const gb_real half = origin + gb_angle(R(1.0), chosen[k].re + chosen[k].im);
        gb_six_read(chain, formulation, &rows, &pencil, half, vectors.at[k], found->list[k].q);
    }
    return true;
}

/* The Jacobian next to a curve on which the target is nearly reached: see section.rs
 *
 * Bordering: A. Griewank and G. W. Reddien, SIAM J. Numerical Analysis 21 (1984) 176-185. */

/* A place on a curve, and the Jacobian there, split into five directions that change the pose and one that changes it very little. */
typedef struct {
    gb_real q[6];
    /* The shortest step after which only `value` remains of the residual, to first order. */
    gb_real step[6];
    /* The unit tangent of the curve. */
    gb_real along[6];
    /* The unit combination of equations that no joint changes. */
    gb_real across[6];
    /* The residual of that combination. */
    gb_real value;
    /* The derivative of that combination along the tangent, approximately the least singular value. */
    gb_real slope;
} gb_six_point;

/* The Jacobian after five steps of elimination, with the factors below its diagonal, and the residual. */
typedef struct {
    gb_real matrix[6][6];
    gb_real right[6];
    /* The order of the rows, which were exchanged. */
    size_t rows[6];
    /* The order of the columns, which were not moved. */
    size_t columns[6];
} gb_six_cut;

/* Exchanges rows and columns so that the largest entry is at `k`. Returns its magnitude. */
GB_INLINE gb_real gb_six_bring(gb_six_cut *cut, size_t k)
{
    gb_real most = R(0.0), row_of[6];
    size_t row = k, place = k;
    for (size_t i = k; i < 6; i++) {
        for (size_t j = k; j < 6; j++) {
            const gb_real entry = gb_magnitude(cut->matrix[i][cut->columns[j]]);
            if (entry > most) {
                most = entry;
                row = i;
                place = j;
            }
        }
    }
    const gb_real right = cut->right[row];
    const size_t number = cut->rows[row], column = cut->columns[place];
    memcpy(row_of, cut->matrix[row], sizeof row_of);
    memcpy(cut->matrix[row], cut->matrix[k], sizeof row_of);
    memcpy(cut->matrix[k], row_of, sizeof row_of);
    cut->right[row] = cut->right[k];
    cut->right[k] = right;
    cut->rows[row] = cut->rows[k];
    cut->rows[k] = number;
    cut->columns[place] = cut->columns[k];
    cut->columns[k] = column;
    return most;
}

/* Gauss elimination with complete pivoting; false where more than one direction changes the pose very little. */
static bool gb_six_eliminate_cut(gb_six_cut *cut)
{
    gb_real first = R(0.0);
    for (size_t k = 0; k < 5; k++) {
        const gb_real most = gb_six_bring(cut, k), *pivot = cut->matrix[k];
        const size_t column = cut->columns[k];
        first = k == 0 ? most : first;
        if (most <= GB_PIVOTS_WEAK_CURVE * first || !gb_six_is_finite(most)) {
            return false;
        }
        for (size_t i = k + 1; i < 6; i++) {
            const gb_real factor = cut->matrix[i][column] / pivot[column];
            for (size_t j = k + 1; j < 6; j++) {
                cut->matrix[i][cut->columns[j]] -= factor * pivot[cut->columns[j]];
            }
            cut->matrix[i][column] = factor;
            cut->right[i] -= factor * cut->right[k];
        }
    }
    return true;
}

/* The combination of equations that contains no joint; the coefficient of the last one is one. */
GB_INLINE void gb_six_sum_across(const gb_six_cut *cut, gb_real *across)
{
    across[cut->rows[5]] = R(1.0);
    for (size_t k = 5; k-- > 0;) {
        gb_real sum = R(-0.0);
        for (size_t i = k + 1; i < 6; i++) {
            sum += cut->matrix[i][cut->columns[k]] * across[cut->rows[i]];
        }
        across[cut->rows[k]] = -sum;
    }
}

/* The joint values that solve five equations, given the last joint. */
GB_INLINE void gb_six_substitute(const gb_six_cut *cut, const gb_real *right, gb_real last, gb_real *x)
{
    x[cut->columns[5]] = last;
    for (size_t k = 5; k-- > 0;) {
        gb_real known = R(-0.0);
        for (size_t j = k + 1; j < 6; j++) {
            known += cut->matrix[k][cut->columns[j]] * x[cut->columns[j]];
        }
        x[cut->columns[k]] = (right[k] - known) / cut->matrix[k][cut->columns[k]];
    }
}

/* The section at a place's joints; false where more than one direction changes the pose very little. */
static bool gb_six_section(const gb_chain *chain, const gb_rigid *target, gb_six_point *at)
{
    static const gb_real zero[6] = {R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)};
    gb_six_reach reach;
    gb_six_cut cut;
    gb_six_find_reach(chain, at->q, &reach);
    gb_six_find_miss(&reach, target, cut.right);
    for (size_t joint = 0; joint < 6; joint++) {
        gb_real column[6];
        gb_six_derivatives(chain, &reach, joint, column);
        for (int k = 0; k < 6; k++) {
            cut.matrix[k][joint] = column[k];
        }
        cut.rows[joint] = cut.columns[joint] = joint;
    }
    if (!gb_six_eliminate_cut(&cut)) {
        return false;
    }
    gb_six_sum_across(&cut, at->across);
    gb_six_substitute(&cut, zero, R(1.0), at->along);
    gb_six_substitute(&cut, cut.right, R(0.0), at->step);
    const gb_real width = gb_six_norm(at->across), length = gb_six_norm(at->along);
    for (int k = 0; k < 6; k++) {
        at->across[k] = at->across[k] / width;
        at->along[k] = at->along[k] / length;
    }
    const gb_real share = gb_six_product(at->step, at->along, 6);
    for (int k = 0; k < 6; k++) {
        at->step[k] -= share * at->along[k];
    }
    at->value = cut.right[5] / width;
    at->slope = gb_magnitude(cut.matrix[5][cut.columns[5]]) / (width * length);
    return true;
}

/* Whether a curve is here. */
static bool gb_six_is_near(const gb_six_point *at)
{
    return at->slope <= GB_SELF_MOTIONS_FLAT_NEAR && gb_magnitude(at->value) <= GB_STRATA_NEAR_CURVE;
}

/* Makes the signs of the directions consistent with another place's. */
static void gb_six_align(gb_six_point *at, const gb_six_point *other)
{
    const bool is_back = gb_six_product(at->along, other->along, 6) < R(0.0), is_under = gb_six_product(at->across, other->across, 6) < R(0.0);
    for (int k = 0; k < 6; k++) {
        at->along[k] = is_back ? -at->along[k] : at->along[k];
        at->across[k] = is_under ? -at->across[k] : at->across[k];
    }
    at->value = is_under ? -at->value : at->value;
}

/* Takes at most `rounds` steps across the curve from a place's joints. Returns whether they converge. */
static bool gb_six_settle(const gb_chain *chain, const gb_rigid *target, gb_six_point *at, int rounds)
{
    for (int round = 0; round < rounds; round++) {
        if (!gb_six_section(chain, target, at)) {
            return false;
        }
        const gb_real longest = gb_six_size(at->step), share = longest > GB_SIX_LONGEST ? GB_SIX_LONGEST / longest : R(1.0);
        if (!gb_six_is_finite(longest) || (round >= GB_SIX_EARLY && at->slope > GB_SELF_MOTIONS_FLAT)) {
            return false;
        }
        for (int k = 0; k < 6; k++) {
            at->q[k] += share * at->step[k];
        }
        if (longest <= GB_POLISHING_STEP) {
            return gb_six_section(chain, target, at) && gb_six_is_near(at);
        }
    }
    return false;
}

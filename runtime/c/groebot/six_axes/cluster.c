/* Coincident eigenvalues: solutions with equal values of the hidden joint, separated by the doubled joint: see cluster.rs */

/* The solutions of coincident eigenvalues: their eigenvectors, in the first rows, and the depths of their tangents. */
typedef struct {
    gb_six_matrix vectors;
    gb_real depths[GB_SIX_SIZE];
} gb_six_cluster;

/* The distance of an eigenvalue from the real line, relative to 1 + |x|^2. */
GB_INLINE gb_real gb_six_depth(gb_six_eigenvalue value)
{
    return gb_magnitude(value.im) / (R(1.0) + value.re * value.re + value.im * value.im);
}

/* Gram-Schmidt orthonormalisation, applied twice; false where vectors are linearly dependent. */
static bool gb_six_orthonormalise(gb_six_matrix *basis, size_t count)
{
    for (size_t j = 0; j < count; j++) {
        gb_real *vector = basis->at[j];
        for (size_t other = 0; other < 2 * j; other++) {
            const gb_real *known = basis->at[other % j], share = gb_six_product(known, vector, GB_SIX_SIZE);
            for (size_t k = 0; k < GB_SIX_SIZE; k++) {
                vector[k] -= share * known[k];
            }
        }
        const gb_real inverse = R(1.0) / gb_square_root(gb_six_product(vector, vector, GB_SIX_SIZE));
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            vector[k] *= inverse;
        }
        if (!gb_six_is_finite(inverse)) {
            return false;
        }
    }
    return true;
}

/* Replaces `y` by `Q y`. */
static void gb_six_turn_back_one(const gb_six_hessenberg *form, gb_real *y)
{
    for (size_t column = GB_SIX_SIZE - 2; column-- > 0;) {
        const gb_real *v = form->reflectors.at[column], share = gb_six_product(v, y, GB_SIX_SIZE);
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            y[k] -= share * v[k];
        }
    }
}

/* Entry k of the Walsh function j: orthogonal functions, and no entry is zero. */
static gb_real gb_six_walsh(size_t j, size_t k)
{
    size_t bits = j & k, odd = 0;
    for (; bits > 0; bits >>= 1) {
        odd ^= bits & 1;
    }
    return odd == 0 ? R(1.0) : -R(1.0);
}

/* An orthonormal basis of the space of `count` eigenvectors for eigenvalues at x; false where there is none. */
static bool gb_six_find_basis(const gb_six_hessenberg *form, gb_real x, size_t count, gb_six_matrix *basis)
{
    const gb_real shifted = x + GB_EIGENVALUES_SHIFT * (R(1.0) + gb_magnitude(x));
    for (size_t j = 0; j < GB_SIX_SIZE; j++) {
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            basis->at[j][k] = gb_six_walsh(j, k);
        }
    }
    for (int round = 0; round < GB_SIX_CLUSTER_ROUNDS; round++) {
        gb_real rows[GB_SIX_SIZE][2 * GB_SIX_SIZE] = {{R(0.0)}}, largest = R(0.0);
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            memcpy(rows[k], form->matrix.at[k], sizeof form->matrix.at[k]);
            rows[k][k] -= shifted;
            largest = gb_six_largest(largest, rows[k], GB_SIX_SIZE);
            for (size_t j = 0; j < count; j++) {
                rows[k][GB_SIX_SIZE + j] = basis->at[j][k];
            }
        }
        if (gb_six_solve(rows[0], GB_SIX_SIZE, 2 * GB_SIX_SIZE, largest) <= R(0.0)) {
            return false;
        }
        for (size_t j = 0; j < GB_SIX_SIZE; j++) {
            for (size_t k = 0; k < GB_SIX_SIZE; k++) {
                basis->at[j][k] = rows[k][GB_SIX_SIZE + j];
            }
        }
        if (!gb_six_orthonormalise(basis, count)) {
            return false;
        }
    }
    for (size_t j = 0; j < count; j++) {
        gb_six_turn_back_one(form, basis->at[j]);
    }
    return true;
}

/* The matrix, in a basis, of multiplication by the tangent, by least squares. Rows and columns from `count` on are zero. False where the monomials do not
 * determine it. */
static bool gb_six_find_tangents(const gb_six_wide *basis, size_t count, gb_six_matrix *tangents)
{
    const gb_real c = gb_cosine(GB_SIX_CLUSTER_ORIGIN), s = gb_sine(GB_SIX_CLUSTER_ORIGIN);
    gb_real rows[GB_SIX_SIZE][2 * GB_SIX_SIZE] = {{R(0.0)}}, largest = R(0.0);
    for (size_t i = 0; i < GB_SIX_SIZE; i++) {
        rows[i][i] = i < count ? R(0.0) : R(1.0);
        for (size_t j = 0; j < count && i < count; j++) {
            const gb_real *a = basis[i].at, *b = basis[j].at;
            for (size_t k = 0; k < GB_SIX_NEAR - 3; k++) {
                const gb_real across = c * a[k] + s * a[k + 3];
                rows[i][j] += across * (c * b[k] + s * b[k + 3]);
                rows[i][GB_SIX_SIZE + j] += across * (c * b[k + 3] - s * b[k]);
            }
        }
        largest = gb_six_largest(largest, rows[i], GB_SIX_SIZE);
    }
    if (!(gb_six_solve(rows[0], GB_SIX_SIZE, 2 * GB_SIX_SIZE, largest) >= GB_PIVOTS_SINGULAR_TANGENTS)) {
        return false;
    }
    for (size_t i = 0; i < GB_SIX_SIZE; i++) {
        memcpy(tangents->at[i], rows[i] + GB_SIX_SIZE, sizeof tangents->at[i]);
    }
    return true;
}

/* Whether all tangents are distinct within the tolerance. */
static bool gb_six_are_separate(const gb_six_eigenvalue *values, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        for (size_t i = 0; i < k; i++) {
            const gb_six_eigenvalue a = values[k], b = values[i];
            const gb_real distance = gb_magnitude(a.re - b.re) + gb_magnitude(a.im - b.im);
            if (distance <= GB_MERGING_APART_TANGENTS * (R(1.0) + a.re * a.re + b.re * b.re)) {
                return false;
            }
        }
    }
    return true;
}

/* The solutions of `count` eigenvalues at x; false where the doubled joint does not separate them. */
static GB_COLD bool gb_six_find_cluster(const gb_six_hessenberg *form, const gb_six_pencil *pencil, gb_real x, size_t count, gb_six_cluster *cluster)
{
    gb_six_matrix basis, shares;
    gb_six_wide wide[GB_SIX_SIZE];
    gb_six_hessenberg small;
    gb_six_eigenvalue values[GB_SIX_SIZE];
    if (!gb_six_find_basis(form, x, count, &basis)) {
        return false;
    }
    for (size_t j = 0; j < count; j++) {
        gb_six_widen(pencil, basis.at[j], &wide[j]);
    }
    if (!gb_six_find_tangents(wide, count, &small.matrix)) {
        return false;
    }
    gb_six_reduce(&small);
    if (!gb_six_eigenvalues(&small, values) || !gb_six_are_separate(values, count)) {
        return false;
    }
    gb_six_eigenvectors(&small, values, count, &shares);
    for (size_t i = 0; i < count; i++) {
        cluster->depths[i] = gb_six_depth(values[i]);
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            gb_real sum = R(0.0);
            for (size_t j = 0; j < count; j++) {
                sum += shares.at[i][j] * basis.at[j][k];
            }
            cluster->vectors.at[i][k] = sum;
        }
    }
    return true;
}

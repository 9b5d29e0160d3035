/* All eigenvalues of a Hessenberg matrix by implicit double-shift QR steps (Golub and Van Loan, Algorithms 7.5.1 and 7.5.2): see shifted_qr.rs
 *
 * Only eigenvalues are computed, so rows and columns outside the active block are not updated. (J. G. F. Francis, The QR transformation, Computer Journal 4
 * (1961/62) 265-271 and 332-345.) */

/* An eigenvalue of a real matrix; im is exactly zero when it is real. */
typedef struct {
    gb_real re;
    gb_real im;
} gb_six_eigenvalue;

/* The first row of the irreducible block that ends at row `high`; a negligible subdiagonal entry is set to zero. */
GB_INLINE size_t gb_six_start_of_block(gb_six_matrix *h, size_t high)
{
    for (size_t row = high; row > 0; row--) {
        const gb_real entry = gb_magnitude(h->at[row][row - 1]);
        const gb_real size = gb_magnitude(h->at[row][row]) + gb_magnitude(h->at[row - 1][row - 1]);
        if (entry <= GB_EPSILON * size || entry < GB_LEAST_POSITIVE) {
            h->at[row][row - 1] = R(0.0);
            return row;
        }
    }
    return 0;
}

/* The eigenvalues of the 2x2 block whose first row is `low`, without cancellation. */
static void gb_six_pair(const gb_six_matrix *h, size_t low, gb_six_eigenvalue *pair)
{
    const gb_real a = h->at[low][low], b = h->at[low][low + 1], c = h->at[low + 1][low], d = h->at[low + 1][low + 1];
    const gb_real half = R(0.5) * (a - d), discriminant = half * half + b * c;
    if (discriminant < R(0.0)) {
        pair[0].re = pair[1].re = R(0.5) * (a + d);
        pair[0].im = gb_square_root(-discriminant);
        pair[1].im = -pair[0].im;
        return;
    }
    const gb_real sum = half + gb_signed(gb_square_root(discriminant), half);
    pair[0].re = d + sum;
    pair[1].re = sum == R(0.0) ? d : d - b * c / sum;
    pair[0].im = pair[1].im = R(0.0);
}

/* The non-zero entries of the first column of (H - a)(H - b) for two shifts. These are the eigenvalues of the last 2x2 block, or numbers of the magnitude of
 * the last subdiagonal entries. */
GB_INLINE void gb_six_first_column(const gb_six_matrix *h, size_t low, size_t high, bool is_exceptional, gb_real *column)
{
    const size_t m = high, i = low;
    gb_real sum = h->at[m - 1][m - 1] + h->at[m][m];
    gb_real product = h->at[m - 1][m - 1] * h->at[m][m] - h->at[m - 1][m] * h->at[m][m - 1];
    if (is_exceptional) {
        const gb_real size = gb_magnitude(h->at[m][m - 1]) + gb_magnitude(h->at[m - 1][m - 2]), centre = h->at[m][m] + R(0.75) * size;
        sum = R(2.0) * centre;
        product = centre * centre + R(0.4375) * size * size;
    }
    column[0] = h->at[i][i] * (h->at[i][i] - sum) + product + h->at[i][i + 1] * h->at[i + 1][i];
    column[1] = h->at[i + 1][i] * (h->at[i][i] + h->at[i + 1][i + 1] - sum);
    column[2] = h->at[i + 1][i] * h->at[i + 2][i + 1];
}

/* Reflects `count` rows from `top` on by 1 - u w^T, in columns in groups of four. Columns after the block may change freely, and those before `top` are
 * overwritten. */
GB_INLINE void gb_six_reflect_rows(gb_six_matrix *h, size_t high, size_t top, size_t count, const gb_real *u, const gb_real *w)
{
    gb_real *first = h->at[top], *second = h->at[top + 1], *third = h->at[top + count - 1];
    for (size_t i = top / 4 * 4; i <= high; i += GB_SIX_LANES) {
        const gb_six_lanes x = gb_six_load(first + i), y = gb_six_load(second + i), z = gb_six_load(third + i);
        const gb_six_lanes share = count == 3 ? w[0] * x + w[1] * y + w[2] * z : w[0] * x + w[1] * y;
        gb_six_store(first + i, x - share);
        gb_six_store(second + i, y - share * u[1]);
        if (count == 3) {
            gb_six_store(third + i, z - share * u[2]);
        }
    }
}

/* Reflects columns in this manner. */
GB_INLINE void gb_six_reflect_columns(gb_six_matrix *h, size_t low, size_t high, size_t top, size_t count, const gb_real *u, const gb_real *w)
{
    const size_t last = top + 3 < high ? top + 3 : high;
    for (size_t row = low; row <= last; row++) {
        gb_real *entries = h->at[row] + top;
        const gb_real x = entries[0], y = entries[1], z = entries[count - 1];
        const gb_real share = count == 3 ? w[0] * x + w[1] * y + w[2] * z : w[0] * x + w[1] * y;
        entries[0] = x - share;
        entries[1] = y - share * u[1];
        if (count == 3) {
            entries[2] = z - share * u[2];
        }
    }
}

/* Reflects two or three rows and columns from `top` on so that `column`, which is left of them, becomes a multiple of its first unit vector. The reflection
 * is 1 - u w^T, where the first entry of u is one, and w is a multiple of u. */
GB_INLINE void gb_six_chase(gb_six_matrix *h, size_t low, size_t high, size_t top, size_t count, const gb_real *column)
{
    const gb_real square = gb_six_product(column, column, count), length = gb_signed(gb_square_root(square), column[0]);
    if (square >= GB_ROOTS_ZERO_COLUMN) {
        const gb_real head = column[0] + length, share = R(1.0) + column[0] / length;
        gb_real u[3] = {R(1.0), R(0.0), R(0.0)}, w[3] = {share, R(0.0), R(0.0)};
        for (size_t k = 1; k < count; k++) {
            u[k] = column[k] / head;
            w[k] = u[k] * share;
        }
        gb_six_reflect_rows(h, high, top, count, u, w);
        gb_six_reflect_columns(h, low, high, top, count, u, w);
    }
    if (top > low) {
        h->at[top][top - 1] = -length;
        for (size_t k = 1; k < count; k++) {
            h->at[top + k][top - 1] = R(0.0);
        }
    }
}

/* One double step on rows and columns `low` to `high`: the bulge that the shifts create at the top is chased to the bottom. */
static void gb_six_step(gb_six_matrix *h, size_t low, size_t high, bool is_exceptional)
{
    gb_real column[3];
    gb_six_first_column(h, low, high, is_exceptional, column);
    for (size_t top = low; top + 1 < high; top++) {
        for (size_t k = 0; k < 3 && top > low; k++) {
            column[k] = h->at[top + k][top - 1];
        }
        gb_six_chase(h, low, high, top, 3, column);
    }
    column[0] = h->at[high - 1][high - 2];
    column[1] = h->at[high][high - 2];
    gb_six_chase(h, low, high, high - 1, 2, column);
}

/* All eigenvalues, complex ones in conjugate pairs. False when an entry is not finite or the iteration does not converge, which is not known to happen. */
static bool gb_six_eigenvalues(const gb_six_hessenberg *form, gb_six_eigenvalue *found)
{
    gb_six_matrix h = form->matrix;
    size_t left = GB_SIX_SIZE, steps = 0;
    bool is_finite = true;
    while (left > 0) {
        const size_t low = gb_six_start_of_block(&h, left - 1);
        if (left - low > 2) {
            if (++steps > GB_SIX_QR_STEPS) {
                return false;
            }
            gb_six_step(&h, low, left - 1, steps % 10 == 0);
            continue;
        }
        if (left - low == 2) {
            gb_six_pair(&h, low, &found[low]);
        } else {
            found[low].re = h.at[low][low];
            found[low].im = R(0.0);
        }
        left = low;
        steps = 0;
    }
    for (int k = 0; k < GB_SIX_SIZE; k++) {
        is_finite = is_finite && gb_six_is_finite(found[k].re) && gb_six_is_finite(found[k].im);
    }
    return is_finite;
}

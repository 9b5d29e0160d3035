/* Dense linear equations of fixed size by Gauss elimination with partial pivoting (Golub and Van Loan, Algorithm 3.4.1): see linear.rs */

/* The row from `k` on with the largest entry in column `k`. */
GB_INLINE size_t gb_six_pivot(const gb_real *rows, size_t k, size_t size, size_t width)
{
    size_t best = k;
    gb_real most = gb_magnitude(rows[k * width + k]);
    for (size_t row = k + 1; row < size; row++) {
        const gb_real entry = gb_magnitude(rows[row * width + k]);
        best = entry > most ? row : best;
        most = gb_larger(most, entry);
    }
    return best;
}

GB_INLINE void gb_six_exchange(gb_real *a, gb_real *b, size_t count)
{
    for (size_t i = 0; i < count; i += GB_SIX_LANES) {
        const gb_six_lanes entries = gb_six_load(a + i);
        gb_six_store(a + i, gb_six_load(b + i));
        gb_six_store(b + i, entries);
    }
}

/* Solves L X = R in place: `rows` has the `size` columns of L, then those of R. All `width` columns fill whole registers. R becomes X, and L is destroyed.
 * Returns the smallest pivot relative to the largest entry of L. It is zero when L is singular or not finite; R is then undefined. */
GB_INLINE gb_real gb_six_solve(gb_real *rows, size_t size, size_t width, gb_real largest)
{
    gb_real least = largest, inverses[GB_SIX_SIZE];
    for (size_t k = 0; k < size; k++) {
        gb_real *pivot = rows + k * width;
        const size_t best = gb_six_pivot(rows, k, size, width);
        const gb_real most = gb_magnitude(rows[best * width + k]);
        if (most <= R(0.0) || !gb_six_is_finite(most)) {
            return R(0.0);
        }
        least = gb_smaller(least, most);
        gb_six_exchange(pivot, rows + best * width, width);
        inverses[k] = R(1.0) / pivot[k];
        for (gb_real *row = pivot + width; row < rows + size * width; row += width) {
            gb_six_subtract(row, row[k] * inverses[k], pivot, (k + 1) / GB_SIX_LANES * GB_SIX_LANES, width);
        }
    }
    for (size_t k = size; k-- > 0;) {
        gb_real *pivot = rows + k * width;
        for (size_t i = size; i < width; i++) {
            pivot[i] *= inverses[k];
        }
        for (gb_real *row = rows; row < pivot; row += width) {
            for (size_t i = size; i < width; i++) {
                row[i] -= row[k] * pivot[i];
            }
        }
    }
    return least / largest;
}

/* B^-1 A for an origin of the half angle. Returns the conditioning of B. */
static gb_real gb_six_invert(const gb_six_pencil *pencil, gb_real origin, gb_real rows[GB_SIX_SIZE][2 * GB_SIX_SIZE])
{
    const gb_six_lanes c = gb_six_of(gb_cosine(origin)), s = gb_six_of(gb_sine(origin));
    gb_real largest = R(0.0);
    for (size_t i = 0; i < GB_SIX_SIZE; i++) {
        for (size_t j = 0; j < GB_SIX_SIZE; j += GB_SIX_LANES) {
            const gb_six_lanes a = gb_six_load(pencil->constant.at[i] + j), b = gb_six_load(pencil->linear.at[i] + j);
            gb_six_store(rows[i] + j, s * a + c * b);
            gb_six_store(rows[i] + GB_SIX_SIZE + j, c * a - s * b);
        }
        largest = gb_six_largest(largest, rows[i], GB_SIX_SIZE);
    }
    return gb_six_solve(rows[0], GB_SIX_SIZE, 2 * GB_SIX_SIZE, largest);
}

/* The matrix for the first origin whose B is well conditioned, or for the best one, and that origin. Returns the conditioning, zero where all are singular. */
static gb_real gb_six_standardise(const gb_six_pencil *pencil, size_t attempt, gb_six_matrix *matrix, gb_real *origin)
{
    gb_real conditioning = R(0.0), rows[GB_SIX_SIZE][2 * GB_SIX_SIZE];
    for (size_t index = 0; index < GB_SIX_ORIGINS && !(conditioning >= GB_ROOTS_PIVOT_ORIGIN); index++) {
        const gb_real other = gb_six_origins[(attempt + index) % GB_SIX_ORIGINS], share = gb_six_invert(pencil, other, rows);
        if (share > conditioning) {
            conditioning = share;
            *origin = other;
            for (size_t i = 0; i < GB_SIX_SIZE; i++) {
                memcpy(matrix->at[i], rows[i] + GB_SIX_SIZE, sizeof matrix->at[i]);
            }
        }
    }
    return conditioning;
}

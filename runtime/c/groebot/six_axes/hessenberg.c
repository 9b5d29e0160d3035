/* Reduction of a matrix to Hessenberg form by Householder reflections (Golub and Van Loan, Algorithm 7.4.2): see hessenberg.rs */

/* `A = Q H Q^T` with `H` zero below its first subdiagonal and `Q` orthogonal. */
typedef struct {
    /* `H`, by rows. */
    gb_six_matrix matrix;
    /* `Q = P_0 P_1 ...` with `P_k = 1 - v v^T`: row `k` is `v`, of length `sqrt(2)`, or zero where no reflection is needed. */
    gb_six_matrix reflectors;
} gb_six_hessenberg;

/* The scalar product of columns from `first` on, which begins a group of four, in four independent partial sums. */
GB_INLINE gb_real gb_six_long_dot(const gb_real *a, const gb_real *b, size_t first)
{
    gb_real sums[4] = {R(0.0), R(0.0), R(0.0), R(0.0)};
    GB_UNROLL
    for (int lane = 0; lane < 4; lane += GB_SIX_LANES) {
        gb_six_lanes sum = gb_six_load(sums + lane);
        for (size_t i = first + (size_t)lane; i < GB_SIX_SIZE; i += 4) {
            sum = sum + gb_six_load(a + i) * gb_six_load(b + i);
        }
        gb_six_store(sums + lane, sum);
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/* The vector v, of length sqrt(2), whose reflection eliminates the entries below the subdiagonal in a column; false where no reflection is needed. */
static bool gb_six_reflector(const gb_six_matrix *h, size_t column, gb_real *v)
{
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        v[k] = k > column ? h->at[k][column] : R(0.0);
    }
    const gb_real square = gb_six_long_dot(v, v, 0), head = v[column + 1];
    if (square - head * head <= R(0.0)) {
        return false;
    }
    v[column + 1] += gb_signed(gb_square_root(square), head);
    const gb_real scale = gb_square_root(R(2.0) / gb_six_long_dot(v, v, 0));
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        v[k] *= scale;
    }
    return gb_six_is_finite(scale);
}

/* The sum of rows after `column`, each times its number in v, in a group of four columns. */
GB_INLINE void gb_six_sum_rows(const gb_six_matrix *h, const gb_real *v, size_t column, size_t group, gb_real *sum)
{
    gb_six_lanes sums[4 / GB_SIX_LANES];
    GB_UNROLL
    for (int part = 0; part < 4 / GB_SIX_LANES; part++) {
        sums[part] = gb_six_of(R(0.0));
    }
    for (size_t row = column + 1; row < GB_SIX_SIZE; row++) {
        GB_UNROLL
        for (int part = 0; part < 4 / GB_SIX_LANES; part++) {
            sums[part] = sums[part] + v[row] * gb_six_load(h->at[row] + group + part * GB_SIX_LANES);
        }
    }
    memcpy(sum + group, sums, sizeof sums);
}

/* `H := P H P`: from the left on rows, and from the right on columns after `column`. The left product acts on groups of four columns, and the first group
 * begins at `column` or before. There only `column` itself changes, because all columns before it are zero. */
GB_INLINE void gb_six_reflect(gb_six_matrix *h, const gb_real *v, size_t column)
{
    const size_t first = column / 4 * 4, behind = (column + 1) / 4 * 4;
    gb_real sum[GB_SIX_SIZE];
    for (size_t i = first; i < GB_SIX_SIZE; i += 4) {
        gb_six_sum_rows(h, v, column, i, sum);
    }
    for (size_t row = 0; row < GB_SIX_SIZE; row++) {
        if (v[row] != R(0.0)) {
            gb_six_subtract(h->at[row], v[row], sum, first, GB_SIX_SIZE);
        }
        gb_six_subtract(h->at[row], gb_six_long_dot(h->at[row], v, behind), v, behind, GB_SIX_SIZE);
    }
    for (size_t row = column + 2; row < GB_SIX_SIZE; row++) {
        h->at[row][column] = R(0.0);
    }
}

/* Reduces the matrix. */
static void gb_six_reduce(gb_six_hessenberg *form)
{
    memset(&form->reflectors, 0, sizeof form->reflectors);
    for (size_t column = 0; column < GB_SIX_SIZE - 2; column++) {
        gb_real v[GB_SIX_SIZE];
        if (gb_six_reflector(&form->matrix, column, v)) {
            gb_six_reflect(&form->matrix, v, column);
            memcpy(form->reflectors.at[column], v, sizeof v);
        }
    }
}

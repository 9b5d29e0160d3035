/* Elimination of n - 1 linear equations in n unknowns: the null vector and least solutions: see elimination.rs */

/* Factors of a matrix by columns, `L U = J P`, with columns exchanged so that each pivot is the largest of its row. */
typedef struct {
    /* The number of pivots; there is one more unknown. */
    size_t rank;
    /* `U`. Column `j` is that of unknown `order[j]`. Entries below the diagonal are 0, so that loops run over all rows. */
    gb_real columns[GB_MOST_ARM_JOINTS][GB_ARM_ROWS];
    /* `L` without its diagonal, by columns. */
    gb_real lower[GB_ARM_ROWS][GB_ARM_ROWS];
    /* The reciprocals of the pivots; 0 for a pivot of 0. */
    gb_real inverses[GB_ARM_ROWS];
    size_t order[GB_MOST_ARM_JOINTS];
    /* Row `k` is that of equation `rows[k]`. */
    size_t rows[GB_ARM_ROWS];
    /* The null vector of length one, oriented such that the matrix with this vector as last row has a positive determinant. It is continuous along a curve of
     * regular points. */
    gb_real tangent[GB_MOST_ARM_JOINTS];
    /* The square root of `det(J J^T)`. */
    gb_real volume;
    /* The least magnitude of a pivot relative to the largest. */
    gb_real pivot;
} gb_arm_elimination;

/* Starts with the columns, which are already written. */
GB_INLINE void gb_arm_start(gb_arm_elimination *done, size_t rank)
{
    done->rank = rank;
    for (size_t k = 0; k < GB_MOST_ARM_JOINTS; k++) {
        done->order[k] = k;
        done->tangent[k] = R(0.0);
    }
    for (size_t k = 0; k < GB_ARM_ROWS; k++) {
        done->rows[k] = k;
    }
}

/* Exchanges two columns. */
GB_INLINE void gb_arm_exchange(gb_arm_elimination *done, size_t k, size_t j)
{
    const size_t number = done->order[k];
    gb_real column[GB_ARM_ROWS];
    memcpy(column, done->columns[k], sizeof column);
    memcpy(done->columns[k], done->columns[j], sizeof column);
    memcpy(done->columns[j], column, sizeof column);
    done->order[k] = done->order[j];
    done->order[j] = number;
}

/* Exchanges two entries. */
static void gb_arm_swap(gb_real *list, size_t k, size_t j)
{
    const gb_real value = list[k];
    list[k] = list[j];
    list[j] = value;
}

/* Exchanges two rows, after `k` steps. */
static void gb_arm_exchange_rows(gb_arm_elimination *done, size_t k, size_t r)
{
    const size_t number = done->rows[k];
    done->rows[k] = done->rows[r];
    done->rows[r] = number;
    for (size_t j = 0; j <= done->rank; j++) {
        gb_arm_swap(done->columns[j], k, r);
    }
    for (size_t j = 0; j < k; j++) {
        gb_arm_swap(done->lower[j], k, r);
    }
}

/* Subtracts row `k` from those below it. */
GB_INLINE void gb_arm_eliminate(gb_arm_elimination *done, size_t k, size_t rows, size_t rank)
{
    const gb_real pivot = done->columns[k][k], inverse = pivot == R(0.0) ? R(0.0) : R(1.0) / pivot;
    gb_real *multipliers = done->lower[k];
    for (size_t r = 0; r < GB_ARM_ROWS; r++) {
        multipliers[r] = R(0.0);
    }
    for (size_t r = k + 1; r < rows; r++) {
        multipliers[r] = done->columns[k][r] * inverse;
        done->columns[k][r] = R(0.0);
    }
    for (size_t j = k + 1; j <= rank; j++) {
        const gb_real upper = done->columns[j][k];
        GB_UNROLL
        for (size_t r = 0; r < GB_ARM_ROWS; r++) {
            done->columns[j][r] -= multipliers[r] * upper;
        }
    }
    done->inverses[k] = inverse;
}

/* The solution of `U y = z` for the unknowns with pivots, in their order; z is used up. */
GB_INLINE void gb_arm_back(const gb_arm_elimination *done, gb_real *z, gb_real *y, size_t rank)
{
    for (size_t k = rank; k-- > 0;) {
        y[k] = z[k] * done->inverses[k];
        GB_UNROLL
        for (size_t r = 0; r < GB_ARM_ROWS; r++) {
            z[r] -= done->columns[k][r] * y[k];
        }
    }
}

/* Computes the null vector. */
GB_INLINE void gb_arm_orient(gb_arm_elimination *done, gb_real sign, size_t rank)
{
    gb_real determinant = sign, least = (gb_real)INFINITY, largest = R(0.0), z[GB_ARM_ROWS], y[GB_ARM_ROWS], square = R(1.0);
    for (size_t k = 0; k < rank; k++) {
        const gb_real pivot = done->columns[k][k];
        determinant *= pivot;
        least = gb_arm_min(least, gb_magnitude(pivot));
        largest = gb_arm_max(largest, gb_magnitude(pivot));
    }
    done->pivot = largest > R(0.0) ? least / largest : R(0.0);
    memcpy(z, done->columns[rank], sizeof z);
    gb_arm_back(done, z, y, rank);
    for (size_t k = 0; k < rank; k++) {
        square += y[k] * y[k];
    }
    const gb_real norm = gb_square_root(square), factor = determinant < R(0.0) ? R(-1.0) / norm : R(1.0) / norm;
    for (size_t k = 0; k < rank; k++) {
        done->tangent[done->order[k]] = -y[k] * factor;
    }
    done->tangent[done->order[rank]] = factor;
    done->volume = gb_magnitude(determinant) * norm;
}

/* Factors with a rank that the compiler may know. */
GB_INLINE void gb_arm_factor_of(gb_arm_elimination *done, size_t rank)
{
    gb_real sign = R(1.0);
    gb_arm_start(done, rank);
    for (size_t k = 0; k < rank; k++) {
        size_t best = k;
        for (size_t j = k + 1; j <= rank; j++) {
            if (gb_magnitude(done->columns[j][k]) > gb_magnitude(done->columns[best][k])) {
                best = j;
            }
        }
        if (best != k) {
            gb_arm_exchange(done, k, best);
            sign = -sign;
        }
        gb_arm_eliminate(done, k, rank, rank);
    }
    gb_arm_orient(done, sign, rank);
}

/* Factors the matrix with `rank + 1` columns and as many rows as `rank`. The columns are already written. */
static void gb_arm_factor(gb_arm_elimination *done, size_t rank)
{
    /* The compiler unrolls the loops of the most frequent case. */
    if (rank == GB_ARM_ROWS) {
        gb_arm_factor_of(done, GB_ARM_ROWS);
    } else {
        gb_arm_factor_of(done, rank);
    }
}

/* Exchanges columns and rows so that the largest entry from row and column `k` on is there. Returns the sign of the exchanges. */
static gb_real gb_arm_bring(gb_arm_elimination *done, size_t k)
{
    size_t column = k, row = k;
    gb_real sign = R(1.0);
    for (size_t j = k; j <= done->rank; j++) {
        for (size_t r = k; r <= done->rank; r++) {
            if (gb_magnitude(done->columns[j][r]) > gb_magnitude(done->columns[column][row])) {
                column = j;
                row = r;
            }
        }
    }
    if (column != k) {
        gb_arm_exchange(done, k, column);
        sign = -sign;
    }
    if (row != k) {
        gb_arm_exchange_rows(done, k, row);
        sign = -sign;
    }
    return sign;
}

/* Factors a matrix of `rank + 2` columns and `rank + 1` rows without one of its columns. The remaining rows are dependent, and one of them is left out. */
static void gb_arm_factor_without(gb_arm_elimination *done, size_t rank, size_t left_out)
{
    gb_real sign = R(1.0);
    gb_arm_start(done, rank);
    gb_arm_exchange(done, left_out, rank + 1);
    for (size_t k = 0; k < rank; k++) {
        sign *= gb_arm_bring(done, k);
        gb_arm_eliminate(done, k, rank + 1, rank);
    }
    gb_arm_orient(done, sign, rank);
}

/* A solution of `J x = values`, not the least one, with a rank that the compiler may know. */
GB_INLINE void gb_arm_solved(const gb_arm_elimination *done, const gb_real *values, gb_real *x, size_t rank)
{
    gb_real z[GB_ARM_ROWS] = {R(0.0)}, y[GB_ARM_ROWS];
    for (size_t k = 0; k < rank; k++) {
        z[k] = values[done->rows[k]];
    }
    for (size_t k = 0; k < rank; k++) {
        const gb_real value = z[k];
        GB_UNROLL
        for (size_t r = 0; r < GB_ARM_ROWS; r++) {
            z[r] -= done->lower[k][r] * value;
        }
    }
    gb_arm_back(done, z, y, rank);
    for (size_t k = 0; k < GB_MOST_ARM_JOINTS; k++) {
        x[k] = R(0.0);
    }
    for (size_t k = 0; k < rank; k++) {
        x[done->order[k]] = y[k];
    }
}

/* The least solution of `J x = values`: the one that is orthogonal to the null vector. */
static void gb_arm_least(const gb_arm_elimination *done, const gb_real *values, gb_real *x)
{
    if (done->rank == GB_ARM_ROWS) {
        gb_arm_solved(done, values, x, GB_ARM_ROWS);
    } else {
        gb_arm_solved(done, values, x, done->rank);
    }
    const gb_real along = gb_arm_dot(x, done->tangent);
    GB_UNROLL
    for (int k = 0; k < GB_MOST_ARM_JOINTS; k++) {
        x[k] -= along * done->tangent[k];
    }
}

/* The solution of `J x = values` with a given value of one unknown; false if that unknown does not change along the null vector. */
static bool gb_arm_with(const gb_arm_elimination *done, const gb_real *values, size_t unknown, gb_real value, gb_real *x)
{
    gb_arm_least(done, values, x);
    if (gb_magnitude(done->tangent[unknown]) < GB_LEAST_POSITIVE) {
        return false;
    }
    const gb_real along = (value - x[unknown]) / done->tangent[unknown];
    gb_arm_plus(x, along, done->tangent, x);
    return true;
}

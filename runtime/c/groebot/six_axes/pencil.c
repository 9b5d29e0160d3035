/* The generalised eigenvalue problem (A - x B) v = 0 with sixteen rows and columns: see pencil.rs
 *
 * Each equation is multiplied by the cosine and by the sine of half of one near joint's angle. There are then as many equations as products. The reason is
 * that there are four homogeneous monomials of degree three in half that angle, and three of degree two. Half a turn is then an ordinary point. */

typedef struct {
    gb_real at[GB_SIX_ALL];
} gb_six_wide;

typedef struct {
    gb_real at[GB_SIX_SIZE][GB_SIX_SIZE];
} gb_six_matrix;

/* The pencil, and how its unknowns are computed from an eigenvector. */
typedef struct {
    /* A and B. */
    gb_six_matrix constant;
    gb_six_matrix linear;
    /* The remaining columns, as indices among all columns. */
    size_t kept[GB_SIX_SIZE];
    /* The eliminated unknowns: each with its column and its equation. */
    size_t column[GB_SIX_SOLVED];
    gb_six_wide solved[GB_SIX_SOLVED];
    size_t count;
} gb_six_pencil;

/* A row times the cosine (`power` 0) or the sine (`power` 1) of the half angle: `1 = C^2 + S^2`, `c = C^2 - S^2`, `s = 2 C S`. For a prismatic joint, `1 =
 * C^2`, `d = C S`, `d^2 = S^2`. */
GB_INLINE void gb_six_multiply(const gb_six_row *row, const gb_six_equations *rows, bool second, bool slides, size_t power, gb_real *wide, size_t count)
{
    const size_t step = second ? 1 : 3, other = second ? 3 : 1, left = GB_SIX_FAR - rows->solved;
    memset(wide, 0, count * sizeof *wide);
    GB_UNROLL
    for (size_t k = 0; k < 3; k++) {
        const gb_real one = row->at[k * other], even = row->at[k * other + step], odd = row->at[k * other + 2 * step];
        wide[3 * power + k] = slides ? one : one + even;
        wide[3 * (1 + power) + k] = slides ? odd : odd + odd;
        wide[3 * (2 + power) + k] = slides ? even : one - even;
    }
    for (size_t k = 0; k < left; k++) {
        wide[GB_SIX_NEAR + power * left + k] = row->at[rows->order[rows->solved + k]];
    }
}

/* The indices of the largest entry from a row on; false when all are zero or one is not finite. */
static bool gb_six_find_wide(const gb_six_pencil *pencil, size_t first, size_t *row_of, size_t *column_of)
{
    gb_real most = R(0.0);
    for (size_t row = first; row < pencil->count; row++) {
        for (size_t column = 0; column < GB_SIX_ALL; column++) {
            const gb_real entry = gb_magnitude(pencil->solved[row].at[column]);
            if (entry > most) {
                most = entry;
                *row_of = row;
                *column_of = column;
            }
        }
    }
    return most > R(0.0) && gb_six_is_finite(most);
}

/* Solves each remaining still equation for its largest column, and eliminates these columns from all others. */
static bool gb_six_eliminate_wide(gb_six_pencil *pencil, gb_six_wide *constant, gb_six_wide *linear)
{
    for (size_t index = 0; index < pencil->count; index++) {
        size_t row = 0, column = 0;
        if (!gb_six_find_wide(pencil, index, &row, &column)) {
            return false;
        }
        gb_six_wide pivot = pencil->solved[row];
        pencil->solved[row] = pencil->solved[index];
        const gb_real inverse = R(1.0) / pivot.at[column];
        for (size_t i = 0; i < GB_SIX_ALL; i++) {
            pivot.at[i] *= inverse;
        }
        pencil->solved[index] = pivot;
        pencil->column[index] = column;
        for (size_t k = 0; k < pencil->count; k++) {
            if (k != index) {
                gb_six_clear(pencil->solved[k].at, pivot.at, column, GB_SIX_ALL);
            }
        }
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            gb_six_clear(constant[k].at, pivot.at, column, GB_SIX_ALL);
            gb_six_clear(linear[k].at, pivot.at, column, GB_SIX_ALL);
        }
    }
    return true;
}

/* The kept columns. */
static void gb_six_keep_columns(gb_six_pencil *pencil)
{
    size_t kept = 0;
    for (size_t column = 0; column < GB_SIX_SIZE + pencil->count; column++) {
        bool is_solved = false;
        for (size_t k = 0; k < pencil->count; k++) {
            is_solved |= pencil->column[k] == column;
        }
        if (!is_solved && kept < GB_SIX_SIZE) {
            pencil->kept[kept++] = column;
        }
    }
}

/* The pencil where some still equations did not determine far products; false when no equation determines one of the remaining columns. */
static GB_APART bool gb_six_make_narrowed(const gb_six_equations *rows, bool second, bool slides, gb_six_pencil *pencil)
{
    gb_six_wide constant[GB_SIX_SIZE], linear[GB_SIX_SIZE];
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        gb_six_multiply(&rows->constant[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, constant[k].at, GB_SIX_ALL);
        gb_six_multiply(&rows->linear[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, linear[k].at, GB_SIX_ALL);
    }
    pencil->count = 2 * (GB_SIX_STILL - rows->solved);
    for (size_t k = 0; k < pencil->count; k++) {
        gb_six_multiply(&rows->still[rows->solved + k / 2], rows, second, slides, k % 2, pencil->solved[k].at, GB_SIX_ALL);
    }
    if (!gb_six_eliminate_wide(pencil, constant, linear)) {
        return false;
    }
    gb_six_keep_columns(pencil);
    for (size_t i = 0; i < GB_SIX_SIZE; i++) {
        for (size_t j = 0; j < GB_SIX_SIZE; j++) {
            pencil->constant.at[i][j] = constant[i].at[pencil->kept[j]];
            pencil->linear.at[i][j] = linear[i].at[pencil->kept[j]];
        }
    }
    return true;
}

/* The pencil of reduced equations; false when no equation determines one of the remaining columns. */
static bool gb_six_make_pencil(const gb_six_equations *rows, bool second, bool slides, gb_six_pencil *pencil)
{
    if (rows->solved < GB_SIX_STILL) {
        return gb_six_make_narrowed(rows, second, slides, pencil);
    }
    pencil->count = 0;
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        pencil->kept[k] = k;
        gb_six_multiply(&rows->constant[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, pencil->constant.at[k], GB_SIX_SIZE);
        gb_six_multiply(&rows->linear[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, pencil->linear.at[k], GB_SIX_SIZE);
    }
    return true;
}

/* The values of all columns. */
static void gb_six_widen(const gb_six_pencil *pencil, const gb_real *vector, gb_six_wide *wide)
{
    memset(wide, 0, sizeof *wide);
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        wide->at[pencil->kept[k]] = vector[k];
    }
    const gb_six_wide known = *wide;
    for (size_t k = 0; k < pencil->count; k++) {
        wide->at[pencil->column[k]] = -gb_six_product(pencil->solved[k].at, known.at, GB_SIX_ALL);
    }
}

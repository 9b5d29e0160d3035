/* Eigenvectors of a Hessenberg matrix for known eigenvalues, several at once (Golub and Van Loan, section 7.6.1): see inverse_iteration.rs */

/* Number of independent registers of eigenvectors that are computed at once, and number of these eigenvectors. */
#define GB_SIX_PARTS (GB_SIX_LANES < 4 ? 2 : 1)
#define GB_SIX_WIDTH (GB_SIX_PARTS * GB_SIX_LANES)

/* `H - x` after Gauss elimination of the subdiagonal with exchange of neighbouring rows. */
typedef struct {
    /* The entries above the diagonal, by columns. */
    gb_six_lanes columns[GB_SIX_SIZE][GB_SIX_SIZE][GB_SIX_PARTS];
    /* Reciprocals of the diagonal. */
    gb_six_lanes inverses[GB_SIX_SIZE][GB_SIX_PARTS];
    /* Whether a row and the next one were exchanged. */
    gb_six_bits exchanged[GB_SIX_SIZE][GB_SIX_PARTS];
    /* The multiple of the row that was subtracted from the next one. */
    gb_six_lanes factors[GB_SIX_SIZE][GB_SIX_PARTS];
} gb_six_eliminated;

/* Exchanges two numbers in lanes where `is_so` is true. */
GB_INLINE void gb_six_exchange_where(gb_six_lanes *a, gb_six_lanes *b, gb_six_bits is_so)
{
    const gb_six_bits change = (gb_six_bits_of(*a) ^ gb_six_bits_of(*b)) & is_so;
    *a = gb_six_of_bits(gb_six_bits_of(*a) ^ change);
    *b = gb_six_of_bits(gb_six_bits_of(*b) ^ change);
}

/* The reciprocal of a pivot. */
GB_INLINE gb_six_lanes gb_six_inverted(gb_six_lanes pivot, gb_six_lanes least)
{
    return R(1.0) / gb_six_pick(least, pivot, gb_six_exceeds(least, gb_six_abs(pivot)));
}

/* Eliminates for one register of eigenvalues; pivots have a lower bound relative to the largest entry. */
GB_INLINE void gb_six_eliminate(gb_six_eliminated *to, const gb_six_matrix *h, gb_real largest, gb_six_lanes x, int part)
{
    gb_six_lanes size = gb_six_of(largest), upper[GB_SIX_SIZE];
    for (int k = 0; k < GB_SIX_SIZE; k++) {
        size = gb_six_greater(size, gb_six_abs(h->at[k][k] - x));
        upper[k] = gb_six_of(h->at[0][k]);
    }
    const gb_six_lanes least = size * GB_EPSILON;
    upper[0] = upper[0] - x;
    for (int k = 0; k < GB_SIX_SIZE - 1; k++) {
        gb_six_lanes pivot = upper[k], other = gb_six_of(h->at[k + 1][k]);
        const gb_six_bits exchanged = gb_six_exceeds(gb_six_abs(other), gb_six_abs(pivot));
        gb_six_exchange_where(&pivot, &other, exchanged);
        const gb_six_lanes inverse = gb_six_inverted(pivot, least), factor = other * inverse;
        for (int j = k + 1; j < GB_SIX_SIZE; j++) {
            gb_six_lanes over = upper[j], below = j == k + 1 ? h->at[j][j] - x : gb_six_of(h->at[k + 1][j]);
            gb_six_exchange_where(&over, &below, exchanged);
            to->columns[j][k][part] = over;
            upper[j] = below - factor * over;
        }
        to->inverses[k][part] = inverse;
        to->exchanged[k][part] = exchanged;
        to->factors[k][part] = factor;
    }
    to->inverses[GB_SIX_SIZE - 1][part] = gb_six_inverted(upper[GB_SIX_SIZE - 1], least);
}

GB_INLINE void gb_six_forward(const gb_six_eliminated *to, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int k = 0; k < GB_SIX_SIZE - 1; k++) {
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            gb_six_lanes upper = y[k][part], lower = y[k + 1][part];
            gb_six_exchange_where(&upper, &lower, to->exchanged[k][part]);
            y[k][part] = upper;
            y[k + 1][part] = lower - to->factors[k][part] * upper;
        }
    }
}

GB_INLINE void gb_six_backward(const gb_six_eliminated *to, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int k = GB_SIX_SIZE - 1; k >= 0; k--) {
        gb_six_lanes known[GB_SIX_PARTS];
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            y[k][part] = known[part] = y[k][part] * to->inverses[k][part];
        }
        for (int row = 0; row < k; row++) {
            for (int part = 0; part < GB_SIX_PARTS; part++) {
                y[row][part] = y[row][part] - known[part] * to->columns[k][row][part];
            }
        }
    }
}

/* Inverse iteration. */
GB_INLINE void gb_six_iterate(const gb_six_eliminated *to, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int round = 0; round < GB_SIX_ROUNDS; round++) {
        if (round > 0) {
            gb_six_forward(to, y);
        }
        gb_six_backward(to, y);
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            gb_six_lanes largest = gb_six_of(GB_LEAST_POSITIVE);
            for (int k = 0; k < GB_SIX_SIZE; k++) {
                largest = gb_six_greater(largest, gb_six_abs(y[k][part]));
            }
            const gb_six_lanes inverse = R(1.0) / largest;
            for (int k = 0; k < GB_SIX_SIZE; k++) {
                y[k][part] = y[k][part] * inverse;
            }
        }
    }
}

/* Q y. */
GB_INLINE void gb_six_turn_back(const gb_six_hessenberg *form, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int column = GB_SIX_SIZE - 3; column >= 0; column--) {
        const gb_real *v = form->reflectors.at[column];
        gb_six_lanes share[GB_SIX_PARTS];
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            share[part] = gb_six_of(R(0.0));
        }
        for (int k = column + 1; k < GB_SIX_SIZE; k++) {
            for (int part = 0; part < GB_SIX_PARTS; part++) {
                share[part] = share[part] + v[k] * y[k][part];
            }
        }
        for (int k = column + 1; k < GB_SIX_SIZE; k++) {
            for (int part = 0; part < GB_SIX_PARTS; part++) {
                y[k][part] = y[k][part] - share[part] * v[k];
            }
        }
    }
}

/* Eigenvectors of A for the real parts of eigenvalues, not normalised. Not finite only when the matrix is not. */
static void gb_six_eigenvectors(const gb_six_hessenberg *form, const gb_six_eigenvalue *values, size_t count, gb_six_matrix *vectors)
{
    const gb_real largest = gb_six_largest(GB_LEAST_POSITIVE, form->matrix.at[0], GB_SIX_SIZE * GB_SIX_SIZE);
    gb_six_eliminated eliminated;
    for (size_t first = 0; first < count; first += GB_SIX_WIDTH) {
        gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS];
        gb_real x[GB_SIX_WIDTH];
        for (size_t lane = 0; lane < GB_SIX_WIDTH; lane++) {
            x[lane] = values[first + lane < count ? first + lane : count - 1].re;
        }
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            gb_six_eliminate(&eliminated, &form->matrix, largest, gb_six_load(x + part * GB_SIX_LANES), part);
            for (int k = 0; k < GB_SIX_SIZE; k++) {
                y[k][part] = gb_six_of(R(1.0));
            }
        }
        gb_six_iterate(&eliminated, y);
        gb_six_turn_back(form, y);
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            gb_real lanes[GB_SIX_WIDTH];
            memcpy(lanes, y[k], sizeof lanes);
            for (size_t lane = 0; lane < GB_SIX_WIDTH && first + lane < count; lane++) {
                vectors->at[first + lane][k] = lanes[lane];
            }
        }
    }
}

/* The equations: see rows.rs and reduce.rs */

/* Coefficients of the near products, with 1, and of the far ones. The last three places are unused. */
#define GB_SIX_ROW 20
typedef struct {
    gb_real at[GB_SIX_ROW];
} gb_six_row;

/* The equations still = 0 and constant - x linear = 0, where x is the tangent of half the hidden angle, or half the displacement. After elimination they are
 * in the near products and the remaining far ones. The first `solved` still equations each determine one far product; the others are unchanged. */
typedef struct {
    gb_six_row still[GB_SIX_STILL];
    gb_six_row constant[GB_SIX_MOVING];
    gb_six_row linear[GB_SIX_MOVING];
    size_t solved;
    /* Order of the far columns: solved ones first, in the order of their equations. */
    size_t order[GB_SIX_FAR];
} gb_six_equations;

/* The functions invariant under a translation: l, the component of p x l along the axis, those of p orthogonal to it. The second row is for the functions a,
 * l, p x l, l x a, p.a and p.(l x a), with a prismatic fourth joint: ten are invariant. */
static const unsigned char gb_six_unmoved[2][GB_SIX_STILL] = {{1, 7, 11, 2, 6, 10}, {0, 1, 2, 3, 6, 7}};
/* The other functions, and which multiple of which function -N maps each to, or the constant -2: N p = w, N (p x l) = w x l, N ((p.p) l - 2 (p.l) p) = -2 w
 * x (p x l) - 2 (p.l) w, N (p.p) = 2 p.w, N (p.l) = l.w. In the second case N (p.a) = w.a, N (p.(l x a)) = w.(l x a). Four of the invariant functions are
 * then among the moving equations: r = 0 and s = 0 become s - x r = 0 and -r - x s = 0, which are equivalent for all x except i and -i. */
static const unsigned char gb_six_sliding[2][GB_SIX_MOVING] = {{0, 8, 12, 3, 9, 13, 4, 5}, {10, 9, 13, 11, 8, 12, 4, 5}};
static const unsigned char gb_six_images[2][GB_SIX_MOVING] = {{0, 11, 7, 5, 12, 8, 0, 1}, {9, 10, 11, 13, 11, 7, 0, 3}};
static const gb_real gb_six_factors[2][GB_SIX_MOVING] = {
    {R(0.0), R(1.0), R(-1.0), R(2.0), R(-2.0), R(2.0), R(-2.0), R(-1.0)},
    {R(1.0), R(-1.0), R(1.0), R(-1.0), R(1.0), R(-1.0), R(-1.0), R(-1.0)},
};

/* factor (a + sign b) in the products of both sides, which share the constant 1; a and b are the functions with these numbers. */
GB_INLINE void gb_six_combine(const gb_six_profile *near, const gb_six_profile *far, size_t function, gb_real sign, gb_real factor, gb_six_row *row)
{
    row->at[0] = factor * (near->at[0][function] + sign * far->at[0][function]);
    GB_UNROLL
    for (size_t k = 1; k < GB_SIX_PRODUCTS; k++) {
        row->at[k] = factor * near->at[k][function];
        row->at[GB_SIX_FAR + k] = factor * (sign * far->at[k][function]);
    }
    GB_UNROLL
    for (size_t k = GB_SIX_COLUMNS; k < GB_SIX_ROW; k++) {
        row->at[k] = R(0.0);
    }
}

/* Equations of a revolute hidden joint: the vectors orthogonal to its axis w fulfil Rodrigues' equation b - a = x w x (a + b). */
static void gb_six_turn_rows(const gb_six_profile *near, const gb_six_profile *far, gb_six_equations *rows)
{
    for (size_t k = 0; k < GB_SIX_STILL; k++) {
        gb_six_combine(near, far, k, R(-1.0), R(1.0), &rows->still[k]);
    }
    for (size_t k = 0; k < GB_SIX_MOVING; k++) {
        gb_six_combine(near, far, GB_SIX_STILL + k, R(-1.0), R(1.0), &rows->constant[k]);
        gb_six_combine(near, far, k < 4 ? GB_SIX_STILL + 4 + k : GB_SIX_STILL - 4 + k, R(1.0), k < 4 ? R(1.0) : R(-1.0), &rows->linear[k]);
    }
}

/* Equations of a prismatic hidden joint: a translation by 2 x w is exp(2 x N) with N^3 = 0, so that b - a = x N (a + b) for all fourteen functions. */
static void gb_six_slide_rows(const gb_six_profile *near, const gb_six_profile *far, bool is_directed, gb_six_equations *rows)
{
    const int kind = is_directed ? 1 : 0;
    for (size_t k = 0; k < GB_SIX_STILL; k++) {
        gb_six_combine(near, far, gb_six_unmoved[kind][k], R(-1.0), R(1.0), &rows->still[k]);
    }
    for (size_t k = 0; k < GB_SIX_MOVING; k++) {
        const bool is_paired = is_directed && k < 4;
        const gb_real factor = gb_six_factors[kind][k];
        gb_six_combine(near, far, gb_six_sliding[kind][k], R(-1.0), is_paired ? factor : R(1.0), &rows->constant[k]);
        gb_six_combine(near, far, gb_six_images[kind][k], is_paired ? R(-1.0) : R(1.0), is_paired ? R(1.0) : factor, &rows->linear[k]);
        if (factor == R(0.0)) {
            memset(&rows->linear[k], 0, sizeof rows->linear[k]);
            rows->linear[k].at[0] = R(-2.0);
        }
    }
}

/* The equation, and the index in the order of the columns, of the largest coefficient relative to its equation's size; false where all are small. */
static bool gb_six_find_still(const gb_six_equations *rows, size_t *row_of, size_t *place_of)
{
    gb_real best = GB_PIVOTS_WEAK;
    bool is_found = false;
    for (size_t row = rows->solved; row < GB_SIX_STILL; row++) {
        const gb_real *still = rows->still[row].at, inverse = R(1.0) / gb_six_largest(GB_LEAST_POSITIVE, still, GB_SIX_ROW);
        for (size_t place = rows->solved; place < GB_SIX_FAR; place++) {
            const gb_real share = gb_magnitude(still[rows->order[place]]) * inverse;
            if (share > best) {
                best = share;
                *row_of = row;
                *place_of = place;
                is_found = true;
            }
        }
    }
    return is_found;
}

/* Eliminates a column from a row with a pivot row whose entry there is one. */
GB_INLINE void gb_six_clear(gb_real *row, const gb_real *pivot, size_t column, size_t count)
{
    gb_six_subtract(row, row[column], pivot, 0, count);
    row[column] = R(0.0);
}

/* Solves a still equation for the column at a place, and eliminates it from all others. */
static void gb_six_eliminate_still(gb_six_equations *rows, size_t row, size_t place)
{
    const size_t index = rows->solved, column = rows->order[place];
    gb_six_row pivot = rows->still[row];
    rows->still[row] = rows->still[index];
    rows->order[place] = rows->order[index];
    rows->order[index] = column;
    const gb_real inverse = R(1.0) / pivot.at[column];
    for (size_t i = 0; i < GB_SIX_ROW; i++) {
        pivot.at[i] *= inverse;
    }
    rows->still[index] = pivot;
    for (size_t k = 0; k < GB_SIX_STILL; k++) {
        if (k != index) {
            gb_six_clear(rows->still[k].at, pivot.at, column, GB_SIX_ROW);
        }
    }
    for (size_t k = 0; k < GB_SIX_MOVING; k++) {
        gb_six_clear(rows->constant[k].at, pivot.at, column, GB_SIX_ROW);
        gb_six_clear(rows->linear[k].at, pivot.at, column, GB_SIX_ROW);
    }
    rows->solved++;
}

/* The equations of a formulation. The still ones are solved for as many far products as are well determined, by complete pivoting. */
static void gb_six_equate(const gb_chain *chain, gb_formulation formulation, const gb_rigid *displacement, gb_six_equations *rows)
{
    const gb_six_figure hidden = gb_six_figure_of(chain, formulation.hidden);
    gb_six_figure near[3], far[3];
    gb_six_profile moved, reached;
    size_t row = 0, place = 0;
    for (size_t k = 0; k < 3; k++) {
        near[k] = gb_six_place(chain, formulation, 1 + k, true, displacement);
        far[k] = gb_six_place(chain, formulation, 5 - k, false, displacement);
    }
    gb_six_make_profile(&hidden, chain->across[formulation.hidden], &near[0], &near[1], &near[2], &moved);
    gb_six_make_profile(&hidden, chain->across[formulation.hidden], &far[0], &far[1], &far[2], &reached);
    if (hidden.slides) {
        gb_six_slide_rows(&moved, &reached, near[2].slides, rows);
    } else {
        gb_six_turn_rows(&moved, &reached, rows);
    }
    rows->solved = 0;
    for (size_t k = 0; k < GB_SIX_FAR; k++) {
        rows->order[k] = GB_SIX_PRODUCTS + k;
    }
    while (rows->solved < GB_SIX_STILL && gb_six_find_still(rows, &row, &place)) {
        gb_six_eliminate_still(rows, row, place);
    }
}

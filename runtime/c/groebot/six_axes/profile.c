/* Functions of Raghavan and Roth, affine in the cosine and sine of every joint: see profile.rs
 *
 * For a line with direction l through a point p, the fourteen functions p, l, p x l, (p.p) l - 2 (p.l) p, p.p and p.l span a space that rigid motions map
 * into itself. With the origin on the axis of a rotation, six functions are invariant: the components of the four vectors along the axis, and the two
 * scalars. The orthogonal components of the vectors rotate. A prismatic joint acts on them by polynomials of degree two in its displacement: 1, d^2, d take
 * the place of 1, c, s. Such a joint leaves invariant its direction l, a direction a orthogonal to it, and lines along l. Then a, l, p x l, l x a, p.a and
 * p.(l x a) are fourteen functions with equal properties. */

/* Of each vector the component along the hidden axis, then the two scalars, then the components along the two orthogonal directions. The last two places are
 * unused. */
#define GB_SIX_FUNCTIONS 16

/* By product, its coefficients in the functions. */
typedef struct {
    gb_real at[GB_SIX_PRODUCTS][GB_SIX_FUNCTIONS];
} gb_six_profile;

GB_INLINE void gb_six_functions(const gb_six_figure *hidden, const gb_real across[2][3], const gb_six_figure *figure, gb_real *values)
{
    const gb_real *l = figure->direction;
    gb_real vectors[4][3], p[3];
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        p[i] = figure->point[i] - hidden->point[i];
        vectors[1][i] = l[i];
    }
    gb_six_cross(p, l, vectors[2]);
    if (figure->slides) {
        gb_six_cross(l, figure->side, vectors[3]);
        memcpy(vectors[0], figure->side, sizeof vectors[0]);
        values[4] = gb_six_dot(p, figure->side);
        values[5] = gb_six_dot(p, vectors[3]);
    } else {
        const gb_real square = gb_six_dot(p, p), along = gb_six_dot(p, l);
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            vectors[0][i] = p[i];
            vectors[3][i] = l[i] * square - p[i] * (along + along);
        }
        values[4] = square;
        values[5] = along;
    }
    GB_UNROLL
    for (int k = 0; k < 4; k++) {
        values[k] = gb_six_dot(hidden->direction, vectors[k]);
        values[GB_SIX_STILL + k] = gb_six_dot(across[0], vectors[k]);
        values[GB_SIX_STILL + 4 + k] = gb_six_dot(across[1], vectors[k]);
    }
    values[14] = values[15] = R(0.0);
}

/* The functions of a figure moved first by the axis `second`, then by the axis `first`. */
static void gb_six_make_profile(const gb_six_figure *hidden, const gb_real across[2][3], const gb_six_figure *first, const gb_six_figure *second,
                                const gb_six_figure *figure, gb_six_profile *profile)
{
    gb_real table[3][3][GB_SIX_FUNCTIONS];
    for (int j = 0; j < 3; j++) {
        const gb_six_figure inner = gb_six_moved_by(figure, second, gb_six_samples[second->slides ? 1 : 0][j]);
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            const gb_six_figure outer = gb_six_moved_by(&inner, first, gb_six_samples[first->slides ? 1 : 0][i]);
            gb_six_functions(hidden, across, &outer, table[i][j]);
        }
    }
    for (size_t at = 0; at < GB_SIX_FUNCTIONS; at += GB_SIX_LANES) {
        gb_six_lanes by_second[3][3], by_first[3];
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            gb_six_coefficients(second->slides, gb_six_load(table[i][0] + at), gb_six_load(table[i][1] + at), gb_six_load(table[i][2] + at), by_second[i]);
        }
        GB_UNROLL
        for (int k = 0; k < 3; k++) {
            gb_six_coefficients(first->slides, by_second[0][k], by_second[1][k], by_second[2][k], by_first);
            GB_UNROLL
            for (int i = 0; i < 3; i++) {
                gb_six_store(profile->at[3 * i + k] + at, by_first[i]);
            }
        }
    }
}

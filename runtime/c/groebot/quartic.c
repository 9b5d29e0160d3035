/* The real roots of an ordinary quartic: see quartic.rs (G. Cardano, "Ars Magna", 1545) */

#define GB_MOST_DEGREE 16
#define GB_MOST_COEFFICIENTS (GB_MOST_DEGREE + 1)

/* The largest magnitude. */
static gb_real gb_largest(const gb_real *numbers, size_t count)
{
    gb_real largest = R(0.0);
    for (size_t i = 0; i < count; i++) {
        largest = gb_larger(largest, gb_magnitude(numbers[i]));
    }
    return largest;
}

#ifndef GB_FLOAT
/* The greatest root of z^3 + u z^2 + v z - w for w > 0, to half its digits. Newton steps start at an upper bound: a root above `typical` has z^2 <= -u z - v
 * + w / typical. Below zero where there is none. */
static gb_real gb_resolved(gb_real u, gb_real v, gb_real w, gb_real typical)
{
    const gb_real falling = gb_larger(R(0.0), -u), under = gb_larger(R(0.0), -v);
    const gb_real inside = falling * falling + R(4.0) * (under + w / typical);
    const gb_real bound = R(0.5) * (falling + gb_square_root(inside));
    gb_real z = gb_larger(typical, bound);
    for (int i = 0; i < 24; i++) {
        const gb_real value = ((z + u) * z + v) * z - w;
        const gb_real slope = (R(3.0) * z + R(2.0) * u) * z + v;
        const gb_real step = value / slope;
        z -= step;
        if (gb_magnitude(step) <= GB_ROOTS_CLOSE * z) {
            return w > R(0.0) ? z : R(-1.0);
        }
    }
    return R(-1.0);
}

/* Two Newton steps from the approximation of a root. NaN where they do not converge. */
static gb_real gb_settled(const gb_real *c, gb_real x, gb_real scale)
{
    gb_real step = R(0.0);
    for (int i = 0; i < 2; i++) {
        const gb_real value = (((x + c[3]) * x + c[2]) * x + c[1]) * x + c[0];
        const gb_real slope = ((R(4.0) * x + R(3.0) * c[3]) * x + R(2.0) * c[2]) * x + c[1];
        step = value / slope;
        x -= step;
    }
    return gb_magnitude(step) <= GB_POLISHING_STEP * gb_larger(scale, gb_magnitude(x)) ? x : NAN;
}

/* The roots of the two real quadratics whose product is x^4 + c3 x^3 + c2 x^2 + c1 x + c0: two of each, ascending; those of the second follow those of the
 * first. Returns their number, or a value below zero where the quartic is not ordinary. */
static int gb_approximate_roots(const gb_real *c, gb_scale scale, gb_real *roots)
{
    const gb_real typical = gb_scale_at(scale, R(0.0));
    /* With y = x + c3 / 4 it is y^4 + p y^2 + q y + r. */
    const gb_real quarter = R(0.25) * c[3], square = c[3] * c[3];
    const gb_real p = c[2] - R(0.375) * square;
    const gb_real q = c[1] - R(0.5) * c[3] * (c[2] - R(0.25) * square);
    const gb_real r = c[0] - quarter * (c[1] - quarter * (c[2] - R(0.1875) * square));
    /* (y^2 + h y + f) (y^2 - h y + g) with z = h^2. */
    const gb_real z = gb_resolved(R(2.0) * p, p * p - R(4.0) * r, q * q, typical * typical);
    if (z < R(0.0)) {
        return -1;
    }
    const gb_real h = gb_square_root(z), mean = R(0.5) * (p + z), half = R(0.5) * q / h;
    const gb_real f = mean - half, g = mean + half;
    const gb_real size = gb_larger(gb_larger(z, gb_magnitude(f)), gb_magnitude(g));
    const gb_real others[2] = {g, f}, discriminants[2] = {z - R(4.0) * f, z - R(4.0) * g}, middles[2] = {R(-0.5) * h, R(0.5) * h};
    int count = 0;
    for (int i = 0; i < 2; i++) {
        const gb_real apart = R(0.5) * gb_square_root(gb_magnitude(discriminants[i]));
        if (discriminants[i] > R(0.0)) {
            roots[count++] = middles[i] - apart - quarter;
            roots[count++] = middles[i] + apart - quarter;
        } else if (!(apart > GB_ROOTS_DISTINCT * gb_scale_at(scale, gb_square_root(size))
                     && gb_magnitude(others[i] + R(0.75) * z) > GB_ROOTS_DISTINCT * gb_larger(size, typical * typical))) {
            return -1;
        }
    }
    return count;
}

/* Sorts two ascending pairs. */
static void gb_merge_pairs(gb_real *roots)
{
    const gb_real low = gb_smaller(roots[1], roots[3]), high = gb_larger(roots[0], roots[2]);
    const gb_real first = gb_smaller(roots[0], roots[2]), last = gb_larger(roots[1], roots[3]);
    roots[0] = first;
    roots[1] = gb_smaller(low, high);
    roots[2] = gb_larger(low, high);
    roots[3] = last;
}

/* All real roots of the quartic with these coefficients, ascending. Below zero where it is not ordinary: its leading coefficient is small, roots are close
 * to each other, complex roots are close to the real axis, or the steps do not converge. */
static int gb_ordinary_roots(const gb_real *coefficients, gb_scale scale, gb_real *roots)
{
    const gb_real lead = coefficients[4], largest = gb_largest(coefficients, 5);
    if (!(gb_magnitude(lead) > R(1e-2) * largest && gb_is_finite(largest))) {
        return -1;
    }
    gb_real monic[4];
    for (int i = 0; i < 4; i++) {
        monic[i] = coefficients[i] * (R(1.0) / lead);
    }
    const int count = gb_approximate_roots(monic, scale, roots);
    bool are_settled = true;
    for (int i = 0; i < count; i++) {
        roots[i] = gb_settled(monic, roots[i], gb_scale_at(scale, R(0.0)));
        are_settled = are_settled && roots[i] == roots[i];
    }
    if (!are_settled) {
        return -1;
    }
    if (count == 4) {
        gb_merge_pairs(roots);
    }
    for (int i = 1; i < count; i++) {
        const gb_real size = gb_larger(gb_scale_at(scale, roots[i - 1]), gb_scale_at(scale, roots[i]));
        if (!(roots[i] - roots[i - 1] > GB_ROOTS_DISTINCT * size)) {
            return -1;
        }
    }
    return count;
}
#endif

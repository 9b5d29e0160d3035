/* Real roots of polynomials in one unknown: see roots.rs */

/* The sign of p(x) is undetermined up to degree GB_SIGNLESS sum |a_i x^i|. */
#define GB_SIGNLESS (R(2.0) * GB_EPSILON)
#define GB_MOST_ROOT_STEPS 256

/* A polynomial with coefficients of magnitude at most one, constant term first, and the magnitudes at which its terms are evaluated. */
typedef struct {
    gb_real a[GB_MOST_COEFFICIENTS];
    size_t degree;
    gb_scale scale;
} gb_scaled;

/* Real roots, ascending. */
typedef struct {
    gb_real values[GB_MOST_COEFFICIENTS];
    size_t count;
} gb_list;

static void gb_push(gb_list *roots, gb_real x)
{
    if (gb_is_finite(x) && roots->count < GB_MOST_COEFFICIENTS) {
        roots->values[roots->count++] = x + R(0.0);
    }
}

/* The polynomial divided by its largest coefficient. */
static void gb_normalise(gb_scaled *p)
{
    const gb_real largest = gb_largest(p->a, p->degree + 1);
    for (size_t i = 0; i <= p->degree; i++) {
        p->a[i] /= largest;
    }
}

/* Drops negligible leading coefficients and divides by the largest; false when the rest is constant. */
static bool gb_make_polynomial(const gb_real *coefficients, size_t length, gb_scale scale, gb_scaled *p)
{
    const gb_real largest = gb_largest(coefficients, length);
    bool are_finite = true;
    for (size_t i = 0; i < length; i++) {
        are_finite = are_finite && gb_is_finite(coefficients[i]);
    }
    while (length > 0 && gb_magnitude(coefficients[length - 1]) <= GB_ROOTS_ZERO * largest) {
        length--;
    }
    if (length == 0 || length > GB_MOST_COEFFICIENTS || !are_finite) {
        return false;
    }
    memset(p, 0, sizeof *p);
    memcpy(p->a, coefficients, length * sizeof *coefficients);
    p->degree = length - 1;
    p->scale = scale;
    gb_normalise(p);
    return true;
}

/* A positive multiple of the derivative of `order`. */
static void gb_derivative(const gb_scaled *p, size_t order, gb_scaled *derivative)
{
    gb_real binomial = R(1.0);
    memset(derivative, 0, sizeof *derivative);
    derivative->degree = p->degree - order;
    derivative->scale = p->scale;
    for (size_t i = 0; i <= derivative->degree; i++) {
        derivative->a[i] = binomial * p->a[i + order];
        binomial = binomial * (gb_real)(i + 1 + order) / (gb_real)(i + 1);
    }
    gb_normalise(derivative);
}

/* The roots of a quadratic polynomial without cancellation; a double root is reported once. */
static void gb_quadratic_roots(const gb_scaled *p, gb_list *roots)
{
    const gb_real c = p->a[0], b = p->a[1], a = p->a[2];
    const gb_real discriminant = b * b - R(4.0) * a * c;
    const gb_real size = b * b + gb_magnitude(R(4.0) * a * c);
    const gb_real typical = R(2.0) * a * gb_scale_at(p->scale, R(0.0)), spread = p->scale.spread;
    roots->count = 0;
    if (discriminant < -GB_ROOTS_TANGENT * gb_larger(size * (spread * spread), typical * typical)) {
        return;
    }
    if (discriminant <= GB_SIGNLESS * size) {
        gb_push(roots, -b / (R(2.0) * a));
        return;
    }
    const gb_real q = R(-0.5) * (b + gb_signed(gb_square_root(discriminant), b));
    const gb_real first = q / a, second = c / q;
    gb_push(roots, second < first || first != first ? second : first);
    gb_push(roots, second > first || first != first ? second : first);
}

/* Whether `|a_n| r^n` exceeds the sum of all other `|a_i| r^i`: then no root is as large as `r`. */
static bool gb_is_led(const gb_scaled *p, gb_real radius)
{
    gb_real value = gb_magnitude(p->a[p->degree]);
    for (size_t i = p->degree; i-- > 0;) {
        value = value * radius - gb_magnitude(p->a[i]);
    }
    return value > R(0.0);
}

/* Two to four times Cauchy's bound: every root, and every root of a derivative, is well inside. */
static gb_real gb_root_bound(const gb_scaled *p)
{
    gb_real radius = R(1.0);
    while (!gb_is_led(p, radius)) {
        radius *= R(2.0);
    }
    while (gb_is_led(p, R(0.5) * radius)) {
        radius *= R(0.5);
    }
    return R(2.0) * radius;
}

/* p(x), and sum |a_i y^i|. */
static gb_real gb_value_and_size(const gb_scaled *p, gb_real x, gb_real y, gb_real *size)
{
    gb_real value = R(0.0);
    *size = R(0.0);
    for (size_t i = p->degree + 1; i-- > 0;) {
        value = value * x + p->a[i];
        *size = *size * y + gb_magnitude(p->a[i]);
    }
    return value;
}

/* The sign of `p(x)`: `-1`, `0` or `1`; zero where rounding determines it. */
static gb_real gb_sign(const gb_scaled *p, gb_real x)
{
    gb_real size;
    const gb_real value = gb_value_and_size(p, x, gb_magnitude(x), &size);
    const gb_real noise = GB_SIGNLESS * (gb_real)p->degree * size;
    return value == R(0.0) || (gb_is_finite(noise) && gb_magnitude(value) <= noise) ? R(0.0) : gb_signed(R(1.0), value);
}

/* Whether `p(x)` is negligible. */
static bool gb_touches(const gb_scaled *p, gb_real x)
{
    gb_real size;
    const gb_real value = gb_value_and_size(p, x, gb_scale_at(p->scale, x), &size);
    return gb_is_finite(size) && gb_magnitude(value) <= GB_ROOTS_TANGENT * size;
}

/* The arithmetic mean, or one of the exponents: bounds may differ by hundreds of decades. */
static gb_real gb_middle(gb_real low, gb_real high, bool is_arithmetic)
{
    if (is_arithmetic) {
        return R(0.5) * low + R(0.5) * high;
    }
    if (low < R(0.0) && high > R(0.0)) {
        return R(0.0);
    }
    const gb_real a = gb_square_root(gb_larger(GB_LEAST_POSITIVE, gb_magnitude(low)));
    const gb_real b = gb_square_root(gb_larger(GB_LEAST_POSITIVE, gb_magnitude(high)));
    return gb_signed(a * b, low + high);
}

/* A Newton step from x, and p(x). */
static gb_real gb_newton(const gb_scaled *p, gb_real x, gb_real *value)
{
    gb_real slope = R(0.0);
    *value = R(0.0);
    for (size_t i = p->degree + 1; i-- > 0;) {
        slope = slope * x + *value;
        *value = *value * x + p->a[i];
    }
    return x - *value / slope;
}

/* The root between two points where `p` is monotone and changes its sign. Newton's method is used while it reduces its steps to a quarter and stays inside,
 * else bisection. */
static gb_real gb_root_between(const gb_scaled *p, gb_real low, gb_real high)
{
    const bool is_rising = gb_sign(p, high) > R(0.0);
    gb_real x = R(0.5) * low + R(0.5) * high, step = high - low;
    bool is_arithmetic = true;
    for (int i = 0; i < GB_MOST_ROOT_STEPS; i++) {
        gb_real value;
        const gb_real newton = gb_newton(p, x, &value);
        if (value == R(0.0)) {
            return x;
        }
        if ((value > R(0.0)) == is_rising) {
            high = x;
        } else {
            low = x;
        }
        if (gb_magnitude(newton - x) <= GB_EPSILON * gb_magnitude(x)) {
            return gb_smaller(high, gb_larger(low, newton));
        }
        gb_real next = newton;
        if (!(low < newton && newton < high && R(4.0) * gb_magnitude(newton - x) <= step)) {
            is_arithmetic = !is_arithmetic;
            next = gb_middle(low, high, is_arithmetic);
        }
        if (next <= low || next >= high) {
            return x;
        }
        step = gb_magnitude(next - x);
        x = next;
    }
    return x;
}

/* The roots, given the ascending critical points and a bound on all of them. There is one in each interval with a change of sign. Critical points where `p`
 * touches the axis are roots too. */
static void gb_roots_between(const gb_scaled *p, const gb_list *critical, gb_real bound, gb_list *roots)
{
    gb_real low = -bound, low_sign = gb_sign(p, low);
    bool is_tangency = false;
    roots->count = 0;
    for (size_t i = 0; i <= critical->count; i++) {
        const gb_real high = i < critical->count ? critical->values[i] : bound, high_sign = gb_sign(p, high);
        const bool crosses = low_sign * high_sign < R(0.0);
        if (crosses) {
            gb_push(roots, gb_root_between(p, low, high));
        } else if (is_tangency) {
            gb_push(roots, low);
        }
        is_tangency = !crosses && gb_touches(p, high);
        low = high;
        low_sign = high_sign;
    }
}

/* All real roots of a polynomial. */
static void gb_all_roots(const gb_scaled *p, gb_list *roots)
{
    gb_scaled derivative;
    gb_list critical;
    roots->count = 0;
    if (p->degree < 2) {
        if (p->degree == 1) {
            gb_push(roots, -p->a[0] / p->a[1]);
        }
        return;
    }
    const gb_real bound = gb_root_bound(p);
    gb_derivative(p, p->degree - 2, &derivative);
    gb_quadratic_roots(&derivative, roots);
    for (size_t order = p->degree - 2; order-- > 0;) {
        critical = *roots;
        gb_derivative(p, order, &derivative);
        gb_roots_between(&derivative, &critical, bound, roots);
    }
}

/* The first polynomial whose leading coefficient is not negligible, or the last one. */
static const gb_polynomial_1 *gb_leading(const gb_polynomial_1 *list, size_t count)
{
    for (size_t i = 0; i + 1 < count; i++) {
        const gb_real *coefficients = list[i].coefficients;
        const size_t length = list[i].length;
        if (length > 0 && gb_magnitude(coefficients[length - 1]) > GB_ROOTS_PIVOT * gb_largest(coefficients, length)) {
            return &list[i];
        }
    }
    return &list[count - 1];
}

/* All real roots, ascending, of the first polynomial with a significant leading coefficient. Returns their number, and whether some are close to each other
 * or one is double. Roots that agree within rounding are reported once. So is a double root that misses the axis by rounding. */
GB_LINKAGE size_t gb_real_roots(const gb_polynomial_1 *list, size_t count, gb_scale scale, gb_real *values, size_t room, bool *close)
{
    const gb_polynomial_1 *polynomial = gb_leading(list, count);
    gb_list roots;
    gb_scaled p;
    *close = false;
    roots.count = 0;
#ifndef GB_FLOAT
    gb_real four[4];
    const int ordinary = polynomial->length == 5 ? gb_ordinary_roots(polynomial->coefficients, scale, four) : -1;
    for (int i = 0; i < ordinary; i++) {
        gb_push(&roots, four[i]);
    }
    const bool is_ordinary = ordinary >= 0;
#else
    const bool is_ordinary = false;
#endif
    if (!is_ordinary && gb_make_polynomial(polynomial->coefficients, polynomial->length, scale, &p)) {
        gb_all_roots(&p, &roots);
        *close = roots.count > 0 && roots.count % 2 == polynomial->length % 2;
        for (size_t i = 1; i < roots.count; i++) {
            *close = *close || roots.values[i] - roots.values[i - 1] <= GB_ROOTS_CLOSE * gb_scale_at(scale, R(0.0));
        }
    }
    const size_t kept = roots.count < room ? roots.count : room;
    for (size_t i = 0; i < kept; i++) {
        values[i] = roots.values[i];
    }
    return kept;
}

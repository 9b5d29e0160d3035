/* What seldom runs on a robot, for all robots: polynomials' roots, Newton's method next to singular configurations, self-motions, answers that are one,
 * limits and turns. As groebot-runtime's files of the same names, operation by operation; robots come in by a gb_mechanism. */
#ifndef GROEBOT_C
#define GROEBOT_C

#ifndef GB_RUNTIME
#define GB_RUNTIME
#endif
#include "groebot.h"

/* The tolerances are those of groebot-runtime's tolerances.rs, which says what they are for. */
#define GB_MERGE GB_EITHER(1e-7, 2e-3)
#define GB_PIVOT GB_EITHER(1e-9, 1e-4)
#define GB_NEGLIGIBLE GB_EITHER(1e-290, 1e-30)
#define GB_POLISH_STEPS 32
#define GB_OVERSHOT R(100.0)
#define GB_RETURNS 4
#define GB_STIFF R(1e-6)
#define GB_PATIENCE 3
#define GB_POLISHED GB_EITHER(1e-15, 2e-7)
#define GB_SHORT GB_EITHER(1e-9, 1e-4)
#define GB_ADRIFT GB_EITHER(1e-7, 1e-3)
#define GB_ASIDE R(0.1)
#define GB_SINGULAR GB_EITHER(1e-13, 3e-5)
#define GB_REGULAR GB_EITHER(1e-6, 1e-2)
#define GB_DISTINCT GB_EITHER(1e-4, 1e-2)
#define GB_NARROWS GB_EITHER_COUNT(5, 1)
#define GB_DOUBLINGS 8
#define GB_APART_BY R(0.7)
#define GB_FARTHER R(16.0)
#define GB_FARTHEST R(256.0)
#define GB_ALONE GB_EITHER(1e-13, 5e-6)
#define GB_LEVER R(0.1)
#define GB_TWIN R(10.0)
#define GB_INVERSIONS 3
#define GB_ALIKE GB_EITHER(2.5e-15, 1e-6)
#define GB_ARRIVED R(1e-3)
#define GB_STAGES 4
#define GB_SLACK GB_EITHER(1e-9, 1e-5)
#define GB_STRIDE R(0.1)
#define GB_STRIDES 63

#ifdef GB_FLOAT
#define GB_EITHER_COUNT(number, single) single
#else
#define GB_EITHER_COUNT(number, single) number
#endif

static const gb_real gb_leaps[] = {R(0.5), R(0.1), R(0.02)};
static const gb_real gb_twins_at[] = {R(-2.0), R(2.0), R(-16.0), R(16.0)};
#ifdef GB_FLOAT
static const gb_real gb_dampings[] = {R(0.0), R(1e-5), R(1e-4), R(1e-3)};
#else
static const gb_real gb_dampings[] = {R(0.0), R(1e-12), R(1e-9), R(1e-6), R(1e-3), R(1e-18)};
#endif

#define GB_LENGTH_OF(list) (sizeof(list) / sizeof(list)[0])

/* Whether a number is finite. */
static bool gb_is_finite(gb_real x)
{
    return gb_magnitude(x) <= GB_GREATEST;
}

/* Whether a number is within bounds. */
static bool gb_is_between(gb_real x, gb_real low, gb_real high)
{
    return x >= low && x <= high;
}

/* ---- Angles, cosines and sines: trigonometry.rs ---- */

/* The number without what is behind its point. */
static gb_real gb_whole(gb_real x)
{
    return gb_magnitude(x) < R(1.0) / GB_EPSILON ? gb_signed((gb_real)(int64_t)x, x) : x;
}

/* The nearest whole number, halves away from zero: what is added is just below one half, which must not round up to one. */
GB_LINKAGE gb_real gb_round(gb_real x)
{
    return gb_whole(x + gb_signed(R(0.5) - R(0.25) * GB_EPSILON, x));
}

/* The greatest whole number that is not greater. */
static gb_real gb_floor(gb_real x)
{
    const gb_real whole = gb_whole(x);
    return whole > x ? whole - R(1.0) : whole;
}

/* The least whole number that is not less. */
static gb_real gb_ceiling(gb_real x)
{
    return -gb_floor(-x);
}

/* The angle moved by whole turns into (-pi, pi]. */
GB_LINKAGE gb_real gb_wrap(gb_real angle)
{
    const gb_real wrapped = angle - GB_TAU * gb_round(angle / GB_TAU);
    return wrapped <= -GB_PI ? wrapped + GB_TAU : wrapped;
}

/* atan2(sine, cosine) in (-pi, pi], zero never negative; not a number where both are zero. As the header has it for any type of number. */
GB_LINKAGE gb_real gb_angle(gb_real cosine, gb_real sine)
{
    const gb_real across = gb_magnitude(cosine), up = gb_magnitude(sine);
    const bool is_steep = up > across;
    const gb_real low = is_steep ? across : up, high = is_steep ? up : across;
    const bool is_far = low > R(0.41421356237309503) * high;
    const gb_real z = (is_far ? low - high : low) / (is_far ? low + high : high);
    const gb_real u = z * z, square = u * u, fourth = u * u * (u * u);
    const gb_real first = R(-0.3333333333333333) + R(0.1999999999999552) * u + (R(-0.14285714284666542) + R(0.11111111015256361) * u) * square;
    const gb_real second = R(-0.09090904578123903) + R(0.07692183190826087) * u + (R(-0.06664511447381948) + R(0.0585814891280221) * u) * square;
    const gb_real third = R(-0.05085449737940259) + R(0.03923165829558718) * u + R(-0.019176887119062243) * square;
    const gb_real small = z + z * (z * z) * (first + (second + third * fourth) * fourth);
    const gb_real angle = is_far ? GB_PI / R(4.0) + (small + GB_REST) : small;
    const gb_real acute = is_steep ? GB_PI / R(2.0) - (angle - R(2.0) * GB_REST) : angle;
    const gb_real whole = gb_signed(cosine < R(0.0) ? GB_PI - (acute - R(4.0) * GB_REST) : acute, sine);
    return (whole <= -GB_PI ? whole + GB_TAU : whole) + R(0.0);
}

/* The number of quarter turns nearest to an angle, and what is left, in two numbers. */
static int64_t gb_reduced(gb_real angle, gb_real *x, gb_real *rest)
{
    if (gb_magnitude(angle) > GB_EITHER(1e6, 1e3)) {
        angle = GB_EITHER_COUNT(fmod, fmodf)(angle, GB_TAU);
    }
    const gb_real quarters = gb_round(angle * R(0.6366197723675814));
    /* Products of the first two parts are exact, and so is the first difference. */
    const gb_real first = angle - quarters * GB_EITHER(1.5707963267341256, 1.5703125);
    const gb_real second = quarters * GB_EITHER(6.077100506303966e-11, 4.837512969970703e-4);
    const gb_real sum = first - second, almost = first - sum;
    const gb_real lost = (first - (sum + almost)) + (almost - second);
    const gb_real third = lost - quarters * GB_EITHER(2.0222662487959506e-21, 7.54978995489188e-8);
    *x = sum + third;
    *rest = (sum - *x) + third;
    return gb_is_finite(quarters) ? (int64_t)quarters : 0;
}

/* The sine of x + rest for |x| <= pi/4. */
static gb_real gb_sine_of(gb_real x, gb_real rest)
{
    const gb_real u = x * x;
    const gb_real high = R(0.008333333333330948)
        + u * (R(-0.00019841269836758574) + u * (R(2.755731610255244e-06) + u * (R(-2.5051131845003624e-08) + u * R(1.5918129294866608e-10))));
    return x + (x * u * (R(-0.16666666666666666) + u * high) + rest * (R(1.0) - R(0.5) * u));
}

/* The cosine of x + rest for |x| <= pi/4. */
static gb_real gb_cosine_of(gb_real x, gb_real rest)
{
    const gb_real u = x * x, half = R(0.5) * u, first = R(1.0) - half;
    const gb_real low = R(2.480158729876569e-05) + u * (R(-2.7557317271729793e-07) + u * (R(2.08761462684032e-09) + u * R(-1.1382632425521717e-11)));
    const gb_real high = R(0.041666666666666664) + u * (R(-0.0013888888888887398) + u * low);
    return first + (((R(1.0) - first) - half) + (u * u * high - x * rest));
}

/* The sine of an angle and so many quarter turns. */
static gb_real gb_sine_behind(gb_real angle, int64_t quarters)
{
    gb_real x, rest;
    quarters = (quarters + gb_reduced(angle, &x, &rest)) & 3;
    const gb_real size = quarters & 1 ? gb_cosine_of(x, rest) : gb_sine_of(x, rest);
    return quarters & 2 ? -size : size;
}

/* The cosine of an angle in rad, within one unit of its last place up to a million rad. */
GB_LINKAGE gb_real gb_cosine(gb_real angle)
{
    return gb_sine_behind(angle, 1);
}

/* The sine of an angle in rad, within one unit of its last place up to a million rad. */
GB_LINKAGE gb_real gb_sine(gb_real angle)
{
    return gb_sine_behind(angle, 0);
}

/* ---- The real roots of an ordinary quartic: quartic.rs (G. Cardano, "Ars Magna", 1545) ---- */

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
/* The greatest root of z^3 + u z^2 + v z - w for w > 0, to half its digits, by Newton steps down from a bound of it: a root above `typical` has
 * z^2 <= -u z - v + w / typical. Below zero where there is none. */
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
        if (gb_magnitude(step) <= R(1e-5) * z) {
            return w > R(0.0) ? z : R(-1.0);
        }
    }
    return R(-1.0);
}

/* Two Newton steps from a root's approximation; not a number where they do not settle. */
static gb_real gb_settled(const gb_real *c, gb_real x, gb_real scale)
{
    gb_real step = R(0.0);
    for (int i = 0; i < 2; i++) {
        const gb_real value = (((x + c[3]) * x + c[2]) * x + c[1]) * x + c[0];
        const gb_real slope = ((R(4.0) * x + R(3.0) * c[3]) * x + R(2.0) * c[2]) * x + c[1];
        step = value / slope;
        x -= step;
    }
    return gb_magnitude(step) <= R(1e-9) * gb_larger(scale, gb_magnitude(x)) ? x : NAN;
}

#define GB_FOUR_DISTINCT R(2e-3)

/* The roots of the two real quadratics whose product is x^4 + c3 x^3 + c2 x^2 + c1 x + c0: two of either, ascending, the second two next to the first; how
 * many, or below zero where the quartic is not ordinary. */
static int gb_approximate_roots(const gb_real *c, gb_real scale, gb_real *roots)
{
    /* With y = x + c3 / 4 it is y^4 + p y^2 + q y + r. */
    const gb_real quarter = R(0.25) * c[3], square = c[3] * c[3];
    const gb_real p = c[2] - R(0.375) * square;
    const gb_real q = c[1] - R(0.5) * c[3] * (c[2] - R(0.25) * square);
    const gb_real r = c[0] - quarter * (c[1] - quarter * (c[2] - R(0.1875) * square));
    /* (y^2 + h y + f) (y^2 - h y + g) with z = h^2. */
    const gb_real z = gb_resolved(R(2.0) * p, p * p - R(4.0) * r, q * q, scale * scale);
    if (z < R(0.0)) {
        return -1;
    }
    const gb_real h = gb_square_root(z), mean = R(0.5) * (p + z), half = R(0.5) * q / h;
    const gb_real f = mean - half, g = mean + half;
    const gb_real size = gb_larger(gb_larger(z, gb_magnitude(f)), gb_magnitude(g));
    if (!(gb_magnitude(f * g - r) <= R(1e-8) * size * size)) {
        return -1;
    }
    const gb_real others[2] = {g, f}, discriminants[2] = {z - R(4.0) * f, z - R(4.0) * g}, middles[2] = {R(-0.5) * h, R(0.5) * h};
    int count = 0;
    for (int i = 0; i < 2; i++) {
        const gb_real apart = R(0.5) * gb_square_root(gb_magnitude(discriminants[i]));
        if (discriminants[i] > R(0.0)) {
            roots[count++] = middles[i] - apart - quarter;
            roots[count++] = middles[i] + apart - quarter;
        } else if (!(apart > GB_FOUR_DISTINCT * gb_larger(scale, gb_square_root(size))
                     && gb_magnitude(others[i] + R(0.75) * z) > GB_FOUR_DISTINCT * gb_larger(size, scale * scale))) {
            return -1;
        }
    }
    return count;
}

/* Puts two ascending pairs into order. */
static void gb_merge_pairs(gb_real *roots)
{
    const gb_real low = gb_smaller(roots[1], roots[3]), high = gb_larger(roots[0], roots[2]);
    const gb_real first = gb_smaller(roots[0], roots[2]), last = gb_larger(roots[1], roots[3]);
    roots[0] = first;
    roots[1] = gb_smaller(low, high);
    roots[2] = gb_larger(low, high);
    roots[3] = last;
}

/* All real roots of the quartic with these coefficients, ascending; below zero where it is not ordinary: its leading coefficient is small, roots are next to
 * each other or complex ones next to the axis, or the steps do not settle. */
static int gb_ordinary_roots(const gb_real *coefficients, gb_real scale, gb_real *roots)
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
        roots[i] = gb_settled(monic, roots[i], scale);
        are_settled = are_settled && roots[i] == roots[i];
    }
    if (!are_settled) {
        return -1;
    }
    if (count == 4) {
        gb_merge_pairs(roots);
    }
    for (int i = 1; i < count; i++) {
        const gb_real size = gb_larger(gb_larger(scale, gb_magnitude(roots[i - 1])), gb_magnitude(roots[i]));
        if (!(roots[i] - roots[i - 1] > GB_FOUR_DISTINCT * size)) {
            return -1;
        }
    }
    return count;
}
#endif

/* ---- Real roots of polynomials of one unknown: roots.rs ---- */

/* Values of p up to degree GB_SIGNLESS sum |a_i x^i| have no sign. */
#define GB_SIGNLESS (R(2.0) * GB_EPSILON)
#define GB_MOST_ROOT_STEPS 256

/* A polynomial with coefficients of magnitude one and less, constant term first, and the unknown's typical size. */
typedef struct {
    gb_real a[GB_MOST_COEFFICIENTS];
    size_t degree;
    gb_real scale;
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
static void gb_scale(gb_scaled *p)
{
    const gb_real largest = gb_largest(p->a, p->degree + 1);
    for (size_t i = 0; i <= p->degree; i++) {
        p->a[i] /= largest;
    }
}

/* Drops negligible leading coefficients and divides by the largest; false when nothing solvable is left. */
static bool gb_make_polynomial(const gb_real *coefficients, size_t length, gb_real scale, gb_scaled *p)
{
    const gb_real largest = gb_largest(coefficients, length);
    bool are_finite = true;
    for (size_t i = 0; i < length; i++) {
        are_finite = are_finite && gb_is_finite(coefficients[i]);
    }
    while (length > 0 && gb_magnitude(coefficients[length - 1]) <= GB_NEGLIGIBLE * largest) {
        length--;
    }
    if (length == 0 || length > GB_MOST_COEFFICIENTS || !are_finite) {
        return false;
    }
    memset(p, 0, sizeof *p);
    memcpy(p->a, coefficients, length * sizeof *coefficients);
    p->degree = length - 1;
    p->scale = scale;
    gb_scale(p);
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
    gb_scale(derivative);
}

/* The roots of a quadratic polynomial without cancellation, and the double root of a tangency once. */
static void gb_quadratic_roots(const gb_scaled *p, gb_list *roots)
{
    const gb_real c = p->a[0], b = p->a[1], a = p->a[2];
    const gb_real discriminant = b * b - R(4.0) * a * c;
    const gb_real size = b * b + gb_magnitude(R(4.0) * a * c);
    const gb_real typical = R(2.0) * a * p->scale;
    roots->count = 0;
    if (discriminant < -GB_TANGENT * gb_larger(size, typical * typical)) {
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

/* Whether |a_n| r^n is more than all other |a_i| r^i together: then no root is as large as r. */
static bool gb_is_led(const gb_scaled *p, gb_real radius)
{
    gb_real value = gb_magnitude(p->a[p->degree]);
    for (size_t i = p->degree; i-- > 0;) {
        value = value * radius - gb_magnitude(p->a[i]);
    }
    return value > R(0.0);
}

/* Two to four times Cauchy's radius: every root, and every root of a derivative, is well inside. */
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

/* p(x), and sum |a_i y^i| for the larger y of |x| and `scale`. */
static gb_real gb_value_and_size(const gb_scaled *p, gb_real x, gb_real scale, gb_real *size)
{
    const gb_real larger = gb_larger(scale, gb_magnitude(x));
    gb_real value = R(0.0);
    *size = R(0.0);
    for (size_t i = p->degree + 1; i-- > 0;) {
        value = value * x + p->a[i];
        *size = *size * larger + gb_magnitude(p->a[i]);
    }
    return value;
}

/* -1, 0 or 1: the sign of p(x), zero when rounding decides it. */
static gb_real gb_sign(const gb_scaled *p, gb_real x)
{
    gb_real size;
    const gb_real value = gb_value_and_size(p, x, R(0.0), &size);
    const gb_real noise = GB_SIGNLESS * (gb_real)p->degree * size;
    return value == R(0.0) || (gb_is_finite(noise) && gb_magnitude(value) <= noise) ? R(0.0) : gb_signed(R(1.0), value);
}

/* Whether p(x) is negligible. */
static bool gb_touches(const gb_scaled *p, gb_real x)
{
    gb_real size;
    const gb_real value = gb_value_and_size(p, x, p->scale, &size);
    return gb_is_finite(size) && gb_magnitude(value) <= GB_TANGENT * size;
}

/* The arithmetic mean, or one that halves the exponents: bounds may be hundreds of decades apart. */
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

/* The root between two points where p is monotone and changes its sign: Newton's method, which must cut its steps to a quarter and stay inside, else
 * bisection. */
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

/* The roots, given the ascending critical points and a bound on all of them: one in each interval where the sign changes, and the critical points where p
 * touches the axis. */
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
        if (length > 0 && gb_magnitude(coefficients[length - 1]) > GB_PIVOT * gb_largest(coefficients, length)) {
            return &list[i];
        }
    }
    return &list[count - 1];
}

/* All real roots of the first polynomial that counts, ascending; how many, and whether some are close to one another, or one is double. Roots that rounding
 * cannot tell apart, and a double root that misses the axis by rounding, measured at the unknown's typical size `scale`, are reported once. */
GB_LINKAGE size_t gb_real_roots(const gb_polynomial_1 *list, size_t count, gb_real scale, gb_real *values, size_t room, bool *close)
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
            *close = *close || roots.values[i] - roots.values[i - 1] <= GB_MEETING * scale;
        }
    }
    const size_t kept = roots.count < room ? roots.count : room;
    for (size_t i = 0; i < kept; i++) {
        values[i] = roots.values[i];
    }
    return kept;
}

/* ---- Joint values: joints.rs ---- */

/* Joint values, and how well they solve the equations. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_fit fit;
} gb_end;

static bool gb_is_in(uint32_t set, size_t joint)
{
    return (set >> joint & 1) != 0;
}

static void gb_copy(gb_real *to, const gb_real *from, size_t count)
{
    memcpy(to, from, count * sizeof *to);
}

/* A difference of two values of a joint, of angles by the shorter way round. */
static gb_real gb_shortest(const gb_mechanism *m, size_t joint, gb_real difference)
{
    if (!m->joint[joint].is_angle) {
        return difference;
    }
    return difference > GB_PI ? difference - GB_TAU : difference < -GB_PI ? difference + GB_TAU : difference;
}

/* What a joint's differences are shares of: one for an angle, a length's size. */
static gb_real gb_span(const gb_mechanism *m, size_t joint, gb_real value)
{
    return m->joint[joint].is_angle ? R(1.0) : gb_larger(m->scale, gb_magnitude(value));
}

/* The value of a joint, an angle in (-pi, pi]. */
static gb_real gb_wrapped(const gb_mechanism *m, size_t joint, gb_real value)
{
    return m->joint[joint].is_angle ? gb_wrap(value) : value;
}

/* Whether joint values differ by `tolerance` at most, those of a set left out. */
static bool gb_is_close(const gb_mechanism *m, const gb_real *a, const gb_real *b, uint32_t left_out, gb_real tolerance)
{
    for (size_t k = 0; k < m->joints; k++) {
        const size_t i = m->last_first[k];
        if (!gb_is_in(left_out, i) && !(gb_magnitude(gb_shortest(m, i, a[i] - b[i])) <= tolerance * gb_span(m, i, a[i]))) {
            return false;
        }
    }
    return true;
}

/* The farthest that a joint is from b in a: an angle, or a share of a length's size. */
static gb_real gb_farthest(const gb_mechanism *m, const gb_real *a, const gb_real *b)
{
    gb_real farthest = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        farthest = gb_larger(farthest, gb_magnitude(gb_shortest(m, i, a[i] - b[i])) / gb_span(m, i, a[i]));
    }
    return farthest;
}

/* The longest way of a joint in a step: an angle, or a share of the length scale. */
static gb_real gb_longest(const gb_mechanism *m, const gb_real *step)
{
    gb_real longest = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        longest = gb_larger(longest, m->joint[i].is_angle ? gb_magnitude(step[i]) : gb_magnitude(step[i]) / m->scale);
    }
    return longest;
}

/* a - b joint by joint, angles by the shorter way round. */
static void gb_differences(const gb_mechanism *m, const gb_real *a, const gb_real *b, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = gb_shortest(m, i, a[i] - b[i]);
    }
}

/* q - step, angles in (-pi, pi]. */
static void gb_stepped(const gb_mechanism *m, const gb_real *q, const gb_real *step, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = gb_wrapped(m, i, q[i] - step[i]);
    }
}

/* A joint's value moved: an angle by `way`, a length by that share of its size. */
static gb_real gb_moved(const gb_mechanism *m, const gb_real *q, size_t joint, gb_real way)
{
    return gb_wrapped(m, joint, q[joint] + way * gb_span(m, joint, q[joint]));
}

/* The joints beyond b on the line from a, by `ahead` times their distance. */
static void gb_beyond(const gb_mechanism *m, const gb_real *a, const gb_real *b, gb_real ahead, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = b[i] + ahead * gb_shortest(m, i, b[i] - a[i]);
    }
}

/* ---- The equations at one target: problem.rs ---- */

/* What the equations read of joint values. */
GB_LINKAGE void gb_place(const gb_problem *problem, const gb_real *q, gb_real *at)
{
    const gb_mechanism *m = problem->mechanism;
    for (size_t i = 0; i < m->places; i++) {
        at[i] = problem->extras ? problem->extras[i] : R(0.0);
    }
    for (size_t i = 0; i < m->joints; i++) {
        const gb_joint joint = m->joint[i];
        at[joint.places[0]] = joint.is_angle ? gb_cosine(q[i]) : q[i];
        if (joint.is_angle) {
            at[joint.places[1]] = gb_sine(q[i]);
        }
    }
}

/* How well joint values solve the equations, which read of them what is at `at`. */
GB_LINKAGE gb_fit gb_measure_at(const gb_problem *problem, const gb_real *at, const gb_real *q)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real values[GB_MAX_EQUATIONS], sizes[GB_MAX_SIZES], largest[GB_MAX_SIZES] = {R(0.0)};
    gb_fit fit = {R(0.0), R(0.0), true};
    m->values(problem->p, at, values);
    m->measures(problem->p, at, sizes);
    for (size_t i = 0; i < m->joints; i++) {
        fit.accepted = fit.accepted && gb_is_finite(q[i]);
    }
    for (size_t i = 0; i < m->equations; i++) {
        const size_t size = m->size_of[i];
        const gb_real value = gb_magnitude(values[i]);
        largest[size] = gb_larger(largest[size], value);
        fit.accepted = fit.accepted && value <= GB_ACCEPT * sizes[size];
    }
    for (size_t i = 0; i < m->sizes; i++) {
        fit.residual = gb_larger(fit.residual, largest[i]);
        fit.relative = gb_larger(fit.relative, largest[i] / gb_larger(GB_LEAST_POSITIVE, sizes[i]));
    }
    fit.accepted = fit.accepted && gb_is_finite(fit.residual);
    return fit;
}

/* How well joint values solve the equations. */
static gb_fit gb_measure(const gb_problem *problem, const gb_real *q)
{
    gb_real at[GB_MAX_PLACES];
    gb_place(problem, q, at);
    return gb_measure_at(problem, at, q);
}

/* How much each joint matters to the equations: the greatest derivative as a share of its equation's size, at most one; one for a length. */
static void gb_weights(const gb_problem *problem, const gb_real *q, gb_real *weights)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real at[GB_MAX_PLACES], sizes[GB_MAX_SIZES], rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS];
    gb_place(problem, q, at);
    m->jacobian(problem->p, at, rows);
    m->measures(problem->p, at, sizes);
    for (size_t i = 0; i < m->joints; i++) {
        gb_real greatest = m->joint[i].is_angle ? R(0.0) : R(1.0);
        for (size_t k = 0; m->joint[i].is_angle && k < m->equations; k++) {
            greatest = gb_larger(greatest, gb_magnitude(rows[k * m->joints + i]) / gb_larger(GB_LEAST_POSITIVE, sizes[m->size_of[k]]));
        }
        weights[i] = gb_smaller(R(1.0), greatest);
    }
}

/* ---- Newton's method with all that keeps it from going astray next to singular configurations: newton.rs ---- */

/* Columns, the right side in the last one. */
typedef struct {
    gb_real numbers[(GB_MAX_JOINTS + 1) * (GB_MAX_EQUATIONS + GB_MAX_JOINTS)];
    size_t rows;
    size_t joints;
} gb_triangle;

static gb_real *gb_column(gb_triangle *triangle, size_t column)
{
    return triangle->numbers + column * triangle->rows;
}

/* Turns columns into a triangle by reflections (A. Householder, "Unitary triangularization of a nonsymmetric matrix", 1958). */
static void gb_reflect(gb_triangle *triangle)
{
    for (size_t pivot = 0; pivot < triangle->joints; pivot++) {
        gb_real *mirror = gb_column(triangle, pivot), square = R(0.0);
        for (size_t i = pivot; i < triangle->rows; i++) {
            square = square + mirror[i] * mirror[i];
        }
        if (square == R(0.0)) {
            continue;
        }
        const gb_real length = gb_signed(gb_square_root(square), mirror[pivot]);
        mirror[pivot] += length;
        const gb_real half = length * mirror[pivot];
        for (size_t other = pivot + 1; other <= triangle->joints; other++) {
            gb_real *column = gb_column(triangle, other), along = R(0.0);
            for (size_t i = pivot; i < triangle->rows; i++) {
                along = along + mirror[i] * column[i];
            }
            along = along / half;
            for (size_t i = pivot; i < triangle->rows; i++) {
                column[i] -= along * mirror[i];
            }
        }
        mirror[pivot] = -length;
    }
}

/* The triangle of a step's equations, damped; joints that are `held` stay. */
static void gb_make_triangle(const gb_problem *problem, const gb_real *q, gb_real damping, uint32_t held, gb_triangle *triangle)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real at[GB_MAX_PLACES], rows[GB_MAX_EQUATIONS * GB_MAX_JOINTS], size = R(0.0);
    triangle->rows = m->equations + m->joints;
    triangle->joints = m->joints;
    memset(triangle->numbers, 0, (m->joints + 1) * triangle->rows * sizeof *triangle->numbers);
    gb_place(problem, q, at);
    m->jacobian(problem->p, at, rows);
    m->values(problem->p, at, gb_column(triangle, m->joints));
    for (size_t i = 0; i < m->joints; i++) {
        gb_real *column = gb_column(triangle, i), square = R(0.0);
        for (size_t k = 0; !gb_is_in(held, i) && k < m->equations; k++) {
            column[k] = rows[k * m->joints + i];
            square += column[k] * column[k];
        }
        size = gb_larger(size, square);
    }
    for (size_t i = 0; i < m->joints; i++) {
        gb_column(triangle, i)[m->equations + i] = gb_is_in(held, i) ? R(1.0) : gb_square_root(damping * size);
    }
    gb_reflect(triangle);
}

/* Solves the triangular system; false for a zero or non-finite pivot. */
static bool gb_substitute(gb_triangle *triangle, gb_real *solution)
{
    const gb_real *right = gb_column(triangle, triangle->joints);
    for (size_t row = triangle->joints; row-- > 0;) {
        const gb_real pivot = gb_column(triangle, row)[row];
        if (pivot == R(0.0) || !gb_is_finite(pivot)) {
            return false;
        }
        gb_real sum = right[row];
        for (size_t k = row + 1; k < triangle->joints; k++) {
            sum -= gb_column(triangle, k)[row] * solution[k];
        }
        solution[row] = sum / pivot;
    }
    return true;
}

/* The least-squares step (J^T J + d |J^T J|)^-1 J^T f; false when it is singular. */
static bool gb_newton_step(const gb_problem *problem, const gb_real *q, gb_real damping, uint32_t held, gb_real *step)
{
    gb_triangle triangle;
    gb_make_triangle(problem, q, damping, held, &triangle);
    return gb_substitute(&triangle, step);
}

/* The least and the greatest pivot of a triangle. */
static void gb_pivots(gb_triangle *triangle, gb_real *least, gb_real *most)
{
    *least = INFINITY;
    *most = R(0.0);
    for (size_t i = 0; i < triangle->joints; i++) {
        const gb_real pivot = gb_magnitude(gb_column(triangle, i)[i]);
        *least = gb_smaller(*least, pivot);
        *most = gb_larger(*most, pivot);
    }
}

/* The least pivot of the Jacobian's triangle at q as a share of the largest: rounding where the joints can move while the equations hold, or a root is
 * double. */
static gb_real gb_regularity(const gb_problem *problem, const gb_real *q)
{
    gb_triangle triangle;
    gb_real least, most;
    gb_make_triangle(problem, q, R(0.0), 0, &triangle);
    gb_pivots(&triangle, &least, &most);
    return least / most;
}

static gb_real gb_norm(const gb_real *vector, size_t count)
{
    gb_real sum = R(0.0);
    for (size_t i = 0; i < count; i++) {
        sum = sum + vector[i] * vector[i];
    }
    return gb_square_root(sum);
}

/* The direction in which the equations change least at q, its longest way one, and by what share of the largest pivot they do. By inverse iteration; false
 * where a pivot is zero. */
static bool gb_stillest(const gb_problem *problem, const gb_real *q, gb_real *way, gb_real *share)
{
    const size_t joints = problem->mechanism->joints;
    gb_triangle triangle;
    gb_real least, most;
    gb_make_triangle(problem, q, R(0.0), 0, &triangle);
    gb_pivots(&triangle, &least, &most);
    gb_real *right = gb_column(&triangle, joints);
    for (size_t i = 0; i < joints; i++) {
        way[i] = R(1.0);
    }
    *share = R(1.0);
    for (int i = 0; i < GB_INVERSIONS; i++) {
        for (size_t row = 0; row < joints; row++) {
            gb_real above = way[row];
            for (size_t k = 0; k < row; k++) {
                above = above - gb_column(&triangle, row)[k] * right[k];
            }
            right[row] = above / gb_column(&triangle, row)[row];
        }
        const gb_real before = gb_norm(right, joints);
        if (!gb_substitute(&triangle, way)) {
            return false;
        }
        *share = before / (gb_norm(way, joints) * most);
    }
    const gb_real longest = gb_longest(problem->mechanism, way);
    for (size_t i = 0; i < joints; i++) {
        way[i] = way[i] / longest;
    }
    return gb_is_finite(longest) && longest > R(0.0);
}

/* Newton steps on until the equations are missed by less than `relative`: from between two roots next to each other the first step leads beyond one of
 * them, and from there on each quarters the miss. */
static bool gb_return(const gb_problem *problem, gb_end *end, gb_real relative, uint32_t held)
{
    gb_real step[GB_MAX_JOINTS];
    for (int i = 0; i < GB_RETURNS; i++) {
        if (!gb_newton_step(problem, end->q, R(0.0), held, step)) {
            return false;
        }
        gb_stepped(problem->mechanism, end->q, step, end->q);
        end->fit = gb_measure(problem, end->q);
        if (end->fit.relative < relative) {
            return true;
        }
    }
    return false;
}

/* Damped steps back until the equations hold within `enough`. */
static bool gb_come_back(const gb_problem *problem, gb_end *end, gb_real enough, uint32_t held)
{
    gb_real back[GB_MAX_JOINTS];
    for (int i = 0; i < GB_RETURNS && gb_newton_step(problem, end->q, GB_STIFF, held, back); i++) {
        gb_stepped(problem->mechanism, end->q, back, end->q);
        end->fit = gb_measure(problem, end->q);
        if (end->fit.relative < enough) {
            return true;
        }
    }
    return false;
}

/* A Newton step, or a part of it, and behind it damped steps back, until the equations hold within `enough`: next to a self-motion the miss hardly changes
 * along a bent way, and rises on each straight one. */
static bool gb_leap(const gb_problem *problem, const gb_real *q, gb_real enough, uint32_t held, gb_end *end)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real step[GB_MAX_JOINTS], way[GB_MAX_JOINTS];
    if (!gb_newton_step(problem, q, R(0.0), held, step)) {
        return false;
    }
    const gb_real longest = gb_longest(m, step);
    if (!gb_is_finite(longest)) {
        return false;
    }
    for (size_t k = 0; k < GB_LENGTH_OF(gb_leaps); k++) {
        const gb_real share = gb_smaller(R(1.0), gb_leaps[k] / longest);
        for (size_t i = 0; i < m->joints; i++) {
            way[i] = share * step[i];
        }
        gb_stepped(m, q, way, end->q);
        if (gb_come_back(problem, end, enough, held)) {
            return true;
        }
    }
    return false;
}

/* The least damped step that lowers the relative residual: where it is more than rounding, to half of it, else a leap, else at all. Where it is rounding
 * and a plain step is short, that is the last. */
static bool gb_improve(const gb_problem *problem, gb_end *end, uint32_t held)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real relative = end->fit.relative;
    const bool leaps = gb_is_between(relative, GB_ROUNDING, GB_NEAR);
    const gb_real enough = leaps ? R(0.5) * relative : relative;
    bool has_fallen = false;
    gb_end fallen, next, other;
    gb_real step[GB_MAX_JOINTS];
    for (size_t k = 0; k < GB_LENGTH_OF(gb_dampings); k++) {
        const bool is_plain = k == 0;
        if (!gb_newton_step(problem, end->q, gb_dampings[k], held, step)) {
            continue;
        }
        gb_stepped(m, end->q, step, next.q);
        next.fit = gb_measure(problem, next.q);
        if (next.fit.relative < enough) {
            *end = next;
            return true;
        }
        if (is_plain && relative < GB_ROUNDING && gb_longest(m, step) <= GB_SHORT) {
            return false;
        }
        other = next;
        if (leaps && is_plain && held == 0 && next.fit.relative <= GB_OVERSHOT * relative && gb_return(problem, &other, relative, held)) {
            *end = other;
            return true;
        }
        if (next.fit.relative < relative && !has_fallen) {
            has_fallen = true;
            fallen = next;
        }
    }
    if (leaps && gb_leap(problem, end->q, enough, held, &next)) {
        *end = next;
        return true;
    }
    if (has_fallen) {
        *end = fallen;
    }
    return has_fallen;
}

/* Newton steps from joints with their fit, damped where a plain one fails; each is taken only if the relative residual falls, at once or after a leap.
 * Joints that are `held` stay. */
static void gb_polish(const gb_problem *problem, gb_end *end, uint32_t held)
{
    int slow = 0;
    for (int i = 0; i < GB_POLISH_STEPS; i++) {
        const gb_end before = *end;
        gb_real step[GB_MAX_JOINTS];
        if (before.fit.relative <= GB_POLISHED || slow == GB_PATIENCE || !gb_improve(problem, end, held)) {
            return;
        }
        slow = end->fit.relative <= gb_larger(GB_ROUNDING, R(0.5) * before.fit.relative) ? 0 : slow + 1;
        for (size_t k = 0; k < problem->mechanism->joints; k++) {
            step[k] = end->q[k] - before.q[k];
        }
        if (end->fit.relative < GB_ROUNDING && gb_longest(problem->mechanism, step) <= GB_SHORT) {
            return;
        }
    }
}

/* The same from joints that are not measured yet. */
static void gb_polish_from(const gb_problem *problem, gb_end *end, uint32_t held)
{
    end->fit = gb_measure(problem, end->q);
    gb_polish(problem, end, held);
}

/* Whether the equations hold half-way between two places next to each other, on a way that may be bent, within `bound`. */
static bool gb_are_joined(const gb_problem *problem, const gb_real *a, const gb_real *b, gb_real bound, uint32_t held)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real middle[GB_MAX_JOINTS], back[GB_MAX_JOINTS];
    if (gb_farthest(m, a, b) > GB_BLUR) {
        return false;
    }
    gb_beyond(m, a, b, R(-0.5), middle);
    gb_fit fit = gb_measure(problem, middle);
    for (int i = 0; i < GB_RETURNS; i++) {
        if (fit.relative <= bound) {
            return true;
        }
        if (!gb_newton_step(problem, middle, GB_STIFF, held, back)) {
            return false;
        }
        gb_stepped(m, middle, back, middle);
        fit = gb_measure(problem, middle);
    }
    return fit.relative <= bound;
}

/* ---- Members of self-motions: self_motion.rs ---- */

/* Whether the joints come back to q on along the line from `far` through `near`. */
static bool gb_leads_back(const gb_problem *problem, const gb_real *q, uint32_t free, const gb_real *near, const gb_real *far, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    gb_end back;
    gb_beyond(m, far, near, R(1.0), back.q);
    for (size_t i = 0; i < m->joints; i++) {
        back.q[i] = gb_is_in(free, i) ? q[i] : back.q[i];
    }
    gb_polish_from(problem, &back, free);
    return back.fit.accepted && gb_are_joined(problem, back.q, q, bound, free);
}

/* Whether the equations hold within `bound` where free joints are moved one way, which is doubled until it is that long, and from where it is short the
 * joints must come back: an isolated answer may be led to a self-motion next to it, but not back. */
static bool gb_leads_aside(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real way, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    gb_real before[GB_MAX_JOINTS], at[GB_MAX_JOINTS], share = R(1.0);
    gb_copy(before, q, m->joints);
    gb_copy(at, q, m->joints);
    for (int i = 1; i < GB_DOUBLINGS; i++) {
        share *= R(0.5);
    }
    for (int stage = 0; stage < GB_DOUBLINGS; stage++) {
        gb_end next;
        gb_beyond(m, before, at, stage == 1 ? R(1.0) : R(2.0), next.q);
        for (size_t i = 0; i < m->joints; i++) {
            next.q[i] = gb_is_in(free, i) ? gb_moved(m, q, i, share * way) : next.q[i];
        }
        gb_polish_from(problem, &next, free);
        if (next.fit.relative > bound || (stage == 1 && !gb_leads_back(problem, q, free, at, next.q, bound))) {
            return false;
        }
        gb_copy(before, at, m->joints);
        gb_copy(at, next.q, m->joints);
        share *= R(2.0);
    }
    return true;
}

/* Whether q leads aside, with what its regularity is. */
static bool gb_leads_to_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound, gb_real regularity)
{
    gb_real way = GB_ASIDE;
    bound = gb_larger(GB_ROUNDING, bound);
    if (regularity > GB_REGULAR) {
        return false;
    }
    for (int narrow = 0; narrow < GB_NARROWS; narrow++) {
        if (narrow == 1 && (bound > GB_ROUNDING || regularity > GB_SINGULAR)) {
            return false;
        }
        if (gb_leads_aside(problem, q, free, way, bound) || gb_leads_aside(problem, q, free, -way, bound)) {
            return true;
        }
        way /= R(8.0);
    }
    return false;
}

/* Whether the equations hold too, within `bound` or rounding, where the joints `free` are elsewhere and the others follow, to one side at least: to the
 * other there may be a branching. Where q is not singular that is not tried. A self-motion may go round a small part of the circle only: where q is
 * singular within rounding, shorter ways are tried as well, each an eighth of the one before. */
static bool gb_lies_on_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound)
{
    return gb_leads_to_self_motion(problem, q, free, bound, gb_regularity(problem, q));
}

/* A joint that lies alone on a self-motion, the first of those that some case frees; as a set, empty without one. */
static uint32_t gb_joint_on_self_motion(const gb_problem *problem, const gb_real *q, gb_real bound)
{
    const gb_mechanism *m = problem->mechanism;
    const gb_real regularity = m->freed_count > 0 ? gb_regularity(problem, q) : INFINITY;
    for (size_t i = 0; i < m->freed_count; i++) {
        const uint32_t free = (uint32_t)1 << m->freed[i];
        if (gb_leads_to_self_motion(problem, q, free, bound, regularity)) {
            return free;
        }
    }
    return 0;
}

/* ---- Candidates that are no answers where they were found, and answers next to each other: refine.rs ---- */

/* An answer, as groebot.c sees one in a robot's list. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_fit fit;
    size_t branch;
    uint32_t free;
} gb_answer;

/* The most answers that are compared with a new one. */
#define GB_MOST_ANSWERS 4096

static char *gb_at(const gb_answers *all, size_t i)
{
    return (char *)all->out + i * all->problem.mechanism->solution;
}

static gb_real *gb_q_of(const gb_answers *all, size_t i)
{
    return (gb_real *)(void *)gb_at(all, i);
}

static gb_real *gb_residual_of(const gb_answers *all, size_t i)
{
    return (gb_real *)(void *)(gb_at(all, i) + all->problem.mechanism->residual);
}

static gb_real *gb_relative_of(const gb_answers *all, size_t i)
{
    return (gb_real *)(void *)(gb_at(all, i) + all->problem.mechanism->relative);
}

static size_t *gb_branch_of(const gb_answers *all, size_t i)
{
    return (size_t *)(void *)(gb_at(all, i) + all->problem.mechanism->branch);
}

static bool *gb_chosen_of(const gb_answers *all, size_t i)
{
    return (bool *)(void *)(gb_at(all, i) + all->problem.mechanism->chosen);
}

static uint32_t *gb_free_of(const gb_answers *all, size_t i)
{
    return (uint32_t *)(void *)(gb_at(all, i) + all->problem.mechanism->free);
}

/* Writes an answer behind the others. */
static void gb_write(gb_answers *all, const gb_answer *answer)
{
    const size_t i = all->count++;
    gb_copy(gb_q_of(all, i), answer->q, all->problem.mechanism->joints);
    *gb_residual_of(all, i) = answer->fit.residual;
    *gb_relative_of(all, i) = answer->fit.relative;
    *gb_branch_of(all, i) = answer->branch;
    *gb_chosen_of(all, i) = false;
    *gb_free_of(all, i) = answer->free;
}

/* Exchanges two answers. */
static void gb_swap(gb_answers *all, size_t i, size_t k)
{
    char *a = gb_at(all, i), *b = gb_at(all, k);
    for (size_t byte = 0; byte < all->problem.mechanism->solution; byte++) {
        const char other = a[byte];
        a[byte] = b[byte];
        b[byte] = other;
    }
}

/* Drops an answer. */
static void gb_drop(gb_answers *all, size_t i)
{
    const size_t size = all->problem.mechanism->solution;
    all->count--;
    memmove(gb_at(all, i), gb_at(all, i + 1), (all->count - i) * size);
}

/* Remembers a candidate that is no answer if it comes nearest so far. */
static void gb_miss(gb_answers *all, const gb_real *q, const gb_fit *fit)
{
    if (!fit->accepted && gb_is_finite(fit->relative) && !(all->has_nearest && fit->relative >= all->nearest_fit.relative)) {
        all->has_nearest = true;
        all->nearest_fit = *fit;
        gb_copy(all->nearest, q, all->problem.mechanism->joints);
    }
}

/* Whether self-motion `a` has the member `b`, with the same free joints: as these move there in stages, the other joints follow. Two self-motions may be
 * next to each other: half-way from where that ends to `b` the equations hold too. */
static bool gb_leads_to(const gb_problem *problem, const gb_real *a, const gb_real *b, uint32_t free)
{
    const gb_mechanism *m = problem->mechanism;
    gb_end end;
    gb_copy(end.q, a, m->joints);
    for (int stages = GB_STAGES; stages > 0; stages--) {
        gb_real way[GB_MAX_JOINTS];
        gb_differences(m, b, end.q, way);
        for (size_t i = 0; i < m->joints; i++) {
            end.q[i] = gb_is_in(free, i) ? end.q[i] + way[i] / (gb_real)stages : end.q[i];
        }
        gb_polish_from(problem, &end, free);
    }
    return end.fit.accepted && gb_is_close(m, end.q, b, 0, GB_ARRIVED) && gb_are_joined(problem, end.q, b, GB_ROUNDING, free);
}

/* Whether two answers next to each other are one at a singular configuration, where the equations leave the joints open beyond GB_MERGE: they hold half-way
 * too, as well as at the worse of the two. */
static bool gb_are_blurred(const gb_problem *problem, const gb_real *a, gb_real relative, const gb_answer *b)
{
    const gb_real bound = gb_larger(gb_larger(relative, b->fit.relative), GB_ALIKE);
    const bool is_near = gb_farthest(problem->mechanism, a, b->q) <= GB_BLUR;
    if (bound <= GB_ROUNDING && is_near && gb_regularity(problem, b->q) > GB_DISTINCT) {
        return false;
    }
    return gb_are_joined(problem, a, b->q, bound, 0);
}

/* Whether an answer in the list and a new one are one: members of one self-motion, or within GB_MERGE with joints left out that are free in either, or one
 * singular configuration. */
static bool gb_is_one(const gb_answers *all, size_t i, const gb_answer *b)
{
    const gb_problem *problem = &all->problem;
    const gb_real *a = gb_q_of(all, i), relative = *gb_relative_of(all, i);
    const uint32_t free = *gb_free_of(all, i);
    if (gb_is_close(problem->mechanism, a, b->q, free | b->free, GB_MERGE)) {
        return true;
    }
    if (free == 0 && b->free == 0) {
        return gb_are_blurred(problem, a, relative, b);
    }
    if (free != 0 && b->free != 0) {
        return free == b->free && (*gb_branch_of(all, i) == b->branch || gb_leads_to(problem, a, b->q, free));
    }
    if (free == 0) {
        return b->fit.relative <= GB_ROUNDING && gb_lies_on_self_motion(problem, a, b->free, GB_ROUNDING);
    }
    return relative <= GB_ROUNDING && gb_lies_on_self_motion(problem, b->q, free, GB_ROUNDING);
}

/* Whether an answer in the list stays where a new one is equal to it: the better one does. But a self-motion that holds within rounding stays against its
 * members, and its first member against the others. */
static bool gb_holds_against(const gb_answers *all, size_t i, const gb_answer *b)
{
    const gb_real relative = *gb_relative_of(all, i);
    const bool is_isolated = *gb_free_of(all, i) == 0;
    if (is_isolated && b->free != 0 && b->fit.relative <= GB_ROUNDING) {
        return false;
    }
    return (!is_isolated && relative <= GB_ROUNDING) || relative <= b->fit.relative;
}

/* Adds an answer; where there are too many, the worst is left out. */
static void gb_add(gb_answers *all, const gb_answer *answer)
{
    if (all->count == all->room) {
        size_t worst = 0;
        for (size_t i = 1; i < all->count; i++) {
            worst = *gb_relative_of(all, i) >= *gb_relative_of(all, worst) ? i : worst;
        }
        if (!(all->room > 0 && answer->fit.relative < *gb_relative_of(all, worst))) {
            return;
        }
        gb_drop(all, worst);
    }
    gb_write(all, answer);
}

/* Whether some answer has this branch. */
static bool gb_is_taken(const gb_answers *all, size_t branch)
{
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_branch_of(all, i) == branch) {
            return true;
        }
    }
    return false;
}

/* The first branch from that of a candidate on that no answer has: the second root of a double one takes the next free number below `last`. */
static size_t gb_free_branch(const gb_answers *all, const gb_found_1 *found)
{
    const size_t next = found->free == 0 ? found->last : found->branch;
    for (size_t branch = found->branch; branch < next; branch++) {
        if (!gb_is_taken(all, branch)) {
            return branch;
        }
    }
    return found->branch;
}

/* Keeps an answer where others are near. */
static void gb_keep_one(gb_answers *all, gb_answer *answer, const gb_found_1 *found)
{
    uint64_t doubles[GB_MOST_ANSWERS / 64] = {0};
    const size_t count = all->count < GB_MOST_ANSWERS ? all->count : GB_MOST_ANSWERS;
    bool is_double = false;
    answer->branch = gb_free_branch(all, found);
    size_t first = answer->branch;
    for (size_t i = 0; i < count; i++) {
        if (gb_is_one(all, i, answer)) {
            if (gb_holds_against(all, i, answer)) {
                return;
            }
            doubles[i / 64] |= (uint64_t)1 << (i % 64);
            first = is_double ? first : *gb_branch_of(all, i);
            is_double = true;
        }
    }
    if (answer->free == 0) {
        answer->branch = first;
    }
    for (size_t i = count; i-- > 0;) {
        if (doubles[i / 64] >> (i % 64) & 1) {
            gb_drop(all, i);
        }
    }
    gb_add(all, answer);
}

/* Whether a candidate is the first of its branch, and far from all answers. */
static bool gb_is_first(const gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_branch_of(all, i) == found->branch || *gb_free_of(all, i) != 0
            || gb_is_close(all->problem.mechanism, gb_q_of(all, i), q, 0, GB_BLUR)) {
            return false;
        }
    }
    return found->free == 0;
}

/* Keeps an answer if the equations hold. Of answers that are one, the branch of the first and the joints of the best are kept; a second root of a double one
 * takes the next free number below `last`. */
GB_LINKAGE void gb_keep(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_fit *fit)
{
    gb_answer answer;
    if (!fit->accepted) {
        gb_miss(all, q, fit);
        return;
    }
    gb_copy(answer.q, q, all->problem.mechanism->joints);
    answer.fit = *fit;
    answer.branch = found->branch;
    answer.free = found->free;
    if (all->count < all->room && gb_is_first(all, found, q)) {
        gb_write(all, &answer);
    } else {
        gb_keep_one(all, &answer, found);
    }
}

/* Starts again from points to either side, as far as the square root of a miss: of a double root, or where an angle hardly matters. Where none leads to an
 * answer, from farther ones. */
static void gb_around(gb_answers *all, const gb_found_1 *found, const gb_end *end, gb_real missed)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_real weights[GB_MAX_JOINTS];
    bool is_found = end->fit.accepted;
    gb_weights(&all->problem, end->q, weights);
    for (gb_real farther = R(1.0); farther <= GB_FARTHEST; farther *= GB_FARTHER) {
        for (size_t i = 0; i < 2 * m->joints; i++) {
            const gb_real sign = i % 2 == 0 ? R(-1.0) : R(1.0), weight = end->fit.accepted ? R(1.0) : weights[i / 2];
            const gb_real way = gb_smaller(GB_APART_BY, farther * gb_square_root(missed / weight));
            gb_end start = *end;
            start.q[i / 2] = gb_moved(m, end->q, i / 2, R(2.0) * sign * way);
            gb_polish_from(&all->problem, &start, 0);
            is_found |= start.fit.accepted;
            gb_keep(all, found, start.q, &start.fit);
        }
        if (is_found) {
            return;
        }
    }
}

/* One double root may have been proposed where two answers are next to each other, as far apart as the square root of what it misses: from beyond both, in
 * the direction in which the equations change least, steps lead to the nearer one. */
static void gb_twin(gb_answers *all, const gb_found_1 *found, const gb_real *end, gb_real missed)
{
    const gb_problem *problem = &all->problem;
    gb_real way[GB_MAX_JOINTS], step[GB_MAX_JOINTS], at[GB_MAX_PLACES], share;
    if (!gb_stillest(problem, end, way, &share) || share > GB_TWIN * gb_square_root(missed)) {
        return;
    }
    for (size_t k = 0; k < GB_LENGTH_OF(gb_twins_at); k++) {
        const gb_real factor = gb_twins_at[k] * gb_square_root(missed);
        gb_approach approach;
        gb_end start;
        for (size_t i = 0; i < problem->mechanism->joints; i++) {
            step[i] = factor * way[i];
        }
        gb_stepped(problem->mechanism, end, step, start.q);
        gb_place(problem, start.q, at);
        if (problem->mechanism->approach(problem, at, start.q, &approach)) {
            gb_keep(all, found, approach.end, &approach.fit);
        } else {
            gb_polish_from(problem, &start, 0);
            gb_keep(all, found, start.q, &start.fit);
        }
    }
}

/* Keeps what the short way has led to from the candidate with this number, and where it is steep looks for a second answer. */
GB_LINKAGE void gb_arrive(gb_answers *all, size_t number, const gb_found_1 *found, const gb_approach *approach)
{
    gb_keep(all, found, approach->end, &approach->fit);
    if (approach->pivot < approach->missed * (found->close ? GB_STEEP : GB_MILD)) {
        all->unsound = number;
        gb_twin(all, found, approach->end, approach->missed);
    }
}

/* Keeps a candidate if it is a member of a self-motion; whether it is. */
static bool gb_keep_member(gb_answers *all, const gb_found_1 *found, const gb_end *end)
{
    const bool is_member = end->fit.accepted && gb_lies_on_self_motion(&all->problem, end->q, found->free, end->fit.relative);
    if (is_member) {
        gb_keep(all, found, end->q, &end->fit);
    }
    return is_member;
}

/* Whether an isolated answer with these joints is listed. */
static bool gb_is_listed(const gb_answers *all, const gb_real *q)
{
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_free_of(all, i) == 0 && gb_is_close(all->problem.mechanism, gb_q_of(all, i), q, 0, GB_MERGE)) {
            return true;
        }
    }
    return false;
}

/* Keeps what a candidate for a member of a self-motion has led to: a member of another self-motion, of one joint that some case frees, or an isolated
 * answer. One that has not been found before may have another next to it. */
static void gb_keep_alone(gb_answers *all, const gb_found_1 *found, const gb_end *end, gb_real missed)
{
    if (end->fit.relative > GB_ALONE) {
        gb_miss(all, end->q, &end->fit);
        return;
    }
    gb_found_1 alone = *found;
    alone.free = gb_is_listed(all, end->q) ? 0 : gb_joint_on_self_motion(&all->problem, end->q, end->fit.relative);
    const size_t known = all->count;
    gb_keep(all, &alone, end->q, &end->fit);
    if (alone.free == 0 && all->count > known && gb_is_between(missed, GB_ROUNDING, GB_NEAR)) {
        gb_around(all, &alone, end, missed);
    }
}

/* Keeps a member of a self-motion. It is moved along it only where it misses the equations by more than rounding: where the self-motion goes round a part of
 * the circle, or where there is none and an isolated answer stands near the place. */
static void gb_refine_member(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    gb_end end;
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_relative_of(all, i) <= GB_ROUNDING && *gb_branch_of(all, i) == found->branch && *gb_free_of(all, i) == found->free) {
            return;
        }
    }
    gb_copy(end.q, q, all->problem.mechanism->joints);
    end.fit = gb_measure(&all->problem, q);
    const gb_real missed = end.fit.relative;
    if (gb_is_between(missed, GB_ROUNDING, GB_ADRIFT)) {
        gb_polish(&all->problem, &end, found->free);
    }
    if (gb_keep_member(all, found, &end)) {
        return;
    }
    gb_polish(&all->problem, &end, 0);
    if (!gb_keep_member(all, found, &end)) {
        gb_keep_alone(all, found, &end, missed);
    }
}

/* Such a candidate stands between two answers: starts from the other side too. */
static void gb_start_beyond(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_end *end)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_end start;
    for (size_t i = 0; i < m->joints; i++) {
        start.q[i] = gb_wrapped(m, i, q[i] + gb_shortest(m, i, q[i] - end->q[i]));
    }
    gb_polish_from(&all->problem, &start, 0);
    gb_keep(all, found, start.q, &start.fit);
}

/* Polishes a candidate with its number, and keeps what solves the equations. Where two answers all but meet, points around it are tried too. */
GB_LINKAGE void gb_refine(gb_answers *all, size_t number, const gb_found_1 *found, const gb_real *q)
{
    const gb_problem *problem = &all->problem;
    gb_end end;
    if (found->free != 0) {
        all->unsound = number;
        gb_refine_member(all, found, q);
        return;
    }
    gb_copy(end.q, q, problem->mechanism->joints);
    end.fit = gb_measure(problem, q);
    const gb_real missed = end.fit.relative;
    gb_polish(problem, &end, 0);
    const gb_real miss = end.fit.relative, way = gb_farthest(problem->mechanism, q, end.q);
    if (!(end.fit.accepted && miss < GB_ROUNDING && way <= GB_MERGE)) {
        all->unsound = number;
    }
    if (gb_is_between(miss, GB_ROUNDING, GB_NEAR)) {
        gb_around(all, found, &end, miss);
    } else if (gb_is_between(missed, GB_ROUNDING, GB_NEAR) && way > GB_LEVER * gb_square_root(missed)) {
        gb_around(all, found, &end, missed);
        gb_start_beyond(all, found, q, &end);
    }
    if (problem->mechanism->is_nearby && gb_is_between(missed, GB_ROUNDING, GB_NEAR)) {
        gb_twin(all, found, end.q, missed);
    }
    gb_keep(all, found, end.q, &end.fit);
}

/* Whether there are more isolated answers than a target can have. */
static bool gb_are_too_many(const gb_answers *all)
{
    size_t isolated = 0;
    for (size_t i = 0; i < all->count; i++) {
        isolated += *gb_free_of(all, i) == 0;
    }
    return isolated > all->problem.mechanism->isolated;
}

/* Where there are more isolated answers than a target can have, rounding has made several of one at a singular configuration: the nearest two are one, and
 * the better of them stays. */
static void gb_unite(gb_answers *all)
{
    while (gb_are_too_many(all)) {
        gb_real least = INFINITY;
        size_t worse = 0;
        for (size_t second = 0; second < all->count; second++) {
            for (size_t first = 0; first < second; first++) {
                const gb_real distance = gb_farthest(all->problem.mechanism, gb_q_of(all, first), gb_q_of(all, second));
                if (*gb_free_of(all, first) == 0 && *gb_free_of(all, second) == 0 && distance < least) {
                    least = distance;
                    worse = *gb_relative_of(all, first) > *gb_relative_of(all, second) ? first : second;
                }
            }
        }
        gb_drop(all, worse);
    }
}

/* Insertion sort by branch. */
static void gb_sort(gb_answers *all)
{
    for (size_t end = 1; end < all->count; end++) {
        for (size_t i = end; i > 0 && *gb_branch_of(all, i - 1) > *gb_branch_of(all, i); i--) {
            gb_swap(all, i - 1, i);
        }
    }
}

/* The number whose root the source of the mechanism chooses, so that the least is its choice. */
static gb_real gb_preference(const gb_answers *all, size_t i)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_real at[GB_MAX_PLACES];
    gb_place(&all->problem, gb_q_of(all, i), at);
    return (m->prefers_greatest ? R(-1.0) : R(1.0)) * at[m->preferred];
}

/* Marks what the source would choose. */
static void gb_mark_choice(gb_answers *all)
{
    gb_real least = INFINITY;
    for (size_t i = 0; i < all->count; i++) {
        least = gb_smaller(least, gb_preference(all, i));
    }
    for (size_t i = 0; i < all->count; i++) {
        *gb_chosen_of(all, i) = gb_preference(all, i) <= least + GB_MERGE;
    }
}

/* Brings answers into order. */
GB_LINKAGE void gb_settle(gb_answers *all)
{
    gb_unite(all);
    gb_sort(all);
    if (all->problem.mechanism->preferred >= 0) {
        gb_mark_choice(all);
    }
}

/* ---- Limits of joints, and turns: limits.rs ---- */

/* The least and the greatest number of turns that bring a joint within its limits: the first is greater when none does. */
static void gb_turns_within(const gb_joint *joint, gb_real value, const gb_real *limit, gb_real *first, gb_real *last)
{
    const gb_real low = limit[0] - GB_SLACK - value, high = limit[1] + GB_SLACK - value;
    const bool is_within = low <= R(0.0) && R(0.0) <= high;
    *first = joint->is_angle ? gb_ceiling(low / GB_TAU) : R(0.0);
    *last = joint->is_angle ? gb_floor(high / GB_TAU) : is_within ? R(0.0) : R(-1.0);
}

/* The number of turns between bounds that is nearest to another; a bound that is not a number is none. */
static gb_real gb_nearest_turn(gb_real turn, gb_real first, gb_real last)
{
    return gb_smaller(gb_larger(turn, first), last) + R(0.0);
}

/* The bounds, brought together where one is infinite, and not too far apart. */
static void gb_make_finite(gb_real *first, gb_real *last)
{
    if (!gb_is_finite(*first) || !gb_is_finite(*last)) {
        *first = *last = gb_nearest_turn(R(0.0), *first, *last);
    }
    *last = gb_smaller(*first + (gb_real)GB_MOST_TURNS, *last);
}

/* A turn of an angle, 0 for a length. */
static gb_real gb_turn_of(const gb_joint *joint)
{
    return joint->is_angle ? GB_TAU : R(0.0);
}

GB_LINKAGE size_t gb_count_turns(const gb_mechanism *m, const gb_real *q, const gb_real *limits)
{
    gb_real count = R(1.0), first, last;
    for (size_t i = 0; i < m->joints; i++) {
        gb_turns_within(&m->joint[i], q[i], limits + 2 * i, &first, &last);
        if (!(first <= last)) {
            return 0;
        }
        gb_make_finite(&first, &last);
        count = gb_smaller((gb_real)GB_MOST_TURNS, count * (last - first + R(1.0)));
    }
    return (size_t)count;
}

GB_LINKAGE void gb_turn(const gb_mechanism *m, const gb_real *q, const gb_real *limits, size_t index, gb_real *out)
{
    gb_real first, last;
    for (size_t i = m->joints; i-- > 0;) {
        gb_turns_within(&m->joint[i], q[i], limits + 2 * i, &first, &last);
        gb_make_finite(&first, &last);
        const size_t count = last > first ? (size_t)(last - first) + 1 : 1;
        out[i] = q[i] + gb_turn_of(&m->joint[i]) * (first + (gb_real)(index % count));
        index /= count;
    }
}

/* Moves joints by as few turns as can be within limits; false when that cannot be. */
static bool gb_turn_within(const gb_mechanism *m, const gb_real *q, const gb_real *limits, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        gb_real first, last;
        gb_turns_within(&m->joint[i], q[i], limits + 2 * i, &first, &last);
        if (!(first <= last)) {
            return false;
        }
        out[i] = q[i] + gb_turn_of(&m->joint[i]) * gb_nearest_turn(R(0.0), first, last);
    }
    return true;
}

/* Strides along a self-motion from q by one joint until it is within limits; false when it meets no such place. */
static bool gb_stride_within(const gb_problem *problem, const gb_real *q, uint32_t free, size_t joint, gb_real way, const gb_real *limits, gb_end *place)
{
    const gb_mechanism *m = problem->mechanism;
    gb_end end;
    gb_copy(end.q, q, m->joints);
    for (int i = 0; i < GB_STRIDES; i++) {
        end.q[joint] = gb_moved(m, end.q, joint, way);
        gb_polish_from(problem, &end, free);
        if (!end.fit.accepted) {
            return false;
        }
        if (gb_turn_within(m, end.q, limits, place->q)) {
            place->fit = end.fit;
            return true;
        }
    }
    return false;
}

/* The same by one free joint after the other, either way. */
static bool gb_strides_within(const gb_answers *all, size_t answer, const gb_real *limits, gb_end *place)
{
    const uint32_t free = *gb_free_of(all, answer);
    for (size_t i = 0; i < 2 * all->problem.mechanism->joints; i++) {
        const gb_real way = i % 2 == 0 ? GB_STRIDE : -GB_STRIDE;
        if (gb_is_in(free, i / 2) && gb_stride_within(&all->problem, gb_q_of(all, answer), free, i / 2, way, limits, place)) {
            return true;
        }
    }
    return false;
}

/* Moves answers within limits, and drops those that cannot be; how many are left. */
GB_LINKAGE size_t gb_keep_within(const gb_answers *all, const gb_real *limits)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_end place;
    size_t kept = 0;
    for (size_t k = 0; k < all->count; k++) {
        place.fit.residual = *gb_residual_of(all, k);
        if (gb_turn_within(m, gb_q_of(all, k), limits, place.q) || (!m->has_extras && gb_strides_within(all, k, limits, &place))) {
            memmove(gb_at(all, kept), gb_at(all, k), m->solution);
            gb_copy(gb_q_of(all, kept), place.q, m->joints);
            *gb_residual_of(all, kept) = place.fit.residual;
            kept++;
        }
    }
    return kept;
}

/* The index of the answer that can come nearest to a reference by turns within limits, with its nearest turn; -1 when none comes within limits. */
GB_LINKAGE int gb_nearest(const gb_answers *all, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_real *q)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_real least = INFINITY, place[GB_MAX_JOINTS];
    int best = -1;
    for (size_t k = 0; k < all->count; k++) {
        gb_real distance = R(0.0);
        for (size_t i = 0; i < m->joints; i++) {
            const gb_real value = gb_q_of(all, k)[i];
            gb_real first, last;
            gb_turns_within(&m->joint[i], value, limits + 2 * i, &first, &last);
            distance = first <= last ? distance : INFINITY;
            const gb_real turn = m->joint[i].is_angle ? gb_round((reference[i] - value) / GB_TAU) : R(0.0);
            place[i] = value + gb_turn_of(&m->joint[i]) * gb_nearest_turn(turn, first, last);
            distance += weights[i] * (place[i] - reference[i]) * (place[i] - reference[i]);
        }
        if (distance < least) {
            least = distance;
            best = (int)k;
            gb_copy(q, place, m->joints);
        }
    }
    return best;
}

/* The target at which the tool is at a pose, with the base at another pose and the tool at its own pose seen from the tip: base^-1 pose tool^-1. */
GB_LINKAGE void gb_target_of(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target)
{
    for (int i = 0; i < 12; i++) {
        target[i] = R(0.0);
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 9; k++) {
                target[3 + 3 * i + j] += base[3 + 3 * (k / 3) + i] * pose[3 + k] * tool[3 + 3 * j + k % 3];
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            target[i] += base[3 + 3 * k + i] * (pose[k] - base[k]) - target[3 + 3 * i + k] * tool[k];
        }
    }
}

#endif

/* Angles, cosines and sines: see trigonometry.rs */

/* The integer part of the number. */
static gb_real gb_whole(gb_real x)
{
    return gb_magnitude(x) < R(1.0) / GB_EPSILON ? gb_signed((gb_real)(int64_t)x, x) : x;
}

/* The nearest integer, halves away from zero. The constant is just below one half, because adding one half must not round up to one. */
GB_LINKAGE gb_real gb_round(gb_real x)
{
    return gb_whole(x + gb_signed(R(0.5) - R(0.25) * GB_EPSILON, x));
}

/* The greatest integer that is not greater than the number. */
GB_LINKAGE gb_real gb_floor(gb_real x)
{
    const gb_real whole = gb_whole(x);
    return whole > x ? whole - R(1.0) : whole;
}

/* The least integer that is not less than the number. */
GB_LINKAGE gb_real gb_ceiling(gb_real x)
{
    return -gb_floor(-x);
}

/* The angle moved by whole turns into (-pi, pi]. */
GB_LINKAGE gb_real gb_wrap(gb_real angle)
{
    const gb_real wrapped = angle - GB_TAU * gb_round(angle / GB_TAU);
    return wrapped <= -GB_PI ? wrapped + GB_TAU : wrapped;
}

/* atan2(sine, cosine) in (-pi, pi]. Zero is never negative; NaN where both are zero. The header has a version for any type of number. */
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

/* The nearest number of quarter turns, and the remaining angle in two numbers. */
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

/* The sine of `x + rest` for `|x| <= pi/4`. */
static gb_real gb_sine_of(gb_real x, gb_real rest)
{
    const gb_real u = x * x;
    const gb_real high = R(0.008333333333330948)
        + u * (R(-0.00019841269836758574) + u * (R(2.755731610255244e-06) + u * (R(-2.5051131845003624e-08) + u * R(1.5918129294866608e-10))));
    return x + (x * u * (R(-0.16666666666666666) + u * high) + rest * (R(1.0) - R(0.5) * u));
}

/* The cosine of `x + rest` for `|x| <= pi/4`. */
static gb_real gb_cosine_of(gb_real x, gb_real rest)
{
    const gb_real u = x * x, half = R(0.5) * u, first = R(1.0) - half;
    const gb_real low = R(2.480158729876569e-05) + u * (R(-2.7557317271729793e-07) + u * (R(2.08761462684032e-09) + u * R(-1.1382632425521717e-11)));
    const gb_real high = R(0.041666666666666664) + u * (R(-0.0013888888888887398) + u * low);
    return first + (((R(1.0) - first) - half) + (u * u * high - x * rest));
}

/* The cosine and the sine of an angle in rad. They are equal to those of gb_cosine and gb_sine, and take two thirds of the time. */
GB_LINKAGE void gb_cosine_and_sine(gb_real angle, gb_real *cosine, gb_real *sine)
{
    gb_real x, rest;
    const int64_t quarters = gb_reduced(angle, &x, &rest);
    const gb_real c = gb_cosine_of(x, rest), s = gb_sine_of(x, rest);
    const gb_real across = quarters & 1 ? s : c, up = quarters & 1 ? c : s;
    *cosine = (quarters + 1) & 2 ? -across : across;
    *sine = quarters & 2 ? -up : up;
}

/* The sine of an angle plus so many quarter turns. */
static gb_real gb_sine_after(gb_real angle, int64_t quarters)
{
    gb_real x, rest;
    quarters = (quarters + gb_reduced(angle, &x, &rest)) & 3;
    const gb_real size = quarters & 1 ? gb_cosine_of(x, rest) : gb_sine_of(x, rest);
    return quarters & 2 ? -size : size;
}

/* The cosine of an angle in rad, within one unit of its last place up to a million rad. */
GB_LINKAGE gb_real gb_cosine(gb_real angle)
{
    return gb_sine_after(angle, 1);
}

/* The sine of an angle in rad, within one unit of its last place up to a million rad. */
GB_LINKAGE gb_real gb_sine(gb_real angle)
{
    return gb_sine_after(angle, 0);
}

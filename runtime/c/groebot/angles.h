/* P of the arc tangent z + z^3 P(z^2) for |z| <= tan(pi/8). */
GB_INLINE T GB_(series)(T u)
{
    const T square = u * u, fourth = u * u * (u * u);
    const T first = R(-0.3333333333333333) + R(0.1999999999999552) * u + (R(-0.14285714284666542) + R(0.11111111015256361) * u) * square;
    const T second = R(-0.09090904578123903) + R(0.07692183190826087) * u + (R(-0.06664511447381948) + R(0.0585814891280221) * u) * square;
    const T third = R(-0.05085449737940259) + R(0.03923165829558718) * u + R(-0.019176887119062243) * square;
    return first + (second + third * fourth) * fourth;
}

/* The angle in [0, pi/2] of a non-negative cosine and a non-negative sine. NaN where both are zero. */
GB_INLINE T GB_(acute)(T across, T up)
{
    const GB_(truth) steep = GB_(exceeds)(up, across);
    const T low = GB_(pick)(across, up, steep), high = GB_(pick)(up, across, steep);
    const GB_(truth) far = GB_(exceeds)(low, GB_EIGHTH * high);
    const T none = GB_(of)(R(0.0)), quarter = GB_(pick)(GB_(of)(GB_PI / R(4.0)), none, far), rest = GB_(pick)(GB_(of)(GB_REST), none, far);
    const T z = (low - GB_(pick)(high, none, far)) / (high + GB_(pick)(low, none, far));
    const T small = z + z * (z * z) * GB_(series)(z * z);
    const T angle = quarter + (small + rest);
    return GB_(pick)(GB_PI / R(2.0) - (angle - R(2.0) * GB_REST), angle, steep);
}

/* The angle in (-pi, pi] of a cosine and a sine, given the acute angle of their magnitudes. Zero is never negative. */
GB_INLINE T GB_(unfold)(T acute, T cosine, T sine)
{
    const GB_(truth) is_back = GB_(exceeds)(GB_(of)(R(0.0)), cosine);
    const T angle = GB_(with_sign)(GB_(pick)(GB_PI - (acute - R(4.0) * GB_REST), acute, is_back), sine);
    return GB_(pick)(angle + GB_TAU, angle, GB_(at_most)(angle, GB_(of)(-GB_PI))) + R(0.0);
}

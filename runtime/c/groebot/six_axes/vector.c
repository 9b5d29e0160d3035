/* Cosines and sines of several angles: see vector.rs */
#ifndef GB_SIX_VECTOR
#define GB_SIX_VECTOR

/* Adding this number to another one rounds that one to an integer, which is then in the last bits. */
#define GB_SIX_WHOLE GB_EITHER(6755399441055744.0, 12582912.0)

/* The cosines and the sines of angles up to a million rad. They are bitwise equal to those of gb_cosine and gb_sine, except where an angle is half-way
 * between two quarter turns. */
GB_INLINE void gb_six_turns_of(gb_six_lanes angles, gb_six_lanes *cosines, gb_six_lanes *sines)
{
    const gb_six_lanes shifted = angles * R(0.6366197723675814) + GB_SIX_WHOLE, quarters = shifted - GB_SIX_WHOLE;
    /* Products of the first two parts are exact, and so is the first difference. */
    const gb_six_lanes first = angles - quarters * GB_EITHER(1.5707963267341256, 1.5703125);
    const gb_six_lanes second = quarters * GB_EITHER(6.077100506303966e-11, 4.837512969970703e-4);
    const gb_six_lanes sum = first - second, lost = first - sum;
    const gb_six_lanes third = (first - (sum + lost)) + (lost - second) - quarters * GB_EITHER(2.0222662487959506e-21, 7.54978995489188e-8);
    const gb_six_lanes x = sum + third, rest = (sum - x) + third, u = x * x, half = R(0.5) * (x * x), less = R(1.0) - half;
    const gb_six_lanes up = R(0.008333333333330948)
        + u * (R(-0.00019841269836758574) + u * (R(2.755731610255244e-06) + u * (R(-2.5051131845003624e-08) + u * R(1.5918129294866608e-10))));
    const gb_six_lanes s = x + (x * u * (R(-0.16666666666666666) + u * up) + rest * less);
    const gb_six_lanes low = R(2.480158729876569e-05) + u * (R(-2.7557317271729793e-07) + u * (R(2.08761462684032e-09) + u * R(-1.1382632425521717e-11)));
    const gb_six_lanes across = R(0.041666666666666664) + u * (R(-0.0013888888888887398) + u * low);
    const gb_six_lanes c = less + (((R(1.0) - less) - half) + (u * u * across - x * rest));
    const gb_six_bits quarter = gb_six_bits_of(shifted), odd = 0 - (quarter & 1);
    const gb_six_bits of_c = gb_six_bits_of(c), of_s = gb_six_bits_of(s);
    *cosines = gb_six_of_bits(((of_c & ~odd) | (of_s & odd)) ^ (((quarter + 1) & 2) << (GB_SIX_SIGN - 1)));
    *sines = gb_six_of_bits(((of_s & ~odd) | (of_c & odd)) ^ ((quarter & 2) << (GB_SIX_SIGN - 1)));
}

/* The cosines and the sines of a list that fills whole registers. */
GB_INLINE void gb_six_turns(const gb_real *angles, size_t count, gb_real *cosines, gb_real *sines)
{
    GB_UNROLL
    for (size_t i = 0; i < count; i += GB_SIX_LANES) {
        gb_six_lanes c, s;
        gb_six_turns_of(gb_six_load(angles + i), &c, &s);
        gb_six_store(cosines + i, c);
        gb_six_store(sines + i, s);
    }
}

#endif

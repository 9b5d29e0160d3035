/* Measurement of several candidates at once */

/* Loads the first numbers of a row, and stores numbers to the front of one. */
GB_INLINE T GB_(load)(const gb_real *row)
{
#if GB_WIDTH == 1
    return *row;
#else
    T numbers;
    memcpy(&numbers, row, sizeof numbers);
    return numbers;
#endif
}

/* One number, or two. */
GB_INLINE T GB_(lanes_of)(gb_real first, gb_real second)
{
#if GB_WIDTH == 1
    (void)second;
    return first;
#else
    T numbers = GB_(of)(second);
    numbers[0] = first;
    return numbers;
#endif
}

GB_INLINE void GB_(store)(gb_real *row, T numbers)
{
    memcpy(row, &numbers, sizeof numbers);
}

/* The largest magnitude of an equation's value, and the largest relative one. */
GB_INLINE void GB_(fit)(const T *p, const T *at, T *residual, T *relative)
{
    T values[GB_EQUATIONS], sizes[GB_SIZES], largest[GB_SIZES];
    GB_(values)(p, at, values);
    GB_(sizes)(p, at, sizes);
    GB_UNROLL
    for (int i = 0; i < GB_SIZES; i++) {
        largest[i] = GB_(of)(R(0.0));
    }
    GB_UNROLL
    for (int i = 0; i < GB_EQUATIONS; i++) {
        largest[gb_size_of[i]] = GB_(greater)(largest[gb_size_of[i]], GB_(abs)(values[i]));
    }
    *residual = *relative = GB_(of)(R(0.0));
    GB_UNROLL
    for (int i = 0; i < GB_SIZES; i++) {
        *residual = GB_(greater)(*residual, largest[i]);
        *relative = GB_(greater)(*relative, largest[i] / GB_(above)(sizes[i], GB_(of)(GB_LEAST_POSITIVE)));
    }
}

/* Whether candidates have finite pairs near the unit circle: 1, else 0. */
GB_INLINE T GB_(sound)(const T *at)
{
    T sound = GB_(of)(R(1.0));
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const T first = at[gb_joints[i].places[0]], second = at[gb_joints[i].places[1]];
        sound = gb_joints[i].is_angle ? GB_(where_below)(sound, GB_(abs)(first * first + second * second - R(1.0)), GB_ACCEPTANCE_ROUNDING)
                                      : GB_(where_below)(sound, GB_(abs)(first), GB_GREATEST);
    }
    for (int i = 0; GB_EXTRAS && i < GB_PLACES; i++) {
        sound = GB_(where_below)(sound, GB_(abs)(at[i]), GB_GREATEST);
    }
    return sound;
}

/* Several numbers at once, each bitwise equal to what it would be alone */
#ifndef GB_SIX_LANES_OF
#define GB_SIX_LANES_OF

#if GB_LANES >= 4
#define GB_SIX_LANES 4
#elif GB_LANES >= 2
#define GB_SIX_LANES 2
#else
#define GB_SIX_LANES 1
#endif
/* Number of elements when rounded up to whole registers. */
#define GB_SIX_PADDED(count) (((count) + GB_SIX_LANES - 1) / GB_SIX_LANES * GB_SIX_LANES)

#if GB_SIX_LANES > 1
typedef gb_real gb_six_lanes __attribute__((vector_size(sizeof(gb_real) * GB_SIX_LANES)));
/* The bits of several numbers, or a truth value per lane: all bits set or none. */
typedef uint64_t gb_six_bits __attribute__((vector_size(sizeof(gb_real) * GB_SIX_LANES)));
#else
typedef gb_real gb_six_lanes;
#ifdef GB_FLOAT
typedef uint32_t gb_six_bits;
#else
typedef uint64_t gb_six_bits;
#endif
#endif
/* The index of the sign bit of a number. */
#define GB_SIX_SIGN (8 * sizeof(gb_real) - 1)

GB_INLINE gb_six_lanes gb_six_load(const gb_real *from)
{
    gb_six_lanes lanes;
    memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

GB_INLINE void gb_six_store(gb_real *to, gb_six_lanes lanes)
{
    memcpy(to, &lanes, sizeof lanes);
}

/* The given number in all lanes. */
GB_INLINE gb_six_lanes gb_six_of(gb_real number)
{
    gb_real all[GB_SIX_LANES];
    for (int lane = 0; lane < GB_SIX_LANES; lane++) {
        all[lane] = number;
    }
    return gb_six_load(all);
}

GB_INLINE gb_six_bits gb_six_bits_of(gb_six_lanes lanes)
{
    gb_six_bits bits;
    memcpy(&bits, &lanes, sizeof bits);
    return bits;
}

GB_INLINE gb_six_lanes gb_six_of_bits(gb_six_bits bits)
{
    gb_six_lanes lanes;
    memcpy(&lanes, &bits, sizeof lanes);
    return lanes;
}

/* Where a number is more than a limit. */
GB_INLINE gb_six_bits gb_six_exceeds(gb_six_lanes a, gb_six_lanes limit)
{
#if GB_SIX_LANES > 1
    return (gb_six_bits)(a > limit);
#else
    return (gb_six_bits)0 - (gb_six_bits)(a > limit);
#endif
}

/* Selects the number where `is_so` is true, and the other one elsewhere. */
GB_INLINE gb_six_lanes gb_six_pick(gb_six_lanes a, gb_six_lanes b, gb_six_bits is_so)
{
#if GB_SIX_LANES > 1
    return gb_six_of_bits((gb_six_bits_of(a) & is_so) | (gb_six_bits_of(b) & ~is_so));
#else
    return is_so ? a : b;
#endif
}

GB_INLINE gb_six_lanes gb_six_abs(gb_six_lanes a)
{
#if GB_SIX_LANES > 1
    return gb_six_of_bits(gb_six_bits_of(a) & ~gb_six_bits_of(gb_six_of(-R(0.0))));
#else
    return gb_magnitude(a);
#endif
}

/* The greater of two numbers; the first where one is NaN. */
GB_INLINE gb_six_lanes gb_six_greater(gb_six_lanes a, gb_six_lanes b)
{
    return gb_six_pick(b, a, gb_six_exceeds(b, a));
}

/* Subtracts a multiple of another row, in columns from `first` on, which begins a register. */
GB_INLINE void gb_six_subtract(gb_real *row, gb_real factor, const gb_real *over, size_t first, size_t end)
{
    const gb_six_lanes factors = gb_six_of(factor);
    for (size_t i = first; i < end; i += GB_SIX_LANES) {
        gb_six_store(row + i, gb_six_load(row + i) - factors * gb_six_load(over + i));
    }
}

/* The largest magnitude of `count` numbers, which fill whole registers, or `least` if that is greater; NaN is ignored. */
GB_INLINE gb_real gb_six_largest(gb_real least, const gb_real *numbers, size_t count)
{
    gb_real lanes[GB_SIX_LANES], largest = least;
    gb_six_lanes most = gb_six_of(least);
    for (size_t i = 0; i < count; i += GB_SIX_LANES) {
        most = gb_six_greater(most, gb_six_abs(gb_six_load(numbers + i)));
    }
    gb_six_store(lanes, most);
    for (int lane = 0; lane < GB_SIX_LANES; lane++) {
        largest = gb_larger(largest, lanes[lane]);
    }
    return largest;
}

#endif

/* Arithmetic of the program */

#if GB_WIDTH == 1
typedef gb_real GB_(number);
/* A truth value for each number. */
typedef int GB_(truth);
#else
typedef double GB_(number) __attribute__((vector_size(8 * GB_WIDTH)));
/* A truth value per lane: all bits set or none. */
typedef int64_t GB_(truth) __attribute__((vector_size(8 * GB_WIDTH)));
#endif

/* False in all lanes. */
GB_INLINE GB_(truth) GB_(nowhere)(void)
{
    const GB_(truth) nowhere = {0};
    return nowhere;
}

/* The given number in all lanes. */
GB_INLINE T GB_(of)(gb_real number)
{
#if GB_WIDTH == 1
    return number;
#else
    T all = {0};
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        all[lane] = number;
    }
    return all;
#endif
}

/* Whether a number is at most a limit. */
GB_INLINE GB_(truth) GB_(at_most)(T a, T limit)
{
    return (GB_(truth))(a <= limit);
}

/* Whether a number is more than a limit. */
GB_INLINE GB_(truth) GB_(exceeds)(T a, T limit)
{
    return (GB_(truth))(a > limit);
}

/* The negation. */
GB_INLINE GB_(truth) GB_(inverted)(GB_(truth) truth)
{
#if GB_WIDTH == 1
    return !truth;
#else
    return ~truth;
#endif
}

/* Whether it is true in any lane. */
GB_INLINE bool GB_(any)(GB_(truth) truth)
{
#if GB_WIDTH == 1
    return truth;
#else
    int64_t all = 0;
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        all |= truth[lane];
    }
    return all != 0;
#endif
}

/* Selects the number where `is_so` is true, and the other one elsewhere. */
GB_INLINE T GB_(pick)(T a, T b, GB_(truth) truth)
{
#if GB_WIDTH == 1
    return truth ? a : b;
#else
    return (T)(((GB_(truth))a & truth) | ((GB_(truth))b & ~truth));
#endif
}

/* The magnitude. */
GB_INLINE T GB_(abs)(T a)
{
#if GB_WIDTH == 1
    return gb_magnitude(a);
#else
    return (T)((GB_(truth))a & ~(GB_(truth))GB_(of)(-0.0));
#endif
}

/* The number with the sign of another. */
GB_INLINE T GB_(with_sign)(T a, T sign)
{
#if GB_WIDTH == 1
    return gb_signed(a, sign);
#else
    const GB_(truth) bit = (GB_(truth))GB_(of)(-0.0);
    return (T)(((GB_(truth))a & ~bit) | ((GB_(truth))sign & bit));
#endif
}

/* The square root. */
GB_INLINE T GB_(square_root)(T a)
{
#if GB_WIDTH == 1
    return gb_square_root(a);
#elif GB_WIDTH == 2 && defined(__SSE2__)
    return (T)_mm_sqrt_pd((__m128d)a);
#elif GB_WIDTH == 2 && defined(__aarch64__)
    return (T)vsqrtq_f64((float64x2_t)a);
#elif GB_WIDTH == 4 && defined(__AVX__)
    return (T)_mm256_sqrt_pd((__m256d)a);
#elif GB_WIDTH == 8 && defined(__AVX512F__)
    return (T)_mm512_sqrt_pd((__m512d)a);
#else
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        a[lane] = sqrt(a[lane]);
    }
    return a;
#endif
}

/* Applies a function of one number in each lane. */
GB_INLINE T GB_(each)(T a, gb_real (*value)(gb_real))
{
#if GB_WIDTH == 1
    return value(a);
#else
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        a[lane] = value(a[lane]);
    }
    return a;
#endif
}

/* The cosine of an angle in rad. */
GB_INLINE T GB_(cos)(T angle)
{
    return GB_(each)(angle, gb_cosine);
}

/* The sine of an angle in rad. */
GB_INLINE T GB_(sin)(T angle)
{
    return GB_(each)(angle, gb_sine);
}

/* The greater of two numbers; the first where one is NaN. */
GB_INLINE T GB_(greater)(T a, T b)
{
    return GB_(pick)(b, a, GB_(exceeds)(b, a));
}

/* The lesser of two numbers; the first where one is NaN. */
GB_INLINE T GB_(lesser)(T a, T b)
{
    return GB_(pick)(b, a, GB_(exceeds)(a, b));
}

/* The number, or a floor where it is below that or NaN. */
GB_INLINE T GB_(above)(T a, T floor)
{
    return GB_(pick)(a, floor, GB_(exceeds)(a, floor));
}

/* The greatest of a positive number and the magnitudes of others. */
GB_INLINE T GB_(largest)(gb_real least, const T *others, size_t count)
{
    T largest = GB_(of)(least);
    for (size_t i = 0; i < count; i++) {
        largest = GB_(greater)(largest, GB_(abs)(others[i]));
    }
    return largest;
}

/* The number where another is below a limit, and zero elsewhere. */
GB_INLINE T GB_(where_below)(T a, T other, gb_real limit)
{
    return GB_(pick)(a, GB_(of)(R(0.0)), GB_(exceeds)(GB_(of)(limit), other));
}

/* The square root; zero of a negative number. */
GB_INLINE T GB_(root)(T a)
{
    return GB_(square_root)(GB_(above)(a, GB_(of)(R(0.0))));
}

/* The greater of two numbers; if one is NaN, the other one. */
GB_INLINE T GB_(max)(T a, T b)
{
    return GB_(pick)(b, a, GB_(exceeds)(b, a) | GB_(inverted)(GB_(at_most)(a, a)));
}

/* The truth values of a case's guards: near the stratum, and within rounding of it, which suffices where the cases before have lost nothing. */
typedef struct {
    GB_(truth) here;
    GB_(truth) beside;
} GB_(guard);

/* Where a factor is so close to zero that the case of a stratum runs. */
GB_INLINE GB_(guard) GB_(near)(T a, T scale)
{
    const GB_(guard) guard = {GB_(at_most)(GB_(abs)(a), scale * GB_STRATA_NEAR), GB_(at_most)(GB_(abs)(a), scale * GB_STRATA_BESIDE)};
    return guard;
}

/* Where a factor is not zero. In lanes NaN counts as not zero: it belongs to no candidate. */
GB_INLINE GB_(guard) GB_(away)(T a, T scale)
{
#if GB_WIDTH == 1
    const GB_(truth) here = gb_magnitude(a) > GB_STRATA_DENOMINATOR * scale;
#else
    const GB_(truth) here = GB_(inverted)(GB_(at_most)(GB_(abs)(a), GB_STRATA_DENOMINATOR * scale));
#endif
    const GB_(guard) guard = {here, here};
    return guard;
}

/* Where two guards hold. */
GB_INLINE GB_(guard) GB_(both)(GB_(guard) a, GB_(guard) b)
{
    const GB_(guard) guard = {a.here & b.here, a.beside & b.beside};
    return guard;
}

/* Everywhere. */
GB_INLINE GB_(guard) GB_(always)(void)
{
    const GB_(guard) guard = {GB_(inverted)(GB_(nowhere)()), GB_(inverted)(GB_(nowhere)())};
    return guard;
}

/* The claim of a pivot in a group: its magnitude where the guard holds, or -1 elsewhere. */
GB_INLINE T GB_(claim)(GB_(guard) guard, T pivot)
{
    return GB_(pick)(GB_(abs)(pivot), GB_(of)(R(-1.0)), guard.here);
}

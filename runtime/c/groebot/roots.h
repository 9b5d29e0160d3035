/* Real roots, ascending, and whether they are close to each other. In lanes with fewer roots than places, the remaining places are marked as dead. */
typedef struct {
    T values[GB_DEGREE];
    size_t count;
#if GB_WIDTH == 1
    bool close;
#else
    GB_(truth) dead[GB_DEGREE];
    GB_(truth) close[GB_DEGREE];
#endif
} GB_(roots);

/* The real roots of x^2 + constant. A negative radicand counts as zero up to `tangent` times the square of the unknown's typical size. */
GB_INLINE GB_(roots) GB_(roots_of_square)(T constant, T scale, gb_real tangent)
{
    GB_(roots) roots;
    const T square = scale * scale;
#if GB_WIDTH == 1
    const gb_real size = square > constant ? square : constant == constant ? constant : square;
    roots.count = 0;
    roots.close = false;
    if (constant <= tangent * size) {
        if (constant >= R(0.0)) {
            roots.values[0] = R(0.0);
            roots.count = 1;
            roots.close = true;
            return roots;
        }
        const gb_real root = gb_square_root(-constant);
        roots.values[0] = -root;
        roots.values[1] = root;
        roots.count = root <= GB_GREATEST ? 2 : 0;
        roots.close = root <= GB_ROOTS_CLOSE * scale;
    }
#else
    const GB_(truth) is_square = GB_(exceeds)(square, constant) | GB_(inverted)(GB_(at_most)(constant, constant));
    const GB_(truth) dead = GB_(inverted)(GB_(at_most)(constant, tangent * GB_(pick)(square, constant, is_square)));
    const T root = GB_(square_root)(-constant);
    const GB_(truth) close = GB_(inverted)(GB_(exceeds)(root, GB_ROOTS_CLOSE * scale));
    roots.values[0] = -root;
    roots.values[1] = root;
    roots.count = 2;
    for (int i = 0; i < 2; i++) {
        roots.dead[i] = dead;
        roots.close[i] = close;
    }
#endif
    return roots;
}

/* The real roots of x^2 + constant. */
GB_INLINE GB_(roots) GB_(square_roots)(T constant, T scale)
{
    return GB_(roots_of_square)(constant, scale, GB_ROOTS_TANGENT);
}

/* Same as square_roots, with a larger tolerance, after roots of polynomials of higher degree. */
GB_INLINE GB_(roots) GB_(grazing_roots)(T constant, T scale)
{
    return GB_(roots_of_square)(constant, scale, GB_ACCEPTANCE_UNSETTLED_ROOTS);
}

/* The real roots of the first polynomial with a significant leading coefficient, or of the last one. Terms are evaluated at `spread` times the greater of
 * the unknown's typical size and a root. */
#if GB_WIDTH == 1
GB_UNUSED static GB_(roots) GB_(scaled_roots)(const GB_(polynomial) *list, size_t count, T typical, T spread)
{
    GB_(roots) roots;
    const gb_scale scale = {typical, spread};
    roots.count = gb_real_roots(list, count, scale, roots.values, GB_DEGREE, &roots.close);
    return roots;
}
#else
typedef struct {
    const T *coefficients;
    size_t length;
} GB_(polynomial);

#define GB_MOST_POLYNOMIALS 4
GB_UNUSED static GB_(roots) GB_(scaled_roots)(const GB_(polynomial) *list, size_t count, T typical, T spread)
{
    GB_(roots) roots;
    roots.count = GB_DEGREE;
    for (int i = 0; i < GB_DEGREE; i++) {
        roots.values[i] = GB_(of)(NAN);
        roots.dead[i] = ~GB_(nowhere)();
        roots.close[i] = GB_(nowhere)();
    }
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        gb_real numbers[GB_MOST_POLYNOMIALS][GB_DEGREE + 1], values[GB_DEGREE];
        gb_polynomial_1 own[GB_MOST_POLYNOMIALS];
        for (size_t k = 0; k < count; k++) {
            for (size_t i = 0; i < list[k].length; i++) {
                numbers[k][i] = list[k].coefficients[i][lane];
            }
            own[k].coefficients = numbers[k];
            own[k].length = list[k].length;
        }
        bool close;
        const gb_scale scale = {typical[lane], spread[lane]};
        const size_t found = gb_real_roots(own, count, scale, values, GB_DEGREE, &close);
        for (size_t i = 0; i < found; i++) {
            roots.values[i][lane] = values[i];
            roots.dead[i][lane] = 0;
            roots.close[i][lane] = close ? -1 : 0;
        }
    }
    return roots;
}
#endif

/* Same with terms evaluated at the greater of the unknown's typical size and a root. */
GB_UNUSED static GB_(roots) GB_(polynomial_roots)(const GB_(polynomial) *list, size_t count, T typical)
{
    return GB_(scaled_roots)(list, count, typical, GB_(of)(R(1.0)));
}

/* The real roots of polynomials in the tangent of half an angle, whose double roots may miss the axis by more than rounding. */
GB_UNUSED static GB_(roots) GB_(half_angle_roots)(const GB_(polynomial) *list, size_t count, T spread)
{
    return GB_(scaled_roots)(list, count, GB_(of)(R(1.0)), spread);
}

/* How a candidate was found. In lanes, it also says where the candidate does not exist. */
#if GB_WIDTH > 1
typedef struct {
    size_t branch;
    GB_(truth) dead;
    GB_(truth) close;
    bool is_pair;
} GB_(found);
#endif

/* The branch of a case of the first block, whose branch numbers end at `last`. */
GB_INLINE GB_(found) GB_(first)(size_t branch, size_t last)
{
#if GB_WIDTH == 1
    const gb_found_1 found = {branch, last, 0, false, false};
#else
    const GB_(found) found = {branch, {0}, {0}, false};
#endif
    return found;
}

/* The branch after a choice among `radix` of a later block. */
GB_INLINE GB_(found) GB_(next)(GB_(found) found, size_t radix, size_t number)
{
    found.branch = radix * found.branch + number;
#if GB_WIDTH == 1
    found.last *= radix;
#endif
    return found;
}

/* The branch of the root with this index. */
GB_INLINE GB_(found) GB_(by_root)(GB_(found) found, const GB_(roots) *roots, size_t index)
{
#if GB_WIDTH == 1
    found.close |= roots->close;
#else
    found.dead |= roots->dead[index] & ~found.close;
    found.close |= roots->close[index];
#endif
    return found;
}

/* The branch of both roots. */
GB_INLINE GB_(found) GB_(by_pair)(GB_(found) found, const GB_(roots) *roots)
{
    found = GB_(by_root)(found, roots, 0);
    found.is_pair = roots->count == 2;
    return found;
}

/* On a stratum where these joints are free: bit `j` for joint `j`. */
GB_INLINE GB_(found) GB_(freeing)(GB_(found) found, uint32_t joints)
{
#if GB_WIDTH == 1
    found.free |= joints;
#endif
    return found;
}

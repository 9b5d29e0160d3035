/* The short way from a candidate of a nearby mechanism's formulas to the answer next to it */

/* A pair of a cosine and a sine turned back by a small way, nearer to the circle; the factor that led there. */
GB_INLINE T GB_(turn_back)(T way, T *cosine, T *sine)
{
    const T c = *cosine, s = *sine;
    const T norm = R(1.5) - R(0.5) * (c * c + s * s), square = way * way;
    const T across = norm * way * (R(1.0) - square * (R(1.0) - square * (R(1.0) / R(20.0))) * (R(1.0) / R(6.0)));
    const T along = norm * (R(1.0) - R(0.5) * square * (R(1.0) - square * (R(1.0) / R(12.0))));
    *cosine = along * c + across * s;
    *sine = along * s - across * c;
    return norm;
}

GB_INLINE T GB_(dot_short)(const T *a, const T *b)
{
    T sum = GB_(of)(R(0.0));
    GB_UNROLL
    for (int i = 0; i < GB_SHORTS; i++) {
        sum = sum + a[i] * b[i];
    }
    return sum;
}

/* The step (J^T J)^-1 J^T f by elimination without pivoting, the largest share of a value in its size, and the least pivot as a share of the size; not
 * sound where that is small. */
GB_INLINE void GB_(normal_step)(const T *p, const T *at, T *step, T *missed, T *pivot, T *sound)
{
    T value[GB_SHORTS], size_of[GB_SHORTS], columns[GB_JOINTS][GB_SHORTS], square[GB_JOINTS][GB_JOINTS], inverse[GB_JOINTS];
    T size = GB_(of)(R(0.0)), least = GB_(of)(INFINITY);
    GB_(shorten)(p, at, value, size_of, columns);
    *missed = size;
    for (int i = 0; i < GB_SHORTS; i++) {
        *missed = GB_(greater)(*missed, GB_(abs)(value[i]) / GB_(above)(size_of[i], GB_(of)(GB_LEAST_POSITIVE)));
    }
    for (int i = 0; i < GB_JOINTS; i++) {
        for (int j = 0; j <= i; j++) {
            square[i][j] = GB_(dot_short)(columns[i], columns[j]);
        }
        step[i] = GB_(dot_short)(columns[i], value);
        size = GB_(greater)(size, square[i][i]);
    }
    for (int k = 0; k < GB_JOINTS; k++) {
        *sound = GB_(where_below)(*sound, size * GB_PLAIN - square[k][k], R(0.0));
        least = GB_(lesser)(least, square[k][k]);
        inverse[k] = R(1.0) / square[k][k];
        for (int i = k + 1; i < GB_JOINTS; i++) {
            const T factor = square[i][k] * inverse[k];
            for (int j = k + 1; j <= i; j++) {
                square[i][j] = square[i][j] - factor * square[j][k];
            }
            step[i] = step[i] - factor * step[k];
        }
    }
    for (int k = GB_JOINTS; k-- > 0;) {
        for (int j = k + 1; j < GB_JOINTS; j++) {
            step[k] = step[k] - square[j][k] * step[j];
        }
        step[k] = step[k] * inverse[k];
    }
    *pivot = least / size;
}

/* Takes a step back; a long one, or a pair far from the circle, is not sound. */
GB_INLINE void GB_(step_back)(const T *step, T *at, T *sound)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        T *first = &at[gb_joints[i].places[0]];
        if (gb_joints[i].is_angle) {
            const T norm = GB_(turn_back)(step[i], first, &at[gb_joints[i].places[1]]);
            *sound = GB_(where_below)(GB_(where_below)(*sound, GB_(abs)(step[i]), GB_TURN), GB_(abs)(norm - R(1.0)), GB_TURN);
        } else {
            *first = *first - step[i];
            *sound = GB_(where_below)(*sound, GB_(abs)(step[i]), GB_GREATEST);
        }
    }
}

/* Newton steps from a candidate of a nearby mechanism's formulas to the solution next to it */

/* A pair of a cosine and a sine turned back by a small angle and normalised. Returns the normalising factor. */
GB_INLINE T GB_(turn_back)(T delta, T *cosine, T *sine)
{
    const T c = *cosine, s = *sine;
    const T norm = R(1.5) - R(0.5) * (c * c + s * s), square = delta * delta;
    const T across = norm * delta * (R(1.0) - square * (R(1.0) - square * (R(1.0) / R(20.0))) * (R(1.0) / R(6.0)));
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

/* Normal equations J^T J, eliminated without pivoting; the factors are below the diagonal. `pivot` is the least pivot relative to their size. */
typedef struct {
    T columns[GB_JOINTS][GB_SHORTS], square[GB_JOINTS][GB_JOINTS], inverse[GB_JOINTS], pivot;
} GB_(normal);

/* The normal equations of these derivatives by each joint. `sound` becomes zero where a pivot is small. */
GB_INLINE void GB_(eliminate)(GB_(normal) *normal, T *sound)
{
    T size = GB_(of)(R(0.0)), least = GB_(of)(INFINITY);
    for (int i = 0; i < GB_JOINTS; i++) {
        for (int j = 0; j <= i; j++) {
            normal->square[i][j] = GB_(dot_short)(normal->columns[i], normal->columns[j]);
        }
        size = GB_(greater)(size, normal->square[i][i]);
    }
    for (int k = 0; k < GB_JOINTS; k++) {
        const T pivot = normal->square[k][k];
        *sound = GB_(where_below)(*sound, size * GB_PIVOTS_REGULAR_STEPS - pivot, R(0.0));
        least = GB_(lesser)(least, pivot);
        normal->inverse[k] = R(1.0) / pivot;
        for (int i = k + 1; i < GB_JOINTS; i++) {
            const T factor = normal->square[i][k] * normal->inverse[k];
            for (int j = k + 1; j <= i; j++) {
                normal->square[i][j] = normal->square[i][j] - factor * normal->square[j][k];
            }
        }
    }
    normal->pivot = least / size;
}

/* The step `(J^T J)^-1 J^T f`. */
GB_INLINE void GB_(solve_normal)(const GB_(normal) *normal, const T *value, T *step)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        step[i] = GB_(dot_short)(normal->columns[i], value);
    }
    for (int k = 0; k < GB_JOINTS; k++) {
        for (int i = k + 1; i < GB_JOINTS; i++) {
            step[i] = step[i] - normal->square[i][k] * normal->inverse[k] * step[k];
        }
    }
    for (int k = GB_JOINTS; k-- > 0;) {
        for (int j = k + 1; j < GB_JOINTS; j++) {
            step[k] = step[k] - normal->square[j][k] * step[j];
        }
        step[k] = step[k] * normal->inverse[k];
    }
}

/* The first step, the normal equations, and the largest relative residual. */
GB_INLINE void GB_(first_step)(const T *p, const T *at, T *step, GB_(normal) *normal, T *missed, T *sound)
{
    T value[GB_SHORTS], size[GB_SHORTS];
    GB_(shorten)(p, at, value, size, normal->columns);
    GB_(eliminate)(normal, sound);
    *missed = GB_(of)(R(0.0));
    for (int i = 0; i < GB_SHORTS; i++) {
        *missed = GB_(greater)(*missed, GB_(abs)(value[i]) / GB_(above)(size[i], GB_(of)(GB_LEAST_POSITIVE)));
    }
    GB_(solve_normal)(normal, value, step);
}

/* The second step, with the derivatives of the first. */
GB_INLINE void GB_(second_step)(const T *p, const T *at, T *step, const GB_(normal) *normal)
{
    T value[GB_SHORTS], size[GB_SHORTS], columns[GB_JOINTS][GB_SHORTS];
    GB_(shorten)(p, at, value, size, columns);
    GB_(solve_normal)(normal, value, step);
}

/* Subtracts a step. A long step, or a pair far from the unit circle, makes the result unsound. */
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

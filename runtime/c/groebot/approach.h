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

/* Normal equations J^T J, eliminated without pivoting; the factors are below the diagonal. `pivot` is the least pivot relative to their size, `most` the
 * largest one. */
typedef struct {
    T columns[GB_JOINTS][GB_SHORTS], square[GB_JOINTS][GB_JOINTS], inverse[GB_JOINTS], pivot, most;
} GB_(normal);

/* The normal equations of these derivatives by each joint. `sound` becomes zero where a pivot is small. */
GB_INLINE void GB_(eliminate)(GB_(normal) *normal, T *sound)
{
    T size = GB_(of)(R(0.0)), least = GB_(of)(INFINITY), most = size;
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
        most = GB_(greater)(most, pivot);
        normal->inverse[k] = R(1.0) / pivot;
        for (int i = k + 1; i < GB_JOINTS; i++) {
            const T factor = normal->square[i][k] * normal->inverse[k];
            for (int j = k + 1; j <= i; j++) {
                normal->square[i][j] = normal->square[i][j] - factor * normal->square[j][k];
            }
        }
    }
    normal->pivot = least / size;
    normal->most = most;
}

/* Multiplies a vector by `(J^T J)^-1`. */
GB_INLINE void GB_(invert_normal)(const GB_(normal) *normal, T *step)
{
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

/* The step `(J^T J)^-1 J^T f`. */
GB_INLINE void GB_(solve_normal)(const GB_(normal) *normal, const T *value, T *step)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        step[i] = GB_(dot_short)(normal->columns[i], value);
    }
    GB_(invert_normal)(normal, step);
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

/* The scalar product of two rows of joint values. */
GB_INLINE T GB_(dot_joints)(const T *a, const T *b)
{
    T sum = GB_(of)(R(0.0));
    for (int i = 0; i < GB_JOINTS; i++) {
        sum = sum + a[i] * b[i];
    }
    return sum;
}

/* The direction in which the equations change least, with a largest component of one, by inverse iteration. Returns the square of that change. */
GB_INLINE T GB_(stillest_of)(const GB_(normal) *normal, T *still)
{
    T square = GB_(of)(R(1.0));
    for (int i = 0; i < GB_JOINTS; i++) {
        still[i] = square;
    }
    for (int round = 0; round < GB_INVERSIONS; round++) {
        T next[GB_JOINTS], longest = GB_(of)(R(0.0));
        memcpy(next, still, sizeof next);
        GB_(invert_normal)(normal, next);
        square = GB_(dot_joints)(still, next) / GB_(dot_joints)(next, next);
        for (int i = 0; i < GB_JOINTS; i++) {
            longest = GB_(greater)(longest, gb_joints[i].is_angle ? GB_(abs)(next[i]) : GB_(abs)(next[i]) / GB_SCALE);
        }
        for (int i = 0; i < GB_JOINTS; i++) {
            still[i] = next[i] / longest;
        }
    }
    return square;
}

/* Where a second solution may be near the ends of Newton steps: 1, else 0. See is_doubled in approach.rs. */
GB_INLINE T GB_(is_doubled)(const T *p, const T *end, T missed)
{
    GB_(normal) normal;
    T at[GB_PLACES], value[GB_SHORTS], size[GB_SHORTS], still[GB_JOINTS], step[GB_JOINTS], regular = GB_(of)(R(1.0));
    GB_(shorten)(p, end, value, size, normal.columns);
    GB_(eliminate)(&normal, &regular);
    const T square = GB_(stillest_of)(&normal, still);
    const GB_(truth) is_far = GB_(exceeds)(square, missed * normal.most * (GB_DOUBTFUL * GB_TWIN * GB_DOUBTFUL * GB_TWIN));
    const T nearby = GB_(root)(missed), ahead = nearby * GB_TWIN_AT;
    memcpy(at, end, sizeof at);
    for (int i = 0; i < GB_JOINTS; i++) {
        T *first = &at[gb_joints[i].places[0]];
        const T back = -(ahead * still[i]);
        if (gb_joints[i].is_angle) {
            GB_(turn_back)(back, first, &at[gb_joints[i].places[1]]);
        } else {
            *first = *first - back;
        }
    }
    GB_(shorten)(p, at, value, size, normal.columns);
    GB_(eliminate)(&normal, &regular);
    GB_(solve_normal)(&normal, value, step);
    const T arrived = ahead - GB_(dot_joints)(step, still) / GB_(dot_joints)(still, still);
    const T distance = R(2.0) * ahead - ahead * ahead / arrived;
    const GB_(truth) is_off = GB_(exceeds)(GB_(abs)(distance), nearby * (GB_DOUBTFUL * GB_TWIN_WITHIN));
    const GB_(truth) is_alone = (is_far | is_off) & GB_(exceeds)(regular, GB_(of)(R(0.0)));
    return GB_(pick)(GB_(of)(R(0.0)), GB_(of)(R(1.0)), is_alone);
}

/* Joint values: see joints.rs */

/* Joint values with their residuals. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_fit fit;
} gb_end;

static bool gb_is_in(uint32_t set, size_t joint)
{
    return (set >> joint & 1) != 0;
}

static void gb_copy(gb_real *to, const gb_real *from, size_t count)
{
    memcpy(to, from, count * sizeof *to);
}

/* A difference of two values of a joint; of angles, reduced to (-pi, pi]. */
static gb_real gb_shortest(const gb_mechanism *m, size_t joint, gb_real difference)
{
    if (!m->joint[joint].is_angle) {
        return difference;
    }
    return difference > GB_PI ? difference - GB_TAU : difference < -GB_PI ? difference + GB_TAU : difference;
}

/* The unit of a joint's differences: 1 for an angle, the magnitude of a length. */
static gb_real gb_span(const gb_mechanism *m, size_t joint, gb_real value)
{
    return m->joint[joint].is_angle ? R(1.0) : gb_larger(m->scale, gb_magnitude(value));
}

/* The value of a joint, an angle in (-pi, pi]. */
static gb_real gb_wrapped(const gb_mechanism *m, size_t joint, gb_real value)
{
    return m->joint[joint].is_angle ? gb_wrap(value) : value;
}

/* Whether joint values differ by at most `tolerance`, the joints of a set left out. */
static bool gb_is_close(const gb_mechanism *m, const gb_real *a, const gb_real *b, uint32_t left_out, gb_real tolerance)
{
    for (size_t k = 0; k < m->joints; k++) {
        const size_t i = m->last_first[k];
        if (!gb_is_in(left_out, i) && !(gb_magnitude(gb_shortest(m, i, a[i] - b[i])) <= tolerance * gb_span(m, i, a[i]))) {
            return false;
        }
    }
    return true;
}

/* The largest difference of a joint: an angle, or relative to the magnitude of a length. */
static gb_real gb_farthest(const gb_mechanism *m, const gb_real *a, const gb_real *b)
{
    gb_real farthest = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        farthest = gb_larger(farthest, gb_magnitude(gb_shortest(m, i, a[i] - b[i])) / gb_span(m, i, a[i]));
    }
    return farthest;
}

/* The largest movement of a joint in a step: an angle, or relative to the length scale. */
static gb_real gb_longest(const gb_mechanism *m, const gb_real *step)
{
    gb_real longest = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        longest = gb_larger(longest, m->joint[i].is_angle ? gb_magnitude(step[i]) : gb_magnitude(step[i]) / m->scale);
    }
    return longest;
}

/* `a - b` joint by joint, angles reduced to (-pi, pi]. */
static void gb_differences(const gb_mechanism *m, const gb_real *a, const gb_real *b, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = gb_shortest(m, i, a[i] - b[i]);
    }
}

/* `q - step`, angles in (-pi, pi]. */
static void gb_stepped(const gb_mechanism *m, const gb_real *q, const gb_real *step, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = gb_wrapped(m, i, q[i] - step[i]);
    }
}

/* A joint's value moved: an angle by `delta`, a length by `delta` times its magnitude. */
static gb_real gb_moved(const gb_mechanism *m, const gb_real *q, size_t joint, gb_real delta)
{
    return gb_wrapped(m, joint, q[joint] + delta * gb_span(m, joint, q[joint]));
}

/* Linear extrapolation from `a` through `b`, by `ahead` times their distance. */
static void gb_beyond(const gb_mechanism *m, const gb_real *a, const gb_real *b, gb_real ahead, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = b[i] + ahead * gb_shortest(m, i, b[i] - a[i]);
    }
}

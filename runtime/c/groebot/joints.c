/* Joint values: joints.rs */

/* Joint values, and how well they solve the equations. */
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

/* A difference of two values of a joint, of angles by the shorter way round. */
static gb_real gb_shortest(const gb_mechanism *m, size_t joint, gb_real difference)
{
    if (!m->joint[joint].is_angle) {
        return difference;
    }
    return difference > GB_PI ? difference - GB_TAU : difference < -GB_PI ? difference + GB_TAU : difference;
}

/* What a joint's differences are shares of: one for an angle, a length's size. */
static gb_real gb_span(const gb_mechanism *m, size_t joint, gb_real value)
{
    return m->joint[joint].is_angle ? R(1.0) : gb_larger(m->scale, gb_magnitude(value));
}

/* The value of a joint, an angle in (-pi, pi]. */
static gb_real gb_wrapped(const gb_mechanism *m, size_t joint, gb_real value)
{
    return m->joint[joint].is_angle ? gb_wrap(value) : value;
}

/* Whether joint values differ by `tolerance` at most, those of a set left out. */
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

/* The farthest that a joint is from b in a: an angle, or a share of a length's size. */
static gb_real gb_farthest(const gb_mechanism *m, const gb_real *a, const gb_real *b)
{
    gb_real farthest = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        farthest = gb_larger(farthest, gb_magnitude(gb_shortest(m, i, a[i] - b[i])) / gb_span(m, i, a[i]));
    }
    return farthest;
}

/* The longest way of a joint in a step: an angle, or a share of the length scale. */
static gb_real gb_longest(const gb_mechanism *m, const gb_real *step)
{
    gb_real longest = R(0.0);
    for (size_t i = 0; i < m->joints; i++) {
        longest = gb_larger(longest, m->joint[i].is_angle ? gb_magnitude(step[i]) : gb_magnitude(step[i]) / m->scale);
    }
    return longest;
}

/* a - b joint by joint, angles by the shorter way round. */
static void gb_differences(const gb_mechanism *m, const gb_real *a, const gb_real *b, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = gb_shortest(m, i, a[i] - b[i]);
    }
}

/* q - step, angles in (-pi, pi]. */
static void gb_stepped(const gb_mechanism *m, const gb_real *q, const gb_real *step, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = gb_wrapped(m, i, q[i] - step[i]);
    }
}

/* A joint's value moved: an angle by `way`, a length by that share of its size. */
static gb_real gb_moved(const gb_mechanism *m, const gb_real *q, size_t joint, gb_real way)
{
    return gb_wrapped(m, joint, q[joint] + way * gb_span(m, joint, q[joint]));
}

/* The joints beyond b on the line from a, by `ahead` times their distance. */
static void gb_beyond(const gb_mechanism *m, const gb_real *a, const gb_real *b, gb_real ahead, gb_real *out)
{
    for (size_t i = 0; i < m->joints; i++) {
        out[i] = b[i] + ahead * gb_shortest(m, i, b[i] - a[i]);
    }
}

/* Where a piece of a curve reaches a limit: see crossing.rs */

/* A joint that reaches a limit on a piece. */
typedef struct {
    size_t joint;
    /* 0 for the lower limit, 1 for the upper one. */
    int side;
    /* The share of the piece's length. */
    gb_real share;
} gb_arm_crossing;

/* The share if it is between 0 and 1, else 0. */
GB_INLINE gb_real gb_arm_inside(gb_real u)
{
    return u > R(0.0) && u < R(1.0) ? u : R(0.0);
}

/* The shares between 0 and 1 where the cubic has an extremum, in increasing order, then 1. Where there are less than two, 0 comes first. */
static void gb_arm_extrema(gb_real a, gb_real b, gb_real c, gb_real *out)
{
    /* 3 a u^2 + 2 b u + c = 0. */
    const gb_real square = b * b - R(3.0) * a * c;
    out[0] = out[1] = R(0.0);
    out[2] = R(1.0);
    if (square <= R(0.0)) {
        return;
    }
    const gb_real root = gb_square_root(square), q = -(b + (b < R(0.0) ? -root : root));
    const gb_real first = gb_arm_inside(a == R(0.0) ? R(0.0) : q / (R(3.0) * a));
    const gb_real second = gb_arm_inside(q == R(0.0) ? R(0.0) : c / q);
    out[0] = gb_arm_min(first, second);
    out[1] = gb_arm_max(first, second);
}

/* The value of a cubic, given by its coefficients, the constant one first. */
GB_INLINE gb_real gb_arm_cubic_at(const gb_real *cubic, gb_real u)
{
    return cubic[0] + u * (cubic[1] + u * (cubic[2] + u * cubic[3]));
}

/* The root of a cubic between shares where it is at most zero and positive, by Newton's method with bisection. */
static gb_real gb_arm_root(const gb_real *cubic, gb_real low, gb_real high)
{
    gb_real u = R(0.5) * (low + high);
    for (int k = 0; k < GB_ARM_ROOT_STEPS; k++) {
        const gb_real value = gb_arm_cubic_at(cubic, u);
        if (value > R(0.0)) {
            high = u;
        } else {
            low = u;
        }
        const gb_real slope = cubic[1] + u * (R(2.0) * cubic[2] + u * R(3.0) * cubic[3]);
        const gb_real newton = slope == R(0.0) ? low : u - value / slope;
        const gb_real next = newton > low && newton < high ? newton : R(0.5) * (low + high);
        if (gb_magnitude(next - u) <= GB_ACCEPTANCE_RESIDUAL || high - low <= GB_ACCEPTANCE_RESIDUAL) {
            return next;
        }
        u = next;
    }
    return u;
}

/* The first share of the piece at which the joint exceeds the limit, or -1. That at the beginning of the piece does not count where the joint moves inwards. */
static gb_real gb_arm_crossed(const gb_arm_piece *piece, size_t joint, int side, gb_real limit)
{
    const gb_real outward = side == 0 ? R(-1.0) : R(1.0);
    gb_real c[3], cubic[4], ends[3], low = R(0.0);
    gb_arm_cubic(piece, joint, c);
    cubic[0] = outward * (piece->from.x[joint] - limit);
    for (int k = 0; k < 3; k++) {
        cubic[k + 1] = outward * c[k];
    }
    /* The control points of the cubic, between which its values are. */
    const gb_real second = cubic[0] + cubic[1] / R(3.0), third = cubic[0] + (R(2.0) * cubic[1] + cubic[2]) / R(3.0);
    const gb_real last = outward * (piece->to.x[joint] - limit);
    if (gb_arm_max(gb_arm_max(second, third), last) <= GB_ACCEPTANCE_INPUT) {
        return R(-1.0);
    }
    gb_arm_extrema(cubic[3], cubic[2], cubic[1], ends);
    for (int k = 0; k < 3; k++) {
        if (ends[k] > low && gb_arm_cubic_at(cubic, ends[k]) > GB_ACCEPTANCE_INPUT) {
            return gb_arm_root(cubic, low, ends[k]);
        }
        low = gb_arm_max(low, ends[k]);
    }
    return R(-1.0);
}

/* By how much the control points of the joints' cubics, between which their values are, exceed limits. */
GB_INLINE void gb_arm_exceeding(const gb_arm_model *model, const gb_arm_piece *piece, gb_real *exceeds)
{
    const gb_real share = piece->length / R(3.0);
    for (size_t i = 0; i < model->count; i++) {
        const gb_real last = piece->to.x[i], second = piece->from.x[i] + share * piece->from.t[i], third = last - share * piece->to.t[i];
        const gb_real low = gb_arm_min(gb_arm_min(second, third), last), high = gb_arm_max(gb_arm_max(second, third), last);
        exceeds[i] = gb_arm_max(model->limits[i][0] - low, high - model->limits[i][1]);
    }
}

/* The first joint that exceeds a limit on the piece. Joints of `tied` remain at their limits. False if there is none. */
static bool gb_arm_first_crossing(const gb_arm_model *model, const gb_arm_piece *piece, uint32_t tied, gb_arm_crossing *first)
{
    gb_real exceeds[GB_MOST_ARM_JOINTS];
    bool is_known = false;
    gb_arm_exceeding(model, piece, exceeds);
    for (size_t joint = 0; joint < model->count; joint++) {
        if (exceeds[joint] <= GB_ACCEPTANCE_INPUT || !gb_arm_is_limited(model, joint) || (tied & gb_arm_bit(joint)) != 0) {
            continue;
        }
        for (int side = 0; side < 2; side++) {
            const gb_real share = gb_arm_crossed(piece, joint, side, model->limits[joint][side]);
            if (share >= R(0.0) && (!is_known || share < first->share)) {
                is_known = true;
                first->joint = joint;
                first->side = side;
                first->share = share;
            }
        }
    }
    return is_known;
}

/* One Newton step to where the joint has the value of the limit. Returns the length of the step, or -1 where it is too long. */
static gb_real gb_arm_corrected(const gb_arm_model *model, const gb_arm_crossing *crossing, const gb_real *x, gb_real side, gb_real longest,
                                gb_arm_point *out)
{
    const gb_real limit = model->limits[crossing->joint][crossing->side];
    gb_real step[GB_MOST_ARM_JOINTS];
    gb_arm_place place;
    gb_arm_set_place(model, x, &place);
    if (!gb_arm_with(&place.linear, place.values, crossing->joint, x[crossing->joint] - limit, step)) {
        return R(-1.0);
    }
    const gb_real size = gb_arm_norm(step);
    const bool is_short = size <= longest;
    if (!is_short || place.linear.pivot <= GB_PIVOTS_REGULAR) {
        return R(-1.0);
    }
    gb_arm_plus(place.x, R(-1.0), step, place.x);
    *out = gb_arm_point_of(&place, side, gb_arm_still);
    return size;
}

/* The point of the curve where the joint has the value of the limit, by one Newton step. Returns the length of this step, or -1 where it is too long for the
 * crossing to be certain. */
static gb_real gb_arm_crossing_point(const gb_arm_model *model, const gb_arm_crossing *crossing, const gb_arm_piece *piece, gb_real side,
                                     gb_arm_point *out)
{
    gb_real x[GB_MOST_ARM_JOINTS];
    gb_arm_piece_at(piece, crossing->share, x);
    return gb_arm_corrected(model, crossing, x, side, GB_ARM_CROSSING * piece->length, out);
}
